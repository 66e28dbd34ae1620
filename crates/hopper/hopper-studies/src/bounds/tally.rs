//! Ratios actual error / bound, collected without storing them.

use super::measured::Measured;

/// Bins in an octave of the ratio. The median is known to a factor 2^(1/8), 9 %.
const BINS_AN_OCTAVE: f64 = 8.0;

/// The first bin holds all ratios below 2⁻⁶⁰, zero included.
const SMALLEST_EXPONENT: f64 = -60.0;

/// Bins from 2⁻⁶⁰ to 2⁴. The last bin holds all ratios above.
const BINS: usize = 64 * BINS_AN_OCTAVE as usize;

/// The ratios of one bound on one class of inputs.
///
/// Two tallies are added in any order with the same result. A measurement therefore gives the same numbers with any
/// number of threads.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tally {
    count: u64,
    bins: Vec<u64>,
    largest: f64,
    /// Index of the input with the largest ratio; the first, if several inputs have it.
    largest_at: u64,
}

impl Tally {
    /// No ratios.
    pub(crate) fn new() -> Self {
        Tally { count: 0, bins: vec![0; BINS], largest: 0.0, largest_at: u64::MAX }
    }

    /// Adds the `ratio` of the input `index`. A ratio that is no number is counted as infinite: such a bound says
    /// nothing.
    pub(crate) fn add(&mut self, ratio: f64, index: u64) {
        let ratio = if ratio.is_nan() { f64::INFINITY } else { ratio };
        let place = (pxfm::f_log2(ratio) - SMALLEST_EXPONENT) * BINS_AN_OCTAVE;
        // The conversion gives 0 below the first bin, and the comparison limits it to the last one.
        self.bins[(place as usize).min(BINS - 1)] += 1;
        self.count += 1;
        self.take_largest(ratio, index);
    }

    fn take_largest(&mut self, ratio: f64, index: u64) {
        if ratio > self.largest || (ratio == self.largest && index < self.largest_at) {
            (self.largest, self.largest_at) = (ratio, index);
        }
    }

    /// Adds the ratios of another tally.
    pub(crate) fn merge(&mut self, other: &Tally) {
        self.count += other.count;
        for (bin, more) in self.bins.iter_mut().zip(&other.bins) {
            *bin += more;
        }
        self.take_largest(other.largest, other.largest_at);
    }

    /// Whether it has no ratios.
    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The upper end of the bin with the median; 0 for the first bin.
    fn median(&self) -> f64 {
        let mut below = 0;
        let half = self.count.div_ceil(2);
        let bin = self.bins.iter().position(|count| {
            below += count;
            below >= half
        });
        match bin {
            None | Some(0) => 0.0,
            Some(bin) => pxfm::f_exp2((bin + 1) as f64 / BINS_AN_OCTAVE + SMALLEST_EXPONENT),
        }
    }

    /// The result, with the input of the largest ratio as `text` of its index.
    pub(crate) fn measured(
        &self,
        bound: &'static str,
        statement: &'static str,
        class: &'static str,
        text: impl Fn(u64) -> String,
    ) -> Measured {
        Measured {
            bound,
            statement,
            class,
            count: self.count,
            median: self.median().min(self.largest),
            largest: self.largest,
            at: if self.is_empty() { String::new() } else { text(self.largest_at) },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(ratios: &[f64]) -> Tally {
        let mut tally = Tally::new();
        ratios.iter().enumerate().for_each(|(k, &ratio)| tally.add(ratio, k as u64));
        tally
    }

    #[test]
    fn the_median_is_right_to_a_bin_and_the_largest_exactly() {
        let ratios: Vec<f64> = (1..=999).map(|k| f64::from(k) * 1e-3).collect();
        let tally = of(&ratios);
        let found = tally.measured("b", "s", "c", |index| format!("number {index}"));
        assert!(found.median >= 0.5 && found.median < 0.5 * 1.1, "{}", found.median);
        assert_eq!((found.count, found.largest, &*found.at), (999, 0.999, "number 998"));
    }

    #[test]
    fn zeros_and_numbers_that_are_none_have_a_place() {
        let tally = of(&[0.0, 0.0, f64::NAN]);
        assert_eq!(tally.median(), 0.0);
        assert_eq!((tally.largest, tally.largest_at), (f64::INFINITY, 2));
    }

    #[test]
    fn the_order_of_merging_changes_nothing() {
        let (mut a, b) = (of(&[0.1, 0.7]), of(&[0.7, 0.2]));
        let mut c = b.clone();
        c.merge(&a);
        a.merge(&b);
        assert_eq!(a, c);
        assert_eq!((a.count, a.largest, a.largest_at), (4, 0.7, 0));
    }
}
