//! The samples of a motion as CSV.

use crate::output::number::{append_bound, append_number};
use hopper_figures::{Motion, SampleError};
use passive_hopper::Phase;
use std::fmt::Write;

/// The columns. The errors of the numbers are the last ones.
const NAMES: &str = "time,hop,phase,upper_position,upper_velocity,lower_position,lower_velocity,time_error,upper_position_error,upper_velocity_error,lower_position_error,lower_velocity_error\n";

/// One line for each sample, after a line of names. An error that is not known is an empty field.
pub(crate) fn motion_table(motion: &Motion, errors: &[SampleError]) -> String {
    let mut text = NAMES.to_owned();
    for (sample, error) in motion.samples.iter().zip(errors) {
        let phase = match sample.phase {
            Phase::Flight => "flight",
            Phase::Contact => "contact",
        };
        append_number(sample.time, &mut text);
        // Writing to a string does not fail.
        let _ = write!(text, ",{},{phase}", sample.hop);
        let state = sample.state;
        let values = [
            state.upper_position,
            state.upper_velocity,
            state.lower_position,
            state.lower_velocity,
        ];
        for value in values {
            text.push(',');
            append_number(value, &mut text);
        }
        for bound in [error.time].into_iter().chain(error.state) {
            text.push(',');
            if bound.is_finite() {
                append_bound(bound, &mut text);
            }
        }
        text.push('\n');
    }
    text
}
