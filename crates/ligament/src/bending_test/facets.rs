//! The outline of a part of a mesh as flat sides, and integrals over the part as sums over the sides.
//!
//! Integrals over a body with flat sides of normal N (with the area as its length) are sums over these, by the divergence of x, x_i x and
//! x_i x_j x: D V = sum p . N, (D + 1) int x_i = sum (p . N) m_i, (D + 2) int x_i x_j = sum (p . N) m_ij with the means m over a side, p
//! any point of it.

use super::stress::Tensor;
use crate::setup::Setup;

/// A flat side of the outline with D corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facet<const D: usize> {
    /// Indices of the points at the corners.
    pub(crate) corners: [u32; D],
    /// Positions of the corners, m.
    pub(crate) places: [[f64; D]; D],
    /// Area times the outward normal, m^(D - 1).
    pub(crate) area: [f64; D],
}

/// The sides of the outline of a body.
pub(super) fn of_body<const D: usize>(setup: &Setup) -> Vec<Facet<D>> {
    let body = setup.body.geometry();
    let (positions, sides) = (body.positions(), body.outer_sides().into_iter());
    sides
        .map(|corners| {
            let places = corners.map(|corner| positions[corner as usize]);
            let area = area(places);
            Facet {
                corners,
                places,
                area,
            }
        })
        .collect()
}

/// Area of a side times its outward normal, m^(D - 1).
pub(super) fn area<const D: usize>(places: [[f64; D]; D]) -> [f64; D] {
    let along = |corner: usize| minus(places[corner], places[0]);
    let edge = along(1);
    match D {
        2 => std::array::from_fn(|axis| if axis == 0 { edge[1] } else { -edge[0] }),
        _ => {
            let other = along(2);
            std::array::from_fn(|axis| {
                let [next, last] = [(axis + 1) % D, (axis + 2) % D];
                0.5 * (edge[next] * other[last] - edge[last] * other[next])
            })
        }
    }
}

impl<const D: usize> Facet<D> {
    /// Mean position, m.
    pub(crate) fn middle(&self) -> [f64; D] {
        mean(&self.places)
    }

    /// Product p . N of position and normal, m^D.
    fn cone(&self) -> f64 {
        dot(self.places[0], self.area)
    }

    /// Means of x_i x_j over the side, m^2.
    fn second(&self) -> Tensor<D> {
        let sum = self.middle().map(|it| D as f64 * it);
        let parts = 1.0 / (D * (D + 1)) as f64;
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let corners = self.places.iter().map(|place| place[i] * place[j]);
                parts * (corners.sum::<f64>() + sum[i] * sum[j])
            })
        })
    }
}

/// Volume (m^D) and centroid (m) of the region within sides.
pub(super) fn volume_and_middle<const D: usize>(facets: &[Facet<D>]) -> (f64, [f64; D]) {
    let volume = facets.iter().map(Facet::cone).sum::<f64>() / D as f64;
    let middle = std::array::from_fn(|axis| {
        let first = facets.iter().map(|it| it.cone() * it.middle()[axis]);
        first.sum::<f64>() / ((D + 1) as f64 * volume)
    });
    (volume, middle)
}

/// Integrals of x_i x_j over the region within sides, m^(D + 2).
pub(super) fn second_moments<const D: usize>(facets: &[Facet<D>]) -> Tensor<D> {
    let mut sum = [[0.0; D]; D];
    for facet in facets {
        let (cone, second) = (facet.cone() / (D + 2) as f64, facet.second());
        for (sums, parts) in sum.iter_mut().zip(second) {
            for (sum, part) in sums.iter_mut().zip(parts) {
                *sum += cone * part;
            }
        }
    }
    sum
}

pub(crate) fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn minus<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

/// Length of a vector.
pub(super) fn size<const D: usize>(a: [f64; D]) -> f64 {
    dot(a, a).sqrt()
}

/// Mean of positions.
pub(super) fn mean<const D: usize>(places: &[[f64; D]]) -> [f64; D] {
    std::array::from_fn(|axis| {
        places.iter().map(|place| place[axis]).sum::<f64>() / places.len() as f64
    })
}
