//! The core gives what the libraries give, and refuses what they refuse.

use basin_of_attraction::{Grid, Interval};
use hopper_basin::{Fates, HopperFate, basin_columns};
use hopper_explorer::{
    Depth, Tile, circle, intervals, legend, map, motion, numbered, places, point, proof, strip,
    units,
};
use hopper_figures::{FLAG, Layer, WITHOUT_FLAG, fate_colors};
use passive_hopper::MassRatio;

fn window(x: (f64, f64), logarithmic: bool, alpha: (f64, f64), pixels: usize) -> Tile {
    Tile { x, logarithmic, alpha, columns: pixels, rows: pixels }
}

#[allow(clippy::unwrap_used)] // a test that names a layer that is none fails
fn layer(key: &str) -> &'static Layer {
    Layer::of(key).unwrap()
}

#[test]
fn a_tile_has_the_labels_and_colours_of_the_library() {
    let of = window((0.1, 1.0), false, (4.5, 20.0), 48);
    let found = strip(layer("label"), &of, 0..48).unwrap();
    let interval = |(from, to): (f64, f64)| Interval::new(from, to).unwrap();
    let grid = Grid { x: interval(of.x), y: interval(of.alpha), columns: 48, rows: 48 };
    let labels = basin_columns(&grid, 0..48).unwrap();
    let codes: Vec<u32> = labels.iter().flatten().map(|label| u32::from(label.code())).collect();
    assert_eq!(found.values, codes);
    // The highest row comes first.
    let top_right = labels[47][47];
    assert_eq!(found.pixels[4 * 47..4 * 47 + 3], fate_colors::rgb(top_right));
}

#[test]
fn strips_make_the_tile() {
    for (layer, logarithmic) in
        [(layer("label"), false), (layer("label"), true), (layer("hops"), true)]
    {
        let of = window((0.1, 0.4), logarithmic, (4.5, 9.0), 20);
        let whole = strip(layer, &of, 0..20).unwrap();
        let parts = [0..7, 7..20].map(|part| strip(layer, &of, part).unwrap().values);
        assert_eq!(whole.values, parts.concat());
    }
}

/// High up, where enclosures are wider, some points have no proof; the others have one, of the fate that is computed.
#[test]
fn a_fate_is_proved_or_computed() {
    let of = window((0.01, 1.0), false, (100.0, 120.0), 24);
    let [found, computed] =
        [layer("proof"), layer("label")].map(|layer| strip(layer, &of, 0..24).unwrap());
    let bare: Vec<u32> = found.values.iter().map(|value| value & (FLAG as u32 - 1)).collect();
    assert_eq!(bare, computed.values);
    let proved = found.values.iter().filter(|&&value| value >= FLAG as u32).count();
    assert!(proved > 500 && proved < 24 * 24, "{proved}");
    let open = found.pixels.chunks(4).filter(|pixel| pixel[..3] == WITHOUT_FLAG.rgb).count();
    assert_eq!(open, 24 * 24 - proved);
    assert!(proof(0.2, 4.55).unwrap().contains(r#""name":"to α*_1""#));
    // Enclosures do not tell on which side of α*_1 its double lies.
    assert_eq!(proof(0.2, 4.493_409_457_909_064).unwrap(), r#"{"fate":null}"#);
    assert!(proof(0.2, -1.0).is_err() && proof(0.0, 7.0).is_err());
}

#[test]
fn the_logarithmic_axis_has_the_fates_of_its_places() {
    let of = window((-3.0, 0.0), true, (4.5, 9.0), 12);
    let found = strip(layer("label"), &of, 0..12).unwrap();
    let at = places(&of).unwrap();
    for (column, &m) in at[..12].iter().enumerate() {
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        for (row, &alpha) in at[12..].iter().enumerate() {
            let label = fates.fate(alpha).unwrap().label();
            assert_eq!(found.values[12 * column + row], u32::from(label.code()), "{m} {alpha}");
        }
    }
}

#[test]
fn a_point_says_its_fate_and_its_trap() {
    let incessant = point(0.2, 4.55, 3).unwrap();
    assert!(
        incessant.contains(r#""name":"to α*_1""#) && incessant.contains(r#""hops":0"#),
        "{incessant}"
    );
    assert!(incessant.contains(r#""trap":{"n":1,"left":4.493409457909064"#), "{incessant}");
    let grounded = point(1.0, 2.0, 3).unwrap();
    assert!(grounded.contains(r#""trap":null"#) && grounded.contains(r#""grounded":true"#));
    let name = HopperFate::label_name(HopperFate::GROUNDED);
    assert!(grounded.contains(&format!(r#""name":"{name}""#)), "{grounded}");
}

#[test]
fn motion_begins_at_the_lift_off() {
    let all = motion(0.2, 7.0, 2).unwrap();
    // Not grounded; time 0, hop 0, in flight, y₁ = 1, ẏ₁ = α, y₂ = ẏ₂ = 0.
    assert_eq!(all[..8], [0.0, 0.0, 0.0, 1.0, 1.0, 7.0, 0.0, 0.0]);
    assert_eq!((all.len() - 1) % 7, 0);
}

#[test]
fn masses_of_a_toy_add_up() {
    let toy = units(0.25, 0.1, 120.0, 9.81).unwrap();
    assert!(toy.contains(r#""upperMass":0.08"#) && toy.contains(r#""lowerMass":0.02"#), "{toy}");
}

#[test]
fn panels_and_the_depth_have_answers() {
    assert!(map(0.2, 0.0, 8.0, 50).unwrap().contains(r#""massRatio":0.10345775533613"#));
    assert!(circle(0.12, 2).unwrap().contains(r#""ground":"branches""#));
    assert!(intervals(0.2, 1, 3).unwrap().contains(r#""ground":"proved""#));
    assert!(legend().contains("#22a672"));
    let depth = Depth::near(0.12, 11.920553918335775).unwrap();
    let frame = depth.frame(layer("coverage"), 100.0, (16, 16)).unwrap();
    // The lower half is the circle's side: its colour is a mixture. Above the edge is the basin of α*_2.
    assert_eq!(frame[4 * 8..4 * 8 + 3], fate_colors::rgb(HopperFate::label_of_fixed_point(2)));
}

#[test]
fn wrong_questions_are_refused_with_words() {
    let refused = |text: String, word: &str| assert!(text.contains(word), "{text}");
    let nan = f64::NAN;
    refused(point(-1.0, 7.0, 3).unwrap_err().to_string(), "mass ratio");
    refused(point(0.2, nan, 3).unwrap_err().to_string(), "speed");
    assert!(map(0.2, 0.0, 1e9, 50).is_err() && map(0.2, 3.0, 2.0, 50).is_err());
    assert!(motion(0.2, 7.0, 100_000).is_err() && circle(0.2, 0).is_err());
    assert!(units(0.2, -1.0, 120.0, 9.81).is_err() && intervals(0.2, 3, 2).is_err());
    let tile = |of: Tile| strip(layer("label"), &of, 0..1).is_err();
    assert!(
        tile(window((0.1, 0.2), false, (4.0, 5.0), 0))
            && tile(window((0.1, 0.2), false, (4.0, 5.0), 1 << 20))
    );
    assert!(
        tile(window((nan, 0.2), false, (4.0, 5.0), 4))
            && tile(window((0.1, 0.2), false, (-9.0, 5.0), 4))
    );
    assert!(strip(layer("label"), &window((0.1, 0.2), false, (4.0, 5.0), 4), 3..9).is_err());
    assert!(numbered(99).is_err());
    let depth = Depth::near(0.12, 11.920553918335775).unwrap();
    assert!(
        depth.frame(layer("coverage"), nan, (4, 4)).is_err()
            && depth.frame(layer("coverage"), 1e6, (4, 4)).is_err()
            && depth.frame(layer("coverage"), 9.0, (5000, 4)).is_err()
    );
}

/// The fraction of Ψ with which the windows end.
#[expect(clippy::unwrap_used, reason = "a test calls it")]
fn fraction(depth: &Depth, at: f64) -> f64 {
    let text = depth.phase(at).unwrap();
    let digits = text.split_once(r#""fraction":"#).unwrap().1;
    digits.split_once(',').unwrap().0.parse().unwrap()
}

#[test]
fn windows_whose_phases_differ_by_a_quarter_look_different() {
    let open = Depth::near(0.12, 11.920553918335775).unwrap();
    let first = fraction(&open, 10.0);
    let quarter = |at: f64| (fraction(&open, at) - first).rem_euclid(1.0);
    // A turn takes some 3·10⁻³ of depth here.
    let other =
        (1..400).map(|k| 10.0 + 1e-5 * f64::from(k)).find(|at| (quarter(*at) - 0.25).abs() < 5e-3);
    let frames =
        [10.0, other.unwrap()].map(|at| open.frame(layer("coverage"), at, (64, 64)).unwrap());
    let pixels = frames[0].chunks(4).zip(frames[1].chunks(4));
    let differ = pixels.filter(|(one, other)| one != other).count();
    assert!(differ >= 64 * 64 / 5, "{differ}");
}

#[test]
fn an_edge_of_grounding_is_the_same_at_every_depth() {
    let open = Depth::near(1.0, 5.6).unwrap();
    assert!(open.text().contains(r#""kind":"grounding""#), "{}", open.text());
    let frames =
        [1.0, 30.0, 1000.0].map(|depth| open.frame(layer("coverage"), depth, (32, 32)).unwrap());
    assert!(frames[0] == frames[1] && frames[1] == frames[2]);
    assert!(frames[0].chunks(4).any(|pixel| pixel != &frames[0][..4]));
    // The middle of the upper half is grounded, that of the lower one hops ever lower.
    for (y, name) in [(0.5, "grounded"), (-0.5, "decaying")] {
        let label = open.label(layer("coverage"), 1000.0, (0.0, y)).unwrap();
        assert!(label.contains(name), "{label}");
    }
    assert!(open.phase(1000.0).unwrap().contains("lastSpeedExponent"));
}

#[test]
fn fates_of_places_are_those_of_the_pictures() {
    let open = Depth::near(0.12, 11.920553918335775).unwrap();
    let frame = open.frame(layer("coverage"), 30.0, (8, 8)).unwrap();
    // The basin of α*_2 is a half of the window.
    let inside = (0..8).map(|row| {
        let y = 1.0 - (2 * row + 1) as f64 / 8.0;
        let label = open.label(layer("coverage"), 30.0, (0.0625, y)).unwrap();
        (label.contains(r#""label":2"#), frame[4 * (8 * row + 4)..][..3].to_vec())
    });
    let colors: Vec<_> = inside.filter(|(is_two, _)| *is_two).map(|(_, color)| color).collect();
    assert!(colors.len() >= 3 && colors.windows(2).all(|pair| pair[0] == pair[1]), "{colors:?}");
}

#[test]
fn layers_beside_an_edge_have_their_numbers_at_any_depth() {
    let open = Depth::near(0.12, 11.920553918335775).unwrap();
    // The next hop is the same on both sides, as far as a picture shows.
    let frame = open.frame(layer("loss"), 40.0, (8, 8)).unwrap();
    let (pixels, _) = frame.as_chunks::<4>();
    assert!(pixels.iter().all(|pixel| *pixel == pixels[0]));
    let hop = passive_hopper::LiftOffMap::new(MassRatio::new(0.12).unwrap());
    let hop = hop.hop(11.920553918335775).unwrap();
    let lost = 1.0 - (hop.next.unwrap() / hop.speed).powi(2);
    let label = open.label(layer("loss"), 40.0, (0.0, 0.5)).unwrap();
    let shown: f64 =
        label.split("\"number\":").nth(1).unwrap().trim_end_matches('}').parse().unwrap();
    assert!((shown - lost).abs() < 1e-6, "{label}");
    // Phases turn on both sides, and differ from the fates.
    let colors = |key: &str| {
        let frame = open.frame(layer(key), 20.0, (16, 64)).unwrap();
        let (pixels, _) = frame.as_chunks::<4>();
        pixels.iter().copied().collect::<std::collections::BTreeSet<_>>().len()
    };
    assert!(colors("phase") > 12, "{}", colors("phase"));
    // A layer that is nothing there shows the fates.
    let of = |key: &str| open.frame(layer(key), 20.0, (16, 64)).unwrap();
    assert_eq!(of("digits"), of("coverage"));
    // At an edge of grounding the next hop has no next speed on one side, if it is the one that grounds.
    let open = Depth::near(1.0, 5.6).unwrap();
    let frame = open.frame(layer("loss"), 40.0, (1, 2)).unwrap();
    let is_first = open.text().contains(r#""hops":1,"#);
    assert_eq!(frame[..4] != frame[4..], is_first, "{}", open.text());
    // Its slope has no limit there.
    let slopes = [0.5, -0.5].map(|y| open.label(layer("slope"), 40.0, (0.0, y)).unwrap());
    assert!(!is_first || slopes.iter().all(|label| !label.contains("number")), "{slopes:?}");
    // A window that doubles resolve has many numbers.
    let frame = open.frame(layer("flight"), 0.5, (8, 8)).unwrap();
    let (pixels, _) = frame.as_chunks::<4>();
    assert!(pixels.iter().collect::<std::collections::BTreeSet<_>>().len() > 4);
    for wrong in [f64::NAN, -1.0, f64::INFINITY] {
        assert!(open.frame(layer("flight"), wrong, (8, 8)).is_err());
    }
}
