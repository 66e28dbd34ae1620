//! A pixel of a raster of shares has the fates of the speeds that it covers.

use basin_of_attraction::{Grid, Interval, Label};
use hopper_asymptotics::{Offset, Phase};
use hopper_basin::{
    CircleLimits, Error, Fates, HopperFate, PhaseBasins, ShareRaster, Upwards, share_raster,
};
use passive_hopper::{FixedPointSpeed, LiftOffMap, MassRatio};
use std::ops::ControlFlow::{Break, Continue};

fn fates(mass_ratio: f64) -> Fates {
    Fates::new(MassRatio::new(mass_ratio).unwrap()).unwrap()
}

fn circle(fates: &Fates, n: u64) -> PhaseBasins {
    PhaseBasins::new(fates, n, CircleLimits::default()).unwrap()
}

fn grid(x: (f64, f64), y: (f64, f64), columns: usize, rows: usize) -> Grid {
    let interval = |(left, right)| Interval::new(left, right).unwrap();
    Grid { x: interval(x), y: interval(y), columns, rows }
}

fn raster(n: u64, grid: Grid, upwards: Upwards) -> ShareRaster {
    share_raster(n, grid, upwards, CircleLimits::default(), |_| Continue(())).unwrap()
}

/// A hop is one turn, also where it begins within the range of the series and ends beyond it.
#[test]
fn a_hop_is_one_turn_on_all_of_the_domain() {
    let step = if cfg!(debug_assertions) { 3 } else { 1 };
    let mut beyond = 0;
    for (n, m) in [(1, 0.2), (2, 0.2), (3, 0.5), (5, 0.12), (2, 0.8), (2, 3.0)] {
        let fates = fates(m);
        let circle = circle(&fates, n);
        let map = LiftOffMap::new(fates.map().mass_ratio());
        let lowest = FixedPointSpeed::new(n).offset_of(circle.domain().0);
        for k in (0..60).step_by(step) {
            let delta = 0.999 * lowest * pxfm::f_exp10(-0.1 * f64::from(k));
            let next = map.hop_near_fixed_point(n, delta).unwrap().next.unwrap();
            if next < lowest {
                continue;
            }
            let before = circle.phase(Offset::from(delta)).unwrap();
            let after = circle.phase(Offset::from(next)).unwrap();
            let hop = after.plus(1);
            let whole: f64 = (hop.whole() - before.whole()).to_string().parse().unwrap();
            let off = (whole + hop.fraction() - before.fraction()).abs();
            // The rounding of `next` is 8 ulps, divided by the loss.
            let rounding = 8.0 * f64::EPSILON * next.abs() / (delta - next);
            let most = before.error() + after.error() + rounding;
            assert!(off <= most && most < 1e-9, "{n} {m} {delta:e}: {off:e} {most:e}");
            let range = circle.coordinate().range();
            beyond += usize::from(next.abs() > range);
        }
        assert!(circle.phase(Offset::from(1.01 * lowest)).is_err());
        assert!(circle.phase(Offset::from(1e-9)).is_err());
    }
    assert!(beyond > 100 / step, "{beyond}");
}

/// `count` offsets at equal steps of phase between two offsets, by linear interpolation between 101 phases.
fn equal_steps(circle: &PhaseBasins, (far, near): (f64, f64), count: usize) -> Vec<f64> {
    let node = |k: usize| far + (near - far) * (k as f64 / 100.0);
    let phase = |k: usize| circle.phase(Offset::from(node(k))).unwrap();
    let first = phase(0);
    let turns = |phase: Phase| {
        let whole: f64 = (phase.whole() - first.whole()).to_string().parse().unwrap();
        whole + phase.fraction() - first.fraction()
    };
    let known: Vec<f64> = (0..=100).map(|k| turns(phase(k))).collect();
    let offset = |k: usize| {
        let wanted = known[100] * ((k as f64 + 0.5) / count as f64);
        let at = known.partition_point(|&turns| turns < wanted).clamp(1, 100);
        let part = (wanted - known[at - 1]) / (known[at] - known[at - 1]);
        node(at - 1) + part * (node(at) - node(at - 1))
    };
    (0..count).map(offset).collect()
}

/// 400 speeds at equal steps of phase in each of five pixels from 3·10⁻² to 10⁻⁶; the highest pixel is some turns high.
#[test]
fn the_share_of_a_pixel_is_that_of_its_speeds() {
    const POINTS: usize = 400;
    for (n, m) in [(2, 0.12), (2, 0.8), (3, 0.2)] {
        // So narrow that the circle and the phases do not move.
        let grid = grid((m, m + 1e-9), (1.5, 6.0), 1, 45);
        let found = raster(n, grid, Upwards::Depth);
        assert!(found.labels().len() > 1);
        let fates = fates(grid.x_at(0));
        let circle = circle(&fates, n);
        let star = FixedPointSpeed::new(n).value();
        for row in (0..grid.rows).step_by(11) {
            let edge = |row: usize| {
                let depth = grid.y.left + grid.y.length() * (row as f64 / grid.rows as f64);
                -pxfm::f_exp10(-depth)
            };
            let offsets = equal_steps(&circle, (edge(row), edge(row + 1)), POINTS);
            let speeds: Vec<f64> = offsets.into_iter().map(|delta| star + delta).collect();
            let labels = fates.labels(&speeds).unwrap();
            for (label, &share) in found.labels().iter().zip(found.at(0, row).unwrap()) {
                let seen = labels.iter().filter(|own| *own == label).count() as f64;
                let off = (seen / POINTS as f64 - f64::from(share)).abs();
                // Every boundary point in the pixel changes a count of equal steps by at most one.
                assert!(off < 0.03, "{n} {m} {row} {label}: {seen} {share}");
            }
        }
    }
}

/// At every depth a pixel has the local fractions, and a row of phases has the label of its phases.
#[test]
fn deep_pixels_have_the_local_fractions() {
    let deep = raster(2, grid((0.15, 0.3), (150.0, 1000.0), 3, 40), Upwards::Depth);
    let turn = raster(2, grid((0.15, 0.3), (-1.0, 2.0), 3, 60), Upwards::Phase);
    for column in 0..3 {
        let fates = fates(deep.grid().x_at(column));
        let circle = circle(&fates, 2);
        for (at, &label) in deep.labels().iter().enumerate() {
            let local = circle.fractions().of(label).middle();
            for row in 0..40 {
                let share = f64::from(deep.at(column, row).unwrap()[at]);
                assert!((share - local).abs() < 1e-6, "{column} {row} {label}: {share} {local}");
            }
            let sum: f64 = (0..60).map(|row| f64::from(turn.at(column, row).unwrap()[at])).sum();
            assert!((sum / 60.0 - local).abs() < 1e-6, "{column} {label}: {sum} {local}");
        }
        for row in 0..60 {
            let label = circle.label_at(-1.0 + 0.05 * (row as f64 + 0.5), 0.025);
            if let Some(at) = label.and_then(|l| turn.labels().iter().position(|own| *own == l)) {
                assert!(turn.at(column, row).unwrap()[at] > 0.999_999, "{column} {row}");
            }
        }
    }
    assert!(deep.at(3, 0).is_none() && deep.at(0, 40).is_none());
    assert_eq!(deep.labels(), [0, 1].map(Label::from));
}

/// A raster over mass ratios covers the phases of all its mass ratios: no stripes appear where a turn is higher
/// than a pixel's width.
#[test]
fn pixels_cover_the_phases_of_all_their_mass_ratios() {
    // A pixel is 0.04 turns high, and its phases move by three turns over its width.
    let found = raster(2, grid((0.19, 0.21), (9.0, 9.001), 2, 1), Upwards::Depth);
    for column in 0..2 {
        let circle = circle(&fates(found.grid().x_at(column)), 2);
        let local = circle.fractions().of(1.into()).middle();
        let share = f64::from(found.at(column, 0).unwrap()[1]);
        assert!((share - local).abs() < 0.35 * local, "{share} {local}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_shares_and_the_work_can_be_stopped() {
    let grid = grid((0.1, 0.9), (0.0, 40.0), 7, 20);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let all = [1, 3].map(|threads| pool(threads).install(|| raster(2, grid, Upwards::Depth)));
    assert!(all[0] == all[1]);
    assert!(all[0].labels().contains(&HopperFate::GROUNDED));
    // The lowest row lies beyond the domain.
    assert!(all[0].at(0, 0).unwrap().iter().all(|&share| share == 0.0));
    let stop = |done| if done >= 2 { Break(()) } else { Continue(()) };
    let error = share_raster(1, grid, Upwards::Phase, CircleLimits::default(), stop).unwrap_err();
    assert!(matches!(error, Error::BasinOfAttraction(_)), "{error}");
}

#[test]
fn rasters_without_a_meaning_are_errors() {
    let good = grid((0.1, 0.2), (2.0, 3.0), 2, 2);
    let limits = CircleLimits::default();
    let shares = |n, grid, upwards| share_raster(n, grid, upwards, limits, |_| Continue(()));
    assert!(shares(0, good, Upwards::Depth).is_err());
    assert!(shares(1, Grid { rows: 0, ..good }, Upwards::Depth).is_err());
    assert!(shares(1, grid((-0.1, 0.2), (2.0, 3.0), 2, 2), Upwards::Phase).is_err());
    assert!(shares(1, grid((0.1, 0.2), (2.0, 20_000.0), 2, 2), Upwards::Depth).is_err());
}
