//! From the tags of nodes to their records.

use std::collections::HashMap;

use super::cursor::Cursor;
use super::error::GmshError;
use super::records::Node;

/// A table may have so many places a node; Gmsh numbers nodes without large gaps.
const PLACES: usize = 4;

/// No node has this index.
const NONE: u32 = u32::MAX;

/// Indices of node records by their tags.
pub(super) enum NodeIndices {
    /// Indices at the places of the tags, where these leave no large gaps: 0.1 s instead of 0.7 s for a
    /// million nodes.
    Table(Vec<u32>),
    /// For any tags.
    Map(HashMap<u64, u32>),
}

impl NodeIndices {
    /// Refuses a tag that stands there twice.
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

    /// Index of the node of a tag.
    pub(super) fn get(&self, tag: u64) -> Option<u32> {
        match self {
            Self::Table(table) => {
                let index = table.get(usize::try_from(tag).ok()?)?;
                (*index != NONE).then_some(*index)
            }
            Self::Map(map) => map.get(&tag).copied(),
        }
    }

    /// Puts an index under a tag and gives the one that was there.
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
