//! What a landing depends on, over an interval of speeds.

use crate::fixed_points::fixed_point;
use crate::hop::first_landing::FirstLanding;
use crate::hop::flight::{Flight, Rates};
use interval_arithmetic::Enclosure;

/// The derivatives of a state and of the losses up to it, by one parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub(super) state: Rates,
    pub(super) losses: Enclosure,
}

/// A state on the ground after a landing, and the sum of the losses Σ Γ² up to it, with their derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Following {
    pub(super) x: Enclosure,
    pub(super) v: Enclosure,
    pub(super) losses: Enclosure,
    pub(super) by_speed: Slopes,
    pub(super) by_kappa: Slopes,
    /// The second derivatives by the speed. A single speed needs none.
    pub(super) by_speed_twice: Option<Slopes>,
}

impl Following {
    /// After the first landing from a window (docs/theory.md, Lemmas 5, 78 and 97).
    pub(super) fn from_window(
        alpha: Enclosure,
        first: &FirstLanding,
        kappa: Enclosure,
    ) -> Option<Self> {
        let (h, b) = (first.half, first.lead());
        let closing = first.closing_speed();
        let slope = first.half_time_slope();
        let rest = Enclosure::ONE - slope;
        // x = 2h (α − h) as well.
        let x = (2.0 * h * b).intersection(&(2.0 * h * (alpha - h)))?;
        let by_speed_twice = (alpha.low() < alpha.high()).then(|| {
            let bend = first.half_time_curvature();
            let closing = -4.0 * (b * slope + alpha * (rest * slope + b * bend));
            let state = Rates {
                x: 2.0 * (bend * (b - h) + 2.0 * slope * rest),
                v: -2.0 * bend + kappa * closing,
            };
            let losses = -8.0 * (first.d() * b + alpha * slope * first.sin_u_slope());
            Slopes { state, losses }
        });
        Some(Following {
            x: Enclosure::new(x.low().max(0.0), x.high()),
            v: b - h + kappa * closing,
            losses: closing.squared(),
            by_speed: Slopes {
                state: Rates {
                    x: 2.0 * b * slope + 2.0 * h * rest,
                    v: Enclosure::ONE - 2.0 * slope - 4.0 * kappa * alpha * b * slope,
                },
                losses: -8.0 * alpha * first.d() * b,
            },
            by_kappa: Slopes {
                state: Rates { x: Enclosure::ZERO, v: closing },
                losses: Enclosure::ZERO,
            },
            by_speed_twice,
        })
    }

    /// After the next landing, and whether a sudden lift-off follows it; `None` if that is open.
    pub(super) fn next(self, kappa: Enclosure) -> Option<(Self, bool)> {
        let flight = Flight::from(self.x, self.v)?;
        // A flight up to α*_1 is followed by contact (docs/theory.md, Lemma 17).
        let short = flight.time.high() <= fixed_point(1).low();
        let sudden = match flight.landed.sign() {
            _ if short => false,
            Some(sign) => sign > 0.0,
            None => return None,
        };
        let speed = flight.changes(self.by_speed.state, kappa, 0.0);
        let mass = flight.changes(self.by_kappa.state, kappa, 1.0);
        let by_speed_twice = self.by_speed_twice.map(|own| {
            let start = self.by_speed.state;
            let (state, loss) = flight.second_changes(start, own.state, &speed, kappa);
            Slopes { state, losses: own.losses + loss }
        });
        let next = Following {
            x: flight.landed,
            v: self.v - flight.time + kappa * flight.closing,
            losses: self.losses + flight.closing.squared(),
            by_speed: Slopes { state: speed.state, losses: self.by_speed.losses + speed.loss },
            by_kappa: Slopes { state: mass.state, losses: self.by_kappa.losses + mass.loss },
            by_speed_twice,
        };
        Some((next, sudden))
    }

    /// The part of these states, of all speeds at the distances `distance` from a middle one, that the mean value
    /// form allows: with the state of the middle speed, and with the derivatives over all speeds. Their widths then
    /// add, where interval arithmetic alone multiplies them.
    pub(super) fn narrowed(self, middle: &Self, distance: Enclosure) -> Option<Self> {
        let form = |at: Enclosure, slope: Enclosure, all: Enclosure| {
            (at + slope * distance).intersection(&all)
        };
        let slopes = |at: &Slopes, slope: &Slopes, all: &Slopes| -> Option<Slopes> {
            let state = Rates {
                x: form(at.state.x, slope.state.x, all.state.x)?,
                v: form(at.state.v, slope.state.v, all.state.v)?,
            };
            Some(Slopes { state, losses: form(at.losses, slope.losses, all.losses)? })
        };
        let by_speed = match &self.by_speed_twice {
            Some(twice) => slopes(&middle.by_speed, twice, &self.by_speed)?,
            None => self.by_speed,
        };
        Some(Following {
            x: form(middle.x, by_speed.state.x, self.x)?,
            v: form(middle.v, by_speed.state.v, self.v)?,
            losses: form(middle.losses, by_speed.losses, self.losses)?,
            by_speed,
            ..self
        })
    }
}
