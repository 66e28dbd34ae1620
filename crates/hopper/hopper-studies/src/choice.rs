//! Entries of a table chosen by name, for `--only`.

use crate::error::Error;

/// The entries with these names, in the order of the names; all of them if none is named.
///
/// # Errors
/// [`Error::UnknownName`] with all names that exist; `kind` is the kind of the names.
pub(crate) fn named<T: Copy>(
    kind: &'static str,
    all: &[(&'static str, T)],
    names: &[String],
) -> Result<Vec<(&'static str, T)>, Error> {
    if names.is_empty() {
        return Ok(all.to_vec());
    }
    let find = |name: &String| {
        all.iter().find(|(known, _)| known == name).copied().ok_or_else(|| Error::UnknownName {
            kind,
            name: name.clone(),
            known: all.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(", "),
        })
    };
    names.iter().map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_name_is_an_error_that_lists_the_known_ones() {
        let all = [("one", 1), ("two", 2)];
        assert_eq!(named("number", &all, &[]).unwrap(), all);
        assert_eq!(named("number", &all, &["two".into()]).unwrap(), [("two", 2)]);
        let error = named("number", &all, &["three".into()]).unwrap_err().to_string();
        assert_eq!(error, "there is no number 'three'; there are: one, two");
    }
}
