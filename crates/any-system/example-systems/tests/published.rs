//! The models from published sources have their known answers.

use example_systems::ball_on_table::{ball_on_table, periodic_start};
use example_systems::buck_converter::{PERIOD, buck_converter};
use example_systems::impact_oscillator::{grazing_forcing, impact_oscillator, steady_start};
use example_systems::spring_leg::{APEX, apex, spring_leg};
use example_systems::stick_slip::{STICK_SLIP_PERIOD, stick_slip};
use hybrid_system::{Along, Certainty, Error, EventKind, State};

/// Apexes of the run, from one that is a tenth of a millimetre higher: each error is −0.161 times the one before.
#[test]
fn the_runner_comes_back_to_its_apex() {
    let model = spring_leg().model::<State<4>>().unwrap();
    let mut start = apex();
    let energy = 0.5 * start[2] * start[2] + 9.81 * start[1];
    start[1] += 1e-4;
    start[2] = (2.0 * (energy - 9.81 * start[1])).sqrt();
    let mut heights = vec![start[1]];
    for arc in model.start("flight", start, 4.0).unwrap() {
        let arc = arc.unwrap();
        if let Some(event) = arc.event().filter(|event| event.surface == "apex" && event.time > 0.0)
        {
            heights.push(event.before[1]);
        }
    }
    assert!(heights.len() > 4, "{heights:?}");
    let off: Vec<f64> = heights.iter().map(|height| height - APEX).collect();
    assert!((off[1] / off[0] + 0.161).abs() < 0.003, "{off:?}");
    assert!(off[4].abs() < 1e-6, "{off:?}");
}

/// The ball lands once in a period at its phase, and comes back to it.
#[test]
fn the_ball_lands_once_in_a_period() {
    let model = ball_on_table().model::<State<3>>().unwrap();
    let exact = periodic_start(0.03);
    let mut start = exact;
    start[1] += 1e-3;
    let mut last = None;
    let mut landings = 0;
    for arc in model.start("flight", start, 40.0).unwrap() {
        if let Some(event) = arc.unwrap().event() {
            landings += 1;
            last = event.after.map(|(_, after)| after);
        }
    }
    let last = last.unwrap();
    assert!((39..=41).contains(&landings), "{landings}");
    assert!((last[1] - 0.5).abs() < 1e-5, "{last}");
    let phase = (last[2] - exact[2]).rem_euclid(1.0);
    assert!(phase.min(1.0 - phase) < 1e-5, "{phase}");
}

/// Below the grazing forcing the steady motion has no event in a hundred periods, above it has. At it the oscillator
/// touches, and no derivative passes.
#[test]
fn the_oscillator_grazes_at_its_forcing() {
    let end = 100.0 * std::f64::consts::TAU / 1.3;
    let events = |forcing: f64| {
        let model = impact_oscillator(&format!("{forcing}")).model::<State<3>>().unwrap();
        let run = model.start("free", steady_start(forcing), end).unwrap();
        let arcs: Vec<_> = run.map(Result::unwrap).collect();
        arcs.iter().filter_map(|arc| arc.event()).cloned().collect::<Vec<_>>()
    };
    let grazing = grazing_forcing();
    assert!((grazing - 0.351_067).abs() < 1e-5, "{grazing}");
    assert!(events(grazing * (1.0 - 1e-9)).is_empty());
    let impacts = events(grazing * (1.0 + 1e-9));
    assert!(impacts.iter().any(|event| event.kind == EventKind::Crossing), "{}", impacts.len());
    let model = impact_oscillator(&format!("{grazing}")).model::<State<3>>().unwrap();
    let arcs: Vec<_> =
        model.start("free", steady_start(grazing), 5.0).unwrap().map(Result::unwrap).collect();
    assert_eq!(arcs[0].event().unwrap().kind, EventKind::Touch);
    let derivative = model.jet::<2>(&arcs[..1], &Along::parameter("forcing"));
    assert!(matches!(derivative, Err(Error::GrazingSensitivity { .. })), "{derivative:?}");
}

/// The voltage at the ticks repeats each period at 24 V, and each second period at 25 V; all events are certain.
#[test]
fn the_converter_doubles_its_period() {
    for (source, doubled) in [("24", false), ("25", true)] {
        let model = buck_converter(source).model::<State<3>>().unwrap();
        let mut voltages = Vec::new();
        for arc in model.start("off", [12.0, 0.5, 3.8], 500.5 * PERIOD).unwrap() {
            if let Some(event) = arc.unwrap().event() {
                assert_eq!(event.certainty, Certainty::Certain);
                if event.surface == "tick" {
                    voltages.push(event.before[0]);
                }
            }
        }
        let [.., a, b, c] = voltages[..] else { panic!("{voltages:?}") };
        assert!((a - c).abs() < 1e-6, "{source}: {a} {b} {c}");
        assert_eq!((a - b).abs() > 5e-3, doubled, "{source}: {a} {b} {c}");
    }
}

/// Slip and stick come back with the known period.
#[test]
fn the_mass_sticks_and_slips() {
    let model = stick_slip().model::<State<2>>().unwrap();
    let run = model.start("stick", [0.0, 0.2], 60.0).unwrap();
    let slips: Vec<f64> = run
        .filter_map(|arc| {
            let event = *arc.unwrap().event()?;
            (event.surface == "slips").then_some(event.time)
        })
        .collect();
    assert!((slips[0] - 5.0).abs() < 1e-12);
    for pair in slips.windows(2) {
        assert!((pair[1] - pair[0] - STICK_SLIP_PERIOD).abs() < 1e-8, "{slips:?}");
    }
    assert_eq!(slips.len(), 5);
}
