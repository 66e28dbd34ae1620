//! From equations to a bifurcation diagram, `bifurcation_diagram.svg`: a forced oscillator that hits a stop.
//! `cargo run --release -p return-map --example bifurcation_diagram > oscillator.svg`
use hybrid_system::Equations;
use journal_figures::{Frame, LabelledBranch, Svg, render, ticks};
use return_map::*;
use std::{error::Error, io::Write, ops::ControlFlow::Continue};

pub(crate) fn diagram() -> Result<String, Box<dyn Error>> {
    let oscillator = Equations::new(&["x", "v"], &[("force", "0.3")])
        .mode_text("free", &["v", "force*cos(1.3*t) - 0.1*v - x"])
        .rising_text("stop", "x - 1/2")
        .resets_text(&["x", "-0.8*v"])
        .clock_text("period", "2*pi/1.3", "2*pi/1.3");
    let map = EquationReturns::new(&oscillator, "force", ("free", "period"), &["x", "v"])?;
    // The orbits of two starts, after a transient.
    let at: Vec<f64> = (0..270).map(|k| 0.1 + 0.4 / 270.0 * (f64::from(k) + 0.5)).collect();
    let seeds = [vec![0.0, 0.0], vec![0.1, 0.8]];
    let length = OrbitLength { transient: 100, keep: 20 };
    let columns = bifurcation_diagram(&map, &at, (&seeds, Seeds::Fresh), length, |_| Continue(()));
    let points = columns.iter().flat_map(|column| {
        column.orbits.iter().flatten().flatten().map(|point| (column.parameter, point[0]))
    });
    let mut svg = Svg::new(620.0, 400.0);
    let frame = Frame::linear(62.0, 14.0, 540.0, 330.0, (0.1, 0.5), (-0.6, 0.5));
    frame.point_cloud(&mut svg, (270, 330), points)?;
    // The motions without and with impacts, stable or not, with their bifurcations.
    let (mut drawn, steps) = (Vec::new(), BranchSteps::default());
    for start in [(&[-0.14, 0.034][..], 0.1), (&[0.219, 1.144], 0.5)] {
        let branch = follow_branch(&map, 1, start, frame.x, steps, |_| Continue(()))?;
        drawn.push(LabelledBranch { line: branch.line(0), marks: branch.marks(0) });
    }
    frame.labelled_branches(&mut svg, &drawn, ["#1f4e96", "#d03a2b"]);
    frame.axes(&mut svg, &ticks(frame.x, 8), &ticks(frame.y, 11), "force", "$x$ once in a period");
    Ok(render("oscillator", &svg, 1.0)?.svg)
}

fn main() -> Result<(), Box<dyn Error>> {
    Ok(std::io::stdout().write_all(diagram()?.as_bytes())?)
}
