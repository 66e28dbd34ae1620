//! The label of a point: the number of its basin, or the reason why it belongs to none.

use crate::error::Error;
use crate::space::undecided_reason::UndecidedReason;
use std::fmt;

/// The label of a point.
///
/// ```text
///   basin n       the point belongs to basin n
///   escaped       the orbit leaves for good: a fate that is known, and no basin of an attractor
///   undecided     the fate of the point is not known; no tool of this crate counts it as a basin
///   outside       the point is outside the region of interest; no tool of this crate counts it at all
/// ```
///
/// A label takes two bytes. In files it is its [`code`](Self::code): basin n has the code n; 65535, 65533 and 65532
/// are undecided, for three reasons; 65530 is outside, and 65529 escaped. The other codes above 65529 are free for
/// basins.
///
/// ```
/// use basin_of_attraction::Label;
/// let right = |x: f64| Label::from(x > 0.0);
/// assert_eq!(right(-1.0).basin_number(), Some(0));
/// assert_eq!(right(2.0), Label::from(1));
/// assert!(Label::UNDECIDED.is_undecided() && Label::UNDECIDED.basin_number().is_none());
/// assert_eq!(Label::basin(65_535), None);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label(u16);

impl Label {
    /// The fate is not known: a budget was used up, or no reason is given.
    pub const UNDECIDED: Label = Label(u16::MAX);
    /// The fate is not known, because `f64` does not decide it.
    pub const UNDECIDED_PRECISION: Label = Label(u16::MAX - 2);
    /// The fate is not known, because the map could not be evaluated.
    pub const UNDECIDED_MAP: Label = Label(u16::MAX - 3);
    /// The point is outside the region of interest.
    pub const OUTSIDE: Label = Label(u16::MAX - 5);

    /// The orbit leaves for good. Boundaries, fractions and entropies count it as a fate of its own; it has no
    /// number of a basin.
    pub const ESCAPED: Label = Label(u16::MAX - 6);

    /// Basin `number`; `None` for the five codes that are no basins: 65529, 65530, 65532, 65533 and 65535.
    ///
    /// Numbers up to 255 need no `Option`: `Label::from(3)`, and `Label::from(x > 0.0)` for 0 and 1. For larger
    /// constants see [`numbered`](Self::numbered).
    pub const fn basin(number: u16) -> Option<Label> {
        let label = Label(number);
        if label.basin_number().is_some() { Some(label) } else { None }
    }

    /// Basin `NUMBER`, a constant. A number that is no basin does not compile.
    ///
    /// ```
    /// use basin_of_attraction::Label;
    /// const LAST: Label = Label::numbered::<65_000>();
    /// assert_eq!(LAST.basin_number(), Some(65_000));
    /// ```
    ///
    /// ```compile_fail
    /// let undecided = basin_of_attraction::Label::numbered::<65_535>();
    /// ```
    pub const fn numbered<const NUMBER: u16>() -> Label {
        // Evaluated by the compiler: the code of no basin is an index beyond the array, which does not compile.
        const { [Label(NUMBER)][Label(NUMBER).basin_number().is_none() as usize] }
    }

    /// The label of a fate that is undecided for this reason.
    pub const fn undecided(reason: UndecidedReason) -> Label {
        match reason {
            UndecidedReason::Budget => Self::UNDECIDED,
            UndecidedReason::Precision { .. } => Self::UNDECIDED_PRECISION,
            UndecidedReason::Map { .. } => Self::UNDECIDED_MAP,
        }
    }

    /// Whether the fate is not known.
    pub const fn is_undecided(self) -> bool {
        matches!(self, Self::UNDECIDED | Self::UNDECIDED_PRECISION | Self::UNDECIDED_MAP)
    }

    /// Whether the point is outside the region of interest.
    pub const fn is_outside(self) -> bool {
        matches!(self, Self::OUTSIDE)
    }

    /// Whether the orbit leaves for good.
    pub const fn is_escaped(self) -> bool {
        matches!(self, Self::ESCAPED)
    }

    /// Whether the fate is known: a basin, or an escape.
    pub const fn is_decided(self) -> bool {
        !self.is_undecided() && !self.is_outside()
    }

    /// The number of the basin; `None` if the point is undecided, escaped or outside.
    pub const fn basin_number(self) -> Option<u16> {
        if self.is_decided() && !self.is_escaped() { Some(self.0) } else { None }
    }

    /// The number that stands for this label in files.
    pub const fn code(self) -> u16 {
        self.0
    }

    /// The label with this code. Every code is that of a label.
    pub const fn from_code(code: u16) -> Label {
        Label(code)
    }
}

/// Attractors beyond this number would take labels that mean other things.
const MOST_ATTRACTORS: usize = 65_000;

/// The label of attractor `number`, counted from 1.
pub(crate) fn label_of_attractor(number: usize) -> Result<Label, Error> {
    let own = u16::try_from(number).ok().filter(|_| number <= MOST_ATTRACTORS);
    own.and_then(Label::basin).ok_or(Error::TooManyAttractors { most: MOST_ATTRACTORS })
}

/// The index of an attractor, from its label.
#[inline]
pub(crate) fn attractor_of_label(label: Label) -> Option<usize> {
    usize::from(label.basin_number()?).checked_sub(1)
}

/// Basin 0 … 255.
impl From<u8> for Label {
    fn from(number: u8) -> Self {
        Label(u16::from(number))
    }
}

/// Basin 0 for `false`, basin 1 for `true`.
impl From<bool> for Label {
    fn from(second: bool) -> Self {
        Label(u16::from(second))
    }
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::UNDECIDED => f.pad("undecided"),
            Self::UNDECIDED_PRECISION => f.pad("undecided: precision"),
            Self::UNDECIDED_MAP => f.pad("undecided: map"),
            Self::OUTSIDE => f.pad("outside"),
            Self::ESCAPED => f.pad("escaped"),
            Label(number) => f.pad(&format!("basin {number}")),
        }
    }
}

impl fmt::Debug for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_a_basin_or_undecided_or_escaped_or_outside() {
        assert_eq!(size_of::<Label>(), 2);
        let mut others = Vec::new();
        for code in 0..=u16::MAX {
            let label = Label::from_code(code);
            assert_eq!(label.code(), code);
            assert_eq!(label.basin_number(), Label::basin(code).map(Label::code));
            match label.basin_number() {
                Some(number) => assert_eq!(number, code),
                None => others.push(code),
            }
        }
        assert_eq!(others, [65_529, 65_530, 65_532, 65_533, 65_535]);
    }

    #[test]
    fn every_reason_has_a_label_of_its_own() {
        let labels = [
            UndecidedReason::Budget,
            UndecidedReason::Precision { at: 1.0 },
            UndecidedReason::Map { at: f64::NAN },
        ]
        .map(Label::undecided);
        assert!(labels.iter().all(|label| label.is_undecided()));
        assert!(labels[0] != labels[1] && labels[1] != labels[2] && labels[0] != labels[2]);
    }
}
