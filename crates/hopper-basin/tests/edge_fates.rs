//! Fates within 10⁻⁸ to some ulps of edges of basins, against orbits of 60 and more digits.
//!
//! The reference follows every hop. Here the slow hops left of the fixed points are jumped over.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use basin_of_attraction::Label;
use hopper_basin::{Fates, HopperFate};
use hopper_reference::{Row, rows};
use passive_hopper::MassRatio;
use std::cell::Cell;

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

/// None is undecided. The count of hops is that of the reference. Only an orbit that enters a trap within an ulp of the end
/// opposite to α*_n is known one hop later, at the other end.
#[test]
fn fates_and_counts_of_hops_beside_edges_are_those_of_the_reference() {
    let later = Cell::new(0);
    let compared = at_each_mass_ratio(|fates, group| {
        for row in group {
            let (fate, hops) = fates.fate_within(row.input("alpha"), BUDGET).unwrap();
            assert_eq!(fate, expected(row), "{row}");
            let more = hops as u64 - row.integer("hops");
            assert!(more == 0 || more == 1 && row.text("fate") == "incessant", "{hops}: {row}");
            later.set(later.get() + more);
        }
    });
    assert_eq!(compared, 549);
    // The two starts within two ulps of an edge on its right side.
    assert_eq!(later.get(), 2);
}

#[test]
fn labels_beside_edges_are_those_of_the_reference() {
    at_each_mass_ratio(|fates, group| {
        let speeds: Vec<f64> = group.iter().map(|row| row.input("alpha")).collect();
        let expected: Vec<Label> = group.iter().map(|row| expected(row).label()).collect();
        assert_eq!(fates.labels(&speeds).unwrap(), expected);
    });
}
