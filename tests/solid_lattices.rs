//! Boxes of cells in space with holes and sets: a thick sphere cut out of a lattice, against what its cells leave exactly and against Lame.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament::run::{NoObserver, Solution};
use ligament_case::case::CaseFile;
use ligament_model::thermal::ThermalStrain;
use verification::numbers::relative_error;
use verification::repository;

const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
const PRESSURE: f64 = 10e6;

fn sphere(cells: u32) -> Solution {
    let spacing = 2.0 * OUTER / f64::from(cells);
    let settings = [
        format!("solid_lattice.cells=[{cells}, {cells}, {cells}]"),
        format!("solid_lattice.spacing=[{spacing}, {spacing}, {spacing}]"),
    ];
    let path = repository().join("cases/lattice-sphere/case.toml");
    let case = CaseFile::load(&path, &settings).unwrap();
    let setup = case.setup(&mut ()).unwrap();
    setup.solve(&mut NoObserver).unwrap()
}

/// Centres of the cells of the box in a hole, on one axis of symmetry after the other: cells taken and left, and rows along an axis that the
/// hole takes cells from.
fn counted(cells: u32) -> [f64; 3] {
    let spacing = 2.0 * OUTER / f64::from(cells);
    let centre = |k: u32| (f64::from(k) + 0.5) * spacing - OUTER;
    let (mut taken, mut left, mut rows) = (0, 0, 0);
    for i in 0..cells {
        for j in 0..cells {
            let radius = |k: u32| centre(i).hypot(centre(j)).hypot(centre(k));
            let in_hole = (0..cells).filter(|&k| radius(k) < INNER).count();
            taken += in_hole;
            left += (0..cells)
                .filter(|&k| (INNER..OUTER).contains(&radius(k)))
                .count();
            rows += usize::from(in_hole > 0);
        }
    }
    [taken, left, rows].map(|it| it as f64)
}

/// Mean stress over the volume of a body in equilibrium is 1/V sum of F x. The pressure on the faces of a row of m cells that the hole takes
/// acts at the points of the cells at either end, m + 1 spacings apart: p (cells + rows)/(cells left) along each axis and no shear, to the
/// accuracy of the equilibrium (1e-10) and rounding.
#[test]
fn the_mean_stress_of_a_pressure_in_a_hole_is_exact() {
    let solution = sphere(16);
    let (state, system) = (&solution.outcome.state, &**solution.model.solid());
    let deformations = system.deformations(&state.intact, &state.displacement, ThermalStrain::NONE);
    let [taken, left, rows] = counted(16);
    assert_eq!(system.topology().n_points() as f64, left);
    let mut mean = [0.0; 6];
    for point in 0..system.topology().n_points() as u32 {
        let stress = system.stress(state.bonds(), &deformations, point);
        for (sum, component) in mean.iter_mut().zip(stress) {
            *sum += component / left;
        }
    }
    let expected = PRESSURE * (taken + rows) / left;
    // xx, yy, xy, zz, xz, yz.
    for (component, found) in mean.into_iter().enumerate() {
        let wanted = if [0, 1, 3].contains(&component) {
            expected
        } else {
            0.0
        };
        let off = (found - wanted).abs() / expected;
        assert!(off < 1e-9, "{component}: {found} for {wanted}");
    }
}

/// The volume by which the hole grows, 4 pi a^2 u(a) with Lame's u(a) = p a/(E (b^3 - a^3)) ((1 - 2 nu) a^3 + (1 + nu) b^3/2): points next
/// to a staircase stand half a cell and more inside of the sphere, so that its radius is off by less than a cell, and the volume by less than that
/// over the radius; on a finer lattice by less.
#[test]
fn a_thick_sphere_of_cells_grows_as_lame_says() {
    let (young, nu, a, b) = (30e9, 0.2, INNER, OUTER);
    let inward = PRESSURE * a / (young * (b.powi(3) - a.powi(3)))
        * ((1.0 - 2.0 * nu) * a.powi(3) + (1.0 + nu) * b.powi(3) / 2.0);
    let expected = 4.0 * std::f64::consts::PI * a * a * inward;
    let off = [16_u32, 24].map(|cells| {
        let solution = sphere(cells);
        let last = solution.outcome.history.last().unwrap();
        let off = relative_error(last.displacement, expected);
        let cell = 2.0 * OUTER / f64::from(cells) / a;
        println!("{cells} cells across: volume off by {off:.4}, a cell is {cell:.4}");
        assert!(off < cell, "{cells}: {off}");
        off
    });
    assert!(off[1] < off[0], "{off:?}");
}
