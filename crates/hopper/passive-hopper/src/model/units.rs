//! Conversion between quantities with dimensions (metres, kilograms, seconds) and the dimensionless model.

use crate::error::Error;
use crate::model::mass_ratio::MassRatio;
use crate::model::state::HopperState;

/// A hopper with dimensions, in any consistent units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhysicalHopper {
    upper_mass: f64,
    lower_mass: f64,
    stiffness: f64,
    gravity: f64,
}

/// Bounds on the relative errors of the units of a [`PhysicalHopper`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitErrors {
    /// Of the mass ratio.
    pub mass_ratio: f64,
    /// Of the unit of length.
    pub length: f64,
    /// Of ω.
    pub angular_frequency: f64,
    /// Of the unit of time.
    pub time: f64,
    /// Of the unit of speed.
    pub speed: f64,
    /// Of the unit of energy.
    pub energy: f64,
}

impl PhysicalHopper {
    /// m₁ (upper), m₂ (lower), k and g.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless all of them, and the units computed from them, are positive and finite;
    /// [`Error::MassRatio`] for a ratio out of range.
    pub fn new(
        upper_mass: f64,
        lower_mass: f64,
        stiffness: f64,
        gravity: f64,
    ) -> Result<Self, Error> {
        let given = [("m1", upper_mass), ("m2", lower_mass), ("k", stiffness), ("g", gravity)];
        for (name, value) in given {
            if !(value > 0.0) || !value.is_finite() {
                return Err(Error::Parameter { name, value });
            }
        }
        MassRatio::new(lower_mass / upper_mass)?;
        let hopper = PhysicalHopper { upper_mass, lower_mass, stiffness, gravity };
        let units = [
            ("m2 g/k", hopper.length_unit()),
            ("ω", hopper.angular_frequency()),
            ("m2 g ω/k", hopper.speed_unit()),
            ("m1 m2 g²/k", hopper.energy_unit()),
        ];
        match units.into_iter().find(|(_, unit)| !unit.is_normal()) {
            Some((name, value)) => Err(Error::Parameter { name, value }),
            None => Ok(hopper),
        }
    }

    /// M = m₂/m₁.
    ///
    /// # Errors
    /// None after a successful [`new`](Self::new).
    pub fn mass_ratio(&self) -> Result<MassRatio, Error> {
        MassRatio::new(self.lower_mass / self.upper_mass)
    }

    /// The unit of length, m₂g/k: the stretch of the spring under the weight of the lower mass.
    pub fn length_unit(&self) -> f64 {
        self.lower_mass * self.gravity / self.stiffness
    }

    /// ω = √(k (1+M)/m₂), the angular frequency in flight.
    pub fn angular_frequency(&self) -> f64 {
        (self.stiffness * (1.0 / self.upper_mass + 1.0 / self.lower_mass)).sqrt()
    }

    /// The unit of time, 1/ω.
    pub fn time_unit(&self) -> f64 {
        1.0 / self.angular_frequency()
    }

    /// The unit of speed, m₂gω/k.
    pub fn speed_unit(&self) -> f64 {
        self.length_unit() * self.angular_frequency()
    }

    /// The unit of energy, m₁m₂g²/k.
    pub fn energy_unit(&self) -> f64 {
        self.upper_mass * self.gravity * self.length_unit()
    }

    /// Bounds on the relative errors of the units, if each of the four given quantities has a relative error of
    /// `given` at most: that of their conversion to metres, kilograms and seconds.
    pub fn unit_errors(given: f64) -> UnitErrors {
        // So many given quantities, and so many roundings of half an ulp, enter each of them.
        let of = |quantities: f64, roundings: f64| {
            1.01 * (quantities * given + roundings * 0.5 * f64::EPSILON)
        };
        // ω is a root, which halves the errors of k and of 1/m₁ + 1/m₂, and rounds once itself.
        UnitErrors {
            mass_ratio: of(2.0, 1.0),
            length: of(3.0, 2.0),
            angular_frequency: of(1.0, 2.5),
            time: of(1.0, 3.5),
            speed: of(4.0, 5.5),
            energy: of(5.0, 4.0),
        }
    }

    /// The dimensionless form of a state with dimensions (displacements from the relaxed spring on the ground).
    pub fn to_dimensionless(&self, state: &HopperState) -> HopperState {
        scaled(state, 1.0 / self.length_unit(), 1.0 / self.speed_unit())
    }

    /// The form with dimensions of a dimensionless state.
    pub fn to_physical(&self, state: &HopperState) -> HopperState {
        scaled(state, self.length_unit(), self.speed_unit())
    }
}

fn scaled(state: &HopperState, length: f64, speed: f64) -> HopperState {
    HopperState {
        upper_position: state.upper_position * length,
        upper_velocity: state.upper_velocity * speed,
        lower_position: state.lower_position * length,
        lower_velocity: state.lower_velocity * speed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn units_match_the_paper() {
        let hopper = PhysicalHopper::new(2.0, 0.5, 300.0, 9.81).unwrap();
        assert_eq!(hopper.mass_ratio().unwrap().value(), 0.25);
        // ω² = k (1+M)/m₂
        let omega = hopper.angular_frequency();
        assert_relative_eq!(omega * omega, 300.0 * 1.25 / 0.5, max_relative = 1e-15);
        // The flight equations with dimensions give the dimensionless ones with this unit of acceleration.
        let unit = hopper.length_unit() * omega * omega;
        assert_relative_eq!(unit, 9.81 * 1.25, max_relative = 1e-15);
    }

    #[test]
    fn conversion_and_its_inverse() {
        let hopper = PhysicalHopper::new(1.0, 1.0, 500.0, 9.8).unwrap();
        let state = HopperState::lift_off(7.0);
        let back = hopper.to_dimensionless(&hopper.to_physical(&state));
        assert_relative_eq!(back.upper_velocity, 7.0, max_relative = 1e-15);
    }

    #[test]
    fn errors_name_the_parameter() {
        let error = PhysicalHopper::new(1.0, 1.0, -3.0, 9.8).unwrap_err();
        assert_eq!(error.to_string(), "k must be positive and finite, not -3.0");
    }
}
