//! Fields of the points, on the cells of the mesh or the lattice.

use std::collections::HashMap;
use std::path::Path;

use ligament_analysis::history::View;
use ligament_analysis::result_fields::{
    Components, FIELDS, FieldValues, HELD, HORIZON, MATERIAL, ModelPoints, ResultField,
};
use ligament_model::ghosts::Ghosts;
use ligament_model::subdomain::Subdomain;
use ligament_model::{BodyGrid, Canvas, ConstantFields};

use super::grid::{fixed_fields, material_of_cells, write_grid};
use super::rule::{WriteRule, WrittenState};
use crate::vtu::read::VtuFile;
use crate::vtu::{Cell, Field};
use crate::{Error, FieldLocation};

/// Distance over the first side of a lattice within which corners of its cells are one place.
const SAME: f64 = 1e-3;

/// Fields of a state with their values.
pub(super) type PointFields = Vec<(&'static ResultField, FieldValues)>;

/// Writes the fields of a state.
pub(super) fn write(
    path: &Path,
    grid: &BodyGrid,
    fixed: &ConstantFields,
    rule: WriteRule,
    written: WrittenState<'_>,
) -> Result<(), Error> {
    let system = written.view.system;
    let mut values = point_fields(rule, written.view);
    let ghosts = corners(grid, &system.subdomain);
    for (field, values) in &mut values {
        // Only the owner of a point has all of its bonds.
        if let FieldValues::Numbers(values) = values {
            ghosts.update(
                values,
                field.components(system.layout.is_in_space()).count(),
            );
        }
    }
    let mut fields = Vec::new();
    for (field, values) in &values {
        let components = field.components(system.layout.is_in_space());
        fields.push(vtu_field(field, components, values));
        if field.name == HELD.name {
            fields.push(Field::integer(grid.tagged, &grid.tags));
        }
    }
    let model = ModelPoints {
        fixed,
        volumes: &system.volumes,
        spacing: &system.spacing,
    };
    fields.extend(fixed_fields(model));
    let whole = (&system.subdomain, &written.field_data()[..]);
    write_grid(path, grid, [&fields, &material_of_cells(model)], whole)
}

/// The fields of a state in the order of the files, with the stresses demanded by the rule; where the body is divided, values are right at
/// owned points only.
pub(super) fn point_fields(rule: WriteRule, view: &View<'_>) -> PointFields {
    let fields = FIELDS.iter().filter(|it| rule.includes(&it.reading));
    fields
        .filter_map(|field| Some((*field, field.values(view)?)))
        .collect()
}

/// Location of the fields of the points in a file: for a lattice on its cells.
pub fn location(file: &VtuFile) -> FieldLocation {
    let is_mesh = (file.components(FieldLocation::Point, HORIZON.name)).is_some();
    match is_mesh {
        true => FieldLocation::Point,
        false => FieldLocation::Cell,
    }
}

/// Sides of cells in the plane on which the material of another cell begins, by the numbers of their corners in the file, in the order of the
/// cells; none for a body of one material, or a solid.
///
/// # Errors
///
/// If the file is damaged.
pub fn sides_between_materials(file: &VtuFile) -> Result<Vec<[u32; 2]>, Error> {
    let Some(materials) = file.integers(FieldLocation::Cell, MATERIAL.name)? else {
        return Ok(Vec::new());
    };
    let (places, cells) = (file.points()?, file.cells()?);
    // Nodes of a mesh are told apart by their numbers; cells of a lattice have corners of their own at the same places.
    let is_mesh = location(file) == FieldLocation::Point;
    let first = cells.first().map_or(&[][..], Cell::points);
    let [origin, next] = [0, 1].map(|it| first.get(it).map_or([0.0; 3], |it| places[*it as usize]));
    let grain = SAME * (next[0] - origin[0]).hypot(next[1] - origin[1]);
    let key = |corner: u32| match is_mesh {
        true => [i64::from(corner), 0],
        false => [0, 1].map(|axis| {
            let along = places[corner as usize][axis] - origin[axis];
            (along / grain).round() as i64
        }),
    };
    let mut first_of_side: HashMap<[[i64; 2]; 2], i64> = HashMap::new();
    let mut sides = Vec::new();
    let planar = cells
        .iter()
        .zip(&materials)
        .filter(|it| it.0.planar().is_some());
    for (cell, &material) in planar {
        let corners = cell.points();
        for (place, &from) in corners.iter().enumerate() {
            let to = corners[(place + 1) % corners.len()];
            let mut ends = [from, to].map(key);
            ends.sort_unstable();
            if *first_of_side.entry(ends).or_insert(material) != material {
                sides.push([from, to]);
            }
        }
    }
    Ok(sides)
}

/// A result field as a field of a VTU file.
pub(super) fn vtu_field<'a>(
    field: &ResultField,
    components: Components,
    values: &'a FieldValues,
) -> Field<'a> {
    match values {
        FieldValues::Integers(values) => Field::integer(field.name, values),
        FieldValues::Numbers(values) => {
            Field::numbers(field.name, components.count(), components.names(), values)
        }
    }
}

/// Ghost points at the corners of the cells that this process writes: the cells whose first corner it owns.
fn corners(grid: &BodyGrid, subdomain: &Subdomain) -> Ghosts {
    if subdomain.is_whole() {
        return Ghosts::new(subdomain, std::iter::empty());
    }
    let of_own = |corners: &[u32]| match subdomain.owns(corners[0]) {
        true => corners.to_vec(),
        false => Vec::new(),
    };
    let seen: Vec<u32> = match &grid.canvas {
        Canvas::Between(cells) => cells.iter().flat_map(|it| of_own(it.corners())).collect(),
        Canvas::Solid(cells) => cells.iter().flat_map(|it| of_own(it.corners())).collect(),
        Canvas::Around(_) | Canvas::Boxes(_) => Vec::new(),
    };
    Ghosts::new(subdomain, seen.into_iter())
}
