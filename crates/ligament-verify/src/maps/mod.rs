//! Maps of displacements, rotations and natural modes, lattices compared with finite elements (MPPD Figs 12 to 24, OMPPD Figs 9 to 23), and
//! of damage (NHPD Figs 10 to 24, MBB-PD Figs 14 to 17).

mod drawing;
mod fractures;
mod intact;
mod laminas;
mod squares;

use super::experiment::{Compute, Experiment, Findings};
use super::published::known_table;
use super::readings::{BENDING, SHEAR, TRACTION};
use super::table::Extent;
use super::tension;
use drawing::Motion;

/// Experiment that draws the maps of the papers.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "maps",
    title: "Maps of displacements, modes and damage",
    source: "Diana and Casolo (MPPD), Figs 12 to 24; (OMPPD), Figs 9, 11 to 15, 19 to 23; Zhang, Yang and \
             Zhuang (NHPD), Figs 10 to 12, 15, 16, 18 to 20, 24; Masoumi, Ravandi and Salehi (MBB-PD), Figs 9 to 11, 14, 16, 17",
    setup: "The plates of the tables of MPPD and the laminas of the tables of OMPPD, and our own finite elements of the same \
            bodies, drawn with the same colours and the same magnification. Of the plates, the lattice is compared with the \
            elements at all points, both without their rigid motion: displacements by the L2 norm of their difference over \
            that by finite elements, modes by the square of the cosine between both (the modal assurance criterion). Damage is drawn \
            after shares of the breakages of the tests of `disk`, `slots`, `inclined` and `cracks`, on the bodies without their \
            displacements.",
    cases: &[
        TRACTION,
        SHEAR,
        BENDING,
        squares::MODES,
        tension::CASE,
        laminas::MODES,
    ],
    compute: Compute::Code(compute),
};

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut squares = squares::Squares::default();
    let displacements = known_table("maps-displacements")?.judge(extent, |labels| {
        let (load, ratio) = (labels.text("load")?, labels.number("nu")?);
        let elements = squares.elements(load, ratio)?;
        let lattice = squares.lattice(load, ratio, labels.text("model")?)?;
        Ok(100.0 * lattice.difference(&elements))
    })?;
    let modes = known_table("maps-modes")?.judge(extent, |labels| {
        let ratio = labels.number("nu")?;
        let place = squares::place_of_mode(labels.text("mode")?)?;
        let elements = squares.modes_of_elements(ratio)?;
        let lattice = squares.modes_of_lattice(ratio, labels.text("model")?)?;
        Ok(lattice[place].assurance(&elements[place]))
    })?;
    let mut findings = Findings {
        tables: vec![displacements, modes],
        ..Findings::default()
    };
    if extent == Extent::Full {
        findings.maps = squares.maps()?;
        findings.maps.extend(laminas::maps()?);
        findings.maps.extend(intact::maps()?);
        findings.maps.extend(fractures::maps()?);
    }
    Ok(findings)
}
