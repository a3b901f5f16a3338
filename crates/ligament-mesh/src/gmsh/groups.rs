//! The physical groups.

use std::collections::BTreeMap;

use super::records::{Corners, Records};
use crate::group::Group;
use crate::remark::Remark;

/// The groups of all elements, in the order of dimension and number; remarks on those left out.
pub(super) fn collect(
    records: &Records,
    corners: &[Corners],
    cell_of_element: &[Option<u32>],
    remarks: &mut Vec<Remark>,
) -> Vec<Group> {
    let mut groups = announced(records);
    let mut undescribed = 0;
    for ((element, corners), cell) in records.elements.iter().zip(corners).zip(cell_of_element) {
        let dimension = element.shape.dimension();
        let Some(numbers) = records.physicals.get(&(dimension, element.owner)) else {
            undescribed += 1;
            continue;
        };
        for number in numbers {
            let Some(group) = groups.get_mut(&(dimension, *number)) else {
                continue;
            };
            group.nodes.extend(corners.iter().flatten());
            group.cells.extend(cell);
            if let (1, [Some(a), Some(b), ..]) = (dimension, *corners) {
                group.edges.push([a, b]);
            }
        }
    }
    if undescribed > 0 {
        remarks.push(Remark::UndescribedEntities {
            elements: undescribed,
        });
    }
    finished(groups, remarks)
}

/// All groups that the file names or uses, empty.
fn announced(records: &Records) -> BTreeMap<(u8, i32), Group> {
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
    // Number 0 stands for no group.
    records
        .names
        .keys()
        .copied()
        .chain(used)
        .filter(|(_, number)| *number != 0)
        .map(group)
        .collect()
}

/// The groups with their lists in order; the empty ones become remarks.
fn finished(groups: BTreeMap<(u8, i32), Group>, remarks: &mut Vec<Remark>) -> Vec<Group> {
    let (mut full, empty): (Vec<_>, Vec<_>) = groups
        .into_values()
        .partition(|group| !group.nodes.is_empty());
    for group in &mut full {
        group.nodes.sort_unstable();
        group.nodes.dedup();
        group.cells.sort_unstable();
        let key = |edge: &[u32; 2]| (edge[0].min(edge[1]), edge[0].max(edge[1]));
        group.edges.sort_by_key(key);
        group.edges.dedup_by_key(|edge| key(edge));
    }
    remarks.extend(empty.into_iter().map(
        |Group {
             name, dimension, ..
         }| Remark::EmptyGroup { name, dimension },
    ));
    full
}
