//! What `ligament check` foresees that a crack through the body will spend.

use std::io;

use ligament_model::cloud::PointCloud;
use ligament_output::quantity::{place, quantity};
use ligament_run::model::Model;

use super::report::Report;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Parts of a distance between points in which a pre-crack is followed through the body.
const PARTS: f64 = 8.0;

/// Writes the energy G_c A of a crack through the body, where all materials have the same fracture energy and a criterion uses it: on from
/// each end of a straight pre-crack that lies in the body, otherwise through the mean section across each axis, volume over length.
pub(super) fn write(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    let Some(given) = model.setup.spent_fracture_energy() else {
        return Ok(());
    };
    let taken = |area: f64| {
        let [work, area] = [quantity(given * area, "J"), quantity(area, "m^2")];
        format!("takes {work} ({area})")
    };
    let ahead = extensions_of_precracks(model);
    for (tip, area) in &ahead {
        let words = format!("on from {} {}", place(tip), taken(*area));
        report.detail("a crack through", words)?;
    }
    if ahead.is_empty() {
        let sections = sections(model);
        let words = AXES.iter().zip(&sections);
        let words = words.map(|(axis, area)| format!("across {axis} {}", taken(*area)));
        let words: Vec<String> = words.collect();
        let words = format!("the mean section {}", words.join(", "));
        report.detail("a crack through", words)?;
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

/// Ends of pre-cracks in the plane that lie in the body, with the areas (m^2) between them and the other side, or the next pre-crack, along
/// their lines.
fn extensions_of_precracks(model: &Model) -> Vec<([f64; 2], f64)> {
    let Some(system) = model.system.of_dimension::<2>() else {
        return Vec::new();
    };
    let cloud = &system.cloud;
    let lines = || model.setup.precracks.iter().map(|crack| crack.line());
    let mut found = Vec::new();
    for (number, line) in lines().enumerate() {
        let [first, .., last] = line else {
            continue;
        };
        for (from, tip) in [(line[1], *first), (line[line.len() - 2], *last)] {
            let Some(ray) = CrackExtension::new(from, tip) else {
                continue;
            };
            let spacing = cloud.spacing[cloud.nearest_points(&[tip])[0] as usize];
            let others = lines().enumerate().filter(|(other, _)| *other != number);
            let ahead = others.flat_map(|(_, line)| line).filter_map(|&vertex| {
                let [along, aside] = ray.coordinates(vertex);
                (along > 0.0 && aside.abs() < 0.5 * spacing).then_some(along)
            });
            let length = ahead.fold(length_ahead(cloud, &ray), f64::min);
            if length > spacing {
                found.push((tip, length * cloud.thickness));
            }
        }
    }
    found
}

/// A straight line from the tip of a pre-crack on.
struct CrackExtension {
    tip: [f64; 2],
    /// Unit vector along the line.
    along: [f64; 2],
}

impl CrackExtension {
    /// The line through a tip, away from `from`; None if they are one place.
    fn new(from: [f64; 2], tip: [f64; 2]) -> Option<Self> {
        let along = [tip[0] - from[0], tip[1] - from[1]];
        let size = along[0].hypot(along[1]);
        (size > 0.0).then(|| Self {
            tip,
            along: along.map(|it| it / size),
        })
    }

    /// Distances of a position from the tip along the line and across it, m.
    fn coordinates(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b] = [x - self.tip[0], y - self.tip[1]];
        let [cos, sin] = self.along;
        [a * cos + b * sin, b * cos - a * sin]
    }

    /// Position at a distance from the tip, m.
    fn at(&self, length: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.tip[axis] + length * self.along[axis])
    }
}

/// Length of a ray through the body, m: up to the farthest of the points that are nearest to its places, and on a lattice half a cell
/// farther; right to half the distance of points. A place is in the body if its nearest point is not farther than three quarters of the
/// distance between points.
fn length_ahead(cloud: &PointCloud<2>, ray: &CrackExtension) -> f64 {
    let smallest = cloud.spacing.iter().copied().fold(f64::INFINITY, f64::min);
    let [width, height] = [0, 1].map(|axis| {
        let values = || cloud.positions.iter().map(|it| it[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    });
    // From a tip in the body no line is longer than its diagonal.
    let longest = width.hypot(height) + smallest;
    let step = smallest / PARTS;
    if !(step > 0.0 && longest.is_finite()) {
        return 0.0;
    }
    let lengths = (0..).map(|part| f64::from(part) * step);
    let lengths = lengths.take_while(|length| *length <= longest);
    let places: Vec<[f64; 2]> = lengths.map(|length| ray.at(length)).collect();
    let nearest = cloud.nearest_points(&places);
    let mut length = 0.0_f64;
    for (place, point) in places.iter().zip(nearest) {
        let [x, y] = cloud.positions[point as usize];
        let [to_x, to_y] = cloud.local(*place);
        if (x - to_x).hypot(y - to_y) > 0.75 * cloud.spacing[point as usize] {
            break;
        }
        let at = [x + cloud.origin[0], y + cloud.origin[1]];
        let cell = cloud.lattice_cell.map_or(0.0, |cell| {
            0.5 * (cell[0] * ray.along[0]).hypot(cell[1] * ray.along[1])
        });
        length = length.max(ray.coordinates(at)[0] + cell);
    }
    length
}
