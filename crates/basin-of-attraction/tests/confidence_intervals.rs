//! Basin fractions from sample points: 95 % intervals contain the true fraction in 95 of 100 samples.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

mod cantor;

use basin_of_attraction::{
    ConfidenceInterval, Error, Interval, Label, equally_spaced_counts, equally_spaced_fractions,
    low_discrepancy_fractions, random_fractions, uncertain_fraction, wilson_interval,
};
use cantor::{cantor_label, interval};

/// Of 1000 intervals of 95 %, 930 to 970 contain the true fraction.
#[test]
fn intervals_contain_the_true_fraction_as_often_as_stated() {
    let unit = interval(0.0, 1.0);
    let step = |x: f64| Label::from((-1.0..=0.0).contains(&x));
    let wide = interval(-1.5, 0.5);
    type Labelling<'a> = &'a (dyn Fn(f64) -> Label + Sync);
    let cases: [(&str, Interval, Labelling<'_>, Label, f64); 2] = [
        ("Cantor basin", unit, &|x| cantor_label(x, 2), Label::from(0), 0.6),
        ("one-sided fixed point", wide, &step, Label::from(1), 0.5),
    ];
    for (name, window, label, basin, truth) in cases {
        let covered = |fraction: &dyn Fn(u64) -> ConfidenceInterval| {
            (0..1000).filter(|&seed| fraction(seed).covers(truth)).count()
        };
        let random = covered(&|seed| random_fractions(window, 400, seed, label).unwrap()[&basin]);
        assert!((930..=970).contains(&random), "{name}, random: {random}");
        let low = covered(&|seed| {
            low_discrepancy_fractions(window, 100, 20, seed, label).unwrap()[&basin]
        });
        assert!((930..=970).contains(&low), "{name}, low discrepancy: {low}");
    }
}

#[test]
fn intervals_of_rare_labels_contain_the_true_fraction_as_often_as_stated() {
    // One point in fifty thousand lies in the basin. Most replicates have none; all together often have one.
    let unit = interval(0.0, 1.0);
    let truth = 2e-5;
    let covered = (0..300u64)
        .filter(|&seed| {
            let label = |x: f64| Label::from(x > 0.3 && x < 0.3 + truth);
            let fractions = low_discrepancy_fractions(unit, 1000, 16, seed, label).unwrap();
            let none = wilson_interval(0, 16_000).unwrap();
            fractions.get(&Label::from(1)).copied().unwrap_or(none).covers(truth)
        })
        .count();
    assert!(covered >= 279, "{covered} of 300");
}

#[test]
fn low_discrepancy_intervals_are_shorter_than_random_ones() {
    let window = interval(-1.5, 0.5);
    let label = |x: f64| Label::from((-1.0..=0.0).contains(&x));
    let random = random_fractions(window, 20_000, 1, label).unwrap()[&Label::from(1)];
    let low = low_discrepancy_fractions(window, 1000, 20, 1, label).unwrap()[&Label::from(1)];
    assert!(low.half_width() < 0.1 * random.half_width());
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
            low_discrepancy_fractions(window, count, 2, 1, label).unwrap_err(),
            low_discrepancy_fractions(window, 2, count, 1, label).unwrap_err(),
            low_discrepancy_fractions(window, count, count, 1, label).unwrap_err(),
            uncertain_fraction(window, 0.1, count, 1, label).unwrap_err(),
        ];
        for error in errors {
            assert!(matches!(error, Error::TooManySamples { most: 1_000_000_000, .. }), "{error}");
        }
    }
}
