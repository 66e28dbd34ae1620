//! Windows about an edge show the fates of their speeds, at any height.

use hopper_basin::{CircleLimits, EdgeChart, Error, Fates, PhaseBasins, edge_window};
use passive_hopper::MassRatio;

fn edge() -> (Fates, EdgeChart, PhaseBasins) {
    let fates = Fates::new(MassRatio::new(0.12).unwrap()).unwrap();
    let chart = EdgeChart::near(&fates, 11.920553918335777).unwrap();
    let circle = PhaseBasins::new(&fates, chart.n(), CircleLimits::default()).unwrap();
    (fates, chart, circle)
}

/// Pixels from the chart against the fates of 200 doubles in each.
#[test]
fn pixels_of_the_chart_have_the_fates_of_their_speeds() {
    const ROWS: usize = 6;
    let (fates, chart, circle) = edge();
    let (half, count) = (1e-9, 200);
    let pixels = edge_window(&fates, &chart, &circle, 9.0, ROWS).unwrap();
    let mut mixed = 0;
    for (row, pixel) in pixels.iter().enumerate() {
        let y = |k: usize| {
            let place = (row as f64 + (k as f64 + 0.5) / count as f64) / ROWS as f64;
            half * (2.0 * place - 1.0)
        };
        let speeds: Vec<f64> = (0..count).map(|k| chart.point().0 + y(k)).collect();
        let labels = fates.labels(&speeds).unwrap();
        for label in pixel.labels() {
            let seen = labels.iter().filter(|own| **own == label).count() as f64 / count as f64;
            let share = pixel.of(label).middle();
            // Twice the spread of 200 random speeds; the steps are finer in phase than random ones.
            let most = 0.01 + 2.0 * (share * (1.0 - share) / count as f64).sqrt();
            assert!((seen - share).abs() < most, "{row} {label}: {seen} {share}");
            mixed += usize::from(share > 0.1 && share < 0.9);
        }
    }
    assert!(mixed >= 4, "{mixed}");
}

/// Half of a frame belongs to the basin; the other half has the local fractions, the same in every frame below 10⁻⁹.
#[test]
fn all_deep_frames_are_alike() {
    let (fates, chart, circle) = edge();
    for depth in [12.0, 30.5, 100.0, 1000.0] {
        let pixels = edge_window(&fates, &chart, &circle, depth, 10).unwrap();
        let inside = pixels.iter().filter(|pixel| pixel.of(2.into()).lower == 1.0).count();
        assert_eq!((pixels.len(), inside), (10, 5));
        for pixel in pixels.iter().filter(|pixel| pixel.of(2.into()).upper < 1.0) {
            let share = pixel.of(1.into());
            assert!((share.middle() - 0.305159).abs() < 1e-2, "{depth}: {share:?}");
        }
    }
    // Above, the speeds themselves are labelled.
    let wide = edge_window(&fates, &chart, &circle, 3.0, 50).unwrap();
    assert!(wide.iter().all(|pixel| pixel.undecided() < 1e-9));
    assert!(wide.iter().any(|pixel| pixel.of(1.into()).lower == 1.0));
    assert!(matches!(
        edge_window(&fates, &chart, &circle, 1e9, 4),
        Err(Error::Asymptotics(hopper_asymptotics::Error::Offset { .. }))
    ));
    assert!(edge_window(&fates, &chart, &circle, f64::NAN, 4).is_err());
    assert!(edge_window(&fates, &chart, &circle, -5.0, 4).is_err());
}
