//! The exam of strength: where bodies first fail by stress, and what they carry when strength and fracture energy act together.

pub(super) mod bar;
pub(super) mod crack;
pub(super) mod cube;
pub(super) mod disk;
pub(super) mod glass;
pub(super) mod hole;
pub(super) mod squares;
mod uniform;
