//! Colours that the colour-blind and grey print can tell apart.

use hopper_basin::HopperFate;

/// Colours of the basins of α*_1, α*_2, …: first green, second red, third blue as in the paper,
/// with lightness L* = 61, 48, 34, 19, 5, so that grey print keeps the order; the grounded grey has 80.
const BASINS: [(&str, [u8; 3]); 6] = [
    ("#22a672", [0x22, 0xa6, 0x72]),
    ("#d03a2b", [0xd0, 0x3a, 0x2b]),
    ("#1f4e96", [0x1f, 0x4e, 0x96]),
    ("#4a1560", [0x4a, 0x15, 0x60]),
    ("#15100a", [0x15, 0x10, 0x0a]),
    ("#000000", [0x00, 0x00, 0x00]),
];
const DECAYING: (&str, [u8; 3]) = ("#ffffff", [0xff, 0xff, 0xff]);
const GROUNDED: (&str, [u8; 3]) = ("#c8c8c0", [0xc8, 0xc8, 0xc0]);
const UNDECIDED: (&str, [u8; 3]) = ("#ffd400", [0xff, 0xd4, 0x00]);

fn entry(label: u16) -> (&'static str, [u8; 3]) {
    match label {
        0 => DECAYING,
        HopperFate::GROUNDED => GROUNDED,
        label if HopperFate::is_undecided(label) => UNDECIDED,
        n => BASINS[usize::from(n - 1).min(BASINS.len() - 1)],
    }
}

/// The colour of a label, as CSS.
pub fn css(label: u16) -> &'static str {
    entry(label).0
}

/// The colour of a label.
pub fn rgb(label: u16) -> [u8; 3] {
    entry(label).1
}

/// The name of a label, as markup.
pub fn name(label: u16) -> String {
    match label {
        0 => "decaying".into(),
        HopperFate::GROUNDED => "grounded".into(),
        label if HopperFate::is_undecided(label) => "undecided".into(),
        n if usize::from(n) >= BASINS.len() => {
            format!("to $α$^{{∗}}_{{{}}} …", BASINS.len())
        }
        n => format!("to $α$^{{∗}}_{{{n}}}"),
    }
}
