//! Any text is read as a formula, as a file of formulas, as one of hybrid equations and as one of a run. What is read is
//! evaluated, written and read again, and a run goes on: nothing may panic, and the same equations come back.

#![no_main]

use equations::{Formulas, Names};
use hybrid_system::{Equations, Limits, SavedRun, State};
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
    if let Ok(read) = SavedRun::<State<2>>::from_json(text) {
        let time = read.checkpoint.time() + 1.0;
        let limits = Limits { steps: 1000, ..Limits::new(time, 3) };
        read.go_on(limits).for_each(drop);
        if let Ok(written) = read.to_json() {
            assert!(SavedRun::<State<2>>::from_json(&written).is_ok());
        }
    }
});
