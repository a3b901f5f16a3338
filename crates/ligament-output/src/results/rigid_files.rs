//! Surfaces of rigid bodies, one file for each state with fields.

use std::path::{Path, PathBuf};

use ligament_analysis::contact::{RigidBody, RigidState};
use ligament_analysis::result_fields::DISPLACEMENT;

use crate::Error;
use crate::FieldLocation;
use crate::vtu::read::VtuFile;
use crate::vtu::{Cell, Cells, Field, UnstructuredGrid, write_vtu};

/// Beginning of the name of a file of rigid bodies, in the place of that of the fields.
pub(super) const STEM: &str = "rigid";
const FIELDS: &str = "fields";

/// Rigid bodies in a state, by their surfaces.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StoredRigidBodies {
    /// Places at the start, shape (n_places), m.
    pub places: Vec<[f64; 3]>,
    /// Displacements of the places, m.
    pub displacement: Vec<[f64; 3]>,
    /// Triangles by their corners.
    pub triangles: Vec<[u32; 3]>,
}

impl StoredRigidBodies {
    /// The bodies with a multiple of their displacements.
    #[must_use]
    pub fn moved(mut self, factor: f64) -> Self {
        for (place, way) in self.places.iter_mut().zip(&self.displacement) {
            for (it, along) in place.iter_mut().zip(way) {
                *it += factor * along;
            }
        }
        self
    }
}

/// Name of the file of rigid bodies beside a file of fields.
pub(super) fn name_beside(fields: &str) -> String {
    fields.replacen(FIELDS, STEM, 1)
}

/// Writes the surfaces of rigid bodies in their states, with the number of the body of each triangle in the order of the case, from 1.
pub(super) fn write(
    path: &Path,
    bodies: &[RigidBody],
    states: &[RigidState],
    field_data: &[(&str, f64)],
) -> Result<(), Error> {
    let (mut places, mut displacement, mut cells, mut numbers) = (vec![], vec![], vec![], vec![]);
    for (number, (body, state)) in (1..).zip(bodies.iter().zip(states)) {
        let first = places.len() as u32;
        places.extend(&body.surface.places);
        displacement.extend(body.surface.displacements(state));
        let corners = body.surface.triangles.iter();
        cells.extend(corners.map(|it| Cell::Triangle(it.map(|corner| first + corner))));
        numbers.resize(cells.len(), number);
    }
    let grid = UnstructuredGrid {
        points: &places,
        cells: Cells::Mixed(&cells),
        point_fields: &[Field::vector(DISPLACEMENT.name, &displacement)],
        cell_fields: &[Field::integer("rigid_body", &numbers)],
        field_data,
    };
    write_vtu(path, &grid)
}

/// The rigid bodies in the state of a file of fields; none where the run has none.
///
/// # Errors
///
/// If their file is damaged.
pub fn stored_rigid_bodies(fields: &Path) -> Result<Option<StoredRigidBodies>, Error> {
    let name = fields.file_name().and_then(|it| it.to_str());
    let path: PathBuf = fields.with_file_name(name_beside(name.unwrap_or_default()));
    if path == fields || !path.is_file() {
        return Ok(None);
    }
    let file = VtuFile::open(path)?;
    let displacement = file.finite_numbers(FieldLocation::Point, DISPLACEMENT.name)?;
    let triangle = |cell: Cell| match cell {
        Cell::Triangle(corners) => Some(corners),
        _ => None,
    };
    Ok(Some(StoredRigidBodies {
        places: file.points()?,
        displacement: displacement.as_chunks().0.to_vec(),
        triangles: file.cells()?.into_iter().filter_map(triangle).collect(),
    }))
}
