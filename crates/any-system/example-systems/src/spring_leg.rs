//! A runner on a spring leg: a point mass that flies, and stands on a massless spring (the spring-loaded inverted pendulum).
//!
//! The leg touches down with a fixed angle of attack, and takes off where the spring has its length again. For some angles the
//! runner is stable, without any control: the periodic run of these numbers has its apex at 0.940 267 m, and the multiplier
//! −0.161.
//!
//! A. Seyfarth, H. Geyer, M. Günther, R. Blickhan, *A movement criterion for running*, J. Biomech. 35 (2002).

use hybrid_system::{Equations, Expression};
use return_map::EquationReturns;

/// Height of the apex of the periodic run, in metres.
pub const APEX: f64 = 0.940_267_144;

/// The runner: 80 kg, a leg of 1 m and 20 kN/m, an angle of attack of 68°. x is measured from the foot.
///
/// Touchdown and take-off are crossings: the body may take off below the height of its touchdown.
pub fn spring_leg() -> Equations {
    runner(false)
}

/// The same runner, who may fall: the run ends where the body comes to the ground, in flight at "ground" and in stance at "stumble".
pub fn spring_leg_that_falls() -> Equations {
    runner(true)
}

fn runner(falls: bool) -> Equations {
    let numbers =
        [("mass", "80"), ("stiffness", "2e4"), ("leg", "1"), ("gravity", "9.81"), ("attack", "68")];
    let ground = |equations: Equations, surface: &str| match falls {
        true => equations.falling(surface, |_, x, _| x[1]).stops(),
        false => equations,
    };
    let flight = Equations::new(&["x", "height", "speed", "climb"], &numbers)
        .mode("flight", |t, x, p| [x[2], x[3], t.number(0.0), -p["gravity"]])
        .falling("touchdown", |_, x, p| x[1] - p["leg"] * radians(p["attack"]).sin())
        .crossing()
        .resets(|_, x, p| [-p["leg"] * radians(p["attack"]).cos(), x[1], x[2], x[3]])
        .to("stance")
        .falling("apex", |_, x, _| x[3]);
    let stance = ground(flight, "ground")
        .mode("stance", |_, x, p| {
            let length = (x[0] * x[0] + x[1] * x[1]).sqrt();
            let push = p["stiffness"] / p["mass"] * (p["leg"] / length - 1.0);
            [x[2], x[3], push * x[0], push * x[1] - p["gravity"]]
        })
        .rising("take-off", |_, x, p| (x[0] * x[0] + x[1] * x[1]).sqrt() - p["leg"])
        .crossing()
        .to("flight");
    ground(stance, "stumble")
}

/// The angle in radians.
fn radians(degrees: Expression<'_>) -> Expression<'_> {
    degrees * degrees.pi() / 180.0
}

/// The start at the apex of the periodic run, with the energy of 5 m/s at 1 m.
pub fn apex() -> [f64; 4] {
    [0.0, APEX, (25.0 + 2.0 * 9.81 * (1.0 - APEX)).sqrt(), 0.0]
}

/// The map from one apex to the next, over the angle of attack, with the energy of 5 m/s at 1 m. Its coordinate is the height.
///
/// # Errors
/// None for these equations.
pub fn apexes() -> Result<EquationReturns, return_map::Error> {
    EquationReturns::new(&spring_leg(), "attack", ("flight", "apex"), &["h"])?
        .starting_text(&["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"])?
        .coordinates_text(&["height"])
}
