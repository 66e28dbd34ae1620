//! A hop with every number enclosed: landings, times, energies, slopes.
//!
//! The hop is found as always, in longer arithmetic. Its numbers are then computed once more, from the equations of
//! motion, with balls ([`Ball`]). The time of a landing is enclosed by two signs of the height of the lower mass,
//!
//! ```text
//!   G(t; x, V) = x (1 − cos t) + V (t − sin t) − (t²/2 − 1 + cos t),        Γ = −∂G/∂t
//! ```
//!
//! between which the solver has found the landing. It is the only one in its bracket, so that it is the one between
//! the signs.

use crate::error::Error;
use crate::evidence::enclosed::Enclosed;
use crate::map::extended_hop::{ExtendedMasses, StartIn};
use crate::map::lift_off_map::LiftOffMap;
use crate::map::speed_error::Changes;
use crate::model::contact::contact_time;
use crate::precision::ball::Ball;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::Extended;

/// A hop whose numbers all have bounds on their errors, each at most some ulps where 1024 bits suffice.
#[derive(Debug, Clone, PartialEq)]
pub struct EnclosedHop {
    /// α′; `None` if the hopper is grounded.
    pub next: Option<Enclosed>,
    /// α − α′; `None` if the hopper is grounded.
    pub loss: Option<Enclosed>,
    /// The energy that the landings take, in units of m₁m₂g²/k.
    pub energy_loss: Enclosed,
    /// The time in flight, in units of 1/ω.
    pub flight_time: Enclosed,
    /// The time on the ground from the last landing to the next lift-off, in units of 1/ω; `None` if the hopper is
    /// grounded.
    pub contact_time: Option<Enclosed>,
    /// ∂α′/∂α; `None` if the hopper is grounded, or if a landing has no closing speed.
    pub by_speed: Option<Enclosed>,
    /// ∂α′/∂M; `None` as `by_speed`.
    pub by_mass_ratio: Option<Enclosed>,
    /// The landings. All but the last are sudden.
    pub landings: Vec<EnclosedLanding>,
}

/// A landing of an [`EnclosedHop`]; [`Landing`](crate::Landing) has the meaning of its fields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnclosedLanding {
    /// The time of the flight before it.
    pub time: Enclosed,
    /// Γ.
    pub closing_speed: Enclosed,
    /// x′.
    pub excess: Enclosed,
    /// V′.
    pub velocity: Enclosed,
    /// The energy that it takes.
    pub energy_loss: Enclosed,
}

impl LiftOffMap {
    /// The hop from a speed within `error` of `alpha`, with all its numbers enclosed.
    ///
    /// It takes some tens of microseconds, and milliseconds where 106 bits do not suffice. The balls grow from
    /// flight to flight, up to fourfold: a hop with more than 300 sudden lift-offs, as at M = 10⁴, has no
    /// enclosure.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::new(0.2)?);
    /// let next = map.enclosed_hop(5.5, 0.0)?.next.expect("hops again");
    /// assert!((next.value - 3.783365713345068).abs() < 5e-16 && next.error < 5e-16);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`hop`](Self::hop), and [`Error::Undecided`] if `error` or 1024 bits leave a decision of the
    /// hop open.
    pub fn enclosed_hop(&self, alpha: f64, error: f64) -> Result<EnclosedHop, Error> {
        // Most hops are known at once, and those of too many flights need not be tried.
        let sudden = self.hop(alpha)?.sudden;
        if sudden > MOST_SUDDEN {
            return Err(Error::Undecided { alpha, sudden });
        }
        let mut found = enclose::<DoubleDouble>(self, alpha, error)?;
        let longer = [enclose::<Long<4>> as Enclose, enclose::<Long<8>>, enclose::<Long<16>>];
        // What an error of the start leaves open no arithmetic decides.
        let longer = if error > 0.0 { &[][..] } else { &longer };
        for longer in longer {
            if found.as_ref().is_some_and(EnclosedHop::is_sharp) {
                break;
            }
            found = longer(self, alpha, error)?.or(found);
        }
        found.ok_or(Error::Undecided { alpha, sudden })
    }
}

/// The most sudden lift-offs of a hop that is enclosed. The balls of some 300 flights fill 1024 bits, which take
/// half a second.
const MOST_SUDDEN: usize = 300;

type Enclose = fn(&LiftOffMap, f64, f64) -> Result<Option<EnclosedHop>, Error>;

impl EnclosedHop {
    fn is_sharp(&self) -> bool {
        let of_landings = self.landings.iter().flat_map(|landing| {
            [landing.time, landing.closing_speed, landing.excess, landing.velocity]
        });
        let optional = [self.next, self.loss, self.contact_time, self.by_speed, self.by_mass_ratio];
        let numbers = optional.into_iter().flatten().chain(of_landings);
        numbers.chain([self.energy_loss, self.flight_time]).all(Enclosed::is_sharp)
    }
}

/// The hop in the arithmetic `R`; `None` if that decides too little.
fn enclose<R: Extended>(
    map: &LiftOffMap,
    alpha: f64,
    error: f64,
) -> Result<Option<EnclosedHop>, Error> {
    let masses = ExtendedMasses::<R>::new(map.mass_ratio());
    let mut times = Vec::new();
    let start = StartIn::at_speed(R::from(alpha), masses);
    let hop = start.hop(Changes::of_speed(error), masses, |landing, _| times.push(landing.time))?;
    let Some(hop) = hop.filter(|hop| hop.decided) else { return Ok(None) };
    let alpha = Ball { middle: R::from(alpha), radius: error };
    let mut path = Path::new(alpha, masses);
    for (at, &time) in times.iter().enumerate() {
        let sudden = hop.landings[at].sudden;
        if !path.fly(time, sudden) {
            return Ok(None);
        }
    }
    path.end(map)
}

/// μ, κ and 1/(1+M), rounded by some operations.
struct Masses<R> {
    mu: Ball<R>,
    kappa: Ball<R>,
    share: Ball<R>,
}

impl<R: Extended> Masses<R> {
    fn new(masses: ExtendedMasses<R>) -> Self {
        let (mu, kappa) = (Ball::near(masses.mu), Ball::near(masses.kappa));
        Masses { mu, kappa, share: mu / kappa }
    }
}

/// (dx, dV) at a take-off, for a change of α or of M.
#[derive(Clone, Copy)]
struct Change<R> {
    excess: Ball<R>,
    velocity: Ball<R>,
    /// Σ Γ dΓ so far.
    sum: Ball<R>,
}

/// The flights of a hop so far.
struct Path<R> {
    masses: Masses<R>,
    alpha: Ball<R>,
    excess: Ball<R>,
    velocity: Ball<R>,
    /// By α, and by M.
    changes: [Change<R>; 2],
    time: Ball<R>,
    /// Σ Γ².
    squares: Ball<R>,
    landings: Vec<EnclosedLanding>,
}

impl<R: Extended> Path<R> {
    fn new(alpha: Ball<R>, masses: ExtendedMasses<R>) -> Self {
        let zero = Ball::exact(0.0);
        let change = |velocity: f64| Change { excess: zero, velocity: velocity.into(), sum: zero };
        Path {
            masses: Masses::new(masses),
            alpha,
            excess: zero,
            velocity: alpha,
            changes: [change(1.0), change(0.0)],
            time: zero,
            squares: zero,
            landings: Vec::new(),
        }
    }

    /// The flight that lands at about `time`. False if the landing is not enclosed, or if it is not certain what
    /// follows.
    fn fly(&mut self, time: R, sudden: bool) -> bool {
        let Some(t) = enclosed_time(time, |t| height(t, self.excess, self.velocity)) else {
            return false;
        };
        let (x, v, kappa) = (self.excess, self.velocity, self.masses.kappa);
        let (sin, cos) = t.sin_cos();
        let (lag, _) = t.sine_remainders(sin, cos);
        let rise = versine(t);
        let closing = lag - v * rise - x * sin;
        // ∂Γ/∂t.
        let falling = rise - v * sin - x * cos;
        for (change, of_kappa) in self.changes.iter_mut().zip([None, Some(self.masses.share)]) {
            let (dx, dv) = (change.excess, change.velocity);
            // Γ dt, from G = 0.
            let moved = rise * dx + lag * dv;
            change.sum = change.sum + falling * moved - closing * (rise * dv + sin * dx);
            let dt = moved / closing;
            change.excess = dx + t * dv + (v - t) * dt;
            change.velocity = dv - dt + kappa * (falling * dt - rise * dv - sin * dx);
            if let Some(share) = of_kappa {
                // dκ/dM = 1/(1+M)².
                change.velocity = change.velocity + closing * share.squared();
            }
        }
        let square = closing.squared();
        self.time = self.time + t;
        self.squares = self.squares + square;
        self.excess = x + t * (v - t * 0.5);
        self.velocity = v - t + kappa * closing;
        self.landings.push(EnclosedLanding {
            time: Enclosed::of(t),
            closing_speed: Enclosed::of(closing),
            excess: Enclosed::of(self.excess),
            velocity: Enclosed::of(self.velocity),
            energy_loss: Enclosed::of(kappa * square * 0.5),
        });
        if sudden { self.excess.is_positive() } else { self.excess.is_negative() }
    }

    /// The hop, after its last landing.
    fn end(self, map: &LiftOffMap) -> Result<Option<EnclosedHop>, Error> {
        let Masses { mu, kappa, share } = self.masses;
        let lost = mu * self.squares;
        let square = self.alpha.squared() - lost;
        if !square.is_positive() && !square.is_negative() {
            return Ok(None);
        }
        let hop = EnclosedHop {
            next: None,
            loss: None,
            energy_loss: Enclosed::of(kappa * self.squares * 0.5),
            flight_time: Enclosed::of(self.time),
            contact_time: None,
            by_speed: None,
            by_mass_ratio: None,
            landings: self.landings,
        };
        if square.is_negative() {
            return Ok(Some(hop));
        }
        let next = square.sqrt();
        let [speed, mass] = self.changes.map(|change| change.sum);
        // dμ/dM = (1−M)/(1+M)³.
        let mu_slope = (share - kappa) * share.squared();
        let by_speed = Enclosed::of((self.alpha - mu * speed) / next);
        let by_mass_ratio = Enclosed::of(-(mu * mass + mu_slope * self.squares * 0.5) / next);
        let known = |slope: Enclosed| slope.error.is_finite().then_some(slope);
        let (x, v) = (self.excess, self.velocity);
        let plain = contact_time(map.mass_ratio(), x.middle.nearest(), v.middle.nearest())?;
        let contact_time = plain.and_then(|plain| enclosed_contact(x, v, kappa, plain));
        Ok(Some(EnclosedHop {
            next: Some(Enclosed::of(next)),
            loss: Some(Enclosed::of(lost / (self.alpha + next))),
            contact_time: contact_time.map(Enclosed::of),
            by_speed: known(by_speed),
            by_mass_ratio: known(by_mass_ratio),
            ..hop
        }))
    }
}

/// 1 − cos t, without cancellation.
pub(crate) fn versine<R: Extended>(t: Ball<R>) -> Ball<R> {
    (t * 0.5).sin_cos().0.squared() * 2.0
}

/// G(t; x, V), the height of the lower mass times 1 + M.
pub(crate) fn height<R: Extended>(t: Ball<R>, x: Ball<R>, v: Ball<R>) -> Ball<R> {
    let (sin, cos) = t.sin_cos();
    let (lag, bend) = t.sine_remainders(sin, cos);
    x * versine(t) + v * lag - bend
}

/// The first reach about a time, in units of its rounding, and the factor to the next one.
const FIRST_REACH: f64 = 16.0;
const FARTHER: f64 = 8.0;

/// The zero next to `time`, where the function falls from above 0 to below 0. `None` if no two signs are found
/// within half of the time.
fn enclosed_time<R: Extended>(time: R, f: impl Fn(Ball<R>) -> Ball<R>) -> Option<Ball<R>> {
    let size = time.nearest().abs();
    // A reach of zero would never grow.
    let mut reach = (FIRST_REACH * R::EPSILON * size).max(f64::MIN_POSITIVE);
    let at = |offset: f64| Ball { middle: time + offset, radius: 0.0 };
    while reach < 0.5 * size {
        if f(at(-reach)).is_positive() && f(at(reach)).is_negative() {
            // The two places are rounded themselves.
            return Some(Ball { middle: time, radius: reach + R::EPSILON * size });
        }
        reach *= FARTHER;
    }
    None
}

/// Newton steps of the contact's time from an `f64`, of which each doubles the right bits: 1024 need five.
const CONTACT_STEPS: usize = 6;

/// The stretch less 1 on the ground, a time t after (x, V): x cos θ + V sin θ/ν − (1 − cos θ)/κ with θ = νt, ν = √κ.
pub(crate) fn contact_excess<R: Extended>(
    x: Ball<R>,
    v: Ball<R>,
    kappa: Ball<R>,
    t: Ball<R>,
) -> Ball<R> {
    let nu = kappa.sqrt();
    let angle = nu * t;
    let one_less_cos = versine(angle);
    x - x * one_less_cos + v * angle.sin_cos().0 / nu - one_less_cos / kappa
}

/// The speed of the upper mass then.
pub(crate) fn contact_speed<R: Extended>(
    x: Ball<R>,
    v: Ball<R>,
    kappa: Ball<R>,
    t: Ball<R>,
) -> Ball<R> {
    let nu = kappa.sqrt();
    let (sin, cos) = (nu * t).sin_cos();
    v * cos - (x * kappa + 1.0.into()) * sin / nu
}

/// The time from (x, V), x < 0, until the stretch is 1 again, near `plain`.
fn enclosed_contact<R: Extended>(
    x: Ball<R>,
    v: Ball<R>,
    kappa: Ball<R>,
    plain: f64,
) -> Option<Ball<R>> {
    let excess = |t: Ball<R>| contact_excess(x, v, kappa, t);
    let mut time = Ball::exact(plain);
    for _ in 0..CONTACT_STEPS {
        let step = excess(time) / contact_speed(x, v, kappa, time);
        time = Ball { middle: (time - step).middle, radius: 0.0 };
    }
    enclosed_time(time.middle, |t| -excess(t))
}
