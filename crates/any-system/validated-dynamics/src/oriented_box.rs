//! Boxes in directions of their own, for questions about where images lie.

use crate::frame::Frame;
use crate::matrix::{Matrix, dot, offsets};
use crate::set::AffineSet;
use interval_arithmetic::Enclosure;

/// A box in directions of its own that holds a set: narrower than one along the axes, of a set that is stretched.
///
/// For each of some numbers w it has the range of w·(x − c) on the set. Any numbers will do: they are no inverse of anything.
#[derive(Debug, Clone)]
pub(crate) struct OrientedBox {
    size: usize,
    /// The centre c, the rows w, the ranges and a box along the axes, one after the other: there are millions of them.
    numbers: Box<[f64]>,
}

impl OrientedBox {
    pub(crate) fn of_set(set: &AffineSet) -> OrientedBox {
        let size = set.centre().len();
        let (columns, weights) = set.directions();
        let rows = Frame::of_columns(&columns, &weights).directions.transpose();
        let at_centre = vec![Enclosure::ZERO; size];
        let ranges = set.values(&at_centre, &Matrix::of_numbers(&rows));
        let mut numbers = Vec::with_capacity(size * (size + 5));
        numbers.extend(set.centre());
        numbers.extend((0..size).flat_map(|row| rows.row(row).iter().copied().collect::<Vec<_>>()));
        let ends = ranges.iter().chain(set.hull()).flat_map(|range| [range.low(), range.high()]);
        numbers.extend(ends);
        OrientedBox { size, numbers: numbers.into() }
    }

    /// The enclosure number `at` behind the rows.
    fn range(&self, at: usize) -> Enclosure {
        let first = self.size * (self.size + 1) + 2 * at;
        Enclosure::new(self.numbers[first], self.numbers[first + 1])
    }

    /// A box along the axes that holds the set.
    pub(crate) fn hull(&self) -> impl Iterator<Item = Enclosure> {
        (self.size..2 * self.size).map(|at| self.range(at))
    }

    /// True if no point of a box along the axes is in this one, for certain.
    pub(crate) fn misses(&self, other: &[Enclosure]) -> bool {
        let apart = |a: Enclosure, b: &Enclosure| a.high() < b.low() || b.high() < a.low();
        if self.hull().zip(other).any(|(a, b)| apart(a, b)) {
            return true;
        }
        let off = offsets(other, &self.numbers[..self.size]);
        (0..self.size).any(|row| {
            let row_of = &self.numbers[self.size * (1 + row)..][..self.size];
            apart(self.range(row), &dot(&off, row_of.iter().map(|&w| Enclosure::from(w))))
        })
    }
}
