//! What the arcs of a return tell.

use super::border::{Border, BorderSite};
use crate::events::{less_certain, plain};
use hybrid_system::{Arc, ArcEnd, Certainty, Label, StateVector};
use nalgebra::DVector;
use std::fmt::Debug;

/// The arcs of a return of equations.
pub(super) type ReturnArcs = Vec<Arc<Label, Label, DVector<f64>>>;

/// The time of some arcs.
pub(super) fn elapsed<M, S, X>(arcs: &[Arc<M, S, X>]) -> f64 {
    match (arcs.first(), arcs.last()) {
        (Some(first), Some(last)) => last.time + last.duration - first.time,
        _ => 0.0,
    }
}

/// The certainty of the least certain event.
pub(super) fn least_certain<M: Copy, S: Copy, X: StateVector>(arcs: &[Arc<M, S, X>]) -> Certainty {
    let events = arcs.iter().filter_map(|arc| Some(arc.event()?.certainty));
    events.fold(Certainty::Exact, less_certain)
}

/// The name of an event: its mode and its surface.
pub(super) fn name_of(mode: Label, surface: Label) -> String {
    format!("{mode}: {surface}")
}

/// What stands behind the mode in which infinitely many events have a limit.
pub(super) const LIMIT: &str = ": Zeno limit";

/// What stands before the surface along which a state slides.
const SLIDES: &str = "slides on ";

/// What a mode is called, that slides along a surface.
pub(super) fn sliding_name(surface: &impl Debug) -> String {
    format!("{SLIDES}{}", plain(surface))
}

/// The mode and the surface of each event, and the mode of each Zeno limit. `name` is that of a mode.
///
/// How many events of an infinite series an execution lists before it knows the limit says nothing: they are left out.
pub(super) fn itinerary<M: Copy, S: Debug, X>(
    arcs: &[Arc<M, S, X>],
    name: impl Fn(M) -> String,
) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for arc in arcs {
        match &arc.end {
            ArcEnd::Event(event) => {
                names.push(format!("{}: {}", name(arc.mode), plain(&event.surface)));
            }
            ArcEnd::Zeno { .. } => {
                names.truncate(names.len() - repeated(&names));
                names.push(format!("{}{LIMIT}", name(arc.mode)));
            }
            _ => {}
        }
    }
    names
}

/// The number of names at the end that repeat the shortest sequence.
fn repeated(names: &[String]) -> usize {
    let count = |period: usize| {
        let pairs = names.iter().rev().zip(names.iter().rev().skip(period));
        period + pairs.take_while(|(a, b)| a == b).count()
    };
    let found = (1..=names.len() / 2).map(|period| (period, count(period)));
    found.filter(|(period, count)| *count >= 2 * period).map(|(_, count)| count).next().unwrap_or(0)
}

/// What the names of two pieces tell of their border: an infinite series of events on one side alone, or sliding.
pub(super) fn named_border(own: &[String], beyond: &[String], place: usize) -> Option<BorderSite> {
    let site = |border| BorderSite { border, itinerary: own.to_vec(), place, side: 1.0 };
    let limit = |names: &[String]| {
        names.iter().skip(place).find_map(|name| Some(name.strip_suffix(LIMIT)?.to_owned()))
    };
    let slides = |names: &[String]| {
        let slide = |name: &String| Some(name.strip_prefix(SLIDES)?.split(": ").next()?.to_owned());
        let all: Vec<String> = names.iter().skip(place).filter_map(slide).collect();
        (all.len(), all.into_iter().next())
    };
    match (limit(own), limit(beyond)) {
        (Some(mode), None) | (None, Some(mode)) => return Some(site(Border::Chattering { mode })),
        _ => {}
    }
    let (mine, other) = (slides(own), slides(beyond));
    let surface = if mine.0 > other.0 { mine.1 } else { other.1.filter(|_| other.0 > mine.0) };
    surface.map(|surface| site(Border::Sliding { surface }))
}
