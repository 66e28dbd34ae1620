//! Cells of windows, divided where it is asked for.

use interval_arithmetic::Enclosure;

/// The most sides of a box that is divided into 2ⁿ parts: 65 536 of them.
pub const MOST_SIDES: usize = 16;

/// The place of a cell.
pub(crate) type Place = usize;

/// Windows of one dimension n, each divided into 2ⁿ cells, each of which may be divided again.
#[derive(Debug, Clone)]
pub(crate) struct Cells<T> {
    windows: Vec<Vec<Enclosure>>,
    cells: Vec<Cell<T>>,
}

#[derive(Debug, Clone)]
enum Cell<T> {
    /// It has what is known of it.
    Whole(T),
    /// Its first part is here, and the others behind it.
    Divided(Place),
}

/// One of the 2ⁿ parts of a box, in which a one in `part` is the upper half of an axis.
pub(crate) fn part_of(own: &[Enclosure], part: usize) -> Vec<Enclosure> {
    let half = |(axis, x): (usize, &Enclosure)| {
        let middle = x.middle();
        match part >> axis & 1 {
            0 => Enclosure::new(x.low(), middle),
            _ => Enclosure::new(middle, x.high()),
        }
    };
    own.iter().enumerate().map(half).collect()
}

impl<T: Clone> Cells<T> {
    /// The windows, not divided.
    pub(crate) fn new(windows: Vec<Vec<Enclosure>>, known: &T) -> Self {
        let cells = windows.iter().map(|_| Cell::Whole(known.clone())).collect();
        Cells { windows, cells }
    }

    pub(crate) fn windows(&self) -> &[Vec<Enclosure>] {
        &self.windows
    }

    fn parts(&self) -> usize {
        1 << self.windows.first().map_or(0, Vec::len)
    }

    /// What is known of a cell that is not divided.
    pub(crate) fn get(&self, place: Place) -> Option<&T> {
        match &self.cells[place] {
            Cell::Whole(known) => Some(known),
            Cell::Divided(_) => None,
        }
    }

    pub(crate) fn get_mut(&mut self, place: Place) -> Option<&mut T> {
        match &mut self.cells[place] {
            Cell::Whole(known) => Some(known),
            Cell::Divided(_) => None,
        }
    }

    /// Divides a cell, and gives the places of its parts, of which this is known.
    pub(crate) fn divide(&mut self, place: Place, known: &T) -> std::ops::Range<Place> {
        if self.get(place).is_none() {
            return 0..0;
        }
        let first = self.cells.len();
        let parts = self.parts();
        self.cells.extend((0..parts).map(|_| Cell::Whole(known.clone())));
        self.cells[place] = Cell::Divided(first);
        first..first + parts
    }

    /// Calls with the place of each cell of a window that is not divided, and its box, as long as `enter` is true for a box.
    pub(crate) fn visit(
        &self,
        window: usize,
        enter: &mut impl FnMut(&[Enclosure]) -> bool,
        visit: &mut impl FnMut(Place, &T, &[Enclosure]),
    ) {
        self.visit_below(window, &self.windows[window], enter, visit);
    }

    fn visit_below(
        &self,
        place: Place,
        own: &[Enclosure],
        enter: &mut impl FnMut(&[Enclosure]) -> bool,
        visit: &mut impl FnMut(Place, &T, &[Enclosure]),
    ) {
        if !enter(own) {
            return;
        }
        match &self.cells[place] {
            Cell::Whole(known) => visit(place, known, own),
            Cell::Divided(first) => {
                for part in 0..self.parts() {
                    self.visit_below(first + part, &part_of(own, part), enter, visit);
                }
            }
        }
    }

    /// The cell that is not divided with a point of a window.
    pub(crate) fn at(&self, window: usize, point: &[f64]) -> Option<&T> {
        let mut own = self.windows.get(window)?.clone();
        let inside = own.len() == point.len() && own.iter().zip(point).all(|(x, &p)| x.contains(p));
        if !inside {
            return None;
        }
        let mut place = window;
        loop {
            match &self.cells[place] {
                Cell::Whole(known) => return Some(known),
                Cell::Divided(first) => {
                    let upper = own.iter().zip(point).map(|(x, &p)| usize::from(p > x.middle()));
                    let part = upper.enumerate().map(|(axis, upper)| upper << axis).sum();
                    own = part_of(&own, part);
                    place = first + part;
                }
            }
        }
    }
}
