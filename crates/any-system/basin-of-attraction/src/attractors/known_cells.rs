//! The cells of the attractors that are known, on grids of several sizes.

use crate::attractors::state_grid::StateGrid;
use crate::attractors::state_map::{Moving, StateMap};
use crate::attractors::unmatched::Border;
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

/// Finer grids than that of the caller. An attractor that comes within a cell or two of the boundary of its basin
/// is no trap at the scale of the first grid, and is one at the scale of a finer one. With four of them, up to 16
/// times as many cells, Hénon's attractor is found from 20 cells a side on. Each costs the tests of a candidate
/// that is refused on all coarser ones.
const FINER: u32 = 4;

/// Grids of n, 2n + 1, 4n + 3, … cells a side, and for each the attractors that own cells.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KnownCells {
    grids: Vec<StateGrid>,
    /// For each grid, the index of the attractor that owns a cell.
    owners: Vec<Owners>,
    /// The grids with owners.
    owned: Vec<usize>,
    is_periodic: bool,
}

/// Where a state is.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Place {
    /// In a cell of the attractor with this index.
    Owned(usize),
    Inside,
    Outside,
}

/// The attractors that own cells of a grid, by the numbers of the cells.
#[derive(Debug, Clone, PartialEq)]
enum Owners {
    /// For each cell its owner, or [`NO_OWNER`].
    Dense(Vec<u16>),
    Sparse(HashMap<u64, u16, ByCell>),
}

/// No attractor has this index: there are at most 65 000.
const NO_OWNER: u16 = u16::MAX;

/// Grids of up to so many cells have a table of owners: 2 MB, which is looked up in a third of the time of a hash.
const MOST_DENSE: u64 = 1 << 20;

impl Owners {
    fn of(grid: &StateGrid) -> Owners {
        match grid.count() {
            count if count <= MOST_DENSE => Owners::Dense(vec![NO_OWNER; count as usize]),
            _ => Owners::Sparse(HashMap::default()),
        }
    }

    #[inline]
    fn of_cell(&self, cell: u64) -> Option<usize> {
        let owner = match self {
            Owners::Dense(all) => all[cell as usize],
            Owners::Sparse(some) => some.get(&cell).copied().unwrap_or(NO_OWNER),
        };
        (owner != NO_OWNER).then_some(usize::from(owner))
    }

    fn add(&mut self, cell: u64, owner: u16) {
        match self {
            Owners::Dense(all) => all[cell as usize] = owner,
            Owners::Sparse(some) => {
                some.insert(cell, owner);
            }
        }
    }

    fn renumber(&mut self, index: &[usize]) {
        let new = |own: &mut u16| {
            if *own != NO_OWNER {
                *own = index[usize::from(*own)] as u16;
            }
        };
        match self {
            Owners::Dense(all) => all.iter_mut().for_each(new),
            Owners::Sparse(some) => some.values_mut().for_each(new),
        }
    }
}

/// Cells that are looked up once a step. They have no order.
pub(crate) type CellSet = HashSet<u64, ByCell>;

type ByCell = BuildHasherDefault<CellHasher>;

/// The number of a cell, spread over all bits by one multiplication: a step of a map takes as long as a few of them. Users give cells by
/// their own maps, so that a hash against forged numbers is not needed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CellHasher(u64);

impl Hasher for CellHasher {
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.write_u64(u64::from(*byte)));
    }

    fn write_u64(&mut self, cell: u64) {
        /// 2⁶⁴ over the golden ratio, odd: D. E. Knuth, The Art of Computer Programming 3, Section 6.4.
        const SPREAD: u64 = 0x9E37_79B9_7F4A_7C15;
        let spread = (self.0 ^ cell).wrapping_mul(SPREAD);
        self.0 = spread ^ (spread >> 32);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

impl KnownCells {
    /// No attractor is known. Finer grids whose cells could not be numbered are left out.
    pub(crate) fn new(first: StateGrid) -> Self {
        let finer = (1..=FINER).map_while(|k| first.finer(k)).collect::<Vec<_>>();
        let grids: Vec<StateGrid> = std::iter::once(first).chain(finer).collect();
        let owners = vec![Owners::Sparse(HashMap::default()); grids.len()];
        let is_periodic = grids[0].is_periodic();
        KnownCells { grids, owners, owned: Vec::new(), is_periodic }
    }

    /// All grids, the coarsest first.
    pub(crate) fn grids(&self) -> &[StateGrid] {
        &self.grids
    }

    pub(crate) fn dimension(&self) -> usize {
        self.grids[0].dimension()
    }

    /// The cell of the coarsest grid that contains a point.
    pub(crate) fn cell(&self, point: &[f64]) -> Option<u64> {
        self.grids[0].cell(point)
    }

    /// Whether a coordinate is periodic.
    pub(crate) fn is_periodic(&self) -> bool {
        self.is_periodic
    }

    /// Moves a state into the periods of its coordinates.
    #[inline]
    pub(crate) fn wrap(&self, state: &mut [f64]) {
        if self.is_periodic {
            self.grids[0].wrap(state);
        }
    }

    /// Moves a state to its image, and into the periods of its coordinates; `false` if it has none.
    #[inline]
    pub(crate) fn step(&self, map: &dyn StateMap, point: &mut Moving) -> bool {
        let has_image = point.step(map);
        self.wrap(&mut point.at);
        has_image
    }

    /// Where a point is farthest outside the region; `None` inside.
    pub(crate) fn beyond(&self, point: &[f64]) -> Option<Border> {
        self.grids[0].beyond(point)
    }

    /// Where a state is.
    #[inline]
    pub(crate) fn place(&self, point: &[f64]) -> Place {
        // All grids have the same region.
        if !self.grids[0].contains(point) {
            return Place::Outside;
        }
        for &number in &self.owned {
            let cell = self.grids[number].cell_inside(point);
            if let Some(owner) = self.owners[number].of_cell(cell) {
                return Place::Owned(owner);
            }
        }
        Place::Inside
    }

    /// The same of many states, by columns. `cells` is memory.
    pub(crate) fn places(
        &self,
        columns: &[Vec<f64>],
        cells: &mut Vec<u64>,
        places: &mut Vec<Place>,
    ) {
        let owned = self.owned.first().copied();
        self.grids[owned.unwrap_or(0)].cells_of_columns(columns, cells);
        places.clear();
        places.extend(cells.iter().map(|&cell| {
            if cell == StateGrid::OUTSIDE {
                return Place::Outside;
            }
            let owner = owned.and_then(|number| self.owners[number].of_cell(cell));
            owner.map_or(Place::Inside, Place::Owned)
        }));
        for &number in self.owned.iter().skip(1) {
            self.grids[number].cells_of_columns(columns, cells);
            for (place, &cell) in places.iter_mut().zip(&*cells) {
                // A state outside has no cell.
                if matches!(place, Place::Inside)
                    && let Some(owner) = self.owners[number].of_cell(cell)
                {
                    *place = Place::Owned(owner);
                }
            }
        }
    }

    /// Moves many states into the periods of their coordinates.
    pub(crate) fn wrap_columns(&self, columns: &mut [Vec<f64>]) {
        if self.is_periodic {
            self.grids[0].wrap_columns(columns);
        }
    }

    /// Whether a state in the region is finite and not beyond this distance of escape, so that this needs no test.
    pub(crate) fn is_within(&self, escape: Option<f64>) -> bool {
        let largest = self.grids[0].largest();
        escape.map_or(largest.is_finite(), |escape| largest <= escape)
    }

    /// The attractor, other than this one, in one of whose cells a point lies: cells of two grids may overlap.
    pub(crate) fn other_owner(&self, point: &[f64], own: usize) -> Option<usize> {
        let owner = |number: &usize| self.owners[*number].of_cell(self.grids[*number].cell(point)?);
        self.owned.iter().filter_map(owner).find(|other| *other != own)
    }

    /// The cells of one grid belong to an attractor.
    pub(crate) fn add(&mut self, grid: usize, cells: impl Iterator<Item = u64>, attractor: usize) {
        if !self.owned.contains(&grid) {
            self.owners[grid] = Owners::of(&self.grids[grid]);
            self.owned.push(grid);
            self.owned.sort_unstable();
        }
        cells.for_each(|cell| self.owners[grid].add(cell, attractor as u16));
    }

    /// Each attractor gets a new index.
    pub(crate) fn renumber(&mut self, index: &[usize]) {
        self.owners.iter_mut().for_each(|owners| owners.renumber(index));
    }
}
