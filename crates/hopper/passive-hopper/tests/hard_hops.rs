//! Hops on which earlier versions of the solvers decided wrongly, with the right values.
//!
//! All seven numbers come from `xtask/generators/hop.py`, which shares no code with this crate: mpmath at rising
//! precision until 40 digits agree. The 512 bits of [`Solver::Bits512`] give the same hops.

#![allow(clippy::excessive_precision)] // digits of the independent computation, as it prints them

use passive_hopper::{LiftOffMap, MassRatio, Solver};

/// M, α, the number of sudden lift-offs, α′.
const HOPS: [(f64, f64, usize, f64); 7] = [
    // The first landing is sudden by a stretch of 8e-14 and 1e-16. Without the flights after it α′ would be 37.461…
    // and 54.614….
    (5.698491118684765, 53.40707511102649, 1, 26.489000894171255258810),
    (3.9933127775792583, 91.106186954104, 3, 30.452309399070653163660),
    // Left of a fixed point.
    (0.4533170695393104, 26.66605425881267, 1, 26.666054258812671657820),
    (0.03264720722638785, 3045437.9272413705, 1, 2852874.499170329260213),
    // Just below π.
    (1.0651966393051213, 3.1415803418496826, 0, 0.098786860649118711059),
    // Large speeds: the phase has few digits in `f64`.
    (0.1905661046244478, 3367578867810.567, 0, 2740982246551.659877007),
    (6.585292916937581, 445119.5050261796, 0, 330284.235932313500236),
];

fn map(mass_ratio: f64) -> LiftOffMap {
    LiftOffMap::new(MassRatio::new(mass_ratio).unwrap())
}

#[test]
fn hops_that_were_wrong_are_right_within_their_bounds() {
    for (m, alpha, sudden, next) in HOPS {
        let place = format!("M = {m}, α = {alpha}");
        let bounded = map(m).bounded_hop(alpha).unwrap();
        assert_eq!(bounded.hop.sudden, sudden, "{place}");
        let (found, error) = (bounded.hop.next.unwrap(), bounded.next_error.unwrap());
        // The planted number is rounded as well.
        let distance = (found - next).abs();
        assert!(distance <= error + f64::EPSILON * next, "{place}: {distance:e} {error:e}");
        // The bound is of use: the two wrong values above differ by 10.
        assert!(error < 1e-5 * next, "{place}: {error:e}");
        assert_eq!(map(m).image(alpha).unwrap(), Some(found), "{place}");
    }
}

#[test]
fn every_shorter_way_decides_these_hops_as_512_bits_do_or_not_at_all() {
    let mut compared = 0;
    for (m, alpha, sudden, next) in HOPS {
        let place = format!("M = {m}, α = {alpha}");
        let reference = map(m).reference_hop(alpha, Solver::Bits512).unwrap().unwrap();
        for solver in [Solver::Kernel, Solver::General, Solver::Bits106, Solver::Bits256] {
            let Some(errors) = reference.errors_of(solver).unwrap() else { continue };
            compared += 1;
            assert!(errors.same_decisions, "{place}: {solver:?}");
            assert_eq!(errors.landings.len(), 1 + sudden, "{place}: {solver:?}");
            for landing in &errors.landings {
                let all =
                    [landing.excess, landing.velocity, Some(landing.loss), landing.maximum_test];
                for found in all.into_iter().flatten() {
                    assert!(found.ratio() <= 1.0, "{place}: {solver:?} {landing:?}");
                }
            }
            assert!(errors.ratio.ratio() <= 1.0, "{place}: {solver:?}");
            let error = errors.next.unwrap();
            assert!(error.ratio() <= 1.0 && error.bound < 1e-5 * next, "{place}: {solver:?}");
        }
    }
    // 106 and 256 bits decide all of them.
    assert!(compared >= 2 * HOPS.len(), "{compared}");
}

/// In 106 bits the product of two numbers splits its factors, and M = 4·10³⁰⁷ times 2²⁷ is infinite: such a hop did
/// not end.
#[test]
fn hops_at_the_largest_mass_ratios_end() {
    for exponent in [300, 301, 307] {
        let m = 4.0 * 10f64.powi(exponent);
        for alpha in [4.4, 9.5e3, 8_796_093_022_208.0] {
            let found = map(m).bounded_hop(alpha).unwrap();
            // The loss is μ Σ Γ² / (2α) to first order, μ = 1/M, and the last digit of α does not change.
            let next = found.hop.next.unwrap();
            assert_eq!(next, alpha, "{m} {alpha}");
            let squares: f64 = found.landings.iter().map(|l| l.landing.closing_speed.powi(2)).sum();
            let (loss, first_order) = (found.hop.loss.unwrap(), squares / m / (2.0 * alpha));
            assert!((loss - first_order).abs() <= 1e-6 * first_order, "{m} {alpha}: {loss}");
        }
    }
}
