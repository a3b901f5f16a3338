//! The request for a page with its measured curves, and the written file.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use ligament_output::csv::read::CsvTable;
use ligament_output::folder::{REPORT, remove_unfinished_pages};
use ligament_output::{check_file, write_file};
use serde_json::{Value, json};

use crate::error::ReportError;
use crate::parts::{Choice, ColumnTexts, UnitOf};
use crate::run::PageRun;
use crate::study::head;
use crate::summary::escaped;

/// Template of the page, and the parts of its program in the order in which they are joined.
const PAGE: &str = include_str!("viewer/page.html");
const STYLE: &str = include_str!("viewer/style.css");
const PROGRAM: [&str; 22] = [
    include_str!("viewer/columns.js"),
    include_str!("viewer/numbers.js"),
    include_str!("viewer/run.js"),
    include_str!("viewer/colours.js"),
    include_str!("viewer/places.js"),
    include_str!("viewer/camera.js"),
    include_str!("viewer/shape.js"),
    include_str!("viewer/section.js"),
    include_str!("viewer/drawing.js"),
    include_str!("viewer/scene.js"),
    include_str!("viewer/lines.js"),
    include_str!("viewer/symbols.js"),
    include_str!("viewer/chart.js"),
    include_str!("viewer/measured.js"),
    include_str!("viewer/charts.js"),
    include_str!("viewer/panel.js"),
    include_str!("viewer/pointers.js"),
    include_str!("viewer/pane.js"),
    include_str!("viewer/interpolation.js"),
    include_str!("viewer/comparison.js"),
    include_str!("viewer/main.js"),
    include_str!("viewer/start.js"),
];

/// Number of characters of a page besides columns: program, summaries and histories of usual length.
const OTHER_LETTERS: usize = 400_000;

/// Request for a page.
#[derive(Debug, Clone)]
pub struct Request {
    /// Folder of a study, if the results are its runs.
    pub study: Option<PathBuf>,
    /// Folders with results.
    pub folders: Vec<PathBuf>,
    /// Labels of the results; where empty, the names of their folders.
    pub labels: Vec<String>,
    /// Tables of measured curves.
    pub measured: Vec<PathBuf>,
    /// Units of the keys of cases.
    pub unit_of: UnitOf,
    /// Path of the page; by default `report.html` in the folder of the study, or else in the first folder.
    pub output: Option<PathBuf>,
    /// Whether an existing file may be replaced; the default page in the first folder always is.
    pub force: bool,
    /// Digits of the largest value of a field in each step.
    pub digits: u32,
    /// Largest number of steps of each result.
    pub steps: usize,
    /// Size of the page up to which fields and bonds are included, bytes.
    pub size: usize,
}

/// Usual digits of the largest value of a field in each step.
pub const DIGITS: u32 = 4;

/// Usual largest number of steps of each result.
pub const STEPS: u32 = 60;

/// Usual size of the page up to which fields and bonds are included, MB.
pub const SIZE: f64 = 15.0;

/// Bytes of a megabyte.
pub const MEGABYTE: f64 = 1e6;

/// Description of the written page.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenPage {
    /// Path of the file.
    pub path: PathBuf,
    /// Size of the file, bytes.
    pub size: usize,
    /// Contents of the page for each result.
    pub contents: Vec<PageContents>,
}

/// Contents of a page for a result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PageContents {
    /// Label of the result.
    pub label: String,
    /// Number of points of the body.
    pub points: usize,
    /// Number of steps, or modes.
    pub steps: usize,
    /// Names of fields and properties of bonds that were left out for their size.
    pub left_out: Vec<String>,
}

/// Writes a page of the results.
///
/// # Errors
///
/// If there are no results, or they cannot be used, or the page cannot be written.
pub fn write_report(request: &Request) -> Result<WrittenPage, ReportError> {
    let labels = labels(request)?;
    let first =
        || (request.study.as_ref().or(request.folders.first()).cloned()).unwrap_or_default();
    let own = || (first().join(REPORT), true);
    let (path, replace) = (request.output.clone()).map_or_else(own, |it| (it, request.force));
    check_file(&path, replace)?;
    let share = request.size.saturating_sub(OTHER_LETTERS) / request.folders.len().max(1);
    let choice = Choice {
        digits: request.digits,
        steps: request.steps,
        letters: share,
        unit_of: request.unit_of,
    };
    let measured = (request.measured.iter()).map(|it| measured_curve(it));
    let measured: Vec<Value> = measured.collect::<Result<_, ReportError>>()?;
    let mut texts = ColumnTexts::default();
    let mut runs = Vec::new();
    for (folder, label) in request.folders.iter().zip(&labels) {
        runs.push(PageRun::read(folder, label, choice, &mut texts)?);
    }
    let study = request.study.as_deref().map(head).transpose()?;
    let page = page(
        &runs,
        &texts,
        &measured,
        (&study.unwrap_or_default(), request),
    );
    if request.output.is_none() {
        remove_unfinished_pages(&first())?;
    }
    write_file(&path, page.as_bytes(), replace)?;
    let contents = labels
        .into_iter()
        .zip(runs)
        .map(|(label, run)| PageContents {
            label,
            points: run.points,
            steps: run.steps,
            left_out: run.left_out,
        });
    Ok(WrittenPage {
        path,
        size: page.len(),
        contents: contents.collect(),
    })
}

fn labels(request: &Request) -> Result<Vec<String>, ReportError> {
    let (n_labels, n_results) = (request.labels.len(), request.folders.len());
    if n_labels == n_results {
        return Ok(request.labels.clone());
    }
    if n_labels > 0 {
        return Err(ReportError::Labels {
            n_labels,
            n_results,
        });
    }
    let name = |folder: &PathBuf| {
        let whole = folder.canonicalize().unwrap_or_else(|_| folder.clone());
        let name = whole.file_name().unwrap_or(whole.as_os_str());
        name.to_string_lossy().into_owned()
    };
    Ok(request.folders.iter().map(name).collect())
}

/// The page of runs below the head of their study.
fn page(
    runs: &[PageRun],
    texts: &ColumnTexts,
    measured: &[Value],
    (study, request): (&str, &Request),
) -> String {
    let titles: Vec<&str> = runs.iter().map(|it| it.title.as_str()).collect();
    let mut title = titles.first().copied().unwrap_or_default().to_owned();
    if titles.iter().any(|it| *it != title) {
        title = titles.join(" and ");
    }
    let description = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "digits": request.digits,
        "measured": measured,
        "runs": runs.iter().map(|it| &it.description).collect::<Vec<&Value>>(),
    });
    let mut summaries = String::new();
    for (number, run) in runs.iter().enumerate() {
        let hidden = if number == 0 { "" } else { " hidden" };
        // Writing to a text does not fail.
        let _ = writeln!(
            summaries,
            "<div class=\"summary\" data-run=\"{number}\"{hidden}>{}",
            run.html
        );
        if !run.left_out.is_empty() {
            let names = escaped(&run.left_out.join(", "));
            let _ = writeln!(
                summaries,
                "<p class=\"note\">Not in this page, for its size: {names}. A larger page has more room, and fewer steps or digits take less.</p>"
            );
        }
        summaries.push_str("</div>\n");
    }
    let mut columns = String::new();
    for (number, text) in texts.0.iter().enumerate() {
        let _ = writeln!(
            columns,
            "<script type=\"text/plain\" id=\"t{number}\">{text}</script>"
        );
    }
    filled_template(&[
        ("title", &escaped(&title)),
        ("style", STYLE),
        ("study", study),
        ("summaries", &summaries),
        ("description", &script_safe(&description.to_string())),
        ("columns", &columns),
        ("program", &PROGRAM.join("\n")),
    ])
}

/// The page's template with its parts inserted.
fn filled_template(parts: &[(&str, &str)]) -> String {
    let mut page = String::new();
    let mut rest = PAGE;
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let Some((name, after)) = after.split_once("}}") else {
            break;
        };
        let part = parts.iter().find(|it| it.0 == name);
        page.push_str(part.map_or("", |it| it.1));
        rest = after;
    }
    page.push_str(rest);
    page
}

/// JSON text escaped so that it cannot end its script element.
fn script_safe(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// A measured curve: a table of two columns of numbers, whose header names them with their units, as in `opening (mm),force (kN)`.
///
/// # Errors
///
/// If the table cannot be read, or has other than two columns of numbers.
fn measured_curve(path: &Path) -> Result<Value, ReportError> {
    let sheet = CsvTable::read(path)?;
    let names = sheet.columns();
    let [x, y] = names else {
        return Err(ReportError::Measured {
            path: path.to_path_buf(),
            found: names.len(),
        });
    };
    let label = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(json!({
        "label": label,
        "names": [x.trim(), y.trim()],
        "values": [sheet.values::<f64>(x)?, sheet.values::<f64>(y)?],
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_cases_are_no_markup() {
        assert_eq!(escaped("<script>\"'&"), "&lt;script&gt;&quot;&#39;&amp;");
        let json = script_safe(&json!({"title": "</script><script>alert(1)"}).to_string());
        assert!(!json.contains('<'), "{json}");
        let read: Value = serde_json::from_str(&json).unwrap();
        assert_eq!(read["title"], "</script><script>alert(1)");
    }

    #[test]
    fn the_page_has_a_place_for_every_part() {
        for part in [
            "title",
            "style",
            "study",
            "summaries",
            "description",
            "columns",
            "program",
        ] {
            assert!(PAGE.contains(&format!("{{{{{part}}}}}")), "{part}");
        }
        let page = filled_template(&[("title", "{{style}}")]);
        assert!(
            page.contains("<title>{{style}}"),
            "parts are not filled in again"
        );
    }
}
