//! The body of a pass of refinement: a mesh whose cells are as fine as the distance from the places of a crack demands.

use ligament_mesh::{AnyMesh, Bisectable, Bisection, Mesh, gmsh};
use ligament_model::parallel;
use rstar::{Point, PointDistance, RTree};

use crate::body::{AnyBody, Origin};
use crate::coordinates::narrowed;
use crate::error::{Fault, Field, SetupError};
use crate::setup::{FinePlace, Fineness, Horizon, MaterialRegion, Refine, Setup};

/// The body of a pass of refinement.
#[derive(Debug, Clone)]
pub struct RefinedBody {
    /// The body before all refinement.
    pub(crate) original: AnyBody,
    /// The refined mesh; none in the first pass.
    pub(crate) graded: Option<Graded>,
}

/// A refined mesh.
#[derive(Debug, Clone)]
pub(crate) struct Graded {
    /// The mesh, with the nodes of the original one first.
    pub(crate) mesh: AnyMesh,
    /// Largest horizon of the nodes whose cells are all as fine as the pass makes them, m.
    pub(crate) fine_horizon: f64,
    /// Median size of the finest cells, m.
    pub(crate) size: f64,
    /// Number of times that edges at the places are halved in the end.
    pub(crate) levels: u32,
}

impl RefinedBody {
    /// The body of the present pass of a setup's refinement.
    ///
    /// # Errors
    ///
    /// If the body has no mesh of cells that can be bisected.
    pub(crate) fn new(setup: &Setup, refine: &Refine) -> Result<Self, SetupError> {
        let graded = (refine.pass > 1).then(|| graded(&setup.body, refine, factor(setup)));
        Ok(Self {
            original: setup.body.clone(),
            graded: graded.transpose()?,
        })
    }

    /// The refined body; none in the first pass.
    pub(crate) fn body(&self) -> Option<AnyBody> {
        let graded = self.graded.as_ref()?;
        Some(graded.mesh.clone().into())
    }

    /// Text of a Gmsh file of the refined mesh; none in the first pass.
    pub fn gmsh_text(&self) -> Option<String> {
        Some(gmsh::write_any(&self.graded.as_ref()?.mesh))
    }

    /// Horizon that the finest points have in the end, m, by the size that the refinement asks for.
    pub(crate) fn final_horizon(&self, setup: &Setup, refine: &Refine) -> f64 {
        let size = match refine.fineness {
            Fineness::Size(size) => size,
            Fineness::Levels(levels) => median_size(&self.original) / f64::from(levels).exp2(),
        };
        factor(setup) * size
    }

    /// Largest horizon of the points of the fine part, m; 0 in the first pass, which has none.
    pub fn fine_horizon(&self) -> f64 {
        self.graded.as_ref().map_or(0.0, |it| it.fine_horizon)
    }
}

impl Setup {
    /// Whether bonds soften over a zone of a crack that is shorter than two horizons (m): l_ch = E G_c/F_t^2 < 2 H of one of the materials.
    /// The peak then falls from size to size, so that two passes of one size say nothing.
    pub(crate) fn has_short_crack_zone(&self, horizon: f64) -> bool {
        let softens = self.criteria.iter().any(|it| it.after.softens);
        let mut materials = self.materials.iter();
        let length = |it: &MaterialRegion| self.characteristic_length(&it.material);
        softens && materials.any(|it| length(it).is_some_and(|it| horizon > 0.5 * it))
    }
}

/// Horizon of a point over the distance to its nearest neighbour; [`Setup::check`] refuses one horizon for all points.
pub(crate) fn factor(setup: &Setup) -> f64 {
    match setup.horizon {
        Horizon::Factor(factor) => factor,
        Horizon::Length(_) => 1.0,
    }
}

/// The mesh of a body for a pass, whose points have horizons of a `factor` times their distance to the nearest neighbour: bisected until the horizon
/// of no point beyond the fine part reaches a place, spacing(d) <= max(h, d/lambda) at the distance d from the places.
///
/// # Errors
///
/// If the body is no mesh of cells that can be bisected.
pub(crate) fn graded(body: &AnyBody, refine: &Refine, factor: f64) -> Result<Graded, SetupError> {
    let graded = match body.origin() {
        Origin::Mesh(mesh) => of_mesh(mesh, refine, factor, AnyMesh::Plane),
        Origin::SolidMesh(mesh) => of_mesh(mesh, refine, factor, AnyMesh::Solid),
        Origin::Lattice(_) | Origin::SolidLattice(_) | Origin::Points => {
            Err("only the cells of a mesh can be bisected".to_owned())
        }
    };
    graded.map_err(|reason| Field::whole("body").error(Fault::Contradiction(reason.into())))
}

/// Median size of the cells of a body with a mesh, m; 0 of another body.
pub(crate) fn median_size(body: &AnyBody) -> f64 {
    match body.origin() {
        Origin::Mesh(mesh) => median(sizes(mesh)),
        Origin::SolidMesh(mesh) => median(sizes(mesh)),
        Origin::Lattice(_) | Origin::SolidLattice(_) | Origin::Points => 0.0,
    }
}

/// Sizes of the cells of a mesh, m: the edges of equilateral triangles, or of regular tetrahedra, of their areas or volumes.
fn sizes<const D: usize, C: Bisectable<D>>(mesh: &Mesh<D, C>) -> Vec<f64> {
    let cells = mesh.cells.iter().map(|it| it.size(&mesh.positions));
    cells.map(edge_of_regular::<D>).collect()
}

/// Edge of an equilateral triangle with an area, or of a regular tetrahedron with a volume, m.
fn edge_of_regular<const D: usize>(size: f64) -> f64 {
    match D {
        2 => (4.0 * size / 3.0_f64.sqrt()).sqrt(),
        _ => (6.0 * 2.0_f64.sqrt() * size).cbrt(),
    }
}

/// The lower median of some numbers; 0 without any.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let middle = values.len().saturating_sub(1) / 2;
    values.get(middle).copied().unwrap_or(0.0)
}

fn of_mesh<const D: usize, C: Bisectable<D>>(
    mesh: &Mesh<D, C>,
    refine: &Refine,
    factor: f64,
    any: fn(Mesh<D, C>) -> AnyMesh,
) -> Result<Graded, String>
where
    [f64; D]: Point<Scalar = f64>,
{
    let sizes = sizes(mesh);
    let levels: Vec<u32> = sizes.iter().map(|it| levels(refine, *it)).collect();
    let mut grading = Grading {
        bisection: Bisection::new(mesh).map_err(|it| it.to_string())?,
        allowed: levels
            .iter()
            .map(|it| D as u32 * (*it).min(refine.pass - 1))
            .collect(),
        places: tree(&refine.places),
        distances: Vec::new(),
        factor,
    };
    let at_places = grading.too_coarse(|_| true);
    let at_places = levels.iter().zip(&at_places).filter(|it| *it.1);
    let levels = at_places.map(|it| *it.0).max().unwrap_or(0);
    loop {
        let marked = grading.too_coarse(|(generation, allowed)| generation < allowed);
        if !marked.contains(&true) {
            break;
        }
        grading.bisection.bisect(&marked);
    }
    let (spacings, is_coarse) = grading.spacings();
    let fine = spacings.iter().zip(&is_coarse).filter(|it| !it.1);
    let largest = fine.map(|it| *it.0).fold(0.0, f64::max);
    let finest = grading.sizes_of_finest(&sizes);
    Ok(Graded {
        fine_horizon: factor * largest,
        size: median(finest),
        levels,
        mesh: any(grading.bisection.mesh()),
    })
}

/// Number of times that the edges of a cell of a size (m) are halved at the places, the next whole number to what the fineness asks for.
fn levels(refine: &Refine, size: f64) -> u32 {
    match refine.fineness {
        Fineness::Levels(levels) => levels,
        Fineness::Size(finest) => (size / finest).log2().round().max(0.0) as u32,
    }
}

/// A search tree of the places.
fn tree<const D: usize>(places: &[FinePlace]) -> RTree<[f64; D]>
where
    [f64; D]: Point<Scalar = f64>,
{
    RTree::bulk_load(places.iter().map(|it| narrowed(it.position)).collect())
}

/// A mesh that is being bisected.
struct Grading<const D: usize, C: Bisectable<D>>
where
    [f64; D]: Point<Scalar = f64>,
{
    bisection: Bisection<D, C>,
    /// Number of bisections of each original cell at the places in this pass, shape (n_original_cells).
    allowed: Vec<u32>,
    places: RTree<[f64; D]>,
    /// Distance of each node to the nearest place, shape (n_nodes), m; infinite without places.
    distances: Vec<f64>,
    /// Horizon over the distance to the nearest neighbour.
    factor: f64,
}

impl<const D: usize, C: Bisectable<D>> Grading<D, C>
where
    [f64; D]: Point<Scalar = f64>,
{
    /// Whether each cell is chosen by its generation and the one of this pass at the places, and has a node beyond the fine part with a place within its
    /// horizon, shape (n_cells).
    fn too_coarse(&mut self, is_chosen: impl Fn((u32, u32)) -> bool) -> Vec<bool> {
        let known = self.distances.len();
        let new = &self.bisection.positions()[known..];
        let distances = parallel::values(new.len(), 0.0, |node| {
            let nearest = self.places.nearest_neighbor(new[node]);
            nearest.map_or(f64::INFINITY, |it| it.distance_2(&new[node]).sqrt())
        });
        self.distances.extend(distances);
        let (spacings, is_coarse) = self.spacings();
        let reaches = |node: usize| self.factor * spacings[node] > self.distances[node];
        let is_marked = |(number, cell): (u32, C)| {
            let generations = (self.bisection.generation(number), self.allowed_of(number));
            let mut corners = cell.corners().iter().map(|it| *it as usize);
            is_chosen(generations) && corners.any(|it| is_coarse[it] && reaches(it))
        };
        (0..).zip(self.bisection.cells()).map(is_marked).collect()
    }

    /// Length of the shortest edge at each node (m), and whether a cell at the node is coarser than this pass makes it at the places, shape (n_nodes)
    /// each.
    fn spacings(&self) -> (Vec<f64>, Vec<bool>) {
        let positions = self.bisection.positions();
        let mut spacings = vec![f64::INFINITY; positions.len()];
        let mut is_coarse = vec![false; positions.len()];
        for (number, cell) in (0..).zip(self.bisection.cells()) {
            for edge in cell.edges() {
                let [a, b] = edge.map(|it| it as usize);
                let length = positions[a].distance_2(&positions[b]).sqrt();
                for node in [a, b] {
                    spacings[node] = spacings[node].min(length);
                }
            }
            if self.bisection.generation(number) < self.allowed_of(number) {
                for &corner in cell.corners() {
                    is_coarse[corner as usize] = true;
                }
            }
        }
        (spacings, is_coarse)
    }

    fn allowed_of(&self, cell: u32) -> u32 {
        self.allowed[self.bisection.root(cell) as usize]
    }

    /// Sizes of the cells that are as fine as this pass makes them and were bisected, from the sizes of the original cells, m.
    fn sizes_of_finest(&self, original: &[f64]) -> Vec<f64> {
        let numbers = 0..self.bisection.cells().len() as u32;
        let finest = numbers.filter(|&it| {
            let allowed = self.allowed_of(it);
            allowed > 0 && self.bisection.generation(it) >= allowed
        });
        let size = |cell: u32| {
            let halvings = f64::from(self.bisection.generation(cell)) / D as f64;
            original[self.bisection.root(cell) as usize] / halvings.exp2()
        };
        finest.map(size).collect()
    }
}
