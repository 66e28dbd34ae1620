//! Return maps of hybrid systems that are given by their equations, as families of maps.

use super::equation_borders::Observed;
use super::formula_values::FormulaValues;
use crate::error::Error;
use equations::{Expression, Formulas, Names, Parameters, States};
use hybrid_system::{Equations, EquationsModel, Label, Limits, Tolerances};
use nalgebra::DVector;
use std::sync::{self, Mutex, OnceLock};

/// The return map of [`Equations`] to the events of a surface, as one of their parameters changes. (feature `ode` of
/// `hybrid-system`)
///
/// The coordinates of the section have names. The start of a return is given by formulas of the coordinates, one for each component of
/// the state; the image by formulas of the state after the event, one for each coordinate. An event at the start itself, after no
/// time, is no return. Each return begins at the time 0, with the same phase of a forcing, unless the start
/// says another time.
///
/// The itinerary of an image has the mode and the surface of each event on the way, those of observers too. Derivatives are exact: by
/// the Taylor series of the motion, through all events. Through a Zeno limit they are differences.
///
/// ```
/// use hybrid_system::Equations;
/// use return_map::{EquationReturns, MapFamily};
/// // A ball on the floor keeps the part r of its speed at each bounce. The coordinate is the speed after it.
/// let ball = Equations::new(&["height", "speed"], &[("r", "0.5")])
///     .mode_text("flight", &["speed", "-1"])
///     .falling_text("floor", "height")
///     .resets_text(&["0", "-r*speed"]);
/// let bounces = EquationReturns::new(&ball, "r", ("flight", "floor"), &["v"])?
///     .starting_text(&["0", "v"])?
///     .coordinates_text(&["speed"])?;
/// let image = bounces.image(&[1.0], 0.25)?;
/// assert!((image.point[0] - 0.25).abs() < 1e-15);
/// assert_eq!(image.itinerary, ["flight: floor"]);
/// # Ok::<(), return_map::Error>(())
/// ```
#[derive(Debug)]
pub struct EquationReturns {
    pub(super) equations: Equations,
    pub(super) parameter: String,
    pub(super) mode: Label,
    pub(super) surface: Label,
    /// The names of the coordinates, with the parameters of the equations.
    pub(super) section: Names,
    /// The start from the coordinates.
    pub(super) start: Option<sync::Arc<FormulaValues>>,
    /// The coordinates from the state.
    pub(super) coordinates: Option<sync::Arc<FormulaValues>>,
    pub(super) tolerances: Tolerances,
    pub(super) limits: Limits,
    /// True if neither the equations nor the coordinates use the time.
    pub(super) is_autonomous: bool,
    /// The last models, by the bits of the parameter.
    pub(super) models: Mutex<Vec<(u64, sync::Arc<ReturnModel>)>>,
    /// The same with observers of turns, made at its first use.
    pub(super) observed: OnceLock<Result<Box<Observed>, Error>>,
}

pub(super) type ReturnModel = EquationsModel<DVector<f64>>;

/// The longest return of a map that states no limits: a thousand time units and ten thousand events.
const LONGEST: (f64, usize) = (1e3, 10_000);

impl EquationReturns {
    /// The returns from a section to the next event of a surface: the executions start in `mode`. `coordinates` are the names of the
    /// section's coordinates. By default the start has the components of these names, and the others are zero; the image has the
    /// components of these names after the event.
    ///
    /// # Errors
    /// Those of the equations, and of names that are no parameter, mode or surface of them.
    pub fn new(
        equations: &Equations,
        parameter: &str,
        (mode, surface): (&str, &str),
        coordinates: &[&str],
    ) -> Result<EquationReturns, Error> {
        equations.check()?;
        let names = equations.names();
        let unknown = |name: &str, reason: &'static str| {
            Error::from(equations::Error::Name { name: name.to_owned(), reason })
        };
        if !names.parameters.iter().any(|known| known == parameter) {
            return Err(unknown(parameter, "no parameter of these equations"));
        }
        let section = Names {
            states: coordinates.iter().map(|name| (*name).to_owned()).collect(),
            ..names.clone()
        };
        let returns = EquationReturns {
            equations: equations.clone(),
            parameter: parameter.to_owned(),
            mode: Label::new(mode)?,
            surface: Label::new(surface)?,
            section,
            start: None,
            coordinates: None,
            tolerances: Tolerances::both(1e-13),
            limits: Limits::new(LONGEST.0, LONGEST.1),
            is_autonomous: equations.is_autonomous(),
            models: Mutex::new(Vec::new()),
            observed: OnceLock::new(),
        };
        // A mode that is not there is an error of its executions.
        let model = returns.model(None)?;
        if model.series(mode).is_none() {
            return Err(unknown(mode, "no mode of these equations"));
        }
        Ok(returns)
    }

    /// The start of a return by formulas of the coordinates, one for each component of the state. A further one is the time at which the
    /// return begins, else 0: for a section on which the phase of a forcing is a coordinate.
    ///
    /// # Errors
    /// Those of the formulas.
    pub fn starting_text(self, state: &[&str]) -> Result<Self, Error> {
        let formulas = Formulas::from_text(self.section.clone(), state)?;
        self.starting_by(&formulas)
    }

    /// The same, by a closure of the time, which is 0 here, the coordinates and the parameters. It is called once, with symbols.
    ///
    /// # Errors
    /// Those of the formulas.
    pub fn starting(
        self,
        state: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> Vec<Expression<'g>>,
    ) -> Result<Self, Error> {
        let formulas = Formulas::of_vector(self.section.clone(), state)?;
        self.starting_by(&formulas)
    }

    fn starting_by(mut self, formulas: &Formulas) -> Result<Self, Error> {
        let needed = self.equations.names().states.len();
        let count = (needed, needed + 1);
        self.start =
            Some(sync::Arc::new(FormulaValues::new(formulas, "formulas of the start", count)?));
        self.observed = OnceLock::new();
        Ok(self)
    }

    /// The coordinates by formulas of the state after the event, and of its time t since the start.
    ///
    /// # Errors
    /// Those of the formulas.
    pub fn coordinates_text(self, coordinates: &[&str]) -> Result<Self, Error> {
        let formulas = Formulas::from_text(self.equations.names().clone(), coordinates)?;
        self.coordinates_by(&formulas)
    }

    /// The same, by a closure of the time, the state and the parameters. It is called once, with symbols.
    ///
    /// # Errors
    /// Those of the formulas.
    pub fn coordinates(
        self,
        coordinates: impl for<'g> Fn(
            Expression<'g>,
            &States<'g>,
            &Parameters<'g>,
        ) -> Vec<Expression<'g>>,
    ) -> Result<Self, Error> {
        let formulas = Formulas::of_vector(self.equations.names().clone(), coordinates)?;
        self.coordinates_by(&formulas)
    }

    fn coordinates_by(mut self, formulas: &Formulas) -> Result<Self, Error> {
        let needed = self.section.states.len();
        let count = (needed, needed);
        let coordinates = FormulaValues::new(formulas, "formulas of the coordinates", count)?;
        self.coordinates = Some(sync::Arc::new(coordinates));
        self.is_autonomous &= !formulas.uses_time();
        self.observed = OnceLock::new();
        Ok(self)
    }

    /// The same, with these tolerances of the motion. Default: 1e-13.
    #[must_use]
    pub fn tolerances(mut self, tolerances: Tolerances) -> Self {
        self.tolerances = tolerances;
        self.models = Mutex::new(Vec::new());
        self.observed = OnceLock::new();
        self
    }

    /// The same, with these limits on one return. Default: a thousand time units and ten thousand events.
    #[must_use]
    pub fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self.observed = OnceLock::new();
        self
    }

    /// The same returns of other equations with the same names, from another mode.
    pub(super) fn with_equations(&self, equations: Equations, mode: Label) -> EquationReturns {
        EquationReturns {
            equations,
            parameter: self.parameter.clone(),
            mode,
            surface: self.surface,
            section: self.section.clone(),
            start: self.start.clone(),
            coordinates: self.coordinates.clone(),
            tolerances: self.tolerances,
            limits: self.limits,
            is_autonomous: self.is_autonomous,
            models: Mutex::new(Vec::new()),
            observed: OnceLock::new(),
        }
    }

    /// The number of components of the state, without the time.
    pub(super) fn components(&self) -> usize {
        self.equations.names().states.len()
    }

    pub(super) fn observed(&self) -> Result<&Observed, Error> {
        let made = self.observed.get_or_init(|| {
            Ok(Box::new(Observed::new(self, self.equations.with_turns()?, self.mode)?))
        });
        made.as_ref().map(|observed| &**observed).map_err(Error::clone)
    }
}
