//! Basins that are known exactly: known answers from the literature, and from the test suites of other projects
//! (Attractors.jl).

use super::cantor::{THIRD, cantor_label, interval};
use basin_of_attraction::{
    BoxCount, Branch, Error, Fate, Fractions, Grid, IntervalBasins, Label, LabelImage,
    PreimageTree, Refinement, ResidualSet, TrapSet, classify, entropy, equally_spaced_fractions,
    geometric_limit, interval_basins, occupied_boxes, power_law, raster, uncertain_fraction,
};
use std::ops::ControlFlow::Continue;

/// The gap (1/3, 2/3) and its preimages.
fn cantor_levels(depth: usize) -> IntervalBasins {
    let map = |x: f64| {
        let outside = x <= THIRD || x >= 2.0 * THIRD;
        outside.then_some(if x < 0.5 { 3.0 * x } else { 3.0 * x - 2.0 })
    };
    let branches = [
        Branch { domain: interval(0.0, THIRD), at_left: 0.0, at_right: 1.0 },
        Branch { domain: interval(2.0 * THIRD, 1.0), at_left: 0.0, at_right: 1.0 },
    ];
    let gap = (interval(THIRD, 2.0 * THIRD), Label::from(0));
    let refinement =
        Refinement { shortest: 0.0, undecided: 0.0, levels: depth, intervals: 1 << 20 };
    interval_basins(&map, &[gap], &branches, interval(0.0, 1.0), refinement).unwrap()
}

/// Length of all levels k ≡ label (mod colours), extrapolated: each level has 2/3 of the length of the level before.
fn extrapolated(levels: &IntervalBasins, colours: usize, label: usize) -> f64 {
    let lengths: Vec<f64> =
        levels.levels(Label::from(0)).values().map(|(_, length)| *length).collect();
    // Twelve levels: the rounding errors of further ones exceed their length.
    let own: Vec<f64> = lengths.into_iter().take(12).skip(label).step_by(colours).collect();
    let (value, error) = geometric_limit(&own).unwrap();
    assert!(error < 1e-12, "{error:e}");
    value
}

#[test]
fn fractions_and_boxes_of_a_cantor_basin_of_two_colours_are_exact() {
    let levels = cantor_levels(16);
    assert!((extrapolated(&levels, 2, 0) - 0.6).abs() < 1e-12);
    assert!((extrapolated(&levels, 2, 1) - 0.4).abs() < 1e-12);
    // Boxes of size 3^−n: 2^n are mixed, and each mixed box is a copy of the whole.
    let points: Vec<(f64, f64)> = (1..=10)
        .map(|n| {
            let count = coloured(&levels, 2).boxes(3f64.powi(-n), 1e-4).unwrap();
            assert_eq!(count.mixed, 1 << n, "3^-{n}");
            (count.size, count.mixed as f64)
        })
        .collect();
    let law = power_law(&[points]).unwrap();
    assert!((law.exponent + 2f64.ln() / 3f64.ln()).abs() < 1e-12);
    // The uncertainty exponent is the dimension of the line minus the dimension of the boundary.
    assert!((1.0 + law.exponent - 0.369_070_246_428_543).abs() < 1e-12);
    let fractions = [extrapolated(&levels, 2, 0), extrapolated(&levels, 2, 1)];
    assert!((entropy(fractions) - 0.673_011_667_009_256_5).abs() < 1e-12);
    // From the intervals of 16 levels: (2/3)^13 of a box at the third level is undecided.
    let count = coloured(&levels, 2).boxes(1.0 / 27.0, 1e-4).unwrap();
    let boundary = count.boundary_entropy().unwrap();
    assert!((boundary - 0.673_011_667_009_256_5).abs() < (2.0f64 / 3.0).powi(13), "{boundary}");
}

#[test]
fn the_middle_third_leaves_a_cantor_set() {
    let map = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * x - 2.0 });
    let branches = [
        Branch { domain: interval(0.0, THIRD), at_left: 0.0, at_right: 1.0 },
        Branch { domain: interval(2.0 * THIRD, 1.0), at_left: 0.0, at_right: 1.0 },
    ];
    let gap = interval(THIRD, 2.0 * THIRD);
    let tree = PreimageTree::grow_from_known(&map, &branches, gap, interval(0.0, 1.0), 12).unwrap();
    for (level, (count, length)) in tree.counts().into_iter().zip(tree.lengths()).enumerate() {
        assert_eq!(count, 1 << level);
        assert!((length - (2.0f64 / 3.0).powi(level as i32) / 3.0).abs() < 1e-12);
        let gaps = tree.gaps(level);
        assert_eq!(gaps.intervals().len(), 2 << level);
        assert!((gaps.measure() - (2.0f64 / 3.0).powi(level as i32 + 1)).abs() < 1e-12);
    }
    let ResidualSet::Cantor { growth } = tree.residual_set() else { panic!() };
    assert!((growth - 2f64.ln()).abs() < 1e-12);
    assert_eq!(tree.complete_levels(), 13);
    // The dimension of the ends agrees: 2ⁿ boxes of size 3⁻ⁿ, laid a little off the triadic grid, contain ends.
    let boxes: Vec<(f64, f64)> = (2..=10)
        .map(|n| {
            let size = 3f64.powi(-n);
            (size, occupied_boxes(&tree.ends(), -0.4 * size, size).unwrap() as f64)
        })
        .collect();
    let law = power_law(&[boxes]).unwrap();
    assert!((law.exponent + 0.630_929_753_571_457).abs() < 1e-12, "{law:?}");
}

/// The map x + x² of `a_fixed_point_that_attracts_from_one_side_has_its_basin` has two intervals in every level, so
/// that no Cantor set remains.
#[test]
fn a_fixed_point_that_attracts_from_one_side_leaves_a_countable_set() {
    let map = |x: f64| Some(x + x * x);
    let branches = [
        Branch { domain: interval(-1.0, -0.5), at_left: 0.0, at_right: -0.25 },
        Branch { domain: interval(-0.5, 0.0), at_left: -0.25, at_right: 0.0 },
    ];
    let trap = interval(-0.01, 0.0);
    let tree = PreimageTree::grow(&map, &branches, trap, interval(-1.0, 0.0), 60).unwrap();
    assert_eq!(tree.residual_set(), ResidualSet::Countable { power: 0.0 });
    // Every node is mapped into its parent.
    for node in tree.nodes().iter().skip(1) {
        let parent = tree.nodes()[node.parent.unwrap()];
        assert_eq!(node.level, parent.level + 1);
        let middle = 0.5 * (node.interval.left + node.interval.right);
        assert!(parent.interval.contains(middle + middle * middle));
        assert!(branches[node.branch].domain.contains(middle));
    }
}

/// The intervals as `colours` basins: the label of an interval is its level modulo `colours`.
fn coloured(levels: &IntervalBasins, colours: usize) -> IntervalBasins {
    levels.clone().relabelled(|part| Label::from((part.level.unwrap() % colours) as u8))
}

#[test]
fn fractions_and_boxes_of_a_cantor_basin_of_three_colours_are_exact() {
    let levels = cantor_levels(18);
    let exact = [9.0 / 19.0, 6.0 / 19.0, 4.0 / 19.0];
    let fractions = [0, 1, 2].map(|label| extrapolated(&levels, 3, label));
    for (fraction, exact) in fractions.into_iter().zip(exact) {
        assert!((fraction - exact).abs() < 1e-12, "{fraction} {exact}");
    }
    assert!((entropy(fractions) - 1.045_978_165_699_395).abs() < 1e-12);
    for n in 1..=9 {
        let count = coloured(&levels, 3).boxes(3f64.powi(-n), 1e-4).unwrap();
        assert_eq!(count.mixed, 1 << n, "3^-{n}");
        // An entropy above ln 2 shows that the boundary is fractal.
        assert!(count.boundary_entropy().unwrap() > 2f64.ln());
    }
    // All three basins share one boundary: on the line to the length of three stages, in the image to four pixels.
    let three = coloured(&levels, 3);
    for k in 1..=8 {
        assert_eq!(three.wada(3f64.powi(-k)).unwrap().far_fraction, 0.0, "3^-{k}");
    }
    // At the width of the undecided gaps the intervals of the last stage separate the boundaries.
    let deep = three.wada(1.01 * 3f64.powi(-19)).unwrap();
    assert!(deep.far_fraction > 0.5 && deep.undecided_fraction < 1e-3, "{deep:?}");
    // The witness: a point between two colours of the last stage. Its own colour is near, the other one is not.
    let (at, own, far) = deep.apart.unwrap();
    let off = |label: Label| {
        let parts = three.intervals().iter().filter(|part| part.label == label);
        parts
            .map(|part| (part.interval.left - at).max(at - part.interval.right).max(0.0))
            .fold(f64::INFINITY, f64::min)
    };
    let stage = 3f64.powi(-19);
    assert!(off(own) < 0.6 * stage && off(far) > 0.5 * stage, "{deep:?} {} {}", off(own), off(far));
    assert_eq!(three.wada(1.0 / 3.0).unwrap().apart, None);
    assert!(matches!(coloured(&levels, 2).wada(0.1), Err(Error::TooFewLabels { labels: 2 })));
    assert!(matches!(three.wada(f64::NAN), Err(Error::BadPerturbation { .. })));
    let pixels = 729;
    let window = interval(0.0, 1.0);
    let grid = Grid { x: window, y: window, columns: pixels, rows: 3 };
    let image = raster(grid, |x| cantor_label(x, 3), |&label, _| label, |_| Continue(())).unwrap();
    // At the last level but one a gap of one colour is 3 pixels wide. Within 4 pixels there are all colours.
    assert_eq!(image.wada(4).unwrap().far_boundary_fraction, 0.0);
    assert!(image.wada(1).unwrap().far_boundary_fraction > 0.1);
}

#[test]
fn a_fixed_point_that_attracts_from_one_side_has_its_basin() {
    let map = |x: f64| (x.abs() < 10.0).then_some(x + x * x);
    let traps = TrapSet::new(vec![(interval(-0.5, 0.0), Label::from(1))]).unwrap();
    let label =
        |x: f64| Label::from(classify(&map, &traps, x, 100_000).0 == Fate::Trapped(Label::from(1)));
    let window = interval(-1.5, 0.5);
    // The basin is [−1, 0]. Orbits that start right of 0 leave slowly.
    assert_eq!(label(-1.0 + 1e-12), Label::from(true));
    assert_eq!(label(-1.0 - 1e-12), Label::from(false));
    assert_eq!([label(0.0), label(1e-4)], [true, false].map(Label::from));
    let bounds = equally_spaced_fractions(window, 1000, label).unwrap()[&Label::from(1)].bounds;
    assert!(bounds.covers(0.5) && bounds.half_width() < 2e-3);
    // Pairs of a distance to 0 and the number of steps from −½ until the orbit is closer.
    let mut x = -0.5;
    let mut marks =
        [(1e-2, 94), (1e-3, 992), (1e-4, 9990), (1e-5, 99_987), (1e-6, 999_985)].into_iter();
    let mut mark = marks.next();
    for step in 1..=1_000_000 {
        x += x * x;
        if let Some((distance, steps)) = mark
            && -x < distance
        {
            assert_eq!(step, steps);
            mark = marks.next();
        }
    }
    assert_eq!(mark, None);
}

fn stripes() -> LabelImage {
    let window = interval(0.0, 12.0);
    let grid = Grid { x: window, y: window, columns: 12, rows: 12 };
    raster(grid, |_| (), |(), y| Label::from((y / 4.0) as u8), |_| Continue(())).unwrap()
}

#[test]
fn entropies_and_wada_fractions_of_stripes_are_exact() {
    let image = stripes();
    let boxes = image.boxes(3).unwrap();
    assert!((boxes.basin_entropy() - 0.318_257_084_147_406_4).abs() < 1e-15);
    assert!((boxes.boundary_entropy().unwrap() - 0.636_514_168_294_812_8).abs() < 1e-15);
    let test = image.wada(1).unwrap();
    assert!((test.far_image_fraction - 1.0 / 6.0).abs() < 1e-15, "{test:?}");
    assert_eq!(image.wada(4).unwrap().far_image_fraction, 0.0);
    let counts = image.counts();
    assert_eq!((counts.len(), counts[1].0.to_string().as_str(), counts[1].1), (3, "basin 1", 48));
}

/// The mean entropy of a ball that a smooth boundary cuts at a random distance from its middle.
#[test]
fn entropies_of_smooth_boundaries_are_exact() {
    // The fraction of a unit ball in one, two and three dimensions beyond a cut at distance t from its middle.
    let one = |t: f64| 0.5 * (1.0 - t);
    let two = |t: f64| (t.acos() - t * (1.0 - t * t).sqrt()) / std::f64::consts::PI;
    let three = |t: f64| 0.25 * (1.0 - t) * (1.0 - t) * (2.0 + t);
    let mean = |fraction: &dyn Fn(f64) -> f64| {
        let steps = 200_000;
        let at = |k: u32| -1.0 + 2.0 * (f64::from(k) + 0.5) / f64::from(steps);
        (0..steps).map(|k| entropy([fraction(at(k)), 1.0 - fraction(at(k))])).sum::<f64>()
            / f64::from(steps)
    };
    let known: [(&dyn Fn(f64) -> f64, f64); 3] =
        [(&one, 0.5), (&two, 0.439_509_330_638), (&three, 0.396_091_762_873)];
    for (fraction, exact) in known {
        assert!((mean(fraction) - exact).abs() < 1e-9, "{} {exact}", mean(fraction));
    }
    // The same in one dimension by box counts of intervals: one boundary, at many offsets from the boxes.
    let offsets = 2000;
    let sum: f64 = (0..offsets)
        .map(|k| {
            let cut = 0.25 + 0.1 * (f64::from(k) + 0.5) / f64::from(offsets);
            let traps = [
                (interval(0.0, cut), Label::from(1)),
                (interval(cut.next_up(), 1.0), Label::from(2)),
            ];
            let no_map = |_: f64| None;
            let window = interval(0.0, 1.0);
            let basins =
                interval_basins(&no_map, &traps, &[], window, Refinement::default()).unwrap();
            let count: BoxCount = basins.boxes(0.1, 1e-6).unwrap();
            assert_eq!((count.mixed, count.open), (1, 0));
            count.entropy
        })
        .sum();
    assert!((sum / f64::from(offsets) - 0.5).abs() < 1e-5);
}

/// The map θ → θ + a sin 2θ − b sin 4θ − x sin θ, x → −J cos θ. The label says whether the orbit ends at θ = 0 or
/// at θ = π.
#[test]
fn the_map_of_grebogi_mcdonald_ott_and_yorke_has_its_uncertainty_exponent() {
    const A: f64 = 1.32;
    const B: f64 = 0.9;
    const J: f64 = 0.3;
    let label = |theta: f64| {
        let (mut theta, mut x) = (theta, 0.1);
        for _ in 0..2000 {
            let next = theta + A * (2.0 * theta).sin() - B * (4.0 * theta).sin() - x * theta.sin();
            x = -J * theta.cos();
            theta = next.rem_euclid(std::f64::consts::TAU);
            // Both fixed points attract from a distance much larger than a thousandth.
            if theta.sin().abs() < 1e-3 && (x.abs() - J).abs() < 1e-3 {
                return Label::from(theta.cos() > 0.0);
            }
        }
        Label::UNDECIDED
    };
    let window = interval(0.0, std::f64::consts::TAU);
    let replicate = |seed: u64| -> Vec<(f64, f64)> {
        let fraction = |k: u64| {
            let epsilon = 10f64.powf(-2.0 - 0.5 * k as f64);
            let seed = 100 * seed + k;
            (epsilon, uncertain_fraction(window, epsilon, 3000, seed, label).unwrap().value)
        };
        (0..=10).map(fraction).collect()
    };
    let law = power_law(&(0..8).map(replicate).collect::<Vec<_>>()).unwrap();
    let interval = law.interval.unwrap();
    // The published exponent is 0.2.
    assert!((law.exponent - 0.2).abs() < 0.02, "{law:?}");
    assert!(interval.lower < 0.2 && interval.upper > 0.2, "{interval:?}");
    assert!(interval.half_width() < 0.03, "{interval:?}");
}

#[test]
fn the_basins_of_newtons_method_share_one_boundary() {
    let label = |x: f64, y: f64| {
        let (mut x, mut y) = (x, y);
        for _ in 0..60 {
            // z − (z³ − 1)/(3z²) = (2z + 1/z²)/3.
            let (square_x, square_y) = (x * x - y * y, 2.0 * x * y);
            let size = square_x * square_x + square_y * square_y;
            if size == 0.0 {
                return Label::UNDECIDED;
            }
            (x, y) = ((2.0 * x + square_x / size) / 3.0, (2.0 * y - square_y / size) / 3.0);
            // Newton's method converges to a root from every point within ¼ of it.
            for (k, angle) in (0u8..).zip([0.0, 2.0, 4.0]) {
                let (sin, cos) = (angle * std::f64::consts::PI / 3.0).sin_cos();
                if (x - cos).hypot(y - sin) < 0.25 {
                    return Label::from(k + 1);
                }
            }
        }
        Label::UNDECIDED
    };
    let window = interval(-1.5, 1.5);
    let grid = Grid { x: window, y: window, columns: 1024, rows: 1024 };
    let image = raster(grid, |x| x, |&x, y| label(x, y), |_| Continue(())).unwrap();
    let pixels = (1024 * 1024) as f64;
    for ((found, count), (label, fraction)) in
        image.counts().into_iter().zip([(1, 0.3452), (2, 0.3274), (3, 0.3274)])
    {
        assert_eq!(found, Label::from(label));
        assert!(
            (count as f64 / pixels - fraction).abs() < 5e-4,
            "{label}: {}",
            count as f64 / pixels
        );
    }
    // Boxes of fewer than eight pixels count the steps of the pixels, not the boundary.
    let points: Vec<(f64, f64)> = [8, 12, 16, 24, 32, 48, 64]
        .into_iter()
        .map(|side| image.boxes(side).map(|b| (b.size, b.mixed as f64)).unwrap())
        .collect();
    let law = power_law(&[points]).unwrap();
    assert!((1.35..1.5).contains(&-law.exponent), "{law:?}");
    // The Wada property: all three basins share one boundary, to three pixels.
    assert!(image.wada(3).unwrap().far_boundary_fraction < 0.05);
    let exponents: Vec<(f64, f64)> = [-2, -3, -4]
        .into_iter()
        .map(|k| {
            let epsilon = 10f64.powi(k);
            // On the line y = 0.3 the dimension of the boundary is smaller by one than in the plane.
            let fraction =
                uncertain_fraction(window, epsilon, 100_000, 3, |x| label(x, 0.3)).unwrap();
            (epsilon, fraction.value)
        })
        .collect();
    let exponent = power_law(&[exponents]).unwrap().exponent;
    assert!((0.55..0.65).contains(&exponent), "{exponent}");
}

/// The points within ε of the two ends of [−1, 0] are 2ε of a window of length 2.
#[test]
fn the_uncertain_fraction_of_an_interval_is_exact() {
    let traps = [
        (interval(-1.5, -1.0), Label::from(0)),
        (interval((-1.0f64).next_up(), 0.0), Label::from(1)),
        (interval(f64::MIN_POSITIVE, 0.5), Label::from(0)),
    ];
    let no_map = |_: f64| None;
    let window = interval(-1.5, 0.5);
    let basins = interval_basins(&no_map, &traps, &[], window, Refinement::default()).unwrap();
    for epsilon in [1e-1, 1e-3, 1e-6] {
        let exact = basins.uncertain_fraction(epsilon, 1e-12).unwrap().middle();
        assert!((exact - 2.0 * epsilon).abs() < 1e-12);
        let label = |x: f64| Label::from((-1.0..=0.0).contains(&x));
        let sampled = uncertain_fraction(window, epsilon, 100_000, 5, label).unwrap();
        assert!(sampled.lower < exact && exact < sampled.upper, "{sampled:?}");
    }
}

#[test]
fn boxes_with_an_undecided_part_are_counted() {
    // The label is known on [0, 0.1] and [0.9, 1] only. The sixteen boxes of 0.05 between them are open.
    let traps = [(interval(0.0, 0.1), Label::from(1)), (interval(0.9, 1.0), Label::from(2))];
    let no_map = |_: f64| None;
    let basins =
        interval_basins(&no_map, &traps, &[], interval(0.0, 1.0), Refinement::default()).unwrap();
    let count = basins.boxes(0.05, 1e-6).unwrap();
    assert_eq!((count.boxes, count.mixed, count.open), (20, 0, 16));
    // Each basin has a tenth, and at most the rest that is known of no other.
    let fractions = Fractions::from_intervals(&basins).unwrap();
    let first = fractions.found[&Label::from(1)];
    assert!((first.value - 0.1).abs() < 1e-15 && (first.upper - 0.9).abs() < 1e-12, "{first:?}");
    assert!((fractions.unseen - 0.8).abs() < 1e-12);
    assert_eq!(basins.trap_grounds().len(), 2);
    let nowhere =
        interval_basins(&no_map, &[], &[], interval(0.0, 1.0), Refinement::default()).unwrap();
    assert_eq!(nowhere.boxes(0.05, 1e-6).unwrap().open, 20);
}
