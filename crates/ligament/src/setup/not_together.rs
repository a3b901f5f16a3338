//! Features of a setup that do not go together, each pair with the reason.

use ligament_analysis::load_program::Amplitude;
use ligament_analysis::motion::{MotionSettings, Scheme};
use ligament_model::ElementKind;
use ligament_model::failure::{Choice, printed};
use ligament_model::law::rotational::RotationalScale;
use ligament_model::material::Space;
use ligament_model::scatter::Scattered;

use super::check::{Checked, contradiction};
use super::{
    Action, Analysis, ContactLaw, Horizon, Load, Probe, Quantity, Reading, Rigid, Setup, Support,
};
use crate::body::Origin;
use crate::error::Field;
use crate::plausibility::singular_place;

/// A feature that another one may exclude.
#[derive(Debug)]
pub struct Feature {
    /// Name, as pages print it.
    pub name: &'static str,
    /// The field of a setup that has the feature, if one has it.
    field: fn(&Setup) -> Option<Field>,
}

/// Two features that no setup has together.
#[derive(Debug)]
pub struct Exclusion {
    /// The feature that is refused.
    pub refused: &'static Feature,
    /// The feature beside which it is refused.
    pub beside: &'static Feature,
    /// The reason, with what to do about it; `{law}` stands for the name of the law, `{beside}` for that of the other feature.
    pub reason: &'static str,
    /// The page in `docs` that says more.
    pub page: &'static str,
}

impl Exclusion {
    /// The reason, with the name of a law.
    pub fn reason_beside(&self, law: &str) -> String {
        let reason = self.reason.replace("{beside}", self.beside.name);
        reason.replace("{law}", law)
    }
}

impl Setup {
    /// Refuses features that do not go together.
    pub(super) fn check_exclusions(&self) -> Checked {
        for pair in NOT_TOGETHER {
            if let Some(field) = (pair.refused.field)(self)
                && (pair.beside.field)(self).is_some()
            {
                return contradiction(field, pair.reason_beside(self.law.name()));
            }
        }
        Ok(())
    }
}

fn when(holds: bool, name: &'static str) -> Option<Field> {
    holds.then(|| Field::whole(name))
}

/// The first element of a list for which something holds.
fn first<T>(list: &'static str, of: &[T], holds: impl Fn(&T) -> bool) -> Option<Field> {
    of.iter()
        .position(holds)
        .map(|index| Field::element(list, index))
}

/// The first contact or rigid body whose law, and whether it has faces of cracks, satisfies a condition.
fn first_contact(setup: &Setup, holds: impl Fn(&ContactLaw, bool) -> bool) -> Option<Field> {
    let of_contact = first("contacts", &setup.contacts, |it| {
        holds(&it.law(), it.cracks)
    });
    let of_body = || {
        first("rigid_bodies", &setup.rigid_bodies, |it| {
            holds(&it.law, it.cracks)
        })
    };
    of_contact.or_else(of_body)
}

fn first_rigid(
    setup: &Setup,
    part: Option<&'static str>,
    holds: fn(&Rigid) -> bool,
) -> Option<Field> {
    let found = first("rigid_bodies", &setup.rigid_bodies, holds)?;
    Some(part.map_or(found, |it| found.part(it)))
}

fn motion_with(setup: &Setup, holds: fn(&MotionSettings) -> bool) -> bool {
    matches!(&setup.analysis, Analysis::Motion(settings) if holds(settings))
}

/// Whether all bonds are brittle and break by an energy.
fn breaks_by_energy(setup: &Setup) -> bool {
    let is_energy = |it: &Choice| it.limits_from() == Scattered::FractureEnergy;
    !setup.criteria.is_empty() && !softens(setup) && setup.criteria.iter().all(is_energy)
}

fn softens(setup: &Setup) -> bool {
    setup.criteria.iter().any(|it| it.after.softens)
}

macro_rules! features {
    ($($constant:ident = $name:literal, $field:expr;)*) => {
        $(static $constant: Feature = Feature { name: $name, field: $field };)*
    };
}

// Analyses.
features! {
    NATURAL_MODES = "natural modes", |it| when(matches!(it.analysis, Analysis::Modal(_)), "analysis");
    MOTION = "motions in time", |it| when(it.analysis.is_motion(), "analysis");
    EXPLICIT_STEPS = "explicit steps of a motion", |it| {
        when(motion_with(it, MotionSettings::is_explicit), "analysis")
    };
    IMPLICIT_STEPS = "implicit steps of a motion", |it| {
        when(motion_with(it, |it| !it.is_explicit()), "analysis")
    };
    STEPS_WITHOUT_INERTIA = "motions that follow equilibria where they can (`scheme = \"auto\"`)", |it| {
        let has_statics = |it: &MotionSettings| it.scheme == Scheme::Auto;
        when(motion_with(it, has_statics), "analysis")
    };
    NOT_EXPLICIT = "all analyses but explicit steps of a motion", |it| {
        when(!motion_with(it, MotionSettings::is_explicit), "analysis")
    };
    NO_TIME = "analyses without time", |it| when(!it.analysis.is_motion(), "analysis");
    NO_BREAKAGE = "analyses in which nothing breaks", |it| when(!it.analysis.is_fracture(), "analysis");
    EXACT_PATH = "the exact path", |it| when(matches!(it.analysis, Analysis::Event(_)), "analysis");
    STAGES_ON_EXACT_PATH = "stages on the exact path", |it| {
        when(matches!(it.analysis, Analysis::Event(_)) && !it.stages.is_empty(), "stages")
    };
    NO_LOAD_STEPS = "all analyses but load steps", |it| {
        when(!matches!(it.analysis, Analysis::Stepped(_)), "analysis")
    };
    BRITTLE_LOAD_STEPS = "load steps with brittle bonds", |it| {
        when(matches!(it.analysis, Analysis::Stepped(_)) && !softens(it), "analysis")
    };
    SOFTENING_IN_IMPLICIT_STEPS = "bonds that soften in implicit steps of a motion", |it| {
        when(motion_with(it, |it| !it.is_explicit()) && softens(it), "criteria")
    };
}

// Loads in time, stages and temperatures.
features! {
    STAGES = "stages", |it| when(!it.stages.is_empty(), "stages");
    LOAD_FACTORS = "load factors of the analysis", |it| match &it.analysis {
        Analysis::Stepped(it) => when(!it.load_factors.is_empty(), "analysis.load_factors"),
        _ => None,
    };
    REFINED_FIRST_BREAK = "a refined first breakage", |it| match &it.analysis {
        Analysis::Stepped(it) if it.refine_first_break != 0 => {
            Some(Field::whole("analysis").part("refine_first_break"))
        }
        _ => None,
    };
    STEPS_OF_STAGES = "steps of a stage", |it| {
        Some(first("stages", &it.stages, |it| it.steps.is_some())?.part("steps"))
    };
    CONTROL = "control by a probe or an energy", |it| {
        Some(first("stages", &it.stages, |it| it.control.is_some())?.part("control"))
    };
    CONTROL_BY_PROBES = "control by probes", |it| control(it, |it| matches!(it, Quantity::Probes(_)));
    CONTROL_BY_ENERGY = "control by the dissipated energy", |it| {
        control(it, |it| matches!(it, Quantity::DissipatedEnergy))
    };
    TIPS = "probes of a tip", |it| {
        let is_tip = |it: &Probe| matches!(it.reading, Reading::Tip(_));
        Some(first("probes", &it.probes, is_tip)?.part("reading"))
    };
    TEMPERATURES = "changes of temperature", |it| when(!it.temperatures.is_empty(), "temperatures");
    AMPLITUDES = "amplitudes of loads", |it| {
        Some(first("loads", &it.loads, |it| it.amplitude.is_some())?.part("amplitude"))
    };
    MOTIONS_IN_TIME = "prescribed velocities and accelerations", |it| {
        let is_in_time = |it: &Load| matches!(it.action, Action::Velocity(_) | Action::BaseAcceleration(_));
        Some(first("loads", &it.loads, is_in_time)?.part("action"))
    };
    INITIAL_VELOCITIES = "initial velocities", |it| first("initial_velocities", &it.initial_velocities, |_| true);
    QUIET_EDGES = "quiet edges", |it| first("quiet", &it.quiet, |_| true);
    INCLINED_ROLLERS = "inclined rollers without a stiffness", |it| {
        let is_rigid = |it: &Support| it.restrained_normal().is_some() && it.stiffness.normal.is_none();
        Some(first("supports", &it.supports, is_rigid)?.part("normal"))
    };
    PLATENS = "platens that tilt", |it| Some(first("loads", &it.loads, |it| it.tilts)?.part("tilts"));
}

// Faces of cracks, contacts and rigid bodies.
features! {
    CLOSING_FACES = "faces that close", |it| when(it.closing, "closing");
    FRICTION_OF_FACES = "friction on closed faces", |it| when(it.closing_friction > 0.0, "closing_friction");
    CONTACT = "contact between surfaces", |it| first_contact(it, |_, _| true);
    FRICTION = "friction between surfaces", |it| Some(first_contact(it, |it, _| it.friction > 0.0)?.part("friction"));
    FACES_AS_SURFACES = "faces of cracks that meet as surfaces", |it| {
        Some(first_contact(it, |_, cracks| cracks)?.part("cracks"))
    };
    UNSYMMETRIC_STIFFNESS = "laws whose stiffness is not symmetric, but in explicit steps", |it| {
        let is_symmetric = !matches!(it.law.element(), ElementKind::TrueStrain | ElementKind::Pairwise);
        let is_solved = !motion_with(it, MotionSettings::is_explicit);
        when(!is_symmetric && is_solved, "law")
    };
    MOVED_RIGID_BODIES = "displacements of rigid bodies", |it| {
        first_rigid(it, Some("displacement"), |it| it.displacement != [0.0; 3])
    };
    RIGID_VELOCITIES = "velocities of rigid bodies", |it| {
        first_rigid(it, Some("velocity"), |it| it.velocity != [0.0; 3])
    };
    FREE_RIGID_BODIES = "rigid bodies with a mass", |it| first_rigid(it, Some("mass"), |it| it.mass.is_some());
    RIGID_AMPLITUDES = "amplitudes of rigid bodies", |it| {
        first_rigid(it, Some("amplitude"), |it| it.amplitude != Amplitude::constant())
    };
    TURNING_RIGID_BODIES = "rigid bodies that turn", |it| {
        first_rigid(it, Some("inertia"), |it| it.mass.is_some() && it.inertia.is_some())
    };
}

// Materials and the far field.
features! {
    SOLIDS = "solids", |it| when(matches!(it.space(), Space::Solid), "section");
    AXES_OF_MATERIALS = "orthotropic and anisotropic materials", |it| {
        let has_axes = first("materials", &it.materials, |it| it.material.elasticity.isotropic().is_none());
        Some(has_axes?.part("elasticity"))
    };
    COSSERAT_LENGTHS = "Cosserat lengths", |it| {
        let has_length = matches!(it.rotational_scale, RotationalScale::CosseratLength(_));
        has_length.then(|| Field::whole("rotational_scale").part("length"))
    };
    STIFFNESS_OF_CELLS = "a Poisson's ratio above that of central forces, whose volumetric stiffness the cells have", |it| {
        let moduli = it.moduli_of_cells()?;
        Some(first("materials", &moduli, |modulus| *modulus > 0.0)?.part("elasticity"))
    };
    POINTS_ALONE = "bodies of points without cells", |it| when(matches!(it.body.origin(), Origin::Points), "body");
    INTERFACES = "interfaces with strengths of their own", |it| first("interfaces", &it.interfaces, |_| true);
    PRINTED_CRITERIA = "criteria of `mbb-pd` as printed", |it| {
        let printed = [printed::OPENING, printed::SLIDING, printed::MIXED].map(|it| it.word);
        first("criteria", &it.criteria, |choice| printed.contains(&choice.kind.word))
    };
    PRECRACKS_ALONG_CURVES = "pre-cracks along groups of curves", |it| {
        let is_plane = it.dimensions() == 2;
        first("precracks", &it.precracks, |crack| is_plane && crack.is_along_group())
    };
    SEVERAL_PROCESSES = "several processes", |it| when(it.solver.communicator.0.size() > 1, "solver");
    REFINEMENT = "refinement where bonds break", |it| when(it.refine.is_some(), "refine");
    ONE_HORIZON = "one horizon for all points", |it| {
        when(matches!(it.horizon, Horizon::Length(_)), "horizon")
    };
    BODIES_WITHOUT_MESH = "lattices and bodies of points", |it| {
        when(!matches!(it.body.origin(), Origin::Mesh(_) | Origin::SolidMesh(_)), "body")
    };
    UNCORRELATED_STRENGTH = "a random strength or fracture energy without a correlation length", |it| {
        first("scatter", &it.scatter, |it| it.correlation_length == 0.0)
    };
    ENERGY_WITHOUT_CRACK = "brittle bonds with a limit of energy in a body without a crack or a re-entrant corner", |it| {
        when(breaks_by_energy(it) && it.body.n_cells() > 0 && singular_place(it).is_none(), "criteria")
    };
    FAR_FIELD = "a far field", |it| when(it.far_field.is_some(), "far_field");
    GROWING_NEAR_FIELD = "a near field that grows", |it| {
        let grows = it.far_field.as_ref().is_some_and(|it| it.strength_share.is_some());
        grows.then(|| Field::whole("far_field").part("strength_share"))
    };
}

fn control(setup: &Setup, holds: fn(&Quantity) -> bool) -> Option<Field> {
    let controls = |it: &super::Stage| it.control.as_ref().is_some_and(|it| holds(&it.quantity));
    Some(first("stages", &setup.stages, controls)?.part("control"))
}

/// Reason why what depends on time is refused in an analysis without time.
const WITHOUT_TIME: &str =
    "there is no time in this analysis, only in a motion: remove it, or take a motion";

/// Reason why a rigid body takes nothing that depends on time in an analysis without time.
const RIGID_WITHOUT_TIME: &str = "there is no time in this analysis, only in a motion: give a `displacement`, which grows with the load factor";

/// Reason why a far field excludes what needs bonds everywhere.
const BONDS_EVERYWHERE: &str = "elements of a far field do not take {beside}: remove one of both";

macro_rules! pairs {
    ($($refused:ident, $beside:ident, $page:literal, $reason:expr;)*) => {
        &[$(Exclusion { refused: &$refused, beside: &$beside, reason: $reason, page: $page },)*]
    };
}

/// Pairs of features that do not go together. The first pair that a setup has is its error.
pub static NOT_TOGETHER: &[Exclusion] = pairs! {
    AXES_OF_MATERIALS, SOLIDS, "space.md", "solids take isotropic materials only: `young` and `poisson`";
    COSSERAT_LENGTHS, SOLIDS, "space.md", "a Cosserat length is one of the plane: take a factor";
    FRICTION_OF_FACES, EXACT_PATH, "fracture.md", "friction on closed faces depends on the way to a state and is not in proportion to the load between two \
        breakages, so that the exact path does not follow it: take load steps";
    CLOSING_FACES, NATURAL_MODES, "modes.md", "natural modes assume that crack faces do not close: remove it";
    CLOSING_FACES, STAGES_ON_EXACT_PATH, "programmes.md", "with a part of the load that stays, faces open and close between two breakages, and the exact \
        path does not follow that: take load steps, or let all loads grow with one factor";
    STIFFNESS_OF_CELLS, POINTS_ALONE, "laws.md", "bonds alone cannot have this Poisson's ratio and stay stable, and points without cells have bonds \
        alone: take a mesh or a lattice, a Poisson's ratio of at most 1/4 (in plane stress 1/3), or `model.poisson = \"bonds\"` for a body that does not \
        crack";
    STIFFNESS_OF_CELLS, SEVERAL_PROCESSES, "ranks.md", "the cells around a point may belong to several processes, which do not exchange them: take one \
        process, or a Poisson's ratio of at most 1/4 (in plane stress 1/3)";
    INTERFACES, NO_BREAKAGE, "fracture.md", "an interface has strengths, and nothing breaks without a [fracture] section";
    INTERFACES, PRINTED_CRITERIA, "fracture.md", "their limits belong to points, and an interface has those of bonds: take `mixed-mode`";
    PRECRACKS_ALONG_CURVES, SEVERAL_PROCESSES, "ranks.md", "the first process alone has the edges of the mesh: take one process, or give the corners \
        of the line as `points`";
    FAR_FIELD, CLOSING_FACES, "far-field.md", BONDS_EVERYWHERE;
    FAR_FIELD, CONTACT, "far-field.md", BONDS_EVERYWHERE;
    FAR_FIELD, TEMPERATURES, "far-field.md", BONDS_EVERYWHERE;
    REFINEMENT, ONE_HORIZON, "refinement.md", "with one horizon for all points a finer mesh has more bonds a point and no shorter ones: give \
        `horizon_factor` in the place of `horizon`";
    REFINEMENT, BODIES_WITHOUT_MESH, "refinement.md", "only the cells of a mesh can be bisected: take a mesh";
    REFINEMENT, MOTION, "refinement.md", "each pass begins anew from the unloaded body, and waves of a motion would not find the places again: take load steps \
        or the exact path, or a mesh that is fine from the start";
    REFINEMENT, NO_BREAKAGE, "refinement.md", "the mesh is refined where bonds break, and nothing breaks in this analysis: remove it";
    REFINEMENT, SEVERAL_PROCESSES, "ranks.md", "the mesh is refined on one process: take one, and give the others its `mesh.msh`";
    REFINEMENT, UNCORRELATED_STRENGTH, "refinement.md", "each mesh would have another sample, whose weakest point depends on the number of points: \
        give a `correlation_length`";
    REFINEMENT, ENERGY_WITHOUT_CRACK, "refinement.md", "without a crack the strength by an energy falls as 1/sqrt(H), so that cracks would begin \
        wherever the mesh is coarse: give a pre-crack, or a criterion of stress";
    GROWING_NEAR_FIELD, NO_BREAKAGE, "far-field.md", "nothing breaks in this analysis, so that elements need not become bonds: remove it, and give places in \
        `near`";
    TIPS, MOTION, "cracks.md", "the integral around the tip is that of equilibria, without inertia: read stresses or energies instead";
    TIPS, TEMPERATURES, "cracks.md", "the integral around the tip is that of a body without strains by temperature: read stresses or energies instead";
    TIPS, FRICTION_OF_FACES, "cracks.md", "the integral around the tip is that of faces without friction: remove it";
    STAGES, MOTION, "motion.md", "a motion has no stages: let each load follow its `amplitude`";
    TEMPERATURES, MOTION, "motion.md", "a motion takes no changes of temperature, which would act at once at time zero";
    INCLINED_ROLLERS, EXPLICIT_STEPS, "motion.md", "an inclined roller is held by springs so stiff that explicit steps would be a thousand times \
        shorter: give it a `stiffness` along its normal, or an axis as its normal";
    PLATENS, EXPLICIT_STEPS, "motion.md", "a platen is so stiff that explicit steps would be a thousand times shorter: leave `tilts` out";
    AMPLITUDES, NO_TIME, "motion.md", WITHOUT_TIME;
    MOTIONS_IN_TIME, NO_TIME, "motion.md", WITHOUT_TIME;
    INITIAL_VELOCITIES, NO_TIME, "motion.md", WITHOUT_TIME;
    QUIET_EDGES, NO_TIME, "motion.md", WITHOUT_TIME;
    STAGES, NATURAL_MODES, "modes.md", "modes are free vibrations without loads, so there are no stages";
    LOAD_FACTORS, STAGES, "programmes.md", "the load steps are those of the stages: give each stage its `steps` in the place of these";
    REFINED_FIRST_BREAK, STAGES, "programmes.md", "the first breakage is not predicted for stages: give more `steps` to the stage in which it comes";
    STEPS_OF_STAGES, NO_LOAD_STEPS, "programmes.md", "only load steps have a number: the exact path goes from breakage to breakage, and an elastic solution \
        is taken at the end of each part of a stage; remove it";
    CONTROL_BY_PROBES, NO_LOAD_STEPS, "programmes.md", "a probe controls load steps: the exact path passes peaks and snap-backs by itself, and an elastic \
        solution has none";
    CONTROL_BY_ENERGY, BRITTLE_LOAD_STEPS, "programmes.md", "brittle bonds take their energy all at once, so that load steps cannot follow it: let bonds \
        soften (`after`), or take the exact path, which goes from breakage to breakage";
    CONTROL_BY_ENERGY, NO_BREAKAGE, "programmes.md", "nothing is dissipated where bonds neither soften nor break";
    CONTACT, NATURAL_MODES, "modes.md", "natural modes assume that no surfaces touch: remove it";
    FRICTION, EXACT_PATH, "contact.md", "what slides depends on the way and not on the load alone, and the exact path goes from breakage to breakage in \
        straight lines: remove the friction, or take load steps";
    CONTACT, STAGES_ON_EXACT_PATH, "contact.md", "the exact path through stages does not follow surfaces that meet on the way: let all loads grow together, \
        or take load steps";
    CONTACT, UNSYMMETRIC_STIFFNESS, "contact.md", "the stiffness of the law \"{law}\" is not symmetric, and equilibria with contact need one that is: take \
        another law, or explicit steps of a motion";
    CONTACT, CONTROL, "contact.md", "a stage with `control` finds its load along straight lines, and contact bends them: let loads lead";
    FACES_AS_SURFACES, CLOSING_FACES, "contact.md", "the faces of cracks carry pressure already, by `closing`: give one of both";
    FACES_AS_SURFACES, NOT_EXPLICIT, "contact.md", "the faces of cracks meet as surfaces in explicit steps alone; elsewhere let them close by `closing`";
    MOVED_RIGID_BODIES, MOTION, "contact.md", "a displacement grows with the load factor, which a motion does not have: give a `velocity` and an `amplitude`";
    RIGID_VELOCITIES, NO_TIME, "contact.md", RIGID_WITHOUT_TIME;
    FREE_RIGID_BODIES, NO_TIME, "contact.md", RIGID_WITHOUT_TIME;
    RIGID_AMPLITUDES, NO_TIME, "contact.md", RIGID_WITHOUT_TIME;
    MOVED_RIGID_BODIES, STAGES, "contact.md", "with stages each load has a factor of its own, and a rigid body has none: let it rest and move the body by a load";
    TURNING_RIGID_BODIES, IMPLICIT_STEPS, "contact.md", "a rigid body turns in explicit steps alone: remove it, or take explicit steps";
    FREE_RIGID_BODIES, SOFTENING_IN_IMPLICIT_STEPS, "contact.md", "implicit steps move rigid bodies beside bonds that do not soften: take explicit steps, or \
        brittle bonds";
    FREE_RIGID_BODIES, STEPS_WITHOUT_INERTIA, "contact.md", "a body with a mass that nothing holds has no equilibrium from which a motion could begin: take \
        `scheme = \"implicit\"`, or move it by a velocity";
};
