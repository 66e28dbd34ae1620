//! The animation of a motion as the bytes of a file.

use crate::error::Error;
use crate::motion::Motion;
use crate::motion_frames::{SECONDS_A_FRAME, draw_frame};
use journal_figures::{animated_gif, animated_png, render};

/// Pixels of a frame for each CSS pixel of its drawing: a frame has 640 × 380 of them. More make larger files.
const SCREEN_SCALE: f64 = 0.75;

/// The kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnimationForm {
    /// GIF, which every program shows.
    Gif,
    /// Animated PNG, with all colours.
    Apng,
}

/// The frame of a motion at a time, as a PNG.
///
/// # Errors
/// [`Error::Figure`] if it cannot be encoded.
pub fn frame_png(motion: &Motion, time: f64) -> Result<Vec<u8>, Error> {
    Ok(render("frame", &draw_frame(motion, time), SCREEN_SCALE)?.png)
}

/// The animation of frames as the bytes of a file. It begins again after the last frame.
///
/// ```
/// use hopper_figures::{AnimationForm, Motion, animation, frame_png, frame_times};
/// use passive_hopper::MassRatio;
/// let motion = Motion::new(MassRatio::new(0.2)?, 7.0, 1)?;
/// let times = frame_times(&motion)?;
/// let frames = times[..3].iter().map(|&time| frame_png(&motion, time));
/// let bytes = animation(&frames.collect::<Result<Vec<_>, _>>()?, AnimationForm::Gif)?;
/// assert!(bytes.starts_with(b"GIF89a"));
/// # Ok::<(), hopper_figures::Error>(())
/// ```
///
/// # Errors
/// [`Error::Figure`] for no frames, and for frames of different sizes.
pub fn animation(frames: &[Vec<u8>], form: AnimationForm) -> Result<Vec<u8>, Error> {
    Ok(match form {
        AnimationForm::Gif => animated_gif("animation", frames, SECONDS_A_FRAME)?,
        AnimationForm::Apng => animated_png("animation", frames, SECONDS_A_FRAME)?,
    })
}
