//! Clocks, crossings and stops within some ulps of each other: each tick comes once, at its time, and a run ends where
//! it was told to.

use hybrid_system::*;

/// The surfaces of the model below.
const FIRST: usize = 0;
const SECOND: usize = 1;
const CLOCKS: [usize; 2] = [2, 3];

/// A double so many ulps away.
fn ulps(x: f64, count: i64) -> f64 {
    f64::from_bits(x.to_bits().wrapping_add_signed(count))
}

/// x = t with observers of two levels, each as a signal, and two clocks of one tick each. Stops at these times: the
/// ticks as (surface, time).
fn ticks(levels: [f64; 2], clocks: [f64; 2], stops: &[f64]) -> Vec<(usize, f64)> {
    let signal = move |level: f64| {
        move |(), x: &State<1>| Some(QuasiPolynomial::polynomial(&[x[0] - level, 1.0]))
    };
    let tick = |time: f64| move |now: f64| (now < time).then_some(time);
    let same = |(), x: &State<1>| ((), *x);
    let model = Model::closed_form(|(), x: &State<1>, t: f64| [x[0] + t])
        .observer(Guard::rising(FIRST), move |x| x[0] - levels[0])
        .observer(Guard::rising(SECOND), move |x| x[0] - levels[1])
        .signal(FIRST, signal(levels[0]))
        .signal(SECOND, signal(levels[1]))
        .clock((), CLOCKS[0], tick(clocks[0]), same)
        .clock((), CLOCKS[1], tick(clocks[1]), same);
    let mut execution = model.run((), [0.0], 0.0);
    let mut found = Vec::new();
    let mut crossings = 0;
    for stop in stops {
        for arc in execution.run_until(*stop) {
            let arc = arc.unwrap();
            let Some(event) = arc.event() else { continue };
            match event.kind {
                EventKind::Clock => found.push((event.surface, event.time)),
                _ => crossings += 1,
            }
        }
        assert_eq!(execution.time(), *stop, "{levels:?} {clocks:?} {stops:?}");
    }
    assert_eq!(crossings, 2, "{levels:?} {clocks:?} {stops:?}");
    found.sort_by_key(|(surface, _)| *surface);
    found
}

/// The duration up to a crossing may round to that of a clock an ulp later, and their sum to a time behind the clock.
#[test]
fn clocks_and_stops_within_ulps_of_a_crossing_lose_and_double_nothing() {
    for k in 0..400 {
        let second = 0.5 + 0.007_31 * f64::from(k);
        let first = second * (0.05 + 0.3 * f64::from(k % 3));
        for (a, b) in [(0, 1), (-1, 0), (2, -2), (1, 1)] {
            let clocks = [ulps(second, a), ulps(second, b)];
            let all = [(CLOCKS[0], clocks[0]), (CLOCKS[1], clocks[1])];
            let stops = [ulps(second, a - 1), ulps(second, b + 1), 5.0];
            assert_eq!(ticks([first, second], clocks, &[5.0]), all);
            if stops[0] <= stops[1] {
                assert_eq!(ticks([first, second], clocks, &stops), all);
            }
        }
    }
}

/// A stop between two observers that are both on their way to their zeros, some ulps behind it: the search of each of
/// them once began the other's anew, for ever.
#[cfg(feature = "ode")]
#[test]
fn two_observers_on_their_way_at_a_stop_end_the_search() {
    let (stop, near, far) =
        (0.900_000_000_000_001_4, 0.900_000_000_000_001_5, 0.900_000_000_000_001_6);
    let flip = 0.899_999_999_999_999_4;
    let model = Model::integrated(|_: bool, _: &State<1>| [1.0])
        .clock_everywhere(
            "clock",
            move |now| (now < flip).then_some(flip),
            |mode: bool, x: &State<1>| (!mode, *x),
        )
        .observer(Guard::rising("far"), move |x| x[0] - far)
        .observer(Guard::either("near"), move |x| x[0] - near);
    let mut execution = model.run(false, [0.0], 0.0);
    let mut names = Vec::new();
    for until in [stop, 3.0] {
        let arcs = execution.run_until(until).map(|arc| arc.unwrap());
        names.extend(arcs.filter_map(|arc| arc.event().map(|event| event.surface)));
    }
    names.sort_unstable();
    assert_eq!(names, ["clock", "far", "near"]);
}
