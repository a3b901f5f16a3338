//! Pairs across the cracks of a bond system, and the stresses of closed pairs.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use super::BondSystem;
use super::crack_axis::AxisSum;
use crate::contact::{ClosedPair, ContactPair, CutBond, Overlap};
use crate::ghosts::Ghosts;
use crate::interface::StressReading;
use crate::layout::{Component, Layout};
use crate::tensor::{SymTensor, cross, dot, minus, norm};
use crate::thermal::ThermalStrain;

/// Cosine of the angle between a broken bond and the crack normal below which the bond is no contact pair: it lies along the crack, and the
/// sides of its ends are arbitrary. The bonds beyond carry less than 1 % of the traction across.
const ALONG_THE_CRACK: f64 = 0.3;

/// Motions of the points of a body.
#[derive(Clone, Copy)]
pub(crate) struct Moved<'a> {
    /// Degrees of freedom of the points.
    pub(crate) layout: Layout,
    /// Motions, shape (n_degrees_of_freedom), m and rad.
    pub(crate) motions: &'a [f64],
    /// Thermal strains.
    pub(crate) expansion: ThermalStrain<'a>,
}

impl<const D: usize> BondSystem<D> {
    /// Pairs across cracks while the bonds marked in `intact` (n_bonds) are unbroken: broken bonds, then cut ones, in their order.
    ///
    /// The normal of a pre-crack is known. That of a grown crack is the principal direction of sum e (x) e over the broken bonds at both
    /// ends of a pair and at the points that these connect to, where a cut bond counts with its normal. It changes only where bonds break.
    pub(crate) fn contact_pairs(&self, layout: Layout, intact: &[bool]) -> Vec<ContactPair> {
        let (bonds, cut) = (&self.bonds, self.faces.cut());
        let broken: Vec<usize> = (0..intact.len()).filter(|&bond| !intact[bond]).collect();
        let around = self.crack_directions(&broken);
        let of_broken = broken.iter().filter_map(|&bond| {
            let sums = bonds.ends[bond].map(|end| around[end as usize]);
            self.pair_of_broken(layout, bond, sums)
        });
        let numbered = (bonds.len() as u32..).zip(cut);
        let of_cut = numbered.map(|(number, it)| self.contact_pair(layout, number, it));
        of_broken.chain(of_cut).collect()
    }

    /// The pair of a broken bond from the sums of directions around its ends; none for a bond along the crack.
    fn pair_of_broken(
        &self,
        layout: Layout,
        bond: usize,
        [a, b]: [AxisSum<D>; 2],
    ) -> Option<ContactPair> {
        let bonds = &self.bonds;
        let normal = a.plus(b).axis_towards(bonds.direction[bond]);
        let of_bond = |all: &[f64]| all.get(bond).copied().unwrap_or_default();
        let parted = CutBond {
            ends: bonds.ends[bond],
            normal,
            axial: of_bond(&self.rigidities.axial),
            shear: of_bond(&self.rigidities.shear),
        };
        let pair = self.contact_pair(layout, bond as u32, &parted);
        (dot(normal, bonds.direction[bond]) >= ALONG_THE_CRACK).then_some(pair)
    }

    /// The pairs of a whole body that change with bonds that have just broken: of broken bonds at their ends and at the points that broken or
    /// cut bonds connect to these. Sums are in the order of those over all bonds.
    pub(crate) fn changed_pairs(
        &self,
        layout: Layout,
        intact: &[bool],
        broken: &[u32],
    ) -> Vec<(u32, Option<ContactPair>)> {
        let near = CrackAround {
            system: self,
            intact,
            cut: self.cut_at_points(),
        };
        let mut points = BTreeSet::new();
        for end in broken.iter().flat_map(|&it| self.bonds.ends[it as usize]) {
            points.insert(end);
            points.extend(near.separated_neighbours(end).map(|(other, _)| other));
        }
        let sums: BTreeMap<u32, AxisSum<D>> = {
            let ends = |point: u32| {
                near.broken(point)
                    .flat_map(|it| self.bonds.ends[it as usize])
            };
            let all: BTreeSet<u32> = points.iter().flat_map(|&it| ends(it)).collect();
            all.into_iter().map(|it| (it, near.sum(it))).collect()
        };
        let bonds: BTreeSet<u32> = points.iter().flat_map(|&it| near.broken(it)).collect();
        let pair = |bond: u32| {
            let ends = self.bonds.ends[bond as usize];
            self.pair_of_broken(layout, bond as usize, ends.map(|end| sums[&end]))
        };
        bonds.into_iter().map(|bond| (bond, pair(bond))).collect()
    }

    /// The cut bonds of each point that has some, in their order.
    fn cut_at_points(&self) -> BTreeMap<u32, Vec<usize>> {
        let mut at_points: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (number, cut) in self.faces.cut().iter().enumerate() {
            for end in cut.ends {
                at_points.entry(end).or_default().push(number);
            }
        }
        at_points
    }

    /// Sums of the directions of the broken and cut bonds at each point and at the points that they connect to, shape (n_points).
    fn crack_directions(&self, broken: &[usize]) -> Vec<AxisSum<D>> {
        let (bonds, n_points) = (&self.bonds, self.cloud.len());
        let of_broken = broken.iter();
        let of_broken = of_broken.map(|&bond| (bonds.ends[bond], bonds.direction[bond]));
        let of_cut = self.faces.cut().iter().map(|it| (it.ends, it.normal));
        let parted = || of_broken.clone().chain(of_cut.clone());
        let mut own = vec![AxisSum::default(); n_points];
        for (ends, direction) in parted() {
            for end in ends {
                own[end as usize].add(direction);
            }
        }
        let seen = parted().flat_map(|(ends, _)| ends);
        let subdomain = &self.cloud.subdomain;
        let ghosts = Ghosts::new(subdomain, seen);
        let complete = |sums: &mut Vec<AxisSum<D>>| {
            if subdomain.is_whole() {
                return;
            }
            let mut values: Vec<f64> = sums.iter().flat_map(|it| it.values()).collect();
            ghosts.update(&mut values, AxisSum::<D>::N_VALUES);
            *sums = (values.chunks(AxisSum::<D>::N_VALUES))
                .map(AxisSum::from_values)
                .collect();
        };
        complete(&mut own);
        let mut around = own.clone();
        for ([a, b], _) in parted() {
            for (at, of) in [(a, b), (b, a)] {
                around[at as usize] = around[at as usize].plus(own[of as usize]);
            }
        }
        complete(&mut around);
        around
    }

    /// The contact pair of a broken or cut bond, with a number.
    fn contact_pair(&self, layout: Layout, number: u32, parted: &CutBond<D>) -> ContactPair {
        let &CutBond {
            ends,
            normal,
            axial,
            shear,
        } = parted;
        let [a, b] = ends.map(|end| self.cloud.positions[end as usize]);
        let way = minus(b, a);
        let length = norm(way);
        let turned = cross(in_space(way), in_space(normal));
        let (across, along) = (dot(way, normal) / length, norm(turned) / length);
        let resisted = axial * across * across + shear * along * along;
        ContactPair {
            number,
            ends,
            normal: in_space(normal),
            way: in_space(way),
            stiffness: resisted.max(0.0) / (length * length),
            spread: SymTensor::dyad(in_space(normal), in_space(way)),
            row: row_of_gap(
                layout,
                ends,
                in_space(normal),
                turned.map(|it| -0.5 * length * (it / length)),
            ),
        }
    }

    /// Pair with the largest overlap of the faces, beyond a depth (m), among the marked points `asked` (n_points).
    pub(super) fn largest_overlap(
        &self,
        intact: &[bool],
        moved: Moved<'_>,
        beyond: f64,
        asked: &[bool],
    ) -> Option<Overlap> {
        let Moved {
            layout,
            motions,
            expansion,
        } = moved;
        let subdomain = &self.cloud.subdomain;
        let is_asked = |ends: [u32; 2]| ends.iter().all(|&end| asked[end as usize]);
        let approaches = |bond: usize| {
            let [a, b] = self.bonds.ends[bond].map(|end| layout.range(end).start);
            let along: [f64; D] = std::array::from_fn(|axis| motions[b + axis] - motions[a + axis]);
            dot(along, self.bonds.direction[bond]) < 0.0 && dot(along, along) > beyond * beyond
        };
        let has_cut = !self.faces.cut().is_empty();
        let broken = || (0..intact.len()).filter(|&bond| !intact[bond]);
        // Normals of grown cracks are not worth computing where no faces approach each other.
        if !subdomain.any(has_cut || broken().any(approaches)) {
            return None;
        }
        let pairs = self.contact_pairs(layout, intact);
        let mut motions = Cow::Borrowed(motions);
        if !subdomain.is_whole() {
            // Cut bonds connect to points that intact ones need not reach.
            let ghosts = Ghosts::new(subdomain, pairs.iter().flat_map(|it| it.ends));
            ghosts.update(motions.to_mut(), layout.components.len());
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
        let owned = beyond.filter(|it| subdomain.owns_bond(it.ends));
        let local = owned.reduce(larger).map(|it| Overlap {
            ends: subdomain.numbers(it.ends),
            ..it
        });
        let local = local.into_iter().collect();
        subdomain.all_gather_list(local).into_iter().reduce(larger)
    }

    /// Adds the stresses of closed pairs to the stresses of the bonds by a reading, shape (n_points, n_components), Pa.
    pub(crate) fn add_stresses_of_contact(
        &self,
        reading: StressReading,
        closed: &[ClosedPair],
        stresses: &mut [f64],
    ) {
        match reading {
            StressReading::Virial => {
                let n_components = SymTensor::<D>::NAMES.len();
                for it in closed {
                    for end in it.pair.ends {
                        let share = it.virial_share(self.cloud.volumes[end as usize]);
                        let share = share.resized::<D>();
                        let of_point = &mut stresses[n_components * end as usize..];
                        for (stress, part) in of_point.iter_mut().zip(share.components()) {
                            *stress += part;
                        }
                    }
                }
            }
            StressReading::Traction => self.add_contact_tractions(closed, stresses),
        }
    }
}

/// Broken and cut bonds around points.
struct CrackAround<'a, const D: usize> {
    system: &'a BondSystem<D>,
    intact: &'a [bool],
    cut: BTreeMap<u32, Vec<usize>>,
}

impl<const D: usize> CrackAround<'_, D> {
    /// Broken bonds of a point.
    fn broken(&self, point: u32) -> impl Iterator<Item = u32> {
        let own = self.system.bonds.incidence.at(point).iter().copied();
        own.filter(|&it| !self.intact[it as usize])
    }

    /// Other ends and directions of the broken bonds of a point, then of its cut ones.
    fn separated_neighbours(&self, point: u32) -> impl Iterator<Item = (u32, [f64; D])> {
        let bonds = &self.system.bonds;
        let of_broken = self.broken(point);
        let of_broken =
            of_broken.map(move |it| (bonds.neighbour(it, point), bonds.direction[it as usize]));
        let cut = self.cut.get(&point).into_iter().flatten();
        let of_cut = cut.map(move |&it| {
            let CutBond { ends, normal, .. } = self.system.faces.cut()[it];
            let other = if ends[0] == point { ends[1] } else { ends[0] };
            (other, normal)
        });
        of_broken.chain(of_cut)
    }

    /// Sum of the directions at a point.
    fn sum_at_point(&self, point: u32) -> AxisSum<D> {
        let mut sum = AxisSum::default();
        for (_, direction) in self.separated_neighbours(point) {
            sum.add(direction);
        }
        sum
    }

    /// Sum of the directions at a point and at the points that its broken and cut bonds connect to.
    fn sum(&self, point: u32) -> AxisSum<D> {
        let own = self.sum_at_point(point);
        self.separated_neighbours(point)
            .fold(own, |sum, (other, _)| sum.plus(self.sum_at_point(other)))
    }
}

/// A vector of the plane or of space as a vector of space.
fn in_space<const D: usize>(vector: [f64; D]) -> [f64; 3] {
    [0, 1, 2].map(|axis| if axis < D { vector[axis] } else { 0.0 })
}

/// Degrees of freedom of two points with their coefficients in the gap: the normal, and `of_rotations` where points have rotations.
fn row_of_gap(
    layout: Layout,
    ends: [u32; 2],
    normal: [f64; 3],
    of_rotations: [f64; 3],
) -> [(u32, f64); 12] {
    let mut row = [(0, 0.0); 12];
    let entries = ends.into_iter().zip([-1.0, 1.0]).flat_map(|(end, sign)| {
        let components = layout.components.iter().zip(layout.range(end));
        components.map(move |(component, dof)| {
            let factor = match component {
                Component::X | Component::Y | Component::Z => sign * normal[component.in_space()],
                _ => of_rotations[component.in_space() - 3],
            };
            (dof as u32, factor)
        })
    });
    for (place, entry) in row.iter_mut().zip(entries) {
        *place = entry;
    }
    row
}
