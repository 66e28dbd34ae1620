//! The fates of a hopper, and their labels in images.

use basin_of_attraction::{Label, UndecidedReason};

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
    /// - [`Precision`](UndecidedReason::Precision): `f64` does not decide the orbit, and longer arithmetic would
    ///   need more than 1024 bits, or some thousand hops beside those that are jumped over; `at` is the speed
    ///   before the undecided hop;
    /// - [`Map`](UndecidedReason::Map): the map does not decide the first hop.
    Undecided(UndecidedReason),
}

impl HopperFate {
    /// The label of a hopper that is grounded.
    pub const GROUNDED: Label = Label::numbered::<65_534>();
    /// The label of a fate that is undecided because the budget of hops was used up.
    pub const UNDECIDED: Label = Label::UNDECIDED;
    /// The label of a fate that is undecided because the error of the orbit in `f64` reaches a verdict, and longer
    /// arithmetic would need too many hops or more than 1024 bits.
    pub const UNDECIDED_PRECISION: Label = Label::UNDECIDED_PRECISION;
    /// The label of a fate that is undecided because the map could not decide a hop.
    pub const UNDECIDED_HOP: Label = Label::UNDECIDED_MAP;
    /// The label of all fixed points whose index exceeds [`LARGEST_LABEL`](Self::LARGEST_LABEL).
    pub const BEYOND_LABELS: Label = Label::numbered::<65_531>();
    /// The label of all fixed points n ≥ 1 together, in fractions. It is the label of no single fate.
    pub const INCESSANT: Label = Label::numbered::<65_525>();
    /// The largest index of a fixed point that has its own label.
    ///
    /// Labels have 16 bits. The round number leaves some 500 labels above it for other fates.
    pub const LARGEST_LABEL: u64 = 65_000;

    /// The label of this fate: basin n for convergence to α*_n, hence basin 0 for decaying.
    ///
    /// All n above [`LARGEST_LABEL`](Self::LARGEST_LABEL) share the label
    /// [`BEYOND_LABELS`](Self::BEYOND_LABELS). Rasters refuse windows with such fixed points.
    pub const fn label(self) -> Label {
        match self {
            HopperFate::Decaying => Self::label_of_fixed_point(0),
            HopperFate::Incessant { n } => Self::label_of_fixed_point(n),
            HopperFate::Grounded => Self::GROUNDED,
            HopperFate::Undecided(reason) => Label::undecided(reason),
        }
    }

    /// The label of convergence to α*_n: basin n up to [`LARGEST_LABEL`](Self::LARGEST_LABEL), else
    /// [`BEYOND_LABELS`](Self::BEYOND_LABELS).
    pub const fn label_of_fixed_point(n: u64) -> Label {
        if n > Self::LARGEST_LABEL {
            return Self::BEYOND_LABELS;
        }
        // Numbers up to 65 000 are basins, so that the second arm is never taken.
        match Label::basin(n as u16) {
            Some(label) => label,
            None => Self::BEYOND_LABELS,
        }
    }

    /// Whether `label` is that of convergence to an α*_n with 1 ≤ n ≤ [`LARGEST_LABEL`](Self::LARGEST_LABEL).
    pub fn is_incessant(label: Label) -> bool {
        let fixed_points = 1..=Self::LARGEST_LABEL;
        label.basin_number().is_some_and(|number| fixed_points.contains(&u64::from(number)))
    }

    /// The name of `label` for legends.
    pub fn label_name(label: Label) -> String {
        match label {
            Self::GROUNDED => "grounded".into(),
            Self::UNDECIDED => "undecided: budget of hops".into(),
            Self::UNDECIDED_PRECISION => "undecided: precision".into(),
            Self::UNDECIDED_HOP => "undecided: a hop".into(),
            Self::BEYOND_LABELS => "to a fixed point beyond the labels".into(),
            label => match label.basin_number() {
                Some(0) => "decaying".into(),
                Some(n) => format!("to α*_{n}"),
                None => label.to_string(),
            },
        }
    }
}
