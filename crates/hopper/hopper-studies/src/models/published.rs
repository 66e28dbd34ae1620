//! The models from published sources: runs of each against time.

use super::scene_panel::{Panel, draw};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use example_systems::ball_on_table::{FREQUENCY, ball_on_table, periodic_start};
use example_systems::buck_converter::{PERIOD, buck_converter};
use example_systems::impact_oscillator::{grazing_forcing, impact_oscillator, steady_start};
use example_systems::spring_leg::{apex, spring_leg};
use example_systems::stick_slip::stick_slip;
use hybrid_system::{Equations, Label, State};
use pxfm::f_sin;

/// Periods of the converter that are drawn, after a thousand that are not.
const PERIODS: f64 = 8.0;
const TRANSIENT: f64 = 1000.0;

/// A component along a run of a model, added to a panel.
fn run<const N: usize>(
    panel: Panel,
    model: &Equations,
    (mode, start): (&str, [f64; N]),
    component: usize,
) -> Result<Panel, Error> {
    let model = model.model::<State<N>>()?;
    Ok(panel.scene(&model, Label::new(mode)?, State::from(start), &[component]))
}

fn runner() -> Result<Panel, Error> {
    let panel = Panel::new("a: a runner on a spring leg", 1.6, (0.86, 1.0), "height (m)");
    run(panel, &spring_leg(), ("flight", apex()), 1)
}

fn ball() -> Result<Panel, Error> {
    let panel = Panel::new("b: a ball on a table", 4.0, (-0.05, 0.19), "height")
        .pen(1)
        .function(|t| 0.03 * f_sin(FREQUENCY * t))
        .pen(0);
    let [height, speed, _] = periodic_start(0.03);
    run(panel, &ball_on_table(), ("flight", [height + 0.03, speed, 0.0]), 0)
}

/// A forcing one per cent above the grazing one, from its steady motion without a stop.
fn oscillator() -> Result<Panel, Error> {
    let forcing = 1.01 * grazing_forcing();
    let model = impact_oscillator(&format!("{forcing}"));
    let panel = Panel::new("c: an oscillator behind its grazing", 40.0, (-1.4, 0.6), "$x$");
    run(panel.surface(0.5), &model, ("free", steady_start(forcing)), 0)
}

/// The voltage behind the transient, as a scene that begins there.
fn converter(title: &'static str, source: &str) -> Result<Panel, Error> {
    let equations = buck_converter(source);
    let model = equations.model::<State<3>>()?;
    let mut transient = model.start("off", [12.0, 0.5, 3.8], TRANSIENT * PERIOD)?;
    transient.by_ref().try_for_each(|arc| arc.map(drop))?;
    let (mode, state) = (transient.mode(), *transient.state());
    let panel = Panel::new(title, PERIODS * PERIOD, (11.6, 12.6), "voltage (V)");
    Ok(panel.scene(&model, mode, state, &[0]))
}

/// All of them.
pub(super) fn figure(_: &Job) -> Result<Figure, Error> {
    let belt = Panel::new("f: a mass sticks to a belt and slips", 40.0, (-1.2, 0.4), "speed $v$");
    let panels = [
        runner()?,
        ball()?,
        oscillator()?,
        converter("d: a converter, 24 V: one period", "24")?,
        converter("e: the same, 33 V: chaos", "33")?,
        run(belt.surface(0.2), &stick_slip(), ("stick", [0.0, 0.2]), 1)?,
    ];
    Figure::new("published", draw(&panels), vec![], &[("transient", TRANSIENT.to_string())])
}
