//! The orbits beside a point that falls onto a fixed point, by one orbit in 106 bits.
//!
//! In `f64` an orbit that comes within 10⁻⁹ of α*_n has lost the digits of its offset. Here one reference orbit has them, and the
//! orbits beside it follow from its tangent: the offset of each keeps its digits, however near it is.

use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, FixedPointSpeed, LiftOffMap, OrbitTangent,
};

/// The largest distance of a start from the reference, and the next ones that are tried where the orbits do not hop alike. At 10⁻⁶
/// the bound on the third order moves a phase by some 10⁻⁴; an orbit in `f64` has a smaller error there.
const RADII: [f64; 3] = [1e-6, 3e-8, 1e-9];

/// The starts near one that falls onto α*_n.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BesideEdge {
    /// The start of the reference orbit.
    start: f64,
    pub(crate) n: u64,
    /// The offset of the reference orbit from α*_n, and a bound on its error.
    offset: (f64, f64),
    tangent: OrbitTangent,
    /// The coefficient of the second order, and a bound on that of the third. The second is measured with two more orbits. The
    /// third is estimated from the bound on the second, which is some hundred times the second itself: as that bound times its
    /// ratio to the slope.
    curvature: f64,
    third: f64,
}

/// Two starts nearer to each other than this, both of which come next to the same fixed point, have one edge as a rule. Otherwise
/// the second one is labelled alone.
const SAME_EDGE: f64 = 1e-5;

impl BesideEdge {
    /// From a start whose orbit comes near α*_n after `hops` hops. `see` is given each speed of the reference orbit, with the
    /// largest distance of the orbits beside it. `None` if they do not all hop alike.
    pub(crate) fn new(
        map: &LiftOffMap,
        near: f64,
        (n, hops): (u64, usize),
        mut see: impl FnMut(f64, f64),
    ) -> Option<Self> {
        let start = edge(map, near, (n, hops))?;
        RADII.into_iter().find_map(|radius| {
            let orbit = ExtendedOrbit::new(map, start, Arithmetic::Bits106).ok()?;
            let mut orbit = orbit.with_radii(radius, 0.0);
            let mut speeds = Vec::with_capacity(hops);
            for _ in 0..hops {
                speeds.push((orbit.speed(), orbit.tangent()?.reach()));
                if orbit.hop() != Ok(ExtendedStep::LiftsOff) {
                    return None;
                }
            }
            speeds.into_iter().for_each(|(speed, reach)| see(speed, reach));
            let (offset, tangent) = (orbit.offset_from(n), orbit.tangent()?);
            // Slopes of two chords from the start.
            let chord = |end: f64| {
                let mut orbit = ExtendedOrbit::new(map, end, Arithmetic::Bits106).ok()?;
                let lifts_off = (0..hops).all(|_| orbit.hop() == Ok(ExtendedStep::LiftsOff));
                let moved = orbit.offset_from(n).0 - offset.0;
                lifts_off.then(|| (end - start, moved / (end - start)))
            };
            let ((right, above), (left, below)) =
                (chord(start + 0.5 * radius)?, chord(start - 0.5 * radius)?);
            let curvature = (above - below) / (right - left);
            let third = tangent.second * tangent.second / tangent.first_order() / (radius * radius * radius);
            Some(BesideEdge { start, n, offset, tangent, curvature, third })
        })
    }

    /// Whether another search from `start` would find the same edge.
    pub(crate) fn is_near(&self, n: u64, start: f64) -> bool {
        self.n == n && (self.start - start).abs() <= SAME_EDGE
    }

    /// The offset from α*_n to which the orbit of `alpha` comes, and a bound on its error; `None` for a start too far away.
    pub(crate) fn offset(&self, alpha: f64) -> Option<(f64, f64)> {
        let beside = alpha - self.start; // exact: both are near
        if !(beside.abs() <= self.tangent.radius) {
            return None;
        }
        let OrbitTangent { slope, rounding, .. } = self.tangent;
        let size = beside.abs();
        let offset = self.offset.0 + (slope + self.curvature * beside) * beside;
        let error = self.offset.1
            + (rounding + self.third * size * size) * size
            + 2.0 * f64::EPSILON * (offset.abs() + (slope * beside).abs());
        Some((offset, error))
    }
}

/// The start nearest to `near` whose orbit falls onto α*_n, to first order in the distance.
fn edge(map: &LiftOffMap, near: f64, (n, hops): (u64, usize)) -> Option<f64> {
    let (mut speed, mut slope) = (near, 1.0);
    for _ in 0..hops {
        slope *= map.slopes(speed).ok()??.by_speed;
        speed = map.image(speed).ok()??;
    }
    let start = near - FixedPointSpeed::new(n).offset_of(speed) / slope;
    (start.is_finite() && start > 0.0).then_some(start)
}
