//! Random variation of strength, fracture energy or both over the body.
//!
//! A [`Scatter`] gives each point a factor with the mean 1. With a correlation length the factor is a function of the position alone, so
//! that a finer mesh of the same body has the same weak places; without one each point has an independent number, given by its number in the
//! file. The factor of a bond is the mean of those at its ends. Factors do not depend on threads or on the machine: random numbers are those
//! of SplitMix64 (`random.rs`), and all functions but the four operations and the square root come from the crate `libm`.

mod distribution;
mod random;
mod waves;

use ligament_mesh::Numbering;

pub use distribution::Distribution;
pub use random::uniform;

use crate::case_type::Range;
use crate::parallel;
use waves::RandomWaves;

/// Random variation of a property of the material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Property that varies.
    pub of: Scattered,
    /// Distribution of the factors.
    pub distribution: Distribution,
    /// Seed of the random numbers; another seed gives another specimen. Without one it is 0, and of a property beside another one it
    /// follows from the seed of that.
    pub seed: Option<u64>,
    /// Distance over which the correlation exp(-(r/L)^2) of two positions falls to 1/e, m; 0 for independent points.
    pub correlation_length: f64,
}

crate::case_type! {
    /// Property that varies, by a factor f. Limits of bonds from strengths, and limits given in their place, are multiplied by f; those from fracture
    /// energies by sqrt(f), and the energy of a bond beyond its limit follows.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Scattered {
        /// Strengths, and limits given in their place.
        Strength,
        /// Fracture energies.
        FractureEnergy,
    }
}

impl Scattered {
    /// Fracture energy for strength, and strength for fracture energy.
    pub fn other(self) -> Self {
        match self {
            Self::Strength => Self::FractureEnergy,
            Self::FractureEnergy => Self::Strength,
        }
    }

    /// Name of the field of the factors in results.
    pub fn field(self) -> &'static str {
        match self {
            Self::Strength => "strength_factor",
            Self::FractureEnergy => "fracture_energy_factor",
        }
    }
}

/// Seed of sample `number` of an ensemble, which depends on nothing but the seed of the ensemble and this number. It has 53 bits, so that
/// tables and case files hold it exactly.
pub fn seed_of_sample(seed: u64, number: u64) -> u64 {
    random::bits(seed, number) >> 11
}

/// Seed of the property at a place in a list: its own, or one that follows from that of the first property. Properties whose seeds differ
/// have independent factors.
pub fn seed_at(properties: &[Scatter], place: usize) -> u64 {
    let own = |place: usize| properties.get(place).and_then(|it| it.seed);
    let first = own(0).unwrap_or_default();
    match own(place) {
        Some(seed) => seed,
        None if place == 0 => first,
        // Far from the numbers of the first property, which are counted from 0.
        None => seed_of_sample(first, u64::MAX - place as u64),
    }
}

/// Factors of each of several properties at the positions (n_points), m, of points with a given numbering.
pub fn factors<const D: usize>(
    properties: &[Scatter],
    positions: &[[f64; D]],
    numbering: &Numbering,
) -> Vec<Factors> {
    let with_seed = |(place, property): (usize, &Scatter)| Scatter {
        seed: Some(seed_at(properties, place)),
        ..*property
    };
    let properties = properties.iter().enumerate().map(with_seed);
    properties
        .map(|it| it.factors(positions, numbering))
        .collect()
}

/// Factors of a property over the points.
#[derive(Debug, Clone, PartialEq)]
pub struct Factors {
    /// Property that varies.
    pub of: Scattered,
    /// Factors at the points, shape (n_points).
    pub at_points: Vec<f64>,
}

impl Scatter {
    /// Range of a correlation length.
    pub const CORRELATION_LENGTH: Range<'static> = Range::NOT_NEGATIVE;

    /// Factors at the positions (n_points), m, of points with a given numbering.
    pub fn factors<const D: usize>(
        &self,
        positions: &[[f64; D]],
        numbering: &Numbering,
    ) -> Factors {
        let seed = self.seed.unwrap_or_default();
        let at_points = if self.correlation_length > 0.0 {
            let waves = RandomWaves::new(seed, self.correlation_length);
            parallel::values(positions.len(), 1.0, |point| {
                self.distribution.factor(waves.at(positions[point]))
            })
        } else {
            let in_file = (0..positions.len() as u32).map(|it| numbering.in_file(it).into());
            let normal = in_file.map(|it: u64| random::normal(seed, it));
            normal.map(|it| self.distribution.factor(it)).collect()
        };
        Factors {
            of: self.of,
            at_points,
        }
    }
}

impl Factors {
    /// Factor of a bond: the mean of the factors of its ends.
    pub fn of_bond(&self, [a, b]: [u32; 2]) -> f64 {
        0.5 * (self.at_points[a as usize] + self.at_points[b as usize])
    }
}
