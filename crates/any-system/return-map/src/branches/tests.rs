//! Numbers that change their signs at bifurcations.

use super::branch::BifurcationKind;
use super::curve::{OnCurve, bordered};
use super::orbit::{Kind, Orbit};
use crate::multipliers::eigenvalues;
use nalgebra::{Complex, DMatrix};

/// How far a critical multiplier may be from its value: a double one is known to the root of its rounding, and one of an orbit of a long
/// period to that of many images.
pub(super) const CRITICAL: f64 = 1e-3;

/// A number that changes its sign at a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Test {
    /// dp/ds: it is zero where the branch turns back.
    Turn,
    /// The determinant of Dfⁿ − 1: it is zero where two points meet, too, but does not tell where the branch goes on.
    Meet,
    /// The determinant of slopes and tangent: it is zero where another branch crosses this one.
    Cross,
    /// The determinant of Dfⁿ + 1. It is no test of equilibria.
    Flip,
    /// The product of μᵢ μⱼ − 1 over all pairs of multipliers; of λᵢ + λⱼ for the eigenvalues of a field.
    Circle,
}

pub(super) const TESTS: [Test; 4] = [Test::Turn, Test::Cross, Test::Flip, Test::Circle];

/// Two multipliers whose product is 1 are on the unit circle if they are not real, two eigenvalues whose sum is zero on the imaginary axis.
/// A smaller number would refuse those of integrated maps.
const ON_CIRCLE: f64 = 1e-6;

/// A pair is not real above this imaginary part, beside the largest of all values: a double real one is known to the root of its rounding.
const NOT_REAL: f64 = 3e-8;

impl Test {
    /// The number at a point of a branch.
    pub(super) fn value<M: ?Sized>(self, point: &OnCurve, orbit: &Orbit<'_, M>) -> f64 {
        let last = point.tangent.len() - 1;
        match self {
            Test::Turn => point.tangent[last],
            Test::Meet => {
                let matrix = orbit.derivative(&point.slopes);
                let shift = orbit.kind.at_fold();
                (matrix - DMatrix::identity(last, last) * shift).determinant()
            }
            Test::Cross => bordered(&point.slopes, &point.tangent).determinant(),
            Test::Flip => {
                let matrix = orbit.derivative(&point.slopes);
                match orbit.kind {
                    Kind::Periodic(_) => (matrix + DMatrix::identity(last, last)).determinant(),
                    Kind::Equilibrium => 1.0,
                }
            }
            Test::Circle => circle(orbit.kind, &eigenvalues(&orbit.derivative(&point.slopes))),
        }
    }

    /// The number of the multiplier that is critical at the zero.
    pub(super) fn nearest(self, of: Kind, values: &[Complex<f64>]) -> Option<usize> {
        let off = |value: &Complex<f64>| match (self, of) {
            (Test::Flip, _) => (value + 1.0).norm(),
            (Test::Circle, Kind::Periodic(_)) => (value.norm() - 1.0).abs(),
            (Test::Circle, Kind::Equilibrium) => value.re.abs(),
            _ => (value - of.at_fold()).norm(),
        };
        (0..values.len()).min_by(|a, b| off(&values[*a]).total_cmp(&off(&values[*b])))
    }

    /// The bifurcation at which the number is zero; `None` if it is zero without one.
    pub(super) fn kind(self, of: Kind, values: &[Complex<f64>]) -> Option<BifurcationKind> {
        // A number that jumps, as where two pieces of a curve are taken for one, is zero at no bifurcation.
        let has = |target: f64| {
            values.iter().any(|value| (value - Complex::new(target, 0.0)).norm() < CRITICAL)
        };
        match self {
            Test::Turn | Test::Meet => has(of.at_fold()).then_some(BifurcationKind::Fold),
            Test::Cross => has(of.at_fold()).then_some(BifurcationKind::Transcritical),
            Test::Flip => has(-1.0).then_some(BifurcationKind::Doubling),
            Test::Circle => {
                let (off, found): (fn(&Complex<f64>) -> f64, _) = match of {
                    Kind::Periodic(_) => (|m| m.norm() - 1.0, BifurcationKind::NeimarkSacker),
                    Kind::Equilibrium => (|m| m.re, BifurcationKind::Hopf),
                };
                let largest = values.iter().fold(0.0, |largest: f64, m| largest.max(m.norm()));
                let size = |m: &Complex<f64>| match of {
                    Kind::Periodic(_) => 1.0,
                    Kind::Equilibrium => m.norm(),
                };
                let is_on = |m: &Complex<f64>| {
                    m.im.abs() > NOT_REAL * largest && off(m).abs() < ON_CIRCLE * size(m)
                };
                values.iter().any(is_on).then_some(found)
            }
        }
    }
}

/// The product over all pairs of eigenvalues: real, as they come in conjugate pairs. 1 for a single one.
fn circle(kind: Kind, values: &[Complex<f64>]) -> f64 {
    let mut product = Complex::new(1.0, 0.0);
    for (k, first) in values.iter().enumerate() {
        for second in &values[k + 1..] {
            product *= match kind {
                // Factors of size 1 at most: products of many neither vanish nor overflow.
                Kind::Periodic(_) => (first * second - 1.0) / (1.0 + (first * second).norm()),
                Kind::Equilibrium => {
                    (first + second) / (first.norm() + second.norm()).max(f64::MIN_POSITIVE)
                }
            };
        }
    }
    product.re
}
