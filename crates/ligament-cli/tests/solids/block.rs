//! A block of tetrahedra as a Gmsh file, with possible errors.

use std::fmt::Write;

/// Cells of the block along x, y and z.
const CELLS: [usize; 3] = [6, 3, 3];

/// A mesh of the block 2 by 1 by 1 (times the scale), to be written as text.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    pub(crate) nodes: Vec<[f64; 3]>,
    pub(crate) tetrahedra: Vec<[usize; 4]>,
    /// Surface elements with the number of their group: 1 `left`, 2 `right`, others without a name.
    pub(crate) triangles: Vec<(i32, [usize; 3])>,
    /// Number of the group of each tetrahedron: 3 `body`, 0 none.
    pub(crate) group: i32,
}

impl Block {
    /// The block with its volume as `body` and its ends as `left` and `right`.
    pub(crate) fn new(scale: f64) -> Self {
        let [nx, ny, nz] = CELLS;
        let number = |[i, j, k]: [usize; 3]| (i * (ny + 1) + j) * (nz + 1) + k;
        let mut block = Self {
            nodes: vec![[0.0; 3]; (nx + 1) * (ny + 1) * (nz + 1)],
            tetrahedra: Vec::new(),
            triangles: Vec::new(),
            group: 3,
        };
        let places =
            (0..=nx).flat_map(|i| (0..=ny).flat_map(move |j| (0..=nz).map(move |k| [i, j, k])));
        for place in places {
            let sides = [2.0, 1.0, 1.0];
            block.nodes[number(place)] =
                [0, 1, 2].map(|a| scale * sides[a] * place[a] as f64 / CELLS[a] as f64);
            if (0..3).any(|axis| place[axis] == CELLS[axis]) {
                continue;
            }
            let corner = |index: usize| {
                const ORDER: [[usize; 3]; 8] = [
                    [0, 0, 0],
                    [1, 0, 0],
                    [1, 1, 0],
                    [0, 1, 0],
                    [0, 0, 1],
                    [1, 0, 1],
                    [1, 1, 1],
                    [0, 1, 1],
                ];
                number([0, 1, 2].map(|axis| place[axis] + ORDER[index][axis]))
            };
            const SPLIT: [[usize; 4]; 6] = [
                [0, 1, 2, 6],
                [0, 2, 3, 6],
                [0, 3, 7, 6],
                [0, 7, 4, 6],
                [0, 4, 5, 6],
                [0, 5, 1, 6],
            ];
            block
                .tetrahedra
                .extend(SPLIT.map(|tetrahedron| tetrahedron.map(corner)));
            let faces = |corners: [[usize; 3]; 2]| corners.map(|face| face.map(corner));
            if place[0] == 0 {
                let left = faces([[0, 3, 7], [0, 7, 4]]);
                block.triangles.extend(left.map(|face| (1, face)));
            }
            if place[0] == nx - 1 {
                let right = faces([[1, 2, 6], [1, 6, 5]]);
                block.triangles.extend(right.map(|face| (2, face)));
            }
        }
        block
    }

    /// The text of a file of format 2.2.
    pub(crate) fn text(&self) -> String {
        let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"left\"\n2 2 \"right\"\n3 3 \"body\"\n\
            $EndPhysicalNames\n$Nodes\n"
            .to_owned();
        let _ = writeln!(text, "{}", self.nodes.len());
        for (node, [x, y, z]) in (1..).zip(&self.nodes) {
            let _ = writeln!(text, "{node} {x} {y} {z}");
        }
        text += "$EndNodes\n$Elements\n";
        let _ = writeln!(text, "{}", self.triangles.len() + self.tetrahedra.len());
        let mut number = 0;
        let mut element = |kind: i32, group: i32, corners: &[usize]| {
            number += 1;
            let corners: Vec<String> = corners.iter().map(|it| (it + 1).to_string()).collect();
            let _ = writeln!(text, "{number} {kind} 2 {group} 1 {}", corners.join(" "));
        };
        for (group, corners) in &self.triangles {
            element(2, *group, corners);
        }
        for corners in &self.tetrahedra {
            element(4, self.group, corners);
        }
        text + "$EndElements\n"
    }
}

/// A case that pulls the block, with the texts of its head, its support, its load and other settings.
pub(crate) fn case([head, support, load, more]: [&str; 4]) -> String {
    format!(
        "{head}\n[material]\nyoung = 30e9\npoisson = 0.2\ntensile_strength = 3e6\n[model]\nlaw = \"nhpd\"\nhorizon_factor = 2.0\n\
         [correction]\nsurface = \"volume\"\n[[support]]\n{support}\n[[load]]\n{load}\n{more}\n"
    )
}

/// The parts of a case that is right for the block in `block.msh`.
pub(crate) const SOLID: [&str; 4] = [
    "[mesh]\nfile = \"block.msh\"",
    "group = \"left\"\ndisplacement = { x = 0.0, y = 0.0, z = 0.0 }",
    "group = \"right\"\ndisplacement = { x = 2e-4 }",
    "",
];
