//! What `ligament check` foresees that a crack through the body will spend.

use std::io::{self, Write};

use ligament_model::cloud::PointCloud;
use ligament_output::quantity::{place, quantity};
use ligament_run::model::Model;

use super::entry::entry;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Parts of a distance between points in which a pre-crack is followed through the body.
const PARTS: f64 = 8.0;

/// Writes the energy G_c A of a crack through the body, where all materials have the same fracture energy and a criterion uses it: on from
/// each end of a straight pre-crack that lies in the body, otherwise through the mean section across each axis, volume over length.
pub(super) fn write(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    let criteria = &model.setup.criteria;
    let uses =
        |it: &ligament_model::failure::Choice| it.spends_fracture_energy() || it.after.law.softens;
    let materials = model.setup.materials();
    let given = materials.first().and_then(|it| it.fracture_energy);
    let Some(given) = given.filter(|_| criteria.iter().any(uses)) else {
        return Ok(());
    };
    if materials.iter().any(|it| it.fracture_energy != Some(given)) {
        return Ok(());
    }
    let taken = |area: f64| {
        let [work, area] = [quantity(given * area, "J"), quantity(area, "m^2")];
        format!("takes {work} ({area})")
    };
    let ahead = ahead_of_precracks(model);
    for (tip, area) in &ahead {
        let words = format!("on from {} {}", place(tip), taken(*area));
        entry(out, "a crack through", words)?;
    }
    if ahead.is_empty() {
        let sections = sections(model);
        let words = AXES.iter().zip(&sections);
        let words = words.map(|(axis, area)| format!("across {axis} {}", taken(*area)));
        let words: Vec<String> = words.collect();
        let words = format!("the mean section {}", words.join(", "));
        entry(out, "a crack through", words)?;
    }
    Ok(())
}

/// Mean sections of the body across its axes, m^2.
fn sections(model: &Model) -> Vec<f64> {
    match model.system.of_dimension::<2>() {
        Some(system) => sections_of(&system.cloud).to_vec(),
        None => sections_of(&model.solid().cloud).to_vec(),
    }
}

/// Volume over the length of the body along each axis. Points of a lattice are the middles of cells.
fn sections_of<const D: usize>(cloud: &PointCloud<D>) -> [f64; D] {
    let volume: f64 = cloud.volumes.iter().sum();
    std::array::from_fn(|axis| {
        let values = || cloud.positions.iter().map(|it| it[axis]);
        let least = values().fold(f64::INFINITY, f64::min);
        let most = values().fold(f64::NEG_INFINITY, f64::max);
        let cell = cloud.lattice_cell.map_or(0.0, |cell| cell[axis]);
        volume / (most - least + cell)
    })
}

/// Ends of straight pre-cracks in the plane that lie in the body, with the areas (m^2) between them and the other side along their lines.
fn ahead_of_precracks(model: &Model) -> Vec<([f64; 2], f64)> {
    let Some(system) = model.system.of_dimension::<2>() else {
        return Vec::new();
    };
    let cloud = &system.cloud;
    let mut found = Vec::new();
    for crack in &model.setup.precracks {
        let [first, .., last] = crack.line() else {
            continue;
        };
        let line = crack.line();
        let ends = [(line[1], *first), (line[line.len() - 2], *last)];
        for (from, tip) in ends {
            let length = length_ahead(cloud, from, tip);
            let point = cloud.nearest_points(&[tip])[0];
            if length > cloud.spacing[point as usize] {
                found.push((tip, length * cloud.thickness));
            }
        }
    }
    found
}

/// Length of the line from a tip on, away from `from`, while a point of the body is nearer than three quarters of its distance to the next,
/// m; right to half that distance, and 0 where it is no longer than that.
fn length_ahead(cloud: &PointCloud<2>, from: [f64; 2], tip: [f64; 2]) -> f64 {
    let along = [tip[0] - from[0], tip[1] - from[1]];
    let size = along[0].hypot(along[1]);
    let smallest = cloud.spacing.iter().copied().fold(f64::INFINITY, f64::min);
    let step = smallest / PARTS;
    if !(size > 0.0 && step > 0.0) {
        return 0.0;
    }
    let [width, height] = [0, 1].map(|axis| {
        let values = || cloud.positions.iter().map(|it| it[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    });
    // From a tip in the body no line is longer than its diagonal.
    let longest = width.hypot(height) + smallest;
    let at = |length: f64| [0, 1].map(|axis| tip[axis] + length * along[axis] / size);
    let lengths = (0..).map(|part| f64::from(part) * step);
    let lengths: Vec<f64> = lengths.take_while(|length| *length <= longest).collect();
    let places: Vec<[f64; 2]> = lengths.iter().map(|length| at(*length)).collect();
    let nearest = cloud.nearest_points(&places);
    let is_inside = |(place, point): (&[f64; 2], &u32)| {
        let [x, y] = cloud.positions[*point as usize];
        let [to_x, to_y] = cloud.local(*place);
        (x - to_x).hypot(y - to_y) <= 0.75 * cloud.spacing[*point as usize]
    };
    let inside = places.iter().zip(&nearest).take_while(|it| is_inside(*it));
    let last = lengths.iter().zip(inside).last();
    last.map_or(0.0, |(length, _)| *length)
}
