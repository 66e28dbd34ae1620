//! A block of hops, from their speeds to their next speeds.
//!
//! ```text
//!   find_positions      where the speeds lie in the tables                    vectors
//!   first_flights    Γ from the tables; the list of sudden landings        in groups of eight
//!   land_below_pi    the flights of the list: guess, two steps, landing    vectors
//!   land_from_pi     the same for V ≥ π                                    vectors
//!   add              sums; the list of the flights that follow             one by one
//!       ... the last three again until the list is empty
//!   end_hops         α′ and whether its verdicts are decided               vectors
//! ```

use crate::kernel::batch::hop_rows::HopRows;
use crate::kernel::batch::later_flights::{FlightEnds, FlightList};
use crate::kernel::batch::rows::BLOCK;
use crate::kernel::batch::simd;
use crate::kernel::scalar::hop::MassFactors;
use crate::landing::first_flight_table::{FirstFlightTable, TABLES, TablePosition, fixed_points};
use std::cell::Cell;

/// The arrays of a block.
pub(crate) struct HopBlock {
    hops: HopRows,
    /// The flights of this round and those of the next.
    lists: [FlightList; 2],
    ends: FlightEnds,
}

impl HopBlock {
    const EMPTY: HopBlock = HopBlock {
        hops: HopRows::EMPTY,
        lists: [const { FlightList::EMPTY }; 2],
        ends: FlightEnds::EMPTY,
    };

    /// Calls `work` with the arrays of this thread. A thread allocates them once, when it first needs them.
    ///
    /// They are taken out while `work` runs: if `work` asks for a block itself, it gets a second one.
    pub(crate) fn of_this_thread(work: impl FnOnce(&mut HopBlock)) {
        thread_local!(static KEPT: Cell<Option<Box<HopBlock>>> = const { Cell::new(None) });
        let mut block = KEPT.take().unwrap_or_else(|| Box::new(HopBlock::EMPTY));
        work(&mut block);
        KEPT.set(Some(block));
    }

    /// Computes the hops of `entries`, at most BLOCK of them.
    ///
    /// `from` gives the speed and mass factors of an entry; a speed that is no valid one gives an undecided hop. `to`
    /// gets the next speed: positive, negative for a grounded hopper, zero where the careful path must decide.
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
        simd::find_positions(&mut self.hops, fixed_points(), count);
        self.first_flights(count);
        let mut current = 0;
        while !self.lists[current].is_empty() {
            self.later_flights(current);
            current = 1 - current;
        }
        simd::end_hops(&mut self.hops, count);
        for (entry, &next) in entries.iter_mut().zip(&self.hops.next) {
            to(entry, next);
        }
    }

    /// The first flights, and the list of the flights that follow.
    fn first_flights(&mut self, count: usize) {
        let HopBlock { hops, lists: [list, _], .. } = self;
        // Builds the tables that are needed, before the loop: it has no branch for a missing table.
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
        simd::first_flights(hops, &tables, list, count);
    }

    /// The flights of the list `current`; those that follow go to the other list.
    fn later_flights(&mut self, current: usize) {
        let (first, second) = self.lists.split_at_mut(1);
        let (list, next) =
            if current == 0 { (&first[0], &mut second[0]) } else { (&second[0], &mut first[0]) };
        next.clear();
        simd::land_below_pi(list, &mut self.ends);
        self.hops.add(list, 0..list.below_pi, &self.ends, next);
        // The second call may overwrite ends of the first one, at most a vector of them (I6): they are added by now.
        simd::land_from_pi(list, &mut self.ends);
        self.hops.add(list, BLOCK - list.from_pi..BLOCK, &self.ends, next);
    }
}
