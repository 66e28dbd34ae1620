//! Certificates: what is proved, in a file that another program confirms.

mod record;
mod written_set;

pub(crate) use record::Record;

use written_set::rows_of;

use crate::basins::{ProvedBasins, ProvedFate};
use crate::enclosed_map::{Carried, EnclosedMap, StartSet};
use crate::fixed_point::ProvedFixedPoint;
use crate::formula_map::FormulaMap;
use crate::matrix::{exact, middle};
use crate::multipliers::Multiplier;
use crate::trap::Trap;
use crate::undecided::Error;
use interval_arithmetic::Enclosure;
use serde_json::{Value, json};

/// What the first line of a certificate says.
const FORMAT: &str = "hybrid system certificate";

/// The version of the format. A reader refuses others.
const VERSION: u64 = 1;

/// How much larger than the proved discs of multipliers those of a certificate are: another program finds discs of its own inside.
const WIDER_DISCS: f64 = 16.0;

/// A part of the width of a box by which a certificate's bounds of a fixed point are wider than the proved ones, for the same reason.
const WIDER_POINT: f64 = 0.5;

/// Statements about maps and the numbers of their proofs, for a file that another program confirms: `check_certificate.py` of this project.
///
/// The maps must be [recorded](crate::SectionMap::recorded). The file has the equations as texts, and each run of a proof with the set behind each step,
/// so that each step is confirmed by itself.
///
/// ```
/// use hybrid_system::Equations;
/// use validated_dynamics::{Certificate, SectionMap, ValidatedSystem, fixed_point};
/// let rossler = Equations::new(&["x", "y", "z"], &[("a", "0.2"), ("b", "0.2"), ("c", "5.7")])
///     .mode_text("flow", &["-y - z", "x + a*y", "b + z*(x - c)"])
///     .rising_text("section", "x");
/// let system = ValidatedSystem::new(&rossler)?;
/// let section = system.chart("flow", &["y", "z"], &["0", "y", "z"])?;
/// let returns = SectionMap::new(&system, section, "section", 1, &["y", "z"])?.recorded();
/// let mut certificate = Certificate::new("rossler");
/// certificate.fixed_point(&returns, &fixed_point(&returns, &[-8.4, 0.03], &[])?)?;
/// assert!(certificate.text().lines().count() == 4);
/// # Ok::<(), validated_dynamics::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Certificate {
    name: String,
    lines: Vec<Value>,
    systems: Vec<Value>,
    maps: Vec<Value>,
    traps: usize,
    led: usize,
}

/// Where all points of a box are led.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// To the surface of the map.
    Surface,
    /// Into the trap with this number.
    Trap(usize),
    /// Into the box of which [`Certificate::leads`] has given this number.
    Box(usize),
}

impl Certificate {
    /// A certificate without statements. Of names that it knows the checker says whether the file proves what it should.
    pub fn new(name: &str) -> Certificate {
        Certificate {
            name: name.to_owned(),
            lines: Vec::new(),
            systems: Vec::new(),
            maps: Vec::new(),
            traps: 0,
            led: 0,
        }
    }

    /// The file: a line of JSON for each statement, behind a first line that says what the file is.
    pub fn text(&self) -> String {
        let lines = self.lines.len();
        let header = json!({
            "format": FORMAT, "version": VERSION, "name": self.name, "lines": lines,
        });
        std::iter::once(&header).chain(&self.lines).map(|line| format!("{line}\n")).collect()
    }

    /// There is exactly one fixed point in a box, and its multipliers lie in discs.
    ///
    /// # Errors
    /// [`Error::Argument`] for a map that is not recorded; what the map does not decide.
    pub fn fixed_point(
        &mut self,
        map: &impl EnclosedMap,
        found: &ProvedFixedPoint,
    ) -> Result<(), Error> {
        let number = self.map(map)?;
        let wide = |x: &Enclosure| x.widened(WIDER_POINT * x.width());
        let point: Vec<Enclosure> = found.point.iter().map(wide).collect();
        let centre = middle(&found.unique_in);
        let run = |variables: &[Enclosure]| {
            let all = [variables, &found.parameters].concat();
            recorded(map.carry(StartSet::of_box(&all))?)
        };
        let disc = |of: &Multiplier| json!([of.real, of.imaginary, WIDER_DISCS * of.radius]);
        self.lines.push(json!({
            "kind": "fixed-point",
            "map": number,
            "unique_in": pairs(&found.unique_in),
            "point": pairs(&point),
            "parameters": pairs(&found.parameters),
            "multipliers": found.multipliers.iter().map(disc).collect::<Vec<_>>(),
            "centre": centre,
            "at_centre": run(&exact(&centre))?,
            "in_unique": run(&found.unique_in)?,
            "at_point": run(&point)?,
        }));
        Ok(())
    }

    /// All points of a trap converge to the one fixed point in it. The number of the trap in the file.
    ///
    /// # Errors
    /// As [`fixed_point`](Self::fixed_point).
    pub fn trap(&mut self, map: &impl EnclosedMap, trap: &Trap) -> Result<usize, Error> {
        let number = self.map(map)?;
        let around = |size: f64| vec![Enclosure::new(-size, size); trap.centre().len()];
        let mut growth = Vec::new();
        for larger in trap.growth() {
            let parts = parts(map, &larger.parts, |u| trap.start(u))?;
            growth.push(json!({"size": larger.size, "parts": parts}));
        }
        self.lines.push(json!({
            "kind": "trap",
            "map": number,
            "centre": trap.centre(),
            "directions": rows_of(trap.directions()),
            "parameters": pairs(trap.parameters()),
            "size": trap.contracting(),
            "run": recorded(map.carry(trap.start(&around(trap.contracting())))?)?,
            "growth": growth,
        }));
        self.traps += 1;
        Ok(self.traps - 1)
    }

    /// All points of a box are led by a map to a [`Target`]. The parts are boxes that cover the whole one. The number of the statement among those of
    /// this kind.
    ///
    /// # Errors
    /// As [`fixed_point`](Self::fixed_point).
    pub fn leads(
        &mut self,
        map: &impl EnclosedMap,
        whole: &[Enclosure],
        parts: &[Vec<Enclosure>],
        target: Target,
    ) -> Result<usize, Error> {
        let number = self.map(map)?;
        let parts = self::parts(map, parts, StartSet::of_box)?;
        let target = match target {
            Target::Surface => Value::Null,
            Target::Trap(trap) => json!(["trap", trap]),
            Target::Box(led) => json!(["box", led]),
        };
        self.lines.push(json!({
            "kind": "leads",
            "map": number,
            "box": pairs(whole),
            "to": target,
            "parts": parts,
        }));
        self.led += 1;
        Ok(self.led - 1)
    }

    /// The part in a box of a [set of the map](crate::FormulaMap::with_set) is led into itself: the parts are what
    /// [`keeps`](crate::FormulaMap::keeps) has given.
    ///
    /// # Errors
    /// As [`fixed_point`](Self::fixed_point).
    pub fn keeps(
        &mut self,
        map: &FormulaMap,
        set: &str,
        whole: &[Enclosure],
        parts: &[Vec<Enclosure>],
    ) -> Result<(), Error> {
        let number = self.map(map)?;
        let mut written = Vec::new();
        for part in parts {
            let run = map.end_of(StartSet::of_box(part).without_derivatives())?;
            let run = run.ok_or_else(not_recorded)?.as_json();
            written.push(json!({"box": pairs(part), "run": run}));
        }
        self.lines.push(json!({
            "kind": "keeps", "map": number, "set": set, "box": pairs(whole), "parts": written,
        }));
        Ok(())
    }

    /// The basins of traps of the file, by their numbers: a line for each cell with a fate, behind those in which its image is.
    ///
    /// # Errors
    /// As [`fixed_point`](Self::fixed_point); [`Error::Argument`] for basins of several maps, and for another number of traps than that of the basins.
    pub fn basins(
        &mut self,
        map: &impl EnclosedMap,
        basins: &ProvedBasins,
        traps: &[usize],
    ) -> Result<(), Error> {
        let [window] = basins.windows() else {
            return Error::argument("basins", "of several maps: a certificate has those of one");
        };
        if traps.len() != basins.traps().len() {
            let wanted = basins.traps().len();
            return Error::argument(
                "traps",
                format!("{} of them; needed are {wanted}", traps.len()),
            );
        }
        let number = self.map(map)?;
        let mut cells = Vec::new();
        for cell in basins.cells() {
            let is_inside = |trap: &Trap| trap.contains(&cell.points);
            let start = || StartSet::of_box(&cell.points).without_derivatives();
            let is_trapped =
                matches!(cell.fate, ProvedFate::Trap(trap) if is_inside(&basins.traps()[trap]));
            let run = match is_trapped {
                true => None,
                // Its own image: that of a cell whose points stop later is among the cells before.
                false => Some(match map.carry(start()) {
                    Ok(carried) => recorded(carried)?,
                    Err(error) if error.is_stop() => {
                        map.end_of(start())?.ok_or_else(not_recorded)?.as_json()
                    }
                    Err(error) => return Err(error),
                }),
            };
            let fate = match cell.fate {
                ProvedFate::Trap(trap) => json!(traps[trap]),
                ProvedFate::Stopped(surface) => json!(surface.as_str()),
            };
            cells.push(json!({
                "kind": "cell",
                "box": pairs(&cell.points),
                "fate": fate,
                "run": run,
            }));
        }
        self.lines.push(json!({
            "kind": "basins", "map": number, "window": pairs(window), "cells": cells.len(),
        }));
        self.lines.extend(cells);
        Ok(())
    }

    /// The number of a map, which is written once.
    fn map(&mut self, map: &impl EnclosedMap) -> Result<usize, Error> {
        let Some((system, mut map)) = map.as_json() else {
            return Error::argument("map", "one of one's own, of which a certificate says nothing");
        };
        map["system"] = json!(system.map(|system| self.place(system, |own| &mut own.systems)));
        Ok(self.place(map, |own| &mut own.maps))
    }

    /// The place of a line among those of its kind. It is written at its first use.
    fn place(&mut self, line: Value, of_kind: impl Fn(&mut Self) -> &mut Vec<Value>) -> usize {
        let known = of_kind(self);
        if let Some(place) = known.iter().position(|known| *known == line) {
            return place;
        }
        known.push(line.clone());
        let place = known.len() - 1;
        self.lines.push(line);
        place
    }
}

/// Boxes with their runs, without derivatives: as they were proved.
fn parts(
    map: &impl EnclosedMap,
    boxes: &[Vec<Enclosure>],
    start: impl Fn(&[Enclosure]) -> StartSet,
) -> Result<Vec<Value>, Error> {
    let part = |own: &Vec<Enclosure>| {
        let run = recorded(map.carry(start(own).without_derivatives())?)?;
        Ok(json!({"box": pairs(own), "run": run}))
    };
    boxes.iter().map(part).collect()
}

fn pairs(all: &[Enclosure]) -> Vec<[f64; 2]> {
    all.iter().map(|x| [x.low(), x.high()]).collect()
}

fn recorded(carried: Carried) -> Result<Value, Error> {
    Ok(carried.record.ok_or_else(not_recorded)?.as_json())
}

fn not_recorded() -> Error {
    Error::Argument {
        what: "map".to_owned(),
        reason: "it is not recorded: a certificate needs its steps".to_owned(),
    }
}
