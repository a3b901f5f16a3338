//! Tips of straight pre-cracks in the plane with the rings around them.

use ligament_model::dimension::cast_ref;
use ligament_model::stress::domain_integral::{DomainIntegral, PlaneModuli, Ring, TipQuantity};
use ligament_model::tensor::{cross, dot, minus, norm};
use ligament_model::{BondSystem, System};

use crate::error::Fault;
use crate::setup::Setup;

/// Radii of a ring over the horizon of the tip, where none are given.
const RADII: [f64; 2] = [2.0, 4.0];

/// Part of the outer radius by which a line may leave a straight one.
const STRAIGHT: f64 = 1e-3;

/// Part of a ring that may lie outside of the body.
const OUTSIDE: f64 = 0.03;

/// The integral of a quantity around the tip of a pre-crack at a position (m), over a ring with given radii (m); collective.
pub(super) fn integral<const D: usize>(
    position: [f64; D],
    quantity: TipQuantity,
    radii: Option<[f64; 2]>,
    setup: &Setup,
    system: &dyn System<D>,
) -> Result<DomainIntegral, Fault> {
    let system: &BondSystem<D> = system;
    let refused = |reason: String| Fault::Contradiction(reason.into());
    let Some(system) = cast_ref::<_, BondSystem>(system) else {
        return Err(refused("tips are those of bodies in the plane".into()));
    };
    let position = [position[0], position[1]];
    let radii = radii.unwrap_or_else(|| RADII.map(|it| it * horizon_at(system, position)));
    let ring = ring(position, radii, setup, system).map_err(refused)?;
    let material = material_within(&ring, system).map_err(refused)?;
    let moduli = PlaneModuli::new(&system.whole_materials()[material]);
    let integral = DomainIntegral::new(&system.cloud, &ring, quantity, moduli);
    let within = integral.as_ref().map_or(0.0, DomainIntegral::area);
    let within = system.cloud.subdomain.sum(within);
    let Some(integral) = integral else {
        let reason = "K_I and K_II are those of isotropic materials: read \"J\"";
        return Err(refused(reason.into()));
    };
    if within < (1.0 - OUTSIDE) * ring.area() {
        return Err(refused(format!(
            "the ring around the tip, up to {:e} m from it, leaves the body: give smaller `radii`",
            radii[1]
        )));
    }
    Ok(integral)
}

/// Horizon at a position (m), the largest of the bonds of the nearest point; collective.
fn horizon_at(system: &BondSystem, position: [f64; 2]) -> f64 {
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

/// The ring around the end of a pre-crack at a position (m).
fn ring(
    position: [f64; 2],
    radii: [f64; 2],
    setup: &Setup,
    system: &BondSystem,
) -> Result<Ring, String> {
    let lines = || setup.precracks.iter().map(|it| it.line()).enumerate();
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
    let spacing = system.cloud.spacing[system.cloud.nearest_point(tip) as usize];
    if distance(tip) > spacing {
        return Err(format!(
            "no pre-crack ends at {position:?}; the nearest end is at {tip:?}"
        ));
    }
    let mut line = setup.precracks[own].line().to_vec();
    if is_last {
        line.reverse();
    }
    let from_tip = |place: [f64; 2]| minus(place, tip);
    let leaves = |place: &&[f64; 2]| norm(from_tip(**place)) >= outer;
    let Some(beyond) = line.iter().find(leaves) else {
        return Err(format!(
            "the pre-crack is shorter than the outer radius {outer:e} m: give smaller `radii`"
        ));
    };
    let along = from_tip(*beyond);
    let direction = along.map(|it| -it / norm(along));
    let off = |place: &[f64; 2]| cross_of(direction, from_tip(*place)).abs();
    let within = line.iter().take_while(|it| !leaves(it));
    if within.map(off).any(|it| it > STRAIGHT * outer) {
        return Err(format!(
            "the pre-crack is not straight up to {outer:e} m from its tip: give smaller `radii`"
        ));
    }
    let others = lines().filter(|(number, _)| *number != own);
    let mut sides = others.flat_map(|(_, line)| line.windows(2));
    if sides.any(|side| distance_to_side(tip, [side[0], side[1]]) < outer) {
        return Err(format!(
            "another pre-crack lies within {outer:e} m from the tip: give smaller `radii`"
        ));
    }
    Ok(Ring {
        tip: system.cloud.local(tip),
        direction,
        // Points on a line lie left of it, seen from its first end to its last.
        side: if is_last { 1.0 } else { -1.0 },
        radii,
    })
}

/// a x b in the plane.
fn cross_of(a: [f64; 2], b: [f64; 2]) -> f64 {
    cross([a[0], a[1], 0.0], [b[0], b[1], 0.0])[2]
}

/// Distance of a place from a side between two ends, m.
fn distance_to_side(place: [f64; 2], [start, end]: [[f64; 2]; 2]) -> f64 {
    let (along, from) = (minus(end, start), minus(place, start));
    let share = (dot(along, from) / dot(along, along)).clamp(0.0, 1.0);
    norm(minus(from, along.map(|it| share * it)))
}

/// The material of all points within a ring; collective.
fn material_within(ring: &Ring, system: &BondSystem) -> Result<usize, String> {
    let cloud = &system.cloud;
    let is_within = |point: &u32| {
        let from_tip = minus(cloud.positions[*point as usize], ring.tip);
        norm(from_tip) < ring.radii[1]
    };
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
