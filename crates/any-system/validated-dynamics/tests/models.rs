//! Models that several files test.

use equations::{Formulas, Names};
use hybrid_system::Equations;
use validated_dynamics::FormulaMap;

/// ẍ = −x, without guards.
pub(crate) fn oscillator() -> Equations {
    Equations::new(&["x", "v"], &[]).mode_text("flow", &["v", "-x"])
}

/// The map of these formulas, without parameters.
pub(crate) fn map_of(names: &[&str], texts: &[&str]) -> FormulaMap {
    let names = Names::new(names, &[]).unwrap();
    FormulaMap::new(Formulas::from_text(names, texts).unwrap(), 1).unwrap()
}
