//! The window of a raster, from the options; its refusals.

use crate::error::Error;
use crate::options::values;
use crate::output::number;
use basin_of_attraction::{Grid, Interval};
use hopper_basin::{EdgeChart, HopperFate, first_humps};
use passive_hopper::{MassRatio, alpha_star};

/// The largest number of pixels along each axis. A tile of 2²⁰ rows has 32 MiB of labels, and some hundred megabytes
/// are in use while it is computed.
pub(crate) const MOST_ALONG: usize = 1 << 20;

/// The largest number of pixels in all: that of the library, whose arrays have 32 GiB of labels then.
pub(crate) const MOST_PIXELS: usize = 1 << 34;

/// A window narrower than this part of its end has some thousand doubles: many neighbouring pixels would be the same
/// point after rounding.
const NARROWEST: f64 = 1e-12;

/// The grid of a raster of mass ratios and speeds.
///
/// # Errors
/// [`Error::Misuse`] for a window or pixels that no raster has.
pub(crate) fn grid(
    mass_ratio: &[f64],
    speed: Option<&[f64]>,
    pixels: &[usize],
) -> Result<Grid, Error> {
    let x = range("--mass-ratio", mass_ratio)?;
    let default = [first_humps(5).left, first_humps(5).right];
    let speed = speed.unwrap_or(&default);
    let y = range("--speed", speed)?;
    let largest = alpha_star(HopperFate::LARGEST_LABEL);
    if !(y.left >= 0.0 && y.right <= largest) {
        return Err(Error::misuse(
            "--speed",
            two(speed),
            &format!(
                "lift-off speeds of a raster are from 0 to {}; give such speeds",
                number(largest)
            ),
        ));
    }
    let [columns, rows] = pair_of_pixels(pixels)?;
    for along in [columns, rows] {
        if !(1..=MOST_ALONG).contains(&along) {
            return Err(Error::misuse(
                "--pixels",
                format!("{columns} {rows}"),
                &format!("a raster has 1 to {MOST_ALONG} columns and rows; give such numbers"),
            ));
        }
    }
    let grid = Grid { x, y, columns, rows };
    match grid.pixels() {
        Ok(_) => Ok(grid),
        Err(_) => Err(Error::misuse(
            "--pixels",
            format!("{columns} {rows}"),
            &format!(
                "a raster has at most {MOST_PIXELS} pixels in all; give fewer columns or rows"
            ),
        )),
    }
}

/// Columns and rows.
pub(crate) fn pair_of_pixels(pixels: &[usize]) -> Result<[usize; 2], Error> {
    pixels.try_into().map_err(|_| {
        Error::Misuse(
            "--pixels: give two numbers, of columns and of rows, such as 1024 1024".into(),
        )
    })
}

/// Two numbers of an option as an interval, the smaller one first.
///
/// # Errors
/// [`Error::Misuse`] for numbers that do not increase, or by less than pixels can show.
pub(crate) fn range(option: &str, values: &[f64]) -> Result<Interval, Error> {
    let &[from, to] = values else {
        return Err(Error::Misuse(format!("{option}: give two numbers, the smaller one first")));
    };
    let reason = if !(from < to) {
        "the second number must be larger than the first; give the smaller one first"
    } else if !(to - from > NARROWEST * to.abs()) {
        "the numbers differ by less than 1e-12 of the second, so that neighbouring pixels would be one point; give a \
         wider range"
    } else {
        return Ok(Interval::new(from, to)?);
    };
    Err(Error::misuse(option, two(values), reason))
}

/// A mass ratio and a lift-off speed of an option.
///
/// # Errors
/// [`Error::Misuse`] for numbers that are none.
pub(crate) fn place(option: &str, pair: [f64; 2]) -> Result<(MassRatio, f64), Error> {
    let refused = |reason: String| Error::misuse(option, two(&pair), &reason);
    let [mass_ratio, speed] = pair.map(number);
    let mass_ratio = values::mass_ratio(&mass_ratio).map_err(refused)?;
    Ok((mass_ratio, values::speed(&speed).map_err(refused)?))
}

/// The chart of an edge that the numbers of an option choose.
///
/// # Errors
/// [`Error::Misuse`] if no edge is near; else the error of the chart.
pub(crate) fn chart(
    option: &str,
    pair: [f64; 2],
    found: Result<EdgeChart, hopper_basin::Error>,
) -> Result<EdgeChart, Error> {
    found.map_err(|error| match error {
        hopper_basin::Error::NoEdge { .. } => Error::misuse(option, two(&pair), &error.to_string()),
        other => other.into(),
    })
}

/// Two numbers as they are typed.
fn two(values: &[f64]) -> String {
    values.iter().map(|&value| number(value)).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_without_pixels_are_refused_with_option_value_limit_and_remedy() {
        let (m, alpha, pixels) = ([0.1, 1.0], [4.5, 20.0], [10, 20]);
        assert!(grid(&m, Some(&alpha), &pixels).is_ok());
        assert!(grid(&m, None, &[1, 1]).is_ok());
        for pixels in [[0, 10], [10, 0], [usize::MAX, 2], [1, 1 << 21], [1 << 20, 1 << 20]] {
            let error = grid(&m, Some(&alpha), &pixels).unwrap_err();
            assert_eq!(error.exit_status(), 2);
            let text = error.to_string();
            let given = format!("--pixels {} {}: ", pixels[0], pixels[1]);
            assert!(text.starts_with(&given) && text.contains("; give "), "{text}");
        }
        let windows =
            [[1.0, 1.0], [2.0, 1.0], [1.0, 1.0f64.next_up()], [f64::NAN, 1.0], [1.0, f64::NAN]];
        for window in windows {
            for error in [grid(&window, Some(&alpha), &pixels), grid(&m, Some(&window), &pixels)] {
                let error = error.unwrap_err();
                assert_eq!(error.exit_status(), 2);
                assert!(error.to_string().contains("; give "), "{error}");
            }
        }
        for (window, words) in [
            ([1.0, 0.1], "--speed 1 0.1: the second number must be larger"),
            ([0.0, 1e6], "--speed 0 1000000: lift-off speeds of a raster are from 0 to 204"),
            ([-1.0, 5.0], "--speed -1 5: lift-off speeds of a raster are from 0"),
        ] {
            let text = grid(&m, Some(&window), &pixels).unwrap_err().to_string();
            assert!(text.starts_with(words), "{text}");
        }
    }
}
