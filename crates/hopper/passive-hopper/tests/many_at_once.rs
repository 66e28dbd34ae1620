//! Many hops at once have the same bits as single hops.

use passive_hopper::{Error, HopStatus, HopWithin, LiftOffMap, MassRatio, alpha_star};
use proptest::prelude::*;
use std::f64::consts::PI;

/// The images one by one, which `images` must reproduce, and whether one of them is an error.
fn one_by_one(map: &LiftOffMap, speeds: &[Option<f64>]) -> (Vec<Option<f64>>, bool) {
    let mut failed = false;
    let image = |speed: &Option<f64>| {
        let alpha = (*speed)?;
        match map.image(alpha) {
            Ok(next) => next,
            Err(_) => {
                failed = true;
                *speed
            }
        }
    };
    (speeds.iter().map(image).collect(), failed)
}

fn check_images(m: f64, speeds: &[Option<f64>]) {
    let map = LiftOffMap::new(MassRatio::new(m).unwrap());
    let (expected, failed) = one_by_one(&map, speeds);
    let mut found = speeds.to_vec();
    let result = map.images(&mut found);
    assert_eq!(result.is_err(), failed);
    let bits = |speeds: &[Option<f64>]| -> Vec<_> {
        speeds.iter().map(|speed| speed.map(f64::to_bits)).collect()
    };
    assert_eq!(bits(&found), bits(&expected), "M = {m}");
    check_images_into(&map, speeds);
}

/// As [`check_images`], for plain arrays: NaN in the place of `None`, and of a speed with an error.
fn check_images_into(map: &LiftOffMap, speeds: &[Option<f64>]) {
    let plain: Vec<_> = speeds.iter().map(|speed| speed.unwrap_or(f64::NAN)).collect();
    let (mut images, mut same) = (vec![0.0; plain.len()], vec![0.0; plain.len()]);
    let mut status = vec![HopStatus::Undecided; plain.len()];
    let into = map.images_into(&plain, &mut images);
    let with_status = map.images_with_status(&plain, &mut same, &mut status);
    let (mut failed, mut refused) = (false, false);
    for (at, speed) in speeds.iter().enumerate() {
        let (image, expected) = match speed.map(|alpha| map.image(alpha)) {
            None => (None, HopStatus::NoSpeed),
            Some(Ok(Some(next))) => (Some(next), HopStatus::LiftsOff),
            Some(Ok(None)) => (None, HopStatus::Grounded),
            Some(Err(error)) => {
                failed = true;
                let undecided =
                    matches!(error, Error::Undecided { .. } | Error::SuddenLiftOffBudget { .. });
                refused |= !undecided;
                (None, if undecided { HopStatus::Undecided } else { HopStatus::NoSpeed })
            }
        };
        assert_eq!(status[at], expected, "{speed:?}");
        for found in [images[at], same[at]] {
            match image {
                Some(next) => assert_eq!(found.to_bits(), next.to_bits(), "{speed:?}"),
                None => assert!(found.is_nan(), "{speed:?}: {found}"),
            }
        }
    }
    assert_eq!((into.is_err(), with_status.is_err()), (failed, refused));
}

#[test]
fn slices_of_different_lengths_are_errors() {
    let map = LiftOffMap::new(MassRatio::ONE);
    let (mut images, mut status) = ([7.0; 3], [HopStatus::LiftsOff; 2]);
    let expected = Err(Error::Lengths { speeds: 2, results: 3 });
    assert_eq!(map.images_into(&[5.0, 6.0], &mut images), expected);
    assert_eq!(map.images_with_status(&[5.0, 6.0], &mut images, &mut status), expected);
    let expected = Err(Error::Lengths { speeds: 3, results: 2 });
    assert_eq!(map.images_with_status(&[5.0; 3], &mut images, &mut status), expected);
    assert_eq!(images, [7.0; 3]);
}

/// As [`check_images`], for `images_of_pairs`. The mass ratios are assigned to the speeds cyclically.
fn check_images_of_pairs(ratios: &[f64], speeds: &[Option<f64>]) {
    let maps: Vec<_> =
        ratios.iter().map(|&m| LiftOffMap::new(MassRatio::new(m).unwrap())).collect();
    let hops: Vec<_> = maps.iter().cycle().zip(speeds.iter().copied()).collect();
    let mut found = hops.clone();
    let failed = LiftOffMap::images_of_pairs(&mut found).is_err();
    let single = hops.iter().map(|&(map, speed)| one_by_one(map, &[speed]));
    let (expected, errors): (Vec<_>, Vec<_>) = single.unzip();
    assert_eq!(failed, errors.contains(&true));
    for ((found, expected), (map, _)) in found.iter().zip(expected).zip(&hops) {
        let bits = |speed: Option<f64>| speed.map(f64::to_bits);
        assert_eq!(bits(found.1), bits(expected[0]), "M = {}", map.mass_ratio().value());
    }
}

/// Speeds of the paper's window, of the tables, of any size, and next to α*_n and nπ; also `None`.
fn speed() -> impl Strategy<Value = Option<f64>> {
    let near = |point: f64, exponent: f64, sign: bool| {
        let step = 10f64.powf(-exponent);
        if sign { point + step } else { point - step }
    };
    prop_oneof![
        6 => (4.4..20.4f64).prop_map(Some),
        4 => (0.0..110.0f64).prop_map(Some),
        1 => (-12.0..13.0f64).prop_map(|exponent| Some(10f64.powf(exponent))),
        1 => (1..30u64, 0.0..17.0f64, any::<bool>())
            .prop_map(move |(n, e, sign)| Some(near(alpha_star(n), e, sign))),
        1 => (1..30u64, 0.0..17.0f64, any::<bool>())
            .prop_map(move |(n, e, sign)| Some(near(n as f64 * PI, e, sign))),
        1 => Just(None),
    ]
}

/// `hops_within` has the bits of `hop_within`, with the errors assigned to the speeds cyclically.
fn check_hops_within(ratios: &[f64], speeds: &[Option<f64>], errors: &[f64]) {
    let maps: Vec<_> =
        ratios.iter().map(|&m| LiftOffMap::new(MassRatio::new(m).unwrap())).collect();
    let entry = |speed: &Option<f64>, &error: &f64| match *speed {
        Some(speed) => HopWithin::Next { speed, error },
        None => HopWithin::Grounded,
    };
    let hops: Vec<_> = speeds.iter().zip(errors.iter().cycle()).map(|(s, e)| entry(s, e)).collect();
    let mut found: Vec<_> = maps.iter().cycle().zip(hops.iter().copied()).collect();
    LiftOffMap::hops_within(&mut found);
    for ((map, found), hop) in found.iter().zip(&hops) {
        let expected = match *hop {
            HopWithin::Next { speed, error } => map.hop_within(speed, error),
            other => other,
        };
        assert_eq!(*found, expected, "M = {}, {hop:?}", map.mass_ratio().value());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn images_are_the_single_images(
        exponent in -4.0..2.5f64,
        speeds in proptest::collection::vec(speed(), 0..700),
    ) {
        check_images(10f64.powf(exponent), &speeds);
    }

    #[test]
    fn images_of_pairs_are_the_single_images(
        exponents in proptest::collection::vec(-4.0..2.5f64, 1..9),
        speeds in proptest::collection::vec(speed(), 0..700),
    ) {
        check_images_of_pairs(&exponents.into_iter().map(|e| 10f64.powf(e)).collect::<Vec<_>>(), &speeds);
    }

    #[test]
    fn hops_within_are_the_single_hops(
        exponents in proptest::collection::vec(-4.0..2.5f64, 1..9),
        speeds in proptest::collection::vec(speed(), 0..700),
        errors in proptest::collection::vec(
            prop_oneof![Just(0.0), (-16.0..-5.0f64).prop_map(|e| 10f64.powf(e))], 1..9),
    ) {
        let ratios: Vec<_> = exponents.into_iter().map(|e| 10f64.powf(e)).collect();
        check_hops_within(&ratios, &speeds, &errors);
    }
}

#[test]
fn wrong_speeds_are_errors_and_stay_as_they_are() {
    let wrong = [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -0.0];
    for &bad in &wrong {
        let mut speeds: Vec<_> = (0..40).map(|k| Some(4.5 + 0.3 * f64::from(k))).collect();
        speeds[17] = Some(bad);
        let map = LiftOffMap::new(MassRatio::new(0.7).unwrap());
        let mut found = speeds.clone();
        assert_eq!(
            map.images(&mut found).unwrap_err().to_string(),
            map.image(bad).unwrap_err().to_string()
        );
        assert_eq!(found[17].map(f64::to_bits), Some(bad.to_bits()));
        for (found, speed) in found.iter().zip(&speeds).filter(|(_, s)| s.unwrap() != bad) {
            if !speed.unwrap().is_nan() {
                assert_eq!(*found, map.image(speed.unwrap()).unwrap());
            }
        }
    }
}

#[test]
fn twenty_hops_at_once_are_twenty_single_hops() {
    let map = LiftOffMap::new(MassRatio::new(0.2).unwrap());
    let starts: Vec<_> = (0..1000).map(|k| Some(4.5 + 0.016 * f64::from(k))).collect();
    let mut speeds = starts.clone();
    for _ in 0..20 {
        map.images(&mut speeds).unwrap();
    }
    for (start, found) in starts.iter().zip(speeds) {
        let follow = |speed: Option<f64>, _| speed.and_then(|alpha| map.image(alpha).unwrap());
        assert_eq!((0..20).fold(*start, follow), found);
    }
}
