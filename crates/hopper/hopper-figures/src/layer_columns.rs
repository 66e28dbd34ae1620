//! The pixels of each layer, some columns at a time.

use crate::coverage::coverage_pixels;
use crate::error::Error;
use crate::layers::FLAG;
use basin_of_attraction::{Grid, Label};
use hopper_basin::{
    CoverageColumn, CoverageLimits, Fates, ShareColumn, ShareRaster, Upwards, basin_columns,
};
use hopper_proof::ProvedPoints;
use passive_hopper::MassRatio;
use std::ops::Range;

/// Some columns of a raster.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerColumns {
    /// The raster.
    pub grid: Grid,
    /// Whether its columns are equally far apart in log₂ M: then `grid.x` is log₂ M.
    pub logarithmic: bool,
    /// The columns.
    pub columns: Range<usize>,
}

impl LayerColumns {
    /// The mass ratio of a column.
    ///
    /// # Errors
    /// [`Error::Hopper`] for one that is not positive and finite.
    pub fn mass_ratio(&self, column: usize) -> Result<MassRatio, Error> {
        let x = self.grid.x_at(column);
        Ok(MassRatio::new(if self.logarithmic { pxfm::f_exp2(x) } else { x })?)
    }

    /// The speeds of the rows, from below.
    pub fn speeds(&self) -> Vec<f64> {
        (0..self.grid.rows).map(|row| self.grid.y_at(row)).collect()
    }

    /// What a function gives for each column.
    pub(crate) fn each<T>(
        &self,
        of: impl Fn(MassRatio) -> Result<T, Error>,
    ) -> Result<Vec<T>, Error> {
        self.columns.clone().map(|column| of(self.mass_ratio(column)?)).collect()
    }
}

/// The codes of the labels. On the linear axis columns that lie next to each other are followed together.
pub(crate) fn fates(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    let labels: Vec<Vec<Label>> = if of.logarithmic {
        let speeds = of.speeds();
        of.each(|ratio| Ok(Fates::new(ratio)?.labels(&speeds)?))?
    } else {
        basin_columns(&of.grid, of.columns.clone())?
    };
    let codes = |column: Vec<Label>| column.iter().map(|label| u64::from(label.code())).collect();
    Ok(labels.into_iter().map(codes).collect())
}

/// The numbers of hops until the fates are known.
pub(crate) fn hops(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    let speeds = of.speeds();
    of.each(|ratio| Ok(Fates::new(ratio)?.hop_counts(&speeds)?))
}

/// The codes of the labels, with the flag where the fate is proved.
pub(crate) fn proofs(of: &LayerColumns) -> Result<Vec<Vec<u64>>, Error> {
    let speeds = of.speeds();
    of.each(|ratio| {
        let computed = Fates::new(ratio)?.labels(&speeds)?;
        let mut points = ProvedPoints::new(ratio.value())?;
        let value = |(&speed, computed): (&f64, Label)| {
            let proved = points.label(speed)?;
            Ok(match proved.is_undecided() {
                true => u64::from(computed.code()),
                false => u64::from(proved.code()) | FLAG,
            })
        };
        speeds.iter().zip(computed).map(value).collect()
    })
}

/// The pixels of the exact coverage.
pub(crate) fn shares(of: &LayerColumns) -> Result<Vec<u8>, Error> {
    if of.columns.is_empty() {
        return Ok(Vec::new());
    }
    let found = of.each(|ratio| {
        let fates = Fates::new(ratio)?;
        let own = CoverageColumn::new(&fates, of.grid.y, of.grid.rows, CoverageLimits::default())?;
        Ok(Some(ShareColumn::from(&own)))
    })?;
    let part = Grid { columns: of.columns.len(), ..of.grid };
    Ok(coverage_pixels(&ShareRaster::from_columns(part, Upwards::LiftOffSpeed, found)?))
}
