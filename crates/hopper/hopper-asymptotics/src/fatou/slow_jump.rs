//! Jumps along the left side of a fixed point, to a turn from which an orbit leaves within some hops.

use crate::fatou::fatou_coordinate::FatouCoordinate;
use crate::fatou::hop_count::HopCount;
use crate::fatou::local_hop_model::Side;
use crate::fatou::offset::Offset;

/// A point that an orbit reaches along the slow side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowJump {
    /// The number of hops that were jumped over.
    pub hops: u64,
    /// The offset after them.
    pub delta: f64,
    /// Bound on its error.
    pub error: f64,
    /// Ψ after them. All jumps at one mass ratio end on the same turn: the number is the same for the same fraction.
    pub count: HopCount,
}

/// The largest error of the offset of a [`FatouCoordinate::long_jump`], as a part of the offset.
const LARGEST_PART: f64 = 0.05;

/// The largest number of hops of one [`SlowJump`]: an `f64` up to it has its digit of one half.
const LARGEST_JUMP: f64 = 4.5e15;

impl FatouCoordinate {
    /// The point with the same fraction that an orbit on the left reaches later: the one of the last turn on which
    /// the series has an error below 10⁻⁸. `None` if the error of Ψ exceeds `largest`, or the offset is beyond this
    /// turn.
    pub fn jump(&self, delta: f64, error: f64, largest: f64) -> Option<SlowJump> {
        // The error of Ψ is at least error/(3 A x⁴) (docs/theory.md, after Lemma 92).
        if error > largest * 3.0 * self.drift() * delta.abs() * pxfm::f_cbrt(delta.abs()) {
            return None;
        }
        let count = self.count_within(delta, error).ok()?;
        let first = self.series.end_of_jump();
        let hops = (count.hops - first).floor();
        let known = self.side == Side::Left && count.error <= largest;
        if !(known && (0.0..=LARGEST_JUMP).contains(&hops)) {
            return None;
        }
        Some(self.land(hops as u64, HopCount { hops: count.hops - hops, ..count }))
    }

    /// The |δ| beyond which a [`jump`](Self::jump) has nothing to jump over.
    pub fn jump_range(&self) -> f64 {
        let root = self.series.first_of_jump();
        root * root * root
    }

    fn land(&self, hops: u64, count: HopCount) -> SlowJump {
        let (delta, error) = self.offset_at(count);
        SlowJump { hops, delta, error, count }
    }

    /// As [`jump`](Self::jump), from `delta` + `rest`, at most half an ulp apart, with the longer
    /// [`phase`](Self::phase). `None` also for an error above a twentieth of |δ|.
    pub fn long_jump(
        &self,
        (delta, rest): (f64, f64),
        error: f64,
        largest: f64,
    ) -> Option<SlowJump> {
        if !(self.side == Side::Left && delta < 0.0 && -delta <= self.range()) {
            return None;
        }
        let phase = self.phase(Offset::from(delta)).ok()?;
        let whole =
            i64::try_from(phase.whole()).ok().filter(|&whole| whole < LARGEST_JUMP as i64)?;
        let root = pxfm::f_cbrt(delta.abs());
        let slope = self.series.slope(root) * self.side.sign() / (3.0 * root * root); // dΨ/dδ
        if !(error + rest.abs() <= LARGEST_PART * delta.abs()) {
            return None;
        }
        // docs/theory.md, Lemma 92.1. The slope grows like |δ|^{−4/3}: by less than a half over a twentieth of δ.
        let error = phase.error()
            + 2.0 * self.series.series_error(root)
            + 1.5 * error * slope.abs()
            + 4.0 * f64::EPSILON * (rest * slope).abs();
        let fraction = phase.fraction() + rest * slope;
        let nearest = self.series.nearest();
        let last = (nearest.hops + nearest.error + error - fraction).ceil();
        let hops = whole.checked_sub(last as i64).filter(|&hops| hops >= 0)?;
        if !(error <= largest) {
            return None;
        }
        Some(self.land(hops as u64, HopCount { hops: last + fraction, error }))
    }

    /// The smallest Ψ of the turn on which a [`jump`](Self::jump) ends.
    pub fn turn_of_jumps(&self) -> f64 {
        self.series.end_of_jump()
    }
}
