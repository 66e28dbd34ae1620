//! The circle of fates left of α*_n: the basins as intervals of phase.

use crate::circle::circle_limits::{CircleLimits, Ground};
use crate::circle::falls_onto::{FallsOnto, falls_onto};
use crate::circle::fundamental_domain::FundamentalDomain;
use crate::circle::labelled_speeds::{LabelledSpeeds, is_boundary_point, labelled_speeds};
use crate::circle::local_fractions::LocalFractions;
use crate::circle::phase_shares::{PhasePart, PhaseShares};
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::Label;
use hopper_asymptotics::{FatouCoordinate, Offset, Phase};
use passive_hopper::{LiftOffMap, MassRatio};

/// A point of the circle at which two basins meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryPhase {
    /// The phase, in [0, 1).
    pub phase: f64,
    /// Bound on its error, as far as that of [`PhaseBasins::phase_error`] is one.
    pub error: f64,
    /// The label below the phase.
    pub below: Label,
    /// The label above the phase.
    pub above: Label,
    /// The speed of the boundary point on the fundamental domain, to some ulps.
    pub speed: f64,
    /// What the orbit of `speed` comes to; `None` if `f64` does not tell.
    pub falls_onto: Option<FallsOnto>,
}

/// An interval of phases without a label.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UndecidedPhases {
    /// The lowest phase, in [0, 1).
    pub from: f64,
    /// The highest phase; above 1 if the interval contains phase 0.
    pub to: f64,
    /// The speeds of both ends on the fundamental domain.
    pub speeds: (f64, f64),
    /// What a point inside comes to, as a rule the limit point of the boundary points inside; `None` if the two
    /// ends do not tell.
    pub falls_onto: Option<FallsOnto>,
}

/// The circle of fates left of α*_n at one mass ratio.
///
/// The fate of α*_n + δ, δ < 0, depends on Ψ(δ) mod 1 alone (docs/theory.md, Theorem 85). So one look-up gives the
/// fate at every depth.
///
/// ```
/// use hopper_asymptotics::Offset;
/// use hopper_basin::{CircleLimits, Fates, PhaseBasins};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.2)?)?;
/// let circle = PhaseBasins::new(&fates, 2, CircleLimits::default())?;
/// // Next to α*_2 on its left, 3 % of all speeds belong to the basin of α*_1, at every scale.
/// let share = circle.fractions().of(1.into());
/// assert!((share.middle() - 0.030).abs() < 5e-4 && share.half_width() < 1e-10);
/// // Two points of a turn are boundary points.
/// assert_eq!(circle.boundary().len(), 2);
/// // The fate at 10⁻¹⁰⁰⁰ below α*_2.
/// let phase = circle.coordinate().phase("-1e-1000".parse::<Offset>()?)?;
/// assert!(circle.label_at(phase.fraction(), phase.error()).is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct PhaseBasins {
    mass_ratio: MassRatio,
    ground: Ground,
    domain: FundamentalDomain,
    shares: PhaseShares,
    boundary: Vec<BoundaryPhase>,
    undecided: Vec<UndecidedPhases>,
}

impl PhaseBasins {
    /// The circle left of α*_n.
    ///
    /// # Errors
    /// [`Error::Index`] unless n is from 1 to [`LARGEST_LABEL`](HopperFate::LARGEST_LABEL); [`Error::NoTurn`] and
    /// [`Error::Asymptotics`] where the Fatou coordinate has no value; those of [`branches`](crate::branches).
    pub fn new(fates: &Fates, n: u64, limits: CircleLimits) -> Result<Self, Error> {
        let largest = HopperFate::LARGEST_LABEL;
        if n == 0 || n > largest {
            return Err(Error::Index { n, smallest: 1, largest });
        }
        let domain = FundamentalDomain::new(fates, n)?;
        let (parts, ground) = labelled_speeds(fates, &domain.speeds, &limits)?;
        Ok(Self::on_domain(fates, domain, &parts, ground))
    }

    fn on_domain(
        fates: &Fates,
        domain: FundamentalDomain,
        parts: &[LabelledSpeeds],
        ground: Ground,
    ) -> Self {
        let end = domain.turns(domain.speeds.top).value;
        // One label on both sides of the end of the turn: there is no boundary point.
        let at_bottom = |part: &LabelledSpeeds| is_boundary_point(domain.speeds.bottom, part.left);
        let at_top = |part: &LabelledSpeeds| is_boundary_point(part.right, domain.speeds.top);
        let closed = parts.first().zip(parts.last()).is_some_and(|(first, last)| {
            at_bottom(first) && at_top(last) && first.label == last.label
        });
        let mut phases = Vec::with_capacity(parts.len() + 1);
        for part in parts {
            let (left, right) = (domain.turns(part.left), domain.turns(part.right));
            let mut from = (left.value + left.error).max(end - 1.0);
            let mut to = (right.value - right.error).min(end);
            if closed && at_bottom(part) {
                from = end - 1.0;
            }
            if closed && at_top(part) {
                to = end;
            }
            // The turn has phase 0 inside: 0 ≤ `end` < 1.
            for (low, high, shift) in [(from, to.min(0.0), 1.0), (from.max(0.0), to, 0.0)] {
                if low < high {
                    let label = part.label;
                    phases.push(PhasePart { from: low + shift, to: high + shift, label });
                }
            }
        }
        phases.sort_by(|a, b| a.from.total_cmp(&b.from));
        let shares = PhaseShares::new(joined(phases));
        let (mut boundary, mut undecided) = (Vec::new(), Vec::new());
        for pair in parts.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let (left, right) = (domain.turns(a.right), domain.turns(b.left));
            // Points well inside both parts: the rounding of their orbits does not matter.
            let inside = 0.01 * (a.right - a.left).min(b.right - b.left);
            let falls_onto = falls_onto(fates, a.right - inside, b.left + inside);
            let middle = 0.5 * (left.value + right.value);
            let error = 0.5 * (right.value - left.value) + left.error;
            if is_boundary_point(a.right, b.left) && a.label != b.label {
                let speed = a.right + 0.5 * (b.left - a.right);
                let phase = middle - middle.floor();
                let (below, above) = (a.label, b.label);
                boundary.push(BoundaryPhase { phase, error, below, above, speed, falls_onto });
            } else {
                let from = (left.value - left.error).max(end - 1.0);
                let shift = from.floor();
                let speeds = (a.right, b.left);
                let to = right.value + right.error - shift;
                undecided.push(UndecidedPhases { from: from - shift, to, speeds, falls_onto });
            }
        }
        boundary.sort_by(|a, b| a.phase.total_cmp(&b.phase));
        undecided.sort_by(|a, b| a.from.total_cmp(&b.from));
        let mass_ratio = fates.map().mass_ratio();
        PhaseBasins { mass_ratio, ground, domain, shares, boundary, undecided }
    }

    /// n of α*_n.
    pub fn n(&self) -> u64 {
        self.domain.speeds.n
    }

    /// The mass ratio.
    pub fn mass_ratio(&self) -> MassRatio {
        self.mass_ratio
    }

    /// What the labels stand on.
    pub fn ground(&self) -> Ground {
        self.ground
    }

    /// Ψ left of α*_n.
    pub fn coordinate(&self) -> &FatouCoordinate {
        &self.domain.coordinate
    }

    /// The lowest and the highest speed of the fundamental domain on which the circle was found: one turn.
    pub fn domain(&self) -> (f64, f64) {
        (self.domain.speeds.bottom, self.domain.speeds.top)
    }

    /// The phase of a speed of the [domain](Self::domain), in [0, 1); `None` for other speeds.
    pub fn phase_of(&self, speed: f64) -> Option<f64> {
        let inside = speed >= self.domain.speeds.bottom && speed <= self.domain.speeds.top;
        let turns = self.domain.turns(speed).value;
        inside.then(|| turns - turns.floor())
    }

    /// The speed of the [domain](Self::domain) with this phase, to an ulp.
    pub(crate) fn speed_at(&self, phase: f64) -> f64 {
        let (mut low, mut high) = self.domain();
        // Ψ grows with the speed, from one turn below that of the top.
        let end = self.domain.turns(high).value;
        let wanted = if phase <= end { phase } else { phase - 1.0 };
        loop {
            let middle = low.midpoint(high);
            if !(low < middle && middle < high) {
                return low;
            }
            if self.domain.turns(middle).value < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
    }

    /// Ψ at any offset between the lowest speed of the [domain](Self::domain) and α*_n, also where the
    /// [coordinate](Self::coordinate) has no value any more.
    ///
    /// # Errors
    /// [`Error::Asymptotics`] for an offset outside this range, and those of [`FatouCoordinate::phase`];
    /// [`Error::NoTurn`] if the orbit does not come to the domain.
    pub fn phase(&self, delta: Offset) -> Result<Phase, Error> {
        self.domain.phase(&LiftOffMap::new(self.mass_ratio), delta)
    }

    /// The error of the phases of speeds of the domain.
    ///
    /// It is four times the largest difference between the polynomial and phases at points between its nodes, and
    /// the bound on the error of those phases: an estimate, and not a proved bound.
    pub fn phase_error(&self) -> f64 {
        self.domain.turns(self.domain.speeds.top).error
    }

    /// The intervals with a label, from phase 0 to 1. One that contains phase 0 is given in two parts.
    pub fn parts(&self) -> &[PhasePart] {
        self.shares.parts()
    }

    /// The points at which two basins meet, as far as they are resolved. Their limit points lie in the
    /// [undecided](Self::undecided) intervals.
    pub fn boundary(&self) -> &[BoundaryPhase] {
        &self.boundary
    }

    /// The intervals without a label. As a rule each contains a limit point of boundary points.
    pub fn undecided(&self) -> &[UndecidedPhases] {
        &self.undecided
    }

    /// The label of all phases within `error` of `phase`; `None` if they do not have one label, or it is not known.
    /// The integer part of `phase` does not matter.
    pub fn label_at(&self, phase: f64, error: f64) -> Option<Label> {
        self.shares.label(phase, error)
    }

    /// The local fractions p_{n,k}.
    ///
    /// The bounds hold as the labels do ([`ground`](Self::ground)). With [`Ground::Spacing`] they are no bounds:
    /// they are widened by 3/N, N the number of speeds. A set of speeds with a larger share has one of N random
    /// speeds in it with 95 % probability.
    pub fn fractions(&self) -> LocalFractions {
        let found = LocalFractions::new(self.shares.lengths(0.0, 1.0), self.rounding());
        match self.ground {
            Ground::Branches { .. } => found,
            Ground::Spacing { speeds } => found.widened(3.0 * speeds / self.domain.speeds.width()),
        }
    }

    /// The share of every fate in the phases from `from` to `to` ≥ `from`, in turns: a pixel that covers them. The
    /// shares of phases and of speeds differ by a part of the order 1/Ψ. The bounds hold as the labels do
    /// ([`ground`](Self::ground)).
    ///
    /// # Errors
    /// [`Error::Phases`] unless both are finite, and `to` is not below `from`. If they are equal, the share is that
    /// of the one phase.
    pub fn share(&self, from: f64, to: f64) -> Result<LocalFractions, Error> {
        let turns = to - from;
        if !(turns >= 0.0 && turns.is_finite()) {
            return Err(Error::Phases { from, to });
        }
        Ok(self.share_of_turns(from, turns))
    }

    /// As [`share`](Self::share), between two phases of any size, in any order. Their errors widen the bounds.
    pub fn share_between(&self, one: &Phase, other: &Phase) -> LocalFractions {
        let less = |a: &Phase, b: &Phase| (a.whole(), a.fraction()) < (b.whole(), b.fraction());
        let (low, high) = if less(one, other) { (one, other) } else { (other, one) };
        let error = low.error() + high.error();
        // From 2⁶² turns on the ends do not change a digit of the share.
        let Ok(whole) = i64::try_from(high.whole() - low.whole()) else {
            return if error < 1.0 { self.fractions() } else { self.fractions().widened(1.0) };
        };
        let turns = whole as f64 + (high.fraction() - low.fraction());
        let widening = if error == 0.0 { 0.0 } else { (error / turns).min(1.0) };
        self.share_of_turns(low.fraction(), turns).widened(widening)
    }

    /// The shares in so many turns from an unknown phase on.
    pub(crate) fn fractions_of_turns(&self, turns: f64) -> LocalFractions {
        self.fractions().widened((2.0 / turns).min(1.0))
    }

    fn share_of_turns(&self, from: f64, turns: f64) -> LocalFractions {
        // The spacing of `f64` at the ends of an interval: a shorter one is a single phase.
        let shortest = f64::EPSILON * (1.0 + from.abs());
        if turns <= shortest {
            let label = self.label_at(from, 0.0);
            return LocalFractions::new(label.map(|label| (label, 1.0)).into_iter(), 0.0);
        }
        let part = |(label, length): (Label, f64)| (label, length / turns);
        let rounding = self.rounding() * (1.0 + 1.0 / turns);
        LocalFractions::new(self.shares.lengths(from, turns).map(part), rounding)
    }

    /// Bound on the rounding of sums of lengths: half an ulp of 1 for each part, and for the ends.
    fn rounding(&self) -> f64 {
        f64::EPSILON * (self.parts().len() + 2) as f64
    }
}

/// Touching parts with one label as one part: where a turn was cut.
fn joined(parts: Vec<PhasePart>) -> Vec<PhasePart> {
    let mut all: Vec<PhasePart> = Vec::with_capacity(parts.len());
    for part in parts {
        match all.last_mut() {
            Some(last) if last.label == part.label && part.from <= last.to => last.to = part.to,
            _ => all.push(part),
        }
    }
    all
}
