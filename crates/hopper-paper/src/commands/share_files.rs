//! `basin-raster --about N`: the shares of the basins left of α*_N, over mass ratio and distance, or over mass ratio and phase.

use crate::error::Error;
use crate::figures::share_plot::draw_shares;
use basin_of_attraction::{Grid, Interval};
use hopper_asymptotics::Offset;
use hopper_basin::{CircleLimits, HopperFate, ShareRaster, Upwards, share_raster};
use journal_figures::render;
use passive_hopper::MassRatio;
use repository_tools::{Folder, Progress, say};
use resumable_job::{Lock, Order, npy_header};
use std::ops::ControlFlow;
use std::path::PathBuf;

/// The names of the results; every label has its own array.
const PICTURE_FILE: &str = "shares.png";
const LEGEND: &str = "shares.json";

/// The largest number of pixels: with five fates, the shares of so many take 340 MB.
const MOST_PIXELS: usize = 1 << 24;

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
}

/// Runs the command for the circle of α*_n.
pub(super) fn run(options: &Shares) -> Result<(), Error> {
    let n = options.n;
    let (grid, upwards) = grid(options)?;
    let folder = Folder::open(&options.out)?;
    let lock = Lock::take(folder.path(), "basin-raster")?;
    let bar = Progress.bar("shares", grid.columns as u64);
    let raster = share_raster(n, grid, upwards, CircleLimits::default(), |done| {
        bar.set(done as u64);
        ControlFlow::Continue(())
    })?;
    bar.finish();
    let rendered = render("shares", &draw_shares(n, &raster)?, 2.0)?;
    lock.confirm()?;
    folder.write(PICTURE_FILE, &rendered.png)?;
    let mut legend = Vec::new();
    for (at, (label, mean)) in raster.means().into_iter().enumerate() {
        let (file, name) = (format!("share_{}.npy", label.code()), HopperFate::label_name(label));
        let label = label.code();
        folder.write(&file, &npy(&raster, at))?;
        say(format_args!("label {label:5}  {name:40} {:9.5} %  {file}", 100.0 * mean))?;
        legend.push(
            serde_json::json!({ "label": label, "name": name, "mean_share": mean, "file": file }),
        );
    }
    let text = serde_json::to_string_pretty(&legend)
        .map_err(|e| Error::Render { what: LEGEND.into(), reason: e.to_string() })?;
    folder.write(LEGEND, text.as_bytes())?;
    drop(lock);
    say(folder.path().join(PICTURE_FILE).display())?;
    Ok(())
}

fn grid(options: &Shares) -> Result<(Grid, Upwards), Error> {
    let [columns, rows] = options.pixels[..] else {
        return Err(Error::CheckFailed("--pixels takes columns and rows".into()));
    };
    if columns.saturating_mul(rows) > MOST_PIXELS {
        return Err(basin_of_attraction::Error::BadRaster { columns, rows }.into());
    }
    let [from, to] = options.mass_ratio[..] else {
        return Err(Error::CheckFailed("--mass-ratio takes two numbers".into()));
    };
    for m in [from, to] {
        MassRatio::new(m)?;
    }
    let (y, upwards) = match (options.turns, &options.offset) {
        (Some(turns), _) => (Interval::new(0.0, turns)?, Upwards::Phase),
        (None, Some(offsets)) => (depths(offsets)?, Upwards::Depth),
        (None, None) => (depths(&[FAR.into(), Offset::new(NEAR.0, NEAR.1)?])?, Upwards::Depth),
    };
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
        _ => Err(Error::CheckFailed(
            "--offset takes two distances from the fixed point, the larger one first".into(),
        )),
    }
}

/// The shares of one label as 16-bit integers, 65535 for 1; rows start from the lowest.
fn npy(raster: &ShareRaster, at: usize) -> Vec<u8> {
    let grid = raster.grid();
    let mut bytes = npy_header(Order::C, grid.rows, grid.columns);
    for row in 0..grid.rows {
        for column in 0..grid.columns {
            let share = raster.at(column, row).and_then(|all| all.get(at)).copied().unwrap_or(0.0);
            bytes.extend(((65535.0 * share).round() as u16).to_le_bytes());
        }
    }
    bytes
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
