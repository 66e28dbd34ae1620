//! Colours and names of fates in figures.

use hopper_basin::HopperFate;
use journal_figures::palette::{Color, GREY, ORDERED, WHITE, YELLOW};

/// The colour of a label.
///
/// The basins of α*₁, α*₂, α*₃ are green, red and blue as in the paper. All fixed points from the
/// sixth on share the last colour.
fn color(label: u16) -> Color {
    match label {
        0 => WHITE,
        HopperFate::GROUNDED => GREY,
        label if HopperFate::is_undecided(label) => YELLOW,
        n => ORDERED[usize::from(n - 1).min(ORDERED.len() - 1)],
    }
}

/// The colour of a label, as CSS.
pub(crate) fn css(label: u16) -> &'static str {
    color(label).css
}

/// The colour of a label.
pub(crate) fn rgb(label: u16) -> [u8; 3] {
    color(label).rgb
}

/// The name of a label, as markup.
pub(crate) fn name(label: u16) -> String {
    match label {
        0 => "decaying".into(),
        HopperFate::GROUNDED => "grounded".into(),
        label if HopperFate::is_undecided(label) => "undecided".into(),
        n if usize::from(n) >= ORDERED.len() => {
            format!("to $α$^{{∗}}_{{{}}} …", ORDERED.len())
        }
        n => format!("to $α$^{{∗}}_{{{n}}}"),
    }
}
