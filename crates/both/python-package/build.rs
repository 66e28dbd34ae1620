//! Refuses interpreters for which nothing was tested.

use pyo3_build_config::BuildFlag;

/// Why a build for free-threaded Python ends.
const FREE_THREADED: &str = "nonsmooth and passive-hopper are not built for free-threaded Python, as no such interpreter was there to test \
    them with: use the usual build of Python (python3.14, not python3.14t)";

fn main() {
    if pyo3_build_config::get().build_flags().0.contains(&BuildFlag::Py_GIL_DISABLED) {
        println!("cargo::error={FREE_THREADED}");
    }
}
