//! Many later flights at once: the list of flights to compute, and the loops that compute them.
//!
//! The loops compute the first round of [`later_flight`](crate::kernel::scalar::later_flight::later_flight) with the
//! same functions (I1). If a flight is not accepted, `later_flight` computes it again.

use crate::kernel::batch::rows::{BLOCK, LANES, Row, ZERO};
use crate::kernel::scalar::ground_state::GroundState;
use crate::kernel::scalar::half_angle::HalfAngle;
use crate::kernel::scalar::landing_bracket::LandingBracket;
use crate::kernel::scalar::later_flight::{fourth_order_step, land, third_order_step};
use std::f64::consts::PI;

/// Flights to compute: flights with V < π from the front of the arrays, flights with V ≥ π from the back (I9).
///
/// The two kinds have different brackets and guesses. Separate lists give two loops without branches.
pub(crate) struct FlightList {
    /// Number of flights with V < π.
    pub(crate) below_pi: usize,
    /// Number of flights with V ≥ π.
    pub(crate) from_pi: usize,
    /// The hop of the block that a flight belongs to.
    pub(crate) hop: [u16; BLOCK],
    pub(crate) excess: Row,
    pub(crate) velocity: Row,
    pub(crate) error: Row,
    pub(crate) kappa: Row,
}

/// The ends of the flights of a list, at the same indices, and the values that the search passes from loop to loop.
pub(crate) struct FlightEnds {
    h: Row,
    left: Row,
    right: Row,
    parity_sign: Row,
    certain: Row,
    pub(crate) excess: Row,
    pub(crate) velocity: Row,
    pub(crate) error: Row,
    pub(crate) closing_speed_squared: Row,
    pub(crate) closing_speed_squared_error: Row,
    /// 1 if accepted, else 0.
    pub(crate) accepted: Row,
}

impl FlightList {
    pub(crate) const EMPTY: FlightList = FlightList {
        below_pi: 0,
        from_pi: 0,
        hop: [0; BLOCK],
        excess: ZERO,
        velocity: ZERO,
        error: ZERO,
        kappa: ZERO,
    };

    pub(crate) fn is_empty(&self) -> bool {
        self.below_pi + self.from_pi == 0
    }

    pub(crate) fn clear(&mut self) {
        (self.below_pi, self.from_pi) = (0, 0);
    }

    /// Adds the flight of `hop` from `state`. A list has at most one flight of a hop: the arrays have room for it (I9).
    #[inline(always)]
    pub(crate) fn push(&mut self, hop: u16, state: &GroundState, kappa: f64) {
        let is_below_pi = state.velocity < PI;
        let at = if is_below_pi { self.below_pi } else { BLOCK - 1 - self.from_pi } % BLOCK;
        self.below_pi += usize::from(is_below_pi);
        self.from_pi += usize::from(!is_below_pi);
        self.hop[at] = hop;
        self.excess[at] = state.excess;
        self.velocity[at] = state.velocity;
        self.error[at] = state.error;
        self.kappa[at] = kappa;
    }

    /// The start of the flight at index `at`.
    #[inline(always)]
    pub(crate) fn state(&self, at: usize) -> GroundState {
        let (excess, velocity, error) = (self.excess[at], self.velocity[at], self.error[at]);
        GroundState { excess, velocity, error }
    }
}

impl FlightEnds {
    pub(crate) const EMPTY: FlightEnds = FlightEnds {
        h: ZERO,
        left: ZERO,
        right: ZERO,
        parity_sign: ZERO,
        certain: ZERO,
        excess: ZERO,
        velocity: ZERO,
        error: ZERO,
        closing_speed_squared: ZERO,
        closing_speed_squared_error: ZERO,
        accepted: ZERO,
    };

    /// The state after the flight at index `at`.
    #[inline(always)]
    pub(crate) fn state(&self, at: usize) -> GroundState {
        let (excess, velocity, error) = (self.excess[at], self.velocity[at], self.error[at]);
        GroundState { excess, velocity, error }
    }
}

/// The ends of all flights with V < π.
#[inline(always)]
pub(crate) fn land_below_pi(list: &FlightList, ends: &mut FlightEnds) {
    land_all::<false>(list, 0, list.below_pi, ends);
}

/// The ends of all flights with V ≥ π.
#[inline(always)]
pub(crate) fn land_from_pi(list: &FlightList, ends: &mut FlightEnds) {
    land_all::<true>(list, BLOCK - list.from_pi.min(BLOCK), BLOCK, ends);
}

/// The ends of the flights from index `begin` to `end`, all on one side of π.
///
/// There are three loops without a branch: bracket and guess, first step, last step and landing. Each loop is short
/// enough that a processor works on several vectors at a time.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "arrays in step")]
fn land_all<const FROM_PI: bool>(
    list: &FlightList,
    begin: usize,
    end: usize,
    ends: &mut FlightEnds,
) {
    // The slices are whole vectors (I6) of one length: the loops then have no bounds checks and no exit except their
    // end.
    let (begin, end) = (begin / LANES * LANES, end.next_multiple_of(LANES).min(BLOCK));
    let Some(count) = end.checked_sub(begin) else { return };
    let (excess, velocity) = (&list.excess[begin..end], &list.velocity[begin..end]);
    let (error, kappa) = (&list.error[begin..end], &list.kappa[begin..end]);
    let h = &mut ends.h[begin..end];
    let (left, right) = (&mut ends.left[begin..end], &mut ends.right[begin..end]);
    let (parity_sign, certain) = (&mut ends.parity_sign[begin..end], &mut ends.certain[begin..end]);
    let start =
        |at: usize| GroundState { excess: excess[at], velocity: velocity[at], error: error[at] };
    for at in 0..count {
        let bracket = if FROM_PI {
            LandingBracket::from_pi(&start(at))
        } else {
            LandingBracket::below_pi(&start(at))
        };
        h[at] = bracket.first_point();
        (left[at], right[at]) = (bracket.left, bracket.right);
        (parity_sign[at], certain[at]) = (bracket.parity_sign, bracket.certain);
    }
    let bracket = |at: usize, left: &[f64], right: &[f64], sign: &[f64], certain: &[f64]| {
        // The guess is used in the first loop only.
        let (left, right, certain) = (left[at], right[at], certain[at]);
        LandingBracket { left, right, parity_sign: sign[at], certain, guess: 0.0 }
    };
    for at in 0..count {
        let rough = HalfAngle::to_eight_digits(h[at]);
        let bracket = bracket(at, left, right, parity_sign, certain);
        h[at] = bracket.moved(rough.h, fourth_order_step(&rough, &start(at)));
    }
    let (to_excess, to_velocity) = (&mut ends.excess[begin..end], &mut ends.velocity[begin..end]);
    let (to_error, square) =
        (&mut ends.error[begin..end], &mut ends.closing_speed_squared[begin..end]);
    let (square_error, accepted) =
        (&mut ends.closing_speed_squared_error[begin..end], &mut ends.accepted[begin..end]);
    for at in 0..count {
        let functions = HalfAngle::at(h[at]);
        let (start, bracket) = (start(at), bracket(at, left, right, parity_sign, certain));
        let step = third_order_step(&functions, &start);
        let end = land(&functions, step, &start, &bracket, kappa[at]);
        to_excess[at] = end.state.excess;
        to_velocity[at] = end.state.velocity;
        to_error[at] = end.state.error;
        square[at] = end.closing_speed_squared;
        square_error[at] = end.closing_speed_squared_error;
        accepted[at] = if end.accepted { 1.0 } else { 0.0 };
    }
}

#[cfg(test)]
impl FlightEnds {
    pub(crate) fn has_bits_of(&self, other: &Self) -> bool {
        let rows = |ends: &Self| {
            let FlightEnds {
                excess,
                velocity,
                error,
                closing_speed_squared: square,
                closing_speed_squared_error: square_error,
                accepted,
                h,
                ..
            } = *ends;
            [excess, velocity, error, square, square_error, accepted, h]
        };
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
        rows(self).iter().flatten().zip(rows(other).iter().flatten()).all(same)
    }
}
