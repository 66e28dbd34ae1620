//! What do orbits of a map do?
//!
//! `attractor` has periodic orbits that attract, each with a neighbourhood that leads to it; `fate` how an orbit ends, of many at
//! once; `diagram` where orbits are over a parameter; `lyapunov` how fast neighbours part; `rotation` how fast an orbit turns.

mod attractor;
mod diagram;
mod fate;
mod lyapunov;
mod rotation;

pub use attractor::{PeriodicAttractor, periodic_attractors};
pub use diagram::{DiagramColumn, OrbitLength, Seeds, bifurcation_diagram, periods};
pub(crate) use fate::end_of;
pub use fate::{OrbitEnd, OrbitFate, orbit_fate, orbit_fates};
pub use lyapunov::{LyapunovExponents, OrbitMean, lyapunov_exponents};
pub use rotation::{RotationNumber, rotation_number};
