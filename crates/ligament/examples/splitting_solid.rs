//! A solid bar from arrays, 12 by 5 by 5 points: it is pulled apart, and the crack goes across it.

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ligament::prelude::*;

const SIZE: f64 = 0.01;
const CELLS: [u32; 3] = [12, 5, 5];

/// The bar under an extension of 0.1 mm in 12 steps; its ends do not break.
fn bar() -> Result<Solution, Box<dyn std::error::Error>> {
    let [nx, ny, nz] = CELLS;
    let n = nx * ny * nz;
    let place = |k: u32| [k % nx, k / nx % ny, k / (nx * ny)];
    let position = |k: u32| place(k).map(|it| (f64::from(it) + 0.5) * SIZE);
    let points = Points::new(
        (0..n).map(position).collect(),
        vec![SIZE.powi(3); n as usize],
    )?
    .with_group("left", (0..n).filter(|k| place(*k)[0] < 2))?
    .with_group("right", (0..n).filter(|k| place(*k)[0] >= nx - 2))?;
    let material = Material {
        tensile_strength: Some(3e6),
        ..Material::isotropic(30e9, 0.2)
    };
    let mut setup = Setup::new(points, material, Law::NHPD);
    let all = [Component::X, Component::Y, Component::Z];
    setup.supports = vec![Support::new("left", &all)];
    let right = Displacement {
        x: Some(1e-4),
        ..Displacement::default()
    };
    setup.loads = vec![Load::new("right", Action::Displacement(right))];
    setup.no_fail = vec!["left".into(), "right".into()];
    setup.criteria = vec![STRENGTH.into()];
    let steps = (1..=12).map(|step| f64::from(step) / 12.0).collect();
    setup.analysis = Analysis::Stepped(stepped(steps));
    Ok(setup.solve(&mut NoObserver)?)
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let solution = bar()?;
    for row in &solution.outcome.history {
        let (moved, force) = (row.displacement, row.reaction);
        println!(
            "{moved:.3e} m, {force:.4e} N, {} bonds broken",
            row.broken_bonds
        );
    }
    let last = solution.outcome.history.last().ok_or("no history")?;
    assert!(last.broken_bonds > 50 && last.fragments > 1);
    Ok(())
}
