//! What a bond law is, and a law with what is chosen of it.

use super::densities::{BondGeometry, BondStiffness, Densities};
use super::options::Options;
use super::rotational::{Profile, RotationalStiffness};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::dimension::cast;
use crate::element::ElementKind;
use crate::failure::{Kind, strength};
use crate::material::{Elasticity, Isotropic, Material, Plane, Space};

/// A bond law.
#[derive(Debug, Clone, Copy)]
pub struct BondLaw {
    /// Word of the law as papers and case files abbreviate it.
    pub word: &'static str,
    /// Sentence that says what the bonds resist.
    pub sentence: &'static str,
    /// Paper of the law, with its equations.
    pub source: &'static str,
    /// Options that the law leaves open, with their usual values.
    pub options: Options,
    /// Kinematics of the bonds with some options.
    pub element: fn(&Options) -> ElementKind,
    /// Form of the shear stiffness over the length of bonds, by the space; None where points do not turn.
    pub shear_form: Option<fn(Space) -> ShearForm>,
    /// Whether Poisson's ratio follows from the law, whatever the materials have.
    pub fixes_poisson: bool,
    /// Most general materials that the law takes.
    pub materials: Materials,
    /// Whether bonds are classed by the rows and columns of a lattice.
    pub needs_lattice: bool,
    /// Whether bonds couple their two ends alone, so that their forces go through a line that cuts them.
    pub couples_ends_alone: bool,
    /// Corrections that the paper takes with the law.
    pub correction: PaperCorrection,
    /// Criterion by which bonds fail where none is given.
    pub criterion: &'static Kind,
    /// What makes the stiffness densities in the plane.
    pub plane: MakeDensities<2>,
    /// What makes them in space; None for a law that exists in the plane alone.
    pub solid: Option<MakeDensities<3>>,
}

/// What makes stiffness densities of bonds in D dimensions.
pub type MakeDensities<const D: usize> = fn(&LawInput<'_, D>) -> BondStiffness;

/// What the stiffness densities of bonds in D dimensions are made of.
#[derive(Debug, Clone, Copy)]
pub struct LawInput<'a, const D: usize> {
    /// The bonds.
    pub bonds: &'a BondSet<D>,
    /// The points.
    pub cloud: &'a PointCloud<D>,
    /// The materials, shape (n_materials).
    pub elasticity: &'a [Elasticity],
    /// Space in which the body deforms.
    pub space: Space,
    /// What is chosen of the law.
    pub options: Options,
}

/// Most general of the materials that a law takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Materials {
    /// Isotropic materials alone.
    Isotropic,
    /// Orthotropic materials and isotropic ones.
    Orthotropic,
    /// All materials.
    Anisotropic,
}

/// Corrections of the bonds that a paper takes with its law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PaperCorrection {
    /// No corrections: the law makes all energies right.
    None,
    /// Share of the cells inside the horizon; and the volumes of the families, unless the constants are sums over them.
    Volumes,
    /// NHPD's factor by length and its iterative domain correction.
    LengthAndDomain,
}

/// Shear stiffness k_t of a bond over its length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShearForm {
    /// One k_t for all lengths, that of [`super::pds`]. With a factor alpha that depends on the length, the ratio of shear to stretch
    /// stays right: NHPD's form in space.
    Constant,
    /// k_t = 12 d/l^2, as a beam of Euler and Bernoulli has: NHPD's form in the plane. In space NHPD's factor alpha, which falls with the
    /// length, makes the shear of the body 1.16 times too strong: nu = .2 becomes .192.
    Falling,
}

/// A bond law with what is chosen of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Law {
    /// The law.
    pub row: &'static BondLaw,
    /// Choices of what it leaves open, and of nothing else.
    pub options: Options,
}

impl Materials {
    /// Least general ones that a material is among.
    pub fn of_elasticity(elasticity: &Elasticity) -> Self {
        match elasticity {
            Elasticity::Isotropic(_) => Self::Isotropic,
            Elasticity::Orthotropic(_) => Self::Orthotropic,
            Elasticity::Anisotropic(_) => Self::Anisotropic,
        }
    }

    /// Word of the most general ones.
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
    /// Densities from constants of the materials, each made of an isotropic one in a space with the thickness of the body.
    pub(super) fn of_isotropic<const N: usize>(
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

    /// The chosen stiffness against relative rotation.
    pub(super) fn rotational(&self) -> RotationalStiffness {
        self.options.rotational_stiffness.unwrap_or_default()
    }
}

impl BondLaw {
    /// A law of isotropic materials on any points, without rotations of these, that leaves nothing open.
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

    /// Whether bonds have strains of their own.
    pub fn has_own_strains(&self) -> bool {
        (self.element)(&self.options).has_strains()
    }

    /// Whether bonds resist shear between points that do not turn, and with it rotations of the body.
    pub fn resists_rotations(&self) -> bool {
        self.shear_form.is_none() && !self.fixes_poisson && !self.has_own_strains()
    }

    /// Word of the law in quotes.
    pub fn quoted(&self) -> String {
        format!("\"{}\"", self.word)
    }

    /// Name of the law's constant among those of [`Law`], as messages write it.
    pub fn constant(&self) -> String {
        let name = self.word.to_uppercase().replace('-', "_");
        format!("`Law::{name}`")
    }
}

impl Law {
    /// A law with the usual choice of what it leaves open.
    pub const fn usual(row: &'static BondLaw) -> Self {
        let options = row.options;
        Self { row, options }
    }

    /// The law with other choices.
    pub fn with(self, chosen: impl Into<Options>) -> Self {
        Self {
            options: chosen.into().or(self.options),
            ..self
        }
    }

    /// Name of the first option that is chosen although the law settles it, or left out although the law leaves it open.
    pub fn misplaced_option(&self) -> Option<&'static str> {
        self.options.apart_from(&self.row.options)
    }

    /// Word of the law as papers and case files abbreviate it.
    pub fn name(&self) -> &'static str {
        self.row.word
    }

    /// Kinematics of the bonds.
    pub fn element(&self) -> ElementKind {
        (self.row.element)(&self.options)
    }

    /// Rotational stiffness in the plane over the length of the bonds; None where points have no rotations.
    pub fn rotational_profile(&self) -> Option<Profile> {
        let form = self.row.shear_form?(Plane::Stress.into());
        let chosen = self.options.rotational_stiffness;
        Some(Profile {
            rotational: chosen.unwrap_or(RotationalStiffness::Beam),
            shear_falls: form == ShearForm::Falling,
        })
    }

    /// Elastic constants that the law makes of a material: Young's modulus with the Poisson's ratio of central forces where the law knows no
    /// other. None for a material with axes.
    pub fn constants(&self, material: &Material, space: Space) -> Option<Isotropic> {
        let given = material.elasticity.isotropic()?;
        Some(match self.row.fixes_poisson {
            true => given.with_central_forces(space),
            false => given,
        })
    }

    /// Elasticity of a material with the constants that the law makes of its own.
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
