//! The slow sides of the fixed points at one mass ratio: where an orbit need not be followed hop by hop.
//!
//! Left of α*_n an orbit at distance |δ| takes some |δ|^{−1/3} hops to leave. The Fatou coordinate gives the point
//! that it reaches, with an error (docs/theory.md, Section 16).

use hopper_asymptotics::{Coefficients, FatouCoordinate, Form, HopCount, OutwardWalk, SlowJump};
use passive_hopper::{FixedPointSpeed, MassRatio, alpha_star};
use std::f64::consts::FRAC_1_PI;
use std::sync::OnceLock;

/// The number of fixed points whose coordinates are stored. Those of larger n are computed at each use.
const KEPT: usize = 64;

/// No walk or jump begins farther from its fixed point: |δ| = (|t|/β)³ up to terms of relative size |t|, with |t| ≤
/// 0.3 and β ≥ 2.24, is below 2.5·10⁻³.
const FARTHEST: f64 = 3e-3;

/// The farthest |δ| left of α*_n at which A |δ|^{1/3} is at most `turn`, or more.
fn farthest(n: u64, mass_ratio: MassRatio, turn: f64) -> f64 {
    let Ok(local) = Coefficients::new(n, mass_ratio, Form::Corrected) else { return 0.0 };
    let root = turn / local.left_drift();
    (1.1 * root * root * root).min(FARTHEST)
}

/// The largest A x of a walk and of a jump. From 0.8 an orbit leaves with the next hop or two, which lose less than
/// a walk costs. It affects the time only.
const WALK: f64 = 0.8;
const JUMP: f64 = 0.12;

/// Largest error of a phase with which an orbit jumps. Where it decides too little, longer arithmetic has a smaller
/// one. The fates are right with any value below 1/2; a smaller one sends more orbits to longer arithmetic at once.
pub(crate) const LARGEST_ERROR: f64 = 0.01;

/// The left sides of the fixed points.
#[derive(Debug, Clone)]
pub(crate) struct SlowSides {
    mass_ratio: MassRatio,
    /// Those of α*_1, α*_2, …; `None` inside where there is none.
    first: [SlowSide; KEPT],
}

/// The slow side of one fixed point. Many orbits need the coordinate alone, so that each part is computed at its
/// first use.
#[derive(Debug, Clone, Default)]
struct SlowSide {
    psi: OnceLock<Option<Box<FatouCoordinate>>>,
    walk: OnceLock<Option<Box<OutwardWalk>>>,
}

impl SlowSides {
    pub(crate) fn new(mass_ratio: MassRatio) -> Self {
        SlowSides { mass_ratio, first: std::array::from_fn(|_| SlowSide::default()) }
    }

    /// The offset of an orbit at `speed` from α*_n, n ≥ 1, if it may be near enough to jump along the slow side.
    #[inline]
    pub(crate) fn offset_if_near(&self, speed: f64, n: u64) -> Option<f64> {
        let offset = FixedPointSpeed::new(n).offset_of(speed);
        let near = offset < 0.0 && offset > -FARTHEST;
        (near && -offset <= farthest(n, self.mass_ratio, JUMP)).then_some(offset)
    }

    /// The end of the slow hops of the orbit within `error` of α*_n + `offset`; `None` for a phase with an error
    /// above `largest`.
    pub(crate) fn jump(&self, n: u64, offset: f64, error: f64, largest: f64) -> Option<SlowJump> {
        self.with(n, |psi| psi.jump(offset, error, largest))
    }

    /// The smallest Ψ of the turn on which jumps left of α*_n end.
    pub(crate) fn turn(&self, n: u64) -> Option<f64> {
        self.with(n, |psi| Some(psi.turn_of_jumps()))
    }

    /// The offset left of α*_n at which Ψ is `hops`, on or next to the turn of jumps, and a bound on its error.
    pub(crate) fn offset(&self, n: u64, hops: f64) -> Option<(f64, f64)> {
        self.with(n, |psi| Some(psi.offset_at(HopCount { hops, error: 0.0 })))
    }

    /// The offset after a hop left of α*_n, and a bound on its error; `None` where the orbit leaves.
    pub(crate) fn walk(&self, n: u64, (offset, error): (f64, f64)) -> Option<(f64, f64)> {
        self.with_walk(n, |walk| walk.hop(offset, error))
    }

    /// The largest |δ| from which a [`walk`](Self::walk) goes on.
    pub(crate) fn walk_range(&self, n: u64) -> Option<f64> {
        self.with_walk(n, |walk| Some(walk.range()))
    }

    /// Whether the point is so far from α*_n that a jump would lead back.
    pub(crate) fn is_beyond_jumps(&self, n: u64, offset: f64) -> bool {
        self.with(n, |psi| (-offset > psi.jump_range()).then_some(())).is_some()
    }

    /// The number of hops, the offset and its error where the orbit within `error` of α*_n + `offset` leaves: after
    /// a jump, or after one hop; `None` where it has left, and for an error too large.
    pub(crate) fn leave(&self, n: u64, offset: f64, error: f64) -> Option<(u64, f64, f64)> {
        let jump = self.jump(n, offset, error, LARGEST_ERROR).filter(|jump| jump.hops > 0);
        match jump {
            Some(jump) => Some((jump.hops, jump.delta, jump.error)),
            None => self.walk(n, (offset, error)).map(|(offset, error)| (1, offset, error)),
        }
    }

    /// As [`jump`](Self::jump), from an offset in two parts.
    pub(crate) fn long_jump(&self, n: u64, offset: (f64, f64), error: f64) -> Option<SlowJump> {
        self.with(n, |psi| psi.long_jump(offset, error, LARGEST_ERROR))
    }

    /// The result of `use_it` with the coordinate of α*_n.
    fn with<T>(&self, n: u64, use_it: impl FnOnce(&FatouCoordinate) -> Option<T>) -> Option<T> {
        let make = || self.with_walk(n, |walk| FatouCoordinate::along(walk).ok()).map(Box::new);
        match self.side(n) {
            Some(side) => use_it(side.psi.get_or_init(make).as_ref()?),
            None => use_it(&*make()?),
        }
    }

    /// The result of `use_it` with the hops left of α*_n.
    fn with_walk<T>(&self, n: u64, use_it: impl FnOnce(&OutwardWalk) -> Option<T>) -> Option<T> {
        let make = || Some(Box::new(OutwardWalk::new(n, self.mass_ratio).ok()?));
        match self.side(n) {
            Some(side) => use_it(side.walk.get_or_init(make).as_ref()?),
            None => use_it(&*make()?),
        }
    }

    fn side(&self, n: u64) -> Option<&SlowSide> {
        self.first.get(usize::try_from(n.checked_sub(1)?).ok()?)
    }
}

/// A zone ends this much above α*_n: more than the error of an orbit that comes there in `f64`, which may lie below
/// α*_n.
const BEYOND: f64 = 1.0 + 1e-11;

/// The ends of the slow sides at one mass ratio, for a fast look-up.
#[derive(Debug, Clone)]
pub(crate) struct SlowZones {
    /// For n = 0, 1, …: the speeds from which an orbit may walk left of α*_n, and may jump, and α*_n. The first
    /// zone is empty.
    zones: Vec<[f64; 3]>,
}

/// A place on the slow side of α*_n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlowZone {
    pub(crate) n: u64,
    /// Whether the orbit may be near enough to jump.
    pub(crate) jumps: bool,
}

impl SlowZones {
    /// The zones of α*_1 to α*_`last`.
    pub(crate) fn new(mass_ratio: MassRatio, last: u64) -> Self {
        let zone = |n| {
            let star = alpha_star(n);
            let left = |turn| star - farthest(n, mass_ratio, turn);
            [left(WALK), left(JUMP), star * BEYOND]
        };
        let empty = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        SlowZones { zones: std::iter::once(empty).chain((1..=last).map(zone)).collect() }
    }

    /// Whether an orbit at α*_n + `offset` may be near enough to jump.
    pub(crate) fn may_jump(&self, n: u64, offset: f64) -> bool {
        let zone = usize::try_from(n).ok().and_then(|n| self.zones.get(n));
        zone.is_none_or(|&[_, jump, _]| alpha_star(n) + offset >= jump)
    }

    /// The n ≥ 1 whose slow side may contain `alpha`.
    #[inline]
    pub(crate) fn find(&self, alpha: f64) -> Option<SlowZone> {
        // α*_n lies in (nπ, (n+1)π), and the zone is narrower than its distance from nπ.
        let n = (alpha * FRAC_1_PI) as usize;
        let &[walk, jump, right] = self.zones.get(n)?;
        let zone = SlowZone { n: n as u64, jumps: alpha >= jump };
        ((alpha >= walk) & (alpha <= right)).then_some(zone)
    }
}
