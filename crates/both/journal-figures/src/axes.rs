//! Frames with axes: from data to points on the page.

use crate::curve::smooth;
use crate::path::Path;
use crate::svg::{Anchor, Pen, Svg};

/// How an axis is laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps.
    Linear,
    /// Equal factors.
    Log,
}

/// A rectangle on the page that shows a window of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Left edge on the page.
    pub left: f64,
    /// Upper edge on the page.
    pub top: f64,
    /// Width on the page.
    pub width: f64,
    /// Height on the page.
    pub height: f64,
    /// Horizontal range of the data.
    pub x: (f64, f64),
    /// Vertical range of the data.
    pub y: (f64, f64),
    /// Layout of the horizontal axis.
    pub x_scale: Scale,
    /// Layout of the vertical axis.
    pub y_scale: Scale,
}

const AXIS: Pen = Pen::solid("#000", 0.8);
/// Length of a tick, in points.
const TICK: f64 = 4.0;
/// Size of tick labels, in points.
pub const TICK_SIZE: f64 = 10.5;
/// Size of axis labels, in points.
pub const LABEL_SIZE: f64 = 13.0;

fn share(value: f64, (low, high): (f64, f64), scale: Scale) -> f64 {
    match scale {
        Scale::Linear => (value - low) / (high - low),
        Scale::Log => pxfm::f_log10(value / low) / pxfm::f_log10(high / low),
    }
}

impl Frame {
    /// A frame with linear axes.
    pub fn linear(
        left: f64,
        top: f64,
        width: f64,
        height: f64,
        x: (f64, f64),
        y: (f64, f64),
    ) -> Self {
        Frame { left, top, width, height, x, y, x_scale: Scale::Linear, y_scale: Scale::Linear }
    }

    /// The frame with a logarithmic horizontal axis; its range must be positive.
    #[must_use]
    pub fn log_x(self) -> Self {
        Frame { x_scale: Scale::Log, ..self }
    }

    /// The frame with a logarithmic vertical axis; its range must be positive.
    #[must_use]
    pub fn log_y(self) -> Self {
        Frame { y_scale: Scale::Log, ..self }
    }

    /// The point of the page for a point of the data.
    pub fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (
            self.left + self.width * share(x, self.x, self.x_scale),
            self.top + self.height * (1.0 - share(y, self.y, self.y_scale)),
        )
    }

    /// Draws with the parts outside the frame cut off.
    pub fn clipped(&self, svg: &mut Svg, draw: impl FnOnce(&mut Svg)) {
        svg.clipped(self.left, self.top, self.width, self.height, draw);
    }

    /// A smooth curve through points of the data plane.
    pub fn curve(&self, svg: &mut Svg, points: &[(f64, f64)], pen: Pen) {
        let on_page: Vec<_> = points.iter().map(|&point| self.at(point)).collect();
        svg.path(smooth(&on_page), pen);
    }

    /// Straight lines from point to point of the data plane.
    pub fn polyline(&self, svg: &mut Svg, points: &[(f64, f64)], pen: Pen) {
        svg.path(Path::polyline(points.iter().map(|&point| self.at(point))), pen);
    }

    /// Vertical bars at x from low to high, each given as (x, low, high). Parts outside the frame are cut off.
    pub fn bars(&self, svg: &mut Svg, bars: impl IntoIterator<Item = (f64, f64, f64)>, pen: Pen) {
        self.clipped(svg, |svg| {
            for (x, low, high) in bars {
                // A logarithmic axis has no place for 0.
                let ends = [low.max(self.y.0), high.max(self.y.0)];
                svg.line(self.at((x, ends[0])), self.at((x, ends[1])), pen);
            }
        });
    }

    /// The box, the ticks with their labels, and the names of the axes.
    ///
    /// With an empty `y_label` no room is left for it: two frames may then share one axis.
    pub fn axes(
        &self,
        svg: &mut Svg,
        x_ticks: &[(f64, String)],
        y_ticks: &[(f64, String)],
        x_label: &str,
        y_label: &str,
    ) {
        svg.rect(self.left, self.top, self.width, self.height, AXIS);
        let bottom = self.top + self.height;
        for (value, label) in x_ticks {
            let x = self.at((*value, self.y.0)).0;
            svg.line((x, bottom), (x, bottom - TICK), AXIS);
            svg.line((x, self.top), (x, self.top + TICK), AXIS);
            svg.text(x, bottom + 13.0, Anchor::Middle, TICK_SIZE, label);
        }
        let mut widest = 0;
        for (value, label) in y_ticks {
            let y = self.at((self.x.0, *value)).1;
            svg.line((self.left, y), (self.left + TICK, y), AXIS);
            let right = self.left + self.width;
            svg.line((right, y), (right - TICK, y), AXIS);
            svg.text(self.left - 5.0, y + 3.5, Anchor::End, TICK_SIZE, label);
            widest = widest.max(label.chars().filter(|c| !"{}^_$".contains(*c)).count());
        }
        svg.text(self.left + self.width / 2.0, bottom + 30.0, Anchor::Middle, LABEL_SIZE, x_label);
        if y_label.is_empty() {
            return;
        }
        // A character of a tick label is about 5 points wide at [`TICK_SIZE`]. The name of the axis is placed beside
        // the widest label.
        let away = 5.0 * widest as f64 + 16.0;
        svg.rotated_text(
            self.left - away,
            self.top + self.height / 2.0,
            -90.0,
            Anchor::Middle,
            LABEL_SIZE,
            y_label,
        );
    }
}

/// Round tick positions on a linear axis, about `count` of them, with their labels; empty for an empty range.
///
/// Steps are 1, 2 or 5 times a power of ten.
pub fn ticks((low, high): (f64, f64), count: usize) -> Vec<(f64, String)> {
    if !(low < high) {
        return Vec::new();
    }
    let rough = (high - low) / count.max(1) as f64;
    let power = pxfm::f_log10(rough).floor() as i32;
    let unit = 10f64.powi(power);
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|m| m * unit)
        // A step that equals the rough step may be rounded below it. Therefore a step smaller by a thousandth also
        // counts.
        .find(|&s| s >= rough * 0.999)
        .unwrap_or(unit);
    // An f64 has 17 digits: further decimals would be noise.
    let decimals = (-pxfm::f_log10(step).floor()).clamp(0.0, 17.0) as usize;
    // An end that is a multiple of the step gets its tick, although the quotient is rounded. The 1e-9 allows for this
    // rounding.
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let largest = low.abs().max(high.abs());
    let plain = (SMALLEST_PLAIN..LARGEST_PLAIN).contains(&largest);
    (first..=last)
        .map(|k| {
            let value = k as f64 * step;
            let label = match k {
                _ if plain => format!("{value:.decimals$}"),
                0 => "0".to_owned(),
                _ => with_power(value, power),
            };
            (value, label.replace('-', "−"))
        })
        .collect()
}

/// Axes that end below the first or beyond the second of these have labels such as 2 · 10⁻⁷: written out, labels of
/// nine digits and more would touch each other.
const SMALLEST_PLAIN: f64 = 1e-6;
const LARGEST_PLAIN: f64 = 1e9;

/// A multiple of a power of ten, as markup: all labels of an axis have the same power.
fn with_power(value: f64, power: i32) -> String {
    // Two factors: a single one would be 0 below 10⁻³⁰⁸, and infinite above 10³⁰⁸.
    let half = power / 2;
    let digits = value / 10f64.powi(half) / 10f64.powi(power - half);
    // Steps are 1, 2, 5 or 10 times the power, so that the multiples are whole numbers.
    format!("{digits:.0} · 10^{{{power}}}")
}

/// The powers of ten on a logarithmic axis whose exponent is a multiple of `every`, with their labels.
pub fn decades((low, high): (f64, f64), every: i32) -> Vec<(f64, String)> {
    let first = (pxfm::f_log10(low) - 1e-9).ceil() as i32;
    let last = (pxfm::f_log10(high) + 1e-9).floor() as i32;
    (first..=last)
        .filter(|k| k % every == 0)
        .map(|k| {
            (pxfm::f_exp10(f64::from(k)), format!("10^{{{}}}", k.to_string().replace('-', "−")))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let labels =
            |range, count| ticks(range, count).into_iter().map(|t| t.1).collect::<Vec<_>>();
        assert_eq!(labels((0.0, 1.0), 5), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels((-1.0, 1.0), 2), ["−1", "0", "1"]);
        assert_eq!(labels((0.0, 4e-7), 2), ["0", "2 · 10^{−7}", "4 · 10^{−7}"]);
        assert_eq!(labels((-1e300, 1e300), 2), ["−1 · 10^{300}", "0", "1 · 10^{300}"]);
        assert_eq!(
            labels((4.49, 4.515), 5),
            ["4.490", "4.495", "4.500", "4.505", "4.510", "4.515"]
        );
    }
}
