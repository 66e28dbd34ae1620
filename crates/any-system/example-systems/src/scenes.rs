//! The scenes of the page `hybrid_system::semantics`: small systems in which something happens at once, slides or
//! touches. Tests and a figure share them.
//!
//! Each scene is written once, as equations. All flows have a constant second derivative, and all guards are affine.
//! Therefore each scene can be run in five ways, and its exact result is known.

use hybrid_system::{
    Equations, EquationsModel, Error, Guard, HybridSystem, Label, NextEvent, QuasiPolynomial,
    Reset, Search, State, Tolerances, Touch, default_search, integrated_crossing, integrated_flow,
};

/// Tolerances of the integrated runs. The flows are polynomials of degree two, which every step gives exactly.
const TOLERANCES: Tolerances = Tolerances::both(1e-10);

/// How a scene is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    /// As a model with a flow and signals: the guards are quasi-polynomials. It has no field.
    Signal,
    /// As a model with a flow and no more, at samples.
    Samples,
    /// As a model with a field, by a Runge–Kutta method.
    Integration,
    /// As equations, whose closed form is found.
    ClosedForm,
    /// As equations, by Taylor series.
    Series,
}

/// All ways.
pub const WAYS: [By; 5] = [By::Signal, By::Samples, By::Integration, By::ClosedForm, By::Series];

/// All ways in which no event is missed.
pub const SURE_WAYS: [By; 4] = [By::Signal, By::Integration, By::ClosedForm, By::Series];

/// A scene, and how it is run.
#[derive(Debug, Clone)]
pub struct Scene<const N: usize> {
    model: EquationsModel<State<N>>,
    by: By,
}

impl<const N: usize> Scene<N> {
    /// A scene with these components of the state, whose modes and guards are added to its equations.
    pub fn new(
        by: By,
        states: &[&str],
        add: impl FnOnce(Equations) -> Equations,
    ) -> Result<Self, Error> {
        let mut equations = Equations::new(states, &[]);
        if by == By::Series {
            // An observer that has no closed form, and no event.
            equations = equations.rising_text("nothing", &format!("1 + exp(-{}^2)", states[0]));
        }
        Ok(Scene { model: add(equations).model()?, by })
    }

    fn has_equations(&self) -> bool {
        matches!(self.by, By::ClosedForm | By::Series)
    }
}

impl<const N: usize> HybridSystem for Scene<N> {
    type State = State<N>;
    type Mode = Label;
    type Surface = Label;

    fn flow(&self, mode: Label, x: &State<N>, t: f64) -> State<N> {
        match self.by {
            By::Integration => integrated_flow(self, mode, x, t, TOLERANCES),
            _ => self.model.flow(mode, x, t),
        }
    }

    fn guards(&self, mode: Label) -> &[Guard<Label>] {
        self.model.guards(mode)
    }

    fn guard_value(&self, surface: Label, x: &State<N>) -> f64 {
        self.model.guard_value(surface, x)
    }

    fn reset(&self, mode: Label, surface: Label, x: &State<N>) -> Reset<Label, State<N>> {
        self.model.reset(mode, surface, x)
    }

    fn vector_field(&self, mode: Label, x: &State<N>) -> Option<State<N>> {
        let has_field = self.has_equations() || self.by == By::Integration;
        has_field.then(|| self.model.vector_field(mode, x))?
    }

    fn guard_error(&self, surface: Label, x: &State<N>) -> Option<f64> {
        self.has_equations().then(|| self.model.guard_error(surface, x))?
    }

    fn guard_quasi_polynomial(
        &self,
        mode: Label,
        surface: Label,
        x: &State<N>,
    ) -> Option<QuasiPolynomial> {
        let has_signal = self.has_equations() || self.by == By::Signal;
        has_signal.then(|| self.model.guard_quasi_polynomial(mode, surface, x))?
    }

    fn first_crossing(
        &self,
        mode: Label,
        x: &State<N>,
        search: &Search<Label>,
    ) -> Result<NextEvent<Label, State<N>>, Error> {
        match self.by {
            By::Signal | By::Samples => default_search(self, mode, x, search),
            By::Integration => integrated_crossing(self, mode, x, search, TOLERANCES),
            By::ClosedForm | By::Series => self.model.first_crossing(mode, x, search),
        }
    }
}

/// Newton's cradle: three equal elastic balls on a line. Positions x₁ ≤ x₂ ≤ x₃, without the diameters; velocities.
/// Balls that meet swap their velocities.
pub fn cradle(by: By) -> Result<Scene<6>, Error> {
    Scene::new(by, &["x1", "x2", "x3", "v1", "v2", "v3"], |equations| {
        equations
            .mode_text("cradle", &["v1", "v2", "v3", "0", "0", "0"])
            .falling_text("first pair", "x2 - x1")
            .resets_text(&["x1", "x2", "x3", "v2", "v1", "v3"])
            .contact()
            .falling_text("second pair", "x3 - x2")
            .resets_text(&["x1", "x2", "x3", "v1", "v3", "v2"])
            .contact()
    })
}

/// Ball 1 comes with velocity 1. Balls 2 and 3 touch.
pub fn cradle_start() -> State<6> {
    State::from([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
}

/// A ball on top of another one, elastic, under gravity 1. The lower ball has twice the mass. State: heights y₁ ≤ y₂,
/// without the diameters; velocities. A collision mirrors both velocities at that of the centre of mass.
pub fn stack(by: By) -> Result<Scene<4>, Error> {
    Scene::new(by, &["y1", "y2", "v1", "v2"], |equations| {
        equations
            .mode_text("flight", &["v1", "v2", "-1", "-1"])
            .falling_text("floor", "y1")
            .resets_text(&["y1", "y2", "-v1", "v2"])
            .contact()
            .falling_text("between", "y2 - y1")
            .resets_text(&["y1", "y2", "2*(2*v1 + v2)/3 - v1", "2*(2*v1 + v2)/3 - v2"])
            .contact()
    })
}

/// A relay with a drift: ẋ = −sgn x + 0.3, ẏ = 1 above and −1 below. The state is left where the surface is crossed.
pub fn relay(by: By) -> Result<Scene<2>, Error> {
    relay_with(by, "x")
}

/// The same relay with resets that put x to 0 exactly.
pub fn snapping_relay(by: By) -> Result<Scene<2>, Error> {
    relay_with(by, "0")
}

fn relay_with(by: By, after: &str) -> Result<Scene<2>, Error> {
    Scene::new(by, &["x", "y"], |equations| {
        equations
            .mode_text("below", &["1.3", "-1"])
            .rising_text("x = 0", "x")
            .resets_text(&[after, "y"])
            .to("above")
            .mode_text("above", &["-0.7", "1"])
            .falling_text("x = 0", "x")
            .resets_text(&[after, "y"])
            .to("below")
    })
}

/// ẋ = 1 in six modes. Each of the first five leaves at x = 1, by a surface of its own. The sixth has no guard.
pub fn five_modes(by: By) -> Result<Scene<1>, Error> {
    Scene::new(by, &["x"], |equations| {
        let leaving = (0..5).fold(equations, |equations, k| {
            let guard = equations.mode_text(&format!("{k}"), &["1"]);
            let guard = guard.rising_text(&format!("{k}"), "x - 1");
            guard.to(&format!("{}", k + 1)).contact()
        });
        leaving.mode_text("5", &["1"])
    })
}

/// ẋ = 1. Mode 0 is left at x = 1, mode 1 at x = ½: the jump into mode 1 leads beyond its surface.
pub fn past_guard(by: By) -> Result<Scene<1>, Error> {
    past(by, Equations::contact)
}

/// The same with a guard that says neither that it is a contact nor that it is a crossing.
pub fn past_switch(by: By) -> Result<Scene<1>, Error> {
    past(by, |guard| guard)
}

/// The same with a crossing.
pub fn past_crossing(by: By) -> Result<Scene<1>, Error> {
    past(by, Equations::crossing)
}

fn past(by: By, declared: fn(Equations) -> Equations) -> Result<Scene<1>, Error> {
    Scene::new(by, &["x"], |equations| {
        let first = equations.mode_text("0", &["1"]).rising_text("x = 1", "x - 1").to("1");
        let second = first.mode_text("1", &["1"]).rising_text("x = ½", "x - 0.5").to("2");
        declared(second).mode_text("2", &["1"])
    })
}

/// A ball over a floor at 0, under gravity 1, that keeps half of its speed. State: height and velocity.
pub fn ball(by: By) -> Result<Scene<2>, Error> {
    bouncing(by, "height", &["max(height, 0)", "-0.5*speed"])
}

/// A ball over a floor where this guard is zero, with this state after an impact.
pub fn bouncing(by: By, floor: &str, after: &[&str]) -> Result<Scene<2>, Error> {
    Scene::new(by, &["height", "speed"], |equations| {
        let flight = equations.mode_text("flight", &["speed", "-1"]);
        flight.falling_text("floor", floor).resets_text(after).contact()
    })
}

/// ẋ = 1 up to x = 15, where x jumps to −20, over the surface x = 0. That surface bounds the flow, x > 0; its reset
/// puts x to 5.
pub fn leap(by: By) -> Result<Scene<1>, Error> {
    Scene::new(by, &["x"], |equations| {
        let top = equations.mode_text("rises", &["1"]).rising_text("top", "x - 15");
        top.resets_text(&["-20"]).falling_text("zero", "x").resets_text(&["5"]).contact()
    })
}

/// The same with an observer at x = 0.
pub fn watched_leap(by: By) -> Result<Scene<1>, Error> {
    Scene::new(by, &["x"], |equations| {
        let top = equations.mode_text("rises", &["1"]).rising_text("top", "x - 15");
        top.resets_text(&["-20"]).either_text("zero", "x")
    })
}

/// ẋ = 1. Mode 0 is left upwards at x = 1 and mode 1 downwards at x = 3, with x left as it is: at x = 1 the state is
/// beyond both surfaces.
pub fn endless(by: By) -> Result<Scene<1>, Error> {
    Scene::new(by, &["x"], |equations| {
        let up = equations.mode_text("0", &["1"]).rising_text("x = 1", "x - 1").to("1").contact();
        up.mode_text("1", &["1"]).falling_text("x = 3", "x - 3").to("0").contact()
    })
}

/// A ball under gravity 1 below a ceiling at 2. State: height and velocity. A touch of the ceiling is an error, or
/// nothing, or an event that leaves the state as it is.
pub fn ceiling(by: By, touch: Touch) -> Result<Scene<2>, Error> {
    Scene::new(by, &["height", "speed"], |equations| {
        let flight = equations.mode_text("flight", &["speed", "-1"]);
        let guard = flight.rising_text("ceiling", "height - 2").touch(touch);
        match touch {
            Touch::Event => guard.to("flight"),
            Touch::Error | Touch::Ignore => guard.resets_text(&["height", "-speed"]),
        }
    })
}

/// Thrown upwards with velocity 2, the ball just reaches the ceiling at t = 2.
pub fn throw() -> State<2> {
    State::from([0.0, 2.0])
}
