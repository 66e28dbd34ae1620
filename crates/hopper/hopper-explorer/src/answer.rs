//! The one buffer in which an answer waits for the page.
//!
//! A call computes its answer, keeps it here and returns whether it is an answer or a refusal. The page copies the
//! bytes from `answer_place` before its next call.

use crate::refusal::Refusal;
use std::cell::RefCell;

thread_local! {
    /// The last answer. A worker has one thread, and each worker has its own memory.
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// The status of an answer.
const ANSWERED: u32 = 0;
/// The status of a refusal, whose text is in the buffer.
const REFUSED: u32 = 1;

/// Keeps an answer; its status.
pub(crate) fn keep(answer: Result<Vec<u8>, Refusal>) -> u32 {
    let (status, bytes) = match answer {
        Ok(bytes) => (ANSWERED, bytes),
        Err(refusal) => (REFUSED, refusal.to_string().into_bytes()),
    };
    ANSWER.with_borrow_mut(|kept| *kept = bytes);
    status
}

/// The address of the last answer, in every module of the page.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn answer_place() -> *const u8 {
    ANSWER.with_borrow(|kept| kept.as_ptr())
}

/// Its number of bytes.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn answer_length() -> usize {
    ANSWER.with_borrow(Vec::len)
}
