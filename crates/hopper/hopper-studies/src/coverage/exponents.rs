//! Exponents of power laws: dimensions from boxes at random offsets, and uncertainty exponents from pairs.

use super::known_sets::{cantor_boxes, cantor_dimension, cube_boxes, tent_label};
use super::tally::{Promise, Row, Trial, repeat};
use crate::error::Error;
use basin_of_attraction::{
    Hyperrectangle, Interval, Label, SplitMix64, array_map, box_dimension, power_law,
    uncertain_fraction, uncertainty_exponent,
};

/// Replicates of a trial.
const REPLICATES: u64 = 8;

/// Pairs at each scale of a replicate.
const PAIRS: usize = 300;

/// A range of scales: the finest, the decades, and the number of scales.
#[derive(Debug, Clone, Copy)]
struct Range(f64, f64, u64);

impl Range {
    /// 8 to 40 scales over 3 to 4.5 decades up to 0.03 … 0.3 of a unit; short ranges of few scales are the most
    /// frequent.
    fn at_random(random: &SplitMix64, unit: f64) -> Range {
        let decades = 3.0 + 1.5 * random.uniform(0) * random.uniform(1);
        let scales = 8 + (33.0 * random.uniform(2) * random.uniform(3)) as u64;
        Range(unit * pxfm::f_exp10(-0.5 - random.uniform(4) - decades), decades, scales)
    }

    fn scale(&self, k: u64) -> f64 {
        let &Range(finest, decades, scales) = self;
        finest * pxfm::f_exp10(decades * k as f64 / (scales - 1) as f64)
    }
}

/// The values of one replicate at one scale, from its random numbers and the index of the next one.
type Measurement<'a> = &'a (dyn Fn(f64, u64) -> Result<f64, Error> + Sync);

/// A set with its exponent.
struct Set<'a> {
    name: &'a str,
    exponent: f64,
    value: Measurement<'a>,
}

impl Set<'_> {
    /// The row for the ranges of the trials.
    fn row(
        &self,
        ranges: &str,
        trials: u64,
        range: impl Fn(u64) -> Range + Send + Sync,
    ) -> Result<Row, Error> {
        let scene = format!("{}, {ranges}", self.name);
        repeat("power_law", scene, Promise::Probable, trials, |trial| {
            let (random, range) = (SplitMix64::from_seed(trial), range(trial));
            let Range(_, _, scales) = range;
            let replicate = |r: u64| -> Result<Vec<(f64, f64)>, Error> {
                let at = |k: u64| {
                    let scale = range.scale(k);
                    Ok((scale, (self.value)(scale, random.bits(scales * r + k))?))
                };
                (0..scales).map(at).collect()
            };
            let replicates: Vec<_> = (0..REPLICATES).map(replicate).collect::<Result<_, _>>()?;
            let law = power_law(&replicates)?;
            Ok(law.interval.ok().map(|interval| Trial::of(interval, self.exponent)))
        })
    }

    /// One row for each fixed range.
    fn rows(&self, ranges: &[Range], trials: u64) -> Result<Vec<Row>, Error> {
        let row = |&range: &Range| {
            let Range(finest, decades, scales) = range;
            let coarsest = finest * pxfm::f_exp10(decades);
            let text = format!("{scales} scales from {finest:.0e} to {coarsest:.0e}");
            self.row(&text, trials, |_| range)
        };
        ranges.iter().map(row).collect()
    }

    /// A row with another range in each trial.
    fn row_of_random_ranges(&self, unit: f64, trials: u64) -> Result<Row, Error> {
        self.row("random ranges of 8 to 40 scales", trials, |trial| {
            Range::at_random(&SplitMix64::from_seed(!trial), unit)
        })
    }
}

/// Where a box of this size starts, at a place given by a random number: x ∈ (−ε, 0].
fn offset(size: f64, bits: u64) -> f64 {
    -size * SplitMix64::from_seed(bits).uniform(0)
}

/// Uncertainty exponents from pairs: of boundaries with an exact law, with few pairs and with many distances, of a
/// basin that is riddled, and of the tent map's Cantor set, whose law oscillates less than the interval is long.
fn from_pairs(trials: u64) -> Result<Vec<Row>, Error> {
    let (left, right) = (Interval::new(-1.0, 1.0)?, Interval::new(0.0, 1.0)?);
    let (line, unit) = (Hyperrectangle::try_from(left)?, Hyperrectangle::try_from(right)?);
    let square = Hyperrectangle::new(vec![left; 2])?;
    let point = |x: &[f64]| Label::from(x[0] > 0.1);
    // Every point has a label of its own random bit.
    let riddled = |x: &[f64]| {
        let seed = x.iter().fold(0, |seed, x| SplitMix64::from_seed(x.to_bits() ^ seed).bits(1));
        Label::from(seed % 2 == 0)
    };
    let tent = |x: &[f64]| tent_label(3.0, x[0]);
    let third = cantor_dimension((1.0 / 3.0, 1.0 / 3.0));
    type Labelling<'a> = &'a (dyn Fn(&[f64]) -> Label + Sync);
    let scenes: [(&str, &Hyperrectangle, Range, usize, f64, Labelling<'_>); 7] = [
        ("a point, 12 to 48 uncertain pairs", &line, Range(0.1, 0.602, 3), 240, 1.0, &point),
        ("a point, 4 to 16 uncertain pairs", &line, Range(0.04, 0.602, 3), 200, 1.0, &point),
        ("a point, 0.5 to 20 uncertain pairs", &line, Range(1e-3, 1.602, 20), 1000, 1.0, &point),
        ("a point", &line, Range(0.015, 1.301, 40), 2000, 1.0, &point),
        ("a line in the square", &square, Range(0.02, 1.301, 5), 3000, 1.0, &point),
        ("riddled square", &square, Range(1e-8, 6.0, 4), 500, 0.0, &riddled),
        ("tent map of slope 3", &unit, Range(1e-6, 3.0, 4), 1000, 1.0 - third, &tent),
    ];
    let row =
        |(name, region, range, pairs, exponent, label): (_, &_, Range, _, _, Labelling<'_>)| {
            let scales: Vec<f64> = (0..range.2).map(|k| range.scale(k)).collect();
            let scene = format!("{name}, {pairs} pairs at {} distances", scales.len());
            repeat("uncertainty_exponent", scene, Promise::Probable, trials, |seed| {
                match uncertainty_exponent(region, &scales, pairs, seed, label) {
                    Ok(found) => Ok(Some(Trial::of(found.exponent, exponent))),
                    Err(basin_of_attraction::Error::TooFewUncertainPairs { .. }) => Ok(None),
                    Err(error) => Err(error.into()),
                }
            })
        };
    scenes.into_iter().map(row).collect()
}

/// The attractor of a map that moves x into one half or the other of Cantor's set, by a chaotic coordinate which is too small for the boxes.
fn of_attractor(trials: u64) -> Result<Row, Error> {
    const POINTS: usize = 20_000;
    const SMALL: f64 = 1e-9;
    let map = array_map(|[x, u]: [f64; 2]| {
        let own = u / SMALL;
        let right = if own < 0.5 { 0.0 } else { 2.0 };
        Some([(x + right) / 3.0, SMALL * 4.0 * own * (1.0 - own)])
    });
    let sizes: Vec<f64> = (0..12).map(|k| Range(3e-4, 3.0, 12).scale(k)).collect();
    let scene = format!("Cantor set, {POINTS} points of an orbit, 12 scales from 3e-4 to 3e-1");
    repeat("box_dimension", scene, Promise::Probable, trials, |seed| {
        let start = [0.0, SMALL * SplitMix64::from_seed(seed).uniform(0)];
        let law = box_dimension(&map, &start, POINTS, &sizes, seed)?;
        let truth = cantor_dimension((1.0 / 3.0, 1.0 / 3.0));
        Ok(law.interval.ok().map(|interval| Trial::of(interval, truth)))
    })
}

/// All exponents.
pub(crate) fn measure(trials: u64) -> Result<Vec<Row>, Error> {
    let third = 1.0 / 3.0;
    let ranges = [Range(1e-4, 3.0, 8), Range(1e-4, 3.0, 40), Range(1e-5, 4.0, 20)];
    let mut found = Vec::new();
    for (name, ratios) in [
        ("Cantor set", (third, third)),
        ("Cantor set of ratios 1/2, 1/4", (0.5, 0.25)),
        ("Cantor set of ratios 1/5, 9/20", (0.2, 0.45)),
    ] {
        let value = |size: f64, bits: u64| Ok(cantor_boxes(ratios, size, offset(size, bits)));
        let set = Set { name, exponent: -cantor_dimension(ratios), value: &value };
        found.extend(set.rows(&ranges, trials)?);
        found.push(set.row_of_random_ranges(1.0, trials)?);
    }
    let ranges =
        [Range(1e-4, 3.0, 13), Range(1e-7, 3.0, 20), Range(1e-8, 5.0, 8), Range(1e-9, 3.0, 40)];
    let value = |size: f64, bits: u64| Ok(cube_boxes(size, offset(size, bits)));
    let set = Set { name: "{k⁻³}", exponent: -0.25, value: &value };
    found.extend(set.rows(&ranges, trials)?);
    found.push(set.row_of_random_ranges(1e-3, trials)?);
    let unit = Interval::new(0.0, 1.0)?;
    for (slope, ranges) in [
        (2.2, [Range(1e-5, 4.0, 20), Range(1e-4, 3.0, 8)]),
        (3.0, [Range(1e-5, 4.0, 20), Range(1e-4, 3.0, 8)]),
        (5.0, [Range(1e-4, 3.0, 20), Range(1e-4, 3.0, 8)]),
    ] {
        let value = |epsilon: f64, bits: u64| {
            Ok(uncertain_fraction(unit, epsilon, PAIRS, bits, |x| tent_label(slope, x))?.value)
        };
        let exponent = 1.0 - cantor_dimension((1.0 / slope, 1.0 / slope));
        let name = format!("pairs on the tent map of slope {slope}");
        found.extend(Set { name: &name, exponent, value: &value }.rows(&ranges, trials)?);
    }
    found.extend(from_pairs(trials)?);
    found.push(of_attractor(trials)?);
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 60 samples of 93 % coverage fewer than 48 cover in one of 1000 cases.
    #[test]
    fn every_interval_of_an_exponent_covers_as_often_as_stated() {
        for row in measure(30).unwrap() {
            // The fraction of uncertain starts near ε = 0.1 is not yet a power law: some trials show a drift and
            // are refused. Of the trials with 4 to 16 uncertain pairs at a distance a third have the 30 pairs that
            // an exponent needs.
            let least = if row.interval == "uncertainty_exponent" { 7 } else { 20 };
            assert!(row.given >= least && 30 * row.covered >= 24 * row.given, "{row:?}");
        }
    }
}
