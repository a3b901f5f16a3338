//! Contact of a model: the surfaces of its groups and parts, and its rigid bodies.

use std::collections::BTreeMap;
use std::sync::Arc;

use ligament_analysis::contact::{ContactProblem, RigidBody, RigidMotion, SurfaceContact};
use ligament_model::System;
use ligament_model::surface::{
    Bonded, Boundaries, CellFaces, CrackFaces, Facet, FacetPair, Opposite, RigidShape, Surface,
    SurfacePair, UndeformedPair,
};

use super::places::unknown_group;
use super::rigid_surface::rigid_surface;
use crate::coordinates::narrowed;
use crate::error::{Fault, Field, SetupError};
use crate::model::Model;
use crate::parts::Parts;
use crate::setup::check::contradiction;
use crate::setup::{Analysis, ContactLaw, Position, Rigid, RigidForm, Setup};
use crate::system::over_dimension;

/// Depth in a rigid body, over the spacing of the points, up to which surfaces count as touching at the start.
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
    let mut problem = ContactProblem::default();
    let with = |cracks: bool| {
        let has = setup.contacts.iter().any(|it| it.cracks == cracks);
        has || setup.rigid_bodies.iter().any(|it| it.cracks == cracks)
    };
    let outlines =
        [false, true].map(|cracks| with(cracks).then(|| Outline::new(setup, system, cracks)));
    let outline = |cracks: bool| outlines[usize::from(cracks)].as_ref();
    for (index, contact) in setup.contacts.iter().enumerate() {
        let field = Field::element("contacts", index).part("between");
        let Some(outline) = outline(contact.cracks) else {
            continue;
        };
        let surfaces = match &contact.between {
            Some(groups) => {
                let sides = outline.sides_of_groups(field, groups)?;
                outline.pair(sides, contact.law(), Opposite::OtherSides)
            }
            None if contact.cracks => {
                let sides = outline.one_side(field)?;
                outline.pair(sides, contact.law(), Opposite::Unbonded)
            }
            None => {
                let sides = outline.sides_of_parts(field)?;
                outline.pair(sides, contact.law(), Opposite::OtherSides)
            }
        };
        problem.contacts.push(SurfaceContact {
            name: contact.name(),
            surfaces,
            rigid_body: None,
        });
    }
    for (index, body) in setup.rigid_bodies.iter().enumerate() {
        if let Some(outline) = outline(body.cracks) {
            outline.meet(index, body, &mut problem)?;
        }
    }
    Ok(problem)
}

/// The outline of a body, which contacts take facets from.
struct Outline<'a, const D: usize> {
    setup: &'a Setup,
    system: &'a dyn System<D>,
    facets: Vec<Facet<D>>,
    /// Stiffness E'/h at each point, Pa/m.
    stiffness: Vec<f64>,
    /// Faces between the points, where faces of cracks take part.
    boundaries: Option<Arc<Boundaries<D>>>,
}

/// Sides of the facets of the outline, and of the faces of cracks at points; `None` for facets and points that take no part.
struct Sides {
    /// Shape (n_facets).
    of_facets: Vec<Option<u32>>,
    /// Shape (n_points); empty where faces of cracks take no part.
    of_points: Vec<Option<u32>>,
}

impl<'a, const D: usize> Outline<'a, D> {
    /// The outline, with the faces of cracks or without them.
    fn new(setup: &'a Setup, system: &'a dyn System<D>, cracks: bool) -> Self {
        let cloud = &system.cloud;
        let body = setup.body.geometry();
        let (facets, inner) = match cracks.then(|| body.cell_faces(cloud)).flatten() {
            Some(CellFaces { outline, inner }) => (outline, Some(inner)),
            None => (body.facets(cloud), None),
        };
        let boundaries = inner.map(|it| {
            Arc::new(Boundaries::new(
                it,
                cloud,
                &system.bonds,
                system.faces.cut(),
            ))
        });
        let moduli: Vec<f64> = setup
            .materials
            .iter()
            .map(|it| modulus(setup, it))
            .collect();
        let of_point = |point: usize| cloud.mean_property(point, &moduli) / cloud.spacing[point];
        Self {
            stiffness: (0..cloud.len()).map(of_point).collect(),
            facets,
            boundaries,
            setup,
            system,
        }
    }

    /// Adds a rigid body of the setup and its contact.
    fn meet(
        &self,
        index: usize,
        body: &Rigid,
        problem: &mut ContactProblem,
    ) -> Result<(), SetupError> {
        let field = Field::element("rigid_bodies", index);
        let shape = self.shape(&body.form);
        let sides = self.sides_against(field, body)?;
        let gap = self.require_outside(field, (body, &shape), &sides.of_facets)?;
        let opposite = Opposite::Rigid(shape, body.mass.is_some());
        problem.contacts.push(SurfaceContact {
            name: body.name.clone(),
            surfaces: self.pair(sides, body.law, opposite),
            rigid_body: Some(index),
        });
        problem.rigid_bodies.push(RigidBody {
            name: body.name.clone(),
            motion: motion(body),
            gap,
            surface: rigid_surface(&body.form, self.bounds(), D == 3),
        });
        Ok(())
    }

    /// The pair of the surface of these sides with its opposite: on the exact path in the undeformed body, elsewhere in present positions.
    fn pair(&self, sides: Sides, law: ContactLaw, opposite: Opposite<D>) -> Arc<dyn SurfacePair> {
        let surface = self.surface(sides, law);
        if !matches!(self.setup.analysis, Analysis::Event(_)) {
            return Arc::new(FacetPair::new(surface, opposite, law.friction));
        }
        let bonds = Bonded {
            families: self.system.topology().families(),
            intact: &vec![true; self.system.topology().ends.len()],
        };
        Arc::new(UndeformedPair::new(surface, opposite, bonds))
    }

    /// The surface of these sides.
    fn surface(&self, sides: Sides, law: ContactLaw) -> Surface<D> {
        let of_point = |point: u32| self.stiffness[point as usize];
        let numbered = self.facets.iter().zip(&sides.of_facets);
        let facets = numbered.filter_map(|(facet, side)| {
            let count = facet.points().count() as f64;
            let mean = facet.points().map(of_point).sum::<f64>() / count;
            Some((*facet, (*side)?, law.stiffness * mean))
        });
        let mut surface = Surface::new(self.system.topology().layout, facets.collect());
        if let Some(boundaries) = &self.boundaries {
            let points = sides.of_points.iter().zip(&self.stiffness);
            let of_point = |(side, stiffness): (&Option<u32>, &f64)| {
                side.map(|side| (side, law.stiffness * stiffness))
            };
            surface = surface.with_cracks(CrackFaces {
                boundaries: boundaries.clone(),
                of_points: points.map(of_point).collect(),
            });
        }
        surface
    }

    /// Whether each point is in a group.
    fn is_in_group(&self, field: Field, group: &str) -> Result<Vec<bool>, SetupError> {
        let points = self.setup.body.points_of(group);
        let points = points.ok_or_else(|| field.error(unknown_group(self.setup, group)))?;
        let mut marked = vec![false; self.system.cloud.len()];
        for point in points {
            marked[point as usize] = true;
        }
        Ok(marked)
    }

    /// Whether each facet belongs to the outline of a group: all its points do.
    fn is_of_group(&self, field: Field, group: &str) -> Result<Vec<bool>, SetupError> {
        let marked = self.is_in_group(field, group)?;
        let is_in = |it: &Facet<D>| it.points().all(|point| marked[point as usize]);
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

    /// Side 0 for the facets of the first group, 1 for the facets of the second.
    fn sides_of_groups(
        &self,
        field: Field,
        [one, other]: &[String; 2],
    ) -> Result<Sides, SetupError> {
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
        let of_points = match self.boundaries {
            Some(_) => {
                let second = self.is_in_group(field, other)?;
                let first = self.is_in_group(field, one)?.into_iter().zip(second);
                // Points of both groups have no side.
                let apart = first.map(|(one, other)| (one && !other, other && !one));
                apart.map(|(one, other)| side((&one, &other))).collect()
            }
            None => Vec::new(),
        };
        Ok(Sides {
            of_facets: both.map(side).collect(),
            of_points,
        })
    }

    /// One side for all facets and points.
    fn one_side(&self, field: Field) -> Result<Sides, SetupError> {
        self.require_outline(field)?;
        Ok(Sides {
            of_facets: vec![Some(0); self.facets.len()],
            of_points: vec![Some(0); self.system.cloud.len()],
        })
    }

    /// Refuses bodies of points from arrays.
    fn require_outline(&self, field: Field) -> Result<(), SetupError> {
        if self.facets.is_empty() {
            let reason = "points from arrays have no outline, so that nothing can meet them: take a mesh or a lattice";
            contradiction(field, reason)?;
        }
        Ok(())
    }

    /// The number of the part of each facet, in the order of the smallest number of a node or cell of each part in its file.
    fn sides_of_parts(&self, field: Field) -> Result<Sides, SetupError> {
        let parts = Parts::of_bonds(&self.system.cloud, &self.system.bonds);
        let part = |it: &Facet<D>| parts.part(it.corners[0].point);
        let mut numbers: BTreeMap<u32, u32> = self.facets.iter().map(|it| (part(it), 0)).collect();
        if numbers.len() < 2 {
            let reason = "bonds connect the whole body, so that there are no two parts with an outline that could meet: separate them by a gap or a \
                          pre-crack, or give two groups";
            contradiction(field, reason)?;
        }
        let body = self.setup.body.geometry::<D>();
        let mut least: BTreeMap<u32, u64> = BTreeMap::new();
        for point in 0..self.system.cloud.len() as u32 {
            let tag = body.tag(point);
            let least = least.entry(parts.part(point)).or_insert(tag);
            *least = tag.min(*least);
        }
        let mut in_order: Vec<u32> = numbers.keys().copied().collect();
        in_order.sort_by_key(|part| least.get(part));
        for (number, part) in (0..).zip(in_order) {
            numbers.insert(part, number);
        }
        let side = |it: &Facet<D>| numbers.get(&part(it)).copied();
        Ok(Sides {
            of_facets: self.facets.iter().map(side).collect(),
            of_points: Vec::new(),
        })
    }

    /// Side 0 for the facets that a rigid body meets.
    fn sides_against(&self, field: Field, body: &Rigid) -> Result<Sides, SetupError> {
        let field = field.part("against");
        if body.against.is_empty() {
            return self.one_side(field);
        }
        self.require_outline(field)?;
        let mut sides = Sides {
            of_facets: vec![None; self.facets.len()],
            of_points: vec![None; self.system.cloud.len()],
        };
        let add = |sides: &mut [Option<u32>], of_group: Vec<bool>| {
            for (side, _) in sides.iter_mut().zip(of_group).filter(|it| it.1) {
                *side = Some(0);
            }
        };
        for group in &body.against {
            add(&mut sides.of_facets, self.is_of_group(field, group)?);
            add(&mut sides.of_points, self.is_in_group(field, group)?);
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

    /// Corners of the box around the points, in the coordinates of the case, m.
    fn bounds(&self) -> [Position; 2] {
        let positions = (0..self.system.cloud.len() as u32).map(|it| self.setup.body.position(it));
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for position in positions {
            for (axis, &along) in position.iter().enumerate() {
                bounds[0][axis] = bounds[0][axis].min(along);
                bounds[1][axis] = bounds[1][axis].max(along);
            }
        }
        // In the plane z = 0.
        bounds.map(|it| it.map(|along: f64| if along.is_finite() { along } else { 0.0 }))
    }

    /// Refuses a rigid body that begins inside its opposite: the facets with a side, and the points of their groups. Returns its distance from
    /// them, m.
    fn require_outside(
        &self,
        field: Field,
        (body, shape): (&Rigid, &RigidShape<D>),
        sides: &[Option<u32>],
    ) -> Result<f64, SetupError> {
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
            None => Ok(deepest.map_or(f64::INFINITY, |it| (-it.0).max(0.0))),
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
            inertia: body.inertia.unwrap_or(f64::INFINITY),
            velocity: body.velocity,
            acceleration: body.acceleration,
        },
        // In statics the load factor takes the place of the time.
        None => RigidMotion::Prescribed {
            velocity: body.motion(),
            amplitude: body.amplitude.clone(),
        },
    }
}
