//! The patch test of a model in space, as that of the [plane](crate::patch_test): Young's moduli, Poisson's ratios and shear moduli of the
//! body as it is discretised, and how far its bonds are from uniform strains.

use std::sync::Arc;

use ligament_analysis::driver::Problem;
use ligament_analysis::{Attempt, Equilibrium, ProportionalLoading, State};
use ligament_model::{Isotropic, System};
use ligament_model::space::correction::patch::SolidCellForces;
use ligament_model::space::uniform_strain::{self, SolidConstants, SolidUniformStrains};

use super::formulation::{cell_forces, constants};
use crate::body::Origin;
use crate::loading::material_of_cell;
use crate::model::Model;
use crate::patch_test::{SIZE, Untested, free_loading};
use crate::run::Unobserved;
use crate::setup::{ELASTIC_ENERGY_TOLERANCE, Setup};

/// What a body in space makes of uniform strains.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidPatchTest {
    /// Constants of the body and of its material as the law has them; none of a body of several materials, which strains uniformly under
    /// no uniform stress.
    pub constants: Option<(SolidConstants, Isotropic)>,
    /// Root mean square over the bonds of what their strain has more than the mean strain of the body, over the size of that, for
    /// uniform strains along x, y and z and in shear in xy, xz and yz.
    pub scatter: [f64; 6],
    /// The most that the strain of a bond has more in some uniform strain, over the size of that.
    pub largest: f64,
    /// Middle of the bond that has it, m.
    pub place: [f64; 3],
}

/// The patch test of the body of a model, without its pre-cracks.
///
/// # Errors
///
/// If the body is no mesh, or the free body has no equilibrium.
pub fn solid_patch_test(model: &Model<3>) -> Result<SolidPatchTest, Untested> {
    if model.cut_bonds() == 0 {
        return of_whole_body(model);
    }
    let setup = Setup {
        precracks: Vec::new(),
        ..model.setup.clone()
    };
    of_whole_body(&Model::<3>::build(setup, &mut ())?)
}

fn of_whole_body(model: &Model<3>) -> Result<SolidPatchTest, Untested> {
    let Model { setup, system, .. } = model;
    if !matches!(setup.body.origin(), Origin::SolidMesh(_)) {
        return Err(Untested::NoCells);
    }
    let forces = cell_forces(setup, &system.cloud, &material_of_cell(setup)?);
    let displacements = displacements(setup, system, &forces)?;
    let strains = SolidUniformStrains::measure(&**system, &forces, &displacements);
    let strains = strains.ok_or(Untested::Degenerate)?;
    let [a, b] = system.bonds.ends[strains.bond].map(|end| system.cloud.positions[end as usize]);
    let origin = system.cloud.origin;
    let of_body = match constants(setup).as_slice() {
        [material] => strains.constants(material).map(|it| (it, *material)),
        _ => None,
    };
    Ok(SolidPatchTest {
        constants: of_body,
        scatter: strains.scatter,
        largest: strains.largest,
        place: [0, 1, 2].map(|axis| origin[axis] + 0.5 * (a[axis] + b[axis])),
    })
}

/// Displacements of the free body under the forces of each of the strains, shape (6, n_degrees_of_freedom), over their size.
fn displacements(
    setup: &Setup<3>,
    system: &Arc<dyn System<3>>,
    forces: &SolidCellForces,
) -> Result<[Vec<f64>; 6], Untested> {
    let loads: [Arc<ProportionalLoading>; 6] =
        uniform_strain::loads(&**system, forces).map(|force| free_loading(system.layout(), force));
    let problem = Problem {
        system: system.clone(),
        criteria: Arc::default(),
        loads: loads[0].clone(),
        solver: setup.solver,
        probes: Arc::default(),
    };
    let mut equilibrium = Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)?;
    let mut state = State::fresh(&**system);
    state.load_factor = SIZE;
    let nothing = equilibrium.break_bonds(&mut state, &[]);
    let mut found = [const { Vec::new() }; 6];
    for (loading, found) in loads.into_iter().zip(&mut found) {
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
