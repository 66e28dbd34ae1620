//! The Lorenz system and its Poincaré section z = 27, crossed downwards. A plain flow is a hybrid system with one
//! guard, whose reset does not change the state.
//!
//! The flow is symmetric under (x, y, z) → (−x, −y, z). The shortest periodic orbit returns to the section after
//! half of its period, with the signs of x and y changed. Newton's method finds it with its multipliers.
//!
//! Run with `cargo run -p return-map --example lorenz`.

#![allow(clippy::print_stdout)] // a program

use hybrid_system::*;
use nalgebra::{SMatrix, SVector, Vector2, Vector3};
use return_map::{
    Error, PeriodicPoint, ReturnMap, Section, SmoothReturn, SmoothSection,
    periodic_point_with_derivative,
};

type Lorenz = EquationsModel<State<3>>;

/// The Lorenz system, which passes its section downwards. The tolerance is smaller by two orders than the errors that the
/// tests accept.
fn lorenz() -> Result<Lorenz, hybrid_system::Error> {
    let flow = Equations::new(&["x", "y", "z"], &[("sigma", "10"), ("rho", "28")])
        .mode_text("flow", &["sigma*(y - x)", "x*(rho - z) - y", "x*y - 8/3*z"])
        .falling_text("section", "z - 27")
        .model()?;
    Ok(flow.tolerance(1e-14))
}

/// The section z = 27, with coordinates x and y, and the mode.
struct Plane(Label);

impl Section<Lorenz, 3, 2> for Plane {
    fn point(&self, x: &SVector<f64, 2>) -> (Label, State<3>) {
        (self.0, Vector3::new(x[0], x[1], 27.0))
    }
    fn coordinates(&self, event: &Event<Label, Label, State<3>>) -> Option<SVector<f64, 2>> {
        event.after.map(|(_, state)| Vector2::new(state[0], state[1]))
    }
}

impl SmoothSection<Lorenz, 3, 2> for Plane {
    fn point_jacobian(&self, _: &SVector<f64, 2>) -> SMatrix<f64, 3, 2> {
        SMatrix::<f64, 3, 2>::identity()
    }
    fn coordinates_jacobian(&self, _: &Event<Label, Label, State<3>>) -> SMatrix<f64, 2, 3> {
        SMatrix::<f64, 2, 3>::identity()
    }
}

fn next(x: &SVector<f64, 2>) -> Result<SmoothReturn<2>, Error> {
    let section = Plane(Label::new("flow")?);
    ReturnMap::new(&lorenz()?, &section, Limits::new(100.0, 10)).next_with_derivative(x)
}

/// The periodic orbit, as the fixed point of one return followed by the symmetry.
fn shortest_orbit(guess: &SVector<f64, 2>) -> Result<PeriodicPoint<2>, Error> {
    let half = |x: &SVector<f64, 2>| {
        let back = next(x)?;
        Ok((-back.to.coordinates, -back.derivative))
    };
    periodic_point_with_derivative(half, guess, 1)
}

fn main() -> Result<(), Error> {
    let orbit = shortest_orbit(&Vector2::new(-2.1, 2.1))?;
    let period = 2.0 * next(&orbit.location)?.to.time;
    println!("x = {:.12}, y = {:.12}", orbit.location[0], orbit.location[1]);
    println!("period {period:.13}, residual {:.1e}", orbit.residual);
    println!("multipliers of half a period: {:?}", orbit.multipliers);
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::excessive_precision, clippy::disallowed_methods)]
mod tests {
    use super::*;

    /// A published point and its image, half a period later.
    #[test]
    fn a_published_half_return() {
        let back = next(&Vector2::new(-2.1473674741633753, 2.0780481172873415)).unwrap();
        assert!((back.to.time - 0.77932610853932338).abs() < 1e-12);
        let image = Vector2::new(2.1473675875613338, -2.0780482713004851);
        assert!((back.to.coordinates - image).amax() < 1e-12);
    }

    /// The period of the shortest orbit, from Viswanath (2003).
    #[test]
    fn the_shortest_periodic_orbit() {
        let orbit = shortest_orbit(&Vector2::new(-2.1, 2.1)).unwrap();
        let period = 2.0 * next(&orbit.location).unwrap().to.time;
        assert!((period - 1.5586522107161747).abs() < 1e-11, "{period}");
        // The flow contracts volumes at the rate −(σ + 1 + β). The product of the section's multipliers is the
        // contraction over half a period, because the multiplier along a periodic orbit is 1.
        let product: f64 = orbit.multipliers.iter().map(|m| m.norm()).product();
        let shrink = (-(11.0 + 8.0 / 3.0) * period / 2.0f64).exp();
        assert!((product / shrink - 1.0).abs() < 1e-5, "{product:e} {shrink:e}");
    }

    #[test]
    fn derivatives_agree_with_finite_differences() {
        let x = Vector2::new(-2.0, 2.5);
        let back = next(&x).unwrap();
        for axis in 0..2 {
            let mut step = Vector2::zeros();
            step[axis] = 1e-5;
            let (up, down) = (next(&(x + step)).unwrap().to, next(&(x - step)).unwrap().to);
            let difference = (up.coordinates - down.coordinates) / 2e-5;
            let column = back.derivative.column(axis);
            assert!((difference - column).amax() < 1e-6 * (1.0 + column.amax()));
            let later = (up.time - down.time) / 2e-5;
            assert!((later - back.time_derivative[axis]).abs() < 1e-6);
        }
    }
}
