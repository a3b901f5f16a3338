//! Entries of the table of measured tests.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::places::{folder, repository};

/// A measured test.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredTest {
    /// Name on the command line, after `experiments_`.
    pub name: String,
    /// Title of the test.
    pub title: String,
    /// Key of the source in the references.
    pub source: String,
    /// Material as in the source, and the properties that the source leaves open.
    pub material: String,
    /// Case file, from the root of the repository.
    pub case: String,
    /// Settings over the case (`key=value`, as with `--set`).
    #[serde(default)]
    pub set: Vec<String>,
    /// File of the measured curve, beside the table.
    pub measured: Option<String>,
    /// Quantity along x.
    pub x: Axis,
    /// Quantity along y, whose largest value is the peak.
    pub y: Axis,
    /// Bands of acceptance.
    pub band: Vec<Band>,
    /// Runs on several meshes and horizons.
    pub run: Vec<Variant>,
    /// Theory of the peaks of several sizes.
    pub size_effect: Option<SizeEffect>,
}

/// A quantity of a curve, from the columns of `history.csv`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Columns that are added.
    pub columns: Vec<String>,
    /// Factor on the sum, which also converts units.
    #[serde(default = "one")]
    pub factor: f64,
    /// Name with the unit, for figures.
    pub name: String,
}

fn one() -> f64 {
    1.0
}

/// A band of acceptance, written down before the run.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Band {
    /// Quantity that the band judges.
    pub of: Quantity,
    /// Position of a crack, m: the x at which its y is read.
    pub at: Option<f64>,
    /// Measured value, in the units of the axes (mm for a crack); by default the value of the measured curve.
    pub measured: Option<f64>,
    /// Curve of an independent solution that the runs are compared with instead, from the root of the repository: the reading along x, m,
    /// and the load, N. Such a band verifies the program; the others validate the data together with it.
    pub independent: Option<String>,
    /// Quantity along x of this band alone.
    pub x: Option<Axis>,
    /// Names of the runs, or of the series, that the band judges; by default all.
    #[serde(default)]
    pub runs: Vec<String>,
    /// Smallest and largest accepted ratio to the measured value; for a crack the differences from it, mm.
    pub between: [f64; 2],
    /// Reason of the band.
    pub because: String,
    /// Likely reason where runs are out of the band.
    pub missed: Option<String>,
}

/// A quantity with a band.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Largest y.
    Peak,
    /// x at the largest y.
    XAtPeak,
    /// Area under the curve, up to the end of the measured one.
    Area,
    /// Height of the crack where its x is given.
    CrackY,
    /// Fracture energy by the size effect of a series of runs, over the given one.
    SizeEffectEnergy,
    /// Effective length of the fracture process zone by the size effect, over the theoretical length.
    SizeEffectLength,
}

/// A run of a test: a mesh, and settings.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Name of the run.
    pub name: String,
    /// Stored mesh, from the root of the repository.
    pub mesh: Option<String>,
    /// Geometry that Gmsh meshes, from the root of the repository.
    pub geometry: Option<String>,
    /// Numbers of the geometry.
    #[serde(default)]
    pub numbers: BTreeMap<String, f64>,
    /// Settings in addition to the settings of the test.
    #[serde(default)]
    pub set: Vec<String>,
    /// Whether the tests of the repository run it.
    #[serde(default)]
    pub fast: bool,
    /// Name of a series of similar bodies of several sizes.
    pub series: Option<String>,
    /// Size in the series, m.
    pub size: Option<f64>,
}

/// Linear elastic fracture mechanics of a series of similar bodies.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SizeEffect {
    /// Energy release rate E G/(sigma_N^2 D) of the notch, dimensionless.
    pub g: f64,
    /// Derivative of g by the length of the notch over D, dimensionless.
    pub g_slope: f64,
    /// Thickness, m.
    pub thickness: f64,
    /// Young's modulus, Pa.
    pub young: f64,
    /// Fracture energy, J/m^2.
    pub fracture_energy: f64,
    /// Effective length of the fracture process zone of a large body, by theory, m.
    pub length: f64,
}

/// The whole table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entries {
    test: Vec<MeasuredTest>,
}

/// Error of the table of measured tests.
#[derive(Debug, thiserror::Error)]
pub enum TestError {
    /// The file cannot be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// File of the tests.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file is no table of measured tests.
    #[error("{}: {source}", path.display())]
    Parse {
        /// File of the tests.
        path: PathBuf,
        /// The parser's reason, with line and column.
        source: Box<toml::de::Error>,
    },
    /// An entry is wrong.
    #[error("measured test `{test}`: {fault}")]
    Entry {
        /// Name of the test.
        test: String,
        /// Description of the error.
        fault: String,
    },
}

/// Reads the measured tests from their table.
///
/// # Errors
///
/// If the file cannot be read, a key is unknown or missing, or an entry is wrong.
pub fn read(path: &Path) -> Result<Vec<MeasuredTest>, TestError> {
    let text = std::fs::read_to_string(path).map_err(|source| TestError::Read {
        path: path.to_owned(),
        source,
    })?;
    parse(&text, path)
}

/// Measured tests from the text of a table; `path` is the path of its file.
fn parse(text: &str, path: &Path) -> Result<Vec<MeasuredTest>, TestError> {
    let entries = toml::from_str::<Entries>(text).map_err(|source| TestError::Parse {
        path: path.to_owned(),
        source: Box::new(source),
    })?;
    let mut names = BTreeSet::new();
    for test in &entries.test {
        let fault = match names.insert(&test.name) {
            true => test.fault(),
            false => Some("there is another test of this name".to_owned()),
        };
        if let Some(fault) = fault {
            let test = test.name.clone();
            return Err(TestError::Entry { test, fault });
        }
    }
    Ok(entries.test)
}

impl MeasuredTest {
    /// Description of the first error of the entry.
    fn fault(&self) -> Option<String> {
        let is_missing = |path: &PathBuf| !path.is_file();
        let files = (self.run.iter()).flat_map(|it| it.mesh.iter().chain(&it.geometry));
        let files = files.chain([&self.case]).map(|it| repository().join(it));
        let curves = self.band.iter().flat_map(|it| &it.independent);
        let files = files.chain(curves.map(|it| repository().join(it)));
        let mut files = files.chain(self.measured.iter().map(|it| folder().join(it)));
        if let Some(file) = files.find(is_missing) {
            return Some(format!("there is no file {}", file.display()));
        }
        let bands = self.band.iter().filter_map(|it| self.fault_of_band(it));
        let mut names = BTreeSet::new();
        let runs = self.run.iter().filter_map(|it| {
            let name = &it.name;
            if !names.insert(name) {
                Some(format!("there are two runs `{name}`"))
            } else if it.mesh.is_some() == it.geometry.is_some() {
                Some(format!("run `{name}` needs a `mesh` or a `geometry`"))
            } else {
                None
            }
        });
        let mut faults: Vec<String> = bands.chain(runs).collect();
        if self.run.is_empty() {
            faults.push("there is no run".to_owned());
        }
        faults.into_iter().next()
    }

    fn fault_of_band(&self, band: &Band) -> Option<String> {
        let of = band.of.words();
        let of_series = matches!(
            band.of,
            Quantity::SizeEffectEnergy | Quantity::SizeEffectLength
        );
        let of_crack = band.of == Quantity::CrackY;
        let [least, most] = band.between;
        let is_unknown = |name: &&String| {
            let known = self
                .run
                .iter()
                .flat_map(|it| [Some(&it.name), it.series.as_ref()]);
            !known.flatten().any(|it| it == *name)
        };
        if let Some(name) = band.runs.iter().find(is_unknown) {
            return Some(format!(
                "the band of the {of} judges `{name}`, and there is no such run"
            ));
        }
        if least.partial_cmp(&most) != Some(std::cmp::Ordering::Less) {
            Some(format!("the band of the {of} is empty: {least} to {most}"))
        } else if of_series && self.size_effect.is_none() {
            Some(format!("the {of} needs `size_effect`"))
        } else if of_crack && (band.at.is_none() || band.measured.is_none()) {
            Some(format!("the {of} needs `at` and `measured`"))
        } else if band.independent.is_some() && (of_series || of_crack) {
            Some(format!(
                "no curve has a {of}, so that `independent` cannot judge it"
            ))
        } else if band.independent.is_none()
            && !of_series
            && band.measured.is_none()
            && self.measured.is_none()
        {
            Some(format!("the {of} has neither a measured value nor a curve"))
        } else {
            None
        }
    }
}

/// End of the names of values that are compared with an independent solution.
pub const VERIFIED: &str = " over the independent solution";

impl Band {
    /// Name of the judged quantity.
    pub fn words(&self) -> String {
        let axis = self
            .x
            .as_ref()
            .map_or(String::new(), |it| format!(", {}", it.name));
        let over = self.independent.as_ref().map_or("", |_| VERIFIED);
        format!("{}{axis}{over}", self.of.words())
    }

    /// Whether the band judges a run or a series.
    pub fn judges(&self, name: &str) -> bool {
        self.runs.is_empty() || self.runs.iter().any(|it| it == name)
    }
}

impl Quantity {
    /// Name of the quantity.
    pub fn words(self) -> &'static str {
        match self {
            Self::Peak => "peak",
            Self::XAtPeak => "x at the peak",
            Self::Area => "area under the curve",
            Self::CrackY => "height of the crack, mm",
            Self::SizeEffectEnergy => "fracture energy by size effect",
            Self::SizeEffectLength => "length of the process zone by size effect",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"
[[test]]
name = "bar"
title = "Bar"
source = "Author 2019"
material = "E 1 GPa."
case = "cases/l-panel/case.toml"
measured = "l-panel.csv"
x = { columns = ["displacement"], factor = 1e3, name = "mm" }
y = { columns = ["reaction"], name = "N" }

[[test.band]]
of = "x-at-peak"
between = [0.9, 1.1]
because = "one specimen"

[[test.run]]
name = "20 mm"
mesh = "meshes/l-panel-20mm.msh"
fast = true
"#;

    fn fault(text: &str) -> String {
        parse(text, Path::new("tests.toml"))
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn an_entry_is_read_with_its_defaults() {
        let tests = parse(TEXT, Path::new("tests.toml")).unwrap();
        let [test] = &tests[..] else {
            panic!("{tests:?}")
        };
        assert_eq!((test.x.factor, test.y.factor), (1e3, 1.0));
        assert_eq!(test.band[0].of, Quantity::XAtPeak);
        assert!(test.run[0].fast && test.run[0].numbers.is_empty() && test.set.is_empty());
    }

    /// Every fault names the test and the error; an unknown key is named with its line.
    #[test]
    fn wrong_entries_are_refused() {
        for (from, to, expected) in [
            (
                "[0.9, 1.1]",
                "[1.1, 0.9]",
                "`bar`: the band of the x at the peak is empty",
            ),
            ("l-panel.csv", "none.csv", "`bar`: there is no file"),
            (
                "measured = \"l-panel.csv\"",
                "",
                "neither a measured value nor a curve",
            ),
            ("x-at-peak", "crack-y", "needs `at` and `measured`"),
            ("x-at-peak", "size-effect-energy", "needs `size_effect`"),
            (
                "mesh = ",
                "geometry = \"meshes/l-panel.geo\"\nmesh = ",
                "needs a `mesh` or a `geometry`",
            ),
            ("x-at-peak", "maximum", "unknown variant `maximum`"),
            ("because", "reason", "unknown field `reason`"),
            (
                "because",
                "runs = [\"4 mm\"]\nbecause",
                "judges `4 mm`, and there is no such run",
            ),
            (
                "because",
                "independent = \"tests/none.csv\"\nbecause",
                "`bar`: there is no file",
            ),
        ] {
            let found = fault(&TEXT.replacen(from, to, 1));
            assert!(found.contains(expected), "{from} -> {to}: {found}");
        }
        let twice = format!("{TEXT}{TEXT}");
        assert!(fault(&twice).contains("another test of this name"));
    }

    /// All entries of the repository are read, and each judges something.
    #[test]
    fn the_table_of_the_repository_is_right() {
        let tests = read(&folder().join("experiments.toml")).unwrap();
        assert!(tests.len() >= 8);
        assert!(tests.iter().all(|it| !it.band.is_empty()));
        assert!(tests.iter().any(|it| it.run.iter().any(|run| run.fast)));
    }
}
