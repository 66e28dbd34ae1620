//! The scenes of the page `hybrid_system::semantics` that last: sliding, observers, and Zeno limits.

use super::scene_panel::{Panel, draw};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use hybrid_system::{
    Execution, Filippov, FilippovMode, Guard, Limits, Model, State, System, Tolerances,
};
use pxfm::{f_cos, f_sin, f_sincos};

/// Tolerances of all integrated motions: far below the width of a line.
const TOLERANCES: Tolerances = Tolerances::both(1e-10);

/// The modes on both sides of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    Above,
}
use Side::{Above, Below};

/// Two fields on both sides of a surface, which is crossed at g = ± `band`.
fn two_sided(
    field: impl Fn(Side, &State<2>) -> [f64; 2],
    guard: impl Fn(&State<2>) -> f64 + Copy,
    band: f64,
) -> impl System<State<2>, Side, usize> {
    Model::integrated(field)
        .tolerances(TOLERANCES)
        .rising(Below, move |x| guard(x) - band, |x| (Above, *x))
        .falling(Above, move |x| guard(x) + band, |x| (Below, *x))
}

/// A relay without and with a hysteresis: the second tends to the first.
fn relays() -> Panel {
    let field = |side, _: &State<2>| if side == Below { [1.3, 1.0] } else { [-0.7, -3.0] };
    let start = State::from([0.7, 0.0]);
    let sliding = Filippov::new(two_sided(field, |x| x[0], 0.0), TOLERANCES);
    let hysteresis = two_sided(field, |x| x[0], 0.1);
    Panel::new("a: a relay slides; with a hysteresis it switches", 3.0, (-0.3, 0.8), "$x$")
        .surface(0.0)
        .pen(1)
        .scene(&hysteresis, Above, start, &[0])
        .pen(0)
        .scene(&sliding, FilippovMode::Free(Above), start, &[0])
}

/// Friction that becomes weaker with the slip: 2 − |1 − v|/2.
fn friction() -> Panel {
    let field = |side, x: &State<2>| match side {
        Below => [x[1], -x[0] + 2.0 - 0.5 * (1.0 - x[1])],
        Above => [x[1], -x[0] - 2.0 + 0.5 * (x[1] - 1.0)],
    };
    // One surface with one name on both sides, as the sliding mode needs it.
    let belt = Filippov::new(two_sided(field, |x| x[1] - 1.0, 0.0), TOLERANCES);
    Panel::new("b: a mass sticks to a belt of speed 1", 25.0, (-2.4, 1.6), "speed $v$")
        .surface(1.0)
        .scene(&belt, FilippovMode::Free(Below), State::from([-1.0, 0.0]), &[1])
}

/// The boost converter of the tests of sliding: the current is held at 2.
fn converter() -> Panel {
    let field = |side, x: &State<2>| match side {
        Below => [1.0, -0.25 * x[1]],
        Above => [1.0 - x[1], x[0] - 0.25 * x[1]],
    };
    let converter = Filippov::new(two_sided(field, |x| x[0] - 2.0, 0.0), TOLERANCES);
    Panel::new("c: a boost converter, current and voltage", 12.0, (0.8, 3.2), "$x$_{1}, $x$_{2}")
        .surface(2.0)
        .scene(&converter, FilippovMode::Free(Below), State::from([1.0, 2.0]), &[0, 1])
}

/// The crossings of an observer along a motion, as events on the line g = 0.
fn observed<const N: usize>(
    panel: Panel,
    field: impl Fn((), &State<N>) -> [f64; N],
    solution: impl Fn(f64) -> State<N>,
    guard: impl Fn(&State<N>) -> f64,
    time: f64,
) -> Result<Panel, Error> {
    let model =
        Model::integrated(field).tolerances(TOLERANCES).observer(Guard::either(0usize), &guard);
    let mut panel = panel.surface(0.0);
    for arc in Execution::new(&model, (), solution(0.0), Limits::new(time, 1000)) {
        if let Some(event) = arc?.event() {
            panel = panel.event(event.time, 0.0);
        }
    }
    Ok(panel)
}

/// A ball on a table of height 0.2 sin 2t. The ball rests on the table after its Zeno limit.
fn shaken_ball() -> Panel {
    let height = |t: f64| 0.2 * f_sin(2.0 * t);
    let speed = |t: f64| 0.4 * f_cos(2.0 * t);
    // State: height, velocity, time.
    let ball = Model::integrated(
        move |resting, x: &State<3>| {
            if resting { [speed(x[2]), 0.0, 1.0] } else { [x[1], -1.0, 1.0] }
        },
    )
    .tolerances(TOLERANCES)
    .falling(
        false,
        move |x| x[0] - height(x[2]),
        move |x| (false, [height(x[2]), speed(x[2]) - 0.5 * (x[1] - speed(x[2])), x[2]]),
    )
    .rest(move |_, x| Some((true, [height(x[2]), 0.0, x[2]])));
    Panel::new("f: bounces on a moving table end", 5.0, (-0.3, 0.8), "height")
        .pen(1)
        .function(height)
        .pen(0)
        .scene(&ball, false, State::from([0.6, 0.0, 0.0]), &[0])
}

/// Sliding, observers and Zeno limits.
pub(super) fn figure(_: &Job) -> Result<Figure, Error> {
    let circle = |t: f64| {
        let (sin, cos) = f_sincos(t);
        State::from([cos, -sin])
    };
    let other = |x: &State<2>| (x[0] - 0.5) * (x[0] - 0.5) + (x[1] - 0.3) * (x[1] - 0.3) - 1.0;
    let observed_circle = observed(
        Panel::new("d: along a circle, the guard of another one", 10.0, (-1.2, 2.4), "guard $g$")
            .function(|t| other(&circle(t))),
        |(), x: &State<2>| [x[1], -x[0]],
        circle,
        other,
        10.0,
    )?;
    let jump = observed(
        Panel::new("e: a guard that jumps from −1 to 2", 2.0, (-1.5, 2.5), "guard $g$")
            .piece((0.0, 0.7), |_| -1.0)
            .piece((0.7, 2.0), |_| 2.0),
        |(), _: &State<1>| [1.0],
        |t| State::from([t]),
        |x| if x[0] < 0.7 { -1.0 } else { 2.0 },
        2.0,
    )?;
    Figure::new(
        "semantics_motion",
        draw(&[relays(), friction(), converter(), observed_circle, jump, shaken_ball()]),
        Vec::new(),
        &[],
    )
}
