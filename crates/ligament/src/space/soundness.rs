//! Whether points and bonds in space are fit for a computation.

use ligament_mesh::MeshCell;
use ligament_model::bonds::outline::{Outline, SolidOutline};
use ligament_model::{BondSet, Horizons, PointCloud};

use crate::body::{Body, Origin};
use crate::error::{Fault, Field, SetupError, Torn};
use crate::setup::{Horizon, Setup};
use crate::soundness::{DISTINCT, Parts, require_neighbours};

/// Refuses cells that lie in others.
pub(super) fn forbid_overlap(body: &dyn Body<3>, outline: &SolidOutline) -> Result<(), SetupError> {
    let Some([from, to]) = outline.first_crossing() else {
        return Ok(());
    };
    Err(Field::whole("body").error(Fault::Overlap {
        from: body.place(from),
        to: body.place(to),
    }))
}

/// Refuses points that nearly coincide, measured by the side of the cube of their volume.
pub(super) fn require_distinct(
    body: &dyn Body<3>,
    cloud: &PointCloud<3>,
) -> Result<(), SetupError> {
    let size = |point: usize| cloud.volumes[point].cbrt();
    let is_near = |&point: &usize| cloud.spacing[point] < DISTINCT * size(point);
    let mut in_file = (0..cloud.len() as u32).map(|it| cloud.numbering.point(it) as usize);
    let Some(point) = in_file.find(is_near) else {
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
    require_neighbours(body, cloud, bonds)?;
    let Origin::SolidMesh(mesh) = body.origin() else {
        return Ok(());
    };
    let parts = Parts::of_bonds(cloud, bonds);
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

#[cfg(test)]
mod tests {
    use ligament_mesh::{SolidCell, SolidMesh};
    use ligament_model::Material;

    use super::*;
    use crate::body::SolidMeshBody;
    use crate::setup::Law;

    /// Two bricks of different heights on each other.
    fn tower(z: [f64; 3], factor: f64) -> (Setup<3>, PointCloud<3>) {
        let layer = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
        let mesh = SolidMesh {
            node_tags: (1..=12).collect(),
            positions: z.map(layer).concat(),
            cells: vec![
                SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]),
                SolidCell::Hexahedron([4, 5, 6, 7, 8, 9, 10, 11]),
            ],
            ..SolidMesh::default()
        };
        let body = SolidMeshBody::from(mesh);
        let cloud = body.cloud(1.0, &[0, 0], 1);
        let material = Material::isotropic(1e9, 0.2);
        let mut setup = Setup::new(body, material, Law::Nhpd);
        setup.horizon = Horizon::Factor(factor);
        (setup, cloud)
    }

    #[test]
    fn long_edges_tear_a_body() {
        let fault_at = |factor: f64| {
            let (setup, cloud) = tower([0.0, 1.0, 4.0], factor);
            let horizons = setup.horizon.of_points(&cloud);
            let bonds = BondSet::search(&cloud, &horizons);
            require_connected(&setup, &cloud, &horizons, &bonds)
        };
        let Fault::Torn(found) = *fault_at(1.5).unwrap_err().fault else {
            panic!("another fault");
        };
        assert_eq!((found.parts, found.of_body), (2, 1));
        assert_eq!((found.length, found.horizon), (3.0, 1.5));
        assert_eq!(fault_at(3.0), Ok(()));
    }

    #[test]
    fn nearly_coincident_points_are_found() {
        let fault_at = |z: f64| {
            let (setup, cloud) = tower([0.0, 1.0, z], 3.0);
            require_distinct(&*setup.body, &cloud)
        };
        let error = fault_at(1.0 + 2e-6).unwrap_err();
        let Fault::NearPoints {
            places,
            distance,
            size,
        } = *error.fault
        else {
            panic!("another fault");
        };
        assert!(places[0].starts_with("node 5 ") && places[1].starts_with("node 9 "));
        // The height is a difference of numbers near 1, the size that of half a brick for each of two cells.
        assert!((distance - 2e-6).abs() < 1e-15 && (size - 0.5).abs() < 1e-5);
        assert_eq!(fault_at(1.01), Ok(()));
    }

    /// Two bricks without a common node; the second begins at this height, and beside the first in x and y.
    #[test]
    fn bricks_in_each_other_are_found() {
        let fault_at = |z: f64| {
            let brick = |[x, y, z]: [f64; 3]| {
                let corner = |right: f64, back: f64, up: f64| [x + right, y + back, z + up];
                let layer = |up: f64| {
                    [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(a, b)| corner(a, b, up))
                };
                [layer(0.0), layer(1.0)].concat()
            };
            let mesh = SolidMesh {
                node_tags: (1..=16).collect(),
                positions: [brick([0.0; 3]), brick([0.5, 0.3, z])].concat(),
                cells: vec![
                    SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]),
                    SolidCell::Hexahedron([8, 9, 10, 11, 12, 13, 14, 15]),
                ],
                ..SolidMesh::default()
            };
            let cloud = PointCloud::from_mesh(&mesh, 1.0, &[0, 0], 1);
            let outline = SolidOutline::of_cells(&mesh.cells, &cloud);
            forbid_overlap(&SolidMeshBody::from(mesh), &outline)
        };
        let fault = *fault_at(0.4).unwrap_err().fault;
        assert!(matches!(fault, Fault::Overlap { .. }), "{fault}");
        assert_eq!(fault_at(1.1), Ok(()));
    }
}
