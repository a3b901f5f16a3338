//! The setup: the complete input of a computation, as typed values.

mod analysis;
pub(crate) mod check;
mod check_dimension;
mod check_loading;
mod conditions;
mod contact;
mod correction;
mod curve;
mod interface;
mod not_together;
mod precrack;
mod probe;
mod refine;
mod restraint;
mod section;
pub mod setting;
pub mod stage;

use ligament_analysis::{Message, SolverSettings};
use ligament_model::case_type::Range;
use ligament_model::failure::Choice;
use ligament_model::law::rotational::RotationalScale;
use ligament_model::material::Space;
use ligament_model::{
    Elasticity, Horizons, Isotropic, Material, Plane, PointCloud, Scatter, StressAcrossPlane,
};

use crate::body::AnyBody;

pub use analysis::{Analysis, ELASTIC_ENERGY_TOLERANCE, event, stepped};
pub use conditions::{
    Action, Axis, Couple, Displacement, FarField, InitialVelocity, Load, Place, Position, Profile,
    QuietEdge, Sample, SpringStiffness, Support, Temperature, TemperatureChange, begins_as_formula,
    is_column_name, is_unseen,
};
pub use contact::{ContactLaw, Rigid, RigidForm, SurfaceContact};
pub use correction::{Alpha, Correction, CorrectionDomain, Iteration, Surface};
pub(crate) use curve::CurveAxis;
pub use interface::Interface;
pub use ligament_model::law::{Calibration, Form, Law, Options, Strains};
pub use ligament_model::material::PoissonForm;
pub use not_together::{Exclusion, Feature, NOT_TOGETHER};
pub use precrack::{CrackShape, PreCrack};
pub use probe::{Probe, Reading, Tip};
pub use refine::{FinePlace, Fineness, Indicator, Refine};
pub use section::Section;
pub use stage::{Control, Course, Quantity, Stage};

/// Description of a computation in the plane or in space: body, section, materials, law, corrections, supports, loads and the
/// analysis.
///
/// All values are in SI units. Positions are in the coordinates of the body. [`Setup::new`] sets defaults; every field can be changed
/// afterwards.
#[derive(Debug, Clone)]
pub struct Setup {
    /// Points with their groups: from a mesh, a lattice or arrays.
    pub body: AnyBody,
    /// Section of the body.
    pub section: Section,
    /// Materials: one without a group for the whole body, or one for each of several groups.
    pub materials: Vec<MaterialRegion>,
    /// Interfaces between two materials with strengths of their own.
    pub interfaces: Vec<Interface>,
    /// Bond law.
    pub law: Law,
    /// Size of the rotational stiffness, for laws with rotations of points.
    pub rotational_scale: RotationalScale,
    /// Horizon of the points.
    pub horizon: Horizon,
    /// Whether bonds cross holes, slots and notches of a meshed body; bonds of a lattice never do.
    pub bonds_through_voids: bool,
    /// Corrections of the bonds.
    pub correction: Correction,
    /// Initial cracks.
    pub precracks: Vec<PreCrack>,
    /// Whether the faces of pre-cracks and of broken bonds carry pressure where they close; for laws with rotations of points.
    pub closing: bool,
    /// Coefficient of friction on faces that close, in an explicit motion.
    pub closing_friction: f64,
    /// Contacts between parts of the body in a motion.
    pub contacts: Vec<SurfaceContact>,
    /// Rigid bodies that parts of the body meet in a motion.
    pub rigid_bodies: Vec<Rigid>,
    /// Linear finite elements in place of bonds, away from parts of a meshed body.
    pub far_field: Option<FarField>,
    /// Runs one after the other on meshes that are finer where bonds broke.
    pub refine: Option<Refine>,
    /// Parts of the body where bonds never fail.
    pub no_fail: Vec<Place>,
    /// Supports of the body, none or more.
    pub supports: Vec<Support>,
    /// Loads at load factor 1.
    pub loads: Vec<Load>,
    /// Name of the load of the force-displacement curve, or of the rigid body that moves; by default the first load, otherwise the temperature,
    /// otherwise the first rigid body that moves.
    pub curve: Option<String>,
    /// Successive stages, in which each load has a factor of its own; without stages all loads grow with one load factor.
    pub stages: Vec<Stage>,
    /// Changes of temperature at load factor 1; where several apply, the last counts.
    pub temperatures: Vec<Temperature>,
    /// Velocities of parts of the body at time zero of a motion; where several apply, the last counts.
    pub initial_velocities: Vec<InitialVelocity>,
    /// Parts of the outline through which waves leave the body in a motion.
    pub quiet: Vec<QuietEdge>,
    /// Failure criteria of the bonds in an analysis of fracture or, if any, in a motion; the first criterion that is met applies.
    pub criteria: Vec<Choice>,
    /// Properties of the materials that vary at random over the body, each another one, in an analysis of fracture.
    pub scatter: Vec<Scatter>,
    /// Quantities that the history records beside displacement and load.
    pub probes: Vec<Probe>,
    /// Kind of analysis.
    pub analysis: Analysis,
    /// Solver of the equations; a run without files does not look at its `memory`.
    pub solver: SolverSettings,
    /// Remarks on the input of the other fields, which become warnings of the model.
    pub remarks: Vec<Message>,
}

/// A material and the part of the body that it fills.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialRegion {
    /// Group of the body; without it the material fills the whole body.
    pub group: Option<String>,
    /// Elastic constants, strengths, density and expansion.
    pub material: Material,
}

/// Horizon of the points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Horizon {
    /// The distance of each point to its nearest neighbour times this factor; 3 is usual.
    Factor(f64),
    /// One length for all points, m.
    Length(f64),
}

impl Setup {
    /// Range of the friction on faces that close.
    pub const CLOSING_FRICTION: Range<'static> = Range::NOT_NEGATIVE;

    /// The elastic analysis of a body of one material, with horizon factor 3 and the correction of the law's paper, without supports and
    /// loads. A body in the plane is in plane stress and 1 m thick.
    pub fn new(body: impl Into<AnyBody>, material: Material, law: Law) -> Self {
        let body = body.into();
        Self {
            section: Section::usual(&body),
            body,
            materials: vec![MaterialRegion {
                group: None,
                material,
            }],
            law,
            rotational_scale: RotationalScale::Factor(1.0),
            horizon: Horizon::Factor(3.0),
            bonds_through_voids: false,
            correction: Correction::of_paper(&law),
            interfaces: Vec::new(),
            precracks: Vec::new(),
            closing: false,
            closing_friction: 0.0,
            contacts: Vec::new(),
            rigid_bodies: Vec::new(),
            far_field: None,
            refine: None,
            no_fail: Vec::new(),
            supports: Vec::new(),
            loads: Vec::new(),
            curve: None,
            stages: Vec::new(),
            temperatures: Vec::new(),
            initial_velocities: Vec::new(),
            quiet: Vec::new(),
            criteria: Vec::new(),
            scatter: Vec::new(),
            probes: Vec::new(),
            analysis: Analysis::default(),
            solver: SolverSettings::default(),
            remarks: Vec::new(),
        }
    }

    /// Materials in the order of their indices.
    pub fn materials(&self) -> Vec<Material> {
        let regions = self.materials.iter();
        regions.map(|region| region.material.clone()).collect()
    }

    /// Fracture energy G_c of all materials, J/m^2, where a criterion or a softening law spends it; `None` where they differ.
    pub fn spent_fracture_energy(&self) -> Option<f64> {
        let mut criteria = self.criteria.iter();
        if !criteria.any(|it| it.spends_fracture_energy() || it.after.softens) {
            return None;
        }
        let mut regions = self.materials.iter();
        let first = regions.next()?.material.fracture_energy?;
        let is_same = regions.all(|it| it.material.fracture_energy == Some(first));
        is_same.then_some(first)
    }

    /// The setup with one isotropic material in all regions; `None` where it has that already.
    pub(crate) fn of_one_material(&self) -> Option<Self> {
        let mut first = self.materials.first()?.material.clone();
        let isotropic = first.elasticity.isotropic();
        if self.materials.len() == 1 && isotropic.is_some() {
            return None;
        }
        first.elasticity = Elasticity::Isotropic(isotropic.unwrap_or(Isotropic {
            young: 1.0,
            poisson: 0.0,
        }));
        Some(self.of_materials(vec![first; self.materials.len()]))
    }

    /// Moduli kappa of the cells of each material, Pa, shape (n_materials); none where bonds make up the whole materials.
    pub fn moduli_of_cells(&self) -> Option<Vec<f64>> {
        let regions = self.materials.iter();
        let shared = regions.map(|it| self.law.split_elasticity(&it.material, self.space()));
        let moduli: Vec<f64> = shared.map(|it| it.map_or(0.0, |it| it.1)).collect();
        moduli.iter().any(|it| *it > 0.0).then_some(moduli)
    }

    /// The setup with the materials that its bonds make up; none where bonds make up the whole materials.
    pub(crate) fn of_bonds(&self) -> Option<Self> {
        self.moduli_of_cells()?;
        let of_bonds = |region: &MaterialRegion| {
            let material = region.material.clone();
            let shared = self.law.split_elasticity(&material, self.space());
            let elasticity = shared.map_or(material.elasticity, |it| it.0);
            Material {
                elasticity,
                ..material
            }
        };
        Some(self.of_materials(self.materials.iter().map(of_bonds).collect()))
    }

    /// The setup with other materials in its regions.
    pub(crate) fn of_materials(&self, materials: Vec<Material>) -> Self {
        let regions = self.materials.iter().zip(materials);
        let regions = regions.map(|(region, material)| MaterialRegion {
            group: region.group.clone(),
            material,
        });
        Self {
            materials: regions.collect(),
            ..self.clone()
        }
    }
}

impl Setup {
    /// The space in which the body deforms.
    pub fn space(&self) -> Space {
        self.section.space()
    }

    /// State of the plane; plane strain for a solid.
    pub fn plane(&self) -> Plane {
        self.space().plane()
    }

    /// The stress across the plane: none in plane stress, and in plane strain known of isotropic materials.
    pub fn stress_across_plane(&self) -> StressAcrossPlane {
        let is_isotropic =
            |it: &MaterialRegion| matches!(it.material.elasticity, Elasticity::Isotropic(_));
        match self.plane() {
            Plane::Stress => StressAcrossPlane::Zero,
            Plane::Strain if self.materials.iter().all(is_isotropic) => {
                StressAcrossPlane::OfIsotropic
            }
            Plane::Strain => StressAcrossPlane::Unknown,
        }
    }

    /// Thickness of the body, m; 1 for a solid.
    pub fn thickness(&self) -> f64 {
        self.section.thickness()
    }

    /// Characteristic length of a material, l_ch = E G_c/F_t^2 with Young's modulus E of a bar with the constants that the law makes of it, m; none
    /// without a strength or a fracture energy, or for a material with axes.
    pub fn characteristic_length(&self, material: &Material) -> Option<f64> {
        Some(self.young(material)? * material.fracture_energy? / material.tensile_strength?.powi(2))
    }

    /// Young's modulus of a bar of a material with the constants that the law makes of it, Pa; none for one with axes.
    pub fn young(&self, material: &Material) -> Option<f64> {
        let constants = self.law.constants(material, self.space())?;
        Some(match self.space() {
            Space::Plane(plane) => constants.in_plane(plane).young,
            Space::Solid => constants.young,
        })
    }

    /// Number of threads; by default the caller's threads.
    pub(crate) fn threads(&self) -> Option<usize> {
        self.solver.threads.map(|it| it as usize)
    }
}

impl Horizon {
    /// Range of a factor.
    pub const FACTOR: Range<'static> = Range::new(&[("minimum", 1.0)]);

    /// Range of a length.
    pub const LENGTH: Range<'static> = Range::POSITIVE;

    /// Horizons of the points of a cloud.
    pub fn of_points<const D: usize>(self, cloud: &PointCloud<D>) -> Horizons {
        match self {
            Self::Factor(factor) => Horizons::from_spacing(&cloud.spacing, factor),
            Self::Length(length) => Horizons::unified(length, cloud.len()),
        }
    }

    /// Horizon of a point at this distance from its nearest neighbour, m.
    pub fn at_spacing(self, spacing: f64) -> f64 {
        match self {
            Self::Factor(factor) => factor * spacing,
            Self::Length(length) => length,
        }
    }
}
