//! Common texts for meshes in the plane and in space, and the table of their groups.

use std::io::{self, Write};

use ligament::warning::large_body;
use ligament_mesh::{Group, NodeField, Remark};
use ligament_output::columns::MAX_COLUMN_WIDTH;
use ligament_output::quantity::{between, place, quantity};

use crate::lines::entry;

/// Length of the longest name of an entry.
pub(super) const NAMES: usize = 13;

/// Text of the shortest and the longest edge.
pub(super) fn edges_in_words(lengths: impl Iterator<Item = f64>) -> String {
    let start = (f64::INFINITY, 0.0);
    let (shortest, longest) = lengths.fold(start, |(shortest, longest), length| {
        (f64::min(shortest, length), f64::max(longest, length))
    });
    let ratio = longest / shortest;
    format!(
        "shortest {}, longest {}, ratio {ratio:.2}",
        quantity(shortest, "m"),
        quantity(longest, "m")
    )
}

/// Length of an edge, m.
pub(super) fn edge_length<const D: usize>(positions: &[[f64; D]], [from, to]: [u32; 2]) -> f64 {
    let [from, to] = [from, to].map(|node| positions[node as usize]);
    match (from.as_slice(), to.as_slice()) {
        ([ax, ay], [bx, by]) => (bx - ax).hypot(by - ay),
        _ => {
            let squares = from.iter().zip(&to).map(|(a, b)| (b - a).powi(2));
            squares.sum::<f64>().sqrt()
        }
    }
}

/// Text of a box's range along each axis.
pub(super) fn box_in_words<const D: usize>([low, high]: [[f64; D]; 2]) -> String {
    let along = |axis: usize| {
        let name = ["x", "y", "z"][axis];
        format!("{name} {}", between([low[axis], high[axis]], "m"))
    };
    (0..D).map(along).collect::<Vec<_>>().join(", ")
}

/// Writes one line per field.
pub(super) fn write_fields(out: &mut dyn Write, fields: &[NodeField]) -> io::Result<()> {
    for field in fields {
        let values = field.components;
        let plural = if values == 1 { "" } else { "s" };
        let (name, step) = (&field.name, field.time_step);
        writeln!(
            out,
            "  field         {name}, time step {step}, {values} value{plural} a node"
        )?;
    }
    Ok(())
}

/// Writes the remarks of the mesh reader.
pub(super) fn write_remarks(out: &mut dyn Write, remarks: &[Remark]) -> io::Result<()> {
    for remark in remarks {
        writeln!(out, "  note: {remark}")?;
    }
    Ok(())
}

/// Writes a note where the coordinates of a body are probably in millimetres.
pub(super) fn write_size_note<const D: usize>(
    out: &mut dyn Write,
    [low, high]: [[f64; D]; 2],
) -> io::Result<()> {
    let sides = (0..D).map(|axis| high[axis] - low[axis]);
    let length = sides.fold(0.0, f64::max);
    if let Some(message) = large_body(length) {
        writeln!(out, "  note: {message}")?;
    }
    Ok(())
}

/// Elements of a group: their kind, the unit of their sizes, and for each its corners and its size.
pub(super) type Elements<'a> = (&'static str, Option<&'static str>, Vec<(&'a [u32], f64)>);

/// The nodes of a group of points, or the edges of a curve.
pub(super) fn points_or_edges<'a, const D: usize>(
    group: &'a Group,
    positions: &[[f64; D]],
) -> Elements<'a> {
    if group.dimension == 0 {
        let nodes = group.nodes.chunks(1).map(|it| (it, 1.0));
        return ("points", None, nodes.collect());
    }
    let edges = group.edges.iter();
    let edges = edges.map(|it| (it.as_slice(), edge_length(positions, *it)));
    ("curve", Some("m"), edges.collect())
}

/// Kind, size and centre of the elements of a group.
pub(super) fn description<const D: usize>(
    (kind, unit, elements): Elements<'_>,
    positions: &[[f64; D]],
) -> [String; 3] {
    let total: f64 = elements.iter().map(|it| it.1).sum();
    let mut centre = [0.0; D];
    for (corners, size) in elements {
        let share = size / (total * corners.len() as f64);
        for corner in corners {
            let position = positions[*corner as usize];
            (centre.iter_mut().zip(position)).for_each(|(sum, it)| *sum += share * it);
        }
    }
    let size = unit.map_or(String::new(), |unit| quantity(total, unit));
    [kind.to_owned(), size, place(&centre)]
}

/// Writes one line per group, with its kind, size and centre by `description`.
pub(super) fn write_groups(
    out: &mut dyn Write,
    groups: &[Group],
    description: impl Fn(&Group) -> [String; 3],
) -> io::Result<()> {
    if groups.is_empty() {
        let none = "none: a case can select by `box` or `at` only";
        return entry(out, NAMES, "groups", none);
    }
    let letters = groups.iter().map(|group| group.name.chars().count());
    let width = letters.fold(4, usize::max).min(MAX_COLUMN_WIDTH);
    writeln!(out, "  groups")?;
    let described: Vec<[String; 3]> = groups.iter().map(description).collect();
    let letters = described.iter().map(|[_, size, _]| size.chars().count());
    let of_size = letters.fold(4, usize::max);
    writeln!(
        out,
        "    {:width$}  {:7}  {:>6}  {:>8}  {:of_size$}  centre",
        "name", "kind", "number", "nodes", "size"
    )?;
    for (group, [kind, size, centre]) in groups.iter().zip(described) {
        let (name, number, nodes) = (&group.name, group.number, group.nodes.len());
        let line = format!(
            "    {name:width$}  {kind:7}  {number:>6}  {nodes:>8}  {size:of_size$}  {centre}"
        );
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}
