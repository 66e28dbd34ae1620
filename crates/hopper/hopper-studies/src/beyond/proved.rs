//! The basins of Fig. 6, every cell proved.

use super::finding::{Finding, Table};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use crate::proved_figure::{StoredStrips, fig_6};
use basin_of_attraction::{Grid, Interval};
use hopper_figures::fate_colors;
use journal_figures::csv_file;

/// Cells each way. Four times as many leave a third as much open, and take some ten minutes (`cargo xtask prove
/// fig6-cells`).
const SIDE: usize = 256;

/// Bounds on the area of each basin, and the picture of what is proved.
pub(super) fn proved_basins(job: &Job) -> Result<Finding, Error> {
    let window = fig_6();
    let ((light, heavy), (bottom, top)) = window;
    let (x, y) = (Interval::new(light, heavy)?, Interval::new(bottom, top)?);
    let grid = Grid { x, y, columns: SIDE, rows: SIDE };
    let (found, svg) = StoredStrips::new("proved", grid, 1, job).cells("beyond_proved", window)?;
    let areas = found.areas();
    let mut table = Table::new(&["basin", "area at least", "area at most"]);
    for (label, share) in &areas {
        let percent = |share: f64| format!("{:.3} %", 100.0 * share);
        table.row([fate_colors::name(*label), percent(share.low()), percent(share.high())]);
    }
    let rows =
        areas.iter().map(|(label, share)| [f64::from(label.code()), share.low(), share.high()]);
    let data = vec![csv_file("proved.csv", &["label", "area_lower", "area_upper"], rows)?];
    Ok(Finding {
        figure: Figure::new(
            "beyond_proved",
            svg,
            data,
            &[("side", SIDE.to_string()), ("open", format!("{:.1}", 100.0 * found.open_area()))],
        )?,
        table,
    })
}
