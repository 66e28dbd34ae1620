//! From equations to a bifurcation diagram: a forced oscillator that hits a stop.
//!
//! Run with `cargo run --release -p return-map --example bifurcation_diagram > oscillator.svg`.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::Equations;
use journal_figures::{Anchor, Frame, Marker, Svg, render, ticks};
use return_map::*;
use std::{error::Error, ops::ControlFlow::Continue};

fn diagram() -> Result<String, Box<dyn Error>> {
    let oscillator = Equations::new(&["x", "v"], &[("force", "0.3")])
        .mode_text("free", &["v", "force*cos(1.3*t) - 0.1*v - x"])
        .rising_text("stop", "x - 1/2")
        .resets_text(&["x", "-0.8*v"])
        .clock_text("period", "2*pi/1.3", "2*pi/1.3");
    let map = EquationReturns::new(&oscillator, "force", ("free", "period"), &["x", "v"])?;

    // Orbits after a transient: the first coordinate at 280 forces.
    let forces: Vec<f64> = (0..280).map(|k| 0.33 + 5e-4 * f64::from(k)).collect();
    let (seeds, length) = ([vec![-0.3, 0.1]], OrbitLength { transient: 300, keep: 60 });
    let columns =
        bifurcation_diagram(&map, &forces, (&seeds, Seeds::Fresh), length, |_| Continue(()));
    let points = columns.iter().flat_map(|column| {
        let orbits = column.orbits.iter().flatten().flatten();
        orbits.map(move |point| (column.parameter, point[0]))
    });

    // The motion that does not meet the stop, up to its end.
    let (start, window) = ((&[-0.3, 0.1][..], 0.33), (0.33, 0.47));
    let branch = follow_branch(&map, 1, start, window, BranchSteps::default(), |_| Continue(()))?;
    let line: Vec<_> = branch
        .points
        .iter()
        .map(|point| (point.parameter, point.point[0], point.is_stable))
        .collect();

    let mut svg = Svg::new(620.0, 400.0);
    let frame = Frame::linear(62.0, 14.0, 540.0, 330.0, window, (-0.6, 0.5));
    frame.point_cloud(&mut svg, (280, 330), points)?;
    frame.branch(&mut svg, &line, "#1f4e96");
    if let BranchEnd::Border { border: Border::Grazing { .. }, at, .. } = &branch.ends[1] {
        let (place, mark) = ((at.parameter, at.point[0]), (Marker::Square, "#d03a2b"));
        frame.labelled_point(&mut svg, place, mark, (Anchor::End, "grazing"));
    }
    frame.axes(&mut svg, &ticks(window, 7), &ticks(frame.y, 11), "force", "$x$ once in a period");
    Ok(render("oscillator", &svg, 1.0)?.svg)
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("{}", diagram()?);
    Ok(())
}
