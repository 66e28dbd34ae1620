//! Hénon's map with a = 1.4 and b = 0.3: the area of the starts in [−2, 2]² that do not escape, from both sides.
fn main() {}
