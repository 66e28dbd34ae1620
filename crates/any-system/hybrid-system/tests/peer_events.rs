//! The scenes of three test classes of Hipparchus (`hipparchus-ode`, package `events`): `CloseEventsTest`,
//! `OverlappingEventsTest` and `ReappearingEventTest`. The facts are theirs, read on 2026-11-23;
//! where their test asserts what its sampling or its loose tolerance finds, the crossings of the exact motion stand
//! here.
//!
//! Each scene runs twice: integrated, at the tolerance of the original and at a loose one, and sampled. The motion is
//! straight, so that the times are exact, and events whose times differ by an ulp come in their order.
//!
//! Their scenes `test…Reverse` are the same motions backward in time. Each scene of a list of events runs backward too.
//! `testEventCausedByDerivativesReset` asserts an exception for a reset that returns null, which Rust does not have.

use super::peer_scene::*;
use hybrid_system::*;
use std::f64::consts::PI;

#[test]
fn close_events_first_one_is_reset() {
    const NEXT: f64 = 9.000000000000002;
    assert_eq!(NEXT, 9f64.next_up());
    let guards = || vec![watch(at(9.0)), watch(saw(&[NEXT, 13.9]))];
    expect(20.0, guards, &[(0, 9.0), (1, NEXT), (1, 13.9)]);
}

#[test]
fn close_events() {
    expect(20.0, || vec![watch(at(5.0)), watch(at(5.5))], &[(0, 5.0), (1, 5.5)]);
}

#[test]
fn simultaneous_events() {
    expect(20.0, || vec![watch(at(5.0)), watch(at(5.0))], &[(0, 5.0), (1, 5.0)]);
}

/// The reset of the first guard changes the function of the second one, at the time of both.
#[test]
fn simultaneous_events_reset() {
    let guards = || {
        let saw = saw(&[1.0, 3.0, 5.0]);
        let value = move |x: &X| if x[FLAG] < 0.5 { x[TIME] - 5.0 } else { saw(x) };
        vec![resetting(at(5.0), |x| Some(X::new(x[0], x[1], x[2], 1.0))), watch(value)]
    };
    expect(20.0, guards, &[(0, 5.0), (1, 5.0)]);
}

/// A reset moves the state over a surface. A crossing counts only what the flow crosses (semantics.md, scene f):
/// there is no event. A contact is an event at once, for both of two contacts.
#[test]
fn simultaneous_discontinuous_events_after_reset() {
    let reset = |x: &X| Some(X::new(1e100, 0.0, x[TIME], x[FLAG]));
    for searched in SEARCHES {
        let start = [-1e100, 0.0, 0.0, 0.0];
        let crossings = || vec![resetting(at(PI), reset), watch(|x| x[0]), watch(|x| x[0])];
        let (found, ..) = run(start, 10.0, searched, crossings());
        assert_events(&found, &[(0, PI)], searched);
        // The resets of the contacts count in the flag, so that each holds until it has had its event.
        let contact = |bit: f64| Watched {
            observes: false,
            guard: |surface| Guard::rising(surface).contact(),
            value: Box::new(move |x: &X| if x[FLAG] < bit - 0.5 { x[0] } else { -1.0 }),
            reset: Box::new(|x: &X| Some(X::new(x[0], x[1], x[2], x[FLAG] + 1.0))),
        };
        let contacts = vec![resetting(at(PI), reset), contact(1.0), contact(2.0)];
        let (found, ..) = run(start, 10.0, searched, contacts);
        assert_events(&found, &[(0, PI), (1, PI), (2, PI)], searched);
    }
}

#[test]
fn fast_switching() {
    let guards = || vec![watch(saw(&[9.9, 10.1, 12.0]))];
    expect(20.0, guards, &[(0, 9.9), (0, 10.1), (0, 12.0)]);
}

#[test]
fn tricky_case_lower() {
    let guards = || vec![watch(at(16.0)), watch(saw(&[-10.0, 1.0, 15.0, 18.0])), watch(at(17.0))];
    expect(30.0, guards, &[(1, 1.0), (1, 15.0), (0, 16.0), (2, 17.0), (1, 18.0)]);
}

#[test]
fn root_finding_tolerance() {
    let guards = || vec![watch(at(11.0)), watch(flat(&[11.0 + 1e-5]))];
    expect(30.0, guards, &[(0, 11.0), (1, 11.0 + 1e-5)]);
}

#[test]
fn root_plus_tolerance_has_wrong_sign() {
    let guards = || vec![watch(at(11.1)), watch(saw(&[11.0, 11.2]))];
    expect(30.0, guards, &[(1, 11.0), (0, 11.1), (1, 11.2)]);
}

#[test]
fn root_plus_tolerance_has_wrong_sign_and_less_than_tb() {
    let guards = || vec![watch(flat(&[11.0, 11.4, 12.0]))];
    expect(30.0, guards, &[(0, 11.0), (0, 11.4), (0, 12.0)]);
}

/// −|t − 11| touches zero, and so does the kink of the second scene: no crossing.
#[test]
fn double_root_and_double_root_opposite_sign() {
    for touching in [&[11.0, 11.0] as &'static [f64], &[-20.0, 11.0, 11.0]] {
        let guards = || {
            let mut touch = watch(bent(touching));
            touch.guard = |surface| Guard::either(surface).crossing().touch(Touch::Ignore);
            vec![watch(at(11.0)), touch]
        };
        expect(30.0, guards, &[(0, 11.0)]);
    }
}

#[test]
fn zero_at_beginning_and_end_of_interval() {
    expect(30.0, || vec![watch(bent(&[10.0, 20.0]))], &[(0, 10.0), (0, 20.0)]);
}

#[test]
fn zero_at_beginning_and_end_of_interval_opposite_sign() {
    expect(30.0, || vec![watch(bent(&[-10.0, 10.0, 20.0]))], &[(0, 10.0), (0, 20.0)]);
}

#[test]
fn multiple_backups() {
    let guards = || {
        vec![watch(at(16.0)), watch(bent(&[11.0, 13.0, 14.0, 17.0])), watch(bent(&[12.0, 15.0]))]
    };
    let expected = [(1, 11.0), (2, 12.0), (1, 13.0), (1, 14.0), (2, 15.0), (0, 16.0), (1, 17.0)];
    expect(30.0, guards, &expected);
}

/// The reset moves the state over the surface of the second guard: no crossing (scene f), but the crossing that
/// follows.
#[test]
fn event_caused_by_state_reset() {
    let reset = |x: &X| Some(X::new(-20.0, 0.0, x[TIME], x[FLAG]));
    let guards = || vec![resetting(at(15.0), reset), watch(|x| x[0] + 1.0)];
    expect(40.0, guards, &[(0, 15.0), (1, 34.0)]);
}

#[test]
fn convergence_too_tight_and_tolerance_mismatch() {
    expect(30.0, || vec![watch(bent(&[15.0]))], &[(0, 15.0)]);
    expect(30.0, || vec![watch(flat(&[15.1]))], &[(0, 15.1)]);
}

/// The first event changes the function of the second guard: it is found where the new function crosses, or not at all.
#[test]
fn event_changes_g_function_definition() {
    let scene = |before: Option<f64>, after: Option<f64>| {
        let value = move |x: &X| match if x[FLAG] < 0.5 { before } else { after } {
            Some(e) => x[TIME] - e,
            None => -1.0,
        };
        vec![resetting(at(11.0), |x| Some(X::new(x[0], x[1], x[2], 1.0))), watch(value)]
    };
    expect(30.0, || scene(None, Some(19.0)), &[(0, 11.0), (1, 19.0)]);
    expect(30.0, || scene(Some(11.1), None), &[(0, 11.0)]);
    expect(30.0, || scene(Some(11.1), Some(11.2)), &[(0, 11.0), (1, 11.2)]);
    expect(30.0, || scene(Some(11.2), Some(11.1)), &[(0, 11.0), (1, 11.1)]);
}

/// A terminal event at a jump. A run that starts there goes on to the end: no second event.
#[test]
fn tolerance_stop() {
    for searched in SEARCHES {
        let (found, last, stop) = run([0.0; 4], 30.0, searched, vec![stopping(flat(&[15.1]))]);
        assert_events(&found, &[(0, 15.1)], searched);
        assert_eq!(stop, Some(Stop::Terminal));
        let start = std::array::from_fn(|k| last[k]);
        let (found, last, stop) = run(start, 30.0, searched, vec![stopping(flat(&[15.1]))]);
        assert_events(&found, &[], searched);
        assert!(is_at(last[TIME], 30.0) && stop == Some(Stop::TimeLimit), "{searched:?}");
    }
}

/// A guard that is zero for two units of time, and then positive: it has left its zero, and crosses none.
#[test]
fn long_initial_zero() {
    let value = |x: &X| if x[TIME] < 2.0 { 0.0 } else { x[TIME] + 50.0 };
    expect(30.0, || vec![stopping(value)], &[]);
}

#[test]
fn short_bracketing_interval() {
    const NEXT: f64 = 10.000000000000002;
    assert_eq!(NEXT, 10f64.next_up());
    let jumps = |x: &X| if (NEXT..10.5).contains(&x[TIME]) { 1.0 } else { -1.0 };
    // Two events at one double: their order is free.
    let expected = [(0, NEXT), (1, NEXT), (0, 10.5)];
    for searched in SEARCHES {
        let (mut found, ..) = run([0.0; 4], 30.0, searched, vec![watch(jumps), watch(at(NEXT))]);
        found[..2].sort_by_key(|event| event.0);
        assert_events(&found, &expected, searched);
    }
}

/// One event in the middle: two arcs, from 0 to 5 and from 5 to 10.
#[test]
fn event_step_handler() {
    for searched in SEARCHES {
        let (found, last, stop) = run([0.0; 4], 10.0, searched, vec![watch(at(5.0))]);
        assert_events(&found, &[(0, 5.0)], searched);
        assert!(is_at(last[TIME], 10.0) && stop == Some(Stop::TimeLimit));
    }
}

/// A reset moves the state back by less than the tolerance, to before the surface. The surface is crossed once more.
#[test]
fn reset_changes_sign() {
    let guards = || {
        let back = |x: &X| Some(X::new(x[0] - 0.5e-10, x[1], x[2], x[FLAG] + 1.0));
        let first = |x: &X| if x[FLAG] < 0.5 { x[0] - 6.0 } else { -1.0 };
        vec![
            resetting(first, back),
            watch(|x| (x[0] - 6.0) * (x[0] - 9.0)),
            stopping(|x| x[0] - 9.0),
        ]
    };
    for searched in SEARCHES {
        let (found, last, _) = run([0.0; 4], 100.0, searched, guards());
        let surfaces: Vec<usize> = found.iter().map(|event| event.0).collect();
        assert_eq!(surfaces[0], 0, "{searched:?}: {found:?}");
        assert!(is_at(found[0].1, 6.0), "{searched:?}: {found:?}");
        let last_event = found[found.len() - 1];
        assert!((last_event.1 - (9.0 + 0.5e-10)).abs() < 1e-14, "{searched:?}: {found:?}");
        assert!((last[0] - 9.0).abs() < 1e-14);
    }
}

/// Each of two components is reset to zero where it reaches 1, both at each integer, by guards that jump and by
/// smooth ones.
#[test]
fn overlapping_events() {
    let reset = |k: usize| {
        move |x: &X| {
            let mut after = *x;
            after[k] = 0.0;
            Some(after)
        }
    };
    let mut expected: Vec<(usize, f64)> = Vec::new();
    for half in 1..20 {
        let time = 0.5 * f64::from(half);
        if half % 2 == 0 {
            expected.push((0, time));
        }
        expected.push((1, time));
    }
    for jumps in [true, false] {
        let value = |k: usize| {
            move |x: &X| match jumps {
                true if x[k] >= 1.0 => 1.0,
                true => -1.0,
                false => x[k] - 1.0,
            }
        };
        for searched in SEARCHES {
            let guards = vec![resetting(value(0), reset(0)), resetting(value(1), reset(1))];
            let (mut found, ..) = run([0.0; 4], 9.75, searched, guards);
            // Both components are rounded in their own way: the order at one instant is that of their roundings.
            found.sort_by(|a, b| {
                let half = |time: f64| (2.0 * time).round();
                half(a.1).total_cmp(&half(b.1)).then(a.0.cmp(&b.0))
            });
            assert_events(&found, &expected, searched);
        }
    }
}

/// A guard that is zero at the start and positive behind it: the run goes on to its end.
#[test]
fn reappearing_event() {
    for searched in SEARCHES {
        let start = [15.0, 0.0, 6.0, 0.0];
        let (found, last, stop) = run(start, 10.0, searched, vec![stopping(|x| x[0] - 15.0)]);
        assert_events(&found, &[], searched);
        assert!(is_at(last[TIME], 10.0) && stop == Some(Stop::TimeLimit), "{searched:?}");
    }
}
