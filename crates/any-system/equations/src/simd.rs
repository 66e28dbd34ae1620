//! A step of some states, and the values of formulas there, compiled for wider vectors. This is the one file of the crate with unsafe code.
//!
//! It is compiled three times from the same source: for AVX-512, for AVX2, and for the instructions that every processor of
//! the target has. No version uses fused multiply-adds, so that all give the same bits: they would save 0 to 12 % here, and
//! take two to three times as long where a processor lacks them. The version is chosen at run time by the features of the
//! processor.
#![allow(unsafe_code)]

use crate::columns;
use crate::formulas::Formulas;
use crate::lanes::{Lanes, MANY};
use crate::side_by_side;
use crate::step::Step;
use crate::taylor_flow::TaylorFlow;

/// A function that is compiled with wider vectors, and chosen by the processor. All that it calls is compiled with them, as it is always
/// inlined.
macro_rules! compiled_for_vectors {
    ($(#[$doc:meta])* $name:ident = $plain:path, ($($argument:ident: $type:ty),*) -> $result:ty, $wide:ident) => {
        #[cfg(target_arch = "x86_64")]
        mod $wide {
            use super::*;
            // The four parts of AVX-512 that the compiler uses in these loops. All four are asked for.
            #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
            pub(super) fn with_avx512($($argument: $type),*) -> $result {
                $plain($($argument),*)
            }

            #[target_feature(enable = "avx2")]
            pub(super) fn with_avx2($($argument: $type),*) -> $result {
                $plain($($argument),*)
            }
        }

        $(#[$doc])*
        pub(crate) fn $name($($argument: $type),*) -> $result {
            #[cfg(target_arch = "x86_64")]
            {
                if is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw")
                {
                    // SAFETY: the processor has these instructions.
                    return unsafe { $wide::with_avx512($($argument),*) };
                }
                if is_x86_feature_detected!("avx2") {
                    // SAFETY: the processor has these instructions.
                    return unsafe { $wide::with_avx2($($argument),*) };
                }
            }
            $plain($($argument),*)
        }
    };
}

compiled_for_vectors!(
    /// See [`side_by_side::step_of_lanes`].
    step_of_lanes = side_by_side::step_of_lanes,
    (flow: &TaylorFlow<'_>, times: (Lanes, Lanes), state: &[Lanes], step: &mut Step<Lanes>) -> Lanes,
    wide_steps
);

compiled_for_vectors!(
    /// See [`columns::values_of_lanes`].
    values_of_lanes = columns::values_of_lanes,
    (formulas: &Formulas, time: &Lanes, state: &[Lanes], parts: &mut [Lanes]) -> Lanes,
    wide_values
);

compiled_for_vectors!(
    /// See [`columns::values_of_lanes`].
    values_of_many_lanes = columns::values_of_lanes,
    (
        formulas: &Formulas,
        time: &Lanes<MANY>,
        state: &[Lanes<MANY>],
        parts: &mut [Lanes<MANY>]
    ) -> Lanes<MANY>,
    wide_values_of_many
);

compiled_for_vectors!(
    /// See [`columns::images_of_lanes`].
    images_of_lanes = columns::images_of_lanes,
    (formulas: &Formulas, time: &Lanes, state: &mut [Lanes], parts: &mut [Lanes], steps: usize) -> Lanes,
    wide_images
);

compiled_for_vectors!(
    /// See [`columns::images_of_lanes`].
    images_of_many_lanes = columns::images_of_lanes,
    (
        formulas: &Formulas,
        time: &Lanes<MANY>,
        state: &mut [Lanes<MANY>],
        parts: &mut [Lanes<MANY>],
        steps: usize
    ) -> Lanes<MANY>,
    wide_images_of_many
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::memory;
    use crate::{Formulas, Names, Series};

    /// The steps for the widest vectors and the plain ones have the same bits, also of states without a step.
    #[test]
    fn vectors_have_the_bits_of_single_numbers() {
        let names = Names::new(&["x", "v"], &[("c", "0.1")]).unwrap();
        let field = Formulas::from_text(names, &["v", "-sin(x) - c*v/(1 + sqrt(x)^3)"]).unwrap();
        let series = Series::new(&field, None).unwrap();
        for relative in [1e-3, 1e-9, 1e-16] {
            let flow = TaylorFlow::new(&series, relative, 1e-12).unwrap();
            let part = |k: usize, step: f64| ((k + 1) as f64 * step).fract();
            let state = [0.618_033_988_75, 0.754_877_666_25]
                .map(|step| Lanes(std::array::from_fn(|k| 3.0 * part(k, step) - 0.1)));
            let times = (Lanes([0.0; 8]), Lanes(std::array::from_fn(|k| 4.0 - k as f64)));
            let bits = |step: &dyn Fn(&mut Step<Lanes>) -> Lanes| {
                let mut memory = memory::<Lanes>(&series, flow.order()).unwrap();
                let right = step(&mut memory);
                let numbers = [right, memory.end].into_iter().chain(memory.state_at_end);
                numbers.map(|lanes| lanes.0.map(f64::to_bits)).collect::<Vec<_>>()
            };
            let plain = bits(&|step| side_by_side::step_of_lanes(&flow, times, &state, step));
            assert_eq!(bits(&|step| step_of_lanes(&flow, times, &state, step)), plain);
            #[cfg(target_arch = "x86_64")]
            if is_x86_feature_detected!("avx2") {
                // SAFETY: the processor has these instructions.
                let with_avx2 =
                    |step: &mut _| unsafe { wide_steps::with_avx2(&flow, times, &state, step) };
                assert_eq!(bits(&with_avx2), plain);
            }
        }
    }
}
