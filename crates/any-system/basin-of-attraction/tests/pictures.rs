//! Pictures and files of results: they show the numbers that they were given.

use basin_of_attraction::{
    AxisNames, Grid, Interval, Label, LabelImage, PixelShares, ValueImage, share_picture,
};
use journal_figures::{Svg, render};
use std::collections::BTreeMap;

const NAMES: AxisNames<'_> = AxisNames { x: "$x$", y: "$y$" };

fn interval(left: f64, right: f64) -> Interval {
    Interval::new(left, right).unwrap()
}

fn grid(columns: usize, rows: usize) -> Grid {
    Grid { x: interval(0.0, 3.0), y: interval(-1.0, 1.0), columns, rows }
}

/// One column whose lower half has a share of one basin, and its upper half all of another one.
fn column(below: f64) -> PixelShares {
    let parts = [
        (interval(-1.0, -1.0 + below), Label::from(1)),
        (interval(-1.0 + below, 0.0), Label::from(2)),
        (interval(0.0, 1.0), Label::from(2)),
    ];
    PixelShares::of_intervals(&parts, interval(-1.0, 1.0), 2).unwrap()
}

#[test]
fn shares_that_are_whole_are_drawn_as_labels() {
    let grid = grid(3, 2);
    let drawn = |svg: Svg| render("shares", &svg, 1.0).unwrap().png;
    let full = |below| drawn(share_picture(&vec![column(below); 3], grid, NAMES).unwrap());
    let labels = [1, 1, 1, 2, 2, 2].map(|label: u8| Label::from(label)).to_vec();
    let none = BTreeMap::new();
    let image = LabelImage { grid, labels }.picture(&none, (0, 1), NAMES).unwrap();
    assert!(full(1.0) == drawn(image));
    // Half a pixel of each basin has a colour between.
    assert!(full(0.5) != full(1.0) && full(0.5) != full(0.25));
    // A column is missing, or has another number of pixels.
    assert!(share_picture(&vec![column(1.0); 2], grid, NAMES).is_err());
    assert!(share_picture(&vec![column(1.0); 3], Grid { rows: 3, ..grid }, NAMES).is_err());
}

#[test]
fn files_of_numbers_give_them_back() {
    let values = vec![0.1, f64::NAN, -1e-300, f64::INFINITY, 5e8, -0.0];
    let image = ValueImage { grid: grid(3, 2), values: values.clone() };
    let [array, table] = image.files("times", "steps to the attractor").unwrap();
    assert_eq!((array.name.as_str(), table.name.as_str()), ("times.npy", "times.csv"));
    let header = array.bytes.len() - 8 * values.len();
    let text = String::from_utf8_lossy(&array.bytes[..header]).into_owned();
    assert!(text.contains("'<f8'") && text.contains("(2, 3)"), "{text}");
    let numbers = array.bytes[header..].chunks_exact(8);
    let back: Vec<u64> = numbers.map(|own| u64::from_le_bytes(own.try_into().unwrap())).collect();
    assert_eq!(back, values.iter().map(|x| x.to_bits()).collect::<Vec<_>>());
    let table = String::from_utf8(table.bytes).unwrap();
    // The middles of the pixels.
    assert!(table.contains("steps to the attractor") && table.contains("0.5 2.5"), "{table}");
    assert!(table.contains("-0.5 0.5"), "{table}");
}

/// The text of a scale, from labels that readers hear.
fn scale(values: Vec<f64>) -> String {
    let svg = ValueImage { grid: grid(2, 1), values }.picture("values", NAMES).unwrap();
    render("values", &svg, 1.0).unwrap().svg
}

#[test]
fn a_scale_tells_small_numbers_and_large_ones() {
    for (values, shown) in [
        (vec![0.0, 4e-7], ["1 · 10^{−7}", "4 · 10^{−7}"]),
        (vec![0.0, 1.0], ["0.25", "0.75"]),
        (vec![-2e9, 2e9], ["−2 · 10^{9}", "1 · 10^{9}"]),
        (vec![100.0, 100.1], ["100.025", "100.1"]),
    ] {
        let text = scale(values);
        for number in shown {
            assert!(text.contains(&format!("aria-label=\"{number}\"")), "{number}\n{text}");
        }
    }
    // No number is finite: no scale. All are one number: it is there.
    assert!(!scale(vec![f64::NAN; 2]).contains("NaN"));
    assert!(scale(vec![7.5; 2]).contains("\"7.5\""));
    assert!(!scale(vec![f64::MIN, f64::MAX]).contains("inf"));
}
