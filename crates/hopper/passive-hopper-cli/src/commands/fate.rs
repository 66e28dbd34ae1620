//! `hopper fate`: the fates of lift-off speeds, from the arguments or line by line from the input.

use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::input::{Filter, InputOptions, MASS_RATIO, NUMBER, Starts, by_mass_ratio};
use crate::options::line_form::LineForm;
use crate::options::lines::PART;
use crate::options::values;
use crate::output::{Cell, Column, Table, TableKind, after};
use crate::streams::Streams;
use basin_of_attraction::UndecidedReason;
use hopper_basin::{Fates, HOP_BUDGET, HopperFate};

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Lift-off speeds α, in units of m₂gω/k. Without any, or with - alone, they are read from standard input, one
    /// a line
    #[arg(value_name = "SPEED", num_args = 0.., value_parser = values::speed_or_input, allow_negative_numbers = true)]
    speeds: Vec<values::SpeedOrInput>,
    #[command(flatten)]
    input: InputOptions,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds in m₂gω/k.",
    limits: "Speeds up to 8796093022208 = 2⁴³; mass ratios from 2⁻¹⁰²² to 2¹⁰²².\n\
             An orbit is followed for 1000000 hops; slow hops beside a fixed point are jumped over and cost one each.\n\
             From M = 10⁵ on a speed may take a tenth of a second, and seconds at 10⁹: its hops lose little, and have \
             hundreds of landings.",
    is_filter: true,
    tables: &[&FATES],
    examples: &[
        Example { about: "Two fates.", line: "hopper fate 7.0 4.55 -M 0.2" },
        Example {
            about: "A filter: a speed a line in, a row a line out.",
            line: "printf '4.55\\n4.60\\n' | hopper fate -M 0.2 --csv",
        },
        Example {
            about: "Mass ratios and speeds of a table.",
            line: "printf 'run,M,alpha\\na,0.2,4.55\\nb,0.3,7\\n' | hopper fate --columns M,alpha --csv",
        },
    ],
};

const SPEED: &str = "m₂gω/k";

pub(crate) static FATES: TableKind =
    TableKind { name: "fates", about: "one row for each speed", long: false, columns: &COLUMNS };

static FATES_OF_PAIRS: TableKind =
    TableKind { columns: &after::<7, 8>(MASS_RATIO, COLUMNS), ..FATES };

const COLUMNS: [Column; 7] = [
    Column::new("speed", SPEED, "lift-off speed α"),
    Column::new(
        "fate",
        "",
        "incessant: hops for ever, to a lossless hop; decaying: hops for ever, ever lower; grounded; undecided",
    ),
    Column::new(
        "n",
        "",
        "index of the fixed point α*ₙ that the speeds converge to; 0 for decaying",
    ),
    Column::new("trap_left", SPEED, "the trap that the orbit enters, from α*ₙ …").measured(),
    Column::new("trap_right", SPEED, "… to α*ₙ + Δₙ(M)").measured(),
    Column::new("hops", "", "hops until the orbit is in the trap or grounded"),
    Column::new("reason", "", "why a fate is undecided"),
];

/// The widths of the columns in plain text when rows come one by one.
const WIDTHS: [usize; 7] = [NUMBER, 9, 3, NUMBER, NUMBER, 5, 0];

/// Runs the command.
pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let (mass_ratio, speeds) = match options.input.starts(&options.speeds)? {
        Starts::Given(mass_ratio, speeds) => (mass_ratio, speeds),
        Starts::Input(lines) => {
            return filter(&lines, &options.input, &options.output, &mut streams);
        }
    };
    let fates = Fates::new(mass_ratio)?;
    let mut table = Table::new(&FATES);
    for (&speed, found) in speeds.iter().zip(fates.fates_within(&speeds, HOP_BUDGET)?) {
        table.push(row(&fates, speed, found)?);
    }
    let undecided = table.rows.iter().filter(|row| row[1] == UNDECIDED.into()).count();
    form.print(&[table], streams.output)?;
    options.input.judged(undecided as u64)
}

const UNDECIDED: &str = "undecided";

/// The fates of the starts on standard input.
pub(crate) fn filter(
    lines: &LineForm,
    input: &InputOptions,
    output: &OutputOptions,
    streams: &mut Streams<'_>,
) -> Result<(), Error> {
    // The shares of a speed's mass ratio are made once.
    let shared = match lines.mass_ratio() {
        Some(mass_ratio) => Some(Fates::new(mass_ratio)?),
        None => None,
    };
    let form = output.form(&[&FATES])?;
    let kinds = [&FATES, &FATES_OF_PAIRS];
    Filter { input, output, form, lines, kinds, widths: &WIDTHS, largest_part: PART }.run(
        streams,
        |starts, rows| {
            for starts in by_mass_ratio(starts) {
                let own;
                let fates = match &shared {
                    Some(fates) => fates,
                    None => {
                        own = Fates::new(starts[0].mass_ratio)?;
                        &own
                    }
                };
                let speeds: Vec<f64> = starts.iter().map(|start| start.speed).collect();
                for (start, found) in starts.iter().zip(fates.fates_within(&speeds, HOP_BUDGET)?) {
                    if matches!(found.0, HopperFate::Undecided(_)) {
                        rows.count_undecided();
                    }
                    rows.push(start, &row(fates, start.speed, found)?);
                }
            }
            Ok(())
        },
    )
}

/// The fate of a speed, with the number of hops, as a row of [`FATES`].
pub(crate) fn row(
    fates: &Fates,
    speed: f64,
    (fate, hops): (HopperFate, usize),
) -> Result<[Cell; 7], Error> {
    let (name, n, reason) = match fate {
        HopperFate::Incessant { n } => ("incessant", Some(n), None),
        HopperFate::Decaying => ("decaying", Some(0), None),
        HopperFate::Grounded => ("grounded", None, None),
        HopperFate::Undecided(reason) => (UNDECIDED, None, Some(why(reason))),
    };
    let trap = n.map(|n| fates.trap(n)).transpose()?;
    Ok([
        speed.into(),
        name.into(),
        n.into(),
        trap.map(|trap| Cell::measured(trap.fixed_point.value(), trap.fixed_point.error())).into(),
        trap.map(|trap| Cell::measured(trap.right(), trap.right_error())).into(),
        hops.into(),
        reason.into(),
    ])
}

/// A reason in words.
fn why(reason: UndecidedReason) -> &'static str {
    match reason {
        UndecidedReason::Budget => "the budget of hops is used up",
        UndecidedReason::Precision { .. } => "1024 bits do not decide the orbit",
        UndecidedReason::Map { .. } => "1024 bits do not decide the first hop",
    }
}
