//! The patch test: E, Poisson's ratio and the strains of bonds in free bodies under uniform stress.

use anyhow::Context;
use ligament::Model;
use ligament::patch_test::{PatchTest, patch_test};
use ligament_mesh::{AnyMesh, gmsh};

use super::experiment::{Compute, Experiment, Findings};
use super::published::{Published, published};
use super::table::{Extent, Labels, Table};
use super::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "patch_test",
    title: "Patch test: free bodies under uniform stress",
    source: "closed form: a uniform stress gives a uniform strain",
    setup: "Free bodies with the consistent tractions of uniform strains on their outline: disks of 4 and 2 mm (846 and 2,998 \
            points, Delaunay), bars (997 points, 0.1 x 0.2 m, and 1,543, frontal), a plate that is finer along a line (2,231 points), a \
            ring (1,270), a bar of two materials with E 1 to 3 (277), lattices of 40 x 40 and 80 x 20 points. nu and E from the mean \
            strain of the body, and the root mean square over the bonds of what their strain has more than it, over its size: the worst \
            of strains along x, along y and in shear. With NHPD's domain correction all is shown, not judged.",
    cases: &[&CASE, &TWO_MATERIALS, &LATTICE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/patch-test.toml");
static TWO_MATERIALS: Template = template!("bimaterial-bar/case.toml");
static LATTICE: Template = template!("verification/lattice.toml");

static MESHES: [(&str, StoredMesh); 7] = [
    ("disk 4 mm", stored_mesh!("disk-4mm.msh")),
    ("disk 2 mm", stored_mesh!("disk-2mm.msh")),
    ("bar", stored_mesh!("plate-tall.msh")),
    ("long bar", stored_mesh!("plate.msh")),
    ("graded plate", stored_mesh!("central-crack-2mm.msh")),
    ("ring", stored_mesh!("annulus-coarse.msh")),
    (TWO, stored_mesh!("bimaterial.msh")),
];

const TWO: &str = "two materials";

const PERCENT: f64 = 100.0;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let mut judge = |table: Published| {
        table.judge(extent, |labels| {
            let trial = trial(labels)?;
            let test = memory.result(trial.command(), || Ok(patch_test(&trial.model()?)?))?;
            read(&test, labels.text("of")?)
        })
    };
    let mut tables: Vec<Table> = vec![
        judge(published!("patch-test-meshes"))?,
        judge(published!("patch-test-materials"))?,
        judge(published!("patch-test-laws"))?,
    ];
    tables.push(published!("patch-test-turned").judge(extent, turned)?);
    Ok(Findings {
        tables,
        plots: Vec::new(),
        ..Findings::default()
    })
}

/// The trial of an entry; settings without labels in its table are those of the case.
fn trial(labels: Labels<'_>) -> anyhow::Result<Trial> {
    let label = |key: &str| labels.text(key).ok();
    let body = label("mesh").unwrap_or("bar");
    let mut trial = match body {
        TWO => TWO_MATERIALS.trial().on_mesh(mesh(body)?),
        "square lattice" => lattice([40, 40]),
        "long lattice" => lattice([80, 20]),
        _ => CASE.trial().on_mesh(mesh(body)?),
    };
    for (key, setting) in [("law", "model.law"), ("correction", "correction.surface")] {
        if let Some(word) = label(key) {
            trial = trial.set(setting, word.to_lowercase());
        }
    }
    if let Some(plane) = label("plane") {
        trial = trial.set("mesh.plane", plane);
    }
    if label("lambda").is_some() {
        trial = trial.set("model.horizon_factor", labels.number("lambda")?);
    }
    if label("nu").is_some() {
        trial = trial.set("material.poisson", labels.number("nu")?);
    }
    Ok(trial)
}

/// A lattice of `cells` cells, with NHPD as on the meshes.
fn lattice(cells: [u32; 2]) -> Trial {
    let trial = LATTICE
        .trial()
        .on_lattice(cells, 0.01)
        .set("model.law", "nhpd");
    let trial = trial.set("material.poisson", 0.21);
    trial.set("correction.alpha", "length")
}

fn mesh(name: &str) -> anyhow::Result<&'static StoredMesh> {
    let found = MESHES.iter().find(|(known, _)| *known == name);
    found
        .map(|(_, mesh)| mesh)
        .with_context(|| format!("no mesh `{name}`"))
}

/// Result of a test for an entry.
fn read(test: &PatchTest, of: &str) -> anyhow::Result<f64> {
    let constants = || {
        test.constants
            .context("a body of several materials has no E")
    };
    Ok(match of {
        "E" => {
            let constants = constants()?;
            let ratio = |axis: usize| constants.body.young[axis] / constants.material.young[axis];
            further_from_one(ratio(0), ratio(1))
        }
        "nu" => constants()?.body.poisson[0][1],
        _ => PERCENT * test.scatter.iter().copied().fold(0.0, f64::max),
    })
}

fn further_from_one(one: f64, other: f64) -> f64 {
    if (one - 1.0).abs() < (other - 1.0).abs() {
        other
    } else {
        one
    }
}

/// The factors of the bonds and their ratios, in the order of the mesh file.
fn factors(model: Model) -> Vec<f64> {
    let (numbering, ends) = (model.body().numbering(), &model.plane().bonds.ends);
    let mut bonds: Vec<usize> = (0..ends.len()).collect();
    bonds.sort_by_key(|&bond| numbering.ends_in_file(ends[bond]));
    let fixed = &model.fixed;
    let both = [&fixed.domain_factor, &fixed.shear_ratio].into_iter();
    let found = both.filter(|it| !it.is_empty());
    found
        .flat_map(|values| bonds.iter().map(|&bond| values[bond]))
        .collect()
}

/// Root mean square of the change of the factors of the bonds when the mesh is turned.
fn turned(labels: Labels<'_>) -> anyhow::Result<f64> {
    let (sin, cos) = labels.number("angle")?.to_radians().sin_cos();
    let trial = trial(labels)?;
    let mut mesh = gmsh::parse(mesh(labels.text("mesh")?)?.bytes)?;
    for place in &mut mesh.positions {
        let [x, y] = *place;
        *place = [cos * x - sin * y, sin * x + cos * y];
    }
    let straight = trial.model()?;
    let turned = trial.model_with(|setup| setup.body = AnyMesh::Plane(mesh).into())?;
    let (mut sum, mut count) = (0.0, 0.0);
    for (turned, straight) in factors(turned).into_iter().zip(factors(straight)) {
        sum += (turned / straight - 1.0_f64).powi(2);
        count += 1.0;
    }
    Ok((sum / count).sqrt())
}
