//! Pictures and files of results: they show the numbers that they were given.

use basin_of_attraction::{
    Attractors, AxisNames, CurveLimits, Error, FractionRange, Fractions, Grid, Hyperrectangle,
    Interval, Label, LabelImage, PixelShares, RecurrenceLimits, StateGrid, ValueImage, array_map,
    fractions_along, share_picture,
};
use journal_figures::{DataFile, Svg, render};
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
    assert_eq!((array.name.as_str(), table.name.as_str()), ("times.npy", "times-meaning.csv"));
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

/// Tables have a line for each point or parameter, and say what their columns are.
#[test]
fn tables_have_their_numbers_and_meaning() {
    // 0.4 and −0.4 attract, and the orbit of each comes to itself.
    let map = array_map(|[x]: [f64; 1]| Some([x + 0.5 * x * (0.16 - x * x)]));
    let region: Hyperrectangle = Interval::new(-1.0, 1.0).unwrap().try_into().unwrap();
    let grid = StateGrid::uniform(region, 30).unwrap();
    let starts = [vec![0.5], vec![-0.5]];
    let found = Attractors::search(&map, grid, &starts, RecurrenceLimits::default()).unwrap();
    let text = |file: &DataFile| String::from_utf8(file.bytes.clone()).unwrap();
    let [points, meaning] = found.files("wells").unwrap();
    assert_eq!((points.name.as_str(), meaning.name.as_str()), ("wells.csv", "wells-meaning.csv"));
    let x = |k: usize| format!("{:?}", found.attractors()[k].points[0][0]);
    let lines = format!("label,period,point,x0\nbasin 1,1,0,{}\nbasin 2,1,0,{}\n", x(0), x(1));
    assert_eq!(text(&points), lines);
    assert!(text(&meaning).contains("empty if there is no period"));
    let at = |c: f64| {
        let range = FractionRange { value: c, lower: 0.5 * c, upper: 1.0 };
        Ok::<_, Error>(Fractions {
            found: [(Label::from(3), range)].into(),
            ..Fractions::default()
        })
    };
    let limits = CurveLimits { first_steps: 2, difference: 1.0, ..CurveLimits::default() };
    let along = fractions_along(Interval::new(0.0, 1.0).unwrap(), &[], limits, at).unwrap();
    let [fractions, meaning] = along.files("along", "tilt", "95 % interval").unwrap();
    let lines = "parameter,label,fraction,lower,upper\n\
                 0.0,basin 3,0.0,0.0,1.0\n0.5,basin 3,0.5,0.25,1.0\n1.0,basin 3,1.0,0.5,1.0\n";
    assert_eq!(text(&fractions), lines);
    assert!(
        text(&meaning).contains("parameter,tilt") && text(&meaning).contains("lower end: 95 %")
    );
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
