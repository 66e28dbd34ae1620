//! Known answers of maps and of a flow, by derivatives of formulas: where orbits of period n are born and double, and a first
//! integral.

use equations::{Formulas, Names, Series, TaylorFlow};

/// A map with a parameter, and its Jacobian.
fn map(states: &[&str], parameter: (&str, &str), texts: &[&str]) -> [Formulas; 2] {
    let map = Formulas::from_text(Names::new(states, &[parameter]).unwrap(), texts).unwrap();
    let jacobian = map.jacobian().unwrap();
    [map, jacobian]
}

/// The point of period n near a point of the logistic map, by Newton's method, and its multiplier.
fn logistic(rate: f64, period: usize) -> f64 {
    let [map, slope] = map(&["x"], ("r", &format!("{rate}")), &["r*x*(1 - x)"]);
    let next = |x: f64| map.values(0.0, &[x]).unwrap()[0];
    // At a slightly smaller rate the orbit attracts, and is near.
    let near = format!("{}", rate - 1e-4);
    let before = map.clone().with_parameters(&[("r", &near)]).unwrap();
    let mut x = (0..200_000).fold(0.4, |x, _| before.values(0.0, &[x]).unwrap()[0]);
    let mut multiplier = 0.0;
    for _ in 0..30 {
        let orbit: Vec<f64> =
            std::iter::successors(Some(x), |x| Some(next(*x))).take(period + 1).collect();
        multiplier = orbit[..period].iter().map(|x| slope.values(0.0, &[*x]).unwrap()[0]).product();
        x -= (orbit[period] - x) / (multiplier - 1.0);
    }
    multiplier
}

#[test]
fn the_logistic_map_doubles_at_its_rates() {
    let rates = [3.0, 1.0 + 6f64.sqrt(), 3.544_090_359_6, 3.564_407_266_1];
    for (k, rate) in rates.into_iter().enumerate() {
        let multiplier = logistic(rate, 1 << k);
        // The last rates have eleven digits, and the multiplier changes the faster the longer the orbit is.
        let error = if k < 2 { 1e-12 } else { 1e-7 };
        assert!((multiplier + 1.0).abs() < error, "{rate}: {multiplier}");
    }
}

/// The determinants of J − 1 and of J + 1, for the product J of Hénon's Jacobians from the point (x, y) on, at b = 0.3: zero at
/// a fold, and at a doubling.
fn henon(a: &str, [x, y]: [f64; 2], period: i32) -> [f64; 2] {
    let [map, jacobian] = map(&["x", "y"], ("a", a), &["1 - a*x^2 + y", "0.3*x"]);
    let (mut state, mut product) = (vec![x, y], [1.0, 0.0, 0.0, 1.0]);
    for _ in 0..period {
        let j = jacobian.values(0.0, &state).unwrap();
        let [a, b, c, d] = product;
        product =
            [j[0] * a + j[1] * c, j[0] * b + j[1] * d, j[2] * a + j[3] * c, j[2] * b + j[3] * d];
        state = map.values(0.0, &state).unwrap();
    }
    assert!((state[0] - x).abs() < 1e-13 && (state[1] - y).abs() < 1e-13, "no orbit: {state:?}");
    let (trace, determinant) = (product[0] + product[3], (-0.3f64).powi(period));
    [1.0 - trace + determinant, 1.0 + trace + determinant]
}

/// A fold at a = −0.7²/4, and doublings at 3 · 0.7²/4 and 0.9125.
#[test]
fn henons_map_folds_and_doubles() {
    // a x² + 0.7 x − 1 = 0.
    let fixed = |a: f64| (-0.7 + (0.49 + 4.0 * a).max(0.0).sqrt()) / (2.0 * a);
    let [fold, doubling] = [fixed(-0.1225), fixed(0.3675)];
    assert!(henon("-0.1225", [fold, 0.3 * fold], 1)[0].abs() < 1e-12);
    assert!(henon("0.3675", [doubling, 0.3 * doubling], 1)[1].abs() < 1e-12);
    // Two points whose sum is 0.7/a, and their product 0.49/a² − 1/a.
    let a = 0.9125f64;
    let (middle, product) = (0.35 / a, 0.49 / (a * a) - 1.0 / a);
    let half = (middle * middle - product).sqrt();
    let [first, second] = [middle + half, middle - half];
    assert!(henon("0.9125", [first, 0.3 * second], 2)[1].abs() < 1e-12);
}

/// Lotka–Volterra: x − ln x + y − ln y stays.
#[test]
fn a_first_integral_stays() {
    let names = Names::new(&["x", "y"], &[]).unwrap();
    let field = Formulas::from_text(names.clone(), &["x*(1 - y)", "y*(x - 1)"]).unwrap();
    let integral = Formulas::from_text(names, &["x - ln(x) + y - ln(y)"]).unwrap();
    let series = Series::new(&field, None).unwrap();
    for (tolerance, error) in [(1e-6, 1e-4), (1e-10, 1e-8), (1e-15, 1e-13)] {
        let flow = TaylorFlow::new(&series, tolerance, tolerance).unwrap();
        let end = flow.state_at(0.0, &[3.0, 0.5], 100.0).unwrap();
        let [before, after] = [&[3.0, 0.5][..], &end].map(|x| integral.values(0.0, x).unwrap()[0]);
        assert!((after - before).abs() < error, "{tolerance:e}: {after} {before}");
    }
}
