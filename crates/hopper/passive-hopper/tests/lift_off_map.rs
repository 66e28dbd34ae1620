//! The lift-off map against references of 40 digits, and its identities.

#![allow(clippy::excessive_precision)] // published digits, as they are printed

use hopper_reference::{UNITS_PER_FLIGHT, map, rows};
use passive_hopper::{Error, FixedPointSpeed, LiftOffMap, MassRatio, alpha_star, printed_image};
use proptest::prelude::*;
use std::f64::consts::PI;

/// Compares every hop of a reference file: its decisions are right, and the error of its α′ is within
/// [`UNITS_PER_FLIGHT`] a flight.
fn check_hops(text: &str) {
    for row in rows(text) {
        let sudden = row.integer("sudden") as usize;
        let hop = row.map().hop(row.input("alpha")).unwrap();
        assert_eq!(hop.sudden, sudden, "{row}");
        assert_eq!(hop.next.is_none(), row.is_grounded("alpha_next"), "{row}");
        let Some(next) = hop.next else { continue };
        let units = row.error_in_units(next);
        assert!(units <= UNITS_PER_FLIGHT * (1 + sudden) as f64, "{row}: {units} units");
    }
}

#[test]
fn random_hops_are_right_to_four_units_a_flight() {
    check_hops(include_str!("data/hops_random.jsonl"));
}

#[test]
fn hops_of_the_papers_window_are_right_to_four_units_a_flight() {
    check_hops(include_str!("data/hops_window.jsonl"));
}

#[test]
fn hops_next_to_branch_changes_are_right_to_four_units_a_flight() {
    check_hops(include_str!("data/hops_boundaries.jsonl"));
}

#[test]
fn extreme_hops_are_right_to_four_units_a_flight() {
    check_hops(include_str!("data/hops_extreme.jsonl"));
}

/// Hops whose decisions were wrong with earlier error bounds: flights that seem to touch a maximum in 53 bits, chains
/// at speeds of 10¹², seven thousand sudden lift-offs.
#[test]
fn hard_decisions_are_right() {
    check_hops(include_str!("data/hops_hard_verdicts.jsonl"));
}

/// Speeds just above nπ, where x′ of a landing is as small as the rounding of V. These hops once gave 37.461 and
/// 54.61. The values have 60 and 100 equal digits in the generator of the references.
#[test]
fn small_stretches_after_a_landing_do_not_change_the_branch() {
    for (m, alpha, sudden, next) in [
        (5.698_491_118_684_765, 53.407_075_111_026_49, 1, 26.489_000_894_171_255_258_81),
        (3.993_312_777_579_258_3, 91.106_186_954_104, 3, 30.452_309_399_070_653_163_66),
    ] {
        let map = map(m);
        let bounded = map.bounded_hop(alpha).unwrap();
        assert_eq!(map.hop(alpha).unwrap(), bounded.hop, "M = {m}");
        assert_eq!(map.landings(alpha).unwrap().len(), sudden + 1, "M = {m}");
        assert_eq!(bounded.hop.sudden, sudden, "M = {m}");
        let (found, error) = (bounded.hop.next.unwrap(), bounded.next_error.unwrap());
        // Half an ulp for the literal.
        assert!((found - next).abs() <= error + 0.5 * f64::EPSILON * next, "M = {m}: {found}");
        assert!(error < 1e-6, "M = {m}: {error:e}");
    }
}

/// Decisions for which 53 bits do not suffice: α is one rounding away from a change of branch.
#[test]
fn decisions_within_one_rounding_of_a_change_of_branch_are_right() {
    // At M = 1 and α = nπ, α′² is zero. The f64 nearest to π lies 1.2e-16 below π.
    let grounded = map(1.0).hop(PI).unwrap();
    assert!(grounded.next.is_none());
    assert!((grounded.next_speed_squared / -7.694_682_774_887_158_7e-16 - 1.0).abs() < 1e-12);
    let above = map(1.0).hop(PI.next_up()).unwrap();
    assert!(above.next.is_some() && above.sudden == 1);
    // (α, M, sudden, f(α)): hard inputs, computed with 34 digits.
    for (alpha, m, sudden, next) in [
        (3.716_961_483_351, 1000.0, 101, 3.129_085_673_911_574_5),
        (7.071_9, 10.0, 8, 3.423_442_876_072_048),
        (1e6 + 0.3, 0.3, 0, 539_552.774_790_500_0),
        (1000.5, 0.3, 1, 891.484_708_433_808_2),
    ] {
        let hop = map(m).hop(alpha).unwrap();
        assert_eq!(hop.sudden, sudden, "{alpha}");
        assert!((hop.next.unwrap() - next).abs() < 1e-9 * next, "{alpha}: {hop:?}");
    }
}

#[test]
fn the_loss_of_tiny_hops_keeps_its_digits() {
    for row in rows(include_str!("data/losses_tiny.jsonl")) {
        let hop = row.map().hop(row.input("alpha")).unwrap();
        let error = (hop.loss.unwrap() / row.result("loss").unwrap() - 1.0).abs();
        // The loss is proportional to μα⁵: the roundings of α, of M and of the loss itself, half an ulp each, make 3.5
        // ulps.
        assert!(error <= 4.0 * 3.5 * f64::EPSILON, "{row}: {error:e}");
    }
    for alpha in [1e-20f64, 1e-60] {
        let leading = 32.0 / 9.0 * MassRatio::new(0.7).unwrap().mu() * alpha.powi(5);
        let error = map(0.7).hop(alpha).unwrap().loss.unwrap() / leading - 1.0;
        assert!(error.abs() < 1e-14, "{alpha}: {error}");
    }
}

#[test]
fn every_fixed_point_is_kept() {
    for n in (1..200).chain([1000, 100_000]) {
        for m in [1e-3, 0.2, 1.0, 7.0] {
            let star = alpha_star(n);
            let image = map(m).image(star).unwrap().unwrap();
            // The nearest f64 differs from α*_n by δ, at most half an ulp. The loss is λ δ^{4/3} on the right and ten
            // times as large on the left, with λ < 3.5 μ α.
            let delta = 0.5 * f64::EPSILON * star;
            let lambda = 3.5 * MassRatio::new(m).unwrap().mu() * star;
            let allowed = delta + 10.0 * lambda * delta.powf(4.0 / 3.0) + f64::EPSILON * star;
            assert!((image - star).abs() <= allowed, "n = {n}, M = {m}: {image}");
        }
    }
}

#[test]
fn the_first_flight_time_is_continuous_across_fixed_points() {
    for n in 1..50 {
        let star = alpha_star(n);
        let time = |alpha| map(1.0).landings(alpha).unwrap()[0].time;
        let (below, above) = (time(star - 1e-9), time(star + 1e-9));
        // t ≈ β δ^{1/3} on either side.
        let step = 2.0 * 2.3 * 1e-3;
        assert!(below < 2.0 * star && above > 2.0 * star && above - below < 1.1 * step, "{n}");
    }
}

#[test]
fn bad_speeds_are_errors_with_the_value() {
    for alpha in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(matches!(map(1.0).image(alpha), Err(Error::LiftOffSpeed { .. })), "{alpha}");
    }
    let error = map(1.0).image(1e300).unwrap_err();
    assert!(matches!(error, Error::LiftOffSpeedTooLarge { value, .. } if value == 1e300));
    assert!(map(1.0).image(f64::MIN_POSITIVE / 8.0).unwrap().is_some());
}

/// Thousands of sudden lift-offs in one hop: their number is bounded (docs/theory.md, Theorem 18). Beyond the budget
/// the hop is an error with the last state on the ground.
#[test]
fn hops_at_huge_mass_ratios_end() {
    for (m, alpha) in [(1e4, 3.6), (1e5, 3.6), (1e6, 3.2)] {
        let hop = map(m).hop(alpha).unwrap();
        let (root, star) = (alpha * m.sqrt(), alpha_star(1));
        let bound = (root + (root * root + 8.0 * alpha * star).sqrt()) / (2.0 * star);
        assert!(hop.sudden > 500, "{m}: {hop:?}");
        assert!((hop.sudden as f64) <= bound * bound, "{m}: {}", hop.sudden);
    }
    for (m, alpha) in [(1e12, 3.5), (1e300, 3.5)] {
        let error = map(m).hop(alpha).unwrap_err();
        let Error::SuddenLiftOffBudget { sudden, excess, velocity } = error else {
            panic!("{error}")
        };
        assert_eq!(sudden, passive_hopper::SUDDEN_LIFT_OFF_BUDGET);
        assert!(excess > 0.0 && excess < 2.0 * alpha && velocity.abs() < 2.0 * alpha);
    }
}

/// Within ulps of nπ, x′ of the first landing rounds to zero. For M > 1 a long flight follows a sudden landing there.
#[test]
fn the_landings_next_to_n_pi_are_those_of_the_hop() {
    let mut long = 0;
    for n in 1..20u32 {
        for ulps in -5..=5i64 {
            for m in [0.5, 1.5, 3.0, 10.0] {
                let alpha = f64::from_bits((f64::from(n) * PI).to_bits().wrapping_add_signed(ulps));
                let (hop, landings) = (map(m).hop(alpha).unwrap(), map(m).landings(alpha).unwrap());
                assert_eq!(landings.len(), 1 + hop.sudden, "M = {m}, α = {alpha}");
                let (last, others) = landings.split_last().unwrap();
                assert!(!last.sudden && others.iter().all(|landing| landing.sudden));
                let squares: f64 = landings.iter().map(|l| l.closing_speed * l.closing_speed).sum();
                let difference =
                    alpha * alpha - map(m).mass_ratio().mu() * squares - hop.next_speed_squared;
                assert!(difference.abs() < 1e-12 * alpha * alpha, "M = {m}, α = {alpha}: {hop:?}");
                long += usize::from(
                    landings[0].excess.abs() < 1e-14 && hop.sudden > 0 && landings[1].time > 0.1,
                );
            }
        }
    }
    assert!(long > 10, "{long} long flights from x′ near 0");
}

/// Speeds of all sizes, and speeds within a few ulps of a change of branch.
fn degenerate_alpha() -> impl Strategy<Value = f64> {
    let nudge =
        |x: f64, ulps: i32| f64::from_bits(x.to_bits().wrapping_add_signed(i64::from(ulps)));
    prop_oneof![
        3 => 1e-3..60f64,
        1 => (1u64..20, -5..6i32).prop_map(move |(n, ulps)| nudge(n as f64 * PI, ulps)),
        1 => (1u64..20, -5..6i32).prop_map(move |(n, ulps)| nudge(alpha_star(n), ulps)),
        1 => (-300.0..1.0f64).prop_map(|e| 10f64.powf(e)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// f(α; M) = f(α; 1/M) where the first landing is sudden for neither, that is outside [nπ, α*_n).
    #[test]
    fn invariant_under_inversion_on_the_contact_intervals(alpha in degenerate_alpha(), e in -3.0..3.0f64) {
        let ratio = MassRatio::new(10f64.powf(e)).unwrap();
        let (here, there) = (LiftOffMap::new(ratio).hop(alpha).unwrap(), LiftOffMap::new(ratio.inverted()).hop(alpha).unwrap());
        let first = LiftOffMap::new(ratio).landings(alpha).unwrap()[0];
        if !first.sudden {
            // 1/M and both μ are rounded: a few ulps of μ.
            let difference = (here.next_speed_squared - there.next_speed_squared).abs();
            prop_assert!(difference <= 8.0 * f64::EPSILON * alpha * alpha, "{here:?} {there:?}");
        }
    }

    /// The first landing is sudden exactly for α in (nπ, α*_n), n ≥ 1.
    #[test]
    fn sudden_exactly_left_of_the_fixed_points(alpha in degenerate_alpha(), m in 0.01..100f64) {
        let first = map(m).landings(alpha).unwrap()[0];
        let n = (alpha / PI).round() as u64;
        // The f64 nearest to an end is compared, and the sign of its rounding decides a tie.
        let beyond = |end: f64, rest: f64| alpha > end || (alpha == end && rest < 0.0);
        let sin_pi = (n as f64 * PI).sin() * if n.is_multiple_of(2) { -1.0 } else { 1.0 };
        let after_n_pi = n >= 1 && beyond(n as f64 * PI, sin_pi);
        let index = if after_n_pi { n } else { n.saturating_sub(1) };
        let star = FixedPointSpeed::new(index);
        let sudden = index >= 1 && !beyond(star.value(), star.rest());
        prop_assert_eq!(first.sudden, sudden);
    }

    #[test]
    fn hops_never_gain_energy(alpha in degenerate_alpha(), e in -6.0..4.0f64) {
        let hop = map(10f64.powf(e)).hop(alpha).unwrap();
        prop_assert!(hop.next.is_none_or(|next| next > 0.0 && next <= alpha), "{hop:?}");
        prop_assert!(hop.loss.is_none_or(|loss| loss >= 0.0));
        prop_assert_eq!(hop.next.is_none(), !(hop.next_speed_squared > 0.0) && alpha > 1e-150);
    }

    /// The printed equations give the same map, up to their own rounding.
    #[test]
    fn printed_and_stable_forms_agree(alpha in 0.5..40f64, e in -1.5..0.0f64) {
        let ratio = MassRatio::new(10f64.powf(e)).unwrap();
        // Within 1e-9 of a branch change the two forms may decide differently.
        let near = |x: f64| (alpha - x).abs() < 1e-9;
        prop_assume!((0..14).all(|n| !near(n as f64 * PI) && !near(alpha_star(n))));
        let stable = LiftOffMap::new(ratio).hop(alpha).unwrap();
        prop_assume!(stable.next_speed_squared.abs() > 1e-6);
        let printed = printed_image(ratio, alpha).unwrap();
        prop_assert_eq!(printed.is_some(), stable.next.is_some());
        if let (Some(a), Some(b)) = (printed, stable.next) {
            let scale = alpha * alpha / b;
            prop_assert!((a - b).abs() < 1e-9 * scale, "{a} {b}");
        }
    }

    /// α' dα'/dα = α (1 − 4μW), against a central difference.
    #[test]
    fn the_slope_on_the_contact_intervals_agrees_with_a_central_difference(n in 1u64..8, part in 0.1..0.9f64, m in 0.05..1f64) {
        let star = alpha_star(n);
        let alpha = star + part * ((n + 1) as f64 * PI - star);
        let hop = map(m).hop(alpha).unwrap();
        prop_assume!(hop.next_speed_squared > 1e-2);
        let h = 0.5 * hop.flight_time;
        let w = passive_hopper::HalfFlight::at(h).w();
        let slope = alpha * (1.0 - 4.0 * MassRatio::new(m).unwrap().mu() * w) / hop.next.unwrap();
        let step = 1e-5;
        let value = |x: f64| map(m).image(x).unwrap().unwrap();
        let difference = (value(alpha + step) - value(alpha - step)) / (2.0 * step);
        prop_assert!((difference - slope).abs() < 1e-4 * (1.0 + slope.abs()).powi(3), "{difference} {slope}");
    }
}
