//! Wrong calls: one clear line each, exit status 2, and nothing written.

use super::common::call;

/// Calls, and a part of the message: the option or its value, and the remedy.
const WRONG: &[(&str, &[&str])] = &[
    ("", &["a command is missing", "--help"]),
    ("hpo", &["'hpo'", "--help"]),
    ("orbi 7 -M 0.2", &["'orbi'", "orbit"]),
    ("Fate 7", &["'Fate'"]),
    ("--json hop 7 -M 0.2", &["'--json'"]),
    ("hop", &["--mass-ratio"]),
    ("hop 7", &["--mass-ratio"]),
    ("hop 7 -M", &["--mass-ratio"]),
    ("hop 7 --mas-ratio 0.2", &["'--mas-ratio'", "'--mass-ratio'"]),
    ("hop 7 --mass_ratio 0.2", &["'--mass_ratio'", "'--mass-ratio'"]),
    ("hop 7 -m 0.2", &["'-m'"]),
    ("hop 7 -M 0", &["'0'", "--mass-ratio", "2.2250738585072014e-308", "give"]),
    ("hop 7 -M -1", &["'-1'", "--mass-ratio"]),
    ("hop 7 -M nan", &["'nan'", "--mass-ratio", "finite"]),
    ("hop 7 -M inf", &["'inf'", "--mass-ratio", "finite"]),
    ("hop 7 -M -inf", &["-inf", "finite"]),
    ("hop 7 -M 1e-310", &["'1e-310'", "--mass-ratio"]),
    ("hop 7 -M 1e308", &["'1e308'", "--mass-ratio"]),
    ("hop 7 -M 0,2", &["'0,2'", "point"]),
    ("hop 7 -M two", &["'two'", "--mass-ratio", "number"]),
    ("hop 7 -M 0.2 -M 0.3", &["--mass-ratio", "multiple times"]),
    ("hop 0 -M 0.2", &["'0'", "SPEED", "8796093022208"]),
    ("hop -7 -M 0.2", &["'-7'", "SPEED", "positive"]),
    ("hop 7 - -M 0.2", &["SPEED -", "alone"]),
    ("coverage 0 --out TMP/a", &["TOLERANCE 0", "0.05"]),
    ("scales 0 --out TMP/a", &["'0'", "<N>"]),
    ("zoom 0.12 --out TMP/a", &["<SPEED>"]),
    ("hop inf -M 0.2", &["'inf'", "SPEED", "finite"]),
    ("hop -inf -M 0.2", &["'-inf'", "finite"]),
    ("hop -1e-6 -M 0.2", &["'-1e-6'", "negative", "positive"]),
    ("hop -nan -M 0.2", &["'-nan'", "finite"]),
    ("hop nan -M 0.2", &["'nan'", "SPEED"]),
    ("hop 1e14 -M 0.2", &["'1e14'", "8796093022208"]),
    ("hop 1e400 -M 0.2", &["'1e400'", "finite"]),
    ("hop 1e-400 -M 0.2", &["'1e-400'", "positive"]),
    ("hop 7,5 -M 0.2", &["'7,5'", "point"]),
    ("hop 7 8 x -M 0.2", &["'x'", "SPEED"]),
    ("hop 0x7 -M 0.2", &["'0x7'", "number"]),
    ("hop 7 -M 0.2 --json --csv", &["--json", "--csv"]),
    ("hop 7 -M 0.2 --table hop", &["--table hop", "hops, landings"]),
    ("hop 7 -M 0.2 --table", &["--table"]),
    ("hop 7 -M 0.2 --quiet --verbose", &["--quiet", "--verbose"]),
    ("hop 7 -M 0.2 --cobweb a.svg", &["--cobweb"]),
    ("hop 7 -M 0.2 --json=yes", &["--json"]),
    ("orbit", &["--mass-ratio"]),
    ("orbit 7", &["--mass-ratio"]),
    ("orbit 7 8 -M 0.2", &["'8'"]),
    ("orbit -7 -M 0.2", &["'-7'"]),
    ("orbit 7 -M 0.2 --hops", &["--hops"]),
    ("orbit 7 -M 0.2 --hops -1", &["'-1'", "--hops"]),
    ("orbit 7 -M 0.2 --hops 1.5", &["'1.5'", "--hops"]),
    ("orbit 7 -M 0.2 --hops 1000001", &["1000001", "--hops", "1000000"]),
    ("orbit 7 -M 0.2 --hops many", &["'many'", "--hops"]),
    ("orbit 7 -M 0.2 --hops 99999999999999999999", &["--hops"]),
    ("orbit 7 -M 0.2 --cobweb TMP/a.pdf", &["a.pdf", "--cobweb", ".svg, .png"]),
    ("orbit 7 -M 0.2 --cobweb TMP/a.csv", &["a.csv", "--cobweb", ".svg, .png"]),
    ("orbit 7 -M 0.2 --cobweb TMP/a", &["--cobweb", ".svg, .png"]),
    ("orbit 7 -M 0.2 --cobweb", &["--cobweb"]),
    ("orbit 7 -M 0.2 --motion TMP/a.gif", &["a.gif", "--motion", ".csv, .svg, .png"]),
    ("orbit 7 -M 0.2 --motion TMP/", &["--motion", ".csv"]),
    ("orbit 7 -M 0.2 --animate TMP/a.mp4", &["a.mp4", "--animate", ".apng, .gif"]),
    ("orbit 7 -M 0.2 --animate TMP/a.svg", &["a.svg", "--animate"]),
    ("orbit 7 -M 0.2 --cobweb TMP/a.svg --motion TMP/a.svg", &["--motion", "--cobweb", "own file"]),
    ("orbit 7 -M 0.2 --cobweb - --motion -", &["--motion -", "--cobweb"]),
    ("orbit 7 -M 0.2 --table hops", &["--table hops", "orbit, fates"]),
    ("orbit 7 -M 0.2 --cobwep TMP/a.svg", &["'--cobwep'", "'--cobweb'"]),
    (
        "orbit 4.55 -M 0.2 --hops 500 --animate TMP/a.gif",
        &["--animate", "frames", "1200", "--hops"],
    ),
    ("orbit 4.55 -M 0.2 --hops 90000 --motion TMP/a.csv", &["--motion", "samples", "--hops"]),
    ("orbit 100000 -M 0.9 --cobweb TMP/a.svg", &["--cobweb", "humps", "200"]),
    ("fate 7", &["--mass-ratio"]),
    ("fate 7 -M 0", &["'0'", "--mass-ratio"]),
    ("fate 0 -M 0.2", &["'0'", "SPEED"]),
    ("fate 7 - -M 0.2", &["SPEED -", "alone"]),
    ("fate - - -M 0.2", &["SPEED -", "alone"]),
    ("fate seven -M 0.2", &["'seven'", "number"]),
    ("fate 7 -M 0.2 --table fate", &["--table fate", "fates"]),
    ("fate 7 -M 0.2 --hops 3", &["'--hops'"]),
    ("map", &["--mass-ratio"]),
    ("map 7 -M 0.2", &["'7'"]),
    ("map -M 0.2 --speed", &["--speed"]),
    ("map -M 0.2 --speed 3", &["--speed", "2 values"]),
    ("map -M 0.2 --speed 3 2", &["--speed 3 2", "increase"]),
    ("map -M 0.2 --speed 3 3", &["--speed 3 3", "increase"]),
    ("map -M 0.2 --speed -inf inf", &["'-inf'", "--speed", "finite"]),
    ("map -M 0.2 --speed -1 5", &["'-1'", "--speed"]),
    ("map -M 0.2 --speed 1 1e20", &["'1e20'", "--speed", "8796093022208"]),
    ("map -M 0.2 --speed 0 1e6", &["--speed 0 1000000", "humps", "200"]),
    ("map -M 0.2 --speed a b", &["'a'", "--speed"]),
    ("map -M 0.2 --points 1", &["--points", "2"]),
    ("map -M 0.2 --points 0", &["--points"]),
    ("map -M 0.2 --points 1e3", &["'1e3'", "--points"]),
    ("map -M 0.2 --points 100001", &["--points", "100000"]),
    ("map -M 0.2 --figure TMP/a.jpg", &["--figure", ".svg, .png"]),
    ("map -M 0.2 --table map", &["--table map", "fixed_points, curve"]),
    ("intervals", &["--mass-ratio"]),
    ("intervals -M 0.2 --from 3 --to 3", &["--from 3", "--to 3"]),
    ("intervals -M 0.2 --from 7", &["--from 7", "--to 6"]),
    ("intervals -M 0.2 --to 65", &["--to", "64"]),
    ("intervals -M 0.2 --to 0", &["--to", "1"]),
    ("intervals -M 0.2 --from -1", &["'-1'", "--from"]),
    ("intervals -M 0.2 --undecided -1e-6", &["--undecided", "negative"]),
    ("intervals -M 0.2 --undecided nan", &["--undecided", "finite"]),
    ("intervals -M 0.2 --shortest x", &["--shortest", "number"]),
    ("intervals -M 0.2 --most 0", &["--most", "1"]),
    ("intervals -M 0.2 --most 10000001", &["--most", "10000000"]),
    ("intervals -M 0.2 --samples 1", &["--samples", "2"]),
    ("intervals -M 0.2 --table basins", &["--table basins", "fractions, search, intervals"]),
    ("units", &["--upper", "--lower", "--stiffness"]),
    ("units --upper 80g --lower 16g", &["--stiffness"]),
    ("units --upper 80 --lower 16g --stiffness 120N/m", &["'80'", "--upper", "no unit", "kg"]),
    ("units --upper 80m --lower 16g --stiffness 120N/m", &["'80m'", "--upper", "length"]),
    ("units --upper 0g --lower 16g --stiffness 120N/m", &["--upper", "positive"]),
    ("units --upper -80g --lower 16g --stiffness 120N/m", &["--upper", "positive"]),
    ("units --upper 80g --lower 16lb --stiffness 120N/m", &["--lower", "'lb'", "kg, g, mg, t"]),
    ("units --upper 80g --lower 16g --stiffness 120", &["--stiffness", "N/m"]),
    ("units --upper 80g --lower 16g --stiffness 120N", &["--stiffness", "'N'"]),
    ("units --upper 80g --lower 16g --stiffness 1N/m --gravity 9.81", &["--gravity", "m/s^2"]),
    ("units --upper 80g --lower 16g --stiffness 1N/m --gravity 0m/s2", &["--gravity", "positive"]),
    ("units --upper 80g --lower 16g --stiffness 1N/m 3", &["'3'", "QUANTITY", "unit"]),
    ("units --upper 80g --lower 16g --stiffness 1N/m 3kg", &["QUANTITY 3kg", "option"]),
    ("units --upper 80g --lower 16g --stiffness 1N/m 3furlong", &["furlong", "km/h"]),
    ("units --upper 80g --lower 16g --stiffness 1N/m 1,5m/s", &["1,5m/s", "point"]),
    ("units --upper 80g --lower 16g --stiffness 1N/m --alpha 0", &["--alpha", "positive"]),
    ("units --upper 1e300kg --lower 1e-300g --stiffness 1N/m", &["--upper", "mass ratio"]),
    ("units --upper 1e-300kg --lower 1e-300kg --stiffness 1e300N/m", &["--upper", "other sizes"]),
    ("units --upper 80g --lower 16g --stiffness 1N/m -3m/s", &["'-3m/s'", "neither"]),
    ("basins --part 1/2", &["--out"]),
    ("basins --out TMP/x --pixels 1e3 10", &["'1e3'", "--pixels", "whole number"]),
    ("basins --out TMP/x --pixels 1.5 10", &["'1.5'", "--pixels", "whole number"]),
    ("basins --out TMP/x --pixels -1 10", &["'-1'", "--pixels", "whole number"]),
    ("basins --out TMP/x --pixels 99999999999999999999 1", &["--pixels", "whole number"]),
    ("basins --out TMP/x --pixels 0 10", &["--pixels 0 10", "1048576"]),
    ("basins --out TMP/x --mass-ratio 1 0.1", &["--mass-ratio 1 0.1", "smaller one first"]),
    ("basins --out TMP/x --speed -inf inf", &["'-inf'", "finite"]),
    ("basins --out TMP/x --about 70000", &["'70000'", "--about", "1 to 65000"]),
    ("basins --out TMP/x --about 1e3", &["'1e3'", "--about", "1 to 65000"]),
    ("basins --out TMP/x --about 2 --offset nan 1e-3", &["'nan'", "--offset", "1e-300"]),
    ("basins --out TMP/x --about 2 --preimage 0 11", &["--preimage 0 11", "mass ratio", "give"]),
    ("basins --out TMP/x --about 2 --preimage 0.12 -11", &["--preimage 0.12 -11", "give"]),
    ("basins --out TMP/x --about 2 --preimage 0.12 4.6", &["--preimage 0.12 4.6", "give"]),
    ("basins --out TMP/x --zoom 0 5", &["M SPEED 0 5", "mass ratio", "give"]),
    ("basins --out TMP/x --zoom 0.12 1e300", &["M SPEED 0.12 1e300", "8796093022208", "give"]),
    ("basins --out TMP/x --zoom 0.12 5e-324", &["M SPEED 0.12 5e-324", "of 5e-324 comes", "give"]),
    ("basins --out TMP/x --zoom 0.12 11.92 -M 0.1 1", &["--zoom", "--mass-ratio"]),
    ("basins --out TMP/x --zoom 0.12 11.92 --frames -1", &["'-1'", "--frames", "whole number"]),
    ("basins --out TMP/x --coverage 0", &["TOLERANCE 0", "0.5", "give"]),
    ("basins --out TMP/x --part 4/3", &["'4/3'", "--part", "1/4"]),
    ("basins --out TMP/x --join", &["--join --out", "--part 1/2"]),
    ("hop 7 -M 0.2 --table=", &["--table ''", "hops, landings"]),
    (
        "orbit 7 -M 0.2 --cobweb TMP/a.svg --motion TMP/./a.svg",
        &["--motion", "--cobweb", "own file"],
    ),
    ("completions", &["<SHELL>"]),
    ("completions tcsh", &["'tcsh'", "bash, fish, zsh"]),
    ("manual hpo", &["'hpo'", "orbit"]),
];

#[test]
fn a_wrong_call_is_refused_in_one_line() {
    assert!(WRONG.len() >= 150);
    let folder = std::env::temp_dir().join(format!("hopper_refusals_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for (line, parts) in WRONG {
        let line = line.replace("TMP", &folder.display().to_string());
        let arguments: Vec<&str> = line.split_whitespace().collect();
        let called = call(&arguments, b"");
        let message = &called.messages;
        assert_eq!(called.code, 2, "{line}: {message}");
        assert_eq!(called.output, "", "{line}");
        assert!(message.starts_with("error: ") && message.ends_with('\n'), "{line}: {message}");
        assert_eq!(message.matches('\n').count(), 1, "{line}: {message}");
        assert!(message.chars().count() < 400, "{line}: {message}");
        for part in *parts {
            assert!(message.contains(part), "{line}: '{part}' is not in: {message}");
        }
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0, "{line}");
    }
    std::fs::remove_dir(&folder).unwrap();
}

#[test]
fn a_wrong_line_of_the_input_is_named() {
    let inputs: [(&[u8], u32, &str); 6] = [
        (b"7\nseven\n", 2, "'seven'"),
        (b"# speeds\n\n7\n-1\n", 4, "'-1'"),
        (b"0", 1, "'0'"),
        (b"7 8\n", 1, "'7 8'"),
        (b"7\n\xff\xfe\n", 2, "no text in UTF-8"),
        (b"7\n1e20\n", 2, "8796093022208"),
    ];
    for (input, line, part) in inputs {
        let called = call(&["fate", "-M", "0.2", "--csv"], input);
        assert_eq!(called.code, 2);
        let expected = format!("standard input, line {line}, ");
        assert!(called.messages.contains(&expected), "{}", called.messages);
        assert!(called.messages.contains(part), "{}", called.messages);
        // The lines before it have their fates, and so has the line of names.
        let rows = input.split(|&byte| byte == b'\n').take(line as usize - 1);
        let before = rows.filter(|row| !row.is_empty() && row[0] != b'#').count();
        assert_eq!(called.output.lines().count(), 1 + before, "{}", called.output);
    }
}

#[test]
fn a_file_that_cannot_be_written_fails_before_the_computation() {
    for file in ["/nowhere/a.svg", "/dev/null/a.svg"] {
        // The message names the file, and not the temporary one.
        let called = call(&["orbit", "7", "-M", "0.2", "--cobweb", file], b"");
        assert_eq!((called.code, called.output.as_str()), (1, ""));
        assert!(called.messages.starts_with(&format!("error: {file}: ")), "{}", called.messages);
    }
}

/// A line break in an argument is written out, and an argument that is no text is shown.
#[cfg(unix)]
#[test]
fn odd_arguments_are_shown_in_one_line() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let called = call(&["hop", "7\n8", "-M", "0.2"], b"");
    assert_eq!(called.messages.matches('\n').count(), 1, "{}", called.messages);
    assert!(called.code == 2 && called.messages.contains("'7\\n8'"), "{}", called.messages);
    let mut messages = Vec::new();
    let streams = passive_hopper_cli::Streams {
        input: &mut std::io::empty(),
        input_is_terminal: false,
        output_has_colors: false,
        output: &mut Vec::new(),
        messages: &mut messages,
    };
    let arguments = [&b"hopper"[..], b"hop", b"7", b"-M", b"0.\xff"];
    let arguments = arguments.map(|argument| OsStr::from_bytes(argument).to_owned());
    assert_eq!(passive_hopper_cli::run(arguments, streams), 2);
    let text = String::from_utf8(messages).unwrap();
    assert!(text.contains("'0.\u{fffd}'") && text.contains("UTF-8"), "{text}");
}
