//! The error bounds of sines and cosines.

use super::measured::Measured;
use super::tally::Tally;
use crate::error::Error;
use basin_of_attraction::SplitMix64;
use passive_hopper::{Solver, sine_errors};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// The ways to compute a sine, with the arithmetic that each is compared with.
const WAYS: [(&str, Solver, Solver); 4] = [
    ("kernel: sin and cos", Solver::Kernel, Solver::Bits106),
    ("correctly rounded sin and cos", Solver::General, Solver::Bits106),
    ("106 bits: sin and cos", Solver::Bits106, Solver::Bits256),
    ("256 bits: sin and cos", Solver::Bits256, Solver::Bits512),
];

/// Where the bounds are derived in docs/theory.md.
const STATEMENT: &str = "Lemma 57";

/// The kernel reduces arguments below 2²⁰ exactly, and its largest one is 128.
const LARGEST: f64 = 128.0;

/// The classes of arguments.
type Argument = fn(f64, f64) -> f64;

const CLASSES: [(&str, Argument); 3] = [
    ("arguments up to 128", |part, _| LARGEST * part),
    ("small arguments", |part, _| pxfm::f_exp2(-40.0 * part)),
    ("next to multiples of π/2", |part, side| {
        let zero = (81.0 * side).floor().max(1.0) * FRAC_PI_2;
        f64::from_bits(zero.to_bits() - 1000 + (2000.0 * part) as u64)
    }),
];

/// Measures the bounds on `count` arguments of each class.
pub(crate) fn measure(count: u64, seed: u64) -> Result<Vec<Measured>, Error> {
    let random = SplitMix64::from_seed(seed);
    let mut measured = Vec::new();
    for (bound, solver, reference) in WAYS {
        for (class, argument) in CLASSES {
            let at = |k: u64| argument(random.uniform(2 * k), random.uniform(2 * k + 1));
            let tally = (0..count)
                .into_par_iter()
                .fold(Tally::new, |mut tally, k| {
                    tally.add(ratio(at(k), solver, reference), k);
                    tally
                })
                .reduce(Tally::new, |mut a, b| {
                    a.merge(&b);
                    a
                });
            measured.push(tally.measured(bound, STATEMENT, class, |k| format!("{:?}", at(k))));
        }
    }
    Ok(measured)
}

/// The larger ratio of sine and cosine. Above ½ the comparison is repeated with a longer arithmetic: next to a zero the
/// absolute error of the shorter one is no small part of the bound.
fn ratio(x: f64, solver: Solver, reference: Solver) -> f64 {
    let Some(errors) = sine_errors(x, solver, reference) else { return f64::NAN };
    let ratio = errors.sin.ratio().max(errors.cos.ratio());
    match reference.longer() {
        Some(longer) if ratio > 0.5 && reference < Solver::Bits512 => {
            self::ratio(x, solver, longer)
        }
        _ => ratio,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_meet_their_bounds() {
        for found in measure(2000, 1).unwrap() {
            assert_eq!(found.count, 2000);
            assert!(found.largest > 0.0 && found.largest <= 1.0, "{found:?}");
        }
    }
}
