//! Models written with closures.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::{DVector, SMatrix};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Heater {
    On,
    Off,
}
use Heater::{Off, On};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    Warm,
    Cold,
}
use Surface::{Cold, Warm};

const TOLERANCE: f64 = 1e-9;

/// The thermostat by the trait.
struct Room;

impl HybridSystem for Room {
    type State = State<1>;
    type Mode = Heater;
    type Surface = Surface;
    fn vector_field(&self, heater: Heater, x: &State<1>) -> Option<State<1>> {
        let target = if heater == On { 30.0 } else { 10.0 };
        Some(State::from([target - x[0]]))
    }
    fn flow(&self, heater: Heater, x: &State<1>, t: f64) -> State<1> {
        integrated_flow(self, heater, x, t, Tolerances::both(TOLERANCE))
    }
    fn guards(&self, heater: Heater) -> &[Guard<Surface>] {
        match heater {
            On => const { &[Guard::rising(Warm)] },
            Off => const { &[Guard::falling(Cold)] },
        }
    }
    fn guard_value(&self, surface: Surface, x: &State<1>) -> f64 {
        x[0] - if surface == Warm { 21.0 } else { 19.0 }
    }
    fn reset(&self, _: Heater, surface: Surface, x: &State<1>) -> Reset<Heater, State<1>> {
        Reset::Jump { mode: if surface == Warm { Off } else { On }, state: *x }
    }
    fn first_crossing(
        &self,
        heater: Heater,
        x: &State<1>,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State<1>>, Error> {
        integrated_crossing(self, heater, x, search, Tolerances::both(TOLERANCE))
    }
}

#[test]
fn a_model_of_closures_has_the_bits_of_the_model_by_the_trait() {
    let room = Model::integrated(|heater, x: &State<1>| match heater {
        On => [30.0 - x[0]],
        Off => [10.0 - x[0]],
    })
    .tolerance(TOLERANCE)
    .guard(On, Guard::rising(Warm), |x| x[0] - 21.0, |x| (Off, *x))
    .guard(Off, Guard::falling(Cold), |x| x[0] - 19.0, |x| (On, *x));
    let limits = Limits::new(20.0, 50);
    let start = State::from([15.0]);
    let arcs: Vec<_> = Execution::new(&room, On, start, limits).collect::<Result<_, _>>().unwrap();
    let by_trait: Vec<_> =
        Execution::new(&Room, On, start, limits).collect::<Result<_, _>>().unwrap();
    assert!(arcs.len() == 50);
    assert_eq!(arcs, by_trait);
    // From 19° to 21° and back takes ln(11/9).
    assert!(arcs[1..].iter().all(|arc| (arc.duration - (11.0f64 / 9.0).ln()).abs() < 1e-9));
}

#[test]
fn guards_without_names_are_numbered() {
    let room =
        Model::integrated(|heater, x: &State<1>| [if heater == On { 30.0 } else { 10.0 } - x[0]])
            .rising(On, |x| x[0] - 21.0, |x| (Off, *x))
            .falling(Off, |x| x[0] - 19.0, |x| (On, *x));
    let surfaces: Vec<usize> = room
        .run(On, [15.0], 2.0)
        .map(|arc| arc.unwrap())
        .filter_map(|arc| arc.event().map(|e| e.surface))
        .collect();
    assert!(surfaces.len() > 5);
    assert!(
        surfaces.iter().enumerate().all(|(event, &surface)| surface == event % 2),
        "{surfaces:?}"
    );
}

/// The 20-line model of the guide, line by line.
#[test]
fn the_guide_begins_with_a_model_of_at_most_fifteen_lines() {
    let guide = include_str!("../docs/guide.md");
    let code = guide.split("```").nth(1).unwrap().trim_start_matches(|c| c != '\n').trim();
    assert!(code.starts_with("use hybrid_system::{Equations"), "{code}");
    assert!(code.lines().filter(|line| !line.trim().is_empty()).count() <= 15, "{code}");
    assert!(
        !code.lines().any(|line| line.starts_with('#') && !line.starts_with("#[")),
        "hidden lines"
    );
    assert!(code.lines().all(|line| line.len() <= 100));
}

/// A ball in closed form, with a section at the top of its flight and parameters from outside.
#[test]
fn terminal_guards_observers_and_parameters() {
    let (gravity, restitution) = (2.0, 0.5);
    let ball = Model::closed_form(|(), x: &State<2>, t| {
        [x[0] + t * (x[1] - gravity * t / 2.0), x[1] - gravity * t]
    })
    .guard((), Guard::falling("floor"), |x| x[0], |x| ((), [0.0, -restitution * x[1]]))
    .signal("floor", |(), x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -gravity / 2.0])))
    .observer(Guard::falling("top"), |x| x[1])
    .signal("top", |(), x| Some(QuasiPolynomial::polynomial(&[x[1], -gravity])))
    .terminal((), Guard::rising("slow").contact(), |x| 0.3 - x[0] - x[1] * x[1] / (2.0 * gravity))
    .signal("slow", |(), x| {
        Some(QuasiPolynomial::polynomial(&[0.3 - x[0] - x[1] * x[1] / (2.0 * gravity)]))
    });
    // From height 4: lands after 2 with speed 4, leaves with 2, is at the top 1 later at height 1, lands 1 later,
    // leaves with 1. Its energy is then ¼ < 0.3: it ends at once.
    let mut execution = ball.run((), [4.0, 0.0], 100.0);
    let events: Vec<_> =
        execution.by_ref().map(|arc| arc.unwrap()).filter_map(|arc| arc.event().copied()).collect();
    let seen: Vec<_> = events.iter().map(|event| (event.surface, event.time)).collect();
    assert_eq!(seen, [("floor", 2.0), ("top", 3.0), ("floor", 4.0), ("slow", 4.0)]);
    assert_eq!(events[1].after, Some(((), events[1].before)));
    assert_eq!(events[3].after, None);
    assert_eq!(execution.stop(), Some(Stop::Terminal));
}

#[test]
fn a_touch_is_what_the_guard_says() {
    let swing = |touch| {
        Model::closed_form(|(), x: &State<2>, t: f64| {
            let (sin, cos) = t.sin_cos();
            [x[0] * cos + x[1] * sin, x[1] * cos - x[0] * sin]
        })
        .guard((), Guard::rising("one").touch(touch), |x| x[0] - 1.0, |x| ((), *x))
        .signal("one", |(), x| {
            let swing = QuasiPolynomial::cosine(x[0], 1.0) + QuasiPolynomial::sine(x[1], 1.0);
            Some(swing + QuasiPolynomial::polynomial(&[-1.0]))
        })
    };
    let ends = |touch| {
        let kind = |arc: Arc<_, _, _>| arc.event().map(|event| event.kind);
        swing(touch)
            .run((), [0.0, 1.0], 5.0)
            .map(|arc| arc.map(kind))
            .collect::<Result<Vec<_>, _>>()
    };
    assert!(matches!(ends(Touch::Error), Err(Error::Grazing { .. })));
    assert_eq!(ends(Touch::Event).unwrap(), [Some(EventKind::Touch), None]);
    assert_eq!(ends(Touch::Ignore).unwrap(), [None]);
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ball {
    Air,
    Floor,
}

#[test]
fn a_ball_rests_after_its_zeno_limit() {
    let ball = Model::closed_form(|mode, x: &State<2>, t| match mode {
        Ball::Air => [x[0] + t * (x[1] - t / 2.0), x[1] - t],
        Ball::Floor => [0.0, 0.0],
    })
    .falling(Ball::Air, |x| x[0], |x| (Ball::Air, [0.0, -0.5 * x[1]]))
    .signal(0, |_, x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5])))
    .rest(|_, _| Some((Ball::Floor, [0.0, 0.0])));
    let arcs: Vec<_> = ball.run(Ball::Air, [0.5, 0.0], 10.0).map(|arc| arc.unwrap()).collect();
    let last = arcs.last().unwrap();
    assert_eq!(last.mode, Ball::Floor);
    assert!((last.time - 3.0).abs() < 1e-12 && last.time + last.duration == 10.0, "{last:?}");
}

#[test]
fn clocks_tick_in_one_mode_or_in_all() {
    let next_half = |after: f64| Some(((after * 2.0).floor() + 1.0) / 2.0);
    let counter = Model::closed_form(|_, x: &State<1>, t| [x[0] + t])
        .clock(On, "tick", next_half, |_, x| (On, [x[0] + 10.0]))
        .clock_everywhere("switch", |after| (after < 1.25).then_some(1.25), |_, x| (Off, *x));
    let arcs: Vec<_> = counter.run(On, [0.0], 3.0).map(|arc| arc.unwrap()).collect();
    let events: Vec<_> = arcs.iter().filter_map(Arc::event).collect();
    let seen: Vec<_> = events.iter().map(|event| (event.surface, event.time)).collect();
    assert_eq!(seen, [("tick", 0.5), ("tick", 1.0), ("switch", 1.25)]);
    assert_eq!(arcs[3].start, State::from([21.25]));
    assert_eq!(arcs[3].mode, Off);
}

#[test]
fn a_guard_of_all_modes_is_also_one_of_later_modes() {
    let walls = Model::closed_form(|up, x: &State<1>, t| [x[0] + if up { t } else { -t }])
        .guard(false, Guard::falling("floor"), |x| x[0], |x| (true, *x))
        .guard_everywhere(Guard::rising("top"), |x| x[0] - 1.0, |up, x| (!up, *x))
        .guard(true, Guard::rising("far"), |x| x[0] - 5.0, |x| (true, *x))
        .sampled(0.1);
    let events: Vec<_> = walls
        .run(true, [0.0], 3.5)
        .map(|arc| arc.unwrap())
        .filter_map(|arc| arc.event().copied())
        .collect();
    let seen: Vec<_> = events.iter().map(|event| (event.surface, event.time)).collect();
    assert_eq!(seen, [("top", 1.0), ("floor", 2.0), ("top", 3.0)]);
}

#[test]
fn a_dimension_chosen_at_run_time() {
    for dimension in [1, 5, 40] {
        let decay = Model::closed_form(|(), x: &DVector<f64>, t: f64| x * (-t).exp())
            .falling((), |x| x.norm() - 1.0, |x| ((), x * 4.0))
            .sampled(0.1);
        let start = vec![4.0; dimension];
        let integrated = Model::integrated(|(), x: &DVector<f64>| -x).falling(
            (),
            |x| x.norm() - 1.0,
            |x| ((), x * 4.0),
        );
        let first = integrated.run((), start.clone(), 5.0).next().unwrap().unwrap();
        assert!((first.duration - (16.0 * dimension as f64).ln() / 2.0).abs() < 1e-9);
        let first = decay.run((), start.clone(), 5.0).next().unwrap().unwrap();
        let landed = first.event().unwrap();
        assert_eq!(landed.before.len(), dimension);
        assert!((first.duration - (16.0 * dimension as f64).ln() / 2.0).abs() < 1e-14);
    }
}

#[test]
fn a_surface_with_two_guards_in_one_mode_is_an_error() {
    let room = Model::integrated(|_, x: &State<1>| [30.0 - x[0]])
        .guard(On, Guard::rising(Warm), |x| x[0] - 21.0, |x| (Off, *x))
        .guard(On, Guard::falling(Warm), |x| x[0] - 21.0, |x| (Off, *x));
    let first = room.run(On, [15.0], 2.0).next().unwrap();
    assert_eq!(first.unwrap_err(), Error::SurfaceTwice { surface: "Warm".into() });
}

#[test]
fn a_surface_with_two_functions_is_an_error_and_one_with_the_same_function_is_not() {
    let room = |second: f64| {
        Model::integrated(|heater, x: &State<1>| [if heater == On { 30.0 } else { 10.0 } - x[0]])
            .guard(On, Guard::rising("line"), |x| x[0] - 21.0, |x| (Off, *x))
            .guard(Off, Guard::falling("line"), move |x| x[0] - second, |_| (On, [19.0]))
    };
    let first = room(19.0).run(On, [15.0], 2.0).next().unwrap();
    let error = Error::TwoGuardFunctions { surface: "\"line\"".into(), first: -4.0, second: -6.0 };
    assert_eq!(first.unwrap_err(), error);
    let same = room(21.0);
    assert!(same.run(On, [15.0], 2.0).filter_map(|arc| arc.unwrap().event().copied()).count() > 3);
}

#[test]
fn a_mode_without_guards_flows_to_the_limit() {
    let decay = Model::<_, usize, _, _>::integrated(|(), x: &State<1>| [-x[0]]);
    let mut execution = decay.run((), [1.0], 2.0);
    let arc = execution.next().unwrap().unwrap();
    assert_eq!((arc.duration, execution.stop()), (2.0, Some(Stop::TimeLimit)));
    assert!((arc.state(&decay, 2.0).unwrap()[0] - (-2.0f64).exp()).abs() < 1e-9);
}

#[test]
fn a_field_of_another_dimension_is_an_error() {
    let wrong = Model::integrated(|(), x: &DVector<f64>| DVector::from_element(x.len() + 1, 1.0))
        .rising((), |x| x[0] - 1.0, |x| ((), x.clone()));
    let first = wrong.run((), vec![0.0, 0.0], 5.0).next().unwrap();
    assert!(matches!(first, Err(Error::Dimension { expected: 2, found: 3, .. })), "{first:?}");
    let reset = Model::integrated(|(), x: &DVector<f64>| DVector::from_element(x.len(), 1.0))
        .rising((), |x| x[0] - 1.0, |_| ((), vec![0.0]));
    let first = reset.run((), vec![0.0, 0.0], 5.0).next().unwrap();
    assert!(matches!(first, Err(Error::Dimension { expected: 2, found: 1, .. })), "{first:?}");
}

/// A ball that lands with the speed v and leaves with v/2: a start that is faster by δ leaves faster by δ/2 and
/// later by 2δ. Compared at the same time it is faster by δ/2 + 2δ.
#[test]
fn derivatives_through_events() {
    let closed = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
        .field(|(), x| [x[1], -1.0])
        .falling((), |x| x[0], |x| ((), [0.0, -0.5 * x[1]]))
        .signal(0, |(), x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5])));
    let integrated = Model::integrated(|(), x: &State<2>| [x[1], -1.0]).falling(
        (),
        |x| x[0],
        |x| ((), [0.0, -0.5 * x[1]]),
    );
    let start = State::from([0.0, 3.0]);
    let change =
        |arc: Result<SMatrix<f64, 2, 2>, Error>| (arc.unwrap() * State::from([0.0, 1.0]))[1];
    let arc = closed.run((), start, 100.0).next().unwrap().unwrap();
    assert!((change(arc_sensitivity(&closed, &arc)) - 2.5).abs() < 1e-9);
    let arc = integrated.run((), start, 100.0).next().unwrap().unwrap();
    assert!((change(arc_sensitivity(&integrated, &arc)) - 2.5).abs() < 1e-9);
}

/// At the start both functions are zero. Beside it they differ.
#[test]
fn two_functions_of_a_surface_that_agree_at_the_start_are_an_error() {
    let line = Model::integrated(|heater, _: &State<1>| [if heater == On { -1.0 } else { 1.0 }])
        .guard(On, Guard::falling("line"), |x| x[0], |x| (Off, *x))
        .guard(Off, Guard::falling("line"), |x| -x[0], |x| (On, *x));
    let first = line.run(On, [0.0], 2.0).next().unwrap();
    assert!(matches!(first, Err(Error::TwoGuardFunctions { .. })), "{first:?}");
}

#[test]
fn bounds_of_a_guard_that_the_model_does_not_have_are_an_error() {
    let ball = || {
        Model::closed_form(|(), x: &State<1>, t| [x[0] - t])
            .guard((), Guard::falling("floor"), |x| x[0], |_| ((), [1.0]))
            .sampled(0.1)
    };
    let misspelt = ball().signal("flor", |(), x| Some(QuasiPolynomial::polynomial(&[x[0], -1.0])));
    let first = misspelt.run((), [1.0], 3.0).next().unwrap();
    assert!(matches!(&first, Err(Error::NoSuchGuard { surface, .. }) if surface == "\"flor\""));
    let misspelt = ball().enclosure("flor", |(), _, _, _| Some(Enclosure::new(-9.0, 9.0)));
    let first = misspelt.run((), [1.0], 3.0).next().unwrap();
    assert!(matches!(first, Err(Error::NoSuchGuard { .. })), "{first:?}");
}

/// `Model::clock` takes the times of a clock. Such a guard would never have an event.
#[test]
fn a_clock_with_a_guard_function_is_an_error() {
    let line = || Model::integrated(|(), _: &State<1>| [-1.0]);
    let expected = Err(Error::ClockWithoutTimes { surface: "7".into() });
    let clock = Guard::clock(7);
    let guarded = line().guard((), clock, |x| x[0], |_| ((), [1.0]));
    assert_eq!(guarded.run((), [1.0], 3.0).next().unwrap(), expected);
    let everywhere = line().guard_everywhere(clock, |x| x[0], |(), _| ((), [1.0]));
    assert_eq!(everywhere.run((), [1.0], 3.0).next().unwrap(), expected);
    let terminal = line().terminal((), clock, |x| x[0]);
    assert_eq!(terminal.run((), [1.0], 3.0).next().unwrap(), expected);
    let observed = line().observer(clock, |x| x[0]);
    assert_eq!(observed.run((), [1.0], 3.0).next().unwrap(), expected);
}
