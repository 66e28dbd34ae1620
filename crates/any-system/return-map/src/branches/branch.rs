//! What a branch consists of.

use crate::families::Border;
use nalgebra::Complex;

/// A branch of fixed points, periodic points or equilibria, from one end to the other.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Branch {
    /// The period n of its points: fⁿ(x; p) = x. 0 for equilibria.
    pub period: usize,
    /// The points, in order.
    pub points: Vec<BranchPoint>,
    /// The bifurcations, in the same order.
    pub bifurcations: Vec<Bifurcation>,
    /// Why it ends before its first point, and behind its last one.
    pub ends: [BranchEnd; 2],
}

/// A point of a branch.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BranchPoint {
    /// The point x.
    pub point: Vec<f64>,
    /// The parameter p.
    pub parameter: f64,
    /// The multipliers: the eigenvalues of the derivative of fⁿ. For an equilibrium the eigenvalues of the derivative of the field.
    pub multipliers: Vec<Complex<f64>>,
    /// How far each multiplier may be from the exact one: an estimate, to first order, from the [errors](crate::Linearized::errors) of the
    /// derivatives, and of an orbit of several points from the rounding of its first one.
    pub multiplier_errors: Vec<f64>,
    /// True if the point attracts: all multipliers are inside the unit circle, all eigenvalues of a field left of the imaginary axis.
    pub is_stable: bool,
    /// The pieces of the map that the orbit meets.
    pub itinerary: Vec<String>,
    /// The size of the first point of its branch, or 1 if that is zero: the unit of lengths.
    pub size: f64,
    /// How far the point is known: the last Newton step, in this unit.
    pub error: f64,
}

impl BranchPoint {
    /// The largest size of a multiplier; NaN if they are not known.
    pub fn spectral_radius(&self) -> f64 {
        let larger =
            |largest: f64, m: &Complex<f64>| if m.norm() > largest { m.norm() } else { largest };
        match self.multipliers.is_empty() {
            true => f64::NAN,
            false => self.multipliers.iter().fold(0.0, larger),
        }
    }
}

/// A bifurcation of a branch, located on it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bifurcation {
    /// What happens.
    pub kind: BifurcationKind,
    /// Where.
    pub at: BranchPoint,
    /// How far the parameter may be from the exact one: an estimate, from the error of the critical multiplier and from how fast it changes
    /// along the branch; at a crossing of branches from how far points on one side tell another place.
    pub error: f64,
    /// The eigenvector of the critical multiplier, of length 1; for a Neimark–Sacker or Hopf bifurcation its real part, at any phase.
    pub direction: Vec<f64>,
    /// The coefficient of the normal form, with the eigenvector of length 1; `None` if it is not known, and at the strong resonances μ³ = 1
    /// and μ⁴ = 1 of a Neimark–Sacker bifurcation, where no coefficient alone tells what begins.
    ///
    /// | kind | normal form | meaning |
    /// |---|---|---|
    /// | fold | ξ + a ξ² | not zero: two points meet |
    /// | doubling | −ξ + b ξ³ | b > 0: the orbit of twice the period is stable (supercritical) |
    /// | Neimark–Sacker | e^(iθ) ζ (1 + d \|ζ\|²) | Re d < 0: the invariant circle is stable (supercritical) |
    /// | Hopf | iω ζ + c ζ \|ζ\|² | Re c/ω, Kuznetsov's l₁: below 0 the cycle is stable (supercritical) |
    /// | transcritical | ξ + a ξ² | not zero: two branches cross |
    /// | pitchfork | ξ + c ξ³ | c < 0: the other branches are stable (supercritical) |
    pub coefficient: Option<f64>,
}

/// What happens at a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BifurcationKind {
    /// A multiplier is 1, and the branch turns back: two points are born or vanish.
    Fold,
    /// A multiplier is −1: a branch of twice the period begins.
    Doubling,
    /// Two multipliers pass the unit circle: an invariant circle begins.
    NeimarkSacker,
    /// Two eigenvalues of an equilibrium pass the imaginary axis: a cycle begins.
    Hopf,
    /// A multiplier is 1, and another branch crosses this one.
    Transcritical,
    /// A multiplier is 1, and another branch crosses this one and lies on one side of the parameter.
    Pitchfork,
}

/// Why a branch ends.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BranchEnd {
    /// At the border of the window, on it.
    Window,
    /// The branch comes back to its first point.
    Closed,
    /// It begins at a doubling.
    Doubling,
    /// The limit on the number of points.
    PointLimit,
    /// It was stopped.
    Stopped,
    /// The orbit meets other pieces of the map behind this point: a border collision; for a return map a grazing, two events at one
    /// instant, an onset of sliding or of complete chattering.
    Border {
        /// What lies there.
        border: Border,
        /// The point on the border, to rounding where the map goes on smoothly beyond it; else the last one that was found on its own
        /// pieces: so near to the border as derivatives by differences lead, which at an infinite slope is some 10⁻⁵ of the window. Its
        /// multipliers are those of the last point before the border: at a grazing they may be infinite.
        at: BranchPoint,
        /// The pieces behind the border, where they are known.
        beyond: Vec<String>,
        /// Where the two sequences of pieces differ first: so many events are the same on both sides.
        place: usize,
    },
    /// No further point was found, however short the step: with the reason of the last try.
    Lost {
        /// The reason, in words.
        reason: String,
    },
}
