//! A queue of tiles and many workers, some of them slow, some of them lost.

use basin_of_attraction::SplitMix64;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

/// Seconds from a worker's start to its first tile: a process, its libraries and its connection. An assumption.
pub(crate) const START_UP: f64 = 10.0;
/// One try of a tile in this number is lost with its worker, at a random instant of the try. An assumption, worse
/// than most clusters.
pub(crate) const LOST_ONE_IN: u64 = 100;
/// One try in this number is on a slow worker. An assumption.
pub(crate) const SLOW_ONE_IN: u64 = 100;
/// A slow worker takes this many times as long. An assumption.
pub(crate) const SLOWER: f64 = 10.0;

/// Seed of the simulation: any number; with another one the losses fall elsewhere.
const SEED: u64 = 2026;

/// The end of a simulated job.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Finished {
    /// Seconds until the last tile is finished.
    pub(crate) seconds: f64,
    /// Tries that were lost.
    pub(crate) lost: usize,
    /// The work of the tiles over the time of all workers.
    pub(crate) efficiency: f64,
}

/// What happens to a worker.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Event {
    Started,
    Finished,
    /// The worker is lost with its tile. Another worker starts in its place.
    Lost(usize),
}

/// Gives the tiles in their order to the workers, each the next one as soon as it is free. A lost tile goes to the
/// end of the queue.
pub(crate) fn simulate(tiles: &[f64], workers: usize) -> Finished {
    let random = SplitMix64::from_seed(SEED);
    let mut numbers = 0..;
    let mut one_in = |n: u64| random.bits(numbers.next().unwrap_or(0)).is_multiple_of(n);
    let mut queue: VecDeque<usize> = (0..tiles.len()).collect();
    // Whole nanoseconds have an order, and 2⁶⁴ of them are 584 years.
    let nanoseconds = |seconds: f64| (seconds * 1e9) as u64;
    let start_up = nanoseconds(START_UP);
    let mut events: BinaryHeap<_> =
        (0..workers).map(|_| Reverse((start_up, Event::Started))).collect();
    let (mut idle, mut lost, mut end, mut tries) = (0usize, 0, 0, 0u64);
    // Instants of losses have numbers of their own.
    let instants = SplitMix64::from_seed(SEED + 1);
    while let Some(Reverse((time, event))) = events.pop() {
        match event {
            Event::Started => idle += 1,
            Event::Finished => (idle, end) = (idle + 1, time),
            Event::Lost(tile) => {
                lost += 1;
                queue.push_back(tile);
                events.push(Reverse((time + start_up, Event::Started)));
            }
        }
        while idle > 0
            && let Some(tile) = queue.pop_front()
        {
            idle -= 1;
            tries += 1;
            let slower = if one_in(SLOW_ONE_IN) { SLOWER } else { 1.0 };
            let seconds = slower * tiles[tile];
            let next = match one_in(LOST_ONE_IN) {
                true => (time + nanoseconds(seconds * instants.uniform(tries)), Event::Lost(tile)),
                false => (time + nanoseconds(seconds), Event::Finished),
            };
            events.push(Reverse(next));
        }
    }
    let seconds = end as f64 * 1e-9;
    let efficiency = tiles.iter().sum::<f64>() / (workers as f64 * seconds);
    Finished { seconds, lost, efficiency }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_worker_takes_at_least_all_the_work() {
        let tiles = vec![1.0; 1000];
        let one = simulate(&tiles, 1);
        assert!(one.seconds >= START_UP + 1000.0 && one.lost > 0, "{one:?}");
        assert_eq!(one, simulate(&tiles, 1));
        // More workers take less time, down to one tile, and never finish without the work.
        let many = simulate(&tiles, 100);
        assert!(many.seconds < one.seconds / 20.0 && many.efficiency < one.efficiency, "{many:?}");
    }

    #[test]
    fn more_workers_than_tiles_gain_nothing() {
        let tiles = vec![5.0; 20];
        assert_eq!(simulate(&tiles, 20).seconds, simulate(&tiles, 200).seconds);
    }
}
