//! Contacts in a state: pairs across cracks with their friction, and contact between surfaces.

use std::sync::Arc;

use ligament_model::Bonds;
use ligament_model::contact::ClosedPair;
use ligament_model::layout::Layout;
use ligament_model::surface::Bonded;
use ligament_model::sweep::BondSweep;
use ligament_model::thermal::ThermalStrain;

use super::faces::{self, FacePairs};
use super::resisting::{self, Resisting};
use super::surfaces::{ContactStep, LastTouching, SurfaceSearch, Touching};
use crate::balanced::Balanced;
use crate::problem::Problem;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Search for the contacts in the states of a body: pairs of faces that close, and surfaces that touch.
#[derive(Clone)]
pub(crate) struct ContactSearch {
    system: Arc<dyn Bonds>,
    layout: Layout,
    /// Pairs across cracks, where faces close.
    pub(crate) faces: FacePairs,
    /// Coefficient of friction on the faces of cracks; 0 where they do not close.
    face_friction: f64,
    pub(crate) surfaces: SurfaceSearch,
}

/// Contacts in a state.
pub(crate) struct Contacts {
    /// Gaps of the pairs across cracks, shape (n_pairs), m.
    pub(crate) gaps: Vec<f64>,
    pub(crate) closed: Vec<ClosedPair>,
    pub(crate) touching: Touching,
}

/// The step from the last contact of a state to the state.
fn step<'a>(system: &'a dyn Bonds, state: &'a State) -> ContactStep<'a> {
    ContactStep {
        last: &state.surfaces,
        bonds: Bonded {
            families: system.families(),
            intact: &state.intact,
        },
        motions: &state.displacement,
    }
}

impl ContactSearch {
    /// Search in the body of a problem, without pairs across cracks.
    pub(crate) fn new(problem: &Problem) -> Self {
        let layout = problem.system.layout;
        Self {
            system: problem.system.clone(),
            layout,
            faces: FacePairs::default(),
            face_friction: if problem.system.faces_close {
                problem.face_friction
            } else {
                0.0
            },
            surfaces: SurfaceSearch::new(&problem.contact, layout),
        }
    }

    /// Whether forces depend on the history or on present positions, so that there is no energy to minimise.
    pub(crate) fn depends_on_way(&self) -> bool {
        self.face_friction > 0.0 || !self.surfaces.is_empty()
    }

    /// Finds the contacts in a state.
    pub(crate) fn met(&mut self, state: &State, expansion: ThermalStrain<'_>) -> Contacts {
        let (gaps, closed) = self.closed(state, expansion);
        let touching = match self.surfaces.is_empty() {
            true => Touching::default(),
            false => {
                let at = (state.load_factor, &*state.rigid);
                self.surfaces.touching(step(&*self.system, state), at)
            }
        };
        Contacts {
            gaps,
            closed,
            touching,
        }
    }

    /// Gaps of the pairs across cracks in a state, shape (n_pairs), m, and the closed pairs with their friction.
    pub(crate) fn closed(
        &self,
        state: &State,
        expansion: ThermalStrain<'_>,
    ) -> (Vec<f64>, Vec<ClosedPair>) {
        let motions = &state.displacement;
        let gaps = self.faces.gaps(motions, expansion);
        let mut closed = self.faces.closed(&gaps);
        if self.face_friction > 0.0 {
            (state.friction).rub(self.face_friction, &mut closed, self.layout, motions);
        }
        (gaps, closed)
    }

    /// Contact between surfaces after an explicit step to a state; its forces never release energy.
    pub(crate) fn touching_in_time(&mut self, state: &State) -> Touching {
        let at = (state.load_factor, &*state.rigid);
        (self.surfaces).touching_in_time(step(&*self.system, state), at)
    }

    /// Updates the search for bonds that have just broken, by their numbers; `intact` (n_bonds) marks the remaining bonds.
    pub(crate) fn follow(&mut self, intact: &[bool], broken: &[u32]) {
        self.faces.follow(&*self.system, intact, broken);
        self.surfaces.join(broken.iter().copied());
    }

    /// Adds the forces and energies of faces and surfaces in contact to the sums over the bonds.
    pub(crate) fn add_to(
        &self,
        swept: &mut BondSweep,
        met: &Contacts,
        expansion: ThermalStrain<'_>,
    ) {
        faces::add_to(swept, &met.closed, self.layout, expansion);
        if !self.surfaces.is_empty() {
            let surfaces = self.surfaces.problem();
            met.touching.add_to(swept, surfaces, self.layout);
        }
    }

    /// Motions that the contacts resist, in the order of the keys.
    pub(crate) fn resisting(&self, closed: &[ClosedPair], touching: &Touching) -> Vec<Resisting> {
        let mut all = resisting::by_faces(closed, self.layout);
        all.extend(touching.resisting(self.surfaces.problem(), self.layout));
        all
    }

    /// Reason why a state cannot follow on the last one: surfaces moved through each other unseen on the way.
    pub(crate) fn missed(&self, state: &State, touching: &Touching) -> Option<Unbalanced> {
        let surfaces = &self.surfaces;
        if surfaces.is_empty() {
            return None;
        }
        let missed = surfaces.missed(step(&*self.system, state), touching);
        missed.map(|it| Unbalanced::missed(surfaces.problem(), it))
    }

    /// Stores the friction and the contact of an equilibrium in its state.
    pub(crate) fn settle(&self, state: &mut State, balanced: &Balanced) {
        let State {
            friction,
            surfaces,
            displacement,
            ..
        } = state;
        if !self.surfaces.is_empty() {
            *surfaces = LastTouching::new(balanced.touching.clone(), displacement);
        }
        if self.face_friction > 0.0 {
            let faces = (self.faces.pairs(), &*balanced.closed);
            friction.settle(self.face_friction, faces, self.layout, displacement);
        }
    }
}
