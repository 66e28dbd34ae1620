//! Fates by traps: the fate of an orbit is decided as soon as it enters a set that no orbit leaves.

use crate::error::Error;
use crate::line::scalar_map::{Image, ScalarMap};
use crate::space::interval::Interval;
use crate::space::label::Label;
use crate::space::undecided_reason::UndecidedReason;

/// Sets that no orbit leaves, each with the label of its attractor.
pub trait Traps {
    /// The label of the trap that contains x; `None` outside all traps.
    fn label(&self, x: f64) -> Option<Label>;
}

/// Disjoint intervals as traps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TrapSet {
    /// Disjoint, from left to right.
    traps: Vec<(Interval, Label)>,
}

impl TrapSet {
    /// Traps with their labels. The caller guarantees that orbits stay in them; [`check_trap`](crate::check_trap)
    /// tests it.
    ///
    /// # Errors
    /// [`Error::OverlappingTraps`] if two have a point in common; [`Error::BadInterval`] as for [`Interval::new`].
    pub fn new(mut traps: Vec<(Interval, Label)>) -> Result<Self, Error> {
        for (trap, _) in &traps {
            Interval::new(trap.left, trap.right)?;
        }
        traps.sort_by(|a, b| a.0.left.total_cmp(&b.0.left));
        for pair in traps.windows(2) {
            let (first, second) = (pair[0].0, pair[1].0);
            if second.left <= first.right {
                return Err(Error::OverlappingTraps {
                    first_left: first.left,
                    first_right: first.right,
                    second_left: second.left,
                    second_right: second.right,
                });
            }
        }
        Ok(TrapSet { traps })
    }
}

impl Traps for TrapSet {
    fn label(&self, x: f64) -> Option<Label> {
        let at = self.traps.partition_point(|(interval, _)| interval.right < x);
        self.traps.get(at).filter(|(interval, _)| interval.contains(x)).map(|&(_, label)| label)
    }
}

/// The fate of an orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fate {
    /// The orbit enters the trap with this label.
    Trapped(Label),
    /// The orbit reaches a point at which the map has no value.
    Stopped,
    /// The fate is not known, for this reason.
    Undecided(UndecidedReason),
}

/// The fate of `start`, and the number of steps after which it was known.
///
/// Only a trap decides that an orbit is attracted; closeness to a point does not. Therefore an orbit that passes a
/// point slowly is never reported as attracted by it. After `budget` steps the fate is undecided.
///
/// ```
/// use basin_of_attraction::{Fate, Interval, Label, TrapSet, classify};
/// // x + x²: 0 attracts [−1, 0], and [−½, 0] is a trap.
/// let traps = TrapSet::new(vec![(Interval::new(-0.5, 0.0)?, Label::from(1))])?;
/// let map = |x: f64| (x.abs() < 10.0).then(|| x + x * x);
/// assert_eq!(classify(&map, &traps, -0.9, 100), (Fate::Trapped(Label::from(1)), 1));
/// assert_eq!(classify(&map, &traps, 0.3, 100).0, Fate::Stopped);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
pub fn classify(
    map: &impl ScalarMap,
    traps: &impl Traps,
    start: f64,
    budget: usize,
) -> (Fate, usize) {
    let mut x = start;
    for step in 0..=budget {
        if !x.is_finite() {
            return (Fate::Undecided(UndecidedReason::Map { at: x }), step);
        }
        if let Some(label) = traps.label(x) {
            return (Fate::Trapped(label), step);
        }
        if step == budget {
            break;
        }
        match map.image(x) {
            Image::Stops => return (Fate::Stopped, step + 1),
            Image::Undecided => return (Fate::Undecided(UndecidedReason::Map { at: x }), step),
            Image::Point(image) if image == x => {
                return (Fate::Undecided(UndecidedReason::Precision { at: x }), step);
            }
            Image::Point(image) => x = image,
        }
    }
    (Fate::Undecided(UndecidedReason::Budget), budget)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fate_occurs() {
        let traps = TrapSet::new(vec![(Interval::new(0.0, 0.1).unwrap(), Label::from(7))]).unwrap();
        let halve = |x: f64| Some(x / 2.0);
        assert_eq!(classify(&halve, &traps, 0.8, 10), (Fate::Trapped(Label::from(7)), 3));
        assert_eq!(
            classify(&halve, &traps, 1e9, 10),
            (Fate::Undecided(UndecidedReason::Budget), 10)
        );
        let stands = |x: f64| Some(x);
        assert_eq!(
            classify(&stands, &traps, 5.0, 10).0,
            Fate::Undecided(UndecidedReason::Precision { at: 5.0 })
        );
        let breaks = |x: f64| Some(x / 0.0);
        let (fate, steps) = classify(&breaks, &traps, 5.0, 10);
        assert!(matches!(fate, Fate::Undecided(UndecidedReason::Map { .. })) && steps == 1);
        assert!(matches!(
            classify(&halve, &traps, f64::NAN, 10).0,
            Fate::Undecided(UndecidedReason::Map { .. })
        ));
    }

    #[test]
    fn overlapping_traps_are_refused() {
        let traps = [(0.0, 1.0, 1), (1.0, 2.0, 2)];
        let traps = traps.map(|(a, b, n)| (Interval::new(a, b).unwrap(), Label::from(n))).to_vec();
        assert!(matches!(TrapSet::new(traps), Err(Error::OverlappingTraps { .. })));
    }

    #[test]
    fn traps_that_are_no_intervals_are_refused() {
        for (left, right) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
            let traps = vec![(Interval { left, right }, Label::from(1))];
            assert!(matches!(TrapSet::new(traps), Err(Error::BadInterval { .. })));
        }
    }
}
