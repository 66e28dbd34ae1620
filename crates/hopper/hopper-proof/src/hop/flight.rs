//! A flight after a sudden lift-off, with the derivatives of its landing.

use crate::hop::landing_time::landings_between;
use crate::hop::time_functions::TimeFunctions;
use interval_arithmetic::Enclosure;

/// The flights from all states of two intervals.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flight {
    at: TimeFunctions,
    pub(super) time: Enclosure,
    /// The start.
    x: Enclosure,
    v: Enclosure,
    /// Γ.
    pub(super) closing: Enclosure,
    /// The stretch at the landing.
    pub(super) landed: Enclosure,
}

/// The derivatives of a stretch and of a velocity by one parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rates {
    pub(super) x: Enclosure,
    pub(super) v: Enclosure,
}

/// The derivatives of one landing by one parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Changes {
    /// Of the state after it.
    pub(super) state: Rates,
    /// Of Γ².
    pub(super) loss: Enclosure,
    time: Enclosure,
    closing: Enclosure,
}

impl Flight {
    /// From the stretch x ≥ 0 with the velocity v; `None` if the next landing is open.
    pub(super) fn from(x: Enclosure, v: Enclosure) -> Option<Self> {
        let ends = landings_between(x, v)?;
        let at = TimeFunctions::between(&ends);
        let time = Enclosure::new(2.0 * ends[0].h, 2.0 * ends[1].h);
        // Γ = τ − V r − (1 + x) sin τ; it is never negative at a landing.
        let closing = at.p - v * at.r - x * at.sin;
        let closing = Enclosure::new(closing.low().max(0.0), closing.high());
        // x′ by P and by s (docs/theory.md, Lemma 1).
        let by_centre = x + v * time - 0.5 * time.squared();
        let landed = by_centre.intersection(&(x * at.cos - at.r + v * at.sin))?;
        Some(Flight { at, time, x, v, closing, landed })
    }

    /// ∂s/∂τ at the landing, where s is the stretch and 1.
    fn stretching(&self) -> Enclosure {
        self.v * self.at.cos - (Enclosure::ONE + self.x) * self.at.sin
    }

    /// The changes at the landing for changes of the start, and for `kappa_part` = dκ (docs/theory.md, Lemma 16).
    pub(super) fn changes(&self, start: Rates, kappa: Enclosure, kappa_part: f64) -> Changes {
        let TimeFunctions { sin, cos, r, p, .. } = self.at;
        let Rates { x, v } = start;
        let height = r * x + p * v;
        // ½ d(Γ²): without the division by Γ, which is small next to a grazing.
        let half_loss = -(self.closing * (sin * x + r * v)) - self.landed * height;
        let (time, closing) = (height / self.closing, half_loss / self.closing);
        let state = Rates {
            x: cos * x + sin * v + self.stretching() * time,
            v: v - time + kappa * closing + kappa_part * self.closing,
        };
        Changes { state, loss: 2.0 * half_loss, time, closing }
    }

    /// The second derivatives of the state after the landing and of Γ², from the first ones and from the second
    /// ones of the start (docs/theory.md, Lemma 97).
    pub(super) fn second_changes(
        &self,
        start: Rates,
        second: Rates,
        first: &Changes,
        kappa: Enclosure,
    ) -> (Rates, Enclosure) {
        let TimeFunctions { sin, cos, r, p, .. } = self.at;
        let Rates { x, v } = start;
        let height = self.landed * first.time.squared()
            + 2.0 * first.time * (sin * x + r * v)
            + r * second.x
            + p * second.v;
        let time = height / self.closing;
        let landed = cos * second.x
            + sin * second.v
            + 2.0 * first.time * (cos * v - sin * x)
            + self.stretching() * time
            - (Enclosure::ONE + self.landed) * first.time.squared();
        let closing = -(first.state.x * first.time)
            - self.landed * time
            - r * second.v
            - sin * second.x
            - first.time * (sin * v + cos * x);
        let loss = 2.0 * (first.closing.squared() + self.closing * closing);
        (Rates { x: landed, v: second.v - time + kappa * closing }, loss)
    }
}
