//! Writes enclosures of sines, cosines and arc tangents to standard output, for a comparison with another program:
//! `wave_enclosures COUNT`.
//!
//! Each record has eight numbers, as little-endian `f64`: the ends of the argument, and those of the three
//! enclosures. The arguments are of all magnitudes up to 10⁹, next to multiples of ½π, and next to 0; every fourth
//! one is an interval, the others are points.

use interval_arithmetic::{Enclosure, PI};
use std::io::Write;

/// Numbers in [0, 1) that fill it evenly (Weyl).
fn part(k: u64, step: f64) -> f64 {
    (k as f64 * step).fract()
}

fn argument(k: u64) -> f64 {
    let (a, b) = (part(k, 0.618_033_988_749_895), part(k, 0.754_877_666_246_693));
    let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    sign * match (k / 4) % 4 {
        // All magnitudes, from the smallest subnormal numbers on.
        0 => pxfm::f_pow(10.0, -323.0 + 332.0 * a),
        1 => 100.0 * a,
        // Some ulps beside a multiple of ½π.
        2 => {
            let near = (PI * (0.5 * (pxfm::f_pow(10.0, 8.5 * a)).floor())).middle();
            near * (1.0 + f64::EPSILON * (8.0 * b - 4.0).round())
        }
        _ => 1e9 * a * b,
    }
}

fn main() -> std::io::Result<()> {
    let count = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1_000_000);
    let mut out = std::io::BufWriter::new(std::io::stdout());
    for k in 1..=count {
        let low = argument(k);
        let width = if k % 4 == 3 {
            pxfm::f_pow(10.0, -15.0 + 16.0 * part(k, 0.569_840_290_998_053))
        } else {
            0.0
        };
        let x = Enclosure::new(low, low + width);
        for ends in [x, x.sin(), x.cos(), x.arctan()] {
            out.write_all(&ends.low.to_le_bytes())?;
            out.write_all(&ends.high.to_le_bytes())?;
        }
    }
    out.flush()
}
