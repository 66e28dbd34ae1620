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
/// It has fewer steps if the orbit ends.
///
/// ```
/// let web = return_map::cobweb(|x| Some(x / 2.0), 1.0, 1);
/// assert_eq!(web, [(1.0, 1.0), (1.0, 0.5), (0.5, 0.5)]);
/// ```
pub fn cobweb(map: impl Fn(f64) -> Option<f64>, start: f64, steps: usize) -> Vec<(f64, f64)> {
    let points: Vec<f64> = orbit(map, start).take(steps.saturating_add(1)).collect();
    let mut web = vec![(start, start)];
    for pair in points.windows(2) {
        web.extend([(pair[0], pair[1]), (pair[1], pair[1])]);
    }
    web
}
