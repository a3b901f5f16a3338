//! The formulation that a setup chooses: law, calibration and corrections of the bonds.

use ligament_model::bonds::BondSet;
use ligament_model::correction::{Correction, domain, length, partial_volume, patch, surface};
use ligament_model::dimension::cast_ref;
use ligament_model::failure::crack_energies::{Components, Lattice};
use ligament_model::failure::{self, Basis, Criteria, NoLimit};
use ligament_model::law::calibration;
use ligament_model::law::rotational::{self, RotationalScale};
use ligament_model::material::{Stiffness, with_reduced_contrast};
use ligament_model::{
    BondStiffness, BondSystem, ConstantFields, Elasticity, ElementKind, EnergyRatio, Horizons,
    Isotropic, PointCloud,
};

use crate::error::{Fault, Field, SetupError};
use crate::plausibility;
use crate::setup::{Alpha, Calibration, Form, Setup, Surface};

/// Law, calibration and corrections of a setup on the points of its body.
#[derive(Debug, Clone, Copy)]
pub struct Formulation<'a, const D: usize = 2> {
    /// The setup.
    pub setup: &'a Setup,
    /// Points of the body.
    pub cloud: &'a PointCloud<D>,
    horizons: &'a Horizons,
    material_of_cell: &'a [u32],
}

impl<'a, const D: usize> Formulation<'a, D> {
    /// The formulation for points with their horizons; `material_of_cell` (n_cells) has the index of each cell's material.
    pub fn new(
        setup: &'a Setup,
        cloud: &'a PointCloud<D>,
        horizons: &'a Horizons,
        material_of_cell: &'a [u32],
    ) -> Self {
        Self {
            setup,
            cloud,
            horizons,
            material_of_cell,
        }
    }

    /// Factors alpha of the bonds, shape (n_bonds).
    pub fn alpha(&self, bonds: &BondSet<D>) -> Vec<f64> {
        match self.setup.correction.alpha {
            Alpha::None => vec![1.0; bonds.len()],
            Alpha::PartialVolume => partial_volume::partial_volume_factors(bonds, self.cloud),
            Alpha::Length => length::length_factors(bonds, self.cloud),
        }
    }

    /// Stiffness densities of the bonds with factors alpha (n_bonds).
    ///
    /// # Panics
    ///
    /// Panics for a law that does not exist in the dimension of the body.
    pub fn stiffness(&self, bonds: &BondSet<D>, alpha: &[f64]) -> BondStiffness {
        let (setup, cloud) = (self.setup, self.cloud);
        let (space, law) = (setup.space(), setup.law);
        let materials = setup.materials.iter();
        let elasticity: Vec<Elasticity> = materials.map(|it| it.material.elasticity).collect();
        let stiffness = law.densities(bonds, cloud, &elasticity, space);
        let stiffness = match law.options.calibration {
            Some(Calibration::Discrete) => {
                let effective: Vec<Isotropic> = (setup.materials.iter())
                    .filter_map(|it| law.constants(&it.material, space))
                    .collect();
                calibration::calibrated(stiffness, alpha, bonds, cloud, &effective, space)
            }
            Some(Calibration::Integral) | None => stiffness,
        };
        self.with_rotational_scale(stiffness, bonds, alpha, &elasticity)
    }

    /// Stiffness densities of a law, with the rotational densities scaled as the setup demands.
    fn with_rotational_scale(
        &self,
        stiffness: BondStiffness,
        bonds: &BondSet<D>,
        alpha: &[f64],
        elasticity: &[Elasticity],
    ) -> BondStiffness {
        let (setup, cloud, plane) = (self.setup, self.cloud, self.setup.plane());
        let (profile, length) = match (setup.rotational_scale, setup.law.rotational_profile()) {
            (RotationalScale::Factor(factor), _) => return rotational::scaled(stiffness, factor),
            (_, None) => return stiffness,
            (RotationalScale::CosseratLength(length), Some(profile)) => (profile, length),
        };
        let constants = rotational::curvature_constants(elasticity, plane, length);
        let scaled = rotational::with_cosserat_length(stiffness, bonds, cloud, &constants, profile);
        if setup.law.options.calibration != Some(Calibration::Discrete) {
            return scaled;
        }
        let moduli = rotational::curvature_moduli(elasticity, plane, length);
        rotational::calibrated(scaled, alpha, bonds, cloud, &moduli)
    }

    /// The correction of bonds with stiffness densities and factors alpha (n_bonds), with materials [of less contrast](with_reduced_contrast).
    pub fn correction(
        &self,
        bonds: &BondSet<D>,
        stiffness: &BondStiffness,
        alpha: Vec<f64>,
    ) -> Correction {
        let largest = self.setup.correction.surface.largest_contrast();
        let materials = self.setup.materials();
        let Some(with_reduced_contrast) =
            with_reduced_contrast(&materials, self.setup.plane(), largest)
        else {
            return self.corrected(bonds, stiffness, alpha);
        };
        let setup = self.setup.of_materials(with_reduced_contrast);
        let between = Formulation {
            setup: &setup,
            ..*self
        };
        let stiffness = between.stiffness(bonds, &alpha);
        between.corrected(bonds, &stiffness, alpha)
    }

    /// The corrected densities with the exchanges of bonds whose ends a stiffer material restrains; without rotations there are none.
    pub fn exchanged(
        &self,
        stiffness: BondStiffness,
        bonds: &BondSet<D>,
        correction: &Correction,
    ) -> BondStiffness {
        if self.setup.law.element() != ElementKind::Beam {
            return stiffness;
        }
        let is_balanced = matches!(self.setup.correction.surface, Surface::Patch(_));
        let factors = [&correction.length_factor, &correction.domain_factor];
        let balanced = is_balanced.then_some(factors.map(Vec::as_slice));
        stiffness.exchanged(bonds, self.cloud, balanced)
    }

    /// Energies of the points in uniform strains over the energies of the continuum, for bonds with corrected stiffness.
    pub(crate) fn energy_ratios(
        &self,
        bonds: &BondSet<D>,
        stiffness: &BondStiffness,
        correction: &Correction,
    ) -> Vec<EnergyRatio> {
        let continuum = stiffness_of_materials(self.setup);
        match self.setup.correction.surface {
            Surface::Patch(_) => patch::energy_ratios(
                bonds,
                self.cloud,
                self.horizons,
                stiffness,
                correction,
                &continuum,
            ),
            _ => domain::energy_ratios(bonds, self.cloud, stiffness, correction, &continuum),
        }
    }

    /// The correction of bonds between the materials of the setup.
    fn corrected(
        &self,
        bonds: &BondSet<D>,
        stiffness: &BondStiffness,
        alpha: Vec<f64>,
    ) -> Correction {
        let (setup, cloud) = (self.setup, self.cloud);
        match setup.correction.surface {
            Surface::Domain(iteration) => {
                let sweeps = iteration.sweeps(bonds.count(cloud));
                domain::iterate(
                    bonds,
                    cloud,
                    stiffness,
                    alpha,
                    &stiffness_of_materials(setup),
                    sweeps,
                )
            }
            Surface::Patch(settings) => {
                let points = patch::Points {
                    cloud,
                    forces: setup.body.geometry().cell_forces(
                        cloud,
                        self.material_of_cell,
                        stiffness_of_materials(setup),
                    ),
                    turn: setup.law.element() == ElementKind::Beam,
                };
                let axial = || match setup.of_one_material() {
                    None => stiffness.axial.clone(),
                    Some(setup) => {
                        let of_one_material = Formulation {
                            setup: &setup,
                            ..*self
                        };
                        of_one_material.stiffness(bonds, &alpha).axial
                    }
                };
                let nearest_to = patch::reference(
                    settings.reference,
                    bonds,
                    cloud,
                    self.horizons,
                    &alpha,
                    axial,
                );
                patch::correct(bonds, &points, stiffness, (alpha, &nearest_to), &settings)
            }
            Surface::Volume => {
                let factors = surface::surface_factors(bonds, cloud, self.horizons, &alpha);
                Correction::fixed(alpha, factors)
            }
            Surface::None => Correction::fixed(alpha, vec![1.0; bonds.len()]),
        }
    }
}

/// Stiffness of each material with the effective constants of the law, shape (n_materials), Pa.
pub(crate) fn stiffness_of_materials(setup: &Setup) -> Vec<Stiffness> {
    let (law, space) = (setup.law, setup.space());
    let materials = setup.materials.iter();
    let elasticity = materials.map(|it| law.effective_elasticity(&it.material, space));
    elasticity.filter_map(|it| it.stiffness_in(space)).collect()
}

/// Failure criteria on the bonds; none in an analysis without fracture. Bonds of points marked in `fixed.no_fail` (n_points) never fail.
///
/// # Errors
///
/// If a criterion does not exist in the dimension of the body, the strengths of a material leave it without a limit, or the fracture energy
/// is too small for the energy up to the limit.
pub fn criteria<const D: usize>(
    setup: &Setup,
    system: &BondSystem<D>,
    fixed: &ConstantFields,
) -> Result<Criteria, SetupError> {
    if !setup.analysis.is_fracture() || setup.criteria.is_empty() {
        return Ok(Criteria::default());
    }
    let (materials, space) = (setup.materials_with_joints(), setup.space());
    let basis = Basis {
        system,
        no_fail: &fixed.no_fail,
        space,
        constants: (materials.iter())
            .map(|it| setup.law.split(it, space))
            .collect(),
        materials: &materials,
        joints: &setup.joints(),
        lattice: cast_ref(system).map(|system| lattice(setup, system)),
        scatter: &fixed.scatter,
    };
    failure::criteria(&setup.criteria, &basis).map_err(|(place, reason)| {
        let field = Field::element("criteria", place);
        match reason {
            NoLimit::PlaneOnly { .. } => {
                let reason = Fault::Contradiction(reason.to_string().into());
                field.part("kind").error(reason)
            }
            NoLimit::NoFriction { .. } | NoLimit::NothingLeft { .. } => {
                field.error(plausibility::without_limit(setup, reason))
            }
        }
    })
}

/// Lattice of the points of a body in the plane.
fn lattice(setup: &Setup, system: &BondSystem) -> Lattice {
    let spacing = (system.cloud.spacing.iter().copied()).fold(f64::INFINITY, f64::min);
    let spacing = -system.cloud.subdomain.max(-spacing);
    Lattice {
        spacing: system.cloud.cell_size(0),
        horizon: setup.horizon.at_spacing(spacing),
        thickness: system.cloud.thickness,
        components: match setup.law.options.form {
            Some(Form::Rows) => Components::OwnRows,
            Some(Form::Full | Form::Pairwise) | None => Components::All,
        },
    }
}
