//! Every function against dashu-float, whose results are correctly rounded.
//!
//! A million arguments of each function in 256 bits, fewer in 512 and 1024 bits: the code is the same for all lengths.
//! A sine of dashu-float takes 75 µs and more. Therefore the sines of a million sums a + b are computed from the sines
//! of 2000 numbers a and 2000 numbers b by the addition theorem, in dashu-float's arithmetic with 128 bits more than
//! ours.
//!
//! The largest errors found, in units of 2^(−64 W): 2 for sums and products, 3.7 for quotients and roots, 36 (1 +
//! |x|) for sines and cosines, 0.6 for π.

#[cfg(test)]
mod tests {
    use crate::precision::long::{Long, MOST};
    use crate::precision::real::{Extended, Real};
    use basin_of_attraction::SplitMix64;
    use dashu_float::{FBig, round::mode::HalfEven};

    type Reference = FBig<HalfEven, 2>;

    /// Binary logarithm of the largest relative error of a sum or product, in units of 2^(−64 W). The error of a
    /// truncated mantissa is less than 1 unit, and the mantissa is at least ½.
    const SUM_ERROR: isize = 1;

    /// As [`SUM_ERROR`], for a quotient or root by Newton's method, whose last step has several truncations. Measured,
    /// not derived.
    const QUOTIENT_ERROR: isize = 3;

    /// As [`SUM_ERROR`], for a sine or cosine: the EPSILON that the traits promise.
    const SINE_ERROR: isize = 12;

    /// Bits of the reference beyond those of a [`Long`].
    const MORE_BITS: usize = 128;

    /// Random words, one after the other.
    struct Random {
        generator: SplitMix64,
        drawn: u64,
    }

    impl Random {
        fn new(state: u64) -> Self {
            Random { generator: SplitMix64::from_state(state), drawn: 0 }
        }

        fn word(&mut self) -> u64 {
            self.drawn += 1;
            self.generator.bits(self.drawn)
        }

        /// A number with random bits. Every fourth has words of zeros or ones, where a carry runs through many words.
        fn long<const W: usize>(&mut self, exponents: i64) -> Long<W> {
            let mut words = [0; W];
            let special = self.word().is_multiple_of(4);
            for word in &mut words {
                let bits = self.word();
                *word = match bits % 3 {
                    0 if special => 0,
                    1 if special => u64::MAX,
                    _ => bits,
                };
            }
            words[W - 1] |= 1 << 63;
            let exponent = (self.word() % (2 * exponents + 1) as u64) as i64 - exponents;
            Long { negative: self.word().is_multiple_of(2), exponent, words }
        }
    }

    /// The same number, to at least `MORE_BITS` bits more.
    fn reference<const W: usize>(x: &Long<W>) -> Reference {
        let mut sum = Reference::ZERO.with_precision(64 * W + MORE_BITS).value();
        for pair in x.words.rchunks(2) {
            let two = pair.iter().rev().fold(0, |two, &word| two << 64 | u128::from(word));
            sum = (sum << 128) + Reference::from(two);
        }
        let size = sum << (x.exponent - 64 * W as i64) as isize;
        if x.negative { -size } else { size }
    }

    fn size(x: Reference) -> Reference {
        if x < Reference::ZERO { -x } else { x }
    }

    /// Whether `found` differs from `exact` by at most 2^`error` units of |`scale`| 2^(−64 W).
    fn near<const W: usize>(
        found: &Long<W>,
        exact: &Reference,
        scale: &Reference,
        error: isize,
    ) -> bool {
        size(reference(found) - exact) <= size(scale.clone()) << (error - 64 * W as isize)
    }

    fn operations<const W: usize>(seed: u64, count: usize) {
        let mut random = Random::new(seed);
        for _ in 0..count {
            // Half of the pairs have nearly the same exponent, so that differences cancel.
            let range = if random.word().is_multiple_of(2) { 1 } else { 80 * W as i64 };
            let (a, b): (Long<W>, Long<W>) = (random.long(range), random.long(range));
            let (x, y) = (reference(&a), reference(&b));
            let (sum, difference) = (&x + &y, &x - &y);
            assert!(near(&(a + b), &sum, &sum, SUM_ERROR), "{a:?} + {b:?}");
            assert!(near(&(a - b), &difference, &difference, SUM_ERROR), "{a:?} − {b:?}");
            let product = &x * &y;
            assert!(near(&(a * b), &product, &product, SUM_ERROR), "{a:?} × {b:?}");
            let quotient = &x / &y;
            assert!(near(&(a / b), &quotient, &quotient, QUOTIENT_ERROR), "{a:?} / {b:?}");
            let (positive, x) = (Long { negative: false, ..a }, size(x));
            let root = x.sqrt();
            assert!(near(&positive.sqrt(), &root, &root, QUOTIENT_ERROR), "√{a:?}");
        }
    }

    /// sin and cos of all sums of `count` numbers and `count` more.
    fn sines<const W: usize>(seed: u64, count: usize) {
        let mut random = Random::new(seed);
        // Up to 2⁴³, the largest lift-off speed.
        let large: Vec<f64> = (0..count)
            .map(|k| (random.word() >> 24) as f64 * 2f64.powi((k % 46) as i32 - 42))
            .collect();
        let small: Vec<Long<W>> = (0..count)
            .map(|k| {
                let mut x: Long<W> = random.long(2);
                x.words[0] = 0; // so that the sum with any of the large numbers is exact
                if k == 0 { Long::from(0.0) } else { x }
            })
            .collect();
        let both = |x: &Long<W>| (reference(x), reference(x).sin_cos());
        let small: Vec<_> = small.iter().map(|x| (*x, both(x))).collect();
        for a in large {
            let a = Long::<W>::from(a);
            let (x, (sin_a, cos_a)) = both(&a);
            for (b, (y, (sin_b, cos_b))) in &small {
                let (sin, cos) = (a + *b).sin_cos();
                let scale = Reference::ONE + size(&x + y);
                let exact = &sin_a * cos_b + &cos_a * sin_b;
                assert!(near(&sin, &exact, &scale, SINE_ERROR), "sin({a:?} + {b:?})");
                let exact = &cos_a * cos_b - &sin_a * sin_b;
                assert!(near(&cos, &exact, &scale, SINE_ERROR), "cos({a:?} + {b:?})");
            }
        }
    }

    /// Near zero the error of the sine is relative to the argument.
    fn small_sines<const W: usize>(seed: u64, count: usize) {
        let mut random = Random::new(seed);
        for _ in 0..count {
            let x: Long<W> = random.long(60);
            let x = Long { exponent: -x.exponent.abs(), ..x };
            let (exact, scale) = (reference(&x).sin(), reference(&x));
            assert!(near(&x.sin_cos().0, &exact, &scale, SINE_ERROR), "{x:?}");
        }
    }

    fn in_four_threads(work: impl Fn(u64) + Sync) {
        std::thread::scope(|scope| {
            for seed in 0..4 {
                let work = &work;
                scope.spawn(move || work(seed));
            }
        });
    }

    /// Without optimization a tenth of the arguments in 256 bits is tried.
    const FEWER: usize = if cfg!(debug_assertions) { 10 } else { 1 };

    #[test]
    fn sums_products_quotients_and_roots() {
        in_four_threads(|seed| operations::<4>(seed, 250_000 / FEWER));
        operations::<8>(4, 10_000);
        operations::<16>(5, 1_000);
    }

    #[test]
    fn sines_and_cosines() {
        in_four_threads(|seed| sines::<4>(seed, 500 / FEWER));
        sines::<8>(4, 60);
        sines::<16>(5, 20);
        in_four_threads(|seed| small_sines::<4>(seed, 500 / FEWER));
        small_sines::<16>(4, 50);
    }

    #[test]
    fn pi_to_1024_bits() {
        let exact = Reference::pi(64 * MOST + MORE_BITS);
        assert!(near(&Long::<MOST>::pi(), &exact, &exact, 1));
        assert!(near(&Long::<4>::pi(), &exact, &exact, 1));
    }
}
