//! Means of replicates, entropies of balls on smooth boundaries, and bounds that are certain.

use super::tally::{Promise, Row, Trial, repeat};
use crate::error::Error;
use basin_of_attraction::{
    Branch, Grid, Hyperrectangle, Interval, Label, RandomBalls, Refinement, SplitMix64,
    ball_entropy, equally_spaced_fractions, interval_basins, interval_basins_from_known, raster,
    student_interval,
};
use std::ops::ControlFlow::Continue;

const ONE: Label = Label::numbered::<1>();

/// A normal number: twelve uniform numbers have a sum of variance 1, nearly normal.
fn normal(random: &SplitMix64, k: u64) -> f64 {
    (0..12).map(|i| random.uniform(12 * k + i)).sum::<f64>() - 6.0
}

/// Student's interval on replicates that are normal, as it assumes, and on uniform ones.
fn students(trials: u64) -> Result<Vec<Row>, Error> {
    let row = |(name, of): (&str, fn(&SplitMix64, u64) -> f64), count: u64| {
        let scene = format!("{count} {name} replicates");
        repeat("student_interval", scene, Promise::Probable, trials, |seed| {
            let random = SplitMix64::from_seed(seed);
            let replicates: Vec<f64> = (0..count).map(|k| of(&random, k)).collect();
            Ok(Some(Trial::of(student_interval(&replicates)?, 0.0)))
        })
    };
    let uniform = |random: &SplitMix64, k: u64| random.uniform(k) - 0.5;
    let mut rows = Vec::new();
    for count in [2, 5, 16] {
        rows.push(row(("normal", normal), count)?);
    }
    rows.push(row(("uniform", uniform), 16)?);
    Ok(rows)
}

/// Balls on a plane, which is the boundary of a half space; the truth is the reference itself.
fn balls(trials: u64) -> Result<Vec<Row>, Error> {
    let row = |dimension: usize| {
        let region = Hyperrectangle::new(vec![Interval::new(0.0, 1.0)?; dimension])?;
        let scene = format!("plane in {dimension} dimensions, 500 balls of 30 points");
        repeat("ball_entropy", scene, Promise::Probable, trials, |seed| {
            let balls = RandomBalls { radius: 0.1, balls: 500, points: 30, seed };
            let half = |x: &[f64]| Label::from(x[0] + 0.3 * x[dimension - 1] > 0.6);
            let found = ball_entropy(&region, balls, half)?;
            Ok(Some(Trial::of(found.mean, found.smooth)))
        })
    };
    (1..=3).map(row).collect()
}

/// Bounds under conditions that the scenes meet.
fn certain(trials: u64) -> Result<Vec<Row>, Error> {
    let unit = Interval::new(0.0, 1.0)?;
    let name = "equally_spaced_fractions";
    let mut rows =
        vec![repeat(name, "one interval, N = 100".into(), Promise::Certain, trials, |seed| {
            let random = SplitMix64::from_seed(seed);
            // Longer than a spacing, and as far from the ends of the window.
            let (left, length) = (0.02 + 0.4 * random.uniform(0), 0.02 + 0.5 * random.uniform(1));
            let label = |x: f64| Label::from(left <= x && x < left + length);
            let found = equally_spaced_fractions(unit, 100, label)?;
            Ok(found.get(&ONE).map(|found| Trial::of_bounds(found.bounds, length)))
        })?];
    // 3x/2 − x³/2 has the attractors ±1 with mirrored basins: each has half of [−w, w].
    let cubic = |x: f64| 1.5 * x - 0.5 * x * x * x;
    let branch = |(left, right): (f64, f64)| {
        let domain = Interval::new(left, right)?;
        Ok(Branch { domain, at_left: cubic(left), at_right: cubic(right) })
    };
    let branches: Vec<Branch> = [(-2.2, -1.0), (-1.0, 1.0), (1.0, 2.2)]
        .into_iter()
        .map(branch)
        .collect::<Result<_, Error>>()?;
    let traps = [(Interval::new(-1.2, -0.8)?, Label::from(0)), (Interval::new(0.8, 1.2)?, ONE)];
    let name = "IntervalBasins::basin_length";
    let scene = "cubic map, windows of random width".to_owned();
    rows.push(repeat(name, scene, Promise::Certain, trials, |seed| {
        let random = SplitMix64::from_seed(seed);
        let (width, levels) = (1.2 + random.uniform(0), (2.0 + 10.0 * random.uniform(1)) as usize);
        let window = Interval::new(-width, width)?;
        let refinement = Refinement { levels, ..Refinement::default() };
        let map = |x: f64| Some(cubic(x));
        let found = interval_basins(&map, &traps, &branches, window, refinement)?;
        Ok(Some(Trial::of_bounds(found.basin_length(ONE), width)))
    })?);
    let name = "IntervalBasins::uncertain_fraction";
    let scene = "two boundaries in undecided gaps".to_owned();
    rows.push(repeat(name, scene, Promise::Certain, trials, |seed| {
        let random = SplitMix64::from_seed(seed);
        let (gap, epsilon) = (1e-6 + 1e-3 * random.uniform(0), 1e-3 + 0.05 * random.uniform(1));
        let parts = [(0.0, 0.3, 0), (0.3 + gap, 0.7, 1), (0.7 + gap, 1.0, 0)];
        let part =
            |(left, right, n): (f64, f64, u8)| Ok((Interval::new(left, right)?, Label::from(n)));
        let known: Vec<_> = parts.into_iter().map(part).collect::<Result<_, Error>>()?;
        let no_map = |_: f64| None;
        let found = interval_basins_from_known(&no_map, &known, &[], unit, Refinement::default())?;
        // Wherever the boundaries lie in their gaps, they are farther than 2ε from each other and from the ends.
        Ok(Some(Trial::of_bounds(found.uncertain_fraction(epsilon, 1e-9)?, 4.0 * epsilon)))
    })?);
    let name = "LabelImage::fractions_between_pixels";
    rows.push(repeat(name, "disc on 40 × 40 pixels".into(), Promise::Certain, trials, |seed| {
        let random = SplitMix64::from_seed(seed);
        let radius = 0.1 + 0.2 * random.uniform(0);
        let (a, b) = (0.35 + 0.3 * random.uniform(1), 0.35 + 0.3 * random.uniform(2));
        let grid = Grid { x: unit, y: unit, columns: 40, rows: 40 };
        let disc =
            |&x: &f64, y: f64| Label::from((x - a) * (x - a) + (y - b) * (y - b) < radius * radius);
        let found = raster(grid, |x| x, disc, |_| Continue(()))?.fractions_between_pixels()?;
        let truth = std::f64::consts::PI * radius * radius;
        Ok(found.get(&ONE).map(|bounds| Trial::of_bounds(*bounds, truth)))
    })?);
    Ok(rows)
}

/// All of them.
pub(crate) fn measure(trials: u64) -> Result<Vec<Row>, Error> {
    Ok([students(trials)?, balls(trials)?, certain(trials)?].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_cover_as_often_as_stated_and_bounds_always() {
        for row in measure(150).unwrap() {
            assert!(row.given == 150, "{row:?}");
            // Of 150 samples of 93 % coverage fewer than 129 cover in one of 1000 cases.
            let least = if row.promise == Promise::Certain { 150 } else { 129 };
            assert!(row.covered >= least, "{row:?}");
        }
    }
}
