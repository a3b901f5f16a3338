//! The patch test of a model: Young's modulus and Poisson's ratio of the discrete body, and the deviation of its bonds from uniform
//! strains.
//!
//! The free body is loaded by the forces of its cells in a uniform strain: consistent tractions on its outline, holes included, and jumps
//! of the tractions at interfaces. A continuum would strain uniformly.

use std::sync::Arc;

use ligament_analysis::driver::Problem;
use ligament_analysis::{
    Attempt, Control, ControlKind, Equilibrium, ProportionalLoading, State, Unbalanced,
};
use ligament_model::correction::patch::CellForces;
use ligament_model::layout::Layout;
use ligament_model::moduli::EngineeringConstants;
use ligament_model::uniform_strain::{self, UniformStrains};
use ligament_model::{Elasticity, Plane, System};
use thiserror::Error;

use crate::body::Origin;
use crate::error::SetupError;
use crate::formulation::stiffness_of_materials;
use crate::loading::material_of_cell;
use crate::model::Model;
use crate::run::NoObserver;
use crate::setup::{ELASTIC_ENERGY_TOLERANCE, Setup};
use crate::system::over_dimension;

/// Size of the applied strains, small enough for strains over deformed distances to be equal.
pub(crate) const SIZE: f64 = 1e-6;

/// Result of the patch test.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchTest {
    /// Elastic constants; none for a body of several materials, which has no uniform strain under uniform stress.
    pub constants: Option<Constants>,
    /// Root mean square over the bonds of the deviation from the body's mean strain, over the size of the mean strain, for uniform strains
    /// along x, along y, in shear in xy, and in space along z, in xz and in yz.
    pub scatter: Vec<f64>,
    /// Largest deviation of a bond in any uniform strain, over the size of that strain.
    pub largest: f64,
    /// Midpoint of the bond with the largest deviation, m.
    pub place: Vec<f64>,
}

/// Elastic constants of a body, and of its material under the law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// Angle from x to the first axis of the material, the axis of the constants, rad; none without axes.
    pub angle: Option<f64>,
    /// Constants of the body; in the plane those along z are zero.
    pub body: EngineeringConstants<3>,
    /// Constants of the material.
    pub material: EngineeringConstants<3>,
}

/// Error of a patch or bending test that cannot be done.
#[derive(Debug, Error)]
pub enum Untested {
    /// The body has no cells, which give the forces of a uniform strain.
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
    /// The strains of the body do not determine its stiffness.
    #[error("the uniform strains of the body cannot be told apart")]
    Degenerate,
    /// The body has no section for the bending test.
    #[error("there are no cells with sides that lie opposite to each other")]
    NoSection,
    /// The outline has too many sides for the search of the thinnest section.
    #[error(
        "the outline of the body has {sides} sides, and among so many its thinnest section takes long to find; use --patch-test"
    )]
    ManySides {
        /// Number of the sides.
        sides: usize,
    },
    /// The strip of the bending test has too many points.
    #[error("the strip at the thinnest section has {points} points; use --patch-test")]
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
    over_dimension!(&model.system, system => of_bonds(model, &**system))
}

fn of_bonds<const D: usize>(model: &Model, system: &dyn System<D>) -> Result<PatchTest, Untested> {
    let setup = &model.setup;
    if matches!(setup.body.origin(), Origin::Points) {
        return Err(Untested::NoCells);
    }
    let (cloud, bonds) = (&system.cloud, &system.bonds);
    // On a lattice tractions act on the faces of cells, for bonds, and on the blocks between points, for what these carry themselves.
    let origin = setup.body.origin();
    let is_lattice = matches!(origin, Origin::Lattice(_) | Origin::SolidLattice(_));
    let of_bonds = setup.of_bonds().filter(|_| is_lattice);
    let stiffness = stiffness_of_materials(of_bonds.as_ref().unwrap_or(setup));
    let materials = material_of_cell(setup)?;
    let mut forces = (setup.body.geometry()).cell_forces(cloud, &materials, stiffness);
    if let Some(terms) = system.volumetric.as_ref().filter(|_| is_lattice) {
        terms.add_to(&mut forces);
    }
    let loads = uniform_strain::loads(system, &forces);
    let displacements = displacements(model, loads)?;
    let strains = UniformStrains::measure(system, &forces, &displacements);
    let strains = strains.ok_or(Untested::Degenerate)?;
    let [a, b] = bonds.ends[strains.bond].map(|end| cloud.positions[end as usize]);
    Ok(PatchTest {
        constants: constants(setup, &forces, &strains),
        scatter: strains.scatter,
        largest: strains.largest,
        place: (0..D)
            .map(|axis| cloud.origin[axis] + 0.5 * (a[axis] + b[axis]))
            .collect(),
    })
}

/// Displacements of the free body under the forces of each strain over the strain's size, shape (n_strains, n_degrees_of_freedom), m.
fn displacements(
    Model { setup, system, .. }: &Model,
    forces: Vec<Vec<f64>>,
) -> Result<Vec<Vec<f64>>, Untested> {
    let loads = forces.into_iter();
    let loads: Vec<_> = loads
        .map(|force| free_loading(system.layout, force))
        .collect();
    let problem = Problem {
        solver: setup.solver.for_few_solutions(&**system),
        system: system.to_bonds(),
        criteria: Arc::default(),
        loads: loads[0].clone(),
        probes: Arc::default(),
        notches: Arc::default(),
        face_friction: 0.0,
        contact: Default::default(),
    };
    let mut equilibrium = Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)?;
    let mut state = State::fresh(&**system);
    state.load_factor = SIZE;
    let nothing = equilibrium.break_bonds(&mut state, &[]);
    let mut found = Vec::new();
    for loading in loads {
        equilibrium.load_with(loading);
        state.displacement.fill(0.0);
        let attempt = equilibrium.balance(&mut state, &nothing, &mut NoObserver);
        if let Attempt::Unbalanced(reason) = attempt.map_err(ligament_analysis::SetupError::from)? {
            return Err(Untested::Unbalanced(reason));
        }
        found.push(state.displacement.iter().map(|it| it / SIZE).collect());
    }
    Ok(found)
}

/// Loading of a body without supports by forces (n_degrees_of_freedom).
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

/// The constants of a body of one material, along the material's axes.
fn constants<const D: usize>(
    setup: &Setup,
    forces: &CellForces<D>,
    strains: &UniformStrains,
) -> Option<Constants> {
    let ([region], [stiffness]) = (setup.materials.as_slice(), forces.stiffness.as_slice()) else {
        return None;
    };
    let elasticity = region.material.elasticity;
    let angle = match elasticity {
        Elasticity::Orthotropic(material) => Some(material.angle),
        Elasticity::Isotropic(_) | Elasticity::Anisotropic(_) => None,
    };
    let axes: [[f64; D]; D] = axes(angle.unwrap_or_default());
    // Isotropic constants from plane strain are converted to the constants of the material.
    let is_strain = elasticity.isotropic().is_some() && setup.space() == Plane::Strain.into();
    let read = |constants| match is_strain {
        true => out_of_plane_strain(constants),
        false => constants,
    };
    let of_material = stiffness_of_materials(setup).pop()?;
    Some(Constants {
        angle,
        body: read(strains.constants(stiffness, axes)?).resized(),
        material: read(EngineeringConstants::along(of_material, axes)?).resized(),
    })
}

/// Unit vectors of the axes of a material at an angle (rad) from x towards y.
fn axes<const D: usize>(angle: f64) -> [[f64; D]; D] {
    let (s, c) = angle.sin_cos();
    let turn = |row: usize, column: usize| match (row, column) {
        (0, 0) | (1, 1) => c,
        (0, 1) => s,
        (1, 0) => -s,
        _ => f64::from(u8::from(row == column)),
    };
    std::array::from_fn(|row| std::array::from_fn(|column| turn(row, column)))
}

/// E and nu from E/(1 - nu^2) and nu/(1 - nu), with which the equations of plane stress describe plane strain.
fn out_of_plane_strain<const D: usize>(
    constants: EngineeringConstants<D>,
) -> EngineeringConstants<D> {
    let mut poisson = constants.poisson;
    for (a, ratios) in poisson.iter_mut().enumerate() {
        for (b, ratio) in ratios.iter_mut().enumerate() {
            if a != b {
                *ratio /= 1.0 + *ratio;
            }
        }
    }
    let of_first = poisson[0][1];
    EngineeringConstants {
        young: constants.young.map(|it| it * (1.0 - of_first * of_first)),
        poisson,
        ..constants
    }
}
