//! Fields on the points, over the original cells of the mesh.

use std::path::Path;

use ligament_analysis::COMPONENTS;
use ligament_analysis::fields;
use ligament_analysis::history::View;
use ligament_analysis::stress::{traction, virial};
use ligament_mesh::{Cell, Mesh};

use super::WriteRule;
use crate::Error;
use crate::vtu::{self, Field, UnstructuredGrid};

/// The mesh as output files show it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshCells {
    /// Positions in the mesh file, shape (n_points), m.
    pub positions: Vec<[f64; 2]>,
    /// Tags of the nodes in the mesh file, shape (n_points).
    pub node_tags: Vec<i64>,
    /// Cells, shape (n_cells).
    pub cells: Vec<vtu::Cell>,
}

impl From<&Mesh> for MeshCells {
    fn from(mesh: &Mesh) -> Self {
        let cell = |cell: &Cell| match *cell {
            Cell::Triangle(corners) => vtu::Cell::Triangle(corners),
            Cell::Quadrangle(corners) => vtu::Cell::Quad(corners),
        };
        Self {
            positions: mesh.positions.clone(),
            node_tags: mesh.node_tags.iter().map(|&tag| tag as i64).collect(),
            cells: mesh.cells.iter().map(cell).collect(),
        }
    }
}

/// Fields that do not change during a run, beside those of the bond system.
#[derive(Debug, Clone, PartialEq)]
pub struct FixedFields {
    /// Horizons, shape (n_points), m.
    pub horizon: Vec<f64>,
    /// Share of its bonds that pre-cracks cut, shape (n_points).
    pub precrack_share: Vec<f64>,
    /// Energy density over the continuum's for uniaxial x, uniaxial y, biaxial and shear strain, shape (4, n_points).
    pub energy_ratios: [Vec<f64>; 4],
    /// Omega of each bond, shape (n_bonds).
    pub domain_factor: Vec<f64>,
}

impl FixedFields {
    fn fields<'a>(&'a self, volumes: &'a [f64], spacing: &'a [f64]) -> Vec<Field<'a>> {
        let [uniaxial_x, uniaxial_y, biaxial, shear] = &self.energy_ratios;
        vec![
            Field::scalar("volume", volumes),
            Field::scalar("horizon", &self.horizon),
            Field::scalar("nearest_distance", spacing),
            Field::scalar("precrack_share", &self.precrack_share),
            Field::scalar("energy_ratio_x", uniaxial_x),
            Field::scalar("energy_ratio_y", uniaxial_y),
            Field::scalar("energy_ratio_biaxial", biaxial),
            Field::scalar("energy_ratio_shear", shear),
        ]
    }
}

/// Writes the fixed fields, volumes (n_points) and nearest distances (n_points) alone: what `check` shows.
pub fn point_grid(
    path: &Path,
    cells: &MeshCells,
    volumes: &[f64],
    spacing: &[f64],
    fixed: &FixedFields,
) -> Result<(), Error> {
    let mut point_fields = fixed.fields(volumes, spacing);
    point_fields.push(Field::integer("node", &cells.node_tags));
    write_grid(path, cells, &point_fields)
}

/// Writes the fields of a state.
pub(super) fn write(
    path: &Path,
    cells: &MeshCells,
    fixed: &FixedFields,
    rule: WriteRule,
    view: &View<'_>,
) -> Result<(), Error> {
    let (system, state, balanced) = (view.system, view.state, view.balanced);
    let displacement = displacements(view);
    let rotation: Vec<f64> = state
        .displacement
        .chunks(COMPONENTS)
        .map(|motion| motion[2])
        .collect();
    let damage = fields::damage(system, &state.intact);
    let density = fields::strain_energy_density(system, &state.intact, &balanced.deformations);
    let reactions = view
        .boundary
        .reactions(state.load_factor, &balanced.internal.values);
    let reaction: Vec<[f64; 3]> = in_plane(&reactions);
    let fragment: Vec<i64> = view
        .fragments
        .of_point
        .iter()
        .map(|&fragment| i64::from(fragment))
        .collect();
    let held: Vec<i64> = state
        .held
        .chunks(COMPONENTS)
        .map(|held| i64::from(held.contains(&true)))
        .collect();
    let mut point_fields = vec![
        Field::vector("displacement", &displacement),
        Field::scalar("rotation", &rotation),
        Field::scalar("damage", &damage),
        Field::scalar("strain_energy_density", &density),
        Field::vector("reaction", &reaction),
        Field::integer("fragment", &fragment),
        Field::integer("held", &held),
        Field::integer("node", &cells.node_tags),
    ];
    let stress_virial = rule
        .virial
        .then(|| virial::stress(system, &state.intact, &balanced.deformations));
    if let Some(stress) = &stress_virial {
        let values = stress.as_flattened();
        point_fields.push(Field::components(
            "stress_virial",
            &["xx", "yy", "xy"],
            values,
        ));
    }
    let stress_traction = rule
        .traction
        .then(|| traction::stress(system, &state.intact, &balanced.deformations));
    if let Some(stress) = &stress_traction {
        let values = stress.as_flattened();
        point_fields.push(Field::components(
            "stress_traction",
            &["xx", "yx", "yy", "xy"],
            values,
        ));
    }
    let cloud = &system.cloud;
    point_fields.extend(fixed.fields(&cloud.volumes, &cloud.spacing));
    write_grid(path, cells, &point_fields)
}

/// Displacements of the points.
pub(super) fn displacements(view: &View<'_>) -> Vec<[f64; 3]> {
    in_plane(&view.state.displacement)
}

/// The x and y components with a third of zero, as readers expect vectors, shape (n_points).
fn in_plane(values: &[f64]) -> Vec<[f64; 3]> {
    values
        .chunks(COMPONENTS)
        .map(|components| [components[0], components[1], 0.0])
        .collect()
}

fn write_grid(path: &Path, cells: &MeshCells, point_fields: &[Field<'_>]) -> Result<(), Error> {
    let grid = UnstructuredGrid {
        points: &cells.positions,
        cells: &cells.cells,
        point_fields,
        cell_fields: &[],
    };
    vtu::write_vtu(path, &grid)
}
