//! Runs as functions of time, in files, and many at once.

#![cfg(feature = "ode")]

use hybrid_system::*;
use proptest::prelude::*;
use std::ops::ControlFlow::{Break, Continue};

fn ball() -> EquationsModel<State<2>> {
    Equations::new(&["height", "speed"], &[("restitution", "0.5")])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-restitution*speed"])
        .rests("floor")
        .mode_text("floor", &["0", "0"])
        .model()
        .unwrap()
}

fn solution(model: &EquationsModel<State<2>>, end: f64) -> Solution<'_, EquationsModel<State<2>>> {
    model.start("flight", [0.5, 0.0], end).unwrap().solution().unwrap()
}

/// Dropped from ½ it lands at 1, 2, 2½, …; at 3 it is at rest.
#[test]
fn both_limits_are_the_states_of_the_arcs() {
    let model = ball();
    let run = solution(&model, 4.0);
    assert_eq!(run.times(), (0.0, 4.0));
    let mut events = 0;
    for arc in run.arcs() {
        // Inside, at the start and at the end, to the last bit.
        for part in [0.25, 0.5, 0.75] {
            let time = arc.time + part * arc.duration;
            let exact = arc.state(&model, time - arc.time).unwrap();
            let [before, after] = run.at(time).unwrap();
            if !matches!(arc.end, ArcEnd::Zeno { .. }) && arc.duration > 1e-3 {
                assert_eq!((before, after), ((arc.mode, exact), (arc.mode, exact)));
            }
        }
        if let Some(event) = arc.event() {
            let [before, after] = run.at(event.time).unwrap();
            assert_eq!((before, Some(after)), ((arc.mode, event.before), event.after));
            events += 1;
        }
    }
    assert_eq!(run.counts(), [(Label::new("floor").unwrap(), events)]);
    assert!(events > 20);
    // Behind the Zeno limit, and at the end.
    let [(before, _), (after, state)] = run.at(3.5).unwrap();
    assert_eq!((before, after), (Label::new("floor").unwrap(), Label::new("floor").unwrap()));
    assert!(state.norm() < 1e-9);
    assert_eq!(run.at(4.0).unwrap()[1].1, state);
    assert_eq!(run.at(0.0).unwrap()[0].1, State::from([0.5, 0.0]));
    for outside in [-1e-9, 4.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(run.at(outside), Err(Error::BadLimit { .. })), "{outside}");
    }
}

#[test]
fn a_grid_has_the_states_after_its_events() {
    let model = ball();
    let run = solution(&model, 4.0);
    let mut grid: Vec<f64> = (0..=160).map(|k| f64::from(k) * 0.025).collect();
    grid.extend(run.events().map(|event| event.time));
    grid.sort_by(f64::total_cmp);
    let states = run.states(&grid).unwrap();
    for (&time, state) in grid.iter().zip(&states) {
        let [_, (_, after)] = run.at(time).unwrap();
        assert!((after - state).norm() < 1e-14, "{time}");
    }
    assert!(matches!(run.states(&[1.0, 0.5]), Err(Error::BadLimit { .. })));
    assert!(run.states(&[]).unwrap().is_empty());
}

/// Events at one instant, and one that ends the run.
#[test]
fn events_at_one_instant_and_a_last_one() {
    let model = Model::integrated(|mode: u8, _: &State<1>| [if mode == 0 { 1.0 } else { -1.0 }])
        .rising(0, |x| x[0] - 1.0, |x| (1, *x))
        .falling(1, |x| x[0], |_| Reset::Stop);
    let run = model.run(0, [0.0], 9.0).solution().unwrap();
    let [before, after] = run.at(1.0).unwrap();
    assert_eq!((before.0, after.0), (0, 1));
    let (_, end) = run.times();
    assert!((end - 2.0).abs() < 1e-12);
    let [before, after] = run.at(end).unwrap();
    assert_eq!((before.0, after.0), (1, 1));
    assert!(run.at(end + 1e-12).is_err());
    assert_eq!(run.counts(), [(0, 1), (1, 1)]);
    // A run for ever ends at no time.
    let free = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
        .observer(Guard::rising(0), |_| -1.0)
        .sampled(1.0);
    let never = free.run((), [0.0], 5.0).solution().unwrap();
    assert_eq!(never.at(4.5).unwrap()[1].1[0], 4.5);
}

/// The limit on time may be a rounding beyond the sum of the durations.
#[test]
fn a_run_has_its_limit() {
    let model = Equations::new(&["height", "speed"], &[])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-0.9*speed"])
        .model::<State<2>>()
        .unwrap();
    for k in 1..400 {
        let end = 0.017 * f64::from(k);
        let run = model.start("flight", [0.5, 0.0], end).unwrap().solution().unwrap();
        assert!(run.at(end).is_ok() && run.states(&[0.0, end]).is_ok(), "{end}");
        assert!(run.at(end + 1e-9).is_err());
    }
}

/// Arcs that are no run are refused.
#[test]
fn arcs_of_no_run_are_refused() {
    let model = ball();
    let mut arcs = solution(&model, 4.0).arcs().to_vec();
    arcs.remove(1);
    assert!(matches!(Solution::new(&model, arcs), Err(Error::BadLimit { .. })));
    assert!(matches!(Solution::new(&model, vec![]), Err(Error::BadLimit { .. })));
}

/// A run in a file: the same function, with the same bits.
#[cfg(feature = "serde")]
#[test]
fn a_run_is_saved_and_read() {
    let model = ball();
    let run = solution(&model, 4.0);
    let text = serde_json::to_string(run.arcs()).unwrap();
    let again = Solution::new(&model, serde_json::from_str(&text).unwrap()).unwrap();
    assert_eq!(again.arcs(), run.arcs());
    assert_eq!(again.at(1.25).unwrap(), run.at(1.25).unwrap());
    // An arc that never ends.
    let never: Arc<Label, Label, State<2>> = Arc {
        mode: Label::new("flight").unwrap(),
        time: 0.0,
        jump: 0,
        start: State::from([1.0, 2.0]),
        duration: f64::INFINITY,
        end: ArcEnd::Never { certainty: Certainty::Exact },
    };
    let text = serde_json::to_string(&never).unwrap();
    assert_eq!(serde_json::from_str::<Arc<Label, Label, State<2>>>(&text).unwrap(), never);
}

#[test]
fn fates_say_why_a_run_ends() {
    let oscillator = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
        .rising((), |x| x[0] - 0.5, |_| Reset::Stop)
        .falling((), |x| x[0] + 0.7, |x| ((), *x))
        .crossing();
    let fate = oscillator.run((), [0.0, 1.0], 9.0).fate();
    assert_eq!((fate.end, fate.events), (End::Terminal(0), 1));
    assert!((fate.time - std::f64::consts::FRAC_PI_6).abs() < 1e-9);
    assert!((fate.state[0] - 0.5).abs() < 1e-9);
    let fate = oscillator.run((), [0.0, 0.1], 9.0).fate();
    assert_eq!((fate.end, fate.time), (End::Stopped(Stop::TimeLimit), 9.0));
    let mut limits = Limits::new(100.0, 3);
    let fate = Execution::new(&oscillator, (), State::from([0.0, -0.8]), limits).fate();
    assert_eq!(fate.end, End::Terminal(0));
    limits.events = 0;
    let fate = Execution::new(&oscillator, (), State::from([0.0, -0.8]), limits).fate();
    assert_eq!((fate.end, fate.events), (End::Stopped(Stop::EventLimit), 0));
    let fate = oscillator.run((), [f64::NAN, 0.0], 9.0).fate();
    assert!(matches!(fate.end, End::Failed(Error::StateNotFinite { .. })));
    let model = ball();
    let fate = model.start("flight", [0.5, 0.0], 9.0).unwrap().fate();
    assert_eq!(
        (fate.end, fate.mode),
        (End::Stopped(Stop::TimeLimit), Label::new("floor").unwrap())
    );
}

#[test]
fn many_runs_keep_their_order_and_stop() {
    let model = ball();
    let landing = |run: usize| {
        let height = 0.5 + 0.01 * run as f64;
        model
            .start("flight", [height, 0.0], 9.0)
            .unwrap()
            .solution()
            .unwrap()
            .events()
            .next()
            .unwrap()
            .time
    };
    let times = many(40, landing, |_| Continue(()));
    for (run, time) in times.iter().enumerate() {
        assert!((time.unwrap() - (2.0 * (0.5 + 0.01 * run as f64)).sqrt()).abs() < 1e-14);
    }
    let stopped =
        many(1000, landing, |finished| if finished >= 3 { Break(()) } else { Continue(()) });
    let finished = stopped.iter().flatten().count();
    assert!((3..100).contains(&finished), "{finished}");
    assert!(stopped.iter().zip(&times).all(|(stopped, time)| stopped.is_none() || stopped == time));
    assert!(many(0, landing, |_| Continue(())).is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The limit from the right at a time is that of an execution that stops there.
    #[test]
    fn at_is_the_state_of_a_run_that_stops(time in 0.0f64..2.9, height in 0.1f64..0.9) {
        let model = ball();
        let run = model.start("flight", [height, 0.0], 9.0).unwrap().solution().unwrap();
        let mut stopped = model.start("flight", [height, 0.0], time).unwrap();
        for arc in stopped.by_ref() {
            arc.unwrap();
        }
        let [_, (_, found)] = run.at(time).unwrap();
        prop_assert!((stopped.state() - found).norm() < 1e-12, "{:?} {:?}", stopped.state(), found);
    }
}
