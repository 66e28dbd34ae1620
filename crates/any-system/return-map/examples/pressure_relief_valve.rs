//! The bifurcation diagram of a pressure relief valve, as numbers. For each flow rate it has the displacements at the
//! turning points after a transient.
//!
//! Run with `cargo run --release -p return-map --example pressure_relief_valve`; `cargo xtask model-figures`
//! draws it.

#![allow(clippy::print_stdout)] // a program

use example_systems::valve::valve_equations;
use return_map::{EquationReturns, Error, OrbitLength, Seeds, bifurcation_diagram};
use std::ops::ControlFlow::Continue;

fn main() -> Result<(), Error> {
    let section = ("open", "turning point");
    let valve = valve_equations();
    let returns = EquationReturns::new(&valve, "flow", section, &["displacement", "pressure"])?;
    let rates = [0.5, 1.0, 2.0, 4.0, 5.0, 6.0, 7.0, 7.5, 8.0, 9.0];
    let seeds = [vec![1.0, 10.0]];
    let length = OrbitLength { transient: 500, keep: 64 };
    println!("{:>4}  displacements at the last turning points", "q");
    for column in
        bifurcation_diagram(&returns, &rates, (&seeds, Seeds::Fresh), length, |_| Continue(()))
    {
        let mut found = Vec::new();
        for orbit in column.orbits {
            found.extend(orbit?.iter().map(|point| point[0]));
        }
        found.sort_by(f64::total_cmp);
        found.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
        let shown: Vec<String> = found.iter().take(8).map(|y| format!("{y:.6}")).collect();
        let more = if found.len() > 8 { " …" } else { "" };
        println!("{:>4}  {}{more}", column.parameter, shown.join(" "));
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use example_systems::valve::{Mode, Valve, turning_points};
    use hybrid_system::{ArcEnd, Execution, HybridSystem};
    use nalgebra::Vector3;

    /// At large flow rates the disc comes to rest where spring and pressure balance: y₃ = y₁ + δ, q = y₁ √y₃.
    #[test]
    fn the_disc_comes_to_rest_at_large_flow_rates() {
        for flow_rate in [9.0, 9.9] {
            let found = turning_points(flow_rate, 1500, 1).unwrap()[0];
            assert!((found * (found + 10.0).sqrt() - flow_rate).abs() < 1e-6, "{found}");
        }
    }

    /// On no arc does the disc pass through its seat.
    #[test]
    fn the_disc_never_passes_its_seat() {
        for flow_rate in [0.3, 1.0, 3.0, 6.0] {
            let valve = Valve { flow_rate };
            let start = Vector3::new(0.2, 0.0, 0.0);
            for arc in
                Execution::new(&valve, Mode::Open, start, hybrid_system::Limits::new(30.0, 2000))
            {
                let arc = arc.unwrap();
                if arc.duration == 0.0 || arc.mode == Mode::Closed {
                    continue;
                }
                for k in 0..=10 {
                    let state =
                        valve.flow(arc.mode, &arc.start, arc.duration * f64::from(k) / 10.0);
                    assert!(state[0] > -1e-8, "q = {flow_rate}: {state}");
                }
            }
        }
    }

    /// Without pressure at the start the impacts end in a Zeno limit. The disc rests on its seat until the pressure
    /// equals the load.
    #[test]
    fn the_disc_rests_and_is_released() {
        let valve = Valve { flow_rate: 0.2 };
        let start = Vector3::new(0.2, 0.0, 0.0);
        let limits = hybrid_system::Limits::new(200.0, 100_000);
        let arcs: Vec<_> =
            Execution::new(&valve, Mode::Open, start, limits).collect::<Result<_, _>>().unwrap();
        let rests = arcs.iter().filter(|arc| arc.mode == Mode::Closed).count();
        let ends = arcs.iter().filter(|arc| matches!(arc.end, ArcEnd::Zeno { .. })).count();
        assert!(rests > 0 && ends == rests, "{rests} {ends}");
        for pair in arcs.windows(2).filter(|pair| pair[0].mode == Mode::Closed) {
            assert_eq!((pair[1].mode, pair[1].start), (Mode::Open, Vector3::new(0.0, 0.0, 10.0)));
        }
    }

    /// At q = 2 the motion is periodic, with one turning point a period.
    #[test]
    fn one_turning_point_a_period() {
        let found = turning_points(2.0, 300, 8).unwrap();
        assert!(found.windows(2).all(|pair| (pair[0] - pair[1]).abs() < 1e-8), "{found:?}");
        assert!((found[0] - 1.434_55).abs() < 1e-4, "{}", found[0]);
    }
}
