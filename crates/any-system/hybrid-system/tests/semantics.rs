//! The scenes of the page `hybrid_system::semantics`, a test each: what happens at the start of an arc, at surfaces
//! that are met together, where both fields point at a surface, and where a guard touches zero.

use example_systems::scenes::*;
use hybrid_system::*;

/// The error of times and states of these scenes, which are of size 1 to 20: rounding, or the tolerances of the
/// integrated scenes, 1e-10.
fn error(by: By) -> f64 {
    if matches!(by, By::Integration | By::Series) { 1e-10 } else { 1e-13 }
}

/// The error of the time of a touch, a double root: the root of the error of the value.
const TOUCH_ERROR: f64 = 1e-5;

/// The interval of the sampled runs.
const INTERVAL: f64 = 0.01;

type Arcs<const N: usize> = Vec<Arc<Label, Label, State<N>>>;

/// All arcs, and why the execution stopped.
fn run<const N: usize>(
    scene: Result<Scene<N>, Error>,
    mode: &str,
    start: impl Into<State<N>>,
    time: f64,
    events: usize,
) -> Result<(Arcs<N>, Stop), Error> {
    let limits = Limits::sampled(time, events, INTERVAL);
    let (scene, mode) = (scene.unwrap(), Label::new(mode).unwrap());
    let mut execution = Execution::new(&scene, mode, start.into(), limits);
    let arcs = execution.by_ref().collect::<Result<Arcs<N>, Error>>()?;
    Ok((arcs, execution.stop().unwrap()))
}

/// Surface and time of each event.
fn events<const N: usize>(arcs: &Arcs<N>) -> Vec<(Label, f64)> {
    arcs.iter().filter_map(Arc::event).map(|event| (event.surface, event.time)).collect()
}

/// Events at these surfaces and times, and at no others.
#[track_caller]
fn assert_events<const N: usize>(arcs: &Arcs<N>, expected: &[(&str, f64)], by: By) {
    let found = events(arcs);
    let same = |(a, b): (&(Label, f64), &(&str, f64))| a.0 == b.0 && (a.1 - b.1).abs() < error(by);
    let all = found.len() == expected.len() && found.iter().zip(expected).all(same);
    assert!(all, "{by:?}: {found:?} instead of {expected:?}");
}

#[test]
fn in_a_cradle_with_touching_balls_the_last_ball_leaves() {
    for by in WAYS {
        let (arcs, stop) = run(cradle(by), "cradle", cradle_start(), 3.0, 100).unwrap();
        // Ball 1 stops, ball 2 passes the velocity on at the same instant, and ball 3 moves away.
        assert_events(&arcs, &[("first pair", 1.0), ("second pair", 1.0)], by);
        assert_eq!((stop, arcs.len()), (Stop::TimeLimit, 3));
        let end = arcs[2].state(&cradle(by).unwrap(), arcs[2].duration).unwrap();
        assert!(
            (end - State::from([0.0, 0.0, 2.0, 0.0, 0.0, 1.0])).amax() < error(by),
            "{by:?}: {end}"
        );
        assert_eq!(arcs[1].event().unwrap().kind, EventKind::AtStart);
    }
}

#[test]
fn balls_dropped_together_without_a_gap_collide_like_those_with_a_gap() {
    for by in WAYS {
        let start = |gap: f64| State::from([1.0, 1.0 + gap, 0.0, 0.0]);
        let (arcs, _) = run(stack(by), "flight", start(0.0), 100.0, 3).unwrap();
        // The lower ball rebounds with v, the upper one comes with −v. With masses 2 : 1 they leave with −v/3 and 5v/3,
        // and the lower one hits the floor again, at once.
        let landing = 2f64.sqrt();
        assert_events(&arcs, &[("floor", landing), ("between", landing), ("floor", landing)], by);
        let (_, after) = arcs[2].event().unwrap().after.unwrap();
        let exact = State::from([0.0, 0.0, landing / 3.0, 5.0 * landing / 3.0]);
        assert!((after - exact).amax() < error(by), "{by:?}: {after}");
        // A gap of 1e-12 changes the state after the same three events by as little.
        let (apart, _) = run(stack(by), "flight", start(1e-12), 100.0, 3).unwrap();
        let (_, apart) = apart[2].event().unwrap().after.unwrap();
        assert!((after - apart).amax() < 1e-11 + error(by), "{by:?}: {apart}");
    }
}

#[test]
fn two_balls_never_pass_through_each_other_or_the_floor() {
    for by in SURE_WAYS {
        let (arcs, stop) = run(stack(by), "flight", [1.0, 1.0, 0.0, 0.0], 30.0, 10_000).unwrap();
        assert_eq!(stop, Stop::TimeLimit);
        for arc in &arcs {
            for k in 0..=20 {
                let x = arc.state(&stack(by).unwrap(), arc.duration * f64::from(k) / 20.0).unwrap();
                assert!(x[0] > -error(by) && x[1] - x[0] > -error(by), "{by:?}: {x}");
            }
        }
    }
}

/// The relay of all kinds slides: closed or integrated, with resets that put x to 0 or not.
#[test]
fn a_relay_slides_where_both_fields_point_at_its_surface() {
    for by in SURE_WAYS {
        for scene in [relay(by), snapping_relay(by)] {
            let (arcs, stop) = run(scene, "above", [1.0, 0.0], 10.0, 100_000).unwrap();
            assert_eq!(stop, Stop::Sliding);
            let ArcEnd::Sliding { sliding, after } = arcs.last().unwrap().end else {
                panic!("{by:?}: {:?}", arcs.last())
            };
            assert_eq!(after, None);
            let labels = ["x = 0", "below", "above"].map(|label| Label::new(label).unwrap()).into();
            assert_eq!((sliding.surface, sliding.below, sliding.above), labels);
            // x falls at the rate 0.7 from 1 to 0.
            assert!((sliding.time - 1.0 / 0.7).abs() < error(by), "{by:?}: {}", sliding.time);
            assert!(sliding.state[0].abs() < error(by));
            assert!((sliding.rates.0 - 1.3).abs() < error(by));
            assert!((sliding.rates.1 + 0.7).abs() < error(by));
            if by != By::Signal {
                // The mean that is tangent: 0.35 of the field below and 0.65 of the field above.
                let field = sliding.field.unwrap();
                assert!((field - State::from([0.0, 0.3])).amax() < error(by), "{field}");
            }
        }
    }
}

/// Without signal, enclosure or field the rates on both sides are unknown: the events at one instant are an error.
#[test]
fn a_sampled_relay_without_a_field_is_a_timeless_chain() {
    let failed = run(snapping_relay(By::Samples), "above", [1.0, 0.0], 10.0, 100_000);
    assert!(matches!(failed, Err(Error::TimelessChain { .. })), "{failed:?}");
}

#[test]
fn five_modes_that_leave_at_one_point_give_five_events_at_one_instant() {
    for by in WAYS {
        let (arcs, stop) = run(five_modes(by), "0", [0.25], 3.0, 100).unwrap();
        assert_events(&arcs, &["0", "1", "2", "3", "4"].map(|surface| (surface, 0.75)), by);
        let last = arcs.last().unwrap();
        assert_eq!((stop, last.mode), (Stop::TimeLimit, Label::new("5").unwrap()));
        let times: Vec<f64> = arcs[..5].iter().map(|arc| arc.event().unwrap().time).collect();
        assert!(times.iter().all(|&time| time == times[0]), "{by:?}: {times:?}");
        // Nothing is lost: x = 1 + (3 − 0.75).
        let end = last.state(&five_modes(by).unwrap(), last.duration).unwrap();
        assert!((end[0] - 3.25).abs() < error(by), "{by:?}: {end}");
    }
}

#[test]
fn a_jump_beyond_a_guard_is_an_event_at_once() {
    for by in WAYS {
        let (arcs, stop) = run(past_guard(by), "0", [0.0], 3.0, 100).unwrap();
        assert_events(&arcs, &[("x = 1", 1.0), ("x = ½", 1.0)], by);
        assert!(stop == Stop::TimeLimit && arcs[2].mode == "2");
        assert_eq!((arcs[1].duration, arcs[1].event().unwrap().kind), (0.0, EventKind::AtStart));
    }
}

#[test]
fn a_jump_beyond_a_switch_is_an_error_with_both_words() {
    for by in WAYS {
        let failed = run(past_switch(by), "0", [0.0], 3.0, 100).unwrap_err();
        let Error::LandsBeyond(LandsBeyond { mode, surface, time, value, on_surface, .. }) =
            &failed
        else {
            panic!("{by:?}: {failed}")
        };
        assert_eq!((mode.as_str(), surface.as_str(), *on_surface), ("\"1\"", "\"x = ½\"", false));
        assert!((time - 1.0).abs() < error(by) && (value - 0.5).abs() < error(by), "{failed}");
        let text = failed.to_string();
        assert!(text.contains("`contact`") && text.contains("`crossing`"), "{text}");
    }
}

#[test]
fn a_jump_beyond_a_crossing_is_no_event() {
    for by in WAYS {
        let (arcs, stop) = run(past_crossing(by), "0", [0.0], 3.0, 100).unwrap();
        assert_events(&arcs, &[("x = 1", 1.0)], by);
        assert!(stop == Stop::TimeLimit && arcs[1].mode == "1");
    }
}

#[test]
fn a_start_below_the_floor_is_an_error_with_the_numbers() {
    for by in WAYS {
        let failed = run(ball(by), "flight", [-0.25, 0.0], 3.0, 100).unwrap_err();
        let Error::StartsBeyond { mode, surface, value, rounding } = &failed else {
            panic!("{by:?}: {failed}")
        };
        assert_eq!((mode.as_str(), surface.as_str(), *value), ("\"flight\"", "\"floor\"", -0.25));
        assert!((0.0..1e-14).contains(rounding));
        assert!(failed.to_string().contains("-0.25"), "{failed}");
    }
}

/// On the floor within rounding, and moving up, is a start like any other.
#[test]
fn a_start_an_ulp_below_the_floor_is_on_the_floor() {
    // The scene is moved up to 1, so that its heights have a rounding error of 1e-16.
    let above_one = |by| bouncing(by, "height - 1", &["max(height, 1)", "-0.5*speed"]);
    for by in WAYS {
        let start = State::from([1.0f64.next_down(), 1.0]);
        let (arcs, _) = run(above_one(by), "flight", start, 10.0, 2).unwrap();
        assert_events(&arcs, &[("floor", 2.0), ("floor", 3.0)], by);
    }
}

#[test]
fn a_reset_over_a_surface_is_an_event_at_once() {
    for by in WAYS {
        let (arcs, _) = run(leap(by), "rises", [12.0], 14.0, 100).unwrap();
        // 12 → 15 in 3, jump to −20, at once to 5, then to 15 again in 10, and so on.
        assert_events(&arcs, &[("top", 3.0), ("zero", 3.0), ("top", 13.0), ("zero", 13.0)], by);
    }
}

#[test]
fn a_reset_over_an_observed_surface_is_no_event() {
    for by in WAYS {
        let (arcs, _) = run(watched_leap(by), "rises", [12.0], 40.0, 100).unwrap();
        // 12 → 15 in 3, jump to −20, through 0 after 20, to 15 after 15.
        assert_events(&arcs, &[("top", 3.0), ("zero", 23.0), ("top", 38.0)], by);
    }
}

#[test]
fn a_thousand_events_in_no_time_are_an_error_with_the_cycle() {
    for by in WAYS {
        let failed = run(endless(by), "0", [0.0], 5.0, 100_000).unwrap_err();
        let Error::TimelessChain { time, events, cycle } = &failed else {
            panic!("{by:?}: {failed}")
        };
        assert!((time - 1.0).abs() < error(by) && *events >= 1000, "{by:?}: {failed}");
        assert!(cycle.contains("x = 1") && cycle.contains("x = 3"), "{by:?}: {cycle}");
    }
}

/// A ball that has no velocity left, in a model without a mode for rest, hits its floor again and again in no time.
#[test]
fn a_plastic_ball_without_a_mode_for_rest_is_a_timeless_chain() {
    for by in WAYS {
        let failed = run(bouncing(by, "height", &["0", "0"]), "flight", [0.5, 0.0], 5.0, 100_000)
            .unwrap_err();
        let Error::TimelessChain { time, .. } = failed else { panic!("{by:?}: {failed}") };
        assert!((time - 1.0).abs() < error(by), "{by:?}: {time}");
    }
}

#[test]
fn a_touch_is_an_error_by_default() {
    for by in SURE_WAYS {
        let failed = run(ceiling(by, Touch::Error), "flight", throw(), 10.0, 100).unwrap_err();
        let Error::Grazing { time, value, .. } = failed else { panic!("{by:?}: {failed}") };
        assert!((time - 2.0).abs() < TOUCH_ERROR && value.abs() < error(by), "{by:?}: {time}");
    }
}

#[test]
fn a_touch_can_be_an_event_of_its_own_kind() {
    for by in SURE_WAYS {
        let (arcs, stop) = run(ceiling(by, Touch::Event), "flight", throw(), 10.0, 100).unwrap();
        assert_eq!((stop, arcs.len()), (Stop::TimeLimit, 2));
        let event = arcs[0].event().unwrap();
        assert_eq!(event.kind, EventKind::Touch);
        assert!((event.time - 2.0).abs() < TOUCH_ERROR, "{by:?}: {}", event.time);
    }
}

#[test]
fn a_touch_can_be_ignored_and_the_execution_goes_on_behind_it() {
    for by in SURE_WAYS {
        let (arcs, stop) = run(ceiling(by, Touch::Ignore), "flight", throw(), 10.0, 100).unwrap();
        assert_eq!((stop, arcs.len()), (Stop::TimeLimit, 1));
        // A real crossing is still an event: faster by 1e-6, the ball passes the ceiling.
        let (arcs, _) =
            run(ceiling(by, Touch::Ignore), "flight", [0.0, 2.000_001], 10.0, 1).unwrap();
        assert_eq!(arcs[0].event().unwrap().kind, EventKind::Crossing);
    }
}

/// Slower by 1e-6 the ball stays below the ceiling by 2e-6: neither a crossing nor a touch.
/// v²/2 = 2 at the ceiling: 2.2²/2 − 2 = 0.42 is left, and the ball arrives after 2.2 − √0.84 with the velocity √0.84.
#[test]
fn a_ball_that_is_faster_by_a_tenth_hits_the_ceiling() {
    let speed = 0.84f64.sqrt();
    for by in WAYS {
        for touch in [Touch::Error, Touch::Ignore] {
            let (arcs, _) = run(ceiling(by, touch), "flight", [0.0, 2.2], 2.0, 100).unwrap();
            assert_events(&arcs, &[("ceiling", 2.2 - speed)], by);
            let event = arcs[0].event().unwrap();
            assert_eq!(event.kind, EventKind::Crossing);
            assert!((event.before[1] - speed).abs() < error(by), "{by:?}: {}", event.before);
        }
    }
}

#[test]
fn a_clear_miss_is_no_touch() {
    for by in WAYS {
        let (arcs, stop) =
            run(ceiling(by, Touch::Error), "flight", [0.0, 1.999_999], 10.0, 100).unwrap();
        assert_eq!((stop, arcs.len()), (Stop::TimeLimit, 1));
    }
}

/// ẋ = −1 over a floor at 0. Its events put x to `after`. The search is the library's, or sees nothing.
struct Falling {
    after: f64,
    blind: bool,
    /// The rounding of the guard that the model states.
    stated: Option<f64>,
}

impl HybridSystem for Falling {
    type State = State<1>;
    type Mode = ();
    type Surface = u8;
    fn flow(&self, _: (), x: &State<1>, t: f64) -> State<1> {
        State::from([x[0] - t])
    }
    fn guards(&self, _: ()) -> &[Guard<u8>] {
        const { &[Guard::falling(0).contact()] }
    }
    fn guard_value(&self, _: u8, x: &State<1>) -> f64 {
        x[0]
    }
    fn guard_error(&self, _: u8, _: &State<1>) -> Option<f64> {
        self.stated
    }
    fn guard_quasi_polynomial(&self, _: (), _: u8, x: &State<1>) -> Option<QuasiPolynomial> {
        Some(QuasiPolynomial::polynomial(&[x[0], -1.0]))
    }
    fn reset(&self, _: (), _: u8, _: &State<1>) -> Reset<(), State<1>> {
        Reset::Jump { mode: (), state: State::from([self.after]) }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<1>,
        search: &Search<u8>,
    ) -> Result<NextEvent<u8, State<1>>, Error> {
        if self.blind { Ok(NextEvent::never()) } else { default_search(self, mode, x, search) }
    }
}

/// The starts of all arcs are decided by the execution, whatever the model's own search finds. The search of the
/// library can be called from there, with its certainty.
#[test]
fn a_model_with_its_own_search_is_checked_at_every_start() {
    let first = |after, blind, start| {
        let system = Falling { after, blind, stated: None };
        let limits = Limits::new(3.0, 10);
        Execution::new(&system, (), State::<1>::from([start]), limits).next().unwrap()
    };
    for blind in [false, true] {
        let below = first(1.0, blind, -0.25);
        assert!(matches!(below, Err(Error::StartsBeyond { .. })), "{below:?}");
        let on_the_floor = first(1.0, blind, 0.0).unwrap();
        let event = on_the_floor.event().unwrap();
        assert_eq!((event.time, event.kind), (0.0, EventKind::AtStart));
    }
    let seen = first(1.0, false, 0.5).unwrap();
    let event = seen.event().unwrap();
    assert_eq!((event.time, event.kind), (0.5, EventKind::Crossing));
    assert_eq!(event.certainty, Certainty::Certain);
    // A reset to a state below the floor is an event at once, again and again.
    let system = Falling { after: -1.0, blind: true, stated: None };
    let last = Execution::new(&system, (), State::from([0.0]), Limits::new(3.0, 10_000)).last();
    assert!(matches!(last, Some(Err(Error::TimelessChain { .. }))), "{last:?}");
}

/// A value within the error that the model states is on the surface, and the flow decides; a larger one is beyond.
#[test]
fn the_rounding_that_a_model_states_for_its_guard_counts() {
    let first = |stated| {
        let system = Falling { after: 1.0, blind: false, stated };
        Execution::new(&system, (), State::<1>::from([-1e-9]), Limits::new(3.0, 10)).next().unwrap()
    };
    for stated in [None, Some(1e-10)] {
        assert!(matches!(first(stated), Err(Error::StartsBeyond { .. })), "{stated:?}");
    }
    let arc = first(Some(1e-8)).unwrap();
    assert_eq!(arc.event().map(|event| (event.time, event.kind)), Some((0.0, EventKind::AtStart)));
}
