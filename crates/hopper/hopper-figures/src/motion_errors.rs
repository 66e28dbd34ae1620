//! How far the samples of a motion are from the exact motion.

use crate::error::Error;
use crate::motion::{Motion, Sample};
use passive_hopper::{
    BoundedOrbit, Enclosed, EnclosedHop, EnclosedStart, EnclosedState, LiftOffMap, MassRatio, Phase,
};

/// Bounds on the errors of a sample. Infinite where none is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleError {
    /// Of the time, if the sample is at the beginning or the end of a phase, which is an event. The time of any
    /// other sample is chosen, and has no error.
    pub time: f64,
    /// Of y₁, ẏ₁, y₂ and ẏ₂ at the time of the sample. At an event the phase of the sample counts, also some ulps
    /// beyond its end.
    pub state: [f64; 4],
}

/// A motion with bounds on the errors of its samples, one for each.
///
/// The exact orbit is followed in as many bits as it needs ([`BoundedOrbit`]). From the hop on that 1024 bits do
/// not decide, the errors of the samples are not known.
///
/// ```
/// use hopper_figures::motion_with_errors;
/// use passive_hopper::MassRatio;
/// let (motion, errors) = motion_with_errors(MassRatio::new(0.2)?, 7.0, 2)?;
/// assert_eq!(motion.samples.len(), errors.len());
/// assert!(errors.iter().all(|error| error.time < 1e-12 && error.state[0] < 1e-11));
/// # Ok::<(), hopper_figures::Error>(())
/// ```
///
/// # Errors
/// The errors of [`Motion::new`].
pub fn motion_with_errors(
    mass_ratio: MassRatio,
    alpha: f64,
    hops: usize,
) -> Result<(Motion, Vec<SampleError>), Error> {
    let mut exact = ExactMotion::new(mass_ratio, alpha, hops)?;
    let motion =
        Motion::watched(mass_ratio, alpha, hops, |arc| exact.follow(arc.samples, arc.phase))?;
    // The last sample is the lift-off at the end.
    exact.follow(&motion.samples, Phase::Flight);
    Ok((motion, exact.errors))
}

/// The exact motion, phase by phase.
struct ExactMotion {
    map: LiftOffMap,
    /// The lift-off speeds, from the first one.
    speeds: Vec<Enclosed>,
    /// Hops so far.
    hops: usize,
    /// The beginning of the phase: its time and its state.
    time: Enclosed,
    start: EnclosedStart,
    /// The hop, and the number of its landings so far; `None` if it is not certain.
    hop: Option<EnclosedHop>,
    landings: usize,
    errors: Vec<SampleError>,
}

const NONE: Enclosed = Enclosed { value: 0.0, error: 0.0 };
const UNKNOWN: Enclosed = Enclosed { value: 0.0, error: f64::INFINITY };

impl ExactMotion {
    fn new(mass_ratio: MassRatio, alpha: f64, hops: usize) -> Result<Self, Error> {
        let map = LiftOffMap::new(mass_ratio);
        let orbit = BoundedOrbit::follow(&map, alpha, hops)?;
        let speeds = orbit.speeds.into_iter().zip(orbit.errors);
        let speeds = speeds.map(|(value, error)| Enclosed { value, error }).collect();
        let start = EnclosedStart { excess: NONE, velocity: UNKNOWN };
        let mut exact = ExactMotion {
            map,
            speeds,
            hops: 0,
            time: NONE,
            start,
            hop: None,
            landings: 0,
            errors: Vec::new(),
        };
        exact.take_off();
        Ok(exact)
    }

    /// Begins the next hop.
    fn take_off(&mut self) {
        let speed = self.speeds.get(self.hops).copied().unwrap_or(UNKNOWN);
        self.hop = self.map.enclosed_hop(speed.value, speed.error).ok();
        self.start = EnclosedStart { excess: NONE, velocity: speed };
        self.landings = 0;
    }

    /// Adds the errors of the samples of a phase, which are those after the ones that it knows, and goes on to the
    /// next phase.
    fn follow(&mut self, samples: &[Sample], phase: Phase) {
        let own = &samples[self.errors.len().min(samples.len())..];
        let duration = self.duration(phase);
        let end = self.time.plus(duration);
        for (at, sample) in own.iter().enumerate() {
            let time = match at {
                0 => self.time.error_of(sample.time),
                _ if at + 1 == own.len() => end.error_of(sample.time),
                _ => 0.0,
            };
            let chosen = Enclosed { value: sample.time, error: 0.0 };
            let begun = Enclosed { value: -self.time.value, ..self.time };
            let state = self.state(phase, chosen.plus(begun));
            let errors = [
                state.upper_position.error_of(sample.state.upper_position),
                state.upper_velocity.error_of(sample.state.upper_velocity),
                state.lower_position.error_of(sample.state.lower_position),
                state.lower_velocity.error_of(sample.state.lower_velocity),
            ];
            self.errors.push(SampleError { time, state: errors });
        }
        self.time = end;
        self.next_phase(phase);
    }

    fn state(&self, phase: Phase, elapsed: Enclosed) -> EnclosedState {
        let mass_ratio = self.map.mass_ratio();
        match phase {
            Phase::Flight => self.start.after_flight(mass_ratio, elapsed),
            Phase::Contact => self.start.after_contact(mass_ratio, elapsed),
        }
    }

    /// How long the phase lasts.
    fn duration(&self, phase: Phase) -> Enclosed {
        let Some(hop) = &self.hop else { return UNKNOWN };
        match phase {
            Phase::Flight => {
                hop.landings.get(self.landings).map_or(UNKNOWN, |landing| landing.time)
            }
            Phase::Contact => hop.contact_time.unwrap_or(UNKNOWN),
        }
    }

    fn next_phase(&mut self, phase: Phase) {
        let landing = self.hop.as_ref().and_then(|hop| hop.landings.get(self.landings));
        if phase == Phase::Flight {
            let (excess, velocity) =
                landing.map_or((UNKNOWN, UNKNOWN), |landing| (landing.excess, landing.velocity));
            self.start = EnclosedStart { excess, velocity };
            self.landings += 1;
            return;
        }
        self.hops += 1;
        self.take_off();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The errors are those of the orbit: small, and none for what is exact.
    #[test]
    fn errors_grow_with_the_orbit_and_stay_honest() {
        let ratio = MassRatio::new(0.2).unwrap();
        let (motion, errors) = motion_with_errors(ratio, 7.0, 6).unwrap();
        assert_eq!(motion.samples.len(), errors.len());
        assert!(errors.iter().all(|error| error.state.iter().all(|x| *x < 1e-7)));
        let last = errors.last().unwrap();
        assert!(last.time > 0.0 && last.state[1] > 0.0);
        // At rest on the ground, up to the error of the time.
        assert!(last.state[2] < 1e-30 && last.state[3] < 1e-22, "{last:?}");
        assert_eq!((errors[0].time, errors[0].state), (0.0, [0.0; 4]));
    }

    /// The `f64` orbit leaves the exact one after some dozen chaotic hops. The errors say so.
    #[test]
    fn errors_tell_when_the_motion_has_left_the_exact_one() {
        let (_, errors) = motion_with_errors(MassRatio::new(20.0).unwrap(), 60.0, 60).unwrap();
        let largest = errors.iter().map(|error| error.state[0]).fold(0.0, f64::max);
        assert!(errors[0].state[0] < 1e-12 && largest > 1e-6, "{largest:e}");
    }
}
