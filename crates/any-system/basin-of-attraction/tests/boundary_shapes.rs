//! Smooth and fractal boundaries by the entropy of random balls, at several radii.

use super::cantor::{cantor_label, interval};
use basin_of_attraction::{
    BallEntropy, BoundaryShape, Error, Hyperrectangle, Label, RandomBalls, ball_entropy,
};

fn found(dimension: usize, radius: f64, label: &(impl Fn(&[f64]) -> Label + Sync)) -> BallEntropy {
    let region = Hyperrectangle::new(vec![interval(0.0, 1.0); dimension]).unwrap();
    let balls = RandomBalls { radius, balls: 4000, points: 100, seed: 2 };
    ball_entropy(&region, balls, label).unwrap()
}

/// Stripes of four labels and the width 0.02: smooth, but not for balls that are larger than a stripe.
#[test]
fn thin_stripes_look_smooth_to_small_balls_only() {
    let stripes = |x: &[f64]| Label::from((x[0] / 0.02) as u8 % 4);
    assert_eq!(found(2, 0.001, &stripes).shape(), BoundaryShape::LooksSmooth);
    let large = found(2, 0.1, &stripes);
    assert_eq!(large.shape(), BoundaryShape::NotSmooth);
    assert!(large.mean.lower > 2f64.ln(), "{large:?}");
}

/// The Cantor basin of three colours looks the same at every scale. That of two colours has almost the entropy of a
/// smooth boundary: 4000 balls of radius 0.01 do not tell them apart.
#[test]
fn a_cantor_basin_of_three_colours_is_not_smooth_at_any_radius() {
    for radius in [0.1, 0.01, 0.001] {
        let three = found(1, radius, &|x: &[f64]| cantor_label(x[0], 3));
        assert_eq!(three.shape(), BoundaryShape::NotSmooth, "{radius}: {three:?}");
        assert!(three.mean.lower > 0.55, "{radius}: {three:?}");
    }
    let two = found(1, 0.01, &|x: &[f64]| cantor_label(x[0], 2));
    assert_eq!(two.shape(), BoundaryShape::LooksSmooth, "{two:?}");
}

#[test]
fn undecided_balls_are_left_out_and_too_few_balls_are_refused() {
    let label = |x: &[f64]| match x[1] {
        ..0.5 => Label::UNDECIDED,
        _ => Label::from(x[0] > 0.5),
    };
    let half = found(2, 0.05, &label);
    assert!((1800..2400).contains(&half.left_out), "{half:?}");
    assert_eq!(half.shape(), BoundaryShape::LooksSmooth);
    let region = Hyperrectangle::new(vec![interval(0.0, 1.0)]).unwrap();
    let balls = RandomBalls { radius: 0.05, balls: 100, points: 50, seed: 2 };
    let none = ball_entropy(&region, balls, |_: &[f64]| Label::from(0));
    assert_eq!(none, Err(Error::TooFewMixedBalls { mixed: 0, balls: 100, fewest: 30 }));
    for radius in [0.0, -1.0, f64::NAN, 0.5, f64::INFINITY] {
        let bad =
            ball_entropy(&region, RandomBalls { radius, ..balls }, |_: &[f64]| Label::from(0));
        assert!(matches!(bad, Err(Error::BadBalls { .. })), "{radius}");
    }
    let many = RandomBalls { balls: usize::MAX, ..balls };
    let error = ball_entropy(&region, many, |_: &[f64]| Label::from(0));
    assert!(matches!(error, Err(Error::TooManySamples { .. })));
}
