//! `nonsmooth prove-basin`: which starts of a window come to which orbit, cell by cell as a theorem.

use crate::commands::orbit::drawing;
use crate::commands::search;
use crate::error::Error;
use crate::model::basin::window_of;
use crate::model::prove::{middle_of, reach};
use crate::model::question::{ModelOptions, Named, failed, named, names_of, point};
use crate::model::section_map::MapOptions;
use crate::options::form::OutputOptions;
use crate::options::output_file::{OutputFile, check, figure};
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use basin_of_attraction::{AxisNames, Grid, Interval, Label, LabelImage, UndecidedReason};
use resumable_job::{AtomicFile, write_atomically};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use validated_dynamics::{
    Certificate, Division, Enclosure, ProvedBasins, ProvedFate, Trap, ValidatedSystem, fixed_point,
};

/// Prove which starts of a window converge to which orbit of a return map, cell by cell
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    map: MapOptions,
    /// A fixed point that attracts, roughly, such as x=1,v=0; once for each
    #[arg(long, value_name = "NAME=VALUE,…", required = true, value_parser = named)]
    near: Vec<Named>,
    /// The window of each coordinate of the section, such as x=-2:2,v=-2:2
    #[arg(long, num_args = 1.., value_name = "NAME=FROM:TO", value_parser = named, required = true)]
    window: Vec<Named>,
    /// Halvings of the window's sides to the largest and to the smallest cells
    #[arg(long, num_args = 2, value_names = ["FIRST", "LAST"], default_values_t = [5, 8], value_parser = clap::value_parser!(u32).range(1..=30))]
    halvings: Vec<u32>,
    /// The most images of cells that are computed
    #[arg(long, value_name = "N", default_value_t = 20_000)]
    images: usize,
    /// Boxes with which each trap is looked for
    #[arg(long, default_value_t = 1000, value_name = "N")]
    boxes: usize,
    /// The picture of a window of two coordinates: .svg or .png. White is not decided
    #[arg(long, value_parser = figure)]
    figure: Option<OutputFile>,
    /// A certificate, which a second program confirms: some kilobytes a cell
    #[arg(long)]
    certificate: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

static FATES: TableKind = TableKind {
    name: "fates",
    about: "one row for each fate; what is in no row is not decided",
    long: false,
    columns: &[
        Column::new(
            "fate",
            "",
            "the orbit to which the starts converge, or the surface at which they end",
        ),
        Column::new("share", "", "at least this part of the window's volume has it").bound(),
        Column::new(
            "trap",
            "",
            "all starts nearer to it than this, along each coordinate, converge to it",
        )
        .bound(),
    ],
};

/// What is proved.
struct Found {
    basins: ProvedBasins,
    /// For each trap half of the side of a cube of starts in it.
    reaches: Vec<Option<f64>>,
    certificate: Option<String>,
}

/// Pixels of the picture along each side.
const PIXELS: usize = 512;

pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let model = options.model.model()?;
    let window = options.window.concat();
    let names = names_of(&window);
    let sides = window_of(&model, &names, &window)?;
    let guesses = options
        .near
        .iter()
        .map(|near| point(&model, &names, near, "--near"))
        .collect::<Result<Vec<_>, Error>>()?;
    let words = options.map.words(&model, (&names, &guesses[0]))?;
    let form = options.output.form(&[&FATES])?;
    let taken = check(&[("--figure", options.figure.as_ref())])?;
    if options.figure.is_some() && names.len() != 2 {
        return Err(Error::Misuse(format!(
            "--figure: the window has {} coordinates, and a picture shows two; leave it out",
            names.len()
        )));
    }
    let [first, last] = [options.halvings[0], options.halvings[1]];
    if first > last {
        let reason = "the largest cells come first; give two numbers that do not fall, such as 5 8";
        return Err(Error::misuse("--halvings", format!("{first} {last}"), reason));
    }
    // 2 to the 600th is no number of cells either.
    let cells = 2f64.powi(i32::try_from(names.len() as u64 * u64::from(first)).unwrap_or(i32::MAX));
    if cells > options.images as f64 {
        let reason = format!(
            "the first {cells} cells have an image each; give as many at least, or fewer halvings"
        );
        return Err(Error::misuse("--images", options.images, &reason));
    }
    let window: Vec<Enclosure> =
        sides.iter().map(|side| Enclosure::new(side.left, side.right)).collect();
    words.check_mode(&model, &window)?;
    if let Some(file) = &options.certificate {
        drop(AtomicFile::create(file)?);
    }
    let own = options.clone();
    let images = ("images", options.images);
    let found = search::run_counted(&options.output, &mut streams, images, move |count| {
        let system = ValidatedSystem::new(&model.equations).map_err(failed)?;
        let map = words.map(&system, own.certificate.is_some())?;
        let mut certificate = Certificate::new("nonsmooth");
        let middle: Vec<f64> = window.iter().map(middle_of).collect();
        let half: Vec<f64> = window.iter().map(|x| 0.5 * (x.high() - x.low())).collect();
        words.check_closing(&model, &system, (&middle, &half))?;
        let (mut traps, mut numbers): (Vec<Trap>, Vec<_>) = (Vec::new(), Vec::new());
        let mut reaches = Vec::new();
        for guess in &guesses {
            let orbit = fixed_point(&map, guess, &[]).map_err(failed)?;
            if !orbit.is_attracting() {
                let text = format!(
                    "--near: the fixed point at {} does not attract, or that is not proved, and only one that does has a \
                     trap; give another one",
                    shown(&words.variables, orbit.point.iter().map(middle_of))
                );
                return Err(Error::Model(text));
            }
            // Its orbits beside the window may end in another way.
            let point: Vec<f64> = orbit.point.iter().map(middle_of).collect();
            words.check_closing(&model, &system, (&point, &vec![0.0; point.len()]))?;
            if traps.iter().any(|trap| trap.contains(&orbit.point)) {
                let text = format!(
                    "--near: the orbit at {} is there twice; give each once",
                    shown(&words.variables, point.into_iter())
                );
                return Err(Error::Misuse(text));
            }
            let trap = Trap::new(&map, &orbit, own.boxes).map_err(failed)?;
            words.check_mode(&model, &orbit.point)?;
            reaches.push(reach(&trap, (&words, &model))?);
            if own.certificate.is_some() {
                numbers.push(certificate.trap(&map, &trap).map_err(failed)?);
            }
            traps.push(trap);
        }
        let division =
            Division { first: own.halvings[0], last: own.halvings[1], images: own.images };
        let basins = ProvedBasins::watched(&[&map], traps, &[&window], division, &mut |progress| {
            count.store(progress.images, Ordering::Relaxed);
            ControlFlow::Continue(())
        })
        .map_err(failed)?;
        let certificate = match own.certificate.is_some() {
            true => {
                certificate.basins(&map, &basins, &numbers).map_err(failed)?;
                Some(certificate.text())
            }
            false => None,
        };
        Ok(Found { basins, reaches, certificate })
    })?;
    if let Some(file) = &options.figure {
        let svg = picture(&found.basins, &sides, &names)?;
        file.write(&drawing("basins", file.format, &svg)?, &options.output, &mut streams)?;
    }
    if let (Some(file), Some(text)) = (&options.certificate, &found.certificate) {
        write_atomically(file, text.as_bytes())?;
        options.output.note(&mut streams, format_args!("wrote {}", file.display()));
    }
    if taken {
        return Ok(());
    }
    form.print(&[shares(&found, &names)], streams.output)
}

/// The fates that occur, in their order.
fn fates(basins: &ProvedBasins) -> Vec<ProvedFate> {
    let mut fates: Vec<ProvedFate> = (0..basins.traps().len()).map(ProvedFate::Trap).collect();
    for cell in basins.cells() {
        if !fates.contains(&cell.fate) {
            fates.push(cell.fate);
        }
    }
    fates
}

/// A point in words, to know it again.
fn shown(names: &[String], point: impl Iterator<Item = f64>) -> String {
    // No −0 is shown.
    let value = |x: f64| (1e6 * x).round() / 1e6 + 0.0;
    let texts: Vec<String> =
        names.iter().zip(point).map(|(name, x)| format!("{name} = {}", value(x))).collect();
    texts.join(", ")
}

fn shares(found: &Found, names: &[String]) -> Table {
    let basins = &found.basins;
    let mut table = Table::new(&FATES);
    for fate in fates(basins) {
        let (name, size) = match fate {
            ProvedFate::Trap(at) => {
                let trap = &basins.traps()[at];
                (format!("to {}", shown(names, trap.centre().iter().copied())), found.reaches[at])
            }
            ProvedFate::Stopped(surface) => (format!("ends at {surface}"), None),
        };
        let share = Cell::from(basins.share(fate));
        table.push([name.into(), share, size.into()]);
    }
    table
}

/// The fates of the middles of pixels.
fn picture(
    basins: &ProvedBasins,
    sides: &[Interval],
    names: &[String],
) -> Result<journal_figures::Svg, Error> {
    let fates = fates(basins);
    let number = |fate: ProvedFate| {
        let at = fates.iter().position(|own| *own == fate)?;
        Label::basin(u16::try_from(at + 1).ok()?)
    };
    let grid = Grid { x: sides[0], y: sides[1], columns: PIXELS, rows: PIXELS };
    let rest: Vec<f64> = sides.iter().map(|side| side.left.midpoint(side.right)).collect();
    let label = |at: usize| {
        let mut point = rest.clone();
        (point[0], point[1]) = (grid.x_at(at % PIXELS), grid.y_at(at / PIXELS));
        let open = Label::undecided(UndecidedReason::Budget);
        basins.fate(0, &point).and_then(number).unwrap_or(open)
    };
    let image = LabelImage { grid, labels: (0..PIXELS * PIXELS).map(label).collect() };
    let orbits: BTreeMap<Label, Vec<Vec<f64>>> = (0..basins.traps().len())
        .filter_map(|at| {
            Some((number(ProvedFate::Trap(at))?, vec![basins.traps()[at].centre().to_vec()]))
        })
        .collect();
    Ok(image.picture(&orbits, (0, 1), AxisNames { x: &names[0], y: &names[1] })?)
}
