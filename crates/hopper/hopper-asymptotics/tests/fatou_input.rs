//! Fatou coordinates refuse bad input with a typed error, and give no silent NaN.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hopper_asymptotics::{BigInt, Error, Escape, FatouCoordinate, Offset, Phase, Side};
use passive_hopper::MassRatio;
use proptest::prelude::*;

const SIDES: [Side; 2] = [Side::Left, Side::Right];

fn sign(side: Side) -> f64 {
    match side {
        Side::Left => -1.0,
        Side::Right => 1.0,
    }
}

fn ratio(mass_ratio: f64) -> MassRatio {
    MassRatio::new(mass_ratio).unwrap()
}

fn coordinate(n: u64, mass_ratio: f64, side: Side) -> FatouCoordinate {
    FatouCoordinate::new(n, ratio(mass_ratio), side).unwrap()
}

fn power_of_ten(exponent: u32) -> BigInt {
    BigInt::from(10).pow(exponent)
}

/// An offset with its error, or a typed error: nothing else. Returns whether it is an offset.
fn offset_is_sound(psi: &FatouCoordinate, phase: &Phase) -> bool {
    let (side, drift) = (psi.side(), psi.drift());
    match psi.offset(phase) {
        Ok((offset, error)) => {
            let scene = format!("{side:?} A = {drift:e} Ψ = {phase:.60}: {offset} ± {error:e}");
            assert!(
                offset.mantissa() * sign(side) > 0.0 && offset.mantissa().is_finite(),
                "{scene}"
            );
            assert!(error > 0.0, "{scene}");
            // An offset with a finite error is within reach.
            let near = offset.nearest().abs() <= psi.reach() * (1.0 + 1e-9);
            assert!(near || !error.is_finite(), "{scene}");
            true
        }
        Err(Error::OutsideRange { value, left, right }) => {
            assert!(!value.is_nan() && left <= right, "{phase} {value} {left} {right}");
            false
        }
        Err(Error::Hop(_) | Error::Phase { .. }) => false,
        Err(other) => panic!("{phase}: {other}"),
    }
}

#[test]
fn offsets_that_are_zero_or_on_the_other_side_or_too_far_have_no_phase() {
    for side in SIDES {
        let psi = coordinate(2, 0.2, side);
        let beyond = 1.001 * psi.reach();
        for size in [0.0, -0.0, -1e-9, -5e-324, beyond, 1.0, f64::MAX, f64::NAN, f64::INFINITY] {
            let found = psi.phase(Offset::from(sign(side) * size));
            assert!(matches!(found, Err(Error::OutsideRange { .. })), "{size}: {found:?}");
        }
        for (mantissa, exponent) in
            [(1.0, 10_000), (1e308, 10_000), (-1.0, -10_000), (0.0, -10_000)]
        {
            let found = psi.phase(Offset::new(sign(side) * mantissa, exponent).unwrap());
            assert!(matches!(found, Err(Error::OutsideRange { .. })), "{mantissa}: {found:?}");
        }
        for (delta, error) in
            [(0.0, 0.0), (1e-9, 2e-9), (1e-9, f64::NAN), (f64::NAN, 0.0), (-1e-9, 0.0)]
        {
            let found = psi.count_within(sign(side) * delta, error);
            assert!(matches!(found, Err(Error::OutsideRange { .. })), "{delta} {error}: {found:?}");
            assert_eq!(psi.jump(sign(side) * delta, error, 0.01), None, "{delta} {error}");
            assert_eq!(psi.long_jump((sign(side) * delta, 0.0), error, 0.01), None);
        }
    }
    for (mantissa, exponent) in [(f64::NAN, 0), (f64::INFINITY, 0), (1.0, 10_001), (1.0, i64::MIN)]
    {
        assert!(matches!(Offset::new(mantissa, exponent), Err(Error::Offset { .. })));
    }
}

#[test]
fn the_smallest_offsets_have_phases() {
    for side in SIDES {
        let psi = coordinate(3, 0.5, side);
        for (mantissa, exponent) in
            [(5e-324, 0), (2.5e-310, 0), (1.0, -10_000), (5e-324, -10_000), (1e-200, 190)]
        {
            let phase = psi.phase(Offset::new(sign(side) * mantissa, exponent).unwrap()).unwrap();
            assert!(phase.error() < 1e-9 && (0.0..1.0).contains(&phase.fraction()), "{phase}");
        }
    }
}

#[test]
fn there_is_no_coordinate_at_the_origin() {
    for side in SIDES {
        assert!(matches!(
            FatouCoordinate::new(0, MassRatio::ONE, side),
            Err(Error::Index { n: 0 })
        ));
    }
    assert!(matches!(Escape::new(0, MassRatio::ONE), Err(Error::Index { n: 0 })));
}

/// A coordinate or a typed error at every mass ratio and index; a phase that is unknown has a bound that says so.
#[test]
fn extreme_mass_ratios_and_indices_have_bounds_or_errors() {
    let mut found = 0;
    for mass_ratio in [1e-300, 1e-100, 1e-15, 1e-6, 1e-3, 1.0, 1e4, 1e15, 1e100, 1e300] {
        for n in [1, 7, 1_000_000, 1_000_000_000_000, u64::MAX / 8] {
            for side in SIDES {
                let psi = match FatouCoordinate::new(n, ratio(mass_ratio), side) {
                    Ok(psi) => psi,
                    Err(error) => {
                        assert!(matches!(error, Error::Drift { .. }), "{error}");
                        continue;
                    }
                };
                found += 1;
                assert!(psi.range() > 0.0 && psi.range() <= psi.reach() && psi.reach() < 0.1);
                for part in [1e-200, 1e-6, 0.5, 1.0] {
                    let delta = sign(side) * part * psi.range();
                    let phase = psi.phase(delta.into()).unwrap();
                    assert!(
                        (0.0..1.0).contains(&phase.fraction()) && phase.error() > 0.0,
                        "{phase}"
                    );
                    offset_is_sound(&psi, &phase);
                }
                // Many hops lie between the range and the reach where the drift is slow. They have a budget.
                match psi.phase((sign(side) * psi.reach()).into()) {
                    Ok(phase) => {
                        offset_is_sound(&psi, &phase);
                    }
                    Err(error) => assert!(
                        matches!(error, Error::OutsideRange { .. } | Error::Hop(_)),
                        "{error}"
                    ),
                }
                offset_is_sound(&psi, &Phase::new(0, 0.0, 0.0));
            }
        }
    }
    assert!(found > 60, "{found}");
}

#[test]
fn phases_that_no_offset_has_are_refused() {
    for (n, mass_ratio) in [(1, 0.2), (2, 1.0), (1000, 0.2), (1_000_000, 1.0), (1_000_000, 0.01)] {
        for side in SIDES {
            let psi = coordinate(n, mass_ratio, side);
            for exponent in [1, 5, 15, 30, 200, 400, 3000] {
                let negative = Phase::new(-power_of_ten(exponent), 0.3, 0.0);
                if exponent > 2 {
                    assert!(!offset_is_sound(&psi, &negative), "{n} {mass_ratio} {exponent}");
                }
                assert!(offset_is_sound(&psi, &Phase::new(power_of_ten(exponent + 1), 0.3, 1e-12)));
            }
            for fraction in [0.0, 1e-300, -1e-300, 0.5, -0.5, 1e10, -1e10, 1e300, -1e300] {
                offset_is_sound(&psi, &Phase::new(0, fraction, 0.0));
                offset_is_sound(&psi, &Phase::new(40, fraction, 1e-3));
            }
        }
    }
}

/// A fraction or error that is no number gives a phase that is unknown, which has no offset.
#[test]
fn unknown_phases_have_no_offset() {
    let psi = coordinate(2, 0.2, Side::Left);
    for (fraction, error) in [
        (f64::NAN, 0.0),
        (f64::INFINITY, 0.0),
        (f64::NEG_INFINITY, 0.0),
        (0.5, f64::NAN),
        (0.5, -1.0),
        (0.5, f64::INFINITY),
    ] {
        let phase = Phase::new(100, fraction, error);
        assert!(phase.error() == f64::INFINITY && (0.0..1.0).contains(&phase.fraction()));
        let found = psi.offset(&phase);
        assert!(matches!(found, Err(Error::Phase { .. })), "{found:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    /// The offsets of all phases within the error of a phase lie within the error of its offset.
    #[test]
    fn errors_of_phases_are_propagated_as_bounds(
        n in 1..=50u64,
        exponent in -2.0..2.0f64,
        left in any::<bool>(),
        depth in 0.0..3.0f64,
        part in 0.0..1.0f64,
        shift in -1.0..1.0f64,
    ) {
        let psi = coordinate(n, 10f64.powf(exponent), if left { Side::Left } else { Side::Right });
        let delta = sign(psi.side()) * 0.9 * psi.range() * 10f64.powf(-depth);
        let exact = psi.phase(delta.into()).unwrap();
        // From far below to far above the phase itself.
        let count = psi.count_within(delta, 0.0).unwrap().hops.abs();
        let error = 2.0 * count * 10f64.powf(-3.0 * part);
        let moved = Phase::new(exact.whole().clone(), exact.fraction() + shift * error, error);
        if let Ok((offset, relative)) = psi.offset(&moved) {
            let near = offset.nearest();
            prop_assert!(
                (near - delta).abs() <= relative * near.abs() * (1.0 + 1e-9),
                "{} {} {:e}: {} ± {:e} from Ψ ± {:e}", n, 10f64.powf(exponent), delta, near, relative, error
            );
        }
    }

    #[test]
    fn any_bits_are_an_offset_or_an_error(bits in any::<u64>(), n in 1..1_000_000u64, left in any::<bool>()) {
        let psi = coordinate(n, 0.3, if left { Side::Left } else { Side::Right });
        if let Ok(phase) = psi.phase(f64::from_bits(bits).into()) {
            prop_assert!(phase.error() < 1e-9);
        }
        offset_is_sound(&psi, &Phase::new(0, f64::from_bits(bits), 1e-12));
    }
}
