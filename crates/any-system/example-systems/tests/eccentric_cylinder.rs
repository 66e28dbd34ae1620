//! The bouncing eccentric cylinder: energy, impacts, contact, release, rest.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

use example_systems::eccentric_cylinder::{EccentricCylinder, Mode, Surface};
use hybrid_system::{Arc, ArcEnd, Certainty, Execution, Limits, State};
use nalgebra::Vector4;
use pxfm::{f_cos, f_sin};

const ELASTIC: EccentricCylinder = EccentricCylinder {
    eccentricity: 0.3,
    radius_of_gyration: 0.6,
    restitution: 1.0,
    rolling_resistance: 0.0,
};

/// Released at rest, with G almost beside C.
fn start() -> State<4> {
    Vector4::new(2.0, 0.0, 1.5, 0.0)
}

type Arcs = Vec<Arc<Mode, Surface, State<4>>>;

fn arcs(cylinder: &EccentricCylinder, mode: Mode, start: State<4>, limits: Limits) -> Arcs {
    Execution::new(cylinder, mode, start, limits).collect::<Result<_, _>>().unwrap()
}

/// The largest number of impacts before the time 10⁵, some 4·10⁴, is not reached by any test.
const LIMITS: Limits = Limits::new(1e5, 3000);

#[test]
fn three_thousand_elastic_impacts_keep_the_energy() {
    let arcs = arcs(&ELASTIC, Mode::Flight, start(), LIMITS);
    assert_eq!(arcs.len(), 3000);
    let exact = ELASTIC.energy(&start());
    for arc in &arcs {
        let event = arc.event().unwrap();
        assert_eq!((event.surface, event.certainty), (Surface::Floor, Certainty::Certain));
        let error = ELASTIC.energy(&event.after.unwrap().1) / exact - 1.0;
        assert!(error.abs() < 1e-11, "{error:e} after {} impacts", event.jump + 1);
    }
}

/// In flight the gap never closes between two impacts, at any of 16 times.
#[test]
fn the_cylinder_never_passes_its_floor() {
    for arc in arcs(&ELASTIC, Mode::Flight, start(), LIMITS) {
        for k in 0..=16 {
            let x = arc.state(&ELASTIC, arc.duration * f64::from(k) / 16.0).unwrap();
            assert!(ELASTIC.gap(&x) > -1e-13, "{x}");
        }
    }
}

#[test]
fn impacts_follow_the_law_and_keep_the_angular_momentum_about_the_lowest_point() {
    let cylinder = EccentricCylinder { restitution: 0.8, ..ELASTIC };
    let mut impacts = 0;
    for arc in arcs(&cylinder, Mode::Flight, start(), Limits::new(10.0, 3000)) {
        let Some(event) = arc.event() else { continue };
        let (before, after) = (event.before, event.after.unwrap().1);
        let lever = 0.3 * f_sin(before[2]);
        let rate = |x: &State<4>| x[1] - lever * x[3];
        // The impulse acts at the lowest point and has no moment about it.
        let momentum = |x: &State<4>| 0.36 * x[3] + lever * x[1];
        assert!((rate(&after) + 0.8 * rate(&before)).abs() < 1e-13);
        assert!((momentum(&after) - momentum(&before)).abs() < 1e-13);
        let loss = (1.0 - 0.64) * rate(&before).powi(2) / (2.0 * (1.0 + lever * lever / 0.36));
        let change = cylinder.energy(&after) - cylinder.energy(&before);
        assert!((change + loss).abs() < 1e-13, "{change} {loss}");
        impacts += 1;
    }
    assert!(impacts > 5, "{impacts}");
}

/// With e = 0.8 the impacts end. Without rolling resistance the cylinder then rocks for ever, with all of its energy.
#[test]
fn an_inelastic_cylinder_ends_in_contact_and_rocks_without_loss() {
    let cylinder = EccentricCylinder { restitution: 0.8, ..ELASTIC };
    let arcs = arcs(&cylinder, Mode::Flight, start(), Limits::new(300.0, 3000));
    let last = arcs.last().unwrap();
    assert_eq!(last.mode, Mode::Contact);
    assert!(matches!(last.end, ArcEnd::TimeLimit { .. }), "{:?}", last.end);
    assert!(matches!(arcs[arcs.len() - 2].end, ArcEnd::Zeno { .. }));
    let exact = cylinder.energy(&last.start);
    // Less than at the start, more than at rest.
    assert!(exact < 0.6 * cylinder.energy(&start()) && exact > 0.8, "{exact}");
    for k in 0..=100 {
        let x = last.state(&cylinder, last.duration * f64::from(k) / 100.0).unwrap();
        assert!((cylinder.energy(&x) - exact).abs() < 1e-9);
        assert!(cylinder.gap(&x).abs() < 1e-15);
        assert!(cylinder.pressing(&x) > 0.0);
    }
}

/// With rolling resistance it comes to rest, with G below C and the smallest energy.
#[test]
fn an_inelastic_cylinder_with_rolling_resistance_comes_to_rest() {
    let cylinder = EccentricCylinder { restitution: 0.8, rolling_resistance: 0.1, ..ELASTIC };
    let arcs = arcs(&cylinder, Mode::Flight, start(), Limits::new(300.0, 3000));
    let last = arcs.last().unwrap();
    assert_eq!(last.mode, Mode::Contact);
    let end = last.state(&cylinder, last.duration).unwrap();
    assert!((end - Vector4::new(0.7, 0.0, 0.0, 0.0)).amax() < 1e-9, "{end}");
    // Near rest φ̈ = −(ε φ + μ ω)/κ²: the energy falls like e^(−μt/κ²), by e² in 2κ²/μ = 7.2.
    let excess = |elapsed: f64| cylinder.energy(&last.state(&cylinder, elapsed).unwrap()) - 0.7;
    // Whole periods: the energy over a period is not uniform.
    let period = std::f64::consts::TAU / (0.3f64 / 0.36 - (0.05f64 / 0.36).powi(2)).sqrt();
    let factor = excess(40.0 + period) / excess(40.0);
    let exact = pxfm::f_exp(-0.1 / 0.36 * period);
    assert!((factor / exact - 1.0).abs() < 1e-2, "{factor} {exact}");
}

/// A cylinder that turns fast in contact leaves the floor where its force vanishes: at the angle that follows from the
/// energy.
#[test]
fn a_fast_cylinder_is_released_where_the_force_vanishes() {
    let start = ELASTIC.on_floor(0.0, 3.0);
    let arcs = arcs(&ELASTIC, Mode::Contact, start, Limits::new(100.0, 2));
    let event = arcs[0].event().unwrap();
    assert_eq!(event.surface, Surface::Release);
    // (κ² + ε² sin²φ) ω²/2 − ε cos φ = E and ε cos φ ω² = −1: ε² c² + 2 ε E c + κ² + ε² = 0 for c = cos φ.
    let energy = ELASTIC.energy(&start) - 1.0;
    let cos = (-energy + (energy * energy - 0.36 - 0.09).sqrt()) / 0.3;
    assert!((f_cos(event.before[2]) - cos).abs() < 1e-10, "{} {cos}", f_cos(event.before[2]));
    // It leaves like t³ and flies.
    assert_eq!(arcs[1].mode, Mode::Flight);
    for k in 1..=10 {
        let x = arcs[1].state(&ELASTIC, 0.1 * arcs[1].duration * f64::from(k)).unwrap();
        assert!(ELASTIC.gap(&x) > -1e-13, "{x}");
    }
    assert!(arcs[1].duration > 0.1);
}

/// Without eccentricity it is a ball: it turns uniformly, and its bounces end at the time of a ball.
#[test]
fn a_concentric_cylinder_is_a_ball() {
    let ball = EccentricCylinder { eccentricity: 0.0, restitution: 0.5, ..ELASTIC };
    let start = Vector4::new(1.5, 0.0, 0.3, 0.7);
    let arcs = arcs(&ball, Mode::Flight, start, Limits::new(10.0, 3000));
    let last = arcs.last().unwrap();
    // Dropped by ½ it lands after 1, and (1 + e)/(1 − e) = 3.
    assert!((last.time - 3.0).abs() < 1e-11, "{}", last.time);
    assert_eq!((last.mode, last.start[3]), (Mode::Contact, 0.7));
}

/// A plane of symmetry contains the vertical: the mirror image of an orbit is an orbit, to the last bit.
#[test]
fn the_mirror_image_of_an_orbit_is_an_orbit() {
    let mirrored = |x: &State<4>| Vector4::new(x[0], x[1], -x[2], -x[3]);
    let limits = Limits::new(1e3, 200);
    let cylinder = EccentricCylinder { restitution: 0.999, ..ELASTIC };
    let one = arcs(&cylinder, Mode::Flight, start(), limits);
    let other = arcs(&cylinder, Mode::Flight, mirrored(&start()), limits);
    assert_eq!(one.len(), other.len());
    for (one, other) in one.iter().zip(&other) {
        assert_eq!(mirrored(&one.start), other.start);
    }
}
