//! Executions as arrays.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// The height of a ball that keeps half of its speed, dropped from ½: it lands at 1 = 3 − 2, at 2 = 3 − 1, at 2½ =
/// 3 − ½, …, and rests at 3. After the landing at 3 − w it leaves with the speed w/4.
fn height(time: f64) -> f64 {
    if time <= 1.0 {
        return 0.5 - time * time / 2.0;
    }
    let mut left = 2.0;
    while time < 3.0 && 3.0 - left / 2.0 <= time {
        left /= 2.0;
    }
    let since = time - (3.0 - left);
    if time < 3.0 { since * (left / 4.0 - since / 2.0) } else { 0.0 }
}

#[test]
fn rows_on_the_grid_are_the_solution_and_every_event_has_both_states() {
    let ball = Model::closed_form(|resting, x: &State<2>, t| match resting {
        false => [x[0] + t * (x[1] - t / 2.0), x[1] - t],
        true => [0.0, 0.0],
    })
    .falling(false, |x| x[0], |x| (false, [0.0, -0.5 * x[1]]))
    .signal(0, |_, x| Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5])))
    .rest(|_, _| Some((true, [0.0, 0.0])));
    let grid: Vec<f64> = (-8..=80).map(|k| f64::from(k) / 16.0).collect();
    let trajectory = ball.run(false, [0.5, 0.0], 4.0).trajectory(&grid).unwrap();
    let rows = trajectory.times.len();
    assert_eq!(trajectory.states.shape(), (rows, 2));
    assert!(
        [trajectory.jumps.len(), trajectory.modes.len(), trajectory.on_grid.len()] == [rows; 3]
    );
    assert!(trajectory.times.windows(2).all(|pair| pair[0] <= pair[1]));
    // One row for each time of the grid from 0 to 4.
    let on_grid: Vec<usize> = (0..rows).filter(|&row| trajectory.on_grid[row]).collect();
    let times: Vec<f64> = on_grid.iter().map(|&row| trajectory.times[row]).collect();
    assert_eq!(times, grid[8..=72]);
    for &row in &on_grid {
        let (time, x) = (trajectory.times[row], trajectory.states[(row, 0)]);
        assert!((x - height(time)).abs() < 1e-12, "{time}: {x} {}", height(time));
    }
    let events = &trajectory.events;
    assert!(events.times.len() > 20);
    for (event, &time) in events.times.iter().enumerate() {
        let after = (0..rows).find(|&row| trajectory.jumps[row] == event + 1).unwrap();
        assert_eq!([trajectory.times[after - 1], trajectory.times[after]], [time, time]);
        assert_eq!(trajectory.states.row(after - 1), events.before.row(event));
        assert_eq!(trajectory.states.row(after), events.after.row(event));
        assert_eq!(events.after[(event, 1)], -0.5 * events.before[(event, 1)]);
    }
}

#[test]
fn events_at_one_instant_have_one_row_each() {
    let steps = Model::closed_form(|_, x: &State<1>, t| [x[0] + t])
        .rising(1, |x| x[0] - 1.0, |x| (2, *x))
        .rising(2, |x| x[0] - 1.0, |x| (3, *x))
        .rising(3, |x| x[0] - 1.0, |_| (1, [0.0]))
        .sampled(0.1);
    let trajectory = steps.run(1, [0.5], 1.0).trajectory(&[0.5, 0.5, 1.0, 7.0]).unwrap();
    assert_eq!(trajectory.times, [0.0, 0.5, 0.5, 0.5, 0.5, 1.0]);
    assert_eq!(trajectory.modes, [1, 1, 2, 3, 1, 1]);
    assert_eq!(trajectory.jumps, [0, 0, 1, 2, 3, 3]);
    assert_eq!(trajectory.events.modes, [1, 2, 3]);
    assert_eq!(trajectory.events.next_modes, [Some(2), Some(3), Some(1)]);
    assert_eq!(trajectory.on_grid, [false, false, false, false, true, true]);
}

#[test]
fn integrated_arcs_and_arcs_for_ever() {
    let circle = Model::integrated(|(), x: &State<2>| [x[1], -x[0]])
        .tolerance(1e-12)
        .observer(Guard::falling("top"), |x| x[1]);
    let grid: Vec<f64> = (0..=1000).map(|k| 0.02 * f64::from(k)).collect();
    let trajectory = circle.run((), [0.0, 1.0], 20.0).trajectory(&grid).unwrap();
    assert_eq!(trajectory.events.times.len(), 3);
    for (row, time) in trajectory.times.iter().enumerate() {
        assert!((trajectory.states[(row, 0)] - time.sin()).abs() < 1e-10, "{time}");
    }
    let line = Model::<_, usize, _, _>::closed_form(|(), x: &State<1>, t| [x[0] + t]);
    let trajectory = line.run((), [0.0], f64::INFINITY).trajectory(&[1.0, 2.0]).unwrap();
    assert_eq!(trajectory.times, [0.0, 1.0, 2.0]);
    let unsorted = line.run((), [0.0], 3.0).trajectory(&[1.0, 0.5]);
    assert!(matches!(unsorted, Err(Error::BadLimit { value: 0.5, .. })), "{unsorted:?}");
    let nan = line.run((), [0.0], 3.0).trajectory(&[f64::NAN]);
    assert!(matches!(nan, Err(Error::BadLimit { .. })), "{nan:?}");
}
