//! The number of lines of a model in a source.

/// The lines between `begin NAME` and the next `end`, comments and empty lines left out; 0 if the source has no such
/// model.
pub(super) fn model_lines(source: &str, name: &str) -> usize {
    let text = |line: &str| line.trim().trim_start_matches(['/', '#']).trim().to_owned();
    let is_comment = |line: &str| line.trim().starts_with("//") || line.trim().starts_with('#');
    let begin = format!("begin {name}");
    source
        .lines()
        .skip_while(|line| !(is_comment(line) && text(line) == begin))
        .take_while(|line| !(is_comment(line) && text(line) == "end"))
        .filter(|line| !is_comment(line) && !line.trim().is_empty())
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_code_between_two_marks_are_counted() {
        let rust =
            "x\n// begin ball\nfn ball() {\n    // why\n\n}\n// end\n// begin relay\ny\n// end\n";
        assert_eq!((model_lines(rust, "ball"), model_lines(rust, "relay")), (2, 1));
        let python = "# begin scipy ball\ndef ball():\n    # why\n    pass\n\n\n# end\n";
        assert_eq!((model_lines(python, "scipy ball"), model_lines(python, "ball")), (2, 0));
    }
}
