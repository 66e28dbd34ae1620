//! Where does a hop lead, for all speeds of an interval and all mass ratios of a strip?
//!
//! ```text
//!   strip.rs            mass ratios, as κ and μ
//!   half_time.rs        the functions of half a time of flight, without cancellation
//!   part.rs             sudden windows and contact parts
//!   time_functions.rs   those of a time of flight, over intervals
//!   landing_time.rs     a landing, enclosed by two signs
//!   first_landing.rs    the first landing over an interval of speeds
//!   flight.rs           a later flight, with the first and the second derivatives of its landing
//!   following.rs        the state after a landing, by the speed at the start of the hop
//!   hop_enclosure.rs    F = α′² with its derivatives, by interval arithmetic
//!   turns.rs            the maximum and the minimum of a contact part
//!   proved_images.rs    narrow images: by monotony, and from the middle of a strip
//! ```

pub(crate) mod first_landing;
mod flight;
mod following;
pub(crate) mod half_time;
pub(crate) mod hop_enclosure;
pub(crate) mod landing_time;
pub(crate) mod part;
pub(crate) mod proved_images;
pub(crate) mod strip;
pub(crate) mod time_functions;
pub(crate) mod turns;
