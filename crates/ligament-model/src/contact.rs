//! Contact of the faces of cracks: pairs of points that were parted, and carry pressure again where they close.
//!
//! A pair was bonded before its bond broke, or would be but for a pre-crack. Its gap along the normal n of the crack, from A
//! to B, is
//!
//! g = (u_B - u_A) . n - l (e x n) . (phi_A + phi_B)/2 - l n . (eps_T e),
//!
//! with the length l and direction e of the bond, the rotations phi of the points (in the plane theta about z) and
//! the strain eps_T that the temperature gives. A rigid motion leaves it as it is, and so does the sliding of the faces along
//! each other. Where g < 0 the pair is closed and stores 1/2 k g^2: an energy, so that nothing is lost over a cycle. The
//! rotations in g put moments -k g l (e x n)/2 on both ends, which balance the couple of two forces that are not in line.
//!
//! k = (K_n (e . n)^2 + K_s |e x n|^2)/l^2 is what the bond resists along n with, its axial rigidity K_n and its shear rigidity
//! K_s: in a uniform strain eps_nn the closed pairs across a straight crack exert the traction of the body without the crack.
//! What strain along the crack adds to it (Poisson) is not recovered, nor is shear along the crack: there is no friction.

use crate::bonds::{BondSet, Incidence};
use crate::communicator::Wire;
use crate::layout::Component;
use crate::tensor::SymTensor;
use crate::thermal::ThermalStrain;

/// A bond that a pre-crack cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutBond<const D: usize = 2> {
    /// Points A < B.
    pub ends: [u32; 2],
    /// Unit normal of the pre-crack where it cuts the bond, from A to B.
    pub normal: [f64; D],
    /// Omega alpha V_A V_B k_n l of the bond in the whole body, J; 0 where faces do not close.
    pub axial: f64,
    /// Omega alpha V_A V_B k_t l of the bond in the whole body, J; 0 where faces do not close.
    pub shear: f64,
}

/// Faces of cracks: what pre-cracks cut, and whether faces that close carry pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct Faces<const D: usize = 2> {
    /// Bonds that pre-cracks cut, in the order of their ends.
    cut: Vec<CutBond<D>>,
    /// The points that bonds and closed faces couple with each point, ascending; none where faces do not close.
    coupled: Option<Incidence>,
}

/// Two points on either side of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPair {
    /// Number of the broken bond; cut bonds are numbered on from the bonds.
    pub number: u32,
    /// Points A < B.
    pub ends: [u32; 2],
    /// Unit normal n of the crack, from A to B; without a component along z in the plane.
    pub normal: [f64; 3],
    /// Stiffness k along the normal, N/m.
    pub stiffness: f64,
    /// Symmetric part of l n (x) e: what a strain of both points makes of the gap, and what the force across makes of their stress, m.
    pub spread: SymTensor<3>,
    /// Degrees of freedom and their factors in the gap; the factors are zero beyond those that two points have.
    pub row: [(u32, f64); 12],
}

/// A pair that is closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosedPair {
    /// The pair.
    pub pair: ContactPair,
    /// Gap of the pair, negative, m.
    pub gap: f64,
}

/// Two points whose faces have passed through each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// How far, along the normal of the crack, m.
    pub depth: f64,
    /// The points.
    pub ends: [u32; 2],
}

impl Wire<3> for Overlap {
    fn numbers(&self) -> [f64; 3] {
        let [a, b] = self.ends.map(f64::from);
        [self.depth, a, b]
    }

    fn from_numbers([depth, a, b]: [f64; 3]) -> Self {
        let ends = [a as u32, b as u32];
        Self { depth, ends }
    }
}

impl ContactPair {
    /// The gap for the motions of all points, shape (n_degrees_of_freedom), m.
    pub fn gap(&self, motions: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        let of_motions = |(dof, factor): &(u32, f64)| factor * motions[*dof as usize];
        let gap: f64 = self.row.iter().map(of_motions).sum();
        gap - self.growth(expansion)
    }

    /// What the strain of a temperature makes of the gap, m.
    pub fn growth(&self, expansion: ThermalStrain<'_>) -> f64 {
        if expansion.is_none() {
            return 0.0;
        }
        self.spread.contracted(&expansion.of_bond(self.ends))
    }
}

impl ClosedPair {
    /// Force k g across, N; negative, a pressure.
    pub fn force(&self) -> f64 {
        self.pair.stiffness * self.gap
    }

    /// What the second end exerts on the first along a component, N.
    pub fn pull(&self, component: Component) -> f64 {
        if component.is_rotation() {
            0.0
        } else {
            self.force() * self.pair.normal[component.in_space()]
        }
    }

    /// Virial stress that it gives an end of a volume, m^3, Pa: half of the force dyad.
    pub fn virial_share(&self, volume: f64) -> SymTensor<3> {
        self.pair.spread.scaled(0.5 * self.force() / volume)
    }

    /// Energy 1/2 k g^2, J.
    pub fn energy(&self) -> f64 {
        0.5 * self.force() * self.gap
    }
}

impl<const D: usize> Default for Faces<D> {
    fn default() -> Self {
        Self::open(Vec::new())
    }
}

impl<const D: usize> Faces<D> {
    /// Faces that bonds cut by pre-cracks leave, and that carry no pressure.
    pub fn open(cut: Vec<CutBond<D>>) -> Self {
        Self { cut, coupled: None }
    }

    /// Faces that carry pressure where they close, of bonds that broke as well.
    pub fn closing(cut: Vec<CutBond<D>>, bonds: &BondSet<D>) -> Self {
        let all = || {
            bonds
                .ends
                .iter()
                .copied()
                .chain(cut.iter().map(|it| it.ends))
        };
        let n_points = bonds.incidence.n_points();
        let mut others: Vec<(u32, u32)> = all().flat_map(|[a, b]| [(a, b), (b, a)]).collect();
        others.sort_unstable();
        let coupled = Incidence::from_pairs(others.iter().copied(), n_points);
        Self {
            coupled: Some(coupled),
            cut,
        }
    }

    /// Whether faces carry pressure where they close.
    pub fn close(&self) -> bool {
        self.coupled.is_some()
    }

    /// The bonds that pre-cracks cut.
    pub fn cut(&self) -> &[CutBond<D>] {
        &self.cut
    }

    /// The points that bonds and closed faces couple with each point; none where faces do not close.
    pub(crate) fn coupled(&self) -> Option<&Incidence> {
        self.coupled.as_ref()
    }
}
