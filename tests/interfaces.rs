//! Two halves in series and in parallel, and layers between halves, against the closed form, at any ratio of their stiffnesses.
//!
//! All points are held across the load, so that each half has one strain and the stiffness C = E/(1 - nu^2). In series, with halves of the
//! length L/2, F = A u/(L/2 (1/C_1 + 1/C_2)); in parallel the forces add.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament::body::SolidMeshBody;
use ligament::prelude::*;
use ligament::setup::{MaterialRegion, Surface};
use ligament_mesh::{Cell, Group, Mesh, SolidCell, SolidMesh};
use ligament_model::Canvas;
use ligament_model::correction::patch::{Reference, Settings};
use verification::meshes;
use verification::solids::block;

const LENGTH: f64 = 0.1;
const HEIGHT: f64 = 0.05;
const PULLED: f64 = 1e-5;

/// Stiffness C_11 of the stiff half over that of the soft one.
const RATIOS: [f64; 4] = [1.0, 100.0, 1e3, 1e6];

/// A body of halves "left-half" and "right-half" with sides "left" and "right".
fn halved(body: impl Into<AnyBody>, law: Law, poisson: f64, ratio: f64) -> Setup {
    let mut setup = Setup::new(body, Material::isotropic(1.0, poisson), law);
    let half = |group: &str, young: f64| MaterialRegion {
        group: Some(group.to_owned()),
        material: Material::isotropic(young, poisson),
    };
    setup.materials = vec![half("left-half", 1.0), half("right-half", ratio)];
    setup
}

fn along_x(value: f64) -> Action {
    Action::Displacement(Displacement {
        x: Some(value),
        ..Displacement::default()
    })
}

fn along_y(value: f64) -> Action {
    Action::Displacement(Displacement {
        y: Some(value),
        ..Displacement::default()
    })
}

/// Reaction of the halves pulled apart along x.
fn in_series(mut setup: Setup) -> f64 {
    setup.supports = vec![
        Support::new("left", &[Component::X]),
        Support::new(Place::Everywhere, &[Component::Y]),
    ];
    setup.loads = vec![Load::new("right", along_x(PULLED))];
    reaction(setup)
}

/// Reaction of the halves pulled along y, between the points below and above.
fn in_parallel(mut setup: Setup) -> f64 {
    let slice = |from: f64, to: f64| Place::Box([[-1.0, from, 0.0], [1.0, to, 0.0]]);
    let slack = 1e-6;
    setup.supports = vec![
        Support::new(slice(-slack, slack), &[Component::Y]),
        Support::new(Place::Everywhere, &[Component::X]),
    ];
    let above = slice(HEIGHT - slack, HEIGHT + slack);
    setup.loads = vec![Load::new(above, along_y(PULLED))];
    reaction(setup)
}

fn reaction(setup: Setup) -> f64 {
    let history = setup.solve(&mut NoObserver).unwrap().outcome.history;
    history.last().unwrap().reaction.abs()
}

/// The patch correction with the factors that it departs from.
fn patch_from(reference: Reference) -> Surface {
    Surface::Patch(Settings {
        reference,
        ..Settings::default()
    })
}

/// C_11 of Young's modulus 1 with the Poisson's ratio of the law.
fn modulus(poisson: f64) -> f64 {
    1.0 / (1.0 - poisson * poisson)
}

/// Within 1 % in series and 0.5 % in parallel, at lambda = 2 to 4 on ten cells a half; measured 0.1 and 0.4 % at most.
#[test]
fn halves_of_a_mesh_at_any_ratio() {
    let laws = [
        (Law::NHPD, 0.0),
        (Law::NHPD, 0.2),
        (Law::BBPD, 1.0 / 3.0),
        (Law::PDS, 0.2),
        (Law::ORTHOTROPIC, 0.2),
    ];
    let body = || MeshBody::from(meshes::read("meshes/bimaterial.msh"));
    for (law, poisson) in laws {
        for ratio in RATIOS {
            for (lambda, reference) in [
                (2.0, Reference::Body),
                (3.0, Reference::Body),
                (3.0, Reference::Families),
                (4.0, Reference::Body),
            ] {
                let setup = || {
                    let mut setup = halved(body(), law, poisson, ratio);
                    setup.correction.surface = patch_from(reference);
                    setup.horizon = Horizon::Factor(lambda);
                    setup
                };
                let c = modulus(poisson);
                let series = c * HEIGHT * PULLED / (0.5 * LENGTH * (1.0 + 1.0 / ratio));
                let parallel = c * (1.0 + ratio) * 0.5 * LENGTH * PULLED / HEIGHT;
                let found = [in_series(setup()) / series, in_parallel(setup()) / parallel];
                assert!(
                    (found[0] - 1.0).abs() < 0.01 && (found[1] - 1.0).abs() < 5e-3,
                    "{law:?} {poisson}, ratio {ratio}, lambda {lambda}, {reference:?}: {found:?}"
                );
            }
        }
    }
}

/// The elements of `mbb-pd` and the bonds of a patched law on a lattice, whose points are all of one material: within 2 % of what equal
/// halves give, which is 2.2 % too stiff for `mbb-pd` because its elements at the ends are wider than the bar. Measured 1.3 and 0.8 %.
#[test]
fn halves_of_a_lattice_at_any_ratio() {
    let side = LENGTH / 40.0;
    let full = Law::MBB_PD;
    for law in [full, Law::NHPD] {
        let off = |ratio: f64| {
            let mut setup = halved(meshes::halved_lattice(LENGTH), law, 0.2, ratio);
            if law == Law::NHPD {
                setup.correction.surface = Surface::Patch(Settings::default());
            }
            // From the middle of the first cells to the middle of the last.
            let length = 0.5 * (LENGTH - side);
            in_series(setup) * length * (1.0 + 1.0 / ratio) / (modulus(0.2) * HEIGHT * PULLED)
        };
        let equal = off(RATIOS[0]);
        assert!((equal - 1.0).abs() < 0.03, "{law:?}: {equal}");
        for ratio in &RATIOS[1..] {
            let found = off(*ratio) / equal;
            assert!(
                (found - 1.0).abs() < 0.02,
                "{law:?}, ratio {ratio}: {found}"
            );
        }
    }
}

/// Cells of the layered bodies along x, y and z, each of unit size.
const CELLS: [u32; 3] = [14, 6, 6];

/// The first cell along x behind the left half.
const LAYER: u32 = 6;

/// Groups "half" and "layer" of the cells of which the first number says whether they lie in a layer, so many cells thick, and "left" and
/// "right" of the nodes at both ends.
fn layered(dimension: u8, is_in_layer: &[bool], along: &[f64]) -> Vec<Group> {
    let cells = |wanted: bool| {
        let numbered = (0..).zip(is_in_layer);
        numbered
            .filter(|(_, is_in)| **is_in == wanted)
            .map(|it| it.0)
            .collect()
    };
    let at = |wanted: f64| {
        let numbered = (0..).zip(along);
        numbered
            .filter(|(_, x)| (**x - wanted).abs() < 1e-9)
            .map(|it| it.0)
            .collect()
    };
    let group = |name: &str, number, dimension, nodes, cells| Group {
        name: name.to_owned(),
        dimension,
        number,
        nodes,
        edges: Vec::new(),
        faces: Vec::new(),
        cells,
    };
    vec![
        group("left", 1, 0, at(0.0), Vec::new()),
        group("right", 2, 0, at(f64::from(CELLS[0])), Vec::new()),
        group("half", 3, dimension, Vec::new(), cells(false)),
        group("layer", 4, dimension, Vec::new(), cells(true)),
    ]
}

/// A strip of quadrangles and triangles, their nodes inside moved along y without a pattern.
fn layered_strip(thick: u32) -> Mesh {
    let [nx, ny, _] = CELLS;
    let node = |i: u32, j: u32| j * (nx + 1) + i;
    let places = (0..(nx + 1) * (ny + 1)).map(|k| {
        let (i, j) = (k % (nx + 1), k / (nx + 1));
        let is_inside = j > 0 && j < ny;
        let moved = 0.15 * (f64::from(k) * 12.9898).sin() * f64::from(u8::from(is_inside));
        [f64::from(i), f64::from(j) + moved]
    });
    let positions: Vec<[f64; 2]> = places.collect();
    let mut cells = Vec::new();
    let mut is_in_layer = Vec::new();
    for k in 0..nx * ny {
        let (i, j) = (k % nx, k / nx);
        let [a, b, c, d] = [
            node(i, j),
            node(i + 1, j),
            node(i + 1, j + 1),
            node(i, j + 1),
        ];
        let of_place = match k % 3 {
            0 => vec![Cell::Quadrangle([a, b, c, d])],
            1 => vec![Cell::Triangle([a, b, c]), Cell::Triangle([a, c, d])],
            _ => vec![Cell::Triangle([a, b, d]), Cell::Triangle([b, c, d])],
        };
        is_in_layer.extend(of_place.iter().map(|_| (LAYER..LAYER + thick).contains(&i)));
        cells.extend(of_place);
    }
    let along: Vec<f64> = positions.iter().map(|it| it[0]).collect();
    Mesh {
        node_tags: (1..=positions.len() as u64).collect(),
        groups: layered(2, &is_in_layer, &along),
        positions,
        cells,
        fields: Vec::new(),
        remarks: Vec::new(),
    }
}

/// A block of tetrahedra.
fn layered_block(thick: u32) -> SolidMesh {
    let grid = block(CELLS.map(|it| it as usize), 0.0);
    let Canvas::Solid(cells) = grid.canvas else {
        unreachable!("a block is of solid cells")
    };
    let cells: Vec<SolidCell> = (cells.iter())
        .flat_map(|cell| cell.tetrahedra().map(SolidCell::Tetrahedron))
        .collect();
    let is_in_layer = cells.iter().map(|cell| {
        let corners = cell.corners();
        let places = corners.iter().map(|&node| grid.positions[node as usize][0]);
        let middle = places.sum::<f64>() / corners.len() as f64;
        (f64::from(LAYER)..f64::from(LAYER + thick)).contains(&middle)
    });
    let is_in_layer: Vec<bool> = is_in_layer.collect();
    let along: Vec<f64> = grid.positions.iter().map(|it| it[0]).collect();
    SolidMesh {
        node_tags: (1..=grid.positions.len() as u64).collect(),
        groups: layered(3, &is_in_layer, &along),
        positions: grid.positions,
        cells,
        ..SolidMesh::default()
    }
}

/// A body of a layer between halves, its ends pulled apart, all points held across.
fn with_layer(
    body: impl Into<AnyBody>,
    law: Law,
    [half, layer]: [Material; 2],
    across: &[Component],
) -> Setup {
    let mut setup = Setup::new(body, half.clone(), law);
    let region = |group: &str, material: Material| MaterialRegion {
        group: Some(group.to_owned()),
        material,
    };
    setup.materials = vec![region("half", half), region("layer", layer)];
    setup.correction.surface = Surface::Patch(Settings::default());
    setup.supports = vec![
        Support::new("left", &[Component::X]),
        Support::new(Place::Everywhere, across),
    ];
    setup.loads = vec![Load::new("right", along_x(PULLED))];
    setup
}

/// Force of a layer between halves, which all have the stiffness C along x but for the factor on that of the layer, for a section of area A:
/// A u/(L_half/C_half + L_layer/C_layer).
fn force_through(area: f64, stiffness: f64, thick: u32, ratio: f64) -> f64 {
    let (layer, all) = (f64::from(thick), f64::from(CELLS[0]));
    area * PULLED * stiffness / (all - layer + layer / ratio)
}

/// Layers of one to four cells, soft and stiff, within 3.5 %; measured 3.4 % at most, for one cell of a ten-thousandth (`orthotropic`).
/// Where bonds are those of their ends, a layer of one cell with a hundredth of the stiffness is 10 % too stiff, and one with a ten-thousandth
/// 94 times.
#[test]
fn layers_between_halves_of_a_mesh() {
    let bbpd = Law::BBPD;
    let orthotropic = Law::ORTHOTROPIC;
    for (law, poisson) in [(Law::NHPD, 0.2), (bbpd, 1.0 / 3.0), (orthotropic, 0.2)] {
        for ratio in [1e-4, 0.01, 0.1, 10.0, 100.0] {
            for thick in [1, 2, 4] {
                let materials = [1.0, ratio].map(|young| Material::isotropic(young, poisson));
                let body = MeshBody::from(layered_strip(thick));
                let mut setup = with_layer(body, law, materials, &[Component::Y]);
                let expected = force_through(f64::from(CELLS[1]), modulus(poisson), thick, ratio);
                for reference in [Reference::Body, Reference::Families] {
                    setup.correction.surface = patch_from(reference);
                    let found = reaction(setup.clone()) / expected;
                    assert!(
                        (found - 1.0).abs() < 0.035,
                        "{law:?}, ratio {ratio}, {thick} cells, {reference:?}: {found}"
                    );
                }
            }
        }
    }
}

/// The setup with its ends moved along y against each other, all points held along the other axes: the layer and the halves are sheared.
fn sheared(mut setup: Setup, others: &[Component]) -> Setup {
    setup.supports = vec![
        Support::new("left", &[Component::Y]),
        Support::new(Place::Everywhere, others),
    ];
    setup.loads = vec![Load::new("right", along_y(PULLED))];
    setup
}

/// Shear modulus of Young's modulus 1.
fn shear_modulus(poisson: f64) -> f64 {
    0.5 / (1.0 + poisson)
}

/// Layers of one to four cells that are pulled and sheared, where the points of the halves do not turn with the layer: within 3 %; measured
/// 2.4 % at most. Bonds with the exchange of bonds in all directions make a sheared layer of one cell under `mppd` 7 % too stiff at nu = 0.2,
/// and 11 % at nu = 0; without an exchange it is twice as stiff.
#[test]
fn layers_between_halves_of_a_mesh_that_do_not_turn() {
    let (nhpd, mppd) = (Law::NHPD, Law::MPPD);
    for (law, poisson) in [(nhpd, 0.2), (nhpd, 0.0), (mppd, 0.2), (mppd, 0.0)] {
        for ratio in [1e-4, 0.01, 0.1, 10.0] {
            for thick in [1, 2, 4] {
                let materials = [1.0, ratio].map(|young| Material::isotropic(young, poisson));
                let body = MeshBody::from(layered_strip(thick));
                let setup = with_layer(body, law, materials, &[Component::Y]);
                let force =
                    |modulus: f64| force_through(f64::from(CELLS[1]), modulus, thick, ratio);
                let pulled = reaction(setup.clone()) / force(modulus(poisson));
                let sheared = reaction(sheared(setup, &[Component::X]));
                let found = [pulled, sheared / force(shear_modulus(poisson))];
                assert!(
                    found.iter().all(|it| (it - 1.0).abs() < 0.03),
                    "{law:?}, {poisson}, ratio {ratio}, {thick} cells: {found:?}"
                );
            }
        }
    }
}

/// Layers in space, pulled and sheared, within 3.5 %; measured 3.1 % for a pulled one of one cell at nu = 0.2, where the correction alone leaves
/// 2.3 %. With the exchange of bonds in all directions a sheared layer of one cell is 5 % too stiff; without an exchange it is twice as stiff at
/// nu = 0, and a pulled one, of bonds that are those of their ends, 1.6 times.
#[test]
fn layers_between_halves_of_a_solid() {
    let found = |setup: Setup| {
        let history = setup.solve(&mut NoObserver).unwrap().outcome.history;
        history.last().unwrap().reaction.abs()
    };
    for (poisson, ratio) in [(0.2, 1e-4), (0.0, 1e-4), (0.0, 0.01), (0.2, 10.0)] {
        for thick in [1, 2] {
            let materials = [1.0, ratio].map(|young| Material::isotropic(young, poisson));
            let body = SolidMeshBody::from(layered_block(thick));
            let across = [Component::Y, Component::Z];
            let mut setup = with_layer(body, Law::NHPD, materials, &across);
            setup.correction.surface = Surface::Patch(Settings::default());
            let area = f64::from(CELLS[1] * CELLS[2]);
            // E (1 - nu)/((1 + nu)(1 - 2 nu)) of E = 1.
            let modulus = (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
            let pulled = force_through(area, modulus, thick, ratio);
            let in_shear = force_through(area, shear_modulus(poisson), thick, ratio);
            let others = [Component::X, Component::Z];
            let found = [
                found(setup.clone()) / pulled,
                found(sheared(setup, &others)) / in_shear,
            ];
            assert!(
                found.iter().all(|it| (it - 1.0).abs() < 0.035),
                "{poisson}, ratio {ratio}, {thick} cells: {found:?}"
            );
        }
    }
}
