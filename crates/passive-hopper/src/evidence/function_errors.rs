//! The errors of sines and cosines against longer arithmetic.

use crate::evidence::compared::Compared;
use crate::evidence::solver::Solver;
use crate::kernel::scalar::half_angle::{HalfAngle, SINE_ULPS};
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

/// The errors of sin `x` and cos `x` as `solver` computes them, against `reference`.
///
/// The bounds are: for the kernel 2 ulps, for 0 < x < 2²⁰; for the general solver half an ulp; for an arithmetic with
/// relative error e its e (1 + |x|), since it subtracts a multiple of π that is right to e of its size.
///
/// `None` unless `reference` is a longer arithmetic than `solver`, and for an `x` that is not finite.
///
/// ```
/// use passive_hopper::{Solver, sine_errors};
/// let errors = sine_errors(10.0, Solver::Kernel, Solver::Bits106).expect("106 bits are longer");
/// assert!(errors.sin.ratio() <= 1.0 && errors.cos.ratio() <= 1.0);
/// assert_eq!(sine_errors(10.0, Solver::Bits256, Solver::Bits106), None);
/// ```
pub fn sine_errors(x: f64, solver: Solver, reference: Solver) -> Option<SineErrors> {
    if reference <= solver || !x.is_finite() {
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
}
