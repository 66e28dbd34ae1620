//! The lift-off map for scalars and arrays.

use crate::arrays::{Given, Numbers, Source, like, scalar, shaped};
use crate::errors::{InputError, map_error, value_error};
use crate::fates::Fate;
use crate::hop::Hop;
use crate::interruptible::{Pace, Watch, in_background};
use crate::records;
use crate::whole::{no_room, whole};
use hopper_basin::{Fates, HopperFate};
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use passive_hopper::{HopStatus, MassRatio};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyType;
use std::sync::{Arc, OnceLock};

/// Speeds of a piece of labels, after which a call that is no longer wanted ends in the background.
const PIECE: usize = 1 << 13;

/// The map α′ = f(α; M) from one gradual lift-off speed to the next.
///
/// Speeds are in units of m₂gω/k, and M = m₂/m₁ is the lower mass over the upper one. A call takes a number or
/// anything that NumPy makes an array of, and gives a float or an array of the same shape. NaN means that the
/// hopper is grounded, and stays NaN.
///
/// >>> from passive_hopper import LiftOffMap
/// >>> m = LiftOffMap(0.2)
/// >>> m(7.0)
/// 5.4319312674983316
/// >>> m([5.5, 7.0]).shape
/// (2,)
///
/// Every result has the bits of the Rust library: α′ is right to some ulps, and every decision of a hop is larger
/// than its error.
#[pyclass(frozen, module = "passive_hopper")]
pub(crate) struct LiftOffMap {
    map: passive_hopper::LiftOffMap,
    fates: OnceLock<Arc<Fates>>,
}

#[pymethods]
impl LiftOffMap {
    #[new]
    fn new(mass_ratio: f64) -> PyResult<Self> {
        let ratio = MassRatio::new(mass_ratio).map_err(map_error)?;
        Ok(LiftOffMap { map: passive_hopper::LiftOffMap::new(ratio), fates: OnceLock::new() })
    }

    /// For pickle and copy: a worker of a cluster gets the mass ratio alone.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyType>, (f64,)) {
        (slf.get_type(), (slf.get().mass_ratio(),))
    }

    /// M = m₂/m₁.
    #[getter]
    fn mass_ratio(&self) -> f64 {
        self.map.mass_ratio().value()
    }

    /// f(α), for a number or an array; NaN where the hopper is grounded.
    #[pyo3(signature = (alpha, /))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        alpha: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if let Some(alpha) = scalar(alpha.as_borrowed()) {
            let next =
                if alpha.is_nan() { None } else { self.map.image(alpha).map_err(map_error)? };
            return Ok(next.unwrap_or(f64::NAN).into_pyobject(py)?.into_any());
        }
        self.images(py, alpha, false, None, None)
    }

    /// f(α) for all speeds at once; NaN where the hopper is grounded.
    ///
    /// With status=True a pair: the images, and an array of uint8 with 0 where the hopper lifts off again, 1 where
    /// it is grounded, 2 where the hop cannot be decided, and 3 where the speed was NaN. Without it an undecided
    /// hop raises UndecidedError. `out` is an array of float64 for the images, of the shape of the speeds.
    #[pyo3(signature = (alpha, status = false, *, out = None, r#where = None))]
    fn images<'py>(
        &self,
        py: Python<'py>,
        alpha: &Bound<'py, PyAny>,
        status: bool,
        out: Option<&Bound<'py, PyAny>>,
        r#where: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if r#where.is_some() || (status && out.is_some()) {
            let text = "where=, and status= with out=, are not taken: give the speeds that count, as in m(alpha[mask])";
            return Err(PyTypeError::new_err(text));
        }
        if let Some(out) = out {
            return self.images_to(py, alpha, out);
        }
        let speeds = Source::of(alpha)?;
        let shape = speeds.shape();
        let count = shape.iter().product();
        let mut images = vec![0.0; count];
        let mut all = vec![HopStatus::NoSpeed; if status { count } else { 0 }];
        let mut piece = Vec::with_capacity(Pace::LONGEST.min(count));
        let (mut pace, mut done) = (Pace::new(), 0);
        while done < count {
            let range = done..(done + pace.next(py)?).min(count);
            done = range.end;
            speeds.copy(range.clone(), &mut piece)?;
            let (from, to) = (&piece, &mut images[range.clone()]);
            let status = all.get_mut(range);
            py.detach(|| match status {
                Some(status) if status.len() == from.len() => {
                    self.map.images_with_status(from, to, status)
                }
                _ => self.map.images_into(from, to),
            })
            .map_err(map_error)?;
        }
        let images = like(py, images, &shape)?;
        if !status {
            return Ok(images);
        }
        let codes: Vec<u8> = all.into_iter().map(|status| status as u8).collect();
        let codes = shaped(py, codes, &shape)?;
        Ok((images, codes).into_pyobject(py)?.into_any())
    }

    /// The hop that starts with speed α, with all its landings. Of an array a record array: `speed`, `next`, `next_error`, `loss`, `sudden`, `flight_time`.
    fn hop<'py>(&self, py: Python<'py>, alpha: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        match Given::of(alpha)? {
            Given::One(alpha) => {
                let hop = self.map.bounded_hop(alpha).map(Hop::from).map_err(map_error)?;
                Ok(Bound::new(py, hop)?.into_any())
            }
            Given::Many(speeds) => records::hops(py, self.map, speeds),
        }
    }

    /// The speeds α, f(α), f(f(α)), …: an array with up to `hops` + 1 speeds. It ends early if the hopper is grounded.
    #[pyo3(signature = (alpha, hops = 100))]
    fn orbit<'py>(
        &self,
        py: Python<'py>,
        alpha: f64,
        #[pyo3(from_py_with = whole)] hops: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.map.check_speed(alpha).map_err(map_error)?;
        let (mut speeds, mut last, mut left) = (vec![alpha], Some(alpha), hops);
        let mut pace = Pace::new();
        while let Some(mut speed) = last
            && left > 0
        {
            let piece = pace.next(py)?.min(left);
            left -= piece;
            speeds.try_reserve(piece).map_err(|_| no_room(hops, size_of::<f64>()))?;
            let follow = || {
                for _ in 0..piece {
                    let Some(next) = self.map.image(speed)? else { return Ok(None) };
                    speeds.push(next);
                    speed = next;
                }
                Ok(Some(speed))
            };
            last = py.detach(follow).map_err(map_error)?;
        }
        let count = speeds.len();
        shaped(py, speeds, &[count])
    }

    /// The fate of the orbit from α, with the number of hops until it is known. NaN, which the map gives for a
    /// grounded hopper, is grounded. Of an array a record array: `label`, `hops`.
    fn fate<'py>(&self, py: Python<'py>, alpha: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let given = Given::of(alpha)?;
        if matches!(given, Given::One(alpha) if alpha.is_nan()) {
            return Ok(Bound::new(py, Fate::grounded())?.into_any());
        }
        let fates = py.detach(|| self.stored_fates()).map_err(value_error)?;
        match given {
            Given::One(alpha) => Ok(Bound::new(py, Fate::of(py, fates, alpha)?)?.into_any()),
            Given::Many(speeds) => records::fates(py, Arc::clone(fates), speeds),
        }
    }

    /// The labels of many speeds, as an array of uint16; label_name names them. NaN is grounded.
    fn fates<'py>(&self, py: Python<'py>, alpha: Numbers) -> PyResult<Bound<'py, PyAny>> {
        let Numbers { values: speeds, shape } = alpha;
        let fates = Arc::clone(self.stored_fates().map_err(value_error)?);
        let label = move |watch: &Watch| {
            let mut codes = Vec::with_capacity(speeds.len());
            for piece in speeds.chunks(PIECE) {
                if watch.is_stopped() {
                    break;
                }
                // NaN is what the map gives for a grounded hopper, and it stays grounded.
                let known: Vec<f64> =
                    piece.iter().copied().filter(|speed| !speed.is_nan()).collect();
                let labels = fates.labels(&known)?;
                let mut labels = labels.iter();
                codes.extend(piece.iter().map(|speed| {
                    let label = if speed.is_nan() { None } else { labels.next() };
                    label.copied().unwrap_or(HopperFate::GROUNDED).code()
                }));
            }
            Ok::<_, hopper_basin::Error>(codes)
        };
        shaped(py, in_background(py, label, value_error, |_| Ok(()))?, &shape)
    }

    /// The derivatives (∂α′/∂α, ∂α′/∂M); None if the hopper is grounded, and for NaN. Of an array a record array: `by_speed`, `by_mass_ratio`.
    fn slopes<'py>(
        &self,
        py: Python<'py>,
        alpha: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let alpha = match Given::of(alpha)? {
            Given::One(alpha) => alpha,
            Given::Many(speeds) => return records::slopes(py, self.map, speeds),
        };
        let slopes = match alpha.is_nan() {
            true => None,
            false => self.map.slopes(alpha).map_err(map_error)?,
        };
        let pair = slopes.map(|slopes| (slopes.by_speed, slopes.by_mass_ratio));
        pair.into_bound_py_any(py)
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let other = other.cast::<LiftOffMap>();
        other.is_ok_and(|other| other.get().mass_ratio().to_bits() == self.mass_ratio().to_bits())
    }

    fn __hash__(&self) -> u64 {
        self.mass_ratio().to_bits()
    }

    fn __repr__(&self) -> String {
        format!("LiftOffMap({:?})", self.mass_ratio())
    }
}

impl LiftOffMap {
    /// The images, written into an array of float64 with the shape of the speeds.
    fn images_to<'py>(
        &self,
        py: Python<'py>,
        alpha: &Bound<'py, PyAny>,
        out: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        // Speeds that are overwritten are copied before.
        let speeds = match alpha.is(out) {
            true => Source::Converted(alpha.extract()?),
            false => Source::of(alpha)?,
        };
        let refused = || {
            let text = format!(
                "out= is an array of float64 with the shape {:?}, in C order, that can be written, and no view of the speeds",
                speeds.shape()
            );
            InputError::new_err(text)
        };
        let array = out.cast::<PyArrayDyn<f64>>().map_err(|_| refused())?;
        if array.shape() != speeds.shape() || !array.is_c_contiguous() {
            return Err(refused());
        }
        let count: usize = speeds.shape().iter().product();
        let mut piece = Vec::with_capacity(Pace::LONGEST.min(count));
        let mut images = vec![0.0; Pace::LONGEST.min(count)];
        let (mut pace, mut done) = (Pace::new(), 0);
        while done < count {
            let range = done..(done + pace.next(py)?).min(count);
            done = range.end;
            speeds.copy(range.clone(), &mut piece)?;
            let to = &mut images[..piece.len()];
            py.detach(|| self.map.images_into(&piece, to)).map_err(map_error)?;
            // Another thread may have the array meanwhile: it is held for the copy alone.
            let mut held = array.try_readwrite().map_err(|_| refused())?;
            let all = held.as_slice_mut().map_err(|_| refused())?;
            all.get_mut(range).ok_or_else(refused)?.copy_from_slice(&images[..piece.len()]);
        }
        Ok(out.clone())
    }

    fn stored_fates(&self) -> Result<&Arc<Fates>, hopper_basin::Error> {
        if let Some(fates) = self.fates.get() {
            return Ok(fates);
        }
        let fates = Arc::new(Fates::new(self.map.mass_ratio())?);
        Ok(self.fates.get_or_init(|| fates))
    }
}
