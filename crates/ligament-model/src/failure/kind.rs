//! Kinds of failure criteria, and the choice of a criterion.

use std::sync::Arc;

use super::basis::Basis;
use super::criterion::Surroundings;
use super::measure::Measure;
use super::softening::{Law, brittle};
use super::unfit::Setting;
use super::unfit::{NoLimit, Unfit};
use crate::advice::Advice;
use crate::dimension::cast;
use crate::material::{Elasticity, Material};
use crate::scatter::Scattered;

/// A kind of failure criterion.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Word of the kind in case files and in results.
    pub word: &'static str,
    /// Sentence on the failure and the origin of the limit.
    pub words: &'static str,
    /// Papers of the condition and of its limit, by the keys of the references, with their equations; empty without any.
    pub source: &'static str,
    /// Measures of a bond's deformation; the kind stands for a [`Criterion`](super::Criterion) of each.
    pub measures: &'static [Measure],
    /// Material properties that determine the limits, unless limits are given.
    pub takes: &'static [Property],
    /// Fields of a [`Choice`] that the kind takes.
    pub keys: &'static [&'static str],
    /// Reason why bonds always break at their limit; None if they may soften.
    pub brittle_because: Option<&'static str>,
    /// Reason why bonds never break at their limit; None if they may.
    pub softens_because: Option<&'static str>,
    /// Further check of a choice of the kind.
    pub check: fn(&Choice) -> Result<(), Unfit>,
    /// Further check of a material, beyond the properties that the kind [takes](Self::takes).
    pub suits: fn(&Choice, &Material) -> Result<(), Unfit>,
    /// Functions that compute the limits of the bonds.
    pub limits: PerSpace,
}

/// Function that computes the limits of bonds in D dimensions, for each measure of a kind.
pub type MakeLimits<const D: usize> = fn(&Choice, &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit>;

/// Functions that compute the limits of a kind in the plane and in space.
#[derive(Debug, Clone, Copy)]
pub struct PerSpace {
    /// Limits in the plane.
    pub plane: MakeLimits<2>,
    /// Limits in space; None for a kind that exists in the plane alone.
    pub solid: Option<MakeLimits<3>>,
}

impl PerSpace {
    /// Limits in the plane and in space by one generic function.
    pub(super) const fn new(plane: MakeLimits<2>, solid: MakeLimits<3>) -> Self {
        Self {
            plane,
            solid: Some(solid),
        }
    }

    /// Limits of a kind that exists in the plane alone.
    pub(super) const fn in_plane(plane: MakeLimits<2>) -> Self {
        Self { plane, solid: None }
    }

    /// The function for the limits in D dimensions; None for a kind that does not exist there.
    pub(super) fn in_dimension<const D: usize>(self) -> Option<MakeLimits<D>> {
        cast(self.plane).or_else(|| cast(self.solid?))
    }
}

/// A material property that determines limits.
#[derive(Debug, Clone, Copy)]
pub struct Property {
    /// Field of a [`Material`] that holds the property.
    pub key: &'static str,
    /// Unit of the property.
    pub unit: &'static str,
    /// Value of the property, where the material has it.
    pub value: fn(&Material) -> Option<f64>,
}

/// Tensile strength F_t.
pub(super) const TENSILE_STRENGTH: Property = Property {
    key: "tensile_strength",
    unit: "Pa",
    value: |material| material.tensile_strength,
};

/// Compressive strength F_c.
pub(super) const COMPRESSIVE_STRENGTH: Property = Property {
    key: "compressive_strength",
    unit: "Pa",
    value: |material| material.compressive_strength,
};

/// Fracture energy G_c.
pub(super) const FRACTURE_ENERGY: Property = Property {
    key: "fracture_energy",
    unit: "J/m^2",
    value: |material| material.fracture_energy,
};

/// Limits of the bonds under one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Limit of each bond; infinite where it never fails, shape (n_bonds).
    pub limit: Vec<f64>,
    /// Coefficients of the measure for each bond; empty where the measure has none, shape (n_bonds, n).
    pub coefficient: Vec<f64>,
    /// Surroundings of the bonds on which the limits or the measure depend; None where both depend on the bond alone.
    pub surroundings: Option<Arc<Surroundings>>,
    /// Whether bonds break at these limits, although they may soften after other limits of the kind.
    pub is_brittle: bool,
    /// Name of the criterion in results; None for the name from kind and measure.
    pub name: Option<&'static str>,
}

impl Limits {
    /// Limits (n_bonds) of a measure without a coefficient.
    pub fn without_coefficient(limit: Vec<f64>) -> Self {
        Self::new(limit, Vec::new())
    }

    /// Limits (n_bonds) that stay as they are, with the coefficients of the measure (n_bonds, n).
    pub fn new(limit: Vec<f64>, coefficient: Vec<f64>) -> Self {
        Self {
            limit,
            coefficient,
            surroundings: None,
            is_brittle: false,
            name: None,
        }
    }

    /// Whether the limits stay as they are while bonds break.
    pub(super) fn has_fixed_limits(&self) -> bool {
        !matches!(
            self.surroundings.as_deref(),
            Some(Surroundings::CrackAtPoints(_))
        )
    }
}

crate::case_type! {
    /// A criterion of failure.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Choice {
        /// Kind of failure and origin of the limit.
        pub kind: Kind,
        /// Stretch, shortening or sliding at which a bond fails, in the place of the strength or the energy of the material.
        #[range("exclusiveMinimum" = 0)]
        pub limit: Option<f64>,
        /// Stretch at which a bond without shear fails; of `mixed-mode`, with `critical_angle`.
        #[range("exclusiveMinimum" = 0)]
        pub critical_stretch: Option<f64>,
        /// Shear at which a bond that does not open fails, rad; of `mixed-mode`, with `critical_stretch`.
        #[range("exclusiveMinimum" = 0)]
        pub critical_angle: Option<f64>,
        /// Derivation of the limit of `frictional` from the strengths.
        #[case(schemars(extend("default" = Calibration::default())))]
        pub calibration: Option<Calibration>,
        /// Angle of friction, rad. For `mohr-coulomb` it is the angle phi of the material; for `frictional` the angle beta of a bond, in the place of
        /// the compressive strength: compression by s makes its limit of sliding larger by s tan(beta).
        #[range("minimum" = 0)]
        pub friction_angle: Option<f64>,
        /// Cohesion of `mohr-coulomb`, Pa, in the place of the compressive strength; with `friction_angle`.
        #[range("exclusiveMinimum" = 0)]
        pub cohesion: Option<f64>,
        /// Distance of the outermost fibre from the axis of a bond, m; of `fibre`.
        #[range("minimum" = 0)]
        pub fibre_distance: Option<f64>,
        /// Behaviour of a bond after its limit: a word, or a curve of stress over the opening of a crack.
        #[case(serde(default))]
        pub after: Law,
        /// Deformation at which the force has fallen to zero, over the deformation at the limit: above 1 for `linear`, above 3 for `two-branch`;
        /// without it the value that gives the `fracture_energy`.
        #[range("exclusiveMinimum" = 1)]
        pub end: Option<f64>,
        /// Scale of the fall of `exponential` over the deformation at the limit; without it so that the `fracture_energy` comes out.
        #[range("exclusiveMinimum" = 0)]
        pub scale: Option<f64>,
    }
}

crate::case_type! {
    /// Calibration of the cohesion and the friction of bonds by two strengths. The printed one puts in the stress of the bar as E s of the bond
    /// (MPPD eqs 55, 56), which is exact for nu = 0 alone; the other one is possible where nu < F_t/F_c.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Calibration {
        /// As printed: exact without lateral strain alone.
        #[default]
        Printed,
        /// From the strains of a bar under both strengths.
        TwoPoint,
    }
}

impl PartialEq for Kind {
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word
    }
}

impl Kind {
    /// A kind that allows every law after the limit and has no further condition on materials.
    pub(super) const fn new(
        word: &'static str,
        words: &'static str,
        measures: &'static [Measure],
        limits: PerSpace,
    ) -> Self {
        Self {
            word,
            words,
            source: "",
            measures,
            takes: &[],
            keys: &[],
            brittle_because: None,
            softens_because: None,
            check: |_| Ok(()),
            suits: |_, _| Ok(()),
            limits,
        }
    }

    /// Whether the kind measures strains of an imaginary element.
    pub fn takes_strains(&self) -> bool {
        self.measures.iter().any(|it| it.takes_strains())
    }

    /// The key of the limit of the kind, the first of several.
    pub fn own_limit(&self) -> Option<&'static str> {
        let limits = Choice::from(*self).own_limits();
        let mut keys = self.keys.iter();
        keys.find(|key| limits.iter().any(|(limit, _)| limit == *key))
            .copied()
    }

    /// The key that replaces a property of the material.
    fn instead_of(&self, property: &Property) -> Option<&'static str> {
        if property.key == COMPRESSIVE_STRENGTH.key {
            let spares = ["cohesion", "friction_angle"];
            let spares = spares.into_iter().find(|it| self.keys.contains(it));
            return spares.or(self.own_limit());
        }
        self.own_limit()
    }
}

impl From<Kind> for Choice {
    /// The kind with limits from the material and brittle bonds.
    fn from(kind: Kind) -> Self {
        Self {
            kind,
            limit: None,
            critical_stretch: None,
            critical_angle: None,
            calibration: None,
            friction_angle: None,
            cohesion: None,
            fibre_distance: None,
            after: brittle::LAW,
            end: None,
            scale: None,
        }
    }
}

impl Choice {
    /// Given limits of the choice by their keys.
    pub fn own_limits(&self) -> [(&'static str, Option<f64>); 3] {
        [
            ("limit", self.limit),
            ("critical_stretch", self.critical_stretch),
            ("critical_angle", self.critical_angle),
        ]
    }

    /// The criterion with a law of softening and its parameter, where it is given.
    pub fn with_softening(mut self, law: Law, parameter: Option<f64>) -> Self {
        match law.parameter.map(|it| it.key) {
            Some("scale") => self.scale = parameter,
            Some(_) => self.end = parameter,
            None => {}
        }
        self.after = law;
        self
    }

    /// Given parameters of the laws of softening by their keys.
    pub(super) fn parameters(&self) -> [(&'static str, Option<f64>); 2] {
        [("end", self.end), ("scale", self.scale)]
    }

    /// The parameter of the law of softening; None where the law has none or the fracture energy determines it.
    pub fn parameter(&self) -> Option<f64> {
        let key = self.after.parameter?.key;
        let mut given = self.parameters().into_iter();
        given.find(|it| it.0 == key)?.1
    }

    /// Properties of each material that determine the limits.
    pub fn takes(&self) -> &'static [Property] {
        let is_given = self.own_limits().iter().any(|(_, limit)| limit.is_some());
        // With a cohesion the angle alone does not say how strong the material is under pressure.
        let by_angle = self.friction_angle.is_some() && !self.kind.keys.contains(&"cohesion");
        let spares = by_angle || self.cohesion.is_some() || self.begins_at_strength();
        match (is_given, spares) {
            (true, _) => &[],
            (false, true) => &[TENSILE_STRENGTH],
            (false, false) => self.kind.takes,
        }
    }

    /// Whether bonds begin to soften at the strength, and spend the fracture energy from there on.
    pub fn begins_at_strength(&self) -> bool {
        let can = self.kind.measures == [Measure::Energy] && self.after.softens;
        can && self.limit.is_none() && self.parameter().is_none()
    }

    /// Whether the stress around bonds decides when they begin to soften.
    fn begins_by_stress(&self) -> bool {
        self.after.softens && self.kind.measures.iter().any(|it| it.takes_stress())
    }

    /// The property whose random factor scales the limits; given limits vary like a strength.
    pub fn limits_from(&self) -> Scattered {
        let mut takes = self.takes().iter();
        match takes.any(|it| it.key == FRACTURE_ENERGY.key) || self.begins_by_stress() {
            true => Scattered::FractureEnergy,
            false => Scattered::Strength,
        }
    }

    /// Whether a random factor of a property has an effect.
    pub fn is_affected_by(&self, of: Scattered) -> bool {
        let of_softening =
            of == Scattered::FractureEnergy && self.parameter_from_energy().is_some();
        // What lets bonds begin to soften is a strength, and what lets them end an energy.
        let of_beginning = of == Scattered::Strength && self.begins_by_stress();
        self.limits_from() == of || of_softening || of_beginning
    }

    /// Whether a bond dissipates the whole fracture energy by breaking at its limit.
    pub fn spends_fracture_energy(&self) -> bool {
        let mut takes = self.takes().iter();
        let is_taken = takes.any(|it| it.key == FRACTURE_ENERGY.key);
        is_taken && !self.kind.takes_strains() && self.kind.softens_because.is_none()
    }

    /// The key of the softening parameter if the fracture energy determines it.
    pub fn parameter_from_energy(&self) -> Option<&'static str> {
        let key = self.after.parameter.map(|it| it.key);
        key.filter(|_| self.parameter().is_none())
    }

    /// Checks that a material has the properties that the criterion takes.
    ///
    /// # Errors
    ///
    /// If it has axes or lacks a property; if two of its properties are incompatible.
    pub fn suits(&self, material: &Material) -> Result<(), Unfit> {
        let kind = &self.kind;
        let of_limits = self.takes().iter().map(|it| (it, kind.instead_of(it)));
        let of_softening = self.parameter_from_energy();
        // A parameter stands in the place of the energy where all bonds may have the same one.
        let instead = |key| (!self.begins_by_stress()).then_some(key);
        let of_softening = of_softening.map(|key| (&FRACTURE_ENERGY, instead(key)));
        for (property, instead) in of_limits.chain(of_softening) {
            let is_isotropic = matches!(material.elasticity, Elasticity::Isotropic(_));
            if !is_isotropic && !kind.takes_strains() {
                return Err(Unfit::WithAxes {
                    property: property.key,
                    kind: kind.word,
                    instead,
                });
            }
            if (property.value)(material).is_none() {
                let instead = instead.map(|it| format!(" without `{it}`"));
                let instead = instead.unwrap_or_default();
                let text = format!("(in {}) because {{}}{instead}", property.unit);
                return Err(Unfit::Missing {
                    field: property.key,
                    reason: Advice::new(text, [Setting::FailureBy(kind.word)]),
                });
            }
        }
        (kind.suits)(self, material)
    }
}
