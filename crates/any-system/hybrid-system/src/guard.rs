//! Guards: the surfaces that a mode searches, the side from which a crossing counts, and what else counts.

/// The side from which a crossing counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both ways.
    Either,
}

impl Direction {
    /// The direction in which a guard changes its sign backward in time.
    #[cfg(feature = "ode")]
    pub(crate) fn backward(self) -> Self {
        match self {
            Direction::Rising => Direction::Falling,
            Direction::Falling => Direction::Rising,
            Direction::Either => Direction::Either,
        }
    }

    /// True if a change of sign from `before` to `after`, both non-zero, counts.
    pub fn admits(self, before: f64, after: f64) -> bool {
        match self {
            Direction::Rising => before < 0.0 && after > 0.0,
            Direction::Falling => before > 0.0 && after < 0.0,
            Direction::Either => (before < 0.0) != (after < 0.0),
        }
    }

    /// True if `value` is on a side to which a crossing that counts leads.
    pub(crate) fn leads_to(self, value: f64) -> bool {
        match self {
            Direction::Rising => value > 0.0,
            Direction::Falling => value < 0.0,
            Direction::Either => value != 0.0,
        }
    }

    /// True if a state whose guard has this value is beyond the surface: on the side that only events reach. A
    /// guard that counts both ways has no such side.
    pub(crate) fn is_beyond(self, value: f64) -> bool {
        self != Direction::Either && self.leads_to(value)
    }
}

/// The part that a guard plays in its mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// An event where the flow crosses the surface, and the author has not said what a state beyond it means. A
    /// jump to such a state is the error [`LandsBeyond`](crate::Error::LandsBeyond), which names both words: a
    /// contact and a crossing.
    Switch,
    /// A contact that holds, such as a floor: the surface bounds the flow of the mode, and no state beyond it can
    /// flow. A jump to a state beyond it is an event at once; an initial state beyond it is an error.
    Contact,
    /// An event only where the flow crosses the surface, such as a Poincaré section, or the touchdown of a leg that
    /// takes off below the height of its touchdown. States on both sides can flow: a start on the surface or beyond
    /// it is no event.
    Crossing,
    /// The surface to which jumps lead, of a run backward ([`Equations::reversed`](crate::Equations::reversed)): as a crossing, and a
    /// start on the surface is an event at once, too. The event undoes a jump.
    Undone,
    /// The events happen at preset times, see [`HybridSystem::next_time`](crate::HybridSystem::next_time). The
    /// value of the guard is not used.
    Clock,
}

impl Role {
    /// True if the mode flows on one side of the surface only.
    pub(crate) fn bounds_flow(self) -> bool {
        matches!(self, Role::Switch | Role::Contact)
    }
}

/// What happens where a guard touches its surface: it comes within rounding of zero and goes back to the side from
/// which it came.
///
/// Rounding hides whether such a guard stays away, touches, or crosses twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Touch {
    /// The search returns [`Error::Grazing`](crate::Error::Grazing).
    Error,
    /// An event of the kind [`EventKind::Touch`](crate::EventKind::Touch).
    Event,
    /// No event: the search goes on behind the touch.
    Ignore,
}

/// A switching surface, and what happens there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Guard<S> {
    /// The model's name of the surface {x : g(x) = 0}.
    pub surface: S,
    /// The direction in which a crossing is an event.
    pub direction: Direction,
    /// The part that the guard plays.
    pub role: Role,
    /// What a touch is.
    pub touch: Touch,
}

impl<S> Guard<S> {
    const fn new(surface: S, direction: Direction, role: Role) -> Self {
        Guard { surface, direction, role, touch: Touch::Error }
    }
    /// An event when g goes from negative to positive. The mode flows where g < 0.
    pub const fn rising(surface: S) -> Self {
        Self::new(surface, Direction::Rising, Role::Switch)
    }
    /// An event when g goes from positive to negative. The mode flows where g > 0.
    pub const fn falling(surface: S) -> Self {
        Self::new(surface, Direction::Falling, Role::Switch)
    }
    /// An event at every change of sign. The mode flows on both sides.
    pub const fn either(surface: S) -> Self {
        Self::new(surface, Direction::Either, Role::Switch)
    }
    /// Events at preset times.
    pub const fn clock(surface: S) -> Self {
        Self::new(surface, Direction::Either, Role::Clock)
    }
}

#[cfg(feature = "ode")]
impl<S: Copy> Guard<S> {
    /// The guard of a run backward, in the mode that its events leave. The mode flows on the same side of its bounds; a crossing that is
    /// no observer ends the run where the event would have been.
    pub(crate) fn backward(self, observes: bool) -> Self {
        match self.role {
            Role::Clock => self,
            Role::Switch | Role::Contact if !observes && self.direction != Direction::Either => {
                Guard { role: Role::Contact, ..self }
            }
            _ => Guard { role: Role::Crossing, direction: self.direction.backward(), ..self },
        }
    }

    /// The same guard with the name of another surface.
    pub(crate) fn named<R>(self, surface: R) -> Guard<R> {
        let Guard { direction, role, touch, .. } = self;
        Guard { surface, direction, role, touch }
    }
}

impl<S: Copy> Guard<S> {
    /// The same guard as a contact that holds: a jump to a state beyond the surface is an event at once.
    #[must_use]
    pub const fn contact(mut self) -> Self {
        self.role = Role::Contact;
        self
    }
    /// The same guard as a crossing: an event only where the flow crosses the surface. The mode flows on both sides
    /// of it.
    #[must_use]
    pub const fn crossing(mut self) -> Self {
        self.role = Role::Crossing;
        self
    }
    /// The same guard with this treatment of touches.
    #[must_use]
    pub const fn touch(mut self, touch: Touch) -> Self {
        self.touch = touch;
        self
    }
}
