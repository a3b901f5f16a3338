//! What `ligament check` tells of a body.

use std::io::{self, Write};

use ligament::body::{Body, Origin};
use ligament_mesh::Mesh;
use ligament_model::Lattice;

/// Writes what a body is made of, with the volume of its points.
pub(super) fn write(out: &mut dyn Write, body: &dyn Body, volume: f64) -> io::Result<()> {
    match body.origin() {
        Origin::Mesh(mesh) => write_mesh(out, mesh, volume),
        Origin::Lattice(lattice) => write_lattice(out, body, lattice, volume),
        Origin::Points => writeln!(out, "{} points of {volume:.6e} m^3", body.positions().len()),
    }
}

fn write_mesh(out: &mut dyn Write, mesh: &Mesh, volume: f64) -> io::Result<()> {
    let (nodes, cells) = (mesh.positions.len(), mesh.cells.len());
    writeln!(out, "mesh")?;
    writeln!(out, "  nodes, cells          {nodes}, {cells}")?;
    writeln!(out, "  area                  {:.6e} m^2", mesh.area())?;
    writeln!(out, "  volume of the points  {volume:.6e} m^3")?;
    for group in &mesh.groups {
        let kind = ["points", "curve", "surface"]
            .get(usize::from(group.dimension))
            .unwrap_or(&"group");
        let (name, nodes) = (&group.name, group.nodes.len());
        writeln!(out, "  group {name:<15} {kind} of {nodes} nodes")?;
    }
    Ok(())
}

fn write_lattice(
    out: &mut dyn Write,
    body: &dyn Body,
    lattice: &Lattice,
    volume: f64,
) -> io::Result<()> {
    let ([nx, ny], [dx, dy], [x, y]) = (lattice.size, lattice.spacing, lattice.corner);
    let left = lattice.cells.len();
    let removed = lattice.n_whole() - left;
    let [right, top] = [x + f64::from(nx) * dx, y + f64::from(ny) * dy];
    let area = left as f64 * dx * dy;
    writeln!(out, "lattice")?;
    writeln!(
        out,
        "  cells                 {left} of {nx} x {ny} ({removed} removed)"
    )?;
    writeln!(out, "  spacing               {dx:.6e} x {dy:.6e} m")?;
    writeln!(
        out,
        "  rectangle             x {x:.5e} to {right:.5e} m, y {y:.5e} to {top:.5e} m"
    )?;
    writeln!(out, "  area                  {area:.6e} m^2")?;
    writeln!(out, "  volume of the points  {volume:.6e} m^3")?;
    for name in body.group_names() {
        let points = body.points_of(&name).unwrap_or_default().len();
        write!(out, "  set {name:<17} {points} points")?;
        match body.lengths_of(&name).first() {
            Some((_, length)) => writeln!(out, ", {length:.4e} m of a side each")?,
            None => writeln!(out)?,
        }
    }
    Ok(())
}

/// Writes a group of points that are held or loaded.
pub(super) fn write_group(
    out: &mut dyn Write,
    body: &dyn Body,
    name: &str,
    points: &[u32],
) -> io::Result<()> {
    let where_at = match points {
        [only] => body.place(*only),
        points => format!("{} points", points.len()),
    };
    writeln!(out, "  {name:<21} {where_at}")
}
