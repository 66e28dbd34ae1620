//! The number of gaps between boundary points left of a fixed point, against counts of single gaps and against its law.

use basin_of_attraction::Refinement;
use hopper_basin::{CircleLimits, Fates, GapCount, PhaseBasins, hopper_basins};
use passive_hopper::{MassRatio, alpha_star};
use std::f64::consts::LN_10;

fn counts(mass_ratio: f64, largest: u64, limits: CircleLimits) -> (Fates, Vec<GapCount>, f64) {
    let fates = Fates::new(MassRatio::new(mass_ratio).unwrap()).unwrap();
    let (mut counts, mut top) = (Vec::new(), 0.0);
    for n in 1..=largest {
        let circle = PhaseBasins::new(&fates, n, limits).unwrap();
        counts.push(GapCount::new(&fates, &circle, &counts).unwrap());
        top = circle.domain().1;
    }
    (fates, counts, top)
}

/// The basins as intervals, found without the circle, have the same gaps down to 10⁻¹⁰, as far as each is resolved.
#[test]
fn the_basins_as_intervals_have_as_many_gaps() {
    for n in [2, 3] {
        let (fates, counts, top) = counts(0.2, n, CircleLimits::default());
        let refinement = Refinement {
            shortest: 1e-13,
            undecided: 1e-12,
            levels: 1_000_000,
            intervals: 4_000_000,
        };
        let basins = hopper_basins(&fates, n - 1, n, 400, refinement).unwrap().basins;
        let points = basins.boundary(1e-12);
        // From the first boundary point in the first turn on.
        let points: Vec<f64> =
            points.into_iter().filter(|&p| p > top && p < alpha_star(n)).collect();
        for decades in [4.0, 5.0, 6.0, 7.0, 8.0, 9.0] {
            let epsilon = pxfm::f_exp10(-decades);
            let seen = points.windows(2).filter(|pair| pair[1] - pair[0] > epsilon).count() as f64;
            let found = counts[n as usize - 1].longer_than(-LN_10 * decades).unwrap();
            assert!((seen - found).abs() <= 1.0, "{n} 10^-{decades}: {seen} {found}");
        }
    }
}

/// Theorem 89 with the constants that were measured for it.
#[test]
fn the_counts_follow_their_laws() {
    let (_, counts, _) = counts(0.2, 3, CircleLimits::default());
    assert_eq!(counts.iter().map(GapCount::depth).collect::<Vec<_>>(), [0, 1, 2]);
    assert!((counts[1].constant() - 0.3832).abs() < 5e-5, "{}", counts[1].constant());
    assert!((counts[2].constant() - 0.02659).abs() < 1e-5, "{}", counts[2].constant());
    assert_eq!(counts[0].longer_than(-230.0), Some(0.0));
    let scaled = |count: &GapCount, decades: f64| {
        count.longer_than(-LN_10 * decades).unwrap() * pxfm::f_exp10(-0.25 * decades)
    };
    for decades in [40.0, 100.0, 300.0] {
        assert!((scaled(&counts[1], decades) / (0.75 * counts[1].constant()) - 1.0).abs() < 1e-6);
    }
    let rise = (scaled(&counts[2], 300.0) - scaled(&counts[2], 200.0)) / (100.0 * LN_10);
    let law = 0.75 * counts[2].constant();
    assert!((rise / law - 1.0).abs() < 1e-3, "{rise} {law}");
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e4] {
        assert_eq!(counts[2].longer_than(wrong), None, "{wrong}");
    }
}

/// With a coarser circle more gaps are counted from the circle of the limit point. The sum stays.
#[test]
fn the_resolution_of_the_circle_does_not_matter() {
    let coarse = Refinement { shortest: 1e-8, undecided: 1e-6, ..Refinement::default() };
    let coarse = CircleLimits { refinement: coarse, ..CircleLimits::default() };
    let all = [CircleLimits::default(), coarse].map(|limits| counts(0.2, 3, limits).1);
    for decades in [12.0, 20.0, 50.0, 100.0] {
        let [fine, coarse] = [0, 1].map(|at| all[at][2].longer_than(-LN_10 * decades).unwrap());
        assert!((fine / coarse - 1.0).abs() < 1e-4, "10^-{decades}: {fine} {coarse}");
    }
}
