//! Bodies of a case at the sizes h and 2h of their points, two of each size where a mesh can be made anew.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use ligament_case::case::{CaseFile, MeshSection};
use ligament_case::input_file;
use ligament_case::mesh_file::read_any_mesh;
use ligament_case::point_table::is_table;
use ligament_mesh::{AnyMesh, Faces, Mesh, SolidMesh, gmsh};
use ligament_output::replace_file;

use super::displaced_nodes::with_displaced_nodes;
use super::interval::{FLOOR, FLOOR_OF_SPLIT};
use crate::meshing::MeshingError;
use crate::meshing::cad::quoted_in_gmsh;
use crate::sweep::meshes::{MeshPlan, make};
use crate::sweep::plan::MESHES;
use crate::sweep::toml_text::quoted;

/// Largest relative difference of the spacings of a mesh by Gmsh and of the mesh of the case that count as the same size.
const SAME_SIZE: f64 = 0.1;

/// Range of the ratio of both spacings in which the geometry counts as following the size requested from Gmsh.
const RATIOS: [f64; 2] = [1.6, 2.5];

/// Meshers of Gmsh by the numbers of `Mesh.Algorithm`.
const MESHERS: [(&str, u32); 2] = [("Delaunay", 5), ("frontal", 6)];

/// Source of the meshes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshSource {
    /// Geometry of Gmsh; by default the one beside the mesh of the case with the beginning of its name.
    pub geometry: Option<PathBuf>,
    /// Numbers of the geometry by name. If there are any, h is their size instead of the size of the mesh of the case.
    pub numbers: Vec<(String, f64)>,
    /// Name and value of the number of the geometry for the size h, where the geometry does not follow Gmsh's factor on sizes.
    pub size: Option<(String, f64)>,
    /// Whether cells of the mesh are split although there may be a geometry.
    pub split: bool,
    /// The program gmsh.
    pub gmsh: PathBuf,
}

/// A body at one of the sizes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SizedBody {
    /// Name of the body, such as "h Delaunay".
    pub(super) label: String,
    /// Name of the meshing method.
    pub(super) mesher: &'static str,
    /// Whether the size is h, not 2h.
    pub(super) is_fine: bool,
    /// Settings on the case: keys and values in TOML.
    pub(super) settings: Vec<(String, String)>,
}

/// Bodies of a case at both sizes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SizedBodies {
    /// Bodies of the size h, followed by the bodies of 2h.
    pub(super) bodies: Vec<SizedBody>,
    /// Relative error that no refinement of such bodies removes.
    pub(super) floor: f64,
    /// Origin of the bodies, in words.
    pub(super) origin: String,
    /// Remarks for the user.
    pub(super) notes: Vec<String>,
}

impl SizedBodies {
    /// The bodies with a note that both sizes share one horizon.
    pub(super) fn with_note(mut self, has_fixed_horizon: bool) -> Self {
        if has_fixed_horizon {
            let note = "2h has the horizon of h: the limit is one of more and more bonds a family";
            self.notes.push(note.to_owned());
        }
        self
    }
}

/// Makes the meshes of a case at both sizes in the folder of a study; `print` shows each mesh that is made.
///
/// # Errors
///
/// If no coarser or finer mesh can be made, with the remedy.
pub(super) fn meshes(
    case: &CaseFile,
    source: &MeshSource,
    folder: &Path,
    print: &mut dyn FnMut(&str),
) -> anyhow::Result<SizedBodies> {
    let Some(section) = &case.case.mesh else {
        return Err(case.error("mesh", "the case has no mesh").into());
    };
    if is_table(&section.file) {
        let reason =
            "points of a table have no cells that could be made finer: give a mesh or a lattice";
        return Err(case.error("mesh.file", reason).into());
    }
    let mesh = read_any_mesh(&section.file, section.coordinate_plane());
    let geometry = source.geometry.clone().filter(|_| !source.split);
    let geometry = geometry.or_else(|| found_geometry(&section.file).filter(|_| !source.split));
    match (geometry, mesh) {
        (Some(geometry), mesh) => {
            let mut meshing = Meshing {
                geometry,
                source,
                folder: folder.join(MESHES),
                section,
                dimensions: if case.case.is_solid() { 3.0 } else { 2.0 },
                print,
            };
            meshing.bodies(mesh.ok().as_ref())
        }
        (None, Ok(mesh)) => split(case, section, &mesh, folder),
        (None, Err(error)) => Err(error.into()),
    }
}

/// The geometry beside a mesh, `disk.geo` for `disk-4mm.msh`: the longest name with which the name of the mesh begins.
fn found_geometry(mesh: &Path) -> Option<PathBuf> {
    let folder = mesh.parent().filter(|it| !it.as_os_str().is_empty());
    let entries = std::fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?;
    let name = mesh.file_stem()?.to_string_lossy().into_owned();
    let begins = |path: &PathBuf| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let rest = name.strip_prefix(&*stem);
        path.extension().is_some_and(|it| it == "geo")
            && rest.is_some_and(|it| it.is_empty() || it.starts_with(['-', '_', '.']))
    };
    let paths = entries.flatten().map(|entry| entry.path()).filter(begins);
    paths.max_by_key(|path| (path.as_os_str().len(), path.clone()))
}

/// Meshes of a geometry by Gmsh.
struct Meshing<'a> {
    geometry: PathBuf,
    source: &'a MeshSource,
    folder: PathBuf,
    /// Section of the mesh of the case.
    section: &'a MeshSection,
    /// Number of dimensions of space.
    dimensions: f64,
    print: &'a mut dyn FnMut(&str),
}

/// A mesh that Gmsh made.
struct GmshMesh {
    size: &'static str,
    mesher: &'static str,
    file: PathBuf,
    mesh: AnyMesh,
}

impl Meshing<'_> {
    /// The bodies by two meshers at both sizes; `own` is the mesh of the case, whose size is h.
    fn bodies(&mut self, own: Option<&AnyMesh>) -> anyhow::Result<SizedBodies> {
        let factor = self.factor(own)?;
        let [one, two] = MESHERS;
        let fine = [self.mesh("h", one, factor)?, self.mesh("h", two, factor)?];
        let factor = 2.0 * factor;
        let coarse = [self.mesh("2h", one, factor)?, self.mesh("2h", two, factor)?];
        for (fine, coarse) in fine.iter().zip(&coarse) {
            let ratio = self.spacing(&coarse.mesh) / self.spacing(&fine.mesh);
            if !(RATIOS[0]..=RATIOS[1]).contains(&ratio) {
                anyhow::bail!(
                    "{}: a factor of 2 on all sizes made the spacing of the points {ratio:.2} times as large: lines or surfaces have fixed \
                     numbers of cells. Name the number of the geometry that is the size: `--size NAME=VALUE`",
                    self.geometry.display()
                );
            }
        }
        let mut notes = Vec::new();
        let mut bodies = Vec::new();
        for pair in [fine, coarse] {
            bodies.extend(self.unlike_bodies(pair, &mut notes)?);
        }
        let name = self.geometry.file_name().unwrap_or_default();
        Ok(SizedBodies {
            bodies,
            floor: FLOOR,
            origin: format!("meshes by Gmsh from {}", name.to_string_lossy()),
            notes,
        })
    }

    /// Spacing of the points of a mesh, up to a factor that all meshes of the geometry have.
    fn spacing(&self, mesh: &AnyMesh) -> f64 {
        (mesh.n_nodes() as f64).powf(-1.0 / self.dimensions)
    }

    /// Factor on the sizes of the geometry with which h is the spacing of the mesh of the case, or 1 where the user gives numbers.
    fn factor(&mut self, own: Option<&AnyMesh>) -> anyhow::Result<f64> {
        let Some(own) = own else {
            return Ok(1.0);
        };
        let first = self.mesh("h", MESHERS[0], 1.0)?.mesh;
        // Groups of a geometry that the user names are checked by the runs, which need only some of them.
        if self.source.geometry.is_none() {
            self.require_same_groups(own, &first)?;
        }
        let factor = self.spacing(own) / self.spacing(&first);
        let is_given = !self.source.numbers.is_empty() || self.source.size.is_some();
        Ok(if is_given || (factor - 1.0).abs() <= SAME_SIZE {
            1.0
        } else {
            factor
        })
    }

    /// The bodies of two meshes of one size. Where both meshers make the same mesh the nodes of the second are displaced.
    fn unlike_bodies(
        &self,
        [one, other]: [GmshMesh; 2],
        notes: &mut Vec<String>,
    ) -> anyhow::Result<[SizedBody; 2]> {
        let size = one.size;
        let first = body(size, one.mesher, &one.file);
        let second = match one.mesh == other.mesh {
            true => {
                notes.push(format!(
                    "both meshers make the same mesh at {size}: the inner nodes of the second are displaced"
                ));
                let name = format!("{size}-displaced");
                let file = write_mesh_to(&self.folder, &name, &with_displaced_nodes(&one.mesh, 1))?;
                in_xy(body(size, "displaced", &file), self.section)
            }
            false => body(size, other.mesher, &other.file),
        };
        Ok([first, second])
    }

    /// Makes the mesh of a size and a mesher, unless it is up to date.
    fn mesh(
        &mut self,
        size: &'static str,
        (mesher, algorithm): (&'static str, u32),
        factor: f64,
    ) -> anyhow::Result<GmshMesh> {
        let geometry = std::path::absolute(&self.geometry)?;
        let mut numbers = self.source.numbers.clone();
        let mut options = format!(
            "Merge {};\nMesh.Algorithm = {algorithm};\n",
            quoted_in_gmsh(&geometry)
        );
        match &self.source.size {
            Some((name, value)) => numbers.push((name.clone(), factor * value)),
            None => options += &format!("Mesh.MeshSizeFactor *= {factor:?};\n"),
        }
        let text = input_file::read(&geometry)?;
        let content = format!("{options}{:016x}", twox_hash::XxHash64::oneshot(0, &text));
        let name = format!("{size}-{}", mesher.to_lowercase());
        let file = self.folder.join(format!("{name}.geo"));
        replace_file(&file, options.as_bytes())?;
        let plan = MeshPlan::new(&file, numbers, &self.folder, &name, &content);
        let failed = make(std::iter::once(&plan), &self.source.gmsh, self.print);
        let failed = failed.map_err(|error| match error {
            MeshingError::NoProgram { .. } => {
                anyhow::anyhow!("{error}, or have the cells of the mesh split by `--split`")
            }
            other => other.into(),
        })?;
        if let Some(reason) = failed.into_values().next() {
            anyhow::bail!("{}: {reason}", self.geometry.display());
        }
        let file = plan.request.out;
        Ok(GmshMesh {
            size,
            mesher,
            mesh: read_any_mesh(&file, self.section.coordinate_plane())?,
            file,
        })
    }

    /// Refuses a geometry without the groups of the mesh of the case.
    fn require_same_groups(&self, own: &AnyMesh, made: &AnyMesh) -> anyhow::Result<()> {
        let [own, made] = [own, made].map(|mesh| match mesh {
            AnyMesh::Plane(mesh) => &mesh.groups,
            AnyMesh::Solid(mesh) => &mesh.groups,
        });
        let is_made = |name: &str| made.iter().any(|group| group.name == name);
        match own.iter().find(|group| !is_made(&group.name)) {
            None => Ok(()),
            Some(group) => anyhow::bail!(
                "the mesh of {} has no group `{}`, which the mesh of the case has: name its geometry by `--geometry FILE.geo`, or have its cells \
                 split by `--split`",
                self.geometry.display(),
                group.name
            ),
        }
    }
}

/// The mesh of a case as the size 2h, and its cells split in four, in space in eight, as h, each also with displaced inner nodes.
fn split(
    case: &CaseFile,
    section: &MeshSection,
    coarse: &AnyMesh,
    folder: &Path,
) -> anyhow::Result<SizedBodies> {
    let folder = folder.join(MESHES);
    let (fine, parts) = match coarse {
        AnyMesh::Plane(mesh) => (AnyMesh::Plane(mesh.split_in_four()), "four"),
        AnyMesh::Solid(mesh) => {
            let split = mesh.split_in_eight();
            let refused = |error| {
                let reason = format!("{error}, or name its geometry by `--geometry FILE.geo`");
                case.error("mesh.file", reason)
            };
            (AnyMesh::Solid(split.map_err(refused)?), "eight")
        }
    };
    let made = |size: &str, mesher: &'static str, mesh: &AnyMesh| {
        let file = write_mesh_to(&folder, &format!("{size}-{mesher}"), mesh)?;
        anyhow::Ok(in_xy(body(size, mesher, &file), section))
    };
    let moved = |mesh: &AnyMesh| with_displaced_nodes(mesh, 1);
    let bodies = vec![
        made("h", "split", &fine)?,
        made("h", "displaced", &moved(&fine))?,
        body("2h", "split", &std::path::absolute(&section.file)?),
        made("2h", "displaced", &moved(coarse))?,
    ];
    let mut notes = Vec::new();
    let is_curved = match coarse {
        AnyMesh::Plane(mesh) => has_curved_outline(mesh),
        AnyMesh::Solid(mesh) => has_curved_surface(mesh),
    };
    if is_curved {
        notes.push(
            "the outline seems to be curved, and its corners stay where they are: do not split this mesh again, but name its geometry by \
             `--geometry FILE.geo`"
                .to_owned(),
        );
    }
    Ok(SizedBodies {
        bodies,
        floor: FLOOR_OF_SPLIT,
        origin: format!("the mesh of the case is 2h, and its cells split in {parts} are h"),
        notes,
    })
}

/// Number of turns by [`CURVED`] from which on an outline is taken for a polygon in place of a curve.
const LEAST_TURNS: usize = 8;

/// Angles between neighbouring edges or faces in place of a curved outline, degrees.
const CURVED: Range<f64> = 1.0..40.0;

/// Whether the outline of a planar mesh turns as often as one in place of a curve.
fn has_curved_outline(mesh: &Mesh) -> bool {
    let angles = mesh.angles_at_nodes();
    let mut nodes: Vec<u32> = mesh.outline().into_iter().flatten().collect();
    nodes.sort_unstable();
    nodes.dedup();
    let turn = |node: &u32| (angles[*node as usize].to_degrees() - 180.0).abs();
    nodes
        .iter()
        .filter(|node| CURVED.contains(&turn(node)))
        .count()
        >= LEAST_TURNS
}

/// Whether the surface of a solid turns at as many edges as one in place of a curved surface.
fn has_curved_surface(mesh: &SolidMesh) -> bool {
    let mut normals: BTreeMap<[u32; 2], Vec<[f64; 3]>> = BTreeMap::new();
    for side in Faces::new(&mesh.cells, mesh.positions.len()).outer() {
        let corners = side.face.corners();
        let ends = corners.iter().cycle().skip(1);
        for (&a, &b) in corners.iter().zip(ends) {
            let at_edge = normals.entry([a.min(b), a.max(b)]).or_default();
            at_edge.push(side.face.area_vector(&mesh.positions));
        }
    }
    let turn = |at_edge: &&Vec<[f64; 3]>| {
        let [u, v] = at_edge.as_slice() else {
            return false;
        };
        let dot = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let cosine = dot(u, v) / (dot(u, u) * dot(v, v)).sqrt();
        CURVED.contains(&cosine.clamp(-1.0, 1.0).acos().to_degrees())
    };
    normals.values().filter(turn).count() >= LEAST_TURNS
}

/// Writes a mesh into a folder, and returns its path.
fn write_mesh_to(folder: &Path, name: &str, mesh: &AnyMesh) -> anyhow::Result<PathBuf> {
    let path = std::path::absolute(folder.join(format!("{name}.msh")))?;
    replace_file(&path, gmsh::write_any(mesh).as_bytes())?;
    Ok(path)
}

/// A body with a setting for its mesh in the plane of x and y, if the mesh of the case lies in another plane.
fn in_xy(mut body: SizedBody, section: &MeshSection) -> SizedBody {
    if section.coordinates.is_some() {
        let setting = ("mesh.coordinates".to_owned(), quoted("xy"));
        body.settings.push(setting);
    }
    body
}

/// The body with a given mesh file.
fn body(size: &str, mesher: &'static str, file: &Path) -> SizedBody {
    SizedBody {
        label: format!("{size} {mesher}"),
        mesher,
        is_fine: size == "h",
        settings: vec![("mesh.file".to_owned(), quoted(&file.to_string_lossy()))],
    }
}
