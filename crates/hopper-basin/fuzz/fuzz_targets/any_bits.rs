//! Arbitrary bit patterns to every public function of the hopper's crates:
//! `cargo +nightly fuzz run any_bits`, in `crates/hopper-basin`.
//!
//! The body is shared with the property test `hopper-basin/tests/any_bits.rs`.

#![no_main]

use libfuzzer_sys::fuzz_target;

#[path = "../../tests/any_bits/body.rs"]
mod body;

fuzz_target!(|words: [u64; 6]| {
    body::try_all(words);
});
