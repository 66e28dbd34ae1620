//! An event within its error of the limit on time is flagged as lying on it, whatever finds it.
//!
//! The ball of DiffEqGPU.jl, issue 540: height 45, gravity 10, no loss. It lands exactly at 3, 9 and 15, and the
//! end time is 15.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::Vector2;

#[derive(Debug, Clone, Copy)]
enum Means {
    Exact,
    QuasiPolynomial,
    Enclosures,
    Samples,
    Integrated(f64),
}

struct Ball(Means);

impl HybridSystem for Ball {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
        match self.0 {
            Means::Integrated(tolerance) => {
                integrated_flow(self, (), x, t, Tolerances::both(tolerance))
            }
            _ => Vector2::new(x[0] + t * (x[1] - 5.0 * t), x[1] - 10.0 * t),
        }
    }
    fn vector_field(&self, _: (), x: &State<2>) -> Option<State<2>> {
        Some(Vector2::new(x[1], -10.0))
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: Vector2::new(0.0, -x[1]) }
    }
    fn guard_quasi_polynomial(&self, _: (), _: (), x: &State<2>) -> Option<QuasiPolynomial> {
        matches!(self.0, Means::QuasiPolynomial)
            .then(|| QuasiPolynomial::polynomial(&[x[0], x[1], -5.0]))
    }
    fn guard_enclosure(
        &self,
        _: (),
        _: (),
        x: &State<2>,
        order: u32,
        (from, to): (f64, f64),
    ) -> Option<Enclosure> {
        if !matches!(self.0, Means::Enclosures) {
            return None;
        }
        // A parabola with its vertex at v/10.
        let height = |t: f64| x[0] + t * (x[1] - 5.0 * t);
        let speed = |t: f64| x[1] - 10.0 * t;
        let top = height((x[1] / 10.0).clamp(from, to));
        let rounding = 1e-15 * (x[0].abs() + to * (x[1].abs() + 5.0 * to));
        match order {
            0 => Some(Enclosure::new(height(from).min(height(to)) - rounding, top + rounding)),
            1 => Some(Enclosure::new(speed(to) - 1e-13, speed(from) + 1e-13)),
            2 => Some(Enclosure::new(-10.0, -10.0)),
            _ => Some(Enclosure::new(0.0, 0.0)),
        }
    }
    fn first_crossing(
        &self,
        mode: (),
        start: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        match self.0 {
            Means::Exact => {
                // v² + 20 y is a square here.
                let speed = (start[1] * start[1] + 20.0 * start[0]).sqrt();
                let state = Vector2::new(0.0, -speed);
                let landing = Crossing::exact((), (start[1] + speed) / 10.0, state);
                Ok(Some(landing).filter(|landing| landing.time <= search.horizon).into())
            }
            Means::Integrated(tolerance) => {
                integrated_crossing(self, mode, start, search, Tolerances::both(tolerance))
            }
            _ => default_search(self, mode, start, search),
        }
    }
}

fn landings(means: Means, end: f64) -> (Vec<Event<(), (), State<2>>>, Option<Stop>) {
    let limits = match means {
        Means::Samples => Limits::sampled(end, 100, 0.01),
        _ => Limits::new(end, 100),
    };
    let ball = Ball(means);
    let mut execution = Execution::new(&ball, (), Vector2::new(45.0, 0.0), limits);
    let events = execution.by_ref().filter_map(|arc| arc.unwrap().event().copied()).collect();
    (events, execution.stop())
}

const ALL_MEANS: [Means; 9] = [
    Means::Exact,
    Means::QuasiPolynomial,
    Means::Enclosures,
    Means::Samples,
    Means::Integrated(1e-3),
    Means::Integrated(1e-5),
    Means::Integrated(1e-8),
    Means::Integrated(1e-10),
    Means::Integrated(1e-12),
];

#[test]
fn a_landing_at_the_end_is_flagged_by_all_means() {
    for means in ALL_MEANS {
        for (count, end) in [(1, 3.0), (2, 9.0), (3, 15.0)] {
            let (events, stop) = landings(means, end);
            assert_eq!(stop, Some(Stop::TimeLimit), "{means:?} {events:?}");
            // The computed landing of an integrated flow may come just after the limit. Then it is no event, and a
            // run that goes on until the stated error has passed has it. Its last step is another one.
            let (events, end) = match means {
                Means::Integrated(_) if events.len() + 1 == count => {
                    let (events, _) = landings(means, end + 0.05);
                    let late = events[count - 1];
                    let error = 10.0 * count as f64 * late.time_error;
                    assert!((late.time - end).abs() <= error, "{means:?} {late:?}");
                    assert!(late.time_error < 0.01, "{means:?} {late:?}");
                    (events, f64::NAN)
                }
                _ => (events, end),
            };
            assert_eq!(events.len(), count, "{means:?} {events:?}");
            for (event, exact) in events.iter().zip([3.0, 9.0, 15.0]) {
                let accumulated = 10.0 * event.time_error * count as f64 + 1e-13;
                assert!((event.time - exact).abs() <= accumulated, "{means:?} {event:?}");
                assert_eq!(event.at_time_limit, exact == end, "{means:?} {event:?}");
            }
            // Both states at the event are reported.
            let last = events[count - 1];
            let after = last.after.unwrap().1;
            assert!((last.before[1] + 30.0).abs() < 0.1 && (after[1] - 30.0).abs() < 0.1);
        }
    }
}

#[test]
fn a_landing_away_from_the_end_is_not_flagged() {
    for means in ALL_MEANS {
        for (count, end) in [(2, 14.9), (3, 15.1)] {
            let (events, _) = landings(means, end);
            assert_eq!(events.len(), count, "{means:?}");
            assert!(events.iter().all(|event| !event.at_time_limit), "{means:?} {events:?}");
        }
    }
}

/// A ball that has an event exactly at the limit on time: the low digits of the time leave no interval to search.
#[test]
fn an_observed_event_at_the_limit_ends_the_execution_without_an_error() {
    let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
        .falling((), |x| x[0], |x| ((), [0.0, -x[1]]))
        .observer(Guard::either(1), |x| x[0] - 0.125)
        .observer(Guard::falling(2), |x| x[1])
        .sampled(0.07);
    // From ½ it lands after 1, 3, 5 …, and is at the top after 2, 4, 6 …
    let mut execution = ball.run((), [0.5, 0.0], 4.0);
    let events: Vec<_> =
        execution.by_ref().filter_map(|arc| arc.unwrap().event().copied()).collect();
    let last = events.last().unwrap();
    assert_eq!((last.surface, last.time, last.at_time_limit), (2, 4.0, true));
    assert_eq!(execution.stop(), Some(Stop::TimeLimit));
}

/// Going on with such a budget would never end.
#[test]
fn a_budget_that_allows_no_progress_is_an_error() {
    let swing = Model::integrated(|(), x: &State<2>| [x[1], -x[0]]).falling(
        (),
        |x| x[0] - 0.5,
        |x| ((), [x[0], -x[1]]),
    );
    let start = State::from([1.0, 0.0]);
    for (intervals, steps) in [(0, usize::MAX), (usize::MAX, 0)] {
        let limits = Limits { intervals, steps, ..Limits::new(9.0, 50) };
        let first = Execution::new(&swing, (), start, limits).next().unwrap();
        assert_eq!(first, Err(Error::BudgetTooSmall { horizon: 9.0, intervals, steps }));
    }
    // With one step at a time the execution gets to its end, with the same events.
    let limits = Limits { intervals: 1, steps: 1, ..Limits::new(9.0, 50) };
    let mut execution = Execution::new(&swing, (), start, limits);
    let mut times = Vec::new();
    while execution.stop().is_none_or(|stop| stop == Stop::Unfinished) {
        let arcs = execution.go_on(limits).map(|arc| arc.unwrap());
        times.extend(arcs.filter_map(|arc| arc.event().map(|event| event.time)));
    }
    assert_eq!(execution.stop(), Some(Stop::TimeLimit));
    let whole = swing.run((), start, 9.0).map(|arc| arc.unwrap());
    let whole: Vec<f64> = whole.filter_map(|arc| arc.event().map(|event| event.time)).collect();
    assert_eq!(times.len(), whole.len());
    // The steps differ, and with them the errors of the flow, which has the tolerance 1e-10.
    assert!(times.iter().zip(&whole).all(|(one, other)| (one - other).abs() < 1e-9));
}
