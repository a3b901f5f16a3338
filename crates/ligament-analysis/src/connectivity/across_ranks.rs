//! Bonds that may split a body that is divided over processes.

use ligament_model::subdomain::Subdomain;

/// Whether a body may split, where this process no longer connects the ends of some bonds: a connection on any process suffices.
pub(super) fn may_split(subdomain: &Subdomain, apart: Vec<[u32; 2]>) -> bool {
    let row = |ends: [u32; 2]| {
        let [one, other] = ends.map(|end| subdomain.rank(end));
        let [a, b] = subdomain.numbers(ends);
        [a, b, if one == other { 1 } else { 2 }]
    };
    let mut of_all = subdomain.all_gather_list(apart.into_iter().map(row).collect());
    of_all.sort_unstable();
    let mut of_bonds = of_all.chunk_by(|one, other| one == other);
    of_bonds.any(|same| same.len() == same[0][2] as usize)
}
