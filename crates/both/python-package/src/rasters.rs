//! Rasters over the plane, layer by layer of the table of `hopper-figures`.

use crate::arrays::shaped;
use crate::basins::{first_window, grid_of, pixel_middles};
use crate::errors::value_error;
use crate::interruptible::{Watch, in_background, progress_function};
use crate::whole::{room_for, two_whole};
use basin_of_attraction::{Grid, columns_in_parallel};
use hopper_figures::{LAYERS, Layer, LayerColumns, Meaning, Values};
use numpy::Element;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::{ControlFlow, Range};

/// The layer of numbers with this key.
fn layer_of(key: &str) -> PyResult<(&'static Layer, &'static Values)> {
    let known = LAYERS.iter().filter(|layer| layer.values().is_some()).map(|layer| layer.key);
    let found = Layer::of(key).and_then(|layer| Some((layer, layer.values()?)));
    found.ok_or_else(|| {
        let known = known.collect::<Vec<_>>().join("', '");
        value_error(format!("there is no layer {key:?} of numbers; there are '{known}'"))
    })
}

/// The numbers of some columns, column after column.
fn numbers_of<T: Send>(
    grid: &Grid,
    values: &Values,
    columns: Range<usize>,
    (watch, number): (&Watch, impl Fn(u64) -> T + Sync),
) -> Result<Vec<T>, hopper_figures::Error> {
    let strip = |strip: usize| {
        let begin = columns.start + strip * values.together;
        let end = (begin + values.together).min(columns.end);
        let of = LayerColumns { grid: *grid, logarithmic: false, columns: begin..end };
        let found = (values.columns)(&of)?;
        watch.finished(end - begin);
        let numbers = found.into_iter().flatten().map(&number).collect::<Vec<T>>();
        Ok::<_, hopper_figures::Error>(numbers)
    };
    let go_on = |_: usize| match watch.is_stopped() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let found = columns_in_parallel(columns.len().div_ceil(values.together), strip, go_on)?;
    Ok(found.into_iter().flatten().collect())
}

/// The layers of a raster, as a list of dicts: key, name, about, the type of its numbers (None for shares), and the
/// names of what they mean.
#[pyfunction]
pub(crate) fn layers(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let one = |layer: &'static Layer| {
        let entry = PyDict::new(py);
        entry.set_item("key", layer.key)?;
        entry.set_item("name", layer.name)?;
        entry.set_item("about", layer.about)?;
        let values = layer.values();
        let kind = |values: &Values| match values.meaning {
            Meaning::Reals(_) => "float",
            Meaning::Fates { .. } | Meaning::Numbers { .. } => "uint",
        };
        let dtype = values.map(|values| format!("{}{}", kind(values), 8 * values.bytes));
        entry.set_item("dtype", dtype)?;
        entry.set_item("columns", values.map(|values| values.table_columns(layer.key)))?;
        let fates = values.map(|values| matches!(values.meaning, Meaning::Fates { .. }));
        entry.set_item("fates", fates)?;
        Ok(entry)
    };
    LAYERS.iter().map(one).collect()
}

type Raster<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>);

/// The label of every pixel of a window of (M, α): arrays of M, of α, and of labels (uint16) with the shape (M, α).
///
/// Each label is the fate of its pixel's middle. label_name names the labels. Another `layer` of `layers()` gives its
/// numbers instead: "hops" until the fate is known (uint64), or "proof", labels with 65536 more where the fate is
/// proved (uint32). `alpha` is the window of the paper, from α*_1 to α*_6, unless given. `progress(done, all)` is
/// called with the number of finished columns, some times a second and at the end; `progress=True` shows a bar of
/// tqdm. Ctrl-C ends the computation.
#[pyfunction]
#[pyo3(signature = (M = [0.1, 1.0], alpha = None, shape = [512, 512], progress = None, layer = "label"),
       text_signature = "(M=(0.1, 1.0), alpha=None, shape=(512, 512), progress=None, layer='label')")]
#[expect(non_snake_case, reason = "M is the mass ratio in the paper and in Python")]
pub(crate) fn basin_labels<'py>(
    py: Python<'py>,
    M: [f64; 2],
    alpha: Option<[f64; 2]>,
    #[pyo3(from_py_with = two_whole)] shape: [usize; 2],
    progress: Option<Bound<'py, PyAny>>,
    layer: &str,
) -> PyResult<Raster<'py>> {
    let alpha = alpha.unwrap_or_else(first_window);
    let (ratios, speeds) = pixel_middles(py, [M, alpha], shape)?;
    let labels = basin_region(py, M, alpha, shape, [0, shape[0]], None, progress, layer)?;
    Ok((ratios, speeds, labels))
}

/// The labels of the columns from `columns[0]` to before `columns[1]` of the raster of basin_labels, by this number
/// of threads, or by all.
#[pyfunction]
#[pyo3(signature = (M, alpha, shape, columns, threads = None, progress = None, layer = "label"))]
#[expect(clippy::too_many_arguments, reason = "Python calls it with names")]
#[expect(non_snake_case, reason = "M is the mass ratio in the paper and in Python")]
pub(crate) fn basin_region<'py>(
    py: Python<'py>,
    M: [f64; 2],
    alpha: [f64; 2],
    #[pyo3(from_py_with = two_whole)] shape: [usize; 2],
    #[pyo3(from_py_with = two_whole)] columns: [usize; 2],
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
    layer: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let (_, values) = layer_of(layer)?;
    let grid = grid_of([M, alpha], shape)?;
    let [begin, end] = columns;
    if !(begin < end && end <= grid.columns) {
        return Err(value_error(format!(
            "columns {begin} to {end} are no part of a raster of {} columns",
            grid.columns
        )));
    }
    // The numbers of the threads, and those of the array.
    room_for((end - begin).saturating_mul(grid.rows), 2 * values.bytes)?;
    let call =
        Region { grid, columns: begin..end, threads, progress: progress_function(py, progress)? };
    // Each number fits: a test of the table of layers says so.
    match values.bytes {
        _ if matches!(values.meaning, Meaning::Reals(_)) => {
            call.array(py, values, |number| f32::from_bits(number as u32))
        }
        2 => call.array(py, values, |number| number as u16),
        4 => call.array(py, values, |number| number as u32),
        _ => call.array(py, values, |number| number),
    }
}

/// Some columns of a raster, and how they are computed.
struct Region<'py> {
    grid: Grid,
    columns: Range<usize>,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
}

impl<'py> Region<'py> {
    /// The array of the numbers of a layer.
    fn array<T: Element + Send + 'static>(
        self,
        py: Python<'py>,
        values: &'static Values,
        number: impl Fn(u64) -> T + Send + Sync + 'static,
    ) -> PyResult<Bound<'py, PyAny>> {
        let Region { grid, columns, threads, progress } = self;
        let shape = [columns.len(), grid.rows];
        // rayon takes 0 for the number of processors.
        let pool =
            threads.map(|threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build());
        let pool = pool.transpose().map_err(value_error)?;
        let work = move |watch: &Watch| {
            let numbers = || numbers_of(&grid, values, columns, (watch, number));
            match &pool {
                Some(pool) => pool.install(numbers),
                None => numbers(),
            }
        };
        let numbers = in_background(py, work, value_error, |done| match &progress {
            Some(progress) => progress.call1((done, shape[0])).map(drop),
            None => Ok(()),
        })?;
        shaped(py, numbers, &shape)
    }
}
