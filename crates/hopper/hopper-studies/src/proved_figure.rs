//! Every cell of a figure, proved: computed in pieces that are kept, and drawn.

use crate::error::Error;
use crate::job::Job;
use crate::repository::Progress;
use basin_of_attraction::{Grid, Interval, Label};
use hopper_basin::{FigureWindow, HopperFate, first_humps};
use hopper_figures::{BasinWindow, draw_pixels, fate_colors};
use hopper_proof::{CertificateLine, ProvedCells, ProvedLine, ProvedStrip, proved_strips};
use journal_figures::{Svg, rgb_png};
use std::ops::ControlFlow;

/// Columns that are stored together: a run that is killed loses at most so many.
const COLUMNS: usize = 16;

/// Fig. 6, with the mass ratios that are illegible in our copy taken from 0.02.
pub(crate) fn fig_6() -> FigureWindow {
    let speeds = first_humps(5);
    ((0.02, 1.0), (speeds.left, speeds.right))
}

/// The strips of a raster. Each is computed once and stored, and read when it is needed again: all together need
/// more memory than cells do.
pub(crate) struct StoredStrips<'a> {
    job: &'a Job,
    name: &'static str,
    grid: Grid,
    strips: usize,
}

impl<'a> StoredStrips<'a> {
    /// `strips` strips of each column, stored under a name. Those that an earlier run of the job finished are read.
    pub(crate) fn new(name: &'static str, grid: Grid, strips: usize, job: &'a Job) -> Self {
        StoredStrips { job, name, grid, strips }
    }

    fn number_of_blocks(&self) -> usize {
        self.grid.columns.div_ceil(COLUMNS)
    }

    /// The strips of all columns, in blocks of columns from the left.
    fn blocks(&self) -> Result<impl Iterator<Item = Result<Vec<ProvedStrip>, Error>>, Error> {
        let Grid { columns, rows, .. } = self.grid;
        let compute = move |k: usize| {
            let range = k * COLUMNS..columns.min((k + 1) * COLUMNS);
            let found =
                proved_strips(&self.grid, self.strips, range, |_| ControlFlow::Continue(()))?;
            Ok(found.iter().flat_map(numbers).collect())
        };
        let scan = format!("{} {columns} by {rows}, {} strips", self.name, self.strips);
        let mut kept = self.job.rows(&scan)?;
        let block = move |k: usize| {
            let mut numbers = kept.next(|| compute(k))?.into_iter();
            Ok(std::iter::from_fn(|| strip(&mut numbers)).collect())
        };
        Ok((0..self.number_of_blocks()).map(block))
    }

    /// The cells, with their picture: a colour mixes those of the basins by their proved shares, and yellow by the
    /// share that is open.
    pub(crate) fn cells(
        &self,
        figure: &'static str,
        window: FigureWindow,
    ) -> Result<(ProvedCells, Svg), Error> {
        let Grid { columns, rows, .. } = self.grid;
        let mut found = ProvedCells::new(self.grid, self.strips)?;
        let mut pixels = vec![[0; 3]; columns * rows];
        let bar = Progress.bar(self.name, self.number_of_blocks() as u64);
        for (block, k) in self.blocks()?.zip(1..) {
            for strips in block?.chunks(self.strips) {
                let column = found.columns_added();
                for (shares, row) in found.add_column(strips)?.into_iter().zip(1..) {
                    // A picture has its highest row first.
                    pixels[(rows - row) * columns + column] =
                        fate_colors::mixed(shares.into_iter());
                }
            }
            bar.set(k);
        }
        bar.finish();
        let png = rgb_png(figure, columns, rows, pixels.as_flattened())?;
        let basins = found.areas().into_iter().map(|(label, _)| label);
        let svg = draw_window(figure, window, &png, basins.chain([HopperFate::UNDECIDED]));
        Ok((found, svg))
    }

    /// The lines of the strips in a certificate.
    pub(crate) fn evidence(
        &self,
    ) -> Result<impl Iterator<Item = Result<CertificateLine, Error>>, Error> {
        let lines = |block: Result<Vec<ProvedStrip>, Error>| match block {
            Ok(strips) => {
                strips.into_iter().map(|strip| Ok(CertificateLine::of_strip(strip))).collect()
            }
            Err(error) => vec![Err(error)],
        };
        Ok(self.blocks()?.flat_map(lines))
    }
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

/// Pixels over mass ratio and lift-off speed, with the legend of these labels.
pub(crate) fn draw_window(
    name: &'static str,
    (mass_ratio, alpha): FigureWindow,
    png: &[u8],
    labels: impl Iterator<Item = Label>,
) -> Svg {
    let window = BasinWindow { name, mass_ratio, alpha, inset: None, tick_counts: (6, 8) };
    draw_pixels(&window, png, labels)
}
