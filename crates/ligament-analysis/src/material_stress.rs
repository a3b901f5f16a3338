//! Stresses of points by the laws of their materials: the one that damaged material carries, and the effective one.

use ligament_model::stress::carried::{Carried, StrainReading};
use ligament_model::stress::point_strain::Motion;

use crate::balanced::Balanced;
use crate::load_program::LoadProgram;
use crate::state::State;

/// Stress of a point by the law of its material. Both are equal where no bond of the point is broken or softening.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MaterialStress {
    /// Stress that the material carries with the remaining stiffness of its bonds.
    Carried,
    /// Stress of sound material at the strain of the bonds that are neither broken nor softening.
    Effective,
}

impl MaterialStress {
    /// Runs a function on the reading of the strains from which the stress follows in an equilibrium state.
    pub(crate) fn with_strains<T>(
        self,
        state: &State,
        balanced: &Balanced,
        loads: &dyn LoadProgram,
        run: impl FnOnce(StrainReading<'_>) -> T,
    ) -> T {
        let motion = |intact| Motion {
            intact,
            displacement: &state.displacement,
            expansion: loads.thermal_strain(state.load_factor),
        };
        match self {
            Self::Carried => run(StrainReading::Carried(Carried {
                motion: motion(&state.intact),
                remaining: &state.softening.remaining,
                closed: &balanced.closed,
            })),
            Self::Effective => {
                let sound = state.softening.sound(&state.intact);
                run(StrainReading::Effective(motion(&sound)))
            }
        }
    }
}
