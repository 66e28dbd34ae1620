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

/// Some, many, and a part of many at the end; where a state has no value; values, and several steps of a map at once.
#[test]
fn values_at_any_number_of_states_have_the_bits_of_one() {
    let names = Names::new(&["x", "y"], &[("a", "0.9")]).unwrap();
    let map = Formulas::from_text(names, &["sqrt(x) - a*y^2", "x/(y - 0.25) + sin(x)"]).unwrap();
    for count in [1, 7, 8, 9, 31, 32, 33, 100] {
        let at = |k: usize, by: f64| ((k + 1) as f64 * by).fract() - 0.1;
        let starts: Vec<[f64; 2]> =
            (0..count).map(|k| [at(k, 0.618_033_988_75), at(k, 0.754_877_666_25)]).collect();
        let columns = [0, 1].map(|axis| starts.iter().map(|at| at[axis]).collect::<Vec<f64>>());
        let found = map.columns(&[0.0], &[&columns[0], &columns[1]]).unwrap();
        for (k, start) in starts.iter().enumerate() {
            let own = found.values.iter().map(|column| column[k].to_bits());
            match map.values(0.0, start) {
                Ok(alone) => assert!(own.eq(alone.iter().map(|x| x.to_bits())), "{start:?}"),
                Err(error) => assert!(found.failed.contains(&(k, error)), "{start:?}"),
            }
        }
        for steps in [1, 3] {
            let mut columns = [0, 1].map(|axis| starts.iter().map(|at| at[axis]).collect());
            let mut has_value = vec![false; count];
            map.map_columns(0.0, &mut columns, steps, &mut has_value).unwrap();
            for (k, start) in starts.iter().enumerate() {
                let step = |at: Option<Vec<f64>>, _| map.values(0.0, &at?).ok();
                let alone = (0..steps).fold(Some(start.to_vec()), step);
                assert_eq!(has_value[k], alone.is_some(), "{start:?}");
                let bits = |at: &[f64]| at.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                if let Some(alone) = alone {
                    assert_eq!(bits(&[columns[0][k], columns[1][k]]), bits(&alone), "{start:?}");
                }
            }
        }
    }
}
