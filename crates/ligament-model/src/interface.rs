//! Interface between the mechanics of bonds and the equations to be solved.
//!
//! A sweep over all bonds is one call through the interface; the loop inside has the element as a type parameter.

use ligament_mesh::Numbering;
use rayon::prelude::*;

use crate::bonds::{BondSet, Incidence};
use crate::change::ChangedElements;
use crate::contact::{ClosedPair, ContactPair, Overlap};
pub use crate::coupled::CoupledPoints;
use crate::deformation::Deformations;
use crate::element::{BondDeformation, Rigidities, StiffnessFactors, Term};
use crate::failure::Criterion;
use crate::failure::hooke::{Moduli, StressAcross};
use crate::failure::starting::Starting;
use crate::ghosts::Ghosts;
use crate::layout::{Component, Layout};
use crate::product::NearLimits;
use crate::rigid_motions::FreeMotion;
use crate::stress::carried::StrainReading;
use crate::stress::point_strain::Motion;
use crate::stress::stored::StoredMotions;
use crate::subdomain::Subdomain;
use crate::sweep::BondSweep;
use crate::system::UnbrokenBonds;
use crate::thermal::ThermalStrain;

/// The bonds of a body, as equations use them. Points, bonds and degrees of freedom are numbers; coordinates and the number of dimensions
/// stay behind this interface.
///
/// Where a body is divided between processes, each has the bonds at its owned points, and arrays of shape (n_bonds) are over those. Results
/// for the whole body, and forces at points, are the same on all processes, and their calls are collective: stiffnesses by sign, resisted
/// degrees of freedom, point stiffnesses, rigid motions, forces and energies of a sweep, overlaps. Energy densities and stresses of points
/// are valid at owned points, and their calls are not collective.
pub trait Bonds: BondTopology + BondKinetics + BondReadings + BondContact {}

impl<T: BondTopology + BondKinetics + BondReadings + BondContact> Bonds for T {}

/// Points, bonds and their connections: numbers without coordinates.
pub trait BondTopology: std::fmt::Debug + Send + Sync {
    /// Number of points.
    fn n_points(&self) -> usize;

    /// Numbering of the points, internal and in the file.
    fn numbering(&self) -> &Numbering;

    /// The points and bonds of the body on this process.
    fn subdomain(&self) -> &Subdomain;

    /// Components of the motion of a point, in the order of the arrays over degrees of freedom.
    fn components(&self) -> &'static [Component];

    /// Positions of the motions of the points in arrays over degrees of freedom.
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

    /// Numbers in the file of the ends of a bond, ascending, by which ties are broken.
    fn ends_in_file(&self, bond: u32) -> [u32; 2] {
        self.numbering().ends_in_file(self.ends()[bond as usize])
    }

    /// Bonds of each point.
    fn incidence(&self) -> &Incidence;

    /// Ends and families of the bonds.
    fn topology(&self) -> Topology<'_> {
        Topology {
            ends: self.ends(),
            incidence: self.incidence(),
            far: self.far_field(),
        }
    }

    /// Points that elements of the far field couple with each point; none without a far field.
    fn far_field(&self) -> Option<CoupledPoints<'_>>;

    /// Bonds whose elements couple each point, ascending; on the imaginary lattice these include bonds that do not end at the point.
    fn elements_at_points(&self) -> &Incidence;

    /// Other points that elements couple with each point.
    fn coupled_points(&self) -> CoupledPoints<'_>;

    /// Volume of each point, shape (n_points), m^3.
    fn volumes(&self) -> &[f64];

    /// Distance of each point from its nearest neighbour, shape (n_points), m.
    fn spacing(&self) -> &[f64];

    /// Horizon of each bond, shape (n_bonds), m.
    fn horizons(&self) -> &[f64];

    /// Weight of each bond in the damage of its ends, shape (n_bonds).
    fn weights(&self) -> &[f64];

    /// Fraction of the energy of a bond that belongs to one of its ends: mostly a half.
    fn share(&self, bond: u32, point: u32) -> f64;

    /// Diagonal of the box around all points of the body, m.
    fn extent(&self) -> f64;

    /// Sorts points so that the first half lies before the second along the longest side of their box; ties are broken by number.
    fn halve(&self, points: &mut [u32]);
}

/// Stiffness and forces of the bonds, and motions that cost no energy.
pub trait BondKinetics: BondTopology {
    /// Whether forces are linear in the displacements.
    fn is_linear(&self) -> bool;

    /// Whether forces derive from an energy, so that the stiffness is symmetric.
    fn has_energy(&self) -> bool;

    /// Whether every bond resists stretch and shear, so that the stiffness is definite.
    fn all_positive(&self) -> bool;

    /// Whether some bond has a negative stiffness, so that the stiffness of the body may be indefinite.
    fn some_negative(&self) -> bool;

    /// Whether some bond has a negative shear stiffness.
    fn some_negative_shear(&self) -> bool;

    /// Whether some bond resists each degree of freedom, shape (n_degrees_of_freedom).
    fn resisted(&self) -> Vec<bool>;

    /// Stiffness of each point with all its bonds, shape (n_points).
    fn point_stiffness(&self) -> Vec<PointStiffness>;

    /// Degrees of freedom of the body to fix so that no rigid motion of a connected part that costs no energy is free, beyond the fixed ones;
    /// the most effective first, ties by number in the file. Only those for which `can_hold` returns true are chosen. `points` are the owned
    /// points of the part; collective.
    fn holds(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> Vec<usize>;

    /// Displacements and rotations of a connected part in each of its rigid motions that costs no energy and is not prevented by fixed degrees
    /// of freedom. `points` are the owned points of the part; collective.
    fn free_shapes(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> FreeShapes;

    /// Rigid motions of a connected part that cost no energy and are not prevented by fixed degrees of freedom, with the work of given forces
    /// on them. `points` are the owned points of the part; collective.
    fn free_motions(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        force: &dyn Fn(usize) -> f64,
    ) -> Vec<FreeMotion>;

    /// Displacements and rotations of some points in each rigid motion, whether it costs energy or not, shape (n_motions,
    /// n_degrees_of_freedom of the points): unit translations along the axes, then rotations about the middle of the points by one over
    /// their radius, which include the rotations of the points.
    fn rigid_shapes(&self, points: &[u32]) -> Vec<Vec<f64>>;

    /// The [rigid shapes](Self::rigid_shapes) of the whole body at the points of this process; collective.
    fn rigid_shapes_of_body(&self) -> Vec<Vec<f64>>;

    /// Rigid motions of the whole body about its centre of mass, for the masses of the points (n_points), kg.
    fn motions_about_centre(&self, masses: &[f64]) -> CentralMotions;

    /// Motions of uniform strain: displacements u_i = x_j, u_j = x_i of all points for each pair of axes i <= j, each of shape
    /// (n_degrees_of_freedom).
    fn motions_of_strain(&self) -> Vec<Vec<f64>>;

    /// Deformation of every bond less its thermal deformation, broken or not, shape (n_bonds).
    fn deformations(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Deformations;

    /// Deformations that criteria measure, of some bonds in their order, for displacements (n_degrees_of_freedom) without thermal strains.
    fn measured(
        &self,
        intact: &[bool],
        displacement: &[f64],
        bonds: &[u32],
    ) -> Vec<BondDeformation>;

    /// Forces and energy of bonds with given deformations (n_bonds).
    ///
    /// The result does not depend on the number of threads: the bonds of a part are summed by one thread in their order, and the parts one
    /// after another.
    fn forces(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: Deformations,
        expansion: ThermalStrain<'_>,
    ) -> BondSweep;

    /// Stiffness of a bond with its remaining factors, as a sum of terms.
    fn terms(&self, intact: &[bool], bond: usize, remaining: &StiffnessFactors) -> Vec<Term>;

    /// Adds the blocks of the stiffness in the columns of a point at the rows of its `lower` coupled points (ascending) and of itself, shape
    /// (n_lower + 1, n_components, n_components).
    fn add_blocks(&self, bonds: UnbrokenBonds<'_>, point: u32, lower: &[u32], blocks: &mut [f64]);

    /// The product K u of the stiffness of the unbroken bonds with motions u, shape (n_degrees_of_freedom) both; for bonds whose forces are
    /// linear in the displacements. The result overwrites `forces`.
    ///
    /// The result does not depend on the number of threads, as in [`BondKinetics::forces`].
    fn multiply(&self, bonds: UnbrokenBonds<'_>, motions: &[f64], forces: &mut [f64]);

    /// The product K u, as [`BondKinetics::multiply`], and the unbroken bonds near their limits, ascending, in one sweep. The forces overwrite
    /// `forces`.
    fn forces_near_limits(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: &[f64],
        limits: NearLimits<'_>,
        forces: &mut [f64],
    ) -> Vec<u32>;

    /// Adds the derivatives of the forces by the displacements: row, column, value.
    fn add_derivatives(&self, intact: &[bool], add: &mut dyn FnMut(usize, usize, f64));

    /// Elements that change when some of the bonds that are `left` break, at displacements (n_degrees_of_freedom).
    fn changed(
        &self,
        left: UnbrokenBonds<'_>,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        bonds: &[u32],
    ) -> Box<dyn ChangedElements>;
}

/// Energies, stresses and forces derived from a state of the bonds.
pub trait BondReadings: BondTopology {
    /// Energy 1/2 u^T K u', J, of an unbroken bond with its remaining stiffness, for two deformations of all bonds.
    fn mutual_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &StiffnessFactors,
        deformations: [&Deformations; 2],
    ) -> f64;

    /// Energy 1/2 u^T K u, J, of an unbroken bond with its remaining stiffness, from its deformation as criteria measure it.
    fn stored_energy(
        &self,
        intact: &[bool],
        bond: usize,
        remaining: &StiffnessFactors,
        measured: &BondDeformation,
    ) -> f64;

    /// Strain energy density of a point, J/m^3: its part of the energy of its bonds over its volume.
    fn energy_density(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        point: u32,
    ) -> f64;

    /// Components of the virial stress of a point, Pa.
    fn stress(&self, bonds: UnbrokenBonds<'_>, deformations: &Deformations, point: u32)
    -> Vec<f64>;

    /// Stresses of all points by one reading of the forces of the bonds.
    fn stresses(
        &self,
        reading: StressReading,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
    ) -> Stresses;

    /// Stresses of all points by the stiffnesses of their materials, Pa; not a number where the bonds of a point do not span the space.
    /// Collective.
    fn stresses_by_material(&self, reading: StrainReading<'_>) -> Stresses;

    /// Components of the stress of one point by the stiffness of its material, Pa; not a number where its bonds do not span the space.
    fn stress_by_material(&self, reading: StrainReading<'_>, point: u32) -> Vec<f64>;

    /// Stress on the plane across each bond in a motion with its deformations (n_bonds), from the moduli of a bond by its number, shape
    /// (n_bonds); of a bar where the bonds of neither end span the space.
    fn stresses_across(
        &self,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        moduli: &(dyn Fn(usize) -> Moduli + Sync),
    ) -> Vec<StressAcross>;

    /// Room for motions of bonds that are known from different times, from which stresses across the bonds follow; None where points have
    /// no rotations.
    fn stored_motions(&self) -> Option<Box<dyn StoredMotions + '_>>;

    /// Stress around each bond over the strength at which it begins to soften, shape (n_bonds); 0 where tension does not pull the
    /// bond across.
    fn utilisations(
        &self,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
        starting: &Starting,
    ) -> Vec<f64>;

    /// Sum of a component of the forces of the far ends of some bonds on the near ends, N, for bonds of two points only; the flag of a bond
    /// marks its first end as near.
    fn force_through(
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
        crossing: &[(u32, bool)],
        component: Component,
    ) -> f64;

    /// Energy of a bond at a limit of the measure of a criterion, from the rigidity that the criterion weakens, J; 0 where the limit is infinite.
    fn energy_at(&self, criterion: &Criterion, limit: f64, bond: usize) -> f64;
}

/// Pairs of points across cracks.
pub trait BondContact: BondTopology {
    /// Whether crack faces carry pressure where they close.
    fn faces_close(&self) -> bool;

    /// Pairs of points across cracks while the bonds marked in `intact` (n_bonds) are unbroken, in the order of their numbers.
    fn contact_pairs(&self, intact: &[bool]) -> Vec<ContactPair>;

    /// The pairs of a whole body that change with bonds that have just broken, while those marked in `intact` (n_bonds) are unbroken: the numbers
    /// of bonds, ascending, with their pairs, and none for a bond that is no pair.
    fn changed_pairs(&self, intact: &[bool], broken: &[u32]) -> Vec<(u32, Option<ContactPair>)>;

    /// Pair across a crack with the largest overlap of the faces, beyond a depth (m), among the points marked in `asked` (n_points), for
    /// displacements (n_degrees_of_freedom); none where faces close.
    fn overlap(
        &self,
        intact: &[bool],
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        beyond: f64,
        asked: &[bool],
    ) -> Option<Overlap>;

    /// Adds the stresses of closed pairs to the stresses of all points by a reading.
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
    /// Bonds of each point.
    pub incidence: &'a Incidence,
    /// Points that elements of the far field, which never break, couple with each point.
    pub far: Option<CoupledPoints<'a>>,
}

impl<'a> Topology<'a> {
    /// Points that bonds marked in `intact` (n_bonds), or elements of the far field, connect with a point.
    pub fn connected(self, point: u32, intact: &[bool]) -> impl Iterator<Item = u32> {
        let bonds = self.incidence.at(point).iter();
        let intact = bonds.filter(|bond| intact[**bond as usize]);
        let by_bonds = intact.map(move |&bond| self.neighbour(bond, point));
        by_bonds.chain(self.far.into_iter().flat_map(move |far| far.at(point)))
    }

    /// The other end of a bond of `point`.
    pub fn neighbour(self, bond: u32, point: u32) -> u32 {
        let [a, b] = self.ends[bond as usize];
        if a == point { b } else { a }
    }
}

/// Force and moment on a point for a unit displacement and a unit rotation against its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointStiffness {
    /// Force for a displacement of 1 m, N/m.
    pub force: f64,
    /// Moment for a rotation of 1 rad over the bond length, N.
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
        Ghosts::all(subdomain).update(of_points.as_flattened_mut(), 2);
        let of_points = of_points.into_iter();
        of_points
            .map(|[force, moment]| Self { force, moment })
            .collect()
    }
}

/// Readings of the forces of the bonds as stresses, see [`crate::stress`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressReading {
    /// Virial: the mean of the force dyads of the bonds of a point.
    Virial,
    /// Traction: the force through small planes at a point.
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

/// Free rigid motions of a connected part of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FreeShapes {
    /// Degrees of freedom of the part, numbered in the body, ascending; empty where no motion is free.
    pub degrees_of_freedom: Vec<usize>,
    /// Whether a support can be added at each, shape (n_degrees_of_freedom).
    pub can_hold: Vec<bool>,
    /// Displacements and rotations, shape (n_motions, n_degrees_of_freedom).
    pub motions: Vec<Vec<f64>>,
}

/// Rigid motions of a body about its centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct CentralMotions {
    /// Centre of mass, in the coordinates of the mesh file, m.
    pub centre: Vec<f64>,
    /// Unit translations along the axes, then unit rotations, each of shape (n_degrees_of_freedom).
    pub motions: Vec<Vec<f64>>,
}
