//! Choice of the groups of a mesh for supports and loads.

use ligament_mesh::Group;

/// Place of a support or a load.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum LoadPlace<const D: usize> {
    /// A group, by its name.
    Group(String),
    /// A rectangle or, in space, a box, m.
    Box([[f64; D]; 2]),
}

/// A support and a load opposite to it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SupportAndLoad<const D: usize> {
    /// Place of the support.
    pub(super) support: LoadPlace<D>,
    /// Places fixed along the axis only, such as the second support of a beam.
    pub(super) rollers: Vec<LoadPlace<D>>,
    /// Place that is moved.
    pub(super) load: LoadPlace<D>,
    /// Axis of the motion, below D.
    pub(super) axis: usize,
    /// Direction from the support to the load along the axis: 1 or -1.
    pub(super) away: f64,
    /// Whether the load moves towards the support, as a platen does.
    pub(super) presses: bool,
    /// Distance of the outermost supports of a beam, m; 0 for other bodies.
    pub(super) span: f64,
    /// Description of the choice, for a comment in the case.
    pub(super) found: &'static str,
}

/// Words in names of supports and of loads, in the order of the search.
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

/// Words in names of loads that press on the body.
const PRESSING: [&str; 6] = ["platen", "press", "push", "punch", "anvil", "compression"];

/// Half of the width of a load on a beam, in spacings.
const HALF_A_PLATEN: f64 = 1.5;

/// Share of the body's extent within which a group counts as lying at its end.
const AT_THE_END: f64 = 0.1;

/// Groups and nodes of a mesh in D dimensions for the choice of ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeshGroups<'a, const D: usize> {
    /// Physical groups.
    pub(super) groups: &'a [Group],
    /// Positions of the nodes, m.
    pub(super) positions: &'a [[f64; D]],
    /// Number of cells.
    pub(super) n_cells: usize,
}

impl<'a, const D: usize> MeshGroups<'a, D> {
    /// The ends of a mesh within its bounding box `extent` (m): by the names of groups, otherwise by the positions of groups, otherwise by
    /// boxes.
    pub(super) fn ends(&self, extent: [[f64; D]; 2], spacing: f64) -> SupportAndLoad<D> {
        self.beam(extent, spacing)
            .or_else(|| self.by_name())
            .or_else(|| self.by_place(extent))
            .unwrap_or_else(|| boxes_at_rim(extent, spacing))
    }

    /// The ends of a beam on two or more supports, loaded by a group with a name of loads, otherwise in the middle of the far side; `None`
    /// for other bodies.
    fn beam(&self, extent: [[f64; D]; 2], spacing: f64) -> Option<SupportAndLoad<D>> {
        let [[held, loaded], _, ends] = PAIRS;
        let mut supports = self.sides(held);
        let is_loaded = |group: &Group| has_word(&group.name, loaded);
        if supports.is_empty() && self.groups.iter().any(is_loaded) {
            // The ends of a beam with a load are its supports.
            supports = ends.iter().flat_map(|words| self.sides(words)).collect();
            supports.retain(|group| !is_loaded(group));
        }
        let [first, rollers @ ..] = supports.as_slice() else {
            return None;
        };
        let last = rollers.last()?;
        let offset: [f64; D] =
            std::array::from_fn(|axis| self.middle(last, axis) - self.middle(first, axis));
        let along = farthest(offset);
        // The supports are at a side of the body across the load.
        let to_a_side = |axis: usize| {
            let ([low, high], level) = (extent.map(|it| it[axis]), self.middle(first, axis));
            (level - low).min(high - level) / (high - low)
        };
        let others = (0..D).rev().filter(|axis| *axis != along);
        let axis = others.min_by(|a, b| to_a_side(*a).total_cmp(&to_a_side(*b)))?;
        let level = self.middle(first, axis);
        let is_support = |load: &Group| supports.iter().any(|it| it.name == load.name);
        let named = self.best(loaded).filter(|load| !is_support(load));
        let (load, place) = match named {
            Some(load) => (LoadPlace::Group(load.name.clone()), self.middle(load, axis)),
            None => {
                let [low, high] = extent.map(|corner| corner[axis]);
                let far = if level - low < high - level {
                    high
                } else {
                    low
                };
                let centre = self.middle(first, along) + 0.5 * offset[along];
                let mut corners = extent;
                for (corner, side) in corners.iter_mut().zip([-1.0, 1.0]) {
                    corner.iter_mut().for_each(|it| *it += side * spacing);
                    corner[axis] = far + side * spacing;
                    corner[along] = centre + side * HALF_A_PLATEN * spacing;
                }
                (LoadPlace::Box(corners), far)
            }
        };
        let spot = |group: &&Group| LoadPlace::Group(group.name.clone());
        Some(SupportAndLoad {
            support: spot(first),
            rollers: rollers.iter().map(spot).collect(),
            load,
            axis,
            away: (place - level).signum(),
            presses: true,
            span: offset[along].abs(),
            found: "as a beam on supports by their names",
        })
    }

    /// Groups of lower dimension than cells with one of the words in their names.
    fn sides(&self, words: &[&str]) -> Vec<&'a Group> {
        let groups = self.groups.iter();
        let sides = groups.filter(|group| usize::from(group.dimension) < D);
        sides.filter(|group| has_word(&group.name, words)).collect()
    }

    fn by_name(&self) -> Option<SupportAndLoad<D>> {
        let [[held, loaded], [below, _], [left, right]] = PAIRS;
        // A group with a name of loads acts against one with a name of supports, or of a side.
        let against_load = [held, below, left, right].map(|it| [it, loaded]);
        against_load
            .iter()
            .chain(&PAIRS)
            .find_map(|[held, loaded]| {
                let support = self.best(held)?;
                let load = self.best(loaded).filter(|load| load.name != support.name)?;
                self.between(support, load, "by their names")
            })
    }

    /// The best group with one of the words in its name: groups of sides of cells precede groups of cells, of edges or of points, and groups
    /// with more nodes precede others.
    fn best(&self, words: &[&str]) -> Option<&'a Group> {
        let is_part = |group: &&Group| 4 * group.cells.len() < self.n_cells;
        let named = self
            .groups
            .iter()
            .filter(|group| has_word(&group.name, words));
        let named = named.filter(is_part);
        named.max_by_key(|group| {
            let rank = match usize::from(group.dimension) {
                sides if sides + 1 == D => D,
                cells if cells == D => D - 1,
                below => below,
            };
            (rank, group.nodes.len(), std::cmp::Reverse(group.number))
        })
    }

    /// Ends by groups at the highest and the lowest part of the body, or along another axis.
    fn by_place(&self, extent: [[f64; D]; 2]) -> Option<SupportAndLoad<D>> {
        (0..D).rev().find_map(|axis| {
            let [low, high] = extent.map(|corner| corner[axis]);
            let near = AT_THE_END * (high - low);
            let lies = |group: &&Group, inside: &dyn Fn(f64) -> bool| {
                let mut nodes = group.nodes.iter();
                usize::from(group.dimension) < D
                    && nodes.all(|&node| inside(self.positions[node as usize][axis]))
            };
            let longest = |inside: &dyn Fn(f64) -> bool| {
                let groups = self.groups.iter().filter(|group| lies(group, inside));
                groups.max_by_key(|group| (group.nodes.len(), std::cmp::Reverse(group.number)))
            };
            let support = longest(&|it| it <= low + near)?;
            let load = longest(&|it| it >= high - near)?;
            self.between(support, load, "by where they lie")
        })
    }

    /// Mean coordinate of the nodes of a group, m.
    fn middle(&self, group: &Group, axis: usize) -> f64 {
        let nodes = group.nodes.iter();
        let coordinates = nodes.map(|&node| self.positions[node as usize][axis]);
        coordinates.sum::<f64>() / group.nodes.len() as f64
    }

    /// Ends with a support and a load; `None` where both have the same position.
    fn between(
        &self,
        support: &Group,
        load: &Group,
        found: &'static str,
    ) -> Option<SupportAndLoad<D>> {
        let offset: [f64; D] =
            std::array::from_fn(|axis| self.middle(load, axis) - self.middle(support, axis));
        let axis = farthest(offset);
        let distance = offset[axis];
        (distance != 0.0).then(|| SupportAndLoad {
            support: LoadPlace::Group(support.name.clone()),
            rollers: Vec::new(),
            load: LoadPlace::Group(load.name.clone()),
            axis,
            away: distance.signum(),
            presses: has_word(&load.name, &PRESSING) || has_word(&support.name, &PRESSING),
            span: 0.0,
            found,
        })
    }

    /// The groups of cells if they are two or more and each cell is in exactly one of them; otherwise empty.
    pub(super) fn parts(&self) -> Vec<&'a Group> {
        let of_cells = |it: &&Group| usize::from(it.dimension) == D;
        let parts: Vec<&Group> = self.groups.iter().filter(of_cells).collect();
        let mut owners = vec![0_usize; self.n_cells];
        for &cell in parts.iter().flat_map(|part| &part.cells) {
            owners[cell as usize] += 1;
        }
        let mut names: Vec<&str> = parts.iter().map(|it| it.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        let fits = owners.iter().all(|count| *count == 1) && names.len() == parts.len();
        if fits && parts.len() > 1 {
            parts
        } else {
            Vec::new()
        }
    }
}

fn has_word(name: &str, words: &[&str]) -> bool {
    let name = name.to_lowercase();
    let mut parts = name.split(|it: char| !it.is_alphabetic());
    parts.any(|part| words.contains(&part))
}

/// The axis of the largest component, the last one if several are equal.
fn farthest<const D: usize>(components: [f64; D]) -> usize {
    let start = D - 1;
    (0..D).rev().fold(start, |best, axis| {
        if components[axis].abs() > components[best].abs() {
            axis
        } else {
            best
        }
    })
}

/// Boxes around the lowest and the highest nodes along the last axis, as deep as a cell.
fn boxes_at_rim<const D: usize>([low, high]: [[f64; D]; 2], spacing: f64) -> SupportAndLoad<D> {
    let axis = D - 1;
    let around = |level: f64| {
        let mut corners = [low.map(|it| it - spacing), high.map(|it| it + spacing)];
        corners[0][axis] = level - spacing;
        corners[1][axis] = level + spacing;
        LoadPlace::Box(corners)
    };
    SupportAndLoad {
        rollers: Vec::new(),
        support: around(low[axis]),
        load: around(high[axis]),
        axis,
        away: 1.0,
        presses: false,
        span: 0.0,
        found: "by place, as no groups of the mesh suit",
    }
}
