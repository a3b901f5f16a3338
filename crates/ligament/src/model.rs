//! The method, first page: from a mesh or a lattice to the discrete model. The second is [`crate::run`].

use std::sync::Arc;

use ligament_analysis::Message;
use ligament_analysis::probe::Notch;
use ligament_model::bonds::precrack::{Crack, cut_bonds};
use ligament_model::contact::Faces;
use ligament_model::correction::{Correction, CorrectionReport};
use ligament_model::failure::Criteria;
use ligament_model::scatter;
use ligament_model::{
    BondSet, BondStiffness, BondSystem, ConstantFields, EnergyRatio, PointCloud, System,
};

use crate::absent::{inside_body, with_cut};
use crate::body::{AnyBody, Body, Geometry};
use crate::coordinates::in_dimensions;
use crate::counts::{self, BondCounts};
use crate::described::Described;
use crate::division::divided;
use crate::error::SetupError;
use crate::faces;
use crate::formulation::{self, Formulation};
use crate::joints;
use crate::loading;
use crate::local::{Bounds, Discrete, bounds, points};
use crate::near_field::NearField;
use crate::notches::notches;
use crate::plausibility;
use crate::precracks::{self, Precracked};
use crate::processes::partition_communicator;
use crate::refined_body::RefinedBody;
use crate::setup::{CorrectionDomain, Position, Refine, Setup};
use crate::soundness::{require_connected, require_factors, require_finite_rigidities};
use crate::stage::{Finding, StageWatcher, stage};
use crate::system::{AnySystem, over_dimension};
use crate::warning;

/// The discrete model: everything before the equations.
#[derive(Debug)]
pub struct Model {
    /// Setup from which the model was built; each of several processes has its part of the body.
    pub setup: Setup,
    /// The points of the whole body, for their descriptions.
    pub names: Arc<dyn Body>,
    /// Points and corrected bonds.
    pub system: AnySystem,
    /// Fields that an analysis does not change.
    pub fixed: ConstantFields,
    /// Report on the iteration of the correction; none where nothing was iterated.
    pub correction: Option<CorrectionReport>,
    /// Smallest and largest factor Omega of the bonds.
    pub correction_range: (f64, f64),
    /// Numbers of bonds.
    pub counts: BondCounts,
    /// Notches, slots and pre-cracks of a body that is not shared out.
    pub notches: Arc<[Notch]>,
    /// Failure criteria of the bonds.
    pub criteria: Arc<Criteria>,
    /// Warnings for the user.
    pub warnings: Vec<Message>,
    /// The body before all refinement, and its refined mesh; none where nothing is refined.
    pub refined: Option<RefinedBody>,
}

impl Model {
    /// Builds the model of a setup on the caller's threads; where its solver has several processes, the bonds are divided between them,
    /// and of a meshed body the cells of rank 0 count.
    ///
    /// # Errors
    ///
    /// If a field of the setup is wrong.
    pub fn build(setup: Setup, watcher: &mut dyn StageWatcher) -> Result<Self, SetupError> {
        match &setup.body {
            AnyBody::Plane(_) => Self::of_body::<2>(setup, watcher),
            AnyBody::Solid(_) => Self::of_body::<3>(setup, watcher),
        }
    }

    /// Builds the model of a setup on its body in D dimensions.
    fn of_body<const D: usize>(
        setup: Setup,
        watcher: &mut dyn StageWatcher,
    ) -> Result<Self, SetupError> {
        setup.check()?;
        let setup = precracks::with_lines_of_groups(setup)?;
        if let Some(refine) = &setup.refine {
            return Self::of_pass::<D>(refine.clone(), setup, watcher);
        }
        Self::of_checked::<D>(setup, watcher)
    }

    /// Builds the model of the present pass of a refinement.
    fn of_pass<const D: usize>(
        refine: Refine,
        setup: Setup,
        watcher: &mut dyn StageWatcher,
    ) -> Result<Self, SetupError> {
        let refined = stage(watcher, "refinement", || RefinedBody::new(&setup, &refine))?;
        let body = refined.body().unwrap_or_else(|| setup.body.clone());
        let model = Self::of_checked::<D>(Setup { body, ..setup }, watcher)?;
        Ok(Self {
            warnings: [
                warning::of_refinement(&model.setup, &model.fixed.horizon, &refine, &refined),
                model.warnings,
            ]
            .concat(),
            refined: Some(refined),
            ..model
        })
    }

    /// Builds the model of a checked setup on its body in D dimensions.
    fn of_checked<const D: usize>(
        setup: Setup,
        watcher: &mut dyn StageWatcher,
    ) -> Result<Self, SetupError> {
        let communicator = partition_communicator(&setup);
        if communicator.size() > 1 {
            let divided = || divided(setup, &communicator);
            let discrete: Discrete<D> = stage(watcher, "points", divided)?;
            let body = discrete.setup.body.geometry::<D>().clone();
            let outline = bounds(&discrete.setup, &*body, &discrete.cloud);
            return Self::of_points(discrete, outline, watcher);
        }
        let material_of_cell = loading::material_of_cell(&setup)?;
        let body = setup.body.geometry::<D>().clone();
        let (cloud, outline) = stage(watcher, "points", || {
            points(&setup, &*body, &material_of_cell)
        })?;
        let discrete = Discrete {
            no_fail: loading::no_fail(&setup, &cloud)?,
            names: setup.body.as_body(),
            setup,
            cloud: body.completed(cloud, &material_of_cell),
            material_of_cell,
        };
        Self::of_points(discrete, outline, watcher)
    }

    /// Builds the model on the points of this process, with the outline of their mesh.
    fn of_points<const D: usize>(
        discrete: Discrete<D>,
        outline: Bounds<'_, D>,
        watcher: &mut dyn StageWatcher,
    ) -> Result<Self, SetupError> {
        let Discrete {
            setup,
            names,
            cloud,
            material_of_cell,
            no_fail,
        } = discrete;
        let body = setup.body.geometry::<D>().clone();
        let described = Described {
            setup: &setup,
            names: &*names,
        };
        let near = match setup.far_field {
            Some(_) => NearField::new(&setup, &*body, cloud.clone(), &material_of_cell)?,
            None => None,
        };
        let Bonded {
            system,
            mut fixed,
            correction,
            crossed,
        } = match near {
            None => bonded(
                described,
                &*body,
                (cloud, outline),
                &material_of_cell,
                watcher,
            )?,
            Some(near) => Bonded::of_near_field(near, &*body, &material_of_cell, watcher)?,
        };
        (fixed.no_fail, fixed.interfaces) = (no_fail, setup.crossed_interfaces(&system));
        fixed.material_of_cell = numbers_of_materials(&setup, &material_of_cell);
        fixed.scatter = scatter::factors(&setup.scatter, &body.positions(), &body.numbering());
        let limits = || formulation::criteria(&setup, &system, &fixed);
        let criteria = Arc::new(stage(watcher, "criteria", limits)?);
        let report = correction.report.as_ref();
        Ok(Self {
            warnings: warnings(described, &system.cloud, report, &fixed, &criteria, crossed)
                .into_iter()
                .chain(warning::without_edges(&system))
                .chain(joints::of_interfaces(&fixed, &system.cloud.subdomain))
                .collect(),
            correction_range: counts::correction_range(&correction, &system.cloud),
            counts: BondCounts::new(&system, &fixed.absent),
            notches: notches(&system.cloud, &fixed.absent),
            correction: correction.report,
            names,
            setup,
            system: AnySystem::new(system.with_elements()),
            fixed,
            criteria,
            refined: None,
        })
    }

    /// Number of pairs of points that are not bonded because a void of the body separates them.
    pub fn across_voids(&self) -> usize {
        self.counts.across_voids
    }

    /// Number of bonds that pre-cracks cut.
    pub fn cut_bonds(&self) -> usize {
        self.counts.cut
    }

    /// Number of points whose bonds never break.
    pub fn no_fail_points(&self) -> usize {
        self.fixed.no_fail.iter().filter(|marked| **marked).count()
    }

    /// The body.
    pub fn body(&self) -> &dyn Body {
        &*self.setup.body
    }

    /// Position halfway between two points, given by their numbers in the body, m.
    pub fn middle(&self, ends: [u32; 2]) -> Vec<f64> {
        over_dimension!(&self.system, system => {
            let cloud = &system.cloud;
            let relative = |number: u32| match cloud.subdomain.point(number) {
                Some(point) => cloud.positions[point as usize],
                None => cloud.local(in_dimensions(&self.names.position(number))),
            };
            let [a, b] = ends.map(relative);
            let along = a.iter().zip(b).zip(cloud.origin);
            along.map(|((a, b), origin)| 0.5 * (a + b) + origin).collect()
        })
    }

    /// Whether some bond has a positive shear stiffness.
    pub fn has_shear(&self) -> bool {
        over_dimension!(&self.system, system => system.rigidities.shear.iter().any(|it| *it > 0.0))
    }

    /// Volume of a material on this process, by its index, m^3.
    pub fn volume_of_material(&self, index: usize) -> f64 {
        over_dimension!(&self.system, system => {
            let cloud = &system.cloud;
            let parts = (0..cloud.len()).map(|it| cloud.shares(it)[index] * cloud.volumes[it]);
            parts.sum()
        })
    }

    /// Distance of a point from a position, m; zero within rounding errors.
    pub fn distance_to(&self, point: u32, position: Position) -> f64 {
        let slack = over_dimension!(&self.system, system => system.cloud.slack(point));
        let place = self.body().position(point).into_iter();
        let squares = place.zip(position).map(|(p, q)| (p - q).powi(2));
        let distance = squares.sum::<f64>().sqrt();
        if distance <= slack { 0.0 } else { distance }
    }

    /// The points and bonds of a model in the plane.
    ///
    /// # Panics
    ///
    /// Panics for a solid.
    pub fn plane(&self) -> &Arc<dyn System<2>> {
        let system = self.system.of_dimension();
        system.expect("the body is in the plane")
    }

    /// The points and bonds of a solid.
    ///
    /// # Panics
    ///
    /// Panics for a body in the plane.
    pub fn solid(&self) -> &Arc<dyn System<3>> {
        let system = self.system.of_dimension();
        system.expect("the body is a solid")
    }
}

/// Bonds of a body with their rigidities, before criteria.
struct Bonded<const D: usize> {
    system: BondSystem<D>,
    /// Fields of the preparation except for fields that name parts of the body.
    fixed: ConstantFields,
    correction: Correction,
    crossed: Precracked,
}

impl<const D: usize> Bonded<D> {
    /// The bonds of a near field, with the elements of the far field.
    fn of_near_field(
        near: NearField<D>,
        body: &dyn Geometry<D>,
        material_of_cell: &[u32],
        watcher: &mut dyn StageWatcher,
    ) -> Result<Self, SetupError> {
        let part = near.body();
        let points = points(&near.setup, &*part, &near.material_of_cell)?;
        let described = Described {
            setup: &near.setup,
            names: &*part,
        };
        let bonded = bonded(described, &*part, points, &near.material_of_cell, watcher)?;
        Ok(bonded.in_whole_body(near, body, material_of_cell))
    }

    /// The bonds of a near field in the whole body, with the elements of the far field.
    fn in_whole_body(
        self,
        near: NearField<D>,
        body: &dyn Geometry<D>,
        material_of_cell: &[u32],
    ) -> Self {
        Self {
            fixed: near.fields(self.fixed),
            system: near.in_whole_body(body, self.system, material_of_cell),
            ..self
        }
    }
}

/// Finds and corrects the bonds between the points of a body.
fn bonded<const D: usize>(
    described: Described<'_>,
    body: &dyn Geometry<D>,
    (cloud, outline): (PointCloud<D>, Bounds<'_, D>),
    material_of_cell: &[u32],
    watcher: &mut dyn StageWatcher,
) -> Result<Bonded<D>, SetupError> {
    let setup = described.setup;
    let of_bonds = setup.of_bonds();
    let of_bonds = of_bonds.as_ref().unwrap_or(setup);
    let horizons = setup.horizon.of_points(&cloud);
    let (bonds, absent) = stage(watcher, "bonds", || {
        let all = BondSet::search(&cloud, &horizons);
        let (bonds, absent) = inside_body(body, all, &cloud, outline.as_deref());
        (composed(body, bonds, &cloud, material_of_cell), absent)
    });
    require_connected(described, &cloud, &horizons, &bonds)?;
    watcher.found(&counts::finding(&cloud, &bonds, &absent));
    let cracks = precracks::cracks(body, &setup.precracks)?;
    let mut crossed = stage(watcher, "pre-cracks", || {
        Precracked::new(&cracks, &bonds, &cloud, &body.rim())
    });
    let absent = with_cut(absent, &bonds, &crossed.is_cut);
    let Corrected {
        bonds,
        stiffness,
        correction,
        energy_ratios,
        faces,
    } = stage(watcher, "correction", || {
        let formulation = Formulation::new(of_bonds, &cloud, &horizons, material_of_cell);
        correct(&formulation, bonds, &cracks, &crossed.is_cut)
    });
    watcher.found(&Finding::Correction(
        &setup.correction,
        correction.report.as_ref(),
    ));
    let fixed = ConstantFields {
        horizon: horizons.radius,
        precrack_share: std::mem::take(&mut crossed.share),
        energy_ratios,
        absent,
        ..of_correction(&correction)
    };
    let system = stage(watcher, "rigidities", || {
        let described = Described {
            setup: of_bonds,
            ..described
        };
        bond_system(described, cloud, bonds, stiffness, &correction, faces)
    })?;
    let system = with_volumetric(system, setup, body, material_of_cell, &cracks);
    Ok(Bonded {
        system,
        fixed,
        correction,
        crossed,
    })
}

/// Points and corrected bonds with the rigidities of their elements.
fn bond_system<const D: usize>(
    Described { setup, names }: Described<'_>,
    cloud: PointCloud<D>,
    bonds: BondSet<D>,
    stiffness: BondStiffness,
    correction: &Correction,
    faces: Faces<D>,
) -> Result<BondSystem<D>, SetupError> {
    let element = setup.law.element();
    let (alpha, omega) = (&correction.length_factor, &correction.domain_factor);
    let factors = (omega.as_slice(), stiffness.axial.as_slice());
    require_factors(names, &cloud, factors, &bonds.ends)?;
    let system = BondSystem::new(cloud, bonds, element, stiffness, alpha.clone(), omega);
    require_finite_rigidities(names, &system)?;
    let materials = formulation::stiffness_of_materials(setup);
    let system = system.with_faces(faces).with_materials(materials);
    Ok(system.with_stress_across_plane(setup.stress_across_plane()))
}

/// The system with the stiffness of the cells against changes of volume, where bonds do not make up the whole materials.
fn with_volumetric<const D: usize>(
    system: BondSystem<D>,
    setup: &Setup,
    body: &dyn Geometry<D>,
    material_of_cell: &[u32],
    cracks: &[Crack],
) -> BondSystem<D> {
    let Some(moduli) = setup.moduli_of_cells() else {
        return system;
    };
    let cells = body.volumetric_cells(&system.cloud, material_of_cell, &moduli);
    let counts: Vec<bool> = moduli.iter().map(|it| *it > 0.0).collect();
    let has_no_bond = |edge: &[u32; 2]| system.bonds.ends.binary_search(edge).is_err();
    let mut without_bond = cells.distinct_edges(&counts);
    without_bond.retain(has_no_bond);
    let is_cut = cut_bonds(cracks, &without_bond, &system.cloud);
    let is_cut = |edge: [u32; 2]| {
        let place = without_bond.binary_search(&edge);
        place.is_ok_and(|place| is_cut[place])
    };
    system.with_volumetric(&cells, &moduli, is_cut)
}

/// The bonds, in a body of several materials with their composition from the cells that they cross.
fn composed<const D: usize>(
    body: &dyn Geometry<D>,
    bonds: BondSet<D>,
    cloud: &PointCloud<D>,
    materials: &[u32],
) -> BondSet<D> {
    match cloud.n_materials {
        1 => bonds,
        _ => body.composed(bonds, cloud, materials),
    }
}

/// Bonds that pre-cracks do not cut, with their stiffness and correction.
struct Corrected<const D: usize> {
    bonds: BondSet<D>,
    stiffness: BondStiffness,
    correction: Correction,
    energy_ratios: Vec<EnergyRatio>,
    faces: Faces<D>,
}

/// Computes stiffness and correction of the bonds before the pre-cracks' bonds are removed, or after, as the setup demands.
fn correct<const D: usize>(
    formulation: &Formulation<'_, D>,
    bonds: BondSet<D>,
    cracks: &[Crack],
    is_cut: &[bool],
) -> Corrected<D> {
    let Formulation { setup, cloud, .. } = *formulation;
    let survives: Vec<bool> = is_cut.iter().map(|cut| !cut).collect();
    let any_is_cut = is_cut.contains(&true);
    let cut_first = setup.correction.domain == CorrectionDomain::Cracked;
    let numbered = bonds.ends.iter().zip(is_cut);
    let cut: Vec<[u32; 2]> = (numbered.filter(|(_, is_cut)| **is_cut))
        .map(|(ends, _)| *ends)
        .collect();
    let corrected = of_bonds(
        formulation,
        if cut_first && any_is_cut {
            bonds.retained(&survives)
        } else {
            bonds
        },
    );
    if cut_first || !any_is_cut {
        let faces = faces::faces((setup.closing, cracks), cloud, &corrected.bonds, &cut, None);
        return Corrected { faces, ..corrected };
    }
    let rigidities = setup.closing.then(|| {
        let (bonds, stiffness) = (&corrected.bonds, &corrected.stiffness);
        faces::rigidities(formulation, bonds, stiffness, &corrected.correction, is_cut)
    });
    let bonds = corrected.bonds.retained(&survives);
    Corrected {
        faces: faces::faces(
            (setup.closing, cracks),
            cloud,
            &bonds,
            &cut,
            rigidities.as_ref(),
        ),
        bonds,
        stiffness: corrected.stiffness.retained(&survives),
        correction: corrected.correction.retained(&survives),
        energy_ratios: corrected.energy_ratios,
    }
}

/// Stiffness and correction of some bonds, without faces.
fn of_bonds<const D: usize>(formulation: &Formulation<'_, D>, bonds: BondSet<D>) -> Corrected<D> {
    let alpha = formulation.alpha(&bonds);
    let stiffness = formulation.stiffness(&bonds, &alpha);
    let correction = formulation.correction(&bonds, &stiffness, alpha);
    let stiffness = stiffness.with_shear(&correction.shear_ratio);
    let energy_ratios = formulation.energy_ratios(&bonds, &stiffness, &correction);
    Corrected {
        energy_ratios,
        stiffness: formulation.exchanged(stiffness, &bonds, &correction),
        bonds,
        correction,
        faces: Faces::default(),
    }
}

/// Numbers from 1 of the materials of the cells (n_cells) of a body with several; none for a body of one.
fn numbers_of_materials(setup: &Setup, material_of_cell: &[u32]) -> Vec<i64> {
    match setup.materials.len() {
        0 | 1 => Vec::new(),
        _ => material_of_cell
            .iter()
            .map(|it| i64::from(*it) + 1)
            .collect(),
    }
}

/// Fixed fields of a correction; the other fields are empty.
fn of_correction(correction: &Correction) -> ConstantFields {
    ConstantFields {
        horizon: Vec::new(),
        precrack_share: Vec::new(),
        energy_ratios: Vec::new(),
        domain_factor: correction.domain_factor.clone(),
        shear_ratio: correction.shear_ratio.clone(),
        patch_residual: correction.patch_residual().to_vec(),
        interfaces: Vec::new(),
        material_of_cell: Vec::new(),
        no_fail: Vec::new(),
        scatter: Vec::new(),
        absent: Vec::new(),
    }
}

/// Warnings about a model; `crossed` has the pre-cracks that cut no bond and the number of bonds that only touch one.
fn warnings<const D: usize>(
    described: Described<'_>,
    cloud: &PointCloud<D>,
    report: Option<&CorrectionReport>,
    fixed: &ConstantFields,
    criteria: &Criteria,
    crossed: Precracked,
) -> Vec<Message> {
    let implausible = plausibility::of_model(described, cloud, criteria, crossed.idle);
    let points = (&cloud.subdomain, &*cloud.spacing);
    let of_model = warning::of_model(described, points, report, fixed, crossed.touched);
    (implausible.into_iter().chain(of_model))
        .chain(warning::of_criteria(criteria))
        .collect()
}
