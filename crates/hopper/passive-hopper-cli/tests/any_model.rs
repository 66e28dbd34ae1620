//! `nonsmooth`: files that are models, and those that are none.

use crate::common::nonsmooth::{File, call, model};

#[test]
fn the_same_model_as_toml_as_json_and_as_equations() {
    let toml = call(&["run", &model("thermostat.toml"), "--json"]);
    let json = File::new(
        "thermostat.json",
        r#"{"states": ["room"], "parameters": {"outside": 10, "heater": 20},
            "mode": [{"name": "on", "rates": {"room": "outside + heater - room"},
                      "surface": [{"name": "warm", "guard": "room - 21", "direction": "rising", "to": "off"}]},
                     {"name": "off", "rates": {"room": "outside - room"},
                      "surface": [{"name": "cold", "guard": "room - 19", "direction": "falling", "to": "on"}]}],
            "start": {"state": {"room": 15}, "time": 2}}"#,
    );
    assert_eq!(toml.0, 0, "{}", toml.2);
    assert_eq!(call(&["run", json.path(), "--json"]).1, toml.1);
    let equations =
        hybrid_system::Equations::new(&["room"], &[("outside", "10"), ("heater", "20")])
            .mode_text("on", &["outside + heater - room"])
            .rising_text("warm", "room - 21")
            .to("off")
            .mode_text("off", &["outside - room"])
            .falling_text("cold", "room - 19")
            .to("on");
    let file = File::new("equations.json", &equations.to_json().unwrap());
    assert_eq!(
        call(&["run", file.path(), "--start", "room=15", "--time", "2", "--json"]).1,
        toml.1
    );
}

#[test]
fn the_bounces_of_a_ball_are_those_of_its_formula() {
    let (code, csv, _) = call(&["run", &model("ball.toml"), "--csv"]);
    assert_eq!(code, 0);
    let mut time = (2.0f64 / 9.81).sqrt();
    let mut flight = 2.0 * 0.8 * time;
    for line in csv.lines().skip(1) {
        let found: f64 = line.split(',').next().unwrap().parse().unwrap();
        assert!((found - time).abs() < 1e-13, "{line}");
        time += flight;
        flight *= 0.8;
    }
    // Behind their limit there is nothing, and the end says so.
    let (code, end, _) = call(&["run", &model("ball.toml"), "--time", "9", "--table", "end"]);
    assert!(code == 0 && end.contains("(Zeno)"), "{end}");
}

#[test]
fn a_proof_holds_what_a_run_finds() {
    let certificate = File::new("rossler.jsonl", "");
    let rossler = model("rossler.toml");
    let proof = ["prove", &rossler, "--surface", "section", "--near", "y=-8.4", "z=0.03", "--csv"];
    let (code, csv, messages) =
        call(&[&proof[..], &["--certificate", certificate.path()]].concat());
    assert_eq!(code, 0, "{messages}");
    let numbers: Vec<f64> =
        csv.lines().nth(1).unwrap().split(',').skip(1).map(|x| x.parse().unwrap()).collect();
    assert!(numbers[0] < numbers[1] && numbers[1] - numbers[0] < 1e-11);
    assert!(numbers[0] < -8.38094174282988 && -8.38094174282988 < numbers[1], "{csv}");
    assert!(std::fs::read_to_string(&certificate.0).unwrap().contains("fixed-point"));
    // Damped and forced: the orbit attracts, and a cube about it, too.
    let forced = File::new(
        "forced.toml",
        "states = ['x', 'v']\n[[mode]]\nname = 'free'\nrates = { x = 'v', v = 'cos(t) - v - 2*x' }\n\
         [[mode.surface]]\nname = 'period'\nguard = 't - 2*pi'\ndirection = 'rising'\n",
    );
    let proof =
        ["prove", forced.path(), "--surface", "period", "--near", "x=0.5", "v=0.5", "--json"];
    let (code, json, messages) = call(&proof);
    assert_eq!(code, 0, "{messages}");
    let found: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(found["orbit"][0]["kind"], "attracting");
    assert!(found["orbit"][0]["trap"].as_f64().unwrap() > 0.1, "{json}");
}

#[test]
fn basins_are_proved_and_a_point_that_does_not_attract_is_refused() {
    let well = model("well.toml");
    let (certificate, picture) = (File::new("well.jsonl", ""), File::new("well.svg", ""));
    let ask = |near: &[&str], more: &[&str]| {
        let window = ["--window", "x=-1.5:1.5", "v=-1:1", "--halvings", "3", "4", "--csv"];
        call(&[&["prove-basin", &well, "--surface", "later"], near, &window, more].concat())
    };
    let files = ["--certificate", certificate.path(), "--figure", picture.path()];
    let (code, output, messages) = ask(&["--near", "x=1,v=0", "--near", "v=0,x=-1"], &files);
    assert_eq!(code, 0, "{messages}");
    let shares: Vec<f64> = output
        .lines()
        .skip(1)
        .map(|row| row.rsplit(',').nth(1).unwrap().parse().unwrap())
        .collect();
    // Mirrored, so that neither side can have more than a half.
    assert!(
        shares.len() == 2 && shares.iter().all(|share| (0.05..0.5).contains(share)),
        "{output}"
    );
    let text = std::fs::read_to_string(certificate.path()).unwrap();
    assert!(
        text.starts_with("{\"format\":\"hybrid system certificate\"")
            && text.contains("\"kind\":\"basins\"")
    );
    assert!(std::fs::read_to_string(picture.path()).unwrap().contains("undecided"));
    for (near, why) in [
        (&["--near", "x=0,v=0"][..], "does not attract"),
        (&["--near", "x=1"], "v is missing"),
        (&["--near", "x=1,v=0,w=0"], "this is none of x, v"),
        (&["--near", "x"], "such as x=1"),
    ] {
        let (code, output, messages) = ask(near, &[]);
        assert!(code > 0 && output.is_empty() && messages.contains(why), "{near:?}: {messages}");
    }
}

/// A model of x and v with these rates and one more surface.
fn pair(name: &str, rates: [&str; 2], surface: &str) -> File {
    let [x, v] = rates;
    let text = format!(
        "states = [\"x\", \"v\"]\n[[mode]]\nname = \"m\"\nrates = {{ x = \"{x}\", v = \"{v}\" }}\n{surface}\n"
    );
    File::new(name, &text)
}

/// Maps whose iterates are not the flow: what is proved of them would be false of the model.
#[test]
fn maps_that_do_not_go_on_as_the_flow_does_are_refused() {
    let tick = |guard: &str| {
        format!("[[mode.surface]]\nname = \"tick\"\nguard = \"{guard}\"\ndirection = \"rising\"")
    };
    let third = pair("third.toml", ["x*(v - 1)", "1"], &tick("t - 1"));
    let saddle = pair("saddle.toml", ["x", "-v"], &tick("t - 1"));
    let half = pair("half.toml", ["v", "-x - v + sin(t)"], &tick("t - pi"));
    let whole = pair("whole.toml", ["v", "-x - v + sin(t)"], &tick("t - 2*pi"));
    let press = "\n[[mode.surface]]\nname = \"press\"\nguard = \"x - 2 + t\"\ndirection = \"rising\"\nstops = true";
    let pressed = pair("pressed.toml", ["-x", "-v"], &(tick("t - 1") + press));
    let window = ["--window", "x=-1:1", "v=-1:1", "--halvings", "2", "3"];
    let calls: [(&File, Vec<&str>, &str); 8] = [
        (&third, vec!["prove-basin", "--near", "x=0", "--window", "x=-1:1"], "v is in"),
        (&third, vec!["prove", "--near", "x=0"], "v is in"),
        (&saddle, vec!["prove", "--near", "v=0", "--on", "x=v"], "x is in"),
        (
            &saddle,
            [&["prove-basin", "--near", "x=0,v=0", "--read", "x/9", "v"], &window[..]].concat(),
            "x is in",
        ),
        (&half, [&["prove-basin", "--near", "x=0,v=0"], &window[..]].concat(), "no period"),
        (
            &whole,
            [&["prove-basin", "--near", "x=0,v=0", "--on", "t=3"], &window[..]].concat(),
            "no period",
        ),
        (
            &whole,
            [&["prove-basin", "--near", "x=0,v=0", "--on", "t=x"], &window[..]].concat(),
            "from point to",
        ),
        (
            &pressed,
            [&["prove-basin", "--near", "x=0,v=0"], &window[..]].concat(),
            "the surface press",
        ),
    ];
    for (file, arguments, why) in calls {
        let (command, rest) = arguments.split_first().unwrap();
        let (code, output, messages) =
            call(&[&[*command, file.path(), "--surface", "tick"], rest].concat());
        assert!(code == 2 && output.is_empty(), "{arguments:?}: {output}");
        assert!(
            messages.contains(why) && messages.lines().count() == 1,
            "{arguments:?}: {messages}"
        );
    }
    // A whole period is one, and a kick must fit the step.
    let (code, output, messages) = call(
        &[
            &["prove-basin", whole.path(), "--surface", "tick", "--near", "x=-0.5,v=-0.5", "--csv"],
            &window[..],
        ]
        .concat(),
    );
    assert_eq!((code, output.lines().count()), (0, 2), "{messages}");
    let kick = pair(
        "kick.toml",
        ["v", "x - x^3 - 0.3*v"],
        "[[mode.surface]]\nname = \"kick\"\nperiod = 1\nresets = { v = \"v + 0.1\" }",
    );
    let (code, _, messages) =
        call(&["basin", kick.path(), "--window", "x=-1:1", "v=-1:1", "--step", "0.7"]);
    assert!(code == 2 && messages.contains("no period of the surface kick"), "{messages}");
}

#[test]
fn what_is_wrong_is_said_in_one_line_with_its_place() {
    let ball = model("ball.toml");
    let file = |text: &str| File::new("broken.toml", text);
    let broken = [
        (file("states = ["), "line 1: unclosed array"),
        (file("states = ['x']\nmodes = 3"), "unknown field `modes`"),
        (file("states = ['x']\n[[mode]]\nname = 'a'\nrates = { x = 'sin(x' }"), "')' is expected"),
        (file("states = ['x', 'y']\n[[mode]]\nname = 'a'\nrates = { x = 'y' }"), "none of y"),
        (file("states = ['x']\n[[mode]]\nname = 'a'\nrates = { x = 'q + 10' }"), "q"),
        (
            file("states = ['x']\n[[mode]]\nname = 'a'\nrates = { x = 1, z = 2345 }"),
            "z is no state",
        ),
        (
            file(
                "states = ['x']\n[[mode]]\nname = 'a'\nrates = { x = 1 }\n[[mode.surface]]\nname = 's'\nguard = 'x'\nto = 'b'",
            ),
            "b",
        ),
        (
            file(
                "states = ['x']\n[[mode]]\nname = 'a'\nrates = { x = 1 }\n[[mode.surface]]\nname = 'nothing'",
            ),
            "give a guard, or a period",
        ),
    ];
    for (file, words) in &broken {
        let (code, output, messages) = call(&["run", file.path(), "--time", "1"]);
        assert_eq!((code, output.as_str()), (2, ""), "{messages}");
        assert!(messages.contains(words) && messages.lines().count() == 1, "{words}: {messages}");
    }
    let refused = [
        (vec!["run", &ball, "--start", "w=1"], 2, "there are: h, v"),
        (vec!["run", &ball, "--start", "h"], 2, "x=1"),
        (vec!["run", &ball, "--set", "q=1"], 2, "there are: g, restitution"),
        (vec!["run", &ball, "--mode", "rest"], 2, "there are: flight"),
        (vec!["section", &ball, "--surface", "roof"], 2, "there are: floor"),
        (
            vec!["section", &ball, "--surface", "floor", "--skip", "5000"],
            1,
            "only 125 returns to floor",
        ),
        (vec!["basin", &ball, "--window", "h=0:1", "--step", "1"], 2, "give one for each state"),
        (vec!["prove", &ball, "--surface", "floor", "--near", "v=1"], 1, "floor"),
        (vec!["run", "/nowhere.toml"], 2, "/nowhere.toml"),
        (vec![], 2, "`nonsmooth --help`"),
    ];
    for (arguments, status, words) in refused {
        let (code, output, messages) = call(&arguments);
        assert_eq!((code, output.as_str()), (status, ""), "{arguments:?}: {messages}");
        assert!(messages.contains(words) && messages.lines().count() == 1, "{words}: {messages}");
    }
}

#[test]
fn its_help_its_completions_and_its_manual_are_its_own() {
    for (arguments, words) in [
        (&["--help"][..], "rates = {"),
        (&["prove", "--help"], "--certificate"),
        (&["completions", "bash"], "nonsmooth"),
        (&["manual", "basin"], "nonsmooth\\-basin"),
    ] {
        let (code, output, messages) = call(arguments);
        assert_eq!(code, 0, "{messages}");
        assert!(output.contains(words), "{arguments:?}: {output}");
    }
}

/// Each of these calls once gave a number that is no orbit, no attractor, or not what the file says.
#[test]
fn what_would_be_wrong_in_silence_is_refused() {
    let [oscillator, rossler, duffing, ball] =
        ["oscillator.toml", "rossler.toml", "duffing.toml", "ball.toml"].map(model);
    let forced = File::new(
        "forced.toml",
        "states = ['x', 'v']\n[[mode]]\nname = 'f'\nrates = { x = 'v', v = 'cos(t) - 0.2*v - 4*x' }\n\
         [[mode.surface]]\nname = 'p'\nguard = 't - 2*pi'\ndirection = 'rising'\n",
    );
    let digits = File::new(
        "digits.toml",
        "states = ['x']\nparameters = { a = 1.00000000000000000001 }\n[[mode]]\nname = 'f'\nrates = { x = 'a' }\n",
    );
    let branch = ["branch", &oscillator, "--parameter", "force", "--from", "0.1", "--to", "0.2"];
    let prove = ["prove", &rossler, "--surface", "section", "--near", "y=-8.4"];
    let own = ["prove", forced.path(), "--surface", "p", "--near", "x=0.33"];
    for (arguments, words) in [
        // A return of a forced system from another time than 0.
        (
            [&branch[..], &["--surface", "stop", "--near", "x=0.5", "v=-0.9"]].concat(),
            "begins at t = 0",
        ),
        // States that do not come back.
        (
            [&branch[..], &["--surface", "period", "--near", "x=-0.14"]].concat(),
            "name it in --near",
        ),
        (prove.to_vec(), "name z in --near"),
        (own.to_vec(), "name v in --near"),
        // Times that are no period of the force.
        ([&own[..], &["v=0.02", "--on", "t=1"]].concat(), "no period"),
        (vec!["basin", &duffing, "--window", "x=-2:2", "v=-2:2", "--step", "1"], "no period"),
        (vec!["basin", &duffing, "--window", "x=-2:2", "v=-2:2", "--step=-1"], "positive time"),
        // Names without a meaning.
        ([&prove[..], &["z=0.03", "--on", "foo=1"]].concat(), "--on foo"),
        ([&prove[..], &["z=0.03", "--on", "y=1"]].concat(), "--on y"),
        (
            [&branch[..], &["--surface", "roof", "--near", "x=1"]].concat(),
            "there are: period, stop",
        ),
        (
            [&branch[..], &["--surface", "period", "--near", "x=1", "v=0", "v=1"]].concat(),
            "stands twice",
        ),
        // Digits that a double does not keep.
        (vec!["run", digits.path(), "--time", "1"], "line 2: 1.00000000000000000001"),
        (vec!["section", &ball, "--surface", "floor", "--returns", "0"], "--returns"),
    ] {
        let (code, output, messages) = call(&arguments);
        assert_eq!((code, output.as_str()), (2, ""), "{arguments:?}: {messages}");
        assert!(messages.contains(words) && messages.lines().count() == 1, "{words}: {messages}");
    }
    // The whole state and a period: 3/9.04 and 0.2/9.04.
    let (code, csv, messages) = call(&[&own[..], &["v=0.02", "--csv"]].concat());
    assert_eq!(code, 0, "{messages}");
    for (line, exact) in csv.lines().skip(1).zip([3.0 / 9.04, 0.2 / 9.04]) {
        let ends: Vec<f64> = line.split(',').skip(1).map(|x| x.parse().unwrap()).collect();
        assert!(ends[0] <= exact && exact <= ends[1] && ends[1] - ends[0] < 1e-10, "{line}");
    }
}

#[test]
fn no_event_and_names_of_columns_leave_a_table_whole() {
    let ball = model("ball.toml");
    let (code, csv, _) = call(&["run", &ball, "--start", "h=20", "--time", "1", "--csv"]);
    assert_eq!((code, csv.as_str()), (0, "time,error,surface,mode,h,v,certainty\n"));
    let names = File::new(
        "names.toml",
        "states = ['time', 'mode']\n[[mode]]\nname = 'a'\nrates = { time = 1, mode = 2 }\n\
         [[mode.surface]]\nname = 's'\nguard = 'time - 1/4'\n",
    );
    let (code, csv, messages) = call(&["run", names.path(), "--time", "1", "--csv"]);
    assert_eq!(code, 0, "{messages}");
    assert!(csv.starts_with("time,error,surface,mode,state_time,state_mode,certainty\n"), "{csv}");
    // Samples are at equal times, and nowhere else.
    let (_, csv, _) = call(&["run", &ball, "--samples", "4", "--csv", "--table", "samples"]);
    let times: Vec<&str> =
        csv.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(times, ["0", "0.5", "1", "1.5", "2"]);
}
