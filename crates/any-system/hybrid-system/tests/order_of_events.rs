//! Events come in the order of the zeros on the computed trajectory: none is lost, none comes twice, none comes early.

use super::peer_scene::Searched;
use super::peer_scene::*;
use hybrid_system::*;

const ULP: f64 = f64::EPSILON;

fn rising(value: impl Fn(&X) -> f64 + 'static) -> Watched {
    Watched { guard: |surface| Guard::rising(surface).crossing(), ..watch(value) }
}

fn wall(value: impl Fn(&X) -> f64 + 'static) -> Watched {
    Watched { guard: |surface| Guard::rising(surface).contact(), ..stopping(value) }
}

/// Two guards whose zeros differ by 1 to 80 ulps: each has one event, at its zero, in this order, in either order
/// of the list, whether the first guard is a line or a sign.
#[test]
fn zeros_that_differ_by_ulps_come_in_their_order() {
    for ulps in (1..16).chain([20, 31, 40, 80]) {
        for searched in SEARCHES {
            let later = 1.0 + f64::from(ulps) * ULP;
            for jumps in [false, true] {
                let first = move |x: &X| match jumps {
                    true if x[TIME] > 1.0 => 1.0,
                    true => -1.0,
                    false => x[TIME] - 1.0,
                };
                let second = move |x: &X| x[TIME] - later;
                for swapped in [false, true] {
                    let guards = match swapped {
                        false => vec![rising(first), rising(second)],
                        true => vec![rising(second), rising(first)],
                    };
                    let (found, ..) = run([0.0; 4], 3.0, searched, guards);
                    let (a, b) = (usize::from(swapped), usize::from(!swapped));
                    let near = |time: f64, zero: f64| (time - zero).abs() <= 2.0 * ULP;
                    let is_right = found.len() == 2
                        && [found[0].0, found[1].0] == [a, b]
                        && near(found[0].1, 1.0)
                        && near(found[1].1, later);
                    // An ulp is within the rounding of the state: the order of the two is that of the computed
                    // trajectory.
                    let as_rounded = ulps <= 2
                        && found.len() == 2
                        && found.iter().all(|event| near(event.1, 1.0) || near(event.1, later));
                    assert!(
                        is_right || as_rounded,
                        "{searched:?} {ulps} {jumps} {swapped}: {found:?}"
                    );
                }
            }
        }
    }
}

/// A wall that jumps, whatever its height, is not passed from a start or from an event next to it.
#[test]
fn a_jump_next_to_a_start_is_not_rounding() {
    for (low, high) in
        [(-1.0, 1.0), (-1.0, 1001.0), (-0.5, 1e3), (-1e-3, 1e6), (-1e-3, 1e12), (-1.0, 1e20)]
    {
        for distance in [1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1] {
            let jump = move |x: &X| if x[TIME] > 1.0 { high } else { low };
            for searched in SEARCHES {
                let scene = format!("{searched:?} {low} {high} {distance}");
                let start = [0.0, 0.0, 1.0 - distance, 0.0];
                let (found, last, stop) = run(start, 3.0, searched, vec![wall(jump)]);
                assert_events(&found, &[(0, 1.0)], searched);
                assert_eq!((stop, last[TIME] > 1.0), (Some(Stop::Terminal), true), "{scene}");
                let mark = move |x: &X| x[TIME] - (1.0 - distance);
                let (found, _, stop) = run([0.0; 4], 3.0, searched, vec![rising(mark), wall(jump)]);
                let surfaces: Vec<usize> = found.iter().map(|event| event.0).collect();
                assert_eq!((surfaces, stop), (vec![0, 1], Some(Stop::Terminal)), "{scene}");
            }
        }
    }
}

/// A stop changes nothing of what follows: no event is lost at it, and none comes twice.
#[test]
fn a_stop_beside_an_event_neither_loses_nor_doubles_it() {
    for searched in SEARCHES {
        for stop in [1.0 - 1e-9, 1.0 - 1e-12, 1.0 - ULP, 1.0, 1.0 + ULP, 1.0 + 1e-12] {
            for height in [1e-3, 1.0, 1e3, 1e6] {
                for guards in [
                    vec![rising(move |x: &X| if x[TIME] > 1.0 { height } else { -1.0 })],
                    vec![rising(move |x: &X| height * (x[TIME] - 1.0))],
                ] {
                    let found = run_with_stop(stop, 3.0, searched, guards);
                    let is_right = found.len() == 1 && is_at(found[0].1, 1.0);
                    assert!(is_right, "{searched:?} {stop:e} {height}: {found:?}");
                }
            }
        }
    }
}

/// Van der Pol's oscillator with two guards whose zeros are 8·10⁻¹⁰ apart, less than the tolerance.
#[test]
fn no_event_is_lost_within_the_tolerance() {
    let first =
        |x: &State<2>| -1.3877097241892478 * x[0] + 1.1788122398660916 * x[1] - 2.423779435540385;
    let second = |x: &State<2>| 0.001 * x[1] - 0.0012197159384670332;
    let times = |tolerance: f64| -> Vec<(usize, f64)> {
        let oscillator =
            Model::integrated(|(), x: &State<2>| [x[1], (1.0 - x[0] * x[0]) * x[1] - x[0]])
                .falling((), first, |x| ((), *x))
                .crossing()
                .rising((), second, |x| ((), *x))
                .crossing()
                .tolerances(Tolerances::both(tolerance));
        let start = [-1.4109717400396415, -0.19837264509987085];
        let arcs = oscillator.run((), start, 2.0183587463562356);
        arcs.filter_map(|arc| arc.unwrap().event().map(|event| (event.surface, event.time)))
            .collect()
    };
    for tolerance in [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6] {
        let found = times(tolerance);
        let names: Vec<_> = found.iter().map(|event| event.0).collect();
        assert_eq!(names, [0, 1], "{tolerance}: {found:?}");
    }
}

/// A component of 10²⁸ does not hide a guard on another one, at a start, behind it and after a reset.
#[test]
fn a_huge_component_hides_no_guard_on_another_one() {
    for huge in [1e28, 1e100, 1e300] {
        for searched in SEARCHES {
            let start = [huge, 0.0, 0.0, 0.0];
            let set = move |x: &X| Some(X::new(-huge, huge, x[TIME], x[FLAG]));
            let guards = vec![
                rising(|x| x[TIME] - 3.0),
                Watched {
                    guard: |surface| Guard::rising(surface).crossing(),
                    ..resetting(at(2.0), set)
                },
            ];
            let (found, ..) = run(start, 5.0, searched, guards);
            assert_events(&found, &[(1, 2.0), (0, 3.0)], searched);
        }
    }
}

/// The times of lines t − k are hit exactly where the sum of the steps is exact.
#[test]
fn round_times_of_lines_are_exact() {
    for k in 1..=16 {
        let zero = f64::from(k);
        for searched in SEARCHES {
            let (found, ..) = run([0.0; 4], 20.0, searched, vec![rising(move |x| x[TIME] - zero)]);
            assert_events(&found, &[(0, zero)], searched);
            // A sum of steps is rounded; the sampled flow adds one number.
            if matches!(searched, Searched::Sampled(_)) {
                assert_eq!(found[0].1, zero, "{searched:?} {k}");
            }
        }
    }
}

/// What helps at a start that stays undecided differs by the search.
#[test]
fn the_advice_at_an_undecided_start_is_that_of_its_search() {
    // Zero up to the time 1, and beyond the surface later: the guard rests on its surface.
    let rests = |x: &X| if x[TIME] < 1.0 { 0.0 } else { 1.0 };
    let flows = Model::integrated(|(), _: &X| [1.0, 2.0, 1.0, 0.0]);
    let flows = flows.rising((), rests, |x| ((), *x)).contact();
    let error = flows.run((), [0.0; 4], 3.0).find_map(Result::err).unwrap();
    let integrated = error.to_string();
    assert!(integrated.contains("a mode of its own"), "{integrated}");
    assert!(!integrated.contains("sample more often"), "{integrated}");
    let solved = Model::closed_form(|(), x: &X, t| *x + t * X::new(1.0, 2.0, 1.0, 0.0));
    let solved = solved.rising((), rests, |x| ((), *x)).contact().sampled(0.25);
    let error = solved.run((), [0.0; 4], 3.0).find_map(Result::err).unwrap();
    let sampled = error.to_string();
    assert!(sampled.contains("give the guard bounds"), "{sampled}");
}

/// Two observers with one zero, and a stop shortly behind: both have their event, by samples too.
#[test]
fn a_stop_behind_a_common_zero_loses_none() {
    for slope in [1.0, 2.5, -1.0] {
        for ulps in 0..60 {
            let guard = |surface| match slope > 0.0 {
                true => Guard::rising(surface),
                false => Guard::falling(surface),
            };
            let ramp = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
                .observer(guard(0), move |x| slope * (x[0] - 1.3))
                .observer(guard(1), move |x| slope * (x[0] - 1.3))
                .sampled(0.1);
            let mut run = ramp.run((), [0.0], 0.0);
            let mut seen = Vec::new();
            for stop in [f64::from_bits(1.3_f64.to_bits() + ulps), 2.0] {
                let arcs = run.run_until(stop).map(|arc| arc.unwrap());
                seen.extend(arcs.filter_map(|arc| arc.event().map(|event| event.surface)));
            }
            assert_eq!(seen, [0, 1], "{slope} {ulps}");
        }
    }
}

/// Under bounds two zeros come in their order, at the doubles of the computed functions, also if the search ends
/// some ulps behind them.
#[test]
fn a_stop_behind_two_zeros_does_not_exchange_them() {
    let up = |ulps: u64| f64::from_bits(1.0_f64.to_bits() + ulps);
    for (first, second) in [(1, 2), (1, 4), (3, 9)] {
        let (late, early) = (up(second), up(first));
        let signal = |zero: f64| {
            move |(), x: &State<1>| Some(QuasiPolynomial::polynomial(&[x[0] - zero, 1.0]))
        };
        let ramp = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
            .observer(Guard::rising(0), move |x| x[0] - late)
            .observer(Guard::rising(1), move |x| x[0] - early)
            .signal(0, signal(late))
            .signal(1, signal(early));
        for behind in 1..20 {
            let mut run = ramp.run((), [0.0], 0.0);
            let mut seen = Vec::new();
            for stop in [up(second + behind), 2.0] {
                let arcs = run.run_until(stop).map(|arc| arc.unwrap());
                seen.extend(
                    arcs.filter_map(|arc| arc.event().map(|event| (event.surface, event.time))),
                );
            }
            assert_eq!(seen, [(1, early), (0, late)], "{behind}");
        }
    }
}

/// Zeros that differ by some ulps come in their order for every direction, with and without resets at them, and after a
/// jump before them; in either order of the list.
#[test]
fn near_zeros_come_in_their_order_under_all_directions_and_after_resets() {
    let guard = |direction, surface| match direction {
        Direction::Rising => Guard::rising(surface),
        Direction::Falling => Guard::falling(surface),
        Direction::Either => Guard::either(surface),
    };
    for ulps in [3, 4, 7, 15, 80] {
        for direction in [Direction::Rising, Direction::Falling, Direction::Either] {
            let sign = if direction == Direction::Falling { -1.0 } else { 1.0 };
            for (kick, swapped) in [(0.0, false), (0.0, true), (1.0, false), (1.0, true)] {
                let places = [2.0, 2.0 + f64::from(ulps) * 2.0 * ULP];
                let [a, b] = if swapped { [places[1], places[0]] } else { places };
                // The jump at 0.5 leads to 1.5: the zeros come at about 1.
                let reset = move |x: &State<2>| ((), [x[0], x[1] + kick]);
                macro_rules! with_guards {
                    ($model:expr) => {
                        $model
                            .guard(
                                (),
                                guard(direction, 0).crossing(),
                                move |x| sign * (x[0] - a),
                                reset,
                            )
                            .guard(
                                (),
                                guard(direction, 1).crossing(),
                                move |x| sign * (x[0] - b),
                                reset,
                            )
                            .guard(
                                (),
                                Guard::rising(2).crossing(),
                                |x| x[0] + x[1] - 0.5,
                                |x| ((), [x[0] + 1.0, x[1] + 100.0]),
                            )
                    };
                }
                let sampled =
                    with_guards!(Model::closed_form(|(), x: &State<2>, t| [x[0] + t, x[1]]))
                        .sampled(0.03);
                let integrated = with_guards!(Model::integrated(|(), _: &State<2>| [1.0, 0.0]));
                let order = |arcs: Vec<Result<_, Error>>| -> Vec<usize> {
                    let arcs = arcs
                        .into_iter()
                        .map(|arc: Result<Arc<(), usize, State<2>>, _>| arc.unwrap());
                    arcs.filter_map(|arc| arc.event().map(|event| event.surface)).collect()
                };
                let expected = if swapped { [2, 1, 0] } else { [2, 0, 1] };
                let start = [0.0, 0.0];
                let scene = format!("{ulps} {direction:?} {kick} {swapped}");
                assert_eq!(order(sampled.run((), start, 3.0).collect()), expected, "{scene}");
                assert_eq!(order(integrated.run((), start, 3.0).collect()), expected, "{scene}");
            }
        }
    }
}

/// A guard that leaves its zero behind the limit on time stays at it up to there.
#[test]
fn what_a_guard_does_behind_the_limit_on_time_is_no_error() {
    let ramp = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
        .guard((), Guard::rising(0).contact(), |x| (x[0] - 0.5).max(0.0), |x| ((), *x))
        .sampled(0.01);
    let arcs: Result<Vec<_>, _> = ramp.run((), [0.0], 0.3).collect();
    assert!(matches!(arcs.unwrap().last().unwrap().end, ArcEnd::TimeLimit { .. }));
}

/// A guard need not be defined behind the event that ends the run.
#[test]
fn a_guard_without_a_value_behind_an_event_does_not_hide_it() {
    for interval in [0.01, 0.3] {
        let root = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
            .observer(Guard::falling(1), |x| (1.02 - x[0]).sqrt() - 0.05)
            .terminal((), Guard::rising(0), |x| x[0] - 1.0)
            .sampled(interval);
        let last = root.run((), [0.0], 3.0).last().unwrap().unwrap();
        assert_eq!(last.event().map(|event| (event.surface, event.time)), Some((0, 1.0)));
        let without_end = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
            .observer(Guard::falling(1), |x| (1.02 - x[0]).sqrt() - 0.05)
            .sampled(interval);
        let mut run = without_end.run((), [0.0], 3.0);
        assert!(run.any(|arc| matches!(arc, Err(Error::NotFinite { .. }))));
    }
}
