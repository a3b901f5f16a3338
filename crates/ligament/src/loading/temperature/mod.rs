//! Changes of temperature at the points of a body, and their free strains.

mod field;

use ligament_model::tensor::SymTensor;
use ligament_model::thermal::StressFreeStrains;

use super::places::Places;
use super::samples;
use crate::error::{Fault, Field, SetupError};
use crate::setup::{Place, Temperature, TemperatureChange};

/// Heating or cooling of a body at load factor 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Heating {
    /// Change of the temperature of each point, shape (n_points), K.
    pub(super) change: Vec<f64>,
    /// Strain of each point without stress.
    pub(super) strain: StressFreeStrains,
}

/// Changes of temperature by one section of the setup.
enum Change {
    /// Uniform change of the temperature, K.
    Uniform(f64),
    /// Change of each point that has one, shape (n_points), K; and the reason why other points have none.
    Each(Vec<Option<f64>>, &'static str),
}

/// The heating of a setup; `None` without a temperature.
///
/// A temperature applies to the whole body, the cells of a group, or the points of a box or curve; where several apply, the last one
/// counts. A point with cells of several groups has their mean by volume.
pub(super) fn heating<const D: usize>(
    places: &Places<'_, D>,
) -> Result<Option<Heating>, SetupError> {
    let (sections, cloud) = (&places.setup.temperatures, places.cloud);
    if sections.is_empty() {
        return Ok(None);
    }
    let reach = Reach::over(places, sections)?;
    let changes = sections.iter().enumerate();
    let changes = changes.map(|(index, section)| places.change(index, section));
    let changes: Vec<Change> = changes.collect::<Result<_, _>>()?;
    let mut missing = Missing::default();
    let mut change = vec![0.0; cloud.len()];
    for (point, total) in change.iter_mut().enumerate() {
        for (section, share) in reach.at(point) {
            *total += share
                * match &changes[section] {
                    Change::Uniform(value) => *value,
                    Change::Each(values, _) => {
                        values[point].unwrap_or_else(|| missing.add(section, point as u32))
                    }
                };
        }
    }
    missing.refuse(places, &changes)?;
    let strain = thermal_strain(places, &change)?;
    Ok(Some(Heating { change, strain }))
}

/// The section of temperatures that applies to each point or cell.
struct Reach {
    /// Number of sections.
    n_sections: usize,
    /// Share of each section in the cells of each point, shape (n_points, n_sections + 1); the first is the share without a section.
    shares: Vec<f64>,
    /// The last section, from 1, that applies to a point directly and not by its cells, shape (n_points); 0 where none does.
    of_point: Vec<u32>,
}

impl Reach {
    fn over<const D: usize>(
        places: &Places<'_, D>,
        sections: &[Temperature],
    ) -> Result<Self, SetupError> {
        let (body, cloud) = (&places.setup.body, places.cloud);
        let mut of_cell = vec![0; body.n_cells()];
        let mut of_point = vec![0; cloud.len()];
        for (index, section) in sections.iter().enumerate() {
            let number = index as u32 + 1;
            let points = places.points(Field::element("temperatures", index), &section.place)?;
            let cells = match &section.place {
                Place::Everywhere => Some((0..body.n_cells() as u32).collect()),
                Place::Group(group) => body.cells_of(group).filter(|it| !it.is_empty()),
                Place::Box(_) | Place::At(_) => None,
            };
            match cells {
                Some(cells) => cells.iter().for_each(|&it| of_cell[it as usize] = number),
                None => points.iter().for_each(|&it| of_point[it as usize] = number),
            }
        }
        // A cloud with a material for each section gives the volumes of the sections' cells at a point.
        let counted = body
            .geometry::<D>()
            .cloud(cloud.thickness, &of_cell, sections.len() + 1);
        Ok(Self {
            n_sections: sections.len(),
            shares: counted.material_shares,
            of_point,
        })
    }

    /// The sections that apply to a point with their shares, which sum to at most one.
    fn at(&self, point: usize) -> impl Iterator<Item = (usize, f64)> {
        let width = self.n_sections + 1;
        let shares = &self.shares[point * width..(point + 1) * width];
        let by_itself = self.of_point[point] as usize;
        let holds = move |(number, &share): (usize, &f64)| {
            let number = number.max(by_itself);
            (number > 0 && share > 0.0).then(|| (number - 1, share))
        };
        shares.iter().enumerate().filter_map(holds)
    }
}

impl<const D: usize> Places<'_, D> {
    fn change(&self, index: usize, section: &Temperature) -> Result<Change, SetupError> {
        let field = Field::element("temperatures", index);
        let body = &*self.setup.body;
        Ok(match &section.change {
            TemperatureChange::Uniform(change) => Change::Uniform(*change),
            TemperatureChange::Table(samples) => {
                let values = samples::at_points(samples, body, self.cloud);
                let values = values.map_err(|fault| field.part("change").error(fault))?;
                Change::Each(values, samples::MISSING)
            }
            TemperatureChange::Field {
                name,
                time_step,
                reference,
            } => {
                let found = field::find(body, name, *time_step);
                let found = found.map_err(|(part, fault)| field.part(part).error(fault))?;
                let change = |value: &Option<f64>| value.map(|value| value - reference);
                let values = found.at_nodes(body.n_points());
                let values = values.iter().map(change).collect();
                Change::Each(values, "the field has no value")
            }
        })
    }
}

/// Points without a temperature from the section that applies to them.
#[derive(Default)]
struct Missing {
    /// The section, its first such point, and the number of such points.
    first: Option<(usize, u32, usize)>,
}

impl Missing {
    fn add(&mut self, section: usize, point: u32) -> f64 {
        let (first, _, count) = self.first.get_or_insert((section, point, 0));
        *count += usize::from(*first == section);
        0.0
    }

    fn refuse<const D: usize>(
        &self,
        places: &Places<'_, D>,
        changes: &[Change],
    ) -> Result<(), SetupError> {
        let Some((section, point, count)) = self.first else {
            return Ok(());
        };
        let Change::Each(_, reason) = changes[section] else {
            return Ok(());
        };
        let fault = Fault::NoValue {
            what: "temperature",
            points: count,
            reason,
            first: places.setup.body.place(point),
        };
        let field = Field::element("temperatures", section).part("change");
        Err(field.error(fault))
    }
}

/// Thermal strains of the points (n_points): the mean over their materials by volume.
fn thermal_strain<const D: usize>(
    places: &Places<'_, D>,
    change: &[f64],
) -> Result<StressFreeStrains, SetupError> {
    let (setup, cloud) = (places.setup, places.cloud);
    let per_kelvin: Vec<Option<SymTensor<D>>> = (setup.materials.iter())
        .map(|it| {
            let elasticity = setup.law.effective_elasticity(&it.material, setup.space());
            let expansion = it.material.expansion?;
            Some(expansion.free_strain(&elasticity, setup.space()))
        })
        .collect();
    let at_point = |(point, &change): (usize, &f64)| {
        let mut strain = SymTensor::ZERO;
        if change == 0.0 {
            return Ok(strain);
        }
        for (index, &share) in cloud.shares(point).iter().enumerate() {
            if share == 0.0 {
                continue;
            }
            let Some(per_kelvin) = &per_kelvin[index] else {
                let reason = format!(
                    "(in 1/K) because the temperature of {} changes, which has this material",
                    setup.body.place(point as u32)
                );
                let fault = Fault::Missing {
                    property: "expansion",
                    reason,
                };
                return Err(Field::element("materials", index)
                    .part("expansion")
                    .error(fault));
            };
            strain = strain.plus(&per_kelvin.map(|it| share * it * change));
        }
        Ok(strain)
    };
    let strains = change.iter().enumerate().map(at_point);
    Ok(StressFreeStrains::new(
        strains.collect::<Result<Vec<_>, _>>()?,
    ))
}
