//! Traps, crises, fates and the paper's basin fractions agree with independent values.

#![allow(clippy::excessive_precision)] // published digits, as they are printed

use approx::assert_relative_eq;
use basin_of_attraction::{Interval, PreimageTree, Refinement, ResidualSet};
use hopper_basin::{
    Fates, HopperFate, ImmediateBasinEdge, Trap, TrapEdge, basin_fractions, crisis, grounding,
    hopper_basins, immediate_basin, upper_crisis_bracket,
};
use hopper_reference::rows;
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};

/// The reference was computed with 50 to 130 digits (mpmath). The largest α is 36, the smallest Δ 4e-5.
#[test]
fn delta_agrees_with_forty_digits_on_the_contact_intervals() {
    let mut compared = 0;
    for row in rows(include_str!("data/local_basin.json")) {
        let n = row.integer("n");
        let ratio = MassRatio::new(row.result("mass_ratio").unwrap()).unwrap();
        let trap = Trap::new(n, ratio).unwrap();
        if row.text("edge").starts_with("contact") {
            assert_eq!(trap.edge, TrapEdge::Crossing);
            let error = (trap.delta - row.result("delta_exact").unwrap()).abs();
            // M is a decimal number: half an ulp of it shifts Δ by some ulps more.
            assert!(error <= trap.error + 4.0 * f64::EPSILON * trap.delta, "{row} {trap:?}");
            assert!(trap.error < 1e-13 * trap.delta, "{trap:?}");
            compared += 1;
        } else {
            assert_ne!(trap.edge, TrapEdge::Crossing, "{row}");
        }
    }
    assert!(compared > 60, "{compared}");
}

/// Half an ulp of the reference, which was read as an `f64`, and the number's own error.
#[test]
fn touches_hold_thirty_digits() {
    for row in rows(include_str!("data/critical.json")) {
        let n = row.integer("n");
        let (crisis, grounding) = (crisis(n).unwrap(), grounding(n).unwrap());
        for (found, key) in [(crisis, "M_c"), (grounding, "M_grounding")] {
            let exact = row.result(key).unwrap();
            let rounding = 0.5 * f64::EPSILON * exact;
            assert!((found.mass_ratio - exact).abs() <= found.error + rounding, "{key} {found:?}");
            assert!(found.error <= f64::EPSILON * exact, "{key} {found:?}");
        }
        assert_relative_eq!(crisis.mu, row.result("mu_c").unwrap(), max_relative = 2.3e-16);
        let alpha = row.result("alpha_touch").unwrap();
        assert_relative_eq!(crisis.alpha, alpha, max_relative = 2.3e-16);
    }
}

#[test]
fn grounding_of_hump_0_begins_at_the_mass_ratio_of_theory() {
    let found = grounding(0).unwrap();
    assert_eq!(found.mass_ratio, 0.327_498_113_640_356_01);
    assert!(found.error <= f64::EPSILON * found.mass_ratio);
}

/// Humps up to the largest lift-off speed have touches to an ulp.
#[test]
fn touches_of_high_humps_are_narrow() {
    for n in [10_000, 65_000, 1 << 30, 2_700_000_000_000] {
        for touch in [crisis(n).unwrap(), grounding(n).unwrap()] {
            assert!(touch.error <= f64::EPSILON * touch.mass_ratio, "{touch:?}");
        }
    }
}

#[test]
fn fates_agree_with_the_reference() {
    let mut seen = [0; 3];
    for row in rows(include_str!("data/fates.jsonl")) {
        let ratio = MassRatio::new(row.input("mass_ratio")).unwrap();
        let fate = Fates::new(ratio).unwrap().fate(row.input("alpha")).unwrap();
        let (expected, kind) = match row.text("fate") {
            "incessant" => (HopperFate::Incessant { n: row.integer("n") }, 0),
            "decaying" => (HopperFate::Decaying, 1),
            "grounded" => (HopperFate::Grounded, 2),
            other => panic!("{other}"),
        };
        assert_eq!(fate, expected, "{row}");
        seen[kind] += 1;
    }
    assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
}

/// Sec. VI B: 1 and 0.953 at M = 0.1, 0.037 at M = 0.2, with 10 000 points on each interval.
#[test]
fn the_papers_basin_fractions() {
    let low = basin_fractions(MassRatio::new(0.1).unwrap(), 1, 6, 10_000).unwrap();
    assert_eq!(low.incessant(), 1.0);
    assert!((low.of(1.into()) - 0.953).abs() < 0.0005);
    let high = basin_fractions(MassRatio::new(0.2).unwrap(), 1, 6, 10_000).unwrap();
    assert!((high.incessant() - 0.037).abs() < 0.0005);
    assert!(
        basin_fractions(MassRatio::ONE, 1, 6, 0).is_err()
            && basin_fractions(MassRatio::ONE, 6, 1, 10).is_err()
    );
}

/// Δ_n λ³ → 1 as n grows. At n = 10⁷ Δ is 5e-24, far below the spacing of α.
#[test]
fn tiny_traps_have_all_their_digits() {
    for n in [1_000, 100_000, 10_000_000] {
        let trap = Trap::new(n, MassRatio::ONE).unwrap();
        let square = trap.fixed_point.value() * trap.fixed_point.value();
        // 2 (1+α*²)⁴/(81 μ³ α*¹¹), with relative corrections of 32/(15 α*²).
        let leading =
            2.0 * 64.0 / 81.0 * (1.0 + 1.0 / square).powi(4) / (square * trap.fixed_point.value());
        assert_relative_eq!(trap.delta, leading, max_relative = 1e-12 + 40.0 / square);
    }
    assert!(Trap::new(u64::MAX, MassRatio::ONE).is_err());
}

/// For tiny M no hop loses enough to pass a fixed point, and the fate is known without computing a hop.
#[test]
fn tiny_mass_ratios_are_decided_at_once() {
    for m in [1e-300, 1e-9, 1e-3] {
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        let below = passive_hopper::alpha_star(3) - 1e-9;
        assert_eq!(fates.fate_within(below, 0).unwrap().0, HopperFate::Incessant { n: 2 });
    }
    // Check of the bound: every sampled image of the sudden window lies above the fixed point.
    for m in [0.005, 0.01, 0.02] {
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        for n in (1..6).filter(|&n| fates.trap(n).unwrap().edge == TrapEdge::NextFixedPoint) {
            let (left, right) =
                ((n + 1) as f64 * std::f64::consts::PI, passive_hopper::alpha_star(n + 1));
            for k in 1..200 {
                let alpha = left + (right - left) * f64::from(k) / 200.0;
                assert!(
                    fates.map().image(alpha).unwrap().unwrap()
                        > fates.trap(n).unwrap().fixed_point.value()
                );
            }
        }
    }
}

/// A speed lies in level k exactly if its orbit enters the trap after k hops.
#[test]
fn levels_are_complete() {
    let fates = Fates::new(MassRatio::new(0.4).unwrap()).unwrap();
    let levels = hopper_basin::basin_levels(&fates, 1, 4, 4, 4001).unwrap();
    let (left, right) = (passive_hopper::alpha_star(1), passive_hopper::alpha_star(4));
    let mut seen = [0; 5];
    for k in 1..40_000 {
        let alpha = left + (right - left) * (f64::from(k) * 0.618_033_988_749_895).fract();
        let (fate, hops) = fates.fate_within(alpha, 100).unwrap();
        let inside = fate == HopperFate::Incessant { n: 1 };
        for (level, set) in levels.iter().enumerate() {
            assert_eq!(set.contains(alpha), inside && hops == level, "{alpha}, level {level}");
            seen[level] += usize::from(set.contains(alpha));
        }
    }
    assert!(seen.iter().all(|&count| count > 3), "{seen:?}");
}

fn fates(mass_ratio: f64) -> Fates {
    Fates::new(MassRatio::new(mass_ratio).unwrap()).unwrap()
}

/// The reference values are means over five humps, counted with 10⁶ points on each. Their error is the square root of a
/// count.
#[test]
fn interval_basins_have_the_counted_fractions() {
    for (m, all, first) in
        [(0.1, 1.0, 0.953_197), (0.2, 0.037_044, 0.031_596), (0.5, 0.007_283, 0.006_227)]
    {
        let refinement = Refinement { shortest: 1e-6, ..Refinement::default() };
        let found = hopper_basins(&fates(m), 1, 6, 400, refinement).unwrap().basins;
        let (mut incessant, mut to_first, mut open) = (0.0, 0.0, 0.0);
        for n in 1..6 {
            let hump = Interval::new(alpha_star(n), alpha_star(n + 1)).unwrap();
            let part = found.within(hump).unwrap();
            let share = |length: f64| length / hump.length() / 5.0;
            incessant += share(part.resolved_length_of(HopperFate::is_incessant));
            to_first += share(part.resolved_length(1.into()));
            open += share(part.undecided());
        }
        assert!(
            incessant <= all + 1e-5 && all <= incessant + open + 1e-5,
            "{m}: {incessant} {open}"
        );
        assert!(
            to_first <= first + 1e-5 && first <= to_first + open + 1e-5,
            "{m}: {to_first} {open}"
        );
        assert!(open < 1e-3, "{open}");
    }
}

/// The decided intervals agree with the fates of speeds in them, grounding included.
#[test]
fn interval_basins_agree_with_fates() {
    for m in [0.05, 0.3, 0.7, 0.9] {
        let fates = fates(m);
        let refinement = Refinement { shortest: 1e-4, ..Refinement::default() };
        let found = hopper_basins(&fates, 1, 4, 400, refinement).unwrap();
        let (mut decided, mut grounded) = (0, 0);
        for k in 0..3000 {
            let part = (f64::from(k) + 0.5) / 3000.0;
            let alpha = alpha_star(1) + (alpha_star(4) - alpha_star(1)) * part;
            let Some(label) = found.basins.label(alpha) else { continue };
            assert_eq!(fates.fate(alpha).unwrap().label(), label, "M = {m}, α = {alpha}");
            decided += 1;
            grounded += usize::from(label == HopperFate::GROUNDED);
        }
        assert!(decided > 2700, "{m}: {decided}");
        assert_eq!(grounded > 0, m > 0.33, "{m}: {grounded}");
    }
}

/// At M = 10 the immediate basin of α*_1 ends in the sudden window, where hops have six sudden lift-offs.
#[test]
fn immediate_basins_in_the_sudden_windows() {
    let found = immediate_basin(fates(10.0).map(), 1, 1e-3).unwrap();
    assert_eq!(found.edge, ImmediateBasinEdge::Sudden { width: 1e-3 });
    assert_relative_eq!(found.delta, 2.577_461_789_994_586_2, max_relative = 1e-13);
    let found = immediate_basin(fates(0.1).map(), 1, 1e-3).unwrap();
    assert_eq!(found.edge, ImmediateBasinEdge::NotFound { width: 1e-3 });
    assert_relative_eq!(found.delta, 3.231_842_379_028_643, max_relative = 1e-14);
    assert_eq!(
        immediate_basin(fates(1.0).map(), 1, 1e-3).unwrap().edge,
        ImmediateBasinEdge::Contact
    );
    // At M = 20 the first interval with f < α*_1 is 2.4e-8 wide: a scan at 1e-3 misses it.
    assert_eq!(
        immediate_basin(fates(20.0).map(), 1, 1e-3).unwrap().edge,
        ImmediateBasinEdge::NotFound { width: 1e-3 }
    );
    assert!(
        immediate_basin(fates(10.0).map(), 1, 0.0).is_err()
            && immediate_basin(fates(10.0).map(), 1, f64::NAN).is_err()
    );
}

/// On two humps level k of the tree has 2k − 1 intervals; on three the number grows like k². The residual set is
/// countable.
#[test]
fn the_residual_set_of_the_preimage_tree_is_countable() {
    let fates = fates(0.2);
    let trap = fates.trap(1).unwrap();
    let trap = Interval::new(trap.fixed_point.value(), trap.right()).unwrap();
    for (top, power) in [(3, 1.0), (4, 2.0)] {
        let window = Interval::new(alpha_star(1), alpha_star(top)).unwrap();
        let branches = hopper_basin::branches(&fates, 1, top, 400).unwrap();
        let tree = PreimageTree::grow(&fates, &branches, trap, window, 40).unwrap();
        let ResidualSet::Countable { power: found } = tree.residual_set() else {
            panic!("{:?} of {:?}, {}", tree.residual_set(), tree.counts(), tree.complete_levels())
        };
        assert!((found - power).abs() < 0.35, "{top}: {found}");
        if top == 3 {
            let counts = tree.counts();
            assert!((5..tree.complete_levels()).all(|k| counts[k] == 2 * k - 1), "{counts:?}");
        }
    }
}

/// Below the onset of grounding on the contact parts no hop of a scan is grounded. In the sudden windows there is no
/// proof of this; the scan covers them too.
#[test]
fn grounding_is_not_found_below_its_onset() {
    for m in [0.05, 0.2, 0.32, 3.2, 5.0, 20.0] {
        let map = LiftOffMap::new(MassRatio::new(m).unwrap());
        for k in 1..=20_000 {
            let alpha = 0.001 * f64::from(k) + 0.000_5;
            assert!(map.image(alpha).unwrap().is_some(), "M = {m}, α = {alpha}");
        }
    }
}

/// Each reason has a label, and fixed points beyond the labels have one too.
#[test]
fn every_fate_has_a_label_of_its_own() {
    use basin_of_attraction::UndecidedReason;
    let labels = [
        HopperFate::Undecided(UndecidedReason::Budget),
        HopperFate::Undecided(UndecidedReason::Precision { at: 1.0 }),
        HopperFate::Undecided(UndecidedReason::Map { at: 1.0 }),
        HopperFate::Grounded,
        HopperFate::Decaying,
        HopperFate::Incessant { n: 3 },
        HopperFate::Incessant { n: 70_000 },
    ]
    .map(HopperFate::label);
    for (k, label) in labels.into_iter().enumerate() {
        assert_eq!(label.is_undecided(), k < 3);
        assert!(labels.iter().skip(k + 1).all(|other| *other != label));
        assert!(!HopperFate::label_name(label).is_empty());
    }
    // An ulp left of a fixed point an orbit repeats its speed in f64. It needs thousands of hops to leave, which
    // are jumped over.
    let fates = fates(0.2);
    let alpha = alpha_star(2).next_down();
    let (fate, hops) = fates.fate_within(alpha, 500).unwrap();
    assert!(!fate.label().is_undecided() && hops > 5000, "{fate:?} {hops}");
    let (fate, hops) = fates.fate_within(alpha - 1e-3, 2).unwrap();
    assert_eq!((fate, hops), (HopperFate::Undecided(UndecidedReason::Budget), 2));
}

#[test]
fn upper_crises_depend_on_the_width() {
    let bracket = |width| upper_crisis_bracket(1, width, 40.0).unwrap();
    let (coarse, fine) = (bracket(1e-2), bracket(1e-3));
    assert!(coarse.0 < coarse.1 && coarse.1 - coarse.0 < 1e-4);
    // A finer scan finds falls at larger mass ratios. Both brackets lie above 1/M_c = 9.67 of the contact part.
    assert!(9.665 < coarse.1 && coarse.1 < fine.1, "{coarse:?} {fine:?}");
}

/// Each wrong argument has its own error.
#[test]
fn errors_name_the_wrong_argument() {
    use hopper_basin::Error;
    let basin = |width| immediate_basin(fates(10.0).map(), 1, width);
    assert!(matches!(basin(0.0), Err(Error::Spacing { spacing: 0.0, .. })));
    assert_eq!(
        upper_crisis_bracket(1, 1e-2, 9.7),
        Err(Error::LargestMassRatio { n: 1, largest: 9.7 })
    );
}

/// A speed of a trap is in it after no hop, up to the last `f64`: π, and those next to an end where f falls to α*_n.
#[test]
fn the_last_speeds_of_a_trap_need_no_hop() {
    let mut counts = [0, 0];
    for m in [0.12, 0.2, 0.5, 1.0] {
        let ratio = MassRatio::new(m).unwrap();
        let fates = Fates::new(ratio).unwrap();
        let pi = fates.fate_within(std::f64::consts::PI, 100).unwrap();
        assert!(m > 0.3 || pi == (HopperFate::Decaying, 0), "{pi:?}");
        for n in 1..4 {
            let trap = Trap::new(n, ratio).unwrap();
            if trap.edge != TrapEdge::Crossing {
                continue;
            }
            let mut speed = trap.right();
            for _ in 0..12 {
                speed = speed.next_down();
            }
            for _ in 0..24 {
                speed = speed.next_up();
                let next = fates.map().enclosed_hop(speed, 0.0).unwrap().next.unwrap();
                let offset = trap.fixed_point.offset_of(next.value);
                let (fate, hops) = fates.fate_within(speed, 1_000_000).unwrap();
                if offset.abs() > next.error + 1e-29 {
                    assert_eq!(hops == 0, offset > 0.0, "{m} {n} {speed:?} {fate:?} {hops}");
                    counts[usize::from(hops == 0)] += 1;
                }
            }
        }
    }
    assert!(counts[0] > 50 && counts[1] > 50, "{counts:?}");
}
