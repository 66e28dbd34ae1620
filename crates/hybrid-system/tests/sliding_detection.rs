//! Sliding is recognised from the rates on both sides of a surface: typed ends of arcs.

#![cfg(feature = "ode")]
#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hybrid_system::*;
use nalgebra::{Vector1, Vector2};

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
    while let Some(arc) = execution.next() {
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

/// Both fields point away from the surface. A start on it is not unique as a solution of ẋ = f(x). The mode of the start
/// decides.
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

/// Two modes in the plane on both sides of the line x = 0, integrated.
struct Plane {
    below: fn(&State<2>) -> State<2>,
    above: fn(&State<2>) -> State<2>,
    reset: fn(&State<2>) -> State<2>,
}

impl HybridSystem for Plane {
    type State = State<2>;
    type Mode = Side;
    type Surface = Zero;
    fn flow(&self, side: Side, x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, side, x, t, TIGHT)
    }
    fn guards(&self, side: Side) -> &[Guard<Zero>] {
        match side {
            Side::Below => const { &[Guard::rising(Zero::Rising)] },
            Side::Above => const { &[Guard::falling(Zero::Rising)] },
        }
    }
    fn guard_value(&self, _: Zero, x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, side: Side, _: Zero, x: &State<2>) -> Reset<Side, State<2>> {
        let mode = if side == Side::Below { Side::Above } else { Side::Below };
        Reset::Jump { mode, state: (self.reset)(x) }
    }
    fn vector_field(&self, side: Side, x: &State<2>) -> Option<State<2>> {
        Some(if side == Side::Below { (self.below)(x) } else { (self.above)(x) })
    }
    fn first_crossing(
        &self,
        side: Side,
        x: &State<2>,
        search: &Search<Zero>,
    ) -> Result<NextEvent<Zero, State<2>>, Error> {
        integrated_crossing(self, side, x, search, TIGHT)
    }
}

/// The field above is tangent at the origin and bends downwards: ẋ = −y with ẏ = 1.
#[test]
fn a_tangent_field_that_bends_back_points_at_the_surface() {
    let plane = Plane {
        below: |_| Vector2::new(1.0, 0.0),
        above: |x| Vector2::new(-x[1], 1.0),
        reset: |x| *x,
    };
    let (arcs, stop) = run(&plane, Side::Below, Vector2::new(-1.0, 0.0), LIMITS).unwrap();
    assert_eq!(stop, Some(Stop::Sliding));
    let sliding = sliding_of(&arcs);
    assert!(sliding.rates.1.abs() < 1e-12 && (sliding.rates.0 - 1.0).abs() < 1e-12);
    // Where the field above is tangent, it is the sliding field.
    assert!((sliding.field.unwrap() - Vector2::new(0.0, 1.0)).amax() < 1e-11);
}

/// The field above is tangent at the origin and bends upwards: the state leaves.
#[test]
fn a_tangent_field_that_bends_away_passes_through() {
    let plane = Plane {
        below: |_| Vector2::new(1.0, 0.0),
        above: |x| Vector2::new(x[1], 1.0),
        reset: |x| *x,
    };
    let (arcs, stop) = run(&plane, Side::Below, Vector2::new(-1.0, 0.0), LIMITS).unwrap();
    assert_eq!((arcs.len(), stop), (2, Some(Stop::TimeLimit)));
}

/// Each reset moves the state along the surface: a chain of jumps, not a motion along the surface.
#[test]
fn resets_that_change_the_state_do_not_slide() {
    let plane = Plane {
        below: |_| Vector2::new(1.0, 0.0),
        above: |_| Vector2::new(-1.0, 0.0),
        reset: |x| Vector2::new(x[0], x[1] + 1e-3),
    };
    let error = run(&plane, Side::Below, Vector2::new(-1.0, 0.0), LIMITS).unwrap_err();
    assert!(matches!(error, Error::TimelessChain { .. }), "{error}");
}

/// The first reset moves the state along the surface, to a place that it keeps: sliding starts there.
#[test]
fn sliding_starts_where_the_resets_leave_the_state() {
    let plane = Plane {
        below: |_| Vector2::new(1.0, 0.5),
        above: |_| Vector2::new(-1.0, -0.25),
        reset: |x| Vector2::new(x[0], 2.0),
    };
    let (arcs, _) = run(&plane, Side::Below, Vector2::new(-1.0, 0.0), LIMITS).unwrap();
    let sliding = sliding_of(&arcs);
    assert_eq!(sliding.state[1], 2.0);
    assert!((sliding.field.unwrap() - Vector2::new(0.0, 0.125)).amax() < 1e-12);
}

/// A field that is not a number on one side: never silent, never sliding.
#[test]
fn a_field_without_a_value_is_an_error() {
    let plane = Plane {
        below: |_| Vector2::new(1.0, 0.0),
        above: |_| Vector2::new(f64::NAN, 0.0),
        reset: |x| *x,
    };
    let error = run(&plane, Side::Below, Vector2::new(-1.0, 0.0), LIMITS).unwrap_err();
    assert!(!matches!(error, Error::TimelessChain { .. }), "{error}");
}

/// Three modes that lead to each other on one surface have no two fields.
struct ThreeModes;

impl HybridSystem for ThreeModes {
    type State = State<1>;
    type Mode = u8;
    type Surface = ();
    fn flow(&self, mode: u8, x: &State<1>, t: f64) -> State<1> {
        let rate = if mode == 0 { -1.0 } else { 1.0 };
        x + Vector1::new(rate * t)
    }
    fn guards(&self, mode: u8) -> &[Guard<()>] {
        if mode == 0 { const { &[Guard::falling(())] } } else { const { &[Guard::rising(())] } }
    }
    fn guard_value(&self, _: (), x: &State<1>) -> f64 {
        x[0]
    }
    fn reset(&self, mode: u8, _: (), x: &State<1>) -> Reset<u8, State<1>> {
        Reset::Jump { mode: (mode + 1) % 3, state: *x }
    }
    fn guard_quasi_polynomial(&self, mode: u8, _: (), x: &State<1>) -> Option<QuasiPolynomial> {
        let rate = if mode == 0 { -1.0 } else { 1.0 };
        Some(QuasiPolynomial::polynomial(&[x[0], rate]))
    }
}

#[test]
fn three_modes_in_a_circle_are_a_timeless_chain() {
    let error = run(&ThreeModes, 0, Vector1::new(1.0), LIMITS).unwrap_err();
    assert!(matches!(error, Error::TimelessChain { .. }), "{error}");
}

/// Each mode is left beyond a threshold of its own. A jump far beyond both leads back and forth, but on no surface.
struct Beyond;

impl HybridSystem for Beyond {
    type State = State<1>;
    type Mode = Side;
    type Surface = Zero;
    fn flow(&self, side: Side, x: &State<1>, t: f64) -> State<1> {
        let rate = if side == Side::Below { 1.0 } else { -1.0 };
        x + Vector1::new(rate * t)
    }
    fn guards(&self, side: Side) -> &[Guard<Zero>] {
        match side {
            Side::Below => const { &[Guard::rising(Zero::Rising)] },
            Side::Above => const { &[Guard::rising(Zero::Falling)] },
        }
    }
    fn guard_value(&self, surface: Zero, x: &State<1>) -> f64 {
        if surface == Zero::Rising { x[0] } else { 5.0 - x[0] }
    }
    fn reset(&self, side: Side, _: Zero, x: &State<1>) -> Reset<Side, State<1>> {
        let mode = if side == Side::Below { Side::Above } else { Side::Below };
        Reset::Jump { mode, state: *x }
    }
    fn vector_field(&self, side: Side, _: &State<1>) -> Option<State<1>> {
        Some(Vector1::new(if side == Side::Below { 1.0 } else { -1.0 }))
    }
}

#[test]
fn beyond_two_different_surfaces_is_no_sliding() {
    let error = run(&Beyond, Side::Below, Vector1::new(-1.0), LIMITS).unwrap_err();
    assert!(matches!(error, Error::TimelessChain { .. }), "{error}");
}
