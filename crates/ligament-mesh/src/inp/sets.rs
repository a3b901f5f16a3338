//! Sets and surfaces: `*NSET`, `*ELSET` and `*SURFACE`.

use std::collections::BTreeMap;

use super::error::InpError;
use super::fields;
use super::keyword::{Keyword, side_number, text_of};
use super::model::Names;
use super::part::{Items, Member, Set, Side, Surface};
use super::source::{Command, Row};

/// Largest number of members that one line may generate.
const LARGEST_COUNT: u32 = 1_000_000_000;

/// Reads a set of nodes or elements.
pub(super) fn read_set(
    command: &Command<'_>,
    items: Items,
    names: &Names<'_>,
) -> Result<Set, InpError> {
    let parameter = match items {
        Items::Nodes => "NSET",
        Items::Elements => "ELSET",
    };
    let mut members = Vec::new();
    if let (Items::Nodes, Some(name)) = (items, command.value("ELSET")) {
        let elements = names.members(Items::Elements, name);
        let elements = elements.ok_or_else(|| command.unknown(Items::Elements.set(), name))?;
        members = nodes_of(names, &elements);
    }
    for mut row in command.rows() {
        if command.has("GENERATE") {
            members.extend(generated(&mut row, names.space)?);
        } else {
            while let Some(field) = row.fields.next() {
                if !field.is_empty() {
                    members.extend(members_of(&row, field, items, names)?);
                }
            }
        }
    }
    Ok(Set {
        name: command.required(parameter)?.to_owned(),
        position: command.position(),
        members,
        is_unsorted: command.has("UNSORTED"),
    })
}

/// Members of a line with the first, the last and the increment of their numbers.
fn generated(
    row: &mut Row<'_>,
    space: u32,
) -> Result<impl Iterator<Item = Member> + use<>, InpError> {
    let first = row.label("the first number")?;
    let last = match row.field() {
        [] => first,
        field => fields::label(field).ok_or_else(|| row.unexpected("the last number", field))?,
    };
    let step = row.integer("an increment", 1)?.unsigned_abs() as usize;
    let (low, high) = (first.min(last), first.max(last));
    if step == 0 || high - low > LARGEST_COUNT {
        return Err(row.unexpected("an increment other than 0", row.text));
    }
    let labels = (low..=high).step_by(step);
    Ok(labels.map(move |label| Member { space, label }))
}

/// Members that a field names, by a number or by a set.
fn members_of(
    row: &Row<'_>,
    field: &[u8],
    items: Items,
    names: &Names<'_>,
) -> Result<Vec<Member>, InpError> {
    if let Some(label) = fields::label(field) {
        let space = names.space;
        return Ok(vec![Member { space, label }]);
    }
    let name = text_of(field);
    names.members(items, &name).ok_or_else(|| {
        let is_name = name.starts_with(|it: char| it.is_alphabetic() || it == '_');
        match is_name {
            true => row.source.unknown(row.position, items.set(), &name),
            false => row.unexpected("a number or the name of a set", field),
        }
    })
}

/// Nodes of elements.
fn nodes_of(names: &Names<'_>, elements: &[Member]) -> Vec<Member> {
    let mut nodes = Vec::new();
    for &Member { space, label } in elements {
        let elements = &names.part_of(space).elements;
        if let Some(index) = elements.index(label) {
            let labels = elements.nodes(&elements.list[index]).iter();
            nodes.extend(labels.map(|&label| Member { space, label }));
        }
    }
    nodes
}

/// Reads a surface; `None` for one that has neither sides of elements nor nodes.
pub(super) fn read_surface(
    command: &Command<'_>,
    names: &Names<'_>,
) -> Result<Option<Surface>, InpError> {
    let name = command.required("NAME")?.to_owned();
    if command.has("COMBINE") || command.has("CROP") {
        let remedy = "write the sides of the elements out";
        return Err(command.not_carried_out("*SURFACE with COMBINE or CROP", remedy));
    }
    let items = match command.word("TYPE").as_deref() {
        None | Some("ELEMENT") => Items::Elements,
        Some("NODE") => Items::Nodes,
        Some(_) => return Ok(None),
    };
    let mut sides = Vec::new();
    for mut row in command.rows() {
        let field = row.field();
        let members = members_of(&row, field, items, names)?;
        let side = match items {
            Items::Nodes => Side::Node,
            Items::Elements => side(&mut row)?,
        };
        sides.push((row.position, side, members));
    }
    if sides.is_empty() && command.all_rows().next().is_some() {
        // A blank line stands for the outline of everything.
        sides.push((command.position(), Side::Free, names.all_elements()));
    }
    Ok(Some(Surface {
        name,
        position: command.position(),
        sides,
    }))
}

/// Surfaces of the sides on which the data lines of a `*DLOAD` press, without lines whose elements nothing defines.
pub(super) fn pressed_surfaces<'s>(
    keyword: &Keyword,
    rows: impl Iterator<Item = Row<'s>>,
    names: &Names<'_>,
) -> Vec<Surface> {
    let mut surfaces: BTreeMap<String, Surface> = BTreeMap::new();
    for (mut row, name) in rows.zip(keyword.pressed_sides()) {
        let (elements, kind) = (row.field(), text_of(row.field()));
        let members = members_of(&row, elements, Items::Elements, names);
        if let (Some(name), Some(number), Ok(members)) = (name, side_number(&kind), members) {
            let surface = surfaces.entry(name.clone()).or_insert(Surface {
                name,
                position: row.position,
                sides: Vec::new(),
            });
            surface
                .sides
                .push((row.position, Side::Number(number), members));
        }
    }
    surfaces.into_values().collect()
}

/// The side that the next field names.
fn side(row: &mut Row<'_>) -> Result<Side, InpError> {
    let field = row.field();
    let name = text_of(field).to_uppercase();
    let number = |rest: &str| rest.parse::<u8>().ok().filter(|number| *number > 0);
    let side = match name.as_str() {
        "" => Some(Side::Free),
        "SPOS" | "SNEG" | "POS" | "NEG" => Some(Side::Face),
        "END1" | "END2" => Some(Side::End),
        name => match name.split_at_checked(1) {
            Some(("S", rest)) => number(rest).map(Side::Number),
            Some(("E", rest)) => number(rest).map(Side::Edge),
            _ => None,
        },
    };
    let expected = "a side of an element (S1, S2, ..., SPOS, SNEG, E1, ...)";
    side.ok_or_else(|| row.unexpected(expected, field))
}
