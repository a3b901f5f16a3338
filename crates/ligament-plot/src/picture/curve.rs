//! Force-displacement curves, and other columns of histories over each other.

use std::path::{Path, PathBuf};

use ligament_output::csv::read::Sheet;
use ligament_output::read_text;
use ligament_output::results::outputs::{OutputKind, kind_of, require_results};

use super::units::Shown;
use super::{PictureError, Target, labels_of};
use crate::plots::{Colour, Mark, Plot, Series};
use crate::stored_loading::stored_loading;
use ligament::suggestion::hint;

/// Rows up to which each of them is marked by a dot.
const DOTTED: usize = 100;

/// Width without and with a legend, mm.
const WIDTHS: [f64; 2] = [120.0, 160.0];

/// A picture of curves.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveRequest {
    /// Folders with results.
    pub folders: Vec<PathBuf>,
    /// Labels of the curves; where empty, the names of the folders.
    pub labels: Vec<String>,
    /// Columns of the histories along x and y.
    pub columns: [String; 2],
    /// Size and file.
    pub target: Target,
}

/// A curve in SI units.
struct Curve {
    points: Vec<[f64; 2]>,
    units: [String; 2],
    /// Whether the last point is no answer to its load: bonds were still breaking there.
    ends_unsettled: bool,
    /// The load before its first fall, on curves of force over displacement.
    first_peak: Option<[f64; 2]>,
}

/// Draws the picture and returns where it is.
///
/// # Errors
///
/// If there are no such results or columns, the units do not fit, or the picture cannot be written.
pub fn draw_curves(request: &CurveRequest) -> Result<PathBuf, PictureError> {
    let labels = labels_of(&request.folders, &request.labels)?;
    let file = request.target.file(|| match request.folders.as_slice() {
        [only] => only.join("picture-curve.png"),
        _ => PathBuf::from("picture-curves.png"),
    })?;
    let mut curves = Vec::new();
    for folder in &request.folders {
        curves.push(Curve::read(folder, &request.columns)?);
    }
    let shown = [shown(&curves, 0, request)?, shown(&curves, 1, request)?];
    let place = |point: [f64; 2]| [0, 1].map(|axis| point[axis] * shown[axis].factor);
    let mut series = Vec::new();
    let mut unsettled = Vec::new();
    let is_single = curves.len() == 1;
    let colours: Vec<Colour> = Colour::CYCLE.into_iter().chain([Colour::Black]).collect();
    for (number, (curve, label)) in curves.iter().zip(&labels).enumerate() {
        let colour = colours[number % colours.len()];
        let mark = match (number / colours.len(), curve.points.len()) {
            (0, 0..=DOTTED) => Mark::Line,
            (0, _) => Mark::Curve,
            _ => Mark::Dashes,
        };
        let label = if is_single { "" } else { label };
        let settled = curve.points.len() - usize::from(curve.ends_unsettled);
        let points: Vec<[f64; 2]> = curve.points.iter().map(|&point| place(point)).collect();
        series.push(Series::new(label, mark, colour, points[..settled].to_vec()));
        unsettled.extend_from_slice(&points[settled..]);
    }
    if !unsettled.is_empty() {
        let mark = Mark::Circles;
        series.push(Series::new("not at rest", mark, Colour::Black, unsettled));
    }
    let mut title = String::new();
    let mut is_named = is_single;
    for (number, curve) in curves.iter().enumerate() {
        let Some(peak) = curve.first_peak else {
            continue;
        };
        if is_single {
            let [x, y] = [0, 1].map(|axis| shown[axis].value(peak[axis]));
            title = format!("first peak {y} at {x}");
        }
        // One entry of the legend for all.
        let label = if is_named { "" } else { "first peak" };
        is_named = true;
        let colour = colours[number % colours.len()];
        series.push(Series::new(label, Mark::Circles, colour, vec![place(peak)]));
    }
    let words = |column: &str| column.replace('_', " ");
    let [x, y] = [0, 1].map(|axis| shown[axis].label(&words(&request.columns[axis])));
    let plot = Plot::new("curves", title, [&x, &y], series);
    let width = request
        .target
        .width
        .unwrap_or(WIDTHS[usize::from(!is_single)]);
    let svg = plot.for_paper(width)?;
    let title = format!(
        "{} over {} of {}",
        words(&request.columns[1]),
        words(&request.columns[0]),
        labels.join(", ")
    );
    request.target.write(file, &svg, &title)
}

impl Curve {
    fn read(folder: &Path, columns: &[String; 2]) -> Result<Self, PictureError> {
        require_results(folder)?;
        if kind_of(folder) == OutputKind::Modes {
            return Err(PictureError::Modes {
                path: folder.to_path_buf(),
                what: "history",
                option: "--curve",
            });
        }
        let sheet = Sheet::read(folder.join("history.csv"))?;
        // Of a table that is none of a run nothing is told.
        sheet.values::<usize>("step")?;
        let column = |name: &String| {
            if sheet.columns().contains(name) {
                return Ok(sheet.values::<f64>(name)?);
            }
            Err(PictureError::UnknownColumn {
                path: sheet.path().to_path_buf(),
                name: name.clone(),
                hint: known_columns(name, sheet.columns()),
            })
        };
        let (x, y) = (column(&columns[0])?, column(&columns[1])?);
        let of_load = stored_loading(folder).ok().map(|it| it.units);
        let unit = |column: &String| match (column.as_str(), of_load) {
            ("displacement", Some(units)) => units.displacement.to_owned(),
            ("reaction", Some(units)) => units.force.to_owned(),
            (name, _) => unit_of(name).to_owned(),
        };
        let is_of_load = columns[0] == "displacement" && columns[1] == "reaction";
        Ok(Self {
            points: x.into_iter().zip(y).map(|(x, y)| [x, y]).collect(),
            ends_unsettled: ends_unsettled(&sheet)?,
            units: [unit(&columns[0]), unit(&columns[1])],
            first_peak: is_of_load.then(|| first_peak(folder)).flatten(),
        })
    }
}

/// Whether the run ended with a state that is no answer to its load: bonds were still breaking.
fn ends_unsettled(sheet: &Sheet) -> Result<bool, PictureError> {
    if !sheet.columns().iter().any(|name| name == "at_rest") {
        return Ok(false);
    }
    let at_rest = sheet.values::<u8>("at_rest")?;
    Ok(at_rest.last() == Some(&0))
}

/// The load before its first fall, from the summary; a run that was cut short has none.
fn first_peak(folder: &Path) -> Option<[f64; 2]> {
    let text = read_text(&folder.join("summary.json")).ok()?;
    let summary: serde_json::Value = serde_json::from_str(&text).ok()?;
    let peak = &summary["first_peak"];
    Some([peak["displacement"].as_f64()?, peak["reaction"].as_f64()?])
}

fn known_columns(name: &str, columns: &[String]) -> String {
    let nearest = hint(name, columns, "columns", '`');
    if nearest.contains("columns: ") {
        return nearest;
    }
    format!("{nearest}; columns: {}", columns.join(", "))
}

/// The unit to show an axis in.
fn shown(curves: &[Curve], axis: usize, request: &CurveRequest) -> Result<Shown, PictureError> {
    let unit = &curves[0].units[axis];
    let mut units = curves.iter().map(|it| &it.units[axis]);
    if let Some(other) = units.find(|it| *it != unit) {
        return Err(PictureError::Units {
            axis: request.columns[axis].clone(),
            first: unit.clone(),
            other: other.clone(),
        });
    }
    let points = curves.iter().flat_map(|it| &it.points);
    let values = points.map(|point| point[axis].abs());
    let largest = values.filter(|it| it.is_finite()).fold(0.0, f64::max);
    Ok(Shown::new(unit, largest))
}

/// SI unit of a column of a history; that of a probe is not written.
fn unit_of(column: &str) -> &'static str {
    match column {
        "stored_energy" | "released_energy" | "dissipated_energy" | "external_work"
        | "energy_error" => "J",
        name if name.ends_with(".force_x") || name.ends_with(".force_y") => "N",
        name if name.ends_with(".moment") => "N m",
        _ => "-",
    }
}
