//! A small picture of the basins without a folder: on the terminal, or in a file.

use crate::basins::layer::{SHARPNESS, StoredLayer, TILE, window};
use crate::basins::options::Options;
use crate::commands::orbit::drawing_of;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::options::output_file;
use crate::streams::Streams;
use basin_of_attraction::{Grid, Label};
use hopper_figures::{Meaning, draw_layer, label_of};
use rayon::prelude::*;
use std::fmt::Write;

/// Columns and rows of a preview: they fit a terminal of 80 × 24 characters, of which each has two pixels.
pub(crate) const PIXELS: [usize; 2] = [72, 40];

/// Pixels of a picture unless others are given: as many as its frame shows.
pub(crate) const PIXELS_OF_PICTURE: [usize; 2] = [hopper_figures::PIXELS, hopper_figures::PIXELS];

/// The most pixels: they stay in memory, and an interrupted call loses them.
const MOST_PIXELS: usize = 1 << 22;

/// Prints or writes the first layer.
///
/// # Errors
/// [`Error::Misuse`] for a window that no raster has, and for too many pixels; [`Error::Interrupted`] after a signal.
pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    if !options.output.is_plain() {
        let reason = "a picture without a folder is no table; give a folder with --out, or leave out --csv, --json, --ndjson and --table";
        return Err(Error::Misuse(format!("--out: {reason}")));
    }
    output_file::check(&[("--picture", options.picture.as_ref())])?;
    let pixels = if options.picture.is_some() { PIXELS_OF_PICTURE } else { PIXELS };
    let grid = options.job.grid(pixels)?;
    let (columns, rows) = (grid.columns, grid.rows);
    if columns * rows > MOST_PIXELS {
        let reason = format!(
            "without a folder there are at most {MOST_PIXELS} pixels; give fewer, or a folder with --out"
        );
        return Err(Error::misuse("--pixels", format!("{columns} {rows}"), &reason));
    }
    let layers = options.job.layers();
    let [layer] = &layers[..] else {
        let reason = "without a folder one layer is shown; give one, or a folder with --out";
        return Err(Error::misuse("--layer", options.job.layer.join(" "), reason));
    };
    let pixels = computed(layer, &grid)?;
    match &options.picture {
        Some(file) => {
            let name = layer.layer.file;
            let svg =
                draw_layer((layer.layer, layer.values), &window(&grid, name), &grid, &pixels)?;
            let bytes = drawing_of(name, file.format, &svg, SHARPNESS)?;
            file.write(&bytes, &options.output, &mut streams)
        }
        None => {
            let text = text(layer, &grid, &pixels, streams.output_has_colors);
            streams.output.write_all(text.as_bytes()).map_err(Error::output)
        }
    }
}

/// The numbers of a layer, row after row from the lowest one.
fn computed(layer: &StoredLayer, grid: &Grid) -> Result<Vec<u64>, Error> {
    let interrupt = Interrupt::watch()?;
    let tiles = (0..grid.columns.div_ceil(TILE)).into_par_iter();
    let tiles = tiles
        .map(|tile| layer.tile(grid, tile, &interrupt))
        .collect::<Result<Vec<_>, Error>>()
        .map_err(Error::without_pieces)?;
    let numbers: Vec<u64> = tiles.iter().flat_map(|bytes| layer.numbers(bytes)).collect();
    let (columns, rows) = (grid.columns, grid.rows);
    let at = |pixel: usize| numbers[pixel % columns * rows + pixel / columns];
    Ok((0..columns * rows).map(at).collect())
}

/// The picture in characters, with the ends of its axes. With colours a character has two pixels, one above the other.
fn text(layer: &StoredLayer, grid: &Grid, pixels: &[u64], colors: bool) -> String {
    let columns = grid.columns;
    let line = |row: usize| pixels.get(row * columns..(row + 1) * columns).unwrap_or_default();
    // Writing to a string does not fail.
    let mut text = format!("α {}\n", short(grid.y.right));
    for row in (0..grid.rows).rev().step_by(2) {
        let (upper, lower) = (line(row), line(row.wrapping_sub(1)));
        for (at, &value) in upper.iter().enumerate() {
            let below = lower.get(at).copied();
            match colors {
                true => append_colored(layer, value, below, &mut text),
                false => text.push(sign(layer, value)),
            }
        }
        text += if colors { "\u{1b}[0m\n" } else { "\n" };
    }
    let _ = writeln!(text, "α {}", short(grid.y.left));
    let (left, right) = (format!("M {}", short(grid.x.left)), format!("M {}", short(grid.x.right)));
    let width = columns.saturating_sub(right.len());
    let _ = writeln!(text, "{left:width$}{right}");
    text
}

/// An end of an axis, to read and not to compute with.
fn short(number: f64) -> String {
    let rounded = format!("{number:.5e}").parse().unwrap_or(number);
    crate::output::number(rounded)
}

fn append_colored(layer: &StoredLayer, value: u64, below: Option<u64>, text: &mut String) {
    let [red, green, blue] = layer.values.color(value);
    let _ = write!(text, "\u{1b}[38;2;{red};{green};{blue}m");
    let _ = match below.map(|value| layer.values.color(value)) {
        Some([red, green, blue]) => write!(text, "\u{1b}[48;2;{red};{green};{blue}m▀"),
        None => write!(text, "\u{1b}[49m▀"),
    };
}

/// The sign of a number: of a fate as the help says; else a digit from the smallest to the largest colour.
fn sign(layer: &StoredLayer, value: u64) -> char {
    match layer.values.meaning {
        Meaning::Fates { .. } => match label_of(value) {
            Label::UNDECIDED | Label::OUTSIDE => '?',
            label if label.code() == 0 => '.',
            label => match u32::from(label.code()) {
                code @ 1..=9 => char::from_digit(code, 10).unwrap_or('+'),
                _ if hopper_basin::HopperFate::label_name(label) == "grounded" => '#',
                _ => '+',
            },
        },
        Meaning::Numbers { .. } | Meaning::Reals(_) => {
            // The lightness of a colour, which all scales have: from 9, light, to 0, dark.
            let [red, green, blue] = layer.values.color(value).map(u32::from);
            let lightness = (3 * red + 6 * green + blue) / 10;
            char::from_digit(lightness * 9 / 255, 10).unwrap_or('?')
        }
    }
}
