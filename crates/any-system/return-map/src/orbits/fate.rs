//! How orbits of a map end.

use super::attractor::PeriodicAttractor;
use crate::error::Error;
use crate::families::MapFamily;
use hybrid_system::{Stop, many};
use std::ops::ControlFlow;

/// How an orbit ends.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitFate {
    /// Why it ends.
    pub end: OrbitEnd,
    /// Its last point.
    pub last: Vec<f64>,
    /// The number of images until then.
    pub images: usize,
    /// The time until then; of a return map that of the last part, which does not return, included.
    pub time: f64,
    /// The number of events until then, of a return map, without those of infinite series; of a map of several pieces the number of their
    /// names.
    pub events: usize,
}

/// Why an orbit ends.
#[derive(Debug, Clone, PartialEq)]
pub enum OrbitEnd {
    /// It is in the trap of the attractor with this number.
    Attractor(usize),
    /// By an event of this surface, which ends the run.
    Terminal(String),
    /// At infinitely many events in finite time: within one return, behind which the model does not go on; or with infinitely many
    /// returns. These are seen when they do not move the time any more, by its rounding.
    Zeno,
    /// No event follows, and so no return.
    NoFurtherEvent,
    /// The number of images was reached, without an end.
    Budget,
    /// For another reason: the limits of a return were reached, a point has no image, the model failed.
    Failed(Error),
}

/// The fate of the orbit of a point: up to an attractor, an end, or a number of images.
///
/// ```
/// use return_map::{OrbitEnd, PeriodicAttractor, orbit_fate, scalar_family};
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let cycle = PeriodicAttractor::new(&logistic, 2, (&[0.5], 3.2))?;
/// let fate = orbit_fate(&logistic, (&[0.3], 3.2), &[cycle], 1000);
/// assert_eq!(fate.end, OrbitEnd::Attractor(0));
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// Attractors are those of this parameter. For basins fates are labels:
///
/// ```
/// use basin_of_attraction::{Grid, Interval, Label, raster};
/// use return_map::{OrbitEnd, PeriodicAttractor, family, orbit_fate};
/// // Two wells: ẋ = x − x³, by the map of a time step.
/// let wells = family(2, |x: &[f64], p| Ok(vec![x[0] + p * (x[0] - x[0].powi(3)), 0.5 * x[1]]));
/// let known = [
///     PeriodicAttractor::new(&wells, 1, (&[-1.0, 0.0], 0.1))?,
///     PeriodicAttractor::new(&wells, 1, (&[1.0, 0.0], 0.1))?,
/// ];
/// let label = |&x: &f64, y: f64| match orbit_fate(&wells, (&[x, y], 0.1), &known, 1000).end {
///     OrbitEnd::Attractor(0) => Label::from(0),
///     OrbitEnd::Attractor(_) => Label::from(1),
///     _ => Label::UNDECIDED,
/// };
/// let side = Interval::new(-1.5, 1.5)?;
/// let grid = Grid { x: side, y: side, columns: 10, rows: 10 };
/// let image = raster(grid, |x| x, label, |_| std::ops::ControlFlow::Continue(()))?;
/// assert_eq!(image.counts(), [(Label::from(0), 50), (Label::from(1), 50)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn orbit_fate<M: MapFamily + ?Sized>(
    map: &M,
    (start, parameter): (&[f64], f64),
    attractors: &[PeriodicAttractor],
    most_images: usize,
) -> OrbitFate {
    let mut fate =
        OrbitFate { end: OrbitEnd::Budget, last: start.to_vec(), images: 0, time: 0.0, events: 0 };
    let reached = |point: &[f64]| attractors.iter().position(|known| known.contains(point));
    if let Some(number) = reached(start) {
        fate.end = OrbitEnd::Attractor(number);
        return fate;
    }
    let mut still = 0;
    let ended = map.orbit(start, parameter, most_images, &mut |image| {
        fate.images += 1;
        let time = fate.time + image.time;
        still = if time == fate.time { still + 1 } else { 0 };
        fate.time = time;
        fate.events += image.itinerary.len();
        fate.last = image.point;
        if let Some(number) = reached(&fate.last) {
            fate.end = OrbitEnd::Attractor(number);
        } else if still == STILL {
            fate.end = OrbitEnd::Zeno;
        }
        match fate.end {
            OrbitEnd::Budget => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    });
    if let Err(error) = ended {
        if let Error::NoReturn { time, events, .. } = &error {
            fate.time += time;
            fate.events += events;
        }
        fate.end = end_of(error);
    }
    fate
}

/// So many images in a row that do not move the time are the last ones of infinitely many: one or two may be those of a corner.
pub(super) const STILL: usize = 10;

/// What a missing image means for an orbit.
pub(crate) fn end_of(error: Error) -> OrbitEnd {
    match error {
        Error::NoReturn { stop: Stop::Terminal, surface: Some(surface), .. } => {
            OrbitEnd::Terminal(surface)
        }
        Error::NoReturn { stop: Stop::Zeno, .. } => OrbitEnd::Zeno,
        Error::NoReturn { stop: Stop::NoFurtherEvent, .. } => OrbitEnd::NoFurtherEvent,
        error => OrbitEnd::Failed(error),
    }
}

/// The fates of many starts, in their order: with the feature `parallel` on all processors, with the same bits on any number of them.
///
/// `progress` receives the number of orbits that have ended, after each. If it breaks, no further orbit begins, and those that have not
/// begun are `None`.
pub fn orbit_fates<M: MapFamily + ?Sized>(
    map: &M,
    (starts, parameter): (&[Vec<f64>], f64),
    attractors: &[PeriodicAttractor],
    most_images: usize,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Vec<Option<OrbitFate>> {
    let one =
        |number: usize| orbit_fate(map, (&starts[number], parameter), attractors, most_images);
    many(starts.len(), one, progress)
}
