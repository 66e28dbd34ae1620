//! The motion of both masses over some hops, sampled.

use crate::error::Error;
use hybrid_system::{ArcEnd, Execution, Limits};
use passive_hopper::{Hopper, HopperState, HopperSurface, MassRatio, Phase};
use std::f64::consts::TAU;

/// The largest distance of two samples, in units of 1/ω. The spring turns by this angle between them: the straight line between two
/// samples is off by an eight-hundredth of the amplitude, less than the width of a line.
const SPACING: f64 = 0.1;

/// The most samples of a motion: 64 MB. A motion of more would be a mistake, such as a million hops.
const MOST_SAMPLES: usize = 1_000_000;

/// The most arcs of a motion, which sudden lift-offs divide into more arcs than hops.
const MOST_ARCS: usize = 200_000;

/// A moment of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The time since the first lift-off, in units of 1/ω.
    pub time: f64,
    /// The number of gradual lift-offs before, without the first one.
    pub hop: usize,
    /// The phase.
    pub phase: Phase,
    /// Positions and velocities of both masses.
    pub state: HopperState,
}

/// What happens at an instant of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionEvent {
    /// The contact force vanishes, and the lower mass leaves the ground.
    GradualLiftOff,
    /// The lower mass lands and stays on the ground.
    Landing,
    /// The lower mass lands and is pulled off the ground at once by the stretched spring.
    SuddenLiftOff,
}

impl MotionEvent {
    /// The event at a surface, by the phase after it.
    fn of(surface: HopperSurface, after: Option<Phase>) -> Self {
        match (surface, after) {
            (HopperSurface::LiftOff, _) => MotionEvent::GradualLiftOff,
            (HopperSurface::Landing, Some(Phase::Flight)) => MotionEvent::SuddenLiftOff,
            (HopperSurface::Landing, _) => MotionEvent::Landing,
        }
    }
}

/// The motion over some hops. A landing has two samples at the same time: before the collision and after it.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// The mass ratio.
    pub mass_ratio: MassRatio,
    /// The samples in the order of time.
    pub samples: Vec<Sample>,
    /// The times of the events, in units of 1/ω, in their order. The gradual lift-off at the start is the first one.
    pub events: Vec<(f64, MotionEvent)>,
    /// Whether the hopper is grounded at the end.
    pub grounded: bool,
}

impl Motion {
    /// The motion that begins with a gradual lift-off with speed `alpha`, over `hops` hops or until the hopper is grounded.
    ///
    /// On the ground for ever it is followed for one period of the contact phase, or as long as it has hopped if that is shorter.
    ///
    /// ```
    /// use hopper_figures::{Motion, MotionEvent};
    /// use passive_hopper::MassRatio;
    /// let motion = Motion::new(MassRatio::new(0.2)?, 7.0, 2)?;
    /// let end = motion.samples.last().expect("it has samples");
    /// assert!(end.hop == 2 && end.state.upper_position == 1.0 && !motion.grounded);
    /// // The lower mass never is below the ground.
    /// assert!(motion.samples.iter().all(|sample| sample.state.lower_position > -1e-12));
    /// let landings = motion.events.iter().filter(|(_, event)| *event == MotionEvent::Landing);
    /// assert_eq!(landings.count(), 2);
    /// # Ok::<(), hopper_figures::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Hopper`] for a wrong speed; [`Error::Execution`] if a landing cannot be computed; [`Error::TooLong`] for a motion of
    /// more than a million samples.
    pub fn new(mass_ratio: MassRatio, alpha: f64, hops: usize) -> Result<Self, Error> {
        passive_hopper::LiftOffMap::new(mass_ratio).check_speed(alpha)?;
        let hopper = Hopper::new(mass_ratio);
        let start = HopperState::lift_off(alpha);
        let limits = Limits::new(f64::INFINITY, MOST_ARCS);
        let events = vec![(0.0, MotionEvent::GradualLiftOff)];
        let mut motion = Motion { mass_ratio, samples: Vec::new(), events, grounded: false };
        let mut hop = 0;
        for arc in Execution::new(&hopper, Phase::Flight, start.into(), limits) {
            let arc = arc?;
            if hop == hops {
                break;
            }
            let never = matches!(arc.end, ArcEnd::Never { .. });
            let period = TAU / mass_ratio.contact_frequency();
            let duration = if never { period.min(arc.time) } else { arc.duration };
            let steps = (duration / SPACING).ceil().max(1.0);
            if !(steps <= (MOST_SAMPLES - motion.samples.len()) as f64) {
                let duration = arc.time + duration;
                return Err(Error::TooLong { duration, most: MOST_SAMPLES });
            }
            // The arc before ends at this instant; the sum of its start and its duration may be an ulp off.
            if let Some(last) = motion.samples.last_mut() {
                last.time = arc.time;
            }
            for k in 0..=steps as usize {
                let elapsed = duration * (k as f64 / steps);
                let state = arc.state(&hopper, elapsed)?.into();
                let time = arc.time + elapsed;
                motion.samples.push(Sample { time, hop, phase: arc.mode, state });
            }
            motion.grounded = never;
            if let Some(event) = arc.event() {
                let kind = MotionEvent::of(event.surface, event.after.map(|(phase, _)| phase));
                motion.events.push((event.time, kind));
            }
            let lift_off = arc.event().filter(|event| event.surface == HopperSurface::LiftOff);
            if let Some((phase, state)) = lift_off.and_then(|event| event.after) {
                hop += 1;
                if hop == hops {
                    let (time, state) = (arc.time + arc.duration, state.into());
                    motion.samples.push(Sample { time, hop, phase, state });
                    break;
                }
            }
        }
        Ok(motion)
    }

    /// The time of the last sample.
    pub fn duration(&self) -> f64 {
        self.samples.last().map_or(0.0, |sample| sample.time)
    }

    /// The state at a time, on the straight line between the samples before and after it; `None` for a motion without samples.
    pub fn at(&self, time: f64) -> Option<HopperState> {
        let after = self.samples.partition_point(|sample| sample.time <= time);
        let before = self.samples.get(after.saturating_sub(1))?;
        let Some(after) = self.samples.get(after) else { return Some(before.state) };
        let part = ((time - before.time) / (after.time - before.time)).clamp(0.0, 1.0);
        let (from, to) = (before.state, after.state);
        let between = |of: fn(&HopperState) -> f64| of(&from) + part * (of(&to) - of(&from));
        Some(HopperState {
            upper_position: between(|s| s.upper_position),
            upper_velocity: between(|s| s.upper_velocity),
            lower_position: between(|s| s.lower_position),
            lower_velocity: between(|s| s.lower_velocity),
        })
    }

    /// The smallest and the largest value of a coordinate.
    pub(crate) fn range(&self, of: impl Fn(&HopperState) -> f64) -> (f64, f64) {
        let values = self.samples.iter().map(|sample| of(&sample.state));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        })
    }
}
