//! Pre-cracks in space: surfaces that cut the bonds whose straight line they cross.
//!
//! The rule, decided with exact orientation predicates on the triangles of the surface, with its rim excluded:
//! - a point exactly on the crack counts as lying on its front, the side from which corners stand counter-clockwise;
//! - a bond in the plane of a piece of the crack survives;
//! - a bond that only touches the rim survives; one through an edge or a vertex inside of the surface is cut.
//!
//! The rim of a disk is round: what comes closer to it, or to its plane, than 1e-5 of the nearest distance of the bond's ends touches it.
//!
//! With the rim included every bond is cut that has a point in common with the surface, or comes no farther than 1e-5 of the nearest
//! distance of its ends, as in the plane (`bonds/precrack.rs`).

mod disk;
mod sheet;
mod unfit;

use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::bonds::BondSet;
use crate::bonds::precrack::Ends;
use crate::cloud::PointCloud;
use disk::Disk;
use sheet::Sheet;
pub use unfit::UnfitCrack;

/// A surface that cuts bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidPreCrack {
    surface: Surface,
    /// Whether bonds that only touch the pre-crack are cut.
    pub ends: Ends,
}

#[derive(Debug, Clone, PartialEq)]
enum Surface {
    Disk(Disk),
    Sheet(Sheet),
}

impl SolidPreCrack {
    /// A disk with a centre (coordinates of the case, m), a normal of any length towards its front, and a radius (m).
    ///
    /// # Errors
    ///
    /// If the normal has no direction or the radius is not positive.
    pub fn disk(centre: [f64; 3], normal: [f64; 3], radius: f64) -> Result<Self, UnfitCrack> {
        Disk::new(centre, normal, radius).map(|it| Self::without_rim(Surface::Disk(it)))
    }

    /// The parallelogram between a corner and the corners beside it (coordinates of the case, m); its front is the side from which the
    /// three stand counter-clockwise.
    ///
    /// # Errors
    ///
    /// If the three lie on a line.
    pub fn parallelogram([corner, one, other]: [[f64; 3]; 3]) -> Result<Self, UnfitCrack> {
        let opposite = [0, 1, 2].map(|axis| one[axis] + (other[axis] - corner[axis]));
        Self::polygon(&[corner, one, opposite, other])
    }

    /// A plane polygon with three corners or more (coordinates of the case, m); its front is the side from which they stand
    /// counter-clockwise.
    ///
    /// # Errors
    ///
    /// If the corners do not lie in a plane (to 1e-6 of its size), lie on a line, or the polygon crosses itself.
    pub fn polygon(corners: &[[f64; 3]]) -> Result<Self, UnfitCrack> {
        Sheet::polygon(corners).map(|it| Self::without_rim(Surface::Sheet(it)))
    }

    /// A surface of triangles by the numbers of their corners among `points` (coordinates of the case, m). Neighbours are turned so that
    /// they have the front on the same side as the first of the triangles that hang together.
    ///
    /// # Errors
    ///
    /// If there is no triangle, one names a point that there is not, or one has no area.
    pub fn triangles(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, UnfitCrack> {
        Sheet::new(points.to_vec(), triangles.to_vec())
            .map(|it| Self::without_rim(Surface::Sheet(it)))
    }

    /// Surface with its rim: every bond that has a point in common with it is cut.
    pub fn with_rim(self) -> Self {
        Self {
            ends: Ends::Included,
            ..self
        }
    }

    fn without_rim(surface: Surface) -> Self {
        Self {
            surface,
            ends: Ends::Excluded,
        }
    }

    fn in_local_coordinates(&self, cloud: &PointCloud<3>) -> Self {
        let surface = match &self.surface {
            Surface::Disk(disk) => Surface::Disk(disk.moved(|p| cloud.local(p))),
            Surface::Sheet(sheet) => Surface::Sheet(sheet.moved(|p| cloud.local(p))),
        };
        Self {
            surface,
            ends: self.ends,
        }
    }

    fn n_pieces(&self) -> u32 {
        match &self.surface {
            Surface::Disk(_) => 1,
            Surface::Sheet(sheet) => sheet.n_triangles(),
        }
    }

    /// Box around a piece.
    fn bounds(&self, piece: u32) -> [[f64; 3]; 2] {
        match &self.surface {
            Surface::Disk(disk) => disk.bounds(),
            Surface::Sheet(sheet) => sheet.bounds(piece),
        }
    }

    /// Whether a piece cuts a bond.
    fn cuts(&self, piece: u32, bond: [[f64; 3]; 2], slack: f64) -> bool {
        match (&self.surface, self.ends) {
            (Surface::Disk(disk), Ends::Excluded) => disk.cuts(bond, slack),
            (Surface::Disk(disk), Ends::Included) => disk.meets(bond, slack),
            (Surface::Sheet(sheet), Ends::Excluded) => sheet.cuts(piece, bond),
            (Surface::Sheet(sheet), Ends::Included) => sheet.meets(piece, bond, slack),
        }
    }

    /// Whether the rim of a piece lies on a bond that goes from one side to the other.
    fn touches(&self, piece: u32, bond: [[f64; 3]; 2], slack: f64) -> bool {
        match &self.surface {
            Surface::Disk(disk) => disk.touches(bond, slack),
            Surface::Sheet(sheet) => sheet.touches(piece, bond),
        }
    }

    /// Unit normal of a piece, and how far from its rim, over its size, the line of a bond meets it; negative beyond it.
    fn crossing(&self, piece: u32, bond: [[f64; 3]; 2]) -> ([f64; 3], f64) {
        match &self.surface {
            Surface::Disk(disk) => disk.crossing(bond),
            Surface::Sheet(sheet) => sheet.crossing(piece, bond),
        }
    }
}

/// Pre-cracks in the coordinates of a cloud, their pieces found by place.
struct Pieces {
    cracks: Vec<SolidPreCrack>,
    /// Crack and piece.
    tree: RTree<GeomWithData<Rectangle<[f64; 3]>, [u32; 2]>>,
}

impl Pieces {
    fn new(cracks: &[SolidPreCrack], cloud: &PointCloud<3>) -> Self {
        let local = cracks.iter().map(|crack| crack.in_local_coordinates(cloud));
        let cracks: Vec<SolidPreCrack> = local.collect();
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

    /// Whether a question is true of a piece near a bond.
    fn any(
        &self,
        cloud: &PointCloud<3>,
        [a, b]: [u32; 2],
        question: impl Fn(&SolidPreCrack, u32, [[f64; 3]; 2], f64) -> bool,
    ) -> bool {
        let slack = cloud.slack_between([a, b]);
        let [a, b] = [a, b].map(|end| cloud.positions[end as usize]);
        let around = AABB::from_corners(
            [0, 1, 2].map(|axis| a[axis].min(b[axis]) - slack),
            [0, 1, 2].map(|axis| a[axis].max(b[axis]) + slack),
        );
        let mut near = self.tree.locate_in_envelope_intersecting(around);
        near.any(|piece| {
            let [crack, number] = piece.data;
            question(&self.cracks[crack as usize], number, [a, b], slack)
        })
    }
}

/// For each bond, whether a pre-crack cuts it, shape (n_bonds).
pub fn cut_bonds(cracks: &[SolidPreCrack], bonds: &BondSet<3>, cloud: &PointCloud<3>) -> Vec<bool> {
    if cracks.is_empty() {
        return vec![false; bonds.len()];
    }
    let pieces = Pieces::new(cracks, cloud);
    let ends = bonds.ends.par_iter();
    ends.map(|&ends| pieces.any(cloud, ends, SolidPreCrack::cuts))
        .collect()
}

/// Number of bonds that the pre-cracks leave whole although the rim of one lies on the bond, between its ends.
pub fn count_touched_bonds(
    cracks: &[SolidPreCrack],
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    is_cut: &[bool],
) -> usize {
    if cracks.is_empty() {
        return 0;
    }
    let pieces = Pieces::new(cracks, cloud);
    let whole = bonds.ends.par_iter().zip(is_cut).filter(|(_, cut)| !**cut);
    let here = whole.filter(|(ends, _)| {
        cloud.counts(**ends) && pieces.any(cloud, **ends, SolidPreCrack::touches)
    });
    cloud.total(here.count())
}

/// Unit normals of pre-cracks where they cut some bonds, from the first end to the second, shape (n_cut): of the piece that the bond
/// crosses, and where it crosses several of the one that it meets farthest from a rim.
pub fn normals(cracks: &[SolidPreCrack], cut: &[[u32; 2]], cloud: &PointCloud<3>) -> Vec<[f64; 3]> {
    let local = cracks.iter().map(|crack| crack.in_local_coordinates(cloud));
    let cracks: Vec<SolidPreCrack> = local.collect();
    let of_bond = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|end| cloud.positions[end as usize]);
        let pieces = cracks.iter().flat_map(|crack| {
            (0..crack.n_pieces()).map(move |piece| crack.crossing(piece, [a, b]))
        });
        let best = pieces.reduce(|best, it| if it.1 > best.1 { it } else { best });
        let normal = best.map_or([1.0, 0.0, 0.0], |(normal, _)| normal);
        let along: f64 = (0..3).map(|axis| normal[axis] * (b[axis] - a[axis])).sum();
        if along < 0.0 {
            normal.map(|it| -it)
        } else {
            normal
        }
    };
    cut.par_iter().map(of_bond).collect()
}

#[cfg(test)]
mod tests;
