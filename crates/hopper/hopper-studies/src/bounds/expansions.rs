//! The error bounds of expansions and local hops.
//!
//! Values near a fixed point are compared with 512 or 1024 bits. The other references are in `f64`, or in twice its
//! length; the bound on their own error is added to the actual error.

use super::measured::Measured;
use super::tally::Tally;
use crate::error::Error;
use basin_of_attraction::SplitMix64;
use hopper_asymptotics::{
    Decay, ExpansionValue, LEFT_RANGE, LeftExpansion, RIGHT_RANGE, RightExpansion,
    SMALL_ALPHA_RANGE, fixed_point_series, small_hop_loss, trap_length_series,
};
use hopper_basin::Trap;
use passive_hopper::{FixedPointSpeed, LiftOffMap, MassRatio, ReferenceLocalHop, alpha_star};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Where the numbers of a class start, so that no two classes use the same ones.
const SEED: u64 = 14;

/// Bound on the error of a local hop, in ulps of δ′ and of t (docs/theory.md, Theorem 74).
const LOCAL_ULPS: f64 = 8.0;

/// Bound on the relative error of `hop(α).loss` for small α, in ulps, measured (docs/accuracy.md). It is used for α
/// from 0.003 on, where the bound of the expansion is 10⁵ ulps and more.
const REFERENCE_ULPS: f64 = 16.0;

/// A start near a fixed point.
#[derive(Debug, Clone, Copy)]
struct LocalStart {
    n: u64,
    mass_ratio: f64,
    delta: f64,
}

/// A class of starts: from four numbers in [0, 1).
struct Class {
    name: &'static str,
    start: fn([f64; 4]) -> LocalStart,
}

/// 10^x.
fn ten_to(x: f64) -> f64 {
    pxfm::f_exp10(x)
}

/// From 10^`low` to 10^`high`, with even probability in the exponent.
fn between(low: f64, high: f64, part: f64) -> f64 {
    ten_to(low + (high - low) * part)
}

/// An index up to 10^`exponent`.
fn index(exponent: f64, part: f64) -> u64 {
    between(0.0, exponent, part) as u64
}

/// A start at `part` of the way from α*_n to the end of its interval on one side.
fn inside(n: u64, mass_ratio: f64, right: bool, part: f64) -> LocalStart {
    let star = alpha_star(n);
    let end = if right { (n + 1) as f64 * PI - star } else { n as f64 * PI - star };
    LocalStart { n, mass_ratio, delta: part * end }
}

/// A start on the left, at `part` of the range of the series.
fn below_range(n: u64, mass_ratio: f64, part: f64) -> LocalStart {
    let series = MassRatio::new(mass_ratio).ok().and_then(|m| LeftExpansion::new(n, m).ok());
    LocalStart { n, mass_ratio, delta: -part * series.map_or(LEFT_RANGE, |series| series.range()) }
}

const CLASSES: [Class; 8] = [
    Class {
        name: "right, in the range of the series",
        start: |[a, b, c, _]| LocalStart {
            n: index(2.0, a),
            mass_ratio: between(-3.0, 3.0, b),
            delta: RIGHT_RANGE * between(-6.0, 0.0, c),
        },
    },
    Class {
        name: "right, n up to 10¹², M from 10⁻⁶ to 10⁶",
        start: |[a, b, c, _]| LocalStart {
            n: index(12.0, a),
            mass_ratio: between(-6.0, 6.0, b),
            delta: RIGHT_RANGE * between(-30.0, 0.0, c),
        },
    },
    Class {
        name: "right, δ from 10⁻²⁹⁹, M from 10⁻³⁰⁰ to 10³⁰⁰",
        start: |[a, b, c, _]| LocalStart {
            n: index(3.0, a),
            mass_ratio: between(-300.0, 300.0, b),
            delta: between(-299.0, -1.0, c),
        },
    },
    Class {
        name: "right, whole interval",
        start: |[a, b, c, _]| inside(index(4.0, a), between(-9.0, 9.0, b), true, c),
    },
    Class {
        name: "left, in the range of the series",
        start: |[a, b, c, _]| {
            below_range(index(2.0, a), between(-3.0, 3.0, b), between(-6.0, 0.0, c))
        },
    },
    Class {
        name: "left, n up to 10¹², M from 10⁻⁶ to 10⁶",
        start: |[a, b, c, _]| {
            below_range(index(12.0, a), between(-6.0, 6.0, b), between(-20.0, 0.0, c))
        },
    },
    Class {
        name: "left, δ from −10⁻²⁹⁹, M from 10⁻³⁰⁰ to 10³⁰⁰",
        start: |[a, b, c, _]| LocalStart {
            n: index(3.0, a),
            mass_ratio: between(-300.0, 300.0, b),
            delta: -between(-299.0, -3.0, c),
        },
    },
    Class {
        name: "left, whole window",
        start: |[a, b, c, d]| {
            // Half of the starts are close to the end nπ of the window.
            let part = if d < 0.5 { c } else { 1.0 - between(-9.0, 0.0, c) };
            inside(index(4.0, a), between(-9.0, 2.0, b), false, part)
        },
    },
];

/// The bounds that are measured at one start: name and statement.
const QUANTITIES: [(&str, &str); 7] = [
    ("right expansion: loss", "Theorem 67"),
    ("right expansion: δ′", "Theorem 67"),
    ("left expansion: loss", "Theorem 68"),
    ("left expansion: δ′", "Theorem 68"),
    ("local hop: δ′", "Theorem 74"),
    ("local hop: time shift", "Lemma 73"),
    ("decay: one hop", "Theorem 69"),
];

/// Measures the bounds of expansions and local hops on about `count` inputs a class.
///
/// # Errors
/// [`Error::CheckFailed`] if a local hop has another number of sudden lift-offs than in longer arithmetic.
pub(crate) fn measure(count: u64) -> Result<Vec<Measured>, Error> {
    let mut measured = Vec::new();
    for (place, class) in CLASSES.iter().enumerate() {
        measured.extend(of_class(count, place as u64, class)?);
    }
    measured.push(single(
        count,
        ROWS,
        "decay: number of hops",
        "Theorem 69",
        "orbits of 300 hops",
        decay,
    ));
    measured.push(single(
        count,
        ROWS + 1,
        "decay: offset",
        "Theorem 69",
        "orbits of 300 hops",
        offset,
    ));
    measured.push(single(
        10 * count,
        ROWS + 2,
        "series of α*_n",
        "Theorem 71",
        "n in order",
        fixed_points,
    ));
    measured.push(single(
        10 * count,
        ROWS + 3,
        "series of α*_n",
        "Theorem 71",
        "n up to 10¹⁹",
        large_indices,
    ));
    measured.push(single(count, ROWS + 4, "series of Δ_n", "Theorem 70", "λ from 3", trap_lengths));
    measured.push(single(
        count,
        ROWS + 5,
        "loss of small hops",
        "Theorem 71",
        "α from 0.003 to 0.3",
        small_hops,
    ));
    Ok(measured)
}

/// The stream of random numbers after those of the classes.
const ROWS: u64 = CLASSES.len() as u64;

/// Four numbers in [0, 1) for input `k` of a class.
fn numbers(class: u64, k: u64) -> [f64; 4] {
    let random = SplitMix64::from_seed(SEED + class);
    std::array::from_fn(|place| random.uniform(4 * k + place as u64))
}

/// All bounds of a class of starts.
fn of_class(count: u64, place: u64, class: &Class) -> Result<Vec<Measured>, Error> {
    let empty = || vec![Tally::new(); QUANTITIES.len()];
    let start = |k: u64| (class.start)(numbers(place, k));
    let tallies: Result<Vec<Tally>, Error> = (0..count)
        .into_par_iter()
        .try_fold(empty, |mut tallies, k| {
            for (tally, ratio) in tallies.iter_mut().zip(ratios(start(k))?) {
                if let Some(ratio) = ratio {
                    tally.add(ratio, k);
                }
            }
            Ok(tallies)
        })
        .try_reduce(empty, |mut a, b| {
            a.iter_mut().zip(&b).for_each(|(a, b)| a.merge(b));
            Ok(a)
        });
    let named = tallies?.into_iter().zip(QUANTITIES).filter(|(tally, _)| !tally.is_empty());
    Ok(named
        .map(|(tally, (bound, statement))| {
            tally.measured(bound, statement, class.name, |k| {
                let LocalStart { n, mass_ratio, delta } = start(k);
                format!("n = {n}, M = {mass_ratio:?}, δ = {delta:?}")
            })
        })
        .collect())
}

/// The ratios of all bounds at a start, in the order of [`QUANTITIES`].
fn ratios(start: LocalStart) -> Result<[Option<f64>; QUANTITIES.len()], Error> {
    /// More sudden lift-offs take too long in 512 bits.
    const MOST_SUDDEN: usize = 8;
    let LocalStart { n, mass_ratio, delta } = start;
    let mut ratios = [None; QUANTITIES.len()];
    let ratio = MassRatio::new(mass_ratio)?;
    let map = LiftOffMap::new(ratio);
    let Ok(hop) = map.hop_near_fixed_point(n, delta) else { return Ok(ratios) };
    if hop.sudden > MOST_SUDDEN {
        return Ok(ratios);
    }
    let Some(exact) = map.reference_local_hop(n, delta)? else { return Ok(ratios) };
    if hop.sudden != exact.sudden || hop.next.is_some() != exact.next.is_some() {
        return Err(Error::CheckFailed(format!("a decision is wrong at {start:?}")));
    }
    let ulps = |value: f64| LOCAL_ULPS * f64::EPSILON * value.abs();
    if let Some((next, exact)) = hop.next.zip(exact.next) {
        ratios[4] = Some(exact.error_of(next) / ulps(exact.nearest));
    }
    ratios[5] = Some(exact.time_shift.error_of(hop.time_shift) / ulps(exact.time_shift.nearest));
    let series = if delta > 0.0 {
        RightExpansion::new(n, ratio)
            .and_then(|right| Ok((0, right.loss(delta)?, right.displacement(delta)?)))
    } else {
        LeftExpansion::new(n, ratio)
            .and_then(|left| Ok((2, left.loss(delta)?, left.displacement(delta)?)))
    };
    let (
        Ok((place, loss, next)),
        ReferenceLocalHop { next: Some(exact_next), loss: Some(exact), .. },
    ) = (series, exact)
    else {
        return Ok(ratios);
    };
    ratios[place] = Some(exact.error_of(loss.value) / loss.error);
    ratios[place + 1] = Some(exact_next.error_of(next.value) / next.error);
    // The end of the orbit is rounded to an `f64`, which changes the number of hops by a part of an ulp of u/r.
    let hops = Decay::new(n, ratio).and_then(|law| law.hops(delta, exact_next.nearest));
    ratios[6] = hops.ok().map(|hops| (hops.value - 1.0).abs() / hops.error);
    Ok(ratios)
}

/// One bound on one class, from a function that gives the ratio and the input as text.
fn single(
    count: u64,
    place: u64,
    bound: &'static str,
    statement: &'static str,
    class: &'static str,
    ratio: fn(u64, [f64; 4]) -> Option<(f64, String)>,
) -> Measured {
    let tally = (0..count)
        .into_par_iter()
        .fold(Tally::new, |mut tally, k| {
            if let Some((ratio, _)) = ratio(k, numbers(place, k)) {
                tally.add(ratio, k);
            }
            tally
        })
        .reduce(Tally::new, |mut a, b| {
            a.merge(&b);
            a
        });
    let text = |k| ratio(k, numbers(place, k)).map_or_else(String::new, |(_, text)| text);
    tally.measured(bound, statement, class, text)
}

/// (error + error of the reference)/bound.
fn against(found: ExpansionValue, exact: f64, reference_error: f64) -> f64 {
    ((found.value - exact).abs() + reference_error) / found.error
}

/// An orbit in the range of the law: law, first and last offset, hops, and a bound on the relative error of the last
/// offset.
struct Orbit {
    law: Decay,
    first: f64,
    last: f64,
    hops: f64,
    relative_error: f64,
    text: String,
}

fn orbit([a, b, c, d]: [f64; 4]) -> Option<Orbit> {
    let (n, mass_ratio) = (index(3.0, a), between(-4.0, 4.0, b));
    let ratio = MassRatio::new(mass_ratio).ok()?;
    let law = Decay::new(n, ratio).ok()?;
    let first = law.range() * between(-3.0, 0.0, c);
    let hops = 1 + (300.0 * d) as u32;
    let map = LiftOffMap::new(ratio);
    let mut last = first;
    for _ in 0..hops {
        last = map.hop_near_fixed_point(n, last).ok()?.next?;
    }
    let hops = f64::from(hops);
    // The map contracts, so that the errors of the hops add.
    let relative_error = LOCAL_ULPS * f64::EPSILON * hops;
    let text = format!("n = {n}, M = {mass_ratio:?}, δ₀ = {first:?}, {hops} hops");
    Some(Orbit { law, first, last, hops, relative_error, text })
}

fn decay(_: u64, numbers: [f64; 4]) -> Option<(f64, String)> {
    let Orbit { law, first, last, hops, relative_error, text } = orbit(numbers)?;
    let found = law.hops(first, last).ok()?;
    // An error of δ is one of δ^{−1/3}/r hops, times at most 1.2 (docs/theory.md, Theorem 69).
    let reference = 0.4 * relative_error / (pxfm::f_cbrt(last) * law.rate);
    Some((against(found, hops, reference), text))
}

fn offset(_: u64, numbers: [f64; 4]) -> Option<(f64, String)> {
    let Orbit { law, first, last, hops, relative_error, text } = orbit(numbers)?;
    let found = law.offset_after(first, hops).ok()?;
    Some((against(found, last, relative_error * last), text))
}

fn fixed_point(n: u64) -> Option<(f64, String)> {
    let found = fixed_point_series(n).ok()?;
    let star = FixedPointSpeed::new(n);
    let error = ((found.value - star.value()) - star.rest()).abs();
    Some((error / found.error, format!("n = {n}")))
}

fn fixed_points(k: u64, _: [f64; 4]) -> Option<(f64, String)> {
    fixed_point(k + 1)
}

fn large_indices(_: u64, [a, ..]: [f64; 4]) -> Option<(f64, String)> {
    fixed_point(index(19.0, a))
}

fn trap_lengths(_: u64, [a, b, ..]: [f64; 4]) -> Option<(f64, String)> {
    let (n, mass_ratio) = (index(4.0, a), between(-3.0, 3.0, b));
    let ratio = MassRatio::new(mass_ratio).ok()?;
    let found = trap_length_series(n, ratio).ok()?;
    let trap = Trap::new(n, ratio).ok()?;
    Some((against(found, trap.delta, trap.error), format!("n = {n}, M = {mass_ratio:?}")))
}

fn small_hops(_: u64, [a, b, ..]: [f64; 4]) -> Option<(f64, String)> {
    let alpha = SMALL_ALPHA_RANGE * between(-2.0, 0.0, a);
    let mass_ratio = between(-6.0, 6.0, b);
    let ratio = MassRatio::new(mass_ratio).ok()?;
    let found = small_hop_loss(ratio, alpha).ok()?;
    let exact = LiftOffMap::new(ratio).hop(alpha).ok()?.loss?;
    let reference = REFERENCE_ULPS * f64::EPSILON * exact;
    Some((against(found, exact, reference), format!("M = {mass_ratio:?}, α = {alpha:?}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expansions_and_local_hops_meet_their_bounds() {
        let measured = measure(300).unwrap();
        for (bound, _) in QUANTITIES {
            assert!(measured.iter().any(|found| found.bound == bound), "{bound}");
        }
        for found in measured {
            assert!(found.count > 0 && found.largest > 0.0, "{found:?}");
            assert!(found.largest <= 1.0, "{found:?}");
        }
    }
}
