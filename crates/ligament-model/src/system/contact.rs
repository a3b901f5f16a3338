//! The pairs across the cracks of a bond system, and the stresses of those that are closed.

use std::borrow::Cow;

use super::BondSystem;
use crate::contact::{ClosedPair, ContactPair, Overlap};
use crate::ghosts::Ghosts;
use crate::interface::{Bonds, StressReading};
use crate::layout::Component;
use crate::portion::{any, counts};
use crate::thermal::ThermalStrain;

/// Cosine of the angle between a broken bond and the normal of the crack below which the bond is no pair: it lies along the
/// crack, and on which side of it an end lies is chance. The bonds beyond hold less than 1 % of the traction across.
const ALONG_THE_CRACK: f64 = 0.3;

impl BondSystem {
    /// The pairs across cracks while the bonds marked in `intact` (n_bonds) are unbroken: broken bonds and then cut ones, in their
    /// order.
    ///
    /// The normal of a pre-crack is known. That of a crack that grew is the principal direction of sum e (x) e over the broken
    /// bonds at both ends of a pair and at the points that these lead to, where a cut bond counts with its normal. It changes
    /// only where bonds break.
    pub fn contact_pairs(&self, intact: &[bool]) -> Vec<ContactPair> {
        let (bonds, cut) = (&self.bonds, self.faces.cut());
        let broken: Vec<usize> = (0..intact.len()).filter(|&bond| !intact[bond]).collect();
        let around = self.crack_directions(&broken);
        let of_broken = broken.iter().filter_map(|&bond| {
            let ends = bonds.ends[bond];
            let [a, b] = ends.map(|end| around[end as usize]);
            let normal = principal([a[0] + b[0], a[1] + b[1]], bonds.direction[bond]);
            let of_bond = |all: &[f64]| all.get(bond).copied().unwrap_or_default();
            let rigidities = [&self.rigidities.axial, &self.rigidities.shear];
            let rigidities = rigidities.map(|all| of_bond(all));
            let pair = self.contact_pair(bond as u32, ends, normal, rigidities);
            (dot(normal, bonds.direction[bond]) >= ALONG_THE_CRACK).then_some(pair)
        });
        let numbered = (bonds.len() as u32..).zip(cut);
        let of_cut = numbered.map(|(number, it)| {
            self.contact_pair(number, it.ends, it.normal, [it.axial, it.shear])
        });
        of_broken.chain(of_cut).collect()
    }

    /// Sums over the parted pairs of each point and of the points that they lead to, shape (n_points), of the doubled angle of
    /// their directions: (e_x^2 - e_y^2, 2 e_x e_y).
    fn crack_directions(&self, broken: &[usize]) -> Vec<[f64; 2]> {
        let (bonds, n_points) = (&self.bonds, self.cloud.len());
        let of_broken = broken.iter();
        let of_broken = of_broken.map(|&bond| (bonds.ends[bond], bonds.direction[bond]));
        let of_cut = self.faces.cut().iter().map(|it| (it.ends, it.normal));
        let parted = || of_broken.clone().chain(of_cut.clone());
        let mut own = vec![[0.0; 2]; n_points];
        for (ends, [x, y]) in parted() {
            for end in ends {
                let sum = &mut own[end as usize];
                *sum = [sum[0] + x * x - y * y, sum[1] + 2.0 * x * y];
            }
        }
        let seen = parted().flat_map(|(ends, _)| ends);
        let ghosts = self.portion().map(|it| Ghosts::new(it, seen));
        let complete = |sums: &mut Vec<[f64; 2]>| {
            if let Some(ghosts) = &ghosts {
                ghosts.tell(sums.as_flattened_mut(), 2);
            }
        };
        complete(&mut own);
        let mut around = own.clone();
        for ([a, b], _) in parted() {
            for (at, of) in [(a, b), (b, a)] {
                let of = own[of as usize];
                let sum = &mut around[at as usize];
                *sum = [sum[0] + of[0], sum[1] + of[1]];
            }
        }
        complete(&mut around);
        around
    }

    /// The pair of two points with a normal and the axial and shear rigidities of their bond.
    fn contact_pair(
        &self,
        number: u32,
        ends: [u32; 2],
        normal: [f64; 2],
        [axial, shear]: [f64; 2],
    ) -> ContactPair {
        let [a, b] = ends.map(|end| self.cloud.positions[end as usize]);
        let way = [b[0] - a[0], b[1] - a[1]];
        let length = dot(way, way).sqrt();
        let (across, along) = (
            dot(way, normal) / length,
            (way[0] * normal[1] - way[1] * normal[0]) / length,
        );
        let resisted = axial * across * across + shear * along * along;
        ContactPair {
            number,
            ends,
            normal,
            stiffness: resisted.max(0.0) / (length * length),
            spread: [
                normal[0] * way[0],
                normal[1] * way[1],
                0.5 * (normal[0] * way[1] + normal[1] * way[0]),
            ],
            row: self.row_of_gap(ends, normal, -0.5 * length * along),
        }
    }

    /// Degrees of freedom of two points with their factors: the normal, and `of_rotations` where points turn.
    fn row_of_gap(&self, ends: [u32; 2], normal: [f64; 2], of_rotations: f64) -> [(u32, f64); 6] {
        let layout = self.layout();
        let mut row = [(0, 0.0); 6];
        let entries = ends.into_iter().zip([-1.0, 1.0]).flat_map(|(end, sign)| {
            let factors = [sign * normal[0], sign * normal[1], of_rotations];
            let components = Component::ALL.into_iter().zip(factors);
            components.filter_map(move |(component, factor)| {
                Some((layout.degree_of_freedom(end, component)? as u32, factor))
            })
        });
        for (place, entry) in row.iter_mut().zip(entries) {
            *place = entry;
        }
        row
    }

    /// The pair whose faces have passed through each other farthest, beyond a depth (m), of the points that are asked for (n_points).
    pub(super) fn largest_overlap(
        &self,
        intact: &[bool],
        motions: &[f64],
        expansion: ThermalStrain<'_>,
        beyond: f64,
        asked: &[bool],
    ) -> Option<Overlap> {
        let is_asked = |ends: [u32; 2]| ends.iter().all(|&end| asked[end as usize]);
        let layout = self.layout();
        let approaches = |bond: usize| {
            let [a, b] = self.bonds.ends[bond];
            let along = [Component::X, Component::Y].map(|component| {
                layout.value(b, component, motions) - layout.value(a, component, motions)
            });
            dot(along, self.bonds.direction[bond]) < 0.0 && dot(along, along) > beyond * beyond
        };
        let has_cut = !self.faces.cut().is_empty();
        let broken = || (0..intact.len()).filter(|&bond| !intact[bond]);
        // Normals of cracks that grew are not worth while where nothing comes nearer.
        if !any(self.portion(), has_cut || broken().any(approaches)) {
            return None;
        }
        let pairs = self.contact_pairs(intact);
        let mut motions = Cow::Borrowed(motions);
        if let Some(portion) = self.portion() {
            // Cut bonds lead to points that intact ones need not lead to.
            let ghosts = Ghosts::new(portion, pairs.iter().flat_map(|it| it.ends));
            ghosts.tell(motions.to_mut(), layout.components.len());
        }
        let (pairs, motions) = (pairs.into_iter(), &*motions);
        let overlaps = pairs
            .filter(|pair| is_asked(pair.ends))
            .map(|pair| Overlap {
                depth: -pair.gap(motions, expansion),
                ends: pair.ends,
            });
        let beyond = overlaps.filter(|it| it.depth > beyond);
        let larger = |most: Overlap, it: Overlap| if it.depth > most.depth { it } else { most };
        let Some(portion) = self.portion() else {
            return beyond.reduce(larger);
        };
        let counted = beyond.filter(|it| counts(Some(portion), it.ends));
        let here = counted.reduce(larger).map(|it| {
            let [a, b] = it.ends.map(f64::from);
            [it.depth, a, b]
        });
        let of_ranks = portion.concatenated(here.as_slice()).into_iter();
        let of_ranks = of_ranks.map(|[depth, a, b]| Overlap {
            depth,
            ends: [a as u32, b as u32],
        });
        of_ranks.reduce(larger)
    }

    /// Adds the stresses of the forces of closed pairs to those of the bonds in a reading, shape (n_points, n_components), Pa.
    pub(crate) fn add_stresses_of_contact(
        &self,
        reading: StressReading,
        closed: &[ClosedPair],
        stresses: &mut [f64],
    ) {
        match reading {
            StressReading::Virial => {
                for it in closed {
                    for end in it.pair.ends {
                        let share = it.virial_share(self.cloud.volumes[end as usize]);
                        let of_point = &mut stresses[share.len() * end as usize..];
                        for (stress, part) in of_point.iter_mut().zip(share) {
                            *stress += part;
                        }
                    }
                }
            }
            StressReading::Traction => self.add_contact_tractions(closed, stresses),
        }
    }
}

/// The axis of a sum of doubled angles, on the side of a direction; the direction itself where no axis leads.
fn principal([cosine, sine]: [f64; 2], direction: [f64; 2]) -> [f64; 2] {
    let size = cosine.hypot(sine);
    if size == 0.0 {
        return direction;
    }
    let (x, y) = (
        (0.5 * (1.0 + cosine / size)).max(0.0).sqrt(),
        (0.5 * (1.0 - cosine / size)).max(0.0).sqrt(),
    );
    let axis = [x, y.copysign(sine)];
    if dot(axis, direction) < 0.0 {
        [-axis[0], -axis[1]]
    } else {
        axis
    }
}

fn dot(one: [f64; 2], other: [f64; 2]) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}
