//! Motions with known answers, and hard ones.

use equations::{Error, Formulas, Names, Series, TaylorFlow};
use std::f64::consts::TAU;

fn field(states: &[&str], rates: &[&str]) -> Series {
    let names = Names::new(states, &[]).unwrap();
    Series::new(&Formulas::from_text(names, rates).unwrap(), None).unwrap()
}

fn kepler() -> Series {
    field(&["x", "y", "u", "v"], &["u", "v", "-x/(x^2 + y^2)^1.5", "-y/(x^2 + y^2)^1.5"])
}

/// From rest at an amplitude, after the period 4 K(sin(a/2)) (mpmath).
#[test]
fn a_pendulum_comes_back_after_its_period() {
    let series = field(&["x", "v"], &["v", "-sin(x)"]);
    for (amplitude, period) in
        [(1.0, 6.699_975_664_370_453), (2.0, 8.349_752_926_918_495), (3.0, 16.155_539_372_393_375)]
    {
        for relative in [1e-6, 1e-9, 1e-12, 1e-15] {
            let flow = TaylorFlow::new(&series, relative, relative).unwrap();
            let mut steps = 0;
            let mut see = |_: &_| {
                steps += 1;
                true
            };
            let found = flow.follow(0.0, &[amplitude, 0.0], period, &mut see).unwrap();
            let off = (found[0] - amplitude).abs().max(found[1].abs());
            assert!(off < 30.0 * relative + 1e-14, "{amplitude} {relative:e}: {off:e}");
            assert!(steps < 80, "{steps}");
        }
    }
}

#[test]
fn keplers_orbits_close() {
    let series = kepler();
    for (eccentricity, most) in [(0.0, 1e-13), (0.6, 1e-12), (0.99f64, 1e-9)] {
        let start =
            [1.0 - eccentricity, 0.0, 0.0, ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt()];
        let flow = TaylorFlow::new(&series, 1e-16, 0.0).unwrap();
        let found = flow.state_at(0.0, &start, TAU).unwrap();
        let off = (found[0] - start[0]).abs().max((found[1] - start[1]).abs());
        assert!(off < most, "{eccentricity}: {off:e}");
    }
}

/// Forward and back again, at the time 10⁹ too.
#[test]
fn a_motion_goes_back() {
    let series = field(&["x", "y", "z"], &["10*(y - x)", "x*(28 - z) - y", "x*y - 8/3*z"]);
    let flow = TaylorFlow::new(&series, 1e-16, 1e-16).unwrap();
    for time in [0.0, 1e9] {
        let start = [1.0, 2.0, 20.0];
        let there = flow.state_at(time, &start, time + 1.0).unwrap();
        let back = flow.state_at(time + 1.0, &there, time).unwrap();
        let off = (0..3).map(|k| (back[k] - start[k]).abs()).fold(0.0, f64::max);
        // Backward the smallest exponent, −14.6, spreads rounding by e^14.6.
        assert!(off < 1e-7, "{time} {off:e}");
    }
}

/// The steps are the motion: at their ends they agree, and inside with shorter motions. A watched formula is one of
/// them.
#[test]
fn polynomials_are_the_motion_between_the_ends() {
    let names = Names::new(&["x", "v"], &[]).unwrap();
    let field = Formulas::from_text(names.clone(), &["v", "-x + cos(1.3*t)"]).unwrap();
    let guard = Formulas::from_text(names, &["x^2 - v"]).unwrap();
    let series = Series::new(&field, Some(&guard)).unwrap();
    let flow = TaylorFlow::new(&series, 1e-15, 1e-15).unwrap();
    let (start, mut last) = ([0.3, -0.2], 0.0);
    let check = |step: &equations::Step| {
        assert_eq!(step.time, last);
        last = step.end;
        let middle = step.time + 0.4 * (step.end - step.time);
        let state = step.state(middle);
        let other = flow.state_at(0.0, &start, middle).unwrap();
        assert!((0..2).all(|k| (state[k] - other[k]).abs() < 1e-13), "{state:?} {other:?}");
        let value = guard.values(middle, &state).unwrap()[0];
        assert!((step.watched(middle)[0] - value).abs() < 1e-13);
        true
    };
    flow.follow(0.0, &start, 10.0, check).unwrap();
    assert_eq!(last, 10.0);
}

#[test]
fn hard_motions_end_with_an_error_or_are_right() {
    // ẋ = x²: a pole at t = 1.
    let pole = field(&["x"], &["x^2"]);
    let flow = TaylorFlow::new(&pole, 1e-14, 1e-14).unwrap();
    let near = flow.state_at(0.0, &[1.0], 0.999_999).unwrap()[0];
    assert!((near - 1e6).abs() < 1e-3, "{near}");
    assert!(flow.state_at(0.0, &[1.0], 1.0 + 1e-9).is_err());
    // √x at 0 has no series.
    let root = field(&["x"], &["sqrt(x)"]);
    let flow = TaylorFlow::new(&root, 1e-12, 1e-12).unwrap();
    assert!(matches!(flow.state_at(0.0, &[0.0], 1.0), Err(Error::NoValue { .. })));
    // From x = 1, backward: x = (1 + t/2)² up to t = −2, where x = 0. The polynomial goes on; the motion does not.
    assert!((flow.state_at(0.0, &[1.0], -1.9).unwrap()[0] - 0.0025).abs() < 1e-12);
    // Before, x = 0 is the motion; (1 + t/2)² would be 0.0025.
    let before = flow.state_at(0.0, &[1.0], -2.1).map(|state| state[0]);
    assert!(before.as_ref().map_or(true, |x| x.abs() < 1e-8), "{before:?}");
    // Very small and very large states; a motion at rest; a field without state.
    let decay = field(&["x"], &["-x"]);
    let flow = TaylorFlow::new(&decay, 1e-15, 0.0).unwrap();
    for size in [1e-300, 1e300] {
        let found = flow.state_at(0.0, &[size], 1.0).unwrap()[0];
        assert!((found / size - 0.367_879_441_171_442_33).abs() < 1e-15, "{size:e} {found:e}");
    }
    assert_eq!(flow.state_at(0.0, &[0.0], 5.0).unwrap(), [0.0]);
    assert_eq!(flow.state_at(3.0, &[2.0], 3.0).unwrap(), [2.0]);
    let straight = field(&["x"], &["2*t"]);
    let flow = TaylorFlow::new(&straight, 1e-12, 1e-12).unwrap();
    assert_eq!(flow.state_at(1.0, &[5.0], 3.0).unwrap(), [13.0]);
    assert!(matches!(flow.state_at(0.0, &[1.0], f64::NAN), Err(Error::Time { .. })));
    assert!(flow.state_at(f64::INFINITY, &[1.0], 1.0).is_err());
    for (relative, absolute) in
        [(0.0, 1.0), (1.0, 0.0), (f64::NAN, 0.0), (1e-9, -1.0), (1e-9, f64::NAN)]
    {
        let found = TaylorFlow::new(&straight, relative, absolute);
        assert!(matches!(found, Err(Error::Tolerance { .. })), "{found:?}");
    }
}

/// A cap on the step holds, and the motion can be left early.
#[test]
fn steps_are_capped_and_can_be_left() {
    let series = field(&["x"], &["1"]);
    let flow = TaylorFlow::new(&series, 1e-12, 1e-12).unwrap().longest_step(0.25).unwrap();
    let mut steps = 0;
    let state = flow.follow(0.0, &[0.0], 10.0, |_| {
        steps += 1;
        steps < 4
    });
    assert_eq!((state.unwrap(), steps), (vec![1.0], 4));
}

/// Many motions have the bits of single ones: with times and ends of their own, forward and backward, where steps are halved
/// or end with an error, with fewer and more starts than lanes.
#[test]
fn motions_side_by_side_have_the_bits_of_single_ones() {
    let fields = [
        field(&["x", "v"], &["v", "-sin(x) + 0.1*cos(1.3*t)"]),
        field(&["x", "y", "z"], &["10*(y - x)", "x*(28 - z) - y", "x*y - 8/3*z"]),
        kepler(),
        // A pole at t = 1/x, the end of the domain at x = 0, and flat places.
        field(&["x"], &["x^2"]),
        field(&["x", "y"], &["-sqrt(x)", "ln(x + y) + tanh(x*y)"]),
        field(&["x"], &["sin(x + t)^40"]),
    ];
    for (at, series) in fields.iter().enumerate() {
        for (relative, count) in [(1e-3, 3), (1e-8, 21), (1e-15, 64)] {
            let flow = TaylorFlow::new(series, relative, 1e-9).unwrap();
            let part = |k: usize, step: f64| ((k + 1) as f64 * step).fract();
            let columns: Vec<Vec<f64>> = (0..series.dimension())
                .map(|axis| {
                    (0..count).map(|k| 3.0 * part(k, 0.618 + 0.1 * axis as f64) - 0.2).collect()
                })
                .collect();
            let columns: Vec<&[f64]> = columns.iter().map(|column| &column[..]).collect();
            let times: Vec<f64> = (0..count).map(|k| part(k, 0.31)).collect();
            let mut ends: Vec<f64> = (0..count).map(|k| 4.0 * part(k, 0.7548)).collect();
            ends[1] = times[1];
            ends[2] = f64::NAN;
            let found = flow.states_at(&times, &columns, &ends).unwrap();
            for k in 0..count {
                let start: Vec<f64> = columns.iter().map(|column| column[k]).collect();
                let failed = found.failed.iter().find(|(place, _)| *place == k);
                match flow.state_at(times[k], &start, ends[k]) {
                    Ok(state) => {
                        let bits = |x: &f64| x.to_bits();
                        let together = found.values.iter().map(|column| bits(&column[k]));
                        assert!(together.eq(state.iter().map(bits)), "{at} {relative:e} {k}");
                        assert_eq!(failed, None);
                    }
                    Err(error) => {
                        assert_eq!(
                            failed.map(|(_, error)| format!("{error}")),
                            Some(format!("{error}"))
                        );
                        assert!(found.values.iter().all(|column| column[k].is_nan()));
                    }
                }
            }
        }
    }
    let flow = TaylorFlow::new(&fields[0], 1e-12, 1e-12).unwrap();
    assert_eq!(
        flow.states_at(&[0.0], &[&[], &[]], &[1.0]).unwrap().values,
        [Vec::<f64>::new(), Vec::new()]
    );
    assert!(flow.states_at(&[0.0], &[&[1.0]], &[1.0]).is_err());
    assert!(flow.states_at(&[0.0], &[&[1.0], &[1.0, 2.0]], &[1.0]).is_err());
    assert!(flow.states_at(&[0.0, 1.0], &[&[1.0], &[1.0]], &[1.0]).is_err());
}

/// With a watched formula steps may be shorter: those of single motions.
#[test]
fn watched_motions_have_the_bits_of_single_ones() {
    let names = Names::new(&["x", "v"], &[]).unwrap();
    let field = Formulas::from_text(names.clone(), &["v", "-x"]).unwrap();
    let guard = Formulas::from_text(names, &["sin(30*x)"]).unwrap();
    let series = Series::new(&field, Some(&guard)).unwrap();
    let flow = TaylorFlow::new(&series, 1e-12, 1e-12).unwrap();
    let found = flow.states_at(&[0.0], &[&[1.0, 0.5], &[0.0, 0.1]], &[7.0]).unwrap();
    let single = flow.state_at(0.0, &[0.5, 0.1], 7.0).unwrap();
    assert_eq!([found.values[0][1], found.values[1][1]], single[..]);
}
