//! `hopper zoom M SPEED`: frames into an edge of a basin, from a half height of 1 down to any depth.
//!
//! A run that is killed leaves its finished frames, and the next run computes the others.

use crate::basins::call::{Call, Payload, Work};
use crate::basins::job::{Job, Visit, Words};
use crate::basins::job_folder::{JobFolder, Place, Results, Share};
use crate::basins::pieces::compute;
use crate::basins::tables::{self, Tables};
use crate::basins::window::{chart, pair_of_pixels, place as place_of_edge};
use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::values;
use crate::output::number;
use basin_of_attraction::Label;
use hopper_basin::{
    CircleLimits, EdgeChart, Fates, FollowedEdge, PhaseBasins, SHARE_VERSION, edge_frame,
    edge_window, enclosed_edge_slope,
};
use hopper_figures::{ZoomPixels, draw_zoom, draw_zoom_frame};
use journal_figures::{animated_png, render};
use serde_json::json;

/// The version of the colours in finished frames. It is raised when the same shares get other bytes; a test
/// compares a digest.
const FRAME_VERSION: u32 = 1;

/// What a job of `hopper zoom` is.
#[derive(Debug, Clone, PartialEq, clap::Args)]
pub(crate) struct ZoomOptions {
    /// The mass ratio M = m₂/m₁ of the edge
    #[arg(value_name = "M", value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) mass_ratio: f64,
    /// A lift-off speed next to the edge, in m₂gω/k
    #[arg(value_name = "SPEED", value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) speed: f64,
    /// The number of frames; the first has the half height 1 [default: 101]
    #[arg(long, value_name = "COUNT", value_parser = values::count, allow_negative_numbers = true)]
    pub(crate) frames: Option<usize>,
    /// Decades from one frame to the next [default: 1]
    #[arg(long, value_name = "DECADES", value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) step: Option<f64>,
    /// Pixels across and up [default: 320 320]
    #[arg(long, num_args = 2, value_names = ["COLUMNS", "ROWS"], value_parser = values::count, allow_negative_numbers = true)]
    pub(crate) pixels: Option<Vec<usize>>,
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds in m₂gω/k.",
    limits: "2 to 2048 pixels a side; 1 to 2000 frames, down to 10⁻¹⁰⁰⁰⁰.\n\
             Pieces, parts and going on as in `hopper basins --help`.",
    is_filter: false,
    tables: &[&tables::EDGE, &tables::PARTS, &tables::FILES],
    examples: &[
        Example {
            about: "Three frames into the edge next to a speed, to 10⁻¹⁰⁰.",
            line: "hopper zoom 0.12 11.92 --frames 3 --step 50 --pixels 32 32 --out zoom",
        },
        Example {
            about: "Where the edge is, for a program.",
            line: "hopper zoom 0.12 11.92 --frames 1 --pixels 16 16 --out edge --csv",
        },
    ],
};

/// Frames, decades between two of them, and pixels unless others are given.
const DEFAULT_FRAMES: usize = 101;
const DEFAULT_STEP: f64 = 1.0;
const DEFAULT_PIXELS: [usize; 2] = [320, 320];

impl ZoomOptions {
    fn zoom(&self) -> Result<Zoom, Error> {
        let [columns, rows] = pair_of_pixels(self.pixels.as_deref().unwrap_or(&DEFAULT_PIXELS))?;
        let &ZoomOptions { mass_ratio, speed, frames, step, .. } = self;
        let (frames, step) = (frames.unwrap_or(DEFAULT_FRAMES), step.unwrap_or(DEFAULT_STEP));
        checked(&Zoom { mass_ratio, speed, frames, step, columns, rows })
    }
}

impl Job for ZoomOptions {
    fn words(&self) -> Words {
        let mut words = Words::of("zoom");
        words.argument(Some(self.mass_ratio));
        words.argument(Some(self.speed));
        words.option("--frames", self.frames.as_ref().map(std::slice::from_ref));
        words.option("--step", self.step.as_ref().map(std::slice::from_ref));
        words.window(None, None, self.pixels.as_deref());
        words
    }

    fn visit(&self, visit: &mut Visit<'_>) -> Result<(), Error> {
        let zoom = self.zoom()?;
        visit(&zoom.description(), &zoom.work(), &RESULTS)
    }

    fn run(&self, place: &Place<'_>, call: &mut Call<'_>) -> Result<Tables, Error> {
        run(place, &self.zoom()?, call)
    }
}

/// The frames.
#[derive(Debug, Clone)]
struct Zoom {
    mass_ratio: f64,
    /// A speed next to the edge.
    speed: f64,
    /// The number of frames; the first one has the half height 1.
    frames: usize,
    /// Decades between two frames.
    step: f64,
    columns: usize,
    rows: usize,
}

/// The largest number of frames: the animation keeps all of them in memory, some 50 kB each.
const MOST_FRAMES: usize = 2000;

/// The largest number of pixels of a frame each way. A frame of 2048² has 16 million fates above the scale of the
/// chart.
const MOST_PIXELS: usize = 1 << 11;

/// Below this depth an offset's decimal exponent has no meaning for a reader any more; larger ones are refused by
/// the library.
const DEEPEST: f64 = 1e4;

/// The time of a frame in the animation.
const SECONDS: f64 = 0.2;

/// The picture of all frames as strips, the animation, and the summary.
const OVERVIEW: &str = "zoom.png";
const ANIMATION: &str = "zoom_animation.png";
const SUMMARY: &str = "zoom.json";
const RESULTS: Results<'static> =
    Results { main: ANIMATION, summary: SUMMARY, digests: "zoom.digests" };

/// The arguments that choose the edge.
const OPTION: &str = "M SPEED";

/// The folder of finished frames.
const FRAMES: &str = "frames";

impl Zoom {
    fn description(&self) -> String {
        let Zoom { mass_ratio, speed, frames, step, columns, rows } = self;
        format!(
            "zoom, M {mass_ratio:?}, speed {speed:?}, {frames} frames, {step:?} decades a frame, {columns} × {rows} \
             pixels; computation {SHARE_VERSION}, colours {FRAME_VERSION}"
        )
    }

    fn work(&self) -> Work<'static> {
        let &Zoom { rows, columns, frames, .. } = self;
        let payload = Payload::Frame { rows, columns };
        Work { folder: FRAMES, unit: FRAMES, count: frames, pixels: columns * rows, payload }
    }
}

/// Computes and draws the frames.
fn run(place: &Place<'_>, zoom: &Zoom, call: &mut Call<'_>) -> Result<Tables, Error> {
    let &Zoom { mass_ratio, speed, frames, step, columns, rows } = zoom;
    let fates = Fates::new(place_of_edge(OPTION, [mass_ratio, speed])?.0)?;
    let chart = chart(OPTION, [mass_ratio, speed], EdgeChart::near(&fates, speed))?;
    let edge = FollowedEdge::new(&chart)?;
    let results = [OVERVIEW, ANIMATION, SUMMARY, RESULTS.digests];
    let job = JobFolder::open(place, zoom.description(), &results)?;
    let mut tables = Tables::default();
    let work = zoom.work();
    let summary = match job.complete(&RESULTS, &work, call)? {
        Some(summary) => summary,
        None => {
            let circle = PhaseBasins::new(&fates, chart.n(), CircleLimits::default())?;
            let finished = compute(&job, &work, call, |at| {
                Ok(bytes(&drawn(zoom, &fates, (&chart, &edge), &circle, step * at as f64)?))
            })?;
            if let Share::Part(part) = job.share {
                tables.push_part(part, FRAMES, &finished);
                return Ok(tables);
            }
            let drawn = (0..frames).map(|at| frame(&finished.kept.finished(at)?, zoom));
            let drawn = drawn.collect::<Result<Vec<_>, Error>>()?;
            let mut pngs = Vec::with_capacity(frames);
            let mut files = Vec::with_capacity(frames + 2);
            for (at, frame) in drawn.iter().enumerate() {
                call.interrupt.check()?;
                let svg = draw_zoom_frame(&chart, &edge, step * at as f64, (columns, rows), frame)?;
                pngs.push(render("frame", &svg, 1.5)?.png);
                files.push(format!("zoom_{at:04}.png"));
                job.write(&files[at], &pngs[at])?;
            }
            let overview = render("zoom", &draw_zoom(&chart, step, rows, &drawn)?, 2.0)?;
            job.write(OVERVIEW, &overview.png)?;
            job.write(ANIMATION, &animated_png(ANIMATION, &pngs, SECONDS)?)?;
            let (point, rest, error) = chart.point();
            let known = enclosed_edge_slope(fates.map(), &chart);
            let slope_error = known.map(|known| known.error_of(edge.by_mass_ratio));
            let summary = json!({
                "slope_error": slope_error, "speed": point, "rest": rest, "error": error, "fixed_point": chart.n(),
                "hops": chart.hops(), "slope": edge.by_mass_ratio, "frames": frames,
            });
            files.extend([OVERVIEW, ANIMATION].map(str::to_owned));
            let files: Vec<&str> = files.iter().map(String::as_str).collect();
            job.finish(&RESULTS, &files, &summary, (finished.kept, frames))?;
            summary
        }
    };
    tables.edge = tables::edge(&summary);
    tables.push_file(
        job.place_of("zoom_0000.png"),
        "the first frame; the others follow in its order",
    );
    tables.push_file(job.place_of(OVERVIEW), "the middle columns of all frames side by side");
    tables.push_file(job.place_of(ANIMATION), "an animated PNG of all frames");
    Ok(tables)
}

/// The frame of half height 10^−depth.
fn drawn(
    zoom: &Zoom,
    fates: &Fates,
    (chart, edge): (&EdgeChart, &FollowedEdge),
    circle: &PhaseBasins,
    depth: f64,
) -> Result<ZoomPixels, Error> {
    let strip = edge_window(fates, chart, circle, depth, zoom.rows)?;
    let window = edge_frame(fates, (chart, edge), circle, depth, (zoom.columns, zoom.rows))?;
    Ok(ZoomPixels::new(&strip, &window))
}

/// The options, if they make sense, with an even number of rows: the edge lies between two of them.
fn checked(zoom: &Zoom) -> Result<Zoom, Error> {
    let &Zoom { frames, step, columns, rows, .. } = zoom;
    let pixels = |count: usize| (2..=MOST_PIXELS).contains(&count);
    if !(1..=MOST_FRAMES).contains(&frames) {
        let reason = format!("a zoom has 1 to {MOST_FRAMES} frames; give such a number");
        return Err(Error::misuse("--frames", frames, &reason));
    }
    if !(step > 0.0 && step * frames as f64 <= DEEPEST) {
        let reason = format!(
            "with {frames} frames; give a positive step, and at most {DEEPEST} decades in all"
        );
        return Err(Error::misuse("--step", number(step), &reason));
    }
    if !(pixels(columns) && pixels(rows)) {
        let reason = format!("a frame has 2 to {MOST_PIXELS} pixels each way; give such numbers");
        return Err(Error::misuse("--pixels", format!("{columns} {rows}"), &reason));
    }
    Ok(Zoom { rows: rows.next_multiple_of(2), ..zoom.clone() })
}

/// A finished frame: the number of labels, the labels, the strip and the window.
fn bytes(frame: &ZoomPixels) -> Vec<u8> {
    let mut bytes = (frame.labels.len() as u16).to_le_bytes().to_vec();
    bytes.extend(frame.labels.iter().flat_map(|label| label.code().to_le_bytes()));
    bytes.extend(&frame.strip);
    bytes.extend(&frame.window);
    bytes
}

/// The inverse of [`bytes`].
fn frame(bytes: &[u8], zoom: &Zoom) -> Result<ZoomPixels, Error> {
    let short =
        || Error::Unreadable("a finished frame has another number of bytes than its pixels".into());
    let (count, rest) = bytes.split_first_chunk::<2>().ok_or_else(short)?;
    let count = 2 * usize::from(u16::from_le_bytes(*count));
    let (labels, rest) = rest.split_at_checked(count).ok_or_else(short)?;
    let (strip, window) = rest.split_at_checked(3 * zoom.rows).ok_or_else(short)?;
    if window.len() != 3 * zoom.rows * zoom.columns {
        return Err(short());
    }
    let labels =
        labels.as_chunks::<2>().0.iter().map(|pair| Label::from_code(u16::from_le_bytes(*pair)));
    Ok(ZoomPixels { labels: labels.collect(), strip: strip.to_vec(), window: window.to_vec() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::MassRatio;

    fn zoom() -> Zoom {
        let speed = 11.920_553_918_335_777;
        Zoom { mass_ratio: 0.12, speed, frames: 3, step: 50.0, columns: 9, rows: 7 }
    }

    #[test]
    fn zooms_without_frames_are_refused() {
        let good = zoom();
        assert_eq!(checked(&good).unwrap().rows, 8);
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
        ];
        for zoom in wrong {
            let error = checked(&zoom).unwrap_err();
            assert_eq!(error.exit_status(), 2);
            assert!(error.to_string().starts_with("--") && error.to_string().contains("give "));
        }
    }

    /// The bytes of a finished frame come back, and belong to their version.
    #[test]
    fn frames_are_those_of_their_version() {
        let zoom = checked(&zoom()).unwrap();
        let fates = Fates::new(MassRatio::new(zoom.mass_ratio).unwrap()).unwrap();
        let chart = EdgeChart::near(&fates, zoom.speed).unwrap();
        let edge = FollowedEdge::new(&chart).unwrap();
        let circle = PhaseBasins::new(&fates, chart.n(), CircleLimits::default()).unwrap();
        let all = [1.0, 50.0]
            .map(|depth| bytes(&drawn(&zoom, &fates, (&chart, &edge), &circle, depth).unwrap()));
        for own in &all {
            assert_eq!(bytes(&frame(own, &zoom).unwrap()), *own);
            assert!(frame(&own[..own.len() - 1], &zoom).is_err());
        }
        let found = (FRAME_VERSION, resumable_job::digest(&all.concat()));
        assert_eq!(found, (1, "7c479e53d6159aad".to_owned()));
    }
}
