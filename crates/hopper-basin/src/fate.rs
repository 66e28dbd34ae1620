//! The fate of a lift-off speed.

use crate::{Error, Trap};
use basin_of_attraction::{Fate, UndecidedReason, classify};
use passive_hopper::{LiftOffMap, MassRatio, index_below};
use std::sync::OnceLock;

/// What becomes of a hopper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HopperFate {
    /// It hops for ever, ever closer to the lossless hop α*_n, n ≥ 1.
    Incessant {
        /// Index of the fixed point.
        n: u64,
    },
    /// It hops for ever, ever lower: α → 0 = α*_0.
    Decaying,
    /// After some landing the lower mass never lifts off again.
    Grounded,
    /// Not known, and why.
    Undecided(UndecidedReason),
}

impl HopperFate {
    /// The label of a grounded hopper in label images.
    pub const GROUNDED: u16 = u16::MAX - 1;
    /// The label of a fate that is undecided because the budget of hops was used up.
    pub const UNDECIDED: u16 = u16::MAX;
    /// The label of a fate that is undecided because the orbit stands still in `f64`.
    pub const UNDECIDED_PRECISION: u16 = u16::MAX - 2;
    /// The label of a fate that is undecided because a hop could not be decided.
    pub const UNDECIDED_HOP: u16 = u16::MAX - 3;
    /// The label that fixed points beyond the last label share.
    pub const BEYOND_LABELS: u16 = u16::MAX - 4;
    /// The largest n with a label.
    pub const LARGEST_LABEL: u64 = 65_000;

    /// The label of a fate: n for α*_n, so 0 for decaying. An n above 65 000 has no label of its
    /// own: [`BEYOND_LABELS`](Self::BEYOND_LABELS); rasters refuse such windows.
    pub fn label(self) -> u16 {
        match self {
            HopperFate::Decaying => 0,
            HopperFate::Incessant { n } if n <= Self::LARGEST_LABEL => n as u16,
            HopperFate::Grounded => Self::GROUNDED,
            HopperFate::Undecided(UndecidedReason::Precision { .. }) => Self::UNDECIDED_PRECISION,
            HopperFate::Undecided(UndecidedReason::Map { .. }) => Self::UNDECIDED_HOP,
            HopperFate::Incessant { .. } => Self::BEYOND_LABELS,
            HopperFate::Undecided(UndecidedReason::Budget) => Self::UNDECIDED,
        }
    }

    /// The name of a label, for legends.
    pub fn label_name(label: u16) -> String {
        match label {
            0 => "decaying".into(),
            Self::GROUNDED => "grounded".into(),
            Self::UNDECIDED => "undecided: budget of hops".into(),
            Self::UNDECIDED_PRECISION => "undecided: precision of f64".into(),
            Self::UNDECIDED_HOP => "undecided: a hop".into(),
            Self::BEYOND_LABELS => "to a fixed point beyond the labels".into(),
            n => format!("to α*_{n}"),
        }
    }

    /// Whether a label stands for an undecided fate.
    pub fn is_undecided(label: u16) -> bool {
        [Self::UNDECIDED, Self::UNDECIDED_PRECISION, Self::UNDECIDED_HOP].contains(&label)
    }
}

/// Hops followed before a fate is given up as undecided: about a second's work where a hop has few
/// sudden lift-offs. (At M above 10⁴ one hop may have thousands; give
/// [`fate_within`](Fates::fate_within) a smaller budget there.)
///
/// Just left of a fixed point an orbit leaves in 3/(10 λ) δ^{−1/3} hops, some 10⁵/(10λ) from an ulp
/// away; λ is proportional to μ. For M so small that this would be more, the whole interval is a
/// [trap](crate::TrapEdge::NextFixedPoint); for M above 10⁴ it may be undecided.
pub const HOP_BUDGET: usize = 1_000_000;

/// The fates at one mass ratio.
///
/// Orbits only go down, so that each is decided when it enters a [`Trap`] or is grounded. Nothing
/// is judged by closeness.
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
    /// The traps of the first fixed points, computed when first asked for.
    first: [OnceLock<Trap>; 64],
}

impl Fates {
    /// The fates at `mass_ratio`.
    ///
    /// # Errors
    /// As [`Trap::new`].
    pub fn new(mass_ratio: MassRatio) -> Result<Self, Error> {
        let map = LiftOffMap::new(mass_ratio);
        let fates = Fates { map, first: [const { OnceLock::new() }; 64] };
        fates.trap(0)?; // nearly every orbit asks for it
        Ok(fates)
    }

    /// The map.
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

    /// The fate of the hopper that lifts off with speed `alpha`.
    ///
    /// # Errors
    /// [`Error::Hopper`] for a speed that is not positive, finite and below 2⁴³.
    pub fn fate(&self, alpha: f64) -> Result<HopperFate, Error> {
        self.fate_within(alpha, HOP_BUDGET).map(|(fate, _)| fate)
    }

    /// The fate, and the number of hops until it was known, with a budget of hops of one's own.
    ///
    /// # Errors
    /// As [`fate`](Self::fate).
    pub fn fate_within(&self, alpha: f64, budget: usize) -> Result<(HopperFate, usize), Error> {
        self.map.landings(alpha)?; // checks α
        let (fate, hops) = classify(self, self, alpha, budget);
        let fate = match fate {
            Fate::Stopped => HopperFate::Grounded,
            Fate::Trapped(0) => HopperFate::Decaying,
            Fate::Trapped(label) if u64::from(label) < HopperFate::LARGEST_LABEL => {
                HopperFate::Incessant { n: u64::from(label) }
            }
            // Higher indices share a label.
            Fate::Trapped(_) => HopperFate::Incessant { n: self.last_index(alpha, hops)? },
            Fate::Undecided(reason) => HopperFate::Undecided(reason),
        };
        Ok((fate, hops))
    }

    /// The index of the fixed point below the orbit after `hops` hops.
    fn last_index(&self, alpha: f64, hops: usize) -> Result<u64, Error> {
        let mut speed = alpha;
        for _ in 0..hops {
            match self.map.image(speed) {
                Ok(Some(next)) => speed = next,
                Ok(None) | Err(_) => break,
            }
        }
        Ok(index_below(speed)?)
    }
}
