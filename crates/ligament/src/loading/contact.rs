//! Contact of a model: the surfaces of its groups and parts, and its rigid bodies.

use std::collections::BTreeMap;
use std::sync::Arc;

use ligament_analysis::motion::contact::{ContactProblem, RigidBody, RigidMotion, SurfaceContact};
use ligament_model::System;
use ligament_model::surface::{Facet, FacetPair, Opposite, RigidShape, Surface};

use super::places::unknown_group;
use crate::coordinates::narrowed;
use crate::error::{Fault, Field, SetupError};
use crate::model::Model;
use crate::parts::Parts;
use crate::setup::check::contradiction;
use crate::setup::{Between, ContactLaw, Rigid, RigidForm, Setup};
use crate::system::over_dimension;

/// Depth in a rigid body over the spacing of the points, beyond which the start is not one of surfaces that touch.
const TOUCHING: f64 = 0.01;

/// The contacts of a model in motion.
///
/// # Errors
///
/// If a group is not in the body or has no part of its outline, two groups have facets in common, or a rigid body starts inside the body.
pub fn contact_problem(model: &Model) -> Result<ContactProblem, SetupError> {
    over_dimension!(&model.system, system => contacts(&model.setup, &**system))
}

/// The contacts of a setup on its points and bonds.
pub(super) fn contacts<const D: usize>(
    setup: &Setup,
    system: &dyn System<D>,
) -> Result<ContactProblem, SetupError> {
    Outline::new(setup, system).contacts()
}

/// The outline of a body, which contacts take facets from.
struct Outline<'a, const D: usize> {
    setup: &'a Setup,
    system: &'a dyn System<D>,
    facets: Vec<Facet<D>>,
    /// Stiffness E'/h of each facet, Pa/m.
    stiffness: Vec<f64>,
}

impl<'a, const D: usize> Outline<'a, D> {
    fn new(setup: &'a Setup, system: &'a dyn System<D>) -> Self {
        let cloud = &system.cloud;
        let facets = match setup.has_contact() {
            true => setup.body.geometry().facets(cloud),
            false => Vec::new(),
        };
        let moduli: Vec<f64> = setup
            .materials
            .iter()
            .map(|it| modulus(setup, it))
            .collect();
        let of_point = |point: u32| {
            let point = point as usize;
            cloud.mean_property(point, &moduli) / cloud.spacing[point]
        };
        let of_facet = |it: &Facet<D>| it.points().map(of_point).iter().sum::<f64>() / D as f64;
        Self {
            stiffness: facets.iter().map(of_facet).collect(),
            facets,
            setup,
            system,
        }
    }

    fn contacts(&self) -> Result<ContactProblem, SetupError> {
        let mut problem = ContactProblem::default();
        for (index, contact) in self.setup.contacts.iter().enumerate() {
            let field = Field::element("contacts", index).part("between");
            let sides = match &contact.between {
                Between::Groups(groups) => self.sides_of_groups(field, groups)?,
                Between::Parts => self.sides_of_parts(field)?,
            };
            let surfaces = self.pair(&sides, contact.law, Opposite::OtherSides);
            problem.contacts.push(SurfaceContact {
                name: contact.between.name(),
                surfaces: Arc::new(surfaces),
                rigid_body: None,
            });
        }
        for (index, body) in self.setup.rigid_bodies.iter().enumerate() {
            let field = Field::element("rigid_bodies", index);
            let shape = self.shape(&body.form);
            let sides = self.sides_against(field, body)?;
            self.require_outside(field, (body, &shape), &sides)?;
            let opposite = Opposite::Rigid(shape, body.mass.is_some());
            problem.contacts.push(SurfaceContact {
                name: body.name.clone(),
                surfaces: Arc::new(self.pair(&sides, body.law, opposite)),
                rigid_body: Some(index),
            });
            problem.rigid_bodies.push(RigidBody {
                name: body.name.clone(),
                motion: motion(body),
            });
        }
        Ok(problem)
    }

    /// Facets of the outline with a side, as a surface against what they may meet.
    fn pair(&self, sides: &[Option<u32>], law: ContactLaw, opposite: Opposite<D>) -> FacetPair<D> {
        let numbered = sides.iter().enumerate();
        let facets = numbered.filter_map(|(facet, side)| {
            Some((
                self.facets[facet],
                (*side)?,
                law.stiffness * self.stiffness[facet],
            ))
        });
        let surface = Surface::new(self.system.layout(), facets.collect());
        FacetPair::new(surface, opposite, law.friction)
    }

    /// Whether each facet belongs to the outline of a group: all its points do.
    fn is_of_group(&self, field: Field, group: &str) -> Result<Vec<bool>, SetupError> {
        let points = self.setup.body.points_of(group);
        let points = points.ok_or_else(|| field.error(unknown_group(self.setup, group)))?;
        let mut marked = vec![false; self.system.cloud.len()];
        for point in points {
            marked[point as usize] = true;
        }
        let is_in = |it: &Facet<D>| it.points().iter().all(|&point| marked[point as usize]);
        let of_group: Vec<bool> = self.facets.iter().map(is_in).collect();
        match of_group.contains(&true) {
            true => Ok(of_group),
            false => {
                let reason = format!(
                    "`{group}` has no part of the outline of the body, so that nothing can meet it: give a group with cells, or one at the \
                     outline, of a mesh or a lattice"
                );
                contradiction(field, reason).map(|()| of_group)
            }
        }
    }

    /// Side 0 for the facets of the first group, 1 for those of the second.
    fn sides_of_groups(
        &self,
        field: Field,
        [one, other]: &[String; 2],
    ) -> Result<Vec<Option<u32>>, SetupError> {
        let first = self.is_of_group(field, one)?;
        let second = self.is_of_group(field, other)?;
        let both = first.iter().zip(&second);
        if both.clone().any(|(first, second)| *first && *second) {
            let reason = format!(
                "`{one}` and `{other}` have a part of the outline in common, which cannot meet itself"
            );
            contradiction(field, reason)?;
        }
        let side = |(first, second): (&bool, &bool)| match (first, second) {
            (true, _) => Some(0),
            (false, true) => Some(1),
            (false, false) => None,
        };
        Ok(both.map(side).collect())
    }

    /// The number of the part of each facet, in the order of the first points of the parts.
    fn sides_of_parts(&self, field: Field) -> Result<Vec<Option<u32>>, SetupError> {
        let parts = Parts::of_bonds(&self.system.cloud, &self.system.bonds);
        let part = |it: &Facet<D>| parts.part(it.points()[0]);
        let mut numbers: BTreeMap<u32, u32> = self.facets.iter().map(|it| (part(it), 0)).collect();
        if numbers.len() < 2 {
            let reason = "bonds connect the whole body, so that there are no two parts with an outline that could meet: separate them by a gap or a \
                          pre-crack, or give two groups";
            contradiction(field, reason)?;
        }
        for (number, value) in (0..).zip(numbers.values_mut()) {
            *value = number;
        }
        let side = |it: &Facet<D>| numbers.get(&part(it)).copied();
        Ok(self.facets.iter().map(side).collect())
    }

    /// Side 0 for the facets that a rigid body meets.
    fn sides_against(&self, field: Field, body: &Rigid) -> Result<Vec<Option<u32>>, SetupError> {
        let field = field.part("against");
        if self.facets.is_empty() {
            let reason = "points from arrays have no outline, so that nothing can meet them: take a mesh or a lattice";
            contradiction(field, reason)?;
        }
        let mut sides = vec![body.against.is_empty().then_some(0); self.facets.len()];
        for group in &body.against {
            let of_group = self.is_of_group(field, group)?;
            for (side, _) in sides.iter_mut().zip(of_group).filter(|it| it.1) {
                *side = Some(0);
            }
        }
        Ok(sides)
    }

    /// The shape of a rigid body in the coordinates of the cloud.
    fn shape(&self, form: &RigidForm) -> RigidShape<D> {
        let cloud = &self.system.cloud;
        match *form {
            RigidForm::Ball { centre, radius } => RigidShape::Ball {
                centre: cloud.local(narrowed(centre)),
                radius,
            },
            RigidForm::Wall { point, normal } => {
                let normal: [f64; D] = narrowed(normal);
                let length = ligament_model::tensor::norm(normal);
                RigidShape::Wall {
                    point: cloud.local(narrowed(point)),
                    normal: normal.map(|it| it / length),
                }
            }
            RigidForm::Box { centre, size } => {
                let centre = cloud.local(narrowed(centre));
                let corner =
                    |sign: f64| std::array::from_fn(|axis| centre[axis] + sign * 0.5 * size[axis]);
                RigidShape::Box {
                    lower: corner(-1.0),
                    upper: corner(1.0),
                }
            }
        }
    }

    /// Refuses a rigid body that begins inside what it meets: the facets with a side, and the points of their groups.
    fn require_outside(
        &self,
        field: Field,
        (body, shape): (&Rigid, &RigidShape<D>),
        sides: &[Option<u32>],
    ) -> Result<(), SetupError> {
        let cloud = &self.system.cloud;
        let met = self.facets.iter().zip(sides).filter(|it| it.1.is_some());
        let corners = met.flat_map(|(facet, _)| facet.corners);
        let corners = corners.map(|it| (it.point, it.position));
        let points: Vec<u32> = match body.against.is_empty() {
            true => (0..cloud.len() as u32).collect(),
            false => (body.against.iter())
                .filter_map(|it| self.setup.body.points_of(it))
                .flatten()
                .collect(),
        };
        let points = points.iter().map(|&it| (it, cloud.positions[it as usize]));
        let depth = |(point, position): (u32, [f64; D])| (-shape.distance(position).0, point);
        let deeper = |one: (f64, u32), it: (f64, u32)| if it.0 > one.0 { it } else { one };
        let deepest = points.chain(corners).map(depth).reduce(deeper);
        let slack = |point: u32| TOUCHING * cloud.spacing[point as usize];
        match deepest.filter(|&(depth, point)| depth > slack(point)) {
            None => Ok(()),
            Some((depth, point)) => Err(field.error(Fault::StartsInside {
                depth,
                place: self.setup.body.place(point),
            })),
        }
    }
}

/// Largest stiffness E' of a material against strain along an axis without strain across it, Pa.
fn modulus(setup: &Setup, region: &crate::setup::MaterialRegion) -> f64 {
    let stiffness = region.material.elasticity.stiffness_in(setup.space());
    let along = stiffness.map(|it| {
        let axes = 0..it.nrows();
        axes.map(|axis| it[(axis, axis)]).fold(0.0, f64::max)
    });
    along.unwrap_or(0.0)
}

fn motion(body: &Rigid) -> RigidMotion {
    match body.mass {
        Some(mass) => RigidMotion::Free {
            mass,
            velocity: body.velocity,
        },
        None => RigidMotion::Prescribed {
            velocity: body.velocity,
            amplitude: body.amplitude.clone(),
        },
    }
}
