//! `nonsmooth diagram`: where orbits are after a transient, along a parameter.

use crate::commands::orbit::drawing;
use crate::commands::search;
use crate::error::Error;
use crate::model::columns::{long, table};
use crate::model::question::{Named, named, names_of, point};
use crate::model::returns::{HEIGHT, ReturnsOptions, over_parameter};
use crate::options::form::OutputOptions;
use crate::options::output_file::{OutputFile, check, figure};
use crate::output::{Cell, Column, Table};
use crate::streams::Streams;
use journal_figures::Svg;
use rayon::prelude::*;
use return_map::{DiagramColumn, OrbitLength, Seeds, bifurcation_diagram, periods};
use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

/// Follow the returns of some starts along a parameter, after a transient: a bifurcation diagram
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    returns: ReturnsOptions,
    /// A start on the section, with commas, such as x=0,v=0; once for each. The other states are 0 there
    #[arg(long, value_name = "NAME=VALUE,…", value_parser = named, required = true)]
    near: Vec<Named>,
    /// Values of the parameter, equally far apart
    #[arg(long, value_name = "N", default_value_t = 270, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    columns: u32,
    /// Returns that are passed over
    #[arg(long, default_value_t = 100)]
    skip: u32,
    /// Returns that are shown
    #[arg(long = "returns", value_name = "RETURNS", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    shown: u32,
    /// Begin at each value where the orbit of the value before has ended: to follow an attractor, upwards or with --from above --to downwards
    #[arg(long)]
    carried: bool,
    /// A figure of the first coordinate over the parameter: .svg or .png
    #[arg(long, value_parser = figure)]
    figure: Option<OutputFile>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// How far points of an orbit may be apart that count as one, as a part of the range of the diagram: far above the error of a return.
const SAME: f64 = 1e-6;

pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let model = options.returns.model()?;
    let names = names_of(&options.near[0]);
    let start = |near: &Named| point(&model, &names, near, "--near");
    let starts = options.near.iter().map(start).collect::<Result<Vec<_>, Error>>()?;
    let window = options.returns.window()?;
    let before = [
        Column::new("parameter", "", "the parameter"),
        Column::new("start", "", "number of the start, from 1"),
    ];
    let own = || names.iter().map(|name| (name.clone(), "a point of the orbit"));
    let about = "one row for each return that is shown";
    let points = long(table(("points", about), &before, own(), &[]));
    let after = [
        Column::new(
            "period",
            "",
            "returns until it comes back to its points, to 10⁻⁶ of the range of the diagram; empty if it does not twice within those shown",
        ),
        Column::new("failed", "", "why the orbit has no points"),
    ];
    let about = "one row for each value of the parameter and each start";
    let orbits = table(("orbits", about), &before, own(), &after);
    let form = options.output.form(&[orbits, points])?;
    let taken = check(&[("--figure", options.figure.as_ref())])?;
    let (from, to) = (options.returns.from, options.returns.to);
    let part = (to - from) / f64::from(options.columns);
    let parameters: Vec<f64> =
        (0..options.columns).map(|column| from + part * (f64::from(column) + 0.5)).collect();
    let (map, checks) = options.returns.returns(&model, &names, (&starts, &parameters))?;
    let seeds = if options.carried { Seeds::Carried } else { Seeds::Fresh };
    let length = OrbitLength { transient: options.skip as usize, keep: options.shown as usize };
    let columns = ("columns", parameters.len());
    let (columns, periods) =
        search::run_counted(&options.output, &mut streams, columns, move |count| {
            let progress = |finished| {
                count.store(finished, Ordering::Relaxed);
                ControlFlow::Continue(())
            };
            let columns =
                bifurcation_diagram(&map, &parameters, (&starts, seeds), length, progress);
            // What is right at one value of the parameter, or at one point, may be wrong at another one: where each orbit begins, and behind its last point.
            let carried = seeds == Seeds::Carried;
            let begins = |at: usize, own: usize| {
                let before = at.checked_sub(1).filter(|_| carried).and_then(|at| columns.get(at));
                let last = before.and_then(|column| column.orbits.get(own)?.as_ref().ok()?.last());
                last.unwrap_or(&starts[own])
            };
            columns.par_iter().enumerate().try_for_each(|(at, column)| {
                column.orbits.iter().enumerate().try_for_each(|(own, orbit)| {
                    let last = orbit.as_ref().ok().and_then(|points| points.last());
                    std::iter::once(begins(at, own))
                        .chain(last)
                        .try_for_each(|point| checks.check(&map, (point, column.parameter), 1))
                })
            })?;
            let periods = periods(&columns, &starts, SAME);
            Ok((columns, periods))
        })?;
    let failed = columns.iter().flat_map(|column| &column.orbits).filter(|orbit| orbit.is_err());
    let (failed, all) = (failed.count(), columns.len() * options.near.len());
    if failed == all {
        let first =
            columns.iter().flat_map(|column| &column.orbits).find_map(|orbit| orbit.as_ref().err());
        let first = first.map_or_else(String::new, ToString::to_string);
        return Err(Error::Model(format!("no orbit has points; the first one: {first}")));
    }
    if failed > 0 {
        let text = format_args!("{failed} of {all} orbits have no points; --table orbits says why");
        options.output.note(&mut streams, text);
    }
    if let Some(file) = &options.figure {
        let svg = diagram(&columns, window, (&options.returns.parameter, &names[0]))?;
        file.write(&drawing("diagram", file.format, &svg)?, &options.output, &mut streams)?;
    }
    if taken {
        return Ok(());
    }
    let (mut of_orbits, mut of_points) = (Table::new(orbits), Table::new(points));
    for (column, periods) in columns.iter().zip(periods) {
        for (number, (orbit, period)) in column.orbits.iter().zip(periods).enumerate() {
            let begin: [Cell; 2] = [column.parameter.into(), (number as u64 + 1).into()];
            let row = |point: &[f64]| {
                begin.iter().cloned().chain(point.iter().map(|x| Cell::from(*x))).collect()
            };
            let last = orbit.as_ref().ok().and_then(|points| points.last());
            let mut own: Vec<Cell> = match last {
                Some(point) => row(point),
                None => begin.iter().cloned().chain(names.iter().map(|_| Cell::Missing)).collect(),
            };
            let reason = orbit.as_ref().err().map(ToString::to_string);
            own.extend([period.into(), reason.into()]);
            of_orbits.rows.push(own);
            of_points.rows.extend(orbit.iter().flatten().map(|point| row(point)));
        }
    }
    form.print(&[of_orbits, of_points], streams.output)
}

fn diagram(
    columns: &[DiagramColumn],
    window: (f64, f64),
    names: (&str, &str),
) -> Result<Svg, Error> {
    let points: Vec<(f64, f64)> = columns
        .iter()
        .flat_map(|column| {
            column.orbits.iter().flatten().flatten().map(|point| (column.parameter, point[0]))
        })
        .collect();
    let heights = points.iter().map(|(_, x)| *x);
    over_parameter((window, heights), names, |frame, svg| {
        frame.point_cloud(svg, (columns.len(), HEIGHT), points.iter().copied())
    })
}
