//! What equations may ask of bonds: the one interface between the mechanics and what solves its equations.
//!
//! A sweep over all bonds is one call through the interface; the loop inside knows the element as a type.

use ligament_mesh::Numbering;
use rayon::prelude::*;

use crate::bonds::{BondSet, Incidence};
use crate::change::ChangedElements;
use crate::contact::{ClosedPair, ContactPair, Overlap};
use crate::deformation::Deformations;
use crate::element::{BondDeformation, Rigidities, StiffnessFactors, Term};
use crate::failure::Criterion;
use crate::layout::{Component, Layout};
use crate::rigid_motions::FreeMotion;
use crate::subdomain::Subdomain;
use crate::sweep::BondSweep;
use crate::system::UnbrokenBonds;
use crate::thermal::ThermalStrain;

/// The bonds of a body as equations see them. Points, bonds and degrees of freedom are numbers; where the points lie, and in
/// how many dimensions, is known behind this interface alone.
///
/// Where processes share a body out, each has the bonds at its own points, and arrays of shape (n_bonds) are over those. What is said of
/// the whole body, or of forces at points, is the same on all of them, and all of them ask for it at the same time: stiffnesses by sign,
/// what is resisted, point stiffnesses, rigid motions, forces and energies of a sweep, overlaps. Energy densities and stresses of points
/// are right at own points, and each process asks for them by itself.
pub trait Bonds: BondTopology + BondKinetics + BondReadings + BondContact {}

impl<T: BondTopology + BondKinetics + BondReadings + BondContact> Bonds for T {}

/// Points, bonds and what they are connected with: numbers without coordinates.
pub trait BondTopology: std::fmt::Debug + Send + Sync {
    /// Number of points.
    fn n_points(&self) -> usize;

    /// How the points are numbered: here, and in the file.
    fn numbering(&self) -> &Numbering;

    /// The points and bonds of the body on this process.
    fn subdomain(&self) -> &Subdomain;

    /// Components of the motion of a point, in the order of the arrays over degrees of freedom.
    fn components(&self) -> &'static [Component];

    /// Where arrays over degrees of freedom hold the motions of the points.
    fn layout(&self) -> Layout {
        Layout {
            n_points: self.n_points(),
            components: self.components(),
        }
    }

    /// Names of the strains of a bond.
    fn strain_names(&self) -> &'static [&'static str];

    /// Points A < B of each bond, shape (n_bonds).
    fn ends(&self) -> &[[u32; 2]];

    /// Numbers in the file of the ends of a bond, ascending: what is tied goes by them.
    fn ends_in_file(&self, bond: u32) -> [u32; 2] {
        self.numbering().ends_in_file(self.ends()[bond as usize])
    }

    /// The bonds of each point.
    fn incidence(&self) -> &Incidence;

    /// Ends and families of the bonds.
    fn topology(&self) -> Topology<'_> {
        Topology {
            ends: self.ends(),
            incidence: self.incidence(),
        }
    }

    /// The bonds whose elements couple each point, ascending; on the imaginary lattice more than those that end there.
    fn elements_at_points(&self) -> &Incidence;

    /// The other points that elements couple with each point.
    fn coupled_points(&self) -> CoupledPoints<'_>;

    /// Volume of each point, shape (n_points), m^3.
    fn volumes(&self) -> &[f64];

    /// Distance of each point from its nearest one, shape (n_points), m.
    fn spacing(&self) -> &[f64];

    /// Horizon of each bond, shape (n_bonds), m.
    fn horizons(&self) -> &[f64];

    /// Weight of each bond in the damage of its ends, shape (n_bonds).
    fn weights(&self) -> &[f64];

    /// Share of the energy of a bond that belongs to one of its ends: mostly a half.
    fn share(&self, bond: u32, point: u32) -> f64;

    /// Diagonal of the box around all points of the body, m.
    fn extent(&self) -> f64;

    /// Sorts points so that those of the first half lie before those of the second along the longest side of all; ties are
    /// broken by number.
    fn halve(&self, points: &mut [u32]);
}

/// Stiffness and forces of the bonds, and the motions that cost no energy.
pub trait BondKinetics: BondTopology {
    /// Whether forces are linear in the displacements.
    fn is_linear(&self) -> bool;

    /// Whether forces are those of an energy, so that the stiffness is symmetric.
    fn has_energy(&self) -> bool;

    /// Whether every bond resists stretch and shear, so that the stiffness is definite.
    fn all_positive(&self) -> bool;

    /// Whether some bond has a negative stiffness, so that that of the body may be indefinite.
    fn some_negative(&self) -> bool;

    /// Whether some bond has a negative stiffness against shear.
    fn some_negative_shear(&self) -> bool;

    /// For each degree of freedom, whether some bond resists it, shape (n_degrees_of_freedom).
    fn resisted(&self) -> Vec<bool>;

    /// Stiffness of each point with all its bonds, shape (n_points).
    fn point_stiffness(&self) -> Vec<PointStiffness>;

    /// Degrees of freedom that hold the rigid motions of some connected points which cost no energy, as far as fixed ones do
    /// not; those that hold most first, of equals the first in the file. `can_hold` tells what has a stiffness.
    fn holds(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> Vec<usize>;

    /// Displacements and rotations of some connected points in each rigid motion of theirs that costs no energy and that no
    /// fixed degree of freedom prevents, shape (motions, degrees of freedom of the points).
    fn free_shapes(&self, points: &[u32], is_fixed: &dyn Fn(usize) -> bool) -> Vec<Vec<f64>>;

    /// The rigid motions of some connected points that cost no energy and that no fixed degree of freedom prevents, with the
    /// work that forces do on them.
    fn free_motions(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        force: &dyn Fn(usize) -> f64,
    ) -> Vec<FreeMotion>;

    /// Displacements and rotations of some points in each rigid motion of them as a whole, whether it costs energy or not, shape
    /// (motions, degrees of freedom of the points): translations of size one along the axes, then rotations about the middle of
    /// the points by one over their radius, along which they turn as well.
    fn rigid_shapes(&self, points: &[u32]) -> Vec<Vec<f64>>;

    /// The rigid motions of the whole body about the centre of its masses (n_points).
    fn motions_about_centre(&self, masses: &[f64]) -> CentralMotions;

    /// Displacements u_i = x_j, u_j = x_i of all points for each pair of axes i <= j, each of shape (n_degrees_of_freedom): the motions of
    /// uniform strain.
    fn motions_of_strain(&self) -> Vec<Vec<f64>>;

    /// Deformation of every bond without what its temperature gives it, broken or not, shape (n_bonds).
    fn deformations(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations;

    /// What criteria measure of some bonds, in their order, for displacements (n_degrees_of_freedom) at the temperature without strains.
    fn measured(
        &self,
        intact: &[bool],
        displacement: &[f64],
        bonds: &[u32],
    ) -> Vec<BondDeformation>;

    /// Forces and energy of bonds with given deformations (n_bonds).
    ///
    /// Nothing depends on the number of threads: the bonds of a part are added up by one thread in their order, and the parts
    /// after each other.
    fn forces(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: Deformations,
        expansion: ThermalStrain<'_>,
    ) -> BondSweep;

    /// Stiffness of a bond with what remains of it, as a sum of terms.
    fn terms(&self, intact: &[bool], bond: usize, remaining: &StiffnessFactors) -> Vec<Term>;

    /// Adds up the blocks of the stiffness in the columns of a point at the rows of its `lower` coupled points (ascending) and
    /// of itself, shape (n_lower + 1, components, components).
    fn add_blocks(&self, bonds: UnbrokenBonds<'_>, point: u32, lower: &[u32], blocks: &mut [f64]);

    /// The product K u of the stiffness of the bonds that are left with motions u, shape (n_degrees_of_freedom) both; of bonds whose
    /// forces are linear in the displacements. What `forces` held is lost.
    ///
    /// Nothing depends on the number of threads, as in [`BondKinetics::forces`].
    fn multiply(&self, bonds: UnbrokenBonds<'_>, motions: &[f64], forces: &mut [f64]);

    /// Adds the derivatives of the forces by the displacements: row, column, value.
    fn add_derivatives(&self, intact: &[bool], add: &mut dyn FnMut(usize, usize, f64));

    /// The elements that change when some of the bonds that are `left` break, at displacements (n_degrees_of_freedom).
    fn changed(
        &self,
        left: UnbrokenBonds<'_>,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        bonds: &[u32],
    ) -> Box<dyn ChangedElements>;
}

/// Energies, stresses and forces that are read off a state of the bonds.
pub trait BondReadings: BondTopology {
    /// 1/2 u^T K u', J, of an unbroken bond with what remains of its stiffness, for two deformations of all bonds.
    fn mutual_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &StiffnessFactors,
        deformations: [&Deformations; 2],
    ) -> f64;

    /// Energy 1/2 u^T K u, J, of an unbroken bond with what remains of its stiffness, from what criteria measure of its deformation.
    fn stored_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &StiffnessFactors,
        measured: &BondDeformation,
    ) -> f64;

    /// Strain energy density of a point, J/m^3: its share of the energy of its bonds over its volume.
    fn energy_density(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        point: u32,
    ) -> f64;

    /// Components of the virial stress of a point, Pa.
    fn stress(&self, bonds: UnbrokenBonds<'_>, deformations: &Deformations, point: u32)
    -> Vec<f64>;

    /// Stress of every point in one reading of the forces of the bonds.
    fn stresses(
        &self,
        reading: StressReading,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
    ) -> Stresses;

    /// Sum of a component of what the far ends of some bonds exert on the near ones, which are the first where marked, N; of
    /// bonds of two points alone.
    fn force_through(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        crossing: &[(u32, bool)],
        component: Component,
    ) -> f64;

    /// Energy that a bond stores at its limit under a criterion, with the stiffness that the criterion is about, J; 0 where
    /// the bond never gets there.
    fn energy_at_limit(&self, criterion: &Criterion, bond: usize) -> f64;
}

/// Pairs of points across cracks.
pub trait BondContact: BondTopology {
    /// Whether faces of cracks carry pressure where they close.
    fn faces_close(&self) -> bool;

    /// The pairs across cracks while the bonds marked in `intact` (n_bonds) are unbroken, in the order of their numbers.
    fn contact_pairs(&self, intact: &[bool]) -> Vec<ContactPair>;

    /// The pair across a crack whose faces have passed through each other farthest, beyond a depth (m), of the points that are
    /// asked for (n_points); for displacements (n_degrees_of_freedom), and none where faces close.
    fn overlap(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        beyond: f64,
        asked: &[bool],
    ) -> Option<Overlap>;

    /// Adds the stresses of closed pairs to the stresses of every point in a reading.
    fn add_contact_stresses(
        &self,
        reading: StressReading,
        closed: &[ClosedPair],
        stresses: &mut Stresses,
    );
}

/// Ends and families of bonds, without coordinates.
#[derive(Debug, Clone, Copy)]
pub struct Topology<'a> {
    /// Points A < B of each bond, shape (n_bonds).
    pub ends: &'a [[u32; 2]],
    /// The bonds of each point.
    pub incidence: &'a Incidence,
}

impl Topology<'_> {
    /// The other end of a bond of `point`.
    pub fn neighbour(self, bond: u32, point: u32) -> u32 {
        let [a, b] = self.ends[bond as usize];
        if a == point { b } else { a }
    }
}

/// The other points that elements couple with each point.
#[derive(Clone, Copy)]
pub struct CoupledPoints<'a> {
    pub(crate) lists: &'a Incidence,
    /// Ends of the bonds, where the lists are of bonds.
    pub(crate) ends: Option<&'a [[u32; 2]]>,
}

impl<'a> CoupledPoints<'a> {
    /// The points that elements couple with a point, ascending.
    pub fn at(self, point: u32) -> impl Iterator<Item = u32> + 'a {
        self.lists.at(point).iter().map(move |&entry| {
            self.ends.map_or(entry, |ends| {
                let [a, b] = ends[entry as usize];
                if a == point { b } else { a }
            })
        })
    }
}

/// Force and moment on a point for a displacement and a rotation of size one against its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointStiffness {
    /// Force for a displacement of 1 m, N/m.
    pub force: f64,
    /// Moment for a rotation of 1 rad, in the units of what it is compared with.
    pub moment: f64,
}

impl PointStiffness {
    /// Sums over the bonds of each point of (|axial| + |shear rigidity|)/l^2 and of (|shear| + |rotational rigidity|)/l, shape (n_points).
    pub(crate) fn of_bonds<const D: usize>(
        rigidities: &Rigidities,
        bonds: &BondSet<D>,
        subdomain: &Subdomain,
    ) -> Vec<Self> {
        let of_point = |point: u32| {
            let (mut force, mut moment) = (0.0, 0.0);
            for &bond in bonds.incidence.at(point) {
                let bond = bond as usize;
                let (length, shear) = (bonds.length[bond], rigidities.shear[bond].abs());
                force += (rigidities.axial[bond].abs() + shear) / length.powi(2);
                moment += (shear + rigidities.rotational[bond].abs()) / length;
            }
            [force, moment]
        };
        let points = (0..bonds.incidence.n_points() as u32).into_par_iter();
        let mut of_points: Vec<[f64; 2]> = points.map(of_point).collect();
        subdomain.all_gather_points(of_points.as_flattened_mut(), 2);
        let of_points = of_points.into_iter();
        of_points
            .map(|[force, moment]| Self { force, moment })
            .collect()
    }
}

/// Readings of the forces of the bonds as stresses, see [`crate::stress`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressReading {
    /// The mean of the force dyads of a point's bonds.
    Virial,
    /// The force through small planes at a point.
    Traction,
}

/// Stresses of all points.
#[derive(Debug, Clone, PartialEq)]
pub struct Stresses {
    /// Names of the components.
    pub names: &'static [&'static str],
    /// Values, shape (n_points, n_components), Pa.
    pub values: Vec<f64>,
}

/// The rigid motions of a body about the centre of its masses.
#[derive(Debug, Clone, PartialEq)]
pub struct CentralMotions {
    /// Centre of the masses, as in the mesh file, m.
    pub centre: Vec<f64>,
    /// Translations of size one along the axes, then rotations of size one, each of shape (n_degrees_of_freedom).
    pub motions: Vec<Vec<f64>>,
}
