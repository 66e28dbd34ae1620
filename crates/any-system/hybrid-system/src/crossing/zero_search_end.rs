//! What a search for zeros knows where it ends: at the horizon, or where rounding hides the function.

use super::bounded::Bounded;
use super::found::Found;
use super::hidden::closest;
use super::zero_search::{Phase, Stretch, ZeroSearch};
use crate::error::Error;

impl ZeroSearch {
    /// The crossing at the horizon of a monotone function whose computed value is zero or beyond it there, although
    /// rounding hides the sign.
    pub(super) fn reaches_horizon(
        &self,
        function: &impl Bounded,
        Stretch { from, until, is_last }: Stretch,
        slope: f64,
    ) -> Result<Option<Found>, Error> {
        let side = self.side.unwrap_or(slope);
        let comes = is_last
            && slope * side < 0.0
            && self.phase == Phase::OnSide
            && self.direction.admits(side, -side)
            && (function.value(until) - self.level) * side <= 0.0;
        if !comes {
            return Ok(None);
        }
        let after = self.clear.max(from);
        let time = self.root(function, side, after, until, until)?;
        let error = function.root_error(time, after, until)?;
        Ok(Some(Found::Crossing { time, error, hidden: false, rising: side < 0.0 }))
    }

    /// What is known of a hidden interval that reaches the end of a stretch.
    pub(super) fn hidden_at_end(&mut self, function: &impl Bounded, stretch: Stretch) -> Found {
        let Stretch { from, until, is_last } = stretch;
        let Some(hidden) = &mut self.hidden else { return Found::Nothing };
        let closest = closest(function, self.level, hidden, from, until);
        hidden.closest = Some(closest);
        if !is_last {
            return Found::Nothing;
        }
        let last = function.value(until) - self.level;
        if self.side.is_some_and(|side| last * side < 0.0) {
            // It has changed its sign on the last stretch, by a jump.
            return self.crossing_at_horizon(from, until, last.signum());
        }
        match self.unclear {
            true => Found::Nothing,
            false => Found::Undecided { time: closest.0, value: closest.1 },
        }
    }

    /// What a change of sign to `sign` on a hidden stretch that ends at the horizon is.
    fn crossing_at_horizon(&mut self, from: f64, until: f64, sign: f64) -> Found {
        let hidden = self.hidden.take().map_or(from, |hidden| hidden.from);
        let counts = self.direction.admits(-sign, sign) && self.phase == Phase::OnSide;
        (self.side, self.clear) = (Some(sign), until);
        self.has_passed();
        match counts {
            true => Found::Crossing {
                time: until,
                error: until - hidden,
                hidden: true,
                rising: sign > 0.0,
            },
            false => Found::Nothing,
        }
    }
}
