//! A pilot: some orbits are followed before a search, and the limits of the search follow from what they do.

use crate::attractors::known_cells::{CellSet, KnownCells};
use crate::attractors::recurrence_limits::RecurrenceLimits;
use crate::attractors::state_grid::StateGrid;
use crate::attractors::state_map::{Moving, Repeats, StateMap, check_starts};
use crate::error::Error;
use rayon::prelude::*;
use std::fmt;

/// What some orbits do on the cells of a grid, and the limits that a search needs for them.
///
/// Print it: it has a line for each orbit.
#[derive(Debug, Clone, PartialEq)]
pub struct Pilot {
    /// The orbits, in the order of their starts.
    pub orbits: Vec<PilotOrbit>,
    /// Limits for a search on the same grid. Those that no orbit says anything about are the default ones.
    pub limits: RecurrenceLimits,
    /// Steps of each orbit.
    steps: usize,
}

/// What one orbit does.
#[derive(Debug, Clone, PartialEq)]
pub struct PilotOrbit {
    /// Its start.
    pub start: Vec<f64>,
    /// The steps after which it visits only cells that it visits in its second half, too.
    pub settles: usize,
    /// The cells that it visits in its second half.
    pub cells: usize,
    /// The longest stay in one cell in its second half, in steps.
    pub stay: usize,
    /// The shortest stretch, of some that were tried, in two and a half of which it visits the cells of the two and a half before: the `locate` of a
    /// search. `None` if none does: it needs fewer cells, or longer orbits.
    pub stretch: Option<usize>,
    /// Where it ended before the steps were made.
    pub end: PilotEnd,
}

/// Whether a pilot orbit was followed to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PilotEnd {
    /// It stayed in the region in its second half.
    Inside,
    /// It was outside the region in its second half.
    Outside,
    /// The map had no value, or one that is not finite.
    Stopped,
}

/// Stretches that are tried. The shortest one is a few cycles of few points; longer ones take longer.
const STRETCHES: [usize; 8] = [20, 50, 100, 200, 500, 1000, 2000, 5000];

/// Stretches of a quarter of a confirmation, doubled.
const QUARTER: usize = 5;

/// The part of the points that must lie in cells of the stretches before: more than a search asks for.
const SHARED: f64 = 0.95;

/// A stretch is longer than the one that was found by this factor, a stay too, and a budget than the time to settle: the orbits of the search are others.
const RESERVE: usize = 2;
const RESERVE_OF_BUDGET: usize = 20;

impl Pilot {
    /// Follows these starts for so many steps each. 10⁴ show oscillations of up to some thousand steps.
    ///
    /// ```
    /// use basin_of_attraction::{Hyperrectangle, Interval, Pilot, PilotEnd, StateGrid, array_map};
    /// let henon = array_map(|[x, y]| Some([1.0 - 1.4 * x * x + y, 0.3 * x]));
    /// let grid = StateGrid::uniform(Hyperrectangle::new(vec![Interval::new(-2.0, 2.0)?; 2])?, 100)?;
    /// let pilot = Pilot::follow(&henon, &grid, &[vec![0.1, 0.1], vec![2.0, 2.0]], 20_000)?;
    /// assert_eq!(pilot.orbits[1].end, PilotEnd::Stopped);
    /// assert!(pilot.to_string().contains("stretches of 1000 steps"), "{pilot}");
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongDimension`] for a map or a start of another dimension; [`Error::BadSearch`] for fewer than 100 steps, or more than 10⁹.
    pub fn follow(
        map: &dyn StateMap,
        grid: &StateGrid,
        starts: &[Vec<f64>],
        steps: usize,
    ) -> Result<Pilot, Error> {
        let expected = grid.dimension();
        check_starts(map, starts, expected)?;
        if !(100..=1_000_000_000).contains(&steps) {
            let (name, remedy) = ("a number of steps", ", from 100 to 10⁹");
            return Err(Error::BadSearch { name, value: steps as f64, remedy });
        }
        let known = KnownCells::new(grid.clone());
        let one = |start: &Vec<f64>| orbit(map, &known, start, steps);
        let orbits: Vec<PilotOrbit> = starts.par_iter().map(one).collect();
        let of = |value: fn(&PilotOrbit) -> Option<usize>| {
            orbits.iter().filter(|own| own.end == PilotEnd::Inside).filter_map(value).max()
        };
        let default = RecurrenceLimits::default();
        // One without a stretch needs the longest one.
        let locate = of(|own| Some(own.stretch.unwrap_or(STRETCHES[STRETCHES.len() - 1])));
        let stay = of(|own| Some(own.stay).filter(|_| own.cells > 1));
        let settles = of(|own| Some(own.settles));
        let limits = RecurrenceLimits {
            locate: locate.map_or(default.locate, |own| RESERVE * own),
            recurrences: stay
                .map_or(default.recurrences, |own| default.recurrences.max(RESERVE * own)),
            budget: settles
                .map_or(default.budget, |own| default.budget.max(RESERVE_OF_BUDGET * own)),
            ..default
        };
        Ok(Pilot { orbits, limits, steps })
    }
}

/// Follows one orbit.
fn orbit(map: &dyn StateMap, known: &KnownCells, start: &[f64], steps: usize) -> PilotOrbit {
    let mut point = Moving::from(start);
    let mut found = PilotOrbit {
        start: start.to_vec(),
        settles: 0,
        cells: 0,
        stay: 0,
        stretch: None,
        end: PilotEnd::Stopped,
    };
    let (mut cells, mut repeats) = (Vec::with_capacity(steps), Repeats::default());
    known.wrap(&mut point.at);
    while cells.len() < steps {
        if point.at.iter().any(|x| !x.is_finite()) {
            return found;
        }
        cells.push(known.cell(&point.at));
        if let Some(period) = repeats.see(&point.at) {
            // The rest is known.
            while cells.len() < steps {
                cells.push(cells[cells.len() - period]);
            }
            break;
        }
        if !known.step(map, &mut point) {
            return found;
        }
    }
    let second = &cells[steps / 2..];
    let last: CellSet = second.iter().flatten().copied().collect();
    let is_last = |cell: &Option<u64>| cell.is_some_and(|cell| last.contains(&cell));
    found.settles = cells.iter().rposition(|cell| !is_last(cell)).map_or(0, |at| at + 1);
    found.cells = last.len();
    found.stay = second.chunk_by(|a, b| a == b).map(<[_]>::len).max().unwrap_or(0);
    found.end = if second.contains(&None) { PilotEnd::Outside } else { PilotEnd::Inside };
    let shares = |stretch: &usize| {
        let length = QUARTER * stretch / 2;
        let Some(from) = cells.len().checked_sub(2 * length) else { return false };
        let (before, after) = cells[from..].split_at(length);
        let among = |own: &[Option<u64>], other: &[Option<u64>]| {
            let other: CellSet = other.iter().flatten().copied().collect();
            let shared = own.iter().flatten().filter(|cell| other.contains(cell)).count();
            shared as f64 >= SHARED * length as f64
        };
        among(before, after) && among(after, before)
    };
    found.stretch = STRETCHES.into_iter().find(shares);
    found
}

impl fmt::Display for Pilot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} orbits of {} steps:", self.orbits.len(), self.steps)?;
        for own in &self.orbits {
            let PilotOrbit { start, settles, cells, stay, stretch, end } = own;
            match end {
                PilotEnd::Stopped => writeln!(f, "  {start:?}: stops, or is not finite")?,
                PilotEnd::Outside => {
                    writeln!(f, "  {start:?}: is outside the region in its second half")?
                }
                PilotEnd::Inside => {
                    write!(
                        f,
                        "  {start:?}: settles in {settles} steps on {cells} cells, stays up to {stay} steps in one; "
                    )?;
                    match stretch {
                        Some(stretch) => {
                            writeln!(f, "visits them again in stretches of {stretch}")?
                        }
                        None => writeln!(
                            f,
                            "does not visit them again: try fewer cells, or more steps"
                        )?,
                    }
                }
            }
        }
        let RecurrenceLimits { recurrences, locate, budget, .. } = self.limits;
        write!(
            f,
            "for a search: {recurrences} recurrences, stretches of {locate} steps, a budget of {budget}"
        )
    }
}
