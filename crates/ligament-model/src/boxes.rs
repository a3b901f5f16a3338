//! Search for the boxes that meet another box.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::geometry::boxes_meet;

/// Boxes with sides along the axes, in a spatial search tree.
#[derive(Debug)]
pub struct Boxes<const D: usize>(RTree<GeomWithData<Rectangle<[f64; D]>, usize>>);

impl<const D: usize> Boxes<D> {
    /// Boxes by their lowest and highest corners, m; empty ones, whose lowest corner is above the highest one, meet no other.
    pub fn new(boxes: &[[[f64; D]; 2]]) -> Self {
        let numbered = boxes.iter().enumerate();
        let some = numbered.filter(|(_, corners)| boxes_meet(**corners, **corners));
        let boxed = some.map(|(number, &[lower, upper])| {
            GeomWithData::new(Rectangle::from_corners(lower, upper), number)
        });
        Self(RTree::bulk_load(boxed.collect()))
    }

    /// Numbers of the boxes that have a point in common with another box.
    pub fn meeting(&self, [lower, upper]: [[f64; D]; 2]) -> impl Iterator<Item = usize> {
        let around = AABB::from_corners(lower, upper);
        let found = self.0.locate_in_envelope_intersecting(around);
        found.map(|it| it.data)
    }
}
