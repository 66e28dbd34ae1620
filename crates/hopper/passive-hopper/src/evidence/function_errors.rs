//! The errors of sines and cosines against longer arithmetic.

use crate::evidence::compared::Compared;
use crate::evidence::solver::Solver;
use crate::kernel::scalar::half_angle::{HalfAngle, SINE_ULPS};
use crate::model::motion::LARGEST_LIFT_OFF_SPEED;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::{Extended, Real};

/// The errors of a sine and a cosine, with their bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SineErrors {
    /// Of the sine.
    pub sin: Compared,
    /// Of the cosine.
    pub cos: Compared,
}

/// The kernel reduces arguments below 2²⁰ exactly (`HalfAngle::at`).
const KERNEL_ARGUMENTS: f64 = 1_048_576.0;

/// More than half the time of flight of the fastest hop. Far beyond, the reduction by a multiple of π, which is an
/// `f64`, leaves a large argument, and the series of a sine has as many terms.
const LARGEST_ARGUMENT: f64 = 2.0 * LARGEST_LIFT_OFF_SPEED;

/// The errors of sin `x` and cos `x` as `solver` computes them, against `reference`.
///
/// The bounds are: for the kernel 2 ulps, for 0 < x < 2²⁰; for the general solver half an ulp; for an arithmetic with
/// relative error e its e (1 + |x|), since it subtracts a multiple of π that is right to e of its size.
///
/// `None` unless `reference` is a longer arithmetic than `solver`, and for an `x` outside the domain of `solver`: 0
/// < x < 2²⁰ for the kernel, |x| ≤ 2⁴⁴ for the other ways.
///
/// ```
/// use passive_hopper::{Solver, sine_errors};
/// let errors = sine_errors(10.0, Solver::Kernel, Solver::Bits106).expect("106 bits are longer");
/// assert!(errors.sin.ratio() <= 1.0 && errors.cos.ratio() <= 1.0);
/// assert_eq!(sine_errors(10.0, Solver::Bits256, Solver::Bits106), None);
/// ```
pub fn sine_errors(x: f64, solver: Solver, reference: Solver) -> Option<SineErrors> {
    let in_domain = match solver {
        Solver::Kernel => x > 0.0 && x < KERNEL_ARGUMENTS,
        _ => x.abs() <= LARGEST_ARGUMENT,
    };
    if reference <= solver || !in_domain {
        return None;
    }
    match reference {
        Solver::Kernel | Solver::General => None,
        Solver::Bits106 => Some(errors(x, solver, bounded::<DoubleDouble>(x))),
        Solver::Bits256 => Some(errors(x, solver, bounded::<Long<4>>(x))),
        Solver::Bits512 => Some(errors(x, solver, bounded::<Long<8>>(x))),
        Solver::Bits1024 => Some(errors(x, solver, bounded::<Long<16>>(x))),
    }
}

/// Sine and cosine, each with its bound.
type Bounded<R> = [(R, f64); 2];

/// Sine and cosine in the arithmetic `R`.
fn bounded<R: Extended>(x: f64) -> Bounded<R> {
    let (sin, cos) = R::from(x).sin_cos();
    let bound = R::EPSILON * (1.0 + x.abs());
    [(sin, bound), (cos, bound)]
}

/// Sine and cosine in `f64`, to this number of ulps.
fn rounded((sin, cos): (f64, f64), ulps: f64) -> Bounded<f64> {
    [sin, cos].map(|value| (value, ulps * f64::EPSILON * value.abs()))
}

fn errors<E: Extended>(x: f64, solver: Solver, exact: Bounded<E>) -> SineErrors {
    match solver {
        Solver::Kernel => {
            let HalfAngle { sin, cos, .. } = HalfAngle::at(x);
            compared(rounded((sin, cos), SINE_ULPS), exact)
        }
        Solver::General => compared(rounded(pxfm::f_sincos(x), 0.5), exact),
        Solver::Bits106 => compared(bounded::<DoubleDouble>(x), exact),
        Solver::Bits256 => compared(bounded::<Long<4>>(x), exact),
        Solver::Bits512 => compared(bounded::<Long<8>>(x), exact),
        Solver::Bits1024 => compared(bounded::<Long<16>>(x), exact),
    }
}

fn compared<C: Real, E: Extended>(computed: Bounded<C>, exact: Bounded<E>) -> SineErrors {
    let [(sin, sin_exact), (cos, cos_exact)] = [(computed[0], exact[0]), (computed[1], exact[1])];
    SineErrors { sin: Compared::of(sin, sin_exact), cos: Compared::of(cos, cos_exact) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn all_sines_meet_their_bounds_next_to_their_zeros() {
        let ways = [Solver::Kernel, Solver::General, Solver::Bits106, Solver::Bits256];
        for x in [1e-9, 0.5 * PI, PI, 3.0 * PI, 100.5 * PI, 1e3] {
            for solver in ways {
                let found = sine_errors(x, solver, Solver::Bits512).unwrap();
                assert!(found.sin.ratio() <= 1.0 && found.cos.ratio() <= 1.0, "{x} {solver:?}");
            }
        }
        assert!(sine_errors(3.0, Solver::General, Solver::Bits106).unwrap().sin.error > 0.0);
        assert_eq!(sine_errors(f64::NAN, Solver::General, Solver::Bits106), None);
        assert_eq!(sine_errors(1.0, Solver::Bits256, Solver::Bits256), None);
    }

    /// At 10⁵⁰ the series of the longer arithmetics would have 10³³ terms.
    #[test]
    fn arguments_outside_the_domain_give_nothing() {
        let outside = [f64::NAN, f64::INFINITY, -1e300, 1e50, LARGEST_ARGUMENT.next_up()];
        for x in outside {
            for solver in [Solver::Kernel, Solver::General, Solver::Bits106, Solver::Bits512] {
                assert_eq!(sine_errors(x, solver, Solver::Bits1024), None, "{x} {solver:?}");
            }
        }
        for x in [0.0, -1.0, KERNEL_ARGUMENTS] {
            assert_eq!(sine_errors(x, Solver::Kernel, Solver::Bits256), None, "{x}");
            assert!(sine_errors(x, Solver::General, Solver::Bits256).is_some(), "{x}");
        }
        for x in [LARGEST_ARGUMENT, -LARGEST_ARGUMENT] {
            let found = sine_errors(x, Solver::General, Solver::Bits256).unwrap();
            assert!(found.sin.ratio() <= 1.0 && found.cos.ratio() <= 1.0, "{x}");
        }
    }
}
