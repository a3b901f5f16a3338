//! Resolution of the places of a setup, groups, boxes and positions, to points of its body.

use ligament_model::PointCloud;

use crate::coordinates::{in_dimensions, narrowed};
use crate::error::{Fault, Field, SetupError};
use crate::setup::{CrackShape, Place, Setup};

/// A setup and the points of its body, which resolve places.
#[derive(Clone, Copy)]
pub(super) struct Places<'a, const D: usize> {
    pub(super) setup: &'a Setup,
    pub(super) cloud: &'a PointCloud<D>,
}

impl<const D: usize> Places<'_, D> {
    /// Points of the place of a field, ascending.
    pub(super) fn points(&self, field: Field, place: &Place) -> Result<Vec<u32>, SetupError> {
        let field = field.part("place");
        match place {
            Place::Everywhere => Ok((0..self.cloud.len() as u32).collect()),
            Place::Group(group) => {
                let points = self.setup.body.points_of(group);
                points.ok_or_else(|| field.error(unknown_group(self.setup, group)))
            }
            Place::Box([lower, upper]) => {
                let points = self.cloud.points_in_box(narrowed(*lower), narrowed(*upper));
                if points.is_empty() {
                    return Err(field.error(Fault::EmptyBox));
                }
                Ok(points)
            }
            Place::At(position) => {
                let position = narrowed(*position);
                let nearest = self.cloud.nearest_point(position);
                self.require_on_body(field, position, nearest)?;
                Ok(vec![nearest])
            }
        }
    }

    /// Refuses probes that read a point at a position off the body.
    pub(super) fn require_probes_on_body(&self) -> Result<(), SetupError> {
        for (index, probe) in self.setup.probes.iter().enumerate() {
            let field = Field::element("probes", index).part("reading");
            for position in probe.reading.positions() {
                let position = narrowed(*position);
                let nearest = self.cloud.nearest_point(position);
                self.require_on_body(field, position, nearest)?;
            }
        }
        Ok(())
    }

    /// Refuses a position farther from its nearest point than that point is from its neighbours: the longest side of its cells, or a
    /// diagonal of the spacing where there are no cells.
    fn require_on_body(
        &self,
        field: Field,
        position: [f64; D],
        nearest: u32,
    ) -> Result<(), SetupError> {
        let body = self.setup.body.geometry::<D>();
        let position_of = |point: u32| in_dimensions(&body.position(point));
        let place: [f64; D] = position_of(nearest);
        let around = body.around(nearest).into_iter();
        let reach = around
            .map(|corner| distance(position_of(corner), place))
            .fold(
                (D as f64).sqrt() * self.cloud.spacing[nearest as usize],
                f64::max,
            );
        let distance = distance(place, position);
        if distance <= reach {
            return Ok(());
        }
        Err(field.error(Fault::OffBody {
            position: position.to_vec(),
            nearest: body.place(nearest),
            distance,
        }))
    }
}

/// Points of a body that all of several processes know: points of supports, loads, probes and surfaces that cut bonds; all points where the
/// temperature changes.
pub(crate) fn points_known_to_all<const D: usize>(
    setup: &Setup,
    cloud: &PointCloud<D>,
) -> Result<Vec<u32>, SetupError> {
    let (places, body) = (Places { setup, cloud }, setup.body.geometry::<D>());
    if !setup.temperatures.is_empty() {
        return Ok((0..cloud.len() as u32).collect());
    }
    let mut known = Vec::new();
    for (index, support) in setup.supports.iter().enumerate() {
        known.extend(places.points(Field::element("supports", index), &support.place)?);
    }
    for (index, load) in setup.loads.iter().enumerate() {
        known.extend(places.points(Field::element("loads", index), &load.place)?);
    }
    for (index, probe) in setup.probes.iter().enumerate() {
        if let Some(group) = probe.reading.group() {
            let place = Place::Group(group.clone());
            known.extend(places.points(Field::element("probes", index), &place)?);
        }
    }
    let positions = setup.probes.iter().flat_map(|it| it.reading.positions());
    for position in positions.map(|it| narrowed(*it)) {
        known.push(cloud.nearest_point(position));
        let around = body.interpolation_weights(position).unwrap_or_default();
        known.extend(around.iter().map(|(point, _)| *point));
    }
    for crack in &setup.precracks {
        if let CrackShape::Group(group) = &crack.shape {
            known.extend(body.points_of(group).unwrap_or_default());
        }
    }
    Ok(known)
}

/// Marks the points whose bonds never break, shape (n_points).
pub fn no_fail<const D: usize>(
    setup: &Setup,
    cloud: &PointCloud<D>,
) -> Result<Vec<bool>, SetupError> {
    let places = Places { setup, cloud };
    let mut marked = vec![false; cloud.len()];
    for (index, place) in setup.no_fail.iter().enumerate() {
        for point in places.points(Field::element("no_fail", index), place)? {
            marked[point as usize] = true;
        }
    }
    Ok(marked)
}

/// Index of the material of each cell, shape (n_cells). Refuses cells without a material or with two.
pub fn material_of_cell(setup: &Setup) -> Result<Vec<u32>, SetupError> {
    let n_cells = setup.body.n_cells();
    let mut material_of_cell = vec![None; n_cells];
    for (index, region) in setup.materials.iter().enumerate() {
        let field = Field::element("materials", index);
        let cells = match &region.group {
            None => (0..n_cells as u32).collect(),
            Some(group) => cells_of_group(setup, field.part("group"), group)?,
        };
        for cell in cells {
            let before: Option<u32> = material_of_cell[cell as usize].replace(index as u32);
            if let Some(first) = before.filter(|&first| first != index as u32) {
                let other = setup.materials[first as usize].material.name.clone();
                return Err(field.error(Fault::CellsTwice { other }));
            }
        }
    }
    let covered: Vec<u32> = material_of_cell.iter().copied().flatten().collect();
    if covered.len() < n_cells {
        let missing = n_cells - covered.len();
        return Err(Field::whole("materials").error(Fault::CellsWithout { missing, n_cells }));
    }
    Ok(covered)
}

fn cells_of_group(setup: &Setup, field: Field, group: &str) -> Result<Vec<u32>, SetupError> {
    let cells = setup.body.cells_of(group);
    let cells = cells.ok_or_else(|| field.error(unknown_group(setup, group)))?;
    if cells.is_empty() {
        let group = group.to_owned();
        return Err(field.error(Fault::NoCells { group }));
    }
    Ok(cells)
}

pub(super) fn unknown_group(setup: &Setup, name: &str) -> Fault {
    Fault::UnknownName {
        what: setup.body.group_kind(),
        found: name.to_owned(),
        candidates: setup.body.group_names(),
    }
}

/// Distance of two positions, m.
pub(super) fn distance<const D: usize>(from: [f64; D], to: [f64; D]) -> f64 {
    let squares = from.iter().zip(&to).map(|(a, b)| (b - a).powi(2));
    squares.sum::<f64>().sqrt()
}
