//! The state of both masses some time after a take-off or a landing, enclosed.

use crate::evidence::enclosed::Enclosed;
use crate::evidence::enclosed_hop::{contact_excess, contact_speed, height, versine};
use crate::map::extended_hop::ExtendedMasses;
use crate::model::mass_ratio::MassRatio;
use crate::precision::ball::Ball;
use crate::precision::double_double::DoubleDouble;

/// The positions and velocities of both masses; [`HopperState`](crate::HopperState) has the meaning of its fields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnclosedState {
    /// y₁.
    pub upper_position: Enclosed,
    /// ẏ₁.
    pub upper_velocity: Enclosed,
    /// y₂.
    pub lower_position: Enclosed,
    /// ẏ₂.
    pub lower_velocity: Enclosed,
}

/// Where a phase begins: the stretch is 1 + `excess`, the upper mass has the `velocity`, and the lower one is at
/// rest on the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnclosedStart {
    /// x.
    pub excess: Enclosed,
    /// V.
    pub velocity: Enclosed,
}

type Short = Ball<DoubleDouble>;

fn ball(of: Enclosed) -> Short {
    Ball { radius: of.error, ..Ball::exact(of.value) }
}

impl EnclosedStart {
    /// The state of the start itself.
    fn state(self) -> EnclosedState {
        let none = Enclosed { value: 0.0, error: 0.0 };
        let upper_position = match self.excess == none {
            true => Enclosed { value: 1.0, error: 0.0 },
            false => Enclosed::of(ball(self.excess) + Ball::exact(1.0)),
        };
        EnclosedState {
            upper_position,
            upper_velocity: self.velocity,
            lower_position: none,
            lower_velocity: none,
        }
    }

    /// The state after `time` in flight.
    pub fn after_flight(self, mass_ratio: MassRatio, time: Enclosed) -> EnclosedState {
        if time.value == 0.0 && time.error == 0.0 {
            return self.state();
        }
        let masses = ExtendedMasses::<DoubleDouble>::new(mass_ratio);
        // 1/(1+M) = μ/κ.
        let share = Short::near(masses.mu) / Short::near(masses.kappa);
        let (x, v, t) = (ball(self.excess), ball(self.velocity), ball(time));
        let (sin, cos) = t.sin_cos();
        let stretched = x + Ball::exact(1.0);
        let (lag, _) = t.sine_remainders(sin, cos);
        let lower = share * height(t, x, v);
        let lower_velocity = -(share * (lag - v * versine(t) - x * sin));
        EnclosedState {
            upper_position: Enclosed::of(stretched * cos + v * sin + lower),
            upper_velocity: Enclosed::of(v * cos - stretched * sin + lower_velocity),
            lower_position: Enclosed::of(lower),
            lower_velocity: Enclosed::of(lower_velocity),
        }
    }

    /// The state after `time` on the ground.
    pub fn after_contact(self, mass_ratio: MassRatio, time: Enclosed) -> EnclosedState {
        let kappa = Short::near(ExtendedMasses::<DoubleDouble>::new(mass_ratio).kappa);
        let (x, v, t) = (ball(self.excess), ball(self.velocity), ball(time));
        let upper_position = contact_excess(x, v, kappa, t) + Ball::exact(1.0);
        EnclosedState {
            upper_position: Enclosed::of(upper_position),
            upper_velocity: Enclosed::of(contact_speed(x, v, kappa, t)),
            ..self.state()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::contact::contact_flow;
    use crate::model::motion::Flight;
    use crate::model::state::HopperState;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn states_hold_those_of_the_plain_flows(
            m in -2.0..2f64, x in 0.0..3f64, v in -5.0..20f64, time in 0.0..10f64, error in -13.0..-4f64, part in -1.0..1f64
        ) {
            let (ratio, error) = (MassRatio::new(pxfm::f_exp10(m)).unwrap(), pxfm::f_exp10(error));
            let near = |value: f64| Enclosed { value, error };
            let start = EnclosedStart { excess: near(x), velocity: near(v) };
            let plain = HopperState {
                upper_position: 1.0 + x + part * error,
                upper_velocity: v - part * error,
                lower_position: 0.0,
                lower_velocity: 0.0,
            };
            let flight = Flight::new(ratio, &plain).state(time + part * error);
            let contact = contact_flow(ratio, &plain, time + part * error);
            let pairs = [
                (start.after_flight(ratio, near(time)), flight),
                (start.after_contact(ratio, near(time)), contact),
            ];
            for (found, plain) in pairs {
                let numbers = [
                    (found.upper_position, plain.upper_position),
                    (found.upper_velocity, plain.upper_velocity),
                    (found.lower_position, plain.lower_position),
                    (found.lower_velocity, plain.lower_velocity),
                ];
                for (found, plain) in numbers {
                    // The rounding of the plain flow.
                    let rounding = 1e-13 * (1.0 + plain.abs() + 1.0 / ratio.value());
                    prop_assert!((found.value - plain).abs() <= found.error + rounding, "{found:?} {plain}");
                    prop_assert!(found.error <= 1e4 * error, "{found:?}");
                }
            }
        }
    }
}
