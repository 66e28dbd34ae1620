//! Curves of grazings and corners in two parameters.

use super::border::{BESIDE, OrbitBorder};
use super::branch::BranchEnd;
use super::follow::BranchSteps;
use super::orbit::{Kind, Orbit};
use super::two_parameters::{
    BifurcationCurve, BifurcationCurvePoint, Condition, CurveEnd, Windows, followed,
};
use crate::checks::check_period;
use crate::error::Error;
use crate::families::MapFamily;
use nalgebra::DVector;
use std::ops::ControlFlow;

/// The border of a family of maps.
struct OnBorder<'f, F> {
    family: &'f F,
    period: usize,
    border: OrbitBorder,
    /// The pieces on both sides.
    sides: [Vec<String>; 2],
}

impl<M: MapFamily, F: Fn(f64) -> M> Condition for OnBorder<'_, F> {
    fn values(&self, at: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let last = at.len() - 1;
        self.border.values(&(self.family)(at[last]), &at.rows(0, last).into_owned())
    }

    /// The orbit meets further surfaces. On the border itself it is on one of both sides, or the map does not say on which.
    fn end(&self, at: &DVector<f64>) -> Option<CurveEnd> {
        let last = at.len() - 1;
        let map = (self.family)(at[last]);
        let scales = DVector::from_element(last, 1.0);
        let orbit = Orbit { map: &map, kind: Kind::Periodic(self.period), scales };
        let beyond = match orbit.itinerary(&at.rows(0, last).into_owned()) {
            Ok(beyond) => beyond,
            Err(Error::Stopped { .. }) => return Some(CurveEnd::Stopped),
            Err(_) => return None,
        };
        (!self.sides.contains(&beyond)).then_some(CurveEnd::Border { beyond })
    }
}

/// The curve of a grazing or a corner in two parameters, from the end of a branch that was found, in both directions, up to the
/// borders of both windows. `family` gives the map at a value of the second parameter, whose value on the branch is `second`.
///
/// As [`bifurcation_curve`](super::bifurcation_curve), for a [`BranchEnd::Border`].
///
/// ```
/// use hybrid_system::Equations;
/// use return_map::{BranchSteps, EquationReturns, border_curve, follow_branch};
/// use std::ops::ControlFlow::Continue;
/// // A pendulum-like rotor ẋ = v, v̇ = f cos t − x/4 swings with the amplitude 4f/3 past a wall at w: it touches where f = 3w/4.
/// let swings = |wall: f64| {
///     let wall = format!("{wall:?}");
///     let rotor = Equations::new(&["x", "v"], &[("f", "1"), ("wall", &wall)])
///         .mode_text("free", &["v", "f*cos(t) - x/4 - v/10"])
///         .rising_text("wall", "x - wall")
///         .resets_text(&["x", "-v"])
///         .clock_text("period", "2*pi", "2*pi");
///     EquationReturns::new(&rotor, "f", ("free", "period"), &["x", "v"]).expect("a map")
/// };
/// let steps = BranchSteps { longest: 0.1, ..BranchSteps::default() };
/// let amplitude = 1.0 / (0.75f64.powi(2) + 0.01).sqrt();
/// let start = [-0.75 * amplitude * amplitude * 0.5, 0.1 * amplitude * amplitude * 0.5];
/// let branch = follow_branch(&swings(1.0), 1, (&start, 0.5), (0.4, 1.0), steps, |_| Continue(()))?;
/// let curve = border_curve(&swings, 1, (&branch.ends[1], 1.0), ((0.1, 1.5), (0.5, 1.5)), steps, |_| Continue(()))?;
/// for found in &curve.points {
///     let [forcing, wall] = found.parameters;
///     assert!((forcing * amplitude - wall).abs() < 1e-10);
/// }
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::OtherStart`] for an end that is no border; [`Error::BadArgument`] for windows that are empty or do not contain the start;
/// [`Error::BorderNotFollowed`] for a border that is no grazing or corner, or not known to be one; [`Error::NoPeriodicPoint`] if the curve
/// is not found at the start.
pub fn border_curve<M: MapFamily, F: Fn(f64) -> M>(
    family: &F,
    period: usize,
    (end, second): (&BranchEnd, f64),
    windows: Windows,
    steps: BranchSteps,
    see: impl FnMut(&BifurcationCurvePoint) -> ControlFlow<()>,
) -> Result<BifurcationCurve, Error> {
    check_period(period)?;
    let BranchEnd::Border { border, at, beyond, place } = end else {
        let needed = "the end of a branch at a border";
        return Err(Error::OtherStart { needed, found: format!("{end:?}") });
    };
    let map = family(second);
    let scales = DVector::from_element(at.point.len() + 1, 1.0);
    let orbit = Orbit { map: &map, kind: Kind::Periodic(period), scales };
    let start = DVector::from_column_slice(&at.point).push(at.parameter);
    let refused = || Error::BorderNotFollowed { border: format!("{border:?}") };
    let sides = [at.itinerary.clone(), beyond.clone()];
    let found = OrbitBorder::new(&orbit, &start, (&at.itinerary, beyond), *place, BESIDE)
        .ok_or_else(|| map.stopped().unwrap_or_else(refused))?;
    let condition = OnBorder { family, period, border: found, sides };
    followed(&condition, &map, (at, second), windows, steps, see)
}
