//! Reasons for a missing result.

use thiserror::Error;

/// Why a point has no image, or a search has no result.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The execution ended before it returned to the section.
    #[error(
        "no return to the section from {start:?}{of}: the execution stopped ({stop:?}{at}) after {time} time units and {events} events",
        at = surface.as_ref().map_or(String::new(), |surface| format!(" at {surface}")),
        of = parameter.map_or(String::new(), |parameter| format!(" at the parameter {parameter}"))
    )]
    NoReturn {
        /// Where it began: coordinates of the section.
        start: Vec<f64>,
        /// The parameter, of a map that has one.
        parameter: Option<f64>,
        /// Why the execution ended.
        stop: hybrid_system::Stop,
        /// The surface of the event that ended it, for [`Stop::Terminal`](hybrid_system::Stop::Terminal).
        surface: Option<String>,
        /// Time from the start to the end of the execution.
        time: f64,
        /// Number of events until then.
        events: usize,
    },
    /// The execution failed.
    #[error("the execution failed: {0}")]
    Execution(#[from] hybrid_system::Error),
    /// A formula that is refused, or has no value.
    #[error(transparent)]
    Formula(#[from] equations::Error),
    /// A map gives no finite image.
    #[error("the map has no finite image at {point:?} and the parameter {parameter}")]
    NoImage {
        /// The point.
        point: Vec<f64>,
        /// The parameter.
        parameter: f64,
    },
    /// The map has another piece, or none, next to a point, so that its derivatives by differences are unknown.
    #[error(
        "no derivatives at {point:?} and the parameter {parameter}: the map is not smooth within {distance} of the point, on its scale"
    )]
    Differences {
        /// The point.
        point: Vec<f64>,
        /// The parameter.
        parameter: f64,
        /// The smallest distance that was tried.
        distance: f64,
    },
    /// A window that is empty or not finite, or a number of samples that is too small or too large.
    #[error(
        "cannot search [{left}, {right}] with {samples} samples: the ends must be finite, the left one smaller, and \
         the samples from 3 to {most}"
    )]
    BadWindow {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
        /// The requested number of samples.
        samples: usize,
        /// The most samples.
        most: usize,
    },
    /// Newton's method found no periodic point.
    #[error(
        "no periodic point found near {point:?}{at}: the largest component of f(x) − x is {residual} there, after {steps} Newton steps. \
         Begin closer to the point",
        at = parameter.map_or(String::new(), |parameter| format!(" at the parameter {parameter}"))
    )]
    NoPeriodicPoint {
        /// Where the search has begun, or has got stuck.
        point: Vec<f64>,
        /// The parameter, of a map that has one.
        parameter: Option<f64>,
        /// The largest component of |fᵖ(x) − x| at this point.
        residual: f64,
        /// Newton steps taken.
        steps: usize,
    },
    /// The equations of a branch are singular at its start: it has no direction there.
    #[error(
        "no branch begins at {point:?} and the parameter {parameter}: branches cross there, or all points beside it are solutions. Begin \
         beside it"
    )]
    Singular {
        /// The point.
        point: Vec<f64>,
        /// The parameter.
        parameter: f64,
    },
    /// A periodic point has no one-dimensional unstable manifold.
    #[error(
        "no unstable manifold of one dimension at {point:?}, for the parameter {parameter}: {unstable} multipliers are outside of the \
         unit circle. One must be, and the map smooth at the point"
    )]
    NoSaddle {
        /// The point.
        point: Vec<f64>,
        /// The parameter.
        parameter: f64,
        /// How many multipliers are outside of the unit circle.
        unstable: usize,
    },
    /// Two manifolds do not touch near a crossing.
    #[error(
        "no tangency found: at the parameter {parameter} the distance of the manifolds and the sine of their angle are {residual}. Begin \
         with a crossing at a smaller angle"
    )]
    NoTangency {
        /// The last parameter.
        parameter: f64,
        /// The distance of both points and the sine of the angle, as one length.
        residual: f64,
    },
    /// A branch goes on with another map than its own.
    #[error(
        "the end of the branch, {point:?} at the parameter {parameter}, is no periodic point of this map: take the map of the branch"
    )]
    OtherBranch {
        /// The end.
        point: Vec<f64>,
        /// The parameter.
        parameter: f64,
    },
    /// No branch goes on behind a border.
    #[error(
        "no point of a branch with the pieces {beyond} was found beside the border at {point:?} and the parameter {parameter}: begin at one \
         with `follow_branch`"
    )]
    NothingBehind {
        /// The point on the border.
        point: Vec<f64>,
        /// The parameter.
        parameter: f64,
        /// The pieces behind it.
        beyond: String,
    },
    /// A map is not known beyond the border of a piece.
    #[error(
        "the map does not go on beyond the piece of {event:?}: it must be that of equations, and the piece a sequence of their events"
    )]
    NoPassage {
        /// The piece, or what is no event of it.
        event: String,
    },
    /// A border that no curve in two parameters follows.
    #[error(
        "no curve of this border, {border}: a grazing or a corner of guards with formulas has one"
    )]
    BorderNotFollowed {
        /// The border.
        border: String,
    },
    /// A map of one variable has more pieces than can be kept.
    #[error(
        "more than {most} pieces between {left} and {at}: take a smaller window, or a tolerance above the noise of the map"
    )]
    ManyPieces {
        /// The left end of what was looked at.
        left: f64,
        /// Where the search was.
        at: f64,
        /// The most pieces.
        most: usize,
    },
    /// A periodic point has no neighbourhood that leads to it.
    #[error(
        "no trap about the periodic point {point:?} at the parameter {parameter}: its largest multiplier is {multiplier}. It must be \
         below 1, and the map smooth at the orbit"
    )]
    NoTrap {
        /// The point.
        point: Vec<f64>,
        /// The parameter.
        parameter: f64,
        /// The largest size of a multiplier.
        multiplier: f64,
    },
    /// A search of another kind than the one that it begins with: the curve of a bifurcation, say, with a border.
    #[error("{needed} is needed, and not {found}")]
    OtherStart {
        /// What is needed.
        needed: &'static str,
        /// What was given.
        found: String,
    },
    /// An orbit comes to infinitely many returns in finite time.
    #[error(
        "the returns become infinitely many in finite time near {point:?} at the parameter {parameter}: their product has no derivative. Take \
         a section that chattering does not meet"
    )]
    Accumulates {
        /// Where.
        point: Vec<f64>,
        /// The parameter.
        parameter: f64,
    },
    /// The work was stopped by its [watcher](crate::watched).
    #[error("stopped after {images} images of the map")]
    Stopped {
        /// How many images were computed.
        images: usize,
    },
    /// A window, a step, a number of something that cannot be used.
    #[error("{what} cannot be {value}")]
    BadArgument {
        /// What is wrong.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A period of no point, or one that is too long for a search.
    #[error("cannot search a point of period {period}: the period must be from 1 to {most}")]
    BadPeriod {
        /// The requested period.
        period: usize,
        /// The longest period that is searched.
        most: usize,
    },
}

impl Error {
    /// The same for a missing return, with the point at which it began.
    pub(crate) fn at_start(self, point: &[f64], of: Option<f64>) -> Error {
        match self {
            Error::NoReturn { stop, surface, time, events, .. } => Error::NoReturn {
                start: point.to_vec(),
                parameter: of,
                stop,
                surface,
                time,
                events,
            },
            other => other,
        }
    }
}
