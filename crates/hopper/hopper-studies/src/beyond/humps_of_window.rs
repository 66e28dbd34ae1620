//! Starts on the humps of the paper's window, their fates, and fractions as numbers, as text and as curves.

use crate::error::Error;
use basin_of_attraction::{FractionRange, Interval, Label};
use hopper_basin::{Fates, HopperFate};
use journal_figures::{Frame, Pen, Svg};
use passive_hopper::{MassRatio, alpha_star};

/// The first and the last fixed point of the paper's window, [`hopper_basin::first_humps`]`(5)`.
pub(super) const FROM: u64 = 1;
pub(super) const TO: u64 = 6;

pub(super) fn fates(mass_ratio: f64) -> Result<Fates, Error> {
    Ok(Fates::new(MassRatio::new(mass_ratio)?)?)
}

/// The label of a start; [`HopperFate::UNDECIDED_HOP`] if the fate cannot be computed.
pub(super) fn label(fates: &Fates, alpha: f64) -> Label {
    fates.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label)
}

pub(super) fn is_incessant(label: Label) -> bool {
    HopperFate::is_incessant(label)
}

pub(super) fn hump(n: u64) -> Result<Interval, Error> {
    Ok(Interval::new(alpha_star(n), alpha_star(n + 1))?)
}

/// The speed at a place in [0, `TO` − `FROM`], where each hump of the window has length one.
///
/// The paper gives each hump the same weight, whatever its length.
pub(super) fn by_humps(place: f64) -> f64 {
    let whole = (place.floor() as u64).min(TO - FROM - 1);
    let (left, right) = (alpha_star(FROM + whole), alpha_star(FROM + whole + 1));
    left + (right - left) * (place - whole as f64)
}

/// A fraction as three numbers of a scan: value, lower and upper end.
pub(super) fn three(FractionRange { value, lower, upper }: FractionRange) -> [f64; 3] {
    [value, lower, upper]
}

/// The fraction in three numbers of a scan.
pub(super) fn estimate(three: &[f64]) -> FractionRange {
    FractionRange { value: three[0], lower: three[1], upper: three[2] }
}

/// The header of a table of fractions over some quantity: each has its value, its lower and its upper end.
pub(super) fn fraction_header(over: &str, names: &[&str]) -> Vec<String> {
    let three = |name: &&str| ["", "_lower", "_upper"].map(|end| format!("{name}{end}"));
    std::iter::once(over.to_owned()).chain(names.iter().flat_map(three)).collect()
}

/// A row of such a table.
pub(super) fn fraction_row(over: f64, row: &[f64]) -> impl Iterator<Item = f64> {
    std::iter::once(over).chain(row.iter().copied())
}

/// A curve of fractions with their bars. A fraction of 0 has no place on a logarithmic axis: the curve leaves it out.
pub(super) fn fraction_curve(
    svg: &mut Svg,
    frame: &Frame,
    found: &[(f64, FractionRange)],
    pen: Pen,
) {
    let seen = found.iter().filter(|(_, fraction)| fraction.value > 0.0);
    let line: Vec<_> = seen.map(|(x, fraction)| (*x, fraction.value)).collect();
    frame.clipped(svg, |svg| frame.polyline(svg, &line, pen));
    let bars = found.iter().map(|(x, fraction)| (*x, fraction.lower, fraction.upper));
    frame.bars(svg, bars, Pen::solid(pen.color, 0.8));
}

/// A fraction with the half width of its interval, in per cent. Small intervals get two digits more.
pub(super) fn percent(fraction: &FractionRange) -> String {
    let digits = if fraction.half_width() > 5e-4 { 2 } else { 4 };
    format!("{:.digits$} ± {:.digits$} %", 100.0 * fraction.value, 100.0 * fraction.half_width())
}

/// A fraction between bounds, in per cent.
pub(super) fn bounds(fraction: &FractionRange) -> String {
    format!("{:.5} … {:.5} %", 100.0 * fraction.lower, 100.0 * fraction.upper)
}

/// `count` values from `first` to `last`, equally spaced on a logarithmic scale.
pub(super) fn geometric(first: f64, last: f64, count: usize) -> Vec<f64> {
    let power = |k: usize| k as f64 / (count - 1) as f64;
    (0..count).map(|k| first * pxfm::f_pow(last / first, power(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn place_k_of_the_humps_is_fixed_point_k_plus_1() {
        assert_eq!(by_humps(0.0), alpha_star(1));
        assert_eq!(by_humps(5.0), alpha_star(6));
        let middle = by_humps(2.5);
        assert!(alpha_star(3) < middle && middle < alpha_star(4));
        let values = geometric(0.02, 50.0, 5);
        assert!((values[2] - 1.0).abs() < 1e-14 && values[4] == 50.0);
    }
}
