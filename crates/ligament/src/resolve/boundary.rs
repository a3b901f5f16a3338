//! Supports and loads of a case on the points of its mesh.

use std::collections::BTreeMap;

use ligament_analysis::{Boundary, BoundaryError, COMPONENTS, Component, Control, ControlKind};
use ligament_mesh::Mesh;
use ligament_model::PointCloud;

use super::places::Places;
use crate::case::{Action, CaseError, CaseFile, Displacement, Load, Place, Vector};

/// Supports and loads on the points.
pub fn boundary(case: &CaseFile, mesh: &Mesh, cloud: &PointCloud) -> Result<Boundary, CaseError> {
    let places = Places { case, mesh, cloud };
    let mut boundary = Boundary::new(cloud.len(), places.control()?);
    for (index, support) in case.case.supports.iter().enumerate() {
        let key = format!("support.{index}");
        let points = places.points(&key, Some(&support.place))?;
        places.prescribe(&mut boundary, &key, &points, &support.displacement)?;
        boundary.report_group(
            &place_name(&support.place, index),
            points,
            [0.0; COMPONENTS],
        );
    }
    for (index, load) in case.case.loads.iter().enumerate() {
        let key = format!("load.{index}");
        let points = places.points(&key, load.place.as_ref())?;
        if let Action::Displacement(displacement) = &load.action {
            places.prescribe(&mut boundary, &key, &points, displacement)?;
        }
        let mut total = [0.0; COMPONENTS];
        for (point, [x, y]) in places.forces(&key, load, &points)? {
            boundary.add_force(point, Component::X, x);
            boundary.add_force(point, Component::Y, y);
            total = [total[0] + x, total[1] + y, 0.0];
        }
        boundary.report_group(&load.name, points, total);
    }
    Ok(boundary)
}

/// Name of a support in the history.
fn place_name(place: &Place, index: usize) -> String {
    match place {
        Place::Group(group) => group.clone(),
        Place::Box(_) | Place::At(_) => format!("support-{}", index + 1),
    }
}

impl Places<'_> {
    fn prescribe(
        &self,
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
        for (component, value) in components
            .into_iter()
            .filter_map(|(component, value)| Some((component, value?)))
        {
            let done = boundary.prescribe(points, component, value);
            done.map_err(|BoundaryError::Conflict { point, component, first, second }| {
                let tag = self.mesh.node_tags[point as usize];
                let reason = format!(
                    "component {component} of node {tag} is prescribed twice: as {first:?} by an earlier support or \
                     load, as {second:?} here"
                );
                self.case.error(&format!("{key}.displacement"), reason)
            })?;
        }
        Ok(())
    }

    /// The first load is the axis of the force-displacement curve.
    fn control(&self) -> Result<Control, CaseError> {
        let load = &self.case.case.loads[0];
        let points = self.points("load.0", load.place.as_ref())?;
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
            Action::Force(_) | Action::ForcePerLength(_) | Action::BodyForce(_) => {
                let forces = self.forces("load.0", load, &points)?;
                let [x, y] =
                    [0, 1].map(|axis| forces.iter().map(|(_, force)| force[axis]).sum::<f64>());
                (ControlKind::Force, [x, y, 0.0])
            }
        };
        let magnitude = vector.iter().map(|value| value * value).sum::<f64>().sqrt();
        if magnitude == 0.0 {
            let reason = "the first load must be other than zero: it is the axis of the force-displacement curve";
            return Err(self.case.error("load.0", reason));
        }
        Ok(Control {
            kind,
            points,
            direction: vector.map(|value| value / magnitude),
            magnitude,
        })
    }

    /// Forces of a load on its points at load factor 1, N; none where it prescribes a displacement.
    ///
    /// A total is spread over a curve group by the length of its edges, over other places by the points' volumes; a
    /// force per length goes by the length of the edges, half of each edge to either end; a body force by the volumes.
    fn forces(
        &self,
        key: &str,
        load: &Load,
        points: &[u32],
    ) -> Result<Vec<(u32, [f64; 2])>, CaseError> {
        let curve = match &load.place {
            Some(Place::Group(group)) => tributary_lengths(self.mesh, group),
            _ => Vec::new(),
        };
        let volumes: Vec<(u32, f64)> = points
            .iter()
            .map(|&point| (point, self.cloud.volumes[point as usize]))
            .collect();
        match &load.action {
            Action::Displacement(_) => Ok(Vec::new()),
            Action::BodyForce(force) => Ok(weighted(&volumes, force, 1.0)),
            Action::ForcePerLength(_) if curve.is_empty() => {
                let reason =
                    "a force per length needs a physical curve, and this group has no edges";
                Err(self.case.error(&format!("{key}.group"), reason))
            }
            Action::ForcePerLength(force) => Ok(weighted(&curve, force, 1.0)),
            Action::Force(force) => {
                let weights = if curve.is_empty() { &volumes } else { &curve };
                Ok(weighted(
                    weights,
                    force,
                    weights.iter().map(|(_, weight)| weight).sum(),
                ))
            }
        }
    }
}

fn weighted(weights: &[(u32, f64)], force: &Vector, total: f64) -> Vec<(u32, [f64; 2])> {
    weights
        .iter()
        .map(|&(point, weight)| (point, [force.x, force.y].map(|f| f * weight / total)))
        .collect()
}

/// Length of curve that each point of a curve group stands for, m: half of its edges.
fn tributary_lengths(mesh: &Mesh, group: &str) -> Vec<(u32, f64)> {
    let mut lengths = BTreeMap::new();
    for edge in mesh.groups_named(group).flat_map(|group| &group.edges) {
        let [p, q] = edge.map(|node| mesh.positions[node as usize]);
        for &node in edge {
            *lengths.entry(node).or_insert(0.0) += 0.5 * (q[0] - p[0]).hypot(q[1] - p[1]);
        }
    }
    lengths.into_iter().collect()
}
