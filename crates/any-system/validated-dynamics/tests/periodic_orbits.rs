//! Periodic orbits that exist, of models without closed forms.

use hybrid_system::Equations;
use std::time::Instant;
use validated_dynamics::{SectionMap, ValidatedSystem, fixed_point};

fn rossler() -> Equations {
    Equations::new(&["x", "y", "z"], &[("a", "0.2"), ("b", "0.2"), ("c", "5.7")])
        .mode_text("flow", &["-y - z", "x + a*y", "b + z*(x - c)"])
        .rising_text("section", "x")
}

#[test]
fn rossler_has_the_orbit_of_period_one() {
    let system = ValidatedSystem::new(&rossler()).unwrap();
    let chart = system.chart("flow", &["y", "z"], &["0", "y", "z"]).unwrap();
    let map = SectionMap::new(&system, chart, "section", 1, &["y", "z"]).unwrap();
    let begin = Instant::now();
    let orbit = fixed_point(&map, &[-8.38, 0.0296], &[]).unwrap();
    println!("{:?} {:?}", begin.elapsed(), orbit.point);
    println!("{:?}", orbit.unique_in);
    println!("{:?}", orbit.multipliers);
    assert!(orbit.point[0].contains(-8.380_941_742_829_8));
    assert!(orbit.point[0].width() < 1e-12 && orbit.point[1].width() < 1e-12);
    assert!(orbit.is_saddle());
}
