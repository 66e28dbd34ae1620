//! The other systems: basins by the crates for any system.
#![cfg(feature = "systems")]
#![allow(missing_docs, clippy::unwrap_used)]

use hopper_explorer::{OpenSystem, SYSTEMS, systems};

#[test]
fn every_system_has_its_fates_and_no_pixel_without_one() {
    let text = systems();
    for (number, system) in SYSTEMS.iter().enumerate() {
        assert!(text.contains(system.name) && text.contains(system.about));
        let open = OpenSystem::new(number).unwrap();
        let side =
            if number == 0 { ((-3.0, 3.0), (-9.0, 9.0)) } else { ((-1.9, 1.9), (-1.8, 1.8)) };
        let picture = open.strip(side, (24, 24), 0..24).unwrap();
        assert_eq!(picture.len(), 4 * 24 * 24);
        let yellow = picture.chunks(4).filter(|pixel| pixel[..3] == [0xff, 0xd7, 0x00]).count();
        assert!(yellow <= 3, "{}: {yellow} pixels are undecided", system.name);
        // Strips are the picture.
        let part = open.strip(side, (24, 24), 5..9).unwrap();
        for row in 0..24 {
            assert_eq!(
                part[16 * row..16 * (row + 1)],
                picture[4 * (24 * row + 5)..4 * (24 * row + 9)]
            );
        }
    }
}

#[test]
fn the_magnets_are_their_own_fates_and_the_picture_turns_with_them() {
    let open = OpenSystem::new(1).unwrap();
    let near = |x: f64, y: f64| {
        open.strip(((x - 0.01, x + 0.01), (y - 0.01, y + 0.01)), (1, 1), 0..1).unwrap()
    };
    // Beside a magnet the pendulum comes to it: green on the right, red above, blue below.
    let (right, upper, lower) = (near(0.9, 0.0), near(-0.45, 0.78), near(-0.45, -0.78));
    assert!(
        right[1] > right[0] && upper[0] > upper[2] && lower[2] > lower[0],
        "{right:?} {upper:?} {lower:?}"
    );
}

#[test]
fn wrong_questions_are_refused() {
    assert!(OpenSystem::new(9).unwrap_err().to_string().contains("there are 0 to 1"));
    let open = OpenSystem::new(0).unwrap();
    for (x, pixels, part) in [
        ((2.0, 1.0), (4, 4), 0..4),
        ((0.0, 1.0), (0, 4), 0..0),
        ((0.0, 1.0), (4, 4), 2..9),
        ((0.0, f64::NAN), (4, 4), 0..4),
    ] {
        assert!(open.strip((x, (0.0, 1.0)), pixels, part).is_err());
    }
}
