//! `scale`: CPU time of rasters by size, and what many workers gain.

use crate::error::Error;
use crate::repository::{Folder, Progress, read, repository, say};
use crate::scale::{growth_per_doubling, measure, plan, table};
use crate::text::replace_block;

/// The smallest raster. Each further one has twice the side.
const SMALLEST: u64 = 1024;

/// The growth if neighbouring pixels share nothing more: the number of pixels grows by 4.
const NONE_SHARED: f64 = 4.0;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Pixels along each side of the largest raster; 32768 takes minutes of CPU time
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = clap::value_parser!(u64).range(2 * SMALLEST..=1 << 17))]
    largest: u64,
    /// Renew the tables of docs/scale.md
    #[arg(long)]
    bless: bool,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let sides: Vec<u64> = std::iter::successors(Some(SMALLEST), |side| Some(2 * side))
        .take_while(|&side| side <= options.largest)
        .collect();
    let bar = Progress.bar("scale", sides.len() as u64);
    let mut rasters = Vec::new();
    for &side in &sides {
        rasters.push(measure(side as usize)?);
        bar.set(rasters.len() as u64);
    }
    bar.finish();
    let points: Vec<_> = rasters.iter().map(|raster| (raster.side, raster.seconds())).collect();
    let unmeasured = || Error::CheckFailed("the CPU time of a raster is zero".into());
    let growth = growth_per_doubling(&points).ok_or_else(unmeasured)?;
    let largest = rasters.last().ok_or_else(unmeasured)?;
    let (fitted, none_shared) = (plan(largest, growth), plan(largest, NONE_SHARED));
    let blocks = [
        ("cost", table::cost(&rasters, Some(growth))),
        ("model", table::model()),
        ("one raster", table::one_raster(largest)),
        ("large", table::large(&fitted, growth, &none_shared)),
    ];
    for (_, text) in &blocks {
        say(format!("{}\n", text.trim_end()))?;
    }
    if options.bless {
        let docs = Folder::open(&repository().join("docs"))?;
        let mut page = read(&docs.path().join("scale.md"))?;
        for (name, text) in &blocks {
            page = replace_block(&page, name, text)?;
        }
        docs.write("scale.md", page.as_bytes())?;
    }
    Ok(())
}
