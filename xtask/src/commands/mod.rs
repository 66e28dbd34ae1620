//! The commands, one file each.

pub mod check_reference;
pub mod reproduce_paper;
pub mod tidy;
pub mod verify_invariance;

use crate::claims::{Claim, Verdict};
use crate::plot::label::html;

/// A claim on a line of the terminal, without markup.
fn line(claim: &Claim) -> String {
    let word = match claim.verdict {
        Verdict::Confirmed => "confirmed",
        Verdict::Corrected => "corrected",
        Verdict::Fails => "FAILS    ",
    };
    format!("{word}  {:38} {}", plain(&claim.name), plain(&claim.error))
}

/// Markup as plain text.
fn plain(markup: &str) -> String {
    let mut text = String::new();
    let mut inside = false;
    for c in html(markup).chars() {
        match c {
            '<' => inside = true,
            '>' => inside = false,
            c if !inside => text.push(c),
            _ => {}
        }
    }
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}

fn failed(claims: &[Claim]) -> usize {
    claims.iter().filter(|claim| claim.verdict == Verdict::Fails).count()
}
