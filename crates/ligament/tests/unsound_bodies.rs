//! Bodies that no equation would refuse are refused with the place, the reason and advice.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament::body::SolidMeshBody;
use ligament::prelude::*;
use ligament_mesh::{Cell, Mesh, SolidCell, SolidMesh};

/// The number of cells along a side of a square plate.
const SIDE: u32 = 6;

/// A plate of cells with these sides, m, with `moved` places of its nodes.
fn plate(sides: [f64; 2], moved: impl Fn(&mut Vec<[f64; 2]>)) -> Setup {
    let n = SIDE + 1;
    let place = |k: u32| [f64::from(k % n) * sides[0], f64::from(k / n) * sides[1]];
    let mut positions: Vec<[f64; 2]> = (0..n * n).map(place).collect();
    moved(&mut positions);
    let cell = |k: u32| {
        let first = k / SIDE * n + k % SIDE;
        Cell::Quadrangle([first, first + 1, first + n + 1, first + n])
    };
    let mesh = Mesh {
        node_tags: (1..=u64::from(n * n)).collect(),
        positions,
        cells: (0..SIDE * SIDE).map(cell).collect(),
        ..Mesh::default()
    };
    let left = Place::Box([[-1.0, -1.0, 0.0], [1e-3 * sides[0], 1e3, 0.0]]);
    let mut setup = Setup::new(
        MeshBody::from(mesh),
        Material::isotropic(15e9, 1.0 / 3.0),
        Law::NHPD,
    );
    setup.supports = vec![Support::new(left, &[Component::X, Component::Y])];
    setup.loads = vec![Load::new(
        Place::At([6.0 * sides[0], 3.0 * sides[1], 0.0]),
        Action::Force([1.0, 0.0, 0.0]),
    )];
    setup
}

fn error(setup: Setup) -> String {
    setup.solve(&mut NoObserver).unwrap_err().to_string()
}

#[test]
fn the_plate_itself_is_right() {
    let solution = plate([0.01; 2], |_| ()).solve(&mut NoObserver).unwrap();
    assert!(solution.outcome.history.last().unwrap().displacement > 0.0);
}

/// Corners of cells that nearly coincide: their bond would be a hundred million times as stiff as the others.
#[test]
fn points_that_nearly_coincide_are_named() {
    let found = error(plate([0.01; 2], |places| places[24] = [0.04 - 1e-10, 0.03]));
    assert!(
        found.starts_with("body: node 25 at (0.040000, 0.030000) and node 26 at (0.040000, 0.030000) are only 1.0e-10 m apart"),
        "{found}"
    );
    assert!(found.contains("merge them"), "{found}");
}

/// Cells three and a half times as long as high, with horizons of three heights: the body falls into its columns.
#[test]
fn cells_longer_than_the_horizon_are_refused() {
    let found = error(plate([0.035, 0.01], |_| ()));
    assert!(
        found.starts_with(
            "horizon: the bonds connect 7 separate parts, but the cells form 1: from node "
        ),
        "{found}"
    );
    assert!(
        found.contains("(direction 1.00, 0.00)")
            && found.contains("need a horizon factor above 3.50;"),
        "{found}"
    );
    let mut wider = plate([0.035, 0.01], |_| ());
    wider.horizon = Horizon::Factor(3.6);
    wider.solve(&mut NoObserver).unwrap();
}

#[test]
fn a_position_off_the_body_is_refused() {
    let mut setup = plate([0.01; 2], |_| ());
    setup.loads[0].place = Place::At([5.0, 5.0, 0.0]);
    assert_eq!(
        error(setup),
        "loads[0].place: (5.000000, 5.000000) is not on the body: the nearest point, node 49 at (0.060000, 0.060000), is 6.986e0 m away"
    );
    // Half a cell outside is still meant for the corner.
    let mut setup = plate([0.01; 2], |_| ());
    setup.loads[0].place = Place::At([0.065, 0.065, 0.0]);
    setup.solve(&mut NoObserver).unwrap();
}

#[test]
fn a_section_that_no_bond_crosses_is_refused() {
    let with_section = |[start, end]: [[f64; 2]; 2]| {
        let line = [start, end].map(|[x, y]| [x, y, 0.0]);
        let mut setup = plate([0.01; 2], |_| ());
        setup.probes = vec![Probe {
            name: "section".to_owned(),
            reading: Reading::Section {
                line,
                component: ligament::setup::Axis::X,
            },
        }];
        setup
    };
    assert_eq!(
        error(with_section([[0.2, 0.0], [0.2, 0.1]])),
        "probes[0].reading: no bond crosses this line, so the force through it would always be 0 N"
    );
    let crossed = with_section([[0.025, -0.01], [0.025, 0.07]]);
    crossed.solve(&mut NoObserver).unwrap();
}

#[test]
fn a_horizon_as_large_as_the_body_is_told() {
    let warned = |factor: f64| {
        let mut setup = plate([0.01; 2], |_| ());
        setup.horizon = Horizon::Factor(factor);
        let warnings = setup.solve(&mut NoObserver).unwrap().model.warnings;
        warnings.iter().any(|it| it.kind == "large-horizon")
    };
    assert!(!warned(2.5));
    assert!(warned(4.0));
}

/// Sizes and stiffnesses whose products are out of the range of numbers.
#[test]
fn what_numbers_cannot_hold_is_refused() {
    let with_young = |young: f64| {
        let mut setup = plate([0.01; 2], |_| ());
        setup.materials[0].material = Material::isotropic(young, 1.0 / 3.0);
        error(setup)
    };
    for found in [
        with_young(1e300),
        with_young(1e-300),
        error(plate([1e-90; 2], |_| ())),
    ] {
        assert!(
            found.starts_with("materials: the stif") && found.contains("out of all proportion"),
            "{found}"
        );
    }
    let solution = plate([1e-40; 2], |_| ()).solve(&mut NoObserver).unwrap();
    assert!(solution.outcome.elastic_stiffness.is_finite());
}

/// Solid of hexahedra between layers of four nodes.
fn solid(positions: Vec<[f64; 3]>, layers_of_cells: &[[u32; 2]], factor: f64) -> Setup {
    let cell = |&[lower, upper]: &[u32; 2]| {
        let node = |k: u32| 4 * [lower, upper][k as usize / 4] + k % 4;
        SolidCell::Hexahedron(std::array::from_fn(|k| node(k as u32)))
    };
    let mesh = SolidMesh {
        node_tags: (1..=positions.len() as u64).collect(),
        positions,
        cells: layers_of_cells.iter().map(cell).collect(),
        ..SolidMesh::default()
    };
    let material = Material::isotropic(1e9, 0.2);
    let mut setup = Setup::new(SolidMeshBody::from(mesh), material, Law::NHPD);
    setup.horizon = Horizon::Factor(factor);
    let lowest = Place::Box([[-1.0, -1.0, -1e-3], [2.0, 2.0, 1e-3]]);
    setup.supports = vec![Support::new(
        lowest,
        &[Component::X, Component::Y, Component::Z],
    )];
    setup.loads = vec![Load::new(
        Place::At([0.0, 0.0, 1.0]),
        Action::Force([1.0, 0.0, 0.0]),
    )];
    setup
}

/// The corners of a face of a brick of 1 m.
fn layer([x, y, z]: [f64; 3]) -> [[f64; 3]; 4] {
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[a, b]| [x + a, y + b, z])
}

/// Two bricks on each other, of 1 m and of another height.
fn tower(height: f64, factor: f64) -> Setup {
    let layers = [0.0, 1.0, 1.0 + height].map(|z| layer([0.0, 0.0, z]));
    solid(layers.concat(), &[[0, 1], [1, 2]], factor)
}

#[test]
fn long_edges_tear_a_solid() {
    let found = error(tower(3.0, 1.5));
    assert!(
        found.contains("the bonds connect 2 separate parts, but the cells form 1")
            && found.contains("need a horizon factor above 3.00;"),
        "{found}"
    );
    tower(3.0, 3.1).solve(&mut NoObserver).unwrap();
}

#[test]
fn points_of_a_solid_that_nearly_coincide_are_named() {
    let found = error(tower(2e-6, 3.0));
    assert!(
        found.starts_with("body: node 5 at") && found.contains("are only 2.0e-6 m apart"),
        "{found}"
    );
    tower(0.01, 3.0).solve(&mut NoObserver).unwrap();
}

/// Two bricks without a common node; the second begins at this height, and beside the first in x and y.
#[test]
fn bricks_in_each_other_are_found() {
    let fault_at = |z: f64| {
        let layers = [
            layer([0.0; 3]),
            layer([0.0, 0.0, 1.0]),
            layer([0.5, 0.3, z]),
            layer([0.5, 0.3, z + 1.0]),
        ];
        let setup = solid(layers.concat(), &[[0, 1], [2, 3]], 3.0);
        let found = Model::build(setup, &mut ()).err();
        found.map(|error| *error.fault)
    };
    let inside = fault_at(0.4);
    assert!(matches!(inside, Some(Fault::Overlap { .. })), "{inside:?}");
    let above = fault_at(1.1);
    assert!(!matches!(above, Some(Fault::Overlap { .. })), "{above:?}");
}
