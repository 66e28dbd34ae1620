//! Infinitely many events in finite time, rest after them, and chains of events without time.
//!
//! A test with the name of another project has its known answer from that project's test suite or issues: SciML, and
//! the FMI reference FMUs. A number is that of the issue.

#![allow(clippy::excessive_precision)] // published digits, as they are printed

use hybrid_system::*;
use nalgebra::{Vector1, Vector2};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    Air,
    Resting,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Floor;

/// A ball over a floor. It comes to rest at the Zeno limit of its bounces, or at once if it does not bounce.
struct Ball {
    gravity: f64,
    floor: f64,
    restitution: f64,
}

impl HybridSystem for Ball {
    type State = State<2>;
    type Mode = Mode;
    type Surface = Floor;
    fn flow(&self, mode: Mode, x: &State<2>, t: f64) -> State<2> {
        match mode {
            Mode::Air => {
                Vector2::new(x[0] + t * (x[1] - 0.5 * self.gravity * t), x[1] - self.gravity * t)
            }
            Mode::Resting => *x,
        }
    }
    fn guards(&self, mode: Mode) -> &[Guard<Floor>] {
        match mode {
            Mode::Air => const { &[Guard::falling(Floor)] },
            Mode::Resting => &[],
        }
    }
    fn guard_value(&self, _: Floor, x: &State<2>) -> f64 {
        x[0] - self.floor
    }
    fn guard_quasi_polynomial(
        &self,
        _: Mode,
        floor: Floor,
        x: &State<2>,
    ) -> Option<QuasiPolynomial> {
        Some(QuasiPolynomial::polynomial(&[self.guard_value(floor, x), x[1], -0.5 * self.gravity]))
    }
    fn reset(&self, _: Mode, _: Floor, x: &State<2>) -> Reset<Mode, State<2>> {
        let speed = -self.restitution * x[1];
        let mode = if speed > 0.0 { Mode::Air } else { Mode::Resting };
        Reset::Jump { mode, state: Vector2::new(self.floor, speed) }
    }
    fn rest(&self, _: Mode, limit: &State<2>) -> Option<(Mode, State<2>)> {
        (limit[1].abs() < 1e-9).then_some((Mode::Resting, Vector2::new(self.floor, 0.0)))
    }
}

fn arcs(
    ball: &Ball,
    start: State<2>,
    time: f64,
) -> (Vec<Arc<Mode, Floor, State<2>>>, Option<Stop>) {
    let mut execution = Execution::new(ball, Mode::Air, start, Limits::new(time, 100_000));
    let arcs = execution.by_ref().collect::<Result<_, _>>().unwrap();
    (arcs, execution.stop())
}

#[test]
fn a_ball_of_restitution_one_half_rests_as_in_sciml_696() {
    let ball = Ball { gravity: 9.8, floor: -1.0, restitution: 0.5 };
    let (arcs, stop) = arcs(&ball, Vector2::new(0.0, 1.0), 100.0);
    let first = arcs[0].event().unwrap();
    assert!((first.time - 0.565_175_743_588_172_131).abs() < 1e-15);
    assert!((first.before[1] + 4.538_722_287_164_086_89).abs() < 1e-14);
    let ArcEnd::Zeno { limit, after } = arcs[arcs.len() - 2].end else { panic!() };
    assert!((limit.time - 1.491_445_598_111_455_17).abs() <= limit.time_error);
    assert!(limit.time_error < 1e-11 && (limit.ratio - 0.5).abs() < 1e-3 && limit.period == 1);
    assert!((limit.state - Vector2::new(-1.0, 0.0)).amax() <= limit.state_error);
    assert_eq!(after, Some((Mode::Resting, Vector2::new(-1.0, 0.0))));
    // The ball rests up to the limit on time. Other software lets it fall through the floor.
    let last = arcs.last().unwrap();
    assert_eq!((last.mode, stop), (Mode::Resting, Some(Stop::TimeLimit)));
    assert_eq!(last.state(&ball, last.duration).unwrap(), Vector2::new(-1.0, 0.0));
    assert!(arcs.len() < 60, "{}", arcs.len());
}

#[test]
fn a_ball_of_restitution_zero_rests_as_in_sciml_696() {
    let ball = Ball { gravity: 9.8, floor: -1.0, restitution: 0.0 };
    let (arcs, stop) = arcs(&ball, Vector2::new(0.0, 1.0), 1e6);
    assert_eq!((arcs.len(), stop), (2, Some(Stop::TimeLimit)));
    assert_eq!(arcs[1].state(&ball, 1e6).unwrap(), Vector2::new(-1.0, 0.0));
}

#[test]
fn the_fmi_reference_ball_rests_at_its_known_time() {
    let ball = Ball { gravity: 9.81, floor: 0.0, restitution: 0.7 };
    let (arcs, _) = arcs(&ball, Vector2::new(1.0, 0.0), 10.0);
    let ArcEnd::Zeno { limit, .. } = arcs[arcs.len() - 2].end else { panic!() };
    assert!((limit.time - 2.558_633_965_585_808_46).abs() <= limit.time_error);
    assert!(limit.time_error < 1e-11, "{limit:?}");
}

/// For every restitution e the limit is at t₁ (1+e)/(1−e), t₁ the time of the first landing.
#[test]
fn the_limit_of_every_restitution_is_at_its_exact_time() {
    for restitution in [0.01, 0.1, 0.3, 0.9, 0.99] {
        let ball = Ball { gravity: 2.0, floor: 0.0, restitution };
        let (arcs, _) = arcs(&ball, Vector2::new(1.0, 0.0), 1e4);
        let ArcEnd::Zeno { limit, .. } = arcs[arcs.len() - 2].end else { panic!() };
        let exact = (1.0 + restitution) / (1.0 - restitution);
        // The roundings of thousands of bounces are added to the limit's own error.
        let rounding = 1e-15 * arcs.len() as f64 * exact;
        assert!(
            (limit.time - exact).abs() <= limit.time_error + rounding,
            "{restitution}: {limit:?}"
        );
    }
    // The bounces of an elastic ball have no limit.
    let ball = Ball { gravity: 2.0, floor: 0.0, restitution: 1.0 };
    let (arcs, stop) = arcs(&ball, Vector2::new(1.0, 0.0), 1000.0);
    assert_eq!((arcs.len(), stop), (501, Some(Stop::TimeLimit)));
}

/// If the model gives no mode after the limit, the execution ends there, with that reason.
#[test]
fn a_zeno_limit_without_a_mode_after_it_ends_the_execution() {
    struct Restless(Ball, bool);
    impl HybridSystem for Restless {
        type State = State<2>;
        type Mode = Mode;
        type Surface = Floor;
        fn flow(&self, mode: Mode, x: &State<2>, t: f64) -> State<2> {
            self.0.flow(mode, x, t)
        }
        fn guards(&self, mode: Mode) -> &[Guard<Floor>] {
            self.0.guards(mode)
        }
        fn guard_value(&self, floor: Floor, x: &State<2>) -> f64 {
            self.0.guard_value(floor, x)
        }
        fn guard_quasi_polynomial(
            &self,
            mode: Mode,
            floor: Floor,
            x: &State<2>,
        ) -> Option<QuasiPolynomial> {
            self.1.then(|| self.0.guard_quasi_polynomial(mode, floor, x)).flatten()
        }
        fn reset(&self, mode: Mode, floor: Floor, x: &State<2>) -> Reset<Mode, State<2>> {
            self.0.reset(mode, floor, x)
        }
    }
    let system = Restless(Ball { gravity: 9.81, floor: 0.0, restitution: 0.5 }, false);
    // Sampled, with an interval far longer than the last bounces. They are found between two samples: the ball
    // neither falls through the floor nor stops early.
    let limits = Limits::sampled(10.0, 100_000, 1e-3);
    let mut execution = Execution::new(&system, Mode::Air, Vector2::new(1.0, 0.0), limits);
    let last = execution.by_ref().last().unwrap().unwrap();
    assert_eq!(execution.stop(), Some(Stop::Zeno));
    let ArcEnd::Zeno { limit, after: None } = last.end else { panic!() };
    assert!((limit.time - 3.0 * (2.0f64 / 9.81).sqrt()).abs() <= limit.time_error, "{limit:?}");
    assert!(limit.time_error < 1e-9, "{limit:?}");
    let system = Restless(Ball { gravity: 9.81, floor: 0.0, restitution: 0.5 }, true);
    let limits = Limits::new(10.0, 100_000);
    let mut execution = Execution::new(&system, Mode::Air, Vector2::new(1.0, 0.0), limits);
    let last = execution.by_ref().last().unwrap().unwrap();
    assert_eq!(execution.stop(), Some(Stop::Zeno));
    let ArcEnd::Zeno { limit, after: None } = last.end else { panic!() };
    assert!((limit.time - 3.0 * (2.0f64 / 9.81).sqrt()).abs() <= limit.time_error);
    // A limit on time before the Zeno limit is respected.
    let early = Limits::new(1.354_570_922, 100_000);
    let mut execution = Execution::new(&system, Mode::Air, Vector2::new(1.0, 0.0), early);
    let last = execution.by_ref().last().unwrap().unwrap();
    assert_eq!(execution.stop(), Some(Stop::TimeLimit));
    assert!(last.time + last.duration <= early.time);
}

/// At t = 10⁹ doubles are 10⁻⁷ apart. The last thousands of bounces do not change the time as a double, but time
/// passes.
#[test]
fn slow_accumulations_late_in_time_are_no_chains_without_time() {
    let ball = Ball { gravity: 2.0, floor: 0.0, restitution: 0.998 };
    let limits = Limits::new(1.1e9, 100_000);
    let start = Vector2::new(1.0, 0.0);
    let execution = Execution::new(&ball, Mode::Air, start, limits).starting_at(1e9);
    let arcs: Vec<_> = execution.collect::<Result<_, _>>().unwrap();
    let ArcEnd::Zeno { limit, .. } = arcs[arcs.len() - 2].end else { panic!() };
    // t₁ (1 + e)/(1 − e), t₁ = 1.
    let exact = 1.998 / 0.002;
    assert!((limit.time - 1e9 - exact).abs() <= limit.time_error + 1e-10, "{limit:?}");
    assert!(limit.time_error < 1e-6, "{limit:?}");
    let same = arcs.windows(2).filter(|pair| pair[0].time == pair[1].time).count();
    assert!(same > 1000, "{same}");
}

/// Resets that lead back to each other without time passing.
#[test]
fn endless_events_at_one_instant_are_an_error() {
    struct Circle;
    impl HybridSystem for Circle {
        type State = State<1>;
        type Mode = ();
        type Surface = ();
        fn flow(&self, _: (), x: &State<1>, t: f64) -> State<1> {
            Vector1::new(x[0] + t)
        }
        fn guards(&self, _: ()) -> &[Guard<()>] {
            const { &[Guard::rising(())] }
        }
        fn guard_value(&self, _: (), x: &State<1>) -> f64 {
            x[0]
        }
        fn reset(&self, _: (), _: (), x: &State<1>) -> Reset<(), State<1>> {
            Reset::Jump { mode: (), state: *x }
        }
        fn first_crossing(
            &self,
            _: (),
            start: &State<1>,
            _: &Search<()>,
        ) -> Result<NextEvent<(), State<1>>, Error> {
            Ok(NextEvent::Crossing(Crossing::exact((), 0.0, *start)))
        }
    }
    let limits = Limits::new(1.0, usize::MAX);
    let last = Execution::new(&Circle, (), Vector1::new(0.0), limits).last().unwrap();
    assert!(matches!(last, Err(Error::TimelessChain { events: 1001, .. })));
}

/// The ball lands at 1, 2, 5/2, …, with its limit at 3.
const TO_LIMIT: Ball = Ball { gravity: 1.0, floor: 0.0, restitution: 0.5 };

#[test]
fn a_limit_on_time_just_before_a_zeno_limit_moves_the_state_to_it() {
    for distance in [1e-3, 1e-9, 1e-11, 1e-12, 3e-13, 1e-13, 1e-14, 5e-16] {
        let time = 3.0 - distance;
        let mut execution =
            Execution::new(&TO_LIMIT, Mode::Air, Vector2::new(0.5, 0.0), Limits::new(time, 1000));
        let last = execution.by_ref().last().unwrap().unwrap();
        assert!(matches!(last.end, ArcEnd::TimeLimit { .. }), "{distance:e}: {last:?}");
        assert_eq!((execution.stop(), execution.time()), (Some(Stop::TimeLimit), time));
        assert_eq!(last.time + last.duration, time);
        // The ball is slower than the time that is left.
        let state = *execution.state();
        assert!(state.amax() <= 2.0 * distance + 1e-15, "{distance:e}: {state}");
        let last = execution.run_until(4.0).last().unwrap().unwrap();
        assert!(matches!(last.end, ArcEnd::Zeno { .. } | ArcEnd::TimeLimit { .. }), "{last:?}");
        assert!(execution.state().amax() < 1e-11, "{distance:e}: {}", execution.state());
    }
}

#[test]
fn a_zeno_limit_is_found_frame_by_frame() {
    for frames in [7, 30, 1000, 30_011] {
        let mut execution =
            Execution::new(&TO_LIMIT, Mode::Air, Vector2::new(0.5, 0.0), Limits::new(0.0, 1000));
        let mut limits = Vec::new();
        for frame in 1..=frames {
            for arc in execution.run_until(4.0 * f64::from(frame) / f64::from(frames)) {
                if let ArcEnd::Zeno { limit, .. } = arc.unwrap().end {
                    limits.push(limit);
                }
            }
        }
        assert_eq!(limits.len(), 1, "{frames}");
        let limit = &limits[0];
        assert!((limit.time - 3.0).abs() <= limit.time_error, "{frames}: {limit:?}");
        assert!(limit.time_error < 1e-11 && limit.period == 1, "{frames}: {limit:?}");
    }
}
