//! Basin fractions over the mass ratio, and tipping between two mass ratios.

use basin_of_attraction::{
    CurveLimits, Interval, Label, Refinement, TippingCounts, UnresolvedReason,
};
use hopper_basin::{
    Error, Fates, FractionGround, FractionLimits, HopperFate, basin_fractions, crisis, first_humps,
    fractions_over_mass_ratio, grounding, hopper_basins, hump_fractions, known_kinks,
    random_tipping, tipping, tipping_along_drift,
};
use passive_hopper::MassRatio;

fn mass_ratio(m: f64) -> MassRatio {
    MassRatio::new(m).unwrap()
}

fn fates(m: f64) -> Fates {
    Fates::new(mass_ratio(m)).unwrap()
}

/// Bounds up to the proved mass ratios, 95 % intervals beyond: both contain what equally spaced points give, which
/// uses neither.
#[test]
fn fractions_contain_those_of_the_papers_protocol() {
    let limits = FractionLimits { points: 20_000, ..FractionLimits::default() };
    for (m, ground) in [
        (0.1, FractionGround::Bounds),
        (0.3, FractionGround::Bounds),
        (2.0, FractionGround::Points),
    ] {
        let (found, by) = hump_fractions(&fates(m), 1, 4, limits).unwrap();
        assert_eq!(by, ground, "{m}");
        let counted = basin_fractions(mass_ratio(m), 1, 4, 20_000).unwrap();
        for label in [Label::from(0), 1.into(), 2.into(), 3.into(), HopperFate::GROUNDED] {
            let (range, other) = (found.of(label), counted.of(label));
            // The counted points have an error of some parts in ten thousand.
            assert!(
                range.lower - 5e-4 <= other && other <= range.upper + 5e-4,
                "{m} {label} {range:?} {other}"
            );
        }
        let all = found.of(HopperFate::INCESSANT);
        assert!((all.value - counted.incessant()).abs() < 2e-3, "{m} {all:?}");
        assert!(all.half_width() < if m < 1.0 { 2e-4 } else { 5e-3 }, "{m} {all:?}");
    }
    assert!(matches!(hump_fractions(&fates(0.2), 3, 3, limits), Err(Error::NoPoints { .. })));
}

/// At the onset of grounding the rounding of the map opens a gap inside the trap of α*_0.
#[test]
fn basins_exist_at_every_kink() {
    let refinement = Refinement { shortest: 1e-5, ..Refinement::default() };
    for m in known_kinks(1, 3).unwrap().into_iter().filter(|&m| m < 0.9) {
        for m in [m.next_down(), m, m.next_up(), pxfm::f_exp(pxfm::f_log(m))] {
            let found = hopper_basins(&fates(m), 1, 3, 400, refinement).unwrap();
            assert_eq!(found.probes.wrong, 0, "{m}");
        }
    }
}

#[test]
fn the_fractions_over_the_mass_ratio_fall_at_the_crisis() {
    let limits = FractionLimits {
        refinement: Refinement { shortest: 1e-5, ..Refinement::default() },
        ..FractionLimits::default()
    };
    let at = |m: f64| Ok(hump_fractions(&fates(m), 1, 2, limits)?.0);
    let curve =
        CurveLimits { first_steps: 3, difference: 0.1, shortest: 1e-7, ..CurveLimits::default() };
    let range = Interval::new(0.09, 0.14).unwrap();
    let found = fractions_over_mass_ratio::<Error>(range, 1, 2, curve, at).unwrap();
    let fractions: Vec<_> = found.of(HopperFate::INCESSANT).collect();
    let start = crisis(1).unwrap().mass_ratio;
    assert!(fractions.iter().any(|(m, _)| (m / start - 1.0).abs() < 2e-9));
    for (m, fraction) in &fractions {
        // All of hump 1 stays below the crisis; above it the fraction falls like a root.
        assert_eq!(fraction.lower > 0.999, *m < start, "{m} {fraction:?}");
    }
    assert!(found.unresolved().is_empty(), "{:?}", found.unresolved());
    for pair in fractions.windows(2) {
        assert!((pair[1].1.value - pair[0].1.value).abs() <= 0.1);
    }
    // A shortest step that is longer leaves one unresolved step, at the crisis.
    let coarse = CurveLimits { shortest: 1e-2, ..curve };
    let at = |m: f64| Ok(hump_fractions(&fates(m), 1, 2, limits)?.0);
    let found = fractions_over_mass_ratio::<Error>(range, 1, 2, coarse, at).unwrap();
    let jumps: Vec<_> = found.jumps().collect();
    assert!(jumps.iter().any(|jump| (jump.from / start - 1.0).abs() < 2e-9));
    assert!(found.unresolved().iter().all(|step| step.reason == UnresolvedReason::Jump));
}

#[test]
fn kinks_are_the_crises_the_groundings_and_their_inverses() {
    let kinks = known_kinks(1, 3).unwrap();
    assert_eq!(kinks.len(), 10);
    assert!(kinks.is_sorted());
    for m in [crisis(2).unwrap().mass_ratio, 1.0 / grounding(0).unwrap().mass_ratio] {
        assert!(kinks.contains(&m));
    }
    for k in 0..5 {
        assert!((kinks[k] * kinks[9 - k] - 1.0).abs() < 1e-15);
    }
}

/// Intervals and random points give the same probabilities, and those of one basin sum to 1.
#[test]
fn tipping_by_intervals_contains_tipping_by_points() {
    let (before, after) = (fates(0.15), fates(0.3));
    let refinement = Refinement { shortest: 1e-7, ..Refinement::default() };
    let exact = tipping(&before, &after, 1, 3, refinement).unwrap();
    assert!(exact.is_proved());
    let counted = random_tipping(&before, &after, first_humps(2), 20_000, 5).unwrap();
    for from in [0u8, 1, 2].map(Label::from) {
        let mut sum = 0.0;
        for to in [0u8, 1, 2].map(Label::from) {
            let bounds = exact.tipping.probability(from, to).unwrap();
            let interval = counted.probability(from, to).unwrap().unwrap();
            // Nine intervals of 95 %, half as long again: none misses in all but a few of a thousand samples.
            let more = 0.5 * interval.half_width();
            assert!(
                interval.lower - more <= bounds.upper && bounds.lower <= interval.upper + more,
                "{from} {to}"
            );
            sum += bounds.middle();
        }
        assert!((sum - 1.0).abs() < 1e-3, "{from}: {sum}");
    }
    // Without a change nothing tips.
    let still = tipping(&before, &before, 1, 2, refinement).unwrap().tipping;
    let one = Label::from(1);
    assert!(still.probability(one, one).unwrap().covers(1.0));
    assert!(still.probability(one, Label::from(0)).unwrap().upper < 1e-3);
    assert!(!tipping(&before, &fates(2.0), 1, 2, refinement).unwrap().is_proved());
}

/// A drift of one hop is a sudden change, and the slower it is, the more speeds stay in the basin of α*_1.
#[test]
fn fewer_hoppers_tip_in_a_slow_drift() {
    let (before, after) = (fates(0.1), fates(0.2));
    let window = first_humps(1);
    let along = |hops: usize| -> TippingCounts {
        let at = |k: usize| mass_ratio(0.1 + 0.1 * (k + 1) as f64 / hops as f64);
        let drift: Vec<MassRatio> = (0..hops).map(at).collect();
        tipping_along_drift(&before, &drift, &after, window, 2000, 3).unwrap()
    };
    let sudden = random_tipping(&before, &after, window, 2000, 3).unwrap();
    assert_eq!((along(0), along(1)), (sudden.clone(), sudden));
    let one = Label::from(1);
    let stays = [1, 16, 256].map(|hops| along(hops).probability(one, one).unwrap().unwrap());
    assert!(stays[0].upper < stays[1].lower && stays[1].upper < stays[2].lower, "{stays:?}");
    assert!(stays[2].lower > 0.9);
    assert!(random_tipping(&before, &after, window, usize::MAX, 3).is_err());
    assert!(random_tipping(&before, &after, window, 0, 3).is_err());
    let reversed = Interval { left: 6.0, right: 5.0 };
    assert!(random_tipping(&before, &after, reversed, 10, 3).is_err());
}
