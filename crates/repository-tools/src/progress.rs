//! Progress on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// Shows bars on standard error, if that is a terminal; in a pipe it shows none.
#[derive(Debug, Clone, Copy, Default)]
pub struct Progress;

/// A bar.
#[derive(Debug)]
pub struct Bar(ProgressBar);

impl Progress {
    /// A bar of `length` steps.
    pub fn bar(&self, name: &'static str, length: u64) -> Bar {
        let bar = ProgressBar::new(length);
        let template = "{msg:32} [{bar:36}] {percent:>3} %  {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_message(name);
        Bar(bar)
    }
}

impl Bar {
    /// Moves the bar to `position` of its length.
    pub fn set(&self, position: u64) {
        self.0.set_position(position);
    }
    /// Removes the bar from the terminal.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}
