//! Events that change the number of components.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::DVector;

/// Cells grow by e^(0.3 t). The largest one divides when it has the size 1, into 0.3 and 0.7 of it.
fn cells() -> impl System<DVector<f64>, (), usize> {
    Model::integrated(|(), x: &DVector<f64>| 0.3 * x).tolerance(1e-12).rising(
        (),
        |x| x.max() - 1.0,
        |x| {
            let mut sizes: Vec<f64> = x.iter().copied().collect();
            let largest = x.imax();
            sizes[largest] = 0.7 * x[largest];
            sizes.push(0.3 * x[largest]);
            Reset::Resize { mode: (), state: DVector::from(sizes) }
        },
    )
}

/// From 0.2 the first division comes after ln 5/0.3. Of a sum of sizes no division takes any away.
#[test]
fn cells_divide() {
    let model = cells();
    let mut run = Execution::new(&model, (), DVector::from(vec![0.2]), Limits::new(15.0, 100));
    let arcs: Vec<_> = run.by_ref().map(Result::unwrap).collect();
    let events: Vec<f64> = arcs.iter().filter_map(|arc| Some(arc.event()?.time)).collect();
    assert!((events[0] - 5f64.ln() / 0.3).abs() < 1e-10);
    // 0.7 grows to 1 in ln(1/0.7)/0.3, and so on.
    assert!((events[1] - events[0] - (1.0f64 / 0.7).ln() / 0.3).abs() < 1e-10);
    assert_eq!(run.state().len(), events.len() + 1);
    assert!(events.len() > 8);
    let sum = 0.2 * (0.3f64 * 15.0).exp();
    assert!((run.state().sum() / sum - 1.0).abs() < 1e-10, "{}", run.state().sum());
    // The run as a function of time has states of each dimension.
    let start = DVector::from(vec![0.2]);
    let solution = Execution::new(&model, (), start.clone(), Limits::new(15.0, 100)).solution();
    let solution = solution.unwrap();
    let [before, after] = solution.at(events[0]).unwrap();
    assert_eq!((before.1.len(), after.1.len()), (1, 2));
    // As one matrix it is an error.
    let rows = Execution::new(&model, (), start, Limits::new(15.0, 100)).trajectory(&[1.0]);
    assert!(matches!(rows, Err(Error::Dimension { .. })));
}

/// A reset that does not say so keeps the dimension.
#[test]
fn a_reset_of_another_length_is_an_error() {
    let model = Model::integrated(|(), x: &DVector<f64>| 0.3 * x).rising(
        (),
        |x| x[0] - 1.0,
        |_| ((), DVector::from(vec![1.0, 2.0])),
    );
    let error = model.run((), DVector::from(vec![0.2]), 9.0).next().unwrap().unwrap_err();
    assert!(error.to_string().contains("Resize"), "{error}");
}

/// A state whose modes own their coordinates: two bodies on a line, and one after they have met.
#[derive(Debug, Clone, PartialEq)]
enum Bodies {
    /// Places and velocities of both.
    Two(State<4>),
    /// Place and velocity.
    One(State<2>),
}

impl StateVector for Bodies {
    fn components(&self) -> &[f64] {
        match self {
            Bodies::Two(state) => state.as_slice(),
            Bodies::One(state) => state.as_slice(),
        }
    }
    fn components_mut(&mut self) -> &mut [f64] {
        match self {
            Bodies::Two(state) => state.as_mut_slice(),
            Bodies::One(state) => state.as_mut_slice(),
        }
    }
    fn zeros_like(&self) -> Self {
        match self {
            Bodies::Two(_) => Bodies::Two(State::zeros()),
            Bodies::One(_) => Bodies::One(State::zeros()),
        }
    }
}

/// They meet at 1, at ½, with the velocities 1 and −½ and the masses 1 and 2: at rest from then on.
#[test]
fn bodies_become_one() {
    let model = Model::integrated(|(), x: &Bodies| match x {
        Bodies::Two(x) => Bodies::Two(State::from([x[1], 0.0, x[3], 0.0])),
        Bodies::One(x) => Bodies::One(State::from([x[1], 0.0])),
    })
    .tolerance(1e-12)
    .falling(
        (),
        |x| match x {
            Bodies::Two(x) => x[2] - x[0],
            Bodies::One(_) => 1.0,
        },
        |x| {
            let Bodies::Two(x) = x else { return Reset::Stop };
            let velocity = (x[1] + 2.0 * x[3]) / 3.0;
            Reset::Resize { mode: (), state: Bodies::One(State::from([x[0], velocity])) }
        },
    );
    let start = Bodies::Two(State::from([-0.5, 1.0, 1.0, -0.5]));
    let fate = model.run((), start, 3.0).fate();
    assert_eq!(fate.events, 1);
    let Bodies::One(end) = fate.state else { panic!("{fate:?}") };
    assert!((end[0] - 0.5).abs() < 1e-12 && end[1].abs() < 1e-12, "{end}");
}

/// A checkpoint behind the change of dimension goes on as without it.
#[cfg(feature = "serde")]
#[test]
fn a_checkpoint_has_the_new_dimension() {
    let model = cells();
    let start = DVector::from(vec![0.2]);
    let mut run = Execution::new(&model, (), start.clone(), Limits::new(12.0, 100));
    run.nth(2);
    let text = serde_json::to_string(&run.checkpoint()).unwrap();
    let read = serde_json::from_str(&text).unwrap();
    let again = Execution::restore(&model, read, Limits::new(12.0, 100));
    assert_eq!(again.collect::<Vec<_>>(), run.collect::<Vec<_>>());
}
