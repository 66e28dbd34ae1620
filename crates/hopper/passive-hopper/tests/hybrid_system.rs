//! The hopper as a hybrid system: energy, flows, landing times, and the map built from it.

#![allow(clippy::excessive_precision)] // published digits, as they are printed

use approx::assert_relative_eq;
use hopper_reference::rows;
use hybrid_system::{
    Certainty, Event, Execution, HybridSystem, Limits, Search, Searched, State, Stop,
};
use nalgebra::SVector;
use passive_hopper::{
    Hopper, HopperState, HopperSurface, LiftOffMap, MassRatio, Phase, PhysicalHopper, alpha_star,
    energy, landing_loss,
};
use proptest::prelude::*;
use return_map::{ReturnMap, Section};

fn hopper(mass_ratio: f64) -> Hopper {
    Hopper::new(MassRatio::new(mass_ratio).unwrap())
}

/// The section of gradual lift-offs, with the speed α as its coordinate.
struct GradualLiftOff;

impl Section<Hopper, 4, 1> for GradualLiftOff {
    fn point(&self, alpha: &SVector<f64, 1>) -> (Phase, State<4>) {
        (Phase::Flight, HopperState::lift_off(alpha[0]).into())
    }
    fn coordinates(
        &self,
        event: &Event<Phase, HopperSurface, State<4>>,
    ) -> Option<SVector<f64, 1>> {
        (event.surface == HopperSurface::LiftOff).then(|| SVector::<f64, 1>::new(event.before[1]))
    }
}

impl Section<Searched<Hopper>, 4, 1> for GradualLiftOff {
    fn point(&self, alpha: &SVector<f64, 1>) -> (Phase, State<4>) {
        Section::<Hopper, 4, 1>::point(self, alpha)
    }
    fn coordinates(
        &self,
        event: &Event<Phase, HopperSurface, State<4>>,
    ) -> Option<SVector<f64, 1>> {
        Section::<Hopper, 4, 1>::coordinates(self, event)
    }
}

/// Landings from samples of y₂(τ) and Brent's method, contacts from samples of y₁(τ): independent of the landing
/// solver. The landing times differ in the fifth digit near fixed points; the map does not.
#[test]
fn a_search_on_samples_finds_the_same_map() {
    let (low, high) = (alpha_star(1), alpha_star(6));
    let (mut compared, mut undecided) = (0, 0);
    for m in [0.05, 0.2, 0.7, 1.0, 2.0, 8.0, 20.0] {
        let searched = Searched(hopper(m));
        let limits = Limits::sampled(200.0, 100, 0.02);
        let returns = ReturnMap::new(&searched, &GradualLiftOff, limits);
        let exact = LiftOffMap::new(searched.0.mass_ratio());
        for k in 0..150 {
            let alpha = low + (high - low) * (f64::from(k) + 0.5) / 150.0;
            let hop = exact.hop(alpha).unwrap();
            let Some(next) = hop.next else { continue };
            match returns.image(alpha) {
                Ok(Some(image)) => {
                    let scale = (alpha / next).powi(2).max(1.0) * 10f64.powi(hop.sudden as i32);
                    assert!(
                        (image - next).abs() < 1e-12 * scale,
                        "M = {m}, α = {alpha}: {image} {next}"
                    );
                    compared += 1;
                }
                // A flight shorter than the sampling interval, or a flight that is below the ground only between
                // samples.
                Err(return_map::Error::Execution(hybrid_system::Error::UndecidedStart {
                    ..
                })) => undecided += 1,
                other => panic!("M = {m}, α = {alpha}: {other:?}"),
            }
        }
    }
    assert!(compared > 700 && undecided < 20, "{compared} {undecided}");
}

/// The return map of the hybrid system agrees with the lift-off map over the paper's window: to 1e-12, or to the
/// change of α' within some ulps of α.
#[test]
fn the_return_map_is_the_lift_off_map() {
    let (low, high) = (alpha_star(1), alpha_star(6));
    let mut compared = 0;
    for m in [0.05, 0.1, 0.2, 0.5, 0.9, 1.0, 1.5, 3.0, 10.0, 20.0] {
        let hopper = hopper(m);
        let returns = ReturnMap::new(&hopper, &GradualLiftOff, Limits::new(f64::INFINITY, 10_000));
        let exact = LiftOffMap::new(hopper.mass_ratio());
        for k in 0..2000 {
            let alpha = low + (high - low) * (f64::from(k) + 0.5) / 2000.0;
            let hop = exact.hop(alpha).unwrap();
            let image = returns.image(alpha).unwrap();
            assert_eq!(image.is_some(), hop.next.is_some(), "M = {m}, α = {alpha}");
            if let (Some(image), Some(next)) = (image, hop.next) {
                // Near grounding the square root magnifies rounding by α²/α'. Each of many sudden lift-offs magnifies
                // it too; the slope gives the factor.
                let scale = (alpha / next).powi(2).max(1.0) * (1 + hop.sudden) as f64;
                let slope = exact.slopes(alpha).unwrap().unwrap().by_speed.abs();
                let magnified = 16.0 * f64::EPSILON * slope * alpha * (1 + hop.sudden) as f64;
                assert!(
                    (image - next).abs() < 1e-12 * scale + magnified,
                    "M = {m}, α = {alpha}: {image} {next}"
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 15_000);
}

#[test]
fn landings_and_lift_offs_alternate() {
    // Incessant hopping in the trap of α*_2: landing, lift-off, landing, and so on.
    let hopper = hopper(0.3);
    let start = HopperState::lift_off(alpha_star(2) + 1e-3);
    let mut execution = Execution::new(&hopper, Phase::Flight, start.into(), Limits::new(1e4, 40));
    let surfaces: Vec<_> =
        execution.by_ref().map(|arc| arc.unwrap().event().unwrap().surface).collect();
    assert_eq!(execution.stop(), Some(Stop::EventLimit));
    for pair in surfaces.chunks(2) {
        assert_eq!(pair, [HopperSurface::Landing, HopperSurface::LiftOff]);
    }
}

#[test]
fn a_grounded_hopper_never_lifts_off_again() {
    let hopper = hopper(1.0);
    let start = HopperState::lift_off(2.0);
    let mut execution =
        Execution::new(&hopper, Phase::Flight, start.into(), Limits::new(f64::INFINITY, 100));
    let arcs: Vec<_> = execution.by_ref().map(Result::unwrap).collect();
    assert_eq!(arcs.len(), 2);
    assert!(arcs[1].duration.is_infinite());
    assert_eq!(execution.stop(), Some(Stop::NoFurtherEvent));
}

#[test]
fn impossible_states_are_errors() {
    let hopper = hopper(1.0);
    let below = HopperState { lower_position: -0.5, ..HopperState::RELAXED };
    let huge = HopperState::lift_off(1e300);
    let nan = HopperState::lift_off(f64::NAN);
    for (state, words) in [(below, "-0.5"), (huge, "e300"), (nan, "not finite")] {
        let mut execution =
            Execution::new(&hopper, Phase::Flight, state.into(), Limits::new(10.0, 10));
        let error = execution.next().unwrap().unwrap_err();
        let text = error.to_string();
        assert!(text.contains(words) || text.contains(&1e300.to_string()), "{text}");
        assert_eq!(execution.stop(), Some(Stop::Failed));
    }
}

/// Landings after a lift-off are certain. A start in the air has no bounds.
#[test]
fn a_landing_is_certain_after_a_lift_off_only() {
    let hopper = hopper(3.0);
    let certainty = |state: HopperState| {
        let found =
            hopper.first_crossing(Phase::Flight, &state.into(), &Search::up_to(f64::INFINITY));
        found.unwrap().crossing().unwrap().certainty
    };
    for alpha in [0.3, 3.5, 7.0, 50.0] {
        let gradual = HopperState::lift_off(alpha);
        assert_eq!(certainty(gradual), Certainty::Certain);
        let sudden = HopperState { upper_position: 1.7, ..gradual };
        assert_eq!(certainty(sudden), Certainty::Certain);
        let air = HopperState { lower_position: 0.1, ..gradual };
        assert_eq!(certainty(air), Certainty::Exact);
    }
}

/// Where x′ changes its sign between neighbouring doubles of V, 1 + x′ may round to 1. The rounded state may then enter
/// another phase than the exact one, and the landing is not certain.
#[test]
fn a_landing_whose_phase_is_lost_in_rounding_is_not_certain() {
    let hopper = hopper(3.0);
    let landing = |upper_position: f64, velocity: f64| {
        let start = HopperState { upper_position, ..HopperState::lift_off(velocity) };
        hopper
            .first_crossing(Phase::Flight, &start.into(), &Search::up_to(f64::INFINITY))
            .unwrap()
            .crossing()
            .unwrap()
    };
    let (mut changes, mut exact) = (0, 0);
    for k in 0..20_000 {
        let upper_position = 1.0 + 0.05 * f64::from(1 + k / 400);
        let is_above = |velocity: f64| landing(upper_position, velocity).state[0] > 1.0;
        let (mut left, mut right) = (0.05 * f64::from(k % 400), 0.05 * f64::from(k % 400 + 1));
        if is_above(left) == is_above(right) {
            continue;
        }
        let at_left = is_above(left);
        while left.next_up() < right {
            let middle = 0.5 * (left + right);
            if is_above(middle) == at_left { left = middle } else { right = middle }
        }
        changes += 1;
        for velocity in [left, right] {
            let found = landing(upper_position, velocity);
            let is_exact = found.certainty == Certainty::Exact;
            // Only a state that rounds to the surface itself can lose its phase.
            assert!(!is_exact || found.state[0] == 1.0);
            exact += usize::from(is_exact);
        }
    }
    assert!(changes > 10 && exact > 0, "{exact} of {changes}");
}

#[test]
fn flight_times_agree_with_forty_digits() {
    for row in rows(include_str!("data/hops_window.jsonl")) {
        let alpha = row.input("alpha");
        let first = row.map().landings(alpha).unwrap()[0];
        let exact = row.first_result("flight_times");
        // dτ/dα = 2D/Γ is the condition number of the time.
        let condition = 1.0 + 2.0 * alpha / first.closing_speed;
        assert!((first.time - exact).abs() < 4.0 * f64::EPSILON * exact * condition, "{row}");
    }
}

/// A fall from the air at the largest speeds, where P ~ 10²⁴ has an ulp of 10⁸. Fuzzing found an error here.
#[test]
fn huge_falls_gain_no_energy() {
    let hopper = hopper(2.375_217_873_208_651);
    let ratio = hopper.mass_ratio();
    let start = HopperState {
        upper_velocity: 1_723_624_292_367.437_5,
        lower_position: 2.000_006_519_228_990_4,
        ..HopperState::RELAXED
    };
    let mut before = energy(ratio, &start) * (1.0 + 1e-12);
    for arc in Execution::new(&hopper, Phase::Flight, start.into(), Limits::new(f64::INFINITY, 8)) {
        let now = energy(ratio, &arc.unwrap().start.into());
        assert!(now <= before * (1.0 + 1e-12), "{now:e} after {before:e}");
        before = now;
    }
}

/// The hopper of SciML DifferentialEquations.jl #647: g = 9.8, k = 500, natural length 1, masses 1, dropped from
/// heights 5 and 6. The issue reports a crash of an integration; the expected values here are closed forms.
#[test]
fn sciml_647_hopper() {
    let physical = PhysicalHopper::new(1.0, 1.0, 500.0, 9.8).unwrap();
    let hopper = Hopper::new(physical.mass_ratio().unwrap());
    let start = HopperState { upper_position: 5.0, lower_position: 5.0, ..HopperState::RELAXED };
    let start = physical.to_dimensionless(&start);
    let arcs: Vec<_> =
        Execution::new(&hopper, Phase::Flight, start.into(), Limits::new(f64::INFINITY, 3))
            .map(Result::unwrap)
            .collect();
    let seconds = physical.time_unit();
    let state =
        |arc: usize| physical.to_physical(&HopperState::from(arcs[arc].event().unwrap().before));
    let times: Vec<f64> = arcs.iter().map(|arc| arc.event().unwrap().time * seconds).collect();
    assert_relative_eq!(times[0], 1.010_152_544_552_210_75, max_relative = 1e-14);
    assert_relative_eq!(state(0).lower_velocity, -9.899_494_936_611_665, max_relative = 1e-13);
    assert_relative_eq!(arcs[1].duration * seconds, 0.146_436_001_872_528_8, max_relative = 1e-13);
    assert_relative_eq!(times[1], 1.156_588_546_424_739_6, max_relative = 1e-14);
    assert_relative_eq!(1.0 + state(1).upper_position, 1.019_6, max_relative = 1e-14);
    assert_relative_eq!(state(1).upper_velocity, 9.870_347_511_612_75, max_relative = 1e-13);
    assert_relative_eq!(times[2], 2.156_934_558_330_891_5, max_relative = 1e-13);
    assert_relative_eq!(state(2).lower_velocity, -9.619_844_900_102_33, max_relative = 1e-13);
    // The lift-off is cubic: a ten-thousandth of a second later the lower mass is 8 ångström high.
    let later = hopper.flow(Phase::Flight, &arcs[2].start, 1e-4 / seconds);
    let height = physical.to_physical(&HopperState::from(later)).lower_position;
    assert_relative_eq!(height, 8.224_88e-10, max_relative = 1e-5);
    let lowest = (1..100_000)
        .map(|k| 1.0 + arcs[1].duration * f64::from(k) / 1e5)
        .map(|t| hopper.flow(Phase::Contact, &arcs[1].start, t - 1.0)[0])
        .fold(f64::INFINITY, f64::min);
    assert_relative_eq!(
        1.0 + lowest * physical.length_unit(),
        0.537_247_475_466_967,
        max_relative = 1e-8
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// Energy is constant along an arc, and only landings take energy: ½M(1+M)ẏ₂².
    #[test]
    fn energy_is_lost_at_landings_only(m in 0.02..50f64, alpha in 0.1..40f64) {
        let hopper = hopper(m);
        let ratio = hopper.mass_ratio();
        let start = HopperState::lift_off(alpha);
        let scale = (1.0 + m) * alpha * alpha + alpha.powi(4) + 10.0;
        for arc in Execution::new(&hopper, Phase::Flight, start.into(), Limits::new(1e3, 30)) {
            let arc = arc.unwrap();
            let at_start = energy(ratio, &arc.start.into());
            for k in 0..=16 {
                let state = arc.state(&hopper, arc.duration * f64::from(k) / 16.0).unwrap();
                prop_assert!((energy(ratio, &state.into()) - at_start).abs() < 1e-13 * scale);
            }
            let Some(event) = arc.event() else { continue };
            let (_, after) = event.after.unwrap();
            let lost = energy(ratio, &event.before.into()) - energy(ratio, &after.into());
            let expected = match event.surface {
                HopperSurface::Landing => landing_loss(ratio, event.before[3]),
                HopperSurface::LiftOff => 0.0,
            };
            prop_assert!((lost - expected).abs() < 1e-13 * scale, "{lost} {expected}");
        }
    }

    /// φ(t + u; x) = φ(u; φ(t; x)): the flows are groups.
    #[test]
    fn flows_are_groups(
        m in 0.05..20f64, t in 0.0..10f64, u in 0.0..10f64, flight: bool,
        y1 in -5.0..5f64, v1 in -5.0..5f64, y2 in 0.0..5f64, v2 in -5.0..5f64,
    ) {
        let hopper = hopper(m);
        let (phase, y2, v2) = if flight { (Phase::Flight, y2, v2) } else { (Phase::Contact, 0.0, 0.0) };
        let start = State::<4>::new(y1, v1, y2, v2);
        let at_once = hopper.flow(phase, &start, t + u);
        let in_two = hopper.flow(phase, &hopper.flow(phase, &start, t), u);
        let scale = 400.0 * (1.0 + m + 1.0 / m);
        prop_assert!((at_once - in_two).norm() < 1e-13 * scale, "{at_once} {in_two}");
    }

    /// The closed-form flight obeys the equations of motion (1).
    #[test]
    fn flight_obeys_the_equations_of_motion(m in 0.05..20f64, t in 0.0..20f64, alpha in 0.1..10f64) {
        let hopper = hopper(m);
        let start = State::<4>::from(nalgebra::Vector4::from(HopperState::lift_off(alpha)));
        let step = 1e-4;
        let at = |t: f64| hopper.flow(Phase::Flight, &start, t);
        let (before, here, after) = (at(t), at(t + step), at(t + 2.0 * step));
        let rate = (after - before) / (2.0 * step);
        let stretch = here[0] - here[2];
        let tolerance = 1e-6 * (1.0 + alpha);
        prop_assert!((rate[0] - here[1]).abs() < tolerance && (rate[2] - here[3]).abs() < tolerance);
        prop_assert!(((1.0 + m) * rate[1] + m * stretch + 1.0).abs() < tolerance * (1.0 + m));
        prop_assert!(((1.0 + m) * rate[3] - stretch + 1.0).abs() < tolerance * (1.0 + m));
    }
}

proptest! {
    /// Whatever bits the state has, the execution ends, and the energy never grows by more than rounding.
    #[test]
    fn energy_never_grows_from_any_bits(words in any::<[u64; 5]>()) {
        let [ratio, upper_position, upper_velocity, lower_position, lower_velocity] =
            words.map(f64::from_bits);
        // At larger mass ratios a flight may have a million sudden lift-offs.
        prop_assume!(ratio < 1e4);
        let Ok(ratio) = MassRatio::new(ratio) else { return Ok(()) };
        let state = HopperState { upper_position, upper_velocity, lower_position, lower_velocity };
        for phase in [Phase::Flight, Phase::Contact] {
            let (mut before, mut size): (f64, f64) = (f64::INFINITY, 1.0);
            let limits = Limits::new(f64::INFINITY, 8);
            for arc in Execution::new(&Hopper::new(ratio), phase, state.into(), limits) {
                let Ok(arc) = arc else { break };
                let now = energy(ratio, &arc.start.into());
                // Rounding is relative to the largest coordinate so far. Landings are corrected to first order for the
                // rounding of their time.
                size = arc.start.iter().map(|x| x.abs()).fold(size, f64::max);
                let ulp = 4.0 * f64::EPSILON * size;
                let rounding = (1e-9 + ulp * ulp) * (1.0 + ratio.value()) * size * size;
                prop_assert!(!(now > before + rounding), "{now} after {before} from {state:?}");
                before = now;
            }
        }
    }
}
