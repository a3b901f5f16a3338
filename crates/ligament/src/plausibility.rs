//! Search for implausible values, such as values in other than SI units, and for cracks and criteria without an effect.

use ligament_model::failure::softening::Law as Softening;
use ligament_model::failure::{Choice, Criteria, NoLimit};
use ligament_model::{Elasticity, Material, PointCloud};

use crate::body::Body;
use crate::described::Described;
use crate::error::Fault;
use crate::implausible::{Implausible, LARGEST_STRAIN, LEAST_ENERGY, Note};
use crate::setup::{Action, Analysis, Setup};

/// Smallest plausible Young's modulus of a body with small strains, Pa; a smaller value is probably in GPa.
const SOFTEST: f64 = 1e6;

/// Smallest plausible density of a solid, kg/m^3.
const LIGHTEST: f64 = 10.0;

/// Characteristic length over the body's length above which no crack in the body softens completely.
const LONGEST: f64 = 10.0;

/// Notes on properties of a setup that are rare but usually intended.
pub fn notes(setup: &Setup) -> Vec<Note> {
    let materials = setup.materials.iter().map(|it| &it.material);
    let auxetic = materials.filter_map(|material| {
        let poisson = match &material.elasticity {
            Elasticity::Isotropic(it) => it.poisson,
            Elasticity::Orthotropic(it) => it.poisson,
            Elasticity::Anisotropic(_) => return None,
        };
        (poisson < 0.0).then(|| Note::Auxetic {
            material: words(material),
            poisson,
        })
    });
    auxetic.collect()
}

/// Implausible values of a setup and its model, with the points of the whole body; `criteria` has the limits of the bonds, `idle` the indices
/// of pre-cracks that cut no bond.
pub(crate) fn of_model<const D: usize>(
    Described { setup, names }: Described<'_>,
    cloud: &PointCloud<D>,
    criteria: &Criteria,
    idle: Vec<usize>,
) -> Vec<Implausible> {
    let mut found: Vec<Implausible> = Vec::new();
    for region in &setup.materials {
        found.extend(of_constants(&region.material, &setup.analysis));
        let softening = setup.criteria.iter().filter(|it| softens_by_energy(it));
        let lengths = softening.filter_map(|it| of_length(names, cloud, &region.material, it));
        found.extend(lengths.take(1));
    }
    // Limits follow from constants: where constants are implausible, only these are reported.
    let of_limits = of_limits(cloud, criteria).into_iter();
    let is_sound = found.is_empty();
    found.extend(of_limits.filter(|it| is_sound || *it == Implausible::NothingFails));
    found.extend(of_angles(setup));
    if !idle.is_empty() {
        found.push(Implausible::CutsNothing {
            cracks: idle,
            corners: corners(names),
        });
    }
    [setup.remarks.clone(), found].concat()
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

fn of_constants(material: &Material, analysis: &Analysis) -> Vec<Implausible> {
    let [softest, stiffest] = moduli(&material.elasticity);
    // Modes are often computed in scaled units, in which the density is about 1.
    let is_light = material.density.is_some_and(|it| it < LIGHTEST);
    let has_own_units = is_light && matches!(analysis, Analysis::Modal(_));
    if softest < SOFTEST && !has_own_units {
        // Ratios to a wrong modulus would only repeat this.
        return vec![Implausible::Soft {
            material: words(material),
            young: softest,
        }];
    }
    let strengths = [
        ("tensile_strength", material.tensile_strength),
        ("compressive_strength", material.compressive_strength),
    ];
    let strong = strengths.into_iter().filter_map(|(property, strength)| {
        let strength = strength.filter(|it| *it > LARGEST_STRAIN * stiffest)?;
        Some(Implausible::Strong {
            material: words(material),
            property,
            strength,
            young: stiffest,
        })
    });
    let energy = material.fracture_energy;
    let low = energy.filter(|it| *it < LEAST_ENERGY * softest);
    let low = low.map(|energy| Implausible::LowEnergy {
        material: words(material),
        energy,
        young: softest,
    });
    strong.chain(low).collect()
}

/// Whether opened bonds soften so that they dissipate the fracture energy.
fn softens_by_energy(choice: &Choice) -> bool {
    let Softening { softens, .. } = choice.after.law;
    let opens = choice.kind.measures.iter().any(|it| it.opens());
    softens && choice.parameter_from_energy().is_some() && opens
}

/// Remark on the characteristic length E G_c/F_t^2 of a material where it does not fit the body; the limit of a criterion, if given,
/// replaces F_t/E.
fn of_length<const D: usize>(
    body: &dyn Body,
    cloud: &PointCloud<D>,
    material: &Material,
    choice: &Choice,
) -> Option<Implausible> {
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
    if length < spacing {
        Some(Implausible::ShortLength {
            material,
            length,
            spacing,
        })
    } else if length > LONGEST * longest {
        Some(Implausible::LongLength {
            material,
            length,
            body: longest,
        })
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

/// Remarks on limits beyond small strains, and on criteria under which no bond has a limit.
fn of_limits<const D: usize>(cloud: &PointCloud<D>, criteria: &Criteria) -> Vec<Implausible> {
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
        return vec![Implausible::NothingFails];
    }
    let large = smallest.into_iter().filter(|(criterion, limit)| {
        criterion.measure.opens() && limit.is_finite() && *limit > LARGEST_STRAIN
    });
    let large = large.map(|(criterion, limit)| Implausible::LargeLimit {
        criterion: criterion.name,
        limit,
    });
    large.collect()
}

/// Remarks on angles of more than a turn, of materials, of criteria and of prescribed rotations.
fn of_angles(setup: &Setup) -> Vec<Implausible> {
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
        .filter_map(|(what, angle)| Implausible::of_angle(what, angle));
    of_more_than_a_turn.collect()
}
