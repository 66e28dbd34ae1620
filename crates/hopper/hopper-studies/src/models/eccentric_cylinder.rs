//! The bouncing eccentric cylinder: its motion, the gap below it, and its energy.

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use example_systems::eccentric_cylinder::{EccentricCylinder, Mode, Surface};
use hybrid_system::{Arc, Execution, Limits, State};
use journal_figures::{Anchor, Frame, Path, Pen, Svg, csv_file, ticks};
use nalgebra::Vector4;

const CYLINDER: EccentricCylinder = EccentricCylinder {
    eccentricity: 0.3,
    radius_of_gyration: 0.6,
    restitution: 0.8,
    rolling_resistance: 0.0,
};

/// Time of the pictures of the motion, and of the curves.
const DRAWN: f64 = 7.2;
const LONG: f64 = 32.0;

/// The horizontal velocity of the frame from which the motion is drawn. The floor has no friction: the velocity is
/// constant. It is chosen so that the outlines do not cover each other.
const DRIFT: f64 = 1.75;

/// Time between two outlines.
const BETWEEN_OUTLINES: f64 = 0.4;

const DARK: &str = "#10386e";
const ORANGE: &str = "#d0702b";
const OUTLINE: Pen = Pen::solid("#8a94a8", 0.9);
const SPOKE: Pen = Pen::solid("#8a94a8", 0.9);
const FLOOR: Pen = Pen::solid("#000", 1.2);
const CONTACT: &str = "#e4e4e0";

type Arcs = Vec<Arc<Mode, Surface, State<4>>>;

fn arcs(cylinder: &EccentricCylinder) -> Result<Arcs, Error> {
    // Released at rest, with the lowest point 1 above the floor and G almost beside C.
    let start = Vector4::new(2.0, 0.0, 1.5, 0.0);
    let execution = Execution::new(cylinder, Mode::Flight, start, Limits::new(LONG, 10_000));
    Ok(execution.collect::<Result<_, _>>()?)
}

/// The state at a time.
fn state_at(cylinder: &EccentricCylinder, arcs: &Arcs, time: f64) -> Result<State<4>, Error> {
    let arc = arcs.iter().rev().find(|arc| arc.time <= time).unwrap_or(&arcs[0]);
    Ok(arc.state(cylinder, (time - arc.time).min(arc.duration))?)
}

/// A quantity along all arcs, as one curve per arc.
fn curves(
    cylinder: &EccentricCylinder,
    arcs: &Arcs,
    quantity: impl Fn(&State<4>) -> f64,
) -> Result<Vec<Vec<(f64, f64)>>, Error> {
    /// Points on an arc in flight, a parabola with a slow oscillation; the long arc in contact takes ten times as many.
    const POINTS: u32 = 30;
    let mut curves = Vec::new();
    for arc in arcs.iter().filter(|arc| arc.duration > 0.0) {
        let points = if arc.mode == Mode::Contact { 10 * POINTS } else { POINTS };
        let curve: Result<Vec<_>, Error> = (0..=points)
            .map(|k| arc.duration * f64::from(k) / f64::from(points))
            .map(|t| Ok((arc.time + t, quantity(&arc.state(cylinder, t)?))))
            .collect();
        curves.push(curve?);
    }
    Ok(curves)
}

/// Outlines of the cylinder at equal times, its centre of mass, and its floor.
fn draw_motion(svg: &mut Svg, arcs: &Arcs) -> Result<(), Error> {
    let frame = Frame::linear(20.0, 30.0, 650.0, 145.0, (-1.2, 13.8), (-0.146, 3.2));
    let radius = frame.width / (frame.x.1 - frame.x.0);
    let center = |x: &State<4>, time: f64| {
        // C is above or below G by ε cos φ, and beside it by ε sin φ.
        let (sin, cos) = pxfm::f_sincos(x[2]);
        let shift = CYLINDER.eccentricity;
        (DRIFT * time - shift * sin, x[0] + shift * cos)
    };
    let outlines = (DRAWN / BETWEEN_OUTLINES).floor() as u32;
    for k in 0..=outlines {
        let time = BETWEEN_OUTLINES * f64::from(k);
        let x = state_at(&CYLINDER, arcs, time)?;
        let (c, g) = (frame.at(center(&x, time)), frame.at((DRIFT * time, x[0])));
        svg.path(Path::circle(c, radius), OUTLINE);
        svg.line(c, g, SPOKE);
    }
    let steps = 400;
    let mut path = Vec::new();
    for k in 0..=steps {
        let time = DRAWN * f64::from(k) / f64::from(steps);
        path.push((DRIFT * time, state_at(&CYLINDER, arcs, time)?[0]));
    }
    frame.polyline(svg, &path, Pen::solid(DARK, 1.6));
    for k in 0..=outlines {
        let time = BETWEEN_OUTLINES * f64::from(k);
        let g = frame.at((DRIFT * time, state_at(&CYLINDER, arcs, time)?[0]));
        svg.dot(g.0, g.1, 3.0, DARK);
    }
    frame.polyline(svg, &[(frame.x.0, 0.0), (frame.x.1, 0.0)], FLOOR);
    svg.text(
        20.0,
        20.0,
        Anchor::Start,
        12.5,
        "the cylinder at equal times, and its centre of mass, for $e$ = 0.8",
    );
    Ok(())
}

/// The motion above; the gap and the energy against time below.
pub(super) fn figure(_: &Job) -> Result<Figure, Error> {
    let elastic = EccentricCylinder { restitution: 1.0, ..CYLINDER };
    let rolling = EccentricCylinder { rolling_resistance: 0.1, ..CYLINDER };
    let (bouncing, kept, resting) = (arcs(&CYLINDER)?, arcs(&elastic)?, arcs(&rolling)?);
    let contact =
        bouncing.iter().find(|arc| arc.mode == Mode::Contact).map_or(LONG, |arc| arc.time);

    let mut svg = Svg::new(690.0, 416.0);
    draw_motion(&mut svg, &bouncing)?;
    let gap = Frame::linear(56.0, 216.0, 260.0, 150.0, (0.0, LONG), (0.0, 1.1));
    let energy = Frame::linear(406.0, 216.0, 260.0, 150.0, (0.0, LONG), (0.6, 2.2));
    for frame in [gap, energy] {
        let (from, to) = (frame.at((contact, 0.0)).0, frame.left + frame.width);
        svg.fill_rect(from, frame.top, to - from, frame.height, CONTACT);
    }
    let gaps = curves(&CYLINDER, &bouncing, |x| CYLINDER.gap(x))?;
    gap.clipped(&mut svg, |svg| {
        for curve in &gaps {
            gap.curve(svg, curve, Pen::solid(DARK, 1.4));
        }
    });
    gap.axes(&mut svg, &ticks(gap.x, 4), &ticks(gap.y, 4), "time $t$", "gap $g$");
    svg.text(gap.left, gap.top - 9.0, Anchor::Start, 12.5, "the lowest point; grey: contact");

    let lines = [
        (curves(&elastic, &kept, |x| elastic.energy(x))?, Pen::solid("#000", 1.2)),
        (curves(&CYLINDER, &bouncing, |x| CYLINDER.energy(x))?, Pen::solid(DARK, 1.8)),
        (curves(&rolling, &resting, |x| rolling.energy(x))?, Pen::dashed(ORANGE, 1.8, "5 3")),
    ];
    energy.clipped(&mut svg, |svg| {
        let rest = 1.0 - CYLINDER.eccentricity;
        energy.polyline(svg, &[(0.0, rest), (LONG, rest)], Pen::solid("#777", 0.8));
        for (curves, pen) in &lines {
            energy.polyline(svg, &curves.concat(), *pen);
        }
    });
    energy.axes(&mut svg, &ticks(energy.x, 4), &ticks(energy.y, 4), "time $t$", "energy $E$");
    svg.text(energy.left, energy.top - 9.0, Anchor::Start, 12.5, "energy; $μ$: rolling resistance");
    for (time, value, label) in
        [(8.0, 2.06, "$e$ = 1"), (20.0, 1.06, "$e$ = 0.8"), (20.0, 0.82, "$μ$ = 0.1")]
    {
        let at = energy.at((time, value));
        svg.text(at.0, at.1, Anchor::Start, 11.0, label);
    }
    let rows = gaps.iter().flatten().map(|&(time, gap)| vec![Some(time), Some(gap)]);
    Figure::new(
        "eccentric_cylinder",
        svg,
        vec![csv_file("eccentric_cylinder.csv", &["time", "gap"], rows)?],
        &[],
    )
}
