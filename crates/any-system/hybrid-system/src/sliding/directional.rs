//! The derivative of a function of the state along a direction, by differences, with an estimate of its error.

use crate::state::StateVector;

/// A number with an estimate of its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Estimate {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

impl Estimate {
    /// The sign of the number, ±1; `None` if the error hides it, or if the number is NaN.
    pub(crate) fn sign(self) -> Option<f64> {
        (self.value.abs() > self.error).then(|| self.value.signum())
    }

    /// True if the number is zero within its error. False for NaN.
    pub(crate) fn is_hidden(self) -> bool {
        self.value.abs() <= self.error
    }
}

/// The weights of the central difference of order eight, for displacements of 1, 2, 3 and 4 times h:
/// φ′(0) ≈ Σ wₖ (φ(kh) − φ(−kh))/h. The error is h⁸ φ⁽⁹⁾/630.
const ORDER_EIGHT: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// The weights of the central difference of order six. Its distance from the one of order eight shows whether the
/// function is smooth over the displacements.
const ORDER_SIX: [f64; 4] = [3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0];

/// The displacements kh that are tried one after the other, h as a part of the size of the state: 2⁻⁶, 2⁻¹⁰ … 2⁻²⁶.
/// The first one is exact to rounding for functions that change over distances of the size of the state. Rounding
/// grows like 1/h, to 2⁻⁵²/2⁻⁶ ≈ 10⁻¹⁴ of the function. The smaller ones serve functions that bend, or are not
/// defined, nearer to the state, and lose digits. Below the last one fewer than seven digits would be left.
const REACHES: [i32; 6] = [-6, -10, -14, -18, -22, -26];

/// Two differences that agree within this multiple of their rounding are as good as rounding allows.
const AGREEMENT: f64 = 8.0;

/// Relative rounding of a difference: the products and sums with the four weights.
const RELATIVE_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The derivative of `function` at `state` along `direction`, d/ds f(x + s d) at s = 0. The `rounding` of a value
/// of the function enters the error; with 0 only the roundings of sums and products enter.
///
/// A direction of zeros gives exactly 0. A function or direction that is not finite gives NaN.
pub(crate) fn slope_along<X: StateVector>(
    function: &dyn Fn(&X) -> f64,
    state: &X,
    direction: &X,
    rounding: f64,
) -> Estimate {
    // The unit of s: with it every component moves by its own size at most, 1 for components below 1.
    let sizes = state.components().iter().zip(direction.components());
    let unit = sizes.fold(f64::INFINITY, |unit: f64, (component, rate)| {
        let time = (1.0 + component.abs()) / rate.abs();
        // A rate of zero gives infinity, which does not limit the unit; NaN is kept.
        if time < unit || time.is_nan() { time } else { unit }
    });
    if direction.components().iter().all(|rate| *rate == 0.0) {
        return Estimate { value: 0.0, error: 0.0 };
    }
    if !(unit > 0.0 && unit.is_finite()) {
        return Estimate { value: f64::NAN, error: f64::NAN };
    }
    let along = |parameter: f64| {
        let mut moved = state.clone();
        moved.add_scaled(parameter, direction);
        function(&moved)
    };
    let mut best = Estimate { value: f64::NAN, error: f64::INFINITY };
    for reach in REACHES {
        let step = unit * 2f64.powi(reach);
        let (mut eight, mut six, mut size) = (0.0, 0.0, 0.0);
        for (k, (weight, lower)) in ORDER_EIGHT.iter().zip(ORDER_SIX).enumerate() {
            let distance = (k + 1) as f64 * step;
            let (ahead, behind) = (along(distance), along(-distance));
            eight += weight * (ahead - behind);
            six += lower * (ahead - behind);
            size += weight.abs() * (ahead.abs() + behind.abs());
        }
        let noise = (RELATIVE_ROUNDING * size + 2.0 * rounding) / step;
        let (value, truncation) = (eight / step, (eight - six).abs() / step);
        let error = truncation + noise;
        if error < best.error {
            best = Estimate { value, error };
        }
        if truncation <= AGREEMENT * noise {
            break;
        }
    }
    if best.value.is_nan() { Estimate { value: f64::NAN, error: f64::NAN } } else { best }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    #[test]
    fn a_linear_function_has_its_own_slope_within_the_error() {
        let at = Vector2::new(0.3, -7.0);
        let slope = slope_along(
            &|x: &Vector2<f64>| 3.0 * x[0] - x[1] + 6.0,
            &at,
            &Vector2::new(2.0, 0.5),
            0.0,
        );
        assert!((slope.value - 5.5).abs() <= slope.error);
        assert!(slope.error < 1e-11, "{slope:?}");
    }

    #[test]
    fn a_curved_function_has_thirteen_digits() {
        let at = Vector2::new(0.3, -7.0);
        let value = |x: &Vector2<f64>| pxfm::f_sin(x[0]) * x[1] + x[1] * x[1];
        let slope = slope_along(&value, &at, &Vector2::new(2.0, 0.5), 0.0);
        let exact = 2.0 * pxfm::f_cos(0.3) * -7.0 + 0.5 * (pxfm::f_sin(0.3) - 14.0);
        assert!((slope.value - exact).abs() < 1e-12, "{slope:?} {exact}");
        assert!((slope.value - exact).abs() <= slope.error, "{slope:?} {exact}");
    }

    /// sin 1000x bends within a hundredth of the size of the state.
    #[test]
    fn a_function_that_bends_over_short_distances_is_resolved() {
        let at = Vector2::new(0.3, 1.0);
        let slope = slope_along(
            &|x: &Vector2<f64>| pxfm::f_sin(1000.0 * x[0]),
            &at,
            &Vector2::new(1.0, 0.0),
            0.0,
        );
        let exact = 1000.0 * pxfm::f_cos(300.0);
        assert!((slope.value / exact - 1.0).abs() < 1e-9, "{slope:?} {exact}");
        assert!((slope.value - exact).abs() <= slope.error, "{slope:?} {exact}");
    }

    /// √x is not defined at a distance of 10⁻³ below the state.
    #[test]
    fn a_function_that_ends_nearby_still_has_a_slope() {
        let at = Vector2::new(1e-3, 1.0);
        let slope = slope_along(&|x: &Vector2<f64>| x[0].sqrt(), &at, &Vector2::new(1.0, 0.0), 0.0);
        let exact = 0.5 / 1e-3f64.sqrt();
        assert!((slope.value / exact - 1.0).abs() < 1e-9, "{slope:?} {exact}");
    }

    #[test]
    fn zero_directions_and_values_that_are_no_numbers() {
        let at = Vector2::new(1.0, 1.0);
        let zero = slope_along(&|x: &Vector2<f64>| x[0], &at, &Vector2::zeros(), 0.0);
        assert_eq!(zero, Estimate { value: 0.0, error: 0.0 });
        assert_eq!(zero.sign(), None);
        for (function, direction) in
            [(f64::NAN, Vector2::new(1.0, 0.0)), (1.0, Vector2::new(f64::NAN, 1.0))]
        {
            let slope = slope_along(&|x: &Vector2<f64>| function * x[0], &at, &direction, 0.0);
            assert!(slope.value.is_nan() && slope.sign().is_none() && !slope.is_hidden());
        }
    }

    /// At a kink the differences of both orders disagree by as much as they are wrong.
    #[test]
    fn a_kink_has_an_error_as_large_as_the_slope() {
        let at = Vector2::new(0.0, 1.0);
        let ramp = |x: &Vector2<f64>| if x[0] > 0.0 { x[0] } else { 0.0 };
        let slope = slope_along(&ramp, &at, &Vector2::new(1.0, 0.0), 0.0);
        assert!((slope.value - 0.5).abs() < 1e-12);
    }
}
