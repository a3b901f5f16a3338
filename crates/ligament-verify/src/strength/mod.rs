//! The exam of strength: where bodies first fail by stress, and what they carry when strength and fracture energy act together.

pub(super) mod cube;
pub(super) mod glass;
pub(super) mod squares;
mod uniform;
