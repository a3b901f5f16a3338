//! Force-displacement curves, and other columns of histories over each other.

use std::ops::Range;
use std::path::{Path, PathBuf};

use ligament_output::remedy::Remedy;
use ligament_output::results::outputs::{OutputKind, kind_of, require_results};
use ligament_output::summary::{self, Summary};

use super::columns::{Curve, Tables, common_name, name_in_words};
use super::units::AxisUnit;
use super::{PictureError, Target, labels_of};
use crate::plots::{Colour, Mark, Panels, Plot, Series};

/// Number of rows up to which each of them is marked by a dot.
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
    /// Column along x; None: the time of a motion, else the displacement.
    pub x: Option<String>,
    /// Columns along y: of the history, or of the growth and the tips of cracks; `energies` and `probes` select all energies or probes.
    pub y: Vec<String>,
    /// Size and file.
    pub target: Target,
}

/// A kind of marked points on curves.
type Landmark<'a> = (
    Mark,
    &'a dyn Fn(&LabelledCurve) -> Vec<(&'static str, [f64; 2])>,
);

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
        // The file is outside of all result folders, so it may belong to the user.
        target.out = Some(file.clone());
    }
    target.check(&file)?;
    let axes = Axes::read(request, &labels)?;
    let drawing = axes
        .plot(0..axes.curves.len())
        .for_paper((request.target.width).unwrap_or(WIDTHS[usize::from(axes.curves.len() > 1)]))?;
    let [x, y] = &axes.names;
    let title = format!("{y} over {x} of {}", labels.join(", "));
    target.write(file, &drawing, &title)
}

/// The curves in panels of some of the folders each, in their order, with the title of each panel and its number of folders. Curves with the
/// same label have the same colour.
///
/// # Errors
///
/// If there are no such results or columns, or the units do not fit.
pub fn panels_of_curves(
    request: &CurveRequest,
    panels: &[(String, usize)],
) -> Result<Panels, PictureError> {
    let labels = labels_of(&request.folders, &request.labels)?;
    let axes = Axes::read(request, &labels)?;
    let per_folder = axes.curves.len() / request.folders.len().max(1);
    let mut first = 0;
    let plot = |(title, n_folders): &(String, usize)| {
        let range = first..first + n_folders * per_folder;
        first = range.end;
        Plot {
            title: title.clone(),
            ..axes.plot(range)
        }
    };
    Ok(Panels {
        name: "curves".to_owned(),
        title: String::new(),
        plots: panels.iter().map(plot).collect(),
    })
}

/// A curve of a picture.
struct LabelledCurve {
    label: String,
    curve: Curve,
    /// Number of the label among all different ones, which determines the colour.
    number: usize,
    /// First peak of the load, on a curve of force over displacement.
    first_peak: Option<[f64; 2]>,
}

/// The curves between their axes.
struct Axes {
    curves: Vec<LabelledCurve>,
    /// Names of the quantities along x and y, with their units.
    names: [String; 2],
    shown: [AxisUnit; 2],
}

impl Axes {
    fn read(request: &CurveRequest, labels: &[String]) -> Result<Self, PictureError> {
        let mut curves: Vec<LabelledCurve> = Vec::new();
        let (mut x, mut columns) = (request.x.clone(), Vec::new());
        for (folder, label) in request.folders.iter().zip(labels) {
            require_history(folder)?;
            let tables = Tables::open(folder)?;
            let x = x.get_or_insert_with(|| tables.usual_x().to_owned());
            if columns.is_empty() {
                columns = tables.selected_columns(&request.y)?;
            }
            let is_of_load = x == "displacement" && columns == ["reaction"];
            for y in &columns {
                let curve = tables.curve(x, y)?;
                let label = match (columns.len(), request.folders.len()) {
                    (1, _) => label.clone(),
                    (_, 1) => curve.name.clone(),
                    _ => format!("{label}, {}", curve.name),
                };
                let same = curves.iter().find(|it| it.label == label);
                let next = curves.iter().map(|it| it.number + 1).max();
                curves.push(LabelledCurve {
                    number: same.map_or(next.unwrap_or(0), |it| it.number),
                    label,
                    curve,
                    first_peak: is_of_load.then(|| first_peak(folder)).flatten(),
                });
            }
        }
        let x = x.unwrap_or_default();
        let y = match columns.as_slice() {
            [only] => name_in_words(only, &curves[0].curve.units[1]),
            _ => common_name(&curves[0].curve.units[1]).to_owned(),
        };
        let names = [name_in_words(&x, &curves[0].curve.units[0]), y];
        let shown = [
            axis_unit(&curves, 0, &names[0])?,
            axis_unit(&curves, 1, &names[1])?,
        ];
        Ok(Self {
            curves,
            names,
            shown,
        })
    }

    /// A point in the units of the axes.
    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| point[axis] * self.shown[axis].factor)
    }

    /// The plot of some of the curves.
    fn plot(&self, range: Range<usize>) -> Plot {
        let is_single = self.curves.len() == 1;
        let mut series = Vec::new();
        for LabelledCurve {
            label,
            curve,
            number,
            ..
        } in &self.curves[range.clone()]
        {
            let mark = match (number / N_COLOURS, curve.points.len()) {
                _ if curve.is_scattered => Mark::Circles,
                (0, 0..=DOTTED) => Mark::Line,
                (0, _) => Mark::Curve,
                _ => Mark::Dashes,
            };
            let label = if is_single { "" } else { label.as_str() };
            let answers = curve.points.iter().zip(&curve.at_rest);
            let answers = answers.filter(|it| *it.1 && it.0[1].is_finite());
            let answers = answers.map(|it| self.place(*it.0));
            series.push(Series::new(label, mark, colour(*number), answers.collect()));
        }
        series.extend(self.landmarks(range));
        let title = match self.curves[0].first_peak.filter(|_| is_single) {
            Some(peak) => {
                let [x, y] = [0, 1].map(|axis| self.shown[axis].value(peak[axis]));
                format!("first peak {y} at {x}")
            }
            None => String::new(),
        };
        let [x, y] = [0, 1].map(|axis| self.shown[axis].label(&self.names[axis]));
        Plot::new("curves", title, [&x, &y], series)
    }

    /// Marked points on some of the curves, each kind with a legend entry.
    fn landmarks(&self, range: Range<usize>) -> Vec<Series> {
        let kinds: [Landmark<'_>; 3] = [
            (Mark::Triangles, &|it| it.curve.first.into_iter().collect()),
            (Mark::Circles, &|it| {
                let peak = it.first_peak.into_iter();
                peak.map(|it| ("first peak", it)).collect()
            }),
            (Mark::Crosses, &|it| {
                let all = it.curve.points.iter().zip(&it.curve.at_rest);
                let unsettled = all.filter(|it| !it.1);
                unsettled.map(|it| ("not converged", *it.0)).collect()
            }),
        ];
        let mut series: Vec<Series> = Vec::new();
        let mut named: Vec<&str> = Vec::new();
        for (mark, of) in kinds {
            for curve in &self.curves[range.clone()] {
                let marked = of(curve);
                let Some(&(words, _)) = marked.first() else {
                    continue;
                };
                let label = if named.contains(&words) { "" } else { words };
                named.push(words);
                let points = marked.iter().map(|it| self.place(it.1)).collect();
                series.push(Series::new(label, mark, colour(curve.number), points));
            }
        }
        series
    }
}

/// Number of curves up to which each has a colour of its own.
const N_COLOURS: usize = Colour::CYCLE.len() + 1;

fn colour(curve: usize) -> Colour {
    let place = curve % N_COLOURS;
    Colour::CYCLE.get(place).copied().unwrap_or(Colour::Black)
}

/// Makes sure that a folder has the history of a run.
fn require_history(folder: &Path) -> Result<(), PictureError> {
    require_results(folder)?;
    if kind_of(folder) == OutputKind::Modes {
        return Err(PictureError::Modes {
            path: folder.to_path_buf(),
            what: "history",
            remedy: Remedy::OmitOption("curve"),
        });
    }
    Ok(())
}

/// First peak of the load, from the summary; none for a run that was cut short.
fn first_peak(folder: &Path) -> Option<[f64; 2]> {
    let peak = summary::read::<Summary>(folder).ok()??.first_peak?;
    Some([peak.displacement, peak.reaction])
}

/// The unit in which an axis is shown.
fn axis_unit(curves: &[LabelledCurve], axis: usize, name: &str) -> Result<AxisUnit, PictureError> {
    let unit = &curves[0].curve.units[axis];
    let mut units = curves.iter().map(|it| &it.curve.units[axis]);
    if let Some(other) = units.find(|it| *it != unit) {
        return Err(PictureError::Units {
            axis: name.to_owned(),
            first: unit.clone(),
            other: other.clone(),
        });
    }
    let points = curves.iter().flat_map(|it| &it.curve.points);
    let values = points.map(|point| point[axis].abs());
    let largest = values.filter(|it| it.is_finite()).fold(0.0, f64::max);
    Ok(AxisUnit::new(unit, largest))
}
