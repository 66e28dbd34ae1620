//! Many hops of one map at once: every step a loop over arrays.
//!
//! ```text
//!   places      where the speeds lie in the tables             vectors
//!   first       Γ from the tables; lists of sudden landings    one by one: tables are no work for vectors
//!   later       flights of the lists, by branch                vectors: start, two steps, landing
//!               sums, and the lists of flights that follow     one by one
//!   end         α′ and whether it is beyond doubt              vectors
//! ```
//!
//! What does not settle is landed again, one by one, by the same functions as a single hop's.

use super::flight::{Branch, Ground, flight, land, step};
use super::hop::{FLIGHTS, Sum, ground_after};
use super::table::{CELLS, Cell, First, Place, Stars, stars};
use super::turn::Turn;
use crate::simd;
use std::cell::RefCell;
use std::f64::consts::PI;

/// Speeds that go through the steps together: their arrays stay in the cache.
pub(crate) const BLOCK: usize = 256;

/// Lanes of the widest vectors.
const LANES: usize = 8;

type Row = [f64; BLOCK];

/// The speeds of a block, their places, and what becomes of them.
pub(crate) struct Hops {
    alpha: Row,
    cell: [u64; BLOCK],
    piece: [u64; BLOCK],
    at: Row,
    sudden: [u64; BLOCK],
    /// Sums over the flights of a hop: Γ², its error, and how many; no number where the fast path gives up.
    squares: Row,
    errors: Row,
    flights: Row,
    /// α′; zero for grounded, no number where the careful path must decide.
    next: Row,
}

/// Flights, those with V < π from the front and those with V ≥ π from the back.
pub(crate) struct Flights {
    slow: usize,
    fast: usize,
    /// Which speed of the block.
    index: [u16; BLOCK],
    excess: Row,
    velocity: Row,
    error: Row,
}

/// Their landings.
pub(crate) struct Landings {
    /// Where the search is.
    h: Row,
    left: Row,
    right: Row,
    side: Row,
    sure: Row,
    excess: Row,
    velocity: Row,
    error: Row,
    square: Row,
    square_error: Row,
    /// 1 if settled, else 0.
    settled: Row,
}

/// The arrays of a block.
pub(crate) struct Block {
    hops: Hops,
    /// The flights of this round and of the next.
    lists: [Flights; 2],
    pub(crate) landings: Landings,
}

const ZERO: Row = [0.0; BLOCK];

impl Block {
    pub(crate) const EMPTY: Block = Block {
        hops: Hops {
            alpha: ZERO,
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
        landings: Landings {
            h: ZERO,
            left: ZERO,
            right: ZERO,
            side: ZERO,
            sure: ZERO,
            excess: ZERO,
            velocity: ZERO,
            error: ZERO,
            square: ZERO,
            square_error: ZERO,
            settled: ZERO,
        },
    };

    /// Arrays that a thread makes once; anew where they are in use.
    pub(crate) fn of_this_thread(work: impl FnOnce(&mut Block)) {
        thread_local!(static KEPT: RefCell<Block> = const { RefCell::new(Block::EMPTY) });
        KEPT.with(|kept| match kept.try_borrow_mut() {
            Ok(mut block) => work(&mut block),
            Err(_) => {
                let mut block = Block::EMPTY;
                work(&mut block);
            }
        });
    }

    /// The images of `speeds`, at most BLOCK of them; those that the fast path leaves open go to `careful`.
    pub(crate) fn images(
        &mut self,
        speeds: &mut [Option<f64>],
        (mu, kappa): (f64, f64),
        careful: &mut impl FnMut(&mut Option<f64>),
    ) {
        let count = speeds.len().min(BLOCK);
        for (alpha, speed) in self.hops.alpha.iter_mut().zip(&*speeds) {
            *alpha = speed.unwrap_or(0.0);
        }
        simd::places(&mut self.hops, stars(), count);
        self.first_flights(count, kappa);
        let mut now = 0;
        while self.lists[now].slow + self.lists[now].fast > 0 {
            self.later_flights(now, kappa);
            now = 1 - now;
        }
        simd::ends(&mut self.hops, mu, count);
        for (&next, speed) in self.hops.next.iter().zip(speeds) {
            if next > 0.0 {
                *speed = Some(next);
            } else if next < 0.0 {
                *speed = None;
            } else if speed.is_some() {
                careful(speed);
            }
        }
    }

    /// All first flights, and the list of flights that follow at once.
    fn first_flights(&mut self, count: usize, kappa: f64) {
        let Block { hops, lists: [list, _], .. } = self;
        let mut cells = Cell::all();
        let mut used = 0u64;
        for (&cell, &piece) in hops.cell.iter().zip(&hops.piece).take(count) {
            used |= u64::from(piece != Place::NOWHERE.piece) << (cell % CELLS as u64);
        }
        for (n, cell) in cells.iter_mut().enumerate() {
            if used >> n & 1 == 1 {
                *cell = Cell::get(n as u64);
            }
        }
        let mut sudden = [0u16; BLOCK];
        let mut length = 0;
        for at in 0..count {
            let cell = cells[hops.cell[at] as usize % CELLS];
            let closing_speed = cell.closing_speed(hops.piece[at], hops.at[at]);
            hops.squares[at] = closing_speed * closing_speed;
            sudden[length % BLOCK] = at as u16;
            length += hops.sudden[at] as usize;
            // For a sudden landing Γ is asked for once more.
            hops.next[at] = closing_speed;
        }
        list.clear();
        for &index in sudden.iter().take(length) {
            let at = usize::from(index) % BLOCK;
            let cell = cells[hops.cell[at] as usize % CELLS];
            let beyond = cell.beyond(hops.piece[at], hops.at[at]);
            let (alpha, closing_speed) = (hops.alpha[at], hops.next[at]);
            let first = First { half_time: alpha - beyond, beyond, closing_speed };
            list.push(index, &ground_after(&first, alpha, kappa));
        }
    }

    /// The flights of the list `now`; those that follow go to the other list.
    fn later_flights(&mut self, now: usize, kappa: f64) {
        let (first, second) = self.lists.split_at_mut(1);
        let (list, next) =
            if now == 0 { (&first[0], &mut second[0]) } else { (&second[0], &mut first[0]) };
        next.clear();
        simd::slow_landings(list, &mut self.landings, kappa);
        self.hops.add(list, 0..list.slow, &self.landings, next, kappa);
        simd::fast_landings(list, &mut self.landings, kappa);
        self.hops.add(list, BLOCK - list.fast..BLOCK, &self.landings, next, kappa);
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
        kappa: f64,
    ) {
        for at in range {
            let at = at % BLOCK;
            let to = usize::from(list.index[at]) % BLOCK;
            let mut ground = landings.ground(at);
            let (mut square, mut error) = (landings.square[at], landings.square_error[at]);
            if !(landings.settled[at] > 0.0) {
                match flight(&list.ground(at), kappa) {
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
                    next.push(list.index[at], &ground);
                } else {
                    self.squares[to] = f64::NAN;
                }
            }
        }
    }
}

impl Flights {
    pub(crate) const EMPTY: Flights =
        Flights { slow: 0, fast: 0, index: [0; BLOCK], excess: ZERO, velocity: ZERO, error: ZERO };

    fn clear(&mut self) {
        (self.slow, self.fast) = (0, 0);
    }

    #[inline(always)]
    fn push(&mut self, index: u16, ground: &Ground) {
        let is_slow = ground.velocity < PI;
        let at = if is_slow { self.slow } else { BLOCK - 1 - self.fast } % BLOCK;
        self.slow += usize::from(is_slow);
        self.fast += usize::from(!is_slow);
        self.index[at] = index;
        self.excess[at] = ground.excess;
        self.velocity[at] = ground.velocity;
        self.error[at] = ground.error;
    }

    #[inline(always)]
    fn ground(&self, at: usize) -> Ground {
        let (excess, velocity, error) = (self.excess[at], self.velocity[at], self.error[at]);
        Ground { excess, velocity, error }
    }
}

impl Landings {
    #[inline(always)]
    fn ground(&self, at: usize) -> Ground {
        let (excess, velocity, error) = (self.excess[at], self.velocity[at], self.error[at]);
        Ground { excess, velocity, error }
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

/// The ends of the first `count` hops, up to whole vectors.
#[inline(always)]
pub(crate) fn ends(hops: &mut Hops, mu: f64, count: usize) {
    let count = count.next_multiple_of(LANES).min(BLOCK);
    let (alpha, squares) = (&hops.alpha[..count], &hops.squares[..count]);
    let (errors, flights) = (&hops.errors[..count], &hops.flights[..count]);
    let next = &mut hops.next[..count];
    for k in 0..count {
        let sum =
            Sum { squares: squares[k], error: errors[k], half_time: 0.0, flights: flights[k] };
        let (decided, sure) = sum.end(alpha[k], mu);
        let again = decided.radicand > 0.0;
        let root = if again { decided.radicand } else { 0.0 }.sqrt();
        let known = if again { root } else { -1.0 };
        next[k] = if sure { known } else { 0.0 };
    }
}

/// All landings on the branches of V < π.
#[inline(always)]
pub(crate) fn land_slow(list: &Flights, landings: &mut Landings, kappa: f64) {
    land_all::<false>(list, 0, list.slow, landings, kappa);
}

/// All landings on the branches of V ≥ π.
#[inline(always)]
pub(crate) fn land_fast(list: &Flights, landings: &mut Landings, kappa: f64) {
    land_all::<true>(list, BLOCK - list.fast.min(BLOCK), BLOCK, landings, kappa);
}

/// All landings from `begin` to `end`: loops without a branch, and short enough that a processor has several
/// vectors under way.
#[inline(always)]
fn land_all<const FAST: bool>(
    list: &Flights,
    begin: usize,
    end: usize,
    landings: &mut Landings,
    kappa: f64,
) {
    // Whole vectors: what lies beyond is old, lands as well and is not looked at. And slices of one length: no
    // bounds to check, no exit but the end.
    let (begin, end) = (begin / LANES * LANES, end.next_multiple_of(LANES).min(BLOCK));
    let Some(count) = end.checked_sub(begin) else { return };
    let (excess, velocity) = (&list.excess[begin..end], &list.velocity[begin..end]);
    let error = &list.error[begin..end];
    let h = &mut landings.h[begin..end];
    let (left, right) = (&mut landings.left[begin..end], &mut landings.right[begin..end]);
    let (side, sure) = (&mut landings.side[begin..end], &mut landings.sure[begin..end]);
    let ground =
        |at: usize| Ground { excess: excess[at], velocity: velocity[at], error: error[at] };
    for at in 0..count {
        let branch = if FAST { Branch::fast(&ground(at)) } else { Branch::slow(&ground(at)) };
        h[at] = branch.first();
        (left[at], right[at]) = (branch.left, branch.right);
        (side[at], sure[at]) = (branch.side, branch.sure);
    }
    let branch = |at: usize, left: &[f64], right: &[f64], side: &[f64], sure: &[f64]| Branch {
        left: left[at],
        right: right[at],
        side: side[at],
        sure: sure[at],
        start: 0.0,
    };
    for at in 0..count {
        let turn = Turn::at(h[at]);
        let branch = branch(at, left, right, side, sure);
        h[at] = branch.moved(turn.h, step(&turn, &ground(at)));
    }
    let (to_excess, to_velocity) =
        (&mut landings.excess[begin..end], &mut landings.velocity[begin..end]);
    let (to_error, square) = (&mut landings.error[begin..end], &mut landings.square[begin..end]);
    let (square_error, settled) =
        (&mut landings.square_error[begin..end], &mut landings.settled[begin..end]);
    for at in 0..count {
        let turn = Turn::at(h[at]);
        let (ground, branch) = (ground(at), branch(at, left, right, side, sure));
        let landed = land(&turn, step(&turn, &ground), &ground, &branch, kappa);
        to_excess[at] = landed.ground.excess;
        to_velocity[at] = landed.ground.velocity;
        to_error[at] = landed.ground.error;
        square[at] = landed.square;
        square_error[at] = landed.square_error;
        settled[at] = if landed.settled { 1.0 } else { 0.0 };
    }
}

#[cfg(test)]
impl Flights {
    pub(crate) fn add(&mut self, index: u16, [excess, velocity, error]: [f64; 3]) {
        self.push(index, &Ground { excess, velocity, error });
    }
}

#[cfg(test)]
impl Landings {
    pub(crate) fn same_bits(&self, other: &Self) -> bool {
        let rows = |landings: &Self| {
            let Landings { excess, velocity, error, square, square_error, settled, h, .. } =
                *landings;
            [excess, velocity, error, square, square_error, settled, h]
        };
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
        rows(self).iter().flatten().zip(rows(other).iter().flatten()).all(same)
    }
}
