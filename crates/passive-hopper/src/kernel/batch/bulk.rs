//! Many hops at once: every step a loop over arrays.
//!
//! ```text
//!   places      where the speeds lie in the tables             vectors
//!   first       Γ from the tables, row by row                  vectors, of rows turned into columns
//!               lists of sudden landings                       one by one
//!   later       flights of the lists, by branch                vectors: start, two steps, landing
//!               sums, and the lists of flights that follow     one by one
//!   end         α′ and whether it is beyond doubt              vectors
//! ```
//!
//! What does not settle is landed again, one by one, by the same functions as a single hop's.

use crate::kernel::batch::landings::{Flights, Landings};
use crate::kernel::batch::simd;
use crate::kernel::scalar::flight::{Ground, flight};
use crate::kernel::scalar::hop::{FLIGHTS, Masses, Sum, ground_after};
use crate::landing::first_flight_table::{
    CELLS, Cell as Tables, Eight, First, Place, Stars, stars,
};
use std::cell::Cell;

/// Speeds that go through the steps together: their arrays stay in the cache.
pub(crate) const BLOCK: usize = 512;

/// Lanes of the widest vectors.
pub(crate) const LANES: usize = 8;

pub(crate) type Row = [f64; BLOCK];

/// The speeds and masses of a block, their places, and what becomes of them.
pub(crate) struct Hops {
    alpha: Row,
    mu: Row,
    kappa: Row,
    cell: [u64; BLOCK],
    piece: [u64; BLOCK],
    at: Row,
    sudden: [u64; BLOCK],
    /// Sums over the flights of a hop: Γ², its error, and how many; no number where the fast path gives up.
    squares: Row,
    errors: Row,
    flights: Row,
    /// α′; negative for grounded, zero where the careful path must decide. Until then Γ.
    next: Row,
}

/// The arrays of a block.
pub(crate) struct Block {
    hops: Hops,
    /// The flights of this round and of the next.
    lists: [Flights; 2],
    landings: Landings,
}

pub(crate) const ZERO: Row = [0.0; BLOCK];

impl Block {
    pub(crate) const EMPTY: Block = Block {
        hops: Hops {
            alpha: ZERO,
            mu: ZERO,
            kappa: ZERO,
            cell: [0; BLOCK],
            piece: [0; BLOCK],
            at: ZERO,
            sudden: [0; BLOCK],
            squares: ZERO,
            errors: ZERO,
            flights: ZERO,
            next: ZERO,
        },
        lists: [const { Flights::EMPTY }; 2],
        landings: Landings::EMPTY,
    };

    /// Arrays that a thread makes once, when it first needs them.
    pub(crate) fn of_this_thread(work: impl FnOnce(&mut Block)) {
        thread_local!(static KEPT: Cell<Option<Box<Block>>> = const { Cell::new(None) });
        let mut block = KEPT.take().unwrap_or_else(|| Box::new(Block::EMPTY));
        work(&mut block);
        KEPT.set(Some(block));
    }

    /// The hops of `entries`, at most BLOCK, `from` their speeds and with their masses; `to` takes the next speed,
    /// negative for grounded, zero where the careful path must decide.
    #[inline]
    pub(crate) fn hops<H>(
        &mut self,
        entries: &mut [H],
        from: impl Fn(&H) -> (f64, Masses),
        mut to: impl FnMut(&mut H, f64),
    ) {
        let count = entries.len().min(BLOCK);
        for (at, entry) in entries.iter().take(count).enumerate() {
            let (alpha, Masses { mu, kappa }) = from(entry);
            (self.hops.alpha[at], self.hops.mu[at], self.hops.kappa[at]) = (alpha, mu, kappa);
        }
        simd::places(&mut self.hops, stars(), count);
        self.first_flights(count);
        let mut now = 0;
        while self.lists[now].slow + self.lists[now].fast > 0 {
            self.later_flights(now);
            now = 1 - now;
        }
        simd::ends(&mut self.hops, count);
        for (entry, &next) in entries.iter_mut().zip(&self.hops.next) {
            to(entry, next);
        }
    }

    /// All first flights, and the list of flights that follow at once.
    fn first_flights(&mut self, count: usize) {
        let Block { hops, lists: [list, _], .. } = self;
        let mut cells = Tables::all();
        let mut used = 0u64;
        for (&cell, &piece) in hops.cell.iter().zip(&hops.piece).take(count) {
            used |= u64::from(piece != Place::NOWHERE.piece) << (cell % CELLS as u64);
        }
        for (n, cell) in cells.iter_mut().enumerate() {
            if used >> n & 1 == 1 {
                *cell = Tables::get(n as u64);
            }
        }
        list.clear();
        simd::first_flights(hops, &cells, list, count);
    }

    /// The flights of the list `now`; those that follow go to the other list.
    fn later_flights(&mut self, now: usize) {
        let (first, second) = self.lists.split_at_mut(1);
        let (list, next) =
            if now == 0 { (&first[0], &mut second[0]) } else { (&second[0], &mut first[0]) };
        next.clear();
        simd::slow_landings(list, &mut self.landings);
        self.hops.add(list, 0..list.slow, &self.landings, next);
        simd::fast_landings(list, &mut self.landings);
        self.hops.add(list, BLOCK - list.fast..BLOCK, &self.landings, next);
    }
}

impl Hops {
    /// Adds the landings, and to `next` the flights that follow.
    fn add(
        &mut self,
        list: &Flights,
        range: std::ops::Range<usize>,
        landings: &Landings,
        next: &mut Flights,
    ) {
        for at in range {
            let at = at % BLOCK;
            let to = usize::from(list.index[at]) % BLOCK;
            let mut ground = landings.ground(at);
            let (mut square, mut error) = (landings.square[at], landings.square_error[at]);
            if !(landings.settled[at] > 0.0) {
                match flight(&list.ground(at), list.kappa[at]) {
                    Some(landed) => {
                        ground = landed.ground;
                        (square, error) = (landed.square, landed.square_error);
                    }
                    None => (ground.excess, square) = (0.0, f64::NAN),
                }
            }
            self.squares[to] += square;
            self.errors[to] += error;
            self.flights[to] += 1.0;
            if ground.excess > 0.0 {
                if self.flights[to] < FLIGHTS {
                    next.push(list.index[at], &ground, list.kappa[at]);
                } else {
                    self.squares[to] = f64::NAN;
                }
            }
        }
    }
}

/// The places of the first `count` speeds, up to whole vectors.
#[inline(always)]
pub(crate) fn places(hops: &mut Hops, stars: &Stars, count: usize) {
    let count = count.next_multiple_of(LANES).min(BLOCK);
    let alpha = &hops.alpha[..count];
    let (cell, piece) = (&mut hops.cell[..count], &mut hops.piece[..count]);
    let (at, sudden) = (&mut hops.at[..count], &mut hops.sudden[..count]);
    let (errors, flights) = (&mut hops.errors[..count], &mut hops.flights[..count]);
    for k in 0..count {
        let place = Place::of(alpha[k], stars);
        (cell[k], piece[k]) = (place.cell, place.piece);
        (at[k], sudden[k]) = (place.at, place.sudden);
        (errors[k], flights[k]) = (0.0, 1.0);
    }
}

/// The first flights of the first `count` speeds, up to whole vectors, and the list of those that follow.
#[inline(always)]
pub(crate) fn first<E: Eight>(
    hops: &mut Hops,
    cells: &[&Tables; CELLS],
    list: &mut Flights,
    count: usize,
) {
    let mut sudden = [0u16; BLOCK];
    let mut length = 0;
    let (places, _) = hops.cell.as_chunks::<LANES>();
    let (pieces, _) = hops.piece.as_chunks::<LANES>();
    let (ats, _) = hops.at.as_chunks::<LANES>();
    let (suddens, _) = hops.sudden.as_chunks::<LANES>();
    let (squares, _) = hops.squares.as_chunks_mut::<LANES>();
    let (nexts, _) = hops.next.as_chunks_mut::<LANES>();
    for group in 0..count.div_ceil(LANES).min(BLOCK / LANES) {
        let (place, piece, at) = (&places[group], &pieces[group], &ats[group]);
        let mut rows = [cells[0].of_closing_speed(0); LANES];
        for k in 0..LANES {
            rows[k] = cells[place[k] as usize % CELLS].of_closing_speed(piece[k]);
        }
        let closing_speed = E::polynomials(rows, at);
        for k in 0..LANES {
            squares[group][k] = closing_speed[k] * closing_speed[k];
        }
        nexts[group] = closing_speed;
        for (k, &is_sudden) in suddens[group].iter().enumerate() {
            sudden[length % BLOCK] = (group * LANES + k) as u16;
            length += is_sudden as usize;
        }
    }
    for group in sudden[..length.next_multiple_of(LANES).min(BLOCK)].as_chunks::<LANES>().0 {
        let (mut alpha, mut closing_speed, mut at) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let mut kappa = [0.0; LANES];
        let mut rows = [cells[0].of_beyond(0); LANES];
        for (k, &index) in group.iter().enumerate() {
            let from = usize::from(index) % BLOCK;
            (alpha[k], closing_speed[k], at[k]) =
                (hops.alpha[from], hops.next[from], hops.at[from]);
            kappa[k] = hops.kappa[from];
            rows[k] = cells[hops.cell[from] as usize % CELLS].of_beyond(hops.piece[from]);
        }
        let beyond = E::polynomials(rows, &at);
        let (mut excess, mut velocity, mut error) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for k in 0..LANES {
            let (alpha, beyond, closing_speed) = (alpha[k], beyond[k], closing_speed[k]);
            let first = First { half_time: alpha - beyond, beyond, closing_speed };
            let ground = ground_after(&first, alpha, kappa[k]);
            (excess[k], velocity[k], error[k]) = (ground.excess, ground.velocity, ground.error);
        }
        for k in 0..length.min(LANES) {
            let ground = Ground { excess: excess[k], velocity: velocity[k], error: error[k] };
            list.push(group[k], &ground, kappa[k]);
        }
        length = length.saturating_sub(LANES);
    }
}

/// The ends of the first `count` hops, up to whole vectors.
#[inline(always)]
pub(crate) fn ends(hops: &mut Hops, count: usize) {
    let count = count.next_multiple_of(LANES).min(BLOCK);
    let (alpha, mu, squares) = (&hops.alpha[..count], &hops.mu[..count], &hops.squares[..count]);
    let (errors, flights) = (&hops.errors[..count], &hops.flights[..count]);
    let next = &mut hops.next[..count];
    for k in 0..count {
        let sum =
            Sum { squares: squares[k], error: errors[k], half_time: 0.0, flights: flights[k] };
        let (decided, sure) = sum.end(alpha[k], mu[k]);
        let again = decided.next_speed_squared > 0.0;
        let root = if again { decided.next_speed_squared } else { 0.0 }.sqrt();
        let known = if again { root } else { -1.0 };
        next[k] = if sure { known } else { 0.0 };
    }
}
