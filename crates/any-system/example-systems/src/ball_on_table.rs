//! A ball on a table that moves up and down as a sine.
//!
//! The ball can land at the same phase of the table once in n of its periods: it leaves with half of the speed that gravity
//! takes away in a flight, and the table gives back what the impact takes. This is so at the phase
//! cos φ = π n g (1 − e)/((1 + e) a ω²) for the restitution e.
//!
//! P. J. Holmes, *The dynamics of repeated impacts with a sinusoidally vibrating table*, J. Sound Vib. 84 (1982).

use hybrid_system::Equations;
use pxfm::{f_acos, f_sin};
use std::f64::consts::{PI, TAU};

/// ω of the table: one period is a unit of time.
pub const FREQUENCY: f64 = TAU;

/// The ball over a table of amplitude a = 0.03, with the gravity 1 and the restitution ½. The time is the last component of
/// the state.
pub fn ball_on_table() -> Equations {
    let numbers = [("amplitude", "0.03"), ("gravity", "1"), ("restitution", "0.5")];
    Equations::new(&["height", "speed"], &numbers)
        .mode("flight", |_, x, p| [x[1], -p["gravity"]])
        .falling("table", |t, x, p| x[0] - p["amplitude"] * (2.0 * t.pi() * t).sin())
        .contact()
        .resets(|t, x, p| {
            let table = 2.0 * t.pi() * p["amplitude"] * (2.0 * t.pi() * t).cos();
            [x[0], (1.0 + p["restitution"]) * table - p["restitution"] * x[1]]
        })
}

/// The ball just after an impact of the motion that lands once in a period: height, speed, time; for the gravity 1 and the
/// restitution ½. NaN for an amplitude below 1/(12π), 0.0265: there is no such motion.
pub fn periodic_start(amplitude: f64) -> [f64; 3] {
    let phase = f_acos(PI * (1.0 - 0.5) / (1.5 * amplitude * FREQUENCY * FREQUENCY));
    [amplitude * f_sin(phase), 0.5, phase / FREQUENCY]
}
