//! How far from a zero is a guard clear of its error?

/// The first of the distances `first`, 2·`first`, 4·`first`, … at which `clear` holds; `most` if none below it does.
///
/// `clear(d)` tells whether the guard, at the times d before and behind its zero, differs from zero by more than
/// the error that it has *there*. At a jump of the guard that is so after the few ulps within which the jump itself
/// may be moved: its height says nothing about its time.
pub(crate) fn clear_distance(first: f64, most: f64, clear: impl Fn(f64) -> bool) -> f64 {
    let mut distance = first;
    // At most 2100 doublings lead from the smallest double to the largest. Not begun for NaN: then nothing is known.
    while distance > 0.0 && distance < most {
        if clear(distance) {
            return distance;
        }
        distance *= 2.0;
    }
    most
}
