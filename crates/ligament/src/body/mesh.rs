//! A meshed body: points at the nodes, physical groups.

use std::borrow::Cow;
use std::io::Read;
use std::sync::Arc;

use ligament_analysis::serial::{Damaged, Sink};
use ligament_mesh::{Cell, Group, Mesh, MeshCell, NodeField, Numbering, Portion, SolidCell};
use ligament_model::bonds::outline::{Outline, bonds_outside, spacing_inside};
use ligament_model::correction::patch::CellForces;
use ligament_model::far_field::Simplex;
use ligament_model::material::Stiffness;
use ligament_model::surface::{CellFaces, Facet, InnerFace};
use ligament_model::volumetric::VolumetricCells;
use ligament_model::{BodyGrid, BondSet, BondSystem, PointCloud, PointTags, Tags, raised};

use super::cells::among;
use super::interface::{Body, BodyOutline, Geometry, MeshedBody, OffOutline, Origin, Restricted};
use super::mesh_cells::BodyCell;

/// A body with a point at each node of a mesh; its groups are the physical groups.
#[derive(Debug)]
pub struct BodyOnMesh<const D: usize, C> {
    /// The mesh with its nodes numbered along a space-filling curve.
    pub(super) mesh: Mesh<D, C>,
    /// Remarks on the file of the mesh.
    pub(super) remarks: Arc<[String]>,
    pub(super) numbering: Numbering,
    /// Number of each cell in the file, of a part of a mesh, shape (n_cells); empty for a whole mesh.
    pub(super) cell_numbers: Vec<u32>,
}

/// A body meshed with triangles and quadrangles in the plane.
pub type MeshBody = BodyOnMesh<2, Cell>;

/// A body meshed with solid cells.
pub type SolidMeshBody = BodyOnMesh<3, SolidCell>;

impl<const D: usize, C: BodyCell<D>> From<Mesh<D, C>> for BodyOnMesh<D, C> {
    fn from(mesh: Mesh<D, C>) -> Self {
        let (mesh, numbering) = mesh.along_curve();
        let remarks = mesh.remarks.iter();
        Self {
            remarks: remarks.map(ToString::to_string).collect(),
            mesh,
            numbering,
            cell_numbers: Vec::new(),
        }
    }
}

impl<const D: usize, C: BodyCell<D>> BodyOnMesh<D, C> {
    /// Union of the elements that `held` returns for the groups of a name, of all dimensions, ascending; `None` where there is no such
    /// group.
    fn union<T: Copy + Ord>(&self, name: &str, held: fn(&Group) -> &[T]) -> Option<Vec<T>> {
        let mut groups = self.mesh.groups_named(name).peekable();
        groups.peek()?;
        let mut all: Vec<T> = groups.flat_map(held).copied().collect();
        all.sort_unstable();
        all.dedup();
        Some(all)
    }

    /// The nodes, without cells and groups.
    fn without_cells(&self) -> Self {
        Self {
            mesh: Mesh {
                node_tags: self.mesh.node_tags.clone(),
                positions: self.mesh.positions.clone(),
                ..Mesh::default()
            },
            remarks: Arc::default(),
            numbering: self.numbering.clone(),
            cell_numbers: Vec::new(),
        }
    }

    /// Some nodes (ascending), without cells.
    fn some_nodes(&self, nodes: &[u32]) -> Mesh<D, C> {
        let of_nodes = nodes.iter().map(|&node| node as usize);
        Mesh {
            node_tags: of_nodes.clone().map(|it| self.mesh.node_tags[it]).collect(),
            positions: of_nodes.map(|it| self.mesh.positions[it]).collect(),
            ..Mesh::default()
        }
    }

    /// Some cells between some nodes (ascending), numbered among these.
    fn cells_between(&self, cells: impl Iterator<Item = usize>, nodes: &[u32]) -> Vec<C> {
        let node = |node: u32| nodes.partition_point(|it| *it < node) as u32;
        let cells = cells.map(|cell| self.mesh.cells[cell]);
        cells.map(|cell| renumbered(cell, node)).collect()
    }

    /// Sides of cells that `held` returns for the groups of a name.
    fn of_groups<T: Copy>(&self, name: &str, held: fn(&Group) -> &[T]) -> Vec<T> {
        let groups = self.mesh.groups_named(name);
        groups.flat_map(held).copied().collect()
    }
}

/// A cell with other numbers of its corners.
fn renumbered<const D: usize, C: MeshCell<D>>(mut cell: C, number: impl Fn(u32) -> u32) -> C {
    for corner in cell.corners_mut() {
        *corner = number(*corner);
    }
    cell
}

/// The outline of a mesh, with its cells.
struct MeshOutline<'a, const D: usize, C: BodyCell<D>> {
    outline: C::Outline,
    cells: &'a [C],
}

impl<const D: usize, C: BodyCell<D>> BodyOutline<D> for MeshOutline<'_, D, C> {
    fn first_crossing(&self) -> Option<[u32; 2]> {
        self.outline.first_crossing()
    }

    fn spacing(&self, cloud: &PointCloud<D>) -> Vec<f64> {
        spacing_inside(&self.outline, self.cells, cloud)
    }

    fn is_crossed_by_bonds(&self, bonds: &BondSet<D>, cloud: &PointCloud<D>) -> Vec<bool> {
        bonds_outside(&self.outline, bonds, cloud)
    }
}

impl<const D: usize, C: BodyCell<D>> Body for BodyOnMesh<D, C> {
    fn origin(&self) -> Origin<'_> {
        C::origin(&self.mesh)
    }

    fn n_points(&self) -> usize {
        self.mesh.positions.len()
    }

    fn position(&self, point: u32) -> Vec<f64> {
        self.mesh.positions[point as usize].to_vec()
    }

    fn numbering(&self) -> Numbering {
        self.numbering.clone()
    }

    fn tagged(&self) -> &'static str {
        "node"
    }

    fn tag(&self, point: u32) -> u64 {
        self.mesh.node_tags[point as usize]
    }

    fn n_cells(&self) -> usize {
        self.mesh.cells.len()
    }

    fn group_kind(&self) -> &'static str {
        "physical group in the mesh"
    }

    fn group_names(&self) -> Vec<String> {
        let groups = self.mesh.groups.iter();
        groups.map(|group| group.name.clone()).collect()
    }

    fn points_of(&self, group: &str) -> Option<Vec<u32>> {
        self.union(group, |group| &group.nodes)
    }

    fn cells_of(&self, group: &str) -> Option<Vec<u32>> {
        self.union(group, |group| &group.cells)
    }

    /// The edges of a curve group.
    fn lengths_of(&self, group: &str) -> Vec<Portion<1>> {
        self.mesh.edge_portions(&self.curve_of(group))
    }

    fn curve_of(&self, group: &str) -> Vec<[u32; 2]> {
        self.of_groups(group, |it| &it.edges)
    }

    /// The triangles of the faces of a surface group.
    fn areas_of(&self, group: &str) -> Vec<Portion<1>> {
        C::face_portions(&self.mesh, &self.of_groups(group, |it| &it.faces))
    }

    fn faces_of(&self, group: &str) -> Option<Vec<Cell>> {
        Some(self.of_groups(group, |it| &it.faces))
    }

    fn around(&self, point: u32) -> Vec<u32> {
        let corners = self.mesh.cells.iter().map(C::corners);
        let around = corners.filter(|it| it.contains(&point));
        around.flatten().copied().collect()
    }

    fn corners(&self) -> Vec<&[u32]> {
        self.mesh.cells.iter().map(C::corners).collect()
    }

    fn edges(&self) -> Vec<[u32; 2]> {
        self.mesh.cells.iter().flat_map(C::edges).collect()
    }

    fn fields(&self) -> &[NodeField] {
        &self.mesh.fields
    }

    /// Whether each node lies on a side that only one cell has, shape (n_points).
    fn rim(&self) -> Vec<bool> {
        let mut marked = vec![false; self.mesh.positions.len()];
        for &node in self.outer_sides().as_flattened() {
            marked[node as usize] = true;
        }
        marked
    }

    fn remarks(&self) -> Vec<String> {
        let remarks = self.remarks.iter();
        remarks.map(|remark| format!("mesh: {remark}")).collect()
    }

    fn point_tags(&self) -> PointTags {
        PointTags {
            numbering: self.numbering(),
            tags: Tags::Listed(self.mesh.node_tags.clone()),
        }
    }

    fn names(self: Arc<Self>) -> Arc<dyn Body> {
        match self.mesh.cells.is_empty() {
            true => self,
            false => Arc::new(self.without_cells()),
        }
    }

    fn grid(&self) -> BodyGrid {
        BodyGrid {
            numbering: self.numbering(),
            positions: raised(&self.mesh.positions),
            tags: self.mesh.node_tags.iter().map(|&tag| tag as i64).collect(),
            tagged: self.tagged(),
            cell_numbers: self.cell_numbers.clone(),
            of_body: None,
            canvas: C::canvas(&self.mesh.cells),
        }
    }
}

impl<const D: usize, C: BodyCell<D>> Geometry<D> for BodyOnMesh<D, C> {
    fn positions(&self) -> Cow<'_, [[f64; D]]> {
        Cow::Borrowed(&self.mesh.positions)
    }

    fn cloud(&self, thickness: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<D> {
        PointCloud {
            numbering: self.numbering(),
            ..PointCloud::from_mesh(&self.mesh, thickness, material_of_cell, n_materials)
        }
    }

    fn outer_sides(&self) -> Vec<[u32; D]> {
        C::outer_sides(&self.mesh.cells, self.mesh.positions.len())
    }

    fn facets(&self, cloud: &PointCloud<D>) -> Vec<Facet<D>> {
        let faces = C::outer_faces(&self.mesh.cells, self.mesh.positions.len());
        let facets = faces.iter().flat_map(|it| Facet::on_side(cloud, it));
        facets.collect()
    }

    /// Cells around the nodes: the corners of the cells of the mesh, cut off by lines between the middles of their edges, faces and cells.
    fn cell_faces(&self, cloud: &PointCloud<D>) -> Option<CellFaces<D>> {
        let at = |node: u32| cloud.positions[node as usize];
        let outer = C::outer_faces(&self.mesh.cells, self.mesh.positions.len());
        let cells = self.mesh.cells.iter();
        let faces = cells.flat_map(|cell| cell.faces_between_corners(&at));
        Some(CellFaces {
            outline: CellFaces::outline(cloud, &outer),
            inner: faces
                .map(|(points, corners)| InnerFace::new(cloud, points, corners))
                .collect(),
        })
    }

    /// Linear elements from the triangles or tetrahedra that make up the cells.
    fn with_far_field(
        &self,
        system: BondSystem<D>,
        cells: &[usize],
        material_of_cell: &[u32],
    ) -> BondSystem<D> {
        let simplices = cells.iter().flat_map(|&cell| {
            let material = material_of_cell[cell];
            let parts = self.mesh.cells[cell].simplices().into_iter();
            parts.map(move |cell| Simplex { cell, material })
        });
        system.with_far_field(&simplices.collect::<Vec<_>>())
    }

    fn volumetric_cells(
        &self,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
        _: &[f64],
    ) -> VolumetricCells<D> {
        let mut cells = VolumetricCells::default();
        for (cell, &material) in self.mesh.cells.iter().zip(material_of_cell) {
            cells.push_cell(cell, &cell.simplices(), material, cloud);
        }
        cells
    }

    /// A body of some cells and their nodes, without groups.
    fn part(&self, cells: &[usize]) -> Option<Arc<dyn Geometry<D>>> {
        let corners = cells
            .iter()
            .flat_map(|&cell| self.mesh.cells[cell].corners());
        let mut nodes: Vec<u32> = corners.copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        Some(Arc::new(Self {
            mesh: Mesh {
                cells: self.cells_between(cells.iter().copied(), &nodes),
                ..self.some_nodes(&nodes)
            },
            remarks: Arc::default(),
            numbering: Numbering::default(),
            cell_numbers: Vec::new(),
        }))
    }

    fn restricted(&self, points: &[u32], cells: &[u32]) -> Restricted<D> {
        let is_inside = |corners: &[u32]| {
            let mut corners = corners.iter();
            corners.all(|it| points.binary_search(it).is_ok())
        };
        let cells = cells.iter().copied();
        let cells = cells.filter(|&it| is_inside(self.corners_of(it)));
        let cells: Vec<u32> = cells.collect();
        let node = |node: u32| points.partition_point(|it| *it < node) as u32;
        let group = |group: &Group| Group {
            name: group.name.clone(),
            nodes: among(&group.nodes, points),
            edges: (group.edges.iter())
                .filter(|edge| is_inside(*edge))
                .map(|edge| edge.map(node))
                .collect(),
            faces: (group.faces.iter())
                .filter(|face| is_inside(face.corners()))
                .map(|face| renumbered(*face, node))
                .collect(),
            cells: among(&group.cells, &cells),
            ..*group
        };
        let field = |field: &NodeField| {
            let value = |(place, node): (u32, &u32)| {
                let found = field.values.binary_search_by_key(node, |(it, _)| *it);
                Some((place, field.values[found.ok()?].1))
            };
            NodeField {
                name: field.name.clone(),
                values: (0..).zip(points).filter_map(value).collect(),
                ..*field
            }
        };
        let mesh = Mesh {
            cells: self.cells_between(cells.iter().map(|&it| it as usize), points),
            groups: self.mesh.groups.iter().map(group).collect(),
            fields: self.mesh.fields.iter().map(field).collect(),
            ..self.some_nodes(points)
        };
        let body = Arc::new(Self {
            mesh,
            remarks: self.remarks.clone(),
            numbering: self.numbering.part(points),
            cell_numbers: cells.clone(),
        });
        Restricted { body, cells }
    }

    fn meshed(&self) -> Option<&dyn MeshedBody<D>> {
        Some(self)
    }

    fn outline(&self, cloud: &PointCloud<D>) -> Option<Box<dyn BodyOutline<D> + '_>> {
        let cells = self.mesh.cells.as_slice();
        let outline = C::outline(cells, cloud);
        Some(Box::new(MeshOutline { outline, cells }))
    }

    fn composed(&self, bonds: BondSet<D>, cloud: &PointCloud<D>, materials: &[u32]) -> BondSet<D> {
        C::composed(bonds, &self.mesh.cells, cloud, materials)
    }

    fn cell_forces(
        &self,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
        stiffness: Vec<Stiffness>,
    ) -> CellForces<D> {
        C::forces(&self.mesh.cells, cloud, material_of_cell, stiffness)
    }

    fn interpolation_weights(&self, position: [f64; D]) -> Option<Vec<(u32, f64)>> {
        C::interpolation_weights(&self.mesh, position)
    }

    /// The edges or triangles of the outline's sides along a group.
    fn outline_of(&self, group: &str) -> Result<Vec<Portion<D>>, OffOutline> {
        C::outward(
            &self.mesh,
            &self.mesh.groups_named(group).collect::<Vec<_>>(),
        )
    }
}

impl<const D: usize, C: BodyCell<D>> MeshedBody<D> for BodyOnMesh<D, C> {
    fn corners_of(&self, cell: u32) -> &[u32] {
        self.mesh.cells[cell as usize].corners()
    }

    fn nodes(&self, thickness: f64, n_materials: usize) -> PointCloud<D> {
        PointCloud {
            numbering: self.numbering(),
            ..PointCloud::at(&self.mesh.positions, thickness, n_materials)
        }
    }

    fn write_nodes(&self, out: &mut dyn Sink) {
        self.without_cells().write(out);
    }

    fn write(&self, out: &mut dyn Sink) {
        self.write(out);
    }

    fn read(&self, from: &mut dyn Read) -> Result<Arc<dyn Geometry<D>>, Damaged> {
        Ok(Arc::new(Self::read(from)?))
    }
}
