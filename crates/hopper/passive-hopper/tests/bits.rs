//! The same input gives the same bits on any machine, with any number of threads.

use passive_hopper::{LiftOffMap, MassRatio};

/// The hash of a million hops: α′, loss and number of sudden lift-offs, with zeros for a grounded hopper.
///
/// M in [1/64, 64) and α in (0, 60) come from a fixed sequence of products. The hash is FNV-1a, first over each of ten
/// parts, then over the hashes of the parts. The value was computed on an x86-64 machine, with the same result for the
/// portable build and for `-C target-cpu=native` (fused multiply-add, AVX-512).
const MILLION_HOPS: u64 = 0x931d_5628_a17e_827d;

const PARTS: u64 = 10;
const SIZE: u64 = 100_000;

/// A step of FNV-1a over a 64-bit word. `resumable_job::digest` steps over bytes: its digest of the same numbers
/// differs.
fn mix(hash: u64, word: u64) -> u64 {
    (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3)
}

fn part(number: u64) -> u64 {
    let share = |k: u64, factor: u64| (k.wrapping_mul(factor) >> 11) as f64 / (1u64 << 53) as f64;
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for k in number * SIZE + 1..=(number + 1) * SIZE {
        // A power of two times a number in [1, 2): the inputs need no elementary function.
        let power = (k % 12) as i32 - 6;
        let m = 2f64.powi(power) * (1.0 + share(k, 0x9e37_79b9_7f4a_7c15));
        let alpha = 60.0 * share(k, 0xbf58_476d_1ce4_e5b9) + 1e-9;
        let hop = LiftOffMap::new(MassRatio::new(m).unwrap()).hop(alpha).unwrap();
        for word in [
            hop.next.unwrap_or(0.0).to_bits(),
            hop.loss.unwrap_or(0.0).to_bits(),
            hop.sudden as u64,
        ] {
            hash = mix(hash, word);
        }
    }
    hash
}

fn hash(threads: u64) -> u64 {
    let parts = std::thread::scope(|scope| {
        let work = |first: u64| {
            move || {
                (first..PARTS).step_by(threads as usize).map(|k| (k, part(k))).collect::<Vec<_>>()
            }
        };
        let running: Vec<_> = (0..threads).map(|first| scope.spawn(work(first))).collect();
        let mut parts: Vec<(u64, u64)> =
            running.into_iter().flat_map(|thread| thread.join().unwrap()).collect();
        parts.sort_unstable();
        parts
    });
    parts.into_iter().fold(0, |hash, (_, part)| mix(hash, part))
}

#[test]
fn a_million_hops_have_the_committed_bits() {
    for threads in [1, 3] {
        let hash = hash(threads);
        assert_eq!(hash, MILLION_HOPS, "{threads} threads: {hash:#x}");
    }
}

/// The Python package has the same hash of the same images (`crates/both/python-package/tests/test_map.py`).
#[test]
fn images_in_arrays_have_the_committed_bits() {
    let map = LiftOffMap::new(MassRatio::new(0.2).unwrap());
    let speeds: Vec<f64> = (0..100_000).map(|k| 4.5 + f64::from(k) * 2f64.powi(-13)).collect();
    let mut images = vec![0.0; speeds.len()];
    map.images_into(&speeds, &mut images).unwrap();
    let words = images.iter().map(|image| if image.is_nan() { 0 } else { image.to_bits() });
    assert_eq!(words.fold(0xcbf2_9ce4_8422_2325, mix), 0x242d_58af_4f60_2311);
}
