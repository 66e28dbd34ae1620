//! Where the map is monotone and continuous, as far as that is proved.
//!
//! ```text
//!   hump n      α*_n … maximum        rises   W < 1/(4μ): theory, e.2
//!               maximum … minimum     falls
//!               minimum … (n+1)π      rises
//!   window n+1  (n+1)π … α*_{n+1}     rises   for the M of `rising_window`, up to 10⁻³ below α*_{n+1}
//! ```
//!
//! For M < 1 the map is continuous at (n+1)π: hump n from its minimum and window n+1 are one arc. Where the hump
//! has no maximum, all of it is.

use crate::hump::Hump;
use crate::{Error, rising_window};
use passive_hopper::{MassRatio, index_below};
use std::f64::consts::FRAC_1_PI;

/// The arcs from α*_n to α*_{n+1}.
#[derive(Debug, Clone, Copy)]
struct Rung {
    star: f64,
    /// The ends of the falling arc; infinite if there is none.
    falling: (f64, f64),
    /// Beyond, nothing is proved.
    end: f64,
    /// Bounds on |α′ (dα′/dα)/α| on the three arcs.
    slopes: [f64; 3],
}

/// An arc at a mass ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Arc {
    /// One for each arc, under 32.
    pub(crate) id: u8,
    /// Bound on |α′ (dα′/dα)/α| on it.
    pub(crate) slope: f64,
}

/// The arcs at one mass ratio.
pub(crate) struct Arcs {
    rungs: Vec<Rung>,
}

/// A hundred times the relative error of the arcs' ends.
const ROUNDING: f64 = 1e-12;

/// For larger M, hops have several sudden lift-offs, and hardly two orbits keep to the humps.
const LARGEST: f64 = 1.0;

/// Rungs whose arcs have a number under 32.
pub(crate) const RUNGS: u64 = 10;

impl Arcs {
    /// The arcs below `alpha`; nothing where too little is proved to be of use.
    pub(crate) fn below(mass_ratio: MassRatio, alpha: f64) -> Result<Option<Self>, Error> {
        let proved = |n| rising_window(n).filter(|w| mass_ratio.value() <= w.largest_mass_ratio);
        let last = index_below(alpha)?;
        if mass_ratio.value() > LARGEST {
            return Ok(None);
        }
        let mu = mass_ratio.mu();
        let rung = |n: u64| {
            let hump = Hump::new(n)?;
            let window = proved(n + 1);
            let contact_end = (n + 1) as f64 * std::f64::consts::PI;
            let end = window.map_or(contact_end, |window| window.part.right);
            let falling = hump.falling(mu)?;
            let window_slope = window.map_or(1.0, |window| window.steepest);
            // 1 − 4μW, with 0 ≤ W ≤ its largest value.
            let hump_slope = (4.0 * mu * hump.largest_w() - 1.0).max(1.0);
            let first = if falling.is_some() { hump_slope } else { window_slope };
            Ok(Rung {
                star: hump.star.value(),
                falling: falling.unwrap_or((f64::INFINITY, f64::INFINITY)),
                end,
                slopes: [first, hump_slope, window_slope],
            })
        };
        let rungs = (0..RUNGS.min(last + 1)).map(rung).collect::<Result<_, Error>>()?;
        Ok(Some(Arcs { rungs }))
    }

    /// The arc that holds all within `pad` of `alpha`, if one does.
    #[inline]
    pub(crate) fn arc(&self, alpha: f64, pad: f64) -> Option<Arc> {
        let away = pad + ROUNDING * alpha;
        let turns = (alpha * FRAC_1_PI) as usize;
        // As in the ladder of traps: ⌊α/π⌋, or one less.
        let n = turns
            - usize::from(self.rungs.get(turns).is_none_or(|rung| alpha < rung.star)).min(turns);
        let Rung { star, falling: (top, foot), end, slopes } = *self.rungs.get(n)?;
        let which = usize::from(alpha > top) + usize::from(alpha > foot);
        let inside = (alpha - star > away)
            & ((alpha - top).abs() > away)
            & ((alpha - foot).abs() > away)
            & (end - alpha > away);
        inside.then_some(Arc { id: (3 * n + which) as u8, slope: slopes[which] })
    }
}
