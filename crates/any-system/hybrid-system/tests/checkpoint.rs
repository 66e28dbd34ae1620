//! Executions that are stopped, advanced piece by piece, saved and restored.

#![cfg(all(feature = "ode", feature = "serde"))]

use hybrid_system::*;
use nalgebra::{DVector, Vector2};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Every arc of an execution: the checkpoint before it, in memory and through JSON, leads to the same bits as the
/// execution without a stop.
fn restored_at_every_arc<T>(system: &T, mode: T::Mode, start: T::State, limits: Limits) -> usize
where
    T: HybridSystem,
    T::Mode: Serialize + DeserializeOwned,
    T::Surface: Serialize + DeserializeOwned,
    T::State: Serialize + DeserializeOwned,
{
    let uninterrupted: Vec<_> =
        Execution::new(system, mode, start.clone(), limits).map(|arc| format!("{arc:?}")).collect();
    let mut execution = Execution::new(system, mode, start, limits);
    for done in 0..=uninterrupted.len() {
        let checkpoint = execution.checkpoint();
        let json = serde_json::to_string(&checkpoint).unwrap();
        let read: Checkpoint<T::Mode, T::Surface, T::State> = serde_json::from_str(&json).unwrap();
        for checkpoint in [checkpoint, read] {
            let restored = Execution::restore(system, checkpoint, limits);
            let rest: Vec<_> = restored.map(|arc| format!("{arc:?}")).collect();
            assert_eq!(rest, uninterrupted[done..], "after {done} arcs");
        }
        execution.next();
    }
    uninterrupted.len()
}

/// A ball that rests after its bounces, with the guard as a signal, by bounds, or sampled.
#[test]
fn a_bouncing_ball_with_its_zeno_limit() {
    let ball = || {
        Model::closed_form(|resting, x: &State<2>, t| match resting {
            false => [x[0] + t * (x[1] - t / 2.0), x[1] - t],
            true => [0.0, 0.0],
        })
        .falling(false, |x| x[0], |x| (false, [0.0, -0.3 * x[1]]))
        .rest(|_, _| Some((true, [0.0, 0.0])))
    };
    let start = State::from([0.7, 0.1]);
    let signal = ball().signal(0, |_, x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5])));
    let arcs = restored_at_every_arc(&signal, false, start, Limits::new(10.0, 100));
    assert!(arcs > 10);
    let bounds = ball().enclosure(0, |_, x, order, (from, to)| {
        // ẋ falls with time; x is the integral of ẋ.
        let speed = (x[1] - to, x[1] - from);
        let height = x[0] + from * (x[1] - from / 2.0);
        let reach = (to - from) * speed.0.abs().max(speed.1.abs());
        match order {
            0 => Some(Enclosure::new(height - reach - 1e-14, height + reach + 1e-14)),
            1 => Some(Enclosure::new(speed.0 - 1e-15, speed.1 + 1e-15)),
            2 => Some(Enclosure::new(-1.0, -1.0)),
            _ => Some(Enclosure::new(0.0, 0.0)),
        }
    });
    restored_at_every_arc(&bounds, false, start, Limits::new(2.0, 100));
    restored_at_every_arc(&ball(), false, start, Limits::sampled(2.0, 100, 0.01));
}

/// Three balls in a row on a line, the last two touching: the events at one instant are in the checkpoint.
#[test]
fn events_at_one_instant() {
    let cradle = Model::closed_form(|(), x: &State<6>, t| {
        [x[0] + t * x[3], x[1] + t * x[4], x[2] + t * x[5], x[3], x[4], x[5]]
    })
    .falling((), |x| x[1] - x[0], |x| ((), [x[0], x[1], x[2], x[4], x[3], x[5]]))
    .contact()
    .falling((), |x| x[2] - x[1], |x| ((), [x[0], x[1], x[2], x[3], x[5], x[4]]))
    .contact()
    .signal(0, |(), x| Some(QuasiPolynomial::polynomial(&[x[1] - x[0], x[4] - x[3]])))
    .signal(1, |(), x| Some(QuasiPolynomial::polynomial(&[x[2] - x[1], x[5] - x[4]])));
    let start = State::from([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    assert_eq!(restored_at_every_arc(&cradle, (), start, Limits::new(3.0, 10)), 3);
}

#[test]
fn integrated_modes_clocks_and_observers() {
    let ticks = PeriodicTimes::new(0.1, 0.1).unwrap();
    let room = Model::integrated(|on, x: &State<1>| [if on { 30.0 } else { 10.0 } - x[0]])
        .rising(true, |x| x[0] - 21.0, |x| (false, *x))
        .falling(false, |x| x[0] - 19.0, |x| (true, *x))
        .observer(Guard::either(2), |x| x[0] - 20.0)
        .clock_everywhere(3, |after| ticks.next_after(after), |on, x| (on, *x));
    let arcs = restored_at_every_arc(&room, true, State::from([15.0]), Limits::new(1.0, 100));
    assert!(arcs > 10);
}

/// A relay, ẋ = −sgn x + 0.3 with a drift t/3: it slides on x = 0 until the drift is too strong, at 2.1.
#[test]
fn sliding_modes() {
    let relay = Model::integrated(|above, x: &State<2>| {
        [if above { -1.0 } else { 1.0 } + 0.3 + x[1] / 3.0, 1.0]
    })
    .falling(true, |x| x[0], |x| (false, *x))
    .rising(false, |x| x[0], |x| (true, *x));
    let sliding = Filippov::new(relay, Tolerances::both(1e-10));
    let (start, limits) = (State::from([-0.5, 0.0]), Limits::new(4.0, 100));
    let arcs = restored_at_every_arc(&sliding, FilippovMode::Free(false), start, limits);
    // Up to the surface, onto it, along it, and up.
    assert!(arcs >= 4, "{arcs}");
}

/// A model that solves for its own crossings.
struct Exact;

impl HybridSystem for Exact {
    type State = State<1>;
    type Mode = bool;
    type Surface = u8;
    fn flow(&self, up: bool, x: &State<1>, t: f64) -> State<1> {
        State::from([x[0] + if up { t } else { -t }])
    }
    fn guards(&self, up: bool) -> &[Guard<u8>] {
        if up { const { &[Guard::rising(1)] } } else { const { &[Guard::falling(0)] } }
    }
    fn guard_value(&self, surface: u8, x: &State<1>) -> f64 {
        x[0] - f64::from(surface)
    }
    fn reset(&self, up: bool, _: u8, x: &State<1>) -> Reset<bool, State<1>> {
        Reset::Jump { mode: !up, state: *x }
    }
    fn first_crossing(
        &self,
        up: bool,
        x: &State<1>,
        search: &Search<u8>,
    ) -> Result<NextEvent<u8, State<1>>, Error> {
        let time = if up { 1.0 - x[0] } else { x[0] };
        let surface = u8::from(up);
        let crossing = Crossing::exact(surface, time, State::from([f64::from(surface)]));
        Ok(Some(crossing).filter(|_| time <= search.horizon).into())
    }
}

#[test]
fn exact_crossings() {
    let arcs = restored_at_every_arc(&Exact, true, State::from([0.1]), Limits::new(9.35, 100));
    assert_eq!(arcs, 10);
}

#[test]
fn a_dimension_chosen_at_run_time() {
    let decay = Model::closed_form(|(), x: &DVector<f64>, t: f64| x * (-t).exp()).falling(
        (),
        |x| x.norm() - 1.0,
        |x| ((), x * 4.0),
    );
    let start = DVector::from_vec(vec![4.0, 0.1, -1.0 / 3.0]);
    assert!(restored_at_every_arc(&decay, (), start, Limits::sampled(9.0, 100, 0.1)) > 5);
}

/// A jump lands beyond the surface that it has crossed. As a crossing it is no event there, as a guard without a word
/// it is an error, and both are so from every checkpoint.
#[test]
fn a_state_beyond_its_surface() {
    let sinking =
        || {
            Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
                .falling((), |x| x[0], |_| ((), [-0.2, 1.0]))
        };
    let start = State::from([0.7, 0.1]);
    let limits = Limits::sampled(8.0, 100, 0.01);
    assert!(restored_at_every_arc(&sinking().crossing(), (), start, limits) > 4);
    let last = Execution::new(&sinking(), (), start, limits).last().unwrap();
    assert!(matches!(last, Err(Error::LandsBeyond(_))), "{last:?}");
    assert_eq!(restored_at_every_arc(&sinking(), (), start, limits), 2);
}

#[test]
fn a_failed_execution_stays_failed() {
    let clock = Model::<_, usize, _, _>::closed_form(|(), x: &State<1>, t: f64| [x[0] / (1.0 - t)])
        .sampled(0.3)
        .falling((), |x| x[0], |x| ((), *x));
    let limits = Limits::sampled(5.0, 10, 1.0);
    let mut execution = Execution::new(&clock, (), State::from([1.0]), limits);
    assert!(execution.next().unwrap().is_err());
    let again = Execution::restore(&clock, execution.checkpoint(), limits);
    assert_eq!((again.stop(), again.count()), (Some(Stop::Failed), 0));
}

#[test]
fn numbers_that_json_does_not_have_are_refused() {
    let jump = Model::closed_form(|(), x: &State<1>, t| [x[0] - t])
        .falling((), |x| x[0], |_| ((), [f64::NAN]))
        .sampled(0.1);
    let mut execution = jump.run((), [1.0], 3.0);
    assert!(serde_json::to_string(&execution.checkpoint()).is_ok());
    execution.next();
    let error = serde_json::to_string(&execution.checkpoint()).unwrap_err().to_string();
    assert!(error.contains("must be finite"), "{error}");
    let start = jump.run((), [f64::INFINITY], 3.0).checkpoint();
    assert!(serde_json::to_string(&start).is_err());
    // What another program wrote.
    let json = serde_json::to_string(&jump.run((), [1.0], 3.0).checkpoint()).unwrap();
    let null = json.replacen("1.0", "null", 1);
    assert!(serde_json::from_str::<Checkpoint<(), usize, State<1>>>(&null).is_err());
}

#[test]
fn a_stop_at_a_time_has_the_state_of_that_time() {
    let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
        .falling((), |x| x[0], |x| ((), [0.0, -0.5 * x[1]]))
        .signal(0, |(), x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5])));
    let mut execution = ball.run((), [0.5, 0.0], 0.0);
    let mut arcs = 0;
    for step in 1..=25 {
        let time = f64::from(step) / 10.0;
        for arc in execution.run_until(time) {
            arc.unwrap();
            arcs += 1;
        }
        assert_eq!((execution.time(), execution.stop()), (time, Some(Stop::TimeLimit)));
        // Lands at 1, 2, 2½ with the speeds 1, ½, ¼.
        let height = |since: f64, speed: f64| since * (speed - since / 2.0);
        let exact = match time {
            t if t < 1.0 => 0.5 - t * t / 2.0,
            t if t < 2.0 => height(t - 1.0, 0.5),
            t if t < 2.5 => height(t - 2.0, 0.25),
            _ => 0.0,
        };
        assert!((execution.state()[0] - exact).abs() < 1e-15, "{time}");
    }
    // Each of the 25 pieces ends at its time, and three arcs end in a bounce.
    assert_eq!((arcs, execution.jump()), (28, 3));
    let backwards = execution.run_until(1.0).next().unwrap();
    assert!(matches!(backwards, Err(Error::BadLimit { .. })), "{backwards:?}");
}

/// An observer whose surface is reached exactly at a stop keeps its event, and has it once.
#[test]
fn a_stop_on_a_surface_loses_no_event() {
    let line = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
        .observer(Guard::rising(0), |x| x[0] - 1.0)
        .observer(Guard::either(1), |x| x[0] - 1.5)
        .guard((), Guard::rising(2), |x| x[0] - 2.0, |_| ((), [0.0]))
        .signal(0, |(), x| Some(QuasiPolynomial::polynomial(&[x[0] - 1.0, 1.0])))
        .signal(1, |(), x| Some(QuasiPolynomial::polynomial(&[x[0] - 1.5, 1.0])))
        .signal(2, |(), x| Some(QuasiPolynomial::polynomial(&[x[0] - 2.0, 1.0])));
    for pieces in [1, 2, 4, 8, 10, 12, 30, 100] {
        for (away, surface) in [(1.0f64, 0), (1.5, 1), (2.0, 2)] {
            for ulps in -3..=3 {
                let stop = f64::from_bits(away.to_bits().wrapping_add_signed(ulps));
                let mut execution = line.run((), [0.0], 0.0);
                let mut seen = Vec::new();
                let stops = (1..=pieces).map(|k| stop * f64::from(k) / f64::from(pieces));
                for time in stops.chain([2.25]) {
                    for arc in execution.run_until(time) {
                        seen.extend(arc.unwrap().event().map(|event| event.surface));
                    }
                }
                assert_eq!(seen, [0, 1, 2], "surface {surface}, {ulps} ulps, {pieces} pieces");
            }
        }
    }
}

#[test]
fn higher_limits_continue_and_other_stops_stay() {
    let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
        .falling((), |x| x[0], |x| ((), [0.0, -x[1]]))
        .terminal((), Guard::rising(1), |x| -1.0 - x[0])
        .signal(0, |(), x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5])))
        .signal(1, |(), x| Some(QuasiPolynomial::polynomial(&[-1.0 - x[0], -x[1], 0.5])));
    let all: Vec<_> = Execution::new(&ball, (), Vector2::new(0.5, 0.0), Limits::new(100.0, 9))
        .collect::<Result<_, _>>()
        .unwrap();
    let mut execution = Execution::new(&ball, (), Vector2::new(0.5, 0.0), Limits::new(100.0, 4));
    let mut pieces: Vec<_> = execution.by_ref().collect::<Result<_, _>>().unwrap();
    assert_eq!((pieces.len(), execution.stop()), (4, Some(Stop::EventLimit)));
    pieces.extend(execution.go_on(Limits::new(100.0, 9)).map(|arc| arc.unwrap()));
    assert_eq!(pieces, all);
    let ends = Model::closed_form(|(), x: &State<1>, t| [x[0] + t])
        .terminal((), Guard::rising(0), |x| x[0] - 1.0)
        .sampled(0.1);
    let mut execution = ends.run((), [0.0], 5.0);
    assert_eq!(execution.by_ref().count(), 1);
    assert_eq!(execution.go_on(Limits::new(100.0, 9)).count(), 0);
    assert_eq!(execution.stop(), Some(Stop::Terminal));
}

/// Every number of a file in turn is replaced by other ones: the reader refuses the file, or the execution goes on
/// or ends with an error.
#[test]
fn a_damaged_checkpoint_does_not_panic() {
    let ball = Model::integrated(|(), x: &DVector<f64>| DVector::from_vec(vec![x[1], -1.0]))
        .falling((), |x| x[0], |x| ((), vec![0.0, -0.5 * x[1]]));
    let mut execution = ball.run((), vec![0.5, 0.0], 10.0);
    for _ in 0..5 {
        execution.next();
    }
    let text = serde_json::to_string(&execution.checkpoint()).unwrap();
    let numbers = |text: &str| {
        let starts = text.char_indices().filter(|(at, c)| {
            (c.is_ascii_digit() || *c == '-') && "[,:".contains(&text[at - 1..*at])
        });
        starts.map(|(at, _)| at).collect::<Vec<_>>()
    };
    let (mut refused, mut read) = (0, 0);
    for at in numbers(&text) {
        let end = at + text[at..].find([',', ']', '}']).unwrap();
        for other in ["0", "7", "-1.5", "1e308", "18446744073709551615", "-5e-324"] {
            let damaged = format!("{}{other}{}", &text[..at], &text[end..]);
            let Ok(checkpoint) = serde_json::from_str(&damaged) else {
                refused += 1;
                continue;
            };
            let limits = Limits { steps: 1000, ..Limits::new(10.0, usize::MAX) };
            let arcs = Execution::restore(&ball, checkpoint, limits).take(20);
            read += usize::from(arcs.count() <= 20);
        }
    }
    assert!(refused > 20 && read > 500, "{refused} {read}");
    // One of its states in turn has another dimension.
    let (mut places, mut at) = (Vec::new(), 0);
    while let Some(found) = text[at..].find(",2,null]") {
        places.push(at + found);
        at += found + 1;
    }
    assert!(places.len() >= 8, "{text}");
    for end in places {
        let begin = text[..end].rfind("[[").unwrap();
        let damaged = format!("{}[[1.5],1,null]{}", &text[..begin], &text[end + 8..]);
        let read = serde_json::from_str::<Checkpoint<(), usize, DVector<f64>>>(&damaged);
        assert!(read.unwrap_err().to_string().contains("is damaged"), "{damaged}");
    }
    // A state of another dimension than that of the model.
    let other = Model::integrated(|(), x: &DVector<f64>| DVector::from_vec(vec![x[1], -1.0, 0.0]))
        .falling((), |x| x[0], |x| ((), vec![0.0, -x[1], 0.0]));
    let checkpoint = serde_json::from_str(&text).unwrap();
    let first = Execution::restore(&other, checkpoint, Limits::new(10.0, 100)).next().unwrap();
    assert!(matches!(first, Err(Error::Dimension { expected: 2, found: 3, .. })), "{first:?}");
}

/// A run of equations goes on from its file with the same bits: with a clock, the time as a component, a function of the
/// user, and a dimension that is chosen at run time.
#[test]
fn a_run_of_equations_is_a_file() {
    let own = Function::new("cube", |x| x * x * x, |x| Some(x * x * x), |x, _| 3.0 * x * x);
    let own = own.unwrap();
    let model = Equations::new(&["x", "v"], &[("kick", "0.1")])
        .functions(std::slice::from_ref(&own))
        .mode_text("m", &["v", "cos(1.3*t) - cube(x)"])
        .rising_text("stop", "x - 0.5")
        .resets_text(&["x", "-0.8*v"])
        .clock_text("tick", "1", "1")
        .resets_text(&["x", "v + kick"])
        .model::<DVector<f64>>()
        .unwrap()
        .tolerance(1e-11);
    let start = || DVector::from_vec(vec![0.0, 1.0, 0.0]);
    let whole: Vec<_> =
        model.start("m", start(), 20.0).unwrap().map(|arc| format!("{arc:?}")).collect();
    let mut run = model.start("m", start(), 20.0).unwrap();
    assert!(whole.len() > 20);
    for done in 0..whole.len() {
        let text = run.saved().to_json().unwrap();
        let saved = SavedRun::<DVector<f64>>::from_json_with(&text, std::slice::from_ref(&own));
        let saved = saved.unwrap();
        let rest = saved.go_on(Limits::new(20.0, 1_000_000)).map(|arc| format!("{arc:?}"));
        assert!(rest.eq(whole[done..].iter().cloned()), "after {done} arcs");
        assert!(SavedRun::<DVector<f64>>::from_json(&text).is_err());
        assert!(SavedRun::<State<2>>::from_json_with(&text, std::slice::from_ref(&own)).is_err());
        run.next();
    }
    // A run goes on behind a limit.
    let mut run = model.start("m", start(), 5.5).unwrap();
    assert_eq!((run.by_ref().count() > 5, run.stop()), (true, Some(Stop::TimeLimit)));
    let saved = run.saved();
    let limits = Limits::new(20.0, 1_000_000);
    let rest = saved.go_on(limits).map(|arc| format!("{arc:?}"));
    assert!(rest.eq(run.go_on(limits).map(|arc| format!("{arc:?}"))));
    assert!(saved.go_on(limits).count() > 5);
    // What a program has set on the model is no part of the equations.
    let ball = || {
        let flight = Equations::new(&["x", "v"], &[]).mode_text("m", &["v", "-1"]);
        let ball = flight.falling_text("floor", "x").resets_text(&["x", "-v/2"]);
        ball.model::<State<2>>().unwrap()
    };
    assert!(ball().start("m", [1.0, 0.0], 1.0).unwrap().saved().to_json().is_ok());
    for changed in [ball().contact(), ball().sampled(0.1)] {
        let error = changed.start("m", [1.0, 0.0], 1.0).unwrap().saved().to_json().unwrap_err();
        assert!(error.to_string().contains("set it in the equations"), "{error}");
    }
    let each = Tolerances::both(1e-9).absolute_each(&[1e-9, 1e-9, 1e-9]);
    let model = model.tolerances(each);
    assert!(model.start("m", start(), 1.0).unwrap().saved().to_json().is_err());
}
