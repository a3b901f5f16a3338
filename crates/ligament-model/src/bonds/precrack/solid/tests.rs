use super::*;
use crate::bonds::precrack::{count_touched_bonds, cut_bonds, normals};
use crate::cloud::lattice::SolidLattice;
use crate::horizon::Horizons;
use crate::{BondSet, PointCloud};

/// A lattice of 8 by 8 by 8 cells of side 1 around the origin, with bonds up to 2.1.
fn lattice() -> (PointCloud<3>, BondSet<3>) {
    let lattice = SolidLattice::new([8; 3], [1.0; 3], [-4.0; 3], Vec::new());
    let cloud = PointCloud::from_lattice(&lattice, 1.0, &[0; 512], 1);
    let bonds = BondSet::search(&cloud, &Horizons::unified(2.1, 512));
    (cloud, bonds)
}

fn ends(cloud: &PointCloud<3>, ends: [u32; 2]) -> [[f64; 3]; 2] {
    ends.map(|end| cloud.positions[end as usize])
}

/// Where the segment meets z = 0 strictly between its ends.
fn crossing([a, b]: [[f64; 3]; 2]) -> Option<[f64; 2]> {
    (a[2] * b[2] < 0.0).then(|| {
        let t = a[2] / (a[2] - b[2]);
        [0, 1].map(|k| a[k] + t * (b[k] - a[k]))
    })
}

#[test]
fn a_disk_cuts_what_crosses_it() {
    let (cloud, bonds) = lattice();
    let disk = SolidPreCrack::disk([0.0; 3], [0.0, 0.0, -3.0], 2.5).expect("a surface");
    let cut = cut_bonds(std::slice::from_ref(&disk), &bonds.ends, &cloud);
    let (mut count, mut on_rim) = (0, 0);
    for (&bond, &found) in bonds.ends.iter().zip(&cut) {
        let at = crossing(ends(&cloud, bond)).map(|[x, y]| x.hypot(y));
        let wanted = at.is_some_and(|radius| radius < 2.5 - 1e-9);
        assert_eq!(found, wanted, "{:?}", ends(&cloud, bond));
        count += usize::from(found);
        on_rim += usize::from(at.is_some_and(|radius| (radius - 2.5).abs() < 1e-9));
    }
    assert!(count > 100 && on_rim > 0, "{count} {on_rim}");
    assert_eq!(
        count_touched_bonds(
            std::slice::from_ref(&disk),
            &bonds,
            &cloud,
            &cut,
            &vec![true; cloud.len()]
        ),
        on_rim
    );
    let with_rim = cut_bonds(&[disk.with_rim()], &bonds.ends, &cloud);
    assert_eq!(with_rim.iter().filter(|it| **it).count(), count + on_rim);
}

/// A plane crack as a rectangle, as a polygon with a re-entrant corner and as triangles in any order cuts the same bonds.
#[test]
fn polygons_cut_what_crosses_them() {
    let (cloud, bonds) = lattice();
    // An L: the square of side 4 without its upper right quarter.
    let corners = [
        [-2.2, -2.2],
        [1.8, -2.2],
        [1.8, -0.2],
        [-0.2, -0.2],
        [-0.2, 1.8],
        [-2.2, 1.8],
    ];
    let is_in = |[x, y]: [f64; 2]| {
        (-2.2..1.8).contains(&x) && (-2.2..1.8).contains(&y) && !(x > -0.2 && y > -0.2)
    };
    let polygon: Vec<[f64; 3]> = corners.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let mut reversed = polygon.clone();
    reversed.reverse();
    let triangles = [[0, 1, 2], [2, 0, 3], [3, 4, 5], [5, 3, 0]];
    let cracks = [
        SolidPreCrack::polygon(&polygon).expect("a surface"),
        SolidPreCrack::polygon(&reversed).expect("a surface"),
        SolidPreCrack::triangles(&polygon, &triangles).expect("a surface"),
    ];
    for crack in cracks {
        let cut = cut_bonds(&[crack], &bonds.ends, &cloud);
        for (&bond, &found) in bonds.ends.iter().zip(&cut) {
            let wanted = crossing(ends(&cloud, bond)).is_some_and(is_in);
            assert_eq!(found, wanted, "{:?}", ends(&cloud, bond));
        }
        assert!(cut.iter().filter(|it| **it).count() > 100);
    }
    let square =
        SolidPreCrack::parallelogram([[-2.2, -2.2, 0.0], [1.8, -2.2, 0.0], [-2.2, 1.8, 0.0]])
            .expect("a surface");
    let cut = cut_bonds(&[square], &bonds.ends, &cloud);
    for (&bond, &found) in bonds.ends.iter().zip(&cut) {
        let at = crossing(ends(&cloud, bond));
        let wanted = at.is_some_and(|at| at.iter().all(|it| (-2.2..1.8).contains(it)));
        assert_eq!(found, wanted, "{:?}", ends(&cloud, bond));
    }
}

/// A closed surface parts what is inside from what is outside: a bond is cut where one end is in the octahedron and the other is not.
#[test]
fn a_closed_surface_has_no_gap() {
    let (cloud, bonds) = lattice();
    let tips = [
        [3.1, 0.0, 0.0],
        [-3.1, 0.0, 0.0],
        [0.0, 3.1, 0.0],
        [0.0, -3.1, 0.0],
        [0.0, 0.0, 3.1],
        [0.0, 0.0, -3.1],
    ];
    let triangles = [
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [0, 3, 4],
        [0, 2, 5],
        [5, 1, 2],
        [1, 5, 3],
        [3, 0, 5],
    ];
    let crack = SolidPreCrack::triangles(&tips, &triangles).expect("a surface");
    let cut = cut_bonds(std::slice::from_ref(&crack), &bonds.ends, &cloud);
    let is_in = |p: [f64; 3]| p.iter().map(|x| x.abs()).sum::<f64>() < 3.1;
    let mut parted = 0;
    for (&bond, &found) in bonds.ends.iter().zip(&cut) {
        let [a, b] = ends(&cloud, bond);
        if is_in(a) != is_in(b) {
            assert!(found, "{a:?} {b:?}");
            parted += 1;
        } else if is_in(a) {
            assert!(!found, "{a:?} {b:?}");
        }
    }
    assert!(parted > 200);
    assert_eq!(
        count_touched_bonds(&[crack], &bonds, &cloud, &cut, &vec![true; cloud.len()]),
        0,
        "it has no rim"
    );
}

/// Points on the crack lie on its front; bonds in its plane survive, and those that touch its rim.
#[test]
fn points_on_the_crack_are_in_front() {
    let square = [
        [-1.0, -1.0, 0.0],
        [1.0, -1.0, 0.0],
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
    ];
    let crack = SolidPreCrack::polygon(&square).expect("a surface");
    let cuts = |a: [f64; 3], b: [f64; 3]| (0..2).any(|piece| crack.cuts(piece, [a, b], 0.0));
    for at in [[0.2, 0.3, 0.0], [0.0, 0.0, 0.0]] {
        assert!(!cuts(at, [0.1, 0.2, 1.0]), "the front is above");
        assert!(cuts(at, [0.1, 0.2, -1.0]) && cuts([0.1, 0.2, -1.0], at));
    }
    assert!(!cuts([0.3, 0.0, 0.0], [-0.3, 0.2, 0.0]), "along the crack");
    assert!(
        cuts([0.5, 0.5, 1.0], [0.5, 0.5, -1.0]),
        "through an inner edge"
    );
    assert!(!cuts([1.0, 0.3, 1.0], [1.0, 0.3, -1.0]), "through the rim");
    assert!(!cuts([1.0, 1.0, 1.0], [1.0, 1.0, -1.0]), "through a corner");
    let touches = |a: [f64; 3], b: [f64; 3]| (0..2).any(|piece| crack.touches(piece, [a, b], 0.0));
    assert!(
        touches([1.0, 0.3, 1.0], [1.0, 0.3, -1.0]) && touches([1.0, 1.0, 1.0], [1.0, 1.0, -1.0])
    );
    assert!(
        !touches([0.5, 0.5, 1.0], [0.5, 0.5, -1.0]) && !touches([1.1, 0.3, 1.0], [1.1, 0.3, -1.0])
    );
    let rimmed = crack.clone().with_rim();
    let meets = |a: [f64; 3], b: [f64; 3]| (0..2).any(|piece| rimmed.cuts(piece, [a, b], 1e-9));
    assert!(
        meets([1.0, 0.3, 1.0], [1.0, 0.3, -1.0])
            && meets([1.0 + 1e-10, 1.0, 1.0], [1.0, 1.0, -1.0])
    );
    assert!(meets([0.3, 0.0, 0.0], [-0.3, 0.2, 0.0]) && meets([0.3, 0.0, 1e-10], [0.3, 0.2, 1.0]));
    assert!(!meets([0.9, 2.0, 0.0], [3.0, -0.5, 0.0]) && !meets([0.2, 2.0, 0.0], [2.0, 0.2, 0.0]));
    assert!(meets([0.0, 2.0, 0.0], [2.0, -0.5, 0.0]) && !meets([1.1, 0.3, 1.0], [1.1, 0.3, -1.0]));
}

#[test]
fn normals_go_from_the_first_end_to_the_second() {
    let (cloud, bonds) = lattice();
    let tilted = SolidPreCrack::disk([0.1, 0.2, 0.0], [1.0, 0.0, 1.0], 2.0).expect("a surface");
    let flat = SolidPreCrack::polygon(&[[-4.0, -4.0, 0.1], [4.0, -4.0, 0.1], [0.0, 4.0, 0.1]])
        .expect("a surface");
    for (crack, normal) in [
        (tilted, [0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt()]),
        (flat, [0.0, 0.0, 1.0]),
    ] {
        let cracks = [crack];
        let cut = cut_bonds(&cracks, &bonds.ends, &cloud);
        let cut: Vec<[u32; 2]> = bonds
            .ends
            .iter()
            .zip(cut)
            .filter(|(_, cut)| *cut)
            .map(|(ends, _)| *ends)
            .collect();
        assert!(cut.len() > 50);
        for (ends_of, found) in cut.iter().zip(normals(&cracks, &cut, &cloud)) {
            let [a, b] = ends(&cloud, *ends_of);
            let along: f64 = (0..3).map(|k| normal[k] * (b[k] - a[k])).sum();
            for k in 0..3 {
                assert!((found[k] - along.signum() * normal[k]).abs() < 1e-15);
            }
        }
    }
}

#[test]
fn what_is_no_surface_is_refused() {
    let refusal = |corners: &[[f64; 3]]| SolidPreCrack::polygon(corners).expect_err("no surface");
    assert_eq!(
        refusal(&[[0.0; 3], [1.0; 3]]),
        UnfitCrack::TooFewCorners { corners: 2 }
    );
    assert_eq!(
        refusal(&[[0.0; 3], [1.0; 3], [2.0; 3]]),
        UnfitCrack::NoArea { triangle: None }
    );
    let square = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let mut bent = square;
    bent[2][2] = 0.5;
    assert!(matches!(refusal(&bent), UnfitCrack::NotPlane { .. }));
    let crossed = [square[0], square[1], square[3], square[2]];
    assert!(matches!(
        refusal(&crossed),
        UnfitCrack::CrossesItself | UnfitCrack::NoArea { .. }
    ));
    assert_eq!(
        SolidPreCrack::disk([0.0; 3], [0.0; 3], 1.0),
        Err(UnfitCrack::NoNormal)
    );
    assert_eq!(
        SolidPreCrack::disk([0.0; 3], [1.0; 3], -1.0),
        Err(UnfitCrack::NoRadius { radius: -1.0 })
    );
    let triangles =
        |it: &[[u32; 3]]| SolidPreCrack::triangles(&square, it).expect_err("no surface");
    assert_eq!(
        triangles(&[[0, 1, 2], [0, 2, 4]]),
        UnfitCrack::NoSuchPoint {
            triangle: 1,
            point: 4
        }
    );
    assert_eq!(
        triangles(&[[0, 1, 1]]),
        UnfitCrack::NoArea { triangle: Some(0) }
    );
}
