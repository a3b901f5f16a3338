//! Checks of a setup for consistency.

use std::borrow::Cow;
use std::fmt::Debug;

use ligament_analysis::Component;
use ligament_model::case_type::{Number, OutOfRange, Range, Ranged};
use ligament_model::correction::patch;
use ligament_model::failure::Choice;
use ligament_model::law::{BondLaw, Materials, PaperCorrection, laws_with};
use ligament_model::scatter::{Distribution, Scatter, Scattered};
use ligament_model::{Advice, Anisotropic, Elasticity, Material, Orthotropic, Plane};

use super::setting::Setting;
use super::{
    Action, Alpha, Analysis, Calibration, CorrectionDomain, Couple, Fineness, Horizon, Interface,
    Load, MaterialRegion, Place, Profile, Reading, Refine, Setup, Surface, Tip,
};
use crate::body::Origin;
use crate::error::{Fault, Field, SetupError};

pub(super) type Checked = Result<(), SetupError>;

impl Setup {
    /// Checks the ranges and the consistency of the fields of the setup. The names of groups are checked when the model is built.
    ///
    /// # Errors
    ///
    /// If a field is out of range, missing, or contradicts another.
    pub fn check(&self) -> Checked {
        let (range, horizon) = match self.horizon {
            Horizon::Factor(factor) => (Horizon::FACTOR, factor),
            Horizon::Length(length) => (Horizon::LENGTH, length),
        };
        within(range, Field::whole("horizon"), horizon)?;
        if self.materials.is_empty() {
            let reason = "there is no material: give one, or one for each group";
            return contradiction(Field::whole("materials"), reason);
        }
        for (index, region) in self.materials.iter().enumerate() {
            let field = Field::element("materials", index);
            self.check_material(field, &region.material)?;
            self.check_cells(field, &region.material)?;
        }
        in_range(&self.solver, |key| Field::whole("solver").part(key))?;
        if let Analysis::Modal(settings) = &self.analysis {
            in_range(settings, |key| Field::whole("modal").part(key))?;
        }
        self.check_criteria()?;
        self.check_interfaces()?;
        self.check_scatter()?;
        self.check_dimension()?;
        self.check_correction()?;
        self.check_exclusions()?;
        self.check_far_field()?;
        self.check_refinement()?;
        self.check_load_factors()?;
        self.check_motion()?;
        self.check_stages()?;
        require_unique("loads", self.loads.iter().map(|it| it.name.as_str()))?;
        require_unique("probes", self.probes.iter().map(|it| it.name.as_str()))?;
        self.check_restraints()?;
        self.check_contacts()?;
        for (index, load) in self.loads.iter().enumerate() {
            check_load(Field::element("loads", index), load, self.body.dimensions())?;
        }
        self.check_probes()
    }

    fn check_material(&self, field: Field, material: &Material) -> Checked {
        check_constants(field, &material.elasticity)?;
        in_range(material, |key| field.part(key))?;
        let density = material.density.unwrap_or(1.0);
        let expected = "less than 1e100 kg/m^3, beyond which frequencies are no numbers";
        require(density < 1e100, field.part("density"), expected, density)?;
        if matches!(self.analysis, Analysis::Modal(_)) && material.density.is_none() {
            let reason = "(in kg/m^3) because a modal analysis needs masses";
            return missing(field, "density", reason);
        }
        let elasticity = field.part("elasticity");
        let needed = Materials::least_general_for(&material.elasticity);
        let taken = self.law.row.materials;
        if taken < needed {
            let text = format!(
                "an {} material needs {{}}: \"{}\" is a law for {} ones",
                needed.word(),
                self.law.name(),
                taken.word()
            );
            let laws = Setting::Law(laws_with(|it| it.materials >= needed));
            return contradiction(elasticity, Advice::new(text, [laws]));
        }
        // Six constants describe either state of the plane, and so does their thermal expansion.
        if matches!(material.elasticity, Elasticity::Anisotropic(_))
            || self.space() != Plane::Strain.into()
        {
            return Ok(());
        }
        if material.expansion.is_some_and(|it| it.across.is_none()) {
            let reason = "(in 1/K) because of plane strain, where it widens the plane";
            return missing(field, "expansion.across", reason);
        }
        match material.elasticity {
            Elasticity::Orthotropic(it) if it.out_of_plane.is_none() => {
                missing(field, "elasticity.out_of_plane", "because of plane strain")
            }
            _ => Ok(()),
        }
    }

    /// Refuses a material whose volumetric stiffness the cells cannot carry.
    fn check_cells(&self, field: Field, material: &Material) -> Checked {
        if self.law.split_elasticity(material, self.space()).is_some() {
            return Ok(());
        }
        let reason = "cells cannot carry the volumetric stiffness of this material: what they leave to the bonds is not stable, or pulls where \
                      bonds are shortened; take `poisson = \"bonds\"`, the form of the paper";
        contradiction(field.part("elasticity"), reason)
    }

    fn check_criteria(&self) -> Checked {
        let on_exact_path = matches!(self.analysis, Analysis::Event(_));
        let takes_strains = self.law.row.has_own_strains();
        let may_be_whole = self.analysis.is_motion();
        if self.analysis.is_fracture() && !may_be_whole && self.criteria.is_empty() {
            let reason = "bonds break by a criterion, and there is none: give one";
            return contradiction(Field::whole("criteria"), reason);
        }
        for (index, choice) in self.criteria.iter().enumerate() {
            let field = Field::element("criteria", index);
            choice
                .check(on_exact_path)
                .map_err(|unfit| field.error(Fault::Unfit(unfit.into())))?;
            let (kind, law) = (choice.kind.word, self.law.name());
            if choice.kind.takes_strains() != takes_strains {
                let (text, laws) = if takes_strains {
                    let text = format!(
                        "\"{kind}\" looks at stretch and sliding of a bond between two points, and the bonds of {{}} have \
                         strains of their own: take \"{}\"",
                        self.law.row.criterion.word
                    );
                    (text, vec![self.law.row])
                } else {
                    let text = format!(
                        "\"{kind}\" looks at strains of the bond's own, which only {{}} has: for \"{law}\" take \
                         \"critical-stretch\" or \"bond-energy\""
                    );
                    (text, laws_with(BondLaw::has_own_strains))
                };
                return contradiction(field.part("kind"), Advice::new(text, [Setting::Law(laws)]));
            }
            let bends = choice.kind.measures.iter().any(|it| it.takes_rotations());
            if bends && self.law.rotational_profile().is_none() {
                let reason = format!(
                    "\"{kind}\" looks at the bending of bonds, and the points of \"{law}\" have no rotations: take \"tension\""
                );
                return contradiction(field.part("kind"), reason);
            }
            for (place, region) in self.materials.iter().enumerate() {
                let field = Field::element("materials", place);
                let suits = choice.suits(&region.material);
                suits.map_err(|unfit| field.error(Fault::Unfit(unfit.into())))?;
            }
        }
        Ok(())
    }

    fn check_interfaces(&self) -> Checked {
        for (index, interface) in self.interfaces.iter().enumerate() {
            let field = Field::element("interfaces", index);
            in_range(interface, |key| field.part(key))?;
            self.check_sides(field.part("between"), interface)?;
            self.check_effect(field, interface)?;
        }
        Ok(())
    }

    fn check_sides(&self, field: Field, interface: &Interface) -> Checked {
        let names = |it: &MaterialRegion| [Some(it.material.name.clone()), it.group.clone()];
        let all = self.materials.iter().flat_map(names).flatten();
        let mut candidates: Vec<String> = all.collect();
        candidates.dedup();
        for name in &interface.between {
            if !candidates.contains(name) {
                return Err(field.error(Fault::UnknownName {
                    what: "material",
                    found: name.clone(),
                    candidates,
                }));
            }
        }
        match self.sides(interface) {
            Some([one, other]) if one == other => {
                let reason = "an interface lies between two materials, and both are this one: give each side a [material.NAME] of its own";
                contradiction(field, reason)
            }
            _ => Ok(()),
        }
    }

    /// Refuses an interface that changes no limit.
    fn check_effect(&self, field: Field, interface: &Interface) -> Checked {
        let is_given = |key: &str| {
            let mut properties = interface.properties().into_iter();
            properties.any(|(name, value)| name == key && value.is_some())
        };
        let uses = |it: &Choice| {
            let of_softening = it.parameter_from_energy().is_some() && is_given("fracture_energy");
            of_softening || it.takes().iter().any(|property| is_given(property.key))
        };
        if self.criteria.iter().any(uses) {
            return Ok(());
        }
        let reason = "no criterion takes a property that it has: give the strength or the fracture energy that the criteria take from the materials";
        contradiction(field, reason)
    }

    fn check_correction(&self) -> Checked {
        let (alpha, surface) = (self.correction.alpha, self.correction.surface);
        let field = Field::whole("correction");
        let is_discrete = self.law.options.calibration == Some(Calibration::Discrete);
        if is_discrete && surface == Surface::Volume {
            let reason = Advice::new(
                "the discrete calibration already accounts for surfaces: take {}, or {}",
                [
                    Setting::Surface(Surface::None),
                    Setting::Calibration(Calibration::Integral),
                ],
            );
            return contradiction(field.part("surface"), reason);
        }
        if let Surface::Patch(settings) = surface {
            self.check_patch(field.part("surface"), settings)?;
        }
        if self.law.row.correction != PaperCorrection::None {
            return Ok(());
        }
        let (part, instead) = match (alpha, surface) {
            (Alpha::None, Surface::None) => return Ok(()),
            (Alpha::None, _) => ("surface", Setting::Surface(Surface::None)),
            (Alpha::PartialVolume | Alpha::Length, _) => ("alpha", Setting::Alpha(Alpha::None)),
        };
        let text = "the factors psi of {} make all energies right: take {}";
        let law = Setting::Law(vec![self.law.row]);
        contradiction(field.part(part), Advice::new(text, [law, instead]))
    }

    /// Refuses the patch correction for bodies without cells and together with the correction after pre-cracks, and settings out of range.
    fn check_patch(&self, field: Field, settings: patch::Settings) -> Checked {
        if matches!(self.body.origin(), Origin::Points) {
            let text = "the forces of uniform strains are those of the cells of a body, and points from arrays have none: take a mesh or a \
                        lattice, or {}";
            let volume = Setting::Surface(Surface::Volume);
            return contradiction(field, Advice::new(text, [volume]));
        }
        if self.correction.domain == CorrectionDomain::Cracked {
            let text = "the cells of the body do not contain its pre-cracks: take {}";
            let whole = Setting::Domain(CorrectionDomain::Whole);
            let field = Field::whole("correction").part("domain");
            return contradiction(field, Advice::new(text, [whole]));
        }
        use patch::Settings as S;
        let S {
            lowest,
            highest,
            moment_weight,
            regularisation,
            ..
        } = settings;
        within(S::LOWEST, field.part("lowest"), lowest)?;
        within(S::HIGHEST, field.part("highest"), highest)?;
        within(S::MOMENT_WEIGHT, field.part("moment_weight"), moment_weight)?;
        within(
            S::REGULARISATION,
            field.part("regularisation"),
            regularisation,
        )
    }

    fn check_load_factors(&self) -> Checked {
        let stop = Field::whole("analysis.stop");
        if let Analysis::Event(settings) = &self.analysis {
            in_range(&settings.stop, |key| stop.part(key))?;
        }
        let Analysis::Stepped(settings) = &self.analysis else {
            return Ok(());
        };
        in_range(&settings.stop, |key| stop.part(key))?;
        if !self.stages.is_empty() {
            return Ok(());
        }
        let (list, factors) = ("analysis.load_factors", &settings.load_factors);
        require(
            !factors.is_empty(),
            Field::whole(list),
            "one load factor or more",
            factors,
        )?;
        let before = [0.0].into_iter().chain(factors.iter().copied());
        for (index, (before, &factor)) in before.zip(factors).enumerate() {
            let expected = format!("a number other than the load factor before it, {before:?}");
            let moves = factor.is_finite() && factor != before;
            require(moves, Field::element(list, index), expected, factor)?;
        }
        Ok(())
    }

    fn check_probes(&self) -> Checked {
        for (index, probe) in self.probes.iter().enumerate() {
            let field = Field::element("probes", index).part("reading");
            if matches!(probe.reading, Reading::Section { .. }) && !self.law.row.couples_ends_alone
            {
                let text = "the elements of {} couple up to six points, so that their forces go through no line: the forces of supports \
                    and loads are in the history";
                let law = Setting::Law(vec![self.law.row]);
                return contradiction(field, Advice::new(text, [law]));
            }
            if let Reading::Between {
                positions: ends, ..
            }
            | Reading::Section { line: ends, .. } = probe.reading
            {
                let found = ends.map(|it| it[..self.body.dimensions()].to_vec());
                require(ends[0] != ends[1], field, "two different points", found)?;
            }
            if let Reading::Tip(Tip {
                radii: Some([inner, outer]),
                ..
            }) = probe.reading
            {
                let radii = Field::element("probes", index).part("radii");
                let expected = "an inner radius above 0 and a larger outer one";
                let grows = 0.0 < inner && inner < outer && outer.is_finite();
                require(grows, radii, expected, [inner, outer])?;
            }
            if let Reading::Tip(Tip {
                front_length: Some(length),
                ..
            }) = probe.reading
            {
                let field = Field::element("probes", index).part("front_length");
                require(length > 0.0, field, "a length above 0", length)?;
            }
        }
        Ok(())
    }
}

/// Refuses elastic constants with moduli that are not positive, or with a strain energy that is not positive.
fn check_constants(field: Field, elasticity: &Elasticity) -> Checked {
    match elasticity {
        Elasticity::Isotropic(constants) => in_range(constants, |key| {
            field.part(match key {
                "young" => "elasticity.young",
                _ => "elasticity.poisson",
            })
        }),
        Elasticity::Orthotropic(constants) => check_orthotropic(field, constants),
        Elasticity::Anisotropic(constants) => check_anisotropic(field, constants),
    }
}

fn check_orthotropic(field: Field, constants: &Orthotropic) -> Checked {
    for young in constants.young {
        positive(field.part("elasticity.young"), Some(young))?;
    }
    let shear_modulus = Some(constants.shear_modulus);
    positive(field.part("elasticity.shear_modulus"), shear_modulus)?;
    require(
        constants.is_stable(),
        field.part("elasticity.poisson"),
        "so small that every strain costs energy (nu_12^2 < E_1/E_2, and the like across the plane)",
        constants.poisson,
    )?;
    if constants.has_stiffness() {
        return Ok(());
    }
    let reason = "the constants are too large, too small or too far apart for a stiffness of them in double precision";
    contradiction(field.part("elasticity"), reason)
}

fn check_anisotropic(field: Field, constants: &Anisotropic) -> Checked {
    let c = &constants.stiffness;
    for (part, [row, column], words) in [
        ("elasticity.c12", [0, 1], "c12^2 < c11 c22"),
        ("elasticity.c16", [0, 2], "c16^2 < c11 c66"),
        ("elasticity.c26", [1, 2], "c26^2 < c22 c66"),
    ] {
        let (coupling, both) = (c[(row, column)], c[(row, row)] * c[(column, column)]);
        let expected = format!("so small that every strain costs energy ({words})");
        let holds = coupling * coupling < both;
        require(holds, field.part(part), expected, coupling)?;
    }
    if constants.is_stable() {
        return Ok(());
    }
    let reason = "the stiffness c11 to c66 is not positive definite: some strain would cost no energy, or give some back; \
                  c12, c16 and c26 are too large together";
    contradiction(field.part("elasticity"), reason)
}

/// Required size of a load.
const NOT_IDLE: &str = "other than 0, or the load does nothing";

/// Refuses loads without an effect, or of a kind that their place does not have.
fn check_load(field: Field, load: &Load, dimensions: usize) -> Checked {
    if let Some(Profile::Linear { zero, one, .. }) = load.profile {
        require(
            one != zero,
            field.part("profile.one"),
            "another coordinate than `zero`: the load is as given there",
            one,
        )?;
    }
    let action = field.part("action");
    match load.action {
        Action::Displacement(it) | Action::Velocity(it) | Action::BaseAcceleration(it)
            if it.components().next().is_none() =>
        {
            return contradiction(action, no_component(dimensions));
        }
        Action::Force(vector)
        | Action::ForcePerLength(vector)
        | Action::ForcePerArea(vector)
        | Action::BodyForce(vector)
        | Action::Acceleration(vector)
            if vector == [0.0; 3] =>
        {
            return contradiction(action, idle_vector(dimensions));
        }
        Action::Moment(couple) | Action::BodyCouple(couple) => {
            require_couple(action, couple, dimensions)?;
        }
        Action::Pressure(value) => require(value != 0.0, action, NOT_IDLE, value)?,
        _ => {}
    }
    match (load.action, &load.place) {
        (Action::BodyForce(_) | Action::Acceleration(_) | Action::BodyCouple(_), Place::At(_)) => {
            let text = "a body force or couple acts on a volume: give {}";
            contradiction(field.part("place"), Advice::new(text, [Setting::Volumes]))
        }
        (
            Action::ForcePerLength(_) | Action::ForcePerArea(_) | Action::Pressure(_),
            Place::Group(_),
        ) => Ok(()),
        (Action::ForcePerArea(_), _) => contradiction(
            action,
            "acts over the surface of a `group`, so the load needs one",
        ),
        (Action::ForcePerLength(_), _) => contradiction(
            action,
            "acts along the curve of a `group`, so the load needs one",
        ),
        (Action::Pressure(_), _) => contradiction(
            action,
            "acts on the outline of a `group`, so the load needs one",
        ),
        _ => Ok(()),
    }
}

/// Refuses a couple of zero, in the plane about z.
fn require_couple(action: Field, Couple { about }: Couple, dimensions: usize) -> Checked {
    match dimensions {
        2 => require(about[2] != 0.0, action, NOT_IDLE, about[2]),
        _ => require(about != [0.0; 3], action, NOT_IDLE, about),
    }
}

/// Message about a load whose vector is zero.
fn idle_vector(dimensions: usize) -> &'static str {
    match dimensions {
        2 => "this load does nothing: give `x` or `y` a value",
        _ => "this load does nothing: give `x`, `y` or `z` a value",
    }
}

/// Message about a displacement without a component.
fn no_component(dimensions: usize) -> String {
    let names = Component::in_dimensions(dimensions)
        .iter()
        .map(|it| format!("`{}`", it.name()));
    format!(
        "needs one of {} or more",
        names.collect::<Vec<_>>().join(", ")
    )
}

pub(super) fn require(
    holds: bool,
    field: Field,
    expected: impl Into<Cow<'static, str>>,
    found: impl Debug,
) -> Checked {
    if holds {
        return Ok(());
    }
    let (expected, found) = (expected.into(), format!("{found:?}"));
    Err(field.error(Fault::OutOfRange { expected, found }))
}

/// Refuses numbers out of the ranges of their keys; `field` is the field of a key.
pub(super) fn in_range(of: &impl Ranged, field: impl Fn(&'static str) -> Field) -> Checked {
    refuse(of.out_of_range(), field)
}

/// Refuses a number out of its range; no number passes.
pub(super) fn within(range: Range<'_>, field: Field, number: impl Number) -> Checked {
    refuse(range.check("", &number), |_| field)
}

fn refuse(number: Option<OutOfRange>, field: impl Fn(&'static str) -> Field) -> Checked {
    let Some(OutOfRange {
        key,
        expected,
        found,
    }) = number
    else {
        return Ok(());
    };
    let expected = expected.into();
    Err(field(key).error(Fault::OutOfRange { expected, found }))
}

/// Refuses a value that is not finite and greater than zero; no value passes.
pub(super) fn positive(field: Field, value: Option<f64>) -> Checked {
    within(Range::POSITIVE, field, value)
}

pub(crate) fn contradiction(field: Field, reason: impl Into<Advice<Setting>>) -> Checked {
    Err(field.error(Fault::Contradiction(reason.into())))
}

pub(super) fn missing(field: Field, property: &'static str, reason: &str) -> Checked {
    let reason = reason.to_owned();
    Err(field
        .part(property)
        .error(Fault::Missing { property, reason }))
}

pub(super) fn require_unique<'a>(
    list: &'static str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Checked {
    for (index, name) in names.clone().enumerate() {
        if let Some(first) = names.clone().take(index).position(|it| it == name) {
            let fault = Fault::NameTwice {
                name: name.to_owned(),
                first: Field::element(list, first),
            };
            return Err(Field::element(list, index).part("name").error(fault));
        }
    }
    Ok(())
}

impl Setup {
    pub(super) fn check_far_field(&self) -> Checked {
        let Some(far_field) = &self.far_field else {
            return Ok(());
        };
        let field = Field::whole("far_field");
        if !matches!(self.body.origin(), Origin::Mesh(_) | Origin::SolidMesh(_)) {
            let reason = "the elements of the far field are the cells of a mesh: take a mesh";
            return contradiction(field, reason);
        }
        if !matches!(self.correction.surface, Surface::Patch(_)) {
            let text = "bonds and elements bear the same forces only where the bonds pass uniform strains exactly: take {}";
            let patch = Setting::Surface(Surface::Patch(patch::Settings::default()));
            return contradiction(
                Field::whole("correction").part("surface"),
                Advice::new(text, [patch]),
            );
        }
        match far_field.strength_share {
            Some(share) => self.check_growth(share),
            None if far_field.near.is_empty() => {
                let reason = "nothing says where bonds are: give places, or with `strength_share` a share of the strength from which on elements become bonds";
                contradiction(field.part("near"), reason)
            }
            None => Ok(()),
        }
    }

    /// Checks the numbers of a refinement.
    fn check_refinement(&self) -> Checked {
        let Some(refine) = &self.refine else {
            return Ok(());
        };
        let field = Field::whole("refine");
        match refine.fineness {
            Fineness::Size(size) => within(Refine::SIZE, field.part("size"), size)?,
            Fineness::Levels(levels) => within(Refine::LEVELS, field.part("levels"), levels)?,
        }
        within(
            Refine::STRENGTH_SHARE,
            field.part("strength_share"),
            refine.strength_share,
        )?;
        within(Refine::TOLERANCE, field.part("tolerance"), refine.tolerance)?;
        within(Refine::PASSES, field.part("passes"), refine.passes)?;
        within(Refine::PASSES, field.part("pass_number"), refine.pass)
    }

    /// Checks a near field that grows.
    fn check_growth(&self, share: f64) -> Checked {
        let field = Field::whole("far_field").part("strength_share");
        if !(share > 0.0 && share <= 1.0) {
            let reason = format!("a share of the strength is above 0 and at most 1, found {share}");
            return contradiction(field, reason);
        }
        let without = |it: &MaterialRegion| it.material.tensile_strength.is_none();
        match self.materials.iter().position(without) {
            Some(index) => {
                let field = Field::element("materials", index).part("tensile_strength");
                let reason = "the near field grows where elements reach a share of it: give it, or remove `far_field.strength_share`";
                contradiction(field, reason)
            }
            None => Ok(()),
        }
    }
}

impl Setup {
    /// Refuses distributions with factors out of range, a property that varies twice, and scatter that no criterion depends on.
    pub(super) fn check_scatter(&self) -> Checked {
        for (place, scatter) in self.scatter.iter().enumerate() {
            let field = Field::element("scatter", place);
            check_range(scatter, field)?;
            if !self.analysis.is_fracture() {
                return contradiction(field, "no bond breaks in this analysis: remove it");
            }
            let text = if self.scatter[..place].iter().any(|it| it.of == scatter.of) {
                "it varies at random already: take {}, or remove one of the two"
            } else if self.criteria.iter().any(|it| it.is_affected_by(scatter.of)) {
                continue;
            } else {
                match scatter.of {
                    Scattered::Strength => {
                        "no criterion has a limit from a strength or of its own, so that nothing varies: take {}"
                    }
                    Scattered::FractureEnergy => {
                        "no criterion takes the fracture energy, so that nothing varies: take {}"
                    }
                }
            };
            let other = Setting::Scattered(scatter.of.other());
            return contradiction(field.part("of"), Advice::new(text, [other]));
        }
        Ok(())
    }
}

/// Refuses a distribution with factors out of range, and a negative length.
fn check_range(scatter: &Scatter, field: Field) -> Checked {
    let (range, part, number) = match scatter.distribution {
        Distribution::Weibull { modulus } => (Distribution::MODULUS, "modulus", modulus),
        Distribution::Normal { deviation } => (Distribution::NORMAL, "deviation", deviation),
        Distribution::Lognormal { deviation } => (Distribution::DEVIATION, "deviation", deviation),
    };
    within(range, field.part(part), number)?;
    let length = field.part("correlation_length");
    within(
        Scatter::CORRELATION_LENGTH,
        length,
        scatter.correlation_length,
    )
}
