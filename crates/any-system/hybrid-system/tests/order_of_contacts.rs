//! Scenes in which contacts and observers were passed, lost or doubled: after a bounce, beside a jump, at stops and
//! clocks.

#![cfg(feature = "ode")]

use hybrid_system::*;
use std::f64::consts::TAU;

const ULP: f64 = f64::EPSILON;

/// Surfaces and times of the events of some arcs.
fn events<M: Copy, S: Copy, X: StateVector>(
    arcs: impl Iterator<Item = Result<Arc<M, S, X>, Error>>,
) -> Vec<(S, f64)> {
    arcs.filter_map(|arc| arc.unwrap().event().map(|event| (event.surface, event.time))).collect()
}

/// Two balls dropped from one height, with gravity or on springs, keep above their floors at all their bounces.
#[test]
fn two_balls_that_bounce_together_never_fall_through() {
    for k in 1..=60 {
        let height = 0.05 * f64::from(k);
        for (spring, kept) in [(false, 0.9), (true, 0.9), (false, 0.5), (true, 0.5)] {
            let bounce = move |ball: usize| {
                move |x: &State<4>| {
                    let mut after = *x;
                    after[2 + ball] *= -kept;
                    ((), after)
                }
            };
            let balls = Model::integrated(move |(), x: &State<4>| {
                let pull = |y: f64| if spring { -1.0 - y } else { -1.0 };
                [x[2], x[3], pull(x[0]), pull(x[1])]
            })
            .falling((), |x| x[0], bounce(0))
            .contact()
            .falling((), |x| x[1], bounce(1))
            .contact();
            let mut execution = balls.run((), [height, height, 0.0, 0.0], 6.0);
            for arc in execution.by_ref() {
                let Ok(arc) = arc else { break }; // near the Zeno limit rounding hides the bounces
                let lowest = arc.start[0].min(arc.start[1]);
                assert!(lowest > -1e-9, "{height} {spring} {kept}: {arc:?}");
            }
            let end = execution.state();
            assert!(end[0].min(end[1]) > -1e-9, "{height} {spring} {kept}: {end}");
        }
    }
}

/// A floor whose guard is a sign, or jumps below it, holds at every bounce.
#[test]
fn a_floor_with_a_guard_that_jumps_holds() {
    for below in [-1.0, -1000.0] {
        for smooth_above in [false, true] {
            let guard = move |x: &State<2>| match x[0] > 0.0 {
                true if smooth_above => x[0],
                true => 1.0,
                false => below,
            };
            let ball = Model::integrated(|(), x: &State<2>| [x[1], -1.0])
                .falling((), guard, |x| ((), [x[0], -x[1]]))
                .contact();
            let times: Vec<f64> =
                events(ball.run((), [0.5, 0.0], 10.0)).iter().map(|event| event.1).collect();
            assert_eq!(times.len(), 5, "{below} {smooth_above}: {times:?}");
            for (time, exact) in times.iter().zip([1.0, 3.0, 5.0, 7.0, 9.0]) {
                assert!((time - exact).abs() < 1e-9, "{below} {smooth_above}: {times:?}");
            }
        }
    }
}

/// x = √1.09 sin(t + φ), watched where it passes 0.2 by guards that jump there: as often as by a smooth one.
#[test]
fn jumps_of_an_observer_lose_no_later_crossing() {
    let guards: [fn(f64) -> f64; 5] = [
        |u| if u > 0.0 { u + 3.0 } else { u - 0.01 },
        |u| if u > 0.0 { u + 1.0 } else { u - 1.0 },
        |u| if u > 0.0 { 1.0 } else { u - 1e-4 },
        |u| if u > 0.0 { u } else { -1.0 },
        |u| u,
    ];
    for (k, guard) in guards.into_iter().enumerate() {
        let model = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
            .either((), move |x| guard(x[0] - 0.2), |x| ((), *x))
            .crossing();
        assert_eq!(events(model.run((), [-1.0, 0.3], 30.0)).len(), 10, "{k}");
    }
}

/// Two rising observers of one oscillation from their far side, at one place or ulps apart, integrated and sampled.
#[test]
fn observers_from_their_far_side_are_met_together() {
    for apart in [0.0, 1e-16, 1e-15] {
        let flow = |(), x: &State<2>, t: f64| {
            [x[0] * t.cos() + x[1] * t.sin(), x[1] * t.cos() - x[0] * t.sin()]
        };
        let integrated = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
            .rising((), |x| x[0], |x| ((), *x))
            .crossing()
            .rising((), move |x| x[0] - apart, |x| ((), *x))
            .crossing();
        let found = events(integrated.run((), [1.0, 0.3], 20.0));
        let count = |surface: usize| found.iter().filter(|event| event.0 == surface).count();
        assert_eq!([count(0), count(1)], [3, 3], "{apart}: {found:?}");
        let sampled = Model::closed_form(flow)
            .rising((), |x| x[0], |x| ((), *x))
            .crossing()
            .rising((), move |x| x[0] - apart, |x| ((), *x))
            .crossing()
            .sampled(0.1);
        let found = events(sampled.run((), [1.0, 0.3], 20.0));
        let count = |surface: usize| found.iter().filter(|event| event.0 == surface).count();
        assert_eq!([count(0), count(1)], [3, 3], "{apart}: {found:?}");
    }
}

/// Three observers within some ulps of a straight motion: three events, whatever the search and the directions.
#[test]
fn three_zeros_within_ulps_are_three_events() {
    for place in [1.0f64, 5.0] {
        let ulp = place * ULP;
        for (second, third) in (0..8).flat_map(|a| (a..8).map(move |b| (a, b))) {
            let [b, c] = [second, third].map(|ulps| place + f64::from(ulps) * ulp);
            let sampled = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
                .rising((), move |x| x[0] - place, |x| ((), *x))
                .crossing()
                .either((), move |x| x[0] - b, |x| ((), *x))
                .crossing()
                .rising((), move |x| x[0] - c, |x| ((), *x))
                .crossing()
                .sampled(0.1);
            let integrated = Model::integrated(|(), _: &State<1>| [1.0])
                .rising((), move |x| x[0] - place, |x| ((), *x))
                .crossing()
                .either((), move |x| x[0] - b, |x| ((), *x))
                .crossing()
                .rising((), move |x| x[0] - c, |x| ((), *x))
                .crossing();
            let found =
                [events(sampled.run((), [0.0], 6.0)), events(integrated.run((), [0.0], 6.0))];
            for found in found {
                let mut surfaces: Vec<usize> = found.iter().map(|event| event.0).collect();
                surfaces.sort_unstable();
                assert_eq!(surfaces, [0, 1, 2], "{place} {second} {third}: {found:?}");
            }
        }
    }
}

/// Stops some ulps before an event, several in a row, or after a whole turn, lose nothing.
#[test]
fn stops_just_before_an_event_lose_nothing() {
    let line = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
        .rising((), |x| x[0] - 1.0, |x| ((), *x))
        .crossing()
        .sampled(0.1);
    let stopped = |stops: &[f64]| {
        let mut execution = line.run((), [0.0], stops[0]);
        let mut found = Vec::new();
        for stop in stops {
            found.extend(events(execution.run_until(*stop)));
        }
        found
    };
    for stops in [vec![1.0 - ULP, 1.0 - 0.5 * ULP, 2.0], vec![1.0 - 3.0 * ULP, 1.0, 1.0 + ULP, 2.0]]
    {
        assert_eq!(stopped(&stops).len(), 1, "{stops:?}");
    }
    let circle = Model::closed_form(|(), x: &State<2>, t: f64| {
        let (s, c) = t.sin_cos();
        [5.0 + (x[0] - 5.0) * c + x[1] * s, x[1] * c - (x[0] - 5.0) * s]
    })
    .rising((), |x| x[0] - 5.0, |x| ((), *x))
    .crossing()
    .sampled(0.1);
    for before in [2e-15, 1e-14, 0.0] {
        let mut execution = circle.run((), [5.0, 1.0], TAU - before);
        let mut found = events(execution.by_ref());
        found.extend(events(execution.run_until(8.0)));
        assert_eq!(found.len(), 1, "{before}: {found:?}");
    }
}

/// A wall that reverses, and an observer of the same surface: one event each, and the wall holds.
#[test]
fn a_wall_and_its_observer_are_met_once() {
    for k in 0..200 {
        let (x, v) = (0.3 + 0.0137 * f64::from(k), -1.0 - 0.0071 * f64::from(k));
        let wall = Model::integrated(|(), x: &State<2>| [x[1], 0.0])
            .either((), |x| x[0], |x| ((), [x[0], -x[1]]))
            .contact()
            .rising((), |x| x[0], |x| ((), *x))
            .crossing();
        let mut execution = wall.run((), [x, v], 4.0);
        let found = events(execution.by_ref());
        let hits = found.iter().filter(|event| event.0 == 0).count();
        assert!(hits == 1 && execution.state()[0] > 0.0, "{k}: {found:?} {}", execution.state());
    }
}

/// Guards that jump within a thousandth of a step from its end have their events at their places.
#[test]
fn jumps_at_the_end_of_a_step_come_in_time() {
    let side = |level: f64| move |x: &State<2>| if x[0] > level { 1.0 } else { -1.0 };
    let start = 1.721_052_631_578_947_6;
    let exact = |level: f64| {
        let rate = 0.3f64.sqrt();
        ((level + 1.0 / 0.3) / (start + 1.0 / 0.3)).acos() / rate
    };
    for tolerance in [1e-12, 1e-10, 1e-6] {
        let fall = Model::integrated(|(), x: &State<2>| [x[1], -1.0 - 0.3 * x[0]])
            .falling((), side(0.0), |x| ((), *x))
            .crossing()
            .falling((), side(2e-4), |x| ((), *x))
            .crossing()
            .tolerances(Tolerances::both(tolerance));
        let found = events(fall.run((), [start, 0.0], 3.0));
        let surfaces: Vec<usize> = found.iter().map(|event| event.0).collect();
        assert_eq!(surfaces, [1, 0], "{tolerance}: {found:?}");
        let error = (found[0].1 - exact(2e-4)).abs().max((found[1].1 - exact(0.0)).abs());
        assert!(error < 1e3 * tolerance, "{tolerance}: {found:?}");
    }
}

/// A bounce that keeps so little that its apex is below rounding: the ball rests by an error or a Zeno limit, and never
/// falls through.
#[test]
fn a_bounce_below_rounding_never_falls_through() {
    // Without optimization these are fewer.
    for exponent in (1..14).step_by(if cfg!(debug_assertions) { 4 } else { 1 }) {
        let kept = 10f64.powi(-exponent);
        for height in [0.57, 0.5, 1.3] {
            let ball = Model::integrated(|(), x: &State<2>| [x[1], -1.0])
                .falling((), |x| x[0], move |x| ((), [x[0], -kept * x[1]]))
                .contact();
            let mut execution = ball.run((), [height, 0.3], 6.0);
            let failed = execution.by_ref().any(|arc| arc.is_err());
            let low = execution.state()[0];
            assert!(failed || low > -1e-9, "{kept} {height}: {low}");
        }
    }
}

/// A wall that reverses the motion, with an observer a little behind it: each is met once, and the wall holds.
#[test]
fn a_wall_with_an_observer_behind_it_holds() {
    for apart in [1e-6, 1e-9, 1e-12, 1e-16] {
        for k in 0..40 {
            let start = [0.3 + 0.01 * f64::from(k), 0.3 - 0.007 * f64::from(k)];
            let oscillator = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
                .either((), |x| x[0], |x| ((), [x[0], -x[1]]))
                .contact()
                .rising((), move |x| x[0] - apart, |x| ((), *x))
                .crossing();
            let mut execution = oscillator.run((), start, 3.0);
            let found = events(execution.by_ref());
            let hits = found.iter().filter(|event| event.0 == 0).count();
            assert!(hits == 1 && execution.state()[0] > 0.0, "{apart} {start:?}: {found:?}");
        }
    }
}

/// A guard of two components that jumps at its zero by unequal heights is met at every crossing.
#[test]
fn a_jump_of_two_components_loses_no_later_crossing() {
    for k in 0..60 {
        let (a, b, c) = (-0.1 + 0.02 * f64::from(k), 1.4 - 0.03 * f64::from(k), 0.175);
        let u = move |x: &State<2>| a * x[0] + b * x[1] + c;
        let count = |jumps: bool| {
            let oscillator = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
                .either(
                    (),
                    move |x| match u(x) {
                        u if !jumps => u,
                        u if u > 0.0 => u + 1.0,
                        u => u - 1e-3,
                    },
                    |x| ((), *x),
                )
                .crossing();
            events(oscillator.run((), [0.4, 0.9], 20.0)).len()
        };
        assert_eq!(count(true), count(false), "{k}");
    }
}
