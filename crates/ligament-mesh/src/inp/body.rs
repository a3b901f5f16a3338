//! The body that a model describes: which elements are its cells, and the numbers of nodes and cells in the mesh.

use super::element_type::{ElementType, Plane, Shape, Use};
use super::error::InpError;
use super::geometry::Frame;
use super::model::Model;
use super::part::{Element, Member, Part};
use super::source::{Position, Source};
use crate::remark::{DeckRemark, Remark};

/// Number of a node that is no node of the mesh.
pub(super) const UNUSED: u32 = u32::MAX;

/// Number of a node between the corners of cells, which is no node of the mesh either.
pub(super) const INNER: u32 = u32::MAX - 1;

/// Number of an element that is no cell.
pub(super) const NO_CELL: u32 = u32::MAX;

/// Numbers in the mesh, by spaces.
pub(super) struct Numbers {
    /// Number of each node, or [`UNUSED`] or [`INNER`].
    pub(super) nodes: Vec<Vec<u32>>,
    /// Number of each element's cell, or [`NO_CELL`].
    pub(super) cells: Vec<Vec<u32>>,
}

/// Nodes and elements with their own numbers: the model outside of instances, or an instance.
pub(super) struct Space<'a> {
    /// Name of the instance.
    pub(super) name: Option<&'a str>,
    pub(super) part: &'a Part,
    pub(super) motion: Option<&'a Frame>,
    /// Number that is added to the numbers of the nodes, so that those of the mesh are unique.
    pub(super) shift: u64,
}

impl Space<'_> {
    /// Number of a node or element, with the name of its instance.
    pub(super) fn label(&self, label: u32) -> String {
        match self.name {
            Some(name) => format!("{name}.{label}"),
            None => label.to_string(),
        }
    }
}

/// Spaces of a model, the first of which is the model itself; remarks tell what was left out or renumbered.
pub(super) fn spaces<'a>(
    source: &Source<'_>,
    model: &'a Model,
    remarks: &mut Vec<Remark>,
) -> Result<Vec<Space<'a>>, InpError> {
    let space = |name, part, motion| Space {
        name,
        part,
        motion,
        shift: 0,
    };
    let mut spaces = vec![space(None, &model.own, None)];
    match model.parts.as_slice() {
        [part] if model.instances.is_empty() => spaces.push(space(None, part, None)),
        [first, ..] if model.instances.is_empty() => {
            let line = source.line(first.position);
            return Err(InpError::NoInstance { line });
        }
        parts => {
            for (index, part) in parts.iter().enumerate() {
                if !model.instances.iter().any(|it| it.part == index) {
                    let (part, elements) = (part.name.clone(), part.elements.list.len());
                    let line = source.line(parts[index].position);
                    let remark = DeckRemark::PartWithoutInstance { part, elements };
                    remarks.push(Remark::Deck { line, remark });
                }
            }
        }
    }
    let instances = model.instances.iter();
    spaces.extend(instances.map(|it| space(Some(&it.name), model.part_of(it), Some(&it.motion))));
    shift(&mut spaces);
    for (instance, space) in model.instances.iter().zip(&spaces[1..]) {
        if space.shift > 0 {
            let (instance, line) = (instance.name.clone(), source.line(instance.position));
            let shift = space.shift;
            let remark = DeckRemark::ShiftedNumbers { instance, shift };
            remarks.push(Remark::Deck { line, remark });
        }
    }
    Ok(spaces)
}

/// Shifts the numbers of nodes by multiples of a power of ten where those of two spaces overlap; the model itself comes last.
fn shift(spaces: &mut [Space<'_>]) {
    let largest = |space: &Space<'_>| {
        let labels = space
            .part
            .nodes
            .list
            .iter()
            .map(|node| u64::from(node.label));
        labels.max().unwrap_or(0)
    };
    let mut unit = 1;
    while spaces.iter().any(|space| largest(space) > unit) {
        unit *= 10;
    }
    let mut used = 0;
    let n = spaces.len();
    for index in (1..n).chain([0]) {
        let space = &mut spaces[index];
        let labels = space.part.nodes.list.iter().map(|node| node.label);
        let Some(lowest) = labels.min() else { continue };
        if u64::from(lowest) <= used {
            space.shift = used.div_ceil(unit) * unit;
        }
        used = used.max(space.shift + largest(space));
    }
}

/// Elements of one type in all spaces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kind {
    pub(super) first: Position,
    pub(super) count: usize,
    /// Whether the elements are cells of the body.
    pub(super) is_cell: bool,
}

/// The body: spaces with elements, and the types of these elements that are its cells.
pub(super) struct Body<'a> {
    pub(super) spaces: Vec<Space<'a>>,
    pub(super) types: &'a [ElementType],
    /// Elements of each type; `None` for a type without elements.
    pub(super) kinds: Vec<Option<Kind>>,
    pub(super) is_solid: bool,
    pub(super) plane: Option<Plane>,
}

impl<'a> Body<'a> {
    /// The body of solid elements if there is one, else of plane ones, else of shells in a plane.
    pub(super) fn new(
        source: &Source<'_>,
        model: &'a Model,
        spaces: Vec<Space<'a>>,
        remarks: &mut Vec<Remark>,
    ) -> Result<Self, InpError> {
        let types = &model.types;
        let mut kinds: Vec<Option<Kind>> = vec![None; types.len()];
        for element in spaces.iter().flat_map(|it| &it.part.elements.list) {
            let new = Kind {
                first: element.position,
                count: 0,
                is_cell: false,
            };
            kinds[usize::from(element.kind)].get_or_insert(new).count += 1;
        }
        let rank = |usage| match usage {
            Use::Solid => 3,
            Use::Plane(_) => 2,
            Use::Shell => 1,
            Use::Lower | Use::Other => 0,
        };
        let used = types.iter().zip(&kinds).filter(|(_, kind)| kind.is_some());
        let highest = used.map(|(it, _)| rank(it.usage)).max().unwrap_or(0);
        if highest == 0 {
            return Err(InpError::NoCells);
        }
        for (it, kind) in types.iter().zip(&mut kinds) {
            if let Some(kind) = kind {
                kind.is_cell = rank(it.usage) == highest;
            }
        }
        let cells = kinds.iter().flatten().filter(|kind| kind.is_cell);
        if let (1, Some(first)) = (highest, cells.clone().map(|it| it.first).min()) {
            let elements = cells.map(|kind| kind.count).sum();
            remarks.push(Remark::Deck {
                line: source.line(first),
                remark: DeckRemark::ShellsAsCells { elements },
            });
        }
        let mut body = Self {
            spaces,
            types,
            kinds,
            is_solid: highest == 3,
            plane: None,
        };
        body.plane = body.state_of_plane(source)?;
        Ok(body)
    }

    /// State of the plane that the cells have in common.
    fn state_of_plane(&self, source: &Source<'_>) -> Result<Option<Plane>, InpError> {
        let first_of = |state: Plane| {
            let types = self.types.iter().zip(&self.kinds);
            let of_state = types.filter(|(it, _)| it.usage == Use::Plane(Some(state)));
            let used = of_state.filter_map(|(it, kind)| Some(((*kind)?, it)));
            let cells = used.filter(|(kind, _)| kind.is_cell);
            cells.min_by_key(|(kind, _)| kind.first)
        };
        match (first_of(Plane::Stress), first_of(Plane::Strain)) {
            (Some((stress, of_stress)), Some((strain, of_strain))) => {
                Err(InpError::PlaneConflict {
                    line: source.line(strain.first),
                    kind: of_strain.name.clone(),
                    plane: Plane::Strain,
                    other_line: source.line(stress.first),
                    other: of_stress.name.clone(),
                    other_plane: Plane::Stress,
                })
            }
            (stress, strain) => Ok(stress
                .map(|_| Plane::Stress)
                .or(strain.map(|_| Plane::Strain))),
        }
    }

    pub(super) fn type_of(&self, element: &Element) -> &ElementType {
        &self.types[usize::from(element.kind)]
    }

    pub(super) fn is_cell(&self, element: &Element) -> bool {
        self.kinds[usize::from(element.kind)].is_some_and(|kind| kind.is_cell)
    }

    /// Numbers of the nodes at the corners of an element, for an element with a shape.
    pub(super) fn corners(&self, space: usize, element: &Element) -> Option<(Shape, Vec<u32>)> {
        let element_type = self.type_of(element);
        let nodes = self.spaces[space].part.elements.nodes(element);
        let corners = element_type.corners().map(|place| nodes[place]);
        Some((element_type.shape?, corners.collect()))
    }

    /// Space of a member of a set that belongs to a space.
    ///
    /// Numbers in an assembly of one instance that are none of its own are those of the instance.
    pub(super) fn space_of(
        &self,
        home: usize,
        member: Member,
        index: impl Fn(&Part, u32) -> Option<usize>,
    ) -> Option<(usize, usize)> {
        let space = match member.space {
            0 => home,
            instance => instance as usize,
        };
        let of_space = |space: usize| {
            let found = index(self.spaces[space].part, member.label);
            found.map(|index| (space, index))
        };
        let is_alone = home == 0 && self.spaces.len() == 2;
        of_space(space).or_else(|| is_alone.then(|| of_space(1)).flatten())
    }
}
