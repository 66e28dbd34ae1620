//! The same input gives the same bits on any machine.

#![allow(missing_docs, clippy::unwrap_used)]

use passive_hopper::{LiftOffMap, MassRatio};

/// FNV-1a over the bits of a million images, M in [1/64, 64) and α in (0, 60) from a fixed sequence
/// of products, with the grounded hops as zeros.
///
/// Computed on an x86-64 machine, by the portable build and by one with `-C target-cpu=native`
/// (fused multiply-add, AVX-512).
const MILLION_HOPS: u64 = 0x5406_a716_2cad_90a2;

#[test]
fn a_million_hops_have_the_committed_bits() {
    let part = |k: u64, factor: u64| (k.wrapping_mul(factor) >> 11) as f64 / (1u64 << 53) as f64;
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for k in 1..=1_000_000u64 {
        // A power of two times a number in [1, 2): no elementary function in the inputs.
        let power = (k % 12) as i32 - 6;
        let m = 2f64.powi(power) * (1.0 + part(k, 0x9e37_79b9_7f4a_7c15));
        let alpha = 60.0 * part(k, 0xbf58_476d_1ce4_e5b9) + 1e-9;
        let hop = LiftOffMap::new(MassRatio::new(m).unwrap()).hop(alpha).unwrap();
        for word in [hop.next.unwrap_or(0.0).to_bits(), hop.sudden as u64] {
            hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    assert_eq!(hash, MILLION_HOPS, "{hash:#x}");
}
