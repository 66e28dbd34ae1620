//! Maps that are enclosed with their derivatives: return maps of systems, and maps that are formulas.

use crate::matrix::Matrix;
use crate::run::{Limits, ProvedEvent, ValidatedRun, carried};
use crate::set::{AffineSet, Chain};
use crate::start::{Chart, check_box};
use crate::system::ValidatedSystem;
use crate::undecided::{Error, Reason};
use equations::Formulas;
use hybrid_system::Label;
use interval_arithmetic::Enclosure;

/// A differentiable map of some variables, which may depend on parameters that are intervals.
pub trait EnclosedMap {
    /// The number of variables.
    fn dimension(&self) -> usize;

    /// The images of all points of a box: of the variables, and then of the parameters.
    ///
    /// # Errors
    /// [`Error::Undecided`] where nothing is proved.
    fn image(&self, domain: &[Enclosure]) -> Result<MapImage, Error>;

    /// A set that holds the images of all points of a box, without derivatives, in less time.
    ///
    /// # Errors
    /// As [`image`](Self::image).
    fn set_image(&self, domain: &[Enclosure]) -> Result<AffineSet, Error>;
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
#[derive(Debug, Clone)]
pub struct SectionMap<'s> {
    system: &'s ValidatedSystem,
    chart: Chart,
    surface: Label,
    count: usize,
    read: (Formulas, Formulas),
    limits: Limits,
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
            return Error::argument("count", "0, but the map leads to the first event or a later one");
        }
        let variables = chart.states.names().states.len();
        if read.is_empty() || read.len() > variables {
            let given = read.len();
            return Error::argument("read", format!("{given} texts for {variables} variables of the chart"));
        }
        let read = system.formulas(read)?;
        let read = (read.clone(), read.jacobian()?);
        let (surface, limits) = (system.surface(surface)?, Limits::default());
        Ok(SectionMap { system, chart, surface, count, read, limits })
    }

    /// The same map within other limits of its runs.
    #[must_use]
    pub fn within(mut self, limits: Limits) -> Self {
        self.limits = limits;
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

    fn image(&self, domain: &[Enclosure]) -> Result<MapImage, Error> {
        let mut run = self.run(domain)?;
        let (events, set, chain) = self.followed(&mut run)?;
        match chain {
            Some(chain) => {
                let (values, derivatives) = (set.hull().to_vec(), chain.matrix());
                Ok(MapImage { values, derivatives, events })
            }
            // The run has derivatives.
            None => run.undecided(Reason::Singular),
        }
    }

    fn set_image(&self, domain: &[Enclosure]) -> Result<AffineSet, Error> {
        let mut run = self.run(domain)?.without_derivatives();
        Ok(self.followed(&mut run)?.1)
    }
}

/// The events of a run, and the set and the derivatives that are read after the last one.
type Followed = (Vec<ProvedEvent>, AffineSet, Option<Chain>);

impl SectionMap<'_> {
    fn followed(&self, run: &mut ValidatedRun<'_>) -> Result<Followed, Error> {
        let mut events = Vec::new();
        let mut left = self.count;
        loop {
            let event = run.next_event()?;
            left -= usize::from(event.surface == self.surface);
            let (set, chain) = (event.set.clone(), event.chain.clone());
            events.push(event);
            if left > 0 {
                continue;
            }
            return match carried(&set, chain, (&self.read.0, &self.read.1)) {
                Ok((set, chain)) => Ok((events, set, chain)),
                Err(error) => run.undecided(Reason::Domain(error)),
            };
        }
    }
}

/// A map that is formulas, applied some times. Variables behind the first ones, of which there are as many as formulas, are parameters.
#[derive(Debug, Clone)]
pub struct FormulaMap {
    formulas: Formulas,
    slopes: Formulas,
    times: usize,
    count: usize,
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
            return Error::argument("formulas", format!("{count} of them for {variables} variables"));
        }
        if times == 0 {
            return Error::argument("times", "0, but the map is applied at least once");
        }
        // The parameters stay.
        let formulas = formulas.with_last_states(variables - count);
        Ok(FormulaMap { slopes: formulas.jacobian()?, formulas, times, count })
    }
}

impl EnclosedMap for FormulaMap {
    fn dimension(&self) -> usize {
        self.count
    }

    fn image(&self, domain: &[Enclosure]) -> Result<MapImage, Error> {
        let (set, chain) = self.applied(domain, Some(Chain::identity(domain.len())))?;
        let own = chain.map(|chain| chain.matrix());
        let derivatives = Matrix::from_fn(self.count, domain.len(), |row, column| {
            own.as_ref().map_or(Enclosure::WHOLE, |own| own.at(row, column))
        });
        Ok(MapImage { values: set.hull()[..self.count].to_vec(), derivatives, events: Vec::new() })
    }

    fn set_image(&self, domain: &[Enclosure]) -> Result<AffineSet, Error> {
        Ok(self.applied(domain, None)?.0)
    }
}

impl FormulaMap {
    fn applied(
        &self,
        domain: &[Enclosure],
        mut chain: Option<Chain>,
    ) -> Result<(AffineSet, Option<Chain>), Error> {
        check_box(&self.formulas.names().states, domain)?;
        let mut set = AffineSet::of_box(domain);
        for _ in 0..self.times {
            (set, chain) = carried(&set, chain, (&self.formulas, &self.slopes))?;
        }
        Ok((set, chain))
    }
}
