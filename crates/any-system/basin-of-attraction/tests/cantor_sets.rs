//! Finite, countable and Cantor sets of points that never leave, with known entropies, gaps and lengths.

use super::cantor::interval;
use basin_of_attraction::{
    Branch, Enclosure, GapLengths, Interval, Itineraries, KneadingSequence, PreimageTree, Side,
    repeller,
};
use proptest::prelude::*;

fn branch(left: f64, right: f64, at_left: f64, at_right: f64) -> Branch {
    Branch { domain: interval(left, right), at_left, at_right }
}

/// Under 2x on A = [0, 0.4] the image covers A and B = [0.6, 0.8]. Where B leads decides how many itineraries there are; the gap between A and B is
/// the hole.
fn through_b(onto: impl Fn(f64) -> f64 + Copy + Sync, level: usize) -> Itineraries {
    let map = move |x: f64| Some(if x < 0.5 { 2.0 * x } else { onto(x) });
    let branches = [branch(0.0, 0.4, 0.0, 0.8), branch(0.6, 0.8, onto(0.6), onto(0.8))];
    let hole = interval(0.4 + 1e-12, 0.6 - 1e-12);
    let tree =
        PreimageTree::grow_from_known(&map, &branches, hole, interval(0.0, 0.8), level).unwrap();
    tree.itineraries(&map, &branches, level)
}

#[test]
fn the_number_of_itineraries_is_that_of_the_ways() {
    for level in [0, 3, 8] {
        // Back onto A: two successive visits of B are not possible. The entropy is that of the golden ratio.
        let Itineraries::Cantor { entropy } = through_b(|x| 2.0 * (x - 0.6), level) else {
            panic!()
        };
        let golden = (0.5 * (1.0 + 5f64.sqrt())).ln();
        assert!(entropy.covers(golden) && entropy.half_width() < 1e-9, "{level} {entropy:?}");
        // Onto B itself: up to some time in A, and then in B for ever.
        assert_eq!(through_b(|x| 0.6 + 2.0 * (x - 0.6), level), Itineraries::Countable, "{level}");
        // Away: only those that stay in A for ever.
        assert_eq!(through_b(|x| 2.0 + x, level), Itineraries::Finite, "{level}");
    }
    // x + x² brings all of [−1, 0] into the trap, the slowest in less than two hundred steps.
    let slow = |x: f64| Some(x + x * x);
    let branches = [branch(-1.0, -0.5, 0.0, -0.25), branch(-0.5, 0.0, -0.25, 0.0)];
    let (window, trap) = (interval(-1.0, 0.0), interval(-0.01, 0.0));
    let tree = PreimageTree::grow(&slow, &branches, trap, window, 200).unwrap();
    assert_eq!(tree.itineraries(&slow, &branches, 200), Itineraries::None);
    assert_ne!(tree.itineraries(&slow, &branches, 10), Itineraries::None);
}

/// The logistic map at r = 5: the entropy ln 2 from its pieces, its kneading sequence, and the dimension of its gaps by Bowen's equation.
#[test]
fn the_logistic_map_at_5_leaves_a_cantor_set() {
    let r = 5.0f64;
    let map = move |x: f64| Some(r * x * (1.0 - x));
    let branches = [branch(0.0, 0.5, 0.0, 0.25 * r), branch(0.5, 1.0, 0.25 * r, 0.0)];
    let (window, above) = (interval(0.0, 1.0), interval(1.0 + 1e-12, 0.25 * r));
    let tree = PreimageTree::grow_from_known(&map, &branches, above, window, 15).unwrap();
    let Itineraries::Cantor { entropy } = tree.itineraries(&map, &branches, 8) else { panic!() };
    assert!(entropy.covers(2f64.ln()) && entropy.half_width() < 1e-9, "{entropy:?}");
    let enclosed = |x: Enclosure| Enclosure::from(5.0) * x * (Enclosure::from(1.0) - x);
    let kneading = KneadingSequence::of_map(enclosed, Enclosure::from(0.5), 60);
    assert_eq!(kneading.sides()[..3], [Side::Right, Side::Left, Side::Left]);
    let by_kneading = kneading.entropy().unwrap();
    assert!(by_kneading.covers(2f64.ln()) && by_kneading.half_width() < 1e-7, "{by_kneading:?}");
    // x = ½ ∓ √(¼ − y/5), with the slope 1/(10 |x − ½|).
    let known = repeller(2, window, |k, y| {
        let root = (0.25 - y / r).sqrt();
        (if k == 0 { 0.5 - root } else { 0.5 + root }, 1.0 / (2.0 * r * root))
    })
    .unwrap();
    // Both branches have a half of each gap that contains a preimage of ½.
    let gaps: Vec<Interval> = tree.nodes().iter().skip(1).map(|node| node.interval).collect();
    let gaps = GapLengths::new(&gaps, window, 1e-11).unwrap();
    // A level shortens the gaps by 5 at most and by √5 at least: gaps shorter than 3·10⁻⁶ may be missing.
    let exponent = gaps.exponent(1e-5, 1e-2).unwrap();
    assert!((exponent - known.dimension).abs() < 0.02, "{exponent} {}", known.dimension);
    // What the levels leave shrinks by the escape rate.
    let lengths = tree.lengths();
    let left = |level: usize| 1.0 - lengths[1..=level].iter().sum::<f64>();
    let rate = (left(7) / left(11)).ln() / 4.0;
    assert!((rate - known.escape_rate).abs() < 1e-3, "{rate} {}", known.escape_rate);
}

/// Cantor's set, and one of length ½: in step n the middle 4⁻ⁿ of each part is taken away.
#[test]
fn gaps_give_dimension_and_length() {
    fn gaps(
        part: Interval,
        step: i32,
        last: i32,
        gap: &dyn Fn(i32, f64) -> f64,
        into: &mut Vec<Interval>,
    ) {
        let (middle, half) = (0.5 * (part.left + part.right), 0.5 * gap(step, part.length()));
        into.push(interval(middle - half, middle + half));
        if step < last {
            gaps(interval(part.left, middle - half), step + 1, last, gap, into);
            gaps(interval(middle + half, part.right), step + 1, last, gap, into);
        }
    }
    let all = |gap: &dyn Fn(i32, f64) -> f64, last| {
        let mut found = Vec::new();
        gaps(interval(0.0, 1.0), 1, last, gap, &mut found);
        GapLengths::new(&found, interval(0.0, 1.0), 0.0).unwrap()
    };
    let thirds = all(&|_, length| length / 3.0, 14);
    // From a power of three to another one the law is exact.
    let exponent = thirds.exponent(0.99 * 3f64.powi(-13), 0.99 * 3f64.powi(-3)).unwrap();
    assert!((exponent - 2f64.ln() / 3f64.ln()).abs() < 0.02, "{exponent}");
    assert!((thirds.left() - (2.0f64 / 3.0).powi(14)).abs() < 1e-12);
    let fat = all(&|step, _| 0.25f64.powi(step), 14);
    let exponent = fat.exponent(0.99 * 0.25f64.powi(13), 0.99 * 0.25f64.powi(3)).unwrap();
    assert!((exponent - 0.5).abs() < 0.02, "{exponent}");
    let length = fat.length_of_set(0.5 * 0.5f64.powi(14), 0.5).unwrap();
    assert!(length.covers(0.5) && length.half_width() < 1e-4, "{length:?}");
    // Gaps that overlap, ranges and factors without a meaning.
    let overlap = [interval(0.0, 0.5), interval(0.4, 0.6)];
    assert!(GapLengths::new(&overlap, interval(0.0, 1.0), 0.0).is_err());
    let touching = [interval(0.2, 0.5), interval(0.5 + 1e-16, 0.6)];
    let touching = |resolution| GapLengths::new(&touching, interval(0.0, 1.0), resolution);
    assert_eq!(touching(1e-12).unwrap().lengths().len(), 1);
    assert!(touching(-1.0).is_err() && touching(f64::NAN).is_err());
    assert!(fat.exponent(1e-3, 1e-3).is_err() && fat.exponent(0.1, 0.5).is_err());
    assert!(fat.length_of_set(1.0, 1.0).is_err() && fat.length_of_set(-1.0, 0.5).is_err());
    // Only the part of a gap in the window counts.
    let half = GapLengths::new(&[interval(0.25, 2.0)], interval(0.0, 1.0), 0.0).unwrap();
    assert_eq!((half.lengths(), half.left(), half.longer(0.75)), (&[0.75][..], 0.25, 0));
}

#[test]
fn kneading_sequences_with_known_entropies() {
    let logistic = |r: f64, most| {
        // A square has a sharp enclosure, a product x (1 − x) has not.
        let map = move |x: Enclosure| Enclosure::from(r) * ((x - 0.5).squared() * -1.0 + 0.25);
        KneadingSequence::of_map(map, Enclosure::from(0.5), most)
    };
    let full = logistic(4.0, 100).entropy().unwrap();
    assert!(full.covers(2f64.ln()) && full.half_width() < 1e-7, "{full:?}");
    // An attracting cycle of two points, both on the right: no entropy.
    let cycle = logistic(3.2, 2000);
    assert!(cycle.sides().iter().all(|side| *side == Side::Right) && cycle.sides().len() == 2000);
    let none = cycle.entropy().unwrap();
    assert!(none.lower == 0.0 && none.upper < 0.01, "{none:?}");
    // A critical point of period three: the golden ratio.
    let three = [Side::Right, Side::Left, Side::Centre, Side::Right];
    let three = KneadingSequence::from_sides(&three);
    let golden = (0.5 * (1.0 + 5f64.sqrt())).ln();
    let entropy = three.entropy().unwrap();
    assert!(three.sides().len() == 3 && entropy.covers(golden) && entropy.half_width() < 1e-12);
    // At r = 2 the critical point is fixed.
    let fixed = KneadingSequence::from_sides(&[Side::Centre]).entropy().unwrap();
    assert!(fixed.lower == 0.0 && fixed.upper < 1e-12, "{fixed:?}");
    // With enclosures that is not decided.
    assert!(logistic(2.0, 10).sides().is_empty());
    assert!(KneadingSequence::from_sides(&[]).entropy().is_err());
}

proptest! {
    /// The tent map of slope s has the entropy ln s, as far as the proved sides say.
    #[test]
    fn tent_maps_have_the_entropy_of_their_slope(s in 1.05..2.0f64) {
        let map = |x: Enclosure| match x.high() <= 0.5 {
            true => Enclosure::from(s) * x,
            false => Enclosure::from(s) * (Enclosure::from(1.0) - x),
        };
        let found = KneadingSequence::of_map(map, Enclosure::from(0.5), 500);
        let entropy = found.entropy().unwrap();
        prop_assert!(entropy.covers(s.ln()), "{} {:?}", s.ln(), entropy);
        if s > 1.5 {
            prop_assert!(entropy.half_width() < 1e-6, "{:?} {}", entropy, found.sides().len());
        }
    }
}
