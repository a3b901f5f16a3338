//! From a case and its mesh to the typed settings of the libraries.
//!
//! Names are looked up in the mesh here; what is not there is reported at its place in the case file.

use ligament_analysis::breaking::{BreakingOrder, BreakingRule};
use ligament_analysis::driver::stepped::{SteppedSettings, StopRules};
use ligament_analysis::probe::{PointField, Probe, Reading};
use ligament_analysis::{Boundary, Component, Control, ControlKind};
use ligament_mesh::{Group, Mesh};
use ligament_model::bonds::precrack::PreCrack;
use ligament_model::correction::{StopRule, Sweeps};
use ligament_model::{BondSystem, Material, Plane, PointCloud};

use crate::case::{
    self, Action, BreakOrder, CaseError, CaseFile, CorrectionRule, Displacement, Fault, Place,
    Region, Steps,
};

/// State of the plane.
pub fn plane(case: &CaseFile) -> Plane {
    match case.case.mesh.plane {
        case::Plane::Stress => Plane::Stress,
        case::Plane::Strain => Plane::Strain,
    }
}

/// The materials, in the order of the case file.
pub fn materials(case: &CaseFile) -> Vec<Material> {
    let material = |material: &case::Material| Material {
        name: material.name.clone().unwrap_or_default(),
        young: material.young,
        poisson: material.poisson,
        tensile_strength: material.tensile_strength,
        density: material.density,
    };
    case.case.materials.iter().map(material).collect()
}

/// Index of the material of each cell, shape (n_cells): every cell must have exactly one.
pub fn material_of_cell(case: &CaseFile, mesh: &Mesh) -> Result<Vec<u32>, CaseError> {
    let mut material_of_cell = vec![None; mesh.cells.len()];
    for (index, material) in case.case.materials.iter().enumerate() {
        let cells: Vec<u32> = match &material.group {
            None => (0..mesh.cells.len() as u32).collect(),
            Some(group) => surface_cells(case, mesh, &format!("{}.group", material.key()), group)?,
        };
        for cell in cells {
            if let Some(first) = material_of_cell[cell as usize].replace(index as u32)
                && first != index as u32
            {
                let other = case.case.materials[first as usize]
                    .name
                    .clone()
                    .unwrap_or_default();
                let reason = format!("cells of this material belong to material `{other}` as well");
                return Err(case.error(&material.key(), Fault::Other(reason)));
            }
        }
    }
    let uncovered = material_of_cell
        .iter()
        .filter(|material| material.is_none())
        .count();
    if uncovered > 0 {
        let reason = format!(
            "{uncovered} of {} cells belong to the group of no material",
            mesh.cells.len()
        );
        return Err(case.error("material", Fault::Other(reason)));
    }
    Ok(material_of_cell.into_iter().flatten().collect())
}

fn surface_cells(
    case: &CaseFile,
    mesh: &Mesh,
    key: &str,
    group: &str,
) -> Result<Vec<u32>, CaseError> {
    let surfaces: Vec<&Group> = groups_named(case, mesh, key, group)?
        .into_iter()
        .filter(|g| g.dimension == 2)
        .collect();
    if surfaces.is_empty() {
        let reason = format!("`{group}` has no cells: a material needs a physical surface");
        return Err(case.error(key, Fault::Other(reason)));
    }
    Ok(surfaces
        .iter()
        .flat_map(|surface| surface.cells.iter().copied())
        .collect())
}

/// Models with more bonds than this take the size-independent stop rule unless told otherwise.
const LARGE_MODEL: usize = 1_000_000;

/// Stop rule and limit of the domain correction for a model of so many bonds.
pub fn sweeps(case: &CaseFile, n_bonds: usize) -> Sweeps {
    let correction = &case.case.correction;
    let rule = match correction.rule {
        CorrectionRule::Auto if n_bonds > LARGE_MODEL => CorrectionRule::Mean,
        CorrectionRule::Auto => CorrectionRule::Sum,
        rule => rule,
    };
    let tolerance = correction
        .tolerance
        .or(rule.default_tolerance())
        .unwrap_or_default();
    let stop = if rule == CorrectionRule::Mean {
        StopRule::Mean(tolerance)
    } else {
        StopRule::Sum(tolerance)
    };
    Sweeps {
        stop,
        limit: correction.max_sweeps as usize,
    }
}

/// The pre-cracks.
pub fn precracks(case: &CaseFile) -> Vec<PreCrack> {
    case.case
        .precracks
        .iter()
        .map(|crack| PreCrack {
            points: crack.points.clone(),
        })
        .collect()
}

/// Marks the points whose bonds never break, shape (n_points).
pub fn no_fail(case: &CaseFile, mesh: &Mesh, cloud: &PointCloud) -> Result<Vec<bool>, CaseError> {
    let mut marked = vec![false; cloud.len()];
    for (index, region) in case.case.no_fail.iter().enumerate() {
        let key = format!("no_fail.{index}");
        let points = match region {
            Region::Group(group) => group_points(case, mesh, &format!("{key}.group"), group)?,
            Region::Box(corners) => points_in_box(case, cloud, &key, *corners)?,
        };
        for point in points {
            marked[point as usize] = true;
        }
    }
    Ok(marked)
}

/// Supports and loads on the points.
pub fn boundary(case: &CaseFile, mesh: &Mesh, cloud: &PointCloud) -> Result<Boundary, CaseError> {
    let mut boundary = Boundary::new(cloud.len(), control(case, mesh, cloud)?);
    for (index, support) in case.case.supports.iter().enumerate() {
        let key = format!("support.{index}");
        let points = points_of(case, mesh, cloud, &key, &support.place)?;
        prescribe(case, &mut boundary, &key, &points, &support.displacement)?;
        boundary.report_group(place_name(&support.place, "support", index), points);
    }
    for (index, load) in case.case.loads.iter().enumerate() {
        let key = format!("load.{index}");
        let points = loaded_points(case, mesh, cloud, &key, load.place.as_ref())?;
        match &load.action {
            Action::Displacement(displacement) => {
                prescribe(case, &mut boundary, &key, &points, displacement)?
            }
            action => {
                for (point, [x, y]) in forces(case, mesh, cloud, &key, load, &points, action)? {
                    boundary.add_force(point, Component::X, x);
                    boundary.add_force(point, Component::Y, y);
                }
            }
        }
        boundary.report_group(load.name.clone(), points);
    }
    Ok(boundary)
}

fn place_name(place: &Place, kind: &str, index: usize) -> String {
    match place {
        Place::Group(group) => group.clone(),
        Place::Box(_) | Place::At(_) => format!("{kind}-{}", index + 1),
    }
}

fn prescribe(
    case: &CaseFile,
    boundary: &mut Boundary,
    key: &str,
    points: &[u32],
    displacement: &Displacement,
) -> Result<(), CaseError> {
    let components = [
        (Component::X, displacement.x),
        (Component::Y, displacement.y),
        (Component::Rotation, displacement.rotation),
    ];
    for (component, value) in components {
        if let Some(value) = value {
            boundary
                .prescribe(points, component, value)
                .map_err(|error| {
                    case.error(
                        &format!("{key}.displacement"),
                        Fault::Other(error.to_string()),
                    )
                })?;
        }
    }
    Ok(())
}

/// The first load is the axis of the force-displacement curve.
fn control(case: &CaseFile, mesh: &Mesh, cloud: &PointCloud) -> Result<Control, CaseError> {
    let load = &case.case.loads[0];
    let points = loaded_points(case, mesh, cloud, "load.0", load.place.as_ref())?;
    let (kind, vector) = match &load.action {
        Action::Displacement(given) => {
            let [x, y] = [given.x, given.y].map(|value| value.unwrap_or(0.0));
            let rotation = if x == 0.0 && y == 0.0 {
                given.rotation.unwrap_or(0.0)
            } else {
                0.0
            };
            (ControlKind::Displacement, [x, y, rotation])
        }
        action => {
            let per_point = forces(case, mesh, cloud, "load.0", load, &points, action)?;
            let [x, y] =
                [0, 1].map(|axis| per_point.iter().map(|(_, force)| force[axis]).sum::<f64>());
            (ControlKind::Force, [x, y, 0.0])
        }
    };
    let magnitude = vector.iter().map(|value| value * value).sum::<f64>().sqrt();
    if magnitude == 0.0 {
        let reason = "the first load must be other than zero: it is the axis of the force-displacement curve";
        return Err(case.error("load.0", Fault::Other(reason.to_owned())));
    }
    Ok(Control {
        kind,
        points,
        direction: vector.map(|value| value / magnitude),
        magnitude,
    })
}

/// Forces on the points of a load at load factor 1, N.
///
/// A total is spread over a curve group by the length of its edges, over other places by the points' volumes; a force
/// per length goes by the length of the edges, half of each edge to either end; a body force by the volumes.
fn forces(
    case: &CaseFile,
    mesh: &Mesh,
    cloud: &PointCloud,
    key: &str,
    load: &case::Load,
    points: &[u32],
    action: &Action,
) -> Result<Vec<(u32, [f64; 2])>, CaseError> {
    let curve = match &load.place {
        Some(Place::Group(group)) => tributary_lengths(mesh, group),
        _ => Vec::new(),
    };
    let by_volume = || {
        points
            .iter()
            .map(|&point| (point, cloud.volumes[point as usize]))
            .collect::<Vec<_>>()
    };
    let scaled = |weights: Vec<(u32, f64)>, force: &case::Vector, total: f64| {
        weights
            .into_iter()
            .map(|(point, weight)| (point, [force.x, force.y].map(|f| f * weight / total)))
            .collect()
    };
    match action {
        Action::Displacement(_) => Ok(Vec::new()),
        Action::BodyForce(force) => Ok(scaled(by_volume(), force, 1.0)),
        Action::ForcePerLength(_) if curve.is_empty() => {
            let reason = "a force per length needs a physical curve, and this group has no edges";
            Err(case.error(&format!("{key}.group"), Fault::Other(reason.to_owned())))
        }
        Action::ForcePerLength(force) => Ok(scaled(curve, force, 1.0)),
        Action::Force(force) => {
            let weights = if curve.is_empty() { by_volume() } else { curve };
            let total = weights.iter().map(|(_, weight)| weight).sum();
            Ok(scaled(weights, force, total))
        }
    }
}

/// Length of curve that each point of a curve group stands for, m: half of its edges.
fn tributary_lengths(mesh: &Mesh, group: &str) -> Vec<(u32, f64)> {
    let mut lengths = std::collections::BTreeMap::new();
    for edge in mesh.groups_named(group).flat_map(|group| &group.edges) {
        let [p, q] = edge.map(|node| mesh.positions[node as usize]);
        for &node in edge {
            *lengths.entry(node).or_insert(0.0) += 0.5 * (q[0] - p[0]).hypot(q[1] - p[1]);
        }
    }
    lengths.into_iter().collect()
}

/// How to step, for a case with a fracture section.
pub fn stepped(fracture: &case::Fracture) -> SteppedSettings {
    let load_factors = match &fracture.steps {
        Steps::Uniform(count) => (1..=*count)
            .map(|step| f64::from(step) / f64::from(*count))
            .collect(),
        Steps::Factors(factors) => factors.clone(),
    };
    let stop = &fracture.stop;
    SteppedSettings {
        load_factors,
        refine_first_break: fracture.refine_first_break as usize,
        rule: BreakingRule {
            order: match fracture.order {
                BreakOrder::Excess => BreakingOrder::Excess,
                BreakOrder::Ratio => BreakingOrder::Ratio,
            },
            bonds_per_iteration: fracture.bonds_per_iteration as usize,
            tie_tolerance: fracture.tie_tolerance,
        },
        energy_tolerance: fracture.energy_tolerance,
        round_limit: fracture.max_iterations as usize,
        stop: StopRules {
            load_fraction: stop.load_fraction,
            displacement: stop.displacement,
            bonds: stop.bonds.map(|bonds| bonds as usize),
            wall_time: stop.wall_time,
        },
    }
}

/// The probes.
pub fn probes(case: &CaseFile, system: &BondSystem) -> Vec<Probe> {
    let nearest = |position: [f64; 2]| system.cloud.nearest_point(position);
    let probe = |probe: &case::Probe| Probe {
        name: probe.name.clone(),
        reading: reading(system, nearest, probe.reading),
    };
    case.case.probes.iter().map(probe).collect()
}

fn reading(
    system: &BondSystem,
    nearest: impl Fn([f64; 2]) -> u32,
    reading: case::Reading,
) -> Reading {
    match reading {
        case::Reading::Between { between, component } => {
            let component = match component {
                case::Component::X => Component::X,
                case::Component::Y => Component::Y,
                case::Component::Rotation => Component::Rotation,
            };
            Reading::RelativeDisplacement {
                points: between.map(nearest),
                component,
            }
        }
        case::Reading::At { at, field } => Reading::Field {
            point: nearest(at),
            field: match field {
                case::Field::Damage => PointField::Damage,
                case::Field::DisplacementX => PointField::Motion(Component::X),
                case::Field::DisplacementY => PointField::Motion(Component::Y),
                case::Field::Rotation => PointField::Motion(Component::Rotation),
                case::Field::StrainEnergyDensity => PointField::StrainEnergyDensity,
            },
        },
        case::Reading::Section {
            section: [start, end],
            component,
        } => {
            let component = match component {
                case::Axis::X => Component::X,
                case::Axis::Y => Component::Y,
            };
            Reading::section(system, start, end, component)
        }
    }
}

/// Points that a load acts on; the whole body without a place.
fn loaded_points(
    case: &CaseFile,
    mesh: &Mesh,
    cloud: &PointCloud,
    key: &str,
    place: Option<&Place>,
) -> Result<Vec<u32>, CaseError> {
    match place {
        Some(place) => points_of(case, mesh, cloud, key, place),
        None => Ok((0..cloud.len() as u32).collect()),
    }
}

fn points_of(
    case: &CaseFile,
    mesh: &Mesh,
    cloud: &PointCloud,
    key: &str,
    place: &Place,
) -> Result<Vec<u32>, CaseError> {
    match place {
        Place::Group(group) => group_points(case, mesh, &format!("{key}.group"), group),
        Place::Box(corners) => points_in_box(case, cloud, key, *corners),
        Place::At(position) => Ok(vec![cloud.nearest_point(*position)]),
    }
}

fn points_in_box(
    case: &CaseFile,
    cloud: &PointCloud,
    key: &str,
    [lower, upper]: [[f64; 2]; 2],
) -> Result<Vec<u32>, CaseError> {
    let points = cloud.points_in_box(lower, upper);
    if points.is_empty() {
        let reason = "there is no point of the mesh in this box".to_owned();
        return Err(case.error(&format!("{key}.box"), Fault::Other(reason)));
    }
    Ok(points)
}

/// Points of all groups of this name, ascending.
fn group_points(
    case: &CaseFile,
    mesh: &Mesh,
    key: &str,
    name: &str,
) -> Result<Vec<u32>, CaseError> {
    let groups = groups_named(case, mesh, key, name)?;
    let mut points: Vec<u32> = groups
        .iter()
        .flat_map(|group| group.nodes.iter().copied())
        .collect();
    points.sort_unstable();
    points.dedup();
    Ok(points)
}

fn groups_named<'a>(
    case: &CaseFile,
    mesh: &'a Mesh,
    key: &str,
    name: &str,
) -> Result<Vec<&'a Group>, CaseError> {
    let groups: Vec<&Group> = mesh.groups_named(name).collect();
    if groups.is_empty() {
        let names = mesh.groups.iter().map(|group| group.name.clone());
        return Err(case.error(
            key,
            Fault::unknown_name("physical group in the mesh", name, names),
        ));
    }
    Ok(groups)
}
