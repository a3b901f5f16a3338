//! Bodies that meet in a motion by central differences, with the energies of all that takes part.

use std::sync::Arc;

use ligament::Model;
use ligament::loading::contact_problem;
use ligament::setup::{ContactLaw, Rigid, RigidForm, Setup};
use ligament_analysis::Layout;
use ligament_analysis::contact::{
    ContactProblem, ContactReading, ContactStep, LastTouching, RigidRates, SurfaceEnergy,
    SurfaceSearch,
};
use ligament_analysis::load_program::Amplitude;
use ligament_model::surface::{Bonded, Pose, Vector};
use ligament_model::{Bonds, LumpedMass, UnbrokenBonds};

/// A rigid body without a velocity, friction or mass.
pub fn rigid(form: RigidForm) -> Rigid {
    Rigid {
        name: "rigid".to_owned(),
        form,
        against: Vec::new(),
        law: ContactLaw::default(),
        cracks: false,
        displacement: [0.0; 3],
        velocity: [0.0; 3],
        amplitude: Amplitude::constant(),
        mass: None,
        inertia: None,
        acceleration: [0.0; 3],
    }
}

/// A body in motion with its contacts, whose bonds never break.
pub struct Impact {
    /// Model of the body.
    pub model: Model,
    /// Contacts.
    pub problem: ContactProblem,
    /// Contacts at the time.
    pub contacts: Contacts,
    /// Masses and inertias, shape (n_degrees_of_freedom).
    pub mass: Vec<f64>,
    /// Time, s.
    pub time: f64,
    /// Time step, s.
    pub step: f64,
    /// Motions, shape (n_degrees_of_freedom).
    pub motions: Vec<f64>,
    /// Velocities half a step later, shape (n_degrees_of_freedom).
    pub velocity: Vec<f64>,
    /// Work of the loads so far, J.
    pub work: f64,
    system: Arc<dyn Bonds>,
    intact: Vec<bool>,
    acceleration: Vec<f64>,
    load: Vec<f64>,
}

/// Contacts of a body along its motion, with its rigid bodies.
pub struct Contacts {
    problem: ContactProblem,
    search: SurfaceSearch,
    /// Contact at the time.
    pub last: LastTouching,
    /// Places of the rigid bodies.
    pub poses: Vec<Pose>,
    /// Rates of the rigid bodies.
    pub rates: Vec<RigidRates>,
    energy: SurfaceEnergy,
    /// Energies so far.
    pub energies: ContactEnergies,
}

/// Energies of contacts so far, J.
#[derive(Debug, Clone, Copy, Default)]
pub struct ContactEnergies {
    /// Stored in the contacts at the time.
    pub stored: f64,
    /// Taken by friction and by contacts that begin and end.
    pub dissipated: f64,
    /// Work of what moves rigid bodies.
    pub driving_work: f64,
}

impl Contacts {
    /// Contacts at time zero, for the motions then (n_degrees_of_freedom).
    pub fn new(
        problem: &ContactProblem,
        layout: Layout,
        motions: &[f64],
        bonds: Bonded<'_>,
    ) -> Self {
        let mut contacts = Self {
            problem: problem.clone(),
            search: SurfaceSearch::new(problem, layout),
            last: LastTouching::new(Arc::default(), motions),
            poses: Vec::new(),
            rates: Vec::new(),
            energy: SurfaceEnergy::default(),
            energies: ContactEnergies::default(),
        };
        contacts.advance(0.0, 0.0, motions, bonds);
        contacts.rates = problem.rates_at_start(contacts.last.touching());
        contacts
    }

    /// Contacts with the state that others had at these motions.
    pub fn resumed(&self, layout: Layout, last: LastTouching, rates: Vec<RigidRates>) -> Self {
        Self {
            problem: self.problem.clone(),
            search: SurfaceSearch::new(&self.problem, layout),
            poses: last.touching().rigid.clone(),
            energy: SurfaceEnergy::new(&self.problem, last.clone()),
            energies: self.energies,
            last,
            rates,
        }
    }

    /// Moves to a time (s), by a step (s) to motions (n_degrees_of_freedom).
    pub fn advance(&mut self, time: f64, step: f64, motions: &[f64], bonds: Bonded<'_>) {
        let problem = &self.problem;
        problem.advance(step, &self.rates, &mut self.poses);
        let from = ContactStep {
            last: &self.last,
            bonds,
            motions,
        };
        let touching = (self.search).touching_in_time(from, (time, &self.poses));
        problem.accelerate(step, &touching, &mut self.rates);
        self.last = LastTouching::new(touching.into(), motions);
        if step == 0.0 {
            self.energy = SurfaceEnergy::new(problem, self.last.clone());
            return;
        }
        let work = self.energy.follow(problem, &self.last, motions.len());
        self.energies.stored = work.stored;
        self.energies.dissipated += work.dissipated;
        self.energies.driving_work += work.driving;
    }

    /// Resultants of each contact.
    pub fn readings(&self) -> Vec<ContactReading> {
        self.last.touching().readings(&self.problem)
    }

    /// Force of the contacts on a rigid body, N.
    pub fn force_on(&self, body: usize) -> Vector {
        self.last.touching().forces_on_rigid_bodies(&self.problem)[body]
    }
}

/// What a motion is loaded and slowed down by.
pub struct Drive<'a> {
    /// Forces at a time, shape (n_degrees_of_freedom).
    pub load: &'a dyn Fn(f64) -> Vec<f64>,
    /// Damping over mass, 1/s.
    pub damping: f64,
}

/// Energies of a motion, J.
#[derive(Debug, Clone, Copy)]
pub struct Ledger {
    /// Kinetic energy of body and rigid bodies.
    pub kinetic: f64,
    /// Energy of the bonds.
    pub strain: f64,
    /// Energies of the contacts.
    pub contact: ContactEnergies,
}

impl Ledger {
    /// Energy that can do work.
    pub fn mechanical(&self) -> f64 {
        self.kinetic + self.strain + self.contact.stored
    }
}

impl Impact {
    /// A motion from the setup of a body with its contacts; the motions at time zero and the velocities are functions of the
    /// position of a point and of the place among its components.
    pub fn new(
        setup: &Setup,
        motion: impl Fn(&[f64], usize) -> f64,
        velocity: impl Fn(&[f64], usize) -> f64,
    ) -> Self {
        let bare = Setup {
            contacts: Vec::new(),
            rigid_bodies: Vec::new(),
            ..setup.clone()
        };
        let mut model = Model::build(bare, &mut ()).unwrap();
        model.setup.contacts.clone_from(&setup.contacts);
        model.setup.rigid_bodies.clone_from(&setup.rigid_bodies);
        let problem = contact_problem(&model).unwrap();
        let (system, layout) = (model.system.to_bonds(), model.system.layout);
        let over = |value: &dyn Fn(&[f64], usize) -> f64| -> Vec<f64> {
            let places = 0..layout.components.len();
            let points = 0..layout.n_points as u32;
            let of_point = |it: u32| places.clone().map(move |place| (it, place));
            let all = points.flat_map(of_point);
            all.map(|(point, place)| value(&model.body().position(point), place))
                .collect()
        };
        let (motions, velocity) = (over(&motion), over(&velocity));
        let intact = vec![true; system.ends.len()];
        let bonds = Bonded {
            families: system.families(),
            intact: &intact,
        };
        let contacts = Contacts::new(&problem, layout, &motions, bonds);
        let mass = masses(&model, layout);
        let mut impact = Self {
            acceleration: vec![0.0; mass.len()],
            load: vec![0.0; mass.len()],
            time: 0.0,
            step: 0.0,
            work: 0.0,
            problem,
            contacts,
            mass,
            motions,
            velocity,
            system,
            intact,
            model,
        };
        impact.step = impact.stable_step();
        // Contacts and loads begin without force.
        let internal = impact.internal(&impact.motions);
        for (dof, inner) in internal.iter().enumerate() {
            impact.acceleration[dof] = -inner / impact.mass[dof];
            impact.velocity[dof] += 0.5 * impact.step * impact.acceleration[dof];
        }
        impact
    }

    /// Layout of the degrees of freedom.
    pub fn layout(&self) -> Layout {
        self.system.layout
    }

    /// Forces K u of the bonds.
    fn internal(&self, motions: &[f64]) -> Vec<f64> {
        let mut forces = vec![0.0; motions.len()];
        self.system
            .multiply(UnbrokenBonds::whole(&self.intact), motions, &mut forces);
        forces
    }

    /// 0.9 times the critical step, by the power method on M^-1 (K + D) with the bound D of the contacts; 1 % of the frequency covers what
    /// the method misses in 300 products.
    fn stable_step(&self) -> f64 {
        let bound = self.problem.stiffness(self.layout());
        let mut mode: Vec<f64> = (0..self.mass.len())
            .map(|it| (it as f64 * 1.7).sin())
            .collect();
        let mut largest = 0.0;
        for _ in 0..300 {
            let size = mode.iter().map(|it| it * it).sum::<f64>().sqrt();
            mode.iter_mut().for_each(|it| *it /= size);
            let mut product = self.internal(&mode);
            let stiffness = bound.at_degrees_of_freedom.iter().zip(&mode);
            for ((product, mass), (stiffness, motion)) in
                product.iter_mut().zip(&self.mass).zip(stiffness)
            {
                *product = (*product + stiffness * motion) / mass;
            }
            largest = product.iter().map(|it| it * it).sum::<f64>().sqrt();
            mode = product;
        }
        0.9 * 2.0 / (1.01 * largest.max(bound.squared_frequency).sqrt())
    }

    /// Moves by one time step.
    pub fn advance(&mut self, drive: &Drive<'_>) {
        let step = self.step;
        self.time += step;
        let before = self.motions.clone();
        for (motion, velocity) in self.motions.iter_mut().zip(&self.velocity) {
            *motion += step * velocity;
        }
        let internal = self.internal(&self.motions);
        let mut forces = vec![0.0; internal.len()];
        let bonds = Bonded {
            families: self.system.families(),
            intact: &self.intact,
        };
        self.contacts.advance(self.time, step, &self.motions, bonds);
        let touching = self.contacts.last.touching();
        touching.add_forces(&self.problem, 1.0, &mut forces);
        let mut load = (drive.load)(self.time);
        load.resize(internal.len(), 0.0);
        for dof in 0..internal.len() {
            let way = self.motions[dof] - before[dof];
            self.work += 0.5 * (load[dof] + self.load[dof]) * way;
            let given = load[dof] + forces[dof] - internal[dof];
            self.acceleration[dof] = given / self.mass[dof] - drive.damping * self.velocity[dof];
            self.velocity[dof] += step * self.acceleration[dof];
        }
        self.load = load;
    }

    /// Moves for a time (s), in whole steps.
    pub fn follow(&mut self, duration: f64, drive: &Drive<'_>) {
        for _ in 0..(duration / self.step).ceil() as usize {
            self.advance(drive);
        }
    }

    /// Energies at the time, the kinetic ones with the velocities half a step before and after.
    pub fn ledger(&self) -> Ledger {
        let of_dof = |dof: usize| {
            let (velocity, change) = (self.velocity[dof], self.step * self.acceleration[dof]);
            0.5 * self.mass[dof] * velocity * (velocity - change)
        };
        let kinetic: f64 = (0..self.mass.len()).map(of_dof).sum();
        let forces = self.internal(&self.motions);
        let strain = forces
            .iter()
            .zip(&self.motions)
            .map(|(f, u)| 0.5 * f * u)
            .sum();
        let of_rigid = self.problem.kinetic_energy(self.step, &self.contacts.rates);
        Ledger {
            kinetic: kinetic + of_rigid,
            strain,
            contact: self.contacts.energies,
        }
    }

    /// Momentum along an axis of the points for which a condition on the position holds, kg m/s, half a step later.
    pub fn momentum(&self, axis: usize, of: impl Fn(&[f64]) -> bool) -> f64 {
        self.sum(axis, of, &self.velocity)
    }

    /// Mean displacement along an axis of such points, m.
    pub fn displacement(&self, axis: usize, of: impl Fn(&[f64]) -> bool) -> f64 {
        let ones = vec![1.0; self.mass.len()];
        self.sum(axis, &of, &self.motions) / self.sum(axis, &of, &ones)
    }

    fn sum(&self, axis: usize, of: impl Fn(&[f64]) -> bool, values: &[f64]) -> f64 {
        let points = 0..self.layout().n_points as u32;
        let own = points.filter(|&it| of(&self.model.body().position(it)));
        let dofs = own.map(|it| self.layout().range(it).start + axis);
        dofs.map(|dof| self.mass[dof] * values[dof]).sum()
    }
}

impl Drive<'_> {
    /// No load and no damping.
    pub const NONE: Drive<'static> = Drive {
        load: &|_| Vec::new(),
        damping: 0.0,
    };
}

/// Masses and inertias of the degrees of freedom.
fn masses(model: &Model, layout: Layout) -> Vec<f64> {
    let densities: Vec<f64> = model
        .setup
        .materials()
        .iter()
        .map(|it| it.density.unwrap())
        .collect();
    let lumped = match model.setup.body.dimensions() {
        2 => LumpedMass::new(&model.plane().cloud, &densities),
        _ => LumpedMass::new(&model.solid().cloud, &densities),
    };
    let of_dof = |dof: usize| {
        let point = layout.point(dof) as usize;
        if layout.component(dof).is_rotation() {
            lumped.inertia[point]
        } else {
            lumped.mass[point]
        }
    };
    (0..layout.n_degrees_of_freedom()).map(of_dof).collect()
}
