//! Attractors found by the features of orbits: known ones are found with their fractions, and all other orbits are
//! reported.

use super::runge_kutta::after;
use basin_of_attraction::{
    Error, FeatureAttractors, FeatureGroups, FeatureLimits, Hyperrectangle, Interval, Label,
    Metric, SplitMix64, UnmatchedReason, region_fractions, suggested_radius, suggested_radius_by,
};

fn cube(dimension: usize, half: f64) -> Hyperrectangle {
    Hyperrectangle::new(vec![Interval::new(-half, half).unwrap(); dimension]).unwrap()
}

fn starts(region: &Hyperrectangle, count: u64) -> Vec<Vec<f64>> {
    let random = SplitMix64::from_seed(11);
    (0..count).map(|k| region.random_point(&random, k)).collect()
}

/// The mean of each coordinate.
fn means(points: &[Vec<f64>]) -> Vec<f64> {
    let count = points.len() as f64;
    (0..points[0].len()).map(|k| points.iter().map(|x| x[k]).sum::<f64>() / count).collect()
}

/// The root of the mean square of the distance from the mean, of each coordinate.
fn deviations(points: &[Vec<f64>]) -> Vec<f64> {
    let (mean, count) = (means(points), points.len() as f64);
    let of = |k: usize| points.iter().map(|x| (x[k] - mean[k]).powi(2)).sum::<f64>() / count;
    (0..mean.len()).map(|k| of(k).sqrt()).collect()
}

/// A fixed point, a cycle and a chaotic attractor, whose basins reach close to one another. (Attractors.jl has the
/// fractions 0.645, 0.18 and 0.175 for the cube.)
#[test]
fn lorenz_84_has_its_three_attractors() {
    let (f, g, a, b) = (6.886, 1.347, 0.255, 4.0);
    let field = move |[x, y, z]: [f64; 3]| {
        [-y * y - z * z - a * x + a * f, x * y - y - b * x * z + g, b * x * y + x * z - z]
    };
    let step = move |z: &[f64]| after(field, z, 0.02, 5);
    let feature = |points: &[Vec<f64>]| [means(points), deviations(points)].concat();
    let limits =
        FeatureLimits { transient: 2000, stretch: 2000, ..FeatureLimits::new(0.06, 0.001) };
    let window = cube(3, 3.0);
    let found = FeatureAttractors::search(&step, &feature, &starts(&window, 60), limits).unwrap();
    assert_eq!((found.attractors().len(), found.unmatched().len()), (3, 0));
    assert!(found.groups().separation().is_some_and(|gap| gap > 3.0 * limits.radius));
    let label = |x: &[f64]| found.label(&step, &feature, x);
    let counts = region_fractions(&window, 1500, 3, label).unwrap();
    let mut shares: Vec<f64> =
        counts.basins().map(|label| counts.fraction(label).unwrap().value).collect();
    shares.sort_by(|a, b| b.total_cmp(a));
    assert!(counts.undecided() < 15, "{}", counts.undecided());
    for (share, published) in shares.iter().zip([0.645, 0.18, 0.175]) {
        // Three standard deviations.
        assert!((share - published).abs() < 0.037, "{shares:?}");
    }
    // Orbits that start farther beside the second and third attractor come to others: at that scale they are no traps.
    let far = FeatureLimits { beside: 0.1, ..limits };
    let found = FeatureAttractors::search(&step, &feature, &starts(&window, 60), far).unwrap();
    assert_eq!(found.attractors().len(), 1);
    assert!(found.unmatched().iter().all(|orbit| orbit.reason == UnmatchedReason::NoTrap));
    assert!(found.unmatched().len() > 10);
}

/// The three magnets are known, and so is the mean position of a pendulum that hangs at one.
#[test]
fn the_magnetic_pendulum_by_templates() {
    let magnets: [[f64; 2]; 3] = std::array::from_fn(|k| {
        let angle = std::f64::consts::TAU * k as f64 / 3.0;
        [angle.cos(), angle.sin()]
    });
    let field = move |[x, y, u, v]: [f64; 4]| {
        let (mut ax, mut ay) = (-0.64 * x - 0.2 * u, -0.64 * y - 0.2 * v);
        for [mx, my] in magnets {
            let (dx, dy) = (x - mx, y - my);
            let square = dx * dx + dy * dy + 0.04;
            let cube = square * square.sqrt();
            ax -= dx / cube;
            ay -= dy / cube;
        }
        [u, v, ax, ay]
    };
    let step = move |z: &[f64]| after(field, z, 0.02, 10);
    let position = |points: &[Vec<f64>]| means(points)[..2].to_vec();
    let templates: Vec<(Label, Vec<f64>)> =
        (1..).map(Label::from).zip(magnets.map(|magnet| magnet.to_vec())).collect();
    let groups = FeatureGroups::from_templates(&templates, 0.2).unwrap();
    let limits =
        FeatureLimits { transient: 100, stretch: 50, agree: 5, ..FeatureLimits::new(0.2, 0.01) };
    let found = FeatureAttractors::from_groups(groups, limits).unwrap();
    let label = |x: &[f64]| found.label(&step, &position, &[x[0], x[1], 0.0, 0.0]);
    let counts = region_fractions(&cube(2, 2.0), 600, 3, label).unwrap();
    for known in 1..=3 {
        // Three standard deviations.
        let share = counts.fraction(Label::from(known)).unwrap().value;
        assert!((share - 1.0 / 3.0).abs() < 0.06, "{share}");
    }
    assert_eq!(counts.undecided(), 0);
    // Without the third template its orbits are undecided, although another one is the nearest.
    let groups = FeatureGroups::from_templates(&templates[..2], 0.2).unwrap();
    let two = FeatureAttractors::from_groups(groups, limits).unwrap();
    for start in starts(&cube(2, 2.0), 50) {
        let start = [start[0], start[1], 0.0, 0.0];
        let (label, of_two) =
            (found.label(&step, &position, &start), two.label(&step, &position, &start));
        let expected = if label == templates[2].0 { Label::UNDECIDED } else { label };
        assert_eq!(of_two, expected);
    }
}

/// The fixed point 0 of x + x² attracts [−1, 0] and no point on its right: it is no trap, and its orbits belong to
/// no basin.
#[test]
fn a_slow_passage_is_no_attractor() {
    let map = |x: &[f64]| Some(vec![x[0] + x[0] * x[0]]).filter(|x| x[0] < 10.0);
    let points: Vec<Vec<f64>> = (0..60).map(|k| vec![-1.0 + 0.02 * f64::from(k) + 1e-3]).collect();
    let limits = FeatureLimits { stretch: 100, ..FeatureLimits::new(0.01, 0.05) };
    let found = FeatureAttractors::search(&map, &means, &points, limits).unwrap();
    assert!(found.attractors().is_empty() && found.unmatched().len() == points.len());
    for orbit in found.unmatched() {
        let expected =
            if orbit.start[0] < 0.0 { UnmatchedReason::NoTrap } else { UnmatchedReason::Stopped };
        assert_eq!(orbit.reason, expected, "{orbit:?}");
        assert!(found.label(&map, &means, &orbit.start).is_undecided());
    }
}

/// An attractor of fewer starts than a group needs is reported.
#[test]
fn orbits_like_few_others_are_reported() {
    // x → 3x/2 − x³/2 on each coordinate has four attractors; two starts come to the fourth.
    let step = |x: &[f64]| Some(x.iter().map(|x| 1.5 * x - 0.5 * x * x * x).collect());
    let quadrant = |k: u32, sign: (f64, f64)| {
        let size = 0.2 + 0.01 * f64::from(k);
        vec![sign.0 * size, sign.1 * size]
    };
    let mut points: Vec<Vec<f64>> = Vec::new();
    for (sign, count) in [((1.0, 1.0), 20), ((1.0, -1.0), 20), ((-1.0, 1.0), 20), ((-1.0, -1.0), 2)]
    {
        points.extend((0..count).map(|k| quadrant(k, sign)));
    }
    let limits = FeatureLimits { transient: 100, stretch: 10, ..FeatureLimits::new(0.1, 0.01) };
    let found = FeatureAttractors::search(&step, &means, &points, limits).unwrap();
    assert_eq!((found.attractors().len(), found.unmatched().len()), (3, 2));
    assert!(found.unmatched().iter().all(|orbit| orbit.reason == UnmatchedReason::NoGroup));
    assert_eq!(found.attractors()[1].points[0], [1.0, -1.0]);
    assert_eq!(found.positions()[&Label::from(3)].len(), limits.stretch);
    assert!(found.label(&step, &means, &[-0.5, -0.5]).is_undecided());
}

#[test]
fn limits_and_features_that_mean_nothing_are_refused() {
    let map = |x: &[f64]| Some(vec![0.5 * x[0]]);
    let points = vec![vec![1.0]; 5];
    let good = FeatureLimits { transient: 10, stretch: 5, ..FeatureLimits::new(0.1, 0.1) };
    let found = |limits| FeatureAttractors::search(&map, &means, &points, limits).map(|_| ());
    assert_eq!(found(good), Ok(()));
    for bad in [
        FeatureLimits { radius: f64::NAN, ..good },
        FeatureLimits { beside: -1.0, ..good },
        FeatureLimits { stretch: 0, ..good },
        FeatureLimits { agree: 0, ..good },
        FeatureLimits { budget: 2, ..good },
    ] {
        assert!(matches!(found(bad), Err(Error::BadSearch { .. })), "{bad:?}");
    }
    for endless in [
        FeatureLimits { stretch: usize::MAX, ..good },
        FeatureLimits { agree: usize::MAX, budget: usize::MAX, ..good },
        FeatureLimits { agree: 5000, budget: 5000, ..good },
        FeatureLimits { budget: usize::MAX, ..good },
        FeatureLimits { transient: usize::MAX, ..good },
        FeatureLimits { tests: usize::MAX, ..good },
    ] {
        let refused = found(endless);
        assert!(matches!(refused, Err(Error::TooManySamples { .. })), "{endless:?}");
    }
    // Features of different lengths, of none, and without a number.
    let unlike = |points: &[Vec<f64>]| vec![0.0; 1 + usize::from(points[0][0] > 0.0005)];
    let short = FeatureLimits { transient: 0, ..good };
    let error = FeatureAttractors::search(&map, &unlike, &points, short).unwrap_err();
    assert_eq!(error, Error::WrongDimension { dimension: 1, expected: 2 });
    let empty = FeatureAttractors::search(&map, &|_: &[Vec<f64>]| vec![], &points, good);
    assert_eq!(empty, Err(Error::NoDimension));
    let nan = FeatureAttractors::search(&map, &|_: &[Vec<f64>]| vec![f64::NAN], &points, good);
    assert_eq!(nan.unwrap().unmatched().len(), 5);
    let none = FeatureAttractors::search(&map, &means, &[], good).unwrap();
    assert!(none.attractors().is_empty() && none.label(&map, &means, &[1.0]).is_undecided());
    assert_eq!(none.label(&map, &means, &[f64::NAN]), Label::UNDECIDED_MAP);
}

/// Two bands of mean rates and a lone one: the suggested radius has the largest silhouettes of all radii, and a matrix is a vector.
#[test]
fn silhouettes_are_largest_at_the_suggested_radius() {
    let random = SplitMix64::from_seed(6);
    let matrix = |k: u64| -> Vec<f64> {
        let centre = [0.0, 3.0, 4.0][k as usize % 3];
        (0..4).map(|i| centre + 0.4 * random.uniform(4 * k + i)).collect()
    };
    let features: Vec<Vec<f64>> = (0..90).map(matrix).collect();
    let mean = |radius: f64| {
        let groups = FeatureGroups::dense(&features, radius, 4).unwrap();
        let own = groups.silhouettes();
        // Vectors of no group count as 0.
        let in_groups = |label| groups.vectors(label).count() as f64;
        own.iter().map(|(label, mean)| mean * in_groups(*label)).sum::<f64>() / 90.0
    };
    let suggested = suggested_radius(&features, 4).unwrap().radius;
    let groups = FeatureGroups::dense(&features, suggested, 4).unwrap();
    assert_eq!(groups.labels().len(), 3);
    assert!(groups.silhouettes().values().all(|own| *own > 0.7), "{:?}", groups.silhouettes());
    let best = mean(suggested);
    for radius in (1..60).map(|k| 0.1 * f64::from(k)) {
        assert!(mean(radius) <= best + 1e-12, "{radius} {} {best}", mean(radius));
    }
    // By another distance with its own radius, and by cells.
    let largest = suggested_radius_by(&Metric::largest(), &features, 4).unwrap().radius;
    let by_largest = FeatureGroups::dense_by(Metric::largest(), &features, largest, 4).unwrap();
    let in_cells = FeatureGroups::histogram(&features, &[1.0; 4], 4).unwrap();
    for (k, own) in features.iter().enumerate() {
        let expected = Label::from(1 + (k % 3) as u8);
        assert_eq!((by_largest.label(own), in_cells.label(own)), (expected, expected));
    }
    let one = FeatureGroups::dense(&features, 100.0, 4).unwrap();
    assert!(one.silhouettes().is_empty());
    assert!(FeatureGroups::histogram(&features, &[0.0; 4], 4).is_err());
    assert!(FeatureGroups::histogram(&features, &[1.0; 3], 4).is_err());
}
