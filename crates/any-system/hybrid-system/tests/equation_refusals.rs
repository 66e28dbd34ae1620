//! Equations, tolerances and values that are refused, each with its place.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::DVector;

#[test]
fn wrong_equations_are_refused() {
    let names = || Equations::new(&["x"], &[("a", "2")]);
    let refused = |equations: Equations, part: &str| {
        let error = equations.model::<State<1>>().unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
        assert!(equations.to_json().is_err());
    };
    refused(Equations::new(&["x", "x"], &[]).mode("m", |_, x, _| [x[0]]), "used twice");
    refused(names(), "they have no mode");
    refused(names().mode_text("m", &["x + y"]), "column 5");
    refused(names().mode_text("m", &["x", "x"]), "field of a mode");
    refused(names().mode("m", |_, x, p| [p["b"] * x[0]]), "no parameter");
    refused(names().mode("m", |_, x, _| [x[0]]).to("n"), "no guard has been declared");
    refused(
        names().mode("m", |_, x, _| [x[0]]).falling("g", |_, x, _| x[0]).to("n"),
        "n: the equations have no",
    );
    refused(
        names().mode("m", |_, x, _| [x[0]]).mode("m", |_, x, _| [x[0]]),
        "a mode has it already",
    );
    refused(names().mode(&"m".repeat(32), |_, x, _| [x[0]]), "more than 31 bytes");
    refused(
        names()
            .mode("m", |_, x, _| [x[0]])
            .falling("g", |_, x, _| x[0])
            .resets(|_, x, _| [x[0], x[0]]),
        "the state after an event",
    );
    let ticks = |first: &str, period: &str| {
        names().mode("m", |_, x, _| [x[0]]).clock_text("tick", first, period)
    };
    let guard = |text: &str| names().mode("m", |_, x, _| [x[0]]).rising_text("stop", text);
    // A name for a value, and no value.
    refused(guard("gap = x - 1"), "stop: a guard has one formula");
    refused(ticks("b = 2", "1"), "tick: a clock has two formulas");
    let own = |slope: f64| Function::new("own", move |x| slope * x, Some, |x, _| 1.0 * x).unwrap();
    let (one, two) = (own(1.0), own(2.0));
    let field = names().mode("m", |_, x, _| [one.of(x[0])]);
    refused(field.clone().falling("g", |_, x, _| two.of(x[0])), "that of two functions");
    refused(field.clone().functions(&[two]), "that of two functions");
    let text = field.functions(std::slice::from_ref(&one)).falling_text("g", "own(x)");
    let json = text.to_json().unwrap();
    assert_eq!(Equations::from_json_with(&json, std::slice::from_ref(&one)).unwrap(), text);
    refused(Equations::new(&["own"], &[]).mode("m", |_, x, _| [one.of(x[0])]), "is used twice");
    refused(ticks("x", "1"), "numbers and parameters alone");
    refused(ticks("t", "1"), "numbers and parameters alone");
    refused(ticks("1", "a - 2"), "the period of a clock");
    refused(ticks("1/(a - 2)", "1"), "1/(a - 2)");
    let kink = names().mode("m", |_, x, _| [x[0].abs()]).model::<State<1>>().unwrap_err();
    assert!(kink.to_string().contains("make it a guard"), "{kink}");
    // The wrong mode, the wrong number of components.
    let model = names().mode("m", |t, x, _| [x[0] + t]).model::<DVector<f64>>().unwrap();
    assert!(model.start("n", DVector::zeros(2), 1.0).is_err());
    assert!(matches!(
        model.start("m", DVector::zeros(3), 1.0).err(),
        Some(Error::Dimension { expected: 2, found: 3, .. })
    ));
}

/// Tolerances are looked at where a closed form needs none, too.
#[test]
fn wrong_tolerances_are_refused() {
    let good = Tolerances::both(1e-9);
    for wrong in [
        good.longest_step(0.0),
        good.longest_step(f64::NAN),
        good.check_interval(-1.0),
        Tolerances::both(0.0),
    ] {
        let model = Equations::new(&["x"], &[]).mode_text("m", &["1"]).model::<State<1>>().unwrap();
        assert!(model.tolerances(wrong).start("m", [0.0], 1.0).is_err(), "{wrong:?}");
    }
}

/// A logarithm that leaves its domain on the way: the error names the part, the state and the time.
#[test]
fn a_formula_without_a_value_is_named() {
    let model =
        Equations::new(&["x"], &[]).mode_text("m", &["-1 - 0*ln(x)"]).model::<State<1>>().unwrap();
    let error = model.start("m", [1.0], 5.0).unwrap().next().unwrap().unwrap_err().to_string();
    assert!(error.contains("ln(x)"), "{error}");
    // So is that of a guard, at its own time: here in the second arc.
    for guard in ["ln(x) + 1000", "sqrt(x) + 1"] {
        let model = Equations::new(&["x"], &[]).mode_text("m", &["-1 - 0*ln(x + 9)"]);
        let model = model.falling_text("half", "x - 0.5").falling_text("other", guard);
        let model = model.model::<State<1>>().unwrap();
        let mut arcs = model.start("m", [1.0], 5.0).unwrap();
        assert!(arcs.next().unwrap().unwrap().event().is_some());
        let error = arcs.next().unwrap().unwrap_err().to_string();
        assert!(error.contains("(x) has no finite value"), "{error}");
        assert!(error.contains("t = 1.0"), "{error}");
        // The motion itself goes on.
        let end = model.flow(Label::new("m").unwrap(), &State::from([1.0]), 3.0);
        assert!((end[0] + 2.0).abs() < 1e-12);
    }
    // And that of a reset.
    let model = Equations::new(&["x"], &[]).mode_text("m", &["-1"]).falling_text("floor", "x");
    let model = model.resets_text(&["2 + ln(x - 1)"]).model::<State<1>>().unwrap();
    let error = model.start("m", [1.0], 5.0).unwrap().next().unwrap().unwrap_err().to_string();
    assert!(error.contains("ln(x - 1) has no finite value"), "{error}");
    assert!(error.contains("t = 1.0"), "{error}");
    // The event before is found.
    let model = Equations::new(&["x"], &[])
        .mode_text("m", &["-1 - 0*ln(x)"])
        .falling_text("half", "x - 0.5")
        .stops()
        .model::<State<1>>()
        .unwrap();
    let arc = model.start("m", [1.0], 5.0).unwrap().next().unwrap().unwrap();
    assert!((arc.event().unwrap().time - 0.5).abs() < 1e-14);
}
