//! The circle of fates over the mass ratio, the local fractions, and their openings at crises.

use super::finding::{Finding, Table};
use super::humps_of_window::fates;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use crate::repository::Progress;
use basin_of_attraction::{Grid, Interval, Label, Refinement};
use hopper_basin::{
    CircleLimits, HopperFate, PhaseBasins, ShareRaster, Upwards, crisis, grounding, share_raster,
};
use hopper_figures::{fate_colors, share_png};
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, csv_file, decades, ticks};
use std::ops::ControlFlow;

/// The fixed points whose circles are shown.
const SHOWN: [u64; 3] = [1, 2, 3];

/// Mass ratios: up to 0.905 the circle is found from the branches of the map.
const RATIOS: (f64, f64) = (0.05, 0.9);

/// When the search for the intervals of a circle stops: a hundredth of a pixel is undecided at most. The default
/// limits take three times as long.
const LIMITS: Refinement =
    Refinement { shortest: 1e-7, undecided: 3e-5, levels: 10_000, intervals: 20_000 };

/// Pixels across: a circle takes some tenths of a second. Pixels up: they cost nothing, and no structure is lost.
const COLUMNS: usize = 200;
const ROWS: usize = 240;

/// The smallest share of a figure.
const LEAST: f64 = 1e-4;

/// The circle and the local fractions over M, for three fixed points.
pub(super) fn circle(_: &Job) -> Result<Finding, Error> {
    let mut svg = Svg::new(900.0, 520.0);
    let mut data = Vec::new();
    let header = ["$n$", "$M$", "decaying", "to $α$^{∗}_{1}", "to $α$^{∗}_{2}", "grounded"];
    let mut table = Table::new(&header);
    for (at, n) in SHOWN.into_iter().enumerate() {
        let raster = raster(n)?;
        let left = 62.0 + 282.0 * at as f64;
        let frame = Frame::linear(left, 50.0, 258.0, 230.0, RATIOS, (0.0, 1.0));
        svg.image(frame.left, frame.top, frame.width, frame.height, &share_png(&raster)?);
        let label = if at == 0 { "phase $Ψ$ mod 1" } else { "" };
        frame.axes(&mut svg, &ticks(RATIOS, 5), &shared(ticks(frame.y, 5), at), "", label);
        let title = format!("left of $α$^{{∗}}_{{{n}}}");
        svg.text(left + 129.0, 42.0, Anchor::Middle, 12.5, &title);
        let below = Frame::linear(left, 304.0, 258.0, 170.0, RATIOS, (LEAST, 1.3)).log_y();
        for (place, &own) in raster.labels().iter().enumerate() {
            let share = |column: usize| {
                let rows = (0..ROWS).filter_map(|row| raster.at(column, row));
                rows.map(|all| f64::from(all[place])).sum::<f64>() / ROWS as f64
            };
            let points: Vec<(f64, f64)> =
                (0..COLUMNS).map(|column| (raster.grid().x_at(column), share(column))).collect();
            let color = if own == Label::from(0) { "#000000" } else { fate_colors::css(own) };
            below.clipped(&mut svg, |svg| {
                for run in points.split(|point| !(point.1 > LEAST)).filter(|run| run.len() > 1) {
                    below.polyline(svg, run, Pen::solid(color, 1.6));
                }
            });
            let label = f64::from(own.code());
            data.extend(points.iter().map(|&(m, share)| [n as f64, m, label, share]));
        }
        let label = if at == 0 { "share $p$_{n,k}" } else { "" };
        let x_label = "mass ratio $M$";
        let y_ticks = shared(decades(below.y, 1), at);
        below.axes(&mut svg, &ticks(RATIOS, 5), &y_ticks, x_label, label);
    }
    legend(&mut svg);
    for (n, m) in [(1, 0.2), (2, 0.12), (2, 0.2), (3, 0.2), (1, 0.8), (2, 0.8), (3, 0.8)] {
        let found = PhaseBasins::new(&fates(m)?, n, CircleLimits::default())?.fractions();
        let cell = |label: Label| {
            let share = found.of(label);
            format!("{:.7} ± {:.0e}", share.middle(), share.half_width())
        };
        let shares = [0.into(), 1.into(), 2.into(), HopperFate::GROUNDED].map(cell);
        table.row([format!("{n}"), format!("{m}")].into_iter().chain(shares));
    }
    Ok(Finding {
        figure: Figure::new(
            "beyond_circle",
            svg,
            vec![csv_file("circle.csv", &["n", "mass_ratio", "label", "share"], data)?],
            &[],
        )?,
        table,
    })
}

/// Ticks whose labels stand at the first panel only: the panels share their axis.
fn shared(ticks: Vec<(f64, String)>, panel: usize) -> Vec<(f64, String)> {
    let label = |text: String| if panel == 0 { text } else { String::new() };
    ticks.into_iter().map(|(at, text)| (at, label(text))).collect()
}

fn raster(n: u64) -> Result<ShareRaster, Error> {
    let grid = Grid {
        x: Interval::new(RATIOS.0, RATIOS.1)?,
        y: Interval::new(0.0, 1.0)?,
        columns: COLUMNS,
        rows: ROWS,
    };
    let bar = Progress.bar("circles", COLUMNS as u64);
    let limits = CircleLimits { refinement: LIMITS, ..CircleLimits::default() };
    let raster = share_raster(n, grid, Upwards::Phase, limits, |done| {
        bar.set(done as u64);
        ControlFlow::Continue(())
    })?;
    bar.finish();
    Ok(raster)
}

fn legend(svg: &mut Svg) {
    for (at, label) in [0.into(), 1.into(), 2.into(), HopperFate::GROUNDED].into_iter().enumerate()
    {
        let x = 62.0 + 90.0 * at as f64;
        svg.fill_rect(x, 10.0, 12.0, 12.0, fate_colors::css(label));
        svg.rect(x, 10.0, 12.0, 12.0, Pen::solid("#000", 0.6));
        svg.text(x + 17.0, 20.5, Anchor::Start, 11.5, &fate_colors::name(label));
    }
}

/// A mass ratio from which a share opens: left of α*_n all speeds have the fate `label` below it.
struct Opening {
    n: u64,
    label: Label,
    from: f64,
    text: &'static str,
    look: (Marker, &'static str),
}

/// The square roots with which the local fractions open at a crisis.
pub(super) fn openings(job: &Job) -> Result<Finding, Error> {
    let all = [
        Opening {
            n: 1,
            label: Label::from(0),
            from: grounding(0)?.mass_ratio,
            text: "left of $α$^{∗}_{1}: grounded, from $M$ = 0.3275",
            look: (Marker::Disc, "#22a672"),
        },
        Opening {
            n: 2,
            label: Label::from(1),
            from: crisis(1)?.mass_ratio,
            text: "left of $α$^{∗}_{2}: not to $α$^{∗}_{1}, from $M$_{c}(1)",
            look: (Marker::Square, "#d03a2b"),
        },
        Opening {
            n: 3,
            label: Label::from(2),
            from: crisis(2)?.mass_ratio,
            text: "left of $α$^{∗}_{3}: not to $α$^{∗}_{2}, from $M$_{c}(2)",
            look: (Marker::Triangle, "#1f4e96"),
        },
    ];
    let distance = |k: usize| pxfm::f_exp10(-9.0 + 0.5 * k as f64);
    let count = 16;
    let scan = job.scan("openings", all.len() * count, |at| {
        let opening = &all[at / count];
        let fates = fates(opening.from + distance(at % count))?;
        let found = PhaseBasins::new(&fates, opening.n, CircleLimits::default())?.fractions();
        // The share of the other fates with its bounds.
        let own = found.of(opening.label);
        Ok(vec![1.0 - own.middle(), 1.0 - own.upper, 1.0 - own.lower])
    })?;
    let mut svg = Svg::new(860.0, 400.0);
    let left = Frame::linear(70.0, 34.0, 350.0, 310.0, (1e-9, 0.1), (1e-5, 1.0)).log_x().log_y();
    let right = Frame::linear(500.0, 34.0, 340.0, 310.0, (1e-9, 0.1), (0.0, 10.0)).log_x();
    svg.text(left.left, 22.0, Anchor::Start, 13.0, "(a)  share of all other fates");
    svg.text(right.left, 22.0, Anchor::Start, 13.0, "(b)  divided by the square root");
    let mut table = Table::new(&["$n$", "$M$_{0}", "share at 10^{−9}", "at 10^{−5}", "$C$"]);
    let mut data = Vec::new();
    for ((at, opening), rows) in all.iter().enumerate().zip(scan.chunks(count)) {
        let points: Vec<(f64, f64)> =
            rows.iter().enumerate().map(|(k, row)| (distance(k), row[0])).collect();
        let (marker, color) = opening.look;
        // The share is C √y + C₁ y + …: two neighbours give C without the second term.
        let ratio = |k: usize| points[k].1 / points[k].0.sqrt();
        let root = (distance(5) / distance(3)).sqrt();
        let constant = (root * ratio(3) - ratio(5)) / (root - 1.0);
        for &(y, share) in &points {
            left.clipped(&mut svg, |svg| svg.marker(left.at((y, share)), marker, 6.5, color));
            svg.marker(right.at((y, share / y.sqrt())), marker, 6.5, color);
        }
        let ends = [1e-9, 1e-2].map(|y: f64| (y, constant * y.sqrt()));
        left.polyline(&mut svg, &ends, Pen::dashed(color, 1.0, "5 3"));
        right.polyline(
            &mut svg,
            &[(1e-9, constant), (0.1, constant)],
            Pen::dashed(color, 1.0, "5 3"),
        );
        let key = (left.left + 14.0, 50.0 + 17.0 * at as f64);
        svg.marker_key(key, marker, color, opening.text);
        table.row([
            format!("{}", opening.n),
            format!("{:.10}", opening.from),
            format!("{:.4e}", points[0].1),
            format!("{:.6e}", points[8].1),
            format!("{constant:.4}"),
        ]);
        let row =
            |(k, row): (usize, &Vec<f64>)| [&[opening.n as f64, distance(k)], &row[..]].concat();
        data.extend(rows.iter().enumerate().map(row));
    }
    let x_label = "$M$ − $M$_{0}";
    left.axes(&mut svg, &decades(left.x, 2), &decades(left.y, 1), x_label, "share");
    right.axes(
        &mut svg,
        &decades(right.x, 2),
        &ticks(right.y, 5),
        x_label,
        "share / √($M$ − $M$_{0})",
    );
    let header = ["n", "distance", "share", "lower", "upper"];
    Ok(Finding {
        figure: Figure::new(
            "beyond_openings",
            svg,
            vec![csv_file("openings.csv", &header, data)?],
            &[],
        )?,
        table,
    })
}
