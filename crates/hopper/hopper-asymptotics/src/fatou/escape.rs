//! The escape from a fixed point to the left, the twin of `Decay`.

use crate::error::Error;
use crate::fatou::fatou_coordinate::FatouCoordinate;
use crate::fatou::local_hop_model::Side;
use crate::fatou::offset::Offset;
use crate::fatou::phase::Phase;
use num_bigint::BigInt;
use passive_hopper::MassRatio;

/// The law of the escape to the left of α*_n: Ψ falls by 1 in a hop, and 1/(A x) ≈ Ψ, x = |δ|^{1/3}, A = 10λ/3.
///
/// From |δ| an orbit takes about 3/(10 λ |δ|^{1/3}) hops to leave: some 830 from 10⁻¹², and 2·10³² from 10⁻¹⁰⁰ (n = 2,
/// M = 0.2). They are jumped over, with the offset after them known to all its digits.
///
/// ```
/// use hopper_asymptotics::{Escape, Offset};
/// use passive_hopper::{LiftOffMap, MassRatio};
/// let ratio = MassRatio::new(0.2)?;
/// let law = Escape::new(2, ratio)?;
/// let map = LiftOffMap::new(ratio);
/// let mut delta = -1e-12;
/// for _ in 0..700 {
///     delta = map.hop_near_fixed_point(2, delta)?.next.expect("it hops again");
/// }
/// let (jumped, error) = law.offset_after((-1e-12).into(), 700)?;
/// assert!((jumped.nearest() / delta - 1.0).abs() <= error + 1e-11 && error < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Escape(FatouCoordinate);

impl Escape {
    /// The law at α*_n.
    ///
    /// # Errors
    /// As [`FatouCoordinate::new`].
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        FatouCoordinate::new(n, mass_ratio, Side::Left).map(Escape)
    }

    /// The Fatou coordinate.
    pub fn coordinate(&self) -> &FatouCoordinate {
        &self.0
    }

    /// Ψ at an offset: the number of hops to leave, and the place on the circle of fates.
    ///
    /// # Errors
    /// As [`FatouCoordinate::phase`].
    pub fn phase(&self, delta: Offset) -> Result<Phase, Error> {
        self.0.phase(delta)
    }

    /// The number of hops from one offset to another, as a phase: an integer, a fraction, and a bound on the error.
    /// It is negative if the second offset is nearer to α*_n.
    ///
    /// # Errors
    /// As [`FatouCoordinate::phase`].
    pub fn hops(&self, start: Offset, end: Offset) -> Result<Phase, Error> {
        let (start, end) = (self.0.phase(start)?, self.0.phase(end)?);
        let fraction = start.fraction() - end.fraction();
        let error = start.error() + end.error() + f64::EPSILON;
        Ok(Phase::new(start.whole() - end.whole(), fraction, error))
    }

    /// The offset after `hops` hops, and its relative error.
    ///
    /// # Errors
    /// As [`FatouCoordinate::phase`] and [`FatouCoordinate::offset`]: after too many hops the orbit has left.
    pub fn offset_after(
        &self,
        start: Offset,
        hops: impl Into<BigInt>,
    ) -> Result<(Offset, f64), Error> {
        self.0.offset(&self.0.phase(start)?.plus(-hops.into()))
    }
}
