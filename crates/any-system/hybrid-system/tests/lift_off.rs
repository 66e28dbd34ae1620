//! A body that rests on a floor until a growing force lifts it: it leaves without speed and without acceleration.

#![cfg(feature = "ode")]

use hybrid_system::*;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    Rests,
    Flies,
}
use Mode::{Flies, Rests};

/// The state is (height, velocity, time), the force is `rate` times the time. It lifts off once. How often it does if
/// the run stops at these times: the names of the events.
fn events(weight: f64, rate: f64, tolerance: f64, stops: &[f64]) -> Vec<&'static str> {
    let body = Model::integrated(move |mode, x: &State<3>| match mode {
        Rests => [0.0, 0.0, 1.0],
        Flies => [x[1], rate * x[2] - weight, 1.0],
    })
    .tolerance(tolerance)
    .guard(Flies, Guard::falling("floor").contact(), |x| x[0], |x| (Rests, [0.0, 0.0, x[2]]))
    .guard(
        Rests,
        Guard::rising("lift-off").contact(),
        move |x| rate * x[2] - weight,
        |x| (Flies, [0.0, 0.0, x[2]]),
    );
    let mut execution = body.run(Rests, [0.0; 3], 0.0);
    let mut names = Vec::new();
    for stop in stops {
        for arc in execution.run_until(*stop) {
            names.extend(arc.unwrap().event().map(|event| event.surface));
        }
    }
    names
}

/// The signs of a height of 10⁻⁴⁰ are noise of the integration: a frame next to the lift-off doubles nothing.
#[test]
fn a_frame_beside_the_lift_off_is_no_landing() {
    for (time, weight) in [(7.0, 9.8), (17.0, 9.81), (6.0, 9.81), (3.0, 0.3)] {
        for tolerance in [1e-6, 1e-10, 1e-12] {
            for frame in [0.1, 1.0, 1.0 / 60.0] {
                let frames = (1..).map(|k| f64::from(k) * frame).take_while(|t| *t < time + 1.0);
                let stops: Vec<f64> = frames.chain([time + 1.0]).collect();
                let found = events(weight, weight / time, tolerance, &stops);
                assert_eq!(found, ["lift-off"], "{time} {weight} {tolerance} {frame}");
            }
        }
    }
}

#[test]
fn a_stop_shortly_behind_the_lift_off_is_no_landing() {
    for k in 1..40 {
        let (weight, rate) = (0.37 * f64::from(k), 0.093 * f64::from(41 - k));
        let time = weight / rate;
        for exponent in 3..16 {
            let stops = [time * (1.0 + 10f64.powi(-exponent)), 1.2 * time];
            assert_eq!(events(weight, rate, 1e-10, &stops), ["lift-off"], "{k} {exponent}");
        }
    }
}

/// The height h + t²(T − t) leaves its level without a rate, and comes back at T, in a flight that is 10³ roundings
/// high and more. It is met there, and not taken for noise of the departure.
#[test]
fn a_return_soon_after_a_departure_without_a_rate_is_met() {
    for level in [0.0_f64, 0.3, 1.0, 37.0] {
        for k in 0..60 {
            let back = 10f64.powf(-4.0 + 0.05 * f64::from(k));
            let rounding = f64::EPSILON * level.max(1.0);
            if 4.0 / 27.0 * back.powi(3) < 1e3 * rounding {
                continue;
            }
            // Height, velocity, acceleration.
            let field = |(), x: &State<3>| [x[1], x[2], -6.0];
            let model = Model::integrated(field)
                .observer(Guard::either("level"), move |x: &State<3>| x[0] - level);
            let arcs = model.run((), [level, 0.0, 2.0 * back], 4.0 * back).map(|arc| arc.unwrap());
            let met: Vec<f64> = arcs.filter_map(|arc| Some(arc.event()?.time)).collect();
            let [time] = met[..] else { panic!("{level} {back}: {met:?}") };
            assert!((time - back).abs() < 0.05 * back, "{level} {back}: {time}");
        }
    }
}
