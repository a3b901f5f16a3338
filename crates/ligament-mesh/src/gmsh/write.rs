//! Files of format 4.1, ASCII.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write};

use crate::mesh::Mesh;

/// The text of a Gmsh file (4.1, ASCII) of a mesh, from which [`parse`](super::parse) makes an equal mesh: nodes with their
/// tags and all digits, cells in their order, and groups with their names, numbers and dimensions, also where an element is
/// in several.
///
/// Elements that are in the same groups make an entity, as the format asks for. Fields and remarks are not written.
///
/// # Panics
///
/// If a cell or a group has a node, or a group a cell, that the mesh does not have.
pub fn write(mesh: &Mesh) -> String {
    let mut text = String::new();
    let entities = Entities::from_mesh(mesh);
    // Writing to a string cannot fail.
    let _ = write_head(&mut text, mesh)
        .and_then(|()| entities.write(&mut text, mesh))
        .and_then(|()| write_nodes(&mut text, mesh))
        .and_then(|()| entities.write_elements(&mut text, mesh));
    text
}

/// Numbers of the groups that an element is in.
type Memberships = BTreeSet<i32>;

/// An element by its nodes, and the place of its entity among those of its dimension.
struct Element {
    nodes: Vec<u32>,
    entity: usize,
}

/// Elements and entities of the dimensions 0, 1 and 2.
struct Entities {
    /// Groups of each entity.
    groups: [Vec<Memberships>; 3],
    elements: [Vec<Element>; 3],
}

impl Entities {
    fn from_mesh(mesh: &Mesh) -> Self {
        let mut points: BTreeMap<u32, Memberships> = BTreeMap::new();
        let mut edges: BTreeMap<[u32; 2], Memberships> = BTreeMap::new();
        let mut cells = vec![Memberships::new(); mesh.cells.len()];
        for group in &mesh.groups {
            let number = group.number;
            match group.dimension {
                0 => {
                    for &node in &group.nodes {
                        points.entry(node).or_default().insert(number);
                    }
                }
                1 => {
                    for &edge in &group.edges {
                        edges.entry(edge).or_default().insert(number);
                    }
                }
                _ => {
                    for &cell in &group.cells {
                        cells[cell as usize].insert(number);
                    }
                }
            }
        }
        let mut entities = Self {
            groups: Default::default(),
            elements: Default::default(),
        };
        // An entity of dimension 0 is one point.
        for (node, groups) in points {
            let entity = entities.groups[0].len();
            entities.groups[0].push(groups);
            let nodes = vec![node];
            entities.elements[0].push(Element { nodes, entity });
        }
        let edges = edges.into_iter().map(|(edge, it)| (edge.to_vec(), it));
        entities.gather(1, edges);
        let corners = mesh.cells.iter().map(|cell| cell.corners().to_vec());
        entities.gather(2, corners.zip(cells));
        entities
    }

    /// Gives elements of the same groups the same entity.
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

    fn write(&self, text: &mut String, mesh: &Mesh) -> fmt::Result {
        let [points, curves, surfaces] = self.groups.each_ref().map(Vec::len);
        writeln!(text, "$Entities\n{points} {curves} {surfaces} 0")?;
        for (dimension, groups) in self.groups.iter().enumerate() {
            let mut boxes = vec![[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; groups.len()];
            for element in &self.elements[dimension] {
                let [low, high] = &mut boxes[element.entity];
                for &node in &element.nodes {
                    for (axis, value) in mesh.positions[node as usize].into_iter().enumerate() {
                        low[axis] = low[axis].min(value);
                        high[axis] = high[axis].max(value);
                    }
                }
            }
            for (place, (groups, [low, high])) in groups.iter().zip(boxes).enumerate() {
                write!(text, "{} {:?} {:?} 0 ", place + 1, low[0], low[1])?;
                if dimension > 0 {
                    write!(text, "{:?} {:?} 0 ", high[0], high[1])?;
                }
                write!(text, "{}", groups.len())?;
                for group in groups {
                    write!(text, " {group}")?;
                }
                // What bounds curves and surfaces is not known.
                writeln!(text, "{}", if dimension > 0 { " 0" } else { "" })?;
            }
        }
        writeln!(text, "$EndEntities")
    }

    fn write_elements(&self, text: &mut String, mesh: &Mesh) -> fmt::Result {
        let alike =
            |a: &Element, b: &Element| a.entity == b.entity && a.nodes.len() == b.nodes.len();
        let blocks = |dimension: usize| self.elements[dimension].chunk_by(alike);
        let n_blocks: usize = (0..3).map(|dimension| blocks(dimension).count()).sum();
        let total: usize = self.elements.iter().map(Vec::len).sum();
        writeln!(text, "$Elements\n{n_blocks} {total} 1 {total}")?;
        let mut number = 0;
        for dimension in 0..3 {
            for block in blocks(dimension) {
                let code = match (dimension, block[0].nodes.len()) {
                    (0, _) => 15,
                    (1, _) => 1,
                    (_, 3) => 2,
                    _ => 3,
                };
                let entity = block[0].entity + 1;
                writeln!(text, "{dimension} {entity} {code} {}", block.len())?;
                for element in block {
                    number += 1;
                    write!(text, "{number}")?;
                    for &node in &element.nodes {
                        write!(text, " {}", mesh.node_tags[node as usize])?;
                    }
                    writeln!(text)?;
                }
            }
        }
        writeln!(text, "$EndElements")
    }
}

fn write_head(text: &mut String, mesh: &Mesh) -> fmt::Result {
    writeln!(text, "$MeshFormat\n4.1 0 8\n$EndMeshFormat")?;
    if mesh.groups.is_empty() {
        return Ok(());
    }
    writeln!(text, "$PhysicalNames\n{}", mesh.groups.len())?;
    for group in &mesh.groups {
        let (dimension, number, name) = (group.dimension, group.number, &group.name);
        writeln!(text, "{dimension} {number} \"{name}\"")?;
    }
    writeln!(text, "$EndPhysicalNames")
}

/// One block, on the first surface: what the nodes of a mesh lie on is not known.
fn write_nodes(text: &mut String, mesh: &Mesh) -> fmt::Result {
    let count = mesh.node_tags.len();
    let least = mesh.node_tags.iter().min().unwrap_or(&0);
    let largest = mesh.node_tags.iter().max().unwrap_or(&0);
    writeln!(text, "$Nodes\n1 {count} {least} {largest}\n2 1 0 {count}")?;
    for tag in &mesh.node_tags {
        writeln!(text, "{tag}")?;
    }
    for [x, y] in &mesh.positions {
        writeln!(text, "{x:?} {y:?} 0")?;
    }
    writeln!(text, "$EndNodes")
}
