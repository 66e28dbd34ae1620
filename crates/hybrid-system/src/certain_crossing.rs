//! The first zero of a [`QuasiPolynomial`], with certainty.
//!
//! On an interval with middle m and half length r, and |g″| ≤ B on it,
//!
//! ```text
//!   |g(m)|  > |g′(m)| r + ½ B r² + rounding    no zero on the interval
//!   |g′(m)| > B r + rounding                   g is monotone: a zero if and only if its sign changes
//!   else                                       the interval is halved
//! ```
//!
//! A start at zero, to any order, is left by its first derivative that is not zero: with g = c tᵏ + …,
//! |g| ≥ tᵏ (|c| − M t/(k+1)!) where |g⁽ᵏ⁺¹⁾| ≤ M.

use crate::{Direction, Error, QuasiPolynomial, bracketed_root};

/// The first crossing of a signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FirstCrossing {
    /// It crosses zero here, in the direction asked for, and not before.
    At {
        /// When.
        time: f64,
        /// Whether it goes from negative to positive.
        rising: bool,
    },
    /// It comes so close to zero, with so little speed, that rounding hides whether it touches, crosses once or
    /// twice, or stays away; before, it does not cross.
    Grazing {
        /// When it is closest.
        time: f64,
        /// Its value there, the smallest seen.
        value: f64,
    },
    /// It does not cross up to the horizon.
    Never,
}

/// Multiples of its rounding from which on a signal is clear of a stretch where that hides it.
const CLEAR: f64 = 4.0;

/// Highest order of a zero at the start.
const ORDERS: u32 = 16;

/// Most intervals looked at.
const INTERVALS: usize = 1_000_000;

impl QuasiPolynomial {
    /// The first crossing of zero strictly after time zero, up to `horizon`, in one direction.
    ///
    /// A start at zero, but for rounding, counts by the side to which the signal leaves it. A signal that is
    /// zero throughout never crosses.
    ///
    /// ```
    /// use hybrid_system::{Direction, FirstCrossing, QuasiPolynomial};
    /// // t³ − t⁴ leaves zero upwards, cubically, and comes back at 1.
    /// let g = QuasiPolynomial::polynomial(&[0.0, 0.0, 0.0, 1.0, -1.0]);
    /// let back = FirstCrossing::At { time: 1.0, rising: false };
    /// assert_eq!(g.first_crossing(Direction::Either, 9.0)?, back);
    /// // (t − 1)² touches.
    /// let g = QuasiPolynomial::polynomial(&[1.0, -2.0, 1.0]);
    /// assert!(matches!(g.first_crossing(Direction::Either, 9.0)?, FirstCrossing::Grazing { .. }));
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`] for coefficients that are not; [`Error::BadLimit`] unless `horizon` is
    /// finite and not negative; [`Error::UndecidedSign`] if the side to which it leaves zero is hidden
    /// by rounding; [`Error::NoConvergence`] after a million intervals.
    pub fn first_crossing(
        &self,
        direction: Direction,
        horizon: f64,
    ) -> Result<FirstCrossing, Error> {
        self.first_crossing_from(direction, horizon, 0.0)
    }

    /// The same for a start that may be off by `start_error`.
    pub(crate) fn first_crossing_from(
        &self,
        direction: Direction,
        horizon: f64,
        start_error: f64,
    ) -> Result<FirstCrossing, Error> {
        self.check()?;
        if !(horizon >= 0.0 && horizon.is_finite()) {
            return Err(Error::BadLimit { what: "the horizon of a search", value: horizon });
        }
        if self.stays_away(horizon) {
            return Ok(FirstCrossing::Never);
        }
        let Some(start) = self.leave(horizon, start_error)? else {
            return Ok(FirstCrossing::Never);
        };
        Search::new(self).run(start, direction, horizon)
    }

    /// How the signal leaves its start: a time up to which it does not vanish again, and its sign;
    /// nothing if it is zero throughout.
    ///
    /// Derivatives within their rounding count as zero, if the signal stays within its own rounding as long
    /// as they could outweigh the first one that is not.
    fn leave(&self, horizon: f64, start_error: f64) -> Result<Option<(f64, f64)>, Error> {
        let hidden = self.rounding(0.0) + start_error;
        let mut derivative = self.clone();
        let mut factorial = 1.0; // k!
        let mut lower = [0.0; ORDERS as usize + 1]; // bounds on the hidden g⁽ʲ⁾(0)/j!
        for order in 0..=ORDERS {
            let value = derivative.value(0.0);
            let next = derivative.derivative();
            let rounding = derivative.rounding(0.0) + if order == 0 { start_error } else { 0.0 };
            if value.abs() <= rounding {
                if next.bound(horizon) == 0.0 && self.bound(horizon) <= hidden {
                    return Ok(None);
                }
                lower[order as usize] = (value.abs() + rounding) / factorial;
                derivative = next;
                factorial *= f64::from(order + 1);
                continue;
            }
            if order == 0 {
                return Ok(Some((0.0, value.signum())));
            }
            // |g| ≥ tᵏ (|c| − M t/(k+1)!) with c = value/k!, but for the lower terms.
            let leading = value.abs() / factorial;
            let mut time = horizon;
            while time > 0.0
                && !(leading > 2.0 * next.bound(time) * time / (factorial * f64::from(order + 1)))
            {
                time *= 0.5;
            }
            // From here on ½ c tᵏ outweighs them.
            let share = 2.0 * f64::from(order) / leading;
            let clear = (1..order as usize)
                .map(|j| pxfm::f_pow(share * lower[j], 1.0 / (f64::from(order) - j as f64)))
                .fold(0.0, f64::max);
            let reached: f64 = (1..=order as usize)
                .map(|j| if j < order as usize { lower[j] } else { 2.0 * leading })
                .enumerate()
                .map(|(j, term)| term * pxfm::f_pow(clear, (j + 1) as f64))
                .sum();
            if clear >= time && time > 0.0 || reached > hidden {
                return Err(Error::UndecidedSign { order, value });
            }
            return Ok(Some((time, value.signum())));
        }
        Err(Error::UndecidedSign { order: ORDERS, value: 0.0 })
    }
}

/// Where a guard that rounding hides is smallest, and its value there. Looks ahead, each time twice as far, until it is
/// clear of rounding; `sign` is its sign before.
pub(crate) fn closest(
    value: impl Fn(f64) -> f64,
    clear: impl Fn(f64) -> bool,
    sign: f64,
    (from, width, horizon): (f64, f64, f64),
) -> (f64, f64) {
    let mut step = width.max(f64::EPSILON * from).max(f64::MIN_POSITIVE);
    let (mut ahead, at_first) = (from, value(from).abs());
    let mut hidden = !clear(from);
    while ahead < horizon {
        ahead = (from + step).min(horizon);
        step *= 2.0;
        // Still on its way into the stretch?
        let before = !hidden && value(ahead) * sign > 0.0 && value(ahead).abs() <= at_first;
        if clear(ahead) && !before {
            break;
        }
        hidden |= !clear(ahead);
    }
    // Golden section: next to a touch there is one minimum of the distance.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut left, mut right) = (from, ahead);
    for _ in 0..100 {
        let (a, b) = (right - GOLDEN * (right - left), left + GOLDEN * (right - left));
        if value(a).abs() < value(b).abs() { right = b } else { left = a }
    }
    let time = 0.5 * (left + right);
    (time, value(time))
}

/// A signal with its derivatives.
struct Search<'a> {
    signal: &'a QuasiPolynomial,
    slope: QuasiPolynomial,
    bend: QuasiPolynomial,
}

/// What an interval holds.
enum Found {
    /// No zero, and this sign.
    Nothing(f64),
    /// It is monotone with this slope.
    Monotone(f64),
    /// Not known.
    Unknown,
}

impl<'a> Search<'a> {
    fn new(signal: &'a QuasiPolynomial) -> Self {
        let slope = signal.derivative();
        let bend = slope.derivative();
        Search { signal, slope, bend }
    }

    fn look(&self, left: f64, right: f64) -> Found {
        let (middle, radius) = (left + 0.5 * (right - left), 0.5 * (right - left));
        let bend = self.bend.bound(right);
        let (value, slope) = (self.signal.value(middle), self.slope.value(middle));
        let slope_rounding = self.slope.rounding(right);
        let reach = (slope.abs() + slope_rounding) * radius + 0.5 * bend * radius * radius;
        if value.abs() > reach + self.signal.rounding(right) {
            Found::Nothing(value.signum())
        } else if slope.abs() > bend * radius + slope_rounding {
            Found::Monotone(slope)
        } else {
            Found::Unknown
        }
    }

    /// From left to right; `sign` is that of the signal just before what is left.
    fn run(
        &self,
        (start, mut sign): (f64, f64),
        direction: Direction,
        horizon: f64,
    ) -> Result<FirstCrossing, Error> {
        let mut left = start;
        let mut rest = vec![horizon];
        for _ in 0..INTERVALS {
            let Some(&right) = rest.last() else { return Ok(FirstCrossing::Never) };
            if left >= right {
                rest.pop();
                continue;
            }
            match self.look(left, right) {
                Found::Nothing(now) if now != sign && direction.admits(sign, now) => {
                    // The zero that rounding hid lies where the intervals meet.
                    return Ok(FirstCrossing::At { time: left, rising: sign < 0.0 });
                }
                Found::Nothing(now) => (left, sign) = (right, now),
                Found::Monotone(slope) => {
                    // Towards the other sign, and beyond it at the end?
                    let beyond = self.beyond(right, slope, horizon);
                    let value = self.signal.value(beyond);
                    // Within rounding the other side is not certain: the next interval tells, if there is one.
                    let clear = value.abs() > self.signal.rounding(beyond) || right >= horizon;
                    if slope * sign < 0.0 && value * sign < 0.0 && clear {
                        if direction.admits(sign, -sign) {
                            let time = self.root(left, beyond, sign)?;
                            return Ok(if time <= horizon {
                                FirstCrossing::At { time, rising: sign < 0.0 }
                            } else {
                                FirstCrossing::Never
                            });
                        }
                        sign = -sign;
                        left = beyond;
                    } else {
                        left = right;
                    }
                }
                Found::Unknown => {
                    let middle = left + 0.5 * (right - left);
                    // Next to a touch, below the rounding of the signal halving tells nothing more.
                    let width = right - left;
                    let hidden =
                        self.bend.bound(right) * width * width < self.signal.rounding(right);
                    if !(hidden || middle <= left || middle >= right) {
                        rest.push(middle);
                        continue;
                    }
                    let value = |time: f64| self.signal.value(time);
                    let clear = |time: f64| value(time).abs() > CLEAR * self.signal.rounding(time);
                    let (time, value) = closest(value, clear, sign, (left, width, horizon));
                    return Ok(FirstCrossing::Grazing { time, value });
                }
            }
        }
        Err(Error::NoConvergence { left, right: horizon, iterations: INTERVALS })
    }

    /// `right`, or a little more if the signal is within its rounding of zero there: a zero on the end of
    /// an interval belongs to it.
    fn beyond(&self, right: f64, slope: f64, horizon: f64) -> f64 {
        let rounding = self.signal.rounding(right);
        if self.signal.value(right).abs() > rounding {
            return right;
        }
        let beyond = right + 4.0 * rounding / slope.abs();
        match self.look(right, beyond) {
            // Beyond the horizon too: a crossing there is dropped.
            Found::Monotone(_) | Found::Unknown => beyond.max(right.min(horizon)),
            Found::Nothing(_) => right,
        }
    }

    /// The only zero of a monotone stretch that begins on the side of `sign`.
    fn root(&self, left: f64, right: f64, sign: f64) -> Result<f64, Error> {
        let value = |time: f64| self.signal.value(time);
        // Rounding may give the left end the other sign already: then it is the zero.
        if value(left) * sign <= 0.0 {
            return Ok(left);
        }
        // A search that goes on from there does not find it again.
        let mut time = bracketed_root(value, left, right)?;
        let mut step = 1;
        while time < right && value(time) * sign > 0.0 {
            time = f64::from_bits(time.to_bits() + step).min(right);
            step *= 2;
        }
        Ok(time)
    }
}
