//! Files of reference values: one JSON object a line, or an array of objects.

use crate::error::Error;
use crate::repository::output::read;
use serde_json::Value;
use std::path::Path;

/// The objects of a file, at least one.
pub(crate) fn parse_rows(path: &Path) -> Result<Vec<Value>, Error> {
    Ok(numbered_rows(path)?.into_iter().map(|(_, row)| row).collect())
}

/// The objects of a file, at least one, each with its line; in an array, with its place from one.
pub(crate) fn numbered_rows(path: &Path) -> Result<Vec<(usize, Value)>, Error> {
    let text = read(path)?;
    let bad = |at: usize, reason| Error::ReferenceLine { path: path.into(), line: at, reason };
    let rows: Vec<(usize, Value)> = if text.trim_start().starts_with('[') {
        let rows: Vec<Value> =
            serde_json::from_str(&text).map_err(|e| bad(e.line(), e.to_string()))?;
        (1..).zip(rows).collect()
    } else {
        let filled = text.lines().enumerate().filter(|(_, text)| !text.trim().is_empty());
        filled
            .map(|(index, text)| {
                let row = serde_json::from_str(text).map_err(|e| bad(index + 1, e.to_string()))?;
                Ok((index + 1, row))
            })
            .collect::<Result<_, Error>>()?
    };
    if rows.is_empty() { Err(Error::NoReference { path: path.into() }) } else { Ok(rows) }
}

/// A finite number, given as such or as a decimal string.
pub(crate) fn number(value: &Value, key: &str) -> Result<f64, String> {
    let field = value.get(key).ok_or_else(|| format!("'{key}' is missing"))?;
    let number = field.as_f64().or_else(|| field.as_str().and_then(|text| text.parse().ok()));
    number
        .filter(|n: &f64| n.is_finite())
        .ok_or_else(|| format!("'{key}' is {field}, not a number"))
}

/// A whole number, zero or positive.
pub(crate) fn whole(value: &Value, key: &str) -> Result<u64, String> {
    let field = value.get(key).ok_or_else(|| format!("'{key}' is missing"))?;
    field.as_u64().ok_or_else(|| format!("'{key}' is {field}, not a whole number"))
}
