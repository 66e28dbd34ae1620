//! What other programs do after each step: a domain that is not left, and a projection onto a manifold.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// u̇ = −|u| stays positive. With a tolerance of 1e-3 its steps may pass zero, and −|u| runs away there. Outside of its domain a
/// field has no value: steps that leave it are made shorter.
#[test]
fn a_domain_is_not_left() {
    let tolerances = Tolerances { absolute: 1e-6, ..Tolerances::both(1e-3) };
    let domain = |u: f64| if u > 0.0 { -u.abs() } else { f64::NAN };
    let model = Model::integrated(|(), u: &State<1>| [domain(u[0])])
        .tolerances(tolerances)
        .observer(Guard::rising(0), |_| -1.0);
    let fate = model.run((), [1.0], 40.0).fate();
    match fate.end {
        End::Stopped(Stop::TimeLimit) => assert!(fate.state[0] > 0.0, "{fate:?}"),
        // Or it says that it cannot go on.
        end => assert!(matches!(end, End::Failed(_)), "{end:?}"),
    }
    // A field that leaves its domain for good is an error with its place.
    let leaves = Model::integrated(|(), x: &State<1>| if x[0] > 0.0 { [-1.0] } else { [f64::NAN] })
        .observer(Guard::rising(0), |_| -1.0);
    let fate = leaves.run((), [1.0], 2.0).fate();
    assert!(matches!(fate.end, End::Failed(_)), "{fate:?}");
    // As equations: the root says it.
    let root = Equations::new(&["x"], &[]).mode_text("m", &["-sqrt(x)/sqrt(x)"]);
    let model = root.model::<State<1>>().unwrap();
    let fate = model.start("m", [1.0], 2.0).unwrap().fate();
    let End::Failed(error) = fate.end else { panic!("{fate:?}") };
    assert!(error.to_string().contains("sqrt"), "{error}");
}

/// An orbit about the sun, with its energy put right at each tick of a clock: the run shows the ticks.
#[test]
fn a_projection_at_the_ticks_of_a_clock() {
    let energy = |x: &State<4>| 0.5 * (x[2] * x[2] + x[3] * x[3]) - 1.0 / x[0].hypot(x[1]);
    let field = |(), x: &State<4>| {
        let pull = x[0].hypot(x[1]).powi(-3);
        [x[2], x[3], -pull * x[0], -pull * x[1]]
    };
    let tolerances = Tolerances::both(1e-6);
    let start = State::from([1.0, 0.0, 0.0, 1.2]);
    let exact = energy(&start);
    let free = Model::integrated(field).tolerances(tolerances).observer(Guard::rising(9), |_| -1.0);
    let drift = (energy(&free.run((), start, 500.0).fate().state) - exact).abs();
    let ticks = PeriodicTimes::new(1.0, 1.0).unwrap();
    let projected = Model::integrated(field).tolerances(tolerances).clock(
        (),
        "energy",
        |after| ticks.next_after(after),
        |(), x| {
            let speed = (2.0 * (exact + 1.0 / x[0].hypot(x[1]))).sqrt();
            let factor = speed / x[2].hypot(x[3]);
            ((), [x[0], x[1], factor * x[2], factor * x[3]])
        },
    );
    let fate = projected.run((), start, 500.0).fate();
    assert_eq!(fate.events, 500);
    assert!((energy(&fate.state) - exact).abs() < 1e-12);
    assert!(drift > 1e-6, "{drift:e}");
}
