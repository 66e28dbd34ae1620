//! Images of labels: fractions, boxes, entropies.

use super::interval::Interval;
use crate::arrays::shaped;
use crate::basins::Bounds;
use crate::errors::value_error;
use crate::interruptible::{Watch, in_background};
use crate::pickling::{Reduced, plain, reduced};
use crate::whole::whole;
use basin_of_attraction::{Grid, Label, Ln2Criterion};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyType;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Labels of the pixels of a window: an array of uint16 with the shape (x, y).
///
/// nonsmooth.labelling.label_image makes it of any array of integers.
#[pyclass(frozen, eq, module = "nonsmooth.labelling")]
#[derive(Debug, PartialEq)]
pub(crate) struct LabelImage {
    image: Arc<basin_of_attraction::LabelImage>,
}

/// A count of boxes of one size.
#[pyclass(frozen, get_all, eq, module = "nonsmooth.labelling")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BoxCount {
    /// The side, in pixels.
    size: f64,
    /// All boxes.
    boxes: u64,
    /// Boxes with more than one basin.
    mixed: u64,
    /// Boxes with at most one basin, and with undecided pixels.
    open: u64,
    /// The mean entropy of all boxes, in nats.
    basin_entropy: f64,
    /// The mean entropy of the mixed boxes; None if there are none.
    boundary_entropy: Option<f64>,
}

#[pymethods]
impl LabelImage {
    #[new]
    fn new(labels: PyReadonlyArray2<'_, u16>) -> PyResult<Self> {
        let view = labels.as_array();
        let (columns, rows) = view.dim();
        // Only counts of pixels are asked for: the window has the pixels as its unit.
        let side = |pixels: usize| basin_of_attraction::Interval::new(0.0, pixels as f64);
        let (x, y) = (side(columns).map_err(value_error)?, side(rows).map_err(value_error)?);
        // The array has the pixels of a column beside each other, the image those of a row.
        let labels = view.t().iter().map(|&code| Label::from_code(code)).collect();
        let image = basin_of_attraction::LabelImage { grid: Grid { x, y, columns, rows }, labels };
        image.check().map_err(value_error)?;
        Ok(LabelImage { image: Arc::new(image) })
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyType>, (Bound<'py, PyAny>,))> {
        let labels = Self::array(slf.get(), slf.py())?;
        Ok((slf.get_type(), (labels,)))
    }

    /// The labels, an array of uint16 with the shape (x, y).
    fn array<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Grid { columns, rows, .. } = self.image.grid;
        let pixel = |column: usize| (0..rows).map(move |row| row * columns + column);
        let codes = (0..columns).flat_map(pixel).map(|at| self.image.labels[at].code());
        shaped(py, codes.collect::<Vec<u16>>(), &[columns, rows])
    }

    /// The number of pixels of each label.
    fn counts(&self) -> BTreeMap<u16, usize> {
        self.image.counts().into_iter().map(|(label, count)| (label.code(), count)).collect()
    }

    /// The fraction of each basin with a 95 % interval, as if the pixels were independent random points of the
    /// window. Undecided pixels widen the intervals; pixels outside are not counted.
    fn fractions(&self) -> PyResult<BTreeMap<u16, Interval>> {
        let found = self.image.fractions_as_random_points().map_err(value_error)?;
        Ok(found.into_iter().map(|(label, interval)| (label.code(), interval.into())).collect())
    }

    /// Bounds on the fraction of each basin, if a square whose four corners have one label belongs to it.
    fn fraction_bounds(&self) -> PyResult<BTreeMap<u16, Bounds>> {
        let found = self.image.fractions_between_pixels().map_err(value_error)?;
        Ok(found.into_iter().map(|(label, bounds)| (label.code(), bounds.into())).collect())
    }

    /// The boxes of a side, in pixels, with the entropies of the basins in them.
    fn boxes(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = whole)] side: usize,
    ) -> PyResult<BoxCount> {
        let image = Arc::clone(&self.image);
        let found = in_background(py, move |_: &Watch| image.boxes(side), value_error, |_| Ok(()))?;
        Ok(BoxCount {
            size: found.size,
            boxes: found.boxes,
            mixed: found.mixed,
            open: found.open,
            basin_entropy: found.basin_entropy(),
            boundary_entropy: found.boundary_entropy(),
        })
    }

    /// Whether the boundary entropy exceeds ln 2 at every size of boxes from two pixels to an eighth of the image:
    /// then the boundary is fractal at these scales. False says that this is not shown.
    fn exceeds_ln_2(&self, py: Python<'_>) -> PyResult<bool> {
        let image = Arc::clone(&self.image);
        let work = move |_: &Watch| image.ln_2_criterion();
        let found = in_background(py, work, value_error, |_| Ok(()))?;
        Ok(matches!(found, Ln2Criterion::Fractal { .. }))
    }

    /// The largest fraction of the image that lies on the boundary of one basin and farther than `distance` pixels
    /// from the boundary of another one: 0 if all basins share one boundary at this distance (Wada).
    fn far_from_other_boundaries(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = whole)] distance: usize,
    ) -> PyResult<f64> {
        let image = Arc::clone(&self.image);
        let found =
            in_background(py, move |_: &Watch| image.wada(distance), value_error, |_| Ok(()))?;
        Ok(found.far_image_fraction)
    }

    fn __repr__(&self) -> String {
        let Grid { columns, rows, .. } = self.image.grid;
        format!("LabelImage(shape=({columns}, {rows}))")
    }
}

plain!(BoxCount { size, boxes, mixed, open, basin_entropy, boundary_entropy });

#[pymethods]
impl BoxCount {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __repr__(&self) -> String {
        let BoxCount { size, boxes, mixed, open, .. } = self;
        format!("BoxCount(size={size}, boxes={boxes}, mixed={mixed}, open={open})")
    }
}
