//! What certificates say, and of what they cannot be written. That they are confirmed is tested by `cargo xtask check-certificates`.

use crate::models::{map_of, oscillator};
use validated_dynamics::{
    Certificate, Division, EnclosedMap, Enclosure, Error, ProvedBasins, SectionMap, StartSet,
    Target, Trap, ValidatedSystem, fixed_point,
};

fn kinds(certificate: &Certificate) -> Vec<String> {
    let kind = |line: &str| {
        let line: serde_json::Value = serde_json::from_str(line).unwrap();
        line["kind"].as_str().unwrap_or("header").to_owned()
    };
    certificate.text().lines().map(kind).collect()
}

#[test]
fn models_are_written_once_and_the_same_statements_have_the_same_bytes() {
    let halving = map_of(&["x"], &["x/2 + x^3/8"]).recorded();
    let point = fixed_point(&halving, &[0.1], &[]).unwrap();
    let trap = Trap::new(&halving, &point, 100).unwrap();
    let whole = [Enclosure::new(-0.5, 0.5)];
    let write = || {
        let mut certificate = Certificate::new("halving");
        certificate.fixed_point(&halving, &point).unwrap();
        let number = certificate.trap(&halving, &trap).unwrap();
        certificate.leads(&halving, &whole, &[whole.to_vec()], Target::Trap(number)).unwrap();
        certificate
    };
    assert_eq!(kinds(&write()), ["header", "map", "fixed-point", "trap", "leads"]);
    assert_eq!(write().text(), write().text());
}

#[test]
fn cells_stand_behind_those_in_which_their_images_are() {
    let cube = map_of(&["x"], &["x^3"]).recorded();
    let trap = Trap::new(&cube, &fixed_point(&cube, &[0.1], &[]).unwrap(), 100).unwrap();
    let window = [Enclosure::new(-2.0, 2.0)];
    let division = Division { first: 4, last: 8, images: 10_000 };
    let basins = ProvedBasins::new(&[&cube], vec![trap.clone()], &[&window], division).unwrap();
    let mut certificate = Certificate::new("cube");
    let trap = certificate.trap(&cube, &trap).unwrap();
    certificate.basins(&cube, &basins, &[trap]).unwrap();
    let cells = kinds(&certificate).iter().filter(|kind| *kind == "cell").count();
    assert!(cells > 8, "{cells}");
    assert!(certificate.basins(&cube, &basins, &[]).is_err());
}

#[test]
fn a_recorded_map_has_wider_images_that_hold_the_others() {
    let turning = oscillator().rising_text("section", "x - 0.1");
    let system = ValidatedSystem::new(&turning).unwrap();
    let start = system.chart("flow", &["v"], &["0", "v"]).unwrap();
    let map = SectionMap::new(&system, start, "section", 2, &["v"]).unwrap();
    let domain = [Enclosure::new(0.9, 0.91)];
    let [plain, written] = [map.clone(), map.recorded()]
        .map(|map| map.carry(StartSet::of_box(&domain).without_derivatives()).unwrap());
    let (plain, written) = (plain.set.hull()[0], written.set.hull()[0]);
    assert!(plain.is_inside(&written), "{plain} {written}");
    assert!(written.width() < 1.01 * plain.width(), "{plain} {written}");
}

#[test]
fn a_map_that_is_not_recorded_has_no_certificate() {
    let map = map_of(&["x"], &["x/2"]);
    let point = fixed_point(&map, &[0.1], &[]).unwrap();
    let error = Certificate::new("own").fixed_point(&map, &point).unwrap_err();
    assert!(matches!(&error, Error::Argument { what, .. } if what == "map"), "{error}");
}
