//! The one file with unsafe code: calls of loops that are compiled for wider vectors.
//!
//! They are the same text, without fused multiply-adds, hence give the same bits. Which one runs is decided at
//! run time by what the processor has.
#![allow(unsafe_code)]

use crate::kernel::batch::bulk::{self, Hops};
use crate::kernel::batch::landings::{self, Flights, Landings};
use crate::landing::first_flight_table::{CELLS, Cell, OneByOne, Stars};
#[cfg(target_arch = "x86_64")]
use crate::landing::first_flight_table::{Eight, Piece};

#[cfg(target_arch = "x86_64")]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512bw")
}

/// A function compiled for the best instructions that the processor has: `$body`, and with AVX-512 `$eight`.
macro_rules! best {
    (
        $(#[$about:meta])*
        $name:ident = $body:path | $eight:path,
        ($($argument:ident: $of:ty),*)
    ) => {
        $(#[$about])*
        pub(crate) fn $name($($argument: $of),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
                fn with_avx512($($argument: $of),*) {
                    $eight($($argument),*);
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

best!(
    /// See [`bulk::places`].
    places = bulk::places | bulk::places,
    (hops: &mut Hops, stars: &Stars, count: usize)
);
best!(
    /// See [`bulk::first`].
    first_flights = bulk::first::<OneByOne> | bulk::first::<Turned>,
    (hops: &mut Hops, cells: &[&Cell; CELLS], list: &mut Flights, count: usize)
);
best!(
    /// See [`landings::land_slow`].
    slow_landings = landings::land_slow | landings::land_slow,
    (list: &Flights, landings: &mut Landings)
);
best!(
    /// See [`landings::land_fast`].
    fast_landings = landings::land_fast | landings::land_fast,
    (list: &Flights, landings: &mut Landings)
);
best!(
    /// See [`bulk::ends`].
    ends = bulk::ends | bulk::ends,
    (hops: &mut Hops, count: usize)
);

/// Eight rows of coefficients turned into columns, for AVX-512.
#[cfg(target_arch = "x86_64")]
struct Turned;

#[cfg(target_arch = "x86_64")]
impl Eight for Turned {
    #[inline(always)]
    fn polynomials(rows: [&Piece; 8], at: &[f64; 8]) -> [f64; 8] {
        // SAFETY: only `first_flights` uses this type, where the processor has these instructions.
        unsafe { turned(rows, at) }
    }
}

/// See [`Turned`]; the sums are those of a single polynomial.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
fn turned(rows: [&Piece; 8], at: &[f64; 8]) -> [f64; 8] {
    use std::arch::x86_64::*;
    // SAFETY: eight numbers each.
    let row = |k: usize| unsafe { _mm512_loadu_pd(rows[k].as_ptr()) };
    let x = unsafe { _mm512_loadu_pd(at.as_ptr()) };
    // Pairs of rows: coefficients 0, 2, 4, 6 and 1, 3, 5, 7, of both rows in turn.
    let pair = |a, b| (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
    let (p, q) = (pair(row(0), row(1)), pair(row(2), row(3)));
    let (s, t) = (pair(row(4), row(5)), pair(row(6), row(7)));
    // Of four pairs of a kind: (0, 4) and (2, 6) of two pairs of rows each, then of all rows.
    let columns = |a, b, c, d| {
        let (ab, cd) = (_mm512_shuffle_f64x2::<0x88>(a, b), _mm512_shuffle_f64x2::<0x88>(c, d));
        let (ef, gh) = (_mm512_shuffle_f64x2::<0xdd>(a, b), _mm512_shuffle_f64x2::<0xdd>(c, d));
        (
            _mm512_shuffle_f64x2::<0x88>(ab, cd),
            _mm512_shuffle_f64x2::<0x88>(ef, gh),
            _mm512_shuffle_f64x2::<0xdd>(ab, cd),
            _mm512_shuffle_f64x2::<0xdd>(ef, gh),
        )
    };
    let (c0, c2, c4, c6) = columns(p.0, q.0, s.0, t.0);
    let (c1, c3, c5, c7) = columns(p.1, q.1, s.1, t.1);
    let linear = |a, b| _mm512_add_pd(a, _mm512_mul_pd(b, x));
    let square = _mm512_mul_pd(x, x);
    let fourth = _mm512_mul_pd(square, square);
    let cubic = |a, b| _mm512_add_pd(a, _mm512_mul_pd(square, b));
    let low = cubic(linear(c0, c1), linear(c2, c3));
    let high = cubic(linear(c4, c5), linear(c6, c7));
    let mut sums = [0.0; 8];
    // SAFETY: eight numbers.
    unsafe { _mm512_storeu_pd(sums.as_mut_ptr(), _mm512_add_pd(low, _mm512_mul_pd(fourth, high))) };
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::batch::bulk::BLOCK;

    /// Eight polynomials by columns, and one by one.
    #[cfg(target_arch = "x86_64")]
    #[test]
    fn columns_have_the_bits_of_rows() {
        if !has_avx512() {
            return;
        }
        let part = |k: usize, step: f64| 2.0 * (k as f64 * step).fract() - 1.0;
        let rows: [Piece; 8] =
            std::array::from_fn(|k| std::array::from_fn(|j| part(8 * k + j + 1, 0.618)));
        let at = std::array::from_fn(|k| part(k, 0.754));
        assert_eq!(
            Turned::polynomials(rows.each_ref(), &at),
            OneByOne::polynomials(rows.each_ref(), &at)
        );
    }

    /// The widest and the plain loop, on the same flights, those without a landing among them.
    #[test]
    fn vectors_have_the_bits_of_single_numbers() {
        let mut list = Flights::EMPTY;
        for k in 0..BLOCK as u16 {
            let part = |step: f64| (f64::from(k + 1) * step).fract();
            let (x, v) = (20.0 * part(0.618_033_988_75), 60.0 * part(0.754_877_666_25) - 25.0);
            let kappa = part(0.569_840_290_998);
            list.add(k, [if k % 50 == 7 { f64::NAN } else { x }, v, 1e-14, kappa]);
        }
        let (mut plain, mut wide) = (Landings::EMPTY, Landings::EMPTY);
        landings::land_slow(&list, &mut plain);
        slow_landings(&list, &mut wide);
        assert!(plain.same_bits(&wide));
        landings::land_fast(&list, &mut plain);
        fast_landings(&list, &mut wide);
        assert!(plain.same_bits(&wide));
    }
}
