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

/// The components that are summed at the same time, each in a register of its own. More components would need more
/// registers than a processor has, with two sums each; fewer would read the weights more often.
const TOGETHER: usize = 4;

/// Calls `$block::<M>(axis, …)` for all components below n, M ≤ [`TOGETHER`] components at a time.
///
/// The functions that use it are always inlined: the compiler knows the dimension of a
/// [`State<N>`](crate::state::State) then, and keeps the blocks of that dimension alone. As separate functions they
/// take a third more time for the whole integration of a state with three components.
macro_rules! in_blocks {
    ($n:expr, $block:ident($($argument:expr),*)) => {{
        let (n, mut axis) = ($n, 0);
        while axis < n {
            match n - axis {
                1 => $block::<1>(axis, $($argument),*),
                2 => $block::<2>(axis, $($argument),*),
                3 => $block::<3>(axis, $($argument),*),
                _ => $block::<TOGETHER>(axis, $($argument),*),
            }
            axis += TOGETHER;
        }
    }};
}

/// `sums` = `from` + factor · Σ wₖ rowₖ. The rows lie one directly after the other.
#[inline(always)]
pub(super) fn add_rows(
    sums: &mut [f64],
    from: Option<&[f64]>,
    (factor, weights): (f64, &[f64]),
    rows: &[f64],
) {
    in_blocks!(sums.len(), add_block(sums, from, (factor, weights), rows));
}

#[inline(always)]
fn add_block<const M: usize>(
    axis: usize,
    sums: &mut [f64],
    from: Option<&[f64]>,
    (factor, weights): (f64, &[f64]),
    rows: &[f64],
) {
    let n = sums.len();
    let mut sum = [0.0; M];
    if let Some(from) = from {
        sum.copy_from_slice(&from[axis..axis + M]);
    }
    for (weight, row) in weights.iter().zip(rows.chunks_exact(n)) {
        let row = &row[axis..axis + M];
        for (sum, component) in sum.iter_mut().zip(row) {
            *sum += factor * weight * component;
        }
    }
    sums[axis..axis + M].copy_from_slice(&sum);
}

/// Calls `put` with each component of `from` + factor · Σ aⱼ rowⱼ, for terms (j, aⱼ) in pairs.
///
/// The first and the second terms of the pairs are summed separately, so that the processor computes the two sums in
/// parallel.
#[inline(always)]
pub(super) fn add_pairs(
    put: &mut impl FnMut(usize, f64),
    from: &[f64],
    (factor, terms): (f64, &[[(usize, f64); 2]]),
    rows: &[f64],
) {
    in_blocks!(from.len(), add_pairs_block(put, from, (factor, terms), rows));
}

#[inline(always)]
fn add_pairs_block<const M: usize>(
    axis: usize,
    put: &mut impl FnMut(usize, f64),
    from: &[f64],
    (factor, terms): (f64, &[[(usize, f64); 2]]),
    rows: &[f64],
) {
    let n = from.len();
    let (mut even, mut odd) = ([0.0; M], [0.0; M]);
    for [a, b] in terms {
        let (first, second) = (&rows[a.0 * n + axis..][..M], &rows[b.0 * n + axis..][..M]);
        for k in 0..M {
            even[k] += a.1 * first[k];
            odd[k] += b.1 * second[k];
        }
    }
    for k in 0..M {
        put(axis + k, from[axis + k] + factor * (even[k] + odd[k]));
    }
}
