//! The error bounds of hops: of every landing, and of the next speed.
//!
//! Each hop is computed in 106 bits, and every shorter way that decides it is compared, landing by landing. The bound
//! of the 106 bits themselves is added to the error. Where the ratio then passes ½, and on one hop in a hundred, the
//! comparison is made with 256 or 512 bits, and the 106 bits are compared as well.

use super::hop_classes::CLASSES;
use super::measured::Measured;
use super::tally::Tally;
use crate::error::Error;
use crate::repository::Progress;
use passive_hopper::{HopErrors, LiftOffMap, MassRatio, Solver};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// The ways that are compared with longer ones.
const SOLVERS: [Solver; 4] = [Solver::Kernel, Solver::General, Solver::Bits106, Solver::Bits256];

/// The place of the kernel in [`SOLVERS`].
const KERNEL: usize = 0;

/// The bounded quantities of a hop.
const QUANTITIES: usize = 9;

/// The place of the decisions among the quantities.
const DECISIONS: usize = 6;

/// The names of the bounds of one way. Only the kernel has a table.
macro_rules! names {
    ($way:literal) => {
        [
            concat!($way, ": x′"),
            concat!($way, ": V′"),
            concat!($way, ": μΓ²/α²"),
            concat!($way, ": maximum test"),
            concat!($way, ": α′²/α²"),
            concat!($way, ": α′"),
            concat!($way, ": decisions"),
            concat!($way, ": Γ of the first flight's table"),
            concat!($way, ": α − h of the first flight's table"),
        ]
    };
}

const NAMES: [[&str; QUANTITIES]; SOLVERS.len()] =
    [names!("kernel"), names!("general solver"), names!("106 bits"), names!("256 bits")];

/// Where the bounds of docs/theory.md are derived, for a way whose landings have the bound of `landing`.
const fn statements(landing: &'static str) -> [&'static str; QUANTITIES] {
    let test = "Lemma 64";
    let whole = "Theorem 66";
    // The loss of a first flight into contact has a bound of its own.
    let loss = "Theorem 66, Lemma 62";
    [landing, landing, loss, test, whole, whole, whole, "Lemma 61", "Lemma 61"]
}

/// The statements by the place of each way in [`SOLVERS`]: the rounding of a landing, and its propagation.
const STATEMENTS: [[&str; QUANTITIES]; SOLVERS.len()] = [
    statements("Lemma 61"),
    statements("Theorem 60, Lemma 58"),
    statements("Theorem 60, Lemma 63"),
    statements("Theorem 60, Lemma 63"),
];

/// One hop in so many is compared with 256 bits, and 106 bits with them.
const EVERY_256: u64 = 100;

/// One hop in so many is compared with 512 bits, and 256 bits with them. 512 bits take five times as long as 256.
const EVERY_512: u64 = 2000;

/// Above this ratio a comparison is repeated with a longer arithmetic, up to 512 bits: the bound of the reference
/// may be a large part of the ratio.
const LARGE_RATIO: f64 = 0.5;

/// Hops that one thread takes at a time: enough for the progress bar, few enough that all threads end together.
const BLOCK: u64 = 64;

/// The bounds of hops on all classes.
pub(crate) struct HopBounds {
    pub(crate) measured: Vec<Measured>,
    /// Hops that were compared.
    pub(crate) compared: u64,
    /// Hops that no arithmetic decides, so that there is no value to compare with.
    pub(crate) undecided: u64,
}

/// Measures the bounds of hops on about `count` hops.
///
/// # Errors
/// [`Error::Hopper`] if a mass ratio of a class is refused.
pub(crate) fn measure(count: u64, seed: u64, progress: &Progress) -> Result<HopBounds, Error> {
    let mut blocks = Vec::new();
    for (place, class) in CLASSES.iter().enumerate() {
        let hops = count / 100 * class.percent + count % 100 * class.percent / 100;
        let starts = (0..hops).step_by(BLOCK as usize);
        blocks.extend(starts.map(|start| (place, start..(start + BLOCK).min(hops))));
    }
    // Long classes come in turn with short ones: the estimate of the remaining time is then right.
    let mut order: Vec<usize> = (0..blocks.len()).collect();
    order.sort_by_key(|&index| blocks[index].1.start * 100 / CLASSES[blocks[index].0].percent);
    let bar = progress.bar("bounds of hops", count);
    let done = AtomicU64::new(0);
    let total: Result<Total, Error> = order
        .into_par_iter()
        .map(|index| blocks[index].clone())
        .try_fold(Total::new, |mut total, (place, hops)| {
            for index in hops.clone() {
                total.add(place, seed, index)?;
            }
            let length = hops.end - hops.start;
            bar.set(done.fetch_add(length, Ordering::Relaxed) + length);
            Ok(total)
        })
        .try_reduce(Total::new, |a, b| Ok(a.merged(b)));
    bar.finish();
    Ok(total?.result(seed))
}

/// The tallies of all classes and bounds.
struct Total {
    /// By class, way and quantity.
    tallies: Vec<Option<Tally>>,
    compared: u64,
    undecided: u64,
}

impl Total {
    fn new() -> Self {
        let tallies = vec![None; CLASSES.len() * SOLVERS.len() * QUANTITIES];
        Total { tallies, compared: 0, undecided: 0 }
    }

    fn tally(&mut self, class: usize, way: usize, quantity: usize) -> &mut Tally {
        let place = (class * SOLVERS.len() + way) * QUANTITIES + quantity;
        self.tallies[place].get_or_insert_with(Tally::new)
    }

    /// Compares the hop `index` of a class.
    fn add(&mut self, class: usize, seed: u64, index: u64) -> Result<(), Error> {
        let (mass_ratio, alpha) = CLASSES[class].start(seed, index);
        let map = LiftOffMap::new(MassRatio::new(mass_ratio)?);
        let shortest = match index {
            k if k % EVERY_512 == 0 => Solver::Bits512,
            k if k % EVERY_256 == 0 => Solver::Bits256,
            _ => Solver::Bits106,
        };
        let Some(found) = compare(&map, alpha, shortest) else {
            self.undecided += 1;
            return Ok(());
        };
        self.compared += 1;
        if let Some([closing_speed, beyond]) = found.first_flight {
            self.tally(class, KERNEL, DECISIONS + 1).add(closing_speed, index);
            self.tally(class, KERNEL, DECISIONS + 2).add(beyond, index);
        }
        for (way, errors) in found.of_ways {
            each_ratio(&errors, |quantity, ratio| {
                self.tally(class, way, quantity).add(ratio, index);
            });
        }
        Ok(())
    }

    fn merged(mut self, other: Total) -> Self {
        for (tally, more) in self.tallies.iter_mut().zip(other.tallies) {
            match (tally, more) {
                (Some(tally), Some(more)) => tally.merge(&more),
                (tally, more) => *tally = tally.take().or(more),
            }
        }
        self.compared += other.compared;
        self.undecided += other.undecided;
        self
    }

    fn result(self, seed: u64) -> HopBounds {
        let mut measured = Vec::new();
        for (way, names) in NAMES.iter().enumerate() {
            for (quantity, name) in names.iter().enumerate() {
                for (place, class) in CLASSES.iter().enumerate() {
                    let at = (place * SOLVERS.len() + way) * QUANTITIES + quantity;
                    let Some(tally) = &self.tallies[at] else { continue };
                    let statement = STATEMENTS[way][quantity];
                    measured.push(tally.measured(name, statement, class.name, |index| {
                        let (m, alpha) = class.start(seed, index);
                        format!("M = {m:?}, α = {alpha:?}")
                    }));
                }
            }
        }
        HopBounds { measured, compared: self.compared, undecided: self.undecided }
    }
}

/// The errors of one hop.
struct HopRatios {
    /// Γ and α − h of the table, as ratios.
    first_flight: Option<[f64; 2]>,
    /// By the place of each way in [`SOLVERS`].
    of_ways: Vec<(usize, HopErrors)>,
}

/// The errors of all ways that decide the hop, against `arithmetic` or a longer one. `None` if no arithmetic decides
/// the hop.
fn compare(map: &LiftOffMap, alpha: f64, arithmetic: Solver) -> Option<HopRatios> {
    // An error of the hop, such as its budget of sudden lift-offs, is an undecided hop as well.
    let reference = map.reference_hop(alpha, arithmetic).ok().flatten();
    let Some(reference) = reference else { return compare(map, alpha, arithmetic.longer()?) };
    let first_flight = reference.first_flight_errors();
    let first_flight = first_flight.map(|e| [e.closing_speed.ratio(), e.beyond.ratio()]);
    let mut found = HopRatios { first_flight, of_ways: Vec::new() };
    let mut largest = first_flight.map_or(0.0, |[a, b]| a.max(b));
    for (way, &solver) in SOLVERS.iter().enumerate().filter(|(_, solver)| **solver < arithmetic) {
        if let Ok(Some(errors)) = reference.errors_of(solver) {
            each_ratio(&errors, |_, ratio| largest = largest.max(ratio));
            found.of_ways.push((way, errors));
        }
    }
    let is_short = largest > LARGE_RATIO && arithmetic < Solver::Bits512;
    // Above 1 the longest arithmetic is asked as well.
    if is_short || largest > 1.0 {
        let again = arithmetic.longer().and_then(|longer| compare(map, alpha, longer));
        return again.or(Some(found));
    }
    Some(found)
}

/// Gives every quantity and its ratio actual error / bound to `see`.
///
/// After a wrong decision there is no error to compare: its ratio is infinite, and the other quantities are left out.
fn each_ratio(errors: &HopErrors, mut see: impl FnMut(usize, f64)) {
    if !errors.same_decisions {
        return see(DECISIONS, f64::INFINITY);
    }
    see(DECISIONS, 0.0);
    for landing in &errors.landings {
        let all = [landing.excess, landing.velocity, Some(landing.loss), landing.maximum_test];
        for (quantity, compared) in all.into_iter().enumerate() {
            if let Some(compared) = compared {
                see(quantity, compared.ratio());
            }
        }
    }
    see(4, errors.ratio.ratio());
    if let Some(next) = errors.next {
        see(5, next.ratio());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_result_does_not_depend_on_the_number_of_threads() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| measure(2000, 5, &Progress)).unwrap().measured
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn every_way_and_class_is_measured_and_no_decision_is_wrong() {
        let found = measure(4000, 1, &Progress).unwrap();
        assert_eq!(found.compared + found.undecided, 4000);
        assert!(found.undecided <= 4, "{}", found.undecided);
        for class in &CLASSES {
            let of = |m: &&Measured| m.class == class.name && m.bound == "general solver: α′²/α²";
            assert!(found.measured.iter().any(|m| of(&m)), "{}", class.name);
        }
        let decisions = found.measured.iter().filter(|m| m.bound.ends_with("decisions"));
        assert!(decisions.clone().count() > CLASSES.len());
        decisions.for_each(|m| assert_eq!(m.largest, 0.0, "{m:?}"));
    }
}
