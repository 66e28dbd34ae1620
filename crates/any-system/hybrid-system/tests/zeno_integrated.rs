//! Zeno limits along integrated flows: a ball that comes to rest on moving and curved surfaces, with drag and springs.
//!
//! The limits are sums of flight times. Each flight has a closed form, and its end is found by bisection.

#![cfg(feature = "ode")]
#![allow(clippy::excessive_precision)] // published digits, as they are printed

use hybrid_system::*;
use nalgebra::{Vector2, Vector3, Vector4};

/// What acts on the ball.
#[derive(Debug, Clone, Copy)]
enum Force {
    /// Gravity.
    Gravity(f64),
    /// Gravity and a drag −c ẏ.
    Drag(f64, f64),
    /// Gravity and a spring −k y.
    Spring(f64, f64),
}

impl Force {
    fn acceleration(self, y: f64, v: f64) -> f64 {
        match self {
            Force::Gravity(g) => -g,
            Force::Drag(g, c) => -g - c * v,
            Force::Spring(g, k) => -g - k * y,
        }
    }
    /// Rise and speed after a time. Each term is of the order of the time, so that short flights lose no digits.
    fn flight(self, y: f64, v: f64, t: f64) -> (f64, f64) {
        match self {
            Force::Gravity(g) => (t * (v - 0.5 * g * t), v - g * t),
            Force::Drag(g, c) => {
                // v + g/c decays like e^(−ct).
                let part = -(-c * t).exp_m1() / c;
                (v * t - (v + g / c) * (t - part), v - (v + g / c) * c * part)
            }
            Force::Spring(g, k) => {
                let (w, middle) = (k.sqrt(), -g / k);
                let (sin, cos) = (w * t).sin_cos();
                let half = (0.5 * w * t).sin();
                let rise = v / w * sin - 2.0 * (y - middle) * half * half;
                (rise, v * cos - (y - middle) * w * sin)
            }
        }
    }
}

/// The height of the table, and its first two derivatives: u t + ½ a t² + A sin(w t).
#[derive(Debug, Clone, Copy)]
struct Table {
    speed: f64,
    acceleration: f64,
    amplitude: f64,
    frequency: f64,
}

impl Table {
    fn height(self, t: f64) -> f64 {
        t * (self.speed + 0.5 * self.acceleration * t) + self.amplitude * (self.frequency * t).sin()
    }
    /// The rise from `t` on, without cancellation.
    fn rise(self, t: f64, after: f64) -> f64 {
        let half = 0.5 * self.frequency * after;
        let wave = 2.0 * self.amplitude * half.sin() * (self.frequency * t + half).cos();
        after * (self.speed + self.acceleration * (t + 0.5 * after)) + wave
    }
    fn speed(self, t: f64) -> f64 {
        self.speed
            + self.acceleration * t
            + self.amplitude * self.frequency * (self.frequency * t).cos()
    }
    fn bend(self, t: f64) -> f64 {
        self.acceleration - self.amplitude * self.frequency.powi(2) * (self.frequency * t).sin()
    }
}

/// A ball over a table: (y, ẏ, t).
#[derive(Debug, Clone, Copy)]
struct Ball {
    force: Force,
    table: Table,
    restitution: f64,
    /// The guard is e^gap − 1 instead of the gap.
    curved: bool,
    tolerance: f64,
}

impl HybridSystem for Ball {
    type State = State<3>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, mode: (), x: &State<3>, t: f64) -> State<3> {
        integrated_flow(self, mode, x, t, Tolerances::both(self.tolerance))
    }
    fn vector_field(&self, _: (), x: &State<3>) -> Option<State<3>> {
        Some(Vector3::new(x[1], self.force.acceleration(x[0], x[1]), 1.0))
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, _: (), x: &State<3>) -> f64 {
        let gap = x[0] - self.table.height(x[2]);
        if self.curved { gap.exp_m1() } else { gap }
    }
    fn reset(&self, _: (), _: (), x: &State<3>) -> Reset<(), State<3>> {
        let table = self.table.speed(x[2]);
        let speed = table - self.restitution * (x[1] - table);
        Reset::Jump { mode: (), state: Vector3::new(x[0], speed, x[2]) }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<3>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<3>>, Error> {
        integrated_crossing(self, mode, x, search, Tolerances::both(self.tolerance))
    }
}

impl Ball {
    /// The time of the limit from height `y` at rest, by flights in closed form.
    fn limit(&self, y: f64) -> f64 {
        let (mut y, mut v, mut t) = (y, 0.0, 0.0);
        let mut first = true;
        loop {
            let relative = v - self.table.speed(t);
            let pull = self.table.bend(t) - self.force.acceleration(y, v);
            // A flight at the speed 10⁻⁸ lasts about 2·10⁻⁸. The factor between two flights is the restitution, up to
            // terms of the order of their durations.
            if !first && relative < 1e-8 {
                return t + 2.0 * relative / (pull * (1.0 - self.restitution));
            }
            let height = if first { y - self.table.height(0.0) } else { 0.0 };
            let gap =
                |time: f64| height + self.force.flight(y, v, time).0 - self.table.rise(t, time);
            let (mut low, mut high) =
                if first { (0.0, 1e-2) } else { (relative / pull, 1.5 * relative / pull) };
            while gap(high) > 0.0 {
                (low, high) = (high, high * 1.05);
                assert!(high < 100.0, "{self:?}: no bounce after {t}");
            }
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if gap(middle) > 0.0 { low = middle } else { high = middle }
            }
            let (_, speed) = self.force.flight(y, v, high);
            t += high;
            let table = self.table.speed(t);
            (y, v) = (self.table.height(t), table - self.restitution * (speed - table));
            first = false;
        }
    }

    /// The limit of the execution, or its error.
    fn found(&self, y: f64) -> Result<ZenoLimit<State<3>>, String> {
        let start = Vector3::new(y, 0.0, 0.0);
        for arc in Execution::new(self, (), start, Limits::new(100.0, 10_000)) {
            let arc = arc.map_err(|error| error.to_string())?;
            if let ArcEnd::Zeno { limit, .. } = arc.end {
                return Ok(limit);
            }
        }
        Err("no limit".to_string())
    }
}

#[test]
fn bounces_on_moving_surfaces_accumulate_at_their_limits() {
    let still = Table { speed: 0.0, acceleration: 0.0, amplitude: 0.0, frequency: 0.0 };
    let rising = Table { speed: 0.3, ..still };
    let falling = Table { speed: -0.2, acceleration: -0.4, ..still };
    // A ball that is slowed by drag or held by a spring stays behind a table that falls faster, and has no limit.
    let sinking = Table { speed: -0.1, acceleration: -0.02, ..still };
    let shaken = Table { amplitude: 0.05, frequency: 3.0, ..still };
    let slow = Table { speed: 1e-3, amplitude: 0.5, frequency: 0.1, ..still };
    let gravity = Force::Gravity(1.0);
    let weak = Force::Gravity(1e-2);
    let (drag, spring) = (Force::Drag(1.0, 0.3), Force::Spring(1.0, 0.7));
    let mut cases = Vec::new();
    for (table, second) in [(rising, rising), (falling, sinking), (shaken, shaken), (slow, slow)] {
        cases.push((table, gravity, 0.5, false));
        cases.push((second, drag, 0.8, false));
        cases.push((second, spring, 0.6, false));
    }
    cases.extend([
        (still, gravity, 0.5, true),
        (rising, drag, 0.7, true),
        (shaken, spring, 0.3, true),
        (still, weak, 0.5, false),
        (Table { speed: 1e-4, ..still }, weak, 0.6, false),
        (shaken, gravity, 0.85, false),
        (still, drag, 0.5, false),
        (still, spring, 0.9, false),
    ]);
    assert_eq!(cases.len(), 20);
    let mut wrong = String::new();
    for (table, force, restitution, curved) in cases {
        for tolerance in [1e-8, 1e-12] {
            let ball = Ball { force, table, restitution, curved, tolerance };
            let exact = ball.limit(0.5);
            match ball.found(0.5) {
                // The sum of flights in closed form is known within 10⁻¹²: the roundings of its terms, and the square
                // of the time that is left at a speed of 10⁻⁸.
                Ok(limit) if (limit.time - exact).abs() <= limit.time_error + 1e-12 => {}
                Ok(limit) => {
                    let error = limit.time - exact;
                    wrong += &format!("{ball:?}: {error:e}, bound {:e}\n", limit.time_error);
                }
                Err(why) => wrong += &format!("{ball:?}: {why}\n"),
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// A ball in a parabolic bowl y = c x²/2, without friction: (x, y, ẋ, ẏ). The gap is quadratic in time.
struct Bowl {
    curvature: f64,
    restitution: f64,
}

impl HybridSystem for Bowl {
    type State = State<4>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, mode: (), x: &State<4>, t: f64) -> State<4> {
        integrated_flow(self, mode, x, t, Tolerances::both(1e-11))
    }
    fn vector_field(&self, _: (), x: &State<4>) -> Option<State<4>> {
        Some(Vector4::new(x[2], x[3], 0.0, -1.0))
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, _: (), x: &State<4>) -> f64 {
        x[1] - 0.5 * self.curvature * x[0] * x[0]
    }
    fn reset(&self, _: (), _: (), x: &State<4>) -> Reset<(), State<4>> {
        // The normal (−c x, 1).
        let slope = self.curvature * x[0];
        let normal = (x[3] - slope * x[2]) / (1.0 + slope * slope);
        let change = (1.0 + self.restitution) * normal;
        Reset::Jump {
            mode: (),
            state: Vector4::new(x[0], x[1], x[2] + change * slope, x[3] - change),
        }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<4>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<4>>, Error> {
        integrated_crossing(self, mode, x, search, Tolerances::both(1e-11))
    }
}

#[test]
fn bounces_in_a_bowl_accumulate_at_their_limit() {
    for (curvature, restitution) in [(0.5, 0.5), (1.0, 0.7), (-0.3, 0.6)] {
        let bowl = Bowl { curvature, restitution };
        let start = Vector4::new(0.3, 0.5, 0.2, 0.0);
        // By hand: gap(t) = (y − c x²/2) + (ẏ − c x ẋ) t − ½ (1 + c ẋ²) t².
        let (mut x, mut exact) = (start, 0.0);
        for _ in 0..200 {
            let gap = if exact == 0.0 { bowl.guard_value((), &x) } else { 0.0 };
            let rate = x[3] - curvature * x[0] * x[2];
            let pull = 1.0 + curvature * x[2] * x[2];
            let time = (rate + (rate * rate + 2.0 * pull * gap).sqrt()) / pull;
            exact += time;
            let landed = Vector4::new(
                x[0] + x[2] * time,
                x[1] + time * (x[3] - 0.5 * time),
                x[2],
                x[3] - time,
            );
            let Reset::Jump { state, .. } = bowl.reset((), (), &landed) else { panic!() };
            x = state;
        }
        let limit = Execution::new(&bowl, (), start, Limits::new(100.0, 10_000))
            .find_map(|arc| match arc.unwrap().end {
                ArcEnd::Zeno { limit, .. } => Some(limit),
                _ => None,
            })
            .unwrap();
        let error = (limit.time - exact).abs();
        assert!(error <= limit.time_error, "{curvature}: {error:e} {limit:?}");
    }
}

/// y = 0, v = 1, floor −1, g = 9.8. Other software lets the ball fall through the floor.
#[test]
fn an_integrated_ball_rests_as_in_sciml_696() {
    for restitution in [0.0, 0.5] {
        let ball = Model::integrated(|resting, x: &State<2>| match resting {
            true => [0.0, 0.0],
            false => [x[1], -9.8],
        })
        .tolerance(1e-12)
        .falling(false, |x| x[0] + 1.0, move |x| (restitution == 0.0, [-1.0, -restitution * x[1]]))
        .rest(|_, _| Some((true, [-1.0, 0.0])));
        let arcs: Vec<_> = ball.run(false, [0.0, 1.0], 9.0).collect::<Result<_, _>>().unwrap();
        let first = arcs[0].event().unwrap();
        assert!((first.time - 0.565_175_743_588_172_131).abs() < 1e-12);
        assert!((first.before[1] + 4.538_722_287_164_086_89).abs() < 1e-11);
        if restitution > 0.0 {
            let ArcEnd::Zeno { limit, .. } = arcs[arcs.len() - 2].end else { panic!() };
            let error = (limit.time - 1.491_445_598_111_455_17).abs();
            assert!(error <= limit.time_error && error < 1e-10, "{limit:?}");
        }
        let last = arcs.last().unwrap();
        assert!(last.mode && matches!(last.end, ArcEnd::TimeLimit { .. }));
        assert_eq!(last.state(&ball, last.duration).unwrap(), Vector2::new(-1.0, 0.0));
    }
}

/// A ball with restitution ½ from a height of ½ rests at t = 3. What comes a little before it is no part of the series:
/// a clock that kicks, a clock that only ticks, and an observer of another component each have their event.
#[test]
fn what_comes_before_a_limit_is_not_jumped_over() {
    for before in [1e-3, 1e-6, 1e-9, 1e-12] {
        let tick = 3.0 - before;
        for kick in [0.0, 10.0] {
            let ball = Model::integrated(|flies: bool, x: &State<3>| match flies {
                true => [x[1], -1.0, 1.0],
                false => [0.0, 0.0, 1.0],
            })
            .falling(true, |x| x[0], |x| (true, [x[0], -0.5 * x[1], x[2]]))
            .contact()
            .rising(true, move |x| x[2] - tick, |x| (true, *x))
            .crossing()
            .clock(
                true,
                2,
                move |now| (now < tick).then_some(tick),
                move |_, x| (true, [x[0], x[1] + kick, x[2]]),
            )
            .tolerance(1e-12)
            .rest(|_, limit| Some((false, [0.0, 0.0, limit[2]])));
            let mut seen = [0; 3];
            let mut execution =
                Execution::new(&ball, true, State::from([0.5, 0.0, 0.0]), Limits::new(5.0, 4000));
            for arc in execution.by_ref() {
                let arc = arc.unwrap_or_else(|error| panic!("{before:e} {kick}: {error}"));
                if let Some(event) = arc.event() {
                    seen[event.surface] += 1;
                }
            }
            assert_eq!(seen[2], 1, "{before:e} {kick}: {seen:?}");
            if before >= 1e-6 {
                assert_eq!(seen[1], 1, "{before:e} {kick}: {seen:?}");
            }
            if kick > 0.0 && before == 1e-3 {
                // Two units of time after the kick it is at 18.
                assert!(execution.state()[0] > 15.0, "{}", execution.state());
            }
        }
    }
}
