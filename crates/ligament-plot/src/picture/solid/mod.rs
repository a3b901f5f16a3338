//! Pictures of solids: triangles in space, seen from a side and drawn as filled paths.
//!
//! Triangles ([`Scene`]) come from the outline of the body, from a section, from a crack or from a level surface of a field (`read`). They
//! are moved, looked at from a side ([`View`]), and hidden ones are left out by a depth buffer (`visible`); the others are painted from the
//! farthest to the nearest in bands of colour, darker where they are turned away from the light (`draw`). The picture consists of paths,
//! like pictures of bodies in the plane: it can be edited, and becomes PNG or PDF.

mod draw;
mod groups;
mod outline;
mod read;
mod scene;
mod section;
mod view;
mod visible;

pub use groups::draw_groups;
pub use section::Section;
pub use view::{Upward, View};

pub(super) use read::read;
pub(super) use scene::Scene;
