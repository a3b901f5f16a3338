//! Composition of bonds whose materials their ends do not determine: lengths in the materials that they cross.
//!
//! The straight line of a bond from one half of a body to the other passes through a layer between them, whatever the materials of its ends.
//! A bond is traced through the cells of the body. Pieces along a face or an edge between two materials have both at their sides, and count
//! only where no other piece exists: the ends determine the materials of a bond along an interface.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::first_bonds::first_bonds;
use super::parts::{Parts, Side};
use super::retained::retained;
use crate::cloud::PointCloud;
use crate::geometry::{bounding_box, boxes_meet};
use crate::horizon::INCLUSION_TOLERANCE;
use crate::parallel;

/// Number of points along the curve that are checked together for more than one material near them.
const BLOCK: usize = 64;

/// Shortest piece of a bond that counts, over its length: well above the pieces that the slack of the sides of cells makes at a corner, well
/// below any part of a cell.
const SHORTEST_PIECE: f64 = 1e-6;

/// Fractions of the lengths of bonds in materials, for the bonds whose ends do not determine their materials.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Composition {
    /// Numbers of the bonds, ascending.
    bonds: Vec<u32>,
    n_materials: usize,
    /// Fractions of their lengths in the materials, shape (n, n_materials); rows sum to one.
    shares: Vec<f64>,
}

impl Composition {
    /// Traces the bonds between the points of a body through its parts. Bodies of one material have an empty composition.
    pub fn new<const D: usize>(
        parts: &impl Parts<D>,
        ends: &[[u32; 2]],
        cloud: &PointCloud<D>,
    ) -> Self {
        if cloud.n_materials == 1 || parts.is_empty() {
            return Self::default();
        }
        let ways = BondTracer::new(parts, ends, cloud);
        let of_blocks = parallel::map(cloud.curve.chunks(BLOCK), |block| -> Vec<(u32, Vec<f64>)> {
            match ways.may_differ(ways.box_around(block)) {
                true => block
                    .iter()
                    .flat_map(|&point| ways.trace_bonds_from(point))
                    .collect(),
                false => Vec::new(),
            }
        });
        Self::from_found(of_blocks.into_iter().flatten().collect(), cloud.n_materials)
    }

    fn from_found(mut found: Vec<(u32, Vec<f64>)>, n_materials: usize) -> Self {
        found.sort_unstable_by_key(|(bond, _)| *bond);
        Self {
            n_materials,
            bonds: found.iter().map(|(bond, _)| *bond).collect(),
            shares: found.into_iter().flat_map(|(_, shares)| shares).collect(),
        }
    }

    /// Whether the ends of all bonds determine their materials.
    pub fn is_empty(&self) -> bool {
        self.bonds.is_empty()
    }

    /// Fractions of the length of a bond in the materials (n_materials); `None` where its ends determine its materials.
    pub fn fractions(&self, bond: usize) -> Option<&[f64]> {
        let place = self.bonds.binary_search(&(bond as u32)).ok()?;
        Some(&self.shares[place * self.n_materials..][..self.n_materials])
    }

    /// Bonds with the fractions of their lengths in the materials (n_materials), ascending.
    pub fn numbered(&self) -> impl Iterator<Item = (usize, &[f64])> {
        let rows = self.shares.chunks(self.n_materials.max(1));
        self.bonds.iter().map(|&bond| bond as usize).zip(rows)
    }

    /// Bonds that cross a material which neither end contains, ascending.
    pub fn across_layers<'a, const D: usize>(
        &'a self,
        ends: &'a [[u32; 2]],
        cloud: &'a PointCloud<D>,
    ) -> impl Iterator<Item = usize> + 'a {
        let is_foreign = move |bond: usize, shares: &[f64]| {
            let ends = ends[bond].map(|end| cloud.shares(end as usize));
            let mut materials = (0..).zip(shares);
            materials
                .any(|(k, share): (usize, _)| *share > 0.0 && ends.iter().all(|it| it[k] == 0.0))
        };
        self.numbered()
            .filter(move |(bond, shares)| is_foreign(*bond, shares))
            .map(|(bond, _)| bond)
    }

    /// The composition of the bonds for which `keep` (n_bonds) is true, renumbered.
    pub(super) fn retained(self, keep: &[bool]) -> Self {
        if self.is_empty() {
            return self;
        }
        let is_kept: Vec<bool> = self.bonds.iter().map(|&it| keep[it as usize]).collect();
        let of_shares: Vec<bool> = (is_kept.iter())
            .flat_map(|&kept| std::iter::repeat_n(kept, self.n_materials))
            .collect();
        let mut number = 0;
        let numbers: Vec<u32> = (keep.iter())
            .map(|&kept| {
                number += u32::from(kept);
                number - u32::from(kept)
            })
            .collect();
        let bonds = retained(self.bonds, &is_kept);
        Self {
            bonds: bonds.into_iter().map(|it| numbers[it as usize]).collect(),
            shares: retained(self.shares, &of_shares),
            ..self
        }
    }
}

/// A convex part of the body near a point.
struct Near<const D: usize> {
    bounds: [[f64; D]; 2],
    sides: Vec<Side<D>>,
    material: u32,
}

/// Bonds as straight lines through the parts of a body.
struct BondTracer<'a, const D: usize, P> {
    parts: &'a P,
    ends: &'a [[u32; 2]],
    cloud: &'a PointCloud<D>,
    tree: RTree<GeomWithData<Rectangle<[f64; D]>, u32>>,
    /// First bond of each point, and the number of all bonds at the end, shape (n_points + 1).
    first_bond: Vec<usize>,
}

impl<'a, const D: usize, P: Parts<D>> BondTracer<'a, D, P> {
    fn new(parts: &'a P, ends: &'a [[u32; 2]], cloud: &'a PointCloud<D>) -> Self {
        let bounds = (0..parts.len()).map(|part| {
            let [lower, upper] = parts.bounds(part);
            GeomWithData::new(Rectangle::from_corners(lower, upper), part as u32)
        });
        Self {
            tree: RTree::bulk_load(bounds.collect()),
            first_bond: first_bonds(ends, cloud.len()),
            parts,
            ends,
            cloud,
        }
    }

    /// Bonds whose first end is a point.
    fn bonds_from(&self, point: u32) -> std::ops::Range<usize> {
        self.first_bond[point as usize]..self.first_bond[point as usize + 1]
    }

    /// The box around some points and the bonds whose first ends they are.
    fn box_around(&self, points: &[u32]) -> AABB<[f64; D]> {
        let others = points.iter().flat_map(|&point| self.bonds_from(point));
        let others = others.map(|bond| self.ends[bond][1]);
        let all = points.iter().copied().chain(others);
        let [lower, upper] = bounding_box(all.map(|it| self.cloud.positions[it as usize]));
        AABB::from_corners(lower, upper)
    }

    /// Whether parts of several materials intersect a box.
    fn may_differ(&self, around: AABB<[f64; D]>) -> bool {
        let mut parts = self.tree.locate_in_envelope_intersecting(around);
        let material = |part: &GeomWithData<_, u32>| self.parts.material(part.data as usize);
        let first = parts.next().map(material);
        parts.any(|part| Some(material(part)) != first)
    }

    /// Bonds whose first end is a point and whose ends do not determine their materials, with their fractions (n_materials).
    fn trace_bonds_from(&self, point: u32) -> Vec<(u32, Vec<f64>)> {
        let around = self.box_around(&[point]);
        if !self.may_differ(around) {
            return Vec::new();
        }
        let parts = self.tree.locate_in_envelope_intersecting(around);
        let near = parts.map(|part| {
            let part = part.data as usize;
            Near {
                bounds: self.parts.bounds(part),
                sides: self.parts.sides(part),
                material: self.parts.material(part),
            }
        });
        let near: Vec<Near<D>> = near.collect();
        let of_bond = |bond: usize| {
            let shares = self.shares(bond, &near)?;
            (!self.ends_determine_material(bond, &shares)).then_some((bond as u32, shares))
        };
        self.bonds_from(point).filter_map(of_bond).collect()
    }

    /// Fractions of the length of a bond in the materials (n_materials), from all parts that it may cross; `None` where it runs along
    /// interfaces over its whole length.
    fn shares(&self, bond: usize, near: &[Near<D>]) -> Option<Vec<f64>> {
        let [a, b] = self.ends[bond].map(|end| end as usize);
        let slack = INCLUSION_TOLERANCE * self.cloud.spacing[a].min(self.cloud.spacing[b]);
        let ends = [self.cloud.positions[a], self.cloud.positions[b]];
        let passed = near.iter().filter_map(|part| {
            let [from, to] = part.interval_of_line(ends, slack)?;
            (to - from > SHORTEST_PIECE).then_some((from, to, part.material))
        });
        let passed: Vec<(f64, f64, u32)> = passed.collect();
        let mut places: Vec<f64> = passed.iter().flat_map(|it| [it.0, it.1]).collect();
        places.sort_unstable_by(f64::total_cmp);
        let mut lengths = vec![0.0; self.cloud.n_materials];
        for piece in places.windows(2) {
            let (length, middle) = (piece[1] - piece[0], 0.5 * (piece[0] + piece[1]));
            let mut containing = passed.iter().filter(|it| it.0 < middle && middle < it.1);
            let Some(&(.., material)) = containing.next() else {
                continue;
            };
            if length > SHORTEST_PIECE && containing.all(|it| it.2 == material) {
                lengths[material as usize] += length;
            }
        }
        let total: f64 = lengths.iter().sum();
        (total > 0.0).then(|| lengths.into_iter().map(|it| it / total).collect())
    }

    /// Whether a bond lies in one material only, the only one that both ends contain.
    fn ends_determine_material(&self, bond: usize, shares: &[f64]) -> bool {
        let [first, second] = self.ends[bond].map(|end| self.cloud.shares(end as usize));
        let common = first.iter().zip(second).map(|(a, b)| *a > 0.0 && *b > 0.0);
        common
            .zip(shares)
            .all(|(common, share)| common == (*share > 0.0))
            && shares.iter().filter(|share| **share > 0.0).count() == 1
    }
}

impl<const D: usize> Near<D> {
    /// Interval of a line within the part, from 0 at its first end to 1 at its second; `None` where the line misses the part.
    fn interval_of_line(&self, [start, end]: [[f64; D]; 2], slack: f64) -> Option<[f64; 2]> {
        let [lower, upper] = bounding_box([start, end]);
        let around = [lower.map(|x| x - slack), upper.map(|x| x + slack)];
        if !boxes_meet(around, self.bounds) {
            return None;
        }
        let [mut from, mut to] = [0.0_f64, 1.0];
        for side in &self.sides {
            let [before, after] = [start, end].map(|point| side.height(point) - slack);
            match (before > 0.0, after > 0.0) {
                (true, true) => return None,
                (true, false) => from = from.max(before / (before - after)),
                (false, true) => to = to.min(before / (before - after)),
                (false, false) => {}
            }
        }
        (from < to).then_some([from, to])
    }
}
