//! Mass ratios at which an orbit from the minimum of a hump falls exactly onto a fixed point.

use crate::error::Error;
use crate::fates::hopper_fate::HopperFate;
use crate::traps::hump::Hump;
use basin_of_attraction::Interval;
use passive_hopper::{LiftOffMap, MassRatio, alpha_star, index_below};
use std::collections::BTreeSet;

/// A mass ratio at which an orbit from a minimum of the map falls exactly onto a fixed point.
///
/// On one side of this mass ratio the orbit comes into the trap of α*_n, on the other it leaves α*_n to the left.
/// Speeds next to the minimum land higher than the minimum by the square of their distance. So basin fractions
/// change there like C √|M − M₀| on one side: they are continuous (docs/theory.md, Theorem 88), and have an
/// infinite slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MinimumOnFixedPoint {
    /// The mass ratio M₀.
    pub mass_ratio: f64,
    /// The hump on whose contact part the minimum is.
    pub hump: u64,
    /// Hops from the minimum onto the fixed point: 1 at a crisis of the hump and at its grounding.
    pub hops: u8,
    /// The index n of the fixed point. It is 0 where the minimum falls onto the ground, α*_0 = 0.
    pub fixed_point: u64,
}

/// An orbit that comes this close to a fixed point at one of two neighbouring numbers M falls onto it between them.
/// Above a grounding it moves by the root of an ulp of M, 10⁻⁸. An orbit that jumps across the fixed point keeps a
/// distance of the size of the jump.
const ON_FIXED_POINT: f64 = 1e-6;

/// The minima of the humps 0 to `last` that fall onto a fixed point within `hops` hops at a mass ratio of a range,
/// by their number of hops.
///
/// They are found from the ends of the range: a fall is not seen where its orbit lies on the same side of the fixed
/// point at both ends. So the range must be short. The orbits are computed without error bounds.
///
/// ```
/// use basin_of_attraction::Interval;
/// use hopper_basin::{crisis, minima_on_fixed_points};
/// let found = minima_on_fixed_points(Interval::new(0.103, 0.104)?, 1, 5)?;
/// // The crisis of hump 1: its minimum falls onto its own fixed point.
/// assert_eq!((found[0].hump, found[0].hops, found[0].fixed_point), (1, 1, 1));
/// assert!((found[0].mass_ratio - crisis(1)?.mass_ratio).abs() < 1e-14);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// [`Error::BasinOfAttraction`] for a range that is reversed; [`Error::Hopper`] for an end that is no mass ratio, or
/// a hop that cannot be computed; [`Error::Index`] for a hump whose fixed point has no label of its own.
pub fn minima_on_fixed_points(
    range: Interval,
    last: u64,
    hops: u8,
) -> Result<Vec<MinimumOnFixedPoint>, Error> {
    let range = Interval::new(range.left, range.right)?;
    let largest = HopperFate::LARGEST_LABEL;
    if last > largest {
        return Err(Error::Index { n: last, smallest: 0, largest });
    }
    let mut found = Vec::new();
    for hump in 0..=last {
        let [left, right] = [range.left, range.right].map(|m| orbit_of_minimum(m, hump, hops));
        let (Some(left), Some(right)) = (left?, right?) else { continue };
        // An orbit that lies on two sides of a fixed point stays on these sides.
        let mut passed = BTreeSet::new();
        for ((hops, one), other) in (1..=hops).zip(left).zip(right) {
            let [one, other] = [fixed_points_up_to(one)?, fixed_points_up_to(other)?];
            for fixed_point in one.min(other)..one.max(other) {
                if passed.insert(fixed_point)
                    && let Some(mass_ratio) = fall(range, hump, hops, alpha_star(fixed_point))?
                {
                    found.push(MinimumOnFixedPoint { mass_ratio, hump, hops, fixed_point });
                }
            }
        }
    }
    found.sort_by_key(|fall| fall.hops);
    Ok(found)
}

/// The number of fixed points α*_0, α*_1, … that are not above a speed; 0 for the speed −∞ of a hopper that is
/// grounded.
fn fixed_points_up_to(speed: f64) -> Result<u64, Error> {
    if speed < 0.0 { Ok(0) } else { Ok(index_below(speed)? + 1) }
}

/// The first images of the minimum of a hump, −∞ from where the hopper is grounded; `None` if the map only rises on
/// its contact part.
fn orbit_of_minimum(m: f64, hump: u64, hops: u8) -> Result<Option<Vec<f64>>, Error> {
    let mass_ratio = MassRatio::new(m)?;
    let Some((_, mut speed)) = Hump::new(hump)?.falling(mass_ratio.mu())? else { return Ok(None) };
    let map = LiftOffMap::new(mass_ratio);
    let mut orbit = vec![f64::NEG_INFINITY; hops.into()];
    for image in &mut orbit {
        let Some(next) = map.image(speed)? else { break };
        *image = next;
        speed = next;
    }
    Ok(Some(orbit))
}

/// The mass ratio of a range at which the last of some images of the minimum passes a fixed point, at one end of
/// the range above it and at the other below; `None` if it jumps across.
fn fall(range: Interval, hump: u64, hops: u8, star: f64) -> Result<Option<f64>, Error> {
    let image = |m: f64| {
        let last = orbit_of_minimum(m, hump, hops)?.and_then(|orbit| orbit.last().copied());
        Ok::<_, Error>(last.unwrap_or(f64::NAN))
    };
    let (mut low, mut high) = (range.left, range.right);
    let below_left = image(low)? < star;
    loop {
        let middle = low.midpoint(high);
        // No number lies between the ends.
        if middle <= low || middle >= high {
            break;
        }
        if (image(middle)? < star) == below_left { low = middle } else { high = middle }
    }
    let distance = (image(low)? - star).abs().min((image(high)? - star).abs());
    Ok((distance < ON_FIXED_POINT).then_some(high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fates::fates_at_mass_ratio::Fates;
    use crate::fates::hopper_fate::HopperFate;
    use crate::traps::crisis::grounding;

    fn first(left: f64, right: f64) -> MinimumOnFixedPoint {
        minima_on_fixed_points(Interval { left, right }, 5, 6).unwrap()[0]
    }

    #[test]
    fn a_grounding_is_a_fall_onto_the_ground_on_both_sides_of_1() {
        let ground = grounding(0).unwrap().mass_ratio;
        for m in [ground, 1.0 / ground] {
            let found = first(0.999 * m, 1.001 * m);
            assert_eq!((found.hump, found.hops, found.fixed_point), (0, 1, 0));
            assert!((found.mass_ratio / m - 1.0).abs() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn beside_a_fall_the_minimum_has_two_fates() {
        // Where the basin fractions of the paper's window have their steepest steps.
        for (left, right, hump, hops, n) in
            [(0.1044, 0.1045, 2, 4, 1), (0.1175, 0.11753, 4, 4, 2), (0.1695, 0.1696, 2, 3, 1)]
        {
            let found = first(left, right);
            assert_eq!((found.hump, found.hops, found.fixed_point), (hump, hops, n));
            let fate = |m: f64| {
                let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
                let mu = fates.map().mass_ratio().mu();
                let (_, minimum) = Hump::new(hump).unwrap().falling(mu).unwrap().unwrap();
                fates.fate(minimum).unwrap()
            };
            let beside = [fate(found.mass_ratio - 1e-10), fate(found.mass_ratio + 1e-10)];
            let trapped = beside.iter().filter(|fate| **fate == HopperFate::Incessant { n });
            assert_eq!(trapped.count(), 1, "{beside:?}");
        }
    }

    #[test]
    fn no_fall_is_found_where_there_is_none_and_bad_ends_are_errors() {
        let none = |left, right| minima_on_fixed_points(Interval { left, right }, 5, 6);
        assert_eq!(none(0.01, 0.0101).unwrap(), []);
        assert_eq!(none(1e-9, 2e-9).unwrap(), []);
        assert!(none(-1.0, 0.1).is_err());
        assert!(none(0.1, f64::NAN).is_err());
        // The crisis of hump 1 lies between these ends.
        assert!(none(0.104, 0.103).is_err());
        assert!(minima_on_fixed_points(Interval { left: 0.1, right: 0.2 }, u64::MAX, 1).is_err());
    }
}
