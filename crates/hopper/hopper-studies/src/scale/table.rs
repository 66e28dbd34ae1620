//! The measured and simulated numbers as text for `docs/scale.md`.

use super::plan::{SIDE, WINDOWS};
use super::simulation::{LOST_ONE_IN, SLOW_ONE_IN, SLOWER, START_UP};
use super::{Finished, Plan, Raster, simulate};
use crate::text::markdown_table;
use std::fmt::Write as _;

/// Workers of the simulations.
const WORKERS: [usize; 5] = [1, 10, 100, 1000, 10_000];

/// Cost and storage by size, with the fitted growth.
pub(crate) fn cost(rasters: &[Raster], growth: Option<f64>) -> String {
    let row = |raster: &Raster| {
        let Raster { side, tiles, bytes } = raster;
        let seconds = raster.seconds();
        format!(
            "{side} | {} | {seconds:.2} s | {:.1} ns | {:.0} ms | {bytes} bytes",
            tiles.len(),
            seconds * 1e9 / (*side as f64 * *side as f64),
            1e3 * raster.longest(),
        )
    };
    let columns = "N: | tiles: | CPU time: | per pixel: | longest tile: | `.npy`:";
    let mut out = markdown_table(columns, rasters.iter().map(row));
    if let Some(growth) = growth {
        let _ = write!(
            out,
            "\nThe time grows by a factor of {growth:.2} for each doubling of N (least squares over these sizes); \
             the number of pixels grows by 4."
        );
    }
    out
}

/// What workers gain on the largest measured raster.
pub(crate) fn one_raster(raster: &Raster) -> String {
    format!(
        "The tiles of {0}² pixels, simulated:\n\n{1}\nMore than {2} workers have no tile. The longest tile takes \
         {3:.0} ms, \
         and the start of a worker {START_UP} s: {0}² pixels are too few for a cluster.",
        raster.side,
        workers(&[("", &raster.tiles)]),
        raster.tiles.len(),
        1e3 * raster.longest(),
    )
}

/// What workers gain on 10¹² pixels, with the fitted growth, and with growth 4: nothing more is shared by neighbours.
pub(crate) fn large(fitted: &Plan, growth: f64, none_shared: &Plan) -> String {
    let of = |plan: &Plan| {
        let longest = plan.tiles.iter().copied().fold(0.0, f64::max);
        let total = plan.tiles.iter().sum::<f64>();
        (total / 3600.0, longest, total / longest)
    };
    let ((low, shortest, useful), (high, longest, _)) = (of(fitted), of(none_shared));
    let side = SIDE / WINDOWS;
    format!(
        "{SIDE}² pixels are {} windows of {side}², with {} tiles and {:.2e} bytes of labels as `.npy`. From the \
         largest size \
         measured, a growth of {growth:.2} per doubling gives {low:.1} hours of CPU time, and a growth of 4 gives \
         {high:.1} hours.\n\n\
         {}\nThe longest tile takes {shortest:.2} s, or {longest:.2} s. Beyond {useful:.0} workers it takes longer \
         than a worker's share of \
         the work. The start of {START_UP} s decides earlier: a worker is lost for one tile in {LOST_ONE_IN}, so that \
         each tile costs \
         {:.2} s of restarts on average, and tiles that take less are too small for such a cluster.",
        WINDOWS * WINDOWS,
        fitted.tiles.len(),
        2.0 * (SIDE as f64 * SIDE as f64),
        workers(&[
            (&format!(", growth {growth:.2}"), &fitted.tiles),
            (", growth 4", &none_shared.tiles)
        ]),
        START_UP / LOST_ONE_IN as f64,
    )
}

/// The model of the simulation, in two sentences.
pub(crate) fn model() -> String {
    format!(
        "Every worker takes the next tile of one queue as soon as it is free, begins {START_UP} s after its start, and \
         takes {SLOWER} times as long for one tile in {SLOW_ONE_IN}. One try in {LOST_ONE_IN} is lost at a random \
         instant with its worker: the tile goes to the end of the queue, and another worker starts."
    )
}

fn workers(jobs: &[(&str, &[f64])]) -> String {
    let mut columns = String::from("workers:");
    for (name, _) in jobs {
        columns += &format!(" | time{name}: | work / all time{name}: | lost tries{name}:");
    }
    let cells = |workers: usize, tiles: &[f64]| {
        let Finished { seconds, lost, efficiency } = simulate(tiles, workers);
        format!(" | {} | {:.1} % | {lost}", long(seconds), 100.0 * efficiency)
    };
    let row = |workers: usize| {
        let cells: String = jobs.iter().map(|(_, tiles)| cells(workers, tiles)).collect();
        format!("{workers}{cells}")
    };
    markdown_table(&columns, WORKERS.map(row))
}

/// A time of seconds to days.
fn long(seconds: f64) -> String {
    match seconds {
        s if s < 600.0 => format!("{s:.1} s"),
        s if s < 3600.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_of_workers_has_a_line() {
        let raster = Raster { side: 64, tiles: vec![0.5, 1.0, 1.5, 1.0], bytes: 8320 };
        let text = one_raster(&raster);
        assert!(
            WORKERS.iter().all(|workers| text.contains(&format!("\n| {workers} | "))),
            "{text}"
        );
        assert!(
            cost(&[raster], Some(3.0))
                .contains("| 64 | 4 | 4.00 s | 976562.5 ns | 1500 ms | 8320 bytes |")
        );
        assert!(long(1e4) == "2.8 h" && long(2.0) == "2.0 s" && long(1200.0) == "20 min");
    }
}
