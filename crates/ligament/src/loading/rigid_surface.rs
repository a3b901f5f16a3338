//! Surfaces by which rigid bodies are drawn.

use std::f64::consts::{PI, TAU};

use ligament_analysis::contact::RigidSurface;
use ligament_model::tensor::{dot, minus, norm, tangents};

use crate::setup::{Position, RigidForm};

/// Number of corners around a circle.
const AROUND: u32 = 96;

/// Half of the width of a drawn wall, and in the plane its thickness, over the diagonal of the body.
const WALL: [f64; 2] = [0.6, 0.03];

/// Corners of the faces of a box, whose bits are the sides along x, y and z.
const FACES: [[u32; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// The surface of a rigid body; of a wall the part beside a body between two corners (m).
pub(super) fn rigid_surface(
    form: &RigidForm,
    bounds: [Position; 2],
    in_space: bool,
) -> RigidSurface {
    match *form {
        RigidForm::Ball { centre, radius } if in_space => sphere(centre, radius),
        RigidForm::Ball { centre, radius } => circle(centre, radius),
        RigidForm::Wall { point, normal } => wall(point, normal, bounds, in_space),
        RigidForm::Box { centre, size } => {
            let corner = |bits: u32| {
                let side = |axis: usize| if bits >> axis & 1 == 1 { 0.5 } else { -0.5 };
                std::array::from_fn(|axis| centre[axis] + side(axis) * size[axis])
            };
            let faces = if in_space {
                &FACES[..]
            } else {
                &[[0, 1, 3, 2]]
            };
            let count = if in_space { 8 } else { 4 };
            RigidSurface {
                middle: centre,
                places: (0..count).map(corner).collect(),
                triangles: faces.iter().flat_map(triangles).collect(),
            }
        }
    }
}

fn triangles(&[a, b, c, d]: &[u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn circle(centre: Position, radius: f64) -> RigidSurface {
    let place = |k: u32| {
        let (sine, cosine) = (TAU * f64::from(k) / f64::from(AROUND)).sin_cos();
        [centre[0] + radius * cosine, centre[1] + radius * sine, 0.0]
    };
    RigidSurface {
        middle: centre,
        places: (0..AROUND).map(place).chain([centre]).collect(),
        triangles: (0..AROUND).map(|k| [AROUND, k, (k + 1) % AROUND]).collect(),
    }
}

/// A sphere by circles of latitude, the poles among them.
fn sphere(centre: Position, radius: f64) -> RigidSurface {
    let rows = AROUND / 4;
    let place = |k: u32| {
        let (row, column) = (k / AROUND, k % AROUND);
        let (sine, cosine) = (PI * f64::from(row) / f64::from(rows)).sin_cos();
        let (sideways, forwards) = (TAU * f64::from(column) / f64::from(AROUND)).sin_cos();
        let way = [sine * forwards, sine * sideways, cosine];
        std::array::from_fn(|axis| centre[axis] + radius * way[axis])
    };
    let square = |k: u32| {
        let next = k - k % AROUND + (k + 1) % AROUND;
        [k, k + AROUND, next + AROUND, next]
    };
    RigidSurface {
        middle: centre,
        places: (0..AROUND * (rows + 1)).map(place).collect(),
        triangles: (0..AROUND * rows)
            .flat_map(|k| triangles(&square(k)))
            .collect(),
    }
}

/// A rectangle of a wall beside the middle of a body; in the plane behind its surface.
fn wall(
    point: Position,
    normal: Position,
    [low, high]: [Position; 2],
    in_space: bool,
) -> RigidSurface {
    let length = norm(normal);
    let normal = normal.map(|it| it / length);
    let diagonal = norm(minus(high, low));
    let [half, thickness] = WALL.map(|it| it * diagonal);
    let middle: Position = std::array::from_fn(|axis| 0.5 * (low[axis] + high[axis]));
    let away = dot(minus(middle, point), normal);
    let foot: Position = std::array::from_fn(|axis| middle[axis] - away * normal[axis]);
    let [along, across] = match in_space {
        true => tangents(normal).map(|it| it.map(|it| half * it)),
        false => [
            [-half * normal[1], half * normal[0], 0.0],
            normal.map(|it| -0.5 * thickness * it),
        ],
    };
    // In the plane one side is the surface.
    let shift = if in_space { 0.0 } else { 1.0 };
    let corner = |[s, t]: [f64; 2]| {
        std::array::from_fn(|axis| foot[axis] + s * along[axis] + (t + shift) * across[axis])
    };
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    RigidSurface {
        middle: foot,
        places: corners.map(corner).to_vec(),
        triangles: triangles(&[0, 1, 2, 3]).to_vec(),
    }
}
