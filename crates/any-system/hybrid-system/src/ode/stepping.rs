//! What the search for events needs of an integration: its steps, and the states inside them.

use super::step::Step;
use crate::error::Error;

/// A solution that is followed step by step.
pub(super) trait Stepping<V> {
    /// Takes one step within the tolerances.
    fn step(&mut self) -> Result<(), Error>;

    /// Start and end of the last step.
    fn interval(&self) -> (f64, f64);

    /// The state at the end of the last step.
    fn state(&self) -> V;

    /// The field there.
    fn slope(&self) -> V;

    /// Makes each component of `sizes` at least as large as that of the state there.
    fn enlarge(&self, sizes: &mut V);

    /// True if the end has been reached.
    fn ended(&self) -> bool;

    /// True if the state stays for ever.
    fn at_rest(&self) -> bool;

    /// Steps that are left.
    fn steps_left(&self) -> usize;

    /// States along the last step, to test that a guard stays far from zero.
    fn samples(&self) -> impl Iterator<Item = V>;

    /// The polynomial of the last step.
    fn last_step(&mut self) -> Result<Step<V>, Error>;

    /// The state at a time in the last step with all its digits, if the polynomial has fewer; `None` if it has them.
    fn directly_at(&mut self, time: f64) -> Option<Result<V, Error>>;

    /// The state at a time in the last step, where its polynomial is at hand.
    fn state_on_step(&self, time: f64) -> Option<V> {
        let _ = time;
        None
    }

    /// The guard at this place among the searched ones as a polynomial in the time since the last step began, if it is
    /// one.
    fn guard(&self, place: usize) -> Option<&[f64]> {
        let _ = place;
        None
    }
}
