//! Calls of the program in this process.

pub(crate) mod nonsmooth;

use passive_hopper_cli::{Streams, run};

/// What a call gave.
pub(crate) struct Called {
    pub(crate) code: u8,
    pub(crate) output: String,
    pub(crate) messages: String,
}

/// Calls `hopper` with these arguments and this input.
pub(crate) fn call(arguments: &[&str], mut input: &[u8]) -> Called {
    let (mut output, mut messages) = (Vec::new(), Vec::new());
    let streams = Streams {
        input: &mut input,
        input_is_terminal: false,
        output_has_colors: false,
        output: &mut output,
        messages: &mut messages,
    };
    let all = std::iter::once("hopper").chain(arguments.iter().copied());
    let code = run(all.map(Into::into), streams);
    let text = |bytes| String::from_utf8(bytes).expect("the program writes text");
    Called { code, output: text(output), messages: text(messages) }
}
