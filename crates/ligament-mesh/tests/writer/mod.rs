//! A writer of Gmsh files, with the mesh that the reader should return.

/// Format of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Version {
    V2,
    V4,
}

/// How its numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A mesh to write; nodes are indices into `nodes`, entities into `physicals` of their dimension.
#[derive(Debug, Clone, Default)]
pub(crate) struct Model {
    /// Tag and position of each node.
    pub(crate) nodes: Vec<(u64, [f64; 2])>,
    /// Node and entity of each point.
    pub(crate) points: Vec<(usize, usize)>,
    /// Nodes and entity of each edge.
    pub(crate) edges: Vec<([usize; 2], usize)>,
    /// Corners counter-clockwise, whether they are written clockwise, and entity of each cell.
    pub(crate) cells: Vec<(Vec<usize>, bool, usize)>,
    /// Physical groups of each entity of dimension 0, 1 and 2.
    pub(crate) physicals: [Vec<Vec<i32>>; 3],
}

/// An element to write: type, dimension, entity, node tags.
type Element = (i32, usize, usize, Vec<u64>);

impl Model {
    /// Makes room in the numbers of the elements for a node inserted at `at`.
    pub(crate) fn shift_nodes(&mut self, at: usize) {
        let cells = self.cells.iter_mut().flat_map(|cell| cell.0.iter_mut());
        let edges = self.edges.iter_mut().flat_map(|edge| edge.0.iter_mut());
        let points = self.points.iter_mut().map(|point| &mut point.0);
        for node in cells.chain(edges).chain(points).filter(|node| **node >= at) {
            *node += 1;
        }
    }

    pub(crate) fn write(&self, version: Version, encoding: Encoding) -> Vec<u8> {
        let mut file = File {
            bytes: Vec::new(),
            encoding,
        };
        let number = if version == Version::V2 { "2.2" } else { "4.1" };
        let binary = i32::from(encoding != Encoding::Ascii);
        file.line(&format!("$MeshFormat\n{number} {binary} 8"));
        if binary == 1 {
            file.int(1);
            file.line("");
        }
        file.line("$EndMeshFormat");
        match version {
            Version::V2 => self.write_v2(&mut file),
            Version::V4 => self.write_v4(&mut file),
        }
        file.bytes
    }

    fn elements(&self) -> Vec<Element> {
        let tag = |node: &usize| self.nodes[*node].0;
        let points = self
            .points
            .iter()
            .map(|(node, entity)| (15, 0, *entity, vec![tag(node)]));
        let edges = self
            .edges
            .iter()
            .map(|(nodes, entity)| (1, 1, *entity, nodes.iter().map(tag).collect()));
        let cells = self.cells.iter().map(|(corners, reversed, entity)| {
            let mut tags: Vec<u64> = corners.iter().map(tag).collect();
            if *reversed {
                tags[1..].reverse();
            }
            (corners.len() as i32 - 1, 2, *entity, tags)
        });
        points.chain(edges).chain(cells).collect()
    }

    fn write_v2(&self, file: &mut File) {
        file.line(&format!("$Nodes\n{}", self.nodes.len()));
        for (tag, [x, y]) in &self.nodes {
            file.int(*tag as i32);
            [*x, *y, 0.0]
                .into_iter()
                .for_each(|coordinate| file.real(coordinate));
            file.end_row();
        }
        file.line("\n$EndNodes");

        // An element stands once per group.
        let mut rows = Vec::new();
        for (code, dimension, entity, tags) in self.elements() {
            let groups = &self.physicals[dimension][entity];
            for group in if groups.is_empty() { &[0][..] } else { groups } {
                rows.push((code, [*group, entity as i32 + 1], tags.clone()));
            }
        }
        file.line(&format!("$Elements\n{}", rows.len()));
        for (index, (code, groups, tags)) in rows.into_iter().enumerate() {
            let number = index as i32 + 1;
            // Blocks of one element each in binary files.
            let head = if file.encoding == Encoding::Ascii {
                [number, code, 2]
            } else {
                [code, 1, 2]
            };
            head.into_iter().for_each(|value| file.int(value));
            if file.encoding != Encoding::Ascii {
                file.int(number);
            }
            groups.into_iter().for_each(|value| file.int(value));
            tags.iter().for_each(|tag| file.int(*tag as i32));
            file.end_row();
        }
        file.line("\n$EndElements");
    }

    fn write_v4(&self, file: &mut File) {
        file.line("$Entities");
        self.physicals
            .iter()
            .for_each(|entities| file.size(entities.len() as u64));
        file.size(0);
        file.end_row();
        for (dimension, entities) in self.physicals.iter().enumerate() {
            for (index, groups) in entities.iter().enumerate() {
                file.int(index as i32 + 1);
                (0..if dimension == 0 { 3 } else { 6 }).for_each(|_| file.real(0.0));
                file.size(groups.len() as u64);
                // Every other entity is reversed.
                groups
                    .iter()
                    .for_each(|group| file.int(if index == 1 { -group } else { *group }));
                if dimension > 0 {
                    file.size(0);
                }
                file.end_row();
            }
        }
        file.line("\n$EndEntities");
        self.write_nodes_v4(file);
        self.write_elements_v4(file);
    }

    /// Two blocks: plain nodes and nodes with two parametric coordinates.
    fn write_nodes_v4(&self, file: &mut File) {
        let (plain, parametric) = self.nodes.split_at(self.nodes.len() / 2);
        file.line("$Nodes");
        [2, self.nodes.len() as u64, 0, 0]
            .into_iter()
            .for_each(|value| file.size(value));
        file.end_row();
        for (nodes, is_parametric) in [(plain, 0), (parametric, 1)] {
            [2, 1, is_parametric]
                .into_iter()
                .for_each(|value| file.int(value));
            file.size(nodes.len() as u64);
            file.end_row();
            for (tag, _) in nodes {
                file.size(*tag);
                file.end_row();
            }
            for (_, [x, y]) in nodes {
                [*x, *y, 0.0]
                    .into_iter()
                    .for_each(|coordinate| file.real(coordinate));
                (0..2 * is_parametric).for_each(|_| file.real(0.25));
                file.end_row();
            }
        }
        file.line("\n$EndNodes");
    }

    fn write_elements_v4(&self, file: &mut File) {
        let elements = self.elements();
        let blocks: Vec<&[Element]> = elements
            .chunk_by(|a, b| (a.0, a.1, a.2) == (b.0, b.1, b.2))
            .collect();
        file.line("$Elements");
        [blocks.len() as u64, elements.len() as u64, 0, 0]
            .into_iter()
            .for_each(|value| file.size(value));
        file.end_row();
        let mut number = 0;
        for block in blocks {
            let (code, dimension, entity, _) = &block[0];
            [*dimension as i32, *entity as i32 + 1, *code]
                .into_iter()
                .for_each(|value| file.int(value));
            file.size(block.len() as u64);
            file.end_row();
            for (.., tags) in block {
                number += 1;
                file.size(number);
                tags.iter().for_each(|tag| file.size(*tag));
                file.end_row();
            }
        }
        file.line("\n$EndElements");
    }
}

/// The bytes of a file as they come.
struct File {
    bytes: Vec<u8>,
    encoding: Encoding,
}

impl File {
    fn line(&mut self, text: &str) {
        self.bytes.extend(text.as_bytes());
        self.bytes.push(b'\n');
    }

    fn end_row(&mut self) {
        if self.encoding == Encoding::Ascii {
            self.bytes.push(b'\n');
        }
    }

    fn put(&mut self, text: String, little: &[u8], big: &[u8]) {
        match self.encoding {
            Encoding::Ascii => self.bytes.extend(format!("{text} ").as_bytes()),
            Encoding::LittleEndian => self.bytes.extend(little),
            Encoding::BigEndian => self.bytes.extend(big),
        }
    }

    fn int(&mut self, value: i32) {
        self.put(
            value.to_string(),
            &value.to_le_bytes(),
            &value.to_be_bytes(),
        );
    }

    fn size(&mut self, value: u64) {
        self.put(
            value.to_string(),
            &value.to_le_bytes(),
            &value.to_be_bytes(),
        );
    }

    fn real(&mut self, value: f64) {
        self.put(
            format!("{value:e}"),
            &value.to_le_bytes(),
            &value.to_be_bytes(),
        );
    }
}
