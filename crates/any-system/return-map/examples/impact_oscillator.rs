//! A periodically forced oscillator that hits a wall, near grazing.
//!
//! The motion is ẍ + x = cos φ, φ̇ = ω. At the wall x = σ the velocity is reversed: v → −r v. Without impacts the
//! motion x = a cos φ with a = 1/(1 − ω²) is periodic. A wall at σ = |a| is grazed by it. For σ < |a| the map from
//! one period of the force to the next has a square-root singularity (Nordmark 1991): its derivative grows like
//! (|a| − σ)^(−1/2). At grazing there is no derivative.
//!
//! Run with `cargo run -p return-map --example impact_oscillator`.

#![allow(clippy::print_stdout, clippy::disallowed_methods)] // a program, and bits do not matter

use hybrid_system::*;
use nalgebra::{SMatrix, SVector, Vector2, Vector3};
use return_map::{ReturnMap, Section, SmoothSection};
use std::f64::consts::TAU;

/// State: x, v, φ.
#[derive(Debug, Clone, Copy)]
struct Oscillator {
    /// ω.
    frequency: f64,
    /// σ.
    wall: f64,
    /// r.
    restitution: f64,
}

impl Oscillator {
    /// The amplitude a of the forced motion a cos φ.
    fn driven(&self) -> f64 {
        1.0 / (1.0 - self.frequency * self.frequency)
    }

    /// The free motion, its wall x = σ, and the end of a period of the force, φ = 2π.
    fn model(self) -> Result<EquationsModel<State<3>>, hybrid_system::Error> {
        let Oscillator { frequency, wall, restitution } = self;
        Equations::new(&["x", "v", "phase"], &[])
            .mode("free", move |_, x, _| [x[1], x[2].cos() - x[0], x[0].number(frequency)])
            .rising("wall", move |_, x, _| x[0] - wall)
            .resets(move |_, x, _| [x[0].number(wall), -restitution * x[1], x[2]])
            .rising("period", |_, x, _| x[2] - TAU)
            .resets(|_, x, _| [x[0], x[1], x[2].number(0.0)])
            .crossing()
            .model()
    }
}

/// The section φ = 0, with coordinates x and v, and the mode.
struct OnceAPeriod(Label);

impl Section<EquationsModel<State<3>>, 3, 2> for OnceAPeriod {
    fn point(&self, x: &SVector<f64, 2>) -> (Label, State<3>) {
        (self.0, Vector3::new(x[0], x[1], 0.0))
    }
    fn coordinates(&self, event: &Event<Label, Label, State<3>>) -> Option<SVector<f64, 2>> {
        let (_, state) = event.after.filter(|_| event.surface == "period")?;
        Some(Vector2::new(state[0], state[1]))
    }
}

impl SmoothSection<EquationsModel<State<3>>, 3, 2> for OnceAPeriod {
    fn point_jacobian(&self, _: &SVector<f64, 2>) -> SMatrix<f64, 3, 2> {
        SMatrix::<f64, 3, 2>::identity()
    }
    fn coordinates_jacobian(&self, _: &Event<Label, Label, State<3>>) -> SMatrix<f64, 2, 3> {
        SMatrix::<f64, 2, 3>::identity()
    }
}

/// One period from the start of the forced motion, with a wall that this motion would pass by `beyond`.
fn one_period(beyond: f64) -> Result<return_map::SmoothReturn<2>, return_map::Error> {
    let free = Oscillator { frequency: 2.5, wall: 0.0, restitution: 0.8 };
    let amplitude = free.driven().abs();
    let oscillator = Oscillator { wall: amplitude - beyond, ..free };
    let (model, section) = (oscillator.model()?, OnceAPeriod(Label::new("free")?));
    let map = ReturnMap::new(&model, &section, Limits::new(100.0, 100));
    map.next_with_derivative(&Vector2::new(free.driven(), 0.0))
}

fn main() {
    println!("{:>12} {:>8} {:>16} {:>24}", "beyond", "events", "|Df|", "|Df| (beyond)^(1/2)");
    for beyond in [-1e-2, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 0.0] {
        match one_period(beyond) {
            Ok(back) => {
                let (events, size) = (back.to.events, back.derivative.amax());
                let scaled = size * f64::max(beyond, 0.0).sqrt();
                println!("{beyond:>12.0e} {events:>8} {size:>16.6} {scaled:>24.9}");
            }
            Err(error) => println!("{beyond:>12.0e} {error}"),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use return_map::Error;

    #[test]
    fn the_forced_motion_without_impact_is_periodic() {
        let back = one_period(-1e-9).unwrap();
        assert_eq!(back.to.events, 1);
        let free = Oscillator { frequency: 2.5, wall: 0.0, restitution: 0.8 };
        assert!((back.to.coordinates - Vector2::new(free.driven(), 0.0)).amax() < 1e-14);
        // The derivative of the free motion is a rotation by the period.
        let (sin, cos) = (TAU / 2.5).sin_cos();
        let rotation = SMatrix::<f64, 2, 2>::new(cos, sin, -sin, cos);
        assert!((back.derivative - rotation).amax() < 1e-14);
    }

    /// Nordmark's square root: |Df| √(|a| − σ) tends to a constant.
    #[test]
    fn the_derivative_has_a_square_root_singularity() {
        let scaled = |beyond: f64| one_period(beyond).unwrap().derivative.amax() * beyond.sqrt();
        let limit = scaled(1e-10);
        for (beyond, near) in [(1e-4, 2e-2), (1e-6, 2e-3), (1e-8, 2e-4)] {
            assert!((scaled(beyond) / limit - 1.0).abs() < near, "{beyond}");
        }
        assert!(limit > 0.1);
    }

    #[test]
    fn grazing_is_an_error() {
        let grazing = one_period(0.0);
        assert!(
            matches!(grazing, Err(Error::Execution(hybrid_system::Error::Grazing { .. }))),
            "{grazing:?}"
        );
    }

    /// The derivative through impacts agrees with finite differences.
    #[test]
    fn derivatives_agree_with_finite_differences() {
        let oscillator = Oscillator { frequency: 2.5, wall: 0.1, restitution: 0.8 };
        let section = OnceAPeriod(Label::new("free").unwrap());
        let model = oscillator.model().unwrap();
        let map = ReturnMap::new(&model, &section, Limits::new(100.0, 100));
        for x in [Vector2::new(-0.2, 0.3), Vector2::new(0.05, -1.0), Vector2::new(0.0, 0.5)] {
            let back = map.next_with_derivative(&x).unwrap();
            for axis in 0..2 {
                let mut step = Vector2::zeros();
                step[axis] = 1e-6;
                let (up, down) = (map.next(&(x + step)).unwrap(), map.next(&(x - step)).unwrap());
                let difference = (up.coordinates - down.coordinates) / 2e-6;
                assert!((difference - back.derivative.column(axis)).amax() < 1e-7);
                let later = (up.time - down.time) / 2e-6;
                assert!((later - back.time_derivative[axis]).abs() < 1e-7);
            }
        }
    }

    /// On a line of starts, the singularity of the map separates two monotone branches.
    #[test]
    fn a_line_of_starts_has_several_monotone_branches() {
        let oscillator = Oscillator { frequency: 2.5, wall: 0.25, restitution: 0.8 };
        let section = OnceAPeriod(Label::new("free").unwrap());
        let model = oscillator.model().unwrap();
        let map = ReturnMap::new(&model, &section, Limits::new(100.0, 100));
        let image = |x: f64| map.next(&Vector2::new(x, 0.0)).ok().map(|back| back.coordinates[1]);
        let window = basin_of_attraction::Interval { left: -0.6, right: 0.2 };
        let branches = basin_of_attraction::monotone_branches(&image, window, 200).unwrap();
        assert!(branches.len() >= 2, "{branches:?}");
    }
}
