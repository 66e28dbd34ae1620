//! A step as it is shown while a run goes on.

use crate::tube::Tube;
use hybrid_system::Label;
use interval_arithmetic::Enclosure;

/// A step of a run: all states at each time of it. An event may end it early, and the states behind the event are then those that
/// the flow alone would have.
#[derive(Debug)]
pub struct Piece<'t> {
    tube: &'t Tube<'t>,
    time: Enclosure,
    names: &'t [String],
    mode: Label,
}

impl<'t> Piece<'t> {
    pub(crate) fn new(
        tube: &'t Tube<'t>,
        time: Enclosure,
        names: &'t [String],
        mode: Label,
    ) -> Piece<'t> {
        Piece { tube, time, names, mode }
    }

    /// The time since the start of the run at which the step begins.
    pub fn time(&self) -> Enclosure {
        self.time
    }

    /// The length of the step.
    pub fn length(&self) -> f64 {
        self.tube.length
    }

    /// The order of its polynomials.
    pub fn order(&self) -> usize {
        self.tube.order
    }

    /// The mode.
    pub fn mode(&self) -> Label {
        self.mode
    }

    /// The names of the components.
    pub fn names(&self) -> &[String] {
        self.names
    }

    /// A box of the states at some times, counted from the start of the step; `None` for times outside of it.
    pub fn states_at(&self, times: Enclosure) -> Option<Vec<Enclosure>> {
        let inside =
            0.0 <= times.low() && times.low() <= times.high() && times.high() <= self.length();
        inside.then(|| self.tube.states_at(times))
    }
}
