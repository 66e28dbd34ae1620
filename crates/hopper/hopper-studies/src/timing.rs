//! Times as medians over repeats.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Number of repeats; the median is used. Other processes may disturb three of them.
const REPEATS: usize = 7;

/// The least duration of a repeat. A repeat has as many passes as needed for it, at least one. A call to the clock
/// takes tens of nanoseconds, which is negligible.
const LEAST: Duration = Duration::from_millis(4);

/// The time of one call of `call`, over the inputs 0, …, `count` − 1.
pub(crate) fn median_time<T>(count: usize, call: impl Fn(usize) -> T) -> Duration {
    Duration::from_secs_f64(median_seconds(count, call))
}

/// The time of one call in seconds. A `Duration` would round it to nanoseconds, and a hop takes only twenty.
pub(crate) fn median_seconds<T>(count: usize, call: impl Fn(usize) -> T) -> f64 {
    let pass = || (0..count).for_each(|k| drop(black_box(call(black_box(k)))));
    let begin = Instant::now();
    pass();
    let once = begin.elapsed();
    // 1e-9 avoids a division by zero if the clock cannot resolve a pass.
    let passes = (LEAST.as_secs_f64() / once.as_secs_f64().max(1e-9)).ceil().max(1.0) as u32;
    // A pass of 0.2 s or more is timed only once: seven repeats would take minutes over all methods.
    let repeats = if once > 50 * LEAST { 1 } else { REPEATS };
    let mut times: Vec<Duration> = (0..repeats)
        .map(|_| {
            let begin = Instant::now();
            (0..passes).for_each(|_| pass());
            begin.elapsed() / passes
        })
        .collect();
    times.sort();
    times[repeats / 2].as_secs_f64() / count.max(1) as f64
}

/// The result of `run`, and the smallest time of some runs in seconds, of one at least. Runs begin as long as `share` is
/// not over. Other processes only make a run longer.
pub(crate) fn least_seconds<T, E>(
    share: Duration,
    run: impl Fn() -> Result<T, E>,
) -> Result<(T, f64), E> {
    let begin = Instant::now();
    let found = run()?;
    let mut least = begin.elapsed();
    while begin.elapsed() < share {
        let start = Instant::now();
        black_box(run()?);
        least = least.min(start.elapsed());
    }
    Ok((found, least.as_secs_f64()))
}

/// The time of one `f64::sin_cos` on arguments in [0, 50], the range of the phases of a hop: the unit of speed.
pub(crate) fn sin_cos_time() -> Duration {
    Duration::from_secs_f64(sin_cos_seconds())
}

/// The time of one `f64::sin_cos` in seconds.
#[allow(clippy::disallowed_methods)] // the unit is the standard library's own function
pub(crate) fn sin_cos_seconds() -> f64 {
    let arguments: Vec<f64> = (0..10_000).map(|k| 0.005 * f64::from(k)).collect();
    median_seconds(arguments.len(), |k| arguments[k].sin_cos())
}
