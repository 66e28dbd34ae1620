//! A drawing as the text of an SVG file: outlines only, no fonts.

use crate::label::escape;
use crate::path::number;
use crate::svg::{Element, Pen, Svg, base64};
use std::fmt::Write;

/// The text of an SVG file.
pub(crate) fn document(svg: &Svg) -> String {
    let (width, height) = (svg.width, svg.height);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {width} {height}\">\n"
    );
    write_elements(&mut out, &svg.elements, &mut 0);
    out.push_str("</svg>\n");
    out
}

/// Writes elements; `clips` counts the clip paths, whose names must differ within a file.
fn write_elements(out: &mut String, elements: &[Element], clips: &mut usize) {
    for element in elements {
        match element {
            Element::Shape { path, fill, pen } => {
                let fill = fill.unwrap_or("none");
                let stroke = pen.map_or_else(String::new, stroke);
                let _ = writeln!(out, "<path fill=\"{fill}\"{stroke} d=\"{}\"/>", path.data());
            }
            Element::Label { path, text } => {
                let text = escape(text);
                let _ = writeln!(out, "<path aria-label=\"{text}\" d=\"{}\"/>", path.data());
            }
            Element::Image { corner: (x, y), size: (width, height), png } => {
                let _ = writeln!(
                    out,
                    "<image x=\"{x:.3}\" y=\"{y:.3}\" width=\"{width:.3}\" height=\"{height:.3}\" \
                     preserveAspectRatio=\"none\" image-rendering=\"optimizeSpeed\" \
                     xlink:href=\"data:image/png;base64,{}\"/>",
                    base64(png)
                );
            }
            Element::Clipped { inside, elements } => {
                *clips += 1;
                let _ = writeln!(
                    out,
                    "<clipPath id=\"clip{clips}\"><path d=\"{}\"/></clipPath>\n\
                     <g clip-path=\"url(#clip{clips})\">",
                    inside.data()
                );
                write_elements(out, elements, clips);
                out.push_str("</g>\n");
            }
        }
    }
}

fn stroke(pen: Pen) -> String {
    let mut out = format!(" stroke=\"{}\" stroke-width=\"", pen.color);
    number(&mut out, pen.width);
    out.push_str("\" stroke-linejoin=\"round\"");
    if !pen.dash.is_empty() {
        let _ = write!(out, " stroke-dasharray=\"{}\"", pen.dash);
    }
    out
}
