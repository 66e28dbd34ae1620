//! The scenes of the page `hybrid_system::semantics`: small systems in which something happens at once, slides or
//! touches. Tests and a figure share them.
//!
//! All flows have a constant second derivative, and all guards are affine. Therefore each scene can be run with
//! signals, with samples and by integration, and its exact result is known.

use hybrid_system::{
    Error, Guard, HybridSystem, NextEvent, QuasiPolynomial, Reset, Search, State, Tolerances,
    Touch, default_search, integrated_crossing, integrated_flow,
};
use nalgebra::SVector;

/// Tolerances of the integrated runs. The flows are polynomials of degree two, which every step gives exactly.
const TOLERANCES: Tolerances = Tolerances::both(1e-10);

/// How the guards of a scene are searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    /// Under bounds: the guards are quasi-polynomials.
    Signal,
    /// At samples: the scene has a flow and no more.
    Samples,
    /// Along the integrated flow.
    Integration,
}

/// All ways to search.
pub const WAYS: [By; 3] = [By::Signal, By::Samples, By::Integration];

/// A scene: modes and surfaces are numbers.
#[derive(Debug, Clone, Copy)]
pub struct Scene<const N: usize> {
    /// ẋ in a mode.
    pub field: fn(u8, &State<N>) -> State<N>,
    /// ẍ in a mode, constant.
    pub second: fn(u8) -> State<N>,
    /// The guards of each mode. A mode without an entry has no guards.
    pub guards: &'static [&'static [Guard<u8>]],
    /// Normal n and offset c of a surface: g = n·x − c.
    pub plane: fn(u8) -> (State<N>, f64),
    /// Mode and state after an event in a mode, at a surface.
    pub reset: fn(u8, u8, &State<N>) -> (u8, State<N>),
    /// How the guards are searched.
    pub by: By,
}

impl<const N: usize> Scene<N> {
    /// The scene with its guards searched in another way.
    #[must_use]
    pub const fn by(mut self, by: By) -> Self {
        self.by = by;
        self
    }
}

/// No second derivative: uniform motion.
fn uniform<const N: usize>(_: u8) -> State<N> {
    State::zeros()
}

impl<const N: usize> HybridSystem for Scene<N> {
    type State = State<N>;
    type Mode = u8;
    type Surface = u8;

    fn flow(&self, mode: u8, x: &State<N>, t: f64) -> State<N> {
        match self.by {
            By::Signal | By::Samples => {
                x + ((self.field)(mode, x) + (self.second)(mode) * (0.5 * t)) * t
            }
            By::Integration => integrated_flow(self, mode, x, t, TOLERANCES),
        }
    }

    fn guards(&self, mode: u8) -> &[Guard<u8>] {
        self.guards.get(usize::from(mode)).copied().unwrap_or(&[])
    }

    fn guard_value(&self, surface: u8, x: &State<N>) -> f64 {
        let (normal, offset) = (self.plane)(surface);
        normal.dot(x) - offset
    }

    fn reset(&self, mode: u8, surface: u8, x: &State<N>) -> Reset<u8, State<N>> {
        let (mode, state) = (self.reset)(mode, surface, x);
        Reset::Jump { mode, state }
    }

    fn vector_field(&self, mode: u8, x: &State<N>) -> Option<State<N>> {
        (self.by == By::Integration).then(|| (self.field)(mode, x))
    }

    fn guard_quasi_polynomial(
        &self,
        mode: u8,
        surface: u8,
        x: &State<N>,
    ) -> Option<QuasiPolynomial> {
        let (normal, offset) = (self.plane)(surface);
        let rate = normal.dot(&(self.field)(mode, x));
        let half = 0.5 * normal.dot(&(self.second)(mode));
        (self.by == By::Signal)
            .then(|| QuasiPolynomial::polynomial(&[normal.dot(x) - offset, rate, half]))
    }

    fn first_crossing(
        &self,
        mode: u8,
        x: &State<N>,
        search: &Search<u8>,
    ) -> Result<NextEvent<u8, State<N>>, Error> {
        match self.by {
            By::Signal | By::Samples => default_search(self, mode, x, search),
            By::Integration => integrated_crossing(self, mode, x, search, TOLERANCES),
        }
    }
}

/// The surface between ball 1 and ball 2, and between ball 2 and ball 3.
pub const FIRST_PAIR: u8 = 0;
/// The surface between ball 2 and ball 3.
pub const SECOND_PAIR: u8 = 1;

/// Newton's cradle: three equal elastic balls on a line. Positions x₁ ≤ x₂ ≤ x₃, without the diameters; velocities.
/// Balls that meet swap their velocities.
pub const CRADLE: Scene<6> = Scene {
    field: |_, x| State::from([x[3], x[4], x[5], 0.0, 0.0, 0.0]),
    second: uniform,
    guards: &[&[Guard::falling(FIRST_PAIR).contact(), Guard::falling(SECOND_PAIR).contact()]],
    plane: |surface| {
        let mut normal = SVector::zeros();
        normal[usize::from(surface)] = -1.0;
        normal[usize::from(surface) + 1] = 1.0;
        (normal, 0.0)
    },
    reset: |_, surface, x| {
        let mut after = *x;
        after.swap_rows(3 + usize::from(surface), 4 + usize::from(surface));
        (0, after)
    },
    by: By::Signal,
};

/// Ball 1 comes with velocity 1. Balls 2 and 3 touch.
pub fn cradle_start() -> State<6> {
    State::from([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
}

/// The floor below the lower ball.
pub const FLOOR: u8 = 0;
/// The gap between the balls.
pub const BETWEEN: u8 = 1;

/// A ball on top of another one, elastic, under gravity 1. The lower ball has twice the mass. State: heights y₁ ≤ y₂,
/// without the diameters; velocities.
pub const STACK: Scene<4> = Scene {
    field: |_, x| State::from([x[2], x[3], -1.0, -1.0]),
    second: |_| State::from([-1.0, -1.0, 0.0, 0.0]),
    guards: &[&[Guard::falling(FLOOR).contact(), Guard::falling(BETWEEN).contact()]],
    plane: |surface| match surface {
        FLOOR => (State::from([1.0, 0.0, 0.0, 0.0]), 0.0),
        _ => (State::from([-1.0, 1.0, 0.0, 0.0]), 0.0),
    },
    reset: |_, surface, x| match surface {
        FLOOR => (0, State::from([x[0], x[1], -x[2], x[3]])),
        // Both velocities are mirrored at that of the centre of mass.
        _ => {
            let center = (2.0 * x[2] + x[3]) / 3.0;
            (0, State::from([x[0], x[1], 2.0 * center - x[2], 2.0 * center - x[3]]))
        }
    },
    by: By::Signal,
};

/// The mode of a relay below its surface, x < 0, and above it.
pub const BELOW: u8 = 0;
/// The mode of a relay above its surface, x > 0.
pub const ABOVE: u8 = 1;

/// A relay with a drift: ẋ = −sgn x + 0.3, ẏ = 1 above and −1 below. The state is left where the surface is crossed.
pub const RELAY: Scene<2> = Scene {
    field: |mode, _| {
        if mode == BELOW { State::from([1.3, -1.0]) } else { State::from([-0.7, 1.0]) }
    },
    second: uniform,
    guards: &[&[Guard::rising(0)], &[Guard::falling(0)]],
    plane: |_| (State::from([1.0, 0.0]), 0.0),
    reset: |mode, _, x| (if mode == BELOW { ABOVE } else { BELOW }, *x),
    by: By::Signal,
};

/// The same relay with resets that put x to 0 exactly.
pub const SNAPPING_RELAY: Scene<2> = Scene {
    reset: |mode, _, x| (if mode == BELOW { ABOVE } else { BELOW }, State::from([0.0, x[1]])),
    ..RELAY
};

/// ẋ = 1 in six modes. Each of the first five leaves at x = 1, by a surface of its own. The sixth has no guard.
pub const FIVE_MODES: Scene<1> = Scene {
    field: |_, _| State::from([1.0]),
    second: uniform,
    guards: &[
        &[Guard::rising(0).contact()],
        &[Guard::rising(1).contact()],
        &[Guard::rising(2).contact()],
        &[Guard::rising(3).contact()],
        &[Guard::rising(4).contact()],
    ],
    plane: |_| (State::from([1.0]), 1.0),
    reset: |mode, _, x| (mode + 1, *x),
    by: By::Signal,
};

/// ẋ = 1. Mode 0 is left at x = 1, mode 1 at x = ½: the jump into mode 1 leads beyond its surface.
pub const PAST_GUARD: Scene<1> = Scene {
    guards: &[&[Guard::rising(0)], &[Guard::rising(1).contact()]],
    plane: |surface| (State::from([1.0]), if surface == 0 { 1.0 } else { 0.5 }),
    ..FIVE_MODES
};

/// The same with a guard that says neither that it is a contact nor that it is a crossing.
pub const PAST_SWITCH: Scene<1> =
    Scene { guards: &[&[Guard::rising(0)], &[Guard::rising(1)]], ..PAST_GUARD };

/// The same with a crossing.
pub const PAST_CROSSING: Scene<1> =
    Scene { guards: &[&[Guard::rising(0)], &[Guard::rising(1).crossing()]], ..PAST_GUARD };

/// A ball over a floor at 0, under gravity 1, that keeps half of its speed. State: height and velocity.
pub const BALL: Scene<2> = Scene {
    field: |_, x| State::from([x[1], -1.0]),
    second: |_| State::from([-1.0, 0.0]),
    guards: &[&[Guard::falling(FLOOR).contact()]],
    plane: |_| (State::from([1.0, 0.0]), 0.0),
    reset: |_, _, x| (0, State::from([x[0].max(0.0), -0.5 * x[1]])),
    by: By::Signal,
};

/// The surface x = 15 from which [`LEAP`] jumps.
pub const TOP: u8 = 0;
/// The surface x = 0 that lies between both sides of the jump.
pub const ZERO: u8 = 1;

/// ẋ = 1 up to x = 15, where x jumps to −20, over the surface x = 0. That surface bounds the flow, x > 0; its reset
/// puts x to 5.
pub const LEAP: Scene<1> = Scene {
    guards: &[&[Guard::rising(TOP), Guard::falling(ZERO).contact()]],
    plane: |surface| (State::from([1.0]), if surface == TOP { 15.0 } else { 0.0 }),
    reset: |_, surface, _| (0, State::from([if surface == TOP { -20.0 } else { 5.0 }])),
    ..FIVE_MODES
};

/// The same with a crossing at x = 0. Its reset changes nothing.
pub const WATCHED_LEAP: Scene<1> = Scene {
    guards: &[&[Guard::rising(TOP), Guard::either(ZERO).crossing()]],
    reset: |_, surface, x| (0, if surface == TOP { State::from([-20.0]) } else { *x }),
    ..LEAP
};

/// ẋ = 1. Mode 0 is left upwards at x = 1 and mode 1 downwards at x = 3, with x left as it is: at x = 1 the state is
/// beyond both surfaces.
pub const ENDLESS: Scene<1> = Scene {
    guards: &[&[Guard::rising(0).contact()], &[Guard::falling(1).contact()]],
    plane: |surface| (State::from([1.0]), if surface == 0 { 1.0 } else { 3.0 }),
    reset: |mode, _, x| (1 - mode, *x),
    ..FIVE_MODES
};

/// A ball under gravity 1 below a ceiling at 2. State: height and velocity. A touch of the ceiling is an error.
pub const CEILING: Scene<2> = Scene {
    guards: &[&[Guard::rising(0)]],
    plane: |_| (State::from([1.0, 0.0]), 2.0),
    reset: |_, _, x| (0, State::from([x[0], -x[1]])),
    ..BALL
};

/// The same with a touch as an event, which leaves the state as it is.
pub const TOUCHED_CEILING: Scene<2> = Scene {
    guards: &[&[Guard::rising(0).touch(Touch::Event)]],
    reset: |_, _, x| (0, *x),
    ..CEILING
};

/// The same with touches ignored.
pub const IGNORED_CEILING: Scene<2> =
    Scene { guards: &[&[Guard::rising(0).touch(Touch::Ignore)]], ..CEILING };

/// Thrown upwards with velocity 2, the ball just reaches the ceiling at t = 2.
pub fn throw() -> State<2> {
    State::from([0.0, 2.0])
}
