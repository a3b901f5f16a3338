//! Pre-cracks and slots: polylines in the plane and surfaces in space that cut the bonds whose straight line they cross.
//!
//! The rule, decided with exact orientation predicates, with the rim of the crack (the ends of a polyline) excluded:
//! - a point exactly on the crack counts as lying on its front: on the left of a polyline, seen along it, and on the side of a surface from
//!   which its corners are counter-clockwise;
//! - a bond along a piece of the crack survives;
//! - a bond that only touches the rim survives; one through an inner vertex or edge is cut. A closed crack has no rim.
//!
//! With the rim included every bond is cut that has a point in common with the crack, whatever the point: one of the rim, an end of the
//! bond, or a part of it along the crack. A point on the crack then loses all of its bonds. Bonds of a lattice pass exactly through such
//! rims, but not their rounded coordinates: a bond closer to the crack than 1e-5 of the nearest distance of its ends has a point in common.

mod crack;
mod plane;
mod solid;

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::BondSet;
use crate::cloud::PointCloud;
use crate::geometry::bounding_box;
use crate::parallel;

pub use crack::Crack;
pub use plane::{PreCrack, crossing_bonds};
pub use solid::{SolidPreCrack, UnfitCrack};

crate::case_type! {
    /// Treatment of bonds that only touch a pre-crack.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Ends {
        /// Bonds that pass through the crack are cut.
        #[default]
        Excluded,
        /// Bonds that have a point in common with the crack are cut.
        Included,
    }
}

/// Geometry of a pre-crack: the pieces of a line or of a surface, numbered from 0. Bonds are given by the positions of their ends, and all
/// coordinates are those of the case or, once moved, of a cloud (m).
pub trait Cut<const D: usize>: Sync + Sized {
    /// The pre-crack with every position mapped by a function.
    #[must_use]
    fn moved(&self, by: impl Fn([f64; D]) -> [f64; D]) -> Self;

    /// Number of pieces.
    fn n_pieces(&self) -> u32;

    /// Lowest and highest corner of the box around a piece, m.
    fn bounds(&self, piece: u32) -> [[f64; D]; 2];

    /// Whether a piece cuts a bond; parts no farther apart than `slack` (m) touch.
    fn cuts(&self, piece: u32, bond: [[f64; D]; 2], slack: f64) -> bool;

    /// Whether the rim of a piece touches a bond between its ends.
    fn touches(&self, piece: u32, bond: [[f64; D]; 2], slack: f64) -> bool;

    /// Intersection of the line of a bond with a piece.
    fn crossing(&self, piece: u32, bond: [[f64; D]; 2]) -> Crossing<D>;
}

/// Intersection of the line of a bond with a piece of a pre-crack.
#[derive(Debug, Clone, Copy)]
pub struct Crossing<const D: usize> {
    /// Unit normal of the piece, from the first end of the bond to the second.
    pub normal: [f64; D],
    /// Distance of the intersection from the rim of the piece, over the size of the piece; negative beyond the rim.
    pub depth: f64,
}

/// Pre-cracks in the coordinates of a cloud, with their pieces in a spatial search tree.
struct Pieces<const D: usize, C> {
    cracks: Vec<C>,
    /// Pieces by their boxes: number of the crack and of the piece.
    tree: RTree<GeomWithData<Rectangle<[f64; D]>, [u32; 2]>>,
}

impl<const D: usize, C: Cut<D>> Pieces<D, C> {
    fn new(cracks: &[C], cloud: &PointCloud<D>) -> Self {
        let cracks = in_cloud(cracks, cloud);
        let numbered = (0..).zip(&cracks);
        let pieces = numbered.flat_map(|(number, crack)| {
            (0..crack.n_pieces()).map(move |piece| {
                let [lower, upper] = crack.bounds(piece);
                GeomWithData::new(Rectangle::from_corners(lower, upper), [number, piece])
            })
        });
        let tree = RTree::bulk_load(pieces.collect());
        Self { cracks, tree }
    }

    /// Whether a predicate is true of a piece near a bond.
    fn any(
        &self,
        cloud: &PointCloud<D>,
        ends: [u32; 2],
        question: impl Fn(&C, u32, [[f64; D]; 2], f64) -> bool,
    ) -> bool {
        let slack = cloud.slack_between(ends);
        let bond = ends.map(|end| cloud.positions[end as usize]);
        let [lower, upper] = bounding_box(bond);
        let around = AABB::from_corners(lower.map(|x| x - slack), upper.map(|x| x + slack));
        let mut near = self.tree.locate_in_envelope_intersecting(around);
        near.any(|piece| {
            let [crack, number] = piece.data;
            question(&self.cracks[crack as usize], number, bond, slack)
        })
    }
}

/// Pre-cracks in the coordinates of a cloud.
fn in_cloud<const D: usize, C: Cut<D>>(cracks: &[C], cloud: &PointCloud<D>) -> Vec<C> {
    let local = cracks.iter().map(|crack| crack.moved(|it| cloud.local(it)));
    local.collect()
}

/// Whether a pre-crack cuts the straight line between each pair of points, shape (n_pairs).
pub fn cut_bonds<const D: usize, C: Cut<D>>(
    cracks: &[C],
    ends: &[[u32; 2]],
    cloud: &PointCloud<D>,
) -> Vec<bool> {
    if cracks.is_empty() {
        return vec![false; ends.len()];
    }
    let pieces = Pieces::new(cracks, cloud);
    parallel::values(ends.len(), false, |bond| {
        pieces.any(cloud, ends[bond], C::cuts)
    })
}

/// Number of bonds between points on the outline of the body (`is_on_outline`, n_points) that the pre-cracks do not cut although the rim of one
/// touches them between their ends: the bonds along the outline, where a polyline begins on it and not before.
pub fn count_touched_bonds<const D: usize, C: Cut<D>>(
    cracks: &[C],
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    is_cut: &[bool],
    is_on_outline: &[bool],
) -> usize {
    if cracks.is_empty() {
        return 0;
    }
    let pieces = Pieces::new(cracks, cloud);
    let whole = bonds.ends.iter().zip(is_cut).filter(|(_, cut)| !**cut);
    let along_outline = whole.filter(|(ends, _)| ends.iter().all(|it| is_on_outline[*it as usize]));
    let at_rim = along_outline.filter(|(ends, _)| {
        cloud.subdomain.owns_bond(**ends) && pieces.any(cloud, **ends, C::touches)
    });
    cloud.subdomain.count(at_rim.count())
}

/// Unit normals of pre-cracks where they cut some bonds, from the first end to the second, shape (n_cut): of the piece that the bond
/// crosses, or of several the piece that it crosses farthest from a rim.
pub fn normals<const D: usize, C: Cut<D>>(
    cracks: &[C],
    cut: &[[u32; 2]],
    cloud: &PointCloud<D>,
) -> Vec<[f64; D]> {
    let cracks = in_cloud(cracks, cloud);
    let of_bond = |ends: &[u32; 2]| {
        let bond = ends.map(|end| cloud.positions[end as usize]);
        let pieces = cracks
            .iter()
            .flat_map(|crack| (0..crack.n_pieces()).map(move |piece| crack.crossing(piece, bond)));
        let best = pieces.reduce(|best, it| if it.depth > best.depth { it } else { best });
        let along_x = || std::array::from_fn(|axis| if axis == 0 { 1.0 } else { 0.0 });
        best.map_or_else(along_x, |it| it.normal)
    };
    cut.iter().map(of_bond).collect()
}
