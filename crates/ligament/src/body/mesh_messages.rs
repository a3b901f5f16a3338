//! Meshed bodies as bytes of messages between processes.

use std::io::Read;

use ligament_analysis::serial::{Damaged, Serial, Sink, write_list};
use ligament_mesh::{Group, Mesh, MeshCell, NodeField, Numbering};

use super::mesh::BodyOnMesh;
use super::mesh_cells::BodyCell;

/// Largest number of corners of a cell.
const MOST_CORNERS: usize = 8;

impl<const D: usize, C: BodyCell<D>> Serial for BodyOnMesh<D, C> {
    fn write(&self, out: &mut dyn Sink) {
        let Self {
            mesh,
            remarks,
            numbering,
            cell_numbers,
        } = self;
        write_list(&mesh.node_tags, out);
        mesh.positions.write(out);
        write_each(&mesh.cells, out, |cell, out| write_cell(cell, out));
        write_each(&mesh.groups, out, write_group);
        write_each(&mesh.fields, out, write_field);
        write_list(remarks, out);
        numbering.order_of_file().is_some().write(out);
        let points = 0..mesh.positions.len() as u32;
        points.for_each(|point| numbering.in_file(point).write(out));
        cell_numbers.write(out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        let node_tags = Vec::<u64>::read(from)?.into();
        let positions = Vec::<[f64; D]>::read(from)?;
        let mesh = Mesh {
            node_tags,
            cells: read_each(from, read_cell)?,
            groups: read_each(from, read_group)?,
            fields: read_each(from, read_field)?,
            remarks: Vec::new(),
            positions,
        };
        let remarks = Vec::read(from)?.into();
        let is_along_curve = bool::read(from)?;
        let in_file = u32::read_list(mesh.positions.len(), from)?;
        Ok(Self {
            mesh,
            remarks,
            numbering: match is_along_curve {
                true => Numbering::of_numbers(in_file),
                false => Numbering::default(),
            },
            cell_numbers: Serial::read(from)?,
        })
    }
}

/// Appends the number of some values, and each of them.
fn write_each<T>(values: &[T], out: &mut dyn Sink, write: impl Fn(&T, &mut dyn Sink)) {
    values.len().write(out);
    values.iter().for_each(|value| write(value, out));
}

/// Reads the number of some values, and each of them.
fn read_each<T>(
    from: &mut dyn Read,
    read: impl Fn(&mut dyn Read) -> Result<T, Damaged>,
) -> Result<Vec<T>, Damaged> {
    let count = usize::read(from)?;
    (0..count).map(|_| read(from)).collect()
}

/// Appends a cell: the number of its corners, by which its kind is known, and these.
fn write_cell<const D: usize, C: MeshCell<D>>(cell: &C, out: &mut dyn Sink) {
    (cell.corners().len() as u8).write(out);
    u32::write_list(cell.corners(), out);
}

fn read_cell<const D: usize, C: MeshCell<D>>(from: &mut dyn Read) -> Result<C, Damaged> {
    let count = usize::from(u8::read(from)?);
    let mut corners = [0; MOST_CORNERS];
    let corners = corners.get_mut(..count).ok_or(Damaged)?;
    for corner in corners.iter_mut() {
        *corner = Serial::read(from)?;
    }
    C::from_corners(corners).ok_or(Damaged)
}

fn write_group(group: &Group, out: &mut dyn Sink) {
    let Group {
        name,
        dimension,
        number,
        nodes,
        edges,
        faces,
        cells,
    } = group;
    name.write(out);
    dimension.write(out);
    number.write(out);
    nodes.write(out);
    edges.write(out);
    write_each(faces, out, |face, out| write_cell::<2, _>(face, out));
    cells.write(out);
}

fn read_group(from: &mut dyn Read) -> Result<Group, Damaged> {
    Ok(Group {
        name: Serial::read(from)?,
        dimension: Serial::read(from)?,
        number: Serial::read(from)?,
        nodes: Serial::read(from)?,
        edges: Serial::read(from)?,
        faces: read_each(from, read_cell::<2, _>)?,
        cells: Serial::read(from)?,
    })
}

fn write_field(field: &NodeField, out: &mut dyn Sink) {
    let NodeField {
        name,
        time_step,
        components,
        values,
    } = field;
    name.write(out);
    time_step.write(out);
    components.write(out);
    values.write(out);
}

fn read_field(from: &mut dyn Read) -> Result<NodeField, Damaged> {
    Ok(NodeField {
        name: Serial::read(from)?,
        time_step: Serial::read(from)?,
        components: Serial::read(from)?,
        values: Serial::read(from)?,
    })
}
