//! The unit of an error of α′.

use passive_hopper::Slopes;

/// Units of error that α′ may have for each flight of its hop.
///
/// Chosen by measurement: the worst of the 3222 reference hops has 2.4 units a flight. A larger limit would hide
/// the loss of a digit.
pub const UNITS_PER_FLIGHT: f64 = 4.0;

/// The unit of the error of `next` = α′: the effect on α′ of half an ulp in each of α, M, α′ and α², added up.
///
/// It is [`Slopes::error_unit`]. A slope that the reference does not have counts as zero, which makes the unit smaller.
/// The unit is zero if the hopper is grounded (`None`): then there is no α′ to compare.
pub fn error_unit(
    next: Option<f64>,
    (alpha, slope_alpha): (f64, f64),
    (mass_ratio, slope_mass_ratio): (f64, f64),
) -> f64 {
    let slopes = Slopes { by_speed: slope_alpha, by_mass_ratio: slope_mass_ratio };
    next.map_or(0.0, |next| slopes.error_unit(alpha, mass_ratio, next))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_adds_four_half_ulps() {
        let half_ulp = 0.5 * f64::EPSILON;
        assert_eq!(error_unit(Some(2.0), (4.0, 0.0), (1.0, 0.0)), 10.0 * half_ulp);
        assert_eq!(error_unit(Some(2.0), (4.0, -3.0), (1.0, -5.0)), 27.0 * half_ulp);
        let tiny = error_unit(Some(1e-300), (4.0, 0.0), (1.0, 0.0));
        assert!(tiny > 0.0 && tiny < 4.1 * (0.5 * f64::EPSILON).sqrt(), "{tiny}");
        assert_eq!(error_unit(None, (4.0, 1.0), (1.0, 1.0)), 0.0);
    }
}
