//! Supports and loads of a run as symbols at points of its body.

use std::collections::HashMap;

use ligament_output::results::stored::StoredModel;
use serde_json::{Value, json};
use toml::Table;

use crate::body::Body;

/// Largest number of points of a support or load that get a symbol.
const MOST_POINTS: usize = 12;

/// Keys of a vector's components along x, y and z.
const ALONG: [&str; 3] = ["x", "y", "z"];

/// Keys of prescribed motions, and of loads that are forces.
const MOTIONS: [&str; 3] = ["displacement", "velocity", "base_acceleration"];
const FORCES: [&str; 5] = [
    "force",
    "force_per_length",
    "force_per_area",
    "body_force",
    "acceleration",
];

/// Keys of couples.
const COUPLES: [&str; 2] = ["moment", "body_couple"];

/// Supports and loads of a case with points that they act on, for the viewer; empty if the results do not record these points.
pub(crate) fn describe(case: &Table, model: &StoredModel, body: &Body) -> Value {
    let places: HashMap<i64, u32> = body.tags.iter().copied().zip(0..).collect();
    let mut names = Names::default();
    let mut found = Vec::new();
    for (list, is_support) in [("support", true), ("load", false)] {
        let entries = case.get(list).and_then(toml::Value::as_array);
        let entries = entries.into_iter().flatten().filter_map(|it| it.as_table());
        for (index, entry) in entries.enumerate() {
            let numbered = format!("{list}-{}", index + 1);
            let given = ["name", "group"].iter().find_map(|key| text(entry, key));
            let of_name = |name: &str| model.groups.contains_key(name);
            let name = given.filter(|it| of_name(it)).unwrap_or(&numbered);
            let Some(points) = model.groups.get(&names.in_history(name, entry)) else {
                continue;
            };
            let points = chosen(points, model);
            let mut symbol = match is_support {
                true => support(entry, body.dimension),
                false => load(entry, body.dimension),
            };
            if let Some(pressure) = entry.get("pressure").and_then(number) {
                symbol["pressures"] = json!(pressures(pressure, &points, model));
                symbol["isPush"] = json!(pressure > 0.0);
            }
            let tags = points.iter().map(|&it| model.tags[it as usize]);
            let points = tags.map(|it| places.get(&it).copied().unwrap_or_default());
            symbol["points"] = json!(points.collect::<Vec<u32>>());
            found.push(symbol);
        }
    }
    Value::Array(found)
}

/// Places found under each name; in the history the second and later places have a numbered name.
#[derive(Default)]
struct Names(HashMap<String, Vec<[Option<toml::Value>; 3]>>);

impl Names {
    fn in_history(&mut self, name: &str, entry: &Table) -> String {
        let place = ["group", "box", "at"].map(|key| entry.get(key).cloned());
        let met = self.0.entry(name.to_owned()).or_default();
        let number = met.iter().position(|it| *it == place).unwrap_or_else(|| {
            met.push(place);
            met.len() - 1
        });
        match number {
            0 => name.to_owned(),
            _ => format!("{name}-{}", number + 1),
        }
    }
}

/// Motions that a support fixes: axes, a direction, rotations; and the axes and direction of its springs.
fn support(entry: &Table, dimension: usize) -> Value {
    let held = entry.get("displacement").and_then(toml::Value::as_table);
    let springs = entry.get("stiffness").and_then(toml::Value::as_table);
    let of_spring = |key: &str| springs.is_some_and(|it| it.contains_key(key));
    let normal = entry.get("normal").and_then(toml::Value::as_array);
    let normal = normal.map(|it| it.iter().filter_map(number).collect::<Vec<f64>>());
    json!({
        "isSupport": true,
        "held": axes(held, dimension, |_| true),
        "turning": held.is_some_and(|it| it.keys().any(|key| key.starts_with("rotation"))),
        "springs": axes(springs, dimension, |_| true),
        "normal": normal,
        "isNormalSpring": of_spring("normal"),
    })
}

/// Action of a load: fixed axes, a prescribed motion or a force along the axes, a turn about them.
fn load(entry: &Table, dimension: usize) -> Value {
    let table = |keys: &[&str]| keys.iter().find_map(|key| entry.get(*key)?.as_table());
    let motion = table(&MOTIONS);
    let rotation = |it: &Table| {
        let about = |key: &str| it.get(key).and_then(number).unwrap_or(0.0);
        [
            about("rotation_x"),
            about("rotation_y"),
            about("rotation_z") + about("rotation"),
        ]
    };
    let couple = COUPLES.iter().find_map(|key| entry.get(*key));
    let couple = couple.map(|it| match it.as_table() {
        Some(about) => vector(about),
        None => [0.0, 0.0, number(it).unwrap_or(0.0)],
    });
    json!({
        "isSupport": false,
        "held": axes(motion, dimension, |value| value == 0.0),
        "motion": motion.map(vector),
        "force": table(&FORCES).map(vector),
        "turn": couple.or(motion.map(rotation)),
    })
}

/// Axes whose components are given, with values for which `of_value` holds.
fn axes(given: Option<&Table>, dimension: usize, of_value: fn(f64) -> bool) -> Vec<usize> {
    let is_given = |axis: &usize| {
        let value = given.and_then(|it| it.get(ALONG[*axis]));
        value.and_then(number).is_some_and(of_value)
    };
    (0..dimension).filter(is_given).collect()
}

fn vector(given: &Table) -> [f64; 3] {
    ALONG.map(|key| given.get(key).and_then(number).unwrap_or(0.0))
}

fn number(value: &toml::Value) -> Option<f64> {
    let whole = || value.as_integer().map(|it| it as f64);
    value.as_float().or_else(whole)
}

fn text<'a>(entry: &'a Table, key: &str) -> Option<&'a str> {
    entry.get(key)?.as_str()
}

/// Points that get symbols: spread evenly over the given points, or only the middle one where most of the body is acted on.
fn chosen(points: &[u32], model: &StoredModel) -> Vec<u32> {
    let at = |point: u32| model.positions[point as usize];
    if 2 * points.len() > model.positions.len() {
        let n = points.len() as f64;
        let mean = [0, 1, 2].map(|axis| points.iter().map(|&it| at(it)[axis]).sum::<f64>() / n);
        let distance = |&point: &u32| {
            let squares = at(point)
                .into_iter()
                .zip(mean)
                .map(|(a, b)| (a - b).powi(2));
            squares.sum::<f64>()
        };
        let nearest = (points.iter()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        return nearest.copied().into_iter().collect();
    }
    // Each point is the one farthest from all points before it.
    let mut distances = vec![f64::INFINITY; points.len()];
    let mut found = Vec::new();
    let mut next = points.first().copied();
    while let Some(point) = next.filter(|_| found.len() < MOST_POINTS.min(points.len())) {
        found.push(point);
        for (distance, &other) in distances.iter_mut().zip(points) {
            *distance = distance.min(squared_distance(at(point), at(other)));
        }
        let farthest = points.iter().zip(&distances);
        let farthest = farthest.max_by(|a, b| a.1.total_cmp(b.1));
        next = farthest.map(|it| *it.0);
    }
    found
}

/// Square of a distance, m^2.
fn squared_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum()
}

/// Directions of a pressure at points: into the body where it is positive, the mean of the directions of the point's bonds.
fn pressures(pressure: f64, points: &[u32], model: &StoredModel) -> Vec<[f64; 3]> {
    let mut sums: HashMap<u32, [f64; 3]> = points.iter().map(|it| (*it, [0.0; 3])).collect();
    for (ends, absence) in model.bonds.ends.iter().zip(&model.bonds.absence) {
        if absence.is_some() {
            continue;
        }
        for [from, to] in [*ends, [ends[1], ends[0]]] {
            let Some(sum) = sums.get_mut(&from) else {
                continue;
            };
            let [a, b] = [from, to].map(|it| model.positions[it as usize]);
            let along = [0, 1, 2].map(|axis| b[axis] - a[axis]);
            let length = along.iter().map(|it| it * it).sum::<f64>().sqrt();
            (0..3).for_each(|axis| sum[axis] += along[axis] / length);
        }
    }
    let signed = |it: &u32| sums[it].map(|component| pressure.signum() * component);
    points.iter().map(signed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Table {
        text.parse().unwrap()
    }

    #[test]
    fn supports_and_loads_say_what_they_hold_and_do() {
        let held = support(&table("displacement = { x = 0.0, rotation = 0 }"), 2);
        assert_eq!(held["held"], json!([0]));
        assert_eq!(held["turning"], json!(true));
        let inclined = support(&table("normal = [1, 1.0]\nstiffness = { normal = 1e9 }"), 2);
        assert_eq!(inclined["normal"], json!([1.0, 1.0]));
        assert_eq!(inclined["isNormalSpring"], json!(true));
        let moved = load(&table("displacement = { x = 0.0, y = -1e-3 }"), 2);
        assert_eq!(moved["held"], json!([0]));
        assert_eq!(moved["motion"], json!([0.0, -1e-3, 0.0]));
        let couple = load(&table("moment = 2.0"), 2);
        assert_eq!(couple["turn"], json!([0.0, 0.0, 2.0]));
        let couple = load(&table("moment = { x = 2.0 }"), 3);
        assert_eq!(couple["turn"], json!([2.0, 0.0, 0.0]));
    }

    #[test]
    fn second_places_of_a_name_are_numbered() {
        let mut names = Names::default();
        let [left, right] = ["group = \"left\"", "box = [[0, 0], [1, 1]]"].map(table);
        assert_eq!(names.in_history("pull", &left), "pull");
        assert_eq!(names.in_history("pull", &right), "pull-2");
        assert_eq!(names.in_history("pull", &left), "pull");
    }
}
