//! Probes of a setup as weights on the points and bonds of its model.

use ligament_analysis::probe;
use ligament_model::bonds::precrack::{crossing_bonds, cut_bonds};
use ligament_model::dimension::cast_ref;
use ligament_model::tensor::{dot, minus};
use ligament_model::{BondSet, BondSystem, Horizons, PointCloud, System};

use crate::coordinates::{in_dimensions, narrowed};
use crate::error::{Field, SetupError};
use crate::precracks::cracks;
use crate::setup::{Place, Position, Probe, Reading, Setup};

use super::places::Places;
use super::tips;

/// A horizon larger than the coordinates of any mesh, m.
const EVERYWHERE: f64 = 1e120;

/// A probe with its number on the points and bonds of the model of a setup.
///
/// # Errors
///
/// If the body has no group of its name, or nothing can be read at its tip.
pub(super) fn on<const D: usize>(
    (index, probe): (usize, &Probe),
    places: Places<'_, D>,
    system: &dyn System<D>,
) -> Result<probe::Probe, SetupError> {
    let (setup, field) = (places.setup, Field::element("probes", index));
    let shares = |position: Position| shares(narrowed(position), setup, &system.cloud);
    let points = |group: &String| places.points(field, &Place::Group(group.clone()));
    let reading = match &probe.reading {
        &Reading::Between {
            positions,
            component,
        } => probe::Reading::RelativeDisplacement {
            places: positions.map(shares),
            component,
        },
        &Reading::At { position, field } => probe::Reading::Field {
            place: shares(position),
            field,
        },
        &Reading::Section { line, component } => probe::Reading::SectionForce {
            bonds: crossing(system, line.map(narrowed)),
            component: component.displacement(),
        },
        Reading::Mean { group, field } => probe::Reading::Field {
            place: by_volume(points(group)?, &system.cloud),
            field: *field,
        },
        Reading::Force { group, component } => probe::Reading::Force {
            points: points(group)?,
            component: *component,
        },
        Reading::Tip(tip) => {
            tips::reading(tip, setup, system).map_err(|fault| field.part("reading").error(fault))?
        }
    };
    Ok(probe::Probe {
        name: probe.name.clone(),
        reading,
    })
}

/// Points with their shares of the volume of all of them; collective.
fn by_volume<const D: usize>(points: Vec<u32>, cloud: &PointCloud<D>) -> Vec<(u32, f64)> {
    let volume = |point: &u32| cloud.volumes[*point as usize];
    let owned = points.iter().filter(|it| cloud.subdomain.owns(**it));
    let whole = cloud.subdomain.sum(owned.map(volume).sum());
    let share = |point: u32| (point, volume(&point) / whole);
    points.into_iter().map(share).collect()
}

/// Points and their weights in a reading at a position (m): the points of the cell around it, or the nearest point outside of the cells.
/// Where a pre-crack separates points of the cell, the nearest of them that is not separated from the position.
fn shares<const D: usize>(
    position: [f64; D],
    setup: &Setup,
    cloud: &PointCloud<D>,
) -> Vec<(u32, f64)> {
    let nearest = || vec![(cloud.nearest_point(position), 1.0)];
    let body = setup.body.geometry::<D>();
    let Some(shares) = body.interpolation_weights(position) else {
        return nearest();
    };
    if shares.len() == 1 || setup.precracks.is_empty() {
        return shares;
    }
    let corners = shares
        .iter()
        .map(|(point, _)| in_dimensions(&body.position(*point)));
    // The position precedes its points.
    let places: Vec<[f64; D]> = std::iter::once(position).chain(corners).collect();
    let n = places.len();
    let few = PointCloud::from_points(&places, &vec![1.0; n], 1.0, &vec![0; n], 1);
    let pairs = BondSet::search(&few, &Horizons::unified(EVERYWHERE, n));
    // Errors of surfaces were reported when the model was built.
    let cracks = cracks(&**body, &setup.precracks).unwrap_or_default();
    let parted = cut_bonds(&cracks, &pairs.ends, &few);
    if !parted.contains(&true) {
        return shares;
    }
    let seen = (pairs.ends.iter().zip(&pairs.length)).zip(&parted);
    let seen = seen.filter(|((ends, _), parted)| ends[0] == 0 && !**parted);
    let best = seen.min_by(|((_, one), _), ((_, other), _)| one.total_cmp(other));
    best.map_or_else(nearest, |((ends, _), _)| {
        vec![(shares[ends[1] as usize - 1].0, 1.0)]
    })
}

/// Bonds through a line in the plane, or through a plane in space given by a point and one before it, and whether their first end lies on
/// the left of the line or behind the plane; a point on the plane lies beyond it. Bonds that pre-cracks cut count where faces close.
fn crossing<const D: usize>(system: &BondSystem<D>, line: [[f64; D]; 2]) -> Vec<(u32, bool)> {
    let faces = &system.faces;
    let cut = faces.cut().iter().filter(|_| faces.close());
    let ends = system.bonds.ends.iter().copied();
    crossing_pairs(ends.chain(cut.map(|it| it.ends)), &system.cloud, line)
}

/// Whether a line in the plane, or a plane in space, passes through elements of the far field.
pub(super) fn crosses_far_field<const D: usize>(
    system: &BondSystem<D>,
    line: [Position; 2],
) -> bool {
    let ends = system.far.iter().flat_map(|far| far.ends()).copied();
    !crossing_pairs(ends, &system.cloud, line.map(narrowed)).is_empty()
}

/// Pairs of points on different sides of a line, as [`crossing`].
fn crossing_pairs<const D: usize>(
    ends: impl Iterator<Item = [u32; 2]>,
    cloud: &PointCloud<D>,
    [start, end]: [[f64; D]; 2],
) -> Vec<(u32, bool)> {
    if let Some(cloud) = cast_ref::<_, PointCloud>(cloud) {
        let [start, end] = [start, end].map(|it| std::array::from_fn(|axis| it[axis]));
        return crossing_bonds(ends, cloud, start, end);
    }
    let [point, before] = [start, end].map(|it| cloud.local(it));
    let normal = minus(before, point);
    let is_before = |end: u32| dot(minus(cloud.positions[end as usize], point), normal) > 0.0;
    let sides = ends.map(|ends| ends.map(is_before));
    let crossing = (0..)
        .zip(sides)
        .filter(|(_, [first, second])| first != second);
    crossing.map(|(bond, [_, second])| (bond, second)).collect()
}
