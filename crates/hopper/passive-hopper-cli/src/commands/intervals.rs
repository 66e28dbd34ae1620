//! `hopper intervals`: the basins at one mass ratio as exact intervals, and their fractions with bounds.

use crate::commands::page::{Example, Page};
use crate::commands::search;
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::values;
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use basin_of_attraction::{Label, Refinement, StopReason};
use hopper_basin::{BranchGround, Fates, HopperBasins, HopperFate};
use hopper_proof::basins_at_every_mass_ratio;
use passive_hopper::{FixedPointSpeed, MassRatio};

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// The mass ratio M = m₂/m₁, lower mass over upper mass
    #[arg(short = 'M', long, value_name = "M", value_parser = values::mass_ratio, allow_hyphen_values = true)]
    mass_ratio: MassRatio,
    /// Index of the fixed point at which the window begins; 0 is the speed 0
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::whole(0..=MOST_HUMPS - 1), allow_hyphen_values = true)]
    from: u64,
    /// Index of the fixed point at which the window ends
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = values::whole(1..=MOST_HUMPS), allow_hyphen_values = true)]
    to: u64,
    /// Stop when no more than this length is undecided, in units of m₂gω/k
    #[arg(long, value_name = "LENGTH", default_value = "1e-4", value_parser = values::not_negative, allow_hyphen_values = true)]
    undecided: f64,
    /// Do not follow intervals shorter than this, in units of m₂gω/k
    #[arg(long, value_name = "LENGTH", default_value = "1e-12", value_parser = values::not_negative, allow_hyphen_values = true)]
    shortest: f64,
    /// Stop at this number of intervals
    #[arg(long, value_name = "COUNT", default_value_t = 100_000, value_parser = values::whole(1..=10_000_000), allow_hyphen_values = true)]
    most: u64,
    /// Points in which each sudden window is searched for branches of the map
    #[arg(long, value_name = "COUNT", default_value_t = 200, value_parser = values::whole(2..=1_000_000), allow_hyphen_values = true)]
    samples: u64,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// The most humps of a window. The time grows with their number and with that of the branches of all of them.
const MOST_HUMPS: u64 = 64;

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds and lengths in m₂gω/k.",
    limits: "Fixed points 0 to 64; up to 10000000 intervals; samples up to 1000000 for each window.\n\
             For M up to 0.83 (of many humps) or 0.905 (of few) the branches of the map are followed, which are proved \
             to be all.\n\
             Above, images of intervals are enclosed with rounding outwards, and hops are not counted; --shortest and \
             --samples have no \
             effect. The larger M is, the more stays undecided; above 50 the sudden windows do. The table `search` \
             says which.\n\
             The time grows with --samples times --to: 64 windows of a million samples take minutes. How long it has \
             searched is \
             shown on a terminal, elsewhere every 30 s. Ctrl-C ends the call, and the same call begins anew.",
    is_filter: false,
    tables: &[&FRACTIONS, &SEARCH, &INTERVALS],
    examples: &[
        Example { about: "Fractions of the first five humps.", line: "hopper intervals -M 0.2" },
        Example {
            about: "The intervals of the first hump as data.",
            line: "hopper intervals -M 0.2 --to 2 --undecided 1e-3 --csv --table intervals",
        },
    ],
};

const SPEED: &str = "m₂gω/k";

static FRACTIONS: TableKind = TableKind {
    name: "fractions",
    about: "one row for each fate",
    long: false,
    columns: &[
        Column::new("fate", "", "incessant: to α*ₙ; decaying: ever lower; grounded"),
        Column::new("n", "", "index of the fixed point; 0 for decaying"),
        Column::new(
            "fraction_lower",
            "",
            "the fraction of the window with this fate is at least this …",
        )
        .bound(),
        Column::new("fraction_upper", "", "… and at most this, which has all that is undecided")
            .bound(),
        Column::new("length_lower", SPEED, "the same as a length …").bound(),
        Column::new("length_upper", SPEED, "… from and to").bound(),
        Column::new("intervals", "", "number of intervals found"),
    ],
};

static SEARCH: TableKind = TableKind {
    name: "search",
    about: "one row: the window, and what the intervals stand on",
    long: false,
    columns: &[
        Column::new("from", SPEED, "lower end of the window").measured(),
        Column::new("to", SPEED, "upper end of the window").measured(),
        Column::new("undecided", SPEED, "length of the window that is in no interval").measured(),
        Column::new("stopped", "", "why the search ended"),
        Column::new(
            "ground",
            "",
            "what the labels stand on: branches of the map that are proved to be all, or enclosed images",
        ),
        Column::new("probes", "", "random speeds whose fate was compared with their interval"),
        Column::new("wrong_probes", "", "those with another fate"),
    ],
};

static INTERVALS: TableKind = TableKind {
    name: "intervals",
    about: "one row for each interval, from left to right; all its speeds have one fate",
    long: true,
    columns: &[
        Column::new("left", SPEED, "lower end").bound(),
        Column::new("right", SPEED, "upper end").bound(),
        Column::new("fate", "", "incessant, decaying or grounded"),
        Column::new("n", "", "index of the fixed point; 0 for decaying"),
        Column::new("hops", "", "hops until its orbits are in the trap, or grounded"),
    ],
};

/// Runs the command.
pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let &Options { from, to, undecided, shortest, .. } = options;
    if from >= to {
        let reason = format!(
            "the window ends at --to {to}, which must be larger than --from; give a smaller --from"
        );
        return Err(Error::misuse("--from", from, &reason));
    }
    let count = |number: u64| usize::try_from(number).unwrap_or(usize::MAX);
    let refinement =
        Refinement { undecided, shortest, intervals: count(options.most), ..Refinement::default() };
    let (mass_ratio, samples) = (options.mass_ratio, count(options.samples));
    let found = search::run(&options.output, &mut streams, move || {
        let fates = Fates::new(mass_ratio)?;
        Ok(basins_at_every_mass_ratio(&fates, from, to, samples, refinement)?)
    })?;
    let mut intervals = Table::new(&INTERVALS);
    if form.shows(&INTERVALS, PAGE.tables) {
        for part in found.basins.intervals() {
            let (fate, n) = fate(part.label);
            let (left, right) = (part.interval.left, part.interval.right);
            intervals.push([left.into(), right.into(), fate.into(), n, part.level.into()]);
        }
    }
    form.print(&[fractions(&found), search(&found, (from, to)), intervals], streams.output)
}

fn fractions(found: &HopperBasins) -> Table {
    let mut table = Table::new(&FRACTIONS);
    let window = found.basins.window().length();
    for label in found.basins.labels() {
        let length = found.basins.basin_length(label);
        let (fate, n) = fate(label);
        let own = found.basins.intervals().iter().filter(|part| part.label == label);
        table.push([
            fate.into(),
            n,
            (length.lower / window).into(),
            (length.upper / window).into(),
            length.lower.into(),
            length.upper.into(),
            own.count().into(),
        ]);
    }
    table
}

fn search(found: &HopperBasins, (from, to): (u64, u64)) -> Table {
    let mut table = Table::new(&SEARCH);
    let window = found.basins.window();
    let ground = match found.ground {
        BranchGround::Proved => "branches",
        BranchGround::ContactParts => "contact parts",
        BranchGround::Enclosures => "enclosures",
    };
    table.push([
        Cell::measured(window.left, FixedPointSpeed::new(from).error()),
        Cell::measured(window.right, FixedPointSpeed::new(to).error()),
        Cell::measured(found.basins.undecided(), found.basins.rounding()),
        stopped(found.basins.stop_reason()).into(),
        ground.into(),
        found.probes.compared.into(),
        found.probes.wrong.into(),
    ]);
    table
}

/// The fate of a label, and the index of its fixed point.
fn fate(label: Label) -> (&'static str, Cell) {
    if label == HopperFate::GROUNDED {
        return ("grounded", Cell::Missing);
    }
    match label.basin_number() {
        Some(0) => ("decaying", 0u64.into()),
        Some(n) => ("incessant", u64::from(n).into()),
        None => ("undecided", Cell::Missing),
    }
}

/// A reason in words.
fn stopped(reason: StopReason) -> &'static str {
    match reason {
        StopReason::Resolved => "no more than --undecided is left",
        StopReason::AllFollowed => {
            "every interval is followed; the rest is in none, or a branch is missing"
        }
        StopReason::SampledBranches => {
            "no more than --undecided is left, but the branches are sampled"
        }
        StopReason::Contradiction => "contradiction: a branch is missing; please report this",
        StopReason::ShortestInterval => "the others are shorter than --shortest",
        StopReason::LevelLimit => "the largest level is reached",
        StopReason::IntervalLimit => "--most intervals are found, or as many speeds are tried",
    }
}
