//! Bond laws as rows of a table, and a law with its options.

use super::densities::{BondGeometry, BondStiffness, Densities};
use super::options::Options;
use super::rotational::{Profile, RotationalStiffness};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::dimension::cast;
use crate::element::ElementKind;
use crate::failure::{Kind, strength};
use crate::material::{
    Elasticity, Isotropic, Material, Plane, PoissonForm, Space, VolumetricSplit,
};

/// A bond law.
#[derive(Debug, Clone, Copy)]
pub struct BondLaw {
    /// Keyword of the law in papers and case files.
    pub word: &'static str,
    /// Sentence on the deformations that the bonds resist.
    pub sentence: &'static str,
    /// Paper of the law, with its equations.
    pub source: &'static str,
    /// Options of the law, with their usual values.
    pub options: Options,
    /// Kinematics of the bonds for given options.
    pub element: fn(&Options) -> ElementKind,
    /// Form of the shear stiffness over the length of bonds, by the space; `None` where points have no rotations.
    pub shear_form: Option<fn(Space) -> ShearForm>,
    /// Whether the law fixes Poisson's ratio, for all materials.
    pub fixes_poisson: bool,
    /// Most general materials that the law admits.
    pub materials: Materials,
    /// Whether bonds are classed by the rows and columns of a lattice.
    pub needs_lattice: bool,
    /// Whether bonds couple their two ends alone, so that the force through a line is the sum over the bonds that cross it.
    pub couples_ends_alone: bool,
    /// Corrections that the paper uses with the law.
    pub correction: PaperCorrection,
    /// Default failure criterion of the bonds.
    pub criterion: &'static Kind,
    /// Stiffness densities in the plane.
    pub plane: MakeDensities<2>,
    /// Stiffness densities in space; `None` for a law that exists in the plane alone.
    pub solid: Option<MakeDensities<3>>,
}

/// Function for the stiffness densities of bonds in D dimensions.
pub type MakeDensities<const D: usize> = fn(&LawInput<'_, D>) -> BondStiffness;

/// Input of the stiffness densities of bonds in D dimensions.
#[derive(Debug, Clone, Copy)]
pub struct LawInput<'a, const D: usize> {
    /// Bonds.
    pub bonds: &'a BondSet<D>,
    /// Points.
    pub cloud: &'a PointCloud<D>,
    /// Elasticity of the materials, shape (n_materials).
    pub elasticity: &'a [Elasticity],
    /// Space in which the body deforms.
    pub space: Space,
    /// Options of the law.
    pub options: Options,
}

/// Most general of the materials that a law admits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Materials {
    /// Isotropic materials alone.
    Isotropic,
    /// Isotropic and orthotropic materials.
    Orthotropic,
    /// All materials, with any anisotropy.
    Anisotropic,
}

/// Corrections of the bonds that a paper uses with its law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PaperCorrection {
    /// No corrections, because the law gives the right energies without them.
    None,
    /// Partial volumes of the cells at the horizon; and volumes of the families, unless the constants are sums over the families.
    Volumes,
    /// Length factor and iterative domain correction of NHPD.
    LengthAndDomain,
}

/// Shear stiffness k_t of a bond over its length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShearForm {
    /// Constant k_t for all lengths, as in [`super::pds`]. With a factor alpha that depends on the length, the ratio of shear to stretch stays right:
    /// NHPD's form in space.
    Constant,
    /// Falling k_t = 12 d/l^2, as in a beam of Euler and Bernoulli: NHPD's form in the plane. In space NHPD's factor alpha, which falls with
    /// the length, makes the shear of the body 1.16 times too strong: nu = .2 becomes .192.
    Falling,
}

/// A bond law with its options.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Law {
    /// Row of the law.
    pub row: &'static BondLaw,
    /// Values of the law's options, and of no others.
    pub options: Options,
}

impl Materials {
    /// The least general class that contains a material.
    pub fn least_general_for(elasticity: &Elasticity) -> Self {
        match elasticity {
            Elasticity::Isotropic(_) => Self::Isotropic,
            Elasticity::Orthotropic(_) => Self::Orthotropic,
            Elasticity::Anisotropic(_) => Self::Anisotropic,
        }
    }

    /// Keyword of the most general materials.
    pub fn word(self) -> &'static str {
        match self {
            Self::Isotropic => "isotropic",
            Self::Orthotropic => "orthotropic",
            Self::Anisotropic => "anisotropic",
        }
    }
}

impl PartialEq for BondLaw {
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word
    }
}

impl Eq for BondLaw {}

impl<const D: usize> LawInput<'_, D> {
    /// Densities from constants of the materials, each computed from an isotropic material, the space and the thickness of the body.
    pub(super) fn isotropic_bonds<const N: usize>(
        &self,
        constants: [fn(&Isotropic, Space, f64) -> f64; N],
        densities: impl Fn(&[f64; N], &BondGeometry<D>) -> Densities + Sync,
    ) -> BondStiffness {
        let isotropic = self.elasticity.iter().filter_map(Elasticity::isotropic);
        let made =
            isotropic.map(|it| constants.map(|of| of(&it, self.space, self.cloud.thickness)));
        let made: Vec<[f64; N]> = made.collect();
        BondStiffness::from_constants(self.bonds, self.cloud, &made, densities)
    }

    /// Chosen rotational stiffness.
    pub(super) fn rotational(&self) -> RotationalStiffness {
        self.options.rotational_stiffness.unwrap_or_default()
    }
}

impl BondLaw {
    /// A law of isotropic materials on any points, without rotations and without options.
    pub(super) const fn new(
        word: &'static str,
        sentence: &'static str,
        source: &'static str,
        plane: MakeDensities<2>,
        solid: Option<MakeDensities<3>>,
    ) -> Self {
        Self {
            word,
            sentence,
            source,
            options: Options::NONE,
            element: |_| ElementKind::Spring,
            shear_form: None,
            fixes_poisson: false,
            materials: Materials::Isotropic,
            needs_lattice: false,
            couples_ends_alone: true,
            correction: PaperCorrection::Volumes,
            criterion: &strength::STRENGTH,
            plane,
            solid,
        }
    }

    /// Whether the law exists in a space.
    pub fn exists_in(&self, space: Space) -> bool {
        match space {
            Space::Plane(_) => true,
            Space::Solid => self.solid.is_some(),
        }
    }

    /// Whether bonds have strains of their own, of a rectangle around them.
    pub fn has_own_strains(&self) -> bool {
        (self.element)(&self.options).has_strains()
    }

    /// Whether bonds resist shear between points without rotations, and so rotations of the body.
    pub fn resists_rotations(&self) -> bool {
        self.shear_form.is_none() && !self.fixes_poisson && !self.has_own_strains()
    }

    /// Keyword of the law in quotes.
    pub fn quoted(&self) -> String {
        format!("\"{}\"", self.word)
    }

    /// Name of the law's constant in [`Law`], as messages write it.
    pub fn constant(&self) -> String {
        let name = self.word.to_uppercase().replace('-', "_");
        format!("`Law::{name}`")
    }
}

impl Law {
    /// A law with its usual options.
    pub const fn usual(row: &'static BondLaw) -> Self {
        let options = row.options;
        Self { row, options }
    }

    /// The law with other options.
    pub fn with(self, chosen: impl Into<Options>) -> Self {
        Self {
            options: chosen.into().or(self.options),
            ..self
        }
    }

    /// Name of the first option that is set although the law does not have it, or missing although the law has it.
    pub fn misplaced_option(&self) -> Option<&'static str> {
        self.options.first_different_option(&self.row.options)
    }

    /// Keyword of the law in papers and case files.
    pub fn name(&self) -> &'static str {
        self.row.word
    }

    /// Kinematics of the bonds.
    pub fn element(&self) -> ElementKind {
        (self.row.element)(&self.options)
    }

    /// Rotational stiffness in the plane over the length of the bonds; `None` where points have no rotations.
    pub fn rotational_profile(&self) -> Option<Profile> {
        let form = self.row.shear_form?(Plane::Stress.into());
        let chosen = self.options.rotational_stiffness;
        Some(Profile {
            rotational: chosen.unwrap_or(RotationalStiffness::Beam),
            shear_falls: form == ShearForm::Falling,
        })
    }

    /// Effective elastic constants of a material under the law: Young's modulus with the Poisson's ratio of central forces where the law
    /// fixes it. `None` for an anisotropic material.
    pub fn constants(&self, material: &Material, space: Space) -> Option<Isotropic> {
        self.split(material, space).map(|it| it.material)
    }

    /// A material split between bonds and cells; `None` for an anisotropic material.
    pub fn split(&self, material: &Material, space: Space) -> Option<VolumetricSplit> {
        let given = material.elasticity.isotropic()?;
        let split = match self.options.poisson {
            Some(PoissonForm::Cells) => VolumetricSplit::new(given, space),
            Some(PoissonForm::Bonds) | None => VolumetricSplit::whole(given),
        };
        Some(match self.row.fixes_poisson && !split.is_split() {
            true => VolumetricSplit::whole(given.with_central_forces(space)),
            false => split,
        })
    }

    /// Elasticity of a material with its effective constants under the law.
    pub fn effective_elasticity(&self, material: &Material, space: Space) -> Elasticity {
        let constants = self.constants(material, space);
        constants.map_or(material.elasticity, Elasticity::Isotropic)
    }

    /// Stiffness densities of the bonds of points in a space, of materials (n_materials).
    ///
    /// # Panics
    ///
    /// Panics for a law that does not exist in the dimension of the body.
    pub fn densities<const D: usize>(
        &self,
        bonds: &BondSet<D>,
        cloud: &PointCloud<D>,
        elasticity: &[Elasticity],
        space: Space,
    ) -> BondStiffness {
        let input = LawInput {
            bonds,
            cloud,
            elasticity,
            space,
            options: self.options,
        };
        let BondLaw { plane, solid, .. } = *self.row;
        let make: Option<MakeDensities<D>> = cast(plane).or_else(|| cast(solid?));
        make.expect("laws are checked to exist in the dimension of the body")(&input)
    }
}
