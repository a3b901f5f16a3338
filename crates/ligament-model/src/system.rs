//! The bond system: points, bonds and rigidities, from which the equations are made.

mod bonds;
mod contact;
mod crack_axis;
pub mod elements;
mod parts;
mod rigid;
pub mod stored;

use std::sync::{Arc, OnceLock};

use ligament_mesh::MeshCell;

use crate::bonds::{BondSet, Incidence};
use crate::cloud::PointCloud;
use crate::contact::Faces;
use crate::deformation::DeformationPool;
use crate::element::strain_stiffness::StrainStiffness;
use crate::element::{Element, ElementKind, Rigidities, StiffnessFactors};
use crate::far_field::{FarField, Simplex};
use crate::law::BondStiffness;
use crate::layout::{Component, Layout};
use crate::material::{Stiffness, add_volumetric};
use crate::point_sums::Reach;
pub use crate::topology::UnbrokenBonds;
use crate::topology::{CoupledPoints, Topology};
use crate::volumetric::{VolumetricCells, VolumetricTerms};

/// Stress across the plane of a body in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressAcrossPlane {
    /// Plane stress.
    Zero,
    /// Plane strain of isotropic materials: by Hooke's law.
    OfIsotropic,
    /// Plane strain of other materials, whose constants across the plane are not given.
    Unknown,
}

/// Points and bonds in D dimensions with their rigidities; constant after construction.
#[derive(Debug, Clone)]
pub struct BondSystem<const D: usize = 2> {
    /// Material points.
    pub cloud: PointCloud<D>,
    /// Bonds without those that pre-cracks cut.
    pub bonds: BondSet<D>,
    /// Omega alpha of each bond: its weight in the damage of its ends, shape (n_bonds).
    pub weight: Arc<[f64]>,
    /// Rigidities of the bonds.
    pub rigidities: Rigidities,
    /// Kinematics of the bonds.
    pub element: ElementKind,
    /// Part of the rigidities of each bond that corrections do not apply to ([`BondStiffness`] at interfaces), shape (n_bonds); empty where
    /// no bond has such a part.
    pub beyond_correction: Vec<StiffnessFactors>,
    /// Stiffness of each material with the effective constants of the law, shape (n_materials), Pa; empty where no stress is
    /// evaluated from it.
    pub materials: Vec<Stiffness>,
    /// Stress across the plane.
    pub stress_across_plane: StressAcrossPlane,
    /// Crack faces.
    pub faces: Faces<D>,
    /// Elements in place of bonds where nothing breaks; none without a far field.
    pub far: Option<FarField<D>>,
    /// Volumetric stiffness of the cells; none where bonds have the whole stiffness of the materials.
    pub volumetric: Option<VolumetricTerms<D>>,
    /// Reusable memory for deformations.
    pub room: DeformationPool,
    /// Weights of the [strains of points](crate::stress::point_strain), computed at first use, shape (n_bonds).
    pub influence: OnceLock<Vec<f64>>,
}

impl<const D: usize> BondSystem<D> {
    /// Combines the results of the earlier stages: the factors alpha and Omega and the stiffness densities of all `bonds`.
    pub fn new(
        cloud: PointCloud<D>,
        bonds: BondSet<D>,
        element: ElementKind,
        stiffness: BondStiffness,
        length_factor: Vec<f64>,
        domain_factor: &[f64],
    ) -> Self {
        // The arrays of densities become those of rigidities: at this point of a run memory is scarce.
        let mut weight = length_factor;
        let (stiffness, beyond_correction) = stiffness.after_correction();
        let BondStiffness {
            mut axial,
            mut shear,
            mut rotational,
            strain,
            ..
        } = stiffness;
        let rigidities = (axial.iter_mut().zip(&mut shear)).zip(&mut rotational);
        let of_bonds = bonds.ends.iter().zip(&bonds.length).zip(domain_factor);
        let all = of_bonds.zip(weight.iter_mut().zip(rigidities));
        for (((ends, l), omega), (weight, ((axial, shear), rotational))) in all {
            let [a, b] = ends.map(|end| cloud.volumes[end as usize]);
            *weight *= omega;
            let factor = *weight * a * b;
            *axial = factor * *axial * l;
            *shear = factor * *shear * l;
            *rotational *= factor;
        }
        let of_bond = |(bond, density): (usize, StrainStiffness)| {
            let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
            density.scaled(weight[bond] * a * b * bonds.length[bond])
        };
        let rigidities = Rigidities {
            strain: strain.into_iter().enumerate().map(of_bond).collect(),
            axial,
            shear,
            rotational,
        };
        Self {
            rigidities,
            weight: weight.into(),
            element,
            beyond_correction,
            bonds,
            cloud,
            materials: Vec::new(),
            stress_across_plane: StressAcrossPlane::Zero,
            faces: Faces::default(),
            far: None,
            volumetric: None,
            room: DeformationPool::default(),
            influence: OnceLock::new(),
        }
    }

    /// The system with the stiffnesses of its materials (n_materials), Pa.
    pub fn with_materials(self, materials: Vec<Stiffness>) -> Self {
        Self { materials, ..self }
    }

    /// The system with a stress across its plane, which is zero by default.
    pub fn with_stress_across_plane(self, stress_across_plane: StressAcrossPlane) -> Self {
        Self {
            stress_across_plane,
            ..self
        }
    }

    /// The bonds of a part of a body between the points of the whole body: `points` has their numbers at the points of the part, ascending.
    /// Crack faces are not taken over.
    pub fn in_whole_body(self, cloud: PointCloud<D>, points: &[u32]) -> Self {
        let mut bonds = self.bonds;
        let of_body = |ends: &[u32; 2]| ends.map(|end| points[end as usize]);
        bonds.ends = bonds.ends.iter().map(of_body).collect();
        bonds.incidence = Incidence::new(&bonds.ends, cloud.len()).into();
        let coupled = CoupledPoints::from_bonds(&bonds.ends, &bonds.incidence);
        let volumetric = self
            .volumetric
            .map(|it| it.in_whole_body(points, &bonds, &coupled));
        Self {
            cloud,
            volumetric,
            bonds,
            faces: Faces::default(),
            influence: OnceLock::new(),
            ..self
        }
    }

    /// The system with linear finite elements between its points.
    pub fn with_far_field<C: MeshCell<D>>(mut self, simplices: &[Simplex<C>]) -> Self {
        let by_bonds = CoupledPoints::from_bonds(&self.bonds.ends, &self.bonds.incidence);
        let coupled = self
            .volumetric
            .as_ref()
            .map(VolumetricTerms::coupled_points);
        let whole = self.whole_materials();
        let far = FarField::new(&self.cloud, simplices, &whole, coupled.unwrap_or(&by_bonds));
        self.far = Some(far);
        self
    }

    /// Stiffness of each material, by bonds and cells together, shape (n_materials), Pa.
    pub fn whole_materials(&self) -> Vec<Stiffness> {
        let mut materials = self.materials.clone();
        let moduli = self.volumetric.iter().flat_map(|it| it.moduli());
        for (stiffness, modulus) in materials.iter_mut().zip(moduli) {
            add_volumetric::<D>(stiffness, *modulus);
        }
        materials
    }

    /// The system with the volumetric stiffness of cells by the moduli kappa of their materials (n_materials), Pa. `is_cut` says of an edge
    /// without a bond whether a pre-crack cuts it.
    pub fn with_volumetric(
        mut self,
        cells: &VolumetricCells<D>,
        moduli: &[f64],
        is_cut: impl Fn([u32; 2]) -> bool,
    ) -> Self {
        let by_bonds = CoupledPoints::from_bonds(&self.bonds.ends, &self.bonds.incidence);
        let by_faces = self.faces.coupled().map(CoupledPoints::from_lists);
        let coupled = by_faces.as_ref().unwrap_or(&by_bonds);
        self.volumetric = VolumetricTerms::new(cells, &self.bonds, moduli, is_cut, coupled);
        self
    }

    /// The system with crack faces.
    pub fn with_faces(self, faces: Faces<D>) -> Self {
        Self { faces, ..self }
    }
}

/// A bond system whose elements, between points with M components, are a type parameter, so that loops over bonds resolve it once.
#[derive(Debug)]
pub(crate) struct ElementSystem<const D: usize, const M: usize, E: Element<D, M>> {
    pub(crate) system: BondSystem<D>,
    /// Points and bonds as arrays.
    pub(crate) topology: Topology,
    /// Data that the elements share.
    pub(crate) lattice: E::Lattice,
}

impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// The system with the data that its elements share.
    fn new(system: BondSystem<D>, lattice: E::Lattice) -> Self {
        let BondSystem { cloud, bonds, .. } = &system;
        let couplings = E::couplings(&lattice);
        let of_elements = couplings.map(|[_, points]| points);
        let of_lists = || of_elements.or(system.faces.coupled());
        let coupled_points = match (&system.far, &system.volumetric) {
            (Some(far), _) => far.coupled_points.clone(),
            (None, Some(terms)) => terms.coupled_points().clone(),
            (None, None) => match of_lists() {
                Some(points) => CoupledPoints::from_lists(points),
                None => CoupledPoints::from_bonds(&bonds.ends, &bonds.incidence),
            },
        };
        let topology = Topology {
            layout: Layout {
                n_points: cloud.len(),
                components: &Component::in_dimensions(D)[..M],
            },
            numbering: cloud.numbering.clone(),
            subdomain: cloud.subdomain.clone(),
            volumes: cloud.volumes.clone(),
            spacing: cloud.spacing.clone(),
            ends: bonds.ends.clone(),
            horizons: bonds.horizon.clone(),
            weights: system.weight.clone(),
            element: system.element,
            incidence: bonds.incidence.clone(),
            elements_at_points: couplings
                .map_or(&bonds.incidence, |[bonds, _]| bonds)
                .clone(),
            coupled_points,
            far_field: system.far.as_ref().map(|it| it.neighbours.clone()),
            has_volumetric_cells: system.volumetric.is_some(),
            faces_close: system.faces.close(),
        };
        Self {
            system,
            topology,
            lattice,
        }
    }

    /// Bonds with the points that their elements reach.
    pub(crate) fn reach(&self) -> Reach<'_> {
        Reach {
            ends: &self.topology.ends,
            bonds: &self.topology.elements_at_points,
        }
    }
}

// These functions are the sweeps over all bonds: the compiler left some as calls, which cost the sweeps a fifth more time.
impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// The element of a bond with its whole stiffness, while the bonds marked in `intact` (n_bonds) are unbroken.
    #[inline(always)]
    pub(crate) fn whole_element(&self, intact: &[bool], bond: usize) -> E {
        let BondSystem {
            bonds, rigidities, ..
        } = &self.system;
        E::new(&self.lattice, bonds, rigidities, intact, bond)
    }

    /// The element of a bond with its remaining stiffness; `None` if the bond is broken.
    #[inline(always)]
    pub(crate) fn remaining_element(&self, bonds: UnbrokenBonds<'_>, bond: usize) -> Option<E> {
        if !bonds.intact[bond] {
            return None;
        }
        let whole = self.whole_element(bonds.intact, bond);
        Some(match bonds.remaining.get(bond) {
            None => whole,
            Some(remaining) => whole.weakened(remaining),
        })
    }
}
