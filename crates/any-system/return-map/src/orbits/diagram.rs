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

/// For each column of a diagram, and each of its seeds: after how many images the orbit comes back to its points. `None` for an orbit that does not do so twice
/// within its points, and for one that has none.
///
/// Points count as one if each coordinate differs by at most `tolerance` times its range in the diagram, and by rounding: by what a picture of the diagram does
/// not show. The range is that of nine tenths of all points and seeds, so that some orbits that escape do not make it wide. So a period is as sure as the
/// points: a long transient, and an orbit that is periodic only to this tolerance, have one here.
pub fn periods(
    columns: &[DiagramColumn],
    seeds: &[Vec<f64>],
    tolerance: f64,
) -> Vec<Vec<Option<usize>>> {
    let points = || {
        let orbits = columns.iter().flat_map(|column| column.orbits.iter().flatten().flatten());
        orbits.chain(seeds)
    };
    let dimension = points().map(Vec::len).max().unwrap_or(0);
    let apart: Vec<f64> = (0..dimension)
        .map(|at| {
            let mut values: Vec<f64> =
                points().filter_map(|point| point.get(at).copied()).collect();
            values.sort_by(f64::total_cmp);
            let left_out = values.len() / 20;
            let inner = &values[left_out..values.len() - left_out];
            let (Some(low), Some(high)) = (inner.first(), inner.last()) else { return 0.0 };
            tolerance * (high - low) + ROUNDING * low.abs().max(high.abs())
        })
        .collect();
    let near = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).zip(&apart).all(|((x, y), apart)| (x - y).abs() <= *apart)
    };
    let is_period = |points: &[Vec<f64>], period: usize| {
        points.iter().zip(&points[period..]).all(|(a, b)| near(a, b))
    };
    let period = |points: &Vec<Vec<f64>>| (1..=points.len() / 2).find(|p| is_period(points, *p));
    let of_column = |column: &DiagramColumn| {
        column.orbits.iter().map(|orbit| orbit.as_ref().ok().and_then(period)).collect()
    };
    columns.iter().map(of_column).collect()
}

/// The error of an image, as a part of the largest point: that of a return at the tolerance of the motion.
const ROUNDING: f64 = 1e-12;

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
/// use return_map::{OrbitLength, Seeds, bifurcation_diagram, periods, scalar_family};
/// use std::ops::ControlFlow::Continue;
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let length = OrbitLength { transient: 1000, keep: 4 };
/// let seeds = [vec![0.3]];
/// let columns = bifurcation_diagram(&logistic, &[2.5, 3.2], (&seeds, Seeds::Fresh), length, |_| Continue(()));
/// let orbit = columns[1].orbits[0].as_ref().expect("an orbit");
/// // A cycle of period two.
/// assert!((orbit[0][0] - orbit[2][0]).abs() < 1e-12 && (orbit[0][0] - orbit[1][0]).abs() > 0.1);
/// assert_eq!(periods(&columns, &seeds, 1e-9), [[Some(1)], [Some(2)]]);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::scalar_family;
    use std::ops::ControlFlow::Continue;

    #[test]
    fn periods_are_those_of_the_range_of_the_diagram() {
        let length = OrbitLength { transient: 2000, keep: 16 };
        // In small units, far from 0, and with an orbit that grows in one of 40 columns.
        for (unit, shift) in [(1.0, 0.0), (1e-7, 0.0), (1e-4, 300.0)] {
            let logistic = scalar_family(move |x, r| {
                let y = (x - shift) / unit;
                shift + unit * if r > 4.0 { 2.0 * y } else { r * y * (1.0 - y) }
            });
            let mut at = vec![2.9, 3.2, 3.5, 3.9];
            at.extend([3.3; 35]);
            at.push(5.0);
            let seeds = [vec![shift + 0.3 * unit]];
            let short = OrbitLength { transient: if unit < 1.0 { 2000 } else { 500 }, ..length };
            let found =
                bifurcation_diagram(
                    &logistic,
                    &at,
                    (&seeds, Seeds::Fresh),
                    short,
                    |_| Continue(()),
                );
            let found = periods(&found, &seeds, 1e-6);
            let first: Vec<Option<usize>> = found.iter().take(4).map(|own| own[0]).collect();
            assert_eq!(first, [Some(1), Some(2), Some(4), None], "{unit} {shift}");
        }
        // Without points there is no period, and without seeds they are found.
        let empty = DiagramColumn { parameter: 0.0, orbits: vec![Ok(Vec::new())] };
        assert_eq!(periods(&[empty], &[], 1e-6), [[None]]);
        let cycle = DiagramColumn {
            parameter: 0.0,
            orbits: vec![Ok([1.0, 2.0, 1.0, 2.0].map(|x| vec![x]).to_vec())],
        };
        assert_eq!(periods(&[cycle], &[], 1e-6), [[Some(2)]]);
    }
}
