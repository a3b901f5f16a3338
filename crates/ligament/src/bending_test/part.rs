//! A part of a body as a body of its own.

use std::sync::Arc;

use crate::body::Body;
use crate::setup::{Analysis, Dim, Dimension, Setup};

/// The nodes that a part of a mesh keeps, ascending.
pub(crate) struct Kept(Vec<u32>);

impl Kept {
    /// The corners of cells.
    pub(crate) fn nodes(cells: impl Iterator<Item = Vec<u32>>) -> Self {
        let mut nodes: Vec<u32> = cells.flatten().collect();
        nodes.sort_unstable();
        nodes.dedup();
        Self(nodes)
    }

    /// What the kept nodes have of values at all of them.
    pub(crate) fn taken<T: Copy>(&self, values: &[T]) -> Vec<T> {
        self.0.iter().map(|&node| values[node as usize]).collect()
    }

    /// Corners of a kept cell among the kept nodes.
    pub(crate) fn renumbered<const N: usize>(&self, corners: [u32; N]) -> [u32; N] {
        corners.map(|corner| self.0.partition_point(|&node| node < corner) as u32)
    }
}

/// A setup on a part of its body, free and whole, of one of its materials.
pub(crate) fn free<const D: usize>(
    setup: &Setup<D>,
    body: Arc<dyn Body<D>>,
    material: usize,
) -> Setup<D>
where
    Dim: Dimension<D>,
{
    let mut region = setup.materials[material].clone();
    region.group = None;
    Setup {
        body,
        materials: vec![region],
        precracks: Vec::new(),
        closing: false,
        no_fail: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
        curve: None,
        stages: Vec::new(),
        temperatures: Vec::new(),
        criteria: Vec::new(),
        scatter: None,
        probes: Vec::new(),
        analysis: Analysis::default(),
        ..setup.clone()
    }
}
