//! Numberings of points: as in the file, and along a space-filling curve.

use std::borrow::Cow;
use std::sync::Arc;

use rayon::prelude::*;

use crate::cell::{Cell, MeshCell};
use crate::curve::along_hilbert_curve;
use crate::mesh::{Group, Mesh, NodeField};

/// Numbering of the points of a body: as in its file, which is the default, or along a space-filling curve. Copies share their lists.
///
/// Points near each other on the curve are near each other in memory, and so are rows of matrices and bonds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Numbering(Option<Arc<Orders>>);

#[derive(Debug, PartialEq, Eq)]
struct Orders {
    /// Number in the file of each point, shape (n_points).
    in_file: Vec<u32>,
    /// Points in the order of the file, shape (n_points).
    points: Vec<u32>,
}

impl Numbering {
    /// Numbering along the Hilbert curve through positions in the order of a file (n_points).
    pub fn along_curve<const D: usize>(positions: &[[f64; D]]) -> Self {
        let in_file = along_hilbert_curve(positions);
        if in_file.is_sorted() {
            return Self::default();
        }
        let mut points = vec![0; in_file.len()];
        for (point, &number) in (0..).zip(&in_file) {
            points[number as usize] = point;
        }
        Self(Some(Arc::new(Orders { in_file, points })))
    }

    /// Number of a point in the file.
    pub fn in_file(&self, point: u32) -> u32 {
        match &self.0 {
            None => point,
            Some(orders) => orders.in_file[point as usize],
        }
    }

    /// Point at a place in the order of the file; for a whole body the place is a number of the file.
    pub fn point(&self, place: u32) -> u32 {
        match &self.0 {
            None => place,
            Some(orders) => orders.points[place as usize],
        }
    }

    /// Numbering of some points (ascending) of a body, which keep their numbers in the file.
    pub fn part(&self, points: &[u32]) -> Self {
        Self::of_numbers(points.iter().map(|&it| self.in_file(it)).collect())
    }

    /// Numbering of points with given numbers in the file (n_points), no two of them the same.
    pub fn of_numbers(in_file: Vec<u32>) -> Self {
        let mut order: Vec<u32> = (0..in_file.len() as u32).collect();
        order.sort_unstable_by_key(|&point| in_file[point as usize]);
        Self(Some(Arc::new(Orders {
            in_file,
            points: order,
        })))
    }

    /// Points in the order of the file, shape (n_points); `None` where that is the order of the points.
    pub fn order_of_file(&self) -> Option<&[u32]> {
        self.0.as_ref().map(|orders| orders.points.as_slice())
    }

    /// Place of each point in the order of the file, shape (n_points); `None` where that is the order of the points.
    pub fn places(&self) -> Option<Vec<u32>> {
        let order = self.order_of_file()?;
        let mut places = vec![0; order.len()];
        for (place, &point) in (0..).zip(order) {
            places[point as usize] = place;
        }
        Some(places)
    }

    /// Some points in the order of the file.
    pub fn sorted<'a>(&self, points: &'a [u32]) -> Cow<'a, [u32]> {
        if self.0.is_none() {
            return Cow::Borrowed(points);
        }
        let mut sorted = points.to_vec();
        sorted.sort_unstable_by_key(|&point| self.in_file(point));
        Cow::Owned(sorted)
    }

    /// Ends of a bond, first the end with the smaller number in the file.
    pub fn ordered(&self, [a, b]: [u32; 2]) -> [u32; 2] {
        match self.in_file(b) < self.in_file(a) {
            true => [b, a],
            false => [a, b],
        }
    }

    /// Numbers in the file of the ends of a bond, ascending.
    pub fn ends_in_file(&self, ends: [u32; 2]) -> [u32; 2] {
        self.ordered(ends).map(|end| self.in_file(end))
    }

    /// Bonds in the order of their ends in the file, shape (n_bonds); `None` where that is the order of the bonds.
    pub fn bonds_in_file(&self, ends: &[[u32; 2]]) -> Option<Vec<u32>> {
        self.0.as_ref()?;
        let in_file = ends.iter().map(|ends| self.ends_in_file(*ends));
        let mut bonds: Vec<([u32; 2], u32)> = in_file.zip(0..).collect();
        bonds.par_sort_unstable();
        Some(bonds.into_iter().map(|(_, bond)| bond).collect())
    }

    /// Reorders values from the order of the points to the order of the file, with any number of values per point.
    pub fn to_file<T: Copy>(&self, values: Vec<T>) -> Vec<T> {
        rows_in_order(self.order_of_file(), values)
    }

    /// Reorders values from the order of the file to the order of the points, with any number of values per point.
    pub fn from_file<T: Copy>(&self, values: Vec<T>) -> Vec<T> {
        let order = self.0.as_ref().map(|orders| orders.in_file.as_slice());
        rows_in_order(order, values)
    }

    /// Cells between the points as cells between their places in the order of the file.
    pub fn cells_in_file<const D: usize, C: MeshCell<D>>(&self, mut cells: Vec<C>) -> Vec<C> {
        let Some(places) = self.places() else {
            return cells;
        };
        for corner in cells.iter_mut().flat_map(C::corners_mut) {
            *corner = places[*corner as usize];
        }
        cells
    }

    fn renumber(&self, in_file: &mut [u32]) {
        for number in in_file {
            *number = self.point(*number);
        }
    }

    /// Groups of a mesh with renumbered nodes.
    fn groups(&self, groups: Vec<Group>) -> Vec<Group> {
        let group = |mut group: Group| {
            self.renumber(&mut group.nodes);
            group.nodes.sort_unstable();
            self.renumber(group.edges.as_flattened_mut());
            group.edges.iter_mut().for_each(|ends| ends.sort_unstable());
            group.edges.sort_unstable();
            self.renumber_cells(&mut group.faces);
            group.faces.sort_by_key(Cell::sorted_corners);
            group
        };
        groups.into_iter().map(group).collect()
    }

    fn renumber_cells<const D: usize, C: MeshCell<D>>(&self, cells: &mut [C]) {
        cells
            .iter_mut()
            .for_each(|it| self.renumber(it.corners_mut()));
    }

    /// Fields of a mesh with renumbered nodes.
    fn fields(&self, fields: Vec<NodeField>) -> Vec<NodeField> {
        let field = |mut field: NodeField| {
            let values = field.values.iter();
            field.values = values.map(|&(node, it)| (self.point(node), it)).collect();
            field.values.sort_unstable_by_key(|(node, _)| *node);
            field
        };
        fields.into_iter().map(field).collect()
    }
}

/// Values in a given order of their rows (n_rows), with any number of values per row.
fn rows_in_order<T: Copy>(order: Option<&[u32]>, values: Vec<T>) -> Vec<T> {
    let Some(order) = order else {
        return values;
    };
    let n = values.len() / order.len().max(1);
    let row = |&row: &u32| &values[n * row as usize..n * (row as usize + 1)];
    order.iter().flat_map(row).copied().collect()
}

impl<const D: usize, C: MeshCell<D>> Mesh<D, C> {
    /// The mesh with its nodes numbered along a curve; cells keep the order of the file.
    pub fn along_curve(self) -> (Self, Numbering) {
        let numbering = Numbering::along_curve(&self.positions);
        let mut cells = self.cells;
        numbering.renumber_cells(&mut cells);
        let mesh = Self {
            node_tags: numbering.from_file(self.node_tags.to_vec()).into(),
            positions: numbering.from_file(self.positions),
            cells,
            groups: numbering.groups(self.groups),
            fields: numbering.fields(self.fields),
            remarks: self.remarks,
        };
        (mesh, numbering)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four nodes of two triangles; the curve visits the first, third, fourth and second in turn: (0, 0), (0, 1), (1, 1), (1, 0).
    fn square() -> Mesh {
        Mesh {
            node_tags: [10, 20, 30, 40].into(),
            positions: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]],
            cells: vec![Cell::Triangle([0, 1, 2]), Cell::Triangle([1, 3, 2])],
            groups: vec![Group {
                nodes: vec![1, 2, 3],
                edges: vec![[1, 3], [2, 3]],
                ..Group::default()
            }],
            fields: vec![NodeField {
                name: "T".to_owned(),
                time_step: 0,
                components: 1,
                values: vec![(1, 0.5), (2, 1.5)],
            }],
            remarks: Vec::new(),
        }
    }

    #[test]
    fn a_mesh_goes_along_the_curve_with_all_that_it_has() {
        let (mesh, numbering) = square().along_curve();
        assert_eq!(*mesh.node_tags, [10, 30, 40, 20]);
        assert_eq!(
            mesh.positions,
            [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]
        );
        let cells = [Cell::Triangle([0, 3, 1]), Cell::Triangle([3, 2, 1])];
        assert_eq!(mesh.cells, cells);
        assert_eq!(mesh.groups[0].nodes, [1, 2, 3]);
        assert_eq!(mesh.groups[0].edges, [[1, 2], [2, 3]]);
        assert_eq!(mesh.fields[0].values, [(1, 1.5), (3, 0.5)]);
        assert_eq!(numbering.to_file(mesh.positions), square().positions);
        assert_eq!(numbering.cells_in_file(mesh.cells), square().cells);
    }

    #[test]
    fn what_is_told_is_in_the_order_of_the_file() {
        let numbering = Numbering::along_curve(&square().positions);
        assert_eq!([0, 1, 2, 3].map(|it| numbering.in_file(it)), [0, 2, 3, 1]);
        assert_eq!([0, 1, 2, 3].map(|it| numbering.point(it)), [0, 3, 1, 2]);
        // Two values a point.
        let values = vec![0, 1, 20, 21, 30, 31, 10, 11];
        let in_file = numbering.to_file(values.clone());
        assert_eq!(in_file, [0, 1, 10, 11, 20, 21, 30, 31]);
        assert_eq!(numbering.from_file(in_file), values);
        assert_eq!(*numbering.sorted(&[1, 2, 3]), [3, 1, 2]);
        // Nodes 2-3, 1-2 and 0-1 of the file.
        let ends = [[1, 2], [1, 3], [0, 3]];
        assert_eq!(
            ends.map(|it| numbering.ends_in_file(it)),
            [[2, 3], [1, 2], [0, 1]]
        );
        assert_eq!(numbering.bonds_in_file(&ends), Some(vec![2, 1, 0]));
        // In a part with nodes 0, 3 and 2 of the file, the last two are exchanged.
        let part = numbering.part(&[0, 2, 3]);
        assert_eq!([0, 1, 2].map(|it| part.in_file(it)), [0, 3, 1]);
        assert_eq!(part.order_of_file(), Some(&[0, 2, 1][..]));
        assert_eq!(part.places(), Some(vec![0, 2, 1]));
    }

    #[test]
    fn points_along_the_curve_keep_their_numbers() {
        let numbering = Numbering::along_curve(&square().along_curve().0.positions);
        assert_eq!(numbering, Numbering::default());
        assert_eq!(numbering.order_of_file(), None);
        assert_eq!(numbering.bonds_in_file(&[[0, 1]]), None);
        assert_eq!(numbering.to_file(vec![3, 1]), [3, 1]);
    }
}
