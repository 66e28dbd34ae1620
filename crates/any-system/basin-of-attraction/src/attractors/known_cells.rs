//! The cells of the attractors that are known, on grids of several sizes.

use crate::attractors::axis::whole;
use crate::attractors::state_grid::StateGrid;
use crate::attractors::state_map::{Moving, StateMap};
use crate::attractors::unmatched::Border;
use crate::space::label::{Label, attractor_of_label};
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};
use std::hint::select_unpredictable;

/// Finer grids than that of the caller. An attractor that comes within a cell or two of the boundary of its basin
/// is no trap at the scale of the first grid, and is one at the scale of a finer one. With four of them, up to 16
/// times as many cells, Hénon's attractor is found in most squares from 20 cells a side on, and in all that were tried from 26 on. Each costs the tests of a
/// candidate that is refused on all coarser ones.
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
    /// For each cell the label of its owner, or [`FREE`]; behind the last one [`Label::OUTSIDE`].
    Dense(Vec<Label>),
    Sparse(CellMap<Label>),
}

/// What an orbit is in a cell without an owner: undecided.
const FREE: Label = Label::UNDECIDED;

/// Grids of up to so many cells have a table of owners: 2 MB, which is looked up in a third of the time of a hash.
const MOST_DENSE: u64 = 1 << 20;

impl Owners {
    fn of(grid: &StateGrid) -> Owners {
        match grid.count() {
            count if count <= MOST_DENSE => {
                let mut all = vec![FREE; count as usize];
                all.push(Label::OUTSIDE);
                Owners::Dense(all)
            }
            _ => Owners::Sparse(HashMap::default()),
        }
    }

    #[inline]
    fn of_cell(&self, cell: u64) -> Label {
        match self {
            Owners::Dense(all) => all[cell as usize],
            Owners::Sparse(some) => some.get(&cell).copied().unwrap_or(FREE),
        }
    }

    fn add(&mut self, cell: u64, owner: Label) {
        match self {
            Owners::Dense(all) => all[cell as usize] = owner,
            Owners::Sparse(some) => {
                some.insert(cell, owner);
            }
        }
    }

    fn renumber(&mut self, labels: &[Label]) {
        let new = |own: &mut Label| {
            if let Some(index) = attractor_of_label(*own) {
                *own = labels[index];
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

/// The same, each with something of its own.
pub(crate) type CellMap<V> = HashMap<u64, V, ByCell>;

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

    /// Whether a coordinate of the states has no cells.
    pub(crate) fn has_hidden(&self) -> bool {
        self.grids[0].has_hidden()
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
        let label = self.label_by(|coordinate| point[coordinate]);
        match attractor_of_label(label) {
            Some(owner) => Place::Owned(owner),
            None if label == FREE => Place::Inside,
            None => Place::Outside,
        }
    }

    /// What an orbit is at a state with these coordinates: the label of the attractor that owns its cell, undecided, or outside the region.
    #[inline(always)]
    fn label_by(&self, at: impl Fn(usize) -> f64) -> Label {
        let mut owned = self.owned.iter();
        let first = owned.next().copied();
        // All grids have the same region.
        let Some(cell) = self.grids[first.unwrap_or(0)].cell_by(&at) else {
            return Label::OUTSIDE;
        };
        let mut label = first.map_or(FREE, |number| self.owners[number].of_cell(cell));
        for &number in owned {
            if label == FREE
                && let Some(cell) = self.grids[number].cell_by(&at)
            {
                label = self.owners[number].of_cell(cell);
            }
        }
        label
    }

    /// The same at many states, by columns. `cells` is memory.
    pub(crate) fn labels_of_columns(
        &self,
        columns: &[Vec<f64>],
        cells: &mut Vec<f64>,
        labels: &mut Vec<Label>,
    ) {
        labels.clear();
        labels.resize(columns.first().map_or(0, Vec::len), FREE);
        let is_dense = |number: &usize| matches!(self.owners[*number], Owners::Dense(_));
        if self.owned.is_empty() || !self.owned.iter().all(is_dense) {
            for (lane, label) in labels.iter_mut().enumerate() {
                *label = self.label_by(|coordinate| columns[coordinate][lane]);
            }
            return;
        }
        for &number in &self.owned {
            let Owners::Dense(all) = &self.owners[number] else { continue };
            let grid = &self.grids[number];
            let outside = grid.count() as f64;
            grid.cells_of_columns(columns, cells);
            for (label, &cell) in labels.iter_mut().zip(&*cells) {
                let cell = whole(if cell.is_nan() { outside } else { cell });
                *label = select_unpredictable(*label == FREE, all[cell], *label);
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

    /// The attractors in one of whose cells a point lies: cells of two grids may overlap.
    fn owners_at(&self, point: &[f64]) -> impl Iterator<Item = usize> {
        let owner = |number: &usize| {
            attractor_of_label(self.owners[*number].of_cell(self.grids[*number].cell(point)?))
        };
        self.owned.iter().filter_map(owner)
    }

    /// One of them other than this one.
    pub(crate) fn other_owner(&self, point: &[f64], own: usize) -> Option<usize> {
        self.owners_at(point).find(|other| *other != own)
    }

    /// Whether a point lies in one of the cells of an attractor.
    pub(crate) fn is_in_cells_of(&self, own: usize, point: &[f64]) -> bool {
        self.owners_at(point).any(|owner| owner == own)
    }

    /// The cells of one grid belong to an attractor.
    pub(crate) fn add(&mut self, grid: usize, cells: impl Iterator<Item = u64>, label: Label) {
        if !self.owned.contains(&grid) {
            self.owners[grid] = Owners::of(&self.grids[grid]);
            self.owned.push(grid);
            self.owned.sort_unstable();
        }
        cells.for_each(|cell| self.owners[grid].add(cell, label));
    }

    /// Each attractor gets a new label.
    pub(crate) fn renumber(&mut self, labels: &[Label]) {
        self.owners.iter_mut().for_each(|owners| owners.renumber(labels));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::hyperrectangle::Hyperrectangle;
    use crate::space::interval::Interval;
    use crate::space::label::label_of_attractor;
    use crate::statistics::split_mix::SplitMix64;

    /// Many states have the labels of single ones: no owner, on one grid, on two, on grids with too many cells for a table, with given edges; on all borders and
    /// where there is no number.
    #[test]
    fn columns_have_the_labels_of_single_states() {
        let square = Hyperrectangle::new(vec![Interval { left: -1.0, right: 2.0 }; 2]).unwrap();
        let given = vec![vec![-1.0, -0.5, 0.1, 2.0], vec![-1.0, 0.0, 0.5, 1.9, 2.0]];
        let grids = [
            StateGrid::new(square.clone(), &[10, 7]).unwrap(),
            StateGrid::uniform(square.clone(), 500).unwrap(),
            StateGrid::uniform(square, 1200).unwrap(),
            StateGrid::from_edges(given).unwrap(),
        ];
        let random = SplitMix64::from_seed(7);
        let anywhere = |k: u64| 4.0 * random.uniform(k) - 1.5;
        let mut states: Vec<[f64; 2]> =
            (0..1000).map(|k| [anywhere(2 * k), anywhere(2 * k + 1)]).collect();
        let ends = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 2.0, 2.0f64.next_up()];
        let borders = (0..=10).map(|k| -1.0 + 0.3 * f64::from(k));
        let special: Vec<f64> =
            borders.chain(ends).chain([-1.0f64.next_down(), 0.0, 0.5]).collect();
        states.extend(special.iter().flat_map(|x| special.iter().map(|y| [*x, *y])));
        let columns = [0, 1].map(|axis| states.iter().map(|at| at[axis]).collect::<Vec<f64>>());
        for grid in grids {
            let mut known = KnownCells::new(grid);
            // Owners on no grid, on the first one, and on the third one as well.
            for owners in 0..3 {
                let (mut cells, mut labels) = (Vec::new(), Vec::new());
                known.labels_of_columns(&columns, &mut cells, &mut labels);
                for (state, label) in states.iter().zip(labels) {
                    let place = match known.place(state) {
                        Place::Owned(own) => label_of_attractor(own + 1).unwrap(),
                        Place::Inside => Label::UNDECIDED,
                        Place::Outside => Label::OUTSIDE,
                    };
                    assert_eq!(label, place, "{owners} {state:?}");
                }
                if owners < 2 {
                    let (label, of) = (label_of_attractor(owners + 1).unwrap(), 2 * owners);
                    let count = known.grids()[of].count();
                    known.add(of, (0..count).step_by(3 + count as usize / 3000), label);
                }
            }
        }
    }
}
