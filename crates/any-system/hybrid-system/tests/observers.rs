//! Observers: guards that are crossed both ways, again and again, without a jump of the state. Every start after an
//! event lies on the surface within the rounding of the guard's own arithmetic.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::Vector2;

/// How the crossings are found.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Flow {
    /// Closed form, sampled guards.
    Sampled,
    /// Closed form, enclosures.
    Enclosed,
    /// Integrated with this tolerance.
    Integrated(f64),
}

/// A guard on the unit circle, with random parameters.
#[derive(Debug, Clone)]
enum Shape {
    /// (x − a)² + (y − b)² − r².
    Circle([f64; 3]),
    /// eˣ − c.
    Exponential(f64),
    /// hypot(x − 2, y) − d.
    Distance(f64),
    /// sin(atan2(y, x) + p).
    Angle(f64),
    /// Σ aₖ sin(kₖ x + lₖ y + pₖ).
    Sines([[f64; 4]; 3]),
}

impl Shape {
    fn value(&self, x: f64, y: f64) -> f64 {
        match self {
            Shape::Circle([a, b, r]) => (x - a).powi(2) + (y - b).powi(2) - r * r,
            Shape::Exponential(c) => x.exp() - c,
            Shape::Distance(d) => (x - 2.0).hypot(y) - d,
            Shape::Angle(p) => (y.atan2(x) + p).sin(),
            Shape::Sines(terms) => {
                terms.iter().map(|[a, k, l, p]| a * (k * x + l * y + p).sin()).sum()
            }
        }
    }
    /// dg/dθ on the unit circle.
    fn rate(&self, x: f64, y: f64) -> f64 {
        match self {
            Shape::Circle([a, b, _]) => 2.0 * (a * y - b * x),
            Shape::Exponential(_) => -y * x.exp(),
            Shape::Distance(_) => 2.0 * y / (x - 2.0).hypot(y),
            Shape::Angle(p) => (y.atan2(x) + p).cos(),
            Shape::Sines(terms) => terms
                .iter()
                .map(|[a, k, l, p]| a * (l * x - k * y) * (k * x + l * y + p).cos())
                .sum(),
        }
    }
    /// Bounds on |g′|, |g″| along the circle.
    fn bounds(&self) -> [f64; 2] {
        match self {
            Shape::Circle([a, b, _]) => [2.0 * a.hypot(*b); 2],
            Shape::Exponential(_) => [3.0, 6.0],
            Shape::Distance(_) => [2.0, 7.0],
            Shape::Angle(_) => [1.0; 2],
            Shape::Sines(terms) => {
                let sum = |f: fn(f64) -> f64| -> f64 {
                    terms.iter().map(|[a, k, l, _]| a.abs() * f(k.hypot(*l))).sum()
                };
                [sum(|s| s), sum(|s| s + s * s)]
            }
        }
    }
    /// The angles in (from, to] at which the guard changes its sign, with its rates there; `None` if a zero is not
    /// transversal, or a guard nearly touches zero.
    fn crossings(&self, from: f64, to: f64) -> Option<Vec<(f64, f64)>> {
        const PARTS: usize = 2000;
        let value = |angle: f64| self.value(angle.cos(), angle.sin());
        let rate = |angle: f64| self.rate(angle.cos(), angle.sin());
        let at = |k: usize| from + (to - from) * k as f64 / PARTS as f64;
        let mut found = Vec::new();
        for k in 0..PARTS {
            let (mut low, mut high) = (at(k), at(k + 1));
            if value(low).abs() < 1e-2 && rate(low).abs() < 1e-1 {
                return None;
            }
            if (value(low) < 0.0) == (value(high) < 0.0) {
                continue;
            }
            let sign = value(low).signum();
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if value(middle) * sign > 0.0 { low = middle } else { high = middle }
            }
            found.push((high, rate(high)));
        }
        if value(from).abs() < 1e-2 || value(to).abs() < 1e-2 { None } else { Some(found) }
    }
}

/// A point on the unit circle that is watched, in one mode or in two modes in turn.
struct Watched {
    shape: Shape,
    flow: Flow,
    in_turn: bool,
}

impl HybridSystem for Watched {
    type State = State<2>;
    type Mode = bool;
    type Surface = ();
    fn flow(&self, mode: bool, x: &State<2>, t: f64) -> State<2> {
        match self.flow {
            Flow::Integrated(tolerance) => {
                integrated_flow(self, mode, x, t, Tolerances::both(tolerance))
            }
            _ => {
                let (sin, cos) = t.sin_cos();
                Vector2::new(x[0] * cos - x[1] * sin, x[0] * sin + x[1] * cos)
            }
        }
    }
    fn vector_field(&self, _: bool, x: &State<2>) -> Option<State<2>> {
        matches!(self.flow, Flow::Integrated(_)).then(|| Vector2::new(-x[1], x[0]))
    }
    fn guards(&self, mode: bool) -> &[Guard<()>] {
        match (self.in_turn, mode) {
            (false, _) => const { &[Guard::either(())] },
            (true, true) => const { &[Guard::rising(())] },
            (true, false) => const { &[Guard::falling(())] },
        }
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        self.shape.value(x[0], x[1])
    }
    fn reset(&self, mode: bool, _: (), x: &State<2>) -> Reset<bool, State<2>> {
        Reset::Jump { mode: !mode, state: *x }
    }
    fn guard_enclosure(
        &self,
        mode: bool,
        _: (),
        x: &State<2>,
        order: u32,
        (from, to): (f64, f64),
    ) -> Option<Enclosure> {
        if self.flow != Flow::Enclosed {
            return None;
        }
        let middle = self.flow(mode, x, 0.5 * (from + to));
        let (value, bound) = match order {
            0 => (self.shape.value(middle[0], middle[1]), self.shape.bounds()[0]),
            1 => (self.shape.rate(middle[0], middle[1]), self.shape.bounds()[1]),
            _ => return None,
        };
        Some(Enclosure::around(value, bound * (0.5 * (to - from)) + 2e-14 * (1.0 + bound)))
    }
    fn first_crossing(
        &self,
        mode: bool,
        x: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        match self.flow {
            Flow::Integrated(tolerance) => {
                integrated_crossing(self, mode, x, search, Tolerances::both(tolerance))
            }
            _ => default_search(self, mode, x, search),
        }
    }
}

/// Numbers in [0, 1): SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
    fn shape(&mut self, kind: usize) -> Shape {
        match kind {
            0 => Shape::Circle([
                self.between(-1.0, 1.0),
                self.between(-1.0, 1.0),
                self.between(0.3, 1.5),
            ]),
            1 => Shape::Exponential(self.between(0.4, 2.6)),
            2 => Shape::Distance(self.between(1.05, 2.95)),
            3 => Shape::Angle(self.between(-3.0, 3.0)),
            _ => Shape::Sines(std::array::from_fn(|_| {
                [
                    self.between(-1.0, 1.0),
                    self.between(-3.0, 3.0),
                    self.between(-3.0, 3.0),
                    self.between(0.0, 6.0),
                ]
            })),
        }
    }
}

/// Runs of this kind of guard that do not find each transversal crossing once and at the right time.
fn failures(kind: usize, flow: Flow, in_turn: bool, runs: usize) -> (usize, usize, String) {
    let mut random = Random(1 + kind as u64);
    let (mut done, mut failed, mut first) = (0, 0, String::new());
    while done < runs {
        let shape = random.shape(kind);
        let start = random.between(-3.0, 3.0);
        let Some(exact) = shape.crossings(start, start + 20.0) else { continue };
        if exact.is_empty() {
            continue;
        }
        done += 1;
        let above = shape.value(start.cos(), start.sin()) > 0.0;
        let system = Watched { shape, flow, in_turn };
        let limits = Limits::sampled(20.0, 1000, 1e-2);
        let state = Vector2::new(start.cos(), start.sin());
        let tolerance = if let Flow::Integrated(tolerance) = flow { tolerance } else { 1e-14 };
        let mut events = Vec::new();
        let mut why = None;
        for arc in Execution::new(&system, !above, state, limits) {
            match arc {
                Ok(arc) => events.extend(arc.event().map(|event| event.time)),
                Err(error) => why = Some(error.to_string()),
            }
        }
        if why.is_none() && events.len() != exact.len() {
            why = Some(format!("{} events instead of {}", events.len(), exact.len()));
        }
        for (time, (angle, rate)) in events.iter().zip(&exact) {
            // The errors of the steps add up; the guards' gradients are below 10.
            let error = (time - (angle - start)).abs();
            let bound = (100.0 * tolerance + 1e-12) * (1.0 + 10.0 / rate.abs());
            if why.is_none() && !(error <= bound) {
                why = Some(format!("an error of {error:e} at {time}, rate {rate}"));
            }
        }
        if let Some(why) = why {
            failed += 1;
            if first.is_empty() {
                first = format!("{why}: {:?} from {start}", system.shape);
            }
        }
    }
    (failed, runs, first)
}

#[test]
fn every_transversal_crossing_of_an_observer_is_found_once() {
    let mut all = String::new();
    for kind in 0..5 {
        let integrated = [1e-6, 1e-8, 1e-10, 1e-12, 1e-13].map(Flow::Integrated);
        // Without optimization a quarter of the cases runs.
        let cases = if cfg!(debug_assertions) { 15 } else { 60 };
        for flow in [Flow::Sampled, Flow::Enclosed].into_iter().chain(integrated) {
            for in_turn in [false, true] {
                let (failed, runs, first) = failures(kind, flow, in_turn, cases);
                if failed > 0 {
                    all += &format!(
                        "{kind} {flow:?} in turn {in_turn}: {failed} of {runs}: {first}\n"
                    );
                }
            }
        }
    }
    assert!(all.is_empty(), "{all}");
}

/// The events of an observer cost as much late in a run as early: 2000 sections of an oscillator. (Once the error by a
/// divided flight was computed at each of them, along a part of all flights before.)
#[test]
fn late_events_cost_as_much_as_early_ones() {
    let calls = std::cell::Cell::new(0_u64);
    let oscillator = Model::integrated(|(), x: &State<2>| {
        calls.set(calls.get() + 1);
        [x[1], -x[0]]
    })
    .either((), |x| x[0], |x| ((), *x));
    let mut each = Vec::new();
    for arc in oscillator.run((), [1.0, 0.0], 1000.0 * std::f64::consts::TAU) {
        arc.unwrap();
        each.push(calls.replace(0));
    }
    assert_eq!(each.len(), 2001);
    let sum = |range: std::ops::Range<usize>| each[range].iter().sum::<u64>();
    assert!(sum(1900..2000) <= 2 * sum(100..200), "{} {}", sum(100..200), sum(1900..2000));
}
