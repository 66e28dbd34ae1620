//! The circle of fates shows the fates of single speeds at every scale.

use basin_of_attraction::{Label, Refinement};
use hopper_asymptotics::{FatouCoordinate, Offset, Phase};
use hopper_basin::{
    CircleLimits, Error, FallsOnto, Fates, Ground, HopperFate, PhaseBasins, crisis, grounding,
};
use passive_hopper::{Arithmetic, ExtendedOrbit, ExtendedStep, FixedPointSpeed, MassRatio};

const DECAYING: Label = HopperFate::Decaying.label();
const FIRST: Label = HopperFate::label_of_fixed_point(1);
const SECOND: Label = HopperFate::label_of_fixed_point(2);
const GROUNDED: Label = HopperFate::GROUNDED;

fn fates(mass_ratio: f64) -> Fates {
    Fates::new(MassRatio::new(mass_ratio).unwrap()).unwrap()
}

fn circle(fates: &Fates, n: u64) -> PhaseBasins {
    PhaseBasins::new(fates, n, CircleLimits::default()).unwrap()
}

/// n, M, and the shares that were measured with 3000 phases at 10⁻⁶, 10⁻⁸ and 10⁻¹⁰ in another program.
type Measured = (u64, f64, &'static [(Label, f64)]);

const MEASURED: [Measured; 6] = [
    (1, 0.2, &[(DECAYING, 1.0)]),
    (2, 0.2, &[(DECAYING, 0.970), (FIRST, 0.030)]),
    (3, 0.2, &[(DECAYING, 0.963), (FIRST, 0.030), (SECOND, 0.007)]),
    (2, 0.12, &[(DECAYING, 0.695), (FIRST, 0.305)]),
    (1, 0.8, &[(DECAYING, 0.182), (GROUNDED, 0.818)]),
    (2, 0.8, &[(DECAYING, 0.187), (FIRST, 0.003), (GROUNDED, 0.810)]),
];

/// The speeds α*_n + δ, rounded to `f64`, of `count` equally spaced phases in the turn that begins at `scale`, with
/// the phases of the rounded speeds.
fn turn(psi: &FatouCoordinate, n: u64, scale: f64, count: usize) -> Vec<(f64, Phase)> {
    let star = FixedPointSpeed::new(n);
    let first = psi.phase(Offset::from(scale)).unwrap();
    let speed = |k: usize| {
        let phase = Phase::new(first.whole() + 1, (k as f64 + 0.5) / count as f64, 0.0);
        let (delta, _) = psi.offset(&phase).unwrap();
        let speed = star.value() + delta.nearest();
        (speed, psi.phase(Offset::from(star.offset_of(speed))).unwrap())
    };
    (0..count).map(speed).collect()
}

/// 900 phases for each circle, 300 at each of three scales. The fates are those of the exact orbits.
#[test]
fn the_label_of_a_phase_is_the_fate_at_every_scale() {
    for (n, mass_ratio, _) in MEASURED {
        let fates = fates(mass_ratio);
        let circle = circle(&fates, n);
        for scale in [-1e-6, -1e-8, -1e-10] {
            let points = turn(circle.coordinate(), n, scale, 300);
            let speeds: Vec<f64> = points.iter().map(|(speed, _)| *speed).collect();
            let mut unknown = 0;
            for ((speed, phase), label) in points.iter().zip(fates.labels(&speeds).unwrap()) {
                let error = phase.error() + circle.phase_error();
                match circle.label_at(phase.fraction(), error) {
                    Some(found) => assert_eq!(found, label, "{n} {mass_ratio} {speed} {phase}"),
                    None => unknown += 1,
                }
            }
            // Not one of these phases lies within the error of a boundary point.
            assert_eq!(unknown, 0, "{n} {mass_ratio} {scale:e}");
        }
    }
}

#[test]
fn local_fractions_agree_with_measured_ones() {
    for (n, mass_ratio, shares) in MEASURED {
        let fractions = circle(&fates(mass_ratio), n).fractions();
        let labels: Vec<Label> = shares.iter().map(|(label, _)| *label).collect();
        assert_eq!(fractions.labels().collect::<Vec<_>>(), labels);
        for &(label, share) in shares {
            let found = fractions.of(label);
            // The measured shares have three digits.
            assert!((found.middle() - share).abs() < 1e-3, "{n} {mass_ratio} {label} {found:?}");
            assert!(found.half_width() < 1e-7, "{found:?}");
        }
    }
}

/// Finer limits give bounds inside the coarser ones, and the lengths sum to one.
#[test]
fn bounds_on_local_fractions_are_nested() {
    let fates = fates(0.2);
    let limits = |undecided: f64| CircleLimits {
        refinement: Refinement { undecided, shortest: 1e-3 * undecided, ..Refinement::default() },
        ..CircleLimits::default()
    };
    let coarse = PhaseBasins::new(&fates, 3, limits(1e-4)).unwrap().fractions();
    let fine = PhaseBasins::new(&fates, 3, limits(1e-7)).unwrap().fractions();
    assert!(fine.undecided() < 0.01 * coarse.undecided() && coarse.undecided() < 1e-3);
    // Each end may be known less well by some ulps of the speed.
    let ends = 1e-12;
    for label in [DECAYING, FIRST, SECOND] {
        let (coarse, fine) = (coarse.of(label), fine.of(label));
        assert!(coarse.lower <= fine.lower + ends, "{coarse:?} {fine:?}");
        assert!(fine.upper <= coarse.upper + ends, "{coarse:?} {fine:?}");
    }
    let sum: f64 = [DECAYING, FIRST, SECOND].map(|label| fine.of(label).lower).iter().sum();
    assert!((sum + fine.undecided() - 1.0).abs() < 1e-13);
}

/// The orbit of a boundary point, in 106 bits, comes to the fixed point or to the ground in the number of hops given.
#[test]
fn boundary_points_fall_where_they_are_said_to() {
    let mut seen = [0; 2];
    for (n, mass_ratio) in [(3, 0.2), (2, 0.8)] {
        let fates = fates(mass_ratio);
        for point in circle(&fates, n).boundary() {
            let follow = |speed: f64, hops: usize| {
                let mut orbit =
                    ExtendedOrbit::new(fates.map(), speed, Arithmetic::Bits106).unwrap();
                (0..hops).all(|_| orbit.hop().unwrap() == ExtendedStep::LiftsOff).then_some(orbit)
            };
            // Some ulps to both sides, with room for those of the point itself.
            let (left, right) = (point.speed * (1.0 - 1e-13), point.speed * (1.0 + 1e-13));
            match point.falls_onto.unwrap() {
                FallsOnto::FixedPoint { m, hops } => {
                    let [a, b] = [left, right].map(|s| follow(s, hops).unwrap().offset_from(m).0);
                    assert!(m < n && (a < 0.0) != (b < 0.0), "{point:?} {a:e} {b:e}");
                    seen[0] += 1;
                }
                FallsOnto::Grounding { hops } => {
                    let [a, b] = [left, right].map(|s| follow(s, hops).is_some());
                    assert!(a != b, "{point:?}");
                    assert!(follow(left, hops - 1).is_some() && follow(right, hops - 1).is_some());
                    assert!([point.below, point.above].contains(&GROUNDED));
                    seen[1] += 1;
                }
            }
        }
    }
    assert!(seen[0] > 50 && seen[1] > 50, "{seen:?}");
}

/// An orbit from near α*_n, followed in 106 bits to the fundamental domain, keeps the fraction of its phase.
#[test]
fn phases_of_the_domain_are_those_of_orbits_from_within() {
    let coarse = CircleLimits {
        refinement: Refinement { undecided: 0.1, ..CircleLimits::default().refinement },
        fate_samples: 100,
        ..CircleLimits::default()
    };
    for (n, mass_ratio) in [(1, 0.02), (1, 0.8), (2, 0.2), (3, 0.12), (8, 0.9), (2, 1.5), (3, 20.0)]
    {
        let fates = fates(mass_ratio);
        let circle = PhaseBasins::new(&fates, n, coarse).unwrap();
        assert!(circle.phase_error() < 1e-11, "{}", circle.phase_error());
        let (bottom, top) = circle.domain();
        for (start, phase) in turn(circle.coordinate(), n, -2e-8, 7) {
            let mut orbit = ExtendedOrbit::new(fates.map(), start, Arithmetic::Bits106).unwrap();
            while orbit.speed() > top {
                assert_eq!(orbit.hop().unwrap(), ExtendedStep::LiftsOff);
            }
            let found = circle.phase_of(orbit.speed()).unwrap();
            let apart = (found - phase.fraction()).abs();
            // The speed is rounded.
            let error = phase.error() + circle.phase_error() + 1e-15 * top / (top - bottom);
            assert!(apart.min(1.0 - apart) <= error, "{n} {mass_ratio}: {apart:e} > {error:e}");
        }
    }
}

/// Fates of neighbouring `f64` near 10⁻⁶ differ where the circle has its boundary points. These `f64` are a phase
/// of 3·10⁻⁹ apart.
#[test]
fn boundary_phases_agree_with_bisected_fates() {
    let mut found = 0;
    for (n, mass_ratio) in [(2, 0.2), (2, 0.12), (1, 0.8)] {
        let fates = fates(mass_ratio);
        let circle = circle(&fates, n);
        let label = |speed: f64| fates.fate(speed).unwrap().label();
        let psi = circle.coordinate();
        let points = turn(psi, n, -1e-6, 200);
        for pair in points.windows(2) {
            let (mut low, mut high) = (pair[0].0, pair[1].0);
            let (below, above) = (label(low), label(high));
            if below == above {
                continue;
            }
            while low.next_up() < high {
                let middle = low + 0.5 * (high - low);
                if label(middle) == below { low = middle } else { high = middle }
            }
            let delta = FixedPointSpeed::new(n).offset_of(low);
            let phase = psi.phase(Offset::from(delta)).unwrap().fraction();
            let near = |b: &&hopper_basin::BoundaryPhase| (b.phase - phase).abs() < 6e-9;
            let boundary = circle.boundary().iter().find(near).unwrap();
            assert_eq!((boundary.below, boundary.above), (below, above));
            found += 1;
        }
    }
    assert_eq!(found, 6);
}

#[test]
fn a_share_of_phases_is_that_of_its_parts() {
    let fates = fates(0.2);
    let circle = circle(&fates, 2);
    let [first, second] = circle.boundary() else { panic!("{:?}", circle.boundary()) };
    assert_eq!((first.below, first.above), (DECAYING, FIRST));
    let length = second.phase - first.phase;
    assert!((circle.fractions().of(FIRST).middle() - length).abs() < 1e-11);
    // From the middle of the component of basin 1 through one turn and a half of the component more.
    let start = first.phase + 0.5 * length;
    let share = circle.share(start, start + 1.0 + length).unwrap();
    assert!((share.of(FIRST).middle() - 1.5 * length / (1.0 + length)).abs() < 1e-10);
    // Within the component, also in another turn and through phases of any size.
    assert!(
        circle.share(start - 3.0, start - 3.0 + 0.4 * length).unwrap().of(FIRST).lower > 1.0 - 1e-9
    );
    let phase = |whole: u64, fraction: f64| Phase::new(whole, fraction, 0.0);
    let share = circle.share_between(&phase(1 << 60, start), &phase((1 << 60) + 7, start));
    assert!((share.of(FIRST).middle() - length).abs() < 1e-10);
    assert!(circle.share(0.5, 0.4).is_err() && circle.share(0.5, f64::NAN).is_err());
    assert_eq!(circle.label_at(start, 0.6 * length), None);
}

/// Below a crisis the left of the next fixed point has one fate. Above it the other fate has a share C √(M − M_c):
/// f falls below α*_{n−1}, or to zero, on an interval of this width about its quadratic minimum.
#[test]
fn a_crisis_opens_a_share_like_a_square_root() {
    let [ground, fall] = [grounding(0).unwrap().mass_ratio, crisis(1).unwrap().mass_ratio];
    for (n, critical, before, new) in [(1, ground, DECAYING, GROUNDED), (2, fall, FIRST, DECAYING)]
    {
        let share = |beyond: f64| {
            let fractions = circle(&fates(critical + beyond), n).fractions();
            if beyond < 0.0 {
                assert!(fractions.labels().eq([before]), "{fractions:?}");
            }
            fractions.of(new).middle() / beyond.abs().sqrt()
        };
        assert_eq!(share(-1e-8), 0.0);
        let (near, far) = (share(1e-8), share(1e-6));
        assert!(near > 1.0 && (near / far - 1.0).abs() < 1e-4, "{n} {near} {far}");
    }
}

/// Where branches are not known the result says so; it is right for most other speeds.
#[test]
fn above_the_mass_ratio_of_known_branches_labels_are_sampled() {
    let fates = fates(1.5);
    let circle = circle(&fates, 2);
    assert!(matches!(circle.ground(), Ground::Spacing { speeds } if speeds < 1e-4));
    let points = turn(circle.coordinate(), 2, -1e-8, 1000);
    let speeds: Vec<f64> = points.iter().map(|(speed, _)| *speed).collect();
    let mut wrong = 0;
    for ((_, phase), label) in points.iter().zip(fates.labels(&speeds).unwrap()) {
        let found = circle.label_at(phase.fraction(), circle.phase_error());
        wrong += usize::from(found.is_some_and(|found| found != label));
    }
    assert!(wrong <= 2, "{wrong}");
    // The bounds allow for basins between the samples.
    assert!(circle.fractions().of(FIRST).half_width() > 1e-4);
    assert!(matches!(self::circle(&self::fates(0.2), 2).ground(), Ground::Branches { .. }));
}

#[test]
fn wrong_inputs_are_errors() {
    let fates = fates(0.2);
    let limits = CircleLimits::default();
    assert!(matches!(PhaseBasins::new(&fates, 0, limits), Err(Error::Index { .. })));
    let few = CircleLimits { window_samples: 2, ..limits };
    assert!(matches!(PhaseBasins::new(&fates, 1, few), Err(Error::BasinOfAttraction(_))));
}
