//! One line of a reference file.

#![allow(clippy::unwrap_used)] // a line that lacks a value must fail the test that reads it

use crate::unit::error_unit;
use passive_hopper::{LiftOffMap, MassRatio};
use serde_json::Value;
use std::fmt;

/// The map at `mass_ratio`.
pub fn map(mass_ratio: f64) -> LiftOffMap {
    LiftOffMap::new(MassRatio::new(mass_ratio).unwrap())
}

/// One object of a reference file. Its display is the object as JSON, for messages.
#[derive(Debug, Clone)]
pub struct Row(Value);

/// The objects of a reference file: one JSON object a line, or an array of objects.
pub fn rows(text: &str) -> impl Iterator<Item = Row> {
    let values: Vec<Value> = if text.trim_start().starts_with('[') {
        serde_json::from_str(text).unwrap()
    } else {
        text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    };
    values.into_iter().map(Row)
}

impl fmt::Display for Row {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl Row {
    /// An input, which the file has as an exact `f64`.
    pub fn input(&self, key: &str) -> f64 {
        self.0[key].as_f64().unwrap()
    }

    /// A text.
    pub fn text(&self, key: &str) -> &str {
        self.0[key].as_str().unwrap()
    }

    /// An integer.
    pub fn integer(&self, key: &str) -> u64 {
        self.0[key].as_u64().unwrap()
    }

    /// A result, which the file has as a decimal string; `None` if the line has no such string.
    pub fn result(&self, key: &str) -> Option<f64> {
        Some(self.0[key].as_str()?.parse().unwrap())
    }

    /// A result in the object `outer`.
    pub fn inner_result(&self, outer: &str, key: &str) -> f64 {
        self.0[outer][key].as_str().unwrap().parse().unwrap()
    }

    /// A list of results, as they stand in the file.
    pub fn list(&self, key: &str) -> Vec<&str> {
        self.0[key].as_array().unwrap().iter().map(|entry| entry.as_str().unwrap()).collect()
    }

    /// The first entry of a list of results.
    pub fn first_result(&self, key: &str) -> f64 {
        self.0[key][0].as_str().unwrap().parse().unwrap()
    }

    /// Whether the hopper is grounded: the line has the key, with null.
    pub fn is_grounded(&self, key: &str) -> bool {
        assert!(self.0.get(key).is_some(), "{self}");
        self.0[key].is_null()
    }

    /// The map at the line's mass ratio.
    pub fn map(&self) -> LiftOffMap {
        map(self.input("mass_ratio"))
    }

    /// The error of `next` as an α′, in units of [`error_unit`].
    pub fn error_in_units(&self, next: f64) -> f64 {
        let exact = self.result("alpha_next").unwrap();
        let slope = |key: &str| self.result(key).unwrap_or(0.0);
        let alpha = (self.input("alpha"), slope("dalpha_next_dalpha"));
        let mass_ratio = (self.input("mass_ratio"), slope("dalpha_next_dM"));
        (next - exact).abs() / error_unit(Some(exact), alpha, mass_ratio)
    }
}
