//! Colours that remain distinct for colour-blind readers and in grey print.

/// A colour in the two forms that drawings and indexed images need.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Color {
    /// As CSS.
    pub css: &'static str,
    /// Red, green and blue.
    pub rgb: [u8; 3],
}

/// Green, red, blue, purple and two near blacks, for categories in order.
///
/// Their lightness L* falls, 61, 48, 34, 19, 5, 0, so that the order is visible in grey print.
pub const ORDERED: [Color; 6] = [
    Color { css: "#22a672", rgb: [0x22, 0xa6, 0x72] },
    Color { css: "#d03a2b", rgb: [0xd0, 0x3a, 0x2b] },
    Color { css: "#1f4e96", rgb: [0x1f, 0x4e, 0x96] },
    Color { css: "#4a1560", rgb: [0x4a, 0x15, 0x60] },
    Color { css: "#15100a", rgb: [0x15, 0x10, 0x0a] },
    Color { css: "#000000", rgb: [0x00, 0x00, 0x00] },
];

/// The colour of the page.
pub const WHITE: Color = Color { css: "#ffffff", rgb: [0xff, 0xff, 0xff] };

/// A light grey: L* = 80, lighter than all of [`ORDERED`].
pub const GREY: Color = Color { css: "#c8c8c0", rgb: [0xc8, 0xc8, 0xc0] };

/// A yellow that no other colour here resembles, for parts that need attention.
pub const YELLOW: Color = Color { css: "#ffd400", rgb: [0xff, 0xd4, 0x00] };

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_of_a_colour_are_the_same() {
        for Color { css, rgb: [r, g, b] } in ORDERED.into_iter().chain([WHITE, GREY, YELLOW]) {
            assert_eq!(css, format!("#{r:02x}{g:02x}{b:02x}"));
        }
    }
}
