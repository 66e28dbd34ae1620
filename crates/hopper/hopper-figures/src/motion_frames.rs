//! The frames of an animation: the hopper, and a cursor on the curves of its motion.
//!
//! ```text
//!   spring on the page = relaxed length + y₁ − y₂        the relaxed length is not a number of the model; it is chosen so that the
//!                                                        spring keeps some length where it is shortest
//! ```

use crate::error::Error;
use crate::machine::{draw_block, draw_ground, draw_spring};
use crate::motion::Motion;
use crate::motion_plot::{LOWER, UPPER, axes, draw_curves, title};
use journal_figures::{Anchor, Pen, Svg, ticks};
use std::f64::consts::TAU;

/// Frames of a period of the spring: a smooth motion. More make larger files.
const FRAMES_A_PERIOD: f64 = 24.0;

/// The time of a frame in seconds, so that a period of the spring lasts 1.2 s. A GIF counts hundredths of a second.
pub(crate) const SECONDS_A_FRAME: f64 = 0.05;

/// The most frames: a minute, and some 20 MB.
const MOST_FRAMES: usize = 1200;

/// The ground and the highest place of the hopper on the page.
const GROUND: f64 = 330.0;
const TOP: f64 = 45.0;
/// The middle of the hopper on the page.
const MIDDLE: f64 = 80.0;
/// The shortest spring, as a part of the room that is left for springs and flights.
const SHORTEST: f64 = 0.12;
/// The heights of both blocks together on the page. Each has its share of the mass, and at least a quarter, so that
/// its label fits.
const BLOCKS: f64 = 76.0;

/// The times of the frames of a motion, at equal distances.
///
/// # Errors
/// [`Error::TooManyFrames`] for more than a minute.
pub fn frame_times(motion: &Motion) -> Result<Vec<f64>, Error> {
    let (start, step) = (motion.start(), TAU / FRAMES_A_PERIOD);
    let duration = motion.duration() - start;
    let frames = (duration / step).ceil().max(1.0);
    if !(frames <= MOST_FRAMES as f64) {
        return Err(Error::TooManyFrames { duration, frames: frames as usize, most: MOST_FRAMES });
    }
    Ok((0..=frames as usize).map(|k| start + (k as f64 * step).min(duration)).collect())
}

/// The frame of a motion at a time: the hopper on the left, the curves with a cursor on the right.
pub fn draw_frame(motion: &Motion, time: f64) -> Svg {
    let mut svg = Svg::new(640.0, 380.0);
    draw_machine(&mut svg, motion, time);
    let frame = axes(motion, (210.0, TOP - 5.0, 410.0, GROUND - TOP - 5.0));
    draw_curves(&mut svg, &frame, motion);
    let labels = ("time $τ$ (units of 1/$ω$)", "$y$_{1}, $y$_{2} (units of $m$_{2}$g$/$k$)");
    frame.axes(&mut svg, &ticks(frame.x, 5), &ticks(frame.y, 6), labels.0, labels.1);
    if let Some(state) = motion.at(time) {
        let x = frame.at((time, 0.0)).0;
        svg.line((x, frame.top), (x, frame.top + frame.height), Pen::solid("#777", 0.8));
        let ends = [(state.upper_position, UPPER), (state.lower_position, LOWER)];
        for (value, pen) in ends {
            let (x, y) = frame.at((time, value));
            svg.dot(x, y, 4.0, pen.color);
        }
    }
    svg.text(frame.left, 27.0, Anchor::Start, 11.5, &title(motion));
    let now = format!("$τ$ = {time:.1}");
    svg.text(frame.left + frame.width, 27.0, Anchor::End, 11.5, &now);
    svg
}

/// The hopper at a time.
fn draw_machine(svg: &mut Svg, motion: &Motion, time: f64) {
    let Some(state) = motion.at(time) else { return };
    let kappa = motion.mass_ratio.kappa();
    let height = |share: f64| BLOCKS * share.clamp(0.25, 0.75);
    let (lower_block, upper_block) = (height(kappa), height(1.0 - kappa));
    // The page has room for the blocks, the relaxed spring, and the largest y₁.
    let room = GROUND - TOP - BLOCKS;
    let (_, highest) = motion.range(|s| s.upper_position);
    let (shortest, _) = motion.range(|s| s.stretch());
    // A single state has no range; it is drawn in units of its length.
    let lift = if highest > shortest { highest - shortest } else { 1.0 };
    let scale = (1.0 - SHORTEST) * room / lift;
    let relaxed = SHORTEST * room - scale * shortest;
    let (y1, y2) = (state.upper_position, state.lower_position);
    let lower_bottom = GROUND - scale * y2;
    let upper_bottom = GROUND - lower_block - relaxed - scale * y1;
    draw_ground(svg, MIDDLE, GROUND);
    draw_spring(svg, MIDDLE, lower_bottom - lower_block, upper_bottom);
    draw_block(svg, MIDDLE, lower_bottom, (52.0, lower_block), "$m$_{2}");
    draw_block(svg, MIDDLE, upper_bottom, (52.0, upper_block), "$m$_{1}");
}
