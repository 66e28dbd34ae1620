//! Maps that are enclosed with their derivatives: return maps of systems, and maps that are formulas.

use crate::certificate::Record;
use crate::event::{ProvedEvent, carried};
use crate::matrix::{Matrix, exact, sums};
use crate::run::{Limits, ValidatedRun};
use crate::set::{AffineSet, Chain};
use crate::start::{Chart, check_box};
use crate::system::{ValidatedSystem, without_time};
use crate::undecided::{Error, Reason};
use equations::Formulas;
use hybrid_system::Label;
use interval_arithmetic::Enclosure;
use nalgebra::DMatrix;
use serde_json::{Value, json};
use std::fmt;
use std::ops::ControlFlow;

/// A differentiable map of some variables, which may depend on parameters that are intervals.
pub trait EnclosedMap {
    /// The number of variables.
    fn dimension(&self) -> usize;

    /// The images of all points of a set: of the variables, and then of the parameters; with derivatives if they are wanted.
    ///
    /// # Errors
    /// [`Error::Undecided`] where nothing is proved. [`Reason::Stopped`] says that an event that ends the execution comes first, for all
    /// points.
    fn carry(&self, start: StartSet) -> Result<Carried, Error>;

    /// What a certificate says of the map, if one can: the system, if it has one, and the map.
    #[doc(hidden)]
    fn as_json(&self) -> Option<(Option<Value>, Value)> {
        None
    }

    /// The steps of points whose execution ends, of a map that is recorded.
    #[doc(hidden)]
    fn end_of(&self, _start: StartSet) -> Result<Option<Record>, Error> {
        Ok(None)
    }

    /// The images of all points of a box, with derivatives.
    ///
    /// # Errors
    /// As [`carry`](Self::carry).
    fn image(&self, domain: &[Enclosure]) -> Result<MapImage, Error> {
        let carried = self.carry(StartSet::of_box(domain))?;
        let derivatives = carried.chain.map(|chain| chain.matrix());
        Ok(MapImage {
            values: carried.set.hull()[..self.dimension()].to_vec(),
            derivatives: derivatives.unwrap_or_else(|| {
                Matrix::from_fn(self.dimension(), domain.len(), |_, _| Enclosure::WHOLE)
            }),
            events: carried.events,
        })
    }
}

/// Where a map begins: a set of its variables and parameters, and the derivatives that are wanted.
#[derive(Debug, Clone)]
pub struct StartSet {
    pub(crate) set: AffineSet,
    pub(crate) chain: Option<Chain>,
}

impl StartSet {
    /// A box, with derivatives with respect to its variables.
    pub fn of_box(domain: &[Enclosure]) -> StartSet {
        let set = AffineSet::of_box(domain);
        StartSet { set, chain: Some(Chain::identity(domain.len())) }
    }

    /// The points c + A u for all u of a box, with derivatives with respect to u.
    pub fn of_parallelepiped(
        centre: &[f64],
        directions: &DMatrix<f64>,
        u: &[Enclosure],
    ) -> StartSet {
        let directions = Matrix::of_numbers(directions);
        let set = AffineSet::of_box(u);
        // The set has its centre in the middle of the box, not at u = 0.
        let at_centre = sums(&exact(centre), &directions.apply(&set.centre_box()));
        let set = set.image(&at_centre, &directions, None);
        StartSet { set, chain: Some(Chain::identity(u.len()).then(&directions)) }
    }

    /// A set, with derivatives with respect to its points.
    pub fn of_set(set: &AffineSet) -> StartSet {
        StartSet { set: set.clone(), chain: Some(Chain::identity(set.centre().len())) }
    }

    /// The same without derivatives, in less time.
    #[must_use]
    pub fn without_derivatives(mut self) -> Self {
        self.chain = None;
        self
    }
}

/// Where a map leads.
#[derive(Debug, Clone)]
pub struct Carried {
    /// The images.
    pub set: AffineSet,
    /// The events until the images, one after the other.
    pub events: Vec<ProvedEvent>,
    /// The derivatives, if they are wanted.
    pub(crate) chain: Option<Chain>,
    /// The steps, of a map that is recorded.
    pub(crate) record: Option<Record>,
}

/// The images of a box under a map.
#[derive(Debug, Clone)]
pub struct MapImage {
    /// A box that holds them.
    pub values: Vec<Enclosure>,
    /// The derivatives at all points of the box, with respect to variables and parameters.
    pub derivatives: Matrix,
    /// The events until the images, one after the other.
    pub events: Vec<ProvedEvent>,
}

/// The map from a chart to the states after the event number `count` of a surface, of which formulas are read.
#[derive(Clone)]
pub struct SectionMap<'s> {
    system: &'s ValidatedSystem,
    chart: Chart,
    surface: Label,
    count: usize,
    read: (Formulas, Formulas),
    limits: Limits,
    stop: Option<&'s (dyn Fn() -> bool + Sync)>,
    is_recorded: bool,
}

impl fmt::Debug for SectionMap<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let read = self.read.0.texts();
        write!(formatter, "SectionMap({} times {}, {})", self.count, self.surface, read.join(", "))
    }
}

impl<'s> SectionMap<'s> {
    /// The map. `read` has a text for each variable of the map, a formula of the state after the event: what of it is compared with the
    /// variables. A chart may have more variables: these are parameters.
    ///
    /// The return map of a circle that turns, on the half line x = 0, v > 0:
    ///
    /// ```
    /// use hybrid_system::Equations;
    /// use validated_dynamics::{EnclosedMap, Enclosure, SectionMap, ValidatedSystem};
    /// let oscillator = Equations::new(&["x", "v"], &[("damping", "0.1")])
    ///     .mode_text("flow", &["v", "-x - damping*v"])
    ///     .rising_text("section", "x");
    /// let system = ValidatedSystem::new(&oscillator)?;
    /// let chart = system.chart("flow", &["v"], &["0", "v"])?;
    /// let map = SectionMap::new(&system, chart, "section", 1, &["v"])?;
    /// let image = map.image(&[Enclosure::between(0.9, 1.1)?])?;
    /// // A turn takes 2π/ω with ω² = 1 − 0.05², and the speed falls by exp(−0.05 · 2π/ω).
    /// assert!((image.values[0].middle() - 0.7301).abs() < 1e-4);
    /// # Ok::<(), validated_dynamics::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Argument`] for a surface that no mode has and for a count of 0; [`Error::Formula`] for texts that are refused.
    pub fn new(
        system: &'s ValidatedSystem,
        chart: Chart,
        surface: &str,
        count: usize,
        read: &[&str],
    ) -> Result<SectionMap<'s>, Error> {
        if count == 0 {
            return Error::argument(
                "count",
                "0, but the map leads to the first event or a later one",
            );
        }
        let variables = chart.states.names().states.len();
        if read.is_empty() || read.len() > variables {
            let given = read.len();
            return Error::argument(
                "read",
                format!("{given} texts for {variables} variables of the chart"),
            );
        }
        let given = read.len();
        let read = system.formulas(read)?;
        if read.count() != given {
            return Error::argument("read", "a definition among the formulas: write it out");
        }
        let read = (read.clone(), read.jacobian()?);
        let (surface, limits) = (system.surface(surface)?, Limits::default());
        Ok(SectionMap {
            system,
            chart,
            surface,
            count,
            read,
            limits,
            stop: None,
            is_recorded: false,
        })
    }

    /// The same map within other limits of its runs.
    #[must_use]
    pub fn within(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// The same map, which is [`Reason::Interrupted`] at the next step after `stop` is true.
    #[must_use]
    pub fn stopped_by(mut self, stop: &'s (dyn Fn() -> bool + Sync)) -> Self {
        self.stop = Some(stop);
        self
    }

    /// The same map, whose statements can be written into a [`Certificate`](crate::Certificate): with wider sets, in more time.
    #[must_use]
    pub fn recorded(mut self) -> Self {
        self.is_recorded = true;
        self
    }

    /// A run from the states of the chart.
    ///
    /// # Errors
    /// As [`ValidatedSystem::start_on`].
    pub fn run(&self, domain: &[Enclosure]) -> Result<ValidatedRun<'s>, Error> {
        Ok(self.system.start_on(&self.chart, domain)?.within(self.limits))
    }
}

impl EnclosedMap for SectionMap<'_> {
    fn dimension(&self) -> usize {
        self.read.0.count()
    }

    fn carry(&self, start: StartSet) -> Result<Carried, Error> {
        let mut run = self.run_of(start)?;
        let mut events = Vec::new();
        let mut left = self.count;
        loop {
            let event = self.next_event(&mut run)?;
            left -= usize::from(event.surface == self.surface);
            let (set, chain) = (event.set.clone(), event.chain.clone());
            events.push(event);
            if left > 0 {
                continue;
            }
            return match carried(&set, chain, (&self.read.0, &self.read.1)) {
                Ok((mut set, chain)) => {
                    let mut record = run.into_record();
                    if let Some(record) = &mut record {
                        set = record.read(&set);
                    }
                    Ok(Carried { set, events, chain, record })
                }
                Err(error) => run.undecided(Reason::Domain(error)),
            };
        }
    }

    fn as_json(&self) -> Option<(Option<Value>, Value)> {
        let chart = &self.chart;
        let map = json!({
            "kind": "map",
            "mode": self.system.modes[chart.mode].name.as_str(),
            "variables": chart.states.names().states,
            "states": chart.states.texts(),
            "surface": self.surface.as_str(),
            "count": self.count,
            "read": self.read.0.texts(),
        });
        Some((Some(self.system.as_json()), map))
    }

    fn end_of(&self, start: StartSet) -> Result<Option<Record>, Error> {
        let mut run = self.run_of(start)?;
        while self.next_event(&mut run)?.next.is_some() {}
        Ok(run.into_record())
    }
}

impl<'s> SectionMap<'s> {
    /// The run from a set, which is written down if the map is recorded.
    fn run_of(&self, mut start: StartSet) -> Result<ValidatedRun<'s>, Error> {
        let record;
        (record, start.set) = written(self.is_recorded, start.set);
        let run = self.system.start_set(&self.chart, start)?.within(self.limits);
        Ok(match record {
            Some(record) => run.recorded(record),
            None => run,
        })
    }

    fn next_event(&self, run: &mut ValidatedRun<'s>) -> Result<ProvedEvent, Error> {
        run.next_event_watched(&mut |_| match self.stop.is_some_and(|stop| stop()) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        })
    }
}

/// A map that is formulas, applied some times. Variables behind the first ones, of which there are as many as formulas, are parameters.
#[derive(Debug, Clone)]
pub struct FormulaMap {
    formulas: Formulas,
    slopes: Formulas,
    times: usize,
    count: usize,
    is_recorded: bool,
}

impl FormulaMap {
    /// The map, applied `times` times.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// use validated_dynamics::{EnclosedMap, Enclosure, FormulaMap};
    /// let names = Names::new(&["x"], &[("a", "3.9")])?;
    /// let logistic = FormulaMap::new(Formulas::from_text(names, &["a*x*(1 - x)"])?, 2)?;
    /// let image = logistic.image(&[Enclosure::from(0.5)])?;
    /// assert!(image.values[0].contains(3.9 * 0.975 * 0.025) && image.values[0].width() < 1e-14);
    /// # Ok::<(), validated_dynamics::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Argument`] for fewer variables than formulas, and for 0 times; [`Error::Formula`] for a function with a kink or a jump.
    pub fn new(formulas: Formulas, times: usize) -> Result<FormulaMap, Error> {
        let (variables, count) = (formulas.names().states.len(), formulas.count());
        if count == 0 || count > variables {
            return Error::argument(
                "formulas",
                format!("{count} of them for {variables} variables"),
            );
        }
        if times == 0 {
            return Error::argument("times", "0, but the map is applied at least once");
        }
        let formulas = without_time(formulas, "a map has no time: give it a variable")?;
        // The parameters stay.
        let formulas = formulas.with_last_states(variables - count);
        Ok(FormulaMap { slopes: formulas.jacobian()?, formulas, times, count, is_recorded: false })
    }

    /// The same map, whose statements can be written into a [`Certificate`](crate::Certificate).
    #[must_use]
    pub fn recorded(mut self) -> Self {
        self.is_recorded = true;
        self
    }
}

impl EnclosedMap for FormulaMap {
    fn dimension(&self) -> usize {
        self.count
    }

    fn carry(&self, start: StartSet) -> Result<Carried, Error> {
        let StartSet { mut set, mut chain } = start;
        check_box(&self.formulas.names().states, set.hull())?;
        let mut record;
        (record, set) = written(self.is_recorded, set);
        for _ in 0..self.times {
            let next = carried(&set, chain, (&self.formulas, &self.slopes));
            (set, chain) = next.map_err(|error| {
                let names = &self.formulas.names().states;
                Error::not_proved(Reason::Domain(error), None, Enclosure::ZERO, (names, set.hull()))
            })?;
            if let Some(record) = &mut record {
                set = record.applied(&set);
            }
        }
        let (mut set, chain) = self.variables_of(&set, chain);
        if let Some(record) = &mut record {
            set = record.read(&set);
        }
        Ok(Carried { set, events: Vec::new(), chain, record })
    }

    fn as_json(&self) -> Option<(Option<Value>, Value)> {
        let names = self.formulas.names();
        let values = names.parameters.iter().zip(names.values.iter().map(ToString::to_string));
        let map = json!({
            "kind": "map",
            "variables": names.states,
            "parameters": values.collect::<Vec<_>>(),
            "formulas": self.formulas.texts(),
            "dimension": self.count,
            "times": self.times,
        });
        Some((None, map))
    }
}

/// The record of a map that is recorded, and the set at its start: the written one then.
fn written(is_recorded: bool, set: AffineSet) -> (Option<Record>, AffineSet) {
    match is_recorded {
        true => {
            let (record, set) = Record::from(&set);
            (Some(record), set)
        }
        false => (None, set),
    }
}

impl FormulaMap {
    /// The variables alone, without the parameters.
    fn variables_of(&self, set: &AffineSet, chain: Option<Chain>) -> (AffineSet, Option<Chain>) {
        let all = set.hull().len();
        if all == self.count {
            return (set.clone(), chain);
        }
        let first = Matrix::from_fn(self.count, all, |row, column| {
            Enclosure::from(f64::from(row == column))
        });
        let centre = first.apply(&set.centre_box());
        let hull = &set.hull()[..self.count];
        (set.image(&centre, &first, Some(hull)), chain.map(|chain| chain.then(&first)))
    }
}
