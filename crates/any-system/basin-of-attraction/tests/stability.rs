//! Stability of attractors by random starts, with known answers.

use basin_of_attraction::{
    Attractors, Error, Hyperrectangle, Interval, Label, Metric, RecurrenceLimits, SplitMix64,
    Stability, StateGrid, array_map,
};

/// Newton's method for z³ = 1: the fractions of its three basins, and the minimal fatal shock 0.622046, as upper bounds.
#[test]
fn newtons_roots_have_known_fractions_and_fatal_shocks() {
    let newton = array_map(|[x, y]| {
        let (a, b) = (x * x - y * y, 2.0 * x * y);
        let d = 3.0 * (a * a + b * b);
        (d > 0.0).then(|| [2.0 / 3.0 * x + a / d, 2.0 / 3.0 * y - b / d])
    });
    let square = Hyperrectangle::new(vec![Interval::new(-1.5, 1.5).unwrap(); 2]).unwrap();
    let grid = StateGrid::uniform(square.clone(), 101).unwrap();
    let random = SplitMix64::from_seed(8);
    let starts: Vec<Vec<f64>> = (0..20_000).map(|k| square.random_point(&random, k)).collect();
    let limits = RecurrenceLimits::default();
    let found = Attractors::search(&newton, grid, &starts[..20], limits).unwrap();
    let at = |k: usize, state: &mut [f64]| state.copy_from_slice(&starts[k]);
    let times = found.convergences(&newton, starts.len(), at).unwrap();
    let mut all = Stability::new(&found.positions(), &starts, &times).unwrap();
    all.shorten_fatal_shocks(1e-12, |state| found.label(&newton, state)).unwrap();
    assert_eq!(all.attractors().len(), 3);
    for (label, own) in all.attractors() {
        let root = &found.positions()[label][0];
        let known = if root[0] > 0.0 { 0.3452 } else { 0.3274 };
        assert!((own.fraction.value - known).abs() < 0.01, "{own:?}");
        let fatal = own.fatal.as_ref().unwrap();
        assert!((0.622_046..0.64).contains(&fatal.size), "{}", fatal.size);
        assert!(fatal.label != *label && found.label(&newton, &fatal.state) == fatal.label);
        // No shock up to the minimal fatal one is fatal.
        let near = own.fatal_share(0.622_045).unwrap();
        assert!(near.value == 0.0 && near.upper < 0.005, "{near:?}");
        assert!(own.safe_size(0.01).is_some_and(|size| (0.622..0.8).contains(&size)));
        let harmless = own.harmless.as_ref().unwrap();
        assert!(harmless.size > 2.0 && found.label(&newton, &harmless.state) == *label);
        let (mean, longest) = (own.mean_time.unwrap(), own.longest.as_ref().unwrap());
        assert_eq!(found.convergence(&newton, &longest.start), Ok((*label, longest.steps)));
        assert!(mean.lower > 3.0 && mean.upper < 10.0 && longest.longer < 1e-3, "{mean:?}");
        let median = own.time_quantile(0.5).unwrap();
        assert!(
            median.lower <= median.value
                && median.value <= median.upper
                && median.upper < mean.value
        );
        // In finite time the fraction grows to all of it.
        let within = |steps| own.fraction_within(steps).unwrap().value;
        assert!(within(3) < within(6) && within(longest.steps) == own.fraction.value);
        assert!(own.mean_harmless.unwrap().upper < harmless.size);
    }
}

/// Undecided starts open the intervals, and starts outside the region of interest do not count.
#[test]
fn undecided_starts_open_the_intervals() {
    let starts: Vec<Vec<f64>> = (0..100).map(|k| vec![0.01 * f64::from(k)]).collect();
    let label = |x: f64| match x {
        x if x < 0.4 => Label::from(1),
        x if x < 0.5 => Label::UNDECIDED,
        x if x < 0.8 => Label::from(2),
        _ => Label::OUTSIDE,
    };
    let found: Vec<(Label, usize)> = starts.iter().map(|x| (label(x[0]), 7)).collect();
    let attractors = [(Label::from(1), vec![vec![0.0]]), (Label::from(2), vec![vec![0.7]])].into();
    let all = Stability::new(&attractors, &starts, &found).unwrap();
    let own = all.of(Label::from(1)).unwrap();
    assert_eq!((own.fraction.value, own.fatal_share(0.6).unwrap().value), (0.5, 11.0 / 61.0));
    assert!(own.fraction.upper > 0.6 && own.fatal_share(0.45).unwrap().upper > 0.1);
    assert_eq!(own.mean_time.unwrap().half_width(), 0.0);
    assert_eq!(own.fatal.as_ref().unwrap().size, 0.5);
    assert!((own.harmless.as_ref().unwrap().size - 0.39).abs() < 1e-12);
    assert!(all.of(Label::from(3)).is_none() && all.counts().inside() == 80);
    assert!(matches!(own.fatal_share(-1.0), Err(Error::NothingInside { .. })));
    // The undecided starts were followed for 7 steps: in 7 they have come to none.
    assert_eq!(
        (own.fraction_within(6).unwrap().value, own.fraction_within(7).unwrap().value),
        (0.0, 0.5)
    );
    assert!(own.fraction_within(8).unwrap().upper > own.fraction_within(7).unwrap().upper);
    assert!(
        own.time_quantile(0.5).unwrap().half_width() == 0.0 && own.time_quantile(0.01).is_err()
    );
    assert!(own.time_quantile(1.0).is_err() && own.time_quantile(f64::NAN).is_err());
    // By other distances, and refused ones.
    let twice = Metric::by(|a, b| 2.0 * (a[0] - b[0]).abs());
    let all = Stability::with_distance(&attractors, &starts, &found, twice).unwrap();
    assert_eq!(all.of(Label::from(1)).unwrap().fatal.as_ref().unwrap().size, 1.0);
    assert!(Stability::new(&attractors, &starts, &found[1..]).is_err());
    let plane = [(Label::from(1), vec![vec![0.0, 0.0]])].into();
    assert!(Stability::new(&plane, &starts, &found).is_err());
    let none = vec![(Label::OUTSIDE, 0); 100];
    assert!(matches!(
        Stability::new(&attractors, &starts, &none),
        Err(Error::NothingInside { .. })
    ));
}
