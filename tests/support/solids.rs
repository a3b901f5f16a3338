//! Solids made by hand: blocks of cells, and lattices of boxes.

use ligament_mesh::SolidCell;
use ligament_model::{BodyGrid, Canvas, Numbering};

/// A block of cells of side 1 with its nodes moved at random by up to a share of it, but for those on the outside, which stay there.
pub fn block(cells: [usize; 3], moved: f64) -> BodyGrid {
    let [nx, ny, nz] = cells;
    let node = |x: usize, y: usize, z: usize| (x + (nx + 1) * (y + (ny + 1) * z)) as u32;
    let mut random = 5_u64;
    let mut positions = Vec::new();
    for z in 0..=nz {
        for y in 0..=ny {
            for x in 0..=nx {
                let place = [x, y, z];
                positions.push(std::array::from_fn(|axis| {
                    let is_inside = place[axis] > 0 && place[axis] < cells[axis];
                    let by = if is_inside { moved } else { 0.0 };
                    place[axis] as f64 + by * drawn(&mut random)
                }));
            }
        }
    }
    let mut all = Vec::new();
    for z in 0..nz {
        for y in 0..ny {
            for x in 0..nx {
                let base = |z| {
                    [
                        node(x, y, z),
                        node(x + 1, y, z),
                        node(x + 1, y + 1, z),
                        node(x, y + 1, z),
                    ]
                };
                let ([a, b, c, d], [e, f, g, h]) = (base(z), base(z + 1));
                all.push(SolidCell::Hexahedron([a, b, c, d, e, f, g, h]));
            }
        }
    }
    grid(positions, Canvas::Solid(all))
}

/// The next of a row of numbers from -1 to 1 (D. E. Knuth's linear congruence).
pub fn drawn(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

fn grid(positions: Vec<[f64; 3]>, canvas: Canvas) -> BodyGrid {
    BodyGrid {
        cell_numbers: Vec::new(),
        of_body: None,
        numbering: Numbering::default(),
        tags: (0..positions.len() as i64).collect(),
        positions,
        tagged: "node",
        canvas,
    }
}

/// A lattice of boxes of side 1.
pub fn boxes(counts: [usize; 3]) -> BodyGrid {
    let mut all = Vec::new();
    for z in 0..counts[2] {
        for y in 0..counts[1] {
            for x in 0..counts[0] {
                let low = [x, y, z].map(|it| it as f64);
                all.push([low, low.map(|it| it + 1.0)]);
            }
        }
    }
    let middles = all.iter().map(|it: &[[f64; 3]; 2]| it[0].map(|x| x + 0.5));
    grid(middles.collect(), Canvas::Boxes(all))
}
