//! `basin-raster --zoom M SPEED`: frames into an edge of a basin, from a half height of 1 down to any depth.
//!
//! A run that is killed leaves its finished frames, and the next run computes the others.

use super::kept;
use crate::error::Error;
use basin_of_attraction::Label;
use hopper_basin::{
    CircleLimits, EdgeChart, Fates, FollowedEdge, LocalFractions, PhaseBasins, edge_frame,
    edge_window, frame_slant,
};
use hopper_figures::fate_colors::mixed;
use hopper_figures::{legend, share_pixels};
use journal_figures::{Anchor, Frame, Svg, animated_png, render, rgb_png, ticks};
use passive_hopper::MassRatio;
use repository_tools::{Folder, say};
use resumable_job::{AtomicFile, Lock};
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
    pub(super) columns: usize,
    pub(super) rows: usize,
}

/// The largest number of frames: the animation keeps all of them in memory, some 50 kB each.
const MOST_FRAMES: usize = 2000;

/// The largest number of pixels of a frame each way. A frame of 2048² has 16 million fates above the scale of the chart.
const MOST_PIXELS: usize = 1 << 11;

/// Below this depth an offset's decimal exponent has no meaning for a reader any more; larger ones are refused by the library.
const DEEPEST: f64 = 1e4;

/// The time of a frame in the animation.
const SECONDS: f64 = 0.2;

/// The picture of all frames as strips, and the animation.
const OVERVIEW: &str = "zoom.png";
const ANIMATION: &str = "zoom_animation.png";

/// Runs the command.
pub(super) fn run(zoom: &Zoom) -> Result<(), Error> {
    let zoom = &checked(zoom)?;
    let &Zoom { mass_ratio, speed, frames, step, columns, rows, .. } = zoom;
    let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
    let chart = EdgeChart::near(&fates, speed)?;
    let edge = FollowedEdge::new(&chart)?;
    let circle = PhaseBasins::new(&fates, chart.n(), CircleLimits::default())?;
    let folder = Folder::open(&zoom.out)?;
    let lock = Lock::take(folder.path(), "basin-raster")?;
    // A result that cannot have its name is an error before the computation.
    for name in [OVERVIEW, ANIMATION] {
        drop(AtomicFile::create(&folder.path().join(name))?);
    }
    let description = format!(
        "zoom, M {mass_ratio:?}, speed {speed:?}, {step:?} decades a frame, {columns} × {rows} pixels"
    );
    let piece = |at: usize| -> Result<Vec<u8>, Error> {
        let depth = step * at as f64;
        let strip = edge_window(&fates, &chart, &circle, depth, rows)?;
        let window = edge_frame(&fates, (&chart, &edge), &circle, depth, (columns, rows))?;
        let mut labels: Vec<Label> = strip.iter().flat_map(LocalFractions::labels).collect();
        labels.extend(window.labels());
        labels.sort_unstable();
        labels.dedup();
        let mix = |pixel: &LocalFractions| mixed(pixel.labels().map(|l| (l, pixel.of(l).lower)));
        let strip = strip.iter().rev().flat_map(mix).collect();
        Ok(Drawn { labels, strip, window: share_pixels(&window) }.bytes())
    };
    let (kept, all) = kept::pieces(&folder, &lock, ("frames", &description), frames, piece)?;
    let drawn = all.iter().map(|bytes| Drawn::new(bytes, zoom)).collect::<Result<Vec<_>, _>>()?;
    let mut pngs = Vec::with_capacity(frames);
    for (at, frame) in drawn.iter().enumerate() {
        let svg = draw_frame(zoom, &chart, &edge, step * at as f64, frame)?;
        pngs.push(render("frame", &svg, 1.5)?.png);
        lock.confirm()?;
        folder.write(&format!("zoom_{at:04}.png"), &pngs[at])?;
    }
    let overview = render("zoom", &draw_all(zoom, &chart, &drawn)?, 2.0)?;
    let animation = animated_png(ANIMATION, &pngs, SECONDS)?;
    lock.confirm()?;
    folder.write(OVERVIEW, &overview.png)?;
    folder.write(ANIMATION, &animation)?;
    kept.remove(frames)?;
    folder.remove_leftovers();
    drop(lock);
    let (point, rest, error) = chart.point();
    say(format_args!(
        "edge {point:?} + {rest:e} ± {error:.0e}, at α*_{} after {} hops; dp/dM = {:.6}",
        chart.n(),
        chart.hops(),
        edge.by_mass_ratio
    ))?;
    say(format_args!("{frames} frames, {}", folder.path().join(OVERVIEW).display()))?;
    say(folder.path().join(ANIMATION).display())?;
    Ok(())
}

/// The options, if they make sense, with an even number of rows: the edge lies between two of them.
fn checked(zoom: &Zoom) -> Result<Zoom, Error> {
    let &Zoom { frames, step, columns, rows, .. } = zoom;
    let pixels = |count: usize| (2..=MOST_PIXELS).contains(&count);
    let fail = |text: String| Err(Error::CheckFailed(text));
    if !(1..=MOST_FRAMES).contains(&frames) {
        return fail(format!("--frames {frames}: a zoom has 1 to {MOST_FRAMES} frames"));
    }
    if !(step > 0.0 && step * frames as f64 <= DEEPEST) {
        return fail(format!(
            "--step {step} with {frames} frames: give a positive step, and at most {DEEPEST} decades in all"
        ));
    }
    if !(pixels(columns) && pixels(rows)) {
        return fail(format!(
            "--pixels {columns} {rows}: a frame has 2 to {MOST_PIXELS} pixels each way"
        ));
    }
    Ok(Zoom { rows: rows.next_multiple_of(2), ..zoom.clone() })
}

/// A frame in colours, the highest row first.
struct Drawn {
    /// In increasing order.
    labels: Vec<Label>,
    /// One column, at the mass ratio of the middle.
    strip: Vec<u8>,
    /// The window of mass ratio and speed.
    window: Vec<u8>,
}

impl Drawn {
    /// The number of labels, the labels, the strip and the window.
    fn bytes(&self) -> Vec<u8> {
        let mut bytes = (self.labels.len() as u16).to_le_bytes().to_vec();
        bytes.extend(self.labels.iter().flat_map(|label| label.code().to_le_bytes()));
        bytes.extend(&self.strip);
        bytes.extend(&self.window);
        bytes
    }

    /// The inverse of [`bytes`](Self::bytes).
    fn new(bytes: &[u8], zoom: &Zoom) -> Result<Self, Error> {
        let short =
            || Error::unreadable("a frame", "it has another number of bytes than its pixels");
        let (count, rest) = bytes.split_first_chunk::<2>().ok_or_else(short)?;
        let count = 2 * usize::from(u16::from_le_bytes(*count));
        let (labels, rest) = rest.split_at_checked(count).ok_or_else(short)?;
        let (strip, window) = rest.split_at_checked(3 * zoom.rows).ok_or_else(short)?;
        if window.len() != 3 * zoom.rows * zoom.columns {
            return Err(short());
        }
        let labels = labels
            .as_chunks::<2>()
            .0
            .iter()
            .map(|pair| Label::from_code(u16::from_le_bytes(*pair)));
        Ok(Drawn { labels: labels.collect(), strip: strip.to_vec(), window: window.to_vec() })
    }
}

/// One frame, with the scale written in.
fn draw_frame(
    zoom: &Zoom,
    chart: &EdgeChart,
    edge: &FollowedEdge,
    depth: f64,
    drawn: &Drawn,
) -> Result<Svg, Error> {
    let mut svg = Svg::new(440.0, 500.0);
    let frame = Frame::linear(70.0, 64.0, 350.0, 380.0, (-1.0, 1.0), (-1.0, 1.0));
    let image = rgb_png("zoom", zoom.columns, zoom.rows, &drawn.window)?;
    svg.image(frame.left, frame.top, frame.width, frame.height, &image);
    let slant = frame_slant(edge);
    let x_label = format!("mass ratio $M$ − {},   $w$ = {slant:.3} $h$", zoom.mass_ratio);
    frame.axes(&mut svg, &half_heights("$w$"), &half_heights("$h$"), &x_label, "speed $α$ − $p$");
    legend(&mut svg, frame.left, drawn.labels.iter().copied());
    let scale = format!("$h$ = 10^{{{}}}", exponent(depth));
    svg.text(frame.left, 54.0, Anchor::Start, 16.0, &scale);
    let point = format!("$p$ ≈ {:?}", chart.point().0);
    svg.text(frame.left + frame.width, 54.0, Anchor::End, 11.5, &point);
    Ok(svg)
}

/// The middle strips of all frames side by side.
fn draw_all(zoom: &Zoom, chart: &EdgeChart, all: &[Drawn]) -> Result<Svg, Error> {
    let mut svg = Svg::new(860.0, 480.0);
    let last = zoom.step * zoom.frames as f64;
    let x = (-0.5 * zoom.step, last - 0.5 * zoom.step);
    let frame = Frame::linear(70.0, 54.0, 760.0, 370.0, x, (-1.0, 1.0));
    let row = |row: usize| all.iter().flat_map(move |drawn| &drawn.strip[3 * row..3 * row + 3]);
    let pixels: Vec<u8> = (0..zoom.rows).flat_map(row).copied().collect();
    let image = rgb_png("zoom", all.len(), zoom.rows, &pixels)?;
    svg.image(frame.left, frame.top, frame.width, frame.height, &image);
    let scales = ticks((0.0, last - zoom.step), 8);
    let scales: Vec<(f64, String)> = scales
        .into_iter()
        .map(|(depth, _)| (depth, format!("10^{{{}}}", exponent(depth))))
        .collect();
    frame.axes(&mut svg, &scales, &half_heights("$h$"), "half height $h$", "speed $α$ − $p$");
    let mut labels: Vec<Label> = all.iter().flat_map(|drawn| drawn.labels.clone()).collect();
    labels.sort_unstable();
    labels.dedup();
    legend(&mut svg, frame.left, labels.into_iter());
    let point = format!("$M$ = {}, $p$ ≈ {:?}", zoom.mass_ratio, chart.point().0);
    svg.text(frame.left + frame.width, 28.5, Anchor::End, 11.5, &point);
    Ok(svg)
}

/// The middle and both ends of an axis.
fn half_heights(half: &str) -> Vec<(f64, String)> {
    vec![(-1.0, format!("−{half}")), (0.0, "0".into()), (1.0, half.into())]
}

/// −`depth` as text.
fn exponent(depth: f64) -> String {
    if depth == 0.0 { "0".into() } else { format!("−{depth}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zoom(out: PathBuf) -> Zoom {
        let speed = 11.920_553_918_335_777;
        Zoom { out, mass_ratio: 0.12, speed, frames: 3, step: 50.0, columns: 9, rows: 7 }
    }

    #[test]
    fn zooms_without_frames_or_edge_are_refused_before_anything_is_written() {
        let good = zoom("/nowhere".into());
        let wrong = [
            Zoom { frames: 0, ..good.clone() },
            Zoom { frames: usize::MAX, ..good.clone() },
            Zoom { rows: 0, ..good.clone() },
            Zoom { rows: usize::MAX, ..good.clone() },
            Zoom { columns: 0, ..good.clone() },
            Zoom { step: 1e9, ..good.clone() },
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
        for name in ["zoom_0000.png", "zoom_0001.png", "zoom_0002.png", OVERVIEW, ANIMATION] {
            assert!(std::fs::read(folder.join(name)).unwrap().starts_with(b"\x89PNG"), "{name}");
        }
        assert!(!folder.join("frames").exists());
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
