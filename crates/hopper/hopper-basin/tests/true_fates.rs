//! A decided fate is the fate of the exact orbit, at every double beside every kind of edge.
//!
//! The reference follows the orbit in 256 to 1024 bits, with nothing rounded to `f64` between hops.

use basin_of_attraction::UndecidedReason;
use hopper_basin::{Fates, HopperFate, Trap, TrapEdge, TrapSide};
use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, FixedPointSpeed, MassRatio, alpha_star, index_below,
};
use proptest::prelude::*;

fn fates(mass_ratio: f64) -> Fates {
    Fates::new(MassRatio::new(mass_ratio).unwrap()).unwrap()
}

/// The trap that certainly contains the orbit's speed.
fn trap_of(fates: &Fates, orbit: &ExtendedOrbit) -> Option<u64> {
    let mut n = index_below(orbit.speed()).unwrap();
    // The rounded speed may lie on the other side of a fixed point than the orbit.
    if orbit.offset_from(n).0 < 0.0 && n > 0 {
        n -= 1;
    } else if orbit.offset_from(n + 1).0 >= 0.0 {
        n += 1;
    }
    let (offset, error) = orbit.offset_from(n);
    let trap = fates.trap(n).unwrap();
    if trap.edge == TrapEdge::NextFixedPoint {
        // The trap is the whole hump: its end is known to more digits than its length.
        let (beyond, beyond_error) = orbit.offset_from(n + 1);
        return (offset > error && beyond < -beyond_error).then_some(n);
    }
    (trap.side_of_offset(offset, error) == TrapSide::Inside).then_some(n)
}

/// The fate of the exact orbit, if it is decided within `most` hops.
fn reference(fates: &Fates, alpha: f64, most: usize) -> Option<HopperFate> {
    Arithmetic::ALL[1..].iter().find_map(|&arithmetic| {
        let mut orbit = ExtendedOrbit::new(fates.map(), alpha, arithmetic).unwrap();
        for _ in 0..most {
            match trap_of(fates, &orbit) {
                Some(0) => return Some(HopperFate::Decaying),
                Some(n) => return Some(HopperFate::Incessant { n }),
                None => {}
            }
            match orbit.hop().unwrap() {
                ExtendedStep::LiftsOff => {}
                ExtendedStep::Grounded => return Some(HopperFate::Grounded),
                ExtendedStep::Inconclusive => return None,
            }
        }
        None
    })
}

/// Hops that are followed next to planted edges. Orbits that are slower count as undecided.
const FEW: usize = 300;

/// Most hops of a fate that is compared. Slower orbits jump over their slow hops; `edge_fates.rs` compares longer ones.
const MOST_COMPARED: usize = 500;

/// What a fate within `most` hops, a jump counted as one, promises. Returns whether it is decided.
fn check(fates: &Fates, alpha: f64, most: usize) -> bool {
    let m = fates.map().mass_ratio().value();
    let (fate, hops) = fates.fate_within(alpha, most).unwrap();
    // Grounded at once if and only if the map says so.
    if let Ok(image) = fates.map().image(alpha) {
        let at_once = fate == HopperFate::Grounded && hops == 1;
        assert_eq!(at_once, image.is_none(), "M = {m}, α = {alpha}");
    }
    if let HopperFate::Undecided(reason) = fate {
        // The only reason for the budget is that it is used up.
        assert!(hops == most || reason != UndecidedReason::Budget, "{reason:?} after {hops}");
        return false;
    }
    if hops <= MOST_COMPARED {
        assert_eq!(Some(fate), reference(fates, alpha, hops + 2), "M = {m}, α = {alpha}");
    }
    true
}

/// Checks the doubles within `ulps` of `edge`; returns the numbers of decided and of all.
fn check_around(fates: &Fates, edge: f64, ulps: i32) -> (usize, usize) {
    let mut alpha = edge;
    (0..ulps).for_each(|_| alpha = alpha.next_down());
    let mut decided = 0;
    for _ in -ulps..=ulps {
        decided += usize::from(check(fates, alpha, FEW));
        alpha = alpha.next_up();
    }
    (decided, 2 * ulps as usize + 1)
}

/// The double left of which `before` holds and right of which it does not, by bisection in [left, right].
fn edge(mut left: f64, mut right: f64, before: impl Fn(f64) -> Option<bool>) -> Option<f64> {
    if before(left)? == before(right)? {
        return None;
    }
    let at_left = before(left)?;
    while left.next_up() < right {
        let middle = left + 0.5 * (right - left);
        if before(middle)? == at_left { left = middle } else { right = middle }
    }
    Some(left)
}

/// Whether the hopper is grounded by the exact hop.
fn grounded(fates: &Fates, alpha: f64) -> Option<bool> {
    let mut orbit = ExtendedOrbit::new(fates.map(), alpha, Arithmetic::Bits256).unwrap();
    match orbit.hop().unwrap() {
        ExtendedStep::LiftsOff => Some(false),
        ExtendedStep::Grounded => Some(true),
        ExtendedStep::Inconclusive => None,
    }
}

/// The exact image minus `level` above α*_n; the ground counts as far below.
fn image_above(fates: &Fates, alpha: f64, n: u64, level: f64) -> Option<bool> {
    let mut orbit = ExtendedOrbit::new(fates.map(), alpha, Arithmetic::Bits256).unwrap();
    match orbit.hop().unwrap() {
        ExtendedStep::LiftsOff => Some(orbit.offset_from(n).0 > level),
        ExtendedStep::Grounded => Some(false),
        ExtendedStep::Inconclusive => None,
    }
}

/// The first change of `before` among the samples of an interval, to a double.
fn first_edge(left: f64, right: f64, before: impl Fn(f64) -> Option<bool>) -> Option<f64> {
    let at = |k: i32| left + (right - left) * f64::from(k) / 24.0;
    (0..24).find_map(|k| edge(at(k), at(k + 1), &before))
}

/// Speeds that were decided and wrong. The fates are those of orbits of 50 and 90 digits.
#[test]
fn fates_that_were_wrong() {
    let incessant = |n| HopperFate::Incessant { n };
    for (m, alpha, fate) in [
        // Beside the edge of the trap of α*_0.
        (0.745_131_541_893_374_9, 1.448_480_373_045_771_8, HopperFate::Grounded),
        // Beside edges of grounding.
        (0.359_221_701_914_382_2, 11.668_485_594_655_293, HopperFate::Decaying),
        (0.377_363_271_123_355_55, 9.905_886_873_248_653, HopperFate::Decaying),
        (0.443_396_190_031_748_35, 7.782_241_751_619_274, HopperFate::Decaying),
        // Left of a preimage of α*_2: decays after hundreds of hops.
        (0.12, 11.920_553_918_272_727, HopperFate::Decaying),
        // Just above a fixed point, beyond a trap shorter than the spacing of f64.
        (1.564_238_070_463_049_4, 8.463_663_833_675_143e11, HopperFate::Grounded),
        (0.2, 4.55, incessant(1)),
    ] {
        assert_eq!(fates(m).fate(alpha).unwrap(), fate, "M = {m}, α = {alpha}");
    }
}

/// At M = 1 the traps of large n are shorter than the spacing of `f64`. A double above α*_n is in the trap only if its
/// offset is at most Δ.
#[test]
fn traps_shorter_than_an_ulp_contain_only_what_is_within_their_length() {
    let (mut inside, mut outside, mut inside_of) = (0, 0, Vec::new());
    for n in (3_883..40_000).step_by(17) {
        let trap = Trap::new(n, MassRatio::ONE).unwrap();
        let alpha = trap.fixed_point.smallest_not_below();
        let offset = trap.fixed_point.offset_of(alpha);
        assert_eq!(trap.contains(alpha), offset < trap.delta, "{n}");
        inside += usize::from(trap.contains(alpha));
        outside += usize::from(!trap.contains(alpha));
        inside_of.extend(trap.contains(alpha).then_some(n));
    }
    assert!(inside > 10 && outside > 1000, "{inside} {outside}");
    // The fates there, inside and outside of the traps.
    let at_one = fates(1.0);
    let mut decided = 0;
    for n in (3_883..40_000).step_by(17 * 100) {
        let alpha = FixedPointSpeed::new(n).smallest_not_below();
        decided += usize::from(check(&at_one, alpha, FEW));
    }
    for n in inside_of {
        let alpha = FixedPointSpeed::new(n).smallest_not_below();
        assert_eq!(at_one.fate(alpha).unwrap(), HopperFate::Incessant { n });
    }
    assert!(decided > 10, "{decided}");
    // M = 0.5, n = 4315: the orbit of the next double falls through α*_n.
    let fates = fates(0.5);
    let alpha = FixedPointSpeed::new(4315).smallest_not_below();
    check(&fates, alpha, FEW);
}

/// Ends of traps that are given by a closed form have no error of the size of an ulp of α.
#[test]
fn lengths_of_whole_contact_parts_do_not_depend_on_the_size_of_the_speed() {
    use std::f64::consts::{FRAC_PI_2, PI};
    for n in [10, 1_000, 1_000_000, 1_000_000_000_000] {
        // Above M_c(n) of all of these n the trap would end by a crossing; 1e-300 is below.
        let trap = Trap::new(n, MassRatio::new(1e-300).unwrap()).unwrap();
        let exact = match trap.edge {
            TrapEdge::ContactEnd => FRAC_PI_2,
            TrapEdge::NextFixedPoint => PI,
            TrapEdge::Crossing => panic!("{trap:?}"),
        };
        assert!((trap.delta - exact).abs() < 1.1 / alpha_star(n), "{trap:?}");
    }
}

/// Doubles left of a preimage of α*_2 at M = 0.12, where rounding accumulates over the slow hops: of 300, some 90
/// were decided and wrong at 1e-11. A few are compared with 256 bits.
#[test]
fn fates_left_of_a_preimage_of_a_fixed_point_are_decided_and_right() {
    let fates = fates(0.12);
    let at = |distance, k| 11.920_553_918_335_777 - distance * (0.3 + 0.7 * f64::from(k) / 299.0);
    for distance in [1e-8, 1e-10, 1e-11, 3e-12] {
        for k in (0..300).step_by(75) {
            let alpha = at(distance, k);
            assert!(check(&fates, alpha, 2000), "{alpha}");
        }
    }
}

/// The orbit comes to 1.6·10⁻¹⁶ above α*_6, and its speed rounds to an `f64` below.
#[test]
fn an_orbit_just_above_a_fixed_point_is_in_its_trap() {
    let fates = fates(0.103_492_005_177_405_1);
    let (fate, hops) = fates.fate_within(23.088_066_834_218_072, 2000).unwrap();
    assert_eq!((fate, hops), (HopperFate::Incessant { n: 6 }, 1));
    assert!(check(&fates, 23.088_066_834_218_072, 2000));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: if cfg!(debug_assertions) { 8 } else { 32 }, ..ProptestConfig::default() })]

    /// The image beyond the edge of the trap of α*_0 is grounded.
    #[test]
    fn at_edges_of_the_first_trap(m in 0.35..2.35f64) {
        let fates = fates(m);
        let trap = fates.trap(0).unwrap();
        if trap.edge == TrapEdge::Crossing {
            let planted = edge(0.9 * trap.right(), 1.01 * trap.right(), |x| grounded(&fates, x));
            let (decided, all) = check_around(&fates, planted.unwrap(), 12);
            prop_assert_eq!(decided, all);
        }
    }

    #[test]
    fn at_edges_of_grounding(m in 0.33..2.9f64, place in 1.0..40.0f64) {
        let fates = fates(m);
        if let Some(planted) = first_edge(place, place + 3.0, |x| grounded(&fates, x)) {
            let (decided, all) = check_around(&fates, planted, 6);
            prop_assert!(decided + 1 >= all, "{} of {}", decided, all);
        }
    }

    /// Beyond the edge of trap n ≥ 1 the image is some ulps below α*_n, and the orbit is on its slow side.
    #[test]
    fn at_edges_of_traps(m in 0.11..8.0f64, n in 1..30u64) {
        let fates = fates(m);
        let trap = fates.trap(n).unwrap();
        let (decided, all) = check_around(&fates, trap.right(), 4);
        prop_assert!(decided >= 1, "{} of {}", decided, all);
    }

    #[test]
    fn at_edges_of_traps_of_large_humps(m in 0.11..8.0f64, exponent in 2.0..12.4f64) {
        let fates = fates(m);
        let star = FixedPointSpeed::new(10f64.powf(exponent) as u64);
        check(&fates, star.smallest_not_below(), FEW);
        check(&fates, star.smallest_not_below().next_up(), FEW);
    }

    #[test]
    fn at_fixed_points_and_at_multiples_of_pi(m in 0.02..6.0f64, n in 1..12u64) {
        let fates = fates(m);
        check_around(&fates, alpha_star(n), 3);
        check_around(&fates, n as f64 * std::f64::consts::PI, 3);
    }

    #[test]
    fn at_preimages_of_edges(m in 0.15..1.6f64, n in 1..5u64, place in 0.3..9.0f64) {
        let fates = fates(m);
        let left = alpha_star(n + 1) + place;
        let delta = fates.trap(n).unwrap().delta;
        if let Some(planted) = first_edge(left, left + 2.0, |x| image_above(&fates, x, n, delta)) {
            check_around(&fates, planted, 2);
        }
    }

    /// Left of a preimage of a fixed point the orbit comes to its slow side.
    #[test]
    fn left_of_preimages_of_fixed_points(
        m in 0.12..1.0f64,
        n in 1..4u64,
        place in 0.3..9.0f64,
        exponent in -9.0..-5.0f64,
    ) {
        let fates = fates(m);
        let left = alpha_star(n + 1) + place;
        if let Some(planted) = first_edge(left, left + 2.0, |x| image_above(&fates, x, n, 0.0)) {
            for side in [-1.0, 1.0] {
                check(&fates, planted + side * 10f64.powf(exponent), FEW);
            }
        }
    }
}
