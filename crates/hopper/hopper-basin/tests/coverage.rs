//! A pixel of a coverage raster has the shares of the basins in it, within its bounds.

use basin_of_attraction::{Grid, Interval, Label, Refinement};
use hopper_basin::{
    CoverageColumn, CoverageGround, CoverageLimits, Error, FIG_9, Fates, HopperFate, ShareColumn,
    basin_columns, coverage_raster, first_humps, hopper_basins,
};
use passive_hopper::{MassRatio, alpha_star};
use std::ops::ControlFlow::{Break, Continue};

fn fates(mass_ratio: f64) -> Fates {
    Fates::new(MassRatio::new(mass_ratio).unwrap()).unwrap()
}

fn interval(left: f64, right: f64) -> Interval {
    Interval::new(left, right).unwrap()
}

fn limits(tolerance: f64) -> CoverageLimits {
    CoverageLimits { tolerance, ..CoverageLimits::default() }
}

fn column(m: f64, window: Interval, pixels: usize, tolerance: f64) -> CoverageColumn {
    CoverageColumn::new(&fates(m), window, pixels, limits(tolerance)).unwrap()
}

/// Compares the shares with the fates of `samples` speeds in every pixel. A sample of a labelled interval has its
/// label without exception, so that the numbers of samples lie within the bounds, up to one sample at each end of
/// an interval.
fn check_samples(m: f64, window: Interval, pixels: usize, samples: usize, column: &CoverageColumn) {
    let fates = fates(m);
    let height = window.length() / pixels as f64;
    for pixel in 0..pixels {
        let low = window.left + height * pixel as f64;
        let speed = |k: usize| low + height * ((k as f64 + 0.5) / samples as f64);
        let speeds: Vec<f64> = (0..samples).map(speed).collect();
        let labels = fates.labels(&speeds).unwrap();
        let mut own = column.intervals().iter().peekable();
        let mut ends = 0;
        for (&speed, &label) in speeds.iter().zip(&labels) {
            while own.next_if(|(part, _)| part.right < speed).is_some() {
                ends += 1;
            }
            if let Some((_, known)) = own.peek().filter(|(part, _)| part.contains(speed))
                && label.is_decided()
            {
                assert_eq!(*known, label, "M = {m}, α = {speed}");
            }
        }
        let slack = (2 * ends + 2) as f64 / samples as f64;
        let mut all: Vec<Label> =
            labels.iter().copied().filter(|label| label.is_decided()).collect();
        let undecided = labels.len() - all.len();
        all.sort_unstable();
        all.dedup();
        for label in all {
            let count = labels.iter().filter(|&&own| own == label).count();
            let (few, many) = (count as f64, (count + undecided) as f64);
            let bounds = column.shares().of(label, pixel);
            let share = samples as f64;
            assert!(
                many / share >= bounds.lower - slack && few / share <= bounds.upper + slack,
                "M = {m}, pixel {pixel}, label {label}: {count} of {samples}, {bounds:?}"
            );
        }
    }
}

/// Every sample of a labelled interval has its label: at small and large M, below, across and above the humps with
/// laps, beside fixed points, and where the hopper is grounded.
#[test]
fn labelled_intervals_have_the_fates_of_their_speeds() {
    let humps = first_humps(5);
    for (m, window, pixels) in [
        (0.175, interval(17.0, 17.8), 16),
        (0.12, humps, 40),
        (0.05, interval(0.0, 9.0), 20),
        (0.5, humps, 40),
        (0.8, interval(0.5, 11.0), 24),
        (0.83, interval(20.0, 26.0), 8),
        (0.3, interval(alpha_star(3) - 1e-3, alpha_star(3) + 1e-3), 10),
        (0.2, interval(alpha_star(2) - 1e-7, alpha_star(2) + 1e-7), 4),
        (0.2, interval(8.4730397, 8.4730398), 6),
    ] {
        let found = column(m, window, pixels, 0.05);
        assert_eq!(found.ground(), CoverageGround::Laps);
        check_samples(m, window, pixels, 4096, &found);
    }
}

/// Where no laps are known, the label changes between samples are bisected.
#[test]
fn columns_without_laps_stand_on_samples() {
    for (m, window, pixels) in [
        (2.0, interval(6.0, 9.0), 40),
        (0.95, interval(8.0, 14.0), 40),
        (0.2, interval(33.0, 40.0), 30),
        (5.0, interval(15.0, 16.0), 1),
    ] {
        let found = column(m, window, pixels, 0.01);
        let spacing = window.length() / (pixels * CoverageLimits::default().samples) as f64;
        assert_eq!(found.ground(), CoverageGround::Spacing { speeds: spacing });
        assert!(found.shares().most_undecided() <= 0.01, "{m}");
        // Between two samples of one fate this fate is concluded; few speeds have another one, in a basin thinner
        // than the spacing.
        let fates = fates(m);
        let speed = |k: u32| window.left + window.length() * (f64::from(k) + 0.37) / 2000.0;
        let speeds: Vec<f64> = (0..2000).map(speed).collect();
        let labels = fates.labels(&speeds).unwrap();
        let (mut compared, mut missed) = (0, 0);
        for (speed, label) in speeds.into_iter().zip(labels) {
            let part = found.intervals().iter().find(|(part, _)| part.contains(speed));
            let Some(&(_, known)) = part else { continue };
            compared += 1;
            if known != label {
                missed += 1;
                let at = ((speed - window.left) / spacing).floor();
                let samples = [at, at + 1.0].map(|at| window.left + spacing * at);
                let [low, high] = samples.map(|sample| fates.fate(sample).unwrap().label());
                assert!(low != high || low == known, "M = {m}, α = {speed}");
            }
        }
        assert!(compared > 1900 && missed < compared / 20, "M = {m}: {missed} of {compared}");
    }
}

/// The lengths of the basins are those of `hopper_basins`, which pulls the traps back branch by branch.
#[test]
fn shares_have_the_lengths_of_the_basins() {
    for (m, n) in [(0.2, 2), (0.12, 3), (0.5, 1)] {
        let window = interval(alpha_star(n), alpha_star(n + 1));
        let refinement = Refinement { shortest: 1e-7, ..Refinement::default() };
        let other = hopper_basins(&fates(m), n, n + 1, 200, refinement).unwrap().basins;
        let (pixels, found) = (64, column(m, window, 64, 0.02));
        let labels = other.labels();
        assert!(labels.len() > 1);
        for label in labels {
            let bounds = (0..pixels).map(|pixel| found.shares().of(label, pixel));
            let (lower, upper) =
                bounds.fold((0.0, 0.0), |sum, own| (sum.0 + own.lower, sum.1 + own.upper));
            let part = window.length() / pixels as f64;
            let length = other.basin_length(label);
            assert!(lower * part <= length.upper + 1e-12, "{m} {label}");
            assert!(upper * part >= length.lower - 1e-12, "{m} {label}");
            assert!(upper * part - lower * part < 0.02 * window.length());
        }
    }
}

/// The shares of a pixel and its undecided part are the whole pixel; little is undecided, but where infinitely many
/// basins meet.
#[test]
fn shares_and_the_undecided_part_are_the_pixel() {
    let (window, pixels) = (interval(17.0, 17.8), 300);
    let found = column(0.175, window, pixels, 0.05);
    let mut above = 0;
    for pixel in 0..pixels {
        let certain: f64 = found.shares().certain(pixel).unwrap().iter().sum();
        let undecided = found.shares().undecided(pixel).unwrap();
        assert!((certain + undecided - 1.0).abs() < 1e-12);
        above += usize::from(undecided > 0.05);
    }
    assert!(above <= 3, "{above}");
    // Rounded down, so that the bounds stay bounds.
    let rounded = ShareColumn::from(&found);
    for pixel in 0..pixels {
        let exact = found.shares().certain(pixel).unwrap();
        for (&low, &share) in rounded.at(pixel).unwrap().iter().zip(exact) {
            assert!(f64::from(low) <= share && share - f64::from(low) < 1e-7);
        }
    }
}

/// A band of Fig. 9 that is thinner than a pixel: no middle of a pixel has its fate, and the shares of the pixels
/// show its height.
#[test]
fn a_needle_between_the_middles_of_pixels_is_seen() {
    let ((from, to), (bottom, top)) = FIG_9;
    let grid = Grid { x: interval(from, to), y: interval(bottom, top), columns: 64, rows: 128 };
    let mut missed = 0;
    for (at, labels) in basin_columns(&grid, 0..8).unwrap().into_iter().enumerate() {
        let found = CoverageColumn::of_grid(&grid, at, limits(0.02)).unwrap();
        for label in found.shares().labels() {
            for row in 1..grid.rows - 1 {
                let share = found.shares().of(*label, row).lower;
                let beside = [row - 1, row, row + 1].map(|row| labels[row]);
                missed += usize::from(share > 0.1 && beside.iter().all(|own| own != label));
            }
        }
    }
    assert!(missed > 20, "{missed}");
}

/// The same bits with any number of threads, and column by column.
#[test]
fn a_raster_is_its_columns_with_any_number_of_threads() {
    let grid = Grid { x: interval(0.1, 1.2), y: interval(4.5, 12.0), columns: 12, rows: 20 };
    let raster = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| coverage_raster(grid, limits(0.05), |_| Continue(())).unwrap())
    };
    let found = raster(1);
    assert_eq!(found, raster(5));
    assert!(found.grounds.contains(&CoverageGround::Laps));
    assert!(found.grounds.iter().any(|ground| *ground != CoverageGround::Laps));
    for at in [0, 7, 11] {
        let own = CoverageColumn::of_grid(&grid, at, limits(0.05)).unwrap();
        for (place, label) in found.shares.labels().iter().enumerate() {
            for row in 0..grid.rows {
                let share = f64::from(found.shares.at(at, row).unwrap()[place]);
                assert!((share - own.shares().of(*label, row).lower).abs() < 1e-7);
            }
        }
    }
    let stopped = coverage_raster(grid, limits(0.05), |_| Break(()));
    assert!(matches!(stopped, Err(Error::BasinOfAttraction(_))));
}

/// One pixel has the shares of the whole window.
#[test]
fn one_pixel_has_the_shares_of_all_of_them() {
    let window = interval(8.0, 10.0);
    let (one, many) = (column(0.2, window, 1, 0.01), column(0.2, window, 100, 0.01));
    for label in many.shares().labels() {
        let bounds = (0..100).map(|pixel| many.shares().of(*label, pixel));
        let (lower, upper) =
            bounds.fold((0.0, 0.0), |sum, own| (sum.0 + own.lower, sum.1 + own.upper));
        let own = one.shares().of(*label, 0);
        assert!(own.lower <= 0.01 * upper + 1e-12 && own.upper >= 0.01 * lower - 1e-12);
    }
}

#[test]
fn bad_windows_and_limits_are_refused() {
    let fates = fates(0.2);
    let new = |window, pixels, limits| CoverageColumn::new(&fates, window, pixels, limits);
    let (good, usual) = (interval(4.5, 20.0), CoverageLimits::default());
    assert!(new(good, 3, usual).is_ok());
    for (left, right) in
        [(20.0, 4.5), (4.5, 4.5), (-1.0, 5.0), (f64::NAN, 5.0), (1.0, 1e9), (1.0, f64::INFINITY)]
    {
        let found = new(Interval { left, right }, 3, usual);
        assert!(matches!(found, Err(Error::Window { .. })), "{left} {right}");
    }
    for tolerance in [0.0, -0.1, 1.0, f64::NAN, f64::INFINITY] {
        let found = new(good, 3, CoverageLimits { tolerance, ..usual });
        assert!(matches!(found, Err(Error::CoverageLimits { .. })), "{tolerance}");
    }
    assert!(new(good, 3, CoverageLimits { samples: 0, ..usual }).is_err());
    for pixels in [0, usize::MAX] {
        assert!(matches!(new(good, pixels, usual), Err(Error::BasinOfAttraction(_))), "{pixels}");
    }
    let narrow = interval(5.0, 5.0f64.next_up());
    assert!(new(narrow, 1, usual).is_ok() && new(narrow, 2, usual).is_err());
    // Without speeds to divide pixels at, what is open stays open.
    let open = new(good, 3, CoverageLimits { speeds: 0, ..usual }).unwrap();
    assert!(open.shares().most_undecided() > 0.5);
    assert_eq!(HopperFate::label_of_fixed_point(2), Label::from(2));
}
