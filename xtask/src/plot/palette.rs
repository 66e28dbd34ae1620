//! Colours that the colour-blind and grey print can tell apart.

use hopper_basin::HopperFate;

/// Colours of the basins of α*_1, α*_2, …: first green, second red, third blue as in the paper,
/// with lightness falling from L* ≈ 72 to 8, so that grey print keeps the order.
const BASINS: [(&str, [u8; 3]); 6] = [
    ("#45c38c", [0x45, 0xc3, 0x8c]),
    ("#e0503c", [0xe0, 0x50, 0x3c]),
    ("#2a62b8", [0x2a, 0x62, 0xb8]),
    ("#5c2275", [0x5c, 0x22, 0x75]),
    ("#3a2a10", [0x3a, 0x2a, 0x10]),
    ("#000000", [0x00, 0x00, 0x00]),
];
const DECAYING: (&str, [u8; 3]) = ("#ffffff", [0xff, 0xff, 0xff]);
const GROUNDED: (&str, [u8; 3]) = ("#d8d8d2", [0xd8, 0xd8, 0xd2]);
const UNDECIDED: (&str, [u8; 3]) = ("#ffd400", [0xff, 0xd4, 0x00]);

fn entry(label: u16) -> (&'static str, [u8; 3]) {
    match label {
        0 => DECAYING,
        HopperFate::GROUNDED => GROUNDED,
        HopperFate::UNDECIDED => UNDECIDED,
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
        HopperFate::UNDECIDED => "undecided".into(),
        n => format!("to $α$^{{∗}}_{{{n}}}"),
    }
}
