//! What `ligament check` tells of bodies in the plane and in space in words of their own.

use std::io::{self, Write};

use ligament::setup::{Dim, Dimension};
use ligament::{Model, Setup};
use ligament_model::Material;

/// Words on a model in D dimensions that another dimension has not.
pub(super) trait Told<const D: usize>
where
    Dim: Dimension<D>,
{
    /// Writes what a point stands for.
    fn section(out: &mut dyn Write, model: &Model<D>) -> io::Result<()>;

    /// Young's modulus of a bar of a material with the constants that the law makes of it; None for one with axes.
    fn young(setup: &Setup<D>, material: &Material) -> Option<f64>;

    /// Writes what cracks spend, and what varies at random.
    fn cracks(out: &mut dyn Write, model: &Model<D>) -> io::Result<()>;
}
