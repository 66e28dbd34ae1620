//! `hopper fate`: the fates of lift-off speeds, from the arguments or line by line from the input.

use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::{lines, values};
use crate::output::{Cell, Column, Form, Rows, Table, TableKind};
use crate::refusal::one_line;
use crate::streams::Streams;
use basin_of_attraction::UndecidedReason;
use hopper_basin::{Fates, HOP_BUDGET, HopperFate};
use passive_hopper::MassRatio;
use std::sync::atomic::{AtomicU64, Ordering};

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Lift-off speeds α, in units of m₂gω/k. Without any, or with - alone, they are read from standard input, one
    /// a line
    #[arg(value_name = "SPEED", num_args = 0.., value_parser = values::speed_or_input, allow_negative_numbers = true)]
    speeds: Vec<values::SpeedOrInput>,
    /// The mass ratio M = m₂/m₁, lower mass over upper mass
    #[arg(short = 'M', long, value_name = "M", value_parser = values::mass_ratio, allow_hyphen_values = true)]
    mass_ratio: MassRatio,
    /// Pass over lines of the input that are no speed; a note says how many, and the first one
    #[arg(long)]
    skip_invalid: bool,
    /// Exit with status 1 if a fate is undecided
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds in m₂gω/k.",
    limits: "Speeds up to 8796093022208 = 2⁴³; mass ratios from 2⁻¹⁰²² to 2¹⁰²².\n\
             An orbit is followed for 1000000 hops; slow hops beside a fixed point are jumped over and cost one each.\n\
             From M = 10⁵ on a speed may take a tenth of a second, and seconds at 10⁹: its hops lose little, and have \
             hundreds of landings.\n\
             Of the input, empty lines, lines that begin with # and a byte order mark are passed over. A line with \
             anything but one speed ends\n\
             the call with status 2 and the number of the line; the fates of the lines before it have been written. With \
             --skip-invalid it is passed over.",
    tables: &[&FATES],
    examples: &[
        Example { about: "Two fates.", line: "hopper fate 7.0 4.55 -M 0.2" },
        Example {
            about: "A filter: a speed a line in, a row a line out.",
            line: "printf '4.55\\n4.60\\n' | hopper fate -M 0.2 --csv",
        },
    ],
};

const SPEED: &str = "m₂gω/k";

pub(crate) static FATES: TableKind = TableKind {
    name: "fates",
    about: "one row for each speed",
    long: false,
    columns: &[
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
    ],
};

/// The widths of the columns in plain text when rows come one by one: a number has up to 24 characters, and most
/// have 18.
const WIDTHS: [usize; 7] = [18, 9, 3, 17, 18, 5, 0];

/// Runs the command.
pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let fates = Fates::new(options.mass_ratio)?;
    if values::from_input("SPEED", &options.speeds)? {
        return filter(&fates, options, form, &mut streams);
    }
    let speeds: Vec<f64> = values::speeds(&options.speeds).collect();
    let mut table = Table::new(&FATES);
    for (&speed, found) in speeds.iter().zip(fates.fates_within(&speeds, HOP_BUDGET)?) {
        table.push(row(&fates, speed, found)?);
    }
    let undecided = table.rows.iter().filter(|row| row[1] == UNDECIDED.into()).count();
    form.print(&[table], streams.output)?;
    options.judged(undecided as u64)
}

const UNDECIDED: &str = "undecided";

impl Options {
    /// An error if fates are undecided, and that is one.
    fn judged(&self, undecided: u64) -> Result<(), Error> {
        match self.strict && undecided > 0 {
            true => Err(Error::Undecided { count: undecided }),
            false => Ok(()),
        }
    }
}

/// The fates of the speeds on standard input.
fn filter(
    fates: &Fates,
    options: &Options,
    form: Form,
    streams: &mut Streams<'_>,
) -> Result<(), Error> {
    let (rows, start) = form.rows(&FATES, &WIDTHS);
    streams.output.write_all(start.as_bytes()).map_err(Error::output)?;
    let undecided = AtomicU64::new(0);
    let part =
        |values: &[f64], first: bool| part(fates, rows.continued(!first), values, &undecided);
    let skipped = lines::filter(streams, options.skip_invalid, values::speed, part)?;
    streams.output.write_all(rows.end().as_bytes()).map_err(Error::output)?;
    if let Some((line, text, reason)) = skipped.first {
        let count = skipped.count;
        let note =
            format!("{count} lines were passed over; the first is line {line}, '{text}': {reason}");
        options.output.note(streams, one_line(&note));
    }
    options.judged(undecided.into_inner())
}

/// The rows of some speeds, as text.
fn part(
    fates: &Fates,
    mut rows: Rows,
    speeds: &[f64],
    undecided: &AtomicU64,
) -> Result<String, Error> {
    // A row of CSV has about 64 bytes.
    let mut text = String::with_capacity(64 * speeds.len());
    for (&speed, found) in speeds.iter().zip(fates.fates_within(speeds, HOP_BUDGET)?) {
        if matches!(found.0, HopperFate::Undecided(_)) {
            undecided.fetch_add(1, Ordering::Relaxed);
        }
        rows.append(&row(fates, speed, found)?, &mut text);
    }
    Ok(text)
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
