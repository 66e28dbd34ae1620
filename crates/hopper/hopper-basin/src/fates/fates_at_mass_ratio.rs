//! The fates of all lift-off speeds at one mass ratio.

use crate::error::Error;
use crate::fates::certain_fate::{CertainFates, Verdict};
use crate::fates::hopper_fate::HopperFate;
use crate::fates::slow_sides::SlowSides;
use crate::traps::trap::Trap;
use basin_of_attraction::{Image, Label, ScalarMap, Traps, UndecidedReason};
use passive_hopper::{LiftOffMap, MassRatio, index_below};
use std::sync::OnceLock;

/// The number of traps that [`Fates`] stores. The trap of a larger n is computed at each use: speeds above α*_64 ≈ 203
/// take longer to classify, with the same result.
const KEPT_TRAPS: usize = 64;

/// The number of hops after which a fate is reported as [undecided](HopperFate::Undecided). A jump along the slow
/// side of a fixed point counts as one.
///
/// A million hops take some tenths of a second in `f64`. From a distance δ left of a fixed point an orbit takes
/// about 3/(10 λ
/// |δ|^{1/3}) hops to leave (docs/theory.md, Theorem 38), which are jumped over. From the right no orbit leaves. So an orbit
/// is followed for some dozen hops as a rule, and this number only bounds the work.
pub const HOP_BUDGET: usize = 1_000_000;

/// The fates at one mass ratio.
///
/// As f(α) ≤ α, an orbit only descends (docs/theory.md, Theorem 24). Its fate is decided when it enters a [`Trap`] or
/// is grounded. Closeness to a fixed point does not decide a fate: orbits just below a fixed point leave it slowly.
///
/// A decided fate is that of the exact orbit of the given `f64` at the given M, and not of an orbit rounded to
/// `f64` (docs/theory.md, Theorem 79). A part of the error bound behind this is not proved. In the slow approach to
/// and escape from fixed points the second order of a hop's error is an estimate, which is measured against longer
/// arithmetic (docs/theory.md, Section 15).
///
/// ```
/// use hopper_basin::{Fates, HopperFate};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.2)?)?;
/// assert_eq!(fates.fate(4.55)?, HopperFate::Incessant { n: 1 });
/// assert_eq!(fates.fate(4.60)?, HopperFate::Decaying);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Fates {
    map: LiftOffMap,
    /// The traps of the first fixed points, each computed at its first use.
    first: [OnceLock<Trap>; KEPT_TRAPS],
    slow: SlowSides,
}

impl Fates {
    /// The fates at `mass_ratio`.
    ///
    /// # Errors
    /// As [`Trap::new`].
    pub fn new(mass_ratio: MassRatio) -> Result<Self, Error> {
        let map = LiftOffMap::new(mass_ratio);
        let first = [const { OnceLock::new() }; KEPT_TRAPS];
        let fates = Fates { map, first, slow: SlowSides::new(mass_ratio) };
        // Nearly every orbit needs this trap. Computing it here returns an error now rather than later.
        fates.trap(0)?;
        Ok(fates)
    }

    /// The lift-off map at this mass ratio.
    pub fn map(&self) -> &LiftOffMap {
        &self.map
    }

    /// The trap of α*_n.
    ///
    /// # Errors
    /// As [`Trap::new`].
    pub fn trap(&self, n: u64) -> Result<Trap, Error> {
        let slot = self.first.get(usize::try_from(n).unwrap_or(usize::MAX));
        if let Some(&trap) = slot.and_then(OnceLock::get) {
            return Ok(trap);
        }
        let trap = Trap::new(n, self.map.mass_ratio())?;
        Ok(slot.map_or(trap, |slot| *slot.get_or_init(|| trap)))
    }

    /// The slow sides of the fixed points.
    pub(crate) fn slow_sides(&self) -> &SlowSides {
        &self.slow
    }

    /// The fate of the hopper that lifts off with speed `alpha`.
    ///
    /// # Errors
    /// [`Error::Hopper`] for a speed that is not positive, finite and below 2⁴³.
    pub fn fate(&self, alpha: f64) -> Result<HopperFate, Error> {
        self.fate_within(alpha, HOP_BUDGET).map(|(fate, _)| fate)
    }

    /// The fate, and the number of hops until it was known, with a given budget of hops. The number contains the
    /// hops that were jumped over along the slow side of a fixed point; in the budget a jump counts as one hop.
    ///
    /// # Errors
    /// As [`fate`](Self::fate).
    pub fn fate_within(&self, alpha: f64, budget: usize) -> Result<(HopperFate, usize), Error> {
        self.map.check_speed(alpha)?;
        let (verdict, hops) = self.certain().verdict(alpha, budget)?;
        Ok((self.fate_of(alpha, verdict, hops), hops))
    }

    /// What follows an orbit with bounds on its error.
    pub(crate) fn certain(&self) -> CertainFates<'_, impl Fn(u64) -> Result<Trap, Error>> {
        CertainFates { map: &self.map, trap: |n| self.trap(n), slow: &self.slow }
    }

    /// The fate of `alpha` by the verdict on its orbit.
    pub(crate) fn fate_of(&self, alpha: f64, verdict: Verdict, hops: usize) -> HopperFate {
        match verdict {
            Verdict::Trapped(0) => HopperFate::Decaying,
            Verdict::Trapped(n) => HopperFate::Incessant { n },
            Verdict::Grounded => HopperFate::Grounded,
            Verdict::Budget => HopperFate::Undecided(UndecidedReason::Budget),
            Verdict::Inconclusive { at } if hops == 0 && self.hop_is_undecided(alpha) => {
                HopperFate::Undecided(UndecidedReason::Map { at })
            }
            Verdict::Inconclusive { at } => {
                HopperFate::Undecided(UndecidedReason::Precision { at })
            }
        }
    }

    /// Whether the map leaves the hop from `alpha` itself undecided.
    fn hop_is_undecided(&self, alpha: f64) -> bool {
        self.map.image(alpha).is_err()
    }
}

/// The map for the generic tools. A hop with an uncertain decision gives [`Image::Undecided`].
impl ScalarMap for Fates {
    fn image(&self, alpha: f64) -> Image {
        match self.map().hop(alpha) {
            Ok(hop) => hop.next.into(),
            Err(_) => Image::Undecided,
        }
    }
}

impl Traps for Fates {
    /// The index of the trap that contains `alpha`. All indices from 65 000 up share the label 65 000, because the
    /// generic tools have labels of 16 bits.
    fn label(&self, alpha: f64) -> Option<Label> {
        let n = index_below(alpha).ok()?;
        let trap = self.trap(n).ok()?;
        trap.contains(alpha).then_some(HopperFate::label_of_fixed_point(n))
    }
}
