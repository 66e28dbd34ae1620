//! Basin entropy against the mass ratio.

use super::finding::{Finding, Table};
use super::humps_of_window::{FROM, TO, by_humps, fates, geometric, label};
use super::measure::ratio_ticks;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{Label, entropy};
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, ticks};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Boxes on the five humps, and starts in each box. Entropies of boxes depend on their size: 100 boxes a hump. With 100
/// starts the computed entropy of f fates is too small by about (f − 1)/200.
const BOXES: usize = 500;
const STARTS: usize = 100;

/// M, basin entropy, boundary entropy, number of mixed boxes.
type EntropyRow = (f64, f64, f64, f64);

/// The mean entropy over all boxes and over the mixed boxes, and the number of mixed boxes. A box is mixed if its
/// starts have more than one fate.
fn entropies(mass_ratio: f64) -> Result<(f64, f64, usize), Error> {
    let fates = fates(mass_ratio)?;
    let humps = (TO - FROM) as f64;
    let of_box = |number: usize| {
        let mut counts: BTreeMap<Label, usize> = BTreeMap::new();
        for start in 0..STARTS {
            let part = (number as f64 + (start as f64 + 0.5) / STARTS as f64) / BOXES as f64;
            *counts.entry(label(&fates, by_humps(humps * part))).or_insert(0) += 1;
        }
        (counts.len() > 1).then(|| entropy(counts.values().map(|&n| n as f64 / STARTS as f64)))
    };
    let mixed: Vec<f64> =
        (0..BOXES).into_par_iter().map(of_box).collect::<Vec<_>>().into_iter().flatten().collect();
    let sum = mixed.iter().fold(0.0, |sum, entropy| sum + entropy);
    let boundary = if mixed.is_empty() { 0.0 } else { sum / mixed.len() as f64 };
    Ok((sum / BOXES as f64, boundary, mixed.len()))
}

/// Entropies from M = 0.02 to 50.
pub(super) fn entropy_of_basins(job: &Job) -> Result<Finding, Error> {
    let ratios = geometric(0.02, 50.0, 101);
    let scan = job.scan("entropies", ratios.len(), |k| {
        let (whole, boundary, mixed) = entropies(ratios[k])?;
        Ok(vec![whole, boundary, mixed as f64])
    })?;
    let rows: Vec<EntropyRow> =
        ratios.iter().zip(&scan).map(|(&m, row)| (m, row[0], row[1], row[2])).collect();
    let mut svg = Svg::new(640.0, 430.0);
    let frame = Frame::linear(62.0, 20.0, 550.0, 350.0, (0.02, 50.0), (0.0, 1.0)).log_x();
    let ln_2 = std::f64::consts::LN_2;
    frame.polyline(&mut svg, &[(0.02, ln_2), (50.0, ln_2)], Pen::dashed("#555", 1.0, "5 3"));
    svg.text(
        frame.left + frame.width - 6.0,
        frame.at((1.0, ln_2)).1 - 5.0,
        Anchor::End,
        11.5,
        "ln 2",
    );
    type EntropyCurve = fn(&EntropyRow) -> f64;
    let curves: [(EntropyCurve, Pen, &str); 2] = [
        (|row| row.1, Pen::solid("#0072b2", 1.8), "basin entropy"),
        (|row| row.2, Pen::dashed("#d55e00", 1.8, "7 3"), "boundary entropy (mixed boxes only)"),
    ];
    for (k, (column, pen, name)) in curves.into_iter().enumerate() {
        let points: Vec<_> = rows.iter().map(|row| (row.0, column(row))).collect();
        frame.polyline(&mut svg, &points, pen);
        let y = 40.0 + 18.0 * k as f64;
        svg.line((80.0, y), (110.0, y), pen);
        svg.text(116.0, y + 4.0, Anchor::Start, 11.5, name);
    }
    frame.axes(&mut svg, &ratio_ticks(), &ticks(frame.y, 5), "mass ratio $M$", "entropy");
    let mut table = Table::new(&["$M$", "basin entropy", "boundary entropy", "mixed boxes of 500"]);
    for row in rows.iter().step_by(10) {
        table.row([
            format!("{:.3}", row.0),
            format!("{:.3}", row.1),
            if row.3 > 0.0 { format!("{:.3}", row.2) } else { "–".into() },
            format!("{}", row.3),
        ]);
    }
    let data = rows.iter().map(|r| vec![Some(r.0), Some(r.1), Some(r.2), Some(r.3)]);
    Ok(Finding {
        figure: Figure {
            name: "beyond_entropy",
            title: "Basin entropy against the mass ratio".into(),
            paper: "No measure of the mixing of basins is given.".into(),
            notes: "500 boxes on the five humps of [$α$^{∗}_{1}, $α$^{∗}_{6}], 100 starts in each, natural \
                    logarithms; all fates count, decaying and grounded too. From 100 starts an entropy comes out low by \
                    about (fates − 1)/200 a mixed box, and a box is mixed only if a start shows it. Grounding, possible from $M$ = 0.3275 \
                    to the inverse of that, lifts both. The boundary entropy stays under ln 2 but at some \
                    large $M$; above it, elsewhere, is taken for a proof of a fractal boundary: at a fixed size \
                    of boxes it is none, since this boundary is countable."
                .into(),
            svg,
            data: vec![csv_file(
                "entropy.csv",
                &["mass_ratio", "basin_entropy", "boundary_entropy", "mixed_boxes"],
                data,
            )?],
        },
        table,
    })
}
