//! A drawing as SVG.

use std::fmt::Write as _;

use super::font::FAMILY;
use super::path::UNITS_PER_PIXEL;
use super::{Anchor, Drawing, Item, PIXELS_PER_MM, Paint, PathData, TEXT, TextLine, hex};

impl Drawing {
    /// The drawing as the text of an SVG file with a title.
    pub fn to_svg(&self, title: &str) -> String {
        let [width, height] = self.size;
        let [across, down] = self.size.map(|pixels| pixels / PIXELS_PER_MM);
        let mut svg = format!(
            "<svg width=\"{across:.3}mm\" height=\"{down:.3}mm\" viewBox=\"0 0 {width:.2} {height:.2}\" \
             xmlns=\"http://www.w3.org/2000/svg\" font-family=\"{FAMILY}, Verdana, sans-serif\" fill=\"{}\">\n",
            hex(TEXT)
        );
        if !title.is_empty() {
            // Writing to a string cannot fail.
            let _ = writeln!(svg, "<title>{}</title>", escaped(title));
        }
        for (place, item) in self.items.iter().enumerate() {
            let _ = match item {
                Item::Path(path, paint) => writeln!(
                    svg,
                    "<path transform=\"scale({})\"{} d=\"{}\"/>",
                    1.0 / UNITS_PER_PIXEL,
                    attributes(paint, UNITS_PER_PIXEL),
                    data(path)
                ),
                Item::Circle([x, y], radius, paint) => writeln!(
                    svg,
                    "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\"{}/>",
                    attributes(paint, 1.0)
                ),
                Item::Text(line) => writeln!(svg, "{}", text_element(line)),
                Item::Window([[x, y], [width, height]]) => writeln!(
                    svg,
                    "<clipPath id=\"window-{place}\"><rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\"/>\
                     </clipPath>\n<g clip-path=\"url(#window-{place})\">"
                ),
                Item::WindowEnd => writeln!(svg, "</g>"),
            };
        }
        svg + "</svg>\n"
    }
}

/// The attributes of a paint, with `units` per pixel of its lengths.
fn attributes(paint: &Paint, units: f64) -> String {
    let mut attributes = format!(" fill=\"{}\"", paint.fill.map_or("none".to_owned(), hex));
    if let Some((colour, width)) = paint.stroke {
        let _ = write!(
            attributes,
            " stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"{}\"",
            hex(colour),
            rounded_length(width * units),
            if paint.dashes.is_some() {
                "butt"
            } else {
                "round"
            }
        );
    }
    if let Some(dashes) = paint.dashes {
        let [dash, gap] = dashes.map(|it| rounded_length(it * units));
        let _ = write!(attributes, " stroke-dasharray=\"{dash} {gap}\"");
    }
    attributes
}

/// A length to a hundredth.
fn rounded_length(length: f64) -> f64 {
    (100.0 * length).round() / 100.0
}

fn text_element(line: &TextLine) -> String {
    let [x, y] = line.at;
    let place = match line.is_upright {
        true => format!("transform=\"translate({x:.2} {y:.2}) rotate(-90)\""),
        false => format!("x=\"{x:.2}\" y=\"{y:.2}\""),
    };
    let anchor = match line.anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let (size, text) = (rounded_length(line.size), escaped(&line.text));
    format!("<text {place} font-size=\"{size}\"{anchor}>{text}</text>")
}

/// The text as content of an element; characters that XML does not allow are left out.
fn escaped(text: &str) -> String {
    let text = text.replace(char::is_control, "").replace('&', "&amp;");
    text.replace('<', "&lt;").replace('>', "&gt;")
}

/// The data of a path: each corner relative to the one before.
fn data(path: &PathData) -> String {
    let mut data = String::new();
    let mut at = [0; 2];
    for (points, is_closed) in path.pieces() {
        for (place, point) in points.iter().enumerate() {
            match place {
                0 => data.push('m'),
                1 => data.push('l'),
                _ => {}
            }
            let [x, y] = [point[0] - at[0], point[1] - at[1]];
            // A minus sign separates numbers like a space.
            let before = if place > 1 && x >= 0 { " " } else { "" };
            let between = if y >= 0 { " " } else { "" };
            let _ = write!(data, "{before}{x}{between}{y}");
            at = *point;
        }
        if is_closed {
            data.push('z');
            at = points[0];
        }
    }
    data
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative_whole_numbers() {
        let mut path = PathData::default();
        path.outline([[1.0, 1.0], [2.0, 1.0], [2.0, 0.5], [2.0, 0.501], [1.0, 1.0]]);
        path.segment([[0.0, 0.0], [-0.5, 0.25]]);
        let expected = "m100 100l100 0 0-50zm-100-100l-50 25";
        assert_eq!(data(&path), expected);
        path.outline([[0.0, 0.0], [0.001, 0.0], [5.0, 5.0]]);
        assert_eq!(data(&path), expected, "an outline without area");
    }

    #[test]
    fn text_is_escaped_and_the_size_is_in_mm() {
        let mut drawing = Drawing::new([96.0, 48.0]);
        drawing.text([1.0, 2.0], Anchor::Middle, 9.0, "a<b & \u{7}c");
        let svg = drawing.to_svg("<t>");
        assert!(svg.contains(">a&lt;b &amp; c</text>") && svg.contains("<title>&lt;t&gt;</title>"));
        assert!(svg.contains("width=\"25.400mm\" height=\"12.700mm\" viewBox=\"0 0 96.00 48.00\""));
    }
}
