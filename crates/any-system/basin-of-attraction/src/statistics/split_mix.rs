//! Random numbers from a seed, by index.

/// SplitMix64 (Steele, Lea, Flood 2014): 64-bit random numbers, computed from a state and an index.
///
/// Number k depends on the state and k alone. Threads can therefore take the numbers in any order, and a
/// sample is the same with any number of threads. Number k ≥ 1 is the k-th output of the usual sequential
/// generator that starts at this state. The generator is for sampling; it is not cryptographic.
///
/// ```
/// use basin_of_attraction::SplitMix64;
/// let random = SplitMix64::from_seed(7);
/// let points: Vec<f64> = (0..1000).map(|k| random.uniform(k)).collect();
/// assert!(points.iter().all(|x| (0.0..1.0).contains(x)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SplitMix64 {
    state: u64,
}

/// The state advances by this odd number, 2⁶⁴ divided by the golden ratio. Because it is odd, the state takes all 2⁶⁴
/// values before one repeats.
const INCREMENT: u64 = 0x9e37_79b9_7f4a_7c15;

impl SplitMix64 {
    /// The generator with this state, as in published implementations.
    ///
    /// States that differ by a small multiple of 0x9e3779b97f4a7c15 give shifted copies of one sequence.
    /// [`from_seed`](Self::from_seed) avoids this.
    pub const fn from_state(state: u64) -> Self {
        SplitMix64 { state }
    }

    /// The generator for a seed. The seed is mixed first, so that neighbouring seeds give unrelated sequences.
    pub const fn from_seed(seed: u64) -> Self {
        SplitMix64 { state: mix(seed) }
    }

    /// Number k as 64 bits.
    pub const fn bits(&self, k: u64) -> u64 {
        mix(self.state.wrapping_add(k.wrapping_mul(INCREMENT)))
    }

    /// Number k as a uniform number in [0, 1): a multiple of 2⁻⁵³.
    pub fn uniform(&self, k: u64) -> f64 {
        // An f64 has 53 significant bits. With more bits the number would be rounded, possibly to 1.
        (self.bits(k) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The output function: xor-shifts and multiplications, each invertible. The shifts and factors are variant 13
/// of David Stafford's search (2011), which SplitMix64 uses.
const fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The published first outputs for the state 1234567.
    #[test]
    fn outputs_are_those_of_the_published_generator() {
        let random = SplitMix64::from_state(1_234_567);
        let published = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!([1, 2, 3, 4, 5].map(|k| random.bits(k)), published);
    }
}
