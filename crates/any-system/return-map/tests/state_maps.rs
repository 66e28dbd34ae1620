//! Models as maps of states: the same bits one by one and together, sections, ends at surfaces, modes.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use basin_of_attraction::{
    Attractors, FeatureAttractors, FeatureLimits, Hyperrectangle, Interval, KnownAttractors,
    KnownLimits, Label, RecurrenceLimits, SplitMix64, StateGrid, StateMap,
};
use equations::{Formulas, Names};
use hybrid_system::{Equations, State};
use return_map::{
    EquationReturns, ExecutionSteps, FamilySteps, FlowSteps, FormulaMap, FormulaSteps, OrbitEnd,
    lyapunov_exponents,
};

fn formulas(text: &[&str]) -> Formulas {
    Formulas::from_text(Names::new(&["x", "v"], &[("c", "0.3")]).unwrap(), text).unwrap()
}

/// Random states, and some without an image.
fn states(count: u64) -> Vec<[f64; 2]> {
    let random = SplitMix64::from_seed(9);
    let some = (0..count).map(|k| [0, 1].map(|i| 4.0 * random.uniform(2 * k + i) - 2.0));
    some.chain([[f64::NAN, 0.0], [1e300, 1e300], [f64::INFINITY, 1.0], [-0.0, 0.0]]).collect()
}

fn compare(map: &dyn StateMap, count: u64) {
    let all = states(count);
    let mut columns: Vec<Vec<f64>> =
        (0..2).map(|k| all.iter().map(|state| state[k]).collect()).collect();
    let mut has_image = vec![false; all.len()];
    map.images(&mut columns, &mut has_image);
    let mut image = [0.0; 2];
    for (k, state) in all.iter().enumerate() {
        assert_eq!(map.image(state, &mut image), has_image[k], "{state:?}");
        if has_image[k] {
            let together = [columns[0][k], columns[1][k]].map(f64::to_bits);
            assert_eq!(image.map(f64::to_bits), together, "{state:?}");
        }
    }
    assert!(has_image.iter().any(|has| *has) && has_image.iter().any(|has| !*has));
}

#[test]
fn states_together_have_the_bits_of_single_ones() {
    compare(&FormulaSteps::new(&formulas(&["1 - x^2 + c*v", "sqrt(x + 1) - v"])).unwrap(), 301);
    let field = formulas(&["v", "-sin(x) - c*v + cos(t)"]);
    compare(&FlowSteps::new(&field, (0.0, 1.5), 1e-9).unwrap(), 61);
    assert!(
        FormulaSteps::new(&field).is_err()
            && FlowSteps::new(&field, (0.0, f64::NAN), 1e-9).is_err()
    );
}

/// Many steps are the steps one by one, and end together at the first state without an image.
#[test]
fn many_steps_at_once_have_the_bits_of_single_ones() {
    let map = FormulaSteps::new(&formulas(&["1 - 1.4*x^2 + v", "c*x"])).unwrap();
    let advanced = |starts: &[[f64; 2]], steps: usize| {
        let mut columns = [0, 1].map(|k| starts.iter().map(|at| at[k]).collect::<Vec<_>>());
        let mut has_image = vec![true; starts.len()];
        let made = map.advance(&mut columns, &mut has_image, steps);
        (columns, has_image, made)
    };
    let alone = |start: [f64; 2], steps: usize| {
        let (mut at, mut image) = (start, [0.0; 2]);
        for _ in 0..steps {
            assert!(map.image(&at, &mut image));
            at = image;
        }
        at.map(f64::to_bits)
    };
    let inside: Vec<[f64; 2]> = (0..19).map(|k| [0.03 * f64::from(k) - 0.3, 0.1]).collect();
    for steps in [1, 2, 700] {
        let (columns, has_image, made) = advanced(&inside, steps);
        assert!(made == steps && has_image.iter().all(|has| *has));
        for (k, start) in inside.iter().enumerate() {
            let own = [columns[0][k], columns[1][k]].map(f64::to_bits);
            assert_eq!(own, alone(*start, steps), "{start:?} {steps}");
        }
    }
    // 2 → −4.6 → … has no image in the end: each square is that of the one before.
    let with_escape = [&inside[..9], &[[2.0, 0.0]], &inside[9..]].concat();
    let (columns, has_image, made) = advanced(&with_escape, 700);
    assert!((5..30).contains(&made) && has_image.iter().filter(|has| !**has).count() == 1);
    assert!(!has_image[9]);
    let first = [columns[0][0], columns[1][0]].map(f64::to_bits);
    assert_eq!(first, alone(inside[0], made));
    // 1/x of an infinite number is 0 again: the step is not forgotten.
    let map = FormulaSteps::new(&formulas(&["1/(1/x)", "v"])).unwrap();
    let (mut columns, mut has_image) = ([vec![0.0], vec![0.0]], [true]);
    assert_eq!((map.advance(&mut columns, &mut has_image, 9), has_image), (1, [false]));
}

/// A map by formulas, at the values of its parameters and as a family, has the same attractors, and their exponents are those of the map.
#[test]
fn formulas_and_families_have_the_same_attractors() {
    let names = Names::new(&["x"], &[("r", "3.9")]).unwrap();
    let logistic = Formulas::from_text(names, &["r*x*(1 - x)"]).unwrap();
    let family = FormulaMap::new(&logistic, "r").unwrap();
    let unit: Hyperrectangle = Interval::new(0.0, 1.0).unwrap().try_into().unwrap();
    let found = |map: &dyn StateMap| {
        let grid = StateGrid::uniform(unit.clone(), 100).unwrap();
        Attractors::search(map, grid, &[vec![0.3]], RecurrenceLimits::default()).unwrap()
    };
    let one = found(&FormulaSteps::new(&logistic).unwrap());
    let other = found(&FamilySteps::new(&family, 3.9));
    assert_eq!((one.attractors().len(), one.attractors()[0].period), (1, None));
    assert_eq!(other.attractors().len(), 1);
    let start = &one.attractors()[0].points[0];
    let exponent = lyapunov_exponents(&family, (start, 3.9), 100, 20_000).unwrap().per_image[0];
    assert!(0.4 < exponent.lower && exponent.upper < 0.6, "{exponent:?}");
}

/// A runner on a spring leg, from apex to apex: one stable run; lower apexes stumble, and have no label.
#[test]
fn a_section_with_ends_at_surfaces_is_labelled() {
    let leg = example_systems::spring_leg::spring_leg();
    let apexes = EquationReturns::new(&leg, "attack", ("flight", "apex"), &["h"])
        .and_then(|own| own.starting_text(&["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"]))
        .and_then(|own| own.coordinates_text(&["height"]))
        .unwrap();
    let map = FamilySteps::new(&apexes, 68.0);
    let heights: Hyperrectangle = Interval::new(0.9, 1.1).unwrap().try_into().unwrap();
    let limits = RecurrenceLimits { locate: 10, tests: 50, ..RecurrenceLimits::default() };
    let grid = StateGrid::uniform(heights, 50).unwrap();
    let found = Attractors::search(&map, grid, &[vec![0.945], vec![0.91]], limits).unwrap();
    assert_eq!(found.attractors().len(), 1);
    // 80 kg, 1 m, 20 kN/m, 5 m/s, 68°.
    assert!((found.attractors()[0].points[0][0] - 0.940_267).abs() < 1e-6);
    assert_eq!(found.label(&map, &[0.945]), Label::from(1));
    // Below the height of touchdown the leg cannot be put down.
    assert_eq!(found.label(&map, &[0.91]), Label::UNDECIDED_MAP);
}

/// A forced oscillator at a stop, whose hits change the mode and nothing else: the mode is the last coordinate, and cells of the two others are enough.
#[test]
fn the_mode_of_a_state_is_its_last_coordinate() {
    let field = ["v", "-x - v/10 + cos(3*t)"];
    let oscillator = Equations::new(&["x", "v"], &[("kept", "0.8")])
        .mode_text("even", &field)
        .rising_text("stop", "x - 1/10")
        .resets_text(&["1/10", "-kept*v"])
        .to("odd")
        .mode_text("odd", &field)
        .rising_text("stop again", "x - 1/10")
        .resets_text(&["1/10", "-kept*v"])
        .to("even")
        .model::<State<3>>()
        .unwrap();
    let modes = ["even", "odd"].map(|name| hybrid_system::Label::new(name).unwrap());
    let period = std::f64::consts::TAU / 3.0;
    let steps = ExecutionSteps::new(2, &modes, |mode, x| {
        oscillator.start(mode.as_str(), [x[0], x[1]], period)
    });
    assert_eq!(steps.dimension(), Some(3));
    let side = |left, right| Interval::new(left, right).unwrap();
    let square = Hyperrectangle::new(vec![side(-2.0, 0.2), side(-2.0, 2.0)]).unwrap();
    let grid = StateGrid::uniform(square, 100).unwrap().of_coordinates(&[0, 1], 3).unwrap();
    let limits = RecurrenceLimits { locate: 20, tests: 50, ..RecurrenceLimits::default() };
    let starts = [vec![0.0, 0.0, 0.0], vec![0.0, 0.0, 1.0]];
    let found = Attractors::search(&steps, grid, &starts, limits).unwrap();
    assert_eq!((found.attractors().len(), found.unmatched().len()), (1, 0));
    let mut image = [0.0; 3];
    for (mode, others) in [(0.0, [0.0, 1.0]), (1.0, [0.0, 1.0])] {
        assert!(steps.image(&[0.0, 0.0, mode], &mut image) && others.contains(&image[2]));
        assert_eq!(found.label(&steps, &[0.0, 0.0, mode]), Label::from(1));
    }
    // There is no third mode.
    assert_eq!(found.label(&steps, &[0.0, 0.0, 2.0]), Label::UNDECIDED_MAP);
}

/// A particle that is pushed away from 0 on both sides, with a surface that ends the run on each, beside a well: each surface has its label, in all
/// ways to ask.
#[test]
fn each_surface_that_ends_a_run_has_its_label() {
    let wells = Equations::new(&["x", "v"], &[])
        .mode_text("moves", &["v", "-x + x^3 - v"])
        .rising_text("right", "x - 2")
        .stops()
        .falling_text("left", "x + 2")
        .stops()
        .model::<State<2>>()
        .unwrap();
    let modes = [hybrid_system::Label::new("moves").unwrap()];
    let (left, right) = (Label::numbered::<65_001>(), Label::numbered::<65_002>());
    let steps = ExecutionSteps::new(2, &modes, |_, x| wells.start("moves", [x[0], x[1]], 0.5))
        .label_ends(|end| match end {
            OrbitEnd::Terminal(surface) if surface == "left" => Label::numbered::<65_001>(),
            OrbitEnd::Terminal(_) => Label::numbered::<65_002>(),
            _ => Label::UNDECIDED_MAP,
        });
    let square = Hyperrectangle::new(vec![Interval::new(-2.0, 2.0).unwrap(); 2]).unwrap();
    let grid = StateGrid::uniform(square, 20).unwrap();
    let limits = RecurrenceLimits { locate: 20, tests: 20, ..RecurrenceLimits::default() };
    let found = Attractors::search(&steps, grid, &[vec![0.5, 0.0]], limits).unwrap();
    let start = |k: usize| [0.2 * (k % 20) as f64 - 1.9, 0.2 * (k / 20) as f64 - 1.9];
    let write = |k: usize, at: &mut [f64]| at.copy_from_slice(&start(k));
    let all = found.convergences(&steps, 400, write).unwrap();
    let limits = KnownLimits { stretch: 20, tests: 20, ..KnownLimits::default() };
    let points = [(Label::from(7), vec![vec![0.0, 0.0]])].into();
    let known = KnownAttractors::new(&steps, &points, 0.1, limits).unwrap();
    let others = known.convergences(&steps, 400, write).unwrap();
    for k in 0..400 {
        // By symmetry.
        let mirrored = match all[399 - k].0 {
            own if own == left => right,
            own if own == right => left,
            own => own,
        };
        assert_eq!((all[k].0, all[k]), (mirrored, found.convergence(&steps, &start(k)).unwrap()));
        let own = if all[k].0 == Label::from(1) { Label::from(7) } else { all[k].0 };
        assert_eq!(others[k].0, own);
    }
    let count = |label| all.iter().filter(|own| own.0 == label).count();
    assert_eq!(count(left), count(right));
    assert_eq!(count(left) + count(right) + count(Label::from(1)), 400);
    assert!(count(left) > 20 && count(Label::from(1)) > 80);
    // Unless the caller says otherwise, they have escaped.
    let steps = ExecutionSteps::new(2, &modes, |_, x| wells.start("moves", [x[0], x[1]], 0.5));
    assert_eq!(found.label(&steps, &start(399)), Label::ESCAPED);
    let feature = |points: &[Vec<f64>]| vec![points[0][0]];
    let features =
        FeatureLimits { transient: 50, stretch: 5, tests: 20, ..FeatureLimits::new(0.2, 0.1) };
    let starts = [vec![0.5, 0.0], vec![0.0, 0.0], vec![-0.1, 0.1]];
    let grouped = FeatureAttractors::search(&steps, &feature, &starts, features).unwrap();
    assert_eq!(grouped.label(&steps, &feature, &start(399)), Label::ESCAPED);
}
