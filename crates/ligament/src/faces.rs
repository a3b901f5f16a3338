//! Faces of the cracks of a model: the bonds that pre-cracks cut, and their rigidities when faces close.

use ligament_model::bonds::precrack::{Crack, normals};
use ligament_model::contact::{CutBond, Faces};
use ligament_model::element::Rigidities;
use ligament_model::{BondSet, BondStiffness, BondSystem, Correction, PointCloud};

use crate::formulation::Formulation;

/// Rigidities of the bonds that pre-cracks cut, computed in the whole body; `is_cut` has shape (n_bonds).
pub(crate) fn rigidities<const D: usize>(
    formulation: &Formulation<'_, D>,
    bonds: &BondSet<D>,
    stiffness: &BondStiffness,
    correction: &Correction,
    is_cut: &[bool],
) -> Rigidities {
    let Formulation { setup, cloud, .. } = *formulation;
    let bonds = bonds.clone().retained(is_cut);
    let stiffness = stiffness.clone().retained(is_cut);
    let correction = correction.clone().retained(is_cut);
    let (alpha, omega) = (correction.length_factor, &correction.domain_factor);
    let element = setup.law.element();
    BondSystem::new(cloud.clone(), bonds, element, stiffness, alpha, omega).rigidities
}

/// The faces of a body: remaining bonds, and ends and rigidities of the bonds that pre-cracks cut, if faces close.
pub(crate) fn faces<const D: usize>(
    (closing, cracks): (bool, &[Crack]),
    cloud: &PointCloud<D>,
    left: &BondSet<D>,
    cut: &[[u32; 2]],
    rigidities: Option<&Rigidities>,
) -> Faces<D> {
    let normals = normals(cracks, cut, cloud).into_iter();
    let numbered = cut.iter().zip(normals).enumerate();
    let cut = numbered.map(|(place, (&ends, normal))| CutBond {
        ends,
        normal,
        axial: rigidities.map_or(0.0, |it| it.axial[place]),
        shear: rigidities.map_or(0.0, |it| it.shear[place]),
    });
    if closing {
        Faces::closing(cut.collect(), left)
    } else {
        Faces::open(cut.collect())
    }
}
