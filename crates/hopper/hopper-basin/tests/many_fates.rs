//! Fates of many speeds are those of each speed alone.

use basin_of_attraction::SplitMix64;
use hopper_basin::{Fates, HOP_BUDGET};
use passive_hopper::{MassRatio, alpha_star};

#[test]
fn many_fates_are_the_fates_one_by_one() {
    let random = SplitMix64::from_seed(17);
    let mut undecided = 0;
    for (at, m) in (0..).zip([0.02, 0.2, 0.9, 1.0, 7.0]) {
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        let mut speeds: Vec<f64> =
            (0..3000).map(|k| 40.0 * random.uniform(5000 * at + k) + 1e-3).collect();
        // Beside fixed points, where slow hops are jumped over and f64 does not suffice.
        for n in 1..=6 {
            let star = alpha_star(n);
            speeds.extend([star, star.next_down(), star.next_up()]);
            speeds.extend((1..12).map(|k| star - 10f64.powi(-k)));
        }
        for budget in [HOP_BUDGET, 3, 0] {
            let together = fates.fates_within(&speeds, budget).unwrap();
            for (&speed, found) in speeds.iter().zip(together) {
                let alone = fates.fate_within(speed, budget).unwrap();
                assert_eq!(found, alone, "M = {m}, α = {speed:?}, budget {budget}");
                undecided += usize::from(found.0.label().is_undecided());
            }
        }
    }
    assert!(undecided > 1000, "the small budgets leave fates open: {undecided}");
}

#[test]
fn a_wrong_speed_among_many_is_an_error() {
    let fates = Fates::new(MassRatio::ONE).unwrap();
    assert_eq!(fates.fates_within(&[], 10), Ok(Vec::new()));
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        assert!(fates.fates_within(&[5.0, wrong], 10).is_err(), "{wrong}");
    }
}
