//! Where the map turns on a contact part: a maximum and a minimum, enclosed for all mass ratios of a strip.

use crate::fixed_points::fixed_point;
use crate::hop::first_landing::FirstLanding;
use crate::hop::hop_enclosure::{HopEnclosure, image_of, largest_w};
use crate::hop::part::SpeedPart;
use crate::hop::strip::Strip;
use basin_of_attraction::Interval;
use hopper_basin::{SpeedImage, falling_laps};
use interval_arithmetic::Enclosure;
use passive_hopper::MassRatio;

/// How far an enclosure of a turn reaches beyond the computed speeds, relative to them. Nearer, the sign of 1 − 4μW
/// is open. It affects the width of the enclosure, which next to a turn is of second order.
const REACH: f64 = 1e-9;

/// An interval of speeds that contains a critical point at each mass ratio of the strip, with the images of all its
/// speeds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    pub(crate) speeds: Interval,
    pub(crate) image: SpeedImage,
}

/// The turns of one contact part. The map is monotone between them.
#[derive(Debug, Clone)]
pub(crate) enum Turns {
    /// All of them: none, or a maximum and a minimum.
    All(Vec<Turn>),
    /// They are not told: next to the mass ratio at which both merge, or at the far end of the contact part.
    Unknown,
}

/// 4μW at a speed of the contact part of hump n.
fn steepness(n: u64, alpha: f64, strip: &Strip) -> Option<Enclosure> {
    let first = FirstLanding::over(Enclosure::from(alpha), SpeedPart::Contact(n))?;
    let [low, high] = first.w_at_ends();
    Some(4.0 * strip.mu * low.hull(&high))
}

/// The turns of every hump up to the speed `top`.
pub(crate) fn turns_up_to(strip: &Strip, top: f64) -> Result<Vec<Turns>, hopper_basin::Error> {
    let at = |m: f64| falling_laps(MassRatio::new(m).map_err(hopper_basin::Error::from)?, top);
    let (light, heavy) = (at(strip.mass_ratios.low())?, at(strip.mass_ratios.high())?);
    // Between M = 1 and its neighbours the laps are not monotone in M.
    let one_sided = !(strip.mass_ratios.low() < 1.0 && strip.mass_ratios.high() > 1.0);
    let laps = light.into_iter().zip(heavy).zip(0..);
    let of_hump = |((light, heavy), n): ((Option<Interval>, Option<Interval>), u64)| {
        if (4.0 * strip.mu * largest_w(n)).high() <= 1.0 {
            return Turns::All(Vec::new());
        }
        match (light, heavy) {
            (Some(a), Some(b)) if one_sided => between(n, [a, b], strip).unwrap_or(Turns::Unknown),
            _ => Turns::Unknown,
        }
    };
    Ok(laps.map(of_hump).collect())
}

/// The maximum and the minimum of hump n, from the computed ones at both ends of the strip.
fn between(n: u64, [a, b]: [Interval; 2], strip: &Strip) -> Option<Turns> {
    let around = |p: f64, q: f64| Interval {
        left: p.min(q) * (1.0 - REACH),
        right: p.max(q) * (1.0 + REACH),
    };
    let (top, bottom) = (around(a.left, b.left), around(a.right, b.right));
    // 1 − 4μW has the sign of the slope. W rises and then falls, so that four signs tell the slope everywhere
    // between and beyond.
    let rises = |alpha: f64| steepness(n, alpha, strip).is_some_and(|s| s.high() < 1.0);
    let falls = |alpha: f64| steepness(n, alpha, strip).is_some_and(|s| s.low() > 1.0);
    let inside = fixed_point(n).high() < top.left && top.right < bottom.left;
    let told =
        inside && rises(top.left) && falls(top.right) && falls(bottom.left) && rises(bottom.right);
    let turn = |speeds: Interval| {
        let all = Enclosure::new(speeds.left, speeds.right);
        let at = |alpha: f64| {
            HopEnclosure::plain(Enclosure::from(alpha), SpeedPart::Contact(n), strip)
                .map(|hop| hop.reached.square)
        };
        let slope = HopEnclosure::plain(all, SpeedPart::Contact(n), strip)?.by_speed;
        let middle = all.middle();
        let form = Enclosure::mean_value(at(middle)?, slope, all, Enclosure::from(middle));
        Some(Turn { speeds, image: image_of(form) })
    };
    told.then(|| Some(Turns::All(vec![turn(top)?, turn(bottom)?])))?
}
