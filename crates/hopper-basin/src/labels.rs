//! The fates of many lift-off speeds at one mass ratio, hop by hop together.

use crate::{Error, Fates, HOP_BUDGET, HopperFate, TrapEdge};
use basin_of_attraction::Traps;
use passive_hopper::{DoubleDouble, alpha_star, index_below};
use std::f64::consts::FRAC_1_PI;

/// Traps in a ladder; those of larger n are asked one by one.
const RUNGS: u64 = 64;

/// The traps as closed intervals of `f64`, from 0 = α*_0 up.
struct Ladder {
    traps: Vec<(f64, f64)>,
}

impl Ladder {
    /// The traps of all fixed points up to the one below `alpha`.
    fn below(fates: &Fates, alpha: f64) -> Result<Self, Error> {
        let last = index_below(alpha)?.min(RUNGS - 1);
        let trap = |n: u64| {
            let trap = fates.trap(n)?;
            let right = match trap.edge {
                TrapEdge::NextFixedPoint => last_below(alpha_star(n + 1)),
                TrapEdge::Crossing | TrapEdge::ContactEnd => trap.right(),
            };
            Ok((first_from(trap.star), right))
        };
        let mut traps = (0..=last).map(trap).collect::<Result<Vec<_>, Error>>()?;
        if last + 1 < RUNGS {
            // Nobody is on the next rung, but some are on the way to it.
            traps.push((f64::INFINITY, f64::INFINITY));
        }
        Ok(Ladder { traps })
    }

    /// The label of the trap that holds `alpha` > 0, as that of [`Traps`] for [`Fates`].
    #[inline]
    fn label(&self, alpha: f64, fates: &Fates) -> Option<u16> {
        // α*_n ∈ (nπ, (n+1)π), so that ⌊α/π⌋ is the index below or one more, if it is right; next to nπ, where
        // it may not be, the two differ in nothing: neither trap begins there.
        let n = (alpha * FRAC_1_PI) as usize;
        match self.traps.get(n) {
            Some(&(left, right)) if alpha >= left => (alpha <= right).then_some(n as u16),
            Some(_) => {
                let &(_, right) = self.traps.get(n.wrapping_sub(1))?;
                (alpha <= right).then_some((n - 1) as u16)
            }
            None => fates.label(alpha),
        }
    }
}

/// The smallest `f64` from `star` on.
fn first_from(star: DoubleDouble) -> f64 {
    if star.low > 0.0 { star.high.next_up() } else { star.high }
}

/// The largest `f64` below `star`.
fn last_below(star: DoubleDouble) -> f64 {
    if star.low > 0.0 { star.high } else { star.high.next_down() }
}

impl Fates {
    /// The [labels](HopperFate::label) of the fates of all `speeds`, those that [`fate`](Self::fate) gives one
    /// by one; a speed that it refuses has the label of an undecided hop.
    ///
    /// The orbits hop together, as [`LiftOffMap::images`](passive_hopper::LiftOffMap::images) does.
    ///
    /// ```
    /// use hopper_basin::{Fates, HopperFate};
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.2)?)?;
    /// assert_eq!(fates.labels(&[4.55, 4.60]), [1, HopperFate::Decaying.label()]);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    pub fn labels(&self, speeds: &[f64]) -> Vec<u16> {
        let mut labels = vec![HopperFate::UNDECIDED; speeds.len()];
        let largest = speeds.iter().fold(0.0, |a: f64, &b| if b > a { b } else { a });
        match Ladder::below(self, largest) {
            Ok(ladder) => Orbits::new(self, &ladder, speeds).follow(&mut labels),
            Err(_) => {
                for (label, &speed) in labels.iter_mut().zip(speeds) {
                    *label = self.label_of(speed);
                }
            }
        }
        labels
    }

    /// The label of one fate.
    pub(crate) fn label_of(&self, alpha: f64) -> u16 {
        self.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label)
    }
}

/// Orbits that have not come to their end.
struct Orbits<'a> {
    fates: &'a Fates,
    ladder: &'a Ladder,
    starts: &'a [f64],
    /// Which start.
    index: Vec<u32>,
    /// Where they are.
    speeds: Vec<Option<f64>>,
    /// Where they were.
    before: Vec<f64>,
}

impl<'a> Orbits<'a> {
    fn new(fates: &'a Fates, ladder: &'a Ladder, starts: &'a [f64]) -> Self {
        let speeds = starts.iter().map(|&start| Some(start)).collect();
        let index = (0..starts.len() as u32).collect();
        // Nowhere before: no number equals it.
        Orbits { fates, ladder, starts, index, speeds, before: vec![f64::NAN; starts.len()] }
    }

    /// Follows all to their labels.
    fn follow(&mut self, labels: &mut [u16]) {
        for _ in 0..=HOP_BUDGET {
            self.sort_out(labels);
            if self.index.is_empty() {
                return;
            }
            self.before.clear();
            self.before.extend(self.speeds.iter().map(|speed| speed.unwrap_or(f64::NAN)));
            // Those with an error keep their speeds, and are sorted out one by one.
            let _ = self.fates.map().images(&mut self.speeds);
        }
    }

    /// Labels those that have come to an end, and keeps the others.
    fn sort_out(&mut self, labels: &mut [u16]) {
        let mut kept = 0;
        for at in 0..self.index.len() {
            let index = self.index[at];
            let label = match self.speeds[at] {
                None => Some(HopperFate::GROUNDED),
                Some(alpha) if alpha == self.before[at] || !(alpha > 0.0) => {
                    Some(self.fates.label_of(self.starts[index as usize]))
                }
                // Higher indices share a label of the generic traps.
                Some(alpha) => self.ladder.label(alpha, self.fates).map(|label| {
                    let many = u64::from(label) >= HopperFate::LARGEST_LABEL;
                    if many { self.fates.label_of(self.starts[index as usize]) } else { label }
                }),
            };
            match label {
                Some(label) => labels[index as usize] = label,
                None => {
                    self.index[kept] = index;
                    self.speeds[kept] = self.speeds[at];
                    kept += 1;
                }
            }
        }
        self.index.truncate(kept);
        self.speeds.truncate(kept);
    }
}
