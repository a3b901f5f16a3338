//! Messages about a model that concern the trust in its results.

mod correction;
mod criteria;
mod platen;
mod refinement;
mod volumetric;

use ligament_analysis::Message;
use ligament_model::correction::{CorrectionReport, DomainReport};
use ligament_model::failure::softening::linear;
use ligament_model::failure::{Choice, Criteria};
use ligament_model::law::stability::NegativeShear;
use ligament_model::material::Space;
use ligament_model::subdomain::Subdomain;
use ligament_model::{ConstantFields, ElementKind, Isotropic};

use self::correction::{Worst, off_energies};
use self::criteria::{below_strength, rotation_as_sliding, stress_without_patch};
use crate::body::{Body, Origin};
use crate::described::Described;
use crate::plausibility::corners;
use crate::setup::{Horizon, MaterialRegion, Reading, Setup, Tip};

pub use criteria::few_bonds;
pub(crate) use refinement::of_refinement;
pub(crate) use volumetric::without_edges;

/// Horizon factor below which the domain correction is not known to have a fixed point.
const SMALLEST_SAFE_FACTOR: f64 = 2.0;

/// Relative error of a point's energy under uniaxial strain above which a warning names the point.
const ENERGY_TOLERANCE: f64 = 1e-4;

/// Usual horizon over the distance between points.
const USUAL_FACTOR: f64 = 3.0;

/// Length of a body, m, above which its coordinates are probably in millimetres.
const SUSPICIOUSLY_LARGE: f64 = 20.0;

/// Tolerance of the Poisson's ratio that a law fixes: users write 0.333.
const POISSON_TOLERANCE: f64 = 1e-3;

/// Horizons around a tip within which bonds smear its field.
const SMEARED: f64 = 2.0;

/// Relative rounding of a radius that is meant to be two horizons.
const ROUNDING: f64 = 1e-9;

/// A position (m) as text for warnings.
fn place(position: &[f64]) -> String {
    let coordinates = position.iter().map(|it| format!("{it:.4}"));
    coordinates.collect::<Vec<_>>().join(", ")
}

/// Warnings about the body with all its points, the horizons over the distances (n_points, m) of nearest points, the correction, pre-cracks
/// (`touched`: number of bonds that only touch an end of one) and the materials.
pub(crate) fn of_model(
    Described { setup, names: body }: Described<'_>,
    points: (&Subdomain, &[f64]),
    correction: Option<&CorrectionReport>,
    fixed: &ConstantFields,
    touched: usize,
) -> Vec<Message> {
    let (subdomain, _) = points;
    let remarks = setup.body.remarks().into_iter();
    let mut warnings: Vec<Message> = remarks.map(|it| Message::new("mesh", it)).collect();
    warnings.extend(large_body(length(body)));
    warnings.extend(large_horizon((body, subdomain), fixed));
    if let Some(CorrectionReport::Domain(_)) = correction {
        warnings.extend(small_horizon(setup, points, fixed));
    }
    let (factor, _) = smallest_factor(setup, points, fixed);
    warnings.extend(few_bonds(&setup.criteria, factor));
    match correction {
        Some(CorrectionReport::Domain(report)) if !report.converged => {
            warnings.push(not_converged((body, subdomain), report, fixed));
        }
        Some(CorrectionReport::Patch(report)) if report.left > largest_left(setup.space()) => {
            let (factor, _) = smallest_factor(setup, points, fixed);
            let enough = patch_factor(setup.space());
            let better = (factor < enough).then_some(enough);
            let residual = &fixed.patch_residual;
            warnings.push(not_met((body, subdomain), (report.left, residual), better));
        }
        _ => {}
    }
    if touched > 0 {
        let text = format!(
            "{touched} bonds along the outline only touch an end of a pre-crack and stay whole"
        );
        let advice = "start the crack a little outside, or set `ends = \"included\"`";
        warnings.push(Message::new("touched-bonds", text).with_advice(advice));
    }
    if setup.probes.iter().any(|it| it.reading.is_stress()) {
        warnings.extend(of_virial_stress(&setup.body.origin()));
    }
    if subdomain.is_whole() {
        warnings.extend(of_rings(setup, body, fixed));
    }
    warnings.extend(scatter_below_spacing(setup, points));
    let mut laws = setup.criteria.iter().map(|it| &it.after);
    if laws.any(|law| *law == linear::BILINEAR) {
        warnings.push(Message::new(
            "one-line",
            "after = \"bilinear\" is the older word for \"linear\", one straight line down; the two lines that concrete has, to a third of the force \
             and then to zero, are \"two-branch\"",
        ));
    }
    warnings.extend(of_constants(setup));
    let (factor, _) = smallest_factor(setup, points, fixed);
    warnings.extend(platen::early_at_platen(setup, factor));
    warnings.extend(curve_of_another_material(setup));
    warnings
}

/// Warning about the first ring that begins within two horizons from its tip; on one process.
fn of_rings(setup: &Setup, body: &dyn Body, fixed: &ConstantFields) -> Option<Message> {
    setup.probes.iter().find_map(|probe| {
        let Reading::Tip(Tip {
            position,
            radii: Some([inner, _]),
            ..
        }) = probe.reading
        else {
            return None;
        };
        let distance = |point: usize| {
            let place = body.position(point as u32);
            let squares = place.iter().zip(position).map(|(a, b)| (a - b).powi(2));
            squares.sum::<f64>()
        };
        let points = 0..fixed.horizon.len();
        let nearest = points.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
        let smeared = SMEARED * fixed.horizon[nearest];
        (inner < smeared * (1.0 - ROUNDING)).then(|| {
            let text = format!(
                "the ring of the probe `{}` begins {inner:e} m from the tip, within two horizons ({smeared:e} m), where the bonds smear the field",
                probe.name
            );
            let advice = "take larger `radii` or a smaller horizon, or compare with another ring";
            Message::new("ring-near-tip", text).with_advice(advice)
        })
    })
}

/// Warning where a curve of softening in m and Pa has another strength or area than a material.
fn curve_of_another_material(setup: &Setup) -> Option<Message> {
    /// Relative difference of values that were rounded.
    const ROUNDED: f64 = 0.02;
    let curves = setup
        .criteria
        .iter()
        .filter_map(|it| it.after.given_curve());
    let mut in_units = curves.filter(|it| it.strength() != 1.0);
    in_units.find_map(|curve| {
        let own = [curve.strength(), curve.area()];
        let known = |it: &MaterialRegion| {
            let material = &it.material;
            [material.tensile_strength, material.fracture_energy]
        };
        let differs = |known: &[Option<f64>; 2]| {
            let mut pairs = own.iter().zip(known);
            pairs.any(|(own, known)| known.is_some_and(|it| (own / it - 1.0).abs() > ROUNDED))
        };
        let [strength, energy] = setup.materials.iter().map(known).find(differs)?;
        let words = |value: Option<f64>| value.map_or("none".to_owned(), |it| format!("{it:.4e}"));
        let text = format!(
            "the curve of softening has a strength of {:.4e} Pa and an area of {:.4e} J/m^2, and the material has tensile_strength = {} and \
             fracture_energy = {}: the shape of the curve counts, with the values of the material",
            own[0],
            own[1],
            words(strength),
            words(energy)
        );
        Some(Message::new("curve-and-material", text))
    })
}

/// Warnings about the constants of the materials with the law and the criteria of a setup.
fn of_constants(setup: &Setup) -> Vec<Message> {
    let materials = setup.materials.iter();
    let constants: Vec<Isotropic> = materials
        .filter_map(|it| it.material.elasticity.isotropic())
        .collect();
    let poisson = constants.iter().filter_map(|it| of_poisson(setup, it));
    let mut warnings: Vec<Message> = poisson.collect();
    warnings.extend(constants.iter().find_map(|it| rotation_resisted(setup, it)));
    warnings.extend(rotation_as_sliding(setup));
    warnings.extend(stress_without_patch(setup));
    warnings.extend(
        constants
            .iter()
            .filter_map(|it| energy_given_back(setup, it)),
    );
    let of_cells = [volumetric::crack_excess, volumetric::short_step];
    warnings.extend(
        constants
            .iter()
            .flat_map(|it| of_cells.map(|of| of(setup, it)))
            .flatten(),
    );
    warnings
}

/// Warning about virial stresses at irregular points, for all bodies but lattices.
pub fn of_virial_stress(origin: &Origin<'_>) -> Option<Message> {
    let is_regular = matches!(origin, Origin::Lattice(_) | Origin::SolidLattice(_));
    (!is_regular).then(|| {
        let text = "virial stresses (output.stress, probes of stress_virial.xx and so on) are right only in the mean over the body: at single points of an \
                    irregular mesh their error is 10 to 25 % inside the body and 30 % or more at its edges, also with the patch correction";
        let advice = "take output.stress = [\"material\"] and probes of stress.xx instead";
        Message::new("virial-stress", text).with_advice(advice)
    })
}

/// Largest root mean square residual of the patch correction's scaled equations without a warning.
///
/// Above the value of the plane, uniform strains have errors of percents. Edges and corners of solids have larger residuals and smaller
/// errors: measured on boxes, balls and cases, bodies of two cells and more across have residuals of .06 to 2.3 % at factors of 2.5 and 3,
/// with errors of .1 % in E, .0003 in nu and .6 % in the strains of bonds; thinner or sharper bodies have 2 to 12 %, with errors of .8 to
/// 2.5 % in the strains of bonds.
fn largest_left(space: Space) -> f64 {
    match space {
        Space::Plane(_) => 5e-3,
        Space::Solid => 2e-2,
    }
}

/// Horizon factor from which bodies satisfy the equations of the patch correction: tetrahedra have residuals of 3 % at 2, below 1 % at 2.5
/// and 3.
fn patch_factor(space: Space) -> f64 {
    match space {
        Space::Plane(_) => 3.0,
        Space::Solid => 2.5,
    }
}

fn small_horizon(
    setup: &Setup,
    points: (&Subdomain, &[f64]),
    fixed: &ConstantFields,
) -> Option<Message> {
    let (factor, is_given) = smallest_factor(setup, points, fixed);
    (factor < SMALLEST_SAFE_FACTOR).then(|| {
        let small = match is_given {
            true => format!("model.horizon_factor = {factor} is"),
            false => format!(
                "the horizon is {factor:.4} times the distance to the nearest point for some points,"
            ),
        };
        let text = format!(
            "{small} less than {SMALLEST_SAFE_FACTOR}: the domain correction may have no fixed point, and peak loads then depend on the number \
             of sweeps"
        );
        Message::new("small-horizon", text)
    })
}

/// The smallest horizon of a point over the distance to its nearest point, and whether the setup gives it.
fn smallest_factor(
    setup: &Setup,
    (subdomain, spacing): (&Subdomain, &[f64]),
    fixed: &ConstantFields,
) -> (f64, bool) {
    match setup.horizon {
        Horizon::Factor(factor) => (factor, true),
        Horizon::Length(_) => {
            let factors = fixed.horizon.iter().zip(spacing);
            let factors = factors.map(|(horizon, nearest)| horizon / nearest);
            let smallest = factors.fold(f64::INFINITY, f64::min);
            (-subdomain.max(-smallest), false)
        }
    }
}

fn scatter_below_spacing(
    setup: &Setup,
    (subdomain, spacing): (&Subdomain, &[f64]),
) -> Option<Message> {
    let spacing = subdomain.max(spacing.iter().copied().fold(0.0, f64::max));
    let lengths = setup.scatter.iter().map(|it| it.correlation_length);
    let below = lengths.filter(|length| *length > 0.0 && *length < spacing);
    let length = below.reduce(f64::min)?;
    let text = format!(
        "fracture.scatter.correlation_length = {length:.4e} m is less than the largest distance between points, {spacing:.4e} m: there the \
         spacing of the points limits the correlation"
    );
    let advice = "take a finer body or a greater length (0: each point independent)";
    Some(Message::new("scatter-below-spacing", text).with_advice(advice))
}

/// Message about a body of this length, m, if its coordinates are probably in millimetres.
pub fn large_body(length: f64) -> Option<Message> {
    (length > SUSPICIOUSLY_LARGE).then(|| {
        let text = format!("the body is {length:.1} m across");
        let advice = "is the mesh in mm? Lengths are in m, so scale it: `mesh.scale = 1e-3` in the case, or `ligament mesh --scale 1e-3`";
        Message::new("large-body", text).with_advice(advice)
    })
}

/// Longest side of the box around a body, m.
fn length(body: &dyn Body) -> f64 {
    let [low, high] = corners(body);
    let sides = low.iter().zip(&high).map(|(low, high)| high - low);
    sides.fold(0.0, f64::max)
}

fn large_horizon(
    (body, subdomain): (&dyn Body, &Subdomain),
    fixed: &ConstantFields,
) -> Option<Message> {
    let length = length(body);
    let horizons = (0..).zip(&fixed.horizon);
    let smallest = horizons.min_by(|one, other| one.1.total_cmp(other.1));
    let numbered = smallest.map(|(point, &it)| [it, f64::from(subdomain.number(point))]);
    let [horizon, point] = subdomain.all_reduce_min(numbered)?;
    (horizon > 0.5 * length).then(|| {
        let text = format!(
            "the horizon of {} is {horizon:.4e} m, more than half of the body's length of {length:.4e} m: nearly all points are bonded to each \
             other, and the answer is not that of the material",
            body.place(point as u32)
        );
        Message::new("large-horizon", text).with_advice("a horizon factor of 3 is usual")
    })
}

fn not_met(
    (body, subdomain): (&dyn Body, &Subdomain),
    (left, residual): (f64, &[f64]),
    factor: Option<f64>,
) -> Message {
    let Worst { point, value } = Worst::new(subdomain, |point| residual[point as usize]);
    let text = format!(
        "the patch correction cannot make every uniform strain an equilibrium: forces of {:.2} % of the size of their terms are left in the mean, \
         of {:.0} % at worst ({} at {})",
        100.0 * left,
        100.0 * value,
        body.label(point),
        place(&body.position(point))
    );
    let advice = format!(
        "{}, or take correction.surface = \"domain\"",
        more_bonds(factor)
    );
    Message::new("patch-not-met", text).with_advice(advice)
}

fn not_converged(
    (body, subdomain): (&dyn Body, &Subdomain),
    correction: &DomainReport,
    fixed: &ConstantFields,
) -> Message {
    let asked = (body.position(0).len(), ENERGY_TOLERANCE);
    let (off, Worst { point, value }) = off_energies(subdomain, fixed, asked);
    let text = format!(
        "the domain correction did not converge in {} sweeps (last change {:.2e}): {off} of {} points have energies off by more than \
         {ENERGY_TOLERANCE}, the worst by {value:.1e} ({} at {})",
        correction.sweeps,
        correction.last_change,
        subdomain.n_all(),
        body.label(point),
        place(&body.position(point))
    );
    Message::new("domain-not-converged", text).with_advice("more correction.max_sweeps may help")
}

/// Advice for a body that does not satisfy the equations of the patch correction.
fn more_bonds(factor: Option<f64>) -> String {
    match factor {
        Some(factor) => format!("more bonds per point help (model.horizon_factor = {factor})"),
        None => "smaller cells help where the body is thin or edges are sharp".to_owned(),
    }
}

/// Warning about bonds with a positive shear stiffness between points without rotations.
fn rotation_resisted(setup: &Setup, material: &Isotropic) -> Option<Message> {
    let (poisson, limit) = poisson_and_limit(setup, material);
    let resists = setup.law.row.resists_rotations() && poisson < limit - POISSON_TOLERANCE;
    resists.then(|| {
        let text = format!(
            "law = \"{}\": points have no rotations, so every rotation of the body costs energy: in bending, torsion and shear the body is up to tens \
             of times too stiff, although Young's modulus is right",
            setup.law.name()
        );
        let advice = "take \"mppd\" or \"nhpd\", which have rotations";
        Message::new("rotation-resisted", text).with_advice(advice)
    })
}

fn energy_given_back(setup: &Setup, material: &Isotropic) -> Option<Message> {
    // Bonds that begin to soften by the stress around them count a negative shear stiffness as none.
    let by_energy = |it: &&Choice| {
        let measures = it.kind.measures;
        measures.iter().any(|it| it.needs_shear_stiffness())
            && !measures.iter().any(|it| it.takes_stress())
    };
    let criterion = setup.criteria.iter().find(by_energy)?.kind.word;
    let (poisson, limit) = poisson_and_limit(setup, material);
    let gives_energy = poisson > limit
        && !setup.law.row.fixes_poisson
        && volumetric::split(setup, material).is_none();
    gives_energy.then(|| {
        let text = format!(
            "criterion \"{criterion}\": above Poisson's ratio {limit:.4} (here {poisson}) shear lowers the energy of the bonds, and those nearly \
             along a crack never fail"
        );
        Message::new("energy-given-back", text).with_advice("\"critical-stretch\" breaks them")
    })
}

fn of_poisson(setup: &Setup, material: &Isotropic) -> Option<Message> {
    let (poisson, limit) = poisson_and_limit(setup, material);
    if volumetric::split(setup, material).is_some() {
        return None;
    }
    if setup.law.row.fixes_poisson {
        let differs = (poisson - limit).abs() > POISSON_TOLERANCE;
        return differs.then(|| {
            let text = format!(
                "Poisson's ratio {poisson} has no effect: bonds that resist stretch alone have {limit:.4}"
            );
            Message::new("poisson-not-used", text)
        });
    }
    let stiffness = match setup.law.element() {
        ElementKind::Beam => "shear and rotational stiffness of the bonds are negative",
        ElementKind::Spring => "the shear stiffness of the bonds is negative",
        ElementKind::Imaginary | ElementKind::TrueStrain | ElementKind::Pairwise => return None,
    };
    let horizon_factor = match setup.horizon {
        Horizon::Factor(factor) => factor,
        // A horizon of one length has no factor: the usual one is assumed.
        Horizon::Length(_) => USUAL_FACTOR,
    };
    (poisson > limit).then(|| {
        let text = match setup.space() {
            Space::Plane(_) => format!(
                "Poisson's ratio {poisson} is greater than {limit:.4}: {stiffness}, the stability of the intact model is checked"
            ),
            Space::Solid => {
                let form = setup.law.row.shear_form.map(|of| of(Space::Solid));
                NegativeShear::new(poisson, form, horizon_factor).to_string()
            }
        };
        Message::new("negative-shear", text)
    })
}

fn poisson_and_limit(setup: &Setup, material: &Isotropic) -> (f64, f64) {
    let limit = Isotropic::central_force_poisson(setup.space());
    (material.poisson, limit)
}

/// Warning about bonds that break below the strength at which others begin to soften.
pub(crate) fn of_criteria(criteria: &Criteria) -> Option<Message> {
    below_strength(criteria).map(|[share, least]| {
        let text = format!(
            "{:.0} % of the bonds break before the stress comes to the strength, the first at {least:.2} of it: their horizon is several times \
             E G_c/F_t^2, so that they spend the fracture energy before",
            100.0 * share
        );
        let advice = "take a finer mesh there, or `no_fail` where nothing cracks";
        Message::new("below-strength", text).with_advice(advice)
    })
}
