//! The loops of a batch, compiled for wider vectors. This is the one file with unsafe code.
//!
//! Each loop is compiled three times from the same source: for AVX-512, for AVX2, and for the instructions that every
//! processor of the target has. No version uses fused multiply-adds, so that all give the same bits (I1). The version
//! is chosen at run time by the features of the processor.
#![allow(unsafe_code)]

use crate::kernel::batch::hop_rows::{self, HopRows};
use crate::kernel::batch::later_flights::{self, FlightEnds, FlightList};
use crate::landing::first_flight_table::{FirstFlightTable, FixedPoints, TABLES};

#[cfg(target_arch = "x86_64")]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512bw")
}

/// Defines a function that runs `$body` compiled for the widest vectors of the processor.
///
/// `$body` and all functions that it calls are `#[inline(always)]`. Otherwise they would not be compiled with these
/// instructions.
macro_rules! for_widest_vectors {
    ($(#[$about:meta])* $name:ident = $body:expr, ($($argument:ident: $of:ty),*)) => {
        $(#[$about])*
        pub(crate) fn $name($($argument: $of),*) {
            #[cfg(target_arch = "x86_64")]
            {
                // The four parts of AVX-512 that the compiler uses in these loops. All four are asked for.
                #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
                fn with_avx512($($argument: $of),*) {
                    $body($($argument),*);
                }
                #[target_feature(enable = "avx2")]
                fn with_avx2($($argument: $of),*) {
                    $body($($argument),*);
                }
                if has_avx512() {
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

for_widest_vectors!(
    /// See [`hop_rows::find_positions`].
    find_positions = hop_rows::find_positions,
    (hops: &mut HopRows, fixed_points: &FixedPoints, count: usize)
);
for_widest_vectors!(
    /// See [`hop_rows::first_flights`].
    first_flights = hop_rows::first_flights::<false>,
    (hops: &mut HopRows, tables: &[&FirstFlightTable; TABLES], list: &mut FlightList, count: usize)
);
for_widest_vectors!(
    /// See [`hop_rows::first_flights`].
    first_flights_within = hop_rows::first_flights::<true>,
    (hops: &mut HopRows, tables: &[&FirstFlightTable; TABLES], list: &mut FlightList, count: usize)
);
for_widest_vectors!(
    /// See [`hop_rows::end_hops_within`].
    end_hops_within = hop_rows::end_hops_within,
    (hops: &mut HopRows, count: usize)
);
for_widest_vectors!(
    /// See [`later_flights::land_below_pi`].
    land_below_pi = later_flights::land_below_pi,
    (list: &FlightList, ends: &mut FlightEnds)
);
for_widest_vectors!(
    /// See [`later_flights::land_from_pi`].
    land_from_pi = later_flights::land_from_pi,
    (list: &FlightList, ends: &mut FlightEnds)
);
for_widest_vectors!(
    /// See [`hop_rows::end_hops`].
    end_hops = hop_rows::end_hops,
    (hops: &mut HopRows, count: usize)
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::batch::rows::BLOCK;
    use crate::kernel::scalar::ground_state::GroundState;

    /// The loops for the widest vectors and the plain loops give the same bits, also for flights without a landing.
    #[test]
    fn vectors_have_the_bits_of_single_numbers() {
        let mut list = FlightList::EMPTY;
        for k in 0..BLOCK as u16 {
            let part = |step: f64| (f64::from(k + 1) * step).fract();
            let (x, v) = (20.0 * part(0.618_033_988_75), 60.0 * part(0.754_877_666_25) - 25.0);
            let kappa = part(0.569_840_290_998);
            let excess = if k % 50 == 7 { f64::NAN } else { x };
            list.push(k, &GroundState { excess, velocity: v, error: 1e-14 }, kappa);
        }
        let (mut plain, mut wide) = (FlightEnds::EMPTY, FlightEnds::EMPTY);
        later_flights::land_below_pi(&list, &mut plain);
        land_below_pi(&list, &mut wide);
        assert!(plain.has_bits_of(&wide));
        later_flights::land_from_pi(&list, &mut plain);
        land_from_pi(&list, &mut wide);
        assert!(plain.has_bits_of(&wide));
    }
}
