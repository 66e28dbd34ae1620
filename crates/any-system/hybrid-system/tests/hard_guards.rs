//! Guards and fields whose Taylor series deceive: saturated, with gaps, with poles and branches beside the step.

#![cfg(feature = "ode")]

use hybrid_system::*;
use std::f64::consts::PI;

const TOLERANCE: f64 = 1e-12;

/// ẋ = 1 from 0 with a guard.
fn line(guard: &str, time: f64) -> Vec<f64> {
    let equations = Equations::new(&["x"], &[]).mode_text("m", &["1"]).either_text("g", guard);
    times(&equations, [0.0], time)
}

/// x = cos t, v = −sin t with a guard, beside a component that makes the field no linear one.
fn circle(guard: &str, time: f64) -> Vec<f64> {
    let equations = Equations::new(&["x", "v", "z"], &[])
        .mode_text("m", &["v", "-x", "z^2"])
        .either_text("g", guard);
    times(&equations, [1.0, 0.0, 0.0], time)
}

fn times<const N: usize>(equations: &Equations, start: [f64; N], time: f64) -> Vec<f64> {
    let model = equations.model::<State<N>>().unwrap().tolerance(TOLERANCE);
    let arcs = model.start("m", start, time).unwrap().map(Result::unwrap);
    arcs.filter_map(|arc| Some(arc.event()?.time)).collect()
}

fn assert_near(what: &str, found: &[f64], exact: &[f64]) {
    assert_eq!(found.len(), exact.len(), "{what}: {found:?} {exact:?}");
    for (found, exact) in found.iter().zip(exact) {
        assert!((found - exact).abs() < 1e-9, "{what}: {found} {exact}");
    }
}

#[test]
fn guards_along_a_line() {
    let e = std::f64::consts::E;
    for (guard, exact) in [
        ("sqrt(x + 1) - 2", vec![3.0]),
        ("ln(x + 1) - 1", vec![e - 1.0]),
        ("tanh(100*(x - 3))", vec![3.0]),
        ("sqrt((x - 3)^2) - 0.5", vec![2.5, 3.5]),
        (
            "exp(-10*(x - 3)^2) - 0.5",
            vec![3.0 - (0.1 * 2f64.ln()).sqrt(), 3.0 + (0.1 * 2f64.ln()).sqrt()],
        ),
        ("1/(1 + x^4) - 0.001", vec![999f64.powf(0.25)]),
        ("1/(1 + x^2) - 0.5", vec![1.0]),
        ("x^19 - 2", vec![2f64.powf(1.0 / 19.0)]),
    ] {
        assert_near(guard, &line(guard, 10.0), &exact);
    }
    assert_near("exp(x^20)", &line("exp(x^20) - 2", 1.3), &[2f64.ln().powf(0.05)]);
    let sixteenth: Vec<f64> = (0..3)
        .flat_map(|k| {
            let at = 0.5f64.powf(1.0 / 16.0).asin();
            let turn = PI * f64::from(k);
            [turn + at, turn + PI - at]
        })
        .collect();
    assert_near("sin(x)^16", &line("sin(x)^16 - 0.5", 9.4), &sixteenth);
}

#[test]
fn guards_along_a_circle() {
    let turns =
        |first: f64, count: usize| (0..count).map(|k| first + PI * k as f64).collect::<Vec<_>>();
    assert_near("tanh", &circle("tanh(50*x)", 20.0), &turns(0.5 * PI, 6));
    // 256 sin¹⁶ t = ½.
    let at = (0.5f64 / 256.0).powf(1.0 / 16.0).asin();
    assert_near("power", &circle("(1 - x^2)^8*256 - 0.5", 3.0), &[at, PI - at]);
    // The bump has a width of 1/40.
    let half = (2f64.ln() / 1000.0).sqrt().asin();
    let middle = 0.5 * PI;
    assert_near("bump", &circle("exp(-1000*x^2) - 0.5", 3.0), &[middle - half, middle + half]);
}

/// A pole, and a branch of atan2: no zero, but the sign changes there.
#[test]
fn poles_and_branches_are_met() {
    for (guard, exact, error) in [("1/x", 0.5 * PI, 1e-2), ("atan2(v, x)", PI, 1e-6)] {
        let equations = Equations::new(&["x", "v"], &[])
            .mode_text("m", &["v", "-x"])
            .either_text("g", guard)
            .stops();
        let found = times(&equations, [1.0, 0.0], 5.0);
        assert!(found.len() == 1 && (found[0] - exact).abs() < error, "{guard} {found:?}");
    }
}

/// A ball on a floor that waves, against steps that look at the guard very often.
#[test]
fn a_floor_that_waves() {
    let ball = Equations::new(&["h", "v"], &[])
        .mode_text("m", &["v", "-1"])
        .falling_text("floor", "h - 0.1*sin(3*t)")
        .resets_text(&["h", "-0.9*v + 0.6*cos(3*t)"]);
    let found = times(&ball, [10.0, 0.0, 0.0], 30.0);
    let closures = Model::integrated(|(), x: &State<3>| [x[1], -1.0, 1.0])
        .falling(
            (),
            |x| x[0] - 0.1 * (3.0 * x[2]).sin(),
            |x| ((), [x[0], -0.9 * x[1] + 0.6 * (3.0 * x[2]).cos(), x[2]]),
        )
        .tolerances(Tolerances::both(1e-13).longest_step(0.02));
    let arcs = closures.run((), [10.0, 0.0, 0.0], 30.0).map(Result::unwrap);
    let exact: Vec<f64> = arcs.filter_map(|arc| Some(arc.event()?.time)).collect();
    assert_near("waves", &found, &exact);
}

/// Fields whose series at the start have gaps, or show nothing of what comes: `flow` to a time, and the exact state.
#[test]
fn fields_with_gaps_in_their_series() {
    // ∫ sin¹⁶ = C(16, 8)/2¹⁶ over a period, and so on.
    let sixteenth = 12870.0 / 65536.0;
    let cosines = 12870.0 / 256.0;
    let beta = [
        1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0,
        17.0, 18.0, 19.0, 20.0,
    ]
    .iter()
    .fold(1.0 / 21.0, |product, k| product * 4.0 * k / (21.0 + k));
    for (field, time, exact) in [
        ("sin(2*pi*t)^16", 1.0, sixteenth),
        ("(4*t*(1 - t))^20", 1.0, beta),
        ("(1 - cos(2*pi*t))^8", 1.0, cosines),
        ("exp(-10*(t - 3)^2)", 6.0, (PI / 10.0).sqrt()),
        ("t^20", 2.0, 2f64.powi(21) / 21.0),
    ] {
        let equations = Equations::new(&["x", "z"], &[]).mode_text("m", &[field, "z^2"]);
        let model = equations.model::<State<3>>().unwrap().tolerance(TOLERANCE);
        let end = model.flow(Label::new("m").unwrap(), &State::from([0.0, 0.0, 0.0]), time);
        assert!((end[0] - exact).abs() < 1e-10 * (1.0 + exact), "{field}: {} {exact}", end[0]);
    }
    // ẋ = 1/(1 + x⁴): x + x⁵/5 = t, and ∂x/∂x₀ = (1 + x₀⁴)/(1 + x⁴).
    let equations = Equations::new(&["x"], &[]).mode_text("m", &["1/(1 + x^4)"]);
    let model = equations.model::<State<1>>().unwrap().tolerance(TOLERANCE);
    let mode = Label::new("m").unwrap();
    for time in [0.5, 1.0, 2.0, 10.0] {
        let x = model.flow(mode, &State::from([0.0]), time)[0];
        assert!((x + x.powi(5) / 5.0 - time).abs() < 1e-10 * time, "{time} {x}");
        let found = model.flow_jacobian(mode, &State::from([0.0]), time)[(0, 0)];
        assert!((found * (1.0 + x.powi(4)) - 1.0).abs() < 1e-9, "{time} {found}");
    }
}

/// dτ/dx₀ = −1 and no further terms, whatever the guard, along ẋ = 1.
#[test]
fn derivatives_of_times_need_no_series_of_the_guard() {
    for guard in
        ["ln(x + 1) - 2", "sqrt(x + 1) - 4", "1/(1 + x^2) - 0.01", "exp(x) - 1e6", "tanh(x - 6)"]
    {
        let equations = Equations::new(&["x"], &[]).mode_text("m", &["1"]).either_text("g", guard);
        let model = equations.model::<State<1>>().unwrap().tolerance(TOLERANCE);
        let arc = model.start("m", [0.0], 30.0).unwrap().next().unwrap().unwrap();
        let jet = model.jet::<3>(&[arc], &Along::start(&[1.0])).unwrap();
        assert!(
            (jet.time.0[1] + 1.0).abs() < 1e-9 && jet.time.0[2].abs() < 1e-9,
            "{guard} {jet:?}"
        );
    }
}

/// An infinite horizon, along a motion that comes to rest, and one that does not.
#[test]
fn horizons_may_be_infinite() {
    let mode = Label::new("m").unwrap();
    let search = Search::up_to(f64::INFINITY);
    for (field, guard, exact) in
        [("-x^3", "x - 0.1", Some(49.5)), ("1", "x - 5e6", Some(5e6 - 1.0))]
    {
        let equations =
            Equations::new(&["x"], &[]).mode_text("m", &[field]).either_text("g", guard);
        let model = equations.model::<State<1>>().unwrap();
        let found = model.first_crossing(mode, &State::from([1.0]), &search).unwrap();
        let time = found.crossing().map(|crossing| crossing.time);
        match (time, exact) {
            (Some(time), Some(exact)) => assert!((time / exact - 1.0).abs() < 1e-9, "{time}"),
            other => assert_eq!(other.0, other.1),
        }
    }
}

/// A guard that jumps over its surface, or has a pole, has all its events, whatever its role, and however often the run stops.
#[test]
fn jumps_and_poles_keep_their_later_events() {
    let circle = |k: usize, first: f64| first + PI * k as f64;
    let known: [(&str, Vec<f64>, f64); 3] =
        [
            // Rising at 1 rad, falling at its jump.
            ("atan2(y, x) - 1", vec![3.338_991, 5.480_582, 9.622_176, 11.763_767], 1e-5),
            ("1/x", (0..4).map(|k| circle(k, 1.768_192)).collect(), 1e-2),
            (
                "x/y - 0.3",
                (0..9)
                    .map(|k| {
                        if k % 2 == 0 { circle(k / 2, 0.197_396) } else { circle(k / 2, 2.059_736) }
                    })
                    .collect(),
                1e-2,
            ),
        ];
    for (guard, exact, error) in known {
        for role in 0..4 {
            let equations = Equations::new(&["x", "y"], &[])
                .mode_text("m", &["y", "-x"])
                .either_text("a", guard);
            let equations = match role {
                0 => equations,
                1 => equations.contact(),
                2 => equations.to("m"),
                _ => equations.resets_text(&["x", "y"]).crossing(),
            };
            let model = equations.rising_text("o", "y - 0.3").model::<State<2>>().unwrap();
            for stops in [1, 26] {
                let mut run = model.start("m", [0.5, 0.1], 0.0).unwrap();
                let mut found = Vec::new();
                for stop in 1..=stops {
                    for arc in run.run_until(13.0 * f64::from(stop) / f64::from(stops)) {
                        let event = arc.unwrap().event().map(|event| (event.surface, event.time));
                        found.extend(event.filter(|(surface, _)| *surface == "a").map(|e| e.1));
                    }
                }
                assert_eq!(found.len(), exact.len(), "{guard} {role} {stops} {found:?}");
                for (found, exact) in found.iter().zip(&exact) {
                    assert!((found - exact).abs() < error, "{guard} {role} {found} {exact}");
                }
            }
        }
    }
}

/// A switch whose guard jumps: a later jump beyond its surface is an error, and not lost.
#[test]
fn a_start_beyond_a_guard_that_has_jumped_is_an_error() {
    let model = Equations::new(&["x", "y"], &[])
        .mode_text("m", &["y", "-x"])
        .rising_text("a", "atan2(y, x) - 1")
        .to("n")
        .mode_text("n", &["y", "-x"])
        .rising_text("c", "x + 0.3")
        .to("m")
        .model::<State<2>>()
        .unwrap();
    let arcs: Vec<_> = model.start("m", [0.5, 0.1], 13.0).unwrap().collect();
    assert!(matches!(arcs.last(), Some(Err(Error::LandsBeyond(_)))), "{arcs:?}");
}

/// ẍ = −x − cẋ: the slow root of a strong damping keeps its digits. x at 2c is e^(−2 − 2/c²) (1 + 1/c²), nearly.
#[test]
fn strong_dampings_have_their_slow_root() {
    for damping in [1e3, 1e5, 1e8] {
        let value = format!("{damping:e}");
        let model = Equations::new(&["x", "v"], &[("c", &value)])
            .mode_text("m", &["v", "-x - c*v"])
            .falling_text("half", "x - 0.5")
            .model::<State<2>>()
            .unwrap();
        let mode = Label::new("m").unwrap();
        let found = model.flow(mode, &State::from([1.0, 0.0]), 2.0 * damping)[0];
        let small = damping.powi(-2);
        let exact = (-2.0 * (1.0 + small)).exp() * (1.0 + small);
        assert!((found / exact - 1.0).abs() < 1e-11, "{damping:e}: {found} {exact}");
        let mut run = model.start("m", [1.0, 0.0], 2.0 * damping).unwrap();
        let time = run.next().unwrap().unwrap().event().unwrap().time;
        let exact = damping * 2f64.ln() * (1.0 - small);
        assert!((time / exact - 1.0).abs() < 1e-5, "{damping:e}: {time} {exact}");
    }
}

/// A zero of third order has no derivatives, whichever way its rounded time falls. Nor has a crossing that nearly grazes.
#[test]
fn jets_at_multiple_zeros_are_refused() {
    for k in 0..40 {
        let level = format!("{}", 1.02 + 0.001 * f64::from(k));
        let model = Equations::new(&["x"], &[("a", &level)])
            .mode_text("m", &["x^2"])
            .rising_text("g", "(x - a)^3")
            .model::<State<1>>()
            .unwrap();
        let arc = model.start("m", [0.5], 1.95).unwrap().next().unwrap().unwrap();
        if arc.event().is_some() {
            let found = model.jet::<4>(&[arc], &Along::start(&[1.0]));
            assert!(matches!(found, Err(Error::GrazingSensitivity { .. })), "{level} {found:?}");
        }
    }
    // The rate of sin t at a level 1 − δ is √(2δ): six digits are known at 10⁻⁷, and not at 10⁻¹⁴.
    for (level, known) in [("0.9999999", true), ("0.99999999999999", false)] {
        let model = Equations::new(&["x", "v"], &[("level", level)])
            .mode_text("m", &["v", "-x"])
            .rising_text("g", "x - level")
            .model::<State<2>>()
            .unwrap();
        let arc = model.start("m", [0.0, 1.0], 2.0).unwrap().next().unwrap().unwrap();
        let found = model.jet::<2>(&[arc], &Along::start(&[1.0, 0.0]));
        assert_eq!(known, found.is_ok(), "{level} {found:?}");
        // dτ/dx₀ = −cos τ/cos τ of x = x₀ cos t + sin t.
        if let Ok(found) = found {
            assert!((found.time.0[1] + 1.0).abs() < 1e-6, "{found:?}");
        }
    }
}

/// Times that are not in order are refused, with a closed form and without.
#[test]
fn states_at_times_without_order_are_refused() {
    for field in ["-x", "-x^3"] {
        let model = Equations::new(&["x"], &[]).mode_text("m", &[field]).model::<State<1>>();
        let (model, mode) = (model.unwrap(), Label::new("m").unwrap());
        let found = model.flow_at(mode, &State::from([1.0]), &[0.0, 2.0, 1.0]);
        assert!(matches!(found, Err(Error::BadLimit { .. })), "{field}");
    }
}

/// A ball between guards that jump at its floor, whose resets turn it round: it bounces, and no rounding counts as a way back.
#[test]
fn bounces_at_a_guard_that_jumps() {
    let ball = Equations::new(&["x", "v"], &[])
        .mode_text("m", &["v", "-1"])
        .either_text("g", "atan2(x, -1)")
        .resets_text(&["x", "-v"])
        .contact();
    let model = ball.model::<State<2>>().unwrap();
    let arcs: Vec<_> = model.start("m", [0.5, 0.638], 10.0).unwrap().map(Result::unwrap).collect();
    let times: Vec<f64> = arcs.iter().filter_map(|arc| Some(arc.event()?.time)).collect();
    let speed = (0.638f64 * 0.638 + 1.0).sqrt();
    assert_eq!(times.len(), 4, "{times:?}");
    for (k, time) in times.iter().enumerate() {
        let exact = 0.638 + speed + 2.0 * speed * k as f64;
        assert!((time - exact).abs() < 1e-5, "{k}: {time} {exact}");
    }
    let sampled = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
        .either((), |x| x[0] + 1.0f64.copysign(x[0]), |x| ((), [x[0], -x[1]]))
        .sampled(0.01);
    let arcs: Vec<_> = sampled.run((), [0.5, 0.0], 9.5).map(Result::unwrap).collect();
    let times: Vec<f64> = arcs.iter().filter_map(|arc| Some(arc.event()?.time)).collect();
    assert_eq!(times.len(), 5, "{times:?}");
    for (time, exact) in times.iter().zip([1.0, 3.0, 5.0, 7.0, 9.0]) {
        assert!((time - exact).abs() < 1e-9, "{times:?}");
    }
}

/// An observer that jumps where x = sin t passes ½, from either side: each time has the error of the flow, and none is lost.
#[test]
fn observed_jumps_have_the_error_of_the_flow() {
    let exact = [PI / 6.0, 5.0 * PI / 6.0, 13.0 * PI / 6.0, 17.0 * PI / 6.0];
    for guard in ["atan2(x - 0.5, -1)", "atan2(0.5 - x, -1)"] {
        for (tolerance, with_other) in [(1e-12, false), (1e-12, true), (1e-9, false), (1e-9, true)]
        {
            let equations = Equations::new(&["x", "v"], &[])
                .mode_text("m", &["v", "-x"])
                .either_text("g", guard);
            let equations = if with_other { equations.rising_text("o", "v") } else { equations };
            let model = equations.model::<State<2>>().unwrap().tolerance(tolerance);
            let run = model.start("m", [0.0, 1.0], 10.0).unwrap().solution().unwrap();
            let events: Vec<_> = run.events().filter(|event| event.surface == "g").collect();
            assert_eq!(events.len(), exact.len(), "{guard} {tolerance:e} {with_other}");
            for (event, exact) in events.iter().zip(exact) {
                let off = (event.time - exact).abs();
                assert!(off < event.time_error, "{guard} {off:e} {:e}", event.time_error);
                assert!(event.time_error < 100.0 * tolerance, "{guard} {:e}", event.time_error);
            }
        }
    }
}
