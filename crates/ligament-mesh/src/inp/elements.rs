//! Elements: `*ELEMENT`, `*ELGEN` and `*ELCOPY`.

use super::element_type::{ElementType, Shape, Use};
use super::error::InpError;
use super::fields;
use super::part::{Definition, Part};
use super::source::{Command, Position, Row, Source};

/// Largest number of elements that one line may generate.
const LARGEST_COUNT: i64 = 1_000_000_000;

/// Reads elements by their nodes.
pub(super) fn read_elements(
    command: &Command<'_>,
    part: &mut Part,
    types: &mut Vec<ElementType>,
) -> Result<(), InpError> {
    let kind = type_index(command, types)?;
    let element_type = &types[usize::from(kind)];
    if command.has("OFFSET") && element_type.usage != Use::Other {
        let remedy = "write all nodes of the elements out";
        return Err(command.not_carried_out("*ELEMENT with OFFSET", remedy));
    }
    let mut labels = Vec::new();
    let mut record = Record::default();
    for mut row in command.rows() {
        if !record.is_open {
            record.begin(row.label("the number of an element")?, row.position);
        }
        record.extend(element_type, &mut row)?;
        record.is_open = record.goes_on(element_type, &row);
        if !record.is_open {
            record.check(command.source, element_type)?;
            part.elements.define(record.definition(kind));
            labels.push(record.label);
        }
    }
    if record.is_open {
        record.check(command.source, element_type)?;
    }
    name_elements(command, "ELSET", part, &labels);
    Ok(())
}

/// Adds elements to the set that a parameter names, if there is one.
fn name_elements(command: &Command<'_>, parameter: &str, part: &mut Part, labels: &[u32]) {
    let name = command.value(parameter);
    part.element_sets.extend(name, command.position(), labels);
}

/// Index of the element type of a block, which is added to those of the deck.
fn type_index(command: &Command<'_>, types: &mut Vec<ElementType>) -> Result<u16, InpError> {
    let name = command.required("TYPE")?;
    let new = ElementType::new(name).map_err(|refusal| {
        let line = command.source.line(command.position());
        InpError::refused_type(line, name.to_owned(), refusal)
    })?;
    let index = types.iter().position(|it| *it == new);
    Ok(index.unwrap_or_else(|| {
        types.push(new);
        types.len() - 1
    }) as u16)
}

/// An element whose nodes are being read, on one or more lines.
#[derive(Default)]
struct Record {
    label: u32,
    position: Position,
    nodes: Vec<u32>,
    is_open: bool,
}

impl Record {
    fn begin(&mut self, label: u32, position: Position) {
        (self.label, self.position) = (label, position);
        self.nodes.clear();
    }

    /// Adds the nodes of a line. Elements without a shape may name nodes of instances, which nothing needs.
    fn extend(&mut self, element_type: &ElementType, row: &mut Row<'_>) -> Result<(), InpError> {
        if element_type.usage == Use::Other {
            return Ok(());
        }
        let may_lack = element_type.nodes.start() < element_type.nodes.end();
        while let Some(field) = row.fields.next() {
            match fields::label(field) {
                Some(node) => self.nodes.push(node),
                None if field.is_empty() && row.fields.clone().next().is_none() => {}
                None if may_lack && [&b""[..], b"0"].contains(&field) => {}
                None => return Err(row.unexpected("the number of a node", field)),
            }
        }
        Ok(())
    }

    /// Whether the nodes go on in the next line.
    fn goes_on(&self, element_type: &ElementType, row: &Row<'_>) -> bool {
        let (fewest, most) = (*element_type.nodes.start(), *element_type.nodes.end());
        let n = self.nodes.len();
        match element_type.shape {
            None => row.goes_on(),
            Some(Shape::Edge) => n < fewest,
            Some(_) => n < fewest || (n < most && row.goes_on()),
        }
    }

    fn check(&self, source: &Source<'_>, element_type: &ElementType) -> Result<(), InpError> {
        let n = self.nodes.len();
        if element_type.shape.is_none() || element_type.nodes.contains(&n) {
            return Ok(());
        }
        Err(InpError::WrongNumberOfNodes {
            line: source.line(self.position),
            element: self.label,
            kind: element_type.name.clone(),
            expected: *element_type.nodes.start(),
            found: n,
        })
    }

    fn definition(&self, kind: u16) -> Definition<'_> {
        Definition {
            label: self.label,
            position: self.position,
            kind,
            is_reflected: false,
            nodes: &self.nodes,
        }
    }
}

/// Generates elements from others, in rows, columns and layers.
pub(super) fn generate(command: &Command<'_>, part: &mut Part) -> Result<(), InpError> {
    let mut labels = Vec::new();
    for mut row in command.rows() {
        let master = row.label("the number of an element")?;
        let mut direction = || -> Result<[i64; 3], InpError> {
            let count = row.integer("a number of elements", 1)?;
            let nodes = row.integer("an increment", 1)?;
            Ok([count, nodes, row.integer("an increment", 1)?])
        };
        let directions = [direction()?, direction()?, direction()?];
        let counts = directions.map(|[count, ..]| count);
        let product = counts.iter().try_fold(1_i64, |product, count| {
            let product = product.checked_mul(*count).filter(|it| *it > 0);
            product.filter(|it| *it <= LARGEST_COUNT)
        });
        let count =
            product.ok_or_else(|| row.unexpected("numbers of elements of at least 1", row.text))?;
        for place in 0..count {
            let places = [
                place % counts[0],
                place / counts[0] % counts[1],
                place / counts[0] / counts[1],
            ];
            let by = |which: usize| -> i64 {
                let steps = places.iter().zip(&directions);
                steps
                    .map(|(place, direction)| place * direction[which])
                    .sum()
            };
            let copy = Copy {
                source: command.source,
                position: row.position,
                nodes: by(1),
                element: by(2),
                is_reflected: false,
            };
            labels.push(copy.define(part, master)?);
        }
    }
    name_elements(command, "ELSET", part, &labels);
    Ok(())
}

/// Copies the elements of a set, with other nodes.
pub(super) fn copy(command: &Command<'_>, part: &mut Part) -> Result<(), InpError> {
    let name = command.required("OLD SET")?;
    let set = part.element_sets.get(name);
    let set = set.ok_or_else(|| command.unknown("element set", name))?;
    let copy = Copy {
        source: command.source,
        position: command.position(),
        nodes: command.integer("SHIFT NODES")?,
        element: command.integer("ELEMENT SHIFT")?,
        is_reflected: command.has("REFLECT"),
    };
    let mut labels = Vec::new();
    for label in set.labels_in_order() {
        labels.push(copy.define(part, label)?);
    }
    name_elements(command, "NEW SET", part, &labels);
    Ok(())
}

/// Copies of elements, with what is added to their numbers and those of their nodes.
struct Copy<'a> {
    source: &'a Source<'a>,
    position: Position,
    nodes: i64,
    element: i64,
    is_reflected: bool,
}

impl Copy<'_> {
    /// Defines the copy of an element, and returns its number.
    fn define(&self, part: &mut Part, label: u32) -> Result<u32, InpError> {
        let index = part.elements.index(label);
        let index = index.ok_or_else(|| InpError::UnknownLabel {
            line: self.source.line(self.position),
            what: "element",
            label,
        })?;
        let shifted = |label: u32, by: i64| self.source.shifted(self.position, label, by);
        let new = shifted(label, self.element)?;
        if new == label && self.nodes == 0 {
            return Ok(label);
        }
        let master = part.elements.list[index];
        let nodes = part.elements.nodes(&master).iter();
        let nodes: Result<Vec<u32>, InpError> = nodes.map(|it| shifted(*it, self.nodes)).collect();
        part.elements.define(Definition {
            label: new,
            position: self.position,
            kind: master.kind,
            is_reflected: master.is_reflected != self.is_reflected,
            nodes: &nodes?,
        });
        Ok(new)
    }
}
