//! The boundary of the basins: a countable set of box dimension one quarter.

use super::finding::{Finding, Table};
use super::humps_of_window::{estimate, fates, hump, label, three};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{
    FractionRange, IntervalBasins, PowerLaw, Refinement, SplitMix64, occupied_boxes, power_law,
    uncertain_fraction,
};
use hopper_asymptotics::{Coefficients, Form, LEFT_FACTOR};
use hopper_basin::hopper_basins;
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, csv_file, decades, ticks};
use passive_hopper::{LiftOffMap, MassRatio};

/// The mass ratio at which the paper measures 0.037. Most of the window falls through the traps, so that the boundary
/// has many points.
const M: f64 = 0.2;

/// Shortest part whose preimages are computed: a hundred ulps of α. Below this length rounding decides.
const SHORTEST: f64 = 1e-13;

/// Gaps between parts that are shorter than this count as roundings: ten of the shortest parts.
const RESOLUTION: f64 = 1e-12;

/// Humps whose boundary is counted.
const HUMPS: [u64; 3] = [1, 2, 3];

/// Marker and colour of each hump.
const LOOKS: [(Marker, &str); 3] =
    [(Marker::Disc, "#22a672"), (Marker::Square, "#d03a2b"), (Marker::Triangle, "#1f4e96")];

fn basins() -> Result<IntervalBasins, Error> {
    let refinement = Refinement {
        shortest: SHORTEST,
        undecided: 1e-12,
        levels: 1_000_000,
        intervals: 4_000_000,
    };
    Ok(hopper_basins(&fates(M)?, 1, 4, 400, refinement)?.basins)
}

/// Box counts with their local slopes, and the accumulation at a fixed point.
pub(super) fn boundary(_: &Job) -> Result<Finding, Error> {
    let basins = basins()?;
    let mut svg = Svg::new(860.0, 400.0);
    let frame = Frame::linear(66.0, 34.0, 350.0, 310.0, (1e-16, 1e-1), (0.0, 0.6)).log_x();
    frame.polyline(&mut svg, &[(1e-16, 0.25), (1e-1, 0.25)], Pen::dashed("#555", 1.0, "5 3"));
    svg.text(frame.left + 6.0, frame.at((1e-16, 0.25)).1 - 6.0, Anchor::Start, 11.5, "1/4");
    let mut table = Table::new(&[
        "hump",
        "boundary points",
        "boxes at 10^{−4}",
        "at 10^{−7}",
        "at 10^{−10}",
        "local slope, 10^{−2} … 10^{−3}",
        "10^{−5} … 10^{−6}",
        "10^{−9} … 10^{−10}",
        "the fit over all scales",
    ]);
    let mut data = Vec::new();
    for (n, (marker, color)) in HUMPS.into_iter().zip(LOOKS) {
        let part = basins.within(hump(n)?)?;
        let points = part.boundary(RESOLUTION);
        let left = part.window().left;
        let sizes = (0..=18).map(|k| pxfm::f_exp10(-10.0 + 0.5 * f64::from(k)));
        let counts = box_counts(&points, left, sizes, 0.0)?;
        let law = power_law(&[&counts])?;
        // Counts are half a decade apart. The mean of two local slopes is the slope over a decade.
        for (k, pair) in law.local.chunks(2).enumerate() {
            let [a, b] = *pair else { continue };
            let size = pxfm::f_exp10(-9.5 + k as f64);
            let at = frame.at((size, (-0.5 * (a + b)).clamp(0.0, 0.6)));
            svg.marker(at, marker, 7.0, color);
            data.push([n as f64, size, counts[2 * k + 1].1, -0.5 * (a + b)]);
        }
        let slope = |k: usize| format!("{:.3}", -0.5 * (law.local[k] + law.local[k + 1]));
        let boxes = |k: usize| format!("{}", counts[k].1);
        table.row([
            format!("{n}"),
            format!("{}", points.len()),
            boxes(12),
            boxes(6),
            boxes(0),
            slope(14),
            slope(8),
            slope(0),
            fit(&power_law(&at_random_offsets(&points, left, &counts)?)?),
        ]);
        let key = (frame.left + 16.0, 50.0 + 17.0 * (n as f64 - 1.0));
        svg.marker_key(key, marker, color, &format!("all of hump {n}"));
    }
    let generations = generations()?;
    single(&mut svg, &frame, &generations)?;
    svg.text(frame.left, 22.0, Anchor::Start, 13.0, "(a)  local slope of the box count");
    frame.axes(
        &mut svg,
        &decades(frame.x, 3),
        &ticks(frame.y, 6),
        "size of a box $ε$",
        "−d ln $N$ / d ln $ε$",
    );
    generations_against_law(&mut svg, &generations)?;
    Ok(Finding {
        figure: Figure::new(
            "beyond_boundary",
            svg,
            vec![csv_file("boundary.csv", &["hump", "box_size", "boxes", "local_slope"], data)?],
            &[],
        )?,
        table,
    })
}

/// Random offsets of the boxes for the interval of a fit.
const OFFSETS: u64 = 16;

/// The counts again, at the same sizes, with boxes at random offsets.
fn at_random_offsets(
    points: &[f64],
    left: f64,
    counts: &[(f64, f64)],
) -> Result<Vec<Vec<(f64, f64)>>, Error> {
    let random = SplitMix64::from_seed(1);
    let sizes = || counts.iter().map(|&(size, _)| size);
    (0..OFFSETS).map(|k| box_counts(points, left, sizes(), random.uniform(k))).collect()
}

/// Sizes of boxes, with the number of boxes that hold a point. Boxes begin a part of their size left of `left`.
fn box_counts(
    points: &[f64],
    left: f64,
    sizes: impl Iterator<Item = f64>,
    part: f64,
) -> Result<Vec<(f64, f64)>, Error> {
    let count = |size: f64| Ok((size, occupied_boxes(points, left - part * size, size)? as f64));
    sizes.map(count).collect()
}

fn fit(law: &PowerLaw) -> String {
    let exponent = -law.exponent;
    match law.interval {
        Ok(interval) => format!("{exponent:.3} ± {:.3}", interval.half_width()),
        Err(reason) => format!("{exponent:.3}, no interval: {reason}"),
    }
}

/// The fixed point at which generations are followed.
const N: u64 = 2;
/// Number of generations that are followed: enough for four decades of the approach to the law.
const GENERATIONS: usize = 30_000;

/// The backward orbit of one boundary point towards α*₂ from the left, as distances from it.
fn generations() -> Result<Vec<f64>, Error> {
    let map = LiftOffMap::new(MassRatio::new(M)?);
    let mut delta: f64 = 0.05;
    let mut generations = Vec::with_capacity(GENERATIONS);
    for _ in 0..GENERATIONS {
        // On this side a hop leads away from α*. The preimage of −delta is therefore nearer, in (−delta, 0). The
        // bisection ends when no number lies between its ends.
        let (mut near, mut far) = (0.0f64, delta);
        loop {
            let middle = 0.5 * (near + far);
            if middle <= near || middle >= far {
                break;
            }
            let image =
                map.hop_near_fixed_point(N, -middle)?.next.map_or(f64::INFINITY, |next| -next);
            if image < delta { near = middle } else { far = middle }
        }
        delta = far;
        generations.push(delta);
    }
    Ok(generations)
}

/// Local slopes of the box count of one accumulation.
fn single(svg: &mut Svg, frame: &Frame, generations: &[f64]) -> Result<(), Error> {
    let sizes = (0..=14).map(|k| pxfm::f_exp10(-16.0 + f64::from(k)));
    let counts = box_counts(generations, 0.0, sizes, 0.0)?;
    let law = power_law(&[counts])?;
    let middle = |(k, slope): (usize, &f64)| (pxfm::f_exp10(-15.5 + k as f64), -slope);
    let slopes: Vec<(f64, f64)> = law.local.iter().enumerate().map(middle).collect();
    frame.clipped(svg, |svg| frame.polyline(svg, &slopes, Pen::solid("#888", 0.9)));
    for &slope in &slopes {
        svg.marker(frame.at(slope), Marker::Ring, 7.0, "#444444");
    }
    let key = (frame.left + 16.0, 101.0);
    svg.marker_key(key, Marker::Ring, "#444444", "one accumulation, at $α$^{∗}_{2}");
    Ok(())
}

/// The generations divided by their law, (3/(10λk))³.
fn generations_against_law(svg: &mut Svg, generations: &[f64]) -> Result<(), Error> {
    let lambda = Coefficients::new(N, MassRatio::new(M)?, Form::Corrected)?.lambda;
    let ratio = |k: usize| {
        let law = 3.0 / (LEFT_FACTOR * lambda * k as f64);
        (k as f64, generations[k - 1] / (law * law * law))
    };
    let chosen = (1..=GENERATIONS).filter(|k| k % (k / 10).max(1) == 0);
    let points: Vec<_> = chosen.map(ratio).collect();
    let frame = Frame::linear(490.0, 34.0, 340.0, 310.0, (1.0, GENERATIONS as f64), (0.5, 1e3))
        .log_x()
        .log_y();
    svg.text(frame.left, 22.0, Anchor::Start, 13.0, "(b)  generations left of $α$^{∗}_{2}");
    frame.polyline(svg, &[(1.0, 1.0), (GENERATIONS as f64, 1.0)], Pen::dashed("#555", 1.0, "5 3"));
    frame.clipped(svg, |svg| frame.polyline(svg, &points, Pen::solid("#000", 1.7)));
    let label = "$δ$_{$k$} / (3/(10$λk$))^{3}";
    frame.axes(svg, &decades(frame.x, 1), &decades(frame.y, 1), "generation $k$", label);
    Ok(())
}

/// The uncertainty exponent, from the scales of a plot down to 10⁻¹⁰.
pub(super) fn uncertainty(job: &Job) -> Result<Finding, Error> {
    let basins = basins()?;
    let window = basins.window();
    let fates = fates(M)?;
    let rows = job.scan("uncertain starts", 6, |k| {
        let epsilon = pxfm::f_exp10(-2.0 - k as f64);
        // Uncertain starts are rarer at a smaller ε. More points keep their relative error.
        let count = 50_000 << k.min(4);
        let fraction =
            uncertain_fraction(window, epsilon, count, 7 + k as u64, |x| label(&fates, x))?;
        Ok([&[epsilon], &three(fraction.into())[..]].concat())
    })?;
    let sampled: Vec<(f64, FractionRange)> =
        rows.iter().map(|row| (row[0], estimate(&row[1..]))).collect();
    let mut widest: f64 = 0.0;
    let exact: Vec<(f64, f64)> = (0..=16)
        .map(|k| {
            let epsilon = pxfm::f_exp10(-10.0 + 0.5 * f64::from(k));
            let fraction = basins.uncertain_fraction(epsilon, RESOLUTION)?;
            widest = widest.max(fraction.half_width() / fraction.middle());
            Ok((epsilon, fraction.middle()))
        })
        .collect::<Result<_, Error>>()?;
    let law = power_law(&[&exact])?;
    let mut svg = Svg::new(640.0, 430.0);
    let frame = Frame::linear(70.0, 20.0, 540.0, 350.0, (1e-10, 1e-1), (1e-8, 1.0)).log_x().log_y();
    let guide: Vec<_> =
        [1e-10, 1e-3].into_iter().map(|e: f64| (e, 2e-8 * pxfm::f_pow(e / 1e-10, 0.75))).collect();
    frame.clipped(&mut svg, |svg| {
        frame.polyline(svg, &guide, Pen::dashed("#555", 1.0, "5 3"));
        frame.curve(svg, &exact, Pen::solid("#0072b2", 1.7));
        for (epsilon, fraction) in &sampled {
            svg.marker(frame.at((*epsilon, fraction.value)), Marker::Disc, 6.0, "#000000");
        }
    });
    let bars = sampled.iter().map(|(epsilon, part)| (*epsilon, part.lower, part.upper));
    frame.bars(&mut svg, bars, Pen::solid("#000", 1.0));
    svg.text(frame.at((1e-7, 1.0)).0, frame.at((1.0, 9e-7)).1, Anchor::Start, 12.0, "slope 3/4");
    let near = "within $ε$ of the boundary, from the intervals";
    svg.line_key((104.0, 42.0), Pen::solid("#0072b2", 1.7), near);
    let pairs = "fate changes with ±$ε$, pairs of random starts, 95 %";
    svg.marker_key((104.0, 60.0), Marker::Disc, "#000000", pairs);
    frame.axes(
        &mut svg,
        &decades(frame.x, 2),
        &decades(frame.y, 2),
        "error of the start $ε$",
        "fraction of uncertain starts",
    );
    let mut table = Table::new(&[
        "$ε$",
        "uncertain (pairs, 95 %)",
        "near the boundary (intervals)",
        "local exponent",
    ]);
    for (k, (epsilon, fraction)) in exact.iter().enumerate().step_by(2) {
        let pairs = sampled.iter().find(|(e, _)| (e / epsilon - 1.0).abs() < 1e-9);
        let slope = law.local.get(k).map_or("–".into(), |slope| format!("{slope:.3}"));
        table.row([
            format!("{epsilon:.0e}"),
            pairs
                .map_or("–".into(), |(_, s)| format!("{:.2e} ± {:.0e}", s.value, s.half_width())),
            format!("{fraction:.3e}"),
            slope,
        ]);
    }
    let data = exact.iter().map(|&(epsilon, fraction)| [epsilon, fraction]);
    Ok(Finding {
        figure: Figure::new(
            "beyond_uncertainty",
            svg,
            vec![csv_file("uncertainty.csv", &["epsilon", "fraction"], data)?],
            &[("widest", format!("{widest:.0e}"))],
        )?,
        table,
    })
}
