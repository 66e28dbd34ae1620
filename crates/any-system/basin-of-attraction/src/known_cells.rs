//! The cells of the attractors that are known, on grids of several sizes.

use crate::state_grid::StateGrid;
use crate::unmatched::Border;
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
    owners: Vec<HashMap<u64, usize, ByCell>>,
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
        let owners = vec![HashMap::default(); grids.len()];
        KnownCells { grids, owners }
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

    /// Moves a state into the periods of its coordinates.
    pub(crate) fn wrap(&self, state: &mut [f64]) {
        self.grids[0].wrap(state);
    }

    /// Where a point is farthest outside the region; `None` inside.
    pub(crate) fn beyond(&self, point: &[f64]) -> Option<Border> {
        self.grids[0].beyond(point)
    }

    /// The attractor in one of whose cells a point lies.
    pub(crate) fn owner(&self, point: &[f64]) -> Option<usize> {
        self.owners_of(point).next()
    }

    /// The same for another attractor than this one: cells of two grids may overlap.
    pub(crate) fn other_owner(&self, point: &[f64], own: usize) -> Option<usize> {
        self.owners_of(point).find(|other| *other != own)
    }

    fn owners_of(&self, point: &[f64]) -> impl Iterator<Item = usize> {
        let known = self.owners.iter().zip(&self.grids).filter(|(owners, _)| !owners.is_empty());
        known.filter_map(move |(owners, grid)| owners.get(&grid.cell(point)?).copied())
    }

    /// The cells of one grid belong to an attractor.
    pub(crate) fn add(&mut self, grid: usize, cells: impl Iterator<Item = u64>, attractor: usize) {
        self.owners[grid].extend(cells.map(|cell| (cell, attractor)));
    }

    /// Each attractor gets a new index.
    pub(crate) fn renumber(&mut self, index: &[usize]) {
        self.owners.iter_mut().flat_map(HashMap::values_mut).for_each(|own| *own = index[*own]);
    }
}
