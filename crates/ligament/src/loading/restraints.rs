//! Springs, inclined rollers and platens of a setup on the points of its body.

use ligament_analysis::{Component, ProportionalLoading, Restraint, Restraints};
use ligament_model::System;
use ligament_model::tensor::directions_across;

use super::boundary::ActiveLoads;
use super::places::Places;
use crate::coordinates::narrowed;
use crate::error::{Fault, Field, SetupError};
use crate::setup::{Action, Load, Setup, Support};

/// Stiffness of inclined rollers and platens over the stiffness of a point's bonds: their compliance is negligible, and the loss of digits
/// in forces is acceptable.
const RIGID: f64 = 1e6;

/// A loading reduced to the components of the bonds, with the restraints of a setup; the far ends of springs move where their loads act.
pub(super) fn restrained<const D: usize>(
    setup: &Setup,
    system: &dyn System<D>,
    loading: ProportionalLoading,
    acting: ActiveLoads,
) -> Result<ProportionalLoading, SetupError> {
    let loading = loading.reduced(system.topology().layout);
    let is_restrained = setup.supports.iter().any(Support::is_restraint);
    if !is_restrained && !setup.loads.iter().any(Load::is_restraint) {
        return Ok(loading);
    }
    let cloud = &system.cloud;
    let mut restraining = RestraintBuilder {
        places: Places { setup, cloud },
        system,
        rigid: (system.point_stiffness().iter())
            .map(|it| RIGID * it.force)
            .collect(),
        list: Vec::new(),
        driving: vec![0.0; system.topology().layout.n_degrees_of_freedom()],
    };
    for (index, support) in setup.supports.iter().enumerate() {
        if support.is_restraint() {
            restraining.support(Field::element("supports", index), support)?;
        }
    }
    for (index, load) in setup.loads.iter().enumerate() {
        if load.is_restraint() {
            let acts = acting == ActiveLoads::All || acting == ActiveLoads::Load(index);
            restraining.load(Field::element("loads", index), load, acts)?;
        }
    }
    Ok(ProportionalLoading {
        restraints: Restraints::new(system.topology().layout, restraining.list).into(),
        driving: restraining.driving,
        ..loading
    })
}

/// Restraints collected so far.
struct RestraintBuilder<'a, const D: usize> {
    places: Places<'a, D>,
    system: &'a dyn System<D>,
    /// Stiffness at each point that counts as rigid, shape (n_points), N/m.
    rigid: Vec<f64>,
    list: Vec<Restraint>,
    /// Forces of the springs with moved far ends on the undisplaced body, shape (n_degrees_of_freedom), N.
    driving: Vec<f64>,
}

impl<const D: usize> RestraintBuilder<'_, D> {
    fn support(&mut self, field: Field, support: &Support) -> Result<(), SetupError> {
        let points = self.places.points(field, &support.place)?;
        let shares = self.places.shares(&support.place, &points);
        for (component, total) in support.stiffness.along_axes().components() {
            for &(point, share) in &shares {
                let dof = self
                    .system
                    .topology()
                    .layout
                    .degree_of_freedom(point, component);
                let along = dof.map(|dof| (dof as u32, 1.0));
                self.list
                    .extend(along.map(|it| Restraint::spring(&[it], share * total)));
            }
        }
        let Some(normal) = support.restrained_normal() else {
            return Ok(());
        };
        let normal = unit(narrowed(normal));
        for (point, share) in shares {
            let total = support.stiffness.normal.map(|total| share * total);
            let stiffness = total.unwrap_or(self.rigid[point as usize]);
            let along = self.along(normal, point, 1.0);
            self.list.push(Restraint::spring(&along, stiffness));
        }
        Ok(())
    }

    fn load(&mut self, field: Field, load: &Load, acts: bool) -> Result<(), SetupError> {
        let points = self.places.points(field, &load.place)?;
        let motion = load.action.motion().map(|it| it.vector::<D>());
        let direction = match (motion, load.action) {
            (Some(motion), _) => motion,
            (None, Action::Force(force)) => narrowed(force),
            (None, _) => return Ok(()),
        };
        let (direction, size) = (unit(direction), length(direction));
        if size == 0.0 {
            return Err(field.error(Fault::ZeroControl));
        }
        let first = self.list.len();
        if load.tilts {
            let is_driven = motion.is_some() && load.stiffness.is_none();
            self.platen(field, &points, direction, is_driven)?;
        }
        if let Some(total) = load.stiffness {
            let shares = self.places.shares(&load.place, &points);
            if load.tilts {
                let share = 1.0 / points.len() as f64;
                let mean = points
                    .iter()
                    .flat_map(|&it| self.along(direction, it, share));
                let mean: Vec<(u32, f64)> = mean.collect();
                self.list.push(Restraint::spring(&mean, total));
            } else {
                let springs = shares.iter().map(|&(point, share)| {
                    Restraint::spring(&self.along(direction, point, 1.0), share * total)
                });
                let springs: Vec<Restraint> = springs.collect();
                self.list.extend(springs);
            }
        }
        if motion.is_some() && acts {
            let factors = self.places.factors(field, load.profile.as_ref(), &points)?;
            self.drive(first, (&points, &factors), direction.map(|it| size * it));
        }
        Ok(())
    }

    /// A rigid platen on some points. Their displacements along a direction may be v_i = a + b s_i, with the distances s_i of the points
    /// from their middle across it (in space in two directions); any other part e costs k e^2/2, with the stiffness k of a point that
    /// counts as rigid. If the platen is driven, the part a costs as much.
    fn platen(
        &mut self,
        field: Field,
        points: &[u32],
        direction: [f64; D],
        is_driven: bool,
    ) -> Result<(), SetupError> {
        let tilts = self.tilts(points, direction);
        let spacing = self.places.cloud.spacing[points[0] as usize];
        if tilts.iter().any(|it| it.squares < spacing * spacing) {
            return Err(field.part("tilts").error(Fault::NoPlaten {
                points: points.len(),
            }));
        }
        let n = points.len() as f64;
        let stiffness = points.iter().map(|&it| self.rigid[it as usize]);
        let stiffness = stiffness.fold(0.0, f64::max);
        let mean = if is_driven { 0.0 } else { 1.0 / n };
        let entries = |row: usize| {
            let tilts = &tilts;
            (0..points.len()).map(move |column| {
                let own = if row == column { 1.0 } else { 0.0 };
                let part = |it: &Tilt| it.places[row] * it.places[column] / it.squares;
                let others = tilts.iter().fold(own - mean, |rest, it| rest - part(it));
                stiffness * others
            })
        };
        let between: Vec<Vec<f64>> = (0..points.len())
            .map(|row| entries(row).collect())
            .collect();
        let along: Vec<Vec<(u32, f64)>> = (points.iter())
            .map(|&point| self.along(direction, point, 1.0))
            .collect();
        let all = || {
            along.iter().enumerate().flat_map(|(place, of_point)| {
                of_point
                    .iter()
                    .map(move |&(dof, cosine)| (place, dof, cosine))
            })
        };
        let row = |(place, _, cosine): (usize, u32, f64)| {
            let between = &between[place];
            all().map(move |(other, _, of_other)| cosine * of_other * between[other])
        };
        self.list.push(Restraint {
            degrees_of_freedom: all().map(|(_, dof, _)| dof).collect(),
            stiffness: all().flat_map(row).collect(),
        });
        Ok(())
    }

    /// The tilts of some points about their middle across a direction: one in the plane, two orthogonal ones in space.
    fn tilts(&self, points: &[u32], direction: [f64; D]) -> Vec<Tilt> {
        let mut tilts: Vec<Tilt> = Vec::new();
        for across in directions_across(direction) {
            let place = |&point: &u32| {
                let position = self.places.cloud.positions[point as usize].iter();
                position.zip(across).map(|(x, cosine)| x * cosine).sum()
            };
            let places: Vec<f64> = points.iter().map(place).collect();
            let middle = places.iter().sum::<f64>() / points.len() as f64;
            let mut places: Vec<f64> = places.iter().map(|it| it - middle).collect();
            for before in &tilts {
                let shared = dot(&places, &before.places) / before.squares;
                let own = places.iter_mut().zip(&before.places);
                own.for_each(|(own, other)| *own -= shared * other);
            }
            tilts.push(Tilt {
                squares: dot(&places, &places),
                places,
            });
        }
        tilts
    }

    /// Moves the far ends of the restraints from index `first` on, at each of some points by a motion times the point's factor.
    fn drive(&mut self, first: usize, (points, factors): (&[u32], &[f64]), motion: [f64; D]) {
        let layout = self.system.topology().layout;
        let mut far_ends = vec![0.0; self.driving.len()];
        for (&point, factor) in points.iter().zip(factors) {
            for (component, value) in Component::in_dimensions(D).iter().zip(motion) {
                if let Some(dof) = layout.degree_of_freedom(point, *component) {
                    far_ends[dof] = factor * value;
                }
            }
        }
        for restraint in &self.list[first..] {
            let own = restraint.degrees_of_freedom.iter();
            let own: Vec<f64> = own.map(|&dof| far_ends[dof as usize]).collect();
            for (dof, force) in restraint.forces(&own) {
                self.driving[dof as usize] += force;
            }
        }
    }

    /// The displacement of a point along a direction times a factor, as degrees of freedom with weights.
    fn along(&self, direction: [f64; D], point: u32, factor: f64) -> Vec<(u32, f64)> {
        let layout = self.system.topology().layout;
        let parts = Component::in_dimensions(D).iter().copied().zip(direction);
        let parts = parts.filter(|(_, cosine)| *cosine != 0.0);
        let part = |(component, cosine)| {
            let dof = layout.degree_of_freedom(point, component)?;
            Some((dof as u32, factor * cosine))
        };
        parts.filter_map(part).collect()
    }
}

/// A tilt of points about their middle.
struct Tilt {
    /// Places of the points from their middle, shape (n_points), m.
    places: Vec<f64>,
    /// Sum of the squared places, m^2.
    squares: f64,
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

fn unit<const D: usize>(direction: [f64; D]) -> [f64; D] {
    let length = length(direction);
    direction.map(|it| it / length)
}

fn length<const D: usize>(vector: [f64; D]) -> f64 {
    match vector[..] {
        [x, y] => x.hypot(y),
        _ => vector.iter().map(|it| it * it).sum::<f64>().sqrt(),
    }
}
