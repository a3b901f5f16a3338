//! Construction of a body from the keys of a lattice section, in the plane and in space.

use std::collections::BTreeMap;

use ligament::body::{BodyOnLattice, Cells, Hole, LatticeError, LatticeShape};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{one_of, require, require_column_name};

/// Largest number of cells of a lattice.
pub const MOST_CELLS: u64 = 50_000_000;

/// Largest distance from the origin, in cells: beyond it coordinates of neighbours would share too many digits.
const FARTHEST: f64 = 1e9;

/// Keys of a section that describes a lattice in D dimensions.
pub(crate) trait LatticeKeys<const D: usize> {
    /// Key of the section.
    const SECTION: &'static str;

    /// Text for the axes: "x and y".
    const AXES: &'static str;

    /// Type of the shapes of holes and sets.
    type Shape: LatticeShape<D>;

    /// Type of the keys of a hole.
    type Hole: HoleKeys<Self::Shape>;

    /// Type of the keys of a set of cells.
    type Set: SetKeys<D, Self::Shape>;

    /// Number of cells along the axes.
    fn cells(&self) -> [u32; D];

    /// Sides of the cells, m.
    fn spacing(&self) -> [f64; D];

    /// Corner with the lowest coordinates, m.
    fn corner(&self) -> [f64; D];

    /// Thickness of a body in the plane, m; 1 for a solid.
    fn thickness(&self) -> f64 {
        1.0
    }

    /// Keys of the holes.
    fn holes(&self) -> &[Self::Hole];

    /// Keys of the sets of cells, by their names.
    fn sets(&self) -> &BTreeMap<String, Self::Set>;
}

/// Type of the keys of a hole.
pub(crate) trait HoleKeys<S> {
    /// Name of the group of the cells at the hole's rim.
    fn name(&self) -> Option<&String>;

    /// The possible shapes by their keys, exactly one of which is given.
    fn shapes(&self) -> Vec<(&'static str, Option<S>)>;
}

/// Keys of a set of cells of a lattice in D dimensions.
pub(crate) trait SetKeys<const D: usize, S> {
    /// Numbers of layers at the sides of the lattice, by their keys, with the outward normals of the sides.
    fn sides(&self) -> Vec<(&'static str, Option<u32>, [i8; D])>;

    /// The possible shapes by their keys.
    fn shapes(&self) -> Vec<(&'static str, Option<S>)>;
}

/// The body of a section.
///
/// # Errors
///
/// If a key is out of range, or no cell remains of the lattice, of a set or of the rim of a hole.
pub(crate) fn body<const D: usize, K: LatticeKeys<D>>(
    keys: &K,
) -> Result<BodyOnLattice<D, K::Shape>, KeyFault> {
    let section = KeyPath::default().child(K::SECTION);
    let (holes, sets) = parts(keys, &section)?;
    let body = BodyOnLattice::new(keys.cells(), keys.spacing(), keys.corner(), &holes, &sets);
    body.map_err(|error| {
        let key = match &error {
            LatticeError::NothingLeft { .. } => section.child("remove"),
            LatticeError::EmptySet { name } => section.child("set").child(name),
            LatticeError::NoRim { hole } => section.child("remove").child(*hole),
        };
        KeyFault::new(key, error.to_string())
    })
}

/// A substitute for the body of a section: one of its cells.
///
/// # Errors
///
/// If a key is out of range.
pub(crate) fn stand_in<const D: usize, K: LatticeKeys<D>>(
    keys: &K,
) -> Result<BodyOnLattice<D, K::Shape>, KeyFault> {
    let section = KeyPath::default().child(K::SECTION);
    parts(keys, &section)?;
    let cell = BodyOnLattice::new([1; D], keys.spacing(), keys.corner(), &[], &BTreeMap::new());
    cell.map_err(|error| KeyFault::new(section, error.to_string()))
}

/// Holes and sets of a lattice.
type Parts<const D: usize, S> = (Vec<Hole<S>>, BTreeMap<String, Cells<D, S>>);

fn parts<const D: usize, K: LatticeKeys<D>>(
    keys: &K,
    section: &KeyPath,
) -> Result<Parts<D, K::Shape>, KeyFault> {
    check_size(keys, section)?;
    let holes = keys.holes().iter().enumerate().map(|(index, hole)| {
        let key = section.child("remove").child(index);
        if let Some(name) = hole.name() {
            require_column_name(|| key.child("name"), name)?;
            if keys.sets().contains_key(name) {
                let list = K::SECTION;
                let reason = format!("`{list}.set` has a `{name}` as well: rename one of them");
                return Err(KeyFault::new(key.child("name"), reason));
            }
        }
        Ok(Hole {
            name: hole.name().cloned(),
            shape: one_of(&key, hole.shapes())?,
        })
    });
    let holes = holes.collect::<Result<_, _>>()?;
    let sets = keys.sets().iter().map(|(name, set)| {
        let cells = cells_of(set, &section.child("set").child(name), keys.cells())?;
        Ok((name.clone(), cells))
    });
    Ok((holes, sets.collect::<Result<_, _>>()?))
}

fn check_size<const D: usize, K: LatticeKeys<D>>(
    keys: &K,
    section: &KeyPath,
) -> Result<(), KeyFault> {
    let (cells, spacing, corner) = (keys.cells(), keys.spacing(), keys.corner());
    let along = cells.iter().map(|&it| u64::from(it));
    let n_cells = along.fold(1_u64, u64::saturating_mul);
    require(
        (1..=MOST_CELLS).contains(&n_cells),
        || section.child("cells"),
        &format!(
            "at least 1 along {}, and {MOST_CELLS} together at most",
            K::AXES
        ),
        cells,
    )?;
    let volume = spacing.iter().product::<f64>() * keys.thickness();
    require(
        spacing.iter().all(|side| *side > 0.0) && volume.is_normal(),
        || section.child("spacing"),
        "greater than 0, and of a size that gives the cells a volume",
        spacing,
    )?;
    let is_near = |axis: usize| {
        corner[axis].abs() + f64::from(cells[axis]) * spacing[axis] <= FARTHEST * spacing[axis]
    };
    require(
        (0..D).all(is_near),
        || section.child("corner"),
        "so near to the origin that no corner of the lattice is more than 1e9 cells away from it",
        corner,
    )
}

/// The rule for the cells of a set in a lattice of `size` cells along the axes.
fn cells_of<const D: usize, S: LatticeShape<D>>(
    set: &impl SetKeys<D, S>,
    key: &KeyPath,
    size: [u32; D],
) -> Result<Cells<D, S>, KeyFault> {
    let sides = set.sides();
    for &(name, layers, normal) in &sides {
        let across = normal.iter().position(|it| *it != 0).unwrap_or(0);
        let (most, layers) = (size[across], layers.unwrap_or(1));
        let expected = format!("{most} or less, as the lattice has");
        require(layers <= most, || key.child(name), &expected, layers)?;
    }
    let at_side = |(name, layers, normal): (&'static str, Option<u32>, [i8; D])| {
        (name, layers.map(|it| Cells::AtSide(normal, it)))
    };
    let inside = |(name, shape): (&'static str, Option<S>)| (name, shape.map(Cells::Inside));
    let given = sides.into_iter().map(at_side);
    one_of(key, given.chain(set.shapes().into_iter().map(inside)))
}
