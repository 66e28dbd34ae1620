//! The first landing after a gradual lift-off, over an interval of speeds.

use crate::hop::landing_time::first_landing_time;
use crate::hop::time_functions::TimeFunctions;
use interval_arithmetic::Enclosure;

/// The closed forms of a flight from (0, α) that lasts 2h, at one h (docs/theory.md, Section 1).
#[derive(Debug, Clone, Copy)]
struct AtHalfTime {
    sin: Enclosure,
    /// D = h − SC.
    d: Enclosure,
    /// u = hC − S.
    u: Enclosure,
}

impl AtHalfTime {
    fn new(h: f64) -> Self {
        let half = Enclosure::new(h, h);
        let (sin, cos) = (half.sin(), half.cos());
        AtHalfTime { sin, d: 0.5 * TimeFunctions::at(2.0 * h).p, u: half * cos - sin }
    }
    fn rho(&self) -> Enclosure {
        self.u / self.d
    }
    fn closing_speed(&self) -> Enclosure {
        2.0 * self.u.squared() / self.d
    }
    /// W = −Su.
    fn w(&self) -> Enclosure {
        -(self.sin * self.u)
    }
}

/// The first landing over an interval of speeds: half the time, and the closed forms at its ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FirstLanding {
    /// h.
    pub(crate) half: Enclosure,
    ends: [AtHalfTime; 2],
}

impl FirstLanding {
    /// Over the speeds of `alpha`, which lie on one contact part or in one window.
    pub(crate) fn over(alpha: Enclosure) -> Option<Self> {
        let low = first_landing_time(alpha.low)?.time.low;
        let high = if alpha.low == alpha.high {
            first_landing_time(alpha.low)?.time.high
        } else {
            first_landing_time(alpha.high)?.time.high
        };
        let half = Enclosure::new(0.5 * low, 0.5 * high);
        Some(FirstLanding { half, ends: [AtHalfTime::new(half.low), AtHalfTime::new(half.high)] })
    }

    /// The values of a function that is monotone in h, from its ends.
    fn between(&self, f: fn(&AtHalfTime) -> Enclosure) -> Enclosure {
        f(&self.ends[0]).hull(&f(&self.ends[1]))
    }

    /// Γ. On contact parts it rises where it is not monotone by this: there Γ² has the derivative 8αW > 0 by α (docs/theory.md, Lemma
    /// 26), and in windows it falls (Lemma 14).
    pub(crate) fn closing_speed(&self) -> Enclosure {
        let found = self.between(AtHalfTime::closing_speed);
        Enclosure::new(found.low.max(0.0), found.high)
    }

    /// W at both ends, on a contact part.
    pub(crate) fn w_at_ends(&self) -> [Enclosure; 2] {
        [self.ends[0].w(), self.ends[1].w()]
    }

    /// b = α − h = Su/D in a window: |S| rises and |u/D| falls (docs/theory.md, Lemma 14).
    pub(crate) fn lead(&self) -> Enclosure {
        let found = self.between(|end| end.sin) * self.between(AtHalfTime::rho);
        Enclosure::new(found.low.max(0.0), found.high.max(0.0))
    }

    /// D = h − SC, which rises.
    pub(crate) fn d(&self) -> Enclosure {
        self.between(|end| end.d)
    }

    /// dh/dα = D/Γ in a window, where Γ/D falls.
    pub(crate) fn half_time_slope(&self) -> Enclosure {
        self.between(|end| end.d / end.closing_speed())
    }
}
