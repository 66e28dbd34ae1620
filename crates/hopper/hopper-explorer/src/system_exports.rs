//! The functions of the module of other systems, as in `exports.rs`.

use crate::answer;
use crate::systems::{OpenSystem, systems_json};
use std::cell::RefCell;

/// All systems, as JSON.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn systems() -> u32 {
    answer::keep(Ok(systems_json().finish().into_bytes()))
}

thread_local! {
    /// The system of the last picture: its attractors take longer than a strip.
    static OPEN: RefCell<Option<OpenSystem>> = const { RefCell::new(None) };
}

/// Columns `from`..`to` of a picture of the system with this number.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn system_strip(
    number: usize,
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
    columns: usize,
    rows: usize,
    from: usize,
    to: usize,
) -> u32 {
    answer::keep(OPEN.with_borrow_mut(|kept| {
        let known = kept.take().filter(|own| own.number() == number);
        let own = known.map_or_else(|| OpenSystem::new(number), Ok)?;
        let strip = own.strip(((left, right), (bottom, top)), (columns, rows), from..to);
        *kept = Some(own);
        strip
    }))
}
