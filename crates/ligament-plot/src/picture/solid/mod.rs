//! Pictures of solids: what is seen of triangles in space, from a side, drawn as filled paths.
//!
//! Triangles ([`Scene`]) come from the outline of the body, from a section, from a crack or from where a field has a value
//! (`read`). They are moved, looked at from a side ([`View`]), and those that others hide are left out by a depth buffer
//! (`visible`); the rest is painted from the farthest to the nearest in bands of colour, darker where it is turned away from
//! the light (`draw`). The picture consists of paths, as those of bodies in the plane: it can be edited, and becomes PNG or PDF.

mod draw;
mod outline;
mod read;
mod scene;
mod section;
mod view;
mod visible;

pub use section::Section;
pub use view::View;

pub(super) use read::read;
pub(super) use scene::Scene;
