//! The fractions of the basins at one mass ratio.

use crate::certificate::{BasinGap, BasinInterval, CertificateLine};
use crate::error::Error;
use crate::fixed_points::fixed_point;
use crate::hop::proved_images::ProvedImages;
use crate::hop::strip::Strip;
use crate::lengths::BasinLengths;
use crate::line::ProvedLine;
use crate::theorems::digits::{at_least, at_most};
use crate::theorems::theorem::Theorem;
use basin_of_attraction::{Interval, Label};
use hopper_basin::HopperFate;
use interval_arithmetic::Enclosure;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The humps of the paper's fractions.
const HUMPS: u64 = 5;

/// Parts of the window of a sweep, and most speeds of each. They affect the time, and what stays open.
const PARTS: usize = 64;
const SPEEDS: usize = 1_000_000;

/// The share that a sweep may leave open of a part, over the root of the width that is asked for, and at most. What
/// is unknown of the gaps is of the size of their square. With a larger one the gaps, with a smaller one the sweep
/// takes the time.
const OPEN: f64 = 14.0;
const MOST_OPEN: f64 = 0.1;

/// The length next to a fixed point that is not divided further, and the unknown length of a gap that is not
/// either, over the width that is asked for. With larger ones the width is missed; with smaller ones it takes
/// longer.
const SHORTEST: f64 = 1.5e-3;
const UNKNOWN: f64 = 2.5e-5;

/// A width that was missed is asked for again as these parts of it. A smaller part takes longer, a larger one may
/// miss it again.
const FINER: [f64; 2] = [0.3, 0.1];

/// The smallest width that can be asked for: far below what is left by the rounding of speeds to `f64`.
const NARROWEST: f64 = 1e-12;

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
    /// What each basin has at least of the gaps between the intervals.
    pub gaps: Vec<BasinGap>,
}

fn check(mass_ratio: f64, width: f64) -> Result<(), Error> {
    Strip::at(mass_ratio)?;
    let is_width = (NARROWEST..1.0).contains(&width);
    if is_width { Ok(()) } else { Err(Error::Width { width, narrowest: NARROWEST }) }
}

impl ProvedFractions {
    /// The fractions at M, to `width` where one of three runs reaches it: [`width`](Self::width) tells.
    ///
    /// Below about 10⁻⁹ it is not reached, and at M ≥ 5 each halving of the width takes several times as long.
    ///
    /// # Errors
    /// [`Error::MassRatios`] for a wrong mass ratio; [`Error::Width`] unless `width` is from 10⁻¹² to 1.
    pub fn new(mass_ratio: f64, width: f64) -> Result<Self, Error> {
        check(mass_ratio, width)?;
        let mut found = Self::with_effort(mass_ratio, width)?;
        for part in FINER {
            if found.width <= width {
                break;
            }
            let finer = Self::with_effort(mass_ratio, part * width)?;
            if finer.width < found.width {
                found = finer;
            }
        }
        Ok(found)
    }

    /// The fractions at M, to about `width`.
    fn with_effort(mass_ratio: f64, width: f64) -> Result<Self, Error> {
        let strip = Strip::at(mass_ratio)?;
        let stars: Vec<Enclosure> = (1..=HUMPS + 1).map(fixed_point).collect();
        let window = Interval { left: stars[0].high(), right: stars[stars.len() - 1].low() };
        let open = (OPEN * width.sqrt()).min(MOST_OPEN);
        let shortest = SHORTEST * width;
        let line = ProvedLine::finer_at_fixed_points(strip, window, PARTS, open, SPEEDS, shortest)?;
        let basins = (0..=HUMPS).map(HopperFate::label_of_fixed_point);
        let labels: Vec<Label> = basins.chain([HopperFate::GROUNDED]).collect();
        let images = ProvedImages::new(strip, window.right)?;
        let lengths = BasinLengths::new(&line, &images, &labels, UNKNOWN * width);
        let known = |hump: &[Enclosure]| lengths.between(hump[0].high(), hump[1].low());
        let at_least: Vec<Vec<f64>> = stars.windows(2).map(known).collect();
        let humps: Vec<Enclosure> = stars.windows(2).map(|hump| hump[1] - hump[0]).collect();
        let whole = stars[stars.len() - 1] - stars[0];
        // All together have a hump: each has at most what the others leave.
        let open = |(known, hump): (&Vec<f64>, &Enclosure)| {
            let sum = known.iter().fold(Enclosure::ZERO, |sum, &own| sum + own);
            (*hump - sum).high().max(0.0)
        };
        let open: Vec<f64> = at_least.iter().zip(&humps).map(open).collect();
        // A share is between 0 and 1; only rounding leads beyond.
        let share = |found: Enclosure| Enclosure::new(found.low().max(0.0), found.high().min(1.0));
        let fraction = |(basin, &label): (usize, &Label)| {
            let (mut uniform, mut by_humps) = (Enclosure::ZERO, Enclosure::ZERO);
            for ((known, &hump), &open) in at_least.iter().zip(&humps).zip(&open) {
                let own = Enclosure::new(0.0, open) + known[basin];
                uniform = uniform + own;
                by_humps = by_humps + own / hump;
            }
            let (uniform, by_humps) = (share(uniform / whole), share(by_humps / HUMPS as f64));
            ProvedFraction { label, uniform, by_humps }
        };
        let fractions: Vec<ProvedFraction> = labels.iter().enumerate().map(fraction).collect();
        let width = fractions
            .iter()
            .map(|found| found.uniform.width().max(found.by_humps.width()))
            .fold(0.0, f64::max);
        let gaps = lengths.into_gaps();
        Ok(ProvedFractions { mass_ratio, fractions, width, intervals: line.into_intervals(), gaps })
    }
}

/// An interval with the digits of a fraction.
fn digits(share: Enclosure) -> String {
    format!("[{}, {}]", at_least(share.low(), DIGITS), at_most(share.high(), DIGITS))
}

/// The fractions at some mass ratios, each to a width of its own. `progress` is called with the number of finished
/// ones.
///
/// The last ones are begun first: put the mass ratios that take longest there.
///
/// # Errors
/// As [`ProvedFractions::new`].
pub fn measures(cases: &[(f64, f64)], progress: impl Fn(usize) + Sync) -> Result<Theorem, Error> {
    let mut theorem = Theorem::new(
        "measures",
        "The fractions of the basins among the lift-off speeds of humps 1 to 5, uniform in α, and as the mean of the \
         five humps: between these bounds.",
    );
    cases.iter().try_for_each(|&(mass_ratio, width)| check(mass_ratio, width))?;
    let done = AtomicUsize::new(0);
    let prove = |(number, &(mass_ratio, width)): (usize, &(f64, f64))| {
        let found = ProvedFractions::new(mass_ratio, width);
        progress(done.fetch_add(1, Relaxed) + 1);
        (number, width, found)
    };
    let mut all: Vec<_> = cases.iter().enumerate().rev().par_bridge().map(prove).collect();
    all.sort_by_key(|&(number, ..)| number);
    for (_, width, found) in all {
        let found = found?;
        let mass_ratio = found.mass_ratio;
        let mass_ratios = Interval { left: mass_ratio, right: mass_ratio };
        theorem.evidence.push(CertificateLine::Basins { mass_ratios, intervals: found.intervals });
        theorem.evidence.push(CertificateLine::Gaps(found.gaps));
        for ProvedFraction { label, uniform, by_humps } in &found.fractions {
            theorem.evidence.push(CertificateLine::Fraction {
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
