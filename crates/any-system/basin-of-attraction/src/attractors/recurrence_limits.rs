//! The limits of a search of attractors by recurrences.

/// More tests of an attractor than this take hours, and would find openings of a hundred-thousandth of the neighbourhood.
pub(crate) const MOST_TESTS: usize = 1_000_000;

/// How attractors are searched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecurrenceLimits {
    /// Consecutive steps to cells that the orbit has visited, after which these cells are a candidate.
    pub recurrences: usize,
    /// Fewest steps of a stretch: an oscillation should not be longer. A candidate is confirmed over ten stretches
    /// at least. An orbit of a test must visit the candidate in each of three stretches.
    pub locate: usize,
    /// Most steps to a candidate. To confirm it, the orbit is followed ten times as long as it took to be found.
    pub budget: usize,
    /// Consecutive steps outside the region, after which an orbit is given up.
    pub lost: usize,
    /// Orbits that test a candidate; 50 at least are taken.
    pub tests: usize,
    /// A distance from the origin, in the largest coordinate, from where the caller knows that no orbit returns.
    /// Such an orbit has the label [`Label::ESCAPED`](crate::Label::ESCAPED). `None` if there is none.
    pub escape: Option<f64>,
}

impl Default for RecurrenceLimits {
    /// A hundred recurrences, stretches of 1000 steps, 10⁵ steps to a candidate, 1000 outside, and 200 tests.
    ///
    /// Fewer recurrences take more transients for candidates, which are then refused.
    fn default() -> Self {
        RecurrenceLimits {
            recurrences: 100,
            locate: 1000,
            budget: 100_000,
            lost: 1000,
            tests: 200,
            escape: None,
        }
    }
}
