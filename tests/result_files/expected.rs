//! What the program has in memory, in a plain form: raw little-endian numbers, and a list of what they are.
//!
//! A line of `expected.tsv` has, between tabs, the file, the part (`points`, `cells`, `point`, `cell`, `field` or `column`), the name, the
//! type (`f8`, `f4`, `i8`, `text`), the names of the components between commas, where the numbers begin in `expected.bin` (bytes)
//! and how many there are; of a column of text the texts themselves stand at the end instead, between vertical bars.
//!
//! Values of points and bonds come in the order of the model and are put in that of the mesh file, which is told from the tags.

use std::fmt::Write as _;
use std::path::Path;

use ligament_run::model::Model;
use verification::meshes;

/// The content of result files as it should be.
pub(crate) struct Expected {
    list: String,
    numbers: Vec<u8>,
    order: Order,
}

/// The order of a mesh file; where there is none, that of the model.
struct Order {
    /// The model's point of each node of the file.
    points: Vec<u32>,
    /// The node of each point of the model.
    nodes: Vec<u32>,
    /// Bonds in the order of their nodes, then pairs that are none.
    bonds: Vec<u32>,
    n_bonds: usize,
    /// Nodes of each of these, ascending.
    ends: Vec<[u32; 2]>,
    /// Whether fields of points stand at points, not at cells of their own.
    is_mesh: bool,
}

/// Where an array stands.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) file: &'a str,
    /// `points`, `cells`, `point`, `cell`, `field` or `column`.
    pub(crate) part: &'a str,
    pub(crate) name: &'a str,
}

impl Order {
    fn new(mesh: Option<&Path>, model: &Model) -> Self {
        let tags: Vec<u64> = (0..model.plane().cloud.len() as u32)
            .map(|point| model.body().tag(point))
            .collect();
        let in_file = mesh.map_or_else(|| tags.clone(), |it| meshes::read(it).node_tags.to_vec());
        let place = |tags: &[u64], tag: &u64| tags.iter().position(|it| it == tag).unwrap() as u32;
        let nodes: Vec<u32> = tags.iter().map(|tag| place(&in_file, tag)).collect();
        let ordered = |pairs: Vec<[u32; 2]>| {
            let nodes_of = |ends: [u32; 2]| {
                let mut ends = ends.map(|end| nodes[end as usize]);
                ends.sort_unstable();
                ends
            };
            let numbered = (0..).zip(pairs).map(|(pair, ends)| (nodes_of(ends), pair));
            let mut numbered: Vec<([u32; 2], u32)> = numbered.collect();
            numbered.sort_unstable();
            numbered
        };
        let bonds = ordered(model.plane().bonds.ends.to_vec());
        let n_bonds = bonds.len() as u32;
        let absent = ordered(model.fixed.absent.iter().map(|it| it.ends).collect());
        let absent = absent
            .iter()
            .map(|it| n_bonds + it.1)
            .zip(absent.iter().map(|it| it.0));
        let both = bonds.iter().map(|it| (it.1, it.0)).chain(absent);
        let (bonds, ends) = both.unzip();
        Self {
            points: in_file.iter().map(|tag| place(&tags, tag)).collect(),
            nodes,
            bonds,
            n_bonds: n_bonds as usize,
            ends,
            is_mesh: mesh.is_some(),
        }
    }

    /// Rows of a file in the order of the model that stand so in it; none where they are in its order.
    fn rows(&self, Place { file, part, .. }: Place<'_>) -> Option<&[u32]> {
        match part {
            "point" if self.is_mesh => Some(&self.points),
            "cell" if file == "model.vtu" => Some(&self.bonds),
            "cell" if file.starts_with("bonds_") => Some(&self.bonds[..self.n_bonds]),
            _ => None,
        }
    }
}

impl Expected {
    /// Nothing yet of a model whose body comes from a mesh file or from a lattice.
    pub(crate) fn new(mesh: Option<&Path>, model: &Model) -> Self {
        Self {
            list: String::new(),
            numbers: Vec::new(),
            order: Order::new(mesh, model),
        }
    }

    /// Ends of a bond, the first in the file first.
    pub(crate) fn in_file(&self, mut ends: [u32; 2]) -> [u32; 2] {
        ends.sort_unstable_by_key(|&end| self.order.nodes[end as usize]);
        ends
    }

    /// Parts of the body at its points, numbered by their first nodes in the file.
    pub(crate) fn parts(&self, of_point: &[u32]) -> Vec<i64> {
        let mut met: Vec<u32> = Vec::new();
        for &point in &self.order.points {
            let part = of_point[point as usize];
            if !met.contains(&part) {
                met.push(part);
            }
        }
        let number = |part: &u32| met.iter().position(|it| it == part).unwrap() as i64;
        of_point.iter().map(number).collect()
    }

    /// The points of the model and lines between them: `n_lines` of the bonds and of the pairs that are none.
    pub(crate) fn lines(&mut self, file: &str, positions: &[[f64; 2]], n_lines: usize) {
        let points = self.order.points.iter();
        let points: Vec<[f64; 2]> = points.map(|&it| positions[it as usize]).collect();
        let ends = self.order.ends[..n_lines].to_vec();
        self.grid(file, points, ends.iter().map(|it| it.as_slice()));
    }

    fn push(&mut self, place: Place<'_>, kind: &str, components: &[&str], bytes: Vec<u8>) {
        let width = if kind == "f4" { 4 } else { 8 };
        let bytes = match self.order.rows(place) {
            None => bytes,
            Some(rows) => {
                let size = bytes.len() / rows.len();
                let row = |&row: &u32| &bytes[size * row as usize..size * (row as usize + 1)];
                rows.iter().flat_map(row).copied().collect()
            }
        };
        let Place { file, part, name } = place;
        let (names, offset, count) = (
            components.join(","),
            self.numbers.len(),
            bytes.len() / width,
        );
        // Writing to a string cannot fail.
        let _ = writeln!(
            self.list,
            "{file}\t{part}\t{name}\t{kind}\t{names}\t{offset}\t{count}"
        );
        self.numbers.extend(bytes);
    }

    pub(crate) fn reals(&mut self, place: Place<'_>, values: impl IntoIterator<Item = f64>) {
        let bytes = values.into_iter().flat_map(f64::to_le_bytes).collect();
        self.push(place, "f8", &[], bytes);
    }

    pub(crate) fn singles(&mut self, place: Place<'_>, values: impl IntoIterator<Item = f32>) {
        let bytes = values.into_iter().flat_map(f32::to_le_bytes).collect();
        self.push(place, "f4", &[], bytes);
    }

    pub(crate) fn integers(&mut self, place: Place<'_>, values: impl IntoIterator<Item = i64>) {
        let bytes = values.into_iter().flat_map(i64::to_le_bytes).collect();
        self.push(place, "i8", &[], bytes);
    }

    /// Named components; without names they are those of a vector.
    pub(crate) fn components<const N: usize>(
        &mut self,
        place: Place<'_>,
        names: [&str; N],
        values: impl IntoIterator<Item = [f64; N]>,
    ) {
        let bytes = values.into_iter().flatten().flat_map(f64::to_le_bytes);
        self.push(place, "f8", &names, bytes.collect());
    }

    /// Numbers of a whole file.
    pub(crate) fn field_data(&mut self, file: &str, numbers: &[(&str, f64)]) {
        for (name, number) in numbers {
            let place = Place {
                file,
                part: "field",
                name,
            };
            self.reals(place, [*number]);
        }
    }

    pub(crate) fn texts(&mut self, place: Place<'_>, texts: &[String]) {
        let Place { file, part, name } = place;
        let texts = texts.join("|");
        let _ = writeln!(self.list, "{file}\t{part}\t{name}\ttext\t\t0\t{texts}");
    }

    /// Points (x, y) in the plane, and cells by their points.
    pub(crate) fn grid<'a>(
        &mut self,
        file: &str,
        points: impl IntoIterator<Item = [f64; 2]>,
        cells: impl IntoIterator<Item = &'a [u32]>,
    ) {
        let place = |part| Place {
            file,
            part,
            name: "",
        };
        let points = points.into_iter().map(|[x, y]| [x, y, 0.0]);
        self.components(place("points"), ["", "", ""], points);
        let counted = |cell: &[u32]| {
            let corners: Vec<i64> = cell.iter().map(|&it| i64::from(it)).collect();
            std::iter::once(corners.len() as i64).chain(corners)
        };
        self.integers(place("cells"), cells.into_iter().flat_map(counted));
    }

    /// Writes both files.
    pub(crate) fn write(&self, folder: &Path) {
        std::fs::write(folder.join("expected.tsv"), &self.list).unwrap();
        std::fs::write(folder.join("expected.bin"), &self.numbers).unwrap();
    }
}

/// A table that grows by rows and is expected by columns.
pub(crate) struct Rows {
    names: Vec<String>,
    rows: Vec<Vec<Entry>>,
}

/// An entry of a table.
#[derive(Clone)]
pub(crate) enum Entry {
    Real(f64),
    Integer(i64),
    Text(String),
}

impl From<f64> for Entry {
    fn from(value: f64) -> Self {
        Self::Real(value)
    }
}

impl From<usize> for Entry {
    fn from(value: usize) -> Self {
        Self::Integer(value as i64)
    }
}

impl From<&str> for Entry {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl Rows {
    pub(crate) fn new<S: Into<String>>(names: impl IntoIterator<Item = S>) -> Self {
        Self {
            names: names.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = Entry>) {
        let row: Vec<Entry> = row.into_iter().collect();
        assert_eq!(row.len(), self.names.len(), "{:?}", self.names);
        self.rows.push(row);
    }

    /// The columns of a file, each of the kind of its first entry.
    pub(crate) fn into_expected(self, file: &str, expected: &mut Expected) {
        for (column, name) in self.names.iter().enumerate() {
            let place = Place {
                file,
                part: "column",
                name,
            };
            let (mut reals, mut integers, mut texts) = (Vec::new(), Vec::new(), Vec::new());
            for row in &self.rows {
                match &row[column] {
                    Entry::Real(value) => reals.push(*value),
                    Entry::Integer(value) => integers.push(*value),
                    Entry::Text(text) => texts.push(text.clone()),
                }
            }
            let kinds = [reals.is_empty(), integers.is_empty(), texts.is_empty()];
            assert!(
                kinds.iter().filter(|it| !**it).count() <= 1,
                "{name} is of several kinds"
            );
            match kinds {
                [false, ..] => expected.reals(place, reals),
                [_, false, _] => expected.integers(place, integers),
                _ => expected.texts(place, &texts),
            }
        }
    }
}
