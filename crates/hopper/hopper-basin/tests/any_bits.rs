//! The body of the fuzz target `any_bits` as a property test.

use proptest::prelude::*;

mod body {
    include!("any_bits/body.rs");
}

fn word() -> impl Strategy<Value = u64> {
    prop_oneof![
        any::<u64>(),
        // Most bit patterns are numbers far from 1. Therefore numbers of ordinary size and small integers are drawn as
        // well.
        (-4.0..4.0f64, any::<bool>()).prop_map(|(exponent, negative)| {
            let size = 10f64.powf(exponent);
            (if negative { -size } else { size }).to_bits()
        }),
        0..2000u64,
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn no_function_panics_or_hangs(words in proptest::array::uniform6(word())) {
        body::try_all(words);
    }
}
