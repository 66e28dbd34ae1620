//! Cases in which two fields decide, or do not decide, whether a state slides.

#![cfg(feature = "ode")]

use super::two_sided::{Side, TIGHT, run};
use hybrid_system::*;
use nalgebra::{Vector1, Vector2};

const LIMITS: Limits = Limits::sampled(10.0, 5000, 0.01);

/// The sliding point at which the last arc ends.
fn sliding_of<M: Copy, S: Copy, X: Clone>(arcs: &[Arc<M, S, X>]) -> Sliding<M, S, X> {
    match &arcs.last().unwrap().end {
        ArcEnd::Sliding { sliding, after: None } => sliding.clone(),
        _ => panic!("no sliding"),
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Zero {
    Rising,
    Falling,
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
    type Surface = ();
    fn flow(&self, side: Side, x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, side, x, t, TIGHT)
    }
    fn guards(&self, side: Side) -> &[Guard<()>] {
        match side {
            Side::Below => const { &[Guard::rising(()).contact()] },
            Side::Above => const { &[Guard::falling(()).contact()] },
        }
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, side: Side, _: (), x: &State<2>) -> Reset<Side, State<2>> {
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
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
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
            Side::Below => const { &[Guard::rising(Zero::Rising).contact()] },
            Side::Above => const { &[Guard::rising(Zero::Falling).contact()] },
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
