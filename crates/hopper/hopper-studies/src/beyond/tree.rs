//! The preimage tree of α*_1 at M = 0.2.

use super::finding::{Finding, Table};
use super::humps_of_window::{FROM, TO, fates};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{Interval, Label, PreimageTree, Refinement, ResidualSet};
use hopper_basin::{branches, hopper_basins};
use journal_figures::{Frame, Marker, Pen, Svg, csv_file, decades, ticks};
use passive_hopper::alpha_star;

/// The mass ratio of the paper's small measure.
const M: f64 = 0.2;

/// Number of levels that are drawn, and number of levels with all intervals: the number of intervals grows too fast for
/// more.
const DRAWN: usize = 20;
/// Levels whose intervals are all kept, long or short. Their number grows too fast for more.
const GROWN: usize = 10;
/// Shortest interval that is followed on the drawn levels. Shorter intervals are missing from the lengths of the
/// levels.
const SHORTEST: f64 = 1e-8;

/// Numbers and lengths of the intervals, level by level.
pub(super) fn preimage_tree(_: &Job) -> Result<Finding, Error> {
    let fates = fates(M)?;
    let refinement = Refinement { shortest: SHORTEST, undecided: 0.0, ..Refinement::default() };
    let basins = hopper_basins(&fates, FROM, TO, 400, refinement)?.basins;
    let long = |level: usize| {
        let own = basins
            .intervals()
            .iter()
            .filter(|part| part.label == Label::from(1) && part.level == Some(level));
        own.filter(|part| part.interval.length() >= SHORTEST).count()
    };
    let levels = basins.levels(1.into());
    let (resolved, total) = (basins.resolved_length(1.into()), basins.basin_length(1.into()));
    let window = Interval::new(alpha_star(FROM), alpha_star(TO))?;
    let trap = Interval::new(fates.trap(1)?.fixed_point.value(), fates.trap(1)?.right())?;
    let all = branches(&fates, FROM, TO, 400)?;
    let tree = PreimageTree::grow(&fates, &all, trap, window, GROWN)?;
    // On the first two humps the tree can be grown to level 60. This is enough to distinguish a power of the level from
    // doubling.
    let lower = Interval::new(alpha_star(1), alpha_star(3))?;
    let deep = PreimageTree::grow(&fates, &branches(&fates, 1, 3, 400)?, trap, lower, 60)?;
    let growth = match deep.residual_set() {
        ResidualSet::Countable { power } => {
            let levels = deep.complete_levels();
            format!(
                "like $k$^{{{power:.1}}} over levels {} to {} (2$k$ − 1 of them, in fact): a countable rest, where \
                 Cantor's would double",
                levels / 2,
                levels - 1
            )
        }
        other => {
            return Err(Error::CheckFailed(format!("the tree leaves no countable set: {other:?}")));
        }
    };
    let mut table = Table::new(&[
        "level $k$",
        "intervals (all)",
        "intervals over 10^{−8}",
        "length",
        "sum so far",
        "of the basin",
    ]);
    let (mut sum, mut rows) = (0.0, Vec::new());
    for (&level, &(_, length)) in levels.iter().take_while(|(level, _)| **level <= DRAWN) {
        sum += length;
        let grown = tree.counts().get(level).copied();
        let count = long(level);
        rows.push((level, count, length, sum));
        if level <= 12 || level % 6 == 0 {
            table.row([
                format!("{level}"),
                grown.map_or("–".into(), |n| format!("{n}")),
                format!("{count}"),
                format!("{length:.3e}"),
                format!("{sum:.9}"),
                format!("{:.5} %", 100.0 * sum / resolved),
            ]);
        }
    }
    let mut svg = Svg::new(640.0, 430.0);
    let frame = Frame::linear(70.0, 20.0, 480.0, 350.0, (0.0, DRAWN as f64), (1e-8, 1.0)).log_y();
    let left: Vec<_> =
        rows.iter().map(|row| (row.0 as f64, (resolved - row.3).max(1e-8))).collect();
    frame.clipped(&mut svg, |svg| frame.polyline(svg, &left, Pen::solid("#0072b2", 1.5)));
    for row in &rows {
        svg.marker(frame.at((row.0 as f64, row.2.max(1e-8))), Marker::Disc, 6.0, "#000000");
    }
    svg.marker_key((360.0, 44.0), Marker::Disc, "#000000", "length of level $k$");
    svg.line_key((360.0, 62.0), Pen::solid("#0072b2", 1.5), "length of all later levels");
    frame.axes(&mut svg, &ticks(frame.x, 4), &decades(frame.y, 1), "level $k$", "length");
    let data = rows.iter().map(|row| [row.0 as f64, row.1 as f64, row.2, row.3]);
    Ok(Finding {
        figure: Figure::new(
            "beyond_tree",
            svg,
            vec![csv_file("tree.csv", &["level", "intervals", "length", "sum"], data)?],
            &[
                ("lower", format!("{:.6}", total.lower)),
                ("upper", format!("{:.6}", total.upper)),
                ("growth", growth.to_string()),
            ],
        )?,
        table,
    })
}
