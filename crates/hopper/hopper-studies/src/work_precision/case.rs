//! A hop to be computed with its exact result, and the result of a method.

use crate::reference::ReferenceHop;
use passive_hopper::{FixedPointSpeed, MassRatio, index_below};

/// The quantity that is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// α′.
    Speed,
    /// α − α′.
    Loss,
    /// α′ − α*_n.
    Offset,
}

/// An input with its exact result.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) mass_ratio: MassRatio,
    /// The lift-off speed. For a start near a fixed point it is the `f64` nearest to α*_n + δ.
    pub(crate) alpha: f64,
    /// (n, δ) with α = α*_n + δ; `None` below π, where there is no fixed point.
    pub(crate) local: Option<(u64, f64)>,
    pub(crate) sudden: Option<usize>,
    /// The exact quantity; `None` if the hopper is grounded.
    pub(crate) exact: Option<f64>,
}

impl Case {
    /// The case of a reference hop.
    pub(crate) fn of(hop: &ReferenceHop) -> Self {
        let (mass_ratio, alpha) = (hop.mass_ratio, hop.alpha);
        let (sudden, exact) = (Some(hop.sudden), hop.next);
        Case { mass_ratio, alpha, local: fixed_point_of_pi_interval(alpha), sudden, exact }
    }
}

/// The result of a method.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Answer {
    /// α′; `None` if the method finds the hopper grounded.
    pub(crate) next: Option<f64>,
    /// α − α′, if the method computes it without the difference.
    pub(crate) loss: Option<f64>,
    /// α′ − α*_n, if the method computes it without the difference.
    pub(crate) offset: Option<f64>,
    pub(crate) sudden: Option<usize>,
}

/// The n of the interval (nπ, (n+1)π) that holds `alpha`, and the offset from α*_n, which lies in it; `None`
/// below π.
pub(super) fn fixed_point_of_pi_interval(alpha: f64) -> Option<(u64, f64)> {
    let below = index_below(alpha).ok()?;
    let n = if alpha > (below + 1) as f64 * std::f64::consts::PI { below + 1 } else { below };
    (n > 0).then(|| (n, FixedPointSpeed::new(n).offset_of(alpha)))
}
