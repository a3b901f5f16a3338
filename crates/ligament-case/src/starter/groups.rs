//! Which groups of a mesh hold the body and which load it.

use ligament_mesh::{Group, Mesh};

/// Where something acts.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Spot {
    /// On a group, by its name.
    Group(String),
    /// In a rectangle, m.
    Box([[f64; 2]; 2]),
}

/// A support and a load opposite to it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ends {
    /// What is held.
    pub(super) support: Spot,
    /// What is held along the axis alone, as the second support of a beam is.
    pub(super) rollers: Vec<Spot>,
    /// What is moved.
    pub(super) load: Spot,
    /// The axis along which it is moved: 0 or 1.
    pub(super) axis: usize,
    /// From the support to the load along the axis: 1 or -1.
    pub(super) away: f64,
    /// Whether the load is moved towards the support, as a platen is.
    pub(super) presses: bool,
    /// How they were found, for a comment.
    pub(super) found: &'static str,
}

/// Words for what is held and what is loaded, in the order in which they are looked for.
const PAIRS: [[&[&str]; 2]; 3] = [
    [
        &[
            "fixed", "fix", "clamp", "clamped", "support", "hold", "held", "anvil",
        ],
        &[
            "load", "loaded", "force", "pull", "push", "punch", "press", "grip", "moved",
        ],
    ],
    [
        &["bottom", "lower", "base", "down", "south"],
        &["top", "upper", "up", "north"],
    ],
    [&["left", "west"], &["right", "east"]],
];

/// Words for what pushes on the body.
const PRESSING: [&str; 6] = ["platen", "press", "push", "punch", "anvil", "compression"];

/// Half the width of what presses on a beam, in spacings.
const HALF_A_PLATEN: f64 = 1.5;

/// Share of the body's extent within which a curve counts as lying at its end.
const AT_THE_END: f64 = 0.1;

/// The ends of a mesh between the corners of its bounding box: by the names of groups, else by where they lie, else by place.
pub(super) fn ends(mesh: &Mesh, extent: [[f64; 2]; 2], spacing: f64) -> Ends {
    beam(mesh, extent, spacing)
        .or_else(|| by_name(mesh))
        .or_else(|| by_place(mesh, extent))
        .unwrap_or_else(|| at_the_rim(extent, spacing))
}

/// A body on two supports or more, pressed onto them: by what is named as the load, else in the middle of the far side.
fn beam(mesh: &Mesh, extent: [[f64; 2]; 2], spacing: f64) -> Option<Ends> {
    let [[held, loaded], ..] = PAIRS;
    let groups = mesh.groups.iter();
    let supports: Vec<&Group> = groups
        .filter(|group| group.dimension < 2 && has_word(&group.name, held))
        .collect();
    let [first, rollers @ ..] = supports.as_slice() else {
        return None;
    };
    let last = rollers.last()?;
    let apart = [0, 1].map(|axis| middle(mesh, last, axis) - middle(mesh, first, axis));
    let axis = usize::from(apart[0].abs() > apart[1].abs());
    let along = 1 - axis;
    let level = middle(mesh, first, axis);
    let is_support = |load: &Group| supports.iter().any(|it| it.name == load.name);
    let named = best(mesh, loaded).filter(|load| !is_support(load));
    let (load, place) = match named {
        Some(load) => (Spot::Group(load.name.clone()), middle(mesh, load, axis)),
        None => {
            let [low, high] = extent.map(|corner| corner[axis]);
            let far = if level - low < high - level {
                high
            } else {
                low
            };
            let centre = middle(mesh, first, along) + 0.5 * apart[along];
            let mut corners = [[0.0; 2]; 2];
            for (corner, side) in corners.iter_mut().zip([-1.0, 1.0]) {
                corner[axis] = far + side * spacing;
                corner[along] = centre + side * HALF_A_PLATEN * spacing;
            }
            (Spot::Box(corners), far)
        }
    };
    let spot = |group: &&Group| Spot::Group(group.name.clone());
    Some(Ends {
        support: spot(first),
        rollers: rollers.iter().map(spot).collect(),
        load,
        axis,
        away: (place - level).signum(),
        presses: true,
        found: "as a beam on supports by their names",
    })
}

fn by_name(mesh: &Mesh) -> Option<Ends> {
    PAIRS.iter().find_map(|[held, loaded]| {
        let support = best(mesh, held)?;
        let load = best(mesh, loaded).filter(|load| load.name != support.name)?;
        between(mesh, support, load, "by their names")
    })
}

/// Of the groups with one of the words in their names, a curve before a surface before a point, and the one with most nodes.
fn best<'a>(mesh: &'a Mesh, words: &[&str]) -> Option<&'a Group> {
    let is_part = |group: &&Group| 4 * group.cells.len() < mesh.cells.len();
    let named = mesh
        .groups
        .iter()
        .filter(|group| has_word(&group.name, words));
    let named = named.filter(is_part);
    named.max_by_key(|group| {
        let rank = [0, 2, 1][usize::from(group.dimension.min(2))];
        (rank, group.nodes.len(), std::cmp::Reverse(group.number))
    })
}

fn has_word(name: &str, words: &[&str]) -> bool {
    let name = name.to_lowercase();
    let mut parts = name.split(|it: char| !it.is_alphabetic());
    parts.any(|part| words.contains(&part))
}

/// The curves along the lowest and the highest part of the body, or along its left and right.
fn by_place(mesh: &Mesh, extent: [[f64; 2]; 2]) -> Option<Ends> {
    [1, 0].into_iter().find_map(|axis| {
        let [low, high] = extent.map(|corner| corner[axis]);
        let near = AT_THE_END * (high - low);
        let lies = |group: &&Group, inside: &dyn Fn(f64) -> bool| {
            let mut nodes = group.nodes.iter();
            group.dimension < 2 && nodes.all(|&node| inside(mesh.positions[node as usize][axis]))
        };
        let longest = |inside: &dyn Fn(f64) -> bool| {
            let groups = mesh.groups.iter().filter(|group| lies(group, inside));
            groups.max_by_key(|group| (group.nodes.len(), std::cmp::Reverse(group.number)))
        };
        let support = longest(&|it| it <= low + near)?;
        let load = longest(&|it| it >= high - near)?;
        between(mesh, support, load, "by where they lie")
    })
}

/// Mean coordinate of the nodes of a group, m.
fn middle(mesh: &Mesh, group: &Group, axis: usize) -> f64 {
    let nodes = group.nodes.iter();
    let coordinates = nodes.map(|&node| mesh.positions[node as usize][axis]);
    coordinates.sum::<f64>() / group.nodes.len() as f64
}

/// None where they lie at the same place.
fn between(mesh: &Mesh, support: &Group, load: &Group, found: &'static str) -> Option<Ends> {
    let [x, y] = [0, 1].map(|axis| middle(mesh, load, axis) - middle(mesh, support, axis));
    let (axis, distance) = if x.abs() > y.abs() { (0, x) } else { (1, y) };
    (distance != 0.0).then(|| Ends {
        support: Spot::Group(support.name.clone()),
        rollers: Vec::new(),
        load: Spot::Group(load.name.clone()),
        axis,
        away: distance.signum(),
        presses: has_word(&load.name, &PRESSING) || has_word(&support.name, &PRESSING),
        found,
    })
}

/// Rectangles around the lowest and the highest nodes, as deep as a cell.
fn at_the_rim([low, high]: [[f64; 2]; 2], spacing: f64) -> Ends {
    let (left, right) = (low[0] - spacing, high[0] + spacing);
    Ends {
        rollers: Vec::new(),
        support: Spot::Box([[left, low[1] - spacing], [right, low[1] + spacing]]),
        load: Spot::Box([[left, high[1] - spacing], [right, high[1] + spacing]]),
        axis: 1,
        away: 1.0,
        presses: false,
        found: "by place, as no groups of the mesh suit",
    }
}

/// The surfaces that share the cells out among them, each cell in one, two or more; else none.
pub(super) fn parts(mesh: &Mesh) -> Vec<&Group> {
    let surfaces: Vec<&Group> = mesh.groups.iter().filter(|it| it.dimension == 2).collect();
    let mut owners = vec![0_usize; mesh.cells.len()];
    for &cell in surfaces.iter().flat_map(|surface| &surface.cells) {
        owners[cell as usize] += 1;
    }
    let mut names: Vec<&str> = surfaces.iter().map(|it| it.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let fits = owners.iter().all(|count| *count == 1) && names.len() == surfaces.len();
    if fits && surfaces.len() > 1 {
        surfaces
    } else {
        Vec::new()
    }
}
