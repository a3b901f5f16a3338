//! Supports and loads of a setup on the points of its body.

use ligament_analysis::{
    BoundaryError, Component, Control, ControlKind, Layout, ProportionalLoading,
};
use ligament_mesh::Portion;
use ligament_model::{Bonds, LumpedMass, PointCloud, tensor};

use super::places::Places;
use super::samples;
use super::temperature::{Heating, heating};
use crate::error::{Fault, Field, SetupError};
use crate::setup::{
    Action, Couple, CurveAxis, Displacement, Load, MaterialRegion, Place, Profile, Sample, Setup,
};

/// Forces along the axes (N) and couples about them (N m), or their directions, in the order of the components: three in the plane, six in
/// space.
type Wrench = [f64; 6];

/// Selection of the loads that act.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ActiveLoads {
    /// All loads and the temperature.
    All,
    /// The load with this index, without temperature.
    Load(usize),
    /// The temperature without loads.
    Temperature,
}

/// Supports and acting loads on the points, with all components of the dimension, also those that the bonds do not have. Groups and control
/// do not depend on `acting`.
pub(super) fn boundary<const D: usize>(
    setup: &Setup,
    cloud: &PointCloud<D>,
    acting: ActiveLoads,
) -> Result<ProportionalLoading, SetupError> {
    let (places, components) = (Places { setup, cloud }, Component::in_dimensions(D));
    let heating = heating(&places)?;
    let n_points = cloud.len();
    let all = Layout {
        n_points,
        components,
    };
    let mut boundary = ProportionalLoading::new(all, places.control(heating.as_ref())?);
    let is_heated = matches!(acting, ActiveLoads::All | ActiveLoads::Temperature);
    if let Some(Heating { change, strain }) = heating.filter(|_| is_heated) {
        boundary.temperature_change = change;
        boundary.thermal_strain = strain;
    }
    for (index, support) in setup.supports.iter().enumerate() {
        let field = Field::element("supports", index);
        let points = places.points(field, &support.place)?;
        for component in support.components() {
            let each: Vec<(u32, f64)> = points.iter().map(|&point| (point, 1.0)).collect();
            places.prescribe(&mut boundary, field, &each, component, 0.0)?;
        }
        let group =
            boundary.report_group(&support.name(index), points, vec![0.0; components.len()]);
        group.holds.extend(support.components());
        group.restrains.extend(support.restrained());
    }
    for (index, load) in setup.loads.iter().enumerate() {
        let field = Field::element("loads", index);
        let points = places.points(field, &load.place)?;
        let mut total = vec![0.0; components.len()];
        let motion = load.action.motion().filter(|_| !load.is_restraint());
        let holds = (motion.iter()).flat_map(|it| it.components().map(|(component, _)| component));
        let holds: Vec<Component> = holds.collect();
        if acting == ActiveLoads::All || acting == ActiveLoads::Load(index) {
            let factors = places.factors(field, load.profile.as_ref(), &points)?;
            if let Some(motion) = motion {
                let each: Vec<(u32, f64)> = points.iter().copied().zip(factors).collect();
                for (component, value) in motion.components() {
                    places.prescribe(&mut boundary, field, &each, component, value)?;
                }
            }
            for (point, force) in places.forces(field, load, &points)?.at_points {
                for ((&component, value), sum) in components.iter().zip(force).zip(&mut total) {
                    boundary.add_force(point, component, value);
                    *sum += value;
                }
            }
        }
        let group = boundary.report_group(&load.name, points, total);
        group.holds.extend(holds);
        group.restrains.extend(load.restrained());
    }
    Ok(boundary)
}

/// Refuses couples on points without rotational stiffness, on which they would have no effect.
pub(super) fn require_rotational_stiffness<const D: usize>(
    setup: &Setup,
    boundary: &ProportionalLoading,
    system: &dyn Bonds,
) -> Result<(), SetupError> {
    let is_couple = |it: &Load| matches!(it.action, Action::Moment(_) | Action::BodyCouple(_));
    let Some(load) = setup.loads.iter().position(is_couple) else {
        return Ok(());
    };
    let (bonds, subdomain) = (system.layout, &system.subdomain);
    let resisted = (system.rigidities()).resisted(&system.ends, bonds, subdomain);
    let rotations = || {
        Component::in_dimensions(D)
            .iter()
            .filter(|it| it.is_rotation())
    };
    let is_idle = |&point: &u32| {
        rotations().any(|&rotation| {
            let [given, turned] =
                [boundary.layout, bonds].map(|layout| layout.degree_of_freedom(point, rotation));
            let is_resisted = turned.is_some_and(|dof| resisted[dof]);
            let acts =
                |dof: usize| boundary.force[dof] != 0.0 && boundary.prescribed[dof].is_none();
            given.is_some_and(acts) && !is_resisted
        })
    };
    match (0..bonds.n_points as u32).filter(is_idle).count() {
        0 => Ok(()),
        points => {
            let field = Field::element("loads", load).part("action");
            Err(field.error(Fault::IdleCouple { points }))
        }
    }
}

/// Forces and couples of a load at load factor 1, N and N m.
#[derive(Default)]
struct Given {
    /// Points of the load with their forces and couples.
    at_points: Vec<(u32, Wrench)>,
    /// Size before the profile: of the sum over the points, N or N m, or the pressure, Pa.
    size: f64,
}

impl<const D: usize> Places<'_, D> {
    /// Prescribes a component times the factor of each point.
    fn prescribe(
        &self,
        boundary: &mut ProportionalLoading,
        field: Field,
        each: &[(u32, f64)],
        component: Component,
        value: f64,
    ) -> Result<(), SetupError> {
        let done = each.iter().try_for_each(|&(point, factor)| {
            boundary.prescribe(&[point], component, factor * value)
        });
        done.map_err(|error| {
            let BoundaryError::Conflict {
                point,
                component,
                first,
                second,
            } = error;
            let place = self.setup.body.label(point);
            let part = match field.name {
                "loads" => "action",
                _ => "displacement",
            };
            field.part(part).error(Fault::PrescribedTwice {
                component,
                place,
                first,
                second,
            })
        })
    }

    /// The axis of the force-displacement curve.
    fn control(&self, heating: Option<&Heating>) -> Result<Control, SetupError> {
        let axis = self.setup.curve_axis();
        let CurveAxis::Load(index) = axis else {
            return self.control_without_load(axis, heating);
        };
        let (field, load) = (Field::element("loads", index), &self.setup.loads[index]);
        let points = self.points(field, &load.place)?;
        let factors = self.factors(field, load.profile.as_ref(), &points)?;
        let given = self.forces(field, load, &points)?;
        let motion = load.action.motion().map(|it| motion::<D>(&it));
        let magnitude = motion.map_or(given.size, norm);
        if magnitude == 0.0 {
            return Err(field.error(Fault::ZeroControl));
        }
        let (kind, (points, shape)) = match motion {
            Some(motion) => {
                let direction = motion.map(|value| value / magnitude);
                let direction = &direction[..Component::in_dimensions(D).len()];
                let shape = factors
                    .iter()
                    .flat_map(|factor| direction.iter().map(move |cosine| factor * cosine));
                (ControlKind::Displacement, (points, shape.collect()))
            }
            None => {
                let (points, forces): (Vec<u32>, Vec<Wrench>) = given.at_points.into_iter().unzip();
                let values = forces
                    .iter()
                    .flat_map(|it| &it[..Component::in_dimensions(D).len()]);
                let shares = values.map(|value| value / magnitude);
                (ControlKind::Force, (points, shares.collect()))
            }
        };
        Ok(Control {
            kind,
            points,
            shape,
            magnitude,
        })
    }

    /// The axis of the force-displacement curve where it does not belong to a load.
    fn control_without_load(
        &self,
        axis: CurveAxis,
        heating: Option<&Heating>,
    ) -> Result<Control, SetupError> {
        let setup = self.setup;
        let (kind, shape, magnitude) = match axis {
            CurveAxis::RigidBody(body) => {
                let motion = setup.rigid_bodies[body].motion();
                let magnitude = tensor::norm(motion);
                let direction = motion.map(|it| it / magnitude).to_vec();
                (ControlKind::RigidBody(body), direction, magnitude)
            }
            CurveAxis::FreeBody(body) => {
                let rigid = &setup.rigid_bodies[body];
                let direction = rigid.direction();
                let length = tensor::norm(direction);
                let direction = direction.map(|it| it / length).to_vec();
                let speed = tensor::norm(rigid.velocity);
                (ControlKind::FreeBody(body), direction, speed)
            }
            CurveAxis::Nothing if setup.analysis.is_motion() || !setup.rigid_bodies.is_empty() => {
                (ControlKind::Force, Vec::new(), 0.0)
            }
            _ => {
                let changes = heating.map_or(&[][..], |it| &it.change);
                let magnitude = changes.iter().map(|it| it.abs()).fold(0.0, f64::max);
                if magnitude == 0.0 {
                    return Err(Field::whole("temperatures").error(Fault::NothingHappens));
                }
                (ControlKind::Temperature, Vec::new(), magnitude)
            }
        };
        Ok(Control {
            kind,
            points: Vec::new(),
            shape,
            magnitude,
        })
    }

    /// Factors of a profile at the points, shape (n_points); 1 without a profile.
    pub(super) fn factors(
        &self,
        field: Field,
        profile: Option<&Profile>,
        points: &[u32],
    ) -> Result<Vec<f64>, SetupError> {
        let Some(profile) = profile else {
            return Ok(vec![1.0; points.len()]);
        };
        let factors: Vec<f64> = match profile {
            Profile::Linear { along, zero, one } => {
                let coordinate = |point: u32| self.setup.body.position(point)[along.number()];
                let factor = |&point: &u32| (coordinate(point) - zero) / (one - zero);
                points.iter().map(factor).collect()
            }
            Profile::Table(samples) => {
                let field = field.part("profile");
                self.sampled(field, samples, points)?
            }
        };
        if factors.iter().all(|&factor| factor == 0.0) {
            return Err(field.part("profile").error(Fault::ZeroProfile));
        }
        Ok(factors)
    }

    /// Factors of a table at the points, shape (n_points).
    fn sampled(
        &self,
        field: Field,
        samples: &[Sample],
        points: &[u32],
    ) -> Result<Vec<f64>, SetupError> {
        let body = &*self.setup.body;
        let all = samples::at_points(samples, body, self.cloud);
        let all = all.map_err(|fault| field.error(fault))?;
        let missing = |point: &&u32| all[**point as usize].is_none();
        if let Some(first) = points.iter().find(missing) {
            return Err(field.error(Fault::NoValue {
                what: "factor of the load",
                points: points.iter().filter(missing).count(),
                reason: samples::MISSING,
                first: body.place(*first),
            }));
        }
        Ok(points.iter().filter_map(|&it| all[it as usize]).collect())
    }

    /// Portions of a group by area (m^2), or else by length (m); empty for other places.
    fn extents(&self, place: &Place) -> Vec<Portion<1>> {
        let Place::Group(group) = place else {
            return Vec::new();
        };
        let areas = self.setup.body.areas_of(group);
        if areas.is_empty() {
            self.setup.body.lengths_of(group)
        } else {
            areas
        }
    }

    /// Shares of points in a total, which sum to one: by the areas or lengths that they represent where the group has these, elsewhere by
    /// volume.
    pub(super) fn shares(&self, place: &Place, points: &[u32]) -> Vec<(u32, f64)> {
        let extents = self.extents(place);
        let weights = match extents.is_empty() {
            true => self.volumes(points),
            false => weights(&extents),
        };
        let total = size(&weights);
        let share = |(point, weight): (u32, f64)| (point, weight / total);
        weights.into_iter().map(share).collect()
    }

    /// Forces and couples of a load on its points; empty where the load prescribes a displacement.
    ///
    /// A total force is distributed over a group with an area or a length by areas or lengths, over other places by the points' volumes; a
    /// force per length by lengths, a force per area by areas; body forces and all couples by volumes. A profile multiplies the force along
    /// lengths and areas, of which the points [take their parts](Self::along), and elsewhere the share of each point.
    fn forces(&self, field: Field, load: &Load, points: &[u32]) -> Result<Given, SetupError> {
        match &load.action {
            Action::Displacement(_) | Action::Velocity(_) | Action::BaseAcceleration(_) => {
                Ok(Given::default())
            }
            Action::Pressure(pressure) => self.pressures(field, load, *pressure),
            Action::BodyForce(force) => {
                self.on_points(field, load, &self.volumes(points), force_alone(force))
            }
            Action::Acceleration(acceleration) => {
                let masses = self.masses(points)?;
                self.on_points(field, load, &masses, force_alone(acceleration))
            }
            Action::BodyCouple(couple) => {
                let couple = couple_alone::<D>(couple);
                self.on_points(field, load, &self.volumes(points), couple)
            }
            Action::Moment(couple) => {
                let volumes = self.volumes(points);
                let total = size(&volumes);
                let couple = couple_alone::<D>(couple).map(|value| value / total);
                self.on_points(field, load, &volumes, couple)
            }
            Action::ForcePerLength(force) => {
                let lengths = self.lengths(field, &load.place)?;
                self.on_portions(field, load, &lengths, force_alone(force))
            }
            Action::ForcePerArea(force) => {
                let areas = self.areas(field, &load.place)?;
                self.on_portions(field, load, &areas, force_alone(force))
            }
            Action::Force(force) => {
                let (extents, volumes) = (self.extents(&load.place), self.volumes(points));
                let over = |total: f64| force_alone(force).map(|value| value / total);
                match extents.is_empty() {
                    true => self.on_points(field, load, &volumes, over(size(&volumes))),
                    false => {
                        let density = over(size(&weights(&extents)));
                        self.on_portions(field, load, &extents, density)
                    }
                }
            }
        }
    }

    /// Points with their volumes, m^3.
    fn volumes(&self, points: &[u32]) -> Vec<(u32, f64)> {
        let volume = |&point: &u32| (point, self.cloud.volumes[point as usize]);
        points.iter().map(volume).collect()
    }

    /// A load by its density on points with weights, each times the profile at the point.
    fn on_points(
        &self,
        field: Field,
        load: &Load,
        weights: &[(u32, f64)],
        density: Wrench,
    ) -> Result<Given, SetupError> {
        let loaded: Vec<u32> = weights.iter().map(|(point, _)| *point).collect();
        let factors = self.factors(field, load.profile.as_ref(), &loaded)?;
        let at_points = weights.iter().zip(factors);
        let share = |(&(point, weight), factor): (&(u32, f64), f64)| {
            (point, density.map(|value| factor * (value * weight)))
        };
        Ok(Given {
            at_points: at_points.map(share).collect(),
            size: norm(density.map(|value| value * size(weights))),
        })
    }

    /// A load by its density along portions.
    fn on_portions(
        &self,
        field: Field,
        load: &Load,
        portions: &[Portion<1>],
        density: Wrench,
    ) -> Result<Given, SetupError> {
        let total = size(&weights(portions));
        let force = |[weight]: [f64; 1]| density.map(|value| value * weight);
        Ok(Given {
            at_points: self.along(field, load, portions, force)?,
            size: norm(density.map(|value| value * total)),
        })
    }

    /// Forces at the points of portions, from the force of a share: those that do the same work as the distributed load, whose profile is linear
    /// between the corners, on displacements that are linear between them.
    ///
    /// The force and the moment of a linear profile are exact. On portions of a single point the profile is that at the point.
    fn along<const N: usize>(
        &self,
        field: Field,
        load: &Load,
        portions: &[Portion<N>],
        force: impl Fn([f64; N]) -> Wrench,
    ) -> Result<Vec<(u32, Wrench)>, SetupError> {
        let at_points = Portion::at_points(portions);
        let Some(profile) = &load.profile else {
            let forces = at_points.into_iter();
            return Ok(forces.map(|(point, share)| (point, force(share))).collect());
        };
        let points: Vec<u32> = at_points.iter().map(|(point, _)| *point).collect();
        let factors = self.factors(field, Some(profile), &points)?;
        let factor = |point: u32| factors[points.partition_point(|it| *it < point)];
        let forces = portions.iter().map(|it| Portion {
            corners: it.corners.clone(),
            share: force(it.share),
        });
        let forces: Vec<Portion<6>> = forces.collect();
        let sums = Portion::sums(&forces, |portion, corner| portion.mean(corner, factor));
        Ok(sums)
    }

    /// Portions of a group by length, m.
    fn lengths(&self, field: Field, place: &Place) -> Result<Vec<Portion<1>>, SetupError> {
        let lengths = match place {
            Place::Group(group) => self.setup.body.lengths_of(group),
            _ => Vec::new(),
        };
        match lengths.is_empty() {
            true => Err(field.part("place").error(Fault::NoLength)),
            false => Ok(lengths),
        }
    }

    /// Portions of a group by area, m^2.
    fn areas(&self, field: Field, place: &Place) -> Result<Vec<Portion<1>>, SetupError> {
        let areas = match place {
            Place::Group(group) => self.setup.body.areas_of(group),
            _ => Vec::new(),
        };
        match areas.is_empty() {
            true => Err(field.part("place").error(Fault::NoArea)),
            false => Ok(areas),
        }
    }

    /// Points with their masses, kg.
    fn masses(&self, points: &[u32]) -> Result<Vec<(u32, f64)>, SetupError> {
        let density = |(index, region): (usize, &MaterialRegion)| {
            region.material.density.ok_or_else(|| {
                let fault = Fault::Missing {
                    property: "density",
                    reason: "(in kg/m^3) because an acceleration acts on masses".to_owned(),
                };
                Field::element("materials", index)
                    .part("density")
                    .error(fault)
            })
        };
        let materials = self.setup.materials.iter().enumerate();
        let densities: Vec<f64> = materials.map(density).collect::<Result<_, _>>()?;
        let mass = LumpedMass::new(self.cloud, &densities).mass;
        Ok((points.iter().map(|&point| (point, mass[point as usize]))).collect())
    }

    /// Forces of a pressure p on the outline of a group: -p t n L, half at each node of an edge of a mesh of length L and outward normal n,
    /// or at the cell of a lattice whose face it is; in space -p n A with the area A of a face. Normals, lengths and areas refer to the
    /// undeformed body (a dead load).
    fn pressures(&self, field: Field, load: &Load, pressure: f64) -> Result<Given, SetupError> {
        let place = field.part("place");
        let normals = match &load.place {
            Place::Group(group) => self.setup.body.geometry().outline_of(group),
            _ => Ok(Vec::new()),
        };
        let normals = normals.map_err(|error| place.error(Fault::OffOutline(error)))?;
        if normals.is_empty() {
            return Err(place.error(Fault::NoOutline));
        }
        let per_length = -pressure * self.cloud.thickness;
        let force = |normal: [f64; D]| force_alone(&normal.map(|it| per_length * it));
        Ok(Given {
            at_points: self.along(field, load, &normals, force)?,
            size: pressure.abs(),
        })
    }
}

/// Points of portions with their lengths, m, or areas, m^2.
fn weights(portions: &[Portion<1>]) -> Vec<(u32, f64)> {
    let at_points = Portion::at_points(portions).into_iter();
    at_points.map(|(point, [weight])| (point, weight)).collect()
}

/// Sum of the weights of points.
fn size(weights: &[(u32, f64)]) -> f64 {
    weights.iter().map(|(_, weight)| weight).sum()
}

/// A force without a couple.
fn force_alone<const D: usize>(force: &[f64; D]) -> Wrench {
    std::array::from_fn(|place| force.get(place).copied().unwrap_or(0.0))
}

/// A couple without a force; in the plane only its component about z.
fn couple_alone<const D: usize>(couple: &Couple) -> Wrench {
    let about = |component: &Component| match component {
        Component::RotationX => couple.about[0],
        Component::RotationY => couple.about[1],
        Component::Rotation | Component::RotationZ => couple.about[2],
        Component::X | Component::Y | Component::Z => 0.0,
    };
    of_components::<D>(about)
}

/// Prescribed motion on the axis of a force-displacement curve: the displacements, or the rotations where the displacements are zero.
fn motion<const D: usize>(given: &Displacement) -> Wrench {
    let is_turned = (given.components()).all(|(it, value)| it.is_rotation() || value == 0.0);
    let value = |component: &Component| {
        let mut values = given.components();
        let value = values.find(|(it, _)| it == component);
        let value = value.filter(|(it, _)| it.is_rotation() == is_turned);
        value.map_or(0.0, |(_, value)| value)
    };
    of_components::<D>(value)
}

fn of_components<const D: usize>(value: impl Fn(&Component) -> f64) -> Wrench {
    let components = Component::in_dimensions(D);
    std::array::from_fn(|place| components.get(place).map_or(0.0, &value))
}

fn norm(vector: Wrench) -> f64 {
    vector.iter().map(|value| value * value).sum::<f64>().sqrt()
}
