//! Speeds next to a change of branch of the map, found by bisection.

use basin_of_attraction::SplitMix64;
use passive_hopper::{LiftOffMap, MassRatio};

/// A property of a hop that changes at a change of branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    /// The maximum test of the second flight passes zero.
    MaximumTest,
    /// x′ of a later landing passes zero: the number of sudden lift-offs changes.
    Excess,
    /// α′² passes zero: the hopper is grounded or not.
    Grounding,
}

/// Speeds of a class reach up to this.
const LARGEST_SPEED: f64 = 60.0;

/// Attempts to find two neighbouring speeds with different properties. One attempt succeeds in a part of the cases;
/// after the last one the random speed itself is used, and the hop is one more random hop.
const ATTEMPTS: u64 = 40;

/// Distance of the two speeds of an attempt, relative to the interval (nπ, (n+1)π). A smaller distance needs more
/// attempts; a larger one may contain several changes, of which bisection finds one.
const STEP: f64 = 0.02;

impl Change {
    /// The property of the hop from `alpha`; `None` if the hop has an error or lacks the property.
    fn of(self, map: &LiftOffMap, alpha: f64) -> Option<u64> {
        let hop = map.bounded_hop(alpha).ok()?;
        match self {
            Change::MaximumTest => {
                let test = hop.landings.get(1)?.maximum_test?;
                Some(u64::from(test.value >= 0.0))
            }
            Change::Excess => (hop.hop.sudden > 0).then_some(hop.hop.sudden as u64),
            Change::Grounding => Some(u64::from(hop.hop.next.is_some())),
        }
    }

    /// A mass ratio, and a speed next to a change: some ulps beside it, from none to 2⁴⁰ of them.
    pub(super) fn near(self, random: &SplitMix64, first: u64) -> (f64, f64) {
        let part = |k: u64| random.uniform(first + k);
        let mass_ratio = 0.05 * pxfm::f_pow(400.0, part(0));
        let Ok(map) = MassRatio::new(mass_ratio).map(LiftOffMap::new) else {
            return (mass_ratio, part(1) * LARGEST_SPEED);
        };
        let found = (0..ATTEMPTS).find_map(|attempt| {
            let left = 1.0 + (LARGEST_SPEED - 1.0) * part(8 + attempt);
            let right = left + STEP;
            let (at_left, at_right) = (self.of(&map, left)?, self.of(&map, right)?);
            (at_left != at_right).then(|| self.bisected(&map, (left, right), at_left))
        });
        let edge = found.unwrap_or(1.0 + (LARGEST_SPEED - 1.0) * part(1));
        (mass_ratio, moved(edge, part(2), part(3)))
    }

    /// The last speed with the property of the left end, to an ulp.
    fn bisected(self, map: &LiftOffMap, (mut left, mut right): (f64, f64), at_left: u64) -> f64 {
        loop {
            let middle = 0.5 * (left + right);
            if !(middle > left && middle < right) {
                return left;
            }
            if self.of(map, middle) == Some(at_left) {
                left = middle;
            } else {
                right = middle;
            }
        }
    }
}

/// `x` > 0 moved by ±2^u ulps, u uniform in [0, 40), or by none; `side` and `part` are uniform in [0, 1).
pub(super) fn moved(x: f64, side: f64, part: f64) -> f64 {
    let ulps = (pxfm::f_exp2(40.0 * part) - 1.0).floor() as u64;
    // 2⁴⁰ ulps are 2⁻¹² of x: the exponent changes by one at most, and neighbouring bits are neighbouring numbers.
    f64::from_bits(if side < 0.5 { x.to_bits() - ulps } else { x.to_bits() + ulps })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The property differs between the speeds around an edge.
    #[test]
    fn bisection_ends_at_a_change() {
        let map = LiftOffMap::new(MassRatio::ONE);
        for (change, range) in [(Change::Grounding, (1.0, 3.4)), (Change::Excess, (9.5, 10.9))] {
            let starts: Vec<f64> =
                (0..200).map(|k| range.0 + (range.1 - range.0) * f64::from(k) / 200.0).collect();
            let pair = starts.windows(2).find_map(|pair| {
                let ends = (change.of(&map, pair[0])?, change.of(&map, pair[1])?);
                (ends.0 != ends.1).then_some((pair[0], pair[1], ends.0))
            });
            let Some((left, right, at_left)) = pair else { continue };
            let edge = change.bisected(&map, (left, right), at_left);
            assert_eq!(change.of(&map, edge), Some(at_left), "{change:?} {edge}");
            assert_ne!(change.of(&map, edge.next_up()), Some(at_left), "{change:?} {edge}");
        }
    }

    #[test]
    fn speeds_move_by_ulps_to_both_sides() {
        assert_eq!(moved(5.0, 0.2, 0.0), 5.0);
        assert_eq!(moved(5.0, 0.7, 0.026), 5.0f64.next_up());
        assert!(moved(5.0, 0.2, 0.99) < 5.0 && moved(5.0, 0.2, 0.99) > 4.99);
    }
}
