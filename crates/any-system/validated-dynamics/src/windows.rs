//! What is divided, and how far.

use crate::cells::MOST_SIDES;
use crate::enclosed_map::EnclosedMap;
use crate::undecided::Error;
use interval_arithmetic::Enclosure;

/// The most halvings of a window: cells of 2⁻³⁰ of its sides, below which memory would be the limit anyway.
const DEEPEST: u32 = 30;

/// How far cells are divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Division {
    /// The first cells have 2^−`first` of the window's sides.
    pub first: u32,
    /// The last ones have 2^−`last` of them.
    pub last: u32,
    /// The most images.
    pub images: usize,
}

/// The share of a window that a cell has.
pub(crate) fn share_of(points: &[Enclosure], window: &[Enclosure]) -> Enclosure {
    let width = |x: &Enclosure| Enclosure::from(x.high()) - x.low();
    let sides = points.iter().zip(window).map(|(own, whole)| width(own) / width(whole));
    sides.fold(Enclosure::ONE, |share, side| share * side)
}

impl Division {
    /// An error unless there is a window for each map, with cells of this division: what [`ProvedBasins::new`](crate::ProvedBasins::new) asks of them.
    ///
    /// # Errors
    /// [`Error::Argument`] with what is wrong.
    pub fn check<M: EnclosedMap>(self, maps: &[&M], windows: &[&[Enclosure]]) -> Result<(), Error> {
        if maps.is_empty() || maps.len() != windows.len() {
            let given = windows.len();
            return Error::argument("windows", format!("{given} windows for {} maps", maps.len()));
        }
        for (map, window) in maps.iter().zip(windows) {
            let is_side = |x: &Enclosure| x.low() < x.high() && x.width().is_finite();
            let needed = map.dimension();
            if window.len() != needed
                || needed != maps[0].dimension()
                || !window.iter().all(is_side)
            {
                return Error::argument(
                    "window",
                    format!("{needed} intervals of finite, positive widths are needed"),
                );
            }
        }
        let sides = maps[0].dimension();
        if sides == 0 || sides > MOST_SIDES {
            return Error::argument(
                "maps",
                format!("from 1 to {MOST_SIDES} variables are needed, not {sides}"),
            );
        }
        if !(self.first <= self.last && self.last <= DEEPEST) {
            return Error::argument("division", format!("first ≤ last ≤ {DEEPEST} is needed"));
        }
        let cells = interval_arithmetic::pow(2.0, (sides as f64) * f64::from(self.first));
        match cells * maps.len() as f64 <= self.images as f64 {
            true => Ok(()),
            false => {
                let reason = format!(
                    "{} images are fewer than the first {cells} cells of each window",
                    self.images
                );
                Error::argument("division", reason)
            }
        }
    }
}
