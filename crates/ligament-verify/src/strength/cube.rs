//! First failure in space: a cube under uniform stresses, and a spherical cavity.

use super::uniform::{first_failure, of_cube};
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{StoredMesh, Template, Trial, stored_mesh, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "strength_cube",
    title: "First failure in space",
    source: "definition of the criteria; closed form for a cavity (Goodier 1933): (27 - 15 nu)/(14 - 10 nu) of the far stress",
    setup: "Cube of 60 mm on 357 points under the tractions of a uniform stress, principal axes along the edges or turned by 23 degrees about z and then \
            about x: stress at the first breakage over that of the surface; E = 15 GPa, nu = 0.21, F_t = 3.81 MPa, F_c = 10 F_t. And an eighth of a cube \
            with a cavity of a tenth of its edge on 1,116 points, E = 30 GPa, criterion `bond-rankine`: F_t over the far stress at the first breakage. \
            NHPD, lambda = 3 (of the cavity also 2.5). Not run: the penny-shaped crack of `cases/penny-crack` with `rankine`, whose horizon there is six tenths of the \
            crack's radius, and which had not got to its largest load after five minutes.",
    cases: &[&CUBE, &CAVITY],
    compute: Compute::Code(compute),
};

static CUBE: Template = template!("verification/strength-cube.toml");
static CAVITY: Template = template!("verification/strength-cavity.toml");
static CUBE_MESH: StoredMesh = stored_mesh!("solids/cube.msh");
static CAVITY_MESH: StoredMesh = stored_mesh!("solids/cavity.msh");

/// Tensile and compressive strength, Pa.
const TENSILE: f64 = 3.81e6;
const COMPRESSIVE: f64 = 38.1e6;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let cube = published!("strength-cube").judge(extent, of_entry)?;
    let cavity = published!("strength-cavity").judge(extent, |labels| {
        let trial = (CAVITY.trial())
            .on_mesh(&CAVITY_MESH)
            .set("model.horizon_factor", labels.number("lambda")?)
            .set("material.poisson", labels.number("nu")?);
        Ok(1.0 / first_failure(&trial)?)
    })?;
    Ok(Findings {
        tables: vec![cube, cavity],
        ..Findings::default()
    })
}

fn of_entry(labels: Labels<'_>) -> anyhow::Result<f64> {
    let criterion = labels.text("criterion")?;
    let stresses = [
        labels.number("sigma_1")?,
        labels.number("sigma_2")?,
        labels.number("sigma_3")?,
    ];
    let surface = match criterion {
        "mohr-coulomb" => {
            let least = stresses.into_iter().fold(0.0, f64::min);
            TENSILE / (1.0 - least * TENSILE / COMPRESSIVE)
        }
        _ => TENSILE,
    };
    let trial = cube().set("fracture.criterion.0.kind", criterion).set(
        "correction.regularisation",
        labels.number("regularisation")?,
    );
    let applied = stresses.map(|it| 2.0 * surface * it);
    Ok(2.0 * of_cube(trial, applied, labels.number("angle")?)?)
}

/// The cube on its mesh.
pub(super) fn cube() -> Trial {
    CUBE.trial().on_mesh(&CUBE_MESH)
}
