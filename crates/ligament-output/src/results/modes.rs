//! Result files of natural modes: a table, and a file of fields for each mode.
//!
//! | file | holds |
//! |---|---|
//! | `modes.csv` | one row per mode |
//! | `mode_NNNN.vtu`, `modes.pvd` | shapes on cells of the mesh or lattice; the time is the number of the mode, the frequency is field data |

use ligament_analysis::Bonds;
use ligament_analysis::modal::ModalOutcome;
use ligament_analysis::result_fields::{
    DISPLACEMENT, FieldValues, ModelPoints, ROTATION, STRAIN_ENERGY_DENSITY, rotations, vectors,
};
use ligament_model::{BodyGrid, ConstantFields};

use super::columns::{MODES, names};
use super::grid::{fixed_fields, material_of_cells, write_grid};
use super::point_fields::vtu_field;
use crate::Error;
use crate::csv::{Table, Value};
use crate::folder::ResultFolder;
use crate::pvd::Collection;
use crate::vtu::{Field, TIME_VALUE};

/// Writes all modes of a body.
pub fn write_modes(
    folder: &ResultFolder,
    grid: &BodyGrid,
    system: &dyn Bonds,
    fixed: &ConstantFields,
    outcome: &ModalOutcome,
) -> Result<(), Error> {
    let layout = system.layout;
    let columns = names(MODES, layout.is_in_space());
    let model = ModelPoints {
        fixed,
        volumes: &system.volumes,
        spacing: &system.spacing,
    };
    let mut table = Table::create(folder.file("modes.csv"), &columns)?;
    let mut collection = Collection::new(folder.file("modes.pvd"));
    for (number, mode) in (1_u32..).zip(&outcome.modes) {
        let effective = mode.participation.iter().map(|factor| factor * factor);
        let shares = outcome.moving.shares(&mode.participation);
        let mut row: Vec<Value<'_>> = vec![
            number.into(),
            mode.kind.name().into(),
            mode.frequency().into(),
            mode.angular_frequency().into(),
            mode.eigenvalue.into(),
            mode.residual.into(),
        ];
        let participation = mode.participation.iter().copied();
        row.extend(
            effective
                .chain(shares)
                .chain(participation)
                .map(Value::from),
        );
        table.append(&row)?;
        let name = format!("mode_{number:04}.vtu");
        let values = [
            (&DISPLACEMENT, vectors(layout, &mode.shape)),
            (&ROTATION, rotations(layout, &mode.shape)),
            (&STRAIN_ENERGY_DENSITY, mode.strain_energy_density.clone()),
        ];
        let values = values.map(|(field, values)| (field, FieldValues::Numbers(values)));
        let in_space = layout.is_in_space();
        let fields = values
            .iter()
            .map(|(field, it)| vtu_field(field, field.components(in_space), it));
        let tags = Field::integer(grid.tagged, &grid.tags);
        let fields: Vec<Field<'_>> = fields.chain([tags]).chain(fixed_fields(model)).collect();
        let time = f64::from(number);
        let field_data = [(TIME_VALUE, time), ("frequency_hz", mode.frequency())];
        let whole = (&system.subdomain, &field_data[..]);
        let of_cells = material_of_cells(model);
        write_grid(&folder.file(&name), grid, [&fields, &of_cells], whole)?;
        collection.append(time, name)?;
    }
    Ok(())
}
