//! `check-reference`: compares the map and the fates with files of reference values.

use crate::error::Error;
use crate::reference::{Edge, Line, Loss, ReferenceHop, parse};
use hopper_basin::{Fates, ImmediateBasinEdge, crisis, immediate_basin};
use hopper_reference::UNITS_PER_FLIGHT;
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Allowed error in units, 0 < K ≤ 1e15. A hop is allowed K (1 + sudden lift-offs) units; its unit is the
    /// effect of half an ulp in α, M, α′ and α² together. For a hop near a fixed point, given as n and offset, K
    /// units of two ulps of the next offset are allowed for any number of lift-offs. For a loss the unit is the
    /// effect of half an ulp in the inputs; for α*_n half an ulp; for a trap a quarter of its stated
    /// bound; for a crisis two ulps
    #[arg(long, value_name = "K", default_value_t = UNITS_PER_FLIGHT, value_parser = limit, allow_hyphen_values = true)]
    limit: f64,
    /// Files with one JSON object a line, or one array of objects: hops, losses, hops near a fixed point,
    /// fates, fixed points, traps, crises. A file without any is an error
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
}

/// The largest accepted limit. The unit of K is about 10⁻¹⁶ of the value compared: past 10¹⁵ an error of a tenth of
/// the value would pass, and the check would check no digit.
const LARGEST_UNITS_PER_FLIGHT: f64 = 1e15;

/// Number of copies of a hop that are computed together. `LiftOffMap::images` computes fewer than 16 one by one. With
/// more it uses its vector loops, which are compared here with the loop for one hop.
const AT_ONCE: usize = 24;

/// Reads the value of `--limit`.
fn limit(text: &str) -> Result<f64, String> {
    let limit: Option<f64> = text.parse().ok();
    limit
        .filter(|k| *k > 0.0 && *k <= LARGEST_UNITS_PER_FLIGHT)
        .ok_or_else(|| format!("K must be a number with 0 < K ≤ {LARGEST_UNITS_PER_FLIGHT:e}"))
}

/// The counts of a class.
#[derive(Default)]
struct Tally {
    lines: usize,
    /// Number of lines with an undecided reference, which cannot be compared.
    skipped: usize,
    /// Lines whose allowed error is as large as the value: a verdict was compared, and no digit.
    verdicts: usize,
    worst: f64,
    worst_place: String,
    over: usize,
    wrong: usize,
    first_wrong: String,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    // All lines are read before the computation starts, so that a malformed line is reported at once.
    let mut parsed = Vec::new();
    for path in &options.files {
        parsed.push((path, parse(path)?));
    }
    let mut out = std::io::stdout().lock();
    let write = |source| crate::error::Error::File { path: "standard output".into(), source };
    let (mut over, mut wrong, mut empty) = (0, 0, Vec::new());
    for (path, lines) in parsed {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let (mut compared, mut digitless) = (0, 0);
        for (class, tally) in judge(&lines, options.limit) {
            compared += tally.lines - tally.skipped;
            digitless += tally.verdicts;
            write!(out, "{name}: {class}: {} lines, ", tally.lines).map_err(write)?;
            if tally.skipped > 0 {
                write!(out, "{} of them without an answer to compare with, ", tally.skipped)
                    .map_err(write)?;
            }
            if tally.verdicts > 0 {
                write!(out, "{} of them without a digit to compare, ", tally.verdicts)
                    .map_err(write)?;
            }
            if !tally.worst_place.is_empty() {
                write!(out, "worst K = {:.2} ({}), ", tally.worst, tally.worst_place)
                    .map_err(write)?;
            }
            write!(out, "{} over the limit, {} wrong decisions", tally.over, tally.wrong)
                .map_err(write)?;
            if tally.wrong > 0 {
                write!(out, " (first: {})", tally.first_wrong).map_err(write)?;
            }
            writeln!(out).map_err(write)?;
            over += tally.over;
            wrong += tally.wrong;
        }
        writeln!(out, "{name}: {compared} values compared").map_err(write)?;
        if digitless > 0 && digitless == compared {
            empty.push(path.display().to_string());
        }
    }
    if over + wrong > 0 {
        return Err(Error::CheckFailed(format!(
            "{over} errors over K = {} (1 + sudden), {wrong} wrong decisions",
            options.limit
        )));
    }
    if !empty.is_empty() {
        return Err(Error::CheckFailed(format!(
            "{}: the allowed error of each line is as large as its value, so no digit was compared; give a smaller \
             --limit, or lines with smaller slopes",
            empty.join(", ")
        )));
    }
    Ok(())
}

fn judge(lines: &[(usize, Line)], limit: f64) -> BTreeMap<String, Tally> {
    let mut tallies: BTreeMap<String, Tally> = BTreeMap::new();
    for (at, line) in lines {
        match line {
            Line::Hop(hop) => {
                judge_hop(tallies.entry(hop.class.clone()).or_default(), *at, hop, limit)
            }
            Line::Local { mass_ratio, n, offset, sudden, next } => {
                let tally = tallies.entry("near_fixed_point".into()).or_default();
                tally.lines += 1;
                let place = format!("M = {}, n = {n}, δ = {offset:e}", mass_ratio.value());
                match LiftOffMap::new(*mass_ratio).hop_near_fixed_point(*n, *offset) {
                    Err(error) => tally.is_wrong(*at, &error.to_string()),
                    Ok(hop) => tally.judge(
                        *at,
                        &place,
                        Judgement {
                            found: (hop.sudden, hop.next),
                            exact: (*sudden, *next),
                            unit: next.map_or(0.0, |next| 2.0 * f64::EPSILON * next.abs())
                                / (1.0 + *sudden as f64),
                        },
                        limit,
                    ),
                }
            }
            Line::Loss(loss) => {
                judge_loss(tallies.entry("losses".into()).or_default(), *at, loss, limit)
            }
            Line::FixedPoint { n, alpha_star: exact } => {
                let tally = tallies.entry("fixed points".into()).or_default();
                let unit = 0.5 * f64::EPSILON * exact;
                tally.value(*at, &format!("n = {n}"), alpha_star(*n), *exact, unit, limit);
            }
            Line::Crisis { n, mu, mass_ratio, alpha } => {
                let tally = tallies.entry("crises".into()).or_default();
                match crisis(*n) {
                    Err(error) => tally.is_wrong(*at, &error.to_string()),
                    // The map has a minimum at this α. An error of one ulp in the value of the map moves the minimum by
                    // √ulp ≈ 10⁻⁸, which is 10⁸ ulps.
                    Ok(found) => {
                        for (what, found, exact, ulps) in [
                            ("μ", found.mu, *mu, 2.0),
                            ("M", found.mass_ratio, *mass_ratio, 2.0),
                            ("α", found.alpha, *alpha, 1e8),
                        ] {
                            let (place, unit) =
                                (format!("n = {n}, {what}"), ulps * f64::EPSILON * exact);
                            tally.value(*at, &place, found, exact, unit, limit);
                        }
                    }
                }
            }
            Line::ImmediateBasin { n, mass_ratio, edge, delta } => {
                let tally = tallies.entry("traps".into()).or_default();
                judge_immediate_basin(tally, *at, (*n, *mass_ratio), (*edge, *delta), limit);
            }
            Line::Fate { mass_ratio, alpha, fate } => {
                let tally = tallies.entry("fates".into()).or_default();
                tally.lines += 1;
                let found = Fates::new(*mass_ratio).and_then(|fates| fates.fate(*alpha));
                if found.as_ref() != Ok(fate) {
                    tally.is_wrong(*at, &format!("{fate:?} expected, {found:?} found"));
                }
            }
        }
    }
    tallies
}

/// The edge must be of the right kind, and Δ within its stated bound.
fn judge_immediate_basin(
    tally: &mut Tally,
    at: usize,
    (n, mass_ratio): (u64, MassRatio),
    (edge, delta): (Edge, Option<f64>),
    limit: f64,
) {
    // Spacing of the scan for needles in a sudden window. The reference does not state its own spacing. Needles
    // narrower than this are missed; the time is inversely proportional to the spacing.
    const WIDTH: f64 = 1e-3;
    let found =
        match Fates::new(mass_ratio).and_then(|fates| immediate_basin(fates.map(), n, WIDTH)) {
            Ok(found) => found,
            Err(error) => return tally.is_wrong(at, &error.to_string()),
        };
    let right = match edge {
        Edge::Contact => found.edge == ImmediateBasinEdge::Contact,
        Edge::Sudden => matches!(found.edge, ImmediateBasinEdge::Sudden { .. }),
        Edge::None => matches!(
            found.edge,
            ImmediateBasinEdge::NextFixedPoint | ImmediateBasinEdge::NotFound { .. }
        ),
        Edge::Unknown => true, // the reference itself is not decided; this line is skipped below
    };
    if !right {
        return tally.is_wrong(at, &format!("{edge:?} expected, {:?} found", found.edge));
    }
    let place = format!("n = {n}, M = {}", mass_ratio.value());
    match delta.filter(|_| edge != Edge::Unknown) {
        // M is read from a decimal number: its rounding by half an ulp also shifts Δ.
        Some(exact) => {
            let unit = 0.25 * found.error + f64::EPSILON * exact;
            tally.value(at, &place, found.delta, exact, unit, limit);
        }
        None => {
            tally.lines += 1;
            tally.skipped += usize::from(edge == Edge::Unknown);
        }
    }
}

fn judge_loss(tally: &mut Tally, at: usize, line: &Loss, limit: f64) {
    tally.lines += 1;
    let Loss { mass_ratio, alpha, loss } = *line;
    let found = match LiftOffMap::new(mass_ratio).hop(alpha) {
        Ok(found) => found,
        Err(error) => return tally.is_wrong(at, &error.to_string()),
    };
    let place = format!("M = {}, α = {alpha}", mass_ratio.value());
    // Loss ∝ μα⁵: half an ulp in α is five halves in the loss; M and the result add half an ulp each: 7/2 ulps.
    let judgement = Judgement {
        found: (0, found.loss),
        exact: (0, Some(loss)),
        unit: 3.5 * f64::EPSILON * loss,
    };
    tally.judge(at, &place, judgement, limit);
}

fn judge_hop(tally: &mut Tally, at: usize, hop: &ReferenceHop, limit: f64) {
    tally.lines += 1;
    let found = match LiftOffMap::new(hop.mass_ratio).hop(hop.alpha) {
        Ok(found) => found,
        Err(error) => return tally.is_wrong(at, &error.to_string()),
    };
    let mut many = [Some(hop.alpha); AT_ONCE];
    if LiftOffMap::new(hop.mass_ratio).images(&mut many).is_err()
        || many.iter().any(|image| *image != found.next)
    {
        return tally.is_wrong(at, "another image among many at once");
    }
    let place = format!("M = {}, α = {}", hop.mass_ratio.value(), hop.alpha);
    let judgement = Judgement {
        found: (found.sudden, found.next),
        exact: (hop.sudden, hop.next),
        unit: hop.unit(),
    };
    tally.judge(at, &place, judgement, limit);
}

/// A result and the exact one, each with the number of sudden lift-offs and the next speed or offset.
struct Judgement {
    found: (usize, Option<f64>),
    exact: (usize, Option<f64>),
    unit: f64,
}

impl Tally {
    /// Compares a number that has no count of sudden lift-offs.
    fn value(&mut self, at: usize, place: &str, found: f64, exact: f64, unit: f64, limit: f64) {
        self.lines += 1;
        let judgement = Judgement { found: (0, Some(found)), exact: (0, Some(exact)), unit };
        self.judge(at, place, judgement, limit);
    }

    fn judge(&mut self, at: usize, place: &str, judgement: Judgement, limit: f64) {
        let Judgement { found, exact, unit } = judgement;
        if found.0 != exact.0 || found.1.is_some() != exact.1.is_some() {
            return self
                .is_wrong(at, &format!("{exact:?} sudden and next expected, {found:?} found"));
        }
        let (Some(next), Some(right)) = (found.1, exact.1) else { return };
        let error = (next - right).abs();
        let k = if error == 0.0 { 0.0 } else { error / unit };
        let allowed = limit * (1 + exact.0) as f64;
        self.over += usize::from(!(k <= allowed));
        // A result of 0 is exact.
        self.verdicts += usize::from(right != 0.0 && !(allowed * unit < right.abs()));
        if !(k <= self.worst) || self.worst_place.is_empty() {
            self.worst = k;
            self.worst_place = format!("line {at}: {place}, sudden = {}", exact.0);
        }
    }

    fn is_wrong(&mut self, at: usize, text: &str) {
        self.wrong += 1;
        if self.first_wrong.is_empty() {
            self.first_wrong = format!("line {at}: {text}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::line;

    #[test]
    fn a_wrong_value_and_a_wrong_decision_are_counted() {
        let good = r#"{"class": "c", "mass_ratio": 1, "alpha": 100, "sudden": 0, "alpha_next": "35.997158341573688180303069833057"}"#;
        let off = good.replace("35.9971583415", "35.9971583416");
        let verdict_line = good.replace("\"sudden\": 0", "\"sudden\": 1");
        let lines: Vec<_> = [good, &off, &verdict_line]
            .iter()
            .map(|text| line(&serde_json::from_str(text).unwrap()).unwrap())
            .enumerate()
            .collect();
        let tally = judge(&lines, 4.0).remove("c").unwrap();
        assert_eq!((tally.lines, tally.over, tally.wrong), (3, 1, 1));
        assert!(tally.worst_place.starts_with("line 1"));
    }
}
