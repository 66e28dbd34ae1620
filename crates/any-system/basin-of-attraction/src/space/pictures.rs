//! Pictures of results, one call each.

use crate::line::pixel_shares::PixelShares;
use crate::parameters::fractions_along::FractionsAlong;
use crate::space::label::Label;
use crate::space::raster::{Grid, LabelImage};
use crate::space::value_image::ValueImage;
use journal_figures::palette::{self, Color};
use journal_figures::{Anchor, Error, Frame, Pen, Svg, rgb_png, ticks};
use std::collections::BTreeMap;

/// The frame of a picture, in points: the plane is as wide as a column of a journal.
const LEFT: f64 = 58.0;
const TOP: f64 = 14.0;
const SIDE: f64 = 250.0;
const BELOW: f64 = 46.0;
/// The legend on the right.
const LEGEND: f64 = 92.0;
/// Lines of the legend.
const LINE: f64 = 16.0;
/// Points of an attractor: of a cloud a small one each, of a few large ones.
const DOT: f64 = 0.9;
const LARGE_DOT: f64 = 3.2;
/// Attractors of up to so many points are drawn with large ones.
const FEW: usize = 40;

/// Colours of basins: light enough that attractors show on them, then those in order.
const BASINS: [Color; 8] = [
    Color { css: "#9cc9e8", rgb: [0x9c, 0xc9, 0xe8] },
    Color { css: "#f4b98a", rgb: [0xf4, 0xb9, 0x8a] },
    Color { css: "#b0d89d", rgb: [0xb0, 0xd8, 0x9d] },
    Color { css: "#e6a8c7", rgb: [0xe6, 0xa8, 0xc7] },
    Color { css: "#d9cf7f", rgb: [0xd9, 0xcf, 0x7f] },
    Color { css: "#a9a6db", rgb: [0xa9, 0xa6, 0xdb] },
    Color { css: "#8fd3c8", rgb: [0x8f, 0xd3, 0xc8] },
    Color { css: "#c9b29b", rgb: [0xc9, 0xb2, 0x9b] },
];

/// The same, darker, for curves.
const CURVES: [&str; 8] =
    ["#1f6fa8", "#c2571a", "#3d8a2e", "#a8326f", "#857a10", "#4a43a8", "#14796a", "#6b4a2b"];

/// The names of the axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AxisNames<'a> {
    /// Of the horizontal one, as markup of `journal_figures`.
    pub x: &'a str,
    /// Of the vertical one.
    pub y: &'a str,
}

/// Basins and escape have colours in the order of their numbers; what is undecided is white, what is outside is grey.
fn place(label: Label) -> Option<usize> {
    let number = label.basin_number().map(|number| usize::from(number) + 1);
    let number = if label.is_escaped() { Some(0) } else { number };
    number.map(|number| number % BASINS.len())
}

fn color(label: Label) -> Color {
    match place(label) {
        _ if label.is_outside() => palette::GREY,
        None => palette::WHITE,
        Some(place) => BASINS[place],
    }
}

fn no_picture(error: crate::error::Error) -> Error {
    Error::Render { what: "basins".to_owned(), reason: error.to_string() }
}

/// The frame of a grid, with its image; `pixel` has the colour of a column and row.
fn plane(
    grid: Grid,
    names: AxisNames<'_>,
    pixel: impl Fn(usize, usize) -> [u8; 3],
) -> Result<(Svg, Frame), Error> {
    let pixels = grid.pixels().map_err(no_picture)?;
    let mut rgb = Vec::with_capacity(3 * pixels);
    for row in (0..grid.rows).rev() {
        (0..grid.columns).for_each(|column| rgb.extend(pixel(column, row)));
    }
    let png = rgb_png("basins", grid.columns, grid.rows, &rgb)?;
    let mut svg = Svg::new(LEFT + SIDE + LEGEND, TOP + SIDE + BELOW);
    svg.image(LEFT, TOP, SIDE, SIDE, &png);
    let ends = |side: crate::space::interval::Interval| (side.left, side.right);
    let frame = Frame::linear(LEFT, TOP, SIDE, SIDE, ends(grid.x), ends(grid.y));
    frame.axes(&mut svg, &ticks(frame.x, 5), &ticks(frame.y, 5), names.x, names.y);
    Ok((svg, frame))
}

/// The legend: a square and a name a line.
fn legend(svg: &mut Svg, lines: &[(&'static str, String)]) {
    for (number, (color, name)) in lines.iter().enumerate() {
        let top = TOP + LINE * number as f64;
        svg.fill_rect(LEFT + SIDE + 10.0, top, 10.0, 10.0, color);
        svg.rect(LEFT + SIDE + 10.0, top, 10.0, 10.0, Pen::solid("#000", 0.4));
        svg.text(LEFT + SIDE + 25.0, top + 8.8, Anchor::Start, 10.5, name);
    }
}

/// Most lines of a legend.
const MOST_LINES: usize = 15;

fn legend_of(svg: &mut Svg, labels: &[Label]) {
    let mut lines: Vec<(&'static str, String)> = labels
        .iter()
        .take(MOST_LINES)
        .map(|&label| (color(label).css, label.to_string()))
        .collect();
    if labels.len() > MOST_LINES {
        lines.push((palette::WHITE.css, format!("and {} more", labels.len() - MOST_LINES)));
    }
    legend(svg, &lines);
}

impl LabelImage {
    /// The image with axes and a legend, and the attractors over it: `attractors` has their points, of which the coordinates `plane` are those of the
    /// picture. Without attractors give an empty map.
    ///
    /// # Errors
    /// An image that [`check`](Self::check) refuses, and a name that the font cannot set when the picture is rendered.
    pub fn picture(
        &self,
        attractors: &BTreeMap<Label, Vec<Vec<f64>>>,
        plane_of: (usize, usize),
        names: AxisNames<'_>,
    ) -> Result<Svg, Error> {
        self.check().map_err(no_picture)?;
        let at = |column, row| self.at(column, row).map_or(palette::WHITE, color).rgb;
        let (mut svg, frame) = plane(self.grid, names, at)?;
        frame.clipped(&mut svg, |svg| {
            for points in attractors.values() {
                for point in points {
                    let (Some(&x), Some(&y)) = (point.get(plane_of.0), point.get(plane_of.1))
                    else {
                        continue;
                    };
                    let (x, y) = frame.at((x, y));
                    match points.len() <= FEW {
                        true => svg.dot(x, y, LARGE_DOT, "#000"),
                        // A dot has a light rim, which would hide the others of a cloud.
                        false => svg.fill_rect(x - 0.5 * DOT, y - 0.5 * DOT, DOT, DOT, "#000"),
                    }
                }
            }
        });
        let labels: Vec<Label> = self.counts().into_iter().map(|(label, _)| label).collect();
        legend_of(&mut svg, &labels);
        Ok(svg)
    }
}

/// A number of a scale with the fewest digits that give it to a hundredth of a step; with a power of ten if the largest number of the scale is small or
/// large.
fn of_scale(x: f64, (step, largest): (f64, f64)) -> String {
    let short = (0..17).filter_map(|digits| format!("{x:.digits$e}").parse::<f64>().ok());
    let x = short.into_iter().find(|own| (own - x).abs() <= 0.01 * step).unwrap_or(x);
    let text = match format!("{x:e}").split_once('e') {
        Some((digits, power)) if x != 0.0 && !(1e-3..1e6).contains(&largest) => {
            format!("{digits} · 10^{{{power}}}")
        }
        _ => x.to_string(),
    };
    text.replace('-', "−")
}

impl ValueImage<f64> {
    /// The numbers as shades, from light at the smallest to dark at the largest, with axes and a scale; what is not finite is white. `of` says what the
    /// numbers are.
    ///
    /// # Errors
    /// As [`LabelImage::picture`].
    pub fn picture(&self, of: &str, names: AxisNames<'_>) -> Result<Svg, Error> {
        /// Shades of the scale.
        const SHADES: usize = 5;
        let finite = || self.values.iter().copied().filter(|x| x.is_finite());
        let (low, high) =
            (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
        // Halves: the difference of the largest numbers is none.
        let part = |x: f64| match high > low {
            true => (0.5 * x - 0.5 * low) / (0.5 * high - 0.5 * low),
            false => 0.0,
        };
        let shade = |x: f64| match x.is_finite() {
            // From a light blue to a dark one.
            true => [(0xe8, 0x08), (0xf1, 0x30), (0xfa, 0x6b)].map(|(light, dark): (u8, u8)| {
                (f64::from(light) + part(x) * (f64::from(dark) - f64::from(light))) as u8
            }),
            false => palette::WHITE.rgb,
        };
        let at = |column, row| shade(self.at(column, row).copied().unwrap_or(f64::NAN));
        let (mut svg, _) = plane(self.grid, names, at)?;
        const SCALE: [&str; SHADES] = ["#e8f1fa", "#b0c0d6", "#7890b2", "#40608e", "#08306b"];
        let lines: Vec<(&'static str, String)> = match low.is_finite() {
            true => SCALE
                .iter()
                .enumerate()
                .map(|(k, css)| {
                    let part = k as f64 / (SHADES - 1) as f64;
                    let x = low * (1.0 - part) + high * part;
                    (*css, of_scale(x, (0.25 * high - 0.25 * low, low.abs().max(high.abs()))))
                })
                .collect(),
            false => Vec::new(),
        };
        legend(&mut svg, &lines);
        svg.text(LEFT + SIDE + 10.0, TOP + LINE * (SHADES as f64 + 0.6), Anchor::Start, 10.5, of);
        Ok(svg)
    }
}

/// The shares of basins in the pixels of some columns: the colour of a pixel is the mean of the colours of its basins, weighted by their shares, and white
/// for what is undecided. Column k has the shares `columns[k]`, from the smallest y.
///
/// # Errors
/// Another number of columns or pixels than the grid has; as [`LabelImage::picture`].
pub fn share_picture(
    columns: &[PixelShares],
    grid: Grid,
    names: AxisNames<'_>,
) -> Result<Svg, Error> {
    let pixels = columns.iter().map(PixelShares::pixels).sum();
    if columns.len() != grid.columns || columns.iter().any(|own| own.pixels() != grid.rows) {
        let error = crate::error::Error::BadImage {
            labels: pixels,
            columns: grid.columns,
            rows: grid.rows,
        };
        return Err(no_picture(error));
    }
    let mix = |column: usize, row: usize| {
        let own = &columns[column];
        let parts: Vec<(f64, [u8; 3])> = own
            .labels()
            .iter()
            .map(|&label| (own.of(label, row).lower, color(label).rgb))
            .collect();
        let rest = 1.0 - parts.iter().map(|(share, _)| share).sum::<f64>();
        [0, 1, 2].map(|k| {
            let sum: f64 = parts.iter().map(|(share, rgb)| share * f64::from(rgb[k])).sum();
            (sum + rest.max(0.0) * 255.0).min(255.0) as u8
        })
    };
    let (mut svg, _) = plane(grid, names, mix)?;
    let mut labels: Vec<Label> = columns.iter().flat_map(|own| own.labels().to_vec()).collect();
    labels.sort_unstable();
    labels.dedup();
    legend_of(&mut svg, &labels);
    Ok(svg)
}

impl FractionsAlong {
    /// The fractions over the parameter: a curve and a band of its ranges for each basin, a dashed line at each jump.
    ///
    /// # Errors
    /// Fewer than two parameters.
    pub fn picture(&self, names: AxisNames<'_>) -> Result<Svg, Error> {
        let (Some((from, _)), Some((to, _))) = (self.points().first(), self.points().last()) else {
            return Err(no_picture(crate::error::Error::NothingInside { points: 0 }));
        };
        if from == to {
            return Err(no_picture(crate::error::Error::NothingInside { points: 1 }));
        }
        let mut svg = Svg::new(LEFT + SIDE + LEGEND, TOP + SIDE + BELOW);
        // 0 and 1 are inside the frame.
        let frame = Frame::linear(LEFT, TOP, SIDE, SIDE, (*from, *to), (-0.02, 1.02));
        let mut lines = Vec::new();
        for jump in self.jumps() {
            let x = 0.5 * jump.from + 0.5 * jump.to;
            frame.polyline(&mut svg, &[(x, -0.02), (x, 1.02)], Pen::dashed("#888", 0.6, "3 2"));
        }
        for label in self.labels() {
            let css = CURVES[place(label).unwrap_or(0)];
            let bars = self.of(label).map(|(parameter, own)| (parameter, own.lower, own.upper));
            frame.bars(&mut svg, bars.collect::<Vec<_>>(), Pen::solid(css, 0.5));
            let curve: Vec<(f64, f64)> =
                self.of(label).map(|(parameter, own)| (parameter, own.value)).collect();
            // It is broken at the jumps.
            let jumps = |one: f64| self.jumps().any(|jump| jump.from == one);
            for part in curve.chunk_by(|one, _| !jumps(one.0)) {
                frame.polyline(&mut svg, part, Pen::solid(css, 1.2));
            }
            lines.push((css, label.to_string()));
        }
        frame.axes(&mut svg, &ticks(frame.x, 5), &ticks(frame.y, 5), names.x, names.y);
        lines.truncate(MOST_LINES);
        legend(&mut svg, &lines);
        Ok(svg)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_of_a_colour_are_the_same() {
        for Color { css, rgb: [r, g, b] } in BASINS {
            assert_eq!(css, format!("#{r:02x}{g:02x}{b:02x}"));
        }
    }
}
