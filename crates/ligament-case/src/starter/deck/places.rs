//! Nodes and sides that a deck names, and groups of the mesh for them.

use std::cell::OnceCell;
use std::collections::HashMap;

use ligament_mesh::inp::{Deck, Scope};
use ligament_mesh::{AnyMesh, Group, Mesh, MeshCell};

use super::super::text::quoted;

/// Nodes that a field of a deck names.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Nodes {
    /// Nodes of the mesh, ascending.
    pub(super) inside: Vec<u32>,
    /// Numbers of nodes outside of the mesh.
    pub(super) outside: Vec<u64>,
}

/// Places of a deck, with the groups that they add to its mesh.
pub(super) struct Places<'a> {
    pub(super) deck: &'a Deck,
    /// Nodes of the mesh by their numbers.
    nodes: HashMap<u64, u32>,
    /// Groups added to the mesh for places of the case.
    pub(super) added: Vec<Group>,
    volumes: OnceCell<Vec<f64>>,
}

impl<'a> Places<'a> {
    pub(super) fn new(deck: &'a Deck) -> Self {
        let tags = match &deck.mesh {
            AnyMesh::Plane(mesh) => &mesh.node_tags,
            AnyMesh::Solid(mesh) => &mesh.node_tags,
        };
        Self {
            deck,
            nodes: (tags.iter().copied()).zip(0..).collect(),
            added: Vec::new(),
            volumes: OnceCell::new(),
        }
    }

    /// Number of dimensions of the body.
    pub(super) fn dimensions(&self) -> u8 {
        match self.deck.mesh {
            AnyMesh::Plane(_) => 2,
            AnyMesh::Solid(_) => 3,
        }
    }

    /// Number in the mesh of a node given by its number, with or without the name of its instance.
    pub(super) fn number(&self, field: &str, scope: &Scope) -> Option<u64> {
        let (instance, label) = match (field.rsplit_once('.'), scope) {
            (Some((before, label)), _) => (before.rsplit('.').next(), label),
            (None, Scope::Instance(name)) => (Some(name.as_str()), field),
            (None, _) => (None, field),
        };
        let label: u64 = label.parse().ok()?;
        let Some(instance) = instance else {
            return Some(label);
        };
        let mut instances = self.deck.instances.iter();
        let instance = instances.find(|it| it.name.eq_ignore_ascii_case(instance))?;
        Some(instance.shift + label)
    }

    /// Possible names of a set or surface in the mesh.
    fn names(&self, field: &str, scope: &Scope) -> Vec<String> {
        let instances = self.deck.instances.iter();
        let prefixes: Vec<&str> = match scope {
            Scope::Instance(name) => vec![name],
            Scope::Part(part) if !self.deck.instances.is_empty() => {
                let of_part = instances.filter(|it| it.part.eq_ignore_ascii_case(part));
                of_part.map(|it| it.name.as_str()).collect()
            }
            _ => {
                // Names of an assembly may begin with its own.
                let dots = field.match_indices('.').map(|(dot, _)| &field[dot + 1..]);
                return std::iter::once(field)
                    .chain(dots)
                    .map(str::to_owned)
                    .collect();
            }
        };
        prefixes.iter().map(|it| format!("{it}.{field}")).collect()
    }

    /// Nodes that a field names by a number or a set.
    pub(super) fn find(&self, field: &str, scope: &Scope) -> Nodes {
        let mut found = Nodes::default();
        if let Some(number) = self.number(field, scope) {
            match self.nodes.get(&number) {
                Some(node) => found.inside.push(*node),
                None => found.outside.push(number),
            }
            return found;
        }
        for name in self.names(field, scope) {
            let groups = self.deck.groups_named(&name).filter(|it| it.dimension == 0);
            found.inside.extend(groups.flat_map(|it| &it.nodes));
            let outside = self.deck.outside.iter();
            let outside = outside.filter(|(set, _)| set.eq_ignore_ascii_case(&name));
            found.outside.extend(outside.flat_map(|(_, nodes)| nodes));
            if found != Nodes::default() {
                break;
            }
        }
        found
    }

    /// Groups of a dimension that a field names, one for each instance.
    pub(super) fn groups(&self, field: &str, scope: &Scope, dimension: u8) -> Vec<Group> {
        let names = self.names(field, scope);
        let groups = names.iter().flat_map(|name| self.deck.groups_named(name));
        groups
            .filter(|it| it.dimension == dimension)
            .cloned()
            .collect()
    }

    /// Nodes at the ends of the edge whose middle is a node of second order.
    pub(super) fn ends(&self, number: u64) -> Option<[u32; 2]> {
        let [a, b] = self.deck.midpoints.get(&number)?;
        Some([*self.nodes.get(a)?, *self.nodes.get(b)?])
    }

    /// Nodes of everything that a field names: a set of nodes or elements, or a surface.
    pub(super) fn nodes_of(&self, field: &str, scope: &Scope) -> Vec<u32> {
        let groups = (0..=3).flat_map(|dimension| self.groups(field, scope, dimension));
        let mut nodes: Vec<u32> = groups.flat_map(|it| it.nodes).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Line of a case with a group; a group with another name is added where the name has further members.
    pub(super) fn line(&mut self, mut group: Group) -> String {
        let all = || self.deck.mesh.groups().iter().chain(&self.added);
        let is_same = |it: &&Group| {
            let shape = |it: &Group| (it.dimension, it.nodes.len());
            shape(it) == shape(&group)
                && (&it.nodes, &it.edges, &it.faces, &it.cells)
                    == (&group.nodes, &group.edges, &group.faces, &group.cells)
        };
        let is_alone = |it: &&Group| all().filter(|other| other.name == it.name).count() == 1;
        let same = || all().filter(|it| is_same(it) && is_alone(it));
        let by_name = same().find(|it| it.name.eq_ignore_ascii_case(&group.name));
        if let Some(same) = by_name.or_else(|| same().next()) {
            return format!("group = {}", quoted(&same.name));
        }
        let kind = ["nodes", "lines", "faces", "cells"][usize::from(group.dimension.min(3))];
        let is_new = |name: &str| all().all(|it| !it.name.eq_ignore_ascii_case(name));
        if !is_new(&group.name) {
            let name = format!("{}-{kind}", group.name);
            let mut numbered = (2..).map(|number| format!("{name}-{number}"));
            group.name = match is_new(&name) {
                true => name,
                false => numbered.find(|it| is_new(it)).unwrap_or_default(),
            };
        }
        let of_dimension = all().filter(|it| it.dimension == group.dimension);
        group.number = of_dimension.map(|it| it.number).max().unwrap_or(0) + 1;
        let line = format!("group = {}", quoted(&group.name));
        self.added.push(group);
        line
    }

    /// Line of a case with a group of nodes (ascending), with a name for them.
    pub(super) fn line_of_nodes(&mut self, name: &str, nodes: Vec<u32>) -> String {
        self.line(Group {
            name: name.to_owned(),
            nodes,
            ..Group::default()
        })
    }

    /// Volumes of the points that the mesh becomes, in units of the deck, in the plane per thickness.
    pub(super) fn volumes(&self) -> &[f64] {
        self.volumes.get_or_init(|| match &self.deck.mesh {
            AnyMesh::Plane(mesh) => shares(mesh),
            AnyMesh::Solid(mesh) => shares(mesh),
        })
    }

    /// Coordinates of a node in units of the deck.
    pub(super) fn position(&self, node: u32) -> &[f64] {
        match &self.deck.mesh {
            AnyMesh::Plane(mesh) => &mesh.positions[node as usize],
            AnyMesh::Solid(mesh) => &mesh.positions[node as usize],
        }
    }
}

fn shares<const D: usize, C: MeshCell<D>>(mesh: &Mesh<D, C>) -> Vec<f64> {
    let mut volumes = vec![0.0; mesh.positions.len()];
    for (node, share) in (mesh.cells.iter()).flat_map(|cell| cell.shares(&mesh.positions)) {
        volumes[node as usize] += share;
    }
    volumes
}
