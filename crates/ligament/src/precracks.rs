//! Pre-cracks of a setup as lines and surfaces that cut bonds.

use std::collections::{BTreeMap, BTreeSet};

use ligament_mesh::Cell;
use ligament_model::bonds::precrack::{
    Crack, Ends, PreCrack as Line, SolidPreCrack, count_touched_bonds, cut_bonds,
};
use ligament_model::{BondSet, PointCloud};

use crate::body::{Body, Geometry};
use crate::coordinates::in_dimensions;
use crate::error::{Fault, Field, SetupError};
use crate::setup::{CrackShape, PreCrack, Setup};

/// The setup with lines in the place of the curve groups of a body in the plane along which it has pre-cracks: one for each line of edges that
/// hang together, from its end with the smaller x (then y) on.
///
/// # Errors
///
/// If the body has no group of a name, or the group has no edges.
pub(crate) fn with_lines_of_groups(setup: Setup) -> Result<Setup, SetupError> {
    let body = setup.body.as_body();
    if setup.dimensions() != 2 || setup.precracks.iter().all(|it| !it.is_along_group()) {
        return Ok(setup);
    }
    let mut precracks = Vec::new();
    for (index, crack) in setup.precracks.iter().enumerate() {
        let CrackShape::Group(group) = &crack.shape else {
            precracks.push(crack.clone());
            continue;
        };
        let field = Field::element("precracks", index).part("surface");
        if body.points_of(group).is_none() {
            return Err(field.error(Fault::UnknownName {
                what: body.group_kind(),
                found: group.clone(),
                candidates: body.group_names(),
            }));
        }
        let edges = body.curve_of(group);
        if edges.is_empty() {
            let reason =
                "a pre-crack runs along a physical curve of the mesh: this group has no edges";
            return Err(field.error(Fault::Contradiction(reason.into())));
        }
        let position = |node: u32| in_dimensions(&body.position(node));
        precracks.extend(polylines(&edges).into_iter().map(|nodes| {
            let mut line: Vec<[f64; 2]> = nodes.into_iter().map(position).collect();
            // Points on the line lie left of it: the order of the nodes in the file does not decide about them.
            if line.last() < line.first() {
                line.reverse();
            }
            PreCrack {
                shape: CrackShape::Line(line),
                ends: crack.ends,
            }
        }));
    }
    Ok(Setup { precracks, ..setup })
}

/// Nodes along the lines that edges form, each edge once: from the lowest node with an odd number of edges on, or of a closed line from its
/// lowest node, and at each node on to the lowest neighbour.
fn polylines(edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut neighbours: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
    for &[a, b] in edges {
        neighbours.entry(a).or_default().insert(b);
        neighbours.entry(b).or_default().insert(a);
    }
    let mut lines = Vec::new();
    while let Some(start) = (neighbours.iter().find(|(_, others)| others.len() % 2 == 1))
        .or_else(|| neighbours.iter().find(|(_, others)| !others.is_empty()))
        .map(|(&node, _)| node)
    {
        let mut line = vec![start];
        let mut node = start;
        while let Some(next) = neighbours.get_mut(&node).and_then(BTreeSet::pop_first) {
            if let Some(others) = neighbours.get_mut(&next) {
                others.remove(&node);
            }
            line.push(next);
            node = next;
        }
        lines.push(line);
    }
    lines
}

/// The lines or surfaces that cut bonds of a body.
///
/// # Errors
///
/// If a surface is degenerate, or the body has no group of its name.
pub(crate) fn cracks<const D: usize>(
    body: &dyn Geometry<D>,
    precracks: &[PreCrack],
) -> Result<Vec<Crack>, SetupError> {
    let numbered = precracks.iter().enumerate();
    let crack = |(index, crack): (usize, &PreCrack)| {
        let field = Field::element("precracks", index);
        let surface = match &crack.shape {
            CrackShape::Line(points) => {
                return Ok(Crack::Line(Line {
                    points: points.clone(),
                    ends: crack.ends,
                }));
            }
            CrackShape::Disk {
                centre,
                normal,
                radius,
            } => SolidPreCrack::disk(*centre, *normal, *radius),
            CrackShape::Polygon(corners) => SolidPreCrack::polygon(corners),
            CrackShape::Triangles { points, triangles } => {
                SolidPreCrack::triangles(points, triangles)
            }
            CrackShape::Group(group) => {
                let triangles = triangles_of_group(field, body, group)?;
                SolidPreCrack::triangles(&ligament_model::raised(&body.positions()), &triangles)
            }
        };
        let surface = surface.map_err(|unfit| {
            let reason = Fault::Contradiction(unfit.to_string().into());
            field.part("surface").error(reason)
        })?;
        Ok(Crack::Surface(match crack.ends {
            Ends::Excluded => surface,
            Ends::Included => surface.with_rim(),
        }))
    };
    numbered.map(crack).collect()
}

/// The faces of a surface group as triangles, with quadrangles split along a diagonal.
fn triangles_of_group(
    field: Field,
    body: &dyn Body,
    group: &str,
) -> Result<Vec<[u32; 3]>, SetupError> {
    let Some(faces) = body.faces_of(group) else {
        let reason = "only meshes have groups of faces: give a polygon or a disk";
        return Err(field
            .part("surface")
            .error(Fault::Contradiction(reason.into())));
    };
    if body.points_of(group).is_none() {
        return Err(field.part("surface").error(Fault::UnknownName {
            what: body.group_kind(),
            found: group.to_owned(),
            candidates: body.group_names(),
        }));
    }
    let triangles: Vec<[u32; 3]> = faces.iter().flat_map(Cell::triangles).collect();
    if triangles.is_empty() {
        let reason =
            "a pre-crack of a solid has the faces of a physical surface: this group has none";
        let fault = Fault::Contradiction(reason.into());
        return Err(field.part("surface").error(fault));
    }
    Ok(triangles)
}

/// Effect of the pre-cracks of a body on its bonds.
pub(crate) struct Precracked {
    /// Whether a pre-crack cuts each bond, shape (n_bonds).
    pub(crate) is_cut: Vec<bool>,
    /// Number of bonds along the outline that only touch an end of a pre-crack.
    pub(crate) touched: usize,
    /// Indices of the pre-cracks that cut no bond.
    pub(crate) idle: Vec<usize>,
    /// Share of each point's bonds that pre-cracks cut, shape (n_points).
    pub(crate) share: Vec<f64>,
}

impl Precracked {
    pub(crate) fn new<const D: usize>(
        cracks: &[Crack],
        bonds: &BondSet<D>,
        cloud: &PointCloud<D>,
        is_on_outline: &[bool],
    ) -> Self {
        let is_cut = cut_bonds(cracks, &bonds.ends, cloud);
        let count = |is_cut: &[bool]| {
            cloud
                .subdomain
                .count(is_cut.iter().filter(|it| **it).count())
        };
        let is_idle = |index: &usize| match cracks {
            [_] => count(&is_cut) == 0,
            _ => count(&cut_bonds(&cracks[*index..=*index], &bonds.ends, cloud)) == 0,
        };
        Self {
            idle: (0..cracks.len()).filter(is_idle).collect(),
            touched: count_touched_bonds(cracks, bonds, cloud, &is_cut, is_on_outline),
            share: share(cloud, bonds, &is_cut),
            is_cut,
        }
    }
}

/// Share of the bonds of each point that pre-cracks cut, by number, shape (n_points).
fn share<const D: usize>(cloud: &PointCloud<D>, bonds: &BondSet<D>, is_cut: &[bool]) -> Vec<f64> {
    let n_cut = is_cut.iter().filter(|is_cut| **is_cut).count();
    if cloud.subdomain.count(n_cut) == 0 {
        return vec![0.0; cloud.len()];
    }
    let shares = cloud.over_families(|point| {
        let family = bonds.incidence.at(point);
        let cut = family.iter().filter(|bond| is_cut[**bond as usize]).count();
        [cut as f64 / family.len().max(1) as f64]
    });
    shares.into_iter().map(|[share]| share).collect()
}
