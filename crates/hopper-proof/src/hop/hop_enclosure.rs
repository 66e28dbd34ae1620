//! The hops from all speeds of an interval, at all mass ratios of a strip.

use crate::fixed_points::fixed_point;
use crate::hop::first_landing::FirstLanding;
use crate::hop::landing_time::landings_between;
use crate::hop::strip::Strip;
use crate::hop::time_functions::TimeFunctions;
use interval_arithmetic::{Enclosure, PI};

/// Most sudden lift-offs of a hop that are followed. Orbits with more, at large M, stay open.
const MOST_SUDDEN: usize = 64;

/// F = α′² of the hop, below zero where the hopper is grounded, with its derivatives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HopEnclosure {
    /// F.
    pub(crate) square: Enclosure,
    /// ∂F/∂α.
    pub(crate) by_speed: Enclosure,
    /// ∂F/∂κ.
    pub(crate) by_kappa: Enclosure,
}

/// A part of the speeds on which the first landing is of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// (α*_n, (n+1)π): contact follows.
    Contact(u64),
    /// (nπ, α*_n), n ≥ 1: a sudden lift-off follows.
    Window(u64),
}

impl Part {
    /// The part that contains all speeds of an interval; `None` if it reaches to a multiple of π or a fixed point.
    pub(crate) fn of(alpha: Enclosure) -> Option<Self> {
        if !(alpha.low > 0.0 && alpha.high < 1e9) {
            return None;
        }
        let k = (alpha.low / std::f64::consts::PI).floor();
        let (begin, end) = (PI * k, PI * (k + 1.0));
        if !((k == 0.0 || begin.high <= alpha.low) && alpha.high <= end.low) {
            return None;
        }
        let star = fixed_point(k as u64);
        if alpha.high <= star.low && k >= 1.0 {
            Some(Part::Window(k as u64))
        } else if alpha.low >= star.high {
            Some(Part::Contact(k as u64))
        } else {
            None
        }
    }
}

/// What a landing depends on, over an interval: a state on the ground with its derivatives by α and by κ, and the sum of the losses.
#[derive(Debug, Clone, Copy)]
struct Following {
    x: Enclosure,
    v: Enclosure,
    /// (∂x, ∂V) by α and by κ.
    by_speed: (Enclosure, Enclosure),
    by_kappa: (Enclosure, Enclosure),
    /// Σ Γ², with its derivatives.
    losses: Enclosure,
    losses_by_speed: Enclosure,
    losses_by_kappa: Enclosure,
}

/// The derivatives of one flight by one parameter (docs/theory.md, Lemma 16).
struct Changes {
    /// ½ d(Γ²).
    half_square: Enclosure,
    dx: Enclosure,
    dv: Enclosure,
}

struct Flight {
    at: TimeFunctions,
    x: Enclosure,
    v: Enclosure,
    closing: Enclosure,
    landed: Enclosure,
}

impl Flight {
    /// The changes at the landing for changes of the start, and for `kappa_part` = dκ.
    fn changes(
        &self,
        (dx, dv): (Enclosure, Enclosure),
        kappa: Enclosure,
        kappa_part: f64,
    ) -> Changes {
        let TimeFunctions { sin, cos, r, p, .. } = self.at;
        let height = r * dx + p * dv;
        let half_square = -(self.closing * (sin * dx + r * dv)) - self.landed * height;
        let dtime = height / self.closing;
        let stretch = Enclosure::ONE + self.x;
        Changes {
            half_square,
            dx: cos * dx + sin * dv + (self.v * cos - stretch * sin) * dtime,
            dv: dv - dtime + kappa * (half_square / self.closing) + kappa_part * self.closing,
        }
    }
}

impl Following {
    /// After the first landing from a window (docs/theory.md, Lemmas 5 and 78).
    fn from_window(alpha: Enclosure, first: &FirstLanding, kappa: Enclosure) -> Option<Self> {
        let (h, b) = (first.half, first.lead());
        let closing = first.closing_speed();
        let slope = first.half_time_slope();
        // x = 2h (α − h) as well.
        let x = (2.0 * h * b).intersection(&(2.0 * h * (alpha - h)))?;
        Some(Following {
            x: Enclosure::new(x.low.max(0.0), x.high),
            v: b - h + kappa * closing,
            by_speed: (
                2.0 * b * slope + 2.0 * h * (Enclosure::ONE - slope),
                Enclosure::ONE - 2.0 * slope - 4.0 * kappa * alpha * b * slope,
            ),
            by_kappa: (Enclosure::ZERO, closing),
            losses: closing.squared(),
            losses_by_speed: -8.0 * alpha * first.d() * b,
            losses_by_kappa: Enclosure::ZERO,
        })
    }

    /// After the next landing, and whether a sudden lift-off follows it; `None` if that is open.
    fn next(self, kappa: Enclosure) -> Option<(Self, bool)> {
        let Following { x, v, .. } = self;
        let ends = landings_between(x, v)?;
        let at = TimeFunctions::between(&ends);
        let time = Enclosure::new(2.0 * ends[0].h, 2.0 * ends[1].h);
        // Γ = τ − V r − (1 + x) sin τ; it is never negative at a landing.
        let closing = at.p - v * at.r - x * at.sin;
        let closing = Enclosure::new(closing.low.max(0.0), closing.high);
        // x′ by P and by s (docs/theory.md, Lemma 1).
        let by_centre = x + v * time - 0.5 * time.squared();
        let landed = by_centre.intersection(&(x * at.cos - at.r + v * at.sin))?;
        // A flight up to α*_1 is followed by contact (docs/theory.md, Lemma 17).
        let short = time.high <= fixed_point(1).low;
        let sudden = match landed.sign() {
            _ if short => false,
            Some(sign) => sign > 0.0,
            None => return None,
        };
        let flight = Flight { at, x, v, closing, landed };
        let speed = flight.changes(self.by_speed, kappa, 0.0);
        let mass = flight.changes(self.by_kappa, kappa, 1.0);
        let next = Following {
            x: landed,
            v: v - time + kappa * closing,
            by_speed: (speed.dx, speed.dv),
            by_kappa: (mass.dx, mass.dv),
            losses: self.losses + closing.squared(),
            losses_by_speed: self.losses_by_speed + 2.0 * speed.half_square,
            losses_by_kappa: self.losses_by_kappa + 2.0 * mass.half_square,
        };
        Some((next, sudden))
    }
}

/// The hop from the middle of an interval of speeds. From it, and from the derivatives by α, the mean value form encloses the states
/// after a landing: their widths then add, where interval arithmetic alone multiplies them.
struct Centre {
    /// α − the middle, over the interval.
    distance: Enclosure,
    state: Following,
}

impl Centre {
    /// `None` for a single speed, which is narrow as it is.
    fn of(alpha: Enclosure, kappa: Enclosure) -> Option<Self> {
        let middle = Enclosure::new(alpha.middle(), alpha.middle());
        if alpha.low == alpha.high {
            return None;
        }
        let state = Following::from_window(middle, &FirstLanding::over(middle)?, kappa)?;
        Some(Centre { distance: alpha - middle, state })
    }

    fn next(self, kappa: Enclosure) -> Option<Self> {
        Some(Centre { state: self.state.next(kappa)?.0, ..self })
    }

    /// The part of the states of all hops that the mean value form allows.
    fn narrowed(&self, all: Following) -> Option<Following> {
        let form = |at: Enclosure, slope: Enclosure, all: Enclosure| {
            (at + slope * self.distance).intersection(&all)
        };
        Some(Following {
            x: form(self.state.x, all.by_speed.0, all.x)?,
            v: form(self.state.v, all.by_speed.1, all.v)?,
            losses: form(self.state.losses, all.losses_by_speed, all.losses)?,
            ..all
        })
    }
}

impl HopEnclosure {
    /// All hops, by interval arithmetic alone: narrow only where the intervals are. `None` if the intervals do not tell the number of
    /// sudden lift-offs.
    pub(crate) fn plain(alpha: Enclosure, part: Part, strip: &Strip) -> Option<Self> {
        let first = FirstLanding::over(alpha)?;
        let (kappa, mu) = (strip.kappa, strip.mu);
        let tilt = Enclosure::ONE - 2.0 * kappa;
        if let Part::Contact(n) = part {
            let square = first.closing_speed().squared();
            return Some(HopEnclosure {
                square: alpha.squared() - mu * square,
                by_speed: 2.0 * alpha * (Enclosure::ONE - 4.0 * mu * w_over(&first, n)),
                by_kappa: -(tilt * square),
            });
        }
        let mut state = Following::from_window(alpha, &first, kappa)?;
        let mut centre = Centre::of(alpha, kappa);
        for _ in 0..MOST_SUDDEN {
            let (next, again) = state.next(kappa)?;
            centre = centre.and_then(|centre| centre.next(kappa));
            state = centre.as_ref().and_then(|centre| centre.narrowed(next)).unwrap_or(next);
            if !again {
                return Some(HopEnclosure {
                    square: alpha.squared() - mu * state.losses,
                    by_speed: 2.0 * alpha - mu * state.losses_by_speed,
                    by_kappa: -(tilt * state.losses) - mu * state.losses_by_kappa,
                });
            }
        }
        None
    }
}

/// W over a contact part: it rises to h = ½ α*_{2n+1} and then falls, and its maximum is (R+1)²/(4R) with R² = 1 + α*²_{2n+1} (docs/theory.md,
/// Lemma 27).
pub(crate) fn w_over(first: &FirstLanding, n: u64) -> Enclosure {
    let [begin, end] = first.w_at_ends();
    let ends = begin.hull(&end);
    let twice = fixed_point(2 * n + 1);
    let steepest = 0.5 * twice;
    if first.half.high < steepest.low || first.half.low > steepest.high {
        return ends;
    }
    ends.hull(&largest_w(n))
}

/// The largest W of hump n.
pub(crate) fn largest_w(n: u64) -> Enclosure {
    let Some(root) = (Enclosure::ONE + fixed_point(2 * n + 1).squared()).sqrt() else {
        return Enclosure::WHOLE;
    };
    (root + Enclosure::ONE).squared() / (4.0 * root)
}
