//! What a setup has in the plane, and what in space.

use std::fmt::Debug;

use ligament_analysis::Component;
use ligament_model::bonds::precrack::{self, PreCrack};
use ligament_model::law::stability::NegativeShear;
use ligament_model::material::Space;
use ligament_model::tensor::SymTensor;
use ligament_model::{BondSet, BondSystem, Material, Plane, PointCloud};

use super::law::Law;
use super::section::Section;
use crate::body::Body;

/// The plane and space: `Dim` is a [`Dimension<2>`](Dimension) and a [`Dimension<3>`](Dimension).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dim;

/// What is there in D dimensions.
pub trait Dimension<const D: usize>: 'static {
    /// A crack that is there from the start.
    type PreCrack: Debug + Clone + PartialEq + Send + Sync;

    /// What a point stands for across the body.
    type Section: Debug + Clone + Copy + PartialEq + Send + Sync;

    /// The usual section.
    const SECTION: Self::Section;

    /// Components of the motion of a point that turns.
    const COMPONENTS: &'static [Component];

    /// What is wrong with a vector of zeros.
    const IDLE_VECTOR: &'static str;

    /// Largest share of its equations that the patch correction leaves without a warning, as a root mean square.
    const LARGEST_LEFT: f64;

    /// Horizon factor from which on bodies meet the equations of the patch correction.
    const PATCH_FACTOR: f64;

    /// The space of a body with a section.
    fn space(section: &Self::Section) -> Space;

    /// What a Poisson's ratio above that of central forces means in space, with the horizon over the distance of the points; None in the
    /// plane.
    fn negative_shear(_law: &Law, _poisson: f64, _horizon_factor: f64) -> Option<NegativeShear> {
        None
    }

    /// Bonds through a section of a probe, and whether their first end lies on its left or, in space, behind it.
    fn crossing(system: &BondSystem<D>, section: [[f64; D]; 2]) -> Vec<(u32, bool)>;

    /// For each of some pairs of points, whether the pre-cracks of a body part them, shape (n_bonds).
    fn parted(
        cracked: (&dyn Body<D>, &[Self::PreCrack]),
        pairs: &BondSet<D>,
        cloud: &PointCloud<D>,
    ) -> Vec<bool>;

    /// Directions of length one across a direction of length one.
    fn across(direction: [f64; D]) -> Vec<[f64; D]>;

    /// Strain of a material for one kelvin without stress, with the constants that the law makes of it; none without a coefficient.
    fn free_strain(section: &Self::Section, law: &Law, material: &Material)
    -> Option<SymTensor<D>>;
}

impl Dimension<2> for Dim {
    type PreCrack = PreCrack;

    type Section = Section;

    const SECTION: Section = Section::Plane {
        state: Plane::Stress,
        thickness: 1.0,
    };

    const COMPONENTS: &'static [Component] = &Component::ALL;

    const IDLE_VECTOR: &'static str =
        "this load does nothing: neither `x` nor `y` is given a value";

    /// Above it uniform strains are off by percents.
    const LARGEST_LEFT: f64 = 5e-3;

    const PATCH_FACTOR: f64 = 3.0;

    fn space(Section::Plane { state, .. }: &Section) -> Space {
        Space::Plane(*state)
    }

    fn crossing(system: &BondSystem, [start, end]: [[f64; 2]; 2]) -> Vec<(u32, bool)> {
        let (faces, cloud) = (&system.faces, &system.cloud);
        let cut = faces.cut().iter().filter(|_| faces.close());
        let ends = system.bonds.ends.iter().copied();
        let ends = ends.chain(cut.map(|it| it.ends));
        precrack::crossing_bonds(ends, cloud, start, end)
    }

    fn parted(
        (_, precracks): (&dyn Body, &[PreCrack]),
        pairs: &BondSet,
        cloud: &PointCloud,
    ) -> Vec<bool> {
        precrack::cut_bonds(precracks, pairs, cloud)
    }

    fn across([x, y]: [f64; 2]) -> Vec<[f64; 2]> {
        vec![[-y, x]]
    }

    fn free_strain(
        Section::Plane { state, .. }: &Section,
        law: &Law,
        material: &Material,
    ) -> Option<SymTensor<2>> {
        let elasticity = law.effective_elasticity(material, *state);
        let strains = material.expansion?.free_strain(&elasticity, *state);
        Some(SymTensor::from_engineering(&strains))
    }
}
