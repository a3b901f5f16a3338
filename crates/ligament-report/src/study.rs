//! Head of the page of a study: its intervals of convergence, and the pictures in its folder.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use ligament_output::quantity::{PrefixedUnit, between};
use ligament_output::{Error, read_json};
use serde_json::Value;

use crate::summary::escaped;

/// File of the intervals of convergence in the folder of a study.
const INTERVALS: &str = "convergence.json";

/// Width of the bar of an interval, pixels.
const BAR: f64 = 160.0;

/// A result with its interval, or the reason why it has none.
struct ResultOfStudy {
    name: String,
    label: String,
    unit: String,
    interval: Option<Interval>,
    refused: String,
    mesher: Option<f64>,
    families: Option<f64>,
}

/// Ends of an interval, means at h and 2h, and half-width by scatter alone.
#[derive(Clone, Copy)]
struct Interval {
    lower: f64,
    upper: f64,
    fine: f64,
    coarse: f64,
    by_scatter: f64,
}

impl ResultOfStudy {
    /// The result as the file of the intervals has it.
    fn read(value: &Value) -> Self {
        let text = |key: &str| value[key].as_str().unwrap_or_default().to_owned();
        Self {
            name: text("name"),
            label: text("label"),
            unit: text("unit"),
            interval: Interval::read(&value["interval"]),
            refused: text("refused"),
            mesher: value["mesher"].as_f64(),
            families: value["families"].as_f64(),
        }
    }
}

impl Interval {
    fn read(value: &Value) -> Option<Self> {
        let number = |key: &str| value[key].as_f64();
        Some(Self {
            lower: number("lower")?,
            upper: number("upper")?,
            fine: number("fine")?,
            coarse: number("coarse")?,
            by_scatter: number("by_scatter")?,
        })
    }
}

/// Head of the page of the study in a folder, as HTML.
///
/// # Errors
///
/// If the intervals or a picture cannot be read.
pub(crate) fn head(folder: &Path) -> Result<String, Error> {
    let mut html = String::new();
    let intervals = folder.join(INTERVALS);
    let document: Value = match intervals.is_file() {
        true => read_json(&intervals)?,
        false => Value::Null,
    };
    let results = document["results"].as_array().into_iter().flatten();
    let results: Vec<ResultOfStudy> = results.map(ResultOfStudy::read).collect();
    if !results.is_empty() {
        html += &table(&results);
    }
    let mut figures = String::new();
    for path in pictures(folder, &results)? {
        let bytes = std::fs::read(&path).map_err(Error::system("read", &path))?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        // Writing to a text does not fail.
        let _ = writeln!(
            figures,
            "<img class=\"card\" alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">",
            escaped(&name),
            BASE64_STANDARD.encode(bytes)
        );
    }
    if !figures.is_empty() {
        let _ = write!(
            html,
            "<details class=\"pictures\" open><summary>Pictures of the study</summary><div>{figures}</div></details>"
        );
    }
    Ok(match html.is_empty() {
        true => html,
        false => format!("<section class=\"study\" aria-label=\"Study\">{html}</section>"),
    })
}

/// Paths of the pictures of a study, ascending by name; results without an interval have none.
fn pictures(folder: &Path, results: &[ResultOfStudy]) -> Result<Vec<PathBuf>, Error> {
    let entries = std::fs::read_dir(folder).map_err(Error::system("list", folder))?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    let is_refused = |path: &PathBuf| {
        let name = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let mut refused = results.iter().filter(|it| it.interval.is_none());
        refused.any(|it| name == format!("{}-over-h", it.name))
    };
    paths.retain(|path| path.extension().is_some_and(|it| it == "svg") && !is_refused(path));
    paths.sort();
    Ok(paths)
}

/// The sentence of the intervals, and their table.
fn table(results: &[ResultOfStudy]) -> String {
    let known = results.iter().filter_map(|it| {
        let interval = it.interval?;
        Some(format!(
            "{} {}",
            it.label,
            between([interval.lower, interval.upper], &it.unit)
        ))
    });
    let known: Vec<String> = known.collect();
    let refused: Vec<&str> = results
        .iter()
        .filter(|it| it.interval.is_none())
        .map(|it| it.label.as_str())
        .collect();
    let mut sentence = known.join("; ");
    if !refused.is_empty() {
        sentence += &format!(
            "{}without an interval: {}",
            if sentence.is_empty() { "" } else { "; " },
            refused.join(", ")
        );
    }
    let mut html = format!(
        "<div class=\"card\"><h2>Intervals of convergence, 95 %</h2><p>{}.</p><div class=\"wide\"><table><thead><tr><th>result</th><th>interval</th>\
         <th>its parts</th><th>at h</th><th>at 2h</th><th>mesher</th><th>bonds a family</th></tr></thead><tbody>",
        escaped(&sentence)
    );
    for result in results {
        html += &row(result);
    }
    html += "</tbody></table></div><p class=\"note\">The limit of each result as its points become finer: beyond h where the trend from 2h (ring) to h (dot) leads, \
             by any order from 1 on, with the scatter of the meshes (thick). Mesher and bonds a family are apart and not in the interval.</p></div>";
    html
}

fn row(result: &ResultOfStudy) -> String {
    let label = escaped(&result.label);
    let Some(interval) = result.interval else {
        let reason = escaped(&result.refused);
        return format!("<tr><th>{label}</th><td colspan=\"6\">{reason}</td></tr>");
    };
    let unit = PrefixedUnit::new(&result.unit, interval.fine.abs());
    let share =
        |value: Option<f64>| value.map_or_else(String::new, |it| format!("{:+.1} %", 100.0 * it));
    let cells = [
        escaped(&between([interval.lower, interval.upper], &result.unit)),
        bar(interval),
        escaped(&unit.value(interval.fine)),
        escaped(&unit.value(interval.coarse)),
        share(result.mesher),
        share(result.families),
    ];
    format!(
        "<tr><th>{label}</th><td>{}</td></tr>",
        cells.join("</td><td>")
    )
}

/// The interval as a bar, with the part of the scatter around the mean at h, and the means at h and 2h.
fn bar(interval: Interval) -> String {
    let Interval {
        lower,
        upper,
        fine,
        coarse,
        by_scatter,
    } = interval;
    let (low, high) = (lower.min(coarse), upper.max(coarse));
    let room = BAR - 12.0;
    let at = |value: f64| match high > low {
        true => 6.0 + room * (value - low) / (high - low),
        false => 0.5 * BAR,
    };
    let line = |[from, to]: [f64; 2], width: f64| {
        format!(
            "<line x1=\"{:.1}\" y1=\"9\" x2=\"{:.1}\" y2=\"9\" stroke=\"var(--c3)\" stroke-width=\"{width}\"/>",
            at(from),
            at(to)
        )
    };
    format!(
        "<svg class=\"interval\" width=\"{BAR}\" height=\"18\" role=\"img\" aria-label=\"interval\">{}{}<circle cx=\"{:.1}\" cy=\"9\" r=\"3.5\" \
         fill=\"var(--text)\"/><circle cx=\"{:.1}\" cy=\"9\" r=\"3.5\" fill=\"none\" stroke=\"var(--text)\"/></svg>",
        line([lower, upper], 2.0),
        line(
            [
                (fine - by_scatter).max(lower),
                (fine + by_scatter).min(upper)
            ],
            6.0
        ),
        at(fine),
        at(coarse)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_has_the_intervals_and_the_reasons() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(head(folder.path()).unwrap(), "");
        let document = r#"{ "results": [
            { "name": "peak.reaction", "label": "peak", "unit": "N", "interval": { "lower": 6.4e3, "upper": 6.55e3, "fine": 6.55e3,
              "coarse": 6.72e3, "deviation": 10.0, "by_scatter": 30.0 }, "refused": null, "mesher": -0.01, "families": null },
            { "name": "elastic_stiffness", "label": "stiffness", "unit": "N/m", "interval": null, "refused": "one <point>", "mesher": null,
              "families": null } ] }"#;
        std::fs::write(folder.path().join(INTERVALS), document).unwrap();
        for name in ["peak.reaction-over-h.svg", "elastic_stiffness-over-h.svg"] {
            std::fs::write(folder.path().join(name), "<svg/>").unwrap();
        }
        let html = head(folder.path()).unwrap();
        assert!(
            html.contains("<p>peak 6.400 to 6.550 kN; without an interval: stiffness.</p>"),
            "{html}"
        );
        assert!(html.contains("one &lt;point&gt;") && html.contains("-1.0 %"));
        assert_eq!(
            html.matches("data:image/svg+xml").count(),
            1,
            "only results with an interval have a picture"
        );
    }
}
