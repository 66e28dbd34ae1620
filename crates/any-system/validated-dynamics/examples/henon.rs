//! The Hénon map (x, y) → (1 − a x² + y, b x), b = 0.3. At a = 0.2: the basin of its fixed point in [−4, 4]², cell by cell. At a = 1.4: the share of [−2, 2]²
//! from which orbits never escape, from both sides.
//!
//! `cargo run --release --example henon -- henon.jsonl` writes a certificate of the first statement, too.

#![allow(clippy::print_stdout)] // a program

use equations::{Formulas, Names};
use std::error::Error;
use std::time::Instant;
use validated_dynamics::{
    AffineSet, Certificate, Division, EnclosedMap, Enclosure, FormulaMap, ProvedBasins, ProvedFate,
    StartSet, Trap, fixed_point, halves,
};

/// Hénon's quadrilateral (1976), which the map for a = 1.4 leads into itself.
const QUADRILATERAL: [[f64; 2]; 4] = [[-1.33, 0.42], [1.32, 0.133], [1.245, -0.14], [-1.06, -0.5]];

/// The most steps that a cell is followed, and the most divisions of the window.
const STEPS: usize = 60;
const DIVISIONS: u32 = 11;

/// The side of the window.
const WINDOW: Enclosure = Enclosure::new(-2.0, 2.0);

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

    let wild = henon("1.4")?;
    println!("the quadrilateral is led into itself: {}", is_absorbing(&wild)?);
    let (mut stays, mut escapes) = (0.0, 0.0);
    let mut left = vec![(vec![WINDOW, WINDOW], 0)];
    while let Some((cell, divisions)) = left.pop() {
        match fate(&wild, &cell)? {
            // Cells are squares with sides that are powers of 2: their areas are exact.
            Some(true) => stays += cell[0].width() * cell[1].width() / 16.0,
            Some(false) => escapes += cell[0].width() * cell[1].width() / 16.0,
            None if divisions < DIVISIONS => {
                left.extend(halves(&cell).into_iter().map(|part| (part, divisions + 1)));
            }
            None => {}
        }
    }
    println!(
        "a = 1.4: of [−2, 2]² a share between {stays} and {} never escapes, {:?}",
        1.0 - escapes,
        begin.elapsed()
    );

    if let Some(file) = std::env::args().nth(1) {
        let mut certificate = Certificate::new("henon");
        certificate.fixed_point(&calm, &rest)?;
        let trap = certificate.trap(&calm, &trap)?;
        certificate.basins(&calm, &basins, &[trap])?;
        std::fs::write(file, certificate.text())?;
    }
    Ok(())
}

/// True for a cell all of whose orbits stay, false for one all of whose orbits escape.
///
/// Where x ≤ −2 and |y| ≤ |x|, the next x is at most 1 − 1.4x² + |x| ≤ −1.3|x|, and the next y is 0.3x: orbits stay there, and escape. Where
/// x ≥ 2 and |y| ≤ |x| the same bound holds for the next x.
fn fate(map: &FormulaMap, cell: &[Enclosure]) -> Result<Option<bool>, Box<dyn Error>> {
    let mut set = AffineSet::of_box(cell);
    for _ in 0..STEPS {
        let [x, y] = set.hull() else { return Ok(None) };
        if x.low().abs().min(x.high().abs()) >= 2.0
            && x.sign().is_some()
            && y.magnitude() <= x.low().abs().min(x.high().abs())
        {
            return Ok(Some(false));
        }
        if is_inside(&set) {
            return Ok(Some(true));
        }
        if x.width() > 4.0 {
            return Ok(None);
        }
        set = map.carry(StartSet::of_set(&set).without_derivatives())?.set;
    }
    Ok(None)
}

/// True if a set is in the quadrilateral: on the right of each side, from corner to corner.
fn is_inside(set: &AffineSet) -> bool {
    sides().all(|([x, y], [to_x, to_y])| {
        let exact = Enclosure::from;
        let (along, up) = (exact(to_x) - exact(x), exact(to_y) - exact(y));
        let side = (set.hull()[0] - x) * up - (set.hull()[1] - y) * along;
        side.is_positive()
    })
}

fn sides() -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    (0..4).map(|corner| (QUADRILATERAL[corner], QUADRILATERAL[(corner + 1) % 4]))
}

/// True if the quadrilateral is led into itself. It is if its sides are led into it, for the map is continuous and one to one: parts of the sides
/// are followed.
fn is_absorbing(map: &FormulaMap) -> Result<bool, Box<dyn Error>> {
    const PARTS: usize = 20_000;
    for ([x, y], [to_x, to_y]) in sides() {
        for part in 0..PARTS {
            let share =
                Enclosure::new(part as f64, part as f64 + 1.0) / Enclosure::from(PARTS as f64);
            let point = [(x, to_x), (y, to_y)]
                .map(|(from, to)| (Enclosure::from(to) - from) * share + from);
            let image = map.carry(StartSet::of_box(&point).without_derivatives())?;
            if !is_inside(&image.set) {
                return Ok(false);
            }
        }
    }
    Ok(true)
}
