//! Where a falling duration reaches zero: two laws, fitted to a few points.
//!
//! Let D(t) be the duration of the last period, as a function of the time t of its last event, and t∞ the limit of the
//! events. If D = c (t∞ − t)^μ, then
//!
//! * μ = 1: the durations form a geometric series, of factor q, and D = λ (t∞ − t) with λ = (1 − q)/q;
//! * μ > 1: the durations fall like the power k^(−μ/(μ−1)) of their number, as those of impacts whose restitution tends
//!   to 1;
//! * μ → ∞: D falls like e^(−λt), as for durations 1/k, and there is no limit.
//!
//! So a limit exists where ln D(t) is concave, and the fits look for the zero of D.

/// A period: when it ended, how long it was, and a bound on the error of its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Period {
    /// Time of its last event, relative to any fixed time.
    pub(crate) end: f64,
    /// Its length, D.
    pub(crate) length: f64,
    /// Bound on the error of D.
    pub(crate) error: f64,
}

/// The time from the last fitted period to the limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fit {
    /// t∞ − t.
    pub(crate) remainder: f64,
    /// Bound on the error of the remainder, under the condition of the fit.
    pub(crate) error: f64,
    /// μ.
    pub(crate) order: f64,
    /// The differences between the slopes λ, relative to the largest: they show the errors of the lengths.
    pub(crate) scatter: f64,
}

/// Least ratio of the first to the last length in a geometric fit. If λ changes along the series, like D as over a
/// moving or curved surface, the change still to come is 1/(4 − 1) of the change seen. If λ falls like a small
/// power s of D, the true remainder is 1/(1 − s) of the fitted one, and the change seen is s ln 4 > s. So the
/// change seen bounds the change to come in both cases. A smaller ratio would not; a larger one needs longer
/// series.
const LEAST_SHRINKING: f64 = 4.0;

/// The geometric law, through `periods`, the oldest first; `None` if their slopes λ differ by more than `spread` of the
/// largest one.
///
/// λ is the difference quotient of D between neighbours. The remainder is D/λ with the last λ. The bound takes every λ
/// between the smallest and the largest one, widened on both sides by the difference of the last and the first.
pub(crate) fn geometric(periods: &[Period], spread: f64) -> Option<Fit> {
    let (first, last) = (periods.first()?, periods.last()?);
    if !(first.length >= LEAST_SHRINKING * last.length && last.length > 0.0) {
        return None;
    }
    let slope = |pair: &[Period]| (pair[0].length - pair[1].length) / (pair[1].end - pair[0].end);
    let (mut lowest, mut highest) = (f64::INFINITY, 0.0f64);
    for pair in periods.windows(2) {
        let slope = slope(pair);
        if !(slope > 0.0 && slope.is_finite()) {
            return None;
        }
        (lowest, highest) = (lowest.min(slope), highest.max(slope));
    }
    if !(highest - lowest <= spread * highest) {
        return None;
    }
    let latest = periods.get(periods.len() - 2..)?;
    let (oldest, newest) = (slope(periods.get(..2)?), slope(latest));
    let drift = (newest - oldest).abs();
    let remainder = last.length / newest;
    // 0.1 is the largest spread in use, so that the difference is positive.
    let longest = last.length / (lowest - drift);
    let shortest = last.length / (highest + drift);
    if !(longest > 0.0) {
        return None;
    }
    let noise = latest[0].error + latest[1].error;
    let relative_noise =
        noise / (latest[0].length - latest[1].length) + noise / (latest[1].end - latest[0].end);
    let error = (longest - remainder).max(remainder - shortest)
        + last.error / newest
        + remainder * relative_noise;
    let scatter = (highest - lowest) / highest;
    error.is_finite().then_some(Fit { remainder, error, order: 1.0, scatter })
}

/// Ratio of two predictions' differences that still counts as convergence. If D halves from period to period, the
/// differences halve (see [`power_law`]); the rest is room for lengths that do not halve exactly.
const CONVERGENCE: f64 = 0.75;

/// Factor on the last difference of two predictions. The errors of predictions are proportional to D: an error e is
/// followed by e/2 at most, so that the difference is at least the later error. The factor 2 is a margin for an
/// error that has not reached this law.
const MARGIN: f64 = 2.0;

/// The power law through `periods`, the oldest first, of lengths that fall by a factor of 2 or more from each to the
/// next; `None` if predictions of the limit do not converge.
///
/// The limit is predicted from each three neighbours. For durations C (k + k₀)^(−p) (1 + O(1/k)) the error of a
/// prediction is of order (t∞ − t)/k, which is proportional to k^(−p), and so to D.
pub(crate) fn power_law(periods: &[Period]) -> Option<Fit> {
    let [.., a, b, c, d, e] = periods else { return None };
    let first = three_points(a, b, c)?;
    let second = three_points(b, c, d)?;
    let third = three_points(c, d, e)?;
    let at = |period: &Period, (remainder, _): (f64, f64)| period.end - e.end + remainder;
    let earlier = (at(d, second) - at(c, first)).abs();
    let later = (at(e, third) - at(d, second)).abs();
    let (remainder, order) = third;
    // The noise of a length moves the slope of ln D between two points, of distance ln 2 or more, by 2/ln 2 < 3
    // times its relative size, and the difference of two slopes, which gives μ and the remainder, by twice that for
    // each of the two: 12 in all, times the order.
    let noise =
        12.0 * order * remainder * (c.error / c.length + d.error / d.length + e.error / e.length);
    if !(later <= CONVERGENCE * earlier + noise) {
        return None;
    }
    let error = MARGIN * later + noise;
    error.is_finite().then_some(Fit { remainder, error, order, scatter: 0.0 })
}

/// Smallest and largest remainder that is looked for, relative to the time between three points. The lower one belongs
/// to lengths that fall to 0 at once, the upper one to lengths that are exponential to rounding.
const REMAINDERS: (f64, f64) = (1e-9, 1e9);

/// Halvings of the logarithm of the remainder, from 18 decades to an ulp.
const HALVINGS: usize = 62;

/// The remainder t∞ − t after the last of three points of D = c (t∞ − t)^μ, and μ; `None` if ln D is not concave.
///
/// With x = ln(D_a/D_b), y = ln(D_b/D_c) and R = t∞ − t_c the law demands
/// x ln(1 + g/R) = y ln(1 + f/(R + g)), where f = t_b − t_a and g = t_c − t_b. The left side minus the right side is
/// positive for small R, and negative for large R if x/f < y/g: if ln D falls faster and faster.
fn three_points(a: &Period, b: &Period, c: &Period) -> Option<(f64, f64)> {
    let (x, y) = (pxfm::f_log(a.length / b.length), pxfm::f_log(b.length / c.length));
    let (f, g) = (b.end - a.end, c.end - b.end);
    if !(x > 0.0 && y > 0.0 && f > 0.0 && g > 0.0 && x * g < y * f) {
        return None;
    }
    let excess = |r: f64| x * pxfm::f_log1p(g / r) - y * pxfm::f_log1p(f / (r + g));
    let (mut low, mut high) = (REMAINDERS.0 * (f + g), REMAINDERS.1 * (f + g));
    if !(excess(low) > 0.0 && excess(high) < 0.0) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
    let remainder = (low * high).sqrt();
    Some((remainder, y / pxfm::f_log1p(g / remainder)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn period(end: f64, length: f64) -> Period {
        Period { end, length, error: 0.0 }
    }

    /// q^k: the remainder after the duration q^k is q^(k+1)/(1 − q).
    #[test]
    fn a_geometric_series_is_exact() {
        for q in [0.01f64, 0.3, 0.6, 0.9] {
            let mut end = 0.0;
            let step = if q > 0.7 { 7 } else { 1 };
            let series = (0..40).map(|k| {
                end += q.powi(k);
                period(end, q.powi(k))
            });
            let points: Vec<_> = series.step_by(step).take(5).collect();
            let fit = geometric(&points, 1e-2).unwrap();
            let exact = points[4].length * q / (1.0 - q);
            assert!((fit.remainder - exact).abs() < 1e-13 * end, "{q} {fit:?} {exact}");
        }
    }

    /// Durations Δ = q D + κ D²: the bound contains the limit of the series, summed to its end.
    #[test]
    fn the_bound_holds_while_the_factor_drifts() {
        for q in [0.2, 0.5, 0.7] {
            for drift in [-0.01, -0.003, 0.003, 0.01] {
                let mut lengths = vec![1.0f64];
                while lengths[lengths.len() - 1] > 1e-40 {
                    let d = lengths[lengths.len() - 1];
                    lengths.push(d * (q + drift * d));
                }
                let mut end = 0.0;
                let points: Vec<_> = lengths
                    .iter()
                    .map(|&length| {
                        end += length;
                        period(end, length)
                    })
                    .collect();
                let window = &points[1..7];
                let fit = geometric(window, 0.1).unwrap();
                let exact: f64 = lengths[7..].iter().rev().sum();
                assert!((fit.remainder - exact).abs() <= fit.error, "{q} {drift} {fit:?} {exact}");
                assert!(fit.error < 0.1 * exact, "{q} {drift} {fit:?} {exact}");
            }
        }
    }

    #[test]
    fn durations_of_one_over_k_have_no_limit_and_squares_have() {
        for (power, exact) in [
            (1.0f64, None),
            (2.0, Some(std::f64::consts::PI.powi(2) / 6.0)),
            (5.0, Some(1.036_927_755_143_37)),
        ] {
            let count = if power == 5.0 { 300 } else { 20_000 };
            let lengths: Vec<f64> = (1..count).map(|k| pxfm::f_pow(f64::from(k), -power)).collect();
            // Times relative to the last one, so that the short durations keep their digits.
            let mut end = 0.0;
            let mut points = Vec::new();
            for &length in lengths.iter().rev() {
                points.push(period(end, length));
                end -= length;
            }
            points.reverse();
            let mut last = f64::INFINITY;
            points.retain(|point| {
                let kept = point.length <= 0.5 * last;
                last = if kept { point.length } else { last };
                kept
            });
            let exact = exact.map(|exact| end + exact);
            let fit = power_law(&points);
            let Some(exact) = exact else {
                // The apparent remainder is far above the time so far.
                assert!(fit.is_none_or(|fit| fit.remainder > 100.0), "{fit:?}");
                continue;
            };
            let fit = fit.unwrap();
            let limit = points[points.len() - 1].end + fit.remainder;
            assert!((limit - exact).abs() <= fit.error, "{power} {fit:?} {}", limit - exact);
            assert!(fit.error < 1e-2 * fit.remainder, "{power} {fit:?}");
            assert!((fit.order - power / (power - 1.0)).abs() < 1e-2, "{fit:?}");
        }
    }
}
