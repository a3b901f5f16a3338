//! Force-displacement curves, and other columns of histories over each other.

use std::path::{Path, PathBuf};

use ligament_output::csv::read::Sheet;
use ligament_output::results::columns::unit_of;
use ligament_output::results::outputs::{OutputKind, kind_of, require_results};
use ligament_output::results::steps::{StepChoice, StepName};
use ligament_output::summary::{self, Summary};

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
    /// Whether each point is an answer to its load; bonds were still failing in the others.
    at_rest: Vec<bool>,
    /// Where the first bond broke or softened, and which of them.
    first: Option<(&'static str, [f64; 2])>,
    /// The load before its first fall, on curves of force over displacement.
    first_peak: Option<[f64; 2]>,
}

/// A kind of points that stand out.
type Landmark<'a> = (Mark, &'a dyn Fn(&Curve) -> Vec<(&'static str, [f64; 2])>);

/// Draws the picture and returns where it is.
///
/// # Errors
///
/// If there are no such results or columns, the units do not fit, or the picture cannot be written.
pub fn draw_curves(request: &CurveRequest) -> Result<PathBuf, PictureError> {
    let labels = labels_of(&request.folders, &request.labels)?;
    let mut target = request.target.clone();
    let file = target.file(|| match request.folders.as_slice() {
        [only] => only.join("picture-curve.png"),
        _ => PathBuf::from("picture-curves.png"),
    })?;
    if request.folders.len() > 1 {
        // It lies in no folder of results, so that it may be anybody's.
        target.out = Some(file.clone());
    }
    target.check(&file)?;
    let mut curves = Vec::new();
    for folder in &request.folders {
        curves.push(Curve::read(folder, &request.columns)?);
    }
    let shown = [shown(&curves, 0, request)?, shown(&curves, 1, request)?];
    let place = |point: [f64; 2]| [0, 1].map(|axis| point[axis] * shown[axis].factor);
    let is_single = curves.len() == 1;
    let mut series = Vec::new();
    for (number, (curve, label)) in curves.iter().zip(&labels).enumerate() {
        let mark = match (number / N_COLOURS, curve.points.len()) {
            (0, 0..=DOTTED) => Mark::Line,
            (0, _) => Mark::Curve,
            _ => Mark::Dashes,
        };
        let label = if is_single { "" } else { label };
        let answers = curve.points.iter().zip(&curve.at_rest);
        let answers = answers.filter(|it| *it.1).map(|it| place(*it.0));
        series.push(Series::new(label, mark, colour(number), answers.collect()));
    }
    series.extend(landmarks(&curves, &place));
    let title = match curves[0].first_peak.filter(|_| is_single) {
        Some(peak) => {
            let [x, y] = [0, 1].map(|axis| shown[axis].value(peak[axis]));
            format!("first peak {y} at {x}")
        }
        None => String::new(),
    };
    let words = |column: &str| column.replace('_', " ");
    let [x, y] = [0, 1].map(|axis| shown[axis].label(&words(&request.columns[axis])));
    let plot = Plot::new("curves", title, [&x, &y], series);
    let width = request
        .target
        .width
        .unwrap_or(WIDTHS[usize::from(!is_single)]);
    let drawing = plot.for_paper(width)?;
    let title = format!(
        "{} over {} of {}",
        words(&request.columns[1]),
        words(&request.columns[0]),
        labels.join(", ")
    );
    target.write(file, &drawing, &title)
}

/// Curves up to which each has a colour of its own.
const N_COLOURS: usize = Colour::CYCLE.len() + 1;

fn colour(curve: usize) -> Colour {
    let place = curve % N_COLOURS;
    Colour::CYCLE.get(place).copied().unwrap_or(Colour::Black)
}

/// The points that stand out on the curves, each kind with an entry of the legend.
fn landmarks(curves: &[Curve], place: &impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Series> {
    let kinds: [Landmark<'_>; 3] = [
        (Mark::Triangles, &|curve| curve.first.into_iter().collect()),
        (Mark::Circles, &|curve| {
            let peak = curve.first_peak.into_iter();
            peak.map(|it| ("first peak", it)).collect()
        }),
        (Mark::Crosses, &|curve| {
            let all = curve.points.iter().zip(&curve.at_rest);
            let unsettled = all.filter(|it| !it.1);
            unsettled.map(|it| ("not converged", *it.0)).collect()
        }),
    ];
    let mut series: Vec<Series> = Vec::new();
    let mut named: Vec<&str> = Vec::new();
    for (mark, of) in kinds {
        for (number, curve) in curves.iter().enumerate() {
            let marked = of(curve);
            let Some(&(words, _)) = marked.first() else {
                continue;
            };
            let label = if named.contains(&words) { "" } else { words };
            named.push(words);
            let points = marked.iter().map(|it| place(it.1)).collect();
            series.push(Series::new(label, mark, colour(number), points));
        }
    }
    series
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
        let steps = sheet.values::<usize>("step")?;
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
        let loading = stored_loading(folder).ok();
        let unit = |column: &String| {
            let known = loading.as_ref().map(|it| it.unit_of(column));
            known.unwrap_or_else(|| unit_of(column)).to_owned()
        };
        let is_of_load = columns[0] == "displacement" && columns[1] == "reaction";
        let points: Vec<[f64; 2]> = x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
        Ok(Self {
            at_rest: at_rest(&sheet, points.len())?,
            first: first(folder, &steps, &points),
            points,
            units: [unit(&columns[0]), unit(&columns[1])],
            first_peak: is_of_load.then(|| first_peak(folder)).flatten(),
        })
    }
}

/// Whether each of so many rows is an answer to its load; earlier versions did not tell.
fn at_rest(sheet: &Sheet, n_rows: usize) -> Result<Vec<bool>, PictureError> {
    if !sheet.columns().iter().any(|name| name == "at_rest") {
        return Ok(vec![true; n_rows]);
    }
    let flags = sheet.values::<u8>("at_rest")?;
    Ok(flags.into_iter().map(|flag| flag != 0).collect())
}

/// The point of the first breakage or softening, with what it is.
fn first(folder: &Path, steps: &[usize], points: &[[f64; 2]]) -> Option<(&'static str, [f64; 2])> {
    let choice = StepChoice::One(StepName::First);
    let (what, step) = choice.steps(folder, steps).ok()?.first()?.happened?;
    let row = steps.iter().position(|it| *it == step)?;
    Some((what, points[row]))
}

/// The load before its first fall, from the summary; a run that was cut short has none.
fn first_peak(folder: &Path) -> Option<[f64; 2]> {
    let peak = summary::read::<Summary>(folder).ok()??.first_peak?;
    Some([peak.displacement, peak.reaction])
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
