//! A point of the boundary between two states of different basins, by bisection.

use crate::error::Error;
use crate::space::label::Label;
use crate::space::vectors::{check_point, distance};

/// Two close states of different basins, with the boundary between them.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryBracket {
    /// A state, with its label: that of the first state given.
    pub first: (Vec<f64>, Label),
    /// A state of another basin, with its label.
    pub second: (Vec<f64>, Label),
    /// A state between the two that belongs to no known basin, with its label. There the search ended: the boundary
    /// is in a part that the labelling leaves undecided, and the two states are farther apart than was asked for.
    /// `None` as a rule.
    pub undecided: Option<(Vec<f64>, Label)>,
}

impl BoundaryBracket {
    /// The distance of both states.
    pub fn distance(&self) -> f64 {
        distance(&self.first.0, &self.second.0)
    }

    /// The middle of both states. A point of the boundary is on the line between them, at most half their distance
    /// from the middle.
    pub fn middle(&self) -> Vec<f64> {
        middle(&self.first.0, &self.second.0)
    }
}

fn middle(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter().zip(other).map(|(a, b)| 0.5 * a + 0.5 * b).collect()
}

/// Two states of different basins, at most `precision` apart, on the line between two given states.
///
/// The line is halved. If its middle belongs to a third basin, the half with the first state is kept, so that the
/// second label changes. If the middle is undecided, or outside the region of interest, the search ends, and says
/// so: nothing is guessed. Where `f64` has no number between the two states, they remain farther apart.
///
/// ```
/// use basin_of_attraction::{Label, boundary_between};
/// let inside = |x: &[f64]| Label::from(x[0] * x[0] + x[1] * x[1] < 2.0);
/// let found = boundary_between(&[0.0, 0.0], &[3.0, 3.0], 1e-12, inside)?;
/// assert!(found.undecided.is_none() && (found.middle()[1] - 1.0).abs() < 1e-12);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::NotTwoBasins`] unless both states have the labels of two basins; [`Error::WrongDimension`] for states of
/// different dimensions; [`Error::BadPoint`] for a coordinate that is not finite; [`Error::BadSearch`] unless
/// `precision` is positive and finite.
pub fn boundary_between(
    first: &[f64],
    second: &[f64],
    precision: f64,
    label: impl Fn(&[f64]) -> Label,
) -> Result<BoundaryBracket, Error> {
    if first.len() != second.len() {
        return Err(Error::WrongDimension { dimension: second.len(), expected: first.len() });
    }
    check_point(first)?;
    check_point(second)?;
    if !(precision > 0.0 && precision.is_finite()) {
        return Err(Error::BadSearch { name: "a precision", value: precision, remedy: "" });
    }
    let labels = (label(first), label(second));
    if !labels.0.is_decided() || !labels.1.is_decided() || labels.0 == labels.1 {
        return Err(Error::NotTwoBasins { first: labels.0, second: labels.1 });
    }
    let mut found = BoundaryBracket {
        first: (first.to_vec(), labels.0),
        second: (second.to_vec(), labels.1),
        undecided: None,
    };
    while found.distance() > precision {
        let at = found.middle();
        // No number lies between the two states.
        if at == found.first.0 || at == found.second.0 {
            break;
        }
        let own = label(&at);
        if !own.is_decided() {
            found.undecided = Some((at, own));
            break;
        }
        if own == found.first.1 { found.first.0 = at } else { found.second = (at, own) }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bracket_has_two_basins_and_ends_at_what_is_undecided() {
        let thirds = |x: &[f64]| Label::from((3.0 * x[0]) as u8);
        let found = boundary_between(&[0.1], &[0.9], 1e-13, thirds).unwrap();
        assert!(found.first.1 != found.second.1 && found.distance() <= 1e-13);
        let near = |b: f64| (found.middle()[0] - b).abs() < 1e-12;
        assert!(near(1.0 / 3.0) || near(2.0 / 3.0));
        let gap = |x: &[f64]| match x[0] {
            ..0.5 => Label::from(0),
            ..0.6 => Label::UNDECIDED,
            _ => Label::from(1),
        };
        let found = boundary_between(&[0.0], &[1.0], 1e-13, gap).unwrap();
        let (at, own) = found.undecided.clone().unwrap();
        assert!(own == Label::UNDECIDED && gap(&at) == own);
        assert!(found.first.0[0] < at[0] && at[0] < found.second.0[0]);
        assert!(found.distance() <= 1.0 && found.distance() > 0.1);
        // To the last bit, without an endless loop.
        let step = |x: &[f64]| Label::from(x[0] > 1e300);
        let found = boundary_between(&[0.0], &[f64::MAX], 1e-300, step).unwrap();
        assert_eq!(found.first.0[0].next_up(), found.second.0[0]);
    }

    #[test]
    fn states_that_are_not_in_two_basins_are_refused() {
        let all = |_: &[f64]| Label::from(0);
        let none = |_: &[f64]| Label::UNDECIDED;
        let error = boundary_between(&[0.0], &[1.0], 0.1, all).unwrap_err();
        assert!(matches!(error, Error::NotTwoBasins { .. }));
        assert!(boundary_between(&[0.0], &[1.0], 0.1, none).is_err());
        let right = |x: &[f64]| Label::from(x[0] > 0.5);
        assert!(matches!(
            boundary_between(&[0.0], &[1.0, 2.0], 0.1, right),
            Err(Error::WrongDimension { .. })
        ));
        for precision in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(boundary_between(&[0.0], &[1.0], precision, right).is_err());
        }
        assert!(boundary_between(&[0.0], &[f64::NAN], 0.1, right).is_err());
    }
}
