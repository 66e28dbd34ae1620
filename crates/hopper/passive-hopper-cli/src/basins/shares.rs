//! `hopper scales N`: the shares of the basins left of α*_N, over mass ratio and distance, or over mass
//! ratio and phase; with `--preimage`, on both sides of a preimage of α*_N that is followed over the mass ratio.
//!
//! A run that is killed leaves its finished columns, and the next run computes the others.

use crate::basins::call::{Call, Payload, Work};
use crate::basins::column_bytes;
use crate::basins::job::{Job, Visit, Words};
use crate::basins::job_folder::{JobFolder, Place, Results, Share};
use crate::basins::options::{mass_ratio, offset, scale};
use crate::basins::pieces::compute;
use crate::basins::rasters::{MASS_RATIOS, PIXELS};
use crate::basins::tables::{self, Tables};
use crate::basins::window::{chart, pair_of_pixels, place, range};
use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::options::values;
use crate::output::number;
use basin_of_attraction::{Grid, Interval};
use hopper_asymptotics::Offset;
use hopper_basin::{
    CircleLimits, EdgeChart, Fates, FollowedEdge, HopperFate, SHARE_VERSION, ShareColumn,
    ShareRaster, Upwards,
};
use hopper_figures::{draw_shares, share_words};
use journal_figures::{Element, Order, npy_header};
use journal_figures::{Svg, render};
use resumable_job::Pieces;
use serde_json::{Value, json};

/// The names of the results; every label has its own array.
pub(crate) const PICTURE_FILE: &str = "shares.png";
pub(crate) const LEGEND: &str = "shares.json";
pub(crate) const RESULTS: Results<'static> =
    Results { main: PICTURE_FILE, summary: LEGEND, digests: "shares.digests" };

/// The folder of finished columns.
pub(crate) const COLUMNS: &str = "columns";

/// The largest number of pixels: with five fates, the shares of so many take 340 MB.
pub(crate) const MOST_PIXELS: usize = 1 << 24;

/// Most turns of a picture: a thousand repetitions are narrower than pixels.
const MOST_TURNS: f64 = 1e3;

/// The offsets of the picture unless others are given.
const FAR: f64 = 1e-2;
const NEAR: (f64, i64) = (1.0, -300);

/// What a job of `hopper scales` is.
#[derive(Debug, Clone, PartialEq, clap::Args)]
pub(crate) struct ScalesOptions {
    /// The index n of the fixed point α*ₙ
    #[arg(value_name = "N", value_parser = scale(), allow_negative_numbers = true)]
    pub(crate) fixed_point: u64,
    /// Mass ratios from and to [default: 0.1 1]
    #[arg(short = 'M', long, num_args = 2, value_names = ["FROM", "TO"], value_parser = mass_ratio, allow_negative_numbers = true)]
    pub(crate) mass_ratio: Option<Vec<f64>>,
    /// Distances below the fixed point, on a logarithmic scale [default: 1e-2 1e-300]
    #[arg(long, num_args = 2, value_names = ["FAR", "NEAR"], value_parser = offset, allow_negative_numbers = true)]
    pub(crate) offset: Option<Vec<Offset>>,
    /// Distances from a preimage of the fixed point instead, on both sides. It is the one next to this speed at this
    /// mass ratio, followed over the mass ratios of the raster
    #[arg(long, num_args = 2, value_names = ["M", "SPEED"], conflicts_with = "turns", value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) preimage: Option<Vec<f64>>,
    /// The phase instead of the distance, so many turns of the circle of fates
    #[arg(long, value_name = "TURNS", conflicts_with = "offset", value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) turns: Option<f64>,
    /// Pixels across and up [default: 1024 1024]
    #[arg(long, num_args = 2, value_names = ["COLUMNS", "ROWS"], value_parser = values::count, allow_negative_numbers = true)]
    pub(crate) pixels: Option<Vec<usize>>,
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds and distances in m₂gω/k.",
    limits: "At most 2²⁴ pixels. A pixel has the shares of all basins that it covers, at any scale: distances down to \
             10⁻¹⁰⁰⁰⁰.\n\
             Pieces, parts and going on as in `hopper basins --help`.",
    is_filter: false,
    tables: &[&tables::SHARES, &tables::PARTS, &tables::FILES],
    examples: &[
        Example {
            about: "All scales below the second fixed point at once: two turns of the circle of fates.",
            line: "hopper scales 2 --turns 2 --mass-ratio 0.08 0.4 --pixels 8 40 --out scales",
        },
        Example {
            about: "Both sides of a preimage of the first fixed point.",
            line: "hopper scales 1 --preimage 0.12 11.92 --mass-ratio 0.115 0.125 --pixels 8 40 --out preimage",
        },
    ],
};

impl Job for ScalesOptions {
    fn words(&self) -> Words {
        let mut words = Words::of("scales");
        words.argument(Some(self.fixed_point));
        words.window(self.mass_ratio.as_deref(), None, self.pixels.as_deref());
        let offset: Option<Vec<String>> =
            self.offset.as_ref().map(|own| own.iter().map(offset_text).collect());
        words.option("--offset", offset.as_deref());
        words.option("--preimage", self.preimage.as_deref());
        words.option("--turns", self.turns.as_ref().map(std::slice::from_ref));
        words
    }

    fn visit(&self, visit: &mut Visit<'_>) -> Result<(), Error> {
        let shares = Shares::new(self)?;
        visit(&shares.description(), &shares.work(), &RESULTS)
    }

    fn run(&self, place: &Place<'_>, call: &mut Call<'_>) -> Result<Tables, Error> {
        run(place, &Shares::new(self)?, call)
    }
}

/// A raster of shares.
#[derive(Debug, Clone)]
struct Shares {
    n: u64,
    grid: Grid,
    upwards: Upwards,
    /// A mass ratio, and a speed near a preimage of α*_n there: for a raster about this preimage.
    preimage: Option<[f64; 2]>,
}

impl Shares {
    /// The raster that the options describe.
    ///
    /// # Errors
    /// [`Error::Misuse`] if there is none.
    fn new(options: &ScalesOptions) -> Result<Self, Error> {
        let preimage = options.preimage.as_deref().and_then(|pair| pair.try_into().ok());
        let upwards = (options.turns, options.offset.as_deref());
        let mass_ratio = options.mass_ratio.as_deref().unwrap_or(&MASS_RATIOS);
        let pixels = options.pixels.as_deref().unwrap_or(&PIXELS);
        let (grid, upwards) = grid(mass_ratio, pixels, upwards, preimage.is_some())?;
        Ok(Shares { n: options.fixed_point, grid, upwards, preimage })
    }

    fn description(&self) -> String {
        let Shares { n, grid, upwards, preimage } = self;
        format!(
            "shares about {n}, {upwards:?}, preimage {preimage:?}, M {:?} to {:?}, y {:?} to {:?}, {} × {} pixels; \
             computation {SHARE_VERSION}",
            grid.x.left, grid.x.right, grid.y.left, grid.y.right, grid.columns, grid.rows
        )
    }

    fn work(&self) -> Work<'static> {
        let Grid { columns, rows, .. } = self.grid;
        let payload = Payload::Column { rows, may_be_blank: self.preimage.is_some() };
        Work { folder: COLUMNS, unit: COLUMNS, count: columns, pixels: rows, payload }
    }
}

/// Computes a raster of shares.
fn run(place: &Place<'_>, shares: &Shares, call: &mut Call<'_>) -> Result<Tables, Error> {
    let &Shares { n, grid, upwards, preimage } = shares;
    let edges = preimage.map(|near| followed(n, near, &grid)).transpose()?;
    let results = [PICTURE_FILE, LEGEND, RESULTS.digests];
    let job = JobFolder::open(place, shares.description(), &results)?;
    let mut tables = Tables::default();
    let (work, count) = (shares.work(), grid.columns);
    let legend = match job.complete(&RESULTS, &work, call)? {
        Some(legend) => legend,
        None => {
            let limits = CircleLimits::default();
            let column = |at: usize| {
                let own = match &edges {
                    Some(edges) => ShareColumn::about(edges, &grid, limits, at)?,
                    None => Some(ShareColumn::left_of(n, &grid, upwards, limits, at)?),
                };
                Ok(column_bytes::bytes(own.as_ref()))
            };
            let finished = compute(&job, &work, call, column)?;
            if let Share::Part(part) = job.share {
                tables.push_part(part, COLUMNS, &finished);
                return Ok(tables);
            }
            let columns = (0..count).map(|at| column_bytes::column(&finished.kept.finished(at)?));
            let raster =
                ShareRaster::from_columns(grid, upwards, columns.collect::<Result<_, _>>()?)?;
            let notes = edges.iter().map(|edges| speeds_by_column(n, edges, call)).collect();
            let drawing = draw_shares(n, &raster)?;
            finish(&job, &raster, &drawing, notes, (finished.kept, count), &call.interrupt)?
        }
    };
    tables.shares = tables::shares(&legend);
    tables.push_file(job.place_of(PICTURE_FILE), "the picture, colours mixed by shares");
    tables.push_file(job.place_of(LEGEND), "the labels, their mean shares and arrays");
    Ok(tables)
}

/// Writes the results of a raster of shares, and removes its pieces. Returns the legend: the labels, and after them
/// the notes.
pub(crate) fn finish(
    job: &JobFolder,
    raster: &ShareRaster,
    drawing: &Svg,
    notes: Vec<Value>,
    pieces: (Pieces, usize),
    interrupt: &Interrupt,
) -> Result<Value, Error> {
    interrupt.check()?;
    job.write(PICTURE_FILE, &render("shares", drawing, 2.0)?.png)?;
    let (mut legend, mut files) = (Vec::new(), vec![PICTURE_FILE.to_owned()]);
    for (at, (label, mean)) in raster.means().into_iter().enumerate() {
        interrupt.check()?;
        let file = format!("share_{}.npy", label.code());
        let grid = raster.grid();
        let mut array = npy_header(Order::C, Element::U16, grid.rows, grid.columns);
        array.extend(share_words(raster, at));
        job.write(&file, &array)?;
        let (label, name) = (label.code(), HopperFate::label_name(label));
        legend.push(json!({ "label": label, "name": name, "mean_share": mean, "file": file }));
        files.push(file);
    }
    legend.extend(notes);
    let (legend, files) = (Value::Array(legend), files.iter().map(String::as_str));
    job.finish(&RESULTS, &files.collect::<Vec<_>>(), &legend, pieces)?;
    Ok(legend)
}

/// The preimage of α*_n near a speed at a mass ratio, followed to the middle of every column; `None` where it does
/// not exist.
fn followed(
    n: u64,
    [mass_ratio, speed]: [f64; 2],
    grid: &Grid,
) -> Result<Vec<Option<FollowedEdge>>, Error> {
    let near = [mass_ratio, speed];
    let fates = Fates::new(place("--preimage", near)?.0)?;
    let chart = chart("--preimage", near, EdgeChart::onto(&fates, n, speed))?;
    if chart.hops() == 0 {
        return Err(Error::Misuse(format!(
            "--preimage {mass_ratio} {speed}: the speed is near α*_{n} itself; leave the option out, or give a speed \
             near a preimage after at least one hop"
        )));
    }
    let start = FollowedEdge::new(&chart)?;
    let mass_ratios: Vec<f64> = (0..grid.columns).map(|at| grid.x_at(at)).collect();
    let edges = start.at_all(&mass_ratios)?;
    if edges.iter().all(Option::is_none) {
        return Err(Error::Misuse(format!(
            "--preimage {mass_ratio} {speed}: the preimage near the speed {speed} at M = {mass_ratio} exists at no \
             mass ratio of the raster, {} to {}; give mass ratios nearer to {mass_ratio} in --mass-ratio",
            grid.x.left, grid.x.right
        )));
    }
    Ok(edges)
}

/// The speeds of the preimage for the legend; a note says where it was followed.
fn speeds_by_column(n: u64, edges: &[Option<FollowedEdge>], call: &mut Call<'_>) -> Value {
    let known: Vec<&FollowedEdge> = edges.iter().flatten().collect();
    if let (Some(first), Some(last)) = (known.first(), known.last()) {
        let (count, columns, hops) = (known.len(), edges.len(), first.hops);
        call.note(&format!(
            "a preimage of α*_{n}, {hops} hops before it, in {count} of {columns} columns: M {:.9} to {:.9}",
            first.mass_ratio, last.mass_ratio
        ));
    }
    let speeds: Vec<Option<f64>> = edges.iter().map(|edge| edge.map(|edge| edge.point)).collect();
    json!({ "speed_of_the_preimage_by_column": speeds })
}

/// The grid, and what its rows are: turns if they are given, else distances.
fn grid(
    mass_ratio: &[f64],
    pixels: &[usize],
    (turns, offsets): (Option<f64>, Option<&[Offset]>),
    about_preimage: bool,
) -> Result<(Grid, Upwards), Error> {
    let [columns, rows] = pair_of_pixels(pixels)?;
    if columns == 0 || rows == 0 || columns.saturating_mul(rows) > MOST_PIXELS {
        return Err(Error::misuse(
            "--pixels",
            format!("{columns} {rows}"),
            &format!(
                "a raster of shares has at least one column and one row, and at most {MOST_PIXELS} pixels; give such \
                 numbers"
            ),
        ));
    }
    let x = range("--mass-ratio", mass_ratio)?;
    let (y, upwards) = match turns {
        Some(turns) if !(turns > 0.0 && turns <= MOST_TURNS) => {
            let reason = format!("give a positive number of turns, at most {MOST_TURNS}");
            return Err(Error::misuse("--turns", number(turns), &reason));
        }
        Some(turns) => (Interval::new(0.0, turns)?, Upwards::Phase),
        None => {
            let default = [FAR.into(), Offset::new(NEAR.0, NEAR.1)?];
            let sides = if about_preimage { Upwards::BothSides } else { Upwards::Depth };
            (depths(offsets.unwrap_or(&default))?, sides)
        }
    };
    // The edge lies between two rows.
    let rows = if upwards == Upwards::BothSides { rows.next_multiple_of(2) } else { rows };
    let grid = Grid { x, y, columns, rows };
    grid.pixels()?;
    Ok((grid, upwards))
}

fn offset_text(offset: &Offset) -> String {
    format!("{}e{}", offset.mantissa(), offset.exponent())
}

/// −log₁₀ of two distances, the larger one first.
fn depths(offsets: &[Offset]) -> Result<Interval, Error> {
    let refused = |reason: &str| {
        let given: Vec<String> = offsets.iter().map(offset_text).collect();
        Error::misuse("--offset", given.join(" "), reason)
    };
    match offsets {
        [far, near] if far.depth() < near.depth() => {
            let depths = Interval::new(far.depth(), near.depth())
                .map_err(|_| refused("give two distances other than 0, such as 1e-2 1e-300"))?;
            // Fewer doubles than pixels lie in a narrower one.
            if !(depths.length() > 1e-12 * depths.right.abs()) {
                return Err(refused("the distances differ too little; give them farther apart"));
            }
            Ok(depths)
        }
        _ => Err(refused(
            "give two distances other than 0, the larger one first, such as 1e-2 1e-300",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const M: [f64; 2] = [0.19, 0.21];

    fn offsets(texts: [&str; 2]) -> Vec<Offset> {
        texts.map(|text| text.parse().unwrap()).to_vec()
    }

    #[test]
    fn rasters_without_pixels_are_refused() {
        let good = offsets(["-1e-2", "1e-1000"]);
        let (found, upwards) = grid(&M, &[2, 5], (None, Some(&good)), false).unwrap();
        assert_eq!((upwards, found.y.left, found.y.right), (Upwards::Depth, 2.0, 1000.0));
        let refused = |result: Result<(Grid, Upwards), Error>, option: &str| {
            let error = result.unwrap_err();
            assert_eq!(error.exit_status(), 2, "{error}");
            let text = error.to_string();
            assert!(text.starts_with(option) && text.contains("give "), "{text}");
        };
        for texts in [["1e-3", "1e-3"], ["1e-9", "1e-3"], ["0", "1e-3"], ["1e-3", "0"]] {
            refused(grid(&M, &[2, 5], (None, Some(&offsets(texts))), false), "--offset ");
        }
        for turns in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            refused(grid(&M, &[2, 5], (Some(turns), None), false), "--turns ");
        }
        for pixels in [[0, 5], [5, 0], [1 << 20, 1 << 20], [usize::MAX, 2]] {
            refused(grid(&M, &pixels, (None, None), false), "--pixels ");
        }
        for mass_ratio in [[0.2, 0.2], [0.3, 0.2], [0.1, f64::NAN]] {
            refused(grid(&mass_ratio, &[2, 5], (None, None), false), "--mass-ratio ");
        }
    }

    /// The preimage near 11.9206 at M = 0.12 meets its twin between M = 0.1169 and 0.1175; columns below are blank.
    #[test]
    fn a_preimage_is_followed_as_far_as_it_exists() {
        let about = |near, mass_ratio: [f64; 2]| {
            let rows = offsets(["1e-2", "1e-300"]);
            let (grid, upwards) = grid(&mass_ratio, &[20, 5], (None, Some(&rows)), true).unwrap();
            assert_eq!((upwards, grid.rows), (Upwards::BothSides, 6));
            followed(2, near, &grid).map(|edges| (grid, edges))
        };
        let (grid, edges) = about([0.12, 11.9206], [0.11, 0.13]).unwrap();
        for (at, edge) in edges.iter().enumerate() {
            assert_eq!(edge.is_some(), grid.x_at(at) > 0.1174, "{}", grid.x_at(at));
        }
        for (near, words) in [
            ([0.12, 7.725], "is near α*_2 itself"),
            ([0.12, 4.6], "no speed within"),
            ([0.12, f64::NAN], "NaN"),
            ([-0.12, 11.9206], "-0.12"),
        ] {
            let error = about(near, [0.11, 0.13]).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
        let error = about([0.12, 11.9206], [0.01, 0.02]).unwrap_err().to_string();
        assert!(error.contains("at no mass ratio of the raster, 0.01 to 0.02"), "{error}");
    }
}
