//! Guards that touch their surface: an error, an event, or nothing, and the execution goes on behind the touch.

use hybrid_system::*;
use nalgebra::Vector1;

/// How the guards are known to the search.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Known {
    QuasiPolynomial,
    Enclosure,
    Samples,
}

/// Time is the state. One guard touches zero at 1 and at 2, and crosses it at 3: (t − 1)²(t − 2)²(t − 3).
struct Clock {
    guard: Guard<()>,
    known: Known,
}

impl HybridSystem for Clock {
    type State = State<1>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, (): (), x: &State<1>, t: f64) -> State<1> {
        Vector1::new(x[0] + t)
    }
    fn guards(&self, (): ()) -> &[Guard<()>] {
        std::slice::from_ref(&self.guard)
    }
    fn guard_value(&self, (): (), x: &State<1>) -> f64 {
        let x = x[0];
        (x - 1.0) * (x - 1.0) * (x - 2.0) * (x - 2.0) * (x - 3.0)
    }
    fn guard_quasi_polynomial(&self, (): (), (): (), x: &State<1>) -> Option<QuasiPolynomial> {
        let factor = |root: f64| QuasiPolynomial::polynomial(&[x[0] - root, 1.0]);
        (self.known == Known::QuasiPolynomial)
            .then(|| factor(1.0) * factor(1.0) * factor(2.0) * factor(2.0) * factor(3.0))
    }
    fn guard_enclosure(
        &self,
        (): (),
        (): (),
        x: &State<1>,
        order: u32,
        (from, to): (f64, f64),
    ) -> Option<Enclosure> {
        if self.known != Known::Enclosure {
            return None;
        }
        let factor = |root: f64| (x[0] + from - root, x[0] + to - root);
        let times = |a: (f64, f64), b: (f64, f64)| {
            let ends = [a.0 * b.0, a.0 * b.1, a.1 * b.0, a.1 * b.1];
            let low = ends.into_iter().fold(f64::INFINITY, f64::min);
            (low, ends.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        let square = |a: (f64, f64)| {
            let (low, high) = times(a, a);
            (if a.0 * a.1 <= 0.0 { 0.0 } else { low.max(0.0) }, high)
        };
        let (a, b, c) = (factor(1.0), factor(2.0), factor(3.0));
        let rounding = 1e-14;
        match order {
            0 => {
                let (low, high) = times(times(square(a), square(b)), c);
                Some(Enclosure::new(low - rounding, high + rounding))
            }
            1 => {
                let sum = |x: (f64, f64), y: (f64, f64)| (x.0 + y.0, x.1 + y.1);
                let first = times((2.0, 2.0), times(a, times(square(b), c)));
                let second = times((2.0, 2.0), times(b, times(square(a), c)));
                let third = times(square(a), square(b));
                let (low, high) = sum(first, sum(second, third));
                Some(Enclosure::new(low - rounding, high + rounding))
            }
            _ => None,
        }
    }
    fn reset(&self, (): (), (): (), x: &State<1>) -> Reset<(), State<1>> {
        Reset::Jump { mode: (), state: *x }
    }
}

type Found = Vec<(EventKind, f64)>;

fn events(guard: Guard<()>, known: Known) -> Result<Found, Error> {
    let clock = Clock { guard, known };
    // The samples hit 1, 2 and 3 exactly.
    let limits = Limits::sampled(4.0, 20, 0.125);
    let mut found = Vec::new();
    for arc in Execution::new(&clock, (), Vector1::new(0.0), limits) {
        found.extend(arc?.event().map(|event| (event.kind, event.time)));
    }
    Ok(found)
}

const ALL: [Known; 3] = [Known::QuasiPolynomial, Known::Enclosure, Known::Samples];

/// Rounding of 1e-14 hides a double root of curvature 1 or more over less than this.
const HIDDEN: f64 = 1e-5;

#[test]
fn touches_are_errors_unless_declared() {
    for known in ALL {
        let error = events(Guard::either(()).crossing(), known).unwrap_err();
        let Error::Grazing { time, .. } = error else { panic!("{known:?}: {error}") };
        assert!((time - 1.0).abs() < HIDDEN, "{known:?}: {time}");
    }
}

#[test]
fn ignored_touches_are_passed() {
    for known in ALL {
        let found = events(Guard::either(()).crossing().touch(Touch::Ignore), known).unwrap();
        let [(EventKind::Crossing, time)] = found[..] else { panic!("{known:?}: {found:?}") };
        assert!((time - 3.0).abs() < 1e-12, "{known:?}: {time}");
    }
}

#[test]
fn touches_are_events_of_their_own_kind_and_happen_once() {
    for known in ALL {
        let found = events(Guard::either(()).crossing().touch(Touch::Event), known).unwrap();
        let kinds: Vec<_> = found.iter().map(|(kind, _)| *kind).collect();
        assert_eq!(kinds, [EventKind::Touch, EventKind::Touch, EventKind::Crossing], "{known:?}");
        for ((_, time), known_time) in found.iter().zip([1.0, 2.0, 3.0]) {
            assert!((time - known_time).abs() < HIDDEN, "{known:?}: {found:?}");
        }
    }
}

/// A sampled guard that jumps over zero is crossed at its jump, whatever the values on both sides are.
#[test]
fn the_jump_of_a_discontinuous_guard_is_located() {
    struct Jump(f64);
    impl HybridSystem for Jump {
        type State = State<1>;
        type Mode = ();
        type Surface = ();
        fn flow(&self, (): (), x: &State<1>, t: f64) -> State<1> {
            Vector1::new(x[0] + t)
        }
        fn guards(&self, (): ()) -> &[Guard<()>] {
            const { &[Guard::rising(())] }
        }
        fn guard_value(&self, (): (), x: &State<1>) -> f64 {
            if x[0] < self.0 { -1.0 - x[0] } else { 1e-3 }
        }
        fn reset(&self, (): (), (): (), _: &State<1>) -> Reset<(), State<1>> {
            Reset::Stop
        }
    }
    for jump in [0.3, 1.7, 2.0] {
        let search = Search::up_to(4.0).sampled(0.25);
        let found = Jump(jump).first_crossing((), &Vector1::new(0.0), &search).unwrap();
        let crossing = found.crossing().unwrap();
        assert!((crossing.time - jump).abs() <= f64::EPSILON * jump, "{}", crossing.time);
        assert!(crossing.time_error < 1e-12, "{}", crossing.time_error);
    }
}

/// 10¹² samples end at their budget. The search can go on from there.
#[test]
fn a_search_by_too_many_samples_is_unfinished() {
    let clock = Clock { guard: Guard::either(()), known: Known::Samples };
    let search = Search { steps: 1000, ..Search::up_to(1e9).sampled(1e-3) };
    let found = clock.first_crossing((), &Vector1::new(3.5), &search).unwrap();
    let NextEvent::Unfinished { time, state, .. } = found else { panic!("{found:?}") };
    assert!((time - 1.0).abs() < 1e-12 && state[0] == 3.5 + time);
}

/// Two levels just below the top of a sine: the second one is some 30 ulps below it. Its crossings are found, or the
/// graze is said, although the first level's event is next to it.
#[test]
fn a_graze_next_to_another_event_is_not_lost() {
    let (first, top) = (1.75 - 5.782e-13, 1.75);
    for below in [2e-15, 8e-15, 1.35e-14, 6e-14, 3e-13] {
        let levels = [first, top - below];
        let signal = |level: f64| {
            move |(), x: &State<2>| {
                Some(
                    QuasiPolynomial::cosine(x[0], 1.0) + QuasiPolynomial::sine(x[1], 1.0)
                        - QuasiPolynomial::polynomial(&[level]),
                )
            }
        };
        let sine = Model::closed_form(|(), x: &State<2>, t: f64| {
            [x[0] * t.cos() + x[1] * t.sin(), x[1] * t.cos() - x[0] * t.sin()]
        })
        .observer(Guard::either(0), move |x| x[0] - levels[0])
        .observer(Guard::either(1), move |x| x[0] - levels[1])
        .signal(0, signal(levels[0]))
        .signal(1, signal(levels[1]));
        let arcs: Result<Vec<_>, _> = sine.run((), [0.0, 1.75], 2.4).collect();
        match arcs {
            Ok(arcs) => {
                let met = arcs.iter().filter_map(|arc| arc.event().map(|event| event.surface));
                assert_eq!(met.collect::<Vec<_>>(), [0, 1, 1, 0], "{below}");
            }
            Err(error) => assert!(matches!(error, Error::Grazing { .. }), "{below} {error}"),
        }
    }
}
