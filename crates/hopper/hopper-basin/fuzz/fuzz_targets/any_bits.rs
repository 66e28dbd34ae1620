//! Gives arbitrary bit patterns to every public function of the hopper's crates. To run it, in
//! `crates/hopper/hopper-basin`: `cargo +nightly fuzz run any_bits`.
//!
//! The body is shared with the property test `hopper-basin/tests/any_bits.rs`.

#![no_main]

use libfuzzer_sys::fuzz_target;

#[path = "../../tests/any_bits/body.rs"]
mod body;

fuzz_target!(|words: [u64; 6]| {
    body::try_all(words);
});
