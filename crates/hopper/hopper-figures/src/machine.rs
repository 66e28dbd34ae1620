//! The hopper as a drawing: two blocks, a spring, and the ground.

use journal_figures::{Anchor, Path, Pen, Svg};

const INK: Pen = Pen::solid("#000", 1.1);
const SPRING: Pen = Pen::solid("#444", 1.1);
const THIN: Pen = Pen::solid("#000", 0.6);
/// The colour of a block.
const BLOCK: &str = "#dfe6ee";

/// The ground: a line at the height `level` of the page about `x`, with hatches below.
pub fn draw_ground(svg: &mut Svg, x: f64, level: f64) {
    svg.line((x - 60.0, level), (x + 60.0, level), INK);
    for k in 0..12 {
        let left = x - 58.0 + 10.0 * f64::from(k);
        svg.line((left, level + 8.0), (left + 8.0, level), THIN);
    }
}

/// A block about `x` whose lower side is at the height `bottom` of the page, with a label in its middle.
pub fn draw_block(svg: &mut Svg, x: f64, bottom: f64, (width, height): (f64, f64), label: &str) {
    svg.fill_rect(x - width / 2.0, bottom - height, width, height, BLOCK);
    svg.rect(x - width / 2.0, bottom - height, width, height, INK);
    svg.text(x, bottom - height / 2.0 + 4.5, Anchor::Middle, 13.0, label);
}

/// A spring at `x` between two heights of the page.
pub fn draw_spring(svg: &mut Svg, x: f64, bottom: f64, top: f64) {
    let coils = 12;
    let step = (bottom - top) / (coils as f64 + 2.0);
    let zigzag = (0..coils).map(|k| {
        let side = if k % 2 == 0 { 9.0 } else { -9.0 };
        (x + side, bottom - step * (k as f64 + 1.5))
    });
    let points = [(x, bottom), (x, bottom - step)].into_iter().chain(zigzag);
    let points = points.chain([(x, top + step), (x, top)]);
    svg.path(Path::polyline(points), SPRING);
}
