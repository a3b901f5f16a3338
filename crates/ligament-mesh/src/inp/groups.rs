//! Groups of the mesh from sets and surfaces.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use super::body::{Body, INNER, NO_CELL, Numbers, UNUSED};
use super::element_type::Use;
use super::error::InpError;
use super::part::{Element, Elements, Member, Nodes, Part, Set, Side, Surface};
use super::shape::without_repetition;
use super::source::{Position, Source};
use crate::cell::{Cell, MeshCell, ascending};
use crate::mesh::{AnyMesh, Group, SolidMesh};
use crate::remark::{DeckRemark, Remark};
use crate::solid::Faces;

/// Groups being made of the sets and surfaces of a model.
pub(super) struct Groups<'a> {
    source: &'a Source<'a>,
    body: &'a Body<'a>,
    numbers: &'a Numbers,
    outline: Outline<'a>,
    groups: Vec<Group>,
    remarks: Vec<Remark>,
    /// Whether each element is an edge or face in a group, by spaces.
    in_groups: Vec<Vec<bool>>,
    /// Nodes of sets that are no nodes of the mesh.
    outside: BTreeMap<String, Vec<u64>>,
}

/// Members of a set or surface, by their dimension, and the number of those that were left out.
#[derive(Default)]
struct Draft {
    groups: [Group; 4],
    undefined: usize,
    beside: usize,
    /// Numbers of nodes that are no nodes of the mesh.
    outside: Vec<u64>,
}

impl<'a> Groups<'a> {
    pub(super) fn new(
        source: &'a Source<'a>,
        body: &'a Body<'a>,
        numbers: &'a Numbers,
        mesh: &'a AnyMesh,
    ) -> Self {
        let in_groups = numbers.cells.iter().map(|cells| vec![false; cells.len()]);
        Self {
            source,
            body,
            numbers,
            outline: Outline::new(mesh),
            groups: Vec::new(),
            remarks: Vec::new(),
            in_groups: in_groups.collect(),
            outside: BTreeMap::new(),
        }
    }

    /// Makes groups of all sets and surfaces: those of instances first, then those of the model.
    pub(super) fn collect(&mut self) -> Result<(), InpError> {
        for home in (1..self.body.spaces.len()).chain([0]) {
            let part = self.body.spaces[home].part;
            for set in &part.node_sets.list {
                let draft = self.nodes(home, &set.members);
                self.add_draft(home, &set.name, set.position, draft);
            }
            for set in &part.element_sets.list {
                let draft = self.elements(home, set);
                self.add_draft(home, &set.name, set.position, draft);
            }
            for surface in &part.surfaces {
                self.add_surface(home, surface)?;
            }
        }
        Ok(())
    }

    /// The groups, in the order of dimension and number, remarks on what they lack, and the nodes of sets that are no nodes of the mesh.
    pub(super) fn finish(mut self) -> (Vec<Group>, Vec<Remark>, BTreeMap<String, Vec<u64>>) {
        self.groups
            .sort_by_key(|group| (group.dimension, group.number));
        (self.groups, self.remarks, self.outside)
    }

    fn nodes(&self, home: usize, members: &[Member]) -> Draft {
        let mut draft = Draft::default();
        let mut inner = 0;
        for member in members {
            let index = |part: &Part, label| Nodes::index(&part.nodes, label);
            match self.body.space_of(home, *member, index) {
                None => draft.undefined += 1,
                Some((space, index)) => {
                    let number = self.numbers.nodes[space][index];
                    match number {
                        UNUSED => draft.beside += 1,
                        INNER => inner += 1,
                        number => draft.groups[0].nodes.push(number),
                    }
                    if matches!(number, UNUSED | INNER) {
                        let space = &self.body.spaces[space];
                        let label = space.part.nodes.list[index].label;
                        draft.outside.push(space.shift + u64::from(label));
                    }
                }
            }
        }
        if draft.groups[0].nodes.is_empty() {
            draft.beside += inner;
        }
        draft
    }

    fn elements(&mut self, home: usize, set: &Set) -> Draft {
        let mut draft = Draft::default();
        for member in &set.members {
            let index = |part: &Part, label| Elements::index(&part.elements, label);
            let Some((space, index)) = self.body.space_of(home, *member, index) else {
                draft.undefined += 1;
                continue;
            };
            match self.numbers.cells[space][index] {
                NO_CELL => self.lower(&mut draft, space, index),
                cell => {
                    let group = &mut draft.groups[self.outline.dimension()];
                    group.cells.push(cell);
                    group.nodes.extend_from_slice(self.outline.corners(cell));
                }
            }
        }
        draft
    }

    /// Adds an element that is no cell, if it is an edge or a face of cells.
    fn lower(&mut self, draft: &mut Draft, space: usize, index: usize) {
        let element = &self.body.spaces[space].part.elements.list[index];
        match self.corners_in_mesh(space, element) {
            Some(corners) if self.outline.has(&corners) => {
                push_side(&mut draft.groups, &corners);
                self.in_groups[space][index] = true;
            }
            _ => draft.beside += 1,
        }
    }

    /// Numbers in the mesh of the corners of an element; `None` where one of them is no node of the mesh, or the element has no shape.
    fn corners_in_mesh(&self, space: usize, element: &Element) -> Option<Vec<u32>> {
        let (_, corners) = self.body.corners(space, element)?;
        let numbers = self.numbers_of(space, &without_repetition(corners.into_iter()));
        (!numbers.contains(&UNUSED)).then_some(numbers)
    }

    /// Numbers in the mesh of nodes, [`UNUSED`] for those that are none of its nodes.
    fn numbers_of(&self, space: usize, labels: &[u32]) -> Vec<u32> {
        let nodes = &self.body.spaces[space].part.nodes;
        let number = |label: &u32| match nodes.index(*label) {
            Some(index) => match self.numbers.nodes[space][index] {
                INNER => UNUSED,
                number => number,
            },
            None => UNUSED,
        };
        labels.iter().map(number).collect()
    }

    fn add_surface(&mut self, home: usize, surface: &Surface) -> Result<(), InpError> {
        let mut draft = Draft::default();
        let mut left_out = 0;
        for (position, side, members) in &surface.sides {
            if *side == Side::Node {
                let nodes = self.nodes(home, members);
                draft.undefined += nodes.undefined;
                draft.beside += nodes.beside;
                draft.groups[0].nodes.extend(&nodes.groups[0].nodes);
                continue;
            }
            for member in members {
                let index = |part: &Part, label| Elements::index(&part.elements, label);
                let Some((space, index)) = self.body.space_of(home, *member, index) else {
                    draft.undefined += 1;
                    continue;
                };
                let sides = self.sides(*position, *side, space, index)?;
                left_out += usize::from(sides.is_none());
                for side in sides.into_iter().flatten() {
                    push_side(&mut draft.groups, &side);
                }
            }
        }
        let is_group = draft.groups.iter().any(|group| !group.nodes.is_empty());
        if left_out > 0 {
            self.remark(
                surface.position,
                DeckRemark::LeftOutSides {
                    surface: self.name(home, &surface.name),
                    sides: left_out,
                    is_group,
                },
            );
        }
        self.add_draft(home, &surface.name, surface.position, draft);
        Ok(())
    }

    /// Sides of an element that a line of a surface names, by their nodes in the mesh; `None` where they are no sides of cells.
    fn sides(
        &self,
        position: Position,
        side: Side,
        space: usize,
        index: usize,
    ) -> Result<Option<Vec<Vec<u32>>>, InpError> {
        let element = &self.body.spaces[space].part.elements.list[index];
        let cell = self.numbers.cells[space][index];
        let is_shell = self.body.type_of(element).usage == Use::Shell;
        let number = match (side, cell) {
            (Side::Free, NO_CELL) | (Side::Face, _) => {
                let corners = self.corners_in_mesh(space, element);
                let face = corners.filter(|it| it.len() > 2 && self.outline.has(it));
                return Ok(face.map(|face| vec![face]));
            }
            (Side::Free, cell) => return Ok(Some(self.outline.outer(cell))),
            (_, NO_CELL) | (Side::End | Side::Node, _) => return Ok(None),
            (Side::Number(number), _) if !is_shell => number,
            (Side::Edge(number), _) if is_shell => number,
            (Side::Number(_) | Side::Edge(_), _) => return Ok(None),
        };
        let side = self.numbered(position, usize::from(number), space, element)?;
        Ok(side.map(|side| vec![side]))
    }

    /// Side of a cell by its number; `None` for one that repeated corners have taken away.
    fn numbered(
        &self,
        position: Position,
        number: usize,
        space: usize,
        element: &Element,
    ) -> Result<Option<Vec<u32>>, InpError> {
        if element.is_reflected {
            let what = "a numbered side of a copy by *ELCOPY, REFLECT";
            let remedy = "write the elements out, or use a set of nodes";
            return Err(self.source.not_carried_out(position, what, remedy));
        }
        let Some((shape, corners)) = self.body.corners(space, element) else {
            return Ok(None);
        };
        let nodes = shape.side(&corners, number);
        let nodes = nodes.ok_or_else(|| InpError::UnknownSide {
            line: self.source.line(position),
            side: number.to_string(),
            kind: self.body.type_of(element).name.clone(),
        })?;
        let side = self.numbers_of(space, &nodes);
        Ok((side.len() >= self.outline.dimension()).then_some(side))
    }

    /// Adds the groups of a draft, and a remark on what was left out.
    fn add_draft(&mut self, home: usize, name: &str, position: Position, draft: Draft) {
        let name = self.name(home, name);
        if !draft.outside.is_empty() {
            self.outside.insert(name.clone(), draft.outside);
        }
        let is_group = draft.groups.iter().any(|group| !group.nodes.is_empty());
        if draft.undefined + draft.beside > 0 {
            self.remark(
                position,
                DeckRemark::LeftOutMembers {
                    set: name.clone(),
                    undefined: draft.undefined,
                    beside: draft.beside,
                    is_group,
                },
            );
        }
        for (dimension, mut group) in (0..).zip(draft.groups) {
            if group.nodes.is_empty() {
                continue;
            }
            let of_dimension = self.groups.iter().filter(|it| it.dimension == dimension);
            group.number = 1 + of_dimension.count() as i32;
            group.name.clone_from(&name);
            group.dimension = dimension;
            sort(&mut group, self.outline.n_nodes());
            self.groups.push(group);
        }
    }

    /// Name of a set, with that of the instance.
    fn name(&self, home: usize, set: &str) -> String {
        match self.body.spaces[home].name {
            Some(instance) => format!("{instance}.{set}"),
            None => set.to_owned(),
        }
    }

    fn remark(&mut self, position: Position, remark: DeckRemark) {
        let line = self.source.line(position);
        self.remarks.push(Remark::Deck { line, remark });
    }

    /// Refuses a plane element beside solid ones that is the face of none of them.
    pub(super) fn check_plane_elements(&self) -> Result<(), InpError> {
        let used = self.body.kinds.iter().flatten();
        if !self.body.is_solid || used.clone().all(|kind| kind.is_cell) {
            return Ok(());
        }
        for (index, space) in self.body.spaces.iter().enumerate() {
            let is_plane = |it: &&Element| matches!(self.body.type_of(it).usage, Use::Plane(_));
            for element in space.part.elements.list.iter().filter(is_plane) {
                let corners = self.corners_in_mesh(index, element);
                if !corners.is_some_and(|corners| self.outline.has(&corners)) {
                    return Err(InpError::LoosePlaneElement {
                        line: self.source.line(element.position),
                        element: space.label(element.label),
                        kind: self.body.type_of(element).name.clone(),
                    });
                }
            }
        }
        Ok(())
    }

    /// Remarks on the elements that are no cells, by their types.
    pub(super) fn remarks_on_elements(&self) -> Vec<Remark> {
        let mut in_groups = vec![0; self.body.types.len()];
        for (space, flags) in self.body.spaces.iter().zip(&self.in_groups) {
            for (element, is_in_group) in space.part.elements.list.iter().zip(flags) {
                in_groups[usize::from(element.kind)] += usize::from(*is_in_group);
            }
        }
        let types = self.body.types.iter().zip(&self.body.kinds).zip(in_groups);
        let left_out = types.filter_map(|((it, kind), in_groups)| {
            let kind = kind.filter(|kind| !kind.is_cell)?;
            Some(Remark::Deck {
                line: self.source.line(kind.first),
                remark: DeckRemark::LeftOutElements {
                    kind: it.name.clone(),
                    elements: kind.count,
                    in_groups,
                },
            })
        });
        left_out.collect()
    }
}

/// Adds an edge or a face to the group of its dimension.
fn push_side(groups: &mut [Group; 4], corners: &[u32]) {
    let face = match *corners {
        [a, b] => {
            groups[1].edges.push([a, b]);
            groups[1].nodes.extend_from_slice(corners);
            return;
        }
        [a, b, c] => Cell::Triangle([a, b, c]),
        [a, b, c, d] => Cell::Quadrangle([a, b, c, d]),
        _ => return,
    };
    groups[2].faces.push(face);
    groups[2].nodes.extend_from_slice(corners);
}

/// Sorts the lists of a group, whose members then occur once.
fn sort(group: &mut Group, n_nodes: usize) {
    if group.nodes.len() < n_nodes {
        group.nodes.sort_unstable();
        group.nodes.dedup();
    } else {
        // Most nodes are repeated: a flag per node is faster than sorting.
        let mut is_in = vec![false; n_nodes];
        for node in &group.nodes {
            is_in[*node as usize] = true;
        }
        let all = 0..n_nodes as u32;
        group.nodes = all.filter(|node| is_in[*node as usize]).collect();
    }
    group.cells.sort_unstable();
    group.cells.dedup();
    group.edges.sort_by_key(|edge| ascending(*edge));
    group.edges.dedup_by_key(|edge| ascending(*edge));
    group.faces.sort_by_key(Cell::sorted_corners);
    group.faces.dedup_by_key(|face| face.sorted_corners());
}

/// Edges and faces of a mesh, found when they are first asked for.
struct Outline<'a> {
    mesh: &'a AnyMesh,
    faces: OnceCell<Faces<'a>>,
    /// Edges of all cells, ascending.
    edges: OnceCell<Vec<[u32; 2]>>,
    /// Cells with their sides on the outline, ascending by cell.
    outer: OnceCell<Vec<(u32, Vec<u32>)>>,
}

impl<'a> Outline<'a> {
    fn new(mesh: &'a AnyMesh) -> Self {
        Self {
            mesh,
            faces: OnceCell::new(),
            edges: OnceCell::new(),
            outer: OnceCell::new(),
        }
    }

    /// Dimension of the cells.
    fn dimension(&self) -> usize {
        match self.mesh {
            AnyMesh::Plane(_) => 2,
            AnyMesh::Solid(_) => 3,
        }
    }

    fn n_nodes(&self) -> usize {
        self.mesh.n_nodes()
    }

    fn corners(&self, cell: u32) -> &[u32] {
        match self.mesh {
            AnyMesh::Plane(mesh) => mesh.cells[cell as usize].corners(),
            AnyMesh::Solid(mesh) => mesh.cells[cell as usize].corners(),
        }
    }

    fn faces(&self, mesh: &'a SolidMesh) -> &Faces<'a> {
        let faces = || Faces::new(&mesh.cells, mesh.positions.len());
        self.faces.get_or_init(faces)
    }

    /// Whether nodes are an edge of a cell, or the face of a solid one.
    fn has(&self, corners: &[u32]) -> bool {
        let face = match (corners, self.mesh) {
            (&[a, b], _) => {
                let edges = self.edges.get_or_init(|| match self.mesh {
                    AnyMesh::Plane(mesh) => mesh.edges(),
                    AnyMesh::Solid(mesh) => mesh.edges(),
                });
                return edges.binary_search(&ascending([a, b])).is_ok();
            }
            (&[a, b, c], AnyMesh::Solid(mesh)) => (Cell::Triangle([a, b, c]), mesh),
            (&[a, b, c, d], AnyMesh::Solid(mesh)) => (Cell::Quadrangle([a, b, c, d]), mesh),
            _ => return false,
        };
        let (face, mesh) = face;
        !self.faces(mesh).sides_at(&face).is_empty()
    }

    /// Sides of a cell on the outline of the body.
    fn outer(&self, cell: u32) -> Vec<Vec<u32>> {
        let all = self.outer.get_or_init(|| {
            let mut outer: Vec<(u32, Vec<u32>)> = match self.mesh {
                AnyMesh::Plane(mesh) => edges_of_one_cell(&mesh.cells),
                AnyMesh::Solid(mesh) => {
                    let sides = self.faces(mesh).outer().into_iter();
                    sides
                        .map(|it| (it.cell, it.face.corners().to_vec()))
                        .collect()
                }
            };
            outer.sort();
            outer
        });
        let first = all.partition_point(|(it, _)| *it < cell);
        let of_cell = all[first..].iter().take_while(|(it, _)| *it == cell);
        of_cell.map(|(_, side)| side.clone()).collect()
    }
}

/// Cells with their edges that belong to no other cell.
fn edges_of_one_cell(cells: &[Cell]) -> Vec<(u32, Vec<u32>)> {
    let numbered = (0..).zip(cells);
    let edges = numbered.flat_map(|(number, cell)| cell.edges().map(move |edge| (edge, number)));
    let mut edges: Vec<([u32; 2], u32)> = edges.collect();
    edges.sort_unstable();
    let of_edges = edges.chunk_by(|a, b| a.0 == b.0);
    let outer = of_edges.filter(|cells| cells.len() == 1).flatten();
    outer.map(|(edge, cell)| (*cell, edge.to_vec())).collect()
}
