//! A hop in longer arithmetic, and the actual errors of shorter ways against it.

use crate::error::Error;
use crate::evidence::compared::Compared;
use crate::evidence::solver::Solver;
use crate::evidence::traced_hop::{
    TracedHop, TracedLanding, extended_trace, general_trace, kernel_trace,
};
use crate::landing::first_flight_table::{
    BEYOND_FLOOR, FirstFlight, TABLE_ULPS, TablePosition, fixed_points,
};
use crate::landing::flight_derivative::Variation;
use crate::landing::next_landing::MaximumTest;
use crate::map::lift_off_map::LiftOffMap;
use crate::map::limits::LARGEST_PLAIN_SPEED;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::{Extended, Real};
use std::f64::consts::PI;

/// A hop in longer arithmetic. Other ways to compute the same hop are compared with it.
#[derive(Debug, Clone)]
pub struct ReferenceHop {
    map: LiftOffMap,
    trace: ReferenceTrace,
}

/// A hop in one of the longer arithmetics.
#[derive(Debug, Clone)]
enum ReferenceTrace {
    Bits106(TracedHop<DoubleDouble>),
    Bits256(TracedHop<Long<4>>),
    Bits512(TracedHop<Long<8>>),
    Bits1024(TracedHop<Long<16>>),
}

/// The errors of one way to compute a hop, with their bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct HopErrors {
    /// Whether both hops have the same number of sudden lift-offs, and both or neither end grounded. If false, a
    /// decision is wrong, and the following landings are not compared.
    pub same_decisions: bool,
    /// The landings of the hop.
    pub landings: Vec<LandingErrors>,
    /// α′²/α².
    pub ratio: Compared,
    /// α′; `None` if the hopper is grounded.
    pub next: Option<Compared>,
}

/// The errors of one landing, with their bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LandingErrors {
    /// x′; `None` in a hop without sudden lift-off.
    pub excess: Option<Compared>,
    /// V′; `None` in a hop without sudden lift-off.
    pub velocity: Option<Compared>,
    /// μ Γ²/α².
    pub loss: Compared,
    /// The number that decides on which branch the flight lands; `None` if only one branch was possible, and for a
    /// longer arithmetic, where this number is rounded to an `f64` after the decision.
    pub maximum_test: Option<Compared>,
}

/// The errors of the table of the first flight, with their bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstFlightErrors {
    /// Γ.
    pub closing_speed: Compared,
    /// α − h, h half the time of flight.
    pub beyond: Compared,
}

impl LiftOffMap {
    /// The hop that starts with speed `alpha` in one of the longer arithmetics, for comparison.
    ///
    /// `None` if the hop has more sudden lift-offs than the arithmetic allows, if one of its decisions is inconclusive,
    /// or if `arithmetic` is one of the ways in `f64`.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio, Solver};
    /// let map = LiftOffMap::new(MassRatio::new(0.2)?);
    /// let reference = map.reference_hop(4.4, Solver::Bits256)?.expect("256 bits decide");
    /// let errors = reference.errors_of(Solver::General)?.expect("and so do 53");
    /// assert!(errors.same_decisions && errors.landings.len() == 2);
    /// assert!(errors.next.expect("it hops again").ratio() <= 1.0);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`hop`](Self::hop).
    pub fn reference_hop(
        &self,
        alpha: f64,
        arithmetic: Solver,
    ) -> Result<Option<ReferenceHop>, Error> {
        let trace = match arithmetic {
            Solver::Kernel | Solver::General => None,
            Solver::Bits106 => certain(self, alpha)?.map(ReferenceTrace::Bits106),
            Solver::Bits256 => certain(self, alpha)?.map(ReferenceTrace::Bits256),
            Solver::Bits512 => certain(self, alpha)?.map(ReferenceTrace::Bits512),
            Solver::Bits1024 => certain(self, alpha)?.map(ReferenceTrace::Bits1024),
        };
        Ok(trace.map(|trace| ReferenceHop { map: *self, trace }))
    }
}

/// The hop in the arithmetic `R`, or `None` if it is not certain there.
fn certain<R: Extended>(map: &LiftOffMap, alpha: f64) -> Result<Option<TracedHop<R>>, Error> {
    let traced = extended_trace::<R>(map, alpha)?;
    Ok(traced.map(|(_, trace)| trace).filter(|trace| trace.certain))
}

impl ReferenceHop {
    /// The errors of the same hop computed by `solver`.
    ///
    /// `None` if a decision is inconclusive in `solver`: another way then computes the hop.
    ///
    /// # Errors
    /// The errors of [`LiftOffMap::hop`].
    pub fn errors_of(&self, solver: Solver) -> Result<Option<HopErrors>, Error> {
        match &self.trace {
            ReferenceTrace::Bits106(exact) => self.errors_against(solver, exact),
            ReferenceTrace::Bits256(exact) => self.errors_against(solver, exact),
            ReferenceTrace::Bits512(exact) => self.errors_against(solver, exact),
            ReferenceTrace::Bits1024(exact) => self.errors_against(solver, exact),
        }
    }

    /// The errors of Γ and α − h of the first flight as the kernel's table gives them; `None` for a speed outside
    /// the table.
    pub fn first_flight_errors(&self) -> Option<FirstFlightErrors> {
        match &self.trace {
            ReferenceTrace::Bits106(exact) => first_flight_errors(exact),
            ReferenceTrace::Bits256(exact) => first_flight_errors(exact),
            ReferenceTrace::Bits512(exact) => first_flight_errors(exact),
            ReferenceTrace::Bits1024(exact) => first_flight_errors(exact),
        }
    }

    fn errors_against<E: Extended>(
        &self,
        solver: Solver,
        exact: &TracedHop<E>,
    ) -> Result<Option<HopErrors>, Error> {
        let (map, alpha) = (&self.map, exact.alpha);
        let plain = |(_, trace): (_, TracedHop<f64>)| errors(&trace, exact, true);
        Ok(match solver {
            Solver::Kernel => kernel_trace(map, alpha).and_then(plain),
            // Faster hops are computed in longer arithmetic from the start.
            Solver::General if alpha > LARGEST_PLAIN_SPEED => None,
            Solver::General => plain(general_trace(map, alpha)?),
            Solver::Bits106 => extended_errors::<DoubleDouble, E>(map, exact)?,
            Solver::Bits256 => extended_errors::<Long<4>, E>(map, exact)?,
            Solver::Bits512 => extended_errors::<Long<8>, E>(map, exact)?,
            Solver::Bits1024 => extended_errors::<Long<16>, E>(map, exact)?,
        })
    }
}

/// The table's bounds are those of `landing/first_flight_table.rs`.
fn first_flight_errors<E: Extended>(exact: &TracedHop<E>) -> Option<FirstFlightErrors> {
    let alpha = exact.alpha;
    let FirstFlight { beyond, closing_speed, .. } =
        TablePosition::of(alpha, fixed_points()).first_flight(alpha)?;
    let landing = exact.landings.first()?;
    // A backward error e of V changes h by eD/Γ and Γ by at most e (1 + τ)²/Γ. The numbers of the longer arithmetic
    // have some ulps of e; 64 is far more. The table begins 2⁻¹³ from α*_n, where Γ is not small.
    let size = 1.0 + landing.time.nearest();
    let reference_bound = 64.0 * E::EPSILON * size * size * size / closing_speed;
    let ulps = TABLE_ULPS * f64::EPSILON;
    let exact_beyond = -(landing.time * 0.5) + alpha;
    Some(FirstFlightErrors {
        closing_speed: Compared::of(
            (closing_speed, ulps * closing_speed),
            (landing.closing_speed, reference_bound),
        ),
        beyond: Compared::of(
            (beyond, ulps * (beyond.abs() + BEYOND_FLOOR)),
            (exact_beyond, reference_bound),
        ),
    })
}

fn extended_errors<C: Extended, E: Extended>(
    map: &LiftOffMap,
    exact: &TracedHop<E>,
) -> Result<Option<HopErrors>, Error> {
    let traced = extended_trace::<C>(map, exact.alpha)?;
    Ok(traced.and_then(|(_, trace)| errors(&trace, exact, false)))
}

/// The errors of a hop; `None` if it is not certain.
fn errors<C: Real, E: Extended>(
    computed: &TracedHop<C>,
    exact: &TracedHop<E>,
    in_f64: bool,
) -> Option<HopErrors> {
    if !computed.certain {
        return None;
    }
    let same_decisions =
        computed.sudden == exact.sudden && computed.next.is_some() == exact.next.is_some();
    let mut starts = (0.0, 0.0);
    let landings = computed.landings.iter().zip(&exact.landings).map(|(landing, same)| {
        let errors = landing_errors(landing, same, starts, (exact.sudden > 0, in_f64));
        starts = (landing.velocity.nearest(), same.velocity.nearest());
        errors
    });
    let landings = landings.collect();
    let ratio =
        Compared::of((computed.ratio, computed.ratio_error), (exact.ratio, exact.ratio_error));
    let next = computed.bounded_next().zip(exact.bounded_next());
    let next = next.map(|(next, same)| Compared::of(next, same));
    Some(HopErrors { same_decisions, landings, ratio, next })
}

/// The errors of a landing whose flights start with the velocities `starts`.
fn landing_errors<C: Real, E: Extended>(
    landing: &TracedLanding<C>,
    same: &TracedLanding<E>,
    starts: (f64, f64),
    (is_sudden, in_f64): (bool, bool),
) -> LandingErrors {
    let state = |of: fn(Variation) -> f64, computed: C, exact: E| {
        let bounds = (of(landing.state_error), of(same.state_error));
        is_sudden.then(|| Compared::of((computed, bounds.0), (exact, bounds.1)))
    };
    let tests = landing.maximum_test.zip(same.maximum_test).filter(|_| in_f64);
    LandingErrors {
        excess: state(|error| error.excess, landing.excess, same.excess),
        velocity: state(|error| error.velocity, landing.velocity, same.velocity),
        loss: Compared::of((landing.loss, landing.loss_error), (same.loss, same.loss_error)),
        maximum_test: tests.map(|tests| test(tests, starts)),
    }
}

/// The error of a maximum test. The longer test is rounded to an `f64`, which adds half an ulp to its bound.
///
/// The sign (−1)^m of a test is that of m = ⌊V/π⌋. If rounding moves V across a multiple of π, the two numbers have
/// opposite signs and mean the same branch: the one before the maximum of branch m, or the one after that of m − 1.
fn test((test, exact): (MaximumTest, MaximumTest), (v, exact_v): (f64, f64)) -> Compared {
    let same_parity = (v / PI).floor() == (exact_v / PI).floor();
    let exact_value = if same_parity { exact.value } else { -exact.value };
    Compared {
        error: (test.value - exact_value).abs(),
        bound: test.error,
        reference_bound: exact.error + 0.5 * f64::EPSILON * exact.value.abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::mass_ratio::MassRatio;

    /// (M, α) with hops of all kinds: contact only, one sudden lift-off, chains, slow and fast.
    const HOPS: [(f64, f64); 7] =
        [(0.2, 5.5), (0.2, 4.4), (1.0, 100.0), (3.0, 17.2), (30.0, 50.1), (0.5, 1e-3), (2.0, 1e5)];

    #[test]
    fn every_way_meets_its_bounds_against_every_longer_one() {
        let ways = [Solver::Kernel, Solver::General, Solver::Bits106, Solver::Bits256];
        for (m, alpha) in HOPS {
            let map = LiftOffMap::new(MassRatio::new(m).unwrap());
            for (index, arithmetic) in
                [(2, Solver::Bits106), (3, Solver::Bits256), (4, Solver::Bits512)]
            {
                let Some(reference) = map.reference_hop(alpha, arithmetic).unwrap() else {
                    continue;
                };
                for solver in &ways[..index] {
                    let Some(errors) = reference.errors_of(*solver).unwrap() else { continue };
                    assert!(errors.same_decisions);
                    let of_landings = errors.landings.iter().flat_map(|landing| {
                        let LandingErrors { excess, velocity, loss, maximum_test } = *landing;
                        [excess, velocity, Some(loss), maximum_test]
                    });
                    for found in of_landings.flatten().chain([errors.ratio]).chain(errors.next) {
                        assert!(
                            found.ratio() <= 1.0,
                            "{m} {alpha} {solver:?} {arithmetic:?}: {found:?}"
                        );
                    }
                }
            }
        }
    }

    /// The errors are actual ones: with 1/1000 of its bound, no quantity of these hops would pass.
    #[test]
    fn errors_are_not_all_zero() {
        let map = LiftOffMap::new(MassRatio::new(3.0).unwrap());
        let reference = map.reference_hop(17.2, Solver::Bits256).unwrap().unwrap();
        let errors = reference.errors_of(Solver::General).unwrap().unwrap();
        assert!(errors.landings.iter().any(|landing| landing.loss.error > 0.0));
        assert!(errors.ratio.error > 0.0 && errors.ratio.error < 1e-12);
    }

    #[test]
    fn a_way_in_f64_is_no_reference() {
        let map = LiftOffMap::new(MassRatio::ONE);
        for solver in [Solver::Kernel, Solver::General] {
            assert!(map.reference_hop(5.0, solver).unwrap().is_none());
        }
        assert!(map.reference_hop(-1.0, Solver::Bits106).is_err());
    }
}
