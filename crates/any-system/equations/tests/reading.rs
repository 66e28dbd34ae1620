//! Text and files.

use equations::{Error, Formulas, Names};
use proptest::prelude::*;

fn value(text: &str) -> f64 {
    let names = Names::new(&["x", "y"], &[("α", "2"), ("long_name2", "-0.5")]).unwrap();
    Formulas::from_text(names, &[text]).unwrap().values(7.0, &[3.0, 5.0]).unwrap()[0]
}

#[test]
fn operators_have_their_precedence() {
    for (text, known) in [
        ("1 + 2*3", 7.0),
        ("8 - 4 - 2", 2.0),
        ("16/4/2", 2.0),
        ("-x^2", -9.0),
        ("2^3^2", 512.0),
        ("2**3**2", 512.0),
        ("2^-1", 0.5),
        ("-2^-2", -0.25),
        ("2*-x", -6.0),
        ("x*y^2", 75.0),
        ("--x", 3.0),
        ("+x - −y", 8.0),
        ("(1 + 2)*3", 9.0),
        ("2·x × y", 30.0),
        ("6/2*3", 9.0),
        ("t", 7.0),
        ("α*x + long_name2", 5.5),
        ("pi - π", 0.0),
        ("ln(e)", 1.0),
        ("1.5e1 + .5 + 1.", 16.5),
        ("min(x, y)*max(x, y) - abs(-x)*sign(-y)", 18.0),
        ("x^2 * x^0 * x^1", 27.0),
        ("(-1)^2147483648 + (-1)^2147483649", 0.0),
        ("4^0.5 + 4^1.5", 10.0),
        ("(-2)^3", -8.0),
        ("f64(0.1)*10", 1.0),
        (" x\t+\n1 ", 4.0),
    ] {
        assert_eq!(value(text), known, "{text}");
    }
}

#[test]
fn wrong_texts_are_errors_with_their_column() {
    for (text, column, reason) in [
        ("", 1, "a number, a name or ( is expected at the end"),
        ("1 +", 4, "a number, a name or ( is expected at the end"),
        ("2x", 2, "'x' is not expected here"),
        ("2*(x + 1", 9, "')' is expected at the end"),
        ("sin x", 5, "'(' is expected, not 'x'"),
        ("αβ + 1", 1, "no variable or parameter has the name αβ"),
        ("x + α + β", 9, "no variable or parameter has the name β"),
        ("1.2.3", 1, "1.2.3 is no decimal with a finite f64"),
        ("x + 1e999", 5, "1e999 is no decimal with a finite f64"),
        ("atan2(x)", 8, "',' is expected, not ')'"),
        ("x ++* 2", 5, "a number, a name or ( is expected, not '*'"),
        ("x & y", 3, "'&' is not expected here"),
        ("f64(x)", 5, "a number is expected"),
    ] {
        let names = Names::new(&["x", "y"], &[("α", "2")]).unwrap();
        match Formulas::from_text(names, &[text]) {
            Err(Error::Text { column: at, reason: why, .. }) => {
                assert_eq!((at, why.as_str()), (column, reason), "{text}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn deep_and_long_texts_are_refused() {
    for text in [
        "(".repeat(100_000),
        "-".repeat(100_000) + "1",
        "2^".repeat(100_000) + "2",
        "sin(".repeat(9_000),
    ] {
        let found = Formulas::from_text(Names::default(), &[&text]);
        assert!(matches!(found, Err(Error::Text { .. })), "{found:?}");
    }
    let long = "1 + ".repeat(300_000) + "1";
    assert!(matches!(Formulas::from_text(Names::default(), &[&long]), Err(Error::Text { .. })));
    // A long sum is not deep.
    let sum = "t + ".repeat(20_000) + "t";
    let formulas = Formulas::from_text(Names::default(), &[&sum]).unwrap();
    assert_eq!(formulas.values(1.0, &[]).unwrap(), [20_001.0]);
    // Its text is cut, and takes little memory.
    let text = &formulas.texts()[0];
    assert!(text.starts_with('…') && text.len() < 20_000, "{text:.100}");
    // Many names, and a name and a number as long as a text.
    let names: Vec<String> = (0..50_000).map(|k| format!("x{k}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    assert!(Names::new(&names, &[]).is_ok());
    for long in ["y".repeat(100_000), "1".repeat(100_000)] {
        let error = Formulas::from_text(Names::default(), &[&long]).unwrap_err();
        assert!(error.to_string().len() < 400);
    }
}

#[test]
fn names_are_checked() {
    for (states, reason) in [
        (["x", "x"], "used twice"),
        (["t", "x"], "taken"),
        (["sin", "x"], "taken"),
        (["2x", "y"], "no name"),
        (["", "y"], "no name"),
        (["a b", "y"], "no name"),
    ] {
        let error = Names::new(&states, &[]).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    }
    assert!(Names::new(&["x"], &[("x", "1")]).is_err());
    let error = Names::new(&["x"], &[("a", "one")]).unwrap_err().to_string();
    assert!(error.contains("give a decimal"), "{error}");
}

/// Each wrong file is refused with the place.
#[test]
fn wrong_files_are_refused_with_the_place() {
    let file = |states: &str, parts: &str, outputs: &str| {
        format!(
            r#"{{"format": "equations", "version": 1, "states": {states}, "parameters": [["a", "0.2"]],
            "parts": {parts}, "outputs": {outputs}}}"#
        )
    };
    assert!(Formulas::from_json(&file(r#"["x"]"#, r#"[["state", 0], ["sin", 0]]"#, "[1]")).is_ok());
    for (text, place) in [
        (file(r#"["x"]"#, r#"[["sin", 0]]"#, "[0]"), "parts[0]"),
        (file(r#"["x"]"#, r#"[["state", 0], ["+", 0, 2], ["sin", 1]]"#, "[2]"), "parts[1]"),
        (file(r#"["x"]"#, r#"[["state", 1]]"#, "[0]"), "parts[0]"),
        (file(r#"["x"]"#, r#"[["state", -1]]"#, "[0]"), "parts[0]"),
        (file(r#"["x"]"#, r#"[["state", 0], ["state", 0]]"#, "[0]"), "parts[1]"),
        (file(r#"["x"]"#, r#"[["state", 0], ["frob", 0]]"#, "[0]"), "parts[1]"),
        (file(r#"["x"]"#, r#"[["state", 0], ["sin", 0, 0]]"#, "[0]"), "parts[1]"),
        (file(r#"["x"]"#, r#"[["number", "1e999"]]"#, "[0]"), "parts[0]"),
        (file(r#"["x"]"#, r#"[["number", 0.2]]"#, "[0]"), "parts[0]"),
        (file(r#"["x"]"#, r#"[["number", "f1e400"]]"#, "[0]"), "parts[0]"),
        (file(r#"["x"]"#, "[[]]", "[0]"), "parts[0]"),
        (file(r#"["x"]"#, r#"[["state", 0], ["number", "2"], ["^", 0, 1]]"#, "[2]"), "parts[2]"),
        (file(r#"["x"]"#, r#"[["time"]]"#, "[1]"), "outputs[0]"),
        (file("[3]", r#"[["time"]]"#, "[0]"), "states[0]"),
        (file("7", r#"[["time"]]"#, "[0]"), "states"),
        ("[".repeat(100_000), "the file"),
        (r#"{"format": "equations", "version": 2}"#.to_owned(), "the file"),
    ] {
        match Formulas::from_json(&text) {
            Err(Error::File { place: at, .. }) => assert_eq!(at, place, "{text}"),
            other => panic!("{text:.100}: {other:?}"),
        }
    }
    assert!(matches!(Formulas::from_json(&file(r#"["t"]"#, "[]", "[]")), Err(Error::Name { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// No text and no file makes a panic.
    #[test]
    fn readers_take_any_characters(text in "[-+*/^(),.0-9a-ceinpstxy π\u{2212}&]{0,40}", other in any::<String>()) {
        let names = Names::new(&["x", "y"], &[("a", "1")]).unwrap();
        for text in [&text, &other] {
            if let Ok(formulas) = Formulas::from_text(names.clone(), &[text]) {
                // None of a text that gives a name to a value.
                let texts = formulas.texts();
                let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
                let again = Formulas::from_text(names.clone(), &texts).unwrap();
                let values = |formulas: &Formulas| formulas.values(0.5, &[1.25, -0.75]);
                // The text of constants that were computed may have been merged in another order.
                prop_assert_eq!(values(&formulas).ok(), values(&again).ok(), "{}", text);
            }
            let _ = Formulas::from_json(text);
        }
    }

    /// A file in which some bytes are others is refused, or has values.
    #[test]
    fn damaged_files_make_no_panic(places in prop::collection::vec((0usize..400, any::<u8>()), 1..4)) {
        let names = Names::new(&["x", "y"], &[("a", "0.25")]).unwrap();
        let texts = ["a*x^3 - sin(y*t)/(1 + x^2)", "atan2(y, x)^1.5 + max(x, f64(0.1))"];
        let mut bytes = Formulas::from_text(names, &texts).unwrap().to_json().into_bytes();
        for (place, byte) in places {
            let at = place % bytes.len();
            bytes[at] = byte;
        }
        if let Ok(formulas) = Formulas::from_json(&String::from_utf8_lossy(&bytes)) {
            let count = formulas.names().states.len();
            let _ = (formulas.values(0.1, &vec![0.2; count]), formulas.texts(), formulas.latex());
        }
    }
}
