//! Traps and basins that are proved.

use crate::models::map_of;
use example_systems::spring_leg::spring_leg_that_falls;
use hybrid_system::{Equations, Label};
use std::ops::ControlFlow;
use validated_dynamics::{
    Budget, Certificate, Division, EnclosedMap, Enclosure, Error, ProvedBasins, ProvedFate, Reason,
    SectionMap, StartSet, Trap, ValidatedSystem, divided, fixed_point, halves,
};

/// x → 1.5x − 0.5x³ attracts to ±1 and repels from 0. The basin of 1 has the part (0, √3) about it; 1.55 is mapped to 0.46, and no interval about 1
/// that is much larger than 0.55 is mapped into itself.
#[test]
fn a_trap_grows_as_far_as_it_leads_into_itself() {
    let map = map_of(&["x"], &["1.5*x - 0.5*x^3"]);
    let trap = Trap::new(&map, &fixed_point(&map, &[0.9], &[]).unwrap(), 10_000).unwrap();
    assert!(trap.contraction() < 1.0 && trap.contracting() <= trap.size());
    assert!(trap.size() > 0.5 && trap.size() < 0.6, "{}", trap.size());
    assert!(trap.contains(&[Enclosure::new(0.55, 1.45)]));
    assert!(!trap.contains(&[Enclosure::new(-0.1, 0.1)]));
}

#[test]
fn a_trap_of_a_turned_parallelepiped_has_no_state_of_another_fate() {
    // A node in skew directions, whose second multiplier grows with distance.
    let map = map_of(&["x", "y"], &["0.5*x + y^2", "0.2*x + 0.3*y + 3*x^3"]);
    let trap = Trap::new(&map, &fixed_point(&map, &[0.01, 0.01], &[]).unwrap(), 4000).unwrap();
    let orbit = |mut x: f64, mut y: f64| {
        for _ in 0..200 {
            (x, y) = (0.5 * x + y * y, 0.2 * x + 0.3 * y + 3.0 * x * x * x);
        }
        x.abs() + y.abs()
    };
    for corner in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0), (0.3, -1.0)] {
        let size = 0.999 * trap.size();
        let at = |row: usize| {
            let directions = trap.directions();
            trap.centre()[row]
                + size * (directions[(row, 0)] * corner.0 + directions[(row, 1)] * corner.1)
        };
        assert!(orbit(at(0), at(1)) < 1e-9);
    }
    assert!(trap.size() > 0.05);
}

/// The runner that starts below the height of touchdown falls: no trap of the gait may have such a start.
#[test]
fn the_runner_is_attracted_from_heights_above_that_of_touchdown_alone() {
    let system = ValidatedSystem::new(&spring_leg_that_falls()).unwrap();
    let apex = ["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"];
    let chart = system.chart("flight", &["h"], &apex).unwrap();
    let map = SectionMap::new(&system, chart, "apex", 1, &["height"]).unwrap();
    let gait = fixed_point(&map, &[0.94], &[]).unwrap();
    assert!(gait.point[0].contains(0.940_267_144_379_606) && gait.point[0].width() < 1e-10);
    let multiplier = gait.multipliers[0].real().unwrap();
    assert!(multiplier.contains(-0.161_307_631_037) || multiplier.width() < 1e-9);
    let surfaces: Vec<_> =
        gait.image.events.iter().map(|event| event.surface.to_string()).collect();
    assert_eq!(surfaces, ["touchdown", "take-off", "apex"]);
    let trap = Trap::new(&map, &gait, 1000).unwrap();
    // sin 68°.
    let touchdown = 0.927_183_854_566_787;
    assert!(
        trap.size() > 0.008 && trap.size() < 0.940_267_144_379_606 - touchdown,
        "{}",
        trap.size()
    );
    // A fall is a fate of all states of a box.
    let error = map.carry(StartSet::of_box(&[Enclosure::new(0.85, 0.86)])).unwrap_err();
    assert!(error.to_string().contains("ground"), "{error}");
}

#[test]
fn cells_have_the_fates_of_orbits() {
    // Newton's method for x³ = x has three fixed points; here a damped one, which has no poles on the window.
    let map = map_of(&["x"], &["1.5*x - 0.5*x^3"]);
    let trap =
        |guess: f64| Trap::new(&map, &fixed_point(&map, &[guess], &[]).unwrap(), 200).unwrap();
    let window = [Enclosure::new(-1.75, 1.75)];
    let division = Division { first: 3, last: 12, images: 100_000 };
    let basins =
        ProvedBasins::new(&[&map], vec![trap(0.9), trap(-0.9)], &[&window], division).unwrap();
    let mut proved = 0;
    for place in 0..1000 {
        let start = -1.75 + 3.5 * (f64::from(place) + 0.5) / 1000.0;
        let end = (0..500).fold(start, |x, _| 1.5 * x - 0.5 * x * x * x);
        match basins.fate(0, &[start]) {
            Some(ProvedFate::Trap(0)) => assert!((end - 1.0).abs() < 1e-6, "{start}"),
            Some(ProvedFate::Trap(1)) => assert!((end + 1.0).abs() < 1e-6, "{start}"),
            Some(other) => panic!("{other:?}"),
            None => continue,
        }
        proved += 1;
    }
    assert!(proved > 990, "{proved}");
    let [right, left] = [0, 1].map(|trap| basins.share(ProvedFate::Trap(trap)));
    assert!((right - left).abs() < 1e-3 && right + left > 0.99);
    assert_eq!(basins.fate(0, &[2.0]), None);
    assert_eq!(basins.fate(1, &[0.5]), None);
}

#[test]
fn maps_over_parts_of_a_period_prove_the_basins_of_the_whole() {
    let well = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "x - x^3 - v"])
        .rising_text("half", "t - 1")
        .rising_text("end", "t - 2");
    let well = well.mode_text("unused", &["0*t", "0"]);
    let system = ValidatedSystem::new(&well).unwrap();
    let part = |start: &str, surface: &str| {
        let chart = system.chart("flow", &["x", "v"], &["x", "v", start]).unwrap();
        SectionMap::new(&system, chart, surface, 1, &["x", "v"]).unwrap()
    };
    let (first, second, whole) = (part("0", "half"), part("1", "end"), part("0", "end"));
    let trap =
        |x: f64| Trap::new(&whole, &fixed_point(&whole, &[x, 0.0], &[]).unwrap(), 1000).unwrap();
    let window = [Enclosure::new(-2.0, 2.0), Enclosure::new(-2.0, 2.0)];
    let division = Division { first: 4, last: 6, images: 6000 };
    let maps = [&first, &second];
    let basins = ProvedBasins::new(
        &maps,
        vec![trap(1.1), trap(-1.1)],
        &[&window[..], &window[..]],
        division,
    )
    .unwrap();
    assert_eq!(basins.fate(0, &[1.03, 0.02]), Some(ProvedFate::Trap(0)));
    assert_eq!(basins.fate(0, &[-1.03, 0.02]), Some(ProvedFate::Trap(1)));
    assert_eq!(basins.fate(0, &[0.0, 0.0]), None);
    assert!(basins.share(ProvedFate::Trap(0)) > 0.1);
}

#[test]
fn boxes_are_divided_within_a_budget() {
    let map = map_of(&["x"], &["sqrt(x)"]);
    let domain = [Enclosure::new(0.0, 1.0)];
    let within = |boxes, divisions| {
        let budget = Budget { boxes, divisions };
        divided(&domain, budget, halves, |part| map.image(part).map(Some)).unwrap()
    };
    let deep = within(1000, 20);
    assert_eq!((deep.decided.len(), deep.open.len()), (20, 1));
    assert!(deep.open[0].1.is_some());
    let short = within(5, 20);
    let decided = short.decided.iter().map(|(part, _)| part[0].width());
    let open = short.open.iter().map(|(part, _)| part[0].width());
    assert!((decided.chain(open).sum::<f64>() - 1.0).abs() < 1e-12);
    assert!(short.open.iter().any(|(_, why)| why.is_none()));
    let wrong: Result<_, Error> =
        divided(&domain, Budget { boxes: 9, divisions: 9 }, halves, |_| {
            Err::<Option<()>, _>(Error::Argument { what: "x".into(), reason: "y".into() })
        });
    assert!(wrong.is_err());
}

#[test]
fn wrong_questions_are_refused() {
    let map = map_of(&["x"], &["x/2"]);
    let window = [Enclosure::new(0.0, 1.0)];
    let division = Division { first: 2, last: 4, images: 100 };
    let of = |windows: &[&[Enclosure]], division| {
        ProvedBasins::new(&[&map], vec![], windows, division).is_err()
    };
    assert!(of(&[], division));
    assert!(of(&[&[Enclosure::new(0.0, 0.0)]], division));
    assert!(of(&[&[Enclosure::WHOLE]], division));
    assert!(of(&[&window], Division { first: 5, ..division }));
    assert!(of(&[&window], Division { last: 40, ..division }));
    assert!(!of(&[&window], division));
}

#[test]
fn basins_show_progress_within_a_round_and_keep_what_is_proved_when_they_end() {
    let map = map_of(&["x", "y"], &["1.5*x - 0.5*x^3", "y/2"]);
    let trap = Trap::new(&map, &fixed_point(&map, &[0.9, 0.0], &[]).unwrap(), 200).unwrap();
    let window = [Enclosure::new(-1.5, 1.5), Enclosure::new(-1.5, 1.5)];
    // 16 384 cells in the first round.
    let division = Division { first: 7, last: 8, images: 100_000 };
    let mut shown = Vec::new();
    let basins =
        ProvedBasins::watched(&[&map], vec![trap], &[&window], division, &mut |progress| {
            shown.push(progress.images);
            if shown.len() < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        })
        .unwrap();
    assert_eq!((shown.len(), shown[2]), (3, basins.images));
    assert!(shown[0] > 0 && shown[2] < 16_384, "{shown:?}");
    let [own, other] = [0, 1].map(|trap| basins.share(ProvedFate::Trap(trap)));
    assert!(own > 0.0 && other == 0.0);
    let cells = basins.cells();
    assert!(!cells.is_empty() && cells.iter().all(|cell| cell.window == 0));
}

/// A ramp of 0.3 a unit of time to a wall that ends the execution: cells beside the wall stop, the others later.
#[test]
fn cells_that_stop_later_have_their_own_images_in_a_certificate() {
    let ramp = Equations::new(&["x"], &[])
        .mode_text("flow", &["0.3 + 0*x"])
        .rising_text("later", "t - 1")
        .rising_text("wall", "x - 1")
        .stops();
    let system = ValidatedSystem::new(&ramp).unwrap();
    let chart = system.chart("flow", &["x"], &["x", "0"]).unwrap();
    let map = SectionMap::new(&system, chart, "later", 1, &["x"]).unwrap().recorded();
    let window = [Enclosure::new(-1.0, 0.95)];
    let division = Division { first: 5, last: 6, images: 1000 };
    let basins = ProvedBasins::new(&[&map], vec![], &[&window], division).unwrap();
    let mut certificate = Certificate::new("ramp");
    certificate.basins(&map, &basins, &[]).unwrap();
    let text = certificate.text();
    let cells: Vec<&str> = text.lines().filter(|line| line.contains("\"cell\"")).collect();
    let led = cells.iter().filter(|line| !line.contains("\"image\":null")).count();
    assert!(led > 20 && led < cells.len(), "{led} of {}", cells.len());
}

/// From a the model goes to b, and never back: a map that ends in b has no orbits of its own.
#[test]
fn a_map_that_ends_in_another_mode_or_at_a_stop_is_not_iterated() {
    let relay = Equations::new(&["x"], &[])
        .mode_text("a", &["1 - x"])
        .rising_text("switch", "x - 0.5")
        .to("b")
        .mode_text("b", &["-x"])
        .falling_text("back", "x - 0.2");
    let system = ValidatedSystem::new(&relay).unwrap();
    let chart = system.chart("a", &["x"], &["x"]).unwrap();
    let map = SectionMap::new(&system, chart, "back", 1, &["x"]).unwrap();
    let error = fixed_point(&map, &[0.2], &[]).unwrap_err().to_string();
    assert!(error.contains("ends in the mode b") && error.contains("in the mode a"), "{error}");
    let fall = Equations::new(&["x"], &[])
        .mode_text("fall", &["-1 + 0*x"])
        .falling_text("floor", "x")
        .stops();
    let system = ValidatedSystem::new(&fall).unwrap();
    let chart = system.chart("fall", &["x"], &["x"]).unwrap();
    let map = SectionMap::new(&system, chart, "floor", 1, &["x + 1"]).unwrap();
    let error = fixed_point(&map, &[0.9], &[]).unwrap_err().to_string();
    assert!(error.contains("ends the execution"), "{error}");
}

/// Of multiple eigenvalues the eigenvectors are parallel, or any two.
#[test]
fn traps_of_multiple_multipliers_are_found() {
    for formulas in [
        ["x/2", "y/2"],
        ["x/2 + y", "y/2"],
        ["x/2 + x*y", "y/2 - x^2"],
        ["x/3 + 2*y + x*y", "y/3 - y^3"],
    ] {
        let map = map_of(&["x", "y"], &formulas);
        let trap = Trap::new(&map, &fixed_point(&map, &[0.01, 0.01], &[]).unwrap(), 500).unwrap();
        assert!(trap.contraction() < 1.0 && trap.size() > 1e-3, "{formulas:?} {trap:?}");
    }
}

#[test]
fn sets_that_points_come_to() {
    // From |x| < 1 to 0, from |x| > 1 away.
    let cube = map_of(&["x"], &["x^3"]);
    let cube =
        cube.with_set("near", &["0.25 - x^2"]).unwrap().with_set("far", &["x^2 - 4"]).unwrap();
    let window = [Enclosure::new(-3.0, 3.0)];
    let kept = cube.keeps("near", &window, Budget { boxes: 100, divisions: 10 }).unwrap();
    assert!(!kept.is_empty());
    // The map leads the other set out of the window.
    let left = cube.keeps("far", &window, Budget { boxes: 100, divisions: 10 }).unwrap_err();
    assert!(matches!(left.undecided().unwrap().reason, Reason::NotInside { .. }), "{left}");
    let division = Division { first: 4, last: 14, images: 2000 };
    let basins = ProvedBasins::new(&[&cube], Vec::new(), &[&window], division).unwrap();
    let share = |name: &str| basins.share(ProvedFate::Stopped(Label::new(name).unwrap()));
    assert!((0.33..=1.0 / 3.0).contains(&share("near")), "{}", share("near"));
    assert!((0.66..=2.0 / 3.0).contains(&share("far")), "{}", share("far"));
    for (x, end) in [(0.99, "near"), (-0.99, "near"), (1.01, "far"), (-1.01, "far")] {
        assert_eq!(basins.fate(0, &[x]), Some(ProvedFate::Stopped(Label::new(end).unwrap())));
    }
    assert!(cube.clone().with_set("near", &["x"]).is_err());
    assert!(cube.clone().with_set("third", &[]).is_err());
    assert!(cube.clone().with_set("third", &["y"]).is_err());
    assert!(cube.clone().with_set("third", &["t"]).is_err());
    assert!(cube.keeps("third", &window, Budget { boxes: 100, divisions: 10 }).is_err());
}
