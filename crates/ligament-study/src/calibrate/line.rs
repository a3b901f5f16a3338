//! A calibration without runs, by a straight line fitted to a result over another key, such as the horizon factor, in the table of a sweep.
//!
//! NHPD's eq. 22 is such a line: F_eq/F_t = (3 lambda - 1)/8, the peak load of a disk over the peak load of its strength F_t. With
//! c(lambda) from the line, a strength F_t/c results in the target's peak load.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use ligament_output::csv::read::CsvTable;

use crate::line_fit::{FitError, LineFit};
use ligament::suggestion::hint;

/// Request for a calibration by lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The table of a sweep, or its folder.
    pub table: PathBuf,
    /// The column along the line.
    pub x: String,
    /// The result, by its column.
    pub of: String,
    /// Columns whose values distinguish the lines.
    pub by: Vec<String>,
    /// Range of x over which lines are fitted.
    pub over: [f64; 2],
    /// Values of x at which the key is computed.
    pub at: Vec<f64>,
    /// The key whose value is sought.
    pub key: String,
    /// Target of the result.
    pub target: f64,
}

/// Error of a calibration by lines.
#[derive(Debug, thiserror::Error)]
pub enum LineError {
    /// The table could not be read.
    #[error("no table of a sweep at {}", path.display())]
    NoTable {
        /// The path at which the table should be.
        path: PathBuf,
        /// The reader's reason.
        source: ligament_output::Error,
    },
    /// The table has no such column.
    #[error("{} has no column `{name}`{}", path.display(), hint(name, columns, "columns", '`'))]
    NoColumn {
        /// Table without the column.
        path: PathBuf,
        /// Name of the missing column.
        name: String,
        /// Existing names.
        columns: Vec<String>,
    },
    /// A value that is not a number.
    #[error(
        "`{name}` of run {run} is {text:?}, no number; leave such runs out by --over, or take another result"
    )]
    NotANumber {
        /// Column with a value that is not a number.
        name: String,
        /// Run with this value.
        run: String,
        /// The text of the value.
        text: String,
    },
    /// Several runs of one line have the same x.
    #[error(
        "runs {} and {} are both at {x} = {value}: --by COLUMN gives those that differ otherwise lines of their own",
        runs[0], runs[1]
    )]
    SamePlace {
        /// The column along the line.
        x: String,
        /// The value that both runs have in this column.
        value: f64,
        /// Names of the two runs.
        runs: [String; 2],
    },
    /// The key differs between runs of a line.
    #[error("{key} is {} in run {} and {} in run {}: a line takes runs with the same", values[0], runs[0], values[1], runs[1])]
    KeyVaries {
        /// Key that varies between the runs of a line.
        key: String,
        /// Two different values of the key.
        values: [f64; 2],
        /// The runs with these values.
        runs: [String; 2],
    },
    /// The points determine no line.
    #[error("no line of {of} over {x}{}: {source}", if name.is_empty() { String::new() } else { format!(" for {name}") })]
    NoLine {
        /// Result on the line.
        of: String,
        /// The column along the line.
        x: String,
        /// Name of the line.
        name: String,
        /// Reason why the points have no line.
        source: FitError,
    },
}

/// A run of the table.
#[derive(Debug, Clone, PartialEq)]
struct Run {
    name: String,
    /// Values of the columns that distinguish the lines.
    line: Vec<String>,
    x: f64,
    result: f64,
    key: f64,
}

/// The line of some runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Common setting of the runs of the line: `mesh.file = fine.msh`.
    pub name: String,
    /// Line of the ratio of result to target, over x.
    pub fit: LineFit,
    /// Value of the key in the runs of the line.
    pub key: f64,
    /// Requested values of x, each with the value of the key `key / fit(x)`; none where the line is not positive.
    pub values: Vec<(f64, Option<f64>)>,
}

/// Fits the lines of a table.
///
/// # Errors
///
/// If there is no such table or column, a value is not a number, or runs of a line differ in the key or have the same x.
pub fn lines(request: &Request) -> Result<Vec<Line>, LineError> {
    let path = if request.table.is_dir() {
        request.table.join("table.csv")
    } else {
        request.table.clone()
    };
    let sheet = CsvTable::read(&path).map_err(|source| LineError::NoTable { path, source })?;
    let runs = runs(&sheet, request)?;
    let mut names: Vec<&Vec<String>> = Vec::new();
    for run in &runs {
        if !names.contains(&&run.line) {
            names.push(&run.line);
        }
    }
    let of_line = |name: &Vec<String>| {
        let own: Vec<&Run> = runs.iter().filter(|run| run.line == *name).collect();
        line(request, name, &own)
    };
    names.into_iter().map(of_line).collect()
}

/// The completed runs within the range of x.
fn runs(sheet: &CsvTable, request: &Request) -> Result<Vec<Run>, LineError> {
    let column = |name: &str| {
        let texts = sheet.texts(name).map(|it| it.collect::<Vec<_>>());
        texts.ok_or_else(|| LineError::NoColumn {
            path: sheet.path().to_owned(),
            name: name.to_owned(),
            columns: sheet.columns().to_vec(),
        })
    };
    let (names, status) = (column("run")?, column("status")?);
    // A key is an axis of the sweep, or another input of its cases.
    let key = column(&request.key).or_else(|_| column(&format!("case.{}", request.key)))?;
    let (x, of) = (column(&request.x)?, column(&request.of)?);
    let by: Vec<Vec<&str>> = (request.by.iter())
        .map(|name| column(name))
        .collect::<Result<_, _>>()?;
    let number = |column: &str, row: usize, text: &str| {
        let parsed = text.parse::<f64>().ok().filter(|it| it.is_finite());
        parsed.ok_or_else(|| LineError::NotANumber {
            name: column.to_owned(),
            run: names[row].to_owned(),
            text: text.to_owned(),
        })
    };
    let mut runs = Vec::new();
    for row in (0..names.len()).filter(|&row| status[row] == "done") {
        let place = number(&request.x, row, x[row])?;
        let [low, high] = request.over;
        if (low..=high).contains(&place) {
            runs.push(Run {
                name: names[row].to_owned(),
                line: by.iter().map(|column| column[row].to_owned()).collect(),
                x: place,
                result: number(&request.of, row, of[row])?,
                key: number(&request.key, row, key[row])?,
            });
        }
    }
    Ok(runs)
}

fn line(request: &Request, of_line: &[String], runs: &[&Run]) -> Result<Line, LineError> {
    let columns = request.by.iter().zip(of_line);
    let name = columns
        .map(|(column, value)| format!("{column} = {value}"))
        .collect::<Vec<_>>()
        .join(", ");
    for (index, run) in runs.iter().enumerate() {
        if let Some(other) = runs[..index].iter().find(|other| other.x == run.x) {
            return Err(LineError::SamePlace {
                x: request.x.clone(),
                value: run.x,
                runs: [other.name.clone(), run.name.clone()],
            });
        }
        if run.key != runs[0].key {
            return Err(LineError::KeyVaries {
                key: request.key.clone(),
                values: [runs[0].key, run.key],
                runs: [runs[0].name.clone(), run.name.clone()],
            });
        }
    }
    let points: Vec<[f64; 2]> = (runs.iter())
        .map(|run| [run.x, run.result / request.target])
        .collect();
    let fit = LineFit::through(&points).map_err(|source| LineError::NoLine {
        of: request.of.clone(),
        x: request.x.clone(),
        name: name.clone(),
        source,
    })?;
    let key = runs[0].key;
    let value = |&x: &f64| (x, Some(key / fit.at(x)).filter(|_| fit.at(x) > 0.0));
    Ok(Line {
        name,
        fit,
        key,
        values: request.at.iter().map(value).collect(),
    })
}

/// Writes the lines, and the values of the key at the requested x.
///
/// # Errors
///
/// If `out` cannot be written to.
pub fn write(request: &Request, lines: &[Line], out: &mut dyn Write) -> io::Result<()> {
    let Request {
        x, of, key, target, ..
    } = request;
    writeln!(out, "{of} / {target:.6e} over {x}, lines by least squares")?;
    for line in lines {
        let LineFit {
            slope,
            intercept,
            r_squared,
            points,
            ..
        } = line.fit;
        let name = if line.name.is_empty() {
            "all runs"
        } else {
            &line.name
        };
        writeln!(
            out,
            "  {name}: {slope:.4} x {} {:.4}, R^2 = {r_squared:.4}, {points} runs with {key} = {:?}",
            if intercept < 0.0 { '-' } else { '+' },
            intercept.abs(),
            line.key
        )?;
        for (place, value) in &line.values {
            match value {
                Some(value) => writeln!(out, "    {x} = {place}: {key} = {value:.4e}")?,
                None => writeln!(out, "    {x} = {place}: the line is not above zero there")?,
            }
        }
    }
    Ok(())
}

/// Whether a path is the folder of a sweep or a table, not a case.
pub fn is_table(path: &Path) -> bool {
    path.is_dir() || path.extension().is_some_and(|it| it == "csv")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const TABLE: &str = "run,status,mesh.file,model.horizon_factor,case.material.tensile_strength,first_peak.reaction\n\
        a,done,fine,2.0,3.81e6,62.5\n\
        b,done,fine,3.0,3.81e6,100\n\
        c,done,fine,4.0,3.81e6,137.5\n\
        d,done,coarse,2,3.81e6,70\n\
        e,failed,coarse,3,3.81e6,\n\
        f,done,coarse,4,3.81e6,150\n\
        g,done,coarse,1.5,3.81e6,10\n";

    fn request(folder: &Path) -> Request {
        Request {
            table: folder.to_owned(),
            x: "model.horizon_factor".to_owned(),
            of: "first_peak.reaction".to_owned(),
            by: vec!["mesh.file".to_owned()],
            over: [2.0, 4.0],
            at: vec![2.5, 3.5, 0.0],
            key: "material.tensile_strength".to_owned(),
            target: 100.0,
        }
    }

    fn with_table(text: &str) -> (tempfile::TempDir, Request) {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("table.csv"), text).unwrap();
        let request = request(folder.path());
        (folder, request)
    }

    /// On the line of eq. 22 the strengths of the paper come out: 4.69 MPa at 2.5 and 3.21 MPa at 3.5.
    #[test]
    fn the_printed_strengths_lie_on_the_printed_line() {
        let (_folder, request) = with_table(TABLE);
        let lines = lines(&request).unwrap();
        assert_eq!(lines.len(), 2);
        let fine = &lines[0];
        assert_eq!(fine.name, "mesh.file = fine");
        assert!((fine.fit.slope - 0.375).abs() < 1e-12);
        assert!((fine.fit.intercept + 0.125).abs() < 1e-12);
        let [at_2_5, at_3_5, at_0] = [0, 1, 2].map(|place| fine.values[place].1);
        // The paper gives three digits.
        assert!((at_2_5.unwrap() - 4.69e6).abs() < 0.005e6);
        assert!((at_3_5.unwrap() - 3.21e6).abs() < 0.005e6);
        assert_eq!(at_0, None);
        // The failed run and the one out of the range are no points of the line.
        assert_eq!(lines[1].fit.points, 2);
        assert!((lines[1].fit.slope - 0.4).abs() < 1e-12);
        let mut text = Vec::new();
        write(&request, &lines, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(
            text.contains("mesh.file = fine: 0.3750 x - 0.1250"),
            "{text}"
        );
        assert!(
            text.contains("model.horizon_factor = 2.5: material.tensile_strength = 4.6892e6"),
            "{text}"
        );
    }

    #[test]
    fn what_makes_no_line_is_told() {
        let (_folder, good) = with_table(TABLE);
        let error = |request: &Request| lines(request).unwrap_err().to_string();
        let mixed = Request {
            by: Vec::new(),
            ..good.clone()
        };
        assert!(error(&mixed).contains("runs a and d are both at model.horizon_factor = 2"));
        let misspelt = Request {
            x: "model.horizon".to_owned(),
            ..good.clone()
        };
        assert!(error(&misspelt).contains("did you mean `model.horizon_factor`?"));
        let narrow = Request {
            over: [2.0, 2.5],
            ..good.clone()
        };
        assert!(error(&narrow).contains("there is one"));
        let no_table = Request {
            table: PathBuf::from("nowhere.csv"),
            ..good
        };
        assert!(error(&no_table).contains("nowhere.csv"));
        let (_folder, varies) =
            with_table(&TABLE.replace("f,done,coarse,4,3.81e6", "f,done,coarse,4,4e6"));
        assert!(error(&varies).contains("3810000 in run d and 4000000 in run f"));
        let (_folder, lost) = with_table(&TABLE.replace("150", ""));
        assert!(error(&lost).contains("`first_peak.reaction` of run f is \"\""));
    }
}
