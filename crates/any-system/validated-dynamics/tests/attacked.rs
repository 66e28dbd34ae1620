//! What a review made false, by name.

use crate::models::{map_of, oscillator};
use equations::{Formulas, Names};
use hybrid_system::Equations;
use nalgebra::DMatrix;
use validated_dynamics::{
    Division, EnclosedMap, Enclosure, Error, FormulaMap, Matrix, ProvedBasins, ProvedFate, Reason,
    SectionMap, Trap, ValidatedSystem, fixed_point, halves, multipliers,
};

fn reason(error: &Error) -> Reason {
    error.undecided().unwrap_or_else(|| panic!("{error}")).reason.clone()
}

#[test]
fn no_step_goes_back_behind_its_start_to_reach_a_time() {
    // The event is at times from 0.5 to 1, and the rate after it is −100.
    let system = Equations::new(&["x"], &[])
        .mode_text("A", &["1"])
        .rising_text("one", "x - 1")
        .resets_text(&["1"])
        .to("B")
        .mode_text("B", &["-100*x"]);
    let system = ValidatedSystem::new(&system).unwrap();
    let start = |high: f64| system.start_box("A", &[Enclosure::new(0.0, high)]).unwrap();
    let error = start(0.5).advance(Enclosure::from(2.0)).unwrap_err();
    assert!(matches!(reason(&error), Reason::Times { .. }), "{error}");
    let mut run = start(1e-4);
    run.advance(Enclosure::from(1.5)).unwrap();
    for x in [0.0, 1e-4] {
        assert!(run.set().hull()[0].contains(interval_arithmetic::exp(-100.0 * (1.5 - (1.0 - x)))));
    }
}

#[test]
fn states_apart_in_time_have_no_derivatives_at_one_time() {
    let system = Equations::new(&["x"], &[])
        .mode_text("flow", &["1"])
        .rising_text("one", "x - 1")
        .resets_text(&["0"]);
    let system = ValidatedSystem::new(&system).unwrap();
    let mut run = system.start_box("flow", &[Enclosure::new(0.4, 0.6)]).unwrap();
    run.advance(Enclosure::from(1.2)).unwrap();
    assert!(run.set().hull()[0].contains(0.6) && run.set().hull()[0].contains(0.8));
    assert!(run.derivatives().is_none());
}

#[test]
fn discs_that_meet_have_no_real_eigenvalue_for_certain() {
    let around = |x: f64, r: f64| Enclosure::new(x - r, x + r);
    let turns = Matrix::from_fn(2, 2, |row, column| match (row, column) {
        (0, 0) => Enclosure::from(0.5),
        (1, 1) => Enclosure::from(0.6),
        _ => around(0.0, 0.2),
    });
    assert!(multipliers(&turns).iter().all(|found| found.real().is_none()));
    let double = Matrix::from_fn(2, 2, |row, column| match row == column {
        true => Enclosure::ONE,
        false => around(0.0, 0.1),
    });
    assert!(multipliers(&double).iter().all(|found| found.real().is_none()));
    // No bound, and no square.
    let nothing = Matrix::from_fn(3, 3, |_, _| Enclosure::WHOLE);
    assert!(multipliers(&nothing).iter().all(|found| found.radius == f64::INFINITY));
    assert!(multipliers(&Matrix::from_fn(2, 3, |_, _| Enclosure::ONE)).is_empty());
}

#[test]
fn a_contact_without_a_jump_bounds_the_flow() {
    let floor = Equations::new(&["h", "v"], &[])
        .mode_text("flow", &["v", "-1"])
        .falling_text("floor", "h")
        .contact();
    let floor = ValidatedSystem::new(&floor).unwrap();
    let mut run = floor.start("flow", &["1", "0"]).unwrap();
    run.next_event().unwrap();
    let error = run.next_event().unwrap_err();
    assert!(matches!(reason(&error), Reason::Beyond { .. }), "{error}");
}

#[test]
fn a_fixed_point_is_in_its_box_also_where_newton_ends_early() {
    let map = map_of(&["x"], &["2.469134e23*x^3 - 3.3333309e8*x^2"]);
    let found = fixed_point(&map, &[9e-16], &[]).unwrap();
    assert!(found.point[0].contains(0.0) && found.unique_in[0].contains(0.0));
}

#[test]
fn the_time_of_a_model_without_time_is_refused() {
    let system = ValidatedSystem::new(&oscillator().rising_text("section", "x")).unwrap();
    let chart = || system.chart("flow", &["v"], &["0", "v"]).unwrap();
    let read = |texts: &[&str]| SectionMap::new(&system, chart(), "section", 1, texts);
    assert!(matches!(read(&["t"]), Err(Error::Argument { .. })));
    assert!(matches!(read(&["a = 2"]), Err(Error::Argument { .. }) | Err(Error::Equations(_))));
    assert!(system.chart("flow", &["v"], &["t", "v"]).is_err());
    let names = Names::new(&["x"], &[]).unwrap();
    assert!(FormulaMap::new(Formulas::from_text(names, &["x + t"]).unwrap(), 1).is_err());
}

#[test]
fn traps_are_those_of_their_map() {
    // The second variable goes away, and is no parameter.
    let map = map_of(&["x", "y"], &["x/2", "2*y"]);
    let one = DMatrix::identity(1, 1);
    let parameters = [Enclosure::new(-1.0, 1.0)];
    assert!(matches!(
        Trap::proved(&map, &[0.0], &one, 0.1, &parameters),
        Err(Error::Argument { .. })
    ));
    let other = map_of(&["x"], &["x/2"]);
    let fixed = fixed_point(&other, &[0.1], &[]).unwrap();
    assert!(Trap::new(&map, &fixed, 10).is_err());
    // A linear map has no largest trap.
    assert!(Trap::new(&other, &fixed, 1_000_000).unwrap().size() > 1e90);
}

#[test]
fn shares_are_bounds_from_below() {
    let map = map_of(&["x"], &["x/2"]);
    let trap = || Trap::new(&map, &fixed_point(&map, &[0.1], &[]).unwrap(), 100).unwrap();
    let division = Division { first: 2, last: 6, images: 1000 };
    for window in [Enclosure::new(-0.3, 0.7), Enclosure::new(-1.0, 1.0)] {
        let basins = ProvedBasins::new(&[&map], vec![trap()], &[&[window]], division).unwrap();
        let share = basins.share(ProvedFate::Trap(0));
        assert!(
            share <= 1.0 && share > 1.0 - 1e-12,
            "{share} {:?} {:?}",
            basins.traps(),
            basins.fate(0, &[0.2])
        );
    }
    let too_many = Division { first: 30, last: 30, images: 1000 };
    assert!(
        ProvedBasins::new(&[&map], vec![trap()], &[&[Enclosure::new(0.0, 1.0)]], too_many).is_err()
    );
}

#[test]
fn boxes_of_many_sides_lose_no_part() {
    let sides = vec![Enclosure::new(0.0, 1.0); 70];
    let parts = halves(&sides);
    assert_eq!(parts.len(), 2);
    assert!(
        parts[0][69].hull(&parts[1][69]) == sides[69] || parts[0][0].hull(&parts[1][0]) == sides[0]
    );
}

#[test]
fn a_chart_without_a_value_is_undecided() {
    let flow =
        Equations::new(&["x"], &[]).mode_text("flow", &["-x"]).falling_text("half", "x - 0.5");
    let system = ValidatedSystem::new(&flow).unwrap();
    let chart = system.chart("flow", &["s"], &["sqrt(s)"]).unwrap();
    let map = SectionMap::new(&system, chart, "half", 1, &["x"]).unwrap();
    let error = map.image(&[Enclosure::new(-1.0, 1.0)]).unwrap_err();
    assert!(matches!(reason(&error), Reason::Domain(_)), "{error}");
}
