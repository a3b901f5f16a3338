//! Places of a case file looked up in the body: groups, boxes, positions.

use ligament_model::PointCloud;

use crate::body::Body;
use crate::case::{CaseError, CaseFile, Fault, Place, Region};

/// A body and its points, to look places of a case up in.
#[derive(Clone, Copy)]
pub(super) struct Places<'a> {
    pub(super) case: &'a CaseFile,
    pub(super) body: &'a dyn Body,
    pub(super) cloud: &'a PointCloud,
}

impl Places<'_> {
    /// Points of a place, ascending; the whole body without one. `key` is the key path of the table that names it.
    pub(super) fn points(&self, key: &str, place: Option<&Place>) -> Result<Vec<u32>, CaseError> {
        match place {
            Some(Place::Group(group)) => self.points_of_group(key, group),
            Some(Place::Box(corners)) => self.points_in_box(key, *corners),
            Some(Place::At(position)) => Ok(vec![self.cloud.nearest_point(*position)]),
            None => Ok((0..self.cloud.len() as u32).collect()),
        }
    }

    pub(super) fn points_in_box(
        &self,
        key: &str,
        [lower, upper]: [[f64; 2]; 2],
    ) -> Result<Vec<u32>, CaseError> {
        let points = self.cloud.points_in_box(lower, upper);
        if points.is_empty() {
            let reason = "there is no point of the body in this box";
            return Err(self.case.error(&format!("{key}.box"), reason));
        }
        Ok(points)
    }

    /// Points of a group of the body.
    pub(super) fn points_of_group(&self, key: &str, name: &str) -> Result<Vec<u32>, CaseError> {
        let points = self.body.points_of(name);
        points.ok_or_else(|| unknown_group(self.case, self.body, &format!("{key}.group"), name))
    }
}

/// Marks the points whose bonds never break, shape (n_points).
pub fn no_fail(
    case: &CaseFile,
    body: &dyn Body,
    cloud: &PointCloud,
) -> Result<Vec<bool>, CaseError> {
    let places = Places { case, body, cloud };
    let mut marked = vec![false; cloud.len()];
    for (index, region) in case.case.no_fail.iter().enumerate() {
        let key = format!("no_fail.{index}");
        let points = match region {
            Region::Group(group) => places.points_of_group(&key, group)?,
            Region::Box(corners) => places.points_in_box(&key, *corners)?,
        };
        for point in points {
            marked[point as usize] = true;
        }
    }
    Ok(marked)
}

/// Index of the material of each cell, shape (n_cells): every cell must have exactly one.
pub fn material_of_cell(case: &CaseFile, body: &dyn Body) -> Result<Vec<u32>, CaseError> {
    let materials = &case.case.materials;
    let n_cells = body.n_cells();
    let mut material_of_cell = vec![None; n_cells];
    for (index, material) in materials.iter().enumerate() {
        let cells = match &material.group {
            None => (0..n_cells as u32).collect(),
            Some(group) => cells_of_group(case, body, &format!("{}.group", material.key()), group)?,
        };
        for cell in cells {
            let before: Option<u32> = material_of_cell[cell as usize].replace(index as u32);
            if let Some(first) = before.filter(|&first| first != index as u32) {
                let other = materials[first as usize]
                    .name
                    .as_deref()
                    .unwrap_or_default();
                let reason = format!("cells of this material belong to material `{other}` as well");
                return Err(case.error(&material.key(), reason));
            }
        }
    }
    let covered: Vec<u32> = material_of_cell.iter().copied().flatten().collect();
    if covered.len() < n_cells {
        let missing = n_cells - covered.len();
        let reason = format!(
            "{missing} of {} cells belong to the group of no material",
            n_cells
        );
        return Err(case.error("material", reason));
    }
    Ok(covered)
}

fn cells_of_group(
    case: &CaseFile,
    body: &dyn Body,
    key: &str,
    group: &str,
) -> Result<Vec<u32>, CaseError> {
    let cells = body.cells_of(group);
    let cells = cells.ok_or_else(|| unknown_group(case, body, key, group))?;
    if cells.is_empty() {
        let reason = format!("`{group}` has no cells: a material needs a physical surface");
        return Err(case.error(key, reason));
    }
    Ok(cells)
}

fn unknown_group(case: &CaseFile, body: &dyn Body, key: &str, name: &str) -> CaseError {
    let fault = Fault::unknown_name(body.group_kind(), name, body.group_names());
    case.error(key, fault)
}
