//! A map whose images are counted, and that can be stopped.

use super::border::{BorderSite, Clearance};
use super::derivatives::{Linearized, Pushed};
use super::family::{Image, MapFamily};
use crate::error::Error;
use equations::Jet;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The same map. `watch` receives the number of images so far, after each one, also from several threads. If it breaks, there are no further
/// images, and the work that asks for them ends with [`Error::Stopped`]; work whose result has an end ends there, with what it has found.
/// So everything in this crate that takes a map shows its progress and can be stopped.
///
/// An image with derivatives counts as one.
///
/// ```
/// use return_map::{Error, map_pieces, scalar_family, watched};
/// use std::ops::ControlFlow::{Break, Continue};
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let impatient = watched(&logistic, |images| if images < 100 { Continue(()) } else { Break(()) });
/// let stopped = map_pieces(&impatient, 3.9, (0.0, 1.0), 1000);
/// assert_eq!(stopped, Err(Error::Stopped { images: 100 }));
/// ```
pub fn watched(
    map: impl MapFamily,
    watch: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> impl MapFamily {
    let (images, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    Watched { map, counter: Counter { watch, images, stopped } }
}

/// A map that is watched: by a counter of its own, or by that of the map that it continues beyond a border.
struct Watched<M, C> {
    map: M,
    counter: C,
}

/// What counts the images of a map, and of its continuations beyond borders.
struct Counter<W> {
    watch: W,
    images: AtomicUsize,
    stopped: AtomicBool,
}

trait Counts: Sync {
    /// Why there are no further images.
    fn error(&self) -> Option<Error>;
    /// Counts an image.
    fn count(&self);
    /// The counter itself, for a continuation.
    fn shared(&self) -> &dyn Counts;
}

impl<W: Fn(usize) -> ControlFlow<()> + Sync> Counts for Counter<W> {
    fn error(&self) -> Option<Error> {
        let images = self.images.load(Ordering::Relaxed);
        self.stopped.load(Ordering::Relaxed).then_some(Error::Stopped { images })
    }

    fn count(&self) {
        if (self.watch)(self.images.fetch_add(1, Ordering::Relaxed) + 1).is_break() {
            self.stopped.store(true, Ordering::Relaxed);
        }
    }

    fn shared(&self) -> &dyn Counts {
        self
    }
}

impl Counts for &dyn Counts {
    fn error(&self) -> Option<Error> {
        (**self).error()
    }

    fn count(&self) {
        (**self).count();
    }

    fn shared(&self) -> &dyn Counts {
        *self
    }
}

impl<M, C: Counts> Watched<M, C> {
    /// What `of` gives, unless the work was stopped.
    fn counted<R>(&self, of: impl FnOnce() -> Result<R, Error>) -> Result<R, Error> {
        if let Some(error) = self.counter.error() {
            return Err(error);
        }
        let result = of();
        self.counter.count();
        // The image at which the watch breaks is not used: a family of maps, each of which is new, stops at once.
        self.counter.error().map_or(result, Err)
    }
}

impl<M: MapFamily, C: Counts> MapFamily for Watched<M, C> {
    fn dimension(&self) -> usize {
        self.map.dimension()
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        self.counted(|| self.map.image(point, parameter))
    }

    fn orbit(
        &self,
        start: &[f64],
        parameter: f64,
        images: usize,
        see: &mut dyn FnMut(Image) -> ControlFlow<()>,
    ) -> Result<(), Error> {
        if let Some(error) = self.counter.error() {
            return Err(error);
        }
        let mut stopped = None;
        self.map.orbit(start, parameter, images, &mut |image| {
            self.counter.count();
            stopped = self.counter.error();
            match stopped {
                Some(_) => ControlFlow::Break(()),
                None => see(image),
            }
        })?;
        stopped.map_or(Ok(()), Err)
    }

    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Pushed, Error> {
        self.counted(|| self.map.pushed(curve, parameter))
    }

    fn linearized(&self, point: &[f64], parameter: f64) -> Result<Linearized, Error> {
        self.counted(|| self.map.linearized(point, parameter))
    }

    fn clearances(
        &self,
        curve: &[Jet<4>],
        parameter: Jet<4>,
    ) -> Result<Option<Vec<Clearance>>, Error> {
        self.counted(|| self.map.clearances(curve, parameter))
    }

    fn border(
        &self,
        at: (&[f64], f64),
        pieces: (&[String], &[String]),
        place: usize,
        within: f64,
    ) -> BorderSite {
        self.map.border(at, pieces, place, within)
    }

    fn along(
        &self,
        itinerary: &[String],
        border: Option<&BorderSite>,
    ) -> Result<Box<dyn MapFamily + '_>, Error> {
        let map = self.map.along(itinerary, border)?;
        Ok(Box::new(Watched { map, counter: self.counter.shared() }))
    }

    fn stopped(&self) -> Option<Error> {
        self.counter.error()
    }
}
