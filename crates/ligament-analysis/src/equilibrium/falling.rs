//! Falling stiffness of softening bonds that are loaded further: what their tangent has less than their secant.
//!
//! A bond with the stiffness K and the deformation d has the force omega K d, with the share omega that its law leaves at the largest
//! kappa = e/e_0 so far. The measure e is homogeneous in d; where e^2 is proportional to d . K d (the energy of the bond, or its stretch
//! with the axial stiffness alone), the tangent in further loading is
//!
//! omega K + omega' kappa (K d) (K d)^T / (d . K d), omega' < 0.
//!
//! Other measures, strains that take no part in the measure and cells of a volumetric stiffness keep their secants, so that the stiffness
//! stays symmetric.

use ligament_model::element::{BondDeformation, StiffnessFactors, Term};
use ligament_model::failure::{CriteriaInState, Weakened};
use rayon::prelude::*;

use crate::problem::Problem;
use crate::state::State;

/// The bonds of a state that are loaded further at deformations (n_bonds), ascending, each with a term c g g^T, c < 0, that its tangent
/// has beside its secant.
pub(super) fn terms(
    problem: &Problem,
    state: &State,
    deformations: &[BondDeformation],
) -> Vec<(u32, Term)> {
    let criteria = state.softening.criteria(&problem.criteria);
    let of_bond = |bond: usize| {
        let deformation = &deformations[bond];
        let (place, slope) = (state.softening).fall(&criteria, bond, deformation)?;
        let strains = strains(&criteria, place, deformation)?;
        let terms = problem.system.terms(&state.intact, bond, &strains);
        let (mut energy, mut force) = (0.0, Vec::new());
        for (rigidity, entries) in terms {
            let strain: f64 = (entries.iter())
                .map(|&(dof, value)| value * state.displacement[dof])
                .sum();
            energy += rigidity * strain * strain;
            let entries = entries.into_iter();
            force.extend(entries.map(|(dof, value)| (dof, rigidity * strain * value)));
        }
        (energy > 0.0 && slope < 0.0).then(|| (bond as u32, (slope / energy, force)))
    };
    let bonds = (0..deformations.len()).into_par_iter();
    bonds
        .filter(|bond| state.intact[*bond])
        .filter_map(of_bond)
        .collect()
}

/// Factors one for the strains that the measure of a criterion has, zero for others; None where the square of the measure is no energy.
fn strains(
    criteria: &CriteriaInState<'_>,
    place: usize,
    deformation: &BondDeformation,
) -> Option<StiffnessFactors> {
    let whole = |is: bool| if is { 1.0 } else { 0.0 };
    let is_open = deformation.stretch() > 0.0;
    let measure = criteria.criteria().list[place].measure;
    let is_energy = measure.needs_shear_stiffness();
    let is_stretch = measure.opens() && !measure.takes_rotations();
    if !(is_energy || is_stretch) {
        return None;
    }
    let axial = is_open || measure.weakens() == Weakened::Whole;
    Some(StiffnessFactors {
        axial: whole(axial),
        shear: whole(is_energy),
        rotational: 0.0,
    })
}
