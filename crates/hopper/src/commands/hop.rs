//! `hopper hop`: single hops with all that the library knows about them.

use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::values;
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use passive_hopper::{Landing, LiftOffMap, MassRatio, Solver, contact_time};

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Lift-off speeds α, in units of m₂gω/k
    #[arg(value_name = "SPEED", required = true, num_args = 1.., value_parser = values::speed, allow_negative_numbers = true)]
    speeds: Vec<f64>,
    /// The mass ratio M = m₂/m₁, lower mass over upper mass
    #[arg(short = 'M', long, value_name = "M", value_parser = values::mass_ratio, allow_hyphen_values = true)]
    mass_ratio: MassRatio,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds in m₂gω/k, times in 1/ω, lengths in m₂g/k, energies in m₁m₂g²/k; ω² = k(1+M)/m₂.",
    limits: "Speeds up to 8796093022208 = 2⁴³; mass ratios from 2⁻¹⁰²² to 2¹⁰²².\n\
             A hop whose decisions 1024 bits leave open is reported as undecided, with exit status 1.",
    tables: &[&HOPS, &LANDINGS],
    examples: &[
        Example { about: "One hop, with its landings.", line: "hopper hop 7.0 --mass-ratio 0.2" },
        Example {
            about: "The landings of two hops for a program.",
            line: "hopper hop 4.4 7.0 -M 0.2 --csv --table landings",
        },
    ],
};

const SPEED: &str = "m₂gω/k";
const TIME: &str = "1/ω";

static HOPS: TableKind = TableKind {
    name: "hops",
    about: "one row for each speed",
    long: false,
    columns: &[
        Column { name: "speed", unit: SPEED, meaning: "lift-off speed α" },
        Column { name: "outcome", unit: "", meaning: "`lifts off` again, or `grounded`" },
        Column { name: "next_speed", unit: SPEED, meaning: "next lift-off speed α′ = f(α; M)" },
        Column { name: "next_error", unit: SPEED, meaning: "bound on the error of α′" },
        Column { name: "speed_loss", unit: SPEED, meaning: "α − α′, without cancellation" },
        Column {
            name: "energy_loss", unit: "m₁m₂g²/k", meaning: "energy that the landings take"
        },
        Column {
            name: "sudden_lift_offs",
            unit: "",
            meaning: "landings at which the spring pulls the lower mass off at once",
        },
        Column { name: "flight_time", unit: TIME, meaning: "time in flight" },
        Column {
            name: "contact_time",
            unit: TIME,
            meaning: "time on the ground from the last landing to the next lift-off",
        },
        Column { name: "slope", unit: "", meaning: "∂α′/∂α" },
        Column { name: "mass_ratio_slope", unit: SPEED, meaning: "∂α′/∂M" },
        Column {
            name: "solver",
            unit: "",
            meaning: "arithmetic in which every decision is larger than its error",
        },
    ],
};

static LANDINGS: TableKind = TableKind {
    name: "landings",
    about: "one row for each landing",
    long: false,
    columns: &[
        Column { name: "speed", unit: SPEED, meaning: "lift-off speed α of the hop" },
        Column { name: "landing", unit: "", meaning: "number of the landing in its hop, from 1" },
        Column { name: "time", unit: TIME, meaning: "time of the flight before it" },
        Column {
            name: "closing_speed",
            unit: SPEED,
            meaning: "Γ = −(1+M) ẏ₂ before the collision",
        },
        Column {
            name: "stretch_excess",
            unit: "m₂g/k",
            meaning: "y₁ − 1; a sudden lift-off follows if it is positive",
        },
        Column {
            name: "excess_error",
            unit: "m₂g/k",
            meaning: "bound on its error, if the hop has a sudden lift-off",
        },
        Column {
            name: "upper_velocity",
            unit: SPEED,
            meaning: "ẏ₁, which the collision does not change",
        },
        Column {
            name: "energy_loss", unit: "m₁m₂g²/k", meaning: "energy that the landing takes"
        },
        Column { name: "sudden", unit: "", meaning: "whether a sudden lift-off follows" },
    ],
};

/// Runs the command.
pub(crate) fn run(options: &Options, streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let map = LiftOffMap::new(options.mass_ratio);
    let (mut hops, mut landings) = (Table::new(&HOPS), Table::new(&LANDINGS));
    for &speed in &options.speeds {
        let bounded = map.bounded_hop(speed)?;
        let (hop, slopes) = (bounded.hop, map.slopes(speed)?);
        let last = bounded.landings.last().map(|last| last.landing);
        let time = |last: Landing| contact_time(options.mass_ratio, last.excess, last.velocity);
        // A grounded hopper is in contact for ever.
        let contact = last.filter(|_| hop.next.is_some()).map(time).transpose()?.flatten();
        hops.push([
            speed.into(),
            if hop.next.is_some() { "lifts off" } else { "grounded" }.into(),
            hop.next.into(),
            bounded.next_error.into(),
            hop.loss.into(),
            hop.energy_loss(options.mass_ratio).into(),
            hop.sudden.into(),
            hop.flight_time.into(),
            contact.into(),
            slopes.map(|slopes| slopes.by_speed).into(),
            slopes.map(|slopes| slopes.by_mass_ratio).into(),
            solver(bounded.solver),
        ]);
        for (at, bounded) in (1u64..).zip(&bounded.landings) {
            let landing = bounded.landing;
            landings.push([
                speed.into(),
                at.into(),
                landing.time.into(),
                landing.closing_speed.into(),
                landing.excess.into(),
                bounded.state_error.map(|error| error.excess).into(),
                landing.velocity.into(),
                landing.energy_loss(options.mass_ratio).into(),
                landing.sudden.into(),
            ]);
        }
    }
    form.print(&[hops, landings], streams.output)
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
