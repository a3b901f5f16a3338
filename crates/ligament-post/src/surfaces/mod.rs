//! Surfaces in a solid as triangles: cracks, and level sets of fields.
//!
//! A bond model opens a crack by breaking all bonds across it. Between the points lie tetrahedra ([`Tetrahedra`]): parts of the cells of a
//! mesh, or of the cells between the points of a lattice. An edge of a tetrahedron is *cut* where the bond of its ends is broken or cut by a
//! pre-crack. Corners connected by uncut edges are on one side, and where a tetrahedron has several sides the crack passes through it
//! ([`crack_surface`]):
//!
//! 1. One corner against three gives a triangle, two against two a quadrangle, each through the middles of the edges between the sides.
//!    Three and four sides meet in the middles of faces, and of the tetrahedron. Places are common to the tetrahedra at an edge or face: the
//!    surface is connected where adjacent tetrahedra have the same sides.
//! 2. An edge longer than both horizons has no bond. It connects points that no bonds of its tetrahedron connected before the first load,
//!    and no others.
//! 3. A point whose edges are all cut lies in the crack: a crack on a layer of points would otherwise be two surfaces with the layer between
//!    them. Such a point is assigned to one side: the side of its neighbours in the crack that were assigned before it, else the side of its
//!    nearest neighbour.
//! 4. Middles of edges follow the cells and are jagged on their scale: each place is moved along the normal of the surface towards the mean
//!    of its neighbours ([`CrackSurface::smoothed`]).
//!
//! Sides of tetrahedra also cut cells into pieces that move apart ([`opened_cells`]).

mod crack;
mod detached;
mod level_set;
mod opened;
mod pieces;
mod sides;
mod smooth;
mod surface;
mod tetrahedra;
mod tetrahedra_of_body;

pub use crack::crack_surface;
pub use detached::sides_of_tetrahedra;
pub use level_set::{LevelSet, level_set};
pub use opened::opened_cells;
pub use sides::{Link, Links};
pub use surface::{BestPlane, CrackSurface, SurfacePart};
pub use tetrahedra::Tetrahedra;
