//! The motion of both masses against time.

use crate::motion::{Motion, Sample};
use journal_figures::{Anchor, Frame, Pen, Svg, ticks};
use passive_hopper::{HopperState, Phase};

/// The pens of the upper and the lower mass.
pub(crate) const UPPER: Pen = Pen::solid("#10386e", 1.2);
pub(crate) const LOWER: Pen = Pen::solid("#d55e00", 1.4);
/// The colour behind the contact phases.
const CONTACT: &str = "#e8e8e4";

/// Both displacements against time. Contact phases are grey behind the curves.
pub fn draw_motion(motion: &Motion) -> Svg {
    let mut svg = Svg::new(640.0, 360.0);
    let frame = axes(motion, (62.0, 40.0, 560.0, 270.0));
    draw_curves(&mut svg, &frame, motion);
    let steps = (ticks(frame.x, 8), ticks(frame.y, 6));
    let y_label = "$y$_{1}, $y$_{2} (units of $m$_{2}$g$/$k$)";
    frame.axes(&mut svg, &steps.0, &steps.1, "time $τ$ (units of 1/$ω$)", y_label);
    let entries = [(UPPER, "upper mass, $y$_{1}"), (LOWER, "lower mass, $y$_{2}")];
    for (k, (pen, name)) in entries.into_iter().enumerate() {
        let x = frame.left + 130.0 * k as f64;
        svg.line((x, 22.0), (x + 24.0, 22.0), pen);
        svg.text(x + 29.0, 26.0, Anchor::Start, 11.5, name);
    }
    let x = frame.left + 260.0;
    svg.fill_rect(x, 16.0, 24.0, 12.0, CONTACT);
    svg.text(x + 29.0, 26.0, Anchor::Start, 11.5, "contact");
    svg.text(frame.left + frame.width, 26.0, Anchor::End, 11.5, &title(motion));
    svg
}

/// The mass ratio, and the lift-off speed of a motion that begins with a lift-off, as markup.
pub(crate) fn title(motion: &Motion) -> String {
    let ratio = format!("$M$ = {}", short(motion.mass_ratio.value()));
    let lift_off = motion.samples.first().filter(|sample| {
        sample.phase == Phase::Flight
            && sample.state == HopperState::lift_off(sample.state.upper_velocity)
    });
    match lift_off {
        Some(sample) => format!("{ratio}, $α$ = {}", short(sample.state.upper_velocity)),
        None => ratio,
    }
}

/// A number of at most six digits for a picture.
pub(crate) fn short(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-3..1e6).contains(&size) {
        // Six digits: the first one is at the power of the size.
        let decimals = (5.0 - pxfm::f_log10(size.max(1e-3)).floor()).max(0.0) as usize;
        let text = format!("{value:.decimals$}");
        let text = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        };
        return text.replace('-', "−");
    }
    let text = format!("{value:.5e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    format!("{digits} · 10^{{{power}}}").replace('-', "−")
}

/// The frame of the curves at a place of the page.
pub(crate) fn axes(motion: &Motion, (left, top, width, height): (f64, f64, f64, f64)) -> Frame {
    let (upper, lower) = (motion.range(|s| s.upper_position), motion.range(|s| s.lower_position));
    let (low, high) = (upper.0.min(lower.0), upper.1.max(lower.1));
    let margin = 0.05 * (high - low).max(1e-9 * high.abs()).max(f64::MIN_POSITIVE);
    // A motion of one instant has an axis, too.
    let x = (motion.start(), motion.duration().max(motion.start().next_up()));
    Frame::linear(left, top, width, height, x, (low - margin, high + margin))
}

/// Both curves over the shaded contact phases.
pub(crate) fn draw_curves(svg: &mut Svg, frame: &Frame, motion: &Motion) {
    for phase in motion.samples.chunk_by(|a, b| a.phase == b.phase) {
        if let (Some(first), Some(last), true) =
            (phase.first(), phase.last(), phase[0].phase == Phase::Contact)
        {
            let (x0, x1) = (frame.at((first.time, 0.0)).0, frame.at((last.time, 0.0)).0);
            svg.fill_rect(x0, frame.top, x1 - x0, frame.height, CONTACT);
        }
    }
    frame.polyline(svg, &[(frame.x.0, 0.0), (frame.x.1, 0.0)], Pen::solid("#999", 0.6));
    let curve = |of: fn(&Sample) -> f64| -> Vec<(f64, f64)> {
        thinned(&motion.samples).map(|sample| (sample.time, of(sample))).collect()
    };
    frame.clipped(svg, |svg| {
        frame.polyline(svg, &curve(|s| s.state.upper_position), UPPER);
        frame.polyline(svg, &curve(|s| s.state.lower_position), LOWER);
    });
}

/// The most points of a curve. A page has some thousand dots across, so that more are not seen.
const MOST_POINTS: usize = 20_000;

/// At most some ten thousand of the samples, at equal distances.
fn thinned(samples: &[Sample]) -> impl Iterator<Item = &Sample> {
    samples.iter().step_by(samples.len().div_ceil(MOST_POINTS).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_pictures_are_short() {
        let texts = [
            (7.0, "7"),
            (0.2, "0.2"),
            (4.493409457909064, "4.49341"),
            (-0.5, "−0.5"),
            (123456.7, "123457"),
            (1e-9, "1 · 10^{−9}"),
            (8796093022208.0, "8.79609 · 10^{12}"),
            (0.0, "0"),
        ];
        for (value, text) in texts {
            assert_eq!(short(value), text);
        }
    }
}
