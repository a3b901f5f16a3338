//! Places where the stress of the elastic body is singular.

use ligament_mesh::Mesh;

use crate::body::Origin;
use crate::coordinates::coordinates;
use crate::setup::Setup;

/// Angle of the cells at a node of the outline beyond which it is a re-entrant corner, degrees: that of an L is 270, those of a round hole of
/// eight edges are 225.
const RE_ENTRANT: f64 = 230.0;

/// Place where the stress of the elastic body of a setup is singular, in words: the tip of a pre-crack, or a re-entrant corner of a mesh in the plane.
pub fn singular_place(setup: &Setup) -> Option<String> {
    if !setup.precracks.is_empty() {
        return Some("the tip of a pre-crack".to_owned());
    }
    let Origin::Mesh(mesh) = setup.body.origin() else {
        return None;
    };
    let corner = re_entrant_corner(mesh)?;
    let position = coordinates(&mesh.positions[corner as usize]);
    Some(format!("the re-entrant corner at ({position}) m"))
}

/// The first node of the outline with a re-entrant corner.
fn re_entrant_corner(mesh: &Mesh) -> Option<u32> {
    let angles = mesh.angles_at_nodes();
    let mut outline: Vec<u32> = mesh.outline().into_iter().flatten().collect();
    outline.sort_unstable();
    let mut outline = outline.into_iter();
    outline.find(|&node| angles[node as usize].to_degrees() > RE_ENTRANT)
}
