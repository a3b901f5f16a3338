//! Supports and loads of a case on the points of its body.

use ligament_analysis::{
    BoundaryError, COMPONENTS, Component, Control, ControlKind, ProportionalLoading, Unknowns,
};
use ligament_model::{BondSystem, PointCloud};

use super::places::Places;
use super::temperature::{Heating, heating};
use crate::body::Body;
use crate::case::{Action, CaseError, CaseFile, Displacement, Load, Place, Profile};

/// Supports and loads on the points.
pub(super) fn boundary(
    case: &CaseFile,
    body: &dyn Body,
    cloud: &PointCloud,
) -> Result<ProportionalLoading, CaseError> {
    let places = Places { case, body, cloud };
    let heating = heating(case, body, cloud)?;
    let mut boundary = ProportionalLoading::new(cloud.len(), places.control(heating.as_ref())?);
    if let Some(Heating { change, strain }) = heating {
        boundary.temperature_change = change;
        boundary.thermal_strain = strain;
    }
    for (index, support) in case.case.supports.iter().enumerate() {
        let key = format!("support.{index}");
        let points = places.points(&key, Some(&support.place))?;
        places.prescribe(
            &mut boundary,
            &key,
            &points,
            &vec![1.0; points.len()],
            &support.displacement,
        )?;
        boundary.report_group(
            &place_name(&support.place, index),
            points,
            [0.0; COMPONENTS],
        );
    }
    for (index, load) in case.case.loads.iter().enumerate() {
        let key = format!("load.{index}");
        let points = places.points(&key, load.place.as_ref())?;
        let factors = places.factors(&key, load.profile.as_ref(), &points)?;
        if let Action::Displacement(displacement) = &load.action {
            places.prescribe(&mut boundary, &key, &points, &factors, displacement)?;
        }
        let mut total = [0.0; COMPONENTS];
        for (point, force) in places.forces(&key, load, &points)?.at_points {
            for component in Component::ALL {
                let value = force[component.index()];
                boundary.add_force(point, component, value);
                total[component.index()] += value;
            }
        }
        boundary.report_group(&load.name, points, total);
    }
    Ok(boundary)
}

/// Refuses couples on points that no bond keeps from turning: they would act on nothing.
pub(super) fn couples_have_stiffness(
    case: &CaseFile,
    boundary: &ProportionalLoading,
    system: &BondSystem,
) -> Result<(), CaseError> {
    let loads = case.case.loads.iter().enumerate();
    let key = |(index, load): (usize, &Load)| match &load.action {
        Action::Moment(_) => Some(format!("load.{index}.moment")),
        Action::BodyCouple(_) => Some(format!("load.{index}.body_couple")),
        _ => None,
    };
    let Some(key) = loads.filter_map(key).next() else {
        return Ok(());
    };
    let unknowns = Unknowns::all_but(system, |dof| boundary.prescribed[dof].is_some());
    let is_idle = |dof: usize| {
        boundary.force[dof] != 0.0
            && boundary.prescribed[dof].is_none()
            && unknowns.number(dof).is_none()
    };
    let rotations = (0..boundary.force.len()).filter(|&dof| Component::at(dof).is_rotation());
    let idle = rotations.filter(|&dof| is_idle(dof)).count();
    if idle == 0 {
        return Ok(());
    }
    let reason = format!(
        "the couple acts on {idle} points that no bond keeps from turning (Poisson's ratio makes the shear stiffness of \
         their bonds zero, or the bonds have no rotations): apply it as a pair of forces"
    );
    Err(case.error(&key, reason))
}

/// Name of a support in the history.
pub(super) fn place_name(place: &Place, index: usize) -> String {
    match place {
        Place::Group(group) => group.clone(),
        Place::Box(_) | Place::At(_) => format!("support-{}", index + 1),
    }
}

/// Forces and couples of a load at load factor 1, N and N m.
#[derive(Default)]
struct Given {
    /// What its points take.
    at_points: Vec<(u32, [f64; COMPONENTS])>,
    /// Size before the profile: of the sum over the points, or the pressure, Pa.
    size: f64,
}

impl Places<'_> {
    /// Prescribes a displacement times a factor for each point.
    fn prescribe(
        &self,
        boundary: &mut ProportionalLoading,
        key: &str,
        points: &[u32],
        factors: &[f64],
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
            let mut each = points.iter().zip(factors);
            let done = each.try_for_each(|(&point, factor)| {
                boundary.prescribe(&[point], component, factor * value)
            });
            done.map_err(|BoundaryError::Conflict { point, component, first, second }| {
                let place = self.body.label(point);
                let reason = format!(
                    "component {component} of {place} is prescribed twice: as {first:?} by an earlier support or \
                     load, as {second:?} here"
                );
                self.case.error(&format!("{key}.displacement"), reason)
            })?;
        }
        Ok(())
    }

    /// The first load is the axis of the force-displacement curve; the temperature where there is none.
    fn control(&self, heating: Option<&Heating>) -> Result<Control, CaseError> {
        let key = "load.0";
        let Some(load) = self.case.case.loads.first() else {
            let changes = heating.map_or(&[][..], |it| &it.change);
            let magnitude = changes.iter().map(|it| it.abs()).fold(0.0, f64::max);
            if magnitude == 0.0 {
                let reason = "there is no [[load]] and no point whose temperature changes: nothing would happen";
                return Err(self.case.error("temperature", reason));
            }
            return Ok(Control {
                kind: ControlKind::Temperature,
                points: Vec::new(),
                shape: Vec::new(),
                magnitude,
            });
        };
        let points = self.points(key, load.place.as_ref())?;
        let factors = self.factors(key, load.profile.as_ref(), &points)?;
        let given = self.forces(key, load, &points)?;
        let motion = match load.action {
            Action::Displacement(Displacement { x, y, rotation }) => {
                let [x, y, rotation] = [x, y, rotation].map(|value| value.unwrap_or(0.0));
                let rotation = if x == 0.0 && y == 0.0 { rotation } else { 0.0 };
                Some([x, y, rotation])
            }
            _ => None,
        };
        let magnitude = motion.map_or(given.size, norm);
        if magnitude == 0.0 {
            let reason = "the first load must be other than zero: it is the axis of the force-displacement curve";
            return Err(self.case.error(key, reason));
        }
        let (kind, (points, shape)) = match motion {
            Some(motion) => {
                let direction = motion.map(|value| value / magnitude);
                let shape = factors
                    .iter()
                    .map(|factor| direction.map(|cosine| factor * cosine));
                (ControlKind::Displacement, (points, shape.collect()))
            }
            None => {
                let at_points = given.at_points.into_iter();
                let shape = at_points
                    .map(|(point, force)| (point, force.map(|value| value / magnitude)))
                    .unzip();
                (ControlKind::Force, shape)
            }
        };
        Ok(Control {
            kind,
            points,
            shape,
            magnitude,
        })
    }

    /// Factors of a profile at the points; 1 without one.
    fn factors(
        &self,
        key: &str,
        profile: Option<&Profile>,
        points: &[u32],
    ) -> Result<Vec<f64>, CaseError> {
        let Some(profile) = profile else {
            return Ok(vec![1.0; points.len()]);
        };
        let factor = |&point: &u32| profile.at(self.body.positions()[point as usize]);
        let factors: Vec<f64> = points.iter().map(factor).collect();
        if factors.iter().all(|&factor| factor == 0.0) {
            let reason =
                "the load does nothing: its profile is zero at every point that it acts on";
            return Err(self.case.error(&format!("{key}.profile"), reason));
        }
        Ok(factors)
    }

    /// Forces and couples of a load on its points; none where it prescribes a displacement.
    ///
    /// A total force is spread over a group that has a length by the length that each point stands for, over other places
    /// by the points' volumes; a force per length goes by the lengths; body forces and all couples go by the volumes. Each
    /// point's share is then multiplied by the profile.
    fn forces(&self, key: &str, load: &Load, points: &[u32]) -> Result<Given, CaseError> {
        let curve = match &load.place {
            Some(Place::Group(group)) => self.body.lengths_of(group),
            _ => Vec::new(),
        };
        let volume = |&point: &u32| (point, self.cloud.volumes[point as usize]);
        let volumes: Vec<(u32, f64)> = points.iter().map(volume).collect();
        let size = |weights: &[(u32, f64)]| weights.iter().map(|(_, weight)| weight).sum::<f64>();
        let (weights, density) = match &load.action {
            Action::Displacement(_) => return Ok(Given::default()),
            Action::Pressure(pressure) => return self.pressures(key, load, *pressure),
            Action::BodyForce(force) => (volumes, [force.x, force.y, 0.0]),
            Action::BodyCouple(couple) => (volumes, [0.0, 0.0, *couple]),
            Action::ForcePerLength(_) if curve.is_empty() => {
                let reason = "a force per length needs a physical curve of a mesh, or rows or columns at a side of a lattice: \
                              this group has no length";
                return Err(self.case.error(&format!("{key}.group"), reason));
            }
            Action::ForcePerLength(force) => (curve, [force.x, force.y, 0.0]),
            Action::Force(force) => {
                let weights = if curve.is_empty() { volumes } else { curve };
                let total = size(&weights);
                (weights, [force.x, force.y, 0.0].map(|value| value / total))
            }
            Action::Moment(couple) => {
                let total = size(&volumes);
                (volumes, [0.0, 0.0, couple / total])
            }
        };
        let total = size(&weights);
        let loaded: Vec<u32> = weights.iter().map(|(point, _)| *point).collect();
        let factors = self.factors(key, load.profile.as_ref(), &loaded)?;
        let at_points = weights.iter().zip(factors);
        let share = |(&(point, weight), factor): (&(u32, f64), f64)| {
            (point, density.map(|value| factor * (value * weight)))
        };
        Ok(Given {
            at_points: at_points.map(share).collect(),
            size: norm(density.map(|value| value * total)),
        })
    }

    /// Forces of a pressure p on the outline of a group: -p t n L, half at each node of an edge of a mesh of length L and outward
    /// normal n, or at the cell of a lattice whose face it is; n and L are those of the body at rest (a dead load). Each point's
    /// share is then multiplied by the profile.
    fn pressures(&self, key: &str, load: &Load, pressure: f64) -> Result<Given, CaseError> {
        let group_key = format!("{key}.group");
        let normals = match &load.place {
            Some(Place::Group(group)) => self.body.outline_of(group),
            _ => Ok(Vec::new()),
        };
        let normals = normals.map_err(|error| self.case.error(&group_key, error.to_string()))?;
        if normals.is_empty() {
            let reason = "a pressure needs a physical curve on the outline of a mesh, or cells of a lattice at a side or a hole: \
                          this group has no part of the outline";
            return Err(self.case.error(&group_key, reason));
        }
        let loaded: Vec<u32> = normals.iter().map(|(point, _)| *point).collect();
        let factors = self.factors(key, load.profile.as_ref(), &loaded)?;
        let per_length = -pressure * self.cloud.thickness;
        let force = |((point, [x, y]), factor): ((u32, [f64; 2]), f64)| {
            let share = factor * per_length;
            (point, [share * x, share * y, 0.0])
        };
        Ok(Given {
            at_points: normals.into_iter().zip(factors).map(force).collect(),
            size: pressure.abs(),
        })
    }
}

fn norm(vector: [f64; COMPONENTS]) -> f64 {
    vector.iter().map(|value| value * value).sum::<f64>().sqrt()
}
