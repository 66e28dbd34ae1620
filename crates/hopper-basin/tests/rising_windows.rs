//! In the sudden windows (nπ, α*_n) the map rises, for small mass ratios: proved with intervals.
//!
//! With at most one sudden lift-off (M ≤ 0.9056) and the half time h of the first flight as the parameter,
//!
//! ```text
//!   b = α − h = Sρ,  x = 2hb,  V = b − h + κΓ,  g = dα/dh = Γ/D,  dΓ/dh = −4bα
//!   dx/dh = 2b + 2h(g − 1),  dV/dh = g − 2 − 4κbα
//!   α′ (dα′/dα)/α = 1 + 4μbD − μ [A dx/dh + B dV/dh]/(2αg)
//!   A = 2(−Γ₂ sin τ₂ − x₂ (1−cos τ₂)),  B = 2(−Γ₂ (1−cos τ₂) − x₂ (τ₂ − sin τ₂))       second flight
//! ```
//!
//! S, C, D, u, ρ, Γ of the first flight are monotone in h on a window, and so is the second flight's half time in
//! x and V: ends of intervals are values at ends. A millionth is added for roundings, a thousand times what they
//! amount to.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hopper_basin::rising_window;
use passive_hopper::{HalfFlight, LiftOffMap, MassRatio, alpha_star};
use std::f64::consts::PI;

/// [low, high].
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
        Range(all.into_iter().fold(f64::MAX, f64::min), all.into_iter().fold(f64::MIN, f64::max))
    }
    fn scaled(self, factor: f64) -> Self {
        Range::of(self.0 * factor, self.1 * factor)
    }
    fn shifted(self, by: f64) -> Self {
        Range(self.0 + by, self.1 + by)
    }
    /// For a divisor above zero.
    fn over(self, other: Self) -> Self {
        assert!(other.0 > 0.0);
        self.times(Range(1.0 / other.1, 1.0 / other.0))
    }
}

/// Half the time of the flight from (x, V), V < π: V(h) increases on (max(V, 0), π).
fn second(x: f64, v: f64) -> f64 {
    let (mut left, mut right) = (v.max(0.0), PI);
    for _ in 0..60 {
        let middle = 0.5 * (left + right);
        if HalfFlight::at(middle).start_speed(x) < v { left = middle } else { right = middle }
    }
    0.5 * (left + right)
}

/// α′ (dα′/dα)/α over h and M.
fn slope(h: Range, m: Range) -> Range {
    let (begin, end) = (HalfFlight::at(h.0), HalfFlight::at(h.1));
    let between = |f: fn(&HalfFlight) -> f64| Range::of(f(&begin), f(&end));
    let kappa = Range(m.0 / (1.0 + m.0), m.1 / (1.0 + m.1));
    let mu = Range(m.0 / (1.0 + m.0).powi(2), m.1 / (1.0 + m.1).powi(2));
    let d = between(|half| half.d());
    let closing = between(|half| half.closing_speed(0.0));
    let b = between(|half| half.sin()).times(between(|half| half.rho()));
    let b = Range(b.0.max(0.0), b.1);
    let alpha = between(|half| half.start_speed(0.0));
    let g = between(|half| half.start_speed_slope(0.0));
    let x = h.times(b).scaled(2.0);
    let v = b.minus(h).plus(kappa.times(closing));
    let b_alpha = b.times(alpha);
    let x_slope = b.scaled(2.0).plus(h.times(g.shifted(-1.0)).scaled(2.0));
    let v_slope = g.shifted(-2.0).minus(kappa.times(b_alpha).scaled(4.0));
    assert!(v.1 < PI);
    // The second flight.
    let h2 = Range(second(x.0, v.0) * (1.0 - 1e-9), (second(x.1, v.1) * (1.0 + 1e-9)).min(PI));
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

/// Proves the bounds on a box, or halves it.
fn prove(h: Range, m: Range, (star, steepest): (f64, f64), boxes: &mut usize) {
    *boxes += 1;
    assert!(*boxes < 3_000_000, "no proof at h = {h:?}, M = {m:?}: {:?}", slope(h, m));
    let found = slope(h, m);
    if found.0 > 1e-6 && found.1 + 1e-6 < steepest {
        return;
    }
    // Lengths against what the slope depends on: the distance from α*_n, and κ times α.
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
        // h of the upper end, by A(h) = α: h < α.
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
        let limits = (alpha_star(n), window.steepest);
        let ratios = Range(0.0, window.largest_mass_ratio);
        prove(Range(n as f64 * PI, right), ratios, limits, &mut boxes);
        println!("window {n}: {boxes} boxes");
    }
}

/// The formula is the derivative that the map itself gives.
#[test]
fn the_slope_is_the_maps() {
    for k in 0..4000u32 {
        let part = |step: f64| (f64::from(k) * step).fract();
        let n = 1 + u64::from(k % 8);
        let window = rising_window(n).unwrap();
        let m = 0.001 + (window.largest_mass_ratio - 0.001) * part(0.618_033_988_749_895);
        let alpha =
            window.part.left + window.part.length() * (0.001 + 0.998 * part(0.754_877_666_246_693));
        let map = LiftOffMap::new(MassRatio::new(m).unwrap());
        let exact = map.slopes(alpha).unwrap().unwrap().by_speed
            * map.image(alpha).unwrap().unwrap()
            / alpha;
        let h = 0.5 * map.landings(alpha).unwrap().next().unwrap().unwrap().time;
        let found = slope(Range(h, h), Range(m, m));
        assert!(
            (found.0 - exact).abs() < 1e-6 * exact.abs() + 1e-7,
            "M = {m}, α = {alpha}: {found:?} {exact}"
        );
    }
}
