//! The scenes of the page `hybrid_system::semantics`, drawn from their executions.

use super::scene_panel::{Panel, draw};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use example_systems::scenes::{
    By, ball, ceiling, cradle, cradle_start, endless, five_modes, leap, past_guard, relay, stack,
    throw, watched_leap,
};
use hybrid_system::{Direction, FirstCrossing, Label, QuasiPolynomial, State, Touch};

/// The scenes are drawn from their signals.
const BY: By = By::Signal;

/// Scenes with events at one instant.
pub(super) fn events_at_one_instant(_: &Job) -> Result<Figure, Error> {
    let cradle = Panel::new("a: a cradle, balls 2 and 3 touch", 2.6, (-1.2, 1.8), "positions")
        .scene(&cradle(BY)?, Label::new("cradle")?, cradle_start(), &[0, 1, 2]);
    let stack = Panel::new("b: a ball on a ball, without a gap", 4.0, (-0.7, 4.2), "heights")
        .forbidden(-1.0, 0.0)
        .scene(&stack(BY)?, Label::new("flight")?, State::from([1.0, 1.0, 0.0, 0.0]), &[0, 1]);
    let five = Panel::new("c: five modes that leave at $x$ = 1", 2.0, (0.0, 2.0), "$x$")
        .surface(1.0)
        .scene(&five_modes(BY)?, Label::new("0")?, State::from([0.0]), &[0]);
    let past = Panel::new("d: the next mode leaves at $x$ = ½", 2.0, (0.0, 2.0), "$x$")
        .surface(1.0)
        .surface(0.5)
        .scene(&past_guard(BY)?, Label::new("0")?, State::from([0.0]), &[0]);
    let leap = Panel::new("e: a reset over a surface", 14.0, (-23.0, 18.0), "$x$")
        .forbidden(-23.0, 0.0)
        .surface(15.0)
        .scene(&leap(BY)?, Label::new("rises")?, State::from([12.0]), &[0]);
    let watched = Panel::new("f: the same over an observer", 40.0, (-23.0, 18.0), "$x$")
        .surface(15.0)
        .surface(0.0)
        .scene(&watched_leap(BY)?, Label::new("rises")?, State::from([12.0]), &[0]);
    let below = Panel::new("g: a start below the floor: an error", 2.0, (-0.6, 0.9), "height")
        .forbidden(-0.6, 0.0)
        .scene(&ball(BY)?, Label::new("flight")?, State::from([-0.25, 0.0]), &[0]);
    let endless = Panel::new("h: events without end: an error", 2.0, (0.0, 3.5), "$x$")
        .surface(1.0)
        .surface(3.0)
        .scene(&endless(BY)?, Label::new("0")?, State::from([0.0]), &[0]);
    Figure::new(
        "semantics_instant",
        draw(&[cradle, stack, five, past, leap, watched, below, endless]),
        Vec::new(),
        &[],
    )
}

/// Scenes with sliding, touches and triple roots.
pub(super) fn sliding_and_touches(_: &Job) -> Result<Figure, Error> {
    // It has a field for the arrows.
    let sliding = relay(By::ClosedForm)?;
    let relay = Panel::new("a: a relay: sliding from here", 3.0, (-0.6, 1.1), "$x$")
        .surface(0.0)
        .scene(&sliding, Label::new("above")?, State::from([1.0, 0.0]), &[0])
        .fields(&sliding, [Label::new("below")?, Label::new("above")?], 0);
    // Of (1 − t)³ the sign changes, although the values are within rounding of zero around t = 1.
    let cube = QuasiPolynomial::polynomial(&[1.0, -3.0, 3.0, -1.0]);
    let found = cube.first_crossing(Direction::Falling, 2.0)?;
    let mut triple = Panel::new("b: a triple root: a crossing", 2.0, (-1.1, 1.1), "guard $g$")
        .surface(0.0)
        .function(|t| cube.value(t));
    if let FirstCrossing::At { time, .. } = found {
        triple = triple.event(time, 0.0);
    }
    let (flight, ignoring) = (Label::new("flight")?, ceiling(BY, Touch::Ignore)?);
    let touch = |title| Panel::new(title, 4.0, (0.0, 2.4), "height").forbidden(2.0, 2.4);
    let error = touch("c: a touch: an error, by default").scene(
        &ceiling(BY, Touch::Error)?,
        flight,
        throw(),
        &[0],
    );
    let event =
        touch("d: a touch as an event").scene(&ceiling(BY, Touch::Event)?, flight, throw(), &[0]);
    let ignored = touch("e: a touch ignored").scene(&ignoring, flight, throw(), &[0]);
    let crossing = touch("f: faster by a tenth: a crossing").scene(
        &ignoring,
        flight,
        State::from([0.0, 2.2]),
        &[0],
    );
    Figure::new(
        "semantics_touch",
        draw(&[relay, triple, error, event, ignored, crossing]),
        Vec::new(),
        &[],
    )
}
