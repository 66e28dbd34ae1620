//! `nonsmooth run`: a trajectory with its events.

use crate::error::Error;
use crate::model::columns::table;
use crate::model::question::{ModelOptions, StartOptions, failed, numbers};
use crate::options::form::OutputOptions;
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use hybrid_system::{
    ArcEnd, Certainty, EquationsModel, Execution, Filippov, FilippovMode, FilippovSurface,
    HybridSystem, Label, Limits, Stop, Tolerances, Trajectory,
};
use nalgebra::DVector;

/// Follow a run: its events, each with its error and its certainty, and states at equal times
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    start: StartOptions,
    /// The time at which the run ends [default: that of the file]
    #[arg(long, value_parser = crate::options::values::finite)]
    time: Option<f64>,
    /// The most events
    #[arg(long, default_value_t = 10_000)]
    events: usize,
    /// States at so many equal steps of the time: the table `samples`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    samples: Option<u32>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

const TIME: Column = Column::new("time", "", "when it happens").with_error("error");
const BEFORE: [Column; 4] = [
    TIME,
    Column::new(
        "error",
        "",
        "of the time since the event before: a bound for closed forms, else an estimate",
    )
    .error(),
    Column::new("surface", "", "where it happens"),
    Column::new("mode", "", "the mode behind it"),
];
const CERTAINTY: [Column; 1] = [Column::new("certainty", "", "of that no event came before")];

/// How certain an event is, in a word.
pub(crate) fn certainty(of: Certainty) -> &'static str {
    match of {
        Certainty::Exact => "exact",
        Certainty::Certain => "certain",
        Certainty::Interpolated => "interpolated",
        _ => "sampled",
    }
}

/// Why a run ended, in words.
pub(crate) fn reason(stop: Option<Stop>) -> &'static str {
    match stop {
        None => "goes on",
        Some(Stop::TimeLimit) => "the end of the time",
        Some(Stop::EventLimit) => "the most events; raise --events",
        Some(Stop::Terminal) => "a surface that stops",
        Some(Stop::NoFurtherEvent) => "no event follows",
        Some(Stop::Zeno) => {
            "the events have a limit (Zeno); `rests` in all modes of these events gives the mode behind it"
        }
        Some(Stop::Sliding) => {
            "the fields on both sides point at a surface, or two such surfaces meet; slides = true in the file goes on along one"
        }
        Some(_) => {
            "a budget of the search for the next event; look at the rates near this state, or give a shorter --time"
        }
    }
}

pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let model = options.model.sliding_model()?;
    let (mode, start) = options.start.start_in(&model)?;
    let of_file = model
        .start
        .time
        .as_ref()
        .map(|time| numbers(&model, &[time.text()], "[start] of the file: time"));
    let of_file = of_file.transpose()?.and_then(|values| values.first().copied());
    let Some(time) = options.time.or(of_file) else {
        return Err(Error::Misuse(
            "--time is missing, and the file has none; give when the run ends".into(),
        ));
    };
    let states = &model.equations.names().states;
    let count = states.len();
    let after = states.iter().map(|name| (name.clone(), "the state behind it"));
    let events = table(("events", "one row for each event"), &BEFORE, after, &CERTAINTY);
    let at = states.iter().map(|name| (name.clone(), "the state"));
    let before = [Column::new("time", "", "the time"), Column::new("mode", "", "the mode")];
    let samples = table(("samples", "states at equal times, with --samples"), &before, at, &[]);
    let at = states.iter().map(|name| (name.clone(), "the state"));
    let why = [Column::new("reason", "", "why the run ended")];
    let end = table(("end", "the end of the run"), &before, at, &why);
    let form = options.output.form(&[events, samples, end])?;

    let own: EquationsModel<DVector<f64>> = model.equations.model().map_err(failed)?;
    let at = own.start_at(&mode, start, (0.0, time)).map_err(failed)?.checkpoint();
    let limits = |time| Limits::new(time, options.events);
    let (steps, tables) = (options.samples, [events, samples, end]);
    let Followed { shown, wrong, early } = if model.slides {
        let relay = Filippov::new(own.clone(), SLIDING);
        let (mode, state) = (FilippovMode::Free(at.mode()), at.state());
        let begun = |time| Execution::new(&relay, mode, state.clone(), limits(time));
        follow(begun, tables, count, (time, steps))?
    } else {
        let begun = |time| Execution::restore(&own, at.clone(), limits(time));
        follow(begun, tables, count, (time, steps))?
    };
    form.print(&shown, streams.output)?;
    if let Some((time, why)) = early {
        options.output.note(&mut streams, format_args!("the run ended at the time {time}: {why}"));
    }
    wrong.map_or(Ok(()), Err)
}

/// The tolerances of a motion along a surface: those of Python.
const SLIDING: Tolerances = Tolerances::both(1e-12);

/// A name of a mode or a surface.
trait Word {
    fn word(&self) -> String;
}

impl Word for Label {
    fn word(&self) -> String {
        self.to_string()
    }
}

impl Word for FilippovMode<Label, Label> {
    fn word(&self) -> String {
        match self {
            FilippovMode::Free(mode) => mode.to_string(),
            FilippovMode::Sliding { surface, .. } => format!("along {surface}"),
        }
    }
}

impl Word for FilippovSurface<Label, Label> {
    fn word(&self) -> String {
        match self {
            FilippovSurface::Model(surface) => surface.to_string(),
            FilippovSurface::Tangent { surface, .. } => format!("{surface}: end of sliding"),
        }
    }
}

/// What stands in place of a surface where infinitely many events in finite time have their limit.
const LIMIT: &str = "(limit)";

/// What a run gave.
struct Followed {
    shown: Vec<Table>,
    /// The error that has ended it.
    wrong: Option<Error>,
    /// When and why it ended, if that was neither its time nor a surface that stops.
    early: Option<(f64, &'static str)>,
}

/// Follows a run. States have `count` components, and may have the time behind them.
fn follow<'m, T>(
    begun: impl Fn(f64) -> Execution<'m, T>,
    [events, samples, end]: [&'static TableKind; 3],
    count: usize,
    (time, steps): (f64, Option<u32>),
) -> Result<Followed, Error>
where
    T: HybridSystem<State = DVector<f64>, Mode: Word, Surface: Word> + 'm,
{
    let (mut found, mut wrong) = (Table::new(events), None);
    let mut execution = begun(time);
    let states = |state: &DVector<f64>| {
        state.iter().take(count).map(|x| Cell::from(*x)).collect::<Vec<Cell>>()
    };
    for arc in execution.by_ref() {
        let arc = match arc {
            Ok(arc) => arc,
            // What was found before is shown.
            Err(error) => {
                wrong = Some(error.to_string());
                break;
            }
        };
        let (time, error, surface, after, before, certainty) = match &arc.end {
            ArcEnd::Event(event) => {
                let how = certainty(event.certainty);
                let (time, surface) = (event.time, event.surface.word());
                (time, Some(event.time_error), surface, &event.after, &event.before, how)
            }
            ArcEnd::Zeno { limit, after } => {
                let error = Some(limit.time_error);
                (limit.time, error, LIMIT.to_owned(), after, &limit.state, "estimated")
            }
            ArcEnd::Sliding { sliding, after } => {
                let surface = format!("{}: sliding", sliding.surface.word());
                (sliding.time, None, surface, after, &sliding.state, "estimated")
            }
            _ => continue,
        };
        let (mode, state) = match after {
            Some((mode, state)) => (Some(mode.word()), state),
            None => (None, before),
        };
        let mut row: Vec<Cell> = match error {
            Some(error) => vec![Cell::measured(time, error), Cell::Error(error)],
            None => vec![time.into(), Cell::Missing],
        };
        row.extend([surface.into(), mode.into()]);
        row.extend(states(state));
        row.push(certainty.into());
        found.rows.push(row);
    }
    let at = execution.checkpoint();
    // Errors of a motion count their times from its beginning.
    let since = format!("the last event, or the start, was at the time {}", at.time());
    let mut wrong = wrong.map(|error| Error::Model(format!("{error}; {since}")));
    let mut last = Table::new(end);
    let mut row: Vec<Cell> = vec![at.time().into(), at.mode().word().into()];
    row.extend(states(at.state()));
    row.push(if wrong.is_some() { "an error" } else { reason(execution.stop()) }.into());
    last.rows.push(row);
    let mut shown = vec![found];
    if let Some(steps) = steps {
        let grid = (0..=steps).map(|k| time * f64::from(k) / f64::from(steps.max(1)));
        // Behind the last event of a run that ended in an error nothing is known.
        let grid: Vec<f64> = grid.filter(|x| wrong.is_none() || *x <= at.time()).collect();
        let until = if wrong.is_none() { time } else { at.time() };
        match begun(until).trajectory(&grid) {
            Ok(trajectory) => shown.push(samples_of(samples, &trajectory, count)),
            // The events stay.
            Err(error) => wrong = wrong.or_else(|| Some(failed(error))),
        }
    }
    shown.push(last);
    let expected = matches!(execution.stop(), Some(Stop::TimeLimit | Stop::Terminal));
    let early = (!expected && wrong.is_none()).then(|| (at.time(), reason(execution.stop())));
    Ok(Followed { shown, wrong, early })
}

/// The table of states at equal times.
fn samples_of<M: Word, S>(
    kind: &'static TableKind,
    trajectory: &Trajectory<M, S>,
    count: usize,
) -> Table {
    let mut found = Table::new(kind);
    for row in (0..trajectory.times.len()).filter(|row| trajectory.on_grid[*row]) {
        let mut cells: Vec<Cell> =
            vec![trajectory.times[row].into(), trajectory.modes[row].word().into()];
        cells.extend(trajectory.states.row(row).iter().take(count).map(|x| Cell::from(*x)));
        found.rows.push(cells);
    }
    found
}
