//! A mass on a belt that moves: it sticks until the spring is stronger than the friction, and slips back.
//!
//! ```text
//!   slip:   ẍ + x = 1/(1 + 3 (u − ẋ)),  ẋ < u = 0.2        stick:  ẋ = u  up to x = 1
//! ```
//!
//! R. I. Leine, D. H. van Campen, A. de Kraker, L. van den Steen, *Stick-slip vibrations induced by alternate friction models*,
//! Nonlinear Dynamics 16 (1998).

use hybrid_system::Equations;

/// The period of the motion, after its first slip (SciPy, to 1e-12).
pub const STICK_SLIP_PERIOD: f64 = 12.001_031_295;

/// The mass 1 and the spring 1 on a belt of the speed 0.2; the friction of 1 at rest falls with the speed of the slip.
pub fn stick_slip() -> Equations {
    let numbers = [("belt", "0.2"), ("fall", "3")];
    Equations::new(&["x", "v"], &numbers)
        .mode("slip", |_, x, p| {
            let friction = 1.0 / (1.0 + p["fall"] * (p["belt"] - x[1]));
            [x[1], friction - x[0]]
        })
        .rising("sticks", |_, x, p| x[1] - p["belt"])
        .to("stick")
        .mode("stick", |t, _, p| [p["belt"], t.number(0.0)])
        .rising("slips", |_, x, _| x[0] - 1.0)
        .to("slip")
}
