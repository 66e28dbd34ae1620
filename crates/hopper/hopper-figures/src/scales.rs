//! Scales of numbers: the place of a number between light and dark, its colour, and the picture of a raster of them.

use crate::basins::BasinWindow;
use crate::error::Error;
use crate::fate_colors;
use basin_of_attraction::Grid;
use hopper_basin::HopperFate;
use journal_figures::{Anchor, Frame, Pen, Svg, rgb_png, ticks};

type Colors = &'static [[f64; 3]];

/// From the smallest number to the largest: the lightness falls, so that the order is visible in grey print, and to
/// readers who see few colours.
const FALLING: Colors =
    &[[255.0, 247.0, 188.0], [254.0, 153.0, 41.0], [153.0, 52.0, 142.0], [23.0, 9.0, 58.0]];

/// Around a circle: light, blue, dark, brown and light again. Blue and brown differ to readers who see few colours.
const AROUND: Colors = &[
    [240.0, 240.0, 240.0],
    [60.0, 130.0, 200.0],
    [20.0, 15.0, 50.0],
    [190.0, 110.0, 40.0],
    [240.0, 240.0, 240.0],
];

/// Steps of the scale above the picture: narrower ones are not told apart.
const STEPS: usize = 64;

/// The places of numbers between light and dark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Counts from 0 to the largest one: equal steps of log(1 + count).
    Counts {
        /// The one with the darkest colour. Larger ones have it, too.
        largest: u64,
    },
    /// Real numbers, by equal steps.
    Linear {
        /// The one with the lightest colour.
        from: f64,
        /// The one with the darkest colour.
        to: f64,
    },
    /// Positive numbers, by equal steps of the logarithm.
    Logarithmic {
        /// The one with the lightest colour.
        from: f64,
        /// The one with the darkest colour.
        to: f64,
    },
    /// A fraction of a turn, from 0 to 1: both ends have one colour.
    Turn,
}

impl Scale {
    /// The place of a number, from 0 for the lightest colour to 1.
    pub(crate) fn place(self, number: f64) -> f64 {
        let size = |count: f64| pxfm::f_log(1.0 + count);
        let place = match self {
            Scale::Counts { largest: 0 } => 0.0,
            Scale::Counts { largest } => size(number) / size(largest as f64),
            Scale::Linear { from, to } => (number - from) / (to - from),
            Scale::Logarithmic { from, to } => pxfm::f_log(number / from) / pxfm::f_log(to / from),
            Scale::Turn => number,
        };
        place.clamp(0.0, 1.0)
    }

    /// The number at a place.
    pub fn number(self, place: f64) -> f64 {
        match self {
            Scale::Counts { largest } => {
                (pxfm::f_exp(place * pxfm::f_log(1.0 + largest as f64)) - 1.0).round()
            }
            Scale::Linear { from, to } => from + place * (to - from),
            Scale::Logarithmic { from, to } => from * pxfm::f_exp(place * pxfm::f_log(to / from)),
            Scale::Turn => place,
        }
    }

    /// The colour of a number; of no number, that of a hopper that is grounded.
    pub fn color(self, number: f64) -> [u8; 3] {
        if number.is_nan() {
            return fate_colors::rgb(HopperFate::GROUNDED);
        }
        self.color_at(self.place(number))
    }

    fn color_at(self, place: f64) -> [u8; 3] {
        let colors = if self == Scale::Turn { AROUND } else { FALLING };
        let at = place * (colors.len() - 1) as f64;
        let below = (at as usize).min(colors.len() - 2);
        let part = at - below as f64;
        let (low, high) = (colors[below], colors[below + 1]);
        [0, 1, 2].map(|k| (low[k] + part * (high[k] - low[k])).round() as u8)
    }

    /// The numbers beside the scale of a picture.
    fn marks(self) -> Vec<f64> {
        match self {
            // 0, and the powers of ten up to the largest number: at most 20 digits.
            Scale::Counts { largest } => {
                let powers = (0..=19).map(|exponent| 10u64.pow(exponent));
                let all = std::iter::once(0).chain(powers).take_while(|&count| count <= largest);
                all.map(|count| count as f64).collect()
            }
            Scale::Linear { from, to } => {
                ticks((from, to), 4).into_iter().map(|(number, _)| number).collect()
            }
            Scale::Logarithmic { from, to } => {
                let powers = (-9..=9).map(|exponent| pxfm::f_exp10(f64::from(exponent)));
                powers.filter(|power| (from..=to).contains(power)).collect()
            }
            Scale::Turn => vec![0.0, 0.25, 0.5, 0.75, 1.0],
        }
    }
}

/// The drawing of numbers with axes and scale. `numbers` has the pixels of `grid` row after row, the lowest first; NaN
/// where there is none.
///
/// # Errors
/// [`Error::Figure`] if the numbers are not one for each pixel, or there are none.
pub(crate) fn draw_numbers(
    window: &BasinWindow,
    grid: &Grid,
    numbers: &[f64],
    (scale, about): (Scale, &str),
) -> Result<Svg, Error> {
    let rows = numbers.chunks(grid.columns.max(1)).rev();
    let pixels: Vec<u8> = rows.flatten().flat_map(|&number| scale.color(number)).collect();
    let image = rgb_png(window.name, grid.columns, grid.rows, &pixels)?;
    let mut svg = Svg::new(580.0, 560.0);
    let frame = Frame::linear(66.0, 44.0, 490.0, 460.0, window.mass_ratio, window.alpha);
    svg.image(frame.left, frame.top, frame.width, frame.height, &image);
    frame.axes(
        &mut svg,
        &ticks(window.mass_ratio, window.tick_counts.0),
        &ticks(window.alpha, window.tick_counts.1),
        "mass ratio $M$ = $m$_{2}/$m$_{1}",
        "lift-off speed $α$ (dimensionless)",
    );
    draw_scale(&mut svg, (frame.left + 230.0, 12.0), 260.0, scale)?;
    svg.text(frame.left, 22.0, Anchor::Start, 11.5, about);
    Ok(svg)
}

/// The scale: colours, with some numbers below them.
fn draw_scale(
    svg: &mut Svg,
    (left, top): (f64, f64),
    width: f64,
    scale: Scale,
) -> Result<(), Error> {
    const HEIGHT: f64 = 10.0;
    let steps = (0..STEPS).flat_map(|at| scale.color_at((at as f64 + 0.5) / STEPS as f64));
    let image = rgb_png("scale", STEPS, 1, &steps.collect::<Vec<_>>())?;
    svg.image(left, top, width, HEIGHT, &image);
    svg.rect(left, top, width, HEIGHT, Pen::solid("#000", 0.6));
    let mut last = f64::NEG_INFINITY;
    for number in scale.marks() {
        let x = left + width * scale.place(number);
        // A label takes some room.
        if x - last > 24.0 {
            svg.text(x, top + 22.0, Anchor::Middle, 10.0, &number.to_string());
            last = x;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use basin_of_attraction::Interval;

    const COUNTS: Scale = Scale::Counts { largest: 1_000_000 };

    #[test]
    fn the_scale_goes_from_light_to_dark() {
        let scale = Scale::Counts { largest: 1000 };
        assert_eq!(scale.color(0.0), [255, 247, 188]);
        assert_eq!(scale.color(1000.0), [23, 9, 58]);
    }

    #[test]
    fn more_is_darker() {
        let light = |(scale, number): (Scale, f64)| {
            scale.color(number).iter().map(|&byte| u32::from(byte)).sum::<u32>()
        };
        assert_eq!(COUNTS.color(0.0), [255, 247, 188]);
        assert_eq!(COUNTS.color(1e6), [23, 9, 58]);
        let counts = [0.0, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6];
        assert!(counts.map(|count| light((COUNTS, count))).is_sorted_by(|a, b| a > b));
        let linear = Scale::Linear { from: -1.0, to: 3.0 };
        assert!([-1.0, 0.0, 1.0, 2.5].map(|x| light((linear, x))).is_sorted_by(|a, b| a > b));
        let powers = Scale::Logarithmic { from: 0.1, to: 10.0 };
        assert!([0.1, 0.5, 1.0, 9.0].map(|x| light((powers, x))).is_sorted_by(|a, b| a > b));
    }

    #[test]
    fn ends_of_a_turn_have_one_colour_and_numbers_outside_those_of_the_ends() {
        assert_eq!(Scale::Turn.color(0.0), Scale::Turn.color(1.0));
        let linear = Scale::Linear { from: 0.0, to: 1.0 };
        assert_eq!(linear.color(-5.0), linear.color(0.0));
        assert_eq!(linear.color(f64::INFINITY), linear.color(1.0));
        assert_eq!(linear.color(f64::NAN), fate_colors::rgb(HopperFate::GROUNDED));
    }

    #[test]
    fn places_have_their_numbers() {
        let all = [
            COUNTS,
            Scale::Linear { from: -2.0, to: 5.0 },
            Scale::Logarithmic { from: 0.01, to: 100.0 },
            Scale::Turn,
        ];
        for scale in all {
            for place in [0.0, 0.25, 0.5, 1.0] {
                let number = scale.number(place);
                assert!((scale.place(number) - place).abs() < 0.02, "{scale:?} {place}");
            }
            assert!(scale.marks().len() > 2, "{scale:?}");
        }
    }

    #[test]
    fn rasters_with_one_number_or_the_largest_are_drawn_and_others_are_errors() {
        let x = Interval::new(0.1, 1.0).unwrap_or_else(|error| panic!("{error}"));
        let grid = Grid { x, y: x, columns: 2, rows: 2 };
        let range = (x.left, x.right);
        let window = BasinWindow {
            name: "numbers",
            mass_ratio: range,
            alpha: range,
            inset: None,
            tick_counts: (4, 4),
        };
        let draw = |numbers: &[f64]| {
            let largest = numbers.iter().copied().fold(0.0, f64::max) as u64;
            draw_numbers(&window, &grid, numbers, (Scale::Counts { largest }, "numbers"))
        };
        for numbers in [[0.0; 4], [7.0; 4], [0.0, 1.0, 2.0, 1.8e19], [f64::NAN, 0.0, 1.0, 2.0]] {
            assert!(draw(&numbers).is_ok());
        }
        assert!(draw(&[1.0, 2.0]).is_err());
        assert!(draw(&[]).is_err());
    }
}
