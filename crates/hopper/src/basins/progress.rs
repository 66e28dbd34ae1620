//! How far a long job is: one line that changes on a terminal, and a line now and then where there is none.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// Time between two states of the line on a terminal: a reader sees it move, and it costs nothing.
const ON_TERMINAL: Duration = Duration::from_millis(200);

/// Time between two lines where there is no terminal: a log of a day has some thousand lines.
const IN_LOG: Duration = Duration::from_secs(30);

/// Carriage return, and the sequence of ECMA-48 that clears the line.
const CLEAR: &str = "\r\x1b[K";

/// Where the progress is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Terminal,
    Log,
    Nowhere,
}

/// The progress of some pieces.
pub(crate) struct Progress<'a> {
    messages: &'a mut dyn Write,
    place: Place,
    pace: Pace,
    began: Instant,
    told: Instant,
}

/// What is known about the pieces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pace {
    /// What they are called, such as tiles.
    pub(crate) unit: &'static str,
    /// All pieces of this call.
    pub(crate) total: usize,
    /// Those that an earlier call finished.
    pub(crate) found: usize,
    /// Pixels of a piece.
    pub(crate) pixels: usize,
}

impl<'a> Progress<'a> {
    /// Shows nothing before some time has passed; nothing at all if `quiet`.
    pub(crate) fn new(pace: Pace, quiet: bool, messages: &'a mut dyn Write) -> Self {
        let place = match (quiet, std::io::stderr().is_terminal()) {
            (true, _) => Place::Nowhere,
            (_, true) => Place::Terminal,
            _ => Place::Log,
        };
        let now = Instant::now();
        Progress { messages, place, pace, began: now, told: now }
    }

    /// Tells that this call has finished so many pieces, if it is time to.
    pub(crate) fn tell(&mut self, computed: usize) {
        let line = |pace: &Pace, began: Instant| pace.line(computed, began.elapsed());
        // A line that cannot be written is no failure of the job.
        let _ = match self.place {
            Place::Terminal if self.told.elapsed() >= ON_TERMINAL => {
                self.told = Instant::now();
                write!(self.messages, "{CLEAR}{}", line(&self.pace, self.began))
                    .and_then(|()| self.messages.flush())
            }
            Place::Log if self.told.elapsed() >= IN_LOG => {
                self.told = Instant::now();
                writeln!(self.messages, "{}", line(&self.pace, self.began))
            }
            _ => Ok(()),
        };
    }

    /// Writes a line of its own, above the progress.
    pub(crate) fn note(&mut self, text: &str) {
        self.clear();
        if self.place != Place::Nowhere {
            let _ = writeln!(self.messages, "{text}");
        }
    }

    /// Leaves an empty line on a terminal.
    pub(crate) fn clear(&mut self) {
        if self.place == Place::Terminal {
            let _ = write!(self.messages, "{CLEAR}").and_then(|()| self.messages.flush());
        }
    }
}

impl Pace {
    /// Such as "153 of 256 tiles, 60 %, 1.2e6 pixels/s, 2 min left".
    pub(crate) fn line(&self, computed: usize, elapsed: Duration) -> String {
        let done = self.found + computed;
        let percent = 100.0 * done as f64 / self.total.max(1) as f64;
        let mut line = format!("{done} of {} {}, {percent:.0} %", self.total, self.unit);
        let pieces_per_second = computed as f64 / elapsed.as_secs_f64();
        // Without a finished piece nothing is known about the speed.
        if computed > 0 && pieces_per_second.is_finite() {
            let left = self.total.saturating_sub(done) as f64 / pieces_per_second;
            let speed = pieces_per_second * self.pixels as f64;
            line += &format!(", {speed:.1e} pixels/s, {} left", duration(left));
        }
        line
    }
}

/// A time in one or two units.
fn duration(seconds: f64) -> String {
    // More than any job takes: a number of this size is an error of the estimate.
    const LONGEST: f64 = 1e9;
    let seconds = seconds.min(LONGEST).round() as u64;
    let (days, hours) = (seconds / 86_400, seconds / 3600 % 24);
    let (minutes, rest) = (seconds / 60 % 60, seconds % 60);
    match (days, hours, minutes) {
        (0, 0, 0) => format!("{rest} s"),
        (0, 0, _) => format!("{minutes} min {rest} s"),
        (0, ..) => format!("{hours} h {minutes} min"),
        _ => format!("{days} d {hours} h"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_what_was_found_the_speed_of_this_call_and_the_time_left() {
        let pace = Pace { unit: "tiles", total: 256, found: 137, pixels: 16_384 };
        let line = |computed, seconds| pace.line(computed, Duration::from_secs(seconds));
        assert_eq!(line(0, 30), "137 of 256 tiles, 54 %");
        assert_eq!(line(19, 38), "156 of 256 tiles, 61 %, 8.2e3 pixels/s, 3 min 20 s left");
        assert_eq!(line(119, 60), "256 of 256 tiles, 100 %, 3.2e4 pixels/s, 0 s left");
        assert_eq!(line(1, 0), "138 of 256 tiles, 54 %");
        assert_eq!(
            Pace { total: 0, found: 0, ..pace }.line(0, Duration::ZERO),
            "0 of 0 tiles, 0 %"
        );
    }

    #[test]
    fn times_have_one_or_two_units() {
        for (seconds, text) in
            [(0.2, "0 s"), (61.0, "1 min 1 s"), (7260.0, "2 h 1 min"), (90_000.0, "1 d 1 h")]
        {
            assert_eq!(duration(seconds), text);
        }
        assert!(duration(f64::INFINITY).ends_with("h"));
    }
}
