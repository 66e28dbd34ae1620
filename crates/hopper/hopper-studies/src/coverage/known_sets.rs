//! Sets and labellings of the line with known dimensions and fractions.

use basin_of_attraction::Label;

/// The number of boxes [x + kε, x + (k+1)ε) with a point of the Cantor set in [0, 1] of two copies with these ratios.
pub(super) fn cantor_boxes(ratios: (f64, f64), epsilon: f64, x: f64) -> f64 {
    let index = |point: f64| ((point - x) / epsilon).floor();
    let (mut boxes, mut last) = (0.0, f64::NAN);
    // Parts of the set from left to right: the next one is at the end.
    let mut parts = vec![(0.0, 1.0)];
    while let Some((left, length)) = parts.pop() {
        let (first, end) = (index(left), index(left + length));
        // Shorter parts than 10⁻¹³ straddle a side by rounding.
        if first < end && length > 1e-13 {
            let right = length * ratios.1;
            parts.push((left + length - right, right));
            parts.push((left, length * ratios.0));
            continue;
        }
        for own in [first, end] {
            if own != last {
                boxes += 1.0;
                last = own;
            }
        }
    }
    boxes
}

/// The dimension of that set: a^D + b^D = 1, by bisection.
pub(super) fn cantor_dimension((a, b): (f64, f64)) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if pxfm::f_pow(a, middle) + pxfm::f_pow(b, middle) > 1.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The number of boxes [x + kε, x + (k+1)ε) with a point of {k⁻³} or 0.
pub(super) fn cube_boxes(epsilon: f64, x: f64) -> f64 {
    let index = |point: f64| ((point - x) / epsilon).floor();
    let cube = |k: f64| 1.0 / (k * k * k);
    let (mut boxes, mut last, mut k) = (0.0, f64::NAN, 1.0);
    // While the gap to the next point is longer than a box.
    while cube(k) - cube(k + 1.0) > epsilon {
        let own = index(cube(k));
        boxes += if own == last { 0.0 } else { 1.0 };
        (last, k) = (own, k + 1.0);
    }
    // From here on every box down to 0 has a point.
    boxes + index(cube(k)) - index(0.0) + if index(cube(k)) == last { 0.0 } else { 1.0 }
}

/// The parity of the number of steps after which x leaves [0, 1] under the tent map of this slope, above 2. The
/// points that stay are a Cantor set of two copies with the ratio 1/slope.
pub(super) fn tent_label(slope: f64, x: f64) -> Label {
    // After 200 steps a distance of 10⁻³⁰ from the Cantor set has grown beyond 1 for every slope above 1.5.
    const STEPS: u8 = 200;
    let mut x = x;
    for step in 0..STEPS {
        if !(0.0..=1.0).contains(&x) {
            return Label::from(step % 2);
        }
        x = slope * x.min(1.0 - x);
    }
    Label::UNDECIDED
}

/// The parity of the stage of the gap of the Cantor set in which x falls; the even stages have 3/5 of [0, 1].
pub(super) fn cantor_label(x: f64) -> Label {
    // After 60 steps every f64 has left the Cantor set, but for its ends.
    const STEPS: u8 = 60;
    let mut x = x;
    for step in 0..STEPS {
        if 3.0 * x > 1.0 && 3.0 * x < 2.0 {
            return Label::from(step % 2);
        }
        x = if 3.0 * x <= 1.0 { 3.0 * x } else { 3.0 * x - 2.0 };
    }
    Label::UNDECIDED
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_of_known_sets_are_counted() {
        let third = 1.0 / 3.0;
        // Five boxes of 0.2 from −0.02 hold 0, 2/9, 2/3, 7/9 + 1/81 and 1; the box of 0.38 … 0.58 is in the middle gap.
        for (size, x, boxes) in [(0.6, -0.05, 2.0), (0.4, -0.05, 3.0), (0.2, -0.02, 5.0)] {
            assert_eq!(cantor_boxes((third, third), size, x), boxes);
        }
        assert!((cantor_dimension((third, third)) - 0.630_929_753_571_457).abs() < 1e-14);
        assert_eq!(cantor_boxes((0.5, 0.25), 2.0, -0.5), 1.0);
        // {1, 1/8, 1/27, …, 0}: boxes of 0.1 from 0 hold 1, 1/8, and the rest.
        assert_eq!(cube_boxes(0.1, 0.0), 3.0);
        assert_eq!(cube_boxes(1e-3, 0.0), f64::from(u8::try_from(brute_force(1e-3)).unwrap()));
    }

    fn brute_force(size: f64) -> usize {
        let mut boxes: Vec<i64> =
            (1..100_000).map(|k| (1.0 / f64::from(k).powi(3) / size) as i64).collect();
        boxes.dedup();
        boxes.len()
    }

    #[test]
    fn the_parities_of_gaps_alternate() {
        assert_eq!([0.5, 0.2, 0.06].map(cantor_label), [0, 1, 0].map(Label::from));
        assert_eq!([0.5, 1.5, 0.16].map(|x| tent_label(3.0, x)), [1, 0, 0].map(Label::from));
    }
}
