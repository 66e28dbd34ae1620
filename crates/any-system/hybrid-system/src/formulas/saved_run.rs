//! An execution of equations as data: the equations, the tolerances and where it is (features `ode` and `serde`).
//!
//! ```text
//! {"format": "hybrid run", "version": 1, "equations": {…}, "tolerances": {"relative": 1e-12, …}, "checkpoint": {…}}
//! ```

use super::equations::{Equations, EquationsModel};
use super::label::Label;
use crate::checkpoint::Checkpoint;
use crate::error::Error;
use crate::execution::Execution;
use crate::limits::Limits;
use crate::ode::Tolerances;
use crate::state::StateVector;
use equations::Function;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

const FORMAT: &str = "hybrid run";

/// The version of the format. A reader refuses others.
const VERSION: u64 = 1;

/// The names of the tolerances in files.
const TOLERANCES: [&str; 5] = ["relative", "absolute", "longest_step", "check_interval", "steps"];

/// A model of equations and a place in one of its executions, which another program can read and go on with. It has the
/// bits of the execution without a stop.
///
/// ```
/// use hybrid_system::{Equations, Limits, SavedRun, State};
/// let ball = Equations::new(&["height", "speed"], &[])
///     .mode_text("flight", &["speed", "-9.81"])
///     .falling_text("floor", "height")
///     .resets_text(&["height", "-0.8*speed"])
///     .model::<State<2>>()?;
/// let mut run = ball.start("flight", [1.0, 0.0], 3.0)?;
/// run.next();
/// let text = run.saved().to_json()?;
/// let rest: Vec<_> = run.collect::<Result<_, _>>()?;
/// let saved = SavedRun::<State<2>>::from_json(&text)?;
/// let again = saved.go_on(Limits::new(3.0, 1_000_000));
/// assert_eq!(again.collect::<Result<Vec<_>, _>>()?, rest);
/// # Ok::<(), hybrid_system::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct SavedRun<X> {
    /// The model.
    pub model: EquationsModel<X>,
    /// Where its execution is.
    pub checkpoint: Checkpoint<Label, Label, X>,
}

impl<X: StateVector> Execution<'_, EquationsModel<X>> {
    /// The execution as data, between two arcs.
    pub fn saved(&self) -> SavedRun<X> {
        SavedRun { model: self.system.clone(), checkpoint: self.checkpoint() }
    }
}

impl<X: StateVector> SavedRun<X> {
    /// The execution from here on, up to these limits. It has no further arcs if it had ended for another reason than a
    /// limit: [`Execution::stop`] tells which.
    pub fn go_on(&self, limits: Limits) -> Execution<'_, EquationsModel<X>> {
        let mut execution = Execution::restore(&self.model, self.checkpoint.clone(), limits);
        let _ = execution.go_on(limits);
        execution
    }
}

impl<X: StateVector + Serialize + DeserializeOwned> SavedRun<X> {
    /// The run as JSON.
    ///
    /// # Errors
    /// [`Error::BadEquations`] for a state that is not finite, and for what a program sets beside the equations:
    /// tolerances of single components, and roles and samples of the model.
    pub fn to_json(&self) -> Result<String, Error> {
        let tolerances = &self.model.motion.tolerances;
        if tolerances.absolute_each.is_some() || tolerances.relative_each.is_some() {
            return bad("tolerances", "those of single components are not written: set them again");
        }
        if !self.model.has_declarations_of(&self.model.equations().model()?) {
            let reason = "what is set on the model is not written: set it in the equations";
            return bad("roles and samples", reason);
        }
        let equations = self.model.equations().to_value()?;
        let checkpoint = serde_json::to_value(&self.checkpoint);
        let checkpoint =
            checkpoint.or_else(|error| bad(&error.to_string(), "it is not written"))?;
        // JSON has no infinity: a length without a limit is null.
        let numbers = [
            json!(tolerances.relative),
            json!(tolerances.absolute),
            json!(tolerances.longest_step),
            json!(tolerances.check_interval),
            json!(tolerances.steps),
        ];
        let tolerances = TOLERANCES.map(str::to_owned).into_iter().zip(numbers);
        let file = json!({
            "format": FORMAT,
            "version": VERSION,
            "equations": equations,
            "tolerances": tolerances.collect::<serde_json::Map<_, _>>(),
            "checkpoint": checkpoint,
        });
        Ok(file.to_string())
    }

    /// The run of a file. Any bytes are safe: what is no such file is an error.
    ///
    /// # Errors
    /// As [`Equations::from_json`] and [`Equations::model`]; [`Error::BadEquations`] for what is no place in an execution
    /// of the model.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Self::from_json_with(text, &[])
    }

    /// The same of a file whose equations call these functions, which it has by their names alone.
    ///
    /// # Errors
    /// As [`from_json`](Self::from_json), and for a function that is not given.
    pub fn from_json_with(text: &str, functions: &[Function]) -> Result<Self, Error> {
        let mut file = equations::bounded_value(text)?;
        if file["format"] != FORMAT || file["version"] != VERSION {
            return bad("format", "it is no file of a hybrid run, or one of another version");
        }
        let equations = Equations::from_value(&file["equations"], functions)?;
        let tolerances = &file["tolerances"];
        let number = |at: usize| match tolerances[TOLERANCES[at]] {
            Value::Null if at > 1 => Ok(f64::INFINITY),
            ref value => {
                value.as_f64().map_or_else(|| bad(TOLERANCES[at], "a number is expected"), Ok)
            }
        };
        let steps = tolerances["steps"].as_u64().and_then(|steps| steps.try_into().ok());
        let tolerances = Tolerances {
            absolute: number(1)?,
            longest_step: number(2)?,
            check_interval: number(3)?,
            steps: steps.map_or_else(|| bad("steps", "a whole number is expected"), Ok)?,
            ..Tolerances::both(number(0)?)
        };
        let checkpoint: Checkpoint<Label, Label, X> =
            serde_json::from_value(file["checkpoint"].take())
                .or_else(|error| bad(&error.to_string(), "it is no checkpoint"))?;
        let model = equations.model::<X>()?.tolerances(tolerances);
        tolerances.check(checkpoint.state().dimension())?;
        crate::HybridSystem::validate(&model, checkpoint.mode(), checkpoint.state())?;
        Ok(SavedRun { model, checkpoint })
    }
}

fn bad<T>(what: &str, reason: &'static str) -> Result<T, Error> {
    // A value of a file may be long.
    Err(Error::BadEquations { what: what.chars().take(120).collect(), reason })
}
