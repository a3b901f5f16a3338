//! Connected parts of a body that is divided over processes.
//!
//! Each process finds the points connected by its bonds and labels each set by its first point. Neighbours exchange these labels at
//! ghosts until none finds an earlier one. All processes know the previous parts; they exchange the points of split-off parts, but
//! not of the largest part that remains.

use std::collections::BTreeMap;

use ligament_model::Bonds;
use ligament_model::ghosts::Ghosts;
use ligament_model::subdomain::Subdomain;

/// First point of the part of each point by intact bonds of all processes, shape (n_points). The parts refine the previous ones,
/// given by the previous part of each point and the points of each part.
pub(super) fn parted(
    system: &dyn Bonds,
    intact: &[bool],
    (of_point, points): (&[u32], &[Vec<u32>]),
) -> Vec<u32> {
    let subdomain = system.subdomain();
    let firsts = first_points(system, intact);
    let named = || subdomain.owned().zip(firsts.iter().copied());
    let of = |point: u32| of_point[point as usize];
    let first_before = |fragment: u32| points[fragment as usize][0];
    let mut here: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    for (point, first) in named().filter(|&(point, first)| first_before(of(point)) != first) {
        *here.entry([of(point), first]).or_default() += 1;
    }
    let rows = here.into_iter();
    let rows: Vec<_> = rows
        .map(|([of, first], count)| [f64::from(of), f64::from(first), count as f64])
        .collect();
    let mut sizes: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    for [of, first, count] in subdomain.all_gather_list(rows) {
        *sizes.entry([of as u32, first as u32]).or_default() += count as usize;
    }
    // Largest part of each previous part: it keeps the points that the others leave.
    let mut largest: BTreeMap<u32, (u32, usize)> = BTreeMap::new();
    for (&[of, _], size) in &sizes {
        let whole = (first_before(of), points[of as usize].len());
        largest.entry(of).or_insert(whole).1 -= size;
    }
    for (&[of, first], &size) in &sizes {
        if let Some(most) = largest.get_mut(&of).filter(|most| most.1 < size) {
            *most = (first, size);
        }
    }
    let leaves = |&(point, first): &(u32, u32)| {
        let rest = largest.get(&of(point));
        rest.is_some_and(|rest| rest.0 != first)
    };
    let leaving = named().filter(leaves);
    let leaving = leaving.map(|(point, first)| [point, first]).collect();
    let first_of = |&fragment: &u32| {
        let rest = largest.get(&fragment);
        rest.map_or_else(|| first_before(fragment), |rest| rest.0)
    };
    let mut first_of_each: Vec<u32> = of_point.iter().map(first_of).collect();
    for [point, first] in subdomain.all_gather_list(leaving) {
        first_of_each[point as usize] = first;
    }
    first_of_each
}

/// Whether a body may split, where this process no longer connects the ends of some bonds: a connection on any process suffices.
pub(super) fn may_split(subdomain: &Subdomain, apart: Vec<[u32; 2]>) -> bool {
    let mut of_all = subdomain.all_gather_list(apart);
    of_all.sort_unstable();
    let mut of_bonds = of_all.chunk_by(|one, other| one == other);
    of_bonds.any(|same| {
        let [one, other] = same[0].map(|end| subdomain.partition().rank(end));
        same.len() == if one == other { 1 } else { 2 }
    })
}

/// First point of the part of each owned point by intact bonds of all processes.
fn first_points(system: &dyn Bonds, intact: &[bool]) -> Vec<u32> {
    let subdomain = system.subdomain();
    let n_points = system.n_points();
    let mut here = Parts::new(n_points);
    let bonds = system.ends().iter().zip(intact);
    for (ends, _) in bonds.filter(|(_, intact)| **intact) {
        here.join(*ends);
    }
    if let Some(far) = system.far_field() {
        for point in 0..n_points as u32 {
            far.at(point).for_each(|other| here.join([point, other]));
        }
    }
    let ghosts = Ghosts::new(subdomain, system.ends().iter().flatten().copied());
    let mut names: Vec<f64> = (0..n_points).map(|point| point as f64).collect();
    let mut told = vec![0.0; n_points];
    loop {
        for point in subdomain.owned() {
            told[point as usize] = names[here.first(point) as usize];
        }
        ghosts.update(&mut told, 1);
        let mut is_earlier = false;
        for &ghost in ghosts.points() {
            let name = &mut names[here.first(ghost) as usize];
            is_earlier |= told[ghost as usize] < *name;
            *name = name.min(told[ghost as usize]);
        }
        if !subdomain.any(is_earlier) {
            break;
        }
    }
    let owned = subdomain.owned();
    owned
        .map(|point| names[here.first(point) as usize] as u32)
        .collect()
}

/// Disjoint sets of connected points, each represented by its first point.
struct Parts {
    /// A point of the same set that is not after it, shape (n_points).
    before: Vec<u32>,
}

impl Parts {
    /// Sets of single points.
    fn new(n_points: usize) -> Self {
        Self {
            before: (0..n_points as u32).collect(),
        }
    }

    /// First point of the set of a point.
    fn first(&mut self, mut point: u32) -> u32 {
        while self.before[point as usize] != point {
            let next = self.before[point as usize];
            self.before[point as usize] = self.before[next as usize];
            point = self.before[point as usize];
        }
        point
    }

    /// Joins the sets of two points.
    fn join(&mut self, points: [u32; 2]) {
        let [one, other] = points.map(|point| self.first(point));
        let [first, last] = [one.min(other), one.max(other)];
        self.before[last as usize] = first;
    }
}
