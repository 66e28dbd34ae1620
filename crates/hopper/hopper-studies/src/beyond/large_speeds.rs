//! Final-state uncertainty at large speeds, and whether the basins are riddled.

use super::finding::{Finding, Table};
use super::humps_of_window::{
    estimate, fates, fraction_curve, hump, is_incessant, label, percent, three,
};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{FractionRange, Label, random_fractions, uncertain_fraction};
use hopper_basin::HopperFate;
use hopper_figures::fate_colors;
use journal_figures::{Frame, Marker, Pen, Svg, csv_file, decades};

/// The mass ratio of the paper's small measure.
const M: f64 = 0.2;
/// The humps, each ten times the one before. On hump 10 000 an orbit takes thousands of hops, and α has an ulp of
/// 4e-12.
const HUMPS: [u64; 5] = [1, 10, 100, 1000, 10_000];
/// Errors ε of the start: 10⁻¹ to 10⁻⁸, one for each decade. The last one is still 2500 ulps of α on hump 10 000. A
/// smaller one would be compared with rounding, and takes as long as the others.
const DECADES: usize = 8;
/// Random starts on a hump. Orbits from high humps take thousands of hops, so that fewer are affordable.
fn starts(n: u64) -> usize {
    if n > 100 { 2_000 } else { 20_000 }
}

/// Marker of each hump.
const LOOKS: [Marker; 5] =
    [Marker::Disc, Marker::Square, Marker::Triangle, Marker::Diamond, Marker::Wedge];

/// The fraction of uncertain starts against ε, hump by hump.
pub(super) fn large_speeds(job: &Job) -> Result<Finding, Error> {
    let fates = fates(M)?;
    let scan = job.scan("large speeds", HUMPS.len() * DECADES, |k| {
        let (n, decade) = (HUMPS[k / DECADES], k % DECADES + 1);
        let at = |x: f64| if x > 0.0 { label(&fates, x) } else { Label::from(0) };
        let epsilon = pxfm::f_exp10(-(decade as f64));
        let fraction = uncertain_fraction(hump(n)?, epsilon, starts(n), n, at)?;
        Ok([&[epsilon], &three(fraction.into())[..]].concat())
    })?;
    let mut svg = Svg::new(640.0, 430.0);
    let frame = Frame::linear(70.0, 20.0, 440.0, 350.0, (1e-9, 1e-1), (1e-5, 1.0)).log_x().log_y();
    let mut table = Table::new(&[
        "hump $n$",
        "$α$ about",
        "incessant (95 %)",
        "uncertain at $ε$ = 10^{−2}",
        "at 10^{−4}",
        "at 10^{−6}",
        "at 10^{−8}",
    ]);
    let mut data = Vec::new();
    for (k, n) in HUMPS.into_iter().enumerate() {
        let window = hump(n)?;
        let rows = &scan[k * DECADES..(k + 1) * DECADES];
        let points: Vec<(f64, FractionRange)> =
            rows.iter().map(|row| (row[0], estimate(&row[1..]))).collect();
        data.extend(rows.iter().map(|row| [&[n as f64], &row[..]].concat()));
        let color = fate_colors::css(HopperFate::label_of_fixed_point(k as u64 + 1));
        fraction_curve(&mut svg, &frame, &points, Pen::solid(color, 1.2));
        for (epsilon, fraction) in points.iter().filter(|(_, fraction)| fraction.value > 0.0) {
            svg.marker(frame.at((*epsilon, fraction.value)), LOOKS[k], 6.5, color);
        }
        let key = (430.0, 250.0 + 17.0 * k as f64);
        svg.marker_key(key, LOOKS[k], color, &format!("$n$ = {n}"));
        let incessant = random_fractions(window, starts(n), n, |x| {
            Label::from(is_incessant(label(&fates, x)))
        })?;
        let cell = |decade: usize| percent(&points[decade - 1].1);
        table.row([
            format!("{n}"),
            format!("{:.1}", window.left),
            incessant
                .get(&Label::from(1))
                .map_or("0".into(), |&fraction| percent(&fraction.into())),
            cell(2),
            cell(4),
            cell(6),
            cell(8),
        ]);
    }
    frame.axes(
        &mut svg,
        &decades(frame.x, 2),
        &decades(frame.y, 1),
        "error of the start $ε$",
        "fraction of uncertain starts",
    );
    Ok(Finding {
        figure: Figure::new(
            "beyond_large_speeds",
            svg,
            vec![csv_file(
                "large_speeds.csv",
                &["hump", "epsilon", "fraction", "lower", "upper"],
                data,
            )?],
            &[],
        )?,
        table,
    })
}
