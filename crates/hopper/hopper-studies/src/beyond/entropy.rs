//! Basin entropy against the mass ratio.

use super::finding::{Finding, Table};
use super::humps_of_window::{FROM, TO, by_humps, fates, geometric, label};
use super::measure::ratio_ticks;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{Hyperrectangle, Interval, region_boxes};
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, ticks};

/// Boxes on the five humps, and starts in each box. Entropies of boxes depend on their size: 100 boxes a hump. With 100
/// starts the computed entropy of f fates is too small by about (f − 1)/200.
const BOXES: usize = 500;
const STARTS: usize = 100;
const SEED: u64 = 1;

/// Entropies from M = 0.02 to 50.
pub(super) fn entropy_of_basins(job: &Job) -> Result<Finding, Error> {
    let ratios = geometric(0.02, 50.0, 101);
    let humps = Hyperrectangle::try_from(Interval::new(0.0, (TO - FROM) as f64)?)?;
    let scan = job.scan("entropies", ratios.len(), |k| {
        let fates = fates(ratios[k])?;
        let of_place = |place: &[f64]| label(&fates, by_humps(place[0]));
        let found = region_boxes(&humps, BOXES, STARTS, SEED, of_place)?;
        let boundary = found.boundary_entropy().unwrap_or(0.0);
        Ok(vec![ratios[k], found.basin_entropy(), boundary, found.mixed as f64])
    })?;
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
    let curves = [
        (Pen::solid("#0072b2", 1.8), "basin entropy"),
        (Pen::dashed("#d55e00", 1.8, "7 3"), "boundary entropy (mixed boxes only)"),
    ];
    for (k, (pen, name)) in curves.into_iter().enumerate() {
        let points: Vec<_> = scan.iter().map(|row| (row[0], row[1 + k])).collect();
        frame.polyline(&mut svg, &points, pen);
        svg.line_key((95.0, 40.0 + 18.0 * k as f64), pen, name);
    }
    frame.axes(&mut svg, &ratio_ticks(), &ticks(frame.y, 5), "mass ratio $M$", "entropy");
    let mut table = Table::new(&["$M$", "basin entropy", "boundary entropy", "mixed boxes of 500"]);
    for row in scan.iter().step_by(10) {
        let boundary = if row[3] > 0.0 { format!("{:.3}", row[2]) } else { "–".into() };
        table.row([
            format!("{:.3}", row[0]),
            format!("{:.3}", row[1]),
            boundary,
            format!("{}", row[3]),
        ]);
    }
    Ok(Finding {
        figure: Figure::new(
            "beyond_entropy",
            svg,
            vec![csv_file(
                "entropy.csv",
                &["mass_ratio", "basin_entropy", "boundary_entropy", "mixed_boxes"],
                scan,
            )?],
            &[],
        )?,
        table,
    })
}
