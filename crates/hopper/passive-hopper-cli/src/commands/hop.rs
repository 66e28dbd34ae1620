//! `hopper hop`: single hops with all that the library knows about them.

use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::input::{Filter, InputOptions, MASS_RATIO, NUMBER, Starts};
use crate::options::line_form::LineForm;
use crate::options::values;
use crate::output::{Cell, Column, Form, Table, TableKind, after};
use crate::streams::Streams;
use passive_hopper::{
    Enclosed, EnclosedHop, EnclosedLanding, Landing, LiftOffMap, Solver, contact_time,
};

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
    units: "Speeds in m₂gω/k, times in 1/ω, lengths in m₂g/k, energies in m₁m₂g²/k; ω² = k(1+M)/m₂.",
    limits: "Speeds up to 8796093022208 = 2⁴³; mass ratios from 2⁻¹⁰²² to 2¹⁰²².\n\
             A hop whose decisions 1024 bits leave open is undecided: an error with exit status 1; of the input a row \
             that says so.",
    is_filter: true,
    tables: &[&HOPS, &LANDINGS],
    examples: &[
        Example { about: "One hop, with its landings.", line: "hopper hop 7.0 --mass-ratio 0.2" },
        Example {
            about: "The landings of two hops for a program.",
            line: "hopper hop 4.4 7.0 -M 0.2 --csv --table landings",
        },
        Example {
            about: "A filter: M and α a line in, a row a line out.",
            line: "printf '0.2 7\\n0.3 7\\n' | hopper hop --pairs --csv",
        },
    ],
};

const SPEED: &str = "m₂gω/k";
const TIME: &str = "1/ω";

static HOPS: TableKind =
    TableKind { name: "hops", about: "one row for each speed", long: false, columns: &HOP_COLUMNS };

static HOPS_OF_PAIRS: TableKind =
    TableKind { columns: &after::<12, 13>(MASS_RATIO, HOP_COLUMNS), ..HOPS };

const HOP_COLUMNS: [Column; 12] = [
    Column::new("speed", SPEED, "lift-off speed α"),
    Column::new("outcome", "", "`lifts off` again, `grounded`, or `undecided`"),
    Column::new("next_speed", SPEED, "next lift-off speed α′ = f(α; M)").with_error("next_error"),
    Column::new("next_error", SPEED, "bound on the error of α′").error(),
    Column::new("speed_loss", SPEED, "α − α′, without cancellation").measured(),
    Column::new("energy_loss", "m₁m₂g²/k", "energy that the landings take").measured(),
    Column::new(
        "sudden_lift_offs",
        "",
        "landings at which the spring pulls the lower mass off at once",
    ),
    Column::new("flight_time", TIME, "time in flight").measured(),
    Column::new(
        "contact_time",
        TIME,
        "time on the ground from the last landing to the next lift-off",
    )
    .measured(),
    Column::new("slope", "", "∂α′/∂α").measured(),
    Column::new("mass_ratio_slope", SPEED, "∂α′/∂M").measured(),
    Column::new("solver", "", "arithmetic in which every decision is larger than its error"),
];

static LANDINGS: TableKind = TableKind {
    name: "landings",
    about: "one row for each landing",
    long: false,
    columns: &LANDING_COLUMNS,
};

static LANDINGS_OF_PAIRS: TableKind =
    TableKind { columns: &after::<9, 10>(MASS_RATIO, LANDING_COLUMNS), ..LANDINGS };

const LANDING_COLUMNS: [Column; 9] = [
    Column::new("speed", SPEED, "lift-off speed α of the hop"),
    Column::new("landing", "", "number of the landing in its hop, from 1"),
    Column::new("time", TIME, "time of the flight before it").measured(),
    Column::new("closing_speed", SPEED, "Γ = −(1+M) ẏ₂ before the collision").measured(),
    Column::new("stretch_excess", "m₂g/k", "y₁ − 1; a sudden lift-off follows if it is positive")
        .with_error("excess_error"),
    Column::new("excess_error", "m₂g/k", "bound on its error").error(),
    Column::new("upper_velocity", SPEED, "ẏ₁, which the collision does not change").measured(),
    Column::new("energy_loss", "m₁m₂g²/k", "energy that the landing takes").measured(),
    Column::new("sudden", "", "whether a sudden lift-off follows"),
];

/// Runs the command.
pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let (mass_ratio, speeds) = match options.input.starts(&options.speeds)? {
        Starts::Given(mass_ratio, speeds) => (mass_ratio, speeds),
        Starts::Input(lines) => return filter(form, &lines, options, &mut streams),
    };
    let map = LiftOffMap::new(mass_ratio);
    let (mut hops, mut landings) = (Table::new(&HOPS), Table::new(&LANDINGS));
    for speed in speeds {
        let (hop, own_landings) = rows(&map, speed)?;
        hops.push(hop);
        landings.rows.extend(own_landings.into_iter().map(Vec::from));
    }
    form.print(&[hops, landings], streams.output)
}

/// The hops of the starts on standard input, or their landings.
fn filter(
    form: Form,
    lines: &LineForm,
    options: &Options,
    streams: &mut Streams<'_>,
) -> Result<(), Error> {
    let Options { input, output, .. } = options;
    let shows_hops = form.is_first(&HOPS);
    let (kinds, widths) = match shows_hops {
        true => ([&HOPS, &HOPS_OF_PAIRS], &HOP_WIDTHS[..]),
        false => ([&LANDINGS, &LANDINGS_OF_PAIRS], &LANDING_WIDTHS[..]),
    };
    Filter { input, output, form, lines, kinds, widths, largest_part: 1 << 10 }.run(
        streams,
        |starts, filtered| {
            for start in starts {
                match rows(&LiftOffMap::new(start.mass_ratio), start.speed) {
                    Ok((hop, _)) if shows_hops => filtered.push(start, &hop),
                    Ok((_, landings)) => {
                        landings.iter().for_each(|landing| filtered.push(start, landing));
                    }
                    Err(passive_hopper::Error::Undecided { .. }) => {
                        filtered.count_undecided();
                        if shows_hops {
                            filtered.push(start, &undecided(start.speed));
                        }
                    }
                    Err(error) => return Err(error.into()),
                }
            }
            Ok(())
        },
    )
}

const HOP_WIDTHS: [usize; 12] =
    [NUMBER, 9, NUMBER, 8, NUMBER, NUMBER, 0, NUMBER, NUMBER, NUMBER, NUMBER, 0];
const LANDING_WIDTHS: [usize; 9] = [NUMBER, 0, NUMBER, NUMBER, NUMBER, 8, NUMBER, NUMBER, 0];

/// The row of a hop that no arithmetic decides.
fn undecided(speed: f64) -> [Cell; 12] {
    let mut row = [const { Cell::Missing }; 12];
    (row[0], row[1]) = (speed.into(), "undecided".into());
    row
}

/// The rows of a hop and of its landings.
fn rows(
    map: &LiftOffMap,
    speed: f64,
) -> Result<([Cell; 12], Vec<[Cell; 9]>), passive_hopper::Error> {
    let mass_ratio = map.mass_ratio();
    let bounded = map.bounded_hop(speed)?;
    let (hop, slopes) = (bounded.hop, map.slopes(speed)?);
    let last = bounded.landings.last().map(|last| last.landing);
    let time = |last: Landing| contact_time(mass_ratio, last.excess, last.velocity);
    // A grounded hopper is in contact for ever.
    let contact = last.filter(|_| hop.next.is_some()).map(time).transpose()?.flatten();
    // A hop of hundreds of flights has no enclosure; its errors are then not known.
    let known = map.enclosed_hop(speed, 0.0).ok();
    let of = |field: fn(&EnclosedHop) -> Option<Enclosed>| known.as_ref().and_then(field);
    let next = Cell::of(hop.next, of(|hop| hop.next)).or_bound(bounded.next_error);
    let row = [
        speed.into(),
        if hop.next.is_some() { "lifts off" } else { "grounded" }.into(),
        next.clone(),
        next.error(),
        Cell::of(hop.loss, of(|hop| hop.loss)),
        Cell::of(hop.energy_loss(mass_ratio), of(|hop| Some(hop.energy_loss))),
        hop.sudden.into(),
        Cell::of(hop.flight_time, of(|hop| Some(hop.flight_time))),
        Cell::of(contact, of(|hop| hop.contact_time)),
        Cell::of(slopes.map(|slopes| slopes.by_speed), of(|hop| hop.by_speed)),
        Cell::of(slopes.map(|slopes| slopes.by_mass_ratio), of(|hop| hop.by_mass_ratio)),
        solver(bounded.solver),
    ];
    let landings = bounded.landings.iter().enumerate().map(|(at, bounded)| {
        let landing = bounded.landing;
        let known = known.as_ref().and_then(|hop| hop.landings.get(at));
        let of = |field: fn(&EnclosedLanding) -> Enclosed| known.map(field);
        let excess = Cell::of(landing.excess, of(|landing| landing.excess))
            .or_bound(bounded.state_error.map(|error| error.excess));
        let energy_loss = landing.energy_loss(mass_ratio);
        [
            speed.into(),
            (at + 1).into(),
            Cell::of(landing.time, of(|landing| landing.time)),
            Cell::of(landing.closing_speed, of(|landing| landing.closing_speed)),
            excess.clone(),
            excess.error(),
            Cell::of(landing.velocity, of(|landing| landing.velocity)),
            Cell::of(energy_loss, of(|landing| landing.energy_loss)),
            landing.sudden.into(),
        ]
    });
    Ok((row, landings.collect()))
}

/// The name of a way to compute a hop.
fn solver(solver: Solver) -> Cell {
    match solver {
        Solver::Kernel => "f64, kernel",
        Solver::General => "f64, root search",
        Solver::Bits106 => "106 bits",
        Solver::Bits256 => "256 bits",
        Solver::Bits512 => "512 bits",
        Solver::Bits1024 => "1024 bits",
    }
    .into()
}
