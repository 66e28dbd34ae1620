//! Sliding is recognised from the rates on both sides of a surface: typed ends of arcs.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::Vector1;

const TIGHT: Tolerances = Tolerances::both(1e-12);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    Above,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Zero {
    Rising,
    Falling,
}

/// From where the rates come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Source {
    QuasiPolynomial,
    Enclosure,
    Field,
    Integrated,
    None,
}

/// A relay: ẋ = −sgn x + 0.3, with one or two names for the surface x = 0.
struct Relay {
    source: Source,
    snap: bool,
    /// The surface of the mode above has a name of its own, and the guard −x.
    reversed: bool,
    rates: (f64, f64),
}

impl Relay {
    fn new(source: Source, snap: bool) -> Self {
        Relay { source, snap, reversed: false, rates: (1.3, -0.7) }
    }
    fn rate(&self, side: Side) -> f64 {
        if side == Side::Below { self.rates.0 } else { self.rates.1 }
    }
}

const REVERSED: &[Guard<Zero>] = &[Guard::rising(Zero::Falling)];

impl HybridSystem for Relay {
    type State = State<1>;
    type Mode = Side;
    type Surface = Zero;
    fn flow(&self, side: Side, x: &State<1>, t: f64) -> State<1> {
        if self.source == Source::Integrated {
            return integrated_flow(self, side, x, t, TIGHT);
        }
        x + Vector1::new(self.rate(side) * t)
    }
    fn guards(&self, side: Side) -> &[Guard<Zero>] {
        match side {
            Side::Below => const { &[Guard::rising(Zero::Rising)] },
            Side::Above if self.reversed => REVERSED,
            Side::Above => const { &[Guard::falling(Zero::Rising)] },
        }
    }
    fn guard_value(&self, surface: Zero, x: &State<1>) -> f64 {
        if surface == Zero::Rising { x[0] } else { -3.0 * x[0] }
    }
    fn reset(&self, side: Side, _: Zero, x: &State<1>) -> Reset<Side, State<1>> {
        let mode = if side == Side::Below { Side::Above } else { Side::Below };
        Reset::Jump { mode, state: if self.snap { Vector1::zeros() } else { *x } }
    }
    fn vector_field(&self, side: Side, _: &State<1>) -> Option<State<1>> {
        let known = matches!(self.source, Source::Field | Source::Integrated);
        known.then(|| Vector1::new(self.rate(side)))
    }
    fn guard_quasi_polynomial(
        &self,
        side: Side,
        surface: Zero,
        x: &State<1>,
    ) -> Option<QuasiPolynomial> {
        let factor = self.guard_value(surface, &Vector1::new(1.0));
        (self.source == Source::QuasiPolynomial)
            .then(|| QuasiPolynomial::polynomial(&[factor * x[0], factor * self.rate(side)]))
    }
    fn guard_enclosure(
        &self,
        side: Side,
        surface: Zero,
        x: &State<1>,
        order: u32,
        (from, to): (f64, f64),
    ) -> Option<Enclosure> {
        let factor = self.guard_value(surface, &Vector1::new(1.0));
        let rate = self.rate(side);
        let value = |t: f64| factor * (x[0] + rate * t);
        let ends = (value(from), value(to));
        (self.source == Source::Enclosure).then(|| match order {
            0 => Enclosure::new(ends.0.min(ends.1) - 1e-15, ends.0.max(ends.1) + 1e-15),
            1 => Enclosure::around(factor * rate, 1e-15),
            _ => Enclosure::new(0.0, 0.0),
        })
    }
    fn first_crossing(
        &self,
        side: Side,
        x: &State<1>,
        search: &Search<Zero>,
    ) -> Result<NextEvent<Zero, State<1>>, Error> {
        if self.source == Source::Integrated {
            return integrated_crossing(self, side, x, search, TIGHT);
        }
        default_search(self, side, x, search)
    }
}

type Arcs<T> =
    Vec<Arc<<T as HybridSystem>::Mode, <T as HybridSystem>::Surface, <T as HybridSystem>::State>>;

/// All arcs, and why the execution stopped.
fn run<T: HybridSystem>(
    system: &T,
    mode: T::Mode,
    start: T::State,
    limits: Limits,
) -> Result<(Arcs<T>, Option<Stop>), Error> {
    let mut execution = Execution::new(system, mode, start, limits);
    let mut arcs = Vec::new();
    for arc in execution.by_ref() {
        arcs.push(arc?);
    }
    Ok((arcs, execution.stop()))
}

/// The sliding point at which the last arc ends.
fn sliding_of<M: Copy, S: Copy, X: Clone>(arcs: &[Arc<M, S, X>]) -> Sliding<M, S, X> {
    match &arcs.last().unwrap().end {
        ArcEnd::Sliding { sliding, after: None } => sliding.clone(),
        _ => panic!("no sliding"),
    }
}

const LIMITS: Limits = Limits::sampled(10.0, 5000, 0.01);

#[test]
fn the_relay_slides_at_zero_after_the_exact_time() {
    use Source::{Enclosure, Field, Integrated, QuasiPolynomial};
    for source in [QuasiPolynomial, Enclosure, Field, Integrated] {
        for snap in [false, true] {
            for reversed in [false, true] {
                for (mode, start, exact) in
                    [(Side::Above, 1.0, 1.0 / 0.7), (Side::Below, -1.0, 1.0 / 1.3)]
                {
                    let relay = Relay { reversed, ..Relay::new(source, snap) };
                    let (arcs, stop) = run(&relay, mode, Vector1::new(start), LIMITS).unwrap();
                    let case = format!("{source:?} {snap} {reversed} {mode:?}");
                    assert_eq!(stop, Some(Stop::Sliding), "{case}");
                    // The first crossing, and at most two events that lead back and forth.
                    assert!(arcs.len() <= 4, "{case}: {}", arcs.len());
                    let sliding = sliding_of(&arcs);
                    assert!((sliding.time - exact).abs() < 1e-14, "{case} {}", sliding.time);
                    assert!(sliding.state[0].abs() < 1e-15, "{case} {}", sliding.state);
                    // Below is where the guard of the named surface is negative.
                    let factor = relay.guard_value(sliding.surface, &Vector1::new(1.0));
                    let (low, high) = if factor > 0.0 { (1.3, -0.7) } else { (-0.7, 1.3) };
                    let sides = if factor > 0.0 {
                        (Side::Below, Side::Above)
                    } else {
                        (Side::Above, Side::Below)
                    };
                    assert_eq!((sliding.below, sliding.above), sides, "{case}");
                    assert!((sliding.rates.0 - factor * low).abs() < 1e-12, "{case}");
                    assert!((sliding.rates.1 - factor * high).abs() < 1e-12, "{case}");
                    let field = matches!(source, Field | Integrated);
                    assert_eq!(sliding.field.is_some(), field, "{case}");
                    if let (Some(fields), Some(mean)) = (sliding.fields, sliding.field) {
                        assert_eq!((fields.0[0], fields.1[0]), (low, high));
                        assert!(mean[0].abs() < 1e-15, "{case} {mean}");
                    }
                }
            }
        }
    }
}

/// Without rates there is no decision from the fields, and no guess from the number of events.
#[test]
fn without_rates_the_chain_ends_in_an_error() {
    let relay = Relay::new(Source::None, true);
    let error = run(&relay, Side::Above, Vector1::new(1.0), LIMITS).unwrap_err();
    assert!(matches!(error, Error::TimelessChain { .. }), "{error}");
}

#[test]
fn a_start_on_the_surface_slides_at_once() {
    for source in [Source::QuasiPolynomial, Source::Enclosure, Source::Field, Source::Integrated] {
        for mode in [Side::Below, Side::Above] {
            let relay = Relay::new(source, false);
            let (arcs, stop) = run(&relay, mode, Vector1::zeros(), LIMITS).unwrap();
            assert_eq!(stop, Some(Stop::Sliding), "{source:?} {mode:?}");
            assert_eq!(sliding_of(&arcs).time, 0.0);
        }
    }
}

/// Both fields point away from the surface. A start on it is not unique as a solution of ẋ = f(x). The mode of the
/// start decides.
#[test]
fn from_an_escaping_start_the_mode_flows() {
    for source in [Source::QuasiPolynomial, Source::Enclosure, Source::Field, Source::Integrated] {
        for (mode, end) in [(Side::Below, -13.0), (Side::Above, 7.0)] {
            let relay = Relay { rates: (-1.3, 0.7), ..Relay::new(source, false) };
            let (arcs, stop) = run(&relay, mode, Vector1::zeros(), LIMITS).unwrap();
            assert_eq!((arcs.len(), stop), (1, Some(Stop::TimeLimit)), "{source:?} {mode:?}");
            let x = arcs[0].state(&relay, 10.0).unwrap()[0];
            assert!((x - end).abs() < 1e-11, "{source:?} {mode:?} {x}");
        }
    }
}

/// Both fields point upwards: the state passes through.
#[test]
fn fields_of_one_direction_pass_through() {
    for source in [Source::QuasiPolynomial, Source::Enclosure, Source::Field, Source::Integrated] {
        let relay = Relay { rates: (1.3, 0.7), ..Relay::new(source, false) };
        let (arcs, stop) = run(&relay, Side::Below, Vector1::new(-1.0), LIMITS).unwrap();
        assert_eq!((arcs.len(), stop), (2, Some(Stop::TimeLimit)), "{source:?}");
    }
}

/// The smallest rate on one side that is not hidden: there is no threshold of size.
#[test]
fn slow_fields_slide_as_well() {
    for source in [Source::QuasiPolynomial, Source::Enclosure, Source::Field] {
        let relay = Relay { rates: (1e-9, -0.7), ..Relay::new(source, true) };
        let (arcs, _) = run(&relay, Side::Above, Vector1::new(1.0), LIMITS).unwrap();
        assert!((sliding_of(&arcs).rates.0 / 1e-9 - 1.0).abs() < 1e-5, "{source:?}");
    }
}

/// A field of exactly zero below: the state stays where it is, in that mode.
#[test]
fn a_zero_field_is_an_equilibrium_and_no_sliding() {
    for source in [Source::QuasiPolynomial, Source::Field, Source::Integrated] {
        let relay = Relay { rates: (0.0, -0.7), ..Relay::new(source, true) };
        let (arcs, stop) = run(&relay, Side::Above, Vector1::new(1.0), LIMITS).unwrap();
        assert_eq!((arcs.len(), stop), (2, Some(Stop::TimeLimit)), "{source:?}");
        assert_eq!(arcs[1].state(&relay, 5.0).unwrap()[0], 0.0);
    }
}

/// A model in closed form that gives its fields: the free modes are exact, the sliding motion is integrated.
#[test]
fn a_model_in_closed_form_slides_on_with_its_fields() {
    for reversed in [false, true] {
        let relay = Relay { reversed, ..Relay::new(Source::Field, false) };
        let system = Filippov::new(relay, TIGHT);
        let start = FilippovMode::Free(Side::Above);
        let (arcs, stop) = run(&system, start, Vector1::new(1.0), LIMITS).unwrap();
        assert_eq!(stop, Some(Stop::TimeLimit));
        let last = arcs.last().unwrap();
        assert!(matches!(last.mode, FilippovMode::Sliding { .. }), "{reversed} {:?}", last.mode);
        assert!((last.time - 1.0 / 0.7).abs() < 1e-14);
        assert!(last.state(&system, last.duration).unwrap()[0].abs() < 1e-15);
    }
}

/// A model without fields has the typed end, and no sliding mode.
#[test]
fn a_model_without_fields_ends_where_it_would_slide() {
    let system = Filippov::new(Relay::new(Source::QuasiPolynomial, false), TIGHT);
    let start = FilippovMode::Free(Side::Above);
    let (arcs, stop) = run(&system, start, Vector1::new(1.0), LIMITS).unwrap();
    assert_eq!(stop, Some(Stop::Sliding));
    assert!(sliding_of(&arcs).fields.is_none());
}
