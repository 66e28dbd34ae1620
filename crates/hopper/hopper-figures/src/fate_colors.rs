//! Colours and names of fates in figures.

use basin_of_attraction::Label;
use hopper_basin::HopperFate;
use journal_figures::palette::{Color, GREY, ORDERED, WHITE, YELLOW};

/// The colour of a label.
///
/// The basins of α*₁, α*₂, α*₃ are green, red and blue as in the paper. All fixed points from the
/// sixth on share the last colour.
fn color(label: Label) -> Color {
    match label.basin_number() {
        Some(0) => WHITE,
        _ if label == HopperFate::GROUNDED => GREY,
        Some(n) => ORDERED[usize::from(n - 1).min(ORDERED.len() - 1)],
        None => YELLOW,
    }
}

/// The colour of a label, as CSS.
pub fn css(label: Label) -> &'static str {
    color(label).css
}

/// A light colour for an area behind curves, as CSS: that of the label mixed with white.
pub fn light_css(label: Label) -> &'static str {
    match label.basin_number() {
        Some(0) => "#f1efe6",
        _ if label == HopperFate::GROUNDED => "#e4e4df",
        Some(1) => "#c5e8d9",
        Some(2) => "#f2cbc6",
        Some(3) => "#c3d0e6",
        Some(4) => "#d0c1d6",
        Some(_) => "#cfcdca",
        None => "#fff4bf",
    }
}

/// The colour of a label.
pub fn rgb(label: Label) -> [u8; 3] {
    color(label).rgb
}

/// The name of a label, as markup.
pub fn name(label: Label) -> String {
    match label.basin_number() {
        Some(0) => "decaying".into(),
        _ if label == HopperFate::GROUNDED => "grounded".into(),
        Some(n) if usize::from(n) >= ORDERED.len() => {
            format!("to $α$^{{∗}}_{{{}}} …", ORDERED.len())
        }
        Some(n) => format!("to $α$^{{∗}}_{{{n}}}"),
        None => "undecided".into(),
    }
}

/// The colour of a pixel that covers several fates: the light of their colours mixed by their shares. The rest to 1
/// is undecided.
pub fn mixed(shares: impl Iterator<Item = (Label, f64)>) -> [u8; 3] {
    let (mut light, mut rest) = ([0.0; 3], 1.0);
    let mut add = |color: Color, share: f64| {
        for (sum, byte) in light.iter_mut().zip(color.rgb) {
            *sum += share * linear(byte);
        }
    };
    for (label, share) in shares {
        add(color(label), share);
        rest -= share;
    }
    add(YELLOW, f64::max(rest, 0.0));
    light.map(encoded)
}

/// The light of an sRGB byte, from 0 to 1 (IEC 61966-2-1).
fn linear(byte: u8) -> f64 {
    let value = f64::from(byte) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { power((value + 0.055) / 1.055, 2.4) }
}

/// The power of a positive number, to some ulps: a step of a byte is 10¹² times as large. `pxfm::f_pow` is exact to
/// half an ulp; its tables would be a fifteenth of the explorer's page.
fn power(base: f64, exponent: f64) -> f64 {
    pxfm::f_exp(exponent * pxfm::f_log(base))
}

/// The inverse of [`linear`].
fn encoded(light: f64) -> u8 {
    let value =
        if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * power(light, 1.0 / 2.4) - 0.055 };
    (255.0 * value).round().clamp(0.0, 255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_fate_keeps_its_colour_and_two_mix_as_light() {
        let fixed_points = (0..4).map(Label::from);
        for label in fixed_points.chain([HopperFate::GROUNDED]) {
            assert_eq!(mixed([(label, 1.0)].into_iter()), rgb(label));
        }
        assert_eq!(mixed([].into_iter()), YELLOW.rgb);
        // Half of the light of white and black is 0.5, the sRGB byte 188.
        assert_eq!(mixed([0, 6].map(|n| (Label::from(n), 0.5)).into_iter()), [188; 3]);
        for byte in 0..=255 {
            assert_eq!(encoded(linear(byte)), byte);
        }
    }
}
