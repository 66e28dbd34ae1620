//! What one image of a cell shows.

use crate::basins::ProvedFate;
use crate::cells::Place;
use crate::enclosed_map::{EnclosedMap, StartSet};
use crate::oriented_box::OrientedBox;
use crate::trap::Trap;
use crate::undecided::{Error, Reason};
use interval_arithmetic::Enclosure;

/// What is known of a cell.
#[derive(Debug, Clone)]
pub(crate) enum Known {
    Fate(ProvedFate),
    /// Its image, if it has one.
    Open(Option<OrientedBox>),
}

/// A cell without a fate.
pub(crate) struct OpenCell {
    pub(crate) place: Place,
    pub(crate) window: usize,
    pub(crate) halvings: u32,
    pub(crate) points: Vec<Enclosure>,
}

/// What the images of cells show, in their order, whatever the number of threads.
pub(crate) fn images<M: EnclosedMap + Sync>(
    maps: &[&M],
    traps: &[Trap],
    cells: &[OpenCell],
) -> Vec<Result<Known, Error>> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let share = cells.len().div_ceil(threads).max(1);
    let of_cell = |cell: &OpenCell| {
        let next = (cell.window + 1) % maps.len();
        known((maps[cell.window], maps[next]), (next == 0, traps), cell)
    };
    std::thread::scope(|scope| {
        let parts: Vec<_> = cells
            .chunks(share)
            .map(|part| scope.spawn(move || part.iter().map(of_cell).collect::<Vec<_>>()))
            .collect();
        parts
            .into_iter()
            // A panic of a user's function goes on in the caller: without its part the others would be given to wrong cells.
            .flat_map(|part| part.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    })
}

/// What one image shows of a cell.
fn known<M: EnclosedMap>(
    (map, next): (&M, &M),
    (leads_to_first, traps): (bool, &[Trap]),
    cell: &OpenCell,
) -> Result<Known, Error> {
    let trapped = traps.iter().position(|trap| cell.window == 0 && trap.contains(&cell.points));
    if let Some(trap) = trapped {
        return Ok(Known::Fate(ProvedFate::Trap(trap)));
    }
    match map.carry(StartSet::of_box(&cell.points).without_derivatives()) {
        Ok(carried) => {
            if map.leads_into(&carried, next).is_err() {
                return Ok(Known::Open(None));
            }
            let in_trap = |trap: &Trap| leads_to_first && trap.contains_set(&carried.set);
            Ok(match traps.iter().position(in_trap) {
                Some(trap) => Known::Fate(ProvedFate::Trap(trap)),
                None => Known::Open(Some(OrientedBox::of_set(&carried.set))),
            })
        }
        Err(Error::Undecided(undecided)) => Ok(match undecided.reason {
            Reason::Stopped { surface } => Known::Fate(ProvedFate::Stopped(surface)),
            _ => Known::Open(None),
        }),
        Err(error) => Err(error),
    }
}
