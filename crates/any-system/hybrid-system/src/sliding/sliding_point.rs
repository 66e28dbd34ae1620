//! The point at which an execution reaches a surface that it cannot leave: the fields on both sides point at it.

/// A point of a surface at which the fields on both sides point: ġ > 0 below the surface, where g < 0, and ġ < 0 above.
///
/// The execution cannot leave the surface to either side. Filippov's convention gives it the field f_s, the mean of
/// both fields that is tangent to the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sliding<M, S, X> {
    /// The surface.
    pub surface: S,
    /// The mode below the surface, where g < 0.
    pub below: M,
    /// The mode above the surface, where g > 0.
    pub above: M,
    /// Continuous time t.
    pub time: f64,
    /// The state on the surface.
    pub state: X,
    /// ġ below the surface, positive, and above it, negative.
    pub rates: (f64, f64),
    /// The fields below and above the surface; `None` if the model gives no field.
    pub fields: Option<(X, X)>,
    /// The sliding field f_s; `None` if the model gives no field.
    pub field: Option<X>,
}

impl<M: Copy, S: Copy, X> Sliding<M, S, X> {
    /// The same point with its states in another type.
    pub(crate) fn with_states<Y>(&self, convert: impl Fn(&X) -> Y) -> Sliding<M, S, Y> {
        let Sliding { surface, below, above, time, rates, .. } = *self;
        let fields = self.fields.as_ref().map(|(below, above)| (convert(below), convert(above)));
        let field = self.field.as_ref().map(&convert);
        Sliding { surface, below, above, time, state: convert(&self.state), rates, fields, field }
    }
}
