//! The table of the groups of a mesh.

use std::io::{self, Write};

use ligament_mesh::Group;
use ligament_output::columns::WIDEST;

use super::words::NAMES;
use crate::lines::entry;

/// Writes one line per group, with its kind and size by `kind_and_size`.
pub(super) fn write(
    out: &mut dyn Write,
    groups: &[Group],
    kind_and_size: impl Fn(&Group) -> (&'static str, String),
) -> io::Result<()> {
    if groups.is_empty() {
        let none = "none: a case can select by `box` or `at` only";
        return entry(out, NAMES, "groups", none);
    }
    let letters = groups.iter().map(|group| group.name.chars().count());
    let width = letters.fold(4, usize::max).min(WIDEST);
    writeln!(out, "  groups")?;
    writeln!(
        out,
        "    {:width$}  {:7}  {:>6}  {:>8}  size",
        "name", "kind", "number", "nodes"
    )?;
    for group in groups {
        let (kind, size) = kind_and_size(group);
        let (name, number, nodes) = (&group.name, group.number, group.nodes.len());
        let line = format!("    {name:width$}  {kind:7}  {number:>6}  {nodes:>8}  {size}");
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}
