//! Nodes: `*NODE`, `*SYSTEM`, `*NGEN`, `*NFILL` and `*NCOPY`.

use super::error::InpError;
use super::fields;
use super::geometry::{
    Frame, Vector, add, cross, difference, dot, length, of_cylindrical, of_spherical, scaled, unit,
};
use super::part::{Node, Part};
use super::source::{Command, Position, Row, Source};

/// What a user can do where nodes are not generated.
const WRITE_OUT: &str = "write the nodes out";

/// Difference of two radii, relative to the larger, below which they are those of one circle: coordinates in a deck have few digits.
const ROUND: f64 = 1e-4;

/// Reads nodes by their coordinates.
pub(super) fn read_nodes(command: &Command<'_>, part: &mut Part) -> Result<(), InpError> {
    let system = system(command)?;
    let mut labels = Vec::new();
    for mut row in command.rows() {
        let label = row.label("the number of a node")?;
        let local = system(row.coordinates()?);
        let at = part.frame.map_or(local, |frame| frame.apply(local));
        define(part, (label, row.position), at, &mut labels);
    }
    name_nodes(command, "NSET", part, &labels);
    Ok(())
}

fn define(part: &mut Part, (label, position): (u32, Position), at: Vector, labels: &mut Vec<u32>) {
    part.nodes.define(Node {
        label,
        position,
        at,
    });
    labels.push(label);
}

/// Adds nodes to the set that a parameter names, if there is one.
fn name_nodes(command: &Command<'_>, parameter: &str, part: &mut Part, labels: &[u32]) {
    let name = command.value(parameter);
    part.node_sets.extend(name, command.position(), labels);
}

/// Map from the coordinates of a system to rectangular ones.
fn system(command: &Command<'_>) -> Result<fn(Vector) -> Vector, InpError> {
    match command.word("SYSTEM").as_deref() {
        None | Some("R" | "RC") => Ok(|at| at),
        Some("C") => Ok(of_cylindrical),
        Some("S") => Ok(of_spherical),
        Some(other) => Err(command.unexpected("SYSTEM=R, C or S", other)),
    }
}

/// Reads the local system of the coordinates that follow; without data they are global again.
pub(super) fn read_system(command: &Command<'_>, part: &mut Part) -> Result<(), InpError> {
    part.frame = None;
    let mut rows = command.rows();
    let Some(mut first) = rows.next() else {
        return Ok(());
    };
    let origin = first.coordinates()?;
    let has_axis = first.fields.clone().any(|field| !field.is_empty());
    let frame = if has_axis {
        let on_axis = first.coordinates()?;
        let in_plane = rows.next().map(|mut row| row.coordinates()).transpose()?;
        Frame::local_system(origin, on_axis, in_plane)
    } else {
        Some(Frame::translation(origin))
    };
    let expected = "three points that are not on a line";
    part.frame = Some(frame.ok_or_else(|| first.unexpected(expected, first.text))?);
    Ok(())
}

/// Generates nodes between two others: on a straight line or on a circle.
pub(super) fn generate(command: &Command<'_>, part: &mut Part) -> Result<(), InpError> {
    let system = system(command)?;
    let is_circle = match command.word("LINE").as_deref() {
        None => false,
        Some("C") => true,
        Some(_) => return Err(command.not_carried_out("*NGEN with LINE=P", WRITE_OUT)),
    };
    let mut labels = Vec::new();
    for mut row in command.rows() {
        let all = between(&mut row)?;
        let n = all.len() - 1;
        let ends = [
            position_of(part, &row, all[0])?,
            position_of(part, &row, all[n])?,
        ];
        let arc = is_circle
            .then(|| arc(part, &mut row, ends, system))
            .transpose()?;
        for (step, &label) in all.iter().enumerate().take(n).skip(1) {
            let s = step as f64 / n as f64;
            let at = match &arc {
                Some(arc) => arc.at(ends[0], s),
                None => on_line(ends, s),
            };
            define(part, (label, row.position), at, &mut labels);
        }
        labels.extend([all[0], all[n]]);
    }
    name_nodes(command, "NSET", part, &labels);
    Ok(())
}

/// Numbers from the first to the last one in a row, in steps of the increment behind them.
fn between(row: &mut Row<'_>) -> Result<Vec<u32>, InpError> {
    let first = row.label("the number of a node")?;
    let last = row.label("the number of a node")?;
    let increment = row.integer("an increment", 1)?.unsigned_abs() as usize;
    let difference = first.abs_diff(last) as usize;
    if increment == 0 || difference == 0 || !difference.is_multiple_of(increment) {
        let expected = "an increment that divides the difference of the two numbers";
        return Err(row.unexpected(expected, row.text));
    }
    let steps = (0..=difference as u32).step_by(increment);
    let label = |step| match first < last {
        true => first + step,
        false => first - step,
    };
    Ok(steps.map(label).collect())
}

fn position_of(part: &Part, row: &Row<'_>, label: u32) -> Result<Vector, InpError> {
    known_position(part, row.source, row.position, label)
}

fn known_position(
    part: &Part,
    source: &Source<'_>,
    position: Position,
    label: u32,
) -> Result<Vector, InpError> {
    let at = part.nodes.at(label);
    at.ok_or_else(|| InpError::UnknownLabel {
        line: source.line(position),
        what: "node",
        label,
    })
}

fn on_line([a, b]: [Vector; 2], s: f64) -> Vector {
    add(scaled(a, 1.0 - s), scaled(b, s))
}

/// Arc of a circle.
struct Arc {
    /// The centre, and another point on the axis.
    axis: [Vector; 2],
    degrees: f64,
}

impl Arc {
    /// Position after some fraction of the arc from its beginning.
    fn at(&self, beginning: Vector, fraction: f64) -> Vector {
        let rotation = Frame::rotation(self.axis[0], self.axis[1], fraction * self.degrees);
        rotation.map_or(beginning, |rotation| rotation.apply(beginning))
    }
}

/// Arc between two points, around the centre that follows in the row, by a node or by coordinates, with a normal.
fn arc(
    part: &Part,
    row: &mut Row<'_>,
    [a, b]: [Vector; 2],
    system: fn(Vector) -> Vector,
) -> Result<Arc, InpError> {
    let node = row.integer("the number of a node", 0)?;
    let coordinates = row.coordinates()?;
    let centre = match node {
        0 if part.frame.is_some() => {
            let what = "*NGEN with LINE=C and coordinates under *SYSTEM";
            let remedy = "give the centre by a node";
            return Err(row.source.not_carried_out(row.position, what, remedy));
        }
        0 => system(coordinates),
        node => position_of(part, row, row.source.shifted(row.position, 0, node)?)?,
    };
    let (from, to) = (difference(a, centre), difference(b, centre));
    let given = unit(row.coordinates()?);
    let normal = given.or_else(|| unit(cross(from, to)));
    let (first, second) = (length(from), length(to));
    let is_round = (first - second).abs() <= ROUND * first.max(second);
    let normal = normal.filter(|_| is_round && first > 0.0);
    let normal = normal.ok_or_else(|| {
        let expected =
            "a circle: ends at one distance from the centre, and a normal for 180° or more";
        row.unexpected(expected, row.text)
    })?;
    let angle = dot(normal, cross(from, to)).atan2(dot(from, to));
    let degrees = angle.to_degrees();
    Ok(Arc {
        axis: [centre, add(centre, normal)],
        degrees: if degrees > 0.0 {
            degrees
        } else {
            degrees + 360.0
        },
    })
}

/// Fills in nodes between those of two sets.
pub(super) fn fill(command: &Command<'_>, part: &mut Part) -> Result<(), InpError> {
    let bias = command
        .value("BIAS")
        .map(|bias| fields::real(bias.as_bytes()));
    let is_uniform = bias.is_none_or(|bias| bias == Some(1.0));
    if !is_uniform || command.has("SINGULAR") || command.has("TWO STEP") {
        let what = "*NFILL with uneven distances (BIAS, SINGULAR, TWO STEP)";
        return Err(command.not_carried_out(what, WRITE_OUT));
    }
    let mut labels = Vec::new();
    for mut row in command.rows() {
        fill_row(part, &mut row, &mut labels)?;
    }
    name_nodes(command, "NSET", part, &labels);
    Ok(())
}

fn fill_row(part: &mut Part, row: &mut Row<'_>, labels: &mut Vec<u32>) -> Result<(), InpError> {
    let (first, second) = (set_of(part, row)?, set_of(part, row)?);
    let intervals = row.integer("a number of intervals", 1)?;
    let increment = row.integer("an increment", 1)?;
    if first.len() != second.len() || intervals < 1 {
        let expected = "two sets with the same number of nodes, and at least one interval";
        return Err(row.unexpected(expected, row.text));
    }
    for (from, to) in first.iter().zip(&second) {
        let ends = [position_of(part, row, *from)?, position_of(part, row, *to)?];
        labels.extend([from, to]);
        for step in 1..intervals {
            let label = row.source.shifted(row.position, *from, step * increment)?;
            let at = on_line(ends, step as f64 / intervals as f64);
            define(part, (label, row.position), at, labels);
        }
    }
    Ok(())
}

/// Nodes of the set, or the node, that the next field names.
fn set_of(part: &Part, row: &mut Row<'_>) -> Result<Vec<u32>, InpError> {
    let field = row.field();
    let name = String::from_utf8_lossy(field);
    match (part.node_sets.get(&name), fields::label(field)) {
        (Some(set), _) => Ok(set.labels_in_order()),
        (None, Some(label)) => Ok(vec![label]),
        (None, None) => Err(row.source.unknown(row.position, "node set", &name)),
    }
}

/// Copies nodes: shifted and turned, or reflected.
pub(super) fn copy(command: &Command<'_>, part: &mut Part) -> Result<(), InpError> {
    if command.has("POLE") || part.frame.is_some() {
        let what = "*NCOPY with POLE or under *SYSTEM";
        return Err(command.not_carried_out(what, WRITE_OUT));
    }
    let name = command.required("OLD SET")?;
    let set = part.node_sets.get(name);
    let set = set.ok_or_else(|| command.unknown("node set", name))?;
    let change = command.integer("CHANGE NUMBER")?;
    let times = match command.has("MULTIPLE") {
        true => command.integer("MULTIPLE")?,
        false => 1,
    };
    let map = match command.has("SHIFT") {
        true => motion(&mut command.all_rows())?,
        false => reflection(command)?,
    };
    let mut labels = Vec::new();
    for label in set.labels_in_order() {
        let mut at = known_position(part, command.source, command.position(), label)?;
        for time in 1..=times {
            at = map.apply(at);
            let by = change.saturating_mul(time);
            let label = command.source.shifted(command.position(), label, by)?;
            define(part, (label, command.position()), at, &mut labels);
        }
    }
    name_nodes(command, "NEW SET", part, &labels);
    Ok(())
}

/// Reflection at the points of the data: two in the first line, a third in the second one.
fn reflection(command: &Command<'_>) -> Result<Frame, InpError> {
    let kind = command.word("REFLECT").unwrap_or_default();
    let mut points = [[0.0; 3]; 4];
    for (row, points) in command.rows().zip(points.chunks_mut(2)) {
        let mut row = row;
        points[0] = row.coordinates()?;
        points[1] = row.coordinates()?;
    }
    let [a, b, c, _] = points;
    let reflection = match kind.as_str() {
        "POINT" => Some(Frame::point_reflection(a)),
        "LINE" => Frame::line_reflection(a, b),
        "MIRROR" => Frame::mirror(a, b, c),
        _ => None,
    };
    let expected =
        "SHIFT, or REFLECT=POINT, LINE or MIRROR with one, two or three different points";
    reflection.ok_or_else(|| command.unexpected(expected, &kind))
}

/// A translation, and a rotation after it, in two lines; either may be blank.
pub(super) fn motion<'s>(rows: &mut impl Iterator<Item = Row<'s>>) -> Result<Frame, InpError> {
    let Some(mut first) = rows.next() else {
        return Ok(Frame::translation([0.0; 3]));
    };
    let translation = Frame::translation(first.coordinates()?);
    let Some(mut second) = rows.next() else {
        return Ok(translation);
    };
    let (from, to) = (second.coordinates()?, second.coordinates()?);
    let angle = second.real("an angle in degrees")?;
    if let Some(third) = rows.find(|row| !row.text.is_empty()) {
        return Err(third.unexpected("a translation and a rotation in two lines", third.text));
    }
    if [from, to] == [[0.0; 3]; 2] && angle == 0.0 {
        return Ok(translation);
    }
    let rotation = Frame::rotation(from, to, angle);
    let expected = "two different points on the axis of rotation, and an angle";
    let rotation = rotation.ok_or_else(|| second.unexpected(expected, second.text))?;
    Ok(translation.then(&rotation))
}
