//! Summary of a mesh in the plane.

use std::io::{self, Write};

use ligament_case::mesh_file::bounding_box;
use ligament_mesh::{Cell, Group, Mesh};
use ligament_output::quantity::quantity;

use super::words::{
    Elements, NAMES, box_in_words, description, edge_length, edges_in_words, points_or_edges,
    write_fields, write_groups, write_remarks, write_size_note,
};
use crate::lines::entry;

/// Writes the summary of a mesh in the plane.
pub(super) fn write(out: &mut dyn Write, mesh: &Mesh) -> io::Result<()> {
    let is_triangle = |cell: &&Cell| matches!(cell, Cell::Triangle(_));
    let triangles = mesh.cells.iter().filter(is_triangle).count();
    let (cells, quadrangles) = (mesh.cells.len(), mesh.cells.len() - triangles);
    let corners = bounding_box(&mesh.positions);
    let lengths = (mesh.edges().into_iter()).map(|it| edge_length(&mesh.positions, it));
    let mut line = |name: &str, value: String| entry(out, NAMES, name, value);
    line("nodes", mesh.positions.len().to_string())?;
    let kinds = format!("{triangles} triangles, {quadrangles} quadrangles");
    line("cells", format!("{cells} ({kinds})"))?;
    line("area", quantity(mesh.area(), "m^2"))?;
    line("bounding box", box_in_words(corners))?;
    line("edges", edges_in_words(lengths))?;
    write_groups(out, &mesh.groups, |group| {
        description(elements(group, mesh), &mesh.positions)
    })?;
    write_fields(out, &mesh.fields)?;
    write_remarks(out, &mesh.remarks)?;
    write_size_note(out, corners)
}

fn elements<'a>(group: &'a Group, mesh: &'a Mesh) -> Elements<'a> {
    let positions = &mesh.positions;
    match group.dimension {
        2 => {
            let cells = group.cells.iter().map(|&cell| &mesh.cells[cell as usize]);
            let cells = cells.map(|it| (it.corners(), it.area(positions)));
            ("surface", Some("m^2"), cells.collect())
        }
        _ => points_or_edges(group, positions),
    }
}

#[cfg(test)]
mod tests {
    use ligament_mesh::gmsh;

    use super::*;

    const UNIT_SQUARE: &[u8] = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
        $PhysicalNames\n2\n1 1 \"left\"\n2 2 \"plate\"\n$EndPhysicalNames\n\
        $Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
        $Elements\n3\n1 1 2 1 1 4 1\n2 2 2 2 1 1 2 3\n3 2 2 2 1 1 3 4\n$EndElements\n";

    #[test]
    fn the_summary_has_cells_size_edges_and_groups() {
        let mesh = gmsh::parse(UNIT_SQUARE).unwrap();
        let mut out = Vec::new();
        write(&mut out, &mesh).unwrap();
        let text = String::from_utf8(out).unwrap();
        let expected = "  nodes         4
  cells         2 (2 triangles, 0 quadrangles)
  area          1.000 m^2
  bounding box  x 0 to 1.000 m, y 0 to 1.000 m
  edges         shortest 1.000 m, longest 1.414 m, ratio 1.41
  groups
    name   kind     number     nodes  size       centre
    left   curve         1         2  1.000 m    (0, 0.5000) m
    plate  surface       2         4  1.000 m^2  (0.5000, 0.5000) m
";
        assert_eq!(text, expected);
    }
}
