//! A hop with bounds on its errors.

use crate::error::Error;
use crate::evidence::solver::Solver;
use crate::evidence::traced_hop::{TracedHop, extended_trace, general_trace, kernel_trace};
use crate::landing::flight_ends::Landing;
use crate::landing::next_landing::MaximumTest;
use crate::map::lift_off_map::{Hop, LiftOffMap};
use crate::map::limits::LARGEST_PLAIN_SPEED;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::{Extended, Real};

/// A hop with bounds on its errors.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundedHop {
    /// The hop, as [`LiftOffMap::hop`] gives it.
    pub hop: Hop,
    /// The way in which it was computed.
    pub solver: Solver,
    /// Bound on |α′ − exact α′|, with M and α taken as exact; `None` if the hopper is grounded.
    pub next_error: Option<f64>,
    /// Bound on the error of α′²/α² = 1 − Σ μ Γ²/α². A value above this number, or below its negative, decides whether
    /// the hopper is grounded.
    pub ratio_error: f64,
    /// The landings, one after the other. All but the last are sudden. If x′ of the last one rounds to zero, it is
    /// sudden as well, and the flight after it is left out: it is too short for an `f64` and loses no energy.
    pub landings: Vec<BoundedLanding>,
}

/// A landing with bounds on its errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundedLanding {
    /// The landing, as `solver` found it.
    pub landing: Landing,
    /// Bounds on the errors of x′ and V′; `None` in a hop without sudden lift-off. Then energy gives α′
    /// without x′ and V′.
    pub state_error: Option<StateError>,
    /// Bound on the error of μ Γ²/α², the part of the energy α² that the landing takes.
    pub loss_error: f64,
    /// The test that chose the branch on which the flight lands; `None` if only one branch was possible.
    pub maximum_test: Option<MaximumTest>,
}

/// Bounds on the errors of the state after a landing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateError {
    /// Bound on the error of x′.
    pub excess: f64,
    /// Bound on the error of V′.
    pub velocity: f64,
}

impl LiftOffMap {
    /// The hop that starts with speed `alpha`, with bounds on the errors of every landing and of α′.
    ///
    /// The bounds hold for the exact map at the exact `alpha` and M. They are derived in docs/theory.md (Theorem 60
    /// and Lemma 61 for a landing, Theorem 66 for the whole hop), and measured by `cargo xtask check-bounds`. The
    /// function takes about a microsecond more than [`hop`](Self::hop).
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::new(0.2)?);
    /// let bounded = map.bounded_hop(5.5)?;
    /// // α′ has 40 known digits: 3.783365713345068….
    /// let next = bounded.hop.next.expect("hops again");
    /// let error = bounded.next_error.expect("hops again");
    /// assert!((next - 3.783365713345068).abs() <= error && error < 1e-13);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`hop`](Self::hop).
    pub fn bounded_hop(&self, alpha: f64) -> Result<BoundedHop, Error> {
        if let Some((hop, trace)) = kernel_trace(self, alpha) {
            return Ok(bounded(hop, Solver::Kernel, &trace));
        }
        if !(alpha > LARGEST_PLAIN_SPEED) {
            let (hop, trace) = general_trace(self, alpha)?;
            if trace.certain {
                return Ok(bounded(hop, Solver::General, &trace));
            }
            if hop.sudden > DoubleDouble::SUDDEN_BUDGET {
                return Err(Error::Undecided { alpha, sudden: hop.sudden });
            }
        }
        let ways: [(Solver, Way); 4] = [
            (Solver::Bits106, bounded_in::<DoubleDouble>),
            (Solver::Bits256, bounded_in::<Long<4>>),
            (Solver::Bits512, bounded_in::<Long<8>>),
            (Solver::Bits1024, bounded_in::<Long<16>>),
        ];
        let (mut best, mut sudden) = (None, DoubleDouble::SUDDEN_BUDGET);
        for (solver, way) in ways {
            // An arithmetic whose budget of lift-offs the hop exceeds leaves the result of the shorter one.
            let Some((found, certain, precise)) = way(self, alpha, solver)? else { continue };
            sudden = found.hop.sudden;
            best = certain.then_some(found);
            if certain && precise {
                break;
            }
        }
        best.ok_or(Error::Undecided { alpha, sudden })
    }
}

/// The bounded hop in one arithmetic, whether its decisions are conclusive, and whether no digit needs a longer one.
type Way = fn(&LiftOffMap, f64, Solver) -> Result<Option<(BoundedHop, bool, bool)>, Error>;

fn bounded_in<R: Extended>(
    map: &LiftOffMap,
    alpha: f64,
    solver: Solver,
) -> Result<Option<(BoundedHop, bool, bool)>, Error> {
    let traced = extended_trace::<R>(map, alpha)?;
    Ok(traced.map(|(found, trace)| {
        let hop = map.rounded(alpha, &found);
        (bounded(hop, solver, &trace), found.certain, found.precise)
    }))
}

/// The hop with the bounds of its trace. Numbers of a longer arithmetic are rounded, which adds to their bounds.
fn bounded<R: Real>(hop: Hop, solver: Solver, trace: &TracedHop<R>) -> BoundedHop {
    let rounding = if solver > Solver::General { 0.5 * f64::EPSILON } else { 0.0 };
    let landings = trace.landings.iter().enumerate().map(|(index, traced)| {
        let landing = Landing {
            time: traced.time.nearest(),
            closing_speed: traced.closing_speed.nearest(),
            excess: traced.excess.nearest(),
            velocity: traced.velocity.nearest(),
            sudden: index < hop.sudden,
        };
        let state_error = (hop.sudden > 0).then(|| StateError {
            excess: traced.state_error.excess + rounding * landing.excess.abs(),
            velocity: traced.state_error.velocity + rounding * landing.velocity.abs(),
        });
        let loss_error = traced.loss_error;
        BoundedLanding { landing, state_error, loss_error, maximum_test: traced.maximum_test }
    });
    let next_error =
        trace.bounded_next().zip(hop.next).map(|((_, error), next)| error + rounding * next);
    let landings = landings.collect();
    BoundedHop { hop, solver, next_error, ratio_error: trace.ratio_error, landings }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::fixed_points::{alpha_star, n_pi};
    use crate::model::mass_ratio::MassRatio;

    /// Hops that the kernel, the general solver and longer arithmetics compute.
    fn starts() -> impl Iterator<Item = (f64, f64)> {
        let masses = [1e-6, 0.1, 0.9, 1.0, 2.5, 40.0, 1e4];
        let near = |n: u64, ulps: i64| {
            let moved = |x: f64| f64::from_bits((x.to_bits() as i64 + ulps) as u64);
            [moved(alpha_star(n)), moved(n_pi(n).high)]
        };
        let hard = [1, 2, 7].into_iter().flat_map(move |n| [-40, -1, 0, 1].map(|u| near(n, u)));
        let easy = (1..200).map(|k| 0.31 * f64::from(k));
        let all = easy.chain(hard.flatten()).chain([1e-300, 1e-5, 2e4, 3e9]);
        all.flat_map(move |alpha| masses.map(|m| (m, alpha)))
    }

    #[test]
    fn the_hop_is_the_one_of_hop() {
        let mut solvers = std::collections::BTreeSet::new();
        for (m, alpha) in starts() {
            let map = LiftOffMap::new(MassRatio::new(m).unwrap());
            let bounded = map.bounded_hop(alpha).unwrap();
            assert_eq!(bounded.hop, map.hop(alpha).unwrap(), "{m} {alpha}");
            let landings = bounded.landings.len();
            assert!(landings == bounded.hop.sudden + 1 || landings == bounded.hop.sudden);
            assert_eq!(bounded.next_error.is_some(), bounded.hop.next.is_some());
            solvers.insert(bounded.solver);
        }
        for solver in [Solver::Kernel, Solver::General, Solver::Bits106] {
            assert!(solvers.contains(&solver), "{solvers:?}");
        }
    }

    /// A hop whose landing decides by the margin of its bound has a large bound on α′, and a plain one some ulps.
    #[test]
    fn the_bound_is_some_ulps_for_a_plain_hop() {
        let bounded = LiftOffMap::new(MassRatio::ONE).bounded_hop(10.0).unwrap();
        let next = bounded.hop.next.unwrap();
        let error = bounded.next_error.unwrap();
        assert!(error >= f64::EPSILON * next && error < 3e3 * f64::EPSILON * 10.0, "{error:e}");
        assert!(bounded.landings.last().unwrap().loss_error <= bounded.ratio_error);
    }
}
