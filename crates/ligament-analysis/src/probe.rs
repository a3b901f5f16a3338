//! Probes: quantities evaluated at every load step.

use ligament_model::stress::carried::StrainReading;
use ligament_model::stress::domain_integral::DomainIntegral;
use ligament_model::stress::growing_tip::GrowingTip;
use ligament_model::stress::point_strain::Motion;
use ligament_model::stress::tip_field::TipQuantity;

use crate::contact::faces;
use crate::history::Rates;
use crate::material_stress::MaterialStress;
use crate::result_fields::{FIELDS, FieldReading, Solution, unit_of};
use crate::unknowns::{Component, Layout};

/// Determinant of the scaled normal equations of a fit below which distances are alike.
const ALIKE: f64 = 1e-3;

/// Probe, a column of the history.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Name of the column.
    pub name: String,
    /// Quantity that the probe reads.
    pub reading: Reading,
}

/// Location in the body: points and their weights, which add up to one.
pub type Shares = Vec<(u32, f64)>;

/// Quantity that a probe reads.
#[derive(Debug, Clone, PartialEq)]
pub enum Reading {
    /// Motion at the second location minus the motion at the first (crack mouth opening, strain gauge), m or rad.
    RelativeDisplacement {
        /// First and second location.
        places: [Shares; 2],
        /// Component of the motion.
        component: Component,
    },
    /// A field at a location.
    Field {
        /// Location at which the field is read.
        place: Shares,
        /// Field that is read.
        field: PointField,
    },
    /// Force through a line: force of the part on its right on the part on its left, seen along the line, N; in space through a
    /// plane, force of the part before it on the part behind it. Only bonds of two points count.
    SectionForce {
        /// Bonds that cross the line, ascending, and whether their first end lies on the left or behind; bonds cut by pre-cracks
        /// are numbered after the others.
        bonds: Vec<(u32, bool)>,
        /// Component of the force: x or y.
        component: Component,
    },
    /// Force of supports and loads on points, N, or the sum of their moments on them, N m.
    Force {
        /// Points.
        points: Vec<u32>,
        /// Component of the force.
        component: Component,
    },
    /// Quantity at the tip or the front of a pre-crack.
    Tip(DomainIntegral),
    /// Quantity at the present tip of a crack that grows from a pre-crack.
    GrowingTip(GrowingTip),
}

/// Gap of a body, whose faces its loads open or close: a notch or a slot of its mesh, or a pre-crack.
#[derive(Debug, Clone, PartialEq)]
pub struct Notch {
    /// Points A < B of each pair without a bond across the gap, shape (n_pairs).
    pub ends: Vec<[u32; 2]>,
    /// Normal of the gap, on the side of B of each pair, shape (n_pairs, n_axes).
    pub normals: Vec<f64>,
    /// Distance of the points of each pair along the normal, shape (n_pairs), m.
    pub distances: Vec<f64>,
    /// Square of the cosine of each pair against the normal, shape (n_pairs).
    pub weights: Vec<f64>,
}

/// Motion of the faces of a gap against each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NotchOpening {
    /// Mean opening w of the gap, m.
    pub opening: f64,
    /// Lengthening s d of the material beside the gap over the mean distance d of the pairs, m.
    pub strained: f64,
    /// Root mean square of |u_B - u_A|, m.
    pub motion: f64,
}

impl Notch {
    /// Motion of the faces in a motion of the points (n_degrees_of_freedom): the openings n . (u_B - u_A) of pairs with the distances d are fitted
    /// by w + s d, with the weights of the pairs; s is zero where all distances are alike.
    pub(crate) fn opening(&self, layout: Layout, displacement: &[f64]) -> NotchOpening {
        let (mut sums, mut openings, mut squares) = ([0.0; 3], [0.0; 2], 0.0);
        let normals = self.normals.chunks(self.normals.len() / self.ends.len());
        let pairs = self.ends.iter().zip(normals);
        for (([a, b], normal), (d, weight)) in pairs.zip(self.distances.iter().zip(&self.weights)) {
            let [a, b] = [a, b].map(|&point| &displacement[layout.range(point)]);
            let mut opening = 0.0;
            for ((a, b), n) in a.iter().zip(b).zip(normal) {
                opening += n * (b - a);
                squares += (b - a) * (b - a);
            }
            for (power, sum) in sums.iter_mut().enumerate() {
                *sum += weight * d.powi(power as i32);
            }
            openings[0] += weight * opening;
            openings[1] += weight * d * opening;
        }
        let [zeroth, first, second] = sums;
        let determinant = zeroth * second - first * first;
        let strain = match determinant > ALIKE * zeroth * second {
            true => (zeroth * openings[1] - first * openings[0]) / determinant,
            false => 0.0,
        };
        let strained = strain * first / zeroth;
        NotchOpening {
            opening: openings[0] / zeroth - strained,
            strained,
            motion: (squares / self.ends.len() as f64).sqrt(),
        }
    }
}

/// A field that a probe can read at a point.
#[derive(Debug, Clone, Copy)]
pub struct PointField {
    /// Name of the field, unique.
    pub word: &'static str,
    /// Meaning of the name, with the unit.
    pub meaning: &'static str,
    /// Method of evaluation.
    pub reading: PointReading,
}

/// Method of evaluation of a field at a point.
#[derive(Debug, Clone, Copy)]
pub enum PointReading {
    /// A displacement or the rotation, m or rad; zero where points have no such component.
    Motion(Component),
    /// A component of the velocity in a motion, m/s; zero where points have no such component.
    Velocity(Component),
    /// A component of the acceleration in a motion, m/s^2; zero where points have no such component.
    Acceleration(Component),
    /// A component of the virial stress, Pa.
    Stress(StressComponent),
    /// A component of the strain of the bonds that are left, with what the temperature gives, a shear as an angle.
    Strain(StressComponent),
    /// A component of a function of the stress by the law of the material, Pa.
    MaterialStress {
        /// The stress.
        of: MaterialStress,
        /// The function of the components of the stress.
        read: fn(&[f64]) -> Vec<f64>,
        /// The component of its value.
        component: usize,
        /// Whether bodies in the plane have the component.
        in_plane: bool,
    },
    /// A scalar of the [table of fields](FIELDS).
    Scalar(fn(Solution<'_>, u32) -> f64),
}

/// Components of the vectors and tensors that a probe can read.
const OF_VECTORS_AND_TENSORS: [PointField; 25] = [
    motion("displacement.x", "Displacement along x, m.", Component::X),
    motion("displacement.y", "Displacement along y, m.", Component::Y),
    motion(
        "rotation",
        "Rotation in the plane, rad, counter-clockwise.",
        Component::Rotation,
    ),
    motion(
        "displacement.z",
        "Displacement along z of a solid, m.",
        Component::Z,
    ),
    motion(
        "rotation.x",
        "Rotation about x in a solid, rad, right-handed.",
        Component::RotationX,
    ),
    motion(
        "rotation.y",
        "Rotation about y in a solid, rad, right-handed.",
        Component::RotationY,
    ),
    motion(
        "rotation.z",
        "Rotation about z in a solid, rad, right-handed.",
        Component::RotationZ,
    ),
    point_field(
        "velocity.x",
        "Velocity along x in a motion, m/s.",
        PointReading::Velocity(Component::X),
    ),
    point_field(
        "velocity.y",
        "Velocity along y in a motion, m/s.",
        PointReading::Velocity(Component::Y),
    ),
    point_field(
        "velocity.z",
        "Velocity along z of a solid in a motion, m/s.",
        PointReading::Velocity(Component::Z),
    ),
    point_field(
        "acceleration.x",
        "Acceleration along x in a motion, m/s^2.",
        PointReading::Acceleration(Component::X),
    ),
    point_field(
        "acceleration.y",
        "Acceleration along y in a motion, m/s^2.",
        PointReading::Acceleration(Component::Y),
    ),
    point_field(
        "acceleration.z",
        "Acceleration along z of a solid in a motion, m/s^2.",
        PointReading::Acceleration(Component::Z),
    ),
    stress(
        "stress_virial.xx",
        "Virial stress xx, Pa.",
        StressComponent::Xx,
    ),
    stress(
        "stress_virial.yy",
        "Virial stress yy, Pa.",
        StressComponent::Yy,
    ),
    stress(
        "stress_virial.xy",
        "Virial stress xy, Pa.",
        StressComponent::Xy,
    ),
    stress(
        "stress_virial.zz",
        "Virial stress zz of a solid, Pa.",
        StressComponent::Zz,
    ),
    stress(
        "stress_virial.xz",
        "Virial stress xz of a solid, Pa.",
        StressComponent::Xz,
    ),
    stress(
        "stress_virial.yz",
        "Virial stress yz of a solid, Pa.",
        StressComponent::Yz,
    ),
    strain(
        "strain.xx",
        "Strain xx of the bonds that are left, with that by temperature.",
        StressComponent::Xx,
    ),
    strain("strain.yy", "Strain yy.", StressComponent::Yy),
    strain(
        "strain.xy",
        "Shear strain xy, as the angle by which a right one changes.",
        StressComponent::Xy,
    ),
    strain("strain.zz", "Strain zz of a solid.", StressComponent::Zz),
    strain(
        "strain.xz",
        "Shear strain xz of a solid.",
        StressComponent::Xz,
    ),
    strain(
        "strain.yz",
        "Shear strain yz of a solid.",
        StressComponent::Yz,
    ),
];

/// SI unit of a displacement, or of a rotation.
pub fn motion_unit(is_rotation: bool) -> &'static str {
    if is_rotation { "rad" } else { "m" }
}

const fn motion(word: &'static str, meaning: &'static str, component: Component) -> PointField {
    point_field(word, meaning, PointReading::Motion(component))
}

const fn stress(word: &'static str, meaning: &'static str, it: StressComponent) -> PointField {
    point_field(word, meaning, PointReading::Stress(it))
}

const fn strain(word: &'static str, meaning: &'static str, it: StressComponent) -> PointField {
    point_field(word, meaning, PointReading::Strain(it))
}

const fn point_field(
    word: &'static str,
    meaning: &'static str,
    reading: PointReading,
) -> PointField {
    PointField {
        word,
        meaning,
        reading,
    }
}

impl PartialEq for PointField {
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word
    }
}

#[cfg(feature = "case")]
ligament_model::worded_by_table! {
    PointField: PointField::ALL, PointField::ALL.into_iter(), it => [it.word, it.meaning]
}

impl PointField {
    /// SI unit of the field.
    pub fn unit(&self) -> &'static str {
        match self.reading {
            PointReading::Motion(component) => motion_unit(component.is_rotation()),
            PointReading::Velocity(_) => "m/s",
            PointReading::Acceleration(_) => "m/s^2",
            PointReading::Stress(_) | PointReading::MaterialStress { .. } => "Pa",
            PointReading::Strain(_) => "-",
            PointReading::Scalar(_) => unit_of(self.word),
        }
    }

    /// All fields: the fields of the [table](FIELDS) that are read at a point, then the components of other vectors and
    /// tensors.
    pub const ALL: [Self; N_OF_TABLE + OF_VECTORS_AND_TENSORS.len()] = {
        let mut all = [OF_VECTORS_AND_TENSORS[0]; N_OF_TABLE + OF_VECTORS_AND_TENSORS.len()];
        let (mut row, mut place) = (0, 0);
        while row < FIELDS.len() {
            match FIELDS[row].reading {
                FieldReading::Probed(_, at) => {
                    all[place] = Self {
                        word: FIELDS[row].name,
                        meaning: FIELDS[row].meaning,
                        reading: PointReading::Scalar(at),
                    };
                    place += 1;
                }
                FieldReading::MaterialStress(of, read, parts) => {
                    let mut part = 0;
                    while part < parts.len() {
                        all[place] = Self {
                            word: parts[part][0],
                            meaning: parts[part][1],
                            reading: PointReading::MaterialStress {
                                of,
                                read,
                                component: part,
                                in_plane: is_in_plane(parts[part][0]),
                            },
                        };
                        (part, place) = (part + 1, place + 1);
                    }
                }
                _ => {}
            }
            row += 1;
        }
        while place < all.len() {
            all[place] = OF_VECTORS_AND_TENSORS[place - N_OF_TABLE];
            place += 1;
        }
        all
    };

    /// Field with this name.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|it| it.word == word)
    }

    /// Whether the field is a velocity or an acceleration, which only a motion in time has.
    pub fn is_rate(&self) -> bool {
        matches!(
            self.reading,
            PointReading::Velocity(_) | PointReading::Acceleration(_)
        )
    }

    /// Whether the field is a motion.
    pub fn is_motion(&self) -> bool {
        matches!(self.reading, PointReading::Motion(_))
    }
}

/// Whether bodies in the plane have the component at the end of a name.
const fn is_in_plane(name: &str) -> bool {
    !matches!(name.as_bytes(), [.., b'x' | b'y', b'z'] | [.., b'.', b'3'])
}

/// Number of scalars and components of the table of fields that a probe can read.
const N_OF_TABLE: usize = {
    let (mut row, mut count) = (0, 0);
    while row < FIELDS.len() {
        count += match FIELDS[row].reading {
            FieldReading::Probed(..) => 1,
            FieldReading::MaterialStress(_, _, parts) => parts.len(),
            _ => 0,
        };
        row += 1;
    }
    count
};

/// Component of a symmetric stress or strain, in the order of the bond stresses: three in the plane, then three more in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressComponent {
    /// Component xx.
    Xx,
    /// Component yy.
    Yy,
    /// Component xy.
    Xy,
    /// Component zz.
    Zz,
    /// Component xz.
    Xz,
    /// Component yz.
    Yz,
}

/// Values of probes in an equilibrium state.
pub(crate) fn values(probes: &[Probe], solution: Solution<'_>) -> Vec<f64> {
    let system = solution.system;
    let readings = probes.iter().map(|it| &it.reading);
    let subdomain = &system.subdomain;
    let first_is_owned =
        |place: &Shares| (place.first()).is_some_and(|(point, _)| subdomain.owns(*point));
    let parts = readings.map(|reading| match reading {
        // The motions of observed points are known to all processes: one process reads the whole.
        Reading::RelativeDisplacement { places, .. } if !first_is_owned(&places[0]) => 0.0,
        Reading::Field { place, field } if field.is_motion() && !first_is_owned(place) => 0.0,
        Reading::Field { place, field } if !field.is_motion() => {
            let own = place.iter().filter(|(point, _)| subdomain.owns(*point));
            let own = Reading::Field {
                place: own.copied().collect(),
                field: *field,
            };
            own.value(solution)
        }
        Reading::SectionForce { bonds, component } => {
            let ends = &system.ends;
            // Pairs cut by pre-cracks are numbered after the bonds; only a single process has forces of pairs.
            let owned = bonds.iter().filter(|(bond, _)| {
                let ends = ends.get(*bond as usize);
                ends.is_none_or(|ends| subdomain.owns_bond(*ends))
            });
            let owned = Reading::SectionForce {
                bonds: owned.copied().collect(),
                component: *component,
            };
            owned.value(solution)
        }
        reading => reading.value(solution),
    });
    let mut values: Vec<f64> = parts.collect();
    subdomain.all_reduce_sum(&mut values);
    values
}

impl Reading {
    /// The reading as a linear form in the displacements: degrees of freedom with weights; None for other quantities than motions.
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
                field:
                    PointField {
                        reading: PointReading::Motion(component),
                        ..
                    },
            } => (place.clone(), *component),
            Self::Field { .. }
            | Self::SectionForce { .. }
            | Self::Force { .. }
            | Self::Tip(_)
            | Self::GrowingTip(_) => {
                return None;
            }
        };
        let weight = |(point, weight): (u32, f64)| {
            let dof = layout.degree_of_freedom(point, component)?;
            Some((dof as u32, weight))
        };
        Some(shares.into_iter().filter_map(weight).collect())
    }

    /// Value in an equilibrium state; on a divided body the share of this process.
    fn value(&self, solution: Solution<'_>) -> f64 {
        let (system, state, balanced) = (solution.system, solution.state, solution.balanced);
        match self {
            Self::RelativeDisplacement { places, component } => {
                let displacement = &state.displacement;
                let motion = |point: u32| system.layout.value(point, *component, displacement);
                let [first, second] = places.each_ref().map(|it| mean(it, motion));
                second - first
            }
            Self::Field { place, field } => mean(place, |point| field.at(solution, point)),
            Self::Force { points, component } => {
                let forces = forces_on_points(solution);
                let owned = points.iter().filter(|it| system.subdomain.owns(**it));
                owned
                    .map(|point| system.layout.value(*point, *component, &forces))
                    .sum()
            }
            Self::Tip(integral) => value_of(integral, solution),
            Self::GrowingTip(tip) => {
                let (advance, integral) = system.at_growing_tip(tip, &state.intact);
                match tip.quantity {
                    TipQuantity::Advance if system.subdomain.communicator().rank() == 0 => advance,
                    TipQuantity::Advance => 0.0,
                    _ => integral.map_or(f64::NAN, |it| value_of(&it, solution)),
                }
            }
            Self::SectionForce { bonds, component } => {
                let deformations = &balanced.deformations;
                // Bonds cut by pre-cracks are numbered after the others.
                let n_bonds = system.ends.len();
                let of_bonds = bonds.partition_point(|(bond, _)| (*bond as usize) < n_bonds);
                let crossing = &bonds[..of_bonds];
                let force = system.force_through(state.bonds(), deformations, crossing, *component);
                if balanced.closed.is_empty() {
                    return force;
                }
                force + faces::force_through(&balanced.closed, bonds, *component)
            }
        }
    }
}

impl PointField {
    /// Value at a point in an equilibrium state.
    fn at(&self, solution: Solution<'_>, point: u32) -> f64 {
        let (system, state, balanced) = (solution.system, solution.state, solution.balanced);
        let rate = |component: Component, of: fn(Rates<'_>) -> &[f64]| {
            let rates = solution.motion;
            rates.map_or(f64::NAN, |it| system.layout.value(point, component, of(it)))
        };
        match self.reading {
            PointReading::Motion(component) => {
                system.layout.value(point, component, &state.displacement)
            }
            PointReading::Velocity(component) => rate(component, |it| it.velocity),
            PointReading::Acceleration(component) => rate(component, |it| it.acceleration),
            PointReading::MaterialStress {
                of,
                read,
                component,
                ..
            } => {
                let of_point = |it: StrainReading<'_>| system.stress_by_material(it, point);
                let stress = of.with_strains(state, balanced, solution.loads, of_point);
                match stress[0].is_nan() {
                    true => f64::NAN,
                    false => read(&stress)[component],
                }
            }
            PointReading::Stress(component) => {
                let deformations = &balanced.deformations;
                let mut stress = system.stress(state.bonds(), deformations, point);
                faces::add_virial(system, &balanced.closed, point, &mut stress);
                stress.get(component as usize).copied().unwrap_or(0.0)
            }
            PointReading::Strain(component) => {
                let motion = Motion {
                    intact: &state.intact,
                    displacement: &state.displacement,
                    expansion: solution.loads.thermal_strain(state.load_factor),
                };
                let strain = system.whole_strain(motion, point);
                strain.get(component as usize).copied().unwrap_or(0.0)
            }
            PointReading::Scalar(at) => at(solution, point),
        }
    }
}

/// Value of an integral around the front of a crack; on a divided body the share of this process.
fn value_of(integral: &DomainIntegral, solution: Solution<'_>) -> f64 {
    let (system, state, balanced) = (solution.system, solution.state, solution.balanced);
    let forces = forces_on_points(solution);
    let of_front = |it: StrainReading<'_>| system.domain_integral(integral, it, &forces);
    MaterialStress::Carried.with_strains(state, balanced, solution.loads, of_front)
}

/// Forces of supports and loads on all points (n_degrees_of_freedom), N and N m.
fn forces_on_points(solution: Solution<'_>) -> Vec<f64> {
    let (state, loads) = (solution.state, solution.loads);
    let all: Vec<u32> = (0..state.displacement.len() as u32).collect();
    let mut forces = loads.forces(state.load_factor, &all);
    let internal = solution.balanced.internal.values.iter();
    for (dof, (force, internal)) in forces.iter_mut().zip(internal).enumerate() {
        if loads.reacts_at(dof) {
            *force = *internal;
        }
    }
    forces
}

/// Weighted mean of values at the points of a location.
fn mean(place: &Shares, value: impl Fn(u32) -> f64) -> f64 {
    let parts = place.iter().map(|&(point, share)| share * value(point));
    parts.reduce(|sum, part| sum + part).unwrap_or(0.0)
}
