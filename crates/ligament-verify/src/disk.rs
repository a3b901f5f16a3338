//! The intact Brazilian disk: strength, stiffness, damage and cost over the horizon factor (NHPD section 3.1).

use anyhow::{Context, bail};

use super::disk_test::{CLOSED_FORM, DiskTest};
use super::equations::Equations;
use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::spread::spread;
use super::table::{Extent, LabelError, Labels, Table};
use super::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};
use ligament_plot::plots::{Colour, Plot, Series};
use ligament_study::line_fit::LineFit;

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "disk",
    title: "Brazilian disk: strength and horizon factor",
    source: "Zhang, Yang and Zhuang (NHPD), section 3.1, eq. 22, Figs 7 to 12",
    setup: "Disk of diameter 0.1 m, t = 1 m, F_t = 3.81 MPa, plane stress, NHPD. Assumed, because the text does not say: E = 15 GPa, nu = \
            0.21; for the three meshes of the paper (Fig. 6) triangles of 4 mm (913 points), 3 mm (1,440) and 2 mm (2,948); platens that \
            are the nodes of the rim with |x| <= 1.5 mm, moved together in steps of 4 um; five bonds an iteration, first those most beyond \
            their limit. `domain` is the correction of the paper, `patch` the one under which uniform strains are equilibria. The peak \
            is the largest load before the load first falls by 2 %; a test ends when it has fallen by 3 %. Points with a damage \
            above 0.3 are cracked. Computing times are not compared, because they are another machine's: the size of the \
            equations is, which is why the paper has them grow.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("brazilian-disk/case.toml");

/// Meshes by their size.
static MESHES: [(&str, StoredMesh); 3] = [
    ("4 mm", stored_mesh!("disk-4mm-platen-1.5mm.msh")),
    ("3 mm", stored_mesh!("disk-3mm-platen-1.5mm.msh")),
    ("2 mm", stored_mesh!("disk-2mm-platen-1.5mm.msh")),
];

/// The mesh of 2 mm with wider platens: |x| <= 5 mm.
const WIDE_PLATENS: &str = "2 mm, platens of 5 mm";
static WIDE: StoredMesh = stored_mesh!("disk-2mm-platen-5mm.msh");

/// Horizon factors from which on the paper finds similar stiffness.
const LAMBDAS: [f64; 5] = [2.0, 2.5, 3.0, 3.5, 4.0];

/// Horizon factors of the curves, with their colours.
const CURVES: [(f64, Colour); 6] = [
    (1.5, Colour::Purple),
    (2.0, Colour::Sky),
    (2.5, Colour::Blue),
    (3.0, Colour::Green),
    (3.5, Colour::Orange),
    (4.0, Colour::Vermilion),
];

/// Settings of a test of the disk.
#[derive(Debug, Clone, Copy)]
struct Case<'a> {
    mesh: &'a str,
    correction: &'a str,
    lambda: f64,
}

impl Case<'_> {
    fn trial(self) -> anyhow::Result<Trial> {
        let found = MESHES.iter().find(|(name, _)| *name == self.mesh);
        let mesh = match self.mesh {
            WIDE_PLATENS => &WIDE,
            other => &found.with_context(|| format!("no mesh `{other}`"))?.1,
        };
        let trial = CASE.trial().set("model.horizon_factor", self.lambda);
        let trial = trial.set("correction.surface", self.correction);
        Ok(trial.on_mesh(mesh))
    }

    fn test(self, tests: &mut Memory<DiskTest>) -> anyhow::Result<DiskTest> {
        tests.reading_with_breakages(&self.trial()?, DiskTest::from_run)
    }
}

/// The test of the disk on a mesh, under a correction and with a horizon factor.
pub(super) fn trial(mesh: &str, correction: &str, lambda: f64) -> anyhow::Result<Trial> {
    let case = Case {
        mesh,
        correction,
        lambda,
    };
    case.trial()
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut tests = Memory::default();
    let mut equations = Memory::default();
    let (tests, sizes) = (&mut tests, &mut equations);
    let peaks =
        published!("disk-peak").judge(extent, |labels| Ok(of_labels(labels)?.test(tests)?.peak))?;
    let tables = vec![
        published!("disk-line").judge(extent, |labels| line(labels, tests))?,
        published!("disk-spread").judge(extent, |labels| spread_of(labels, tests))?,
        published!("disk-start").judge(extent, |labels| start(labels, tests))?,
        published!("disk-crack").judge(extent, |labels| crack(labels, tests))?,
        published!("disk-equations").judge(extent, |labels| rises(labels, sizes))?,
    ];
    let mut plots = vec![peak_plot(&peaks)?];
    if extent == Extent::Full {
        plots.push(cost_plot(sizes)?);
        for correction in ["domain", "patch"] {
            for (mesh, _) in &MESHES {
                plots.push(curves(mesh, correction, tests)?);
            }
        }
    }
    Ok(Findings {
        tables: [vec![peaks], tables].concat(),
        plots,
        ..Findings::default()
    })
}

fn of_labels<'a>(labels: Labels<'a>) -> Result<Case<'a>, LabelError> {
    Ok(Case {
        mesh: labels.text("mesh")?,
        correction: labels.text("correction")?,
        lambda: labels.number("lambda")?,
    })
}

/// Parameters of the straight line through the peaks over the horizon factor, or deviations from it.
fn line(labels: Labels<'_>, tests: &mut Memory<DiskTest>) -> anyhow::Result<f64> {
    let (mesh, correction) = (labels.text("mesh")?, labels.text("correction")?);
    let mut peaks = Vec::new();
    for lambda in LAMBDAS {
        let case = Case {
            mesh,
            correction,
            lambda,
        };
        peaks.push([lambda, case.test(tests)?.peak]);
    }
    let LineFit {
        slope, intercept, ..
    } = LineFit::through(&peaks)?;
    let at = |lambda: f64| slope * lambda + intercept;
    Ok(match labels.text("of")? {
        "slope" => slope,
        "intercept" => intercept,
        "at 3" => at(3.0),
        "off the line" => {
            let off = peaks
                .iter()
                .map(|[lambda, peak]| (peak / at(*lambda) - 1.0).abs());
            100.0 * off.fold(0.0, f64::max)
        }
        "rises" => peaks
            .windows(2)
            .filter(|pair| pair[1][1] > pair[0][1])
            .count() as f64,
        other => bail!("nothing `{other}` of the line"),
    })
}

/// Spread of stiffness or peak over the horizon factors, or over the meshes.
fn spread_of(labels: Labels<'_>, tests: &mut Memory<DiskTest>) -> anyhow::Result<f64> {
    let correction = labels.text("correction")?;
    let cases: Vec<Case<'_>> = match (labels.text("mesh")?, labels.text("lambda")?) {
        ("all", _) => {
            let lambda = labels.number("lambda")?;
            let names = MESHES.iter().map(|(mesh, _)| *mesh);
            names
                .map(|mesh| Case {
                    mesh,
                    correction,
                    lambda,
                })
                .collect()
        }
        (mesh, "2 to 4") => LAMBDAS
            .map(|lambda| Case {
                mesh,
                correction,
                lambda,
            })
            .to_vec(),
        (mesh, lambda) => bail!("no spread of mesh `{mesh}`, lambda `{lambda}`"),
    };
    let of = labels.text("of")?;
    let mut values = Vec::new();
    for case in cases {
        let test = case.test(tests)?;
        values.push(match of {
            "stiffness" => test.stiffness,
            "peak" => test.peak,
            other => bail!("of is `stiffness` or `peak`, not `{other}`"),
        });
    }
    Ok(spread(&values))
}

/// Position of the start of damage.
fn start(labels: Labels<'_>, tests: &mut Memory<DiskTest>) -> anyhow::Result<f64> {
    let test = of_labels(labels)?.test(tests)?;
    Ok(match labels.text("of")? {
        "first bond" => test.first_bond,
        "first crack" => test.first_crack,
        "rim" => test.at_rim,
        other => bail!("no start `{other}`"),
    })
}

/// Position and extent of the crack at a stage.
fn crack(labels: Labels<'_>, tests: &mut Memory<DiskTest>) -> anyhow::Result<f64> {
    let test = of_labels(labels)?.test(tests)?;
    let band = match labels.text("stage")? {
        "peak" => test.at_peak,
        "end" => test.at_end,
        other => bail!("no stage `{other}`"),
    };
    Ok(match labels.text("of")? {
        "length" => band.length,
        "aside" => band.aside,
        "above" => band.above,
        "width" => band.width,
        "splits" => f64::from(u8::from(band.splits)),
        other => bail!("nothing `{other}` of a crack"),
    })
}

/// A size of the equations over the horizon factor.
fn sizes(mesh: &str, of: &str, memory: &mut Memory<Equations>) -> anyhow::Result<Vec<[f64; 2]>> {
    let mut sizes = Vec::new();
    for (lambda, _) in CURVES {
        let correction = "domain";
        let trial = Case {
            mesh,
            correction,
            lambda,
        }
        .trial()?;
        let equations =
            memory.result(trial.command(), || Equations::from_model(&trial.model()?))?;
        let size = match of {
            "unknowns" => equations.unknowns,
            "matrix" => equations.matrix,
            "factor" => equations.factor,
            "multiplications" => equations.multiplications,
            other => bail!("no size `{other}` of the equations"),
        };
        sizes.push([lambda, size]);
    }
    Ok(sizes)
}

/// Number of horizon factors at which the equations are larger than at the one before.
fn rises(labels: Labels<'_>, memory: &mut Memory<Equations>) -> anyhow::Result<f64> {
    let sizes = sizes(labels.text("mesh")?, labels.text("of")?, memory)?;
    let rises = sizes.windows(2).filter(|pair| pair[1][1] > pair[0][1]);
    Ok(rises.count() as f64)
}

/// Plot of the multiplications of the factor over those at lambda = 2 (in place of the times of Fig. 8).
fn cost_plot(memory: &mut Memory<Equations>) -> anyhow::Result<Plot> {
    let mut series = Vec::new();
    for ((mesh, _), colour) in MESHES
        .iter()
        .zip([Colour::Sky, Colour::Blue, Colour::Vermilion])
    {
        let sizes = sizes(mesh, "multiplications", memory)?;
        let [_, at_2] = sizes[1];
        let points = sizes.iter().map(|[lambda, size]| [*lambda, size / at_2]);
        series.push(Series::line(*mesh, colour, points.collect()));
    }
    let axes = [
        "horizon factor lambda",
        "multiplications of a factor / those at lambda = 2",
    ];
    Ok(Plot::new(
        "disk-equations",
        "Cost of the equations of the disk",
        axes,
        series,
    ))
}

fn peak_plot(table: &Table) -> anyhow::Result<Plot> {
    let eq_22 = (6..=16)
        .map(|quarters| 0.25 * f64::from(quarters))
        .map(|l| [l, (3.0 * l - 1.0) / 8.0]);
    let mut series = vec![Series::dashes(
        "NHPD eq. 22",
        Colour::Black,
        eq_22.collect(),
    )];
    let colours = [
        [Colour::Sky, Colour::Blue, Colour::Green],
        [Colour::Orange, Colour::Vermilion, Colour::Purple],
    ];
    for (correction, colours) in ["domain", "patch"].into_iter().zip(colours) {
        for ((mesh, _), colour) in MESHES.iter().zip(colours) {
            let points =
                table.computed("lambda", &format!("mesh={mesh}, correction={correction}"))?;
            series.push(Series::line(
                format!("{correction}, {mesh}"),
                colour,
                points,
            ));
        }
    }
    let axes = ["horizon factor lambda", "peak load / (pi D t F_t/2)"];
    Ok(Plot::new(
        "disk-peak",
        "Strength of the Brazilian disk",
        axes,
        series,
    ))
}

/// Plot of load over displacement for all horizon factors (Fig. 7).
fn curves(mesh: &str, correction: &str, tests: &mut Memory<DiskTest>) -> anyhow::Result<Plot> {
    let mut series = vec![Series::dashes(
        "pi D t F_t/2",
        Colour::Black,
        vec![[0.0, 1e-3 * CLOSED_FORM], [0.3, 1e-3 * CLOSED_FORM]],
    )];
    for (lambda, colour) in CURVES {
        let curve = Case {
            mesh,
            correction,
            lambda,
        }
        .test(tests)?
        .curve;
        series.push(Series::curve(format!("lambda = {lambda}"), colour, curve));
    }
    let name = format!("disk-curves-{correction}-{}", mesh.replace(' ', ""));
    let title = format!("Disk of {mesh} cells, correction `{correction}`");
    Ok(Plot::new(
        &name,
        &title,
        ["displacement, mm", "load, kN"],
        series,
    ))
}
