//! `nonsmooth branch`: periodic orbits along a parameter, with their bifurcations.

use crate::commands::orbit::drawing;
use crate::commands::search;
use crate::error::Error;
use crate::model::columns::table;
use crate::model::file::{Model, texts};
use crate::model::period::check_period;
use crate::model::question::{ModelOptions, check_surface, failed, mode_of, named, point};
use crate::options::form::OutputOptions;
use crate::options::output_file::{OutputFile, check, figure};
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use hybrid_system::EquationsModel;
use journal_figures::{Frame, LabelledBranch, Svg, ticks};
use nalgebra::DVector;
use return_map::{Branch, BranchEnd, BranchSteps, EquationReturns, follow_branch};
use std::ops::ControlFlow;

/// Follow the periodic orbits of a return map along a parameter, with their bifurcations
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// The parameter that changes
    #[arg(long)]
    parameter: String,
    /// From this value of the parameter
    #[arg(long, value_parser = crate::options::values::finite, allow_negative_numbers = true)]
    from: f64,
    /// To this value
    #[arg(long, value_parser = crate::options::values::finite, allow_negative_numbers = true)]
    to: f64,
    /// The surface to which the orbit returns
    #[arg(long)]
    surface: String,
    /// The mode behind the surface [default: that of the file, or the first one]
    #[arg(long)]
    mode: Option<String>,
    /// A point of the orbit, roughly: the coordinates of the section, such as x=-0.14 v=0.03. The other states are 0 there
    #[arg(long, num_args = 1.., value_name = "NAME=VALUE", value_parser = named, required = true)]
    near: Vec<(String, String)>,
    /// The value of the parameter there [default: that of --from]
    #[arg(long, value_parser = crate::options::values::finite, allow_negative_numbers = true)]
    at: Option<f64>,
    /// Returns until the orbit closes
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1000))]
    period: u16,
    /// A figure of the first coordinate over the parameter: .svg or .png
    #[arg(long, value_parser = figure)]
    figure: Option<OutputFile>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

static BIFURCATIONS: TableKind = TableKind {
    name: "bifurcations",
    about: "one row for each bifurcation, and for each end of the branch",
    long: false,
    columns: &[
        Column::new("kind", "", "what happens"),
        Column::new("parameter", "", "where").with_error("error"),
        Column::new("error", "", "of the parameter: an estimate").error(),
    ],
};

pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let model = options.model.model()?;
    let mode = mode_of(options.mode.as_deref(), &model)?;
    check_surface(&model, &options.surface)?;
    let names: Vec<String> = options.near.iter().map(|(name, _)| name.clone()).collect();
    let start = point(&model, &names, &options.near, "--near")?;
    let before = [Column::new("parameter", "", "the parameter")];
    let own = names.iter().map(|name| (name.clone(), "the first point of the orbit"));
    let after = [
        Column::new("error", "", "how far the point is known").error(),
        Column::new("largest_multiplier", "", "the largest size of a multiplier").measured(),
        Column::new("stable", "", "whether the orbit attracts"),
    ];
    let points = table(("points", "one row for each point of the branch"), &before, own, &after);
    let form = options.output.form(&[points, &BIFURCATIONS])?;
    let taken = check(&[("--figure", options.figure.as_ref())])?;
    let coordinates = texts(&names);
    let (parameter, surface) = (&options.parameter, &options.surface);
    let map = EquationReturns::new(&model.equations, parameter, (&mode, surface), &coordinates);
    let map = map.map_err(|error| Error::Misuse(error.to_string()))?;
    let window = (options.from.min(options.to), options.from.max(options.to));
    let (at, period) = (options.at.unwrap_or(options.from), usize::from(options.period));
    if !(window.0 < window.1) || !(window.0..=window.1).contains(&at) {
        let (from, to) = window;
        let text = format!(
            "--from {from} --to {to} --at {at}: the window must have a length, and hold the value of --at"
        );
        return Err(Error::Misuse(text));
    }
    closes(&model, &mode, options, (&names, &start))?;
    let branch = search::run(&options.output, &mut streams, move || {
        let go_on = |_: &_| ControlFlow::Continue(());
        follow_branch(&map, period, (&start, at), window, BranchSteps::default(), go_on)
            .map_err(failed)
    })?;
    if let Some(file) = &options.figure {
        let svg = diagram(&branch, window, (parameter, &names[0]));
        file.write(&drawing("branch", file.format, &svg)?, &options.output, &mut streams)?;
    }
    if taken {
        return Ok(());
    }
    form.print(&[rows(points, &branch), bifurcations(&branch)], streams.output)
}

/// Refuses a return that does not come back to all states of its start: the orbit is periodic in the named coordinates alone then.
fn closes(
    model: &Model,
    mode: &str,
    options: &Options,
    (names, start): (&[String], &[f64]),
) -> Result<(), Error> {
    let is_guard = !model.clocks.contains(&options.surface);
    if is_guard && !model.equations.is_autonomous() {
        let text = "--surface: the equations use the time, and each return begins at t = 0; give a surface with a period, or make the phase a state";
        return Err(Error::Misuse(text.to_owned()));
    }
    let states = &model.equations.names().states;
    let whole: Vec<f64> = states
        .iter()
        .map(|state| names.iter().position(|name| name == state).map_or(0.0, |at| start[at]))
        .collect();
    let own: EquationsModel<DVector<f64>> = model.equations.model().map_err(failed)?;
    let run = own.start_at(mode, whole.clone(), (0.0, LONGEST)).map_err(failed)?;
    for arc in run {
        let arc = arc.map_err(failed)?;
        let Some(event) = arc.event().filter(|event| event.surface == *options.surface.as_str())
        else {
            continue;
        };
        let Some((_, after)) = &event.after else { return Ok(()) };
        for (state, (from, to)) in states.iter().zip(whole.iter().zip(after.iter())) {
            let apart = (from - to).abs() > NAMED * (1.0 + from.abs());
            if !names.contains(state) && apart {
                let text = format!(
                    "--near: {state} is {from} at the start and {to} behind {}; name it in --near",
                    options.surface
                );
                return Err(Error::Misuse(text));
            }
        }
        return check_period(model, event.time, &whole, Some(&options.surface), "--surface");
    }
    Ok(())
}

/// The longest return that is tried, as in the library.
const LONGEST: f64 = 1e3;

/// How far a state that is not named may be from its start behind the surface: a section has it to rounding.
const NAMED: f64 = 1e-6;

fn rows(kind: &'static TableKind, branch: &Branch) -> Table {
    let mut found = Table::new(kind);
    for own in &branch.points {
        let mut row: Vec<Cell> = vec![own.parameter.into()];
        row.extend(own.point.iter().map(|x| Cell::from(*x)));
        let error = own.multiplier_errors.iter().copied().fold(0.0, f64::max);
        row.extend([
            Cell::Error(own.error * own.size),
            Cell::measured(own.spectral_radius(), error),
            own.is_stable.into(),
        ]);
        found.rows.push(row);
    }
    found
}

fn bifurcations(branch: &Branch) -> Table {
    let mut found = Table::new(&BIFURCATIONS);
    for own in &branch.bifurcations {
        let place = Cell::measured(own.at.parameter, own.error);
        found.push([own.kind.to_string().into(), place, Cell::Error(own.error)]);
    }
    let ends = [branch.points.first(), branch.points.last()];
    for (end, last) in branch.ends.iter().zip(ends) {
        let (text, at) = match end {
            BranchEnd::Border { border, at, .. } => (border.to_string(), Some(at.parameter)),
            BranchEnd::Window => ("the end of the window".to_owned(), None),
            BranchEnd::Closed => ("the branch closes".to_owned(), None),
            BranchEnd::Doubling => ("begins at a doubling".to_owned(), None),
            BranchEnd::PointLimit => ("the most points".to_owned(), None),
            BranchEnd::Stopped => ("stopped".to_owned(), None),
            BranchEnd::Lost { reason } => (format!("lost: {reason}"), None),
        };
        let at = at.or(last.map(|point| point.parameter));
        found.push([text.into(), at.into(), Cell::Missing]);
    }
    found
}

fn diagram(branch: &Branch, window: (f64, f64), (parameter, coordinate): (&str, &str)) -> Svg {
    let line = branch.line(0);
    let heights = || line.iter().map(|(_, x, _)| *x).filter(|x| x.is_finite());
    let (low, high) =
        heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let room = 0.05 * (high - low).max(1e-9 * high.abs().max(1e-9));
    let mut svg = Svg::new(620.0, 400.0);
    let frame = Frame::linear(72.0, 14.0, 530.0, 330.0, window, (low - room, high + room));
    let drawn = [LabelledBranch { marks: branch.marks(0), line }];
    frame.labelled_branches(&mut svg, &drawn, ["#1f4e96", "#d03a2b"]);
    let (x, y) = (ticks(frame.x, 6), ticks(frame.y, 6));
    frame.axes(&mut svg, &x, &y, parameter, coordinate);
    svg
}
