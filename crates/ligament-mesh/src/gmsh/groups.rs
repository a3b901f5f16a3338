//! Physical groups.

use std::collections::BTreeMap;

use super::assembly::{Assembly, DROPPED_NODE};
use super::collapsed::{Collapsible, first_repeated};
use super::records::Records;
use crate::cell::{Cell, MeshCell};
use crate::mesh::Group;
use crate::remark::Remark;

/// Groups of all elements, in the order of dimension and number; adds remarks on groups left out.
pub(super) fn collect(
    records: &Records,
    assembly: &Assembly,
    cell_of_element: &[Option<u32>],
    remarks: &mut Vec<Remark>,
) -> Vec<Group> {
    let mut groups = named_groups(records);
    let mut undescribed = 0;
    for (element, cell) in records.elements.iter().zip(cell_of_element) {
        let corners = &assembly.corners[element.corners()];
        let dimension = element.shape.dimension();
        let Some(numbers) = records.physicals.get(&(dimension, element.owner)) else {
            undescribed += 1;
            continue;
        };
        for number in numbers {
            let Some(group) = groups.get_mut(&(dimension, *number)) else {
                continue;
            };
            let kept = corners.iter().filter(|corner| **corner != DROPPED_NODE);
            group.nodes.extend(kept);
            group.cells.extend(cell);
            if corners.contains(&DROPPED_NODE) {
                continue;
            }
            match (dimension, corners) {
                (1, &[a, b]) => group.edges.push([a, b]),
                (2, _) if cell.is_none() => group.faces.extend(face(corners)),
                _ => {}
            }
        }
    }
    if undescribed > 0 {
        remarks.push(Remark::UndescribedEntities {
            elements: undescribed,
        });
    }
    nonempty_groups(groups, assembly.nodes.len(), remarks)
}

/// The face of a solid cell with given corners, of which one may be repeated.
pub(super) fn face(corners: &[u32]) -> Option<Cell> {
    let face = Cell::from_corners(corners)?;
    match first_repeated(corners) {
        None => Some(face),
        Some(_) => face.collapsed(),
    }
}

/// All groups that the file names or uses, still empty.
fn named_groups(records: &Records) -> BTreeMap<(u8, i32), Group> {
    let used = records
        .physicals
        .iter()
        .flat_map(|((dimension, _), numbers)| numbers.iter().map(|number| (*dimension, *number)));
    let group = |(dimension, number)| {
        let name = records.names.get(&(dimension, number)).cloned();
        let name = name.unwrap_or_else(|| number.to_string());
        (
            (dimension, number),
            Group {
                name,
                dimension,
                number,
                ..Group::default()
            },
        )
    };
    // Number 0 means no group.
    records
        .names
        .keys()
        .copied()
        .chain(used)
        .filter(|(_, number)| *number != 0)
        .map(group)
        .collect()
}

/// Groups with sorted lists; empty groups become remarks.
fn nonempty_groups(
    groups: BTreeMap<(u8, i32), Group>,
    n_nodes: usize,
    remarks: &mut Vec<Remark>,
) -> Vec<Group> {
    let (mut full, empty): (Vec<_>, Vec<_>) = groups
        .into_values()
        .partition(|group| !group.nodes.is_empty());
    for group in &mut full {
        group.nodes = ascending(std::mem::take(&mut group.nodes), n_nodes);
        group.cells.sort_unstable();
        group.cells.dedup();
        let key = |edge: &[u32; 2]| (edge[0].min(edge[1]), edge[0].max(edge[1]));
        group.edges.sort_by_key(key);
        group.edges.dedup_by_key(|edge| key(edge));
        group.faces.sort_by_key(Cell::sorted_corners);
        group.faces.dedup_by_key(|face| face.sorted_corners());
    }
    remarks.extend(empty.into_iter().map(
        |Group {
             name, dimension, ..
         }| Remark::EmptyGroup { name, dimension },
    ));
    full
}

/// Nodes in ascending order, each once.
fn ascending(mut nodes: Vec<u32>, n_nodes: usize) -> Vec<u32> {
    if nodes.len() < n_nodes {
        nodes.sort_unstable();
        nodes.dedup();
        return nodes;
    }
    // Most nodes are repeated: a flag per node is faster than sorting.
    let mut is_in = vec![false; n_nodes];
    for node in nodes {
        is_in[node as usize] = true;
    }
    let all = 0..n_nodes as u32;
    all.filter(|node| is_in[*node as usize]).collect()
}
