//! The gaps of a closed set on the line: their number at each scale, the length that they leave, and the dimension that they give.

use crate::error::Error;
use crate::space::interval::Interval;
use crate::statistics::bounds::Bounds;

/// The lengths of the gaps of a closed set in a window, from the longest to the shortest.
///
/// ```text
///   N(ε) gaps longer than ε        dimension of the set = lim ln N(ε)/ln(1/ε), if it has length 0
///   what they leave                window − Σ lengths ≥ the length of the set
/// ```
///
/// (For a set of length 0 the exponent of its gaps is the dimension of its boxes: A. S. Besicovitch, S. J. Taylor, J. London Math. Soc. 29, 449, 1954.
/// A fat Cantor set has length, its dimension is 1, and the exponent of its gaps says how fast they shrink.)
#[derive(Debug, Clone, PartialEq)]
pub struct GapLengths {
    lengths: Vec<f64>,
    /// What no gap contains.
    left: f64,
    /// The part of it between gaps that are joined: what lies there may belong to the set, or not.
    between: f64,
}

impl GapLengths {
    /// Of gaps such as the intervals of basins or the levels of preimages of a hole, as far as they lie in the window. Gaps at most `resolution` apart are
    /// one: two branches have a half each of a gap between them, and the ends of both halves are wrong by some ulps. They may overlap by as much.
    ///
    /// ```
    /// use basin_of_attraction::{GapLengths, Interval};
    /// // The gaps of {1/k³}, a little shorter, so that the points stay between them.
    /// let gap = |k: u32| Interval::new(f64::from(k + 1).powi(-3), f64::from(k).powi(-3) - 1e-18);
    /// let gaps: Vec<Interval> = (1..10_000).map(gap).collect::<Result<_, _>>()?;
    /// let lengths = GapLengths::new(&gaps, Interval::new(0.0, 1.0)?, 0.0)?;
    /// assert!((lengths.exponent(1e-12, 1e-8)? - 0.25).abs() < 1e-2);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadInterval`] for a gap or a window that is reversed or not finite; [`Error::OverlappingTraps`] for gaps that overlap by more than
    /// the resolution; [`Error::BadSearch`] for a resolution that is negative or not finite.
    pub fn new(gaps: &[Interval], window: Interval, resolution: f64) -> Result<GapLengths, Error> {
        if !(resolution >= 0.0 && resolution.is_finite()) {
            let (name, remedy) = ("a resolution", "; 0 joins only gaps that touch");
            return Err(Error::BadSearch { name, value: resolution, remedy });
        }
        Interval::new(window.left, window.right)?;
        let mut own = Vec::with_capacity(gaps.len());
        for gap in gaps {
            own.extend(Interval::new(gap.left, gap.right)?.intersection(&window));
        }
        own.sort_by(|a, b| a.left.total_cmp(&b.left));
        let (mut joined, mut between) = (Vec::<Interval>::new(), 0.0);
        for gap in own {
            match joined.last_mut() {
                Some(last) if gap.left < last.right - resolution => {
                    return Err(overlap(*last, gap));
                }
                Some(last) if gap.left <= last.right + resolution => {
                    between += (gap.left - last.right).max(0.0);
                    last.right = last.right.max(gap.right);
                }
                _ => joined.push(gap),
            }
        }
        let lengths = joined.iter().map(Interval::length).filter(|x| *x > 0.0);
        let mut lengths: Vec<f64> = lengths.collect();
        lengths.sort_by(|a, b| b.total_cmp(a));
        let ends = joined.iter().map(|gap| gap.left).chain([window.right]);
        let begins = [window.left].into_iter().chain(joined.iter().map(|gap| gap.right));
        let mut parts: Vec<f64> = begins.zip(ends).map(|(from, to)| to - from).collect();
        // The shortest first: the rounding of the sum is that of the longest alone.
        parts.sort_by(f64::total_cmp);
        let left = parts.iter().sum::<f64>() + between;
        Ok(GapLengths { lengths, left, between })
    }

    /// The lengths, from the longest to the shortest.
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// The number of gaps longer than a length.
    pub fn longer(&self, length: f64) -> usize {
        self.lengths.partition_point(|own| *own > length)
    }

    /// What the gaps leave of the window: an upper bound on the length of the set, to the rounding of the sum. What lies between joined gaps counts.
    pub fn left(&self) -> f64 {
        self.left
    }

    /// Bounds on the length of the set if each length of the levels that follow is at most `factor` times that of the level before, and `last` is that of
    /// the last level: what follows has at most last · factor/(1 − factor). What lies between joined gaps may belong to the set, or not.
    ///
    /// # Errors
    /// [`Error::BadSearch`] unless 0 ≤ `factor` < 1 and `last` is not negative.
    pub fn length_of_set(&self, last: f64, factor: f64) -> Result<Bounds, Error> {
        if !((0.0..1.0).contains(&factor) && last >= 0.0 && last.is_finite()) {
            let (name, remedy) =
                ("a factor from level to level", ", below 1, and a length that is not negative");
            return Err(Error::BadSearch { name, value: factor, remedy });
        }
        let certain = self.left - self.between;
        let lower = (certain - last * factor / (1.0 - factor)).max(0.0);
        Ok(Bounds { lower, upper: self.left })
    }

    /// The exponent of the numbers of gaps between two lengths: ln(N(short)/N(long))/ln(long/short). Shorter gaps than `short` may be missing from the
    /// list. Exponents of other ranges show whether it has settled.
    ///
    /// # Errors
    /// [`Error::BadSearch`] unless 0 < `short` < `long`, and without a gap longer than `long`.
    pub fn exponent(&self, short: f64, long: f64) -> Result<f64, Error> {
        let (few, many) = (self.longer(long), self.longer(short));
        if !(0.0 < short && short < long && long.is_finite()) || few == 0 {
            let (name, remedy) = ("a range of lengths", ", increasing, with a gap that is longer");
            return Err(Error::BadSearch { name, value: long, remedy });
        }
        Ok(pxfm::f_log(many as f64 / few as f64) / (pxfm::f_log(long) - pxfm::f_log(short)))
    }
}

fn overlap(one: Interval, next: Interval) -> Error {
    Error::OverlappingTraps {
        first_left: one.left,
        first_right: one.right,
        second_left: next.left,
        second_right: next.right,
    }
}
