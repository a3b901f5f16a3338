//! The outside of solid cells, and its edges.

use std::collections::BTreeMap;

use ligament_mesh::{Cell, SolidCell};

/// Cosine of the angle between two faces below which their common edge is drawn: 35 degrees.
const SHARP: f64 = 0.82;

/// Faces that belong to only one cell, their corners counter-clockwise seen from outside, in the order of the cells.
pub(super) fn outer_faces(cells: &[SolidCell]) -> Vec<Cell> {
    let all = || cells.iter().flat_map(SolidCell::faces);
    let mut sorted: Vec<([u32; 4], usize)> = all().map(|face| key(&face)).zip(0..).collect();
    sorted.sort_unstable();
    let mut is_outer = vec![false; sorted.len()];
    for same in sorted.chunk_by(|one, other| one.0 == other.0) {
        if let [(_, alone)] = same {
            is_outer[*alone] = true;
        }
    }
    let chosen = all().zip(is_outer).filter(|(_, is_outer)| *is_outer);
    chosen.map(|(face, _)| face).collect()
}

/// The corners of a face in ascending order.
fn key(face: &Cell) -> [u32; 4] {
    let mut key = [u32::MAX; 4];
    for (entry, corner) in key.iter_mut().zip(face.corners()) {
        *entry = *corner;
    }
    key.sort_unstable();
    key
}

/// Edges of triangles with one triangle, or with two that meet at an angle, ascending.
pub(super) fn sharp_edges(places: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let normals: Vec<[f64; 3]> = triangles
        .iter()
        .map(|it| unit_normal(it.map(|corner| places[corner as usize])))
        .collect();
    let mut at: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (number, [a, b, c]) in triangles.iter().enumerate() {
        for [p, q] in [[a, b], [b, c], [c, a]] {
            at.entry([*p.min(q), *p.max(q)]).or_default().push(number);
        }
    }
    let is_sharp = |triangles: &Vec<usize>| match triangles.as_slice() {
        &[one, other] => {
            let [m, n] = [normals[one], normals[other]];
            (0..3).map(|axis| m[axis] * n[axis]).sum::<f64>() < SHARP
        }
        _ => true,
    };
    let sharp = at.into_iter().filter(|(_, triangles)| is_sharp(triangles));
    sharp.map(|(ends, _)| ends).collect()
}

/// Edges that belong to only one triangle, ascending: the rim of a section. Triangles may have no area, where a plane passes through nodes.
pub(super) fn rim(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let sides = triangles
        .iter()
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut count: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    for [p, q] in sides {
        *count.entry([*p.min(q), *p.max(q)]).or_default() += 1;
    }
    let alone = count.into_iter().filter(|(_, count)| *count == 1);
    alone.map(|(ends, _)| ends).collect()
}

/// Unit normal of a triangle, zero where it has no area.
pub(super) fn unit_normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let [p, q] = [b, c].map(|it| [0, 1, 2].map(|axis| it[axis] - a[axis]));
    let normal = [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ];
    let length = normal.iter().map(|it| it * it).sum::<f64>().sqrt();
    if length > 0.0 {
        normal.map(|it| it / length)
    } else {
        [0.0; 3]
    }
}
