//! A scene of straight motions with guards of any form, searched in several ways.

#![allow(dead_code)] // each test file uses a part
#![allow(clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hybrid_system::*;

/// y₀, y₁, the time, and a flag that resets may set.
pub(crate) type X = State<4>;
pub(crate) const TIME: usize = 2;
pub(crate) const FLAG: usize = 3;

/// How the events are searched.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Searched {
    Integrated(f64),
    Sampled(f64),
}

pub(crate) const SEARCHES: [Searched; 4] = [
    Searched::Integrated(1e-7),
    Searched::Integrated(1e-3),
    Searched::Integrated(1e-12),
    Searched::Sampled(0.0625),
];

pub(crate) type Value = Box<dyn Fn(&X) -> f64>;
pub(crate) type Jump = Box<dyn Fn(&X) -> Option<X>>;

/// ẏ = (1, 2), with guards in the order of the list.
struct Scene {
    rates: X,
    guards: Vec<Guard<usize>>,
    values: Vec<Value>,
    resets: Vec<Jump>,
    observed: Vec<bool>,
    searched: Searched,
}

impl HybridSystem for Scene {
    type State = X;
    type Mode = ();
    type Surface = usize;

    fn flow(&self, (): (), start: &X, time: f64) -> X {
        start + self.rates * time
    }
    fn vector_field(&self, (): (), _: &X) -> Option<X> {
        Some(self.rates)
    }
    fn guards(&self, (): ()) -> &[Guard<usize>] {
        &self.guards
    }
    fn guard_value(&self, surface: usize, state: &X) -> f64 {
        self.values[surface](state)
    }
    fn reset(&self, (): (), surface: usize, before: &X) -> Reset<(), X> {
        match self.resets[surface](before) {
            Some(state) => Reset::Jump { mode: (), state },
            None => Reset::Stop,
        }
    }
    fn observes(&self, surface: usize) -> bool {
        self.observed[surface]
    }
    fn first_crossing(
        &self,
        mode: (),
        start: &X,
        search: &Search<usize>,
    ) -> Result<NextEvent<usize, X>, Error> {
        match self.searched {
            Searched::Integrated(tolerance) => {
                integrated_crossing(self, mode, start, search, Tolerances::both(tolerance))
            }
            Searched::Sampled(_) => default_search(self, mode, start, search),
        }
    }
}

/// A guard of a scene: it watches both directions, unless the tuple gives another guard.
pub(crate) struct Watched {
    pub(crate) guard: fn(usize) -> Guard<usize>,
    pub(crate) value: Value,
    pub(crate) reset: Jump,
    pub(crate) observes: bool,
}

pub(crate) fn watch(value: impl Fn(&X) -> f64 + 'static) -> Watched {
    Watched { observes: true, ..resetting(value, |x| Some(*x)) }
}

pub(crate) fn stopping(value: impl Fn(&X) -> f64 + 'static) -> Watched {
    resetting(value, |_| None)
}

pub(crate) fn resetting(
    value: impl Fn(&X) -> f64 + 'static,
    reset: impl Fn(&X) -> Option<X> + 'static,
) -> Watched {
    let guard = |surface| Guard::either(surface).crossing();
    Watched { guard, value: Box::new(value), reset: Box::new(reset), observes: false }
}

/// t − e.
pub(crate) fn at(e: f64) -> impl Fn(&X) -> f64 {
    move |x| x[TIME] - e
}

/// Pieces of slope ±1 that begin at zero: negative before the first time, and of alternating sign behind each.
pub(crate) fn saw(times: &'static [f64]) -> impl Fn(&X) -> f64 {
    move |x| {
        let t = x[TIME];
        let piece = times.iter().skip(1).rposition(|e| t > *e).map_or(0, |k| k + 1);
        let sign = if piece % 2 == 0 { 1.0 } else { -1.0 };
        sign * (t - times[piece])
    }
}

/// The signs of [`saw`].
pub(crate) fn flat(times: &'static [f64]) -> impl Fn(&X) -> f64 {
    let saw = saw(times);
    move |x| match saw(x) {
        0.0 => 0.0,
        value => value.signum(),
    }
}

/// A continuous guard with the same signs: parabolas between the times, straight lines outside.
pub(crate) fn bent(times: &'static [f64]) -> impl Fn(&X) -> f64 {
    move |x| {
        let (t, last) = (x[TIME], times.len() - 1);
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        if t <= times[0] {
            return t - times[0];
        }
        match times.iter().position(|e| t <= *e) {
            Some(k) => sign(k - 1) * (t - times[k - 1]) * (times[k] - t),
            None => sign(last) * (t - times[last]),
        }
    }
}

fn scene(searched: Searched, guards: Vec<Watched>) -> Scene {
    let mut scene = Scene {
        rates: X::from([1.0, 2.0, 1.0, 0.0]),
        guards: Vec::new(),
        values: Vec::new(),
        resets: Vec::new(),
        observed: Vec::new(),
        searched,
    };
    for (surface, Watched { guard, value, reset, observes }) in guards.into_iter().enumerate() {
        scene.observed.push(observes);
        scene.guards.push(guard(surface));
        scene.values.push(value);
        scene.resets.push(reset);
    }
    scene
}

/// The state with time and motion backward.
fn mirrored(x: &X) -> X {
    X::new(-x[0], -x[1], -x[TIME], x[FLAG])
}

/// The same scene backward in time: its guards and resets at −t.
fn backward(guards: Vec<Watched>) -> Vec<Watched> {
    let turn = |Watched { guard, value, reset, observes }: Watched| Watched {
        guard,
        observes,
        value: Box::new(move |x: &X| value(&mirrored(x))),
        reset: Box::new(move |x: &X| Some(mirrored(&reset(&mirrored(x))?))),
    };
    guards.into_iter().map(turn).collect()
}

/// The events of a scene backward, with the limit and the times as durations.
fn run_backward(end: f64, searched: Searched, guards: Vec<Watched>) -> Vec<(usize, f64)> {
    let mut scene = scene(searched, backward(guards));
    scene.rates = mirrored(&scene.rates);
    let limits = match searched {
        Searched::Sampled(interval) => Limits::sampled(end, 1000, interval),
        Searched::Integrated(_) => Limits::new(end, 1000),
    };
    let run = Execution::new(&scene, (), X::zeros(), limits);
    let arcs = run.map(|arc| arc.unwrap_or_else(|error| panic!("{searched:?}: {error}")));
    arcs.filter_map(|arc| arc.event().map(|event| (event.surface, event.time))).collect()
}

/// The events of a scene that only watches, from its end back to its start, with the times forward.
fn run_back(end: f64, tolerance: f64, guards: Vec<Watched>) -> Vec<(usize, f64)> {
    let scene = scene(Searched::Integrated(tolerance), guards);
    let last = scene.flow((), &X::zeros(), end);
    let back = Backward::new(&scene, Tolerances::both(tolerance));
    let run = back.run((), last, (end, 0.0));
    // A guard that is zero at the start comes back to it, and stays: an error at the end.
    let goes_on = |arc: &Result<_, Error>| !matches!(arc, Err(Error::Grazing { .. }));
    let arcs = run.take_while(goes_on).map(|arc| arc.unwrap_or_else(|error| panic!("{error}")));
    let events = arcs.filter_map(|arc| {
        let event = *arc.event()?;
        let BackwardSurface::Model(surface) = event.surface else { panic!("{event:?}") };
        Some((surface, -event.time))
    });
    let mut events: Vec<_> = events.collect();
    events.reverse();
    events
}

/// The events up to `end` from a start at time 0: surfaces and times, with the last state and the reason of the end.
pub(crate) fn run(
    start: [f64; 4],
    end: f64,
    searched: Searched,
    guards: Vec<Watched>,
) -> (Vec<(usize, f64)>, X, Option<Stop>) {
    let scene = scene(searched, guards);
    let mut limits = Limits::new(end, 1000);
    if let Searched::Sampled(interval) = searched {
        limits = Limits::sampled(end, 1000, interval);
    }
    let mut execution = Execution::new(&scene, (), X::from(start), limits).starting_at(start[TIME]);
    let (mut events, mut last) = (Vec::new(), X::from(start));
    for arc in execution.by_ref() {
        let arc = arc.unwrap_or_else(|error| panic!("{searched:?}: {error}"));
        last = scene.flow((), &arc.start, arc.duration);
        let Some(event) = arc.event() else { continue };
        assert!(event.time_rounding <= event.time_error, "{searched:?}: {event:?}");
        // A few ulps of time, also where the guard jumps, and whatever the tolerance.
        assert!(event.time_rounding <= 64.0 * f64::EPSILON * event.time, "{searched:?}: {event:?}");
        events.push((event.surface, event.time));
        last = event.before;
    }
    (events, last, execution.stop())
}

/// Two ulps of a time.
pub(crate) fn is_at(time: f64, exact: f64) -> bool {
    is_within(2, time, exact)
}

pub(crate) fn is_within(ulps: usize, time: f64, exact: f64) -> bool {
    (time - exact).abs() <= ulps as f64 * f64::EPSILON * exact
}

#[track_caller]
pub(crate) fn assert_events(found: &[(usize, f64)], expected: &[(usize, f64)], searched: Searched) {
    // Two ulps for each arc: the time of an event is a sum of durations, each of them rounded.
    let right = found.len() == expected.len()
        && found
            .iter()
            .zip(expected)
            .enumerate()
            .all(|(k, (a, b))| a.0 == b.0 && is_within(2 * (k + 1), a.1, b.1));
    assert!(right, "{searched:?}: {found:?} instead of {expected:?}");
}

#[track_caller]
pub(crate) fn expect(end: f64, guards: impl Fn() -> Vec<Watched>, expected: &[(usize, f64)]) {
    for searched in SEARCHES {
        let (found, last, stop) = run([0.0; 4], end, searched, guards());
        assert_events(&found, expected, searched);
        // A scene that only watches comes back through the same events.
        let passed = scene(searched, guards()).flow((), &X::zeros(), end);
        if let (Searched::Integrated(tolerance), Some(Stop::TimeLimit)) = (searched, stop)
            && (last - passed).norm() < 1e-9
            && scene(searched, guards()).observed.iter().all(|observes| *observes)
        {
            let sorted = |events: &[(usize, f64)]| {
                let mut events: Vec<_> =
                    events.iter().map(|(surface, time)| ((time * 1e9).round(), *surface)).collect();
                events.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                events
            };
            let back = run_back(end, tolerance, guards());
            assert_eq!(sorted(&back), sorted(expected), "{tolerance}");
        }
        assert_events(&run_backward(end, searched, guards()), expected, searched);
    }
}

/// The events of a run that stops at a time and goes on.
pub(crate) fn run_with_stop(
    stop: f64,
    end: f64,
    searched: Searched,
    guards: Vec<Watched>,
) -> Vec<(usize, f64)> {
    let scene = scene(searched, guards);
    let limits = |end: f64| match searched {
        Searched::Sampled(interval) => Limits::sampled(end, 1000, interval),
        Searched::Integrated(_) => Limits::new(end, 1000),
    };
    let mut execution = Execution::new(&scene, (), X::from([0.0; 4]), limits(stop));
    let mut events = Vec::new();
    for limit in [stop, end] {
        for arc in execution.go_on(limits(limit)) {
            let arc = arc.unwrap_or_else(|error| panic!("{searched:?}: {error}"));
            events.extend(arc.event().map(|event| (event.surface, event.time)));
        }
    }
    events
}
