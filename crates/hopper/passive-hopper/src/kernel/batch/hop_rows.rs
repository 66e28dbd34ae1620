//! The hops of a block, one array for each quantity, and the vectorised loops over them.

use crate::kernel::batch::later_flights::{FlightEnds, FlightList};
use crate::kernel::batch::rows::{BLOCK, LANES, Row, ZERO};
use crate::kernel::scalar::hop::{FlightSums, MOST_FLIGHTS, state_after_first};
use crate::kernel::scalar::hop_from_interval::{square_error_from_start, state_error_from_start};
use crate::kernel::scalar::later_flight::later_flight;
use crate::landing::first_flight_table::{
    FirstFlight, FirstFlightTable, FixedPoints, Piece, TABLES, TablePosition, polynomial,
};

/// The hops of a block.
pub(crate) struct HopRows {
    pub(crate) alpha: Row,
    pub(crate) mu: Row,
    pub(crate) kappa: Row,
    // The position of α in the tables of the first flight, see `TablePosition`.
    pub(crate) interval: [u64; BLOCK],
    pub(crate) piece: [u64; BLOCK],
    at: Row,
    sudden: [u64; BLOCK],
    /// Σ Γ² over the flights of a hop; NaN if the kernel leaves the hop undecided (I7).
    closing_speeds_squared: Row,
    /// Bound on the error of Σ Γ².
    error: Row,
    /// Number of flights.
    flights: Row,
    /// Γ of the first flight.
    closing_speed: Row,
    /// α′; negative for a grounded hopper, zero if the general solver must decide.
    pub(crate) next: Row,
    /// Bound on the error of α; used and set by the loops with bounds only, as are the next two.
    pub(crate) start_error: Row,
    /// Bound on the part of the error of α′² that comes directly from the error of α.
    direct: Row,
    /// Bound on the error of α′.
    pub(crate) next_error: Row,
}

impl HopRows {
    pub(crate) const EMPTY: HopRows = HopRows {
        alpha: ZERO,
        mu: ZERO,
        kappa: ZERO,
        interval: [0; BLOCK],
        piece: [0; BLOCK],
        at: ZERO,
        sudden: [0; BLOCK],
        closing_speeds_squared: ZERO,
        error: ZERO,
        flights: ZERO,
        closing_speed: ZERO,
        next: ZERO,
        start_error: ZERO,
        direct: ZERO,
        next_error: ZERO,
    };

    /// Adds the ends of the flights in `range` of `list` to their hops, and adds the flights after them to `next`.
    pub(crate) fn add(
        &mut self,
        list: &FlightList,
        range: std::ops::Range<usize>,
        ends: &FlightEnds,
        next: &mut FlightList,
    ) {
        for at in range {
            let at = at % BLOCK;
            let hop = usize::from(list.hop[at]) % BLOCK;
            let mut state = ends.state(at);
            let mut square = ends.closing_speed_squared[at];
            let mut error = ends.closing_speed_squared_error[at];
            if !(ends.accepted[at] > 0.0) {
                // One step was not enough, or a decision is inconclusive: `later_flight` takes more steps for this
                // flight.
                match later_flight(&list.state(at), list.kappa[at]) {
                    Some(end) => {
                        state = end.state;
                        square = end.closing_speed_squared;
                        error = end.closing_speed_squared_error;
                    }
                    // The hop ends here, undecided (I7).
                    None => (state.excess, square) = (0.0, f64::NAN),
                }
            }
            self.closing_speeds_squared[hop] += square;
            self.error[hop] += error;
            self.flights[hop] += 1.0;
            if state.excess > 0.0 {
                if self.flights[hop] < MOST_FLIGHTS {
                    next.push(list.hop[at], &state, list.kappa[at]);
                } else {
                    self.closing_speeds_squared[hop] = f64::NAN;
                }
            }
        }
    }
}

/// Finds the first `count` speeds in the tables, and initialises their sums.
#[inline(always)]
pub(crate) fn find_positions(hops: &mut HopRows, fixed_points: &FixedPoints, count: usize) {
    let count = count.next_multiple_of(LANES).min(BLOCK); // whole vectors (I6)
    let alpha = &hops.alpha[..count];
    let (interval, piece) = (&mut hops.interval[..count], &mut hops.piece[..count]);
    let (at, sudden) = (&mut hops.at[..count], &mut hops.sudden[..count]);
    let (error, flights) = (&mut hops.error[..count], &mut hops.flights[..count]);
    for k in 0..count {
        let position = TablePosition::of(alpha[k], fixed_points);
        (interval[k], piece[k]) = (position.interval, position.piece);
        (at[k], sudden[k]) = (position.at, position.sudden);
        (error[k], flights[k]) = (0.0, 1.0);
    }
}

/// Eight polynomials of the tables, each with its own coefficients and argument.
#[inline(always)]
fn polynomials(coefficients: [&Piece; LANES], at: &[f64; LANES]) -> [f64; LANES] {
    std::array::from_fn(|k| polynomial(coefficients[k], at[k]))
}

/// The first flights of the first `count` speeds, and the list of the second flights, which follow sudden landings.
///
/// The polynomials are summed one by one, because the coefficients of neighbouring speeds are far apart in memory. In
/// groups of eight this takes 5 % less time a hop than in a plain loop over the speeds. A transposition of the
/// coefficients by hand in AVX-512 registers would save another 4 % (the README has the measurement). The gain does not
/// justify 60 lines of unsafe code.
///
/// With `WITHIN` the errors of the speeds are propagated through the first flight. α − h is then needed for all
/// landings.
#[inline(always)]
pub(crate) fn first_flights<const WITHIN: bool>(
    hops: &mut HopRows,
    tables: &[&FirstFlightTable; TABLES],
    list: &mut FlightList,
    count: usize,
) {
    // The hops whose first landing is sudden. Every index is written, but `length` grows only if the landing is sudden:
    // the loop has no branch.
    let mut sudden = [0u16; BLOCK];
    let mut length = 0;
    let (interval, _) = hops.interval.as_chunks::<LANES>();
    let (piece, _) = hops.piece.as_chunks::<LANES>();
    let (at, _) = hops.at.as_chunks::<LANES>();
    let (is_sudden, _) = hops.sudden.as_chunks::<LANES>();
    let (squares, _) = hops.closing_speeds_squared.as_chunks_mut::<LANES>();
    let (closing_speeds, _) = hops.closing_speed.as_chunks_mut::<LANES>();
    let (alphas, _) = hops.alpha.as_chunks::<LANES>();
    let (mus, _) = hops.mu.as_chunks::<LANES>();
    let (start_errors, _) = hops.start_error.as_chunks::<LANES>();
    let (directs, _) = hops.direct.as_chunks_mut::<LANES>();
    for group in 0..count.div_ceil(LANES).min(BLOCK / LANES) {
        let mut coefficients = [tables[0].of_closing_speed(0); LANES];
        for k in 0..LANES {
            let table = tables[interval[group][k] as usize % TABLES];
            coefficients[k] = table.of_closing_speed(piece[group][k]);
        }
        let closing_speed = polynomials(coefficients, &at[group]);
        for k in 0..LANES {
            squares[group][k] = closing_speed[k] * closing_speed[k];
        }
        closing_speeds[group] = closing_speed;
        if WITHIN {
            for k in 0..LANES {
                let table = tables[interval[group][k] as usize % TABLES];
                coefficients[k] = table.of_beyond(piece[group][k]);
            }
            let beyond = polynomials(coefficients, &at[group]);
            for k in 0..LANES {
                let (alpha, beyond) = (alphas[group][k], beyond[k]);
                let half_time = alpha - beyond;
                let first = FirstFlight { half_time, beyond, closing_speed: closing_speed[k] };
                let (error, mu) = (start_errors[group][k], mus[group][k]);
                let sudden = is_sudden[group][k] == 1;
                directs[group][k] = square_error_from_start(&first, alpha, error, mu, sudden);
            }
        }
        for (k, &is_sudden) in is_sudden[group].iter().enumerate() {
            sudden[length % BLOCK] = (group * LANES + k) as u16;
            length += is_sudden as usize;
        }
    }
    for group in sudden[..length.next_multiple_of(LANES).min(BLOCK)].as_chunks::<LANES>().0 {
        let (mut alpha, mut closing_speed, mut at) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (mut kappa, mut error) = ([0.0; LANES], [0.0; LANES]);
        let mut coefficients = [tables[0].of_beyond(0); LANES];
        for (k, &hop) in group.iter().enumerate() {
            let hop = usize::from(hop) % BLOCK;
            (alpha[k], closing_speed[k], at[k]) =
                (hops.alpha[hop], hops.closing_speed[hop], hops.at[hop]);
            kappa[k] = hops.kappa[hop];
            error[k] = hops.start_error[hop];
            coefficients[k] =
                tables[hops.interval[hop] as usize % TABLES].of_beyond(hops.piece[hop]);
        }
        let beyond = polynomials(coefficients, &at);
        let states: [_; LANES] = std::array::from_fn(|k| {
            let (alpha, beyond, closing_speed) = (alpha[k], beyond[k], closing_speed[k]);
            let first = FirstFlight { half_time: alpha - beyond, beyond, closing_speed };
            let mut state = state_after_first(&first, alpha, kappa[k]);
            if WITHIN {
                state.error += state_error_from_start(&first, alpha, error[k], kappa[k]);
            }
            state
        });
        for k in 0..length.min(LANES) {
            list.push(group[k], &states[k], kappa[k]);
        }
        length = length.saturating_sub(LANES);
    }
}

/// The decisions and next speeds of the first `count` hops.
#[inline(always)]
pub(crate) fn end_hops(hops: &mut HopRows, count: usize) {
    let count = count.next_multiple_of(LANES).min(BLOCK); // whole vectors (I6)
    let (alpha, mu) = (&hops.alpha[..count], &hops.mu[..count]);
    let (squares, error) = (&hops.closing_speeds_squared[..count], &hops.error[..count]);
    let flights = &hops.flights[..count];
    let next = &mut hops.next[..count];
    for k in 0..count {
        let sums = FlightSums {
            closing_speeds_squared: squares[k],
            error: error[k],
            half_time: 0.0, // not used in a batch
            flights: flights[k],
        };
        let (hop, decided) = sums.end(alpha[k], mu[k]);
        let hops_again = hop.next_speed_squared > 0.0;
        // The argument of the root is selected, not the root: vectors compute both sides, and the root of a negative
        // number would be NaN.
        let root = if hops_again { hop.next_speed_squared } else { 0.0 }.sqrt();
        let speed = if hops_again { root } else { -1.0 };
        next[k] = if decided { speed } else { 0.0 };
    }
}

/// As [`end_hops`], with bounds on the errors of the next speeds.
#[inline(always)]
pub(crate) fn end_hops_within(hops: &mut HopRows, count: usize) {
    let count = count.next_multiple_of(LANES).min(BLOCK); // whole vectors (I6)
    let (alpha, mu) = (&hops.alpha[..count], &hops.mu[..count]);
    let (squares, error) = (&hops.closing_speeds_squared[..count], &hops.error[..count]);
    let (flights, direct) = (&hops.flights[..count], &hops.direct[..count]);
    let (next, next_error) = (&mut hops.next[..count], &mut hops.next_error[..count]);
    for k in 0..count {
        let sums = FlightSums {
            closing_speeds_squared: squares[k],
            error: error[k],
            half_time: 0.0, // not used in a batch
            flights: flights[k],
        };
        let found = sums.within(alpha[k], mu[k], direct[k]).next();
        (next[k], next_error[k]) = (found.speed, found.error);
    }
}
