//! The result of a search for the next event of an arc.

use super::certainty::Certainty;

/// What kind of event it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum EventKind {
    /// A guard changes sign in its direction.
    Crossing,
    /// A guard touches its surface, within rounding, and goes back. Only guards with
    /// [`Touch::Event`](crate::Touch::Event) have such events.
    Touch,
    /// An event at once, at the start of an arc: the jump before led to the surface of this guard or beyond it.
    AtStart,
    /// A preset time of a [clock](crate::Role::Clock).
    Clock,
}

/// The first event of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing<S, X> {
    /// The surface that is crossed.
    pub surface: S,
    /// Time since the start of the arc.
    pub time: f64,
    /// How far `time` may be from the zero of the guard along the *computed* trajectory, by rounding: a few ulps,
    /// or more where rounding hides the guard. The order of events follows from it alone.
    pub time_rounding: f64,
    /// How far `time` may be from the event of the *true* trajectory: at least `time_rounding`; a bound for closed
    /// forms, an estimate from the tolerances for integrated flows. It is stated, and decides nothing.
    pub time_error: f64,
    /// The state on the surface, before any reset. A model that solves its crossings may know this state more
    /// accurately than its flow gives it at the rounded time.
    pub state: X,
    /// A crossing or a touch.
    pub kind: EventKind,
    /// The side from which a crossed guard comes, ±1, if the search knows it.
    pub from: Option<f64>,
    /// How certain it is that this is the first event.
    pub certainty: Certainty,
}

impl<S, X> Crossing<S, X> {
    /// A crossing for which the model has solved, with a time that is wrong by two ulps at most.
    pub const fn exact(surface: S, time: f64, state: X) -> Self {
        Crossing {
            surface,
            time,
            time_rounding: 2.0 * f64::EPSILON * time,
            time_error: 2.0 * f64::EPSILON * time,
            state,
            kind: EventKind::Crossing,
            from: None,
            certainty: Certainty::Exact,
        }
    }
}

/// The result of a search for the next event of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NextEvent<S, X> {
    /// The first event.
    Crossing(Crossing<S, X>),
    /// There is no event up to the horizon of the search.
    None {
        /// The state at the horizon, if the search has computed it.
        state: Option<X>,
        /// How certain it is.
        certainty: Certainty,
    },
    /// A budget of the search ended. There is no event up to `time`, and the search can go on from there.
    Unfinished {
        /// Time since the start of the arc.
        time: f64,
        /// The state at that time.
        state: X,
        /// How certain it is that there is no event before.
        certainty: Certainty,
    },
}

impl<S, X> NextEvent<S, X> {
    /// No event up to the horizon, by the model's own solution.
    pub const fn never() -> Self {
        NextEvent::None { state: None, certainty: Certainty::Exact }
    }

    /// The crossing, if there is one.
    pub fn crossing(self) -> Option<Crossing<S, X>> {
        match self {
            NextEvent::Crossing(crossing) => Some(crossing),
            NextEvent::None { .. } | NextEvent::Unfinished { .. } => None,
        }
    }
}

impl<S, X> From<Option<Crossing<S, X>>> for NextEvent<S, X> {
    /// The result of a model that has solved for its crossings.
    fn from(crossing: Option<Crossing<S, X>>) -> Self {
        crossing.map_or(NextEvent::never(), NextEvent::Crossing)
    }
}
