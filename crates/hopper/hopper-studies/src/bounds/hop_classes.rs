//! The classes of hops on which bounds are measured.

use super::branch_changes::{Change, moved};
use basin_of_attraction::SplitMix64;
use passive_hopper::{LARGEST_LIFT_OFF_SPEED, alpha_star};
use std::f64::consts::PI;

/// A class of hops: a function from an index to a mass ratio and a speed.
#[derive(Debug, Clone, Copy)]
pub(super) struct HopClass {
    pub(super) name: &'static str,
    /// Its share of all hops, in percent.
    pub(super) percent: u64,
    /// M and α, from a random generator and the index of its first number for this hop.
    start: fn(&SplitMix64, u64) -> (f64, f64),
}

/// Random numbers of one hop. Classes that search use up to 48.
const NUMBERS_A_HOP: u64 = 64;

impl HopClass {
    /// (M, α) of hop `index`, the same for the same `seed`.
    pub(super) fn start(&self, seed: u64, index: u64) -> (f64, f64) {
        (self.start)(&SplitMix64::from_seed(seed), index * NUMBERS_A_HOP)
    }
}

/// All classes. The shares add up to 100 %: many hops where a hop is cheap, few where it takes milliseconds.
pub(super) const CLASSES: [HopClass; 12] = [
    HopClass { name: "paper's window", percent: 28, start: window },
    HopClass { name: "random", percent: 20, start: random_hop },
    HopClass { name: "small M", percent: 6, start: small_mass_ratio },
    HopClass { name: "large M", percent: 1, start: large_mass_ratio },
    HopClass { name: "chains", percent: 1, start: chain },
    HopClass { name: "small α", percent: 5, start: small_speed },
    HopClass { name: "large α", percent: 8, start: large_speed },
    HopClass { name: "next to α*_n", percent: 9, start: near_fixed_point },
    HopClass { name: "next to nπ", percent: 7, start: near_multiple_of_pi },
    HopClass {
        name: "next to a maximum",
        percent: 5,
        start: |r, k| Change::MaximumTest.near(r, k),
    },
    HopClass { name: "next to x′ = 0", percent: 5, start: |r, k| Change::Excess.near(r, k) },
    HopClass { name: "next to grounding", percent: 5, start: |r, k| Change::Grounding.near(r, k) },
];

/// `low` to `high`, uniform in the logarithm.
fn log_uniform(low: f64, high: f64, part: f64) -> f64 {
    low * pxfm::f_pow(high / low, part)
}

/// The window of the paper's Fig. 6.
fn window(random: &SplitMix64, k: u64) -> (f64, f64) {
    (0.1 + 0.9 * random.uniform(k), 4.5 + 15.5 * random.uniform(k + 1))
}

/// M on both sides of 1, all speeds of the tables.
fn random_hop(random: &SplitMix64, k: u64) -> (f64, f64) {
    (log_uniform(0.01, 30.0, random.uniform(k)), 0.01 + 110.0 * random.uniform(k + 1))
}

fn small_mass_ratio(random: &SplitMix64, k: u64) -> (f64, f64) {
    (log_uniform(1e-18, 0.01, random.uniform(k)), 0.01 + 110.0 * random.uniform(k + 1))
}

/// Half of the speeds are just above nπ, where x′ of the first landing is small.
fn large_mass_ratio(random: &SplitMix64, k: u64) -> (f64, f64) {
    let mass_ratio = log_uniform(3.0, 1e4, random.uniform(k));
    let n = 1.0 + (12.0 * random.uniform(k + 1)).floor();
    let near =
        if random.uniform(k + 2) < 0.5 { 1.0 } else { pxfm::f_exp10(-6.0 * random.uniform(k + 3)) };
    (mass_ratio, n * PI + near * random.uniform(k + 4) * (alpha_star(n as u64) - n * PI))
}

/// Chains of sudden lift-offs. At large M a flight from V near mπ lands nearly in the state of its start, and this
/// state attracts others for x < 1. A chain in the first window has up to M/10 flights, one in window n up to
/// M/(nπ)².
fn chain(random: &SplitMix64, k: u64) -> (f64, f64) {
    let n = if random.uniform(k) < 0.7 { 1.0 } else { 2.0 };
    let width = alpha_star(n as u64) - n * PI;
    (log_uniform(50.0, 1e4, random.uniform(k + 1)), n * PI + width * random.uniform(k + 2))
}

fn small_speed(random: &SplitMix64, k: u64) -> (f64, f64) {
    (log_uniform(1e-3, 1e3, random.uniform(k)), log_uniform(1e-150, 0.1, random.uniform(k + 1)))
}

/// Above the tables, up to the largest speed.
fn large_speed(random: &SplitMix64, k: u64) -> (f64, f64) {
    let speed = log_uniform(100.0, LARGEST_LIFT_OFF_SPEED, random.uniform(k + 1));
    (log_uniform(0.01, 3.0, random.uniform(k)), speed)
}

/// n ≥ 1: small numbers mostly, and some up to 10⁶.
fn index(random: &SplitMix64, k: u64) -> u64 {
    let part = random.uniform(k + 1);
    if random.uniform(k) < 0.8 {
        1 + (40.0 * part) as u64
    } else {
        log_uniform(1.0, 1e6, part) as u64
    }
}

/// Up to 2⁴⁰ ulps, 2⁻¹² of α, on either side.
fn near_fixed_point(random: &SplitMix64, k: u64) -> (f64, f64) {
    let star = alpha_star(index(random, k));
    let speed = moved(star, random.uniform(k + 2), random.uniform(k + 3));
    (log_uniform(0.01, 10.0, random.uniform(k + 4)), speed)
}

/// Up to 2⁴⁰ ulps on either side.
fn near_multiple_of_pi(random: &SplitMix64, k: u64) -> (f64, f64) {
    let multiple = index(random, k) as f64 * PI;
    let speed = moved(multiple, random.uniform(k + 2), random.uniform(k + 3));
    (log_uniform(0.01, 10.0, random.uniform(k + 4)), speed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::{LiftOffMap, MassRatio};

    #[test]
    fn the_shares_add_up() {
        assert_eq!(CLASSES.iter().map(|class| class.percent).sum::<u64>(), 100);
    }

    #[test]
    fn every_start_of_every_class_is_valid_and_repeats() {
        for class in &CLASSES {
            for index in 0..50 {
                let (m, alpha) = class.start(1, index);
                assert!(alpha > 0.0 && alpha <= LARGEST_LIFT_OFF_SPEED, "{} {alpha}", class.name);
                assert!(MassRatio::new(m).is_ok());
                assert_eq!(class.start(1, index), (m, alpha));
                assert_ne!(class.start(2, index), (m, alpha));
            }
        }
    }

    /// Chains are long; next to a change of branch most hops leave the kernel.
    #[test]
    fn classes_contain_what_their_names_say() {
        let sudden = |name: &str, index| {
            let class = CLASSES.iter().find(|class| class.name == name).unwrap();
            let (m, alpha) = class.start(3, index);
            LiftOffMap::new(MassRatio::new(m).unwrap()).hop(alpha).unwrap().sudden
        };
        // Longer than the 64 flights of the kernel.
        assert!((0..100).filter(|&k| sudden("chains", k) > 64).count() > 3);
        assert!((0..100).filter(|&k| sudden("next to x′ = 0", k) > 0).count() > 50);
        assert!((0..100).all(|k| sudden("small α", k) == 0));
    }
}
