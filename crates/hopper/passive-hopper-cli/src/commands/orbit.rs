//! `hopper orbit`: an orbit hop by hop until its fate, with pictures of it.

use crate::commands::fate;
use crate::commands::page::{Example, Page};
use crate::commands::search;
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::input::{Filter, InputOptions, MASS_RATIO, NUMBER, Starts, by_mass_ratio};
use crate::options::line_form::LineForm;
use crate::options::output_file::{self, Format, OutputFile};
use crate::options::values;
use crate::output::{Cell, Column, Form, Table, TableKind, after, motion_table};
use crate::streams::Streams;
use hopper_basin::{Fates, HOP_BUDGET, HopperFate};
use hopper_figures::{
    AnimationForm, MapPlot, Motion, animation, animation_frame, draw_motion, frame_times,
    motion_with_errors,
};
use journal_figures::{Svg, render};
use passive_hopper::{
    BoundedOrbit, Enclosed, EnclosedHop, ExtendedStep, FixedPointSpeed, LiftOffMap, index_below,
};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Lift-off speed α, in units of m₂gω/k. Without it, or with -, the speeds of many orbits are read from standard
    /// input, one a line
    #[arg(value_name = "SPEED", value_parser = values::speed_or_input, allow_negative_numbers = true)]
    speed: Option<values::SpeedOrInput>,
    #[command(flatten)]
    input: InputOptions,
    /// Follow this number of hops [default: until the fate is known, at most 1000]
    #[arg(long, value_name = "COUNT", value_parser = values::whole(0..=MOST_HOPS), allow_hyphen_values = true)]
    hops: Option<u64>,
    /// Draw the orbit as a cobweb on the map: FILE.svg or FILE.png, or - for SVG on standard output
    #[arg(long, value_name = "FILE", value_parser = output_file::figure)]
    cobweb: Option<OutputFile>,
    /// Write the motion of both masses: FILE.csv, or a figure FILE.svg or FILE.png, or - for CSV on standard output
    #[arg(long, value_name = "FILE", value_parser = output_file::motion)]
    motion: Option<OutputFile>,
    /// Animate the hopper: FILE.gif or FILE.apng, or - for GIF on standard output
    #[arg(long, value_name = "FILE", value_parser = output_file::animation)]
    animate: Option<OutputFile>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// The most hops of a call: their table has some 100 MB.
const MOST_HOPS: u64 = 1_000_000;

/// The most hops unless --hops is given: a table that a person can read.
const USUAL_HOPS: usize = 1000;

/// The fewest hops of a picture unless --hops is given. An orbit that begins in a trap has its fate after none.
const FEWEST_DRAWN: usize = 3;

/// The most hops whose time and energy have bounds on their errors: an enclosed hop takes 50 µs, so that these take
/// a second.
const MOST_ENCLOSED: usize = 20_000;

/// PNG pixels for each CSS pixel of a figure for print.
const PRINT_SCALE: f64 = 2.5;

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds in m₂gω/k, times in 1/ω, lengths in m₂g/k, energies in m₁m₂g²/k; ω² = k(1+M)/m₂.",
    limits: "Speeds up to 8796093022208 = 2⁴³; mass ratios from 2⁻¹⁰²² to 2¹⁰²²; up to 1000000 hops.\n\
             The first 20000 hops have errors of flight_time and energy_loss. A hop whose speed is a fixed point \
             within its error has \
             none: on both sides of it the time changes by the cube root of the error, some 1e-5.\n\
             The orbit ends early if the hopper is grounded, or at a hop that is not decided: f64 leaves some open, \
             and 106 to \
             1024 bits have time for the first 2048 to 64 hops. A note says so.\n\
             A picture of an orbit whose fate is known at once shows 3 hops. A cobweb shows up to 200 humps of the \
             map, a motion \
             has up to 1000000 samples, an animation up to 1200 frames, which is a minute.\n\
             The columns of --motion FILE.csv: time, hop, phase (flight or contact), upper_position y₁, upper_velocity \
             ẏ₁, \
             lower_position y₂, lower_velocity ẏ₂, and the errors of these numbers. At a landing there are two lines: \
             before the collision and \
             after it. A time that is not that of an event is exact, and the errors of the others hold at the time \
             that is printed.",
    is_filter: true,
    tables: &[&ORBIT, &fate::FATES],
    examples: &[
        Example { about: "The orbit, hop by hop.", line: "hopper orbit 7.0 -M 0.2" },
        Example {
            about: "Its cobweb, and the motion of both masses as a figure.",
            line: "hopper orbit 7.0 -M 0.2 --cobweb cobweb.png --motion motion.svg",
        },
        Example {
            about: "The orbits of many speeds, a filter.",
            line: "printf '4.55\\n7\\n' | hopper orbit -M 0.2 --csv",
        },
        Example {
            about: "The motion of two hops as data.",
            line: "hopper orbit 7.0 -M 0.2 --hops 2 --motion -",
        },
    ],
};

const SPEED: &str = "m₂gω/k";

static ORBIT: TableKind =
    TableKind { name: "orbit", about: "one row for each lift-off", long: false, columns: &COLUMNS };

/// The orbits of the input: each row says to which one it belongs.
static ORBITS: TableKind = TableKind { columns: &OF_MANY, ..ORBIT };
static ORBITS_OF_PAIRS: TableKind =
    TableKind { columns: &after::<9, 10>(MASS_RATIO, OF_MANY), ..ORBIT };
const OF_MANY: [Column; 9] =
    after(Column::new("start", SPEED, "lift-off speed at which the orbit starts"), COLUMNS);

const COLUMNS: [Column; 8] = [
    Column::new("hop", "", "hops before this lift-off"),
    Column::new("speed", SPEED, "lift-off speed α").with_error("error"),
    Column::new("error", SPEED, "bound on the distance of the exact orbit from it").error(),
    Column::new("n", "", "index of the fixed point α*ₙ at or below the speed"),
    Column::new("offset", SPEED, "α − α*ₙ").measured(),
    Column::new("sudden_lift_offs", "", "sudden lift-offs in the hop from here"),
    Column::new("flight_time", "1/ω", "time in flight in this hop").measured(),
    Column::new("energy_loss", "m₁m₂g²/k", "energy that its landings take").measured(),
];

/// Runs the command.
pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let to_stdout = output_file::check(&[
        ("--cobweb", options.cobweb.as_ref()),
        ("--motion", options.motion.as_ref()),
        ("--animate", options.animate.as_ref()),
    ])?;
    let given = options.hops.map(|hops| usize::try_from(hops).unwrap_or(usize::MAX));
    let (mass_ratio, speed) = match options.input.starts(options.speed.as_slice())? {
        Starts::Given(mass_ratio, speed) => (mass_ratio, speed.into_iter().sum()),
        Starts::Input(lines) => return filter(form, &lines, (options, given), &mut streams),
    };
    let fates = Fates::new(mass_ratio)?;
    let found = fates.fate_within(speed, HOP_BUDGET)?;
    let orbit = Orbit::follow(fates.map(), speed, given.unwrap_or(found.1.min(USUAL_HOPS)))?;
    // All pictures are made before the first file is written: a refusal leaves no file.
    let drawn = given.unwrap_or(orbit.hops().max(FEWEST_DRAWN));
    let mut files: Vec<(&OutputFile, Vec<u8>)> = Vec::new();
    if let Some(file) = &options.cobweb {
        let longer = Orbit::follow(fates.map(), speed, drawn)?;
        let plot = MapPlot {
            map: fates.map(),
            window: MapPlot::window_of(&longer.speeds, longer.grounded),
            orbit: &longer.speeds,
            grounded: longer.grounded,
        };
        let svg = plot.draw().map_err(|error| refused("--cobweb", error))?;
        files.push((file, drawing("cobweb", file.format, &svg)?));
    }
    // A grounded hopper has one hop more: the one that does not end.
    let hops = drawn.max(1) + usize::from(orbit.grounded);
    let motion = |option: &str| {
        let motion = Motion::new(mass_ratio, speed, hops);
        motion.map_err(|error| refused(&format!("{option}, --hops {hops}"), error))
    };
    if let Some(file) = &options.motion {
        let bytes = match file.format {
            Format::Csv => {
                let found = motion_with_errors(mass_ratio, speed, hops);
                let (motion, errors) =
                    found.map_err(|error| refused(&format!("--motion, --hops {hops}"), error))?;
                motion_table(&motion, &errors).into_bytes()
            }
            format => drawing("motion", format, &draw_motion(&motion("--motion")?))?,
        };
        files.push((file, bytes));
    }
    if let Some(file) = &options.animate {
        let motion = motion("--animate")?;
        let refused = |error| refused(&format!("--animate, --hops {hops}"), error);
        let times = frame_times(&motion).map_err(refused)?;
        let bytes = animated(motion, times, file.format, (options, &mut streams))?;
        files.push((file, bytes));
    }
    for (file, bytes) in files {
        file.write(&bytes, &options.output, &mut streams)?;
    }
    if !to_stdout {
        let mut fate = Table::new(&fate::FATES);
        fate.push(fate::row(&fates, speed, found)?);
        form.print(&[table(fates.map(), &orbit)?, fate], streams.output)?;
    }
    note_the_end(options, &orbit, found.1, &mut streams);
    let fate_is_open = matches!(found.0, HopperFate::Undecided(_));
    options.input.judged(u64::from(orbit.undecided || fate_is_open))
}

/// The orbits of the starts on standard input, or their fates.
fn filter(
    form: Form,
    lines: &LineForm,
    (options, given): (&Options, Option<usize>),
    streams: &mut Streams<'_>,
) -> Result<(), Error> {
    let Options { input, output, cobweb, motion, animate, .. } = options;
    if cobweb.is_some() || motion.is_some() || animate.is_some() {
        return Err(Error::Misuse(
            "SPEED: a picture shows one orbit, and no speed is given; give one, or leave the picture out".into(),
        ));
    }
    if !form.is_first(&ORBIT) {
        return fate::filter(lines, input, output, streams);
    }
    let kinds = [&ORBITS, &ORBITS_OF_PAIRS];
    let cut = AtomicUsize::new(0);
    let filter = Filter { input, output, form, lines, kinds, widths: &WIDTHS, largest_part: 1 };
    filter.run(streams, |starts, rows| {
        for starts in by_mass_ratio(starts) {
            let fates = Fates::new(starts[0].mass_ratio)?;
            for start in starts {
                let found = match given.is_none() || input.is_strict() {
                    true => Some(fates.fate_within(start.speed, HOP_BUDGET)?),
                    false => None,
                };
                let until_fate = found.map_or(0, |(_, hops)| hops);
                let hops = given.unwrap_or(until_fate.min(USUAL_HOPS));
                if given.is_none() && until_fate > USUAL_HOPS {
                    cut.fetch_add(1, Ordering::Relaxed);
                }
                let orbit = Orbit::follow(fates.map(), start.speed, hops)?;
                if orbit.undecided || matches!(found, Some((HopperFate::Undecided(_), _))) {
                    rows.count_undecided();
                }
                for row in table(fates.map(), &orbit)?.rows {
                    rows.push(start, &[&[start.speed.into()], &row[..]].concat());
                }
            }
        }
        Ok(())
    })?;
    let cut = cut.into_inner();
    if cut > 0 {
        let text = format!(
            "{cut} fates are known after more than {USUAL_HOPS} hops, of which {USUAL_HOPS} are shown; --hops shows more"
        );
        output.note(streams, text);
    }
    Ok(())
}

/// The widths of the columns of [`ORBITS`] in plain text.
const WIDTHS: [usize; 9] = [NUMBER, 4, NUMBER, 8, 3, NUMBER, 0, NUMBER, NUMBER];

/// Notes why the orbit ends where it ends.
fn note_the_end(options: &Options, orbit: &Orbit, hops: usize, streams: &mut Streams<'_>) {
    if options.hops.is_none() && hops > USUAL_HOPS {
        let text = format!(
            "the fate is known after {hops} hops; {USUAL_HOPS} are shown, --hops shows more"
        );
        options.output.note(streams, text);
    }
    if orbit.undecided {
        let hop = orbit.speeds.len();
        let text =
            format!("the bounds of errors do not decide hop {hop}; the orbit ends before it");
        options.output.note(streams, text);
    }
    options.output.explain(streams, format_args!("arithmetic: {}", orbit.arithmetic));
}

/// A picture that would be too large is a wrong call.
fn refused(option: &str, error: hopper_figures::Error) -> Error {
    match error {
        error @ (hopper_figures::Error::TooLong { .. }
        | hopper_figures::Error::TooWide { .. }
        | hopper_figures::Error::TooManyFrames { .. }) => {
            Error::Misuse(format!("{option}: {error}"))
        }
        error => error.into(),
    }
}

/// An orbit as it was followed.
struct Orbit {
    speeds: Vec<f64>,
    errors: Vec<f64>,
    grounded: bool,
    undecided: bool,
    arithmetic: String,
}

impl Orbit {
    fn follow(map: &LiftOffMap, speed: f64, hops: usize) -> Result<Self, Error> {
        // The hop after the last one is tried as well, to see whether the hopper is grounded there.
        let mut found = BoundedOrbit::follow(map, speed, hops.saturating_add(1))?;
        let undecided = found.end == ExtendedStep::Inconclusive && found.speeds.len() <= hops;
        found.speeds.truncate(hops.saturating_add(1));
        found.errors.truncate(hops.saturating_add(1));
        let arithmetic = match found.arithmetic {
            None => "f64".into(),
            Some(arithmetic) => format!("{arithmetic:?}"),
        };
        let grounded = found.end == ExtendedStep::Grounded;
        Ok(Orbit { speeds: found.speeds, errors: found.errors, grounded, undecided, arithmetic })
    }

    fn hops(&self) -> usize {
        self.speeds.len() - 1
    }
}

/// The table of an orbit.
fn table(map: &LiftOffMap, orbit: &Orbit) -> Result<Table, Error> {
    let mut table = Table::new(&ORBIT);
    let speeds: Vec<(f64, f64)> =
        orbit.speeds.iter().copied().zip(orbit.errors.iter().copied()).collect();
    let enclosed = &speeds[..speeds.len().min(MOST_ENCLOSED)];
    let known = enclosed.par_iter().map(|&(speed, error)| map.enclosed_hop(speed, error).ok());
    let known = known.collect::<Vec<_>>().into_iter().chain(std::iter::repeat(None));
    for (hop, (&(speed, error), known)) in speeds.iter().zip(known).enumerate() {
        let n = index_below(speed)?;
        let of = |field: fn(&EnclosedHop) -> Enclosed| known.as_ref().map(field);
        // The hop of the rounded speed may be one that 1024 bits do not decide.
        let details = map.hop(speed).ok();
        let energy_loss = details.map(|hop| hop.energy_loss(map.mass_ratio()));
        let (offset, rounding) = FixedPointSpeed::new(n).bounded_offset_of(speed);
        let cells: [Cell; 8] = [
            hop.into(),
            Cell::measured(speed, error),
            Cell::Error(error),
            n.into(),
            Cell::measured(offset, error + rounding),
            details.map(|hop| hop.sudden).into(),
            Cell::of(details.map(|hop| hop.flight_time), of(|hop| hop.flight_time)),
            Cell::of(energy_loss, of(|hop| hop.energy_loss)),
        ];
        table.push(cells);
    }
    Ok(table)
}

/// A drawing as the bytes of a file.
pub(crate) fn drawing(name: &str, format: Format, svg: &Svg) -> Result<Vec<u8>, Error> {
    drawing_of(name, format, svg, PRINT_SCALE)
}

/// The same, with so many pixels of PNG for each CSS pixel.
pub(crate) fn drawing_of(
    name: &str,
    format: Format,
    svg: &Svg,
    scale: f64,
) -> Result<Vec<u8>, Error> {
    let rendered = render(name, svg, scale)?;
    Ok(if format == Format::Svg { rendered.svg.into_bytes() } else { rendered.png })
}

/// The animation of a motion, whose frames all threads draw.
fn animated(
    motion: Motion,
    times: Vec<f64>,
    format: Format,
    (options, streams): (&Options, &mut Streams<'_>),
) -> Result<Vec<u8>, Error> {
    let form = if format == Format::Gif { AnimationForm::Gif } else { AnimationForm::Apng };
    let frames = ("frames", times.len());
    search::run_counted(&options.output, streams, frames, move |count| {
        let frame = |&time: &f64| {
            let frame = animation_frame(&motion, time, form)?;
            count.fetch_add(1, Ordering::Relaxed);
            Ok(frame)
        };
        let frames = times.par_iter().map(frame).collect::<Result<Vec<_>, Error>>()?;
        Ok(animation(&frames, form)?)
    })
}
