//! Functions that a user brings, and values with names.

use equations::{Enclosure, Error, Formulas, Function, Jet, JetSeries, Names, Series};

/// The sine as a user would bring it, with the cosine as its derivative by the user's own hands.
fn own_sine() -> Function {
    let enclosure = |x: Enclosure| Some(x.sin());
    Function::new("own", |x| Enclosure::from(x).sin().middle(), enclosure, |x, _| x.cos()).unwrap()
}

#[test]
fn a_brought_function_is_what_it_says_in_every_evaluator() {
    let own = own_sine();
    let names = Names::new(&["x", "v"], &[]).unwrap();
    let with_own = names.clone().with_functions(std::slice::from_ref(&own)).unwrap();
    let field = Formulas::from_text(with_own, &["v", "-own(x)*own(x + v)"]).unwrap();
    let exact = Formulas::from_text(names.clone(), &["v", "-sin(x)*sin(x + v)"]).unwrap();
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-13 * (1.0 + b.abs()), "{a} {b}");
    let state = [0.7, -0.4];
    for (a, b) in field.values(0.0, &state).unwrap().iter().zip(exact.values(0.0, &state).unwrap())
    {
        near(*a, b);
    }
    let [found, known] =
        [&field, &exact].map(|f| f.jacobian().unwrap().values(0.0, &state).unwrap());
    found.iter().zip(known).for_each(|(a, b)| near(*a, b));
    let series =
        |f: &Formulas| Series::new(f, None).unwrap().coefficients(0.0, &state, 12).unwrap();
    for (a, b) in series(&field).state(0).iter().zip(series(&exact).state(0)) {
        near(*a, *b);
    }
    let jets = |f: &Formulas| {
        let start = [Jet::<3>::moving(0.7, 1.0), Jet::moving(-0.4, 0.5)];
        JetSeries::new(f, None).unwrap().coefficients(&start, 4).unwrap().state(0).to_vec()
    };
    for (a, b) in jets(&field).iter().zip(jets(&exact)) {
        a.0.iter().zip(b.0).for_each(|(a, b)| near(*a, b));
    }
    let wide = [Enclosure::new(0.6, 0.8), Enclosure::from(-0.4)];
    let enclosed = field.enclosures(Enclosure::ZERO, &wide).unwrap()[1];
    assert!(enclosed.contains(exact.values(0.0, &state).unwrap()[1]) && enclosed.width() < 0.2);
    let columns = field.columns(&[0.0], &[&[0.7; 11], &[-0.4; 11]]).unwrap();
    assert_eq!(columns.values[1], vec![field.values(0.0, &state).unwrap()[1]; 11]);
    // As data it has its name: a reader gives the function.
    let json = field.to_json();
    assert_eq!(Formulas::from_json_with(&json, &[own]).unwrap(), field);
    let error = Formulas::from_json(&json).unwrap_err().to_string();
    assert!(error.contains("own") && error.contains("give it"), "{error}");
    assert_eq!(
        field.latex()[1],
        "-\\operatorname{own}\\left(x\\right) \\cdot \\operatorname{own}\\left(x + v\\right)"
    );
}

#[test]
fn names_of_functions_are_theirs_alone() {
    let [one, two] = [own_sine(), own_sine()];
    let names = Names::new(&["own"], &[]).unwrap();
    assert!(matches!(names.with_functions(std::slice::from_ref(&one)), Err(Error::Name { .. })));
    let wrong = |name: &str| Function::new(name, |x| x, Some, |x, _| x.number(1.0));
    assert!(wrong("sin").is_err() && wrong("t").is_err() && wrong("2x").is_err());
    let names = Names::new(&["x"], &[]).unwrap();
    let both = Formulas::new(names.clone(), |_, x, _| [one.of(x[0]) + two.of(x[0])]);
    assert!(both.unwrap_err().to_string().contains("two functions"));
    // A function whose derivative makes it anew, and one of a family without end.
    fn anew() -> Function {
        Function::new("anew", |x| x, |_| None, |x, _| anew().of(x)).unwrap()
    }
    fn bessel(order: u32) -> Function {
        let name = format!("J{order}");
        let number = f64::from(order);
        Function::new(&name, |x| x, |_| None, move |x, j| number * j / x - bessel(order + 1).of(x))
            .unwrap()
    }
    let of = |function: Function| Formulas::new(names.clone(), move |_, x, _| [function.of(x[0])]);
    let error = Series::new(&of(anew()).unwrap(), None).unwrap_err().to_string();
    assert!(error.contains("make a function once"), "{error}");
    assert!(matches!(
        Series::new(&of(bessel(9)).unwrap(), None),
        Err(Error::TooLarge { .. } | Error::Name { .. })
    ));
    // A derivative that is no number, and a domain that ends.
    let bad = Function::new("bad", |x| x, Some, |x, _| x.number(f64::NAN)).unwrap();
    let of_bad = Formulas::new(names.clone(), |_, x, _| [bad.of(x[0])]).unwrap();
    assert!(of_bad.jacobian().is_err() && Series::new(&of_bad, None).is_err());
    let half = Function::new(
        "half",
        |x| Enclosure::from(x).ln().map_or(f64::NAN, |ln| ln.middle()),
        |x| x.ln(),
        |x, _| 1.0 / x,
    )
    .unwrap();
    let of_half = Formulas::new(names, |_, x, _| [half.of(x[0])]).unwrap();
    let error = of_half.values(0.0, &[-1.0]).unwrap_err().to_string();
    assert!(error.contains("half(x)"), "{error}");
    assert!(of_half.enclosures(Enclosure::ZERO, &[Enclosure::new(-1.0, 1.0)]).is_err());
}

#[test]
fn values_with_names_are_used_by_later_texts() {
    let names = Names::new(&["x", "y"], &[("a", "2")]).unwrap();
    let read = |texts: &[&str]| Formulas::from_text(names.clone(), texts);
    let found = read(&["r2 = x^2 + y^2", "s = a*r2", "s + r2", "s/r2"]).unwrap();
    assert_eq!(found.texts(), ["a*(x^2 + y^2) + (x^2 + y^2)", "a*(x^2 + y^2)/(x^2 + y^2)"]);
    assert_eq!(found.values(0.0, &[3.0, 4.0]).unwrap(), [75.0, 2.0]);
    assert_eq!(read(&["a꩐=0"]).unwrap().count(), 0);
    for (texts, part) in [
        (&["x = 3", "x"][..], "column 1"),
        (&["r = 1", "r = 2", "r"], "r has a meaning already"),
        (&[" sin = 2", "x"], "column 2"),
        (&["= 2"], "column 1"),
        (&["r = ", "r"], "at the end"),
        (&["r", "r = 2"], "no variable or parameter"),
        (&["x == 2"], "x has a meaning already"),
    ] {
        let error = read(texts).unwrap_err().to_string();
        assert!(error.contains(part), "{texts:?}: {error}");
    }
}

/// A linear system by its matrix, of numbers or of symbols: the rates of a chain of three masses.
#[test]
fn matrices_are_arrays() {
    let names = Names::new(&["a", "b", "c", "u", "v", "w"], &[("k", "4")]).unwrap();
    let chain = Formulas::new(names, |_, x, p| {
        let stiffness = [[-2.0, 1.0, 0.0], [1.0, -2.0, 1.0], [0.0, 1.0, -2.0]];
        let [du, dv, dw] = p.product(&stiffness, &x[..3]).map(|pull| p["k"] * pull);
        [x[3], x[4], x[5], du, dv, dw]
    });
    let rates = chain.unwrap().values(0.0, &[1.0, 2.0, 4.0, 7.0, 8.0, 9.0]).unwrap();
    assert_eq!(rates, [7.0, 8.0, 9.0, 0.0, 4.0, -24.0]);
    let names = Names::new(&["x", "y"], &[("angle", "0.5")]).unwrap();
    let turned = Formulas::new(names.clone(), |_, x, p| {
        let (cos, sin) = (p["angle"].cos(), p["angle"].sin());
        p.product(&[[cos, -sin], [sin, cos]], x)
    });
    let found = turned.unwrap().values(0.0, &[3.0, 4.0]).unwrap();
    assert!((found[0] * found[0] + found[1] * found[1] - 25.0).abs() < 1e-14);
    let empty = Formulas::new(names.clone(), |_, _, p| [p.dot::<f64>(&[], &[])]).unwrap();
    assert_eq!(empty.values(0.0, &[1.0, 1.0]).unwrap(), [0.0]);
    let short = Formulas::new(names, |_, x, p| [p.dot(&[1.0], x)]);
    assert!(matches!(short, Err(Error::Length { needed: 1, given: 2, .. })));
}
