//! The CPU time of a thread.

use crate::error::Error;

/// Where Linux keeps the CPU time of the thread that reads it, as the first number, in nanoseconds.
const FILE: &str = "/proc/thread-self/schedstat";

/// The CPU time of this thread in seconds. Other processes do not change it much, and a wall clock would measure
/// them, too.
pub(super) fn thread_seconds() -> Result<f64, Error> {
    let text = std::fs::read_to_string(FILE).map_err(|error| {
        Error::CheckFailed(format!("{FILE}: {error}; CPU times are measured on Linux only"))
    })?;
    let first = text.split_whitespace().next().and_then(|number| number.parse::<f64>().ok());
    first
        .map(|nanoseconds| nanoseconds * 1e-9)
        .ok_or_else(|| Error::CheckFailed(format!("{FILE} has no number: '{}'", text.trim())))
}
