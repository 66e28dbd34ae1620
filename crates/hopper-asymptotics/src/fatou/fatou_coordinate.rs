//! The Fatou coordinate on one side of a fixed point: the number of hops, counted continuously.
//!
//! Proof: docs/theory.md, Section 16.

use crate::coefficients::{Coefficients, Form};
use crate::error::Error;
use crate::fatou::abel_series::AbelSeries;
use crate::fatou::leading_term::leading_term;
use crate::fatou::local_hop_model::Side;
use crate::fatou::offset::Offset;
use crate::fatou::phase::Phase;
use crate::fatou::slow_hops::{inward, outward};
use passive_hopper::{LiftOffMap, MassRatio};

/// The Fatou coordinate Ψ of α*_n on one side: the number of hops to leave it, or since the approach began.
///
/// ```text
///   left    Ψ(f(δ)) = Ψ(δ) − 1     A = 10λ/3      c = −2 − 3β/(10λα*)
///   right   Ψ(f(δ)) = Ψ(δ) + 1     A = λ/3        c =  2 + 3β/(λα*)
///
///   Ψ = 1/(A x) + c ln x + d₁ x + d₂ x² + …       x = |δ|^{1/3}
/// ```
///
/// The equation of the first column is Abel's equation. It has one solution for which Ψ − 1/(Ax) − c ln x → 0 as x → 0
/// (docs/theory.md, Section 16). The series is asymptotic and does not converge. Here it has a bound on its error, from Taylor
/// models of the hop.
///
/// On the left the fate of a point depends on the [fraction](Phase::fraction) of Ψ alone, however near to α*_n it is.
///
/// ```
/// use hopper_asymptotics::{FatouCoordinate, Offset, Side};
/// use passive_hopper::MassRatio;
/// let psi = FatouCoordinate::new(2, MassRatio::new(0.2)?, Side::Left)?;
/// // The orbit from 10⁻¹² below α*_2 leaves after some 850 hops.
/// let phase = psi.phase(Offset::from(-1e-12))?;
/// assert_eq!(phase.whole().to_string(), "850");
/// assert!(phase.error() < 1e-12);
/// // From 10⁻³⁰⁰ it takes 8·10⁹⁸ hops, and the fraction is known all the same.
/// let phase = psi.phase("-1e-300".parse()?)?;
/// assert_eq!(phase.whole().to_string().len(), 99);
/// assert!(phase.error() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct FatouCoordinate {
    n: u64,
    side: Side,
    map: LiftOffMap,
    local: Coefficients,
    series: AbelSeries,
}

/// A value of Ψ as one `f64`, for points that are not too near.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HopCount {
    /// The number of hops, not an integer as a rule.
    pub hops: f64,
    /// Bound on its error.
    pub error: f64,
}

/// A point that an orbit reaches along the slow side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowJump {
    /// The number of hops that were jumped over.
    pub hops: u64,
    /// The offset after them.
    pub delta: f64,
    /// Bound on its error.
    pub error: f64,
    /// Ψ after them. All jumps at one mass ratio end on the same turn: the number is the same for the same fraction.
    pub count: HopCount,
}

/// The largest number of hops of one [`SlowJump`]: an `f64` up to it has its digit of one half.
const LARGEST_JUMP: f64 = 4.5e15;

impl FatouCoordinate {
    /// The coordinate at α*_n. It takes about a tenth of a millisecond.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0; [`Error::Drift`] where the mass ratio is so extreme, or n so large, that the series has no
    /// bound.
    pub fn new(n: u64, mass_ratio: MassRatio, side: Side) -> Result<Self, Error> {
        let local = Coefficients::new(n, mass_ratio, Form::Corrected)?;
        let series = AbelSeries::new(&local, mass_ratio, side)?;
        Ok(FatouCoordinate { n, side, map: LiftOffMap::new(mass_ratio), local, series })
    }

    /// The side of the fixed point.
    pub fn side(&self) -> Side {
        self.side
    }

    /// A, the coefficient of the leading term 1/(A x).
    pub fn drift(&self) -> f64 {
        self.series.drift()
    }

    /// c, the coefficient of ln x.
    pub fn logarithm(&self) -> f64 {
        self.series.logarithm()
    }

    /// d_k, the coefficient of x^k; `None` from the first term on that the series does not have.
    pub fn coefficient(&self, k: usize) -> Option<f64> {
        self.series.coefficient(k)
    }

    /// The largest |δ| at which the series is used. A point farther away is followed towards α*_n, and its hops are counted.
    pub fn range(&self) -> f64 {
        let root = self.series.range();
        root * root * root
    }

    /// The largest |δ| that has a phase: 10⁻³/(1 + λ³) on the left, 10⁻³/λ³ on the right, and at most 10⁻³.
    ///
    /// On the left the loss of a hop is at most |δ| there. On the right it is about a thousandth of the length of the trap.
    pub fn reach(&self) -> f64 {
        let cube = self.local.lambda * self.local.lambda * self.local.lambda;
        let reach = match self.side {
            Side::Left => 1e-3 / (1.0 + cube),
            Side::Right => (1e-3 / cube).min(1e-3),
        };
        reach.max(self.range())
    }

    /// Ψ at `delta`, to as many digits as the fraction needs.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] for an offset that is zero, on the other side, or beyond [`reach`](Self::reach);
    /// [`Error::Hop`] if a hop towards α*_n has no value.
    pub fn phase(&self, delta: Offset) -> Result<Phase, Error> {
        let near = delta.nearest();
        self.check(delta.mantissa() * self.side.sign() > 0.0, near)?;
        if near.abs() > self.range() {
            let (inner, hops, error) = inward(&self.map, self.n, near, self.range(), self.drift())?;
            let count = self.count_within(inner, 0.0)?;
            return Ok(Phase::new(-hops, count.hops, count.error + error));
        }
        let (logarithm, _) = delta.logarithm_in_two_parts();
        let size = -logarithm / (3.0 * std::f64::consts::LN_2) - pxfm::f_log2(self.drift());
        let cube = if self.side == Side::Left { 1 } else { 1000 };
        let ratio = self.map.mass_ratio().value();
        let digits = leading_term(self.n, ratio, delta, cube, size);
        let (whole, rest, error) = self.series.beyond_leading(delta);
        // The fraction has 64 bits, of which an `f64` keeps 53.
        let fraction = digits.fraction as f64 * 0.5_f64.powi(64);
        let sum = Phase::new(digits.whole, fraction + rest, error + f64::EPSILON);
        Ok(sum.plus(whole as i64))
    }

    /// Ψ for all offsets within `error` of `delta`, in `f64`: faster than [`phase`](Self::phase), with an error of some ulps of
    /// the number of hops, and up to 10⁻⁶ at the largest offsets.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] unless all these offsets are on this side and near enough: up to some 30 times
    /// [`range`](Self::range).
    pub fn count_within(&self, delta: f64, error: f64) -> Result<HopCount, Error> {
        let size = delta.abs();
        let (least, most) = (size - error, size + error);
        let inside = least > 0.0 && most <= self.whole_range();
        self.check(delta * self.side.sign() > 0.0 && inside, delta)?;
        let value = self.series.value(pxfm::f_cbrt(size));
        if error == 0.0 {
            return Ok(value);
        }
        // Ψ is monotone: its values lie between those at the ends.
        let spread = |size: f64| {
            let end = self.series.value(pxfm::f_cbrt(size));
            (end.hops - value.hops).abs() + end.error
        };
        let error = value.error.max(spread(least)).max(spread(most));
        Ok(HopCount { hops: value.hops, error })
    }

    /// The offset with the given phase, as near as `f64` digits give it, and the relative error of the offset.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] for a phase whose offset is beyond [`reach`](Self::reach).
    pub fn offset(&self, phase: &Phase) -> Result<(Offset, f64), Error> {
        let (mantissa, exponent) = phase.scaled();
        let nearest = self.series.nearest();
        // Far beyond `f64` only the leading term and the logarithm count.
        if exponent > 900 {
            let (delta, error) = self.series.deep_offset(mantissa, exponent);
            return Ok((delta.with_sign(self.side.sign()), error));
        }
        let hops = mantissa * 2f64.powi(exponent as i32);
        let beyond = nearest.hops + nearest.error - hops;
        if beyond <= 0.0 {
            let (delta, error) = self.offset_at(HopCount { hops, error: phase.error() });
            return Ok((Offset::from(delta), error / delta.abs()));
        }
        // Whole hops from inside the range; on the right the hops lead inwards, and the offset is a preimage.
        let whole = beyond.ceil();
        let start = HopCount { hops: hops + whole, error: phase.error() };
        let (delta, error) = self.offset_at(start);
        let (delta, error) = outward(&self.map, self.n, (delta, error), whole, self.reach())?;
        Ok((Offset::from(delta), error / delta.abs()))
    }

    /// The point with the same fraction that an orbit on the left reaches later: the one of the last turn on which the series
    /// has an error below 10⁻⁸. `None` if the error of Ψ exceeds `largest`, or the offset is beyond this turn.
    pub fn jump(&self, delta: f64, error: f64, largest: f64) -> Option<SlowJump> {
        let count = self.count_within(delta, error).ok()?;
        let first = self.series.end_of_jump();
        let hops = (count.hops - first).floor();
        if !(count.error <= largest && hops >= 0.0 && hops <= LARGEST_JUMP) {
            return None;
        }
        Some(self.land(hops as u64, HopCount { hops: count.hops - hops, ..count }))
    }

    /// The |δ| beyond which a [`jump`](Self::jump) has nothing to jump over.
    pub fn jump_range(&self) -> f64 {
        let root = self.series.first_of_jump();
        root * root * root
    }

    fn land(&self, hops: u64, count: HopCount) -> SlowJump {
        let (delta, error) = self.offset_at(count);
        SlowJump { hops, delta, error, count }
    }

    /// As [`jump`](Self::jump), from `delta` + `rest`, at most half an ulp apart, with the longer [`phase`](Self::phase).
    pub fn long_jump(
        &self,
        (delta, rest): (f64, f64),
        error: f64,
        largest: f64,
    ) -> Option<SlowJump> {
        self.check(delta * self.side.sign() > 0.0 && delta.abs() <= self.range(), delta).ok()?;
        let phase = self.phase(Offset::from(delta)).ok()?;
        let whole = i64::try_from(phase.whole()).ok().filter(|&whole| whole < LARGEST_JUMP as i64)?;
        let root = pxfm::f_cbrt(delta.abs());
        let slope = self.series.slope(root) * self.side.sign() / (3.0 * root * root); // dΨ/dδ
        // The exact slope lies within half of this one (docs/theory.md, Section 16). An error as large as δ has no
        // meaning; `largest` refuses it.
        let error = phase.error() + 1.5 * error * slope.abs() + 0.5 * (rest * slope).abs();
        let fraction = phase.fraction() + rest * slope;
        let nearest = self.series.nearest();
        let last = (nearest.hops + nearest.error + error - fraction).ceil();
        let hops = whole.checked_sub(last as i64).filter(|&hops| hops >= 0)?;
        if !(error <= largest) {
            return None;
        }
        Some(self.land(hops as u64, HopCount { hops: last + fraction, error }))
    }

    /// The smallest Ψ of the turn on which a [`jump`](Self::jump) ends.
    pub fn turn_of_jumps(&self) -> f64 {
        self.series.end_of_jump()
    }

    /// The offset at which Ψ has this value, from [`turn_of_jumps`](Self::turn_of_jumps) up, and a bound on its error.
    pub fn offset_at(&self, count: HopCount) -> (f64, f64) {
        let (root, error) = self.series.root_at(count);
        // d(x³) = 3x² dx; the factor covers the roundings of the cube and the second order.
        let cube = root * root * root;
        (self.side.sign() * cube, 3.1 * root * root * error + 2.0 * f64::EPSILON * cube)
    }

    fn whole_range(&self) -> f64 {
        let whole = self.series.whole();
        whole * whole * whole
    }

    fn check(&self, inside: bool, delta: f64) -> Result<(), Error> {
        let reach = self.reach();
        if inside && delta.abs() <= reach.max(self.whole_range()) {
            return Ok(());
        }
        let (left, right) = match self.side {
            Side::Left => (-reach, 0.0),
            Side::Right => (0.0, reach),
        };
        Err(Error::OutsideRange { value: delta, left, right })
    }
}
