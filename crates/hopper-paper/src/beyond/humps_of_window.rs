//! Starts on the humps of the paper's window, their fates, and shares as text.

use crate::error::Error;
use basin_of_attraction::{Estimate, Interval};
use hopper_basin::{Fates, HopperFate};
use passive_hopper::{MassRatio, alpha_star};

/// The first and the last fixed point of the paper's window, [`hopper_basin::five_humps`].
pub(super) const FROM: u64 = 1;
pub(super) const TO: u64 = 6;

pub(super) fn fates(mass_ratio: f64) -> Result<Fates, Error> {
    Ok(Fates::new(MassRatio::new(mass_ratio)?)?)
}

/// The label of a start; [`HopperFate::UNDECIDED_HOP`] if the fate cannot be computed.
pub(super) fn label(fates: &Fates, alpha: f64) -> u16 {
    fates.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label)
}

pub(super) fn is_incessant(label: u16) -> bool {
    (1..=HopperFate::LARGEST_LABEL as u16).contains(&label)
}

pub(super) fn hump(n: u64) -> Result<Interval, Error> {
    Ok(Interval::new(alpha_star(n).high, alpha_star(n + 1).high)?)
}

/// The speed at a place in [0, `TO` − `FROM`], where each hump of the window has length one.
///
/// The paper gives each hump the same weight, whatever its length.
pub(super) fn by_humps(place: f64) -> f64 {
    let whole = (place.floor() as u64).min(TO - FROM - 1);
    let (left, right) = (alpha_star(FROM + whole).high, alpha_star(FROM + whole + 1).high);
    left + (right - left) * (place - whole as f64)
}

/// The estimate in three numbers of a scan: value, lower and upper end.
pub(super) fn estimate(three: &[f64]) -> Estimate {
    Estimate { value: three[0], lower: three[1], upper: three[2] }
}

/// A share with the half width of its interval, in per cent. Small intervals get two digits more.
pub(super) fn percent(share: &Estimate) -> String {
    let digits = if share.half_width() > 5e-4 { 2 } else { 4 };
    format!("{:.digits$} ± {:.digits$} %", 100.0 * share.value, 100.0 * share.half_width())
}

/// A share between bounds, in per cent.
pub(super) fn bounds(share: &Estimate) -> String {
    format!("{:.5} … {:.5} %", 100.0 * share.lower, 100.0 * share.upper)
}

/// `count` values from `first` to `last` in equal factors.
pub(super) fn geometric(first: f64, last: f64, count: usize) -> Vec<f64> {
    let power = |k: usize| k as f64 / (count - 1) as f64;
    (0..count).map(|k| first * pxfm::f_pow(last / first, power(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_on_their_humps() {
        assert_eq!(by_humps(0.0), alpha_star(1).high);
        assert_eq!(by_humps(5.0), alpha_star(6).high);
        let middle = by_humps(2.5);
        assert!(alpha_star(3).high < middle && middle < alpha_star(4).high);
        let values = geometric(0.02, 50.0, 5);
        assert!((values[2] - 1.0).abs() < 1e-14 && values[4] == 50.0);
    }
}
