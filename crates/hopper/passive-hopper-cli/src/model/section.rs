//! `nonsmooth section`: the returns to a surface.

use crate::error::Error;
use crate::model::columns::table;
use crate::model::question::{ModelOptions, StartOptions, check_surface, failed};
use crate::model::run::{certainty, reason};
use crate::options::form::OutputOptions;
use crate::output::{Cell, Column, Table};
use crate::streams::Streams;
use hybrid_system::{EquationsModel, Execution, Limits};
use nalgebra::DVector;

/// Follow the returns to a surface: the states behind each event there
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// The surface
    #[arg(long)]
    surface: String,
    #[command(flatten)]
    start: StartOptions,
    /// Returns that are shown
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
    returns: u32,
    /// Returns that are passed over before
    #[arg(long, default_value_t = 0)]
    skip: u32,
    /// The time at which the run ends, if there are fewer returns
    #[arg(long, default_value_t = 1e4, value_parser = crate::options::values::finite)]
    time: f64,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// Events between two returns, at most: a run with more is taken for one that does not return.
const BETWEEN: usize = 100_000;

pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let model = options.model.model()?;
    let (mode, start) = options.start.start_in(&model)?;
    check_surface(&model, &options.surface)?;
    let (skip, wanted) =
        (u64::from(options.skip), u64::from(options.skip) + u64::from(options.returns));
    let before = [
        Column::new("return", "", "number of the return, from 1"),
        Column::new("time", "", "when it happens").with_error("error"),
        Column::new("error", "", "of the time since the event before").error(),
    ];
    let states = &model.equations.names().states;
    let count = states.len();
    let names = states.iter().map(|name| (name.clone(), "the state behind the event"));
    let after = [Column::new("certainty", "", "of that no event came before")];
    let returns = table(("returns", "one row for each return"), &before, names, &after);
    let form = options.output.form(&[returns])?;
    let own: EquationsModel<DVector<f64>> = model.equations.model().map_err(failed)?;
    let run = own.start_at(&mode, start, (0.0, options.time)).map_err(failed)?;
    let limits = Limits::new(
        options.time,
        BETWEEN.saturating_mul(usize::try_from(wanted).unwrap_or(usize::MAX)),
    );
    let (mut found, mut number) = (Table::new(returns), 0_u64);
    let mut execution = Execution::restore(&own, run.checkpoint(), limits);
    for arc in execution.by_ref() {
        let arc = arc.map_err(failed)?;
        let Some(event) = arc.event().filter(|event| event.surface == *options.surface.as_str())
        else {
            continue;
        };
        number += 1;
        if number <= skip {
            continue;
        }
        let state = event.after.as_ref().map_or(&event.before, |(_, state)| state);
        let mut row: Vec<Cell> = vec![
            number.into(),
            Cell::measured(event.time, event.time_error),
            Cell::Error(event.time_error),
        ];
        // Behind the states may be the time.
        row.extend(state.iter().take(count).map(|x| Cell::from(*x)));
        row.push(certainty(event.certainty).into());
        found.rows.push(row);
        if number == wanted {
            break;
        }
    }
    let why = reason(execution.stop());
    if found.rows.is_empty() {
        let text = format!("only {number} returns to {}: the run ended by {why}", options.surface);
        return Err(Error::Model(text));
    }
    if number < wanted {
        options
            .output
            .note(&mut streams, format_args!("{number} returns in all: the run ended by {why}"));
    }
    form.print(&[found], streams.output)
}
