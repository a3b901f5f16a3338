//! The outline of a mesh of solids: bonds leave the body where points along them are in no cell.

use ligament_mesh::{MeshCell, SolidCell, SolidMesh};
use ligament_model::bonds::BondSet;
use ligament_model::bonds::outline::{Outline, SolidOutline, bonds_outside, spacing_inside};
use ligament_model::cloud::PointCloud;
use ligament_model::horizon::Horizons;
use ligament_model::tensor::{cross, dot, norm};

const N: u32 = 6;

/// Column, row and layer of a node of the grid of N^3 nodes.
fn place(node: u32) -> [u32; 3] {
    [node % N, node / N % N, node / (N * N)]
}

fn node([x, y, z]: [u32; 3]) -> u32 {
    (z * N + y) * N + x
}

/// How the cubes of the grid are cut into cells.
#[derive(Debug, Clone, Copy)]
enum Cut {
    Hexahedra,
    Prisms,
    Tetrahedra,
}

/// The cells of the grid for which `has` of column, row and layer is true.
fn cells(cut: Cut, has: impl Fn([u32; 3]) -> bool) -> Vec<SolidCell> {
    let whole =
        (0..(N - 1).pow(3)).map(|k| [k % (N - 1), k / (N - 1) % (N - 1), k / (N - 1).pow(2)]);
    let mut cells = Vec::new();
    for [x, y, z] in whole.filter(|cell| has(*cell)) {
        let corner = [
            [0, 0, 0],
            [1, 0, 0],
            [1, 1, 0],
            [0, 1, 0],
            [0, 0, 1],
            [1, 0, 1],
            [1, 1, 1],
            [0, 1, 1],
        ]
        .map(|[right, back, up]| node([x + right, y + back, z + up]));
        let [a, b, c, d, e, f, g, h] = corner;
        match cut {
            Cut::Hexahedra => cells.push(SolidCell::Hexahedron(corner)),
            Cut::Prisms => {
                cells.push(SolidCell::Prism([a, b, c, e, f, g]));
                cells.push(SolidCell::Prism([a, c, d, e, g, h]));
            }
            Cut::Tetrahedra => {
                let parts = SolidCell::Hexahedron(corner).tetrahedra();
                cells.extend(parts.map(SolidCell::Tetrahedron));
            }
        }
    }
    cells
}

fn body(
    cells: Vec<SolidCell>,
    position: impl Fn([f64; 3]) -> [f64; 3],
    reach: f64,
) -> (PointCloud<3>, Vec<SolidCell>, BondSet<3>) {
    let positions = (0..N.pow(3)).map(|node| position(place(node).map(f64::from)));
    // Nodes without a cell are none of a mesh.
    let mut number = vec![u32::MAX; N.pow(3) as usize];
    let mut used: Vec<u32> = cells
        .iter()
        .flat_map(|cell| cell.corners().to_vec())
        .collect();
    used.sort_unstable();
    used.dedup();
    for (new, old) in (0..).zip(&used) {
        number[*old as usize] = new;
    }
    let positions: Vec<[f64; 3]> = positions.collect();
    let renumbered = |cell: &SolidCell| {
        let of = |node: u32| number[node as usize];
        match *cell {
            SolidCell::Tetrahedron(it) => SolidCell::Tetrahedron(it.map(of)),
            SolidCell::Hexahedron(it) => SolidCell::Hexahedron(it.map(of)),
            SolidCell::Prism(it) => SolidCell::Prism(it.map(of)),
            SolidCell::Pyramid(it) => SolidCell::Pyramid(it.map(of)),
        }
    };
    let mesh = SolidMesh {
        node_tags: used.iter().map(|node| u64::from(*node)).collect(),
        positions: used.iter().map(|node| positions[*node as usize]).collect(),
        cells: cells.iter().map(renumbered).collect(),
        ..SolidMesh::default()
    };
    let cloud = PointCloud::from_mesh(&mesh, 1.0, &vec![0; mesh.cells.len()], 1);
    let bonds = BondSet::search(&cloud, &Horizons::unified(reach, cloud.len()));
    (cloud, mesh.cells, bonds)
}

/// A turn about a slanted axis.
fn turned(angle: f64) -> impl Fn([f64; 3]) -> [f64; 3] {
    let axis = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
    let (sin, cos) = angle.sin_cos();
    move |p: [f64; 3]| {
        let (along, across) = (dot(axis, p), cross(axis, p));
        [0, 1, 2].map(|k| cos * p[k] + sin * across[k] + (1.0 - cos) * along * axis[k])
    }
}

/// A slot from the left through half of the depth, a cavity, a step at the top and a notch that runs along an edge.
fn has([x, y, z]: [u32; 3]) -> bool {
    let slot = z == 2 && x < 2 && y < 3;
    let cavity = [x, y, z] == [3, 3, 3];
    let step = z == 4 && x > 2;
    let notch = y == 4 && z == 0 && (1..3).contains(&x);
    !(slot || cavity || step || notch)
}

/// A bond stays in the body if points along it are all in a cell, faces included: sampled, and so without any predicate.
#[test]
fn bonds_agree_with_points_along_them() {
    for (cut, angle) in [
        (Cut::Hexahedra, 0.0),
        (Cut::Hexahedra, 0.7),
        (Cut::Prisms, 1.3),
        (Cut::Tetrahedra, 0.0),
        (Cut::Tetrahedra, 0.4),
    ] {
        let (cloud, cells, bonds) = body(cells(cut, has), turned(angle), 3.2);
        let back = turned(-angle);
        let grid = |point: u32| {
            let [p, origin] = [cloud.positions[point as usize], cloud.origin];
            back([0, 1, 2].map(|axis| p[axis] + origin[axis])).map(f64::round)
        };
        let outside = bonds_outside(&SolidOutline::from_cells(&cells, &cloud), &bonds, &cloud);
        let mut count = 0;
        for (ends, &found) in bonds.ends.iter().zip(&outside) {
            let [a, b] = ends.map(grid);
            let is_in = |place: f64| {
                let at = [0, 1, 2].map(|axis| a[axis] + place * (b[axis] - a[axis]));
                let cells =
                    at.map(|x| [(x - 1e-9).floor(), (x + 1e-9).floor()].map(|it| it as i64));
                (0..8).any(|k: usize| {
                    let cell = [cells[0][k & 1], cells[1][k >> 1 & 1], cells[2][k >> 2]];
                    cell.iter().all(|it| (0..i64::from(N) - 1).contains(it))
                        && has(cell.map(|it| it as u32))
                })
            };
            let wanted = (0..=1000).any(|k| !is_in(f64::from(k) / 1000.0));
            assert_eq!(found, wanted, "{a:?} {b:?} {cut:?} turned by {angle}");
            count += usize::from(found);
        }
        assert!(
            count > 500,
            "{count} of {} bonds leave the body",
            bonds.len()
        );
        assert_eq!(
            SolidOutline::from_cells(&cells, &cloud).first_crossing(),
            None
        );
    }
}

#[test]
fn a_whole_box_loses_nothing() {
    for (cut, angle) in [
        (Cut::Hexahedra, 0.3),
        (Cut::Prisms, 0.9),
        (Cut::Tetrahedra, 0.5),
    ] {
        let (cloud, cells, bonds) = body(cells(cut, |_| true), turned(angle), 3.2);
        assert!(
            !bonds_outside(&SolidOutline::from_cells(&cells, &cloud), &bonds, &cloud)
                .contains(&true),
            "{cut:?}"
        );
    }
}

/// The grid as a ball, layer by layer around its middle: its outline dips between the nodes of each warped quadrangle.
fn ball(p: [f64; 3]) -> [f64; 3] {
    let middle = 0.5 * f64::from(N - 1);
    let from_middle = p.map(|x| (x - middle) / middle);
    let largest = from_middle
        .iter()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    let length = norm(from_middle);
    from_middle.map(|x| {
        if length > 0.0 {
            x * largest / length
        } else {
            0.0
        }
    })
}

#[test]
fn a_round_body_loses_nothing() {
    for cut in [Cut::Hexahedra, Cut::Prisms, Cut::Tetrahedra] {
        let (cloud, cells, bonds) = body(cells(cut, |_| true), ball, 0.9);
        let outside = bonds_outside(&SolidOutline::from_cells(&cells, &cloud), &bonds, &cloud);
        let lost = outside.iter().filter(|it| **it).count();
        assert_eq!(lost, 0, "{cut:?} of {}", outside.len());
    }
}

/// The innermost cell taken out of the ball: across the cavity there is no bond, but along the edges of its cells there is; outside
/// nothing is lost.
#[test]
fn a_cavity_parts_what_lies_across_it() {
    let is_inner = |cell: [u32; 3]| cell.iter().all(|it| (1..4).contains(it));
    for cut in [Cut::Hexahedra, Cut::Prisms, Cut::Tetrahedra] {
        let (cloud, cells, bonds) = body(cells(cut, |cell| !is_inner(cell)), ball, 0.9);
        let outside = bonds_outside(&SolidOutline::from_cells(&cells, &cloud), &bonds, &cloud);
        let edges: std::collections::BTreeSet<[u32; 2]> =
            cells.iter().flat_map(SolidCell::edges).collect();
        let radius = |point: u32| norm(cloud.positions[point as usize]);
        let (mut across, mut along) = (0, 0);
        for (ends, &found) in bonds.ends.iter().zip(&outside) {
            let is_inner = ends.map(|end| radius(end) < 0.61);
            match is_inner {
                // Between two nodes of the cavity a straight line runs through it, but where it is the side of a cell or the
                // other diagonal of one.
                [true, true] if bonds_are_far(*ends, &edges) => {
                    assert!(found, "{cut:?} {ends:?}");
                    across += 1;
                }
                [false, false] => {
                    let mid = ends.map(|end| cloud.positions[end as usize]);
                    let half = [0, 1, 2].map(|axis| 0.5 * (mid[0][axis] + mid[1][axis]));
                    if norm(half) > 0.65 {
                        assert!(!found, "{cut:?} {ends:?}");
                        along += 1;
                    }
                }
                _ => {}
            }
            assert!(!(found && edges.contains(ends)), "{cut:?} {ends:?}");
        }
        assert!(across > 100 && along > 500, "{across} {along}");
    }
}

/// Whether two nodes are neither those of an edge nor have an edge to a common node with each other.
fn bonds_are_far([a, b]: [u32; 2], edges: &std::collections::BTreeSet<[u32; 2]>) -> bool {
    let has = |p: u32, q: u32| edges.contains(&[p.min(q), p.max(q)]);
    let mut common = edges.iter().flatten();
    !has(a, b) && !common.any(|&node| has(a, node) && has(b, node))
}

/// The two sides of a slot nearly touch: what a node sees nearest lies on its own side.
#[test]
fn nothing_is_seen_across_a_slot() {
    let narrow = |p: [f64; 3]| {
        let z = if p[2] > 2.5 && p[0] < 2.0 {
            p[2] - 0.9
        } else {
            p[2]
        };
        [p[0], p[1], z]
    };
    let (cloud, cells, bonds) = body(
        cells(Cut::Hexahedra, |[x, _, z]| !(z == 2 && x < 2)),
        narrow,
        1.5,
    );
    let spacing = spacing_inside(&SolidOutline::from_cells(&cells, &cloud), &cells, &cloud);
    let is_at_slot = |point: usize| {
        let p = [0, 1, 2].map(|axis| cloud.positions[point][axis] + cloud.origin[axis]);
        p[0] < 1.5 && (1.9..2.2).contains(&p[2])
    };
    let at_slot: Vec<usize> = (0..cloud.len())
        .filter(|&point| is_at_slot(point))
        .collect();
    assert_eq!(at_slot.len(), 24);
    for point in at_slot {
        assert!((cloud.spacing[point] - 0.1).abs() < 1e-12);
        assert!((spacing[point] - 1.0).abs() < 1e-12, "{}", spacing[point]);
    }
    let outside = bonds_outside(&SolidOutline::from_cells(&cells, &cloud), &bonds, &cloud);
    let across = bonds
        .length
        .iter()
        .zip(outside)
        .filter(|(length, _)| (**length - 0.1).abs() < 1e-12);
    assert!(across.clone().count() == 12 && across.into_iter().all(|(_, found)| found));
}

/// Two cubes of which one reaches into the other, without a common node.
#[test]
fn cells_through_each_other_are_noticed() {
    let apart = |cell: [u32; 3]| cell[1] == 0 && cell[2] == 0 && (cell[0] == 0 || cell[0] == 2);
    let moved = |p: [f64; 3]| {
        if p[0] > 1.5 {
            [p[0] - 1.5, p[1] + 0.3, p[2] + 0.4]
        } else {
            p
        }
    };
    let (cloud, cells, _) = body(cells(Cut::Hexahedra, apart), moved, 1.1);
    assert!(
        SolidOutline::from_cells(&cells, &cloud)
            .first_crossing()
            .is_some()
    );
}
