//! What is not proved, and why.

use hybrid_system::Label;
use interval_arithmetic::Enclosure;
use std::fmt;
use thiserror::Error;

/// A statement that is not proved: why, where and when.
///
/// Nothing is said about the states of the set then. Smaller sets are often decided: see [`divided`](crate::divided).
#[derive(Debug, Clone, PartialEq, Error)]
#[error("undecided{} at t in {}, {}: {reason}", mode_of(.mode), .time, States(.names, .states))]
pub struct Undecided {
    /// Why.
    pub reason: Reason,
    /// The mode in which the states were.
    pub mode: Option<Label>,
    /// The time since the start.
    pub time: Enclosure,
    /// A box that holds the states at that time.
    pub states: Vec<Enclosure>,
    /// The names of the components.
    pub names: Vec<String>,
}

/// Why a statement is not proved.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Reason {
    /// Some states may only touch a surface, or cross it back.
    #[error("states may touch {surface} without crossing it: take a smaller set")]
    Grazing {
        /// The surface.
        surface: Label,
    },
    /// States on a surface, of which the side to which they leave is not known.
    #[error(
        "the set begins on {surface} or on both sides of it, and may cross it at once: take a smaller set"
    )]
    OnSurface {
        /// The surface.
        surface: Label,
    },
    /// States beyond a surface that bounds the flow, or on it with a flow that leads beyond.
    #[error(
        "the states are beyond {surface}, or on it with a flow that leads beyond: they rest there, slide, or chatter"
    )]
    Beyond {
        /// The surface.
        surface: Label,
    },
    /// The first event may be that of one surface or of another.
    #[error("{first} and {second} may be met at the same time: take a smaller set")]
    TwoSurfaces {
        /// A surface.
        first: Label,
        /// Another one.
        second: Label,
    },
    /// Not all states cross a surface within one step.
    #[error("the set is too wide to cross {surface} in one step: take a smaller set")]
    TooWide {
        /// The surface.
        surface: Label,
    },
    /// The condition of an event may be positive or negative.
    #[error("the condition of {surface} may hold or not: take a smaller set")]
    Condition {
        /// The surface.
        surface: Label,
    },
    /// A formula may have no value on the set.
    #[error("{0}")]
    Domain(equations::Error),
    /// No step, however short, is proved to have a solution.
    #[error(
        "no solution is proved on a step of {step:e}: the states are too far apart, or the solution ends here"
    )]
    NoSolution {
        /// The shortest step that was tried.
        step: f64,
    },
    /// The steps are used up.
    #[error("{steps} steps were not enough: raise `Limits::steps`")]
    Steps {
        /// The limit.
        steps: usize,
    },
    /// The states are further apart than the limit.
    #[error(
        "the states are {width} apart, above the limit {limit}: take a smaller set, or raise `Limits::width`"
    )]
    Wide {
        /// The largest width of a component.
        width: f64,
        /// The limit.
        limit: f64,
    },
    /// The events are used up. Their times may have a limit (Zeno).
    #[error(
        "{events} events were not enough, the last one at {surface}: their times may have a limit; else raise `Limits::events`"
    )]
    Events {
        /// The limit.
        events: usize,
        /// The surface of the last one.
        surface: Label,
    },
    /// No event until a time.
    #[error("no event up to the time {time}: raise `Limits::time`")]
    NoEvent {
        /// The limit.
        time: f64,
    },
    /// An event that ends the execution came first; or the images lie in a set of a map of formulas.
    #[error("all points come to an end at {surface}")]
    Stopped {
        /// The surface, or the set.
        surface: Label,
    },
    /// An event may happen before the time at which the states are wanted, or after it.
    #[error(
        "states may meet {surface} before or after the time that is asked for: take another time, or a smaller set"
    )]
    EventAtEnd {
        /// The surface.
        surface: Label,
    },
    /// The states have times that are too different for one step to the time at which they are wanted.
    #[error(
        "the states have come to their last event at times that are {width:e} apart, too far for one step to the end: take a smaller set, or a later time"
    )]
    Times {
        /// How far the times are apart.
        width: f64,
    },
    /// The caller stopped the computation.
    #[error("interrupted")]
    Interrupted,
    /// An image is not inside of what it must be inside of.
    #[error("the image of the box is not inside of it{}", if *.tries > 1 { format!(", of {tries} boxes") } else { String::new() })]
    NotInside {
        /// The number of boxes that were tried.
        tries: usize,
    },
    /// The map leads to another mode than that from which it is to be applied again, or to the end of the execution.
    #[error(
        "the map ends {}, and is to begin in the mode {wanted} again: it has no orbits of its own",
        ended.map_or("the execution".to_owned(), |mode| format!("in the mode {mode}"))
    )]
    OtherMode {
        /// The mode after the last event; `None` if this event ends the execution.
        ended: Option<Label>,
        /// The mode in which the next map begins.
        wanted: Label,
    },
    /// Newton's method found no point.
    #[error(
        "Newton's method found no fixed point near the start: the last step had the length {step:e}"
    )]
    NoPoint {
        /// The length of the last step.
        step: f64,
    },
    /// A matrix that must be invertible may be singular.
    #[error(
        "the derivatives may have the eigenvalue 1: the fixed point may be multiple, or the box too wide"
    )]
    Singular,
}

/// An undecided statement, or a wrong question.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// What was asked is not proved.
    #[error(transparent)]
    Undecided(#[from] Box<Undecided>),
    /// The equations are refused.
    #[error(transparent)]
    Equations(#[from] hybrid_system::Error),
    /// Formulas are refused.
    #[error(transparent)]
    Formula(#[from] equations::Error),
    /// Two ends are no interval.
    #[error(transparent)]
    Interval(#[from] interval_arithmetic::Error),
    /// An argument is refused.
    #[error("{what}: {reason}")]
    Argument {
        /// The argument.
        what: String,
        /// Why.
        reason: String,
    },
}

impl Error {
    /// True if an event ends the execution of all points.
    pub(crate) fn is_stop(&self) -> bool {
        matches!(self, Error::Undecided(undecided) if matches!(undecided.reason, Reason::Stopped { .. }))
    }

    /// A statement that is not proved.
    pub(crate) fn not_proved(
        reason: Reason,
        mode: Option<Label>,
        time: Enclosure,
        (names, states): (&[String], &[Enclosure]),
    ) -> Error {
        let (names, states) = (names.to_vec(), states.to_vec());
        Error::Undecided(Box::new(Undecided { reason, mode, time, states, names }))
    }

    /// The same of a map whose variables have no names.
    pub(crate) fn of_variables(reason: Reason, states: &[Enclosure]) -> Error {
        let names: Vec<String> =
            (1..=states.len()).map(|place| format!("variable {place}")).collect();
        Error::not_proved(reason, None, Enclosure::ZERO, (&names, states))
    }

    pub(crate) fn argument<T>(
        what: impl Into<String>,
        reason: impl Into<String>,
    ) -> Result<T, Error> {
        Err(Error::Argument { what: what.into(), reason: reason.into() })
    }

    /// What is not proved, if this is the error.
    pub fn undecided(&self) -> Option<&Undecided> {
        match self {
            Error::Undecided(undecided) => Some(undecided),
            _ => None,
        }
    }
}

fn mode_of(mode: &Option<Label>) -> String {
    mode.map_or(String::new(), |mode| format!(" in mode {mode}"))
}

struct States<'s>(&'s [String], &'s [Enclosure]);

impl fmt::Display for States<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (name, state)) in self.0.iter().zip(self.1).enumerate() {
            write!(formatter, "{}{name} in {}", if place > 0 { ", " } else { "" }, state)?;
        }
        Ok(())
    }
}
