//! Meshed bodies of which the first of several ranks alone has the cells: it sends each rank its part, which is that of the definition. The ranks
//! are threads.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::fmt::Debug;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ligament::Model;
use ligament::system::AnySystem;
use ligament_analysis::distributed_matrix::{
    DistributedMatrix, MatrixCommunicator, Rows as MatrixRows,
};
use ligament_analysis::messages::{LONGEST, Way, receive, send};
use ligament_analysis::serial::Damaged;
use ligament_case::case::CaseFile;
use ligament_mesh::gmsh::holds_solid;
use ligament_model::PointCloud;
use ligament_model::communicator::Communicator;
use verification::bench::case;
use verification::problems::{BAR, TWO};
use verification::repository;
use verification::threads_as_ranks::on_ranks;

/// Ranks that do not divide the points evenly, nor are a power of two.
const RANKS: usize = 3;

/// A horizon that is short beside a part of the body.
const SHORT: &str = "model.horizon_factor=1.5";

/// A communicator that records the longest message of bytes of this rank.
#[derive(Debug)]
struct Recording {
    ranks: Arc<dyn MatrixCommunicator>,
    longest: Arc<AtomicUsize>,
}

impl Communicator for Recording {
    fn rank(&self) -> usize {
        self.ranks.rank()
    }

    fn size(&self) -> usize {
        self.ranks.size()
    }

    fn all_reduce_max(&self, values: &mut [f64]) {
        self.ranks.all_reduce_max(values);
    }

    fn all_gather(&self, own: &[f64], counts: &[usize]) -> Vec<f64> {
        self.ranks.all_gather(own, counts)
    }

    fn all_to_all(&self, own: &[f64], to: &[usize], from: &[usize]) -> Vec<f64> {
        self.ranks.all_to_all(own, to, from)
    }

    fn broadcast(&self, bytes: &mut Vec<u8>) {
        self.ranks.broadcast(bytes);
        self.longest.fetch_max(bytes.len(), Ordering::Relaxed);
    }

    fn transfer(&self, from: usize, to: usize, bytes: &mut Vec<u8>) {
        self.ranks.transfer(from, to, bytes);
        self.longest.fetch_max(bytes.len(), Ordering::Relaxed);
    }

    fn poison(&self) -> f64 {
        self.ranks.poison()
    }
}

impl MatrixCommunicator for Recording {
    fn has_matrices(&self) -> bool {
        true
    }

    fn matrix(&self, rows: &MatrixRows<'_>) -> Option<Box<dyn DistributedMatrix>> {
        self.ranks.matrix(rows)
    }
}

fn split_block(settings: &[&str]) -> CaseFile {
    let path = repository().join("cases/split-block/case.toml");
    let settings: Vec<String> = settings.iter().map(|&it| it.to_owned()).collect();
    CaseFile::load(&path, &settings).unwrap()
}

/// The points and cells of a part, by their definition: owned points, those near them and those of some groups, the corners of all cells that meet
/// the box around the former or have a corner of the latter, and the cells between these points.
fn part_of<const D: usize>(
    whole: &Model,
    cloud: &PointCloud<D>,
    known: &[&str],
) -> (Vec<u32>, Vec<u32>) {
    let body = &*whole.setup.body;
    let horizon = |point: u32| {
        whole
            .setup
            .horizon
            .at_spacing(cloud.spacing[point as usize])
    };
    let mut is_here = cloud.near_owned(horizon);
    let near = (0..cloud.len() as u32).filter(|&it| is_here[it as usize]);
    let [lowest, highest] = cloud.box_around(near);
    let mut is_known = vec![false; cloud.len()];
    for point in known.iter().flat_map(|it| body.points_of(it).unwrap()) {
        is_known[point as usize] = true;
        is_here[point as usize] = true;
    }
    for corners in body.corners() {
        let [low, high] = cloud.box_around(corners.iter().copied());
        let is_crossed =
            (0..D).all(|axis| low[axis] <= highest[axis] && lowest[axis] <= high[axis]);
        if is_crossed || corners.iter().any(|&it| is_known[it as usize]) {
            corners.iter().for_each(|&it| is_here[it as usize] = true);
        }
    }
    let is_inside = |corners: &[u32]| corners.iter().all(|&it| is_here[it as usize]);
    let cells = (0..).zip(body.corners()).filter(|(_, it)| is_inside(it));
    (
        (0..cloud.len() as u32)
            .filter(|&it| is_here[it as usize])
            .collect(),
        cells.map(|(cell, _)| cell).collect(),
    )
}

/// Values at some points of a list with one or more for each point.
fn at(points: &[u32], values: &[f64], n: usize) -> Vec<f64> {
    let of_point = |&point: &u32| &values[n * point as usize..n * (point as usize + 1)];
    points.iter().flat_map(of_point).copied().collect()
}

/// The body and the points of a rank are those of the part of the whole body.
fn assert_part<const D: usize>(
    (whole, all): (&Model, &PointCloud<D>),
    (model, cloud): (&Model, &PointCloud<D>),
    known: &[&str],
) {
    let ranks = model.setup.solver.communicator.0.clone();
    let divided = PointCloud {
        subdomain: all.divided(ranks),
        ..all.clone()
    };
    let (points, cells) = part_of(whole, &divided, known);
    let numbers: Vec<u32> = (0..cloud.len() as u32)
        .map(|it| cloud.subdomain.number(it))
        .collect();
    assert_eq!(numbers, points);
    let (body, whole_body) = (&*model.setup.body, &*whole.setup.body);
    assert_eq!(body.grid().cell_numbers, cells);
    let corners = body.corners().into_iter();
    let corners = corners.map(|it| it.iter().map(|&it| points[it as usize]).collect());
    let corners: Vec<Vec<u32>> = corners.collect();
    let of_whole = whole_body.corners();
    let expected = cells.iter().map(|&it| of_whole[it as usize].to_vec());
    assert_eq!(corners, expected.collect::<Vec<_>>());
    assert_eq!(body.group_names(), whole_body.group_names());
    let among = |all: Vec<u32>, some: &[u32]| -> Vec<u32> {
        let places = (0..).zip(some).filter(|(_, it)| all.contains(it));
        places.map(|(place, _)| place).collect()
    };
    for group in body.group_names() {
        let nodes = whole_body.points_of(&group).unwrap();
        assert_eq!(body.points_of(&group), Some(among(nodes, &points)));
        let of_group = whole_body.cells_of(&group).unwrap();
        assert_eq!(body.cells_of(&group), Some(among(of_group, &cells)));
    }
    let n = all.n_materials;
    assert_eq!(*cloud.volumes, at(&points, &all.volumes, 1));
    assert_eq!(*cloud.spacing, at(&points, &all.spacing, 1));
    assert_eq!(cloud.material_shares, at(&points, &all.material_shares, n));
    let places = |it: &u32| all.positions[*it as usize];
    assert!(
        cloud
            .positions
            .iter()
            .copied()
            .eq(points.iter().map(places))
    );
    let in_file = |it: &u32| whole_body.numbering().in_file(*it);
    let numbering = body.numbering();
    let here = (0..points.len() as u32).map(|it| numbering.in_file(it));
    assert!(here.eq(points.iter().map(in_file)));
    let no_fail = points.iter().map(|&it| whole.fixed.no_fail[it as usize]);
    assert!(model.fixed.no_fail.iter().copied().eq(no_fail));
}

/// Tetrahedra, and triangles of two materials: before the division other ranks have nodes alone, after it each has its part.
#[test]
fn the_first_rank_alone_has_all_cells() {
    let cases = [
        (split_block(&[SHORT]), &["bottom", "top"]),
        (case(&[BAR, TWO].concat(), &[SHORT]), &["left", "right"]),
    ];
    for (case, known) in cases {
        let whole = Model::build(case.setup(&mut ()).unwrap(), &mut ()).unwrap();
        let n_cells = whole.setup.body.n_cells();
        let of_ranks = on_ranks(RANKS, |ranks| {
            let longest = Arc::new(AtomicUsize::new(0));
            let recording = Arc::new(Recording {
                ranks: ranks.clone(),
                longest: longest.clone(),
            });
            let setup = case.setup_on_processes(recording, &mut ()).unwrap();
            let before = if ranks.rank() == 0 { n_cells } else { 0 };
            assert_eq!(setup.body.n_cells(), before);
            assert_eq!(setup.body.n_points(), whole.setup.body.n_points());
            let model = Model::build(setup, &mut ()).unwrap();
            assert_eq!(model.names.n_cells(), 0);
            assert!((1..=LONGEST).contains(&longest.load(Ordering::Relaxed)));
            match (&whole.system, &model.system) {
                (AnySystem::Plane(all), AnySystem::Plane(system)) => {
                    assert_part((&whole, &all.cloud), (&model, &system.cloud), known);
                }
                (AnySystem::Solid(all), AnySystem::Solid(system)) => {
                    assert_part((&whole, &all.cloud), (&model, &system.cloud), known);
                }
                _ => panic!("other dimensions"),
            }
            model.setup.body.n_cells()
        });
        println!("{of_ranks:?} of {n_cells} cells");
        // The part between the others has the cells at both ends, which all ranks know, and may be the whole.
        assert!(of_ranks[0] < n_cells && of_ranks[RANKS - 1] < n_cells);
    }
}

/// Values that fill messages, also to the last byte, and values without a byte arrive as they were sent.
#[test]
fn long_values_go_in_bounded_messages() {
    let of_ranks = on_ranks(2, |ranks| {
        let longest = Arc::new(AtomicUsize::new(0));
        let recording = Recording {
            ranks: ranks.clone(),
            longest: longest.clone(),
        };
        let (from, to) = (1, 0);
        for way in [Way::ToAll, Way::Between { from, to }] {
            let sender = if matches!(way, Way::ToAll) { 0 } else { from };
            for count in [0, 1, LONGEST / 4, LONGEST / 4 + 1, 3 * LONGEST / 4] {
                let sent: Vec<u8> = (0..4 * count).map(|it| it as u8).collect();
                if ranks.rank() == sender {
                    send(&recording, way, |out| out.put(&sent));
                } else {
                    let read = receive(&recording, way, |from| {
                        let mut read = vec![0; 4 * count];
                        let whole = from.read_exact(&mut read);
                        whole.map(|()| read).map_err(|_| Damaged)
                    });
                    assert!(read.unwrap() == sent);
                }
            }
        }
        longest.load(Ordering::Relaxed)
    });
    assert_eq!(of_ranks, [LONGEST; 2]);
}

/// The kind of a mesh is known from the beginning of its file where this lists entities, so that no process reads the rest for it.
#[test]
fn the_kind_of_a_mesh_is_at_the_beginning_of_its_file() {
    let format = |version: &str| format!("$MeshFormat\n{version} 0 8\n$EndMeshFormat\n");
    let kind = |version: &str, rest: &str| holds_solid((format(version) + rest).as_bytes());
    assert_eq!(kind("4.1", "$Entities\n8 12 6 1\n"), Some(true));
    assert_eq!(kind("4.1", "$Entities\n8 12 6 0\n"), Some(false));
    assert_eq!(kind("4.1", "$Entities\n8 12 6"), None);
    assert_eq!(kind("4.1", ""), None);
    assert_eq!(kind("2.2", "$Nodes\n1\n1 0 0 0\n$EndNodes\n"), None);
    let elements = "$Elements\n1\n1 4 2 7 1 1 2 3 4\n$EndElements\n";
    assert_eq!(kind("2.2", elements), Some(true));
}

/// Where bonds need the whole body, each rank reads its cells.
#[test]
fn bodies_that_are_not_divided_are_whole_on_each_rank() {
    let case = case(&[BAR, TWO].concat(), &["model.closing=true"]);
    let n_cells = case.setup(&mut ()).unwrap().body.n_cells();
    let of_ranks = on_ranks(2, |ranks| {
        let setup = case.setup_on_processes(ranks, &mut ()).unwrap();
        setup.body.n_cells()
    });
    assert_eq!(of_ranks, [n_cells; 2]);
}

/// An error that the first rank finds, in the file or in the cells, ends all ranks; the first one has the words of one process.
#[test]
fn errors_of_the_first_rank_end_all() {
    let unknown = split_block(&["no_fail.0.group=nowhere"]);
    let refused = |setup| Model::build(setup, &mut ()).map(|_| ()).unwrap_err();
    let alone = refused(unknown.setup(&mut ()).unwrap());
    let words = on_ranks(RANKS, |ranks| {
        refused(unknown.setup_on_processes(ranks, &mut ()).unwrap()).to_string()
    });
    assert_eq!(words[0], alone.to_string());
    let others = words[1..].iter();
    assert!(others.clone().all(|it| it.contains(&words[0])), "{words:?}");

    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("broken.msh");
    let text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n";
    std::fs::write(&path, text).unwrap();
    let broken = split_block(&[&with_mesh(&path)]);
    let of_ranks = on_ranks(RANKS, |ranks| {
        let refused = broken.setup_on_processes(ranks, &mut ()).unwrap_err();
        format!("{refused:#}")
    });
    assert!(of_ranks[0].contains("broken.msh"), "{of_ranks:?}");
    let others = of_ranks[1..].iter();
    assert!(others.clone().all(|it| it.contains("first process")));
}

fn with_mesh(path: &Path) -> String {
    format!("mesh.file={}", path.display())
}
