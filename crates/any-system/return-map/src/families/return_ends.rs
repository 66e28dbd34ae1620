//! Where a return of equations ends: the mode and the whole state, which a section may not show.

use super::equation_returns::EquationReturns;
use super::return_arcs::elapsed;
use crate::error::Error;

/// Both ends of a return.
#[derive(Debug, Clone, PartialEq)]
pub struct ReturnEnds {
    /// The state at which it begins, in the mode of the map.
    pub start: Vec<f64>,
    /// The mode behind its last event.
    pub mode: String,
    /// The state behind its last event.
    pub state: Vec<f64>,
    /// How long it takes.
    pub time: f64,
    /// The image of the point.
    pub image: Vec<f64>,
}

impl EquationReturns {
    /// Both ends of the return from a point. A map goes on as the flow does only if a return ends in the mode in which it begins, and with all components of the
    /// state that the next one begins with: a fixed point of other maps is no orbit.
    ///
    /// ```
    /// use hybrid_system::Equations;
    /// use return_map::EquationReturns;
    /// // y is no coordinate, and does not come back to 0.
    /// let open = Equations::new(&["x", "y"], &[("k", "1")])
    ///     .mode_text("m", &["-x", "k"])
    ///     .clock_text("tick", "1", "1");
    /// let ticks = EquationReturns::new(&open, "k", ("m", "tick"), &["x"])?;
    /// let ends = ticks.return_ends(&[0.0], 2.0)?;
    /// assert_eq!((ends.start[1], ends.state[1], ends.time), (0.0, 2.0, 1.0));
    /// # Ok::<(), return_map::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`image`](crate::MapFamily::image).
    pub fn return_ends(&self, point: &[f64], parameter: f64) -> Result<ReturnEnds, Error> {
        let way = self.way(point, parameter)?;
        let image = self.image_after(&way, parameter)?.point;
        let names = self.equations.names().states.len();
        let without_time = |state: &[f64]| state[..names.min(state.len())].to_vec();
        let start =
            way.arcs.first().map_or_else(Vec::new, |arc| without_time(arc.start.as_slice()));
        let after = way.arcs.last().and_then(|arc| arc.event()?.after.as_ref());
        let (mode, state) = match after {
            Some((mode, state)) => (mode.to_string(), without_time(state.as_slice())),
            None => (self.mode.to_string(), start.clone()),
        };
        Ok(ReturnEnds { start, mode, state, time: elapsed(&way.arcs), image })
    }
}
