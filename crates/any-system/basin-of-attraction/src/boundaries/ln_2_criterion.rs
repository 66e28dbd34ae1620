//! The ln 2 criterion of fractal boundaries, with its condition.
//!
//! A. Daza et al. (2016): if each box on a smooth boundary meets at most two basins, its entropy is at most ln 2,
//! and so is the boundary entropy. Boxes with three basins lie at points where three basins meet. On a smooth
//! boundary in the plane there are finitely many such points, while the number of boxes on the boundary grows like
//! 1/ε: for small boxes the mean stays below ln 2. A boundary entropy above ln 2 shows a fractal boundary *for
//! boxes so small that this condition holds*. One size of boxes does not tell whether it does: smooth stripes of
//! four labels, two pixels wide, have the entropy ln 4 in all boxes that are a multiple of eight pixels.
//!
//! On an image the condition can be tested down to the pixels. If the boundary is smooth at any resolved scale,
//! boxes at this scale have two basins, and their entropy is at most ln 2. So the criterion asks for more than ln 2
//! at every size from two pixels on. Few fractal boundaries reach this, because boxes of two pixels have four
//! points only: [`ball_entropy`](crate::ball_entropy) is the more sensitive test.

use crate::error::Error;
use crate::space::raster::LabelImage;

/// The answer of the ln 2 criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ln2Criterion {
    /// The boundary entropy exceeds ln 2 at every size of boxes from two pixels to `largest` pixels: at these
    /// scales the boundary is fractal.
    Fractal {
        /// The smallest boundary entropy.
        smallest_entropy: f64,
        /// The largest side of a box, in pixels.
        largest: usize,
    },
    /// The boundary entropy is at most ln 2 at this size. The boundary may be smooth at the scale of these boxes;
    /// it may be fractal all the same, because the criterion is sufficient, not necessary.
    NotShown {
        /// The smallest such side, in pixels.
        side: usize,
        /// The boundary entropy of boxes of this side; `None` if no box has more than one basin.
        entropy: Option<f64>,
    },
}

/// Boxes are doubled as long as this number of them fits along the shorter side of the image: 64 boxes or more, so
/// that their mean is not one of a few.
const BOXES_ALONG_SIDE: usize = 8;

/// An entropy above ln 2 by less than this may be the rounding of the sum over up to 2³² boxes.
const ABOVE_LN_2: f64 = std::f64::consts::LN_2 + 1e-6;

/// The image needs boxes of 2, 4, 8 and 16 pixels: scales over almost a decade.
const SMALLEST_SIDE: usize = 16 * BOXES_ALONG_SIDE;

impl LabelImage {
    /// Whether the boundary entropy shows a fractal boundary, at every scale from two pixels to an eighth of the image.
    ///
    /// ```
    /// use basin_of_attraction::{Grid, Interval, Label, LabelImage, Ln2Criterion};
    /// // Smooth stripes of four labels, two pixels wide.
    /// let side = Interval::new(0.0, 256.0)?;
    /// let labels = (0..256 * 256).map(|k| Label::from((k % 256 / 2 % 4) as u8)).collect();
    /// let stripes = LabelImage { grid: Grid { x: side, y: side, columns: 256, rows: 256 }, labels };
    /// assert!((stripes.boxes(8)?.boundary_entropy().unwrap_or(0.0) - 4f64.ln()).abs() < 1e-12);
    /// assert!(matches!(stripes.ln_2_criterion()?, Ln2Criterion::NotShown { side: 2, .. }));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadBoxSize`] for an image with a side of fewer than 128 pixels; [`Error::BadImage`] as for
    /// [`check`](Self::check).
    pub fn ln_2_criterion(&self) -> Result<Ln2Criterion, Error> {
        self.check()?;
        let shorter = self.grid.columns.min(self.grid.rows);
        if shorter < SMALLEST_SIDE {
            let largest = (shorter / BOXES_ALONG_SIDE) as f64;
            let size = (SMALLEST_SIDE / BOXES_ALONG_SIDE) as f64;
            return Err(Error::BadBoxSize { size, above: 0.0, largest });
        }
        let (mut side, mut smallest_entropy) = (2, f64::INFINITY);
        while side * BOXES_ALONG_SIDE <= shorter {
            match self.boxes(side)?.boundary_entropy() {
                Some(entropy) if entropy > ABOVE_LN_2 => {
                    smallest_entropy = smallest_entropy.min(entropy);
                }
                entropy => return Ok(Ln2Criterion::NotShown { side, entropy }),
            }
            side *= 2;
        }
        Ok(Ln2Criterion::Fractal { smallest_entropy, largest: side / 2 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::interval::Interval;
    use crate::space::label::Label;
    use crate::space::raster::Grid;
    use crate::statistics::split_mix::SplitMix64;

    fn image(pixels: usize, label: impl Fn(usize, usize) -> u8) -> LabelImage {
        let side = Interval { left: 0.0, right: 1.0 };
        let labels =
            (0..pixels * pixels).map(|k| Label::from(label(k % pixels, k / pixels))).collect();
        LabelImage { grid: Grid { x: side, y: side, columns: pixels, rows: pixels }, labels }
    }

    #[test]
    fn smooth_stripes_are_not_called_fractal_however_thin_they_are() {
        for (width, labels) in [(1, 2), (2, 4), (2, 7), (3, 4), (5, 7), (40, 4)] {
            for tilt in [0, 1, 3] {
                let stripes = image(256, |x, y| ((x + y * tilt / 4) / width % labels) as u8);
                let found = stripes.ln_2_criterion().unwrap();
                assert!(
                    matches!(found, Ln2Criterion::NotShown { .. }),
                    "{width} {labels} {tilt}: {found:?}"
                );
            }
        }
    }

    #[test]
    fn four_basins_mixed_at_every_scale_are_fractal() {
        let random = SplitMix64::from_seed(1);
        let riddled = image(128, |x, y| (random.bits((128 * y + x) as u64) % 4) as u8);
        let Ln2Criterion::Fractal { smallest_entropy, largest } = riddled.ln_2_criterion().unwrap()
        else {
            panic!()
        };
        assert!(smallest_entropy > 0.9 && largest == 16);
        // One label has no boundary, and two labels have at most ln 2.
        let one = image(128, |_, _| 0).ln_2_criterion().unwrap();
        assert_eq!(one, Ln2Criterion::NotShown { side: 2, entropy: None });
        let two = image(128, |x, y| ((x + y) % 2) as u8).ln_2_criterion().unwrap();
        assert!(matches!(two, Ln2Criterion::NotShown { side: 2, entropy: Some(_) }), "{two:?}");
        assert!(matches!(
            image(127, |_, _| 0).ln_2_criterion(),
            Err(Error::BadBoxSize { size: 16.0, largest: 15.0, .. })
        ));
    }
}
