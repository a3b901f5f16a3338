//! Bound of the stiffness that a contact can have.

use super::Vector;
use super::facet::Facet;
use super::facet_pair::{FacetPair, Opposite};
use super::normal;

impl<const D: usize> FacetPair<D> {
    /// Shares of the axes in the stiffness of a facet: without friction that of a face of cells acts across it alone.
    fn axes(&self, facet: &Facet<D>) -> [f64; D] {
        let across = normal(&facet.corners.map(|it| it.position));
        match across.filter(|_| self.surface.cracks.is_some() && self.friction == 0.0) {
            Some(normal) => {
                let sum: f64 = normal.iter().map(|it| it.abs()).sum();
                normal.map(|it| it.abs() * sum)
            }
            None => [1.0; D],
        }
    }

    /// Adds a diagonal matrix above the stiffness that the contact can have, shape (n_degrees_of_freedom), N/m and N m.
    ///
    /// With (x - y)^2 <= 2 x^2 + 2 y^2 for the motions x and y of the two surfaces; an integration point of another side may act on one point
    /// alone, and as many as the own ones.
    pub(super) fn add_bound_of_all(&self, sums: &mut [f64]) {
        let is_driven = matches!(self.opposite, Opposite::Rigid(_, false));
        let factor = if is_driven { 1.0 } else { 2.0 };
        let meets_facets = !matches!(self.opposite, Opposite::Rigid(..));
        let other = meets_facets.then(|| self.surface.largest_stiffness());
        let of_place =
            |number: usize, it: &Facet<D>| factor * self.area(it) * self.stiffness(number, other);
        let times = if meets_facets { 2.0 } else { 1.0 };
        for (number, facet) in self.surface.all() {
            let (stiffness, axes) = (times * of_place(number, &facet), self.axes(&facet));
            for corner in 0..D as u32 {
                let weights = Self::place(corner).weights;
                self.surface
                    .add_bound((&facet, &weights), stiffness, axes, sums);
            }
        }
        if !meets_facets {
            return;
        }
        let all = self.surface.all();
        let one = all
            .map(|(number, it)| of_place(number, &it))
            .fold(0.0, f64::max);
        let mut seen = vec![false; self.surface.layout.n_points];
        for (_, facet) in self.surface.all() {
            for (corner, it) in facet.corners.iter().enumerate() {
                if !std::mem::replace(&mut seen[it.point as usize], true) {
                    let weights: Vector =
                        std::array::from_fn(|it| f64::from(u8::from(it == corner)));
                    self.surface
                        .add_bound((&facet, &weights), one, [1.0; D], sums);
                }
            }
        }
    }
}
