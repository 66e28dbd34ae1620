//! Fig. 1: the model and the forces in its phases.

use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use hopper_figures::{draw_block, draw_ground, draw_spring};
use journal_figures::{Anchor, Pen, Svg};

const INK: Pen = Pen::solid("#000", 1.1);
const FORCE: Pen = Pen::solid("#b02418", 1.4);
const THIN: Pen = Pen::solid("#000", 0.6);
/// Height of the ground line on the page.
const GROUND: f64 = 215.0;
/// Width and height of a block on the page.
const BLOCK: (f64, f64) = (52.0, 30.0);

/// Draws the four states with their forces.
pub(super) fn build(_: &Progress) -> Result<Figure, Error> {
    let mut svg = Svg::new(690.0, 310.0);
    let titles = ["(a) relaxed", "(b) flight", "(c) collision", "(d) contact"];
    let conditions =
        ["", "$x$_{2} > 0", "$x$_{2} = 0, $v$_{2} < 0", "$x$_{2} = 0, $kx$_{1} < $m$_{2}$g$"];
    // Heights of the lower and of the upper mass above the ground, on the page.
    let heights = [(0.0, 110.0), (42.0, 165.0), (0.0, 132.0), (0.0, 84.0)];
    for (k, (lower, upper)) in heights.into_iter().enumerate() {
        let x = 95.0 + 165.0 * k as f64;
        draw_ground(&mut svg, x, GROUND);
        draw_spring(&mut svg, x, GROUND - lower - BLOCK.1, GROUND - upper);
        draw_block(&mut svg, x, GROUND - lower, BLOCK, "$m$_{2}");
        draw_block(&mut svg, x, GROUND - upper, BLOCK, "$m$_{1}");
        svg.text(x, 277.0, Anchor::Middle, 13.0, titles[k]);
        svg.text(x, 297.0, Anchor::Middle, 12.0, conditions[k]);
        forces(&mut svg, k, x, GROUND - lower, GROUND - upper);
    }
    svg.text(78.0, 155.0, Anchor::End, 13.0, "$k$");
    coordinates(&mut svg);
    svg.arrow((30.0, 35.0), (30.0, 70.0), INK);
    svg.text(22.0, 57.0, Anchor::End, 13.0, "$g$");
    Figure::new("fig_01_model", svg, Vec::new(), &[])
}

/// x₁ and x₂, counted from the relaxed state upwards.
fn coordinates(svg: &mut Svg) {
    let x = 95.0 + BLOCK.0 / 2.0 + 10.0;
    for (level, name) in [(GROUND - 110.0, "$x$_{1}"), (GROUND, "$x$_{2}")] {
        svg.line((x - 8.0, level), (x + 12.0, level), THIN);
        svg.arrow((x + 5.0, level), (x + 5.0, level - 26.0), THIN);
        svg.text(x + 12.0, level - 14.0, Anchor::Start, 12.0, name);
    }
}

/// Arrows beside the blocks; `lower` and `upper` are the bottoms of the blocks on the page.
fn forces(svg: &mut Svg, panel: usize, x: f64, lower: f64, upper: f64) {
    let side = BLOCK.0 / 2.0;
    let mut force = |dx: f64, from: f64, to: f64, label: &str| {
        svg.arrow((x + dx, from), (x + dx, to), FORCE);
        let anchor = if dx > 0.0 { Anchor::Start } else { Anchor::End };
        let beside = if dx > 0.0 { 4.0 } else { -4.0 };
        svg.text(x + dx + beside, 0.5 * (from + to) + 4.0, anchor, 11.0, label);
    };
    let (weight1, weight2) = ("$m$_{1}$g$", "$m$_{2}$g$");
    let upper_middle = upper - BLOCK.1 / 2.0;
    let lower_middle = lower - BLOCK.1 / 2.0;
    match panel {
        1 => {
            force(-side - 5.0, upper_middle, upper_middle + 30.0, weight1);
            force(side + 5.0, upper_middle, upper_middle + 38.0, "$k$($x$_{1} − $x$_{2})");
            force(-side - 5.0, lower_middle, lower_middle + 30.0, weight2);
            force(side + 5.0, lower_middle, lower_middle - 38.0, "$k$($x$_{1} − $x$_{2})");
        }
        2 => {
            force(-side - 5.0, lower_middle + 15.0, lower_middle - 28.0, "impulse");
            force(side + 5.0, upper_middle + 15.0, upper_middle - 20.0, "$v$_{1} unchanged");
            force(side + 5.0, lower_middle - 20.0, lower_middle + 15.0, "$v$_{2} → 0");
        }
        3 => {
            force(-side - 5.0, upper_middle, upper_middle + 30.0, weight1);
            force(side + 5.0, upper_middle, upper_middle + 30.0, "$kx$_{1}");
            force(-side - 5.0, lower_middle - 22.0, lower_middle + 10.0, weight2);
            force(side + 5.0, lower_middle - 2.0, lower_middle - 34.0, "$kx$_{1}");
            force(side + 5.0, lower_middle + 56.0, lower_middle + 17.0, "$m$_{2}$g$ − $kx$_{1}");
        }
        _ => {}
    }
}
