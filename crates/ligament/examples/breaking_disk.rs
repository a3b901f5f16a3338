//! A disk from a Gmsh mesh between two platens: it is pressed until it breaks, and the history is printed.

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ligament::prelude::*;

const MESH: &[u8] = include_bytes!("disk-4mm.msh");

/// The disk under a shortening of 0.4 mm in 50 steps, or until the load falls.
fn disk() -> Result<Solution, Box<dyn std::error::Error>> {
    let material = Material {
        tensile_strength: Some(3.81e6),
        ..Material::isotropic(15e9, 0.21)
    };
    let mut setup = Setup::new(MeshBody::from(gmsh::parse(MESH)?), material, Law::NHPD);
    setup.supports = vec![
        Support::new("platen-bottom", &[Component::Y]),
        Support::new("pole-bottom", &[Component::X]),
        Support::new("pole-top", &[Component::X]),
    ];
    let down = Displacement {
        y: Some(-4e-4),
        ..Displacement::default()
    };
    setup.loads = vec![Load::new("platen-top", Action::Displacement(down))];
    setup.criteria = vec![STRENGTH.into()];
    let mut steps = stepped((1..=50).map(|step| f64::from(step) / 50.0).collect());
    steps.stop.load_fraction = Some(0.9);
    setup.analysis = Analysis::Stepped(steps);
    Ok(setup.solve(&mut NoObserver)?)
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let outcome = disk()?.outcome;
    println!("displacement (m), force (N), broken bonds");
    for row in &outcome.history {
        println!(
            "{:.3e}, {:.4e}, {}",
            row.displacement, row.reaction, row.broken_bonds
        );
    }
    println!("{}", outcome.termination);
    let last = outcome.history.last().ok_or("no history")?;
    let peak = (outcome.history.iter()).fold(0.0, |peak: f64, row| peak.max(row.reaction.abs()));
    assert!(last.broken_bonds > 100 && last.reaction.abs() < 0.9 * peak);
    Ok(())
}
