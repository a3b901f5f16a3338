//! An elastic plate from arrays: 40 by 20 points, held on the left and pulled on the right.

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use ligament::prelude::*;

const SIZE: f64 = 0.05;

/// The plate under a force of 1 kN.
fn plate() -> Result<Solution, Box<dyn std::error::Error>> {
    let position = |k: u32| [k % 40, k / 40].map(|it| (f64::from(it) + 0.5) * SIZE);
    let points = Points::new((0..800).map(position).collect(), vec![SIZE * SIZE; 800])?
        .with_group("left", (0..800).filter(|k| k % 40 == 0))?
        .with_group("right", (0..800).filter(|k| k % 40 == 39))?;
    let law = Law::BBPD;
    let mut setup = Setup::new(points, Material::isotropic(210e9, 1.0 / 3.0), law);
    setup.supports = vec![Support::new("left", &[Component::X, Component::Y])];
    setup.loads = vec![Load::new("right", Action::Force([1e3, 0.0, 0.0]))];
    Ok(setup.solve(&mut NoObserver)?)
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let last = plate()?.outcome.history.pop().ok_or("no solution")?;
    let bar = 1e3 * 1.95 / 210e9;
    println!(
        "longer by {:.4e} m; a bar would be by {bar:.4e} m",
        last.displacement
    );
    assert!((last.displacement / bar - 1.0).abs() < 0.1);
    Ok(())
}
