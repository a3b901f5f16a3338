//! What the bending test asks of meshed bodies.

use std::sync::Arc;

use crate::body::Body;
use crate::model::Discretises;
use crate::setup::{Dim, Dimension, Setup};

/// A stress (Pa) or a strain.
pub(crate) type Tensor<const D: usize> = [[f64; D]; D];

/// A stress that is linear in the position from the middle of a strip: its growth along each coordinate, Pa/m.
pub(crate) type LinearStress<const D: usize> = [Tensor<D>; D];

/// What the bending test asks of meshed bodies in D dimensions.
pub trait Meshed<const D: usize>: Discretises<D>
where
    Dim: Dimension<D>,
{
    /// Points of a strip up to which the test takes a second or two.
    const MOST_POINTS: usize;

    /// Corners of the cells of a body, shape (n_cells, corners); none of bodies without a mesh.
    fn cells(setup: &Setup<D>) -> Vec<&[u32]>;

    /// Corners of the sides of the cells that are on the outline, in an order that tells inside from outside.
    fn sides(setup: &Setup<D>) -> Vec<[u32; D]>;

    /// Area of a side times its outward normal, m^(D - 1).
    fn area(corners: [[f64; D]; D]) -> [f64; D];

    /// A body of some of the cells (ascending) of another.
    fn part(setup: &Setup<D>, cells: &[usize]) -> Arc<dyn Body<D>>;

    /// Strains of the first material of a setup under a stress.
    fn strain(setup: &Setup<D>, stress: &Tensor<D>) -> Option<Tensor<D>>;

    /// Extent of the body across the D dimensions, m; 1 in space.
    fn width(setup: &Setup<D>) -> f64;
}
