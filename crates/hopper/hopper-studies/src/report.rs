//! `report.html`: one file with its images inside, for any browser.

use crate::beyond::Finding;
use crate::claims::{Claim, Ground, Verdict};
use crate::figure::Figure;
use journal_figures::{Rendered, base64, html};
use std::fmt::Write;

const STYLE: &str = "body{font:17px/1.5 'STIX Two Text','Times New Roman',serif;max-width:1180px;margin:2em \
                     auto;padding:0 1em;color:#111}\
h1{font-size:1.7em;line-height:1.2}h2{margin-top:2em;border-bottom:1px solid #999}figure{margin:2em 0}figure \
img{max-width:100%;display:block;margin:auto}\
figcaption{font-size:.93em}.paper{border-left:3px solid \
#bbb;padding-left:.8em;color:#333}table{border-collapse:collapse;font-size:.86em;width:100%}\
th,td{border-bottom:1px solid #ccc;padding:.35em .5em;text-align:left;vertical-align:top}th{border-bottom:2px solid \
#333}\
.confirmed{color:#0b6b3a;font-weight:bold}.corrected{color:#9a5b00;font-weight:bold}.theorem{color:#1f4e96;font-weight:bold}.fails{color:#b00020;font-weight:bold}small{color:#444}";

/// Details that are illegible in our copy of the paper, and the choice made for each.
const ILLEGIBLE: &[&str] = &[
    "The mass ratios of Fig. 2: 0.05, 0.1, 0.2 and 1 are shown.",
    "The mass ratio of Fig. 3: 0.8, at which all four segments exist.",
    "The scale of Fig. 5, which is a sketch in the paper: the real map at $M$ = 0.4.",
    "The lower limit of $M$ in Fig. 6, the upper limits of $α$ in Figs. 6 and 7, all limits of Fig. 8: [0.02, 1] × \
     [$α$^{∗}_{1}, $α$^{∗}_{6}], [1, 10] × [$α$^{∗}_{1}, $α$^{∗}_{6}] and [0.1, 0.2] × [14.066, 20.371].",
    "A digit of the measure at $M$ = 0.2: read as 0.037, which is also the computed value.",
    "The factor 6 in $β$ (printed like a B), and a minus sign in Eq. 13.",
    "Colours beyond the third fixed point: purple, then near black.",
];

/// The report of the paper's figures and claims.
pub(crate) fn page(
    figures: &[(Figure, Rendered)],
    claims: Option<&[Claim]>,
    seconds: f64,
) -> String {
    let mut out = format!(
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>A simple hopper, recomputed</title>\
         <style>{STYLE}</style></head><body><h1>Multimodal map and complex basin of attraction of a simple hopper, \
         recomputed</h1>\
         <p>Every figure and number of C. K. Reddy and R. Pratap's paper, computed from the equations of motion. \
         All quantities are dimensionless: lengths in units of <i>m</i><sub>2</sub><i>g</i>/<i>k</i>, times of \
         1/<i>ω</i>. \
         Computed in {seconds:.1} s.</p>"
    );
    if let Some(claims) = claims {
        summary(&mut out, claims);
        table(&mut out, claims);
        erratum(&mut out, claims);
    } else {
        out.push_str("<p>Only some figures were requested; the claims were not checked.</p>");
    }
    out.push_str("<h2>Figures</h2>");
    for (figure, rendered) in figures {
        drawing(&mut out, figure, rendered, "");
    }
    out.push_str(
        "<h2>Details that are illegible in our copy of the paper, and our choices</h2><ul>",
    );
    for item in ILLEGIBLE {
        let _ = write!(out, "<li>{}</li>", html(item));
    }
    out.push_str("</ul></body></html>\n");
    out
}

/// The report of the results beyond the paper.
pub(crate) fn findings_page(findings: &[(Finding, Rendered)]) -> String {
    let mut out = format!(
        "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Basins of a simple hopper</title>\
         <style>{STYLE}</style></head><body><h1>Basins of a simple hopper: what the paper could not say</h1>\
         <p>Beyond C. K. Reddy and R. Pratap's paper: measures with errors, the structure of the boundary, its \
         dimension and entropy, and how far each answer is certain.</p>"
    );
    for (finding, rendered) in findings {
        drawing(&mut out, &finding.figure, rendered, &findings_table(finding));
    }
    out.push_str("</body></html>\n");
    out
}

fn findings_table(finding: &Finding) -> String {
    let mut out = String::from("<table><tr>");
    for name in &finding.table.header {
        let _ = write!(out, "<th>{}</th>", html(name));
    }
    out.push_str("</tr>");
    for row in &finding.table.rows {
        out.push_str("<tr>");
        for cell in row {
            let _ = write!(out, "<td>{}</td>", html(cell));
        }
        out.push_str("</tr>");
    }
    out.push_str("</table>");
    out
}

/// A figure with its texts, followed by `after`.
fn drawing(out: &mut String, figure: &Figure, rendered: &Rendered, after: &str) {
    let _ = write!(
        out,
        "<figure id=\"{name}\"><img alt=\"{name}\" src=\"data:image/svg+xml;base64,{image}\">\
         <figcaption><b>{title}.</b><p class=\"paper\">The paper: \
         {paper}</p><p>{notes}</p>{after}{data}</figcaption></figure>",
        name = figure.name,
        image = base64(rendered.svg.as_bytes()),
        title = html(&figure.title),
        paper = html(&figure.paper),
        notes = html(&figure.notes),
        data = data(figure),
    );
}

fn data(figure: &Figure) -> String {
    let names: Vec<&str> = figure.data.iter().map(|file| file.name.as_str()).collect();
    if names.is_empty() {
        return String::new();
    }
    format!("<p><small>Data: {}</small></p>", names.join(", "))
}

fn word(verdict: Verdict) -> (&'static str, &'static str) {
    match verdict {
        Verdict::Confirmed => ("confirmed", "confirmed"),
        Verdict::Corrected => ("corrected", "the paper is corrected"),
        Verdict::ByConstruction => ("theorem", "by construction"),
        Verdict::Fails => ("fails", "FAILS"),
    }
}

fn summary(out: &mut String, claims: &[Claim]) {
    let count = |verdict| claims.iter().filter(|claim| claim.verdict == verdict).count();
    let _ = write!(
        out,
        "<p><b>{} claims: {} confirmed, {} corrected with evidence, {} by construction, {} failed.</b></p>\
         <p>A claim is <span class=\"confirmed\">confirmed</span> if a test that does not contain it agrees with it. \
         The paper \
         is <span class=\"corrected\">corrected</span> where the claim is wrong or incomplete and such a test confirms \
         the correction. A claim holds <span class=\"theorem\">by construction</span> if it is a theorem in this form: \
         the code uses the theorem's formula, so that a computation can show only that the code agrees with it. Each \
         row names its test, and the statement of docs/theory.md if the claim is proved there.</p>",
        claims.len(),
        count(Verdict::Confirmed),
        count(Verdict::Corrected),
        count(Verdict::ByConstruction),
        count(Verdict::Fails)
    );
}

fn table(out: &mut String, claims: &[Claim]) {
    out.push_str("<h2>Claims</h2><table><tr><th>Claim</th><th>The paper</th><th>Ours</th><th>Error</th><th>How \
                  computed, test and proof</th><th>Verdict</th></tr>");
    for claim in claims {
        let (class, text) = word(claim.verdict);
        let _ = write!(
            out,
            "<tr><td><b>{}</b><br><small>{}</small></td><td>{}</td><td>{}</td><td>{}</td><td><small>{}.<br>{}</small></td><td class=\"{class}\">{text}</td></tr>",
            html(claim.name),
            html(claim.place),
            html(&claim.paper),
            html(&claim.ours),
            html(&claim.error),
            html(&claim.how),
            ground(&claim.ground)
        );
    }
    out.push_str("</table>");
}

/// The test of a claim and the statement that proves it.
fn ground(ground: &Ground) -> String {
    let test = ground.test().map(|test| format!("<b>Test:</b> {}.", html(test)));
    let proof =
        ground.proof().map(|proof| format!("<b>Proof:</b> docs/theory.md, {}.", html(proof)));
    test.into_iter().chain(proof).collect::<Vec<_>>().join("<br>")
}

fn erratum(out: &mut String, claims: &[Claim]) {
    let Some(claim) = claims.iter().find(|claim| claim.name.starts_with("λ")) else { return };
    let _ = write!(
        out,
        "<h2>The erratum on <i>λ</i></h2><p>With <i>t</i> = <i>τ</i> − 2<i>α</i>* and <i>δ</i> = <i>α</i> − <i>α</i>* \
         the hop loses \
         <i>α</i>² − <i>α</i>′² = 2<i>αμ</i>[(2<i>α</i>* − sin 2<i>α</i>*)<i>δt</i> − <i>αt</i>⁴/24 + …]. \
         Both terms are of order <i>δ</i><sup>4/3</sup>, since <i>t</i> ≈ <i>βδ</i><sup>1/3</sup>, and the second is a \
         quarter of the first; \
         the paper keeps the first only. So <i>λ</i> is ¾ of the printed value, and <i>λ</i><sup>−3</sup> is 64/27 of \
         it.</p>\
         <p>Evidence: {}. {}.</p>",
        html(&claim.ours),
        html(&claim.error)
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(verdict: Verdict, ground: Ground) -> Claim {
        Claim {
            name: "a claim",
            place: "Sec. I",
            paper: String::new(),
            ours: String::new(),
            error: String::new(),
            how: String::new(),
            ground,
            verdict,
        }
    }

    #[test]
    fn a_row_names_its_test_and_its_proof() {
        let tested = Ground::Test { test: "the printed map", proof: Some("Lemma 6") };
        let theorem = Ground::Theorem { proof: "Corollary 10" };
        let claims = [claim(Verdict::Confirmed, tested), claim(Verdict::ByConstruction, theorem)];
        let page = page(&[], Some(&claims), 0.0);
        let row = |part: &str| page.matches(part).count();
        assert_eq!(
            row("<b>Test:</b> the printed map.<br><b>Proof:</b> docs/theory.md, Lemma 6."),
            1
        );
        assert_eq!(row("<b>Proof:</b> docs/theory.md, Corollary 10."), 1);
        assert_eq!(row("<td class=\"theorem\">by construction</td>"), 1);
        assert_eq!(
            row("2 claims: 1 confirmed, 0 corrected with evidence, 1 by construction, 0 failed"),
            1
        );
    }
}
