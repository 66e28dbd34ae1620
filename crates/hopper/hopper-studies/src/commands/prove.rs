//! `prove`: theorems about the basins, each by enclosures that are rounded outwards, with certificates.

use super::certificates::write_certificate;
use super::figure_files::write_figure;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use crate::proved_figure::{StoredStrips, draw_window, fig_6};
use crate::repository::{Folder, Progress, results_folder, say};
use basin_of_attraction::{Grid, Interval};
use hopper_basin::{FIG_9, FigureWindow, basin_raster};
use hopper_figures::label_png;
use hopper_proof::{
    CertificateLine, QUICK_THEOREMS, QuickTheorem, Theorem, cells_theorem, measures,
    points_theorem, proved_points,
};
use journal_figures::Svg;
use std::io::ErrorKind;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// The theorems [default: those that take seconds]
    names: Vec<String>,
    /// Prove every theorem, the areas of figures as well
    #[arg(long, conflicts_with = "names")]
    all: bool,
    /// Prove every theorem as the gate does: those that take long on few pixels, or coarsely
    #[arg(long, conflicts_with_all = ["names", "all"])]
    gate: bool,
    /// Pixels of a figure's side
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=16384))]
    size: u32,
    /// Strips of mass ratios in a column of cells: with more of them less area stays open
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    strips: u32,
    /// The share of a figure's area that may stay open [default: 0.12 for fig6-cells, 0.08 for fig9-cells]
    #[arg(long, value_name = "SHARE")]
    open: Option<f64>,
    /// The only mass ratio of `measures` [default: those of the table, each to a width of its own]
    #[arg(short = 'M', long, value_name = "M", requires = "width")]
    mass_ratio: Option<f64>,
    /// The width of its fractions
    #[arg(long, value_name = "WIDTH", requires = "mass_ratio")]
    width: Option<f64>,
    /// Folder for certificates and pictures [default: target/proofs in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// A theorem that the command proves.
#[derive(Clone, Copy)]
struct Provable {
    name: &'static str,
    /// What the gate sets, of a theorem that does not take seconds.
    gate: Option<fn(&mut Options)>,
    proof: Proof,
}

/// How a theorem is proved.
#[derive(Clone, Copy)]
enum Proof {
    Quick(fn() -> Result<Theorem, hopper_proof::Error>),
    /// The fractions of basins.
    Fractions,
    /// For every point of a figure.
    Points(fn() -> FigureWindow),
    /// For every cell of a figure, of whose area this share may stay open.
    Cells(fn() -> FigureWindow, f64),
}

/// The theorems that take long, in the order of their proofs: they follow [`QUICK_THEOREMS`].
static LONG_THEOREMS: &[Provable] = &[
    long(
        "measures",
        |options| (options.mass_ratio, options.width) = (Some(0.1), Some(1e-3)),
        Proof::Fractions,
    ),
    long("fig6-points", |options| options.size = 16, Proof::Points(fig_6)),
    long("fig9-points", |options| options.size = 16, Proof::Points(|| FIG_9)),
    // So few cells leave most of their area open.
    long("fig6-cells", |options| few_cells(options, 0.96), Proof::Cells(fig_6, 0.12)),
    long("fig9-cells", |options| few_cells(options, 0.81), Proof::Cells(|| FIG_9, 0.08)),
];

const fn long(name: &'static str, gate: fn(&mut Options), proof: Proof) -> Provable {
    Provable { name, gate: Some(gate), proof }
}

/// All theorems.
fn theorems() -> impl Iterator<Item = Provable> {
    let quick =
        |(name, prove): &QuickTheorem| Provable { name, gate: None, proof: Proof::Quick(*prove) };
    QUICK_THEOREMS.iter().map(quick).chain(LONG_THEOREMS.iter().copied())
}

fn few_cells(options: &mut Options, open: f64) {
    (options.size, options.open) = (4, Some(open));
}

/// Mass ratios of the fractions, with the width that is asked for. The last ones take longest.
const MEASURES: [(f64, f64); 11] = [
    (0.1, 1e-9),
    (0.15, 1e-9),
    (0.2, 1e-9),
    (0.3, 1e-9),
    (0.5, 2e-9),
    (0.8, 1e-9),
    (1.0, 1e-9),
    (2.0, 2e-6),
    (3.0, 1e-5),
    (5.0, 1e-4),
    (10.0, 1e-3),
];

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let wanted: Vec<Provable> = match options.names.as_slice() {
        _ if options.all || options.gate => theorems().collect(),
        [] => theorems().filter(|theorem| theorem.gate.is_none()).collect(),
        names => names.iter().map(|name| named(name)).collect::<Result<_, Error>>()?,
    };
    let folder = results_folder(options.out.as_deref(), "proofs")?;
    let mut open = Vec::new();
    for theorem in wanted {
        let mut own = options.clone();
        if let Some(gate) = theorem.gate.filter(|_| options.gate) {
            gate(&mut own);
        }
        let proved = theorem.prove(&own, &folder);
        if !matches!(proved, Ok(true)) {
            set_certificate_aside(theorem.name, &folder)?;
        }
        if !proved? {
            open.push(theorem.name);
        }
    }
    if open.is_empty() {
        return Ok(());
    }
    Err(Error::CheckFailed(format!("not proved: {}", open.join(", "))))
}

/// Renames the certificate of an earlier run: it would pass for one of this run, and may be the work of hours.
fn set_certificate_aside(name: &str, folder: &Folder) -> Result<(), Error> {
    let path = folder.path().join(format!("{name}.jsonl"));
    let aside = folder.path().join(format!("{name}.jsonl.earlier"));
    match std::fs::rename(&path, &aside) {
        Ok(()) => say(format_args!("{:8} that of an earlier run: {}", "", aside.display())),
        Err(source) if source.kind() == ErrorKind::NotFound => Ok(()),
        Err(source) => Err(Error::File { path, source }),
    }
}

/// The theorem of a name.
fn named(name: &str) -> Result<Provable, Error> {
    theorems().find(|theorem| theorem.name == name).ok_or_else(|| {
        let known: Vec<&str> = theorems().map(|theorem| theorem.name).collect();
        Error::UnknownName { kind: "theorem", name: name.to_owned(), known: known.join(", ") }
    })
}

impl Provable {
    /// Proves the theorem, and writes its certificate: whether it is proved.
    fn prove(&self, options: &Options, folder: &Folder) -> Result<bool, Error> {
        let begin = Instant::now();
        let theorem = match self.proof {
            Proof::Quick(prove) => prove()?,
            Proof::Fractions => fractions(options)?,
            Proof::Points(window) => points(self.name, window(), options, folder)?,
            Proof::Cells(window, most_open) => {
                return cells(self.name, window(), most_open, options, folder);
            }
        };
        report(&theorem, begin, std::iter::empty(), folder)
    }
}

/// Prints a theorem and writes its certificate, if it is proved: whether it is.
fn report(
    theorem: &Theorem,
    begin: Instant,
    strips: impl Iterator<Item = Result<CertificateLine, Error>>,
    folder: &Folder,
) -> Result<bool, Error> {
    let word = if theorem.is_proved() { "proved" } else { "OPEN" };
    let seconds = begin.elapsed().as_secs_f64();
    say(format_args!("{word:8} {}  {seconds:.1} s\n{:8} {}", theorem.name, "", theorem.statement))?;
    for step in &theorem.steps {
        let mark = if step.holds { "holds" } else { "OPEN" };
        say(format_args!("{:8} {mark:6} {}: {}", "", step.claim, step.found))?;
    }
    if !theorem.is_proved() {
        say(format_args!("{:8} no certificate: the statement is open", ""))?;
        return Ok(false);
    }
    let (path, bytes) = write_certificate(theorem, strips, folder)?;
    say(format_args!("{:8} certificate {}, {bytes} bytes", "", path.display()))?;
    Ok(true)
}

/// The fractions at one mass ratio, or at those of the table.
fn fractions(options: &Options) -> Result<Theorem, Error> {
    let own = options.mass_ratio.zip(options.width).map(|own| vec![own]);
    let cases = own.unwrap_or_else(|| MEASURES.to_vec());
    let bar = Progress.bar("measures", cases.len() as u64);
    let theorem = measures(&cases, |done| bar.set(done as u64))?;
    bar.finish();
    Ok(theorem)
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
    let labels = proved.counts().into_iter().map(|(label, _)| label);
    let drawn = draw_window(name, window, &label_png(name, &proved)?, labels);
    write(name, drawn, folder)?;
    Ok(points_theorem(name, &proved, &computed)?)
}

/// Every cell of a figure. Finished strips are kept until the certificate is written from them.
fn cells(
    name: &'static str,
    window: FigureWindow,
    most_open: f64,
    options: &Options,
    folder: &Folder,
) -> Result<bool, Error> {
    let begin = Instant::now();
    let job = Job::new(folder.path())?;
    let strips = StoredStrips::new(name, grid_of(window, options)?, options.strips as usize, &job);
    let (found, drawn) = strips.cells(name, window)?;
    write(name, drawn, folder)?;
    let theorem = cells_theorem(name, &found, options.open.unwrap_or(most_open))?;
    let is_proved = report(&theorem, begin, strips.evidence()?, folder)?;
    job.done()?;
    Ok(is_proved)
}

fn write(name: &'static str, svg: Svg, folder: &Folder) -> Result<(), Error> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[derive(clap::Parser)]
    struct Command {
        #[command(flatten)]
        options: Options,
    }

    /// A run whose statement stays open, and one that ends in an error, leave no certificate, whatever was there.
    #[test]
    fn a_run_that_does_not_prove_leaves_no_certificate() {
        let folder = std::env::temp_dir().join(format!("prove_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let prove = |arguments: &[&str]| {
            let name = arguments[0];
            let path = folder.join(format!("{name}.jsonl"));
            std::fs::write(&path, "of an earlier run").unwrap();
            let out = ["prove", "--out", folder.to_str().unwrap()];
            let words = out.iter().chain(arguments);
            let ended = run(&<Command as clap::Parser>::parse_from(words).options);
            (ended, std::fs::read_to_string(path).ok())
        };
        let (ended, file) = prove(&["fig6-cells", "--size", "1", "--open", "0"]);
        assert!(matches!(ended, Err(Error::CheckFailed(_))), "{ended:?}");
        assert_eq!(file, None);
        let aside = std::fs::read_to_string(folder.join("fig6-cells.jsonl.earlier"));
        assert_eq!(aside.unwrap(), "of an earlier run");
        let (ended, file) = prove(&["measures", "-M=-1", "--width", "0.1"]);
        assert!(ended.is_err() && !matches!(ended, Err(Error::CheckFailed(_))), "{ended:?}");
        assert_eq!(file, None);
        let (ended, file) = prove(&["one-sudden"]);
        assert!(ended.is_ok() && file.unwrap().contains("one-sudden"));
        std::fs::remove_dir_all(folder).unwrap();
    }

    /// The second program compares what a certificate proves with this list, and makes false certificates of each
    /// theorem in it.
    #[test]
    fn the_second_program_has_a_statement_for_every_theorem() {
        let path =
            concat!(env!("CARGO_MANIFEST_DIR"), "/../../../xtask/generators/statements.json");
        let text = std::fs::read_to_string(path).unwrap();
        let statements: serde_json::Map<String, serde_json::Value> =
            serde_json::from_str(&text).unwrap();
        let stated: BTreeSet<&str> = statements.keys().map(String::as_str).collect();
        assert_eq!(stated, theorems().map(|theorem| theorem.name).collect());
    }
}
