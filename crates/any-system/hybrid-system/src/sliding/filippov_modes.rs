//! The modes and surfaces of a system with sliding modes.

/// A mode of [`Filippov`](crate::Filippov).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FilippovMode<M, S> {
    /// A mode of the model.
    Free(M),
    /// The state slides along a surface of the model.
    Sliding {
        /// The surface.
        surface: S,
        /// The name of the same surface in the other mode, if the model has two names for it; else `surface` again.
        partner: S,
        /// The mode below the surface, where g < 0.
        below: M,
        /// The mode above it.
        above: M,
    },
}

/// A surface of [`Filippov`](crate::Filippov).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FilippovSurface<M, S> {
    /// A surface of the model.
    Model(S),
    /// The field of `mode` is tangent to `surface`: ∇g·f = 0. The sliding motion leaves the surface there, into
    /// that mode.
    Tangent {
        /// The surface along which the state slides.
        surface: S,
        /// The mode on one of its sides.
        mode: M,
    },
}
