//! `ligament inspect`: what is in a mesh.

use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::Path;

use ligament_case::mesh_file::bounding_box;
use ligament_mesh::{Cell, Group, Mesh};
use ligament_output::columns::WIDEST;
use ligament_output::quantity::{between, quantity};

use crate::lines::entry;

/// Writes a summary of a mesh; `path` heads it.
///
/// # Errors
///
/// If `out` cannot be written to.
pub fn write_summary(out: &mut dyn Write, path: &Path, mesh: &Mesh) -> io::Result<()> {
    let is_triangle = |cell: &&Cell| matches!(cell, Cell::Triangle(_));
    let triangles = mesh.cells.iter().filter(is_triangle).count();
    let (cells, quadrangles) = (mesh.cells.len(), mesh.cells.len() - triangles);
    let [low, high] = bounding_box(&mesh.positions);
    let (shortest, longest) = edge_lengths(mesh);
    writeln!(out, "{}", path.display())?;
    let mut entry = |name: &str, value: String| entry(out, 13, name, value);
    entry("nodes", mesh.positions.len().to_string())?;
    let kinds = format!("{triangles} triangles, {quadrangles} quadrangles");
    entry("cells", format!("{cells} ({kinds})"))?;
    entry("area", quantity(mesh.area(), "m^2"))?;
    let [x, y] = [0, 1].map(|axis| between([low[axis], high[axis]], "m"));
    entry("bounding box", format!("x {x}, y {y}"))?;
    let ratio = longest / shortest;
    let lengths = format!(
        "shortest {}, longest {}, ratio {ratio:.2}",
        quantity(shortest, "m"),
        quantity(longest, "m")
    );
    entry("edges", lengths)?;
    write_groups(out, mesh)?;
    for field in &mesh.fields {
        let values = field.components;
        let plural = if values == 1 { "" } else { "s" };
        let (name, step) = (&field.name, field.time_step);
        writeln!(
            out,
            "  field         {name}, time step {step}, {values} value{plural} a node"
        )?;
    }
    for remark in &mesh.remarks {
        writeln!(out, "  note: {remark}")?;
    }
    Ok(())
}

fn write_groups(out: &mut dyn Write, mesh: &Mesh) -> io::Result<()> {
    if mesh.groups.is_empty() {
        return entry(
            out,
            13,
            "groups",
            "none: a case can select by `box` or `at` only",
        );
    }
    let letters = mesh.groups.iter().map(|group| group.name.chars().count());
    let width = letters.fold(4, usize::max).min(WIDEST);
    writeln!(out, "  groups")?;
    writeln!(
        out,
        "    {:width$}  {:7}  {:>6}  {:>8}  size",
        "name", "kind", "number", "nodes"
    )?;
    for group in &mesh.groups {
        let (kind, size) = kind_and_size(group, mesh);
        let (name, number, nodes) = (&group.name, group.number, group.nodes.len());
        let line = format!("    {name:width$}  {kind:7}  {number:>6}  {nodes:>8}  {size}");
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}

fn kind_and_size(group: &Group, mesh: &Mesh) -> (&'static str, String) {
    match group.dimension {
        0 => ("points", String::new()),
        1 => {
            let edges = group.edges.iter();
            let lengths = edges.map(|&edge| edge_length(&mesh.positions, edge));
            ("curve", quantity(lengths.sum::<f64>(), "m"))
        }
        _ => {
            let cells = group.cells.iter().map(|&cell| &mesh.cells[cell as usize]);
            let area: f64 = cells.map(|cell| cell.area(&mesh.positions)).sum();
            ("surface", quantity(area, "m^2"))
        }
    }
}

/// Lengths of the shortest and the longest edge of a cell.
fn edge_lengths(mesh: &Mesh) -> (f64, f64) {
    let mut edges = BTreeSet::new();
    for cell in &mesh.cells {
        let corners = cell.corners();
        for (index, &from) in corners.iter().enumerate() {
            let to = corners[(index + 1) % corners.len()];
            edges.insert([from.min(to), from.max(to)]);
        }
    }
    let edges = edges.into_iter();
    let lengths = edges.map(|edge| edge_length(&mesh.positions, edge));
    lengths.fold((f64::INFINITY, 0.0), |(shortest, longest), length| {
        (f64::min(shortest, length), f64::max(longest, length))
    })
}

fn edge_length(positions: &[[f64; 2]], [from, to]: [u32; 2]) -> f64 {
    let ([ax, ay], [bx, by]) = (positions[from as usize], positions[to as usize]);
    (bx - ax).hypot(by - ay)
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
        write_summary(&mut out, Path::new("square.msh"), &mesh).unwrap();
        let text = String::from_utf8(out).unwrap();
        let expected = "\
square.msh
  nodes         4
  cells         2 (2 triangles, 0 quadrangles)
  area          1.000 m^2
  bounding box  x 0 to 1.000 m, y 0 to 1.000 m
  edges         shortest 1.000 m, longest 1.414 m, ratio 1.41
  groups
    name   kind     number     nodes  size
    left   curve         1         2  1.000 m
    plate  surface       2         4  1.000 m^2
";
        assert_eq!(text, expected);
    }
}
