//! `nonsmooth prove`: a periodic orbit that exists, with a certificate.

use crate::commands::search;
use crate::error::Error;
use crate::model::file::Model;
use crate::model::question::{ModelOptions, Named, failed, named, names_of, point};
use crate::model::section_map::{MapOptions, MapWords};
use crate::options::form::OutputOptions;
use crate::output::{Column, Table, TableKind};
use crate::streams::Streams;
use resumable_job::{AtomicFile, write_atomically};
use std::path::PathBuf;
use validated_dynamics::{
    Certificate, Enclosure, ProvedFixedPoint, Trap, ValidatedSystem, fixed_point,
};

/// Prove that a return map has a periodic orbit near a point, with its multipliers and a part of its basin
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    map: MapOptions,
    /// The fixed point, roughly: the coordinates of the section, such as y=-8.4,z=0.03
    #[arg(long, num_args = 1.., value_name = "NAME=VALUE", value_parser = named, required = true)]
    near: Vec<Named>,
    /// Boxes with which a trap is looked for about an orbit that attracts: all its points converge to the orbit
    #[arg(long, default_value_t = 1000, value_name = "N")]
    boxes: usize,
    /// A certificate, which a second program confirms
    #[arg(long)]
    certificate: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

static PROVED: TableKind = TableKind {
    name: "proved",
    about: "what is proved: each row is an interval that holds the exact number",
    long: false,
    columns: &[
        Column::new(
            "quantity",
            "",
            "a coordinate of the one fixed point, the time of an event on the way, or a multiplier",
        ),
        Column::new("lower", "", "lower bound").bound(),
        Column::new("upper", "", "upper bound").bound(),
    ],
};

static ORBIT: TableKind = TableKind {
    name: "orbit",
    about: "the orbit",
    long: false,
    columns: &[
        Column::new("kind", "", "attracting, a saddle, repelling, or not decided"),
        Column::new("trap", "", "all starts nearer to it than this, along each coordinate, converge to it; empty without a trap").bound(),
    ],
};

pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let model = options.model.model()?;
    let near = options.near.concat();
    let names = names_of(&near);
    let guess = point(&model, &names, &near, "--near")?;
    let words = options.map.words(&model, (&names, &guess))?;
    if let Some(file) = &options.certificate {
        drop(AtomicFile::create(file)?);
    }
    let form = options.output.form(&[&PROVED, &ORBIT])?;
    let own = options.clone();
    let found = search::run(&options.output, &mut streams, move || {
        let system = ValidatedSystem::new(&model.equations).map_err(failed)?;
        let map = words.map(&system, own.certificate.is_some())?;
        let orbit = fixed_point(&map, &guess, &[]).map_err(failed)?;
        let middle: Vec<f64> = orbit.point.iter().map(middle_of).collect();
        let half: Vec<f64> = middle.iter().map(|x| BESIDE * (1.0 + x.abs())).collect();
        words.check_closing(&model, &system, (&middle, &half))?;
        let trap = orbit.is_attracting().then(|| Trap::new(&map, &orbit, own.boxes).ok()).flatten();
        words.check_mode(&model, &orbit.point)?;
        let reach = trap.as_ref().map(|trap| reach(trap, (&words, &model))).transpose()?.flatten();
        let mut text = None;
        if own.certificate.is_some() {
            let mut certificate = Certificate::new("nonsmooth");
            certificate.fixed_point(&map, &orbit).map_err(failed)?;
            if let Some(trap) = &trap {
                certificate.trap(&map, trap).map_err(failed)?;
            }
            text = Some(certificate.text());
        }
        Ok((orbit, reach, text))
    })?;
    let (orbit, reach, text) = found;
    if let (Some(file), Some(text)) = (&options.certificate, text) {
        write_atomically(file, text.as_bytes())?;
        options.output.note(&mut streams, format_args!("wrote {}", file.display()));
    }
    form.print(&[proved(&names, &orbit), kind(&orbit, reach)], streams.output)
}

/// How far beside the orbit it is looked whether the map goes on as the flow does, as a part of its size: far enough that
/// states differ by more than the widths of enclosures.
const BESIDE: f64 = 1e-3;

pub(crate) fn middle_of(x: &Enclosure) -> f64 {
    x.low().midpoint(x.high())
}

fn proved(names: &[String], orbit: &ProvedFixedPoint) -> Table {
    let mut found = Table::new(&PROVED);
    for (name, x) in names.iter().zip(&orbit.point) {
        found.push([name.clone().into(), x.low().into(), x.high().into()]);
    }
    for event in &orbit.image.events {
        let time = event.time;
        found.push([
            format!("time of {}", event.surface).into(),
            time.low().into(),
            time.high().into(),
        ]);
    }
    for (at, own) in orbit.multipliers.iter().enumerate() {
        let around = |x: f64| ((x - own.radius).next_down(), (x + own.radius).next_up());
        let (real, imaginary) = (around(own.real), around(own.imaginary));
        let name = format!("multiplier {}", at + 1);
        found.push([name.clone().into(), real.0.into(), real.1.into()]);
        if own.imaginary != 0.0 {
            let name = format!("{name}, imaginary part");
            found.push([name.into(), imaginary.0.into(), imaginary.1.into()]);
        }
    }
    found
}

fn kind(orbit: &ProvedFixedPoint, reach: Option<f64>) -> Table {
    let word = match (orbit.is_attracting(), orbit.is_saddle()) {
        (true, _) => "attracting",
        (_, true) => "a saddle",
        _ => "repelling, or not decided",
    };
    let mut found = Table::new(&ORBIT);
    found.push([word.into(), reach.into()]);
    found
}

/// Halvings until a cube is in a trap: some are enough unless its directions are nearly one.
const HALVINGS: usize = 60;

/// Half of the side of a cube about the trap's centre that is in the trap, and of which all points are starts in the mode of the map, for certain.
///
/// # Errors
/// As [`MapWords::are_in_mode`].
pub(crate) fn reach(
    trap: &Trap,
    (words, model): (&MapWords, &Model),
) -> Result<Option<f64>, Error> {
    let cube = |half: f64| {
        let side = |x: &f64| Enclosure::new((x - half).next_down(), (x + half).next_up());
        trap.centre().iter().map(side).collect::<Vec<Enclosure>>()
    };
    // Directions have the length 1, so that no cube is much larger than the trap.
    for half in (0..HALVINGS).map(|k| trap.size() * 0.5f64.powi(k as i32)) {
        let cube = cube(half);
        if trap.contains(&cube) && words.are_in_mode(model, &cube)? {
            return Ok(Some(half));
        }
    }
    Ok(None)
}
