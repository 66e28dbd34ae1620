//! `prove`: theorems about the basins, each by enclosures that are rounded outwards, with certificates.

use super::certificates::write_certificate;
use super::figure_files::write_figure;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{Grid, Interval, Label};
use hopper_basin::{FIG_9, FigureWindow, basin_raster, first_humps};
use hopper_figures::{Window, draw_pixels, fate_colors, label_png};
use hopper_proof::{
    ProvedCells, ProvedLine, ProvedStrip, Theorem, cells_theorem, crises, everything_hops,
    measures, one_sided, one_sudden, points_theorem, proved_points, proved_strips, rising,
    trap_edges,
};
use journal_figures::{Svg, rgb_png};
use repository_tools::{Folder, Progress, results_folder, say};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub struct Options {
    /// The theorems [default: those that take seconds: one-sudden, one-sided, crisis, traps, everything-hops, rising]
    names: Vec<String>,
    /// Prove every theorem, the areas of figures as well
    #[arg(long, conflicts_with = "names")]
    all: bool,
    /// Pixels of a figure's side
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=16384))]
    size: u32,
    /// Strips of mass ratios in a column of cells: with more of them less area stays open
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    strips: u32,
    /// Folder for certificates and pictures [default: target/proofs in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// The theorems in the order of their proofs; those of the first group take seconds.
const QUICK: [&str; 6] =
    ["one-sudden", "one-sided", "crisis", "traps", "everything-hops", "rising"];
const LONG: [&str; 5] = ["measures", "fig6-points", "fig9-points", "fig6-cells", "fig9-cells"];

/// Humps of the theorems about single humps.
const HUMPS: u64 = 8;

/// Humps whose crisis is enclosed.
const CRISES: u64 = 10;

/// Mass ratios at which the ends of traps are enclosed.
const TRAPS: usize = 1000;

/// Windows that rise, with the largest M.
const RISING: [(u64, f64); 10] = [
    (1, 0.905),
    (2, 0.905),
    (3, 0.905),
    (4, 0.9),
    (5, 0.9),
    (6, 0.9),
    (7, 0.9),
    (8, 0.9),
    (9, 0.9),
    (10, 0.9),
];

/// Mass ratios of the fractions, with the width that is asked for.
const MEASURES: [(f64, f64); 11] = [
    (0.1, 1e-7),
    (0.15, 1e-6),
    (0.2, 1e-7),
    (0.3, 1e-6),
    (0.5, 1e-6),
    (0.8, 1e-6),
    (1.0, 1e-4),
    (2.0, 1e-3),
    (3.0, 1e-3),
    (5.0, 1e-2),
    (10.0, 1e-1),
];

/// The area that may stay open, of Figs. 6 and 9.
const OPEN_OF_FIG_6: f64 = 0.12;
const OPEN_OF_FIG_9: f64 = 0.08;

/// Fig. 6, with the mass ratios that are illegible in our copy taken from 0.02.
fn fig_6() -> FigureWindow {
    let speeds = first_humps(5);
    ((0.02, 1.0), (speeds.left, speeds.right))
}

/// Runs the command.
pub fn run(options: &Options) -> Result<(), Error> {
    let known = QUICK.iter().chain(&LONG);
    let wanted: Vec<&str> = match (options.all, options.names.is_empty()) {
        (true, _) => known.copied().collect(),
        (false, true) => QUICK.to_vec(),
        (false, false) => {
            for name in &options.names {
                if !known.clone().any(|known| known == name) {
                    let all: Vec<&str> = known.copied().collect();
                    return Err(Error::UnknownName {
                        kind: "theorem",
                        name: name.clone(),
                        known: all.join(", "),
                    });
                }
            }
            options.names.iter().map(String::as_str).collect()
        }
    };
    let folder = results_folder(options.out.as_deref(), "proofs")?;
    let mut open = Vec::new();
    for name in wanted {
        let begin = Instant::now();
        let theorem = prove(name, options, &folder)?;
        print(&theorem, begin.elapsed().as_secs_f64())?;
        let (path, bytes) = write_certificate(&theorem, &folder)?;
        say(format_args!("{:8} certificate {}, {bytes} bytes", "", path.display()))?;
        if !theorem.is_proved() {
            open.push(name);
        }
    }
    if open.is_empty() {
        return Ok(());
    }
    Err(Error::CheckFailed(format!("not proved: {}", open.join(", "))))
}

fn print(theorem: &Theorem, seconds: f64) -> Result<(), Error> {
    let word = if theorem.is_proved() { "proved" } else { "OPEN" };
    say(format_args!("{word:8} {}  {seconds:.1} s\n{:8} {}", theorem.name, "", theorem.statement))?;
    for step in &theorem.steps {
        let mark = if step.holds { "holds" } else { "OPEN" };
        say(format_args!("{:8} {mark:6} {}: {}", "", step.claim, step.found))?;
    }
    Ok(())
}

fn prove(name: &str, options: &Options, folder: &Folder) -> Result<Theorem, Error> {
    let by_name = match name {
        "one-sudden" => one_sudden(),
        "one-sided" => one_sided(HUMPS)?,
        "crisis" => crises(CRISES)?,
        "traps" => trap_edges(HUMPS, TRAPS)?,
        "everything-hops" => everything_hops()?,
        "rising" => rising(&RISING)?,
        "measures" => measures(&MEASURES)?,
        "fig6-points" => points("fig6-points", fig_6(), options, folder)?,
        "fig9-points" => points("fig9-points", FIG_9, options, folder)?,
        "fig6-cells" => cells("fig6-cells", fig_6(), OPEN_OF_FIG_6, options, folder)?,
        _ => cells("fig9-cells", FIG_9, OPEN_OF_FIG_9, options, folder)?,
    };
    Ok(by_name)
}

fn grid_of((ratios, speeds): FigureWindow, options: &Options) -> Result<Grid, Error> {
    let side = options.size as usize;
    Ok(Grid {
        x: Interval::new(ratios.0, ratios.1)?,
        y: Interval::new(speeds.0, speeds.1)?,
        columns: side,
        rows: side,
    })
}

/// Every point of a figure.
fn points(
    name: &'static str,
    window: FigureWindow,
    options: &Options,
    folder: &Folder,
) -> Result<Theorem, Error> {
    let grid = grid_of(window, options)?;
    let bar = Progress.bar(name, u64::from(options.size));
    let proved = proved_points(grid, |done| {
        bar.set(done as u64);
        ControlFlow::Continue(())
    })?;
    bar.finish();
    let computed = basin_raster(grid, |_| ControlFlow::Continue(()))?;
    let labels = proved.counts().into_iter().map(|(label, _)| label).collect();
    write(name, window, &label_png(name, &proved)?, labels, folder)?;
    Ok(points_theorem(name, &proved, &computed)?)
}

/// Columns that are stored together: a run that is killed loses at most so many.
const COLUMNS: usize = 16;

/// The strips of all columns of a figure. Those that an earlier run finished are read.
fn strips(
    name: &'static str,
    grid: &Grid,
    strips: usize,
    job: &Job,
) -> Result<Vec<ProvedStrip>, Error> {
    let Grid { columns, rows, .. } = *grid;
    let scan = format!("{name} {columns} by {rows}, {strips} strips");
    let block = |k: usize| {
        let range = k * COLUMNS..columns.min((k + 1) * COLUMNS);
        let found = proved_strips(grid, strips, range, |_| ControlFlow::Continue(()))?;
        Ok(found.iter().flat_map(numbers).collect())
    };
    let rows = job.scan_with(name, &scan, columns.div_ceil(COLUMNS), block)?;
    let stored =
        || Error::CheckFailed(format!("the stored strips of {scan} are damaged: remove them"));
    let mut found = Vec::with_capacity(columns * strips);
    for row in rows {
        let mut numbers = row.into_iter();
        while let Some(strip) = strip(&mut numbers) {
            found.push(strip);
        }
        if numbers.next().is_some() {
            return Err(stored());
        }
    }
    Ok(found)
}

/// A strip as numbers: its ends, how many intervals, and the ends and the label of each.
fn numbers((own, line): &ProvedStrip) -> Vec<f64> {
    let intervals = line.intervals();
    let head = [own.left, own.right, intervals.len() as f64];
    let each =
        intervals.iter().flat_map(|(own, label)| [own.left, own.right, f64::from(label.code())]);
    head.into_iter().chain(each).collect()
}

/// The next strip of such numbers; `None` at their end.
fn strip(numbers: &mut impl Iterator<Item = f64>) -> Option<ProvedStrip> {
    let (left, right, count) = (numbers.next()?, numbers.next()?, numbers.next()?);
    let mut interval = || {
        let (left, right, label) = (numbers.next()?, numbers.next()?, numbers.next()?);
        Some((Interval { left, right }, Label::from_code(label as u16)))
    };
    let intervals = (0..count as usize).map(|_| interval()).collect::<Option<Vec<_>>>()?;
    Some((Interval { left, right }, ProvedLine::restored(intervals)))
}

/// Every cell of a figure: its colour mixes those of the basins by their proved shares, and yellow by the share that is open.
fn cells(
    name: &'static str,
    window: FigureWindow,
    open: f64,
    options: &Options,
    folder: &Folder,
) -> Result<Theorem, Error> {
    let grid = grid_of(window, options)?;
    let job = Job::new(folder.path())?;
    let strips = strips(name, &grid, options.strips as usize, &job)?;
    let found = ProvedCells::of_strips(grid, strips)?;
    // A picture has its highest row first.
    let shares = found.shares()?;
    let rows = shares.chunks(grid.columns).rev().flatten();
    let pixels: Vec<u8> = rows.flat_map(|cell| fate_colors::mixed(cell.iter().copied())).collect();
    let png = rgb_png(name, grid.columns, grid.rows, &pixels)?;
    let mut labels: Vec<_> = found.areas.iter().map(|&(label, _)| label).collect();
    labels.push(hopper_basin::HopperFate::UNDECIDED);
    write(name, window, &png, labels, folder)?;
    job.done()?;
    Ok(cells_theorem(name, found, open)?)
}

fn write(
    name: &'static str,
    (mass_ratio, alpha): FigureWindow,
    png: &[u8],
    labels: Vec<basin_of_attraction::Label>,
    folder: &Folder,
) -> Result<(), Error> {
    let window = Window { name, mass_ratio, alpha, inset: None, tick_counts: (6, 8) };
    let svg: Svg = draw_pixels(&window, png, labels.into_iter());
    let figure = Figure {
        name,
        title: name.into(),
        paper: String::new(),
        notes: String::new(),
        svg,
        data: Vec::new(),
    };
    write_figure(folder, &figure)?;
    say(format_args!("figure   {}", folder.path().join(format!("{name}.png")).display()))?;
    Ok(())
}
