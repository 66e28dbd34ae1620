//! The errors of the loss near α*₁: where the printed form of the map loses its digits.

use crate::error::Error;
use crate::figure::Figure;
use crate::repository::{Progress, number, parse_rows, repository};
use hopper_asymptotics::{Coefficients, Form, LeftExpansion, RightExpansion};
use journal_figures::{Anchor, Frame, Marker, Svg, csv_file, decades};
use passive_hopper::{LiftOffMap, MassRatio, printed_image};
use serde_json::Value;

/// The reference values, from the root of the repository.
const VALUES: &str = "crates/hopper/passive-hopper/tests/data/losses_near_first_fixed_point.jsonl";
/// Range of |δ|: from below an ulp of α* to the edge of the expansions.
const OFFSETS: (f64, f64) = (1e-16, 1e-1);
/// Range of the errors. Errors outside are drawn on the edge.
const ERRORS: (f64, f64) = (1e-17, 1e5);

/// Name, marker, colour and column of each form. The first two are evaluated at α, the others at δ.
const FORMS: [(&str, Marker, &str, &str); 6] = [
    ("printed form", Marker::Diamond, "#d55e00", "printed"),
    ("stable form", Marker::Disc, "#000000", "stable"),
    ("($n$, $δ$) form", Marker::Square, "#0072b2", "local"),
    ("expansion, all orders", Marker::Triangle, "#e69f00", "expansion"),
    ("leading order, corrected $λ$", Marker::Wedge, "#009e73", "leading_corrected"),
    ("leading order, printed $λ$", Marker::Cross, "#9b4f80", "leading_printed"),
];

/// An offset with the relative error of each form; `None` where the form has no value.
struct ErrorRow {
    offset: f64,
    errors: [Option<f64>; 6],
}

/// Draws the errors on both sides of α*₁.
pub(super) fn build(_: &Progress) -> Result<Figure, Error> {
    let rows: Vec<ErrorRow> =
        parse_rows(&repository().join(VALUES))?.iter().map(row).collect::<Result<_, _>>()?;
    let mut svg = Svg::new(800.0, 430.0);
    for (k, (sign, name)) in
        [(-1.0, "left: $δ$ < 0"), (1.0, "right: $δ$ > 0")].into_iter().enumerate()
    {
        let left = 64.0 + 372.0 * k as f64;
        let frame = Frame::linear(left, 30.0, 340.0, 290.0, OFFSETS, ERRORS).log_x().log_y();
        svg.text(left + 170.0, 20.0, Anchor::Middle, 13.0, name);
        side(&mut svg, &frame, rows.iter().filter(|row| row.offset * sign > 0.0));
        let mut y_ticks = decades(ERRORS, 2);
        if k > 0 {
            y_ticks.iter_mut().for_each(|(_, label)| label.clear());
        }
        let y_label = if k > 0 { "" } else { "relative error of the loss $α$ − $α$′" };
        frame.axes(
            &mut svg,
            &decades(OFFSETS, 3),
            &y_ticks,
            "|$δ$| = |$α$ − $α$^{∗}_{1}|",
            y_label,
        );
    }
    for (k, (name, marker, color, _)) in FORMS.into_iter().enumerate() {
        let (x, y) = (90.0 + 250.0 * (k / 2) as f64, 385.0 + 20.0 * (k % 2) as f64);
        svg.marker_key((x, y - 4.0), marker, color, name);
    }
    let columns: Vec<&str> = std::iter::once("offset").chain(FORMS.map(|form| form.3)).collect();
    let data =
        rows.iter().map(|row| std::iter::once(Some(row.offset)).chain(row.errors.iter().copied()));
    Figure::new(
        "printed_against_stable",
        svg,
        vec![csv_file("printed_against_stable.csv", &columns, data)?],
        &[],
    )
}

fn side<'a>(svg: &mut Svg, frame: &Frame, rows: impl Iterator<Item = &'a ErrorRow>) {
    let points: Vec<_> = rows.collect();
    for (form, (_, marker, color, _)) in FORMS.into_iter().enumerate() {
        for row in &points {
            let Some(error) = row.errors[form] else { continue };
            let at = frame.at((row.offset.abs(), error.clamp(ERRORS.0, ERRORS.1)));
            svg.marker(at, marker, 4.2, color);
        }
    }
}

fn row(row: &Value) -> Result<ErrorRow, Error> {
    let field = |key| number(row, key).map_err(|reason| Error::Reference { reason });
    let (offset, alpha) = (field("offset")?, field("alpha")?);
    let exact = field("offset_loss")?;
    let map = LiftOffMap::new(MassRatio::ONE);
    let off = |found: f64, exact: f64| ((found - exact) / exact).abs();
    let mut errors = [None; 6];
    // A row without "loss" has a δ whose α, rounded to f64, lies on the other side of α*. The forms at α then give no
    // information about δ.
    if row.get("loss").is_some() {
        let at_alpha = field("loss")?;
        let printed = printed_image(MassRatio::ONE, alpha)?;
        errors[0] = printed.map(|next| off(alpha - next, at_alpha));
        errors[1] = map.hop(alpha)?.loss.map(|loss| off(loss, at_alpha));
    }
    errors[2] = map.hop_near_fixed_point(1, offset)?.loss.map(|loss| off(loss, exact));
    let expansion = if offset > 0.0 {
        RightExpansion::new(1, MassRatio::ONE)?.loss(offset)
    } else {
        LeftExpansion::new(1, MassRatio::ONE)?.loss(offset)
    };
    errors[3] = expansion.ok().map(|expansion| off(expansion.value, exact));
    for (form, place) in [(Form::Corrected, 4), (Form::Printed, 5)] {
        let local = Coefficients::new(1, MassRatio::ONE, form)?;
        let factor = if offset > 0.0 { 1.0 } else { hopper_asymptotics::LEFT_FACTOR };
        let size = offset.abs();
        let leading = factor * local.lambda * size * pxfm::f_cbrt(size);
        // The paper prints λ for the right side only.
        if offset > 0.0 || form == Form::Corrected {
            errors[place] = Some(off(leading, exact));
        }
    }
    Ok(ErrorRow { offset, errors })
}
