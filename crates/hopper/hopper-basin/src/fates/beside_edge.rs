//! The orbits beside a point that falls onto a fixed point, by one orbit in 106 bits.
//!
//! In `f64` an orbit that comes within 10⁻⁹ of α*_n has lost the digits of its offset. Here one reference orbit has
//! them. The orbits of near starts, at near mass ratios, follow from its derivatives: the offset of each keeps its
//! digits, however near it is.

use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, FixedPointSpeed, LiftOffMap, MassRatio, OrbitTangent,
};

/// The largest distance of a start from the reference, and the next ones that are tried where the orbits do not hop
/// alike. From a larger distance an orbit in `f64` has a smaller error.
const RADII: [f64; 3] = [1e-6, 3e-8, 1e-9];

/// Two starts nearer to each other than this, both of which come next to the same fixed point, have one edge as a
/// rule. Otherwise the second one is labelled alone.
const SAME_EDGE: f64 = 1e-5;

/// The steps of the differences, in units of the radii for the start and for κ: along both axes, and to the corners.
const STEPS: [(i8, i8); 8] = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)];

/// A bound on the third and the fourth order, over what the differences show of them. It is an estimate, and so are
/// the bounds.
const OVER_SEEN: f64 = 2.0;

/// The starts near one that falls onto α*_n, at mass ratios near to its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BesideEdge {
    /// The start of the reference orbit, and its mass ratio.
    start: f64,
    mass_ratio: MassRatio,
    pub(crate) n: u64,
    /// The offset of the reference orbit from α*_n, and a bound on its error.
    offset: (f64, f64),
    tangent: OrbitTangent,
    /// The second order in units of the radii: of the start, of κ, and of both.
    second: [f64; 3],
    /// Bounds on the third order in the same way.
    third: [f64; 3],
    /// Bound on the error of the second order, at the ends of the radii: the differences contain the fourth order.
    fourth: f64,
}

impl BesideEdge {
    /// From a start whose orbit comes near α*_n after `hops` hops, for all mass ratios within `kappa` in κ if that
    /// is less than the radius, else for its own. `see` is given each speed of the reference orbit, with the
    /// largest distance of the orbits beside it. `None` if they do not all hop alike.
    pub(crate) fn new(
        map: &LiftOffMap,
        near: f64,
        (n, hops): (u64, usize),
        kappa: f64,
        mut see: impl FnMut(f64, f64),
    ) -> Option<Self> {
        let (start, mass_ratio) = (edge(map, near, (n, hops))?, map.mass_ratio());
        RADII.into_iter().find_map(|radius| {
            let orbit = ExtendedOrbit::new(map, start, Arithmetic::Bits106).ok()?;
            // With a smaller radius in κ the third order of all orbits far from it would count as that of a large step.
            let kappa_radius = if kappa > 0.0 && kappa <= radius { radius } else { 0.0 };
            let mut orbit = orbit.with_radii(radius, kappa_radius);
            let mut speeds = Vec::with_capacity(hops);
            for _ in 0..hops {
                speeds.push((orbit.speed(), orbit.tangent()?.reach()));
                if orbit.hop() != Ok(ExtendedStep::LiftsOff) {
                    return None;
                }
            }
            let (offset, tangent) = (orbit.offset_from(n), orbit.tangent()?);
            let (second, third, fourth) = ([0.0; 3], [0.0; 3], 0.0);
            let mut edge =
                BesideEdge { start, mass_ratio, n, offset, tangent, second, third, fourth };
            edge.add_differences(hops)?;
            speeds.into_iter().for_each(|(speed, reach)| see(speed, reach));
            Some(edge)
        })
    }

    /// Measures the second and third order with orbits at the ends of the radii.
    fn add_differences(&mut self, hops: usize) -> Option<()> {
        let m = self.mass_ratio.value();
        let radii = [self.tangent.radius, self.tangent.kappa_radius];
        // The step in M for the step in κ, to first order: the true step is computed from M.
        let mass_step = radii[1] * (1.0 + m) * (1.0 + m);
        let mut rests = [(0.0, 0.0, 0.0); STEPS.len()];
        for (rest, (i, j)) in rests.iter_mut().zip(STEPS) {
            if j != 0 && radii[1] == 0.0 {
                continue;
            }
            let start = self.start + f64::from(i) * radii[0];
            let ratio = MassRatio::new(m + f64::from(j) * mass_step).ok()?;
            let map = LiftOffMap::new(ratio);
            let mut orbit = ExtendedOrbit::new(&map, start, Arithmetic::Bits106).ok()?;
            if !(0..hops).all(|_| orbit.hop() == Ok(ExtendedStep::LiftsOff)) {
                return None;
            }
            let (y, k) = (start - self.start, self.kappa_step(ratio));
            let moved = orbit.offset_from(self.n).0 - self.offset.0;
            let first = self.tangent.slope * y + self.tangent.kappa_slope * k;
            let unit = |step: f64, radius: f64| if radius > 0.0 { step / radius } else { 0.0 };
            *rest = (unit(y, radii[0]), unit(k, radii[1]), moved - first);
        }
        let [right, left, above, below, corners @ ..] = rests;
        let even = |a: (f64, f64, f64), b: (f64, f64, f64)| 0.5 * (a.2 + b.2);
        let cross = corners.map(|(s, t, rest)| s * t * rest).iter().sum::<f64>() / 4.0;
        self.second = [even(right, left), even(above, below), cross];
        let left_over = rests.map(|(s, t, rest)| (rest - self.second_order(s, t)).abs());
        let most = |of: &[f64]| OVER_SEEN * of.iter().copied().fold(0.0, f64::max);
        let (by_start, by_both) = left_over.split_at(2);
        let (by_kappa, by_both) = by_both.split_at(2);
        let (start, kappa) = (most(by_start), most(by_kappa));
        // In a corner two terms may cancel, which do not elsewhere.
        self.third = [start, kappa, most(by_both).max(start).max(kappa)];
        // The orders fall about like a geometric series.
        let first = self.tangent.first_order();
        let largest = |of: &[f64; 3]| of.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let ratio = (largest(&self.second) / first).max((largest(&self.third) / first).sqrt());
        self.fourth = OVER_SEEN * first * ratio * ratio * ratio;
        (self.fourth.is_finite() && self.third.iter().all(|third| third.is_finite())).then_some(())
    }

    /// The second order at a start and a κ in units of the radii.
    fn second_order(&self, s: f64, t: f64) -> f64 {
        let [by_start, by_kappa, by_both] = self.second;
        by_start * s * s + by_kappa * t * t + by_both * s * t
    }

    /// κ at `mass_ratio` minus κ of the reference, to all digits.
    fn kappa_step(&self, mass_ratio: MassRatio) -> f64 {
        let (to, from) = (mass_ratio.value(), self.mass_ratio.value());
        (to - from) / ((1.0 + to) * (1.0 + from))
    }

    /// Whether another search from `start` would find the same edge.
    pub(crate) fn is_near(&self, n: u64, start: f64, mass_ratio: MassRatio) -> bool {
        self.n == n && self.contains(mass_ratio) && (self.start - start).abs() <= SAME_EDGE
    }

    fn contains(&self, mass_ratio: MassRatio) -> bool {
        self.kappa_step(mass_ratio).abs() <= self.tangent.kappa_radius
    }

    /// The offset from α*_n to which the orbit of `alpha` comes, and a bound on its error; `None` for a start or a
    /// mass ratio too far away.
    pub(crate) fn offset(&self, alpha: f64, mass_ratio: MassRatio) -> Option<(f64, f64)> {
        let (y, k) = (alpha - self.start, self.kappa_step(mass_ratio)); // y is exact: both are near
        let OrbitTangent { slope, kappa_slope, rounding, radius, kappa_radius, .. } = self.tangent;
        if !(y.abs() <= radius && self.contains(mass_ratio)) {
            return None;
        }
        let s = y / radius;
        let t = if k == 0.0 { 0.0 } else { k / kappa_radius };
        let (size, both) = (s.abs().max(t.abs()), (s * t).abs());
        let [of_start, of_kappa, of_both] = self.third;
        let third =
            of_start * (s * s * s).abs() + of_kappa * (t * t * t).abs() + of_both * both * size;
        let (by_start, by_kappa) = (slope * y, kappa_slope * k);
        let offset = self.offset.0 + by_start + by_kappa + self.second_order(s, t);
        let error = self.offset.1
            + (rounding + self.fourth * size) * size
            + third
            + 4.0 * f64::EPSILON * (offset.abs() + by_start.abs() + by_kappa.abs());
        Some((offset, error))
    }
}

/// The start nearest to `near` whose orbit falls onto α*_n, to first order in the distance.
fn edge(map: &LiftOffMap, near: f64, (n, hops): (u64, usize)) -> Option<f64> {
    let (mut speed, mut slope) = (near, 1.0);
    for _ in 0..hops {
        slope *= map.slopes(speed).ok()??.by_speed;
        speed = map.image(speed).ok()??;
    }
    let start = near - FixedPointSpeed::new(n).offset_of(speed) / slope;
    (start.is_finite() && start > 0.0).then_some(start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use basin_of_attraction::SplitMix64;

    /// Starts and mass ratios beside random edges: their orbits in 256 bits are where the reference orbit says.
    #[test]
    fn orbits_beside_an_edge_are_within_the_bound() {
        let random = SplitMix64::from_seed(91);
        let (mut edges, mut points, mut largest) = (0, 0, 0.0_f64);
        for k in 0..400 {
            let part = |i: u64| random.uniform(64 * k + i);
            let m = 0.03 + 0.9 * part(0);
            let map = LiftOffMap::new(MassRatio::new(m).unwrap());
            let (hops, mut speed) = (1 + (3.0 * part(1)) as usize, 5.0 + 25.0 * part(2));
            let start = speed;
            let lifts_off = (0..hops).all(|_| match map.image(speed).unwrap() {
                Some(next) => {
                    speed = next;
                    true
                }
                None => false,
            });
            let n = (speed / std::f64::consts::PI) as u64;
            if !lifts_off || n == 0 {
                continue;
            }
            let kappa = if k % 2 == 0 { 1e-7 } else { 0.0 };
            let Some(edge) = BesideEdge::new(&map, start, (n, hops), kappa, |_, _| ()) else {
                continue;
            };
            edges += 1;
            for i in 0..20 {
                let step = |at: u64| (2.0 * part(at) - 1.0) * pxfm::f_exp10(-9.0 * part(at + 1));
                let alpha = edge.start + edge.tangent.radius * step(4 + 3 * i);
                let other = m + 0.9 * edge.tangent.kappa_radius * step(5 + 3 * i);
                let ratio = MassRatio::new(other).unwrap();
                let (offset, error) = edge.offset(alpha, ratio).unwrap();
                let map = LiftOffMap::new(ratio);
                let mut orbit = ExtendedOrbit::new(&map, alpha, Arithmetic::Bits256).unwrap();
                assert!((0..hops).all(|_| orbit.hop() == Ok(ExtendedStep::LiftsOff)));
                let off = (orbit.offset_from(n).0 - offset).abs();
                assert!(
                    off <= error,
                    "M = {other}, α = {alpha}, {hops}: {off:e} {error:e} {edge:?}"
                );
                largest = largest.max(off / error);
                points += 1;
            }
        }
        assert!(edges > 60 && points > 1000 && largest > 0.1, "{edges} {points} {largest}");
    }
}
