//! The forced oscillator of Sommerer and Ott: its invariant plane, its contraction, and its two fates.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

use example_systems::forced_oscillator::{ForcedOscillator, Surface};
use hybrid_system::{Execution, HybridSystem, Limits, Stop};
use nalgebra::{Vector2, Vector4, Vector5};

const PUBLISHED: ForcedOscillator = ForcedOscillator::PUBLISHED;

/// On the plane y = ẏ = 0 both components stay zero, not only small.
#[test]
fn the_invariant_plane_is_kept_exactly() {
    let mut point = Vector4::new(0.3, -0.2, 0.0, 0.0);
    let mut farthest = 0.0f64;
    for _ in 0..1000 {
        point = PUBLISHED.stroboscopic_map(&point);
        assert_eq!((point[2], point[3]), (0.0, 0.0));
        farthest = farthest.max(point[0].abs());
    }
    // The orbit is chaotic in the plane, and does not leave it.
    assert!(farthest > 1.5 && farthest < 1.8, "{farthest}");
}

/// The field has the divergence −2γ, and within each of the planes (x, ẋ) and (y, ẏ) the divergence −γ.
#[test]
fn a_period_contracts_every_volume_by_the_same_factor() {
    let period = PUBLISHED.period();
    let contraction = pxfm::f_exp(-2.0 * PUBLISHED.friction * period);
    for k in 0..20 {
        let k = f64::from(k);
        let point = Vector4::new(0.1 * k - 1.0, 0.2 * k - 2.0, 0.05 * k, 0.5 - 0.04 * k);
        let determinant = PUBLISHED.stroboscopic_jacobian(&point).unwrap().determinant();
        assert!((determinant / contraction - 1.0).abs() < 1e-10, "{point}: {determinant}");
        // On the invariant plane the derivative has two blocks.
        let on_plane = Vector4::new(point[0], point[1], 0.0, 0.0);
        let jacobian = PUBLISHED.stroboscopic_jacobian(&on_plane).unwrap();
        for corner in [0, 2] {
            let block = jacobian.fixed_view::<2, 2>(corner, corner);
            assert!((block.determinant().powi(2) / contraction - 1.0).abs() < 1e-10);
            assert_eq!(jacobian.fixed_view::<2, 2>(corner, 2 - corner).amax(), 0.0);
        }
    }
}

#[test]
fn the_jacobian_is_the_derivative_of_the_map() {
    let point = Vector4::new(0.3, -0.2, 0.4, 0.7);
    let jacobian = PUBLISHED.stroboscopic_jacobian(&point).unwrap();
    for axis in 0..4 {
        let step = 1e-5;
        let (mut right, mut left) = (point, point);
        (right[axis], left[axis]) = (point[axis] + step, point[axis] - step);
        let quotient =
            (PUBLISHED.stroboscopic_map(&right) - PUBLISHED.stroboscopic_map(&left)) / (2.0 * step);
        let error = (quotient - jacobian.column(axis)).amax() / jacobian.amax();
        assert!(error < 1e-7, "{axis}: {error}");
    }
}

/// (x, y) → (x, −y) is a symmetry, to the last bit.
#[test]
fn the_mirror_image_of_an_orbit_is_an_orbit() {
    let mirrored = |p: &Vector4<f64>| Vector4::new(p[0], p[1], -p[2], -p[3]);
    let mut one = Vector4::new(0.3, -0.2, 0.1, 0.2);
    let mut other = mirrored(&one);
    for _ in 0..50 {
        (one, other) = (PUBLISHED.stroboscopic_map(&one), PUBLISHED.stroboscopic_map(&other));
        assert_eq!(mirrored(&one), other);
    }
}

/// The mean rate at which small y grows along an orbit of the plane, per unit of time.
fn transverse_exponent(oscillator: &ForcedOscillator, periods: u32) -> f64 {
    let mut point = Vector4::new(0.3, -0.2, 0.0, 0.0);
    let mut deviation = Vector2::new(1.0, 0.0);
    let mut sum = 0.0;
    for _ in 0..periods {
        let jacobian = oscillator.stroboscopic_jacobian(&point).unwrap();
        deviation = jacobian.fixed_view::<2, 2>(2, 2) * deviation;
        sum += pxfm::f_log(deviation.norm());
        deviation /= deviation.norm();
        point = oscillator.stroboscopic_map(&point);
    }
    sum / (f64::from(periods) * oscillator.period())
}

/// At the published shift the plane attracts on average. At 1.7 it repels: the attractor has lost its basin.
#[test]
fn the_plane_attracts_at_the_published_shift_and_repels_at_a_smaller_one() {
    let [attracting, repelling] = [PUBLISHED.shift, 1.7]
        .map(|shift| transverse_exponent(&ForcedOscillator { shift, ..PUBLISHED }, 600));
    assert!(attracting < -0.004 && repelling > 0.003, "{attracting} {repelling}");
}

/// The clock of the execution gives the points of the map.
#[test]
fn an_execution_has_the_points_of_the_map() {
    let start = Vector4::new(0.3, -0.2, 0.4, 0.7);
    let first = Vector5::new(start[0], start[1], start[2], start[3], 0.0);
    let mut point = start;
    let limits = Limits::new(1e3, 10);
    for (k, arc) in (1u32..).zip(Execution::new(&PUBLISHED, (), first, limits)) {
        let arc = arc.unwrap();
        let event = arc.event().unwrap();
        assert_eq!(event.surface, Surface::Stroboscope);
        assert!((event.time - f64::from(k) * PUBLISHED.period()).abs() < 1e-13);
        point = PUBLISHED.stroboscopic_map(&point);
        let after = event.after.unwrap().1;
        assert!((after.fixed_rows::<4>(0) - point).amax() < 1e-9, "{k}: {after}");
        assert_eq!(after[4], 0.0);
    }
}

/// Nearby starts have both fates: the plane, or infinity.
#[test]
fn some_orbits_reach_the_plane_and_some_escape() {
    let mut fates = [0; 2];
    for k in 0..12 {
        let start = Vector5::new(0.3, -0.2, 0.6 + 0.02 * f64::from(k), 0.0, 0.0);
        let mut execution = Execution::new(&PUBLISHED, (), start, Limits::new(1e5, 3000));
        let mut reached = false;
        for arc in execution.by_ref() {
            let arc = arc.unwrap();
            // So close to the plane the orbit stays for longer than any execution.
            reached = arc.start[2].abs() + arc.start[3].abs() < 1e-9;
            if reached {
                break;
            }
        }
        if reached {
            fates[0] += 1;
        } else {
            assert_eq!(execution.stop(), Some(Stop::Terminal));
            fates[1] += 1;
        }
    }
    assert!(fates[0] > 0 && fates[1] > 0, "{fates:?}");
}

/// The guard is the escape; y = 0 is far inside.
#[test]
fn the_guard_is_negative_on_the_plane() {
    assert!(PUBLISHED.guard_value(Surface::Escape, &Vector5::zeros()) < 0.0);
}
