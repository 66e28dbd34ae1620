//! Exponents of power laws: dimensions from boxes at random offsets, and uncertainty exponents from pairs.

use super::known_sets::{cantor_boxes, cantor_dimension, cube_boxes, tent_label};
use super::tally::{Promise, Row, Trial, repeat};
use crate::error::Error;
use basin_of_attraction::{Interval, SplitMix64, power_law, uncertain_fraction};

/// Replicates of a trial.
const REPLICATES: u64 = 8;

/// Pairs at each scale of a replicate.
const PAIRS: usize = 300;

/// A range of scales: the finest, the decades, and the number of scales.
type Range = (f64, f64, u64);

/// The values of one replicate at one scale, from its random numbers and the index of the next one.
type Measurement<'a> = &'a (dyn Fn(f64, u64) -> Result<f64, Error> + Sync);

/// Rows of one set on several ranges.
fn rows(
    name: &str,
    truth: f64,
    ranges: &[Range],
    trials: u64,
    value: Measurement<'_>,
) -> Result<Vec<Row>, Error> {
    let row = |&(finest, decades, scales): &Range| {
        let coarsest = finest * pxfm::f_exp10(decades);
        let scene = format!("{name}, {scales} scales from {finest:.0e} to {coarsest:.0e}");
        let scale = |k: u64| finest * pxfm::f_exp10(decades * k as f64 / (scales - 1) as f64);
        repeat("power_law", scene, Promise::Probable, trials, |trial| {
            let random = SplitMix64::from_seed(trial);
            let replicate = |r: u64| -> Result<Vec<(f64, f64)>, Error> {
                let at = |k: u64| Ok((scale(k), value(scale(k), random.bits(scales * r + k))?));
                (0..scales).map(at).collect()
            };
            let replicates: Vec<_> = (0..REPLICATES).map(replicate).collect::<Result<_, _>>()?;
            let law = power_law(&replicates)?;
            Ok(law.interval.ok().map(|interval| Trial::of(interval, truth)))
        })
    };
    ranges.iter().map(row).collect()
}

/// All exponents. Pairs take as long as all boxes together: they have a quarter of the ranges.
pub(crate) fn measure(trials: u64) -> Result<Vec<Row>, Error> {
    /// Where a box of this size starts, at a place given by a random number: x ∈ (−ε, 0].
    fn offset(size: f64, bits: u64) -> f64 {
        -size * SplitMix64::from_seed(bits).uniform(0)
    }
    let third = 1.0 / 3.0;
    let ranges: [Range; 5] =
        [(1e-4, 3.0, 8), (1e-4, 3.0, 13), (1e-4, 3.0, 40), (1e-5, 4.0, 8), (1e-5, 4.0, 20)];
    let mut found = Vec::new();
    for (name, ratios) in [
        ("Cantor set", (third, third)),
        ("Cantor set of ratios 1/2, 1/4", (0.5, 0.25)),
        ("Cantor set of ratios 1/5, 9/20", (0.2, 0.45)),
    ] {
        let boxes = |size: f64, bits: u64| Ok(cantor_boxes(ratios, size, offset(size, bits)));
        found.extend(rows(name, -cantor_dimension(ratios), &ranges, trials, &boxes)?);
    }
    let cubes: [Range; 5] =
        [(1e-4, 3.0, 13), (1e-6, 3.0, 8), (1e-7, 3.0, 20), (1e-8, 5.0, 8), (1e-9, 3.0, 40)];
    let boxes = |size: f64, bits: u64| Ok(cube_boxes(size, offset(size, bits)));
    found.extend(rows("{k⁻³}", -0.25, &cubes, trials, &boxes)?);
    let unit = Interval::new(0.0, 1.0)?;
    for (slope, ranges) in [
        (2.2, [(1e-5, 4.0, 20), (1e-4, 3.0, 8)]),
        (3.0, [(1e-5, 4.0, 20), (1e-4, 3.0, 8)]),
        (5.0, [(1e-4, 3.0, 20), (1e-4, 3.0, 8)]),
    ] {
        let truth = 1.0 - cantor_dimension((1.0 / slope, 1.0 / slope));
        let pairs = |epsilon: f64, bits: u64| {
            Ok(uncertain_fraction(unit, epsilon, PAIRS, bits, |x| tent_label(slope, x))?.value)
        };
        let name = format!("pairs on the tent map of slope {slope}");
        found.extend(rows(&name, truth, &ranges, trials, &pairs)?);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 60 samples of 93 % coverage fewer than 48 cover in one of 1000 cases.
    #[test]
    fn every_interval_of_an_exponent_covers_as_often_as_stated() {
        for row in measure(60).unwrap() {
            // The fraction of uncertain starts near ε = 0.1 is not yet a power law: some trials show a drift and are refused.
            assert!(row.given >= 40 && 60 * row.covered >= 48 * row.given, "{row:?}");
        }
    }
}
