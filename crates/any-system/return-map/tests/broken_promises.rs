//! Maps that do not keep what they promise, and numbers that are too large: errors, and no wrong answers.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use return_map::{
    BranchSteps, Error, Image, ManifoldSteps, MapFamily, PeriodicAttractor, UnstableManifold,
    family, follow_branch, lyapunov_exponents, manifold_crossings, map_pieces, orbit_fate,
    rotation_number, scalar_family,
};
use std::ops::ControlFlow::Continue;

/// It has two components, and gives one or three.
struct Wrong(usize);

impl MapFamily for Wrong {
    fn dimension(&self) -> usize {
        2
    }
    fn image(&self, _: &[f64], _: f64) -> Result<Image, Error> {
        Ok(Image::of_number(vec![0.5; self.0], None))
    }
}

/// It has one component, and gives none.
struct Nothing;

impl MapFamily for Nothing {
    fn dimension(&self) -> usize {
        1
    }
    fn image(&self, _: &[f64], _: f64) -> Result<Image, Error> {
        Ok(Image::of_number(Vec::new(), None))
    }
}

#[test]
fn images_of_another_length() {
    for length in [0, 1, 3] {
        let map = Wrong(length);
        let start = (&[0.3, 0.3][..], 0.0);
        let steps = BranchSteps::default();
        assert!(follow_branch(&map, 1, start, (-1.0, 1.0), steps, |_| Continue(())).is_err());
        assert!(lyapunov_exponents(&map, start, 10, 100).is_err());
        assert!(rotation_number(&map, start, 10, 100, |x, y| x[0] - y[0]).is_err());
        assert!(UnstableManifold::new(&map, 1, start, 1.0).is_err());
        assert!(PeriodicAttractor::new(&map, 1, start).is_err());
        orbit_fate(&map, start, &[], 10);
    }
    let pieces = map_pieces(&Nothing, 0.0, (0.0, 1.0), 10);
    assert!(pieces.is_ok_and(|pieces| pieces.pieces.is_empty()));
}

/// A kink that the map does not name is an end of laps.
#[test]
fn an_unnamed_kink() {
    let tent = scalar_family(|x, p| p * x.min(1.0 - x));
    let found = map_pieces(&tent, 1.8, (0.0, 1.0), 10).unwrap();
    let [piece] = &found.pieces[..] else { panic!("{found:?}") };
    let [top] = &piece.extrema[..] else { panic!("{piece:?}") };
    assert!((top.at - 0.5).abs() < 1e-7 && top.is_maximum, "{top:?}");
    assert_eq!(piece.laps().len(), 2);
}

/// Manifolds that coincide do not cross.
#[test]
fn coinciding_manifolds() {
    let map = family(2, |x: &[f64], _| Ok(vec![2.0 * x[0], 0.5 * x[1]]));
    let one = UnstableManifold::new(&map, 1, (&[0.0, 0.0], 0.0), 1.0).unwrap();
    let same = family(2, |x: &[f64], _| Ok(vec![3.0 * x[0], 0.2 * x[1]]));
    let two = UnstableManifold::new(&same, 1, (&[0.0, 0.0], 0.0), 1.0).unwrap();
    let steps = ManifoldSteps { length: 5.0, ..ManifoldSteps::default() };
    let a = one.curve(&steps, |_| Continue(())).unwrap();
    let b = two.curve(&steps, |_| Continue(())).unwrap();
    let found = manifold_crossings((&one, &a), (&two, &b)).unwrap();
    assert!(found.is_empty(), "{} {:?}", found.len(), found.first());
}

/// A separatrix of an integrable map (E. McMillan): the unstable and the stable manifold are one curve.
#[test]
fn the_separatrix_of_an_integrable_map() {
    for mu in [1.2, 2.0, 4.0] {
        let forth = family(2, move |x: &[f64], _| {
            Ok(vec![x[1], -x[0] + 2.0 * mu * x[1] / (1.0 + x[1] * x[1])])
        });
        let back = family(2, move |x: &[f64], _| {
            Ok(vec![-x[1] + 2.0 * mu * x[0] / (1.0 + x[0] * x[0]), x[0]])
        });
        let one = UnstableManifold::new(&forth, 1, (&[0.0, 0.0], 0.0), 1.0).unwrap();
        let two = UnstableManifold::new(&back, 1, (&[0.0, 0.0], 0.0), 1.0).unwrap();
        let steps = ManifoldSteps { length: 6.0, ..ManifoldSteps::default() };
        let curves = [
            one.curve(&steps, |_| Continue(())).unwrap(),
            two.curve(&steps, |_| Continue(())).unwrap(),
        ];
        let found = manifold_crossings((&one, &curves[0]), (&two, &curves[1])).unwrap();
        assert!(found.is_empty(), "{mu}: {} {:?}", found.len(), found.first());
    }
}

#[test]
fn turns_without_a_sum() {
    let shift = scalar_family(|x, _| x);
    let huge = rotation_number(&shift, (&[0.3], 0.0), 0, 100, |_, _| 1e308);
    assert!(matches!(huge, Err(Error::BadArgument { .. })), "{huge:?}");
}
