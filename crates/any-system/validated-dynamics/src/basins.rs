//! Basins that are proved cell by cell.

use crate::cell_images::{Known, OpenCell, images};
use crate::cells::{Cells, Place, part_of};
use crate::enclosed_map::EnclosedMap;
use crate::trap::Trap;
use crate::undecided::Error;
use crate::windows::{Division, share_of};
use hybrid_system::Label;
use interval_arithmetic::Enclosure;
use std::collections::{BTreeMap, HashMap};
use std::ops::ControlFlow;

/// The images that are computed between two calls with progress: seconds of work, of which each thread has a part.
const AT_ONCE: usize = 4096;

/// The fate of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ProvedFate {
    /// All points converge to the fixed point of this trap, by its place in the list.
    Trap(usize),
    /// An event at this surface ends the execution of all points, or they come to this [set](crate::FormulaMap::with_set) of a map of formulas.
    Stopped(Label),
}

/// What the image of an open cell meets.
enum Meets {
    /// Cells of one fate alone.
    Fate(ProvedFate),
    /// Nothing that has a fate: to divide it is of no use yet. Here is an open cell that it meets.
    Open(Place),
    /// Cells with a fate, and others, of which here is one that is open.
    Edge(Option<Place>),
    /// Nothing in the window: no part of the cell ever gets a fate.
    Outside,
}

/// How far a proof of basins has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The images that were computed.
    pub images: usize,
    /// The cells that are open.
    pub open: usize,
    /// The halvings of the sides of the window in the cells whose images are computed now.
    pub halvings: u32,
    /// A lower bound of the share of the first window that has a fate.
    pub proved: f64,
}

/// Basins of the points of windows, proved cell by cell.
///
/// A cell has a fate if it is in a trap, or if its map leads all its points into cells of this fate. So one image of each cell decides, and
/// no orbit is followed. Of open cells the largest are divided first, of those whose images meet cells with a fate; where there are none, of all.
pub struct ProvedBasins {
    traps: Vec<Trap>,
    cells: Cells<Known>,
    /// The images that were computed.
    pub images: usize,
    /// The open cells.
    open: HashMap<Place, OpenCell>,
    /// The open cells that wait for another one, which their images meet.
    waiting: HashMap<Place, Vec<Place>>,
    /// The open cells whose division may show more, by their halvings.
    edge: BTreeMap<u32, Vec<Place>>,
    area: f64,
    /// The cells with a fate, each one behind those in which its image is.
    decided: Vec<ProvedCell>,
}

/// A cell with a fate.
#[derive(Debug, Clone)]
pub struct ProvedCell {
    /// The number of its window.
    pub window: usize,
    /// The box.
    pub points: Vec<Enclosure>,
    /// The fate of all its points.
    pub fate: ProvedFate,
}

impl ProvedBasins {
    /// The basins of these traps in a window.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// use validated_dynamics::{Division, Enclosure, FormulaMap, ProvedBasins, ProvedFate, Trap, fixed_point};
    /// // 0 attracts |x| < 1.
    /// let names = Names::new(&["x"], &[])?;
    /// let cube = FormulaMap::new(Formulas::from_text(names, &["x^3"])?, 1)?;
    /// let trap = Trap::new(&cube, &fixed_point(&cube, &[0.1], &[])?, 1000)?;
    /// let division = Division { first: 4, last: 10, images: 10_000 };
    /// let window = [Enclosure::between(-2.0, 2.0)?];
    /// let basins = ProvedBasins::new(&[&cube], vec![trap], &[&window], division)?;
    /// assert_eq!(basins.fate(0, &[0.9]), Some(ProvedFate::Trap(0)));
    /// assert_eq!(basins.fate(0, &[1.1]), None);
    /// assert!(basins.share(ProvedFate::Trap(0)) > 0.49);
    /// # Ok::<(), validated_dynamics::Error>(())
    /// ```
    ///
    /// Of several maps the first leads from the first window to the second one, and so on, and the last one back to the first: such as
    /// the maps over parts of a period. Traps are in the first window, and those of all maps together. The images of parts are less
    /// stretched, so that larger cells are decided.
    ///
    /// # Errors
    /// [`Error::Argument`] for another number of windows than maps, for a window of another dimension than its map or without area, and for a
    /// division whose first cells are not larger than the last ones; an error of formulas. Cells that are not decided are open, and no error.
    pub fn new<M: EnclosedMap + Sync>(
        maps: &[&M],
        traps: Vec<Trap>,
        windows: &[&[Enclosure]],
        division: Division,
    ) -> Result<ProvedBasins, Error> {
        ProvedBasins::watched(maps, traps, windows, division, &mut |_| ControlFlow::Continue(()))
    }

    /// The same with progress every few thousand images, and an end by [`ControlFlow::Break`]: what is proved until then is kept.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn watched<M: EnclosedMap + Sync>(
        maps: &[&M],
        traps: Vec<Trap>,
        windows: &[&[Enclosure]],
        division: Division,
        watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<ProvedBasins, Error> {
        division.check(maps, windows)?;
        let windows: Vec<Vec<Enclosure>> = windows.iter().map(|window| window.to_vec()).collect();
        let mut basins = ProvedBasins {
            traps,
            cells: Cells::new(windows.clone(), &Known::Open(None)),
            images: 0,
            open: HashMap::new(),
            waiting: HashMap::new(),
            edge: BTreeMap::new(),
            area: 0.0,
            decided: Vec::new(),
        };
        let mut fresh: Vec<OpenCell> = Vec::new();
        for (window, points) in windows.into_iter().enumerate() {
            fresh.push(OpenCell { place: window, window, halvings: 0, points });
        }
        for _ in 0..division.first {
            fresh = fresh.into_iter().flat_map(|cell| basins.divided(&cell)).collect();
        }
        let mut freed: Vec<Place> = Vec::new();
        loop {
            fresh.truncate(division.images.saturating_sub(basins.images));
            let halvings = fresh.first().map_or(division.last, |cell| cell.halvings);
            let mut looked: Vec<Place> = Vec::with_capacity(fresh.len() + freed.len());
            let mut left = fresh.into_iter();
            while left.len() > 0 {
                looked.extend(basins.take(maps, left.by_ref().take(AT_ONCE).collect())?);
                if left.len() > 0 && watch(basins.progress(halvings)).is_break() {
                    return Ok(basins);
                }
            }
            // Not before all images are there: a cell waits for one that it meets, and this should be one that stays open.
            looked.into_iter().chain(freed).for_each(|place| basins.look(place));
            if watch(basins.progress(halvings)).is_break() {
                return Ok(basins);
            }
            let next = basins.next_edge(division.last);
            let Some(places) = next.filter(|_| basins.images < division.images) else {
                return Ok(basins);
            };
            (fresh, freed) = (Vec::new(), Vec::new());
            for place in places {
                if let Some(open) = basins.open.remove(&place) {
                    fresh.extend(basins.divided(&open));
                    freed.extend(basins.waiting.remove(&place).unwrap_or_default());
                }
            }
        }
    }

    fn progress(&self, halvings: u32) -> Progress {
        let (images, open) = (self.images, self.open.len());
        Progress { images, open, halvings, proved: self.area }
    }

    /// The parts of a cell.
    fn divided(&mut self, cell: &OpenCell) -> Vec<OpenCell> {
        let places = self.cells.divide(cell.place, &Known::Open(None));
        let part = |(part, place)| OpenCell {
            place,
            window: cell.window,
            halvings: cell.halvings + 1,
            points: part_of(&cell.points, part),
        };
        places.enumerate().map(part).collect()
    }

    /// Finds the images of new cells, on all threads, and the fates that they show at once. The cells without one.
    fn take<M: EnclosedMap + Sync>(
        &mut self,
        maps: &[&M],
        fresh: Vec<OpenCell>,
    ) -> Result<Vec<Place>, Error> {
        self.images += fresh.len();
        let found = images(maps, &self.traps, &fresh);
        let mut open = Vec::with_capacity(fresh.len());
        for (cell, known) in fresh.into_iter().zip(found) {
            let known = known?;
            let place = cell.place;
            self.open.insert(place, cell);
            match known {
                Known::Fate(fate) => self.decide(place, fate),
                image => {
                    if let Some(own) = self.cells.get_mut(place) {
                        *own = image;
                    }
                    open.push(place);
                }
            }
        }
        Ok(open)
    }

    /// Writes down a fate.
    fn decide(&mut self, place: Place, fate: ProvedFate) {
        if let Some(known) = self.cells.get_mut(place) {
            *known = Known::Fate(fate);
        }
        let Some(OpenCell { window, points, .. }) = self.open.remove(&place) else { return };
        if window == 0 {
            let share = share_of(&points, &self.cells.windows()[0]);
            self.area = (Enclosure::from(self.area) + share).low().max(self.area);
        }
        self.decided.push(ProvedCell { window, points, fate });
    }

    /// Looks at an open cell, and at those that have waited for it if it has a fate.
    fn look(&mut self, place: Place) {
        let mut left = vec![place];
        while let Some(place) = left.pop() {
            let Some(open) = self.open.get(&place) else { continue };
            let halvings = open.halvings;
            match self.meets(open) {
                Meets::Fate(fate) => {
                    self.decide(place, fate);
                    left.extend(self.waiting.remove(&place).unwrap_or_default());
                }
                Meets::Open(other) => self.waiting.entry(other).or_default().push(place),
                Meets::Edge(other) => {
                    if let Some(other) = other {
                        self.waiting.entry(other).or_default().push(place);
                    }
                    self.edge.entry(halvings).or_default().push(place);
                }
                Meets::Outside => {}
            }
        }
    }

    /// What the image of an open cell meets.
    fn meets(&self, own: &OpenCell) -> Meets {
        // The first cells with a fate are parts of those that meet traps.
        if own.window == 0 && self.traps.iter().any(|trap| trap.meets(&own.points)) {
            return Meets::Edge(None);
        }
        // Without an image the cell is too large.
        let Some(Known::Open(Some(image))) = self.cells.get(own.place) else {
            return Meets::Edge(None);
        };
        let next = (own.window + 1) % self.cells.windows().len();
        let (mut fate, mut other, mut mixed) = (None, None, false);
        let enter = &mut |points: &[Enclosure]| !image.misses(points);
        self.cells.visit(next, enter, &mut |place, known, _| match known {
            Known::Fate(found) => mixed |= *fate.get_or_insert(*found) != *found,
            Known::Open(_) => other = Some(place),
        });
        let is_inside = |(own, window): (Enclosure, &Enclosure)| own.is_inside(window);
        let inside = image.hull().zip(&self.cells.windows()[next]).all(is_inside);
        match (fate, other) {
            (Some(fate), None) if inside && !mixed => Meets::Fate(fate),
            (Some(_), other) => Meets::Edge(other),
            (None, Some(other)) => Meets::Open(other),
            (None, None) => Meets::Outside,
        }
    }

    /// The largest cells whose division may show more, of those that are larger than the last ones.
    fn next_edge(&mut self, last: u32) -> Option<Vec<Place>> {
        if let Some(found) = self.largest_edge(last) {
            return Some(found);
        }
        // What cells that wait meet may have got a fate meanwhile, without the one for which they wait.
        let mut places: Vec<Place> = self.waiting.drain().flat_map(|(_, places)| places).collect();
        places.sort_unstable();
        places.dedup();
        places.iter().for_each(|place| self.look(*place));
        if let Some(found) = self.largest_edge(last) {
            return Some(found);
        }
        // No image meets a fate and can be divided: parts of those that meet open cells alone may meet one.
        for place in places {
            if let Some(open) = self.open.get(&place) {
                self.edge.entry(open.halvings).or_default().push(place);
            }
        }
        self.largest_edge(last)
    }

    fn largest_edge(&mut self, last: u32) -> Option<Vec<Place>> {
        self.edge.retain(|halvings, _| *halvings < last);
        self.edge.pop_first().map(|(_, places)| places)
    }

    /// The fate of a point of a window, if it is proved.
    pub fn fate(&self, window: usize, point: &[f64]) -> Option<ProvedFate> {
        match self.cells.at(window, point)? {
            Known::Fate(fate) => Some(*fate),
            Known::Open(_) => None,
        }
    }

    /// A lower bound of the share of the first window that has a fate.
    pub fn share(&self, fate: ProvedFate) -> f64 {
        let whole = &self.cells.windows()[0];
        let mut share = Enclosure::ZERO;
        self.cells.visit(0, &mut |_| true, &mut |_, known, points| {
            if matches!(known, Known::Fate(found) if *found == fate) {
                share = share + share_of(points, whole);
            }
        });
        share.low().clamp(0.0, 1.0)
    }

    /// The windows.
    pub(crate) fn windows(&self) -> &[Vec<Enclosure>] {
        self.cells.windows()
    }

    /// The cells with a fate of all windows, each one behind those in which its image is.
    pub fn cells(&self) -> &[ProvedCell] {
        &self.decided
    }

    /// The traps.
    pub fn traps(&self) -> &[Trap] {
        &self.traps
    }
}
