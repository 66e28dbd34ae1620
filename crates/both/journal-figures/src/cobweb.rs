//! The corners of a cobweb: an orbit of a scalar map, as it is drawn.

/// The corners of an orbit's cobweb: (x₀, x₀), (x₀, x₁), (x₁, x₁), (x₁, x₂), …, for at most `steps` steps.
///
/// It has fewer steps if the map has no value at an element of the orbit. The corners are computed one by one, so
/// that a large `steps` needs no memory.
///
/// ```
/// let web = journal_figures::cobweb(|x| Some(x / 2.0), 1.0, 1);
/// assert_eq!(web.collect::<Vec<_>>(), [(1.0, 1.0), (1.0, 0.5), (0.5, 0.5)]);
/// ```
pub fn cobweb(
    map: impl Fn(f64) -> Option<f64>,
    start: f64,
    steps: usize,
) -> impl Iterator<Item = (f64, f64)> {
    let mut from = start;
    let orbit = std::iter::successors(Some(start), move |&x| map(x));
    let corners = orbit.skip(1).take(steps).flat_map(move |to| {
        let step = [(from, to), (to, to)];
        from = to;
        step
    });
    std::iter::once((start, start)).chain(corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cobweb_of_endless_steps_is_drawn_as_far_as_it_is_read() {
        let web = cobweb(|x| Some(x / 2.0), 1.0, usize::MAX);
        assert_eq!(web.skip(3).take(2).collect::<Vec<_>>(), [(0.5, 0.25), (0.25, 0.25)]);
    }
}
