//! A step of some states, compiled for wider vectors. This is the one file of the crate with unsafe code.
//!
//! No version uses fused multiply-adds, so that all give the same bits. The version is chosen at run time by the features of
//! the processor.
#![allow(unsafe_code)]

use crate::lanes::Lanes;
use crate::many_starts;
use crate::step::Step;
use crate::taylor_flow::TaylorFlow;

/// See [`many_starts::step_of_lanes`]. All that it calls is compiled with these instructions, as it is always inlined.
pub(crate) fn step_of_lanes(
    flow: &TaylorFlow<'_>,
    times: (Lanes, Lanes),
    state: &[Lanes],
    step: &mut Step<Lanes>,
) -> Lanes {
    #[cfg(target_arch = "x86_64")]
    {
        // The four parts of AVX-512 that the compiler uses in these loops. All four are asked for.
        #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
        fn with_avx512(
            flow: &TaylorFlow<'_>,
            times: (Lanes, Lanes),
            state: &[Lanes],
            step: &mut Step<Lanes>,
        ) -> Lanes {
            many_starts::step_of_lanes(flow, times, state, step)
        }
        #[target_feature(enable = "avx2")]
        fn with_avx2(
            flow: &TaylorFlow<'_>,
            times: (Lanes, Lanes),
            state: &[Lanes],
            step: &mut Step<Lanes>,
        ) -> Lanes {
            many_starts::step_of_lanes(flow, times, state, step)
        }
        if is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512bw")
        {
            // SAFETY: the processor has these instructions.
            return unsafe { with_avx512(flow, times, state, step) };
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has these instructions.
            return unsafe { with_avx2(flow, times, state, step) };
        }
    }
    many_starts::step_of_lanes(flow, times, state, step)
}
