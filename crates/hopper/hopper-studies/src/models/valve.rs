//! The bifurcation diagram of the pressure relief valve.

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use example_systems::valve::{LARGEST_FLOW, SMALLEST_FLOW, valve_equations};
use hybrid_system::{Label, Tolerances};
use journal_figures::{Frame, LabelledBranch, Svg, csv_file, ticks};
use return_map::{
    Branch, BranchSteps, EquationReturns, FormulaMap, OrbitLength, Seeds, bifurcation_diagram,
    doubled_branch, follow_behind, follow_branch, follow_equilibria,
};
use std::ops::ControlFlow::Continue;

/// Flow rates of the tutorial's diagram.
const RATES: (f64, f64) = (SMALLEST_FLOW, LARGEST_FLOW);
/// Number of flow rates, and number of flow rates in one piece that is stored on disk.
const COLUMNS: usize = 980;
const PIECE: usize = 20;
/// Turning points that are left out while the motion settles. Chosen: more cost time in proportion, and fewer leave
/// orbits that still approach their limit near a bifurcation, where they settle slowly.
const TRANSIENT: usize = 1024;
/// Turning points that are drawn. A periodic orbit with up to three of them meets each of its pixels 32 times or more,
/// and is drawn black.
const DRAWN: usize = 96;
/// The picture in pixels.
const PIXELS: (usize, usize) = (COLUMNS, 600);
/// The largest displacement that is drawn: the next whole number above the largest one found, 8.86.
const HIGHEST: f64 = 9.0;
/// Displacement and pressure at the start of each orbit.
const START: [f64; 2] = [1.0, 10.0];
/// An equilibrium, where spring and pressure balance. Its flow rate is that of y₁ √y₃.
const REST: [f64; 3] = [2.0, 0.0, 12.0];
/// A flow rate at which one orbit attracts all, and where the branches begin.
const CALM: f64 = 4.0;

/// The displacements at the turning points against the flow rate, with the orbits of one and two turning points.
pub(super) fn figure(job: &Job) -> Result<Figure, Error> {
    let valve = valve_equations();
    let section = ("open", "turning point");
    let returns = EquationReturns::new(&valve, "flow", section, &["displacement", "pressure"])?;
    // The tolerance of the tutorial for the orbits, the usual one for the branches.
    let coarse = EquationReturns::new(&valve, "flow", section, &["displacement", "pressure"])?
        .tolerances(Tolerances::both(1e-10));
    let rate =
        |column: usize| RATES.0 + (RATES.1 - RATES.0) * (column as f64 + 0.5) / COLUMNS as f64;
    let seeds = [START.to_vec()];
    let orbits = |rates: &[f64], length: OrbitLength| -> Result<Vec<Vec<f64>>, Error> {
        let seeds = (&seeds[..], Seeds::Fresh);
        let columns = bifurcation_diagram(&coarse, rates, seeds, length, |_| Continue(()));
        let mut found = Vec::new();
        for column in columns {
            for orbit in column.orbits {
                found.extend(orbit?);
            }
        }
        Ok(found)
    };
    let pieces = job.scan("the valve's turning points", COLUMNS / PIECE, |piece| {
        let rates: Vec<f64> = (piece * PIECE..(piece + 1) * PIECE).map(rate).collect();
        let length = OrbitLength { transient: TRANSIENT, keep: DRAWN };
        Ok(orbits(&rates, length)?.iter().map(|point| point[0]).collect::<Vec<f64>>())
    })?;
    let displacements: Vec<f64> = pieces.concat();
    let mut svg = Svg::new(620.0, 400.0);
    let frame = Frame::linear(62.0, 14.0, 540.0, 330.0, RATES, (0.0, HIGHEST));
    let points = displacements.iter().enumerate();
    let points = points.map(|(k, &displacement)| (rate(k / DRAWN), displacement));
    frame.point_cloud(&mut svg, PIXELS, points)?;
    let steps = BranchSteps::default();
    let see = |_: &_| Continue(());
    let calm = orbits(&[CALM], OrbitLength { transient: TRANSIENT, keep: 1 })?.concat();
    let once = follow_branch(&returns, 1, (&calm, CALM), RATES, steps, see)?;
    let mut branches = vec![drawn(&once)];
    for doubling in &once.bifurcations {
        branches.push(drawn(&doubled_branch(&returns, (1, doubling), RATES, steps, see)?));
    }
    // Behind the grazing the disc does not hit its seat.
    let free = follow_behind(&returns, 1, &once.ends[1], RATES, steps, see)?;
    // It ends where the orbit shrinks to the equilibrium, whose name is there.
    branches.push(LabelledBranch { marks: Vec::new(), ..drawn(&free) });
    let field = valve.field(Label::new("open")?)?;
    let field = FormulaMap::new(field, "flow")?;
    let rest = (&REST[..], REST[0] * REST[2].sqrt());
    branches.push(drawn(&follow_equilibria(&field, rest, RATES, steps, see)?));
    frame.labelled_branches(&mut svg, &branches, [BRANCH, MARKED]);
    frame.axes(
        &mut svg,
        &ticks(RATES, 10),
        &ticks((0.0, HIGHEST), 9),
        "flow rate $q$ (dimensionless)",
        "displacement $y$_{1} at the turning points, $y$_{2} = 0",
    );
    let rows = displacements
        .iter()
        .enumerate()
        .map(|(k, &displacement)| vec![Some(rate(k / DRAWN)), Some(displacement)]);
    Figure::new(
        "valve",
        svg,
        vec![csv_file("valve.csv", &["flow_rate", "displacement"], rows)?],
        &[
            ("drawn", DRAWN.to_string()),
            ("transient", TRANSIENT.to_string()),
            ("columns", COLUMNS.to_string()),
        ],
    )
}

/// The displacements on a branch, with its bifurcations and ends.
fn drawn(branch: &Branch) -> LabelledBranch {
    LabelledBranch { line: branch.line(0), marks: branch.marks(0) }
}

const BRANCH: &str = "#1f4e96";
const MARKED: &str = "#d03a2b";
