//! Pre-cracks in space: surfaces.
//!
//! The rim of a disk is round: a bond closer to it, or to its plane, than 1e-5 of the nearest distance of the bond's ends touches it.

mod disk;
mod sheet;
mod unfit;

use super::{Crossing, Cut, Ends};
use crate::tensor::{dot, minus};
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
    /// Returns an error if the normal has no direction or the radius is not positive.
    pub fn disk(centre: [f64; 3], normal: [f64; 3], radius: f64) -> Result<Self, UnfitCrack> {
        Disk::new(centre, normal, radius).map(|it| Self::without_rim(Surface::Disk(it)))
    }

    /// The parallelogram of a corner and the two corners beside it (coordinates of the case, m); its front is the side from which the three
    /// are counter-clockwise.
    ///
    /// # Errors
    ///
    /// Returns an error if the three corners lie on a line.
    pub fn parallelogram([corner, one, other]: [[f64; 3]; 3]) -> Result<Self, UnfitCrack> {
        let opposite = [0, 1, 2].map(|axis| one[axis] + (other[axis] - corner[axis]));
        Self::polygon(&[corner, one, opposite, other])
    }

    /// A plane polygon with three corners or more (coordinates of the case, m); its front is the side from which they are counter-clockwise.
    ///
    /// # Errors
    ///
    /// Returns an error if the corners do not lie in a plane (to 1e-6 of the size), lie on a line, or the polygon crosses itself.
    pub fn polygon(corners: &[[f64; 3]]) -> Result<Self, UnfitCrack> {
        Sheet::polygon(corners).map(|it| Self::without_rim(Surface::Sheet(it)))
    }

    /// A surface of triangles, given by the numbers of their corners among `points` (coordinates of the case, m). Connected triangles are
    /// oriented with the front on the same side as the first of them.
    ///
    /// # Errors
    ///
    /// Returns an error if there is no triangle, a triangle refers to a point that does not exist, or has no area.
    pub fn triangles(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, UnfitCrack> {
        Sheet::new(points.to_vec(), triangles.to_vec())
            .map(|it| Self::without_rim(Surface::Sheet(it)))
    }

    /// The surface with its rim included: every bond that has a point in common with it is cut.
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
}

impl Cut<3> for SolidPreCrack {
    fn moved(&self, by: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let surface = match &self.surface {
            Surface::Disk(disk) => Surface::Disk(disk.moved(by)),
            Surface::Sheet(sheet) => Surface::Sheet(sheet.moved(by)),
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

    fn bounds(&self, piece: u32) -> [[f64; 3]; 2] {
        match &self.surface {
            Surface::Disk(disk) => disk.bounds(),
            Surface::Sheet(sheet) => sheet.bounds(piece),
        }
    }

    fn cuts(&self, piece: u32, bond: [[f64; 3]; 2], slack: f64) -> bool {
        match (&self.surface, self.ends) {
            (Surface::Disk(disk), Ends::Excluded) => disk.cuts(bond, slack),
            (Surface::Disk(disk), Ends::Included) => disk.meets(bond, slack),
            (Surface::Sheet(sheet), Ends::Excluded) => sheet.cuts(piece, bond),
            (Surface::Sheet(sheet), Ends::Included) => sheet.meets(piece, bond, slack),
        }
    }

    fn touches(&self, piece: u32, bond: [[f64; 3]; 2], slack: f64) -> bool {
        match &self.surface {
            Surface::Disk(disk) => disk.touches(bond, slack),
            Surface::Sheet(sheet) => sheet.touches(piece, bond),
        }
    }

    fn crossing(&self, piece: u32, bond: [[f64; 3]; 2]) -> Crossing<3> {
        let mut crossing = match &self.surface {
            Surface::Disk(disk) => disk.crossing(bond),
            Surface::Sheet(sheet) => sheet.crossing(piece, bond),
        };
        if dot(crossing.normal, minus(bond[1], bond[0])) < 0.0 {
            crossing.normal = crossing.normal.map(|component| -component);
        }
        crossing
    }
}

#[cfg(test)]
mod tests;
