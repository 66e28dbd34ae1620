//! How far the pixels of a coverage raster are resolved, and what their shares stand on.

use crate::error::Error;

/// How far the pixels of a coverage raster are resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoverageLimits {
    /// The share of a pixel that may stay undecided. Smaller numbers take longer; `docs/performance.md` has the times.
    pub tolerance: f64,
    /// The number of speeds in each pixel whose fates are found first, in columns whose ground is
    /// [`CoverageGround::Spacing`]: a basin thinner than their distance may be missed there. Other columns miss
    /// none.
    pub samples: usize,
    /// The largest number of speeds inside a pixel whose images or fates are taken to divide it. Where it is
    /// reached, more than the tolerance may stay undecided, and the bounds show it.
    pub speeds: usize,
}

impl Default for CoverageLimits {
    /// A tolerance of 1/20, 16 samples, and 4096 speeds, which few pixels of the paper's figures need: those beside
    /// a fixed point and its preimages, where infinitely many basins meet.
    fn default() -> Self {
        CoverageLimits { tolerance: 0.05, samples: 16, speeds: 4096 }
    }
}

impl CoverageLimits {
    pub(crate) fn check(&self) -> Result<(), Error> {
        let CoverageLimits { tolerance, samples, .. } = *self;
        if tolerance > 0.0 && tolerance < 1.0 && samples > 0 {
            return Ok(());
        }
        Err(Error::CoverageLimits { tolerance, samples })
    }
}

/// What the shares of a column stand on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CoverageGround {
    /// On the laps of the map, all of which are known: the image of a gap between two speeds is the interval
    /// between the images of its ends and its critical values (docs/theory.md, Theorem 95). The bounds then hold as
    /// the labels of a raster do; no basin is missed, however thin. For M ≤ 0.905 … 0.83, by the number of sudden
    /// windows up to the highest speed, of which there are at most 8.
    Laps,
    /// On the fates of single speeds where the laps of the map are not known: for larger M, and from the ninth
    /// sudden window on. A basin thinner than `speeds` may be missed between two followed speeds of equal label,
    /// and the bounds do not count it.
    Spacing {
        /// The largest distance of two followed speeds between which a label is concluded.
        speeds: f64,
    },
}
