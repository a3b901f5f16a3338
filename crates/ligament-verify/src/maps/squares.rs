//! Maps of the square plates of MPPD (Figs 12 to 24).

use anyhow::Context;
use ligament_plot::picture::maps::Maps;

use super::Motion;
use super::drawing::{Quantity, maps_of_component, maps_of_modes};
use crate::case_run::{CaseRun, ResultCache};
use crate::named_modes::{NAMES, in_named_order};
use crate::readings::case_path;
use crate::square_elements::{self, SquareLoad};

/// Case of the natural modes.
pub(super) const MODES: &str = "cases/verification/square-modes.toml";

const DENSITY: f64 = 2500.0;

/// Axis of the plates, which are supported at their base: y.
const ALONG: usize = 1;

/// Poisson's ratios of the figures, as text and number, with the number of the first figure of each.
const RATIOS: [(&str, f64, usize); 3] =
    [("-0.5", -0.5, 12), ("0", 0.0, 13), ("1/3", 1.0 / 3.0, 14)];

const LOADS: [&str; 3] = ["traction", "shear", "bending"];

const MODELS: [&str; 2] = ["PDS", "MPPD"];

/// Computed motions, by load, Poisson's ratio and model.
#[derive(Debug, Default)]
pub(super) struct Squares {
    motions: ResultCache<Motion>,
    modes: ResultCache<Vec<Motion>>,
}

impl Squares {
    /// The plate under a load by finite elements.
    pub(super) fn elements(&mut self, load: &str, ratio: f64) -> anyhow::Result<Motion> {
        self.motions.result(format!("elements {load} {ratio}"), || {
            let (mesh, displacements) =
                square_elements::displacements(SquareLoad::named(load)?, ratio)?;
            Ok(Motion::from_elements(mesh, displacements).without_rigid_motion())
        })
    }

    /// The plate under a load as a lattice of a model.
    pub(super) fn lattice(
        &mut self,
        load: &str,
        ratio: f64,
        model: &str,
    ) -> anyhow::Result<Motion> {
        let case_run = CaseRun::from_file(case_path(SquareLoad::named(load)?))?
            .set("material.poisson", ratio)
            .set("model.law", model.to_lowercase());
        self.motions.reading(&case_run, |it| {
            let motion = Motion::from_lattice(&**it.model.plane(), &it.outcome.state.displacement)?;
            Ok(motion.without_rigid_motion())
        })
    }

    /// The three modes by finite elements, in the order of their names.
    pub(super) fn modes_of_elements(&mut self, ratio: f64) -> anyhow::Result<Vec<Motion>> {
        self.modes.result(format!("elements {ratio}"), || {
            let (mesh, modes) = square_elements::modes(ratio, DENSITY)?;
            let modes = in_named_order(modes, |it| it.participation[ALONG])?;
            let motion = |shape| Motion::from_elements(mesh.clone(), shape);
            Ok(modes.map(|mode| motion(mode.shape)).into())
        })
    }

    /// The three modes of a lattice, in the order of their names.
    pub(super) fn modes_of_lattice(
        &mut self,
        ratio: f64,
        model: &str,
    ) -> anyhow::Result<Vec<Motion>> {
        let case_run = (CaseRun::from_file(MODES)?)
            .set("material.poisson", ratio)
            .set("model.law", model.to_lowercase());
        self.modes.result(case_run.command(), || {
            let model = case_run.model()?;
            let system = model.plane();
            let modes = in_named_order(case_run.modes()?, |it| it.participation[ALONG])?;
            let modes = modes.map(|mode| Motion::from_lattice(&**system, &mode.shape));
            modes.into_iter().collect()
        })
    }

    /// Maps of all figures of squares.
    pub(super) fn maps(&mut self) -> anyhow::Result<Vec<Maps>> {
        let mut maps = Vec::new();
        let mut turning = Vec::new();
        for (row, load) in LOADS.into_iter().enumerate() {
            for (written, ratio, first) in RATIOS {
                let mut motions = vec![("finite elements".to_owned(), self.elements(load, ratio)?)];
                for model in MODELS {
                    motions.push((model.to_owned(), self.lattice(load, ratio, model)?));
                }
                if let (2, Some((_, motion))) = (row, motions.last()) {
                    turning.push(motion.mapped_body(format!("nu = {written}"), Quantity::Rotation));
                }
                let name = format!("mppd-figure-{}", first + 3 * row);
                let title = format!("Square plate in {load}, nu = {written}");
                for axis in [0, 1] {
                    maps.push(maps_of_component(name.clone(), &title, &motions, axis));
                }
            }
        }
        maps.push(Maps {
            name: "mppd-figure-21".to_owned(),
            title: "Square plate in bending, MPPD".to_owned(),
            quantity: "rotation".to_owned(),
            unit: "rad",
            columns: turning.len(),
            bodies: turning,
            are_modes: false,
        });
        for (written, ratio, first) in RATIOS {
            let mut methods = vec![("finite elements", self.modes_of_elements(ratio)?)];
            for model in MODELS {
                methods.push((model, self.modes_of_lattice(ratio, model)?));
            }
            let title = format!("Modes of the square plate, nu = {written}");
            let name = format!("mppd-figure-{}", first + 10);
            maps.push(maps_of_modes(name, &title, &methods));
        }
        Ok(maps)
    }
}

/// Index of a mode by its name.
pub(super) fn place_of_mode(name: &str) -> anyhow::Result<usize> {
    let place = NAMES.iter().position(|it| *it == name);
    place.with_context(|| format!("no mode `{name}`"))
}
