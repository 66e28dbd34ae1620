//! Where guards turn along a motion, and equations along one sequence of events.

use super::equations::{Equations, GuardEquations, Jump, ModeEquations, NO_MODE};
use super::label::Label;
use crate::error::Error;
use crate::guard::{Direction, Guard, Role, Touch};
use equations::Formulas;

/// An observer of the points at which a guard has an extremum along the motion of a mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Turn {
    /// The mode.
    pub mode: Label,
    /// The surface of the guard.
    pub surface: Label,
    /// The guard g.
    pub guard: Formulas,
    /// The surface of the observer: ġ rises through zero where g has a minimum, and falls where it has a maximum.
    pub observer: Label,
}

impl Equations {
    /// The same equations with an observer for each guard, of the points at which it turns: where it has an extremum along the motion.
    /// There an orbit that does not meet a surface is nearest to it.
    ///
    /// Clocks have no turns, nor have guards with kinks and guards that do not change along the motion.
    ///
    /// ```
    /// use hybrid_system::{Equations, State};
    /// let ball = Equations::new(&["height", "speed"], &[])
    ///     .mode_text("flight", &["speed", "-1"])
    ///     .rising_text("ceiling", "height - 2")
    ///     .stops();
    /// let (observed, turns) = ball.with_turns()?;
    /// let first = observed.model::<State<2>>()?.start("flight", [0.0, 1.0], 9.0)?.next();
    /// let event = first.expect("an arc")?.event().copied().expect("an event");
    /// assert_eq!((event.surface, turns[0].surface.as_str()), (turns[0].observer, "ceiling"));
    /// // The top of the flight is 1.5 below the ceiling.
    /// assert!((turns[0].guard.first_value(event.time, &[event.before[0], event.before[1]]) + 1.5).abs() < 1e-15);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`check`](Self::check); [`Error::BadEquations`] if a guard has the name of such an observer.
    pub fn with_turns(&self) -> Result<(Equations, Vec<Turn>), Error> {
        self.check()?;
        let (mut observed, mut turns) = (self.clone(), Vec::new());
        for mode in &mut observed.modes {
            let known = mode.guards.clone();
            let guards = self.everywhere.iter().chain(&known);
            let (observers, own) = turns_of(mode.name, &mode.field, guards)?;
            mode.guards.extend(observers);
            turns.extend(own);
        }
        Ok((observed, turns))
    }

    /// These equations along one sequence of events, each with its mode and its surface, with [turns](Self::with_turns).
    ///
    /// Each passage from one event to the next has a mode of its own, with the guard of its event alone: an event of another surface
    /// does not end it. So the motion depends smoothly on its start where the events are transversal, beyond the borders at which other events come in. The modes are
    /// `"passage 0"`, `"passage 1"`, …, and `"end"` after the last event, without guards.
    ///
    /// ```
    /// use hybrid_system::{Equations, Label, State};
    /// let ball = Equations::new(&["height", "speed"], &[])
    ///     .mode_text("flight", &["speed", "-1"])
    ///     .rising_text("ceiling", "height - 2")
    ///     .stops()
    ///     .falling_text("floor", "height")
    ///     .resets_text(&["height", "-speed"]);
    /// let labels = (Label::new("flight")?, Label::new("floor")?);
    /// let (along, _) = ball.along_events(&[labels])?;
    /// // It passes the ceiling.
    /// let model = along.model::<State<2>>()?;
    /// let mut arcs = model.start("passage 0", [0.0, 3.0], 7.0)?;
    /// let landing = arcs.find_map(|arc| Some(arc.ok()?.event().copied()).filter(|event| event.is_some_and(|event| event.surface == "floor")));
    /// assert!((landing.flatten().expect("a landing").time - 6.0).abs() < 1e-14);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`with_turns`](Self::with_turns); [`Error::BadEquations`] for a mode or a surface that is not there.
    pub fn along_events(&self, events: &[(Label, Label)]) -> Result<(Equations, Vec<Turn>), Error> {
        self.check()?;
        let mut along = Equations::of_names(self.names.clone());
        let (mut turns, mut last) = (Vec::new(), None);
        for (place, (mode, surface)) in events.iter().enumerate() {
            let name = Label::new(&format!("passage {place}"))?;
            let next = match place + 1 == events.len() {
                true => Label::new("end")?,
                false => Label::new(&format!("passage {}", place + 1))?,
            };
            let mode = self.known_mode(*mode)?;
            let mut event = self.guard_of(mode, *surface)?.clone();
            let jump = event.jump.get_or_insert_default();
            last = Some(jump.mode.unwrap_or(mode.name));
            jump.mode = Some(next);
            let all = self.everywhere.iter().chain(&mode.guards);
            let (mut guards, own) = turns_of(name, &mode.field, all)?;
            guards.insert(0, event);
            turns.extend(own);
            let field = mode.field.clone();
            along.modes.push(ModeEquations { name, field, guards, after_limit: None });
        }
        if let Some(last) = last {
            let field = self.known_mode(last)?.field.clone();
            let (name, guards) = (Label::new("end")?, Vec::new());
            along.modes.push(ModeEquations { name, field, guards, after_limit: None });
        }
        Ok((along, turns))
    }

    /// The formula of a guard in a mode; `None` if there is none.
    pub fn guard_formula(&self, mode: Label, surface: Label) -> Option<&Formulas> {
        let mode = self.known_mode(mode).ok()?;
        Some(&self.guard_of(mode, surface).ok()?.function)
    }

    /// The field of a mode.
    ///
    /// # Errors
    /// [`Error::BadEquations`] if there is no such mode.
    pub fn field(&self, mode: Label) -> Result<&Formulas, Error> {
        Ok(&self.known_mode(mode)?.field)
    }

    /// The mode and the surface of each guard, in order.
    pub fn surfaces(&self) -> impl Iterator<Item = (Label, Label)> + '_ {
        self.modes.iter().flat_map(|mode| {
            let all = self.everywhere.iter().chain(&mode.guards);
            all.map(|guard| (mode.name, guard.guard.surface))
        })
    }

    /// The mode to which the event of a guard leads; `None` if there is no such guard, or its event ends the execution.
    pub fn leads_to(&self, mode: Label, surface: Label) -> Option<Label> {
        let mode = self.known_mode(mode).ok()?;
        let jump = self.guard_of(mode, surface).ok()?.jump.as_ref()?;
        Some(jump.mode.unwrap_or(mode.name))
    }

    fn known_mode(&self, name: Label) -> Result<&ModeEquations, Error> {
        let known = self.modes.iter().find(|mode| mode.name == name);
        known.ok_or_else(|| Error::BadEquations { what: name.to_string(), reason: NO_MODE })
    }

    fn guard_of<'e>(
        &'e self,
        mode: &'e ModeEquations,
        surface: Label,
    ) -> Result<&'e GuardEquations, Error> {
        let mut all = self.everywhere.iter().chain(&mode.guards);
        let reason = "the mode has no guard of this name";
        all.find(|guard| guard.guard.surface == surface)
            .ok_or_else(|| Error::BadEquations { what: surface.to_string(), reason })
    }
}

/// The observers of the turns of some guards along a field.
fn turns_of<'g>(
    mode: Label,
    field: &Formulas,
    guards: impl Iterator<Item = &'g GuardEquations>,
) -> Result<(Vec<GuardEquations>, Vec<Turn>), Error> {
    let guards: Vec<&GuardEquations> = guards.collect();
    let (mut observers, mut turns) = (Vec::new(), Vec::new());
    for (place, guard) in guards.iter().enumerate() {
        let observer = Label::new(&format!("turn of guard {place}"))?;
        if guard.guard.surface == observer {
            return guard.bad("the name is that of an observer of turns: take another one");
        }
        // A guard with a kink has no rate.
        let rate = match guard.guard.role {
            Role::Clock => None,
            _ => guard.function.rate(field).ok(),
        };
        let Some(rate) = rate.filter(|rate| rate.constants().iter().all(Option::is_none)) else {
            continue;
        };
        let (direction, role, touch) = (Direction::Either, Role::Crossing, Touch::Ignore);
        observers.push(GuardEquations {
            guard: Guard { surface: observer, direction, role, touch },
            function: rate,
            listed: false,
            condition: None,
            jump: Some(Jump::default()),
        });
        let (surface, guard) = (guard.guard.surface, guard.function.clone());
        turns.push(Turn { mode, surface, guard, observer });
    }
    Ok((observers, turns))
}
