//! Bond laws: from materials and bond horizons to the stiffness densities of the bonds.
//!
//! | law | densities | element |
//! |---|---|---|
//! | [`bbpd`] | k_n | spring |
//! | [`bbpd_conical`] | k_n that falls with the length | spring |
//! | [`pds`] | k_n, constant k_t | spring |
//! | [`mppd`] | k_n and k_t of [`pds`], and k_theta | beam |
//! | [`beam`] | k_n, k_t = 12 d/l^2 or constant, k_theta = d/l: MPPD's beam form, and NHPD's law | beam |
//! | [`orthotropic`] | k_n and k_t that depend on the direction, k_theta | beam |
//! | [`mbb_pd`] | a matrix over the strains of a small rectangle | imaginary |
//!
//! The densities come from integrals over a full circle, in space over a full ball; [`calibration`] replaces them by sums over the families.

pub mod bbpd;
pub mod bbpd_conical;
pub mod beam;
pub mod calibration;
pub(crate) mod constants;
mod densities;
mod exchange;
mod materials;
pub mod mbb_pd;
pub mod mppd;
mod options;
pub mod orthotropic;
pub mod pds;
mod restraint;
pub mod rotational;
mod row;
pub mod stability;

pub use densities::BondStiffness;
pub(crate) use densities::{CENTRAL_FORCE_TOLERANCE, Densities, bulk_stiffness};
pub use options::{Calibration, Form, Options, Strains};
pub use restraint::{Exchange, Restraint};
pub use row::{BondLaw, Law, LawInput, MakeDensities, Materials, PaperCorrection, ShearForm};

use crate::material::{Elasticity, Material, PoissonForm, Space};

/// All laws. A law is one row: its own file and its entry here.
pub const LAWS: [&BondLaw; 8] = [
    &beam::NHPD,
    &bbpd::LAW,
    &bbpd_conical::LAW,
    &pds::LAW,
    &mppd::LAW,
    &beam::MPPD_BEAM,
    &orthotropic::LAW,
    &mbb_pd::LAW,
];

#[cfg(feature = "case")]
crate::worded_by_table! { Law: Law::ALL, Law::ALL.into_iter(), it => [it.row.word, it.row.sentence] }

impl Law {
    /// All laws, each with the usual options.
    pub const ALL: [Self; LAWS.len()] = {
        let mut all = [Self::usual(LAWS[0]); LAWS.len()];
        let mut place = 1;
        while place < all.len() {
            all[place] = Self::usual(LAWS[place]);
            place += 1;
        }
        all
    };
}

impl Law {
    /// The elasticity that the bonds of a material make up, and the modulus kappa of its cells against changes of volume, Pa; `None` for an
    /// orthotropic material whose volumetric stiffness cells cannot carry.
    pub fn split_elasticity(&self, material: &Material, space: Space) -> Option<(Elasticity, f64)> {
        let by_cells = self.options.poisson == Some(PoissonForm::Cells);
        match (self.split(material, space), material.elasticity) {
            (Some(split), _) if split.is_split() => Some((split.bonds.into(), split.modulus)),
            (None, Elasticity::Orthotropic(it)) if by_cells => {
                let (of_bonds, modulus) = orthotropic::split(&it, space.plane())?;
                Some((Elasticity::Orthotropic(of_bonds), modulus))
            }
            (_, elasticity) => Some((elasticity, 0.0)),
        }
    }
}

/// Laws that satisfy a condition.
pub fn laws_with(suits: impl Fn(&BondLaw) -> bool) -> Vec<&'static BondLaw> {
    LAWS.into_iter().filter(|it| suits(it)).collect()
}

/// Names of laws, in the form `a, b or c`.
pub fn listed(laws: &[&BondLaw], name: impl Fn(&BondLaw) -> String) -> String {
    let names: Vec<String> = laws.iter().map(|it| name(it)).collect();
    match names.as_slice() {
        [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        alone => alone.concat(),
    }
}

#[cfg(test)]
mod ball_tests;
