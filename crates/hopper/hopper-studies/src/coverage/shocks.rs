//! Random shocks to one attractor: fractions, times of convergence, fatal shares.

use super::tally::{Promise, Row, Trial, repeat};
use crate::error::Error;
use basin_of_attraction::{Bounds, Label, SplitMix64, Stability};

const ONE: Label = Label::numbered::<1>();

/// The basin is [0, 0.7) of the unit interval, and its attractor is at 0.4.
const EDGE: f64 = 0.7;
const ATTRACTOR: f64 = 0.4;

/// Convergence slows down beside the edge: the time is −ln(part of the basin)/RATE, in whole steps.
const RATE: f64 = 0.05;

/// The stability by so many shocks.
fn stability(count: u64, seed: u64) -> Result<Stability, Error> {
    let random = SplitMix64::from_seed(seed);
    let starts: Vec<Vec<f64>> = (0..count).map(|k| vec![random.uniform(k)]).collect();
    let fate = |x: f64| match x < EDGE {
        true => (ONE, (-pxfm::f_log(1.0 - x / EDGE) / RATE) as usize),
        false => (Label::from(2), 0),
    };
    let found: Vec<(Label, usize)> = starts.iter().map(|start| fate(start[0])).collect();
    Ok(Stability::new(&[(ONE, vec![vec![ATTRACTOR]])].into(), &starts, &found)?)
}

/// The probability of so many steps at least.
fn at_least(steps: usize) -> f64 {
    pxfm::f_exp(-RATE * steps as f64)
}

/// All of them.
pub(crate) fn measure(trials: u64) -> Result<Vec<Row>, Error> {
    let mut rows = Vec::new();
    for count in [100, 1000] {
        let row =
            |name,
             scene: &str,
             trial: &(dyn Fn(&Stability) -> Result<Option<Trial>, Error> + Sync)| {
                let scene = format!("{scene}, {count} shocks");
                repeat(name, scene, Promise::Probable, trials, |seed| {
                    trial(&stability(count, seed)?)
                })
            };
        rows.push(row("AttractorStability::fraction", "basin of 0.7", &|all| {
            let Some(own) = all.of(ONE) else { return Ok(None) };
            Ok(Some(Trial::of_proportion(own.fraction, EDGE, count as usize)?))
        })?);
        // The sum of the probabilities of 1, 2, 3, … steps at least.
        let mean = 1.0 / (pxfm::f_exp(RATE) - 1.0);
        rows.push(row("AttractorStability::mean_time", "slow beside the edge", &|all| {
            let time = all.of(ONE).and_then(|own| own.mean_time);
            Ok(time.map(|time| Trial::of(time, mean)))
        })?);
        rows.push(row("LongestTime::longer", "slow beside the edge", &|all| {
            let longest = all.of(ONE).and_then(|own| own.longest.as_ref());
            let bounds = |upper| Bounds { lower: 0.0, upper };
            Ok(longest.map(|own| Trial::of_bounds(bounds(own.longer), at_least(own.steps + 1))))
        })?);
        // The shocks up to 0.35 reach from 0.05 to 0.75.
        rows.push(row("AttractorStability::fatal_share", "0.05 of 0.7", &|all| {
            let share = all.of(ONE).map(|own| own.fatal_share(0.35)).transpose()?;
            Ok(share.map(|share| Trial::of(share, 0.05 / 0.7)))
        })?);
        rows.push(row("AttractorStability::time_quantile", "median", &|all| {
            // A basin of few starts may have too few of them.
            let time = all.of(ONE).and_then(|own| own.time_quantile(0.5).ok());
            let median = (0..).find(|steps| at_least(steps + 1) <= 0.5).unwrap_or(0) as f64;
            Ok(time.map(|time| Trial::of(time, median)))
        })?);
        rows.push(row("AttractorStability::fraction_within", "ten steps", &|all| {
            let own = all.of(ONE).map(|own| own.fraction_within(10)).transpose()?;
            Ok(own.map(|own| Trial::of(own, EDGE * (1.0 - at_least(11)))))
        })?);
        rows.push(row("AttractorStability::mean_harmless", "basin of 0.7", &|all| {
            let mean = all.of(ONE).and_then(|own| own.mean_harmless);
            let truth =
                (ATTRACTOR * ATTRACTOR + (EDGE - ATTRACTOR) * (EDGE - ATTRACTOR)) / (2.0 * EDGE);
            Ok(mean.map(|mean| Trial::of(mean, truth)))
        })?);
    }
    Ok(rows)
}
