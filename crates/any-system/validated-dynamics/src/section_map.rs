//! Return maps of systems: from a chart to the states after an event.

use crate::certificate::Record;
use crate::enclosed_map::{Carried, EnclosedMap, StartSet, written};
use crate::event::{ProvedEvent, carried};
use crate::limits::Limits;
use crate::run::ValidatedRun;
use crate::start::Chart;
use crate::system::ValidatedSystem;
use crate::undecided::{Error, Reason};
use equations::Formulas;
use hybrid_system::Label;
use interval_arithmetic::Enclosure;
use serde_json::{Value, json};
use std::fmt;
use std::ops::ControlFlow;

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

    fn leads_into(&self, carried: &Carried, next: &Self) -> Result<(), Error> {
        let ended = carried.events.last().and_then(|event| event.next);
        let wanted = next.system.modes[next.chart.mode].name;
        match ended == Some(wanted) {
            true => Ok(()),
            false => Err(Error::of_variables(
                Reason::OtherMode { ended, wanted },
                &carried.set.hull()[..self.dimension()],
            )),
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
