//! The reference values of `data/`, and the unit in which errors of α′ are judged. Each test file uses a part of this.

#![allow(dead_code)]

use passive_hopper::{LiftOffMap, MassRatio};
use serde_json::Value;
use std::fmt;

/// Units of error that α′ may have for each flight of its hop. The worst of the 3222 reference hops has 2.4; the limit
/// is also that of `cargo xtask check-reference`.
pub(crate) const UNITS_PER_FLIGHT: f64 = 4.0;

/// The map at `mass_ratio`.
pub(crate) fn map(mass_ratio: f64) -> LiftOffMap {
    LiftOffMap::new(MassRatio::new(mass_ratio).unwrap())
}

/// One line of a reference file. Its display is the line, for messages.
pub(crate) struct Row {
    text: String,
    value: Value,
}

/// The lines of a reference file.
pub(crate) fn rows(text: &str) -> impl Iterator<Item = Row> + '_ {
    text.lines()
        .map(|line| Row { text: line.to_owned(), value: serde_json::from_str(line).unwrap() })
}

impl fmt::Display for Row {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.text)
    }
}

impl Row {
    /// An input, which the file has as an exact `f64`.
    pub(crate) fn input(&self, key: &str) -> f64 {
        self.value[key].as_f64().unwrap()
    }

    /// An integer.
    pub(crate) fn integer(&self, key: &str) -> u64 {
        self.value[key].as_u64().unwrap()
    }

    /// A result, which the file has as a decimal string; `None` if the line has no such string.
    pub(crate) fn result(&self, key: &str) -> Option<f64> {
        Some(self.value[key].as_str()?.parse().unwrap())
    }

    /// The first entry of a list of results.
    pub(crate) fn first_result(&self, key: &str) -> f64 {
        self.value[key][0].as_str().unwrap().parse().unwrap()
    }

    /// Whether the hopper is grounded: the line has the key, with null.
    pub(crate) fn is_grounded(&self, key: &str) -> bool {
        assert!(self.value.get(key).is_some(), "{self}");
        self.value[key].is_null()
    }

    /// The map at the line's mass ratio.
    pub(crate) fn map(&self) -> LiftOffMap {
        map(self.input("mass_ratio"))
    }

    /// The error of `next` as an α′, in units of what half an ulp of α, of M, of α′ and of α² cause together:
    /// K of `data/README.md`.
    pub(crate) fn error_in_units(&self, next: f64) -> f64 {
        let (m, alpha) = (self.input("mass_ratio"), self.input("alpha"));
        let exact = self.result("alpha_next").unwrap();
        let slope = |key: &str| self.result(key).map_or(0.0, f64::abs);
        let unit = exact
            + slope("dalpha_next_dalpha") * alpha
            + slope("dalpha_next_dM") * m
            + alpha * alpha / exact;
        (next - exact).abs() / (0.5 * f64::EPSILON * unit)
    }
}
