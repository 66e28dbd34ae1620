//! `hopper map`: the curve of the map, its fixed points, traps and crises.

use crate::commands::orbit::drawing;
use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::output_file::{self, OutputFile};
use crate::options::values;
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use hopper_basin::{Crisis, Trap, TrapEdge, crisis, grounding};
use hopper_figures::{Graph, MapPlot, cuts_between};
use passive_hopper::{LiftOffMap, MassRatio, alpha_star, index_below};

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// The mass ratio M = m₂/m₁, lower mass over upper mass
    #[arg(short = 'M', long, value_name = "M", value_parser = values::mass_ratio, allow_hyphen_values = true)]
    mass_ratio: MassRatio,
    /// The window of lift-off speeds, in units of m₂gω/k [default: from 0 to the sixth fixed point, 20.37]
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], value_parser = values::speed_or_zero, allow_hyphen_values = true)]
    speed: Option<Vec<f64>>,
    /// Points on each piece of the curve
    #[arg(long, value_name = "COUNT", default_value_t = 120, value_parser = values::whole(2..=100_000), allow_hyphen_values = true)]
    points: u64,
    /// Draw the map: FILE.svg or FILE.png, or - for SVG on standard output
    #[arg(long, value_name = "FILE", value_parser = output_file::figure)]
    figure: Option<OutputFile>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// The fixed point at the end of the default window.
const LAST: u64 = 6;

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Speeds in m₂gω/k.",
    limits: "Windows of up to 200 humps; speeds up to 8796093022208 = 2⁴³; mass ratios from 2⁻¹⁰²² to 2¹⁰²².\n\
             The curve is cut at nπ and at the fixed points α*ₙ. Where the hopper is grounded there is no curve; a gap \
             narrower \
             than a 64th of a piece may be missed. A figure shows where a hop is not decided. It takes seconds from M \
             = 10⁶ on, and up to a \
             minute from 10⁷ on; the table `curve` has all digits, and takes minutes from 10⁵ on.",
    is_filter: false,
    tables: &[&FIXED_POINTS, &CURVE],
    examples: &[
        Example { about: "Fixed points, traps and crises.", line: "hopper map -M 0.2" },
        Example {
            about: "The curve on the first hump as data.",
            line: "hopper map -M 0.2 --speed 4.4934 7.7253 --csv --table curve",
        },
        Example { about: "The curve as a figure.", line: "hopper map -M 0.2 --figure map.svg" },
    ],
};

const SPEED: &str = "m₂gω/k";

static FIXED_POINTS: TableKind = TableKind {
    name: "fixed_points",
    about: "one row for each fixed point in the window",
    long: false,
    columns: &[
        Column::new("n", "", "its index"),
        Column::new(
            "speed",
            SPEED,
            "α*ₙ, the n-th root of tan α = α: a hop without loss, for every M",
        )
        .measured(),
        Column::new("trap_length", SPEED, "Δₙ(M): all orbits from [α*ₙ, α*ₙ + Δₙ] converge to α*ₙ")
            .with_error("trap_error"),
        Column::new("trap_error", SPEED, "bound on its error").error(),
        Column::new(
            "trap_end",
            "",
            "crossing: f falls to α*ₙ there; contact end: f stays above up to (n+1)π; next fixed point",
        ),
        Column::new("crisis", "", "M from which orbits of the hump fall below α*ₙ, up to 1/M")
            .measured(),
        Column::new("grounding", "", "M from which speeds of the hump are grounded, up to 1/M")
            .measured(),
    ],
};

static CURVE: TableKind = TableKind {
    name: "curve",
    about: "points of the map",
    long: true,
    columns: &[
        Column::new("piece", "", "number of the smooth piece, from 1"),
        Column::new("speed", SPEED, "lift-off speed α"),
        Column::new("next_speed", SPEED, "next lift-off speed α′ = f(α; M)").measured(),
    ],
};

/// Runs the command.
pub(crate) fn run(options: &Options, mut streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let window = match options.speed.as_deref() {
        Some(&[from, to]) => (from, to),
        _ => (0.0, alpha_star(LAST)),
    };
    let cuts = cuts_between(window.0, window.1).map_err(|error| {
        Error::Misuse(format!(
            "--speed {} {}: {error}",
            crate::output::number(window.0),
            crate::output::number(window.1)
        ))
    })?;
    let to_stdout = output_file::check(&[("--figure", options.figure.as_ref())])?;
    let map = LiftOffMap::new(options.mass_ratio);
    if let Some(file) = &options.figure {
        let plot = MapPlot { map: &map, window, orbit: &[], grounded: false };
        file.write(&drawing("map", file.format, &plot.draw()?)?, &options.output, &mut streams)?;
    }
    if to_stdout {
        return Ok(());
    }
    let mut curve = Table::new(&CURVE);
    if form.shows(&CURVE, PAGE.tables) {
        let count = usize::try_from(options.points).unwrap_or(usize::MAX);
        let graph = Graph::exact(&map, &cuts, count);
        for (at, piece) in (1u64..).zip(graph.pieces) {
            for (speed, next) in piece {
                let error = map.bounded_hop(speed)?.next_error.unwrap_or(f64::INFINITY);
                curve.push([at.into(), speed.into(), Cell::measured(next, error)]);
            }
        }
        if let Some(&first) = graph.undecided.first() {
            let (count, first) = (graph.undecided.len(), crate::output::number(first));
            let text = format!(
                "1024 bits do not decide the hop from {count} speeds, such as {first}; they are left out"
            );
            options.output.note(&mut streams, text);
        }
    }
    form.print(&[fixed_points(&map, window)?, curve], streams.output)
}

fn fixed_points(map: &LiftOffMap, window: (f64, f64)) -> Result<Table, Error> {
    let mut table = Table::new(&FIXED_POINTS);
    let (first, last) = (index_below(window.0)?, index_below(window.1)?);
    for n in (first..=last).filter(|&n| (window.0..=window.1).contains(&alpha_star(n))) {
        let trap = Trap::new(n, map.mass_ratio())?;
        let end = match trap.edge {
            TrapEdge::Crossing => "crossing",
            TrapEdge::ContactEnd => "contact end",
            TrapEdge::NextFixedPoint => "next fixed point",
        };
        // Hump 0 has no crisis.
        let touch = |touch: Crisis| Cell::measured(touch.mass_ratio, touch.error);
        let crisis = if n == 0 { None } else { Some(touch(crisis(n)?)) };
        let cells: [Cell; 7] = [
            n.into(),
            Cell::measured(trap.fixed_point.value(), trap.fixed_point.error()),
            Cell::measured(trap.delta, trap.error),
            Cell::Error(trap.error),
            end.into(),
            crisis.into(),
            touch(grounding(n)?),
        ];
        table.push(cells);
    }
    Ok(table)
}
