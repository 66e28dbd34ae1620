//! Needles at large M: the edge of the immediate basin depends on the spacing of the scan.

use super::finding::{Finding, Table};
use super::humps_of_window::fates;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use hopper_basin::{HopperFate, ImmediateBasinEdge, crisis, immediate_basin, upper_crisis_bracket};
use hopper_figures::fate_colors;
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, csv_file, decades};

/// Spacings of the scans. A needle narrower than the spacing is missed. A scan at a tenth of the spacing takes ten
/// times as long.
const WIDTHS: [f64; 5] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5];
/// Largest mass ratio at which falls are searched for. At M = 100 the needles are already 10⁻⁴⁶ wide, far below an ulp
/// of α.
const LARGEST: f64 = 400.0;
/// Mass ratios of the table, from just above 1/M_c(1) ≈ 9.67 to a mass ratio at which every spacing misses the needles.
const RATIOS: [f64; 7] = [10.0, 11.0, 12.0, 14.0, 16.0, 20.0, 30.0];
/// Marker of each hump.
const LOOKS: [Marker; 3] = [Marker::Disc, Marker::Square, Marker::Triangle];

/// The right end of the immediate basin of α*₁, and the mass ratios from which three humps have no fall, for each
/// spacing.
pub(super) fn needles(job: &Job) -> Result<Finding, Error> {
    let humps = 3;
    let brackets = job.scan("crisis brackets", humps * WIDTHS.len(), |k| {
        let (below, above) =
            upper_crisis_bracket((k / WIDTHS.len()) as u64 + 1, WIDTHS[k % WIDTHS.len()], LARGEST)?;
        Ok(vec![below, above])
    })?;
    let mut header = vec!["$M$".to_owned()];
    header.extend(WIDTHS.iter().map(|width| format!("Δ_{{1}} down to width {width:.0e}")));
    let mut table = Table { header, rows: Vec::new() };
    for m in RATIOS {
        let fates = fates(m)?;
        let mut cells = vec![format!("{m}")];
        for width in WIDTHS {
            let found = immediate_basin(fates.map(), 1, width)?;
            cells.push(match found.edge {
                ImmediateBasinEdge::Contact | ImmediateBasinEdge::Sudden { .. } => {
                    format!("{:.10}", found.delta)
                }
                ImmediateBasinEdge::NotFound { .. } => "all of the hump".into(),
                ImmediateBasinEdge::NextFixedPoint => "all of the hump, certain".into(),
            });
        }
        table.row(cells);
    }
    let mut svg = Svg::new(640.0, 430.0);
    let frame = Frame::linear(70.0, 20.0, 540.0, 350.0, (1e-5, 1e-1), (8.0, 120.0)).log_x().log_y();
    let mut data = Vec::new();
    for n in 1..=humps as u64 {
        let color = fate_colors::css(HopperFate::label_of_fixed_point(n));
        let contact = 1.0 / crisis(n)?.mass_ratio;
        frame.polyline(
            &mut svg,
            &[(1e-5, contact), (1e-1, contact)],
            Pen::dashed(color, 0.9, "4 3"),
        );
        let mut points = Vec::new();
        for (k, width) in WIDTHS.into_iter().enumerate() {
            let found = &brackets[(n as usize - 1) * WIDTHS.len() + k];
            let (below, above) = (found[0], found[1]);
            points.push((width, 0.5 * (below + above)));
            data.push([n as f64, width, below, above]);
        }
        frame.polyline(&mut svg, &points, Pen::solid(color, 1.4));
        for &point in &points {
            svg.marker(frame.at(point), LOOKS[n as usize - 1], 7.0, color);
        }
        let key = (430.0, 44.0 + 17.0 * n as f64);
        svg.marker_key(key, LOOKS[n as usize - 1], color, &format!("hump {n}"));
    }
    svg.line((420.0, 112.0), (436.0, 112.0), Pen::dashed("#444", 0.9, "4 3"));
    svg.text(442.0, 116.0, Anchor::Start, 11.5, "1/$M$_{c}($n$): the contact part");
    frame.axes(
        &mut svg,
        &decades(frame.x, 1),
        &[10.0, 20.0, 50.0, 100.0].map(|m| (m, format!("{m}"))),
        "width looked at",
        "$M$ from which no fall is found",
    );
    Ok(Finding {
        figure: Figure::new(
            "beyond_needles",
            svg,
            vec![csv_file("needles.csv", &["hump", "width", "fall_at", "none_at"], data)?],
            &[],
        )?,
        table,
    })
}
