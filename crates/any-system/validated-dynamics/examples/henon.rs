//! The Hénon map (x, y) → (1 − a x² + y, b x), b = 0.3. At a = 0.2: the basin of its fixed point in [−4, 4]², cell by cell. At a = 1.4: the share of [−2, 2]²
//! from which orbits never escape, from both sides.
//!
//! `cargo run --release --example henon -- henon.jsonl` writes a certificate of both statements, too. Behind the file may stand how often sides
//! are halved, and the most images: `henon.jsonl 10 20000`.

#![allow(clippy::print_stdout)] // a program

use equations::{Formulas, Names};
use hybrid_system::Label;
use std::error::Error;
use std::time::Instant;
use validated_dynamics::{
    Budget, Certificate, Division, Enclosure, FormulaMap, ProvedBasins, ProvedFate, Trap,
    fixed_point,
};

/// Hénon's quadrilateral (1976) with the corners (−1.33, 0.42), (1.32, 0.133), (1.245, −0.14) and (−1.06, −0.5), which the map for a = 1.4 leads into
/// itself: the right of each side.
const STAYS: (&str, [&str; 4]) = (
    "stays",
    [
        "(x + 1.33)*(0.133 - 0.42) - (y - 0.42)*(1.32 + 1.33)",
        "(x - 1.32)*(-0.14 - 0.133) - (y - 0.133)*(1.245 - 1.32)",
        "(x - 1.245)*(-0.5 + 0.14) - (y + 0.14)*(-1.06 - 1.245)",
        "(x + 1.06)*(0.42 + 0.5) - (y + 0.5)*(-1.33 + 1.06)",
    ],
);

/// Where |x| > 1.5 and |y| < 0.4 |x|, the next x is at most 1 − 1.4x² + 0.4|x| < −1.03 |x|, and the next y is 0.3x: orbits stay there, and |x| grows
/// without bound.
const ESCAPES: (&str, [&str; 2]) = ("escapes", ["x^2 - 2.25", "0.16*x^2 - y^2"]);

fn henon(a: &str) -> Result<FormulaMap, Box<dyn Error>> {
    let names = Names::new(&["x", "y"], &[("a", a), ("b", "0.3")])?;
    Ok(FormulaMap::new(Formulas::from_text(names, &["1 - a*x^2 + y", "b*x"])?, 1)?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let begin = Instant::now();
    let calm = henon("0.2")?.recorded();
    let rest = fixed_point(&calm, &[0.9, 0.3], &[])?;
    let trap = Trap::new(&calm, &rest, 100)?;
    let window = [Enclosure::new(-4.0, 4.0), Enclosure::new(-4.0, 4.0)];
    let division = Division { first: 6, last: 9, images: 40_000 };
    let basins = ProvedBasins::new(&[&calm], vec![trap.clone()], &[&window], division)?;
    let share = 100.0 * basins.share(ProvedFate::Trap(0));
    println!(
        "a = 0.2: {share:.1} % of [−4, 4]² converge to x in {}, {:?}",
        rest.point[0],
        begin.elapsed()
    );

    let wild =
        henon("1.4")?.recorded().with_set(STAYS.0, &STAYS.1)?.with_set(ESCAPES.0, &ESCAPES.1)?;
    let around = [Enclosure::new(-1.4, 1.4), Enclosure::new(-0.6, 0.6)];
    let kept = wild.keeps(STAYS.0, &around, Budget { boxes: 100_000, divisions: 16 })?;
    println!("the quadrilateral is led into itself: {} parts, {:?}", kept.len(), begin.elapsed());
    let window = [Enclosure::new(-2.0, 2.0), Enclosure::new(-2.0, 2.0)];
    let number = |place: usize, default: u32| {
        std::env::args().nth(place).and_then(|word| word.parse().ok()).unwrap_or(default)
    };
    let division = Division { first: 6, last: number(2, 12), images: number(3, 150_000) as usize };
    let fates = ProvedBasins::new(&[&wild], Vec::new(), &[&window], division)?;
    let share = |name| Label::new(name).map(|set| fates.share(ProvedFate::Stopped(set)));
    let (stays, escapes) = (share(STAYS.0)?, 1.0 - share(ESCAPES.0)?);
    println!(
        "a = 1.4: of [−2, 2]² a share between {stays} and {escapes} never escapes, {:?}",
        begin.elapsed()
    );

    if let Some(file) = std::env::args().nth(1) {
        let mut certificate = Certificate::new("henon");
        certificate.fixed_point(&calm, &rest)?;
        let trap = certificate.trap(&calm, &trap)?;
        certificate.basins(&calm, &basins, &[trap])?;
        certificate.keeps(&wild, STAYS.0, &around, &kept)?;
        certificate.basins(&wild, &fates, &[])?;
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}
