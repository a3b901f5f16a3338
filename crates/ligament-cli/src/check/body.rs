//! What `ligament check` tells of a body.

use std::io::{self, Write};

use ligament::body::{Body, Origin};
use ligament_mesh::Mesh;
use ligament_model::Lattice;

use super::entry::entry;

/// Writes what a body is made of, with the volume of its points.
pub(super) fn write(out: &mut dyn Write, body: &dyn Body, volume: f64) -> io::Result<()> {
    match body.origin() {
        Origin::Mesh(mesh) => write_mesh(out, mesh, volume),
        Origin::Lattice(lattice) => write_lattice(out, body, lattice, volume),
        Origin::Points => writeln!(out, "{} points of {volume:.6e} m^3", body.positions().len()),
    }
}

fn write_mesh(out: &mut dyn Write, mesh: &Mesh, volume: f64) -> io::Result<()> {
    writeln!(out, "mesh")?;
    let [nodes, cells] = [mesh.positions.len(), mesh.cells.len()];
    entry(out, "nodes, cells", format!("{nodes}, {cells}"))?;
    entry(out, "area", format!("{:.6e} m^2", mesh.area()))?;
    entry(out, "volume of the points", format!("{volume:.6e} m^3"))?;
    for group in &mesh.groups {
        let kinds = ["points", "curve", "surface"];
        let kind = kinds.get(usize::from(group.dimension)).unwrap_or(&"group");
        let of_nodes = format!("{kind} of {} nodes", group.nodes.len());
        entry(out, &format!("group {}", group.name), of_nodes)?;
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
    let cells = format!("{left} of {nx} x {ny} ({removed} removed)");
    entry(out, "cells", cells)?;
    entry(out, "spacing", format!("{dx:.6e} x {dy:.6e} m"))?;
    let sides = format!("x {x:.5e} to {right:.5e} m, y {y:.5e} to {top:.5e} m");
    entry(out, "rectangle", sides)?;
    entry(out, "area", format!("{area:.6e} m^2"))?;
    entry(out, "volume of the points", format!("{volume:.6e} m^3"))?;
    for name in body.group_names() {
        let mut words = format!("{} points", body.points_of(&name).unwrap_or_default().len());
        if let Some((_, length)) = body.lengths_of(&name).first() {
            words += &format!(", {length:.4e} m of a side each");
        }
        entry(out, &format!("set {name}"), words)?;
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
    entry(out, name, where_at)
}
