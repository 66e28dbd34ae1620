//! The same input gives the same bits on any machine.

use equations::{Formulas, Names, Series, TaylorFlow};

/// The hash of values, and of ends of motions. It was computed on an x86-64 machine, with the same result for the portable
/// build and for vectors of 256 and 512 bits.
const DIGEST: u64 = 0x883b_f3d4_a553_f2a5;

/// A step of FNV-1a over a 64-bit word.
fn mix(hash: u64, word: u64) -> u64 {
    (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3)
}

#[test]
fn values_and_motions_have_the_committed_bits() {
    let names = Names::new(&["x", "v"], &[("a", "0.7")]).unwrap();
    let texts = [
        "sin(a*x)*exp(-v) + atan2(x, v)",
        "sqrt(x + v^2)/(a + cosh(x*v)) + x^a + ln(x)*tanh(v)",
        "asin(x/9) + a^v + (x*v)^1.5 + atan(x)*acos(v/7) + tan(x)*asinh(v) - cos(x)^-3",
    ];
    let formulas = Formulas::from_text(names.clone(), &texts).unwrap();
    let field = ["v", "-sin(x) - 0.1*v + a*cos(1.3*t)*exp(-x^2)"];
    let field = Formulas::from_text(names, &field).unwrap();
    let series = Series::new(&field, None).unwrap();
    let flow = TaylorFlow::new(&series, 1e-12, 1e-12).unwrap();
    let share = |k: u64, factor: u64| (k.wrapping_mul(factor) >> 11) as f64 / (1u64 << 53) as f64;
    let starts = |factor| (1..=500).map(|k| 0.1 + 2.0 * share(k, factor)).collect::<Vec<f64>>();
    let columns = [starts(0x9e37_79b9_7f4a_7c15), starts(0xbf58_476d_1ce4_e5b9)];
    let columns = [&columns[0][..], &columns[1][..]];
    let values = formulas.columns(&[0.0], &columns).unwrap();
    let ends = flow.states_at(&[0.0], &columns, &[20.0]).unwrap();
    assert!(values.failed.is_empty() && ends.failed.is_empty());
    let all = values.values.iter().chain(&ends.values).flatten();
    let digest = all.fold(0xcbf2_9ce4_8422_2325, |hash, value| mix(hash, value.to_bits()));
    assert_eq!(digest, DIGEST, "{digest:#x}");
}
