//! What has no value says which part of the formula, and where.

use equations::{Binary, Constant, Error, Formulas, Names, Node, Series, Unary};
use interval_arithmetic::Enclosure;

fn formulas(texts: &[&str]) -> Formulas {
    Formulas::from_text(Names::new(&["x", "v"], &[("a", "0.5")]).unwrap(), texts).unwrap()
}

#[test]
fn a_part_without_a_value_is_named() {
    for (text, part) in [
        ("1 + ln(x - 3)", "ln(x - 3)"),
        ("sqrt(a - x)*v", "sqrt(a - x)"),
        ("v/(x - 2)", "v/(x - 2)"),
        ("2*asin(x)", "asin(x)"),
        ("exp(1000*x)*2", "exp(1000*x)"),
        ("(-x)^v", "(-x)^v"),
        ("atan2(v - 1, x - 2)", "atan2(v - 1, x - 2)"),
        ("min(ln(-x), 1)", "ln(-x)"),
    ] {
        let start = [2.0, 1.0];
        let enclosed = start.map(Enclosure::from);
        for error in [
            formulas(&[text]).values(0.25, &start).unwrap_err(),
            formulas(&[text]).enclosures(Enclosure::from(0.25), &enclosed).unwrap_err(),
        ] {
            match &error {
                Error::NoValue { part: found, time, state, .. } => {
                    assert_eq!(found, part, "{text}");
                    assert!(
                        time.contains("0.25") && state.contains("2.0") && state.contains("1.0"),
                        "{error}"
                    );
                }
                other => panic!("{text}: {other}"),
            }
        }
    }
}

/// An enclosure that only touches the outside of a domain is no value, either.
#[test]
fn an_enclosure_that_leaves_a_domain_is_refused() {
    let at = |low, high| [Enclosure::new(low, high), Enclosure::ONE];
    let logarithm = formulas(&["ln(x)"]);
    assert!(logarithm.enclosures(Enclosure::ZERO, &at(1.0, 2.0)).is_ok());
    assert!(logarithm.enclosures(Enclosure::ZERO, &at(-0.1, 2.0)).is_err());
    assert!(formulas(&["v/x"]).enclosures(Enclosure::ZERO, &at(-1.0, 1.0)).is_err());
    // A refusal inside stays one: nothing makes a bound of it.
    for text in
        ["0*ln(x)", "min(ln(x), 1)", "atan(ln(x))", "max(1, v/x)", "ln(x)^2", "ln(x) - ln(x)"]
    {
        let found = formulas(&[text]).enclosures(Enclosure::ZERO, &at(-1.0, 1.0));
        assert!(matches!(found, Err(Error::NoValue { .. })), "{text}: {found:?}");
    }
}

/// What is infinite on the way leaves no trace in the result, and is refused.
#[test]
fn a_part_that_is_infinite_is_refused() {
    for (text, part) in [
        ("min(1/x, 5)", "1/x"),
        ("max(ln(x), 5)", "ln(x)"),
        ("atan(1/x)", "1/x"),
        ("1/(1/x)", "1/x"),
        ("exp(ln(x))", "ln(x)"),
        ("sign(atanh(x - 1))", "atanh(x - 1)"),
        ("(x + 1e103)^-3", "(x + 1e103)*(x + 1e103)^2"),
        ("1/(1 + exp(800 - x))", "exp(800 - x)"),
    ] {
        match formulas(&[text]).values(0.0, &[0.0, 1.0]) {
            Err(Error::NoValue { part: found, .. }) => assert_eq!(found, part),
            other => panic!("{text}: {other:?}"),
        }
        let found = formulas(&[text])
            .enclosures(Enclosure::ZERO, &[Enclosure::new(0.0, 1e-3), Enclosure::ONE]);
        assert!(matches!(found, Err(Error::NoValue { .. })), "{text}: {found:?}");
    }
    // A state that is none is refused also where no formula has it.
    for state in [[f64::NAN, 0.0], [0.0, f64::INFINITY]] {
        assert!(matches!(formulas(&["t"]).values(0.0, &state), Err(Error::NoValue { .. })));
        let series = Series::new(&formulas(&["1", "t"]), None).unwrap();
        assert!(matches!(series.coefficients(0.0, &state, 2), Err(Error::NoValue { .. })));
    }
    assert!(formulas(&["x"]).values(f64::NAN, &[0.0, 0.0]).is_err());
}

/// A symbol of another closure, and numbers that are none.
#[test]
fn closures_with_foreign_symbols_or_numbers_are_refused() {
    let names = || Names::new(&["x"], &[]).unwrap();
    let nested = Formulas::new(names(), |_, outer, _| {
        let inner = Formulas::new(names(), |_, inner, _| {
            let _ = outer[0] + inner[0].sin();
            [inner[0]]
        });
        assert!(inner.is_ok());
        [outer[0]]
    });
    assert_eq!(nested, Err(Error::Foreign));
    for value in [f64::NAN, f64::INFINITY] {
        let found = Formulas::new(names(), |_, x, _| [x[0] * value]);
        assert!(matches!(found, Err(Error::Number { .. })), "{found:?}");
        assert!(matches!(
            formulas(&["x"]).derivative(&[value, 0.0], &[0.0]),
            Err(Error::Number { .. })
        ));
    }
    let wrong =
        Names { states: vec!["x".into()], parameters: vec!["a".into()], ..Names::default() };
    assert!(matches!(Formulas::from_text(wrong, &["x"]), Err(Error::Length { .. })));
    let series = Series::new(&formulas(&["v", "-x"]), None).unwrap();
    assert!(matches!(series.coefficients(0.0, &[1.0, 0.0], usize::MAX), Err(Error::Order { .. })));
}

/// What does not move has a series also where its function has none.
#[test]
fn parts_that_do_not_move_are_numbers_of_a_series() {
    let field = formulas(&["abs(a)*x", "min(a, 3)*sqrt(0*a)*acosh(1)"]);
    let found = Series::new(&field, None).unwrap().coefficients(0.0, &[1.0, 2.0], 3).unwrap();
    assert_eq!(found.state(0)[..3], [1.0, 0.5, 0.125]);
    assert_eq!(found.state(1), [2.0, 0.0, 0.0, 0.0]);
}

/// Far from zero a smooth switch is flat.
#[test]
fn tanh_has_a_series_far_from_zero() {
    let field = formulas(&["-tanh(x)", "0"]);
    let found = Series::new(&field, None).unwrap().coefficients(0.0, &[800.0, 0.0], 4).unwrap();
    assert_eq!(found.state(0), [800.0, -1.0, 0.0, 0.0, 0.0]);
    let second = formulas(&["tanh(x)"]).derivative(&[1.0, 0.0], &[0.0]).unwrap();
    let second = second.derivative(&[1.0, 0.0], &[0.0]).unwrap();
    assert!(second.values(0.0, &[400.0, 0.0]).unwrap()[0].abs() < 1e-300);
}

#[test]
fn kinks_have_no_derivative_and_no_series() {
    for text in ["abs(x)", "sign(x)*v", "min(x, v)", "x + max(v, 0)^2"] {
        let watched = formulas(&[text]);
        let error = watched.derivative(&[1.0, 1.0], &[0.0]).unwrap_err().to_string();
        assert!(error.contains("make it a guard"), "{error}");
        assert!(matches!(Series::new(&formulas(&["v", text]), None), Err(Error::Kink { .. })));
    }
    // A kink of what does not move has no effect on the derivative.
    let fixed = formulas(&["x*abs(a)"]).derivative(&[1.0, 0.0], &[0.0]).unwrap();
    assert_eq!(fixed.values(0.0, &[3.0, 0.0]).unwrap(), [0.5]);
}

#[test]
fn a_root_at_zero_has_a_value_and_no_series() {
    let field = formulas(&["sqrt(x)", "1"]);
    assert_eq!(field.values(0.0, &[0.0, 0.0]).unwrap(), [0.0, 1.0]);
    let error = Series::new(&field, None).unwrap().coefficients(0.0, &[0.0, 0.0], 3).unwrap_err();
    assert!(
        error.to_string().contains("sqrt(x) has no finite value, or no finite derivative"),
        "{error}"
    );
}

#[test]
fn lengths_and_names_are_checked() {
    let field = formulas(&["v", "-x"]);
    let error = field.values(0.0, &[1.0]).unwrap_err().to_string();
    assert_eq!(error, "2 components of the state are needed, and 1 are given");
    for (times, x, v) in [(2, 1, 1), (1, 1, 2), (0, 3, 3)] {
        let found = field.columns(&vec![0.0; times], &[&vec![1.0; x], &vec![2.0; v]]);
        assert!(matches!(found, Err(Error::Length { .. })), "{found:?}");
    }
    assert!(matches!(field.columns(&[0.0], &[&[1.0]]), Err(Error::Length { .. })));
    assert_eq!(field.columns(&[], &[&[], &[]]).unwrap().values, [[], []] as [[f64; 0]; 2]);
    assert!(matches!(Series::new(&formulas(&["v"]), None), Err(Error::Length { .. })));
    assert!(matches!(field.derivative(&[1.0], &[0.0]), Err(Error::Length { .. })));
    let names = Names::new(&["x"], &[]).unwrap();
    let error = Formulas::new(names.clone(), |_, x, p| [x[0] * p["drag"]]).unwrap_err();
    assert_eq!(error.to_string(), "the name \"drag\" is no parameter of these formulas");
    let other = Formulas::from_text(names, &["x"]).unwrap();
    assert!(matches!(Series::new(&field, Some(&other)), Err(Error::Name { .. })));
}

/// A component that the state does not have is an error value, as a parameter that there is none: no panic.
#[test]
fn components_beyond_the_state_are_refused() {
    let names = || Names::new(&["x", "v"], &[]).unwrap();
    let refused = |formulas: Result<Formulas, Error>| formulas.unwrap_err().to_string();
    let one = refused(Formulas::new(names(), |_, x, _| [x[1] + x[5]]));
    assert!(one.contains('6') && one.contains('2'), "{one}");
    let some = refused(Formulas::new(names(), |_, x, p| [p.sum(x[1..4].iter().copied())]));
    assert!(some.contains('4') && some.contains('2'), "{some}");
    assert!(
        refused(Formulas::new(names(), |_, x, p| [p.sum(x[3..].iter().copied())])).contains('4')
    );
    assert!(Formulas::new(names(), |_, x, p| [p.sum(x[..=1].iter().copied()) + x[1]]).is_ok());
}

/// A list of parts gives the formulas of the same text; one that refers to what is not there is refused.
#[test]
fn a_list_of_parts_is_checked() {
    let names = || Names::new(&["x", "v"], &[("a", "0.5")]).unwrap();
    let number = |value: f64| Node::Constant(value.into());
    let parts = [
        Node::State(0),
        number(-2.0),
        Node::Binary(Binary::Power, 0, 1),
        Node::State(0),
        Node::Parameter(0),
        Node::Binary(Binary::Product, 4, 3),
        Node::Unary(Unary::Sine, 5),
        Node::Time,
        Node::Binary(Binary::Sum, 6, 7),
    ];
    let made = Formulas::of_nodes(names(), &parts, &[2, 8]).unwrap();
    let written = Formulas::from_text(names(), &["x^(-2)", "sin(a*x) + t"]).unwrap();
    assert_eq!(made.values(0.25, &[-3.0, 1.0]), written.values(0.25, &[-3.0, 1.0]));
    assert_eq!(made.values(0.0, &[-3.0, 1.0]).unwrap()[0], 1.0 / 9.0);
    // Equal parts are one.
    assert_eq!(made.nodes().0.iter().filter(|node| **node == Node::State(0)).count(), 1);
    let refused = |parts: &[Node], outputs: &[usize]| {
        Formulas::of_nodes(names(), parts, outputs).unwrap_err()
    };
    for (parts, needed, given) in [
        (vec![Node::Unary(Unary::Sine, 0)], 1, 0),
        (vec![Node::Time, Node::Binary(Binary::Sum, 0, usize::MAX)], usize::MAX, 1),
        (vec![Node::State(2)], 3, 2),
        (vec![Node::Parameter(1)], 2, 1),
        (vec![], 1, 0),
    ] {
        match refused(&parts, &[0]) {
            Error::Length { needed: n, given: g, .. } => assert_eq!((n, g), (needed, given)),
            other => panic!("{other}"),
        }
    }
    let bad = Constant::Double(f64::INFINITY.to_bits());
    assert!(matches!(refused(&[Node::Constant(bad)], &[0]), Error::Number { .. }));
}
