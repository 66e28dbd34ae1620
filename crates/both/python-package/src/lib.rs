//! The native part of the Python packages `nonsmooth` and `passive_hopper`. It converts arguments and results, and computes nothing
//! itself.

mod arrays;
mod attractors;
mod basins;
mod errors;
mod fates;
mod fixed_points;
mod formulas;
mod generation;
mod hop;
mod hybrid;
mod interruptible;
mod labelling;
mod map;
mod motion;
mod pickling;
mod rasters;
mod records;
mod restored;
mod whole;
mod workers;

use pyo3::prelude::*;

/// The native part of `nonsmooth` and `passive_hopper`.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    // Loaded here, where a failure or Ctrl-C is an exception. The numpy crate would load it in the first call that
    // makes an array, and panic.
    module.py().import("numpy")?;
    drop(numpy::PyArray1::<f64>::from_slice(module.py(), &[]));
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(generation::after_fork, module)?)?;
    module.add_function(wrap_pyfunction!(restored::_restored, module)?)?;
    module.add_class::<map::LiftOffMap>()?;
    module.add_class::<hop::Hop>()?;
    module.add_class::<hop::Landing>()?;
    module.add_class::<fates::Fate>()?;
    module.add_class::<fixed_points::Trap>()?;
    module.add_class::<fixed_points::Crisis>()?;
    module.add_class::<basins::IntervalBasins>()?;
    module.add_class::<basins::Bounds>()?;
    module.add_class::<labelling::LabelImage>()?;
    module.add_class::<labelling::BoxCount>()?;
    module.add_class::<labelling::Interval>()?;
    module.add_class::<labelling::UncertaintyExponent>()?;
    module.add_class::<attractors::Attractors>()?;
    module.add_function(wrap_pyfunction!(attractors::_boundary_between, module)?)?;
    module.add_function(wrap_pyfunction!(attractors::_track_edge, module)?)?;
    module.add_function(wrap_pyfunction!(attractors::_minimal_fatal_shock, module)?)?;
    module.add_function(wrap_pyfunction!(attractors::_stability, module)?)?;
    module.add_function(wrap_pyfunction!(attractors::_tipping, module)?)?;
    module.add_function(wrap_pyfunction!(attractors::_attractors_along, module)?)?;
    module.add_function(wrap_pyfunction!(labelling::label_codes, module)?)?;
    module.add_function(wrap_pyfunction!(labelling::region_fractions, module)?)?;
    module.add_function(wrap_pyfunction!(labelling::uncertainty_exponent, module)?)?;
    module.add_class::<formulas::Symbol>()?;
    module.add_class::<formulas::Trace>()?;
    module.add_class::<formulas::Formulas>()?;
    module.add_class::<formulas::Equations>()?;
    module.add_class::<formulas::Solution>()?;
    module.add_class::<formulas::Fates>()?;
    module.add_class::<formulas::ReturnMap>()?;
    module.add_class::<formulas::Steps>()?;
    module.add_class::<formulas::ProvedBasins>()?;
    module.add_function(wrap_pyfunction!(formulas::_equations, module)?)?;
    module.add_function(wrap_pyfunction!(formulas::_solution, module)?)?;
    module.add_function(wrap_pyfunction!(formulas::_proved_orbit, module)?)?;
    module.add_function(wrap_pyfunction!(formulas::_proved_basins, module)?)?;
    module.add_class::<hybrid::HybridSystem>()?;
    module.add_class::<hybrid::Guard>()?;
    module.add_class::<hybrid::CFunction>()?;
    module.add_class::<hybrid::CField>()?;
    module.add_class::<hybrid::CGuard>()?;
    module.add_class::<hybrid::CSystem>()?;
    module.add_class::<hybrid::Clock>()?;
    module.add_class::<hybrid::Execution>()?;
    module.add_class::<hybrid::HybridArc>()?;
    module.add_class::<hybrid::Event>()?;
    module.add_class::<hybrid::Zeno>()?;
    module.add_class::<hybrid::Sliding>()?;
    module.add_class::<hybrid::SlidingMode>()?;
    module.add_class::<hybrid::QuasiPolynomial>()?;
    module.add_function(wrap_pyfunction!(hybrid::arc_states, module)?)?;
    module.add_function(wrap_pyfunction!(hybrid::arc_trajectory, module)?)?;
    module.add_function(wrap_pyfunction!(hybrid::sensitivity, module)?)?;
    module.add_function(wrap_pyfunction!(hybrid::event_sensitivity, module)?)?;
    module.add_function(wrap_pyfunction!(fixed_points::alpha_star, module)?)?;
    module.add_function(wrap_pyfunction!(fixed_points::trap, module)?)?;
    module.add_function(wrap_pyfunction!(fixed_points::crisis, module)?)?;
    module.add_function(wrap_pyfunction!(fixed_points::grounding, module)?)?;
    module.add_function(wrap_pyfunction!(records::images, module)?)?;
    module.add_function(wrap_pyfunction!(fates::label_name, module)?)?;
    module.add_function(wrap_pyfunction!(fates::label_colour, module)?)?;
    module.add_function(wrap_pyfunction!(rasters::basin_labels, module)?)?;
    module.add("RASTER_VERSION", hopper_basin::RASTER_VERSION)?;
    module.add_function(wrap_pyfunction!(rasters::basin_region, module)?)?;
    module.add_function(wrap_pyfunction!(rasters::layers, module)?)?;
    module.add_function(wrap_pyfunction!(basins::first_window, module)?)?;
    module.add_function(wrap_pyfunction!(basins::pixel_middles, module)?)?;
    module.add_function(wrap_pyfunction!(basins::interval_basins, module)?)?;
    module.add_function(wrap_pyfunction!(basins::fractions, module)?)?;
    module.add_function(wrap_pyfunction!(motion::motion_arrays, module)?)?;
    module.add_function(wrap_pyfunction!(motion::motion_event_names, module)?)?;
    module.add_function(wrap_pyfunction!(motion::animation_bytes, module)?)?;
    Ok(())
}
