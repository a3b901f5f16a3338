//! The patch test of a model: Young's modulus and Poisson's ratio of the body as it is discretised, and how far its bonds are from
//! uniform strains.
//!
//! The body is free and has the forces on it that its cells give to its points in a uniform strain: consistent tractions on its outline,
//! holes included, and jumps of the tractions at interfaces. A continuum would strain uniformly.

use std::sync::Arc;

use ligament_analysis::driver::Problem;
use ligament_analysis::{
    Attempt, Control, ControlKind, Equilibrium, ProportionalLoading, State, Unbalanced,
};
use ligament_model::correction::patch::{self, CellForces};
use ligament_model::layout::Layout;
use ligament_model::moduli::EngineeringConstants;
use ligament_model::uniform_strain::{self, UniformStrains};
use ligament_model::{Elasticity, Plane, System};
use thiserror::Error;

pub use crate::space::patch_test::{SolidPatchTest, solid_patch_test};

use crate::body::Origin;
use crate::error::SetupError;
use crate::formulation::{cell_forces, effective_elasticity};
use crate::loading::material_of_cell;
use crate::model::Model;
use crate::run::Unobserved;
use crate::setup::{ELASTIC_ENERGY_TOLERANCE, Setup};

/// Strains that the body is given: so small that strains over distances after the deformation are none others.
pub(crate) const SIZE: f64 = 1e-6;

/// What a body makes of uniform strains.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchTest {
    /// Elastic constants; none of a body of several materials, which strains uniformly under no uniform stress.
    pub constants: Option<Constants>,
    /// Root mean square over the bonds of what their strain has more than the mean strain of the body, over the size of that, for
    /// uniform strains along x, along y and in shear.
    pub scatter: [f64; 3],
    /// The most that the strain of a bond has more in some uniform strain, over the size of that.
    pub largest: f64,
    /// Middle of the bond that has it, m.
    pub place: [f64; 2],
}

/// Elastic constants of a body, and those of its material as the law has them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// Angle from x to the first axis of the material, along which the constants are, rad; none without axes.
    pub angle: Option<f64>,
    /// Constants of the body.
    pub body: EngineeringConstants,
    /// Constants of the material.
    pub material: EngineeringConstants,
}

/// Why a body has no patch test.
#[derive(Debug, Error)]
pub enum Untested {
    /// Nothing knows the forces of a uniform strain.
    #[error(
        "the body has points without cells, and cells alone know the forces of a uniform strain"
    )]
    NoCells,
    /// The body without its pre-cracks cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The equations cannot be set up.
    #[error(transparent)]
    Equations(#[from] ligament_analysis::SetupError),
    /// The free body has no equilibrium.
    #[error("{0}")]
    Unbalanced(Unbalanced),
    /// The strains of the body do not tell its stiffness.
    #[error("the uniform strains of the body cannot be told apart")]
    Degenerate,
    /// The bending test finds no section of the body.
    #[error("there are no cells with sides that lie opposite to each other")]
    NoSection,
    /// The outline of a body has many sides for its thinnest section to be sought.
    #[error(
        "the outline of the body has {sides} sides, and among so many its thinnest section takes long to find; ask with --patch-test"
    )]
    ManySides {
        /// Number of the sides.
        sides: usize,
    },
    /// A strip for the bending test is too large.
    #[error("the strip at the thinnest section has {points} points; ask with --patch-test")]
    TooLarge {
        /// Number of points of the strip.
        points: usize,
    },
}

/// The patch test of the body of a model, without its pre-cracks.
///
/// # Errors
///
/// If the body has no cells, or the free body no equilibrium.
pub fn patch_test(model: &Model) -> Result<PatchTest, Untested> {
    if model.cut_bonds() == 0 {
        return of_whole_body(model);
    }
    let setup = Setup {
        precracks: Vec::new(),
        ..model.setup.clone()
    };
    of_whole_body(&Model::build(setup, &mut ())?)
}

fn of_whole_body(model: &Model) -> Result<PatchTest, Untested> {
    let Model { setup, system, .. } = model;
    if matches!(setup.body.origin(), Origin::Points) {
        return Err(Untested::NoCells);
    }
    let forces = cell_forces(setup, &system.cloud, &material_of_cell(setup)?);
    let displacements = displacements(setup, system, &forces)?;
    let strains = UniformStrains::measure(&**system, &forces, &displacements);
    let strains = strains.ok_or(Untested::Degenerate)?;
    let [a, b] = system.bonds.ends[strains.bond].map(|end| system.cloud.positions[end as usize]);
    let origin = system.cloud.origin;
    Ok(PatchTest {
        constants: constants(setup, &**system, &strains),
        scatter: strains.scatter,
        largest: strains.largest,
        place: [0, 1].map(|axis| origin[axis] + 0.5 * (a[axis] + b[axis])),
    })
}

/// Displacements of the free body under the forces of each of the strains, shape (3, n_degrees_of_freedom), over their size.
fn displacements(
    setup: &Setup,
    system: &Arc<dyn System<2>>,
    forces: &CellForces,
) -> Result<[Vec<f64>; 3], Untested> {
    let [along_x, along_y, in_shear] =
        uniform_strain::loads(&**system, forces).map(|force| free_loading(system.layout(), force));
    let problem = Problem {
        system: system.clone(),
        criteria: Arc::default(),
        loads: along_x.clone(),
        solver: setup.solver,
        probes: Arc::default(),
    };
    let mut equilibrium = Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)?;
    let mut state = State::fresh(&**system);
    state.load_factor = SIZE;
    let nothing = equilibrium.break_bonds(&mut state, &[]);
    let mut found = [const { Vec::new() }; 3];
    for (loading, found) in [along_x, along_y, in_shear].into_iter().zip(&mut found) {
        equilibrium.load_with(loading);
        state.displacement.fill(0.0);
        let attempt = equilibrium.balance(&mut state, &nothing, &mut Unobserved);
        if let Attempt::Unbalanced(reason) = attempt.map_err(ligament_analysis::SetupError::from)? {
            return Err(Untested::Unbalanced(reason));
        }
        *found = state.displacement.iter().map(|it| it / SIZE).collect();
    }
    Ok(found)
}

/// Forces (n_degrees_of_freedom) on a body that nothing holds.
pub(crate) fn free_loading(layout: Layout, force: Vec<f64>) -> Arc<ProportionalLoading> {
    let control = Control {
        kind: ControlKind::Force,
        points: Vec::new(),
        shape: Vec::new(),
        magnitude: 1.0,
    };
    Arc::new(ProportionalLoading {
        force,
        ..ProportionalLoading::new(layout, control)
    })
}

/// The constants of a body of one material, along the axes of that.
fn constants(setup: &Setup, system: &dyn System<2>, strains: &UniformStrains) -> Option<Constants> {
    let [region] = setup.materials.as_slice() else {
        return None;
    };
    let plane = setup.plane();
    let elasticity = effective_elasticity(&region.material, &setup.law, plane);
    let angle = match elasticity {
        Elasticity::Orthotropic(material) => Some(material.angle),
        Elasticity::Isotropic(_) | Elasticity::Anisotropic(_) => None,
    };
    let along = angle.unwrap_or_default();
    let stiffness = elasticity.plane_stiffness(plane);
    let of_tractions = match setup.body.origin() {
        Origin::Lattice(lattice) => patch::stiffness_of_lattice(lattice, &system.cloud, &stiffness),
        _ => stiffness,
    };
    let read = |constants: EngineeringConstants| match (elasticity, plane) {
        (Elasticity::Isotropic(_), Plane::Strain) => out_of_plane_strain(constants),
        _ => constants,
    };
    Some(Constants {
        angle,
        body: read(strains.constants(&of_tractions, along)?),
        material: read(EngineeringConstants::along(stiffness, along)?),
    })
}

/// E and nu from E/(1 - nu^2) and nu/(1 - nu), with which the equations of plane stress describe plane strain.
fn out_of_plane_strain(constants: EngineeringConstants) -> EngineeringConstants {
    let poisson = constants.poisson / (1.0 + constants.poisson);
    EngineeringConstants {
        young: constants.young.map(|it| it * (1.0 - poisson * poisson)),
        poisson,
        ..constants
    }
}
