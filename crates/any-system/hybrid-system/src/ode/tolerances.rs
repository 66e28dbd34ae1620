//! How accurately a flow is integrated, and how far a step may reach.

use crate::error::Error;

/// How accurately a flow is integrated, and how far a step may reach.
///
/// # Kinks
/// The estimate of the error of a step takes the field to be smooth. A step over a kink of the field is recognised
/// by a large estimate, and repeated with shorter steps. At some places in the step the estimate is small by
/// chance, and the kink stays hidden. Measured: the largest of 200 errors, each for another place of the kink, in
/// units of the tolerance:
///
/// | field | 1e-5 | 1e-6 | 1e-8 | 1e-9 | 3e-10 | 1e-10 | 3e-11 | 1e-12 |
/// |---|---:|---:|---:|---:|---:|---:|---:|---:|
/// | ẋ = abs(sin(t + p)) | 487 | < 10 | < 10 | < 10 | < 10 | 10.5 | < 10 | < 10 |
/// | a contact with the force 30 max(0, −x)^1.5 | 47 | 96 | 46 | 51 | 32 | 30 | 43 | 19 |
/// | the same, the contact is a surface | 12 | 5.9 | 0.2 | 0.3 | 0.6 | 0.2 | 3.3 | 0.3 |
///
/// The last row is the remedy, and it is exact: the kink is a surface of the model. A guard there, or an observer,
/// ends the arc at the kink, and no later step contains it. Best are two modes, each with its own smooth field.
///
/// # Example
/// ```
/// use hybrid_system::Tolerances;
///
/// /// A position in metres, and a pressure in pascals.
/// const TOLERANCES: Tolerances =
///     Tolerances::both(1e-9).absolute_each(&[1e-9, 1e-4]).longest_step(0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Error of a step relative to the state, for each component.
    pub relative: f64,
    /// Error of a step where a component is near zero, in the units of the state.
    pub absolute: f64,
    /// As `absolute`, for each component by itself. `None`: `absolute` for all.
    pub absolute_each: Option<&'static [f64]>,
    /// As `relative`, for each component by itself; zero is allowed. `None`: `relative` for all. `relative` chooses the
    /// order of the integrator in any case.
    pub relative_each: Option<&'static [f64]>,
    /// No step is longer, in the unit of time; infinite by default. Something that the field does only for a short time
    /// (a pulse of a forcing) is seen by every step if this is shorter than that time.
    pub longest_step: f64,
    /// Every guard is looked at this often at least, in the unit of time; infinite by default. A guard that is
    /// beyond its surface for a longer time is then found, however long the steps are.
    pub check_interval: f64,
    /// Most steps of one integration, rejected ones included.
    pub steps: usize,
}

/// Most steps by default. It limits the time that an integration takes, not its accuracy. A field that needs more
/// steps is probably stiff: near a stable equilibrium with the rate λ the steps of an explicit method are no longer
/// than about 5/λ, so that this number of them covers 10⁶ times 1/λ and more.
const MOST_STEPS: usize = 1_000_000;

impl Tolerances {
    /// The same relative and absolute tolerance, steps of any length, and at most a million of them.
    pub const fn both(tolerance: f64) -> Self {
        Tolerances {
            relative: tolerance,
            absolute: tolerance,
            absolute_each: None,
            relative_each: None,
            longest_step: f64::INFINITY,
            check_interval: f64::INFINITY,
            steps: MOST_STEPS,
        }
    }

    /// As `self`, with an absolute tolerance for each component. A state with another number of components is
    /// [`Error::Dimension`].
    #[must_use]
    pub const fn absolute_each(mut self, absolute: &'static [f64]) -> Self {
        self.absolute_each = Some(absolute);
        self
    }

    /// As `self`, with a relative tolerance for each component. A state with another number of components is
    /// [`Error::Dimension`].
    ///
    /// An angle that turns for ever, or time as a component, has no natural size: its allowed error should not grow
    /// with it. Such a component has the relative tolerance zero. No absolute tolerance could replace this, because
    /// the relative part is added to it.
    #[must_use]
    pub const fn relative_each(mut self, relative: &'static [f64]) -> Self {
        self.relative_each = Some(relative);
        self
    }

    /// As `self`, with no step longer than `time`.
    #[must_use]
    pub const fn longest_step(mut self, time: f64) -> Self {
        self.longest_step = time;
        self
    }

    /// As `self`, with a look at every guard this often at least.
    #[must_use]
    pub const fn check_interval(mut self, time: f64) -> Self {
        self.check_interval = time;
        self
    }

    /// As `self`, with at most this number of steps, rejected ones included.
    #[must_use]
    pub const fn steps(mut self, steps: usize) -> Self {
        self.steps = steps;
        self
    }

    /// An error unless these tolerances can be used for states of this dimension.
    pub(crate) fn check(&self, dimension: usize) -> Result<(), Error> {
        let lists = [
            ("the list of absolute tolerances", self.absolute_each),
            ("the list of relative tolerances", self.relative_each),
        ];
        for (what, list) in lists {
            let found = list.map_or(dimension, <[f64]>::len);
            if found != dimension {
                return Err(Error::Dimension { what, expected: dimension, found });
            }
        }
        let positive = [self.relative, self.absolute].into_iter();
        let mut positive = positive.chain(self.absolute_each.unwrap_or(&[]).iter().copied());
        let bad = positive.find(|t| !(*t > 0.0 && t.is_finite()));
        let mut relative = self.relative_each.unwrap_or(&[]).iter().copied();
        let bad = bad.or_else(|| relative.find(|t| !(*t >= 0.0 && t.is_finite())));
        if let Some(value) = bad {
            return Err(Error::BadTolerance { value });
        }
        if !(self.longest_step > 0.0) {
            let what = "the longest step of an integration";
            return Err(Error::BadLimit { what, value: self.longest_step });
        }
        if !(self.check_interval > 0.0) {
            let what = "the check interval of an integration";
            return Err(Error::BadLimit { what, value: self.check_interval });
        }
        Ok(())
    }

    /// The error of a component of this size that a step may make. Beyond the lists they repeat: entries of a matrix of
    /// derivatives have the tolerances of their rows.
    #[inline]
    pub(crate) fn of(&self, axis: usize, size: f64) -> f64 {
        let entry = |list: Option<&'static [f64]>, all| {
            let each = list.unwrap_or(&[]);
            each.get(axis % each.len().max(1)).copied().unwrap_or(all)
        };
        entry(self.absolute_each, self.absolute) + entry(self.relative_each, self.relative) * size
    }
}
