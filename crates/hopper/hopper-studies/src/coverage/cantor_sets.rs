//! Cantor sets of maps of the line: rates of escape, entropies and lengths.

use super::tally::{Promise, Row, Trial, repeat};
use crate::error::Error;
use basin_of_attraction::{
    Bounds, Branch, Enclosure, EscapeTimes, GapLengths, Interval, Itineraries, KneadingSequence,
    PreimageTree, Repeller, RepellerBounds, SplitMix64, array_map, repeller, repeller_bounds,
};

/// All of them.
pub(crate) fn measure(trials: u64) -> Result<Vec<Row>, Error> {
    let mut rows = escapes(trials)?;
    rows.extend([kneading(trials)?, full_branches(trials)?, golden(trials)?, lengths(trials)?]);
    rows.extend(repellers(trials)?);
    Ok(rows)
}

/// A third of the unit interval leaves in each step of the tent map of slope 3.
fn escapes(trials: u64) -> Result<Vec<Row>, Error> {
    let tent = array_map(|[x]: [f64; 1]| Some([3.0 * x.min(1.0 - x)]));
    let unit = Interval::new(0.0, 1.0)?.try_into()?;
    let inside = |x: &[f64]| (0.0..=1.0).contains(&x[0]);
    let row = |count: usize, (from, to)| {
        let scene = format!("tent map of slope 3, {count} orbits, from {from} to {to} steps");
        repeat("EscapeTimes::rate", scene, Promise::Probable, trials, |seed| {
            let times = EscapeTimes::of_random_points(&tent, &inside, &unit, count, to, seed)?;
            Ok(times.rate(from, to).ok().map(|rate| Trial::of(rate, pxfm::f_log(1.5))))
        })
    };
    [(100, (0, 3)), (1000, (2, 8)), (10_000, (4, 12))]
        .map(|(count, range)| row(count, range))
        .into_iter()
        .collect()
}

/// Tent maps of random slopes have the entropies of these.
fn kneading(trials: u64) -> Result<Row, Error> {
    let scene = "tent maps of random slopes".to_owned();
    repeat("KneadingSequence::entropy", scene, Promise::Certain, trials, |seed| {
        let slope = 1.05 + 0.95 * SplitMix64::from_seed(seed).uniform(0);
        let tent = |x: Enclosure| match x.high() <= 0.5 {
            true => Enclosure::from(slope) * x,
            false => Enclosure::from(slope) * (Enclosure::ONE - x),
        };
        let entropy = KneadingSequence::of_map(tent, Enclosure::from(0.5), 200).entropy()?;
        Ok(Some(Trial::of_bounds(entropy, pxfm::f_log(slope))))
    })
}

/// Two to four branches of random lengths, each over all of them and beyond, have the entropy of their number.
fn full_branches(trials: u64) -> Result<Row, Error> {
    let scene = "two to four branches over all of them".to_owned();
    repeat("Itineraries::Cantor", scene, Promise::Certain, trials, |seed| {
        let random = SplitMix64::from_seed(seed);
        let count = 2 + (3.0 * random.uniform(0)) as usize;
        let shares: Vec<f64> = (1..=count).map(|k| 0.3 + random.uniform(k as u64)).collect();
        let (all, top) = (shares.iter().sum::<f64>(), 1.1 + 0.5 * random.uniform(9));
        let (mut branches, mut left) = (Vec::new(), 0.0);
        for (k, share) in shares.iter().enumerate() {
            let right = if k + 1 == count { 1.0 } else { left + share / all };
            let domain = Interval::new(left, right)?;
            branches.push(Branch { domain, at_left: 0.0, at_right: top });
            left = right;
        }
        trial(&branches, top, pxfm::f_log(count as f64))
    })
}

/// Of two branches the second one leads to the first one only: the entropy is the logarithm of the golden ratio.
fn golden(trials: u64) -> Result<Row, Error> {
    let scene = "golden mean, holes of random length".to_owned();
    repeat("Itineraries::Cantor", scene, Promise::Certain, trials, |seed| {
        let random = SplitMix64::from_seed(seed);
        // The first one leaves at 1/3, before the second one begins at ½.
        let at_left = 0.34 + 0.15 * random.uniform(0);
        let first = Branch { domain: Interval::new(0.0, 0.5)?, at_left: 0.0, at_right: 1.5 };
        let second = Branch { domain: Interval::new(0.5, 1.0)?, at_left, at_right: 0.0 };
        trial(&[first, second], 1.5, pxfm::f_log(0.5 * (1.0 + 5f64.sqrt())))
    })
}

/// The bounds on the entropy of straight branches that leave [0, 1] upwards.
fn trial(branches: &[Branch], top: f64, entropy: f64) -> Result<Option<Trial>, Error> {
    const DEPTH: usize = 6;
    let map = |x: f64| {
        let own = branches.iter().find(|own| own.domain.contains(x))?;
        let part = (x - own.domain.left) / own.domain.length();
        Some(own.at_left + (own.at_right - own.at_left) * part)
    };
    let (window, above) = (Interval::new(0.0, 1.0)?, Interval::new(1.0 + 1e-12, top)?);
    let tree = PreimageTree::grow_from_known(&map, branches, above, window, DEPTH)?;
    Ok(match tree.itineraries(&map, branches, DEPTH) {
        Itineraries::Cantor { entropy: found } => Some(Trial::of_bounds(found, entropy)),
        _ => None,
    })
}

/// The points that never leave [0, 1] under logistic maps of random r, against the operator at Chebyshev nodes, which is right to 10⁻¹¹.
fn repellers(trials: u64) -> Result<Vec<Row>, Error> {
    const LETTERS: usize = 8;
    type Of = fn(&RepellerBounds, &Repeller) -> (Bounds, f64);
    let row = |name, of: Of| {
        let scene = format!("logistic maps that leave, {LETTERS} letters");
        repeat(name, scene, Promise::Certain, trials, |seed| {
            let r = 4.5 + 4.0 * SplitMix64::from_seed(seed).uniform(0);
            let inverse = |k: usize, y: Enclosure| {
                let root = (Enclosure::ONE - y * 4.0 / Enclosure::from(r)).sqrt()?;
                let x = if k == 0 { Enclosure::ONE - root } else { Enclosure::ONE + root };
                Some((x * 0.5, Enclosure::ONE / (root * r)))
            };
            let unit = Interval::new(0.0, 1.0)?;
            let exact = repeller(2, unit, |k, y| {
                let none = (f64::NAN, f64::NAN);
                let found = inverse(k, Enclosure::from(y));
                found.map_or(none, |(x, slope)| (x.middle(), slope.middle()))
            })?;
            let (bounds, truth) = of(&repeller_bounds(2, unit, LETTERS, inverse)?, &exact);
            Ok(Some(Trial::of_bounds(bounds, truth)))
        })
    };
    Ok(vec![
        row("repeller_bounds, dimension", |bounds, exact| (bounds.dimension, exact.dimension))?,
        row("repeller_bounds, rate", |bounds, exact| (bounds.escape_rate, exact.escape_rate))?,
    ])
}

/// Sets that are left where step n takes a gap of length a·bⁿ from the middle of each part, with 2b < 1. They have the length 1 − ab/(1 − 2b).
fn lengths(trials: u64) -> Result<Row, Error> {
    const STEPS: i32 = 10;
    let scene = "fat Cantor sets".to_owned();
    repeat("GapLengths::length_of_set", scene, Promise::Certain, trials, |seed| {
        let random = SplitMix64::from_seed(seed);
        let factor = 0.1 + 0.35 * random.uniform(0);
        let scale = random.uniform(1) * (1.0 - 2.0 * factor) / factor;
        let (mut parts, mut gaps) = (vec![(0.0, 1.0)], Vec::new());
        let mut last = 0.0;
        for step in 1..=STEPS {
            let gap = scale * factor.powi(step);
            last = gap * parts.len() as f64;
            let halves = |&(left, right): &(f64, f64)| {
                let (a, b) = (0.5 * (left + right - gap), 0.5 * (left + right + gap));
                ((left, a), (b, right))
            };
            let all: Vec<_> = parts.iter().map(halves).collect();
            for (left, right) in &all {
                gaps.push(Interval::new(left.1, right.0)?);
            }
            parts = all.into_iter().flat_map(|(left, right)| [left, right]).collect();
        }
        let found = GapLengths::new(&gaps, Interval::new(0.0, 1.0)?, 0.0)?;
        let truth = 1.0 - scale * factor / (1.0 - 2.0 * factor);
        let bounds = found.length_of_set(last, 2.0 * factor)?;
        // Bounds are not rounded outwards: they are right to some ulps.
        let wider = Bounds { lower: bounds.lower - 1e-13, upper: bounds.upper + 1e-13 };
        Ok(Some(Trial::of_bounds(wider, truth)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_on_cantor_sets_always_contain_the_truth() {
        for row in measure(100).unwrap() {
            let least = if row.promise == Promise::Certain { 100 } else { 84 };
            assert!(row.given == 100 && row.covered >= least, "{row:?}");
        }
    }
}
