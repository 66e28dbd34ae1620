//! `basin-raster --about N`: the shares of the basins left of α*_N, over mass ratio and distance, or over mass ratio and phase; with
//! `--preimage`, on both sides of a preimage of α*_N that is followed over the mass ratio.
//!
//! A run that is killed leaves its finished columns, and the next run computes the others.

use super::{column_bytes, kept};
use crate::error::Error;
use crate::figures::share_plot::{draw_shares, share_array};
use basin_of_attraction::{Grid, Interval};
use hopper_asymptotics::Offset;
use hopper_basin::{
    CircleLimits, EdgeChart, Fates, FollowedEdge, HopperFate, ShareColumn, ShareRaster, Upwards,
};
use journal_figures::{Svg, render};
use passive_hopper::MassRatio;
use repository_tools::{Folder, say};
use resumable_job::{AtomicFile, Lock};
use std::path::PathBuf;

/// The names of the results; every label has its own array.
pub(super) const PICTURE_FILE: &str = "shares.png";
pub(super) const LEGEND: &str = "shares.json";

/// The largest number of pixels: with five fates, the shares of so many take 340 MB.
pub(super) const MOST_PIXELS: usize = 1 << 24;

/// Most turns of a picture: a thousand repetitions are narrower than pixels.
const MOST_TURNS: f64 = 1e3;

/// The offsets of the picture unless others are given.
const FAR: f64 = 1e-2;
const NEAR: (f64, i64) = (1.0, -300);

/// The raster and its folder.
#[derive(Debug, Clone)]
pub(super) struct Shares {
    pub(super) n: u64,
    pub(super) out: PathBuf,
    pub(super) mass_ratio: Vec<f64>,
    pub(super) pixels: Vec<usize>,
    /// The larger distance first.
    pub(super) offset: Option<Vec<Offset>>,
    /// For a raster over the phase.
    pub(super) turns: Option<f64>,
    /// A mass ratio, and a speed near a preimage of α*_n there: for a raster about this preimage.
    pub(super) preimage: Option<[f64; 2]>,
}

/// Runs the command for the circle of α*_n.
pub(super) fn run(options: &Shares) -> Result<(), Error> {
    let n = options.n;
    let largest = HopperFate::LARGEST_LABEL;
    if !(1..=largest).contains(&n) {
        return Err(hopper_basin::Error::Index { n, smallest: 1, largest }.into());
    }
    let (grid, upwards) = grid(options)?;
    let edges = options.preimage.map(|near| followed(n, near, &grid)).transpose()?;
    let folder = Folder::open(&options.out)?;
    let lock = Lock::take(folder.path(), "basin-raster")?;
    // A result that cannot have its name is an error before the computation.
    for name in [PICTURE_FILE, LEGEND] {
        drop(AtomicFile::create(&folder.path().join(name))?);
    }
    let description = format!(
        "shares about {n}, {upwards:?}, preimage {:?}, M {:?} to {:?}, y {:?} to {:?}, {} × {} pixels",
        options.preimage,
        grid.x.left,
        grid.x.right,
        grid.y.left,
        grid.y.right,
        grid.columns,
        grid.rows
    );
    let limits = CircleLimits::default();
    let column = |at: usize| {
        let own = match &edges {
            Some(edges) => ShareColumn::about(edges, &grid, limits, at)?,
            None => Some(ShareColumn::left_of(n, &grid, upwards, limits, at)?),
        };
        Ok(column_bytes::bytes(own.as_ref()))
    };
    let (kept, all) =
        kept::pieces(&folder, &lock, ("columns", &description), grid.columns, column)?;
    let all = all.iter().map(|bytes| column_bytes::column(bytes));
    let raster = ShareRaster::from_columns(grid, upwards, all.collect::<Result<_, _>>()?)?;
    let mut notes = Vec::new();
    if let Some(edges) = &edges {
        notes.push(speeds_by_column(n, edges)?);
    }
    write_results(&folder, &lock, &raster, &draw_shares(n, &raster)?, notes)?;
    kept.remove(grid.columns)?;
    folder.remove_leftovers();
    drop(lock);
    say(folder.path().join(PICTURE_FILE).display())?;
    Ok(())
}

/// Writes the picture, the array of every label, and the legend, which ends with the `notes`.
pub(super) fn write_results(
    folder: &Folder,
    lock: &Lock,
    raster: &ShareRaster,
    picture: &Svg,
    notes: Vec<serde_json::Value>,
) -> Result<(), Error> {
    let rendered = render("shares", picture, 2.0)?;
    lock.confirm()?;
    folder.write(PICTURE_FILE, &rendered.png)?;
    let mut legend = Vec::new();
    for (at, (label, mean)) in raster.means().into_iter().enumerate() {
        let (file, name) = (format!("share_{}.npy", label.code()), HopperFate::label_name(label));
        let label = label.code();
        folder.write(&file, &share_array(raster, at))?;
        say(format_args!("label {label:5}  {name:40} {:9.5} %  {file}", 100.0 * mean))?;
        legend.push(
            serde_json::json!({ "label": label, "name": name, "mean_share": mean, "file": file }),
        );
    }
    legend.extend(notes);
    let text = serde_json::to_string_pretty(&legend)
        .map_err(|e| Error::Render { what: LEGEND.into(), reason: e.to_string() })?;
    lock.confirm()?;
    folder.write(LEGEND, text.as_bytes())?;
    Ok(())
}

/// The preimage of α*_n near a speed at a mass ratio, followed to the middle of every column; `None` where it does not exist.
fn followed(
    n: u64,
    [mass_ratio, speed]: [f64; 2],
    grid: &Grid,
) -> Result<Vec<Option<FollowedEdge>>, Error> {
    let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
    let chart = EdgeChart::onto(&fates, n, speed)?;
    if chart.hops() == 0 {
        return Err(Error::CheckFailed(format!(
            "--preimage {mass_ratio} {speed}: the speed is near α*_{n} itself; leave the option out, or give a speed near a \
             preimage after at least one hop"
        )));
    }
    let start = FollowedEdge::new(&chart)?;
    // From the columns next to the start outwards in both directions, each from its neighbour.
    let mut edges = vec![None; grid.columns];
    let right_from = (0..grid.columns).position(|at| grid.x_at(at) >= start.mass_ratio);
    let right_from = right_from.unwrap_or(grid.columns);
    let mut follow = |columns: &mut dyn Iterator<Item = usize>| -> Result<(), Error> {
        let mut here = start;
        for at in columns {
            let Some(next) = here.at(MassRatio::new(grid.x_at(at))?)? else { break };
            edges[at] = Some(next);
            here = next;
        }
        Ok(())
    };
    follow(&mut (right_from..grid.columns))?;
    follow(&mut (0..right_from).rev())?;
    if edges.iter().all(Option::is_none) {
        return Err(Error::CheckFailed(format!(
            "the preimage near the speed {speed} at M = {mass_ratio} exists at no mass ratio of the raster, {} to {}; give \
             mass ratios nearer to {mass_ratio} in --mass-ratio",
            grid.x.left, grid.x.right
        )));
    }
    Ok(edges)
}

/// The speeds of the preimage for the legend; a line says where it was followed.
fn speeds_by_column(n: u64, edges: &[Option<FollowedEdge>]) -> Result<serde_json::Value, Error> {
    let known: Vec<&FollowedEdge> = edges.iter().flatten().collect();
    if let (Some(first), Some(last)) = (known.first(), known.last()) {
        let (count, columns, hops) = (known.len(), edges.len(), first.hops);
        say(format_args!(
            "a preimage of α*_{n}, {hops} hops before it, in {count} of {columns} columns: M {:.9} to {:.9}",
            first.mass_ratio, last.mass_ratio
        ))?;
    }
    let speeds: Vec<Option<f64>> = edges.iter().map(|edge| edge.map(|edge| edge.point)).collect();
    Ok(serde_json::json!({ "speed_of_the_preimage_by_column": speeds }))
}

fn grid(options: &Shares) -> Result<(Grid, Upwards), Error> {
    let [columns, rows] = options.pixels[..] else {
        return Err(Error::CheckFailed("--pixels takes columns and rows".into()));
    };
    if columns == 0 || rows == 0 || columns.saturating_mul(rows) > MOST_PIXELS {
        return Err(Error::CheckFailed(format!(
            "--pixels {columns} {rows}: a raster of shares has at least one column and one row, and at most {MOST_PIXELS} pixels"
        )));
    }
    let [from, to] = options.mass_ratio[..] else {
        return Err(Error::CheckFailed("--mass-ratio takes two numbers".into()));
    };
    for m in [from, to] {
        MassRatio::new(m)?;
    }
    if !(from < to) {
        return Err(Error::CheckFailed(format!(
            "--mass-ratio {from} {to}: give the smaller mass ratio first"
        )));
    }
    let (y, upwards) = match (options.turns, &options.offset) {
        (Some(turns), _) if !(turns > 0.0 && turns <= MOST_TURNS) => {
            return Err(Error::CheckFailed(format!(
                "--turns {turns}: give a positive number of turns, at most {MOST_TURNS}"
            )));
        }
        (Some(turns), _) => (Interval::new(0.0, turns)?, Upwards::Phase),
        (None, offsets) => {
            let default = [FAR.into(), Offset::new(NEAR.0, NEAR.1)?];
            let distances = offsets.as_deref().unwrap_or(&default);
            let sides = options.preimage.map_or(Upwards::Depth, |_| Upwards::BothSides);
            (depths(distances)?, sides)
        }
    };
    // The edge lies between two rows.
    let rows = if upwards == Upwards::BothSides { rows.next_multiple_of(2) } else { rows };
    let grid = Grid { x: Interval::new(from, to)?, y, columns, rows };
    for (name, part) in [("mass ratios", grid.x), ("turns or decades", grid.y)] {
        if !(part.length() > 1e-12 * part.right.abs()) {
            let text = format!("{name} from {} to {} have no pixels", part.left, part.right);
            return Err(Error::CheckFailed(text));
        }
    }
    grid.pixels()?;
    Ok((grid, upwards))
}

/// −log₁₀ of two distances, the larger one first.
fn depths(offsets: &[Offset]) -> Result<Interval, Error> {
    let depth = |offset: &Offset| {
        let size = pxfm::f_log10(offset.mantissa().abs());
        -(size + offset.exponent() as f64)
    };
    match offsets {
        [far, near] if depth(far) < depth(near) => Ok(Interval::new(depth(far), depth(near))?),
        _ => {
            let text = |offset: &Offset| format!("{}e{}", offset.mantissa(), offset.exponent());
            let given: Vec<String> = offsets.iter().map(text).collect();
            Err(Error::CheckFailed(format!(
                "--offset {}: give two distances other than 0, the larger one first, such as 1e-2 1e-300",
                given.join(" ")
            )))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(out: &std::path::Path, offset: Option<[&str; 2]>, turns: Option<f64>) -> Shares {
        Shares {
            out: out.to_path_buf(),
            mass_ratio: vec![0.19, 0.21],
            pixels: vec![2, 5],
            n: 2,
            offset: offset.map(|texts| texts.map(|text| text.parse().unwrap()).to_vec()),
            turns,
            preimage: None,
        }
    }

    #[test]
    fn rasters_without_pixels_are_refused() {
        let nowhere = std::path::Path::new("/nowhere");
        let good = options(nowhere, Some(["-1e-2", "1e-1000"]), None);
        let (found, upwards) = grid(&good).unwrap();
        assert_eq!((upwards, found.y.left, found.y.right), (Upwards::Depth, 2.0, 1000.0));
        for offset in [["1e-3", "1e-3"], ["1e-9", "1e-3"], ["0", "1e-3"], ["1e-3", "0"]] {
            assert!(grid(&options(nowhere, Some(offset), None)).is_err(), "{offset:?}");
        }
        for turns in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(grid(&options(nowhere, None, Some(turns))).is_err(), "{turns}");
        }
        for pixels in [vec![0, 5], vec![5, 0], vec![1 << 20, 1 << 20], vec![usize::MAX, 2]] {
            assert!(grid(&Shares { pixels, ..good.clone() }).is_err());
        }
        for mass_ratio in [vec![0.2, 0.2], vec![0.3, 0.2], vec![-1.0, 0.2], vec![0.1, f64::NAN]] {
            assert!(grid(&Shares { mass_ratio, ..good.clone() }).is_err());
        }
    }

    /// The preimage near 11.9206 at M = 0.12 meets its twin between M = 0.1169 and 0.1175; columns below are blank.
    #[test]
    fn a_preimage_is_followed_as_far_as_it_exists() {
        let nowhere = std::path::Path::new("/nowhere");
        let about = |near, mass_ratio: [f64; 2]| {
            let good = options(nowhere, Some(["1e-2", "1e-300"]), None);
            let mass_ratio = mass_ratio.to_vec();
            let options = Shares { preimage: Some(near), mass_ratio, pixels: vec![20, 5], ..good };
            let (grid, upwards) = grid(&options).unwrap();
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

    /// The arrays of all labels have the sum 1 in every pixel, and the legend names them.
    #[test]
    fn the_files_have_all_shares() {
        let folder = std::env::temp_dir().join(format!("hopper_shares_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        run(&options(&folder, None, Some(1.0))).unwrap();
        let legend = std::fs::read_to_string(folder.join(LEGEND)).unwrap();
        let legend: serde_json::Value = serde_json::from_str(&legend).unwrap();
        let mut sums = [0_u32; 10];
        for entry in legend.as_array().unwrap() {
            let bytes = std::fs::read(folder.join(entry["file"].as_str().unwrap())).unwrap();
            assert_eq!(bytes.len(), 128 + 2 * 10);
            for (sum, pair) in sums.iter_mut().zip(bytes[128..].chunks(2)) {
                *sum += u32::from(u16::from_le_bytes([pair[0], pair[1]]));
            }
        }
        assert_eq!(legend.as_array().unwrap().len(), 2);
        assert!(sums.iter().all(|sum| sum.abs_diff(65535) <= 1), "{sums:?}");
        assert!(folder.join(PICTURE_FILE).exists());
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
