//! Fates at mass ratios some ulps beside a crisis: whether the hump falls through is not known to `f64`, and no
//! fate says otherwise.

use basin_of_attraction::SplitMix64;
use hopper_basin::{Fates, HopperFate, crisis};
use passive_hopper::{Arithmetic, ExtendedOrbit, MassRatio, alpha_star};

/// The fates at the crisis of hump n or at its inverse, and at `ulps` mass ratios on both sides of it.
fn beside_crisis(n: u64, inverse: bool, ulps: usize) -> Vec<Fates> {
    let crisis = crisis(n).unwrap().mass_ratio;
    let mut m = if inverse { 1.0 / crisis } else { crisis };
    (0..ulps).for_each(|_| m = m.next_down());
    let all = std::iter::successors(Some(m), |m| Some(m.next_up())).take(2 * ulps + 1);
    all.map(|m| Fates::new(MassRatio::new(m).unwrap()).unwrap()).collect()
}

/// At the touch f differs from α*_n by 10⁻¹⁶, and its sign decides the fate. It is known in 200 bits.
#[test]
fn no_fate_at_a_touch_is_wrong() {
    let (mut below, mut decided) = (0, 0);
    for (n, inverse) in [(1, false), (2, false), (2, true), (3, true), (50, false)] {
        let touch = crisis(n).unwrap().alpha;
        for fates in beside_crisis(n, inverse, 5) {
            let speeds = [-2e-9, 0.0, 2e-9].map(|aside| touch + aside);
            let labels = fates.labels(&speeds).unwrap();
            for (speed, label) in speeds.into_iter().zip(labels) {
                let bits = Arithmetic::ALL[1];
                let mut orbit = ExtendedOrbit::new(fates.map(), speed, bits).unwrap();
                orbit.hop().unwrap();
                let (offset, error) = orbit.offset_from(n);
                assert!(offset.abs() > error);
                below += usize::from(offset < 0.0);
                let stays = HopperFate::label_of_fixed_point(n);
                for label in [label, fates.fate(speed).unwrap().label()] {
                    decided += usize::from(label.is_decided());
                    let m = fates.map().mass_ratio();
                    let right = label.is_undecided() || (label == stays) == (offset > 0.0);
                    assert!(right, "{n} {m:?} {speed:?} {label} {offset:e}");
                }
            }
        }
    }
    assert!(below > 40 && decided > 300, "{below} {decided}");
}

/// A speed is in the trap, or its image is, unless it is next to the touch. So no orbit is followed far towards its
/// fixed point.
#[test]
fn beside_a_crisis_orbits_are_not_followed_to_their_fixed_point() {
    let random = SplitMix64::from_seed(3);
    for (n, inverse) in [(1, false), (1, true), (4, true)] {
        for fates in beside_crisis(n, inverse, 2) {
            let (left, right) = (alpha_star(n), alpha_star(n + 1));
            let speeds: Vec<f64> =
                (0..500).map(|k| left + (right - left) * random.uniform(k)).collect();
            for (fate, hops) in fates.fates_within(&speeds, 1000).unwrap() {
                assert!(!fate.label().is_undecided() && hops < 100, "{n} {fate:?} {hops}");
            }
        }
    }
}
