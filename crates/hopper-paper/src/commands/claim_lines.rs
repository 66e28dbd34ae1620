//! Claims on the terminal.

use crate::claims::{Claim, Verdict};
use crate::error::Error;
use journal_figures::html;

/// A claim as one line without markup.
pub(super) fn line(claim: &Claim) -> String {
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

/// # Errors
/// [`Error::CheckFailed`] with the number of claims that fail.
pub(super) fn all_hold(claims: &[Claim]) -> Result<(), Error> {
    match claims.iter().filter(|claim| claim.verdict == Verdict::Fails).count() {
        0 => Ok(()),
        count => Err(Error::CheckFailed(format!("{count} claims fail"))),
    }
}
