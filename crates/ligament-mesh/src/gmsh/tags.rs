//! Indices of node records by the tags of the nodes.

use std::collections::HashMap;

use super::cursor::Cursor;
use super::error::GmshError;
use super::records::Node;

/// Largest number of table entries per node; Gmsh numbers nodes without large gaps.
const PLACES: usize = 4;

/// Index of a missing node.
const NONE: u32 = u32::MAX;

/// Indices of node records by their tags.
pub(super) enum NodeIndices {
    /// Table by tag, for tags without large gaps: 0.1 s instead of 0.7 s for a million nodes.
    Table(Vec<u32>),
    /// Map for arbitrary tags.
    Map(HashMap<u64, u32>),
}

impl NodeIndices {
    /// Builds the index; refuses a repeated tag.
    pub(super) fn new(cursor: &Cursor<'_>, nodes: &[Node]) -> Result<Self, GmshError> {
        let largest = nodes.iter().map(|node| node.tag).max().unwrap_or(0);
        let mut indices = match usize::try_from(largest) {
            Ok(largest) if largest < PLACES * nodes.len() => Self::Table(vec![NONE; largest + 1]),
            _ => Self::Map(HashMap::with_capacity(nodes.len())),
        };
        for (index, node) in nodes.iter().enumerate() {
            let index = u32::try_from(index).ok().filter(|index| *index != NONE);
            let index = index.ok_or(GmshError::TooLarge)?;
            if let Some(first) = indices.insert(node.tag, index) {
                return Err(GmshError::DuplicateNodeTag {
                    place: cursor.place(node.offset),
                    tag: node.tag,
                    first: cursor.place(nodes[first as usize].offset),
                });
            }
        }
        Ok(indices)
    }

    /// Index of the node with a tag.
    pub(super) fn get(&self, tag: u64) -> Option<u32> {
        match self {
            Self::Table(table) => {
                let index = table.get(usize::try_from(tag).ok()?)?;
                (*index != NONE).then_some(*index)
            }
            Self::Map(map) => map.get(&tag).copied(),
        }
    }

    /// Sets the index of a tag and returns the previous one.
    fn insert(&mut self, tag: u64, index: u32) -> Option<u32> {
        match self {
            Self::Table(table) => {
                let before = std::mem::replace(&mut table[tag as usize], index);
                (before != NONE).then_some(before)
            }
            Self::Map(map) => map.insert(tag, index),
        }
    }
}
