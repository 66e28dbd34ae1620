//! Motions obey the energy, drawings hold their curves and labels, and windows that cannot be drawn are refused.

#![allow(clippy::unwrap_used)]

use hopper_figures::{
    Error, MapPlot, Motion, MotionEvent, cuts_between, draw_frame, draw_motion, frame_times,
};
use hybrid_system::{Execution, Limits};
use journal_figures::render;
use passive_hopper::{Hopper, HopperState, LiftOffMap, MassRatio, Phase, alpha_star, energy};

fn ratio(m: f64) -> MassRatio {
    MassRatio::new(m).unwrap()
}

#[test]
fn the_energy_falls_at_landings_only() {
    for (m, alpha, hops) in [(0.2, 7.0, 3), (1.0, 2.0, 2), (5.0, 12.0, 2)] {
        let motion = Motion::new(ratio(m), alpha, hops).unwrap();
        let (mut landings, mut last) = (0, None);
        for sample in &motion.samples {
            let now = energy(ratio(m), &sample.state);
            let (time, before) = last.unwrap_or((0.0, now));
            assert!(sample.time >= time && sample.state.lower_position > -1e-9);
            if sample.time > time {
                assert!((now - before).abs() < 1e-9 * (1.0 + now.abs()), "M = {m}, τ = {time}");
            } else if now < before - 1e-9 {
                landings += 1;
            }
            last = Some((sample.time, now));
        }
        assert!(landings >= 1, "M = {m}: {landings}");
    }
}

/// The map decides the hops of a motion. The hybrid system, which searches each event from the state before it, has
/// the same events.
#[test]
fn the_events_are_those_of_the_hybrid_system() {
    for (m, alpha, hops) in [(0.2, 7.0, 4), (1.0, 9.5, 3), (5.0, 12.0, 2), (1.0, 2.0, 3)] {
        let motion = Motion::new(ratio(m), alpha, hops).unwrap();
        let hopper = Hopper::new(ratio(m));
        let limits = Limits::new(f64::INFINITY, motion.events.len() - 1);
        let start = HopperState::lift_off(alpha).into();
        let arcs = Execution::new(&hopper, Phase::Flight, start, limits);
        let mut time = 0.0;
        for (arc, (when, event)) in arcs.zip(&motion.events[1..]) {
            let arc = arc.unwrap();
            time += arc.duration;
            assert!((time - when).abs() < 1e-10 * (1.0 + time), "M = {m}: {time} {when}");
            let (phase, state) = arc.event().unwrap().after.unwrap();
            let sudden = arc.mode == Phase::Flight && phase == Phase::Flight;
            assert_eq!(*event == MotionEvent::SuddenLiftOff, sudden, "M = {m}, τ = {time}");
            let (after, now) = (HopperState::from(state), motion.at(*when).unwrap());
            assert!((after.upper_position - now.upper_position).abs() < 1e-9);
            assert!((after.upper_velocity - now.upper_velocity).abs() < 1e-9);
        }
        assert!(motion.events.len() >= 2, "M = {m}");
    }
}

#[test]
fn a_grounded_hopper_stays_in_contact() {
    let motion = Motion::new(ratio(1.0), 2.0, 5).unwrap();
    assert!(motion.grounded);
    assert_eq!(motion.samples.last().unwrap().phase, Phase::Contact);
    let none = Motion::new(ratio(0.2), 7.0, 0).unwrap();
    assert!(none.samples.is_empty() && none.at(1.0).is_none() && none.duration() == 0.0);
}

#[test]
fn a_state_between_samples_lies_between_them() {
    let motion = Motion::new(ratio(0.2), 7.0, 1).unwrap();
    for pair in motion.samples.windows(2) {
        let middle = motion.at(0.5 * (pair[0].time + pair[1].time)).unwrap().upper_position;
        let (a, b) = (pair[0].state.upper_position, pair[1].state.upper_position);
        assert!(middle >= a.min(b) - 1e-12 && middle <= a.max(b) + 1e-12);
    }
    let end = motion.samples.last().unwrap();
    assert_eq!(motion.at(1e9), Some(end.state));
}

#[test]
fn drawings_render_with_their_labels() {
    let motion = Motion::new(ratio(0.2), 7.0, 2).unwrap();
    let times = frame_times(&motion).unwrap();
    assert!(times.len() > 20 && times.is_sorted() && times.last() == Some(&motion.duration()));
    let (map, orbit) = (LiftOffMap::new(ratio(0.2)), [7.0, 5.4319312674983316]);
    let window = MapPlot::window_of(&orbit, false);
    let plot = MapPlot { map: &map, window, orbit: &orbit, grounded: false };
    let drawings = [
        (draw_motion(&motion), "units of 1/"),
        (draw_frame(&motion, times[10]), "units of 1/"),
        (plot.draw().unwrap(), "next lift-off speed"),
    ];
    for (svg, label) in drawings {
        let text = render("drawing", &svg, 1.0).unwrap().svg;
        assert!(text.contains(label) && text.contains("M = 0.2"), "{label}");
    }
    // An orbit that begins at a fixed point has a window about it.
    let (from, to) = MapPlot::window_of(&[alpha_star(1)], false);
    assert!(from < alpha_star(1) && alpha_star(1) < to);
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    assert!(matches!(cuts_between(3.0, 3.0), Err(Error::EmptyWindow { .. })));
    assert!(matches!(cuts_between(0.0, 1e6), Err(Error::TooWide { most: 200, .. })));
    assert!(matches!(cuts_between(-1.0, 1.0), Err(Error::Hopper(_))));
    assert!(matches!(cuts_between(0.0, f64::NAN), Err(Error::Hopper(_))));
    let cuts = cuts_between(0.0, 7.0).unwrap();
    assert!(cuts.is_sorted() && cuts.contains(&alpha_star(1)) && cuts[0] > 0.0);
    assert!(matches!(Motion::new(ratio(0.2), 1e12, 1), Err(Error::TooLong { .. })));
    assert!(matches!(Motion::new(ratio(0.2), f64::NAN, 1), Err(Error::Hopper(_))));
    let long = Motion::new(ratio(0.2), 4.55, 100).unwrap();
    assert!(matches!(frame_times(&long), Err(Error::TooManyFrames { most: 1200, .. })));
}
