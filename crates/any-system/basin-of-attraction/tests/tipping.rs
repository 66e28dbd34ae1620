//! Tipping with known answers: intersections of intervals, and a slow change that an orbit follows.

use super::planted_intervals::basins;
use basin_of_attraction::{
    Bounds, Error, Interval, Label, TippingCounts, label_after_drift, random_tipping,
};
use std::ops::ControlFlow::{Break, Continue};

fn close(bounds: Bounds, lower: f64, upper: f64) -> bool {
    (bounds.lower - lower).abs() < 1e-12 && (bounds.upper - upper).abs() < 1e-12
}

#[test]
fn undecided_parts_open_the_bounds_of_a_tipping_probability() {
    let [one, two] = [1, 2].map(Label::from);
    // Before: 1 on [0, 4], undecided [4, 5], 2 on [5, 10]. After: 1 on [0, 1], undecided [1, 2], 2 on [2, 9],
    // undecided.
    let before = basins(&[(0.0, 4.0, 1), (5.0, 10.0, 2)]);
    let after = basins(&[(0.0, 1.0, 1), (2.0, 9.0, 2)]);
    let tipping = before.tipping_to(&after).unwrap();
    assert_eq!(tipping.labels(), [one, two]);
    // 1 → 2: [2, 4] is certain, [1, 2] and [4, 5] are possible. At least 2 of 4: without [1, 2], without [4, 5].
    assert!(close(tipping.fraction(one, two), 0.2, 0.4));
    assert!(close(tipping.probability(one, two).unwrap(), 2.0 / 4.0, 4.0 / 5.0));
    // 2 → 1: only the undecided [9, 10] may go there.
    assert!(close(tipping.probability(two, one).unwrap(), 0.0, 1.0 / 5.0));
    // Nothing known of a third basin before; after, it may have what is undecided.
    assert_eq!(tipping.probability(Label::from(3), one), None);
    assert!(close(tipping.probability(one, Label::from(3)).unwrap(), 0.0, 1.0 / 4.0));
    // The same window is a precondition.
    let narrow = after.within(Interval { left: 0.0, right: 5.0 }).unwrap();
    assert!(matches!(before.tipping_to(&narrow), Err(Error::OtherWindow { .. })));
}

/// The bounds contain the probability for every way to decide the gaps.
#[test]
fn bounds_contain_the_probability_however_the_gaps_are_decided() {
    let parts = [(0.0, 2.0, 1), (2.5, 3.0, 2), (3.5, 4.0, 1), (5.0, 7.0, 2), (7.5, 10.0, 1)];
    let other = [(0.5, 2.7, 2), (3.5, 5.5, 1), (6.0, 8.0, 2), (8.5, 10.0, 1)];
    let tipping = basins(&parts).tipping_to(&basins(&other)).unwrap();
    let [one, two] = [1, 2].map(Label::from);
    let bounds = tipping.probability(one, two).unwrap();
    let gaps = |parts: &[(f64, f64, u8)]| -> Vec<(f64, f64)> {
        let starts = parts.iter().map(|part| part.0).chain([10.0]);
        let ends = [0.0].into_iter().chain(parts.iter().map(|part| part.1));
        ends.zip(starts).filter(|(left, right)| left < right).collect()
    };
    let (mut least, mut most) = (1.0f64, 0.0f64);
    let (first, second) = (gaps(&parts), gaps(&other));
    for choice in 0..1u32 << (first.len() + second.len()) {
        let fill = |parts: &[(f64, f64, u8)], gaps: &[(f64, f64)], shift: usize| {
            let label = |k: usize| 1 + (choice >> (k + shift) & 1) as u8;
            let filled = gaps.iter().enumerate().map(|(k, gap)| (gap.0, gap.1, label(k)));
            let mut all: Vec<(f64, f64, u8)> = parts.iter().copied().chain(filled).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            all.iter_mut().skip(1).for_each(|part| part.0 += 1e-14);
            basins(&all)
        };
        let whole =
            fill(&parts, &first, 0).tipping_to(&fill(&other, &second, first.len())).unwrap();
        let exact = whole.probability(one, two).unwrap().middle();
        assert!(bounds.lower - 1e-9 <= exact && exact <= bounds.upper + 1e-9, "{choice}");
        (least, most) = (least.min(exact), most.max(exact));
    }
    // And both bounds come close to being taken: every gap could be divided further.
    assert!(least - bounds.lower < 0.05 && bounds.upper - most < 0.05, "{bounds:?} {least} {most}");
}

#[test]
fn counted_tipping_counts_undecided_points_in_the_worst_way() {
    let [one, two] = [1, 2].map(Label::from);
    let pairs =
        |count: usize, before: Label, after: Label| std::iter::repeat_n((before, after), count);
    let all = pairs(600, one, two).chain(pairs(400, one, one)).chain(pairs(50, two, two));
    let decided = TippingCounts::new(all.clone()).unwrap();
    let certain = decided.probability(one, two).unwrap().unwrap();
    assert!(certain.value == 0.6 && certain.half_width() < 0.031);
    let open =
        all.chain(pairs(100, Label::UNDECIDED, two)).chain(pairs(100, one, Label::UNDECIDED));
    let open = TippingCounts::new(open.chain(pairs(7, Label::OUTSIDE, two))).unwrap();
    assert_eq!((open.inside(), open.count(one, two)), (1250, 600));
    let found = open.probability(one, two).unwrap().unwrap();
    assert!(found.value == 0.6 && found.lower < 0.5455 && found.upper > 0.666);
    assert_eq!(open.probability(Label::from(5), one).unwrap(), None);
    assert!(TippingCounts::new([(Label::OUTSIDE, one)]).is_err());
}

/// x → x + 0.1 (x − x³ + c): with c = 0 the basins of −1 and 1 meet at 0. A constant c = 0.5 leaves one attractor.
/// If c is switched on and off again within few steps, states come back; if it stays for long, they do not.
#[test]
fn a_fast_pulse_tips_fewer_states_than_a_long_one() {
    let step = |c: f64, x: f64| x + 0.1 * (x - x * x * x + c);
    let label = |x: f64| {
        let end = (0..1000).fold(x, |x, _| step(0.0, x));
        if end.is_finite() { Label::from(end > 0.0) } else { Label::UNDECIDED }
    };
    let line = Interval::new(-1.5, 1.5).unwrap().try_into().unwrap();
    let [low, high] = [0, 1].map(Label::from);
    let tips = |steps: usize| {
        let pulse =
            |x: &[f64]| label_after_drift(x[0], steps, |_, x| Continue(step(0.5, x)), label);
        let found = random_tipping(&line, 20_000, 3, |x| label(x[0]), pulse).unwrap();
        assert_eq!(found.probability(high, low).unwrap().unwrap().value, 0.0);
        found.probability(low, high).unwrap().unwrap()
    };
    let all: Vec<_> = [0, 5, 20, 200].map(tips).into();
    assert!(all[0].value == 0.0 && all[3].value == 1.0);
    assert!(
        all[0].upper < all[1].lower && all[1].upper < all[2].lower && all[2].upper < all[3].lower
    );
    // The states that tip in five steps are those above the preimage of 0.
    let (mut below, mut above) = (-1.5, 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (below + above);
        let end = (0..5).fold(middle, |x, _| step(0.5, x));
        if end > 0.0 { above = middle } else { below = middle }
    }
    assert!(all[1].covers(-above / 1.5), "{:?} {above}", all[1]);
    let ends =
        label_after_drift(0.0, 5, |k, x| if k == 2 { Break(low) } else { Continue(x) }, |_| high);
    assert_eq!(ends, low);
}
