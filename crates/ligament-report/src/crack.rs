//! Cracks of a run over the steps of a page: lines in the plane, sides of the triangles and tetrahedra that they cut, and their size.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use ligament_model::parallel;
use ligament_output::Error;
use ligament_output::results::StoredState;
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::solid_cracks::SolidCracks;
use serde_json::{Value, json};

use crate::body::{Body, places};
use crate::columns::{Column, Digits, Encoder};
use crate::history::column;
use crate::parts::ColumnTexts;

/// Digits of the positions of nodes.
const DIGITS: u32 = 6;

/// The cracks of the states.
///
/// # Errors
///
/// If a file cannot be used.
pub(crate) fn describe(
    folder: &Path,
    states: &[StoredState],
    body: &Body,
    texts: &mut ColumnTexts,
) -> Result<Value, Error> {
    match body.dimension {
        3 => Ok(solid_cracks(
            &SolidCracks::open(folder)?,
            states,
            body,
            texts,
        )),
        _ => Ok(in_plane(&StoredCracks::open(folder)?, states, body, texts)),
    }
}

/// Crack lines of the steps, each a list of lines of coordinates x, y, `null` where unchanged from the step before, and their length; triangles
/// of a mesh that are cut at some time, with the sides of their corners in each step.
fn in_plane(
    cracks: &StoredCracks,
    states: &[StoredState],
    body: &Body,
    texts: &mut ColumnTexts,
) -> Value {
    let (mut before, mut lengths) = (Value::Null, Vec::new());
    let mut of_steps = Vec::new();
    for &state in states {
        let lines = cracks.lines(state);
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
    let mut described = json!({
        "lines": of_steps,
        "size": column("crack length", "m", &lengths),
        "area": column("crack area", "m^2", &areas),
    });
    let triangles = triangles(cracks, states);
    if !triangles.is_empty() {
        let corners: Vec<[u32; 3]> = triangles.iter().map(|it| it.0).collect();
        described["of"] = mesh_simplices(&corners, body, texts);
        let sides = (0..states.len()).map(|step| triangles.iter().map(|it| it.1[step]).collect());
        add_sides(&mut described, sides, texts);
    }
    described
}

/// Triangles of the cells that are cut at some time, by their corners in the files, with the codes of their sides in each step.
fn triangles(cracks: &StoredCracks, states: &[StoredState]) -> Vec<([u32; 3], Vec<f64>)> {
    let of_state = |state: &StoredState| -> BTreeMap<usize, [u8; 4]> {
        let sides = cracks.sides(*state).into_iter().enumerate();
        sides.filter(|it| it.1 != [0; 4]).collect()
    };
    let of_steps: Vec<BTreeMap<usize, [u8; 4]>> = parallel::map(states, of_state);
    let cut: BTreeSet<usize> = of_steps.iter().flat_map(BTreeMap::keys).copied().collect();
    let mut triangles = Vec::new();
    for number in cut {
        let corners = cracks.cells()[number].corners();
        for triangle in (2..corners.len()).map(|last| [0, last - 1, last]) {
            let codes = of_steps.iter().map(|it| match it.get(&number) {
                Some(sides) => code(&numbered_from_first(triangle.map(|corner| sides[corner]))),
                None => 0.0,
            });
            triangles.push((triangle.map(|corner| corners[corner]), codes.collect()));
        }
    }
    triangles
}

/// Sides of the corners of a triangle, numbered in the order of these corners.
fn numbered_from_first([first, second, third]: [u8; 3]) -> [u8; 4] {
    let of_second = u8::from(second != first);
    let of_third = match third {
        _ if third == first => 0,
        _ if third == second => of_second,
        _ => of_second + 1,
    };
    [0, of_second, of_third, 0]
}

/// Tetrahedra that are cut at some time, with the sides of their corners in each step; and the area of the crack surface.
fn solid_cracks(
    cracks: &SolidCracks,
    states: &[StoredState],
    body: &Body,
    texts: &mut ColumnTexts,
) -> Value {
    let of_steps: Vec<(Vec<[u8; 4]>, f64)> = parallel::map(states, |state| {
        (cracks.sides(*state), cracks.surface(*state).area())
    });
    let areas: Vec<f64> = of_steps.iter().map(|it| it.1).collect();
    let area = column("crack area", "m^2", &areas);
    let tetrahedra = cracks.tetrahedra();
    if tetrahedra.corners.is_empty() {
        return json!({"size": area, "area": area});
    }
    let mut described = match body.halves.is_empty() {
        true => json!({"of": mesh_simplices(&tetrahedra.corners, body, texts)}),
        false => lattice_tetrahedra(cracks, body, texts),
    };
    let sides = of_steps.iter().map(|it| it.0.iter().map(code).collect());
    add_sides(&mut described, sides, texts);
    described["size"] = area.clone();
    described["area"] = area;
    described
}

/// Adds the number of simplices that are cut at some time, and the codes of their sides in each step.
fn add_sides(
    described: &mut Value,
    of_steps: impl Iterator<Item = Vec<f64>>,
    texts: &mut ColumnTexts,
) {
    let (mut sides, mut count) = (Encoder::new(Digits::Whole), 0);
    for codes in of_steps {
        count = codes.len();
        sides.append(&codes);
    }
    described["simplices"] = json!(count);
    described["sides"] = texts.add(sides.finish());
}

/// Sides of four corners as one number; the first is 0, and the fourth of a triangle as well.
fn code(sides: &[u8; 4]) -> f64 {
    f64::from(sides[1] + 2 * sides[2] + 8 * sides[3])
}

/// Simplices of a mesh, by their corners in the files, as their numbers among the simplices of the body.
fn mesh_simplices<const N: usize>(
    corners: &[[u32; N]],
    body: &Body,
    texts: &mut ColumnTexts,
) -> Value {
    let all = body.numbered();
    let numbers = corners.iter().filter_map(|it| all.get(it).copied());
    texts.add_whole(numbers)
}

/// The tetrahedra by their nodes, with position and point of each node.
fn lattice_tetrahedra(cracks: &SolidCracks, body: &Body, texts: &mut ColumnTexts) -> Value {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Both halves of a quadrangle have the sides of its corners, wherever the numbering of the sides began.
    #[test]
    fn sides_of_halves_are_numbered_from_their_first_corner() {
        assert_eq!(numbered_from_first([0, 0, 0]), [0; 4]);
        assert_eq!(numbered_from_first([2, 2, 0]), [0, 0, 1, 0]);
        assert_eq!(numbered_from_first([1, 2, 1]), [0, 1, 0, 0]);
        assert_eq!(numbered_from_first([0, 2, 2]), [0, 1, 1, 0]);
        assert_eq!(numbered_from_first([3, 0, 1]), [0, 1, 2, 0]);
        assert_eq!(code(&numbered_from_first([3, 0, 1])), 5.0);
    }
}
