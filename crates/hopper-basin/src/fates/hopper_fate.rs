//! The fates of a hopper, and their labels in images.

use basin_of_attraction::UndecidedReason;

/// The long-term behaviour of a hopper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HopperFate {
    /// The hopper hops for ever. Its lift-off speeds converge to α*_n, n ≥ 1, at which a hop loses no energy.
    Incessant {
        /// The index of the fixed point.
        n: u64,
    },
    /// The hopper hops for ever, and ever lower. Its lift-off speeds converge to α*_0 = 0.
    Decaying,
    /// After some landing the lower mass never lifts off again.
    Grounded,
    /// The fate is not known, for the given reason:
    ///
    /// - [`Budget`](UndecidedReason::Budget): the caller's budget of hops is used up;
    /// - [`Precision`](UndecidedReason::Precision): `f64` does not decide the orbit, and longer arithmetic would need more than
    ///   1024 bits, or some thousand hops beside those that are jumped over; `at` is the speed before the undecided hop;
    /// - [`Map`](UndecidedReason::Map): the map does not decide the first hop.
    Undecided(UndecidedReason),
}

impl HopperFate {
    /// The label of a hopper that is grounded.
    pub const GROUNDED: u16 = u16::MAX - 1;
    /// The label of a fate that is undecided because the budget of hops was used up.
    pub const UNDECIDED: u16 = u16::MAX;
    /// The label of a fate that is undecided because the error of the orbit in `f64` reaches a verdict, and longer
    /// arithmetic would need too many hops or more than 1024 bits.
    pub const UNDECIDED_PRECISION: u16 = u16::MAX - 2;
    /// The label of a fate that is undecided because the map could not decide a hop.
    pub const UNDECIDED_HOP: u16 = u16::MAX - 3;
    /// The label of all fixed points whose index exceeds [`LARGEST_LABEL`](Self::LARGEST_LABEL).
    pub const BEYOND_LABELS: u16 = u16::MAX - 4;
    /// The largest index of a fixed point that has its own label.
    ///
    /// Labels have 16 bits. The round number leaves some 500 labels above it for other fates.
    pub const LARGEST_LABEL: u64 = 65_000;

    /// The label of this fate: n for convergence to α*_n, hence 0 for decaying.
    ///
    /// All n above [`LARGEST_LABEL`](Self::LARGEST_LABEL) share the label
    /// [`BEYOND_LABELS`](Self::BEYOND_LABELS). Rasters refuse windows with such fixed points.
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

    /// The name of `label` for legends.
    pub fn label_name(label: u16) -> String {
        match label {
            0 => "decaying".into(),
            Self::GROUNDED => "grounded".into(),
            Self::UNDECIDED => "undecided: budget of hops".into(),
            Self::UNDECIDED_PRECISION => "undecided: precision".into(),
            Self::UNDECIDED_HOP => "undecided: a hop".into(),
            Self::BEYOND_LABELS => "to a fixed point beyond the labels".into(),
            n => format!("to α*_{n}"),
        }
    }

    /// Whether `label` is one of the labels of undecided fates.
    pub fn is_undecided(label: u16) -> bool {
        [Self::UNDECIDED, Self::UNDECIDED_PRECISION, Self::UNDECIDED_HOP].contains(&label)
    }
}
