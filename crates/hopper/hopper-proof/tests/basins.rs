//! Proved basins: never another fate than that of the orbit, and most of a window.
#![allow(clippy::unwrap_used)]

use basin_of_attraction::{Grid, Interval, Refinement, StopReason};
use hopper_basin::{BranchGround, Fates, HopperFate, basin_raster, first_humps};
use hopper_proof::{
    Cell, Error, ProvedCells, ProvedFractions, ProvedLine, Strip, basins_at_every_mass_ratio,
    measures, proved_basins, proved_points, proved_strips,
};
use passive_hopper::MassRatio;
use std::ops::ControlFlow::Continue;

/// The intervals of a strip against the fates of single speeds at single mass ratios of it, also where a hop may
/// have several sudden lift-offs.
#[test]
fn no_interval_has_a_wrong_fate() {
    let part = |k: u32, step: f64| (f64::from(k) * step).fract();
    for (ratio, width, most_open) in [
        (0.1, 0.0, 0.01),
        (0.2, 1e-4, 0.08),
        (0.5, 0.0, 0.02),
        (0.9, 1e-4, 0.03),
        (0.95, 0.0, 0.02),
        (1.0, 0.0, 0.02),
        (2.0, 0.0, 0.03),
        (3.0, 1e-5, 0.1),
    ] {
        let strip = Strip::between(ratio, ratio + width).unwrap();
        let window = first_humps(3);
        let line = ProvedLine::new(strip, window, 32, 0.01, 4000).unwrap();
        let mut open = 0;
        for k in 1..=2000u32 {
            let alpha = window.left + window.length() * part(k, 0.754_877_666_246_693);
            let mass = ratio + width * part(k, 0.618_033_988_749_895);
            let fates = Fates::new(MassRatio::new(mass).unwrap()).unwrap();
            let fate = fates.fate(alpha).unwrap().label();
            match line.label_of_all(alpha, alpha) {
                Some(label) => assert!(
                    label == fate || fate.is_undecided(),
                    "M = {mass}, α = {alpha}: {label} {fate}"
                ),
                None => open += 1,
            }
        }
        assert!(f64::from(open) < 2000.0 * most_open, "M = {ratio}: {open} of 2000 open");
    }
}

/// The edge of grounding at α = 6.2636 moves by 3·10⁻⁴ with the mass ratios of the strip. This band stays open, and
/// leaves enough speeds for what lies above it.
#[test]
fn an_open_band_takes_few_speeds() {
    let strip = Strip::between(0.8555, 0.8565).unwrap();
    let line = ProvedLine::new(strip, Interval::new(6.23, 6.48).unwrap(), 1, 1e-5, 600).unwrap();
    let decays = Some(HopperFate::label_of_fixed_point(0));
    assert_eq!(line.label_of_all(6.2640, 6.4250), decays);
    assert_eq!(line.label_of_all(6.4265, 6.4799), Some(HopperFate::GROUNDED));
    assert_eq!(line.label_of_all(6.2636, 6.2637), None);
}

/// A raster in which every point is proved has the labels of the library.
#[test]
fn all_points_of_a_raster_are_proved() {
    let x = Interval::new(0.02, 1.0).unwrap();
    let grid = Grid { x, y: first_humps(5), columns: 6, rows: 300 };
    let proved = proved_points(grid, |_| Continue(())).unwrap();
    assert_eq!(proved, basin_raster(grid, |_| Continue(())).unwrap());
}

fn cells(grid: Grid, strips: usize) -> ProvedCells {
    let mut cells = ProvedCells::new(grid, strips).unwrap();
    let all = proved_strips(&grid, strips, 0..grid.columns, |_| Continue(())).unwrap();
    for column in all.chunks(strips) {
        cells.add_column(column).unwrap();
    }
    cells
}

/// Every point of a coloured cell has its fate, and the areas of the basins are bounded from both sides.
#[test]
fn cells_hold_for_all_their_points() {
    let (x, y) = (Interval::new(0.3, 0.31).unwrap(), Interval::new(8.0, 12.0).unwrap());
    let grid = Grid { x, y, columns: 4, rows: 64 };
    let (coarse, finer) = (cells(grid, 2), cells(grid, 8));
    // More strips leave less open.
    assert!(
        finer.open_area() < 0.7 * coarse.open_area(),
        "{} {}",
        finer.open_area(),
        coarse.open_area()
    );
    let points = Grid { columns: 12, rows: 320, ..grid };
    let image = basin_raster(points, |_| Continue(())).unwrap();
    let mut basins = 0;
    for row in 0..320 {
        for column in 0..12 {
            if let Cell::Basin(label) = finer.cells()[(row / 5) * 4 + column / 3] {
                assert_eq!(image.at(column, row), Some(label), "{column} {row}");
                basins += 1;
            }
        }
    }
    assert!(basins > 2000, "{basins}");
    // Areas, against the fractions of the points, of which 3840 are no worse than a hundredth here.
    for (label, share) in finer.areas() {
        let found = image.labels.iter().filter(|&&own| own == label).count() as f64 / 3840.0;
        assert!(
            share.low() - 0.01 < found && found < share.high() + 0.01,
            "{label} {share:?} {found}"
        );
    }
}

/// The fractions at the paper's first mass ratio, between bounds of 10⁻⁴: 0.953 of the speeds come to α*_1, and
/// 0.0348 to α*_2.
#[test]
fn fractions_lie_between_their_bounds() {
    let found = ProvedFractions::new(0.1, 1e-4).unwrap();
    assert!(found.width <= 1e-4, "{}", found.width);
    let of = |n: u64| {
        let label = HopperFate::label_of_fixed_point(n);
        found.fractions.iter().find(|fraction| fraction.label == label).unwrap().uniform
    };
    assert!(of(1).low() > 0.9533 && of(1).high() < 0.9535, "{:?}", of(1));
    assert!(of(2).low() > 0.0348 && of(2).high() < 0.0350, "{:?}", of(2));
    // Below the first crisis nothing decays or is grounded.
    assert!(of(0).low() == 0.0 && of(0).high() < 1e-4);
}

/// Bounds to different widths, from other intervals and gaps, hold the same fractions, and so do the fates of
/// equally spaced speeds; also where hops have several sudden lift-offs, and where F is not continuous.
#[test]
fn bounds_of_fractions_agree_with_each_other_and_with_fates() {
    // Without optimization M = 1 is left out, which takes half of the time.
    let ratios = if cfg!(debug_assertions) { 2 } else { 3 };
    let all = [(0.1, [1e-3, 1e-7]), (0.5, [1e-2, 1e-5]), (1.0, [1e-2, 1e-4])];
    for (ratio, widths) in all.into_iter().take(ratios) {
        let found = widths.map(|width| ProvedFractions::new(ratio, width).unwrap());
        let fates = Fates::new(MassRatio::new(ratio).unwrap()).unwrap();
        let window = first_humps(5);
        let fate = |k: u32| {
            let place = (f64::from(k) + 0.5) / 20_000.0;
            fates.fate(window.left + window.length() * place).unwrap().label()
        };
        let labels: Vec<_> = (0..20_000).map(fate).collect();
        for (coarse, fine) in found[0].fractions.iter().zip(&found[1].fractions) {
            assert_eq!(coarse.label, fine.label);
            assert!(coarse.uniform.intersection(&fine.uniform).is_some(), "{coarse:?} {fine:?}");
            assert!(coarse.by_humps.intersection(&fine.by_humps).is_some(), "{coarse:?} {fine:?}");
            let count = labels.iter().filter(|&&label| label == fine.label).count();
            let share = count as f64 / labels.len() as f64;
            assert!((share - fine.uniform.middle()).abs() < 5e-3, "{ratio}: {share} {fine:?}");
        }
        assert!(found.iter().zip(widths).all(|(found, width)| found.width < width), "{ratio}");
    }
}

/// Of each gap, basins have the length that is proved: the fates of its speeds tell it.
#[test]
fn gaps_have_the_lengths_that_are_proved() {
    const SPEEDS: u32 = 400;
    for ratio in [0.1, 0.5, 1.5] {
        let mut gaps = ProvedFractions::new(ratio, 1e-2).unwrap().gaps;
        gaps.sort_by(|a, b| b.speeds.length().total_cmp(&a.speeds.length()));
        let fates = Fates::new(MassRatio::new(ratio).unwrap()).unwrap();
        let (mut proved, mut whole) = (0.0, 0.0);
        for gap in &gaps[..100] {
            let place = |k: u32| (f64::from(k) + 0.5) / f64::from(SPEEDS);
            let speed = |k: u32| gap.speeds.left + gap.speeds.length() * place(k);
            let labels: Vec<_> =
                (0..SPEEDS).map(|k| fates.fate(speed(k)).unwrap().label()).collect();
            for &(label, least) in &gap.at_least {
                let count = labels.iter().filter(|&&own| own == label).count();
                let share = count as f64 / f64::from(SPEEDS);
                assert!(least / gap.speeds.length() <= share + 0.03, "{ratio}: {gap:?} {share}");
                proved += least;
            }
            whole += gap.speeds.length();
        }
        assert!(proved > 0.8 * whole, "{ratio}: {proved} of {whole}");
    }
}

#[test]
fn what_is_no_question_is_refused() {
    for (low, high) in [(0.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.1, f64::INFINITY), (-1.0, 1.0)]
    {
        assert!(matches!(Strip::between(low, high), Err(Error::MassRatios { .. })), "{low} {high}");
    }
    let strip = Strip::at(0.2).unwrap();
    for (left, right) in [(5.0, 4.0), (-1.0, 4.0), (1.0, f64::NAN), (1.0, 1e6)] {
        let refused = ProvedLine::new(strip, Interval { left, right }, 8, 0.01, 100);
        assert!(matches!(refused, Err(Error::Speeds { .. })), "{left} {right}");
    }
    let window = Interval { left: 5.0, right: 6.0 };
    for (parts, open) in [(0, 0.1), (4, 0.0), (4, 2.0), (4, f64::NAN)] {
        let refused = ProvedLine::new(strip, window, parts, open, 100);
        assert!(matches!(refused, Err(Error::Share { .. })), "{parts} {open}");
    }
    for width in [0.0, 1e-320, 1e-13, 1.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = ProvedFractions::new(0.2, width);
        assert!(matches!(refused, Err(Error::Width { .. })), "{width}");
        assert!(matches!(measures(&[(0.2, 0.5), (0.2, width)], |_| {}), Err(Error::Width { .. })));
    }
}

/// Where the map's branches are not known, intervals come from enclosures. A search with sampled branches had 64 to
/// 839 wrong labels here.
#[test]
fn basins_as_intervals_have_no_wrong_label_at_any_mass_ratio() {
    // Without optimization fewer probes are compared, and M = 20 is left out, which takes three quarters of the time.
    let (count, ratios) = if cfg!(debug_assertions) { (5_000, 3) } else { (20_000, 4) };
    for (m, undecided) in
        [(0.95, 0.5), (2.0, 2.0), (5.0, 5.0), (20.0, 8.0)].into_iter().take(ratios)
    {
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        let refinement = Refinement { undecided, ..Refinement::default() };
        let found = basins_at_every_mass_ratio(&fates, 1, 6, 400, refinement).unwrap();
        assert_eq!(found.ground, BranchGround::Enclosures, "{m}");
        assert_eq!(found.basins.stop_reason(), StopReason::Resolved, "{m}");
        assert!(found.basins.undecided() <= undecided, "{m} {}", found.basins.undecided());
        let probes = found.probe(&fates, count, 7).unwrap();
        assert!(probes.wrong == 0 && probes.compared > 2 * count / 5, "{m} {probes:?}");
    }
}

#[test]
fn basins_as_intervals_take_the_sharper_ground() {
    let at = |m: f64, refinement| {
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        basins_at_every_mass_ratio(&fates, 1, 2, 400, refinement)
    };
    let coarse = Refinement { undecided: 0.01, ..Refinement::default() };
    assert_eq!(at(0.2, coarse).unwrap().ground, BranchGround::Proved);
    assert_eq!(at(100.0, coarse).unwrap().ground, BranchGround::ContactParts);
    // Few intervals are allowed: the first sweep is the last one.
    let few = Refinement { undecided: 0.0, intervals: 1, ..Refinement::default() };
    let found = at(2.0, few).unwrap();
    assert_eq!(found.basins.stop_reason(), StopReason::IntervalLimit);
    let fates = Fates::new(MassRatio::new(2.0).unwrap()).unwrap();
    for (from, to) in [(2, 2), (3, 1), (0, u64::MAX), (u64::MAX, u64::MAX)] {
        assert!(proved_basins(&fates, from, to, coarse).is_err(), "{from} {to}");
    }
    for undecided in [-1.0, f64::NAN] {
        let refinement = Refinement { undecided, ..Refinement::default() };
        assert!(proved_basins(&fates, 1, 2, refinement).is_err(), "{undecided}");
    }
}
