//! `[refine]`: runs one after the other on meshes that are finer where bonds broke.

use std::path::{Path, PathBuf};

use ligament::setup::{self, Fineness, Indicator};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::mesh_section::complete_path;
use super::values::{exactly_one, one_of};
use crate::point_table::Tables;

/// Runs one after the other, each from the unloaded body, on meshes that are finer where bonds of the runs before broke.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["size", "levels"])))]
pub struct Refine {
    /// Size of the cells where bonds break, m: the edge of an equilateral triangle, or of a regular tetrahedron.
    #[schemars(transform = setup::Refine::SIZE.keywords())]
    pub size: Option<f64>,
    /// Number of times that the edges are halved where bonds break, in the place of `size`.
    #[schemars(transform = setup::Refine::LEVELS.keywords())]
    pub levels: Option<u32>,
    /// Bonds around which the mesh is refined.
    #[serde(default)]
    pub r#where: Indicator,
    /// Share of the limit from which on brittle bonds outside of the fine part make it grow; bonds that soften do so only where no bond is open.
    #[serde(default = "strength_share")]
    #[schemars(transform = setup::Refine::STRENGTH_SHARE.keywords())]
    pub strength_share: f64,
    /// Relative change of peak and work, between two passes of one size, at which no other pass follows; the path changes by `size` at most.
    #[serde(default = "tolerance")]
    #[schemars(transform = setup::Refine::TOLERANCE.keywords())]
    pub tolerance: f64,
    /// Largest number of passes.
    #[serde(default = "passes")]
    #[schemars(transform = setup::Refine::PASSES.keywords())]
    pub passes: u32,
    /// Number of the first pass; in results the number of the pass that they are from.
    #[serde(default = "pass_number")]
    #[schemars(transform = setup::Refine::PASSES.keywords())]
    pub pass_number: u32,
    /// A table with the columns `x` and `y`, in a solid also `z`, m: places around which the mesh is fine from the first pass on that refines it.
    pub places: Option<PathBuf>,
}

fn usual() -> setup::Refine {
    setup::Refine::new(Fineness::Levels(1))
}

fn strength_share() -> f64 {
    usual().strength_share
}

fn tolerance() -> f64 {
    usual().tolerance
}

fn passes() -> u32 {
    usual().passes
}

fn pass_number() -> u32 {
    usual().pass
}

impl Refine {
    /// Completes the path of the table; `folder` is the folder of the case file.
    pub(super) fn complete(&mut self, key: &KeyPath, folder: &Path) -> Result<(), KeyFault> {
        match &mut self.places {
            Some(file) => complete_path(&key.child("places"), file, folder),
            None => Ok(()),
        }
    }

    /// The refinement, with its table.
    pub(super) fn setup(&self, key: &KeyPath, tables: Tables) -> Result<setup::Refine, KeyFault> {
        let forms = [
            ("size", self.size.map(Fineness::Size)),
            ("levels", self.levels.map(Fineness::Levels)),
        ];
        let places = self.places.as_ref().map(|it| tables.fine_places(it));
        let fault = |reason| KeyFault::new(key.child("places"), reason);
        Ok(setup::Refine {
            fineness: one_of(key, forms)?,
            indicator: self.r#where,
            strength_share: self.strength_share,
            tolerance: self.tolerance,
            passes: self.passes,
            pass: self.pass_number,
            places: places.transpose().map_err(fault)?.unwrap_or_default(),
        })
    }
}
