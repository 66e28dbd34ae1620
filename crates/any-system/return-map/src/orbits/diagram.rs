//! Bifurcation diagrams: where orbits are after a transient, over a parameter.

use crate::error::Error;
use crate::families::MapFamily;
use hybrid_system::many;
use std::ops::ControlFlow;

/// The points of a diagram at one value of the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramColumn {
    /// The parameter.
    pub parameter: f64,
    /// For each seed the points of its orbit after the transient, or why it has none.
    pub orbits: Vec<Result<Vec<Vec<f64>>, Error>>,
}

impl DiagramColumn {
    /// After how many images each orbit comes back to its points, each within `tolerance` · (1 + |x|); `None` for an orbit that does not do so
    /// twice within its points, and for one that has none.
    ///
    /// It is as sure as its points: a long transient, and an orbit that is periodic only to this tolerance, have a period here.
    pub fn periods(&self, tolerance: f64) -> Vec<Option<usize>> {
        let near = |(x, y): (&f64, &f64)| (x - y).abs() <= tolerance * (1.0 + x.abs());
        let is_period = |points: &[Vec<f64>], period: usize| {
            points.iter().zip(&points[period..]).all(|(a, b)| a.iter().zip(b).all(near))
        };
        let period =
            |points: &Vec<Vec<f64>>| (1..=points.len() / 2).find(|p| is_period(points, *p));
        self.orbits.iter().map(|orbit| orbit.as_ref().ok().and_then(period)).collect()
    }
}

/// Where the orbits of a column begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Seeds {
    /// At the seeds, at each parameter. Coexisting attractors are seen if some seed is in their basins.
    Fresh,
    /// At the first parameter at the seeds, then where the orbit of the parameter before has ended. An attractor is followed as long as it
    /// attracts: in the other direction of the parameters the diagram may be another one (hysteresis). An orbit that fails begins
    /// again at its seed.
    Carried,
}

/// How long the orbits of a diagram are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct OrbitLength {
    /// Images that are not shown.
    pub transient: usize,
    /// Images that are shown.
    pub keep: usize,
}

/// The bifurcation diagram of a map at some parameters, in their order: the orbits of some seeds after a transient.
///
/// It runs on all processors with the feature `parallel`, and has the same bits on any number of them. `progress` receives the number of
/// finished columns. If it breaks, the columns that are not finished are left out. Of carried seeds those of one column run side by side.
///
/// ```
/// use return_map::{OrbitLength, Seeds, bifurcation_diagram, scalar_family};
/// use std::ops::ControlFlow::Continue;
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let length = OrbitLength { transient: 1000, keep: 4 };
/// let seeds = [vec![0.3]];
/// let columns = bifurcation_diagram(&logistic, &[2.5, 3.2], (&seeds, Seeds::Fresh), length, |_| Continue(()));
/// let orbit = columns[1].orbits[0].as_ref().expect("an orbit");
/// // A cycle of period two.
/// assert!((orbit[0][0] - orbit[2][0]).abs() < 1e-12 && (orbit[0][0] - orbit[1][0]).abs() > 0.1);
/// assert_eq!(columns[1].periods(1e-9), [Some(2)]);
/// ```
pub fn bifurcation_diagram<M: MapFamily + ?Sized>(
    map: &M,
    parameters: &[f64],
    (seeds, from): (&[Vec<f64>], Seeds),
    length: OrbitLength,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Vec<DiagramColumn> {
    match from {
        Seeds::Fresh => {
            let column = |k: usize| {
                let parameter = parameters[k];
                let orbit = |seed: &Vec<f64>| Ok(orbit(map, seed, parameter, length)?.0);
                DiagramColumn { parameter, orbits: seeds.iter().map(orbit).collect() }
            };
            many(parameters.len(), column, progress).into_iter().flatten().collect()
        }
        Seeds::Carried => carried(map, parameters, seeds, length, progress),
    }
}

/// The columns one after the other, each from where the one before has ended.
fn carried<M: MapFamily + ?Sized>(
    map: &M,
    parameters: &[f64],
    seeds: &[Vec<f64>],
    length: OrbitLength,
    progress: impl Fn(usize) -> ControlFlow<()>,
) -> Vec<DiagramColumn> {
    let mut starts = seeds.to_vec();
    let mut columns = Vec::with_capacity(parameters.len());
    for &parameter in parameters {
        let one = |k: usize| orbit(map, &starts[k], parameter, length);
        let found = many(seeds.len(), one, |_| ControlFlow::Continue(()));
        let mut orbits = Vec::with_capacity(seeds.len());
        for (k, found) in found.into_iter().flatten().enumerate() {
            orbits.push(found.map(|(kept, last)| {
                starts[k] = last;
                kept
            }));
            if orbits[k].is_err() {
                starts[k].clone_from(&seeds[k]);
            }
        }
        columns.push(DiagramColumn { parameter, orbits });
        if progress(columns.len()).is_break() {
            break;
        }
    }
    columns
}

/// The points of an orbit after a transient, and the last one.
fn orbit<M: MapFamily + ?Sized>(
    map: &M,
    start: &[f64],
    parameter: f64,
    length: OrbitLength,
) -> Result<(Vec<Vec<f64>>, Vec<f64>), Error> {
    let mut kept = Vec::with_capacity(length.keep.min(1 << 16));
    let (mut last, mut images) = (start.to_vec(), 0);
    let count = length.transient.saturating_add(length.keep);
    map.orbit(start, parameter, count, &mut |image| {
        images += 1;
        if images > length.transient {
            kept.push(image.point.clone());
        }
        last = image.point;
        ControlFlow::Continue(())
    })?;
    Ok((kept, last))
}
