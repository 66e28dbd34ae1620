//! The samples of a motion as CSV.

use crate::output::number::append_number;
use hopper_figures::Motion;
use passive_hopper::Phase;
use std::fmt::Write;

/// One line for each sample, after a line of names.
pub(crate) fn motion_table(motion: &Motion) -> String {
    let mut text =
        "time,hop,phase,upper_position,upper_velocity,lower_position,lower_velocity\n".to_owned();
    for sample in &motion.samples {
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
        text.push('\n');
    }
    text
}
