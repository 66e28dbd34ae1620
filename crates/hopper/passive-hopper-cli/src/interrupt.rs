//! Signals that ask the program to stop: Ctrl-C, and the one that batch systems send.

use crate::error::Error;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// A shell's exit status of a program that a signal ended is this plus the number of the signal.
const STATUS_OF_SIGNALS: u8 = 128;

/// Whether the user, or a batch system, has asked the program to stop.
#[derive(Debug, Clone, Default)]
pub(crate) struct Interrupt {
    /// The last signal; 0 is no signal.
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Takes note of signals from now on. The second signal ends the program at once.
    ///
    /// # Errors
    /// [`Error::File`] if the system refuses.
    pub(crate) fn watch() -> Result<Self, Error> {
        let interrupt = Interrupt::default();
        let second = Arc::new(AtomicBool::new(false));
        let watch = || -> std::io::Result<()> {
            for number in [SIGINT, SIGTERM] {
                // The actions of a signal run in this order: the first signal finds `second` false, and sets it.
                let status = i32::from(STATUS_OF_SIGNALS) + number;
                flag::register_conditional_shutdown(number, status, Arc::clone(&second))?;
                flag::register(number, Arc::clone(&second))?;
                flag::register_usize(number, Arc::clone(&interrupt.signal), number as usize)?;
            }
            // Without this a file that is larger than the system allows would kill the program without a message.
            // With it, the writing fails, as on a full disk.
            #[cfg(unix)]
            flag::register(signal_hook::consts::SIGXFSZ, Arc::new(AtomicBool::new(false)))?;
            Ok(())
        };
        let path = "the signals of this process".into();
        watch().map_err(|source| Error::File { path, source })?;
        Ok(interrupt)
    }

    /// The exit status after a signal; `None` if there was none.
    pub(crate) fn status(&self) -> Option<u8> {
        let signal = u8::try_from(self.signal.load(Ordering::Relaxed)).unwrap_or(0);
        (signal > 0).then(|| STATUS_OF_SIGNALS.saturating_add(signal))
    }

    /// # Errors
    /// [`Error::Interrupted`] after a signal.
    pub(crate) fn check(&self) -> Result<(), Error> {
        match self.status() {
            None => Ok(()),
            Some(status) => {
                Err(Error::Interrupted { status, done: "the finished pieces are kept".into() })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_signal_is_an_error_with_the_status_of_shells() {
        let interrupt = Interrupt::default();
        interrupt.check().unwrap();
        for (signal, status) in [(SIGINT, 130), (SIGTERM, 143)] {
            interrupt.signal.store(signal as usize, Ordering::Relaxed);
            assert_eq!(interrupt.check().unwrap_err().exit_status(), status);
        }
    }
}
