//! The formulation that a setup chooses in space: law, calibration and corrections of the bonds.

use ligament_model::bonds::BondSet;
use ligament_model::correction::patch::{self, CellForces};
use ligament_model::correction::{
    Correction, domain, energy_ratios, length, partial_volume, surface,
};
use ligament_model::failure::Criteria;
use ligament_model::law::rotational::{self, RotationalScale};
use ligament_model::material::{Stiffness, milder};
use ligament_model::space::criteria::{self, NoSolidLimit, SolidBasis};
use ligament_model::space::law::{ShearForm, bbpd, calibration, mppd, nhpd, pds};
use ligament_model::{
    BondStiffness, BondSystem, Elasticity, ElementKind, EnergyRatio, FixedFields, Horizons,
    Isotropic, Plane, PointCloud,
};

use crate::body::Origin;
use crate::error::{Fault, Field, SetupError};
use crate::plausibility;
use crate::setup::{Alpha, Calibration, CorrectionDomain, Law, Setup, Surface};

/// Law, calibration and corrections of a setup on the points of its body in space.
#[derive(Debug, Clone)]
pub(super) struct SolidFormulation<'a> {
    setup: &'a Setup<3>,
    cloud: &'a PointCloud<3>,
    horizons: &'a Horizons,
    material_of_cell: &'a [u32],
    /// Elastic constants that the law makes of those of each material, shape (n_materials).
    constants: Vec<Isotropic>,
}

/// Form of the shear stiffness of a law whose points turn; none of others.
pub(super) fn shear_form(law: &Law) -> Option<ShearForm> {
    match law {
        Law::MppdBeam { .. } => Some(ShearForm::Falling),
        Law::Nhpd | Law::Mppd { .. } => Some(ShearForm::Constant),
        _ => None,
    }
}

/// Elastic constants that the law makes of those of each material, shape (n_materials).
pub(super) fn constants(setup: &Setup<3>) -> Vec<Isotropic> {
    let given = setup.materials.iter();
    let given = given.filter_map(|it| it.material.elasticity.isotropic());
    given
        .map(|it| match setup.law.fixes_poisson() {
            true => bbpd::central(&it),
            false => it,
        })
        .collect()
}

impl<'a> SolidFormulation<'a> {
    pub(super) fn new(
        setup: &'a Setup<3>,
        cloud: &'a PointCloud<3>,
        horizons: &'a Horizons,
        material_of_cell: &'a [u32],
    ) -> Self {
        Self {
            setup,
            cloud,
            horizons,
            material_of_cell,
            constants: constants(setup),
        }
    }

    /// Whether pre-cracks cut bonds before these are corrected.
    pub(super) fn cuts_first(&self) -> bool {
        self.setup.correction.domain == CorrectionDomain::Cracked
    }

    /// Factors alpha of the bonds, shape (n_bonds).
    pub(super) fn alpha(&self, bonds: &BondSet<3>) -> Vec<f64> {
        match self.setup.correction.alpha {
            Alpha::None => vec![1.0; bonds.len()],
            Alpha::PartialVolume => partial_volume::partial_volume_factors(bonds, self.cloud),
            Alpha::Length => length::length_factors(bonds, self.cloud),
        }
    }

    /// Stiffness densities of the bonds with factors alpha (n_bonds).
    pub(super) fn stiffness(&self, bonds: &BondSet<3>, alpha: &[f64]) -> BondStiffness {
        let (cloud, materials) = (self.cloud, &self.constants);
        let stiffness = match self.setup.law {
            Law::Bbpd { .. } => bbpd::stiffness(bonds, cloud, materials),
            Law::Pds { .. } => pds::stiffness(bonds, cloud, materials),
            Law::Mppd {
                rotational_stiffness,
                ..
            } => mppd::stiffness(bonds, cloud, materials, rotational_stiffness),
            Law::MppdBeam { .. } => nhpd::stiffness(bonds, cloud, materials, ShearForm::Falling),
            _ => nhpd::stiffness(bonds, cloud, materials, ShearForm::Constant),
        };
        let stiffness = match self.setup.law.calibration() {
            Some(Calibration::Discrete) => {
                calibration::calibrated(stiffness, alpha, bonds, cloud, materials)
            }
            Some(Calibration::Integral) | None => stiffness,
        };
        match self.setup.rotational_scale {
            RotationalScale::Factor(factor) => rotational::scaled(stiffness, factor),
            RotationalScale::CosseratLength(_) => stiffness,
        }
    }

    /// The correction of bonds with stiffness densities and factors alpha (n_bonds), found between [milder] materials.
    pub(super) fn correction(
        &self,
        bonds: &BondSet<3>,
        stiffness: &BondStiffness,
        alpha: Vec<f64>,
    ) -> Correction {
        let largest = self.setup.correction.surface.largest_contrast();
        let materials = self.setup.materials();
        let Some(milder) = milder(&materials, Plane::Strain, largest) else {
            return self.corrected(bonds, stiffness, alpha);
        };
        let setup = self.setup.of_materials(milder);
        let between = SolidFormulation {
            setup: &setup,
            constants: constants(&setup),
            ..*self
        };
        let stiffness = between.stiffness(bonds, &alpha);
        between.corrected(bonds, &stiffness, alpha)
    }

    /// The correction of bonds between the materials of the setup.
    fn corrected(
        &self,
        bonds: &BondSet<3>,
        stiffness: &BondStiffness,
        alpha: Vec<f64>,
    ) -> Correction {
        match self.setup.correction.surface {
            Surface::Domain(iteration) => {
                let sweeps = iteration.sweeps(bonds.count(self.cloud));
                let continuum = of_constants(&self.constants);
                domain::iterate(bonds, self.cloud, stiffness, alpha, &continuum, sweeps)
            }
            Surface::Volume => {
                let factors = surface::surface_factors(bonds, self.cloud, self.horizons, &alpha);
                Correction::fixed(alpha, factors)
            }
            Surface::Patch(settings) => {
                let points = patch::Points {
                    cloud: self.cloud,
                    forces: cell_forces(self.setup, self.cloud, self.material_of_cell),
                    turn: self.setup.law.element() == ElementKind::Beam,
                };
                let axial = || match self.setup.of_one_material() {
                    None => stiffness.axial.clone(),
                    Some(setup) => {
                        let of_one_material = SolidFormulation {
                            setup: &setup,
                            constants: constants(&setup),
                            ..*self
                        };
                        of_one_material.stiffness(bonds, &alpha).axial
                    }
                };
                let reference = settings.reference;
                let nearest_to = patch::reference(reference, bonds, self.cloud, &alpha, axial);
                patch::correct(bonds, &points, stiffness, (alpha, &nearest_to), &settings)
            }
            Surface::None => Correction::fixed(alpha, vec![1.0; bonds.len()]),
        }
    }

    /// Energies of the points in uniform strains over the continuum's, of bonds with a stiffness in which the correction has its part.
    pub(super) fn energy_ratios(
        &self,
        bonds: &BondSet<3>,
        stiffness: &BondStiffness,
        correction: &Correction,
    ) -> Vec<EnergyRatio> {
        let continuum = of_constants(&self.constants);
        energy_ratios(bonds, self.cloud, stiffness, correction, &continuum)
    }
}

/// Stiffness of each material (n_materials) from its constants, Pa.
fn of_constants(constants: &[Isotropic]) -> Vec<Stiffness> {
    let elasticity = constants.iter().copied().map(Elasticity::Isotropic);
    (elasticity.filter_map(|it| it.stiffness::<3>(Plane::Strain))).collect()
}

/// Stiffness of each material with the constants that the law makes of its own (n_materials), Pa.
pub(super) fn stiffness(setup: &Setup<3>) -> Vec<Stiffness> {
    of_constants(&constants(setup))
}

/// Forces of uniform strains on the points of a cloud, as the cells of the body know them, with the constants that the law makes of
/// those of each cell's material (n_cells).
pub(super) fn cell_forces(
    setup: &Setup<3>,
    cloud: &PointCloud<3>,
    material_of_cell: &[u32],
) -> CellForces<3> {
    let stiffness = stiffness(setup);
    match setup.body.origin() {
        Origin::SolidLattice(lattice) => {
            patch::of_lattice(lattice, cloud, material_of_cell, &stiffness)
        }
        Origin::SolidMesh(mesh) => {
            patch::of_solid_mesh(&mesh.cells, cloud, material_of_cell, stiffness)
        }
        _ => patch::of_solid_mesh(&[], cloud, material_of_cell, stiffness),
    }
}

/// Failure criteria on the bonds; none in an analysis without fracture. Bonds of points marked in `fixed.no_fail` (n_points) never fail.
///
/// # Errors
///
/// If a criterion exists in the plane alone, the strengths of a material leave it without a limit, or the fracture energy leaves nothing
/// after the limit.
pub(super) fn criteria(
    setup: &Setup<3>,
    system: &BondSystem<3>,
    fixed: &FixedFields,
) -> Result<Criteria, SetupError> {
    if !setup.analysis.is_fracture() {
        return Ok(Criteria::default());
    }
    let basis = SolidBasis {
        system,
        no_fail: &fixed.no_fail,
        materials: &setup.materials(),
        constants: constants(setup),
        scatter: fixed.scatter.as_ref(),
    };
    criteria::criteria(&setup.criteria, &basis).map_err(|(place, reason)| {
        let field = Field::element("criteria", place);
        match reason {
            NoSolidLimit::NoLimit(no_limit) => {
                field.error(plausibility::without_limit(setup, no_limit))
            }
            NoSolidLimit::PlaneOnly(reason) => field
                .part("kind")
                .error(Fault::Contradiction(reason.to_string().into())),
        }
    })
}
