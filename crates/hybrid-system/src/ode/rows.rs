//! A few vectors of one dimension, without allocation for small dimensions.

/// Vectors with at most this many components are stored in place, longer ones on the heap. A larger value makes every
/// integration larger, also those with short states; a smaller one makes more systems allocate, once for each
/// integration.
const IN_PLACE: usize = 8;

/// K vectors with n components each, all zero at first.
///
/// The methods are told n each time. For a [`State<N>`](crate::state::State) the compiler knows it then, and unrolls
/// the loops over components.
#[derive(Debug, Clone)]
pub(super) struct Rows<const K: usize> {
    /// The vectors, one directly after the other, if n ≤ [`IN_PLACE`].
    in_place: [[f64; IN_PLACE]; K],
    /// The vectors otherwise.
    heap: Vec<f64>,
}

impl<const K: usize> Rows<K> {
    pub(super) fn new(n: usize) -> Self {
        let heap = if n <= IN_PLACE { Vec::new() } else { vec![0.0; K * n] };
        Rows { in_place: [[0.0; IN_PLACE]; K], heap }
    }

    /// All vectors: vector k begins at k·n.
    pub(super) fn all(&self, n: usize) -> &[f64] {
        if n <= IN_PLACE { self.in_place.as_flattened() } else { &self.heap }
    }

    pub(super) fn all_mut(&mut self, n: usize) -> &mut [f64] {
        if n <= IN_PLACE { self.in_place.as_flattened_mut() } else { &mut self.heap }
    }

    /// Vector k.
    pub(super) fn row(&self, k: usize, n: usize) -> &[f64] {
        &self.all(n)[k * n..(k + 1) * n]
    }

    pub(super) fn row_mut(&mut self, k: usize, n: usize) -> &mut [f64] {
        &mut self.all_mut(n)[k * n..(k + 1) * n]
    }
}
