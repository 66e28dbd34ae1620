//! Claims on the terminal.

use crate::claims::{Claim, Ground, Verdict};
use crate::error::Error;
use journal_figures::html;

/// A claim as lines without markup: verdict, name and error; then its test or its theorem.
pub(super) fn line(claim: &Claim) -> String {
    let word = match claim.verdict {
        Verdict::Confirmed => "confirmed",
        Verdict::Corrected => "corrected",
        Verdict::ByConstruction => "by construction",
        Verdict::Fails => "FAILS",
    };
    format!(
        "{word:15}  {:42} {}\n{:15}  {}",
        plain(claim.name),
        plain(&claim.error),
        "",
        plain(&ground(&claim.ground))
    )
}

/// The test of a claim and its theorem, as markup.
fn ground(ground: &Ground) -> String {
    match ground {
        Ground::Test { test, proof: None } => format!("tested by {test}"),
        Ground::Test { test, proof: Some(proof) } => format!("tested by {test}; {proof}"),
        Ground::Theorem { proof } => format!("{proof}; no test"),
    }
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

/// # Errors
/// [`Error::CheckFailed`] with the number of claims that fail.
pub(super) fn all_hold(claims: &[Claim]) -> Result<(), Error> {
    match claims.iter().filter(|claim| claim.verdict == Verdict::Fails).count() {
        0 => Ok(()),
        count => Err(Error::CheckFailed(format!("{count} claims fail"))),
    }
}
