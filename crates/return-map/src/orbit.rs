//! Orbits of a scalar map, and the cobwebs that draw them.

/// The orbit of `start` under `map`: `start`, f(start), f(f(start)), …
///
/// The orbit ends where the map gives `None`. Otherwise it is infinite.
///
/// ```
/// let halves: Vec<f64> = return_map::orbit(|x| Some(x / 2.0), 1.0).take(4).collect();
/// assert_eq!(halves, [1.0, 0.5, 0.25, 0.125]);
/// ```
pub fn orbit(map: impl Fn(f64) -> Option<f64>, start: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(start), move |&x| map(x))
}

/// The corners of an orbit's cobweb: (x₀, x₀), (x₀, x₁), (x₁, x₁), (x₁, x₂), …, for at most `steps` steps.
///
/// It has fewer steps if the orbit ends. The corners are computed one by one, so that a large `steps` needs no memory.
///
/// ```
/// let web = return_map::cobweb(|x| Some(x / 2.0), 1.0, 1);
/// assert_eq!(web.collect::<Vec<_>>(), [(1.0, 1.0), (1.0, 0.5), (0.5, 0.5)]);
/// ```
pub fn cobweb(
    map: impl Fn(f64) -> Option<f64>,
    start: f64,
    steps: usize,
) -> impl Iterator<Item = (f64, f64)> {
    let mut from = start;
    let corners = orbit(map, start).skip(1).take(steps).flat_map(move |to| {
        let step = [(from, to), (to, to)];
        from = to;
        step
    });
    std::iter::once((start, start)).chain(corners)
}
