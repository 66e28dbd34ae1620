//! The motion of a model in all its modes, and motions in closed form.

use crate::crossing::{NextEvent, Search};
use crate::error::Error;
use crate::system::{HybridSystem, default_search};

/// How the state of a [`Model`](crate::Model) moves: [`ClosedForm`], or `Integrated` (feature `ode`).
pub trait Motion<M, X> {
    /// φ(t; x₀) of the model `system`, to which this motion belongs.
    fn flow<T>(&self, system: &T, mode: M, start: &X, time: f64) -> X
    where
        T: HybridSystem<Mode = M, State = X>;

    /// φ(t; x₀) at several times.
    ///
    /// # Errors
    /// Those of an integration.
    fn states<T>(&self, system: &T, mode: M, start: &X, times: &[f64]) -> Result<Vec<X>, Error>
    where
        T: HybridSystem<Mode = M, State = X>;

    /// f(x) of ẋ = f(x), if the motion has a field.
    fn field(&self, mode: M, state: &X) -> Option<X>;

    /// The first event of an arc.
    ///
    /// # Errors
    /// Those of the search.
    fn first_crossing<T>(
        &self,
        system: &T,
        mode: M,
        start: &X,
        search: &Search<T::Surface>,
    ) -> Result<NextEvent<T::Surface, X>, Error>
    where
        T: HybridSystem<Mode = M, State = X>;

    /// Finds misuse before the first arc. Default: no check.
    ///
    /// # Errors
    /// The misuse, with its remedy.
    fn validate(&self, mode: M, start: &X) -> Result<(), Error> {
        let _ = (mode, start);
        Ok(())
    }
}

/// A motion in closed form: a closure gives φ(t; x₀) from the mode, the start and the time.
#[derive(Debug, Clone, Copy)]
pub struct ClosedForm<F>(pub(super) F);

impl<M, X, Y, F> Motion<M, X> for ClosedForm<F>
where
    M: Copy,
    Y: Into<X>,
    F: Fn(M, &X, f64) -> Y,
{
    #[inline]
    fn flow<T>(&self, _: &T, mode: M, start: &X, time: f64) -> X
    where
        T: HybridSystem<Mode = M, State = X>,
    {
        (self.0)(mode, start, time).into()
    }

    fn states<T>(&self, _: &T, mode: M, start: &X, times: &[f64]) -> Result<Vec<X>, Error>
    where
        T: HybridSystem<Mode = M, State = X>,
    {
        Ok(times.iter().map(|&time| (self.0)(mode, start, time).into()).collect())
    }

    fn field(&self, _: M, _: &X) -> Option<X> {
        None
    }

    fn first_crossing<T>(
        &self,
        system: &T,
        mode: M,
        start: &X,
        search: &Search<T::Surface>,
    ) -> Result<NextEvent<T::Surface, X>, Error>
    where
        T: HybridSystem<Mode = M, State = X>,
    {
        default_search(system, mode, start, search)
    }
}
