//! What the arcs of a return tell.

use hybrid_system::{Arc, ArcEnd, Certainty, Label};
use nalgebra::DVector;

/// The arcs of a return.
pub(super) type ReturnArcs = Vec<Arc<Label, Label, DVector<f64>>>;

/// The time of some arcs.
pub(super) fn elapsed(arcs: &[Arc<Label, Label, DVector<f64>>]) -> f64 {
    match (arcs.first(), arcs.last()) {
        (Some(first), Some(last)) => last.time + last.duration - first.time,
        _ => 0.0,
    }
}

/// The certainty of the least certain event.
pub(super) fn least_certain(arcs: &[Arc<Label, Label, DVector<f64>>]) -> Certainty {
    let rank = |certainty: &Certainty| match certainty {
        Certainty::Exact => 0,
        Certainty::Certain => 1,
        Certainty::Interpolated => 2,
        Certainty::Sampled { .. } => 3,
    };
    let events = arcs.iter().filter_map(|arc| Some(arc.event()?.certainty));
    events.max_by_key(rank).unwrap_or(Certainty::Exact)
}

/// The name of an event: its mode and its surface.
pub(super) fn name_of(mode: Label, surface: Label) -> String {
    format!("{mode}: {surface}")
}

/// What stands behind the mode in which infinitely many events have a limit.
pub(super) const LIMIT: &str = ": Zeno limit";

/// The mode and the surface of each event, and the mode of each Zeno limit.
///
/// How many events of an infinite series an execution lists before it knows the limit says nothing: they are left out.
pub(super) fn itinerary(arcs: &[Arc<Label, Label, DVector<f64>>]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for arc in arcs {
        match &arc.end {
            ArcEnd::Event(event) => names.push(name_of(arc.mode, event.surface)),
            ArcEnd::Zeno { .. } => {
                names.truncate(names.len() - repeated(&names));
                names.push(format!("{}{LIMIT}", arc.mode));
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
