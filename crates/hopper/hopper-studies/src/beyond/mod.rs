//! Results that the paper does not have, each with a figure and a table.

mod boundary;
mod circle;
mod count;
mod entropy;
mod finding;
mod humps;
mod humps_of_window;
mod large_speeds;
mod measure;
mod needles;
mod proved;
mod resilience;
mod tipping;
mod tree;

pub(crate) use finding::Finding;

use crate::choice;
use crate::error::Error;
use crate::job::Job;

/// Computes a result.
pub(crate) type Find = fn(&Job) -> Result<Finding, Error>;

/// All results, with their names for `--only`.
pub(crate) const ALL: &[(&str, Find)] = &[
    ("measure", measure::measure),
    ("proved", proved::proved_basins),
    ("asymmetry", measure::asymmetry),
    ("tipping", tipping::tipping_of_basins),
    ("resilience", resilience::resilience),
    ("boundary", boundary::boundary),
    ("uncertainty", boundary::uncertainty),
    ("circle", circle::circle),
    ("count", count::count),
    ("openings", circle::openings),
    ("entropy", entropy::entropy_of_basins),
    ("humps", humps::nested_basins),
    ("tree", tree::preimage_tree),
    ("large-speeds", large_speeds::large_speeds),
    ("needles", needles::needles),
];

/// The results with these names; all of them if none is named.
pub(crate) fn named(names: &[String]) -> Result<Vec<(&'static str, Find)>, Error> {
    choice::named("result", ALL, names)
}
