//! Basins of the plane and of the line with known answers: countably many basins, escape sets, and Hénon's map.

use basin_of_attraction::{
    Branch, Grid, Hyperrectangle, Interval, Label, Refinement, entropy, interval_basins,
    interval_basins_from_known, raster, region_fractions,
};
use std::ops::ControlFlow::Continue;

const THIRD: f64 = 1.0 / 3.0;

fn interval(left: f64, right: f64) -> Interval {
    Interval::new(left, right).unwrap()
}

/// The label of a gap of the Cantor set is its stage n = 1, 2, …: there are countably many basins, of length
/// (1/3)(2/3)^(n−1).
#[test]
fn countably_many_basins_have_their_measures_and_their_entropy() {
    let map = |x: f64| {
        let outside = x <= THIRD || x >= 2.0 * THIRD;
        outside.then_some(if x < 0.5 { 3.0 * x } else { 3.0 * x - 2.0 })
    };
    let branches = [
        Branch { domain: interval(0.0, THIRD), at_left: 0.0, at_right: 1.0 },
        Branch { domain: interval(2.0 * THIRD, 1.0), at_left: 0.0, at_right: 1.0 },
    ];
    let gap = (interval(THIRD, 2.0 * THIRD), Label::from(0));
    let refinement = Refinement { shortest: 0.0, undecided: 0.0, levels: 19, intervals: 1 << 21 };
    let stages = interval_basins(&map, &[gap], &branches, interval(0.0, 1.0), refinement)
        .unwrap()
        .relabelled(|part| Label::from(part.level.unwrap() as u8 + 1));
    let part = |n: i32| (2.0f64 / 3.0).powi(n - 1) / 3.0;
    for n in 1..=12 {
        let found = stages.resolved_length(Label::from(n as u8));
        assert!((found - part(n)).abs() < 1e-12, "{n}: {found}");
    }
    // Each mixed box is a copy of the whole. Its twenty stages lack only their tail.
    let whole = entropy((1..400).map(part));
    assert!((whole - 1.909_542_504_884_438_4).abs() < 1e-12, "{whole}");
    for k in 1..=4 {
        let count = stages.boxes(3f64.powi(-k), 1e-12).unwrap();
        assert_eq!(count.mixed, 1 << k);
        let known: Vec<f64> = (1..=20 - k).map(part).collect();
        let sum: f64 = known.iter().sum();
        let exact = entropy(known.iter().map(|p| p / sum));
        let found = count.boundary_entropy().unwrap();
        // The ends of the last stage, of 3⁻²⁰, are right to an ulp, which is 10⁻⁶ of its length.
        assert!((found - exact).abs() < 1e-8, "{k}: {found} {exact}");
        assert!((found - whole).abs() < 0.02);
    }
}

/// The tent map of slope 3 has one basin, the orbits that leave [0, 1]. Its boundary is the Cantor set of the other
/// orbits.
#[test]
fn the_boundary_of_an_escape_set_is_counted_with_the_undecided_rest() {
    let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
    let branches = [
        Branch { domain: interval(0.0, 0.5), at_left: 0.0, at_right: 1.5 },
        Branch { domain: interval(0.5, 1.0), at_left: 1.5, at_right: 0.0 },
    ];
    let escape = (interval(THIRD.next_up(), (2.0 * THIRD).next_down()), Label::from(0));
    let refinement = Refinement { shortest: 0.0, undecided: 0.0, levels: 14, intervals: 1 << 20 };
    let window = interval(0.0, 1.0);
    let found =
        interval_basins_from_known(&tent, &[escape], &branches, window, refinement).unwrap();
    for k in 1..=9 {
        let count = found.boxes(3f64.powi(-k), 1e-9).unwrap();
        assert_eq!((count.mixed, count.with_rest()), (0, 1 << k), "{k}");
        assert_eq!(count.boundary_entropy(), None);
    }
}

/// Whether the orbit of Hénon's map x → 1 − 1.4 x² + y, y → 0.3 x stays bounded.
struct Henon;

impl Henon {
    fn label(x: f64, y: f64) -> Label {
        // Beyond this radius the square outweighs the rest, and orbits escape. A bounded orbit comes to the
        // attractor in far fewer steps.
        let (mut x, mut y) = (x, y);
        for _ in 0..500 {
            (x, y) = (1.0 - 1.4 * x * x + y, 0.3 * x);
            if x.abs() > 100.0 {
                return Label::from(0);
            }
        }
        Label::from(1)
    }
}

#[test]
fn henons_map_has_its_bounded_area_and_its_entropies() {
    let side = interval(-2.0, 2.0);
    let square = Hyperrectangle::new(vec![side; 2]).unwrap();
    let sampled = region_fractions(&square, 400_000, 1, |x| Henon::label(x[0], x[1])).unwrap();
    let area = sampled.fraction(Label::from(1)).unwrap();
    assert!(area.covers(0.432_495) && area.half_width() < 0.0016, "{area:?}");
    let fine = Grid { x: side, y: side, columns: 1000, rows: 1000 };
    let image = raster(fine, |x| x, |&x, y| Henon::label(x, y), |_| Continue(())).unwrap();
    let bounds = image.fractions_between_pixels().unwrap()[&Label::from(1)];
    assert!(bounds.covers(0.432_495) && bounds.half_width() < 0.02, "{bounds:?}");
    let with_ends = Grid::with_ends(side, side, 300, 300).unwrap();
    let image = raster(with_ends, |x| x, |&x, y| Henon::label(x, y), |_| Continue(())).unwrap();
    for (size, basin, boundary) in [
        (5, 0.036_037, 0.484_08),
        (6, 0.042_944, 0.462_75),
        (10, 0.071_451, 0.437_46),
        (20, 0.134_996, 0.446_68),
        (30, 0.188_548, 0.418_99),
    ] {
        let count = image.boxes(size).unwrap();
        let found = (count.basin_entropy(), count.boundary_entropy().unwrap());
        assert!((found.0 - basin).abs() < 2e-5, "{size}: {found:?}");
        assert!((found.1 - boundary).abs() < 2e-5, "{size}: {found:?}");
    }
}
