//! Basins as intervals say what they rest on, and agree with the fates of single speeds where their branches are
//! proved.

use basin_of_attraction::{Interval, Refinement, StopReason};
use hopper_basin::{
    BranchGround, Error, Fates, HopperBasins, HopperFate, basin_fractions, branches, hopper_basins,
};
use passive_hopper::{MassRatio, alpha_star};

/// Speeds whose fates are compared. Without optimization these are fewer.
const PROBES: usize = if cfg!(debug_assertions) { 4_000 } else { 20_000 };

fn mass_ratio(m: f64) -> MassRatio {
    MassRatio::new(m).unwrap()
}

fn fates(m: f64) -> Fates {
    Fates::new(mass_ratio(m)).unwrap()
}

fn basins(fates: &Fates, samples: usize) -> HopperBasins {
    let refinement = Refinement { shortest: 1e-7, intervals: 200_000, ..Refinement::default() };
    hopper_basins(fates, 1, 6, samples, refinement).unwrap()
}

/// Branches that a search with 400 samples in each window misses would give wrong labels here. At M = 5 this speed
/// was called decaying.
#[test]
fn above_the_proved_mass_ratios_windows_stay_undecided_and_no_label_is_wrong() {
    for m in [0.92, 2.0, 5.0] {
        let fates = fates(m);
        let found = basins(&fates, 400);
        assert_eq!(found.ground, BranchGround::ContactParts, "{m}");
        assert_ne!(found.basins.stop_reason(), StopReason::Resolved, "{m}");
        let probes = found.probe(&fates, PROBES, 7).unwrap();
        assert!(probes.wrong == 0 && probes.compared > PROBES / 200, "{m} {probes:?}");
    }
    let speed = 15.718_418_184_199_06;
    assert_eq!(fates(5.0).fate(speed).unwrap(), HopperFate::Incessant { n: 2 });
    // Speeds of a contact part are grounded between the two crises of hump 0.
    let found = hopper_basins(&fates(1.0), 0, 2, 400, Refinement::default()).unwrap();
    assert!(found.basins.resolved_length(HopperFate::GROUNDED) > 0.1);
}

#[test]
fn where_the_branches_are_proved_every_probe_has_the_fate_of_its_interval() {
    for m in [0.05, 0.8, 0.1, 0.2, 0.5].into_iter().take(if cfg!(debug_assertions) { 2 } else { 5 })
    {
        let fates = fates(m);
        let found = basins(&fates, 400);
        assert_eq!(found.ground, BranchGround::Proved, "{m}");
        let probes = found.probe(&fates, PROBES, 7).unwrap();
        assert_eq!((probes.wrong, found.probes.wrong), (0, 0), "{m} {probes:?}");
        assert!(probes.compared > PROBES / 20 * 19);
    }
    let refinement = Refinement { shortest: 1e-9, ..Refinement::default() };
    let found = hopper_basins(&fates(0.2), 1, 2, 400, refinement).unwrap();
    assert_eq!(found.basins.stop_reason(), StopReason::Resolved);
}

/// The ends themselves have the fate of their interval, also where they were computed as 4.580042449461985 at M =
/// 0.2, which decays after 24 133 hops. The ground is reached by one more hop than the gap in which it is.
#[test]
fn the_ends_of_every_interval_have_its_fate() {
    // The last two have ends of traps at multiples of π, which no double is.
    for (m, first, last) in
        [(0.12, 1, 6), (0.2, 1, 6), (0.5, 1, 6), (0.8, 1, 6), (0.7, 0, 3), (0.07, 0, 3)]
    {
        let fates = fates(m);
        let refinement = Refinement { undecided: 0.1, ..Refinement::default() };
        let found = hopper_basins(&fates, first, last, 400, refinement).unwrap();
        let parts = found.basins.intervals();
        let all = parts.len();
        assert!(all > 100 || first == 0, "{m}");
        let (mut ends, mut grounded) = (Vec::new(), 0);
        // Without optimization these are fewer.
        let most = if cfg!(debug_assertions) { 500 } else { 5000 };
        for part in parts.iter().step_by(1 + all / most) {
            let Interval { left, right } = part.interval;
            // The doubles beside an end have images beside the end of a trap, within its error.
            let inside = |speed: &f64| (left..=right).contains(speed);
            let (mut upwards, mut downwards) = (left, right);
            for _ in 0..4 {
                ends.extend(
                    [upwards, downwards].into_iter().filter(inside).map(|speed| (part, speed)),
                );
                (upwards, downwards) = (upwards.next_up(), downwards.next_down());
            }
        }
        ends.retain(|end| end.1 > 0.0);
        let speeds: Vec<f64> = ends.iter().map(|end| end.1).collect();
        for ((part, speed), (fate, hops)) in
            ends.iter().zip(fates.fates_within(&speeds, 1_000_000).unwrap())
        {
            assert_eq!(fate.label(), part.label, "{m} {speed:?}");
            assert_eq!(Some(hops), part.level, "{m} {speed:?}");
            grounded += usize::from(fate == HopperFate::Grounded);
        }
        assert!(grounded > 0 || m < 0.33, "{m}");
        // The whole length is kept but for what rounding moves.
        let lost = found.basins.undecided() - refinement.undecided;
        assert!(lost < 1e-6, "{m} {lost:e}");
    }
}

#[test]
fn ranges_of_humps_that_never_end_are_errors() {
    let (m, f) = (mass_ratio(0.2), fates(0.2));
    assert!(matches!(basin_fractions(m, 0, u64::MAX, 0), Err(Error::NoPoints { .. })));
    assert!(matches!(basin_fractions(m, 0, u64::MAX, 1), Err(Error::Window { .. })));
    assert!(basin_fractions(m, 0, 65_000, usize::MAX).is_err());
    assert!(matches!(branches(&f, 0, 100_000, 3), Err(Error::Window { .. })));
    assert!(matches!(branches(&f, 0, u64::MAX, 3), Err(Error::Window { .. })));
    for (to, samples) in [(65_000, 10_000), (2, usize::MAX)] {
        assert!(matches!(branches(&f, 0, to, samples), Err(Error::BasinOfAttraction(_))));
    }
    assert_eq!(branches(&f, 5, 5, 3).unwrap(), []);
}

/// At the ends of the range of M nothing is searched: small M have whole humps as traps, and large M have no window
/// that `f64` resolves.
#[test]
fn at_extreme_mass_ratios_the_traps_are_the_basins() {
    let small = basins(&fates(1e-300), 400);
    assert_eq!((small.ground, small.probes.wrong), (BranchGround::Proved, 0));
    assert_eq!(small.basins.stop_reason(), StopReason::Resolved);
    for n in 1..6 {
        let hump = alpha_star(n + 1) - alpha_star(n);
        assert!(
            (small.basins.resolved_length(HopperFate::label_of_fixed_point(n)) - hump).abs()
                < 1e-13
        );
    }
    // Without optimization these are the two ends.
    let all = [51.0, 1.0 / f64::MIN_POSITIVE, 1e3, 1e300];
    for &m in if cfg!(debug_assertions) { &all[..2] } else { &all[..] } {
        let fates = fates(m);
        let large = basins(&fates, 400);
        assert_eq!((large.ground, large.probes.wrong), (BranchGround::ContactParts, 0), "{m}");
        assert!(large.probes.compared > 400, "{m} {:?}", large.probes);
        for n in 1..6 {
            let contact = (n + 1) as f64 * std::f64::consts::PI - alpha_star(n);
            let known = large.basins.resolved_length(HopperFate::label_of_fixed_point(n));
            assert!((known - contact).abs() < 1e-12, "{m} {n}: {known} {contact}");
        }
        // What is undecided is in every upper bound.
        let upper: f64 = large.basins.basin_length(1.into()).upper;
        assert!(upper > 6.0, "{m}: {upper}");
    }
    // Higher humps still fall at M = 60: their contact parts are followed.
    let fates = fates(60.0);
    let last = if cfg!(debug_assertions) { 18 } else { 30 };
    let found = hopper_basins(&fates, 0, last, 400, Refinement::default()).unwrap();
    assert_eq!((found.ground, found.probes.wrong), (BranchGround::ContactParts, 0));
    assert!(found.basins.intervals().iter().any(|part| part.level > Some(0)));
}

/// An image within the error of a trap's end counts as in the trap if the next one is: decided with 60 digits
/// elsewhere.
#[test]
fn the_hop_into_the_end_of_a_trap_is_the_last_one() {
    for (m, speed, hops) in [
        (0.2, 4.8609964982165605, 3),
        (0.5, 5.086480028089297, 2),
        (0.5, 4.695282219922073, 3),
        (0.12, 6.168781168498799, 1),
        (0.12, 6.16878116849879, 1),
        (0.12, 6.168781168498787, 1),
    ] {
        let fates = fates(m);
        assert_eq!(fates.fate_within(speed, 1000).unwrap().1, hops, "{m} {speed}");
        assert_eq!(fates.fates_within(&[speed], 1000).unwrap()[0].1, hops, "{m} {speed}");
    }
}
