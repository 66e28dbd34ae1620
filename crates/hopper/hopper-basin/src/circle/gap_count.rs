//! How many boundary points are seen left of a fixed point, at a given scale?

use crate::circle::edge_chart::EdgeChart;
use crate::circle::falls_onto::FallsOnto;
use crate::circle::phase_basins::PhaseBasins;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use hopper_asymptotics::Offset;
use passive_hopper::FixedPointSpeed;

/// The number of gaps longer than ε between neighbouring boundary points in the turns left of α*_n, from the
/// [domain](PhaseBasins::domain) of its circle on.
///
/// It is counted from the lengths on the circle, at any ε. In the first turns the length of every gap is found from
/// the phases. Later Ψ' = (1 − Acx)/(3Ax⁴) at x = |δ|^{1/3}: a gap of θ turns has the length θ/Ψ', and the x with a
/// length of ε gives the number of turns, with an error of a part O(x) of a turn.
///
/// At a limit point of the circle, a preimage of α*_m with a slope, the circle shows the gaps left of α*_m scaled
/// by D (docs/theory.md, Theorem 89); those too short for the circle's [resolution](crate::CircleLimits) are
/// counted from the circle of m.
///
/// ```
/// use hopper_basin::{CircleLimits, Fates, GapCount, PhaseBasins};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.2)?)?;
/// let circle = PhaseBasins::new(&fates, 2, CircleLimits::default())?;
/// let count = GapCount::new(&fates, &circle, &[])?;
/// // The law has no logarithm: 0.2874 ε^{−1/4}.
/// assert_eq!(count.depth(), 1);
/// let epsilon: f64 = 1e-100;
/// let law = 0.75 * count.constant() * epsilon.powf(-0.25);
/// let found = count.longer_than(epsilon.ln()).expect("far above 10⁻¹²⁰⁰");
/// assert!((found / law - 1.0).abs() < 1e-12);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct GapCount {
    n: u64,
    /// A and c of the Fatou coordinate.
    drift: f64,
    logarithm: f64,
    gaps: Vec<Gap>,
    /// ln of the lengths of the gaps in the first turns, in decreasing order.
    first_lengths: Vec<f64>,
    limits: Vec<Limit>,
}

/// A gap in every turn.
#[derive(Debug, Clone, Copy)]
struct Gap {
    /// Its length in turns.
    turns: f64,
    /// Ψ at the middle of its first copy.
    first: f64,
}

/// What divides gaps on the circle, as places in a turn.
#[derive(Debug, Clone, Copy)]
struct Cut {
    from: f64,
    to: f64,
    kind: CutKind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CutKind {
    /// A boundary point.
    Point,
    /// Boundary points that the circle does not tell apart.
    Undecided,
    /// A limit point whose gaps are counted from another circle.
    Limit,
}

/// The turns in which the length of every gap is found. After them x is some thousandths.
const FIRST_TURNS: usize = 16;

/// Phases in a turn from which these lengths are interpolated, by cubic polynomials.
const NODES: f64 = 32.0;

/// A limit point in every turn.
#[derive(Debug, Clone)]
struct Limit {
    /// Ψ of its first copy.
    first: f64,
    /// ln |dδ/dΨ| in the first turns.
    widths: Vec<f64>,
    /// ln D: a length left of α*_m becomes D times as many turns.
    scale: f64,
    /// Ψ_m from which on the copies of gaps are not resolved.
    start: f64,
    of: GapCount,
}

/// Sums over this many turns are added one by one, the rest by an integral.
const SINGLE_TURNS: usize = 64;

/// Step of the integral in ln Ψ. Its terms are smooth: half the step changes the sum by less than 10⁻⁴ of itself.
const STEP: f64 = 0.04;

/// Iterations of a contraction by at least 4.
const ITERATIONS: usize = 26;

impl GapCount {
    /// From the circle of α*_n; `lower` has the counts of the circles onto which its limit points fall. Of those
    /// with m < n that it does not have, no gaps are counted beyond the circle's resolution.
    ///
    /// # Errors
    /// Those of [`EdgeChart::onto`] for a limit point, and of [`PhaseBasins::phase`].
    pub fn new(fates: &Fates, circle: &PhaseBasins, lower: &[GapCount]) -> Result<Self, Error> {
        let coordinate = circle.coordinate();
        // Places are numbers of turns from the first speed of the domain on.
        let top = FixedPointSpeed::new(circle.n()).offset_of(circle.domain().1);
        let first = number(circle, top)?;
        let place = |phase: f64| (phase - first) - (phase - first).floor();
        let mut cuts: Vec<Cut> = Vec::new();
        for point in circle.boundary() {
            let at = place(point.phase);
            cuts.push(Cut { from: at, to: at, kind: CutKind::Point });
        }
        let mut limits = Vec::new();
        for part in circle.undecided() {
            let (from, length) = (place(part.from), part.to - part.from);
            let fallen = match part.falls_onto {
                Some(FallsOnto::FixedPoint { m, .. }) => lower.iter().find(|of| of.n == m),
                _ => None,
            };
            let kind = match fallen.filter(|of| !of.gaps.is_empty()) {
                None => CutKind::Undecided,
                Some(of) => {
                    let speed = part.speeds.0 + 0.5 * (part.speeds.1 - part.speeds.0);
                    let chart = EdgeChart::onto(fates, of.n, speed)?;
                    let scale = slope(circle, speed) / chart.slope().abs();
                    limits.push((from + 0.5 * length, length, scale, of));
                    CutKind::Limit
                }
            };
            cuts.push(Cut { from, to: from + length, kind });
        }
        let zones: Vec<(f64, f64)> = unresolved(&cuts);
        for &(from, to) in &zones {
            cuts.retain(|cut| cut.to < from || cut.from > to);
            cuts.push(Cut { from, to, kind: CutKind::Limit });
        }
        cuts.sort_by(|a, b| a.from.total_cmp(&b.from));
        let next = cuts.iter().skip(1).map(|cut| cut.from);
        let turned = cuts.first().map(|cut| cut.from + 1.0);
        let gaps = cuts
            .iter()
            .zip(next.chain(turned))
            .map(|(cut, to)| Gap { turns: to - cut.to, first: first + 0.5 * (cut.to + to) });
        let gaps: Vec<Gap> = gaps.filter(|gap| gap.turns > 0.0).collect();
        let outer = FirstTurns::new(circle)?;
        let copies = |gap: &Gap| {
            let Gap { first, turns } = *gap;
            let outer = &outer;
            (0..FIRST_TURNS).map(move |turn| outer.ln_length(first + turn as f64, turns))
        };
        let mut first_lengths: Vec<f64> = gaps.iter().flat_map(copies).collect();
        first_lengths.sort_by(|a, b| b.total_cmp(a));
        let limit = |(at, length, scale, of): (f64, f64, f64, &GapCount)| {
            let zone = zones.iter().find(|zone| zone.0 <= at && at <= zone.1);
            let length = zone.map_or(length, |zone| zone.1 - zone.0);
            let start = of.psi(pxfm::f_cbrt(length / scale));
            let first = first + at;
            let width = |turn: usize| {
                outer.ln_length(first + turn as f64, 0.5 / NODES) - pxfm::f_log(0.5 / NODES)
            };
            let widths = (0..FIRST_TURNS).map(width).collect();
            Limit { first, widths, scale: pxfm::f_log(scale), start, of: of.clone() }
        };
        let limits = limits.into_iter().map(limit).collect();
        let (drift, logarithm) = (coordinate.drift(), coordinate.logarithm());
        Ok(GapCount { n: circle.n(), drift, logarithm, gaps, first_lengths, limits })
    }

    /// d_n: the levels of accumulation; 0 if there is no boundary point.
    pub fn depth(&self) -> u32 {
        let lower = self.limits.iter().map(|limit| limit.of.depth()).max();
        u32::from(!self.gaps.is_empty()) + lower.unwrap_or(0)
    }

    /// B_n of the law B ε^{−1/4} (ln 1/ε)^{d−1} for the mean number of boxes (docs/theory.md, Theorem 89). The
    /// number of gaps is ¾ of it.
    pub fn constant(&self) -> f64 {
        let depth = self.depth();
        let root = pxfm::f_pow(3.0 * self.drift, -0.75);
        if depth <= 1 {
            return 4.0 * root * self.gaps.iter().map(|gap| gap.turns.sqrt().sqrt()).sum::<f64>();
        }
        let deepest = self.limits.iter().filter(|limit| limit.of.depth() + 1 == depth);
        let sum: f64 =
            deepest.map(|limit| pxfm::f_exp(0.25 * limit.scale) * limit.of.constant()).sum();
        0.75 * root * sum / f64::from(depth - 1)
    }

    /// The number of gaps longer than ε, given ln ε; `None` if ln ε is not finite, or the number is too large for
    /// an `f64`: below some 10⁻¹²⁰⁰.
    pub fn longer_than(&self, ln_epsilon: f64) -> Option<f64> {
        let turns = |gap: &Gap| {
            let last = self.last_turn(gap, ln_epsilon);
            // The copies up to the last one that is that long, without those of the first turns.
            ((last - gap.first).floor() + 1.0 - FIRST_TURNS as f64).max(0.0)
        };
        let first = self.first_lengths.partition_point(|&length| length > ln_epsilon);
        let own = first as f64 + self.gaps.iter().map(turns).sum::<f64>();
        let limits = self.limits.iter();
        let limits = limits.map(|limit| self.beyond_resolution(limit, limit.first, ln_epsilon));
        let all = own + limits.sum::<f64>();
        (ln_epsilon.is_finite() && all.is_finite()).then_some(all)
    }

    /// Ψ where a gap has the length ε.
    fn last_turn(&self, gap: &Gap, ln_epsilon: f64) -> f64 {
        self.psi(self.root(ln_epsilon - pxfm::f_log(gap.turns)))
    }

    /// The gaps next to a limit point in all turns from Ψ = `first` on.
    fn beyond_resolution(&self, limit: &Limit, first: f64, ln_epsilon: f64) -> f64 {
        let at_width =
            |width: f64| limit.of.beyond_turn(limit.start, ln_epsilon - limit.scale - width);
        let turn = |psi: f64| at_width(-self.ln_slope(self.inverse(psi)));
        let single = (0..SINGLE_TURNS).map(|k| match limit.widths.get(k) {
            Some(&width) if first == limit.first => at_width(width),
            _ => turn(first + k as f64),
        });
        let single: f64 = single.sum();
        // The sum over k from K on is the integral from K − ½ on.
        let mut psi = first + SINGLE_TURNS as f64 - 0.5;
        let (mut sum, mut before) = (0.0, psi * turn(psi));
        while before > 0.0 {
            psi *= pxfm::f_exp(STEP);
            let here = psi * turn(psi);
            sum += 0.5 * STEP * (before + here);
            before = here;
        }
        single + sum
    }

    /// The number of gaps longer than ε from Ψ = `start` on, on average over the place of the start in its turn.
    fn beyond_turn(&self, start: f64, ln_epsilon: f64) -> f64 {
        let turns = |gap: &Gap| (self.last_turn(gap, ln_epsilon) - start).max(0.0);
        let own: f64 = self.gaps.iter().map(turns).sum();
        let deeper = self
            .limits
            .iter()
            .map(|limit| self.beyond_resolution(limit, start.max(limit.first), ln_epsilon));
        own + deeper.sum::<f64>()
    }

    /// Ψ = 1/(Ax) + c ln x.
    fn psi(&self, x: f64) -> f64 {
        1.0 / (self.drift * x) + self.logarithm * pxfm::f_log(x)
    }

    /// ln |dΨ/dδ|.
    fn ln_slope(&self, x: f64) -> f64 {
        let next = 1.0 - self.drift * self.logarithm * x;
        pxfm::f_log(next / (3.0 * self.drift)) - 4.0 * pxfm::f_log(x)
    }

    /// x with ln |dδ/dΨ| = `ln_width`: x⁴ = width (1 − Acx)/(3A). As c < 0, the iteration contracts by at least 4.
    fn root(&self, ln_width: f64) -> f64 {
        let leading = 0.25 * (ln_width - pxfm::f_log(3.0 * self.drift));
        let mut x = pxfm::f_exp(leading);
        for _ in 0..ITERATIONS {
            let next = 1.0 - self.drift * self.logarithm * x;
            x = pxfm::f_exp(leading + 0.25 * pxfm::f_log(next));
        }
        x
    }

    /// x of a phase, by Newton's method in p = 1/(Ax). Ψ = p − c ln (Ap) increases and is concave, as c < 0: after
    /// one step the iteration increases up to the root. A first step below 0 is shortened.
    fn inverse(&self, psi: f64) -> f64 {
        let mut p = psi.max(1.0);
        for _ in 0..ITERATIONS {
            let value = p - self.logarithm * pxfm::f_log(self.drift * p);
            let slope = 1.0 - self.logarithm / p;
            p = (p - (value - psi) / slope).max(0.1 * p);
        }
        1.0 / (self.drift * p)
    }
}

/// About every limit point, the interval from it to the farthest undecided interval that is nearer to it than to
/// others. The boundary points in it are not all resolved, and are counted from the circle onto which the limit
/// point falls.
fn unresolved(cuts: &[Cut]) -> Vec<(f64, f64)> {
    let of_kind = |kind: CutKind| cuts.iter().filter(move |cut| cut.kind == kind);
    let mut zones: Vec<(f64, f64)> =
        of_kind(CutKind::Limit).map(|cut| (cut.from, cut.to)).collect();
    for part in of_kind(CutKind::Undecided) {
        let distance = |zone: &(f64, f64)| (zone.0 - part.to).max(part.from - zone.1);
        let nearest = zones.iter_mut().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(zone) = nearest {
            *zone = (zone.0.min(part.from), zone.1.max(part.to));
        }
    }
    zones
}

/// Ψ of an offset as a number.
fn number(circle: &PhaseBasins, delta: f64) -> Result<f64, Error> {
    let phase = circle.phase(Offset::from(delta))?;
    let whole = i64::try_from(phase.whole().clone());
    let whole = whole.map_err(|_| Error::NoTurn { n: circle.n(), delta })?;
    Ok(whole as f64 + phase.fraction())
}

/// x at phases that are about 1/[`NODES`] apart, from the top of the domain on: (Ψ, x).
struct FirstTurns(Vec<(f64, f64)>);

impl FirstTurns {
    /// The first turns, with one more at the end.
    fn new(circle: &PhaseBasins) -> Result<Self, Error> {
        let coordinate = circle.coordinate();
        let (drift, logarithm) = (coordinate.drift(), coordinate.logarithm());
        let top = FixedPointSpeed::new(circle.n()).offset_of(circle.domain().1);
        let end = number(circle, top)? + FIRST_TURNS as f64 + 2.0;
        let mut x = pxfm::f_cbrt(-top);
        let mut known: Vec<(f64, f64)> = Vec::new();
        while known.last().is_none_or(|&(psi, _)| psi < end) {
            known.push((number(circle, -x * x * x)?, x));
            let slope = 1.0 - drift * logarithm * x;
            x = 1.0 / (1.0 / x + drift / (NODES * slope));
        }
        Ok(FirstTurns(known))
    }

    /// ln of the length of an interval of phases.
    fn ln_length(&self, middle: f64, turns: f64) -> f64 {
        let near = |psi: f64| self.0.partition_point(|&(other, _)| other < psi);
        let [from, to] = [middle - 0.5 * turns, middle + 0.5 * turns].map(|psi| {
            // A short interval lies on one polynomial, so that the difference keeps its digits.
            let at = if turns * NODES < 1.0 { near(middle) } else { near(psi) };
            cubic(&self.0[at.clamp(2, self.0.len() - 2) - 2..][..4], psi)
        });
        let length = (from - to) * (from * from + from * to + to * to);
        pxfm::f_log(length.max(f64::MIN_POSITIVE))
    }
}

/// The cubic polynomial through four points.
fn cubic(points: &[(f64, f64)], at: f64) -> f64 {
    let mut sum = 0.0;
    for (k, &(own, value)) in points.iter().enumerate() {
        let others = points.iter().enumerate().filter(|(other, _)| *other != k);
        sum +=
            others.fold(value, |product, (_, &(other, _))| product * (at - other) / (own - other));
    }
    sum
}

/// |dΨ/dα| at a speed of the domain, by a difference quotient: Ψ is smooth on the domain.
fn slope(circle: &PhaseBasins, speed: f64) -> f64 {
    let (bottom, top) = circle.domain();
    let step = 1e-4 * (top - bottom).min(2.0 * (speed - bottom)).min(2.0 * (top - speed));
    let at = |speed: f64| circle.phase_of(speed).unwrap_or(0.0);
    let turns = at(speed + step) - at(speed - step);
    (turns - turns.floor()) / (2.0 * step)
}
