//! Charts about edges of basins have the edge to forty digits, and the fates beside it.

use basin_of_attraction::Label;
use hopper_asymptotics::{Offset, Side};
use hopper_basin::{CircleLimits, EdgeChart, Error, Fates, HopperFate, PhaseBasins, edge_phase};
use hopper_reference::rows;
use passive_hopper::{Arithmetic, ExtendedOrbit, ExtendedStep, MassRatio};

const GROUNDED: Label = HopperFate::GROUNDED;

fn fates(mass_ratio: f64) -> Fates {
    Fates::new(MassRatio::new(mass_ratio).unwrap()).unwrap()
}

fn circle(fates: &Fates, n: u64) -> PhaseBasins {
    PhaseBasins::new(fates, n, CircleLimits::default()).unwrap()
}

/// Digits of a decimal number in units of 10⁻³⁰.
fn digits(text: &str) -> i128 {
    let negative = text.starts_with('-');
    let (whole, fraction) = text.trim_start_matches('-').split_once('.').unwrap();
    let digits = format!("{whole}{fraction:0<30.30}");
    let value: i128 = digits.parse().unwrap();
    if negative { -value } else { value }
}

/// The references have 40 digits, and the slope 17 (mpmath).
#[test]
fn edges_agree_with_forty_digits() {
    let mut compared = 0;
    for row in rows(include_str!("data/edges.jsonl")) {
        let fates = fates(row.input("mass_ratio"));
        let chart = EdgeChart::near(&fates, row.input("alpha")).unwrap();
        assert_eq!((chart.n(), chart.hops() as u64), (row.integer("n"), row.integer("hops")));
        let (point, rest, error) = chart.point();
        let ours = digits(&format!("{point:.60}")) + digits(&format!("{rest:.60}"));
        let off = (digits(row.text("edge")) - ours).unsigned_abs() as f64 * 1e-30;
        assert!(off <= error + 4e-30 && error < 1e-28, "{row}: {off:e}, said {error:e}");
        let slope: f64 = row.text("slope").parse().unwrap();
        assert!((chart.slope() / slope - 1.0).abs() < 1e-15, "{row} {}", chart.slope());
        compared += 1;
    }
    assert_eq!(compared, 4);
}

/// f^k(p + y) in 256 bits, minus D₁ y (1 + D₂ y/2), is within the remainder, at y that the chart was not made from.
#[test]
fn the_remainder_of_a_chart_covers_exact_orbits() {
    for row in rows(include_str!("data/edges.jsonl")) {
        let fates = fates(row.input("mass_ratio"));
        let chart = EdgeChart::near(&fates, row.input("alpha")).unwrap();
        let (point, rest, _) = chart.point();
        for k in 0..40 {
            let part = pxfm::f_exp10(-0.2 * f64::from(k)) * 0.97;
            for sign in [1.0, -1.0] {
                let speed = point + sign * part * chart.radius();
                // `speed` − `point` is exact.
                let y = (speed - point) - rest;
                let mut orbit =
                    ExtendedOrbit::new(fates.map(), speed, Arithmetic::Bits256).unwrap();
                for _ in 0..chart.hops() {
                    assert_eq!(orbit.hop().unwrap(), ExtendedStep::LiftsOff);
                }
                let exact = orbit.offset_from(chart.n()).0;
                let (found, error) = chart.offset(Offset::from(y)).unwrap();
                let off = (found.nearest() / exact - 1.0).abs();
                assert!(off <= error, "{row} at {y:e}: {off:e} > {error:e}");
            }
        }
    }
}

/// The references are fates of exact doubles from 10⁻⁸ to some ulps beside the edges, followed with 60 digits.
#[test]
fn labels_of_charts_agree_with_reference_fates() {
    let charts: Vec<(f64, EdgeChart, PhaseBasins)> = rows(include_str!("data/edges.jsonl"))
        .map(|row| {
            let fates = fates(row.input("mass_ratio"));
            let chart = EdgeChart::near(&fates, row.input("alpha")).unwrap();
            (row.input("mass_ratio"), chart, circle(&fates, chart.n()))
        })
        .collect();
    let (mut compared, mut unknown) = (0, 0);
    for row in rows(include_str!("data/edge_fates.jsonl")) {
        let alpha = row.input("alpha");
        let own = charts.iter().find(|(mass_ratio, chart, _)| {
            *mass_ratio == row.input("mass_ratio") && (chart.point().0 - alpha).abs() < 1e-6
        });
        let Some((_, chart, circle)) = own else { continue };
        let (point, rest, _) = chart.point();
        let found = chart.label(circle, Offset::from((alpha - point) - rest)).unwrap();
        let expected = match row.text("fate") {
            "decaying" => Label::from(0),
            "grounded" => GROUNDED,
            _ => HopperFate::label_of_fixed_point(row.integer("n")),
        };
        compared += 1;
        match found {
            Some(label) => assert_eq!(label, expected, "{row}"),
            None => unknown += 1,
        }
    }
    assert!(compared > 500 && unknown * 50 < compared, "{unknown} of {compared}");
}

/// Theorem 87 next to a preimage: speeds within 10⁻⁷ of the edge, at random places, have the local fractions.
#[test]
fn speeds_next_to_an_edge_have_the_local_fractions() {
    let fates = fates(0.12);
    let chart = EdgeChart::onto(&fates, 2, 11.9206).unwrap();
    assert_eq!(chart.basin_side(), Side::Right);
    let circle = circle(&fates, 2);
    let count = 4000;
    let speeds: Vec<f64> =
        (1..=count).map(|k| chart.point().0 - 1e-7 * f64::from(k) / f64::from(count)).collect();
    let labels = fates.labels(&speeds).unwrap();
    let share =
        labels.iter().filter(|&&label| label == Label::from(1)).count() as f64 / f64::from(count);
    // x = 0.003: the last turns are some hundredths of the interval.
    assert!((share - circle.fractions().of(1.into()).middle()).abs() < 0.02, "{share}");
}

#[test]
fn windows_of_any_width_about_an_edge_have_shares() {
    let fates = fates(0.12);
    let chart = EdgeChart::onto(&fates, 2, 11.9206).unwrap();
    let circle = circle(&fates, 2);
    let local = circle.fractions().of(1.into());
    let offset = |text: &str| text.parse::<Offset>().unwrap();
    for depth in ["e-30", "e-100", "e-300", "e-1000"] {
        let [near, far] = ["-1", "-2"].map(|digit| offset(&format!("{digit}{depth}")));
        let share = chart.share(&circle, far, near).unwrap().of(1.into());
        assert!((share.middle() - local.middle()).abs() < 1e-7, "{depth} {share:?}");
        assert!(share.half_width() < 1e-7, "{depth} {share:?}");
        // The other side belongs to basin 2, and a pixel across the edge is half of each.
        let right = offset(&format!("1{depth}"));
        assert_eq!(chart.label(&circle, right).unwrap(), Some(2.into()));
        let across = chart.share(&circle, near, right).unwrap();
        assert!((across.of(2.into()).middle() - 0.5).abs() < 1e-7, "{depth} {across:?}");
        assert!(
            (across.of(1.into()).middle() - 0.5 * local.middle()).abs() < 1e-7,
            "{depth} {across:?}"
        );
    }
    // At 10⁻¹² a narrow pixel has the share of its own phases.
    let pixel = chart.share(&circle, offset("-1e-12"), offset("-1.0000001e-12")).unwrap();
    let label = chart.label(&circle, offset("-1e-12")).unwrap().unwrap();
    assert!(pixel.of(label).lower > 0.99, "{pixel:?}");
}

#[test]
fn wrong_inputs_are_errors() {
    let fates = fates(0.2);
    assert!(matches!(EdgeChart::near(&fates, 4.55), Err(Error::NoEdge { .. })));
    assert!(EdgeChart::near(&fates, f64::NAN).is_err());
    let chart = EdgeChart::onto(&fates, 1, 8.47304).unwrap();
    let (own, other) = (circle(&fates, 1), circle(&fates, 2));
    let y = Offset::from(-1e-9);
    assert!(matches!(chart.label(&other, y), Err(Error::OtherCircle { .. })));
    assert!(matches!(chart.offset(Offset::from(1.0)), Err(Error::OutsideChart { .. })));
    // A point on the side of the basin has no phase.
    assert!(chart.phase(&own, y).is_ok());
    assert!(chart.phase(&own, Offset::from(1e-9)).is_err());
    assert!(matches!(chart.phase(&other, y), Err(Error::OtherCircle { .. })));
}

/// In the middle of a basin the nearest edge is far; each one that is found has fates of both kinds beside it.
#[test]
fn from_every_point_an_edge_is_found() {
    for mass_ratio in [1e-3, 0.02, 0.1, 0.2, 0.5, 1.0, 3.0, 40.0] {
        let fates = fates(mass_ratio);
        for alpha in [0.3, 2.0, 4.2, 4.55, 6.0, 7.72, 9.5, 12.0, 15.5, 19.9, 60.0] {
            let chart = EdgeChart::nearest(&fates, alpha).unwrap();
            let (point, ..) = chart.point();
            // A fixed point is never farther.
            assert!((point - alpha).abs() < 3.2 || alpha < 1.5, "{mass_ratio} {alpha} {point}");
            let own = HopperFate::label_of_fixed_point(chart.n());
            // The basin of α*_n is on one side, the one to which the slope points.
            let beside = point + 1e-9 * chart.slope().signum();
            assert_eq!(fates.labels(&[beside]).unwrap()[0], own, "{mass_ratio} {alpha} {point}");
        }
    }
    assert!(EdgeChart::nearest(&fates(0.2), f64::NAN).is_err());
}

/// Ψ grows as |δ|^(−1/3): a thousandth of the distance is ten times as many hops.
#[test]
fn the_phase_at_the_end_of_a_window_turns_with_its_depth() {
    let fates = fates(0.12);
    let chart = EdgeChart::near(&fates, 11.920553918335775).unwrap();
    let circle = circle(&fates, chart.n());
    let whole = |depth: f64| -> f64 {
        let phase = edge_phase(&chart, &circle, depth).unwrap();
        assert!(phase.error() < 1e-3 && (0.0..1.0).contains(&phase.fraction()));
        phase.whole().to_string().parse().unwrap()
    };
    let ratio = whole(30.0) / whole(27.0);
    // But for a logarithm of the number of hops.
    assert!((ratio - 10.0).abs() < 1e-5, "{ratio}");
    assert!(edge_phase(&chart, &circle, 100.0).unwrap().error() > 1.0);
    assert!(edge_phase(&chart, &circle, f64::NAN).is_err());
}
