//! A map whose images are counted, and that can be stopped.

use super::border::{BorderSite, Clearance};
use super::derivatives::{Linearized, Pushed};
use super::family::{Image, MapFamily};
use crate::error::Error;
use equations::Jet;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// A map that is watched.
#[derive(Debug)]
pub struct Watched<M, W> {
    map: M,
    watch: W,
    images: AtomicUsize,
    stopped: AtomicBool,
}

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
pub fn watched<M: MapFamily, W: Fn(usize) -> ControlFlow<()> + Sync>(
    map: M,
    watch: W,
) -> Watched<M, W> {
    Watched { map, watch, images: AtomicUsize::new(0), stopped: AtomicBool::new(false) }
}

impl<M: MapFamily, W: Fn(usize) -> ControlFlow<()> + Sync> Watched<M, W> {
    fn error(&self) -> Error {
        Error::Stopped { images: self.images.load(Ordering::Relaxed) }
    }

    /// What `of` gives, unless the work was stopped.
    fn counted<R>(&self, of: impl FnOnce() -> Result<R, Error>) -> Result<R, Error> {
        if self.stopped.load(Ordering::Relaxed) {
            return Err(self.error());
        }
        let result = of();
        self.count();
        result
    }

    fn count(&self) {
        if (self.watch)(self.images.fetch_add(1, Ordering::Relaxed) + 1).is_break() {
            self.stopped.store(true, Ordering::Relaxed);
        }
    }
}

impl<M: MapFamily, W: Fn(usize) -> ControlFlow<()> + Sync> MapFamily for Watched<M, W> {
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
        if self.stopped.load(Ordering::Relaxed) {
            return Err(self.error());
        }
        let mut stopped = false;
        self.map.orbit(start, parameter, images, &mut |image| {
            self.count();
            stopped = self.stopped.load(Ordering::Relaxed);
            match stopped {
                true => ControlFlow::Break(()),
                false => see(image),
            }
        })?;
        if stopped { Err(self.error()) } else { Ok(()) }
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
        self.map.along(itinerary, border)
    }

    fn stopped(&self) -> Option<Error> {
        self.stopped.load(Ordering::Relaxed).then(|| self.error())
    }
}
