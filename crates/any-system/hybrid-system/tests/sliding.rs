//! Filippov's sliding modes against known answers.

#![cfg(feature = "ode")]

use super::two_sided::*;
use hybrid_system::*;
use interval_arithmetic::bracketed_root;
use nalgebra::{Vector1, Vector2};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Band {
    Upper,
    Lower,
}

/// The same with a hysteresis: the mode below is left at +band, the mode above at −band.
struct Hysteresis<const N: usize>(TwoSided<N>);

impl<const N: usize> HybridSystem for Hysteresis<N> {
    type State = State<N>;
    type Mode = Side;
    type Surface = Band;
    fn flow(&self, side: Side, x: &State<N>, t: f64) -> State<N> {
        integrated_flow(self, side, x, t, TIGHT)
    }
    fn guards(&self, side: Side) -> &[Guard<Band>] {
        match side {
            Side::Below => const { &[Guard::rising(Band::Upper)] },
            Side::Above => const { &[Guard::falling(Band::Lower)] },
        }
    }
    fn guard_value(&self, surface: Band, x: &State<N>) -> f64 {
        let value = (self.0.guard)(x);
        match surface {
            Band::Upper => value - self.0.band,
            Band::Lower => value + self.0.band,
        }
    }
    fn reset(&self, side: Side, _: Band, x: &State<N>) -> Reset<Side, State<N>> {
        let mode = if side == Side::Below { Side::Above } else { Side::Below };
        Reset::Jump { mode, state: *x }
    }
    fn vector_field(&self, side: Side, x: &State<N>) -> Option<State<N>> {
        self.0.vector_field(side, x)
    }
    fn first_crossing(
        &self,
        side: Side,
        x: &State<N>,
        search: &Search<Band>,
    ) -> Result<NextEvent<Band, State<N>>, Error> {
        integrated_crossing(self, side, x, search, TIGHT)
    }
}

/// ẋ = −sgn x + 0.3 reaches 0 after 1/0.7 and stays there.
#[test]
fn the_relay_rests_at_zero() {
    let relay = Filippov::new(
        TwoSided::<1>::new(|_| Vector1::new(1.3), |_| Vector1::new(-0.7), |x| x[0]),
        TIGHT,
    );
    let (arcs, stop) = run(&relay, ABOVE, Vector1::new(1.0), Limits::new(100.0, 50)).unwrap();
    assert_eq!(stop, Some(Stop::TimeLimit));
    let lasting = lasting(&arcs);
    assert_eq!(lasting.len(), 2);
    assert!((lasting[0].duration - 1.0 / 0.7).abs() < 1e-14);
    assert!(is_sliding(&lasting[1].mode));
    assert!(lasting[1].state(&relay, 90.0).unwrap()[0].abs() < 1e-15);
}

/// Along the surface ẏ is the mean of 1 and −3 with λ = 1.3/2: 1 − 4 · 0.65 = −1.6. A relay with hysteresis h differs
/// from that by O(h).
#[test]
fn a_relay_with_a_narrow_hysteresis_tends_to_the_sliding_motion() {
    let model = |band| TwoSided::<2> {
        band,
        ..TwoSided::new(|_| Vector2::new(1.3, 1.0), |_| Vector2::new(-0.7, -3.0), |x| x[0])
    };
    let start = Vector2::new(0.7, 0.0);
    let end = |arc: &Vector2<f64>| arc[1];
    // From x = 0.7 downwards for one unit of time, y = −3, then along the surface for two: y = −3 − 3.2.
    let sliding = Filippov::new(model(0.0), TIGHT);
    let (arcs, _) = run(&sliding, ABOVE, start, Limits::new(3.0, 20)).unwrap();
    let last = arcs.last().unwrap();
    let exact = end(&last.state(&sliding, last.duration).unwrap());
    assert!((exact + 6.2).abs() < 1e-12, "{exact}");
    for band in [1e-1, 1e-2, 1e-3] {
        let relay = Hysteresis(model(band));
        let (arcs, _) = run(&relay, Side::Above, start, Limits::new(3.0, 10_000)).unwrap();
        let last = arcs.last().unwrap();
        let y = end(&last.state(&relay, last.duration).unwrap());
        // Within one period of the relay, 2h(1/1.3 + 1/0.7) < 4.4 h, y differs by less than 4 · 4.4 h.
        assert!((y - exact).abs() < 18.0 * band, "{band} {y} {exact}");
        // A period takes 2h(1/1.3 + 1/0.7) = 4.4 h and two arcs.
        assert!(arcs.len() as f64 > 2.0 * 2.0 / (4.4 * band) - 3.0, "{band} {}", arcs.len());
    }
}

/// A mass on a spring on a belt of speed 1: x″ = −x + F, F = 2 − 0.5 (1 − x′) below the speed of the belt. The slip
/// has a closed form: u = x − 1.5 satisfies u″ = u′/2 − u.
fn weakening() -> TwoSided<2> {
    TwoSided::new(
        |x| Vector2::new(x[1], -x[0] + 2.0 - 0.5 * (1.0 - x[1])),
        |x| Vector2::new(x[1], -x[0] - 2.0 + 0.5 * (x[1] - 1.0)),
        |x| x[1] - 1.0,
    )
}

/// Position and speed of the slip, t after the release at x = 2 with the speed 1.
fn slip(t: f64) -> (f64, f64) {
    let (growth, omega) = (0.25, (1.0 - 0.0625f64).sqrt());
    let (u, v) = (0.5, 1.0);
    let (sin, cos) = (omega * t).sin_cos();
    let factor = (growth * t).exp();
    let rest = (v - growth * u) / omega;
    let position = factor * (u * cos + rest * sin);
    let speed = growth * position + factor * omega * (rest * cos - u * sin);
    (position + 1.5, speed)
}

#[test]
fn dry_friction_sticks_for_the_exact_time() {
    let belt = Filippov::new(weakening(), TIGHT);
    let start = Vector2::new(-1.0, 0.0);
    let (arcs, _) = run(&belt, BELOW, start, Limits::new(200.0, 200)).unwrap();
    let sticks: Vec<_> = arcs.iter().filter(|arc| is_sliding(&arc.mode)).collect();
    assert!(sticks.len() > 10, "{}", sticks.len());
    // The slip from x = 2 ends where the speed is 1 again; then the mass sticks up to x = 2.
    let returns = bracketed_root(|t| slip(t).1 - 1.0, 2.0, 5.5).unwrap();
    let caught = slip(returns).0;
    assert!(caught.abs() < 2.0, "{caught}");
    for stick in &sticks[1..sticks.len() - 1] {
        let release = stick.event().unwrap();
        let tangent = FilippovSurface::Tangent { surface: Surface::Switch, mode: Side::Below };
        assert_eq!(release.surface, tangent);
        assert!((release.before[0] - 2.0).abs() < 1e-11, "{}", release.before[0]);
        assert_eq!(release.before[1], 1.0);
        assert!((stick.duration - (2.0 - stick.start[0])).abs() < 1e-11);
        assert!((stick.start[0] - caught).abs() < 1e-10, "{} {caught}", stick.start[0]);
    }
    let period = sticks[5].time - sticks[4].time;
    assert!((period - (returns + 2.0 - caught)).abs() < 1e-10, "{period}");
}

/// The stick-slip cycle of Leine (2024): friction 1/(1 + 3|v_rel|) on a belt of speed 0.2. His figure starts at x =
/// 1.135 with x′ = 0, after 5000 implicit steps. The digits below are from a program that shares no code with this
/// one (classical Runge–Kutta steps of 5·10⁻⁴ for the slip).
#[test]
fn the_stick_slip_cycle_of_leine() {
    const AMPLITUDE: f64 = 1.133_944_676_44;
    const PERIOD: f64 = 12.001_031_294_83;
    let belt = TwoSided {
        section: Some(|x| -x[1]),
        ..TwoSided::<2>::new(
            |x| Vector2::new(x[1], -x[0] + 1.0 / (1.0 + 3.0 * (0.2 - x[1]))),
            |x| Vector2::new(x[1], -x[0] - 1.0 / (1.0 + 3.0 * (x[1] - 0.2))),
            |x| x[1] - 0.2,
        )
    };
    let belt = Filippov::new(belt, TIGHT);
    let (arcs, _) = run(&belt, BELOW, Vector2::new(1.135, 0.0), Limits::new(50.0, 100)).unwrap();
    // The section is passed where the mass turns back, at the largest x.
    let turns: Vec<_> = arcs
        .iter()
        .filter_map(|arc| arc.event())
        .filter(|event| event.surface == FilippovSurface::Model(Surface::Section))
        .collect();
    assert!(turns.len() >= 4);
    for pair in turns.windows(2) {
        assert!((pair[1].before[0] - 1.135).abs() < 2e-3);
        assert!((pair[1].before[0] - AMPLITUDE).abs() < 2e-11, "{}", pair[1].before[0]);
    }
    let period = turns[3].time - turns[2].time;
    assert!((period - PERIOD).abs() < 2e-11, "{period}");
}

/// Sliding control of a boost converter (Sira-Ramírez 1987): ẋ₁ = b − ω₀ u x₂, ẋ₂ = ω₀ u x₁ − ω₁ x₂, the switch u =
/// 1 or 0, and the current x₁ is held at K. Along x₁ = K the equivalent control is u = b/(ω₀ x₂), so that ẋ₂ =
/// bK/x₂ − ω₁ x₂, and x₂² = bK/ω₁ + (x₂(0)² − bK/ω₁) e^(−2ω₁t).
#[test]
fn the_boost_converter_slides_at_constant_current() {
    const SOURCE: f64 = 1.0;
    const LOAD: f64 = 0.25;
    const CURRENT: f64 = 2.0;
    // ω₀ = 1. With u = 0 the current rises, with u = 1 it falls if x₂ > b.
    let converter = TwoSided::<2>::new(
        |x| Vector2::new(SOURCE, -LOAD * x[1]),
        |x| Vector2::new(SOURCE - x[1], x[0] - LOAD * x[1]),
        |x| x[0] - CURRENT,
    );
    let converter = Filippov::new(converter, TIGHT);
    let start = Vector2::new(1.0, 2.0);
    let (arcs, stop) = run(&converter, BELOW, start, Limits::new(30.0, 20)).unwrap();
    assert_eq!(stop, Some(Stop::TimeLimit));
    let lasting = lasting(&arcs);
    assert_eq!(lasting.len(), 2);
    // Charging: x₁ = 1 + t, x₂ = 2 e^(−t/4), to x₁ = 2 after t = 1.
    assert!((lasting[0].duration - 1.0).abs() < 1e-13);
    let slide = lasting[1];
    assert!(is_sliding(&slide.mode));
    let voltage = 2.0 * (-LOAD).exp();
    assert!((slide.start[1] - voltage).abs() < 1e-12);
    let square = SOURCE * CURRENT / LOAD;
    for t in [0.5, 2.0, 7.0, 29.0] {
        let exact = (square + (voltage * voltage - square) * (-2.0 * LOAD * t).exp()).sqrt();
        let state = slide.state(&converter, t).unwrap();
        assert!((state[1] - exact).abs() < 1e-11, "{t} {} {exact}", state[1]);
        assert!((state[0] - CURRENT).abs() < 1e-15, "{t} {}", state[0]);
    }
}

/// A charge too low for the load: the sliding mode ends where the equivalent control is 1, at x₂ = b.
#[test]
fn the_boost_converter_leaves_its_surface_where_the_switch_is_always_on() {
    // bK/ω₁ = 0.5 < b²: the voltage falls to b = 1.
    let converter = TwoSided::<2>::new(
        |x| Vector2::new(1.0, -2.0 * x[1]),
        |x| Vector2::new(1.0 - x[1], x[0] - 2.0 * x[1]),
        |x| x[0] - 1.0,
    );
    let converter = Filippov::new(converter, TIGHT);
    let start = Vector2::new(1.0 - 1e-3, 3.0);
    let (arcs, _) = run(&converter, BELOW, start, Limits::new(5.0, 20)).unwrap();
    let slide = arcs.iter().find(|arc| is_sliding(&arc.mode)).unwrap();
    let exit = slide.event().unwrap();
    let tangent = FilippovSurface::Tangent { surface: Surface::Switch, mode: Side::Above };
    assert_eq!(exit.surface, tangent);
    assert!((exit.before[1] - 1.0).abs() < 1e-12, "{}", exit.before);
    // x₂² − ½ = (x₂(0)² − ½) e^(−4t) reaches ½.
    let from = slide.start[1] * slide.start[1] - 0.5;
    assert!((slide.duration - (2.0 * from).ln() / 4.0).abs() < 1e-12, "{}", slide.duration);
    assert_eq!(exit.after.map(|after| after.0), Some(ABOVE));
    let after = arcs.iter().find(|arc| arc.time >= exit.time && arc.mode == ABOVE).unwrap();
    assert!(after.duration > 0.1, "the free mode leaves the surface");
}

/// Along the unit circle both fields turn with the angular speed 1 and point at the circle.
#[test]
fn a_long_motion_along_a_curved_surface_stays_on_it() {
    let circle = TwoSided::<2>::new(
        |x| Vector2::new(-x[1] + x[0], x[0] + x[1]),
        |x| Vector2::new(-x[1] - 0.5 * x[0], x[0] - 0.5 * x[1]),
        |x| x[0] * x[0] + x[1] * x[1] - 1.0,
    );
    let circle = Filippov::new(circle, Tolerances::both(1e-10));
    let (arcs, _) = run(&circle, BELOW, Vector2::new(0.5, 0.0), Limits::new(1000.0, 20)).unwrap();
    let slide = arcs.last().unwrap();
    assert!(is_sliding(&slide.mode));
    // ṙ = r: the circle is reached after ln 2. The angle is the time.
    assert!((slide.time - 2f64.ln()).abs() < 1e-11);
    for elapsed in [1.0, 10.0, 100.0, 999.0] {
        let x = slide.state(&circle, elapsed).unwrap();
        assert!((x.norm_squared() - 1.0).abs() < 1e-15, "{elapsed} {}", x.norm_squared() - 1.0);
        let angle = slide.time + elapsed;
        let error = (x - Vector2::new(angle.cos(), angle.sin())).norm();
        assert!(error < 1e-9 * (1.0 + elapsed), "{elapsed} {error:e}");
    }
}

/// The rates from a gradient and from differences agree.
#[test]
fn a_gradient_gives_the_same_motion() {
    let model = || {
        TwoSided::<2>::new(
            |x| Vector2::new(-x[1] + x[0], x[0] + x[1]),
            |x| Vector2::new(-x[1] - 0.5 * x[0] - 0.3 * x[1], x[0] - 0.5 * x[1]),
            |x| x[0] * x[0] + x[1] * x[1] - 1.0,
        )
    };
    let plain = Filippov::new(model(), TIGHT);
    let exact = Filippov::new(model(), TIGHT).with_gradient(|_, _, x| 2.0 * x);
    let end = |system: &Filippov<TwoSided<2>>| {
        let start = Vector2::new(0.5, 0.0);
        let (arcs, _) = run(system, BELOW, start, Limits::new(5.0, 20)).unwrap();
        let last = arcs.last().unwrap();
        last.state(system, last.duration).unwrap()
    };
    assert!((end(&plain) - end(&exact)).norm() < 1e-11);
}

/// An exit from the surface x = 0, where the rounding of x itself is no scale: ẋ = 1 − y below, and ẏ = 1.
#[test]
fn the_free_motion_after_an_exit_is_a_parabola() {
    let fold = TwoSided::<2>::new(
        |x| Vector2::new(1.0 - x[1], 1.0),
        |_| Vector2::new(-1.0, 1.0),
        |x| x[0],
    );
    let fold = Filippov::new(fold, TIGHT);
    let start = Vector2::new(0.3, 0.1);
    let (arcs, stop) = run(&fold, ABOVE, start, Limits::new(3.0, 20)).unwrap();
    assert_eq!(stop, Some(Stop::TimeLimit));
    let lasting = lasting(&arcs);
    assert_eq!(lasting.len(), 3, "{arcs:?}");
    // On the surface after 0.3, at y = 0.4; tangent at y = 1, after 0.9.
    assert!((lasting[2].time - 0.9).abs() < 1e-12 && lasting[2].mode == BELOW);
    let end = lasting[2].state(&fold, lasting[2].duration).unwrap();
    assert!((end[0] + 0.5 * 2.1 * 2.1).abs() < 1e-11, "{end}");
}

/// A relay that ends at its surface, goes on in a mode of its own, or slides.
#[test]
fn the_mode_of_a_model_wins_and_not_to_follow_surfaces_ends_there() {
    let relay = |held: bool| {
        Model::integrated(|side: i8, x: &State<1>| [0.3 - f64::from(side) * (1.0 + 0.0 * x[0])])
            .rising(-1, |x| x[0], |x| (1, *x))
            .falling(1, |x| x[0], |x| (-1, *x))
            .slide(move |sliding| held.then_some((0, sliding.state)))
    };
    let end = |relay: &Filippov<_>| {
        let limits = Limits::new(3.0, 50);
        let start = FilippovMode::Free(1);
        let mut execution = Execution::new(relay, start, Vector1::new(0.7), limits);
        let count = execution.by_ref().inspect(|arc| assert!(arc.is_ok())).count();
        let stop = execution.stop().unwrap();
        (count > 0, stop, execution.time(), execution.state()[0])
    };
    // From 0.7 with ẋ = −0.7 it reaches 0 at t = 1. Along the surface it rests; in mode 0 it has ẋ = 0.3.
    let (_, stop, _, state) = end(&Filippov::new(relay(false), TIGHT));
    assert_eq!((stop, state), (Stop::TimeLimit, 0.0));
    let (_, stop, time, _) = end(&Filippov::new(relay(false), TIGHT).following(false));
    assert!(stop == Stop::Sliding && (time - 1.0).abs() < 1e-12, "{stop:?} {time}");
    for follows in [true, false] {
        let (_, stop, _, state) = end(&Filippov::new(relay(true), TIGHT).following(follows));
        assert!(stop == Stop::TimeLimit && (state - 0.6).abs() < 1e-12, "{stop:?} {state}");
    }
}

/// The arcs of a system with sliding, in states of a dimension that is chosen at run time, give the same derivatives.
#[test]
fn arcs_keep_everything_but_the_type_of_their_states() {
    let relay = TwoSided::<1>::new(|_| Vector1::new(1.3), |_| Vector1::new(-0.7), |x| x[0]);
    let relay = Filippov::new(relay, TIGHT);
    let (arcs, _) = run(&relay, ABOVE, Vector1::new(1.0), Limits::new(5.0, 50)).unwrap();
    assert!(arcs.iter().any(|arc| matches!(arc.end, ArcEnd::Sliding { .. })));
    for arc in arcs {
        let there = arc.with_states(|x| nalgebra::DVector::from_column_slice(x.as_slice()));
        assert_eq!(there.with_states(|x| Vector1::new(x[0])), arc);
    }
}
