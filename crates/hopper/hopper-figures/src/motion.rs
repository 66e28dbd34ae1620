//! The motion of both masses over some hops, sampled.
//!
//! The lift-off map decides each hop: its landings and the next lift-off speed. Between them the states are closed
//! forms, so that the drawn landings are those of the orbit, and no event is searched for.

use crate::error::Error;
use passive_hopper::{
    Flight, HopperState, Landing, LiftOffMap, MassRatio, Phase, contact_flow, contact_time,
};
use std::f64::consts::TAU;

/// The largest distance of two samples, in units of 1/ω. The spring turns by this angle between them: the straight
/// line between two samples is off by an eight-hundredth of the amplitude, less than the width of a line.
const SPACING: f64 = 0.1;

/// The most samples of a motion: 64 MB. A motion of more would be a mistake, such as a million hops.
const MOST_SAMPLES: usize = 1_000_000;

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

/// A phase of a motion, and all samples up to its end.
pub(crate) struct Arc<'a> {
    pub(crate) samples: &'a [Sample],
    pub(crate) phase: Phase,
}

impl Motion {
    /// The motion that begins with a gradual lift-off with speed `alpha`, over `hops` hops or until the hopper is
    /// grounded.
    ///
    /// On the ground for ever it is followed for one period of the contact phase, or as long as it has hopped if
    /// that is shorter.
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
    /// [`Error::Hopper`] for a wrong speed, and for a hop that cannot be decided; [`Error::TooLong`] for a motion of
    /// more than a million samples.
    pub fn new(mass_ratio: MassRatio, alpha: f64, hops: usize) -> Result<Self, Error> {
        Self::watched(mass_ratio, alpha, hops, |_| ())
    }

    /// The same; `see` receives each phase after its samples were added.
    pub(crate) fn watched(
        mass_ratio: MassRatio,
        alpha: f64,
        hops: usize,
        mut see: impl FnMut(Arc<'_>),
    ) -> Result<Self, Error> {
        let map = LiftOffMap::new(mass_ratio);
        map.check_speed(alpha)?;
        let events = vec![(0.0, MotionEvent::GradualLiftOff)];
        let mut motion = Motion { mass_ratio, samples: Vec::new(), events, grounded: false };
        let (mut time, mut state) = (0.0, HopperState::lift_off(alpha));
        for hop in 0..hops {
            let speed = state.upper_velocity;
            let mut landed = None;
            for landing in map.landings(speed)? {
                let flight = Flight::new(mass_ratio, &state);
                motion.sample(hop, Phase::Flight, time, landing.time, |at| flight.state(at))?;
                see(Arc { samples: &motion.samples, phase: Phase::Flight });
                time += landing.time;
                state = after(&landing);
                let kind =
                    if landing.sudden { MotionEvent::SuddenLiftOff } else { MotionEvent::Landing };
                motion.events.push((time, kind));
                landed = Some(landing);
            }
            let contact = match landed {
                Some(Landing { excess, velocity, .. }) => {
                    contact_time(mass_ratio, excess, velocity)?
                }
                None => None,
            };
            let next = map.image(speed)?.zip(contact);
            let period = TAU / mass_ratio.contact_frequency();
            let duration = next.map_or(period.min(time), |(_, contact)| contact);
            let flow = |at| contact_flow(mass_ratio, &state, at);
            motion.sample(hop, Phase::Contact, time, duration, flow)?;
            see(Arc { samples: &motion.samples, phase: Phase::Contact });
            let Some((speed, _)) = next else {
                motion.grounded = true;
                return Ok(motion);
            };
            time += duration;
            state = HopperState::lift_off(speed);
            motion.events.push((time, MotionEvent::GradualLiftOff));
        }
        if hops > 0 {
            motion.samples.push(Sample { time, hop: hops, phase: Phase::Flight, state });
        }
        Ok(motion)
    }

    /// A motion from samples of another source: a part of a motion, or one that was changed. It has no events.
    ///
    /// # Errors
    /// [`Error::NoMotion`] for no samples, times that fall, or a number that is not finite; [`Error::TooLong`] for
    /// more than a million.
    pub fn from_samples(mass_ratio: MassRatio, samples: Vec<Sample>) -> Result<Self, Error> {
        let reason = |index: usize, reason: &'static str| Error::NoMotion { index, reason };
        if samples.is_empty() {
            return Err(reason(0, "there are no samples"));
        }
        if samples.len() > MOST_SAMPLES {
            let duration = samples[samples.len() - 1].time;
            return Err(Error::TooLong { duration, most: MOST_SAMPLES });
        }
        for (index, Sample { time, state, .. }) in samples.iter().enumerate() {
            let HopperState { upper_position, upper_velocity, lower_position, lower_velocity } =
                state;
            let numbers = [time, upper_position, upper_velocity, lower_position, lower_velocity];
            if !numbers.into_iter().all(|x| x.is_finite()) {
                return Err(reason(index, "a number is not finite"));
            }
            if index > 0 && *time < samples[index - 1].time {
                return Err(reason(index, "its time is before that of the sample before"));
            }
        }
        Ok(Motion { mass_ratio, samples, events: Vec::new(), grounded: false })
    }

    /// Adds the samples of an arc that begins at `start`.
    fn sample(
        &mut self,
        hop: usize,
        phase: Phase,
        start: f64,
        duration: f64,
        state_at: impl Fn(f64) -> HopperState,
    ) -> Result<(), Error> {
        let steps = (duration / SPACING).ceil().max(1.0);
        if !(steps <= (MOST_SAMPLES - self.samples.len()) as f64) {
            return Err(Error::TooLong { duration: start + duration, most: MOST_SAMPLES });
        }
        for k in 0..=steps as usize {
            let elapsed = duration * (k as f64 / steps);
            let (time, state) = (start + elapsed, state_at(elapsed));
            self.samples.push(Sample { time, hop, phase, state });
        }
        Ok(())
    }

    /// The time of the first sample.
    pub fn start(&self) -> f64 {
        self.samples.first().map_or(0.0, |sample| sample.time)
    }

    /// The time of the last sample.
    pub fn duration(&self) -> f64 {
        self.samples.last().map_or(0.0, |sample| sample.time)
    }

    /// The state at a time, on the straight line between the samples before and after it; `None` for a motion
    /// without samples.
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

/// The state after a landing: both masses as the collision leaves them.
fn after(landing: &Landing) -> HopperState {
    HopperState {
        upper_position: 1.0 + landing.excess,
        upper_velocity: landing.velocity,
        lower_position: 0.0,
        lower_velocity: 0.0,
    }
}
