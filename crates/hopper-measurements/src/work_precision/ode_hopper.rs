//! The hopper by an integrator that knows the equations of motion, the guards and the resets only.

use super::case::{Answer, Case};
use hybrid_system::{Integration, State, Tolerances, bracketed_root};
use nalgebra::{Vector2, Vector4};

/// Points inside a step at which a guard is evaluated.
///
/// A step is about one radian. Eight points see every dip of a guard that is longer than an eighth of that; a
/// shorter one is missed, and the hop counts as wrong.
const LOOKS: u32 = 8;

/// Largest numbers of steps in a phase and of flights in a hop. Beyond them the method refuses: a single hop would
/// take seconds.
const STEPS: usize = 20_000;
const FLIGHTS: usize = 100;

/// The hop by integration at a tolerance; `None` if the integration fails or needs too many steps.
pub(super) fn integrated_hop(case: &Case, tolerance: f64) -> Option<Answer> {
    // A flight from α takes about 2α and a step is about one radian: a longer flight would use up the steps.
    if case.alpha > STEPS as f64 {
        return None;
    }
    let m = case.mass_ratio.value();
    let tolerances = Tolerances { steps: STEPS, ..Tolerances::both(tolerance) };
    let flight = |_: f64, x: &Vector4<f64>| {
        let stretch = x[0] - x[2];
        let upper = (-m * stretch - 1.0) / (1.0 + m);
        Vector4::new(x[1], upper, x[3], (stretch - 1.0) / (1.0 + m))
    };
    let contact = |_: f64, x: &Vector2<f64>| Vector2::new(x[1], (-m * x[0] - 1.0) / (1.0 + m));
    let mut state = Vector4::new(1.0, case.alpha, 0.0, 0.0);
    for sudden in 0..FLIGHTS {
        let landed = falls(Integration::new(flight, &state, tolerances).ok()?, 2)?;
        if landed[0] > 1.0 || (landed[0] == 1.0 && landed[1] > 0.0) {
            state = Vector4::new(landed[0], landed[1], 0.0, 0.0);
            continue;
        }
        let start = Vector2::new(landed[0], landed[1]);
        let next = lift_off(Integration::new(contact, &start, tolerances).ok()?)?;
        return Some(Answer { next, sudden: Some(sudden), ..Answer::default() });
    }
    None
}

/// The state at which a component falls through zero after it was positive; `None` if a step fails.
fn falls<F>(mut motion: Integration<F, 4>, component: usize) -> Option<State<4>>
where
    F: Fn(f64, &State<4>) -> State<4>,
{
    let mut last_positive = None;
    loop {
        motion.step().ok()?;
        let (from, to) = motion.interval();
        for look in 1..=LOOKS {
            let time = place(from, to, look);
            let value = motion.at(time).ok()?[component];
            match last_positive {
                Some(before) if value < 0.0 => {
                    return root(&mut motion, (before, time), |x| x[component]);
                }
                _ if value > 0.0 => last_positive = Some(time),
                _ => {}
            }
        }
        // An interpolant holds on its own step only: the next bracket starts where the next step does.
        last_positive = last_positive.map(|_| to);
    }
}

/// The speed at which the upper mass rises through 1. The inner `None` is a grounded hopper: the mass turns before 1.
/// The outer `None` is a failed step.
fn lift_off<F>(mut motion: Integration<F, 2>) -> Option<Option<f64>>
where
    F: Fn(f64, &State<2>) -> State<2>,
{
    let mut last = (0.0f64, motion.state());
    loop {
        motion.step().ok()?;
        let (from, to) = motion.interval();
        for look in 1..=LOOKS {
            let time = place(from, to, look);
            let state = motion.at(time).ok()?;
            let before = last.0.max(from);
            if state[0] > 1.0 {
                return root(&mut motion, (before, time), |x| x[0] - 1.0).map(|x| Some(x[1]));
            }
            if last.1[1] > 0.0 && state[1] <= 0.0 {
                // The mass turns between two points and is below 1 at both. Its peak may lie above 1: without this
                // branch a hop of tiny α′ would count as grounded.
                let peak = time_of(&mut motion, (before, time), |x| x[1])?;
                if motion.at(peak).ok()?[0] < 1.0 {
                    return Some(None);
                }
                return root(&mut motion, (before, peak), |x| x[0] - 1.0).map(|x| Some(x[1]));
            }
            last = (time, state);
        }
    }
}

fn place(from: f64, to: f64, look: u32) -> f64 {
    if look == LOOKS { to } else { from + (to - from) * (f64::from(look) / f64::from(LOOKS)) }
}

fn root<F, const N: usize>(
    motion: &mut Integration<F, N>,
    bracket: (f64, f64),
    guard: impl Fn(&State<N>) -> f64,
) -> Option<State<N>>
where
    F: Fn(f64, &State<N>) -> State<N>,
{
    let time = time_of(motion, bracket, guard)?;
    motion.at(time).ok()
}

fn time_of<F, const N: usize>(
    motion: &mut Integration<F, N>,
    (from, to): (f64, f64),
    guard: impl Fn(&State<N>) -> f64,
) -> Option<f64>
where
    F: Fn(f64, &State<N>) -> State<N>,
{
    let motion = std::cell::RefCell::new(motion);
    let along = |time: f64| motion.borrow_mut().at(time).map_or(f64::NAN, |state| guard(&state));
    bracketed_root(along, from, to).ok()
}
