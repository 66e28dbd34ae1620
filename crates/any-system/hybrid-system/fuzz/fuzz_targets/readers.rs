//! Any text is read as a formula, as a file of formulas and as one of hybrid equations. What is read is evaluated, written
//! and read again: nothing may panic, and the same equations come back.

#![no_main]

use equations::{Formulas, Names};
use hybrid_system::{Equations, State};
use libfuzzer_sys::fuzz_target;

fn formulas(formulas: &Formulas) {
    let state = vec![0.5; formulas.names().states.len()];
    let _ = formulas.values(0.25, &state);
    let _ = formulas.jacobian();
    assert_eq!(Formulas::from_json(&formulas.to_json()).as_ref(), Ok(formulas));
}

fuzz_target!(|text: &str| {
    if let Ok(names) = Names::new(&["x", "v"], &[("a", "0.2")])
        && let Ok(read) = Formulas::from_text(names, &[text])
    {
        formulas(&read);
    }
    if let Ok(read) = Formulas::from_json(text) {
        formulas(&read);
    }
    if let Ok(read) = Equations::from_json(text) {
        let written = read.to_json().expect("equations that were read are right");
        assert_eq!(Equations::from_json(&written).as_ref(), Ok(&read));
        let _ = read.model::<State<2>>();
    }
});
