//! The picture beside the example is the one that it draws, and the page of bifurcations shows its lines.

#![allow(missing_docs, clippy::unwrap_used, unreachable_pub, dead_code)]

#[path = "../examples/bifurcation_diagram.rs"]
mod bifurcation_diagram;

#[test]
fn the_picture_beside_the_example() {
    let committed = include_str!("../examples/bifurcation_diagram.svg");
    let drawn = bifurcation_diagram::diagram().unwrap();
    let same = drawn.lines().zip(committed.lines()).position(|(own, old)| own != old);
    let lines = [&drawn[..], committed].map(|text| text.lines().count());
    assert!(
        same.is_none() && lines[0] == lines[1],
        "line {same:?} of {lines:?}: write it anew with cargo run --release -p return-map --example bifurcation_diagram"
    );
}

#[test]
fn the_page_shows_the_lines_of_the_example() {
    let source = include_str!("../examples/bifurcation_diagram.rs");
    let (_, code) = source.split_once("\nuse ").unwrap();
    assert!(include_str!("../../../../docs/bifurcations.md").contains(code));
}
