//! The first landing after a gradual lift-off, over an interval of speeds.

use crate::fixed_points::fixed_point;
use crate::hop::half_time::AtHalfTime;
use crate::hop::landing_time::first_landing_time;
use crate::hop::part::SpeedPart;
use interval_arithmetic::{Enclosure, PI};

/// The first landing over an interval of speeds: half the time, and the closed forms at its ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FirstLanding {
    /// h.
    pub(crate) half: Enclosure,
    ends: [AtHalfTime; 2],
}

impl FirstLanding {
    /// Over the speeds of `alpha` that are in `part`; `None` if an end of h is beyond a fixed point. There Γ has a
    /// minimum between the ends, so that its values at them are no bounds.
    pub(crate) fn over(alpha: Enclosure, part: SpeedPart) -> Option<Self> {
        let first = first_landing_time(alpha.low())?;
        let last =
            if alpha.low() == alpha.high() { first } else { first_landing_time(alpha.high())? };
        let mut ends = [first.before(), last.after()];
        // h is on the same side of a multiple of π as α (docs/theory.md, Theorem 7), where |u| is largest.
        match part {
            SpeedPart::Window(n) if ends[0].h < (PI * n as f64).high() => {
                ends[0] = AtHalfTime::at_multiple_of_pi(n, (PI * n as f64).low());
            }
            SpeedPart::Contact(n) if ends[1].h > (PI * (n + 1) as f64).low() => {
                ends[1] = AtHalfTime::at_multiple_of_pi(n + 1, (PI * (n + 1) as f64).high());
            }
            _ => {}
        }
        let (below, above) = (fixed_point(first.branch - 1), fixed_point(last.branch));
        let between = below.high() <= ends[0].h && ends[1].h <= above.low();
        between.then_some(FirstLanding { half: Enclosure::new(ends[0].h, ends[1].h), ends })
    }

    /// The values of a function that is monotone in h, from its ends.
    fn between(&self, f: fn(&AtHalfTime) -> Enclosure) -> Enclosure {
        f(&self.ends[0]).hull(&f(&self.ends[1]))
    }

    /// Γ. On contact parts it rises where it is not monotone by this: there Γ² has the derivative 8αW > 0 by α
    /// (docs/theory.md, Lemma 26), and in windows it falls (Lemma 14).
    pub(crate) fn closing_speed(&self) -> Enclosure {
        let found = self.between(AtHalfTime::closing_speed);
        Enclosure::new(found.low().max(0.0), found.high())
    }

    /// W at both ends, on a contact part.
    pub(crate) fn w_at_ends(&self) -> [Enclosure; 2] {
        [self.ends[0].w(), self.ends[1].w()]
    }

    /// b = α − h = Su/D in a window: |S| rises and |u/D| falls (docs/theory.md, Lemma 14).
    pub(crate) fn lead(&self) -> Enclosure {
        let found = self.between(|end| end.sin) * self.between(AtHalfTime::rho);
        Enclosure::new(found.low().max(0.0), found.high().max(0.0))
    }

    /// D = h − SC, which rises.
    pub(crate) fn d(&self) -> Enclosure {
        self.between(|end| end.d)
    }

    /// dh/dα = D/Γ in a window, where Γ/D falls.
    pub(crate) fn half_time_slope(&self) -> Enclosure {
        self.between(|end| end.d / end.closing_speed())
    }

    /// d²h/dα² = 2 (dh/dα)² (2S²/D + hS/u) in a window (docs/theory.md, Lemma 97).
    pub(crate) fn half_time_curvature(&self) -> Enclosure {
        let (sin, u) = self.sin_and_u();
        2.0 * self.half_time_slope().squared()
            * (2.0 * sin.squared() / self.d() + self.half * sin / u)
    }

    /// d(Su)/dh = Cu − hS² in a window.
    pub(crate) fn sin_u_slope(&self) -> Enclosure {
        let (sin, u) = self.sin_and_u();
        self.half.cos() * u - self.half * sin.squared()
    }

    /// S and u in a window, where |S| rises and |u| falls (docs/theory.md, Lemma 14).
    fn sin_and_u(&self) -> (Enclosure, Enclosure) {
        (self.between(|end| end.sin), self.between(|end| end.u))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::alpha_star;

    /// Γ ≈ ½ a t² with t³ = 12 a² δ/(1 + a²), within some ulps above a fixed point (docs/theory.md, Lemma 34): no
    /// f64 is nearer to α*_1 than the first one here, and its landing is enclosed by times on both sides of α*_1.
    #[test]
    fn closing_speeds_next_to_a_fixed_point_are_not_too_large() {
        let a = alpha_star(1);
        let ulp = a.next_up() - a;
        // t³ from Γ.
        let cube = |closing: f64| (2.0 * closing / a) * (2.0 * closing / a).sqrt();
        let mut known = 0;
        for ulps in [0.0, 8.0] {
            let alpha = a + ulps * ulp;
            let Some(landing) = FirstLanding::over(Enclosure::from(alpha), SpeedPart::Contact(1))
            else {
                continue;
            };
            known += 1;
            let closing = landing.closing_speed();
            let exact = 12.0 * a * a * (3.32e-17 + ulps * ulp) / (1.0 + a * a);
            assert!(cube(closing.low()) < 1.01 * exact && 0.99 * exact < cube(closing.high()));
        }
        assert_eq!(known, 1);
    }

    /// At a multiple of π |u| has its largest value, kπ, which lies between two `f64`.
    #[test]
    fn bounds_hold_the_values_at_multiples_of_pi() {
        for k in 1..=8 {
            let multiple = PI * k as f64;
            let window = FirstLanding::over(multiple, SpeedPart::Window(k)).unwrap();
            assert!(multiple.is_inside(&window.sin_and_u().1.abs()), "{k}");
            for part in [SpeedPart::Window(k), SpeedPart::Contact(k - 1)] {
                let closing = FirstLanding::over(multiple, part).unwrap().closing_speed();
                assert!((2.0 * multiple).is_inside(&closing), "{k}: {closing:?}");
            }
        }
    }
}
