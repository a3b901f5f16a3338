//! Faces and surfaces that meet in a state: pairs across cracks with their friction, and contact between surfaces.

use std::sync::Arc;

use ligament_model::Bonds;
use ligament_model::contact::ClosedPair;
use ligament_model::layout::Layout;
use ligament_model::surface::Bonded;
use ligament_model::sweep::BondSweep;
use ligament_model::thermal::ThermalStrain;

use crate::balanced::Balanced;
use crate::contact::{self, Contact};
use crate::problem::Problem;
use crate::resisting::{self, Resisting};
use crate::state::State;
use crate::surfaces::{LastTouching, Surfaces, Touching};
use crate::unbalanced::Unbalanced;

/// What may meet in a body.
#[derive(Clone)]
pub(super) struct Meeting {
    system: Arc<dyn Bonds>,
    layout: Layout,
    /// Pairs across cracks, where faces close.
    pub(super) faces: Contact,
    /// Coefficient of friction on the faces of cracks; 0 where they do not close.
    face_friction: f64,
    pub(super) surfaces: Surfaces,
}

/// What meets in a state.
pub(super) struct Met {
    /// Gaps of the pairs across cracks, shape (n_pairs), m.
    pub(super) gaps: Vec<f64>,
    pub(super) closed: Vec<ClosedPair>,
    pub(super) touching: Touching,
}

/// Bonds of a state.
fn bonded<'a>(system: &'a dyn Bonds, state: &'a State) -> Bonded<'a> {
    Bonded {
        topology: system.topology(),
        intact: &state.intact,
    }
}

impl Meeting {
    /// What may meet in the body of a problem, without pairs across cracks.
    pub(super) fn new(problem: &Problem) -> Self {
        let layout = problem.system.layout();
        Self {
            system: problem.system.clone(),
            layout,
            faces: Contact::default(),
            face_friction: if problem.system.faces_close() {
                problem.face_friction
            } else {
                0.0
            },
            surfaces: Surfaces::new(&problem.contact, layout),
        }
    }

    /// Whether forces depend on the way to a state or on present positions, so that there is no energy to lower.
    pub(super) fn depends_on_way(&self) -> bool {
        self.face_friction > 0.0 || !self.surfaces.is_empty()
    }

    /// What meets in a state.
    pub(super) fn met(&mut self, state: &State, expansion: ThermalStrain<'_>) -> Met {
        let motions = &state.displacement;
        let gaps = self.faces.gaps(motions, expansion);
        let mut closed = self.faces.closed(&gaps);
        if self.face_friction > 0.0 {
            let layout = self.layout;
            (state.friction).rub(self.face_friction, &mut closed, layout, motions);
        }
        let surfaces = &mut self.surfaces;
        let touching = match surfaces.is_empty() {
            true => Touching::default(),
            false => {
                let bonds = bonded(&*self.system, state);
                let at = (state.load_factor, &*state.rigid);
                surfaces.touching((&state.surfaces, bonds), motions, at)
            }
        };
        Met {
            gaps,
            closed,
            touching,
        }
    }

    /// Adds the forces of what meets to those of the bonds.
    pub(super) fn add_to(&self, swept: &mut BondSweep, met: &Met, expansion: ThermalStrain<'_>) {
        contact::add_to(swept, &met.closed, self.layout, expansion);
        if !self.surfaces.is_empty() {
            let surfaces = self.surfaces.problem();
            met.touching.add_to(swept, surfaces, self.layout);
        }
    }

    /// What it resists, in the order of the keys.
    pub(super) fn resisting(&self, closed: &[ClosedPair], touching: &Touching) -> Vec<Resisting> {
        let mut all = resisting::by_faces(closed, self.layout);
        all.extend(touching.resisting(self.surfaces.problem(), self.layout));
        all
    }

    /// Reason why a state is no equilibrium after the last one: surfaces moved through each other unseen on the way.
    pub(super) fn missed(&self, state: &State, touching: &Touching) -> Option<Unbalanced> {
        let surfaces = &self.surfaces;
        if surfaces.is_empty() {
            return None;
        }
        let last = (&state.surfaces, bonded(&*self.system, state));
        let missed = surfaces.missed(last, (&state.displacement, touching));
        missed.map(|it| Unbalanced::missed(surfaces.problem(), it))
    }

    /// Moves friction and contact of a state to its equilibrium.
    pub(super) fn settle(&self, state: &mut State, balanced: &Balanced) {
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
