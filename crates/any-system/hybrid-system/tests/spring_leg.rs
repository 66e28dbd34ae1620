//! A leg that takes off below the height of its touchdown: which of two kinds of guards is its touchdown?

use hybrid_system::*;

/// A point mass on a spring leg of 1 m (80 kg, 20 kN/m, angle of attack 68°), with the energy of 5 m/s at a height
/// of 1 m. From the apex of its periodic run the body takes off below the height of its touchdown, and rises.
#[test]
fn a_leg_that_takes_off_below_its_touchdown_says_which_guard_it_means() {
    /// The periodic run has its apex here, and a multiplier of −0.161: the next apex is as high within a sixth of
    /// the error.
    const APEX: f64 = 0.940_267;
    let (mass, gravity, stiffness, angle) = (80.0, 9.81, 20_000.0, 68f64.to_radians());
    let touchdown = angle.sin();
    let flight = |x: &State<4>| [x[2], x[3], 0.0, -gravity];
    let stance = move |x: &State<4>| {
        let length = x[0].hypot(x[1]);
        let pull = stiffness / mass * (1.0 / length - 1.0);
        [x[2], x[3], pull * x[0], pull * x[1] - gravity]
    };
    let leg = |guard: Guard<&'static str>| {
        Model::integrated(move |stands, x: &State<4>| if stands { stance(x) } else { flight(x) })
            .tolerance(1e-12)
            .guard(
                false,
                guard,
                move |x| x[1] - touchdown,
                move |x| (true, [-angle.cos(), x[1], x[2], x[3]]),
            )
            .guard(
                true,
                Guard::rising("take-off").crossing(),
                |x| x[0].hypot(x[1]) - 1.0,
                |x| (false, *x),
            )
            .observer(Guard::falling("apex"), |x| x[3])
    };
    let speed = (25.0 + 2.0 * gravity * (1.0 - APEX)).sqrt();
    let start = [0.0, APEX, speed, 0.0];
    let run = |guard| {
        let leg = leg(guard);
        let arcs = leg.run(false, start, 1.2).collect::<Result<Vec<_>, Error>>();
        arcs.map(|arcs| {
            let apex =
                |event: &&Event<bool, &str, State<4>>| event.surface == "apex" && event.time > 0.0;
            arcs.iter().filter_map(Arc::event).find(apex).map(|event| event.before[1])
        })
    };
    let hops = run(Guard::falling("touchdown").crossing()).unwrap().unwrap();
    assert!((hops - APEX).abs() < 1e-6, "{hops}");
    let unsaid = run(Guard::falling("touchdown")).unwrap_err();
    assert!(matches!(unsaid, Error::LandsBeyond(_)), "{unsaid}");
    assert!(run(Guard::falling("touchdown").contact()).is_ok());
}
