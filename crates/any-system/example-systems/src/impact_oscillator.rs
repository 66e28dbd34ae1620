//! A forced oscillator that hits a stop, at its first grazing.
//!
//! ```text
//!   ẍ + 2ζ ẋ + x = F cos ωt        at x = σ:  ẋ⁺ = −e ẋ⁻
//! ```
//!
//! The steady motion has the amplitude F/√((1 − ω²)² + (2ζω)²). For a small forcing it stays away from the stop. Where its
//! amplitude is σ it grazes, and the return map has there a root of infinite slope.
//!
//! S. W. Shaw, P. J. Holmes, *A periodically forced piecewise linear oscillator*, J. Sound Vib. 90 (1983); A. B. Nordmark,
//! *Non-periodic motion caused by grazing incidence in an impact oscillator*, J. Sound Vib. 145 (1991). The numbers are those of
//! the motion in the performance tables.

use hybrid_system::{Equations, Touch};
use pxfm::{f_atan2, f_hypot, f_sincos};

const DAMPING: f64 = 0.05;
const FREQUENCY: f64 = 1.3;
const STOP: f64 = 0.5;

/// ζ = 1/20, ω = 1.3, σ = ½, e = 0.8, and this forcing F, as a decimal. A touch of the stop is an event of its own kind. The time
/// is the last component of the state.
pub fn impact_oscillator(forcing: &str) -> Equations {
    let numbers = [
        ("damping", "0.05"),
        ("forcing", forcing),
        ("frequency", "1.3"),
        ("stop", "0.5"),
        ("restitution", "0.8"),
    ];
    Equations::new(&["x", "v"], &numbers)
        .mode("free", |t, x, p| {
            let force = p["forcing"] * (p["frequency"] * t).cos();
            [x[1], force - 2.0 * p["damping"] * x[1] - x[0]]
        })
        .rising("stop", |_, x, p| x[0] - p["stop"])
        .resets(|_, x, p| [x[0], -p["restitution"] * x[1]])
        .touch(Touch::Event)
}

/// The amplitude of the steady motion under a forcing of 1, and the phase by which it is late.
fn response() -> (f64, f64) {
    let (spring, damper) = (1.0 - FREQUENCY * FREQUENCY, 2.0 * DAMPING * FREQUENCY);
    (1.0 / f_hypot(spring, damper), f_atan2(damper, spring))
}

/// The forcing at which the steady motion grazes the stop.
pub fn grazing_forcing() -> f64 {
    STOP / response().0
}

/// A start on the steady motion under a forcing: x, v, time.
pub fn steady_start(forcing: f64) -> [f64; 3] {
    let (amplitude, late) = response();
    let (sin, cos) = f_sincos(late);
    [forcing * amplitude * cos, forcing * amplitude * FREQUENCY * sin, 0.0]
}
