//! The basins of a window at one mass ratio as labelled intervals: by images of gaps, or by the fates of samples.

use crate::coverage::coverage_limits::CoverageLimits;
use crate::coverage::images::LapImages;
use crate::coverage::laps_sweep::{LapsSweep, Resolution, traps_up_to};
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use basin_of_attraction::{Interval, Label, PixelShares};
use passive_hopper::{alpha_star, index_below};

/// The pixels of the range below the window, and the open part of each. Images of the window's gaps fall there.
/// With more and finer ones fewer gaps of the window need a second image or stay open. It affects the time, and
/// what is left open.
const PIXELS_BELOW: usize = 512;
const TOLERANCE_BELOW: f64 = 0.01;

/// Passes over a pixel, and the width that the last one resolves, over that of the first.
const PASSES: usize = 8;
const FINEST: f64 = 1.0 / 16_384.0;

/// The pixels of each image of a window that is narrower than some pixels below it. Without them such a window lies
/// in few pixels, and much of it would stay open.
const PIXELS_OF_IMAGE: usize = 128;

/// An image that is wider than so many pixels below the window needs no finer pixels of its own.
const WIDE: f64 = 16.0;

/// Below each fixed point infinitely many basins meet. So many more pixels lie there, each so much narrower than
/// the one before. Speeds beyond the trap of a fixed point have their images there, and would stay open else.
const PIXELS_BESIDE: i32 = 2;
const NEARER: f64 = 0.125;

/// The labelled intervals up to the last of the `edges` of pixels, where all laps are known.
pub(crate) fn by_laps(
    fates: &Fates,
    edges: &[f64],
    limits: CoverageLimits,
) -> Result<Vec<(Interval, Label)>, Error> {
    let [bottom, .., top] = *edges else { return Ok(Vec::new()) };
    let mut sweep = LapsSweep::new(LapImages::new(fates.map(), top)?, traps_up_to(fates, top)?);
    let fine = Resolution {
        tolerance: limits.tolerance,
        speeds: limits.speeds,
        passes: PASSES,
        finest: FINEST,
    };
    let below = Resolution { tolerance: limits.tolerance.min(TOLERANCE_BELOW), ..fine };
    let mut lower = Vec::new();
    if bottom > 0.0 {
        let height = bottom / PIXELS_BELOW as f64;
        lower = (0..PIXELS_BELOW).map(|k| height * k as f64).collect();
        let window = Interval { left: bottom, right: top };
        for image in sweep.narrow_images(window, WIDE * height) {
            let part = image.length() / PIXELS_OF_IMAGE as f64;
            lower.extend((0..=PIXELS_OF_IMAGE).map(|k| image.left + part * k as f64));
        }
        for n in 1..=index_below(bottom)? + 1 {
            let part = |k: i32| alpha_star(n) - height * NEARER.powi(k);
            lower.extend((1..=PIXELS_BESIDE).map(part));
        }
        lower.retain(|&edge| edge < bottom);
        lower.sort_by(f64::total_cmp);
        lower.dedup();
        lower.push(bottom);
    }
    for (all, resolution) in [(&lower[..], below), (edges, fine)] {
        for pair in all.windows(2) {
            sweep.add_pixel(pair[0], pair[1], resolution);
        }
    }
    Ok(sweep.into_known())
}

/// A gap between two neighbouring speeds of different fates.
#[derive(Debug, Clone, Copy)]
struct Gap {
    left: (f64, Label),
    right: (f64, Label),
}

impl Gap {
    fn width(&self) -> f64 {
        self.right.0 - self.left.0
    }

    /// The speed in the middle; `None` if there is no `f64` between the ends.
    fn middle(&self) -> Option<f64> {
        let middle = self.left.0.midpoint(self.right.0);
        (self.left.0 < middle && middle < self.right.0).then_some(middle)
    }
}

/// The gaps of a pixel that have no label.
struct Pixel {
    gaps: Vec<Gap>,
    /// The open width at which the halving stops.
    allowed: f64,
    /// The number of gaps that may still be halved.
    left: usize,
}

impl Pixel {
    /// Takes out the gaps to be halved next: those of at least half the width of the widest.
    fn take_widest(&mut self) -> Vec<Gap> {
        let open: f64 = self.gaps.iter().map(Gap::width).sum();
        if open <= self.allowed {
            return Vec::new();
        }
        let can_be_halved = |gap: &&Gap| gap.middle().is_some();
        let widest = self.gaps.iter().filter(can_be_halved).map(Gap::width).fold(0.0, f64::max);
        let mut taken = Vec::new();
        let left = self.left;
        self.gaps.retain(|gap| {
            let take = gap.middle().is_some() && gap.width() >= 0.5 * widest && taken.len() < left;
            if take {
                taken.push(*gap);
            }
            !take
        });
        self.left -= taken.len();
        taken
    }
}

/// The labelled intervals of a window by the fates of samples: two neighbours of one fate have it between them.
pub(crate) fn by_fates(
    fates: &Fates,
    window: Interval,
    pixels: usize,
    limits: CoverageLimits,
) -> Result<Vec<(Interval, Label)>, Error> {
    let mut speeds = PixelShares::edges(window, pixels.saturating_mul(limits.samples))?;
    // No hop starts with the speed 0.
    if let Some(first) = speeds.first_mut() {
        *first = first.max(f64::MIN_POSITIVE);
    }
    let labels = fates.labels(&speeds)?;
    let ends: Vec<(f64, Label)> = speeds.into_iter().zip(labels).collect();
    let mut closed = Vec::new();
    let mut all: Vec<Pixel> = Vec::new();
    let allowed = limits.tolerance * window.length() / pixels as f64;
    for (at, pair) in ends.windows(2).enumerate() {
        if at % limits.samples == 0 {
            all.push(Pixel { gaps: Vec::new(), allowed, left: limits.speeds });
        }
        let pixel = all.last_mut().map(|pixel| &mut pixel.gaps);
        sort_in(Gap { left: pair[0], right: pair[1] }, &mut closed, pixel);
    }
    loop {
        let taken = |(at, pixel): (usize, &mut Pixel)| {
            pixel.take_widest().into_iter().map(move |gap| (at, gap))
        };
        let taken: Vec<(usize, Gap)> = all.iter_mut().enumerate().flat_map(taken).collect();
        if taken.is_empty() {
            return Ok(joined(closed));
        }
        let middles: Vec<f64> = taken.iter().filter_map(|(_, gap)| gap.middle()).collect();
        let labels = fates.labels(&middles)?;
        for ((at, Gap { left, right }), middle) in
            taken.into_iter().zip(middles.into_iter().zip(labels))
        {
            for gap in [Gap { left, right: middle }, Gap { left: middle, right }] {
                sort_in(gap, &mut closed, all.get_mut(at).map(|pixel| &mut pixel.gaps));
            }
        }
    }
}

/// Puts a gap to the closed ones if both ends have one fate, else to the open ones.
fn sort_in(gap: Gap, closed: &mut Vec<(Interval, Label)>, open: Option<&mut Vec<Gap>>) {
    let Gap { left, right } = gap;
    if left.1 == right.1 && left.1.is_decided() {
        closed.push((Interval { left: left.0, right: right.0 }, left.1));
    } else if let Some(open) = open {
        open.push(gap);
    }
}

/// The intervals in increasing order; neighbours with a common end and one label are one interval.
fn joined(mut parts: Vec<(Interval, Label)>) -> Vec<(Interval, Label)> {
    parts.sort_by(|a, b| a.0.left.total_cmp(&b.0.left));
    let mut joined: Vec<(Interval, Label)> = Vec::new();
    for (interval, label) in parts {
        match joined.last_mut() {
            Some((last, own)) if *own == label && last.right == interval.left => {
                last.right = interval.right;
            }
            _ => joined.push((interval, label)),
        }
    }
    joined
}
