//! Bonds of three classes on a lattice, with all strains of a small imaginary rectangle around each (MBB-PD), in the
//! form that conserves energy.
//!
//! As printed the factors psi (eq. 19) are calibrated with other strains (eq. A.6) than the bonds have (eqs 12 to 15), and the forces (eq. 17)
//! are not conjugate to the shear strains: axial stiffness 0.594, shear stiffness 0.238 of the right ones at m = 3. Here every bond has the
//! energy density (A.7) with all three strains and one factor
//!
//! psi_j = 2/(V_j sum_k |xi_jk|)
//!
//! of its ends, so that the energy of a uniform strain is that of the continuum at every point, for any c and any incomplete family; the
//! forces follow from the energy, and K is symmetric.

mod matrices;
pub mod pairwise;
mod rows;

use nalgebra::Matrix3;

use super::{
    BondLaw, BondStiffness, Form, Law, LawInput, Materials, Options, PaperCorrection, Strains,
};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::ElementKind;
use crate::failure::mixed_mode;
use crate::parallel;
use matrices::{bond_stiffness, plane_stiffnesses};

/// Law of MBB-PD.
pub static LAW: BondLaw = BondLaw {
    options: Options {
        form: Some(Form::Full),
        strains: Some(Strains::Small),
        ..Options::NONE
    },
    element: |options| match (options.form, options.strains) {
        (Some(Form::Pairwise), _) => ElementKind::Pairwise,
        (Some(Form::Full | Form::Rows) | None, Some(Strains::True)) => ElementKind::TrueStrain,
        (Some(Form::Full | Form::Rows) | None, Some(Strains::Small) | None) => {
            ElementKind::Imaginary
        }
    },
    materials: Materials::Anisotropic,
    needs_lattice: true,
    couples_ends_alone: false,
    correction: PaperCorrection::None,
    criterion: &mixed_mode::MIXED_MODE,
    ..BondLaw::new(
        "mbb-pd",
        "All strains of a small rectangle around each bond of a lattice.",
        "MBB-PD eqs 12 to 19, appendix A",
        |it| match it.options.form.unwrap_or_default() {
            Form::Rows => rows::densities(it),
            Form::Full | Form::Pairwise => densities(it),
        },
        None,
    )
};

impl Law {
    /// All strains of a small rectangle around each bond of a lattice.
    pub const MBB_PD: Self = Self::usual(&LAW);
}

/// Factors psi of the points, from the families in `bonds`, shape (n_points), 1/m^4.
pub fn factors(bonds: &BondSet, cloud: &PointCloud) -> Vec<f64> {
    parallel::values(cloud.len(), 0.0, |point| {
        let family = bonds.incidence.at(point as u32).iter();
        let lengths: f64 = family.map(|&bond| bonds.length[bond as usize]).sum();
        2.0 / (cloud.volumes[point] * lengths)
    })
}

/// Micro-modulus matrices K = psi c (eq. 16) with the mean psi of the ends of each bond and the c of its materials; `axial` and `shear` have
/// those for a stretch along the bond and for S_xy.
fn densities(input: &LawInput<'_, 2>) -> BondStiffness {
    let (stiffnesses, bonds) = (plane_stiffnesses(input), input.bonds);
    let psi = factors(bonds, input.cloud);
    let of_bond = |(ends, stiffness): (&[u32; 2], Matrix3<f64>)| {
        let [a, b] = ends.map(|end| psi[end as usize]);
        (0.5 * (a + b) * stiffness, a / (a + b))
    };
    let matrices = bonds.ends.iter().zip(stiffnesses).map(of_bond);
    bond_stiffness(bonds, &matrices.collect::<Vec<_>>())
}
