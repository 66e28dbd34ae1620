//! What modes and surfaces are called, and how certain events are.

use hybrid_system::Certainty;
use std::fmt::Debug;

/// The less certain one of two.
pub(crate) fn less_certain(a: Certainty, b: Certainty) -> Certainty {
    let rank = |certainty: &Certainty| match certainty {
        Certainty::Exact => 0,
        Certainty::Certain => 1,
        Certainty::Interpolated => 2,
        Certainty::Sampled { .. } => 3,
    };
    match (a, b) {
        (Certainty::Sampled { interval: x }, Certainty::Sampled { interval: y }) => {
            Certainty::Sampled { interval: x.max(y) }
        }
        _ if rank(&b) > rank(&a) => b,
        _ => a,
    }
}

/// What a mode or a surface is called, without the quotation marks of a label.
pub(crate) fn plain(thing: &impl Debug) -> String {
    let written = format!("{thing:?}");
    match written.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
        Some(inner) => inner.to_owned(),
        None => written,
    }
}
