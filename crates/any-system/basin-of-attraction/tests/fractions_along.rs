//! Fractions along a parameter with known answers: a fraction that changes smoothly, a jump, a narrow peak,
//! attractors whose numbers change.

use basin_of_attraction::{
    AlongProgress, AlongSearch, Attractors, CurveLimits, Error, FractionRange, Fractions,
    FractionsAlong, Hyperrectangle, Interval, Label, LabelCounts, Matching, RecurrenceLimits,
    StateGrid, UnresolvedReason, array_map, attractors_along_watched, fractions_along,
    fractions_along_matched, region_fractions,
};
use std::collections::BTreeMap;
use std::ops::ControlFlow::{Break, Continue};
use std::sync::Mutex;

fn grid(region: &Hyperrectangle, cells: usize) -> StateGrid {
    StateGrid::uniform(region.clone(), cells).unwrap()
}

const ONE: fn() -> Label = || Label::from(1);

fn unit() -> Interval {
    Interval::new(0.0, 1.0).unwrap()
}

/// The fraction p of basin 1, exact but for ± `error`.
fn of_one(p: f64, error: f64) -> Fractions {
    let range = FractionRange { value: p, lower: p - error, upper: p + error };
    Fractions { found: [(ONE(), range)].into(), ..Fractions::default() }
}

fn along(known: &[f64], limits: CurveLimits, p: impl Fn(f64) -> f64) -> FractionsAlong {
    fractions_along::<Error>(unit(), known, limits, |t| Ok(of_one(p(t), 0.0))).unwrap()
}

#[test]
fn neighbours_differ_by_less_than_is_asked_for() {
    // A square root with its infinite slope at 0.3.
    let root = |t: f64| (t - 0.3f64).max(0.0).sqrt();
    for (difference, known) in [(0.05, vec![]), (0.01, vec![0.3])] {
        let limits = CurveLimits { difference, shortest: 1e-7, ..CurveLimits::default() };
        let found = along(&known, limits, root);
        assert!(found.unresolved().is_empty(), "{:?}", found.unresolved());
        let points: Vec<(f64, FractionRange)> = found.of(ONE()).collect();
        assert_eq!((points[0].0, points[points.len() - 1].0), (0.0, 1.0));
        for pair in points.windows(2) {
            assert!(
                (pair[1].1.value - pair[0].1.value).abs() <= difference && pair[0].0 < pair[1].0
            );
        }
        // Not many more than a curve of this height needs.
        assert!((points.len() as f64) < 3.0 / difference, "{}", points.len());
        assert_eq!(points.iter().any(|point| point.0 == 0.3), !known.is_empty());
    }
}

#[test]
fn a_jump_is_located_to_the_shortest_step() {
    let jumps = |t: f64| if t < 1.0 / 3.0 { 0.2 } else { 0.7 + 0.1 * t };
    let limits = CurveLimits { shortest: 1e-9, ..CurveLimits::default() };
    let found = along(&[], limits, jumps);
    let [jump] = found.unresolved() else { panic!("{:?}", found.unresolved()) };
    assert_eq!((jump.reason, jump.label), (UnresolvedReason::Jump, ONE()));
    assert!(jump.from < 1.0 / 3.0 && 1.0 / 3.0 <= jump.to && jump.to - jump.from <= 2e-9);
    assert!(jump.before.value == 0.2 && jump.after.value > 0.7);
    assert_eq!(found.jumps().count(), 1);
}

/// A peak is lost if no parameter is in it. With the position of the peak as a known parameter it is followed down
/// to its width.
#[test]
fn a_narrow_peak_at_a_known_parameter_is_followed() {
    let peak = |t: f64| 0.5 * (-((t - 0.4321) / 1e-4).powi(2)).exp();
    let limits = CurveLimits { shortest: 1e-7, difference: 0.01, ..CurveLimits::default() };
    assert!(along(&[], limits, peak).of(ONE()).all(|(_, range)| range.value < 1e-6));
    let found = along(&[0.4321], limits, peak);
    assert!(found.unresolved().is_empty());
    let area: f64 = found
        .points()
        .windows(2)
        .map(|pair| {
            0.5 * (pair[1].0 - pair[0].0) * (pair[0].1.of(ONE()).value + pair[1].1.of(ONE()).value)
        })
        .sum();
    let exact = 0.5e-4 * std::f64::consts::PI.sqrt();
    assert!((area / exact - 1.0).abs() < 0.05, "{area} {exact}");
}

#[test]
fn uncertain_fractions_and_the_budget_end_the_search_and_are_reported() {
    // Noise of the size of the ranges.
    let noisy = |t: f64| of_one(0.5 + 0.05 * (1e5 * t).sin(), 0.06);
    let found =
        fractions_along::<Error>(unit(), &[], CurveLimits::default(), |t| Ok(noisy(t))).unwrap();
    assert_eq!(found.points().len(), 17);
    assert!(!found.unresolved().is_empty() && found.jumps().next().is_none());
    assert!(found.unresolved().iter().all(|step| step.reason == UnresolvedReason::Uncertain));
    let few = CurveLimits { budget: 20, ..CurveLimits::default() };
    let found = along(&[], few, |t| t);
    assert_eq!(found.points().len(), 20);
    assert!(found.unresolved().iter().all(|step| step.reason == UnresolvedReason::Budget));
    // A relative difference of a fraction that is small everywhere.
    let limits = CurveLimits { difference: 1e-9, relative: 0.1, ..CurveLimits::default() };
    let found = along(&[], limits, |t| 1e-5 * (5.0 * t).exp());
    assert!(found.unresolved().is_empty() && found.points().len() > 40);
}

/// A basin that is not in the list may have what is undecided.
#[test]
fn an_unseen_basin_has_a_range_up_to_what_is_undecided() {
    let fractions = Fractions { unseen: 0.01, ..of_one(0.9, 0.0) };
    let other = fractions.of(Label::from(2));
    assert_eq!((other.value, other.lower, other.upper), (0.0, 0.0, 0.01));
    assert_eq!(other.gap(&fractions.of(ONE())), 0.89);
}

/// x → 3x/2 − x³/2 + c x: the attractors ±√(1 + 2c) are numbered in the order in which random starts find them.
/// Their basins have one half each.
#[test]
fn attractors_whose_numbers_change_are_matched_by_position() {
    let line = Hyperrectangle::try_from(Interval::new(-1.5, 1.5).unwrap()).unwrap();
    let matched = Matching::Nearest { within: 0.2 };
    let limits = CurveLimits { first_steps: 8, ..CurveLimits::default() };
    let mut positive = Vec::new();
    let at = |c: f64, _: Option<&(f64, Fractions)>| {
        let map = move |x: &[f64]| Some(vec![(1.5 + c) * x[0] - 0.5 * x[0] * x[0] * x[0]]);
        // The number of the positive attractor is 1 or 2, as the first start says.
        let sign = if (1e2 * c).sin() > 0.0 { 1.0 } else { -1.0 };
        let starts = [vec![0.3 * sign], vec![-0.4 * sign]];
        let found =
            Attractors::search(&map, grid(&line, 100), &starts, RecurrenceLimits::default())?;
        positive.push(found.label(&map, &[0.3]));
        let counts = region_fractions(&line, 4000, 1, |x| {
            // The positive basin is made smaller by c.
            found.label(&map, &[x[0] - c])
        })?;
        Ok::<_, Error>(Fractions::from_counts(&counts)?.with_attractors(found.positions()))
    };
    let range = Interval::new(0.0, 0.2).unwrap();
    let found = fractions_along_matched(range, &[], limits, matched, at).unwrap();
    assert!(positive.contains(&Label::from(1)) && positive.contains(&Label::from(2)));
    assert!(
        found.unresolved().is_empty() && found.unmatched().is_empty(),
        "{:?}",
        found.unmatched()
    );
    // The same label is the same attractor at every parameter.
    let label = found.labels()[0];
    let sign = found.points()[0].1.attractors[&label][0][0].signum();
    for (c, fractions) in found.points() {
        let place = fractions.attractors[&label][0][0];
        assert!((place - sign * (1.0 + 2.0 * c).sqrt()).abs() < 1e-6);
        let expected = 0.5 - sign * c / 3.0;
        assert!((fractions.of(label).value - expected).abs() < 0.03);
    }
}

/// At c = 0 a second attractor appears: its basin has a label of its own, and is reported.
#[test]
fn an_attractor_that_appears_has_a_new_label() {
    let at = |c: f64| {
        let own = |x: f64, p: f64| (vec![vec![x]], FractionRange { value: p, lower: p, upper: p });
        // Before, the left one has label 2; after, the labels 1 and 2 are the right and the left one.
        let left = own(-1.0, if c < 0.0 { 1.0 } else { 0.6 });
        let mut found =
            Fractions { found: [(Label::from(2), left.1)].into(), ..Fractions::default() };
        found.attractors.insert(Label::from(2), left.0);
        if c >= 0.0 {
            let right = own(1.0, 0.4);
            found.found.insert(Label::from(1), right.1);
            found.attractors.insert(Label::from(1), right.0);
            // The numbers of both are exchanged above a half.
            if c > 0.5 {
                let (one, two) = (found.found[&Label::from(1)], found.found[&Label::from(2)]);
                found.found = [(Label::from(1), two), (Label::from(2), one)].into();
                found.attractors =
                    [(Label::from(1), vec![vec![-1.0]]), (Label::from(2), vec![vec![1.0]])].into();
            }
        }
        Ok::<_, Error>(found)
    };
    let range = Interval::new(-1.0, 1.0).unwrap();
    let nearest = Matching::Nearest { within: 0.5 };
    let limits = CurveLimits::default();
    let found = fractions_along_matched(range, &[], limits, nearest, |c, _| at(c)).unwrap();
    let [new] = found.unmatched() else { panic!("{:?}", found.unmatched()) };
    assert!(new.appears && new.label == Label::from(1) && new.from < 0.0 && new.to >= 0.0);
    let [jump] = found.unresolved() else { panic!("{:?}", found.unresolved()) };
    assert!(jump.reason == UnresolvedReason::Jump && jump.to - jump.from <= 2e-6);
    let [(_, last)] = &found.points()[found.points().len() - 1..] else { panic!() };
    assert_eq!((last.of(Label::from(2)).value, last.of(Label::from(1)).value), (0.6, 0.4));
}

#[test]
fn curves_that_cannot_be_divided_are_refused() {
    let all = |_: f64| Ok::<_, Error>(Fractions::default());
    let limits = CurveLimits::default();
    let bad = |limits| fractions_along(unit(), &[], limits, all).unwrap_err();
    for limits in [
        CurveLimits { first_steps: 0, ..limits },
        CurveLimits { difference: 0.0, ..limits },
        CurveLimits { difference: f64::NAN, ..limits },
        CurveLimits { relative: -1.0, ..limits },
        CurveLimits { shortest: 0.0, ..limits },
        CurveLimits { budget: 16, ..limits },
        CurveLimits { first_steps: usize::MAX, ..limits },
    ] {
        assert!(matches!(bad(limits), Error::BadCurveLimits { .. }), "{limits:?}");
    }
    let many = CurveLimits { first_steps: 1 << 40, budget: usize::MAX, ..limits };
    assert!(matches!(bad(many), Error::TooManySamples { .. }));
    for (left, right) in [(1.0, 0.0), (0.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        assert!(fractions_along(Interval { left, right }, &[], limits, all).is_err());
    }
    assert!(fractions_along(unit(), &[f64::NAN], limits, all).is_err());
    let fails = |_: f64| Err::<Fractions, _>(Error::NoDimension);
    assert_eq!(fractions_along(unit(), &[], limits, fails), Err(Error::NoDimension));
}

/// Two attractors at ±1 for c in [0, 1]; the one at 1 is there only up to 0.3 and from 0.7 on. Their numbers are exchanged at random.
fn comes_and_goes(c: f64, exchanged: bool) -> Fractions {
    let [mut left, mut right] = [1, 2].map(Label::from);
    if exchanged {
        (left, right) = (right, left);
    }
    let is_there = !(0.3..0.7).contains(&c);
    let samples = (0..100).map(|k| if is_there && k >= 60 { right } else { left });
    let counts = LabelCounts::new(samples.clone()).unwrap();
    let mut attractors: BTreeMap<Label, Vec<Vec<f64>>> =
        [(left, vec![vec![-1.0 - 0.1 * c]])].into();
    if is_there {
        attractors.insert(right, vec![vec![1.0 + 0.1 * c]]);
    }
    let found = Fractions::from_counts(&counts).unwrap();
    found.with_attractors(attractors).with_labels(samples.collect())
}

/// By distance, by any measure, by overlap and by the flow: the attractor that comes back has its label again.
#[test]
fn an_attractor_that_vanishes_is_remembered_by_any_matching() {
    let exchanged = |c: f64| (1e3 * c).sin() > 0.0;
    let mean = |a: &[Vec<f64>], b: &[Vec<f64>]| {
        let off = (a[0][0] - b[0][0]).abs();
        (off < 0.5).then_some(off)
    };
    let flow = |c: f64, point: &[f64]| {
        let is_right = point[0] > 0.0 && !(0.3..0.7).contains(&c);
        Label::from(1 + u8::from(is_right != exchanged(c)))
    };
    let limits = CurveLimits { first_steps: 10, shortest: 1e-3, ..CurveLimits::default() };
    for (name, matching) in [
        ("nearest", Matching::Nearest { within: 0.5 }),
        ("by", Matching::By(&mean)),
        ("overlap", Matching::Overlap { least: 0.5 }),
        ("flow", Matching::Flow(&flow)),
    ] {
        let at =
            |c: f64, _: Option<&(f64, Fractions)>| Ok::<_, Error>(comes_and_goes(c, exchanged(c)));
        let found = fractions_along_matched(unit(), &[], limits, matching, at).unwrap();
        let changes: Vec<bool> = found.unmatched().iter().map(|own| own.appears).collect();
        assert_eq!(changes, [false, true], "{name}");
        assert_eq!(found.unmatched()[0].label, found.unmatched()[1].label, "{name}");
        let left = found.points()[0].1.attractors.iter().find(|own| own.1[0][0] < 0.0).unwrap().0;
        for (c, own) in found.points() {
            assert!(own.attractors[left][0][0] < 0.0, "{name} {c}");
            assert_eq!(own.attractors.len(), if (0.3..0.7).contains(c) { 1 } else { 2 }, "{name}");
            let share = if own.attractors.len() == 1 { 1.0 } else { 0.6 };
            assert_eq!(own.of(*left).value, share, "{name} {c}");
        }
        // Both together have all of the region.
        for (_, all) in found.aggregated(|_, _, _| Label::from(7)) {
            assert_eq!((all.found.len(), all.of(Label::from(7)).upper), (1, 1.0));
            assert!((all.of(Label::from(7)).value - 1.0).abs() < 1e-12);
        }
    }
}

/// Progress shows images, and gives away all that is finished before the work is stopped: between parameters, and amid one.
#[test]
fn a_search_along_a_parameter_shows_progress_and_can_be_stopped() {
    let line: Hyperrectangle = Interval::new(-2.0, 2.0).unwrap().try_into().unwrap();
    let search = AlongSearch { points: 100, ..AlongSearch::new(grid(&line, 100), line) };
    let wells = |c: f64| array_map(move |[x]: [f64; 1]| Some([x + 0.1 * (c + x - x * x * x)]));
    let run = |most_images: usize, most_found: usize| {
        let received = Mutex::new((Vec::new(), 0));
        let progress = |parameter: f64, done: AlongProgress<'_>| {
            let mut received = received.lock().unwrap();
            let goes_on = match done {
                AlongProgress::Images(images) => {
                    received.1 = images;
                    images < most_images
                }
                AlongProgress::Found(found) => {
                    received.0.push((parameter, found.attractors().len()));
                    received.0.len() < most_found
                }
            };
            if goes_on { Continue(()) } else { Break(()) }
        };
        let limits = CurveLimits { first_steps: 4, budget: 50, ..CurveLimits::default() };
        let range = Interval::new(-0.2, 0.2).unwrap();
        let found = attractors_along_watched(range, &[], limits, None, &search, wells, progress);
        let (received, images) = received.into_inner().unwrap();
        (found.map(|all| all.found.len()), received, images)
    };
    let (all, received, images) = run(usize::MAX, usize::MAX);
    assert_eq!((all, received[0]), (Ok(received.len()), (-0.2, 2)));
    assert!(images >= 1024, "{images}");
    let (stopped, received, _) = run(usize::MAX, 3);
    assert_eq!(stopped, Err(Error::Interrupted { finished: 3, parts: 50 }));
    assert_eq!(received, [(-0.2, 2), (-0.1, 2), (0.0, 2)]);
    let (stopped, received, _) = run(1024, 3);
    assert_eq!((stopped, received.len()), (Err(Error::Interrupted { finished: 0, parts: 50 }), 0));
}
