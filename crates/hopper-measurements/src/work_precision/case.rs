//! A hop to be computed, with its exact answer, and what a method answers.

use crate::reference::Hop;
use passive_hopper::{FixedPointSpeed, MassRatio, index_below};

/// What of a hop is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// α′.
    Speed,
    /// α − α′.
    Loss,
    /// α′ − α*_n.
    Offset,
}

/// An input with its exact answer.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) mass_ratio: MassRatio,
    /// The lift-off speed; for a start near a fixed point the nearest `f64`.
    pub(crate) alpha: f64,
    /// (n, δ) with α = α*_n + δ; nothing below π.
    pub(crate) local: Option<(u64, f64)>,
    pub(crate) sudden: Option<usize>,
    /// The exact quantity; nothing if the hopper is grounded.
    pub(crate) exact: Option<f64>,
}

impl Case {
    /// Of a reference hop.
    pub(crate) fn of(hop: &Hop) -> Self {
        let (mass_ratio, alpha) = (hop.mass_ratio, hop.alpha);
        let (sudden, exact) = (Some(hop.sudden), hop.next);
        Case { mass_ratio, alpha, local: cell(alpha), sudden, exact }
    }
}

/// What a method says of a hop.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Answer {
    pub(crate) next: Option<f64>,
    /// The loss, if the method knows it better than as a difference.
    pub(crate) loss: Option<f64>,
    /// α′ − α*_n, if the method knows it better than as a difference.
    pub(crate) offset: Option<f64>,
    pub(crate) sudden: Option<usize>,
}

/// The fixed point in whose cell (nπ, (n+1)π) `alpha` lies, and the offset from it.
pub(super) fn cell(alpha: f64) -> Option<(u64, f64)> {
    let below = index_below(alpha).ok()?;
    let n = if alpha > (below + 1) as f64 * std::f64::consts::PI { below + 1 } else { below };
    (n > 0).then(|| (n, FixedPointSpeed::new(n).offset_of(alpha)))
}
