//! A hybrid system of which statements are proved.

use crate::mode_series::ModeSeries;
use crate::undecided::Error;
use equations::{Formulas, Names};
use hybrid_system::{Direction, Equations, GuardParts, Label, ModeParts, Role};
use serde_json::{Value, json};

/// A hybrid system, by its [`Equations`], whose flows and events are enclosed.
///
/// Numbers that are written as decimals are these decimals: 0.2 is 1/5. A parameter may be an interval: name it when the system is
/// made, and it is a component of the state, the last one. If a formula uses the time, the time is a component before these.
#[derive(Debug)]
pub struct ValidatedSystem {
    equations: Equations,
    /// The parameters that are components of the state.
    intervals: Vec<String>,
    pub(crate) names: Names,
    pub(crate) modes: Vec<ValidatedMode>,
}

/// A mode with all that is evaluated in it.
#[derive(Debug)]
pub(crate) struct ValidatedMode {
    pub(crate) name: Label,
    pub(crate) series: ModeSeries,
    pub(crate) field: Formulas,
    pub(crate) guards: Vec<ValidatedGuard>,
}

/// A guard with all that is evaluated at its events.
#[derive(Debug)]
pub(crate) struct ValidatedGuard {
    pub(crate) surface: Label,
    direction: Direction,
    /// True if states beyond the surface cannot flow.
    bounds_flow: bool,
    /// True if the flow goes on through the surface: its events change nothing.
    pub(crate) observes: bool,
    pub(crate) function: Formulas,
    pub(crate) gradient: Formulas,
    pub(crate) condition: Option<Formulas>,
    pub(crate) stops: bool,
    /// The place of the mode after the event.
    pub(crate) mode: usize,
    /// The state after the event, and its derivatives, if it is another one.
    pub(crate) reset: Option<(Formulas, Formulas)>,
    /// For each guard of the mode after the event, true if it is 0 there because this guard is.
    pub(crate) begins_on: Vec<bool>,
}

impl ValidatedSystem {
    /// The system of these equations.
    ///
    /// ```
    /// use hybrid_system::Equations;
    /// use validated_dynamics::ValidatedSystem;
    /// let ball = Equations::new(&["height", "speed"], &[("restitution", "0.5")])
    ///     .mode_text("flight", &["speed", "-1"])
    ///     .falling_text("floor", "height")
    ///     .resets_text(&["height", "-restitution*speed"]);
    /// let ball = ValidatedSystem::new(&ball)?;
    /// let landing = ball.start("flight", &["0.5", "0"])?.next_event()?;
    /// assert!(landing.time.contains(1.0) && landing.time.width() < 1e-14);
    /// assert!(landing.after[1].contains(0.5));
    /// # Ok::<(), validated_dynamics::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Equations`] and [`Error::Formula`] for equations that are refused; [`Error::Argument`] for a clock, whose events are not
    /// followed.
    pub fn new(equations: &Equations) -> Result<ValidatedSystem, Error> {
        ValidatedSystem::with_interval_parameters(equations, &[])
    }

    /// The same with these parameters as the last components of the state.
    ///
    /// # Errors
    /// As [`new`](Self::new), and for a name that is no parameter.
    pub fn with_interval_parameters(
        equations: &Equations,
        parameters: &[&str],
    ) -> Result<ValidatedSystem, Error> {
        let parts = equations.mode_parts(parameters)?;
        let place = |name: Label| parts.iter().position(|mode| mode.name == name);
        let mode = |(own, mode): (usize, &ModeParts)| {
            let guard = |guard: &GuardParts| {
                let after = guard.mode.and_then(place).unwrap_or(own);
                ValidatedGuard::new(guard, own, (after, &parts[after]))
            };
            Ok(ValidatedMode {
                name: mode.name,
                series: ModeSeries::new(mode)?,
                field: mode.field.clone(),
                guards: mode.guards.iter().map(guard).collect::<Result<_, Error>>()?,
            })
        };
        let names = parts.first().map(|mode| mode.field.names().clone()).unwrap_or_default();
        let modes = parts.iter().enumerate().map(mode).collect::<Result<_, Error>>()?;
        let intervals = parameters.iter().map(|&name| name.to_owned()).collect();
        Ok(ValidatedSystem { equations: equations.clone(), intervals, names, modes })
    }

    /// The names of the components of the state, and the parameters with their values.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// All that statements about the system rest on, as texts and numbers.
    pub(crate) fn as_json(&self) -> Value {
        let one = |formulas: &Formulas| formulas.texts().pop();
        let guard = |guard: &ValidatedGuard| {
            json!({
                "surface": guard.surface.as_str(),
                "guard": one(&guard.function),
                "side_after": guard.side_after(),
                "bounds_flow": guard.bounds_flow,
                "condition": guard.condition.as_ref().map(one),
                "stops": guard.stops,
                "mode": self.modes[guard.mode].name.as_str(),
                "after": guard.reset.as_ref().map(|(after, _)| after.texts()),
            })
        };
        let mode = |mode: &ValidatedMode| {
            json!({
                "mode": mode.name.as_str(),
                "field": mode.field.texts(),
                "guards": mode.guards.iter().map(guard).collect::<Vec<_>>(),
            })
        };
        json!({
            "kind": "system",
            "states": self.names.states,
            "parameters": parameters_as_json(&self.names),
            "modes": self.modes.iter().map(mode).collect::<Vec<_>>(),
        })
    }

    /// Formulas of the state, from texts in the names of the equations.
    pub(crate) fn formulas(&self, texts: &[&str]) -> Result<Formulas, Error> {
        let intervals: Vec<&str> = self.intervals.iter().map(String::as_str).collect();
        let found = self.equations.texts_in_parts(texts, &intervals)?;
        without_time(found, "the model does not use the time: add a state whose rate is 1")
    }

    pub(crate) fn place_of(&self, mode: &str) -> Result<usize, Error> {
        let place = self.modes.iter().position(|known| known.name == *mode);
        let known: Vec<&str> = self.modes.iter().map(|mode| mode.name.as_str()).collect();
        place.map_or_else(
            || Error::argument(mode, format!("no mode; the modes are {}", known.join(", "))),
            Ok,
        )
    }

    /// The label of a surface that some mode has.
    pub(crate) fn surface(&self, surface: &str) -> Result<Label, Error> {
        let guards = self.modes.iter().flat_map(|mode| &mode.guards);
        let mut known: Vec<Label> = guards.map(|guard| guard.surface).collect();
        known.dedup();
        match known.iter().find(|known| **known == *surface) {
            Some(known) => Ok(*known),
            None => {
                let names: Vec<&str> = known.iter().map(Label::as_str).collect();
                Error::argument(
                    surface,
                    format!("no surface; the surfaces are {}", names.join(", ")),
                )
            }
        }
    }
}

impl ValidatedGuard {
    /// The sign of the guard behind a crossing that counts; `None` if both directions count.
    pub(crate) fn side_after(&self) -> Option<f64> {
        match self.direction {
            Direction::Rising => Some(1.0),
            Direction::Falling => Some(-1.0),
            Direction::Either => None,
        }
    }

    /// The sign of the guard beyond its surface, where no state can flow; `None` if states on both sides can.
    pub(crate) fn side_beyond(&self) -> Option<f64> {
        self.side_after().filter(|_| self.bounds_flow)
    }

    /// The guard of a mode, whose events lead to the mode with these parts, in this place.
    fn new(
        parts: &GuardParts,
        own: usize,
        (mode, after): (usize, &ModeParts),
    ) -> Result<ValidatedGuard, Error> {
        let surface = parts.guard.surface;
        let is_without_jump = !parts.stops && parts.mode.is_none() && parts.state.is_none();
        let bounds_flow = match parts.guard.role {
            Role::Contact => true,
            Role::Switch => !is_without_jump,
            Role::Crossing => false,
            Role::Clock => {
                return Error::argument(
                    surface.as_str(),
                    "a clock, whose events are not followed: write a guard of the time t for them",
                );
            }
            Role::Undone => {
                return Error::argument(
                    surface.as_str(),
                    "a surface of equations backward in time, which are not followed: give those forward in time",
                );
            }
        };
        let reset =
            parts.state.as_ref().map(|state| Ok::<_, Error>((state.clone(), state.jacobian()?)));
        let is_zero = |other: &GuardParts| match &parts.state {
            Some(state) => other.function.on(state).is_ok_and(|composed| {
                composed.vanishes() == [true] || composed.is_written_as(&parts.function)
            }),
            None => other.function.is_written_as(&parts.function),
        };
        Ok(ValidatedGuard {
            surface,
            direction: parts.guard.direction,
            bounds_flow,
            observes: !parts.stops && mode == own && parts.state.is_none() && !bounds_flow,
            gradient: parts.function.jacobian()?,
            function: parts.function.clone(),
            condition: parts.condition.clone(),
            stops: parts.stops,
            mode,
            begins_on: after.guards.iter().map(is_zero).collect(),
            reset: reset.transpose()?,
        })
    }
}

/// An error for formulas of the time, which has no value where they are used.
pub(crate) fn without_time(formulas: Formulas, reason: &str) -> Result<Formulas, Error> {
    match formulas.uses_time() {
        true => Error::argument("t", reason),
        false => Ok(formulas),
    }
}

/// The names of parameters with their values as texts.
pub(crate) fn parameters_as_json(names: &Names) -> Value {
    let values = names.values.iter().map(ToString::to_string);
    names.parameters.iter().zip(values).map(|(name, value)| json!([name, value])).collect()
}
