//! Maps of intact bodies of MBB-PD (Figs 9 to 11): plates in tension, in shear and heated, and a thick cylinder.

use anyhow::Context;
use ligament_model::material::{Elasticity, Isotropic};
use ligament_plot::picture::maps::{MappedBody, Maps};

use super::Motion;
use super::drawing::maps_of_component;
use crate::case_run::CaseRun;
use crate::experiment_file::ExperimentFile;
use crate::finite_elements::{Body, Degree, Mesh};
use crate::ring::{Ring, radial};

const YOUNG: f64 = 65.8e9;

const THICKNESS: f64 = 1e-3;

/// Spacing of the plates' points, and side of the elements, m.
const SPACING: f64 = 1e-3;

/// Numbers of elements along x and y: the upper and lower edges lie on the outermost rows of points.
const ELEMENTS: [usize; 2] = [100, 99];

/// Free strain of the heated plates: 23e-6/K times 50 K.
const FREE_STRAIN: f64 = 23e-6 * 50.0;

/// Prescribed displacements of the nodes of elements, shape (n_nodes, 2), m.
type PrescribedDisplacements = Vec<[Option<f64>; 2]>;

/// All maps of intact bodies.
pub(super) fn maps() -> anyhow::Result<Vec<Maps>> {
    let mut maps = Vec::new();
    for (axis, name, case) in [
        (1, "y", "mbb-plate/tension"),
        (0, "x", "mbb-plate/tension-x"),
    ] {
        let motions = compared_motions(plate_in_tension(axis)?, case, 0.2)?;
        let title = format!("Plate in tension along {name}, nu = 0.2");
        let file = format!("mbb-figure-9-tension-{name}");
        maps.push(maps_of_component(file, &title, &motions, axis));
    }
    let motions = compared_motions(plate_in_shear()?, "mbb-plate/shear", 0.3)?;
    let file = "mbb-figure-9-shear".to_owned();
    maps.push(maps_of_component(
        file,
        "Sheared plate, nu = 0.3",
        &motions,
        0,
    ));
    for (edges, case, title) in [
        (2, "thermal-plates/case", "Heated plate, two edges clamped"),
        (
            3,
            "thermal-plates/three-edges",
            "Heated plate, three edges clamped",
        ),
    ] {
        let motions = compared_motions(heated_plate(edges)?, case, 0.4)?;
        for axis in [1, 0] {
            let file = format!("mbb-figure-10-{edges}-edges");
            maps.push(maps_of_component(file, title, &motions, axis));
        }
    }
    maps.push(cylinder()?);
    Ok(maps)
}

/// The motions of finite elements and of the lattice of a case.
fn compared_motions(
    elements: Motion,
    case: &str,
    ratio: f64,
) -> anyhow::Result<[(String, Motion); 2]> {
    let case_run =
        CaseRun::from_file(&format!("cases/{case}.toml"))?.set("material.poisson", ratio);
    let solution = case_run.solve()?;
    let lattice = Motion::from_lattice(
        &**solution.model.plane(),
        &solution.outcome.state.displacement,
    )?;
    Ok([
        ("finite elements".to_owned(), elements),
        ("MBB-PD".to_owned(), lattice),
    ])
}

fn plate(ratio: f64) -> Body {
    let elasticity = Elasticity::Isotropic(Isotropic {
        young: YOUNG,
        poisson: ratio,
    });
    let mesh = Mesh::rectangle(Degree::Linear, ELEMENTS, SPACING);
    Body::new(mesh, &elasticity, THICKNESS)
}

/// Half of the elements' extent along x and y, m.
fn half_extent() -> [f64; 2] {
    ELEMENTS.map(|cells| 0.5 * SPACING * cells as f64)
}

fn plate_solution(
    body: Body,
    prescribed: &PrescribedDisplacements,
    forces: &[[f64; 2]],
) -> anyhow::Result<Motion> {
    let displacements = body.displacements(prescribed, forces)?;
    Ok(Motion::from_elements(body.mesh, displacements))
}

/// The plate under 200 MPa on both ends, as a body force on the outermost elements; the middle is fixed.
fn plate_in_tension(axis: usize) -> anyhow::Result<Motion> {
    let body = plate(0.2);
    let outermost = half_extent()[axis] - SPACING;
    let forces = body.volume_forces(|centre| {
        let mut force = [0.0; 2];
        if centre[axis].abs() > outermost {
            force[axis] = 200e6 / SPACING * centre[axis].signum();
        }
        force
    });
    let mut prescribed = vec![[None; 2]; body.mesh.nodes.len()];
    prescribed[body.mesh.nearest_node([0.0, 0.0])] = [Some(0.0); 2];
    prescribed[body.mesh.nearest_node([0.0, half_extent()[1]])][0] = Some(0.0);
    Ok(plate_solution(body, &prescribed, &forces)?.without_rigid_motion())
}

/// The plate with the upper edge moved along x by 1 mm, and the lower edge fixed.
fn plate_in_shear() -> anyhow::Result<Motion> {
    let body = plate(0.3);
    let edge = half_extent()[1] - 0.1 * SPACING;
    let given = |[_, y]: &[f64; 2]| match (*y > edge, *y < -edge) {
        (true, _) => [Some(1e-3), Some(0.0)],
        (_, true) => [Some(0.0); 2],
        _ => [None; 2],
    };
    let prescribed = body.mesh.nodes.iter().map(given).collect();
    let forces = vec![[0.0; 2]; body.mesh.nodes.len()];
    plate_solution(body, &prescribed, &forces)
}

/// The heated plate: the free expansion about the origin, and displacements that cancel it at the clamped edges, top and bottom, and of
/// three edges also the left one.
fn heated_plate(edges: usize) -> anyhow::Result<Motion> {
    let body = plate(0.4);
    let edge = half_extent().map(|it| it - 0.1 * SPACING);
    let is_clamped = |[x, y]: [f64; 2]| y.abs() > edge[1] || (edges == 3 && x < -edge[0]);
    let given = |&node: &[f64; 2]| node.map(|it| is_clamped(node).then_some(-FREE_STRAIN * it));
    let prescribed = body.mesh.nodes.iter().map(given).collect();
    let forces = vec![[0.0; 2]; body.mesh.nodes.len()];
    let mut motion = plate_solution(body, &prescribed, &forces)?;
    motion.expand(FREE_STRAIN);
    Ok(motion)
}

/// The radial displacement of the cylinder, by Lame and by the lattice, at both ratios of the paper.
fn cylinder() -> anyhow::Result<Maps> {
    let file = ExperimentFile::read("cylinder")?;
    let mut bodies = Vec::new();
    for ratio in [0.1, -0.1] {
        let solution = file
            .case_run(&[("d", "50"), ("nu", &ratio.to_string())])?
            .solve()?;
        let ring = Ring {
            inner: 1.5,
            outer: 2.2,
            young: YOUNG,
            poisson: ratio,
            pressure: 400e6,
        };
        let cloud = &solution.model.plane().cloud;
        let [spacing, _] = cloud.lattice_cell.context("the cylinder is no lattice")?;
        let (places, found): (Vec<[f64; 2]>, Vec<f64>) = radial(&solution).into_iter().unzip();
        let exact = places.iter().map(|[x, y]| ring.lame(x.hypot(*y)));
        for (title, values) in [("Lame", exact.collect()), ("MBB-PD", found)] {
            let moved = |(place, value): (&[f64; 2], &f64)| {
                place.map(|it| value * it / place[0].hypot(place[1]))
            };
            let displacements: Vec<[f64; 2]> = places.iter().zip(&values).map(moved).collect();
            let title = format!("{title}, nu = {ratio}");
            bodies.push(MappedBody::from_lattice(
                title,
                &places,
                spacing,
                &displacements,
                values,
            ));
        }
    }
    Ok(Maps {
        name: "mbb-figure-11".to_owned(),
        title: "Thick cylinder under internal pressure".to_owned(),
        quantity: "u_r".to_owned(),
        unit: "m",
        bodies,
        columns: 2,
        are_modes: false,
    })
}
