//! A part of a body as a body of its own.

use std::sync::Arc;

use crate::body::Body;
use crate::setup::{Analysis, Setup};

/// A setup on a part of its body, free and whole, of one of its materials.
pub(crate) fn free<const D: usize>(
    setup: &Setup<D>,
    body: Arc<dyn Body<D>>,
    material: usize,
) -> Setup<D> {
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
