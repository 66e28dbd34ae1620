//! Evaluators agree with each other on random formulas.

use equations::{Formulas, Jet, JetSeries, Names, Series};
use interval_arithmetic::Enclosure;
use proptest::prelude::*;

/// Random texts of x, y, t and a, up to a depth.
fn text() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("x".to_owned()),
        Just("y".to_owned()),
        Just("t".to_owned()),
        Just("a".to_owned()),
        (1u32..2000).prop_map(|k| format!("{}.{:03}", k / 1000, k % 1000)),
    ];
    leaf.prop_recursive(5, 40, 2, |inner| {
        let functions = prop::sample::select(vec![
            "sin", "cos", "exp", "tanh", "atan", "asinh", "sqrt", "ln", "sinh", "cosh", "tan",
            "asin", "acos", "acosh", "atanh", "sech", "abs", "sign",
        ]);
        prop_oneof![
            (functions, inner.clone()).prop_map(|(f, x)| format!("{f}({x})")),
            (prop::sample::select(vec!["+", "-", "*", "/"]), inner.clone(), inner.clone())
                .prop_map(|(operator, x, y)| format!("({x}){operator}({y})")),
            (inner.clone(), -3i32..4).prop_map(|(x, k)| format!("({x})^{k}")),
            inner.clone().prop_map(|x| format!("-({x})")),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| format!("({x})^({y})")),
            (prop::sample::select(vec!["atan2", "min", "max"]), inner.clone(), inner)
                .prop_map(|(f, x, y)| format!("{f}({x}, {y})")),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn evaluators_agree(text in text(), x in 0.1f64..2.0, y in -1.0f64..1.0, t in 0.0f64..1.0, width in 0.0f64..0.01) {
        let names = Names::new(&["x", "y"], &[("a", "0.7")]).unwrap();
        let field = Formulas::from_text(names.clone(), &["y", "-x + 0.1*t"]).unwrap();
        let formula = Formulas::from_text(names.clone(), &[&text]).unwrap();
        let found = formula.values(t, &[x, y]);

        // Many states at once have the bits of one.
        let column: Vec<f64> = (0..11).map(|k| x + 0.1 * f64::from(k)).collect();
        let many = formula.columns(&[t], &[&column, &[y; 11]]).unwrap();
        for (at, &x) in column.iter().enumerate() {
            let failed = many.failed.iter().find(|(place, _)| *place == at);
            match formula.values(t, &[x, y]) {
                Ok(one) => prop_assert!(failed.is_none() && one[0].to_bits() == many.values[0][at].to_bits()),
                Err(error) => prop_assert_eq!(&failed.unwrap().1, &error),
            }
        }

        // Text and file give the same formulas.
        let again = Formulas::from_text(names, &[&formula.texts()[0]]).unwrap();
        prop_assert_eq!(again.values(t, &[x, y]).ok(), found.clone().ok());
        prop_assert_eq!(&Formulas::from_json(&formula.to_json()).unwrap(), &formula);

        // An enclosure holds the value at each of its numbers, and that of a narrower one.
        let around = [Enclosure::new(x, x + width), Enclosure::new(y, y + width)];
        let wide = formula.enclosures(Enclosure::new(t, t + width), &around);
        let narrow = formula.enclosures(Enclosure::from(t), &[x, y].map(Enclosure::from));
        if let (Ok(wide), Ok(narrow)) = (&wide, &narrow) {
            prop_assert!(narrow[0].is_inside(&wide[0]), "{:?} {:?}", narrow, wide);
        }
        prop_assert!(wide.is_err() || narrow.is_ok());
        let (Ok(found), Ok(narrow)) = (found, narrow) else { return Ok(()) };
        // The exact value is inside. The rounded one is off by what its operations round.
        let slack = 1e-9 * (1.0 + found[0].abs()) + 1e6 * narrow[0].width();
        prop_assert!((narrow[0].middle() - found[0]).abs() <= slack, "{:?} {:?}", narrow, found);

        // The first coefficient is the derivative along the motion, and the enclosed series holds both.
        let Ok(series) = Series::new(&field, Some(&formula)) else { return Ok(()) };
        let Ok(taylor) = series.coefficients(t, &[x, y], 4) else { return Ok(()) };
        let taylor = taylor.watched(0);
        prop_assert_eq!(taylor[0], found[0]);
        let enclosed = series.coefficients(Enclosure::from(t), &[x, y].map(Enclosure::from), 4);
        let Ok(enclosed) = enclosed else { return Ok(()) };
        let enclosed = enclosed.watched(0);
        for (k, (plain, enclosure)) in taylor.iter().zip(enclosed).enumerate() {
            let slack = 1e-9 * (1.0 + plain.abs()) + 1e6 * enclosure.width();
            prop_assert!((enclosure.middle() - plain).abs() <= slack, "{} {:?} {}", k, enclosure, plain);
        }
        // A kink of numbers has a series, but no derivative by them.
        let has_kink = ["abs", "sign", "min", "max"].iter().any(|kink| text.contains(kink));
        prop_assert!(has_kink || JetSeries::of_values(&formula).is_ok());
        if !formula.uses_time() && !has_kink {
            // The value in a jet is the value, and its slopes are the derivatives, by the parameter too.
            let jets = JetSeries::of_values(&formula).unwrap();
            let moving = [Jet::<2>::moving(x, 0.3), Jet::moving(y, -0.8), Jet::moving(0.7, 0.5)];
            let slope = formula.derivative(&[0.3, -0.8], &[0.5]).unwrap().values(t, &[x, y]);
            if let (Ok(jet), Ok(slope)) = (jets.values(&moving), slope) {
                prop_assert_eq!(jet[0].0[0].to_bits(), found[0].to_bits());
                let slack = 1e-9 * (1.0 + slope[0].abs()) + 1e6 * enclosed[1].width();
                prop_assert!((jet[0].0[1] - slope[0]).abs() <= slack, "{:?} {:?}", jet, slope);
            }
            let derivative = formula.derivative(&[y, -x + 0.1 * t], &[0.0]).unwrap();
            if let Ok(slope) = derivative.values(t, &[x, y]) {
                let (off, width) = ((slope[0] - taylor[1]).abs(), enclosed[1].width());
                prop_assert!(off <= 1e-9 * (1.0 + slope[0].abs()) + 1e6 * width, "{:?} {:?}", slope, taylor);
            }
        }
    }
}
