//! Faces of the cracks of a model: what pre-cracks cut, and how stiff it is when faces close.

use ligament_model::bonds::precrack::{Crack, normals};
use ligament_model::contact::{CutBond, Faces};
use ligament_model::element::Rigidities;
use ligament_model::{BondSet, BondStiffness, BondSystem, Correction, PointCloud};

use crate::formulation::Formulation;

/// Rigidities of the bonds of the whole body that are cut (n_bonds).
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

/// The faces of a body with the bonds that are left, and of those that pre-cracks cut the ends and the rigidities, if they close.
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
