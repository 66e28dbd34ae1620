//! The public form of [`HalfTime`], in `f64`.

use crate::landing::first_landing::first_root;
use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::landing::flight_ends::TakeOff;
use crate::landing::half_time::HalfTime;
use crate::landing::next_landing::{before_maximum, next_root};
use crate::model::motion::LARGEST_LIFT_OFF_SPEED;

/// A flight from the ground, given by half its time h: every quantity at the landing in closed form, without
/// cancellation.
///
/// For a start at stretch 1 + x, with S = sin h, C = cos h, D = h − S C and u = h C − S,
///
/// ```text
///   start speed    V = h + (S u − x S²)/D        for x = 0 this is A(h), the paper's Eq. (11)
///   closing speed  Γ = 2 u (u − x S)/D
///   slope          dV/dh = Γ/D
/// ```
///
/// ```
/// use passive_hopper::{HalfFlight, alpha_star};
/// let half = HalfFlight::at(3.0);
/// let alpha = half.start_speed(0.0);
/// assert!((alpha - (9.0 - half.sin() * half.sin()) / half.d()).abs() < 1e-15);
/// // The lossless hop lands without speed: there u = 0.
/// assert!(HalfFlight::at(alpha_star(1)).closing_speed(0.0) < 1e-29);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfFlight(HalfTime<f64>);

impl HalfFlight {
    /// The flight that lasts 2`h`, `h` > 0.
    #[inline]
    pub fn at(h: f64) -> Self {
        HalfFlight(HalfTime::at(h))
    }

    /// The flight from a take-off to its first landing, by a search for h. The relative error of h is about 10⁻⁹;
    /// one step of Newton's method, (V − `start_speed`)/`start_speed_slope`, takes it to that of an `f64`.
    ///
    /// `None` if there is no flight: for x < 0, for x = 0 with V ≤ 0, or if V or x is no number up to
    /// [`LARGEST_LIFT_OFF_SPEED`].
    ///
    /// ```
    /// use passive_hopper::{HalfFlight, TakeOff};
    /// let flight = HalfFlight::of(TakeOff { excess: 0.0, velocity: 7.0 }).ok_or("no flight")?;
    /// assert!((flight.start_speed(0.0) - 7.0).abs() < 1e-8);
    /// assert_eq!(HalfFlight::of(TakeOff { excess: 0.0, velocity: -1.0 }), None);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of(start: TakeOff) -> Option<Self> {
        let TakeOff { excess, velocity } = start;
        let known = velocity.abs() <= LARGEST_LIFT_OFF_SPEED && excess <= LARGEST_LIFT_OFF_SPEED;
        let root = match excess {
            _ if !known => return None,
            0.0 if velocity > 0.0 => first_root(&FixedPointInterval::of(velocity), velocity),
            _ if excess > 0.0 => next_root(start, before_maximum(start)),
            _ => return None,
        };
        Some(HalfFlight(root.half))
    }

    /// h, half the time of flight.
    pub fn half_time(&self) -> f64 {
        self.0.h
    }

    /// S = sin h.
    pub fn sin(&self) -> f64 {
        self.0.sin
    }

    /// C = cos h.
    pub fn cos(&self) -> f64 {
        self.0.cos
    }

    /// D = h − sin h cos h > 0, half of τ − sin τ.
    pub fn d(&self) -> f64 {
        self.0.d
    }

    /// u = h cos h − sin h, zero at h = α*_n.
    pub fn u(&self) -> f64 {
        self.0.u
    }

    /// ρ = u/D, from −½ at h → 0.
    pub fn rho(&self) -> f64 {
        self.0.rho
    }

    /// V(h), the speed at the start, from stretch 1 + `excess`: A(h) for `excess` = 0.
    #[inline]
    pub fn start_speed(&self, excess: f64) -> f64 {
        self.0.start_speed(excess)
    }

    /// Γ = −G', the closing speed of the lower mass times 1 + M.
    #[inline]
    pub fn closing_speed(&self, excess: f64) -> f64 {
        self.0.closing_speed(excess)
    }

    /// dV/dh = Γ/D.
    #[inline]
    pub fn start_speed_slope(&self, excess: f64) -> f64 {
        self.0.start_speed_slope(excess)
    }

    /// W = sin h (sin h − h cos h): α' dα'/dα = α (1 − 4μW) on the contact intervals.
    pub fn w(&self) -> f64 {
        -self.0.sin * self.0.u
    }
}
