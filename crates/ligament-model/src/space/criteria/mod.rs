//! Failure criteria on bonds in space, with the constants of space.
//!
//! | kind | measure | limit |
//! |---|---|---|
//! | `strength` | tension | [`strength`]: from the energy at the tensile strength |
//! | `tension`, `compression` | tension, compression | F/E, the strain of a bar under its strength |
//! | `sliding` | sliding | F (1 + nu)/(2 E), the largest in that bar |
//! | `critical-stretch`, `bond-energy` | tension, energy | [`fracture_energy`]: from G_c, the bulk modulus and the mean length of the bonds |
//!
//! Shear is measured by the length of its vector. The others look at a bond within a plane, at strains of its own or at a printed table
//! of lattice bonds; they are refused by name.

mod basis;
pub mod fracture_energy;
pub mod strength;

use std::fmt;

use crate::failure::choosing::{after, scatter};
use crate::failure::{Choice, Criteria, Criterion, Kind, Limits, NoLimit};
use crate::failure::{fracture_energy as energies, sliding, strength as strengths, stretch};

pub use basis::SolidBasis;

/// Kinds of criteria that there are in space.
pub const KINDS: [&Kind; 6] = [
    &strengths::STRENGTH,
    &stretch::TENSION,
    &stretch::COMPRESSION,
    &sliding::SLIDING,
    &energies::CRITICAL_STRETCH,
    &energies::BOND_ENERGY,
];

/// A criterion that exists in the plane alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaneOnly {
    /// Word of its kind.
    pub kind: &'static str,
}

impl fmt::Display for PlaneOnly {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<String> = KINDS.iter().map(|it| format!("\"{}\"", it.word)).collect();
        write!(
            formatter,
            "the criterion \"{}\" exists in the plane alone; in space take one of {}",
            self.kind,
            words.join(", ")
        )
    }
}

impl std::error::Error for PlaneOnly {}

/// Why bonds in space have no limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoSolidLimit {
    /// The criterion exists in the plane alone.
    PlaneOnly(PlaneOnly),
    /// What the materials are does not go together.
    NoLimit(NoLimit),
}

impl fmt::Display for NoSolidLimit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PlaneOnly(reason) => reason.fmt(formatter),
            Self::NoLimit(reason) => reason.fmt(formatter),
        }
    }
}

impl std::error::Error for NoSolidLimit {}

/// Checks that a criterion exists in space.
///
/// # Errors
///
/// If it exists in the plane alone.
pub fn require_in_space(kind: &Kind) -> Result<(), PlaneOnly> {
    match KINDS.contains(&kind) {
        true => Ok(()),
        false => Err(PlaneOnly { kind: kind.word }),
    }
}

/// The criteria on the bonds, in the order of their choices, which must be [right](Choice::check) and [suit](Choice::suits) all
/// materials.
///
/// # Errors
///
/// If a criterion exists in the plane alone, or the fracture energy of a material leaves nothing after the limit; with the place of
/// the choice.
pub fn criteria(
    choices: &[Choice],
    basis: &SolidBasis<'_>,
) -> Result<Criteria, (usize, NoSolidLimit)> {
    let mut list = Vec::new();
    for (place, choice) in choices.iter().enumerate() {
        let kind = &choice.kind;
        require_in_space(kind).map_err(|it| (place, NoSolidLimit::PlaneOnly(it)))?;
        let mut limits = limits(choice, basis);
        scatter(choice, &mut limits.limit, basis.ends());
        let brittle = || fracture_energy::critical_stretches(basis);
        let after = after(&choice.after, &limits.limit, basis.ends(), &brittle)
            .map_err(|it| (place, NoSolidLimit::NoLimit(it)))?;
        list.push(Criterion {
            name: kind.word,
            measure: kind.measures[0],
            after,
            limit: limits.limit,
            coefficient: limits.coefficient,
            crack_at_points: None,
        });
    }
    Ok(Criteria { list })
}

/// Limits of the bonds under a criterion that exists in space.
fn limits(choice: &Choice, basis: &SolidBasis<'_>) -> Limits {
    let kind = choice.kind;
    if kind == strengths::STRENGTH {
        return Limits::without_coefficient(strength::critical_stretches(basis));
    }
    if kind == energies::CRITICAL_STRETCH {
        return Limits::without_coefficient(fracture_energy::critical_stretches(basis));
    }
    if kind == energies::BOND_ENERGY {
        return fracture_energy::limits_of_energy(choice, basis);
    }
    let of_materials = match choice.limit {
        Some(limit) => vec![limit; basis.materials.len()],
        None => basis.each(|constants, material| {
            let strain = (kind.takes.first()?.value)(material)? / constants.young;
            Some(if kind == sliding::SLIDING {
                0.5 * (1.0 + constants.poisson) * strain
            } else {
                strain
            })
        }),
    };
    Limits::without_coefficient(basis.weakest(&of_materials))
}

#[cfg(test)]
mod tests;
