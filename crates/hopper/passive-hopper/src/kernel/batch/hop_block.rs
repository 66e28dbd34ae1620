//! A block of hops, from their speeds to their next speeds.
//!
//! ```text
//!   find_positions   the positions of the speeds in the tables             vectors
//!   first_flights    Γ from the tables; the list of sudden landings        in groups of eight
//!   land_below_pi    the flights of the list: guess, two steps, landing    vectors
//!   land_from_pi     the same for V ≥ π                                    vectors
//!   add              sums; the list of the next flights                    one by one
//!       the last three steps are repeated until the list is empty
//!   end_hops         α′, and whether all decisions are conclusive          vectors
//! ```

use crate::kernel::batch::hop_rows::HopRows;
use crate::kernel::batch::later_flights::{FlightEnds, FlightList};
use crate::kernel::batch::rows::BLOCK;
use crate::kernel::batch::simd;
use crate::kernel::scalar::bounded_next::BoundedNext;
use crate::kernel::scalar::hop::MassFactors;
use crate::kernel::scalar::hop_from_interval::error_in_range;
use crate::landing::first_flight_table::{FirstFlightTable, TABLES, TablePosition, fixed_points};
use std::cell::Cell;

/// The loop over the first flights, with or without the errors of the speeds.
type FirstFlights = fn(&mut HopRows, &[&FirstFlightTable; TABLES], &mut FlightList, usize);

/// The arrays of a block.
pub(crate) struct HopBlock {
    hops: HopRows,
    /// The flights of this round and of the next round.
    lists: [FlightList; 2],
    ends: FlightEnds,
}

impl HopBlock {
    const EMPTY: HopBlock = HopBlock {
        hops: HopRows::EMPTY,
        lists: [const { FlightList::EMPTY }; 2],
        ends: FlightEnds::EMPTY,
    };

    /// Calls `work` with the arrays of this thread. A thread allocates them at the first call.
    ///
    /// The arrays are moved out of the thread's storage while `work` runs: a call inside `work` gets a second block.
    pub(crate) fn of_this_thread(work: impl FnOnce(&mut HopBlock)) {
        thread_local!(static KEPT: Cell<Option<Box<HopBlock>>> = const { Cell::new(None) });
        let mut block = KEPT.take().unwrap_or_else(|| Box::new(HopBlock::EMPTY));
        work(&mut block);
        KEPT.set(Some(block));
    }

    /// Computes the hops of `entries`, at most BLOCK of them.
    ///
    /// `from` gives the speed and mass factors of an entry; an invalid speed gives an undecided hop. `to` receives the
    /// next speed: positive, negative for a grounded hopper, or zero if the general solver must decide.
    #[inline]
    pub(crate) fn hop<H>(
        &mut self,
        entries: &mut [H],
        from: impl Fn(&H) -> (f64, MassFactors),
        mut to: impl FnMut(&mut H, f64),
    ) {
        let count = entries.len().min(BLOCK);
        for (at, entry) in entries.iter().take(count).enumerate() {
            let (alpha, MassFactors { mu, kappa }) = from(entry);
            (self.hops.alpha[at], self.hops.mu[at], self.hops.kappa[at]) = (alpha, mu, kappa);
        }
        self.flights(count, simd::first_flights);
        simd::end_hops(&mut self.hops, count);
        for (entry, &next) in entries.iter_mut().zip(&self.hops.next) {
            to(entry, next);
        }
    }

    /// As [`hop`](Self::hop), for all speeds within an error of a speed. `from` gives the speed, the error and the mass
    /// factors; an error that is too large gives [`BoundedNext::NONE`].
    #[inline]
    pub(crate) fn hop_within<H>(
        &mut self,
        entries: &mut [H],
        from: impl Fn(&H) -> (f64, f64, MassFactors),
        mut to: impl FnMut(&mut H, BoundedNext),
    ) {
        let (count, fixed_points) = (entries.len().min(BLOCK), fixed_points());
        for (at, entry) in entries.iter().take(count).enumerate() {
            let (alpha, error, MassFactors { mu, kappa }) = from(entry);
            // The speed 0 has no place in the tables.
            let in_range = error_in_range(alpha, error, fixed_points);
            self.hops.alpha[at] = if in_range { alpha } else { 0.0 };
            self.hops.start_error[at] = error;
            (self.hops.mu[at], self.hops.kappa[at]) = (mu, kappa);
        }
        self.flights(count, simd::first_flights_within);
        simd::end_hops_within(&mut self.hops, count);
        let found = self.hops.next.iter().zip(&self.hops.next_error);
        for (entry, (&speed, &error)) in entries.iter_mut().zip(found) {
            to(entry, BoundedNext { speed, error });
        }
    }

    /// All flights of the hops.
    fn flights(&mut self, count: usize, first: FirstFlights) {
        simd::find_positions(&mut self.hops, fixed_points(), count);
        self.first_flights(count, first);
        let mut current = 0;
        while !self.lists[current].is_empty() {
            self.later_flights(current);
            current = 1 - current;
        }
    }

    /// The first flights, and the list of the second flights.
    fn first_flights(&mut self, count: usize, first: FirstFlights) {
        let HopBlock { hops, lists: [list, _], .. } = self;
        // Builds the missing tables before the loop: the loop has no branch for a missing table.
        let mut tables = FirstFlightTable::all();
        let mut used = 0u64; // bit n: a speed lies in table n
        for (&interval, &piece) in hops.interval.iter().zip(&hops.piece).take(count) {
            used |= u64::from(piece != TablePosition::NOWHERE.piece) << (interval % TABLES as u64);
        }
        for (n, table) in tables.iter_mut().enumerate() {
            if used >> n & 1 == 1 {
                *table = FirstFlightTable::get(n as u64);
            }
        }
        list.clear();
        first(hops, &tables, list, count);
    }

    /// The flights of the list `current`; the flights after them go to the other list.
    fn later_flights(&mut self, current: usize) {
        let (first, second) = self.lists.split_at_mut(1);
        let (list, next) =
            if current == 0 { (&first[0], &mut second[0]) } else { (&second[0], &mut first[0]) };
        next.clear();
        simd::land_below_pi(list, &mut self.ends);
        self.hops.add(list, 0..list.below_pi, &self.ends, next);
        // The second call may overwrite ends of the first call, at most a vector of them (I6). These ends are already
        // added.
        simd::land_from_pi(list, &mut self.ends);
        self.hops.add(list, BLOCK - list.from_pi..BLOCK, &self.ends, next);
    }
}
