//! Lines over a body: its cracks, the pre-cracks of its case, and lines of a table, such as the cracks of an experiment.

use std::collections::BTreeMap;
use std::path::Path;

use ligament_output::csv::read::CsvTable;
use ligament_output::results::StoredState;
use ligament_output::results::cracks::StoredCracks;
use ligament_output::{Error, read_text};

use super::PictureError;
use crate::drawing::{Drawing, Paint, PathData, Rgb};
use crate::plots::Colour;
use crate::stored_loading::resolved_case;

/// Colour of pre-cracks.
const CUT: Rgb = [0x8c; 3];

/// Width of cracks, pixels.
const CRACK_WIDTH: f64 = 1.4;

/// Width of all other lines, pixels.
const WIDTH: f64 = 1.0;

/// First columns of the table of cracks of a run.
const CRACK_COLUMNS: [&str; 4] = ["step", "line", "x", "y"];

/// Radius of the mark of a tip, pixels.
const TIP: f64 = 2.2;

/// Lines of one kind.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lines {
    /// Text of the legend entry.
    pub(super) name: String,
    /// Additional text of the legend entry for a single state.
    pub(super) detail: String,
    /// Colour of the lines.
    pub(super) colour: Rgb,
    /// Width, pixels.
    width: f64,
    /// Corners of each line in the undeformed body, m.
    pub(super) polylines: Vec<Vec<[f64; 2]>>,
    /// Positions of marked tips, m.
    tips: Vec<[f64; 2]>,
}

impl Lines {
    /// The cracks in a state, with their tips.
    pub(super) fn from_cracks(cracks: &StoredCracks, state: StoredState) -> Self {
        let lines = cracks.lines(state);
        let length: f64 = lines.iter().map(|line| line.length()).sum();
        Self {
            name: "crack path".to_owned(),
            detail: format!(" ({:.1} mm)", 1e3 * length),
            colour: Colour::Vermilion.rgb(),
            width: CRACK_WIDTH,
            tips: lines.iter().flat_map(|line| line.tips()).collect(),
            polylines: lines.into_iter().map(|line| line.places).collect(),
        }
    }

    /// The cracks of a run at its end, with the name and the colour of the run.
    pub(super) fn from_run(cracks: &StoredCracks, name: &str, colour: Rgb) -> Self {
        Self {
            name: name.to_owned(),
            detail: String::new(),
            colour,
            width: WIDTH,
            ..Self::from_cracks(cracks, StoredState::end(usize::MAX))
        }
    }

    /// The pre-cracks of the case of a run.
    pub(super) fn from_precracks(folder: &Path) -> Result<Self, PictureError> {
        Ok(Self {
            name: "pre-crack".to_owned(),
            detail: String::new(),
            colour: CUT,
            width: CRACK_WIDTH,
            polylines: stored_precracks(folder)?,
            tips: Vec::new(),
        })
    }

    /// The lines of a table `x,y` (m) without quotes, separated by empty lines; a first row of words is its header. From the crack table of another
    /// run it takes the cracks of the last step, named after the folder.
    pub(super) fn from_table(path: &Path, place: usize) -> Result<Self, PictureError> {
        let text = read_text(path)?;
        let is_of_run = text.starts_with(&CRACK_COLUMNS.join(","));
        let polylines = match is_of_run {
            true => last_cracks(path)?,
            false => polylines(path, &text)?,
        };
        let folder = path.parent().and_then(Path::file_name);
        let name = folder.filter(|_| is_of_run).or(path.file_stem());
        let colours = [Colour::Blue, Colour::Green, Colour::Purple, Colour::Orange];
        Ok(Self {
            name: name.unwrap_or_default().to_string_lossy().into_owned(),
            detail: String::new(),
            colour: colours[place % colours.len()].rgb(),
            width: WIDTH,
            polylines,
            tips: Vec::new(),
        })
    }

    /// Draws the lines, with a function from places to pixels.
    pub(super) fn draw(&self, drawing: &mut Drawing, to_pixels: impl Fn([f64; 2]) -> [f64; 2]) {
        let mut path = PathData::default();
        for line in &self.polylines {
            path.line(line.iter().map(|&place| to_pixels(place)));
        }
        drawing.path(path, Paint::stroke(self.colour, self.width));
        for &tip in &self.tips {
            drawing.circle(to_pixels(tip), TIP, Paint::fill(self.colour));
        }
    }
}

/// The pre-cracks of the case beside the results of a run: corners of each in the undeformed body, m.
///
/// # Errors
///
/// If the case cannot be read.
pub fn stored_precracks(folder: &Path) -> Result<Vec<Vec<[f64; 2]>>, Error> {
    let case = resolved_case(folder)?;
    let all = case.get("precrack").and_then(toml::Value::as_array);
    Ok(all.into_iter().flatten().filter_map(corners).collect())
}

/// The corners of a pre-crack of a resolved case.
fn corners(precrack: &toml::Value) -> Option<Vec<[f64; 2]>> {
    let number = |value: &toml::Value| {
        let whole = || value.as_integer().map(|it| it as f64);
        value.as_float().or_else(whole)
    };
    let point = |value: &toml::Value| {
        let pair = value.as_array()?;
        Some([number(pair.first()?)?, number(pair.get(1)?)?])
    };
    if let Some(points) = precrack.get("points") {
        return points.as_array()?.iter().map(point).collect();
    }
    let [x, y] = point(precrack.get("centre")?)?;
    let half = 0.5 * number(precrack.get("length")?)?;
    let (sine, cosine) = number(precrack.get("angle")?)?.sin_cos();
    let [along, up] = [half * cosine, half * sine];
    Some(vec![[x - along, y - up], [x + along, y + up]])
}

/// The cracks of the last step in the table of a run.
fn last_cracks(path: &Path) -> Result<Vec<Vec<[f64; 2]>>, PictureError> {
    let table = CsvTable::read(path.to_path_buf())?;
    let [step, line, x, y] = CRACK_COLUMNS;
    let (steps, lines) = (table.values::<usize>(step)?, table.values::<usize>(line)?);
    let (x, y) = (table.values::<f64>(x)?, table.values::<f64>(y)?);
    let last = steps.iter().max();
    let mut found: BTreeMap<usize, Vec<[f64; 2]>> = BTreeMap::new();
    for (row, step) in steps.iter().enumerate() {
        if Some(step) == last {
            found.entry(lines[row]).or_default().push([x[row], y[row]]);
        }
    }
    Ok(found.into_values().collect())
}

/// The lines of a text of rows `x,y`.
fn polylines(path: &Path, text: &str) -> Result<Vec<Vec<[f64; 2]>>, PictureError> {
    let mut lines: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    for (number, row) in (1..).zip(text.lines()) {
        let words: Vec<&str> = row.split([',', ';']).map(str::trim).collect();
        let numbers: Option<Vec<f64>> = words.iter().map(|it| it.parse().ok()).collect();
        let numbers = numbers.filter(|all| all.iter().all(|it| it.is_finite()));
        match numbers.as_deref() {
            Some(&[x, y, ..]) => lines.last_mut().into_iter().for_each(|it| it.push([x, y])),
            _ if words.iter().all(|it| it.is_empty()) => lines.push(Vec::new()),
            _ if number == 1 => {}
            _ => {
                return Err(PictureError::Results(Error::Unreadable {
                    path: path.to_path_buf(),
                    reason: format!(
                        "row {number}, `{row}`, is no place x,y in m (empty rows part lines, the first may be a header)"
                    ),
                }));
            }
        }
    }
    lines.retain(|line| line.len() > 1);
    if lines.is_empty() {
        return Err(PictureError::Results(Error::Unreadable {
            path: path.to_path_buf(),
            reason: "it has no two places x,y in m that a line could join".to_owned(),
        }));
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_rows_part_the_lines_of_a_table() {
        let path = Path::new("band.csv");
        let text = "x,y\n0, 1e-3\n0.01,0.002\n\n,\n0.5;0.5\n0.6;0.5\n0.7;0.5\n\n9,9\n";
        let lines = polylines(path, text).unwrap();
        assert_eq!(lines[0], [[0.0, 1e-3], [0.01, 2e-3]]);
        assert_eq!((lines.len(), lines[1].len()), (2, 3));
        let error = |text: &str| polylines(path, text).unwrap_err().to_string();
        assert!(error("0,1\n0.1,abc\n").contains("row 2, `0.1,abc`"));
        assert!(error("0,1\n0.1\n").contains("row 2"));
        assert!(error("x,y\n0,1\n").contains("no two places"));
    }

    /// The cracks of a run at its last step, two of them, under the name of its folder.
    #[test]
    fn the_table_of_cracks_of_another_run_is_one_of_lines() {
        let folder = tempfile::tempdir().unwrap();
        let run = folder.path().join("coarse");
        std::fs::create_dir(&run).unwrap();
        let path = run.join("crack.csv");
        let rows = "step,line,x,y,along,end\n3,1,0,0,0,tip\n3,1,1,0,1,tip\n4,1,0,0,0,tip\n4,1,2,0.5,2,\n4,1,3,1,3,tip\n4,2,5,5,0,tip\n4,2,6,5,1,tip\n";
        std::fs::write(&path, rows).unwrap();
        let lines = Lines::from_table(&path, 0).unwrap();
        assert_eq!(lines.name, "coarse");
        let expected = [
            vec![[0.0, 0.0], [2.0, 0.5], [3.0, 1.0]],
            vec![[5.0, 5.0], [6.0, 5.0]],
        ];
        assert_eq!(lines.polylines, expected);
    }

    #[test]
    fn precracks_are_polylines_or_straight() {
        let of = |text: &str| corners(&toml::Value::Table(text.parse().unwrap())).unwrap();
        let bent = of("points = [[0, 0.1], [0.2, 0.1], [0.3, 0]]");
        assert_eq!(bent, [[0.0, 0.1], [0.2, 0.1], [0.3, 0.0]]);
        let line = of("centre = [1.0, 2.0]\nlength = 2\nangle = 1.5707963267948966");
        assert!((line[1][1] - 3.0).abs() < 1e-15 && (line[0][0] - 1.0).abs() < 1e-15);
    }
}
