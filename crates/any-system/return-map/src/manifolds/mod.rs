//! Where do the orbits go that leave a saddle, and where do they come from?
//!
//! `local` is the curve near the saddle, `manifold` the whole one as a function of one number, `curve` its points at even distances,
//! `crossings` where two of them meet (`chords` says where to look), `tangency` where they touch.

mod chords;
mod crossings;
mod curve;
mod local;
mod manifold;
mod tangency;

pub use crossings::{ManifoldCrossing, manifold_crossings};
pub use curve::{ManifoldCurve, ManifoldCut, ManifoldEnd, ManifoldSteps};
pub use manifold::UnstableManifold;
pub use tangency::{ManifoldTangency, manifold_tangency};
