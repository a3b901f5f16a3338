//! What a process knows of motions and forces at the points of others, where processes share a body out.
//!
//! Arrays over the degrees of freedom are right at the own points. Motions are so too at ghosts, the other ends of own bonds, whose processes
//! tell them to this one and to no other. Where something acts on the body, or a history reads it, all processes know motions and forces,
//! so that they account for work and reactions alike.

use ligament_model::ghosts::Ghosts;
use ligament_model::layout::Layout;
use ligament_model::portion::Portion;

use crate::load_program::{LoadCourse, LoadProgram, PartControl};
use crate::probe::Probe;
use crate::problem::Problem;

/// The points of others that a process knows something of.
#[derive(Debug, Clone)]
pub(crate) struct Neighbours {
    portion: Portion,
    layout: Layout,
    ghosts: Ghosts,
    /// Points that all know, in the order of the processes that have them.
    common: Vec<u32>,
    /// Values at those of each process.
    counts: Vec<usize>,
}

impl Neighbours {
    /// The neighbours of a process in a problem; none where one process has all of it.
    pub(crate) fn new(problem: &Problem) -> Option<Self> {
        let system = &*problem.system;
        let portion = system.portion()?;
        let (layout, partition) = (system.layout(), portion.partition());
        let mut common = common_points(&*problem.loads, &problem.probes, layout);
        common.sort_unstable_by_key(|&point| partition.place(point));
        common.dedup();
        let before =
            |rank| common.partition_point(|&it| partition.place(it) < partition.first(rank));
        let ranks = 0..portion.exchange().n_ranks();
        let n_components = layout.components.len();
        Some(Self {
            counts: ranks
                .map(|rank| n_components * (before(rank + 1) - before(rank)))
                .collect(),
            ghosts: Ghosts::new(portion, system.ends().iter().flatten().copied()),
            portion: portion.clone(),
            layout,
            common,
        })
    }

    /// The part of this process in the body.
    pub(crate) fn portion(&self) -> &Portion {
        &self.portion
    }

    /// Takes over motions of others (n_degrees_of_freedom) that are known here.
    pub(crate) fn tell_motions(&self, motions: &mut [f64]) {
        self.ghosts.tell(motions, self.layout.components.len());
        self.tell_forces(motions);
    }

    /// Takes over forces at points of others (n_degrees_of_freedom) where all know them.
    pub(crate) fn tell_forces(&self, forces: &mut [f64]) {
        let rows = self.common.iter().map(|&point| self.layout.range(point));
        let own = self.common.iter().filter(|&&it| self.portion.is_own(it));
        let own: Vec<f64> = own
            .flat_map(|&point| forces[self.layout.range(point)].iter().copied())
            .collect();
        let all = self.portion.exchange().gather(&own, &self.counts);
        for (row, told) in rows.zip(all.chunks_exact(self.layout.components.len())) {
            forces[row].copy_from_slice(told);
        }
    }

    /// Puts what stands for nothing at the points of others that nothing is known of, in motions (n_degrees_of_freedom).
    pub(crate) fn hide(&self, motions: &mut [f64]) {
        let mut is_known = vec![false; self.layout.n_points];
        let known = self.portion.own().iter().chain(self.ghosts.seen());
        known
            .chain(&self.common)
            .for_each(|&it| is_known[it as usize] = true);
        for (of_point, _) in (motions.chunks_mut(self.layout.components.len()))
            .zip(is_known)
            .filter(|(_, is_known)| !is_known)
        {
            of_point.fill(self.portion.exchange().stranger());
        }
    }
}

/// Points at which something acts, that a history reports, or whose motion controls a load.
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
