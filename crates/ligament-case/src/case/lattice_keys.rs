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

/// What a section says of a lattice in D dimensions.
pub(crate) struct Grid<const D: usize, S> {
    /// Key of the section.
    pub(crate) section: &'static str,
    /// Text for the axes: "x and y".
    pub(crate) axes: &'static str,
    /// Number of cells along the axes.
    pub(crate) cells: [u32; D],
    /// Sides of the cells, m.
    pub(crate) spacing: [f64; D],
    /// Corner with the lowest coordinates, m.
    pub(crate) corner: [f64; D],
    /// Thickness of a body in the plane, m; 1 for a solid.
    pub(crate) thickness: f64,
    /// Holes, each with the name of the group of the cells at its rim.
    pub(crate) holes: Vec<(Option<String>, Shapes<S>)>,
    /// Sets of cells by their names.
    pub(crate) sets: BTreeMap<String, (Sides<D>, Shapes<S>)>,
}

/// Shapes by their keys; a section gives one at most.
pub(crate) type Shapes<S> = Vec<(&'static str, Option<S>)>;

/// Numbers of layers at the sides of a lattice, by their keys, with the outward normals of the sides.
pub(crate) type Sides<const D: usize> = Vec<(&'static str, Option<u32>, [i8; D])>;

/// The body of a section.
///
/// # Errors
///
/// If a key is out of range, or no cell remains of the lattice, of a set or of the rim of a hole.
pub(crate) fn body<const D: usize, S: LatticeShape<D>>(
    grid: Grid<D, S>,
) -> Result<BodyOnLattice<D, S>, KeyFault> {
    let section = KeyPath::default().child(grid.section);
    let (cells, spacing, corner) = (grid.cells, grid.spacing, grid.corner);
    let (holes, sets) = parts(grid, &section)?;
    let body = BodyOnLattice::new(cells, spacing, corner, &holes, &sets);
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
pub(crate) fn stand_in<const D: usize, S: LatticeShape<D>>(
    grid: Grid<D, S>,
) -> Result<BodyOnLattice<D, S>, KeyFault> {
    let section = KeyPath::default().child(grid.section);
    let (spacing, corner) = (grid.spacing, grid.corner);
    parts(grid, &section)?;
    let cell = BodyOnLattice::new([1; D], spacing, corner, &[], &BTreeMap::new());
    cell.map_err(|error| KeyFault::new(section, error.to_string()))
}

/// Holes and sets of a lattice.
type Parts<const D: usize, S> = (Vec<Hole<S>>, BTreeMap<String, Cells<D, S>>);

fn parts<const D: usize, S: LatticeShape<D>>(
    grid: Grid<D, S>,
    section: &KeyPath,
) -> Result<Parts<D, S>, KeyFault> {
    check_size(&grid, section)?;
    let holes = grid.holes.into_iter().enumerate();
    let holes = holes.map(|(index, (name, shapes))| {
        let key = section.child("remove").child(index);
        if let Some(name) = &name {
            require_column_name(|| key.child("name"), name)?;
            if grid.sets.contains_key(name) {
                let reason = format!("`{section}.set` has a `{name}` as well: rename one of them");
                return Err(KeyFault::new(key.child("name"), reason));
            }
        }
        let shape = one_of(&key, shapes)?;
        Ok(Hole { name, shape })
    });
    let holes = holes.collect::<Result<_, _>>()?;
    let sets = grid.sets.into_iter().map(|(name, (sides, shapes))| {
        let cells = cells_of(
            sides,
            shapes,
            &section.child("set").child(&name),
            grid.cells,
        )?;
        Ok((name, cells))
    });
    Ok((holes, sets.collect::<Result<_, _>>()?))
}

fn check_size<const D: usize, S>(grid: &Grid<D, S>, section: &KeyPath) -> Result<(), KeyFault> {
    let (cells, spacing, corner) = (grid.cells, grid.spacing, grid.corner);
    let along = cells.iter().map(|&it| u64::from(it));
    let n_cells = along.fold(1_u64, u64::saturating_mul);
    require(
        (1..=MOST_CELLS).contains(&n_cells),
        || section.child("cells"),
        &format!(
            "at least 1 along {}, and {MOST_CELLS} together at most",
            grid.axes
        ),
        cells,
    )?;
    let volume = spacing.iter().product::<f64>() * grid.thickness;
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
    sides: Sides<D>,
    shapes: Shapes<S>,
    key: &KeyPath,
    size: [u32; D],
) -> Result<Cells<D, S>, KeyFault> {
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
    one_of(key, given.chain(shapes.into_iter().map(inside)))
}
