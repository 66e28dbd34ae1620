//! How far a long job is: one line that changes on a terminal, and a line now and then where there is none.

use std::io::Write;
use std::time::Duration;

/// Time between two states of the line on a terminal: a reader sees it move, and it costs nothing.
const ON_TERMINAL: Duration = Duration::from_millis(200);

/// Time between two lines where there is no terminal: a log of a day has some thousand lines.
const IN_LOG: Duration = Duration::from_secs(30);

/// Carriage return, and the sequence of ECMA-48 that clears the line.
const CLEAR: &str = "\r\x1b[K";

/// Where the progress is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// On a terminal: one line that changes.
    Terminal,
    /// In a file or a pipe: a line every 30 seconds.
    Log,
    /// The user wants none.
    Nowhere,
}

impl Place {
    /// Nowhere if `quiet`; else by whether the messages go to a terminal.
    pub const fn new(quiet: bool, is_terminal: bool) -> Self {
        match (quiet, is_terminal) {
            (true, _) => Place::Nowhere,
            (_, true) => Place::Terminal,
            _ => Place::Log,
        }
    }
}

/// The progress of some pieces, written where people read it: a line that changes on a terminal, elsewhere a line
/// every 30 seconds.
///
/// ```
/// use resumable_job::{Pace, Place, Progress};
/// use std::time::Duration;
/// let pace = Pace { unit: "tiles", total: 256, found: 137, each: Some((16_384, "pixels")) };
/// let mut log = Vec::new();
/// let mut progress = Progress::new(pace, Place::new(false, false), &mut log);
/// for computed in 0..=60 {
///     progress.tell(computed as usize, Duration::from_secs(computed));
/// }
/// assert!(log.starts_with(b"167 of 256 tiles, 65 %, 1.6e4 pixels/s, 1 min 29 s left\n197 of"));
/// ```
#[derive(Debug)]
pub struct Progress<W> {
    messages: W,
    place: Place,
    pace: Pace,
    /// The elapsed time at the last line.
    told: Duration,
}

/// What is known about the pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pace {
    /// What they are called, such as tiles.
    pub unit: &'static str,
    /// All pieces of this call.
    pub total: usize,
    /// Those that an earlier call finished.
    pub found: usize,
    /// What a piece has, such as 16384 pixels, if its speed is to be told.
    pub each: Option<(usize, &'static str)>,
}

impl<W: Write> Progress<W> {
    /// Shows nothing before some time has passed.
    pub fn new(pace: Pace, place: Place, messages: W) -> Self {
        Progress { messages, place, pace, told: Duration::ZERO }
    }

    /// Tells, if it is time to, that this call has finished so many pieces, `elapsed` after its begin.
    pub fn tell(&mut self, computed: usize, elapsed: Duration) {
        let since = elapsed.saturating_sub(self.told);
        // A line that cannot be written is no failure of the job.
        let _ = match self.place {
            Place::Terminal if since >= ON_TERMINAL => {
                self.told = elapsed;
                write!(self.messages, "{CLEAR}{}", self.pace.line(computed, elapsed))
                    .and_then(|()| self.messages.flush())
            }
            Place::Log if since >= IN_LOG => {
                self.told = elapsed;
                writeln!(self.messages, "{}", self.pace.line(computed, elapsed))
            }
            _ => Ok(()),
        };
    }

    /// Writes a line of its own, above the progress.
    pub fn note(&mut self, text: &str) {
        self.clear();
        if self.place != Place::Nowhere {
            let _ = writeln!(self.messages, "{text}");
        }
    }

    /// Leaves an empty line on a terminal.
    pub fn clear(&mut self) {
        if self.place == Place::Terminal {
            let _ = write!(self.messages, "{CLEAR}").and_then(|()| self.messages.flush());
        }
    }
}

impl Pace {
    /// Such as "153 of 256 tiles, 60 %, 1.2e6 pixels/s, 2 min left".
    fn line(&self, computed: usize, elapsed: Duration) -> String {
        let done = self.found + computed;
        let percent = 100.0 * done as f64 / self.total.max(1) as f64;
        let mut line = format!("{done} of {} {}, {percent:.0} %", self.total, self.unit);
        let pieces_per_second = computed as f64 / elapsed.as_secs_f64();
        // Without a finished piece nothing is known about the speed.
        if computed == 0 {
            line += &format!(", {} so far", duration(elapsed.as_secs_f64()));
        } else if pieces_per_second.is_finite() {
            let left = self.total.saturating_sub(done) as f64 / pieces_per_second;
            if let Some((amount, name)) = self.each {
                line += &format!(", {:.1e} {name}/s", pieces_per_second * amount as f64);
            }
            line += &format!(", {} left", duration(left));
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
        let each = Some((16_384, "pixels"));
        let pace = Pace { unit: "tiles", total: 256, found: 137, each };
        let line = |computed, seconds| pace.line(computed, Duration::from_secs(seconds));
        assert_eq!(line(0, 30), "137 of 256 tiles, 54 %, 30 s so far");
        assert_eq!(line(19, 38), "156 of 256 tiles, 61 %, 8.2e3 pixels/s, 3 min 20 s left");
        assert_eq!(line(119, 60), "256 of 256 tiles, 100 %, 3.2e4 pixels/s, 0 s left");
        assert_eq!(line(1, 0), "138 of 256 tiles, 54 %");
        assert_eq!(
            Pace { total: 0, found: 0, ..pace }.line(0, Duration::ZERO),
            "0 of 0 tiles, 0 %, 0 s so far"
        );
        let plain = Pace { each: None, ..pace };
        assert_eq!(plain.line(119, Duration::from_secs(60)), "256 of 256 tiles, 100 %, 0 s left");
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
