//! The laps of the map: the intervals on which it is proved to be continuous and monotone.
//!
//! ```text
//!   hump n      α*_n … maximum        rises   1 − 4μW > 0 (docs/theory.md, Corollary 28)
//!               maximum … minimum     falls   1 − 4μW < 0
//!               minimum … (n+1)π      rises
//!   window n+1  (n+1)π … α*_{n+1}     rises   proved for some M (`rising_windows`; next to α*_{n+1} Theorem 81)
//! ```
//!
//! For M < 1 the map is continuous at (n+1)π (docs/theory.md, Theorem 23). So the last part of hump n and window n+1
//! form one lap. If the hump has no maximum, all of hump n and window n+1 form one lap.

use crate::error::Error;
use crate::raster::rising_windows::rising_window;
use crate::traps::hump::Hump;
use passive_hopper::{MassRatio, alpha_star, index_below};
use std::f64::consts::{FRAC_1_PI, PI};

/// The laps of hump n and window n+1.
#[derive(Debug, Clone, Copy)]
struct LapsOfHump {
    star: f64,
    /// The ends of the falling lap, (maximum, minimum); infinite if the map only rises.
    falling: (f64, f64),
    /// The end of the last lap: α*_{n+1}, or (n+1)π if the window is not proved to rise.
    end: f64,
}

/// The laps at one mass ratio.
pub(crate) struct Laps {
    humps: Vec<LapsOfHump>,
}

/// The least relative distance of a speed from the ends of its lap.
///
/// The distance covers the rounding errors of the computed ends, which are some ulps. 10⁻¹² is about 4500 ulps, far
/// more than needed. With a larger distance more orbits next to the ends would have no lap; a smaller one does not
/// help. If μ just exceeds 1/(4 max W), the errors of the computed maximum and minimum may be larger. There 1 − 4μW
/// differs from zero by rounding errors only, and README.md shows that this does no harm (invariant LAP).
const DISTANCE_FROM_ENDS: f64 = 1e-12;

/// The largest M with laps. At M = 1 the last lap of a hump ends at (n+1)π, because no window is proved to rise
/// for M > 0.905.
///
/// For M > 1 the map jumps at (n+1)π and hops have several sudden lift-offs. Two orbits then hardly ever visit
/// the same laps: with laps, rasters took up to a tenth longer (docs/performance.md).
const LARGEST_MASS_RATIO: f64 = 1.0;

/// The bits of a lap's number in an itinerary.
pub(crate) const ID_BITS: u32 = 5;

/// The number of humps with laps: 3 laps each, 30 in all, have numbers below 2⁵. All speeds above α*_10 ≈ 33 are
/// followed one by one. With more humps a number would need six bits, and an itinerary could hold ten laps instead
/// of twelve.
pub(crate) const HUMPS_WITH_LAPS: u64 = (1 << ID_BITS) / 3;

impl Laps {
    /// The laps of all humps that begin at or below `largest`; `None` for mass ratios without laps.
    pub(crate) fn below(mass_ratio: MassRatio, largest: f64) -> Result<Option<Self>, Error> {
        let last = index_below(largest)?;
        if mass_ratio.value() > LARGEST_MASS_RATIO {
            return Ok(None);
        }
        let humps = (0..HUMPS_WITH_LAPS.min(last + 1)).map(|n| LapsOfHump::new(n, mass_ratio));
        Ok(Some(Laps { humps: humps.collect::<Result<_, Error>>()? }))
    }

    /// Whether a lap ends at α*_n, n ≥ 1.
    pub(crate) fn has_lap_below(&self, n: u64) -> bool {
        let hump = usize::try_from(n).ok().and_then(|n| self.humps.get(n.checked_sub(1)?));
        hump.is_some_and(|hump| hump.end == alpha_star(n))
    }

    /// The number of the lap that contains all speeds within `error` of `alpha`, different for all laps and less than
    /// 2^[`ID_BITS`]; `None` if the interval of these speeds reaches an
    /// end of a lap, or lies outside all laps.
    #[inline]
    pub(crate) fn lap(&self, alpha: f64, error: f64) -> Option<u8> {
        let distance = error + DISTANCE_FROM_ENDS * alpha;
        // As in the index of traps: α*_n ∈ (nπ, (n+1)π), so that ⌊α/π⌋ is the index of the largest α*_n ≤ α, or one
        // more. If the hump ⌊α/π⌋ has no entry, the code also treats ⌊α/π⌋ as one more.
        let floor = (alpha * FRAC_1_PI) as usize;
        let above = self.humps.get(floor).is_none_or(|hump| alpha < hump.star);
        let n = floor - usize::from(above).min(floor);
        let LapsOfHump { star, falling: (maximum, minimum), end } = *self.humps.get(n)?;
        let which = usize::from(alpha > maximum) + usize::from(alpha > minimum);
        let inside = (alpha - star > distance)
            & ((alpha - maximum).abs() > distance)
            & ((alpha - minimum).abs() > distance)
            & (end - alpha > distance);
        inside.then_some((3 * n + which) as u8)
    }
}

impl LapsOfHump {
    fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let mu = mass_ratio.mu();
        let hump = Hump::new(n)?;
        let window =
            rising_window(n + 1).filter(|window| mass_ratio.value() <= window.largest_mass_ratio);
        let contact_end = (n + 1) as f64 * PI;
        // The proof of a window ends 0.053 below α*_{n+1}, and Theorem 81 goes on from there.
        let end = window.map_or(contact_end, |_| alpha_star(n + 1));
        let falling = hump.falling(mu)?;
        Ok(LapsOfHump {
            star: hump.star.value(),
            falling: falling.unwrap_or((f64::INFINITY, f64::INFINITY)),
            end,
        })
    }
}
