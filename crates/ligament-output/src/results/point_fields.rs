//! Fields on the points, over the cells of the mesh or the lattice.

use std::path::Path;

use ligament_analysis::COMPONENTS;
use ligament_analysis::fields;
use ligament_analysis::history::View;
use ligament_analysis::stress::{traction, virial};

use super::{AbsentBond, WriteRule};
use crate::Error;
use crate::vtu::{self, Field, UnstructuredGrid};

/// Field of the strain (eps_xx, eps_yy, gamma_xy) that the temperature would make without stress.
pub(super) const THERMAL_STRAIN: &str = "thermal_strain";

/// The body as output files show it.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyGrid {
    /// Positions of the points, shape (n_points), m.
    pub positions: Vec<[f64; 2]>,
    /// Tags that points go by: of the nodes in a mesh file, of the cells of a lattice, shape (n_points).
    pub tags: Vec<i64>,
    /// The noun that tags belong to: `node` or `cell`.
    pub tagged: &'static str,
    /// The cells on which the fields of the points are drawn.
    pub canvas: Canvas,
}

/// The cells on which the fields of the points are drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Canvas {
    /// Cells between the points, whose fields are point data.
    Between(Vec<vtu::Cell>),
    /// A cell of its own for each point, whose fields are cell data. Its corners (n_points, counter-clockwise, m) belong to
    /// no other cell: they move with the point, and cracks open.
    Around(Vec<[[f64; 2]; 4]>),
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
    /// Points whose bonds never fail, shape (n_points).
    pub no_fail: Vec<bool>,
    /// Pairs within a horizon that are no bonds, in the order of their ends.
    pub absent: Vec<AbsentBond>,
}

impl FixedFields {
    pub(super) fn fields<'a>(&'a self, volumes: &'a [f64], spacing: &'a [f64]) -> Vec<Field<'a>> {
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
    grid: &BodyGrid,
    volumes: &[f64],
    spacing: &[f64],
    fixed: &FixedFields,
) -> Result<(), Error> {
    let mut fields = fixed.fields(volumes, spacing);
    fields.push(Field::integer(grid.tagged, &grid.tags));
    grid.write(path, None, &fields)
}

/// Writes fields of the points (n_points) of a body at rest, with the tags of the points.
pub fn write_points(path: &Path, grid: &BodyGrid, fields: &[Field<'_>]) -> Result<(), Error> {
    let tags = Field::integer(grid.tagged, &grid.tags);
    let all: Vec<Field<'_>> = fields.iter().copied().chain([tags]).collect();
    grid.write(path, None, &all)
}

/// Writes the fields of a state.
pub(super) fn write(
    path: &Path,
    grid: &BodyGrid,
    fixed: &FixedFields,
    rule: WriteRule,
    view: &View<'_>,
) -> Result<(), Error> {
    let (system, criteria, state, balanced) =
        (view.system, view.criteria, view.state, view.balanced);
    let displacement = displacements(view);
    let rotation: Vec<f64> = state
        .displacement
        .chunks(COMPONENTS)
        .map(|motion| motion[2])
        .collect();
    let damage = fields::damage(system, &state.intact);
    let density = fields::strain_energy_density(system, state.bonds(), &balanced.deformations);
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
    let mut fields = vec![
        Field::scalar("rotation", &rotation),
        Field::scalar("damage", &damage),
        Field::scalar("strain_energy_density", &density),
        Field::vector("reaction", &reaction),
        Field::integer("fragment", &fragment),
        Field::integer("held", &held),
        Field::integer(grid.tagged, &grid.tags),
    ];
    let ways = fields::damages(system, criteria, state);
    fields.extend((ways.iter()).map(|(name, values)| Field::scalar(name, values)));
    let dissipated = (!criteria.list.is_empty())
        .then(|| fields::dissipated_energy_density(system, &state.dissipated));
    if let Some(values) = &dissipated {
        fields.push(Field::scalar("dissipated_energy_density", values));
    }
    let at_full_load = &view.boundary.temperature_change;
    let change: Vec<f64> = (at_full_load.iter())
        .map(|change| state.load_factor * change)
        .collect();
    if !change.is_empty() {
        fields.push(Field::scalar("temperature_change", &change));
    }
    let at_full_load = view.boundary.thermal_strain.as_flattened();
    let thermal: Vec<f64> = (at_full_load.iter())
        .map(|strain| state.load_factor * strain)
        .collect();
    if !thermal.is_empty() {
        fields.push(Field::components(
            THERMAL_STRAIN,
            &["xx", "yy", "xy"],
            &thermal,
        ));
    }
    let stress_virial = rule
        .virial
        .then(|| virial::stress(system, state.bonds(), &balanced.deformations));
    if let Some(stress) = &stress_virial {
        let values = stress.as_flattened();
        fields.push(Field::components(
            "stress_virial",
            &["xx", "yy", "xy"],
            values,
        ));
    }
    let stress_traction = rule
        .traction
        .then(|| traction::stress(system, state.bonds(), &balanced.deformations));
    if let Some(stress) = &stress_traction {
        let values = stress.as_flattened();
        fields.push(Field::components(
            "stress_traction",
            &["xx", "yx", "yy", "xy"],
            values,
        ));
    }
    let cloud = &system.cloud;
    fields.extend(fixed.fields(&cloud.volumes, &cloud.spacing));
    grid.write(path, Some(&displacement), &fields)
}

/// Displacements of the points.
pub(super) fn displacements(view: &View<'_>) -> Vec<[f64; 3]> {
    in_plane(&view.state.displacement)
}

/// The x and y components with a third of zero, as readers expect vectors, shape (n_points).
pub(super) fn in_plane(values: &[f64]) -> Vec<[f64; 3]> {
    values
        .chunks(COMPONENTS)
        .map(|components| [components[0], components[1], 0.0])
        .collect()
}

impl BodyGrid {
    /// Writes fields of the points, the displacement first so that readers warp by it.
    pub(super) fn write(
        &self,
        path: &Path,
        displacement: Option<&[[f64; 3]]>,
        fields: &[Field<'_>],
    ) -> Result<(), Error> {
        let vector = |values| Field::vector("displacement", values);
        let mut all: Vec<Field<'_>> = displacement.map(vector).into_iter().collect();
        all.extend(fields);
        match &self.canvas {
            Canvas::Between(cells) => {
                let grid = UnstructuredGrid {
                    points: &self.positions,
                    cells,
                    point_fields: &all,
                    cell_fields: &[],
                };
                vtu::write_vtu(path, &grid)
            }
            Canvas::Around(corners) => {
                let cells: Vec<vtu::Cell> = (0..corners.len() as u32)
                    .map(|cell| vtu::Cell::Quad([0, 1, 2, 3].map(|corner| 4 * cell + corner)))
                    .collect();
                let of_corners: Option<Vec<[f64; 3]>> = displacement
                    .map(|values| values.iter().flat_map(|value| [*value; 4]).collect());
                let of_corners: Vec<Field<'_>> =
                    of_corners.as_deref().map(vector).into_iter().collect();
                let grid = UnstructuredGrid {
                    points: corners.as_flattened(),
                    cells: &cells,
                    point_fields: &of_corners,
                    cell_fields: &all,
                };
                vtu::write_vtu(path, &grid)
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vtkio::model::{Attribute, DataSet, Piece, Vtk};

    fn names(attributes: &[Attribute]) -> Vec<&str> {
        attributes.iter().map(Attribute::name).collect()
    }

    /// Two cells of a lattice: each has four corners of its own, which move with it; all else is cell data.
    #[test]
    fn cells_around_points_have_their_own_corners() {
        let square = |x: f64| [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
        let grid = BodyGrid {
            positions: vec![[0.5, 0.5], [1.5, 0.5]],
            tags: vec![1, 2],
            tagged: "cell",
            canvas: Canvas::Around(vec![square(0.0), square(1.0)]),
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields.vtu");
        let (moved, damage) = ([[0.0, 0.0, 0.0], [0.25, -0.5, 0.0]], [0.0, 0.75]);
        let fields = [
            Field::scalar("damage", &damage),
            Field::integer(grid.tagged, &grid.tags),
        ];
        grid.write(&path, Some(&moved), &fields).unwrap();
        let DataSet::UnstructuredGrid { pieces, .. } = Vtk::import(&path).unwrap().data else {
            panic!("not an unstructured grid");
        };
        let Piece::Inline(piece) = pieces.into_iter().next().unwrap() else {
            panic!("not inline");
        };
        assert_eq!((piece.num_points(), piece.cells.num_cells()), (8, 2));
        let (_, vertices) = piece.cells.cell_verts.clone().into_legacy();
        assert_eq!(vertices, [4, 0, 1, 2, 3, 4, 4, 5, 6, 7]);
        assert_eq!(names(&piece.data.point), ["displacement"]);
        assert_eq!(names(&piece.data.cell), ["displacement", "damage", "cell"]);
        let Attribute::DataArray(array) = &piece.data.point[0] else {
            panic!("no array");
        };
        let expected: Vec<f64> = (moved.iter())
            .flat_map(|corner| [*corner; 4].concat())
            .collect();
        assert_eq!(array.data.clone().into_vec::<f64>().unwrap(), expected);
    }
}
