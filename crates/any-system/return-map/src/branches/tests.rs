//! Numbers that change their signs at bifurcations.

use super::branch::BifurcationKind;
use super::curve::{OnCurve, bordered};
use super::orbit::{derivative, eigenvalues};
use nalgebra::{Complex, DMatrix, DVector};

/// A number that changes its sign at a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Test {
    /// dp/ds: it is zero where the branch turns back.
    Turn,
    /// The determinant of slopes and tangent: it is zero where another branch crosses this one.
    Cross,
    /// The determinant of Dfⁿ + 1.
    Flip,
    /// The product of μᵢ μⱼ − 1 over all pairs of multipliers.
    Circle,
}

pub(super) const TESTS: [Test; 4] = [Test::Turn, Test::Cross, Test::Flip, Test::Circle];

/// Two multipliers whose product is 1 are on the unit circle if they are not real.
const ON_CIRCLE: f64 = 1e-6;

impl Test {
    /// The number at a point of a branch.
    pub(super) fn value(self, point: &OnCurve, scales: &DVector<f64>) -> f64 {
        let last = point.tangent.len() - 1;
        match self {
            Test::Turn => point.tangent[last],
            Test::Cross => bordered(&point.slopes, &point.tangent).determinant(),
            Test::Flip => {
                let matrix = derivative(&point.slopes, scales);
                (&matrix + DMatrix::identity(last, last)).determinant()
            }
            Test::Circle => circle(&eigenvalues(&derivative(&point.slopes, scales))),
        }
    }

    /// The bifurcation at which the number is zero; `None` if it is zero without one.
    pub(super) fn kind(self, multipliers: &[Complex<f64>]) -> Option<BifurcationKind> {
        match self {
            Test::Turn => Some(BifurcationKind::Fold),
            Test::Cross => Some(BifurcationKind::Transcritical),
            Test::Flip => Some(BifurcationKind::Doubling),
            Test::Circle => {
                let is_on =
                    |m: &Complex<f64>| m.im.abs() > ON_CIRCLE && (m.norm() - 1.0).abs() < ON_CIRCLE;
                multipliers.iter().any(is_on).then_some(BifurcationKind::NeimarkSacker)
            }
        }
    }
}

/// The product of μᵢ μⱼ − 1: real, as multipliers come in conjugate pairs. 1 for a single one.
fn circle(multipliers: &[Complex<f64>]) -> f64 {
    let mut product = Complex::new(1.0, 0.0);
    for (k, first) in multipliers.iter().enumerate() {
        for second in &multipliers[k + 1..] {
            product *= first * second - 1.0;
        }
    }
    product.re
}
