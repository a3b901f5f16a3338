//! Nodes, elements and sets of a part, by their numbers and names.

use std::collections::{BTreeMap, HashMap};

use super::geometry::{Frame, Vector};
use super::source::Position;

/// Node of a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) label: u32,
    pub(super) position: Position,
    /// Coordinates, m.
    pub(super) at: Vector,
}

/// Element of a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element {
    pub(super) label: u32,
    pub(super) position: Position,
    /// Index of the element type.
    pub(super) kind: u16,
    /// Whether the element is a reflected copy, whose sides have no known numbers.
    pub(super) is_reflected: bool,
    first_node: usize,
    n_nodes: u8,
}

/// Indices of nodes or elements by their numbers.
#[derive(Debug, Clone, Default)]
struct Indices {
    /// Index of each number, or [`NONE`]; for numbers without large gaps.
    table: Vec<u32>,
    /// Indices of large numbers.
    map: HashMap<u32, u32>,
}

const NONE: u32 = u32::MAX;

/// Largest number of table entries per node or element, for tables that are not small.
const PLACES: usize = 4;

/// Number of entries of a small table.
const SMALL: usize = 1 << 16;

impl Indices {
    fn get(&self, label: u32) -> Option<usize> {
        match self.table.get(label as usize) {
            Some(&index) if index != NONE => Some(index as usize),
            _ => self.map.get(&label).map(|index| *index as usize),
        }
    }

    /// Sets the index of a number that has none, as the `count`-th one.
    fn insert(&mut self, label: u32, count: usize) {
        let place = label as usize;
        if place >= self.table.len() && place < SMALL.max(PLACES * count) {
            let size = (2 * self.table.len()).max(place + 1);
            self.table.resize(size, NONE);
        }
        match self.table.get_mut(place) {
            Some(entry) => *entry = count as u32,
            None => {
                self.map.insert(label, count as u32);
            }
        }
    }
}

/// Nodes by their numbers.
#[derive(Debug, Clone, Default)]
pub(super) struct Nodes {
    pub(super) list: Vec<Node>,
    pub(super) redefined: Redefined,
    indices: Indices,
}

impl Nodes {
    pub(super) fn index(&self, label: u32) -> Option<usize> {
        self.indices.get(label)
    }

    pub(super) fn at(&self, label: u32) -> Option<Vector> {
        Some(self.list[self.index(label)?].at)
    }

    /// Defines a node; a later definition replaces an earlier one.
    pub(super) fn define(&mut self, node: Node) {
        match self.index(node.label) {
            Some(index) => {
                let before = std::mem::replace(&mut self.list[index], node);
                if before.at != node.at {
                    self.redefined.count(node.position);
                }
            }
            None => {
                self.indices.insert(node.label, self.list.len());
                self.list.push(node);
            }
        }
    }
}

/// Number of definitions that replaced different ones, and the place of the first.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Redefined {
    pub(super) first: Option<Position>,
    pub(super) count: usize,
}

impl Redefined {
    fn count(&mut self, position: Position) {
        self.first.get_or_insert(position);
        self.count += 1;
    }
}

/// Elements by their numbers.
#[derive(Debug, Clone, Default)]
pub(super) struct Elements {
    pub(super) list: Vec<Element>,
    pub(super) redefined: Redefined,
    /// Numbers of the nodes of all elements, one after the other.
    nodes: Vec<u32>,
    indices: Indices,
}

impl Elements {
    pub(super) fn index(&self, label: u32) -> Option<usize> {
        self.indices.get(label)
    }

    /// Numbers of the nodes of an element.
    pub(super) fn nodes(&self, element: &Element) -> &[u32] {
        &self.nodes[element.first_node..element.first_node + usize::from(element.n_nodes)]
    }

    /// Defines an element; a later definition replaces an earlier one.
    pub(super) fn define(&mut self, defined: Definition<'_>) {
        let element = Element {
            label: defined.label,
            position: defined.position,
            kind: defined.kind,
            is_reflected: defined.is_reflected,
            first_node: self.nodes.len(),
            n_nodes: defined.nodes.len() as u8,
        };
        let index = self.index(defined.label);
        if let Some(index) = index {
            let before = self.list[index];
            if before.kind == defined.kind && self.nodes(&before) == defined.nodes {
                return;
            }
            self.list[index] = element;
            self.redefined.count(defined.position);
        } else {
            self.indices.insert(defined.label, self.list.len());
            self.list.push(element);
        }
        self.nodes.extend_from_slice(defined.nodes);
    }
}

/// Definition of an element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Definition<'a> {
    pub(super) label: u32,
    pub(super) position: Position,
    /// Index of the element type.
    pub(super) kind: u16,
    pub(super) is_reflected: bool,
    /// Numbers of the nodes.
    pub(super) nodes: &'a [u32],
}

/// A node or element of a set: its number in a space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Member {
    /// Zero for the part of the set itself, n + 1 for the instance n of the model.
    pub(super) space: u32,
    pub(super) label: u32,
}

/// A set of nodes or elements.
#[derive(Debug, Clone)]
pub(super) struct Set {
    pub(super) name: String,
    pub(super) position: Position,
    pub(super) members: Vec<Member>,
    /// Whether the order of the members counts.
    pub(super) is_unsorted: bool,
}

impl Set {
    /// Numbers of the members in their order: as given for an unsorted set, else ascending, each once.
    pub(super) fn labels_in_order(&self) -> Vec<u32> {
        let mut labels: Vec<u32> = self.members.iter().map(|it| it.label).collect();
        if !self.is_unsorted {
            labels.sort_unstable();
            labels.dedup();
        }
        labels
    }
}

/// Sets of one kind, found by their names without regard to case.
#[derive(Debug, Clone, Default)]
pub(super) struct Sets {
    pub(super) list: Vec<Set>,
    by_name: BTreeMap<String, usize>,
}

impl Sets {
    pub(super) fn get(&self, name: &str) -> Option<&Set> {
        let index = self.by_name.get(&name.to_uppercase())?;
        Some(&self.list[*index])
    }

    /// The set of a name, begun at a position if there is none.
    pub(super) fn begin(&mut self, name: &str, position: Position) -> &mut Set {
        let next = self.list.len();
        let index = *self.by_name.entry(name.to_uppercase()).or_insert(next);
        if index == next {
            self.list.push(Set {
                name: name.to_owned(),
                position,
                members: Vec::new(),
                is_unsorted: false,
            });
        }
        &mut self.list[index]
    }

    /// Adds numbers of the part itself to the set of a name, if there is a name.
    pub(super) fn extend(&mut self, name: Option<&str>, position: Position, labels: &[u32]) {
        let Some(name) = name else { return };
        let members = labels.iter().map(|label| Member {
            space: 0,
            label: *label,
        });
        self.begin(name, position).members.extend(members);
    }
}

/// Nodes or elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Items {
    Nodes,
    Elements,
}

impl Items {
    /// Name of a set of these items.
    pub(super) fn set(self) -> &'static str {
        match self {
            Items::Nodes => "node set",
            Items::Elements => "element set",
        }
    }
}

/// Sides of elements that a line of a surface names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// A side by its number, counted from 1.
    Number(u8),
    /// An edge of a shell by its number, counted from 1.
    Edge(u8),
    /// The face of a shell, from one of its two sides.
    Face,
    /// An end of a beam.
    End,
    /// All sides on the outline of the body.
    Free,
    /// The elements themselves are nodes.
    Node,
}

/// A surface: lines with elements and the sides of them.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    pub(super) name: String,
    pub(super) position: Position,
    pub(super) sides: Vec<(Position, Side, Vec<Member>)>,
}

/// Nodes, elements and sets with their own numbers and names: a part, an instance or the model.
#[derive(Debug, Clone, Default)]
pub(super) struct Part {
    pub(super) name: String,
    pub(super) position: Position,
    pub(super) nodes: Nodes,
    pub(super) elements: Elements,
    pub(super) node_sets: Sets,
    pub(super) element_sets: Sets,
    pub(super) surfaces: Vec<Surface>,
    /// Local system of the coordinates that follow.
    pub(super) frame: Option<Frame>,
}

impl Part {
    /// Members of a set.
    pub(super) fn members(&self, items: Items, name: &str) -> Option<Vec<Member>> {
        let sets = match items {
            Items::Nodes => &self.node_sets,
            Items::Elements => &self.element_sets,
        };
        sets.get(name).map(|set| set.members.clone())
    }

    /// A copy in which no definition counts as replaced.
    pub(super) fn without_remarks(&self) -> Self {
        let mut copy = self.clone();
        copy.nodes.redefined = Redefined::default();
        copy.elements.redefined = Redefined::default();
        copy
    }
}
