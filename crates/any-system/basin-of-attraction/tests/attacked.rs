//! Promises that were false once.

use basin_of_attraction::{
    AlongSearch, Attractors, Branch, CurveLimits, EscapeTimes, FeatureGroups, GapLengths,
    Hyperrectangle, Interval, Itineraries, KneadingSequence, Label, Matching, Metric, PreimageTree,
    RecurrenceLimits, Side, SplitMix64, Stability, StateGrid, StateMap, array_map,
    attractors_along, intermingledness, suggested_radius_by, watched_map,
};
use std::f64::consts::TAU;
use std::ops::ControlFlow::Continue;
use std::sync::atomic::{AtomicUsize, Ordering};

fn line(left: f64, right: f64) -> Hyperrectangle {
    Interval::new(left, right).unwrap().try_into().unwrap()
}

fn search(map: &dyn StateMap, half: f64, cells: usize, starts: &[f64]) -> Attractors {
    let grid = StateGrid::uniform(line(-half, half), cells).unwrap();
    let starts: Vec<Vec<f64>> = starts.iter().map(|x| vec![*x]).collect();
    Attractors::search(map, grid, &starts, RecurrenceLimits::default()).unwrap()
}

/// Two attractors on grids of two sizes, and starts outside the region.
#[test]
fn states_outside_belong_to_no_cell() {
    let map = array_map(|[x]: [f64; 1]| {
        Some([if x < 0.13 { -0.5 + 0.5 * (x + 0.5) } else { 0.15 + 0.5 * (x - 0.15) }])
    });
    let found = search(&map, 1.0, 10, &[-0.5, 0.15]);
    assert_eq!(found.attractors().len(), 2);
    let all = found.convergences(&map, 2, |k, x| x[0] = [2.0, -7.0][k]).unwrap();
    for (k, start) in [2.0, -7.0].into_iter().enumerate() {
        assert_eq!(found.convergence(&map, &[start]), Ok(all[k]));
    }
}

/// Behind its crisis all orbits of Hénon's map escape: basin 1 has vanished, and nothing takes its label.
#[test]
fn an_escape_is_no_attractor_at_any_parameter() {
    let henon = |a: f64| array_map(move |[x, y]: [f64; 2]| Some([1.0 - a * x * x + y, 0.3 * x]));
    let square = Hyperrectangle::new(vec![Interval::new(-2.0, 2.0).unwrap(); 2]).unwrap();
    let grid = StateGrid::uniform(square.clone(), 100).unwrap();
    let limits = RecurrenceLimits { escape: Some(100.0), tests: 50, ..RecurrenceLimits::default() };
    let search = AlongSearch { limits, starts: 10, points: 300, ..AlongSearch::new(grid, square) };
    let curve =
        CurveLimits { first_steps: 3, difference: 0.3, shortest: 0.01, ..CurveLimits::default() };
    let range = Interval::new(1.38, 1.5).unwrap();
    for matching in
        [None, Some(Matching::Overlap { least: 0.3 }), Some(Matching::Nearest { within: 1.0 })]
    {
        let along = attractors_along(range, &[], curve, matching, &search, henon).unwrap();
        let (_, last) = along.fractions.points().last().unwrap();
        assert_eq!((last.of(Label::ESCAPED).value, last.of(Label::from(1)).value), (1.0, 0.0));
        let changes = along.fractions.unmatched();
        assert!(
            changes.len() == 1 && changes[0].label == Label::from(1) && !changes[0].appears,
            "{changes:?}"
        );
    }
}

/// Fixed points 0.05 and 0.15 in one cell, the second one approached slowly, or the first one with a narrow basin.
#[test]
fn slow_or_narrow_attractors_in_one_cell_are_not_swallowed() {
    for slow in [0.5, 0.9, 0.99, 0.9985] {
        let map = array_map(move |[x]: [f64; 1]| {
            Some([if x < 0.1 { 0.05 + 0.5 * (x - 0.05) } else { 0.15 + slow * (x - 0.15) }])
        });
        for starts in [[0.0, 0.3], [0.3, 0.0]] {
            let found = search(&map, 1.0, 10, &starts);
            assert_eq!((found.attractors().len(), found.unmatched().len()), (2, 0), "{slow}");
            assert_ne!(found.label(&map, &[0.15]), found.label(&map, &[0.05]));
        }
    }
    let narrow = array_map(|[x]: [f64; 1]| {
        Some([if x < 0.052 { 0.05 + 0.5 * (x - 0.05) } else { 0.15 + 0.5 * (x - 0.15) }])
    });
    for starts in [[0.0, 0.3], [0.3, 0.0]] {
        let found = search(&narrow, 1.0, 10, &starts);
        let label = found.label(&narrow, &[0.4]);
        let own = found.attractors().iter().find(|own| own.label == label).unwrap();
        assert!((own.points[0][0] - 0.15).abs() < 1e-9, "{found:?}");
        assert_ne!(found.label(&narrow, &[0.0]), label);
    }
}

/// A tent of a slope just below 2, where the images of the pieces miss the ends of others by 4·10⁻¹⁰; pieces that only touch.
#[test]
fn pieces_that_miss_each_other_by_little_do_not_cover() {
    let slope = 2.0 * (1.0 - 4e-10);
    let tent = move |x: f64| Some(slope * x.min(1.0 - x));
    let branch = |left, right, at_left, at_right| Branch {
        domain: Interval { left, right },
        at_left,
        at_right,
    };
    let branches = [branch(0.0, 0.5, 0.0, 0.5 * slope), branch(0.5, 1.0, 0.5 * slope, 0.0)];
    let (trap, window) = (Interval { left: 2.0, right: 3.0 }, Interval { left: 0.0, right: 1.0 });
    let tree = PreimageTree::grow_from_known(&tent, &branches, trap, window, 3).unwrap();
    if let Itineraries::Cantor { entropy } = tree.itineraries(&tent, &branches, 3) {
        assert!(entropy.lower <= slope.ln() && slope.ln() <= entropy.upper, "{entropy:?}");
    }
    let flip = |x: f64| Some(-x);
    let branches = [branch(0.0, 1.0, 0.0, -1.0)];
    let trap = Interval { left: -1.0, right: -0.5 };
    let tree = PreimageTree::grow_from_known(&flip, &branches, trap, window, 3).unwrap();
    assert_ne!(tree.itineraries(&flip, &branches, 3), Itineraries::None);
    assert_eq!(
        tree.itineraries(&flip, &branches, usize::MAX),
        tree.itineraries(&flip, &branches, 3)
    );
}

/// A fatal shock by the short way round a circle is never below the smallest one.
#[test]
fn fatal_shocks_round_a_circle_are_upper_bounds() {
    let round = Metric::by(|a, b| {
        let off = (a[0] - b[0]).abs() % TAU;
        off.min(TAU - off)
    });
    let label = |x: f64| Label::from(1 + u8::from((-2.9..-1.0).contains(&x)));
    let starts: Vec<Vec<f64>> = (0..200).map(|k| vec![0.0315 * f64::from(k) - 3.15]).collect();
    let found: Vec<(Label, usize)> = starts.iter().map(|x| (label(x[0]), 1)).collect();
    let attractors = [(Label::from(1), vec![vec![3.0]])].into();
    let mut all = Stability::with_distance(&attractors, &starts, &found, round).unwrap();
    all.shorten_fatal_shocks(1e-9, |x| label(x[0])).unwrap();
    let fatal = all.of(Label::from(1)).unwrap().fatal.clone().unwrap();
    assert!(fatal.size >= TAU - 5.9 - 1e-9 && fatal.size < 0.45, "{fatal:?}");
    let bad = vec![(Label::from(1), 1)];
    assert!(Stability::new(&attractors, &[vec![f64::NAN]], &bad).is_err());
}

/// A start just below a period, and cycles that are partly outside the region.
#[test]
fn borders_and_cycles_have_one_answer() {
    let circle = array_map(|[x, y]: [f64; 2]| Some([x + 0.3 / TAU * (TAU * x).sin(), 0.5 * y]));
    let grid = StateGrid::uniform(line(0.0, 1.0), 10).unwrap().periodic(0).unwrap();
    let grid = grid.of_coordinates(&[0], 2).unwrap();
    let found = Attractors::search(&circle, grid, &[vec![0.3, 0.1]], RecurrenceLimits::default());
    let found = found.unwrap();
    let flip = array_map(|[x]: [f64; 1]| Some([-x]));
    let cut = StateGrid::uniform(line(-1.0, 3.0), 10).unwrap();
    let halves = Attractors::search(&flip, cut, &[vec![0.5]], RecurrenceLimits::default()).unwrap();
    let cases: [(&Attractors, &dyn StateMap, Vec<f64>); 2] =
        [(&found, &circle, vec![-1e-20, 0.0]), (&halves, &flip, vec![2.0])];
    for (found, map, start) in cases {
        let many = found.convergences(map, 1, |_, state| state.copy_from_slice(&start)).unwrap();
        assert_eq!(found.convergence(map, &start), Ok(many[0]), "{start:?}");
    }
}

#[test]
fn what_has_no_meaning_is_refused_or_ends_soon() {
    // Two kinds without a distance between them are never one group.
    let kinds = Metric::by(|a, b| if a[0] == b[0] { (a[1] - b[1]).abs() } else { f64::NAN });
    let features: Vec<Vec<f64>> =
        (0..20).map(|k| vec![f64::from(k % 2), f64::from(k / 10)]).collect();
    let found = suggested_radius_by(&kinds, &features, 2).unwrap();
    assert!(found.radius.is_finite() && found.below.is_none_or(f64::is_finite), "{found:?}");
    let plane = array_map(|[x, y]: [f64; 2]| Some([x, y]));
    let halve = array_map(|[x]: [f64; 1]| Some([0.5 * x]));
    let found = search(&halve, 1.0, 10, &[0.5]);
    assert!(
        found.label(&plane, &[0.5]).is_undecided() && found.convergence(&plane, &[0.5]).is_err()
    );
    let inside = |x: &[f64]| x[0] < 1.0;
    let times = EscapeTimes::of_random_points(&halve, &inside, &line(0.0, 1.0), 10, usize::MAX, 1);
    assert!(times.is_err());
    let limits = RecurrenceLimits { tests: usize::MAX, ..RecurrenceLimits::default() };
    let grid = StateGrid::uniform(line(-1.0, 1.0), 10).unwrap();
    assert!(Attractors::search(&halve, grid, &[vec![0.5]], limits).is_err());
    // A sequence of no entropy, 2000 sides of an infinitely doubled one.
    let mut sides = vec![Side::Right];
    while sides.len() < 2000 {
        let mut next = sides.clone();
        next.push(Side::Left);
        next.extend_from_slice(&sides);
        if sides.iter().filter(|side| **side == Side::Right).count() % 2 == 0 {
            next[sides.len()] = Side::Right;
        }
        sides = next;
    }
    let entropy = KneadingSequence::from_sides(&sides).entropy().unwrap();
    assert!(entropy.lower == 0.0 && entropy.upper < 0.1, "{entropy:?}");
}

/// A slow rotation in eight dimensions, with 6561 neighbours of each cell.
#[test]
fn spaces_of_many_dimensions_take_seconds() {
    let turn = array_map(|state: [f64; 8]| {
        let mut image = [0.0; 8];
        for k in 0..4 {
            let (x, y) = (state[2 * k], state[2 * k + 1]);
            let factor = 1.0 + 0.3 * (0.5 - x.hypot(y));
            let (sine, cosine) = (0.3 + 0.1 * k as f64).sin_cos();
            (image[2 * k], image[2 * k + 1]) =
                (factor * (cosine * x - sine * y), factor * (sine * x + cosine * y));
        }
        Some(image)
    });
    let region = Hyperrectangle::new(vec![Interval::new(-1.0, 1.0).unwrap(); 8]).unwrap();
    let limits = RecurrenceLimits { locate: 200, tests: 50, ..RecurrenceLimits::default() };
    let grid = StateGrid::uniform(region, 4).unwrap();
    let found = Attractors::search(&turn, grid, &[vec![0.4; 8]], limits).unwrap();
    assert!(found.attractors().len() + found.unmatched().len() == 1);
}

/// An orbit that crosses the cells of an attractor of which one coordinate is hidden has not come to it. Labels are those of the whole grid.
#[test]
fn an_orbit_that_crosses_cells_of_a_projection_goes_on() {
    let step = |x: f64, y: f64| x + 0.5 * x * (1.0 - x * x) / (1.0 + x * x) + y;
    let map = array_map(move |[x, y]: [f64; 2]| Some([step(x, y), 0.5 * y]));
    let line = Interval::new(-4.0, 4.0).unwrap().try_into().unwrap();
    let starts = [vec![0.5, 0.0], vec![-0.5, 0.0]];
    let limits = RecurrenceLimits::default();
    let hidden = StateGrid::uniform(line, 201).unwrap().of_coordinates(&[0], 2).unwrap();
    let whole = Hyperrectangle::new(vec![Interval::new(-4.0, 4.0).unwrap(); 2]).unwrap();
    let whole = StateGrid::uniform(whole, 201).unwrap();
    let [hidden, whole] =
        [hidden, whole].map(|grid| Attractors::search(&map, grid, &starts, limits).unwrap());
    let random = SplitMix64::from_seed(3);
    for k in 0..300 {
        let start = [0, 1].map(|axis| 4.0 * random.uniform(2 * k + axis) - 2.0);
        assert_eq!(hidden.label(&map, &start), whole.label(&map, &start), "{start:?}");
    }
    // From 1 the orbit goes to −1. It is in the cell of 1 at the start, and has not come to it.
    let (label, steps) = hidden.convergence(&map, &[1.0, -2.0]).unwrap();
    assert!(label == hidden.label(&map, &[-1.0, 0.0]) && (5..60).contains(&steps), "{steps}");
}

/// Orbits that swing slowly towards a fixed point have no period; cycles that are approached slowly have theirs.
#[test]
fn slow_oscillations_are_no_cycles() {
    let logistic = |r: f64| array_map(move |[x]: [f64; 1]| Some([r * x * (1.0 - x)]));
    let period = |map: &dyn StateMap, region: (f64, f64), start: &[f64]| {
        let side = Interval::new(region.0, region.1).unwrap();
        let region = Hyperrectangle::new(vec![side; start.len()]).unwrap();
        let grid = StateGrid::uniform(region, 100).unwrap();
        let limits = RecurrenceLimits::default();
        let found = Attractors::search(map, grid, &[start.to_vec()], limits).unwrap();
        found.attractors().first().and_then(|own| own.period)
    };
    for r in [2.999, 2.99995] {
        assert!(matches!(period(&logistic(r), (0.0, 1.0), &[0.3]), None | Some(1)), "{r}");
    }
    for turn in [2.4, TAU / 5.0, 3.0 * TAU / 7.0] {
        for modulus in [0.999, 0.9999] {
            let (s, c) = (modulus * f64::sin(turn), modulus * f64::cos(turn));
            let focus = array_map(move |[x, y]: [f64; 2]| Some([c * x - s * y, s * x + c * y]));
            let found = period(&focus, (-1.03, 1.0), &[0.5, 0.3]);
            assert!(matches!(found, None | Some(1)), "{turn} {modulus}: {found:?}");
        }
    }
    for (r, cycle) in [(3.001, 2), (3.2, 2), (3.44, 2), (3.5, 4), (3.55, 8), (3.8319, 3)] {
        assert_eq!(period(&logistic(r), (0.0, 1.0), &[0.3]), Some(cycle), "{r}");
    }
}

/// Attractors without points have times; distances that do not exist, or whose squares overflow, are no NaN.
#[test]
fn what_has_no_points_or_no_distance_is_told() {
    let starts: Vec<Vec<f64>> = (0..100).map(|k| vec![f64::from(k)]).collect();
    let found: Vec<(Label, usize)> = (0..100u8).map(|k| (Label::from(k % 2), 7)).collect();
    let none = [(Label::from(1), Vec::new())].into();
    let all = Stability::new(&none, &starts, &found).unwrap();
    let own = all.of(Label::from(1)).unwrap();
    assert_eq!(own.fraction_within(7).unwrap(), own.fraction);
    assert!(own.fatal.is_none() && own.longest.as_ref().unwrap().steps == 7);
    assert_eq!(own.mean_time.unwrap().value, 7.0);
    let same = vec![vec![2.0]; 4];
    let labels = [0, 0, 1, 1].map(Label::from);
    let mixed = |points: &[Vec<f64>]| intermingledness(points, &labels, &Metric::euclidean());
    assert!(mixed(&same).unwrap().values().all(|x| *x == 1.0));
    assert!(mixed(&[vec![1.0], vec![1.0, 2.0], vec![3.0], vec![4.0]]).is_err());
    assert!(mixed(&[vec![1.0], vec![f64::NAN], vec![3.0], vec![4.0]]).is_err());
    for unit in [1e200, 1e-200] {
        let features = [1.0, 1.1, -1.0, -1.1].map(|x| vec![unit * x]);
        let groups = FeatureGroups::dense(&features, 0.5 * unit, 2).unwrap();
        assert_eq!(groups.labels().len(), 2);
        assert!((groups.separation().unwrap() / unit - 2.0).abs() < 1e-12);
    }
    // A distance between some vectors only.
    let some =
        Metric::by(
            |a, b| if a[0] * b[0] < 0.0 { (a[0] - a[0]) / 0.0 } else { (a[0] - b[0]).abs() },
        );
    let features = [1.0, 1.1, -1.0, -1.1].map(|x| vec![x]);
    let groups = FeatureGroups::dense_by(some, &features, 0.5, 2).unwrap();
    assert_eq!(groups.separation(), None);
    assert!(groups.silhouettes().values().all(|x| *x == 0.0));
    let cells = Metric::cells(&[1e-10]).distance(&[1e300], &[2e300]);
    assert!(cells.is_nan());
}

/// Joined gaps leave what is between them; where the window leaves out branches to which orbits go nothing is known.
#[test]
fn gaps_and_windows_leave_out_nothing() {
    let interval = |left, right| Interval::new(left, right).unwrap();
    let gaps = [interval(0.0, 0.4), interval(0.45, 1.0)];
    let joined = GapLengths::new(&gaps, interval(0.0, 1.0), 0.1).unwrap();
    assert!((joined.left() - 0.05).abs() < 1e-15 && joined.lengths().len() == 1);
    let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
    let branches = [
        Branch { domain: interval(0.0, 0.5), at_left: 0.0, at_right: 1.5 },
        Branch { domain: interval(0.5, 1.0), at_left: 1.5, at_right: 0.0 },
    ];
    for (left, right) in [(0.6, 0.7), (0.0, 0.4)] {
        let above = interval(1.0 + 1e-12, 1.5);
        let window = interval(left, right);
        let tree = PreimageTree::grow_from_known(&tent, &branches, above, window, 8).unwrap();
        assert_eq!(tree.itineraries(&tent, &branches, 8), Itineraries::Undecided);
    }
}

/// Many steps at once are counted as they are made.
#[test]
fn progress_comes_about_every_thousand_images() {
    let henon = array_map(|[x, y]: [f64; 2]| Some([1.0 - 1.4 * x * x + y, 0.3 * x]));
    let (largest, last) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let watched = watched_map(&henon, |images| {
        let gap = images.abs_diff(last.swap(images, Ordering::Relaxed));
        largest.fetch_max(gap, Ordering::Relaxed);
        Continue(())
    });
    let mut states = vec![vec![0.1; 4], vec![0.1; 4]];
    assert_eq!(watched.advance(&mut states, &mut [false; 4], 100_000), 100_000);
    assert_eq!(last.load(Ordering::Relaxed), 399_360);
    assert_eq!(largest.load(Ordering::Relaxed), 1024);
    // Without an image only the steps count that were made.
    let escapes = array_map(|[x]: [f64; 1]| (x < 5.0).then_some([x + 1.0]));
    let counted = AtomicUsize::new(0);
    let watched = watched_map(&escapes, |images| {
        counted.store(images, Ordering::Relaxed);
        Continue(())
    });
    assert_eq!(watched.advance(&mut [vec![0.0]], &mut [false], 20_000), 6);
    assert_eq!(counted.load(Ordering::Relaxed), 0);
}
