//! `nonsmooth basin`: attractors, and the basins of a window.

use crate::commands::orbit::drawing;
use crate::commands::search;
use crate::error::Error;
use crate::model::basin_store::BasinStore;
use crate::model::columns::table;
use crate::model::file::Model;
use crate::model::period::check_period;
use crate::model::places::Places;
use crate::model::question::{
    ModelOptions, Named, StartOptions, failed, named, named_mode, numbers, place_of,
};
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
use std::ops::Range;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Find the attractors of a window of states, and the basin of each of its points
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    start: StartOptions,
    /// The window of each state, such as x=-2:2,v=-2:2. The picture has the first two; the others have their value of the start there
    #[arg(long, num_args = 1.., value_name = "NAME=FROM:TO", value_parser = named, required = true)]
    window: Vec<Named>,
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
    /// Orbits with which each attractor is tested, of 3000 steps: fewer are sooner, and miss an opening smaller than 3/N of its surroundings
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(50..=1_000_000))]
    tests: u32,
    /// Pixels across and up
    #[arg(long, num_args = 2, default_values_t = [200, 200], value_parser = clap::value_parser!(u32).range(1..=8192))]
    pixels: Vec<u32>,
    /// The picture: .svg or .png
    #[arg(long, value_parser = figure)]
    figure: Option<OutputFile>,
    /// A folder for the labels, basin.npy: the same call goes on there after it was stopped or killed
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
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
    let states = model.equations.names().states.clone();
    let window = options.window.concat();
    let sides = sides(&model, &window)?;
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
    let names = states.iter().map(|name| (name.clone(), "a point of it"));
    let mode_column = [Column::new("mode", "", "its mode")];
    let after = if model.modes.len() > 1 { &mode_column[..] } else { &[] };
    let attractors =
        table(("attractors", "one row for each attractor that was found"), &before, names, after);
    let form = options.output.form(&[&BASINS, attractors])?;
    let taken = check(&[("--figure", options.figure.as_ref())])?;
    let axes = [&window[0].0, &window[1].0];
    let [x, y] = axes.map(|name| place_of(&states, name, "--window"));
    let (modes, plane) = (model.modes.clone(), (x?, y?));
    let mut question = Question {
        store: None,
        mode: named_mode(options.start.mode.as_deref(), &model)?,
        start: options.start.state(&model)?,
        model,
        sides,
        step,
        plane,
        cells: options.cells,
        starts: options.starts,
        limits: RecurrenceLimits {
            budget: options.budget,
            tests: options.tests as usize,
            ..RecurrenceLimits::default()
        },
        pixels: (options.pixels[0] as usize, options.pixels[1] as usize),
    };
    question.check_modes()?;
    if let Some(folder) = &options.out {
        let store = BasinStore::open(folder, &question.words()?, question.pixels)?;
        question.store = Some(store);
    }
    let pixels = ("pixels", question.pixels.0 * question.pixels.1);
    let found = search::run_counted(&options.output, &mut streams, pixels, move |count| {
        question.answer(count)
    })?;
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
        let point = own.points.first().map_or(&[][..], Vec::as_slice);
        row.extend(point.iter().take(states.len()).map(|x| Cell::from(*x)));
        // Behind the states of a model with several modes is the number of the mode.
        let mode = point.get(states.len()).and_then(|number| modes.get(number.round() as usize));
        row.extend(mode.map(|mode| Cell::from(mode.clone())));
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
    /// The mode in which all begin; without it each begins in the one in which its state is.
    mode: Option<String>,
    start: Vec<f64>,
    sides: Vec<Interval>,
    step: f64,
    plane: (usize, usize),
    cells: u32,
    starts: u32,
    limits: RecurrenceLimits,
    pixels: (usize, usize),
    /// Where the labels are kept.
    store: Option<BasinStore>,
}

impl Question {
    /// Refuses a window with starts in no mode.
    fn check_modes(&self) -> Result<(), Error> {
        let grid = self.grid(self.pixels);
        let places = Places::new(&self.model)?;
        let wanted = self.mode.is_none() && places.are_given();
        let count = if wanted { grid.columns * grid.rows } else { 0 };
        for pixel in 0..count {
            let (x, y) = (grid.x_at(pixel % grid.columns), grid.y_at(pixel / grid.columns));
            places.of(&self.state_at(x, y))?;
        }
        Ok(())
    }

    /// The attractors and the picture; counts the pixels that have begun.
    fn answer(&self, count: &AtomicUsize) -> Result<Found, Error> {
        let equations = &self.model.equations;
        if self.model.modes.len() == 1 && equations.surfaces().next().is_none() {
            let mode = Name::new(&self.model.modes[0]).map_err(failed)?;
            let field = equations.field(mode).map_err(failed)?;
            // As exact as a run that Python starts.
            let steps = FlowSteps::new(field, (0.0, self.step), 1e-9).map_err(failed)?;
            return self.search(&steps, count);
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
        self.search(&ExecutionSteps::new(self.sides.len(), &modes, run), count)
    }

    /// All that the labels depend on.
    fn words(&self) -> Result<String, Error> {
        let Question { mode, start, sides, step, plane, cells, starts, limits, .. } = self;
        let hash = self.model.equations.content_hash().map_err(failed)?;
        let places = &self.model.places;
        Ok(format!(
            "model {hash}; where {places:?}; mode {mode:?}; start {start:?}; window {sides:?}; step {step:?}; plane {plane:?}; \
             cells {cells}; starts {starts}; {limits:?}"
        ))
    }

    fn grid(&self, (columns, rows): (usize, usize)) -> Grid {
        Grid { x: self.sides[self.plane.0], y: self.sides[self.plane.1], columns, rows }
    }

    /// The state of a start.
    fn state_at(&self, x: f64, y: f64) -> Vec<f64> {
        let mut state = self.start.clone();
        (state[self.plane.0], state[self.plane.1]) = (x, y);
        state
    }

    /// The start in the map's coordinates: of several modes the number of the mode is the last one.
    fn start_at(&self, places: &Places<'_>, x: f64, y: f64) -> Vec<f64> {
        let mut state = self.state_at(x, y);
        if self.model.modes.len() > 1 {
            let named = |mode: &String| self.model.modes.iter().position(|own| own == mode);
            let place = self.mode.as_ref().map_or_else(|| places.of(&state).ok(), named);
            // A start in no mode has no image.
            state.push(place.unwrap_or(self.model.modes.len()) as f64);
        }
        state
    }

    fn search(&self, map: &dyn StateMap, count: &AtomicUsize) -> Result<Found, Error> {
        let mut sides = self.sides.clone();
        if self.model.modes.len() > 1 {
            // Each mode is a whole number within.
            sides.push(Interval::new(-0.5, self.model.modes.len() as f64 - 0.5)?);
        }
        let grid = StateGrid::uniform(Hyperrectangle::new(sides)?, self.cells as usize)?;
        let places = Places::new(&self.model)?;
        let coarse = self.grid((self.starts as usize, self.starts as usize));
        let starts: Vec<Vec<f64>> = (0..coarse.columns)
            .flat_map(|column| (0..coarse.rows).map(move |row| (column, row)))
            .map(|(column, row)| self.start_at(&places, coarse.x_at(column), coarse.y_at(row)))
            .collect();
        let attractors = Attractors::search(map, grid, &starts, self.limits)?;
        let grid = self.grid(self.pixels);
        let labels_of = |rows: Range<usize>| {
            let first = rows.start * grid.columns;
            let begin = |k: usize, state: &mut [f64]| {
                count.fetch_add(1, Ordering::Relaxed);
                let pixel = first + k;
                let (x, y) = (grid.x_at(pixel % grid.columns), grid.y_at(pixel / grid.columns));
                state.copy_from_slice(&self.start_at(&places, x, y));
            };
            let ends = attractors.convergences(map, rows.len() * grid.columns, begin)?;
            Ok(ends.into_iter().map(|(label, _)| label).collect::<Vec<Label>>())
        };
        let found = |pixels| {
            count.fetch_add(pixels, Ordering::Relaxed);
        };
        let labels = match &self.store {
            Some(store) => store.labels(found, labels_of)?,
            None => labels_of(0..grid.rows)?,
        };
        Ok(Found { attractors, image: LabelImage { grid, labels } })
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
