//! `nonsmooth run`: a trajectory with its events.

use crate::error::Error;
use crate::model::columns::table;
use crate::model::question::{ModelOptions, StartOptions, failed, numbers};
use crate::options::form::OutputOptions;
use crate::output::{Cell, Column, Table};
use crate::streams::Streams;
use hybrid_system::{Certainty, EquationsModel, Execution, Limits, Stop};
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
        Some(Stop::Zeno) => "the events have a limit (Zeno); give the mode behind it",
        Some(Stop::Sliding) => {
            "the fields on both sides point at a surface; give the mode of sliding"
        }
        Some(_) => "a budget of the search",
    }
}

pub(crate) fn run(options: &Options, streams: Streams<'_>) -> Result<(), Error> {
    let model = options.model.model()?;
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
    let begun = || {
        let run = own.start_at(&mode, start.clone(), (0.0, time)).map_err(failed)?;
        Ok::<_, Error>(Execution::restore(
            &own,
            run.checkpoint(),
            Limits::new(time, options.events),
        ))
    };
    let mut found = [Table::new(events), Table::new(samples), Table::new(end)];
    let mut execution = begun()?;
    let mut last = None;
    for arc in execution.by_ref() {
        let arc = arc.map_err(failed)?;
        if let Some(event) = arc.event() {
            let (mode, state) = match &event.after {
                Some((mode, state)) => (Some(mode.to_string()), state),
                None => (None, &event.before),
            };
            let mut row: Vec<Cell> =
                vec![Cell::measured(event.time, event.time_error), Cell::Error(event.time_error)];
            row.extend([event.surface.to_string().into(), mode.into()]);
            // Behind the states may be the time.
            row.extend(state.iter().take(count).map(|x| Cell::from(*x)));
            row.push(certainty(event.certainty).into());
            found[0].rows.push(row);
        }
        last = Some(arc);
    }
    let at = execution.checkpoint();
    let mut row: Vec<Cell> = vec![at.time().into(), at.mode().to_string().into()];
    row.extend(at.state().iter().take(count).map(|x| Cell::from(*x)));
    row.push(reason(execution.stop()).into());
    found[2].rows.push(row);
    drop(last);
    if let Some(steps) = options.samples {
        let grid: Vec<f64> =
            (0..=steps).map(|k| time * f64::from(k) / f64::from(steps.max(1))).collect();
        let trajectory = begun()?.trajectory(&grid).map_err(failed)?;
        for row in (0..trajectory.times.len()).filter(|row| trajectory.on_grid[*row]) {
            let mut cells: Vec<Cell> =
                vec![trajectory.times[row].into(), trajectory.modes[row].to_string().into()];
            cells.extend(
                trajectory.states.row(row).iter().take(states.len()).map(|x| Cell::from(*x)),
            );
            found[1].rows.push(cells);
        }
    }
    let [events, samples, end] = found;
    let samples = (!samples.rows.is_empty()).then_some(samples);
    let shown: Vec<Table> = [Some(events), samples, Some(end)].into_iter().flatten().collect();
    form.print(&shown, streams.output)
}
