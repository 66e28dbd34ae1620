//! A chart about a speed that comes to a fixed point exactly: windows of any width about it.

use crate::circle::edge_derivatives::edge_derivatives;
use crate::circle::edge_search::{Approach, MOST_HOPS, NEAR, approaches};
use crate::circle::local_fractions::LocalFractions;
use crate::circle::phase_basins::PhaseBasins;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::Label;
use hopper_asymptotics::{FatouCoordinate, Offset, Phase, Side};
use passive_hopper::{FixedPointSpeed, MassRatio};

/// A chart about a boundary point p with f^k(p) = α*_n: the speeds p + y.
///
/// ```text
///   f^k(p + y) = α*_n + δ,    δ = D₁ y (1 + D₂ y/2) + R,    |R| ≤ B |y|³ for |y| ≤ the radius
/// ```
///
/// On the side with δ > 0 the speeds next to p belong to the basin of α*_n. On the other side they show the circle
/// of fates of α*_n (docs/theory.md, Lemma 86). So the label of p + y is a look-up, also at y = 10⁻¹⁰⁰⁰.
///
/// D₁, D₂ and B come from differences of orbits in 256 bits; the errors of D₁ and B are estimates, from two step
/// lengths and six points.
///
/// ```
/// use hopper_asymptotics::Offset;
/// use hopper_basin::{CircleLimits, EdgeChart, Fates, PhaseBasins};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.12)?)?;
/// let chart = EdgeChart::onto(&fates, 2, 11.9206)?;
/// assert_eq!((chart.point().0, chart.hops()), (11.920553918335775, 3));
/// let circle = PhaseBasins::new(&fates, 2, CircleLimits::default())?;
/// // A pixel at 10⁻¹⁰⁰ left of the edge has the local fractions, at 10⁻¹² it has those of its own phases.
/// let (from, to): (Offset, Offset) = ("-2e-100".parse()?, "-1e-100".parse()?);
/// assert!((chart.share(&circle, from, to)?.of(1.into()).middle() - 0.305159).abs() < 1e-6);
/// assert_eq!(chart.label(&circle, "1e-100".parse()?)?, Some(2.into()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeChart {
    n: u64,
    hops: usize,
    mass_ratio: MassRatio,
    point: f64,
    rest: f64,
    error: f64,
    slope: f64,
    slope_error: f64,
    curvature: f64,
    radius: f64,
    remainder: f64,
    /// Offsets right of α*_n up to this one certainly lie in its trap.
    trap: f64,
}

/// Radius of the chart about α*_n itself: in it δ = y.
const OWN_RADIUS: f64 = 1e-3;

impl EdgeChart {
    /// The chart about the boundary point nearest to `guess`, at most 10⁻³ away, which comes to a fixed point α*_n,
    /// n ≥ 1, in at most 256 hops. A point is passed over if its derivatives cannot be found with steps of 2⁻³⁶ or
    /// more. With all digits of an edge it takes some tens of milliseconds, with few digits up to seconds.
    ///
    /// # Errors
    /// [`Error::NoEdge`] if none is found; the errors of [`Fates::fate`] for a wrong speed.
    pub fn near(fates: &Fates, guess: f64) -> Result<Self, Error> {
        let mut found: Vec<Approach> = Vec::new();
        let distance = |approach: &Approach| (approach.point - guess).abs();
        approaches(fates, guess, |approach| {
            found.push(approach);
            // An orbit that comes so near lingers: it is followed no further.
            let nearest = found.iter().map(distance).fold(NEAR, f64::min);
            (nearest > 8.0 * f64::EPSILON * guess).then_some(nearest)
        })?;
        found.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let chart = found.into_iter().find_map(|approach| EdgeChart::about(fates, approach));
        chart.ok_or(Error::NoEdge { alpha: guess, within: NEAR, hops: MOST_HOPS })
    }

    /// The chart about a boundary point at most 10⁻³ away from `guess` that comes to α*_n, n ≥ 1, in the fewest
    /// hops. A guess of some digits is enough, where other edges may be nearer.
    ///
    /// # Errors
    /// As [`near`](Self::near).
    pub fn onto(fates: &Fates, n: u64, guess: f64) -> Result<Self, Error> {
        let mut chart = None;
        approaches(fates, guess, |approach| {
            if approach.n == n {
                chart = EdgeChart::about(fates, approach);
            }
            chart.is_none().then_some(NEAR)
        })?;
        chart.ok_or(Error::NoEdge { alpha: guess, within: NEAR, hops: MOST_HOPS })
    }

    /// The chart about the exact point next to the one in `f64`.
    pub(crate) fn about(fates: &Fates, Approach { n, hops, mut point }: Approach) -> Option<Self> {
        let trap = fates.trap(n).ok()?;
        let mass_ratio = fates.map().mass_ratio();
        let trap = trap.delta - trap.error;
        // α*_n itself; other edges replace all that their hops change.
        let star = FixedPointSpeed::new(n);
        let own = EdgeChart {
            n,
            hops,
            mass_ratio,
            point: star.value(),
            rest: star.rest(),
            error: f64::EPSILON * star.rest().abs(),
            slope: 1.0,
            slope_error: 0.0,
            curvature: 0.0,
            radius: OWN_RADIUS,
            remainder: 0.0,
            trap,
        };
        if hops == 0 {
            return Some(own);
        }
        // Once the point is the nearest `f64`, its orbit in 256 bits gives the rest.
        for _ in 0..4 {
            let at = edge_derivatives(fates, n, hops, point)?;
            let linear = -(at.value.0 + at.value.1) / at.slope;
            let rest = linear * (1.0 - 0.5 * at.curvature * linear);
            if point + rest != point {
                point += rest;
                continue;
            }
            // The derivatives belong to `point`; the boundary point lies beside it.
            let slope = at.slope * (1.0 + at.curvature * rest);
            let cube = at.remainder * rest.abs() * rest * rest;
            let error = (at.value_error + cube) / slope.abs()
                + rest.abs() * (at.slope_error + f64::EPSILON);
            return Some(EdgeChart {
                point,
                rest,
                error,
                slope,
                slope_error: at.slope_error,
                curvature: at.curvature,
                radius: at.radius,
                remainder: at.remainder,
                ..own
            });
        }
        None
    }

    /// n of the fixed point α*_n to which the boundary point comes.
    pub fn n(&self) -> u64 {
        self.n
    }

    /// k, the number of hops until then; 0 for α*_n itself.
    pub fn hops(&self) -> usize {
        self.hops
    }

    /// The mass ratio.
    pub fn mass_ratio(&self) -> MassRatio {
        self.mass_ratio
    }

    /// The boundary point p as the sum of two `f64`, the first of them the nearest one, and an estimate of the
    /// error of the sum.
    pub fn point(&self) -> (f64, f64, f64) {
        (self.point, self.rest, self.error)
    }

    /// D₁, the slope of f^k at p.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// D₂ = (f^k)″/(f^k)′ at p.
    pub fn curvature(&self) -> f64 {
        self.curvature
    }

    /// The largest |y| of the chart.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// B, the bound on the remainder in units |y|³; an estimate.
    pub fn remainder(&self) -> f64 {
        self.remainder
    }

    /// The side of p on which the speeds belong to the basin of α*_n. The other side shows the circle.
    pub fn basin_side(&self) -> Side {
        if self.slope > 0.0 { Side::Right } else { Side::Left }
    }

    /// δ of p + `y`, and its relative error.
    ///
    /// # Errors
    /// [`Error::OutsideChart`] for |y| beyond the [radius](Self::radius); that of [`Offset::new`].
    pub fn offset(&self, y: Offset) -> Result<(Offset, f64), Error> {
        let near = y.nearest();
        if !(near.abs() <= self.radius) {
            return Err(Error::OutsideChart { y: near, radius: self.radius });
        }
        let bend = 1.0 + 0.5 * self.curvature * near;
        let offset = Offset::new(y.mantissa() * (self.slope * bend), y.exponent())?;
        let error = self.remainder * near * near / self.slope.abs();
        Ok((offset, error + self.slope_error + 4.0 * f64::EPSILON))
    }

    /// Ψ of p + `y`, on all of the circle's [domain](PhaseBasins::domain). The relative error of δ is a third of
    /// the relative error of Ψ: from some 10⁻⁴⁵ on the fraction is not known. Then [`share`](Self::share) still has
    /// a value.
    ///
    /// # Errors
    /// [`Error::OtherCircle`] unless `circle` is that of n at this mass ratio; as [`offset`](Self::offset);
    /// [`PhaseBasins::phase`] has no value on the side of the basin.
    pub fn phase(&self, circle: &PhaseBasins, y: Offset) -> Result<Phase, Error> {
        self.check(circle)?;
        let (delta, relative) = self.offset(y)?;
        let phase = circle.phase(delta)?;
        let error = phase.error() + phase_error(circle.coordinate(), delta, relative);
        Ok(Phase::new(phase.whole().clone(), phase.fraction(), error))
    }

    /// The label of p + `y`; `None` if the circle does not have one for all phases within the error.
    ///
    /// # Errors
    /// As [`phase`](Self::phase).
    pub fn label(&self, circle: &PhaseBasins, y: Offset) -> Result<Option<Label>, Error> {
        self.check(circle)?;
        let (delta, relative) = self.offset(y)?;
        if delta.mantissa() > 0.0 {
            let inside = delta.nearest() * (1.0 + relative) <= self.trap;
            return Ok(inside.then_some(HopperFate::label_of_fixed_point(self.n)));
        }
        if delta.mantissa() == 0.0 {
            return Ok(None);
        }
        let phase = self.phase(circle, y)?;
        Ok(circle.label_at(phase.fraction(), phase.error() + circle.phase_error()))
    }

    /// The share of every fate between p + `from` and p + `to`, in any order: a pixel.
    ///
    /// On the side of the circle shares are those of phases ([`PhaseBasins::share`]). From p itself on there are
    /// infinitely many turns, and the shares are the local fractions. Their error is of the order 1/Ψ at the far
    /// end (docs/theory.md, Theorem 87); the bounds are widened by 8/Ψ, an estimate.
    ///
    /// # Errors
    /// As [`label`](Self::label).
    pub fn share(
        &self,
        circle: &PhaseBasins,
        from: Offset,
        to: Offset,
    ) -> Result<LocalFractions, Error> {
        self.share_moved(circle, from, to, 0.0)
    }

    /// As [`share`](Self::share), over mass ratios between which ln Ψ moves by `moved`.
    pub(crate) fn share_moved(
        &self,
        circle: &PhaseBasins,
        from: Offset,
        to: Offset,
        moved: f64,
    ) -> Result<LocalFractions, Error> {
        self.check(circle)?;
        let (a, b) = (self.offset(from)?.0, self.offset(to)?.0);
        match (a.mantissa() < 0.0, b.mantissa() < 0.0) {
            (true, true) => self.share_of_phases(circle, from, to, moved),
            (false, false) => Ok(self.basin_share(a, b)),
            (true, false) => self.share_across(circle, a, b),
            (false, true) => self.share_across(circle, b, a),
        }
    }

    /// Both ends on the side of the circle.
    fn share_of_phases(
        &self,
        circle: &PhaseBasins,
        from: Offset,
        to: Offset,
        moved: f64,
    ) -> Result<LocalFractions, Error> {
        let (one, other) = (self.phase(circle, from)?, self.phase(circle, to)?);
        let coordinate = circle.coordinate();
        let one_moves = moved * turns_to_leave(coordinate, self.offset(from)?.0);
        let other_moves = moved * turns_to_leave(coordinate, self.offset(to)?.0);
        // A part of a turn more or less does not change a digit of the share of so many turns.
        if moved > 0.0 && !(one_moves.max(other_moves) < MOST_TURNS) {
            return Ok(circle.fractions());
        }
        if one.error() + other.error() < LARGEST_PHASE_ERROR {
            let low_first = (one.whole(), one.fraction()) < (other.whole(), other.fraction());
            let sign = if low_first { 0.5 } else { -0.5 };
            let (one, other) =
                (shifted(&one, -sign * one_moves), shifted(&other, sign * other_moves));
            return Ok(circle.share_between(&one, &other));
        }
        // The slope is the same for both ends: the number of turns has its relative error, and only the start is
        // not known.
        Ok(circle.fractions_of_turns(one.whole_hops_to(&other)))
    }

    /// From δ < 0 to δ ≥ 0.
    fn share_across(
        &self,
        circle: &PhaseBasins,
        left: Offset,
        right: Offset,
    ) -> Result<LocalFractions, Error> {
        let exponent = left.exponent().max(right.exponent());
        let size = |offset: Offset| {
            let scaled = Offset::new(offset.mantissa(), offset.exponent() - exponent);
            scaled.map(|scaled| scaled.nearest().abs())
        };
        let (falls, stays) = (size(left)?, size(right)?);
        let part = falls / (falls + stays);
        let hops = 1.0 / turns_to_leave(circle.coordinate(), left);
        let local = circle.fractions().widened((8.0 * hops).min(1.0));
        Ok(local.mixed(part, &self.basin_share(right, right)))
    }

    /// All speeds up to δ are in the trap, or it is not known.
    fn basin_share(&self, a: Offset, b: Offset) -> LocalFractions {
        let inside = a.nearest().max(b.nearest()) * (1.0 + self.slope_error) <= self.trap;
        LocalFractions::new(
            inside.then_some((HopperFate::label_of_fixed_point(self.n), 1.0)).into_iter(),
            0.0,
        )
    }

    fn check(&self, circle: &PhaseBasins) -> Result<(), Error> {
        if circle.n() == self.n && circle.mass_ratio() == self.mass_ratio {
            return Ok(());
        }
        let (n, mass_ratio) = (self.n, self.mass_ratio.value());
        let (other, other_ratio) = (circle.n(), circle.mass_ratio().value());
        Err(Error::OtherCircle { n, mass_ratio, other, other_ratio })
    }
}

/// Sum of the errors of two phases up to which a share is that of its own phases. Chosen: the error widens the bounds.
const LARGEST_PHASE_ERROR: f64 = 1e-3;

/// More turns than the mantissa of an `f64` counts one by one.
pub(crate) const MOST_TURNS: f64 = (1_u64 << 60) as f64;

/// The phase some turns later.
pub(crate) fn shifted(phase: &Phase, turns: f64) -> Phase {
    Phase::new(phase.whole().clone(), phase.fraction() + turns, phase.error())
}

/// 1/(A |δ|^{1/3}): Ψ to leading order; infinite beyond the largest `f64`.
pub(crate) fn turns_to_leave(coordinate: &FatouCoordinate, delta: Offset) -> f64 {
    let logarithm =
        pxfm::f_log(delta.mantissa().abs()) + delta.exponent() as f64 * std::f64::consts::LN_10;
    pxfm::f_exp(-logarithm / 3.0) / coordinate.drift()
}

/// The error of Ψ for a relative error of δ: |δ dΨ/dδ| = (1 + O(x))/(3 A x), with a factor 2 for the next orders.
pub(crate) fn phase_error(coordinate: &FatouCoordinate, delta: Offset, relative: f64) -> f64 {
    2.0 / 3.0 * relative * turns_to_leave(coordinate, delta)
}
