//! The one file with unsafe code: calls of loops that are compiled for wider vectors.
//!
//! They are the same text, without fused multiply-adds, hence give the same bits. Which one runs is decided at
//! run time by what the processor has.
#![allow(unsafe_code)]

use crate::kernel::bulk::{self, Flights, Hops, Landings};
use crate::kernel::table::Stars;

/// A function that runs a loop, compiled for the widest vectors that the processor has.
macro_rules! widest {
    ($(#[$about:meta])* $name:ident = $body:path, ($($argument:ident: $of:ty),*)) => {
        $(#[$about])*
        pub(crate) fn $name($($argument: $of),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
                fn with_avx512($($argument: $of),*) {
                    $body($($argument),*);
                }
                #[target_feature(enable = "avx2")]
                fn with_avx2($($argument: $of),*) {
                    $body($($argument),*);
                }
                if is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw")
                {
                    // SAFETY: the processor has these instructions.
                    return unsafe { with_avx512($($argument),*) };
                }
                if is_x86_feature_detected!("avx2") {
                    // SAFETY: the processor has these instructions.
                    return unsafe { with_avx2($($argument),*) };
                }
            }
            $body($($argument),*);
        }
    };
}

widest!(
    /// See [`bulk::places`].
    places = bulk::places,
    (hops: &mut Hops, stars: &Stars, count: usize)
);
widest!(
    /// See [`bulk::land_slow`].
    slow_landings = bulk::land_slow,
    (list: &Flights, landings: &mut Landings, kappa: f64)
);
widest!(
    /// See [`bulk::land_fast`].
    fast_landings = bulk::land_fast,
    (list: &Flights, landings: &mut Landings, kappa: f64)
);
widest!(
    /// See [`bulk::ends`].
    ends = bulk::ends,
    (hops: &mut Hops, mu: f64, count: usize)
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::bulk::{BLOCK, Block};

    /// The widest and the plain loop, on the same flights, those without a landing among them.
    #[test]
    fn vectors_have_the_bits_of_single_numbers() {
        let mut list = Flights::EMPTY;
        for k in 0..BLOCK as u16 {
            let part = |step: f64| (f64::from(k + 1) * step).fract();
            let (x, v) = (20.0 * part(0.618_033_988_75), 60.0 * part(0.754_877_666_25) - 25.0);
            list.add(k, [if k % 50 == 7 { f64::NAN } else { x }, v, 1e-14]);
        }
        let (mut plain, mut wide) = (Block::EMPTY.landings, Block::EMPTY.landings);
        for kappa in [0.1, 0.5, 0.95] {
            bulk::land_slow(&list, &mut plain, kappa);
            slow_landings(&list, &mut wide, kappa);
            assert!(plain.same_bits(&wide));
            bulk::land_fast(&list, &mut plain, kappa);
            fast_landings(&list, &mut wide, kappa);
            assert!(plain.same_bits(&wide));
        }
    }
}
