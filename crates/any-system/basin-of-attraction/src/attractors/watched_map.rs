//! A map that counts its images and can be stopped.

use crate::attractors::state_map::StateMap;
use crate::space::label::Label;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// See [`watched_map`].
pub struct WatchedMap<'a, P> {
    map: &'a dyn StateMap,
    progress: P,
    images: AtomicUsize,
    is_stopped: AtomicBool,
}

/// Images between two calls of `progress`: a call then takes no time beside a thousand steps.
const BETWEEN: usize = 1024;

/// The same map, which counts its images and can be stopped: so everything that takes a map shows progress and can be interrupted. `progress` receives
/// the number of images so far, about every thousand. If it breaks, no state has an image any more, so that each orbit ends soon; what is found then is
/// no result. Finished results of earlier calls stay.
///
/// ```
/// use basin_of_attraction::{Attractors, Interval, RecurrenceLimits, StateGrid, array_map, watched_map};
/// use std::ops::ControlFlow::{Break, Continue};
/// let slow = array_map(|[x]: [f64; 1]| Some([x * (1.0 - 1e-9)]));
/// let watched = watched_map(&slow, |images| if images < 100_000 { Continue(()) } else { Break(()) });
/// let grid = StateGrid::uniform(Interval::new(-1.0, 1.0)?.try_into()?, 100)?;
/// let limits = RecurrenceLimits { budget: 1_000_000_000, ..RecurrenceLimits::default() };
/// let found = Attractors::search(&watched, grid, &[vec![0.5]], limits)?;
/// assert!(watched.is_stopped() && found.attractors().is_empty());
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
pub fn watched_map<P>(map: &dyn StateMap, progress: P) -> WatchedMap<'_, P>
where
    P: Fn(usize) -> ControlFlow<()> + Sync,
{
    WatchedMap { map, progress, images: AtomicUsize::new(0), is_stopped: AtomicBool::new(false) }
}

impl<P: Fn(usize) -> ControlFlow<()> + Sync> WatchedMap<'_, P> {
    /// Whether `progress` has stopped the map: then what was found is no result.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    /// Counts images; false if they are not to be computed.
    fn count(&self, images: usize) -> bool {
        if self.is_stopped() {
            return false;
        }
        let before = self.images.fetch_add(images, Ordering::Relaxed);
        let now = before + images;
        if before / BETWEEN != now / BETWEEN && (self.progress)(now).is_break() {
            self.is_stopped.store(true, Ordering::Relaxed);
        }
        true
    }
}

impl<P: Fn(usize) -> ControlFlow<()> + Sync> StateMap for WatchedMap<'_, P> {
    fn dimension(&self) -> Option<usize> {
        self.map.dimension()
    }

    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        self.count(1) && self.map.image(state, image)
    }

    fn label_of_end(&self, state: &[f64]) -> Label {
        self.map.label_of_end(state)
    }

    fn images(&self, states: &mut [Vec<f64>], has_image: &mut [bool]) {
        match self.count(has_image.len()) {
            true => self.map.images(states, has_image),
            false => has_image.fill(false),
        }
    }

    fn advance(&self, states: &mut [Vec<f64>], has_image: &mut [bool], steps: usize) -> usize {
        let most = (BETWEEN / has_image.len().max(1)).max(1);
        let mut made = 0;
        while made < steps {
            if self.is_stopped() {
                has_image.fill(false);
                return made + 1;
            }
            let some = self.map.advance(states, has_image, most.min(steps - made));
            made += some;
            self.count(has_image.len() * some);
            if has_image.contains(&false) {
                break;
            }
        }
        made
    }

    fn together(&self) -> usize {
        self.map.together()
    }
}
