//! The fates of many runs of equations, side by side: they have the bits of one run after the other.

#![cfg(feature = "ode")]

use example_systems::{
    ball_on_table::ball_on_table, impact_oscillator::impact_oscillator, spring_leg::spring_leg,
    stick_slip::stick_slip,
};
use hybrid_system::*;
use std::ops::ControlFlow::{Break, Continue};
use std::sync::atomic::{AtomicUsize, Ordering};

/// All numbers of a fate, to the last bit.
fn bits<X: StateVector>(fate: &Fate<Label, Label, X>) -> String {
    let state: Vec<u64> = fate.state.components().iter().map(|x| x.to_bits()).collect();
    format!("{:?} {:?} {state:?} {} {}", fate.end, fate.mode, fate.time.to_bits(), fate.events)
}

/// The same fates, one by one and side by side; how many distinct ones there are.
fn same<const N: usize>(
    name: &str,
    model: &EquationsModel<State<N>>,
    runs: usize,
    start: impl Fn(usize) -> Result<(&'static str, State<N>, f64), Error> + Sync,
) -> usize {
    let run = |number: usize| {
        let (mode, state, end) = start(number)?;
        model.start(mode, state, end)
    };
    let together = model.fates(runs, run, |_| Continue(()));
    let mut distinct = std::collections::BTreeSet::new();
    for (number, fate) in together.into_iter().enumerate() {
        let alone = run(number).map(Execution::fate);
        match (fate.unwrap(), alone) {
            (Ok(fate), Ok(alone)) => {
                assert_eq!(bits(&fate), bits(&alone), "{name} {number}");
                distinct.insert(bits(&fate));
            }
            (fate, alone) => assert_eq!(format!("{fate:?}"), format!("{alone:?}"), "{name}"),
        }
    }
    distinct.len()
}

/// A part of 1 for each run, without a pattern.
fn part(number: usize) -> f64 {
    (0.618_033_988_75 * (number + 1) as f64).fract()
}

#[test]
fn fates_side_by_side_have_the_bits_of_single_ones() {
    let oscillator = impact_oscillator("1.0").model::<State<3>>().unwrap();
    let start = |k| Ok(("free", [part(k) - 0.6, 0.0, 0.0].into(), 20.0 * part(3 * k)));
    assert_eq!(same("oscillator", &oscillator, 150, start), 150);
    for tolerance in [1e-5, 1e-9] {
        let loose = impact_oscillator("0.7").model::<State<3>>().unwrap().tolerance(tolerance);
        same("loose", &loose, 30, start);
    }
    let ball = ball_on_table().model::<State<3>>().unwrap();
    same("ball", &ball, 40, |k| Ok(("flight", [0.1 + part(k), 0.0, 0.0].into(), 9.0)));
    let leg = spring_leg().model::<State<4>>().unwrap();
    let apex =
        |k| Ok(("flight", [0.0, 0.97 + 0.05 * part(k), 4.0 + 2.0 * part(2 * k), 0.0].into(), 5.0));
    same("leg", &leg, 70, apex);
    let slip = stick_slip().model::<State<2>>().unwrap();
    same("slip", &slip, 20, |k| Ok(("slip", [part(k), part(k) - 0.5].into(), 30.0)));
}

/// Two modes, clocks, conditions, observers, terminal guards, poles and limits on events.
#[test]
fn all_kinds_of_ends_side_by_side() {
    let model = Equations::new(&["x", "v"], &[])
        .ticks_text("kick", &["1", "2.5"])
        .resets_text(&["x", "v + 0.3"])
        .mode_text("soft", &["v", "-sin(x)"])
        .rising_text("wall", "x - 1")
        .only_where_text("v - 0.5")
        .to("hard")
        .rising_text("seen", "v")
        .mode_text("hard", &["v", "-4*x^3 - v/9"])
        .falling_text("back", "x")
        .to("soft")
        .falling_text("out", "x + 1.2")
        .stops()
        .model::<State<2>>()
        .unwrap();
    let start = |k: usize| {
        let mode = if k.is_multiple_of(3) { "hard" } else { "soft" };
        Ok((mode, [2.0 * part(k) - 1.0, 3.0 * part(5 * k) - 1.0].into(), 12.0))
    };
    assert!(same("modes", &model, 200, start) > 190);
    // A pole at a time of its own for each start, an error of the start, and one of the mode.
    let pole = Equations::new(&["x"], &[])
        .mode_text("m", &["x^2 + sin(x)/9"])
        .rising_text("high", "x - 1000000")
        .model::<State<1>>()
        .unwrap()
        .tolerances(Tolerances { steps: 2000, ..Tolerances::both(1e-12) });
    same("pole", &pole, 30, |k| match k {
        7 => Ok(("m", [f64::NAN].into(), 5.0)),
        8 => Ok(("nowhere", [1.0].into(), 5.0)),
        9 => Ok(("m", [1.0].into(), -1.0)),
        k => Ok(("m", [3.0 * part(k) - 1.0].into(), 2.0)),
    });
    // A limit on events, and none on time.
    let label = Label::new("soft").unwrap();
    let run = |k: usize| {
        let limits = Limits::new(if k.is_multiple_of(2) { 30.0 } else { f64::INFINITY }, 5);
        Ok(Execution::new(&model, label, State::from([0.2 + part(k), 0.0]), limits))
    };
    for (k, fate) in model.fates(20, run, |_| Continue(())).into_iter().enumerate() {
        let alone = run(k).unwrap().fate();
        assert_eq!(bits(&fate.unwrap().unwrap()), bits(&alone));
    }
}

/// A start of another length is an error, in a mode with a closed form too.
#[test]
fn a_start_of_another_length_is_an_error() {
    let fall = Equations::new(&["x", "v"], &[])
        .mode_text("c", &["v", "-1"])
        .falling_text("floor", "x")
        .model::<nalgebra::DVector<f64>>()
        .unwrap();
    let run = |_| {
        let (mode, start) = (Label::new("c")?, nalgebra::DVector::zeros(1));
        Ok(Execution::new(&fall, mode, start, Limits::new(5.0, 9)))
    };
    let fate = fall.fates(1, run, |_| Continue(())).remove(0).unwrap().unwrap();
    assert!(matches!(fate.end, End::Failed(Error::Dimension { .. })), "{fate:?}");
}

/// After a break no further block of runs begins, and those that have finished are right.
#[test]
fn many_fates_can_be_stopped() {
    let swing = Equations::new(&["x", "v"], &[])
        .mode_text("m", &["v", "-sin(x)"])
        .rising_text("up", "x")
        .model::<State<2>>()
        .unwrap();
    let run = |k: usize| swing.start("m", [part(k), 0.0], 3.0);
    let seen = AtomicUsize::new(0);
    let fates = swing.fates(1000, run, |finished| {
        seen.fetch_max(finished, Ordering::Relaxed);
        if finished >= 3 { Break(()) } else { Continue(()) }
    });
    let finished: Vec<_> = fates.iter().flatten().collect();
    assert_eq!(fates.len(), 1000);
    assert!((3..1000).contains(&finished.len()) && seen.into_inner() == finished.len());
    assert!(swing.fates(0, run, |_| Continue(())).is_empty());
}

/// An execution of a model with other parameters has its own fate.
#[test]
fn runs_of_other_models_have_their_own_fates() {
    let of = |stop: &str| {
        Equations::new(&["x", "v"], &[("stop", stop)])
            .mode_text("m", &["v", "-sin(x)"])
            .rising_text("wall", "x - stop")
            .resets_text(&["x", "-v/2"])
            .model::<State<2>>()
            .unwrap()
    };
    let models = [of("0.5"), of("0.7")];
    let run = |k: usize| models[k % 2].start("m", [0.1 * k as f64 - 1.0, 0.0], 9.0);
    for (k, fate) in models[0].fates(12, run, |_| Continue(())).into_iter().enumerate() {
        assert_eq!(bits(&fate.unwrap().unwrap()), bits(&run(k).unwrap().fate()), "{k}");
    }
}
