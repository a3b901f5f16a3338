//! Writing of files of format 4.1, ASCII.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write};

use crate::cell::MeshCell;
use crate::mesh::{AnyMesh, Group, Mesh};

/// Text of a Gmsh file (4.1, ASCII) of a planar or solid mesh, from which [`parse_any`](super::parse_any) makes an equal mesh: nodes with
/// their tags and all digits, cells in their order, and groups with their names, numbers and dimensions, also for elements in several
/// groups.
///
/// Elements in the same groups form an entity, as the format requires. Fields and remarks are not written.
///
/// # Panics
///
/// Panics if a cell, a face or a group has a node, or a group a cell, that the mesh does not have.
pub fn write<const D: usize, C: MeshCell<D>>(mesh: &Mesh<D, C>) -> String {
    let raised = |position: &[f64; D]| [0, 1, 2].map(|axis| *position.get(axis).unwrap_or(&0.0));
    let positions: Vec<[f64; 3]> = mesh.positions.iter().map(raised).collect();
    let cells: Vec<&[u32]> = mesh.cells.iter().map(C::corners).collect();
    text_of(&Source {
        dimension: D,
        node_tags: &mesh.node_tags,
        positions: &positions,
        cells: &cells,
        groups: &mesh.groups,
    })
}

/// Text of a Gmsh file like that of [`write()`].
///
/// # Panics
///
/// Panics as [`write()`] does.
pub fn write_any(mesh: &AnyMesh) -> String {
    match mesh {
        AnyMesh::Plane(mesh) => write(mesh),
        AnyMesh::Solid(mesh) => write(mesh),
    }
}

/// A mesh to be written.
struct Source<'a> {
    /// Dimension of the cells.
    dimension: usize,
    node_tags: &'a [u64],
    positions: &'a [[f64; 3]],
    /// Corners of the cells.
    cells: &'a [&'a [u32]],
    groups: &'a [Group],
}

fn text_of(source: &Source<'_>) -> String {
    let mut text = String::new();
    let entities = Entities::new(source);
    // Writing to a string cannot fail.
    let _ = write_head(&mut text, source.groups)
        .and_then(|()| entities.write(&mut text, source.positions))
        .and_then(|()| write_nodes(&mut text, source))
        .and_then(|()| entities.write_elements(&mut text, source.node_tags));
    text
}

/// Numbers of the groups of an element.
type Memberships = BTreeSet<i32>;

/// An element, given by its nodes, and the index of its entity among the entities of its dimension.
struct Element {
    nodes: Vec<u32>,
    entity: usize,
}

/// Elements and entities of the dimensions 0, 1, 2 and 3.
struct Entities {
    /// Groups of each entity.
    groups: [Vec<Memberships>; 4],
    elements: [Vec<Element>; 4],
}

impl Entities {
    fn new(source: &Source<'_>) -> Self {
        let mut parts: [BTreeMap<Vec<u32>, Memberships>; 3] = Default::default();
        let mut cells = vec![Memberships::new(); source.cells.len()];
        for group in source.groups {
            let mut add = |dimension: usize, nodes: &[u32]| {
                let memberships = parts[dimension].entry(nodes.to_vec()).or_default();
                memberships.insert(group.number);
            };
            match usize::from(group.dimension) {
                0 => group.nodes.iter().for_each(|node| add(0, &[*node])),
                1 => group.edges.iter().for_each(|edge| add(1, edge)),
                2 if source.dimension == 3 => {
                    group.faces.iter().for_each(|face| add(2, face.corners()));
                }
                _ => {
                    for &cell in &group.cells {
                        cells[cell as usize].insert(group.number);
                    }
                }
            }
        }
        let mut entities = Self {
            groups: Default::default(),
            elements: Default::default(),
        };
        let [points, edges, faces] = parts;
        // An entity of dimension 0 has one point.
        for (nodes, groups) in points {
            let entity = entities.groups[0].len();
            entities.groups[0].push(groups);
            entities.elements[0].push(Element { nodes, entity });
        }
        entities.gather(1, edges.into_iter());
        entities.gather(2, faces.into_iter());
        let corners = source.cells.iter().map(|corners| corners.to_vec());
        entities.gather(source.dimension, corners.zip(cells));
        entities
    }

    /// Assigns elements in the same groups to the same entity.
    fn gather(
        &mut self,
        dimension: usize,
        elements: impl Iterator<Item = (Vec<u32>, Memberships)>,
    ) {
        let mut places: BTreeMap<Memberships, usize> = BTreeMap::new();
        for (nodes, groups) in elements {
            let entity = *places.entry(groups).or_insert_with_key(|groups| {
                self.groups[dimension].push(groups.clone());
                self.groups[dimension].len() - 1
            });
            self.elements[dimension].push(Element { nodes, entity });
        }
    }

    fn write(&self, text: &mut String, positions: &[[f64; 3]]) -> fmt::Result {
        let [points, curves, surfaces, volumes] = self.groups.each_ref().map(Vec::len);
        writeln!(text, "$Entities\n{points} {curves} {surfaces} {volumes}")?;
        for (dimension, groups) in self.groups.iter().enumerate() {
            let mut boxes = vec![[[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]; groups.len()];
            for element in &self.elements[dimension] {
                let [low, high] = &mut boxes[element.entity];
                for &node in &element.nodes {
                    for (axis, value) in positions[node as usize].into_iter().enumerate() {
                        low[axis] = low[axis].min(value);
                        high[axis] = high[axis].max(value);
                    }
                }
            }
            for (place, (groups, [low, high])) in groups.iter().zip(boxes).enumerate() {
                write!(text, "{} {} ", place + 1, Position(low))?;
                if dimension > 0 {
                    write!(text, "{} ", Position(high))?;
                }
                write!(text, "{}", groups.len())?;
                for group in groups {
                    write!(text, " {group}")?;
                }
                // Boundaries of curves, surfaces and volumes are not known.
                writeln!(text, "{}", if dimension > 0 { " 0" } else { "" })?;
            }
        }
        writeln!(text, "$EndEntities")
    }

    fn write_elements(&self, text: &mut String, node_tags: &[u64]) -> fmt::Result {
        let alike =
            |a: &Element, b: &Element| a.entity == b.entity && a.nodes.len() == b.nodes.len();
        let blocks = |dimension: usize| self.elements[dimension].chunk_by(alike);
        let n_blocks: usize = (0..4).map(|dimension| blocks(dimension).count()).sum();
        let total: usize = self.elements.iter().map(Vec::len).sum();
        writeln!(text, "$Elements\n{n_blocks} {total} 1 {total}")?;
        let mut number = 0;
        for dimension in 0..4 {
            for block in blocks(dimension) {
                let code = match (dimension, block[0].nodes.len()) {
                    (0, _) => 15,
                    (1, _) => 1,
                    (2, 3) => 2,
                    (2, _) => 3,
                    (_, 4) => 4,
                    (_, 5) => 7,
                    (_, 6) => 6,
                    (_, _) => 5,
                };
                let entity = block[0].entity + 1;
                writeln!(text, "{dimension} {entity} {code} {}", block.len())?;
                for element in block {
                    number += 1;
                    write!(text, "{number}")?;
                    for &node in &element.nodes {
                        write!(text, " {}", node_tags[node as usize])?;
                    }
                    writeln!(text)?;
                }
            }
        }
        writeln!(text, "$EndElements")
    }
}

/// A position with all digits; a height of zero is shortened.
struct Position([f64; 3]);

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            [x, y, 0.0] => write!(f, "{x:?} {y:?} 0"),
            [x, y, z] => write!(f, "{x:?} {y:?} {z:?}"),
        }
    }
}

fn write_head(text: &mut String, groups: &[Group]) -> fmt::Result {
    writeln!(text, "$MeshFormat\n4.1 0 8\n$EndMeshFormat")?;
    if groups.is_empty() {
        return Ok(());
    }
    writeln!(text, "$PhysicalNames\n{}", groups.len())?;
    for group in groups {
        let (dimension, number, name) = (group.dimension, group.number, &group.name);
        writeln!(text, "{dimension} {number} \"{name}\"")?;
    }
    writeln!(text, "$EndPhysicalNames")
}

/// Writes the nodes as one block, on the first entity of the dimension of the cells: the entities of the nodes are not known.
fn write_nodes(text: &mut String, source: &Source<'_>) -> fmt::Result {
    let (count, dimension) = (source.node_tags.len(), source.dimension);
    let least = source.node_tags.iter().min().unwrap_or(&0);
    let largest = source.node_tags.iter().max().unwrap_or(&0);
    writeln!(
        text,
        "$Nodes\n1 {count} {least} {largest}\n{dimension} 1 0 {count}"
    )?;
    for tag in source.node_tags {
        writeln!(text, "{tag}")?;
    }
    for position in source.positions {
        writeln!(text, "{}", Position(*position))?;
    }
    writeln!(text, "$EndNodes")
}
