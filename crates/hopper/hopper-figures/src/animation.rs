//! The animation of a motion as the bytes of a file.

use crate::error::Error;
use crate::motion::Motion;
use crate::motion_frames::{SECONDS_A_FRAME, draw_frame};
use journal_figures::render;
pub use journal_figures::{AnimationForm, AnimationFrame};

/// Pixels of a frame for each CSS pixel of its drawing: a frame has 640 × 380 of them. More make larger files.
const SCREEN_SCALE: f64 = 0.75;

/// The frame of a motion at a time. Frames are computed apart from each other, by as many threads as there are.
///
/// # Errors
/// [`Error::Figure`] if it cannot be encoded.
pub fn animation_frame(
    motion: &Motion,
    time: f64,
    form: AnimationForm,
) -> Result<AnimationFrame, Error> {
    let png = render("frame", &draw_frame(motion, time), SCREEN_SCALE)?.png;
    Ok(form.frame("animation", &png)?)
}

/// The animation of frames of one form as the bytes of a file. It begins again after the last frame.
///
/// ```
/// use hopper_figures::{AnimationForm, Motion, animation, animation_frame, frame_times};
/// use passive_hopper::MassRatio;
/// let motion = Motion::new(MassRatio::new(0.2)?, 7.0, 1)?;
/// let times = frame_times(&motion)?;
/// let frames = times[..3].iter().map(|&time| animation_frame(&motion, time, AnimationForm::Gif));
/// let bytes = animation(&frames.collect::<Result<Vec<_>, _>>()?, AnimationForm::Gif)?;
/// assert!(bytes.starts_with(b"GIF89a"));
/// # Ok::<(), hopper_figures::Error>(())
/// ```
///
/// # Errors
/// [`Error::Figure`] for no frames, and for frames of another form.
pub fn animation(frames: &[AnimationFrame], form: AnimationForm) -> Result<Vec<u8>, Error> {
    Ok(form.join("animation", frames, SECONDS_A_FRAME)?)
}
