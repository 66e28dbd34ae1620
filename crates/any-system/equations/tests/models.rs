//! Models that users write.

use equations::{Formulas, Jet, JetSeries, Names, Series};
use interval_arithmetic::Enclosure;

/// Bodies in a plane that attract each other, with the positions first: in fifteen lines.
#[test]
fn many_bodies_are_a_sum_over_the_others() {
    const BODIES: usize = 6;
    let letters = ["x", "y", "u", "v"];
    let states: Vec<String> =
        (0..4 * BODIES).map(|k| format!("{}{}", letters[k % 4], k / 4)).collect();
    let states: Vec<&str> = states.iter().map(String::as_str).collect();
    let names = Names::new(&states, &[("G", "2.95912208286e-4")]).unwrap();
    let field = Formulas::of_vector(names, |_, x, p| {
        let bodies = 0..BODIES;
        let pull = |i: usize, axis: usize| {
            p.sum(bodies.clone().filter(|&j| j != i).map(|j| {
                let [dx, dy] = [0, 1].map(|axis| x[4 * j + axis] - x[4 * i + axis]);
                let square = dx.powi(2) + dy.powi(2);
                p["G"] * [dx, dy][axis] / (square * square.sqrt())
            }))
        };
        bodies.clone().flat_map(|i| [x[4 * i + 2], x[4 * i + 3], pull(i, 0), pull(i, 1)]).collect()
    })
    .unwrap();
    // 30 pairs of thirteen parts.
    assert_eq!(field.count(), 24);
    assert!(field.parts() < 450, "{}", field.parts());
    let state: Vec<f64> = (0..24).map(|k| pxfm::f_sin(k as f64)).collect();
    let values = field.values(0.0, &state).unwrap();
    // Forces of equal masses have the sum zero.
    for axis in [2, 3] {
        let sum: f64 = (0..BODIES).map(|i| values[4 * i + axis]).sum();
        assert!(sum.abs() < 1e-17, "{sum:e}");
    }
    assert!(Series::new(&field, None).unwrap().coefficients(0.0, &state, 12).is_ok());
}

/// Kepler's orbit from its pericentre: energy and angular momentum are constant along the series, order by order.
#[test]
fn first_integrals_have_no_higher_coefficients() {
    let names = Names::new(&["x", "y", "u", "v"], &[]).unwrap();
    let field =
        Formulas::from_text(names.clone(), &["u", "v", "-x/(x^2 + y^2)^1.5", "-y/(x^2 + y^2)^1.5"]);
    let watched =
        Formulas::from_text(names, &["(u^2 + v^2)/2 - 1/sqrt(x^2 + y^2)", "x*v - y*u"]).unwrap();
    let series = Series::new(&field.unwrap(), Some(&watched)).unwrap();
    let start = [0.4, 0.0, 0.0, 2.0];
    let found = series.coefficients(0.0, &start, 15).unwrap();
    for integral in found.all_watched() {
        for (k, coefficient) in integral.iter().enumerate().skip(1) {
            // Coefficients of the motion grow like 4^k at this pericentre.
            assert!(coefficient.abs() < 1e-13 * 8f64.powi(k as i32), "{k}: {coefficient:e}");
        }
    }
    let start = start.map(Enclosure::from);
    let found = series.coefficients(Enclosure::ZERO, &start, 15).unwrap();
    for integral in found.all_watched() {
        assert!(integral.iter().skip(1).all(|coefficient| coefficient.contains(0.0)));
    }
}

/// van der Pol at μ = 5 from (2, 0): the coefficients of x, from the recurrence by hand.
#[test]
fn the_series_of_van_der_pol_is_that_of_its_recurrence() {
    let names = Names::new(&["x", "v"], &[("mu", "5")]).unwrap();
    let field =
        Formulas::new(names, |_, x, p| [x[1], p["mu"] * (1.0 - x[0].powi(2)) * x[1] - x[0]])
            .unwrap();
    let series = Series::new(&field, None).unwrap();
    let found = series.coefficients(0.0, &[2.0, 0.0], 4).unwrap();
    // x″ = −2, x‴ = 5(1 − 4)(−2) = 30, x⁗ = −15·30 + 2 − 5·2·2·0·… = −450 + 2.
    assert_eq!(found.state(0)[..4], [2.0, 0.0, -1.0, 5.0]);
    assert!((found.state(0)[4] + 448.0 / 24.0).abs() < 1e-14);
}

/// A model at other parameters is the same formulas.
#[test]
fn parameters_are_changed_by_name() {
    let names = Names::new(&["x"], &[("a", "0.2"), ("b", "3")]).unwrap();
    let map = Formulas::new(names, |_, x, p| [p["a"] * x[0] + p["b"]]).unwrap();
    let other = map.clone().with_parameters(&[("a", "-1.5")]).unwrap();
    assert_eq!(other.values(0.0, &[2.0]).unwrap(), [0.0]);
    assert_eq!(map.values(0.0, &[2.0]).unwrap(), [3.4]);
    assert!(map.clone().with_parameters(&[("c", "1")]).is_err());
    assert!(map.clone().with_parameters(&[("a", "x")]).is_err());
    // A fifth is no f64, and its enclosure knows.
    let found = map.enclosures(Enclosure::ZERO, &[Enclosure::ONE]).unwrap()[0];
    assert!(found.low() < 3.2 && 3.2 < found.high().next_up());
    assert_eq!(map.parameter_jacobian().unwrap().values(0.0, &[2.0]).unwrap(), [2.0, 1.0]);
}

/// Ten thousand parts have second derivatives of some ten times as many.
#[test]
fn second_derivatives_grow_by_a_factor() {
    let names = Names::new(&["x"], &[]).unwrap();
    let chain = Formulas::new(names, |_, x, _| {
        let mut y = x[0];
        for k in 0..3400 {
            y = (y * 0.999 + f64::from(k) * 1e-4).sin();
        }
        [y]
    })
    .unwrap();
    assert!(chain.parts() > 10_000);
    let second = chain.derivative(&[1.0], &[]).unwrap().derivative(&[1.0], &[]).unwrap();
    assert!(second.parts() < 10 * chain.parts(), "{}", second.parts());
    assert!(second.values(0.0, &[0.3]).unwrap()[0].is_finite());
}

/// LaTeX says what is meant: factors, exponents of fractions, signs, doubles.
#[test]
fn latex_is_not_ambiguous() {
    let names = Names::new(&["x", "y", "a__", "b_"], &[]).unwrap();
    for (text, known) in [
        ("2*3", r"2 \cdot 3"),
        ("(x/y)^2", r"{\left(\frac{x}{y}\right)}^{2}"),
        ("2*(1/2)*x", r"2 \cdot \left(\frac{1}{2}\right) \cdot x"),
        ("--x", r"-\left(-x\right)"),
        ("f64(0.1)*x", r"\left(1.0000000000000001 \cdot 10^{-1}\right) \cdot x"),
        ("1e-3 + x", r"1 \cdot 10^{-3} + x"),
        ("a__ + b_", r"a_{\mathrm{\_}} + \mathrm{b\_}"),
        ("pi*e", r"\pi \cdot \mathrm{e}"),
    ] {
        let formulas = Formulas::from_text(names.clone(), &[text]).unwrap();
        assert_eq!(formulas.latex(), [known], "{text}");
    }
}

#[test]
fn formulas_are_written_as_they_are_read() {
    let names = Names::new(&["x", "x_max"], &[("mu", "0.1")]).unwrap();
    for text in [
        "x^2 - (mu + x_max)*t",
        "-(x + 1)^2/(2*x_max)",
        "x - (x_max - mu)",
        "x/(x_max*mu)",
        "(x/x_max)*mu",
        "-x*x_max",
        "2^(-x)",
        "sqrt(x)*atan2(x, x_max + 1)",
        "f64(1.0000000000000001e-1)*x",
        "0.1*x + 1.5e-3",
        "pi*e*t",
        "(x^2)^x",
        "(-x)^2",
    ] {
        let formulas = Formulas::from_text(names.clone(), &[text]).unwrap();
        let again = Formulas::from_text(names.clone(), &[&formulas.texts()[0]]).unwrap();
        assert_eq!(formulas, again, "{text}: {}", formulas.texts()[0]);
        assert_eq!(Formulas::from_json(&formulas.to_json()).unwrap(), formulas);
    }
    let written = Formulas::from_text(names, &["-sin(mu*x_max)/(1 + x^2)"]).unwrap();
    assert_eq!(written.texts(), ["-sin(mu*x_max)/(1 + x^2)"]);
    let known = r"-\operatorname{sin}\left(\mathrm{mu} \cdot x_{\mathrm{max}}\right)";
    assert_eq!(written.latex(), [format!(r"\frac{{{known}}}{{1 + {{x}}^{{2}}}}")]);
}

/// Directional derivatives of a formula with many functions, to the third order, by jets and by formulas.
#[test]
fn jets_have_the_derivatives_of_the_formulas() {
    let names = Names::new(&["v", "x"], &[("a", "0.7")]).unwrap();
    let texts = [
        "sin(a*x)*exp(-v) + atan2(x, v)",
        "sqrt(x + v^2)/(a + cosh(x*v)) + x^a + ln(x)*tanh(v)",
        "asin(x/9) + a^v + (x*v)^1.5 + atan(x)*acos(v/7)",
    ];
    let formulas = Formulas::from_text(names, &texts).unwrap();
    let jets = JetSeries::of_values(&formulas).unwrap();
    let (state, direction) = ([1.3, 0.6], [0.4, -1.1, 0.9]);
    let start = [Jet::moving(1.3, 0.4), Jet::moving(0.6, -1.1), Jet::<4>::moving(0.7, 0.9)];
    let found = jets.values(&start).unwrap();
    let (mut derivative, mut factorial) = (formulas, 1.0);
    for k in 0..4 {
        let exact = derivative.values(0.0, &state).unwrap();
        for (jet, exact) in found.iter().zip(exact) {
            assert!((jet.0[k] - exact / factorial).abs() < 1e-13 * (1.0 + exact.abs()), "{k}");
        }
        derivative = derivative.derivative(&direction[..2], &direction[2..]).unwrap();
        factorial *= (k + 1) as f64;
    }
}
