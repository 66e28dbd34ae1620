//! `hopper units`: kilograms, metres and seconds to the dimensionless model, and back.

use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::quantity::{self, Kind, Quantity};
use crate::options::values;
use crate::output::{Cell, Column, Table, TableKind};
use crate::streams::Streams;
use passive_hopper::PhysicalHopper;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Speeds, lengths, times and energies to make dimensionless, such as 1.2m/s 3cm 0.5s 2mJ
    #[arg(value_name = "QUANTITY", value_parser = quantity::any, allow_negative_numbers = true)]
    quantities: Vec<Quantity>,
    /// m₁, the upper mass, such as 80g
    #[arg(long, value_name = "MASS", value_parser = quantity::mass, allow_hyphen_values = true)]
    upper: f64,
    /// m₂, the lower mass, such as 16g
    #[arg(long, value_name = "MASS", value_parser = quantity::mass, allow_hyphen_values = true)]
    lower: f64,
    /// k, the stiffness of the spring, such as 120N/m
    #[arg(long, value_name = "STIFFNESS", value_parser = quantity::stiffness, allow_hyphen_values = true)]
    stiffness: f64,
    /// g, the acceleration of gravity; the default is the standard one
    #[arg(long, value_name = "ACCELERATION", value_parser = quantity::acceleration, default_value = "9.80665m/s²", allow_hyphen_values = true)]
    gravity: f64,
    /// Dimensionless lift-off speeds α to give in metres per second
    #[arg(long, value_name = "SPEED", num_args = 1.., value_parser = values::speed, allow_negative_numbers = true)]
    alpha: Vec<f64>,
    #[command(flatten)]
    pub(crate) output: OutputOptions,
}

/// The help beside the options.
pub(crate) const PAGE: Page = Page {
    units: "Masses in kg, g, mg, t; stiffness in N/m, mN/m, kN/m, N/cm, N/mm, kg/s²; acceleration in m/s², cm/s², \
            N/kg;\n\
            lengths in m, km, cm, mm, µm; times in s, ms, µs; speeds in m/s, cm/s, mm/s, km/s, km/h; energies in J, \
            mJ, µJ, kJ.\n\
            A unit follows its number, with or without a space: 80g, '80 g'. s2 and s^2 are the same as s², u as µ.",
    limits: "Masses, stiffness and gravity are positive. The mass ratio M = m₂/m₁ is from 2⁻¹⁰²² to 2¹⁰²², and the \
             units that \
             result are ordinary numbers of f64.",
    is_filter: false,
    tables: &[&UNITS, &VALUES],
    examples: &[
        Example {
            about: "A small hopper: what its unit of speed is, and which α a lift-off at 2.1 m/s has.",
            line: "hopper units --upper 80g --lower 16g --stiffness 120N/m 2.1m/s",
        },
        Example {
            about: "The lift-off speed of a lossless hop, α*₁ = 4.4934, in metres per second.",
            line: "hopper units --upper 80g --lower 16g --stiffness 120N/m --alpha 4.493409457909064",
        },
    ],
};

static UNITS: TableKind = TableKind {
    name: "units",
    about: "the hopper and its units",
    long: false,
    columns: &[
        Column::new("mass_ratio", "", "M = m₂/m₁, for -M").measured(),
        Column::new("length_unit", "m", "m₂g/k: the stretch of the spring under the lower mass")
            .measured(),
        Column::new("time_unit", "s", "1/ω").measured(),
        Column::new("speed_unit", "m/s", "m₂gω/k: a lift-off speed in m/s over this is α")
            .measured(),
        Column::new("energy_unit", "J", "m₁m₂g²/k").measured(),
        Column::new("angular_frequency", "1/s", "ω = √(k(1+M)/m₂), of the spring in flight")
            .measured(),
        Column::new("upper_mass", "kg", "m₁").measured(),
        Column::new("lower_mass", "kg", "m₂").measured(),
        Column::new("stiffness", "N/m", "k").measured(),
        Column::new("gravity", "m/s²", "g").measured(),
    ],
};

static VALUES: TableKind = TableKind {
    name: "values",
    about: "one row for each QUANTITY and each --alpha",
    long: false,
    columns: &[
        Column::new("given", "", "as it was given"),
        Column::new("value", "", "in kilograms, metres and seconds").measured(),
        Column::new("unit", "", "the unit of `value`"),
        Column::new(
            "dimensionless",
            "",
            "in the units of the model; for a speed at lift-off it is α",
        )
        .measured(),
        Column::new("model_unit", "", "the unit of `dimensionless`"),
    ],
};

/// Runs the command.
pub(crate) fn run(options: &Options, streams: Streams<'_>) -> Result<(), Error> {
    let form = options.output.form(PAGE.tables)?;
    let &Options { upper, lower, stiffness, gravity, .. } = options;
    let hopper = PhysicalHopper::new(upper, lower, stiffness, gravity).map_err(|error| {
        Error::Misuse(format!(
            "--upper, --lower, --stiffness, --gravity: {error}; give other sizes"
        ))
    })?;
    let mut units = Table::new(&UNITS);
    let errors = PhysicalHopper::unit_errors(quantity::RELATIVE_ERROR);
    let of = |value: f64, relative: f64| Cell::measured(value, relative * value.abs());
    let given = |value: f64| of(value, quantity::RELATIVE_ERROR);
    units.push([
        of(hopper.mass_ratio()?.value(), errors.mass_ratio),
        of(hopper.length_unit(), errors.length),
        of(hopper.time_unit(), errors.time),
        of(hopper.speed_unit(), errors.speed),
        of(hopper.energy_unit(), errors.energy),
        of(hopper.angular_frequency(), errors.angular_frequency),
        given(upper),
        given(lower),
        given(stiffness),
        given(gravity),
    ]);
    let mut values = Table::new(&VALUES);
    for Quantity { kind, value, text } in &options.quantities {
        let (own, error, name) = match kind {
            Kind::Length => (hopper.length_unit(), errors.length, "m₂g/k"),
            Kind::Time => (hopper.time_unit(), errors.time, "1/ω"),
            Kind::Speed => (hopper.speed_unit(), errors.speed, "m₂gω/k"),
            Kind::Energy => (hopper.energy_unit(), errors.energy, "m₁m₂g²/k"),
            Kind::Mass | Kind::Stiffness | Kind::Acceleration => {
                let reason = "masses, stiffness and gravity have options; give a speed, a length, a time or an energy";
                return Err(Error::misuse("QUANTITY", text, reason));
            }
        };
        let (value, unit) = (*value, kind.unit());
        // The quantity, the unit, and the quotient.
        let relative = quantity::RELATIVE_ERROR + error + f64::EPSILON;
        values.push([
            text.clone().into(),
            given(value),
            unit.into(),
            of(value / own, relative),
            name.into(),
        ]);
    }
    for &alpha in &options.alpha {
        let speed = of(alpha * hopper.speed_unit(), errors.speed + f64::EPSILON);
        let text = format!("α = {}", crate::output::number(alpha));
        let dimensionless = Cell::measured(alpha, 0.0);
        values.push([text.into(), speed, "m/s".into(), dimensionless, "m₂gω/k".into()]);
    }
    let tables = if values.rows.is_empty() { vec![units] } else { vec![units, values] };
    form.print(&tables, streams.output)
}
