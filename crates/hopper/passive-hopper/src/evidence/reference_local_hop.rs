//! A hop near a fixed point in 512 or 1024 bits, for comparison.

use crate::error::Error;
use crate::map::extended_hop::{ExtendedMasses, HopStart, watched_hop_with};
use crate::map::lift_off_map::LiftOffMap;
use crate::model::fixed_points::fixed_point_in;
use crate::precision::long::Long;
use crate::precision::real::Extended;

/// A number to 100 bits: the sum of two `f64`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceNumber {
    /// The nearest `f64`.
    pub nearest: f64,
    /// The number minus [`nearest`](Self::nearest), rounded.
    pub rest: f64,
}

impl ReferenceNumber {
    fn of<R: Extended>(number: R) -> Self {
        let nearest = number.nearest();
        ReferenceNumber { nearest, rest: (number + -nearest).nearest() }
    }

    /// |`value` − the number|, rounded.
    pub fn error_of(&self, value: f64) -> f64 {
        ((value - self.nearest) - self.rest).abs()
    }
}

/// A hop near a fixed point, in the same quantities as [`LocalHop`](crate::LocalHop).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceLocalHop {
    /// δ′; `None` if the hopper is grounded.
    pub next: Option<ReferenceNumber>,
    /// δ − δ′; `None` if the hopper is grounded.
    pub loss: Option<ReferenceNumber>,
    /// Number of sudden lift-offs.
    pub sudden: usize,
    /// t = τ − 2α*_n.
    pub time_shift: ReferenceNumber,
}

impl LiftOffMap {
    /// The hop of [`hop_near_fixed_point`](Self::hop_near_fixed_point) in 512 bits, or in 1024 where 512 are
    /// inconclusive, for comparison.
    ///
    /// 512 bits are 154 digits. t = τ − 2α*_n is a difference of numbers about α*_n and is above 10⁻¹⁰⁰, so that 40
    /// digits of it are left even for the fastest hops. `None` if 1024 bits do not decide the hop, or if it has
    /// more sudden lift-offs than that arithmetic allows.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::ONE);
    /// let (hop, exact) = (map.hop_near_fixed_point(1, 1e-60)?, map.reference_local_hop(1, 1e-60)?);
    /// let error = exact.expect("they decide").next.expect("it hops again").error_of(hop.next.unwrap());
    /// assert!(error <= 8.0 * f64::EPSILON * 1e-60);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`hop_near_fixed_point`](Self::hop_near_fixed_point).
    pub fn reference_local_hop(
        &self,
        n: u64,
        delta: f64,
    ) -> Result<Option<ReferenceLocalHop>, Error> {
        self.check_offset(n, delta)?;
        match local_hop::<Long<8>>(self, n, delta)? {
            None => local_hop::<Long<16>>(self, n, delta),
            found => Ok(found),
        }
    }
}

/// The hop in the arithmetic `R`; `None` if it is not conclusive there.
fn local_hop<R: Extended>(
    map: &LiftOffMap,
    n: u64,
    delta: f64,
) -> Result<Option<ReferenceLocalHop>, Error> {
    let mut squares = R::from(0.0);
    let mut time = None;
    let hop =
        watched_hop_with::<R>(HopStart::Offset { n, delta }, map.mass_ratio(), |landing, _| {
            squares = squares + landing.closing_speed.squared();
            time.get_or_insert(landing.time);
        })?;
    let (Some(hop), Some(time)) = (hop.filter(|hop| hop.certain && hop.precise), time) else {
        return Ok(None);
    };
    let star = fixed_point_in::<R>(n);
    let offset = R::from(delta);
    let alpha = star + offset;
    let taken = ExtendedMasses::<R>::new(map.mass_ratio()).mu * squares;
    let exact = hop.next.map(|_| {
        let loss = taken / (alpha + (alpha.squared() - taken).sqrt());
        (ReferenceNumber::of(offset - loss), ReferenceNumber::of(loss))
    });
    let (next, loss) = exact.unzip();
    Ok(Some(ReferenceLocalHop {
        next,
        loss,
        sudden: hop.landings.len() - 1,
        time_shift: ReferenceNumber::of(time - star * 2.0),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::mass_ratio::MassRatio;

    /// At δ = 10⁻⁹⁰ the loss is λδ^{4/3} to 30 digits, and δ′ is not the `f64` next to δ.
    #[test]
    fn the_reference_agrees_with_the_first_orders() {
        let map = LiftOffMap::new(MassRatio::ONE);
        let hop = map.reference_local_hop(1, 1e-90).unwrap().unwrap();
        // λ = 3.616949794602146…; the next term is smaller by 10⁻³⁰.
        let lambda = hop.loss.unwrap().nearest / 1e-120;
        assert!((lambda - 3.616_949_794_602_146).abs() < 2e-15, "{lambda}");
        assert_eq!(hop.sudden, 0);
        assert_eq!(hop.next.unwrap().nearest, 1e-90);
        assert!(hop.next.unwrap().error_of(1e-90) > 0.0);
    }

    #[test]
    fn offsets_outside_the_interval_are_errors() {
        let map = LiftOffMap::new(MassRatio::ONE);
        assert!(
            map.reference_local_hop(1, 3.0).is_err() && map.reference_local_hop(0, 0.1).is_err()
        );
    }
}
