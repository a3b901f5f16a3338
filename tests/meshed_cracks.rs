//! Cracks that are in the mesh, as doubled nodes: which bonds there are, against a geometric test in which the nodes of the two faces lie a little
//! below and above the crack.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament::Model;
use ligament::prelude::*;
use ligament::setup::{CrackShape, PreCrack};
use ligament_mesh::{Cell, Group, Mesh, MeshCell, SolidCell, SolidMesh};
use ligament_model::bonds::outline::{
    Outline, PlaneOutline, SolidOutline, bonds_outside, spacing_inside,
};
use ligament_model::bonds::precrack::Ends;
use ligament_model::{BondSet, Horizons, PointCloud};
use verification::meshes;

/// Cells along each side of the body, which have unit size; the crack lies at half height, from one side to the middle.
const N: u32 = 6;
const HALF: f64 = 0.5 * N as f64;

/// Nodes of a grid in D dimensions, and behind them those of the upper face of the crack, with the number in the grid of each.
fn places<const D: usize>() -> (Vec<[f64; D]>, Vec<u32>) {
    let row = N + 1;
    let numbers = 0..row.pow(D as u32);
    let at = |number: u32| -> [f64; D] {
        std::array::from_fn(|axis| f64::from(number / row.pow(axis as u32) % row))
    };
    let on_face = numbers
        .clone()
        .filter(|&it| at(it)[D - 1] == HALF && at(it)[0] < HALF);
    let all: Vec<u32> = numbers.clone().chain(on_face).collect();
    (all.iter().map(|&it| at(it)).collect(), all)
}

/// The corner of a cell of the grid with the node of its own side of the crack.
fn corner(number: u32, is_above: bool, numbers: &[u32]) -> u32 {
    let doubled = numbers.iter().rposition(|it| *it == number).unwrap() as u32;
    if is_above { doubled } else { number }
}

fn squares() -> Mesh {
    let (positions, numbers) = places::<2>();
    let cells = (0..N * N).flat_map(|k| {
        let (x, y) = (k % N, k / N);
        let is_above = f64::from(y) >= HALF;
        let node = |x: u32, y: u32| corner(y * (N + 1) + x, is_above, &numbers);
        let [a, b, c, d] = [
            node(x, y),
            node(x + 1, y),
            node(x + 1, y + 1),
            node(x, y + 1),
        ];
        match k % 2 {
            0 => vec![Cell::Quadrangle([a, b, c, d])],
            _ => vec![Cell::Triangle([a, b, c]), Cell::Triangle([a, c, d])],
        }
    });
    Mesh {
        node_tags: (1..=positions.len() as u64).collect(),
        cells: cells.collect(),
        positions,
        ..Mesh::default()
    }
}

fn cubes(is_cut: bool) -> SolidMesh {
    let (positions, numbers) = places::<3>();
    let cells = (0..N * N * N).flat_map(|k| {
        let [x, y, z] = [k % N, k / N % N, k / (N * N)];
        let is_above = f64::from(z) >= HALF;
        let node =
            |x: u32, y: u32, z: u32| corner((z * (N + 1) + y) * (N + 1) + x, is_above, &numbers);
        let layer = |z: u32| {
            [
                node(x, y, z),
                node(x + 1, y, z),
                node(x + 1, y + 1, z),
                node(x, y + 1, z),
            ]
        };
        let ([a, b, c, d], [e, f, g, h]) = (layer(z), layer(z + 1));
        let whole = SolidCell::Hexahedron([a, b, c, d, e, f, g, h]);
        match is_cut {
            true => whole.tetrahedra().map(SolidCell::Tetrahedron).collect(),
            false => vec![whole],
        }
    });
    SolidMesh {
        node_tags: (1..=positions.len() as u64).collect(),
        cells: cells.collect(),
        positions,
        ..SolidMesh::default()
    }
}

/// Checks the bonds of a body with a crack, and the nearest distances that they see.
fn check<const D: usize, C: MeshCell<D>, O: Outline<D>>(
    cloud: &PointCloud<D>,
    (outline, cells): (&O, &[C]),
) {
    let n_grid = (N + 1).pow(D as u32);
    let bonds = BondSet::search(cloud, &Horizons::unified(2.3, cloud.len()));
    let side = |point: u32| {
        let local = cloud.positions[point as usize];
        let place: [f64; D] = std::array::from_fn(|axis| local[axis] + cloud.origin[axis]);
        let (x, height) = (place[0], place[D - 1] - HALF);
        let on_face = height == 0.0 && x < HALF;
        let moved = if point < n_grid { -1e-9 } else { 1e-9 };
        [x, if on_face { moved } else { height }]
    };
    let mut counts = [0; 2];
    let outside = bonds_outside(outline, &bonds, cloud);
    for (ends, found) in bonds.ends.iter().zip(outside) {
        let [[xa, a], [xb, b]] = ends.map(side);
        // Where the line of the bond passes the height of the crack.
        let x = xa + (xb - xa) * a / (a - b);
        let wanted = a * b < 0.0 && x < HALF - 1e-8;
        assert_eq!(found, wanted, "{:?} {:?}", side(ends[0]), side(ends[1]));
        counts[usize::from(found)] += 1;
    }
    assert!(counts[0] > 300 && counts[1] > 50, "{counts:?}");
    let spacing = spacing_inside(outline, cells, cloud);
    assert!(spacing.iter().all(|it| *it == 1.0), "{spacing:?}");
}

#[test]
fn no_bond_crosses_a_crack_in_the_mesh() {
    let mesh = squares();
    let cloud = PointCloud::from_mesh(&mesh, 1.0, &vec![0; mesh.cells.len()], 1);
    check(
        &cloud,
        (&PlaneOutline::from_cells(&mesh.cells, &cloud), &mesh.cells),
    );
    for is_cut in [false, true] {
        let mesh = cubes(is_cut);
        let cloud = PointCloud::from_mesh(&mesh, 1.0, &vec![0; mesh.cells.len()], 1);
        check(
            &cloud,
            (&SolidOutline::from_cells(&mesh.cells, &cloud), &mesh.cells),
        );
    }
}

/// A pre-crack along a group of curves cuts the bonds that one along its corners cuts, also where the edges of the group are in no order.
#[test]
fn a_pre_crack_along_curves_is_one_along_their_corners() {
    let whole = |edges: Vec<[u32; 2]>| {
        let mut mesh = squares();
        let lower = |node: u32| {
            mesh.positions
                .iter()
                .position(|it| *it == mesh.positions[node as usize])
        };
        let lower: Vec<u32> = (0..mesh.positions.len() as u32)
            .map(|it| lower(it).unwrap() as u32)
            .collect();
        for node in mesh.cells.iter_mut().flat_map(|cell| cell.corners_mut()) {
            *node = lower[*node as usize];
        }
        mesh.positions.truncate((N + 1).pow(2) as usize);
        mesh.node_tags = (1..=mesh.positions.len() as u64).collect();
        mesh.groups = vec![Group {
            name: "crack".to_owned(),
            dimension: 1,
            number: 1,
            nodes: edges.concat(),
            edges,
            faces: Vec::new(),
            cells: Vec::new(),
        }];
        Setup::new(
            MeshBody::from(mesh),
            Material::isotropic(1.0, 0.2),
            Law::NHPD,
        )
    };
    let node = |x: u32, y: u32| y * (N + 1) + x;
    let edges = vec![
        [node(1, 2), node(2, 2)],
        [node(3, 3), node(2, 2)],
        [node(1, 2), node(0, 2)],
    ];
    let absent = |precrack: PreCrack| {
        let mut setup = whole(edges.clone());
        setup.precracks = vec![precrack];
        Model::build(setup, &mut ()).unwrap().fixed.absent
    };
    let along = absent(PreCrack {
        shape: CrackShape::Group("crack".to_owned()),
        ends: Ends::Excluded,
    });
    let corners = [[0.0, 2.0], [1.0, 2.0], [2.0, 2.0], [3.0, 3.0]];
    assert!(along.len() > 20, "{}", along.len());
    assert_eq!(along, absent(PreCrack::along(corners.to_vec())));
}

/// A message tells of bonds along the outline that an end of a pre-crack touches, where it begins on the outline; a tip inside, which bonds touch as
/// well, and a crack that begins before the outline are silent.
#[test]
fn an_end_on_the_outline_is_told_and_a_tip_inside_is_not() {
    let told = |from: f64| {
        let body = MeshBody::from(meshes::lattice(6, 1.0, [0.0; 2]));
        let mut setup = Setup::new(body, Material::isotropic(1.0, 0.2), Law::NHPD);
        setup.precracks = vec![PreCrack::along(vec![[from, 3.0], [3.0, 3.0]])];
        let warnings = Model::build(setup, &mut ()).unwrap().warnings;
        let mut words = warnings.iter().map(ToString::to_string);
        words.any(|it| it.contains("only touch an end of a pre-crack"))
    };
    assert!(told(0.0));
    assert!(!told(-0.5));
}
