//! The rimless wheel (McGeer 1990; Coleman 1998): a point mass on rigid spokes that rolls down a slope.
//!
//! On one spoke it is an inverted pendulum, θ̈ = sin θ, with time in units of √(length/gravity). When the spoke is at
//! the angle γ + α from the vertical, the next spoke hits the ground at γ − α, and the speed is multiplied by cos 2α.
//! So Ω = θ̇² after a collision is mapped to cos² 2α (Ω + 4 sin γ sin α). The fixed point of this map is known.
//!
//! Run with `cargo run -p return-map --example rimless_wheel`.

#![allow(clippy::print_stdout, clippy::disallowed_methods)] // a program, and bits do not matter

use hybrid_system::*;
use nalgebra::{SMatrix, SVector, Vector1, Vector2};
use return_map::{Error, ReturnMap, Section, SmoothSection, periodic_point_with_derivative};

/// State: θ, θ̇ of the spoke on the ground.
#[derive(Debug, Clone, Copy)]
struct Wheel {
    /// γ.
    slope: f64,
    /// α, half of the angle between spokes.
    half_angle: f64,
}

/// Smaller by two orders than the errors that the tests accept.
const TOLERANCE: f64 = 1e-13;

impl Wheel {
    /// cos 2α, the factor of the speed at a collision.
    fn kept(&self) -> f64 {
        (2.0 * self.half_angle).cos()
    }

    /// Speed after a collision in the periodic motion: the fixed point.
    fn rolling_speed(&self) -> f64 {
        let kept = self.kept().powi(2);
        (kept * 4.0 * self.slope.sin() * self.half_angle.sin() / (1.0 - kept)).sqrt()
    }

    /// The least speed after a collision with which the wheel passes the vertical.
    fn least_speed(&self) -> f64 {
        (2.0 * (1.0 - (self.slope - self.half_angle).cos())).sqrt()
    }
}

impl Wheel {
    /// The spoke on the ground, until the next one hits the ground or the wheel rocks back. Infinitely many rocking
    /// collisions in finite time end at rest on two spokes.
    fn model(self) -> Result<EquationsModel<State<2>>, hybrid_system::Error> {
        let (ahead, behind) = (self.slope + self.half_angle, self.slope - self.half_angle);
        let kept = self.kept();
        let wheel = Equations::new(&["angle", "speed"], &[])
            .mode("rolls", |_, x, _| [x[1], x[0].sin()])
            .rising("forward", move |_, x, _| x[0] - ahead)
            .resets(move |_, x, _| [x[0].number(behind), kept * x[1]])
            .falling("backward", move |_, x, _| x[0] - behind)
            .resets(move |_, x, _| [x[0].number(ahead), kept * x[1]])
            .rests("stands")
            .mode_text("stands", &["0", "0"]);
        Ok(wheel.model()?.tolerance(TOLERANCE))
    }
}

/// The section after a forward collision, with the speed as coordinate, and the mode behind it.
struct AfterCollision(Wheel, Label);

impl Section<EquationsModel<State<2>>, 2, 1> for AfterCollision {
    fn point(&self, speed: &SVector<f64, 1>) -> (Label, State<2>) {
        (self.1, Vector2::new(self.0.slope - self.0.half_angle, speed[0]))
    }
    fn coordinates(&self, event: &Event<Label, Label, State<2>>) -> Option<SVector<f64, 1>> {
        let (_, state) = event.after.filter(|_| event.surface == "forward")?;
        Some(Vector1::new(state[1]))
    }
}

impl SmoothSection<EquationsModel<State<2>>, 2, 1> for AfterCollision {
    fn point_jacobian(&self, _: &SVector<f64, 1>) -> SMatrix<f64, 2, 1> {
        SMatrix::<f64, 2, 1>::new(0.0, 1.0)
    }
    fn coordinates_jacobian(&self, _: &Event<Label, Label, State<2>>) -> SMatrix<f64, 1, 2> {
        SMatrix::<f64, 1, 2>::new(0.0, 1.0)
    }
}

/// The periodic motion: its speed after a collision, and its multiplier.
fn roll(wheel: Wheel, guess: f64) -> Result<(f64, f64), Error> {
    let (model, section) = (wheel.model()?, AfterCollision(wheel, Label::new("rolls")?));
    let map = ReturnMap::new(&model, &section, Limits::new(100.0, 10));
    let step = |speed: &SVector<f64, 1>| {
        let back = map.next_with_derivative(speed)?;
        Ok((back.to.coordinates, back.derivative))
    };
    let point = periodic_point_with_derivative(step, &Vector1::new(guess), 1)?;
    Ok((point.location[0], point.multipliers[0].re))
}

fn main() -> Result<(), Error> {
    let wheel = Wheel { slope: 0.08, half_angle: std::f64::consts::PI / 8.0 };
    let (speed, multiplier) = roll(wheel, 0.7)?;
    println!("speed after each collision: {speed:.14}, exactly {:.14}", wheel.rolling_speed());
    println!("multiplier: {multiplier:.12}, exactly {:.12}", wheel.kept().powi(2));
    let start = Vector2::new(wheel.slope - wheel.half_angle, 0.99 * wheel.least_speed());
    let mut rocks = 0;
    for arc in wheel.model()?.start("rolls", start, 100.0)? {
        let arc = arc?;
        rocks += usize::from(arc.event().is_some());
        if arc.mode == "stands" {
            println!(
                "below the least speed it rocks {rocks} times and stands from t = {:.9}",
                arc.time
            );
        }
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_periodic_motion_and_its_multiplier() {
        for (slope, half_angle) in [(0.08, 0.3), (0.08, 0.39), (0.2, 0.5)] {
            let wheel = Wheel { slope, half_angle };
            let (speed, multiplier) = roll(wheel, wheel.rolling_speed() * 1.2).unwrap();
            assert!((speed - wheel.rolling_speed()).abs() < 1e-11, "{speed}");
            assert!((multiplier - wheel.kept().powi(2)).abs() < 1e-9, "{multiplier}");
        }
    }

    /// From any sufficient speed one step gives Ω′ = cos² 2α (Ω + 4 sin γ sin α).
    #[test]
    fn one_step_agrees_with_its_formula() {
        let wheel = Wheel { slope: 0.1, half_angle: 0.3 };
        let rolls = hybrid_system::Label::new("rolls").unwrap();
        let (model, section) = (wheel.model().unwrap(), AfterCollision(wheel, rolls));
        let map = ReturnMap::new(&model, &section, Limits::new(100.0, 10));
        for speed in [1.01, 1.5, 3.0].map(|factor| factor * wheel.least_speed()) {
            let image = map.image(speed).unwrap().unwrap();
            let gained = 4.0 * wheel.slope.sin() * wheel.half_angle.sin();
            let exact = wheel.kept() * (speed * speed + gained).sqrt();
            assert!((image - exact).abs() < 1e-11, "{image} {exact}");
        }
    }

    /// The return map is a labelling in one line. From the least speed on the wheel comes to its periodic motion;
    /// from lower speeds it stops, and such starts are reported.
    #[test]
    fn the_basin_of_rolling_begins_at_the_least_speed() {
        use basin_of_attraction::{
            Attractors, Hyperrectangle, Interval, Label, RecurrenceLimits, StateGrid,
            UnmatchedReason,
        };
        let wheel = Wheel { slope: 0.08, half_angle: 0.3 };
        let rolls = hybrid_system::Label::new("rolls").unwrap();
        let (model, section) = (wheel.model().unwrap(), AfterCollision(wheel, rolls));
        let map = ReturnMap::new(&model, &section, Limits::new(100.0, 10));
        let step = |speed: &[f64]| map.image(speed[0]).ok().flatten().map(|image| vec![image]);
        let (least, rolling) = (wheel.least_speed(), wheel.rolling_speed());
        let speeds = Interval::new(0.5 * least, 3.0 * rolling).unwrap();
        let starts: Vec<Vec<f64>> =
            [0.6, 0.9, 0.999, 1.001, 1.5, 4.0].map(|factor| vec![factor * least]).to_vec();
        let limits = RecurrenceLimits { locate: 50, tests: 50, ..RecurrenceLimits::default() };
        let region = Hyperrectangle::try_from(speeds).unwrap();
        let grid = StateGrid::uniform(region, 100).unwrap();
        let found = Attractors::search(&step, grid, &starts, limits).unwrap();
        assert_eq!(found.attractors().len(), 1);
        assert!((found.attractors()[0].points[0][0] - rolling).abs() < 1e-9);
        for (start, factor) in starts.iter().zip([0.6, 0.9, 0.999, 1.001, 1.5, 4.0]) {
            let expected = if factor > 1.0 { Label::from(1) } else { Label::UNDECIDED_MAP };
            assert_eq!(found.label(&step, start), expected, "{factor}");
        }
        let stopped = found.unmatched().iter().map(|orbit| orbit.reason);
        assert!(stopped.eq([UnmatchedReason::Stopped; 3]));
    }

    /// Below the least speed the wheel never passes the vertical. It rocks, and finally rests on two spokes.
    #[test]
    fn too_small_a_speed_ends_at_rest() {
        let wheel = Wheel { slope: 0.02, half_angle: 0.3 };
        let start = Vector2::new(wheel.slope - wheel.half_angle, 0.999 * wheel.least_speed());
        let arcs: Vec<_> = wheel
            .model()
            .unwrap()
            .start("rolls", start, 200.0)
            .unwrap()
            .collect::<Result<_, _>>()
            .unwrap();
        let last = arcs.last().unwrap();
        assert!(matches!(last.end, ArcEnd::TimeLimit { .. }));
        assert_eq!(last.mode, "stands");
    }
}
