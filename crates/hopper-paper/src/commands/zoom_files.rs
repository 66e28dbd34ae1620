//! `basin-raster --zoom M SPEED`: frames into an edge of a basin, from a half height of 1 down to any depth.

use crate::error::Error;
use crate::fate_colors::mixed;
use crate::figures::basin_plot::legend;
use basin_of_attraction::{Label, columns_in_parallel};
use hopper_basin::{CircleLimits, EdgeChart, Fates, LocalFractions, PhaseBasins, edge_window};
use journal_figures::{Anchor, Frame, Svg, render, rgb_png, ticks};
use passive_hopper::MassRatio;
use repository_tools::{Folder, Progress, say};
use resumable_job::Lock;
use std::ops::ControlFlow;
use std::path::PathBuf;

/// The frames and their folder.
#[derive(Debug, Clone)]
pub(super) struct Zoom {
    pub(super) out: PathBuf,
    pub(super) mass_ratio: f64,
    /// A speed next to the edge.
    pub(super) speed: f64,
    /// The number of frames; the first one has the half height 1.
    pub(super) frames: usize,
    /// Decades between two frames.
    pub(super) step: f64,
    pub(super) rows: usize,
}

/// The largest numbers of frames and of rows.
const MOST_FRAMES: usize = 10_000;
const MOST_ROWS: usize = 1 << 14;

/// The picture of all frames.
const OVERVIEW: &str = "zoom.png";

/// Runs the command.
pub(super) fn run(zoom: &Zoom) -> Result<(), Error> {
    let &Zoom { mass_ratio, speed, frames, step, rows, .. } = zoom;
    let good = (1..=MOST_FRAMES).contains(&frames) && (2..=MOST_ROWS).contains(&rows) && step > 0.0;
    if !(good && step.is_finite()) {
        return Err(Error::CheckFailed(format!(
            "a zoom has 1 to {MOST_FRAMES} frames, a positive step, and 2 to {MOST_ROWS} rows, not {frames}, {step} and {rows}"
        )));
    }
    // The edge lies between two rows.
    let rows = rows.next_multiple_of(2);
    let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
    let chart = EdgeChart::near(&fates, speed)?;
    let circle = PhaseBasins::new(&fates, chart.n(), CircleLimits::default())?;
    let folder = Folder::open(&zoom.out)?;
    let lock = Lock::take(folder.path(), "basin-raster")?;
    let bar = Progress.bar("frames", frames as u64);
    let frame = |at: usize| -> Result<_, hopper_basin::Error> {
        edge_window(&fates, &chart, &circle, step * at as f64, rows)
    };
    let all = columns_in_parallel(frames, frame, |done| {
        bar.set(done as u64);
        ControlFlow::Continue(())
    })?;
    bar.finish();
    for (at, pixels) in all.iter().enumerate() {
        let svg = draw_frame(zoom, &chart, step * at as f64, pixels)?;
        let rendered = render("frame", &svg, 1.5)?;
        lock.confirm()?;
        folder.write(&format!("zoom_{at:04}.png"), &rendered.png)?;
    }
    let rendered = render("zoom", &draw_all(zoom, &chart, &all)?, 2.0)?;
    lock.confirm()?;
    folder.write(OVERVIEW, &rendered.png)?;
    drop(lock);
    let (point, rest, error) = chart.point();
    say(format_args!(
        "edge {point:?} + {rest:e} ± {error:.0e}, at α*_{} after {} hops",
        chart.n(),
        chart.hops()
    ))?;
    say(format_args!("{frames} frames, {}", folder.path().join(OVERVIEW).display()))?;
    Ok(())
}

/// One frame: the speeds upwards, with the scale written in.
fn draw_frame(
    zoom: &Zoom,
    chart: &EdgeChart,
    depth: f64,
    pixels: &[LocalFractions],
) -> Result<Svg, Error> {
    let mut svg = Svg::new(420.0, 480.0);
    let frame = Frame::linear(70.0, 64.0, 320.0, 380.0, (0.0, 1.0), (-1.0, 1.0));
    let image = png(&[pixels])?;
    svg.image(frame.left, frame.top, frame.width, frame.height, &image);
    frame.axes(&mut svg, &[], &half_heights(), "", "speed $α$ − $p$");
    legend(&mut svg, frame.left, labels(std::iter::once(pixels)).into_iter());
    let scale = format!("$h$ = 10^{{{}}}", exponent(depth));
    svg.text(frame.left, 54.0, Anchor::Start, 16.0, &scale);
    let point = format!("$M$ = {}, $p$ ≈ {:?}", zoom.mass_ratio, chart.point().0);
    svg.text(frame.left + frame.width, 54.0, Anchor::End, 11.5, &point);
    Ok(svg)
}

/// All frames side by side.
fn draw_all(zoom: &Zoom, chart: &EdgeChart, all: &[Vec<LocalFractions>]) -> Result<Svg, Error> {
    let mut svg = Svg::new(860.0, 480.0);
    let last = zoom.step * zoom.frames as f64;
    let x = (-0.5 * zoom.step, last - 0.5 * zoom.step);
    let frame = Frame::linear(70.0, 54.0, 760.0, 370.0, x, (-1.0, 1.0));
    let frames: Vec<&[LocalFractions]> = all.iter().map(Vec::as_slice).collect();
    svg.image(frame.left, frame.top, frame.width, frame.height, &png(&frames)?);
    let scales = ticks((0.0, last - zoom.step), 8);
    let scales: Vec<(f64, String)> = scales
        .into_iter()
        .map(|(depth, _)| (depth, format!("10^{{{}}}", exponent(depth))))
        .collect();
    frame.axes(&mut svg, &scales, &half_heights(), "half height $h$", "speed $α$ − $p$");
    legend(&mut svg, frame.left, labels(frames.iter().copied()).into_iter());
    let point = format!("$M$ = {}, $p$ ≈ {:?}", zoom.mass_ratio, chart.point().0);
    svg.text(frame.left + frame.width, 28.5, Anchor::End, 11.5, &point);
    Ok(svg)
}

fn half_heights() -> Vec<(f64, String)> {
    [(-1.0, "−$h$"), (0.0, "0"), (1.0, "$h$")].map(|(at, text)| (at, text.to_owned())).to_vec()
}

/// −`depth` as text.
fn exponent(depth: f64) -> String {
    if depth == 0.0 { "0".into() } else { format!("−{depth}") }
}

/// The labels that occur, in increasing order.
fn labels<'a>(frames: impl Iterator<Item = &'a [LocalFractions]>) -> Vec<Label> {
    let mut labels: Vec<Label> = frames.flatten().flat_map(LocalFractions::labels).collect();
    labels.sort_unstable();
    labels.dedup();
    labels
}

/// The pixels of frames of equal height side by side, the highest row first.
fn png(frames: &[&[LocalFractions]]) -> Result<Vec<u8>, Error> {
    let rows = frames.first().map_or(0, |frame| frame.len());
    let mut bytes = Vec::with_capacity(3 * rows * frames.len());
    for row in (0..rows).rev() {
        for pixel in frames.iter().filter_map(|frame| frame.get(row)) {
            bytes.extend(mixed(pixel.labels().map(|label| (label, pixel.of(label).lower))));
        }
    }
    Ok(rgb_png("zoom", frames.len(), rows, &bytes)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zoom(out: PathBuf) -> Zoom {
        let speed = 11.920_553_918_335_777;
        Zoom { out, mass_ratio: 0.12, speed, frames: 3, step: 50.0, rows: 7 }
    }

    #[test]
    fn zooms_without_frames_or_edge_are_refused_before_anything_is_written() {
        let good = zoom("/nowhere".into());
        let wrong = [
            Zoom { frames: 0, ..good.clone() },
            Zoom { frames: usize::MAX, ..good.clone() },
            Zoom { rows: 0, ..good.clone() },
            Zoom { rows: usize::MAX, ..good.clone() },
            Zoom { step: 0.0, ..good.clone() },
            Zoom { step: f64::NAN, ..good.clone() },
            Zoom { step: f64::INFINITY, ..good.clone() },
            Zoom { mass_ratio: -1.0, ..good.clone() },
            Zoom { speed: f64::NAN, ..good.clone() },
            // Left of α*_1 there is no edge.
            Zoom { speed: 4.0, ..good.clone() },
        ];
        for zoom in wrong {
            assert!(run(&zoom).is_err(), "{zoom:?}");
        }
    }

    #[test]
    fn every_frame_is_a_numbered_file() {
        let name = format!("hopper_zoom_{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).unwrap();
        run(&zoom(folder.clone())).unwrap();
        for name in ["zoom_0000.png", "zoom_0001.png", "zoom_0002.png", OVERVIEW] {
            assert!(std::fs::read(folder.join(name)).unwrap().starts_with(b"\x89PNG"), "{name}");
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
