//! The hopper by its equations of motion alone: flights are integrated by Taylor series, and the closed form of a contact is
//! found by the library.

use crate::error::Error;
use hybrid_system::{
    Equations, EquationsModel, EventKind, Execution, Label, Limits, State, Stop, Tolerances,
};
use passive_hopper::MassRatio;
use std::f64::consts::TAU;

/// Tolerance of each step.
const TOLERANCE: f64 = 1e-12;

/// Most events of a hop. The claims use mass ratios and speeds at which a hop has a few sudden lift-offs; a hop with
/// more gives an error.
const EVENTS: usize = 200;

/// The paper's Eq. 1 and its contact phase, with state (y₁, ẏ₁, y₂, ẏ₂).
fn hopper(mass_ratio: MassRatio) -> Result<EquationsModel<State<4>>, Error> {
    let equations = Equations::new(&["y1", "v1", "y2", "v2"], &[("M", "1")])
        .mode_text("flight", &["v1", "-(M*(y1 - y2) + 1)/(1 + M)", "v2", "(y1 - y2 - 1)/(1 + M)"])
        .falling_text("ground", "y2")
        .resets_text(&["y1", "v1", "0", "0"])
        .to("contact")
        .mode_text("contact", &["v1", "-(M*y1 + 1)/(1 + M)", "0", "0"])
        // Beyond it the spring pulls at once: the lift-off is sudden.
        .rising_text("lift-off", "y1 - 1")
        .to("flight")
        .contact()
        .with_parameters(&[("M", &format!("{:?}", mass_ratio.value()))]);
    Ok(equations.model()?.tolerances(Tolerances::both(TOLERANCE)))
}

/// Bound on the time of a hop: 2α + π in flights, and one period of the contact.
fn longest_hop(alpha: f64, mass_ratio: MassRatio) -> f64 {
    2.0 * alpha + 0.5 * TAU + TAU / mass_ratio.contact_frequency()
}

/// f(α; M) by integration; `None` if the hopper is grounded: the upper mass swings for a whole period without reaching
/// y₁ = 1.
pub(crate) fn integrated(alpha: f64, mass_ratio: MassRatio) -> Result<Option<f64>, Error> {
    let hopper = hopper(mass_ratio)?;
    let limits = Limits::new(longest_hop(alpha, mass_ratio), EVENTS);
    let start = State::from([1.0, alpha, 0.0, 0.0]);
    let mut execution = Execution::new(&hopper, Label::new("flight")?, start, limits);
    for arc in execution.by_ref() {
        if let Some(event) = arc?.event()
            && event.surface == "lift-off"
            && event.kind == EventKind::Crossing
        {
            return Ok(Some(event.before[1]));
        }
    }
    match execution.stop() {
        Some(Stop::TimeLimit) => Ok(None),
        other => Err(Error::CheckFailed(format!(
            "a hop from {alpha} at {mass_ratio:?} ends in {other:?}"
        ))),
    }
}

/// Bound on the error of α′² by integration on a contact part, relative to α².
///
/// A hop lasts up to T = 2α + π + 2π/ν ([`longest_hop`]) and has about T steps. Each step is wrong by the tolerance times 1 + |x| in each
/// component, where |y| ≤ 1 + α²/2 and |ẏ| ≤ 1 + 3α. An error of a velocity grows in the position like T. So at the
/// end e = ẏ₁² + (y₁−1)(2 + κ(y₁−1)) is wrong by at most the tolerance times T (1 + α²)(8 + 4 (α + T)): the first term
/// is that of ẏ₁, the second that of y₁. The bound counts every step with its largest error and the same sign. It is an
/// estimate of the number of steps and no proof; the largest error seen is a part of it that the claims show.
pub(crate) fn integrated_error(alpha: f64, mass_ratio: MassRatio) -> f64 {
    let time = longest_hop(alpha, mass_ratio);
    TOLERANCE * time * (8.0 + 4.0 * (alpha + time)) * (1.0 + 1.0 / (alpha * alpha))
}
