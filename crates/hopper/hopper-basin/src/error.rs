//! Errors of traps, fates and basins.

use thiserror::Error;

/// Why a trap, a crisis, a fate or a basin could not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// An error of the hopper's model, such as a lift-off speed that is not positive.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
    /// An error of the expansions next to a fixed point.
    #[error(transparent)]
    Asymptotics(#[from] hopper_asymptotics::Error),
    /// An error of the generic basin tools, such as an empty raster.
    #[error(transparent)]
    BasinOfAttraction(#[from] basin_of_attraction::Error),
    /// The root search failed on a bracket that holds a root (docs/theory.md, Theorem 29, Corollary 30
    /// and Theorem 31).
    #[error("theory guarantees a root on hump {n}, but the search failed: {source}")]
    RootSearch {
        /// The index of the hump.
        n: u64,
        /// The error of the root finder.
        source: interval_arithmetic::Error,
    },
    /// A window of lift-off speeds that is empty, starts below zero, or contains fixed points
    /// whose indices have no labels.
    #[error(
        "a window of lift-off speeds must increase and lie in [0, {largest}], not [{bottom}, {top}]"
    )]
    Window {
        /// The lowest speed of the window.
        bottom: f64,
        /// The highest speed of the window.
        top: f64,
        /// The highest speed whose fixed point has a label.
        largest: f64,
    },
    /// A range of columns that lies outside the raster.
    #[error("the raster has {columns} columns; the range {first}..{end} lies outside")]
    ColumnRange {
        /// The number of columns of the raster.
        columns: usize,
        /// The first requested column.
        first: usize,
        /// The end of the range, one past the last requested column.
        end: usize,
    },
    /// More speeds at a time than the raster engine numbers.
    #[error(
        "{speeds} speeds in {columns} columns are more than the {largest} that are labelled at a time; divide them"
    )]
    TooManySpeeds {
        /// The number of speeds of a column, with the additional speeds below the first.
        speeds: usize,
        /// The number of columns whose orbits hop together.
        columns: usize,
        /// The largest number of speeds of all these columns.
        largest: usize,
    },
    /// Basin fractions need at least one point.
    #[error("no points to count: {points} on each interval from α*_{from} to α*_{to}")]
    NoPoints {
        /// The index of the first fixed point.
        from: u64,
        /// The index of the last fixed point.
        to: u64,
        /// The requested number of points on each interval.
        points: usize,
    },
    /// An index for which the quantity is not defined or not resolved.
    #[error("the index of the hump must be from {smallest} to {largest}, not {n}")]
    Index {
        /// The index given.
        n: u64,
        /// The smallest index accepted.
        smallest: u64,
        /// The largest index accepted.
        largest: u64,
    },
    /// A scan spacing that is not positive, exceeds the length to be scanned, or needs too many
    /// points.
    #[error("cannot scan a length of {length} at a spacing of {spacing}")]
    Spacing {
        /// The requested spacing.
        spacing: f64,
        /// The length to be scanned.
        length: f64,
    },
    /// The largest mass ratio of a search is too small: orbits still fall there.
    #[error(
        "orbits still fall through α*_{n} at M = {largest}, the largest mass ratio of the search"
    )]
    LargestMassRatio {
        /// The index of the fixed point.
        n: u64,
        /// The largest mass ratio of the search.
        largest: f64,
    },
    /// No turn of the Fatou coordinate was found: the hopper is grounded from the offset, or the hops from there
    /// towards α*_n are too many.
    #[error(
        "the offset {delta:e} left of α*_{n} has no turn of phases; the mass ratio is too extreme"
    )]
    NoTurn {
        /// The index of the fixed point.
        n: u64,
        /// The offset.
        delta: f64,
    },
    /// Phases that are not finite, or in the wrong order.
    #[error("an interval of phases must be finite and must not decrease: from {from} to {to}")]
    Phases {
        /// The lowest phase.
        from: f64,
        /// The highest phase.
        to: f64,
    },
    /// No boundary point that comes to a fixed point is near a speed.
    #[error(
        "no speed within {within:e} of {alpha:?} comes to a fixed point exactly in at most {hops} hops; give a speed \
         nearer to the edge"
    )]
    NoEdge {
        /// The speed given.
        alpha: f64,
        /// The distance searched.
        within: f64,
        /// The largest number of hops.
        hops: usize,
    },
    /// No edge of grounding is near a speed.
    #[error("no edge of grounding within {within} of {alpha:?}; give a speed nearer to one")]
    NoGroundingEdge {
        /// The speed given.
        alpha: f64,
        /// The distance searched.
        within: f64,
    },
    /// An offset outside the range of a chart.
    #[error("the offset {y:e} is outside the chart about the edge: it holds up to {radius:e}")]
    OutsideChart {
        /// The offset given.
        y: f64,
        /// The radius of the chart.
        radius: f64,
    },
    /// A chart and a circle that do not belong together.
    #[error(
        "the edge belongs to the circle of α*_{n} at M = {mass_ratio}, not to that of α*_{other} at M = {other_ratio}"
    )]
    OtherCircle {
        /// The index of the chart's fixed point.
        n: u64,
        /// The mass ratio of the chart.
        mass_ratio: f64,
        /// The index of the given circle.
        other: u64,
        /// The mass ratio of the given circle.
        other_ratio: f64,
    },
    /// A boundary point at one mass ratio, and fates at another.
    #[error(
        "the edge belongs to M = {own}, and the fates to M = {other}; make both at one mass ratio"
    )]
    OtherMassRatio {
        /// The mass ratio of the boundary point.
        own: f64,
        /// The mass ratio of the fates.
        other: f64,
    },
    /// A depth at which no window about an edge is drawn.
    #[error(
        "a window about an edge needs a depth of at least 0 that is finite, and 1 to {most} pixels each way, not \
         {depth}, {columns} and {rows}"
    )]
    EdgeFrame {
        /// −log₁₀ of the half height.
        depth: f64,
        /// Pixels across.
        columns: usize,
        /// Pixels up.
        rows: usize,
        /// The largest number of pixels each way.
        most: usize,
    },
    /// Limits with which no pixel can be covered.
    #[error(
        "a coverage to a tolerance of {tolerance} from {samples} samples in a pixel: give a tolerance above 0 and \
         below 1, such as 0.004, and at least one sample"
    )]
    CoverageLimits {
        /// The share of a pixel that may stay undecided.
        tolerance: f64,
        /// The number of samples in a pixel.
        samples: usize,
    },
    /// A vertical axis that counts from an edge, for a raster left of a fixed point.
    #[error("left of a fixed point the axis upwards is Upwards::Depth or Upwards::Phase")]
    Upwards,
}
