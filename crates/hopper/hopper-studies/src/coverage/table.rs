//! The measured coverage as a table, for the terminal and for `docs/basins-measured.md`.

use super::tally::{Promise, Row};
use crate::error::Error;
use crate::text::markdown_table;

/// One line for each row.
pub(crate) fn markdown(rows: &[Row]) -> Result<String, Error> {
    let line = |row: &Row| {
        let Row { interval, scene, promise, given, refused, mean_half_width, over_wilson, .. } =
            row;
        let stated = match promise {
            Promise::Probable => "95 %",
            Promise::Certain => "always",
        };
        let contained = match (row.promise, *given) {
            (_, 0) => "–".to_owned(),
            (Promise::Certain, _) if row.covered == row.given => "100 %".to_owned(),
            _ => {
                let share = row.share()?;
                let percent = |part: f64| 100.0 * part;
                format!(
                    "{:.1} % ({:.1} … {:.1})",
                    percent(share.value),
                    percent(share.lower),
                    percent(share.upper)
                )
            }
        };
        let trials = match refused {
            0 => format!("{given}"),
            _ => format!("{given}, {refused} refused"),
        };
        let over = over_wilson.map_or("–".to_owned(), |over| format!("{over:.2}"));
        Ok(format!(
            "`{interval}` | {scene} | {stated} | {trials} | {contained} | {mean_half_width:.1e} | {over}"
        ))
    };
    let columns =
        "interval | scene | stated: | trials: | contained: | mean half width: | over Wilson's:";
    Ok(markdown_table(columns, rows.iter().map(line).collect::<Result<Vec<_>, Error>>()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_shows_its_share_and_its_refusals() {
        let row = Row {
            interval: "planted",
            scene: "one".into(),
            promise: Promise::Probable,
            given: 1000,
            refused: 7,
            covered: 950,
            mean_half_width: 0.0123,
            over_wilson: Some(0.5),
        };
        let certain = Row {
            promise: Promise::Certain,
            covered: 1000,
            refused: 0,
            over_wilson: None,
            ..row.clone()
        };
        let text = markdown(&[row, certain]).unwrap();
        assert!(
            text.contains("| 1000, 7 refused | 95.0 % (93.5 … 96.2) | 1.2e-2 | 0.50 |"),
            "{text}"
        );
        assert!(text.contains("| always | 1000 | 100 % | 1.2e-2 | – |"), "{text}");
    }
}
