//! Basins of three systems as pictures: Newton's method for z³ = 1, Hénon's map, and fractions along a parameter.
//!
//! `cargo run --release -p basin-of-attraction --features figures --example basins_in_pictures -- FOLDER` writes them into a folder that is there.

use basin_of_attraction::{
    AlongSearch, Attractors, AxisNames, CurveLimits, Grid, Hyperrectangle, Interval,
    RecurrenceLimits, SplitMix64, StateGrid, StateMap, ValueImage, array_map, attractors_along,
};
use journal_figures::{DataFile, Svg, render};
use std::error::Error;
use std::path::Path;

/// The attractors from random starts in a square about 0, with 100 cells a side, and the grid of a picture of it.
fn search(
    map: &dyn StateMap,
    half: f64,
    escape: Option<f64>,
) -> Result<(Attractors, Grid), Box<dyn Error>> {
    let side = Interval::new(-half, half)?;
    let square = Hyperrectangle::new(vec![side; 2])?;
    let random = SplitMix64::from_seed(1);
    let starts: Vec<Vec<f64>> = (0..20).map(|k| square.random_point(&random, k)).collect();
    let limits = RecurrenceLimits { escape, ..RecurrenceLimits::default() };
    let found = Attractors::search(map, StateGrid::uniform(square, 100)?, &starts, limits)?;
    Ok((found, Grid { x: side, y: side, columns: 400, rows: 400 }))
}

fn plane(x: f64, y: f64, state: &mut [f64]) {
    state.copy_from_slice(&[x, y]);
}

/// Each file with its name.
fn pictures() -> Result<Vec<DataFile>, Box<dyn Error>> {
    let mut files = Vec::new();
    let mut draw = |name: &str, svg: Svg| -> Result<(), Box<dyn Error>> {
        let rendered = render(name, &svg, 2.0)?;
        files.push(DataFile { name: format!("{name}.svg"), bytes: rendered.svg.into_bytes() });
        files.push(DataFile { name: format!("{name}.png"), bytes: rendered.png });
        Ok(())
    };
    let names = AxisNames { x: "$x$", y: "$y$" };
    let newton = array_map(|[x, y]| {
        let (a, b) = (x * x - y * y, 2.0 * x * y);
        let d = 3.0 * (a * a + b * b);
        (d > 0.0).then(|| [2.0 / 3.0 * x + a / d, 2.0 / 3.0 * y - b / d])
    });
    let (found, grid) = search(&newton, 1.5, None)?;
    let labels = found.raster(&newton, grid, plane)?;
    draw("newton", labels.picture(&found.positions(), (0, 1), names)?)?;
    // How long it takes.
    let state = |k: usize, own: &mut [f64]| {
        plane(grid.x_at(k % grid.columns), grid.y_at(k / grid.columns), own)
    };
    let times = found.convergences(&newton, grid.pixels()?, state)?;
    let values = times.iter().map(|(_, steps)| (*steps as f64).min(20.0)).collect();
    draw("newton_steps", ValueImage { grid, values }.picture("steps, up to 20", names)?)?;
    let henon = array_map(|[x, y]| Some([1.0 - 1.4 * x * x + y, 0.3 * x]));
    let (found, grid) = search(&henon, 2.0, Some(100.0))?;
    let labels = found.raster(&henon, grid, plane)?;
    draw("henon", labels.picture(&found.positions(), (0, 1), names)?)?;
    // x ← x + (c + x − x³)/10 has one or two attractors.
    let wells = |c: f64| array_map(move |[x]: [f64; 1]| Some([x + 0.1 * (c + x - x * x * x)]));
    let line = Hyperrectangle::try_from(Interval::new(-2.0, 2.0)?)?;
    let along = AlongSearch {
        points: 4000,
        ..AlongSearch::new(StateGrid::uniform(line.clone(), 200)?, line)
    };
    let limits = CurveLimits { shortest: 1e-3, ..CurveLimits::default() };
    let along = attractors_along(Interval::new(-0.6, 0.6)?, &[], limits, None, &along, wells)?;
    draw("wells", along.fractions.picture(AxisNames { x: "$c$", y: "fraction" })?)?;
    files.extend(along.fractions.files("wells", "tilt of the wells", "95 % interval")?);
    files.extend(found.files("henon_attractor")?);
    files.extend(labels.files("henon_basins")?);
    Ok(files)
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("give a folder for the pictures")?;
    for DataFile { name, bytes } in pictures()? {
        std::fs::write(Path::new(&folder).join(name), bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_files_are_made() {
        let files = pictures().unwrap();
        let size = |name: &str| files.iter().find(|file| file.name == name).unwrap().bytes.len();
        assert_eq!(files.len(), 14);
        assert!(size("newton.png") > 10_000 && size("henon.png") > 10_000);
        assert_eq!(size("henon_basins.npy"), 128 + 2 * 400 * 400);
        let table = files.iter().find(|file| file.name == "henon_basins-meaning.csv").unwrap();
        let table = String::from_utf8(table.bytes.clone()).unwrap();
        assert!(table.contains("65529,escaped") && table.contains("1,basin 1"), "{table}");
    }
}
