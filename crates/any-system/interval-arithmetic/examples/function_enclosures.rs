//! Writes enclosures of functions to standard output, for a comparison with another program:
//! `function_enclosures COUNT`.
//!
//! A record has a number, the place of the function in the list below, and six little-endian `f64`: the ends of the
//! two arguments, and those of the enclosure, NaN where the function refuses. The arguments are of all magnitudes,
//! subnormal and huge, next to multiples of ½π, at the ends of domains and some ulps beside them; every fourth one is an
//! interval, the others are points.

use interval_arithmetic::{Enclosure, PI};
use std::io::Write;

type Function = fn(Enclosure, Enclosure) -> Option<Enclosure>;

/// The functions, in the order of `compare_functions.py`.
const FUNCTIONS: [Function; 19] = [
    |x, _| Some(x.sin()),
    |x, _| Some(x.cos()),
    |x, _| Some(x.tan()),
    |x, _| Some(x.arctan()),
    |x, _| x.asin(),
    |x, _| x.acos(),
    |x, _| Some(x.exp()),
    |x, _| x.ln(),
    |x, _| Some(x.sinh()),
    |x, _| Some(x.cosh()),
    |x, _| Some(x.tanh()),
    |x, _| Some(x.asinh()),
    |x, _| x.acosh(),
    |x, _| x.atanh(),
    |x, _| x.sqrt(),
    |x, y| Some(x.powi(exponent(y))),
    |x, y| x.powf(y),
    |x, y| Some(x.atan2(y)),
    |x, y| Some(x / y),
];

/// An integer exponent from −40 to 40, by the sign and the last bits of a number.
fn exponent(y: Enclosure) -> i32 {
    let size = (y.low().to_bits() % 41) as i32;
    if y.low() < 0.0 { -size } else { size }
}

/// Numbers in [0, 1) that fill it evenly (Weyl).
fn part(k: u64, step: f64) -> f64 {
    (k as f64 * step).fract()
}

fn number(k: u64, kinds: u64) -> f64 {
    let (a, b) = (part(k, 0.618_033_988_749_895), part(k, 0.754_877_666_246_693));
    let sign = if (k / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
    let ulps = f64::EPSILON * (8.0 * b - 4.0).round();
    sign * match kinds % 7 {
        // All magnitudes, from the smallest subnormal numbers on.
        0 => pxfm::f_pow(10.0, -323.0 + 332.0 * a),
        1 => pxfm::f_pow(10.0, -323.0 + 631.0 * a),
        2 => 100.0 * a,
        // Some ulps beside a multiple of ½π.
        3 => (PI * (0.5 * (pxfm::f_pow(10.0, 8.5 * a)).floor())).middle() * (1.0 + ulps),
        4 => 1e9 * a * b,
        // Near the ends of domains, and where exponentials overflow and vanish.
        5 => {
            [0.0, 1.0, 1.0, 1.0, 2.0, 709.782_712_893_384, 745.133_219_101_941_1, 1e9]
                [(8.0 * a) as usize]
                * (1.0 + ulps)
        }
        _ => 1.5 * a,
    }
}

fn argument(k: u64, kinds: u64) -> Enclosure {
    let low = number(k, kinds);
    let width = if k % 4 == 3 {
        pxfm::f_pow(10.0, -15.0 + 16.0 * part(k, 0.569_840_290_998_053)) * low.abs().max(1e-3)
    } else {
        0.0
    };
    Enclosure::new(low, low + width)
}

fn main() -> std::io::Result<()> {
    let count = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1_000_000);
    let mut out = std::io::BufWriter::new(std::io::stdout());
    for k in 1..=count {
        let (x, y) = (argument(k, k / 4), argument(3 * k + 1, k / 28));
        for (place, function) in FUNCTIONS.iter().enumerate() {
            let found = function(x, y).unwrap_or(Enclosure::new(f64::NAN, f64::NAN));
            for number in
                [place as f64, x.low(), x.high(), y.low(), y.high(), found.low(), found.high()]
            {
                out.write_all(&number.to_le_bytes())?;
            }
        }
    }
    out.flush()
}
