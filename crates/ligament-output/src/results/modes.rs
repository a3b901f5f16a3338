//! The modes of a body: a table, and a file of fields for each.
//!
//! | file | holds |
//! |---|---|
//! | `modes.csv` | a row a mode |
//! | `mode_NNNN.vtu`, `modes.pvd` | shapes on the cells of the mesh or the lattice; the time is the number of the mode |

use ligament_analysis::Bonds;
use ligament_analysis::modal::ModalOutcome;
use ligament_model::{BodyGrid, FixedFields};

use super::grid::{fixed_fields, write_grid};
use super::point_fields::{Rotations, vectors};
use crate::Error;
use crate::csv::{Table, Value};
use crate::folder::ResultFolder;
use crate::pvd::Collection;
use crate::vtu::Field;

const COLUMNS: [&str; 6] = [
    "mode",
    "kind",
    "frequency_hz",
    "angular_frequency",
    "eigenvalue",
    "residual",
];

/// Columns of the masses and inertias in a mode, and of their shares in what can move, in the plane and ...
const IN_PLANE: [&str; 6] = [
    "effective_mass_x",
    "effective_mass_y",
    "effective_inertia",
    "share_x",
    "share_y",
    "share_inertia",
];

/// ... in space.
const IN_SPACE: [&str; 12] = [
    "effective_mass_x",
    "effective_mass_y",
    "effective_mass_z",
    "effective_inertia_x",
    "effective_inertia_y",
    "effective_inertia_z",
    "share_x",
    "share_y",
    "share_z",
    "share_inertia_x",
    "share_inertia_y",
    "share_inertia_z",
];

/// Writes all modes of a body.
pub fn write_modes(
    folder: &ResultFolder,
    grid: &BodyGrid,
    system: &dyn Bonds,
    fixed: &FixedFields,
    outcome: &ModalOutcome,
) -> Result<(), Error> {
    let layout = system.layout();
    let effective: &[&str] = if layout.is_in_space() {
        &IN_SPACE
    } else {
        &IN_PLANE
    };
    let columns = [&COLUMNS, effective].concat();
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
        row.extend(effective.chain(shares).map(Value::from));
        table.append(&row)?;
        let name = format!("mode_{number:04}.vtu");
        let displacement = vectors(layout, &mode.shape);
        let rotations = Rotations::read(layout, &mode.shape);
        let mut fields = vec![
            rotations.field(),
            Field::scalar("strain_energy_density", &mode.strain_energy_density),
            Field::integer(grid.tagged, &grid.tags),
        ];
        fields.extend(fixed_fields(fixed, system.volumes(), system.spacing()));
        write_grid(
            &folder.file(&name),
            grid,
            Some(&displacement),
            &fields,
            system.subdomain(),
        )?;
        collection.append(f64::from(number), name)?;
    }
    Ok(())
}
