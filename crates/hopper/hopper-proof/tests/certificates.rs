//! The numbers of a certificate are those of its theorem, and what is false is not called proved.
#![allow(clippy::unwrap_used)]

use basin_of_attraction::{Grid, Interval};
use hopper_basin::{HopperFate, SpeedImage, SpeedImages, basin_raster, first_humps};
use hopper_proof::{
    CertificateLine, Error, ProvedCells, ProvedFractions, ProvedImages, Strip, cells_theorem,
    crises, everything_hops, one_sided, points_theorem, proved_points, proved_strips, rising,
    trap_edges,
};
use std::ops::ControlFlow::Continue;

fn small_raster() -> Grid {
    let x = Interval::new(0.15, 0.6).unwrap();
    Grid { x, y: first_humps(3), columns: 2, rows: 60 }
}

#[test]
fn every_step_of_a_theorem_has_its_evidence() {
    assert_eq!(one_sided(3).unwrap().evidence.len(), 3);
    assert_eq!(crises(4).unwrap().evidence.len(), 4);
    assert_eq!(trap_edges(2, 5).unwrap().evidence.len(), 10);
    // The crisis, 256 parts of seven humps, and the bound beyond.
    assert_eq!(everything_hops().unwrap().evidence.len(), 1 + 7 * 256 + 1);
    let boxes = rising(&[(1, 0.5)]).unwrap().evidence;
    let area = |evidence: &CertificateLine| match evidence {
        CertificateLine::RisingBox { speeds, kappas, .. } => speeds.width() * kappas.width(),
        _ => 0.0,
    };
    let CertificateLine::RisingWindow { speeds, .. } = &boxes[0] else { panic!("{:?}", boxes[0]) };
    let whole = speeds.width() / 3.0; // κ = ⅓ at M = ½
    assert!((boxes.iter().map(area).sum::<f64>() / whole - 1.0).abs() < 1e-12);
}

/// A hundredth beyond the end of a trap the map falls below α*_n, and so it does at the speed that is given for it.
#[test]
fn a_trap_a_hundredth_too_long_is_none() {
    for evidence in trap_edges(4, 7).unwrap().evidence {
        let CertificateLine::Trap { n, fixed_point: star, mass_ratio, right, beyond } = evidence
        else {
            panic!("{evidence:?}")
        };
        let images = ProvedImages::new(Strip::at(mass_ratio).unwrap(), right + 1.0).unwrap();
        let falls_below = |speed: f64, end: f64| match images.of_speed(speed) {
            SpeedImage::Within(_, high) => high <= end,
            SpeedImage::Grounded => true,
            SpeedImage::Unknown => false,
        };
        // The fall at this speed is within the width of the enclosure of α*_n.
        assert!(falls_below(beyond.unwrap(), star.high()), "{n} {mass_ratio}");
        // Next to the crisis the map falls and rises again within a hundredth of the trap.
        let longer = star.high() + 1.01 * (right - star.high());
        assert!(
            mass_ratio < 0.3 || falls_below(longer, star.low().next_down()),
            "{n} {mass_ratio}"
        );
    }
}

/// A point with another label, and a point without a proof: both leave the theorem open.
#[test]
fn a_swapped_label_and_a_missing_point_are_not_proved() {
    let grid = small_raster();
    let computed = basin_raster(grid, |_| Continue(())).unwrap();
    let proved = proved_points(grid, |_| Continue(())).unwrap();
    let theorem = points_theorem("points", &proved, &computed).unwrap();
    assert!(theorem.is_proved(), "{theorem:#?}");
    // The grid, the speeds, and one line a column.
    assert_eq!(theorem.evidence.len(), 2 + grid.columns);
    // The labels of fewer points.
    let mut fewer = computed.clone();
    fewer.labels.truncate(7);
    assert!(!points_theorem("points", &proved, &fewer).unwrap().is_proved());
    for label in [HopperFate::label_of_fixed_point(3), HopperFate::UNDECIDED_PRECISION] {
        let mut false_one = proved.clone();
        assert_ne!(false_one.labels[7], label);
        false_one.labels[7] = label;
        assert!(!points_theorem("points", &false_one, &computed).unwrap().is_proved());
    }
}

/// The strips of a certificate cover the window, and hold the cells that the theorem counts.
#[test]
fn strips_hold_the_cells() {
    let x = Interval::new(0.3, 0.301).unwrap();
    let grid = Grid { x, y: first_humps(2), columns: 2, rows: 50 };
    let strips = proved_strips(&grid, 3, 0..2, |_| Continue(())).unwrap();
    let mut found = ProvedCells::new(grid, 3).unwrap();
    let wrong = found.add_column(&strips[1..4]);
    assert!(matches!(wrong, Err(Error::Strips { column: 0, found: 3, needed: 3 })), "{wrong:?}");
    found.add_column(&strips[..3]).unwrap();
    let half = cells_theorem("cells", &found, 0.5);
    assert!(matches!(half, Err(Error::Columns { wanted: 1, all: 2 })), "{half:?}");
    found.add_column(&strips[3..]).unwrap();
    assert!(matches!(found.add_column(&strips[3..]), Err(Error::Columns { wanted: 3, all: 2 })));
    let evidence = cells_theorem("cells", &found, 0.5).unwrap().evidence;
    assert!(matches!(evidence[2], CertificateLine::Strips(6)), "{:?}", evidence[2]);
    let CertificateLine::Cells { edges, of_one_basin } = &evidence[1] else {
        panic!("{:?}", evidence[1])
    };
    let strips: Vec<_> =
        strips.into_iter().map(|(own, line)| (own, line.intervals().to_vec())).collect();
    assert!(strips.windows(2).all(|pair| pair[0].0.right == pair[1].0.left));
    let label = |intervals: &[(Interval, _)], low: f64, high: f64| {
        let own = intervals.iter().find(|(own, _)| own.left <= low && high <= own.right);
        own.map(|(_, label)| *label)
    };
    let mut count = 0;
    for column in strips.chunks(3) {
        for ends in edges.windows(2) {
            let all: Vec<_> = column.iter().map(|(_, own)| label(own, ends[0], ends[1])).collect();
            count += usize::from(all[0].is_some() && all.iter().all(|other| *other == all[0]));
        }
    }
    assert_eq!(count, *of_one_basin);
    assert!(count > 20, "{count}");
}

/// The image of the middle of an interval lies in an interval of the same label, or in none: a swapped label is
/// seen by one hop.
#[test]
fn images_of_intervals_have_their_label() {
    let found = ProvedFractions::new(0.2, 1e-3).unwrap();
    let images = ProvedImages::new(Strip::at(0.2).unwrap(), 21.0).unwrap();
    let mut seen = 0;
    for (own, label) in &found.intervals {
        let SpeedImage::Within(low, high) = images.of_speed(0.5 * (own.left + own.right)) else {
            continue;
        };
        let inside = |(other, _): &&(Interval, _)| other.left <= low && high <= other.right;
        if let Some((_, other)) = found.intervals.iter().find(inside) {
            assert_eq!(other, label, "{own:?}");
            seen += 1;
        }
    }
    assert!(2 * seen > found.intervals.len(), "{seen} of {}", found.intervals.len());
}
