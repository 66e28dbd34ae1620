//! Certificates as JSON lines: a header, and one line for each piece of evidence.
//!
//! docs/certificates.md tells the format. A change of a name or a meaning here is a new version of it.

use crate::error::Error;
use crate::repository::Folder;
use basin_of_attraction::Label;
use hopper_basin::HopperFate;
use hopper_proof::{BasinGap, BasinInterval, CERTIFICATE_VERSION, CertificateLine, Theorem};
use resumable_job::AtomicFile;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Writes NAME.jsonl into the folder: its path, and its size. `strips` are the lines for which
/// [`CertificateLine::Strips`] stands, and are written as they come.
pub(super) fn write_certificate(
    theorem: &Theorem,
    mut strips: impl Iterator<Item = Result<CertificateLine, Error>>,
    folder: &Folder,
) -> Result<(PathBuf, usize), Error> {
    let path = folder.path().join(format!("{}.jsonl", theorem.name));
    let mut file = AtomicFile::create(&path)?;
    let mut size = 0;
    let mut write = |value: Value| -> Result<(), Error> {
        let text = format!("{value}\n");
        size += text.len();
        Ok(file.append(text.as_bytes())?)
    };
    write(header(theorem))?;
    for evidence in &theorem.evidence {
        match line(evidence) {
            Some(own) => write(own)?,
            None => {
                for strip in strips.by_ref().take(evidence.lines()) {
                    line(&strip?).map_or(Ok(()), &mut write)?;
                }
            }
        }
    }
    file.finish()?;
    Ok((path, size))
}

fn header(theorem: &Theorem) -> Value {
    json!({
        "format": "passive hopper certificate",
        "version": CERTIFICATE_VERSION,
        "theorem": theorem.name,
        "statement": theorem.statement,
        "lines": theorem.evidence.iter().map(CertificateLine::lines).sum::<usize>(),
    })
}

/// The index of a fixed point, "grounded", or null for a speed without a proof.
fn fate(label: Label) -> Value {
    match label {
        HopperFate::GROUNDED => json!("grounded"),
        label => json!(label.basin_number()),
    }
}

fn intervals(list: &[BasinInterval]) -> Vec<Value> {
    list.iter().map(|(own, label)| json!([own.left, own.right, fate(*label)])).collect()
}

/// [left, right, [fate, least], …] for each gap.
fn gaps(list: &[BasinGap]) -> Vec<Value> {
    let gap = |BasinGap { speeds, at_least }: &BasinGap| {
        let own = at_least.iter().map(|&(label, least)| json!([fate(label), least]));
        Value::Array([json!(speeds.left), json!(speeds.right)].into_iter().chain(own).collect())
    };
    list.iter().map(gap).collect()
}

/// [fate, count] for each run of equal fates.
fn runs(labels: &[Label]) -> Vec<Value> {
    let equal = labels.chunk_by(|a, b| a == b);
    equal.filter_map(|run| Some(json!([fate(*run.first()?), run.len()]))).collect()
}

/// The line of a piece of evidence; `None` for one that stands for other lines.
fn line(evidence: &CertificateLine) -> Option<Value> {
    let value = match evidence {
        CertificateLine::Strips(_) => return None,
        CertificateLine::OneSudden { fixed_point, largest_mass_ratio, available, needed } => {
            json!({
                "kind": "one-sudden", "fixed_point": [fixed_point.low(), fixed_point.high()],
                "largest_mass_ratio": largest_mass_ratio, "available": available, "needed": needed,
            })
        }
        CertificateLine::Trap { n, fixed_point, mass_ratio, right, beyond } => json!({
            "kind": "trap", "n": n, "fixed_point": [fixed_point.low(), fixed_point.high()],
            "mass_ratio": mass_ratio, "right": right, "beyond": beyond,
        }),
        CertificateLine::Crisis { n, mass_ratio, speed } => json!({
            "kind": "crisis", "n": n, "mass_ratio": [mass_ratio.low(), mass_ratio.high()], "speed": speed,
        }),
        CertificateLine::ContactPart { n, mass_ratio, speeds, least_square } => json!({
            "kind": "contact-part", "n": n, "mass_ratio": mass_ratio,
            "speeds": [speeds.low(), speeds.high()], "least_square": least_square,
        }),
        CertificateLine::Losses { multiple_of_pi, mass_ratio, losses, square } => json!({
            "kind": "losses", "multiple_of_pi": multiple_of_pi, "mass_ratio": mass_ratio,
            "losses": losses, "square": square,
        }),
        CertificateLine::RisingWindow { n, speeds, largest_mass_ratio } => json!({
            "kind": "rising-window", "n": n, "speeds": [speeds.low(), speeds.high()],
            "largest_mass_ratio": largest_mass_ratio,
        }),
        CertificateLine::RisingBox { n, speeds, kappas } => json!({
            "kind": "rising-box", "n": n, "speeds": [speeds.low(), speeds.high()],
            "kappas": [kappas.low(), kappas.high()],
        }),
        CertificateLine::Basins { mass_ratios, intervals: list } => json!({
            "kind": "basins", "mass_ratios": [mass_ratios.left, mass_ratios.right],
            "intervals": intervals(list),
        }),
        CertificateLine::Gaps(list) => json!({ "kind": "gaps", "gaps": gaps(list) }),
        CertificateLine::Fraction { label, humps, uniform, by_humps } => json!({
            "kind": "fraction", "fate": fate(*label), "humps": humps,
            "uniform": [uniform.low(), uniform.high()], "by_humps": [by_humps.low(), by_humps.high()],
        }),
        CertificateLine::Grid(grid) => json!({
            "kind": "grid", "mass_ratios": [grid.x.left, grid.x.right],
            "speeds": [grid.y.left, grid.y.right], "columns": grid.columns, "rows": grid.rows,
        }),
        CertificateLine::Speeds(speeds) => json!({ "kind": "speeds", "speeds": speeds }),
        CertificateLine::Points { mass_ratio, traps, labels } => json!({
            "kind": "points", "mass_ratio": mass_ratio, "traps": intervals(traps),
            "fates": runs(labels),
        }),
        CertificateLine::Area { label, share } => json!({
            "kind": "area", "fate": fate(*label), "share": [share.low(), share.high()],
        }),
        CertificateLine::Cells { edges, of_one_basin } => json!({
            "kind": "cells", "edges": edges, "of_one_basin": of_one_basin,
        }),
    };
    Some(value)
}
