//! Setup of a part of a body.

use crate::body::AnyBody;
use crate::setup::{Analysis, Setup};

/// A setup on a part of its body, without supports, loads and pre-cracks, of one of its materials.
pub(crate) fn free(setup: &Setup, body: AnyBody, material: usize) -> Setup {
    let mut region = setup.materials[material].clone();
    region.group = None;
    Setup {
        body,
        materials: vec![region],
        precracks: Vec::new(),
        closing: false,
        far_field: None,
        no_fail: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
        curve: None,
        stages: Vec::new(),
        temperatures: Vec::new(),
        criteria: Vec::new(),
        scatter: Vec::new(),
        probes: Vec::new(),
        analysis: Analysis::default(),
        ..setup.clone()
    }
}
