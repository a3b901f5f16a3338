//! Search for implausible values, such as values in other than SI units, and for cracks and criteria without an effect.

use std::f64::consts::TAU;

use ligament_analysis::Message;
use ligament_mesh::Mesh;
use ligament_model::failure::softening::Law as Softening;
use ligament_model::failure::{Choice, Criteria, NoLimit};
use ligament_model::{Elasticity, Material, PointCloud};

use crate::body::{Body, Origin};
use crate::coordinates::coordinates;
use crate::described::Described;
use crate::error::Fault;
use crate::setup::{Action, Analysis, Setup};

/// Smallest plausible Young's modulus of a body with small strains, Pa; a smaller value is probably in GPa.
const SOFTEST: f64 = 1e6;

/// Strength over Young's modulus, and stretch of a bond at its limit, that no material reaches: the theoretical strength of crystals is E/10
/// to E/15 (Orowan 1949).
const LARGEST_STRAIN: f64 = 0.1;

/// Smallest plausible fracture energy over Young's modulus, m: half of the energy of two surfaces of E a/20 each, with the distance of
/// atoms a of 0.2 nm (Orowan 1949).
const LEAST_ENERGY: f64 = 1e-11;

/// Smallest plausible density of a solid, kg/m^3.
const LIGHTEST: f64 = 10.0;

/// Characteristic length over the body's length above which no crack in the body softens completely.
const LONGEST: f64 = 10.0;

/// Kind of the message about criteria without a bond that may fail.
const NOTHING_FAILS: &str = "nothing-fails";

/// Angle of the cells at a node of the outline beyond which it is a re-entrant corner, degrees: that of an L is 270, those of a round hole of
/// eight edges are 225.
const RE_ENTRANT: f64 = 230.0;

/// Notes on properties of a setup that are rare but usually intended.
pub fn notes(setup: &Setup) -> Vec<Message> {
    let materials = setup.materials.iter().map(|it| &it.material);
    let auxetic = materials.filter_map(|material| {
        let poisson = match &material.elasticity {
            Elasticity::Isotropic(it) => it.poisson,
            Elasticity::Orthotropic(it) => it.poisson,
            Elasticity::Anisotropic(_) => return None,
        };
        (poisson < 0.0).then(|| {
            let material = words(material);
            let text = format!(
                "Poisson's ratio of {material} is negative ({poisson}): a body of it widens where it is pulled"
            );
            Message::new("auxetic", text)
        })
    });
    auxetic.collect()
}

/// Messages about implausible values of a setup and its model, with the points of the whole body; `criteria` has the limits of the bonds, `idle` the indices
/// of pre-cracks that cut no bond.
pub(crate) fn of_model<const D: usize>(
    Described { setup, names }: Described<'_>,
    cloud: &PointCloud<D>,
    criteria: &Criteria,
    idle: Vec<usize>,
) -> Vec<Message> {
    let mut found: Vec<Message> = Vec::new();
    for region in &setup.materials {
        found.extend(of_constants(&region.material, &setup.analysis));
        let softening = setup.criteria.iter().filter(|it| softens_by_energy(it));
        let lengths = softening.filter_map(|it| of_length(names, cloud, &region.material, it));
        found.extend(lengths.take(1));
    }
    // Limits follow from constants: where constants are implausible, only these are reported.
    let of_limits = of_limits(cloud, criteria).into_iter();
    let is_sound = found.is_empty();
    found.extend(of_limits.filter(|it| is_sound || it.kind == NOTHING_FAILS));
    found.extend(of_angles(setup));
    if !idle.is_empty() {
        found.push(cuts_nothing(&idle, names));
    }
    [setup.remarks.clone(), found].concat()
}

/// Message about pre-cracks that cut no bond, by their indices, one or more, ascending.
fn cuts_nothing(cracks: &[usize], body: &dyn Body) -> Message {
    let numbers: Vec<String> = cracks.iter().map(|it| (it + 1).to_string()).collect();
    let cracks = match numbers.as_slice() {
        [only] => format!("pre-crack {only} cuts"),
        several => format!("pre-cracks {} cut", several.join(", ")),
    };
    let [low, high] = corners(body).map(|it| coordinates(&it));
    let text = format!(
        "{cracks} no bond: the body, which reaches from ({low}) to ({high}) m, does not lie on both sides of it"
    );
    Message::new("idle-precrack", text).with_advice("are the coordinates in m?")
}

/// Message about an angle, rad, if it is more than a turn.
pub fn of_angle(what: &str, angle: f64) -> Option<Message> {
    (angle.abs() > TAU * (1.0 + 1e-9)).then(|| {
        let text = format!("{what} is {angle} rad, more than a whole turn");
        Message::new("large-angle", text).with_advice("angles are in rad (45 degrees are 0.7854)")
    })
}

/// Message about a body in plane stress without a thickness.
pub fn without_thickness() -> Message {
    let text =
        "the thickness of the body is not given, so the forces are those of a body 1 m thick";
    Message::new("no-thickness", text).with_advice("set `thickness`, in m")
}

/// The fault of bonds without a limit, with an implausible constant as its cause, if there is one.
pub(crate) fn without_limit(setup: &Setup, reason: NoLimit) -> Fault {
    let materials = setup.materials.iter();
    let mut causes = materials.flat_map(|it| of_constants(&it.material, &setup.analysis));
    let cause = causes.next().map(Box::new);
    Fault::NoLimit { reason, cause }
}

fn words(material: &Material) -> String {
    match material.name.as_str() {
        "" => "the material".to_owned(),
        name => format!("material `{name}`"),
    }
}

/// Smallest and largest modulus of a material, Pa.
fn moduli(elasticity: &Elasticity) -> [f64; 2] {
    let [one, other] = match elasticity {
        Elasticity::Isotropic(it) => [it.young; 2],
        Elasticity::Orthotropic(it) => it.young,
        Elasticity::Anisotropic(it) => [it.stiffness[(0, 0)], it.stiffness[(1, 1)]],
    };
    [one.min(other), one.max(other)]
}

fn of_constants(material: &Material, analysis: &Analysis) -> Vec<Message> {
    let [softest, stiffest] = moduli(&material.elasticity);
    // Modes are often computed in scaled units, in which the density is about 1.
    let is_light = material.density.is_some_and(|it| it < LIGHTEST);
    let has_own_units = is_light && matches!(analysis, Analysis::Modal(_));
    if softest < SOFTEST && !has_own_units {
        // Ratios to a wrong modulus would only repeat this.
        let material = words(material);
        let text = format!("Young's modulus of {material} is {softest} Pa, less than 1 MPa");
        let soft = Message::new("soft-material", text);
        return vec![soft.with_advice("moduli are in Pa (25 GPa is 25e9)")];
    }
    let strengths = [
        ("tensile_strength", material.tensile_strength),
        ("compressive_strength", material.compressive_strength),
    ];
    let strong = strengths.into_iter().filter_map(|(property, strength)| {
        let strength = strength.filter(|it| *it > LARGEST_STRAIN * stiffest)?;
        let text = format!(
            "the {property} of {} is {:.4} of its Young's modulus, and no material is as strong as a tenth",
            words(material),
            strength / stiffest
        );
        let advice = "strengths and moduli are in Pa (3 MPa is 3e6)";
        Some(Message::new("strong-material", text).with_advice(advice))
    });
    let energy = material.fracture_energy;
    let low = energy.filter(|it| *it < LEAST_ENERGY * softest);
    let low = low.map(|energy| {
        let text = format!(
            "the fracture energy of {} is {energy} J/m^2, less than new surfaces cost in any solid as stiff (E times 0.01 nm, {:.4} J/m^2)",
            words(material),
            LEAST_ENERGY * softest
        );
        let advice = "it is in J/m^2 (0.1 N/mm is 100 J/m^2)";
        Message::new("low-fracture-energy", text).with_advice(advice)
    });
    strong.chain(low).collect()
}

/// Whether opened bonds soften so that they dissipate the fracture energy.
fn softens_by_energy(choice: &Choice) -> bool {
    let Softening { softens, .. } = choice.after;
    let opens = choice.kind.measures.iter().any(|it| it.opens());
    softens && choice.parameter_from_energy().is_some() && opens
}

/// Message about the characteristic length E G_c/F_t^2 of a material where it does not fit the body; the limit of a criterion, if given,
/// replaces F_t/E.
fn of_length<const D: usize>(
    body: &dyn Body,
    cloud: &PointCloud<D>,
    material: &Material,
    choice: &Choice,
) -> Option<Message> {
    let [young, _] = moduli(&material.elasticity);
    let strength = choice.limit.map(|it| it * young);
    let strength = strength.or(material.tensile_strength)?;
    let length = young * material.fracture_energy? / strength.powi(2);
    let spacing = cloud.spacing.iter().copied().fold(f64::INFINITY, f64::min);
    let spacing = -cloud.subdomain.max(-spacing);
    let [low, high] = corners(body);
    let sides = low.iter().zip(&high).map(|(low, high)| high - low);
    let longest = sides.fold(0.0, f64::max);
    let material = words(material);
    let units = "check the units of fracture_energy (J/m^2) and strength (Pa)";
    if length < spacing {
        let text = format!(
            "the characteristic length of {material}, E G_c/F_t^2, is {length:.3e} m, less than the distance of points, {spacing:.3e} m: the \
             softening zone is smaller than the spacing"
        );
        let advice = format!("{units}, or take a finer body");
        Some(Message::new("short-characteristic-length", text).with_advice(advice))
    } else if length > LONGEST * longest {
        let text = format!(
            "the characteristic length of {material}, E G_c/F_t^2, is {length:.3e} m, more than ten times the body ({longest:.3e} m): no crack in \
             it can soften completely"
        );
        Some(Message::new("long-characteristic-length", text).with_advice(units))
    } else {
        None
    }
}

/// Corners of the box around a body, m.
pub fn corners(body: &dyn Body) -> [Vec<f64>; 2] {
    let points = 0..body.n_points() as u32;
    let along = |axis: usize| points.clone().map(move |it| body.position(it)[axis]);
    let axes = 0..body.position(0).len();
    [
        (axes.clone())
            .map(|axis| along(axis).fold(f64::INFINITY, f64::min))
            .collect(),
        axes.map(|axis| along(axis).fold(f64::NEG_INFINITY, f64::max))
            .collect(),
    ]
}

/// Messages about limits beyond small strains, and on criteria under which no bond has a limit.
fn of_limits<const D: usize>(cloud: &PointCloud<D>, criteria: &Criteria) -> Vec<Message> {
    let smallest = criteria.list.iter().map(|criterion| {
        let smallest = criterion
            .limit
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        (criterion, -cloud.subdomain.max(-smallest))
    });
    let smallest: Vec<_> = smallest.collect();
    if !smallest.is_empty() && smallest.iter().all(|(_, limit)| limit.is_infinite()) {
        let text = "no bond can fail, because every bond has an end in a [[no_fail]] part";
        return vec![Message::new(NOTHING_FAILS, text).with_advice("are its coordinates in m?")];
    }
    let large = smallest.into_iter().filter(|(criterion, limit)| {
        criterion.measure.opens() && limit.is_finite() && *limit > LARGEST_STRAIN
    });
    let large = large.map(|(criterion, limit)| {
        let text = format!(
            "by the criterion \"{}\" bonds reach their limits at {limit:.4}, and strains of more than {LARGEST_STRAIN} are not small",
            criterion.name
        );
        let advice = "a limit is a strain, strengths are in Pa, a fracture energy is in J/m^2 (0.1 N/mm is 100 J/m^2)";
        Message::new("large-limit", text).with_advice(advice)
    });
    large.collect()
}

/// Messages about angles of more than a turn, of materials, of criteria and of prescribed rotations.
fn of_angles(setup: &Setup) -> Vec<Message> {
    let mut angles: Vec<(String, f64)> = Vec::new();
    for region in &setup.materials {
        if let Elasticity::Orthotropic(it) = &region.material.elasticity {
            let what = format!("the angle of {}", words(&region.material));
            angles.push((what, it.angle));
        }
    }
    for choice in &setup.criteria {
        let given = [
            ("critical_angle", choice.critical_angle),
            ("friction_angle", choice.friction_angle),
        ];
        for (key, angle) in given {
            let what = format!("{key} of the criterion \"{}\"", choice.kind.word);
            angles.extend(angle.map(|it| (what, it)));
        }
    }
    for load in &setup.loads {
        if let Action::Displacement(motion) = load.action {
            let turns = motion.components().filter(|(it, _)| it.is_rotation());
            let what = |name| format!("{name} of load `{}`", load.name);
            angles.extend(turns.map(|(component, angle)| (what(component.name()), angle)));
        }
    }
    let of_more_than_a_turn = angles
        .into_iter()
        .filter_map(|(what, angle)| of_angle(&what, angle));
    of_more_than_a_turn.collect()
}

/// Place where the stress of the elastic body of a setup is singular, in words: the tip of a pre-crack, or a re-entrant corner of a mesh in the plane.
pub fn singular_place(setup: &Setup) -> Option<String> {
    if !setup.precracks.is_empty() {
        return Some("the tip of a pre-crack".to_owned());
    }
    let Origin::Mesh(mesh) = setup.body.origin() else {
        return None;
    };
    let corner = re_entrant_corner(mesh)?;
    let position = coordinates(&mesh.positions[corner as usize]);
    Some(format!("the re-entrant corner at ({position}) m"))
}

/// The first node of the outline with a re-entrant corner.
fn re_entrant_corner(mesh: &Mesh) -> Option<u32> {
    let angles = mesh.angles_at_nodes();
    let mut outline: Vec<u32> = mesh.outline().into_iter().flatten().collect();
    outline.sort_unstable();
    let mut outline = outline.into_iter();
    outline.find(|&node| angles[node as usize].to_degrees() > RE_ENTRANT)
}
