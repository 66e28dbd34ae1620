//! `nonsmooth`: modes of starts, motions along surfaces, behind limits, and diagrams.

use crate::common::nonsmooth::{File, call};

/// The cells of CSV.
fn cells(csv: &str) -> Vec<Vec<&str>> {
    csv.lines().skip(1).map(|line| line.split(',').collect()).collect()
}

/// A point at which both sides push towards x = 0, at rates 1; y grows by 1 on the right and by 2 on the left.
fn relay(slides: bool) -> File {
    let text = format!(
        "states = ['x', 'y']\nslides = {slides}\n\
         [[mode]]\nname = 'right'\nwhere = 'x'\nrates = {{ x = '-1', y = 1 }}\n\
         [[mode.surface]]\nname = 'leftwards'\nguard = 'x'\ndirection = 'falling'\nto = 'left'\n\
         [[mode]]\nname = 'left'\nwhere = '-x'\nrates = {{ x = '1', y = 2 }}\n\
         [[mode.surface]]\nname = 'rightwards'\nguard = 'x'\ndirection = 'rising'\nto = 'right'\n"
    );
    File::new("relay.toml", &text)
}

#[test]
fn a_run_goes_on_along_a_surface_with_the_mean_of_both_fields() {
    let relay = relay(true);
    for (start, y) in [("x=1", 1.0 + 3.0), ("x=-1", 2.0 + 3.0)] {
        let run = ["run", relay.path(), "--start", start, "--time", "3", "--table", "end", "--csv"];
        let (code, csv, messages) = call(&run);
        assert_eq!(code, 0, "{messages}");
        let end = &cells(&csv)[0];
        let (x, found): (f64, f64) = (end[2].parse().unwrap(), end[3].parse().unwrap());
        assert!(
            end[1].starts_with("along ") && x.abs() < 1e-12 && (found - y).abs() < 1e-9,
            "{csv}"
        );
    }
    let (_, csv, _) = call(&["run", relay.path(), "--start", "x=1", "--time", "3", "--csv"]);
    assert_eq!(cells(&csv)[1][2], "leftwards: sliding");
    // The other questions do not follow such a motion, and say so.
    let section = ["section", relay.path(), "--surface", "leftwards", "--start", "x=1"];
    let (code, _, message) = call(&section);
    assert!(code == 2 && message.contains("slides = true"), "{message}");
}

#[test]
fn without_sliding_a_run_ends_at_the_surface_and_says_how_to_go_on() {
    let relay = self::relay(false);
    let run = ["run", relay.path(), "--start", "x=1", "--time", "3", "--table", "end", "--csv"];
    let (code, csv, _) = call(&run);
    assert!(code == 0 && csv.contains("slides = true"), "{csv}");
}

#[test]
fn a_start_is_in_the_mode_of_its_state() {
    // x' = ±1 away from 0 until a wall at ±2 that ends the run.
    let away = "states = ['x', 'y']\n\
         [[mode]]\nname = 'right'\nwhere = 'x - 1/2'\nrates = { x = 'x', y = '-y' }\n\
         [[mode.surface]]\nname = 'east'\nguard = 'x - 2'\ndirection = 'rising'\nstops = true\n\
         [[mode]]\nname = 'left'\nwhere = '-1/2 - x'\nrates = { x = 'x', y = '-y' }\n\
         [[mode.surface]]\nname = 'west'\nguard = 'x + 2'\ndirection = 'falling'\nstops = true\n";
    let away = File::new("away.toml", away);
    for (start, wall) in [("x=1", "east"), ("x=-1,y=3", "west")] {
        let (code, csv, messages) =
            call(&["run", away.path(), "--start", start, "--time", "9", "--csv"]);
        assert_eq!(code, 0, "{messages}");
        assert_eq!(cells(&csv)[0][2], wall, "{csv}");
    }
    let (code, _, message) = call(&["run", away.path(), "--time", "9"]);
    assert!(code == 2 && message.contains("x = 0, y = 0 is in no mode"), "{message}");
    let basin = ["basin", away.path(), "--window", "x=-1:1,y=-1:1", "--step", "1"];
    let (code, _, message) = call(&basin);
    assert!(code == 2 && message.contains("is in no mode"), "{message}");
}

#[test]
fn a_basin_of_a_model_in_pieces_begins_in_the_mode_of_each_start() {
    // A point falls to 1 on the right, and on the left to a wall that ends the run.
    let pieces = "states = ['x', 'y']\n\
         [[mode]]\nname = 'left'\nwhere = '-x'\nrates = { x = '-4 - x', y = '-y' }\n\
         [[mode.surface]]\nname = 'wall'\nguard = 'x + 3'\ndirection = 'falling'\nstops = true\n\
         [[mode]]\nname = 'right'\nwhere = 'x'\nrates = { x = '1 - x', y = '-y' }\n\
         [[mode.surface]]\nname = 'leftwards'\nguard = 'x'\ndirection = 'falling'\nto = 'left'\n";
    let pieces = File::new("pieces.toml", pieces);
    let basin = ["basin", pieces.path(), "--window", "x=-3:3,y=-1:1", "--step", "2", "--json"];
    let small = ["--cells", "20", "--starts", "4", "--tests", "50", "--pixels", "12", "4"];
    let (code, json, messages) = call(&[&basin[..], &small].concat());
    assert_eq!(code, 0, "{messages}");
    let found: serde_json::Value = serde_json::from_str(&json).unwrap();
    let pixels = |row: usize| found["basins"][row]["pixels"].as_u64();
    assert_eq!((pixels(0), pixels(1), pixels(2)), (Some(24), Some(24), None), "{json}");
    let attractors = found["attractors"].as_array().unwrap();
    assert_eq!((attractors.len(), attractors[0]["mode"].as_str()), (1, Some("right")), "{json}");
    assert!((attractors[0]["x"].as_f64().unwrap() - 1.0).abs() < 1e-9, "{json}");
}

#[test]
fn behind_a_limit_of_bounces_a_ball_rests() {
    let text = "states = ['h', 'v']\n\
         [[mode]]\nname = 'flight'\nrates = { h = 'v', v = '-2' }\nrests = 'ground'\nat_rest = { v = 0 }\n\
         [[mode.surface]]\nname = 'floor'\nguard = 'h'\ndirection = 'falling'\nresets = { h = 0, v = '-v/2' }\n\
         [[mode]]\nname = 'ground'\nrates = { h = 0, v = 0 }\n";
    let ball = File::new("rests.toml", text);
    let run = ["run", ball.path(), "--start", "h=1", "--time", "9", "--csv"];
    let (code, csv, messages) = call(&run);
    assert_eq!(code, 0, "{messages}");
    // A fall takes 1, the flights 1, ½, ¼, …
    let rows = cells(&csv);
    let limit = rows.last().unwrap();
    let (time, error): (f64, f64) = (limit[0].parse().unwrap(), limit[1].parse().unwrap());
    assert!((time - 3.0).abs() <= error && error < 1e-10, "{limit:?}");
    assert_eq!(limit[2..4], ["(limit)", "ground"]);
    // The limit is not lost where nothing is behind it.
    let ball = File::new("ends.toml", &text.replace("rests = 'ground'\nat_rest = { v = 0 }\n", ""));
    let (_, csv, _) = call(&["run", ball.path(), "--start", "h=1", "--time", "9", "--csv"]);
    assert_eq!(cells(&csv).last().unwrap()[2..4], ["(limit)", ""]);
    let text = text.replace("rests = 'ground'\n", "");
    let (code, _, message) = call(&["run", File::new("no_rest.toml", &text).path()]);
    assert!(code == 2 && message.contains("at_rest without rests"), "{message}");
}

#[test]
fn what_came_before_an_error_is_shown() {
    // The rate has no value at x = 0, which is reached.
    let text = "states = ['x']\n[[mode]]\nname = 'm'\nrates = { x = '-1/x' }\n\
         [[mode.surface]]\nname = 'half'\nguard = 'x - 1/2'\n";
    let fall = File::new("fall.toml", text);
    let (code, csv, message) =
        call(&["run", fall.path(), "--start", "x=1", "--time", "9", "--csv"]);
    assert!(code == 1 && message.starts_with("error: "), "{message}");
    assert_eq!(cells(&csv)[0][2], "half");
}

/// The logistic map x ↦ a x (1 − x), once in a unit of time.
fn logistic() -> File {
    let text = "states = ['x']\nparameters = { a = 3 }\n[[mode]]\nname = 'm'\nrates = { x = 0 }\n\
         [[mode.surface]]\nname = 'tick'\nfirst = 1\nperiod = 1\nresets = { x = 'a*x*(1 - x)' }\n";
    File::new("logistic.toml", text)
}

#[test]
fn a_diagram_has_the_periods_of_the_logistic_map() {
    let logistic = logistic();
    let folder = File::new("diagram.svg", "");
    let ask = |more: &[&str]| {
        let all = ["diagram", logistic.path(), "--parameter", "a", "--surface", "tick", "--csv"];
        call(&[&all[..], more].concat())
    };
    // Columns in the middles of quarters: 2.925, 3.175, 3.425 and 3.675.
    let window = ["--from", "2.8", "--to", "3.8", "--columns", "4", "--skip", "2000"];
    let (code, csv, messages) =
        ask(&[&window[..], &["--near", "x=0.3", "--figure", folder.path()]].concat());
    assert_eq!(code, 0, "{messages}");
    let periods: Vec<&str> = cells(&csv).iter().map(|row| row[3]).collect();
    assert_eq!(periods, ["1", "2", "2", ""], "{csv}");
    let fixed: f64 = cells(&csv)[0][2].parse().unwrap();
    assert!((fixed - (1.0 - 1.0 / 2.925)).abs() < 1e-9);
    assert!(std::fs::read_to_string(&folder.0).unwrap().contains("<svg"));
    // Every return that is shown.
    let (_, csv, _) = ask(&[&window[..], &["--near", "x=0.3", "--table", "points"]].concat());
    assert_eq!(cells(&csv).len(), 4 * 20);
    // Two starts, downwards, each from where the one before has ended.
    let down = ["--from", "3.8", "--to", "2.8", "--columns", "4", "--carried"];
    let (_, csv, _) = ask(&[&down[..], &["--near", "x=0.3", "--near", "x=0.6"]].concat());
    let first: Vec<&str> = cells(&csv)[1][..2].to_vec();
    assert_eq!((first, cells(&csv).len()), (vec!["3.675", "2"], 8));
}

#[test]
fn an_orbit_that_fails_has_its_reason_and_is_counted() {
    let logistic = logistic();
    let (code, csv, messages) = call(&[
        "diagram",
        logistic.path(),
        "--parameter",
        "a",
        "--surface",
        "tick",
        "--from",
        "3.3",
        "--to",
        "4.7",
        "--columns",
        "2",
        "--near",
        "x=0.3",
        "--csv",
    ]);
    assert_eq!(code, 0, "{messages}");
    assert!(messages.contains("1 of 2 orbits have no points"), "{messages}");
    assert!(!cells(&csv)[1][4].is_empty(), "{csv}");
}

/// Two rates towards ±1, on both sides of an edge, and a clock.
fn two_sides() -> File {
    let text = "states = ['x', 'v']\nparameters = { edge = 0 }\n\
         [[mode]]\nname = 'right'\nwhere = 'x - edge'\nrates = { x = '1 - x', v = '-v' }\n\
         [[mode.surface]]\nname = 'later'\nguard = 't - 2'\ndirection = 'rising'\n\
         [[mode]]\nname = 'left'\nrates = { x = '-1 - x', v = '-v' }\n\
         [[mode.surface]]\nname = 'later'\nguard = 't - 2'\ndirection = 'rising'\n";
    File::new("two_sides.toml", text)
}

#[test]
fn a_mode_by_place_is_that_of_all_starts_and_of_the_present_parameters() {
    let sides = two_sides();
    let ask = |near: &str, window: &str, more: &[&str]| {
        let own = ["prove-basin", sides.path(), "--surface", "later", "--near", near];
        call(&[&own[..], &["--window", window, "--halvings", "2", "3", "--csv"], more].concat())
    };
    let (code, _, message) = ask("x=1,v=0", "x=-1.5:1.5,v=-1:1", &[]);
    assert!(
        code == 2 && message.contains("not all of these starts are in the mode right"),
        "{message}"
    );
    let (code, csv, message) = ask("x=1,v=0", "x=0.01:1.5,v=-1:1", &[]);
    assert!(code == 0 && csv.contains("to x = 1, v = 0"), "{message}");
    let (code, csv, message) = ask("x=1,v=0", "x=-1.5:1.5,v=-1:1", &["--mode", "right"]);
    assert!(code == 0 && csv.contains("to x = 1, v = 0"), "{message}");
    // A parameter that is given moves the edge.
    let run = ["run", sides.path(), "--start", "x=1", "--time", "1", "--table", "end", "--csv"];
    for (more, mode) in [(&[][..], "right"), (&["--set", "edge=2"], "left")] {
        let (_, csv, _) = call(&[&run[..], more].concat());
        assert_eq!(cells(&csv)[0][1], mode);
    }
}

/// What an attack found: each call was answered by orbits that are none.
#[test]
fn a_diagram_of_what_is_no_orbit_is_refused() {
    // Each return ends in the other mode.
    let toggle = "states = ['x']\nparameters = { k = 1 }\n\
         [[mode]]\nname = 'a'\nrates = { x = 'k - x' }\n\
         [[mode.surface]]\nname = 'tick'\nperiod = 1\nto = 'b'\n\
         [[mode]]\nname = 'b'\nrates = { x = '-k - x' }\n\
         [[mode.surface]]\nname = 'tick'\nperiod = 1\nto = 'a'\n";
    // The clock has a period of the force at one frequency alone.
    let forced = "states = ['x', 'v']\nparameters = { w = 1 }\n\
         [[mode]]\nname = 'm'\nrates = { x = 'v', v = 'cos(w*t) - v - x' }\n\
         [[mode.surface]]\nname = 'tick'\nperiod = '2*pi'\n";
    // The other state comes back to 0 at the first value alone, and from the first start alone.
    let open = "states = ['x', 'y']\nparameters = { eps = 1 }\n\
         [[mode]]\nname = 'm'\nrates = { x = '-x', y = '0' }\n\
         [[mode.surface]]\nname = 'tick'\nperiod = 1\nresets = { y = 'eps*x' }\n";
    let [toggle, forced, open] =
        [toggle, forced, open].map(|text| File::new("attacked.toml", text));
    let tick = ["--surface", "tick", "--returns", "4", "--columns", "3", "--csv"];
    for (model, parameter, window, near, why) in [
        (&toggle, "k", ["0.5", "1.5"], &["x=0.2"][..], "ends in the mode b"),
        (&forced, "w", ["0.75", "2.25"], &["x=0,v=0"], "is no period"),
        (&open, "eps", ["-0.5", "2.5"], &["x=1"], "name it in --near"),
        (&open, "eps", ["0.5", "1.5"], &["x=0", "x=1"], "name it in --near"),
        (&open, "eps", ["0.5", "1.5"], &["z=0"], "there is no such state"),
    ] {
        let near: Vec<&str> = near.iter().flat_map(|near| ["--near", near]).collect();
        let own = ["diagram", model.path(), "--parameter", parameter];
        let ends = ["--from", window[0], "--to", window[1]];
        let (code, _, message) = call(&[&own[..], &ends, &tick, &near].concat());
        assert!(code == 2 && message.contains(why), "{near:?}: {message}");
    }
    let own = ["branch", forced.path(), "--parameter", "w", "--from", "0.8", "--to", "1.2"];
    let near = ["--at", "1", "--surface", "tick", "--near", "x=0,v=1"];
    let (code, _, message) = call(&[&own[..], &near].concat());
    assert!(code == 2 && message.contains("is no period"), "{message}");
}

#[test]
fn a_surface_that_cannot_be_slid_along_says_so() {
    let relay = |direction: &str, more: &str| {
        let text = format!(
            "states = ['x']\nslides = true\n[[mode]]\nname = 'a'\nrates = {{ x = '1' }}\n\
             [[mode.surface]]\nname = 's'\nguard = 'x'\n{direction}to = 'b'\n{more}\
             [[mode]]\nname = 'b'\nrates = {{ x = '-1' }}\n\
             [[mode.surface]]\nname = 's'\nguard = 'x'\ndirection = 'falling'\nto = 'a'\n"
        );
        let file = File::new("relay.toml", &text);
        call(&["run", file.path(), "--start", "x=-1", "--time", "3"])
    };
    assert_eq!(relay("direction = 'rising'\n", "").0, 0);
    let (code, _, message) = relay("", "");
    assert!(code == 2 && message.contains("has no direction; give rising or falling"), "{message}");
    let (code, _, message) = relay("direction = 'rising'\n", "only_where = '2'\n");
    assert!(code == 2 && message.contains("has a condition"), "{message}");
}

#[test]
fn a_run_that_ends_early_says_so_and_names_stand_once() {
    let ball = "states = ['h', 'v']\n[[mode]]\nname = 'm'\nrates = { h = 'v', v = -2 }\n\
         [[mode.surface]]\nname = 'floor'\nguard = 'h'\ndirection = 'falling'\nresets = { h = 0, v = '-v/2' }\n";
    let ball = File::new("early.toml", ball);
    let (code, _, message) = call(&["run", ball.path(), "--start", "h=1", "--time", "9", "--csv"]);
    assert!(code == 0 && message.contains("the run ended at the time 3"), "{message}");
    let (code, _, message) = call(&["run", ball.path(), "--start", "h=1,h=2", "--time", "9"]);
    assert!(code == 2 && message.contains("stands twice"), "{message}");
    // Of a motion that ends, the samples before it are shown.
    let blow = File::new(
        "blow.toml",
        "states = ['x']\n[[mode]]\nname = 'm'\nrates = { x = 'x^2' }\n\
         [[mode.surface]]\nname = 'two'\nguard = 'x - 2'\n",
    );
    let run = ["run", blow.path(), "--start", "x=1", "--time", "2", "--samples", "8"];
    let (code, csv, message) = call(&[&run[..], &["--table", "samples", "--csv"]].concat());
    assert!(
        code == 1 && message.contains("the last event, or the start, was at the time 0.5"),
        "{message}"
    );
    let times: Vec<&str> = cells(&csv).iter().map(|row| row[0]).collect();
    assert_eq!(times, ["0", "0.25", "0.5"], "{csv}");
}

#[test]
fn a_basin_in_a_folder_goes_on_where_it_was_stopped() {
    let wells = "states = ['x', 'v']\nparameters = { edge = 0 }\n[[mode]]\nname = 'm'\n\
         rates = { x = 'x + edge - x^3', v = '-v' }\n";
    let wells = File::new("wells.toml", wells);
    let folder = std::env::temp_dir().join(format!("nonsmooth_basin_{}", std::process::id()));
    let place = folder.to_str().unwrap().to_owned();
    let ask = |more: &[&str]| {
        let own = ["basin", wells.path(), "--window", "x=-1.5:1.5,v=-1:1", "--step", "1", "--csv"];
        let small = ["--cells", "20", "--starts", "2", "--tests", "50", "--pixels", "5000", "2"];
        call(&[&own[..], &small, more].concat())
    };
    let (code, whole, message) = ask(&["--out", &place]);
    assert_eq!(code, 0, "{message}");
    let array = std::fs::read(folder.join("basin.npy")).unwrap();
    assert_eq!(array.len(), 128 + 2 * 10_000);
    // As after a kill: a band and the array are not there.
    let bands: Vec<_> = std::fs::read_dir(folder.join("bands")).unwrap().flatten().collect();
    assert_eq!(bands.len(), 2);
    std::fs::remove_file(bands[0].path()).unwrap();
    std::fs::remove_file(folder.join("basin.npy")).unwrap();
    let (code, again, message) = ask(&["--out", &place]);
    assert_eq!((code, again), (0, whole.clone()), "{message}");
    assert_eq!(std::fs::read(folder.join("basin.npy")).unwrap(), array);
    // Without a folder the labels are the same, and another question is refused there.
    assert_eq!(ask(&[]).1, whole);
    let (code, _, message) = ask(&["--out", &place, "--set", "edge=0.1"]);
    assert!(code != 0 && message.contains("job"), "{message}");
    std::fs::remove_dir_all(&folder).unwrap();
}
