//! Enclosed hops hold the reference values, in 40 digits, and are some ulps wide.

#![allow(clippy::unwrap_used)] // a test that lacks a value must fail

use hopper_reference::{Row, map, rows};
use passive_hopper::{Enclosed, EnclosedHop, HopperState, contact_flow};
use proptest::prelude::*;

const FILES: [&str; 4] = [
    include_str!("data/hops_random.jsonl"),
    include_str!("data/hops_window.jsonl"),
    include_str!("data/hops_boundaries.jsonl"),
    include_str!("data/hops_extreme.jsonl"),
];

/// Hops with hundreds of flights take seconds in 1024 bits, and of 380 flights on these are too few.
const MOST_SUDDEN: u64 = 64;

/// The half ulp by which a reference was rounded to `f64`, and that of 17 digits of a slope.
fn rounding(exact: f64) -> f64 {
    1.01 * f64::EPSILON * exact.abs()
}

/// Whether the enclosure holds the exact number, given to half an ulp.
fn holds(found: Enclosed, exact: f64) -> bool {
    found.error_of(exact) <= 2.0 * found.error + rounding(exact)
        && (found.value - exact).abs() <= found.error + rounding(exact)
}

fn check(row: &Row, hop: &EnclosedHop) {
    let pairs = [
        (hop.next, "alpha_next"),
        (hop.by_speed, "dalpha_next_dalpha"),
        (hop.by_mass_ratio, "dalpha_next_dM"),
    ];
    for (found, key) in pairs {
        let (Some(found), Some(exact)) = (found, row.result(key)) else { continue };
        assert!(holds(found, exact), "{key}: {found:?} {row}");
    }
    let times: Vec<f64> =
        row.list("flight_times").iter().map(|text| text.parse().unwrap()).collect();
    let stretches = row.list("stretch_at_impact");
    // The files have the first 32 landings.
    assert_eq!(hop.landings.len() as u64, 1 + row.integer("sudden"), "{row}");
    assert_eq!(hop.landings.len().min(32), times.len(), "{row}");
    for ((landing, time), stretch) in hop.landings.iter().zip(&times).zip(stretches) {
        assert!(holds(landing.time, *time), "{landing:?} {row}");
        // The stretch is the excess and 1, whose sum was rounded in its 40 digits.
        let off = landing.excess.value - (stretch.parse::<f64>().unwrap() - 1.0);
        assert!(
            off.abs() <= landing.excess.error + f64::EPSILON * (1.0 + landing.excess.value.abs()),
            "{landing:?} {row}"
        );
    }
    if times.len() == hop.landings.len() {
        let sum = times.iter().sum::<f64>();
        assert!((hop.flight_time.value - sum).abs() <= 1e-14 * sum, "{row}");
    }
}

#[test]
fn enclosures_hold_the_references_and_are_narrow() {
    let (mut hops, mut sharp) = (0, 0);
    for row in FILES.into_iter().flat_map(rows) {
        if row.integer("sudden") > MOST_SUDDEN {
            continue;
        }
        let hop = row.map().enclosed_hop(row.input("alpha"), 0.0).unwrap();
        check(&row, &hop);
        hops += 1;
        let numbers = [hop.next, hop.loss, hop.contact_time, hop.by_speed, hop.by_mass_ratio];
        let narrow = |number: Enclosed| number.error <= f64::EPSILON * number.value.abs();
        sharp += usize::from(numbers.into_iter().flatten().all(narrow));
    }
    assert!(hops > 3100 && sharp == hops, "{sharp} of {hops}");
}

/// Every number of a hop.
fn numbers(hop: &EnclosedHop) -> Vec<Option<Enclosed>> {
    let mut all = vec![
        hop.next,
        hop.loss,
        Some(hop.energy_loss),
        Some(hop.flight_time),
        hop.contact_time,
        hop.by_speed,
        hop.by_mass_ratio,
    ];
    for landing in &hop.landings {
        let own = [landing.time, landing.closing_speed, landing.excess, landing.velocity];
        all.extend(own.into_iter().chain([landing.energy_loss]).map(Some));
    }
    all
}

proptest! {
    /// What holds for all speeds of an interval holds for each of them.
    #[test]
    fn hops_from_an_interval_hold_those_from_its_speeds(
        alpha in 0.5..40f64, m in -2.0..1.5f64, error in -13.0..-6f64, part in -1.0..1f64
    ) {
        let (map, error) = (map(pxfm::f_exp10(m)), pxfm::f_exp10(error));
        let inside = alpha + part * error;
        prop_assume!((inside - alpha).abs() <= error);
        let Ok(wide) = map.enclosed_hop(alpha, error) else { return Ok(()) };
        let narrow = map.enclosed_hop(inside, 0.0).unwrap();
        for (wide, narrow) in numbers(&wide).into_iter().zip(numbers(&narrow)) {
            let (Some(wide), Some(narrow)) = (wide, narrow) else { continue };
            let apart = (wide.value - narrow.value).abs();
            prop_assert!(apart <= wide.error + narrow.error + 4.0 * f64::EPSILON * narrow.value.abs(), "{wide:?} {narrow:?}");
        }
    }

    /// After the contact's time the stretch is 1 again.
    #[test]
    fn contact_lasts_until_the_next_lift_off(alpha in 0.5..40f64, m in -2.0..1.5f64) {
        let map = map(pxfm::f_exp10(m));
        let hop = map.enclosed_hop(alpha, 0.0).unwrap();
        let Some(time) = hop.contact_time else { return Ok(()) };
        let last = hop.landings.last().unwrap();
        let start = HopperState {
            upper_position: 1.0 + last.excess.value,
            upper_velocity: last.velocity.value,
            lower_position: 0.0,
            lower_velocity: 0.0,
        };
        let end = contact_flow(map.mass_ratio(), &start, time.value);
        // The flow's own rounding.
        prop_assert!((end.upper_position - 1.0).abs() < 1e-12 * (1.0 + alpha) * (1.0 + alpha), "{end:?}");
        prop_assert!(time.error <= f64::EPSILON * time.value);
    }
}

/// Where a decision is not certain within the error of the start, there is no answer.
#[test]
fn an_interval_across_a_change_of_flights_is_undecided() {
    let boundary = 2.0 * std::f64::consts::PI;
    assert!(map(0.2).enclosed_hop(boundary, 1e-9).is_err());
    assert!(map(0.2).enclosed_hop(boundary, 0.0).is_ok());
}

/// Speeds and mass ratios at both ends of the exponents end at once, with an enclosure or without.
#[test]
fn extreme_hops_end() {
    for alpha in [5e-324, 1e-300, 1e-160, 1e-30, 8e12] {
        for m in [1e-307, 1e-150, 0.2, 1e12, 1e300] {
            let found = map(m).enclosed_hop(alpha, 0.0);
            let Ok(Some(next)) = found.map(|hop| hop.next) else { continue };
            assert!(
                !next.error.is_nan() && (next.value - alpha).abs() <= alpha,
                "{alpha} {m} {next:?}"
            );
        }
    }
}
