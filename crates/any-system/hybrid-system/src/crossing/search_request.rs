//! What a search for the next event is told.

/// The number of intervals that a search under bounds tests, unless another number is given: a limit for a search that
/// takes too long. Every oscillation up to the horizon takes several intervals.
pub(crate) const MOST_INTERVALS: usize = 1_000_000;

/// A guard on whose surface an arc starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaving<S> {
    /// The surface.
    pub surface: S,
    /// The side to which the guard leaves its zero, ±1; 0 if it stays there, as far as the start shows.
    pub side: f64,
}

/// What a search for the next event is told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search<'a, S> {
    /// The search ends at this time after the start of the arc. It may be infinite for a model that solves its crossings.
    pub horizon: f64,
    /// The interval at which guards without bounds are sampled.
    pub sampling_interval: Option<f64>,
    /// The most intervals that a search under bounds tests.
    pub intervals: usize,
    /// The most steps of an integrated flow.
    pub steps: usize,
    /// Continuous time t at the start of the arc.
    pub time: f64,
    /// The guards on whose surfaces the arc starts, with the sides to which they leave. Their values at the start count
    /// as zero.
    pub leaving: &'a [Leaving<S>],
}

impl<S> Search<'static, S> {
    /// A search up to this time after the start, without sampling, with the usual budgets. The search itself finds the
    /// side to which a guard leaves its surface.
    pub const fn up_to(horizon: f64) -> Self {
        Search {
            horizon,
            sampling_interval: None,
            intervals: MOST_INTERVALS,
            steps: usize::MAX,
            time: 0.0,
            leaving: &[],
        }
    }

    /// The same with this sampling interval.
    #[must_use]
    pub const fn sampled(mut self, interval: f64) -> Self {
        self.sampling_interval = Some(interval);
        self
    }
}

impl<S: Copy + PartialEq> Search<'_, S> {
    /// The side to which the guard of this surface leaves its zero at the start, or 0 if it stays there; `None` if it does
    /// not start there.
    pub fn side(&self, surface: S) -> Option<f64> {
        self.leaving.iter().find(|leaving| leaving.surface == surface).map(|leaving| leaving.side)
    }
}
