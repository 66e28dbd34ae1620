//! `nonsmooth branch`: periodic orbits along a parameter, with their bifurcations.

use crate::commands::orbit::drawing;
use crate::commands::search;
use crate::error::Error;
use crate::model::columns::table;
use crate::model::question::{Named, failed, named, names_of, point};
use crate::model::returns::{ReturnsOptions, over_parameter};
use crate::options::form::OutputOptions;
use crate::options::output_file::{OutputFile, check, figure};
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use journal_figures::{LabelledBranch, Svg};
use rayon::prelude::*;
use return_map::{Branch, BranchEnd, BranchPoint, BranchSteps, follow_branch};
use std::ops::ControlFlow;

/// Follow the periodic orbits of a return map along a parameter, with their bifurcations
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    returns: ReturnsOptions,
    /// A point of the orbit, roughly: the coordinates of the section, such as x=-0.14,v=0.03. The other states are 0 there
    #[arg(long, num_args = 1.., value_name = "NAME=VALUE", value_parser = named, required = true)]
    near: Vec<Named>,
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
    let model = options.returns.model()?;
    let near = options.near.concat();
    let names = names_of(&near);
    let start = point(&model, &names, &near, "--near")?;
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
    let window = options.returns.window()?;
    let (at, period) = (options.at.unwrap_or(options.returns.from), usize::from(options.period));
    if !(window.0..=window.1).contains(&at) {
        let (from, to) = window;
        return Err(Error::misuse("--at", at, &format!("give a value from {from} to {to}")));
    }
    let starts = std::slice::from_ref(&start);
    let (map, checks) = options.returns.returns(&model, &names, (starts, &[at]))?;
    checks.check(&map, (&start, at), period)?;
    let branch = search::run(&options.output, &mut streams, move || {
        let go_on = |_: &_| ControlFlow::Continue(());
        let branch =
            follow_branch(&map, period, (&start, at), window, BranchSteps::default(), go_on)
                .map_err(failed)?;
        // What is right at one point may be wrong along the way.
        let check = |own: &BranchPoint| checks.check(&map, (&own.point, own.parameter), period);
        branch.points.par_iter().try_for_each(check)?;
        Ok(branch)
    })?;
    if let Some(file) = &options.figure {
        let svg = diagram(&branch, window, (&options.returns.parameter, &names[0]))?;
        file.write(&drawing("branch", file.format, &svg)?, &options.output, &mut streams)?;
    }
    if taken {
        return Ok(());
    }
    form.print(&[rows(points, &branch), bifurcations(&branch)], streams.output)
}

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

fn diagram(branch: &Branch, window: (f64, f64), names: (&str, &str)) -> Result<Svg, Error> {
    let line = branch.line(0);
    let heights: Vec<f64> = line.iter().map(|(_, x, _)| *x).filter(|x| x.is_finite()).collect();
    over_parameter((window, heights), names, |frame, svg| {
        let drawn = [LabelledBranch { marks: branch.marks(0), line }];
        frame.labelled_branches(svg, &drawn, ["#1f4e96", "#d03a2b"]);
        Ok(())
    })
}
