//! The cells of the attractors that are known, on grids of several sizes.

use crate::error::Error;
use crate::hyperrectangle::Hyperrectangle;
use crate::state_grid::StateGrid;
use crate::unmatched::Border;
use std::collections::BTreeMap;

/// Finer grids than that of the caller. An attractor that comes within a cell or two of the boundary of its basin
/// is no trap at the scale of the first grid, and is one at the scale of a finer one. With four of them, up to 16
/// times as many cells, Hénon's attractor is found from 20 cells a side on. Each costs the tests of a candidate
/// that is refused on all coarser ones.
const FINER: u32 = 4;

/// Grids of n, 2n + 1, 4n + 3, … cells a side, and for each the attractors that own cells.
///
/// The odd numbers matter: cells of n and of 2n share their corners, and a fixed point on a corner belongs to one
/// of four cells, which orbits in the others never enter.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KnownCells {
    grids: Vec<StateGrid>,
    /// For each grid, the index of the attractor that owns a cell.
    owners: Vec<BTreeMap<u64, usize>>,
}

impl KnownCells {
    /// No attractor is known. Finer grids whose cells could not be numbered are left out.
    ///
    /// # Errors
    /// [`Error::BadStateGrid`] for the first grid.
    pub(crate) fn new(region: &Hyperrectangle, cells: usize) -> Result<Self, Error> {
        let first = StateGrid::new(region.clone(), cells)?;
        let finer = (1..=FINER).map_while(|k| {
            let cells = cells.checked_mul(1 << k)?.checked_add((1 << k) - 1)?;
            StateGrid::new(region.clone(), cells).ok()
        });
        let grids: Vec<StateGrid> = std::iter::once(first).chain(finer).collect();
        let owners = vec![BTreeMap::new(); grids.len()];
        Ok(KnownCells { grids, owners })
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
        self.owners.iter_mut().flat_map(BTreeMap::values_mut).for_each(|own| *own = index[*own]);
    }
}
