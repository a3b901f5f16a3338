//! Contact of crack faces: pairs across cracks, their closure, and the forces of closed pairs.
//!
//! The closure of pairs follows from the displacements alone, without history.

use ligament_model::Bonds;
use ligament_model::contact::{ClosedPair, ContactPair, PairFriction};
use ligament_model::layout::{Component, Layout};
use ligament_model::sweep::BondSweep;
use ligament_model::tensor::{dot, minus};
use ligament_model::thermal::ThermalStrain;

use crate::balanced::Balanced;
use crate::state::State;

/// Pairs across the cracks of a body with given intact bonds.
#[derive(Debug, Clone, Default)]
pub(crate) struct FacePairs {
    pairs: Vec<ContactPair>,
}

impl FacePairs {
    /// Pairs across cracks for intact bonds (n_bonds); none where faces do not close.
    pub(crate) fn new(system: &dyn Bonds, intact: &[bool]) -> Self {
        if !system.faces_close {
            return Self::default();
        }
        Self {
            pairs: system.contact_pairs(intact),
        }
    }

    /// Updates the pairs for bonds that have just broken, by their numbers; `intact` (n_bonds) marks the remaining bonds.
    pub(crate) fn follow(&mut self, system: &dyn Bonds, intact: &[bool], broken: &[u32]) {
        if !system.faces_close {
            return;
        }
        if !system.subdomain.is_whole() {
            self.pairs = system.contact_pairs(intact);
            return;
        }
        let changed = system.changed_pairs(intact, broken);
        let is_changed =
            |it: &ContactPair| changed.binary_search_by_key(&it.number, |it| it.0).is_ok();
        self.pairs.retain(|it| !is_changed(it));
        self.pairs.extend(changed.iter().filter_map(|it| it.1));
        self.pairs.sort_unstable_by_key(|it| it.number);
    }

    /// Pairs across cracks.
    pub(crate) fn pairs(&self) -> &[ContactPair] {
        &self.pairs
    }

    /// Gaps of the pairs for the motions of all points, shape (n_pairs), m.
    pub(crate) fn gaps(&self, motions: &[f64], expansion: ThermalStrain<'_>) -> Vec<f64> {
        let pairs = self.pairs.iter();
        pairs.map(|pair| pair.gap(motions, expansion)).collect()
    }

    /// Closed pairs, from the gaps of all pairs (n_pairs).
    pub(crate) fn closed(&self, gaps: &[f64]) -> Vec<ClosedPair> {
        let closed = self.pairs.iter().zip(gaps).filter(|(_, gap)| **gap < 0.0);
        closed
            .map(|(&pair, &gap)| ClosedPair {
                pair,
                gap,
                friction: None,
            })
            .collect()
    }
}

/// Adds the forces and energies of closed pairs to the forces and energies of the bonds.
pub(crate) fn add_to(
    swept: &mut BondSweep,
    closed: &[ClosedPair],
    layout: Layout,
    expansion: ThermalStrain<'_>,
) {
    for it in closed {
        let force = it.force();
        for (dof, value) in end_forces(it, layout) {
            swept.internal.values[dof] += value;
            swept.sizes[dof] += value.abs();
            let scale = if layout.component(dof).is_rotation() {
                &mut swept.internal.moment_scale
            } else {
                &mut swept.internal.force_scale
            };
            *scale = scale.max(swept.sizes[dof]);
        }
        swept.stored_energy += it.energy();
        if !expansion.is_none() {
            let growth = it.pair.growth(expansion.at_full_load());
            swept.internal.thermal -= force * growth;
            swept.expansion_energy += 0.5 * it.pair.stiffness * growth * growth;
        }
    }
}

/// Internal forces and moments of a closed pair by degree of freedom, N and N m.
pub(crate) fn end_forces(
    closed: &ClosedPair,
    layout: Layout,
) -> impl Iterator<Item = (usize, f64)> {
    let force = closed.force();
    let row = closed.pair.row.into_iter();
    let row = row.filter(|(_, factor)| *factor != 0.0);
    let of_friction = |it: PairFriction| closed.pair.row_along(layout, it.force);
    let along = closed.friction.map(of_friction).unwrap_or_default();
    row.map(move |(dof, factor)| (dof as usize, force * factor))
        .chain(along)
}

/// Sum of a force component that the far ends of closed pairs exert on the near ends, N, given the numbers of crossing bonds and
/// pairs and whether their first end is near.
pub(crate) fn force_through(
    closed: &[ClosedPair],
    crossing: &[(u32, bool)],
    component: Component,
) -> f64 {
    let pulls = closed.iter().filter_map(|it| {
        let place = crossing.binary_search_by_key(&it.pair.number, |(number, _)| *number);
        let (_, first_is_near) = crossing[place.ok()?];
        let pull = it.pull(component);
        Some(if first_is_near { pull } else { -pull })
    });
    pulls.sum()
}

/// Adds the virial stress of closed pairs to the virial stress of a point, Pa.
pub(crate) fn add_virial(
    system: &dyn Bonds,
    closed: &[ClosedPair],
    point: u32,
    stress: &mut [f64],
) {
    let volume = system.volumes[point as usize];
    for it in closed.iter().filter(|it| it.pair.ends.contains(&point)) {
        for (stress, part) in stress.iter_mut().zip(it.virial_share(volume).components()) {
            *stress += part;
        }
    }
}

/// Energies lost by contact from one equilibrium to the next, J.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct FaceLoss {
    /// By pairs that opened, closed or formed.
    pub(crate) closure: f64,
    /// By friction.
    pub(crate) friction: f64,
}

/// Changes of the energies by closed pairs from one equilibrium to the next.
#[derive(Debug, Clone, Default)]
pub(crate) struct FaceEnergy {
    closed: Vec<ClosedPair>,
    motions: Vec<f64>,
    load_factor: f64,
}

impl FaceEnergy {
    /// Contact energies of the unloaded body.
    pub(crate) fn of_unloaded(system: &dyn Bonds) -> Self {
        let n_degrees_of_freedom = system.layout.n_degrees_of_freedom();
        Self {
            motions: vec![0.0; n_degrees_of_freedom * usize::from(system.faces_close)],
            ..Self::default()
        }
    }

    /// Moves to the next equilibrium, after bonds broke by their numbers. The energy lost by closing and opening is sum 1/2 k g g' over the
    /// pairs that opened minus the same sum over the pairs that closed.
    ///
    /// This is the energy released by forces that are linear between the two equilibria: after a breakage at fixed load it is
    /// released, and between two loads it is the error of the trapezoidal rule for the work, because there pairs open and close
    /// without force. The loss by friction is its work by the same rule minus the energy stored in sticking pairs; a pair that forms where
    /// a bond broke takes over a part of the bond's energy.
    pub(crate) fn follow<'a>(
        &mut self,
        (state, balanced): (&State, &Balanced),
        layout: Layout,
        broken: &[u32],
        expansion: &dyn Fn(f64) -> ThermalStrain<'a>,
    ) -> FaceLoss {
        let (closed, motions) = (&balanced.closed, &state.displacement);
        if closed.is_empty() && self.closed.is_empty() {
            self.keep(state, balanced);
            return FaceLoss::default();
        }
        let (before, now) = (expansion(self.load_factor), expansion(state.load_factor));
        let mutual = |it: &ClosedPair, other_gap: f64| 0.5 * it.force() * other_gap;
        let (opened, newly_closed) = changes(&self.closed, closed);
        let lost = opened
            .iter()
            .map(|it| mutual(it, it.pair.gap(motions, now)));
        let lost: f64 = lost.sum();
        let gained = newly_closed.iter();
        let gained = gained.map(|it| mutual(it, it.pair.gap(&self.motions, before)));
        let mut loss = FaceLoss {
            closure: lost - gained.sum::<f64>(),
            friction: 0.0,
        };
        // Each half of the trapezoidal rule has the forces of one equilibrium.
        let half = |it: &ClosedPair| {
            let of = |it: &ClosedPair, motions: &[f64]| it.pair.slip(layout, motions);
            let way = minus(of(it, motions), of(it, &self.motions));
            it.friction.map_or(0.0, |on| 0.5 * dot(on.force, way))
        };
        for it in &self.closed {
            loss.friction += half(it) + it.stored_in_friction();
        }
        for it in closed {
            let taken = half(it) - it.stored_in_friction();
            if broken.contains(&it.pair.number) {
                loss.closure += taken;
            } else {
                loss.friction += taken;
            }
        }
        self.keep(state, balanced);
        loss
    }

    /// Begins a part of a programme, in which the last equilibrium has another load factor.
    pub(crate) fn begin_part(&mut self, load_factor: f64) {
        self.load_factor = load_factor;
    }

    /// Stores an equilibrium as the last one.
    pub(crate) fn keep(&mut self, state: &State, balanced: &Balanced) {
        self.closed.clone_from(&balanced.closed);
        // Displacements are stored only where faces close.
        if !self.motions.is_empty() {
            self.motions.clone_from(&state.displacement);
        }
        self.load_factor = state.load_factor;
    }
}

/// Pairs that only the first of two lists contains, and pairs that only the second contains; both lists are in the order of the
/// numbers.
pub(crate) fn changes(
    before: &[ClosedPair],
    now: &[ClosedPair],
) -> (Vec<ClosedPair>, Vec<ClosedPair>) {
    let is_in = |list: &[ClosedPair], it: &ClosedPair| {
        let place = list.binary_search_by_key(&it.pair.number, |other| other.pair.number);
        place.is_ok_and(|place| list[place].pair == it.pair)
    };
    let only = |list: &[ClosedPair], other: &[ClosedPair]| {
        let alone = list.iter().filter(|it| !is_in(other, it));
        alone.copied().collect()
    };
    (only(before, now), only(now, before))
}
