//! Models whose closures take the time: `|t, x|`.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::DVector;

/// A bouncing ball on a table that shakes, by closures with the time and by equations.
#[test]
fn a_ball_on_a_table_as_by_equations() {
    let height = |t: f64| 0.03 * pxfm::f_sin(9.0 * t);
    let speed = |t: f64| 0.27 * pxfm::f_cos(9.0 * t);
    let closures = Model::integrated_in_time(|(), _, x: &State<3>| [x[1], -1.0])
        .tolerance(1e-13)
        .falling((), |t, x| x[0] - height(t), |t, x| ((), [x[0], 1.5 * speed(t) - 0.5 * x[1]]))
        .crossing();
    let equations = Equations::new(&["x", "v"], &[])
        .mode("free", |t, x, _| [x[1], t.number(-1.0)])
        .falling("table", |t, x, _| x[0] - 0.03 * (9.0 * t).sin())
        .resets(|t, x, _| [x[0], 1.5 * 0.27 * (9.0 * t).cos() - 0.5 * x[1]])
        .crossing()
        .model::<State<3>>()
        .unwrap();
    let mine = closures.run((), [1.0, 0.0], 6.0).filter_map(|arc| arc.unwrap().event().copied());
    let theirs = equations.start("free", [1.0, 0.0], 6.0).unwrap();
    let theirs = theirs.filter_map(|arc| arc.unwrap().event().copied());
    let (mine, theirs): (Vec<_>, Vec<_>) = (mine.collect(), theirs.collect());
    assert!(mine.len() > 3 && mine.len() == theirs.len(), "{} {}", mine.len(), theirs.len());
    for (mine, theirs) in mine.iter().zip(&theirs) {
        assert!((mine.time - theirs.time).abs() < 1e-10, "{} {}", mine.time, theirs.time);
        // The time of the state is that of the event.
        assert!((mine.before[2] - mine.time).abs() < 4e-15 * mine.time);
        let after = mine.after.unwrap().1;
        assert_eq!(after[2], mine.before[2]);
    }
}

/// Every part takes the time: guards of one mode and of all, conditions, clocks, rests, terminal guards and observers.
#[test]
fn every_part_takes_the_time() {
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    enum Name {
        Step,
        Late,
        Tick,
        Seen,
        End,
    }
    let ticks = PresetTimes::new([1.0, 4.0]).unwrap();
    // x = ∫ t dt from 2 on.
    let model = Model::integrated_in_time(|level: u8, t, _: &State<2>| [t + f64::from(level)])
        .guard(0, Guard::rising(Name::Step), |t, _| t - 3.0, |t, x| (1, [x[0] + t]))
        .guard_everywhere(Guard::rising(Name::Late), |t, _| t - 3.5, |m, t, x| (m, [x[0] - t]))
        .only_where(Name::Late, |t, _| t - 10.0)
        .clock_everywhere(Name::Tick, |after| ticks.next_after(after), |m, t, _| (m, [t]))
        .observer(Guard::rising(Name::Seen), |t, x| x[0] + t - 9.0)
        .terminal(1, Guard::rising(Name::End), |t, _| t - 4.5);
    let events: Vec<_> = model
        .run_at(0, [0.0], (2.0, 9.0))
        .filter_map(|arc| arc.unwrap().event().map(|event| (event.surface, event.time)))
        .collect();
    let expected = [(Name::Step, 3.0), (Name::Tick, 4.0), (Name::End, 4.5)];
    assert_eq!(events.iter().filter(|event| event.0 != Name::Seen).count(), expected.len());
    for (name, time) in expected {
        assert!(events.iter().any(|e| e.0 == name && (e.1 - time).abs() < 1e-12), "{events:?}");
    }
    let fate = model.run_at(0, [0.0], (2.0, 9.0)).fate();
    assert_eq!(fate.end, End::Terminal(Name::End));
    // ∫ (t + 1) dt from 4 to 4.5 behind the tick, which sets x to 4.
    assert!((fate.state[0] - (4.0 + 2.125 + 0.5)).abs() < 1e-10, "{fate:?}");
}

/// The derivative by the start time is that by the last component: x(t) = x₀ + (t³ − t₀³)/3.
#[test]
fn derivatives_know_the_time() {
    let model = Model::integrated_in_time(|(), t, _: &State<2>| [t * t])
        .tolerance(1e-12)
        .rising((), |t, x| x[0] + t - 4.0, |t, x| ((), [x[0] + t]))
        .crossing();
    let arcs: Vec<_> = model.run_at((), [0.0], (0.5, 3.0)).collect::<Result<_, _>>().unwrap();
    assert_eq!(arcs.len(), 2);
    let (after, duration) = event_sensitivity(&model, &arcs[0]).unwrap();
    // The guard x + t is 4 where x₀ + (t³ − t₀³)/3 + t = 4: dt/dx₀ = −1/(t² + 1), dt/dt₀ = t₀²/(t² + 1), and the duration t − t₀.
    let t = arcs[0].event().unwrap().time;
    assert!((duration[0] + 1.0 / (t * t + 1.0)).abs() < 1e-8, "{duration}");
    assert!((duration[1] - (0.25 / (t * t + 1.0) - 1.0)).abs() < 1e-8, "{duration}");
    // Behind the event x⁺ = x + t = 4, whatever the start was, and the time is that of the event.
    assert!(after[(0, 0)].abs() < 1e-8 && after[(0, 1)].abs() < 1e-8, "{after}");
    assert!((after[(1, 0)] + 1.0 / (t * t + 1.0)).abs() < 1e-8, "{after}");
}

/// A closed form that depends on the start time, and states of a dimension that is chosen at run time.
#[test]
fn closed_forms_and_vectors_of_any_length() {
    let closed = Model::closed_form_in_time(|(), t0, x: &State<2>, tau| {
        let end = t0 + tau;
        [x[0] + 0.5 * (end * end - t0 * t0)]
    })
    .rising((), |t, x| x[0] - t, |_, x| ((), *x))
    .sampled(0.1);
    let first = closed.run_at((), [0.0], (1.0, 9.0)).next().unwrap().unwrap();
    // ½ (t² − 1) = t.
    assert!((first.event().unwrap().time - (1.0 + 2f64.sqrt())).abs() < 1e-13);

    let any = Model::integrated_in_time(|(), t, x: &DVector<f64>| vec![t; x.len() - 1])
        .rising((), |t, _| t - 1.0, |_, x| ((), vec![0.0; x.len() - 1]))
        .crossing()
        .rising((), |t, _| t - 2.0, |_, x| ((), x.clone()))
        .crossing();
    let fate = any.run((), vec![0.0; 3], 3.0).fate();
    assert_eq!(fate.state.len(), 4);
    assert!((fate.state[0] - 4.0).abs() < 1e-9 && fate.events == 2, "{fate:?}");
    // Rates of another length are an error with both lengths.
    let wrong = Model::integrated_in_time(|(), _, _: &DVector<f64>| vec![1.0]).rising(
        (),
        |t, _| t - 1.0,
        |_, x| ((), x.clone()),
    );
    let fate = wrong.run((), vec![0.0; 3], 3.0).fate();
    assert!(
        matches!(fate.end, End::Failed(Error::Dimension { expected: 4, found: 2, .. })),
        "{fate:?}"
    );
}

/// A state may change its length.
#[test]
fn a_reset_changes_the_dimension() {
    let cells = Model::integrated_in_time(|(), t, x: &DVector<f64>| vec![t; x.len() - 1])
        .rising(
            (),
            |t, _| t - 1.0,
            |_, x: &DVector<f64>| Reset::Resize { mode: (), state: vec![0.5 * x[0]; 2] },
        )
        .crossing();
    let fate = cells.run((), vec![1.0], 2.0).fate();
    assert_eq!(fate.state.len(), 3);
    let error = (fate.state[0] - (0.75 + 1.5)).abs();
    assert!(error < 1e-9 && (fate.state[2] - 2.0).abs() < 1e-12, "{fate:?}");
}
