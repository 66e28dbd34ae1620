//! Fates within 10⁻⁸ to some ulps of edges of basins, against orbits of 60 and more digits.
//!
//! The reference follows every hop. Here the slow hops left of the fixed points are jumped over.

use basin_of_attraction::Label;
use hopper_basin::{Fates, HopperFate, TrapSide};
use hopper_reference::{Row, rows};
use passive_hopper::{Arithmetic, ExtendedOrbit, ExtendedStep, LiftOffMap, MassRatio, index_below};

/// No orbit of the reference has as many hops.
const BUDGET: usize = 20_000;

fn expected(row: &Row) -> HopperFate {
    match row.text("fate") {
        "incessant" => HopperFate::Incessant { n: row.integer("n") },
        "decaying" => HopperFate::Decaying,
        "grounded" => HopperFate::Grounded,
        other => panic!("{other}"),
    }
}

/// The rows of one mass ratio after the other, with the fates there.
fn at_each_mass_ratio(check: impl Fn(&Fates, &[Row])) -> usize {
    let all: Vec<Row> = rows(include_str!("data/edge_fates.jsonl")).collect();
    let ratio = |row: &Row| row.input("mass_ratio");
    for group in all.chunk_by(|a, b| ratio(a) == ratio(b)) {
        check(&Fates::new(MassRatio::new(ratio(&group[0])).unwrap()).unwrap(), group);
    }
    all.len()
}

/// None is undecided. The count of hops is that of the reference, also of orbits that enter a trap within an ulp of
/// its end.
#[test]
fn fates_and_counts_of_hops_beside_edges_are_those_of_the_reference() {
    let compared = at_each_mass_ratio(|fates, group| {
        for row in group {
            let (fate, hops) = fates.fate_within(row.input("alpha"), BUDGET).unwrap();
            assert_eq!(fate, expected(row), "{row}");
            assert_eq!(hops as u64, row.integer("hops"), "{row}");
        }
    });
    assert_eq!(compared, 549);
}

#[test]
fn labels_beside_edges_are_those_of_the_reference() {
    at_each_mass_ratio(|fates, group| {
        let speeds: Vec<f64> = group.iter().map(|row| row.input("alpha")).collect();
        let expected: Vec<Label> = group.iter().map(|row| expected(row).label()).collect();
        assert_eq!(fates.labels(&speeds).unwrap(), expected);
    });
}

/// Orbits that leave α*_5 in more than 512 hops and then pass by α*_4, α*_3 and α*_2, each of which multiplies
/// their error: after a jump over the slow hops it would be too large. Here the orbit in 512 bits is followed hop
/// by hop.
#[test]
fn orbits_beside_several_fixed_points_are_followed_hop_by_hop() {
    for (m, alpha) in [(20.0, 17.220_755_271_922_03), (10.0, 17.220_755_271_928_866)] {
        let ratio = MassRatio::new(m).unwrap();
        let (fates, map) = (Fates::new(ratio).unwrap(), LiftOffMap::new(ratio));
        let mut orbit = ExtendedOrbit::new(&map, alpha, Arithmetic::Bits512).unwrap();
        let expected = loop {
            let speed = orbit.speed();
            let trap = fates.trap(index_below(speed).unwrap()).unwrap();
            let (offset, error) = orbit.offset_from(trap.n);
            if trap.side_of_offset(offset, error) == TrapSide::Inside {
                break HopperFate::label_of_fixed_point(trap.n);
            }
            match orbit.hop().unwrap() {
                ExtendedStep::LiftsOff => {}
                ExtendedStep::Grounded => break HopperFate::GROUNDED,
                ExtendedStep::Inconclusive => panic!("M = {m}, α = {alpha}: {speed}"),
            }
        };
        assert_eq!(fates.fate(alpha).unwrap().label(), expected, "M = {m}, α = {alpha}");
    }
}
