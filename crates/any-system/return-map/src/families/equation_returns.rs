//! Return maps of hybrid systems that are given by their equations, as families of maps.

use super::border::{BorderSite, Clearance};
use super::differences;
use super::equation_borders::Observed;
use super::family::{Image, MapFamily};
use super::formula_values::FormulaValues;
use super::return_arcs::{ReturnArcs, elapsed, itinerary, least_certain};
use crate::error::Error;
use equations::{Expression, Formulas, Jet, Names, Parameters, States};
use hybrid_system::{Along, Equations, EquationsModel, Execution, Label, Limits, Stop, Tolerances};
use nalgebra::{DMatrix, DVector};
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
    mode: Label,
    pub(super) surface: Label,
    /// The names of the coordinates, with the parameters of the equations.
    section: Names,
    /// The start from the coordinates.
    start: Option<sync::Arc<FormulaValues>>,
    /// The coordinates from the state.
    coordinates: Option<sync::Arc<FormulaValues>>,
    tolerances: Tolerances,
    limits: Limits,
    /// The last models, by the bits of the parameter.
    models: Mutex<Vec<(u64, sync::Arc<ReturnModel>)>>,
    /// The same with observers of turns, made at its first use.
    observed: OnceLock<Result<Box<Observed>, Error>>,
}

type ReturnModel = EquationsModel<DVector<f64>>;

/// A return from a point.
#[derive(Debug)]
pub(super) struct Way {
    pub(super) arcs: ReturnArcs,
    pub(super) model: sync::Arc<ReturnModel>,
    /// The time at which it begins. That of the arcs counts from there.
    begin: f64,
}

/// The number of models that are kept. A map has many images at one parameter, and a diagram computes as many columns at once as there are
/// processors.
const KEPT_MODELS: usize = 16;

/// The time at which a return begins, unless the start says another one.
const START: f64 = 0.0;

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
            models: Mutex::new(Vec::new()),
            observed: OnceLock::new(),
        }
    }

    /// The number of components of the state, without the time.
    pub(super) fn components(&self) -> usize {
        self.equations.names().states.len()
    }

    fn observed(&self) -> Result<&Observed, Error> {
        let made = self.observed.get_or_init(|| {
            Ok(Box::new(Observed::new(self, self.equations.with_turns()?, self.mode)?))
        });
        made.as_ref().map(|observed| &**observed).map_err(Error::clone)
    }

    /// The model at a value of the parameter.
    pub(super) fn model(&self, value: Option<f64>) -> Result<sync::Arc<ReturnModel>, Error> {
        let bits = value.map(f64::to_bits);
        if let Ok(models) = self.models.try_lock()
            && let Some((_, model)) = models.iter().find(|(known, _)| Some(*known) == bits)
        {
            return Ok(sync::Arc::clone(model));
        }
        let equations = match value {
            Some(value) => {
                self.equations.clone().with_parameters(&[(&self.parameter, &format!("{value:?}"))])
            }
            None => self.equations.clone(),
        };
        let model = sync::Arc::new(equations.model::<DVector<f64>>()?.tolerances(self.tolerances));
        if let (Ok(mut models), Some(bits)) = (self.models.try_lock(), bits) {
            models.truncate(KEPT_MODELS - 1);
            models.insert(0, (bits, sync::Arc::clone(&model)));
        }
        Ok(model)
    }

    /// The parameters of the equations as jets, with one of them moving.
    pub(super) fn parameters<const T: usize>(
        &self,
        moving: Jet<T>,
    ) -> impl Iterator<Item = Jet<T>> + '_ {
        let names = self.equations.names();
        names.parameters.iter().zip(&names.values).map(move |(name, value)| {
            if *name == self.parameter { moving } else { Jet::number(value.value()) }
        })
    }

    /// The state and the time at which a return starts.
    pub(super) fn start<const T: usize>(
        &self,
        coordinates: &[Jet<T>],
        parameter: Jet<T>,
    ) -> Result<(Vec<Jet<T>>, Jet<T>), Error> {
        let (expected, found) = (self.section.states.len(), coordinates.len());
        if expected != found {
            let what = "the coordinates of a section";
            return Err(hybrid_system::Error::Dimension { what, expected, found }.into());
        }
        match &self.start {
            Some(start) => {
                let begin = Jet::number(START);
                let mut state = start.values((coordinates, begin), self.parameters(parameter))?;
                let has_time = state.len() > self.equations.names().states.len();
                let time = if has_time { state.pop() } else { None };
                Ok((state, time.unwrap_or(Jet::number(START))))
            }
            None => {
                let place = |name| self.section.states.iter().position(|own| own == name);
                let names = self.equations.names().states.iter();
                let of = |name| place(name).map_or(Jet::number(0.0), |place| coordinates[place]);
                Ok((names.map(of).collect(), Jet::number(START)))
            }
        }
    }

    /// The coordinates of a state.
    fn image_of<const T: usize>(
        &self,
        (state, time): (&[Jet<T>], Jet<T>),
        parameter: Jet<T>,
    ) -> Result<Vec<Jet<T>>, Error> {
        // The time is no component of the formulas.
        let names = &self.equations.names().states;
        let state = &state[..names.len().min(state.len())];
        match &self.coordinates {
            Some(coordinates) => coordinates.values((state, time), self.parameters(parameter)),
            None => {
                let of = |name: &String| {
                    let place = names.iter().position(|own| own == name);
                    let reason = "no component of the state: give the coordinates by formulas";
                    let name = name.clone();
                    place.map(|place| state[place]).ok_or(equations::Error::Name { name, reason })
                };
                Ok(self.section.states.iter().map(of).collect::<Result<_, _>>()?)
            }
        }
    }

    /// The arcs of a return from a state.
    pub(super) fn arcs(
        &self,
        model: &ReturnModel,
        (start, time): (&[f64], f64),
    ) -> Result<ReturnArcs, Error> {
        let mut state = start.to_vec();
        let dimension = model.series(self.mode.as_str()).map_or(0, equations::Series::dimension);
        if state.len() + 1 == dimension {
            state.push(time);
        }
        let mut run = Execution::new(model, self.mode, DVector::from(state), self.limits);
        let (mut arcs, mut last) = (Vec::new(), None);
        for arc in run.by_ref() {
            let arc = arc?;
            let back = arc.event().is_some_and(|event| {
                last = Some(event.surface);
                let at_once = event.time <= event.time_rounding;
                event.surface == self.surface && !at_once && event.after.is_some()
            });
            arcs.push(arc);
            if back {
                return Ok(arcs);
            }
        }
        let stop = run.stop().unwrap_or(Stop::Failed);
        let surface = last.filter(|_| stop == Stop::Terminal).map(|surface| surface.to_string());
        let (time, events) = (run.time(), run.jump());
        Err(Error::NoReturn { stop, surface, time, events })
    }

    /// The return from a point.
    pub(super) fn way(&self, point: &[f64], parameter: f64) -> Result<Way, Error> {
        let coordinates: Vec<Jet<1>> = point.iter().map(|x| Jet([*x])).collect();
        let (start, begin) = self.start(&coordinates, Jet([parameter]))?;
        let start: Vec<f64> = start.iter().map(Jet::value).collect();
        let model = self.model(Some(parameter))?;
        let begin = begin.value();
        Ok(Way { arcs: self.arcs(&model, (&start, begin))?, model, begin })
    }

    /// The image at the end of a return.
    pub(super) fn image_after(&self, way: &Way, parameter: f64) -> Result<Image, Error> {
        let arcs = &way.arcs;
        let still = |value: f64| Jet::<1>([value]);
        let after = arcs.last().and_then(|arc| arc.event()?.after.as_ref());
        let state = after.map_or(&[][..], |(_, state)| state.as_slice());
        let state: Vec<Jet<1>> = state.iter().copied().map(still).collect();
        let at = (&state[..], still(way.begin + elapsed(arcs)));
        let image = self.image_of(at, still(parameter))?;
        let (point, certainty) = (image.iter().map(Jet::value).collect(), least_certain(arcs));
        Ok(Image { point, itinerary: itinerary(arcs), time: elapsed(arcs), certainty })
    }

    /// The image of a curve at the end of the arcs from its first point.
    fn pushed_along<const T: usize>(
        &self,
        way: &Way,
        curve: &[Jet<T>],
        parameter: Jet<T>,
    ) -> Result<Vec<Jet<T>>, Error> {
        let (mut start, begin) = self.start(curve, parameter)?;
        if way.arcs.first().is_some_and(|arc| arc.start.len() > start.len()) {
            start.push(begin);
        }
        let along = Along::curve(&start).and_parameter_curve(&self.parameter, parameter);
        let back = way.model.jet::<T>(&way.arcs, &along)?;
        // The time of the arcs is that since their start.
        let mut time = begin;
        time.0.iter_mut().zip(back.time.0).skip(1).for_each(|(own, more)| *own += more);
        time.0[0] += elapsed(&way.arcs);
        self.image_of((&back.state, time), parameter)
    }
}

impl MapFamily for EquationReturns {
    fn dimension(&self) -> usize {
        self.section.states.len()
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        self.image_after(&self.way(point, parameter)?, parameter)
    }

    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Vec<Jet<4>>, Error> {
        let point: Vec<f64> = curve.iter().map(Jet::value).collect();
        let way = self.way(&point, parameter.value())?;
        match self.pushed_along(&way, curve, parameter) {
            Err(Error::Execution(hybrid_system::Error::NoSensitivity { .. })) => {
                differences::pushed(self, curve, parameter)
            }
            found => found,
        }
    }

    /// The execution is computed once, and each derivative by a polynomial of degree one.
    fn linearized(&self, point: &[f64], parameter: f64) -> Result<(Image, DMatrix<f64>), Error> {
        let way = self.way(point, parameter)?;
        let image = self.image_after(&way, parameter)?;
        let mut slopes = DMatrix::zeros(point.len(), point.len() + 1);
        for axis in 0..=point.len() {
            let along = |(k, x): (usize, &f64)| Jet::moving(*x, f64::from(k == axis));
            let curve: Vec<Jet<2>> = point.iter().enumerate().map(along).collect();
            let moving = Jet::moving(parameter, f64::from(axis == point.len()));
            let pushed = match self.pushed_along(&way, &curve, moving) {
                Err(Error::Execution(hybrid_system::Error::NoSensitivity { .. })) => {
                    let further = |jet: &Jet<2>| Jet([jet.0[0], jet.0[1], 0.0, 0.0]);
                    let curve: Vec<Jet<4>> = curve.iter().map(further).collect();
                    let pushed = differences::pushed(self, &curve, further(&moving))?;
                    pushed.iter().map(|jet| Jet([jet.0[0], jet.0[1]])).collect()
                }
                found => found?,
            };
            for (row, jet) in pushed.iter().enumerate() {
                slopes[(row, axis)] = jet.0[1];
            }
        }
        Ok((image, slopes))
    }

    fn clearances(
        &self,
        curve: &[Jet<4>],
        parameter: Jet<4>,
    ) -> Result<Option<Vec<Clearance>>, Error> {
        Ok(Some(self.observed()?.clearances(curve, parameter)?))
    }

    fn border(
        &self,
        at: (&[f64], f64),
        pieces: (&[String], &[String]),
        place: usize,
        within: f64,
    ) -> BorderSite {
        self.border_at(at, pieces, place, within)
    }

    fn along(
        &self,
        itinerary: &[String],
        border: Option<&BorderSite>,
    ) -> Result<Box<dyn MapFamily + '_>, Error> {
        Ok(Box::new(self.passages(itinerary, border)?))
    }
}
