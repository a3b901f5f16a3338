//! Probes: numbers read off the body at every load step.

use ligament_model::Bonds;
use ligament_model::failure::{Criteria, Weakened};

use crate::balanced::Balanced;
use crate::contact;
use crate::fields;
use crate::state::State;
use crate::unknowns::{Component, Layout};

/// A column of the history.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Name of the column.
    pub name: String,
    /// Quantity that the probe reads.
    pub reading: Reading,
}

/// A place in the body: points and their shares in what is read there, which add up to one.
pub type Shares = Vec<(u32, f64)>;

/// What a probe reads.
#[derive(Debug, Clone, PartialEq)]
pub enum Reading {
    /// Motion at the second place minus that at the first (crack mouth opening, strain gauge), m or rad.
    RelativeDisplacement {
        /// The two places.
        places: [Shares; 2],
        /// Component.
        component: Component,
    },
    /// A field at a place.
    Field {
        /// Place.
        place: Shares,
        /// Field.
        field: PointField,
    },
    /// Force through a line: what the part on its right exerts on the part on its left, seen along it, N; in space through a plane, what
    /// the part before it exerts on the part behind. Only bonds of two points count.
    SectionForce {
        /// Bonds that cross the line, ascending, and whether their first end lies on the left or behind; bonds that pre-cracks cut are
        /// numbered on from the others.
        bonds: Vec<(u32, bool)>,
        /// Component: x or y.
        component: Component,
    },
}

/// Fields that a probe can read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointField {
    /// Damage phi.
    Damage,
    /// Damage by one way of failing, see [`fields::damage_by`].
    DamageBy(Weakened),
    /// A displacement or the rotation, m or rad; zero where points do not have it.
    Motion(Component),
    /// Strain energy density, J/m^3.
    StrainEnergyDensity,
    /// A component of the virial stress, Pa.
    Stress(StressComponent),
}

/// A component of a symmetric stress, in the order in which bonds give them: the three of the plane, and those that a solid has
/// beside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressComponent {
    /// sigma_xx.
    Xx,
    /// sigma_yy.
    Yy,
    /// sigma_xy.
    Xy,
    /// sigma_zz.
    Zz,
    /// sigma_xz.
    Xz,
    /// sigma_yz.
    Yz,
}

/// The values of probes in a state of equilibrium.
pub(crate) fn values(
    probes: &[Probe],
    system: &dyn Bonds,
    criteria: &Criteria,
    state: &State,
    balanced: &Balanced,
) -> Vec<f64> {
    let readings = probes.iter().map(|it| &it.reading);
    let subdomain = system.subdomain();
    let first_is_owned =
        |place: &Shares| (place.first()).is_some_and(|(point, _)| subdomain.owns(*point));
    let parts = readings.map(|reading| match reading {
        // The motions of points that are read are known to all: one process reads the whole.
        Reading::RelativeDisplacement { places, .. } if !first_is_owned(&places[0]) => 0.0,
        Reading::Field {
            place,
            field: PointField::Motion(_),
        } if !first_is_owned(place) => 0.0,
        Reading::Field { place, field } if !matches!(field, PointField::Motion(_)) => {
            let own = place.iter().filter(|(point, _)| subdomain.owns(*point));
            let own = Reading::Field {
                place: own.copied().collect(),
                field: *field,
            };
            own.value(system, criteria, state, balanced)
        }
        Reading::SectionForce { bonds, component } => {
            let ends = system.ends();
            let owned = bonds.iter().filter(|(bond, _)| {
                let ends = ends.get(*bond as usize);
                ends.is_some_and(|ends| subdomain.owns_bond(*ends))
            });
            let owned = Reading::SectionForce {
                bonds: owned.copied().collect(),
                component: *component,
            };
            owned.value(system, criteria, state, balanced)
        }
        reading => reading.value(system, criteria, state, balanced),
    });
    let mut values: Vec<f64> = parts.collect();
    subdomain.all_reduce_sum(&mut values);
    values
}

impl Reading {
    /// Degrees of freedom whose motions, times their weights, add up to the reading; None where it is no motion.
    pub fn weights(&self, layout: Layout) -> Option<Vec<(u32, f64)>> {
        let (shares, component) = match self {
            Self::RelativeDisplacement { places, component } => {
                let [first, second] = places;
                let minus = first.iter().map(|(point, share)| (*point, -share));
                let all: Shares = minus.chain(second.iter().copied()).collect();
                (all, *component)
            }
            Self::Field {
                place,
                field: PointField::Motion(component),
            } => (place.clone(), *component),
            Self::Field { .. } | Self::SectionForce { .. } => return None,
        };
        let weight = |(point, weight): (u32, f64)| {
            let dof = layout.degree_of_freedom(point, component)?;
            Some((dof as u32, weight))
        };
        Some(shares.into_iter().filter_map(weight).collect())
    }

    /// The value in a state of equilibrium; where processes share the body out, this one's part of it.
    fn value(
        &self,
        system: &dyn Bonds,
        criteria: &Criteria,
        state: &State,
        balanced: &Balanced,
    ) -> f64 {
        let motion = |point: u32, component: Component| {
            system.layout().value(point, component, &state.displacement)
        };
        match self {
            Self::RelativeDisplacement { places, component } => {
                let [first, second] =
                    (places.each_ref()).map(|it| mean(it, |point| motion(point, *component)));
                second - first
            }
            Self::Field { place, field } => mean(place, |point| match field {
                PointField::Damage => fields::point_damage(system, &state.intact, point),
                PointField::DamageBy(way) => {
                    fields::point_damage_by(system, criteria, state, *way, point)
                }
                PointField::Motion(component) => motion(point, *component),
                PointField::Stress(component) => {
                    let deformations = &balanced.deformations;
                    let mut stress = system.stress(state.bonds(), deformations, point);
                    contact::add_virial(system, &balanced.closed, point, &mut stress);
                    stress.get(*component as usize).copied().unwrap_or(0.0)
                }
                PointField::StrainEnergyDensity => fields::point_energy_density(
                    system,
                    state.bonds(),
                    &balanced.deformations,
                    &balanced.closed,
                    point,
                ),
            }),
            Self::SectionForce { bonds, component } => {
                let deformations = &balanced.deformations;
                // Beyond the bonds stand those that pre-cracks cut.
                let n_bonds = system.ends().len();
                let of_bonds = bonds.partition_point(|(bond, _)| (*bond as usize) < n_bonds);
                let crossing = &bonds[..of_bonds];
                let force = system.force_through(state.bonds(), deformations, crossing, *component);
                if balanced.closed.is_empty() {
                    return force;
                }
                force + contact::force_through(&balanced.closed, bonds, *component)
            }
        }
    }
}

/// The value at a place, from those of its points.
fn mean(place: &Shares, value: impl Fn(u32) -> f64) -> f64 {
    let parts = place.iter().map(|&(point, share)| share * value(point));
    parts.reduce(|sum, part| sum + part).unwrap_or(0.0)
}
