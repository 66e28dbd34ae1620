//! A boundary point followed over the mass ratio is the boundary point that a search finds there, and windows of
//! the (M, α) plane about it have the fates of their points.

use basin_of_attraction::{Grid, Interval, Label};
use hopper_basin::{
    CircleLimits, EdgeChart, Error, Fates, FollowedEdge, HopperFate, PhaseBasins, ShareColumn,
    ShareRaster, Upwards, basin_raster, edge_frame, frame_slant,
};
use passive_hopper::MassRatio;
use std::ops::ControlFlow::Continue;

fn fates(mass_ratio: f64) -> Fates {
    Fates::new(MassRatio::new(mass_ratio).unwrap()).unwrap()
}

fn edge(mass_ratio: f64, n: u64, guess: f64) -> (Fates, EdgeChart, FollowedEdge) {
    let fates = fates(mass_ratio);
    let chart = EdgeChart::onto(&fates, n, guess).unwrap();
    let edge = FollowedEdge::new(&chart).unwrap();
    (fates, chart, edge)
}

fn at(edge: &FollowedEdge, mass_ratio: f64) -> Option<FollowedEdge> {
    edge.at(MassRatio::new(mass_ratio).unwrap()).unwrap()
}

const EDGES: [(f64, u64, f64); 2] = [(0.12, 2, 11.9206), (0.2, 1, 8.47304)];

#[test]
fn a_followed_point_is_the_one_that_a_search_finds() {
    for (m, n, guess) in EDGES {
        let (_, _, start) = edge(m, n, guess);
        for k in -4..=4 {
            let other = m * (1.0 + 0.005 * f64::from(k));
            let found = at(&start, other).unwrap();
            assert_eq!((found.mass_ratio, found.n, found.hops), (other, n, start.hops));
            let chart = EdgeChart::near(&fates(other), found.point).unwrap();
            assert!((chart.point().0 - found.point).abs() < 1e-12, "{m} {other}");
            // Back along the branch.
            let back = at(&found, m).unwrap();
            assert!((back.point - start.point).abs() < 1e-12, "{m} {other}");
        }
    }
}

#[test]
fn the_derivative_is_that_of_difference_quotients() {
    for (m, n, guess) in EDGES {
        let (_, _, start) = edge(m, n, guess);
        let step = 1e-5 * m;
        let [right, left] = [m + step, m - step].map(|m| at(&start, m).unwrap());
        let quotient = (right.point - left.point) / (right.mass_ratio - left.mass_ratio);
        // The difference errs by step² p‴/6 and by the rounding of the points over the step.
        let off = (quotient / start.by_mass_ratio - 1.0).abs();
        assert!(off < 1e-6, "{m}: {quotient} {}", start.by_mass_ratio);
    }
}

/// 2 × 2 sampled fates in each pixel against the shares of the oblique strips, in a window that both can draw.
#[test]
fn frames_of_the_chart_have_the_fates_of_their_points() {
    const PIXELS: usize = 24;
    for (m, n, guess) in EDGES {
        let (fates, chart, edge) = edge(m, n, guess);
        let circle = PhaseBasins::new(&fates, n, CircleLimits::default()).unwrap();
        let (depth, half) = (6.0, 1e-6);
        let frame = edge_frame(&fates, (&chart, &edge), &circle, depth, (PIXELS, PIXELS)).unwrap();
        // 8 × 8 fates a pixel.
        let about = |middle: f64, half: f64| Interval::new(middle - half, middle + half).unwrap();
        let grid = Grid {
            x: about(m, half * frame_slant(&edge)),
            y: about(chart.point().0, half),
            columns: 8 * PIXELS,
            rows: 8 * PIXELS,
        };
        let fine = basin_raster(grid, |_| Continue(())).unwrap();
        let (mut mean, mut pixels) = (0.0, 0.0);
        for column in 0..PIXELS {
            for row in 0..PIXELS {
                for (place, &label) in frame.labels().iter().enumerate() {
                    let inside = (0..64).map(|k| (8 * column + k % 8, 8 * row + k / 8));
                    let seen = inside.filter(|&(x, y)| fine.at(x, y) == Some(label)).count();
                    let share = frame.at(column, row).unwrap()[place];
                    mean += (seen as f64 / 64.0 - f64::from(share)).abs();
                    pixels += 1.0;
                }
            }
        }
        // An edge inside a pixel is seen in steps of 1/8 there, and in steps of 1/16 here.
        assert!(mean / pixels < 0.01, "{m}: {}", mean / pixels);
        assert!(frame.labels().contains(&HopperFate::label_of_fixed_point(n)), "{m}");
    }
}

#[test]
fn deep_frames_are_alike_at_any_depth() {
    let (fates, chart, edge) = edge(0.12, 2, 11.9206);
    let circle = PhaseBasins::new(&fates, 2, CircleLimits::default()).unwrap();
    let frame = |depth| edge_frame(&fates, (&chart, &edge), &circle, depth, (20, 16)).unwrap();
    let deep = frame(100.0);
    for depth in [30.5, 300.0, 1000.0] {
        let other = frame(depth);
        for (column, row) in (0..20).flat_map(|column| (0..16).map(move |row| (column, row))) {
            let pairs = deep.at(column, row).unwrap().iter().zip(other.at(column, row).unwrap());
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-5), "{depth} {column} {row}");
        }
    }
    assert!(frame(0.0).labels().len() >= 3);
    for (depth, pixels) in [(-1.0, (4, 4)), (f64::NAN, (4, 4)), (3.0, (0, 4)), (3.0, (4, 1 << 20))]
    {
        let error = edge_frame(&fates, (&chart, &edge), &circle, depth, pixels).unwrap_err();
        assert!(matches!(error, Error::EdgeFrame { .. }), "{depth} {pixels:?}");
    }
}

/// Both sides of a preimage: the side that falls has the local fractions, the other one belongs to the basin;
/// columns without it are blank.
#[test]
fn columns_about_a_preimage_have_both_sides() {
    let (_, _, start) = edge(0.12, 2, 11.9206);
    let interval = |a, b| Interval::new(a, b).unwrap();
    let grid = Grid { x: interval(0.119, 0.121), y: interval(2.0, 300.0), columns: 2, rows: 40 };
    let edges = [at(&start, grid.x_at(0)), None];
    let limits = CircleLimits::default();
    let columns: Vec<_> =
        (0..2).map(|column| ShareColumn::about(&edges, &grid, limits, column).unwrap()).collect();
    let raster = ShareRaster::from_columns(grid, Upwards::BothSides, columns).unwrap();
    assert!(!raster.is_blank(0) && raster.is_blank(1) && raster.is_blank(2));
    let circle = PhaseBasins::new(&fates(grid.x_at(0)), 2, limits).unwrap();
    let share = |row: usize, label: u8| {
        let place = raster.labels().iter().position(|own| *own == Label::from(label)).unwrap();
        f64::from(raster.at(0, row).unwrap()[place])
    };
    // The rows from some 10⁻¹⁰⁰ on, below and above.
    for row in 7..20 {
        let local = circle.fractions().of(Label::from(1)).middle();
        assert!((share(row, 1) - local).abs() < 1e-4, "{row}: {} {local}", share(row, 1));
    }
    assert!((20..38).all(|row| share(row, 2) > 0.999_999));
    assert!(ShareRaster::from_columns(grid, Upwards::BothSides, vec![None]).is_err());
    let odd = Grid { rows: 5, ..grid };
    assert!(ShareColumn::about(&edges, &odd, limits, 0).is_err());
}
