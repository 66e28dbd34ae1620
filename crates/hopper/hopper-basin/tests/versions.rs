//! The bits of rasters belong to a version. A change of the bits without a new version would let a continued raster
//! mix both.
//!
//! After a change that is meant: raise the version, and enter the digests that this test reports.

use basin_of_attraction::{Grid, Interval};
use hopper_asymptotics::Offset;
use hopper_basin::{
    CircleLimits, RASTER_VERSION, SHARE_VERSION, ShareColumn, Upwards, basin_columns, hop_columns,
};
use resumable_job::digest;

fn grid(x: (f64, f64), y: (f64, f64), columns: usize, rows: usize) -> Grid {
    let interval = |(left, right)| Interval::new(left, right).unwrap();
    Grid { x: interval(x), y: interval(y), columns, rows }
}

fn labels(grid: Grid) -> String {
    let columns = basin_columns(&grid, 0..grid.columns).unwrap();
    let bytes = columns.iter().flatten().flat_map(|label| label.code().to_le_bytes());
    digest(&bytes.collect::<Vec<_>>())
}

fn hops(grid: Grid) -> String {
    let columns = hop_columns(&grid, 0..grid.columns).unwrap();
    digest(&columns.iter().flatten().flat_map(|hops| hops.to_le_bytes()).collect::<Vec<_>>())
}

fn shares(n: u64, grid: Grid, upwards: Upwards) -> String {
    let mut bytes = Vec::new();
    for at in 0..grid.columns {
        let column = ShareColumn::left_of(n, &grid, upwards, CircleLimits::default(), at).unwrap();
        bytes.extend(column.labels.iter().flat_map(|label| label.code().to_le_bytes()));
        bytes.extend(column.shares.iter().flat_map(|share| share.to_le_bytes()));
    }
    digest(&bytes)
}

#[test]
fn the_bits_of_rasters_are_those_of_their_version() {
    let found = [
        // Figs. 6 and 7; a narrow and low window, whose columns share circles; large speeds.
        labels(grid((0.02, 1.0), (4.5, 20.0), 64, 200)),
        labels(grid((1.0, 10.0), (4.5, 20.0), 48, 100)),
        labels(grid((0.1999, 0.2001), (7.715, 7.7254), 32, 150)),
        labels(grid((0.05, 0.3), (100.0, 130.0), 16, 100)),
        hops(grid((0.02, 1.0), (4.5, 20.0), 24, 60)),
        hops(grid((1.0, 10.0), (4.5, 20.0), 12, 30)),
    ];
    let known: (u32, [&str; 6]) = (
        1,
        [
            "1fa760dfb5d849e0",
            "32e80b3405966d8e",
            "a99ad3ace1892825",
            "ff38068725b5e772",
            "d47f79bf99e9e80d",
            "68e193f4c486ca0b",
        ],
    );
    assert_eq!((RASTER_VERSION, found.each_ref().map(String::as_str)), known);
}

#[test]
fn the_bits_of_shares_are_those_of_their_version() {
    let depths = |far: &str, near: &str| {
        let depth = |text: &str| -(text.parse::<Offset>().unwrap().exponent() as f64);
        (depth(far), depth(near))
    };
    let found = [
        shares(2, grid((0.19, 0.21), depths("1e-2", "1e-300"), 3, 40), Upwards::Depth),
        shares(1, grid((0.1, 0.12), (0.0, 2.0), 3, 50), Upwards::Phase),
    ];
    let known: (u32, [&str; 2]) = (1, ["9c186f9923427138", "2acfcbf1115c3a2d"]);
    assert_eq!((SHARE_VERSION, found.each_ref().map(String::as_str)), known);
}
