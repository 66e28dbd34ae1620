//! What runs the equations of a model: series, guards and jumps of each mode.

use super::closed_form::{ClosedForm, is_sharp};
use super::equations::{Equations, GuardEquations, Jump, ModeEquations};
use super::label::Label;
use super::quasi_values::quasi_value;
use crate::clock::ClockTimes;
use crate::crossing::QuasiPolynomial;
use crate::error::Error;
use crate::guard::Role;
use crate::ode::Tolerances;
use equations::{Binary, Constant, Formulas, JetSeries, Node, Series};
use std::cell::RefCell;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

/// All that is evaluated of some equations.
#[derive(Debug)]
pub(super) struct Programs {
    pub(super) equations: Equations,
    /// The number of components of the state, with the time if it is one.
    pub(super) dimension: usize,
    pub(super) modes: Vec<ModeProgram>,
}

/// What is evaluated in one mode.
#[derive(Debug)]
pub(super) struct ModeProgram {
    pub(super) name: Label,
    pub(super) field: Formulas,
    /// The field with the guards as watched formulas, in their order.
    pub(super) series: Series,
    pub(super) guards: Vec<GuardProgram>,
    /// The clocks: the formulas of their times, and the times these are.
    pub(super) clocks: Vec<(GuardProgram, ClockTimes)>,
    pub(super) after_limit: Option<Jump>,
    /// The closed form of the motion, if it has one.
    closed_form: Option<ClosedForm>,
    /// No other program of this process has this number.
    number: u64,
    /// The guards as watched formulas.
    watched: Option<Formulas>,
    /// The same series with derivatives, made at its first use.
    jets: Jets,
}

/// The number of the next program.
static NEXT: AtomicU64 = AtomicU64::new(0);

/// The number of a program, a start, and the motion from there.
type KnownMotion = (u64, Vec<f64>, Option<Arc<ClosedMotion>>);

thread_local! {
    /// The last two motions in closed form on this thread, the last one first. The rules at the start of an arc ask for that of the
    /// arc before, too. Of threads that shared them, each would find those of the other.
    static LAST_MOTIONS: RefCell<[KnownMotion; 2]> =
        const { RefCell::new([(u64::MAX, Vec::new(), None), (u64::MAX, Vec::new(), None)]) };
}

/// A motion from a start, in closed form.
#[derive(Debug)]
pub(super) struct ClosedMotion {
    pub(super) components: Vec<QuasiPolynomial>,
    pub(super) guards: Vec<QuasiPolynomial>,
}

/// Formulas with derivatives, made at their first use: many models need none.
type Jets = OnceLock<Result<JetSeries, equations::Error>>;

fn made(
    jets: &Jets,
    make: impl FnOnce() -> Result<JetSeries, equations::Error>,
) -> Result<&JetSeries, Error> {
    jets.get_or_init(make).as_ref().map_err(|error| error.clone().into())
}

impl ClosedMotion {
    /// True if the closed form has the digits of an integration up to a time: see [`is_sharp`].
    pub(super) fn is_sharp_until(&self, time: f64, tolerances: &Tolerances) -> bool {
        let components = self.components.iter().enumerate();
        let mut components = components.map(|(axis, own)| (own, tolerances.of(axis, 0.0)));
        let mut guards = self.guards.iter().map(|own| (own, tolerances.absolute));
        components.all(|(own, absolute)| is_sharp(own, time, absolute))
            && guards.all(|(own, absolute)| is_sharp(own, time, absolute))
    }
}

impl ModeProgram {
    /// The components along the motion from a start, and the guards along them, if all of them have a closed form.
    pub(super) fn closed_form(&self, start: &[f64]) -> Option<Arc<ClosedMotion>> {
        let form = self.closed_form.as_ref()?;
        let bits = |x: &f64| x.to_bits();
        LAST_MOTIONS.with_borrow_mut(|last| {
            let is_known = |(number, known, _): &KnownMotion| {
                *number == self.number && known.iter().map(bits).eq(start.iter().map(bits))
            };
            if !is_known(&last[0]) {
                last.swap(0, 1);
            }
            if !is_known(&last[0]) {
                last[0] = (self.number, start.to_vec(), self.new_closed(form, start));
            }
            last[0].2.clone()
        })
    }

    fn new_closed(&self, form: &ClosedForm, start: &[f64]) -> Option<Arc<ClosedMotion>> {
        let components = form.motion(start)?;
        let known: Vec<_> = components.iter().cloned().map(Some).collect();
        let guards = self.guards.iter().map(|guard| quasi_value(&guard.function, 0, &known));
        Some(Arc::new(ClosedMotion { guards: guards.collect::<Option<_>>()?, components }))
    }

    /// The guard or the clock of a surface.
    pub(super) fn of_surface(&self, surface: Label) -> Option<&GuardProgram> {
        let clocks = self.clocks.iter().map(|(clock, _)| clock);
        self.guards.iter().chain(clocks).find(|guard| guard.surface == surface)
    }

    /// The series with derivatives.
    pub(super) fn jets(&self) -> Result<&JetSeries, Error> {
        made(&self.jets, || JetSeries::new(&self.field, self.watched.as_ref()))
    }
}

/// A guard and what its event does.
#[derive(Debug)]
pub(super) struct GuardProgram {
    pub(super) surface: Label,
    pub(super) function: Formulas,
    /// True if the guard has a branch, at which its value jumps.
    pub(super) may_jump: bool,
    pub(super) condition: Option<Formulas>,
    pub(super) jump: Option<Jump>,
    value_jets: Jets,
    reset_jets: Jets,
}

impl GuardProgram {
    /// The guard with derivatives.
    pub(super) fn value_jets(&self) -> Result<&JetSeries, Error> {
        made(&self.value_jets, || JetSeries::of_values(&self.function))
    }

    /// The state after the event with derivatives; `None` if it stays.
    pub(super) fn reset_jets(&self) -> Result<Option<&JetSeries>, Error> {
        let state = self.jump.as_ref().and_then(|jump| jump.state.as_ref());
        state.map(|state| made(&self.reset_jets, || JetSeries::of_values(state))).transpose()
    }
}

impl Equations {
    fn all_guards(&self) -> impl Iterator<Item = &GuardEquations> {
        self.modes.iter().flat_map(|mode| &mode.guards).chain(&self.everywhere)
    }

    pub(super) fn uses_time(&self) -> bool {
        self.modes.iter().any(ModeEquations::uses_time)
            || self.all_guards().any(GuardEquations::uses_time)
    }

    /// True if nothing depends on the time: no formula uses it, and there is no clock. What follows from a state is then the same at any
    /// time.
    pub fn is_autonomous(&self) -> bool {
        !self.uses_time() && self.all_guards().all(|guard| guard.guard.role != Role::Clock)
    }
}

impl Programs {
    pub(super) fn new(equations: &Equations) -> Result<Programs, Error> {
        let uses_time = equations.uses_time();
        let modes =
            equations.modes.iter().map(|mode| mode.program(&equations.everywhere, uses_time));
        Ok(Programs {
            equations: equations.clone(),
            dimension: equations.names.states.len() + usize::from(uses_time),
            modes: modes.collect::<Result<_, Error>>()?,
        })
    }

    /// The program of a mode.
    pub(super) fn mode(&self, name: Label) -> Option<&ModeProgram> {
        self.modes.iter().find(|mode| mode.name == name)
    }
}

impl Jump {
    fn uses_time(&self) -> bool {
        [&self.state, &self.inverse].into_iter().flatten().any(Formulas::uses_time)
    }

    fn program(&self, uses_time: bool) -> Jump {
        let timed = |state: &Formulas| with_time(state, uses_time, Some(Node::Time));
        let (state, inverse) = (self.state.as_ref().map(timed), self.inverse.as_ref().map(timed));
        Jump { mode: self.mode, state, inverse }
    }
}

impl GuardEquations {
    fn uses_time(&self) -> bool {
        self.function.uses_time()
            || self.condition.as_ref().is_some_and(Formulas::uses_time)
            || self.jump.as_ref().is_some_and(Jump::uses_time)
    }

    fn program(&self, uses_time: bool) -> GuardProgram {
        let jump = self.jump.as_ref().map(|jump| jump.program(uses_time));
        let timed = |formulas: &Formulas| with_time(formulas, uses_time, None);
        GuardProgram {
            surface: self.guard.surface,
            function: timed(&self.function),
            may_jump: self.function.nodes().0.iter().any(is_branch),
            condition: self.condition.as_ref().map(timed),
            jump,
            value_jets: Jets::new(),
            reset_jets: Jets::new(),
        }
    }
}

impl ModeEquations {
    fn uses_time(&self) -> bool {
        self.field.uses_time() || self.after_limit.as_ref().is_some_and(Jump::uses_time)
    }

    fn program(
        &self,
        everywhere: &[GuardEquations],
        uses_time: bool,
    ) -> Result<ModeProgram, Error> {
        let field = with_time(&self.field, uses_time, Some(Node::Constant(Constant::from(1.0))));
        // In the order in which the model lists them.
        let all = everywhere.iter().chain(&self.guards);
        let (clocks, guards): (Vec<_>, Vec<_>) =
            all.partition(|guard| guard.guard.role == Role::Clock);
        let guards: Vec<GuardProgram> =
            guards.into_iter().map(|guard| guard.program(uses_time)).collect();
        let clocks = clocks.into_iter().map(|clock| Ok((clock.program(uses_time), clock.times()?)));
        let clocks = clocks.collect::<Result<_, Error>>()?;
        let watched = Formulas::all_of(guards.iter().map(|guard| &guard.function))?;
        let series = Series::new(&field, watched.as_ref())?;
        let after_limit = self.after_limit.as_ref().map(|jump| jump.program(uses_time));
        let (name, jets, closed_form) = (self.name, Jets::new(), ClosedForm::of(&field));
        Ok(ModeProgram {
            name,
            field,
            series,
            guards,
            clocks,
            after_limit,
            closed_form,
            number: NEXT.fetch_add(1, Ordering::Relaxed),
            watched,
            jets,
        })
    }
}

fn is_branch(node: &Node) -> bool {
    matches!(node, Node::Binary(Binary::ArcTangent2, ..))
}

/// The formulas, with the time as the last component, and with its own formula if there is one, where a model uses it.
pub(super) fn with_time(formulas: &Formulas, uses_time: bool, of_time: Option<Node>) -> Formulas {
    if uses_time { formulas.with_time_as_state(of_time) } else { formulas.clone() }
}
