//! `nonsmooth basin`: attractors, and the basins of a window.

use crate::commands::orbit::drawing;
use crate::commands::search;
use crate::error::Error;
use crate::model::columns::table;
use crate::model::file::Model;
use crate::model::period::check_period;
use crate::model::question::{ModelOptions, StartOptions, failed, numbers, place_of};
use crate::options::form::OutputOptions;
use crate::options::output_file::{OutputFile, check, figure};
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use basin_of_attraction::{
    Attractors, AxisNames, Grid, Hyperrectangle, Interval, Label, LabelImage, RecurrenceLimits,
    StateGrid, StateMap,
};
use hybrid_system::{EquationsModel, Label as Name};
use nalgebra::DVector;
use return_map::{ExecutionSteps, FlowSteps};
use std::collections::BTreeMap;

/// Find the attractors of a window of states, and the basin of each of its points
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    start: StartOptions,
    /// The window of each state, such as x=-2:2 v=-2:2. The picture has the first two; the others have their value of the start there
    #[arg(long, num_args = 1.., value_name = "NAME=FROM:TO", value_parser = crate::model::question::named, required = true)]
    window: Vec<(String, String)>,
    /// The time of a step: a period of the forcing, or about a turn. It may be a formula, such as 2*pi
    #[arg(long)]
    step: String,
    /// Cells of the window along each state, in which attractors are looked for
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(4..=100_000))]
    cells: u32,
    /// Starts of the search along each of the first two states
    #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(1..=1000))]
    starts: u32,
    /// The most steps of an orbit; one that has come to nothing then is undecided
    #[arg(long, value_name = "STEPS", default_value_t = RecurrenceLimits::default().budget)]
    budget: usize,
    /// Pixels across and up
    #[arg(long, num_args = 2, default_values_t = [200, 200], value_parser = clap::value_parser!(u32).range(1..=8192))]
    pixels: Vec<u32>,
    /// The picture: .svg or .png
    #[arg(long, value_parser = figure)]
    figure: Option<OutputFile>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

static BASINS: TableKind = TableKind {
    name: "basins",
    about: "one row for each fate that occurs in the picture",
    long: false,
    columns: &[
        Column::new("label", "", "number of the fate"),
        Column::new("fate", "", "its meaning"),
        Column::new("pixels", "", "number of pixels"),
        Column::new("fraction", "", "fraction of all pixels").measured(),
    ],
};

/// What was found.
struct Found {
    attractors: Attractors,
    image: LabelImage,
}

pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let model = options.model.model()?;
    let (mode, start) = options.start.start_in(&model)?;
    let states = model.equations.names().states.clone();
    let sides = sides(&model, &options.window)?;
    let step = numbers(&model, std::slice::from_ref(&options.step), "--step")?[0];
    if !(step > 0.0 && step.is_finite()) {
        return Err(Error::misuse("--step", &options.step, "a step takes a positive time"));
    }
    let middle: Vec<f64> = sides.iter().map(|side| side.left.midpoint(side.right)).collect();
    check_period(&model, step, &middle, None, "--step")?;
    let before = [
        Column::new("label", "", "number of its basin"),
        Column::new(
            "period",
            "",
            "steps until it comes back to a point; none for an orbit that never does",
        ),
        Column::new("starts", "", "starts of the search that came to it"),
    ];
    let mode_column =
        (model.modes.len() > 1).then(|| ("mode".to_owned(), "number of its mode, from 0"));
    let names = states.iter().map(|name| (name.clone(), "a point of it")).chain(mode_column);
    let attractors =
        table(("attractors", "one row for each attractor that was found"), &before, names, &[]);
    let form = options.output.form(&[&BASINS, attractors])?;
    let taken = check(&[("--figure", options.figure.as_ref())])?;
    let plane = [0, 1].map(|at| place_of(&states, &options.window[at].0, "--window"));
    let [x, y] = plane;
    let question = Question {
        model,
        mode,
        start,
        sides,
        step,
        plane: (x?, y?),
        cells: options.cells,
        starts: options.starts,
        budget: options.budget,
        pixels: (options.pixels[0] as usize, options.pixels[1] as usize),
    };
    let (plane, axes) = (question.plane, [&options.window[0].0, &options.window[1].0]);
    let found = search::run(&options.output, &mut streams, move || question.answer())?;
    if let Some(file) = &options.figure {
        let names = AxisNames { x: axes[0], y: axes[1] };
        let svg = found.image.picture(&found.attractors.positions(), plane, names)?;
        file.write(&drawing("basins", file.format, &svg)?, &options.output, &mut streams)?;
    }
    if let Some(remedy) = found.attractors.remedy() {
        options.output.note(&mut streams, format_args!("no attractor was found: {remedy}"));
    }
    if taken {
        return Ok(());
    }
    let mut known = Table::new(attractors);
    for own in found.attractors.attractors() {
        let mut row: Vec<Cell> =
            vec![u64::from(own.label.code()).into(), own.period.into(), own.starts.into()];
        row.extend(own.points.first().into_iter().flatten().map(|x| Cell::from(*x)));
        known.rows.push(row);
    }
    form.print(&[shares(&found.image), known], streams.output)
}

/// The window of each state, in the order of the states.
fn sides(model: &Model, given: &[(String, String)]) -> Result<Vec<Interval>, Error> {
    let states = &model.equations.names().states;
    if given.len() < 2 || given.len() != states.len() {
        let (count, all) = (given.len(), states.join(", "));
        let text = format!(
            "--window: {count} windows; give one for each state, which are two or more: {all}"
        );
        return Err(Error::Misuse(text));
    }
    window_of(model, states, given)
}

/// The window of each of these names, in their order.
///
/// # Errors
/// [`Error::Misuse`] for another name, for one that stands twice or is missing, and for ends that do not increase.
pub(crate) fn window_of(
    model: &Model,
    names: &[String],
    given: &[(String, String)],
) -> Result<Vec<Interval>, Error> {
    let mut sides = vec![None; names.len()];
    for (name, ends) in given {
        let place = place_of(names, name, "--window")?;
        let Some((from, to)) = ends.split_once(':') else {
            return Err(Error::misuse("--window", ends, "give two ends, such as x=-2:2"));
        };
        let ends = numbers(model, &[from.to_owned(), to.to_owned()], "--window")?;
        let side = Interval::new(ends[0], ends[1]);
        sides[place] =
            Some(side.map_err(|error| Error::Misuse(format!("--window {name}: {error}")))?);
    }
    let missing = |place: usize| {
        Error::Misuse(format!("--window: {} stands twice, or is missing", names[place]))
    };
    sides.iter().enumerate().map(|(place, side)| side.ok_or_else(|| missing(place))).collect()
}

/// All that the search needs.
struct Question {
    model: Model,
    mode: String,
    start: Vec<f64>,
    sides: Vec<Interval>,
    step: f64,
    plane: (usize, usize),
    cells: u32,
    starts: u32,
    budget: usize,
    pixels: (usize, usize),
}

impl Question {
    fn answer(&self) -> Result<Found, Error> {
        let equations = &self.model.equations;
        let mode = Name::new(&self.mode).map_err(failed)?;
        if self.model.modes.len() == 1 && equations.surfaces().next().is_none() {
            let field = equations.field(mode).map_err(failed)?;
            // As exact as a run that Python starts.
            let steps = FlowSteps::new(field, (0.0, self.step), 1e-9).map_err(failed)?;
            return self.search(&steps);
        }
        let own: EquationsModel<DVector<f64>> = equations.model().map_err(failed)?;
        let run = |mode: Name, x: &[f64]| own.start_at(mode.as_str(), x.to_vec(), (0.0, self.step));
        let modes: Vec<Name> = self
            .model
            .modes
            .iter()
            .map(|name| Name::new(name))
            .collect::<Result<_, _>>()
            .map_err(failed)?;
        self.search(&ExecutionSteps::new(self.sides.len(), &modes, run))
    }

    /// The number of the mode in which the pixels start, if the model has several: their last coordinate.
    fn mode_number(&self) -> Option<f64> {
        let modes = &self.model.modes;
        let place = modes.iter().position(|mode| *mode == self.mode)?;
        (modes.len() > 1).then_some(place as f64)
    }

    fn search(&self, map: &dyn StateMap) -> Result<Found, Error> {
        let mut sides = self.sides.clone();
        if self.mode_number().is_some() {
            // Each mode is a whole number within.
            sides.push(Interval::new(-0.5, self.model.modes.len() as f64 - 0.5)?);
        }
        let grid = StateGrid::uniform(Hyperrectangle::new(sides)?, self.cells as usize)?;
        let limits = RecurrenceLimits { budget: self.budget, ..RecurrenceLimits::default() };
        let (x, y) = (self.sides[self.plane.0], self.sides[self.plane.1]);
        let of = |columns: usize, rows: usize| Grid { x, y, columns, rows };
        let place = |x: f64, y: f64| {
            let mut state = self.start.clone();
            (state[self.plane.0], state[self.plane.1]) = (x, y);
            state.extend(self.mode_number());
            state
        };
        let coarse = of(self.starts as usize, self.starts as usize);
        let starts: Vec<Vec<f64>> = (0..coarse.columns)
            .flat_map(|column| (0..coarse.rows).map(move |row| (column, row)))
            .map(|(column, row)| place(coarse.x_at(column), coarse.y_at(row)))
            .collect();
        let attractors = Attractors::search(map, grid, &starts, limits)?;
        let pixels = of(self.pixels.0, self.pixels.1);
        let image =
            attractors.raster(map, pixels, |x, y, state| state.copy_from_slice(&place(x, y)))?;
        Ok(Found { attractors, image })
    }
}

/// The fates of the pixels.
fn shares(image: &LabelImage) -> Table {
    let mut counts: BTreeMap<Label, u64> = BTreeMap::new();
    image.labels.iter().for_each(|label| *counts.entry(*label).or_default() += 1);
    let all = image.labels.len() as f64;
    let mut found = Table::new(&BASINS);
    for (label, pixels) in counts {
        let fraction = pixels as f64 / all;
        found.push([
            u64::from(label.code()).into(),
            label.to_string().into(),
            pixels.into(),
            Cell::measured(fraction, f64::EPSILON * fraction),
        ]);
    }
    found
}
