//! Cracks of a run over the steps of a page: lines in the plane, sides of tetrahedra in a solid, and their size.

use std::collections::HashMap;
use std::path::Path;

use ligament_output::Error;
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::solid_cracks::SolidCracks;
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::body::{Body, places};
use crate::columns::{Column, Digits, Encoder};
use crate::history::column;
use crate::parts::Texts;

/// Digits of the positions of nodes.
const DIGITS: u32 = 6;

/// The cracks of the steps.
///
/// # Errors
///
/// If a file cannot be used.
pub(crate) fn describe(
    folder: &Path,
    steps: &[usize],
    body: &Body,
    texts: &mut Texts,
) -> Result<Value, Error> {
    match body.dimension {
        3 => Ok(of_solid(&SolidCracks::open(folder)?, steps, body, texts)),
        _ => Ok(in_plane(&StoredCracks::open(folder)?, steps)),
    }
}

/// Crack lines of the steps, each a list of lines of coordinates x, y, `null` where unchanged from the step before; and their length.
fn in_plane(cracks: &StoredCracks, steps: &[usize]) -> Value {
    let (mut before, mut lengths) = (Value::Null, Vec::new());
    let mut of_steps = Vec::new();
    for &step in steps {
        let lines = cracks.lines(step);
        lengths.push(lines.iter().fold(0.0, |sum, line| sum + line.length()));
        let coordinate = |it: &f64| (it * 1e7).round() / 1e7;
        let now: Value = (lines.into_iter())
            .map(|line| {
                let places = line.places.as_flattened().iter();
                places.map(coordinate).collect::<Vec<f64>>()
            })
            .collect();
        let is_same = now == before;
        of_steps.push(if is_same { Value::Null } else { now.clone() });
        before = now;
    }
    let areas: Vec<f64> = lengths.iter().map(|it| cracks.thickness * it).collect();
    json!({
        "lines": of_steps,
        "size": column("crack length", "m", &lengths),
        "area": column("crack area", "m^2", &areas),
    })
}

/// Tetrahedra that are cut at some time, with the sides of their corners in each step; and the area of the crack surface.
fn of_solid(cracks: &SolidCracks, steps: &[usize], body: &Body, texts: &mut Texts) -> Value {
    let of_steps: Vec<(Vec<[u8; 4]>, f64)> = (steps.par_iter())
        .map(|step| (cracks.sides(*step), cracks.surface(*step).area()))
        .collect();
    let areas: Vec<f64> = of_steps.iter().map(|it| it.1).collect();
    let area = column("crack area", "m^2", &areas);
    let tetrahedra = cracks.tetrahedra();
    if tetrahedra.corners.is_empty() {
        return json!({"size": area, "area": area});
    }
    let mut sides = Encoder::new(Digits::Whole);
    for (of_step, _) in &of_steps {
        let codes: Vec<f64> = of_step.iter().map(code).collect();
        sides.append(&codes);
    }
    let mut described = match body.halves.is_empty() {
        true => of_mesh(&tetrahedra.corners, body, texts),
        false => of_lattice(cracks, body, texts),
    };
    described["tetrahedra"] = json!(tetrahedra.corners.len());
    described["sides"] = texts.add(sides.finish());
    described["size"] = area.clone();
    described["area"] = area;
    described
}

/// Sides of four corners, the first of which is 0, as one number.
fn code(sides: &[u8; 4]) -> f64 {
    f64::from(sides[1] + 2 * sides[2] + 8 * sides[3])
}

/// The tetrahedra by their numbers among those of the body.
fn of_mesh(corners: &[[u32; 4]], body: &Body, texts: &mut Texts) -> Value {
    let all = body.tetrahedra();
    let numbers = corners.iter().filter_map(|it| all.get(it).copied());
    json!({"of": texts.add_whole(numbers)})
}

/// The tetrahedra by their nodes, with position and point of each node.
fn of_lattice(cracks: &SolidCracks, body: &Body, texts: &mut Texts) -> Value {
    let (tetrahedra, places) = (cracks.tetrahedra(), places(&body.order));
    let mut numbers: HashMap<u32, u32> = HashMap::new();
    let mut nodes: Vec<u32> = Vec::new();
    let corners: Vec<u32> = (tetrahedra.corners.as_flattened().iter())
        .map(|node| {
            *numbers.entry(*node).or_insert_with(|| {
                nodes.push(*node);
                nodes.len() as u32 - 1
            })
        })
        .collect();
    let along = |axis: usize| -> Vec<f64> {
        let nodes = nodes.iter();
        nodes
            .map(|it| tetrahedra.nodes[*it as usize][axis])
            .collect()
    };
    let position =
        [0, 1, 2].map(|axis| texts.add(Column::single(&along(axis), Digits::OfLargest(DIGITS))));
    let points = nodes
        .iter()
        .map(|it| places[tetrahedra.points[*it as usize] as usize]);
    json!({
        "nNodes": nodes.len(),
        "corners": texts.add_whole(corners),
        "position": position,
        "points": texts.add_whole(points),
    })
}
