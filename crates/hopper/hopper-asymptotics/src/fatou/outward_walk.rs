//! Single hops along the slow side, fast and with a tight error: from where a jump ends to where the orbit leaves.
//!
//! The hop is a pair of polynomials in |t| (`local_hop_model.rs`). The general bound of a hop doubles the error of
//! the speed at each of these hops. Here the error grows by the slope of the map, as it does in truth.

use crate::coefficients::{Coefficients, Form};
use crate::error::Error;
use crate::fatou::local_hop_model::{LARGEST_LEFT_WIDTH, LocalHopModel, Side};
use crate::fatou::polynomial::ORDER;
use crate::fatou::taylor_model::Model;
use passive_hopper::MassRatio;

/// The largest A x. Beyond it an orbit leaves within some hops.
const LARGEST_TURN: f64 = 1.2;

/// Newton steps for |t|. The first guess errs by some 10⁻³ of it, a step squares the error and multiplies it by
/// some hundredths, and two steps reach the last bit.
const NEWTON_STEPS: usize = 2;

/// Relative rounding error of a hop's δ′ in ulps: the sums of two polynomials, a cube root, and some products.
const HOP_ULPS: f64 = 16.0;

/// Hops left of a fixed point.
#[derive(Debug, Clone, PartialEq)]
pub struct OutwardWalk {
    pub(crate) mass_ratio: MassRatio,
    pub(crate) local: Coefficients,
    /// x/|t| and (x′/x)³ − 1 as polynomials in u = |t|/`width`.
    pub(crate) hop: LocalHopModel,
    /// Bounds on the errors of both: the sums of the radii, and the rests, the first relative to x/|t|.
    radii: [f64; 2],
    rests: [f64; 2],
    /// The largest x.
    range: f64,
}

impl OutwardWalk {
    /// The hops left of α*_n.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0.
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let local = Coefficients::new(n, mass_ratio, Form::Corrected)?;
        let drift = local.left_drift();
        let width = (local.beta * LARGEST_TURN / drift).min(LARGEST_LEFT_WIDTH);
        let hop = LocalHopModel::new(&local, mass_ratio, Side::Left, width);
        let radii = |model: &Model| model.radii.iter().sum::<f64>();
        let least = hop.root.least();
        Ok(OutwardWalk {
            mass_ratio,
            local,
            radii: [radii(&hop.root) / least, radii(&hop.growth)],
            rests: [hop.root.rest / least, hop.growth.rest],
            range: width * least,
            hop,
        })
    }

    /// The largest |δ| from which a hop has a value.
    pub fn range(&self) -> f64 {
        self.range * self.range * self.range
    }

    /// The offset after a hop from all offsets within `error` of `delta` < 0, and a bound on its error; `None` beyond
    /// [`range`](Self::range), and for an error above a hundredth of |δ|.
    pub fn hop(&self, delta: f64, error: f64) -> Option<(f64, f64)> {
        let size = -delta;
        let x = pxfm::f_cbrt(size);
        if !(x > 0.0 && x <= self.range && error <= 0.01 * size) {
            return None;
        }
        // u with width · u · root(u) = x.
        let LocalHopModel { width, root: roots, growth, .. } = &self.hop;
        let target = x / width;
        let first = target / roots.terms[0];
        let mut u = first * (1.0 - first * roots.terms[1] / roots.terms[0]);
        for _ in 0..NEWTON_STEPS {
            let (root, slope) = value_and_slope(&roots.terms, u);
            u -= (u * root - target) / (root + u * slope);
        }
        let (root, root_slope) = value_and_slope(&roots.terms, u);
        let (growth, growth_slope) = value_and_slope(&growth.terms, u);
        // d ln u/d ln x, and f′ = 1 + g + (x/3) dg/dx.
        let stretch = root / (root + u * root_slope);
        let rise = growth_slope * u * stretch / 3.0;
        let slope = 1.0 + growth + rise;
        let next = delta * (1.0 + growth);
        // The slope grows by at most 4/3 of a part of δ over the error. A part of u is a part of the growth, whose
        // logarithmic slope is at most 3.
        let spread = 1.0 + 2.0 * error / size;
        let power = u.powi(ORDER as i32);
        let [root_error, growth_error] = [0, 1].map(|of| self.radii[of] + self.rests[of] * power);
        // The exact map differs from the polynomials by this, at the ends of the error by a tenth more: u is larger
        // there by less than 1 %, and u^ORDER grows most.
        let model = 1.2 * (3.0 * growth * root_error + growth_error);
        let rounding = HOP_ULPS * f64::EPSILON * (1.0 + growth);
        Some((next, slope * spread * error + size * (model + rounding)))
    }
}

/// Σ c_k u^k and its derivative, by the even and the odd terms: two chains of half the length.
fn value_and_slope(terms: &[f64; ORDER], u: f64) -> (f64, f64) {
    let v = u * u;
    let (mut even, mut even_slope, mut odd, mut odd_slope) = (0.0, 0.0, 0.0, 0.0);
    for pair in terms.as_chunks::<2>().0.iter().rev() {
        even_slope = even_slope * v + even;
        odd_slope = odd_slope * v + odd;
        even = even * v + pair[0];
        odd = odd * v + pair[1];
    }
    (even + u * odd, 2.0 * u * (even_slope + u * odd_slope) + odd)
}

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::LiftOffMap;

    /// Against hops in longer arithmetic, and the growth of an error against two neighbours.
    #[test]
    fn hops_and_their_errors_agree_with_the_map() {
        for (n, m) in [(1, 0.02), (1, 0.2), (2, 0.12), (3, 0.8), (10, 1.0), (2, 50.0), (40, 0.3)] {
            let ratio = MassRatio::new(m).unwrap();
            let walk = OutwardWalk::new(n, ratio).unwrap();
            let map = LiftOffMap::new(ratio);
            let next = |delta: f64| map.hop_near_fixed_point(n, delta).unwrap().next.unwrap();
            for k in 0..20 {
                let delta = -0.999 * walk.range() * pxfm::f_exp10(-0.3 * f64::from(k));
                let (found, error) = walk.hop(delta, 0.0).unwrap();
                let off = (found - next(delta)).abs();
                assert!(off <= error + 8.0 * f64::EPSILON * found.abs(), "{n} {m} {delta:e}");
                assert!(error <= 2e-6 * found.abs(), "{n} {m} {delta:e}: {error:e}");
                let spread = 1e-3 * -delta;
                let (found, error) = walk.hop(delta, spread).unwrap();
                let ends = [next(delta + spread), next(delta - spread)];
                let most = ends.map(|end| (end - found).abs());
                assert!(most.iter().all(|most| *most <= error), "{n} {m} {delta:e}");
                assert!(error < 1.1 * most[0].max(most[1]), "{n} {m} {delta:e}");
            }
            assert!(walk.hop(-1.01 * walk.range(), 0.0).is_none() && walk.hop(1e-9, 0.0).is_none());
            assert!(walk.hop(f64::NAN, 0.0).is_none() && walk.hop(-1e-9, f64::NAN).is_none());
        }
    }
}
