//! The Fatou coordinate on one side of a fixed point: the number of hops, counted continuously.
//!
//! Proof: docs/theory.md, Section 16.

use crate::coefficients::{Coefficients, Form};
use crate::error::Error;
use crate::fatou::abel_series::{AbelSeries, cube_error};
use crate::fatou::hop_count::HopCount;
use crate::fatou::leading_term::exact_terms;
use crate::fatou::local_hop_model::Side;
use crate::fatou::offset::Offset;
use crate::fatou::outward_walk::OutwardWalk;
use crate::fatou::phase::Phase;
use crate::fatou::slow_hops::{MOST_HOPS, inward, outward};
use passive_hopper::{LiftOffMap, MassRatio};
use std::f64::consts::LN_2;

/// The Fatou coordinate Ψ of α*_n on one side: the number of hops to leave it, or since the approach began.
///
/// ```text
///   left    Ψ(f(δ)) = Ψ(δ) − 1     A = 10λ/3      c = −2 − 3β/(10λα*)
///   right   Ψ(f(δ)) = Ψ(δ) + 1     A = λ/3        c =  2 + 3β/(λα*)
///
///   Ψ = 1/(A x) + c ln x + d₁ x + d₂ x² + …       x = |δ|^{1/3}
/// ```
///
/// The equation of the first column is Abel's equation. It has one solution for which Ψ − 1/(Ax) − c ln x → 0 as x
/// → 0 (docs/theory.md, Section 16). The series is asymptotic and does not converge. Here it has a bound on its
/// error, from Taylor models of the hop.
///
/// On the left the fate of a point depends on the [fraction](Phase::fraction) of Ψ alone, however near to α*_n it is.
///
/// ```
/// use hopper_asymptotics::{FatouCoordinate, Offset, Side};
/// use passive_hopper::MassRatio;
/// let psi = FatouCoordinate::new(2, MassRatio::new(0.2)?, Side::Left)?;
/// // The orbit from 10⁻¹² below α*_2 leaves after 851 hops.
/// let phase = psi.phase(Offset::from(-1e-12))?;
/// assert_eq!(phase.whole().to_string(), "851");
/// assert!(phase.error() < 1e-14);
/// // From 10⁻³⁰⁰ it takes 8·10⁹⁸ hops, and the fraction is known all the same.
/// let phase = psi.phase("-1e-300".parse()?)?;
/// assert_eq!(phase.whole().to_string().len(), 99);
/// assert!(phase.error() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct FatouCoordinate {
    n: u64,
    pub(crate) side: Side,
    map: LiftOffMap,
    local: Coefficients,
    pub(crate) series: AbelSeries,
}

/// Beyond A Ψ = 2^`DEEP_BITS` an offset is found from the leading term alone. The other terms are smaller by a
/// factor of at least 2²⁰⁰, and x³ is a normal number up to there.
const DEEP_BITS: f64 = 300.0;

/// The largest relative error of the x of a phase.
const LARGEST_ERROR: f64 = 0.5;

/// The largest relative error of an offset that is followed by hops. The slope of the map changes by less than a
/// twentieth over it.
const SMALL_ERROR: f64 = 0.05;

impl FatouCoordinate {
    /// The coordinate at α*_n. It takes some 50 microseconds.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0; [`Error::Drift`] where the mass ratio is so extreme, or n so large, that the
    /// series has no bound.
    pub fn new(n: u64, mass_ratio: MassRatio, side: Side) -> Result<Self, Error> {
        if side == Side::Left {
            return Self::along(&OutwardWalk::new(n, mass_ratio)?);
        }
        let local = Coefficients::new(n, mass_ratio, Form::Corrected)?;
        let series = AbelSeries::on_the_right(&local, mass_ratio)?;
        Ok(FatouCoordinate { n, side, map: LiftOffMap::new(mass_ratio), local, series })
    }

    /// The coordinate on the left of the fixed point that the walk leaves, from the same Taylor models of a hop. It
    /// equals that of [`new`](Self::new), which makes these models again.
    ///
    /// # Errors
    /// [`Error::Drift`] as for [`new`](Self::new).
    pub fn along(walk: &OutwardWalk) -> Result<Self, Error> {
        let OutwardWalk { local, mass_ratio, ref hop, .. } = *walk;
        let series = AbelSeries::on_the_left(&local, hop)?;
        let map = LiftOffMap::new(mass_ratio);
        Ok(FatouCoordinate { n: local.n, side: Side::Left, map, local, series })
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

    /// The largest |δ| at which the series is used. A point farther away is followed towards α*_n, and its hops are
    /// counted.
    pub fn range(&self) -> f64 {
        let root = self.series.range();
        root * root * root
    }

    /// The largest |δ| that has a phase.
    ///
    /// ```text
    ///   left    10⁻³/λ³, where the loss of a hop is |δ|;      at most 0.0109, for M ≤ 1 at most 0.0586
    ///   right   8·10⁻³/λ³, where the loss is a fifth of δ;    at most 0.0046
    /// ```
    ///
    /// So the error of a phase is at most 10⁻¹² for n ≤ 10 and M from 0.02 to 50. Up to there f rises, and a hop
    /// has one sudden lift-off on the left (docs/theory.md, Theorem 81) and none on the right.
    pub fn reach(&self) -> f64 {
        let cube = self.local.lambda * self.local.lambda * self.local.lambda;
        let (reach, most) = match self.side {
            Side::Left if self.map.mass_ratio().value() <= 1.0 => (1e-3 / cube, 0.0586),
            Side::Left => (1e-3 / cube, 0.0109),
            Side::Right => (8e-3 / cube, 4.6e-3),
        };
        reach.min(most).max(self.range())
    }

    /// Ψ at `delta`, to as many digits as the fraction needs.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] for an offset that is zero, on the other side, or beyond [`reach`](Self::reach), and
    /// for one that is more than 10 000 hops beyond [`range`](Self::range), which happens for M below some 10⁻⁴;
    /// [`Error::Offset`] for an exponent beyond [`Offset::LARGEST_EXPONENT`]; [`Error::Hop`] if a hop towards α*_n
    /// has no value.
    pub fn phase(&self, delta: Offset) -> Result<Phase, Error> {
        let delta = Offset::new(delta.mantissa(), delta.exponent())?;
        let near = delta.nearest();
        self.check(delta.mantissa() * self.side.sign() > 0.0 && near.abs() <= self.reach(), near)?;
        if near.abs() > self.range() {
            let (inner, hops, error) = inward(&self.map, self.n, near, self.range())?;
            let phase = self.phase_within_range(inner.into(), inner);
            return Ok(Phase::new(phase.whole() - hops, phase.fraction(), phase.error() + error));
        }
        Ok(self.phase_within_range(delta, near))
    }

    /// Ψ by the series. `near` is `delta` rounded.
    fn phase_within_range(&self, delta: Offset, near: f64) -> Phase {
        let size = -(delta.logarithm() / 3.0 + pxfm::f_log(self.drift())) / LN_2;
        let ratio = self.map.mass_ratio().value();
        let exact = exact_terms(self.n, ratio, self.side, delta, size);
        let (rest, error) = self.series.beyond_exact(near);
        Phase::new(exact.whole, exact.fraction + rest, error)
    }

    /// Ψ for all offsets within `error` of `delta`, in `f64`: faster than [`phase`](Self::phase), with an error of
    /// some ulps of the number of hops, and up to 10⁻⁶ at the largest offsets.
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

    /// The offset with the given phase, as near as `f64` digits give it, and a bound on its relative error.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] for a phase whose offset is beyond [`reach`](Self::reach), or more than 10 000 hops
    /// beyond [`range`](Self::range); [`Error::Phase`] for a phase that is known so badly that its offset has no bound.
    pub fn offset(&self, phase: &Phase) -> Result<(Offset, f64), Error> {
        let (mantissa, exponent) = phase.scaled();
        let unknown = |hops| Error::Phase { hops, error: phase.error() };
        // 1/x is about A Ψ, and only the leading term counts.
        if mantissa > 0.0 && exponent as f64 + pxfm::f_log(self.drift()) / LN_2 > DEEP_BITS {
            // In two steps, since an error may be as large as an `f64`. One below 2⁻⁹⁰⁰ does not count.
            let half = 0.5f64.powi(exponent.min(2000) as i32 / 2);
            let error = 2.0 * phase.error() * half * half / mantissa;
            if !(error <= LARGEST_ERROR) {
                return Err(unknown(mantissa * 2f64.powi(exponent.min(1024) as i32)));
            }
            let (delta, error) = self.series.deep_offset(mantissa, exponent, error);
            return Ok((delta.with_sign(self.side.sign()), error));
        }
        let nearest = self.series.nearest();
        let hops = mantissa * 2f64.powi(exponent.min(1024) as i32);
        let least = nearest.hops + nearest.error + phase.error().min(MOST_HOPS as f64);
        let whole = (least - hops).ceil().max(0.0);
        if !(whole <= MOST_HOPS as f64 && hops.is_finite()) {
            let left = nearest.hops - MOST_HOPS as f64;
            return Err(Error::OutsideRange { value: hops, left, right: f64::MAX });
        }
        // From inside the range whole hops lead out; on the right they are inverted.
        let rounding = 2.0 * f64::EPSILON * hops.abs();
        let start = HopCount { hops: hops + whole, error: phase.error() + rounding };
        let (root, error) = self.series.root_at(start);
        let start = (self.side.sign() * root * root * root, cube_error(error));
        if !(error <= LARGEST_ERROR) {
            return Err(unknown(hops));
        }
        let (delta, error) = outward(&self.map, self.n, start, whole as i64, self.reach())?;
        // The hops carry a small error only.
        if whole > 0.0 && !(error <= SMALL_ERROR) {
            return Err(unknown(hops));
        }
        Ok((Offset::from(delta), error))
    }

    /// The offset at which Ψ has this value, from [`turn_of_jumps`](Self::turn_of_jumps) up, and a bound on its
    /// error, which is infinite if the value is not among those of the series.
    pub fn offset_at(&self, count: HopCount) -> (f64, f64) {
        let (root, error) = self.series.root_at(count);
        let cube = root * root * root;
        (self.side.sign() * cube, cube_error(error) * cube)
    }

    fn whole_range(&self) -> f64 {
        let whole = self.series.whole();
        whole * whole * whole
    }

    fn check(&self, inside: bool, delta: f64) -> Result<(), Error> {
        if inside {
            return Ok(());
        }
        let reach = self.reach();
        let (left, right) = match self.side {
            Side::Left => (-reach, 0.0),
            Side::Right => (0.0, reach),
        };
        Err(Error::OutsideRange { value: delta, left, right })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coordinates() -> impl Iterator<Item = FatouCoordinate> {
        let ratios = [0.02, 0.05, 0.12, 0.2, 0.5, 0.8, 1.0, 3.0, 10.0, 50.0];
        let all = (1..=10).flat_map(move |n| ratios.map(|m| (n, MassRatio::new(m).unwrap())));
        all.flat_map(|(n, m)| {
            [Side::Left, Side::Right].map(|side| FatouCoordinate::new(n, m, side).unwrap())
        })
    }

    /// On the right Ψ is negative at the end of the series for large n, and vanishes inside.
    #[test]
    fn roots_are_inverses_where_the_phase_vanishes() {
        for (n, m) in [(216, 0.3), (1_000_000, 1.0), (1, 0.02), (3, 50.0)] {
            for side in [Side::Left, Side::Right] {
                let psi = FatouCoordinate::new(n, MassRatio::new(m).unwrap(), side).unwrap();
                let series = &psi.series;
                for part in [0.9, 0.5, 0.1, 1e-3, 1e-9, 1e-60] {
                    let x = part * series.whole();
                    let (found, error) = series.root_at(series.value(x));
                    assert!((found / x - 1.0).abs() <= error, "{n} {m} {part}: {found:e} {x:e}");
                    assert!(error < 1e-5, "{n} {m} {part}: {error:e}");
                }
                let first = series.value(series.whole()).hops;
                for (hops, error) in [(first - 5.0, 0.0), (first + 20.0, 15.0), (f64::NAN, 0.0)] {
                    assert!(series.root_at(HopCount { hops, error }).1.is_infinite());
                }
            }
        }
    }

    #[test]
    fn phases_of_doubles_err_by_at_most_a_trillionth_and_are_inverted() {
        for psi in coordinates() {
            let mut size = psi.reach();
            while size >= 1e-15 {
                let delta = psi.side().sign() * size;
                let phase = psi.phase(delta.into()).unwrap();
                assert!(phase.error() <= 1e-12, "{} {delta:e}: {phase}", psi.n);
                let (back, error) = psi.offset(&phase).unwrap();
                let off = (back.nearest() / delta - 1.0).abs();
                assert!(off <= error && error < 1e-11, "{} {delta:e}: {off:e} {error:e}", psi.n);
                size *= 0.5;
            }
        }
    }

    #[test]
    fn deep_phases_have_all_digits_of_the_fraction() {
        for psi in coordinates().step_by(7) {
            for exponent in [-30, -300, -320, -400, -815, -1000] {
                let delta = Offset::new(2.5 * psi.side().sign(), exponent).unwrap();
                let phase = psi.phase(delta).unwrap();
                assert!(phase.error() < 3e-15, "{} {delta}: {phase}", psi.n);
                let (back, error) = psi.offset(&phase).unwrap();
                let off = 10f64.powi((back.exponent() - exponent) as i32);
                let off = (back.mantissa() * off / delta.mantissa() - 1.0).abs();
                assert!(off <= error && error < 1e-10, "{} {delta}: {off:e} {error:e}", psi.n);
            }
        }
    }

    #[test]
    fn phases_without_an_offset_are_errors() {
        let huge = num_bigint::BigInt::from(10).pow(400);
        for (n, m) in [(2, 0.2), (1, 1e-9), (1, 1.0), (1_000_000, 1.0)] {
            for side in [Side::Left, Side::Right] {
                let psi = FatouCoordinate::new(n, MassRatio::new(m).unwrap(), side).unwrap();
                for phase in [Phase::new(-huge.clone(), 0.0, 0.0), Phase::new(-20_000, 0.5, 0.0)] {
                    let error = psi.offset(&phase).unwrap_err();
                    assert!(matches!(error, Error::OutsideRange { .. }), "{n} {m}: {error}");
                }
                for phase in [
                    Phase::new(huge.clone(), f64::NAN, 0.0),
                    Phase::new(1_i64 << 60, 0.5, 1e18),
                    Phase::new(huge.clone(), 0.5, f64::INFINITY),
                ] {
                    let error = psi.offset(&phase).unwrap_err();
                    assert!(matches!(error, Error::Phase { .. }), "{n} {m}: {error}");
                }
            }
        }
        // An error of 20 hops of 30: the offset may be twenty times as large.
        let psi = FatouCoordinate::new(2, MassRatio::new(1.0).unwrap(), Side::Left).unwrap();
        let error = psi.offset(&Phase::new(30, 0.5, 20.0)).unwrap_err();
        assert_eq!(error, Error::Phase { hops: 30.5, error: 20.0 });
    }

    #[test]
    fn offsets_end_at_the_reach() {
        for psi in coordinates() {
            let sign = psi.side().sign();
            assert!(psi.phase((sign * psi.reach()).into()).is_ok());
            assert!(psi.phase((sign * psi.reach() * 1.001).into()).is_err());
            assert!(psi.phase((-sign * 1e-9).into()).is_err());
        }
    }
}
