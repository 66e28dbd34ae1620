//! The formulas of which equations consist, for programs that compute with other numbers than `f64`.

use super::equations::{Equations, GuardEquations, Jump, ModeEquations};
use super::label::Label;
use super::programs::with_time;
use crate::error::Error;
use crate::guard::Guard;
use equations::{Constant, Formulas, Node};

/// A mode by its formulas alone.
///
/// They are free of the time: if any formula of the equations uses it, the time is a component of the state, behind those that have names. Behind
/// it stand the parameters that were asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeParts {
    /// The name of the mode.
    pub name: Label,
    /// The rates of all components.
    pub field: Formulas,
    /// The guards, those of all modes first.
    pub guards: Vec<GuardParts>,
}

/// A guard by its formulas alone.
#[derive(Debug, Clone, PartialEq)]
pub struct GuardParts {
    /// Its surface, its direction and its role.
    pub guard: Guard<Label>,
    /// The guard; of a clock its times.
    pub function: Formulas,
    /// Its events count where this is positive.
    pub condition: Option<Formulas>,
    /// True if its event ends the execution.
    pub stops: bool,
    /// The mode after its event, if it is another one.
    pub mode: Option<Label>,
    /// The state after its event, if it is another one.
    pub state: Option<Formulas>,
}

impl Equations {
    /// The formulas of all modes, with these parameters as components of the state.
    ///
    /// ```
    /// use hybrid_system::Equations;
    /// let ball = Equations::new(&["height", "speed"], &[("gravity", "9.81"), ("restitution", "0.8")])
    ///     .mode_text("flight", &["speed", "-gravity"])
    ///     .falling_text("floor", "height")
    ///     .resets_text(&["height", "-restitution*speed"]);
    /// let flight = &ball.mode_parts(&["restitution"])?[0];
    /// assert_eq!(flight.field.names().states, ["height", "speed", "restitution"]);
    /// assert_eq!(flight.field.texts(), ["speed", "-gravity", "0"]);
    /// let after = flight.guards[0].state.as_ref().expect("a reset");
    /// assert_eq!(after.texts()[2], "restitution");
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`check`](Self::check); [`Error::Formula`] for a name that is no parameter.
    pub fn mode_parts(&self, parameters: &[&str]) -> Result<Vec<ModeParts>, Error> {
        self.check()?;
        let uses_time = self.uses_time();
        let mode = |mode: &ModeEquations| {
            let one = Node::Constant(Constant::from(1.0));
            let zero = |_| Some(Node::Constant(Constant::from(0.0)));
            let field = with_time(&mode.field, uses_time, Some(one));
            let guards = self.everywhere.iter().chain(&mode.guards);
            Ok(ModeParts {
                name: mode.name,
                field: field.with_states_for(parameters, zero)?,
                guards: guards
                    .map(|guard| guard.parts(uses_time, parameters))
                    .collect::<Result<_, Error>>()?,
            })
        };
        self.modes.iter().map(mode).collect()
    }

    /// Formulas of the state, from texts in the names of the equations, with the components of [`mode_parts`](Self::mode_parts).
    ///
    /// # Errors
    /// As [`mode_parts`](Self::mode_parts), and [`Error::Formula`] for a text that is no formula.
    pub fn texts_in_parts(&self, texts: &[&str], parameters: &[&str]) -> Result<Formulas, Error> {
        let formulas = Formulas::from_text(self.names.clone(), texts)?;
        let timed = with_time(&formulas, self.uses_time(), None);
        Ok(timed.with_states_for(parameters, |_| None)?)
    }
}

impl GuardEquations {
    fn parts(&self, uses_time: bool, parameters: &[&str]) -> Result<GuardParts, Error> {
        let plain = |formulas: &Formulas| {
            with_time(formulas, uses_time, None).with_states_for(parameters, |_| None)
        };
        let state = self.jump.as_ref().and_then(|jump: &Jump| jump.state.as_ref());
        let state = state.map(|state| {
            with_time(state, uses_time, Some(Node::Time))
                .with_states_for(parameters, |component| Some(Node::State(component)))
        });
        Ok(GuardParts {
            guard: self.guard,
            function: plain(&self.function)?,
            condition: self.condition.as_ref().map(plain).transpose()?,
            stops: self.jump.is_none(),
            mode: self.jump.as_ref().and_then(|jump| jump.mode),
            state: state.transpose()?,
        })
    }
}
