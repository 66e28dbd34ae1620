//! The functions that the page calls by name. Each returns 0 for an answer and 1 for a refusal; the bytes are at
//! `answer_place`.

use crate::answer;
#[cfg(feature = "deep")]
use crate::depth::Depth;
use crate::json::Json;
use crate::refusal::Refusal;
use crate::tile::{Tile, numbered, strip};
#[cfg(feature = "deep")]
use std::cell::RefCell;

fn json(answer: Result<Json, Refusal>) -> u32 {
    answer::keep(answer.map(|json| json.finish().into_bytes()))
}

fn doubles(answer: Result<Vec<f64>, Refusal>) -> u32 {
    answer::keep(answer.map(|all| all.iter().flat_map(|number| number.to_le_bytes()).collect()))
}

/// Columns `from`..`to` of a tile: the pixels, then the values as 32-bit integers, the lowest byte first.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn tile(
    layer: u32,
    logarithmic: u32,
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
    columns: usize,
    rows: usize,
    from: usize,
    to: usize,
) -> u32 {
    let logarithmic = logarithmic != 0;
    let tile = Tile { x: (left, right), logarithmic, alpha: (bottom, top), columns, rows };
    let found = numbered(layer).and_then(|layer| strip(layer, &tile, from..to));
    answer::keep(found.map(|strip| {
        let mut bytes = strip.pixels;
        bytes.extend(strip.values.iter().flat_map(|value| value.to_le_bytes()));
        bytes
    }))
}

/// The mass ratios of the columns of a tile, then the speeds of its rows from below, as doubles.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn places(
    logarithmic: u32,
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
    columns: usize,
    rows: usize,
) -> u32 {
    let logarithmic = logarithmic != 0;
    let tile = Tile { x: (left, right), logarithmic, alpha: (bottom, top), columns, rows };
    doubles(crate::tile::places(&tile))
}

/// Colours, names and windows, as JSON.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn legend() -> u32 {
    json(Ok(crate::legend::legend_json()))
}

/// The fate of a point and up to `hops` hops of its orbit, as JSON.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn point(mass_ratio: f64, alpha: f64, hops: usize) -> u32 {
    json(crate::point::point_json(mass_ratio, alpha, hops))
}

/// Whether the fate of a point is proved, as JSON.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn proof(mass_ratio: f64, alpha: f64) -> u32 {
    json(crate::point::proof_json(mass_ratio, alpha))
}

/// The map between two speeds, as JSON.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn map(mass_ratio: f64, from: f64, to: f64, points: usize) -> u32 {
    json(crate::map::map_json(mass_ratio, from, to, points))
}

/// The samples of a motion, as doubles.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn motion(mass_ratio: f64, alpha: f64, hops: usize) -> u32 {
    doubles(crate::motion::motion(mass_ratio, alpha, hops))
}

/// Units of a hopper with a total mass in kilograms, as JSON.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn units(mass_ratio: f64, mass: f64, stiffness: f64, gravity: f64) -> u32 {
    json(crate::motion::units_json(mass_ratio, mass, stiffness, gravity))
}

/// The circle of fates of α*_n, as JSON.
#[cfg(feature = "deep")]
#[unsafe(no_mangle)]
pub(crate) extern "C" fn circle(mass_ratio: f64, n: u32) -> u32 {
    json(crate::circle::circle_json(mass_ratio, u64::from(n)))
}

/// The basins between two fixed points at one mass ratio, as JSON.
#[cfg(feature = "deep")]
#[unsafe(no_mangle)]
pub(crate) extern "C" fn intervals(mass_ratio: f64, first: u32, last: u32) -> u32 {
    json(crate::circle::intervals_json(mass_ratio, u64::from(first), u64::from(last)))
}

#[cfg(feature = "deep")]
thread_local! {
    /// The boundary point of the deep view: its chart takes longer than its frames.
    static DEPTH: RefCell<Option<Depth>> = const { RefCell::new(None) };
}

/// Opens the chart of the boundary point next to a speed; its numbers as JSON.
#[cfg(feature = "deep")]
#[unsafe(no_mangle)]
pub(crate) extern "C" fn open_depth(mass_ratio: f64, alpha: f64) -> u32 {
    let known = DEPTH.with_borrow(|kept| {
        let kept = kept.as_ref().filter(|depth| depth.is_at(mass_ratio, alpha));
        kept.map(Depth::json)
    });
    if let Some(known) = known {
        return json(Ok(known));
    }
    json(Depth::near(mass_ratio, alpha).map(|depth| {
        let text = depth.json();
        DEPTH.with_borrow_mut(|kept| *kept = Some(depth));
        text
    }))
}

/// The pixels of a layer in the window of half height 10^−`depth` about the opened boundary point.
#[cfg(feature = "deep")]
#[unsafe(no_mangle)]
pub(crate) extern "C" fn depth_frame(layer: u32, depth: f64, columns: usize, rows: usize) -> u32 {
    answer::keep(DEPTH.with_borrow(|kept| match kept {
        Some(open) => numbered(layer).and_then(|layer| open.frame(layer, depth, (columns, rows))),
        None => Err(Refusal::new("no boundary point is open; open one before its frames")),
    }))
}

/// The place on the circle with which such a window ends, as JSON.
#[cfg(feature = "deep")]
#[unsafe(no_mangle)]
pub(crate) extern "C" fn depth_phase(depth: f64) -> u32 {
    json(DEPTH.with_borrow(|kept| match kept {
        Some(open) => open.phase_json(depth),
        None => Err(Refusal::new("no boundary point is open; open one before its phase")),
    }))
}

/// The fate at a point of such a window, and the number of a layer, in half widths and half heights from its middle, as JSON.
#[cfg(feature = "deep")]
#[unsafe(no_mangle)]
pub(crate) extern "C" fn depth_label(layer: u32, depth: f64, x: f64, y: f64) -> u32 {
    json(DEPTH.with_borrow(|kept| match kept {
        Some(open) => numbered(layer).and_then(|layer| open.label_json(layer, depth, (x, y))),
        None => Err(Refusal::new("no boundary point is open; open one before its fates")),
    }))
}
