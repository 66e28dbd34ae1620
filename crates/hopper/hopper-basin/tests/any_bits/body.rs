// Gives six arbitrary words to every public function of passive-hopper, hopper-asymptotics and hopper-basin, and
// checks: no function panics or hangs, and f(α) ≤ α.

use basin_of_attraction::{Grid, Interval, Refinement};
use hopper_asymptotics::{
    Coefficients, Decay, Form, LeftExpansion, RightExpansion, trap_length_series, fixed_point_series, small_hop_loss,
};
use hopper_basin::{
    CircleLimits, EdgeChart, Fates, HopperFate, PhaseBasins, Trap, basin_columns, basin_levels, basin_raster, branches, crisis, grounding, hopper_basins, immediate_basin,
    basin_fractions, first_humps, upper_crisis_bracket,
};
use passive_hopper::{
    FixedPointSpeed, Flight, HalfFlight, HopperState, LiftOffMap, LocalFlight, MassRatio, PhysicalHopper, alpha_star,
    contact_flow, contact_time, energy, index_below, landing_loss, lift_off_energy, printed_image,
};

/// At larger mass ratios a hop may have a million sudden lift-offs, so that only some of them are tried.
const HEAVIEST: f64 = 1e4;

/// Slow functions are called for one in so many inputs.
const SELDOM: u64 = 256;

/// Calls all functions with one input.
pub fn try_all(words: [u64; 6]) {
    let [a, b, c, d, e, _] = words.map(f64::from_bits);
    let n = words[5];
    functions_of_numbers(n, [a, b, c, d, e]);
    let _ = PhysicalHopper::new(a, b, c, d).map(|hopper| {
        hopper.to_dimensionless(&hopper.to_physical(&HopperState::lift_off(e)))
    });
    let Ok(ratio) = MassRatio::new(a) else { return };
    assert!(MassRatio::new(ratio.inverted().value()).is_ok());
    let state = HopperState {
        upper_position: b,
        upper_velocity: c,
        lower_position: d,
        lower_velocity: e,
    };
    let _ = (contact_flow(ratio, &state, e), energy(ratio, &state), landing_loss(ratio, e));
    let _ = (contact_time(ratio, b, c), lift_off_energy(ratio, b, c));
    for form in [Form::Printed, Form::Corrected] {
        let _ = Coefficients::new(n, ratio, form).map(|local| (local.trap_length(), local.image(b)));
    }
    let _ = (Trap::new(n, ratio).map(|trap| trap.contains(b)), Trap::new(n % 100, ratio));
    asymptotics(n, ratio, [b, c, d]);
    asymptotics(n % 1000, ratio, [b, c, d]);
    let flight = Flight::new(ratio, &state);
    let _ = (flight.stretch(e), flight.height(e), flight.state(e));
    let seldom = n.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32 & (SELDOM - 1) == 0;
    if seldom && (1e-3..1e3).contains(&a) {
        basins(ratio, n, [b, c, d, e]);
    }
    if a < HEAVIEST || seldom {
        hops(ratio, b, n % 2000, c);
    }
}

fn functions_of_numbers(n: u64, values: [f64; 5]) {
    let star = FixedPointSpeed::new(n);
    assert!(star.value().is_finite());
    let _ = first_humps(n);
    let _ = (crisis(n), grounding(n), crisis(n % 1000), grounding(n % 1000));
    for value in values {
        let _ = (star.compare(value), star.offset_of(value));
        if let Ok(index) = index_below(value) {
            assert!(alpha_star(index) <= value || index == 0);
        }
        let half = HalfFlight::at(value);
        let _ = (half.w(), half.start_speed(values[0]), half.closing_speed(values[0]), half.start_speed_slope(values[0]));
    }
}

/// Every value and its error bound are finite.
fn asymptotics(n: u64, ratio: MassRatio, [b, c, d]: [f64; 3]) {
    let mut values = vec![fixed_point_series(n).ok(), trap_length_series(n, ratio).ok(), small_hop_loss(ratio, b).ok()];
    if let (Ok(right), Ok(left), Ok(law)) = (RightExpansion::new(n, ratio), LeftExpansion::new(n, ratio), Decay::new(n, ratio)) {
        for delta in [b, c, d] {
            values.extend([right.displacement(delta).ok(), right.loss(delta).ok()]);
            values.extend([left.displacement(delta).ok(), left.loss(delta).ok()]);
            values.extend([law.hops(delta, c).ok(), law.offset_after(delta, c).ok(), law.constant(delta).ok()]);
        }
    }
    for found in values.into_iter().flatten() {
        assert!(found.value.is_finite() && found.error >= 0.0, "{found:?} n = {n} {ratio:?} {b} {c} {d}");
    }
    let flight = LocalFlight::new(n);
    for t in [b, c, d] {
        let _ = (flight.delta(t), flight.closing_speed(t), flight.w(t), flight.time_shift(t));
    }
}

fn basins(ratio: MassRatio, n: u64, [b, c, d, e]: [f64; 4]) {
    let (from, to, few) = (n % 3, n % 5, (n % 40) as usize);
    let _ = basin_fractions(ratio, from, to, few);
    if let (Ok(x), Ok(y)) = (Interval::new(b, c), Interval::new(d, e))
        && y.right < 1e3
        && x.left > 1e-3
        && x.right < 1e3
    {
        let grid = Grid { x, y, columns: few % 5, rows: few % 7 };
        let _ = basin_columns(&grid, few % 3..few % 4);
        let _ = basin_raster(grid, |_| std::ops::ControlFlow::Continue(()));
    }
    let Ok(fates) = Fates::new(ratio) else { return };
    let some: Vec<f64> = [b, c, d, e].into_iter().cycle().zip(0..few).map(|(x, k)| x + k as f64).collect();
    if let Ok(labels) = fates.labels(&some) {
        assert_eq!(labels.len(), few);
    }
    let _ = branches(&fates, from, to, few);
    let _ = basin_levels(&fates, from, to, 2, few);
    let refinement = Refinement { shortest: b.abs().max(1e-2), undecided: c, levels: few, intervals: 1000 };
    if let Ok(found) = hopper_basins(&fates, from, to, few, refinement) {
        let (all, resolved) = (found.basins.basin_length_of(|_| true), found.basins.resolved_length_of(|_| true));
        assert!(all.lower <= resolved && resolved <= all.upper, "{all:?} {resolved}");
    }
    let limits = CircleLimits { refinement, window_samples: few, fate_samples: few };
    if let Ok(circle) = PhaseBasins::new(&fates, n % 12, limits) {
        let fractions = circle.fractions();
        let sum: f64 = fractions.labels().map(|label| fractions.of(label).lower).sum();
        assert!(sum <= 1.0 + 1e-12, "{fractions:?}");
        let _ = (circle.label_at(b, c), circle.label_at(d, 0.0), circle.phase_of(e), circle.share(b, c));
        if let Ok(chart) = EdgeChart::onto(&fates, n % 12, d) {
            let _ = (chart.label(&circle, b.into()), chart.share(&circle, c.into(), e.into()));
        }
    }
    let _ = EdgeChart::near(&fates, d);
    let _ = (immediate_basin(fates.map(), from, b.abs().max(1e-2)), upper_crisis_bracket(from, b.abs().max(0.1), 20.0));
}

fn hops(ratio: MassRatio, alpha: f64, n: u64, delta: f64) {
    let map = LiftOffMap::new(ratio);
    let mut many: Vec<_> = (0..20).map(|k| Some(alpha + delta * f64::from(k))).collect();
    let _ = map.images(&mut many);
    let _ = LiftOffMap::images_of_pairs(&mut [(&map, Some(delta)); 17]);
    if let Ok(hop) = map.hop(alpha) {
        assert!(hop.next_speed_squared <= alpha * alpha, "{hop:?}");
        assert!(hop.next.is_none_or(|next| next > 0.0 && next <= alpha), "{hop:?}");
        assert!(hop.loss.is_none_or(|loss| loss >= 0.0), "{hop:?}");
        assert_eq!(hop.next.is_some(), hop.loss.is_some());
        let _ = map.slopes(alpha);
        let _ = printed_image(ratio, alpha);
    }
    if let Ok(hop) = map.hop_near_fixed_point(n, delta) {
        assert!(hop.next.is_none_or(|next| next <= delta), "{hop:?} from {delta:e}");
    }
    if alpha < 1e3 {
        let fate = Fates::new(ratio).and_then(|fates| fates.fate_within(alpha, 1000));
        // Orbits descend: the fixed point lies below the start.
        if let Ok((HopperFate::Incessant { n }, _)) = fate {
            assert!(alpha_star(n) <= alpha, "{n} from {alpha}");
        }
    }
}
