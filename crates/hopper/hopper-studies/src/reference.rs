//! Files of reference values: one JSON object a line, or an array of objects.

use crate::error::Error;
use crate::repository::{number, numbered_rows, repository, whole};
use hopper_basin::HopperFate;
use hopper_reference::error_unit;
use passive_hopper::MassRatio;
use serde_json::Value;
use std::path::Path;

/// A question and its answer, from one line of a file.
pub(crate) enum Line {
    Hop(ReferenceHop),
    Loss(Loss),
    Local { mass_ratio: MassRatio, n: u64, offset: f64, sudden: usize, next: Option<f64> },
    Fate { mass_ratio: MassRatio, alpha: f64, fate: HopperFate },
    FixedPoint { n: u64, alpha_star: f64 },
    Crisis { n: u64, mu: f64, mass_ratio: f64, alpha: f64 },
    ImmediateBasin { n: u64, mass_ratio: MassRatio, edge: Edge, delta: Option<f64> },
}

/// The edge of a trap, and how certain the reference is of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Edge {
    /// On the contact part of the hump, where q has one minimum (docs/theory.md, Theorem 29).
    Contact,
    /// In the sudden window; found on scans.
    Sudden,
    /// The trap has no edge before the next fixed point.
    None,
    /// Not decided, because the needles are narrower than any scan.
    Unknown,
}

/// A hop, with the slopes by which its error is judged.
pub(crate) struct ReferenceHop {
    pub(crate) class: String,
    pub(crate) mass_ratio: MassRatio,
    pub(crate) alpha: f64,
    pub(crate) sudden: usize,
    pub(crate) next: Option<f64>,
    pub(crate) slope_alpha: f64,
    pub(crate) slope_mass_ratio: f64,
}

impl ReferenceHop {
    /// The unit of its error: the effect on α′ of half an ulp in each of α, M, α′ and α², added up.
    pub(crate) fn unit(&self) -> f64 {
        let alpha = (self.alpha, self.slope_alpha);
        error_unit(self.next, alpha, (self.mass_ratio.value(), self.slope_mass_ratio))
    }

    /// The allowed error of α′: `limit` units for each landing.
    pub(crate) fn allowed(&self, limit: f64) -> f64 {
        limit * (1 + self.sudden) as f64 * self.unit()
    }
}

/// A hop so small that α′ rounds to α, and the loss α − α′ is compared instead.
pub(crate) struct Loss {
    pub(crate) mass_ratio: MassRatio,
    pub(crate) alpha: f64,
    pub(crate) loss: f64,
}

/// The file with hops of the paper's window.
pub(crate) const WINDOW: &str = "crates/hopper/passive-hopper/tests/data/hops_window.jsonl";

/// The hops of that file.
pub(crate) fn window_hops() -> Result<Vec<ReferenceHop>, Error> {
    let path = repository().join(WINDOW);
    let hops = parse(&path)?.into_iter().filter_map(|(_, line)| match line {
        Line::Hop(hop) => Some(hop),
        _ => None,
    });
    let hops: Vec<ReferenceHop> = hops.collect();
    if hops.is_empty() { Err(Error::NoReference { path }) } else { Ok(hops) }
}

/// All lines of a file, each with its number from one.
///
/// # Errors
/// [`Error::ReferenceLine`] for a line of no known kind; [`Error::NoReference`] if no line has an answer that can be
/// compared. Therefore no check passes on an empty file.
pub(crate) fn parse(path: &Path) -> Result<Vec<(usize, Line)>, Error> {
    let rows = numbered_rows(path)?;
    let bad = |at: usize, reason| Error::ReferenceLine { path: path.into(), line: at, reason };
    let lines: Vec<(usize, Line)> = rows
        .iter()
        .map(|(at, row)| line(row).map(|line| (*at, line)).map_err(|e| bad(*at, e)))
        .collect::<Result<_, _>>()?;
    let is_decided = |(_, line): &(usize, Line)| {
        !matches!(line, Line::ImmediateBasin { edge: Edge::Unknown, .. })
    };
    if lines.iter().any(is_decided) {
        Ok(lines)
    } else {
        Err(Error::NoReference { path: path.into() })
    }
}

/// The question and the answer of one JSON object.
pub(crate) fn line(value: &Value) -> Result<Line, String> {
    // Every known kind has one of these fields.
    if ["alpha_star", "mu_c", "edge", "offset", "alpha"].iter().all(|key| value.get(key).is_none())
    {
        return Err(
            "this is none of the known kinds: a hop, a loss, a hop near a fixed point, a fate, \
                    a fixed point, a trap or a crisis"
                .into(),
        );
    }
    if value.get("alpha_star").is_some() {
        let (n, alpha_star) = (whole(value, "n")?, number(value, "alpha_star")?);
        return Ok(Line::FixedPoint { n, alpha_star });
    }
    if value.get("mu_c").is_some() {
        let (n, mu) = (whole(value, "n")?, number(value, "mu_c")?);
        let (mass_ratio, alpha) = (number(value, "M_c")?, number(value, "alpha_touch")?);
        return Ok(Line::Crisis { n, mu, mass_ratio, alpha });
    }
    let mass_ratio = MassRatio::new(number(value, "mass_ratio")?).map_err(|e| e.to_string())?;
    if let Some(fate) = value.get("fate") {
        let fate = match fate.as_str() {
            Some("incessant") => HopperFate::Incessant { n: whole(value, "n")? },
            Some("decaying") => HopperFate::Decaying,
            Some("grounded") => HopperFate::Grounded,
            _ => return Err(format!("'fate' is {fate}, not incessant, decaying or grounded")),
        };
        return Ok(Line::Fate { mass_ratio, alpha: number(value, "alpha")?, fate });
    }
    if let Some(edge) = value.get("edge") {
        let edge = match edge.as_str().and_then(|text| text.split(':').next()) {
            Some("contact") => Edge::Contact,
            Some("sudden") => Edge::Sudden,
            Some("none") => Edge::None,
            Some("not decided") => Edge::Unknown,
            _ => return Err(format!("'edge' is {edge}, which is none of the known kinds")),
        };
        let (n, delta) = (whole(value, "n")?, next(value, "delta_exact")?);
        return Ok(Line::ImmediateBasin { n, mass_ratio, edge, delta });
    }
    if value.get("offset").is_some() {
        return Ok(Line::Local {
            mass_ratio,
            n: whole(value, "n")?,
            offset: number(value, "offset")?,
            sudden: whole(value, "sudden")? as usize,
            next: next(value, "offset_next")?,
        });
    }
    if value.get("class").and_then(Value::as_str) == Some("tiny_alpha_loss") {
        let (alpha, loss) = (number(value, "alpha")?, number(value, "loss")?);
        return Ok(Line::Loss(Loss { mass_ratio, alpha, loss }));
    }
    let speed = next(value, "alpha_next")?;
    if let Some(bad) = speed.filter(|speed| !(*speed > 0.0)) {
        return Err(format!("'alpha_next' is {bad}, not positive"));
    }
    let slope = |key| if value.get(key).is_some() { number(value, key) } else { Ok(0.0) };
    Ok(Line::Hop(ReferenceHop {
        class: value.get("class").and_then(Value::as_str).unwrap_or("hop").to_owned(),
        mass_ratio,
        alpha: number(value, "alpha")?,
        sudden: whole(value, "sudden")? as usize,
        next: speed,
        slope_alpha: slope("dalpha_next_dalpha")?.abs(),
        slope_mass_ratio: slope("dalpha_next_dM")?.abs(),
    }))
}

/// The result of a hop: a number, or null if the hopper stays on the ground.
fn next(value: &Value, key: &str) -> Result<Option<f64>, String> {
    match value.get(key) {
        None => Err(format!("'{key}' is missing")),
        Some(Value::Null) => Ok(None),
        Some(_) => number(value, key).map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Line, String> {
        line(&serde_json::from_str(text).unwrap())
    }

    #[test]
    fn errors_name_the_defect_of_a_line() {
        for (text, words) in [
            ("{}", "none of the known kinds"),
            ("3", "none of the known kinds"),
            ("null", "none of the known kinds"),
            ("[]", "none of the known kinds"),
            (r#"{"mass_ratio": 1, "beta": 5}"#, "none of the known kinds"),
            (r#"{"alpha": 1}"#, "'mass_ratio' is missing"),
            (r#"{"mass_ratio": "x", "alpha": 1}"#, "'mass_ratio' is \"x\", not a number"),
            (r#"{"mass_ratio": 1, "alpha": 5, "fate": "lost"}"#, "not incessant"),
            (r#"{"mass_ratio": 1, "alpha": 5, "sudden": 0}"#, "'alpha_next' is missing"),
            (r#"{"mass_ratio": 0, "alpha": 5}"#, "not 0"),
            (
                r#"{"mass_ratio": 1, "alpha": 5, "sudden": 0, "alpha_next": "0"}"#,
                "is 0, not positive",
            ),
            (r#"{"mass_ratio": 1, "alpha": 5, "sudden": -1, "alpha_next": "4"}"#, "'sudden' is -1"),
        ] {
            let error = parsed(text).err().unwrap();
            assert!(error.contains(words), "{error}");
        }
    }

    #[test]
    fn files_without_a_value_to_compare_are_errors() {
        let path = std::env::temp_dir().join(format!("hopper_reference_{}", std::process::id()));
        let undecided = r#"{"n": 1, "mass_ratio": 1, "edge": "not decided", "delta_exact": null}"#;
        for text in ["", "\n", " \n\t\n", "[]", " [ ]\n", undecided] {
            std::fs::write(&path, text).unwrap();
            let error = parse(&path).err().unwrap();
            assert!(matches!(error, Error::NoReference { .. }), "{text:?}: {error}");
            assert!(error.to_string().contains("hopper_reference_"), "{error}");
        }
        std::fs::remove_file(&path).unwrap();
    }
}
