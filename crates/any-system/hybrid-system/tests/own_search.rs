//! Models that solve for their own crossings: what the execution checks, and the default search inside an override.

use hybrid_system::*;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    Floor,
    Wall,
}
use Surface::{Floor, Wall};

/// What the model's own search returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Own {
    /// The first landing or the wall.
    Complete,
    /// The wall only.
    NoFloor,
    /// No event at all.
    Nothing,
    /// The wall, with the certainty of the default search.
    Default,
}

/// A ball (x, y, ẋ, ẏ) under unit gravity over the floor y = 0, in front of a wall at x = 1.
struct Ball(Own);

impl HybridSystem for Ball {
    type State = State<4>;
    type Mode = ();
    type Surface = Surface;
    fn flow(&self, (): (), x: &State<4>, t: f64) -> State<4> {
        State::from([x[0] + t * x[2], x[1] + t * (x[3] - t / 2.0), x[2], x[3] - t])
    }
    fn guards(&self, (): ()) -> &[Guard<Surface>] {
        const { &[Guard::falling(Floor), Guard::rising(Wall)] }
    }
    fn guard_value(&self, surface: Surface, x: &State<4>) -> f64 {
        match surface {
            Floor => x[1],
            Wall => x[0] - 1.0,
        }
    }
    fn guard_quasi_polynomial(
        &self,
        (): (),
        surface: Surface,
        x: &State<4>,
    ) -> Option<QuasiPolynomial> {
        Some(match surface {
            Floor => QuasiPolynomial::polynomial(&[x[1], x[3], -0.5]),
            Wall => QuasiPolynomial::polynomial(&[x[0] - 1.0, x[2]]),
        })
    }
    fn reset(&self, (): (), surface: Surface, x: &State<4>) -> Reset<(), State<4>> {
        let state = match surface {
            Floor => State::from([x[0], 0.0, x[2], -x[3]]),
            Wall => State::from([1.0, x[1], -x[2], x[3]]),
        };
        Reset::Jump { mode: (), state }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<4>,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State<4>>, Error> {
        if self.0 == Own::Default {
            return default_search(self, mode, x, search);
        }
        let at = |surface, time: f64| {
            let there = time > 0.0 && time <= search.horizon;
            there.then(|| Crossing::exact(surface, time, self.flow((), x, time)))
        };
        let floor = at(Floor, x[3] + (x[3] * x[3] + 2.0 * x[1]).sqrt());
        let wall = at(Wall, (1.0 - x[0]) / x[2]);
        let events = [floor.filter(|_| self.0 == Own::Complete), wall];
        let events = events.into_iter().flatten().filter(|_| self.0 != Own::Nothing);
        Ok(events.min_by(|a, b| a.time.total_cmp(&b.time)).into())
    }
}

type Events = Vec<(Surface, f64, Certainty)>;

fn events(own: Own, start: [f64; 4], end: f64) -> Result<Events, Error> {
    let ball = Ball(own);
    let execution = Execution::new(&ball, (), State::from(start), Limits::new(end, 50));
    let arcs = execution.collect::<Result<Vec<_>, _>>()?;
    let event = |arc: &Arc<(), Surface, State<4>>| {
        arc.event().map(|event| (event.surface, event.time, event.certainty))
    };
    Ok(arcs.iter().filter_map(event).collect())
}

#[test]
fn models_that_override_the_search_are_checked_as_well() {
    // Dropped from ½ it lands after 1, 3, 5 …, and meets the wall after 2.
    let start = [0.0, 0.5, 0.5, 0.0];
    let right: Events = vec![(Floor, 1.0), (Wall, 2.0), (Floor, 3.0)]
        .into_iter()
        .map(|(surface, time)| (surface, time, Certainty::Exact))
        .collect();
    assert_eq!(events(Own::Complete, start, 3.5).unwrap(), right);
    // Started below the floor, whatever the model's own search finds.
    let below = [0.0, -0.25, 0.5, 0.0];
    for own in [Own::Complete, Own::NoFloor, Own::Nothing, Own::Default] {
        let error = events(own, below, 3.5).unwrap_err();
        let Error::StartsBeyond { surface, value, .. } = &error else { panic!("{own:?}: {error}") };
        assert_eq!((surface.as_str(), *value), ("Floor", -0.25));
    }
    // Through the floor at 1: at the wall, after 2, it is at y = ½ − 2.
    let error = events(Own::NoFloor, start, 3.5).unwrap_err();
    let Error::MissedEvent { surface, duration, value, .. } = &error else { panic!("{error}") };
    assert_eq!((surface.as_str(), *duration, *value), ("Floor", 2.0, -1.5));
    assert!(error.to_string().contains("default_search"), "{error}");
    // The same at the limit on time, after 1.5: ½ − 9/8.
    for own in [Own::NoFloor, Own::Nothing] {
        let error = events(own, start, 1.5).unwrap_err();
        let Error::MissedEvent { duration, value, .. } = error else { panic!("{error}") };
        assert_eq!((duration, value), (1.5, -0.625));
    }
    // The default search and limits next to a landing give no such error.
    for end in [1.0f64.next_down(), 1.0, 1.0f64.next_up(), 3.0f64.next_down(), 3.5] {
        for own in [Own::Complete, Own::Default] {
            let found = events(own, start, end);
            assert!(found.is_ok(), "{own:?} {end}: {found:?}");
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    /// Falling with a constant speed: the model solves for the landing.
    Falling,
    /// On a spring at x = 0: the guard is a sum of sines.
    OnSpring,
}
use Mode::{Falling, OnSpring};

/// A body that falls onto a spring and is thrown back up to x = 1, where it falls again. State: (x, ẋ).
struct Thrown;

impl HybridSystem for Thrown {
    type State = State<2>;
    type Mode = Mode;
    type Surface = Mode;
    fn flow(&self, mode: Mode, x: &State<2>, t: f64) -> State<2> {
        match mode {
            Falling => State::from([x[0] + t * x[1], x[1]]),
            OnSpring => {
                State::from([x[0] * t.cos() + x[1] * t.sin(), x[1] * t.cos() - x[0] * t.sin()])
            }
        }
    }
    fn guards(&self, mode: Mode) -> &[Guard<Mode>] {
        match mode {
            Falling => const { &[Guard::falling(Falling)] },
            OnSpring => const { &[Guard::rising(OnSpring)] },
        }
    }
    fn guard_value(&self, surface: Mode, x: &State<2>) -> f64 {
        if surface == Falling { x[0] } else { x[0] - 1.0 }
    }
    fn guard_quasi_polynomial(
        &self,
        _: Mode,
        surface: Mode,
        x: &State<2>,
    ) -> Option<QuasiPolynomial> {
        let oscillation = QuasiPolynomial::cosine(x[0], 1.0) + QuasiPolynomial::sine(x[1], 1.0);
        (surface == OnSpring).then(|| oscillation - QuasiPolynomial::polynomial(&[1.0]))
    }
    fn reset(&self, mode: Mode, _: Mode, x: &State<2>) -> Reset<Mode, State<2>> {
        let (mode, state) = match mode {
            Falling => (OnSpring, *x),
            OnSpring => (Falling, State::from([1.0, -2.0])),
        };
        Reset::Jump { mode, state }
    }
    fn vector_field(&self, mode: Mode, x: &State<2>) -> Option<State<2>> {
        Some(if mode == Falling { State::from([x[1], 0.0]) } else { State::from([x[1], -x[0]]) })
    }
    fn first_crossing(
        &self,
        mode: Mode,
        x: &State<2>,
        search: &Search<Mode>,
    ) -> Result<NextEvent<Mode, State<2>>, Error> {
        if mode == OnSpring {
            return default_search(self, mode, x, search);
        }
        let landing = Crossing::exact(Falling, -x[0] / x[1], State::from([0.0, x[1]]));
        Ok(Some(landing).filter(|landing| landing.time <= search.horizon).into())
    }
}

#[test]
fn the_search_can_be_called_from_an_override() {
    let start = State::from([1.0, -2.0]);
    let limits = Limits::new(20.0, 7);
    let arcs: Vec<_> =
        Execution::new(&Thrown, Falling, start, limits).collect::<Result<_, _>>().unwrap();
    assert_eq!(arcs.len(), 7);
    // It falls for ½. On the spring x = −2 sin t, which reaches 1 after 7π/6.
    let on_spring = 7.0 * std::f64::consts::PI / 6.0;
    for (number, arc) in arcs.iter().enumerate() {
        let event = arc.event().unwrap();
        let (mode, duration, certainty) = match number % 2 {
            0 => (Falling, 0.5, Certainty::Exact),
            _ => (OnSpring, on_spring, Certainty::Certain),
        };
        assert_eq!((arc.mode, event.certainty), (mode, certainty));
        assert!((arc.duration - duration).abs() < 1e-14, "{}", arc.duration);
    }
}

/// x = t with observers of levels, whose crossings the model solves for.
struct Levels {
    levels: Vec<f64>,
    guards: Vec<Guard<usize>>,
}

impl HybridSystem for Levels {
    type State = State<1>;
    type Mode = ();
    type Surface = usize;
    fn flow(&self, (): (), x: &State<1>, t: f64) -> State<1> {
        State::from([x[0] + t])
    }
    fn vector_field(&self, (): (), _: &State<1>) -> Option<State<1>> {
        Some(State::from([1.0]))
    }
    fn guards(&self, (): ()) -> &[Guard<usize>] {
        &self.guards
    }
    fn guard_value(&self, level: usize, x: &State<1>) -> f64 {
        x[0] - self.levels[level]
    }
    fn reset(&self, (): (), _: usize, x: &State<1>) -> Reset<(), State<1>> {
        Reset::Jump { mode: (), state: *x }
    }
    fn first_crossing(
        &self,
        (): (),
        x: &State<1>,
        search: &Search<usize>,
    ) -> Result<NextEvent<usize, State<1>>, Error> {
        let levels = (0..self.levels.len()).filter(|level| search.side(*level).is_none());
        let times = levels.map(|level| (self.levels[level] - x[0], level));
        let ahead = times.filter(|(time, _)| *time > 0.0 && *time <= search.horizon);
        let first = ahead.min_by(|a, b| a.0.total_cmp(&b.0));
        let at = |(time, level): (f64, usize)| {
            Crossing::exact(level, time, State::from([self.levels[level]]))
        };
        Ok(first.map(at).into())
    }
}

/// Levels some ulps apart, and a stop some ulps before the first: each is met once.
#[test]
fn levels_that_a_model_solves_for_are_met_once_within_ulps() {
    let ulp = f64::EPSILON / 2.0;
    for (second, third) in [(0, 0), (1, 2), (4, 5), (8, 10), (3, 15), (12, 13)] {
        for before in [0, 1, 2, 4, 8, 64] {
            let levels: Vec<f64> =
                [0, second, third].iter().map(|k| 0.5 + f64::from(*k) * ulp).collect();
            let guards = (0..3).map(|level| Guard::rising(level).crossing()).collect();
            let system = Levels { levels, guards };
            let stop = 0.5 - f64::from(before) * ulp;
            let mut execution =
                Execution::new(&system, (), State::from([0.0]), Limits::new(stop, 100));
            let mut met = Vec::new();
            for stop in [stop, 1.0] {
                let arcs = execution.run_until(stop).map(|arc| arc.unwrap());
                met.extend(arcs.filter_map(|arc| arc.event().map(|event| event.surface)));
            }
            assert_eq!(met, [0, 1, 2], "{second} {third} {before}");
        }
    }
}
