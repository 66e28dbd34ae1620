//! Enclosures of hops hold the values of 40 digits, and all images of random intervals.
#![allow(clippy::unwrap_used)]

use hopper_basin::{ImagedSpeed, SpeedImage, SpeedImages};
use hopper_proof::{ProvedImages, Strip};
use hopper_reference::{map, rows};

const FILES: [&str; 4] = [
    include_str!("../../passive-hopper/tests/data/hops_random.jsonl"),
    include_str!("../../passive-hopper/tests/data/hops_window.jsonl"),
    include_str!("../../passive-hopper/tests/data/hops_boundaries.jsonl"),
    include_str!("../../passive-hopper/tests/data/hops_hard_verdicts.jsonl"),
];

/// The largest speed of the test. The enclosures reach further; rows beyond it have no fixed point with a label.
const LARGEST_SPEED: f64 = 1e5;

#[test]
fn every_decided_image_holds_the_reference() {
    let (mut decided, mut open) = (0, 0);
    for row in FILES.iter().flat_map(|file| rows(file)) {
        let (ratio, alpha) = (row.input("mass_ratio"), row.input("alpha"));
        if alpha > LARGEST_SPEED {
            continue;
        }
        let images = ProvedImages::new(Strip::at(ratio).unwrap(), alpha.min(100.0)).unwrap();
        let grounded = row.is_grounded("alpha_next");
        match images.of_speed(alpha) {
            SpeedImage::Unknown => open += 1,
            SpeedImage::Grounded => {
                assert!(grounded, "{row}");
                decided += 1;
            }
            SpeedImage::Within(low, high) => {
                assert!(!grounded, "{row}");
                // The reference is read as its nearest f64, so that an end may be its neighbour.
                let exact = row.result("alpha_next").unwrap();
                assert!(low.next_down() <= exact && exact <= high.next_up(), "{low} {high} {row}");
                decided += 1;
            }
        }
    }
    // What 53 bits leave open: hops with a decision within some ulps of it, which these files are full of.
    assert!(decided > 20 * open && decided > 2500, "{decided} decided, {open} open");
}

/// Boxes of the next test: `HOPPER_PROOF_BOXES`, or enough for seconds.
fn boxes() -> u32 {
    let wanted = std::env::var("HOPPER_PROOF_BOXES").ok().and_then(|text| text.parse().ok());
    wanted.unwrap_or(12_000)
}

/// Boxes of one strip. The turns of a strip are found once.
const BOXES_OF_A_STRIP: u32 = 20;

/// One strip of so many is as wide as a tenth of its mass ratio. The others are narrower than their intervals of
/// speeds.
const WIDE: u32 = 10;

/// The strip of some boxes, and the width of their intervals of speeds.
fn strip_of_boxes(number: u32) -> (Strip, f64) {
    let ratio = 0.02 + 2.5 * part(number, 0.618_033_988_749_895).powi(2);
    let width = 10f64.powi(-1 - (number % 9) as i32);
    let relative = if number.is_multiple_of(WIDE) { 0.1 } else { 0.01 * width };
    (Strip::between(ratio, ratio * (1.0 + relative)).unwrap(), width)
}

fn part(k: u32, step: f64) -> f64 {
    (f64::from(k) * step).fract()
}

fn end(images: &ProvedImages, speed: f64) -> ImagedSpeed {
    ImagedSpeed { speed, reached: images.of_speed(speed) }
}

/// How far the image of one speed, over a strip, may reach beyond the images at the mass ratios of the strip,
/// downwards and upwards.
fn excess(images: &ProvedImages, speed: f64) -> [f64; 2] {
    let SpeedImage::Within(low, high) = images.of_speed(speed) else { return [f64::INFINITY; 2] };
    let ratios = images.strip().mass_ratios;
    [ratios.low(), ratios.high()].iter().fold([f64::INFINITY; 2], |[down, up], &ratio| {
        let alone = ProvedImages::new(Strip::at(ratio).unwrap(), 40.0).unwrap();
        match alone.of_speed(speed) {
            SpeedImage::Within(from, to) => [down.min(to - low), up.min(high - from)],
            _ => [down, up],
        }
    })
}

/// Every image of the part of an interval is one of the whole.
fn is_inside(part: SpeedImage, whole: SpeedImage) -> bool {
    match (part, whole) {
        (SpeedImage::Within(from, to), SpeedImage::Within(low, high)) => low <= from && to <= high,
        _ => part == whole || part == SpeedImage::Unknown,
    }
}

/// The image of the part between two speeds reaches beyond that of the whole by no more than the images of these
/// speeds have in excess.
///
/// The image of an interval is bounded by the images of its ends, and these are not exact: those of single mass
/// ratios have rounding errors, and those of strips a bound on the change with κ. Both differ from speed to speed,
/// so that the ends of a part may have more of it.
fn is_inside_but_for_ends(
    images: &ProvedImages,
    ends: [f64; 2],
    part: SpeedImage,
    whole: SpeedImage,
) -> bool {
    let (SpeedImage::Within(from, to), SpeedImage::Within(low, high)) = (part, whole) else {
        return false;
    };
    let [a, b] = ends.map(|speed| excess(images, speed));
    low - from <= a[0].max(b[0]) && to - high <= a[1].max(b[1])
}

/// The images of single speeds of an interval, at single mass ratios of a strip, lie in the image of all; and so
/// does the image of a part of the interval.
#[test]
fn images_of_intervals_hold_those_of_their_speeds() {
    let (mut known, mut beyond, mut count) = (0, 0, 0);
    for strip_number in 1..=boxes().div_ceil(BOXES_OF_A_STRIP) {
        let (strip, width) = strip_of_boxes(strip_number);
        let images = ProvedImages::new(strip, 40.0).unwrap();
        let between = |a, b| images.of_all_between(&end(&images, a), &end(&images, b));
        for j in 0..BOXES_OF_A_STRIP {
            let k = strip_number.wrapping_mul(BOXES_OF_A_STRIP).wrapping_add(j);
            count += 1;
            let low = 1.0 + 30.0 * part(k, 0.754_877_666_246_693);
            let all = between(low, low + width);
            if all == SpeedImage::Unknown {
                continue;
            }
            known += 1;
            let place = |step: f64| low + width * part(k, step);
            let alpha = place(0.569_840_290_998_053);
            let mass = strip.mass_ratios.low()
                + strip.mass_ratios.width() * 0.999 * part(k, 0.438_579_021_1);
            let image = map(mass).image(alpha).unwrap();
            match all {
                SpeedImage::Unknown | SpeedImage::Grounded => {
                    assert_eq!(image, None, "M = {mass}, α = {alpha}");
                }
                SpeedImage::Within(low, high) => {
                    // The library's own image has an error of some ulps, more where F is small.
                    let image = image.unwrap_or(0.0);
                    let error = 1e-12 * (1.0 + alpha * alpha / image.max(1e-3));
                    assert!(
                        low - error <= image && image <= high + error,
                        "M = {mass}, α = {alpha}: {image} {all:?}"
                    );
                }
            }
            let other = place(0.324_717_957_244_746);
            let ends = [alpha.min(other), alpha.max(other)];
            let inner = between(ends[0], ends[1]);
            if !is_inside(inner, all) {
                beyond += 1;
                let holds = is_inside_but_for_ends(&images, ends, inner, all);
                assert!(holds, "M of {strip:?}, α of {ends:?}: {inner:?} {all:?}");
            }
        }
    }
    assert!(beyond <= 1 + count / 10_000, "{beyond} parts reach beyond the whole");
    assert!(3 * known > 2 * count, "{known} of {count}");
}

/// An image of a narrow interval is at most some parts wider than the images of its ends: the median of the ratio
/// is below 2.
#[test]
fn narrow_intervals_have_sharp_images() {
    let mut ratios = Vec::new();
    for k in 1..=2000u32 {
        let ratio = 0.02 + 0.98 * part(k, 0.618_033_988_749_895);
        let images = ProvedImages::new(Strip::at(ratio).unwrap(), 40.0).unwrap();
        let low = 2.0 + 20.0 * part(k, 0.754_877_666_246_693);
        let (a, b) = (end(&images, low), end(&images, low + 1e-6));
        if let (SpeedImage::Within(p, q), SpeedImage::Within(r, s), SpeedImage::Within(from, to)) =
            (a.reached, b.reached, images.of_all_between(&a, &b))
        {
            ratios.push((to - from) / (0.5 * (p + q) - 0.5 * (r + s)).abs());
        }
    }
    ratios.sort_by(f64::total_cmp);
    assert!(ratios.len() > 1000 && ratios[ratios.len() / 2] < 2.0, "{}", ratios[ratios.len() / 2]);
}
