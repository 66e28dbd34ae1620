//! The fractions of the basins at one mass ratio.

use crate::certificate::{BasinInterval, Evidence};
use crate::error::Error;
use crate::fixed_points::fixed_point;
use crate::hop::strip::Strip;
use crate::line::ProvedLine;
use crate::theorems::digits::{at_least, at_most};
use crate::theorems::theorem::Theorem;
use basin_of_attraction::{Interval, Label};
use hopper_basin::HopperFate;
use interval_arithmetic::Enclosure;

/// The humps of the paper's fractions.
const HUMPS: u64 = 5;

/// Parts of the window of a sweep, and most speeds of each. They affect the time, and what stays open.
const PARTS: usize = 64;
const SPEEDS: usize = 1_000_000;

/// The share that a sweep may leave open of a part, over the width that is asked for. With a larger one the width is missed; with a smaller
/// one a sweep takes longer.
const FINER: f64 = 0.1;

/// Digits of a fraction that are printed: more than the narrowest one has.
const DIGITS: usize = 12;

/// The share of a basin among the lift-off speeds of humps 1 to 5, enclosed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProvedFraction {
    /// The basin.
    pub label: Label,
    /// Its share of [α*_1, α*_6], by length.
    pub uniform: Enclosure,
    /// The mean of its shares of the five humps.
    pub by_humps: Enclosure,
}

/// The fractions of all basins at one mass ratio.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvedFractions {
    /// M.
    pub mass_ratio: f64,
    /// In the order of the labels.
    pub fractions: Vec<ProvedFraction>,
    /// The largest width of a fraction.
    pub width: f64,
    /// The basins.
    pub intervals: Vec<BasinInterval>,
}

/// The length of a basin between two speeds, from below.
fn length_of(line: &ProvedLine, label: Label, within: Interval) -> Enclosure {
    let mut sum = Enclosure::ZERO;
    for (own, _) in line.intervals().iter().filter(|(_, other)| *other == label) {
        let (left, right) = (own.left.max(within.left), own.right.min(within.right));
        if left < right {
            sum = sum + (Enclosure::new(right, right) - Enclosure::new(left, left));
        }
    }
    sum
}

impl ProvedFractions {
    /// The fractions at M, to about `width`.
    ///
    /// # Errors
    /// [`Error::MassRatios`] for a wrong mass ratio; [`Error::Share`] unless `width` is above 0 and below 1.
    pub fn new(mass_ratio: f64, width: f64) -> Result<Self, Error> {
        let strip = Strip::at(mass_ratio)?;
        let stars: Vec<Enclosure> = (1..=HUMPS + 1).map(fixed_point).collect();
        let ends = stars.windows(2).map(|pair| Interval { left: pair[0].high, right: pair[1].low });
        let humps: Vec<Interval> = ends.collect();
        let window = Interval { left: humps[0].left, right: humps[humps.len() - 1].right };
        let line = ProvedLine::new(strip, window, PARTS, FINER * width, SPEEDS)?;
        let basins = (0..=HUMPS).map(HopperFate::label_of_fixed_point);
        let mut labels: Vec<Label> = basins.collect();
        labels.push(HopperFate::GROUNDED);
        // The lengths of the humps, and what each basin has of it for certain: lower bounds. All together are at most the whole.
        let whole: Vec<Enclosure> = stars.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let lower: Vec<Vec<f64>> = labels
            .iter()
            .map(|&label| {
                humps.iter().map(|&hump| length_of(&line, label, hump).low.max(0.0)).collect()
            })
            .collect();
        let open = |hump: usize| {
            let known = lower
                .iter()
                .fold(Enclosure::ZERO, |sum, of| sum + Enclosure::new(of[hump], of[hump]));
            (whole[hump] - known).high.max(0.0)
        };
        let open: Vec<f64> = (0..humps.len()).map(open).collect();
        let total = whole.iter().fold(Enclosure::ZERO, |sum, &length| sum + length);
        let fraction = |(&label, lower): (&Label, &Vec<f64>)| {
            let length = |hump: usize| {
                Enclosure::new(
                    lower[hump],
                    (Enclosure::new(lower[hump], lower[hump]) + open[hump]).high,
                )
            };
            let sum = (0..lower.len()).fold(Enclosure::ZERO, |sum, hump| sum + length(hump));
            let shares = (0..lower.len())
                .fold(Enclosure::ZERO, |sum, hump| sum + length(hump) / whole[hump]);
            // A share is between 0 and 1; only rounding leads beyond.
            let share = |found: Enclosure| Enclosure::new(found.low.max(0.0), found.high.min(1.0));
            ProvedFraction {
                label,
                uniform: share(sum / total),
                by_humps: share(shares / lower.len() as f64),
            }
        };
        let fractions: Vec<ProvedFraction> = labels.iter().zip(&lower).map(fraction).collect();
        let width = fractions
            .iter()
            .map(|found| found.uniform.width().max(found.by_humps.width()))
            .fold(0.0, f64::max);
        Ok(ProvedFractions { mass_ratio, fractions, width, intervals: line.into_intervals() })
    }
}

/// An interval with the digits of a fraction.
fn digits(share: Enclosure) -> String {
    format!("[{}, {}]", at_least(share.low, DIGITS), at_most(share.high, DIGITS))
}

/// The fractions at some mass ratios, each to a width of its own.
///
/// # Errors
/// As [`ProvedFractions::new`].
pub fn measures(cases: &[(f64, f64)]) -> Result<Theorem, Error> {
    let mut theorem = Theorem::new(
        "measures",
        "The fractions of the basins among the lift-off speeds of humps 1 to 5, uniform in α, and as the mean of the five humps: between these bounds.",
    );
    for &(mass_ratio, width) in cases {
        let found = ProvedFractions::new(mass_ratio, width)?;
        let mass_ratios = Interval { left: mass_ratio, right: mass_ratio };
        theorem.evidence.push(Evidence::Basins { mass_ratios, intervals: found.intervals });
        for ProvedFraction { label, uniform, by_humps } in &found.fractions {
            theorem.evidence.push(Evidence::Fraction {
                label: *label,
                humps: HUMPS,
                uniform: *uniform,
                by_humps: *by_humps,
            });
            theorem.step(
                format!("M = {mass_ratio}, {}: to {width:e}", HopperFate::label_name(*label)),
                format!("uniform in {}, by humps in {}", digits(*uniform), digits(*by_humps)),
                uniform.width() <= width && by_humps.width() <= width,
            );
        }
    }
    Ok(theorem)
}
