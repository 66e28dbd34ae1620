//! Where a sliding motion is not unique, and where it meets other surfaces.

#![cfg(feature = "ode")]

use super::two_sided::*;
use hybrid_system::*;
use nalgebra::{Vector1, Vector2};

/// A sliding motion that starts beside its surface is an error, not a silent projection.
#[test]
fn a_start_beside_the_surface_is_an_error() {
    let relay = Filippov::new(
        TwoSided::<1>::new(|_| Vector1::new(1.0), |_| Vector1::new(-1.0), |x| x[0]),
        TIGHT,
    );
    let mode = FilippovMode::Sliding {
        surface: Surface::Switch,
        partner: Surface::Switch,
        below: Side::Below,
        above: Side::Above,
    };
    let error = run(&relay, mode, Vector1::new(1e-9), Limits::new(1.0, 5)).unwrap_err();
    assert!(matches!(error, Error::OffSurface { .. }), "{error}");
}

/// Both rates vanish together, at y = 1: a/(a − b) is 0/0 there.
#[test]
fn two_tangent_fields_are_not_unique() {
    let fold = Filippov::new(
        TwoSided::<2>::new(
            |x| Vector2::new(1.0 - x[1], 1.0),
            |x| Vector2::new(x[1] - 1.0, 1.0),
            |x| x[0],
        ),
        TIGHT,
    );
    let start = Vector2::new(-1e-3, 0.0);
    let result = run(&fold, BELOW, start, Limits::new(5.0, 50));
    assert!(matches!(result, Err(Error::SlidingNotUnique { .. })), "{result:?}");
}

/// Four quadrants whose fields all point at the origin: ẋ = −sgn x, ẏ = −sgn y.
struct Quadrants;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Quadrant {
    right: bool,
    up: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Axis {
    X,
    Y,
}

impl HybridSystem for Quadrants {
    type State = State<2>;
    type Mode = Quadrant;
    type Surface = Axis;
    fn flow(&self, mode: Quadrant, x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, mode, x, t, TIGHT)
    }
    fn guards(&self, mode: Quadrant) -> &[Guard<Axis>] {
        const fn guard(falls: bool, axis: Axis) -> Guard<Axis> {
            if falls { Guard::falling(axis) } else { Guard::rising(axis) }
        }
        match (mode.right, mode.up) {
            (true, true) => const { &[guard(true, Axis::X), guard(true, Axis::Y)] },
            (true, false) => const { &[guard(true, Axis::X), guard(false, Axis::Y)] },
            (false, true) => const { &[guard(false, Axis::X), guard(true, Axis::Y)] },
            (false, false) => const { &[guard(false, Axis::X), guard(false, Axis::Y)] },
        }
    }
    fn guard_value(&self, axis: Axis, x: &State<2>) -> f64 {
        if axis == Axis::X { x[0] } else { x[1] }
    }
    fn reset(&self, mode: Quadrant, axis: Axis, x: &State<2>) -> Reset<Quadrant, State<2>> {
        let mode = match axis {
            Axis::X => Quadrant { right: !mode.right, ..mode },
            Axis::Y => Quadrant { up: !mode.up, ..mode },
        };
        Reset::Jump { mode, state: *x }
    }
    fn vector_field(&self, mode: Quadrant, _: &State<2>) -> Option<State<2>> {
        let sign = |positive| if positive { 1.0 } else { -1.0 };
        Some(Vector2::new(-sign(mode.right), -sign(mode.up)))
    }
    fn first_crossing(
        &self,
        mode: Quadrant,
        x: &State<2>,
        search: &Search<Axis>,
    ) -> Result<NextEvent<Axis, State<2>>, Error> {
        integrated_crossing(self, mode, x, search, TIGHT)
    }
}

#[test]
fn where_two_sliding_surfaces_meet_the_execution_ends() {
    let system = Filippov::new(Quadrants, TIGHT);
    let mode = FilippovMode::Free(Quadrant { right: true, up: true });
    let start = Vector2::new(1.0, 0.5);
    let (arcs, stop) = run(&system, mode, start, Limits::new(5.0, 50)).unwrap();
    assert_eq!(stop, Some(Stop::Sliding));
    let ArcEnd::Sliding { sliding, after: None } = &arcs.last().unwrap().end else {
        panic!("{:?}", arcs.last())
    };
    // Along y = 0 from t = ½ on, to the origin at t = 1.
    assert_eq!(sliding.surface, FilippovSurface::Model(Axis::X));
    assert!(is_sliding(&sliding.below) && is_sliding(&sliding.above));
    assert!((sliding.time - 1.0).abs() < 1e-13, "{}", sliding.time);
    assert!(sliding.state.amax() < 1e-13);
}

/// The same four fields, all with ẋ = 1: the sliding motion along y = 0 passes through x = 0.
struct Passing;

impl HybridSystem for Passing {
    type State = State<2>;
    type Mode = Quadrant;
    type Surface = Axis;
    fn flow(&self, mode: Quadrant, x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, mode, x, t, TIGHT)
    }
    fn guards(&self, mode: Quadrant) -> &[Guard<Axis>] {
        Quadrants.guards(mode)
    }
    fn guard_value(&self, axis: Axis, x: &State<2>) -> f64 {
        Quadrants.guard_value(axis, x)
    }
    fn reset(&self, mode: Quadrant, axis: Axis, x: &State<2>) -> Reset<Quadrant, State<2>> {
        Quadrants.reset(mode, axis, x)
    }
    fn vector_field(&self, mode: Quadrant, x: &State<2>) -> Option<State<2>> {
        let speed = if mode.right { 2.0 } else { 1.0 };
        Quadrants.vector_field(mode, x).map(|field| Vector2::new(speed, field[1]))
    }
    fn first_crossing(
        &self,
        mode: Quadrant,
        x: &State<2>,
        search: &Search<Axis>,
    ) -> Result<NextEvent<Axis, State<2>>, Error> {
        integrated_crossing(self, mode, x, search, TIGHT)
    }
}

#[test]
fn a_sliding_motion_goes_on_behind_another_surface_with_the_modes_there() {
    let system = Filippov::new(Passing, TIGHT);
    let mode = FilippovMode::Free(Quadrant { right: false, up: true });
    let start = Vector2::new(-1.0, 0.5);
    let (arcs, stop) = run(&system, mode, start, Limits::new(3.0, 50)).unwrap();
    assert_eq!(stop, Some(Stop::TimeLimit));
    let last = arcs.last().unwrap();
    let pair = |right| FilippovMode::Sliding {
        surface: Axis::Y,
        partner: Axis::Y,
        below: Quadrant { right, up: false },
        above: Quadrant { right, up: true },
    };
    assert_eq!(last.mode, pair(true));
    assert!(arcs.iter().any(|arc| arc.mode == pair(false)));
    // x = 0 at t = 1, then with twice the speed for two units of time.
    assert!((last.state(&system, last.duration).unwrap() - Vector2::new(4.0, 0.0)).amax() < 1e-12);
}

/// A mass that slides down a moving wall, x = 0, and bounces off a floor, y = 0, with half of its speed: both modes
/// have the floor, and their resets agree. The state is (x, y, ẏ).
#[test]
fn a_bounce_while_sliding_keeps_the_state_on_the_surface() {
    let model = Model::integrated(|side: Side, x: &State<3>| {
        let push = if side == Side::Below { 1.0 } else { -2.0 };
        [push, x[2], -1.0]
    })
    .tolerance(1e-12)
    .guard(Side::Below, Guard::rising("wall"), |x| x[0], |x: &State<3>| (Side::Above, *x))
    .guard(Side::Above, Guard::falling("wall"), |x| x[0], |x: &State<3>| (Side::Below, *x))
    .guard_everywhere(
        Guard::falling("floor"),
        |x| x[1],
        |side, x: &State<3>| (side, State::<3>::new(x[0], 0.0, -0.5 * x[2])),
    );
    let system = Filippov::new(model, TIGHT);
    let start = State::<3>::new(1.0, 2.0, 0.0);
    let (arcs, _) =
        run(&system, FilippovMode::Free(Side::Above), start, Limits::new(5.0, 20)).unwrap();
    // The floor after 2, with the speed 2. It returns the speed 1, and the next fall takes 2 again.
    let bounces: Vec<_> = arcs
        .iter()
        .filter_map(|arc| arc.event())
        .filter(|event| event.surface == FilippovSurface::Model("floor"))
        .collect();
    assert!((bounces[0].time - 2.0).abs() < 1e-12 && (bounces[1].time - 4.0).abs() < 1e-12);
    for bounce in bounces {
        let (mode, after) = bounce.after.unwrap();
        assert!(is_sliding(&mode) && after[0].abs() < 1e-15, "{mode:?} {after}");
    }
}

/// The same with names of their own for the guards of each mode, as `falling` and `rising` of a model count them. Both
/// components reach zero at the same instant.
#[test]
fn two_relays_whose_guards_have_other_names_in_each_mode_end_where_both_are_zero() {
    let side = |positive: bool| if positive { -1.0 } else { 1.0 };
    let relays = Model::integrated(|(a, b), _: &State<2>| [side(a), side(b)])
        .falling((true, true), |x| x[0], |x| ((false, true), *x))
        .falling((true, true), |x| x[1], |x| ((true, false), *x))
        .rising((false, true), |x| x[0], |x| ((true, true), *x))
        .falling((false, true), |x| x[1], |x| ((false, false), *x))
        .falling((true, false), |x| x[0], |x| ((false, false), *x))
        .rising((true, false), |x| x[1], |x| ((true, true), *x))
        .rising((false, false), |x| x[0], |x| ((true, false), *x))
        .rising((false, false), |x| x[1], |x| ((false, true), *x));
    for start in [[1.0, 1.0], [0.3, 0.3]] {
        let mut execution =
            Execution::new(&relays, (true, true), start.into(), Limits::new(3.0, 200));
        let last = execution.by_ref().last().unwrap().unwrap();
        assert!(matches!(last.end, ArcEnd::Sliding { .. }), "{:?}", last.end);
        assert_eq!(execution.stop(), Some(Stop::Sliding));
        assert!((execution.time() - start[0]).abs() < 1e-12);
    }
}

/// The four quadrants by closures: the front end gives the guards numbers, another one in each mode for the same
/// surface.
#[test]
fn two_sliding_surfaces_with_names_of_their_own_in_each_mode_end_the_execution() {
    let quadrants = || {
        let sign = |positive| if positive { 1.0 } else { -1.0 };
        Model::integrated(move |(right, up): (bool, bool), _: &State<2>| [-sign(right), -sign(up)])
            .falling((true, true), |x| x[0], |x| ((false, true), *x))
            .falling((true, true), |x| x[1], |x| ((true, false), *x))
            .rising((false, true), |x| x[0], |x| ((true, true), *x))
            .falling((false, true), |x| x[1], |x| ((false, false), *x))
            .falling((true, false), |x| x[0], |x| ((false, false), *x))
            // Another multiple of the same function.
            .rising((true, false), |x| 2.0 * x[1], |x| ((true, true), *x))
            .rising((false, false), |x| x[0], |x| ((true, false), *x))
            .rising((false, false), |x| x[1], |x| ((false, true), *x))
    };
    for (x, y) in [(0.0, 0.0), (1.0, 0.5), (0.1, 0.3)] {
        let system = Filippov::new(quadrants(), TIGHT);
        let start = (FilippovMode::Free((true, true)), State::<2>::new(x, y));
        let (arcs, stop) = run(&system, start.0, start.1, Limits::new(5.0, 50)).unwrap();
        assert_eq!(stop, Some(Stop::Sliding), "{x} {y}");
        let ArcEnd::Sliding { sliding, after: None } = &arcs.last().unwrap().end else {
            panic!("{:?}", arcs.last())
        };
        assert!(is_sliding(&sliding.below) && is_sliding(&sliding.above));
        assert!((sliding.time - x.max(y)).abs() < 1e-13 && sliding.state.amax() < 1e-13);
    }
}

/// A relay that leaves its surface at 2.1, where the field of one side turns tangent. At a stop before that point,
/// within the error of its time, both fields still point at the surface.
#[test]
fn a_stop_beside_an_exit_changes_nothing() {
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let relay = || {
            let relay = Model::integrated(|above, x: &State<2>| {
                [if above { -1.0 } else { 1.0 } + 0.3 + x[1] / 3.0, 1.0]
            })
            .tolerance(tolerance)
            .falling(true, |x| x[0], |x| (false, *x))
            .rising(false, |x| x[0], |x| (true, *x));
            Filippov::new(relay, Tolerances::both(tolerance))
        };
        let (system, limits) = (relay(), Limits::new(4.0, 50));
        let start = State::from([-0.5, 0.0]);
        let arcs = Execution::new(&system, FilippovMode::Free(false), start, limits);
        let times: Vec<f64> = arcs.map(|arc| arc.unwrap().time).collect();
        for time in times {
            let stops = [-1e-6, -1e-7, -1e-8, -1e-9, -1e-11].map(|shift| time + shift);
            for stop in stops.into_iter().chain([time.next_down(), time, time.next_up()]) {
                if stop < 0.0 {
                    continue;
                }
                let mut execution =
                    Execution::new(&system, FilippovMode::Free(false), start, limits);
                for end in [stop, 4.0] {
                    for arc in execution.run_until(end) {
                        arc.unwrap_or_else(|error| panic!("{tolerance} {stop}: {error}"));
                    }
                }
                assert_eq!(execution.stop(), Some(Stop::TimeLimit), "{tolerance} {stop}");
                // From 2.1 on ẋ = (t − 2.1)/3.
                let exact = 1.9 * 1.9 / 6.0;
                assert!((execution.state()[0] - exact).abs() < 10.0 * tolerance.max(1e-9));
            }
        }
    }
}

/// A relay that slides along x = 0, with y growing by 1. `more` adds guards to each of its modes.
fn sliding_relay(more: impl Fn(Equations, bool) -> Equations) -> EquationsModel<State<2>> {
    let below = Equations::new(&["x", "y"], &[])
        .mode_text("below", &["1", "1"])
        .rising_text("line", "x")
        .to("above");
    let above =
        more(below, false).mode_text("above", &["-1", "1"]).falling_text("line", "x").to("below");
    more(above, true).model().unwrap()
}

fn end_of(relay: EquationsModel<State<2>>) -> End<FilippovSurface<Label, Label>> {
    let relay = Filippov::new(relay, Tolerances::both(1e-10));
    let below = FilippovMode::Free(Label::new("below").unwrap());
    Execution::new(&relay, below, State::from([-0.5, 0.0]), Limits::new(4.0, 50)).fate().end
}

#[test]
fn a_clock_of_one_side_alone_is_no_stop_while_sliding() {
    let clock = |own: Equations, is_above: bool| {
        if is_above { own } else { own.clock_text("tick", "1", "1").resets_text(&["x", "0"]) }
    };
    let end = end_of(sliding_relay(clock));
    assert!(matches!(end, End::Failed(Error::SlidingNotUnique { .. })), "{end:?}");
    let both = |own: Equations, _| own.clock_text("tick", "1", "1").resets_text(&["x", "0"]);
    assert_eq!(end_of(sliding_relay(both)), End::Stopped(Stop::TimeLimit));
}

#[test]
fn conditions_of_both_sides_count_while_sliding() {
    let gate = |conditions: [&'static str; 2]| {
        end_of(sliding_relay(move |own, is_above| {
            own.rising_text("gate", "y - 1")
                .only_where_text(conditions[usize::from(is_above)])
                .stops()
        }))
    };
    assert!(matches!(gate(["1", "1"]), End::Terminal(_)));
    assert_eq!(gate(["-1", "-1"]), End::Stopped(Stop::TimeLimit));
    for one in [["1", "-1"], ["-1", "1"]] {
        assert!(matches!(gate(one), End::Failed(Error::Condition(_))), "{:?}", gate(one));
    }
}
