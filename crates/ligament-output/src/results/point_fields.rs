//! Fields of the points, on the cells of the mesh or the lattice.

use std::path::Path;

use ligament_analysis::history::{StepRecord, View};
use ligament_analysis::result_fields::{
    Components, FIELDS, FieldValues, HELD, HORIZON, ModelPoints, ResultField,
};
use ligament_model::ghosts::Ghosts;
use ligament_model::subdomain::Subdomain;
use ligament_model::{BodyGrid, Canvas, ConstantFields};

use super::grid::{fixed_fields, write_grid};
use super::rule::{WriteRule, field_data};
use crate::vtu::Field;
use crate::vtu::read::VtuFile;
use crate::{Error, FieldLocation};

/// Fields of a state with their values.
pub(super) type PointFields = Vec<(&'static ResultField, FieldValues)>;

/// Writes the fields of a state.
pub(super) fn write(
    path: &Path,
    grid: &BodyGrid,
    fixed: &ConstantFields,
    rule: WriteRule,
    (record, view): (&StepRecord, &View<'_>),
) -> Result<(), Error> {
    let system = view.system;
    let mut values = point_fields(rule, view);
    let ghosts = corners(grid, &system.subdomain);
    for (field, values) in &mut values {
        // Only the owner of a point has all of its bonds.
        if let FieldValues::Numbers(values) = values {
            ghosts.update(values, field.components_of_body(system).count());
        }
    }
    let mut fields = Vec::new();
    for (field, values) in &values {
        fields.push(vtu_field(field, field.components_of_body(system), values));
        if field.name == HELD.name {
            fields.push(Field::integer(grid.tagged, &grid.tags));
        }
    }
    fields.extend(fixed_fields(ModelPoints {
        fixed,
        volumes: &system.volumes,
        spacing: &system.spacing,
    }));
    let whole = (&system.subdomain, &field_data(record)[..]);
    write_grid(path, grid, &fields, whole)
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
