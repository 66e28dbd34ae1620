//! The sudden windows (nπ, α*_n) on which the map is proved to rise.
//!
//! The proof (docs/theory.md, Theorem 48) is a test at the end of this file. It encloses the derivative over the plane
//! of h and M with intervals.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::traps::trap::{Trap, TrapEdge};
use basin_of_attraction::Interval;
use passive_hopper::alpha_star;
use std::f64::consts::PI;

/// The distance from α*_n at which the proof ends.
///
/// At α*_n the slope changes like the cube root of the distance, and an interval proof needs ever smaller boxes. Speeds
/// in the remaining 10⁻³ have no lap; in a raster of the paper's window they are 0.03 % of the rows.
const DISTANCE_FROM_STAR: f64 = 1e-3;

/// For the windows n = 1, 2, …: the largest M. It must be below 0.9056, up to which a hop has at most one sudden lift-off.
///
/// The mass ratios of windows 4 to 8 are smaller, because near 0.905 the smallest slope tends to zero with n and a
/// proof needs more boxes. With them each window takes 10 000 to 12 600 boxes; up to M = 0.905 window 4 would take 10
/// 400 and window 8 would take 41 600. Larger mass ratios would prove more and test longer. Samples rise in windows 9
/// and 10 too.
const PROVED: [f64; 8] = [0.905, 0.905, 0.905, 0.9, 0.89, 0.87, 0.85, 0.83];

/// A part of a sudden window on which the map is proved to rise, for small mass ratios.
///
/// For these mass ratios a hop has at most one sudden lift-off, and the map is continuous on the window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RisingWindow {
    /// From nπ to 10⁻³ below α*_n.
    pub part: Interval,
    /// The largest M of the proof.
    pub largest_mass_ratio: f64,
}

/// Window n if n is in 1, …, 8; `None` for all other windows, for which there is no proof.
pub fn rising_window(n: u64) -> Option<RisingWindow> {
    let at = usize::try_from(n).ok()?.checked_sub(1)?;
    let &largest_mass_ratio = PROVED.get(at)?;
    let part = Interval { left: n as f64 * PI, right: alpha_star(n) - DISTANCE_FROM_STAR };
    Some(RisingWindow { part, largest_mass_ratio })
}

/// The trap of α*_n, with the window beyond it if f stays above α*_n there.
///
/// If f ≥ α*_n on the whole contact part of hump n, and f is continuous at (n+1)π and rises from there to α*_{n+1} (docs/theory.md,
/// Theorems 23, 48 and 81), f ≥ α*_n on the whole window.
pub(crate) fn trap_with_window(fates: &Fates, n: u64) -> Result<Trap, Error> {
    let trap = fates.trap(n)?;
    let ratio = fates.map().mass_ratio().value();
    let rises = rising_window(n + 1).is_some_and(|window| ratio <= window.largest_mass_ratio);
    match trap.edge {
        TrapEdge::ContactEnd if rises => Ok(Trap { edge: TrapEdge::NextFixedPoint, ..trap }),
        _ => Ok(trap),
    }
}

#[cfg(test)]
mod tests {
    //! Proof with intervals: for small mass ratios the map rises in the sudden windows (nπ, α*_n).
    //!
    //! The parameter is h, half the time of the first flight. With at most one sudden lift-off (M ≤ 0.9056),
    //!
    //! ```text
    //!   b = α − h = Sρ,  x = 2hb,  V = b − h + κΓ,  g = dα/dh = Γ/D,  dΓ/dh = −4bα
    //!   dx/dh = 2b + 2h(g − 1),  dV/dh = g − 2 − 4κbα
    //!   α′ (dα′/dα)/α = 1 + 4μbD − μ [A dx/dh + B dV/dh]/(2αg)
    //!   A = 2(−Γ₂ sin τ₂ − x₂ (1−cos τ₂)),  B = 2(−Γ₂ (1−cos τ₂) − x₂ (τ₂ − sin τ₂))       second flight
    //! ```
    //!
    //! S, C, D, u, ρ, Γ of the first flight are monotone in h on a window, and half the time of the second flight is
    //! monotone in x and V. Therefore the values at the ends of an interval give the range of each over the interval
    //! (docs/theory.md, Lemma 14). The intervals are not rounded outwards. Instead the bounds must hold with a margin
    //! of 10⁻⁶, a thousand times the rounding errors.

    #![allow(clippy::disallowed_methods)]

    use super::*;
    use crate::fates::hopper_fate::HopperFate;
    use passive_hopper::{HalfFlight, LiftOffMap, MassRatio};

    /// The interval [low, high].
    #[derive(Clone, Copy, Debug)]
    struct Range(f64, f64);

    impl Range {
        /// Between two values, in any order.
        fn of(a: f64, b: f64) -> Self {
            Range(a.min(b), a.max(b))
        }
        fn plus(self, other: Self) -> Self {
            Range(self.0 + other.0, self.1 + other.1)
        }
        fn minus(self, other: Self) -> Self {
            Range(self.0 - other.1, self.1 - other.0)
        }
        fn times(self, other: Self) -> Self {
            let all = [self.0 * other.0, self.0 * other.1, self.1 * other.0, self.1 * other.1];
            Range(
                all.into_iter().fold(f64::MAX, f64::min),
                all.into_iter().fold(f64::MIN, f64::max),
            )
        }
        fn scaled(self, factor: f64) -> Self {
            Range::of(self.0 * factor, self.1 * factor)
        }
        fn shifted(self, by: f64) -> Self {
            Range(self.0 + by, self.1 + by)
        }
        /// The quotient, for a divisor whose numbers are all positive.
        fn over(self, other: Self) -> Self {
            assert!(other.0 > 0.0);
            self.times(Range(1.0 / other.1, 1.0 / other.0))
        }
    }

    /// Half the time of the flight from (x, V), V < π, by bisection: V(h) increases on (max(V, 0), π). Sixty
    /// halvings reach neighbouring `f64`.
    fn second(x: f64, v: f64) -> f64 {
        let (mut left, mut right) = (v.max(0.0), PI);
        for _ in 0..60 {
            let middle = 0.5 * (left + right);
            if HalfFlight::at(middle).start_speed(x) < v { left = middle } else { right = middle }
        }
        0.5 * (left + right)
    }

    /// The relative slope α′ (dα′/dα)/α over intervals of h and M.
    fn slope(h: Range, m: Range) -> Range {
        let (begin, end) = (HalfFlight::at(h.0), HalfFlight::at(h.1));
        let between = |f: fn(&HalfFlight) -> f64| Range::of(f(&begin), f(&end));
        let kappa = Range(m.0 / (1.0 + m.0), m.1 / (1.0 + m.1));
        let mu = Range(m.0 / (1.0 + m.0).powi(2), m.1 / (1.0 + m.1).powi(2));
        let d = between(|half| half.d());
        let closing = between(|half| half.closing_speed(0.0));
        let b = between(|half| half.sin()).times(between(|half| half.rho()));
        // b = Sρ ≥ 0 on a window; at its ends rounding may give a negative number.
        let b = Range(b.0.max(0.0), b.1);
        let alpha = between(|half| half.start_speed(0.0));
        let g = between(|half| half.start_speed_slope(0.0));
        let x = h.times(b).scaled(2.0);
        let v = b.minus(h).plus(kappa.times(closing));
        let b_alpha = b.times(alpha);
        let x_slope = b.scaled(2.0).plus(h.times(g.shifted(-1.0)).scaled(2.0));
        let v_slope = g.shifted(-2.0).minus(kappa.times(b_alpha).scaled(4.0));
        assert!(v.1 < PI);
        // The second flight. A relative 10⁻⁹ covers the error of the bisection.
        let h2 = Range(second(x.0, v.0) * (1.0 - 1e-9), (second(x.1, v.1) * (1.0 + 1e-9)).min(PI));
        // At h = 0 the functions divide by zero. The shift of 10⁻⁹ changes them by less than the margin of 10⁻⁶.
        let half = |h: f64| HalfFlight::at(h.max(1e-9));
        let (begin, end) = (half(h2.0), half(h2.1));
        let top = if h2.0 < PI / 2.0 && h2.1 > PI / 2.0 { 1.0 } else { begin.sin().max(end.sin()) };
        let sin = Range(begin.sin().min(end.sin()), top);
        let cos = Range(end.cos(), begin.cos());
        let u = Range(-begin.u(), -end.u());
        let rho = Range(-begin.rho(), -end.rho());
        let closing2 = rho.times(u.plus(x.times(sin))).scaled(2.0);
        let x2 = x.plus(h2.times(v.minus(h2)).scaled(2.0));
        let versine = sin.times(sin).scaled(2.0);
        let delay = Range(begin.d(), end.d()).scaled(2.0);
        let by_x = closing2.times(sin.times(cos)).scaled(2.0).plus(x2.times(versine)).scaled(-2.0);
        let by_v = closing2.times(versine).plus(x2.times(delay)).scaled(-2.0);
        let taken = by_x.times(x_slope).plus(by_v.times(v_slope)).over(alpha.times(g).scaled(2.0));
        mu.times(b.times(d).scaled(4.0).minus(taken)).shifted(1.0)
    }

    /// Proves the bounds on a box of h and M. A box whose intervals are too wide is halved.
    fn prove(h: Range, m: Range, (star, steepest): (f64, f64), boxes: &mut usize) {
        *boxes += 1;
        // A proof takes far fewer boxes. Without this limit the boxes of a false bound would be halved for ever.
        assert!(*boxes < 3_000_000, "no proof at h = {h:?}, M = {m:?}: {:?}", slope(h, m));
        let found = slope(h, m);
        if found.0 > 1e-6 && found.1 + 1e-6 < steepest {
            return;
        }
        // The longer side is halved. Lengths of h count relative to the distance from α*_n, on which the slope
        // depends. The factor 2 changes the number of boxes only: window 5 takes 8 500 with ½, 12 600 with 2 and 36
        // 000 with 8.
        if (h.1 - h.0) / (star - h.0).min(0.5) > 2.0 * (m.1 - m.0) {
            let middle = 0.5 * (h.0 + h.1);
            prove(Range(h.0, middle), m, (star, steepest), boxes);
            prove(Range(middle, h.1), m, (star, steepest), boxes);
        } else {
            let middle = 0.5 * (m.0 + m.1);
            prove(h, Range(m.0, middle), (star, steepest), boxes);
            prove(h, Range(middle, m.1), (star, steepest), boxes);
        }
    }

    #[test]
    fn the_map_rises_in_its_windows() {
        for n in 1..=8 {
            let window = rising_window(n).unwrap();
            // h of the upper end solves A(h) = α; A(h) > h on the window.
            let (mut left, mut right) = (n as f64 * PI, alpha_star(n));
            for _ in 0..60 {
                let middle = 0.5 * (left + right);
                if HalfFlight::at(middle).start_speed(0.0) < window.part.right {
                    left = middle
                } else {
                    right = middle
                }
            }
            let mut boxes = 0;
            // The relative slope α′ (dα′/dα)/α is proved to be below 8n + 2, a third above the largest found on samples.
            let limits = (alpha_star(n), 8.0 * n as f64 + 2.0);
            let ratios = Range(0.0, window.largest_mass_ratio);
            prove(Range(n as f64 * PI, right), ratios, limits, &mut boxes);
        }
    }

    /// The formula agrees with the derivative of the map.
    #[test]
    fn the_slope_is_that_of_the_map() {
        for k in 0..4000u32 {
            let part = |step: f64| (f64::from(k) * step).fract();
            let n = 1 + u64::from(k % 8);
            let window = rising_window(n).unwrap();
            let m = 0.001 + (window.largest_mass_ratio - 0.001) * part(0.618_033_988_749_895);
            let alpha = window.part.left
                + window.part.length() * (0.001 + 0.998 * part(0.754_877_666_246_693));
            let map = LiftOffMap::new(MassRatio::new(m).unwrap());
            let exact = map.slopes(alpha).unwrap().unwrap().by_speed
                * map.image(alpha).unwrap().unwrap()
                / alpha;
            let h = 0.5 * map.landings(alpha).unwrap()[0].time;
            let found = slope(Range(h, h), Range(m, m));
            assert!(
                (found.0 - exact).abs() < 1e-6 * exact.abs() + 1e-7,
                "M = {m}, α = {alpha}: {found:?} {exact}"
            );
        }
    }

    /// Only windows 1 to 8 have a proof.
    #[test]
    fn a_window_other_than_1_to_8_has_no_proof() {
        for n in [0, 9, 10, u64::MAX] {
            assert_eq!(rising_window(n), None);
        }
        let window = rising_window(1).unwrap();
        assert!(window.largest_mass_ratio > 0.9 && window.part.contains(4.0));
    }

    /// A trap that reaches over its window has the fates of single orbits, up to the next fixed point.
    #[test]
    fn a_trap_over_a_window_has_the_fates_of_its_orbits() {
        let mut extended = 0;
        for k in 0..600u32 {
            let part = |step: f64| (f64::from(k) * step).fract();
            let fates = Fates::new(MassRatio::new(0.01 + 0.4 * part(0.618_033_988_75)).unwrap());
            let (fates, n) = (fates.unwrap(), u64::from(k % 3));
            let trap = trap_with_window(&fates, n).unwrap();
            if fates.trap(n).unwrap().edge != TrapEdge::ContactEnd {
                assert_eq!(trap, fates.trap(n).unwrap());
                continue;
            }
            assert_eq!(trap.edge, TrapEdge::NextFixedPoint);
            let (left, right) = ((n + 1) as f64 * PI, alpha_star(n + 1));
            for alpha in [left + (right - left) * part(0.754_877_666_25), right - 1e-9 * right] {
                assert!(trap.contains(alpha));
                let label = fates.fate(alpha).unwrap().label();
                assert_eq!(
                    label,
                    HopperFate::label_of_fixed_point(n),
                    "M = {}, α = {alpha}",
                    fates.map().mass_ratio().value()
                );
            }
            extended += 1;
        }
        assert!(extended > 100, "{extended}");
    }
}
