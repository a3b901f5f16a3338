//! Exchange of motions and forces at ghost points.
//!
//! Arrays over the degrees of freedom are valid at owned points, motions also at ghosts: the far ends of the bonds at owned points.
//! At points with loads and at observed points all processes know motions and forces, so that they compute the same work and
//! reactions.

use ligament_model::ghosts::Ghosts;
use ligament_model::layout::Layout;
use ligament_model::subdomain::Subdomain;

use crate::load_program::{LoadCourse, LoadProgram, PartControl};
use crate::probe::Probe;
use crate::problem::Problem;

/// Ghost and common points whose motions and forces a process reads; none on one process alone.
#[derive(Debug, Clone)]
pub(crate) struct HaloExchange {
    subdomain: Subdomain,
    layout: Layout,
    ghosts: Ghosts,
    /// Points that all processes read, in the order of their owners.
    common: Vec<u32>,
    /// Number of values at those points that each process owns.
    counts: Vec<usize>,
}

impl HaloExchange {
    /// Exchange for a problem; collective.
    pub(crate) fn new(problem: &Problem) -> Self {
        let system = &*problem.system;
        let (subdomain, layout) = (&system.subdomain, system.layout);
        let mut common = match subdomain.is_whole() {
            true => Vec::new(),
            false => common_points(&*problem.loads, &problem.probes, layout),
        };
        common.sort_unstable_by_key(|&point| subdomain.place(point));
        common.dedup();
        let before =
            |rank| common.partition_point(|&it| subdomain.place(it) < subdomain.first(rank));
        let ranks = 0..subdomain.n_ranks();
        let n_components = layout.components.len();
        Self {
            counts: ranks
                .map(|rank| n_components * (before(rank + 1) - before(rank)))
                .collect(),
            ghosts: Ghosts::new(subdomain, system.ends.iter().flatten().copied()),
            subdomain: subdomain.clone(),
            layout,
            common,
        }
    }

    /// Points and bonds of the body on this process.
    pub(crate) fn subdomain(&self) -> &Subdomain {
        &self.subdomain
    }

    /// Sets motions (n_degrees_of_freedom) at ghosts and common points to the values of their owners.
    pub(crate) fn update_motions(&self, motions: &mut [f64]) {
        self.ghosts.update(motions, self.layout.components.len());
        self.update_forces(motions);
    }

    /// Sets forces (n_degrees_of_freedom) at common points to the values of their owners.
    pub(crate) fn update_forces(&self, forces: &mut [f64]) {
        if self.subdomain.is_whole() {
            return;
        }
        let rows = self.common.iter().map(|&it| self.layout.range(it));
        let owned = self.common.iter().filter(|&&it| self.subdomain.owns(it));
        let owned: Vec<f64> = owned
            .flat_map(|&point| forces[self.layout.range(point)].iter().copied())
            .collect();
        let communicator = self.subdomain.communicator();
        let all = communicator.all_gather(&owned, &self.counts);
        for (row, received) in rows.zip(all.chunks_exact(self.layout.components.len())) {
            forces[row].copy_from_slice(received);
        }
    }

    /// Sets the motions (n_degrees_of_freedom) at points unknown to this process to the communicator's poison value.
    pub(crate) fn poison_unknown(&self, motions: &mut [f64]) {
        if self.subdomain.is_whole() {
            return;
        }
        let mut is_known = vec![false; self.layout.n_points];
        let read = self.ghosts.points().iter().chain(&self.common).copied();
        let known = self.subdomain.owned().chain(read);
        known.for_each(|it| is_known[it as usize] = true);
        for (of_point, _) in (motions.chunks_mut(self.layout.components.len()))
            .zip(is_known)
            .filter(|(_, is_known)| !is_known)
        {
            of_point.fill(self.subdomain.communicator().poison());
        }
    }
}

/// Points with loads, points of the history, and points whose motion controls a load.
fn common_points(loads: &dyn LoadProgram, probes: &[Probe], layout: Layout) -> Vec<u32> {
    let read = probes.iter().filter_map(|it| it.reading.weights(layout));
    let parts = (loads.course().into_iter()).flat_map(|it: &LoadCourse| &it.programme.parts);
    let controls = parts.filter_map(|it| it.control.as_ref());
    let held = controls.flat_map(|it| match it {
        PartControl::Motion(motion) => motion.weights.clone(),
        PartControl::DissipatedEnergy { .. } => Vec::new(),
    });
    let dofs = (read.flatten().chain(held)).map(|(dof, _)| dof);
    let dofs = dofs.chain(loads.loaded_degrees_of_freedom());
    let of_groups = loads.groups().iter().flat_map(|it| &it.points);
    let of_control = loads.control().points.iter().chain(of_groups).copied();
    dofs.map(|dof| layout.point(dof as usize))
        .chain(of_control)
        .collect()
}
