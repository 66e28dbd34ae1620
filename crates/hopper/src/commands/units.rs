//! `hopper units`: kilograms, metres and seconds to the dimensionless model, and back.

use crate::commands::page::{Example, Page};
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::quantity::{self, Kind, Quantity};
use crate::options::values;
use crate::output::{Column, Table, TableKind};
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
    units: "Masses in kg, g, mg, t; stiffness in N/m, mN/m, kN/m, N/cm, N/mm, kg/s²; acceleration in m/s², cm/s², N/kg;\n\
            lengths in m, km, cm, mm, µm; times in s, ms, µs; speeds in m/s, cm/s, mm/s, km/s, km/h; energies in J, mJ, µJ, kJ.\n\
            A unit follows its number, with or without a space: 80g, '80 g'. s2 and s^2 are the same as s², u as µ.",
    limits: "Masses, stiffness and gravity are positive. The mass ratio M = m₂/m₁ is from 2⁻¹⁰²² to 2¹⁰²², and the units that\n\
             result are ordinary numbers of f64.",
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
        Column { name: "mass_ratio", unit: "", meaning: "M = m₂/m₁, for -M" },
        Column {
            name: "length_unit",
            unit: "m",
            meaning: "m₂g/k: the stretch of the spring under the lower mass",
        },
        Column { name: "time_unit", unit: "s", meaning: "1/ω" },
        Column {
            name: "speed_unit",
            unit: "m/s",
            meaning: "m₂gω/k: a lift-off speed in m/s over this is α",
        },
        Column { name: "energy_unit", unit: "J", meaning: "m₁m₂g²/k" },
        Column {
            name: "angular_frequency",
            unit: "1/s",
            meaning: "ω = √(k(1+M)/m₂), of the spring in flight",
        },
        Column { name: "upper_mass", unit: "kg", meaning: "m₁" },
        Column { name: "lower_mass", unit: "kg", meaning: "m₂" },
        Column { name: "stiffness", unit: "N/m", meaning: "k" },
        Column { name: "gravity", unit: "m/s²", meaning: "g" },
    ],
};

static VALUES: TableKind = TableKind {
    name: "values",
    about: "one row for each QUANTITY and each --alpha",
    long: false,
    columns: &[
        Column { name: "given", unit: "", meaning: "as it was given" },
        Column { name: "value", unit: "", meaning: "in kilograms, metres and seconds" },
        Column { name: "unit", unit: "", meaning: "the unit of `value`" },
        Column {
            name: "dimensionless",
            unit: "",
            meaning: "in the units of the model; for a speed at lift-off it is α",
        },
        Column { name: "model_unit", unit: "", meaning: "the unit of `dimensionless`" },
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
    units.push([
        hopper.mass_ratio()?.value().into(),
        hopper.length_unit().into(),
        hopper.time_unit().into(),
        hopper.speed_unit().into(),
        hopper.energy_unit().into(),
        hopper.angular_frequency().into(),
        upper.into(),
        lower.into(),
        stiffness.into(),
        gravity.into(),
    ]);
    let mut values = Table::new(&VALUES);
    for Quantity { kind, value, text } in &options.quantities {
        let (own, name) = match kind {
            Kind::Length => (hopper.length_unit(), "m₂g/k"),
            Kind::Time => (hopper.time_unit(), "1/ω"),
            Kind::Speed => (hopper.speed_unit(), "m₂gω/k"),
            Kind::Energy => (hopper.energy_unit(), "m₁m₂g²/k"),
            Kind::Mass | Kind::Stiffness | Kind::Acceleration => {
                let reason = "masses, stiffness and gravity have options; give a speed, a length, a time or an energy";
                return Err(Error::misuse("QUANTITY", text, reason));
            }
        };
        let (value, unit) = (*value, kind.unit());
        values.push([
            text.clone().into(),
            value.into(),
            unit.into(),
            (value / own).into(),
            name.into(),
        ]);
    }
    for &alpha in &options.alpha {
        let speed = alpha * hopper.speed_unit();
        let given = format!("α = {}", crate::output::number(alpha));
        values.push([given.into(), speed.into(), "m/s".into(), alpha.into(), "m₂gω/k".into()]);
    }
    let tables = if values.rows.is_empty() { vec![units] } else { vec![units, values] };
    form.print(&tables, streams.output)
}
