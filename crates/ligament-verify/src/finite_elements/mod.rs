//! Finite elements of classical elasticity in plane stress, for comparison with the lattices of the papers.
//!
//! | Module | Holds |
//! |--------|-------|
//! | `mesh` | quadrilaterals with four or nine nodes: squares, and the lamina with a hole |
//! | `element` | shape functions, stiffness and nodal volumes of one quadrilateral |
//! | `body` | displacements, natural modes and stresses of a body |

mod body;
mod element;
mod mesh;

pub use body::{Body, Mode};
pub use mesh::{Degree, Mesh};
