//! Whether points and bonds in space are fit for a computation.

use ligament_model::element::Rigidities;
use ligament_model::space::SolidSystem;
use ligament_model::{BondSet, Horizons, PointCloud};

use crate::body::{Body, Origin};
use crate::error::{Fault, Field, SetupError, Torn};
use crate::setup::{Horizon, Setup};
use crate::soundness::{DISTINCT, Parts, require_neighbours, require_rigidities};

/// Refuses points that nearly coincide, measured by the side of the cube of their volume.
pub(super) fn require_distinct(
    body: &dyn Body<3>,
    cloud: &PointCloud<3>,
) -> Result<(), SetupError> {
    let size = |point: usize| cloud.volumes[point].cbrt();
    let is_near = |&point: &usize| cloud.spacing[point] < DISTINCT * size(point);
    let Some(point) = (0..cloud.len()).find(is_near) else {
        return Ok(());
    };
    let from = cloud.positions[point];
    let squared = |other: &usize| {
        let to = cloud.positions[*other];
        (0..3)
            .map(|axis| (to[axis] - from[axis]).powi(2))
            .sum::<f64>()
    };
    let others = (0..cloud.len()).filter(|other| *other != point);
    let other = others.min_by(|one, other| squared(one).total_cmp(&squared(other)));
    let other = other.unwrap_or(point);
    Err(Field::whole("body").error(Fault::NearPoints {
        places: [point, other].map(|it| body.place(it as u32)),
        distance: squared(&other).sqrt(),
        size: size(point),
    }))
}

/// Refuses bonds that leave points alone, or a body of cells in more parts than it has: edges of its cells are longer than the horizons.
pub(super) fn require_connected(
    setup: &Setup<3>,
    cloud: &PointCloud<3>,
    horizons: &Horizons,
    bonds: &BondSet<3>,
) -> Result<(), SetupError> {
    let body = &*setup.body;
    require_neighbours(body, bonds)?;
    let Origin::SolidMesh(mesh) = body.origin() else {
        return Ok(());
    };
    let parts = Parts::new(cloud.len(), bonds.ends.iter().copied());
    let of_mesh = || Parts::new(cloud.len(), mesh.cells.iter().flat_map(|it| it.edges()));
    if parts.count() == 1 {
        return Ok(());
    }
    let along = |[from, to]: [u32; 2]| -> [f64; 3] {
        let [from, to] = [from, to].map(|it| cloud.positions[it as usize]);
        std::array::from_fn(|axis| (to[axis] - from[axis]).abs())
    };
    let length = |ends: [u32; 2]| along(ends).iter().map(|it| it * it).sum::<f64>().sqrt();
    let radius =
        |[from, to]: [u32; 2]| horizons.radius[from as usize].max(horizons.radius[to as usize]);
    let excess = |ends: &[u32; 2]| length(*ends) / radius(*ends);
    let edges = mesh.cells.iter().flat_map(|cell| cell.edges());
    let torn =
        edges.filter(|ends| parts.part(ends[0]) != parts.part(ends[1]) && excess(ends) > 1.0);
    let Some(worst) = torn.max_by(|one, other| excess(one).total_cmp(&excess(other))) else {
        return Ok(());
    };
    let torn = Torn {
        parts: parts.count(),
        of_body: of_mesh().count(),
        places: worst.map(|it| body.place(it)),
        along: along(worst).map(|it| it / length(worst)).to_vec(),
        length: length(worst),
        horizon: radius(worst),
        remedy: match setup.horizon {
            Horizon::Factor(factor) => {
                format!("a horizon factor above {:.2}", factor * excess(&worst))
            }
            Horizon::Length(length) => {
                format!("a horizon above {:.4e} m", length * excess(&worst))
            }
        },
    };
    Err(Field::whole("horizon").error(Fault::Torn(Box::new(torn))))
}

/// Refuses bonds whose stiffness is no number that equations can be made of.
pub(super) fn require_numbers(body: &dyn Body<3>, system: &SolidSystem) -> Result<(), SetupError> {
    let rigidities: &Rigidities = &system.rigidities;
    require_rigidities(body, rigidities, &system.bonds.ends)
}
