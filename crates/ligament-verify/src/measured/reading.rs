//! Run of a measured test into a folder, as by `ligament run`, and the values read from it.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use ligament_case::case::CaseFile;
use ligament_output::csv::read::CsvTable;
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::solid_cracks::has_solid;
use ligament_output::summary::Summary;
use ligament_post::crack::CrackLine;
use ligament_run::progress::ProgressMode;
use ligament_run::run::{Report, run};
use ligament_study::meshing::Coordinates;
use ligament_study::meshing::gmsh_program::{MeshRequest, make_mesh};
use rustix::time::{ClockId, clock_gettime};

use super::test::{Axis, MeasuredTest, Quantity, Variant};
use crate::places::repository;

/// Values of a run.
#[derive(Debug, Clone)]
pub(super) struct Reading {
    /// Name of the run.
    pub(super) run: String,
    /// Series and size, for a run in a series.
    pub(super) in_series: Option<(String, f64)>,
    /// Computed curve in the units of the axes, shape (n_rows, 2).
    pub(super) curve: Vec<[f64; 2]>,
    /// Curves over the x quantities of the bands, in the order of the bands; None for a band over the x quantity of the test.
    band_curves: Vec<Option<Vec<[f64; 2]>>>,
    /// Lines of the cracks at the end, if a band needs them.
    pub(super) cracks: Vec<CrackLine>,
    /// Number of load steps or events that did not come to rest.
    pub(super) failed: usize,
    /// Processor time, s.
    pub(super) seconds: f64,
    /// Summary of the run.
    pub(super) summary: Summary,
}

impl Reading {
    /// Meshes the body, runs the case and reads its results; all files are removed.
    ///
    /// # Errors
    ///
    /// If the body cannot be meshed, or the case not run.
    pub(super) fn from_run(test: &MeasuredTest, variant: &Variant) -> anyhow::Result<Self> {
        let place = tempfile::tempdir().context("no folder for temporary results")?;
        let attempt = || {
            let start = processor_seconds();
            let summary = results(test, variant, place.path())?;
            let seconds = processor_seconds() - start;
            Self::read(test, variant, &place.path().join(OUT), (summary, seconds))
        };
        attempt().with_context(|| format!("run `{}`", variant.name))
    }

    fn read(
        test: &MeasuredTest,
        variant: &Variant,
        folder: &Path,
        (summary, seconds): (Summary, f64),
    ) -> anyhow::Result<Self> {
        let history = CsvTable::read(folder.join("history.csv"))?;
        let at_rest: Vec<f64> = history.values("at_rest")?;
        let curve_over = |x: &Axis| {
            let [x, y] = [x, &test.y].map(|axis| values(&history, axis));
            let points = x?.into_iter().zip(y?).map(|(x, y)| [x, y]);
            let at = at_rest.iter().zip(points).filter(|(rest, _)| **rest > 0.0);
            anyhow::Ok(at.map(|(_, point)| point).collect::<Vec<_>>())
        };
        let band_curves = test
            .band
            .iter()
            .map(|it| it.x.as_ref().map(curve_over).transpose());
        let wants_cracks = test.band.iter().any(|it| it.of == Quantity::CrackY);
        let cracks = match wants_cracks && !has_solid(folder)? {
            true => StoredCracks::open(folder)?.lines(usize::MAX),
            false => Vec::new(),
        };
        Ok(Self {
            run: variant.name.clone(),
            in_series: variant.series.clone().zip(variant.size),
            curve: curve_over(&test.x)?,
            band_curves: band_curves.collect::<anyhow::Result<_>>()?,
            cracks,
            failed: at_rest.iter().filter(|rest| **rest == 0.0).count(),
            seconds,
            summary,
        })
    }

    /// Curve for a band, given by its index among the bands of the test.
    pub(super) fn curve(&self, band: usize) -> &[[f64; 2]] {
        self.band_curves[band].as_ref().unwrap_or(&self.curve)
    }

    /// Height y of the cracks at a position x, the nearest to an expected height, m; NaN without a crack there.
    pub(super) fn crack_height(&self, x: f64, expected: f64) -> f64 {
        let heights = self.cracks.iter().flat_map(|line| line.heights_at(x));
        let nearest = |one: f64, other: f64| {
            if (other - expected).abs() < (one - expected).abs() {
                other
            } else {
                one
            }
        };
        heights.reduce(nearest).unwrap_or(f64::NAN)
    }
}

/// Folder of the results in the temporary folder.
const OUT: &str = "results";

/// Runs the case of a variant into a folder.
fn results(test: &MeasuredTest, variant: &Variant, place: &Path) -> anyhow::Result<Summary> {
    let mesh = mesh(variant, place)?;
    let mut settings = test.set.clone();
    settings.push(format!("mesh.file={:?}", mesh.display().to_string()));
    settings.extend(variant.set.iter().cloned());
    let case = CaseFile::load(&repository().join(&test.case), &settings)?;
    match run(&case, &place.join(OUT), false, ProgressMode::Quiet)? {
        Report::Loading(summary) => Ok(*summary),
        Report::Modes(_) | Report::OfRankZero => bail!("the case has no loads to follow"),
    }
}

/// Path of the mesh, which is made first where the variant names a geometry.
fn mesh(variant: &Variant, place: &Path) -> anyhow::Result<PathBuf> {
    let Some(geometry) = &variant.geometry else {
        let stored = variant.mesh.as_ref().context("there is no mesh")?;
        return Ok(repository().join(stored).canonicalize()?);
    };
    let out = place.join("body.msh");
    let numbers = variant.numbers.iter();
    make_mesh(&MeshRequest {
        geometry: repository().join(geometry),
        out: out.clone(),
        force: false,
        gmsh: "gmsh".into(),
        numbers: numbers
            .map(|(name, value)| (name.clone(), *value))
            .collect(),
        size: None,
        coordinates: Coordinates::default(),
    })
    .context("the program gmsh must be on the PATH")?;
    Ok(out)
}

/// Values of an axis in the rows of a history.
fn values(history: &CsvTable, axis: &Axis) -> anyhow::Result<Vec<f64>> {
    let mut sums: Vec<f64> = Vec::new();
    for column in &axis.columns {
        let values: Vec<f64> = history.values(column)?;
        sums.resize(values.len(), 0.0);
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += value;
        }
    }
    Ok(sums.into_iter().map(|sum| axis.factor * sum).collect())
}

/// Processor time of all threads of this program so far, s.
fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
