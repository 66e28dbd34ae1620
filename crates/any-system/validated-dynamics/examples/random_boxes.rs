//! Random boxes of states of several models, and where they are at times up to a random one, for a comparison with points that another program follows
//! (`xtask/generators/compare_flows.py`): a line of JSON for each box.
//!
//! `cargo run --release --example random_boxes -- 1000 | python compare_flows.py`

#![allow(clippy::print_stdout)] // a program

use hybrid_system::Equations;
use serde_json::json;
use validated_dynamics::{Enclosure, Error, Limits, ValidatedSystem};

/// The names of the states, their rates, where starts are, and the longest time.
type Model = (&'static [&'static str], &'static [&'static str], &'static [[f64; 2]], f64);

const MODELS: [Model; 7] = [
    (
        &["x", "y", "z"],
        &["-y - z", "x + 0.2*y", "0.2 + z*(x - 5.7)"],
        &[[-8.0, 8.0], [-8.0, 8.0], [0.0, 2.0]],
        6.0,
    ),
    (&["x", "y"], &["y", "(1 - x^2)*y - x"], &[[-3.0, 3.0], [-3.0, 3.0]], 8.0),
    (
        &["x", "v", "time"],
        &["v", "0.2*cos(time) - 0.15*v + x - x^3", "1"],
        &[[-2.0, 2.0], [-2.0, 2.0], [0.0, 6.0]],
        8.0,
    ),
    (&["angle", "rate"], &["rate", "-sin(angle) - 0.1*rate"], &[[-3.0, 3.0], [-2.0, 2.0]], 8.0),
    (
        &["x", "y", "u", "w"],
        &["u", "w", "250*(1/sqrt(x^2 + y^2) - 1)*x", "250*(1/sqrt(x^2 + y^2) - 1)*y - 9.81"],
        &[[-0.4, 0.4], [0.8, 1.0], [-6.0, 6.0], [-1.0, 1.0]],
        0.15,
    ),
    (
        &["prey", "predator"],
        &["prey*(1 - predator)", "predator*(prey - 1)"],
        &[[0.2, 3.0], [0.2, 3.0]],
        8.0,
    ),
    (
        &["x", "y"],
        &["exp(-y) - x*tanh(y)", "atan(x) - y/(1 + x^2)"],
        &[[-2.0, 2.0], [-1.0, 2.0]],
        4.0,
    ),
];

/// The exponents of the widths of boxes: from an ulp or so to hundredths.
const WIDTHS: [f64; 2] = [-16.0, -2.0];

/// The times at which each box is looked at.
const TIMES: usize = 16;

/// Numbers between 0 and 1, the same for each run: multiples of square roots of primes, without their whole parts.
fn share(number: usize, which: usize) -> f64 {
    const ROOTS: [f64; 6] = [
        std::f64::consts::SQRT_2,
        1.732_050_807_568_877_2,
        2.236_067_977_499_79,
        2.645_751_311_064_590_7,
        3.316_624_790_355_4,
        3.605_551_275_463_989,
    ];
    (number as f64 * ROOTS[which]).fract()
}

fn main() -> Result<(), Error> {
    let count: usize = std::env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(1000);
    let limits = Limits { width: 1.0, steps: 1000, ..Limits::default() };
    for (place, (names, rates, starts, longest)) in MODELS.iter().enumerate() {
        let equations = Equations::new(names, &[]).mode_text("flow", rates);
        let system = ValidatedSystem::new(&equations)?;
        for number in (1..=count).skip(place).step_by(MODELS.len()) {
            let exponent = WIDTHS[0] + (WIDTHS[1] - WIDTHS[0]) * share(number, 5);
            let width = interval_arithmetic::pow(10.0, exponent);
            let side = |(axis, [low, high]): (usize, &[f64; 2])| {
                let from = low + (high - low) * share(number, axis);
                Enclosure::new(from, from + width)
            };
            let start: Vec<Enclosure> = starts.iter().enumerate().map(side).collect();
            let time = longest * share(number, 4);
            let mut run = system.start_box("flow", &start)?.within(limits).without_derivatives();
            let pairs =
                |all: &[Enclosure]| all.iter().map(|x| [x.low(), x.high()]).collect::<Vec<_>>();
            let (mut times, mut boxes) = (Vec::new(), Vec::new());
            for part in 1..=TIMES {
                let now = time * part as f64 / TIMES as f64;
                // A set that becomes too wide is undecided, and says nothing.
                if run.advance(Enclosure::from(now)).is_err() {
                    break;
                }
                times.push(now);
                boxes.push(pairs(run.set().hull()));
            }
            let line = json!({
                "names": names, "rates": rates, "start": pairs(&start), "times": times, "boxes": boxes,
            });
            println!("{line}");
        }
    }
    Ok(())
}
