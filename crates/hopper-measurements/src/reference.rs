//! Files of reference values: one JSON object a line, or an array of objects.

use crate::error::Error;
use hopper_basin::HopperFate;
use passive_hopper::MassRatio;
use repository_tools::{Error as RowError, number, numbered_rows, repository, whole};
use serde_json::Value;
use std::path::Path;

/// A line: the input of a computation and its exact result.
pub(crate) enum Line {
    Hop(Hop),
    Loss(Loss),
    Local { mass_ratio: MassRatio, n: u64, offset: f64, sudden: usize, next: Option<f64> },
    Fate { mass_ratio: MassRatio, alpha: f64, fate: HopperFate },
    FixedPoint { n: u64, alpha_star: f64 },
    Crisis { n: u64, mu: f64, mass_ratio: f64, alpha: f64 },
    Reach { n: u64, mass_ratio: MassRatio, edge: Edge, delta: Option<f64> },
}

/// Where the right end of a trapping region lies, and how the reference knows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Edge {
    /// On the contact part of the hump; proved.
    Contact,
    /// In the sudden window; found by scanning it.
    Sudden,
    /// The trapping region reaches to the next fixed point.
    None,
    /// Unknown: the needles there are narrower than the spacing of any scan.
    Unknown,
}

/// A hop, with the slopes that give the unit of its error.
pub(crate) struct Hop {
    pub(crate) class: String,
    pub(crate) mass_ratio: MassRatio,
    pub(crate) alpha: f64,
    pub(crate) sudden: usize,
    pub(crate) next: Option<f64>,
    pub(crate) slope_alpha: f64,
    pub(crate) slope_mass_ratio: f64,
}

impl Hop {
    /// The unit of its error: the change of α′ that roundings alone cause.
    ///
    /// ½ε (α′ + |∂α′/∂α| α + |∂α′/∂M| M + α²/α′): half an ulp each in α′ itself, in α, in M, and in α². The
    /// last one counts because α′² = α² − loss is a difference.
    pub(crate) fn unit(&self) -> f64 {
        let scale = self.next.map_or(0.0, |next| {
            next + self.slope_alpha * self.alpha
                + self.slope_mass_ratio * self.mass_ratio.value()
                + self.alpha * (self.alpha / next)
        });
        0.5 * f64::EPSILON * scale
    }

    /// The largest error of α′ that passes: `limit` units for each landing, the last one included.
    pub(crate) fn allowed(&self, limit: f64) -> f64 {
        limit * (1 + self.sudden) as f64 * self.unit()
    }
}

/// Units of error that a landing may add, if the command line does not say otherwise.
///
/// Chosen by measurement: the worst hop of the reference files needs 1.8 units a landing, the worst loss 2.9. An
/// error in a formula exceeds 4 by orders of magnitude.
pub(crate) const LIMIT: f64 = 4.0;

/// A hop so small that α′ rounds to α, and the loss α − α′ is compared instead.
pub(crate) struct Loss {
    pub(crate) mass_ratio: MassRatio,
    pub(crate) alpha: f64,
    pub(crate) loss: f64,
}

/// The file of hops in the paper's window, from the root of the repository.
pub(crate) const WINDOW: &str = "crates/passive-hopper/tests/data/hops_window.jsonl";

/// The hops of [`WINDOW`].
pub(crate) fn window_hops() -> Result<Vec<Hop>, Error> {
    let hops = parse(&repository().join(WINDOW))?.into_iter().filter_map(|(_, line)| match line {
        Line::Hop(hop) => Some(hop),
        _ => None,
    });
    Ok(hops.collect())
}

/// All lines of a file, each with its number from one.
pub(crate) fn parse(path: &Path) -> Result<Vec<(usize, Line)>, Error> {
    let rows = numbered_rows(path)?;
    let bad = |at: usize, reason| {
        Error::from(RowError::ReferenceLine { path: path.into(), line: at, reason })
    };
    rows.iter()
        .map(|(at, row)| line(row).map(|line| (*at, line)).map_err(|e| bad(*at, e)))
        .collect()
}

/// The line that one JSON object holds; its keys decide which kind of line it is.
pub(crate) fn line(value: &Value) -> Result<Line, String> {
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
        return Ok(Line::Reach { n, mass_ratio, edge, delta });
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
    Ok(Line::Hop(Hop {
        class: value.get("class").and_then(Value::as_str).unwrap_or("hop").to_owned(),
        mass_ratio,
        alpha: number(value, "alpha")?,
        sudden: whole(value, "sudden")? as usize,
        next: speed,
        slope_alpha: slope("dalpha_next_dalpha")?.abs(),
        slope_mass_ratio: slope("dalpha_next_dM")?.abs(),
    }))
}

/// The result of a hop: a number, or null for a grounded hopper.
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
    fn malformed_lines_say_what_is_wrong() {
        for (text, words) in [
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
}
