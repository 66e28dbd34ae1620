//! The theorems hold, and statements that are false are not proved.
#![allow(clippy::unwrap_used)]

use hopper_basin::{Trap, crisis, rising_window};
use hopper_proof::{ProvedCrisis, QUICK_THEOREMS, Strip, fixed_point, proved_trap, rising};
use passive_hopper::{MassRatio, alpha_star};

/// Each is proved, under the name that the list gives it.
#[test]
fn the_quick_theorems_are_proved() {
    for (name, prove) in QUICK_THEOREMS {
        let theorem = prove().unwrap();
        assert!(theorem.is_proved() && theorem.name == *name, "{name}: {theorem:#?}");
    }
}

/// What the lemmas do not cover is refused, and there is no window 0.
#[test]
fn windows_beyond_the_lemmas_are_not_proved() {
    for heaviest in [1.5, -1.0, 0.0, f64::NAN, f64::INFINITY] {
        assert!(rising(&[(1, heaviest)]).is_err(), "{heaviest}");
    }
    assert!(!rising(&[(0, 0.5)]).unwrap().is_proved());
}

/// The windows of the library's table rise: every row of it is proved here.
#[test]
fn the_map_rises_in_the_windows_of_the_library() {
    let listed: Vec<(u64, f64)> =
        (1..).map_while(|n| Some((n, rising_window(n)?.largest_mass_ratio))).collect();
    assert!(listed.len() >= 8);
    let theorem = rising(&listed).unwrap();
    assert!(theorem.is_proved(), "{theorem:#?}");
}

/// The crises and the ends of traps of the library lie in their enclosures, which are no wider than some 10⁻¹².
#[test]
fn computed_crises_and_traps_lie_in_their_enclosures() {
    for n in 1..=8 {
        assert!(fixed_point(n).contains(alpha_star(n)));
        let found = ProvedCrisis::new(n).unwrap().mass_ratio();
        let computed = crisis(n).unwrap();
        assert!(found.widened(1e-16).contains(computed.mass_ratio), "{n} {found:?} {computed:?}");
        for ratio in [0.11, 0.3, 0.7, 1.0, 3.0] {
            let proved = proved_trap(n, &Strip::at(ratio).unwrap()).unwrap();
            let trap = Trap::new(n, MassRatio::new(ratio).unwrap()).unwrap();
            let end = alpha_star(n) + trap.delta;
            assert!(
                proved.right <= end + 1e-12 && proved.right > end - 1e-11,
                "{n} {ratio} {proved:?} {end}"
            );
        }
    }
}

/// A trap of a strip is one for each mass ratio of it; with the largest μ it is the shortest.
#[test]
fn the_trap_of_a_strip_is_in_the_traps_of_its_mass_ratios() {
    let of =
        |low: f64, high: f64| proved_trap(1, &Strip::between(low, high).unwrap()).unwrap().right;
    let all = of(0.2, 0.4);
    for ratio in [0.2, 0.3, 0.4] {
        assert!(all <= of(ratio, ratio));
    }
    // μ is largest at M = 1, inside of this strip.
    assert!(of(0.5, 3.0) <= of(1.0, 1.0));
}
