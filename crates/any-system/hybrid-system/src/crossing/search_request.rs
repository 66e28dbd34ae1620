//! What a search for the next event is told.

use smallvec::SmallVec;

/// The number of intervals that a search under bounds tests, unless another number is given: a limit for a search that
/// takes too long. Every oscillation up to the horizon takes several intervals.
pub(crate) const MOST_INTERVALS: usize = 1_000_000;

/// Guards on whose surfaces an arc starts that are listed without allocating. The list is copied at every event: of eight, an
/// event that the model solves takes a tenth longer.
const FEW: usize = 2;

/// A list of guards on whose surfaces an arc starts.
pub(crate) type LeavingGuards<S> = SmallVec<[Leaving<S>; FEW]>;

/// A guard on whose surface an arc starts, within rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Leaving<S> {
    /// The surface.
    pub surface: S,
    /// The side to which the guard leaves its zero, ±1; 0 if it stays there, as far as the start shows. If the zero is
    /// `ahead`, the side on which the guard is.
    pub side: f64,
    /// True if the flow has brought the state next to the surface, and the guard has not had its zero yet: its
    /// value counts, however small.
    pub ahead: bool,
    /// How long rounding hides that it leaves, as far as the start shows: until then no sign says anything.
    pub hidden: f64,
}

impl<S> Leaving<S> {
    /// A guard that leaves its zero to a side, as the start shows.
    pub(crate) fn to(surface: S, side: f64) -> Self {
        Leaving { surface, side, ahead: false, hidden: 0.0 }
    }

    /// A guard on a side whose zero is still to come.
    pub(crate) fn before_zero(surface: S, side: f64) -> Self {
        Leaving { ahead: true, ..Self::to(surface, side) }
    }
}

/// What a search for the next event is told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search<'a, S> {
    /// The search ends at this time after the start of the arc. It may be infinite for a model that solves its
    /// crossings.
    pub horizon: f64,
    /// The interval at which guards without bounds are sampled.
    pub sampling_interval: Option<f64>,
    /// The most intervals that a search under bounds tests.
    pub intervals: usize,
    /// The most steps of an integrated flow.
    pub steps: usize,
    /// Continuous time t at the start of the arc.
    pub time: f64,
    /// The guards on whose surfaces the arc starts within rounding. Their values at the start count as zero, unless
    /// their zero is still ahead.
    pub leaving: &'a [Leaving<S>],
    /// The first steps from the start, where many motions are followed side by side.
    #[cfg(feature = "ode")]
    #[doc(hidden)]
    pub ahead: &'a [equations::Step],
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
            #[cfg(feature = "ode")]
            ahead: &[],
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
    /// The side to which the guard of this surface leaves its zero at the start, or 0 if it stays there; `None` if
    /// it does not start there.
    pub fn side(&self, surface: S) -> Option<f64> {
        let mut past = self.leaving.iter().filter(|leaving| !leaving.ahead);
        past.find(|leaving| leaving.surface == surface).map(|leaving| leaving.side)
    }

    /// The side on which the guard of this surface starts, if rounding alone would not tell: its zero is still ahead.
    pub fn side_before(&self, surface: S) -> Option<f64> {
        let mut ahead = self.leaving.iter().filter(|leaving| leaving.ahead);
        ahead.find(|leaving| leaving.surface == surface).map(|leaving| leaving.side)
    }

    /// How long rounding hides to which side the guard of this surface leaves its zero.
    pub(crate) fn hidden(&self, surface: S) -> f64 {
        let leaving = self.leaving.iter().find(|leaving| leaving.surface == surface);
        leaving.map_or(0.0, |leaving| leaving.hidden)
    }
}
