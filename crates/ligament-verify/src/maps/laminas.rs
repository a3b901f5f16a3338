//! Maps of the orthotropic laminas of OMPPD (Figs 9, 11 to 15, 19 to 23).

use ligament_plot::picture::maps::Maps;

use super::Motion;
use super::drawing::{Quantity, maps_of_component, maps_of_modes};
use crate::case_run::CaseRun;
use crate::lamina_elements;
use crate::named_modes::in_named_order;
use crate::tension;

/// Case of the natural modes.
pub(super) const MODES: &str = "cases/verification/lamina-modes.toml";

/// Axis of the cantilevers: x.
const ALONG: usize = 0;

/// Angles of the material's axis 1, degrees, with the numbers of the figures in tension and of modes.
const ANGLES: [(f64, usize, usize); 5] = [
    (0.0, 11, 19),
    (30.0, 12, 20),
    (45.0, 13, 21),
    (60.0, 14, 22),
    (90.0, 15, 23),
];

/// Maps of all figures of laminas.
pub(super) fn maps() -> anyhow::Result<Vec<Maps>> {
    let mut maps = vec![rotations()?];
    for (angle, figure, _) in ANGLES {
        let (mesh, displacements) = lamina_elements::displacements(angle.to_radians())?;
        let elements = Motion::from_elements(mesh, displacements).without_rigid_motion();
        let motions = [
            ("finite elements".to_owned(), elements),
            ("lattice".to_owned(), lamina_in_tension(angle, true)?),
        ];
        let title = format!("Lamina in tension, axis 1 at {angle} degrees");
        for axis in [0, 1] {
            let name = format!("omppd-figure-{figure}");
            maps.push(maps_of_component(name, &title, &motions, axis));
        }
    }
    for (angle, _, figure) in ANGLES {
        let (mesh, elements) = lamina_elements::modes(angle.to_radians())?;
        let elements = in_named_order(elements, |it| it.participation[ALONG])?;
        let elements = elements.map(|mode| Motion::from_elements(mesh.clone(), mode.shape));
        let methods = [
            ("finite elements", elements.into()),
            ("lattice", modes(angle)?),
        ];
        let title = format!("Modes of the lamina, axis 1 at {angle} degrees");
        let name = format!("omppd-figure-{figure}");
        maps.push(maps_of_modes(name, &title, &methods));
    }
    Ok(maps)
}

/// The lamina in tension, with or without its hole.
fn lamina_in_tension(angle: f64, has_hole: bool) -> anyhow::Result<Motion> {
    let mut case_run = CaseRun::from_file(tension::CASE)?.set("material.angle", angle.to_radians());
    if !has_hole {
        case_run = case_run.set("lattice.remove", Vec::<f64>::new());
    }
    let solution = case_run.solve()?;
    let motion = Motion::from_lattice(
        &**solution.model.plane(),
        &solution.outcome.state.displacement,
    )?;
    Ok(motion.without_rigid_motion())
}

fn modes(angle: f64) -> anyhow::Result<Vec<Motion>> {
    let case_run = CaseRun::from_file(MODES)?.set("material.angle", angle.to_radians());
    let model = case_run.model()?;
    let system = model.plane();
    let modes = in_named_order(case_run.modes()?, |it| it.participation[ALONG])?;
    let modes = modes.map(|mode| Motion::from_lattice(&**system, &mode.shape));
    modes.into_iter().collect()
}

/// Maps of Fig. 9: rotations of the points, which vanish in a homogeneous body.
fn rotations() -> anyhow::Result<Maps> {
    let mut bodies = Vec::new();
    for (title, has_hole) in [("without hole", false), ("with hole", true)] {
        bodies.push(lamina_in_tension(0.0, has_hole)?.mapped_body(title, Quantity::Rotation));
    }
    Ok(Maps {
        name: "omppd-figure-9".to_owned(),
        title: "Lamina in tension, axis 1 along the load".to_owned(),
        quantity: "rotation".to_owned(),
        unit: "rad",
        columns: bodies.len(),
        bodies,
        are_modes: false,
    })
}
