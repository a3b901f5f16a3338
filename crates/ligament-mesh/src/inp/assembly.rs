//! The mesh of a model.

use std::collections::BTreeMap;

use super::body::{Body, INNER, NO_CELL, Numbers, Space, UNUSED, spaces};
use super::element_type::Shape;
use super::error::InpError;
use super::groups::Groups;
use super::model::Model;
use super::part::Element;
use super::source::Source;
use crate::coordinate_plane::CoordinatePlane;
use crate::gmsh::{self, GmshError};
use crate::mesh::AnyMesh;
use crate::remark::{DeckRemark, FileLine, Remark};

/// The mesh of a model with its body, and the nodes that are not in the mesh as in [`Deck`](super::Deck).
pub(super) struct Assembled<'a> {
    pub(super) mesh: AnyMesh,
    pub(super) body: Body<'a>,
    pub(super) outside: BTreeMap<String, Vec<u64>>,
    pub(super) midpoints: BTreeMap<u64, [u64; 2]>,
}

/// The mesh of a model.
pub(super) fn assemble<'a>(
    source: &Source<'_>,
    model: &'a Model,
    plane: CoordinatePlane,
) -> Result<Assembled<'a>, InpError> {
    let mut of_body = Vec::new();
    let spaces = spaces(source, model, &mut of_body)?;
    let body = Body::new(source, model, spaces, &mut of_body)?;
    let (cells, mut nodes) = Cells::new(source, &body)?;
    let mut mesh = cells.mesh((source, plane), &body, &mut nodes)?;
    let mut remarks = remarks_on_nodes(&cells, &nodes);
    remarks.extend_from_slice(mesh.remarks());
    remarks.extend(of_body);
    remarks.extend(remarks_on_definitions(source, model));
    let (cells, midpoints) = cells.numbers(&body);
    let numbers = Numbers { nodes, cells };
    let mut collected = Groups::new(source, &body, &numbers, &mesh);
    collected.collect()?;
    collected.check_plane_elements()?;
    remarks.extend(collected.remarks_on_elements());
    let (groups, of_groups, outside) = collected.finish();
    remarks.extend(of_groups);
    match &mut mesh {
        AnyMesh::Plane(mesh) => (mesh.groups, mesh.remarks) = (groups, remarks),
        AnyMesh::Solid(mesh) => (mesh.groups, mesh.remarks) = (groups, remarks),
    }
    Ok(Assembled {
        mesh,
        body,
        outside,
        midpoints,
    })
}

/// Elements that are cells.
struct Cells {
    elements: Vec<gmsh::Element<'static>>,
    /// Space and index of the element of each cell.
    origins: Vec<(u32, u32)>,
    n_higher_order: usize,
    midpoints: BTreeMap<u64, [u64; 2]>,
}

impl Cells {
    /// Cells of a body, and the uses of the nodes: 0 for a corner, [`INNER`] or [`UNUSED`].
    fn new(source: &Source<'_>, body: &Body<'_>) -> Result<(Self, Vec<Vec<u32>>), InpError> {
        let parts = body.spaces.iter().map(|space| space.part);
        let uses = parts.map(|part| vec![UNUSED; part.nodes.list.len()]);
        let mut uses: Vec<Vec<u32>> = uses.collect();
        let count = body.kinds.iter().flatten().filter(|kind| kind.is_cell);
        let count = count.map(|kind| kind.count).sum();
        let mut cells = Self {
            elements: Vec::with_capacity(count),
            origins: Vec::with_capacity(count),
            n_higher_order: 0,
            midpoints: BTreeMap::new(),
        };
        for (index, (space, uses)) in (0..).zip(body.spaces.iter().zip(&mut uses)) {
            for (place, element) in (0..).zip(&space.part.elements.list) {
                if body.is_cell(element) {
                    cells.add(source, body, (space, element), uses)?;
                    cells.origins.push((index, place));
                }
            }
        }
        Ok((cells, uses))
    }

    /// Adds an element as a cell, and marks its nodes as used.
    fn add(
        &mut self,
        source: &Source<'_>,
        body: &Body<'_>,
        (space, element): (&Space<'_>, &Element),
        uses: &mut [u32],
    ) -> Result<(), InpError> {
        let element_type = body.type_of(element);
        let n_corners = element_type.shape.map_or(0, Shape::corners);
        let nodes = space.part.elements.nodes(element);
        self.n_higher_order += usize::from(nodes.len() > n_corners);
        for (place, &node) in nodes.iter().enumerate() {
            let index = space.part.nodes.index(node);
            let index = index.ok_or_else(|| InpError::MissingNode {
                line: source.line(element.position),
                element: space.label(element.label),
                node,
            })?;
            if place < n_corners {
                uses[index] = 0;
            } else if uses[index] == UNUSED {
                uses[index] = INNER;
                let edge = element_type.shape.and_then(|it| it.edge(place));
                if let Some(edge) = edge {
                    let ends = edge.map(|corner| space.shift + u64::from(nodes[corner]));
                    self.midpoints.insert(space.shift + u64::from(node), ends);
                }
            }
        }
        let corners = nodes[..n_corners].iter();
        let corners = corners.map(|node| space.shift + u64::from(*node));
        self.elements.push(gmsh::Element {
            dimension: if body.is_solid { 3 } else { 2 },
            corners: corners.collect(),
            group: None,
        });
        Ok(())
    }

    /// The mesh of the cells; numbers the nodes at their corners.
    fn mesh(
        &self,
        (source, plane): (&Source<'_>, CoordinatePlane),
        body: &Body<'_>,
        numbers: &mut [Vec<u32>],
    ) -> Result<AnyMesh, InpError> {
        let (nodes, origins) = nodes(body, numbers);
        let faults = Faults {
            source,
            body,
            cells: self,
            nodes: &origins,
        };
        gmsh::assemble(&nodes, &self.elements, plane).map_err(|error| faults.error(error))
    }

    /// Number of each element's cell, by spaces, and the nodes in the middle of edges.
    fn numbers(self, body: &Body<'_>) -> (Vec<Vec<u32>>, BTreeMap<u64, [u64; 2]>) {
        let parts = body.spaces.iter().map(|space| space.part);
        let numbers = parts.map(|part| vec![NO_CELL; part.elements.list.len()]);
        let mut numbers: Vec<Vec<u32>> = numbers.collect();
        for (number, (space, element)) in (0..).zip(self.origins) {
            numbers[space as usize][element as usize] = number;
        }
        (numbers, self.midpoints)
    }
}

/// Nodes at the corners of cells, which are numbered in `numbers`, and spaces and indices of the nodes.
type UsedNodes = (Vec<(u64, [f64; 3])>, Vec<(u32, u32)>);

fn nodes(body: &Body<'_>, numbers: &mut [Vec<u32>]) -> UsedNodes {
    let mut nodes = Vec::new();
    let mut origins = Vec::new();
    for (index, (space, numbers)) in (0..).zip(body.spaces.iter().zip(numbers)) {
        for (place, (node, number)) in (0..).zip(space.part.nodes.list.iter().zip(numbers)) {
            if *number == 0 {
                *number = nodes.len() as u32;
                let at = space.motion.map_or(node.at, |motion| motion.apply(node.at));
                nodes.push((space.shift + u64::from(node.label), at));
                origins.push((index, place));
            }
        }
    }
    (nodes, origins)
}

/// Remarks on nodes that were dropped.
fn remarks_on_nodes(cells: &Cells, numbers: &[Vec<u32>]) -> Vec<Remark> {
    let count = |number: u32| {
        let all = numbers.iter().flatten();
        all.filter(|it| **it == number).count()
    };
    let mut remarks = Vec::new();
    if cells.n_higher_order > 0 {
        remarks.push(Remark::HigherOrderCells {
            cells: cells.n_higher_order,
            nodes: count(INNER),
        });
    }
    match count(UNUSED) {
        0 => {}
        nodes => remarks.push(Remark::UnusedNodes { nodes }),
    }
    remarks
}

/// Remarks on definitions that replaced others, and on surfaces of other types.
fn remarks_on_definitions(source: &Source<'_>, model: &Model) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let own = model.instances.iter().filter_map(|it| it.own.as_ref());
    let parts = std::iter::once(&model.own).chain(&model.parts).chain(own);
    for part in parts {
        for (items, redefined) in [
            ("nodes", part.nodes.redefined),
            ("elements", part.elements.redefined),
        ] {
            let count = redefined.count;
            remarks.extend(redefined.first.map(|first| Remark::Deck {
                line: source.line(first),
                remark: DeckRemark::Redefined { items, count },
            }));
        }
    }
    let surfaces = model.other_surfaces.iter();
    remarks.extend(surfaces.map(|(position, surface, kind)| Remark::Deck {
        line: source.line(*position),
        remark: DeckRemark::LeftOutSurface {
            surface: surface.clone(),
            kind: kind.clone(),
        },
    }));
    remarks
}

/// What errors of the mesh refer to in the deck.
struct Faults<'a> {
    source: &'a Source<'a>,
    body: &'a Body<'a>,
    cells: &'a Cells,
    /// Space and index of each node.
    nodes: &'a [(u32, u32)],
}

impl Faults<'_> {
    /// The error of the deck for an error of the mesh, whose elements have the numbers of their cells, counted from 1.
    fn error(&self, error: GmshError) -> InpError {
        match error {
            GmshError::TooLarge => InpError::TooLarge,
            GmshError::NoMemory { megabytes } => InpError::NoMemory { megabytes },
            GmshError::OtherPlane { plane, .. } => InpError::OtherPlane { plane },
            GmshError::NotPlanar { tag, z, plane, .. } => {
                let (line, node) = self.node(tag);
                InpError::NotPlanar {
                    line,
                    node,
                    z,
                    plane,
                }
            }
            GmshError::CoincidentNodes { tag, other, .. }
            | GmshError::CoincidentNodesInSpace { tag, other, .. } => {
                self.coincident(tag, other, 0)
            }
            GmshError::Seam {
                tag, other, faces, ..
            } => self.coincident(tag, other, faces),
            GmshError::RepeatedCorner { element, .. } => self.unfit(
                element,
                "has repeated corners, and is no cell with fewer corners",
            ),
            GmshError::ZeroArea { element, .. } => self.unfit(element, "has no area"),
            GmshError::NotConvex { element, .. } | GmshError::NotConvexSolid { element, .. } => {
                self.unfit(element, "is not convex, or its nodes are in another order")
            }
            GmshError::FlatCell { element, .. } => self.unfit(element, "is flat"),
            GmshError::OverlappingCells { element, other, .. } => {
                self.overlapping(element, "lies on the same side of a common edge as", other)
            }
            GmshError::OverlappingSolids { element, other, .. } => {
                self.overlapping(element, "lies on the same side of a common face as", other)
            }
            GmshError::CoveringCells { element, other, .. } => {
                self.overlapping(element, "lies over", other)
            }
            GmshError::DuplicateCell { element, other, .. } => {
                self.overlapping(element, "has the corners of", other)
            }
            other => InpError::Unfit {
                reason: other.to_string(),
            },
        }
    }

    /// Line and number of a node of the mesh.
    fn node(&self, tag: u64) -> (FileLine, String) {
        let found = self.nodes.iter().find_map(|(space, index)| {
            let space = &self.body.spaces[*space as usize];
            let node = space.part.nodes.list[*index as usize];
            let is_it = space.shift + u64::from(node.label) == tag;
            is_it.then(|| (node.position, space.label(node.label)))
        });
        let (position, label) = found.unwrap_or_default();
        (self.source.line(position), label)
    }

    fn coincident(&self, tag: u64, other: u64, faces: usize) -> InpError {
        let ((line, node), (other_line, other)) = (self.node(tag), self.node(other));
        InpError::CoincidentNodes {
            line,
            node,
            other,
            other_line,
            faces,
        }
    }

    /// Line, number and type of the element of a cell.
    fn element(&self, number: u64) -> (FileLine, String, String) {
        let (space, index) = self.cells.origins[number as usize - 1];
        let space = &self.body.spaces[space as usize];
        let element = &space.part.elements.list[index as usize];
        let kind = self.body.type_of(element).name.clone();
        let line = self.source.line(element.position);
        (line, space.label(element.label), kind)
    }

    fn unfit(&self, number: u64, fault: &'static str) -> InpError {
        let (line, element, kind) = self.element(number);
        InpError::UnfitElement {
            line,
            element,
            kind,
            fault,
        }
    }

    fn overlapping(&self, number: u64, fault: &'static str, other: u64) -> InpError {
        let (line, element, _) = self.element(number);
        let (other_line, other, _) = self.element(other);
        InpError::OverlappingElements {
            line,
            element,
            fault,
            other,
            other_line,
        }
    }
}
