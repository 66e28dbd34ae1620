//! 95 % intervals contain the true number in at least 93 of 100 samples: basin fractions, dimensions, uncertainty
//! exponents.

use super::cantor::{THIRD, cantor_boxes, cantor_label, interval};
use basin_of_attraction::{
    ConfidenceInterval, Error, Interval, Label, SplitMix64, equally_spaced_counts,
    equally_spaced_fractions, low_discrepancy_fractions, power_law, proportion_interval,
    random_fractions, uncertain_fraction, wilson_interval,
};
use std::collections::BTreeMap;

/// The number of `trials` intervals that contain the truth. A label without points has the interval of no success.
fn covered(
    trials: u64,
    points: usize,
    truth: f64,
    label: Label,
    fractions: &dyn Fn(u64) -> BTreeMap<Label, ConfidenceInterval>,
) -> usize {
    let none = proportion_interval(0, points).unwrap();
    let interval = |seed| fractions(seed).get(&label).copied().unwrap_or(none);
    (0..trials).filter(|&seed| interval(seed).covers(truth)).count()
}

/// A labelling, a basin in it, and the fraction of [0, 1] that the basin has.
type Scene<'a> = (&'a str, &'a (dyn Fn(f64) -> Label + Sync), Label, f64);

/// Basins of one interval, of many, of infinitely many, and of none that the cells resolve.
const SCENES: [Scene<'static>; 7] = [
    ("Cantor basin", &|x| cantor_label(x, 2), ZERO, 0.6),
    ("Cantor basin, rarest of three", &|x| cantor_label(x, 3), TWO, 4.0 / 19.0),
    ("one interval", &|x| Label::from(x < 0.37), ONE, 0.37),
    ("just above a whole number of cells", &|x| Label::from(x < 0.2501), ONE, 0.2501),
    ("rare", &|x| Label::from((0.3..0.3004).contains(&x)), ONE, 4e-4),
    ("a part of one cell", &|x| Label::from((0.3001..0.30027).contains(&x)), ONE, 1.7e-4),
    ("finer than any cell", &|x| Label::from((1e7 * x).fract() < 0.3), ONE, 0.3),
];
const ZERO: Label = Label::numbered::<0>();
const ONE: Label = Label::numbered::<1>();
const TWO: Label = Label::numbered::<2>();

/// Of 2000 samples at least 93 % have the truth in their interval, whatever the number of points.
#[test]
fn intervals_contain_the_true_fraction_as_often_as_stated() {
    let unit = interval(0.0, 1.0);
    const TRIALS: u64 = 2000;
    for (name, label, basin, truth) in SCENES {
        for points in [100, 137, 610, 1000] {
            let random = covered(TRIALS, points, truth, basin, &|seed| {
                random_fractions(unit, points, seed, label).unwrap()
            });
            // 1.3 % above and below what is stated are two and a half standard deviations of 2000 samples.
            assert!(random >= 1860, "{name}, {points} random points: {random}");
            let low = covered(TRIALS, points, truth, basin, &|seed| {
                low_discrepancy_fractions(unit, points, seed, label).unwrap()
            });
            assert!(low >= 1860, "{name}, {points} points of low discrepancy: {low}");
        }
    }
}

/// Random numbers of points, and intervals whose ends lie anywhere in their cells.
#[test]
fn low_discrepancy_intervals_are_never_longer_than_those_of_random_points() {
    let unit = interval(0.0, 1.0);
    let random = SplitMix64::from_seed(17);
    for trial in 0..300 {
        let points = 100 + (900.0 * random.uniform(3 * trial)) as usize;
        let (left, length) = (random.uniform(3 * trial + 1), random.uniform(3 * trial + 2));
        let label = |x: f64| Label::from((x - left).rem_euclid(1.0) < length * length);
        for (label, one) in low_discrepancy_fractions(unit, points, trial, label).unwrap() {
            let other =
                wilson_interval((one.value * points as f64).round() as usize, points).unwrap();
            assert!(
                one.half_width() <= other.half_width() + 1e-15,
                "{points} {label}: {one:?} {other:?}"
            );
            assert!(one.half_width() > 1.0 / points as f64, "{points} {label}: {one:?}");
        }
    }
    let step = |x: f64| Label::from(x < 0.37);
    let low = low_discrepancy_fractions(unit, 20_000, 1, step).unwrap()[&ONE];
    let random = random_fractions(unit, 20_000, 1, step).unwrap()[&ONE];
    assert!(low.half_width() < 0.04 * random.half_width(), "{low:?} {random:?}");
}

#[test]
fn too_few_points_are_refused_with_the_number_that_is_enough() {
    let label = |x: f64| Label::from(x < 0.5);
    for points in [0, 1, 99] {
        let error = low_discrepancy_fractions(interval(0.0, 1.0), points, 1, label).unwrap_err();
        assert_eq!(error, Error::TooFewPoints { points, fewest: 100 });
    }
}

/// Truth, half lengths allowed, and the interval of an exponent from random offsets of the boxes.
#[test]
fn the_interval_of_a_dimension_contains_it_as_often_as_stated() {
    const TRIALS: u64 = 300;
    // The dimension D of two copies with the ratios a and b: a^D + b^D = 1.
    let golden = ((1.0 + 5f64.sqrt()) / 2.0).ln() / 2f64.ln();
    type Count<'a> = &'a dyn Fn(f64, f64) -> f64;
    let cases: [(&str, f64, f64, Count<'_>); 3] = [
        ("Cantor set", 2f64.ln() / 3f64.ln(), 1e-4, &|e, x| cantor_boxes((THIRD, THIRD), e, x)),
        ("unequal Cantor set", golden, 1e-4, &|e, x| cantor_boxes((0.5, 0.25), e, x)),
        ("1/k^3", 0.25, 1e-7, &cube_boxes),
    ];
    for (name, truth, finest, count) in cases {
        for scales in [8, 20] {
            let (mut covered, mut length) = (0, 0.0);
            for trial in 0..TRIALS {
                let random = SplitMix64::from_seed(trial);
                let replicate = |r: u64| -> Vec<(f64, f64)> {
                    let size = |k: u64| finest * 10f64.powf(3.0 * k as f64 / (scales - 1) as f64);
                    (0..scales)
                        .map(|k| (size(k), count(size(k), -size(k) * random.uniform(100 * r + k))))
                        .collect()
                };
                let replicates: Vec<_> = (0..8).map(replicate).collect();
                let found = power_law(&replicates).unwrap().interval.unwrap();
                covered += u64::from(found.covers(-truth));
                length += found.half_width() / TRIALS as f64;
            }
            assert!(100 * covered >= 93 * TRIALS, "{name}, {scales} scales: {covered} of {TRIALS}");
            assert!(length < 0.1 * truth, "{name}, {scales} scales: {length}");
        }
    }
}

/// The uncertainty exponent of two labels on the complement of a Cantor set is 1 less its dimension.
#[test]
fn the_interval_of_an_uncertainty_exponent_contains_it_as_often_as_stated() {
    const TRIALS: u64 = 60;
    let truth = 1.0 - 2f64.ln() / 3f64.ln();
    let covered = (0..TRIALS).filter(|trial| {
        let replicate = |r: u64| -> Vec<(f64, f64)> {
            let fraction = |k: u64| {
                let (epsilon, seed) =
                    (10f64.powf(-1.5 - k as f64 / 3.0), 1000 * trial + 20 * r + k);
                let label =
                    |x: f64| if (0.0..=1.0).contains(&x) { cantor_label(x, 2) } else { ZERO };
                (
                    epsilon,
                    uncertain_fraction(interval(0.0, 1.0), epsilon, 300, seed, label)
                        .unwrap()
                        .value,
                )
            };
            (0..10).map(fraction).collect()
        };
        let law = power_law(&(0..8).map(replicate).collect::<Vec<_>>()).unwrap();
        law.interval.unwrap().covers(truth)
    });
    let covered = covered.count();
    assert!(covered >= 56, "{covered} of {TRIALS}");
}

/// Undecided points may belong to any basin, and a window that is reversed has no points.
#[test]
fn samplers_open_their_intervals_for_undecided_points_and_refuse_bad_windows() {
    let label = |x: f64| match x {
        ..0.3 => Label::from(0),
        ..0.4 => Label::UNDECIDED,
        ..0.5 => Label::UNDECIDED_MAP,
        _ => ONE,
    };
    let unit = interval(0.0, 1.0);
    let spaced = equally_spaced_fractions(unit, 1000, label).unwrap()[&ONE];
    assert!((spaced.bounds.lower - 0.499).abs() < 1e-12 && spaced.value == 0.5);
    assert!((0.7..0.71).contains(&spaced.bounds.upper), "{spaced:?}");
    for found in [
        random_fractions(unit, 1000, 1, label).unwrap()[&ONE],
        low_discrepancy_fractions(unit, 1000, 1, label).unwrap()[&ONE],
    ] {
        assert!((found.value - 0.5).abs() < 0.05, "{found:?}");
        assert!(found.lower > 0.45 && (0.68..0.76).contains(&found.upper), "{found:?}");
    }
    for (left, right) in [(1.0, 0.0), (0.0, f64::NAN), (f64::MIN, f64::MAX)] {
        let window = Interval { left, right };
        let errors = [
            equally_spaced_counts(window, 1000, label).unwrap_err(),
            equally_spaced_fractions(window, 1000, label).unwrap_err(),
            random_fractions(window, 1000, 1, label).unwrap_err(),
            low_discrepancy_fractions(window, 1000, 1, label).unwrap_err(),
        ];
        assert!(
            errors.iter().all(|error| matches!(error, Error::BadInterval { .. })),
            "{errors:?}"
        );
    }
}

/// A count that overflowed, or that no memory holds, is an error with the largest count, and no call of the label.
#[test]
fn counts_beyond_all_memory_are_errors() {
    let window = Interval::new(0.0, 1.0).unwrap();
    let label = |_: f64| -> Label { panic!("no point is labelled") };
    for count in [1_000_000_001, 1_000_000_000_000, usize::MAX] {
        let errors = [
            equally_spaced_counts(window, count, label).unwrap_err(),
            equally_spaced_fractions(window, count, label).unwrap_err(),
            random_fractions(window, count, 1, label).unwrap_err(),
            low_discrepancy_fractions(window, count, 1, label).unwrap_err(),
            uncertain_fraction(window, 0.1, count, 1, label).unwrap_err(),
        ];
        for error in errors {
            assert!(matches!(error, Error::TooManySamples { most: 1_000_000_000, .. }), "{error}");
        }
    }
}

/// The number of boxes [x + kε, x + (k+1)ε) with a point of {k⁻³} or 0.
fn cube_boxes(epsilon: f64, x: f64) -> f64 {
    let index = |point: f64| ((point - x) / epsilon).floor();
    let mut boxes = 0.0;
    let mut last = f64::NAN;
    for k in 1.. {
        let (point, next) = (f64::from(k).powi(-3), f64::from(k + 1).powi(-3));
        if point - next <= epsilon {
            // From here on every box down to 0 has a point.
            boxes += index(point) - index(0.0) + if index(point) == last { 0.0 } else { 1.0 };
            break;
        }
        boxes += if index(point) == last { 0.0 } else { 1.0 };
        last = index(point);
    }
    boxes
}
