//! The unstable manifold of a saddle, as a function of one number.

use super::local::LocalCurve;
use crate::branches::BranchPoint;
use crate::error::Error;
use crate::families::{MapFamily, curve_after, orbit_after};
use equations::Jet;

/// One side of the one-dimensional unstable manifold of a saddle of a map: a fixed or periodic point with one multiplier outside of the
/// unit circle.
///
/// A point of it is Γ(t) = gᵏ(x(s μ^(t−k))) with the cubic x beside the saddle, g = fⁿ and its multiplier μ: g leads from Γ(t) to Γ(t + 1),
/// and Γ(−∞) is the saddle. Errors across the manifold shrink on the way. The stable manifold is the unstable one of the inverse map,
/// which the caller gives: by a formula, or as returns of `Equations::reversed`.
///
/// ```
/// use return_map::{ManifoldSteps, UnstableManifold, family};
/// // Hénon's map: its attractor is the closure of this manifold.
/// let henon = family(2, |x: &[f64], a| Ok(vec![1.0 - a * x[0] * x[0] + x[1], 0.3 * x[0]]));
/// let manifold = UnstableManifold::new(&henon, 1, (&[0.63, 0.19], 1.4), 1.0)?;
/// let steps = ManifoldSteps { length: 20.0, ..ManifoldSteps::default() };
/// let curve = manifold.curve(&steps, |_| std::ops::ControlFlow::Continue(()))?;
/// assert!(curve.points.iter().all(|point| point[0].abs() < 1.3));
/// # Ok::<(), return_map::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct UnstableManifold<'m, M: ?Sized> {
    map: &'m M,
    local: LocalCurve,
    /// The s of Γ(0): the reach of the cubic, with the sign of the side.
    start: f64,
}

impl<'m, M: MapFamily + ?Sized> UnstableManifold<'m, M> {
    /// One side of the manifold of the saddle near `start`: `side` is positive for the direction in which the largest component of the
    /// eigenvector grows, negative for the other one.
    ///
    /// # Errors
    /// [`Error::NoSaddle`] unless one multiplier is outside of the unit circle, and if the map has a border at the saddle;
    /// [`Error::NoPeriodicPoint`]; those of the map.
    pub fn new(
        map: &'m M,
        period: usize,
        start: (&[f64], f64),
        side: f64,
    ) -> Result<UnstableManifold<'m, M>, Error> {
        if !(side != 0.0 && side.is_finite()) {
            return Err(Error::BadArgument { what: "the side of a manifold", value: side });
        }
        let local = LocalCurve::new(map, period, start)?;
        let start = local.reach * side.signum();
        Ok(UnstableManifold { map, local, start })
    }

    /// The saddle.
    pub fn saddle(&self) -> &BranchPoint {
        &self.local.saddle
    }

    /// Why the map has no further images, if it was stopped.
    pub(super) fn stopped(&self) -> Option<Error> {
        self.map.stopped()
    }

    /// The multiplier of g: of f²ⁿ, if that of fⁿ is negative.
    pub fn multiplier(&self) -> f64 {
        self.local.multiplier
    }

    /// Γ(t).
    ///
    /// # Errors
    /// Those of the map; [`Error::BadArgument`] for a t that is not finite.
    pub fn at(&self, t: f64) -> Result<Vec<f64>, Error> {
        self.check(t)?;
        Ok(self.image(t, self.images(t))?.0)
    }

    /// Γ(t) and Γ′(t).
    ///
    /// # Errors
    /// Those of the map and of its derivatives.
    pub fn tangent_at(&self, t: f64) -> Result<(Vec<f64>, Vec<f64>), Error> {
        self.check(t)?;
        let images = self.images(t);
        let s = self.on_cubic(t, images);
        // The derivative of s μᵗ.
        let rate = s * pxfm::f_log(self.local.multiplier);
        let curve = (self.local.moving(s, rate), Jet::number(self.local.saddle.parameter));
        let found = curve_after(self.map, curve, images * self.local.times)?;
        Ok(found.iter().map(|jet| (jet.0[0], jet.0[1])).unzip())
    }

    /// ln |s| of Γ(t): unlike t it is smooth in the parameter, as it does not depend on the reach of the cubic.
    pub(super) fn logarithm(&self, t: f64) -> f64 {
        pxfm::f_log(self.start.abs()) + t * pxfm::f_log(self.local.multiplier)
    }

    /// The t of a logarithm.
    pub(super) fn number(&self, logarithm: f64) -> f64 {
        (logarithm - pxfm::f_log(self.start.abs())) / pxfm::f_log(self.local.multiplier)
    }

    fn check(&self, t: f64) -> Result<(), Error> {
        match t.is_finite() {
            true => Ok(()),
            false => {
                Err(Error::BadArgument { what: "the number of a point of a manifold", value: t })
            }
        }
    }

    /// The s of the point of the cubic that this number of images of g leads to Γ(t).
    fn on_cubic(&self, t: f64, images: usize) -> f64 {
        self.start * pxfm::f_pow(self.local.multiplier, t - images as f64)
    }

    /// How often g is applied on the way from the cubic to Γ(t).
    pub(super) fn images(&self, t: f64) -> usize {
        t.ceil().clamp(0.0, MOST_IMAGES) as usize
    }

    /// Γ(t) by this number of images of g, with the pieces of the map on the way.
    pub(super) fn image(&self, t: f64, images: usize) -> Result<(Vec<f64>, Vec<String>), Error> {
        let s = self.on_cubic(t, images);
        let start = (&self.local.at(s)[..], self.local.saddle.parameter);
        orbit_after(self.map, start, images * self.local.times)
    }
}

/// Images of g are not counted further than this: a manifold is long before.
const MOST_IMAGES: f64 = 1e6;
