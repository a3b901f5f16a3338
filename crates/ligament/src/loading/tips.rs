//! Tips and fronts of pre-cracks with the rings around them.

use ligament_analysis::probe::Reading;
use ligament_model::bonds::precrack::cut_bonds;
use ligament_model::geometry::distance_to;
use ligament_model::stress::crack_front::CrackFront;
use ligament_model::stress::domain_integral::DomainIntegral;
use ligament_model::stress::growing_tip::GrowingTip;
use ligament_model::stress::tip_field::PlaneModuli;
use ligament_model::tensor::{dot, minus, norm};
use ligament_model::{BondSystem, PointCloud, System, in_space};

use super::fronts::front_of_solid;
use crate::coordinates::narrowed;
use crate::error::Fault;
use crate::precracks::cracks;
use crate::setup::{PreCrack, Setup, Tip};

/// Radii of a ring over the horizon of the tip, where none are given.
const RADII: [f64; 2] = [2.0, 4.0];

/// Part of the outer radius by which a line may leave a straight one.
const STRAIGHT: f64 = 1e-3;

/// What a probe reads at a tip or a front; collective.
pub(super) fn reading<const D: usize>(
    tip: &Tip,
    setup: &Setup,
    system: &dyn System<D>,
) -> Result<Reading, Fault> {
    let system: &BondSystem<D> = system;
    let refused = |reason: String| Fault::Contradiction(reason.into());
    let cloud = &system.cloud;
    let position = narrowed(tip.position);
    let horizon = horizon_at(system, position);
    let radii = tip.radii.unwrap_or(RADII.map(|it| it * horizon));
    let spacing = cloud.spacing[cloud.nearest_point(position) as usize];
    let found = match D {
        2 => tip_of_line(tip, radii, &setup.precracks, [spacing, cloud.thickness]),
        _ => front_of_solid(tip, radii, &setup.precracks, spacing),
    };
    let (own, front) = found.map_err(refused)?;
    let front = CrackFront {
        place: in_space(cloud.local(narrowed(front.place))),
        ..front
    };
    let material = material_within(&front, system).map_err(refused)?;
    let moduli = PlaneModuli::new(&system.whole_materials()[material]);
    let integral = DomainIntegral::new(cloud, &front, tip.quantity, moduli);
    let area = integral.as_ref().map_or(0.0, DomainIntegral::area);
    let is_filled = front.is_filled(cloud.subdomain.sum(area));
    let reason = "K_I, K_II and K_III are those of isotropic materials: read \"J\"";
    let integral = integral.ok_or_else(|| refused(reason.into()))?;
    let outer = radii[1];
    if !is_filled {
        return Err(refused(format!(
            "the ring around the tip, up to {outer:e} m from it, leaves the body: give smaller `radii`"
        )));
    }
    let others: Vec<PreCrack> = without(&setup.precracks, own).cloned().collect();
    if D > 2 && is_cut_through(&front, &integral, &others, (setup, cloud)) {
        return Err(refused(format!(
            "another pre-crack lies within {outer:e} m from the front: give smaller `radii`"
        )));
    }
    if !tip.growing {
        return Ok(Reading::Tip(integral));
    }
    let local = |place: [f64; 2]| in_space(cloud.local(narrowed(in_space(place))));
    let lines = others.iter().flat_map(|it| it.line().windows(2));
    Ok(Reading::GrowingTip(GrowingTip {
        front,
        quantity: tip.quantity,
        moduli,
        material,
        horizon,
        others: lines.map(|side| [local(side[0]), local(side[1])]).collect(),
    }))
}

/// Pre-cracks but one.
fn without(precracks: &[PreCrack], own: usize) -> impl Iterator<Item = &PreCrack> {
    let numbered = precracks.iter().enumerate();
    numbered.filter(move |it| it.0 != own).map(|it| it.1)
}

/// Horizon at a position (m), the largest of the bonds of the nearest point; collective.
fn horizon_at<const D: usize>(system: &BondSystem<D>, position: [f64; D]) -> f64 {
    let cloud = &system.cloud;
    let nearest = cloud.nearest_point(position);
    let bonds = system.bonds.incidence.at(nearest).iter();
    let horizons = bonds.map(|bond| system.bonds.horizon[*bond as usize]);
    let mut largest = [match cloud.subdomain.owns(nearest) {
        true => horizons.fold(0.0, f64::max),
        false => 0.0,
    }];
    cloud.subdomain.all_reduce_max(&mut largest);
    largest[0]
}

/// Number of the pre-crack in the plane that ends at a tip, and its front with the place in the coordinates of the case; from the spacing of
/// the points there and the thickness, m.
fn tip_of_line(
    given: &Tip,
    radii: [f64; 2],
    precracks: &[PreCrack],
    [spacing, thickness]: [f64; 2],
) -> Result<(usize, CrackFront), String> {
    let position: [f64; 2] = narrowed(given.position);
    let lines = || precracks.iter().map(|it| it.line()).enumerate();
    let ends = lines().flat_map(|(number, line)| {
        let ends = [(line.first(), false), (line.last(), true)];
        ends.into_iter()
            .filter_map(move |(end, is_last)| Some((number, *end?, is_last)))
    });
    let distance = |end: [f64; 2]| norm(minus(end, position));
    let nearest = ends.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
    let Some((own, tip, is_last)) = nearest else {
        return Err("`tip` is the end of a [[precrack]], and the case has none".into());
    };
    let [_, outer] = radii;
    if distance(tip) > spacing {
        return Err(format!(
            "no pre-crack ends at {position:?}; the nearest end is at {tip:?}"
        ));
    }
    let mut line = precracks[own].line().to_vec();
    if is_last {
        line.reverse();
    }
    let [x, y] = direction_at(tip, &line, outer)?;
    let mut sides = without(precracks, own).flat_map(|it| it.line().windows(2));
    if sides.any(|side| distance_to([side[0], side[1]], tip) < outer) {
        return Err(format!(
            "another pre-crack lies within {outer:e} m from the tip: give smaller `radii`"
        ));
    }
    Ok((
        own,
        CrackFront {
            place: in_space(tip),
            axes: [[x, y, 0.0], [-y, x, 0.0], [0.0, 0.0, 1.0]],
            radius: f64::INFINITY,
            // Points on a line lie left of it, seen from its first end to its last.
            side: if is_last { 1.0 } else { -1.0 },
            radii,
            reach: f64::INFINITY,
            length: thickness,
        },
    ))
}

/// Direction in which a line grows at its first end, the tip, from which it is straight up to a distance (m).
fn direction_at(tip: [f64; 2], line: &[[f64; 2]], outer: f64) -> Result<[f64; 2], String> {
    let from_tip = |place: [f64; 2]| minus(place, tip);
    let leaves = |place: &&[f64; 2]| norm(from_tip(**place)) >= outer;
    let Some(beyond) = line.iter().find(leaves) else {
        return Err(format!(
            "the pre-crack is shorter than the outer radius {outer:e} m: give smaller `radii`"
        ));
    };
    let along = from_tip(*beyond);
    let [x, y] = along.map(|it| -it / norm(along));
    let off = |place: &[f64; 2]| dot([-y, x], from_tip(*place)).abs();
    let mut within = line.iter().take_while(|it| !leaves(it)).map(off);
    if within.any(|it| it > STRAIGHT * outer) {
        return Err(format!(
            "the pre-crack is not straight up to {outer:e} m from its tip: give smaller `radii`"
        ));
    }
    Ok([x, y])
}

/// Whether other pre-cracks lie between the points of an integral and the front; collective.
fn is_cut_through<const D: usize>(
    front: &CrackFront,
    integral: &DomainIntegral,
    others: &[PreCrack],
    (setup, cloud): (&Setup, &PointCloud<D>),
) -> bool {
    let origin = cloud.local([0.0; D]);
    let ends = integral.points().flat_map(|point| {
        let position = cloud.positions[point as usize];
        let place = narrowed(front.nearest_place(in_space(position)));
        [position, place].map(|it| minus(it, origin))
    });
    let places: Vec<[f64; D]> = ends.collect();
    let n = places.len();
    // Errors of surfaces were reported when the model was built.
    let cracks = cracks(&**setup.body.geometry::<D>(), others).unwrap_or_default();
    let is_cut = n > 0 && {
        let pairs = PointCloud::from_points(&places, &vec![1.0; n], 1.0, &vec![0; n], 1);
        let ends: Vec<[u32; 2]> = (0..n as u32 / 2).map(|it| [2 * it, 2 * it + 1]).collect();
        cut_bonds(&cracks, &ends, &pairs).contains(&true)
    };
    cloud.subdomain.any(is_cut)
}

/// The material of all points within a ring; collective.
fn material_within<const D: usize>(
    front: &CrackFront,
    system: &BondSystem<D>,
) -> Result<usize, String> {
    let cloud = &system.cloud;
    let is_within = |point: &u32| front.reaches(in_space(cloud.positions[*point as usize]));
    let within: Vec<u32> = cloud.subdomain.owned().filter(is_within).collect();
    let n_materials = system.materials.len();
    let fills = |material: &usize| {
        let has_other = |point: &u32| cloud.shares(*point as usize)[*material] < 1.0;
        !cloud.subdomain.any(within.iter().any(has_other))
    };
    let found = (0..n_materials).find(fills);
    found.ok_or_else(|| match n_materials {
        0 => {
            "the law gives its bonds no stiffness of a material, from which stresses follow".into()
        }
        _ => "the ring around the tip lies in several materials: give smaller `radii`".into(),
    })
}
