//! Fragments and holds, kept up while bonds break, against a search of the whole body after every breakage.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::Restraints;
use ligament_analysis::connectivity::Fragments;
use ligament_analysis::connectivity::decremental::Connectivity;
use ligament_analysis::unknowns::Unknowns;
use ligament_model::{BondSystem, System};
use verification::bench::Bench;
use verification::numbers::Random;
use verification::problems::{BAR, DISK, PLATE, SQUARE, TWO};

/// Breaks the bonds in this order, `batch()` of them at a time, and compares with the search of the whole body after each
/// breakage: the fragments, and the holds that are missing once those found before are in place.
///
/// Returns the largest number of fragments that one breakage added.
fn follow(
    bench: &Bench,
    prescribed: &[bool],
    mut order: &[u32],
    batch: impl FnMut() -> usize,
) -> usize {
    let system = &**bench.model.plane();
    let unknowns = Unknowns::all_but(system, |dof| bench.boundary.prescribed[dof].is_some());
    let can_hold = |dof: usize| unknowns.number(dof).is_some();
    let none = Restraints::default();
    let mut intact = vec![true; system.bonds.len()];
    let mut fixed = prescribed.to_vec();
    let mut connectivity = Connectivity::new(system);
    let (mut most_added, mut n_holds, mut parts) = (0, 0, 1);
    let mut sizes = std::iter::once(0).chain(std::iter::repeat_with(batch));
    while parts < system.cloud.len() {
        let (broken, rest) = order.split_at(sizes.next().unwrap().min(order.len()));
        order = rest;
        connectivity.bonds_broke(system, &mut intact, broken);
        let found = Fragments::find(system, &intact);
        assert_eq!(connectivity.fragments(), &found);
        let all = 0..found.points.len() as u32;
        let missing = found.missing_supports(all, system, &none, |dof| fixed[dof], can_hold);
        let holds = connectivity.missing_supports(system, &none, |dof| fixed[dof], can_hold);
        assert_eq!(holds, missing);
        for hold in &holds {
            fixed[hold.degree_of_freedom] = true;
        }
        n_holds += holds.len();
        most_added = most_added.max(found.points.len() - parts);
        parts = found.points.len();
    }
    let left = |dof: &usize| can_hold(*dof) && !prescribed[*dof];
    let expected = (0..fixed.len()).filter(left).count();
    assert_eq!(n_holds, expected, "a point alone has nothing free");
    most_added
}

/// All bonds in a random order.
fn shuffled(system: &BondSystem, random: &mut Random) -> Vec<u32> {
    let order = random.permutation(system.bonds.len());
    order.into_iter().map(|bond| bond as u32).collect()
}

/// First the bonds that cross the lines of a grid of `width`, then the others: the body falls into blocks.
fn blocks_first(system: &BondSystem, mut order: Vec<u32>, width: f64) -> Vec<u32> {
    let block =
        |point: u32| system.cloud.positions[point as usize].map(|x| (x / width).floor() as i64);
    order.sort_by_key(|&bond| {
        let [a, b] = system.bonds.ends[bond as usize].map(block);
        a == b
    });
    order
}

/// Real meshes, broken down to single points: in any order, and block by block, a few bonds at a time. Without shear
/// stiffness (nu = 1/3) no rotation can be held.
#[test]
fn fragments_and_holds_follow_every_breakage() {
    let bar = format!("{BAR}{TWO}");
    let plate = format!("{PLATE}{PULL}");
    let no_shear = SQUARE.replace("0.21", "0.333333333333333333");
    for (name, text, block) in [
        ("square", SQUARE, 0.03),
        ("square without shear", &no_shear, 0.03),
        ("plate", &plate, 0.05),
        ("bar", &bar, 0.02),
        ("disk", DISK, 0.025),
    ] {
        let bench = Bench::new(text, &[]);
        let system = &**bench.model.plane();
        let random = &mut Random(7);
        let order = shuffled(system, random);
        let blocks = blocks_first(system, shuffled(system, random), block);
        let supports = bench.boundary.prescribed.iter().map(Option::is_some);
        let supports: Vec<bool> = supports.collect();
        for (kind, order) in [("shuffled", order), ("blocks", blocks)] {
            let sizes = &mut Random(8);
            let batch = || (4.0 + 3.0 * sizes.uniform()) as usize;
            let added = follow(&bench, &supports, &order, batch);
            println!("{name}, {kind}: at most {added} parts more at once");
            assert!(added > 1, "breakages that make several parts");
        }
    }
}

/// What [`PLATE`] lacks.
const PULL: &str = "load = [{ group = \"right\", displacement = { x = 1e-5 } }]\n";

/// Random graphs: of all pairs of 80 points a few bonds are kept, so few that they make trees and long detours, and these
/// break one by one; supports at random places.
#[test]
fn random_graphs_come_apart_as_a_search_finds() {
    let bench = Bench::new(&format!("{PLATE}{PULL}"), &["model.horizon_factor=100"]);
    let system = &**bench.model.plane();
    let pairs = bench.points() * (bench.points() - 1) / 2;
    assert_eq!(system.bonds.len(), pairs, "every pair is bonded");
    let random = &mut Random(11);
    for graph in 0..100 {
        let order = shuffled(system, random);
        let kept = bench.points() / 2 + 2 * graph;
        let mut prescribed = vec![false; system.topology().layout.n_degrees_of_freedom()];
        for &dof in &random.permutation(prescribed.len())[..4] {
            prescribed[dof] = true;
        }
        let mut sizes = std::iter::once(pairs - kept).chain(std::iter::repeat(1));
        follow(&bench, &prescribed, &order, || sizes.next().unwrap());
    }
}

/// While a crack runs through the disk the ends of a broken bond have a common neighbour left, and the searches from them
/// stay within their families, however large the body is. Only the last bond tells the halves apart.
#[test]
fn an_ordinary_breakage_is_local() {
    for file in ["disk-4mm", "disk-2mm"] {
        let bench = Bench::new(DISK, &[&format!("mesh.file=../meshes/{file}.msh")]);
        let system = &**bench.model.plane();
        let mut connectivity = Connectivity::new(system);
        let crossing = crossing_the_y_axis(system);
        let (last, others) = crossing.split_last().unwrap();
        assert!(others.len() > 600);
        let mut intact = vec![true; system.bonds.len()];
        for bond in others {
            let effort = effort_of(&mut connectivity, system, &mut intact, *bond);
            let families: usize = families(system, *bond).iter().sum();
            assert!(effort <= families, "{file}: {effort} of {families}");
        }
        assert_eq!(connectivity.fragments().points.len(), 1);
        effort_of(&mut connectivity, system, &mut intact, *last);
        assert_eq!(connectivity.fragments().points.len(), 2);
    }
}

/// A point that comes loose costs its own search and one family, not a search of the body.
#[test]
fn a_small_part_comes_loose_at_its_own_cost() {
    let bench = Bench::new(DISK, &[]);
    let system = &**bench.model.plane();
    for point in 0..bench.points() as u32 {
        let mut connectivity = Connectivity::new(system);
        let (last, others) = system.bonds.incidence.at(point).split_last().unwrap();
        let mut intact = vec![true; system.bonds.len()];
        connectivity.bonds_broke(system, &mut intact, others);
        let effort = effort_of(&mut connectivity, system, &mut intact, *last);
        assert_eq!(connectivity.fragments().points.len(), 2);
        assert!(effort <= 1 + families(system, *last)[0].max(families(system, *last)[1]));
    }
}

/// Points that the searches reach when this bond breaks.
fn effort_of(
    connectivity: &mut Connectivity,
    system: &dyn System<2>,
    intact: &mut [bool],
    bond: u32,
) -> usize {
    let before = connectivity.effort();
    connectivity.bonds_broke(system, intact, &[bond]);
    connectivity.effort() - before
}

/// The ends of a bond with all their neighbours, counted.
fn families(system: &BondSystem, bond: u32) -> [usize; 2] {
    system.bonds.ends[bond as usize].map(|end| 1 + system.bonds.incidence.at(end).len())
}

/// Bonds that cross the y axis, from below upwards.
fn crossing_the_y_axis(system: &BondSystem) -> Vec<u32> {
    let ends_of = |bond: u32| {
        system.bonds.ends[bond as usize].map(|end| system.cloud.positions[end as usize])
    };
    let mut crossing: Vec<u32> = (0..system.bonds.len() as u32)
        .filter(|&bond| {
            let [a, b] = ends_of(bond);
            (a[0] < 0.0) != (b[0] < 0.0)
        })
        .collect();
    let height = |bond: u32| {
        let [a, b] = ends_of(bond);
        a[1] + a[0] / (a[0] - b[0]) * (b[1] - a[1])
    };
    crossing.sort_by(|&one, &other| height(one).total_cmp(&height(other)));
    crossing
}
