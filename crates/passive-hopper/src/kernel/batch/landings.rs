//! Many later flights at once: lists of flights, and the loops that land them.

use crate::kernel::batch::bulk::{BLOCK, LANES, Row, ZERO};
use crate::kernel::scalar::flight::{Branch, Ground, land, last_step, step};
use crate::kernel::scalar::turn::Turn;
use std::f64::consts::PI;

/// Flights, those with V < π from the front and those with V ≥ π from the back.
pub(crate) struct Flights {
    pub(crate) slow: usize,
    pub(crate) fast: usize,
    /// Which speed of the block.
    pub(crate) index: [u16; BLOCK],
    pub(crate) excess: Row,
    pub(crate) velocity: Row,
    pub(crate) error: Row,
    pub(crate) kappa: Row,
}

/// Their landings.
pub(crate) struct Landings {
    /// Where the search is.
    h: Row,
    left: Row,
    right: Row,
    side: Row,
    sure: Row,
    pub(crate) excess: Row,
    pub(crate) velocity: Row,
    pub(crate) error: Row,
    pub(crate) square: Row,
    pub(crate) square_error: Row,
    /// 1 if settled, else 0.
    pub(crate) settled: Row,
}

impl Flights {
    pub(crate) const EMPTY: Flights = Flights {
        slow: 0,
        fast: 0,
        index: [0; BLOCK],
        excess: ZERO,
        velocity: ZERO,
        error: ZERO,
        kappa: ZERO,
    };

    pub(crate) fn clear(&mut self) {
        (self.slow, self.fast) = (0, 0);
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, index: u16, ground: &Ground, kappa: f64) {
        let is_slow = ground.velocity < PI;
        let at = if is_slow { self.slow } else { BLOCK - 1 - self.fast } % BLOCK;
        self.slow += usize::from(is_slow);
        self.fast += usize::from(!is_slow);
        self.index[at] = index;
        self.excess[at] = ground.excess;
        self.velocity[at] = ground.velocity;
        self.error[at] = ground.error;
        self.kappa[at] = kappa;
    }

    #[inline(always)]
    pub(crate) fn ground(&self, at: usize) -> Ground {
        let (excess, velocity, error) = (self.excess[at], self.velocity[at], self.error[at]);
        Ground { excess, velocity, error }
    }
}

impl Landings {
    pub(crate) const EMPTY: Landings = Landings {
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
    };

    #[inline(always)]
    pub(crate) fn ground(&self, at: usize) -> Ground {
        let (excess, velocity, error) = (self.excess[at], self.velocity[at], self.error[at]);
        Ground { excess, velocity, error }
    }
}

/// All landings on the branches of V < π.
#[inline(always)]
pub(crate) fn land_slow(list: &Flights, landings: &mut Landings) {
    land_all::<false>(list, 0, list.slow, landings);
}

/// All landings on the branches of V ≥ π.
#[inline(always)]
pub(crate) fn land_fast(list: &Flights, landings: &mut Landings) {
    land_all::<true>(list, BLOCK - list.fast.min(BLOCK), BLOCK, landings);
}

/// All landings from `begin` to `end`: loops without a branch, and short enough that a processor has several
/// vectors under way.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "arrays in step")]
fn land_all<const FAST: bool>(list: &Flights, begin: usize, end: usize, landings: &mut Landings) {
    // Whole vectors: what lies beyond is old, lands as well and is not looked at. And slices of one length: no
    // bounds to check, no exit but the end.
    let (begin, end) = (begin / LANES * LANES, end.next_multiple_of(LANES).min(BLOCK));
    let Some(count) = end.checked_sub(begin) else { return };
    let (excess, velocity) = (&list.excess[begin..end], &list.velocity[begin..end]);
    let (error, kappa) = (&list.error[begin..end], &list.kappa[begin..end]);
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
        let turn = Turn::near(h[at]);
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
        let landed = land(&turn, last_step(&turn, &ground), &ground, &branch, kappa[at]);
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
    pub(crate) fn add(&mut self, index: u16, [excess, velocity, error, kappa]: [f64; 4]) {
        self.push(index, &Ground { excess, velocity, error }, kappa);
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
