//! The claim about where landings are sudden.

use super::claim::{Check, Evidence, Ground, largest};
use crate::error::Error;
use crate::independent::blind_landing::{printed_landing, sampled_excess};
use passive_hopper::{MassRatio, alpha_star};
use rayon::prelude::*;
use std::f64::consts::PI;

pub(super) const CHECKS: &[Check] = &[Check {
    name: "where landings are sudden",
    place: "Sec. III",
    ground: Ground::Test {
        test: "the sign of $y$_{1} − 1 by the printed Eqs. 6 and 8 without brackets, and by an execution that samples \
               heights",
        proof: Some("Theorem 8"),
    },
    evidence: || {
        let windows = |n: u64| (n as f64 * PI, alpha_star(n));
        let printed = |alpha, mass_ratio| Ok(printed_landing(alpha, mass_ratio)?.excess);
        sudden_windows(&windows, &printed, &sampled_excess, Windows { printed: 40, sampled: 6 })
    },
}];

/// y₁ − 1 at the first landing from α.
pub(super) trait Excess: Fn(f64, MassRatio) -> Result<f64, Error> + Sync {}

impl<F: Fn(f64, MassRatio) -> Result<f64, Error> + Sync> Excess for F {}

/// Numbers of windows that are searched.
#[derive(Debug, Clone, Copy)]
pub(super) struct Windows {
    pub(super) printed: u64,
    pub(super) sampled: u64,
}

/// Mass ratios of the check: 1, and two pairs of inverses.
const RATIOS: [f64; 5] = [0.01, 0.25, 1.0, 4.0, 100.0];
/// Spacing of the speeds at which the sign is searched. It is no part of π, so that the samples do not repeat their
/// places in the windows. The narrowest window, (π, α*_1), is 13 times as wide.
const SPACING: f64 = 0.1;
/// Largest relative distance of a change of sign from the claimed end of a window. At α*_n the landing is a triple
/// root: rounding of Eq. 8, some 4εα², shifts τ by its cube root, and δ = (t/β)³ by 2εα. At nπ the rounding of y₁,
/// some 8εα², shifts α by 4εα. Both are 10⁻¹³ at n = 40; the bound has a digit of room.
const BESIDE: f64 = 1e-12;

/// The speeds at which y₁ − 1 changes its sign, each with whether it is positive on its right.
fn changes(
    excess: &impl Excess,
    mass_ratio: MassRatio,
    windows: u64,
) -> Result<Vec<(f64, bool)>, Error> {
    // From the middle of hump 0 to the middle of the hump after the last window.
    let end = windows as f64 * PI + 0.75 * PI;
    let samples = ((end - 0.5 * PI) / SPACING) as u32;
    let at = |k: u32| 0.5 * PI + SPACING * f64::from(k);
    let mut found = Vec::new();
    let mut last = excess(at(0), mass_ratio)? > 0.0;
    for k in 1..=samples {
        let sudden = excess(at(k), mass_ratio)? > 0.0;
        if sudden != last {
            let (mut left, mut right) = (at(k - 1), at(k));
            loop {
                let middle = 0.5 * (left + right);
                if middle <= left || middle >= right {
                    break;
                }
                if (excess(middle, mass_ratio)? > 0.0) == sudden {
                    right = middle
                } else {
                    left = middle
                }
            }
            found.push((right, sudden));
        }
        last = sudden;
    }
    Ok(found)
}

/// Sudden first landings are exactly those from the claimed windows.
pub(super) fn sudden_windows(
    windows: &(impl Fn(u64) -> (f64, f64) + Sync),
    printed: &impl Excess,
    sampled: &impl Excess,
    count: Windows,
) -> Result<Evidence, Error> {
    let claimed = |count: u64| -> Vec<(f64, bool)> {
        (1..=count).flat_map(|n| [(windows(n).0, true), (windows(n).1, false)]).collect()
    };
    // Whether the changes are as claimed in number and kind, and their relative distances from the claimed ones.
    let compare = |found: Vec<(f64, bool)>, claimed: &[(f64, bool)]| {
        let kinds = found.iter().map(|c| c.1).eq(claimed.iter().map(|c| c.1));
        let pairs = found.iter().zip(claimed);
        (
            kinds,
            largest(pairs.map(|(found, claimed)| (found.0 / claimed.0 - 1.0).abs())),
            found.len(),
        )
    };
    let rows: Vec<[(bool, f64, usize); 2]> = RATIOS
        .into_par_iter()
        .map(|m| {
            let mass_ratio = MassRatio::new(m)?;
            Ok([
                compare(changes(printed, mass_ratio, count.printed)?, &claimed(count.printed)),
                compare(changes(sampled, mass_ratio, count.sampled)?, &claimed(count.sampled)),
            ])
        })
        .collect::<Result<_, Error>>()?;
    let worst = |k: usize| largest(rows.iter().map(|row| row[k].1));
    let number = |k: usize| rows.iter().map(|row| row[k].2).sum::<usize>();
    let kinds = rows.iter().flatten().all(|part| part.0);
    Ok(Evidence::about("left of a fixed point $y$_{1} > 1 at impact, right of it $y$_{1} < 1")
        .ours(format!(
            "$y$_{{1}} − 1 at impact changes its sign at {} speeds for {} mass ratios together; expected are {}, at \
             the ends of ($nπ$, $α$^{{∗}}_{{n}}), $n$ ≤ {}",
            number(0),
            RATIOS.len(),
            RATIOS.len() as u64 * 2 * count.printed,
            count.printed
        ))
        .error(format!(
            "largest distance from these ends: {:.1e} relative (printed), {:.1e} (execution, $n$ ≤ {})",
            worst(0),
            worst(1),
            count.sampled
        ))
        .how("sign of $y$_{1} − 1 at steps of 0.1 in $α$, each change bisected to neighbouring doubles")
        .holds(kinds && worst(0) <= BESIDE && worst(1) <= BESIDE))
}
